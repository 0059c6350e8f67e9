#include "config.h"
#include "region/join-ends.h"
#include "base/alloc.h"
#include "base/keymap.h"

il_status il_ends_init(il_ends *e, size_t n, il_error *err)
{
    *e = (il_ends)IL_ENDS_INIT;
    e->n = n;
    e->at = il_alloc(n, 2 * sizeof *e->at);
    e->partner = il_alloc(n, sizeof *e->partner);
    e->other = il_alloc(n, sizeof *e->other);
    e->place = il_alloc(n, sizeof *e->place);
    e->next = il_alloc(n, sizeof *e->next);
    e->alive = il_calloc(n, sizeof *e->alive);
    e->first = il_alloc(n, sizeof *e->first);
    if (e->at && e->partner && e->other && e->place && e->next && e->alive && e->first)
        return IL_OK;
    il_ends_free(e);
    return il_fail_nomem(err);
}

void il_ends_free(il_ends *e)
{
    il_free(e->at);
    il_free(e->partner);
    il_free(e->other);
    il_free(e->place);
    il_free(e->next);
    il_free(e->alive);
    il_free(e->first);
    *e = (il_ends)IL_ENDS_INIT;
}

/* Give every end its place. */
static bool find_places(il_ends *e)
{
    il_keymap at = IL_KEYMAP_INIT;
    bool ok = il_keymap_reserve(&at, e->n);
    for (uint32_t k = 0; k < e->n && ok; k++) {
        const double *p = e->at + 2 * (size_t)k;
        uint32_t *place = il_keymap_put(&at, il_keymap_double(p[0]), il_keymap_double(p[1]), (uint32_t)e->n_places);
        ok = place != NULL;
        if (!ok)
            break;
        if (*place == e->n_places)
            e->first[e->n_places++] = IL_NO_END;
        e->place[k] = *place;
        e->alive[*place]++;
        e->next[k] = e->first[*place];
        e->first[*place] = k;
        e->partner[k] = IL_NO_END;
        e->other[k] = k ^ 1;
    }
    il_keymap_free(&at);
    return ok;
}

static void join(il_ends *e, uint32_t a, uint32_t b)
{
    uint32_t far_a = e->other[a], far_b = e->other[b];
    e->partner[a] = b;
    e->partner[b] = a;
    e->other[far_a] = far_b;
    e->other[far_b] = far_a;
    e->alive[e->place[a]]--;
    e->alive[e->place[b]]--;
    e->n_joined++;
}

/* The free end at PLACE behind END in its list, or the first when that is IL_NO_END. */
static uint32_t next_free(const il_ends *e, uint32_t place, uint32_t end)
{
    end = end == IL_NO_END ? e->first[place] : e->next[end];
    while (e->partner[end] != IL_NO_END)
        end = e->next[end];
    return end;
}

/* What A and B, the far ends of something, come to: when they lie at one place, they
 * are joined, and then the two that may be left there, and so on.  A place has two
 * left once at most, so that its list is walked once. */
static void settle(il_ends *e, uint32_t a, uint32_t b)
{
    while (e->partner[a] == IL_NO_END && e->place[a] == e->place[b]) {
        uint32_t place = e->place[a];
        join(e, a, b);
        if (e->alive[place] != 2)
            return;
        uint32_t c = next_free(e, place, IL_NO_END), d = next_free(e, place, c);
        a = e->other[c];
        b = e->other[d];
        join(e, c, d);
    }
}

void il_ends_join_two(il_ends *e, uint32_t a, uint32_t b)
{
    uint32_t far_a = e->other[a], far_b = e->other[b];
    join(e, a, b);
    settle(e, far_a, far_b);
}

il_status il_ends_join(il_ends *e, il_error *err)
{
    if (!find_places(e))
        return il_fail_nomem(err);
    for (uint32_t place = 0; place < e->n_places; place++) {
        if (e->alive[place] != 2)
            continue;
        uint32_t a = next_free(e, place, IL_NO_END);
        il_ends_join_two(e, a, next_free(e, place, a));
    }
    return IL_OK;
}

size_t il_ends_knots(const il_ends *e)
{
    size_t n = 0;
    for (size_t place = 0; place < e->n_places; place++)
        n += e->alive[place] > 2;
    return n;
}
