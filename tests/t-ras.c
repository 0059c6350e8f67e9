/* t-ras.c - patient coordinates the other way round: exact, and said once. */
#include "config.h"
#include "model/ras.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* Keeps the head of the last stack, and counts the calls. */
typedef struct keeper {
    il_sink sink;
    il_stack_head head;
    int slices, pairs, stacks, ends;
} keeper;

static il_status keep_head(il_sink *s, const il_stack_head *head, il_error *err)
{
    il_stack_head_free(&((keeper *)s)->head);
    return il_stack_head_copy(&((keeper *)s)->head, head, err);
}

static il_status count_slice(il_sink *s, il_slice *slice, il_error *err)
{
    (void)err;
    ((keeper *)s)->slices += slice->z == 0.1;
    return IL_OK;
}

static il_status count_pair(il_sink *s, il_pair *pair, il_error *err)
{
    (void)pair;
    (void)err;
    ((keeper *)s)->pairs++;
    return IL_OK;
}

static il_status count_stack(il_sink *s, il_error *err)
{
    (void)err;
    ((keeper *)s)->stacks++;
    return IL_OK;
}

static il_status count_end(il_sink *s, il_error *err)
{
    (void)err;
    ((keeper *)s)->ends++;
    return IL_OK;
}

static void send_stack(il_sink *s, const il_stack_head *head)
{
    il_slice slice = IL_SLICE_INIT;
    il_pair pair = IL_PAIR_INIT;
    slice.z = 0.1;
    assert_int_equal(s->stack_begin(s, head, NULL), IL_OK);
    assert_int_equal(s->slice(s, &slice, NULL), IL_OK);
    assert_int_equal(s->pair(s, &pair, NULL), IL_OK);
    assert_int_equal(s->stack_end(s, NULL), IL_OK);
}

static void x_and_y_change_their_sign_and_nothing_else(void **state)
{
    (void)state;
    static const double frames[3][12] = { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0 },
                                          { 0.1, -7, 3, 0.6, 0.8, 0, -0.64, 0.48, 0.6, 0.48, -0.36, 0.8 } };
    static const double point[3] = { 0.1, -2.3, 4.7 };
    for (int k = -1; k < 3; k++) {
        keeper keep = { .sink = { keep_head, count_slice, count_pair, count_stack, count_end }, .head = IL_STACK_HEAD_INIT };
        il_stack_head head = IL_STACK_HEAD_INIT;
        il_sink *s = NULL;
        double lps[3], ras[3];
        if (k >= 0)
            memcpy(head.frame, frames[k], sizeof head.frame);
        head.has_frame = k >= 0;
        assert_int_equal(il_ras_new(&s, &keep.sink, NULL, NULL), IL_OK);
        send_stack(s, &head);
        assert_int_equal(s->end(s, NULL), IL_OK);
        assert_true(keep.slices == 1 && keep.pairs == 1 && keep.stacks == 1 && keep.ends == 1);
        il_stack_head_place(&head, point, lps);
        il_stack_head_place(&keep.head, point, ras);
        assert_true(ras[0] == -lps[0] && ras[1] == -lps[1] && ras[2] == lps[2]);
        assert_false(il_stack_head_mirrors(&keep.head));
        for (int i = 0; i < 12; i++)
            assert_false(keep.head.frame[i] == 0 && signbit(keep.head.frame[i]));
        il_stack_head_free(&keep.head);
        il_ras_free(s);
    }
}

static void it_is_said_of_every_stack_but_noted_once(void **state)
{
    (void)state;
    keeper keep = { .sink = { keep_head, count_slice, count_pair, count_stack, count_end }, .head = IL_STACK_HEAD_INIT };
    il_report report = IL_REPORT_INIT;
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_sink *s = NULL;
    assert_true(il_stack_head_add_attribute(&head, "RTROIInterpretedType", "ORGAN"));
    assert_int_equal(il_ras_new(&s, &keep.sink, &report, NULL), IL_OK);
    for (int k = 0; k < 3; k++) {
        send_stack(s, &head);
        assert_string_equal(il_stack_head_attribute(&keep.head, IL_ATTRIBUTE_COORDINATES), "RAS");
        assert_string_equal(il_stack_head_attribute(&keep.head, "RTROIInterpretedType"), "ORGAN");
        assert_null(il_stack_head_attribute(&keep.head, "other"));
    }
    assert_int_equal(report.n_notes, 1);
    il_report_free(&report);
    il_stack_head_free(&head);
    il_stack_head_free(&keep.head);
    il_ras_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x_and_y_change_their_sign_and_nothing_else),
        cmocka_unit_test(it_is_said_of_every_stack_but_noted_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
