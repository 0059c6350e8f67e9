/* ffd.c - incremental free-form deformation of one slice's rings onto another's.
 *
 * The paper's section 3.3 after Huang, Paragios & Metaxas 2006 (IEEE Trans. Pattern
 * Anal. Mach. Intell. 28:1303-1318): a lattice of control points over the plane
 * moves all that lies in it (eq. 1 to 3), coarse lattices before fine ones, so
 * that the distance maps of the two slices become alike (eq. 4) and neighbouring
 * control points move alike (eq. 5, 6).  What is changed, and why:
 *   - Composition: each step's field is bounded to 0.48 of the lattice's spacing,
 *     under which a cubic B-spline map of the plane is one-to-one (Choi & Lee
 *     2000, Graphical Models 62:411-427: 1 / 2.0464 = 0.4886), and the next step
 *     starts from where the points are then.  A sum of increments on one lattice folds as soon as it fits.
 *   - Points of the contours instead of all pixels, both ways, by Gauss-Newton
 *     instead of gradient descent: equations.c.
 *   - The global step in closed form: global.c.
 *   - A small residual is no right correspondence.  Ladders of lattices and
 *     starts are tried until one fits without much distortion; if none does,
 *     the least distorted of those that fit is taken. */
#include "config.h"
#include "match/ffd.h"
#include "base/alloc.h"
#include "match/equations.h"
#include "match/global.h"
#include "model/lattice.h"

#include <math.h>
#include <string.h>

/* Samples of a contour, in cells; further apart where they would be more than
 * MOST_SAMPLES on a side, against contours that fill the plane. */
static const double SAMPLE_SPACING = 1.5, MOST_SAMPLES = 32768;

/* Choi & Lee's bound with some room for rounding. */
static const float BOUND = 0.48f;

/* It fits when both rms and both maxima, in cells, are below these. */
static const float ENOUGH_RMS = 0.05f, ENOUGH_MAX = 0.3f;

/* Root mean square of the log stretch below which no other start is tried, and
 * above which longer ladders are. */
static const double CONTENT = 0.2, DOUBTFUL = 0.25;

/* A level ends after this many steps, or when so many gain less than a twentieth:
 * the first attempt, which easy pairs need alone, is less patient. */
enum { MOST_STEPS = 10, PATIENCE_FIRST = 2, PATIENCE = 4 };
static const float GAIN = 0.95f;

/* Cells across / spacing, coarse to fine, ended by 0: the lattices of one attempt. */
static const unsigned LADDER[3][6] = { { 16, 32, 0 }, { 8, 16, 32, 0 }, { 4, 8, 16, 32, 64, 0 } };

/* The steps of one attempt: each field's numbers follow each other. */
typedef struct history {
    il_spline *spline;  size_t n, cap_spline;
    float *value;       size_t n_values, cap_value;
    il_global global;
    il_misfit misfit;
    double distortion;
    float least_jacobian;
    bool fits;
} history;

struct il_ffd {
    il_distance map, spare;
    il_samples upper, lower;           /* as given */
    il_samples moved;                  /* all samples of the upper, where they are */
    il_samples moving, target;         /* those that take part at the level */
    uint32_t *moving_at, *target_at; size_t cap_moving_at, cap_target_at;
    float *jacobian;                   size_t cap_jacobian; /* of moved[k] so far */
    il_equations equations;
    history now, best;
    bool best_is_last;                 /* `moved` and the partners are still those of the best */
    uint32_t cells_x, cells_y;
    double sample_spacing;
};

il_status il_ffd_new(il_ffd **out, il_error *err)
{
    *out = il_calloc(1, sizeof **out);
    return *out ? IL_OK : il_fail_nomem(err);
}

static void free_history(history *h)
{
    il_free(h->spline);
    il_free(h->value);
}

void il_ffd_free(il_ffd *f)
{
    if (!f)
        return;
    il_distance_free(&f->map);
    il_distance_free(&f->spare);
    il_samples_free(&f->upper);
    il_samples_free(&f->lower);
    il_samples_free(&f->moved);
    il_samples_free(&f->moving);
    il_samples_free(&f->target);
    il_free(f->moving_at);
    il_free(f->target_at);
    il_free(f->jacobian);
    il_equations_free(&f->equations);
    free_history(&f->now);
    free_history(&f->best);
    il_free(f);
}

/* ---- one attempt ---- */

/* All samples to where G puts them. */
static il_status start(il_ffd *f, const il_global *g, il_error *err)
{
    const double *a = g->a;
    il_status st = il_samples_copy(&f->moved, &f->upper, err);
    if (st != IL_OK || !il_grow(&f->jacobian, &f->cap_jacobian, f->moved.n, sizeof *f->jacobian))
        return st == IL_OK ? il_fail_nomem(err) : st;
    float det = (float)(a[0] * a[3] - a[1] * a[2]);
    for (size_t k = 0; k < f->moved.n; k++) {
        double x = f->upper.x[k], y = f->upper.y[k];
        f->moved.x[k] = (float)(a[0] * x + a[1] * y + a[4]);
        f->moved.y[k] = (float)(a[2] * x + a[3] * y + a[5]);
        f->jacobian[k] = det;
    }
    f->now.n = f->now.n_values = 0;
    f->now.global = *g;
    f->now.fits = false;
    return IL_OK;
}

static bool fits(const il_misfit *m)
{
    return m->forward_rms <= ENOUGH_RMS && m->backward_rms <= ENOUGH_RMS &&
           m->forward_max <= ENOUGH_MAX && m->backward_max <= ENOUGH_MAX;
}

/* Scale the step to the bound, keep it, and take all samples along. */
static il_status take_step(il_ffd *f, const il_spline *s, il_error *err)
{
    float *c = f->equations.field[0] + s->margin, most = 0;
    history *h = &f->now;
    for (size_t k = 0; k < s->size; k++)
        most = fmaxf(most, fabsf(c[k]));
    float factor = most > BOUND * s->spacing ? BOUND * s->spacing / most : 1;
    if (!il_grow(&h->spline, &h->cap_spline, h->n + 1, sizeof *h->spline) ||
        !il_grow(&h->value, &h->cap_value, h->n_values + s->size, sizeof *h->value))
        return il_fail_nomem(err);
    for (size_t k = 0; k < s->size; k++)
        h->value[h->n_values + k] = c[k] *= factor;
    h->spline[h->n++] = *s;
    h->n_values += s->size;
    il_spline_move(s, c, f->moved.x, f->moved.y, f->jacobian, f->moved.n);
    return IL_OK;
}

/* The samples that take part where nodes are SPACING apart: four to a spacing. */
static il_status choose_samples(il_ffd *f, float spacing, il_error *err)
{
    uint32_t stride = (uint32_t)(spacing / (4 * (float)f->sample_spacing) + 0.5f);
    stride = stride > 0 ? stride : 1;
    il_status st = il_samples_thin(&f->moving, &f->moving_at, &f->cap_moving_at, &f->moved, stride, err);
    if (st == IL_OK)
        st = il_samples_thin(&f->target, &f->target_at, &f->cap_target_at, &f->lower, stride, err);
    return st;
}

/* Below this many pairs of samples all of them are looked at in every step. */
enum { FEW_PAIRS = 1 << 14, ANEW_EVERY = 4 };

static il_status run_level(il_ffd *f, float spacing, int patience, il_error *err)
{
    il_spline s = il_spline_over(f->cells_x, f->cells_y, spacing);
    il_status st = choose_samples(f, spacing, err);
    if (st == IL_OK)
        st = il_equations_reserve(&f->equations, f->moving.n, f->target.n, &s, err);
    bool few = f->moving.n * f->target.n <= FEW_PAIRS;
    float before = INFINITY;
    int idle = 0;
    for (int i = 0; st == IL_OK && i < MOST_STEPS; i++) {
        il_misfit m = il_equations_fill(&f->equations, &f->moving, &f->target, &f->map, few || i % ANEW_EVERY == 0);
        float now = m.forward_rms + m.backward_rms;
        idle = now > GAIN * before ? idle + 1 : 0;
        before = now;
        if (fits(&m) || idle == patience)
            break;
        il_equations_solve(&f->equations, &f->moving, &s);
        st = take_step(f, &s, err);
        il_samples_follow(&f->moving, f->moving_at, &f->moved);
    }
    return st;
}

/* ---- judging ---- */

/* Root mean square of the logarithm of the local stretch, over that of the
 * whole, which is the mean of the logarithms. */
static double distortion(const il_samples *from, const il_samples *to)
{
    double sum = 0, squares = 0;
    for (size_t k = 0; k < from->n; k++) {
        uint32_t a = from->before[k], b = from->after[k];
        double wx = from->x[b] - from->x[a], wy = from->y[b] - from->y[a];
        double ix = to->x[b] - to->x[a], iy = to->y[b] - to->y[a];
        double was = wx * wx + wy * wy, is = ix * ix + iy * iy;
        double stretch = was > 0 && is > 0 ? 0.5 * log(is / was) : 0;
        sum += stretch;
        squares += stretch * stretch;
    }
    double n = (double)from->n, mean = sum / n;
    return sqrt(fmax(squares / n - mean * mean, 0));
}

static il_status judge(il_ffd *f, il_error *err)
{
    il_spline none = il_spline_over(1, 1, 1);
    il_samples_set_normals(&f->moved);
    il_status st = il_equations_reserve(&f->equations, f->moved.n, f->lower.n, &none, err);
    if (st != IL_OK)
        return st;
    f->now.misfit = il_equations_fill(&f->equations, &f->moved, &f->lower, &f->map, true);
    f->now.fits = fits(&f->now.misfit);
    f->now.distortion = distortion(&f->upper, &f->moved);
    f->now.least_jacobian = f->jacobian[0];
    for (size_t k = 1; k < f->moved.n; k++)
        f->now.least_jacobian = fminf(f->now.least_jacobian, f->jacobian[k]);
    return IL_OK;
}

static bool better(const history *a, const history *b)
{
    if (a->fits != b->fits)
        return a->fits;
    if (a->fits)
        return a->distortion < b->distortion;
    return a->misfit.forward_rms + a->misfit.backward_rms < b->misfit.forward_rms + b->misfit.backward_rms;
}

static il_status attempt(il_ffd *f, const il_global *g, const unsigned *ladder, il_error *err)
{
    il_status st = start(f, g, err);
    float across = (float)(f->cells_x > f->cells_y ? f->cells_x : f->cells_y);
    int patience = ladder == LADDER[0] ? PATIENCE_FIRST : PATIENCE;
    for (; st == IL_OK && *ladder > 0; ladder++)
        st = run_level(f, across / (float)*ladder, patience, err);
    return st == IL_OK ? judge(f, err) : st;
}

static void keep_if_better(il_ffd *f, bool *any)
{
    f->best_is_last = !*any || better(&f->now, &f->best);
    if (!f->best_is_last)
        return;
    history h = f->now;
    f->now = f->best;
    f->best = h;
    *any = true;
}

/* From the starts by the first ladder, until one needs next to no distortion;
 * then from the best of them by the next ladders, until one fits without much. */
static il_status climb(il_ffd *f, const il_global *starts, int n_starts, il_error *err)
{
    bool any = false;
    for (int i = 0; i < n_starts && !(any && f->best.fits && f->best.distortion < CONTENT); i++) {
        il_status st = attempt(f, &starts[i], LADDER[0], err);
        if (st != IL_OK)
            return st;
        keep_if_better(f, &any);
    }
    bool done = f->best.fits && f->best.distortion < DOUBTFUL;
    for (size_t k = 1; k < 3 && !done; k++) {
        il_global from = f->best.global;
        il_status st = attempt(f, &from, LADDER[k], err);
        if (st != IL_OK)
            return st;
        keep_if_better(f, &any);
        done = f->best.fits;
    }
    return IL_OK;
}

/* ---- where to start ---- */

static il_status forward_rms(il_ffd *f, const il_global *g, float *rms, il_error *err)
{
    il_status st = start(f, g, err);
    il_spline none = il_spline_over(1, 1, 1);
    if (st == IL_OK)
        st = il_equations_reserve(&f->equations, f->moved.n, 0, &none, err);
    if (st != IL_OK)
        return st;
    il_equations *e = &f->equations;
    float sum = 0;
    il_distance_sample(&f->map, f->moved.x, f->moved.y, f->moved.n, e->phi, e->gx, e->gy);
    for (size_t k = 0; k < f->moved.n; k++)
        sum += e->phi[k] * e->phi[k];
    *rms = sqrtf(sum / (float)f->moved.n);
    return IL_OK;
}

/* The start by moments is worth an attempt where it brings the contours so much
 * nearer; a turn is looked for where they are still this far apart, in cells. */
static const float NEARER = 0.7f, TURN_WORTHWHILE = 2;

/* The starts to try into START: as the slices lie, for contours that overlap move
 * along their normals then; by moments; turned. */
static il_status choose_starts(il_ffd *f, const il_outline *lower, const il_outline *upper, bool turns,
                               il_global start[3], int *n, il_error *err)
{
    il_global g;
    float best, rms;
    *n = 1;
    start[0] = (il_global)IL_GLOBAL_IDENTITY;
    il_status st = forward_rms(f, &start[0], &best, err);
    if (st == IL_OK && best > ENOUGH_RMS && il_global_by_moments(lower, upper, &g)) {
        st = forward_rms(f, &g, &rms, err);
        if (st == IL_OK && rms < NEARER * best) {
            start[(*n)++] = g;
            best = rms;
        }
    }
    if (st == IL_OK && turns && best > TURN_WORTHWHILE && il_global_with_turn(lower, upper, &g)) {
        st = forward_rms(f, &g, &rms, err);
        if (st == IL_OK && rms < best)
            start[(*n)++] = g;
    }
    return st;
}

/* ---- the result ---- */

static il_status record_steps(const history *h, il_fit *fit, il_error *err)
{
    const float *value = h->value;
    if (!il_grow(&fit->lattice, &fit->cap_lattices, h->n, sizeof *fit->lattice))
        return il_fail_nomem(err);
    for (size_t k = 0; k < h->n; k++) {
        const il_spline *s = &h->spline[k];
        il_lattice *l = &fit->lattice[fit->n_lattices];
        *l = (il_lattice){ s->nx, s->ny, -s->spacing, -s->spacing, s->spacing, NULL, (size_t)s->nx * s->ny, 0 };
        if (!il_grow(&l->d, &l->cap, 2 * l->n, sizeof *l->d))
            return il_fail_nomem(err);
        for (size_t i = 0; i < 2 * l->n; i++)
            l->d[i] = value[i];
        value += s->size;
        fit->n_lattices++;
    }
    fit->steps = (uint32_t)h->n;
    memcpy(fit->global, h->global.a, sizeof fit->global);
    return IL_OK;
}

/* All samples where the best attempt takes them, and their partners. */
static il_status carry(il_ffd *f, il_error *err)
{
    const history *h = &f->best;
    const float *value = h->value;
    if (f->best_is_last)
        return IL_OK;
    il_status st = start(f, &h->global, err);
    for (size_t k = 0; st == IL_OK && k < h->n; k++) {
        il_spline_move(&h->spline[k], value, f->moved.x, f->moved.y, f->jacobian, f->moved.n);
        value += h->spline[k].size;
    }
    il_samples_set_normals(&f->moved);
    if (st == IL_OK)
        il_partners_find(&f->moved, &f->lower, true, f->equations.partner);
    return st;
}

/* Exact residuals of the samples: upwards the foot on the lower contours,
 * downwards the nearest of the moved polyline about the partner. */
static void measure(il_ffd *f, il_fit *fit)
{
    double sum = 0, most = 0;
    for (size_t k = 0; k < f->moved.n; k++) {
        double d = il_distance_foot(&f->map, f->moved.x[k], f->moved.y[k]).distance;
        sum += d;
        most = fmax(most, d);
    }
    fit->residual_up_mean = sum / (double)f->moved.n;
    fit->residual_up_max = most;
    sum = most = 0;
    for (uint32_t q = 0; q < f->lower.n; q++) {
        double d = il_partner_distance(&f->moved, f->equations.partner[q], &f->lower, q);
        sum += d;
        most = fmax(most, d);
    }
    fit->residual_down_mean = sum / (double)f->lower.n;
    fit->residual_down_max = most;
}

static double length_of(const il_outline *o)
{
    double sum = 0;
    for (size_t i = 0; i < o->n; i++) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
        sum += hypot(b[0] - a[0], b[1] - a[1]);
    }
    return sum;
}

double il_ffd_spacing(const il_outline *lower, const il_outline *upper)
{
    return fmax(SAMPLE_SPACING, fmax(length_of(lower), length_of(upper)) / MOST_SAMPLES);
}

il_status il_ffd_solve(il_ffd *f, const il_outline *lower, const il_outline *upper,
                       uint32_t cells_x, uint32_t cells_y, bool turns, il_fit *fit, il_error *err)
{
    il_global starts[3];
    int n_starts = 0;
    *fit = (il_fit){ 0 };
    f->cells_x = cells_x;
    f->cells_y = cells_y;
    f->sample_spacing = il_ffd_spacing(lower, upper);
    il_status st = il_distance_begin(&f->map, lower->xy, lower->next, lower->n, cells_x, cells_y, err);
    if (st == IL_OK)
        st = il_samples_take(&f->lower, lower, f->sample_spacing, err);
    if (st == IL_OK)
        st = il_samples_take(&f->upper, upper, f->sample_spacing, err);
    if (st == IL_OK)
        st = choose_starts(f, lower, upper, turns, starts, &n_starts, err);
    if (st == IL_OK)
        st = climb(f, starts, n_starts, err);
    if (st == IL_OK)
        st = carry(f, err);
    if (st == IL_OK)
        st = record_steps(&f->best, fit, err);
    if (st == IL_OK && f->map.failed)
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        measure(f, fit);
        fit->least_jacobian = f->best.least_jacobian;
        fit->distortion = f->best.distortion;
        fit->box[2] = cells_x;
        fit->box[3] = cells_y;
    } else {
        il_fit_free(fit);
    }
    return st;
}

il_status il_ffd_show(il_ffd *f, const il_outline *lower, uint32_t cells_x, uint32_t cells_y, il_error *err)
{
    return il_distance_begin(&f->map, lower->xy, lower->next, lower->n, cells_x, cells_y, err);
}

il_foot il_ffd_foot(il_ffd *f, double x, double y)
{
    return il_distance_foot(&f->map, (float)x, (float)y);
}

il_distance *il_ffd_maps(il_ffd *f, il_distance **spare)
{
    *spare = &f->spare;
    return &f->map;
}
