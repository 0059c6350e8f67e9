/* t-loft-gap.c - stacks that are broken off, through the lofter. */
#include "config.h"
#include "base/number.h"
#include "loft/lofter.h"
#include "lofting.h"
#include "region/clean.h"
#include "stacks.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 32 };

/* ---- lofting with gaps ---- */

static void add_box(il_slice *s, double x0, double y0, double x1, double y1)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    assert_true(il_ring_add(r, x0, y0, 0) && il_ring_add(r, x1, y0, 0) && il_ring_add(r, x1, y1, 0) && il_ring_add(r, x0, y1, 0));
}

static void clean_slices(il_slice *slice, size_t n, bool round_float)
{
    il_clean_options c = { .round_float = round_float };
    for (size_t i = 0; i < n; i++) {
        slice[i].z = round_float ? il_number_round_float(slice[i].z) : slice[i].z;
        assert_int_equal(il_slice_clean(&slice[i], &c, NULL, NULL, NULL), IL_OK);
    }
}

/* Clean slice[N] with a gap below slice k where bit k of GAPS is set. */
static il_status loft(keeper *k, const il_slice *slice, size_t n, unsigned long gaps, const il_loft_options *o, il_error *err)
{
    il_pair pair[MOST] = { IL_PAIR_INIT };
    assert_true(n <= MOST);
    *k = new_keeper();
    for (size_t i = 1; i < n; i++)
        pair[i - 1].gap = gaps >> i & 1;
    return loft_pairs(k, slice, n, pair, o, err);
}

static void must_loft(keeper *k, const il_slice *slice, size_t n, unsigned long gaps, const il_loft_options *o,
                      const char *what, uint64_t seed)
{
    il_error err = IL_ERROR_INIT;
    if (loft(k, slice, n, gaps, o, &err) != IL_OK)
        fail_msg("%s %llu: %s", what, (unsigned long long)seed, err.text);
    assert_sound(k, what, seed);
}

/* Equal boxes of 4 x 4 at the heights Z. */
static size_t make_tower(il_slice *slice, const double *z, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        slice[i] = (il_slice)IL_SLICE_INIT;
        slice[i].z = z[i];
        add_box(&slice[i], 0, 0, 4, 4);
    }
    clean_slices(slice, n, false);
    return n;
}

/* ---- closed forms ---- */

static void a_gap_leaves_two_closed_pieces(void **state)
{
    (void)state;
    static const double z[] = { 0, 1, 9, 12 };
    il_slice slice[4];
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k;
    make_tower(slice, z, 4);
    must_loft(&k, slice, 4, 1 << 2, &o, "tower", 0);
    assert_int_equal(k.facts.components, 2);
    assert_int_equal(k.facts.genus, 0);
    assert_int_equal(k.facts.triangles, 24);
    assert_int_equal(k.facts.vertices, 16);
    assert_true(fabs(k.facts.volume - 16 * 4) < 1e-12);
    assert_true(fabs(k.facts.area - (4 * 16 + 16 * 4)) < 1e-12);
    il_mesh_free(&k.mesh);
    must_loft(&k, slice, 4, 0, &o, "joined", 0);
    assert_int_equal(k.facts.components, 1);
    assert_true(fabs(k.facts.volume - 16 * 12) < 1e-12);
    il_mesh_free(&k.mesh);
    free_slices(slice, 4);
}

static void a_hole_ends_at_the_lids_of_a_gap(void **state)
{
    (void)state;
    il_slice slice[4] = { IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k;
    for (int i = 0; i < 4; i++) {
        slice[i].z = i;
        add_box(&slice[i], 0, 0, 9, 9);
        add_box(&slice[i], 3, 3, 6, 6);
    }
    clean_slices(slice, 4, false);
    must_loft(&k, slice, 4, 1 << 2, &o, "tube", 0);
    assert_int_equal(k.facts.components, 2);
    assert_int_equal(k.facts.genus, 2);
    assert_true(fabs(k.facts.volume - 72 * 2) < 1e-12);
    il_mesh_free(&k.mesh);
    free_slices(slice, 4);
}

/* The least and the greatest height of vertices between LOW and HIGH. */
static void reach(const keeper *k, double low, double high, double *least, double *greatest)
{
    *least = INFINITY, *greatest = -INFINITY;
    for (size_t v = 0; v < k->mesh.n_vertices; v++) {
        double z = k->mesh.xyz[3 * v + 2];
        if (z < low || z > high)
            continue;
        *least = fmin(*least, z);
        *greatest = fmax(*greatest, z);
    }
}

static void both_sides_of_a_gap_get_domes_of_half_their_own_spacing(void **state)
{
    (void)state;
    static const double z[] = { 0, 2, 20, 21 };
    il_slice slice[4];
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    double low, high;
    keeper k;
    o.cap = IL_CAP_DOME;
    make_tower(slice, z, 4);
    must_loft(&k, slice, 4, 1 << 2, &o, "domes", 0);
    assert_int_equal(k.facts.components, 2);
    reach(&k, -5, 10, &low, &high);
    assert_true(low >= -1 && low < -.9 && high <= 3 && high > 2.9);
    reach(&k, 10, 30, &low, &high);
    assert_true(low >= 19.5 && low < 19.55 && high <= 21.5 && high > 21.45);
    il_mesh_free(&k.mesh);
    free_slices(slice, 4);
}

static void domes_never_meet_in_a_narrow_gap(void **state)
{
    (void)state;
    static const double z[] = { 0, 10, 11, 21 };
    il_slice slice[4];
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    double low, high;
    keeper k;
    o.cap = IL_CAP_DOME;
    make_tower(slice, z, 4);
    must_loft(&k, slice, 4, 1 << 2, &o, "narrow", 0);
    assert_int_equal(k.facts.components, 2);
    reach(&k, 5, 10.5, &low, &high);
    assert_true(high > 10 && high <= 10.25);
    reach(&k, 10.5, 15, &low, &high);
    assert_true(low < 11 && low >= 10.75);
    il_mesh_free(&k.mesh);
    free_slices(slice, 4);
}

/* ---- slices that stand alone ---- */

static void a_slice_alone_beside_a_gap_is_refused_by_its_height(void **state)
{
    (void)state;
    static const double z[] = { 0, 1, 2.5, 9, 10 };
    static const struct { unsigned long gaps; const char *height; } cases[] = {
        { 1 << 1, "z = 0 " }, { 1 << 4, "z = 10 " }, { 1 << 2 | 1 << 3, "z = 2.5 " }, { 1 << 1 | 1 << 2, "z = 0 " } };
    for (int dome = 0; dome < 2; dome++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            il_slice slice[5];
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            il_error err = IL_ERROR_INIT;
            keeper k;
            o.cap = dome ? IL_CAP_DOME : IL_CAP_FLAT;
            make_tower(slice, z, 5);
            assert_int_equal(loft(&k, slice, 5, cases[i].gaps, &o, &err), IL_E_INPUT);
            assert_non_null(strstr(err.text, cases[i].height));
            assert_true(k.abandoned == 1 && k.ended == 0);
            il_mesh_free(&k.mesh);
            free_slices(slice, 5);
        }
}

static void an_empty_slice_may_stand_alone_anywhere(void **state)
{
    (void)state;
    static const double z[] = { 0, 1, 2, 3, 4, 5, 6 };
    for (int dome = 0; dome < 2; dome++) {
        il_slice slice[7];
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        keeper k;
        o.cap = dome ? IL_CAP_DOME : IL_CAP_FLAT;
        make_tower(slice, z, 7);
        for (int i = 0; i < 7; i += 3) {
            il_slice_free(&slice[i]);
            slice[i].z = z[i];
        }
        must_loft(&k, slice, 7, 1 << 1 | 1 << 3 | 1 << 4 | 1 << 6, &o, "hollow", (uint64_t)dome);
        assert_int_equal(k.facts.components, 2);
        il_mesh_free(&k.mesh);
        free_slices(slice, 7);
    }
}

/* ---- what meets at a gap's slice ---- */

static void pinches_in_the_slices_of_a_gap_are_split_for_their_piece(void **state)
{
    (void)state;
    il_slice slice[4] = { IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k, one;
    for (int i = 0; i < 4; i++) {
        slice[i].z = i;
        add_box(&slice[i], 0, 0, 2, 2);
        add_box(&slice[i], 2, 2, 4, 4);
    }
    clean_slices(slice, 4, false);
    must_loft(&k, slice, 4, 1 << 2, &o, "pinches", 0);
    must_loft(&one, slice, 2, 0, &o, "pinches", 1);
    assert_int_equal(k.facts.pinches, 2 * one.facts.pinches);
    assert_int_equal(k.facts.components, 2 * one.facts.components);
    assert_int_equal(k.facts.triangles, 2 * one.facts.triangles);
    il_mesh_free(&k.mesh);
    il_mesh_free(&one.mesh);
    free_slices(slice, 4);
}

/* Does the mesh have inserted vertices in the plane of slice K? */
static bool has_inserted(const keeper *k, int32_t slice)
{
    for (size_t v = 0; v < k->mesh.n_vertices; v++)
        if (k->mesh.origin[v].slice == slice && k->mesh.origin[v].ring < 0)
            return true;
    return false;
}

/* Squares by turns upright and on their tip: their contours cross, and points are
 * put on either, after the gap's lids could have been laid. */
static void lids_have_what_is_inserted_on_either_side(void **state)
{
    (void)state;
    for (size_t n = 4; n <= 7; n++) {
        il_slice slice[7];
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        keeper k;
        for (size_t i = 0; i < n; i++) {
            slice[i] = (il_slice)IL_SLICE_INIT;
            slice[i].z = (double)i;
            if (i % 2) {
                add_box(&slice[i], -3, -3, 3, 3);
            } else {
                il_ring *r = il_slice_add_ring(&slice[i]);
                assert_non_null(r);
                assert_true(il_ring_add(r, 0, -4, 0) && il_ring_add(r, 4, 0, 0) && il_ring_add(r, 0, 4, 0) && il_ring_add(r, -4, 0, 0));
            }
        }
        clean_slices(slice, n, false);
        for (size_t gap = 2; gap + 2 <= n; gap++) {
            must_loft(&k, slice, n, 1ul << gap, &o, "tips", 10 * n + gap);
            assert_int_equal(k.facts.components, 2);
            assert_true(has_inserted(&k, (int32_t)gap - 1) && has_inserted(&k, (int32_t)gap));
            il_mesh_free(&k.mesh);
        }
        free_slices(slice, n);
    }
}

/* ---- any stack, any gaps ---- */

/* Gaps for N slices that leave no slice alone. */
static unsigned long random_gaps(uint64_t *s, size_t n)
{
    unsigned long gaps = 0;
    size_t run = 1;
    for (size_t k = 1; k < n; k++, run++)
        if (run >= 2 && k + 2 <= n && stack_random(s) % 3 == 0) {
            gaps |= 1ul << k;
            run = 0;
        }
    return gaps;
}

/* A stack of six slices at the least, of parts of one kind. */
static size_t make_stack(il_slice slice[MOST], stack_kind kind, uint64_t seed, size_t least)
{
    size_t n = 0;
    while (n < least) {
        il_slice part[6];
        size_t m = stack_make(kind, seed++, part);
        double z = n > 0 ? slice[n - 1].z + 1.25 : 0;
        for (size_t i = 0; i < m; i++) {
            slice[n] = part[i];
            slice[n++].z += z;
        }
    }
    return n;
}

/* The runs of a stack lofted one by one; *TRIANGLES of those that begin where the
 * even slabs do, whose meshes are the same then. */
static void add_up(const il_slice *slice, size_t n, unsigned long gaps, const il_loft_options *o, il_mesh_facts *sum, bool *all_even)
{
    *sum = (il_mesh_facts){ 0 };
    *all_even = true;
    for (size_t first = 0, end; first < n; first = end) {
        keeper k;
        for (end = first + 1; end < n && !(gaps >> end & 1); end++)
            continue;
        must_loft(&k, slice + first, end - first, 0, o, "run at", first);
        *all_even &= first % 2 == 0;
        sum->components += k.facts.components;
        sum->genus += k.facts.genus;
        sum->volume += k.facts.volume;
        sum->triangles += k.facts.triangles;
        il_mesh_free(&k.mesh);
    }
}

/* In which order slabs insert their points depends on where they stand in the
 * stack, so pieces that begin at an odd slice are equal but for that. */
static void pieces_are_what_their_slices_make_alone(void **state)
{
    (void)state;
    uint64_t n_seeds = getenv("ISOLOFT_LONG") ? 200 : 20;
    for (int kind = 0; kind < STACK_TANGLED; kind++)
        for (uint64_t seed = 1; seed <= n_seeds; seed++) {
            il_slice slice[MOST];
            size_t n = make_stack(slice, (stack_kind)kind, seed, 6);
            uint64_t s = seed;
            unsigned long gaps = random_gaps(&s, n);
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            il_mesh_facts sum;
            bool all_even;
            keeper k;
            o.round_float = seed % 4 == 0;
            clean_slices(slice, n, o.round_float);
            must_loft(&k, slice, n, gaps, &o, "seed", seed);
            add_up(slice, n, gaps, &o, &sum, &all_even);
            if (all_even) {
                assert_int_equal(k.facts.components, sum.components);
                assert_int_equal(k.facts.genus, sum.genus);
                assert_int_equal(k.facts.triangles, sum.triangles);
                assert_true(fabs(k.facts.volume - sum.volume) <= 1e-9 * sum.volume);
            }
            assert_true(fabs(k.facts.volume - sum.volume) <= .02 * sum.volume);
            il_mesh_free(&k.mesh);
            free_slices(slice, n);
        }
}

static void domes_are_sound_at_any_gaps(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        il_slice slice[MOST];
        size_t n = make_stack(slice, (stack_kind)(seed % STACK_TANGLED), seed, 6);
        uint64_t s = seed;
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        keeper k;
        o.cap = IL_CAP_DOME;
        o.round_float = seed % 3 == 0;
        clean_slices(slice, n, o.round_float);
        must_loft(&k, slice, n, random_gaps(&s, n), &o, "domes, seed", seed);
        il_mesh_free(&k.mesh);
        free_slices(slice, n);
    }
}

static void the_mesh_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    static const int threads[] = { 2, 3, 8 };
    for (uint64_t seed = 1; seed <= 12; seed++) {
        il_slice slice[MOST];
        size_t n = make_stack(slice, (stack_kind)(seed % STACK_TANGLED), seed, 20);
        uint64_t s = seed;
        unsigned long gaps = random_gaps(&s, n);
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        keeper one;
        o.cap = seed % 2 ? IL_CAP_DOME : IL_CAP_FLAT;
        clean_slices(slice, n, false);
        must_loft(&one, slice, n, gaps, &o, "threads, seed", seed);
        for (size_t i = 0; i < 3; i++) {
            keeper k;
            o.threads = threads[i];
            must_loft(&k, slice, n, gaps, &o, "threads, seed", seed);
            assert_same_mesh(&one.mesh, &k.mesh);
            il_mesh_free(&k.mesh);
        }
        il_mesh_free(&one.mesh);
        free_slices(slice, n);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gap_leaves_two_closed_pieces),
        cmocka_unit_test(a_hole_ends_at_the_lids_of_a_gap),
        cmocka_unit_test(both_sides_of_a_gap_get_domes_of_half_their_own_spacing),
        cmocka_unit_test(domes_never_meet_in_a_narrow_gap),
        cmocka_unit_test(a_slice_alone_beside_a_gap_is_refused_by_its_height),
        cmocka_unit_test(an_empty_slice_may_stand_alone_anywhere),
        cmocka_unit_test(pinches_in_the_slices_of_a_gap_are_split_for_their_piece),
        cmocka_unit_test(lids_have_what_is_inserted_on_either_side),
        cmocka_unit_test(pieces_are_what_their_slices_make_alone),
        cmocka_unit_test(domes_are_sound_at_any_gaps),
        cmocka_unit_test(the_mesh_is_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
