#include "config.h"
#include "match/matcher.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/* Writes down the calls: "(", a slice's height, "p", ")" and "."; takes slices. */
typedef struct recorder { il_sink sink; char text[200]; } recorder;

static void put(recorder *r, const char *s)
{
    strncat(r->text, s, sizeof r->text - strlen(r->text) - 1);
}

static il_status on_stack_begin(il_sink *s, const il_stack_head *h, il_error *err)
{
    (void)h;
    (void)err;
    put((recorder *)s, "(");
    return IL_OK;
}

static il_status on_slice(il_sink *s, il_slice *slice, il_error *err)
{
    (void)err;
    char z[20];
    snprintf(z, sizeof z, "%g", slice->z);
    put((recorder *)s, z);
    il_slice_free(slice);
    return IL_OK;
}

static il_status on_pair(il_sink *s, il_pair *p, il_error *err)
{
    (void)err;
    put((recorder *)s, p->line == 7 ? "P" : p->matcher == IL_MATCHER_NONE && p->n_phi == 0 ? "p" : "?");
    return IL_OK;
}

static il_status on_stack_end(il_sink *s, il_error *err)
{
    (void)err;
    put((recorder *)s, ")");
    return IL_OK;
}

static il_status on_end(il_sink *s, il_error *err)
{
    (void)err;
    put((recorder *)s, ".");
    return IL_OK;
}

/* Play CALLS (as the recorder writes them; P: a pair of the stream) through a matcher. */
static il_status play(const char *calls, recorder *r, il_error *err)
{
    *r = (recorder){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, "" };
    il_match_options o = IL_MATCH_OPTIONS_INIT;
    il_sink *m = NULL;
    il_status st = il_matcher_new(&m, &o, &r->sink, err);
    il_stack_head head = IL_STACK_HEAD_INIT;
    for (; *calls && st == IL_OK; calls++) {
        il_slice slice = IL_SLICE_INIT;
        il_pair pair = IL_PAIR_INIT;
        slice.z = *calls - '0';
        pair.line = 7;
        st = *calls == '(' ? m->stack_begin(m, &head, err) : *calls == ')' ? m->stack_end(m, err)
           : *calls == '.' ? m->end(m, err) : *calls == 'P' ? m->pair(m, &pair, err) : m->slice(m, &slice, err);
        il_slice_free(&slice);
        il_pair_free(&pair);
    }
    il_matcher_free(m);
    return st;
}

static void pairs_are_added_where_the_stream_brings_none(void **state)
{
    (void)state;
    static const struct { const char *in, *out; } c[] = {
        { "(123).", "(12p3p)." }, { "(12P3).", "(12P3p)." }, { "(123P).", "(12p3P)." }, { "(12P3P).", "(12P3P)." },
        { "(1)(2).", "(1)(2)." }, { "()(12).", "()(12p)." }, { ".", "." }, { "(1)(23P4).", "(1)(23P4p)." } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        recorder r;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(play(c[k].in, &r, &err), IL_OK);
        assert_string_equal(r.text, c[k].out);
    }
}

static void a_pair_out_of_place_is_refused(void **state)
{
    (void)state;
    static const char *const c[] = { "(P", "(1P", "(12PP", "(12P)(3P" };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        recorder r;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(play(c[k], &r, &err), IL_E_INPUT);
        assert_int_equal(err.line, 7);
    }
}

static void a_stack_begun_after_a_failure_starts_afresh(void **state)
{
    (void)state;
    recorder r;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(play("(12(34).", &r, &err), IL_OK);
    assert_string_equal(r.text, "(12(34p).");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_added_where_the_stream_brings_none),
        cmocka_unit_test(a_pair_out_of_place_is_refused),
        cmocka_unit_test(a_stack_begun_after_a_failure_starts_afresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
