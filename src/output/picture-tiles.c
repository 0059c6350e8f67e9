#include "config.h"
#include "output/picture-tiles.h"

#include <math.h>

/* Drawings are between these wide, as many a row as a compact block asks for;
 * beyond these shapes they get space at their sides. */
static const double WIDTH_LEAST = 98, WIDTH_MOST = 260, TALLEST = 1.6, FLATTEST = 0.35;
static const double GAP = 14, LINE = 15, PAD = 6;

/* Bold digits of size 11 are as wide as others of this size. */
static const double BOLD = 13, NUMBER_GAP = 5;

il_tiles il_tiles_arrange(size_t n, double width, double height, int lines, double caption)
{
    double shape = fmin(fmax(height / width, FLATTEST), TALLEST);
    /* A block about as wide as high, but never with columns too many or too wide. */
    double wish = ceil(sqrt(1.5 * (double)n * shape));
    double narrow = fmin(fmax(caption, WIDTH_LEAST), WIDTH_MOST);
    double least = ceil((IL_PAGE_INNER + GAP) / (WIDTH_MOST + GAP)), most = floor((IL_PAGE_INNER + GAP) / (narrow + GAP));
    double columns = fmin(fmax(wish, least), most);
    double rows = ceil((double)n / columns);
    columns = fmax(ceil((double)n / rows), least); /* all rows about as long */
    il_tiles t = { .n = n, .columns = (size_t)columns, .lines = lines };
    t.width = floor((IL_PAGE_INNER + GAP) / columns - GAP);
    t.height = ceil(t.width * shape);
    t.scale = il_view_scale(&(il_panel){ 0, 0, t.width - 2 * PAD, t.height - 2 * PAD }, width, height);
    return t;
}

static double row_height(const il_tiles *t)
{
    return t->height + LINE * t->lines + GAP + 6;
}

il_panel il_tiles_panel(const il_tiles *t, const il_svg_page *page, size_t k)
{
    return (il_panel){ IL_PAGE_MARGIN + (double)(k % t->columns) * (t->width + GAP),
                       page->y + (double)(k / t->columns) * row_height(t), t->width, t->height };
}

void il_tiles_end(const il_tiles *t, il_svg_page *page)
{
    page->y += (double)((t->n + t->columns - 1) / t->columns) * row_height(t);
}

double il_picture_caption_width(size_t number, const char *words, const char *more)
{
    il_label l = IL_LABEL_INIT;
    il_label_count(&l, number);
    return fmax(il_label_width(l.text, BOLD) + NUMBER_GAP + il_label_width(words, 11), more ? il_label_width(more, 11) : 0);
}

void il_picture_tile_caption(il_svg_page *page, const il_panel *at, size_t number, const char *words, const char *more)
{
    il_label l = IL_LABEL_INIT;
    il_label_count(&l, number);
    double y = at->y + at->height + LINE - 2, x = at->x + il_label_width(l.text, BOLD) + NUMBER_GAP;
    il_svg_text(page, at->x, y, "font-size=\"11\" font-weight=\"bold\" fill=\"" IL_INK "\"", l.text);
    il_svg_text(page, x, y, "font-size=\"11\" fill=\"" IL_GRAY "\"", words);
    if (more)
        il_svg_text(page, at->x, y + LINE, "font-size=\"11\" fill=\"" IL_GRAY "\"", more);
}
