/* Text in DICOM's character sets.  Bytes are from the code tables of the sets:
 * ISO/IEC 8859, JIS X 0201, 0208 and 0212, KS X 1001, GB 2312, GB 18030. */
#include "config.h"
#include "base/alloc.h"
#include "input/charset.h"
#include "input/reader.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ESC "\x1B"
#define BAD "\xEF\xBF\xBD"

/* TEXT in the set DEFINED is EXPECTED, N_BAD bytes of it being none of the set's. */
static void assert_bytes(const char *defined, const char *text, size_t n, const char *expected, size_t n_bad)
{
    il_error err = IL_ERROR_INIT;
    char *out = NULL;
    size_t n_out = 0, bad = 0;
    bool known = false;
    assert_int_equal(il_charset_to_utf8(defined, strlen(defined), text, n, &out, &n_out, &bad, &known, &err), IL_OK);
    assert_true(known);
    assert_string_equal(out, expected);
    assert_int_equal(n_out, strlen(expected));
    assert_int_equal(bad, n_bad);
    il_free(out);
}

static void assert_text(const char *defined, const char *text, const char *expected)
{
    assert_bytes(defined, text, strlen(text), expected, 0);
}

static void assert_unknown(const char *defined, const char *text, const char *expected)
{
    il_error err = IL_ERROR_INIT;
    char *out = NULL;
    size_t n_out = 0;
    bool known = true;
    assert_int_equal(il_charset_to_utf8(defined, strlen(defined), text, strlen(text), &out, &n_out, NULL, &known, &err), IL_OK);
    assert_false(known);
    assert_string_equal(out, expected);
    il_free(out);
}

/* ---- one set a file ------------------------------------------------------------ */

static void ascii_is_the_set_of_files_that_name_none(void **state)
{
    (void)state;
    assert_text("", "Lung L^~\\", "Lung L^~\\");
    assert_text("ISO_IR 6", "", "");
    assert_bytes("", "D\xFCse", 4, "D" BAD "se", 1);
}

static void one_byte_sets_have_their_own_upper_half(void **state)
{
    (void)state;
    assert_text("ISO_IR 100", "Dr\xFCse", "Dr\u00FCse");
    assert_text("ISO_IR 101", "\xAF\xF3\xB3\xE6", "\u017B\u00F3\u0142\u0107");
    assert_text("ISO_IR 109", "\xB1\xF8", "\u0127\u011D");
    assert_text("ISO_IR 110", "\xA3\xE0", "\u0156\u0101");
    assert_text("ISO_IR 144", "\xBB\xF1\xD3\xDA\xD8\xD5", "\u041B\u0451\u0433\u043A\u0438\u0435");
    assert_text("ISO_IR 127", "\xE2\xE4\xC8", "\u0642\u0644\u0628");
    assert_text("ISO_IR 126", "\xEA\xE1\xF1\xE4\xE9\xDC", "\u03BA\u03B1\u03C1\u03B4\u03B9\u03AC");
    assert_text("ISO_IR 138", "\xF8\xE0\xE4", "\u05E8\u05D0\u05D4");
    assert_text("ISO_IR 148", "Akci\xF0" "er", "Akci\u011F" "er");
    assert_text("ISO_IR 203", "\xA4\xE9", "\u20AC\u00E9");
    assert_text("ISO_IR 166", "\xB5\xD1\xBA", "\u0E15\u0E31\u0E1A");
}

static void bytes_without_a_character_are_counted(void **state)
{
    (void)state;
    assert_bytes("ISO_IR 109", "a\xA5z", 3, "a" BAD "z", 1);
    assert_bytes("ISO_IR 166", "\xB5\xFF\xDC", 3, "\u0E15" BAD BAD, 2);
    assert_bytes("ISO_IR 100", "a\0b", 3, "a" BAD "b", 1);
    assert_bytes("ISO_IR 13", "\xB1\xA0\xE0", 3, "\uFF71" BAD BAD, 2);
}

static void japanese_one_byte_text_has_a_yen_and_an_overline(void **state)
{
    (void)state;
    assert_text("ISO_IR 13", "\xD4\xCF\xC0\xDE^\xC0\xDB\xB3", "\uFF94\uFF8F\uFF80\uFF9E^\uFF80\uFF9B\uFF73");
    assert_text("ISO_IR 13", "5\\ ~Lung", "5\u00A5 \u203ELung");
}

static void utf8_is_checked(void **state)
{
    (void)state;
    assert_text("ISO_IR 192", "Wang=\xE7\x8E\x8B \xF0\x9F\xAB\x81", "Wang=\xE7\x8E\x8B \xF0\x9F\xAB\x81");
    assert_bytes("ISO_IR 192", "a\xC0\xAF\xE7\x8E", 5, "a" BAD BAD BAD BAD, 4);
    assert_bytes("ISO_IR 192", "\xED\xA0\x80", 3, BAD BAD BAD, 3);
}

static void chinese_text_of_one_two_and_four_bytes_a_character(void **state)
{
    (void)state;
    assert_text("GB18030", "Wang^XiaoDong=\xCD\xF5^\xD0\xA1\xB6\xAB", "Wang^XiaoDong=\u738B^\u5C0F\u4E1C");
    assert_text("GBK", "\xCD\xF5\x96\x7C", "\u738B\u6771");
    assert_text("GB18030", "\x81\x30\x84\x36z", "\u00A5z");
    assert_bytes("GB18030", "\xCD\xF5\xFFz\xCD", 5, "\u738B" BAD "z" BAD, 2);
    assert_bytes("GBK", "\x81\x30", 2, BAD "0", 1);
}

/* ---- sets that follow one another ------------------------------------------------ */

static void kanji_stand_between_escape_sequences(void **state)
{
    (void)state;
    assert_text("\\ISO 2022 IR 87",
                "Yamada^Tarou=" ESC "$B;3ED" ESC "(B^" ESC "$BB@O:" ESC "(B=" ESC "$B$d$^$@" ESC "(B^" ESC "$B$?$m$&" ESC "(B",
                "Yamada^Tarou=\u5C71\u7530^\u592A\u90CE=\u3084\u307E\u3060^\u305F\u308D\u3046");
    assert_text("ISO 2022 IR 87", "\x1B$B;3ED\x1B(B", "\u5C71\u7530");
}

static void katakana_and_kanji_share_a_text(void **state)
{
    (void)state;
    assert_text("ISO 2022 IR 13\\ISO 2022 IR 87",
                "\xD4\xCF\xC0\xDE^\xC0\xDB\xB3=" ESC "$B;3ED" ESC "(J^" ESC "$BB@O:" ESC "(J=~",
                "\uFF94\uFF8F\uFF80\uFF9E^\uFF80\uFF9B\uFF73=\u5C71\u7530^\u592A\u90CE=\u203E");
}

static void the_supplementary_kanji_have_a_sequence_of_three_bytes(void **state)
{
    (void)state;
    assert_text("\\ISO 2022 IR 87\\ISO 2022 IR 159", ESC "$(D0!" ESC "$B0!" ESC "(Bz", "\u4E02\u4E9Cz");
}

static void hangul_stand_in_the_upper_half(void **state)
{
    (void)state;
    assert_text("\\ISO 2022 IR 149",
                "Hong^Gildong=" ESC "$)C\xFB\xF3^" ESC "$)C\xD1\xCE\xD4\xD7=" ESC "$)C\xC8\xAB^" ESC "$)C\xB1\xE6\xB5\xBF",
                "Hong^Gildong=\u6D2A^\u5409\u6D1E=\uD64D^\uAE38\uB3D9");
    assert_text("\\ISO 2022 IR 149", "\xB1\xE6 L", "\uAE38 L"); /* the sequence is forgotten often */
}

static void hanzi_stand_in_the_upper_half(void **state)
{
    (void)state;
    assert_text("\\ISO 2022 IR 58", "Wang^XiaoDong=" ESC "$)A\xCD\xF5^" ESC "$)A\xD0\xA1\xB6\xAB",
                "Wang^XiaoDong=\u738B^\u5C0F\u4E1C");
}

static void one_byte_sets_are_switched_too(void **state)
{
    (void)state;
    assert_text("ISO 2022 IR 100\\ISO 2022 IR 144\\ISO 2022 IR 126",
                "\xE4" ESC "-L\xE4" ESC "-F\xE4" ESC "-A\xE4", "\u00E4\u0444\u03B4\u00E4");
    assert_text("\\ISO 2022 IR 101\\ISO 2022 IR 109\\ISO 2022 IR 110\\ISO 2022 IR 127\\ISO 2022 IR 138\\ISO 2022 IR 148"
                "\\ISO 2022 IR 166\\ISO 2022 IR 203\\ISO 2022 IR 13",
                ESC "-B\xB3" ESC "-C\xB1" ESC "-D\xB3" ESC "-G\xC8" ESC "-H\xE0" ESC "-M\xF0" ESC "-T\xB5" ESC "-b\xA4" ESC ")I\xB1",
                "\u0142\u0127\u0157\u0628\u05D0\u011F\u0E15\u20AC\uFF71");
}

static void a_line_begins_with_the_first_set_again(void **state)
{
    (void)state;
    assert_text("ISO 2022 IR 100\\ISO 2022 IR 144", ESC "-L\xE4\r\n\xE4", "\u0444\r\n\u00E4");
    assert_text("\\ISO 2022 IR 87", ESC "$B;3\nED", "\u5C71\nED");
}

static void damaged_pairs_are_counted_and_nothing_else_is_lost(void **state)
{
    (void)state;
    assert_bytes("\\ISO 2022 IR 87", ESC "$B;3E", 6, "\u5C71" BAD, 1);
    assert_bytes("\\ISO 2022 IR 87", ESC "$B;" ESC "(Bz", 8, BAD "z", 1);
    assert_bytes("\\ISO 2022 IR 87", ESC "$B; 3E", 7, BAD " \u5687", 1);
    assert_bytes("\\ISO 2022 IR 87", ESC "$B/!" ESC "(Bz", 9, BAD "z", 1); /* row 15 is empty */
    assert_bytes("\\ISO 2022 IR 149", ESC "$)C\xB1" "A\xE6", 7, BAD "A" BAD, 2);
    assert_bytes("\\ISO 2022 IR 6", ESC ")B\x80\xA0\xC1\xFF", 7, BAD BAD "A" BAD, 3);
}

static void other_escapes_are_left_as_they_are(void **state)
{
    (void)state;
    assert_text("ISO_IR 100", ESC "[31mred" ESC, ESC "[31mred" ESC);
    assert_text("\\ISO 2022 IR 87", ESC "$" ESC "(" ESC "$(Z" ESC "-", ESC "$" ESC "(" ESC "$(Z" ESC "-");
    assert_text("ISO_IR 192", ESC "$B;3", ESC "$B;3");
}

/* ---- names ---------------------------------------------------------------------------- */

static void names_are_known_by_what_identifies_them(void **state)
{
    static const char *const latin1[] = { "ISO_IR 100", "ISO-IR 100", "ISO IR 100", "ISO_IR_100", "iso_ir 100 ", "ISO_IR100",
        "ISO 2022 IR 100", "ISO2022 IR 100", "ISO_2022_IR_100", "ISO-2022-IR-100", "ISO 8859-1", "ISO_8859-1", "ISO8859-1",
        "ISO_IR 100\\", "ISO_IR 6\\ISO_IR 100", "ISO_IR 100\\NONE" };
    (void)state;
    for (size_t i = 0; i < sizeof latin1 / sizeof *latin1; i++)
        assert_text(latin1[i], "\xE4", "\u00E4");
    assert_text("utf-8", "\xC3\xA4", "\u00E4");
    assert_text("\\ISO_IR 192", "\xC3\xA4", "\u00E4");
    assert_text("ISO 8859-15", "\xA4", "\u20AC");
    assert_text("ISO-8859-11", "\xB5", "\u0E15");
}

static void an_unknown_set_is_told_and_the_text_is_kept(void **state)
{
    static const char *const unknown[] = { "ISO_IR 1000", "ISO_IR", "ISO", "IR", "KOI8-R", "../../ISO_IR 100",
        "ISO_IR 100 and a great deal more than any name has", "NONE\\ISO_IR 100" };
    (void)state;
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        assert_unknown(unknown[i], "L\xC3\xA4", "L\u00E4");
        assert_unknown(unknown[i], "L\xE4", "L\u00E4");
    }
}

/* ---- structure sets --------------------------------------------------------------------- */

static il_status pass_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self, (void)head, (void)err;
    return IL_OK;
}

static il_status pass(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

/* Two empty ROIs called A and B in the set KOI8-R, and the notes about that. */
static size_t notes_of_names(const char *a, const char *b)
{
    il_sink sink = { .stack_begin = pass_stack, .stack_end = pass, .end = pass };
    const il_read_options o = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source = NULL;
    char text[1000];
    size_t notes = 0;
    int n = snprintf(text, sizeof text,
        "(0008,0005) CS [KOI8-R] # 6, 1 a\n(3006,0020) SQ (Sequence) # 0, 1 a\n"
        "(fffe,e000) na (Item) # 0, 1 a\n(3006,0022) IS [1] # 2, 1 a\n(3006,0026) LO [%s] # 2, 1 a\n(fffe,e00d) na (End) # 0, 1 a\n"
        "(fffe,e000) na (Item) # 0, 1 a\n(3006,0022) IS [2] # 2, 1 a\n(3006,0026) LO [%s] # 2, 1 a\n(fffe,e00d) na (End) # 0, 1 a\n"
        "(fffe,e0dd) na (End) # 0, 0 a\n(3006,0039) SQ (Sequence) # 0, 1 a\n(fffe,e0dd) na (End) # 0, 0 a\n", a, b);
    assert_int_equal(il_source_from_memory(&source, text, (size_t)n, "dump", &err), IL_OK);
    assert_int_equal(il_reader_dcmdump.read(&source, 1, &o, &sink, &report, &err), IL_OK);
    for (size_t i = 0; i < report.n_notes; i++)
        notes += strstr(report.note[i], "KOI8-R") != NULL;
    il_source_close(source);
    il_report_free(&report);
    return notes;
}

static void an_unknown_set_is_told_once_and_only_where_it_matters(void **state)
{
    (void)state;
    assert_int_equal(notes_of_names("A", "B"), 0);
    assert_int_equal(notes_of_names("A", "\xE4"), 1);
    assert_int_equal(notes_of_names("\xE4", "\xE5"), 1);
}

static void any_failing_allocation_is_told(void **state)
{
    il_status st = IL_E_NOMEM;
    (void)state;
    for (long k = 0; st != IL_OK && k < 20; k++) {
        il_error err = IL_ERROR_INIT;
        char *out = (char *)&err;
        size_t n_out = 1, n_bad = 1;
        bool known;
        static const char text[] = "a long name, so that its memory grows more than once: \xE4\xE5\xE6";
        il_alloc_test_fail_after(k);
        st = il_charset_to_utf8("ISO_IR 101", 10, text, sizeof text - 1, &out, &n_out, &n_bad, &known, &err);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK) {
            assert_true(k > 0);
            il_free(out);
        } else {
            assert_int_equal(st, IL_E_NOMEM);
            assert_null(out);
            assert_int_equal(n_out, 0);
        }
    }
    assert_int_equal(st, IL_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_is_the_set_of_files_that_name_none),
        cmocka_unit_test(one_byte_sets_have_their_own_upper_half),
        cmocka_unit_test(bytes_without_a_character_are_counted),
        cmocka_unit_test(japanese_one_byte_text_has_a_yen_and_an_overline),
        cmocka_unit_test(utf8_is_checked),
        cmocka_unit_test(chinese_text_of_one_two_and_four_bytes_a_character),
        cmocka_unit_test(kanji_stand_between_escape_sequences),
        cmocka_unit_test(katakana_and_kanji_share_a_text),
        cmocka_unit_test(the_supplementary_kanji_have_a_sequence_of_three_bytes),
        cmocka_unit_test(hangul_stand_in_the_upper_half),
        cmocka_unit_test(hanzi_stand_in_the_upper_half),
        cmocka_unit_test(one_byte_sets_are_switched_too),
        cmocka_unit_test(a_line_begins_with_the_first_set_again),
        cmocka_unit_test(damaged_pairs_are_counted_and_nothing_else_is_lost),
        cmocka_unit_test(other_escapes_are_left_as_they_are),
        cmocka_unit_test(names_are_known_by_what_identifies_them),
        cmocka_unit_test(an_unknown_set_is_told_and_the_text_is_kept),
        cmocka_unit_test(an_unknown_set_is_told_once_and_only_where_it_matters),
        cmocka_unit_test(any_failing_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
