#include "config.h"
#include "samples.h"
#include "output/writer.h"
#include "region/clean.h"
#include "region/joiner.h"
#include "region/keyhole.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What a test case is called with. */
typedef struct sample {
    const samples *kind;
    const char *folder;         /* "/valid" or "/invalid" */
    char name[256], title[512];
} sample;

typedef struct specification {
    const samples *kind;
    size_t n;
    const char *name, *first;
} specification;

/* ---- files --------------------------------------------------------------------- */

static const char *source_tree(void)
{
    const char *dir = getenv("srcdir");
    return dir && *dir ? dir : ".";
}

/* formats/FOLDER + NAME up to its point + EXTENSION with a terminator behind its
 * N bytes, to be freed; null when it is not there. */
static char *load(const char *folder, const char *sub, const char *name, const char *extension, size_t *n)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/formats/%s%s%.*s%s", source_tree(), folder, sub, (int)strcspn(name, "."), name, extension);
    FILE *f = fopen(path, "rb");
    if (!f)
        return NULL;
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

static char *load_beside(const sample *s, const char *sub, const char *extension, size_t *n)
{
    char *text = load(s->kind->folder, sub, s->name, extension, n);
    if (!text)
        fail_msg("%s%s%s has no %s", s->kind->folder, sub, s->name, extension);
    return text;
}

/* ---- reading ---------------------------------------------------------------------- */

/* Refuses stacks with a fault, as the commands do. */
typedef struct guard {
    il_sink sink;
    il_sink *next;
} guard;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_sink *next = ((guard *)self)->next;
    il_status st = il_stack_head_refuse_fault(head, err);
    return st == IL_OK ? next->stack_begin(next, head, err) : st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    il_sink *next = ((guard *)self)->next;
    return next->slice(next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    il_sink *next = ((guard *)self)->next;
    return next->pair(next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    il_sink *next = ((guard *)self)->next;
    return next->stack_end(next, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    il_sink *next = ((guard *)self)->next;
    return next->end(next, err);
}

/* Go to the sample's folder, where files that belong to it stand beside it under
 * its name; the way back is in *HERE. */
static void go_to(const sample *s, int *here)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/formats/%s%s", source_tree(), s->kind->folder, s->folder);
    *here = open(".", O_RDONLY);
    assert_true(*here >= 0);
    assert_int_equal(chdir(path), 0);
}

static void go_back(int here)
{
    assert_int_equal(fchdir(here), 0);
    close(here);
}

/* What `isoloft read` prints, in memory; null after a failure. */
static il_output *read_sample(const sample *s, const char *text, size_t n, il_error *err)
{
    int here;
    const il_clean_options clean = { .keyhole = s->kind->reader->is_patient ? IL_KEYHOLE_MM : 0, .keyhole_is_mm = true };
    const il_join_options join = { 0 };
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_read_options o = s->kind->options ? s->kind->options(text) : defaults;
    il_source *source = NULL;
    il_output *out = NULL;
    il_sink *writer = NULL, *joiner = NULL, *cleaner = NULL;
    go_to(s, &here);
    il_status st = il_source_from_memory(&source, text, n, s->name, err);
    if (st == IL_OK)
        st = il_output_to_memory(&out, err);
    if (st == IL_OK)
        st = il_writer_loft.contours_new(&writer, out, err);
    if (st == IL_OK)
        st = il_joiner_new(&joiner, &join, writer, NULL, err);
    if (st == IL_OK)
        st = il_cleaner_new(&cleaner, &clean, joiner, NULL, err);
    guard g = { { on_stack, on_slice, on_pair, on_stack_end, on_end }, cleaner };
    if (st == IL_OK)
        st = s->kind->reader->read(&source, 1, &o, &g.sink, NULL, err);
    il_cleaner_free(cleaner);
    il_joiner_free(joiner);
    il_writer_loft.contours_free(writer);
    il_source_close(source);
    go_back(here);
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
    const sample *s = *state;
    size_t n, m;
    char *text = load_beside(s, "/valid/", s->kind->extension, &n), *expected = load_beside(s, "/valid/", ".loft", &m);
    il_error err = IL_ERROR_INIT;
    il_output *out = read_sample(s, text, n, &err);
    if (!out)
        fail_msg("%s:%ld: %s", err.file, err.line, err.text);
    assert_output(out, expected, m);
    il_output_discard(out);
    free(text);
    free(expected);
}

static void invalid_sample(void **state)
{
    const sample *s = *state;
    char got[900];
    size_t n, m;
    char *text = load_beside(s, "/invalid/", s->kind->extension, &n), *expected = load_beside(s, "/invalid/", ".error", &m);
    il_error err = IL_ERROR_INIT;
    assert_null(read_sample(s, text, n, &err));
    assert_int_equal(err.code, IL_E_INPUT);
    il_error_message(&err, got, sizeof got);
    size_t length = strcspn(expected, "\n");
    expected[length] = '\0';
    if (s->kind->foreign && strstr(expected, s->kind->foreign) && strlen(got) > length && got[length] == ':')
        got[length] = '\0';
    assert_string_equal(got, expected);
    free(text);
    free(expected);
}

/* Cut anywhere in what has to be there, a sample is refused, unless what is left
 * says all that it said. */
static void cut_sample(void **state)
{
    const sample *s = *state;
    size_t n, m;
    char *text = load_beside(s, "/valid/", s->kind->extension, &n), *expected = load_beside(s, "/valid/", ".loft", &m);
    size_t essential = s->kind->essential ? s->kind->essential(text) : n;
    for (size_t k = 0; k < essential; k++) {
        il_error err = IL_ERROR_INIT;
        il_output *out = read_sample(s, text, k, &err);
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
    const specification *spec = *state;
    size_t n, size;
    char *text = load("", "", spec->name, ".txt", &n);
    assert_non_null(text);
    for (char *p = strstr(text, "[x_"); p; p = strstr(p + 1, "[x_")) {
        char name[128];
        size_t length = 0, found = 0;
        while (is_sample_name(p[1 + length]))
            length++;
        assert_int_equal(p[1 + length], ']');
        snprintf(name, sizeof name, "%.*s", (int)length, p + 1);
        for (size_t k = 0; k < spec->n; k++) {
            char *expected = load(spec->kind[k].folder, "/invalid/", name, ".error", &size);
            found += expected != NULL;
            free(expected);
        }
        if (found == 0)
            fail_msg("%s is not there", name);
    }
    free(text);
}

static void every_must_has_a_sample_that_breaks_it(void **state)
{
    const specification *spec = *state;
    size_t n;
    char *text = load("", "", spec->name, ".txt", &n);
    assert_non_null(text);
    char *p = strstr(text, spec->first);
    assert_non_null(p);
    for (p = strstr(p, "MUST"); p; p = strstr(p + 4, "MUST")) {
        char *named = strstr(p, "[x_"), *stop = strstr(p, ".\n\n");
        if (!named || (stop && stop < named))
            fail_msg("no sample behind: %.60s", p);
    }
    free(text);
}

/* ---- all of them ---------------------------------------------------------------------------- */

enum { MOST_CASES = 2000 };

static struct CMUnitTest cases[MOST_CASES];
static size_t n_cases;

static bool ends_with(const char *s, const char *end)
{
    size_t n = strlen(s), m = strlen(end);
    return n >= m && strcmp(s + n - m, end) == 0;
}

/* Cases for the samples in KIND's folder SUB, called PREFIX and their names. */
static void add_samples(const samples *kind, const char *sub, const char *prefix, CMUnitTestFunction function)
{
    char path[1024];
    struct dirent **entry;
    size_t before = n_cases;
    snprintf(path, sizeof path, "%s/formats/%s%s", source_tree(), kind->folder, sub);
    int found = scandir(path, &entry, NULL, alphasort);
    for (int i = 0; i < found; i++) {
        sample *s = calloc(1, sizeof *s);
        if (!s || n_cases >= MOST_CASES)
            abort();
        s->kind = kind;
        s->folder = sub;
        snprintf(s->name, sizeof s->name, "%.255s", entry[i]->d_name);
        snprintf(s->title, sizeof s->title, "%s%s", prefix, s->name);
        if (ends_with(s->name, kind->extension))
            cases[n_cases++] = (struct CMUnitTest){ s->title, function, NULL, NULL, s };
        else
            free(s);
        free(entry[i]);
    }
    if (found >= 0)
        free(entry);
    if (n_cases == before) {
        fprintf(stderr, "no samples in %s\n", path);
        exit(1);
    }
}

int samples_run(const samples *kind, size_t n, const char *spec, const char *first)
{
    specification of = { kind, n, spec, first };
    cases[n_cases++] = (struct CMUnitTest){ "every_sample_that_the_specification_names_is_there",
                                            every_sample_that_the_specification_names_is_there, NULL, NULL, &of };
    cases[n_cases++] = (struct CMUnitTest){ "every_must_has_a_sample_that_breaks_it",
                                            every_must_has_a_sample_that_breaks_it, NULL, NULL, &of };
    size_t fixed = n_cases;
    for (size_t k = 0; k < n; k++) {
        add_samples(&kind[k], "/valid", "", valid_sample);
        add_samples(&kind[k], "/invalid", "", invalid_sample);
        add_samples(&kind[k], "/valid", "cut_", cut_sample);
    }
    int failed = _cmocka_run_group_tests(spec, cases, n_cases, NULL, NULL);
    for (size_t i = fixed; i < n_cases; i++)
        free(cases[i].initial_state);
    return failed;
}

size_t samples_json_value(const char *text)
{
    size_t depth = 0, i = 0;
    for (bool in_string = false; text[i]; i++) {
        if (text[i] == '"')
            in_string = !in_string;
        else if (in_string && text[i] == '\\')
            i++;
        else if (!in_string && (text[i] == '{' || text[i] == '['))
            depth++;
        else if (!in_string && (text[i] == '}' || text[i] == ']') && --depth == 0)
            break;
    }
    return i;
}
