#include "config.h"
#include "output/picture-table.h"

enum { ROWS_MOST = 20, ROW = 17, RINGS_SHOWN = 4 };

/* Where the columns stand; the first two begin there, the others end there. */
static const double column[] = { 0, 120, 330, 400, 495, 565, 675, 765, 840 };
static const char *const heading[] = {
    "lower rings", "upper rings", "\xCF\x86(U) to L", "largest", "L to \xCF\x86(U)", "largest", "least Jacobian",
    "distortion", "steps" };
enum { N_COLUMNS = sizeof column / sizeof *column };

static void put_cell(il_svg_page *page, int k, const char *color, const char *text)
{
    il_label attributes = IL_LABEL_INIT;
    il_label_words(&attributes, "font-size=\"12\" fill=\"");
    il_label_words(&attributes, color);
    il_label_words(&attributes, k < 2 ? "\"" : "\" text-anchor=\"end\"");
    il_svg_text(page, IL_PAGE_MARGIN + column[k], page->y, attributes.text, text);
}

static void put_number(il_svg_page *page, int k, double v)
{
    il_label l = IL_LABEL_INIT;
    il_label_number(&l, v, 3);
    put_cell(page, k, IL_INK, l.text);
}

static void put_rings(il_svg_page *page, int k, const uint32_t *ring, size_t n)
{
    il_label l = IL_LABEL_INIT;
    for (size_t i = 0; i < n && i < RINGS_SHOWN; i++) {
        il_label_words(&l, i > 0 ? " " : "");
        il_label_count(&l, ring[i]);
    }
    il_label_words(&l, n > RINGS_SHOWN ? " \xE2\x80\xA6" : n == 0 ? "\xE2\x80\x93" : "");
    put_cell(page, k, IL_INK, l.text);
}

static void put_row(il_svg_page *page, const il_group *g)
{
    const il_fit *f = &g->fit;
    page->y += ROW;
    put_rings(page, 0, g->lower, g->n_lower);
    put_rings(page, 1, g->upper, g->n_upper);
    put_number(page, 2, f->residual_up_mean);
    put_number(page, 3, f->residual_up_max);
    put_number(page, 4, f->residual_down_mean);
    put_number(page, 5, f->residual_down_max);
    put_number(page, 6, f->least_jacobian);
    put_number(page, 7, f->distortion);
    put_number(page, 8, f->steps);
}

static void put_heading(il_svg_page *page)
{
    page->y += ROW + 10;
    for (int k = 0; k < N_COLUMNS; k++)
        put_cell(page, k, IL_GRAY, heading[k]);
    il_svg_path_begin(page, "stroke=\"#bbb\" stroke-width=\".75\"");
    il_svg_segment(page, IL_PAGE_MARGIN, page->y + 5, IL_PAGE_MARGIN + IL_PAGE_INNER, page->y + 5);
    il_svg_path_end(page);
    page->y += 4;
}

static void put_note(il_svg_page *page, size_t rows, il_unit unit)
{
    il_label l = IL_LABEL_INIT;
    if (rows > ROWS_MOST) {
        il_label_words(&l, "And ");
        il_label_counted(&l, rows - ROWS_MOST, "group");
        il_label_words(&l, " more. ");
    }
    il_label_words(&l, "Distances are means and largest ones, in ");
    il_label_words(&l, il_unit_name(unit));
    il_label_words(&l, "; \xCF\x86 is one-to-one where the Jacobian stays above 0; "
                       "distortion is the root mean square of the log stretch.");
    page->y += 6;
    il_picture_paragraph(page, IL_PAGE_INNER, l.text);
}

/* Groups of rings in one slice only have no figures. */
static void tell_alone(il_svg_page *page, size_t alone)
{
    il_label l = IL_LABEL_INIT;
    if (alone == 0)
        return;
    il_label_counted(&l, alone, "group");
    il_label_words(&l, alone == 1 ? " has" : " have");
    il_label_words(&l, " rings in one slice only.");
    il_picture_paragraph(page, IL_PAGE_INNER, l.text);
}

void il_picture_fit_table(il_svg_page *page, const il_pair *p, il_unit unit)
{
    size_t rows = 0, alone = 0;
    for (size_t k = 0; k < p->n_groups; k++)
        alone += p->group[k].n_lower == 0 || p->group[k].n_upper == 0;
    tell_alone(page, alone);
    for (size_t k = 0; k < p->n_groups; k++) {
        if (!p->group[k].fitted)
            continue;
        if (rows == 0)
            put_heading(page);
        if (rows++ < ROWS_MOST)
            put_row(page, &p->group[k]);
    }
    if (rows > 0)
        put_note(page, rows, unit);
}
