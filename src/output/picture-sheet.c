/* picture-sheet.c - all pairs of a stack as small multiples. */
#include "config.h"
#include "output/picture-match.h"
#include "output/picture-tiles.h"

#include <math.h>

static const il_pair no_pair = IL_PAIR_INIT;

/* The worst of the groups' means, and the largest of all; false where no group says. */
static bool worst_residual(const il_pair *p, double *mean, double *largest)
{
    bool any = false;
    *mean = *largest = 0;
    for (size_t k = 0; k < p->n_groups; k++) {
        const il_fit *f = &p->group[k].fit;
        if (!p->group[k].fitted)
            continue;
        any = true;
        *mean = fmax(*mean, fmax(f->residual_up_mean, f->residual_down_mean));
        *largest = fmax(*largest, fmax(f->residual_up_max, f->residual_down_max));
    }
    return any;
}

static bool has_residuals(const il_figure *f)
{
    double mean, largest;
    bool any = false;
    for (size_t k = 1; k < f->n; k++)
        any = any || worst_residual(&f->level[k].below, &mean, &largest);
    return any;
}

static void describe(il_label *l, const il_figure *f)
{
    il_picture_extent(l, f);
    il_label_words(l, ", ");
    il_label_counted(l, f->n_pairs, "pair record");
    il_label_words(l, ", at one scale, each centred. Under a pair its number, that of the lower slice, and heights");
    if (has_residuals(f)) {
        il_label_words(l, "; then the distance of \xCF\x86(upper) from lower and back, mean (largest), of the worst group, in ");
        il_label_words(l, il_unit_name(f->head.unit));
    }
    il_label_words(l, ".");
}

static void describe_residual(il_label *l, const il_level *upper)
{
    double mean, largest;
    if (!upper->has_pair) {
        il_label_words(l, "not matched");
    } else if (upper->below.gap) {
        il_label_words(l, "gap: not joined");
    } else if (worst_residual(&upper->below, &mean, &largest)) {
        il_label_number(l, mean, 2);
        il_label_words(l, " (");
        il_label_number(l, largest, 2);
        il_label_words(l, ")");
    } else {
        il_label_words(l, upper->below.matcher == IL_MATCHER_NONE ? "matcher none" : "no residual");
    }
}

/* The two lines under a pair. */
static void caption_of(const il_figure *f, size_t k, il_label *heights, il_label *residual)
{
    heights->n = residual->n = 0;
    il_label_words(heights, "z ");
    il_label_height(heights, f->level[k].slice.z, f->spacing);
    il_label_words(heights, " to ");
    il_label_height(heights, f->level[k + 1].slice.z, f->spacing);
    describe_residual(residual, &f->level[k + 1]);
}

static double widest_caption(const il_figure *f)
{
    double most = 0;
    il_label heights, residual;
    for (size_t k = 0; k + 1 < f->n; k++) {
        caption_of(f, k, &heights, &residual);
        most = fmax(most, il_picture_caption_width(f->first + k, heights.text, residual.text));
    }
    return most;
}

static il_status draw_pair(il_svg_page *page, const il_figure *f, size_t k, const il_panel *at, double scale, il_error *err)
{
    const il_level *lower = &f->level[k], *upper = &f->level[k + 1];
    const il_pair *pair = upper->has_pair ? &upper->below : &no_pair;
    il_label heights, residual;
    il_box box = il_box_empty();
    il_arcs arcs = IL_ARCS_INIT;
    il_box_add_slice(&box, &lower->slice);
    il_box_add_slice(&box, &upper->slice);
    il_svg_view v = il_view_centred(at, &box, scale);
    il_svg_rectangle(page, at->x, at->y, at->width, at->height, "fill=\"none\" stroke=\"#e4e4e4\" stroke-width=\".75\"");
    il_status st = il_arcs_open(&arcs, &lower->slice, &upper->slice, pair, err);
    if (st == IL_OK)
        st = il_picture_match(page, &v, &arcs, &il_match_small, NULL, err);
    caption_of(f, k, &heights, &residual);
    il_picture_tile_caption(page, at, f->first + k, heights.text, residual.text);
    il_arcs_free(&arcs);
    return st;
}

/* How wide and high the largest pair is. */
static void largest_window(const il_figure *f, double side[2])
{
    side[0] = side[1] = 0;
    for (size_t k = 0; k + 1 < f->n; k++) {
        il_box b = il_box_empty();
        il_box_add_slice(&b, &f->level[k].slice);
        il_box_add_slice(&b, &f->level[k + 1].slice);
        if (il_box_is_empty(&b))
            continue;
        side[0] = fmax(side[0], il_box_side(&b, 0));
        side[1] = fmax(side[1], il_box_side(&b, 1));
    }
    if (!(side[0] > 0))
        side[0] = side[1] = 1;
}

static il_match_drawn look_for(const il_figure *f)
{
    il_match_drawn d = { false, false, false, { 0, 0, 0 } };
    for (size_t k = 1; k < f->n; k++) {
        const il_pair *p = &f->level[k].below;
        d.matched = d.matched || p->n_matches > 0;
        d.inserted = d.inserted || p->n_insertions > 0;
        d.cut = d.cut || p->n_cuts > 0;
        for (size_t i = 0; i < p->n_unmatched; i++)
            d.unmatched[p->unmatched[i].event]++;
    }
    return d;
}

il_status il_picture_draw_pairs(il_svg_page *page, const il_figure *f, il_error *err)
{
    double side[2];
    il_label words = IL_LABEL_INIT;
    il_legend_entry entry[IL_MATCH_ENTRIES];
    const il_match_drawn drawn = look_for(f);
    describe(&words, f);
    il_picture_heading(page, f, words.text);
    largest_window(f, side);
    page->y += 8;
    page->tolerance = 0.15;
    il_picture_legend(page, entry, il_picture_match_legend(entry, &drawn));
    il_tiles tiles = il_tiles_arrange(f->n - 1, side[0], side[1], 2, widest_caption(f));
    il_picture_scale_bar(page, IL_PAGE_MARGIN, page->y + 14, 120, tiles.scale, f->head.unit);
    page->y += 32;
    il_status st = IL_OK;
    for (size_t k = 0; k + 1 < f->n && st == IL_OK; k++) {
        il_panel at = il_tiles_panel(&tiles, page, k);
        st = draw_pair(page, f, k, &at, tiles.scale, err);
    }
    il_tiles_end(&tiles, page);
    return st == IL_OK ? il_output_status(page->body, err) : st;
}
