#include "config.h"
#include "base/alloc.h"
#include "base/status.h"
#include "base/text.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- errors --------------------------------------------------------------- */

static const char *message(const il_error *err)
{
    static char text[1000];
    il_error_message(err, text, sizeof text);
    return text;
}

static void an_error_names_file_line_and_sentence(void **state)
{
    (void)state;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_fail(&err, IL_E_INPUT, 12, "'%s' is not a finite number", "1e999"), IL_E_INPUT);
    assert_string_equal(message(&err), "line 12: '1e999' is not a finite number");
    il_error_set_file(&err, "a.loft");
    il_error_set_file(&err, "b.loft");
    assert_string_equal(message(&err), "a.loft:12: '1e999' is not a finite number");
    strcpy(err.path, "$.x[3]");
    assert_string_equal(message(&err), "a.loft:12: $.x[3]: '1e999' is not a finite number");
    err.line = 0;
    assert_string_equal(message(&err), "a.loft: $.x[3]: '1e999' is not a finite number");
}

static void the_first_error_wins(void **state)
{
    (void)state;
    il_error err = IL_ERROR_INIT;
    il_error_set_file(&err, "too early");
    assert_string_equal(err.file, "");
    il_fail(&err, IL_E_INPUT, 1, "first");
    assert_int_equal(il_fail(&err, IL_E_IO, 2, "second"), IL_E_IO);
    assert_int_equal(il_fail_nomem(&err), IL_E_NOMEM);
    assert_int_equal(err.code, IL_E_INPUT);
    assert_int_equal(err.line, 1);
    assert_string_equal(err.text, "first");
    il_error_clear(&err);
    assert_int_equal(err.code, IL_OK);
    il_fail_nomem(&err);
    assert_string_equal(message(&err), "out of memory");
}

static void no_error_record_is_fine(void **state)
{
    (void)state;
    assert_int_equal(il_fail(NULL, IL_E_USAGE, 0, "x"), IL_E_USAGE);
    il_error_set_file(NULL, "x");
}

static void nothing_from_a_file_reaches_the_terminal(void **state)
{
    (void)state;
    il_error err = IL_ERROR_INIT;
    il_fail(&err, IL_E_INPUT, 1, "%s", "a\033[2Jb\nc%n\xff");
    il_error_set_file(&err, "evil\r\033]0;name");
    assert_string_equal(err.text, "a\\x1b[2Jb\\x0ac%n\\xff");
    assert_string_equal(err.file, "evil\\x0d\\x1b]0;name");
}

static void long_texts_are_cut_and_terminated(void **state)
{
    (void)state;
    char big[5000], small[8];
    memset(big, '\1', sizeof big - 1);
    big[sizeof big - 1] = '\0';
    il_error err = IL_ERROR_INIT;
    il_fail(&err, IL_E_INPUT, 1, "%s", big);
    il_error_set_file(&err, big);
    assert_true(strlen(err.text) < sizeof err.text && strlen(err.text) > sizeof err.text - 8);
    assert_true(strlen(err.file) < sizeof err.file);
    il_error_message(&err, small, sizeof small);
    assert_int_equal(strlen(small), 7);
}

/* ---- text ----------------------------------------------------------------- */

static void what_a_terminal_obeys_is_written_as_hex(void **state)
{
    (void)state;
    static const struct { const char *in, *out; } c[] = {
        { "plain ~", "plain ~" }, { "\x7f", "\\x7f" }, { "\t", "\\x09" },
        { "\xc2\x9b" "31m", "\\xc2\\x9b31m" },                     /* C1: CSI */
        { "\xe2\x80\xae" "x", "\\xe2\\x80\\xaex" },                /* right-to-left override */
        { "\xe2\x81\xa6", "\\xe2\\x81\\xa6" }, { "\xef\xbb\xbf", "\\xef\\xbb\\xbf" },
        { "h\xc3\xb6he \xe2\x82\xac \xf0\x9f\xab\x80", "h\xc3\xb6he \xe2\x82\xac \xf0\x9f\xab\x80" },
        { "\xc3", "\\xc3" }, { "\xc0\x80", "\\xc0\\x80" }, { "\xed\xa0\x80", "\\xed\\xa0\\x80" } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char to[64];
        size_t n = il_text_printable(to, sizeof to, c[i].in, strlen(c[i].in));
        assert_string_equal(to, c[i].out);
        assert_int_equal(n, strlen(to));
    }
}

static void printable_text_is_cut_between_characters(void **state)
{
    (void)state;
    static const char in[] = "a\xe2\x82\xac\1z"; /* 1 + 3 + 4 + 1 bytes when printable */
    static const size_t length[] = { 0, 0, 1, 1, 1, 4, 4, 4, 4, 8, 9 };
    for (size_t size = 0; size < sizeof length / sizeof *length; size++) {
        char to[16];
        memset(to, '#', sizeof to);
        assert_int_equal(il_text_printable(to, size, in, sizeof in - 1), length[size]);
        if (size > 0)
            assert_int_equal(to[length[size]], '\0');
        assert_int_equal(to[size], '#');
    }
}

static void utf8_is_judged_as_rfc_3629_says(void **state)
{
    (void)state;
    static const struct { const char *s; size_t n; unsigned long code; } good[] = {
        { "\0", 1, 0 }, { "\x7f", 1, 0x7F }, { "\xc2\x80", 2, 0x80 }, { "\xdf\xbf", 2, 0x7FF },
        { "\xe0\xa0\x80", 3, 0x800 },
        { "\xed\x9f\xbf", 3, 0xD7FF }, { "\xee\x80\x80", 3, 0xE000 }, { "\xef\xbf\xbf", 3, 0xFFFF },
        { "\xf0\x90\x80\x80", 4, 0x10000 }, { "\xf4\x8f\xbf\xbf", 4, 0x10FFFF } };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        unsigned long code = 99;
        assert_int_equal(il_utf8_char(good[i].s, good[i].n, &code), good[i].n);
        assert_int_equal(code, good[i].code);
        if (good[i].n > 1)
            assert_int_equal(il_utf8_char(good[i].s, good[i].n - 1, NULL), 0);
    }
    static const char *const bad[] = { "\x80", "\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xed\xbf\xbf",
                                       "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80",
                                       "\xff", "\xe2\x28\xa1" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(il_utf8_valid(bad[i], strlen(bad[i])));
    assert_true(il_utf8_valid("", 0));
    assert_true(il_utf8_valid("a\xc3\xa9", 3));
    assert_false(il_utf8_valid("a\xc3\xa9", 2));
}

/* ---- memory --------------------------------------------------------------- */

static void products_that_overflow_give_no_memory(void **state)
{
    (void)state;
    assert_null(il_alloc(SIZE_MAX / 2 + 1, 2));
    assert_null(il_calloc(SIZE_MAX, SIZE_MAX));
    assert_null(il_alloc(SIZE_MAX, 1)); /* above PTRDIFF_MAX */
    void *p = il_alloc(4, 1);
    assert_non_null(p);
    assert_null(il_realloc(p, SIZE_MAX / 8 + 2, 8));
    il_free(p);
    p = il_alloc(0, 8);
    assert_non_null(p);
    il_free(p);
    p = il_alloc(8, 0);
    assert_non_null(p);
    il_free(p);
    il_free(NULL);
}

static void cleared_memory_is_zero(void **state)
{
    (void)state;
    unsigned char zero[100] = { 0 }, *p = il_calloc(10, 10);
    assert_non_null(p);
    assert_memory_equal(p, zero, sizeof zero);
    il_free(p);
}

static void growth_keeps_what_is_there_and_is_linear(void **state)
{
    (void)state;
    int *a = NULL;
    size_t cap = 0, moves = 0;
    for (size_t n = 0; n < 100000; n++) {
        size_t before = cap;
        assert_true(il_grow(&a, &cap, n + 1, sizeof *a));
        moves += cap != before;
        a[n] = (int)n;
    }
    for (size_t n = 0; n < 100000; n++)
        assert_int_equal(a[n], n);
    assert_true(moves < 40);
    size_t before = cap;
    int *where = a;
    assert_false(il_grow(&a, &cap, SIZE_MAX / 2, sizeof *a));
    assert_false(il_grow(&a, &cap, SIZE_MAX, sizeof *a));
    assert_ptr_equal(a, where);
    assert_int_equal(cap, before);
    assert_int_equal(a[99999], 99999);
    il_free(a);
}

static void a_copied_string_ends(void **state)
{
    (void)state;
    char *s = il_strndup("abc", 2);
    assert_string_equal(s, "ab");
    il_free(s);
}

static void the_chosen_allocation_fails_and_all_after_it(void **state)
{
    (void)state;
    for (long k = 0; k < 5; k++) {
        void *p[5];
        il_alloc_test_fail_after(k);
        p[0] = il_alloc(1, 1);
        p[1] = il_calloc(1, 1);
        p[2] = il_realloc(NULL, 1, 1);
        p[3] = il_strndup("x", 1);
        p[4] = NULL;
        size_t cap = 0;
        bool grown = il_grow(&p[4], &cap, 1, 1);
        il_alloc_test_fail_after(-1);
        for (long i = 0; i < 5; i++) {
            assert_int_equal(p[i] != NULL, i < k);
            il_free(p[i]);
        }
        assert_false(grown);
    }
    void *p = il_alloc(1, 1);
    assert_non_null(p);
    il_free(p);
}

static void the_environment_chooses_too(void **state)
{
    (void)state;
    setenv("ISOLOFT_TEST_ALLOC", "1", 1);
    il_alloc_test_environment();
    unsetenv("ISOLOFT_TEST_ALLOC");
    void *first = il_alloc(1, 1), *second = il_alloc(1, 1);
    il_alloc_test_environment(); /* unset: leaves it as it is */
    void *third = il_alloc(1, 1);
    il_alloc_test_fail_after(-1);
    assert_non_null(first);
    assert_null(second);
    assert_null(third);
    il_free(first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_error_names_file_line_and_sentence),
        cmocka_unit_test(the_first_error_wins),
        cmocka_unit_test(no_error_record_is_fine),
        cmocka_unit_test(nothing_from_a_file_reaches_the_terminal),
        cmocka_unit_test(long_texts_are_cut_and_terminated),
        cmocka_unit_test(what_a_terminal_obeys_is_written_as_hex),
        cmocka_unit_test(printable_text_is_cut_between_characters),
        cmocka_unit_test(utf8_is_judged_as_rfc_3629_says),
        cmocka_unit_test(products_that_overflow_give_no_memory),
        cmocka_unit_test(cleared_memory_is_zero),
        cmocka_unit_test(growth_keeps_what_is_there_and_is_linear),
        cmocka_unit_test(a_copied_string_ends),
        cmocka_unit_test(the_chosen_allocation_fails_and_all_after_it),
        cmocka_unit_test(the_environment_chooses_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
