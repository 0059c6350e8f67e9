#include "config.h"
#include "loft/bends.h"
#include "base/alloc.h"

#include <string.h>

/* How far from its contour, in edges, a bend is felt: sheets are a few across. */
enum { PASSES = 12 };

void il_bends_free(il_bends *b)
{
    il_free(b->of);
    *b = (il_bends)IL_BENDS_INIT;
}

/* Vertices first .. end - 1, those of one section, have their bends of SIDE: carry them to the
 * others.  has[n], sum[4*n]: to work in. */
typedef struct spreading {
    il_bends *bends;
    const uint32_t *row;   /* of each corner of the surface's triangles */
    size_t n_corners, side, first, end;
    unsigned char *has;
    double *sum;
} spreading;

static void add_neighbours(spreading *s)
{
    memset(s->sum, 0, 4 * s->bends->n * sizeof *s->sum);
    for (size_t i = 0; i < s->n_corners; i++) {
        size_t a = s->row[i], b = s->row[i % 3 == 2 ? i - 2 : i + 1];
        if (!s->has[b])
            continue;
        for (size_t k = 0; k < 3; k++)
            s->sum[4 * a + k] += s->bends->of[6 * b + 3 * s->side + k];
        s->sum[4 * a + 3]++;
    }
}

static void spread(spreading *s)
{
    memset(s->has, 0, s->bends->n);
    memset(s->has + s->first, 1, s->end - s->first);
    for (int pass = 0; pass < PASSES; pass++) {
        add_neighbours(s);
        for (size_t v = 0; v < s->bends->n; v++) {
            if ((v >= s->first && v < s->end) || s->sum[4 * v + 3] == 0)
                continue;
            s->has[v] = 1;
            for (size_t k = 0; k < 3; k++)
                s->bends->of[6 * v + 3 * s->side + k] = s->sum[4 * v + k] / s->sum[4 * v + 3];
        }
    }
}

/* The bends of the section of SIDE, and what they do to the rest. */
static il_status carry(spreading *s, const il_section *section, const il_lean *own, const il_lean *beyond, il_error *err)
{
    double *bend = NULL;
    il_status st = il_lean_bend(&bend, section, own, beyond, err);
    for (size_t v = 0; st == IL_OK && v < section->n_nodes; v++)
        memcpy(s->bends->of + 6 * (s->first + v) + 3 * s->side, bend + 3 * v, 3 * sizeof *bend);
    if (st == IL_OK)
        spread(s);
    il_free(bend);
    return st;
}

/* A cubic that is a parabola has the same bend at both ends, of opposite signs. */
static void carry_back(spreading *s)
{
    for (size_t v = s->first; v < s->end; v++)
        for (size_t k = 0; k < 3; k++)
            s->bends->of[6 * v + 3 * s->side + k] = -s->bends->of[6 * v + 3 * (1 - s->side) + k];
    spread(s);
}

static bool prepare(spreading *s, uint32_t **row, const il_surface *surface, const il_section *lower, const il_section *upper)
{
    *row = il_alloc(surface->n_triangles, 3 * sizeof **row);
    s->has = il_alloc(s->bends->n, 1);
    s->sum = il_alloc(s->bends->n, 4 * sizeof *s->sum);
    s->bends->of = il_calloc(s->bends->n, 6 * sizeof *s->bends->of);
    if (!*row || !s->has || !s->sum || !s->bends->of)
        return false;
    for (size_t i = 0; i < s->n_corners; i++)
        (*row)[i] = (uint32_t)il_surface_row(lower, upper, surface->tri[i]);
    s->row = *row;
    return true;
}

il_status il_bends_find(il_bends *out, const il_surface *s, const il_section *lower, const il_section *upper,
                        const il_lean lean[2], const il_lean beyond[2], il_error *err)
{
    const il_section *section[2] = { lower, upper };
    uint32_t *row = NULL;
    *out = (il_bends){ NULL, lower->n_nodes + upper->n_nodes + s->n_inner };
    spreading work = { .bends = out, .n_corners = 3 * s->n_triangles };
    il_status st = prepare(&work, &row, s, lower, upper) ? IL_OK : il_fail_nomem(err);
    for (size_t pass = 0; pass < 2; pass++)
        for (size_t side = 0; side < 2 && st == IL_OK; side++) {
            work.side = side;
            work.first = side == IL_LOWER ? 0 : lower->n_nodes;
            work.end = work.first + section[side]->n_nodes;
            if (pass == 0 && beyond[side].slope)
                st = carry(&work, section[side], &lean[side], &beyond[side], err);
            else if (pass == 1 && !beyond[side].slope && beyond[1 - side].slope)
                carry_back(&work);
        }
    il_free(row);
    il_free(work.has);
    il_free(work.sum);
    if (st != IL_OK)
        il_bends_free(out);
    return st;
}
