#include "config.h"
#include "judge.h"
#include "base/alloc.h"
#include "model/lattice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells between samples, and the longest piece of the moved outline: chords of a
 * curve of radius 2 are off by STEP^2 / 16 = 0.016. */
static const double STEP = 0.5;
enum { MOST_PIECES = 64, BAND = 12, COARSE = 4 };
static const double GOOD_MEAN = 0.25;

/* Points, or edges as x y x y. */
typedef struct numbers { double *v; size_t n, cap; } numbers;

static void push(numbers *a, const double *v, size_t n)
{
    if (!il_grow(&a->v, &a->cap, a->n + n, sizeof *a->v))
        abort();
    memcpy(a->v + a->n, v, n * sizeof *v);
    a->n += n;
}

/* ---- distances ---- */

static double distance2_to_edge(double x, double y, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length2 : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    double ex = a[0] + t * dx - x, ey = a[1] + t * dy - y;
    return ex * ex + ey * ey;
}

double judge_distance(const pairs_outline *o, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < o->n; i++) {
        double d = distance2_to_edge(x, y, o->xy + 2 * i, o->xy + 2 * o->next[i]);
        least = d < least ? d : least;
    }
    return sqrt(least);
}

static double distance_to_edges(const numbers *edges, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i + 4 <= edges->n; i += 4) {
        double d = distance2_to_edge(x, y, edges->v + i, edges->v + i + 2);
        least = d < least ? d : least;
    }
    return sqrt(least);
}

bool judge_inside(const pairs_outline *o, double x, double y)
{
    bool in = false;
    for (size_t i = 0; i < o->n; i++) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
        if ((a[1] > y) != (b[1] > y) && a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1])) > x)
            in = !in;
    }
    return in;
}

/* ---- samples of an outline ---- */

static size_t pieces_of(double length)
{
    double n = ceil(length / STEP);
    return n < 1 ? 1 : n > MOST_PIECES ? MOST_PIECES : (size_t)n;
}

static double edge_length(const double *a, const double *b)
{
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* phi of the point at T on the edge from A to B. */
static void moved(const il_fit *phi, const double *a, const double *b, double t, double to[2])
{
    for (int c = 0; c < 2; c++)
        to[c] = (1 - t) * a[c] + t * b[c];
    il_fit_apply(phi, to, 1);
}

/* A mean weighted by length, and the greatest. */
typedef struct tally { double sum, weight, most; } tally;

static void count(tally *t, double value, double weight)
{
    t->sum += weight * value;
    t->weight += weight;
    t->most = value > t->most || isnan(value) ? value : t->most;
}

/* ---- the residuals ---- */

static tally measure_up(const pairs_pair *p, const il_fit *phi)
{
    tally t = { 0 };
    const pairs_outline *u = &p->upper;
    for (size_t i = 0; i < u->n; i++) {
        const double *a = u->xy + 2 * i, *b = u->xy + 2 * u->next[i];
        size_t n = pieces_of(edge_length(a, b));
        for (size_t k = 0; k < n; k++) {
            double q[2];
            moved(phi, a, b, ((double)k + .5) / (double)n, q);
            count(&t, judge_distance(&p->lower, q[0], q[1]), edge_length(a, b) / (double)n);
        }
    }
    return t;
}

/* phi of the piece of the edge from A to B between T0 and T1, where its ends are
 * at P and Q, in pieces that are short where it goes. */
static void push_moved(numbers *edges, const il_fit *phi, const double *a, const double *b, const double t[2],
                       const double p[2], const double q[2])
{
    size_t n = pieces_of(edge_length(p, q));
    double e[4];
    memcpy(e, p, sizeof *p * 2);
    for (size_t k = 1; k < n; k++) {
        moved(phi, a, b, t[0] + (t[1] - t[0]) * (double)k / (double)n, e + 2);
        push(edges, e, 4);
        memcpy(e, e + 2, sizeof *e * 2);
    }
    memcpy(e + 2, q, sizeof *q * 2);
    push(edges, e, 4);
}

/* phi(upper) as short edges; and into *STRETCH its log stretch, squared. */
static numbers moved_edges(const pairs_outline *u, const il_fit *phi, tally *stretch)
{
    numbers edges = { 0 };
    for (size_t i = 0; i < u->n; i++) {
        const double *a = u->xy + 2 * i, *b = u->xy + 2 * u->next[i];
        double length = edge_length(a, b), p[2], q[2];
        size_t n = pieces_of(length);
        moved(phi, a, b, 0, p);
        for (size_t k = 0; k < n; k++) {
            double t[2] = { (double)k / (double)n, (double)(k + 1) / (double)n };
            moved(phi, a, b, t[1], q);
            push_moved(&edges, phi, a, b, t, p, q);
            double by = log(edge_length(p, q) * (double)n / length);
            count(stretch, by * by, length / (double)n);
            memcpy(p, q, sizeof p);
        }
    }
    return edges;
}

static tally measure_down(const pairs_outline *l, const numbers *edges)
{
    tally t = { 0 };
    for (size_t i = 0; i < l->n; i++) {
        const double *a = l->xy + 2 * i, *b = l->xy + 2 * l->next[i];
        size_t n = pieces_of(edge_length(a, b));
        for (size_t k = 0; k < n; k++) {
            double s = ((double)k + .5) / (double)n;
            double x = (1 - s) * a[0] + s * b[0], y = (1 - s) * a[1] + s * b[1];
            count(&t, distance_to_edges(edges, x, y), edge_length(a, b) / (double)n);
        }
    }
    return t;
}

/* ---- folds ---- */

/* The determinant of phi's derivative: the product along the way of P. */
static double jacobian(const il_fit *phi, double x, double y)
{
    const double *g = phi->global;
    double p[2] = { g[0] * x + g[1] * y + g[4], g[2] * x + g[3] * y + g[5] };
    double j = g[0] * g[3] - g[1] * g[2];
    for (size_t k = 0; k < phi->n_lattices; k++) {
        j *= il_lattice_jacobian(&phi->lattice[k], p);
        il_lattice_apply(&phi->lattice[k], p, 1);
    }
    return j;
}

/* Nodes of the frame's grid, marked where the outline is within BAND cells. */
static void mark_band(const pairs_outline *o, bool near[PAIRS_FRAME + 1][PAIRS_FRAME + 1])
{
    for (size_t i = 0; i < o->n; i++) {
        int cx = (int)lround(o->xy[2 * i]), cy = (int)lround(o->xy[2 * i + 1]);
        for (int y = cy - BAND; y <= cy + BAND; y++)
            for (int x = cx - BAND; x <= cx + BAND; x++)
                if (x >= 0 && y >= 0 && x <= PAIRS_FRAME && y <= PAIRS_FRAME &&
                    (x - cx) * (x - cx) + (y - cy) * (y - cy) <= BAND * BAND)
                    near[y][x] = true;
    }
}

static double lesser(double least, double v)
{
    return v < least || isnan(v) ? v : least;
}

static double least_jacobian(const pairs_outline *u, const il_fit *phi)
{
    bool near[PAIRS_FRAME + 1][PAIRS_FRAME + 1] = { { false } };
    double least = INFINITY;
    mark_band(u, near);
    for (int y = 0; y <= PAIRS_FRAME; y++)
        for (int x = 0; x <= PAIRS_FRAME; x++)
            if (near[y][x] || (x % COARSE == 0 && y % COARSE == 0))
                least = lesser(least, jacobian(phi, x, y));
    for (size_t i = 0; i < u->n; i++) {
        const double *a = u->xy + 2 * i, *b = u->xy + 2 * u->next[i];
        size_t n = pieces_of(edge_length(a, b));
        for (size_t k = 0; k < n; k++) {
            double t = (double)k / (double)n;
            least = lesser(least, jacobian(phi, (1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]));
        }
    }
    return least;
}

/* ---- truth ---- */

static double off_truth(const pairs_pair *p, const il_fit *phi)
{
    double sum = 0;
    if (!p->has_truth)
        return NAN;
    for (size_t i = 0; i < p->upper.n; i++) {
        double at[2] = { p->upper.xy[2 * i], p->upper.xy[2 * i + 1] };
        il_fit_apply(phi, at, 1);
        sum += edge_length(at, p->lower.xy + 2 * i);
    }
    return sum / (double)p->upper.n;
}

judged judge(const pairs_pair *p, const il_fit *phi)
{
    tally stretch = { 0 };
    tally up = measure_up(p, phi);
    numbers edges = moved_edges(&p->upper, phi, &stretch);
    tally down = measure_down(&p->lower, &edges);
    il_free(edges.v);
    return (judged){
        .up_mean = up.sum / up.weight, .up_max = up.most,
        .down_mean = down.sum / down.weight, .down_max = down.most,
        .least_jacobian = least_jacobian(&p->upper, phi),
        .distortion = sqrt(stretch.sum / stretch.weight),
        .off_truth = off_truth(p, phi),
    };
}

bool judged_solved(const judged *j)
{
    return j->up_mean < GOOD_MEAN && j->down_mean < GOOD_MEAN && j->least_jacobian > 0;
}
