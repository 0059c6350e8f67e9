#include "config.h"
#include "base/number.h"
#include "test.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static uint64_t next_random(uint64_t *s) /* splitmix64 (Steele, Lea & Flood 2014) */
{
    uint64_t z = (*s += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static void every_double_survives_bit_for_bit(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 200000;) {
        uint64_t bits = next_random(&seed);
        double d, back = 0;
        memcpy(&d, &bits, sizeof d);
        if (!isfinite(d))
            continue;
        char text[IL_NUMBER_MAX];
        size_t n = il_number_format(text, d);
        assert_int_equal(strlen(text), n);
        assert_int_equal(il_number_parse(text, n, &back), n);
        assert_memory_equal(&back, &d, sizeof d);
        i++;
    }
}

static void the_form_is_the_shortest(void **state)
{
    (void)state;
    static const struct { double d; const char *s; } c[] = {
        { 0, "0" }, { -0.0, "0" }, { 0.1, "0.1" }, { -2.5, "-2.5" }, { 1e21, "1e+21" }, { 100, "100" },
        { 1.0 / 3, "0.3333333333333333" }, { 5e-324, "5e-324" },
        { 1.7976931348623157e308, "1.7976931348623157e+308" } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[IL_NUMBER_MAX];
        il_number_format(text, c[i].d);
        assert_string_equal(text, c[i].s);
    }
}

static void numbers_as_files_write_them_are_read(void **state)
{
    (void)state;
    static const struct { const char *s; double d; size_t used; } c[] = {
        { "5.", 5, 2 }, { "+1.5", 1.5, 4 }, { ".5", .5, 2 }, { "007", 7, 3 }, { "1E+03", 1000, 5 },
        { "-.5e1x", -5, 5 }, { "1e-400", 0, 6 }, { "0.000001e-320", 0, 13 }, { "12 3", 12, 2 }, { "1e", 1, 1 } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        double d = 99;
        assert_int_equal(il_number_parse(c[i].s, strlen(c[i].s), &d), c[i].used);
        assert_true(d == c[i].d);
    }
}

static void what_is_no_finite_number_is_refused(void **state)
{
    (void)state;
    static const char *const c[] = { "", "-", "+", ".", "e5", "inf", "-inf", "nan", "NaN", "1e400", "-1e999999999999",
                                     "+-1", "- 1", " 1", "--1", "0x", "-.", "1000000000e300" };
    for (size_t i = 0; i < sizeof c / sizeof *c - 3; i++) {
        double d = 99;
        assert_int_equal(il_number_parse(c[i], strlen(c[i]), &d), 0);
        assert_true(d == 99);
    }
    double d = 99;
    assert_int_equal(il_number_parse("0x10", 4, &d), 1); /* the 0; the reader refuses what follows */
    assert_int_equal(il_number_parse("1000000000e300", 14, &d), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_double_survives_bit_for_bit),
        cmocka_unit_test(the_form_is_the_shortest),
        cmocka_unit_test(numbers_as_files_write_them_are_read),
        cmocka_unit_test(what_is_no_finite_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
