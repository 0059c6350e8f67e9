#include "config.h"
#include "match/wrap.h"
#include "base/alloc.h"
#include "match/global.h"

#include <math.h>
#include <string.h>

enum { STEPS = IL_WRAP_STEPS, BAND = STEPS / 6 };

/* How much of the way the points decide, and how much its length. */
static const double BY_POINTS = 0.85;

static void free_loop(il_loop *l)
{
    il_free(l->xy);
    il_free(l->along);
}

void il_wrap_free(il_wrap *w)
{
    free_loop(&w->from);
    free_loop(&w->to);
    *w = (il_wrap){ .from = { NULL, NULL, 0 } };
}

/* ---- outlines -------------------------------------------------------------------- */

static il_status take_loop(il_loop *l, const il_piece *p, bool *simple, il_error *err)
{
    l->xy = il_alloc(p->n + 1, 2 * sizeof *l->xy);
    l->along = il_alloc(p->n + 1, sizeof *l->along);
    if (!l->xy || !l->along)
        return il_fail_nomem(err);
    l->along[0] = 0;
    for (size_t k = 0, at = 0; k <= p->n; k++, at = p->next[at]) {
        memcpy(l->xy + 2 * k, p->xy + 2 * at, 2 * sizeof *l->xy);
        if (k > 0)
            l->along[k] = l->along[k - 1] + hypot(l->xy[2 * k] - l->xy[2 * k - 2], l->xy[2 * k + 1] - l->xy[2 * k - 1]);
        if (k > 0 && at == 0) {
            l->n = k;
            break;
        }
    }
    *simple = *simple && l->n == p->n && l->n >= 3 && l->along[l->n] > 0;
    return IL_OK;
}

/* The point STEP / STEPS of the way along L, STEP of any size. */
static void point_at(const il_loop *l, double step, double out[2])
{
    double s = (step / STEPS - floor(step / STEPS)) * l->along[l->n];
    size_t low = 0, high = l->n;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (l->along[middle] <= s)
            low = middle;
        else
            high = middle;
    }
    double length = l->along[high] - l->along[low], t = length > 0 ? (s - l->along[low]) / length : 0;
    for (size_t c = 0; c < 2; c++)
        out[c] = l->xy[2 * low + c] + t * (l->xy[2 * high + c] - l->xy[2 * low + c]);
}

/* How far along L, in steps, the place nearest to P is. */
static double nearest_step(const il_loop *l, const double p[2])
{
    double least = INFINITY, at = 0;
    for (size_t k = 0; k < l->n; k++) {
        const double *a = l->xy + 2 * k, *b = a + 2;
        double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? fmin(fmax(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / l2, 0), 1) : 0;
        double away = hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
        if (away < least) {
            least = away;
            at = l->along[k] + t * (l->along[k + 1] - l->along[k]);
        }
    }
    return at / l->along[l->n] * STEPS;
}

/* ---- in step ------------------------------------------------------------------------ */

static double square(const double *p, const double *q)
{
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

/* By how many steps point i of U should run ahead of point i of L, for the least sum of squares. */
static int best_lead(const double *u, const double *l)
{
    double least = INFINITY;
    int best = 0;
    for (int lead = 0; lead < STEPS; lead++) {
        double sum = 0;
        for (int i = 0; i < STEPS; i++)
            sum += square(u + 2 * i, l + 2 * ((i + lead) % STEPS));
        if (sum < least) {
            least = sum;
            best = lead;
        }
    }
    return best;
}

/* The least sum of squares over the ways from (0, 0) to (STEPS, STEPS) by (1, 0), (0, 1) and
 * (1, 1) that keep within BAND of the straight one: cost[i][j - i + BAND]. */
typedef struct ways {
    double cost[STEPS + 1][2 * BAND + 1];
} ways;

static double cost_at(const ways *w, int i, int j)
{
    int d = j - i + BAND;
    return i < 0 || j < 0 || d < 0 || d > 2 * BAND ? INFINITY : w->cost[i][d];
}

static void fill(ways *w, const double *u, const double *l, int first, int lead)
{
    for (int i = 0; i <= STEPS; i++)
        for (int d = 0; d <= 2 * BAND; d++) {
            int j = i + d - BAND;
            double before = fmin(fmin(cost_at(w, i - 1, j), d > 0 ? cost_at(w, i, j - 1) : INFINITY), cost_at(w, i - 1, j - 1));
            bool outside = j < 0 || j > STEPS;
            before = i == 0 && j == 0 ? 0 : before;
            w->cost[i][d] = outside ? INFINITY : before + square(u + 2 * ((first + i) % STEPS), l + 2 * ((first + lead + j) % STEPS));
        }
}

/* mean[i]: the middle of the steps of L that point i goes with. */
static void trace(const ways *w, double mean[STEPS + 1])
{
    double sum[STEPS + 1] = { 0 }, count[STEPS + 1] = { 0 };
    for (int i = STEPS, j = STEPS; i >= 0;) {
        sum[i] += j;
        count[i]++;
        double both = cost_at(w, i - 1, j - 1), left = cost_at(w, i - 1, j), down = cost_at(w, i, j - 1);
        if (i == 0 && j == 0)
            break;
        if (both <= left && both <= down)
            i--, j--;
        else if (left <= down)
            i--;
        else
            j--;
    }
    for (int i = 0; i <= STEPS; i++)
        mean[i] = count[i] > 0 ? sum[i] / count[i] : i;
}

/* The point that fits best when all run with the same lead. */
static int best_pair(const double *u, const double *l, int lead)
{
    int best = 0;
    for (int i = 1; i < STEPS; i++)
        if (square(u + 2 * i, l + 2 * ((i + lead) % STEPS)) < square(u + 2 * best, l + 2 * ((best + lead) % STEPS)))
            best = i;
    return best;
}

static il_status walk_together(il_wrap *w, const double *u, const double *l, il_error *err)
{
    int lead = best_lead(u, l), first = best_pair(u, l, lead);
    double mean[STEPS + 1];
    ways *table = il_alloc(1, sizeof *table);
    if (!table)
        return il_fail_nomem(err);
    fill(table, u, l, first, lead);
    trace(table, mean);
    il_free(table);
    for (int i = 0; i < STEPS; i++) {
        double at = first + lead + BY_POINTS * mean[i] + (1 - BY_POINTS) * i;
        w->at[(first + i) % STEPS] = first + i < STEPS ? at : at - STEPS;
    }
    w->at[STEPS] = w->at[0] + STEPS;
    return IL_OK;
}

il_status il_wrap_begin(il_wrap *w, const il_piece *from, const il_piece *to, bool *simple, il_error *err)
{
    double u[2 * STEPS], l[2 * STEPS];
    il_outline upper = il_piece_outline(from), lower = il_piece_outline(to);
    il_global g = IL_GLOBAL_IDENTITY;
    *w = (il_wrap){ .from = { NULL, NULL, 0 } };
    *simple = true;
    il_status st = take_loop(&w->from, from, simple, err);
    if (st == IL_OK)
        st = take_loop(&w->to, to, simple, err);
    if (st != IL_OK || !*simple)
        return st;
    *simple = il_global_by_moments(&lower, &upper, &g);
    for (int i = 0; i < STEPS; i++) {
        double p[2];
        point_at(&w->from, i, p);
        point_at(&w->to, i, l + 2 * i);
        u[2 * i] = g.a[0] * p[0] + g.a[1] * p[1] + g.a[4];
        u[2 * i + 1] = g.a[2] * p[0] + g.a[3] * p[1] + g.a[5];
    }
    return *simple ? walk_together(w, u, l, err) : IL_OK;
}

double il_wrap_distortion(const il_wrap *w)
{
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double stretch = log(w->at[i + 1] - w->at[i]);
        sum += stretch * stretch;
    }
    return sqrt(sum / STEPS);
}

void il_wrap_apply(const il_wrap *w, double p[2])
{
    double step = nearest_step(&w->from, p);
    int i = (int)fmin(step, STEPS - 1);
    point_at(&w->to, w->at[i] + (step - i) * (w->at[i + 1] - w->at[i]), p);
}
