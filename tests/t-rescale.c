#include "config.h"
#include "model/rescale.h"
#include "test.h"

#include <math.h>


/* Keeps what arrives last. */
typedef struct keeper { il_sink sink; il_unit unit; double z, x, y, origin, usual, scale; bool has_crs, gap;
                        size_t n_spots; il_spot spot[2]; double cut[2]; } keeper;

static il_status keep_begin(il_sink *s, const il_stack_head *h, il_error *err)
{
    (void)err;
    keeper *k = (keeper *)s;
    k->unit = h->unit;
    k->origin = h->frame[0];
    k->has_crs = h->crs != NULL;
    k->usual = h->usual_spacing;
    k->scale = h->length_scale;
    k->n_spots = h->n_spots;
    for (size_t i = 0; i < h->n_spots && i < 2; i++)
        k->spot[i] = h->spot[i];
    return IL_OK;
}

static il_status keep_slice(il_sink *s, il_slice *slice, il_error *err)
{
    (void)err;
    keeper *k = (keeper *)s;
    k->z = slice->z;
    k->x = slice->ring[0].xy[0];
    k->y = slice->ring[0].xy[1];
    return IL_OK;
}

static il_status keep_pair(il_sink *s, il_pair *p, il_error *err)
{
    keeper *k = (keeper *)s;
    if (p->n_cuts > 0) {
        k->cut[0] = p->cut[0].xy[2];
        k->cut[1] = p->cut[0].xy[3];
    }
    k->gap = p->gap;
    (void)err;
    return IL_OK;
}

static il_status keep_end(il_sink *s, il_error *err)
{
    (void)s;
    (void)err;
    return IL_OK;
}

static double z_beside = 7; /* of a spot that is next to another in x */

static il_status rescale(il_unit from, il_unit to, double z, double x, double y,
                         keeper *k, il_report *report, il_error *err)
{
    *k = (keeper){ .sink = { keep_begin, keep_slice, keep_pair, keep_end, keep_end } };
    il_sink *r = NULL;
    il_status st = il_rescaler_new(&r, to, &k->sink, report, err);
    il_stack_head head = IL_STACK_HEAD_INIT;
    head.unit = from;
    head.has_frame = true;
    head.frame[0] = x;
    head.usual_spacing = 3;
    head.crs = (char *)"EPSG:28992";
    il_spot spots[] = { { .x = x, .y = y, .z = z }, { .x = nextafter(x, INFINITY), .y = y, .z = z_beside } };
    head.spot = spots;
    head.n_spots = 2;
    il_slice slice = IL_SLICE_INIT;
    slice.z = z;
    assert_true(il_ring_add(il_slice_add_ring(&slice), x, y, 0));
    st = st == IL_OK ? r->stack_begin(r, &head, err) : st;
    st = st == IL_OK ? r->slice(r, &slice, err) : st;
    il_pair gap = { .gap = true };
    il_cut cut = { .xy = (double[]){ 0, 0, x, y }, .n = 2 };
    il_pair with_cut = { .cut = &cut, .n_cuts = 1 };
    st = st == IL_OK ? r->pair(r, &with_cut, err) : st;
    st = st == IL_OK ? r->pair(r, &gap, err) : st;
    st = st == IL_OK ? r->stack_end(r, err) : st;
    il_slice_free(&slice);
    il_rescaler_free(r);
    return st;
}

static void lengths_change_with_their_unit(void **state)
{
    (void)state;
    static const struct { il_unit from, to; double x, y; } c[] = {
        { IL_UNIT_MM, IL_UNIT_M, 1500, 1.5 }, { IL_UNIT_M, IL_UNIT_MM, 0.25, 250 }, { IL_UNIT_IN, IL_UNIT_MM, 10, 254 },
        { IL_UNIT_FT, IL_UNIT_IN, 2, 24 }, { IL_UNIT_KM, IL_UNIT_UM, 1, 1e9 }, { IL_UNIT_CM, IL_UNIT_FT, 30.48, 1 },
        { IL_UNIT_MM, IL_UNIT_M, 0.1, 0.0001 } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        keeper to;
        il_report report = IL_REPORT_INIT;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(rescale(c[k].from, c[k].to, c[k].x, c[k].x, -c[k].x, &to, &report, &err), IL_OK);
        assert_int_equal(to.unit, c[k].to);
        assert_true(to.z == c[k].y && to.x == c[k].y && to.y == -c[k].y && to.origin == c[k].y);
        assert_true(fabs(to.cut[0] - to.x) <= 1e-15 * to.x && to.cut[1] == -to.cut[0]);
        assert_false(to.has_crs);
        assert_true(fabs(to.usual - 3 * to.scale) <= 1e-15 * to.usual && fabs(to.scale * c[k].x - c[k].y) <= 1e-15 * c[k].y && to.gap);
        assert_int_equal(report.n_notes, 2);
        assert_false(il_report_any(&report));
        il_report_free(&report);
    }
}

static void spot_heights_that_rounding_brings_together_must_agree(void **state)
{
    (void)state;
    int n_apart = 0, n_met = 0;
    for (double x = 1000.5; x < 1020; x++) {
        keeper to;
        il_report report = IL_REPORT_INIT;
        il_error err = IL_ERROR_INIT;
        z_beside = 7;
        assert_int_equal(rescale(IL_UNIT_MM, IL_UNIT_M, 4, x, 2, &to, &report, &err), IL_OK);
        assert_int_equal(report.n_skipped, 2 - to.n_spots);
        assert_true(to.n_spots == 0 || (to.spot[0].x < to.spot[1].x && to.spot[0].z == 0.004 && to.spot[1].z == 0.007));
        n_apart += to.n_spots == 2;
        n_met += to.n_spots == 0;
        z_beside = 4;
        bool was_met = to.n_spots == 0;
        assert_int_equal(rescale(IL_UNIT_MM, IL_UNIT_M, 4, x, 2, &to, NULL, &err), IL_OK);
        assert_int_equal(to.n_spots, was_met ? 1 : 2);
        assert_true(to.spot[0].x == x / 1000 && to.spot[0].y == 0.002 && to.spot[0].z == 0.004);
        il_report_free(&report);
    }
    assert_true(n_apart > 0 && n_met > 0 && n_apart + n_met == 20);
}

static void the_same_unit_touches_nothing(void **state)
{
    (void)state;
    keeper to;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(rescale(IL_UNIT_FT, IL_UNIT_FT, 1, 0.1, 0.3, &to, &report, &err), IL_OK);
    assert_true(to.x == 0.1 && to.y == 0.3 && to.has_crs && to.usual == 3 && to.scale == 0 && to.gap);
    assert_int_equal(report.n_notes, 0);
}

static void exact_conversions_are_known_to_be_exact(void **state)
{
    (void)state;
    bool exact;
    assert_true(il_rescale_value(1500, 1, 1000, &exact) == 1.5 && exact);
    il_rescale_value(1, 1, 1000, &exact);
    assert_false(exact);
    assert_true(il_rescale_value(0.1, 1000, 1, &exact) == 100 && !exact); /* 0.1 is not a tenth */
    assert_true(il_rescale_value(0.5, 127, 5, &exact) == 12.7 && !exact);
    assert_true(il_rescale_value(10, 127, 5, &exact) == 254 && exact);
    assert_true(il_rescale_value(0, 127, 5000, &exact) == 0 && exact);
}

static void degrees_and_overflow_are_refused(void **state)
{
    (void)state;
    keeper to;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(rescale(IL_UNIT_DEG, IL_UNIT_M, 1, 1, 1, &to, NULL, &err), IL_E_INPUT);
    err = (il_error)IL_ERROR_INIT;
    assert_int_equal(rescale(IL_UNIT_KM, IL_UNIT_UM, 1, 2e6, 1, &to, NULL, &err), IL_E_INPUT);
}

static void a_length_is_rounded_once(void **state)
{
    (void)state;
    assert_true(il_rescale_length(6, IL_UNIT_IN, IL_UNIT_MM) == 152.4);
    assert_true(il_rescale_length(15, IL_UNIT_CM, IL_UNIT_MM) == 150);
    assert_true(il_rescale_length(0.15, IL_UNIT_M, IL_UNIT_MM) == 150);
    assert_true(il_rescale_length(0.1, IL_UNIT_MM, IL_UNIT_MM) == 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_change_with_their_unit),
        cmocka_unit_test(spot_heights_that_rounding_brings_together_must_agree),
        cmocka_unit_test(the_same_unit_touches_nothing),
        cmocka_unit_test(exact_conversions_are_known_to_be_exact),
        cmocka_unit_test(degrees_and_overflow_are_refused),
        cmocka_unit_test(a_length_is_rounded_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
