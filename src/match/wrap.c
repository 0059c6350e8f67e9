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
    il_nearest_free(&l->edges);
}

void il_wrap_free(il_wrap *w)
{
    free_loop(&w->from);
    free_loop(&w->to);
    *w = (il_wrap){ .from = { NULL, NULL, 0, { 0 } } };
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

static il_status plant_edges(il_loop *l, il_error *err)
{
    il_segment *e = il_alloc(l->n, sizeof *e);
    if (!e)
        return il_fail_nomem(err);
    for (size_t k = 0; k < l->n; k++) {
        const double *a = l->xy + 2 * k;
        e[k] = (il_segment){ a[0], a[1], a[2], a[3], 0, k };
    }
    return il_nearest_build(&l->edges, e, l->n, 1, err);
}

/* How far along L, in steps, the place nearest to P is. */
static double nearest_step(const il_loop *l, const double p[2])
{
    il_nearest_place at = { 0, 0, 0 };
    il_nearest_point(&l->edges, 0, p[0], p[1], &at);
    return (l->along[at.id] + at.t * (l->along[at.id + 1] - l->along[at.id])) / l->along[l->n] * STEPS;
}

/* ---- in step ------------------------------------------------------------------------ */

static double square(const double *p, const double *q)
{
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

/* What is walked round: u[2*STEPS] in the plane of l[2*STEPS], and where u is pulled to:
 * pull[i] is the step of an anchor's place of l, or below 0. */
typedef struct pace {
    double u[2 * STEPS], l[2 * STEPS], pull[STEPS];
} pace;

/* The pull of an anchor, in squares of distances of so many points. */
static const double PULL = STEPS / 8;

static double cost(const pace *p, int i, int j)
{
    i %= STEPS;
    j %= STEPS;
    double sum = square(p->u + 2 * i, p->l + 2 * j);
    if (p->pull[i] >= 0)
        sum += PULL * square(p->l + 2 * ((int)p->pull[i] % STEPS), p->l + 2 * j);
    return sum;
}

/* By how many steps point i of u should run ahead of point i of l, for the least sum. */
static int best_lead(const pace *p)
{
    double least = INFINITY;
    int best = 0;
    for (int lead = 0; lead < STEPS; lead++) {
        double sum = 0;
        for (int i = 0; i < STEPS; i++)
            sum += cost(p, i, i + lead);
        if (sum < least) {
            least = sum;
            best = lead;
        }
    }
    return best;
}

/* The least sum over the ways from (0, 0) to (STEPS, STEPS) by (1, 0), (0, 1) and (1, 1) that
 * keep within BAND of the straight one: cost[i][j - i + BAND]. */
typedef struct ways {
    double cost[STEPS + 1][2 * BAND + 1];
} ways;

static double cost_at(const ways *w, int i, int j)
{
    int d = j - i + BAND;
    return i < 0 || j < 0 || d < 0 || d > 2 * BAND ? INFINITY : w->cost[i][d];
}

static void fill(ways *w, const pace *p, int first, int lead)
{
    for (int i = 0; i <= STEPS; i++)
        for (int d = 0; d <= 2 * BAND; d++) {
            int j = i + d - BAND;
            double before = fmin(fmin(cost_at(w, i - 1, j), d > 0 ? cost_at(w, i, j - 1) : INFINITY), cost_at(w, i - 1, j - 1));
            bool outside = j < 0 || j > STEPS;
            before = i == 0 && j == 0 ? 0 : before;
            w->cost[i][d] = outside ? INFINITY : before + cost(p, first + i, first + lead + j);
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

/* The point to begin with: one that is anchored, or the one that fits best when all run with
 * the same lead. */
static int best_pair(const pace *p, int lead)
{
    int best = 0;
    for (int i = 1; i < STEPS; i++)
        if (p->pull[i] >= 0 ? p->pull[best] < 0 : p->pull[best] < 0 && cost(p, i, i + lead) < cost(p, best, best + lead))
            best = i;
    return best;
}

static int lead_of(const pace *p, int i, int lead)
{
    return p->pull[i] < 0 ? lead : ((int)p->pull[i] - i + STEPS) % STEPS;
}

static il_status walk_together(il_wrap *w, const pace *p, il_error *err)
{
    int all = best_lead(p), first = best_pair(p, all), lead = lead_of(p, first, all);
    double mean[STEPS + 1];
    ways *table = il_alloc(1, sizeof *table);
    if (!table)
        return il_fail_nomem(err);
    fill(table, p, first, lead);
    trace(table, mean);
    il_free(table);
    for (int i = 0; i < STEPS; i++) {
        double at = first + lead + BY_POINTS * mean[i] + (1 - BY_POINTS) * i;
        w->at[(first + i) % STEPS] = first + i < STEPS ? at : at - STEPS;
    }
    w->at[STEPS] = w->at[0] + STEPS;
    return IL_OK;
}

static void set_pulls(pace *p, const il_wrap *w, const il_anchor *anchor, size_t n)
{
    for (int i = 0; i < STEPS; i++)
        p->pull[i] = -1;
    for (size_t k = 0; k < n; k++)
        p->pull[(int)(nearest_step(&w->from, anchor[k].from) + 0.5) % STEPS] = floor(nearest_step(&w->to, anchor[k].to) + 0.5);
}

il_status il_wrap_begin(il_wrap *w, const il_piece *from, const il_piece *to, const il_anchor *anchor, size_t n,
                        bool *simple, il_error *err)
{
    il_outline upper = il_piece_outline(from), lower = il_piece_outline(to);
    il_global g = IL_GLOBAL_IDENTITY;
    pace p;
    *w = (il_wrap){ .from = { NULL, NULL, 0, { 0 } } };
    *simple = true;
    il_status st = take_loop(&w->from, from, simple, err);
    if (st == IL_OK)
        st = take_loop(&w->to, to, simple, err);
    if (st != IL_OK || !*simple)
        return st;
    *simple = il_global_by_moments(&lower, &upper, &g);
    for (int i = 0; i < STEPS; i++) {
        double q[2];
        point_at(&w->from, i, q);
        point_at(&w->to, i, p.l + 2 * i);
        p.u[2 * i] = g.a[0] * q[0] + g.a[1] * q[1] + g.a[4];
        p.u[2 * i + 1] = g.a[2] * q[0] + g.a[3] * q[1] + g.a[5];
    }
    if (*simple)
        st = plant_edges(&w->from, err);
    if (*simple && st == IL_OK)
        st = plant_edges(&w->to, err);
    if (st != IL_OK || !*simple)
        return st;
    set_pulls(&p, w, anchor, n);
    return walk_together(w, &p, err);
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
