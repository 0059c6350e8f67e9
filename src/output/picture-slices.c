/* picture-slices.c - all slices of a stack side by side, at one scale and in one
 * window, so that what moves is seen to move. */
#include "config.h"
#include "output/picture-parts.h"
#include "output/picture-tiles.h"

#include <math.h>

static void describe(il_label *l, const il_figure *f)
{
    il_picture_extent(l, f);
    il_label_words(l, f->n_slices > 1 ? ". From left to right and down by rising z, in one window." : ".");
}

static il_label caption_of(const il_figure *f, size_t k)
{
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "z ");
    il_label_height(&l, f->level[k].slice.z, f->spacing);
    return l;
}

static double widest_caption(const il_figure *f)
{
    double most = 0;
    for (size_t k = 0; k < f->n; k++)
        most = fmax(most, il_picture_caption_width(f->first + k, caption_of(f, k).text, NULL));
    return most;
}

/* "12" and "z 24.5" under the drawing; "empty" in it where there is nothing.  Isolines
 * bound nothing yet. */
static void draw_slice(il_svg_page *page, const il_figure *f, size_t k, const il_panel *at, const il_box *window,
                       double scale)
{
    const il_slice *s = &f->level[k].slice;
    il_svg_view v = il_view_centred(at, window, scale);
    il_svg_rectangle(page, at->x, at->y, at->width, at->height, "fill=\"none\" stroke=\"#e4e4e4\" stroke-width=\".75\"");
    il_picture_slice(page, &v, s, f->head.kind == IL_KIND_TERRAIN ? "fill=\"none\"" :
        "fill=\"" IL_LOWER_PALE "\" fill-rule=\"evenodd\"", " stroke=\"" IL_LOWER_COLOR "\" stroke-width=\".8\"");
    if (s->n == 0)
        il_svg_text(page, at->x + at->width / 2, at->y + at->height / 2 + 4,
                    "font-size=\"11\" text-anchor=\"middle\" fill=\"" IL_GRAY "\"", "empty");
    il_picture_tile_caption(page, at, f->first + k, caption_of(f, k).text, NULL);
}

il_status il_picture_draw_slices(il_svg_page *page, const il_figure *f, il_error *err)
{
    il_label words = IL_LABEL_INIT;
    il_box window = il_box_empty();
    page->tolerance = 0.1;
    describe(&words, f);
    il_picture_heading(page, f, words.text);
    if (f->n == 0)
        return il_output_status(page->body, err);
    for (size_t k = 0; k < f->n; k++)
        il_box_add_slice(&window, &f->level[k].slice);
    il_tiles tiles = il_tiles_arrange(f->n, il_box_side(&window, 0), il_box_side(&window, 1), 1, widest_caption(f));
    if (!il_box_is_empty(&window))
        il_picture_scale_bar(page, IL_PAGE_MARGIN, page->y + 14, 120, tiles.scale, f->head.unit);
    page->y += 30;
    for (size_t k = 0; k < f->n; k++) {
        il_panel at = il_tiles_panel(&tiles, page, k);
        draw_slice(page, f, k, &at, &window, tiles.scale);
    }
    il_tiles_end(&tiles, page);
    return il_output_status(page->body, err);
}
