#include "config.h"
#include "loft/axis.h"
#include "base/alloc.h"
#include "loft/surface.h"

#include <math.h>
#include <string.h>

/* A second round breaks the chords that the first leaves; a third brought
 * nothing but triangles. */
enum { ROUNDS = 2 };

static bool is_flat(const il_overlay *o, const il_labels *l, size_t t, size_t k)
{
    /* seen from the triangle with the lesser number, so that it counts once */
    uint32_t across = o->across[3 * t + k];
    return il_overlay_is_sheet(o, (uint32_t)t) && il_labels_flat(l, o, t, k) && (across == IL_NONE || across > t);
}

static il_status middles_of_flat_edges(const il_overlay *o, const il_labels *l, double **xy, size_t *n, il_error *err)
{
    size_t cap = 0;
    *xy = NULL;
    *n = 0;
    for (size_t t = 0; t < o->n_triangles; t++)
        for (size_t k = 0; k < 3; k++) {
            if (!is_flat(o, l, t, k))
                continue;
            if (!il_grow(xy, &cap, 2 * (*n + 1), sizeof **xy))
                return il_fail_nomem(err);
            const double *a = o->xy + 2 * o->corner[3 * t + k], *b = o->xy + 2 * o->corner[3 * t + (k + 1) % 3];
            (*xy)[2 * *n] = (a[0] + b[0]) / 2;
            (*xy)[2 * *n + 1] = (a[1] + b[1]) / 2;
            ++*n;
        }
    return IL_OK;
}

il_status il_axis_insert(il_overlay *o, il_labels *l, il_error *err)
{
    il_status st = il_labels_assign(l, o, err);
    for (int round = 0; st == IL_OK && round < ROUNDS; round++) {
        double *xy = NULL;
        size_t n = 0;
        st = middles_of_flat_edges(o, l, &xy, &n, err);
        if (st == IL_OK && n > 0) {
            st = il_overlay_add_points(o, xy, n, err);
            il_labels_free(l);
            if (st == IL_OK)
                st = il_labels_assign(l, o, err);
        }
        il_free(xy);
    }
    return st;
}

/* Number the sheets' components; triangles that are no sheet get IL_NONE. */
static bool number_components(il_heights *h, const il_overlay *o)
{
    h->component = il_alloc(o->n_triangles, sizeof *h->component);
    uint32_t *todo = il_alloc(o->n_triangles, sizeof *todo);
    bool ok = h->component && todo;
    if (ok)
        memset(h->component, 0xFF, o->n_triangles * sizeof *h->component);
    for (uint32_t seed = 0; ok && seed < o->n_triangles; seed++) {
        if (!il_overlay_is_sheet(o, seed) || h->component[seed] != IL_NONE)
            continue;
        size_t n = 0;
        uint32_t c = (uint32_t)h->n_components++;
        h->component[seed] = c;
        todo[n++] = seed;
        while (n > 0) {
            uint32_t t = todo[--n];
            for (size_t e = 3 * (size_t)t; e < 3 * (size_t)t + 3; e++) {
                uint32_t u = o->across[e];
                if (o->edge[e] & IL_EDGE_CONTOUR || !il_overlay_is_sheet(o, u) || h->component[u] != IL_NONE)
                    continue;
                h->component[u] = c;
                todo[n++] = u;
            }
        }
    }
    il_free(todo);
    return ok;
}

/* Contour point P in the plane of its slice, grid units. */
static void own_point(const il_overlay *o, uint32_t p, int plane, double out[2])
{
    const il_snapped *grid = o->snapped;
    memcpy(out, o->xy + 2 * p, 2 * sizeof *out);
    if (plane != IL_UPPER || !o->reference->deformed)
        return;
    il_overlay_upper_point(o, p, out);
    for (size_t c = 0; c < 2; c++)
        out[c] = (out[c] - grid->origin[c]) / grid->cell;
}

il_status il_heights_build(il_heights *h, const il_overlay *o, il_error *err)
{
    memset(h, 0, sizeof *h);
    il_segment *segment = NULL;
    size_t n = 0, cap = 0;
    bool ok = number_components(h, o);
    for (uint32_t e = 0; ok && e < 3 * o->n_triangles; e++) {
        if (!il_overlay_is_sheet(o, e / 3) || !(o->edge[e] & IL_EDGE_CONTOUR))
            continue;
        ok = il_grow(&segment, &cap, n + 1, sizeof *segment);
        if (!ok)
            break;
        double a[2], b[2];
        int plane = il_edge_plane(o, e);
        own_point(o, o->corner[e], plane, a);
        own_point(o, o->corner[e % 3 == 2 ? e - 2 : e + 1], plane, b);
        segment[n++] = (il_segment){ a[0], a[1], b[0], b[1], 2 * (size_t)h->component[e / 3] + (size_t)plane, 0 };
    }
    if (!ok) {
        il_free(segment);
        il_heights_free(h);
        return il_fail_nomem(err);
    }
    il_status st = il_nearest_build(&h->tree, segment, n, 2 * h->n_components, err);
    if (st != IL_OK)
        il_heights_free(h);
    return st;
}

void il_heights_free(il_heights *h)
{
    il_free(h->component);
    il_nearest_free(&h->tree);
    memset(h, 0, sizeof *h);
}

static double dome(double d, double d_max, double rise)
{
    double s = 1 - d / d_max;
    return rise * sqrt(fmax(0, 1 - s * s));
}

il_status il_heights_set(const il_heights *h, il_free_point *p, size_t n, double rise, il_error *err)
{
    double *d_max = il_calloc(h->n_components, sizeof *d_max);
    double *d = il_alloc(n, 2 * sizeof *d);
    if (!d_max || !d) {
        il_free(d_max);
        il_free(d);
        return il_fail_nomem(err);
    }
    for (size_t i = 0; i < n; i++) {
        size_t class = 2 * (size_t)p[i].component;
        d[2 * i] = il_nearest_distance(&h->tree, class, p[i].x, p[i].y);
        d[2 * i + 1] = il_nearest_distance(&h->tree, class + 1, p[i].x + p[i].shift[0], p[i].y + p[i].shift[1]);
        double least = fmin(d[2 * i], d[2 * i + 1]);
        d_max[p[i].component] = fmax(d_max[p[i].component], least);
    }
    for (size_t i = 0; i < n; i++) {
        double lower = d[2 * i], upper = d[2 * i + 1], z;
        if (isinf(upper))
            z = dome(lower, d_max[p[i].component], rise);
        else if (isinf(lower))
            z = 1 - dome(upper, d_max[p[i].component], rise);
        else
            z = lower / (lower + upper);
        p[i].z = fmin(fmax(z, IL_INNER_LEAST), 1 - IL_INNER_LEAST);
    }
    il_free(d_max);
    il_free(d);
    return IL_OK;
}
