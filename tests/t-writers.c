#include "config.h"
#include "meshes.h"
#include "output/mesh-spool.h"

#include <math.h>
#include <signal.h>
#include <sys/resource.h>

/* ---- exact bytes ---------------------------------------------------------- */

static void assert_bytes(il_output *o, const void *expected, size_t n)
{
    size_t got;
    const unsigned char *data = il_output_memory(o, &got);
    assert_int_equal(got, n);
    assert_memory_equal(data, expected, n);
    il_output_discard(o);
}

static size_t from_hex(unsigned char *to, const char *hex)
{
    size_t n = 0;
    for (; hex[2 * n]; n++) {
        unsigned v;
        assert_int_equal(sscanf(hex + 2 * n, "%2x", &v), 1);
        to[n] = (unsigned char)v;
    }
    return n;
}

static il_output *tetrahedron_as(const il_writer *w)
{
    il_output *o;
    il_mesh_sink *s = started(w, &o);
    il_stack_head h = head_called("Left ear");
    set_color(&h, 255, 128, 0);
    assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
    il_stack_head_free(&h);
    finished(w, s, o);
    return o;
}

static void binary_stl_has_these_bytes(void **state)
{
    (void)state;
    static const char hex[] =
        "040000000000000000000000000080bf000000000000000000000000000000000000803f000000000000803f00000000"
        "00000000000000000000000080bf000000000000000000000000000000000000803f0000000000000000000000000000"
        "00000000803f0000000080bf000000000000000000000000000000000000000000000000000000000000803f00000000"
        "0000803f0000000000003acd133f3acd133f3acd133f0000803f0000000000000000000000000000803f000000000000"
        "0000000000000000803f0000";
    unsigned char expected[300] = "STL isoloft Left ear";
    size_t n = 80 + from_hex(expected + 80, hex);
    assert_int_equal(n, 80 + 4 + 4 * 50);
    assert_bytes(tetrahedron_as(&il_writer_stl), expected, n);
}

static void ascii_stl_has_these_bytes(void **state)
{
    (void)state;
    assert_text(tetrahedron_as(&il_writer_stl_ascii),
                "solid Left_ear\n"
                "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
                "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
                "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
                "facet normal 0.57735026 0.57735026 0.57735026\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n"
                "endloop\nendfacet\n"
                "endsolid Left_ear\n");
}

static void obj_on_a_stream_has_these_bytes(void **state)
{
    (void)state;
    assert_text(tetrahedron_as(&il_writer_obj),
                "# isoloft\n"
                "# stack 0 vertices 4 triangles 4 unit mm color 255 128 0 name Left ear\n"
                "o Left_ear\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                "g Left_ear\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
}

/* The tetrahedron with its last two triangles in the next slab. */
static il_output *two_slabs_as(const il_writer *w)
{
    il_output *o;
    il_mesh_sink *s = started(w, &o);
    il_stack_head h = head_called("Left ear");
    set_color(&h, 255, 128, 0);
    double xyz[12] = { -0.0, 0, 0, 1, 0, -0.0, 0, 1, 0, 0, 0, 1 };
    il_origin origin[4] = { { 0, 0, 0, 0 }, { 0, 0, 0, 1 }, { 0, 0, 0, 2 }, { -1, 1, -1, -1 } };
    uint32_t tri[12] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
    il_mesh one = { .xyz = xyz, .n_vertices = 4, .origin = origin, .tri = tri, .n_triangles = 2, .slab = 0 };
    il_mesh two = { .tri = tri + 6, .n_triangles = 2, .slab = 1 };
    assert_int_equal(s->begin(s, &h, NULL), IL_OK);
    assert_int_equal(s->piece(s, &one, NULL), IL_OK);
    assert_int_equal(s->piece(s, &two, NULL), IL_OK);
    assert_int_equal(s->end(s, &no_facts, NULL), IL_OK);
    il_stack_head_free(&h);
    finished(w, s, o);
    return o;
}

#define PLY_HEADER(encoding) \
    "ply\nformat " encoding " 1.0\ncomment isoloft\n" \
    "comment stack 0 vertices 4 triangles 4 unit mm color 255 128 0 name Left ear\n" \
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n" \
    "property uchar red\nproperty uchar green\nproperty uchar blue\n" \
    "property int stack\nproperty int slice\nproperty int ring\nproperty int vertex\n" \
    "element face 4\nproperty list uchar int vertex_indices\n" \
    "element face_origin 4\nproperty int slab\nend_header\n"

static void binary_ply_has_these_bytes(void **state)
{
    (void)state;
    static const char hex[] =
        "000000000000000000000000000000000000000000000000ff8000000000000000000000000000000000000000000000"
        "00f03f00000000000000000000000000000000ff80000000000000000000000000000100000000000000000000000000"
        "00000000f03f0000000000000000ff800000000000000000000000000002000000000000000000000000000000000000"
        "00000000000000f03fff8000ffffffff01000000ffffffffffffffff0300000000020000000100000003000000000100"
        "000003000000030000000003000000020000000301000000020000000300000000000000000000000100000001000000";
    unsigned char expected[1000] = PLY_HEADER("binary_little_endian");
    size_t n = strlen((const char *)expected);
    n += from_hex(expected + n, hex);
    assert_bytes(two_slabs_as(&il_writer_ply), expected, n);
}

static void ascii_ply_has_these_bytes(void **state)
{
    (void)state;
    assert_text(two_slabs_as(&il_writer_ply_ascii),
                PLY_HEADER("ascii")
                "0 0 0 255 128 0 0 0 0 0\n1 0 0 255 128 0 0 0 0 1\n"
                "0 1 0 255 128 0 0 0 0 2\n0 0 1 255 128 0 -1 1 -1 -1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n0\n0\n1\n1\n");
}

/* ---- reading back --------------------------------------------------------- */

/* A mesh as a reader that knows nothing of the writers sees it. */
typedef struct soup {
    double *xyz;
    size_t *corner;
    size_t n_vertices, n_triangles;
} soup;

static void soup_free(soup *m)
{
    free(m->xyz);
    free(m->corner);
}

static void soup_make(soup *m, size_t vertices, size_t triangles)
{
    *m = (soup){ calloc(vertices, 3 * sizeof(double)), calloc(triangles, 3 * sizeof(size_t)), vertices, triangles };
}

static uint32_t u32_at(const unsigned char *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static double f64_at(const unsigned char *p)
{
    uint64_t bits = u32_at(p) | (uint64_t)u32_at(p + 4) << 32;
    double d;
    memcpy(&d, &bits, sizeof d);
    return d;
}

static double f32_at(const unsigned char *p)
{
    uint32_t bits = u32_at(p);
    float f;
    memcpy(&f, &bits, sizeof f);
    return (double)f;
}

static void read_binary_stl(const unsigned char *p, size_t n, soup *m)
{
    size_t triangles = u32_at(p + 80);
    assert_int_equal(n, 84 + 50 * triangles);
    soup_make(m, 3 * triangles, triangles);
    for (size_t t = 0; t < triangles; t++) {
        const unsigned char *f = p + 84 + 50 * t;
        for (size_t i = 0; i < 9; i++)
            m->xyz[9 * t + i] = f32_at(f + 12 + 4 * i);
        for (size_t i = 0; i < 3; i++)
            m->corner[3 * t + i] = 3 * t + i;
        assert_int_equal(f[48] | f[49], 0);
    }
}

static void read_binary_ply(const unsigned char *p, size_t n, soup *m)
{
    const char *head = (const char *)p, *end = strstr(head, "\nend_header\n") + 12;
    size_t vertices, triangles, size = strstr(head, "\nproperty uchar red") ? 43 : 40;
    assert_int_equal(sscanf(strstr(head, "\nelement vertex"), "\nelement vertex %zu", &vertices), 1);
    assert_int_equal(sscanf(strstr(head, "\nelement face"), "\nelement face %zu", &triangles), 1);
    assert_int_equal(n, (size_t)(end - head) + size * vertices + 13 * triangles + 4 * triangles);
    soup_make(m, vertices, triangles);
    p = (const unsigned char *)end;
    for (size_t v = 0; v < vertices; v++, p += size)
        for (size_t i = 0; i < 3; i++)
            m->xyz[3 * v + i] = f64_at(p + 8 * i);
    for (size_t t = 0; t < triangles; t++, p += 13)
        for (size_t i = 0; i < 3; i++)
            m->corner[3 * t + i] = u32_at(p + 1 + 4 * i);
}

static void read_obj(const char *text, soup *m)
{
    size_t vertices = 0, triangles = 0;
    for (const char *l = text; l; l = strchr(l, '\n') ? strchr(l, '\n') + 1 : NULL)
        vertices += strncmp(l, "v ", 2) == 0, triangles += strncmp(l, "f ", 2) == 0;
    soup_make(m, vertices, triangles);
    double *x = m->xyz;
    size_t *c = m->corner;
    for (const char *l = text; l; l = strchr(l, '\n') ? strchr(l, '\n') + 1 : NULL) {
        if (sscanf(l, "v %lf %lf %lf", x, x + 1, x + 2) == 3)
            x += 3;
        if (sscanf(l, "f %zu %zu %zu", c, c + 1, c + 2) == 3)
            c += 3;
    }
    for (size_t i = 0; i < 3 * triangles; i++)
        m->corner[i]--;
}

static void read_output(const il_writer *w, il_output *o, soup *m)
{
    size_t n;
    const unsigned char *data = il_output_memory(o, &n);
    char *text = il_strndup((const char *)data, n);
    if (w == &il_writer_stl)
        read_binary_stl((unsigned char *)text, n, m);
    else if (w == &il_writer_ply)
        read_binary_ply((unsigned char *)text, n, m);
    else
        read_obj(text, m);
    il_free(text);
    il_output_discard(o);
}

static double volume(const soup *m)
{
    double sum = 0;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *a = m->xyz + 3 * m->corner[3 * t], *b = m->xyz + 3 * m->corner[3 * t + 1];
        const double *c = m->xyz + 3 * m->corner[3 * t + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]);
        sum += a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
}

static const il_writer *const parsed[] = { &il_writer_stl, &il_writer_ply, &il_writer_obj };

static void several_stacks_share_a_file(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        il_output *o;
        il_mesh_sink *s = started(parsed[i], &o);
        il_stack_head a = head_called("a"), b = head_called("b");
        set_color(&b, 1, 2, 3);
        assert_int_equal(send_whole(s, &a, 0, 0, NULL), IL_OK);
        assert_int_equal(send_whole(s, &b, 5, 1, NULL), IL_OK);
        finished(parsed[i], s, o);
        soup m;
        read_output(parsed[i], o, &m);
        assert_int_equal(m.n_triangles, 8);
        assert_true(fabs(volume(&m) - 2.0 / 6) < 1e-15);
        for (size_t t = 0; t < 8; t++)
            for (size_t k = 0; k < 3; k++) {
                double x = m.xyz[3 * m.corner[3 * t + k]];
                assert_true(t < 4 ? x <= 1 : x >= 5); /* each triangle has its own stack's corners */
            }
        soup_free(&m);
        il_stack_head_free(&a);
        il_stack_head_free(&b);
    }
}

static void an_abandoned_stack_leaves_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < N_WRITERS; i++) {
        const il_writer *w = mesh_writers[i];
        il_output *with, *without;
        il_mesh_sink *s = started(w, &with), *t = started(w, &without);
        il_stack_head a = head_called("a"), b = head_called("bad"), c = head_called("c");
        set_color(&b, 9, 9, 9);
        assert_int_equal(send_tetrahedron(s, &b, 7, 0, NULL), IL_OK);
        s->abandon(s);
        assert_int_equal(send_whole(s, &a, 0, 1, NULL), IL_OK);
        assert_int_equal(send_tetrahedron(s, &b, 7, 2, NULL), IL_OK);
        s->abandon(s);
        s->abandon(s); /* nothing is open: nothing happens */
        assert_int_equal(send_whole(s, &c, 3, 3, NULL), IL_OK);
        finished(w, s, with);
        assert_int_equal(send_whole(t, &a, 0, 1, NULL), IL_OK);
        assert_int_equal(send_whole(t, &c, 3, 3, NULL), IL_OK);
        finished(w, t, without);
        size_t n;
        const unsigned char *data = il_output_memory(without, &n);
        assert_true(n > 200);
        assert_bytes(with, data, n);
        il_output_discard(without);
        il_stack_head_free(&a);
        il_stack_head_free(&b);
        il_stack_head_free(&c);
    }
}

/* ---- large meshes --------------------------------------------------------- */

enum { MANY_VERTICES = 300000, MANY_TRIANGLES = 100000, PIECES = 10 };

static uint32_t next_random(uint64_t *s) /* splitmix64 (Steele, Lea & Flood 2014) */
{
    uint64_t z = (*s += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return (uint32_t)(z ^ z >> 31);
}

/* Triangles between vertices of all pieces so far, near and far: more positions
 * than are kept at once.  CORNER gets what the file must say. */
static il_status send_many(il_mesh_sink *s, double *corner, il_error *err)
{
    enum { V = MANY_VERTICES / PIECES, T = MANY_TRIANGLES / PIECES };
    uint64_t seed = 7;
    il_stack_head h = head_called("many");
    double *xyz = calloc(MANY_VERTICES, 3 * sizeof *xyz);
    il_origin *origin = calloc(V, sizeof *origin);
    uint32_t *tri = calloc(T, 3 * sizeof *tri);
    il_status st = s->begin(s, &h, err);
    for (uint32_t p = 0; p < PIECES && st == IL_OK; p++) {
        for (size_t i = 0; i < 3 * V; i++)
            xyz[3 * V * p + i] = (double)(next_random(&seed) >> 8) - 8388608;
        for (uint32_t i = 0; i < 3 * T; i++) {
            uint32_t far = next_random(&seed) % (V * (p + 1)), near = V * p + i / 3 % V;
            tri[i] = i % 3 == 0 ? far : near;
            memcpy(corner + 3 * (3 * T * p + i), xyz + 3 * tri[i], 3 * sizeof *xyz);
        }
        il_mesh m = { .xyz = xyz + 3 * V * p, .n_vertices = V, .origin = origin, .tri = tri, .n_triangles = T,
                      .slab = (int32_t)p };
        st = s->piece(s, &m, err);
    }
    if (st == IL_OK)
        st = s->end(s, &no_facts, err);
    free(xyz);
    free(origin);
    free(tri);
    il_stack_head_free(&h);
    return st;
}

static void corners_of_large_meshes_are_found_again(void **state)
{
    (void)state;
    double *corner = calloc(3 * MANY_TRIANGLES, 3 * sizeof *corner);
    for (size_t i = 0; i < 2; i++) { /* STL: in any order; PLY: in order */
        il_output *o;
        il_mesh_sink *s = started(parsed[i], &o);
        assert_int_equal(send_many(s, corner, NULL), IL_OK);
        finished(parsed[i], s, o);
        soup m;
        read_output(parsed[i], o, &m);
        assert_int_equal(m.n_triangles, MANY_TRIANGLES);
        for (size_t k = 0; k < 3 * MANY_TRIANGLES; k++)
            if (memcmp(m.xyz + 3 * m.corner[k], corner + 3 * k, 3 * sizeof *corner) != 0)
                fail_msg("corner %zu", k);
        soup_free(&m);
    }
    free(corner);
}

/* ---- limits --------------------------------------------------------------- */

static void counts_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    static const struct { const il_writer *w; uint64_t vertices, triangles; } c[] = {
        { &il_writer_stl, 4, UINT64_C(1) << 32 }, { &il_writer_ply, UINT64_C(1) << 31, 4 },
        { &il_writer_ply_ascii, UINT64_C(1) << 31, 4 } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_output *o;
        il_mesh_sink *s = started(c[i].w, &o);
        il_stack_head h = head_called("huge");
        il_error err = IL_ERROR_INIT;
        assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
        il_mesh_spool *m = (il_mesh_spool *)s;
        m->stack[0].n_vertices = c[i].vertices; /* as if so many had come */
        m->stack[0].n_triangles = c[i].triangles;
        assert_int_equal(s->finish(s, &err), IL_E_INPUT);
        assert_non_null(strstr(err.text, "are more than"));
        assert_int_equal(il_output_bytes(o), 0);
        c[i].w->mesh_free(s);
        il_output_discard(o);
        il_stack_head_free(&h);
    }
}

static void an_index_that_was_never_given_is_refused(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_ply, &o);
    il_stack_head h = head_called("a");
    uint32_t tri[3] = { 0, 1, 4 };
    il_mesh bad = { .tri = tri, .n_triangles = 1 };
    assert_int_equal(send_tetrahedron(s, &h, 0, 0, NULL), IL_OK);
    assert_int_equal(s->piece(s, &bad, NULL), IL_E_INTERNAL);
    s->abandon(s);
    finished(&il_writer_ply, s, o);
    il_output_discard(o);
    il_stack_head_free(&h);
}

static void calls_out_of_order_are_refused(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_obj, &o);
    il_stack_head h = head_called("a");
    il_mesh nothing = IL_MESH_INIT;
    assert_int_equal(s->piece(s, &nothing, NULL), IL_E_INTERNAL);
    assert_int_equal(s->end(s, &no_facts, NULL), IL_E_INTERNAL);
    assert_int_equal(s->begin(s, &h, NULL), IL_OK);
    assert_int_equal(s->begin(s, &h, NULL), IL_E_INTERNAL);
    assert_int_equal(s->finish(s, NULL), IL_E_INTERNAL);
    assert_int_equal(il_output_bytes(o), 0);
    il_writer_obj.mesh_free(s);
    il_writer_obj.mesh_free(NULL);
    il_output_discard(o);
    il_stack_head_free(&h);
}

static void stl_refuses_what_no_float_can_hold(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        il_output *o;
        il_mesh_sink *s = started(mesh_writers[i], &o);
        il_stack_head h = head_called("far");
        il_error err = IL_ERROR_INIT;
        assert_int_equal(send_whole(s, &h, 1e39, 0, NULL), IL_OK);
        assert_int_equal(s->finish(s, &err), IL_E_INPUT);
        assert_string_equal(err.text, "stack 'far' is too large for the 32-bit numbers of STL");
        mesh_writers[i]->mesh_free(s);
        il_output_discard(o);
        il_stack_head_free(&h);
    }
}

static void a_triangle_without_area_has_normal_zero(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_stl_ascii, &o);
    il_stack_head h = head_called("");
    double xyz[9] = { 0, 0, 0, 1, 1, 1, 2, 2, 2 };
    il_origin origin[3] = { { 0, 0, 0, 0 } };
    uint32_t tri[3] = { 0, 1, 2 };
    il_mesh flat = { .xyz = xyz, .n_vertices = 3, .origin = origin, .tri = tri, .n_triangles = 1 };
    assert_int_equal(s->begin(s, &h, NULL), IL_OK);
    assert_int_equal(s->piece(s, &flat, NULL), IL_OK);
    assert_int_equal(s->end(s, &no_facts, NULL), IL_OK);
    finished(&il_writer_stl_ascii, s, o);
    assert_text(o, "solid stack\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 1 1\nvertex 2 2 2\nendloop\n"
                   "endfacet\nendsolid stack\n");
    il_stack_head_free(&h);
}

/* -1e-60 becomes -0 as a float, and the cross product has one in x. */
static void no_number_of_binary_stl_is_minus_zero(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_stl, &o);
    il_stack_head h = head_called("");
    double xyz[9] = { 0, 0, 0, 1, -1, -1e-60, 0, 1, 0 };
    il_origin origin[3] = { { 0, 0, 0, 0 } };
    uint32_t tri[3] = { 0, 1, 2 };
    il_mesh one = { .xyz = xyz, .n_vertices = 3, .origin = origin, .tri = tri, .n_triangles = 1 };
    assert_int_equal(s->begin(s, &h, NULL), IL_OK);
    assert_int_equal(s->piece(s, &one, NULL), IL_OK);
    assert_int_equal(s->end(s, &no_facts, NULL), IL_OK);
    finished(&il_writer_stl, s, o);
    size_t n;
    const unsigned char *data = il_output_memory(o, &n);
    assert_int_equal(n, 84 + 50);
    for (size_t i = 0; i < 12; i++)
        assert_int_not_equal(u32_at(data + 84 + 4 * i), UINT32_C(1) << 31);
    il_output_discard(o);
    il_stack_head_free(&h);
}

static void a_header_gives_no_commands(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_stl, &o);
    il_stack_head h = head_called("COLOR=abcd\033");
    assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
    finished(&il_writer_stl, s, o);
    size_t n;
    assert_memory_equal(il_output_memory(o, &n), "STL isoloft COLOR_abcd\\x1b\0", 27);
    il_output_discard(o);
    il_stack_head_free(&h);
}

/* ---- frames --------------------------------------------------------------- */

static void a_frame_places_the_mesh_and_keeps_it_outward(void **state)
{
    (void)state;
    static const double frames[][12] = {
        { 10, 20, 30, 0, 1, 0, 0, 0, 1, 1, 0, 0 },  /* axes changed in a circle */
        { 10, 20, 30, 0, 1, 0, 1, 0, 0, 0, 0, 1 } };/* x and y exchanged: left-handed */
    for (size_t f = 0; f < 2; f++) {
        for (size_t i = 0; i < 3; i++) {
            il_output *o;
            il_mesh_sink *s = started(parsed[i], &o);
            il_stack_head h = head_called("a");
            h.has_frame = true;
            memcpy(h.frame, frames[f], sizeof h.frame);
            assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
            finished(parsed[i], s, o);
            soup m;
            read_output(parsed[i], o, &m);
            double least[3] = { 99, 99, 99 };
            for (size_t v = 0; v < m.n_vertices; v++)
                for (size_t k = 0; k < 3; k++)
                    least[k] = fmin(least[k], m.xyz[3 * v + k]);
            assert_true(least[0] == 10 && least[1] == 20 && least[2] == 30);
            assert_true(fabs(volume(&m) - 1.0 / 6) < 1e-10);
            soup_free(&m);
            il_stack_head_free(&h);
        }
    }
}

static void a_frame_beyond_all_numbers_is_refused(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_ply, &o);
    il_stack_head h = head_called("a");
    h.has_frame = true;
    h.frame[3] = 1e308;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(send_tetrahedron(s, &h, 1e10, 0, &err), IL_E_INPUT);
    s->abandon(s);
    finished(&il_writer_ply, s, o);
    il_output_discard(o);
    il_stack_head_free(&h);
}

/* ---- names ---------------------------------------------------------------- */

static const char *const hostile[] = {
    "../../etc/passwd", "-rf", "two words\nendsolid x\nfacet", "\033[2J\r", "COLOR=\1\2\3\4",
    "end_header\nelement vertex 0",
    "solid", "back\\", "%s%n", "", "h\xc3\xb6he \xff\xfe", "a b", "a_b", "a\tb",
    ("xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"
    "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx") };
enum { N_HOSTILE = sizeof hostile / sizeof *hostile };

/* Every line of TEXT starts with one of the words and holds no control character. */
static void assert_lines_start_with(const char *text, const char *const *word, size_t n_words)
{
    for (const char *l = text; *l; l = strchr(l, '\n') + 1) {
        bool known = false;
        for (size_t i = 0; i < n_words; i++)
            known = known || strncmp(l, word[i], strlen(word[i])) == 0;
        if (!known)
            fail_msg("a line that should not be: %.60s", l);
        for (const char *c = l; *c != '\n'; c++)
            assert_true((unsigned char)*c >= 0x20 && *c != 0x7f);
    }
}

static void hostile_names_break_no_format(void **state)
{
    (void)state;
    static const char *const stl[] = { "solid ", "facet normal ", "outer loop\n", "vertex ",
                                       "endloop\n", "endfacet\n", "endsolid " };
    static const char *const obj[] = { "# ", "o ", "g ", "v ", "f " };
    static const char *const ply[] = { "ply\n", "format ", "comment ", "element ", "property ", "end_header\n",
                                       "0 ", "1 ", "3 ", "0\n" };
    for (size_t i = 0; i < N_WRITERS; i++) {
        const il_writer *w = mesh_writers[i];
        il_output *o;
        il_mesh_sink *s = started(w, &o);
        for (size_t k = 0; k < N_HOSTILE; k++) {
            il_stack_head h = head_called(hostile[k]);
            h.crs = il_strndup(hostile[k], strlen(hostile[k]));
            assert_int_equal(send_whole(s, &h, 0, (int32_t)k, NULL), IL_OK);
            il_stack_head_free(&h);
        }
        finished(w, s, o);
        size_t n;
        const unsigned char *data = il_output_memory(o, &n);
        char *text = il_strndup((const char *)data, n);
        if (w == &il_writer_stl) {
            assert_int_equal(n, 84 + 50 * 4 * N_HOSTILE);
            assert_int_equal(strncmp(text, "STL isoloft ", 12), 0);
            assert_null(memchr(text, '=', 80));
            assert_null(memchr(text, '\033', 80));
        } else if (w == &il_writer_stl_ascii) {
            assert_lines_start_with(text, stl, sizeof stl / sizeof *stl);
        } else if (w == &il_writer_obj) {
            assert_lines_start_with(text, obj, sizeof obj / sizeof *obj);
            assert_null(strstr(text, "\\\n"));
        } else if (w == &il_writer_ply_ascii) {
            assert_lines_start_with(text, ply, sizeof ply / sizeof *ply);
        } else {
            soup m;
            read_binary_ply((unsigned char *)text, n, &m);
            assert_int_equal(m.n_triangles, 4 * N_HOSTILE);
            soup_free(&m);
        }
        il_free(text);
        il_output_discard(o);
    }
}

static void a_binary_header_is_80_bytes_whatever_the_names(void **state)
{
    (void)state;
    for (size_t length = 0; length < 100; length++) {
        char name[101];
        memset(name, 'n', sizeof name);
        name[length] = '\0';
        il_output *o;
        il_mesh_sink *s = started(&il_writer_stl, &o);
        il_stack_head h = head_called(name);
        assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
        assert_int_equal(send_whole(s, &h, 0, 1, NULL), IL_OK);
        finished(&il_writer_stl, s, o);
        size_t n;
        const unsigned char *data = il_output_memory(o, &n);
        assert_int_equal(n, 84 + 8 * 50);
        assert_int_equal(u32_at(data + 80), 8);
        il_output_discard(o);
        il_stack_head_free(&h);
    }
}

/* ---- where a map's mesh was put --------------------------------------------- */

static il_output *placed_as(const il_writer *w, const char *name, const il_placement *p)
{
    il_output *o;
    il_mesh_sink *s = started(w, &o);
    il_stack_head h = head_called(name);
    h.has_placement = true;
    h.placement = *p;
    assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
    finished(w, s, o);
    il_stack_head_free(&h);
    return o;
}

static void comments_tell_the_way_back_to_the_map(void **state)
{
    (void)state;
    const il_placement p = { { 175250, -0.01, 82 }, { 53.5, 53.5, 26.75 }, IL_UNIT_FT };
    static const il_writer *const w[] = { &il_writer_obj, &il_writer_ply, &il_writer_ply_ascii };
    for (size_t k = 0; k < sizeof w / sizeof *w; k++) {
        il_output *o = placed_as(w[k], "hill", &p);
        assert_true(output_contains(o, k == 0 ? "\n# stack 0 offset 175250 -0.01 82\n" : "\ncomment stack 0 offset 175250 -0.01 82\n"));
        assert_true(output_contains(o, " stack 0 scale 53.5 53.5 26.75\n"));
        assert_true(output_contains(o, " stack 0 a vertex times scale plus offset is its place on the map, in ft\n"));
        il_output_discard(o);
    }
}

static void the_header_of_stl_tells_whole_numbers_of_it(void **state)
{
    (void)state;
    static const struct { const char *name; il_placement p; const char *header; } c[] = {
        { "hill", { { 175250, 435001, 82 }, { 1, 1, 1 }, IL_UNIT_M }, "STL isoloft offset 175250 435001 82 hill" },
        { "", { { 0, 435001, 0 }, { 53.5, 53.5, 53.5 }, IL_UNIT_M }, "STL isoloft offset 0 435001 0 scale 53.5" },
        { "a hill", { { 1, 2, 3 }, { 1, 1, 0.5 }, IL_UNIT_M }, "STL isoloft offset 1 2 3 scale 1 z 0.5 a hill" },
        { "hill", { { 175250.125, 435001.125, 82.125 }, { 53.333333333333336, 53.333333333333336, 26.666666666666668 }, IL_UNIT_M },
          "STL isoloft offset 175250.125 435001.125 82.125 hill" },
        { "hill", { { -1.2345678901234567e-100, -1.2345678901234567e-101, -1.2345678901234567e-102 }, { 2, 2, 2 }, IL_UNIT_M },
          "STL isoloft hill" } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_output *o = placed_as(&il_writer_stl, c[k].name, &c[k].p);
        size_t n;
        const unsigned char *data = il_output_memory(o, &n);
        char header[81] = "";
        memcpy(header, data, 80);
        assert_string_equal(header, c[k].header);
        assert_int_equal(n, 84 + 4 * 50);
        il_output_discard(o);
    }
}

/* ---- options -------------------------------------------------------------- */

static void comments_stand_where_there_is_room(void **state)
{
    (void)state;
    static const char *const lines[] = { "isoloft --cap dome", "evil\nend_header", NULL };
    const il_write_options options = { .comment = lines, .groups_by_slab = true };
    static const struct { const il_writer *w; const char *first, *second; } c[] = {
        { &il_writer_obj, "\n# isoloft --cap dome\n", "\n# evil\\x0aend_header\n" },
        { &il_writer_ply, "\ncomment isoloft --cap dome\n", "\ncomment evil\\x0aend_header\n" } };
    for (size_t i = 0; i < 2; i++) {
        il_output *o;
        il_mesh_sink *s;
        il_stack_head h = head_called("a");
        assert_int_equal(il_output_to_memory(&o, NULL), IL_OK);
        assert_int_equal(c[i].w->mesh_new(&s, o, &options, NULL), IL_OK);
        assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
        finished(c[i].w, s, o);
        assert_true(output_contains(o, c[i].first));
        assert_true(output_contains(o, c[i].second));
        if (c[i].w == &il_writer_obj)
            assert_true(output_contains(o, "\ng a_slab0\nf 1 3 2\n"));
        il_output_discard(o);
        il_stack_head_free(&h);
    }
}

/* ---- full disks and memory ------------------------------------------------ */

/* So that only the pieces can tell. */
static il_status forgiving_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)self, (void)facts, (void)err;
    return IL_OK;
}

static void a_full_disk_under_the_spool_is_told_by_the_piece(void **state)
{
    (void)state;
    struct rlimit before, less;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    less = before;
    less.rlim_cur = 1000000;
    signal(SIGXFSZ, SIG_IGN);
    double *corner = calloc(3 * MANY_TRIANGLES, 3 * sizeof *corner);
    il_output *o;
    il_error err = IL_ERROR_INIT, later = IL_ERROR_INIT;
    il_mesh_sink *s = started(&il_writer_stl, &o);
    s->end = forgiving_end;
    setrlimit(RLIMIT_FSIZE, &less);
    il_status st = send_many(s, corner, &err);
    s->abandon(s);
    il_status finish = s->finish(s, &later);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.text, "cannot write: File too large");
    assert_int_equal(finish, IL_E_IO); /* the spool is beyond trust */
    assert_int_equal(il_output_bytes(o), 0);
    il_writer_stl.mesh_free(s);
    il_output_discard(o);
    free(corner);
}

static void a_full_disk_under_the_output_is_told(void **state)
{
    (void)state;
    double *corner = calloc(3 * MANY_TRIANGLES, 3 * sizeof *corner);
    for (size_t i = 0; i < N_WRITERS; i++) {
        for (int many = 0; many < 2; many++) { /* within the buffer: told by commit; beyond: by finish */
            il_output *o;
            il_mesh_sink *s;
            il_stack_head h = head_called("a");
            il_error err = IL_ERROR_INIT;
            assert_int_equal(il_output_open(&o, "/dev/full", NULL), IL_OK);
            assert_int_equal(mesh_writers[i]->mesh_new(&s, o, NULL, NULL), IL_OK);
            assert_int_equal(many ? send_many(s, corner, NULL) : send_whole(s, &h, 0, 0, NULL), IL_OK);
            il_status st = s->finish(s, &err), end = il_output_commit(o, &err);
            assert_int_equal(st, many ? IL_E_IO : IL_OK);
            assert_int_equal(end, IL_E_IO);
            assert_string_equal(err.file, "/dev/full");
            mesh_writers[i]->mesh_free(s);
            il_stack_head_free(&h);
        }
    }
    free(corner);
}

static void every_allocation_of_stl_may_fail(void **state)
{
    (void)state;
    for (long k = 0;; k++) {
        il_output *o;
        il_mesh_sink *s = NULL;
        il_stack_head h = head_called("a");
        assert_int_equal(il_output_open(&o, "/dev/null", NULL), IL_OK);
        il_alloc_test_fail_after(k);
        il_status st = il_writer_stl.mesh_new(&s, o, NULL, NULL);
        if (st == IL_OK)
            st = send_whole(s, &h, 0, 0, NULL);
        if (st == IL_OK)
            st = s->finish(s, NULL);
        il_alloc_test_fail_after(-1);
        il_writer_stl.mesh_free(s);
        il_output_discard(o);
        il_stack_head_free(&h);
        if (st == IL_OK) {
            assert_true(k > 6);
            break;
        }
        assert_int_equal(st, IL_E_NOMEM);
        assert_true(k < 200);
    }
}

/* ---- the table ------------------------------------------------------------ */

static void writers_are_found_by_name_and_extension(void **state)
{
    (void)state;
    for (const il_writer *const *w = il_writers; *w; w++)
        assert_ptr_equal(il_writer_named((*w)->name), *w);
    assert_null(il_writer_named("STL"));
    assert_null(il_writer_named(""));
    static const struct { const char *path; const il_writer *w; } c[] = {
        { "a.stl", &il_writer_stl }, { "/x.ply/A.STL", &il_writer_stl }, { "a.b.obj", &il_writer_obj },
        { "./a.Ply", &il_writer_ply }, { "a", NULL }, { "a.", NULL }, { "a.stl/b", NULL }, { ".stl", NULL },
        { "a.stlx", NULL }, { "", NULL }, { "a.xyz", NULL } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        assert_ptr_equal(il_writer_for_path(c[i].path), c[i].w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(binary_stl_has_these_bytes),
        cmocka_unit_test(ascii_stl_has_these_bytes),
        cmocka_unit_test(obj_on_a_stream_has_these_bytes),
        cmocka_unit_test(binary_ply_has_these_bytes),
        cmocka_unit_test(ascii_ply_has_these_bytes),
        cmocka_unit_test(several_stacks_share_a_file),
        cmocka_unit_test(an_abandoned_stack_leaves_nothing),
        cmocka_unit_test(corners_of_large_meshes_are_found_again),
        cmocka_unit_test(counts_that_do_not_fit_are_refused),
        cmocka_unit_test(an_index_that_was_never_given_is_refused),
        cmocka_unit_test(calls_out_of_order_are_refused),
        cmocka_unit_test(stl_refuses_what_no_float_can_hold),
        cmocka_unit_test(a_triangle_without_area_has_normal_zero),
        cmocka_unit_test(no_number_of_binary_stl_is_minus_zero),
        cmocka_unit_test(a_header_gives_no_commands),
        cmocka_unit_test(a_frame_places_the_mesh_and_keeps_it_outward),
        cmocka_unit_test(a_frame_beyond_all_numbers_is_refused),
        cmocka_unit_test(hostile_names_break_no_format),
        cmocka_unit_test(a_binary_header_is_80_bytes_whatever_the_names),
        cmocka_unit_test(comments_tell_the_way_back_to_the_map),
        cmocka_unit_test(the_header_of_stl_tells_whole_numbers_of_it),
        cmocka_unit_test(comments_stand_where_there_is_room),
        cmocka_unit_test(a_full_disk_under_the_spool_is_told_by_the_piece),
        cmocka_unit_test(a_full_disk_under_the_output_is_told),
        cmocka_unit_test(every_allocation_of_stl_may_fail),
        cmocka_unit_test(writers_are_found_by_name_and_extension),
    };
    return cmocka_run_group_tests(tests, files_setup, files_teardown);
}
