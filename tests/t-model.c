#include "config.h"
#include "base/alloc.h"
#include "model/mesh.h"
#include "model/pair.h"
#include "model/report.h"
#include "model/stack.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/* A 4 x 3 rectangle whose corner lies at (X, Y). */
static il_ring rectangle(double x, double y)
{
    il_ring r = IL_RING_INIT;
    assert_true(il_ring_add(&r, x, y, 0));
    assert_true(il_ring_add(&r, x + 4, y, 0));
    assert_true(il_ring_add(&r, x + 4, y + 3, 0));
    assert_true(il_ring_add(&r, x, y + 3, 0));
    return r;
}

static void assert_vertices(const il_ring *r, const double *xy, size_t n)
{
    assert_int_equal(r->n, n);
    assert_memory_equal(r->xy, xy, n * 2 * sizeof *xy);
}

static void assert_marks(const il_ring *r, const unsigned char *mark, size_t n)
{
    assert_non_null(r->mark);
    assert_int_equal(r->n, n);
    assert_memory_equal(r->mark, mark, n);
}

static void a_rectangle_has_its_area_and_length(void **state)
{
    (void)state;
    il_ring r = rectangle(-1, 2);
    assert_true(il_ring_area2(&r) == 24);
    assert_true(il_ring_length(&r) == 14);
    il_ring_reverse(&r);
    assert_true(il_ring_area2(&r) == -24);
    r.open = true;
    assert_true(il_ring_length(&r) == 10); /* without the edge from (3, 2) to (-1, 2) */
    il_ring_free(&r);
}

static void the_area_is_exact_far_from_the_origin(void **state)
{
    (void)state;
    il_ring r = rectangle(4e14, -4e14);
    assert_true(il_ring_area2(&r) == 24);
    il_ring_free(&r);
}

static void rings_of_no_area_have_none(void **state)
{
    (void)state;
    il_ring r = IL_RING_INIT;
    assert_true(il_ring_area2(&r) == 0);
    assert_true(il_ring_length(&r) == 0);
    il_ring_reverse(&r);
    assert_true(il_ring_add(&r, 5, 6, 0));
    assert_true(il_ring_area2(&r) == 0);
    assert_true(il_ring_length(&r) == 0);
    assert_true(il_ring_add(&r, 8, 10, 0));
    assert_true(il_ring_area2(&r) == 0);
    assert_true(il_ring_length(&r) == 10); /* there and back */
    il_ring_free(&r);
}

static void reversing_keeps_the_first_vertex(void **state)
{
    (void)state;
    il_ring r = rectangle(0, 0);
    il_ring_reverse(&r);
    assert_vertices(&r, (const double[]){ 0, 0, 0, 3, 4, 3, 4, 0 }, 4);
    il_ring_reverse(&r);
    assert_vertices(&r, (const double[]){ 0, 0, 4, 0, 4, 3, 0, 3 }, 4);
    il_ring_free(&r);
}

static void reversing_moves_edge_marks_with_their_edges(void **state)
{
    (void)state;
    enum { NONE = 0, INS = IL_VERTEX_INSERTED, EDGE = IL_VERTEX_MAP_EDGE };
    il_ring r = rectangle(0, 0);
    r.n = 3; /* the fourth brings the marks late */
    assert_true(il_ring_add(&r, 0, 3, EDGE));       /* edge (0,3)-(0,0) */
    r.mark[1] = INS | EDGE;                         /* vertex (4,0), edge (4,0)-(4,3) */
    assert_marks(&r, (const unsigned char[]){ NONE, INS | EDGE, NONE, EDGE }, 4);
    il_ring_reverse(&r);                            /* (0,0) (0,3) (4,3) (4,0) */
    assert_marks(&r, (const unsigned char[]){ EDGE, NONE, EDGE, INS }, 4);
    il_ring_reverse(&r);
    assert_marks(&r, (const unsigned char[]){ NONE, INS | EDGE, NONE, EDGE }, 4);
    il_ring_free(&r);
}

static void an_open_line_is_reversed_end_to_end(void **state)
{
    (void)state;
    il_ring r = IL_RING_INIT;
    r.open = true;
    assert_true(il_ring_add(&r, 0, 0, IL_VERTEX_MAP_EDGE));
    assert_true(il_ring_add(&r, 1, 0, 0));
    assert_true(il_ring_add(&r, 1, 1, IL_VERTEX_INSERTED));
    il_ring_reverse(&r);
    assert_vertices(&r, (const double[]){ 1, 1, 1, 0, 0, 0 }, 3);
    assert_marks(&r, (const unsigned char[]){ IL_VERTEX_INSERTED, IL_VERTEX_MAP_EDGE, 0 }, 3);
    il_ring_free(&r);
}

static void rotating_makes_any_vertex_the_first(void **state)
{
    (void)state;
    for (size_t k = 0; k < 4; k++) {
        il_ring r = rectangle(0, 0), s = rectangle(0, 0);
        r.n = 3;
        assert_true(il_ring_add(&r, 0, 3, IL_VERTEX_INSERTED));
        il_ring_rotate(&r, k);
        for (size_t i = 0; i < 4; i++) {
            assert_memory_equal(&r.xy[2 * i], &s.xy[2 * ((i + k) % 4)], 2 * sizeof(double));
            assert_int_equal(r.mark[i], (i + k) % 4 == 3 ? IL_VERTEX_INSERTED : 0);
        }
        il_ring_free(&r);
        il_ring_free(&s);
    }
}

static void units_are_read_as_they_are_written(void **state)
{
    (void)state;
    for (int i = 0; i < IL_N_UNITS; i++) {
        il_unit u = IL_N_UNITS;
        const char *name = il_unit_name((il_unit)i);
        assert_true(il_unit_parse(name, strlen(name), &u));
        assert_int_equal(u, i);
    }
    il_unit u;
    assert_false(il_unit_parse("", 0, &u));
    assert_false(il_unit_parse("mmm", 3, &u));
    assert_false(il_unit_parse("M", 1, &u));
    assert_true(il_unit_parse("mmm", 2, &u) && u == IL_UNIT_MM);
    assert_true(il_unit_metres(IL_UNIT_FT) == 0.3048);
    assert_true(il_unit_metres(IL_UNIT_DEG) == 0);
}

/* ---- copies --------------------------------------------------------------- */

static char *text(const char *s)
{
    char *t = il_strndup(s, strlen(s));
    assert_non_null(t);
    return t;
}

static il_stack_head full_head(void)
{
    il_stack_head h = IL_STACK_HEAD_INIT;
    assert_true(il_stack_head_set_name(&h, "Left kidney!", 11));
    h.crs = text("EPSG:28992");
    h.has_color = true;
    h.color[1] = 128;
    h.frame[11] = -1;
    h.unit = IL_UNIT_FT;
    assert_true(il_grow(&h.attribute, &h.cap_attributes, 2, sizeof *h.attribute));
    h.attribute[h.n_attributes++] = (il_attribute){ text("a"), text("1") };
    h.attribute[h.n_attributes++] = (il_attribute){ text("b"), text("") };
    assert_true(il_stack_head_set_files(&h, (const char *const[]){ "a.shp", "b\n.shp" }, 2));
    assert_true(il_grow(&h.spot, &h.cap_spots, 1, sizeof *h.spot));
    h.spot[h.n_spots++] = (il_spot){ .x = 1, .y = 2, .z = 3, .line = 4, .feature = 5, .file = 1 };
    assert_true(il_extra_add(&h.extra, "x-one 1", 7));
    assert_true(il_extra_add(&h.extra, "x-two 2", 7));
    return h;
}

static void assert_same_head(const il_stack_head *a, const il_stack_head *b)
{
    assert_string_equal(a->name, b->name);
    assert_ptr_not_equal(a->name, b->name);
    assert_string_equal(a->crs, b->crs);
    assert_int_equal(a->unit, b->unit);
    assert_int_equal(a->color[1], b->color[1]);
    assert_true(a->frame[11] == b->frame[11]);
    assert_int_equal(a->n_attributes, b->n_attributes);
    for (size_t i = 0; i < a->n_attributes; i++) {
        assert_string_equal(a->attribute[i].key, b->attribute[i].key);
        assert_string_equal(a->attribute[i].value, b->attribute[i].value);
    }
    assert_int_equal(a->n_files, b->n_files);
    for (size_t i = 0; i < a->n_files; i++)
        assert_string_equal(a->file[i], b->file[i]);
    assert_int_equal(a->n_spots, b->n_spots);
    assert_ptr_not_equal(a->spot, b->spot);
    for (size_t i = 0; i < a->n_spots; i++)
        assert_true(a->spot[i].x == b->spot[i].x && a->spot[i].z == b->spot[i].z && a->spot[i].feature == b->spot[i].feature);
    const il_extra *x = a->extra, *y = b->extra;
    for (; x && y; x = x->next, y = y->next)
        assert_string_equal(x->text, y->text);
    assert_true(!x && !y);
}

static void a_head_is_copied_whole_or_not_at_all(void **state)
{
    (void)state;
    il_stack_head h = full_head(), copy;
    assert_string_equal(h.name, "Left kidney");
    long k = 0;
    for (;; k++) {
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        il_status st = il_stack_head_copy(&copy, &h, &err);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK)
            break;
        assert_int_equal(st, IL_E_NOMEM);
        assert_int_equal(err.code, IL_E_NOMEM);
        assert_null(copy.name);
        assert_int_equal(copy.n_attributes, 0);
        assert_true(copy.n_files == 0 && copy.n_spots == 0);
        assert_true(k < 100);
    }
    assert_true(k >= 15); /* name, crs, list, 4 texts, list, 2 names, spots, 2 x- lines of 2 blocks */
    assert_same_head(&h, &copy);
    assert_string_equal(copy.file[1], "b\\x0a.shp");
    il_stack_head_free(&copy);
    il_stack_head_free(&copy);
    il_stack_head_free(&h);
    assert_string_equal(il_stack_head_name(&h), "");
}

static void an_empty_head_is_copied_empty(void **state)
{
    (void)state;
    il_stack_head h = IL_STACK_HEAD_INIT, copy;
    assert_int_equal(il_stack_head_copy(&copy, &h, NULL), IL_OK);
    assert_null(copy.name);
    assert_null(copy.crs);
    assert_null(copy.attribute);
    assert_null(copy.extra);
}

static il_slice square_with_a_hole(void)
{
    il_slice s = IL_SLICE_INIT;
    s.z = 2.5;
    s.line = 7;
    assert_true(il_extra_add(&s.extra, "x-s", 3));
    il_ring *r = il_slice_add_ring(&s);
    assert_non_null(r);
    *r = rectangle(0, 0);
    r->line = 9;
    r->feature = 4;
    r->file = 1;
    r = il_slice_add_ring(&s);
    assert_non_null(r);
    assert_true(il_ring_add(r, 1, 1, IL_VERTEX_INSERTED));
    assert_true(il_ring_add(r, 1, 2, 0));
    assert_true(il_ring_add(r, 2, 1, 0));
    assert_true(il_extra_add(&r->extra, "x-r", 3));
    return s;
}

static void a_slice_is_copied_whole_or_not_at_all(void **state)
{
    (void)state;
    il_slice s = square_with_a_hole(), copy;
    assert_true(il_slice_area(&s) == 11.5);
    assert_int_equal(il_slice_points(&s), 7);
    long k = 0;
    for (;; k++) {
        il_alloc_test_fail_after(k);
        il_status st = il_slice_copy(&copy, &s, NULL);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK)
            break;
        assert_int_equal(st, IL_E_NOMEM);
        assert_null(copy.ring);
        assert_int_equal(copy.n, 0);
        assert_true(k < 100);
    }
    assert_true(copy.z == 2.5 && copy.line == 7 && copy.n == 2);
    assert_true(copy.ring[0].line == 9 && copy.ring[0].feature == 4 && copy.ring[0].file == 1);
    assert_null(copy.ring[0].mark);
    assert_memory_equal(copy.ring[0].xy, s.ring[0].xy, 8 * sizeof(double));
    assert_ptr_not_equal(copy.ring[0].xy, s.ring[0].xy);
    assert_marks(&copy.ring[1], (const unsigned char[]){ IL_VERTEX_INSERTED, 0, 0 }, 3);
    assert_string_equal(copy.ring[1].extra->text, "x-r");
    assert_string_equal(copy.extra->text, "x-s");
    assert_true(il_ring_add(&copy.ring[0], 1, 1, 0)); /* a copy grows on its own */
    assert_int_equal(s.ring[0].n, 4);
    il_slice_free(&copy);
    il_slice_free(&copy);
    il_slice_free(&s);
}

static void a_ring_that_cannot_grow_stays_as_it_was(void **state)
{
    (void)state;
    il_ring r = rectangle(0, 0);
    il_alloc_test_fail_after(0);
    size_t n = r.n;
    bool grew = true;
    for (int i = 0; i < 100 && grew; i++) {
        grew = il_ring_add(&r, 9, 9, 0);
        n += grew ? 1 : 0;
    }
    bool marked = il_ring_add(&r, 9, 9, IL_VERTEX_INSERTED);
    il_alloc_test_fail_after(-1);
    assert_false(grew);
    assert_false(marked);
    assert_int_equal(r.n, n);
    assert_true(r.xy[0] == 0 && r.xy[5] == 3);
    il_ring_free(&r);
}

/* ---- mesh, pair ----------------------------------------------------------- */

static void a_mesh_grows_and_is_freed_twice(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    for (uint32_t i = 0; i < 100; i++) {
        const double p[3] = { i, i + .5, -1.0 * i };
        assert_true(il_mesh_add_vertex(&m, p, (il_origin){ 0, 1, 2, (int32_t)i }));
        assert_true(il_mesh_add_triangle(&m, i, i / 2, i / 3));
    }
    assert_int_equal(m.n_vertices, 100);
    assert_int_equal(m.n_triangles, 100);
    assert_true(m.xyz[3 * 99 + 1] == 99.5 && m.xyz[3 * 99 + 2] == -99);
    assert_int_equal(m.origin[99].vertex, 99);
    assert_int_equal(m.tri[3 * 99 + 1], 49);
    il_mesh_free(&m);
    assert_null(m.xyz);
    il_mesh_free(&m);
}

static void a_mesh_without_memory_gains_nothing(void **state)
{
    (void)state;
    for (long k = 0; k < 2; k++) {
        il_mesh m = IL_MESH_INIT;
        il_alloc_test_fail_after(k);
        bool v = il_mesh_add_vertex(&m, (const double[]){ 0, 0, 0 }, (il_origin){ 0, 0, 0, 0 });
        bool t = il_mesh_add_triangle(&m, 0, 1, 2);
        il_alloc_test_fail_after(-1);
        assert_false(v);
        assert_false(t);
        assert_int_equal(m.n_vertices, 0);
        assert_int_equal(m.n_triangles, 0);
        il_mesh_free(&m);
    }
}

static void a_pair_is_freed_with_all_it_holds(void **state)
{
    (void)state;
    il_pair p = IL_PAIR_INIT;
    assert_true(il_grow(&p.group, &p.cap_groups, 1, sizeof *p.group));
    p.group[p.n_groups++] = (il_group){
        .lower = il_alloc(2, sizeof(uint32_t)), .upper = il_alloc(1, sizeof(uint32_t)), .n_lower = 2, .n_upper = 1 };
    assert_true(il_grow(&p.phi, &p.cap_phi, 3, sizeof *p.phi));
    assert_true(il_grow(&p.match, &p.cap_matches, 3, sizeof *p.match));
    assert_true(il_grow(&p.unmatched, &p.cap_unmatched, 3, sizeof *p.unmatched));
    assert_true(il_extra_add(&p.extra, "x-p", 3));
    il_pair_free(&p);
    assert_null(p.group);
    il_pair_free(&p);
}

/* ---- report --------------------------------------------------------------- */

static void what_is_turned_and_what_is_kept_as_it_is_are_no_faults(void **state)
{
    (void)state;
    for (int i = 0; i < IL_N_REPAIRS; i++) {
        il_report r = IL_REPORT_INIT;
        il_report_repair(&r, (il_repair)i, 1);
        assert_int_equal(r.repair[i], 1);
        bool fault = i != IL_REPAIR_REVERSED_RING && i != IL_REPAIR_REVERSED_LINE && i != IL_REPAIR_PINCH &&
                     i != IL_REPAIR_KNOT && i != IL_REPAIR_CRUMB;
        assert_int_equal(il_report_any(&r), fault);
        il_report_free(&r);
    }
}

static void equal_skips_fold_and_all_are_counted(void **state)
{
    (void)state;
    il_report r = IL_REPORT_INIT;
    assert_false(il_report_any(&r));
    il_report_skip(&r, "a.svg", 3, "text", "has no outline");
    il_report_skip(&r, "a.svg", 9, "text", "has no outline");
    il_report_skip(&r, "b.svg", 1, "text", "has no outline");
    il_report_skip(&r, "a.svg", 4, "im\033age", "is\na picture");
    assert_int_equal(r.n_skips, 3);
    assert_int_equal(r.n_skipped, 4);
    assert_int_equal(r.skip[0].count, 2);
    assert_int_equal(r.skip[0].line, 3);
    assert_string_equal(r.skip[2].what, "im\\x1bage");
    assert_string_equal(r.skip[2].why, "is\\x0aa picture");
    assert_true(il_report_any(&r));
    il_report_free(&r);
    il_report_free(&r);
    assert_false(il_report_any(&r));
}

static void skips_beyond_the_limit_are_counted_only(void **state)
{
    (void)state;
    il_report r = IL_REPORT_INIT;
    for (int i = 0; i < 250; i++) {
        char what[20];
        snprintf(what, sizeof what, "thing %d", i);
        il_report_skip(&r, "f", i, what, "odd");
    }
    assert_int_equal(r.n_skips, IL_REPORT_SKIPS_KEPT);
    assert_int_equal(r.n_skipped, 250);
    il_report_free(&r);
}

static void without_memory_words_are_lost_but_no_count(void **state)
{
    (void)state;
    for (long k = 0; k < 4; k++) {
        il_report r = IL_REPORT_INIT;
        il_alloc_test_fail_after(k);
        il_report_skip(&r, "f", 1, "what", "why");
        il_report_note(&r, "note %d", 1);
        il_alloc_test_fail_after(-1);
        assert_int_equal(r.n_skipped, 1);
        assert_int_equal(r.n_skips, 0);
        assert_int_equal(r.n_notes, 0);
        il_report_free(&r);
    }
}

static void notes_are_printable_and_no_report_is_fine(void **state)
{
    (void)state;
    il_report r = IL_REPORT_INIT;
    char big[1000];
    memset(big, 'a', sizeof big - 1);
    big[sizeof big - 1] = '\0';
    il_report_note(&r, "taken as %s\t", "mm");
    il_report_note(&r, "%s", big);
    assert_string_equal(r.note[0], "taken as mm\\x09");
    assert_true(strlen(r.note[1]) > 300 && strlen(r.note[1]) < 400);
    assert_false(il_report_any(&r)); /* a note is no repair */
    il_report_repair(&r, IL_REPAIR_TOUCH, 0);
    assert_false(il_report_any(&r));
    il_report_repair(&r, IL_REPAIR_TOUCH, 2);
    assert_int_equal(r.repair[IL_REPAIR_TOUCH], 2);
    assert_true(il_report_any(&r));
    il_report_free(&r);
    il_report_note(NULL, "nothing");
    il_report_repair(NULL, IL_REPAIR_PINCH, 1);
    il_report_skip(NULL, "f", 1, "what", "why");
}

static void every_repair_has_its_own_key(void **state)
{
    (void)state;
    for (int i = 0; i < IL_N_REPAIRS; i++) {
        const char *key = il_repair_key((il_repair)i);
        assert_non_null(key);
        assert_int_equal(strspn(key, "abcdefghijklmnopqrstuvwxyz_"), strlen(key));
        assert_true(strlen(il_repair_words((il_repair)i)) > 0);
        for (int j = 0; j < i; j++)
            assert_string_not_equal(key, il_repair_key((il_repair)j));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rectangle_has_its_area_and_length),
        cmocka_unit_test(the_area_is_exact_far_from_the_origin),
        cmocka_unit_test(rings_of_no_area_have_none),
        cmocka_unit_test(reversing_keeps_the_first_vertex),
        cmocka_unit_test(reversing_moves_edge_marks_with_their_edges),
        cmocka_unit_test(an_open_line_is_reversed_end_to_end),
        cmocka_unit_test(rotating_makes_any_vertex_the_first),
        cmocka_unit_test(units_are_read_as_they_are_written),
        cmocka_unit_test(a_head_is_copied_whole_or_not_at_all),
        cmocka_unit_test(an_empty_head_is_copied_empty),
        cmocka_unit_test(a_slice_is_copied_whole_or_not_at_all),
        cmocka_unit_test(a_ring_that_cannot_grow_stays_as_it_was),
        cmocka_unit_test(a_mesh_grows_and_is_freed_twice),
        cmocka_unit_test(a_mesh_without_memory_gains_nothing),
        cmocka_unit_test(a_pair_is_freed_with_all_it_holds),
        cmocka_unit_test(what_is_turned_and_what_is_kept_as_it_is_are_no_faults),
        cmocka_unit_test(equal_skips_fold_and_all_are_counted),
        cmocka_unit_test(skips_beyond_the_limit_are_counted_only),
        cmocka_unit_test(without_memory_words_are_lost_but_no_count),
        cmocka_unit_test(notes_are_printable_and_no_report_is_fine),
        cmocka_unit_test(every_repair_has_its_own_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
