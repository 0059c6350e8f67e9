#include "config.h"
#include "meshes.h"

#include <signal.h>
#include <sys/resource.h>

/* ---- groups --------------------------------------------------------------- */

static void obj_groups_follow_the_slabs(void **state)
{
    (void)state;
    const il_write_options options = { .groups_by_slab = true };
    il_output *o;
    il_mesh_sink *s;
    il_stack_head h = head_called("a");
    assert_int_equal(il_output_to_memory(&o, NULL), IL_OK);
    assert_int_equal(il_writer_obj.mesh_new(&s, o, &options, NULL), IL_OK);
    assert_int_equal(send_tetrahedron(s, &h, 0, 0, NULL), IL_OK);
    uint32_t tri[3] = { 0, 1, 2 };
    il_mesh next = { .tri = tri, .n_triangles = 1, .slab = 1 };
    assert_int_equal(s->piece(s, &next, NULL), IL_OK);
    assert_int_equal(s->end(s, &no_facts, NULL), IL_OK);
    finished(&il_writer_obj, s, o);
    assert_true(output_contains(o, "v 0 0 1\ng a_slab0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\ng a_slab1\nf 1 2 3\n"));
    il_output_discard(o);
    il_stack_head_free(&h);
}

static void stacks_of_one_name_are_told_apart(void **state)
{
    (void)state;
    il_output *o;
    il_mesh_sink *s = started(&il_writer_obj, &o);
    static const char *const names[] = { "a b", "a_b", "c" };
    for (int k = 0; k < 3; k++) {
        il_stack_head h = head_called(names[k]);
        assert_int_equal(send_whole(s, &h, 0, k, NULL), IL_OK);
        il_stack_head_free(&h);
    }
    finished(&il_writer_obj, s, o);
    assert_true(output_contains(o, "\no a_b-1\n"));
    assert_true(output_contains(o, "\no a_b-2\n"));
    assert_true(output_contains(o, "\no c-3\n"));
    assert_true(output_contains(o, "\n# stack 1 vertices 4 triangles 4 unit mm name a_b\n"));
    il_output_discard(o);
}

/* ---- OBJ with its MTL ----------------------------------------------------- */

static il_status write_colored_obj(const char *path, il_error *err)
{
    il_output *o = NULL;
    il_mesh_sink *s = NULL;
    static const unsigned char red[4] = { 0, 255, 255, 0 };
    il_status st = il_output_open(&o, path, err);
    if (st == IL_OK)
        st = il_writer_obj.mesh_new(&s, o, NULL, err);
    for (int k = 0; k < 4 && st == IL_OK; k++) {
        il_stack_head h = IL_STACK_HEAD_INIT;
        char name[2] = { (char)('a' + k), '\0' };
        h.name = name;
        if (k < 3)
            set_color(&h, red[k], 128, 0);
        st = send_whole(s, &h, 2 * k, k, err);
    }
    if (st == IL_OK)
        st = s->finish(s, err);
    il_writer_obj.mesh_free(s);
    if (st == IL_OK)
        return il_output_commit(o, err);
    il_output_discard(o);
    return st;
}

static void colours_stand_in_an_mtl_beside_the_obj(void **state)
{
    char path[FILES_PATH_MAX], mtl[FILES_PATH_MAX];
    size_t n;
    assert_int_equal(write_colored_obj(files_path(path, state, "two words.OBJ"), NULL), IL_OK);
    files_assert_content(files_path(mtl, state, "two words.mtl"),
                         "# isoloft\n"
                         "newmtl rgb_008000\nKd 0 0.5019607843137255 0\nillum 1\n"
                         "newmtl rgb_ff8000\nKd 1 0.5019607843137255 0\nillum 1\n"
                         "newmtl plain\nKd 0.8 0.8 0.8\nillum 1\n");
    char *text = files_read(path, &n);
    assert_non_null(strstr(text, "# isoloft\nmtllib two words.mtl\n"));
    assert_non_null(strstr(text, "g a\nusemtl rgb_008000\nf 1 3 2\n"));
    assert_non_null(strstr(text, "g b\nusemtl rgb_ff8000\nf 5 7 6\n"));
    assert_non_null(strstr(text, "g d\nusemtl plain\nf 13 15 14\n"));
    free(text);
    remove(path), remove(mtl);
    assert_int_equal(files_count(state), 0);
}

static void an_obj_called_mtl_does_not_overwrite_itself(void **state)
{
    char path[FILES_PATH_MAX], mtl[FILES_PATH_MAX];
    assert_int_equal(write_colored_obj(files_path(path, state, "x.mtl"), NULL), IL_OK);
    assert_int_equal(access(files_path(mtl, state, "x.mtl.mtl"), F_OK), 0);
    remove(path), remove(mtl);
}

static void a_name_that_fits_no_line_leaves_the_colours_out(void **state)
{
    char path[FILES_PATH_MAX];
    size_t n;
    assert_int_equal(write_colored_obj(files_path(path, state, "a\nf 1 1 1.obj"), NULL), IL_OK);
    assert_int_equal(files_count(state), 1);
    char *text = files_read(path, &n);
    assert_non_null(strstr(text, "# without colours"));
    assert_null(strstr(text, "usemtl"));
    free(text);
    remove(path);
}

static void without_colours_there_is_no_mtl(void **state)
{
    char path[FILES_PATH_MAX];
    il_output *o;
    il_mesh_sink *s;
    il_stack_head h = head_called("a");
    assert_int_equal(il_output_open(&o, files_path(path, state, "x.obj"), NULL), IL_OK);
    assert_int_equal(il_writer_obj.mesh_new(&s, o, NULL, NULL), IL_OK);
    assert_int_equal(send_whole(s, &h, 0, 0, NULL), IL_OK);
    assert_int_equal(s->finish(s, NULL), IL_OK);
    il_writer_obj.mesh_free(s);
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    assert_int_equal(files_count(state), 1);
    remove(path);
    il_stack_head_free(&h);
}

static void obj_and_mtl_appear_together_or_not_at_all(void **state)
{
    char path[FILES_PATH_MAX], mtl[FILES_PATH_MAX];
    files_write(files_path(path, state, "x.obj"), "old", 3);
    assert_int_equal(mkdir(files_path(mtl, state, "x.mtl"), 0777), 0); /* cannot be replaced */
    assert_int_equal(write_colored_obj(path, NULL), IL_E_IO);
    files_assert_content(path, "old");
    assert_int_equal(rmdir(mtl), 0);

    struct rlimit before, less;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    less = before;
    less.rlim_cur = 100; /* neither fits */
    signal(SIGXFSZ, SIG_IGN);
    il_error err = IL_ERROR_INIT;
    setrlimit(RLIMIT_FSIZE, &less);
    il_status st = write_colored_obj(path, &err);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(st, IL_E_IO);
    files_assert_content(path, "old");
    assert_int_equal(files_count(state), 1);
    remove(path);
}

static void every_allocation_may_fail(void **state)
{
    char path[FILES_PATH_MAX], mtl[FILES_PATH_MAX];
    files_path(mtl, state, "x.mtl");
    files_write(files_path(path, state, "x.obj"), "old", 3);
    long k = 0;
    for (;; k++) {
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        il_status st = write_colored_obj(path, &err);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK)
            break;
        assert_int_equal(st, IL_E_NOMEM);
        files_assert_content(path, "old");
        assert_int_equal(access(mtl, F_OK) == 0 ? 2 : 1, files_count(state));
        assert_true(k < 200);
    }
    assert_true(k > 20);
    remove(path), remove(mtl);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_groups_follow_the_slabs),
        cmocka_unit_test(colours_stand_in_an_mtl_beside_the_obj),
        cmocka_unit_test(an_obj_called_mtl_does_not_overwrite_itself),
        cmocka_unit_test(a_name_that_fits_no_line_leaves_the_colours_out),
        cmocka_unit_test(without_colours_there_is_no_mtl),
        cmocka_unit_test(obj_and_mtl_appear_together_or_not_at_all),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(stacks_of_one_name_are_told_apart),
    };
    return cmocka_run_group_tests(tests, files_setup, files_teardown);
}
