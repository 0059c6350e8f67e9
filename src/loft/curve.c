#include "config.h"
#include "loft/curve.h"
#include "base/alloc.h"
#include "base/number.h"
#include "base/sort.h"
#include "loft/bends.h"
#include "loft/certificate.h"
#include "loft/levels.h"
#include "model/mesh.h"

#include <math.h>
#include <string.h>

/* Bends are halved HALVINGS times, then dropped DROPS times about what still meets. */
enum { HALVINGS = 5, DROPS = 3 };

/* xyz[3*n]: vertices in a row (il_surface_row), inner ones raised; weight[v]: how much of its
 * bend is taken. */
typedef struct curve {
    const il_surface *s;
    const il_section *section[2];
    il_bends bends;
    double height, level[IL_LEVELS_MOST];
    size_t n_levels;
    double *xyz, *weight;
    bool round_float;
} curve;

/* ---- where points go ------------------------------------------------------------- */

static void move(const void *self, size_t a, size_t b, double f, double p[3])
{
    const curve *c = self;
    double t = (p[2] - c->section[0]->z) / c->height, low = t * (1 - t) * (1 - t), high = t * t * (1 - t);
    const double *ba = c->bends.of + 6 * a, *bb = c->bends.of + 6 * b;
    double wa = (1 - f) * c->weight[a], wb = f * c->weight[b];
    for (int k = 0; k < 2; k++) {
        p[k] += c->height * (low * (wa * ba[k] + wb * bb[k]) - high * (wa * ba[3 + k] + wb * bb[3 + k]));
        p[k] = c->round_float ? il_number_round_float(p[k]) : p[k];
    }
}

/* On a level rather than so near to it that the points of its edges there would be a hair away. */
static double snap(const curve *c, double z)
{
    double near = c->height / (double)(c->n_levels + 1) / 16;
    for (size_t k = 0; k < c->n_levels; k++)
        if (fabs(z - c->level[k]) < near)
            return c->level[k];
    return z;
}

/* The inner points as they stand on the straight surface, then each by its slopes. */
static void raise_inner(curve *c)
{
    size_t first = c->section[0]->n_nodes + c->section[1]->n_nodes;
    for (size_t i = 0; i < c->s->n_inner; i++) {
        double *p = c->xyz + 3 * (first + i);
        const double *b = c->bends.of + 6 * (first + i);
        memcpy(p, c->s->inner + 3 * i, 3 * sizeof *p);
        double t = (p[2] - c->section[0]->z) / c->height, w = c->weight[first + i];
        double r0 = fmax(1 + w * b[2], 0), r1 = fmax(1 + w * b[5], 0);
        t = (t * t + r0 * t * (1 - t)) / (1 + (r0 + r1 - 2) * t * (1 - t));
        p[2] = c->section[0]->z + c->height * fmin(fmax(t, IL_INNER_LEAST), 1 - IL_INNER_LEAST);
        p[2] = snap(c, c->round_float ? il_number_round_float(p[2]) : p[2]);
    }
}

/* ---- how many contours -------------------------------------------------------------- */

/* A chord over 1 / (n + 1) of the height is off a cubic of bend b by about b / 2 (n + 1)^2 where
 * it is most curved, which is at the contour. */
static il_status count_levels(const curve *c, size_t *n, il_error *err)
{
    size_t n_nodes = c->section[0]->n_nodes + c->section[1]->n_nodes;
    double *bend = il_alloc(n_nodes, sizeof *bend);
    if (!bend)
        return il_fail_nomem(err);
    for (size_t v = 0; v < n_nodes; v++) {
        const double *b = c->bends.of + 6 * v + (v < c->section[0]->n_nodes ? 0 : 3);
        bend[v] = hypot(b[0], b[1]);
    }
    il_sort_doubles(bend, n_nodes);
    double most = n_nodes > 0 ? bend[n_nodes - 1 - n_nodes / 10] : 0, pieces = ceil(sqrt(most / (2 * IL_CURVE_TOLERANCE)));
    *n = pieces < 1 ? 0 : (size_t)fmin(pieces - 1, IL_CURVE_BETWEEN_MOST);
    il_free(bend);
    return IL_OK;
}

static void set_levels(curve *c, size_t n)
{
    for (size_t k = 1; k <= n; k++) {
        double z = c->section[0]->z + c->height * (double)k / (double)(n + 1);
        z = c->round_float ? il_number_round_float(z) : z;
        if (z > (c->n_levels > 0 ? c->level[c->n_levels - 1] : c->section[0]->z) && z < c->section[1]->z)
            c->level[c->n_levels++] = z;
    }
}

/* ---- what meets ------------------------------------------------------------------------ */

/* At the corners of the triangles of S that pair[2*n] lists: FACTOR times the bends. */
static void weaken(curve *c, const uint32_t *pair, size_t n, double factor, unsigned char *mark)
{
    size_t n_vertices = c->bends.n;
    memset(mark, 0, n_vertices);
    for (size_t i = 0; i < 2 * n; i++)
        for (size_t k = 0; k < 3; k++)
            mark[il_surface_row(c->section[0], c->section[1], c->s->tri[3 * (size_t)pair[i] + k])] = 1;
    for (size_t v = 0; v < n_vertices; v++)
        c->weight[v] *= mark[v] ? factor : 1;
}

/* Parts of BENT that meet, in pairs; one without area is a pair with itself. */
typedef struct meetings {
    uint32_t *pair;
    size_t n, cap;
} meetings;

/* moved[v]: vertices whose parts are not as they were when they last were tested. */
static void mark_parts(const curve *c, const il_surface *bent, const uint32_t *parent, const unsigned char *moved,
                       unsigned char *touched)
{
    for (size_t t = 0; t < bent->n_triangles; t++) {
        touched[t] = 0;
        for (size_t k = 0; k < 3; k++)
            touched[t] |= moved[il_surface_row(c->section[0], c->section[1], c->s->tri[3 * (size_t)parent[t] + k])] != 0;
    }
}

static bool add_flat(const curve *c, const il_surface *bent, const unsigned char *touched, meetings *m)
{
    for (size_t t = 0; t < bent->n_triangles; t++) {
        double p[3][3];
        for (size_t k = 0; k < 3; k++)
            il_surface_position(bent, c->section[0], c->section[1], bent->tri[3 * t + k], p[k]);
        if (!touched[t] || il_triangle_has_area(p[0], p[1], p[2]))
            continue;
        if (!il_grow(&m->pair, &m->cap, m->n + 1, 2 * sizeof *m->pair))
            return false;
        m->pair[2 * m->n] = m->pair[2 * m->n + 1] = (uint32_t)t;
        m->n++;
    }
    return true;
}

/* The triangles of S whose parts in BENT meet, where they are not tested yet. */
static il_status find_meeting(const curve *c, const il_surface *bent, const uint32_t *parent, const unsigned char *moved,
                              meetings *m, il_error *err)
{
    unsigned char *touched = il_alloc(bent->n_triangles, 1);
    il_status st = touched ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        mark_parts(c, bent, parent, moved, touched);
        st = il_certify_between(bent, c->section[0], c->section[1], NULL, touched, &m->pair, &m->n, err);
        m->cap = m->n;
    }
    if (st == IL_OK && !add_flat(c, bent, touched, m))
        st = il_fail_nomem(err);
    for (size_t i = 0; st == IL_OK && i < 2 * m->n; i++)
        m->pair[i] = parent[m->pair[i]];
    il_free(touched);
    return st;
}

/* Bend by the weights; what meets gets less of it for the next time.  moved[v]: as above, for this
 * time, and then for the next. */
static il_status try_bends(curve *c, double factor, il_surface *bent, unsigned char *moved, bool *sound, bool *meets, il_error *err)
{
    il_levels levels = { c->s, { c->section[0], c->section[1] }, c->xyz, c->level, c->n_levels, move, c };
    uint32_t *parent = NULL;
    meetings m = { NULL, 0, 0 };
    il_verdict v = { .flaw = IL_FLAW_CROSSING };
    raise_inner(c);
    il_status st = il_levels_cut(bent, &parent, &levels, err);
    if (st == IL_OK)
        st = find_meeting(c, bent, parent, moved, &m, err);
    *meets = m.n > 0;
    if (st == IL_OK && m.n > 0)
        weaken(c, m.pair, m.n, factor, moved);
    else if (st == IL_OK)
        st = il_certify_edges(bent, c->section[0], c->section[1], &v, err);
    *sound = st == IL_OK && v.flaw == IL_FLAW_NONE;
    il_free(parent);
    il_free(m.pair);
    return st;
}

static il_status settle(curve *c, il_surface *s, il_bending *told, il_error *err)
{
    unsigned char *moved = il_alloc(c->bends.n, 1);
    il_status st = moved ? IL_OK : il_fail_nomem(err);
    bool sound = false, meets = true;
    if (moved)
        memset(moved, 1, c->bends.n);
    for (int round = 0; st == IL_OK && meets && round <= HALVINGS + DROPS; round++) {
        il_surface bent = IL_SURFACE_INIT;
        st = try_bends(c, round < HALVINGS ? 0.5 : 0, &bent, moved, &sound, &meets, err);
        if (sound)
            il_surface_replace(s, &bent);
        il_surface_free(&bent);
        *told = (il_bending){ sound ? c->n_levels : 0, sound && round > 0, !sound };
    }
    il_free(moved);
    return st;
}

il_status il_curve_bend(il_surface *s, const il_section *lower, const il_section *upper, const il_lean lean[2],
                        const il_lean beyond[2], int between, bool round_float, il_bending *told, il_error *err)
{
    curve c = { .s = s, .section = { lower, upper }, .height = upper->z - lower->z, .round_float = round_float };
    size_t n = between > 0 ? (size_t)between : 0;
    *told = (il_bending){ 0 };
    il_status st = il_bends_find(&c.bends, s, lower, upper, lean, beyond, err);
    if (st == IL_OK && between < 0)
        st = count_levels(&c, &n, err);
    if (st == IL_OK && (n > 0 || s->n_inner > 0)) {
        set_levels(&c, n);
        c.xyz = il_surface_positions(s, lower, upper);
        c.weight = il_alloc(c.bends.n, sizeof *c.weight);
        st = c.xyz && c.weight ? IL_OK : il_fail_nomem(err);
        for (size_t v = 0; st == IL_OK && v < c.bends.n; v++)
            c.weight[v] = 1;
        if (st == IL_OK)
            st = settle(&c, s, told, err);
    }
    il_bends_free(&c.bends);
    il_free(c.xyz);
    il_free(c.weight);
    return st;
}
