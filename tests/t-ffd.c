/* t-ffd.c - the solver: closed forms, families of pairs judged by brute force, and
 * outlines that nobody would draw. */
#include "config.h"
#include "base/alloc.h"
#include "bench/judge.h"
#include "match/ffd.h"
#include "matching.h"
#include "model/lattice.h"
#include "pairs.h"

enum { FRAME = 256 };

static il_ffd *new_solver(void)
{
    il_ffd *f = NULL;
    assert_int_equal(il_ffd_new(&f, NULL), IL_OK);
    return f;
}

static void solve_in(il_ffd *f, const il_outline *lower, const il_outline *upper, uint32_t x, uint32_t y, il_fit *fit)
{
    assert_int_equal(il_ffd_solve(f, lower, upper, x, y, true, fit, NULL), IL_OK);
}

static il_fit solved(const outline *lower, const outline *upper)
{
    il_ffd *f = new_solver();
    il_fit fit;
    solve_in(f, &lower->o, &upper->o, FRAME, FRAME, &fit);
    il_ffd_free(f);
    return fit;
}

static il_outline outline_of(const pairs_outline *o)
{
    return (il_outline){ o->xy, o->next, o->n };
}

static void assert_finite_fit(const il_fit *f)
{
    const double *number[] = { &f->residual_up_mean, &f->residual_up_max, &f->residual_down_mean, &f->residual_down_max,
                               &f->least_jacobian, &f->distortion };
    for (size_t k = 0; k < sizeof number / sizeof *number; k++)
        assert_true(isfinite(*number[k]));
    for (int k = 0; k < 4; k++)
        assert_true(f->global[k] > -1e9 && f->global[k] < 1e9);
    assert_true(f->residual_up_mean >= 0 && f->residual_up_mean <= f->residual_up_max);
    assert_true(f->residual_down_mean >= 0 && f->residual_down_mean <= f->residual_down_max);
    assert_true(f->global[0] * f->global[3] - f->global[1] * f->global[2] > 0);
    assert_int_equal(f->n_lattices, f->steps);
}

/* Every step within the bound under which it is one-to-one, over all of the frame. */
static void assert_bounded(const il_fit *f, double cells_x, double cells_y)
{
    for (size_t k = 0; k < f->n_lattices; k++) {
        const il_lattice *l = &f->lattice[k];
        assert_int_equal(l->n, (size_t)l->nx * l->ny);
        assert_true(l->x <= -l->spacing * .999 && l->y <= -l->spacing * .999);
        assert_true(l->x + (l->nx - 2.) * l->spacing >= cells_x - 1e-3 && l->y + (l->ny - 2.) * l->spacing >= cells_y - 1e-3);
        for (size_t i = 0; i < 2 * l->n; i++)
            assert_true(fabs(l->d[i]) <= .4801 * l->spacing);
    }
}

/* ---- closed forms ---- */

static void an_outline_on_itself_takes_no_step(void **state)
{
    (void)state;
    static const double identity[] = { 1, 0, 0, 1, 0, 0 };
    for (uint32_t seed = 0; seed < PAIRS_N_NAMED; seed++) {
        static pairs_pair p;
        pairs_make(PAIRS_NAMED, seed, &p);
        il_outline o = outline_of(&p.upper);
        il_ffd *f = new_solver();
        il_fit fit;
        solve_in(f, &o, &o, FRAME, FRAME, &fit);
        assert_int_equal(fit.steps, 0);
        assert_memory_equal(fit.global, identity, sizeof identity);
        assert_true(fit.least_jacobian == 1 && fit.distortion == 0);
        assert_true(fit.residual_up_max < 2e-5 && fit.residual_down_mean < .02);
        il_fit_free(&fit);
        il_ffd_free(f);
    }
}

/* By the global step, or by lattices where the two overlap well enough. */
static void scale_shift_and_stretch_are_undone(void **state)
{
    (void)state;
    static const struct { double x, y, rx, ry; } to[] = {
        { 140, 110, 60, 60 }, { 128, 128, 45, 45 }, { 125, 130, 66, 54 }, { 160, 100, 30, 32 } };
    for (size_t k = 0; k < sizeof to / sizeof *to; k++) {
        outline lower = { 0 }, upper = { 0 };
        outline_ellipse(&upper, 128, 128, 60, 60, 400);
        outline_ellipse(&lower, to[k].x, to[k].y, to[k].rx, to[k].ry, 400);
        il_fit fit = solved(&lower, &upper);
        assert_bounded(&fit, FRAME, FRAME);
        assert_true(fit.least_jacobian > 0 && fit.distortion < .25);
        assert_true(fit.residual_up_mean < .05 && fit.residual_down_mean < .05);
        il_fit_free(&fit);
        outline_free(&lower);
        outline_free(&upper);
    }
}

static void a_star_that_is_turned_is_turned_back(void **state)
{
    (void)state;
    for (int degrees = -60; degrees <= 60; degrees += 40) {
        outline lower = { 0 }, upper = { 0 };
        double turn = degrees * acos(-1.0) / 180, off = 0;
        outline_star(&upper, 128, 128, 1, 0, 200);
        outline_star(&lower, 130, 125, 1.1, turn, 200);
        il_fit fit = solved(&lower, &upper);
        assert_bounded(&fit, FRAME, FRAME);
        for (size_t k = 0; k < upper.n; k++) {
            double p[2] = { upper.xy[2 * k], upper.xy[2 * k + 1] };
            il_fit_apply(&fit, p, 1);
            off += hypot(p[0] - lower.xy[2 * k], p[1] - lower.xy[2 * k + 1]) / 200;
        }
        assert_true(off < .5);
        assert_true(fit.residual_up_mean < .05 && fit.residual_down_mean < .05);
        il_fit_free(&fit);
        outline_free(&lower);
        outline_free(&upper);
    }
}

/* ---- families ---- */

/* SEEDS pairs of family F through one solver: solved all, and the fits' own figures
 * against those by brute force. */
static void assert_family(pairs_family f, uint32_t seeds, double most_mean, double most_off)
{
    static pairs_pair p;
    il_ffd *solver = new_solver();
    double mean = 0, off = 0;
    for (uint32_t seed = 0; seed < seeds; seed++) {
        il_fit fit;
        pairs_make(f, seed, &p);
        il_outline lower = outline_of(&p.lower), upper = outline_of(&p.upper);
        solve_in(solver, &lower, &upper, FRAME, FRAME, &fit);
        assert_finite_fit(&fit);
        assert_bounded(&fit, FRAME, FRAME);
        judged j = judge(&p, &fit);
        if (!judged_solved(&j))
            fail_msg("%s %u: up %g down %g Jacobian %g", pairs_family_word(f), (unsigned)seed, j.up_mean, j.down_mean, j.least_jacobian);
        assert_near(fit.residual_up_mean, j.up_mean, .02 + .1 * j.up_mean);
        assert_near(fit.residual_down_mean, j.down_mean, .04 + .1 * j.down_mean);
        assert_near(fit.residual_up_max, j.up_max, .3);
        assert_near(fit.distortion, j.distortion, .1 + .2 * j.distortion);
        assert_true(fit.least_jacobian >= j.least_jacobian - .01); /* seen on the contour only */
        mean += (j.up_mean + j.down_mean) / (2 * seeds);
        off += j.off_truth / seeds;
        il_fit_free(&fit);
    }
    assert_true(mean <= most_mean);
    assert_true(off <= most_off);
    il_ffd_free(solver);
}

static void neighbouring_slices_are_solved(void **state)
{
    (void)state;
    assert_family(PAIRS_SLICE_LIKE, 15, .05, 1.5);
}

static void different_slices_are_solved(void **state)
{
    (void)state;
    assert_family(PAIRS_DIFFERENT, 8, .06, 6);
}

/* ---- the same bits ---- */

static void assert_same_fit(const il_fit *a, const il_fit *b)
{
    assert_memory_equal(&a->residual_up_mean, &b->residual_up_mean, 6 * sizeof a->distortion);
    assert_memory_equal(a->global, b->global, sizeof a->global);
    assert_int_equal(a->steps, b->steps);
    for (size_t k = 0; k < a->n_lattices; k++) {
        assert_int_equal(a->lattice[k].n, b->lattice[k].n);
        assert_memory_equal(a->lattice[k].d, b->lattice[k].d, 2 * a->lattice[k].n * sizeof *a->lattice[k].d);
    }
}

/* In what order pairs come to a solver, and what it did before, changes no bit. */
static void a_solver_forgets(void **state)
{
    (void)state;
    enum { N = 6 };
    static pairs_pair p[N];
    il_fit first[N], again[N];
    il_ffd *f = new_solver();
    for (int k = 0; k < N; k++) {
        pairs_make((pairs_family)(k % PAIRS_N_FAMILIES), (uint32_t)k, &p[k]);
        il_outline lower = outline_of(&p[k].lower), upper = outline_of(&p[k].upper);
        il_ffd *fresh = new_solver();
        solve_in(fresh, &lower, &upper, FRAME, FRAME, &first[k]);
        il_ffd_free(fresh);
    }
    for (int round = 0; round < 2; round++)
        for (int i = 0; i < N; i++) {
            int k = round ? i : N - 1 - i;
            il_outline lower = outline_of(&p[k].lower), upper = outline_of(&p[k].upper);
            solve_in(f, &lower, &upper, FRAME, FRAME, &again[k]);
            assert_same_fit(&first[k], &again[k]);
            il_fit_free(&again[k]);
        }
    for (int k = 0; k < N; k++)
        il_fit_free(&first[k]);
    il_ffd_free(f);
}

/* ---- outlines that nobody would draw ---- */

/* Both ways: no crash, no endless loop, finite numbers. */
static void assert_survives(const outline *a, const outline *b, uint32_t x, uint32_t y)
{
    il_ffd *f = new_solver();
    for (int way = 0; way < 2; way++) {
        il_fit fit;
        solve_in(f, way ? &b->o : &a->o, way ? &a->o : &b->o, x, y, &fit);
        assert_finite_fit(&fit);
        assert_bounded(&fit, x, y);
        il_foot foot = il_ffd_foot(f, x / 2., y / 2.);
        assert_true(foot.segment < (way ? b : a)->n && foot.distance >= 0 && foot.t >= 0 && foot.t <= 1);
        il_fit_free(&fit);
    }
    il_ffd_free(f);
}

static void several_rings_are_taken_along(void **state)
{
    (void)state;
    outline lower = { 0 }, upper = { 0 };
    outline_ellipse(&lower, 100, 100, 50, 45, 100);
    outline_ellipse(&lower, 100, 100, -20, 20, 40);
    outline_ellipse(&lower, 200, 180, 20, 20, 40);
    outline_ellipse(&upper, 104, 102, 48, 47, 90);
    outline_ellipse(&upper, 106, 98, -22, 17, 50);
    outline_ellipse(&upper, 197, 183, 22, 19, 30);
    il_fit fit = solved(&lower, &upper);
    assert_true(fit.residual_up_mean < .05 && fit.residual_down_mean < .08 && fit.least_jacobian > 0);
    il_fit_free(&fit);
    assert_survives(&lower, &upper, FRAME, FRAME);
    outline_free(&upper);
    outline_ellipse(&upper, 104, 102, 48, 47, 90); /* two rings more below */
    assert_survives(&lower, &upper, FRAME, FRAME);
    outline_free(&lower);
    outline_free(&upper);
}

static void tiny_rings_survive(void **state)
{
    (void)state;
    static const double size[] = { 30, 1, 1e-3, 1e-6, 1e-12 };
    for (int k = 0; k < 5; k++) {
        outline a = { 0 }, b = { 0 };
        outline_ellipse(&a, 128, 128, size[k], size[k], 3);
        outline_ellipse(&b, 120, 130, 60, 50, 3);
        assert_survives(&a, &b, FRAME, FRAME);
        assert_survives(&a, &a, FRAME, FRAME);
        outline_free(&a);
        outline_free(&b);
    }
}

static void rings_without_area_survive(void **state)
{
    (void)state;
    outline flat = { 0 }, point = { 0 }, good = { 0 }, clockwise = { 0 };
    outline_add(&flat, 60, 60);
    outline_add(&flat, 128, 128);
    outline_add(&flat, 196, 196);
    outline_close(&flat);
    outline_add(&point, 100, 100);
    outline_close(&point);
    outline_star(&good, 128, 128, 1, 0, 60);
    outline_ellipse(&clockwise, 128, 128, -50, 40, 30);
    const outline *o[] = { &flat, &point, &good, &clockwise };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k <= i; k++)
            assert_survives(o[i], o[k], FRAME, FRAME);
    outline_free(&flat);
    outline_free(&point);
    outline_free(&good);
    outline_free(&clockwise);
}

static void needles_survive(void **state)
{
    (void)state;
    static const double thick[] = { 5, .1, 1e-4, 1e-9 };
    for (int k = 0; k < 4; k++) {
        outline a = { 0 }, b = { 0 };
        outline_ellipse(&a, 128, 128, 90, thick[k], 50);
        outline_ellipse(&b, 130, 120, thick[k], 90, 50);
        assert_survives(&a, &b, FRAME, FRAME);
        outline_free(&b);
        outline_ellipse(&b, 126, 127, 88, thick[k], 50);
        assert_survives(&a, &b, FRAME, FRAME);
        outline_free(&a);
        outline_free(&b);
    }
}

static void small_frames_survive(void **state)
{
    (void)state;
    static const uint32_t cells[][2] = { { 1, 1 }, { 2, 1 }, { 256, 1 }, { 1, 256 }, { 3, 40 } };
    for (int k = 0; k < 5; k++) {
        double x = cells[k][0], y = cells[k][1];
        outline a = { 0 }, b = { 0 };
        outline_ellipse(&a, x / 2, y / 2, .3 * x, .3 * y, 12);
        outline_ellipse(&b, .52 * x, .45 * y, .25 * x, .34 * y, 5);
        assert_survives(&a, &b, cells[k][0], cells[k][1]);
        outline_free(&a);
        outline_free(&b);
    }
}

/* Many vertices cost little: samples are what counts. */
static void many_vertices_are_no_matter(void **state)
{
    (void)state;
    outline a = { 0 }, b = { 0 };
    outline_star(&a, 128, 128, 1, 0, 20000);
    outline_star(&b, 126, 130, 1.05, .05, 20000);
    il_fit fit = solved(&a, &b);
    assert_true(fit.residual_up_mean < .05 && fit.residual_down_mean < .05 && fit.least_jacobian > 0);
    il_fit_free(&fit);
    outline_free(&a);
    outline_free(&b);
}

/* Nothing may be left behind: the sanitizers tell. */
static void little_memory_is_told(void **state)
{
    (void)state;
    static pairs_pair p;
    pairs_make(PAIRS_DIFFERENT, 3, &p);
    il_outline lower = outline_of(&p.lower), upper = outline_of(&p.upper);
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st != IL_OK; k++) {
        il_ffd *f = NULL;
        il_fit fit = { 0 };
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_ffd_new(&f, &err);
        if (st == IL_OK)
            st = il_ffd_solve(f, &lower, &upper, FRAME, FRAME, true, &fit, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM && fit.lattice == NULL && fit.steps == 0));
        il_fit_free(&fit);
        il_ffd_free(f);
    }
    assert_true(k > 30);
    il_ffd_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_outline_on_itself_takes_no_step),
        cmocka_unit_test(scale_shift_and_stretch_are_undone),
        cmocka_unit_test(a_star_that_is_turned_is_turned_back),
        cmocka_unit_test(neighbouring_slices_are_solved),
        cmocka_unit_test(different_slices_are_solved),
        cmocka_unit_test(a_solver_forgets),
        cmocka_unit_test(several_rings_are_taken_along),
        cmocka_unit_test(tiny_rings_survive),
        cmocka_unit_test(rings_without_area_survive),
        cmocka_unit_test(needles_survive),
        cmocka_unit_test(small_frames_survive),
        cmocka_unit_test(many_vertices_are_no_matter),
        cmocka_unit_test(little_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
