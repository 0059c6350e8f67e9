/* bands-trial.c - a change made, what hangs on it settled and counted, and the change undone. */
#include "config.h"
#include "terrain/bands-trial.h"
#include "base/alloc.h"

il_status il_trier_make(il_trier *t, il_bands_graph *g, il_settler *s, il_error *err)
{
    *t = (il_trier){ .graph = g, .settler = s };
    t->merger = il_alloc(g->n_faces, sizeof *t->merger);
    t->start = il_alloc(g->n_faces, sizeof *t->start);
    t->saved = il_alloc(g->n_faces, sizeof *t->saved);
    t->face_stamp = il_calloc(g->n_faces, sizeof *t->face_stamp);
    t->stamp = il_calloc(g->n, sizeof *t->stamp);
    return t->merger && t->start && t->saved && t->face_stamp && t->stamp ? IL_OK : il_fail_nomem(err);
}

void il_trier_free(il_trier *t)
{
    il_free(t->merger);
    il_free(t->start);
    il_free(t->saved);
    il_free(t->face_stamp);
    il_free(t->stamp);
    il_free(t->wrong);
    *t = (il_trier){ 0 };
}

/* ---- what is wrong around some faces ------------------------------------------------- */

static bool is_fresh(uint32_t *stamp, uint32_t i, uint32_t epoch)
{
    bool fresh = stamp[i] != epoch;
    stamp[i] = epoch;
    return fresh;
}

static void count_face(il_trier *t, uint32_t face, il_tally *sum)
{
    il_bands_graph *g = t->graph;
    const il_around *a = &g->around[face];
    if (!is_fresh(t->face_stamp, face, t->face_epoch))
        return;
    uint32_t b, line = UINT32_MAX;
    bool is_turn = false;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        if (is_fresh(t->stamp, b, t->epoch) && il_bands_graph_is_bad(g, b))
            sum->wrong++;
        is_turn |= line != UINT32_MAX && g->border[b].line != line;
        line = g->border[b].line;
    }
    sum->missing += il_around_missing(a) + (a->kinds > 2);
    sum->turns += is_turn && a->kinds == 1;
}

/* Of the faces that a trial begins with and all that were settled, as they are now. */
static il_tally count_wrong(il_trier *t)
{
    il_tally sum = { 0, 0, 0, false };
    t->epoch++;
    t->face_epoch++;
    for (size_t i = 0; i < t->n_start; i++)
        count_face(t, t->graph->leader[t->start[i]], &sum);
    for (size_t i = 0; i < t->settler->n; i++)
        count_face(t, t->graph->leader[t->settler->face[i]], &sum);
    return sum;
}

/* ---- beginning and end of a change ------------------------------------------------------ */

static void begin_with_face(il_trier *t, uint32_t face)
{
    t->saved[t->n_start] = t->graph->around[face];
    t->start[t->n_start++] = face;
}

/* The leaders on the sides of LINE, beside those there are. */
static void begin_with_line(il_trier *t, uint32_t line)
{
    const il_bands_graph *g = t->graph;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        for (int side = 0; side < 2; side++) {
            uint32_t face = il_bands_graph_leader(g, b, side);
            if (is_fresh(t->face_stamp, face, t->face_epoch))
                begin_with_face(t, face);
        }
}

static void begin(il_trier *t)
{
    t->n_start = 0;
    t->face_epoch++;
}

/* An end of a face stays wide when it stays at its level. */
static void keep_wide(const il_around *before, il_around *now)
{
    if ((before->kinds == 1) != (now->kinds == 1))
        return;
    if (before->low == now->low)
        now->wide |= before->wide & IL_WIDE_LOW;
    if (before->high == now->high)
        now->wide |= before->wide & IL_WIDE_HIGH;
}

static void look_around_again(il_trier *t)
{
    il_bands_graph *g = t->graph;
    t->face_epoch++;
    for (size_t i = 0; i < t->n_start; i++)
        if (is_fresh(t->face_stamp, g->leader[t->start[i]], t->face_epoch))
            il_bands_graph_look_around(g, g->leader[t->start[i]]);
    for (size_t i = 0; i < t->n_start; i++)
        keep_wide(&t->saved[i], &g->around[g->leader[t->start[i]]]);
}

static void settle_again(il_trier *t)
{
    il_settle_begin(t->settler);
    for (size_t i = 0; i < t->n_start; i++)
        il_settle_from(t->settler, t->graph->leader[t->start[i]]);
}

static il_tally count_after(il_trier *t)
{
    settle_again(t);
    il_tally after = count_wrong(t);
    after.wrong += 2 * (long)t->settler->n_lost;
    return after;
}

/* With the change itself undone: the rest as well.  What got worse? */
static il_tally end(il_trier *t, il_tally after)
{
    il_settler *s = t->settler;
    size_t n = s->n;
    for (size_t i = 0; i < t->n_start; i++)
        t->graph->around[t->start[i]] = t->saved[i];
    il_settle_undo(s);
    s->n = n;
    il_tally before = count_wrong(t);
    s->n = 0;
    return (il_tally){ after.wrong - before.wrong, after.missing - before.missing, after.turns - before.turns,
                       after.wrong == 0 && after.missing == 0 };
}

/* ---- trials ---------------------------------------------------------------------------------- */

il_tally il_try_without(il_trier *t, uint32_t line)
{
    begin(t);
    begin_with_line(t, line);
    size_t n = il_bands_graph_take_out(t->graph, line, t->merger);
    look_around_again(t);
    il_tally after = count_after(t);
    il_bands_graph_put_back(t->graph, line, t->merger, n);
    return end(t, after);
}

il_tally il_try_wide(il_trier *t, uint32_t face, int wide)
{
    begin(t);
    begin_with_face(t, face);
    t->graph->around[face].wide |= wide;
    return end(t, count_after(t));
}

static int32_t level_of(const il_bands_graph *g, uint32_t line)
{
    return g->border[g->first_of_line[line]].level;
}

static void set_level(il_bands_graph *g, uint32_t line, int32_t level)
{
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        g->border[b].level = level;
}

il_tally il_try_level(il_trier *t, uint32_t line, int32_t level)
{
    int32_t given = level_of(t->graph, line);
    begin(t);
    begin_with_line(t, line);
    set_level(t->graph, line, level);
    look_around_again(t);
    il_tally after = count_after(t);
    set_level(t->graph, line, given);
    return end(t, after);
}

il_tally il_try_exchange(il_trier *t, uint32_t line, uint32_t other)
{
    il_bands_graph *g = t->graph;
    int32_t given = level_of(g, line), given_other = level_of(g, other);
    begin(t);
    begin_with_line(t, line);
    begin_with_line(t, other);
    set_level(g, line, given_other);
    set_level(g, other, given);
    look_around_again(t);
    il_tally after = count_after(t);
    set_level(g, line, given);
    set_level(g, other, given_other);
    return end(t, after);
}

/* ---- for good ---------------------------------------------------------------------------------- */

static il_status add_wrong(il_trier *t, uint32_t b, il_error *err)
{
    if (!il_grow(&t->wrong, &t->cap_wrong, t->n_wrong + 1, sizeof *t->wrong))
        return il_fail_nomem(err);
    t->wrong[t->n_wrong++] = b;
    return IL_OK;
}

static il_status add_what_is_wrong(il_trier *t, il_error *err)
{
    il_status st = IL_OK;
    t->epoch++;
    for (size_t i = 0; i < t->settler->n; i++) {
        uint32_t b;
        for (il_round r = il_round_begin(t->graph, t->settler->face[i]); st == IL_OK && il_round_next(&r, &b);)
            if (is_fresh(t->stamp, b, t->epoch) && il_bands_graph_is_bad(t->graph, b))
                st = add_wrong(t, b, err);
    }
    return st;
}

il_status il_trier_take_out(il_trier *t, uint32_t line, il_error *err)
{
    begin(t);
    begin_with_line(t, line);
    il_bands_graph_take_out(t->graph, line, t->merger);
    look_around_again(t);
    settle_again(t);
    return add_what_is_wrong(t, err);
}

il_status il_trier_widen(il_trier *t, uint32_t face, int wide, il_error *err)
{
    begin(t);
    begin_with_face(t, face);
    t->graph->around[face].wide |= wide;
    settle_again(t);
    return add_what_is_wrong(t, err);
}

il_status il_trier_find_wrong(il_trier *t, il_error *err)
{
    il_status st = IL_OK;
    for (uint32_t b = 0; st == IL_OK && b < t->graph->n; b++)
        if (il_bands_graph_is_bad(t->graph, b))
            st = add_wrong(t, b, err);
    return st;
}
