/* t-account.c - stacks that fail, and those that go on: the taps of the account. */
#include "config.h"
#include "cli/account.h"
#include "cli/nowhere.h"
#include "cli/oddities.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* Stands for the lofter and the writer: a stack named "bad" has no surface. */
typedef struct stage {
    il_sink sink;
    il_mesh_sink mesh;
    il_mesh_sink *next;
    bool bad;
    int begun, ended, abandoned, slices;
    il_status failure;
} stage;

static il_status on_begin(il_sink *s, const il_stack_head *h, il_error *err)
{
    stage *t = (stage *)s;
    t->bad = strcmp(il_stack_head_name(h), "bad") == 0;
    return t->next->begin(t->next, h, err);
}

static il_status on_slice(il_sink *s, il_slice *slice, il_error *err)
{
    stage *t = (stage *)s;
    t->slices++;
    if (!t->bad || slice->z < 1)
        return IL_OK;
    t->next->abandon(t->next);
    return il_fail(err, t->failure, 0, "no surface");
}

static il_status on_pair(il_sink *s, il_pair *p, il_error *err)
{
    (void)s;
    (void)p;
    (void)err;
    return IL_OK;
}

static il_status on_stack_end(il_sink *s, il_error *err)
{
    stage *t = (stage *)s;
    il_mesh_facts facts = { .vertices = 4, .triangles = 4, .components = 1 };
    return t->next->end(t->next, &facts, err);
}

static il_status on_end(il_sink *s, il_error *err)
{
    stage *t = (stage *)s;
    return t->next->finish(t->next, err);
}

static stage *of_mesh(il_mesh_sink *m)
{
    return (stage *)(void *)((char *)m - offsetof(stage, mesh));
}

static il_status mesh_begin(il_mesh_sink *m, const il_stack_head *h, il_error *err)
{
    (void)h;
    (void)err;
    of_mesh(m)->begun++;
    return IL_OK;
}

static il_status mesh_piece(il_mesh_sink *m, const il_mesh *piece, il_error *err)
{
    (void)m;
    (void)piece;
    (void)err;
    return IL_OK;
}

static il_status mesh_end(il_mesh_sink *m, const il_mesh_facts *f, il_error *err)
{
    (void)f;
    (void)err;
    of_mesh(m)->ended++;
    return IL_OK;
}

static void mesh_abandon(il_mesh_sink *m)
{
    of_mesh(m)->abandoned++;
}

static il_status mesh_finish(il_mesh_sink *m, il_error *err)
{
    (void)m;
    (void)err;
    return IL_OK;
}

/* Stacks of NAMES, each with slices at z = 0, 1, 2 ("empty": without rings);
 * "mended" has a repair.  *A is to be freed. */
static il_status run(il_account *a, stage *t, const il_account_options *o, const char *const *names, il_error *err)
{
    il_status failure = t->failure;
    *t = (stage){ .sink = { on_begin, on_slice, on_pair, on_stack_end, on_end }, .failure = failure,
                  .mesh = { mesh_begin, mesh_piece, mesh_end, mesh_abandon, mesh_finish } };
    il_account_init(a, o);
    t->next = il_account_meshes(a, &t->mesh);
    il_sink *first = il_account_contours(a, &t->sink);
    il_status st = IL_OK;
    for (; *names && st == IL_OK; names++) {
        il_stack_head head = IL_STACK_HEAD_INIT;
        assert_true(il_stack_head_set_name(&head, *names, strlen(*names)));
        st = first->stack_begin(first, &head, err);
        for (int k = 0; k < 3 && st == IL_OK; k++) {
            static const double heights[] = { 0, 1, 6 };
            il_slice slice = IL_SLICE_INIT;
            slice.z = heights[k];
            if (strcmp(*names, "empty") != 0)
                assert_true(il_ring_add(il_slice_add_ring(&slice), k, 2 * k, 0));
            st = first->slice(first, &slice, err);
            il_slice_free(&slice);
        }
        if (strcmp(*names, "mended") == 0)
            il_report_repair(&a->report, IL_REPAIR_CROSSING, 2);
        st = st == IL_OK ? first->stack_end(first, err) : st;
        il_stack_head_free(&head);
    }
    st = st == IL_OK ? first->end(first, err) : st;
    il_account_close(a, st, err);
    return st;
}

static const char *const three[] = { "a", "bad", "c", NULL };

static void a_bad_stack_ends_the_run(void **state)
{
    (void)state;
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice, .input = "x.loft" };
    stage t = { .failure = IL_E_SURFACE };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, three, &err), IL_E_SURFACE);
    assert_string_equal(err.file, "x.loft");
    assert_int_equal(a.n, 2);
    assert_int_equal(a.stack[0].status, IL_OK);
    assert_int_equal(a.stack[1].status, IL_E_SURFACE);
    assert_string_equal(a.stack[1].error, "x.loft: no surface");
    assert_int_equal(t.abandoned, 1);
    il_account_free(&a);
}

static void others_go_on_where_that_is_wanted(void **state)
{
    (void)state;
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice, .keep_going = true };
    stage t = { .failure = IL_E_SURFACE };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, three, &err), IL_OK);
    assert_int_equal(a.worst, IL_E_SURFACE);
    assert_int_equal(a.n, 3);
    assert_int_equal(a.stack[1].status, IL_E_SURFACE);
    assert_false(a.stack[1].has_mesh);
    assert_int_equal(a.stack[1].slices, 3);
    assert_true(a.stack[2].has_mesh && a.stack[2].status == IL_OK);
    assert_true(t.begun == 3 && t.ended == 2 && t.abandoned == 1 && t.slices == 8);
    il_account_free(&a);
}

static void a_full_disk_ends_the_run_in_any_case(void **state)
{
    (void)state;
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice, .keep_going = true };
    stage t = { .failure = IL_E_IO };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, three, &err), IL_E_IO);
    assert_int_equal(a.n, 2);
    il_account_free(&a);
}

static void strict_gives_up_what_was_repaired(void **state)
{
    (void)state;
    static const char *const names[] = { "a", "mended", "c", NULL };
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice, .keep_going = true, .strict = true };
    stage t = { .failure = IL_E_SURFACE };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, names, &err), IL_OK);
    assert_int_equal(a.worst, IL_E_INPUT);
    assert_true(t.begun == 3 && t.ended == 2 && t.abandoned == 1);
    assert_int_equal(a.stack[1].report.repair[IL_REPAIR_CROSSING], 2);
    assert_int_equal(a.stack[2].report.repair[IL_REPAIR_CROSSING], 0);
    il_account_free(&a);
    o.keep_going = false;
    assert_int_equal(run(&a, &t, &o, names, &err), IL_E_INPUT);
    assert_int_equal(a.n, 2);
    il_account_free(&a);
}

static void an_empty_stack_is_left_out(void **state)
{
    (void)state;
    static const char *const names[] = { "empty", "b", NULL }, *const none[] = { "empty", NULL };
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice };
    stage t = { .failure = IL_E_SURFACE };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, names, &err), IL_OK);
    assert_true(!a.stack[0].has_mesh && a.stack[0].status == IL_OK && a.stack[0].report.n_notes == 1);
    assert_true(t.begun == 2 && t.ended == 1 && t.abandoned == 1);
    il_account_free(&a);
    assert_int_equal(run(&a, &t, &o, none, &err), IL_E_INPUT);
    il_account_free(&a);
}

static void spacing_and_gaps_are_measured(void **state)
{
    (void)state;
    static const char *const names[] = { "a", NULL };
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice };
    stage t = { .failure = IL_E_SURFACE };
    il_account a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(run(&a, &t, &o, names, &err), IL_OK);
    const il_stack_account *s = &a.stack[0];
    assert_true(s->spacing.least == 1 && s->spacing.usual == 1 && s->spacing.largest == 5);
    assert_int_equal(s->n_gaps, 1);
    assert_true(s->gap[0].below == 1 && s->gap[0].above == 6 && !s->gap[0].capped);
    assert_true(s->box[0] == 0 && s->box[3] == 2 && s->box[4] == 4 && s->box[5] == 6);
    assert_true(s->points == 3 && s->rings == 3);
    il_account_free(&a);
}

/* ---- what is told of a stack --------------------------------------------------- */

static void take_square(il_account *a, double z, double side)
{
    il_sink *first = &a->contours;
    il_slice slice = IL_SLICE_INIT;
    slice.z = z;
    il_ring *r = il_slice_add_ring(&slice);
    assert_true(il_ring_add(r, 0, 0, 0) && il_ring_add(r, side, 0, 0) && il_ring_add(r, side, side, 0) && il_ring_add(r, 0, side, 0));
    assert_int_equal(first->slice(first, &slice, NULL), IL_OK);
    il_slice_free(&slice);
}

/* Squares of 2, 4, 4 and 2 at 0, 1, 2 and 9; GAP: the last two are left apart. */
static void take_squares(il_account *a, const il_stack_head *head, bool gap)
{
    il_sink *first = &a->contours;
    static const double squares[][2] = { { 0, 2 }, { 1, 4 }, { 2, 4 }, { 9, 2 } };
    assert_int_equal(first->stack_begin(first, head, NULL), IL_OK);
    for (size_t k = 0; k < 4; k++) {
        il_pair pair = IL_PAIR_INIT;
        pair.gap = gap && k == 3;
        take_square(a, squares[k][0], squares[k][1]);
        if (k > 0)
            assert_int_equal(first->pair(first, &pair, NULL), IL_OK);
    }
    assert_int_equal(first->stack_end(first, NULL), IL_OK);
}

static void areas_add_up_to_two_volumes(void **state)
{
    (void)state;
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice };
    il_sink nowhere = il_nowhere_contours();
    il_stack_head head = IL_STACK_HEAD_INIT;
    for (int gap = 0; gap < 2; gap++) {
        il_account a;
        il_account_init(&a, &o);
        il_account_contours(&a, &nowhere);
        take_squares(&a, &head, gap);
        const il_stack_account *s = &a.stack[0];
        assert_true(il_stack_account_slice_sum(s) == 40 * 1);
        assert_true(il_sections_trapezoids(&s->sections) == 10 + 16 + (gap ? 0 : 70));
        assert_true(s->seconds >= 0 && a.began == 0);
        il_account_free(&a);
    }
}

static void a_single_slice_is_as_thick_as_its_set_is_spaced(void **state)
{
    (void)state;
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice };
    il_sink nowhere = il_nowhere_contours();
    for (int known = 0; known < 2; known++) {
        il_account a;
        il_stack_head head = IL_STACK_HEAD_INIT;
        head.usual_spacing = known ? 3 : 0;
        il_account_init(&a, &o);
        il_sink *first = il_account_contours(&a, &nowhere);
        assert_int_equal(first->stack_begin(first, &head, NULL), IL_OK);
        take_square(&a, 5, 2);
        assert_int_equal(first->stack_end(first, NULL), IL_OK);
        assert_true(known ? il_stack_account_slice_sum(&a.stack[0]) == 12 : isnan(il_stack_account_slice_sum(&a.stack[0])));
        il_account_free(&a);
    }
}

static void join_words(void *self, const char *words)
{
    char *all = self;
    assert_true(strlen(all) + strlen(words) + 2 < 400);
    strcat(strcat(all, words), ";");
}

static void the_head_and_the_oddities_are_kept(void **state)
{
    (void)state;
    static const double across_x[12] = { 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0 };
    char words[400] = "";
    il_voice voice = { .quiet = true };
    il_account_options o = { .voice = &voice };
    il_sink nowhere = il_nowhere_contours();
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_account a;
    assert_true(il_stack_head_add_attribute(&head, "RTROIInterpretedType", "ORGAN"));
    assert_true(il_stack_head_add_attribute(&head, "ROIGenerationAlgorithm", "MANUAL"));
    assert_true(il_stack_head_add_attribute(&head, "FrameOfReferenceUID", "1.2.3"));
    head.has_frame = true;
    head.usual_spacing = 2;
    memcpy(head.frame, across_x, sizeof across_x);
    il_account_init(&a, &o);
    il_account_contours(&a, &nowhere);
    il_report_repair(&a.report, IL_REPAIR_CROSSING, 1);
    il_report_repair(&a.report, IL_REPAIR_REVERSED_RING, 9);
    il_report_repair(&a.report, IL_REPAIR_KEYHOLE, 2);
    il_report_skip(&a.report, "f", 1, "contour", "open");
    take_squares(&a, &head, true);
    const il_stack_account *s = &a.stack[0];
    assert_string_equal(s->type, "ORGAN");
    assert_string_equal(s->algorithm, "MANUAL");
    assert_string_equal(s->frame_uid, "1.2.3");
    assert_string_equal(s->planes, "across x");
    il_oddities_each(s, join_words, words);
    assert_string_equal(words, "1 part skipped;planes across x;1 gap;spacing unlike the others';1 crossing;2 keyholes;");
    il_stack_head_free(&head);
    il_account_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bad_stack_ends_the_run),
        cmocka_unit_test(others_go_on_where_that_is_wanted),
        cmocka_unit_test(a_full_disk_ends_the_run_in_any_case),
        cmocka_unit_test(strict_gives_up_what_was_repaired),
        cmocka_unit_test(an_empty_stack_is_left_out),
        cmocka_unit_test(spacing_and_gaps_are_measured),
        cmocka_unit_test(areas_add_up_to_two_volumes),
        cmocka_unit_test(a_single_slice_is_as_thick_as_its_set_is_spaced),
        cmocka_unit_test(the_head_and_the_oddities_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
