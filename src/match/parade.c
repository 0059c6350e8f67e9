#include "config.h"
#include "match/parade.h"
#include "base/alloc.h"
#include "match/ffd.h"

#include <string.h>

static il_parade_place *at(il_parade *p, size_t slice)
{
    return &p->place[slice % IL_MATCH_WINDOW];
}

/* ---- what the workers do ---- */

/* An idle solver, or null: then another may be made. */
static il_ffd *take_solver(il_parade *p)
{
    return p->n_idle > 0 ? p->idle[--p->n_idle] : NULL;
}

static void give_back(il_parade *p, il_ffd *solver)
{
    if (solver)
        p->idle[p->n_idle++] = solver;
}

/* Without the mutex: the two slices stay where they are while the pair is
 * matched, and nobody else looks at it. */
static void match(const il_match_options *o, const il_slice *lower, il_parade_place *upper, il_ffd **solver)
{
    upper->status = *solver ? IL_OK : il_ffd_new(solver, &upper->error);
    if (upper->status == IL_OK)
        upper->status = il_match_slices(lower, &upper->slice, o, *solver, &upper->pair, &upper->error);
}

/* The lowest pair first: it is the one the caller waits for. */
static int step(void *self, pthread_mutex_t *mutex)
{
    il_parade *p = self;
    for (size_t k = p->first + 1; !p->cancelled && k < p->first + p->n; k++) {
        il_parade_place *lower = at(p, k - 1), *upper = at(p, k);
        if (upper->state != IL_PAIR_WAITING)
            continue;
        upper->state = IL_PAIR_MATCHING;
        il_ffd *solver = take_solver(p);
        pthread_mutex_unlock(mutex);
        match(&p->options, &lower->slice, upper, &solver);
        pthread_mutex_lock(mutex);
        give_back(p, solver);
        upper->state = IL_PAIR_SETTLED;
        il_crew_wake(&p->crew);
        return 1;
    }
    return 0;
}

/* ---- the parade ---- */

il_status il_parade_start(il_parade *p, const il_match_options *o, il_error *err)
{
    memset(p, 0, sizeof *p);
    p->options = *o;
    p->idle = il_calloc((size_t)o->threads, sizeof(il_ffd *));
    if (!p->idle)
        return il_fail_nomem(err);
    il_status st = il_crew_start(&p->crew, o->threads, step, p, err);
    if (st != IL_OK) {
        il_free(p->idle);
        p->idle = NULL;
    }
    return st;
}

static void drop_all(il_parade *p)
{
    while (p->n > 0) {
        il_parade_place place = il_parade_pop(p);
        il_parade_place_free(&place);
    }
}

void il_parade_stop(il_parade *p)
{
    il_crew_end(&p->crew);
    drop_all(p);
    while (p->n_idle > 0)
        il_ffd_free(p->idle[--p->n_idle]);
    il_free(p->idle);
    p->idle = NULL;
}

void il_parade_push(il_parade *p, il_slice *slice)
{
    bool is_first = p->first + p->n == 0;
    *at(p, p->first + p->n) = (il_parade_place){
        .slice = *slice, .has_pair = !is_first, .error = IL_ERROR_INIT,
        .state = is_first ? IL_PAIR_SETTLED : IL_PAIR_UNKNOWN };
    *slice = (il_slice)IL_SLICE_INIT;
    p->n++;
}

void il_parade_pair(il_parade *p, il_pair *pair)
{
    il_parade_place *upper = at(p, p->first + p->n - 1);
    upper->state = pair && !pair->linked ? IL_PAIR_SETTLED : IL_PAIR_WAITING;
    if (pair) {
        upper->pair = *pair;
        *pair = (il_pair)IL_PAIR_INIT;
    }
    il_crew_wake(&p->crew);
}

bool il_parade_ready(const il_parade *p)
{
    for (size_t k = p->first; k < p->first + 2 && k < p->first + p->n; k++)
        if (p->place[k % IL_MATCH_WINDOW].state != IL_PAIR_SETTLED)
            return false;
    return p->n > 0;
}

il_parade_place il_parade_pop(il_parade *p)
{
    il_parade_place *first = at(p, p->first), gone = *first;
    first->slice = (il_slice)IL_SLICE_INIT;
    first->pair = (il_pair)IL_PAIR_INIT;
    p->first++;
    p->n--;
    return gone;
}

void il_parade_place_free(il_parade_place *place)
{
    il_slice_free(&place->slice);
    il_pair_free(&place->pair);
}

static bool is_busy(il_parade *p)
{
    for (size_t k = p->first; k < p->first + p->n; k++)
        if (at(p, k)->state == IL_PAIR_MATCHING)
            return true;
    return false;
}

void il_parade_clear(il_parade *p)
{
    p->cancelled = true;
    while (is_busy(p))
        il_crew_help(&p->crew);
    drop_all(p);
    p->first = 0;
    p->cancelled = false;
}
