/* picture-pair.c - one pair in the manner of the paper's Figure 5: the contours
 * as they lie with what corresponds, and the plane as phi deforms it. */
#include "config.h"
#include "base/alloc.h"
#include "output/picture-bonds.h"
#include "output/picture-branch.h"
#include "output/picture-grid.h"
#include "output/picture-match.h"
#include "output/picture-table.h"

#include <math.h>
#include <string.h>

static const il_pair no_pair = IL_PAIR_INIT;

/* ---- layout -------------------------------------------------------------- */

enum { TITLE = 22, BETWEEN = 24 };
static const double TALLEST = 560, LOWEST = 140;

/* Panels (a) and (b) side by side, or one under another where the window is
 * flat; only (a) without a deformation.  All in one window, at one scale. */
typedef struct layout {
    il_box window;
    il_panel a, b;
    double scale, bottom;
} layout;

/* Both slices, phi of the upper one, and a margin. */
static il_box window_of(const il_arcs *a)
{
    il_box w = il_box_empty();
    il_box_add_slice(&w, a->lower);
    il_box_add_slice(&w, a->upper);
    for (size_t k = 0; k < a->pair->n_phi; k++)
        il_box_add(&w, a->pair->phi[k].x, a->pair->phi[k].y);
    if (il_box_is_empty(&w))
        return w;
    double margin = 0.06 * fmax(il_box_side(&w, 0), il_box_side(&w, 1));
    for (int k = 0; k < 2; k++) {
        w.low[k] -= margin;
        w.high[k] += margin;
    }
    return w;
}

static layout arrange(const il_arcs *a, double top, bool deformed)
{
    layout l = { .window = window_of(a) };
    double shape = il_box_side(&l.window, 1) / il_box_side(&l.window, 0);
    bool beside = deformed && shape > 0.45;
    double width = beside ? (IL_PAGE_INNER - BETWEEN) / 2.0 : IL_PAGE_INNER;
    double height = il_box_is_empty(&l.window) ? LOWEST : fmin(fmax(width * shape, LOWEST), TALLEST);
    l.a = (il_panel){ IL_PAGE_MARGIN, top + TITLE, width, ceil(height) };
    l.b = l.a;
    if (beside)
        l.b.x += width + BETWEEN;
    else if (deformed)
        l.b.y += l.a.height + TITLE + BETWEEN / 2.0;
    l.bottom = l.b.y + l.b.height;
    l.scale = il_view_scale(&l.a, il_box_side(&l.window, 0), il_box_side(&l.window, 1));
    return l;
}

static void draw_panel(il_svg_page *page, const il_panel *p, const char *title)
{
    il_svg_text(page, p->x, p->y - 8, "font-size=\"13\" fill=\"" IL_INK "\"", title);
    il_svg_rectangle(page, p->x, p->y, p->width, p->height, "fill=\"none\" stroke=\"#ddd\" stroke-width=\".75\"");
}

/* ---- the deformed plane -------------------------------------------------- */

/* phi of every upper ring, as the record has it. */
static il_status draw_deformed_rings(il_svg_page *page, const il_svg_view *v, const il_arcs *a, il_error *err)
{
    size_t most = 0;
    for (size_t i = 0; i < a->upper->n; i++)
        most = a->row[i + 1] - a->row[i] > most ? a->row[i + 1] - a->row[i] : most;
    double *xy = il_alloc(2 * most + 2, sizeof *xy);
    if (!xy)
        return il_fail_nomem(err);
    il_svg_path_begin(page, "fill=\"none\" stroke=\"" IL_UPPER_COLOR "\" stroke-width=\"1.3\"");
    for (size_t i = 0; i < a->upper->n; i++) {
        size_t n = a->row[i + 1] - a->row[i];
        for (size_t k = 0; k < n; k++) {
            const il_phi_point *p = &a->pair->phi[a->row[i] + k];
            xy[2 * k] = p->x;
            xy[2 * k + 1] = p->y;
        }
        il_svg_outline(page, v, xy, n, true);
    }
    il_svg_path_end(page);
    il_free(xy);
    return IL_OK;
}

static il_status draw_deformed(il_svg_page *page, const layout *l, const il_arcs *a, il_grid_facts *grid, il_error *err)
{
    il_svg_view v = il_view_centred(&l->b, &l->window, l->scale);
    draw_panel(page, &l->b, "(b)  upper slice carried by \xCF\x86 to the plane of the lower");
    il_svg_open_clipped(page, l->b.x, l->b.y, l->b.width, l->b.height);
    il_status st = il_picture_grid(page, &v, a->upper, a->pair, grid, err);
    il_svg_close(page);
    il_picture_slice(page, &v, a->lower, "fill=\"" IL_LOWER_COLOR "\" fill-opacity=\".1\" fill-rule=\"evenodd\"",
                     " stroke=\"" IL_LOWER_BAND "\" stroke-width=\"4.5\"");
    il_picture_slice(page, &v, a->upper, "fill=\"none\"", " stroke=\"" IL_UPPER_COLOR "\" stroke-width=\".8\" "
                     "stroke-dasharray=\"2 3\" stroke-opacity=\".75\"");
    return st == IL_OK ? draw_deformed_rings(page, &v, a, err) : st;
}

/* ---- words --------------------------------------------------------------- */

static void name_slice(il_label *l, const il_figure *f, size_t k)
{
    const il_slice *s = &f->level[k].slice;
    il_label_count(l, f->first + k);
    il_label_words(l, " (z ");
    il_label_height(l, s->z, f->spacing);
    il_label_words(l, " ");
    il_label_words(l, il_unit_name(f->head.unit));
    il_label_words(l, s->n == 0 ? ", empty)" : ")");
}

static void describe(il_label *l, const il_figure *f)
{
    il_label_words(l, "Pair ");
    il_label_count(l, f->first);
    il_label_words(l, ": lower slice ");
    name_slice(l, f, 0);
    il_label_words(l, ", upper slice ");
    name_slice(l, f, 1);
    if (!f->level[1].has_pair)
        il_label_words(l, ". Not matched: the stream has no record of this pair (isoloft match adds it).");
    else if (f->level[1].below.gap)
        il_label_words(l, ". A gap: nothing joins them.");
    else if (f->level[1].below.matcher == IL_MATCHER_NONE)
        il_label_words(l, ". Matcher none: compared as they lie.");
    else
        il_label_words(l, ". Matched by free-form deformation.");
}

static void tell_grids(il_svg_page *page, const il_grid_facts *g)
{
    il_label l = IL_LABEL_INIT;
    if (g->drawn < g->groups) {
        il_label_words(&l, "Grids are shown for ");
        il_label_count(&l, g->drawn);
        il_label_words(&l, " of ");
        il_label_count(&l, g->groups);
        il_label_words(&l, " groups; more would be too many lines. ");
    }
    if (g->divided > 0) {
        il_label_words(&l, "Without a grid, for each piece of a cut region has a \xCF\x86 of its own: ");
        il_label_counted(&l, g->divided, "group");
        il_label_words(&l, ".");
    }
    il_picture_paragraph(page, IL_PAGE_INNER, l.text);
}

static void describe_side(il_label *l, const char *side, double matched, double length)
{
    il_label_number(l, length > 0 ? fmin(100 * matched / length, 100) : 0, 3);
    il_label_words(l, " % of the ");
    il_label_words(l, side);
    il_label_words(l, " outline");
}

static size_t count_matches(const il_pair *p)
{
    size_t n = 0;
    for (size_t i = 0; i < p->n_matches; i++)
        n += !p->match[i].as_they_lie;
    return n;
}

/* Groups whose surface does not follow phi. */
static void tell_untrusted(il_label *l, const il_pair *p)
{
    size_t n = 0;
    for (size_t i = 0; i < p->n_groups; i++)
        n += p->group[i].fitted && !il_fit_is_trusted(&p->group[i].fit);
    if (n == 0)
        return;
    il_label_words(l, " Lofted as they lie, for \xCF\x86 is not trusted: ");
    il_label_counted(l, n, "group");
    il_label_words(l, ".");
}

static void tell_matches(il_svg_page *page, const il_pair *p, const il_match_facts *m)
{
    static const char *const events[] = { " branch", " cap", " hole" };
    il_label l = IL_LABEL_INIT;
    if (count_matches(p) > 0) {
        il_label_counted(&l, count_matches(p), "pair");
        il_label_words(&l, " of matched arcs: ");
        describe_side(&l, "lower", m->lower_matched, m->lower_length);
        il_label_words(&l, ", ");
        describe_side(&l, "upper", m->upper_matched, m->upper_length);
    } else {
        il_label_words(&l, "The record has no matched arcs");
    }
    const char *before = ". Unmatched arcs: ";
    for (int e = 0; e < 3; e++) {
        if (m->unmatched[e] == 0)
            continue;
        il_label_words(&l, before);
        il_label_count(&l, m->unmatched[e]);
        il_label_words(&l, events[e]);
        before = ", ";
    }
    il_label_words(&l, ".");
    tell_untrusted(&l, p);
    il_picture_paragraph(page, IL_PAGE_INNER, l.text);
}

/* What the grids show, in the legend: phi where the record has its lattices. */
static size_t grid_legend(il_legend_entry *entry, const il_grid_facts *g, il_label *words)
{
    size_t n = 0;
    if (g->whole > 0) {
        il_label_words(words, "grid of the upper plane under \xCF\x86, ");
        il_label_counted(words, g->steps, "lattice step");
        entry[n++] = (il_legend_entry){ "stroke=\"" IL_GRID_COLOR "\" stroke-width=\"1\"", words->text, IL_SWATCH_LINE };
    }
    if (g->whole < g->drawn)
        entry[n++] = (il_legend_entry){ "stroke=\"" IL_GRID_COLOR "\" stroke-width=\"1\" stroke-dasharray=\"2 4\"",
                                        "under the global step alone: no lattices in the record", IL_SWATCH_LINE };
    return n;
}

static void draw_legend(il_svg_page *page, const il_pair *p, const il_match_facts *m, const il_grid_facts *grid,
                        const il_skeleton *links)
{
    il_legend l = { .n = 0 };
    il_label words = IL_LABEL_INIT;
    il_match_drawn d = { count_matches(p) > 0, p->n_insertions > 0, p->n_cuts > 0, { 0, 0, 0 } };
    il_legend_entry *entry = l.entry;
    memcpy(d.unmatched, m->unmatched, sizeof d.unmatched);
    l.n = il_picture_match_legend(entry, &d);
    if (links)
        il_legend_add_bonds(&l, links, 1.4);
    size_t n = l.n;
    if (p->n_phi > 0) {
        entry[n++] = (il_legend_entry){ "stroke=\"" IL_LOWER_BAND "\" stroke-width=\"4.5\"", "lower contour in (b)", IL_SWATCH_LINE };
        entry[n++] = (il_legend_entry){ "stroke=\"" IL_UPPER_COLOR "\" stroke-width=\"1.3\"", "\xCF\x86(upper contour)", IL_SWATCH_LINE };
        entry[n++] = (il_legend_entry){ "stroke=\"" IL_UPPER_COLOR "\" stroke-width=\".8\" stroke-dasharray=\"2 3\"",
                                        "upper contour as it lies", IL_SWATCH_LINE };
    }
    n += grid_legend(entry + n, grid, &words);
    il_picture_legend(page, entry, n);
}

/* The links of the pair between the centres of regions; *LINKS is null where there is no need
 * of lines. */
static il_status draw_links(il_svg_page *page, const il_svg_view *v, const il_figure *f, il_skeleton *s,
                            const il_skeleton **links, il_error *err)
{
    il_status st = il_skeleton_find(s, f, err);
    *links = st == IL_OK && il_picture_links(page, v, s) > 0 ? s : NULL;
    return st;
}

static void tell_links(il_svg_page *page, const il_figure *f, const il_pair *pair)
{
    il_label l = IL_LABEL_INIT;
    il_picture_tell_links(&l, pair, f->level[1].slice.z - f->level[0].slice.z, f->head.unit);
    il_picture_paragraph(page, IL_PAGE_INNER, l.text);
}

il_status il_picture_draw_pair(il_svg_page *page, const il_figure *f, il_error *err)
{
    const il_pair *pair = f->level[1].has_pair ? &f->level[1].below : &no_pair;
    bool deformed = pair->n_phi > 0;
    il_label words = IL_LABEL_INIT;
    il_arcs arcs = IL_ARCS_INIT;
    il_match_facts facts = { 0 };
    il_grid_facts grid = { 0 };
    il_skeleton skeleton = IL_SKELETON_INIT;
    const il_skeleton *links = NULL;
    page->tolerance = 0.1;
    describe(&words, f);
    il_picture_heading(page, f, words.text);
    il_status st = il_arcs_open(&arcs, &f->level[0].slice, &f->level[1].slice, pair, err);
    if (st != IL_OK)
        return st;
    layout l = arrange(&arcs, page->y + 10, deformed);
    il_svg_view v = il_view_centred(&l.a, &l.window, l.scale);
    draw_panel(page, &l.a, deformed ? "(a)  the slices as they lie" : "The slices as they lie");
    st = il_picture_match(page, &v, &arcs, &il_match_large, &facts, err);
    if (st == IL_OK)
        st = draw_links(page, &v, f, &skeleton, &links, err);
    if (st == IL_OK && deformed)
        st = draw_deformed(page, &l, &arcs, &grid, err);
    page->y = l.bottom + 20;
    if (!il_box_is_empty(&l.window))
        il_picture_scale_bar(page, IL_PAGE_MARGIN, page->y, 160, l.scale, f->head.unit);
    page->y += 18;
    draw_legend(page, pair, &facts, &grid, links);
    page->y += 4;
    if (pair->n_phi + pair->n_matches + pair->n_unmatched > 0)
        tell_matches(page, pair, &facts);
    tell_links(page, f, pair);
    tell_grids(page, &grid);
    il_picture_fit_table(page, pair, f->head.unit);
    il_skeleton_free(&skeleton);
    il_arcs_free(&arcs);
    return st == IL_OK ? il_output_status(page->body, err) : st;
}
