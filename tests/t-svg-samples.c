/* t-svg-samples.c - every sample of formats/svg.txt, read as `isoloft read` does:
 * reader, cleaning, native writer. */
#include "config.h"
#include "base/number.h"
#include "input/reader.h"
#include "output/writer.h"
#include "region/clean.h"
#include "test.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- files --------------------------------------------------------------------- */

static const char *source_tree(void)
{
    const char *dir = getenv("srcdir");
    return dir && *dir ? dir : ".";
}

/* A file below formats/, with a terminator behind its N bytes; to be freed. */
static char *load(const char *folder, const char *name, const char *extension, size_t *n)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/formats/%s%.*s%s", source_tree(), folder, (int)strcspn(name, "."), name, extension);
    FILE *f = fopen(path, "rb");
    if (!f)
        fail_msg("cannot open %s", path);
    assert_int_equal(fseek(f, 0, SEEK_END), 0);
    *n = (size_t)ftell(f);
    rewind(f);
    char *text = malloc(*n + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, *n, f), *n);
    text[*n] = '\0';
    fclose(f);
    return text;
}

/* ---- reading ---------------------------------------------------------------------- */

/* The options in the comment "<!-- isoloft read ... -->" of a sample. */
static il_read_options options_of(const char *text)
{
    static const char mark[] = "<!-- isoloft read ";
    il_read_options o = IL_READ_OPTIONS_INIT;
    const char *p = strstr(text, mark);
    char word[2][64];
    if (!p)
        return o;
    p += strlen(mark);
    assert_true(sscanf(p, "%63s %63s", word[0], word[1]) == 2);
    if (strcmp(word[0], "--spacing") == 0) {
        o.has_spacing = true;
        assert_true(il_number_parse(word[1], strlen(word[1]), &o.spacing) > 0);
    } else if (strcmp(word[0], "--flatness") == 0) {
        assert_true(il_number_parse(word[1], strlen(word[1]), &o.flatness) > 0);
    } else if (strcmp(word[0], "--unit") == 0) {
        o.has_unit = true;
        assert_true(il_unit_parse(word[1], strlen(word[1]), &o.unit));
    } else {
        assert_string_equal(word[0], "--no-flip");
        o.no_flip = true;
    }
    return o;
}

/* What `isoloft read` prints, in memory; null after a failure. */
static il_output *read_sample(const char *text, size_t n, const il_read_options *o, const char *name, il_error *err)
{
    const il_clean_options clean = { 0 };
    il_source *source = NULL;
    il_output *out = NULL;
    il_sink *writer = NULL, *cleaner = NULL;
    il_status st = il_source_from_memory(&source, text, n, name, err);
    if (st == IL_OK)
        st = il_output_to_memory(&out, err);
    if (st == IL_OK)
        st = il_writer_loft.contours_new(&writer, out, err);
    if (st == IL_OK)
        st = il_cleaner_new(&cleaner, &clean, writer, NULL, err);
    if (st == IL_OK)
        st = il_reader_svg.read(&source, 1, o, cleaner, NULL, err);
    il_cleaner_free(cleaner);
    il_writer_loft.contours_free(writer);
    il_source_close(source);
    if (st == IL_OK)
        return out;
    il_output_discard(out);
    return NULL;
}

static void assert_output(const il_output *out, const char *text, size_t n)
{
    size_t m;
    const unsigned char *got = il_output_memory(out, &m);
    if (m != n || memcmp(got, text, n) != 0)
        fail_msg("expected:\n%.*s\nbut got:\n%.*s", (int)n, text, (int)m, (const char *)got);
}

/* ---- a case each -------------------------------------------------------------------- */

static void valid_sample(void **state)
{
    const char *name = *state;
    size_t n, m;
    char *text = load("svg/valid/", name, ".svg", &n), *expected = load("svg/valid/", name, ".loft", &m);
    il_read_options o = options_of(text);
    il_error err = IL_ERROR_INIT;
    il_output *out = read_sample(text, n, &o, name, &err);
    if (!out)
        fail_msg("%s:%ld: %s", err.file, err.line, err.text);
    assert_output(out, expected, m);
    il_output_discard(out);
    free(text);
    free(expected);
}

/* "FILE:LINE: not well-formed" leaves the rest of the sentence to libxml2. */
static void invalid_sample(void **state)
{
    const char *name = *state;
    char got[900];
    size_t n, m;
    char *text = load("svg/invalid/", name, ".svg", &n), *expected = load("svg/invalid/", name, ".error", &m);
    il_read_options o = options_of(text);
    il_error err = IL_ERROR_INIT;
    assert_null(read_sample(text, n, &o, name, &err));
    assert_int_equal(err.code, IL_E_INPUT);
    il_error_message(&err, got, sizeof got);
    size_t length = strcspn(expected, "\n");
    expected[length] = '\0';
    if (strstr(expected, ": not well-formed") && strlen(got) > length && got[length] == ':')
        got[length] = '\0';
    assert_string_equal(got, expected);
    free(text);
    free(expected);
}

/* Cut anywhere, a drawing with an svg around it is refused, unless what is left
 * says all that it said. */
static void cut_sample(void **state)
{
    const char *name = *state;
    size_t n, m;
    char *text = load("svg/valid/", name, ".svg", &n), *expected = load("svg/valid/", name, ".loft", &m);
    il_read_options o = options_of(text);
    bool has_root = strstr(text, "</svg") || strstr(text, "</s:svg");
    for (size_t k = has_root ? 0 : n; k < n; k++) {
        il_error err = IL_ERROR_INIT;
        il_output *out = read_sample(text, k, &o, name, &err);
        if (out)
            assert_output(out, expected, m);
        il_output_discard(out);
    }
    free(text);
    free(expected);
}

/* ---- the specification ------------------------------------------------------------------ */

static bool is_sample_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

static void every_sample_that_the_specification_names_is_there(void **state)
{
    (void)state;
    size_t n, size;
    int seen = 0;
    char *spec = load("", "svg", ".txt", &n);
    for (char *p = strstr(spec, "[x_"); p; p = strstr(p + 1, "[x_"), seen++) {
        char name[128];
        size_t length = 0;
        while (is_sample_name(p[1 + length]))
            length++;
        assert_int_equal(p[1 + length], ']');
        snprintf(name, sizeof name, "%.*s", (int)length, p + 1);
        free(load("svg/invalid/", name, ".error", &size));
    }
    assert_true(seen > 50);
    free(spec);
}

static void every_must_has_a_sample_that_breaks_it(void **state)
{
    (void)state;
    size_t n;
    char *spec = load("", "svg", ".txt", &n), *p = strstr(spec, "3.  Which elements are contours\n\n");
    assert_non_null(p);
    for (p = strstr(p, "MUST"); p; p = strstr(p + 4, "MUST")) {
        char *sample = strstr(p, "[x_"), *stop = strstr(p, ".\n\n");
        if (!sample || (stop && stop < sample))
            fail_msg("no sample behind: %.60s", p);
    }
    free(spec);
}

/* ---- all of them ---------------------------------------------------------------------------- */

static int is_svg(const struct dirent *e)
{
    const char *dot = strrchr(e->d_name, '.');
    return dot && strcmp(dot, ".svg") == 0;
}

/* Cases for the samples in FOLDER, called PREFIX and their names, added to
 * TEST[*N]; exits when there are none. */
static void add_samples(struct CMUnitTest *test, size_t *n, size_t cap, const char *folder, const char *prefix,
                        CMUnitTestFunction function)
{
    char path[1024];
    struct dirent **entry;
    snprintf(path, sizeof path, "%s/formats/svg/%s", source_tree(), folder);
    int found = scandir(path, &entry, is_svg, alphasort);
    if (found <= 0 || *n + (size_t)found > cap) {
        fprintf(stderr, "%d samples in %s\n", found, path);
        exit(1);
    }
    for (int i = 0; i < found; i++) {
        size_t size = strlen(prefix) + strlen(entry[i]->d_name) + 1;
        char *title = malloc(size);
        if (!title)
            abort();
        snprintf(title, size, "%s%s", prefix, entry[i]->d_name);
        test[(*n)++] = (struct CMUnitTest){ title, function, NULL, NULL, title + strlen(prefix) };
        free(entry[i]);
    }
    free(entry);
}

int main(void)
{
    enum { MOST = 1000 };
    static struct CMUnitTest test[MOST] = {
        cmocka_unit_test(every_sample_that_the_specification_names_is_there),
        cmocka_unit_test(every_must_has_a_sample_that_breaks_it),
    };
    size_t n = 2, fixed = n;
    add_samples(test, &n, MOST, "valid", "", valid_sample);
    add_samples(test, &n, MOST, "invalid", "", invalid_sample);
    add_samples(test, &n, MOST, "valid", "cut_", cut_sample);
    int failed = _cmocka_run_group_tests("svg samples", test, n, NULL, NULL);
    for (size_t i = fixed; i < n; i++)
        free((char *)test[i].name);
    return failed;
}
