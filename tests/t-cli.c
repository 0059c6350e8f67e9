/* t-cli.c - the small parts of the commands: file names, JSON, selection. */
#include "config.h"
#include "cli/filename.h"
#include "cli/grid.h"
#include "cli/json.h"
#include "base/pattern.h"
#include "cli/select.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- file names ---------------------------------------------------------- */

static void names_become_file_names_and_nothing_else(void **state)
{
    (void)state;
    char hundred[101];
    memset(hundred, 'x', 100);
    hundred[100] = '\0';
    const struct { long number; const char *name, *file; } c[] = {
        { 1, "Lung", "0001-Lung.stl" }, { 12345, "a b", "12345-a_b.stl" }, { 2, "../../x", "0002-______x.stl" },
        { 3, "-rf", "0003--rf.stl" }, { 4, "a\nb\x1b[31m", "0004-a_b__31m.stl" }, { 5, "", "0005.stl" },
        { 6, "Ni\xc3\xa8re", "0006-Ni__re.stl" }, { 7, ".", "0007-_.stl" }, { 8, "CON", "0008-CON.stl" },
        { 9, hundred, "0009-xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx.stl" } };
    il_keymap used = IL_KEYMAP_INIT;
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        char file[IL_FILENAME_MAX];
        assert_true(il_filename_make(file, c[k].number, c[k].name, "stl", &used));
        assert_string_equal(file, c[k].file);
    }
    il_keymap_free(&used);
}

static void a_number_used_twice_is_told_apart(void **state)
{
    (void)state;
    static const struct { long number; const char *name, *file; } c[] = {
        { 1, "2-X", "0001-2-X.stl" }, { 1, "X", "0001-3-X.stl" }, { 1, "X", "0001-4-X.stl" },
        { 2, "A", "0002-A.stl" }, { 2, "B", "0002-2-B.stl" }, { 2, "2-B", "0002-3-2-B.stl" },
        { 1, "4-X", "0001-5-4-X.stl" } };
    il_keymap used = IL_KEYMAP_INIT;
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        char file[IL_FILENAME_MAX];
        assert_true(il_filename_make(file, c[k].number, c[k].name, "stl", &used));
        assert_string_equal(file, c[k].file);
    }
    il_keymap_free(&used);
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void no_two_file_names_are_equal(void **state)
{
    (void)state;
    enum { N = 3000 };
    char (*file)[IL_FILENAME_MAX] = malloc(N * sizeof *file);
    assert_non_null(file);
    il_keymap used = IL_KEYMAP_INIT;
    unsigned seed = 5;
    for (int k = 0; k < N; k++) {
        char name[20];
        seed = seed * 1103515245u + 12345u;
        snprintf(name, sizeof name, "%u-%s", seed >> 16 & 7, seed >> 20 & 1 ? "X" : "2-X");
        assert_true(il_filename_make(file[k], seed >> 24 & 3, seed >> 21 & 1 ? name : name + 2, "stl", &used));
    }
    qsort(file, N, sizeof *file, compare_names);
    for (int k = 1; k < N; k++)
        assert_string_not_equal(file[k - 1], file[k]);
    il_keymap_free(&used);
    free(file);
}

static void an_extension_stands_behind_the_last_point_of_the_last_part(void **state)
{
    (void)state;
    static const char *const c[][2] = { { "a.stl", "stl" }, { "a", "" }, { "d.x/a", "" }, { ".stl", "" },
                                        { "a.b.PLY", "PLY" }, { "/dev/full", "" }, { "d/.hidden", "" }, { "a.", "" } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++)
        assert_string_equal(il_filename_extension(c[k][0]), c[k][1]);
}

/* ---- JSON ---------------------------------------------------------------- */

static void assert_output(il_output *out, const char *expected)
{
    size_t n;
    const unsigned char *text = il_output_memory(out, &n);
    assert_int_equal(n, strlen(expected));
    assert_memory_equal(text, expected, n);
    il_output_discard(out);
}

static void json_is_well_formed(void **state)
{
    (void)state;
    il_output *out = NULL;
    assert_int_equal(il_output_to_memory(&out, NULL), IL_OK);
    il_json j = { out, false };
    il_json_open(&j, '{');
    il_json_key(&j, "a");
    il_json_open(&j, '[');
    il_json_integer(&j, -3);
    il_json_number(&j, 0.1);
    il_json_number(&j, INFINITY);
    il_json_number(&j, NAN);
    il_json_open(&j, '{');
    il_json_close(&j, '}');
    il_json_close(&j, ']');
    il_json_key(&j, "b");
    il_json_bool(&j, true);
    il_json_key(&j, "c");
    il_json_null(&j);
    il_json_close(&j, '}');
    assert_output(out, "{\"a\":[-3,0.1,null,null,{}],\"b\":true,\"c\":null}");
}

static void json_strings_hold_any_bytes(void **state)
{
    (void)state;
    il_output *out = NULL;
    assert_int_equal(il_output_to_memory(&out, NULL), IL_OK);
    il_json j = { out, false };
    il_json_open(&j, '[');
    il_json_string(&j, "q\" b\\ n\n e\x1b d\x7f");
    il_json_string(&j, "\xc3\xa8 \xff \xe2\x80\xae");
    il_json_string(&j, NULL);
    il_json_close(&j, ']');
    assert_output(out, "[\"q\\\" b\\\\ n\\u000a e\\u001b d\\u007f\",\"\xc3\xa8 \xef\xbf\xbd \\u202e\",null]");
}

/* ---- selection ----------------------------------------------------------- */

typedef struct counter { il_sink sink; int stacks, slices, ends; } counter;

static il_status count_begin(il_sink *s, const il_stack_head *h, il_error *err)
{
    (void)h;
    (void)err;
    ((counter *)s)->stacks++;
    return IL_OK;
}

static il_status count_slice(il_sink *s, il_slice *slice, il_error *err)
{
    (void)slice;
    (void)err;
    ((counter *)s)->slices++;
    return IL_OK;
}

static il_status count_pair(il_sink *s, il_pair *p, il_error *err)
{
    (void)s;
    (void)p;
    (void)err;
    return IL_OK;
}

static il_status count_end(il_sink *s, il_error *err)
{
    (void)err;
    ((counter *)s)->ends++;
    return IL_OK;
}

/* PATTERNS: as many as there are words, parted by '|'. */
static il_status select_from(const char *patterns, counter *c, il_error *err)
{
    static const char *const names[] = { "Lung left", "Lung right", "Heart", "", "\xc3\x84o", "!x" };
    const size_t n_names = sizeof names / sizeof *names;
    char words[100];
    const char *pattern[8] = { words };
    size_t n = 1;
    snprintf(words, sizeof words, "%s", patterns);
    for (char *bar = words; (bar = strchr(bar, '|'));) {
        *bar++ = '\0';
        pattern[n++] = bar;
    }
    *c = (counter){ { count_begin, count_slice, count_pair, count_end, count_end }, 0, 0, 0 };
    il_sink *s = NULL;
    il_report report = IL_REPORT_INIT;
    il_voice voice = { .quiet = true };
    il_status st = il_select_new(&s, pattern, n, &c->sink, &report, &voice, err);
    for (size_t k = 0; k < n_names && st == IL_OK; k++) {
        il_stack_head head = IL_STACK_HEAD_INIT;
        il_slice slice = IL_SLICE_INIT;
        il_pair pair = IL_PAIR_INIT;
        assert_true(il_stack_head_set_name(&head, names[k], strlen(names[k])));
        st = s->stack_begin(s, &head, err);
        st = st == IL_OK ? s->slice(s, &slice, err) : st;
        st = st == IL_OK ? s->pair(s, &pair, err) : st;
        st = st == IL_OK ? s->stack_end(s, err) : st;
        il_stack_head_free(&head);
    }
    st = st == IL_OK ? s->end(s, err) : st;
    il_select_free(s);
    return st;
}

static void a_pattern_lets_matching_stacks_through(void **state)
{
    (void)state;
    static const struct { const char *pattern; int stacks; } c[] = {
        { "Lung*", 2 }, { "*", 6 }, { "Heart", 1 }, { "", 1 }, { "[HL]*t", 3 },
        { "Heart|Lung l*", 2 }, { "Heart|Heart", 1 }, { "!Lung*", 4 }, { "Lung*|!*left", 1 }, { "!*left|Lung*", 1 },
        { "!Lung*|!Heart", 3 }, { "\\!x", 1 }, { "!!x", 5 }, { "!", 5 } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        counter n;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(select_from(c[k].pattern, &n, &err), IL_OK);
        assert_int_equal(n.stacks, c[k].stacks);
        assert_int_equal(n.slices, c[k].stacks);
        assert_int_equal(n.ends, c[k].stacks + 1);
    }
}

static void patterns_are_those_of_shells(void **state)
{
    (void)state;
    static const struct { const char *pattern, *name; bool matches; } c[] = {
        { "", "", true }, { "", "a", false }, { "*", "", true }, { "a*b*c", "a-b-b-c", true }, { "a*b*c", "acb", false },
        { "?o", "\xc3\x84o", true }, { "??o", "\xc3\x84o", false }, { "[\xc3\x84]o", "\xc3\x84o", true },
        { "[a-\xc3\xbf]", "\xc3\xa4", true }, { "[!a-z]", "\xc3\xa4", true }, { "[^a-z]", "b", false }, { "?", "\xff", true },
        { "\xff", "\xff", true }, { "[]]", "]", true }, { "[!]]", "]", false }, { "[a-]", "-", true }, { "[", "[", true },
        { "[ab", "[ab", true }, { "[ab", "a", false }, { "\\*", "*", true }, { "\\*", "a", false }, { "[\\]]", "]", true },
        { "\\", "\\", true }, { "*a", "aaab", false }, { "*[0-9]", "PTV 50", true }, { "*", "a/b", true }, { "?", "", false } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++)
        if (il_pattern_matches(c[k].pattern, c[k].name) != c[k].matches)
            fail_msg("'%s' and '%s'", c[k].pattern, c[k].name);
}

static void a_pattern_of_many_stars_takes_no_time(void **state)
{
    (void)state;
    enum { STARS = 400, LETTERS = 20000 };
    static char pattern[2 * STARS + 2], name[LETTERS + 1];
    for (size_t k = 0; k < STARS; k++)
        memcpy(pattern + 2 * k, "*a", 2);
    pattern[2 * STARS] = 'b';
    memset(name, 'a', LETTERS);
    assert_false(il_pattern_matches(pattern, name));
}

static void a_pattern_that_matches_nothing_is_an_error(void **state)
{
    (void)state;
    counter n;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(select_from("Liver", &n, &err), IL_E_INPUT);
    assert_int_equal(n.stacks + n.slices + n.ends, 0);
    assert_string_equal(err.text, "no name matches 'Liver'; there are 'Lung left', 'Lung right', 'Heart', '', '\xc3\x84o' and 1 more");
    err = (il_error)IL_ERROR_INIT;
    assert_int_equal(select_from("*|!*", &n, &err), IL_E_INPUT);
    assert_int_equal(n.stacks + n.slices + n.ends, 0);
}

/* ---- grids ---------------------------------------------------------------- */

static void a_column_is_as_wide_as_a_terminal_shows_it(void **state)
{
    (void)state;
    assert_int_equal(il_text_columns(""), 0);
    assert_int_equal(il_text_columns("Lung"), 4);
    assert_int_equal(il_text_columns("Dr\xc3\xbcse"), 5);
    assert_int_equal(il_text_columns("u\xcc\x88"), 1);
    assert_int_equal(il_text_columns("\xe8\x82\xba\xe8\x82\xba"), 4);
    assert_int_equal(il_text_columns("\xff\xfe"), 2);
}

static void a_grid_is_aligned_and_printable(void **state)
{
    (void)state;
    static const char *const cells[] = { "N", "NAME", "", "10", "L\xc3\xbcnge", "x", "9", "a\x1b\n", "", "1", "", "y" };
    il_grid g = { .columns = 3 };
    il_output *out = NULL;
    assert_int_equal(il_output_to_memory(&out, NULL), IL_OK);
    for (size_t k = 0; k < sizeof cells / sizeof *cells; k++)
        assert_true(il_grid_add(&g, cells[k], 0));
    il_grid_write(&g, "100", out);
    assert_output(out, " N  NAME\n10  L\xc3\xbcnge      x\n 9  a\\x1b\\x0a\n 1             y\n");
    il_grid_free(&g);
    assert_true(il_grid_add(&g, "abcdefgh", 7) && il_grid_add(&g, "abcdefg", 7));
    assert_true(il_grid_add(&g, "\xe8\x82\xba\xe8\x82\xba\xe8\x82\xba\xe8\x82\xba", 6));
    assert_string_equal(g.cell[0], "abcd...");
    assert_string_equal(g.cell[1], "abcdefg");
    assert_string_equal(g.cell[2], "\xe8\x82\xba...");
    il_grid_free(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_become_file_names_and_nothing_else),
        cmocka_unit_test(a_number_used_twice_is_told_apart),
        cmocka_unit_test(no_two_file_names_are_equal),
        cmocka_unit_test(an_extension_stands_behind_the_last_point_of_the_last_part),
        cmocka_unit_test(json_is_well_formed),
        cmocka_unit_test(json_strings_hold_any_bytes),
        cmocka_unit_test(a_pattern_lets_matching_stacks_through),
        cmocka_unit_test(patterns_are_those_of_shells),
        cmocka_unit_test(a_pattern_of_many_stars_takes_no_time),
        cmocka_unit_test(a_pattern_that_matches_nothing_is_an_error),
        cmocka_unit_test(a_column_is_as_wide_as_a_terminal_shows_it),
        cmocka_unit_test(a_grid_is_aligned_and_printable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
