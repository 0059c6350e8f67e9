#include "config.h"
#include "base/alloc.h"
#include "input/mesh-file.h"
#include "test.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- calling -------------------------------------------------------------------- */

/* Reads N bytes as a file called "x". */
static il_status read_bytes(const void *bytes, size_t n, il_mesh *m, il_mesh_file_facts *facts, il_error *err)
{
    il_source *s = NULL;
    *m = (il_mesh)IL_MESH_INIT;
    *err = (il_error)IL_ERROR_INIT;
    il_status st = il_source_from_memory(&s, bytes, n, "x", err);
    if (st == IL_OK)
        st = il_mesh_file_read(s, m, facts, err);
    il_source_close(s);
    return st;
}

static void assert_reads(const void *bytes, size_t n, const char *format, size_t vertices, size_t triangles)
{
    il_mesh m;
    il_mesh_file_facts facts;
    il_error err;
    assert_int_equal(read_bytes(bytes, n, &m, &facts, &err), IL_OK);
    assert_string_equal(facts.format, format);
    assert_int_equal(m.n_vertices, vertices);
    assert_int_equal(m.n_triangles, triangles);
    il_mesh_free(&m);
}

static void assert_refuses(const void *bytes, size_t n, const char *message)
{
    il_mesh m;
    il_mesh_file_facts facts;
    il_error err;
    char text[600];
    assert_int_equal(read_bytes(bytes, n, &m, &facts, &err), IL_E_INPUT);
    il_error_message(&err, text, sizeof text);
    assert_string_equal(text, message);
    assert_null(m.xyz);
    assert_null(m.tri);
    assert_int_equal(m.n_vertices, 0);
}

/* ---- binary STL ------------------------------------------------------------------- */

typedef struct bytes { unsigned char at[200000]; size_t n; } bytes;

static void put_u32(bytes *b, uint32_t v)
{
    for (int i = 0; i < 4; i++)
        b->at[b->n++] = (unsigned char)(v >> 8 * i);
}

static void put_f32(bytes *b, float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    put_u32(b, bits);
}

static const float tetrahedron[12][3] = {
    { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 },
    { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 0 }, { -0.0f, 0, 1 } };

/* A tetrahedron, COPIES times, promising PROMISED triangles. */
static void put_stl(bytes *b, const char *header, uint32_t promised, int copies)
{
    memset(b->at, 0, sizeof b->at);
    memcpy(b->at, header, strlen(header));
    b->n = 80;
    put_u32(b, promised);
    for (int i = 0; i < 4 * copies; i++) {
        b->n += 12;
        for (int k = 0; k < 9; k++)
            put_f32(b, tetrahedron[3 * (i % 4) + k / 3][k % 3]);
        b->n += 2;
    }
}

static void corners_at_one_place_become_one_vertex(void **state)
{
    (void)state;
    static const uint32_t expected[12] = { 0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3 };
    static bytes b;
    il_mesh m;
    il_mesh_file_facts facts;
    il_error err;
    put_stl(&b, "any header", 4, 1);
    assert_int_equal(read_bytes(b.at, b.n, &m, &facts, &err), IL_OK);
    assert_int_equal(m.n_vertices, 4);
    assert_memory_equal(m.tri, expected, sizeof expected);
    assert_true(m.xyz[3] == 0 && m.xyz[4] == 1 && m.xyz[5] == 0);
    il_mesh_free(&m);
}

static void a_binary_file_that_starts_with_solid_is_binary(void **state)
{
    (void)state;
    static bytes b;
    put_stl(&b, "solid part\n facet normal 0 0 1\n outer loop\n", 4, 1);
    assert_reads(b.at, b.n, "stl", 4, 4);
    put_stl(&b, "solid big", 3200, 800); /* more than the look-ahead */
    assert_reads(b.at, b.n, "stl", 4, 3200);
}

static void a_wrong_count_is_found_and_costs_nothing(void **state)
{
    (void)state;
    static bytes b;
    put_stl(&b, "x", 5, 1);
    assert_refuses(b.at, b.n, /* the size rule */
                   "x: neither STL nor OBJ nor PLY, or a binary STL of another length than its count says");
    put_stl(&b, "x", 4000000, 800);
    assert_refuses(b.at, b.n, "x: byte 160084: the file ends after 3200 of 4000000 triangles");
    put_stl(&b, "x", 3100, 800);
    assert_refuses(b.at, b.n, "x: byte 155084: something follows the 3100 triangles that the header promises");
    put_stl(&b, "x", 0, 0);
    assert_refuses(b.at, b.n, "x: there is no triangle in it");
}

static void a_coordinate_that_is_no_number_is_found(void **state)
{
    (void)state;
    static bytes b;
    put_stl(&b, "x", 4, 1);
    memset(b.at + 84 + 50 + 16, 0xff, 4); /* y of the second triangle's first corner */
    assert_refuses(b.at, b.n, "x: byte 150: a coordinate is not finite or not below 1e15");
}

/* ---- the samples -------------------------------------------------------------------- */

static char *slurp(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *text = malloc(1 << 20);
    *n = fread(text, 1, (1 << 20) - 1, f);
    text[*n] = '\0';
    fclose(f);
    return text;
}

/* What the sample NAME in DIR does, as the line that stands beside it. */
static void describe(const char *dir, const char *name, char *line, size_t size)
{
    char path[1000];
    il_source *s = NULL;
    il_mesh m = IL_MESH_INIT;
    il_mesh_file_facts facts = IL_MESH_FILE_FACTS_INIT;
    il_error err = IL_ERROR_INIT;
    size_t n;
    snprintf(path, sizeof path, "%s/%s", dir, name);
    char *text = slurp(path, &n);
    assert_int_equal(il_source_from_memory(&s, text, n, name, &err), IL_OK);
    if (il_mesh_file_read(s, &m, &facts, &err) == IL_OK)
        snprintf(line, size, "%s: %zu vertices, %zu triangles, %zu polygons", facts.format, m.n_vertices,
                 m.n_triangles, facts.polygons);
    else
        il_error_message(&err, line, size);
    il_mesh_free(&m);
    il_source_close(s);
    free(text);
}

static void check_folder(const char *kind, const char *suffix, size_t at_least)
{
    const char *srcdir = getenv("srcdir");
    char dir[500], path[1000], line[600];
    snprintf(dir, sizeof dir, "%s/formats/mesh/%s", srcdir ? srcdir : ".", kind);
    DIR *d = opendir(dir);
    assert_non_null(d);
    size_t seen = 0, n, k = strlen(suffix);
    for (struct dirent *e; (e = readdir(d));) {
        size_t length = strlen(e->d_name);
        if (*e->d_name == '.' || (length > k && strcmp(e->d_name + length - k, suffix) == 0))
            continue;
        snprintf(path, sizeof path, "%s/%s%s", dir, e->d_name, suffix);
        char *expected = slurp(path, &n);
        describe(dir, e->d_name, line, sizeof line);
        strcat(line, "\n");
        assert_string_equal(line, expected);
        free(expected);
        seen++;
    }
    closedir(d);
    assert_true(seen >= at_least);
}

static void valid_samples_are_read(void **state)
{
    (void)state;
    check_folder("valid", ".facts", 14);
}

static void invalid_samples_are_refused_with_their_place(void **state)
{
    (void)state;
    check_folder("invalid", ".error", 25);
}

static void what_is_no_mesh_file_is_not_taken_for_one(void **state)
{
    (void)state;
    static const char *const other[] = { "", "isoloft 1\nunit mm\nend\n", "<svg/>", "{\"type\":1}", "solid", "ply",
                                         "plywood\n", "very like an obj\n", "# only a comment\n", "f" };
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        il_source *s;
        const char *format = "unset";
        assert_int_equal(il_source_from_memory(&s, other[i], strlen(other[i]), "x", NULL), IL_OK);
        assert_int_equal(il_mesh_file_detect(s, &format, NULL), IL_OK);
        assert_null(format);
        il_source_close(s);
    }
}

/* Each allocation fails in turn; sanitizers see what is lost. */
static void running_out_of_memory_is_an_error_and_loses_nothing(void **state)
{
    (void)state;
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\n";
    static const char ply[] =
        "ply\nformat ascii 1.0\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 1 0 0 0 1 0\n3 0 1 2\n";
    static bytes stl;
    put_stl(&stl, "x", 4, 1);
    const struct { const void *at; size_t n; } c[] = {
        { obj, sizeof obj - 1 }, { ply, sizeof ply - 1 }, { stl.at, stl.n } };
    for (size_t i = 0; i < 3; i++) {
        il_status st = IL_E_NOMEM;
        long k = 0;
        for (; st != IL_OK && k < 100; k++) {
            il_mesh m;
            il_mesh_file_facts facts;
            il_error err;
            il_alloc_test_fail_after(k);
            st = read_bytes(c[i].at, c[i].n, &m, &facts, &err);
            il_alloc_test_fail_after(-1);
            assert_true(st == IL_OK || st == IL_E_NOMEM);
            il_mesh_free(&m);
        }
        assert_true(k > 5 && k < 100);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_at_one_place_become_one_vertex),
        cmocka_unit_test(a_binary_file_that_starts_with_solid_is_binary),
        cmocka_unit_test(a_wrong_count_is_found_and_costs_nothing),
        cmocka_unit_test(a_coordinate_that_is_no_number_is_found),
        cmocka_unit_test(valid_samples_are_read),
        cmocka_unit_test(invalid_samples_are_refused_with_their_place),
        cmocka_unit_test(what_is_no_mesh_file_is_not_taken_for_one),
        cmocka_unit_test(running_out_of_memory_is_an_error_and_loses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
