#include "config.h"
#include "output/picture-grid.h"
#include "base/alloc.h"
#include "model/lattice.h"

#include <math.h>

/* A cell is about so large on the page, and a line has so many points a cell;
 * all groups share so many steps of a point by a lattice. */
static const double CELL = 17, STEPS_MOST = 2e7;
enum { POINTS_A_CELL = 6, CELLS_MOST = 60 };

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

/* The line of B on which coordinate K is low + part of the side; xy[2*n]. */
static void draw_line(il_svg_page *page, const il_svg_view *v, const il_box *b, int k, double part,
                      const il_fit *fit, double *xy, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        double along = (double)i / (double)(n - 1);
        xy[2 * i + (size_t)k] = (1 - part) * b->low[k] + part * b->high[k];
        xy[2 * i + (size_t)(1 - k)] = (1 - along) * b->low[1 - k] + along * b->high[1 - k];
    }
    il_fit_apply(fit, xy, n);
    il_svg_outline(page, v, xy, n, false);
}

static il_status draw_group(il_svg_page *page, const il_svg_view *v, const il_box *b, const size_t cells[2],
                            const il_fit *fit, bool whole, il_error *err)
{
    il_fit shown = *fit; /* borrows the lattices */
    shown.n_lattices = whole ? fit->n_lattices : 0;
    double *xy = il_alloc(2 * (CELLS_MOST * POINTS_A_CELL + 1), sizeof *xy);
    if (!xy)
        return il_fail_nomem(err);
    il_svg_path_begin(page, whole ? "" : "stroke-dasharray=\"2 4\"");
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i <= cells[k]; i++)
            draw_line(page, v, b, k, (double)i / (double)cells[k], &shown, xy, cells[1 - k] * POINTS_A_CELL + 1);
    il_svg_path_end(page);
    il_free(xy);
    return IL_OK;
}

il_status il_picture_grid(il_svg_page *page, const il_svg_view *v, const il_slice *upper, const il_pair *p,
                          il_grid_facts *facts, il_error *err)
{
    double steps = 0;
    il_status st = IL_OK;
    *facts = (il_grid_facts){ 0, 0, 0, 0 };
    il_svg_open(page, "fill=\"none\" stroke=\"" IL_GRID_COLOR "\" stroke-width=\".7\"");
    for (size_t i = 0; i < p->n_groups && st == IL_OK; i++) {
        const il_group *g = &p->group[i];
        if (!g->fitted || g->n_upper == 0)
            continue;
        facts->groups++;
        il_box b = group_box(upper, g);
        size_t cells[2] = { cells_of(il_box_side(&b, 0), v->scale), cells_of(il_box_side(&b, 1), v->scale) };
        bool whole = g->fit.n_lattices >= g->fit.steps;
        steps += (double)(2 * cells[0] * cells[1] * POINTS_A_CELL) * (double)(g->fit.n_lattices + 20);
        if (steps > STEPS_MOST)
            continue;
        st = draw_group(page, v, &b, cells, &g->fit, whole, err);
        facts->drawn++;
        facts->whole += whole;
        facts->steps += whole ? g->fit.n_lattices : 0;
    }
    il_svg_close(page);
    return st;
}
