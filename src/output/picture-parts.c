#include "config.h"
#include "output/picture-parts.h"

#include <math.h>
#include <string.h>

const char *const il_part_color[IL_N_PART_COLORS] = { "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9" };

/* ---- boxes and views ----------------------------------------------------- */

il_box il_box_empty(void)
{
    return (il_box){ { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
}

bool il_box_is_empty(const il_box *b)
{
    return !(b->low[0] <= b->high[0]);
}

void il_box_add(il_box *b, double x, double y)
{
    const double at[2] = { x, y };
    for (int k = 0; k < 2; k++) {
        b->low[k] = fmin(b->low[k], at[k]);
        b->high[k] = fmax(b->high[k], at[k]);
    }
}

void il_box_add_slice(il_box *b, const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++)
            il_box_add(b, s->ring[i].xy[2 * k], s->ring[i].xy[2 * k + 1]);
}

/* A scale of pixels by this is a finite double. */
static const double LEAST_SIDE = 1e-200;

double il_box_side(const il_box *b, int k)
{
    if (il_box_is_empty(b))
        return 1;
    return fmax(b->high[k] - b->low[k], LEAST_SIDE);
}

double il_view_scale(const il_panel *panel, double width, double height)
{
    return fmin(panel->width / fmax(width, LEAST_SIDE), panel->height / fmax(height, LEAST_SIDE));
}

il_svg_view il_view_centred(const il_panel *panel, const il_box *b, double scale)
{
    bool empty = il_box_is_empty(b);
    return (il_svg_view){ .x0 = empty ? 0 : b->low[0] / 2 + b->high[0] / 2,
                          .y0 = empty ? 0 : b->low[1] / 2 + b->high[1] / 2,
                          .page_x = panel->x + panel->width / 2, .page_y = panel->y + panel->height / 2,
                          .scale = scale };
}

static void draw_rings(il_svg_page *page, const il_svg_view *v, const il_slice *s, bool open, const char *fill,
                       const char *stroke)
{
    il_label attributes = IL_LABEL_INIT;
    il_label_words(&attributes, fill);
    il_label_words(&attributes, stroke);
    il_svg_path_begin(page, attributes.text);
    for (size_t i = 0; i < s->n; i++)
        if (s->ring[i].open == open)
            il_svg_outline(page, v, s->ring[i].xy, s->ring[i].n, !open);
    il_svg_path_end(page);
}

void il_picture_slice(il_svg_page *page, const il_svg_view *v, const il_slice *s, const char *fill, const char *stroke)
{
    draw_rings(page, v, s, false, fill, stroke);
    draw_rings(page, v, s, true, "fill=\"none\"", stroke);
}

/* ---- heading ------------------------------------------------------------- */

static void color_attributes(il_label *l, const unsigned char color[3])
{
    static const char hex[] = "0123456789abcdef";
    il_label_words(l, "fill=\"#");
    for (int k = 0; k < 3; k++)
        il_label_words(l, (char[3]){ hex[color[k] >> 4], hex[color[k] & 15], '\0' });
    il_label_words(l, "\" stroke=\"#888\" stroke-width=\".5\"");
}

enum { NAME_COLUMNS = 60 };

void il_picture_name(il_label *l, const il_figure *f)
{
    if (*il_stack_head_name(&f->head)) {
        il_label_name(l, il_stack_head_name(&f->head), NAME_COLUMNS);
    } else {
        il_label_words(l, "Stack ");
        il_label_count(l, f->index);
    }
}

void il_picture_heading(il_svg_page *page, const il_figure *f, const char *subtitle)
{
    il_label title = IL_LABEL_INIT;
    double x = IL_PAGE_MARGIN;
    page->y += IL_PAGE_MARGIN;
    il_picture_name(&title, f);
    if (f->head.has_color) {
        il_label attributes = IL_LABEL_INIT;
        color_attributes(&attributes, f->head.color);
        il_svg_rectangle(page, x, page->y, 14, 14, attributes.text);
        x += 22;
    }
    il_svg_text(page, x, page->y + 13, "font-size=\"18\" font-weight=\"bold\" fill=\"" IL_INK "\"", title.text);
    page->y += 22;
    il_picture_paragraph(page, IL_PAGE_INNER, subtitle);
}

void il_picture_extent(il_label *l, const il_figure *f)
{
    const char *unit = il_unit_name(f->head.unit);
    il_label_counted(l, f->n_slices, "slice");
    if (f->n_slices == 0)
        return;
    il_label_words(l, ", z ");
    il_label_height(l, f->z_least, f->spacing);
    if (f->z_greatest > f->z_least) {
        il_label_words(l, " to ");
        il_label_height(l, f->z_greatest, f->spacing);
    }
    il_label_words(l, " ");
    il_label_words(l, unit);
}

/* ---- scale bar ----------------------------------------------------------- */

double il_picture_round_length(double most)
{
    double power = pow(10, floor(log10(most)));
    return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

void il_picture_scale_bar(il_svg_page *page, double x, double y, double most, double scale, il_unit unit)
{
    double length = il_picture_round_length(most / scale), pixels = fmin(length * scale, most);
    il_label l = IL_LABEL_INIT;
    il_label_number(&l, length, 1);
    il_label_words(&l, " ");
    il_label_words(&l, il_unit_name(unit));
    il_svg_path_begin(page, "fill=\"none\" stroke=\"" IL_INK "\" stroke-width=\"1.5\" stroke-linecap=\"butt\"");
    il_svg_segment(page, x, y, x + pixels, y);
    il_svg_segment(page, x + .75, y - 3.5, x + .75, y + 3.5);
    il_svg_segment(page, x + pixels - .75, y - 3.5, x + pixels - .75, y + 3.5);
    il_svg_path_end(page);
    il_svg_text(page, x + pixels + 8, y + 4, "font-size=\"12\" fill=\"" IL_INK "\"", l.text);
}

/* ---- words --------------------------------------------------------------- */

/* How many bytes of S fill a line, and where the next one begins. */
static size_t line_length(const char *s, double width, double size, size_t *next)
{
    size_t n = 0, end = 0;
    char line[sizeof ((il_label *)0)->text];
    for (;;) {
        n += strcspn(s + n, " ");
        if (n >= sizeof line)
            break;
        memcpy(line, s, n);
        line[n] = '\0';
        if (end > 0 && il_label_width(line, size) > width)
            break;
        end = n;
        if (!s[n])
            break;
        n++;
    }
    end = end > 0 ? end : strlen(s);
    *next = end + (s[end] == ' ');
    return end;
}

void il_picture_paragraph(il_svg_page *page, double width, const char *words)
{
    il_label line;
    size_t next, n;
    for (; *words; words += next) {
        n = line_length(words, width, 12, &next);
        n = n < sizeof line.text ? n : sizeof line.text - 1;
        memcpy(line.text, words, n);
        line.text[n] = '\0';
        page->y += 17;
        il_svg_text(page, IL_PAGE_MARGIN, page->y - 4, "font-size=\"12\" fill=\"" IL_GRAY "\"", line.text);
    }
}

/* ---- legend -------------------------------------------------------------- */

enum { SWATCH = 28, SWATCH_GAP = 7, ENTRY_GAP = 8, ENTRY_HEIGHT = 20, LEGEND_COLUMNS = 3 };

static void draw_entry(il_svg_page *page, const il_legend_entry *e, double x)
{
    double y = page->y + ENTRY_HEIGHT / 2.0;
    if (e->swatch == IL_SWATCH_BOX) {
        il_svg_rectangle(page, x + 4, y - 6, SWATCH - 8, 12, e->attributes);
    } else if (e->swatch == IL_SWATCH_DOT) {
        il_svg_circle(page, x + SWATCH / 2.0, y, 4, e->attributes);
    } else {
        il_svg_path_begin(page, e->attributes);
        il_svg_segment(page, x, y, x + SWATCH, y);
        il_svg_path_end(page);
    }
    il_svg_text(page, x + SWATCH + SWATCH_GAP, y + 4, "font-size=\"12\" fill=\"" IL_INK "\"", e->words);
}

void il_picture_legend(il_svg_page *page, const il_legend_entry *entry, size_t n)
{
    const double each = (double)IL_PAGE_INNER / LEGEND_COLUMNS;
    double column = 0;
    if (n == 0)
        return;
    for (size_t k = 0; k < n; k++) {
        double columns = ceil((SWATCH + SWATCH_GAP + il_label_width(entry[k].words, 12) + ENTRY_GAP) / each);
        if (column > 0 && column + columns > LEGEND_COLUMNS) {
            column = 0;
            page->y += ENTRY_HEIGHT;
        }
        draw_entry(page, &entry[k], IL_PAGE_MARGIN + column * each);
        column += columns;
    }
    page->y += ENTRY_HEIGHT;
}

il_label *il_legend_add(il_legend *l, const char *attributes, il_swatch swatch)
{
    size_t k = l->n++;
    l->attributes[k].n = l->words[k].n = 0;
    il_label_words(&l->attributes[k], attributes);
    l->entry[k] = (il_legend_entry){ l->attributes[k].text, l->words[k].text, swatch };
    return &l->words[k];
}
