/* t-gap.c - the stage that marks gaps and thickens slices, and the spacing it goes by. */
#include "config.h"
#include "base/alloc.h"
#include "model/spacing.h"
#include "region/gapper.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/* ---- spacing ---- */

static void the_usual_spacing_is_the_median_and_the_lower_of_two(void **state)
{
    (void)state;
    static const double odd[] = { 0, 3, 5, 15 }, even[] = { 0, 3, 60 };
    il_spacing s;
    assert_int_equal(il_spacing_measure(&s, odd, 4, NULL), IL_OK);
    assert_true(s.least == 2 && s.usual == 3 && s.largest == 10);
    assert_int_equal(il_spacing_measure(&s, even, 3, NULL), IL_OK);
    assert_true(s.least == 3 && s.usual == 3 && s.largest == 57);
}

static void fewer_than_two_slices_have_no_spacing(void **state)
{
    (void)state;
    static const double z[] = { 7 };
    for (size_t n = 0; n < 2; n++) {
        il_spacing s = { 1, 1, 1 };
        assert_int_equal(il_spacing_measure(&s, z, n, NULL), IL_OK);
        assert_true(s.least == 0 && s.usual == 0 && s.largest == 0);
    }
}

static void only_beyond_two_and_a_half_spacings_there_is_a_gap(void **state)
{
    (void)state;
    const il_spacing s = { 2, 2, 9 };
    assert_false(il_spacing_is_gap(&s, 1, 6));
    assert_true(il_spacing_is_gap(&s, 1, 6.0000001));
}

/* ---- a next stage that writes all down ---- */

/* words: "(", a slice's height with "e" where it is empty and "*" where it was
 * inserted, "g" for a gap, "p" for another record, ")" and "."; fault: that of
 * the last head, or "". */
typedef struct listener {
    il_sink sink;
    char words[400], fault[200];
    il_slice last;
} listener;

static il_status hear(listener *l, const char *word)
{
    strncat(l->words, word, sizeof l->words - strlen(l->words) - 1);
    return IL_OK;
}

static il_status on_stack_begin(il_sink *s, const il_stack_head *head, il_error *err)
{
    listener *l = (listener *)s;
    (void)err;
    snprintf(l->fault, sizeof l->fault, "%s", head->fault ? head->fault : "");
    return hear(l, "(");
}

static il_status on_slice(il_sink *s, il_slice *slice, il_error *err)
{
    listener *l = (listener *)s;
    char word[40];
    (void)err;
    snprintf(word, sizeof word, " %.10g%s%s", slice->z, slice->n == 0 ? "e" : "", il_slice_is_inserted(slice) ? "*" : "");
    il_slice_free(&l->last);
    l->last = *slice;
    *slice = (il_slice)IL_SLICE_INIT;
    return hear(l, word);
}

static il_status on_pair(il_sink *s, il_pair *pair, il_error *err)
{
    (void)err;
    bool gap = pair->gap;
    il_pair_free(pair);
    return hear((listener *)s, gap ? "g" : "p");
}

static il_status on_stack_end(il_sink *s, il_error *err)
{
    (void)err;
    return hear((listener *)s, ")");
}

static il_status on_end(il_sink *s, il_error *err)
{
    (void)err;
    return hear((listener *)s, ".");
}

/* ---- stacks, as words ---- */

/* A slice at z, empty or with a triangle, and the record behind it: 'g', 'p' or 0. */
typedef struct rung {
    double z;
    char record;
    bool empty;
} rung;

static il_status send_rung(il_sink *to, const rung *r, il_error *err)
{
    il_slice slice = IL_SLICE_INIT;
    il_pair pair = IL_PAIR_INIT;
    slice.z = r->z;
    slice.line = 100 + (long)r->z;
    il_ring *ring = r->empty ? NULL : il_slice_add_ring(&slice);
    bool ok = r->empty || (ring && il_ring_add(ring, 0, 0, 0) && il_ring_add(ring, 4, 0, 0) && il_ring_add(ring, 0, 3, 0) &&
                           il_extra_add(&ring->extra, "x-r", 3) && il_extra_add(&slice.extra, "x-s", 3));
    il_status st = ok ? to->slice(to, &slice, err) : il_fail_nomem(err);
    pair.gap = r->record == 'g';
    if (st == IL_OK && r->record)
        st = to->pair(to, &pair, err);
    il_slice_free(&slice);
    il_pair_free(&pair);
    return st;
}

/* The rungs as one stack of HEAD through the stage. */
static il_status play(listener *l, const rung *r, size_t n, const il_stack_head *head, const il_gap_options *o,
                      il_report *report, il_error *err)
{
    il_sink *g = NULL;
    *l = (listener){ .sink = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end } };
    il_status st = il_gapper_new(&g, o, &l->sink, report, err);
    if (st == IL_OK)
        st = g->stack_begin(g, head, err);
    for (size_t k = 0; st == IL_OK && k < n; k++)
        st = send_rung(g, &r[k], err);
    if (st == IL_OK)
        st = g->stack_end(g, err);
    if (st == IL_OK)
        st = g->end(g, err);
    il_gapper_free(g);
    return st;
}

static void assert_heard(const char *wanted, const rung *r, size_t n, const il_stack_head *head, const il_gap_options *o)
{
    listener l;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(play(&l, r, n, head, o, NULL, &err), IL_OK);
    assert_string_equal(l.words, wanted);
    assert_string_equal(l.fault, "");
    il_slice_free(&l.last);
}

#define COUNT(a) (sizeof(a) / sizeof *(a))
static const il_stack_head plain = IL_STACK_HEAD_INIT;
static const il_gap_options as_given = IL_GAP_OPTIONS_INIT, cap = { IL_GAPS_CAP, 0, false },
                            bridge = { IL_GAPS_BRIDGE, 0, false }, refuse = { IL_GAPS_FAIL, 0, false };

/* ---- gaps ---- */

static void a_stack_without_gaps_passes_as_it_came(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { 1, 'p', false }, { .z = 2, .empty = true }, { 4.5, 'p', false } };
    assert_heard("( 0 1p 2e 4.5p).", r, COUNT(r), &plain, &cap);
    assert_heard("( 0 1p 2e 4.5p).", r, COUNT(r), &plain, &refuse);
    assert_heard("().", r, 0, &plain, &cap);
}

static void a_wide_distance_becomes_a_gap_whatever_was_said_of_it(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { 9, 'p', false }, { 10, 'p', false }, { .z = 20 }, { .z = 21 } };
    assert_heard("( 0 1 9g 10p 20g 21).", r, COUNT(r), &plain, &cap);
    assert_heard("( 0 1 9p 10p 20 21).", r, COUNT(r), &plain, &as_given);
    assert_heard("( 0 1 9p 10p 20 21).", r, COUNT(r), &plain, &bridge);
}

static void bridging_joins_what_the_stream_calls_a_gap(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { 2, 'g', false }, { .z = 3 } };
    assert_heard("( 0 1 2g 3).", r, COUNT(r), &plain, &as_given);
    assert_heard("( 0 1 2g 3).", r, COUNT(r), &plain, &cap);
    assert_heard("( 0 1 2 3).", r, COUNT(r), &plain, &bridge);
}

static void a_refused_gap_is_a_fault_that_names_both_slices(void **state)
{
    (void)state;
    static const rung wide[] = { { .z = -1 }, { .z = 0.5 }, { .z = 9.25 }, { .z = 10 } },
                      given[] = { { .z = 0 }, { .z = 1 }, { 2, 'g', false }, { .z = 3 } };
    listener l;
    assert_int_equal(play(&l, wide, COUNT(wide), &plain, &refuse, NULL, NULL), IL_OK);
    assert_string_equal(l.words, "().");
    assert_string_equal(l.fault, "a gap from z = 0.5 to z = 9.25, where slices are usually 1.5 apart (--gap fail)");
    assert_int_equal(play(&l, given, COUNT(given), &plain, &refuse, NULL, NULL), IL_OK);
    assert_non_null(strstr(l.fault, "from z = 1 to z = 2"));
}

static void terrain_has_no_gaps(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { 9, 'p', false } };
    il_stack_head head = IL_STACK_HEAD_INIT;
    head.kind = IL_KIND_TERRAIN;
    assert_heard("( 0 1 9p).", r, COUNT(r), &head, &cap);
    assert_heard("( 0).", r, 1, &head, &cap);
}

static void a_record_in_the_wrong_place_is_refused(void **state)
{
    (void)state;
    static const rung first[] = { { 0, 'g', false } };
    il_error err = IL_ERROR_INIT;
    listener l;
    assert_int_equal(play(&l, first, 1, &plain, &cap, NULL, &err), IL_E_INPUT);
    assert_non_null(strstr(err.text, "must follow the upper one"));
}

/* ---- slices that stand alone ---- */

static void a_stack_of_one_slice_is_thickened(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 10 } };
    const il_gap_options two = { IL_GAPS_AS_GIVEN, 2, false };
    il_stack_head head = IL_STACK_HEAD_INIT;
    assert_heard("( 9* 10 11*).", r, 1, &head, &two);
    head.usual_spacing = 5;
    assert_heard("( 9* 10 11*).", r, 1, &head, &two);
    assert_heard("( 7.5* 10 12.5*).", r, 1, &head, &bridge);
    head.length_scale = 0.25; /* 2 of the input's units */
    assert_heard("( 9.75* 10 10.25*).", r, 1, &head, &two);
}

static void without_any_spacing_a_millimetre_is_assumed_and_told(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 10 } };
    static const struct { il_unit unit; const char *words; } units[] = {
        { IL_UNIT_MM, "( 9.5* 10 10.5*)." }, { IL_UNIT_CM, "( 9.95* 10 10.05*)." },
        { IL_UNIT_UM, "( -490* 10 510*)." }, { IL_UNIT_DEG, "( 9.9995* 10 10.0005*)." } };
    for (size_t k = 0; k < COUNT(units); k++) {
        il_report report = IL_REPORT_INIT;
        il_stack_head head = IL_STACK_HEAD_INIT;
        listener l;
        head.unit = units[k].unit;
        assert_int_equal(play(&l, r, 1, &head, &cap, &report, NULL), IL_OK);
        assert_string_equal(l.words, units[k].words);
        assert_int_equal(report.n_notes, 1);
        assert_string_equal(report.note[0], "a thickness of 1 mm is assumed for the single slice (--thickness says otherwise)");
        assert_int_equal(report.repair[IL_REPAIR_THICKENED_SLICE], 1);
        assert_true(il_report_any(&report));
        il_report_free(&report);
        il_slice_free(&l.last);
    }
}

static void slices_alone_between_gaps_and_ends_are_thickened(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 20 }, { .z = 40 }, { .z = 41 }, { .z = 42 }, { .z = 43 }, { .z = 44 }, { .z = 60 } };
    assert_heard("( -0.5* 0 0.5* 19.5*g 20 20.5* 40g 41 42 43 44 59.5*g 60 60.5*).", r, COUNT(r), &plain, &cap);
    assert_heard("( 0 20 40 41 42 43 44 60).", r, COUNT(r), &plain, &bridge);
}

static void a_thickness_keeps_clear_of_the_neighbours(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { 11, 'g', false }, { 15, 'g', false }, { .z = 16 } };
    const il_gap_options thick = { IL_GAPS_AS_GIVEN, 100, false };
    il_report report = IL_REPORT_INIT;
    listener l;
    assert_int_equal(play(&l, r, COUNT(r), &plain, &thick, &report, NULL), IL_OK);
    assert_string_equal(l.words, "( 0 1 9.2*g 11 12.8* 15g 16).");
    assert_int_equal(report.n_notes, 1);
    assert_string_equal(report.note[0], "1 of 1 single slices are less than 100 thick, to keep clear of their neighbours; "
                        "the first, at z = 11, is 3.6");
    il_report_free(&report);
    il_slice_free(&l.last);
}

static void a_thickness_below_the_numbers_there_is_a_fault(void **state)
{
    (void)state;
    static const rung far[] = { { .z = 1e14 } }, last[] = { { .z = 9.9e14 } };
    const il_gap_options thin = { IL_GAPS_AS_GIVEN, 1e-3, false }, thick = { IL_GAPS_AS_GIVEN, 9e14, false };
    listener l;
    assert_int_equal(play(&l, far, 1, &plain, &thin, NULL, NULL), IL_OK);
    assert_string_equal(l.words, "().");
    assert_string_equal(l.fault, "the single slice at z = 1e+14 cannot be made 0.001 thick");
    assert_int_equal(play(&l, last, 1, &plain, &thick, NULL, NULL), IL_OK);
    assert_string_equal(l.words, "().");
}

static void copies_have_the_rings_and_no_private_lines(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 10 } };
    static const double xy[] = { 0, 0, 4, 0, 0, 3 };
    listener l;
    assert_int_equal(play(&l, r, 1, &plain, &cap, NULL, NULL), IL_OK);
    assert_true(l.last.z == 10.5 && l.last.n == 1 && l.last.ring[0].n == 3);
    assert_memory_equal(l.last.ring[0].xy, xy, sizeof xy);
    assert_null(l.last.extra);
    assert_null(l.last.ring[0].extra);
    il_slice_free(&l.last);
}

/* ---- empty slices ---- */

static void empty_slices_are_kept_and_never_thickened(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { .z = 9, .empty = true }, { .z = 17 }, { .z = 18 }, { .z = 19 } };
    assert_heard("( 0 1 9eg 17g 18 19).", r, COUNT(r), &plain, &cap);
}

static void empty_slices_that_say_nothing_are_dropped(void **state)
{
    (void)state;
    static const rung r[] = { { .z = -1, .empty = true }, { 0, 'p', false }, { 1, 'p', false }, { 2, 'p', true },
                              { 3, 'p', false }, { 4, 'p', false }, { 5, 'p', true } };
    const il_gap_options drop = { IL_GAPS_CAP, 0, true };
    assert_heard("( 0 1p 3 4p).", r, COUNT(r), &plain, &drop);
}

static void a_gap_beside_a_dropped_slice_stays_one(void **state)
{
    (void)state;
    static const rung below[] = { { .z = 0 }, { .z = 1 }, { 2, 'g', true }, { 3, 'p', false }, { .z = 4 } },
                      above[] = { { .z = 0 }, { .z = 1 }, { .z = 2, .empty = true }, { 2.5, 'p', true }, { 3, 'g', false }, { .z = 4 } },
                      end[] = { { .z = -1, .empty = true }, { 0, 'g', false }, { .z = 1 } };
    const il_gap_options drop = { IL_GAPS_AS_GIVEN, 0, true };
    assert_heard("( 0 1 3g 4).", below, COUNT(below), &plain, &drop);
    assert_heard("( 0 1 3g 4).", above, COUNT(above), &plain, &drop);
    assert_heard("( 0 1).", end, COUNT(end), &plain, &drop);
}

/* ---- memory ---- */

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static const rung r[] = { { .z = 0 }, { .z = 1 }, { .z = 2, .empty = true }, { .z = 3 }, { .z = 4 }, { .z = 20 } };
    const il_gap_options o = { IL_GAPS_CAP, 1, true };
    il_status st = IL_E_NOMEM;
    for (long k = 0; st != IL_OK; k++) {
        listener l = { .fault = "" };
        il_error err = IL_ERROR_INIT;
        assert_true(k < 1000);
        il_alloc_test_fail_after(k);
        st = play(&l, r, COUNT(r), &plain, &o, NULL, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        il_slice_free(&l.last);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_usual_spacing_is_the_median_and_the_lower_of_two),
        cmocka_unit_test(fewer_than_two_slices_have_no_spacing),
        cmocka_unit_test(only_beyond_two_and_a_half_spacings_there_is_a_gap),
        cmocka_unit_test(a_stack_without_gaps_passes_as_it_came),
        cmocka_unit_test(a_wide_distance_becomes_a_gap_whatever_was_said_of_it),
        cmocka_unit_test(bridging_joins_what_the_stream_calls_a_gap),
        cmocka_unit_test(a_refused_gap_is_a_fault_that_names_both_slices),
        cmocka_unit_test(terrain_has_no_gaps),
        cmocka_unit_test(a_record_in_the_wrong_place_is_refused),
        cmocka_unit_test(a_stack_of_one_slice_is_thickened),
        cmocka_unit_test(without_any_spacing_a_millimetre_is_assumed_and_told),
        cmocka_unit_test(slices_alone_between_gaps_and_ends_are_thickened),
        cmocka_unit_test(a_thickness_keeps_clear_of_the_neighbours),
        cmocka_unit_test(a_thickness_below_the_numbers_there_is_a_fault),
        cmocka_unit_test(copies_have_the_rings_and_no_private_lines),
        cmocka_unit_test(empty_slices_are_kept_and_never_thickened),
        cmocka_unit_test(empty_slices_that_say_nothing_are_dropped),
        cmocka_unit_test(a_gap_beside_a_dropped_slice_stays_one),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
