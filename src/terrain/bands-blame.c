/* bands-blame.c - suspects gathered around a border, tried one by one, the worst named. */
#include "config.h"
#include "terrain/bands-blame.h"

/* Remedies tried for one border; faces looked at from it; lines of a face of one level count
 * when it has so few borders; lines of which pairs are tried. */
enum { SUSPECTS = 16, NEAR_FACES = 16, FEW_BORDERS = 16, EXCHANGED = 4 };

typedef struct suspects { il_remedy remedy[SUSPECTS]; size_t n; } suspects;

/* ---- suspects ------------------------------------------------------------------------- */

static void suspect(suspects *s, il_remedy r)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->remedy[i].line == r.line && s->remedy[i].face == r.face && s->remedy[i].wide == r.wide)
            return;
    if (s->n < SUSPECTS)
        s->remedy[s->n++] = r;
}

static void suspect_line(suspects *s, uint32_t line)
{
    suspect(s, (il_remedy){ line, UINT32_MAX, 0 });
}

/* FACE says where it lies of LEVEL: it need not, if it is wide.  Where directions say so,
 * nothing is missing. */
static void suspect_wide(const il_bands_graph *g, uint32_t face, int32_t level, suspects *s)
{
    const il_around *a = &g->around[face];
    if (il_around_is_single(a) && g->directed[face])
        return;
    int wide = a->kinds == 1 ? IL_WIDE_LOW | IL_WIDE_HIGH
             : level == a->low ? IL_WIDE_LOW : level == a->high ? IL_WIDE_HIGH : 0;
    if ((wide & ~a->wide) != 0)
        suspect(s, (il_remedy){ UINT32_MAX, face, wide });
}

/* Faces to look at. */
typedef struct faces { uint32_t face[NEAR_FACES]; size_t n; } faces;

static void add_face(faces *f, uint32_t face)
{
    for (size_t i = 0; i < f->n; i++)
        if (f->face[i] == face)
            return;
    if (f->n < NEAR_FACES)
        f->face[f->n++] = face;
}

static void add_faces_of(const il_bands_graph *g, uint32_t b, faces *f)
{
    add_face(f, il_bands_graph_leader(g, b, 0));
    add_face(f, il_bands_graph_leader(g, b, 1));
}

/* Around FACE: lines that go wrong as well, whose other faces are to be looked at; a line
 * that alone has the lowest or highest level of several, for it alone says where the face lies. */
static void suspect_around(il_bands_graph *g, uint32_t face, suspects *s, faces *near)
{
    const il_around *a = &g->around[face];
    uint32_t b;
    bool alone[2] = { a->kinds > 1, a->kinds > 1 };
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        const il_border *border = &g->border[b];
        if (il_bands_graph_is_bad(g, b)) {
            suspect_line(s, border->line);
            add_faces_of(g, b, near);
        }
        for (int end = 0; end < 2; end++)
            if (border->level == (end ? a->high : a->low) && border->line != g->border[a->border[end]].line)
                alone[end] = false;
    }
    for (int end = 0; end < 2; end++)
        if (alone[end])
            suspect_line(s, g->border[a->border[end]].line);
}

static size_t count_borders(il_bands_graph *g, uint32_t face)
{
    size_t n = 0;
    uint32_t b;
    for (il_round r = il_round_begin(g, face); n <= FEW_BORDERS && il_round_next(&r, &b);)
        n++;
    return n;
}

/* From both sides of B, and those beside them, through lines that go wrong, and through faces
 * of one level to those that say where these lie. */
static void find_suspects(il_bands_graph *g, uint32_t b, suspects *s)
{
    faces near = { { 0 }, 0 };
    suspect_line(s, g->border[b].line);
    add_faces_of(g, b, &near);
    for (size_t i = 0; i < near.n; i++) {
        uint32_t face = near.face[i], beside;
        bool is_single = il_around_is_single(&g->around[face]);
        suspect_wide(g, face, g->border[b].level, s);
        suspect_around(g, face, s, &near);
        if ((i >= 2 && !is_single) || count_borders(g, face) > FEW_BORDERS)
            continue;
        for (il_round r = il_round_begin(g, face); il_round_next(&r, &beside);) {
            if (is_single)
                suspect_line(s, g->border[beside].line);
            add_faces_of(g, beside, &near);
        }
    }
}

/* ---- comparing ------------------------------------------------------------------------------ */

static int compare(il_tally a, il_tally b)
{
    if (a.wrong != b.wrong)
        return a.wrong < b.wrong ? -1 : 1;
    if (a.missing != b.missing)
        return a.missing < b.missing ? -1 : 1;
    return (a.turns > b.turns) - (a.turns < b.turns);
}

/* Of S, tried with outcome T, only those stay that do best. */
static void keep_best(suspects *s, const il_tally *t)
{
    size_t best = 0, n = 0;
    for (size_t i = 1; i < s->n; i++)
        if (compare(t[i], t[best]) < 0)
            best = i;
    for (size_t i = 0; i < s->n; i++)
        if (compare(t[i], t[best]) == 0)
            s->remedy[n++] = s->remedy[i];
    s->n = n;
}

static double length_of(const il_bands_graph *g, uint32_t line)
{
    double sum = 0;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        sum += g->border[b].length;
    return sum;
}

static bool is_better(const il_bands_graph *g, il_remedy a, il_remedy b)
{
    if (a.line == UINT32_MAX || b.line == UINT32_MAX)
        return a.line != b.line ? a.line == UINT32_MAX : a.face < b.face || (a.face == b.face && a.wide < b.wide);
    double length_a = length_of(g, a.line), length_b = length_of(g, b.line);
    return length_a < length_b || (length_a == length_b && a.line < b.line);
}

/* ---- other levels ----------------------------------------------------------------------------- */

/* The lowest and highest level around FACE, LINE's not counted: it is looked at anew only
 * if LINE may be alone at an end. */
static bool levels_beside(il_bands_graph *g, uint32_t face, uint32_t line, int32_t level[2])
{
    const il_around *a = &g->around[face];
    level[0] = a->low;
    level[1] = a->high;
    if (g->border[a->border[0]].line != line && g->border[a->border[1]].line != line)
        return true;
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

/* May a line of level TO bound a face whose others have from level[0] to level[1]? */
static bool goes_beside(int32_t to, const int32_t level[2])
{
    if (level[1] <= level[0] + 1)
        return to >= level[1] - 1 && to <= level[0] + 1;
    return to >= level[0] && to <= level[1] && (to <= level[0] + 1 || to >= level[1] - 1);
}

/* The best that comes of giving LINE another level, one that may be between those on both
 * sides; of keeping its own when there is nothing better. */
static il_tally try_levels(il_trier *t, uint32_t line)
{
    il_bands_graph *g = t->graph;
    uint32_t first = g->first_of_line[line];
    int32_t given = g->border[first].level, level[2][2];
    il_tally best = { 0, 0, 0, false };
    size_t n = 0;
    for (int side = 0; side < 2; side++)
        n += levels_beside(g, il_bands_graph_leader(g, first, side), line, level[n]);
    for (int32_t k = 0; n > 0 && k < 6; k++) {
        int32_t to = level[0][k / 3] + k % 3 - 1;
        bool was_tried = k >= 3 && to <= level[0][0] + 1;
        if (to < 0 || to >= (int32_t)g->n_levels || to == given || was_tried || !goes_beside(to, level[0]) ||
            !goes_beside(to, level[n - 1]))
            continue;
        il_tally tally = il_try_level(t, line, to);
        if (compare(tally, best) < 0)
            best = tally;
    }
    return best;
}

/* Suspects of which some change makes all around clean; what the best change brings. */
typedef struct cleaners { suspects who; il_tally best; } cleaners;

static void add_cleaner(cleaners *c, il_tally tally, il_remedy r)
{
    if (!tally.is_clean || (c->who.n > 0 && compare(tally, c->best) > 0))
        return;
    if (c->who.n == 0 || compare(tally, c->best) < 0)
        *c = (cleaners){ .best = tally };
    suspect(&c->who, r);
}

/* Those that need another level. */
static cleaners find_wrong_heights(il_trier *t, const suspects *s)
{
    cleaners c = { .who = { .n = 0 } };
    for (size_t i = 0; i < s->n && t->graph->work < t->graph->patience; i++)
        if (s->remedy[i].line != UINT32_MAX)
            add_cleaner(&c, try_levels(t, s->remedy[i].line), s->remedy[i]);
    return c;
}

static bool goes_wrong(const il_bands_graph *g, uint32_t line)
{
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++)
        if (il_bands_graph_is_bad(g, b))
            return true;
    return false;
}

/* Those that go wrong and need to exchange levels with another that does. */
static cleaners find_exchanged(il_trier *t, const suspects *s)
{
    cleaners c = { .who = { .n = 0 } };
    suspects wrong = { .n = 0 };
    for (size_t i = 0; i < s->n && wrong.n < EXCHANGED; i++)
        if (s->remedy[i].line != UINT32_MAX && goes_wrong(t->graph, s->remedy[i].line))
            suspect(&wrong, s->remedy[i]);
    for (size_t i = 0; i < wrong.n; i++)
        for (size_t k = i + 1; k < wrong.n && t->graph->work < t->graph->patience; k++) {
            il_tally tally = il_try_exchange(t, wrong.remedy[i].line, wrong.remedy[k].line);
            add_cleaner(&c, tally, wrong.remedy[i]);
            add_cleaner(&c, tally, wrong.remedy[k]);
        }
    return c;
}

/* A single line explains it better than two, unless these explain more. */
static void keep_cleaners(il_trier *t, suspects *s)
{
    cleaners single = find_wrong_heights(t, s), pair = find_exchanged(t, s);
    if (pair.who.n > 0 && (single.who.n == 0 || pair.best.wrong < single.best.wrong))
        *s = pair.who;
    else if (single.who.n > 0)
        *s = single.who;
}

/* ---- the choice ----------------------------------------------------------------------------------- */

/* A line that is left out counts like one that is missing. */
static il_tally try_remedy(il_trier *t, il_remedy r)
{
    il_tally tally = r.line == UINT32_MAX ? il_try_wide(t, r.face, r.wide) : il_try_without(t, r.line);
    tally.missing += r.line != UINT32_MAX;
    tally.turns = 0;
    return tally;
}

il_remedy il_blame(il_trier *t, uint32_t b)
{
    suspects s = { .n = 0 };
    il_tally tally[SUSPECTS];
    find_suspects(t->graph, b, &s);
    keep_cleaners(t, &s);
    if (t->graph->work >= t->graph->patience)
        return (il_remedy){ t->graph->border[b].line, UINT32_MAX, 0 };
    for (size_t i = 0; i < s.n; i++)
        tally[i] = try_remedy(t, s.remedy[i]);
    keep_best(&s, tally);
    for (size_t i = 0; s.n > 1 && i < s.n; i++)
        tally[i] = s.remedy[i].line == UINT32_MAX ? il_try_wide(t, s.remedy[i].face, s.remedy[i].wide)
                                                  : try_levels(t, s.remedy[i].line);
    if (s.n > 1)
        keep_best(&s, tally);
    il_remedy best = s.remedy[0];
    for (size_t i = 1; i < s.n; i++)
        if (is_better(t->graph, s.remedy[i], best))
            best = s.remedy[i];
    return best;
}

/* ---- the report ----------------------------------------------------------------------------------- */

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
    if (best == UINT32_MAX && !il_around_is_single(&g->around[face])) {
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

il_discord il_blame_discord(il_bands_graph *g, uint32_t line)
{
    uint32_t b = worst_border(g, line), found = UINT32_MAX;
    const il_border *border = &g->border[b];
    uint32_t face[2] = { il_bands_graph_leader(g, b, 0), il_bands_graph_leader(g, b, 1) };
    il_discord d = { IL_DISCORD_SIDES, { line, UINT32_MAX }, { border->at[0], border->at[1] }, false };
    if (face[0] == face[1])
        return d;
    int teller = il_around_is_single(&g->around[face[0]]); /* a face of more levels tells, one of a single level is told */
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
