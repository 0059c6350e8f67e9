/* bands.c - faces labelled: settled, contradictions left out, what is missing told. */
#include "config.h"
#include "terrain/bands.h"
#include "base/alloc.h"
#include "terrain/bands-blame.h"

#include <stdlib.h>

/* Once trials take too long, whatever goes wrong goes out, all at once, so many times. */
enum { ROUNDS = 16 };

typedef struct labelling {
    il_bands_graph graph;
    il_settler settler;
    il_trier trier;
    il_bands *out;
} labelling;

void il_bands_free(il_bands *b)
{
    il_free(b->band);
    il_free(b->discord);
    il_free(b->left_out);
    *b = (il_bands)IL_BANDS_INIT;
}

static il_status add_discord(il_bands *out, il_discord d, il_error *err)
{
    if (!il_grow(&out->discord, &out->cap_discords, out->n_discords + 1, sizeof *out->discord))
        return il_fail_nomem(err);
    out->discord[out->n_discords++] = d;
    return IL_OK;
}

/* ---- contradictions ------------------------------------------------------------------- */

/* Lines with one face on both sides end inside the map: they say nothing of it. */
static il_status leave_out_loose_ends(labelling *l, il_error *err)
{
    il_bands_graph *g = &l->graph;
    il_status st = IL_OK;
    for (size_t b = 0; st == IL_OK && b < g->n; b++) {
        const il_border *border = &g->border[b];
        if (border->face[0] != border->face[1] || g->out[border->line])
            continue;
        il_bands_graph_take_out(g, border->line, l->trier.merger);
        const il_discord d = { IL_DISCORD_SIDES, { border->line, UINT32_MAX }, { border->at[0], border->at[1] }, false };
        st = add_discord(l->out, d, err);
    }
    return st;
}

static il_status demand_guide(const labelling *l, il_error *err)
{
    if (l->settler.n_lost == 0)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, 0, "lines of one height only do not tell which side of them is higher: "
                                       "name it with --high left or --high right");
}

static il_status settle_all(labelling *l, il_error *err)
{
    il_bands_graph *g = &l->graph;
    il_bands_graph_look_all_around(g);
    il_settle_begin(&l->settler);
    for (uint32_t f = 0; f < g->n_faces; f++)
        if (g->leader[f] == f && il_around_is_single(&g->around[f]))
            il_settle_from(&l->settler, f);
    return demand_guide(l, err);
}

/* All lines that go wrong as things are; *ANY: were there some? */
static il_status leave_out_wrong(labelling *l, bool *any, il_error *err)
{
    il_bands_graph *g = &l->graph;
    size_t before = l->out->n_discords;
    uint32_t last = UINT32_MAX;
    il_status st = IL_OK;
    for (uint32_t b = 0; st == IL_OK && b < g->n; b++)
        if (g->border[b].line != last && il_bands_graph_is_bad(g, b)) {
            last = g->border[b].line;
            st = add_discord(l->out, il_blame_discord(g, last), err);
        }
    *any = l->out->n_discords > before;
    for (size_t i = before; st == IL_OK && i < l->out->n_discords; i++)
        il_bands_graph_take_out(g, l->out->discord[i].line[0], l->trier.merger);
    return st != IL_OK || !*any ? st : settle_all(l, err);
}

static il_status leave_out_in_rounds(labelling *l, il_error *err)
{
    bool any = true;
    il_status st = IL_OK;
    for (int round = 0; st == IL_OK && any && round < ROUNDS; round++)
        st = leave_out_wrong(l, &any, err);
    if (st == IL_OK && any)
        st = il_fail(err, IL_E_INPUT, 0, "too many lines contradict one another: their heights make no map");
    return st;
}

static il_status remedy(labelling *l, uint32_t b, il_error *err)
{
    il_trier *t = &l->trier;
    il_remedy r = il_blame(t, b);
    if (r.line == UINT32_MAX)
        return il_trier_widen(t, r.face, r.wide, err);
    il_status st = add_discord(l->out, il_blame_discord(&l->graph, r.line), err);
    if (st == IL_OK)
        st = il_trier_take_out(t, r.line, err);
    return st == IL_OK ? demand_guide(l, err) : st;
}

static il_status remedy_all(labelling *l, il_error *err)
{
    il_bands_graph *g = &l->graph;
    il_trier *t = &l->trier;
    il_status st = il_trier_find_wrong(t, err);
    for (size_t i = 0; st == IL_OK && i < t->n_wrong && g->work < g->patience; i++)
        while (st == IL_OK && g->work < g->patience && il_bands_graph_is_bad(g, t->wrong[i]))
            st = remedy(l, t->wrong[i], err);
    return st == IL_OK && g->work >= g->patience ? leave_out_in_rounds(l, err) : st;
}

/* ---- the outcome ---------------------------------------------------------------------- */

static il_band band_of(const il_bands_graph *g, uint32_t leader)
{
    const il_around *a = &g->around[leader];
    if (!il_around_is_single(a))
        return il_around_band(a, g->n_levels);
    return g->lie[leader] == IL_LIE_ABOVE ? (il_band){ a->low, a->low + 1 } : (il_band){ a->low - 1, a->low };
}

static il_status tell_missing(const il_bands_graph *g, uint32_t leader, il_bands *out, il_error *err)
{
    const il_around *a = &g->around[leader];
    if (il_around_missing(a) == 0)
        return IL_OK;
    const il_border *low = &g->border[a->border[0]], *high = &g->border[a->border[1]];
    const il_discord d = { IL_DISCORD_MISSING, { low->line, high->line }, { low->at[0], low->at[1] }, false };
    return add_discord(out, d, err);
}

/* A border of a level between the others of its face. */
typedef struct middle { int32_t level; uint32_t border; double length; } middle;

static int by_level(const void *pa, const void *pb)
{
    const middle *a = pa, *b = pb;
    if (a->level != b->level)
        return a->level < b->level ? -1 : 1;
    if (a->length != b->length)
        return a->length > b->length ? -1 : 1;
    return (a->border > b->border) - (a->border < b->border);
}

/* The longest border of each level between the lowest and the highest. */
static il_status tell_many(il_bands_graph *g, uint32_t leader, il_bands *out, il_error *err)
{
    const il_around *a = &g->around[leader];
    middle *m = NULL;
    size_t n = 0, cap = 0;
    uint32_t b;
    il_status st = IL_OK;
    if (a->kinds < 3)
        return IL_OK;
    for (il_round r = il_round_begin(g, leader); st == IL_OK && il_round_next(&r, &b);)
        if (g->border[b].level != a->low && g->border[b].level != a->high) {
            if (!il_grow(&m, &cap, n + 1, sizeof *m))
                st = il_fail_nomem(err);
            else
                m[n++] = (middle){ g->border[b].level, b, g->border[b].length };
        }
    if (n > 0)
        qsort(m, n, sizeof *m, by_level);
    const il_border *low = &g->border[a->border[0]];
    for (size_t i = 0; st == IL_OK && i < n; i++)
        if (i == 0 || m[i].level != m[i - 1].level)
            st = add_discord(out, (il_discord){ IL_DISCORD_MANY, { low->line, g->border[m[i].border].line },
                                                { low->at[0], low->at[1] }, false }, err);
    il_free(m);
    return st;
}

static int by_line(const void *pa, const void *pb)
{
    const il_discord *a = pa, *b = pb;
    if (a->line[0] != b->line[0])
        return a->line[0] < b->line[0] ? -1 : 1;
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    for (int i = 0; i < 2; i++)
        if (a->at[i] != b->at[i])
            return a->at[i] < b->at[i] ? -1 : 1;
    return (a->line[1] > b->line[1]) - (a->line[1] < b->line[1]);
}

static il_status tell(labelling *l, il_error *err)
{
    il_bands_graph *g = &l->graph;
    il_bands *out = l->out;
    il_status st = IL_OK;
    for (uint32_t f = 0; st == IL_OK && f < g->n_faces; f++) {
        out->band[f] = band_of(g, g->leader[f]);
        if (g->leader[f] != f)
            continue;
        st = tell_missing(g, f, out, err);
        if (st == IL_OK)
            st = tell_many(g, f, out, err);
    }
    for (size_t i = 0; i < g->n_lines; i++) {
        out->left_out[i] = g->out[i];
        out->n_left_out += g->out[i];
    }
    if (out->n_discords > 0)
        qsort(out->discord, out->n_discords, sizeof *out->discord, by_line);
    return st;
}

static il_status label(labelling *l, il_error *err)
{
    il_status st = leave_out_loose_ends(l, err);
    if (st == IL_OK)
        st = settle_all(l, err);
    if (st == IL_OK)
        st = remedy_all(l, err);
    return st == IL_OK ? tell(l, err) : st;
}

il_status il_bands_label(il_bands *out, const il_border *border, size_t n, size_t n_faces, size_t n_lines,
                         size_t n_levels, il_side high, il_error *err)
{
    labelling l = { .out = out };
    *out = (il_bands)IL_BANDS_INIT;
    out->band = il_alloc(n_faces, sizeof *out->band);
    out->left_out = il_calloc(n_lines, 1);
    il_status st = out->band && out->left_out ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_bands_graph_make(&l.graph, border, n, n_faces, n_lines, n_levels, high, err);
    if (st == IL_OK)
        st = il_settler_make(&l.settler, &l.graph, err);
    if (st == IL_OK)
        st = il_trier_make(&l.trier, &l.graph, &l.settler, err);
    if (st == IL_OK)
        st = label(&l, err);
    il_trier_free(&l.trier);
    il_settler_free(&l.settler);
    il_bands_graph_free(&l.graph);
    if (st != IL_OK)
        il_bands_free(out);
    return st;
}
