#include "config.h"
#include "loft/builder.h"
#include "base/alloc.h"
#include "base/number.h"

#include <math.h>

static double rounded(const il_builder *b, double v)
{
    return b->options.round_float ? il_number_round_float(v) : v;
}

/* The least number above V that the output holds. */
static double next_above(const il_builder *b, double v)
{
    return b->options.round_float ? (double)nextafterf((float)v, INFINITY) : nextafter(v, INFINITY);
}

double il_builder_height(const il_builder *b, double z)
{
    double low = b->section[IL_LOWER]->z, high = b->section[IL_UPPER]->z;
    double height = rounded(b, low + z * (high - low));
    /* however few numbers there are between the planes, none of an inner point is theirs */
    if (height <= low)
        return next_above(b, low);
    return height < high ? height : -next_above(b, -high);
}

uint32_t il_builder_copy(il_builder *b, int side, uint32_t p)
{
    const il_pass *pass = &b->o->pass[side][p];
    const il_section *s = b->section[side];
    il_surface *out = b->out;
    if (pass->node >= 0)
        return IL_CODE(side, pass->node);
    if (pass->station == IL_NONE)
        return IL_NONE;
    if (b->inserted[side][p] == IL_NONE) {
        size_t n = out->n_insertions[side];
        if (!il_grow(&out->insertion[side], &out->cap_insertions[side], n + 1, sizeof *out->insertion[side]))
            return IL_NONE;
        const double *from = s->xy + 2 * s->node_at[pass->station], *to = s->xy + 2 * s->node_at[s->next[pass->station]];
        out->insertion[side][n] = (il_split){ pass->station, pass->t,
            { rounded(b, from[0] + pass->t * (to[0] - from[0])), rounded(b, from[1] + pass->t * (to[1] - from[1])) } };
        out->n_insertions[side]++;
        b->inserted[side][p] = (uint32_t)n;
    }
    return IL_CODE(side, s->n_nodes + b->inserted[side][p]);
}
