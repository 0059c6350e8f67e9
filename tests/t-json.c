/* t-json.c - the JSON scanner, and how DICOM JSON is told from other JSON. */
#include "config.h"
#include "base/alloc.h"
#include "input/json-scan.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- events as text --------------------------------------------------------- */

enum { TEXT_MAX = 2000 };

/* k: key, s: string, n: number, with [ ] around the bytes; t f 0: true, false and null. */
static void append_event(char *to, const il_json_scan *j, il_json_event event)
{
    static const char marks[] = ".{}[]ksntf0";
    size_t n = strlen(to);
    bool has_text = event == IL_JSON_KEY || event == IL_JSON_STRING || event == IL_JSON_NUMBER;
    assert_true(n + j->n + 10 < TEXT_MAX);
    if (has_text)
        snprintf(to + n, TEXT_MAX - n, "%c<%.*s>", marks[event], (int)j->n, j->text);
    else
        snprintf(to + n, TEXT_MAX - n, "%c", marks[event]);
}

/* What is scanned, with the line of an error and its words at the end. */
static void scan(const char *text, size_t n, const il_read_options *options, const char *between, char to[TEXT_MAX])
{
    il_json_scan j;
    il_json_event event = IL_JSON_NULL;
    il_source *source;
    il_error err = IL_ERROR_INIT;
    il_status st;
    to[0] = '\0';
    assert_int_equal(il_source_from_memory(&source, text, n, "m", &err), IL_OK);
    il_json_scan_init(&j, source, options);
    j.between = between;
    while ((st = il_json_scan_next(&j, &event, &err)) == IL_OK && event != IL_JSON_END)
        append_event(to, &j, event);
    if (st == IL_OK)
        append_event(to, &j, event);
    else
        snprintf(to + strlen(to), TEXT_MAX - strlen(to), "%ld: %s", err.line, err.text);
    assert_true(st == IL_OK || (st == IL_E_INPUT && strcmp(err.file, "m") == 0));
    il_json_scan_free(&j);
    il_source_close(source);
}

static void assert_scan_with(const char *text, const il_read_options *options, const char *expected)
{
    char got[TEXT_MAX];
    scan(text, strlen(text), options, "", got);
    if (strcmp(got, expected) != 0)
        fail_msg("%s\nexpected: %s\ngot:      %s", text, expected, got);
}

static void assert_scan(const char *text, const char *expected)
{
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    assert_scan_with(text, &defaults, expected);
}

typedef struct scanned {
    const char *text, *events;
} scanned;

static void assert_all(const scanned *c, size_t n)
{
    for (size_t i = 0; i < n; i++)
        assert_scan(c[i].text, c[i].events);
}
#define ASSERT_ALL(c) assert_all(c, sizeof c / sizeof *c)

/* ---- values ------------------------------------------------------------------ */

static void values_become_events(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "", "." }, { " \t\r\n", "." }, { "null", "0." }, { "[]", "[]." }, { "{}", "{}." }, { "\"\"", "s<>." },
        { "[true,false , null]", "[tf0]." }, { "{\"a\":{\"b\" : [1 ,2]},\"\":\"c\"}", "{k<a>{k<b>[n<1>n<2>]}k<>s<c>}." },
        { "[[],{},[[1],2]]", "[[]{}[[n<1>]n<2>]]." }, { "\xef\xbb\xbf[1]", "[n<1>]." }, { "12", "n<12>." } };
    ASSERT_ALL(c);
}

static void numbers_are_taken_as_files_have_them(void **state)
{
    (void)state;
    static const char *const good[] = { "0", "-0", "12", "-12.5", "1e5", "1E+03", "2.5e-7", "5.", ".5", "-.5", "+1.5", "007",
                                        "1.e2", "1e999", "NaN", "Infinity", "-Infinity" };
    static const char *const bad[] = { "-", "+", ".", "e5", "1e", "1e+", "1.2.3", "--1", "0x10", "1_0", "1-2", "nan", "+Infinity",
                                       "1f", "1\xc2\xa0" };
    char text[100], expected[200];
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        snprintf(text, sizeof text, "[%s,1,%s, %s]%s", good[i], good[i], good[i], good[i]);
        snprintf(expected, sizeof expected, "[n<%s>n<1>n<%s>n<%s>]n<%s>.", good[i], good[i], good[i], good[i]);
        assert_scan(text, expected);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char got[TEXT_MAX];
        const il_read_options defaults = IL_READ_OPTIONS_INIT;
        for (size_t place = 0; place < 2; place++) {
            int n = snprintf(text, sizeof text, place ? "[1,%s,1]" : "[%s]", bad[i]);
            scan(text, (size_t)n, &defaults, "", got);
            if (!strstr(got, "1: '") || !strstr(got, "' is no value in JSON"))
                fail_msg("%s: %s", text, got);
        }
    }
}

static void numbers_have_a_value_when_a_double_has_it(void **state)
{
    (void)state;
    static const struct { const char *text; bool has; double value; } c[] = {
        { "-0.25", true, -0.25 }, { "+1.5", true, 1.5 }, { "007", true, 7 }, { "5.", true, 5 }, { ".5", true, .5 },
        { "1E+03", true, 1000 }, { "1e-999", true, 0 }, { "1e999", false, 0 }, { "NaN", false, 0 }, { "-Infinity", false, 0 } };
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_json_scan j;
        il_json_event event;
        il_source *source;
        double value = 0;
        assert_int_equal(il_source_from_memory(&source, c[i].text, strlen(c[i].text), "m", NULL), IL_OK);
        il_json_scan_init(&j, source, &defaults);
        assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
        assert_int_equal(event, IL_JSON_NUMBER);
        assert_int_equal(il_json_scan_value(&j, &value), c[i].has);
        assert_true(!c[i].has || value == c[i].value);
        il_json_scan_free(&j);
        il_source_close(source);
    }
}

static void strings_lose_their_escapes(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "\"a\\\"b\\\\c\\/d\"", "s<a\"b\\c/d>." }, { "\"\\b\\f\\n\\r\\t\"", "s<\b\f\n\r\t>." },
        { "\"\\u0041\\u00e4\\u00E4\\u20ac\"", "s<A\xc3\xa4\xc3\xa4\xe2\x82\xac>." },
        { "\"\\ud83d\\ude00\\uDBFF\\uDFFF\\ud800\\udc00\"", "s<\xf0\x9f\x98\x80\xf4\x8f\xbf\xbf\xf0\x90\x80\x80>." },
        { "{\"\\u006b\":1}", "{k<k>n<1>}." }, { "\"\\\\u0041\"", "s<\\u0041>." }, { "\"a\tb\"", "s<a\tb>." } };
    ASSERT_ALL(c);
}

static void half_a_surrogate_pair_is_the_replacement_character(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "\"\\ud83d\"", "s<\xef\xbf\xbd>." }, { "\"\\ude00x\"", "s<\xef\xbf\xbdx>." },
        { "\"\\ud83d\\ud83d\\ude00\"", "s<\xef\xbf\xbd\xf0\x9f\x98\x80>." }, { "\"\\ud83d\\n\"", "s<\xef\xbf\xbd\n>." },
        { "\"\\ud83d\\u0041\"", "s<\xef\xbf\xbd" "A>." }, { "\"\\ude00\\ud83d\"", "s<\xef\xbf\xbd\xef\xbf\xbd>." } };
    ASSERT_ALL(c);
}

static void zero_bytes_and_bytes_that_are_no_utf_8_pass(void **state)
{
    (void)state;
    static const char text[] = "\"a\\u0000b\xff\xc3\"";
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "m", NULL), IL_OK);
    il_json_scan_init(&j, source, &defaults);
    assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
    assert_int_equal(event, IL_JSON_STRING);
    assert_int_equal(j.n, 5);
    assert_memory_equal(j.text, "a\0b\xff\xc3", 5);
    il_json_scan_free(&j);
    il_source_close(source);
}

/* ---- several values ------------------------------------------------------------- */

static void several_values_follow_one_another(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "{}{}", "{}{}." }, { "{\"a\":1}\n{\"a\":2}\n", "{k<a>n<1>}{k<a>n<2>}." }, { "1 2\n[3]\"4\"5", "n<1>n<2>[n<3>]s<4>n<5>." },
        { "1,2", "n<1>1: a value is expected, not ',2'" } };
    ASSERT_ALL(c);
}

static void separators_pass_between_values_when_asked_for(void **state)
{
    (void)state;
    static const char sequence[] = "\x1e{\"a\":[1]}\n\x1e[]\n\x1e\x1e", script[] = "{};\n";
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    char got[TEXT_MAX];
    scan(sequence, sizeof sequence - 1, &defaults, "\x1e", got);
    assert_string_equal(got, "{k<a>[n<1>]}[].");
    scan(script, sizeof script - 1, &defaults, ";", got);
    assert_string_equal(got, "{}.");
    assert_scan(sequence, "1: a value is expected, not '\\x1e{\"a\":[1]}'");
    scan("[1\x1e]", 4, &defaults, "\x1e", got);
    assert_string_equal(got, "[n<1>1: ',' or ']' is expected, not '\\x1e]'");
}

static void the_end_is_given_again(void **state)
{
    (void)state;
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, "1\n\n", 3, "m", NULL), IL_OK);
    il_json_scan_init(&j, source, &defaults);
    assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
        assert_int_equal(event, IL_JSON_END);
        assert_int_equal(j.line, 2);
    }
    il_json_scan_free(&j);
    il_source_close(source);
}

/* ---- what is refused --------------------------------------------------------------- */

static void what_is_no_json_is_refused_with_its_line(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "[1,]", "[n<1>1: a value is expected, not ']'" }, { "[,1]", "[1: a value or ']' is expected, not ',1]'" },
        { "{\"a\":1,}", "{k<a>n<1>1: a key in quotes is expected, not '}'" },
        { "{,}", "{1: a key in quotes or '}' is expected, not ',}'" }, { "{1:2}", "{1: a key in quotes or '}' is expected, not '1:2}'" },
        { "{\"a\" 1}", "{k<a>1: ':' is expected, not '1}'" }, { "{\"a\":}", "{k<a>1: a value is expected, not '}'" },
        { "[1 2]", "[n<1>1: ',' or ']' is expected, not '2]'" }, { "{\"a\":1 \"b\"}", "{k<a>n<1>1: ',' or '}' is expected, not '\"b\"}'" },
        { "[1}", "[n<1>1: ',' or ']' is expected, not '}'" }, { "]", "1: a value is expected, not ']'" },
        { "[\n\n tru]", "[3: 'tru' is no value in JSON" }, { "[\"a\nb\"]", "[1: the line ends inside a string" },
        { "\"\\x\"", "1: '\\x' is no escape in JSON" }, { "\"\\u12\"", "1: '\\u12' is no escape in JSON" },
        { "\"\x01\"", "1: a control character inside a string" }, { "'a'", "1: ''a'' is no value in JSON" },
        { "\xff\xfe[\x01", "1: the text is UTF-16 or UTF-32; JSON is UTF-8" }, { "// a", "1: '//' is no value in JSON" } };
    ASSERT_ALL(c);
}

static void what_is_cut_is_refused_with_what_it_was_cut_in(void **state)
{
    (void)state;
    static const scanned c[] = {
        { "[\n1", "[n<1>2: the file ends inside the array that begins in line 1: it was cut" },
        { "\n[\n1\n", "[n<1>3: the file ends inside the array that begins in line 2: it was cut" },
        { "[\n{\"a\":\n", "[{k<a>2: the file ends inside the object that begins in line 2: it was cut" },
        { "\"abc", "1: the file ends inside a string: it was cut" }, { "\"abc\\", "1: the file ends inside a string: it was cut" },
        { "\"abc\\\"", "1: the file ends inside a string: it was cut" }, { "\"abc\\u00", "1: the file ends inside a string: it was cut" },
        { "[tru", "[1: 'tru' is no value in JSON" } };
    ASSERT_ALL(c);
}

static void a_token_and_the_depth_are_limited(void **state)
{
    (void)state;
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.max_line = 5;
    assert_scan_with("[12345,12345,\"abc\"]", &o, "[n<12345>n<12345>s<abc>].");
    assert_scan_with("[123456]", &o, "[1: a string or number of more than 5 bytes");
    assert_scan_with("[1,\n123456]", &o, "[n<1>2: a string or number of more than 5 bytes");
    assert_scan_with("\"abcd\"", &o, "1: a string or number of more than 5 bytes");
    assert_scan_with("\"\\u0041\"", &o, "1: a string or number of more than 5 bytes");
    o.max_depth = 3;
    assert_scan_with("[[[1]]]", &o, "[[[n<1>]]].");
    assert_scan_with("[[\n{\"a\":[", &o, "[[{k<a>2: objects and arrays nested more than 3 deep");
}

/* ---- lines and blocks --------------------------------------------------------------- */

static void events_tell_their_line(void **state)
{
    (void)state;
    static const char text[] = "{\n\"a\": [1,\r\n2,\n\n3],\n\"b\"\n:\n\"c\" }";
    static const long line[] = { 1, 2, 2, 2, 3, 5, 5, 6, 8, 8 };
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "m", NULL), IL_OK);
    il_json_scan_init(&j, source, &defaults);
    for (size_t i = 0; i < sizeof line / sizeof *line; i++) {
        assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
        assert_int_equal(j.line, line[i]);
    }
    il_json_scan_free(&j);
    il_source_close(source);
}

/* The scanner reads blocks of 65 535 bytes: each byte of a text that has all sorts
 * of tokens is the last of one. */
static void the_end_of_a_block_may_be_anywhere(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "{\"key\\u00e4\\ud83d\\ude00\\\"\" : [ -12.5e+3,12.25,NaN,true,\"\\\\\" ],\r\n\"b\":[1,2,3 ,4\n,5],\"c\":null} [ ]",
        "[1,2,\n3\n\"x\"]", "[\"abc\\q\"]", "[1.5,1.5.5]", "[1,2,\"\\ud83d", "[12,34\n\n" };
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    enum { BLOCK = 65536 };
    char *padded = malloc(BLOCK + 200), got[TEXT_MAX], expected[TEXT_MAX];
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        size_t n = strlen(texts[t]);
        scan(texts[t], n, &defaults, "", expected);
        for (size_t pad = BLOCK - n - 4; pad < BLOCK + 4; pad++) {
            memset(padded, ' ', pad);
            memcpy(padded + pad, texts[t], n);
            scan(padded, pad + n, &defaults, "", got);
            assert_string_equal(got, expected);
        }
    }
    free(padded);
}

static void skipping_leaves_nothing_of_a_value(void **state)
{
    (void)state;
    static const char text[] = "{\"a\":[1,{\"b\":[]},\"]\"],\"c\":2,\"d\":{\"e\":{}}} [[[3]]] 4 5";
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event;
    il_source *source;
    char got[TEXT_MAX] = "";
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "m", NULL), IL_OK);
    il_json_scan_init(&j, source, &defaults);
    do {
        assert_int_equal(il_json_scan_next(&j, &event, NULL), IL_OK);
        append_event(got, &j, event);
        if (event == IL_JSON_KEY || event == IL_JSON_ARRAY || event == IL_JSON_NUMBER)
            assert_int_equal(il_json_scan_skip(&j, event, NULL), IL_OK);
    } while (event != IL_JSON_END);
    assert_string_equal(got, "{k<a>k<c>k<d>}[n<4>n<5>.");
    il_json_scan_free(&j);
    il_source_close(source);
}

/* ---- memory ---------------------------------------------------------------------------- */

static size_t count_events(const char *text, size_t n, long allocations, il_status *st)
{
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event;
    il_source *source;
    il_error err = IL_ERROR_INIT;
    size_t many = 0;
    assert_int_equal(il_source_from_memory(&source, text, n, "m", NULL), IL_OK);
    il_json_scan_init(&j, source, &defaults);
    il_alloc_test_fail_after(allocations);
    while ((*st = il_json_scan_next(&j, &event, &err)) == IL_OK && event != IL_JSON_END)
        many++;
    il_alloc_test_fail_after(-1);
    assert_int_equal(*st, err.code);
    il_json_scan_free(&j);
    il_source_close(source);
    return many;
}

/* A block and the levels. */
static void memory_does_not_grow_with_the_text(void **state)
{
    (void)state;
    enum { MANY = 200000 };
    char *text = malloc(6 * MANY + 10);
    size_t n = 0;
    text[n++] = '[';
    for (size_t i = 0; i < MANY; i++)
        n += (size_t)snprintf(text + n, 10, "%s%zu", i ? "," : "", i % 10000);
    text[n++] = ']';
    il_status st;
    assert_int_equal(count_events(text, n, 2, &st), MANY + 2);
    assert_int_equal(st, IL_OK);
    free(text);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    enum { LONG = 300000, DEEP = 200 };
    char *text = malloc(LONG + 2 * DEEP + 2);
    memset(text, '[', DEEP);
    memset(text + DEEP, 'x', LONG + 2);
    text[DEEP] = text[DEEP + LONG + 1] = '"';
    memset(text + DEEP + LONG + 2, ']', DEEP);
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st == IL_E_NOMEM && k < 100; k++)
        count_events(text, LONG + 2 * DEEP + 2, k, &st);
    assert_int_equal(st, IL_OK);
    assert_true(k > 5);
    free(text);
}

/* ---- DICOM JSON --------------------------------------------------------------------------- */

static const char *format_of(const char *text)
{
    const il_reader *reader = NULL;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, strlen(text), "m", NULL), IL_OK);
    il_status st = il_reader_detect(source, &reader, NULL);
    il_source_close(source);
    return st == IL_OK ? reader->name : "";
}

static void dicom_json_is_told_from_other_json(void **state)
{
    (void)state;
    static const char *const yes[] = {
        "{\"00080005\":{\"vr\":\"CS\"}}", " [ {\n \"3006002a\" : { ", "\xef\xbb\xbf{\"ABCDEF01\":{", "[\r\n\t{\"00080005\":{}" };
    static const char *const no[] = {
        "{}", "[]", "[1]", "{\"type\":\"FeatureCollection\"}", "{\"0008000\":{}}", "{\"000800055\":{}}", "{\"0008000g\":{}}",
        "{\"00080005\":[]}", "{\"00080005\",{}}",
        "[[{\"00080005\":{}}]]", "{\"00080005", "{\"00080005\"", "{\"00080005\":", "{00080005:{}}" };
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        assert_string_equal(format_of(yes[i]), "dicom-json");
    for (size_t i = 0; i < sizeof no / sizeof *no; i++)
        assert_string_not_equal(format_of(no[i]), "dicom-json");
}

static il_status drop_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self, (void)head, (void)err;
    return IL_OK;
}

static il_status drop_slice(il_sink *self, il_slice *slice, il_error *err)
{
    (void)self, (void)slice, (void)err;
    return IL_OK;
}

static il_status drop_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self, (void)pair, (void)err;
    return IL_OK;
}

static il_status drop_end(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

static il_status read_dicom(const char *text, const il_read_options *options, il_error *err)
{
    il_sink sink = { drop_stack, drop_slice, drop_pair, drop_end, drop_end };
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, strlen(text), "m", NULL), IL_OK);
    il_status st = il_reader_dicom_json.read(&source, 1, options, &sink, NULL, err);
    il_source_close(source);
    return st;
}

static const char set[] =
    "{ \"30060020\": { \"vr\": \"SQ\", \"Value\": [ { \"30060022\": { \"Value\": [1] } } ] },\n"
    "\"30060039\": { \"vr\": \"SQ\", \"Value\": [ { \"30060084\": { \"Value\": [1] }, \"30060040\": { \"Value\": [\n"
    "{ \"30060050\": { \"Value\": [0, 0, 0, 10, 0, 0, 10, 8, 0] } } ] } } ] } }";

static void a_value_is_limited_with_all_its_numbers(void **state)
{
    (void)state;
    il_read_options o = IL_READ_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    o.max_line = strlen("0\\0\\0\\10\\0\\0\\10\\8\\0");
    assert_int_equal(read_dicom(set, &o, &err), IL_OK);
    o.max_line--;
    assert_int_equal(read_dicom(set, &o, &err), IL_E_INPUT);
    assert_int_equal(err.line, 3);
    assert_string_equal(err.text, "a value of more than 18 bytes");
}

static void every_allocation_of_the_reader_may_fail(void **state)
{
    (void)state;
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st == IL_E_NOMEM && k < 1000; k++) {
        il_sink sink = { drop_stack, drop_slice, drop_pair, drop_end, drop_end };
        il_error err = IL_ERROR_INIT;
        il_source *source;
        assert_int_equal(il_source_from_memory(&source, set, sizeof set - 1, "m", NULL), IL_OK);
        il_alloc_test_fail_after(k);
        st = il_reader_dicom_json.read(&source, 1, &defaults, &sink, NULL, &err);
        il_alloc_test_fail_after(-1);
        assert_int_equal(st, err.code);
        il_source_close(source);
    }
    assert_int_equal(st, IL_OK);
    assert_true(k > 10);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_become_events),
        cmocka_unit_test(numbers_are_taken_as_files_have_them),
        cmocka_unit_test(numbers_have_a_value_when_a_double_has_it),
        cmocka_unit_test(strings_lose_their_escapes),
        cmocka_unit_test(half_a_surrogate_pair_is_the_replacement_character),
        cmocka_unit_test(zero_bytes_and_bytes_that_are_no_utf_8_pass),
        cmocka_unit_test(several_values_follow_one_another),
        cmocka_unit_test(separators_pass_between_values_when_asked_for),
        cmocka_unit_test(the_end_is_given_again),
        cmocka_unit_test(what_is_no_json_is_refused_with_its_line),
        cmocka_unit_test(what_is_cut_is_refused_with_what_it_was_cut_in),
        cmocka_unit_test(a_token_and_the_depth_are_limited),
        cmocka_unit_test(events_tell_their_line),
        cmocka_unit_test(the_end_of_a_block_may_be_anywhere),
        cmocka_unit_test(skipping_leaves_nothing_of_a_value),
        cmocka_unit_test(memory_does_not_grow_with_the_text),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(dicom_json_is_told_from_other_json),
        cmocka_unit_test(a_value_is_limited_with_all_its_numbers),
        cmocka_unit_test(every_allocation_of_the_reader_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
