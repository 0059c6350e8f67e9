/* ends.c - what a stream with pair records says of arcs that end, against the solid.
 *
 *     ends MESH MATCHED
 *
 * MESH is a closed mesh as for tests/truth.c, MATCHED the native stream that `isoloft match` makes
 * of its contours.  From the middle of each contour edge the solid's surface goes on to the next
 * plane, or ends before it, at the tip of a tongue, in a groove, as a cap: tests/fate.c follows it.
 * MATCHED says of the edge that it corresponds, by phi or as the slices lie, that it has no
 * partner, because of a branch, a cap or a hole, nothing (its phi is not trusted, and as it lies
 * it has no partner), or that its whole ring is alone.  Prints three lines of eight lengths,
 *
 *     NAME  PHI LIE  BRANCH CAP HOLE  NOTHING ALONE
 *
 * with NAME "on", "ends" and "unknown", for edges that do not lie on the solid (contours that
 * had to be repaired). */
#include "config.h"
#include "fate.h"
#include "gathered.h"
#include "base/alloc.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum verdict { PHI, LIE, BRANCH, CAP, HOLE, NOTHING, ALONE, N_VERDICTS } verdict;
enum { ON, ENDS, UNKNOWN, N_FATES };

/* Nearer to a plane's way through the mesh, in sizes of the mesh, a point of a contour is on it. */
static const double ON_MESH = 1e-5;

/* The ways of a plane through triangles tri[n], from (x, y) to (x, y) at at[4 n]. */
typedef struct ways {
    uint32_t *tri;  size_t n, cap;
    double *at;     size_t cap_at;
} ways;

typedef struct score { double length[N_FATES][N_VERDICTS]; } score;

/* ---- what the stream says --------------------------------------------------------- */

/* said[r][v] of the edge from vertex v of ring r on. */
static verdict **nothing_said(const il_slice *s)
{
    verdict **said = solid_must(il_alloc(s->n, sizeof *said));
    for (size_t r = 0; r < s->n; r++) {
        said[r] = solid_must(il_alloc(s->ring[r].n, sizeof **said));
        for (size_t v = 0; v < s->ring[r].n; v++)
            said[r][v] = NOTHING;
    }
    return said;
}

static void free_said(verdict **said, size_t n)
{
    for (size_t r = 0; r < n; r++)
        il_free(said[r]);
    il_free(said);
}

/* Edges are in the arc when their middles are. */
static void say(verdict **said, const il_slice *s, const il_arc *a, verdict what)
{
    size_t n = s->ring[a->from.ring].n, v = (a->from.vertex + (a->from.t > 0.5)) % n, end = (a->to.vertex + (a->to.t > 0.5)) % n;
    bool whole = il_place_compare(&a->from, &a->to) == 0;
    if (v == end && !whole)
        return;
    do {
        said[a->from.ring][v] = what;
        v = (v + 1) % n;
    } while (v != end);
}

static void say_alone(verdict **said, const il_slice *s, const il_pair *p, bool upper)
{
    if (p->n_groups == 0 && !p->gap)
        return;
    bool *has = solid_must(il_calloc(s->n, sizeof *has));
    for (size_t i = 0; i < p->n_groups; i++) {
        const il_group *g = &p->group[i];
        for (size_t k = 0; g->n_lower > 0 && g->n_upper > 0 && k < (upper ? g->n_upper : g->n_lower); k++)
            has[upper ? g->upper[k] : g->lower[k]] = true;
    }
    for (size_t r = 0; r < s->n; r++)
        for (size_t v = 0; v < s->ring[r].n && !has[r]; v++)
            said[r][v] = ALONE;
    il_free(has);
}

static verdict **take_record(const il_slice *s, const il_pair *p, bool upper)
{
    static const verdict of_event[] = { [IL_EVENT_BRANCH] = BRANCH, [IL_EVENT_CAP] = CAP, [IL_EVENT_HOLE] = HOLE };
    verdict **said = nothing_said(s);
    for (size_t i = 0; i < p->n_unmatched; i++)
        if (p->unmatched[i].upper == upper)
            say(said, s, &p->unmatched[i].arc, of_event[p->unmatched[i].event]);
    for (int lie = 1; lie >= 0; lie--)
        for (size_t i = 0; i < p->n_matches; i++)
            if (p->match[i].as_they_lie == lie)
                say(said, s, upper ? &p->match[i].upper : &p->match[i].lower, lie ? LIE : PHI);
    say_alone(said, s, p, upper);
    return said;
}

/* ---- what the solid says ------------------------------------------------------------ */

static void find_ways(ways *w, const solid *s, uint32_t plane)
{
    w->n = 0;
    for (size_t t = 0; t < s->n_triangles; t++) {
        if (solid_least_slab(s, t) > plane || solid_greatest_slab(s, t) <= plane)
            continue;
        if (!il_grow(&w->tri, &w->cap, w->n + 1, sizeof *w->tri) || !il_grow(&w->at, &w->cap_at, 4 * (w->n + 1), sizeof *w->at))
            solid_must(NULL);
        solid_cross(s, t, plane, 1, w->at + 4 * w->n);
        solid_cross(s, t, plane, -1, w->at + 4 * w->n + 2);
        w->tri[w->n++] = (uint32_t)t;
    }
}

static double distance_to_way(const double *at, const double p[2])
{
    double dx = at[2] - at[0], dy = at[3] - at[1], length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? fmin(fmax(((p[0] - at[0]) * dx + (p[1] - at[1]) * dy) / length2, 0), 1) : 0;
    return hypot(at[0] + t * dx - p[0], at[1] + t * dy - p[1]);
}

static int fate_of(const fates *f, const ways *w, const double p[2], uint32_t plane, bool up)
{
    double least = INFINITY;
    size_t nearest = 0;
    for (size_t k = 0; k < w->n && least > 0; k++) {
        double d = distance_to_way(w->at + 4 * k, p);
        if (d < least) {
            least = d;
            nearest = k;
        }
    }
    if (!(least < ON_MESH * f->s->size))
        return UNKNOWN;
    return fates_goes_on(f, w->tri[nearest], p, plane, up) ? ON : ENDS;
}

/* ---- both ----------------------------------------------------------------------------- */

static void count_slice(score *to, const fates *f, const ways *w, const il_slice *s, const il_pair *p, uint32_t plane, bool up)
{
    verdict **said = take_record(s, p, !up);
    for (size_t r = 0; r < s->n; r++) {
        const il_ring *ring = &s->ring[r];
        for (size_t v = 0; v < ring->n; v++) {
            const double *a = ring->xy + 2 * v, *b = ring->xy + 2 * (v + 1 < ring->n ? v + 1 : 0);
            double middle[2] = { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 };
            to->length[fate_of(f, w, middle, plane, up)][said[r][v]] += hypot(b[0] - a[0], b[1] - a[1]);
        }
    }
    free_said(said, s->n);
}

static void tell(const solid *s, const gathered *g)
{
    static const char *const name[] = { "on", "ends", "unknown" };
    score all = { 0 };
    ways w = { 0 };
    fates f;
    fates_find(&f, s);
    for (uint32_t k = 0; k < g->n; k++) {
        find_ways(&w, s, k);
        if (k > 0)
            count_slice(&all, &f, &w, &g->slice[k], &g->pair[k], k, false);
        if (k + 1 < g->n)
            count_slice(&all, &f, &w, &g->slice[k], &g->pair[k + 1], k, true);
    }
    for (int i = 0; i < N_FATES; i++) {
        fputs(name[i], stdout);
        for (int v = 0; v < N_VERDICTS; v++)
            printf(" %.6g", all.length[i][v]);
        putchar('\n');
    }
    fates_free(&f);
    il_free(w.tri);
    il_free(w.at);
}

int main(int argc, char **argv)
{
    gathered g;
    solid s = SOLID_INIT;
    il_error err = IL_ERROR_INIT;
    if (argc != 3) {
        fputs("usage: ends MESH MATCHED\n", stderr);
        return IL_E_USAGE;
    }
    il_status st = gathered_read(&g, argv[2], &err);
    double *z = solid_must(il_alloc(g.n + 1, sizeof *z));
    for (size_t k = 0; k < g.n; k++)
        z[k] = g.slice[k].z;
    if (st != IL_OK) {
        fprintf(stderr, "ends: %s\n", err.text);
    } else if (!solid_read(&s, argv[1])) {
        st = IL_E_INPUT;
    } else {
        solid_cut(&s, z, g.n);
        tell(&s, &g);
    }
    gathered_free(&g);
    solid_free(&s);
    il_free(z);
    return (int)st;
}
