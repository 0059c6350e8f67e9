/* t-shp.c - shapefiles and what stands beside them: found, told, and never believed. */
#include "config.h"
#include "maps.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static map m;
static char dir[300];

/* A file of the samples, to be freed. */
static unsigned char *load_sample(const char *name, size_t *n)
{
    char path[500];
    const char *srcdir = getenv("srcdir");
    snprintf(path, sizeof path, "%s/formats/shp/valid/%s", srcdir && *srcdir ? srcdir : ".", name);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    unsigned char *data = malloc(100000);
    assert_non_null(data);
    *n = fread(data, 1, 100000, f);
    fclose(f);
    return data;
}

static const char *in_dir(const char *name)
{
    static char path[500];
    snprintf(path, sizeof path, "%s/%s", dir, name);
    return path;
}

static void put_bytes(const char *name, const void *data, size_t n)
{
    FILE *f = fopen(in_dir(name), "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(data, 1, n, f), n);
    assert_int_equal(fclose(f), 0);
}

static void put_sample(const char *sample, const char *name)
{
    size_t n;
    unsigned char *data = load_sample(sample, &n);
    put_bytes(name, data, n);
    free(data);
}

static void put_gzip(const char *sample, const char *name)
{
    size_t n;
    unsigned char *data = load_sample(sample, &n);
    gzFile f = gzopen(in_dir(name), "wb");
    assert_non_null(f);
    assert_int_equal(gzwrite(f, data, (unsigned)n), (int)n);
    assert_int_equal(gzclose(f), Z_OK);
    free(data);
}

static void empty_dir(void)
{
    static const char *const names[] = { "a.shp", "a.dbf", "a.shx", "a.prj", "a.cpg", "a.DBF", "a.SHP", "a.shp.gz", "a.dbf.gz" };
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        unlink(in_dir(names[k]));
}

/* Open NAME in the folder as the program does. */
static il_status read_path(const char *name)
{
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_source *source = NULL;
    map_free(&m);
    m.sink = (il_sink){ map_on_stack, map_on_slice, NULL, map_on_end, map_on_end };
    il_status st = il_source_open(&source, in_dir(name), &m.err);
    const il_reader *reader = NULL;
    if (st == IL_OK)
        st = il_reader_detect(source, &reader, &m.err);
    if (st == IL_OK)
        st = reader->read(&source, 1, &defaults, &m.sink, &m.report, &m.err);
    il_source_close(source);
    return st;
}

/* ---- files ---------------------------------------------------------------------- */

static void files_beside_it_are_found(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_prj.shp", "a.shp");
    put_sample("v_prj.dbf", "a.dbf");
    put_sample("v_prj.prj", "a.prj");
    assert_int_equal(read_path("a.shp"), IL_OK);
    assert_int_equal(m.n, 2);
    assert_true(m.z[0] == 100 && m.z[1] == 110);
    assert_non_null(strstr(m.crs, "made_up"));
    assert_not_noted(&m, ".dbf");
}

static void the_other_case_will_do(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_polyline.shp", "a.shp");
    put_sample("v_polyline.dbf", "a.DBF");
    assert_int_equal(read_path("a.shp"), IL_OK);
    empty_dir();
    put_sample("v_polyline.shp", "a.SHP");
    put_sample("v_polyline.dbf", "a.dbf");
    assert_int_equal(read_path("a.SHP"), IL_OK);
}

static void compressed_files_are_read(void **state)
{
    (void)state;
    empty_dir();
    put_gzip("v_polyline.shp", "a.shp.gz");
    put_sample("v_polyline.dbf", "a.dbf");
    assert_int_equal(read_path("a.shp.gz"), IL_OK);
    unlink(in_dir("a.dbf"));
    put_gzip("v_polyline.dbf", "a.dbf.gz");
    assert_int_equal(read_path("a.shp.gz"), IL_OK);
    assert_int_equal(m.n, 2);
}

static void a_missing_table_is_told(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_polyline_z.shp", "a.shp");
    assert_int_equal(read_path("a.shp"), IL_OK);
    assert_noted(&m, "no .dbf beside the .shp");
    size_t n;
    unsigned char *data = load_sample("v_polyline_z.shp", &n);
    assert_int_equal(map_read(&m, &il_reader_shp, data, n, "-", NULL), IL_OK);
    assert_noted(&m, "standard input brings a .shp without its .dbf");
    free(data);
    data = load_sample("v_polyline.shp", &n);
    assert_int_equal(map_read(&m, &il_reader_shp, data, n, "-", NULL), IL_E_INPUT);
    assert_non_null(strstr(m.err.text, "give the path of the .shp"));
    free(data);
}

static void a_table_that_cannot_be_read_is_not_passed_over(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_polyline_z.shp", "a.shp");
    assert_int_equal(mkdir(in_dir("a.dbf"), 0700), 0);
    assert_int_equal(read_path("a.shp"), IL_E_IO);
    assert_non_null(strstr(m.err.file, "a.dbf"));
    assert_int_equal(rmdir(in_dir("a.dbf")), 0);
    put_bytes("a.dbf", "\x1f\x8b\x08 no gzip", 11);
    assert_int_equal(read_path("a.shp"), IL_E_INPUT);
    assert_non_null(strstr(m.err.file, "a.dbf"));
}

static void one_of_the_other_files_is_refused(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_prj.shp", "a.shp");
    put_sample("v_prj.dbf", "a.dbf");
    put_sample("v_prj.prj", "a.prj");
    put_sample("v_polyline.shx", "a.shx");
    put_sample("v_polyline.dbf", "a.DBF");
    static const char *const names[] = { "a.dbf", "a.prj", "a.shx", "a.DBF" };
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        assert_int_equal(read_path(names[k]), IL_E_INPUT);
        assert_non_null(strstr(m.err.text, "give its .shp alone"));
    }
}

/* ---- reports ---------------------------------------------------------------------- */

static void read_sample(const char *name)
{
    char path[500];
    size_t n;
    const char *srcdir = getenv("srcdir");
    unsigned char *data = load_sample(name, &n);
    snprintf(path, sizeof path, "%s/formats/shp/valid/%s", srcdir && *srcdir ? srcdir : ".", name);
    assert_int_equal(map_read(&m, &il_reader_shp, data, n, path, NULL), IL_OK);
    free(data);
}

static void what_is_left_out_is_counted(void **state)
{
    (void)state;
    read_sample("v_null_shape.shp");
    assert_skipped(&m, 1, "shape", "is a null shape", 0);
    assert_true(m.n == 2 && m.line[0].feature == 1 && m.line[1].feature == 3);
    read_sample("v_deleted_row.shp");
    assert_skipped(&m, 1, "shape", "its row in the .dbf is deleted", 0);
    read_sample("v_multipatch.shp");
    assert_skipped(&m, 1, "MultiPatch", "is a surface, no line", 0);
    read_sample("v_no_points.shp");
    assert_skipped(&m, 1, "shape", "has no points", 0);
    read_sample("v_points_z.shp");
    assert_skipped(&m, 1, "point", "a point by itself is no isoline", 0);
    assert_noted(&m, "spot heights: 3");
    read_sample("v_points_z_0.shp");
    assert_skipped(&m, 3, "point", "a point by itself is no isoline", 0);
    read_sample("v_points.shp");
    assert_noted(&m, "spot heights: 3");
    assert_noted(&m, "with the same height, count once: 1");
    read_sample("v_bytes_behind_end.shp");
    assert_noted(&m, "50 bytes behind the end");
    read_sample("v_code_page_unknown.shp");
    assert_noted(&m, "the code page 'EBCDIC' of the .cpg is not known");
    assert_int_equal(m.report.n_skipped, 0);
}

/* ---- robustness --------------------------------------------------------------------- */

/* Every byte of every file replaced in turn: nothing is read beyond what is there,
 * which sanitizers see, and what is refused is refused with a sentence. */
static void no_byte_is_believed(void **state)
{
    static const char *const files[] = { "a.shp", "a.dbf", "a.shx" };
    static const char *const samples[] = { "v_polyline.shp", "v_polyline.dbf", "v_polyline.shx" };
    static const unsigned char bytes[] = { 0x00, 0x01, 0x7F, 0x80, 0xFF };
    (void)state;
    empty_dir();
    for (size_t k = 0; k < 3; k++)
        put_sample(samples[k], files[k]);
    for (size_t k = 0; k < 3; k++) {
        size_t n;
        unsigned char *data = load_sample(samples[k], &n);
        for (size_t i = 0; i < n; i++) {
            unsigned char was = data[i];
            data[i] = bytes[i % sizeof bytes];
            put_bytes(files[k], data, n);
            il_status st = read_path("a.shp");
            assert_true(st == IL_OK || (st == IL_E_INPUT && m.err.text[0]));
            data[i] = was;
        }
        put_bytes(files[k], data, n);
        free(data);
    }
}

static void every_failing_allocation_is_told(void **state)
{
    (void)state;
    empty_dir();
    put_sample("v_code_page.shp", "a.shp");
    put_sample("v_code_page.dbf", "a.dbf");
    put_sample("v_code_page.cpg", "a.cpg");
    put_sample("v_prj.prj", "a.prj");
    long k = 0;
    il_status st;
    do {
        il_alloc_test_fail_after(k++);
        st = read_path("a.shp");
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
    } while (st != IL_OK && k < 10000);
    assert_int_equal(st, IL_OK);
    assert_true(k > 20);
}

static int setup(void **state)
{
    const char *tmp = getenv("TMPDIR");
    (void)state;
    snprintf(dir, sizeof dir, "%s/t-shp.XXXXXX", tmp ? tmp : "/tmp");
    return mkdtemp(dir) ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    map_free(&m);
    empty_dir();
    return rmdir(dir);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_beside_it_are_found),
        cmocka_unit_test(the_other_case_will_do),
        cmocka_unit_test(compressed_files_are_read),
        cmocka_unit_test(a_missing_table_is_told),
        cmocka_unit_test(a_table_that_cannot_be_read_is_not_passed_over),
        cmocka_unit_test(one_of_the_other_files_is_refused),
        cmocka_unit_test(what_is_left_out_is_counted),
        cmocka_unit_test(no_byte_is_believed),
        cmocka_unit_test(every_failing_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
