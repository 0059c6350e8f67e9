/* t-codepage.c - texts in the code pages that files name, and names that are counted. */
#include "config.h"
#include "base/alloc.h"
#include "base/dictionary.h"
#include "base/text.h"
#include "input/codepage.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void assert_text(il_codepage *page, const char *s, size_t n, const char *expected)
{
    char *out = NULL;
    size_t n_out = 0;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_codepage_text(page, s, n, &out, &n_out, &err), IL_OK);
    assert_int_equal(n_out, strlen(out));
    assert_string_equal(out, expected);
    il_free(out);
}

static void pages_are_known_by_their_many_names(void **state)
{
    static const struct { const char *name, *text, *expected; } pages[] = {
        { "ANSI_1252", "H\xF6he \x80", "H\xC3\xB6he \xE2\x82\xAC" }, { "1252", "\xF6", "\xC3\xB6" }, { "CP1252", "\xF6", "\xC3\xB6" },
        { "windows-1252", "\xF6", "\xC3\xB6" }, { "ANSI 1252", "\xF6", "\xC3\xB6" }, { "dos850", "\x94", "\xC3\xB6" },
        { "OEM 850", "\x94", "\xC3\xB6" }, { "IBM437", "\x94", "\xC3\xB6" }, { "ISO-8859-1", "\xF6", "\xC3\xB6" },
        { "ISO8859-15", "\xA4", "\xE2\x82\xAC" }, { "8859_5", "\xB0", "\xD0\x90" }, { "88591", "\xF6", "\xC3\xB6" },
        { "ANSI_1251", "\xC2", "\xD0\x92" }, { "UTF-8", "\xC3\xB6", "\xC3\xB6" }, { "utf8", "\xC3\xB6", "\xC3\xB6" },
        { "65001", "\xC3\xB6", "\xC3\xB6" }, { "ANSI_932", "\x8D\x82", "\xE9\xAB\x98" }, { "Shift_JIS", "\x8D\x82", "\xE9\xAB\x98" },
        { "gb2312", "\xB8\xDF", "\xE9\xAB\x98" }, { "Big5", "\xB0\xAA", "\xE9\xAB\x98" }, { "ANSI_949", "\xB0\xA1", "\xEA\xB0\x80" } };
    (void)state;
    for (size_t k = 0; k < sizeof pages / sizeof *pages; k++) {
        il_codepage page = IL_CODEPAGE_INIT;
        if (!il_codepage_set(&page, pages[k].name, strlen(pages[k].name)))
            fail_msg("%s is not known", pages[k].name);
        assert_text(&page, pages[k].text, strlen(pages[k].text), pages[k].expected);
        il_codepage_free(&page);
    }
}

static void other_names_never_reach_iconv(void **state)
{
    static const char *const names[] = { "", "EBCDIC", "UTF-16", "ISO-2022-CN-EXT", "1252//TRANSLIT//../../x", "../../../tmp/x",
        "ansi", "cp", "99999", "12520000000000000000000000000" };
    il_codepage page = IL_CODEPAGE_INIT;
    (void)state;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        assert_false(il_codepage_set(&page, names[k], strlen(names[k])));
    assert_int_equal(page.kind, IL_CODEPAGE_UNKNOWN);
    assert_text(&page, "H\xC3\xB6he", 5, "H\xC3\xB6he");
    assert_text(&page, "H\xF6he", 4, "H\xC3\xB6he");
}

static void language_drivers_of_dbase_are_pages(void **state)
{
    il_codepage page = IL_CODEPAGE_INIT;
    (void)state;
    assert_false(il_codepage_set_dbase(&page, 0));
    assert_false(il_codepage_set_dbase(&page, 0xFF));
    assert_true(il_codepage_set_dbase(&page, 0x02));
    assert_text(&page, "\x94", 1, "\xC3\xB6");
    assert_true(il_codepage_set_dbase(&page, 0x57));
    assert_text(&page, "\xF6", 1, "\xC3\xB6");
    il_codepage_free(&page);
}

static void what_is_no_character_is_shown_as_such(void **state)
{
    il_codepage page = IL_CODEPAGE_INIT;
    (void)state;
    assert_true(il_codepage_set(&page, "ANSI_932", 8));
    assert_text(&page, "a\x8D", 2, "a\xEF\xBF\xBD"); /* cut */
    assert_text(&page, "\xFF\xFF" "b", 3, "\xEF\xBF\xBD\xEF\xBF\xBD" "b");
    assert_text(&page, "", 0, "");
    assert_true(il_codepage_set(&page, "UTF-8", 5));
    assert_text(&page, "a\xF6" "b", 3, "a\xEF\xBF\xBD" "b");
    il_codepage_free(&page);
}

/* Growing characters, good and bad ones, at every length up to some blocks of memory. */
static void long_texts_are_whole(void **state)
{
    enum { MOST = 3000 };
    static char given[MOST], expected[3 * MOST + 1];
    il_codepage page = IL_CODEPAGE_INIT;
    size_t n = 0;
    (void)state;
    assert_true(il_codepage_set(&page, "ANSI_1252", 9));
    for (size_t k = 0; k < MOST; k++) {
        given[k] = k % 7 == 6 ? '\x81' : '\x80'; /* 81 is none */
        memcpy(expected + n, k % 7 == 6 ? "\xEF\xBF\xBD" : "\xE2\x82\xAC", 3);
        n += 3;
        expected[n] = '\0';
        if (k < 300 || k == MOST - 1)
            assert_text(&page, given, k + 1, expected);
    }
    il_codepage_free(&page);
}

/* ---- dictionaries ------------------------------------------------------------------- */

static void words_keep_their_numbers(void **state)
{
    il_dictionary d = IL_DICTIONARY_INIT;
    char word[40];
    uint32_t i;
    (void)state;
    for (uint32_t round = 0; round < 2; round++) {
        for (uint32_t k = 0; k < 20000; k++) {
            int n = snprintf(word, sizeof word, round == 0 ? "Layer %u" : "lAYER %u", (unsigned)k);
            assert_true(il_dictionary_put(&d, word, (size_t)n, &i));
            assert_int_equal(i, k);
        }
    }
    assert_string_equal(il_dictionary_text(&d, 7), "Layer 7");
    assert_true(il_dictionary_put(&d, "", 0, &i));
    assert_int_equal(i, 20000);
    assert_true(il_dictionary_put(&d, "a\0b", 3, &i));
    assert_int_equal(i, 20001);
    assert_true(il_dictionary_put(&d, "a\0c", 3, &i));
    assert_int_equal(i, 20002);
    assert_true(il_dictionary_put(&d, "a", 1, &i));
    assert_int_equal(i, 20003);
    il_dictionary_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pages_are_known_by_their_many_names),
        cmocka_unit_test(other_names_never_reach_iconv),
        cmocka_unit_test(language_drivers_of_dbase_are_pages),
        cmocka_unit_test(what_is_no_character_is_shown_as_such),
        cmocka_unit_test(long_texts_are_whole),
        cmocka_unit_test(words_keep_their_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
