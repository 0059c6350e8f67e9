/* t-patch.c - areas, what two patches have in common, and where regions went. */
#include "config.h"
#include "contours.h"
#include "match/shift.h"

static il_patch patch_of(const char *s)
{
    il_slice slice = slice_of(s);
    il_patch p = IL_PATCH_INIT;
    for (size_t i = 0; i < slice.n; i++)
        assert_true(il_patch_add(&p, &slice.ring[i], false));
    assert_int_equal(il_patch_plant(&p, NULL), IL_OK);
    il_slice_free(&slice);
    return p;
}

static double common_of(const il_patch *a, const il_patch *b)
{
    il_scan scan = IL_SCAN_INIT;
    double area;
    assert_int_equal(il_patch_common(a, b, &scan, &area, NULL), IL_OK);
    il_scan_free(&scan);
    return area;
}

static void assert_near(double a, double b, double within)
{
    if (!(fabs(a - b) <= within))
        fail_msg("%.9g, not %.9g", a, b);
}

#define SQUARE "0 0, 8 0, 8 8, 0 8"
#define FRAMED SQUARE "; 2 2, 2 6, 6 6, 6 2"

static void areas_and_centres_are_those_of_the_region(void **state)
{
    (void)state;
    il_patch framed = patch_of(FRAMED), lopsided = patch_of(SQUARE "; 4 2, 4 6, 8 6, 8 2");
    assert_near(framed.area, 48, 0);
    assert_near(framed.centre[0], 4, 1e-14);
    assert_near(lopsided.area, 48, 0);
    assert_near(lopsided.centre[0], (64 * 4 - 16 * 6) / 48., 1e-14);
    assert_near(lopsided.centre[1], 4, 1e-14);
    il_patch_free(&framed);
    il_patch_free(&lopsided);
}

static void common_areas_are_found_whatever_edges_do(void **state)
{
    (void)state;
    static const struct { const char *a, *b; double area, within; } c[] = {
        { SQUARE, SQUARE, 64, 0 },
        { FRAMED, FRAMED, 48, 0 },
        { SQUARE, FRAMED, 48, 0 },
        { SQUARE, "8 0, 9 0, 9 8, 8 8", 0, 0 },                      /* touch */
        { SQUARE, "8 8, 9 8, 9 9", 0, 0 },
        { FRAMED, "2 2, 6 2, 6 6, 2 6", 0, 0 },                       /* in the hole */
        { FRAMED, "3 3, 5 3, 5 5, 3 5", 0, 0 },
        { FRAMED, "1 3, 7 3, 7 5, 1 5", 4, 0 },                       /* across it */
        { SQUARE, "-4 -4, 4 -4, 4 4, -4 4", 16, 0 },
        { SQUARE, "4 -4, 12 4, 4 12, -4 4", 64, 0.5 },                /* each corner lies on an edge */
        { SQUARE, "4 0, 8 4, 4 8, 0 4", 32, 0.01 },
        { SQUARE, "-1 0, 9 0, 4 3", 15 - 0.6, 0.05 },                 /* but for two corners */
        { SQUARE, "20 0, 21 0, 21 8, 20 8", 0, 0 },
    };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_patch a = patch_of(c[k].a), b = patch_of(c[k].b);
        assert_near(common_of(&a, &b), c[k].area, c[k].within);
        assert_near(common_of(&b, &a), c[k].area, c[k].within);
        il_patch_free(&a);
        il_patch_free(&b);
    }
}

static void boxes_share_what_they_share(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int round = 0; round < 500; round++) {
        double at[8], least[2], most[2];
        char text[2][200];
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 4; i++)
                at[4 * k + i] = 1000 * stack_uniform(&seed) + (i >= 2 ? 1 + at[4 * k + i - 2] : 0);
            const double *b = at + 4 * k;
            snprintf(text[k], 200, "%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g", b[0], b[1], b[2], b[1], b[2], b[3], b[0], b[3]);
        }
        for (int i = 0; i < 2; i++)
            least[i] = fmax(at[i], at[4 + i]), most[i] = fmin(at[2 + i], at[6 + i]);
        il_patch a = patch_of(text[0]), b = patch_of(text[1]);
        double wanted = fmax(most[0] - least[0], 0) * fmax(most[1] - least[1], 0);
        assert_near(common_of(&a, &b), wanted, 1e-9 * wanted);
        il_patch_free(&a);
        il_patch_free(&b);
    }
}

static void the_nearest_place_is_the_point_itself_inside(void **state)
{
    (void)state;
    static const struct { double at[2], nearest[2]; } c[] = {
        { { 1, 1 }, { 1, 1 } }, { { 4, 4.5 }, { 4, 6 } }, { { 9, 4 }, { 8, 4 } }, { { 11, 12 }, { 8, 8 } }, { { -1, 1 }, { 0, 1 } },
    };
    il_patch p = patch_of(FRAMED);
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        double nearest[2];
        il_patch_nearest(&p, c[k].at, nearest);
        assert_true(nearest[0] == c[k].nearest[0] && nearest[1] == c[k].nearest[1]);
    }
    il_patch_free(&p);
}

static void regions_go_where_their_links_take_them(void **state)
{
    (void)state;
    static const struct { const char *lower, *upper; double x, y; } c[] = {
        { SQUARE, "4 0, 12 0, 12 8, 4 8", 0, 0 },                     /* half of it */
        { SQUARE, "6 0, 14 0, 14 8, 6 8", 6, 0 },                     /* a quarter */
        { SQUARE, "10 1, 16 1, 16 7, 10 7", 9, 0 },                   /* 64 and 36 */
        { SQUARE, "10 3, 12 3, 12 5, 10 5", 3, 0 },                   /* a branch: from the edge */
        { SQUARE, "3 3, 5 3, 5 5, 3 5", 0, 0 },
        { FRAMED, "3 3, 5 3, 5 4, 3 4", 0, 1.5 },                     /* from the hole's edge */
    };
    il_scan scan = IL_SCAN_INIT;
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_patch a = patch_of(c[k].lower), b = patch_of(c[k].upper);
        double there[2], back[2];
        assert_int_equal(il_link_shift(&a, &b, &scan, there, NULL), IL_OK);
        assert_int_equal(il_link_shift(&b, &a, &scan, back, NULL), IL_OK);
        assert_near(there[0], c[k].x, 1e-12);
        assert_near(there[1], c[k].y, 1e-12);
        assert_true(there[0] == -back[0] && there[1] == -back[1]);
        il_patch_free(&a);
        il_patch_free(&b);
    }
    il_scan_free(&scan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_and_centres_are_those_of_the_region),
        cmocka_unit_test(common_areas_are_found_whatever_edges_do),
        cmocka_unit_test(boxes_share_what_they_share),
        cmocka_unit_test(the_nearest_place_is_the_point_itself_inside),
        cmocka_unit_test(regions_go_where_their_links_take_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
