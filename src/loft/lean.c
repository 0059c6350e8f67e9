#include "config.h"
#include "loft/lean.h"
#include "base/alloc.h"
#include "loft/certificate.h"

#include <math.h>

/* The outward normal of edge STATION, for the region lies on its left; 0 for an edge without length. */
static void normal_of(const il_section *s, uint32_t station, double n[2])
{
    const double *a = s->xy + 2 * (size_t)s->node_at[station], *b = s->xy + 2 * (size_t)s->node_at[s->next[station]];
    double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
    n[0] = length > 0 ? y / length : 0;
    n[1] = length > 0 ? -x / length : 0;
}

/* From the two nodes of an edge, as the surface's triangles go along it, to its station. */
static bool index_edges(il_keymap *at, const il_section *s, int side)
{
    if (!il_keymap_reserve(at, s->n_stations))
        return false;
    for (uint32_t i = 0; i < s->n_stations; i++) {
        uint32_t a = s->node_at[i], b = s->node_at[s->next[i]];
        il_keymap_put(at, side == IL_LOWER ? a : b, side == IL_LOWER ? b : a, i);
    }
    return true;
}

il_status il_lean_measure(il_lean *out, const il_surface *s, const il_section *lower, const il_section *upper,
                          int side, il_error *err)
{
    const il_section *section = side == IL_LOWER ? lower : upper;
    il_keymap at = IL_KEYMAP_INIT;
    *out = (il_lean){ il_calloc(section->n_stations, sizeof *out->slope), upper->z - lower->z };
    bool ok = out->slope && index_edges(&at, section, side);
    for (size_t i = 0; ok && i < 3 * s->n_triangles; i++) {
        uint32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1], apex = s->tri[i - i % 3 + (i + 2) % 3];
        if (IL_CODE_WHERE(a) != (uint32_t)side || IL_CODE_WHERE(b) != (uint32_t)side)
            continue;
        uint32_t station = il_keymap_get(&at, IL_CODE_INDEX(a), IL_CODE_INDEX(b), UINT32_MAX);
        if (station == UINT32_MAX)
            continue;
        const double *q = section->xy + 2 * (size_t)IL_CODE_INDEX(a);
        double p[3], n[2];
        normal_of(section, station, n);
        il_surface_position(s, lower, upper, apex, p);
        out->slope[station] = ((p[0] - q[0]) * n[0] + (p[1] - q[1]) * n[1]) / (p[2] - section->z);
    }
    il_keymap_free(&at);
    if (ok)
        return IL_OK;
    il_free(out->slope);
    out->slope = NULL;
    return il_fail_nomem(err);
}

/* ---- the smooth surface ------------------------------------------------------------ */

/* Chords c0, c1 of a circle from one of its points: its tangent there is along c0 / |c0|^2 +
 * c1 / |c1|^2.  Neither tan nor atan, whose last bit depends on the processor. */
double il_lean_between(double s0, double h0, double s1, double h1)
{
    double w0 = h1 * (1 + s1 * s1), w1 = h0 * (1 + s0 * s0), s = (w0 * s0 + w1 * s1) / (w0 + w1);
    return copysign(fmin(fabs(s), 3 * fmin(fabs(s0), fabs(s1))), s);
}

/* What the edges at a node have, each by its length. */
typedef struct mean { double own, beyond, normal[2], weight; } mean;

static void gather(mean *at, const il_section *s, const il_lean *own, const il_lean *beyond)
{
    for (uint32_t i = 0; i < s->n_stations; i++) {
        uint32_t end[2] = { s->node_at[i], s->node_at[s->next[i]] };
        double n[2], length = hypot(s->xy[2 * (size_t)end[1]] - s->xy[2 * (size_t)end[0]],
                                    s->xy[2 * (size_t)end[1] + 1] - s->xy[2 * (size_t)end[0] + 1]);
        normal_of(s, i, n);
        for (int k = 0; k < 2; k++) {
            mean *m = &at[end[k]];
            m->own += length * own->slope[i];
            m->beyond += length * beyond->slope[i];
            m->normal[0] += length * n[0];
            m->normal[1] += length * n[1];
            m->weight += length;
        }
    }
}

il_status il_lean_bend(double **bend, const il_section *section, const il_lean *own, const il_lean *beyond, il_error *err)
{
    mean *at = il_calloc(section->n_nodes, sizeof *at);
    *bend = il_calloc(section->n_nodes, 3 * sizeof **bend);
    if (!at || !*bend) {
        il_free(at);
        il_free(*bend);
        *bend = NULL;
        return il_fail_nomem(err);
    }
    gather(at, section, own, beyond);
    for (size_t v = 0; v < section->n_nodes; v++) {
        double length = hypot(at[v].normal[0], at[v].normal[1]);
        if (!(length > 0) || !(at[v].weight > 0))
            continue;
        double straight = at[v].own / at[v].weight;
        double smooth = il_lean_between(at[v].beyond / at[v].weight, beyond->height, straight, own->height);
        bool goes_on = smooth * straight > 0 && fabs(straight) < IL_LEAN_RISE * fabs(smooth);
        double *b = *bend + 3 * v;
        double by = fmin(fmax(smooth - straight, -IL_LEAN_BEND), IL_LEAN_BEND);
        b[0] = by * at[v].normal[0] / length;
        b[1] = by * at[v].normal[1] / length;
        b[2] = (goes_on ? straight / smooth : IL_LEAN_RISE) - 1;
    }
    il_free(at);
    return IL_OK;
}
