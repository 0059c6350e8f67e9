/* t-stage.c - the matching stage with slices to match: the same calls for any number of threads. */
#include "config.h"
#include "base/alloc.h"
#include "base/output.h"
#include "matching.h"
#include "match/matcher.h"
#include "model/order.h"
#include "output/writer.h"

#include <pthread.h>

enum { MOST_SLICES = 40, WORDS = 400 };

static const int thread_counts[] = { 1, 2, 3, 8 };
enum { N_COUNTS = sizeof thread_counts / sizeof *thread_counts };

/* ---- a stack to match ---- */

/* A star of 20 vertices and an ellipse beside it, each its own every time; every
 * ninth slice is empty. */
static void make_slices(il_slice *slice, size_t n, uint64_t seed)
{
    for (size_t i = 0; i < n; i++) {
        outline o = { 0 };
        slice[i] = (il_slice)IL_SLICE_INIT;
        slice[i].z = (double)i;
        if (i % 9 == 8)
            continue;
        outline_star(&o, random_between(&seed, -5, 5), 0, random_between(&seed, 0.4, 0.5), random_between(&seed, 0, 0.3), 20);
        outline_ellipse(&o, 90, random_between(&seed, -9, 9), random_between(&seed, 20, 30), random_between(&seed, 15, 30), 12);
        size_t first = 0;
        while (first < o.n) {
            il_ring *r = il_slice_add_ring(&slice[i]);
            assert_non_null(r);
            size_t k = first;
            do
                assert_true(il_ring_add(r, o.xy[2 * k], o.xy[2 * k + 1], 0));
            while ((k = o.next[k]) != first);
            first += r->n;
        }
        outline_free(&o);
        il_slice_put_in_order(&slice[i]);
    }
}

static void free_slices(il_slice *slice, size_t n)
{
    for (size_t i = 0; i < n; i++)
        il_slice_free(&slice[i]);
}

/* ---- a next stage that writes all down ---- */

/* words: "(", a slice's height and a blank, "f" for a pair that was matched, "P"
 * for one that the stream brought, "G" for a gap, ")" and ".".  written: the same as native
 * text.  fails_at: the call that fails, from 0, or -1.  Slices and records are
 * taken, and overwritten: whoever still reads them would see it. */
typedef struct listener {
    il_sink sink;
    il_sink *writer;
    il_output *written;
    char words[WORDS];
    long calls, fails_at;
    pthread_t thread;
} listener;

static il_status hear(listener *l, const char *word, il_error *err)
{
    assert_true(pthread_equal(l->thread, pthread_self()));
    strncat(l->words, word, WORDS - strlen(l->words) - 1);
    return l->calls++ == l->fails_at ? il_fail(err, IL_E_SURFACE, 0, "call %ld", l->fails_at) : IL_OK;
}

static il_status on_stack_begin(il_sink *s, const il_stack_head *head, il_error *err)
{
    listener *l = (listener *)s;
    il_status st = l->writer->stack_begin(l->writer, head, err);
    return st == IL_OK ? hear(l, "(", err) : st;
}

static il_status on_slice(il_sink *s, il_slice *slice, il_error *err)
{
    listener *l = (listener *)s;
    char z[40];
    snprintf(z, sizeof z, "%g ", slice->z);
    il_status st = l->writer->slice(l->writer, slice, err);
    for (size_t i = 0; i < slice->n; i++)
        memset(slice->ring[i].xy, 0xff, 2 * slice->ring[i].n * sizeof *slice->ring[i].xy);
    il_slice_free(slice);
    return st == IL_OK ? hear(l, z, err) : st;
}

static il_status on_pair(il_sink *s, il_pair *pair, il_error *err)
{
    listener *l = (listener *)s;
    const char *word = pair->gap ? "G" : pair->matcher == IL_MATCHER_FFD ? "f" : "P";
    il_status st = l->writer->pair(l->writer, pair, err);
    il_pair_free(pair);
    return st == IL_OK ? hear(l, word, err) : st;
}

static il_status on_stack_end(il_sink *s, il_error *err)
{
    listener *l = (listener *)s;
    il_status st = l->writer->stack_end(l->writer, err);
    return st == IL_OK ? hear(l, ")", err) : st;
}

static il_status on_end(il_sink *s, il_error *err)
{
    listener *l = (listener *)s;
    il_status st = l->writer->end(l->writer, err);
    return st == IL_OK ? hear(l, ".", err) : st;
}

static listener new_listener(void)
{
    listener l = { .sink = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, .fails_at = -1, .thread = pthread_self() };
    assert_int_equal(il_output_to_memory(&l.written, NULL), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&l.writer, l.written, NULL), IL_OK);
    return l;
}

static void free_listener(listener *l)
{
    il_writer_loft.contours_free(l->writer);
    il_output_discard(l->written);
}

/* ---- streams, as words ---- */

/* Play WORDS: "(", "s" for the next of SLICES (copied), "P" for a pair the stream
 * brings, on line 7, "G" for a gap, ")" and ".".  Ends with the first failure. */
static il_status play(const char *words, const il_slice *slices, int threads, listener *l, il_error *err)
{
    const il_match_options o = { IL_MATCHER_FFD, false, threads };
    const il_stack_head head = IL_STACK_HEAD_INIT;
    il_sink *m = NULL;
    il_status st = il_matcher_new(&m, &o, &l->sink, err);
    for (; *words && st == IL_OK; words++) {
        il_slice slice = IL_SLICE_INIT;
        il_pair pair = IL_PAIR_INIT;
        pair.line = 7;
        pair.gap = *words == 'G';
        if (*words == 's')
            st = il_slice_copy(&slice, slices++, err);
        if (st == IL_OK)
            st = *words == '(' ? m->stack_begin(m, &head, err) : *words == ')' ? m->stack_end(m, err)
               : *words == '.' ? m->end(m, err) : *words == 'P' || *words == 'G' ? m->pair(m, &pair, err) : m->slice(m, &slice, err);
        il_slice_free(&slice);
        il_pair_free(&pair);
    }
    il_matcher_free(m);
    return st;
}

static void assert_same_bytes(const listener *a, const listener *b)
{
    size_t n, m;
    const unsigned char *s = il_output_memory(a->written, &n), *t = il_output_memory(b->written, &m);
    assert_int_equal(n, m);
    assert_memory_equal(s, t, n);
}

/* The end, the words and the bytes are those of one thread. */
static void assert_same_for_any_threads(const char *words, const il_slice *slices, il_status wanted, const char *heard)
{
    listener one = new_listener();
    il_error first = IL_ERROR_INIT;
    assert_int_equal(play(words, slices, 1, &one, &first), wanted);
    assert_string_equal(one.words, heard);
    for (size_t i = 1; i < N_COUNTS; i++) {
        listener l = new_listener();
        il_error err = IL_ERROR_INIT;
        assert_int_equal(play(words, slices, thread_counts[i], &l, &err), wanted);
        assert_string_equal(l.words, heard);
        assert_string_equal(err.text, first.text);
        assert_int_equal(err.line, first.line);
        assert_same_bytes(&one, &l);
        free_listener(&l);
    }
    free_listener(&one);
}

/* ---- order ---- */

static void a_long_stack_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    il_slice slice[MOST_SLICES];
    char words[MOST_SLICES + 4] = "(", heard[WORDS] = "(";
    make_slices(slice, MOST_SLICES, 1);
    for (int i = 0; i < MOST_SLICES; i++) {
        size_t n = strlen(heard);
        snprintf(heard + n, sizeof heard - n, "%d %s", i, i > 0 ? "f" : "");
        words[1 + i] = 's';
    }
    memcpy(words + 1 + MOST_SLICES, ").", 3);
    strncat(heard, ").", sizeof heard - strlen(heard) - 1);
    assert_same_for_any_threads(words, slice, IL_OK, heard);
    free_slices(slice, MOST_SLICES);
}

static void records_of_the_stream_keep_their_places(void **state)
{
    (void)state;
    static const struct { const char *words, *heard; } c[] = {
        { "(sssPsssssssPsPssssP).", "(0 1 f2 P3 f4 f5 f6 f7 f8 f9 P10 P11 f12 f13 f14 P)." },
        { "(ssPsPsPsPsPsPsPsPsPsP).", "(0 1 P2 P3 P4 P5 P6 P7 P8 P9 P10 P)." },
        { "(ssGssssGsssssGs).", "(0 1 G2 f3 f4 f5 G6 f7 f8 f9 f10 G11 f)." },
        { "(s)(ss)()(ssssssssss).", "(0 )(1 2 f)()(3 4 f5 f6 f7 f8 f9 f10 f11 f12 f)." } };
    il_slice slice[15];
    make_slices(slice, 15, 2);
    for (size_t k = 0; k < sizeof c / sizeof *c; k++)
        assert_same_for_any_threads(c[k].words, slice, IL_OK, c[k].heard);
    free_slices(slice, 15);
}

/* What came before it is passed on first. */
static void a_record_in_the_wrong_place_is_told_in_its_turn(void **state)
{
    (void)state;
    static const struct { const char *words, *heard; } c[] = {
        { "(P", "(" }, { "(sP", "(0 " }, { "(sssssPP", "(0 1 f2 f3 f4 P" }, { "(sssssssssssPP", "(0 1 f2 f3 f4 f5 f6 f7 f8 f9 f10 P" },
        { "(sssP)(sP", "(0 1 f2 P)(3 " } };
    il_slice slice[11];
    make_slices(slice, 11, 3);
    for (size_t k = 0; k < sizeof c / sizeof *c; k++)
        assert_same_for_any_threads(c[k].words, slice, IL_E_INPUT, c[k].heard);
    free_slices(slice, 11);
}

/* The failure of a call comes before that of a record behind it in the stream,
 * and nothing is called after it. */
static void when_the_next_stage_fails_nothing_follows(void **state)
{
    (void)state;
    static const char words[] = "(sssssssssssPPs).";
    il_slice slice[12];
    make_slices(slice, 12, 4);
    for (long at = 0; at < 23; at++) {
        listener l = new_listener();
        il_error err = IL_ERROR_INIT;
        l.fails_at = at;
        assert_int_equal(play(words, slice, thread_counts[at % N_COUNTS], &l, &err), at < 22 ? IL_E_SURFACE : IL_E_INPUT);
        assert_int_equal(l.calls, at < 22 ? at + 1 : 22);
        free_listener(&l);
    }
    free_slices(slice, 12);
}

/* ---- after a failure ---- */

static void feed(il_sink *m, il_slice *slices, size_t n, il_status wanted)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < n && st == IL_OK; i++) {
        il_slice slice = IL_SLICE_INIT;
        assert_int_equal(il_slice_copy(&slice, &slices[i], NULL), IL_OK);
        st = m->slice(m, &slice, NULL);
        il_slice_free(&slice);
    }
    assert_int_equal(st, wanted);
}

/* A stack given up while it is matched, by who calls or by the stage behind. */
static void a_stack_begun_after_a_failure_starts_afresh(void **state)
{
    (void)state;
    const il_stack_head head = IL_STACK_HEAD_INIT;
    il_slice slice[12];
    make_slices(slice, 12, 5);
    for (size_t i = 0; i < N_COUNTS; i++)
        for (int fails = 0; fails < 2; fails++) {
            const il_match_options o = { IL_MATCHER_FFD, false, thread_counts[i] };
            listener l = new_listener();
            il_sink *m;
            l.fails_at = fails ? 3 : -1;
            assert_int_equal(il_matcher_new(&m, &o, &l.sink, NULL), IL_OK);
            assert_int_equal(m->stack_begin(m, &head, NULL), IL_OK);
            feed(m, slice, 12, fails ? IL_E_SURFACE : IL_OK);
            il_writer_loft.contours_free(l.writer); /* it would not begin within a stack */
            assert_int_equal(il_writer_loft.contours_new(&l.writer, l.written, NULL), IL_OK);
            assert_int_equal(m->stack_begin(m, &head, NULL), IL_OK);
            feed(m, slice + 5, 2, IL_OK);
            assert_int_equal(m->stack_end(m, NULL), IL_OK);
            assert_int_equal(m->end(m, NULL), IL_OK);
            assert_string_equal(l.words, fails ? "(0 1 f(5 6 f)." : "(0 1 f2 f3 f(5 6 f).");
            il_matcher_free(m);
            free_listener(&l);
        }
    free_slices(slice, 12);
}

/* With K allocations: told as such, or done as ever; OK is the end of it. */
static il_status starve(const il_slice *slices, int threads, long k, const listener *whole)
{
    listener l = new_listener();
    il_error err = IL_ERROR_INIT;
    il_alloc_test_fail_after(k);
    il_status st = play("(sssPss).", slices, threads, &l, &err);
    il_alloc_test_fail_after(-1);
    assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
    if (st == IL_OK)
        assert_same_bytes(whole, &l);
    assert_memory_equal(l.words, whole->words, strlen(l.words));
    free_listener(&l);
    return st;
}

/* Allocations failing in turn, all of the first hundred and then each fifth, with
 * threads each fifteenth: nothing is left, and what was passed on is the begin of
 * the whole. */
static void little_memory_is_told(void **state)
{
    (void)state;
    static const int threads[] = { 1, 3 };
    il_slice slice[5];
    listener whole = new_listener();
    make_slices(slice, 5, 6);
    assert_int_equal(play("(sssPss).", slice, 1, &whole, NULL), IL_OK);
    for (size_t i = 0; i < 2; i++) {
        long k = 0;
        while (starve(slice, threads[i], k, &whole) != IL_OK) {
            k += k < 100 ? 1 : 5 * threads[i];
            assert_true(k < 100000);
        }
        assert_true(k > 100);
    }
    free_slices(slice, 5);
    free_listener(&whole);
}

/* ---- what is held ---- */

static void slices_leave_when_the_window_is_full(void **state)
{
    (void)state;
    const il_stack_head head = IL_STACK_HEAD_INIT;
    il_slice slice[IL_MATCH_WINDOW + 1];
    make_slices(slice, IL_MATCH_WINDOW + 1, 7);
    for (size_t i = 0; i < N_COUNTS; i++) {
        const il_match_options o = { IL_MATCHER_FFD, false, thread_counts[i] };
        listener l = new_listener();
        il_sink *m;
        assert_int_equal(il_matcher_new(&m, &o, &l.sink, NULL), IL_OK);
        assert_int_equal(m->stack_begin(m, &head, NULL), IL_OK);
        feed(m, slice, IL_MATCH_WINDOW, IL_OK);
        assert_string_equal(l.words, "(");
        feed(m, slice + IL_MATCH_WINDOW, 1, IL_OK);
        assert_string_equal(l.words, "(0 ");
        il_matcher_free(m); /* with work under way */
        free_listener(&l);
    }
    free_slices(slice, IL_MATCH_WINDOW + 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_long_stack_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(records_of_the_stream_keep_their_places),
        cmocka_unit_test(a_record_in_the_wrong_place_is_told_in_its_turn),
        cmocka_unit_test(when_the_next_stage_fails_nothing_follows),
        cmocka_unit_test(a_stack_begun_after_a_failure_starts_afresh),
        cmocka_unit_test(little_memory_is_told),
        cmocka_unit_test(slices_leave_when_the_window_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
