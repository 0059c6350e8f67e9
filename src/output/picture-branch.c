#include "config.h"
#include "output/picture-branch.h"
#include "output/cut-faces.h"
#include "output/picture-bonds.h"

#include <math.h>

/* As the paper has them: bold red. */
#define CUT_COLOR "#d00000"
const char il_cut_attributes[] = "stroke=\"" CUT_COLOR "\" stroke-width=\"3\"";
const char il_piece_attributes[] = "fill=\"#009e73\" fill-opacity=\".35\" stroke=\"none\"";

/* ---- pieces and cuts --------------------------------------------------------- */

/* Beside the colours of the two slices themselves; pieces have them by turns. */
enum { N_COLORS = 4 };
static const char *const piece_fill[N_COLORS] =
    { "fill=\"#009e73\"", "fill=\"#cc79a7\"", "fill=\"#f0e442\"", "fill=\"#56b4e9\"" };

il_status il_picture_pieces(il_svg_page *page, const il_svg_view *v, const il_slice *s, const il_pair *p, bool upper, il_error *err)
{
    il_cut_faces f = IL_CUT_FACES_INIT;
    il_status st = il_cut_faces_find(&f, s, p->cut, p->n_cuts, upper, err);
    if (st == IL_OK && f.n_loops > 0) {
        il_svg_open(page, "fill-opacity=\".35\" fill-rule=\"evenodd\" stroke=\"none\"");
        for (uint32_t color = 0; color < N_COLORS; color++) {
            il_svg_path_begin(page, piece_fill[color]);
            for (size_t k = 0; k < f.n_loops; k++)
                if (f.face[k] % N_COLORS == color)
                    il_svg_outline(page, v, f.xy + 2 * f.first[k], f.first[k + 1] - f.first[k], true);
            il_svg_path_end(page);
        }
        il_svg_close(page);
    }
    il_cut_faces_free(&f);
    return st;
}

void il_picture_cuts(il_svg_page *page, const il_svg_view *v, const il_pair *p, double width)
{
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "fill=\"none\" stroke=\"" CUT_COLOR "\" stroke-width=\"");
    il_label_number(&l, width, 2);
    il_label_words(&l, "\"");
    il_svg_path_begin(page, l.text);
    for (size_t k = 0; k < p->n_cuts; k++)
        il_svg_outline(page, v, p->cut[k].xy, p->cut[k].n, false);
    il_svg_path_end(page);
}

/* ---- links --------------------------------------------------------------------- */

/* Two regions that overlap, and nothing else: that is seen without a line. */
static bool is_plain(const il_skeleton *s, const il_bone *b)
{
    return b->bond == IL_BOND_OVERLAP && s->joint[b->a].n_up == 1 && s->joint[b->b].n_down == 1;
}

static void draw_ends(il_svg_page *page, const il_svg_view *v, const il_skeleton *s)
{
    for (size_t i = 0; i < s->n_bones; i++) {
        const il_bone *b = &s->bone[i];
        for (int k = 0; k < 2 && !is_plain(s, b); k++) {
            const il_joint *j = &s->joint[k == 0 ? b->a : b->b];
            double at[2];
            il_svg_view_point(v, j->x, j->y, at);
            il_svg_circle(page, at[0], at[1], 2.6, k == 0 ? "fill=\"" IL_LOWER_COLOR "\" stroke=\"#fff\" stroke-width=\".6\"" :
                                                           "fill=\"" IL_UPPER_COLOR "\" stroke=\"#fff\" stroke-width=\".6\"");
        }
    }
}

size_t il_picture_links(il_svg_page *page, const il_svg_view *v, const il_skeleton *s)
{
    size_t n = 0;
    il_svg_open(page, "fill=\"none\"");
    for (int bond = 0; bond < IL_N_BONDS; bond++) {
        il_label l = il_bond_attributes((il_bond)bond, IL_INK, 1.4);
        il_svg_path_begin(page, l.text);
        for (size_t i = 0; i < s->n_bones && s->bonds[bond] > 0; i++) {
            const il_bone *b = &s->bone[i];
            double from[2], to[2];
            if ((int)b->bond != bond || is_plain(s, b))
                continue;
            il_svg_view_point(v, s->joint[b->a].x, s->joint[b->a].y, from);
            il_svg_view_point(v, s->joint[b->b].x, s->joint[b->b].y, to);
            il_svg_segment(page, from[0], from[1], to[0], to[1]);
            n++;
        }
        il_svg_path_end(page);
    }
    il_svg_close(page);
    draw_ends(page, v, s);
    return n;
}

void il_picture_tell_links(il_label *l, const il_pair *p, double height, il_unit unit)
{
    double reach = 0;
    size_t openings = 0;
    for (size_t i = 0; i < p->n_groups; i++) {
        for (size_t k = 0; k < p->group[i].n_links; k++) {
            reach = fmax(reach, p->group[i].link[k].reach);
            openings += p->group[i].link[k].reason == IL_LINK_OPENING;
        }
    }
    if (reach > 0) {
        il_label_words(l, "Links reach over gaps of up to ");
        il_label_number(l, reach, 3);
        il_label_words(l, " ");
        il_label_words(l, il_unit_name(unit));
        il_label_words(l, ", ");
        il_label_number(l, reach / height, 2);
        il_label_words(l, " of the slab's height. ");
    }
    if (openings > 0) {
        il_label_counted(l, openings, "hole");
        il_label_words(l, openings == 1 ? " opens to what is outside." : " open to what is outside.");
    }
}
