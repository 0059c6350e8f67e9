/* t-smooth.c - solids whose strips are bent, and ends that follow them. */
#include "config.h"
#include "base/alloc.h"
#include "loft/curve.h"
#include "slabs.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 32 };

/* ---- round solids ---------------------------------------------------------------------------- */

/* distance(self, p): of point P to the solid's surface. */
typedef struct round_solid {
    const char *name;
    double a, b, c;           /* what its functions make of it */
    void (*slice)(const struct round_solid *s, double z, il_slice *to);
    double (*distance)(const struct round_solid *s, const double p[3]);
    double low, high;
} round_solid;

static void cut_sphere(const round_solid *s, double z, il_slice *to)
{
    add_circle(to, 0, 0, sqrt(s->a * s->a - z * z), 128);
}

static double off_sphere(const round_solid *s, const double p[3])
{
    return fabs(hypot(hypot(p[0], p[1]), p[2]) - s->a);
}

/* A torus that lies on its side, above its hole: two circles bent into ovals. */
static void cut_torus(const round_solid *s, double z, il_slice *to)
{
    for (int side = -1; side <= 1; side += 2) {
        il_ring *r = il_slice_add_ring(to);
        assert_non_null(r);
        for (int i = 0; i < 128; i++) {
            double t = 6.283185307179586 * i / 128, y = s->b * sin(t), e = s->b * cos(t); /* of the tube's cross-section */
            double x = sqrt((s->a + e) * (s->a + e) - z * z);
            assert_true(il_ring_add(r, side * x, y, 0));
        }
    }
}

static double off_torus(const round_solid *s, const double p[3])
{
    return fabs(hypot(hypot(p[0], p[2]) - s->a, p[1]) - s->b);
}

/* r^2 = a (z + b) */
static void cut_paraboloid(const round_solid *s, double z, il_slice *to)
{
    add_circle(to, 3, -2, sqrt(s->a * (z + s->b)), 128);
}

static double off_paraboloid(const round_solid *s, const double p[3])
{
    double r = hypot(p[0] - 3, p[1] + 2), z = p[2] + s->b, d = r * r - s->a * z;
    return fabs(d) / hypot(2 * r, s->a); /* to first order */
}

/* An oval tube that winds: centre (a sin z/b, 0). */
static void cut_tube(const round_solid *s, double z, il_slice *to)
{
    add_ellipse(to, s->a * sin(z / s->b), 0, s->c, s->c / 2, 128);
}

static double off_tube(const round_solid *s, const double p[3])
{
    double x = p[0] - s->a * sin(p[2] / s->b), k = hypot(x / s->c, 2 * p[1] / s->c);
    return fabs(k - 1) * s->c / 2 * hypot(x / s->c, p[1] / s->c) / fmax(k, .1);
}

static const round_solid SOLIDS[] = {
    { "sphere", 10, 0, 0, cut_sphere, off_sphere, -8.5, 8.5 },
    { "torus", 20, 5, 0, cut_torus, off_torus, -11, 11 },
    { "paraboloid", 4, 1, 0, cut_paraboloid, off_paraboloid, 0, 12 },
    { "tube", 2, 5, 3, cut_tube, off_tube, 0, 30 },
};

static size_t cut_solid(const round_solid *s, size_t n, il_slice *slice)
{
    for (size_t i = 0; i < n; i++) {
        slice[i] = (il_slice)IL_SLICE_INIT;
        slice[i].z = s->low + (s->high - s->low) * (double)i / (double)(n - 1);
        s->slice(s, slice[i].z, &slice[i]);
    }
    return n;
}

static keeper loft_slices(const il_slice *slice, size_t n, const il_loft_options *o, const char *what)
{
    il_slice clean[MOST];
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    assert_true(n <= MOST);
    for (size_t i = 0; i < n; i++)
        clean[i] = clean_slice(&slice[i], o->round_float);
    if (loft_pairs(&k, clean, n, NULL, o, &err) != IL_OK)
        fail_msg("%s: %s", what, err.text);
    assert_sound(&k, what, n);
    free_slices(clean, n);
    return k;
}

static keeper loft_between(const il_slice *slice, size_t n, int between, const char *what)
{
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.between = between;
    return loft_slices(slice, n, &o, what);
}

/* The mean distance to solid S of the middles of the sides of K, weighed by area; the lids are left out. */
static double mean_distance(const round_solid *s, const il_mesh *m)
{
    double sum = 0, total = 0;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *v[3] = { m->xyz + 3 * m->tri[3 * t], m->xyz + 3 * m->tri[3 * t + 1], m->xyz + 3 * m->tri[3 * t + 2] };
        double u[3], w[3], mid[3];
        if (v[0][2] == v[1][2] && v[1][2] == v[2][2])
            continue;
        for (int k = 0; k < 3; k++) {
            u[k] = v[1][k] - v[0][k], w[k] = v[2][k] - v[0][k];
            mid[k] = (v[0][k] + v[1][k] + v[2][k]) / 3;
        }
        double area = hypot(hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2]), u[0] * w[1] - u[1] * w[0]);
        sum += area * s->distance(s, mid);
        total += area;
    }
    return sum / total;
}

static void smooth_strips_are_nearer_to_round_solids(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SOLIDS / sizeof *SOLIDS; i++)
        for (size_t n = 6; n <= 24; n *= 2) {
            il_slice slice[MOST];
            cut_solid(&SOLIDS[i], n, slice);
            keeper straight = loft_between(slice, n, 0, SOLIDS[i].name), smooth = loft_between(slice, n, IL_BETWEEN_AUTO, SOLIDS[i].name);
            double before = mean_distance(&SOLIDS[i], &straight.mesh), after = mean_distance(&SOLIDS[i], &smooth.mesh);
            double spacing = slice[1].z - slice[0].z;
            if (!(after < 0.6 * before || (after < before && after < IL_CURVE_TOLERANCE * spacing / 4)))
                fail_msg("%s, %zu slices: %g from it, %g with straight strips", SOLIDS[i].name, n, after, before);
            il_mesh_free(&straight.mesh);
            il_mesh_free(&smooth.mesh);
            free_slices(slice, n);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_strips_are_nearer_to_round_solids),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
