#include "config.h"
#include "output/picture-match.h"
#include "output/picture-branch.h"

#include <math.h>

const il_match_style il_match_large = {
    .contour = "stroke-width=\"1\"", .matched = "fill=\"none\" stroke-width=\"2\"",
    .unmatched = "fill=\"none\" stroke-width=\"4\"", .links = "fill=\"none\" stroke-width=\".6\"",
    .inserted = "fill=\"none\" stroke=\"" IL_INK "\" stroke-width=\"4\"", .link_spacing = 10, .links_most = 1000,
    .cut_width = 3 };

const il_match_style il_match_small = {
    .contour = "stroke-width=\".5\"", .matched = "fill=\"none\" stroke-width=\"1\"",
    .unmatched = "fill=\"none\" stroke-width=\"2\"", .links = "fill=\"none\" stroke-width=\".4\"",
    .inserted = "fill=\"none\" stroke=\"" IL_INK "\" stroke-width=\"2\"", .link_spacing = 7, .links_most = 200,
    .cut_width = 1.6 };

/* By il_event: a colour, and dashes that tell them apart without it. */
static const char *const event_attributes[3] = {
    [IL_EVENT_BRANCH] = "stroke=\"#009e73\" stroke-linecap=\"butt\"",
    [IL_EVENT_CAP] = "stroke=\"#aa4499\" stroke-linecap=\"butt\" stroke-dasharray=\"7 2.5\"",
    [IL_EVENT_HOLE] = "stroke=\"#b8860b\" stroke-linecap=\"butt\" stroke-dasharray=\"2.5 2\""
};

static void draw_slices(il_svg_page *page, const il_svg_view *v, const il_arcs *a, const il_match_style *style)
{
    il_svg_open(page, style->contour);
    il_picture_slice(page, v, a->lower,
        "fill=\"" IL_LOWER_COLOR "\" fill-opacity=\".15\" fill-rule=\"evenodd\"", " stroke=\"" IL_LOWER_COLOR "\"");
    il_picture_slice(page, v, a->upper,
        "fill=\"" IL_UPPER_COLOR "\" fill-opacity=\".13\" fill-rule=\"evenodd\"", " stroke=\"" IL_UPPER_COLOR "\"");
    il_svg_close(page);
}

/* Thin lines from the upper slice to the lower; MATCHED: the length of its arcs. */
static il_status draw_links(il_svg_page *page, const il_svg_view *v, il_arcs *a, const il_match_style *style,
                            double matched, il_error *err)
{
    double spacing = fmax(style->link_spacing / v->scale, matched / style->links_most);
    il_status st = IL_OK;
    il_svg_open(page, style->links);
    il_svg_path_begin(page, "stroke=\"" IL_LINK_COLOR "\"");
    for (size_t k = 0; k < a->pair->n_matches && st == IL_OK; k++) {
        size_t n = 0;
        if (a->pair->match[k].as_they_lie)
            continue;
        st = il_arcs_links(a, &a->pair->match[k], spacing, spacing / 16, &n, err);
        for (size_t i = 0; i < n; i++) {
            double from[2], to[2];
            il_svg_view_point(v, a->sample[4 * i], a->sample[4 * i + 1], from);
            il_svg_view_point(v, a->sample[4 * i + 2], a->sample[4 * i + 3], to);
            il_svg_segment(page, from[0], from[1], to[0], to[1]);
        }
    }
    il_svg_path_end(page);
    il_svg_close(page);
    return st;
}

static il_status draw_matched(il_svg_page *page, const il_svg_view *v, il_arcs *a, bool upper, double *length, il_error *err)
{
    il_status st = IL_OK;
    *length = 0;
    il_svg_path_begin(page, upper ? "stroke=\"" IL_UPPER_COLOR "\"" : "stroke=\"" IL_LOWER_COLOR "\"");
    for (size_t k = 0; k < a->pair->n_matches && st == IL_OK; k++) {
        const il_match *m = &a->pair->match[k];
        if (m->as_they_lie)
            continue;
        st = il_arcs_trace(a, upper, upper ? &m->upper : &m->lower, &a->from, err);
        if (st == IL_OK) {
            il_svg_outline(page, v, a->from.xy, a->from.n, false);
            *length += il_trace_length(a->from.xy, a->from.n);
        }
    }
    il_svg_path_end(page);
    return st;
}

static il_status draw_unmatched(il_svg_page *page, const il_svg_view *v, il_arcs *a, il_event event, size_t *count, il_error *err)
{
    il_status st = IL_OK;
    *count = 0;
    il_svg_path_begin(page, event_attributes[event]);
    for (size_t k = 0; k < a->pair->n_unmatched && st == IL_OK; k++) {
        const il_unmatched *u = &a->pair->unmatched[k];
        if (u->event != event)
            continue;
        st = il_arcs_trace(a, u->upper, &u->arc, &a->from, err);
        if (st == IL_OK)
            il_svg_outline(page, v, a->from.xy, a->from.n, false);
        ++*count;
    }
    il_svg_path_end(page);
    return st;
}

/* Dots: lines of no length with round ends. */
static void draw_insertions(il_svg_page *page, const il_svg_view *v, const il_pair *p, const il_match_style *style)
{
    il_svg_path_begin(page, style->inserted);
    for (size_t k = 0; k < p->n_insertions; k++) {
        double at[2];
        il_svg_view_point(v, p->insertion[k].x, p->insertion[k].y, at);
        il_svg_segment(page, at[0], at[1], at[0] + .01, at[1]);
    }
    il_svg_path_end(page);
}

static double slice_length(const il_slice *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++)
        sum += il_ring_length(&s->ring[i]);
    return sum;
}

il_status il_picture_match(il_svg_page *page, const il_svg_view *v, il_arcs *a, const il_match_style *style,
                           il_match_facts *facts, il_error *err)
{
    il_match_facts unused;
    il_match_facts *f = facts ? facts : &unused;
    *f = (il_match_facts){ .lower_length = slice_length(a->lower), .upper_length = slice_length(a->upper) };
    draw_slices(page, v, a, style);
    il_status st = il_picture_pieces(page, v, a->lower, a->pair, false, err);
    if (st == IL_OK)
        st = il_picture_pieces(page, v, a->upper, a->pair, true, err);
    il_svg_open(page, style->matched);
    if (st == IL_OK)
        st = draw_matched(page, v, a, false, &f->lower_matched, err);
    if (st == IL_OK)
        st = draw_matched(page, v, a, true, &f->upper_matched, err);
    il_svg_close(page);
    if (st == IL_OK)
        st = draw_links(page, v, a, style, f->upper_matched, err);
    il_svg_open(page, style->unmatched);
    for (int e = 0; e < 3 && st == IL_OK; e++)
        st = draw_unmatched(page, v, a, (il_event)e, &f->unmatched[e], err);
    il_svg_close(page);
    il_picture_cuts(page, v, a->pair, style->cut_width);
    draw_insertions(page, v, a->pair, style);
    return st;
}

size_t il_picture_match_legend(il_legend_entry *entry, const il_match_drawn *d)
{
    static const il_legend_entry lower =
        { "fill=\"" IL_LOWER_COLOR "\" fill-opacity=\".15\" stroke=\"" IL_LOWER_COLOR "\" stroke-width=\"1\"",
          "lower slice", IL_SWATCH_BOX };
    static const il_legend_entry upper =
        { "fill=\"" IL_UPPER_COLOR "\" fill-opacity=\".13\" stroke=\"" IL_UPPER_COLOR "\" stroke-width=\"1\"",
          "upper slice", IL_SWATCH_BOX };
    static const il_legend_entry thick =
        { "stroke=\"" IL_UPPER_COLOR "\" stroke-width=\"2\"", "matched arcs (thick)", IL_SWATCH_LINE };
    static const il_legend_entry link =
        { "stroke=\"" IL_LINK_COLOR "\" stroke-width=\".8\"", "upper point to its partner", IL_SWATCH_LINE };
    static const il_legend_entry dot =
        { "stroke=\"" IL_INK "\" stroke-width=\"4\" stroke-dasharray=\".01 9\"", "inserted points", IL_SWATCH_LINE };
    static const il_legend_entry cut = { il_cut_attributes, "cut on the medial axis", IL_SWATCH_LINE };
    static const il_legend_entry piece = { il_piece_attributes, "pieces of a cut region", IL_SWATCH_BOX };
    static const il_legend_entry events[3] = {
        { "stroke=\"#009e73\" stroke-width=\"4\" stroke-linecap=\"butt\"", "unmatched: branch", IL_SWATCH_LINE },
        { "stroke=\"#aa4499\" stroke-width=\"4\" stroke-linecap=\"butt\" stroke-dasharray=\"7 2.5\"", "unmatched: cap", IL_SWATCH_LINE },
        { "stroke=\"#b8860b\" stroke-width=\"4\" stroke-linecap=\"butt\" stroke-dasharray=\"2.5 2\"", "unmatched: hole", IL_SWATCH_LINE }
    };
    size_t n = 0;
    entry[n++] = lower;
    entry[n++] = upper;
    if (d->matched)
        entry[n++] = thick;
    if (d->matched)
        entry[n++] = link;
    if (d->inserted)
        entry[n++] = dot;
    if (d->cut)
        entry[n++] = cut;
    if (d->cut)
        entry[n++] = piece;
    for (int e = 0; e < 3; e++)
        if (d->unmatched[e] > 0)
            entry[n++] = events[e];
    return n;
}
