#include "config.h"
#include "loft/inverse.h"
#include "loft/reference.h"
#include "region/clean.h"
#include "stacks.h"
#include "test.h"
#include "warp.h"

#include <math.h>

static const double TURN = 6.283185307179586;

static void add_circle(il_slice *s, double x, double y, double radius, int n)
{
    il_ring *r = il_slice_add_ring(s);
    il_clean_options o = { .round_float = false };
    assert_non_null(r);
    for (int i = 0; i < n; i++)
        assert_true(il_ring_add(r, x + radius * cos(TURN * i / n), y + radius * sin(TURN * i / n), 0));
    assert_int_equal(il_slice_clean(s, &o, NULL, NULL, NULL), IL_OK);
}

/* Everything from two slices to the inverse of W. */
typedef struct bench {
    il_slice slice[2];
    il_section section[2];
    il_pair pair;
    il_phi phi;
    il_reference r;
    il_snapped snapped;
    il_overlay o;
    il_inverse inverse;
} bench;

static void set_up(bench *b, const warp *w)
{
    bool injective, sound;
    b->slice[0] = b->slice[1] = (il_slice)IL_SLICE_INIT;
    b->slice[1].z = 1;
    add_circle(&b->slice[0], 0, 0, 5, 60);
    add_circle(&b->slice[1], 20, 3, 4, 50);
    add_circle(&b->slice[1], 20, 12, 2, 30);
    for (int k = 0; k < 2; k++)
        assert_int_equal(il_section_from_slice(&b->section[k], &b->slice[k], NULL), IL_OK);
    b->pair = warp_pair(&b->slice[0], &b->slice[1], w);
    assert_int_equal(il_phi_index(&b->phi, &b->pair, &b->section[1], NULL), IL_OK);
    assert_int_equal(il_reference_deform(&b->r, &b->section[0], &b->section[1], &b->phi, NULL, 0, 0, NULL), IL_OK);
    b->r.fit = &b->pair.group[0].fit;
    assert_int_equal(il_snap(&b->snapped, &b->r, il_snap_first_exponent(&b->r, false), &injective, NULL), IL_OK);
    assert_true(injective);
    assert_int_equal(il_overlay_build(&b->o, &b->r, &b->snapped, &sound, NULL), IL_OK);
    assert_true(sound);
    assert_int_equal(il_inverse_build(&b->inverse, &b->o, NULL), IL_OK);
}

static void tear_down(bench *b)
{
    il_inverse_free(&b->inverse);
    il_overlay_free(&b->o);
    il_snapped_free(&b->snapped);
    il_reference_free(&b->r);
    il_phi_free(&b->phi);
    il_pair_free(&b->pair);
    for (int k = 0; k < 2; k++) {
        il_section_free(&b->section[k]);
        il_slice_free(&b->slice[k]);
    }
}

/* Where the inverse takes the reference point P. */
static void back(bench *b, const double p[2], double out[2])
{
    double grid[2], shift[2];
    for (int k = 0; k < 2; k++)
        grid[k] = (p[k] - b->snapped.origin[k]) / b->snapped.cell;
    il_inverse_shift(&b->inverse, grid, shift);
    for (int k = 0; k < 2; k++)
        out[k] = p[k] + shift[k];
}

static void on_the_rings_the_inverse_takes_phi_back(void **state)
{
    (void)state;
    bench b;
    warp w = { warp_wavy, { -20, -5, .8, .4 }, 3 };
    set_up(&b, &w);
    for (size_t i = 0; i < b.pair.n_phi; i++) {
        const il_phi_point *row = &b.pair.phi[i];
        const il_ring *ring = &b.slice[1].ring[row->at.ring];
        const double *from = ring->xy + 2 * row->at.vertex, *to = ring->xy + 2 * ((row->at.vertex + 1) % ring->n);
        double p[2] = { row->x, row->y }, q[2];
        back(&b, p, q);
        for (int k = 0; k < 2; k++)
            assert_true(fabs(q[k] - (from[k] + row->at.t * (to[k] - from[k]))) < 4 * b.snapped.cell);
    }
    tear_down(&b);
}

static void of_an_affine_map_it_is_the_inverse_everywhere(void **state)
{
    (void)state;
    bench b;
    uint64_t s = 7;
    warp w = { warp_affine, { .9, .3, -.2, 1.1, -20, 3 }, 2 };
    set_up(&b, &w);
    const double *box = b.pair.group[0].fit.box;
    for (int i = 0; i < 2000; i++) {
        double p[2], q[2], there[2];
        for (int k = 0; k < 2; k++)
            p[k] = box[k] + stack_uniform(&s) * (box[k + 2] - box[k]);
        back(&b, p, q);
        w.map(q, w.a, there);
        assert_true(hypot(there[0] - p[0], there[1] - p[1]) < 1e-5);
    }
    tear_down(&b);
}

static void it_is_continuous_and_does_not_depend_on_what_was_asked_before(void **state)
{
    (void)state;
    bench b;
    uint64_t s = 3;
    warp w = { warp_wavy, { -20, -5, .8, .4 }, 3 };
    set_up(&b, &w);
    for (int i = 0; i < 2000; i++) {
        double a = TURN * stack_uniform(&s), step = 1e-4, p[2], q[2], there[2], beside[2];
        for (int k = 0; k < 2; k++)
            p[k] = -6 + 12 * stack_uniform(&s);
        q[0] = p[0] + step * cos(a), q[1] = p[1] + step * sin(a);
        back(&b, p, there);
        b.inverse.last = (uint32_t)(stack_random(&s) % b.inverse.n_triangles);
        back(&b, q, beside);
        assert_true(hypot(there[0] - beside[0], there[1] - beside[1]) < 100 * step);
        b.inverse.last = (uint32_t)(stack_random(&s) % b.inverse.n_triangles);
        back(&b, p, beside);
        assert_true(hypot(there[0] - beside[0], there[1] - beside[1]) < 1e-9);
    }
    tear_down(&b);
}

/* Places that a neighbour's insertions make stations of go where phi takes them. */
static void phi_is_known_at_points_that_were_inserted(void **state)
{
    (void)state;
    bench b;
    warp w = { warp_affine, { .9, .3, -.2, 1.1, -20, 3 }, 1 };
    set_up(&b, &w);
    il_section *upper = &b.section[1];
    for (int round = 0; round < 3; round++) { /* the second and third split what the first made */
        il_split split[3];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t station = 7 * k + 2;
            const double *from = upper->xy + 2 * upper->node_at[station], *to = upper->xy + 2 * upper->node_at[upper->next[station]];
            split[k] = (il_split){ station, .3, { from[0] + .3 * (to[0] - from[0]), from[1] + .3 * (to[1] - from[1]) } };
        }
        assert_int_equal(il_section_insert(upper, split, 3, NULL), IL_OK);
    }
    for (uint32_t i = 0; i < upper->n_stations; i++) {
        double there[2], want[2];
        il_phi_at(&b.phi, (il_place){ upper->ring_at[i], upper->vertex_at[i], upper->t_at[i] }, there);
        w.map(upper->xy + 2 * upper->node_at[i], w.a, want);
        assert_true(hypot(there[0] - want[0], there[1] - want[1]) < 1e-12);
    }
    tear_down(&b);
}

static void rows_that_are_not_in_order_are_no_phi(void **state)
{
    (void)state;
    bench b;
    warp w = { warp_affine, { 1, 0, 0, 1, -20, 0 }, 1 };
    set_up(&b, &w);
    il_phi phi;
    il_phi_point *row = b.pair.phi, keep = row[5];
    const il_phi_point wrong[] = {
        { { 0, keep.at.vertex + 1, keep.at.t }, 0, 0 }, { { 1, keep.at.vertex, keep.at.t }, 0, 0 },
        { { 0, keep.at.vertex, 0 }, 0, 0 }, { keep.at, INFINITY, 0 }, { keep.at, 0, NAN }, { keep.at, 0, -1e101 },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        row[5] = wrong[i];
        assert_int_equal(il_phi_index(&phi, &b.pair, &b.section[1], NULL), IL_OK);
        assert_null(phi.pair);
        il_phi_free(&phi);
    }
    row[5] = keep;
    b.pair.n_phi--; /* a bend less does not matter, a vertex less does */
    assert_int_equal(il_phi_index(&phi, &b.pair, &b.section[1], NULL), IL_OK);
    assert_non_null(phi.pair);
    il_phi_free(&phi);
    b.pair.n_phi--;
    assert_int_equal(il_phi_index(&phi, &b.pair, &b.section[1], NULL), IL_OK);
    assert_null(phi.pair);
    il_phi_free(&phi);
    tear_down(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_the_rings_the_inverse_takes_phi_back),
        cmocka_unit_test(of_an_affine_map_it_is_the_inverse_everywhere),
        cmocka_unit_test(it_is_continuous_and_does_not_depend_on_what_was_asked_before),
        cmocka_unit_test(phi_is_known_at_points_that_were_inserted),
        cmocka_unit_test(rows_that_are_not_in_order_are_no_phi),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
