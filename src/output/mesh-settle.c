#include "config.h"
#include "output/mesh-settle.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "base/number.h"
#include "bridge/intersection.h"
#include "model/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of 64 stacks of stars with 60 random points, tilted and rounded to floats,
 * three were crossed by slivers that the rounding had turned over, and settled in
 * the first round.  What needs many has no place for its vertices. */
enum { ROUNDS = 40 };

/* For sorting by place. */
typedef struct entry {
    double p[3];
    uint32_t vertex;
} entry;

/* Vertices at one place stay together: rank[v] is the place of vertex V among the
 * n of XYZ, from 0 in their order.  target[3*n]: where the places belong;
 * at[3*n]: where they are now; bad[n]: has to go elsewhere.  unit: the last digit
 * of the largest coordinate.  part: of each vertex, its component; volume[part]:
 * as it is in XYZ, and now; hand: -1 when XYZ is mirrored. */
typedef struct settling {
    const uint32_t *tri;
    size_t n_vertices, n_triangles, n;
    bool floats;
    double unit;
    double *to;
    entry *entry;
    uint32_t *rank, *group, *part;
    double *target, *at, *volume, *volume_now, hand;
    unsigned char *bad;
    size_t n_bad, first_bad;
} settling;

bool il_frame_is_exact(const double frame[12])
{
    unsigned seen = 0;
    for (int i = 0; i < 3; i++)
        if (frame[i] != 0)
            return false;
    for (int k = 1; k < 4; k++) {
        int n = 0;
        for (int i = 0; i < 3; i++) {
            double c = frame[3 * k + i];
            if (c != 0 && fabs(c) != 1)
                return false;
            n += c != 0;
            seen |= c != 0 ? 1u << i : 0;
        }
        if (n != 1)
            return false;
    }
    return seen == 7;
}

/* ---- positions --------------------------------------------------------------- */

static int compare_entries(const void *pa, const void *pb)
{
    const entry *a = pa, *b = pb;
    for (int i = 0; i < 3; i++)
        if (a->p[i] != b->p[i])
            return a->p[i] < b->p[i] ? -1 : 1;
    return (a->vertex > b->vertex) - (a->vertex < b->vertex);
}

static bool is_same_place(const entry *a, const entry *b)
{
    return a->p[0] == b->p[0] && a->p[1] == b->p[1] && a->p[2] == b->p[2];
}

static double rounded(const settling *s, double v)
{
    return s->floats ? il_number_round_float(v) : v;
}

/* Ranks by XYZ, and where each of the positions belongs. */
static void find_positions(settling *s, const double *xyz)
{
    double largest = 0;
    for (size_t v = 0; v < s->n_vertices; v++) {
        memcpy(s->entry[v].p, xyz + 3 * v, sizeof s->entry[v].p);
        s->entry[v].vertex = (uint32_t)v;
    }
    qsort(s->entry, s->n_vertices, sizeof *s->entry, compare_entries);
    s->n = 0;
    for (size_t k = 0; k < s->n_vertices; k++) {
        uint32_t v = s->entry[k].vertex;
        if (k == 0 || !is_same_place(&s->entry[k - 1], &s->entry[k]))
            memcpy(s->target + 3 * s->n++, s->to + 3 * (size_t)v, 3 * sizeof *s->target);
        s->rank[v] = (uint32_t)(s->n - 1);
    }
    for (size_t i = 0; i < 3 * s->n; i++) {
        s->at[i] = rounded(s, s->target[i]);
        largest = fmax(largest, fabs(s->target[i]));
    }
    s->unit = largest * (s->floats ? FLT_EPSILON : DBL_EPSILON);
}

static void put_positions(settling *s)
{
    for (size_t v = 0; v < s->n_vertices; v++)
        memcpy(s->to + 3 * v, s->at + 3 * (size_t)s->rank[v], 3 * sizeof *s->to);
}

/* ---- what is wrong --------------------------------------------------------------- */

static void mark(settling *s, size_t position)
{
    if (!s->bad[position] && s->n_bad++ == 0)
        s->first_bad = position;
    s->bad[position] = 1;
}

static void mark_triangle(settling *s, size_t t)
{
    for (int k = 0; k < 3; k++)
        mark(s, s->rank[s->tri[3 * t + (size_t)k]]);
}

/* Positions that differed and no longer do. */
static void find_merged(settling *s)
{
    for (size_t k = 0; k < s->n; k++) {
        memcpy(s->entry[k].p, s->at + 3 * k, sizeof s->entry[k].p);
        s->entry[k].vertex = (uint32_t)k;
    }
    qsort(s->entry, s->n, sizeof *s->entry, compare_entries);
    for (size_t k = 1; k < s->n; k++) {
        if (!is_same_place(&s->entry[k - 1], &s->entry[k]))
            continue;
        mark(s, s->entry[k - 1].vertex);
        mark(s, s->entry[k].vertex);
    }
}

static void find_flat(settling *s)
{
    for (size_t t = 0; t < s->n_triangles; t++) {
        const uint32_t *v = s->tri + 3 * t;
        if (!il_triangle_has_area(s->to + 3 * (size_t)v[0], s->to + 3 * (size_t)v[1], s->to + 3 * (size_t)v[2]))
            mark_triangle(s, t);
    }
}

/* Where more than this many things are wrong no other places help, and looking
 * for all pairs would take a time quadratic in what lies on one heap. */
static size_t few(const settling *s)
{
    return s->n_vertices / 8 + 64;
}

static il_status fail_close(il_error *err)
{
    return il_fail(err, IL_E_SURFACE, 0, "its surface comes too close to itself for coordinates rounded behind a turn");
}

static il_status find_crossing(settling *s, il_error *err)
{
    uint32_t *pair = NULL, first[2];
    size_t n = 0;
    /* Hardly ever does anything cross, and counting a few is quicker than listing all. */
    il_status st = il_intersections(s->to, s->n_vertices, s->tri, s->n_triangles, NULL, few(s), &n, first, err);
    if (st != IL_OK || n == 0)
        return st;
    if (n >= few(s)) {
        mark_triangle(s, first[0]);
        return fail_close(err);
    }
    for (size_t t = 0; t < s->n_triangles; t++)
        s->group[t] = (uint32_t)t;
    st = il_intersections_between(s->to, s->n_vertices, s->tri, s->n_triangles, s->group, NULL, &pair, &n, err);
    for (size_t k = 0; k < 2 * n && st == IL_OK; k++)
        mark_triangle(s, pair[k]);
    il_free(pair);
    return st;
}

/* Six times the volume of triangle T seen from the place O, in P[3*n]. */
static double volume6(const settling *s, const double *p, size_t t, const double *o)
{
    double d[3][3];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            d[k][i] = p[3 * (size_t)s->tri[3 * t + (size_t)k] + (size_t)i] - o[i];
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) + d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

/* The volumes of the components in P[3*n_vertices], each at its first vertex. */
static void find_volumes(const settling *s, const double *p, double *volume)
{
    memset(volume, 0, s->n_vertices * sizeof *volume);
    for (size_t t = 0; t < s->n_triangles; t++) {
        size_t part = il_forest_leader(s->part, s->tri[3 * t]);
        volume[part] += volume6(s, p, t, p + 3 * part);
    }
}

/* Components that are turned inside out, for they are no larger than the last
 * digits.  A frame may mirror: then all are. */
static void find_inverted(settling *s)
{
    find_volumes(s, s->to, s->volume_now);
    for (size_t v = 0; v < s->n_vertices; v++) {
        size_t part = il_forest_leader(s->part, (uint32_t)v);
        if (s->volume[part] != 0 && !(s->volume[part] * s->hand * s->volume_now[part] > 0))
            mark(s, s->rank[v]);
    }
}

static void find_components(settling *s, const double *xyz)
{
    double all = 0;
    il_forest_plant(s->part, s->n_vertices);
    for (size_t t = 0; t < s->n_triangles; t++)
        for (int k = 1; k < 3; k++)
            il_forest_join(s->part, s->tri[3 * t], s->tri[3 * t + (size_t)k]);
    find_volumes(s, xyz, s->volume);
    for (size_t v = 0; v < s->n_vertices; v++)
        all += s->volume[v];
    s->hand = all < 0 ? -1 : 1;
}

static il_status find_bad(settling *s, il_error *err)
{
    memset(s->bad, 0, s->n);
    s->n_bad = 0;
    find_merged(s);
    find_flat(s);
    find_inverted(s);
    return s->n_bad > few(s) ? fail_close(err) : find_crossing(s, err);
}

/* ---- other places ------------------------------------------------------------------ */

/* Well mixed bits of A and B (the finaliser of SplitMix64). */
static uint64_t mix(uint64_t a, uint64_t b)
{
    uint64_t x = a * UINT64_C(0x9E3779B97F4A7C15) + b;
    x = (x ^ x >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    x = (x ^ x >> 27) * UINT64_C(0x94D049BB133111EB);
    return x ^ x >> 31;
}

/* Farther with every round, up to IL_SETTLE_STEPS digits. */
static void move_bad(settling *s, size_t round)
{
    uint64_t reach = 1 + round * IL_SETTLE_STEPS / ROUNDS, choices = 2 * reach + 1;
    for (size_t k = 0; k < 3 * s->n; k++) {
        if (!s->bad[k / 3])
            continue;
        double steps = (double)(mix(k, round) % choices) - (double)reach;
        s->at[k] = rounded(s, s->target[k] + steps * s->unit);
    }
}

/* Is all of it within what the arithmetic, and floats, hold? */
static il_status check_size(const settling *s, size_t *place, il_error *err)
{
    for (size_t i = 0; i < 3 * s->n_vertices; i++) {
        *place = i / 3;
        if (s->floats && !(fabs(s->to[i]) < FLT_MAX))
            return il_fail(err, IL_E_INPUT, 0, "it is too large for the 32-bit numbers of STL");
        if (!(fabs(s->to[i]) < 1e100))
            return il_fail(err, IL_E_INPUT, 0, "its frame takes points beyond 1e100");
    }
    return IL_OK;
}

/* The least vertex at the first place that is bad. */
static size_t bad_vertex(const settling *s)
{
    size_t v = 0;
    while (s->n_bad > 0 && s->rank[v] != s->first_bad)
        v++;
    return v;
}

static il_status settle(settling *s, size_t *place, il_error *err)
{
    il_status st = IL_OK;
    for (size_t round = 0; round < ROUNDS && st == IL_OK; round++) {
        put_positions(s);
        st = find_bad(s, err);
        *place = bad_vertex(s);
        if (s->n_bad == 0)
            return st;
        move_bad(s, round);
    }
    return st == IL_OK ? fail_close(err) : st;
}

il_status il_mesh_settle(const double *xyz, double *to, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                         bool floats, size_t *place, il_error *err)
{
    settling s = { .tri = tri, .n_vertices = n_vertices, .n_triangles = n_triangles, .floats = floats, .to = to };
    il_status st = check_size(&s, place, err);
    if (st != IL_OK || n_vertices == 0)
        return st;
    s.entry = il_alloc(n_vertices, sizeof *s.entry);
    s.rank = il_alloc(n_vertices, sizeof *s.rank);
    s.group = il_alloc(n_triangles, sizeof *s.group);
    s.target = il_alloc(n_vertices, 3 * sizeof *s.target);
    s.at = il_alloc(n_vertices, 3 * sizeof *s.at);
    s.bad = il_alloc(n_vertices, 1);
    s.part = il_alloc(n_vertices, sizeof *s.part);
    s.volume = il_alloc(n_vertices, sizeof *s.volume);
    s.volume_now = il_alloc(n_vertices, sizeof *s.volume_now);
    if (!s.entry || !s.rank || !s.group || !s.target || !s.at || !s.bad || !s.part || !s.volume || !s.volume_now) {
        st = il_fail_nomem(err);
    } else {
        find_positions(&s, xyz);
        find_components(&s, xyz);
        st = settle(&s, place, err);
    }
    il_free(s.entry);
    il_free(s.rank);
    il_free(s.group);
    il_free(s.target);
    il_free(s.at);
    il_free(s.bad);
    il_free(s.part);
    il_free(s.volume);
    il_free(s.volume_now);
    return st;
}
