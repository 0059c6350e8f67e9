/* bands-blame.c - suspects gathered around a border, tried one by one, the worst named. */
#include "config.h"
#include "terrain/bands-blame.h"
#include "base/alloc.h"

/* Lines tried for one border; those of a face of one level count when it has so few borders;
 * faces looked at from the border. */
enum { SUSPECTS = 32, FEW_BORDERS = 16, NEAR_FACES = 16 };

il_status il_blamer_make(il_blamer *m, il_bands_graph *g, il_settler *s, il_error *err)
{
    *m = (il_blamer){ .graph = g, .settler = s };
    m->merger = il_alloc(g->n_faces, sizeof *m->merger);
    m->start = il_alloc(g->n_faces, sizeof *m->start);
    m->saved = il_alloc(g->n_faces, sizeof *m->saved);
    m->face_stamp = il_calloc(g->n_faces, sizeof *m->face_stamp);
    m->stamp = il_calloc(g->n, sizeof *m->stamp);
    return m->merger && m->start && m->saved && m->face_stamp && m->stamp ? IL_OK : il_fail_nomem(err);
}

void il_blamer_free(il_blamer *m)
{
    il_free(m->merger);
    il_free(m->start);
    il_free(m->saved);
    il_free(m->face_stamp);
    il_free(m->stamp);
    il_free(m->wrong);
    *m = (il_blamer){ 0 };
}

/* ---- what is wrong around some faces ------------------------------------------------- */

/* Borders that go wrong, levels that are missing, faces of three kinds of levels. */
typedef struct tally { long wrong, missing, many; } tally;

static bool is_fresh(uint32_t *stamp, uint32_t i, uint32_t epoch)
{
    bool fresh = stamp[i] != epoch;
    stamp[i] = epoch;
    return fresh;
}

static void count_face(il_blamer *m, uint32_t face, tally *t)
{
    il_bands_graph *g = m->graph;
    if (!is_fresh(m->face_stamp, face, m->face_epoch))
        return;
    uint32_t b;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);)
        if (is_fresh(m->stamp, b, m->epoch) && il_bands_graph_is_bad(g, b))
            t->wrong++;
    t->missing += il_around_missing(&g->around[face]);
    t->many += g->around[face].kinds > 2;
}

/* Of the faces that trials begin with and of all that were settled, as they are now. */
static tally count_wrong(il_blamer *m)
{
    tally t = { 0, 0, 0 };
    m->epoch++;
    m->face_epoch++;
    for (size_t i = 0; i < m->n_start; i++)
        count_face(m, m->graph->leader[m->start[i]], &t);
    for (size_t i = 0; i < m->settler->n; i++)
        count_face(m, m->graph->leader[m->settler->face[i]], &t);
    return t;
}

/* start: the leaders on the sides of LINE; saved: what is around them. */
static void begin_with(il_blamer *m, uint32_t line)
{
    il_bands_graph *g = m->graph;
    m->n_start = 0;
    m->face_epoch++;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        for (int side = 0; side < 2; side++) {
            uint32_t face = il_bands_graph_leader(g, b, side);
            if (is_fresh(m->face_stamp, face, m->face_epoch)) {
                m->saved[m->n_start] = g->around[face];
                m->start[m->n_start++] = face;
            }
        }
}

/* After lines went out or changed their level: everything that hangs on start. */
static void settle_again(il_blamer *m)
{
    il_bands_graph *g = m->graph;
    m->face_epoch++;
    for (size_t i = 0; i < m->n_start; i++)
        if (is_fresh(m->face_stamp, g->leader[m->start[i]], m->face_epoch))
            il_bands_graph_look_around(g, g->leader[m->start[i]]);
    il_settle_begin(m->settler);
    for (size_t i = 0; i < m->n_start; i++)
        il_settle_from(m->settler, g->leader[m->start[i]]);
}

/* After settle_again: count, let UNDO put things back, and say what got worse. */
static tally difference(tally after, tally before)
{
    return (tally){ after.wrong - before.wrong, after.missing - before.missing, after.many - before.many };
}

static void restore_around(il_blamer *m)
{
    for (size_t i = 0; i < m->n_start; i++)
        m->graph->around[m->start[i]] = m->saved[i];
}

/* The faces that were settled for trial, as they were before. */
static tally count_before(il_blamer *m)
{
    il_settler *s = m->settler;
    size_t n = s->n;
    il_settle_undo(s);
    s->n = n;
    tally t = count_wrong(m);
    s->n = 0;
    return t;
}

/* What gets worse without LINE.  A map that loses its last guide is no good. */
static tally try_without(il_blamer *m, uint32_t line)
{
    begin_with(m, line);
    size_t n = il_bands_graph_take_out(m->graph, line, m->merger);
    settle_again(m);
    tally after = count_wrong(m);
    after.wrong += 2 * (long)m->settler->n_lost;
    il_bands_graph_put_back(m->graph, line, m->merger, n);
    restore_around(m);
    return difference(after, count_before(m));
}

static void set_level(il_bands_graph *g, uint32_t line, int32_t level)
{
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        g->border[b].level = level;
}

static tally try_level(il_blamer *m, uint32_t line, int32_t level)
{
    il_bands_graph *g = m->graph;
    int32_t given = g->border[g->first_of_line[line]].level;
    begin_with(m, line);
    set_level(g, line, level);
    settle_again(m);
    tally after = count_wrong(m);
    after.wrong += 2 * (long)m->settler->n_lost;
    set_level(g, line, given);
    restore_around(m);
    return difference(after, count_before(m));
}

/* ---- suspects ------------------------------------------------------------------------- */

typedef struct suspects { uint32_t line[SUSPECTS]; size_t n; } suspects;

static void suspect(suspects *s, uint32_t line)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->line[i] == line)
            return;
    if (s->n < SUSPECTS)
        s->line[s->n++] = line;
}

/* Around FACE: lines that go wrong as well; a line that alone has the lowest or highest
 * level of several, for it alone says where the face lies. */
static void suspect_around(il_blamer *m, uint32_t face, suspects *s)
{
    il_bands_graph *g = m->graph;
    const il_around *a = &g->around[face];
    uint32_t b;
    bool alone[2] = { a->kinds > 1, a->kinds > 1 };
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        const il_border *border = &g->border[b];
        if (il_bands_graph_is_bad(g, b))
            suspect(s, border->line);
        for (int end = 0; end < 2; end++)
            if (border->level == (end ? a->high : a->low) && border->line != g->border[a->border[end]].line)
                alone[end] = false;
    }
    for (int end = 0; end < 2; end++)
        if (alone[end])
            suspect(s, g->border[a->border[end]].line);
}

typedef struct faces { uint32_t face[NEAR_FACES]; size_t n; } faces;

static void add_face(faces *f, uint32_t face)
{
    for (size_t i = 0; i < f->n; i++)
        if (f->face[i] == face)
            return;
    if (f->n < NEAR_FACES)
        f->face[f->n++] = face;
}

static size_t count_borders(il_bands_graph *g, uint32_t face)
{
    size_t n = 0;
    uint32_t b;
    for (il_round r = il_round_begin(g, face); n <= FEW_BORDERS && il_round_next(&r, &b);)
        n++;
    return n;
}

/* From both sides of B through faces of one level to those that say where these lie. */
static void find_suspects(il_blamer *m, uint32_t b, suspects *s)
{
    il_bands_graph *g = m->graph;
    faces near = { { 0 }, 0 };
    suspect(s, g->border[b].line);
    add_face(&near, il_bands_graph_leader(g, b, 0));
    add_face(&near, il_bands_graph_leader(g, b, 1));
    for (size_t i = 0; i < near.n; i++) {
        uint32_t face = near.face[i], beside;
        suspect_around(m, face, s);
        if (g->around[face].kinds != 1 || count_borders(g, face) > FEW_BORDERS)
            continue;
        for (il_round r = il_round_begin(g, face); il_round_next(&r, &beside);) {
            suspect(s, g->border[beside].line);
            add_face(&near, il_bands_graph_leader(g, beside, 0));
            add_face(&near, il_bands_graph_leader(g, beside, 1));
        }
    }
}

/* ---- the choice -------------------------------------------------------------------------- */

static int compare(tally a, tally b)
{
    if (a.wrong != b.wrong)
        return a.wrong < b.wrong ? -1 : 1;
    return (a.missing > b.missing) - (a.missing < b.missing);
}

static double length_of(const il_bands_graph *g, uint32_t line)
{
    double sum = 0;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        sum += g->border[b].length;
    return sum;
}

/* The lowest and highest level around FACE, LINE's not counted. */
static bool levels_beside(il_bands_graph *g, uint32_t face, uint32_t line, int32_t level[2])
{
    uint32_t b;
    bool any = false;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        const il_border *border = &g->border[b];
        if (border->line == line)
            continue;
        level[0] = any && level[0] < border->level ? level[0] : border->level;
        level[1] = any && level[1] > border->level ? level[1] : border->level;
        any = true;
    }
    return any;
}

/* The least that is wrong when LINE has another level, one near those beside it. */
static tally try_levels(il_blamer *m, uint32_t line)
{
    il_bands_graph *g = m->graph;
    uint32_t first = g->first_of_line[line];
    int32_t given = g->border[first].level, level[2] = { 0, 0 };
    tally best = { 0, 0, 0 };
    for (int side = 0; side < 2; side++) {
        if (!levels_beside(g, il_bands_graph_leader(g, first, side), line, level))
            continue;
        for (int k = 0; k < 6; k++) {
            int32_t to = level[k / 3] + k % 3 - 1;
            if (to < 0 || to >= (int32_t)g->n_levels || to == given)
                continue;
            tally t = try_level(m, line, to);
            t.missing += t.many;
            if (compare(t, best) < 0)
                best = t;
        }
    }
    return best;
}

/* The first N of S, from which all but those that do best are dropped. */
static void keep_best(suspects *s, const tally *t)
{
    size_t best = 0, n = 0;
    for (size_t i = 1; i < s->n; i++)
        if (compare(t[i], t[best]) < 0)
            best = i;
    for (size_t i = 0; i < s->n; i++)
        if (compare(t[i], t[best]) == 0)
            s->line[n++] = s->line[i];
    s->n = n;
}

uint32_t il_blame(il_blamer *m, uint32_t b)
{
    const il_bands_graph *g = m->graph;
    suspects s = { { 0 }, 0 };
    tally t[SUSPECTS];
    find_suspects(m, b, &s);
    for (size_t i = 0; s.n > 1 && i < s.n; i++)
        t[i] = try_without(m, s.line[i]);
    if (s.n > 1)
        keep_best(&s, t);
    for (size_t i = 0; s.n > 1 && i < s.n; i++)
        t[i] = try_levels(m, s.line[i]);
    if (s.n > 1)
        keep_best(&s, t);
    uint32_t best = s.line[0];
    for (size_t i = 1; i < s.n; i++) {
        double a = length_of(g, s.line[i]), least = length_of(g, best);
        if (a < least || (a == least && s.line[i] < best))
            best = s.line[i];
    }
    return best;
}

/* ---- the report ------------------------------------------------------------------------- */

/* The longer of two borders; UINT32_MAX is none. */
static uint32_t longer(const il_bands_graph *g, uint32_t a, uint32_t b)
{
    if (a == UINT32_MAX || b == UINT32_MAX)
        return a == UINT32_MAX ? b : a;
    if (g->border[a].length != g->border[b].length)
        return g->border[a].length > g->border[b].length ? a : b;
    return a < b ? a : b;
}

/* The longest border of FACE with another level than LEVEL that goes wrong as well; else its
 * lowest or highest. */
static uint32_t witness(il_bands_graph *g, uint32_t face, int32_t level, bool is_below, bool *is_wrong)
{
    uint32_t b, best = UINT32_MAX;
    for (il_round r = il_round_begin(g, face); g->work < g->patience && il_round_next(&r, &b);)
        if (g->border[b].level != level && il_bands_graph_is_bad(g, b))
            best = longer(g, best, b);
    *is_wrong = best != UINT32_MAX;
    if (best == UINT32_MAX && g->around[face].kinds > 1) {
        const il_around *a = &g->around[face];
        int end = is_below ? a->low == level : a->high != level;
        best = a->border[end];
    }
    return best;
}

/* The border of LINE that shows best what is wrong with it, and the face that says so. */
static uint32_t worst_border(const il_bands_graph *g, uint32_t line)
{
    uint32_t best = UINT32_MAX, any = UINT32_MAX;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++) {
        any = longer(g, any, b);
        if (il_bands_graph_is_bad(g, b))
            best = longer(g, best, b);
    }
    return best != UINT32_MAX ? best : any;
}

il_discord il_blame_discord(il_blamer *m, uint32_t line)
{
    il_bands_graph *g = m->graph;
    uint32_t b = worst_border(g, line), found = UINT32_MAX;
    const il_border *border = &g->border[b];
    uint32_t face[2] = { il_bands_graph_leader(g, b, 0), il_bands_graph_leader(g, b, 1) };
    il_discord d = { IL_DISCORD_SIDES, { line, UINT32_MAX }, { border->at[0], border->at[1] }, false };
    if (face[0] == face[1])
        return d;
    int teller = g->around[face[0]].kinds < 2; /* a face of more levels tells, one of a single level is told */
    il_lie lie = il_bands_graph_lie(g, face[teller], border->level);
    d.is_below = (lie == IL_LIE_FREE ? il_bands_graph_lie(g, face[!teller], border->level) : lie) == IL_LIE_BELOW;
    bool is_wrong = false;
    for (int side = 0; side < 2; side++) {
        bool wrong_too;
        uint32_t other = witness(g, face[side], border->level, d.is_below, &wrong_too);
        if (other == UINT32_MAX || (is_wrong && !wrong_too))
            continue;
        found = wrong_too && !is_wrong ? other : longer(g, found, other);
        is_wrong = wrong_too;
    }
    if (found != UINT32_MAX)
        d.line[1] = g->border[found].line;
    return d;
}

/* ---- what goes wrong ----------------------------------------------------------------------- */

static bool add_wrong(il_blamer *m, uint32_t b)
{
    if (!il_grow(&m->wrong, &m->cap_wrong, m->n_wrong + 1, sizeof *m->wrong))
        return false;
    m->wrong[m->n_wrong++] = b;
    return true;
}

il_status il_blame_find_wrong(il_blamer *m, il_error *err)
{
    for (uint32_t b = 0; b < m->graph->n; b++)
        if (il_bands_graph_is_bad(m->graph, b) && !add_wrong(m, b))
            return il_fail_nomem(err);
    return IL_OK;
}

il_status il_blame_take_out(il_blamer *m, uint32_t line, il_error *err)
{
    il_bands_graph *g = m->graph;
    begin_with(m, line);
    il_bands_graph_take_out(g, line, m->merger);
    settle_again(m);
    m->epoch++;
    for (size_t i = 0; i < m->settler->n; i++) {
        uint32_t b;
        for (il_round r = il_round_begin(g, m->settler->face[i]); il_round_next(&r, &b);) {
            if (is_fresh(m->stamp, b, m->epoch) && il_bands_graph_is_bad(g, b) && !add_wrong(m, b))
                return il_fail_nomem(err);
        }
    }
    return IL_OK;
}
