/* stage.c - the stage of matcher.h: slices in, slices with all their pairs out.
 *
 * What comes out is slice, pair, slice, pair, as it came in, whatever the
 * threads do:
 *  - Whether the stream brings the pair of slices k and k + 1 is known when the
 *    call after slice k + 1 comes.  From then on it is to be matched, or it is
 *    there; it takes the same place in either case.
 *  - A slice is passed on when the window is full and another one comes, never
 *    sooner, so that what NEXT has seen at any call does not depend on which
 *    pair was matched first.  The end of the stack passes on all.
 *  - A failure comes out in its place: all before it is passed on first, and
 *    what NEXT says of that is told instead.  So the first in the stream wins.
 *  - NEXT is called on the caller's thread only. */
#include "config.h"
#include "base/alloc.h"
#include "match/parade.h"

/* due: the pair of the last two slices is not known yet.  parade: not started
 * when nothing is to be matched (matcher none); slices pass at once then.
 * is_terrain: of this stack, nothing is matched, and all passes as it is. */
typedef struct stage {
    il_sink sink;
    il_sink *next;
    bool matches;
    size_t n_slices;          /* of this stack so far */
    bool due, is_terrain;
    il_parade parade;
} stage;

/* The stack is over, or failed: nothing of it is held and nothing runs. */
static void forget(stage *s)
{
    if (s->matches) {
        pthread_mutex_lock(&s->parade.crew.mutex);
        il_parade_clear(&s->parade);
        pthread_mutex_unlock(&s->parade.crew.mutex);
    }
    s->n_slices = 0;
    s->due = false;
}

static il_status forget_failed(stage *s, il_status st)
{
    if (st != IL_OK)
        forget(s);
    return st;
}

/* The slice, then its pair, or the reason why there is none. */
static il_status pass_on(stage *s, il_parade_place *place, il_error *err)
{
    il_status st = s->next->slice(s->next, &place->slice, err);
    if (st != IL_OK || !place->has_pair)
        return st;
    if (place->status != IL_OK) {
        if (err)
            *err = place->error;
        return place->status;
    }
    return s->next->pair(s->next, &place->pair, err);
}

/* Pass on the first slices until MOST are held; helps to match them. */
static il_status pass_until(stage *s, size_t most, il_error *err)
{
    il_parade *p = &s->parade;
    il_status st = IL_OK;
    if (!s->matches)
        return IL_OK;
    pthread_mutex_lock(&p->crew.mutex);
    while (st == IL_OK && p->n > most) {
        while (!il_parade_ready(p))
            il_crew_help(&p->crew);
        il_parade_place place = il_parade_pop(p);
        pthread_mutex_unlock(&p->crew.mutex);
        st = pass_on(s, &place, err);
        il_parade_place_free(&place);
        pthread_mutex_lock(&p->crew.mutex);
    }
    pthread_mutex_unlock(&p->crew.mutex);
    return st;
}

static il_status hold(stage *s, il_slice *slice, il_error *err)
{
    il_status st = pass_until(s, IL_MATCH_WINDOW - 1, err);
    if (st != IL_OK)
        return st;
    pthread_mutex_lock(&s->parade.crew.mutex);
    il_parade_push(&s->parade, slice);
    pthread_mutex_unlock(&s->parade.crew.mutex);
    return IL_OK;
}

/* What is known of the pair that is due: PAIR, or null when none came. */
static il_status settle(stage *s, il_pair *pair, il_error *err)
{
    il_pair identity = IL_PAIR_INIT;
    if (!s->due)
        return IL_OK;
    s->due = false;
    if (!s->matches)
        return s->next->pair(s->next, pair ? pair : &identity, err);
    pthread_mutex_lock(&s->parade.crew.mutex);
    il_parade_pair(&s->parade, pair);
    pthread_mutex_unlock(&s->parade.crew.mutex);
    return IL_OK;
}

/* ---- the sink ---- */

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    stage *s = (stage *)self;
    forget(s);
    s->is_terrain = head->kind == IL_KIND_TERRAIN;
    return s->next->stack_begin(s->next, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    stage *s = (stage *)self;
    if (s->is_terrain)
        return s->next->slice(s->next, slice, err);
    il_status st = settle(s, NULL, err);
    if (st == IL_OK)
        st = s->matches ? hold(s, slice, err) : s->next->slice(s->next, slice, err);
    if (st == IL_OK)
        s->due = s->n_slices++ > 0;
    return forget_failed(s, st);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    stage *s = (stage *)self;
    if (s->is_terrain)
        return s->next->pair(s->next, pair, err);
    if (s->due)
        return forget_failed(s, settle(s, pair, err));
    il_status st = pass_until(s, 0, err);
    if (st == IL_OK)
        st = il_fail(err, IL_E_INPUT, pair->line, "a pair record must follow the upper one of its two slices, once");
    return forget_failed(s, st);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    stage *s = (stage *)self;
    il_status st = settle(s, NULL, err);
    if (st == IL_OK)
        st = pass_until(s, 0, err);
    forget(s);
    return st == IL_OK ? s->next->stack_end(s->next, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    stage *s = (stage *)self;
    return s->next->end(s->next, err);
}

il_status il_matcher_new(il_sink **out, const il_match_options *o, il_sink *next, il_error *err)
{
    *out = NULL;
    stage *s = il_calloc(1, sizeof *s);
    if (!s)
        return il_fail_nomem(err);
    s->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    s->next = next;
    s->matches = o->matcher != IL_MATCHER_NONE;
    il_status st = s->matches ? il_parade_start(&s->parade, o, err) : IL_OK;
    if (st != IL_OK) {
        il_free(s);
        return st;
    }
    *out = &s->sink;
    return IL_OK;
}

void il_matcher_free(il_sink *sink)
{
    stage *s = (stage *)sink;
    if (!s)
        return;
    il_parade_stop(&s->parade);
    il_free(s);
}
