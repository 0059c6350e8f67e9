/* t-native.c - the native format: every sample of its specification, and what
 * no sample can show (cut streams, little memory, slow sources). */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/reader.h"
#include "output/writer.h"
#include "test.h"

#include <dirent.h>
#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- files ------------------------------------------------------------------- */

static const char *source_tree(void)
{
    const char *dir = getenv("srcdir");
    return dir && *dir ? dir : ".";
}

/* A file of the source tree; *N without the terminator that is added. */
static char *load(const char *folder, const char *name, size_t *n)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/formats/%s%s", source_tree(), folder, name);
    FILE *f = fopen(path, "rb");
    if (!f)
        fail_msg("cannot open %s", path);
    char *text = NULL;
    size_t cap = 0, got;
    *n = 0;
    do {
        assert_true(il_grow(&text, &cap, *n + 4096 + 1, 1));
        got = fread(text + *n, 1, 4096, f);
        *n += got;
    } while (got > 0);
    fclose(f);
    text[*n] = '\0';
    return text;
}

/* NAME with its extension replaced. */
static void renamed(char *to, size_t size, const char *name, const char *extension)
{
    snprintf(to, size, "%.*s%s", (int)strcspn(name, "."), name, extension);
}

/* ---- reading and writing ------------------------------------------------------- */

/* The canonical form of the N sources, in memory, or an error. */
static il_status canonical(il_source *const *source, size_t n, const il_read_options *options,
                           il_output **out, il_error *err)
{
    il_sink *writer = NULL;
    *out = NULL;
    il_status st = il_output_to_memory(out, err);
    if (st == IL_OK)
        st = il_writer_loft.contours_new(&writer, *out, err);
    if (st == IL_OK)
        st = il_reader_loft.read(source, n, options, writer, NULL, err);
    il_writer_loft.contours_free(writer);
    if (st != IL_OK) {
        il_output_discard(*out);
        *out = NULL;
    }
    return st;
}

static il_status canonical_of(const void *text, size_t n, const char *name, il_output **out, il_error *err)
{
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_source *source;
    il_status st = il_source_from_memory(&source, text, n, name, err);
    *out = NULL;
    if (st != IL_OK)
        return st;
    st = canonical(&source, 1, &options, out, err);
    il_source_close(source);
    return st;
}

static void assert_output(const il_output *out, const char *text, size_t n)
{
    size_t m;
    const unsigned char *got = il_output_memory(out, &m);
    if (m != n || memcmp(got, text, n) != 0)
        fail_msg("expected:\n%.*s\nbut got:\n%.*s", (int)n, text, (int)m, (const char *)got);
}

static void assert_canonical(const char *text, size_t n, const char *expected, size_t m)
{
    il_error err = IL_ERROR_INIT;
    il_output *out;
    if (canonical_of(text, n, "sample", &out, &err) != IL_OK)
        fail_msg("%s:%ld: %s", err.file, err.line, err.text);
    assert_output(out, expected, m);
    il_output_discard(out);
}

static void assert_refused(const char *text, size_t n, const il_read_options *options, const char *message)
{
    il_error err = IL_ERROR_INIT;
    il_source *source;
    il_output *out;
    char got[900];
    assert_int_equal(il_source_from_memory(&source, text, n, "sample", &err), IL_OK);
    assert_int_equal(canonical(&source, 1, options, &out, &err), IL_E_INPUT);
    il_source_close(source);
    il_error_message(&err, got, sizeof got);
    assert_string_equal(got, message);
}

/* ---- the samples, a case each --------------------------------------------------- */

static void valid_sample(void **state)
{
    const char *name = *state;
    char other[256];
    size_t n, m;
    renamed(other, sizeof other, name, ".canonical");
    char *text = load("loft/valid/", name, &n), *expected = load("loft/valid/", other, &m);
    assert_canonical(text, n, expected, m);
    assert_canonical(expected, m, expected, m); /* a fixed point */
    il_free(text);
    il_free(expected);
}

static void invalid_sample(void **state)
{
    const char *name = *state;
    char other[256], got[900];
    size_t n, m;
    renamed(other, sizeof other, name, ".error");
    char *text = load("loft/invalid/", name, &n), *expected = load("loft/invalid/", other, &m);
    il_error err = IL_ERROR_INIT;
    il_output *out;
    assert_int_equal(canonical_of(text, n, name, &out, &err), IL_E_INPUT);
    il_error_message(&err, got, sizeof got);
    expected[strcspn(expected, "\n")] = '\0';
    assert_string_equal(got, expected);
    il_free(text);
    il_free(expected);
}

/* A stream cut anywhere is refused, unless what is left says all it said. */
static void cut_sample(void **state)
{
    const char *name = *state;
    char other[256];
    size_t n, m;
    renamed(other, sizeof other, name, ".canonical");
    char *text = load("loft/valid/", name, &n), *expected = load("loft/valid/", other, &m);
    for (size_t k = 0; k < n; k++) {
        il_error err = IL_ERROR_INIT;
        il_output *out;
        il_status st = canonical_of(text, k, "cut", &out, &err);
        if (st == IL_OK)
            assert_output(out, expected, m);
        else
            assert_int_equal(st, IL_E_INPUT);
        il_output_discard(out);
    }
    il_free(text);
    il_free(expected);
}

/* ---- the specification ------------------------------------------------------------ */

static bool is_sample_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

static void every_sample_that_the_specification_names_is_there(void **state)
{
    (void)state;
    size_t n;
    char *spec = load("", "loft.txt", &n);
    int seen = 0;
    for (char *p = strstr(spec, "[x_"); p; p = strstr(p, "[x_"), seen++) {
        char name[128];
        size_t length = 0;
        while (is_sample_name(p[1 + length]))
            length++;
        assert_int_equal(p[1 + length], ']');
        snprintf(name, sizeof name, "%.*s.loft", (int)length, p + 1);
        size_t size;
        il_free(load("loft/invalid/", name, &size));
        p++;
    }
    assert_true(seen > 80);
    il_free(spec);
}

static void every_invalid_sample_stands_in_the_specification(void **state)
{
    (void)state;
    char path[1024];
    snprintf(path, sizeof path, "%s/formats/loft/invalid", source_tree());
    size_t n;
    char *spec = load("", "loft.txt", &n);
    DIR *dir = opendir(path);
    assert_non_null(dir);
    for (struct dirent *e = readdir(dir); e; e = readdir(dir)) {
        char bracketed[300];
        if (e->d_name[0] == '.')
            continue;
        snprintf(bracketed, sizeof bracketed, "[%.*s]", (int)strcspn(e->d_name, "."), e->d_name);
        if (!strstr(spec, bracketed))
            fail_msg("%s is not in loft.txt", bracketed);
    }
    closedir(dir);
    il_free(spec);
}

static void every_must_has_a_sample_that_breaks_it(void **state)
{
    (void)state;
    size_t n;
    char *spec = load("", "loft.txt", &n);
    char *p = strstr(spec, "4.  Characters, lines, strings, numbers\n\n");
    assert_non_null(p);
    for (p = strstr(p, "MUST"); p; ) {
        char *sample = strstr(p, "[x_"), *next = strstr(p + 4, "MUST");
        /* "it MUST be this and MUST be that [x_a] [x_b]" shares its samples */
        char *end_of_rule = p + strcspn(p, "[");
        if (!sample || (next && next < sample && memchr(p, '.', (size_t)(next - p))))
            fail_msg("no sample behind: %.60s", p);
        assert_true(end_of_rule <= sample);
        p = next;
    }
    il_free(spec);
}

/* ---- what no sample can show -------------------------------------------------------- */

static const char two_slices[] =
    "isoloft 1\nunit mm\nstack \"A\"\nattribute \"key\" \"value\"\nx-a\n"
    "slice 0\nx-b\nring\n0 0\n4 0\n0 3\nx-c\ninserted 1\n"
    "slice 1\nring\n0 0\n4 0\n0 3\npair\nmatcher none\nx-d\nend\n";

/* The first sample with every kind of line in it. */
static char *rich_sample(size_t *n)
{
    return load("loft/valid/", "v_pair_ffd.loft", n);
}

static void every_allocation_that_fails_is_said(void **state)
{
    (void)state;
    size_t n;
    char *rich = rich_sample(&n);
    const struct { const char *text; size_t n; } samples[] = { { rich, n }, { two_slices, sizeof two_slices - 1 } };
    for (size_t i = 0; i < 2; i++) {
        il_status st = IL_E_NOMEM;
        long k = 0;
        for (; st != IL_OK; k++) {
            il_error err = IL_ERROR_INIT;
            il_output *out;
            il_alloc_test_fail_after(k);
            st = canonical_of(samples[i].text, samples[i].n, "sample", &out, &err);
            il_alloc_test_fail_after(-1);
            if (st != IL_OK)
                assert_int_equal(st, IL_E_NOMEM);
            assert_int_equal(err.code, st);
            il_output_discard(out);
        }
        assert_true(k > 10);
    }
    il_free(rich);
}

/* A child that writes TEXT to a pipe a byte at a time; the end to read from. */
static int trickle(const char *text, size_t n, pid_t *child)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    *child = fork();
    if (*child == 0) {
        close(ends[0]);
        for (size_t i = 0; i < n; i++)
            if (write(ends[1], text + i, 1) != 1)
                _exit(1);
        _exit(0);
    }
    close(ends[1]);
    return ends[0];
}

static void a_source_of_single_bytes_gives_the_same(void **state)
{
    (void)state;
    const il_read_options options = IL_READ_OPTIONS_INIT;
    size_t n;
    char *text = rich_sample(&n), path[64];
    pid_t child;
    int fd = trickle(text, n, &child);
    snprintf(path, sizeof path, "/dev/fd/%d", fd);
    il_error err = IL_ERROR_INIT;
    il_source *source;
    il_output *whole, *trickled;
    if (il_source_open(&source, path, &err) != IL_OK) {
        close(fd);
        waitpid(child, NULL, 0);
        il_free(text);
        skip(); /* no /dev/fd here */
    }
    assert_int_equal(canonical(&source, 1, &options, &trickled, &err), IL_OK);
    assert_int_equal(canonical_of(text, n, "sample", &whole, &err), IL_OK);
    size_t m;
    const unsigned char *expected = il_output_memory(whole, &m);
    assert_output(trickled, (const char *)expected, m);
    il_output_discard(whole);
    il_output_discard(trickled);
    il_source_close(source);
    close(fd);
    waitpid(child, NULL, 0);
    il_free(text);
}

static void a_locale_with_decimal_commas_changes_nothing(void **state)
{
    static const char *const locales[] = { "de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8", "de_DE" };
    size_t i = 0, many = sizeof locales / sizeof *locales;
    while (i < many && !setlocale(LC_ALL, locales[i]))
        i++;
    if (i == many)
        skip();
    *state = "v_numbers.loft";
    valid_sample(state);
    setlocale(LC_ALL, "C");
}

static void several_streams_follow_one_another(void **state)
{
    (void)state;
    const char a[] = "isoloft 1\nunit mm\nstack \"a\"\nend\n", b[] = "isoloft 1\nend\n";
    const char c[] = "isoloft 1\nunit mm\nstack \"c\"\nend\n";
    const char all[] = "isoloft 1\nunit mm\nstack \"a\"\nstack \"c\"\nend\n";
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source[3];
    il_output *out;
    assert_int_equal(il_source_from_memory(&source[0], a, sizeof a - 1, "a", &err), IL_OK);
    assert_int_equal(il_source_from_memory(&source[1], b, sizeof b - 1, "b", &err), IL_OK);
    assert_int_equal(il_source_from_memory(&source[2], c, sizeof c - 1, "c", &err), IL_OK);
    assert_int_equal(canonical(source, 3, &options, &out, &err), IL_OK);
    assert_output(out, all, sizeof all - 1);
    il_output_discard(out);
    for (int i = 0; i < 3; i++)
        il_source_close(source[i]);
}

static void the_second_of_several_streams_is_named(void **state)
{
    (void)state;
    const char good[] = "isoloft 1\nend\n", bad[] = "isoloft 1\nunit ell\nend\n";
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source[2];
    il_output *out;
    assert_int_equal(il_source_from_memory(&source[0], good, sizeof good - 1, "good", &err), IL_OK);
    assert_int_equal(il_source_from_memory(&source[1], bad, sizeof bad - 1, "bad", &err), IL_OK);
    assert_int_equal(canonical(source, 2, &options, &out, &err), IL_E_INPUT);
    assert_string_equal(err.file, "bad");
    assert_int_equal(err.line, 2);
    il_source_close(source[0]);
    il_source_close(source[1]);
}

static void limits_are_kept(void **state)
{
    (void)state;
    il_read_options options = IL_READ_OPTIONS_INIT;
    options.max_points = 5;
    assert_refused(two_slices, sizeof two_slices - 1, &options, "sample:18: more than 5 vertices in one stack");
    options = (il_read_options)IL_READ_OPTIONS_INIT;
    options.max_line = 20;
    assert_refused(two_slices, sizeof two_slices - 1, &options, "sample:4: a line of more than 20 bytes");
}

static void rows_of_a_pair_are_limited_like_vertices(void **state)
{
    (void)state;
    il_read_options options = IL_READ_OPTIONS_INIT;
    options.max_points = 14; /* the vertices of the slices; the pair has 16 rows */
    size_t n;
    char *text = rich_sample(&n);
    assert_refused(text, n, &options, "sample:61: more than 14 rows in one pair");
    il_free(text);
}

/* Counts in the stream are 4e9 and 1.6e19 there. */
static void claimed_counts_reserve_nothing(void **state)
{
    (void)state;
#ifdef IL_SANITIZED
    skip(); /* the sanitizer's own address space is above any limit */
#else
    static const char *const names[] = { "x_count_many.loft", "x_lattice_rows.loft" };
    for (int i = 0; i < 2; i++) {
        size_t n;
        char *text = load("loft/invalid/", names[i], &n);
        pid_t child = fork();
        if (child == 0) {
            const struct rlimit limit = { 64 << 20, 64 << 20 };
            il_error err = IL_ERROR_INIT;
            il_output *out;
            if (setrlimit(RLIMIT_AS, &limit) != 0)
                _exit(IL_E_INPUT); /* the machine has no such limit */
            _exit((int)canonical_of(text, n, names[i], &out, &err));
        }
        int status = 0;
        waitpid(child, &status, 0);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), IL_E_INPUT);
        il_free(text);
    }
#endif
}

static void the_user_may_say_what_the_numbers_mean(void **state)
{
    (void)state;
    const char text[] = "isoloft 1\nunit cm\nstack \"a\"\nend\n";
    il_read_options options = IL_READ_OPTIONS_INIT;
    options.has_unit = true;
    options.unit = IL_UNIT_MM;
    il_error err = IL_ERROR_INIT;
    il_source *source;
    il_output *out;
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "a", &err), IL_OK);
    assert_int_equal(canonical(&source, 1, &options, &out, &err), IL_OK);
    assert_output(out, "isoloft 1\nunit mm\nstack \"a\"\nend\n", sizeof text - 1);
    il_output_discard(out);
    il_source_close(source);
}

/* What was projected was other numbers then. */
static void numbers_in_another_unit_were_not_projected(void **state)
{
    (void)state;
    const char text[] = "isoloft 1\nunit m\nstack \"a\"\nkind terrain\ngeographic 8 50 9 51\n"
                        "projection tm 6378137 0.003 9 0 1 0 0\nend\n";
    const char expected[] = "isoloft 1\nunit ft\nstack \"a\"\nkind terrain\nend\n";
    il_read_options options = IL_READ_OPTIONS_INIT;
    options.has_unit = true;
    options.unit = IL_UNIT_FT;
    il_source *source;
    il_output *out;
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "a", NULL), IL_OK);
    assert_int_equal(canonical(&source, 1, &options, &out, NULL), IL_OK);
    assert_output(out, expected, sizeof expected - 1);
    il_output_discard(out);
    il_source_close(source);
}

static void slices_of_one_height_are_counted(void **state)
{
    (void)state;
    const char text[] = "isoloft 1\nunit mm\nstack \"a\"\nslice 1\nslice 1\nslice 2\nslice 2\nend\n";
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source;
    il_output *out;
    il_sink *writer;
    assert_int_equal(il_source_from_memory(&source, text, sizeof text - 1, "a", &err), IL_OK);
    assert_int_equal(il_output_to_memory(&out, &err), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&writer, out, &err), IL_OK);
    assert_int_equal(il_reader_loft.read(&source, 1, &options, writer, &report, &err), IL_OK);
    assert_int_equal(report.repair[IL_REPAIR_MERGED_SLICE], 2);
    il_writer_loft.contours_free(writer);
    il_output_discard(out);
    il_source_close(source);
    il_report_free(&report);
}

static void an_unknown_keyword_of_a_later_minor_names_both_versions(void **state)
{
    (void)state;
    const char text[] = "isoloft 1.3\nunit mm\nstack \"a\"\nshade 3\nend\n";
    const il_read_options options = IL_READ_OPTIONS_INIT;
    assert_refused(text, sizeof text - 1, &options,
                   "sample:4: 'shade' is unknown in isoloft 1.0, which this program reads; the stream is isoloft 1.3");
}

static void names_from_files_do_not_steer_the_terminal_in_errors(void **state)
{
    (void)state;
    const char text[] = "isoloft 1\nunit \xe2\x80\xae" "mm\nend\n";
    const il_read_options options = IL_READ_OPTIONS_INIT;
    assert_refused(text, sizeof text - 1, &options,
                   "sample:2: '\\xe2\\x80\\xaemm' is not a unit: mm, cm, m, km, um, in, ft or deg");
}

static void the_format_is_told_by_its_first_bytes(void **state)
{
    (void)state;
    static const struct { const char *head; bool is; } c[] = {
        { "isoloft 1\n", true }, { "isoloft 2\n", true }, { "\xEF\xBB\xBFisoloft 1", true }, { "isoloft", false },
        { "isoloftx", false }, { " isoloft 1", false }, { "", false }, { "\xEF\xBB\xBF", false }, { "<svg>", false } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        assert_int_equal(il_reader_loft.probe((const unsigned char *)c[i].head, strlen(c[i].head)), c[i].is);
}

/* ---- calls ----------------------------------------------------------------------- */

/* A sink that writes down what it is told, and fails at a call if asked to. */
typedef struct recorder {
    il_sink sink;
    char calls[64];
    char fail_at;
    il_status code;
} recorder;

static il_status record(il_sink *self, char what, il_error *err)
{
    recorder *r = (recorder *)self;
    size_t n = strlen(r->calls);
    assert_true(n + 1 < sizeof r->calls);
    r->calls[n] = what;
    return what == r->fail_at ? il_fail(err, r->code, 7, "as asked for") : IL_OK;
}

static il_status record_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    assert_string_equal(il_stack_head_name(head), "A");
    return record(self, '(', err);
}

static il_status record_slice(il_sink *self, il_slice *slice, il_error *err)
{
    il_slice mine = *slice; /* keep it, as a sink may */
    *slice = (il_slice)IL_SLICE_INIT;
    il_slice_free(&mine);
    return record(self, 's', err);
}

static il_status record_pair(il_sink *self, il_pair *pair, il_error *err)
{
    assert_int_equal(pair->matcher, IL_MATCHER_NONE);
    return record(self, 'p', err);
}

static il_status record_stack_end(il_sink *self, il_error *err)
{
    return record(self, ')', err);
}

static il_status record_end(il_sink *self, il_error *err)
{
    return record(self, '.', err);
}

static il_status record_calls(recorder *r, il_error *err)
{
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_source *source;
    r->sink = (il_sink){ record_begin, record_slice, record_pair, record_stack_end, record_end };
    assert_int_equal(il_source_from_memory(&source, two_slices, sizeof two_slices - 1, "sample", err), IL_OK);
    il_status st = il_reader_loft.read(&source, 1, &options, &r->sink, NULL, err);
    il_source_close(source);
    return st;
}

static void the_sink_is_called_in_order(void **state)
{
    (void)state;
    recorder r = { .fail_at = 0 };
    il_error err = IL_ERROR_INIT;
    assert_int_equal(record_calls(&r, &err), IL_OK);
    assert_string_equal(r.calls, "(ssp).");
}

static void nothing_is_called_after_a_failure(void **state)
{
    (void)state;
    static const char *const upto[] = { "(", "(s", "(ssp", "(ssp)", "(ssp)." };
    for (size_t i = 0; i < 5; i++) {
        recorder r = { .fail_at = upto[i][strlen(upto[i]) - 1], .code = IL_E_IO };
        il_error err = IL_ERROR_INIT;
        assert_int_equal(record_calls(&r, &err), IL_E_IO);
        assert_string_equal(r.calls, upto[i]);
        assert_string_equal(err.file, ""); /* the failure is not the input's */
    }
}

static void what_a_sink_finds_wrong_with_the_input_names_it(void **state)
{
    (void)state;
    recorder r = { .fail_at = 's', .code = IL_E_INPUT };
    il_error err = IL_ERROR_INIT;
    assert_int_equal(record_calls(&r, &err), IL_E_INPUT);
    assert_string_equal(err.file, "sample");
    assert_int_equal(err.line, 7);
}

/* ---- the writer by itself ---------------------------------------------------------- */

static void a_pair_of_unordered_slices_is_not_written(void **state)
{
    (void)state;
    il_error err = IL_ERROR_INIT;
    il_output *out;
    il_sink *writer;
    il_slice s = IL_SLICE_INIT;
    il_pair p = IL_PAIR_INIT;
    const il_stack_head head = IL_STACK_HEAD_INIT;
    assert_int_equal(il_output_to_memory(&out, &err), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&writer, out, &err), IL_OK);
    il_ring *r = il_slice_add_ring(&s);
    assert_true(r && il_ring_add(r, 4, 0, 0) && il_ring_add(r, 0, 3, 0) && il_ring_add(r, 0, 0, 0));
    assert_int_equal(writer->stack_begin(writer, &head, &err), IL_OK);
    assert_int_equal(writer->slice(writer, &s, &err), IL_OK);
    assert_int_equal(writer->slice(writer, &s, &err), IL_OK);
    assert_int_equal(writer->pair(writer, &p, &err), IL_E_INTERNAL);
    il_writer_loft.contours_free(writer);
    il_output_discard(out);
    il_slice_free(&s);
}

static void a_name_that_is_not_utf8_is_written_readably(void **state)
{
    (void)state;
    const char expected[] = "isoloft 1\nunit mm\nstack \"a\xEF\xBF\xBD" "b\"\nend\n";
    il_error err = IL_ERROR_INIT;
    il_output *out;
    il_sink *writer;
    il_stack_head head = IL_STACK_HEAD_INIT;
    assert_true(il_stack_head_set_name(&head, "a\xE9" "b", 3));
    assert_int_equal(il_output_to_memory(&out, &err), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&writer, out, &err), IL_OK);
    assert_int_equal(writer->stack_begin(writer, &head, &err), IL_OK);
    assert_int_equal(writer->stack_end(writer, &err), IL_OK);
    assert_int_equal(writer->end(writer, &err), IL_OK);
    assert_output(out, expected, sizeof expected - 1);
    assert_canonical(expected, sizeof expected - 1, expected, sizeof expected - 1);
    il_writer_loft.contours_free(writer);
    il_output_discard(out);
    il_stack_head_free(&head);
}

/* ---- all of them -------------------------------------------------------------------- */

typedef struct case_list {
    struct CMUnitTest *test;
    size_t n, cap;
} case_list;

static void add_case(case_list *l, const struct CMUnitTest *test)
{
    if (!il_grow(&l->test, &l->cap, l->n + 1, sizeof *l->test))
        abort();
    l->test[l->n++] = *test;
}

static int is_loft(const struct dirent *e)
{
    const char *dot = strrchr(e->d_name, '.');
    return dot && strcmp(dot, ".loft") == 0;
}

/* A case for each sample in FOLDER, called PREFIX and its name. */
static void add_samples(case_list *l, const char *folder, const char *prefix, CMUnitTestFunction function)
{
    char path[1024];
    struct dirent **entry;
    snprintf(path, sizeof path, "%s/formats/loft/%s", source_tree(), folder);
    int n = scandir(path, &entry, is_loft, alphasort);
    if (n <= 0) {
        fprintf(stderr, "no samples in %s\n", path);
        exit(1);
    }
    for (int i = 0; i < n; i++) {
        size_t size = strlen(prefix) + strlen(entry[i]->d_name) + 1;
        char *title = il_alloc(size, 1);
        if (!title)
            abort();
        snprintf(title, size, "%s%s", prefix, entry[i]->d_name);
        add_case(l, &(struct CMUnitTest){ title, function, NULL, NULL, title + strlen(prefix) });
        free(entry[i]);
    }
    free(entry);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sample_that_the_specification_names_is_there),
        cmocka_unit_test(every_invalid_sample_stands_in_the_specification),
        cmocka_unit_test(every_must_has_a_sample_that_breaks_it),
        cmocka_unit_test(every_allocation_that_fails_is_said),
        cmocka_unit_test(a_source_of_single_bytes_gives_the_same),
        cmocka_unit_test(a_locale_with_decimal_commas_changes_nothing),
        cmocka_unit_test(several_streams_follow_one_another),
        cmocka_unit_test(the_second_of_several_streams_is_named),
        cmocka_unit_test(limits_are_kept),
        cmocka_unit_test(rows_of_a_pair_are_limited_like_vertices),
        cmocka_unit_test(claimed_counts_reserve_nothing),
        cmocka_unit_test(the_user_may_say_what_the_numbers_mean),
        cmocka_unit_test(numbers_in_another_unit_were_not_projected),
        cmocka_unit_test(slices_of_one_height_are_counted),
        cmocka_unit_test(an_unknown_keyword_of_a_later_minor_names_both_versions),
        cmocka_unit_test(names_from_files_do_not_steer_the_terminal_in_errors),
        cmocka_unit_test(the_format_is_told_by_its_first_bytes),
        cmocka_unit_test(the_sink_is_called_in_order),
        cmocka_unit_test(nothing_is_called_after_a_failure),
        cmocka_unit_test(what_a_sink_finds_wrong_with_the_input_names_it),
        cmocka_unit_test(a_pair_of_unordered_slices_is_not_written),
        cmocka_unit_test(a_name_that_is_not_utf8_is_written_readably),
    };
    case_list all = { NULL, 0, 0 };
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++)
        add_case(&all, &tests[i]);
    size_t fixed = all.n;
    add_samples(&all, "valid", "", valid_sample);
    add_samples(&all, "invalid", "", invalid_sample);
    add_samples(&all, "valid", "cut_", cut_sample);
    int failed = _cmocka_run_group_tests("native", all.test, all.n, NULL, NULL);
    for (size_t i = fixed; i < all.n; i++)
        il_free((char *)all.test[i].name);
    il_free(all.test);
    return failed;
}
