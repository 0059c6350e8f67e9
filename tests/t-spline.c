/* t-spline.c - lattices in floats against those in doubles, and both against what
 * they must be. */
#include "config.h"
#include "base/simd.h"
#include "match/spline.h"
#include "matching.h"
#include "model/lattice.h"

/* A lattice in both forms: the same nodes with the same numbers. */
typedef struct twin {
    il_spline spline;
    float *room, *c;              /* c: in room, behind its margin */
    il_lattice lattice;
} twin;

static float *new_field(const il_spline *s)
{
    float *room = calloc(il_spline_room(s), sizeof *room);
    assert_non_null(room);
    return room;
}

/* The doubles of the lattice from the floats of the spline. */
static void follow(twin *t)
{
    for (size_t k = 0; k < 2 * t->lattice.n; k++)
        t->lattice.d[k] = t->c[k];
}

/* Over a raster of cells; every node moved by less than MOST either way. */
static twin make_twin(uint32_t cells_x, uint32_t cells_y, float spacing, double most, uint64_t *seed)
{
    twin t;
    il_spline s = t.spline = il_spline_over(cells_x, cells_y, spacing);
    size_t n = (size_t)s.nx * s.ny;
    t.room = new_field(&s);
    t.c = t.room + s.margin;
    for (size_t k = 0; k < 2 * n; k++)
        t.c[k] = (float)random_between(seed, -most, most);
    t.lattice = (il_lattice){ s.nx, s.ny, -spacing, -spacing, spacing, malloc(2 * n * sizeof(double)), n, n };
    assert_non_null(t.lattice.d);
    follow(&t);
    return t;
}

static void free_twin(twin *t)
{
    free(t->room);
    free(t->lattice.d);
}

/* Points all over a raster, its corners and borders first. */
enum { POINTS = 300 };
typedef struct points { float x[POINTS], y[POINTS]; } points;

static void scatter_points(points *p, uint32_t cells_x, uint32_t cells_y, uint64_t *seed)
{
    for (int k = 0; k < POINTS; k++) {
        double x = random_between(seed, 0, cells_x), y = random_between(seed, 0, cells_y);
        p->x[k] = (float)(k < 12 && k % 3 < 2 ? k % 3 * (double)cells_x : x);
        p->y[k] = (float)(k < 12 && k / 3 % 3 < 2 ? k / 3 % 3 * (double)cells_y : y);
    }
}

/* Rasters and spacings as the solver has them, and some that do not divide. */
static const struct { uint32_t x, y; float spacing; } over[] = {
    { 256, 256, 16 }, { 256, 256, 64 }, { 201, 77, 201 / 16.f }, { 256, 3, 8 }, { 1, 1, 1 }, { 5, 200, 200 / 64.f } };
enum { RASTERS = sizeof over / sizeof *over };

static void weights_sum_to_one_and_are_those_of_the_lattice(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int r = 0; r < RASTERS; r++) {
        il_spline s = il_spline_over(over[r].x, over[r].y, over[r].spacing);
        points p;
        il_stencil at[POINTS];
        scatter_points(&p, over[r].x, over[r].y, &seed);
        il_spline_stencils(&s, p.x, p.y, POINTS, at);
        for (int k = 0; k < POINTS; k++) {
            uint32_t i = at[k].at / 2 % s.nx, j = at[k].at / 2 / s.nx;
            double u = p.x[k] / (double)s.spacing - i, v = p.y[k] / (double)s.spacing - j, bx[4], by[4], sum = 0;
            assert_true(at[k].at % 2 == 0 && i + 4 <= s.nx && j + 4 <= s.ny);
            assert_true(u > -1e-5 && u < 1 + 1e-5 && v > -1e-5 && v < 1 + 1e-5);
            il_lattice_weights(u, bx);
            il_lattice_weights(v, by);
            for (int m = 0; m < 4; m++) {
                assert_near(at[k].bx[2 * m], bx[m], 1e-5);
                assert_true(at[k].bx[2 * m] == at[k].bx[2 * m + 1]);
                assert_near(at[k].by[m], by[m], 1e-5);
                for (int n = 0; n < 4; n++)
                    sum += (double)at[k].bx[2 * m] * (double)at[k].by[n];
            }
            assert_near(sum, 1, 1e-6);
        }
    }
}

static void points_outside_are_taken_at_the_border(void **state)
{
    (void)state;
    il_spline s = il_spline_over(100, 60, 10);
    static const float x[] = { -7, 107, 1e30f, -1e30f, 50 }, y[] = { 30, 30, -1e30f, 1e30f, 61 };
    static const float bx[] = { 0, 100, 100, 0, 50 }, by[] = { 30, 30, 0, 60, 60 };
    il_stencil out[5], border[5];
    il_spline_stencils(&s, x, y, 5, out);
    il_spline_stencils(&s, bx, by, 5, border);
    for (int k = 0; k < 5; k++) {
        assert_int_equal(out[k].at, border[k].at);
        assert_memory_equal(out[k].bx, border[k].bx, sizeof out[k].bx);
        assert_memory_equal(out[k].by, border[k].by, sizeof out[k].by);
    }
}

/* Lattice and spline move points alike but for rounding: of coordinates, and of
 * the place in a lattice cell, which the field's slope magnifies. */
static void points_move_as_the_lattice_moves_them(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int r = 0; r < RASTERS; r++) {
        twin t = make_twin(over[r].x, over[r].y, over[r].spacing, .48 * (double)over[r].spacing, &seed);
        points p, q;
        float dx[POINTS], dy[POINTS], jacobian[POINTS];
        il_stencil at[POINTS];
        scatter_points(&p, over[r].x, over[r].y, &seed);
        il_spline_stencils(&t.spline, p.x, p.y, POINTS, at);
        il_spline_eval(&t.spline, t.c, at, POINTS, dx, dy);
        q = p;
        for (int k = 0; k < POINTS; k++)
            jacobian[k] = k % 2 ? 1 : .25f;
        il_spline_move(&t.spline, t.c, q.x, q.y, jacobian, POINTS);
        for (int k = 0; k < POINTS; k++) {
            double was[2] = { p.x[k], p.y[k] }, is[2] = { p.x[k], p.y[k] };
            il_lattice_apply(&t.lattice, is, 1);
            assert_near(dx[k], is[0] - was[0], 5e-5);
            assert_near(dy[k], is[1] - was[1], 5e-5);
            assert_near(q.x[k], is[0], 1e-4);
            assert_near(q.y[k], is[1], 1e-4);
            assert_near(jacobian[k] / (k % 2 ? 1 : .25f), il_lattice_jacobian(&t.lattice, was), 1e-4);
        }
        free_twin(&t);
    }
}

static double dot(const float *a, const float *b, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += (double)a[k] * (double)b[k];
    return sum;
}

static double size_of(const float *a, size_t n)
{
    return sqrt(dot(a, a, n));
}

static void assert_margins_are_zero(const il_spline *s, const float *room)
{
    size_t nodes = 2 * (size_t)s->nx * s->ny;
    for (size_t k = 0; k < il_spline_room(s); k++)
        assert_true((k >= s->margin && k < s->margin + nodes) || room[k] == 0);
}

/* v . (B c) = (B' v) . c */
static void scatter_is_the_transpose_of_eval(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int r = 0; r < RASTERS; r++) {
        twin t = make_twin(over[r].x, over[r].y, over[r].spacing, 1, &seed);
        float *room = new_field(&t.spline), *back = room + t.spline.margin;
        float dx[POINTS], dy[POINTS], vx[POINTS], vy[POINTS];
        points p;
        il_stencil at[POINTS];
        scatter_points(&p, over[r].x, over[r].y, &seed);
        for (int k = 0; k < POINTS; k++) {
            vx[k] = (float)random_between(&seed, -1, 1);
            vy[k] = (float)random_between(&seed, -1, 1);
        }
        il_spline_stencils(&t.spline, p.x, p.y, POINTS, at);
        il_spline_eval(&t.spline, t.c, at, POINTS, dx, dy);
        il_spline_scatter(&t.spline, back, at, POINTS, vx, vy);
        double forth = dot(dx, vx, POINTS) + dot(dy, vy, POINTS);
        assert_near(dot(back, t.c, t.spline.size), forth, 1e-6 * size_of(back, t.spline.size) * size_of(t.c, t.spline.size));
        assert_margins_are_zero(&t.spline, room);
        free(room);
        free_twin(&t);
    }
}

/* The weights of one point, squared; and points add up. */
static void scatter_squares_squares_the_weights(void **state)
{
    (void)state;
    uint64_t seed = 4;
    il_spline s = il_spline_over(201, 77, 201 / 16.f);
    points p;
    il_stencil at[POINTS];
    float *room = new_field(&s), *other = new_field(&s), *sum = new_field(&s), vx[POINTS], vy[POINTS];
    static const float one = 1;
    scatter_points(&p, 201, 77, &seed);
    il_spline_stencils(&s, p.x, p.y, POINTS, at);
    for (int k = 0; k < POINTS; k++) {
        vx[k] = (float)random_between(&seed, 0, 1);
        vy[k] = (float)random_between(&seed, 0, 1);
        memset(room, 0, il_spline_room(&s) * sizeof *room);
        il_spline_scatter(&s, room + s.margin, at + k, 1, &one, &one);
        for (size_t i = 0; i < s.size; i++)
            sum[s.margin + i] += room[s.margin + i] * room[s.margin + i] * (i % 2 ? vy[k] : vx[k]);
    }
    il_spline_scatter_squares(&s, other + s.margin, at, POINTS, vx, vy);
    for (size_t i = 0; i < il_spline_room(&s); i++)
        assert_near(other[i], sum[i], 1e-5 * (1 + fabs((double)sum[i])));
    assert_margins_are_zero(&s, other);
    free(room);
    free(other);
    free(sum);
}

/* L c at component K of node (i, j), by its definition. */
static double roughness_at(const twin *t, uint32_t i, uint32_t j, size_t k)
{
    static const int step[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    uint32_t nx = t->spline.nx, ny = t->spline.ny;
    double sum = 0;
    for (int n = 0; n < 4; n++) {
        int64_t p = (int64_t)i + step[n][0], q = (int64_t)j + step[n][1];
        if (p >= 0 && q >= 0 && p < nx && q < ny)
            sum += t->lattice.d[2 * ((size_t)j * nx + i) + k] - t->lattice.d[2 * ((size_t)q * nx + (size_t)p) + k];
    }
    return sum;
}

static void roughness_is_the_sum_of_differences_between_neighbours(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int r = 0; r < RASTERS; r++) {
        twin t = make_twin(over[r].x, over[r].y, over[r].spacing, 1, &seed);
        const il_spline *s = &t.spline;
        float *room = new_field(s), *out = room + s->margin;
        for (size_t k = 0; k < 2 * t.lattice.n; k++)
            out[k] = (float)k;
        il_spline_roughness(s, t.c, .25f, out);
        for (uint32_t j = 0; j < s->ny; j++)
            for (uint32_t i = 0; i < s->nx; i++)
                for (size_t k = 0; k < 2; k++) {
                    size_t at = 2 * ((size_t)j * s->nx + i) + k;
                    assert_near(out[at], (double)at + .25 * roughness_at(&t, i, j, k), 1e-6 * (8 + (double)at));
                }
        assert_margins_are_zero(s, room);
        free(room);
        free_twin(&t);
    }
}

static void roughness_is_never_negative_and_nothing_for_a_shift(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int round = 0; round < 60; round++) {
        int r = round % RASTERS;
        twin t = make_twin(over[r].x, over[r].y, over[r].spacing, 1, &seed);
        float *room = new_field(&t.spline), *out = room + t.spline.margin;
        il_spline_roughness(&t.spline, t.c, 1, out);
        assert_true(dot(out, t.c, t.spline.size) >= 0);
        for (size_t k = 0; k < 2 * t.lattice.n; k++) {
            t.c[k] = k % 2 ? -2.5f : .75f;
            out[k] = 0;
        }
        il_spline_roughness(&t.spline, t.c, 1, out);
        for (size_t k = 0; k < 2 * t.lattice.n; k++)
            assert_true(out[k] == 0);
        free(room);
        free_twin(&t);
    }
}

/* Nodes moved by a linear map of where they are move all points by it. */
static void a_linear_field_is_reproduced(void **state)
{
    (void)state;
    uint64_t seed = 7;
    static const double a[6] = { .25, -.125, 3, .0625, -.5, -7 };
    for (int r = 0; r < RASTERS; r++) {
        twin t = make_twin(over[r].x, over[r].y, over[r].spacing, 1, &seed);
        double h = (double)over[r].spacing;
        for (size_t k = 0; k < t.lattice.n; k++) {
            double x = h * ((double)(k % t.lattice.nx) - 1), y = h * ((double)(k / t.lattice.nx) - 1);
            for (size_t c = 0; c < 2; c++)
                t.lattice.d[2 * k + c] = a[3 * c] * x + a[3 * c + 1] * y + a[3 * c + 2];
        }
        for (int k = 0; k < 100; k++) {
            double x = random_between(&seed, 0, over[r].x), y = random_between(&seed, 0, over[r].y), p[2] = { x, y };
            assert_near(il_lattice_jacobian(&t.lattice, p), (1 + a[0]) * (1 + a[4]) - a[1] * a[3], 1e-12);
            il_lattice_apply(&t.lattice, p, 1);
            assert_near(p[0], x + a[0] * x + a[1] * y + a[2], 1e-10);
            assert_near(p[1], y + a[3] * x + a[4] * y + a[5], 1e-10);
        }
        free_twin(&t);
    }
}

static void nothing_moves_two_spacings_outside_of_the_lattice(void **state)
{
    (void)state;
    uint64_t seed = 8;
    twin t = make_twin(40, 30, 10, 4, &seed);
    static const double at[][2] = { { -30, 10 }, { 10, -30 }, { 80, 10 }, { 10, 70 }, { -1e300, 1e300 }, { 1e18, 0 } };
    double right = t.lattice.x + 10 * (t.lattice.nx + 1.), top = t.lattice.y + 10 * (t.lattice.ny + 1.);
    assert_true(right == 80 && top == 70);
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        double p[2] = { at[k][0], at[k][1] };
        assert_true(il_lattice_jacobian(&t.lattice, p) == 1);
        il_lattice_apply(&t.lattice, p, 1);
        assert_memory_equal(p, at[k], sizeof p);
    }
    double p[2] = { -29.9, 10 }; /* and what moves there is little, for it fades out */
    il_lattice_apply(&t.lattice, p, 1);
    assert_true(p[0] != -29.9);
    assert_near(p[0], -29.9, 1e-5);
    free_twin(&t);
}

/* All steps after the global one, in order. */
static void a_fit_is_its_steps_one_by_one(void **state)
{
    (void)state;
    uint64_t seed = 9;
    twin t[2] = { make_twin(64, 64, 8, 3, &seed), make_twin(64, 64, 4, 1, &seed) };
    il_lattice both[2] = { t[0].lattice, t[1].lattice };
    il_fit fit = { .global = { 1.25, .5, -.5, .75, 3, 4 }, .lattice = both, .n_lattices = 2 };
    for (int k = 0; k < 100; k++) {
        double x = random_between(&seed, 0, 40), y = random_between(&seed, 10, 50), p[2] = { x, y };
        double q[2] = { 1.25 * x + .5 * y + 3, -.5 * x + .75 * y + 4 };
        il_fit_apply(&fit, p, 1);
        il_lattice_apply(&both[0], q, 1);
        il_lattice_apply(&both[1], q, 1);
        assert_memory_equal(p, q, sizeof p);
    }
    free_twin(&t[0]);
    free_twin(&t[1]);
}

static void jacobians_are_those_of_finite_differences(void **state)
{
    (void)state;
    uint64_t seed = 10;
    twin t = make_twin(96, 96, 16, 7, &seed);
    for (int k = 0; k < 200; k++) {
        const double h = 1e-5;
        double x = random_between(&seed, 1, 95), y = random_between(&seed, 1, 95);
        double p[4][2] = { { x + h, y }, { x - h, y }, { x, y + h }, { x, y - h } }, at[2] = { x, y };
        il_lattice_apply(&t.lattice, p[0], 4);
        double xx = (p[0][0] - p[1][0]) / (2 * h), xy = (p[2][0] - p[3][0]) / (2 * h);
        double yx = (p[0][1] - p[1][1]) / (2 * h), yy = (p[2][1] - p[3][1]) / (2 * h);
        assert_near(il_lattice_jacobian(&t.lattice, at), xx * yy - xy * yx, 1e-7);
    }
    free_twin(&t);
}

/* ---- the bound under which no step folds ----
 *
 * At place (u, v) of a lattice cell only 16 nodes count.  With g = (gx, gy) the
 * gradients of their weights, a and b the displacements of their x and y in
 * spacings, the determinant is (1 + a.gx) (1 + b.gy) - (a.gy) (b.gx): for given
 * a it is linear in b, so it is least where each b is at its bound, against
 * (1 + a.gx) gy - (a.gy) gx.  In a it is then concave, and depends on (a.gx, a.gy)
 * alone; so it is least at a corner of the polygon that these make for all a
 * within the bound: where a has the signs of cos(t) gx + sin(t) gy for some t.
 * These patterns are all that matter. */

enum { PLACES = 64, TURNS = 64 };

static void gradients(double u, double v, double gx[16], double gy[16])
{
    double bx[4], by[4], w = 1 - u, q = 1 - v;
    double sx[4] = { -w * w / 2, 1.5 * u * u - 2 * u, -1.5 * w * w + 2 * w, u * u / 2 };
    double sy[4] = { -q * q / 2, 1.5 * v * v - 2 * v, -1.5 * q * q + 2 * q, v * v / 2 };
    il_lattice_weights(u, bx);
    il_lattice_weights(v, by);
    for (int k = 0; k < 16; k++) {
        gx[k] = sx[k % 4] * by[k / 4];
        gy[k] = bx[k % 4] * sy[k / 4];
    }
}

/* The worst signs against TURN at (u, v) when nodes move by BOUND spacings, as
 * displacements of a lattice of 4 by 4 nodes, 1 apart. */
static void worst_signs(double u, double v, double turn, double bound, double d[32])
{
    double gx[16], gy[16], px = 0, py = 0;
    gradients(u, v, gx, gy);
    for (int k = 0; k < 16; k++) {
        d[2 * k] = cos(turn) * gx[k] + sin(turn) * gy[k] > 0 ? -bound : bound;
        px += d[2 * k] * gx[k];
        py += d[2 * k] * gy[k];
    }
    for (int k = 0; k < 16; k++)
        d[2 * k + 1] = (1 + px) * gy[k] - py * gx[k] > 0 ? -bound : bound;
}

static il_lattice patch(double d[32])
{
    return (il_lattice){ 4, 4, -1, -1, 1, d, 16, 16 };
}

/* The least determinant anywhere when nodes move by BOUND spacings at most. */
static double least_jacobian(double bound, double at[3])
{
    double least = INFINITY, d[32];
    il_lattice l = patch(d);
    for (int i = 0; i <= PLACES; i++)
        for (int j = 0; j <= i; j++) /* u and v are alike */
            for (int k = 0; k < TURNS; k++) {
                double p[2] = { (double)i / PLACES, (double)j / PLACES }, turn = k * 2 * acos(-1.0) / TURNS;
                worst_signs(p[0], p[1], turn, bound, d);
                double jacobian = il_lattice_jacobian(&l, p);
                if (jacobian < least) {
                    least = jacobian;
                    at[0] = p[0], at[1] = p[1], at[2] = turn;
                }
            }
    return least;
}

/* Choi & Lee 2000: 1 / 2.0464 = 0.48866. */
static void the_first_fold_is_at_a_displacement_of_0_4887_spacings(void **state)
{
    (void)state;
    double below = .4, above = .6, at[3];
    while (above - below > 1e-6) {
        double bound = (below + above) / 2;
        if (least_jacobian(bound, at) > 0)
            below = bound;
        else
            above = bound;
    }
    assert_near(above, .48868, 1e-5);
}

/* The determinant by the solver's own kernel, of a pattern of 16 nodes that move by
 * BOUND spacings, in the middle of a lattice 16 apart. */
static float moved_jacobian(const twin *t, const double d[32], double u, double v)
{
    const il_spline *s = &t->spline;
    float x = 16 * (float)(3 + u), y = 16 * (float)(2 + v), jacobian = 1;
    for (size_t k = 0; k < 32; k++)
        t->c[2 * (size_t)s->nx * (2 + k / 8) + 6 + k % 8] = 16 * (float)d[k];
    il_spline_move(s, t->c, &x, &y, &jacobian, 1);
    return jacobian;
}

static void no_signs_fold_a_step_of_0_48_spacings_and_some_one_of_0_489(void **state)
{
    (void)state;
    uint64_t seed = 11;
    twin t = make_twin(128, 128, 16, 0, &seed);
    double d[32], at[3];
    least_jacobian(.489, at);
    worst_signs(at[0], at[1], at[2], .489, d);
    assert_true(moved_jacobian(&t, d, at[0], at[1]) < 0);
    worst_signs(at[0], at[1], at[2], .48, d);
    assert_true(moved_jacobian(&t, d, at[0], at[1]) > .01f);
    assert_true(moved_jacobian(&t, d, at[0], at[1]) < .05f);
    for (int i = 0; i <= PLACES; i++)
        for (int j = 0; j <= PLACES; j++)
            for (int k = 0; k < TURNS; k++) {
                double u = (double)i / PLACES * .9999, v = (double)j / PLACES * .9999;
                worst_signs(u, v, k * 2 * acos(-1.0) / TURNS, .48, d);
                assert_true(moved_jacobian(&t, d, u, v) > .01f);
            }
    for (int round = 0; round < 100000; round++) {
        uint64_t signs = stack_random(&seed);
        for (int k = 0; k < 32; k++)
            d[k] = signs >> k & 1 ? .48 : -.48;
        assert_true(moved_jacobian(&t, d, stack_uniform(&seed), stack_uniform(&seed)) > .01f);
    }
    free_twin(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_sum_to_one_and_are_those_of_the_lattice),
        cmocka_unit_test(points_outside_are_taken_at_the_border),
        cmocka_unit_test(points_move_as_the_lattice_moves_them),
        cmocka_unit_test(scatter_is_the_transpose_of_eval),
        cmocka_unit_test(scatter_squares_squares_the_weights),
        cmocka_unit_test(roughness_is_the_sum_of_differences_between_neighbours),
        cmocka_unit_test(roughness_is_never_negative_and_nothing_for_a_shift),
        cmocka_unit_test(a_linear_field_is_reproduced),
        cmocka_unit_test(nothing_moves_two_spacings_outside_of_the_lattice),
        cmocka_unit_test(a_fit_is_its_steps_one_by_one),
        cmocka_unit_test(jacobians_are_those_of_finite_differences),
        cmocka_unit_test(the_first_fold_is_at_a_displacement_of_0_4887_spacings),
        cmocka_unit_test(no_signs_fold_a_step_of_0_48_spacings_and_some_one_of_0_489),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
