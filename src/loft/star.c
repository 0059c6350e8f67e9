#include "config.h"
#include "loft/star.h"
#include "base/alloc.h"
#include "base/number.h"
#include "loft/sector.h"

#include <math.h>
#include <string.h>

typedef struct star {
    il_builder *b;
    uint32_t *code;          size_t n, cap;  /* round the disc */
    double sum[2][2], length[2];             /* of the edges in each plane: middles by length */
} star;

static uint32_t next_of(uint32_t e)
{
    return e % 3 == 2 ? e - 2 : e + 1;
}

static bool is_rim(const il_overlay *o, uint32_t e)
{
    return (o->edge[e] & IL_EDGE_CONTOUR) != 0;
}

/* The rim edge that follows E round the same sheet. */
static uint32_t next_rim(const il_overlay *o, uint32_t e)
{
    for (e = next_of(e); !is_rim(o, e); e = next_of(e)) {
        uint32_t t = o->across[e], p = o->corner[e];
        for (e = 3 * t; o->corner[next_of(e)] != p; e++)
            continue;
    }
    return e;
}

static void position(const il_builder *b, uint32_t code, double out[2])
{
    uint32_t side = IL_CODE_WHERE(code), i = IL_CODE_INDEX(code);
    size_t n = b->section[side]->n_nodes;
    memcpy(out, i < n ? b->section[side]->xy + 2 * i : b->out->insertion[side][i - n].xy, 2 * sizeof *out);
}

static bool add_code(star *s, uint32_t code)
{
    if (s->n > 0 && s->code[s->n - 1] == code)
        return true;
    if (code == IL_NONE || !il_grow(&s->code, &s->cap, s->n + 1, sizeof *s->code))
        return false;
    s->code[s->n++] = code;
    return true;
}

/* The edge's two copies in its plane; false without memory. */
static bool add_edge(star *s, uint32_t e)
{
    const il_overlay *o = s->b->o;
    int plane = il_edge_plane(o, e);
    uint32_t from = il_builder_copy(s->b, plane, o->corner[e]), to = il_builder_copy(s->b, plane, o->corner[next_of(e)]);
    if (!add_code(s, from) || !add_code(s, to))
        return false;
    double a[2], b[2];
    position(s->b, from, a);
    position(s->b, to, b);
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    s->length[plane] += length;
    for (size_t c = 0; c < 2; c++)
        s->sum[plane][c] += length * (a[c] + b[c]) / 2;
    return true;
}

static uint32_t add_centre(star *s)
{
    double p[3];
    for (size_t c = 0; c < 2; c++) {
        p[c] = (s->sum[0][c] / s->length[0] + s->sum[1][c] / s->length[1]) / 2;
        p[c] = s->b->options.round_float ? il_number_round_float(p[c]) : p[c];
    }
    p[2] = il_builder_height(s->b, 0.5);
    return il_surface_add_inner(s->b->out, p);
}

/* Over the lower region the sheet faces up, under the upper region down. */
static bool emit(star *s, uint32_t t)
{
    bool up = s->b->o->inside[t] == IL_EDGE_LOWER;
    uint32_t centre = add_centre(s);
    if (s->n > 1 && s->code[0] == s->code[s->n - 1])
        s->n--;
    bool ok = centre != UINT32_MAX;
    for (size_t i = 0; ok && i < s->n; i++) {
        uint32_t a = s->code[i], b = s->code[(i + 1) % s->n];
        ok = il_surface_add_triangle(s->b->out, centre, up ? a : b, up ? b : a);
    }
    return ok;
}

/* The sheet with rim edge FIRST, which has N_RIM of them: a star if one way round passes all. */
static bool build(star *s, uint32_t first, size_t n_rim, bool *done)
{
    const il_overlay *o = s->b->o;
    bool in[2] = { false, false };
    size_t n = 0;
    for (uint32_t e = first; n == 0 || e != first; e = next_rim(o, e), n++)
        in[il_edge_plane(o, e)] = true;
    *done = n == n_rim && in[0] && in[1];
    s->n = 0;
    memset(s->sum, 0, sizeof s->sum);
    memset(s->length, 0, sizeof s->length);
    bool ok = true;
    for (uint32_t e = first, k = 0; ok && *done && k < n; e = next_rim(o, e), k++)
        ok = add_edge(s, e);
    return ok && (!*done || emit(s, first / 3));
}

il_status il_build_stars(il_builder *b, const uint32_t *component, size_t n_components, bool *done, il_error *err)
{
    const il_overlay *o = b->o;
    star s = { .b = b };
    size_t *n_rim = il_calloc(n_components, sizeof *n_rim);
    uint32_t *first = il_alloc(n_components, sizeof *first);
    bool ok = n_rim && first;
    for (uint32_t e = 0; ok && e < 3 * o->n_triangles; e++)
        if (il_overlay_is_sheet(o, e / 3) && is_rim(o, e) && n_rim[component[e / 3]]++ == 0)
            first[component[e / 3]] = e;
    for (size_t c = 0; ok && c < n_components; c++)
        ok = build(&s, first[c], n_rim[c], &done[c]);
    il_free(n_rim);
    il_free(first);
    il_free(s.code);
    return ok ? IL_OK : il_fail_nomem(err);
}
