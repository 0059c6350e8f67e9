#include "config.h"
#include "output/picture-grid.h"
#include "base/alloc.h"
#include "model/lattice.h"

#include <math.h>

/* A cell is about so large on the page and is cut into so many pieces, and again
 * in halves where phi draws a piece out.  All groups share so many steps of a
 * point by a lattice. */
static const double CELL = 17, PIECE = 4, STEPS_MOST = 1e8;
enum { PIECES = 6, HALVINGS = 6, CELLS_MOST = 60 };

/* Round the group's rings, with a margin of a tenth. */
static il_box group_box(const il_slice *upper, const il_group *g)
{
    il_box b = il_box_empty();
    for (size_t i = 0; i < g->n_upper; i++) {
        const il_ring *r = &upper->ring[g->upper[i]];
        for (size_t k = 0; k < r->n; k++)
            il_box_add(&b, r->xy[2 * k], r->xy[2 * k + 1]);
    }
    double margin = fmax(il_box_side(&b, 0), il_box_side(&b, 1)) / 10;
    for (int k = 0; k < 2; k++) {
        b.low[k] -= margin;
        b.high[k] += margin;
    }
    return b;
}

static size_t cells_of(double side, double scale)
{
    double n = ceil(side * scale / CELL);
    return n < 2 ? 2 : n < CELLS_MOST ? (size_t)n : CELLS_MOST;
}

/* The line of box on which coordinate k is level; its image xy[2*n]. */
typedef struct line {
    const il_svg_view *view;
    const il_fit *fit;
    const il_box *box;
    int k;
    double level;
    double *xy;
    size_t n, cap;
} line;

static void image_of(const line *l, double along, double at[2])
{
    int other = 1 - l->k;
    at[l->k] = l->level;
    at[other] = (1 - along) * l->box->low[other] + along * l->box->high[other];
    il_fit_apply(l->fit, at, 1);
}

static bool add_point(line *l, const double at[2])
{
    if (!il_grow(&l->xy, &l->cap, 2 * l->n + 2, sizeof *l->xy))
        return false;
    l->xy[2 * l->n] = at[0];
    l->xy[2 * l->n++ + 1] = at[1];
    return true;
}

/* Add what lies behind FROM, up to TO; places along the line, and their images. */
static bool add_piece(line *l, double from, const double a[2], double to, const double b[2], int halvings)
{
    double p[2], q[2], m[2];
    il_svg_view_point(l->view, a[0], a[1], p);
    il_svg_view_point(l->view, b[0], b[1], q);
    if (halvings == 0 || hypot(q[0] - p[0], q[1] - p[1]) <= PIECE)
        return add_point(l, b);
    double middle = (from + to) / 2;
    image_of(l, middle, m);
    return add_piece(l, from, a, middle, m, halvings - 1) && add_piece(l, middle, m, to, b, halvings - 1);
}

static bool draw_line(il_svg_page *page, line *l, size_t cells)
{
    double a[2], b[2];
    size_t pieces = cells * PIECES;
    l->n = 0;
    image_of(l, 0, a);
    bool ok = add_point(l, a);
    for (size_t i = 0; i < pieces && ok; i++) {
        double from = (double)i / (double)pieces, to = (double)(i + 1) / (double)pieces;
        image_of(l, to, b);
        ok = add_piece(l, from, a, to, b, HALVINGS);
        a[0] = b[0];
        a[1] = b[1];
    }
    il_svg_outline(page, l->view, l->xy, l->n, false);
    return ok;
}

static il_status draw_group(il_svg_page *page, const il_svg_view *v, const il_box *b, const size_t cells[2],
                            const il_fit *fit, bool whole, il_error *err)
{
    il_fit shown = *fit; /* borrows the lattices */
    shown.n_lattices = whole ? fit->n_lattices : 0;
    line l = { .view = v, .fit = &shown, .box = b };
    bool ok = true;
    il_svg_path_begin(page, whole ? "" : "stroke-dasharray=\"2 4\"");
    for (l.k = 0; l.k < 2; l.k++) {
        for (size_t i = 0; i <= cells[l.k] && ok; i++) {
            double part = (double)i / (double)cells[l.k];
            l.level = (1 - part) * b->low[l.k] + part * b->high[l.k];
            ok = draw_line(page, &l, cells[1 - l.k]);
        }
    }
    il_svg_path_end(page);
    il_free(l.xy);
    return ok ? IL_OK : il_fail_nomem(err);
}

static size_t rings_of(const il_group *g, bool upper, const uint32_t **ring)
{
    *ring = upper ? g->upper : g->lower;
    return upper ? g->n_upper : g->n_lower;
}

/* group_of[ring], below *N: the groups of P of the rings of one slice; null without memory. */
static uint32_t *groups_of_rings(const il_pair *p, bool upper, size_t *n)
{
    const uint32_t *ring;
    *n = 0;
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = rings_of(&p->group[i], upper, &ring); k-- > 0;)
            *n = ring[k] >= *n ? (size_t)ring[k] + 1 : *n;
    uint32_t *group_of = il_alloc(*n, sizeof *group_of);
    for (size_t r = 0; group_of && r < *n; r++)
        group_of[r] = UINT32_MAX;
    for (uint32_t i = 0; group_of && i < p->n_groups; i++)
        for (size_t k = rings_of(&p->group[i], upper, &ring); k-- > 0;)
            group_of[ring[k]] = i;
    return group_of;
}

/* divided[n_groups]: has a ring of the group a cut? */
static bool *find_divided(const il_pair *p)
{
    bool *divided = il_calloc(p->n_groups, sizeof *divided);
    for (int upper = 0; upper < 2 && divided && p->n_cuts > 0; upper++) {
        size_t n;
        uint32_t *group_of = groups_of_rings(p, upper == 1, &n);
        for (size_t i = 0; group_of && i < p->n_cuts; i++)
            if (p->cut[i].upper == (upper == 1) && p->cut[i].ring < n && group_of[p->cut[i].ring] != UINT32_MAX)
                divided[group_of[p->cut[i].ring]] = true;
        if (!group_of) {
            il_free(divided);
            divided = NULL;
        }
        il_free(group_of);
    }
    return divided;
}

il_status il_picture_grid(il_svg_page *page, const il_svg_view *v, const il_slice *upper, const il_pair *p,
                          il_grid_facts *facts, il_error *err)
{
    double steps = 0;
    il_status st = IL_OK;
    bool *divided = find_divided(p);
    *facts = (il_grid_facts){ 0 };
    if (!divided)
        return il_fail_nomem(err);
    il_svg_open(page, "fill=\"none\" stroke=\"" IL_GRID_COLOR "\" stroke-width=\".7\"");
    for (size_t i = 0; i < p->n_groups && st == IL_OK; i++) {
        const il_group *g = &p->group[i];
        if (!g->fitted || g->n_upper == 0)
            continue;
        facts->divided += divided[i];
        if (divided[i])
            continue;
        facts->groups++;
        il_box b = group_box(upper, g);
        size_t cells[2] = { cells_of(il_box_side(&b, 0), v->scale), cells_of(il_box_side(&b, 1), v->scale) };
        bool whole = g->fit.n_lattices >= g->fit.steps;
        steps += (double)(2 * cells[0] * cells[1] * PIECES) * (double)(g->fit.n_lattices + 20);
        if (steps > STEPS_MOST)
            continue;
        st = draw_group(page, v, &b, cells, &g->fit, whole, err);
        facts->drawn++;
        facts->whole += whole;
        facts->steps += whole ? g->fit.n_lattices : 0;
    }
    il_svg_close(page);
    il_free(divided);
    return st;
}
