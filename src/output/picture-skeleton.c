/* picture-skeleton.c - the whole stack in the manner of the paper's Figure 4a: its
 * contours seen from the side, and their centres joined along the links. */
#include "config.h"
#include "base/alloc.h"
#include "output/oblique.h"
#include "output/picture-bonds.h"

#include <math.h>

/* ---- colours -------------------------------------------------------------- */

/* Pieces by falling volume; those behind the first five share the last colour. */
enum { REST = IL_N_PART_COLORS, COLORS = REST + 1 };

static const char *name_color(int color)
{
    return color < REST ? il_part_color[color] : "#7a7a7a";
}

static int color_of(uint32_t piece)
{
    return piece < REST ? (int)piece : REST;
}

/* ---- layout --------------------------------------------------------------- */

static const double TALLEST = 760, LOWEST = 120, AXIS = 64, FOOT = 76;

/* fine: 1, and less where the bones are many. */
typedef struct scene {
    il_svg_page *page;
    const il_figure *f;
    il_skeleton s;
    il_oblique o;
    il_svg_view v;
    il_panel panel;
    double fine;
    double *uv;              size_t cap;
} scene;

static void arrange(scene *c)
{
    const il_box *w = &c->o.window;
    double width = IL_PAGE_INNER - AXIS, shape = il_box_side(w, 1) / il_box_side(w, 0);
    double height = il_box_is_empty(w) ? LOWEST : fmin(fmax(width * shape, LOWEST), TALLEST);
    c->panel = (il_panel){ IL_PAGE_MARGIN + AXIS, c->page->y + 14, width, ceil(height) };
    c->v = il_view_centred(&c->panel, w, il_view_scale(&c->panel, il_box_side(w, 0), il_box_side(w, 1)));
}

static void put_width(il_label *l, double v)
{
    il_label_words(l, " stroke-width=\"");
    il_label_number(l, v, 2);
    il_label_words(l, "\"");
}

static void joint_at(const scene *c, uint32_t k, double at[2])
{
    const il_joint *j = &c->s.joint[k];
    double uv[2];
    il_oblique_point(&c->o, j->x, j->y, c->f->level[j->level].slice.z, uv);
    il_svg_view_point(&c->v, uv[0], uv[1], at);
}

/* ---- contours --------------------------------------------------------------- */

/* The rings of level K that have colour COLOR, as one path. */
static bool draw_rings(scene *c, size_t k, int color)
{
    const il_slice *s = &c->f->level[k].slice;
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "fill=\"");
    il_label_words(&l, name_color(color));
    il_label_words(&l, "\" stroke=\"");
    il_label_words(&l, name_color(color));
    il_label_words(&l, "\"");
    il_svg_path_begin(c->page, l.text);
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        if (color_of(c->s.piece_of[c->s.first[k] + i]) != color)
            continue;
        if (!il_grow(&c->uv, &c->cap, 2 * r->n, sizeof *c->uv))
            return false;
        il_oblique_ring(&c->o, r, s->z, c->uv);
        il_svg_outline(c->page, &c->v, c->uv, r->n, !r->open);
    }
    il_svg_path_end(c->page);
    return true;
}

/* From below, so that what is higher lies over what is lower; the more there are, the
 * paler, for they add up. */
static bool draw_contours(scene *c)
{
    bool ok = true;
    double slices = (double)c->f->n;
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "fill-rule=\"evenodd\" stroke-width=\".6\" fill-opacity=\"");
    il_label_number(&l, fmin(0.07, fmax(2 / slices, 0.01)), 1);
    il_label_words(&l, "\" stroke-opacity=\"");
    il_label_number(&l, fmin(0.6, fmax(25 / slices, 0.05)), 1);
    il_label_words(&l, "\"");
    il_svg_open(c->page, l.text);
    for (size_t k = 0; k < c->f->n && ok; k++)
        for (int color = 0; color < COLORS && ok; color++)
            ok = draw_rings(c, k, color);
    il_svg_close(c->page);
    return ok;
}

/* ---- the skeleton ------------------------------------------------------------- */

/* Bones of BOND and COLOR, those of any where it is below 0. */
static void draw_path(scene *c, int bond, int color, const char *attributes)
{
    il_svg_path_begin(c->page, attributes);
    for (size_t i = 0; i < c->s.n_bones; i++) {
        const il_bone *b = &c->s.bone[i];
        double from[2], to[2];
        if ((bond >= 0 && (int)b->bond != bond) || (color >= 0 && color_of(c->s.joint[b->a].piece) != color))
            continue;
        joint_at(c, b->a, from);
        joint_at(c, b->b, to);
        il_svg_segment(c->page, from[0], from[1], to[0], to[1]);
    }
    il_svg_path_end(c->page);
}

static double width_of(const scene *c)
{
    return 2 * c->fine;
}

static void draw_bones(scene *c)
{
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "stroke=\"#fff\" stroke-opacity=\".8\"");
    put_width(&l, 4 * c->fine);
    il_svg_open(c->page, "fill=\"none\"");
    draw_path(c, -1, -1, l.text);
    for (int bond = 0; bond < IL_N_BONDS; bond++) {
        for (int color = 0; color < COLORS && c->s.bonds[bond] > 0; color++) {
            l = il_bond_attributes((il_bond)bond, name_color(color), width_of(c));
            draw_path(c, bond, color, l.text);
        }
    }
    il_svg_close(c->page);
}

static const char branch_mark[] = "fill=\"" IL_INK "\" stroke=\"#fff\" stroke-width=\".6\"";
static const char end_mark[] = "fill=\"#fff\" stroke=\"" IL_INK "\" stroke-width=\"1\"";

static void draw_marks(scene *c)
{
    double at[2];
    for (uint32_t k = 0; k < c->s.n_joints; k++) {
        const il_joint *j = &c->s.joint[k];
        if (!j->ends && j->n_up < 2 && j->n_down < 2)
            continue;
        joint_at(c, k, at);
        if (j->ends)
            il_svg_circle(c->page, at[0], at[1], 3.4 * c->fine, end_mark);
        if (j->n_up > 1 || j->n_down > 1)
            il_svg_circle(c->page, at[0], at[1], (j->ends ? 1.8 : 3.4) * c->fine, branch_mark);
    }
}

/* ---- scales ------------------------------------------------------------------- */

/* Where height Z is on the page, over the middle of the slices. */
static double page_y(const scene *c, double z)
{
    double at[2];
    il_svg_view_point(&c->v, 0, c->o.rise * (z - c->o.o[2]), at);
    return at[1];
}

/* Ticks at round heights, at most 60 pixels apart, left of the drawing. */
static void draw_axis(scene *c)
{
    const il_figure *f = c->f;
    double height = f->z_greatest - f->z_least, scale = c->v.scale * c->o.rise;
    double left = c->v.page_x + c->v.scale * (c->o.window.low[0] - c->v.x0), x = fmax(left - 18, IL_PAGE_MARGIN + AXIS - 10);
    double step = il_picture_round_length(fmax(height, 60 / scale));
    while (step * scale > 60 && step > height / 40)
        step = il_picture_round_length(step * 0.7);
    il_svg_path_begin(c->page, "fill=\"none\" stroke=\"" IL_GRAY "\" stroke-width=\".75\"");
    il_svg_segment(c->page, x, page_y(c, f->z_least), x, page_y(c, f->z_greatest));
    double first = ceil(f->z_least / step), last = floor(f->z_greatest / step);
    for (double k = first; k <= last; k++)
        il_svg_segment(c->page, x - 4, page_y(c, k * step), x, page_y(c, k * step));
    il_svg_path_end(c->page);
    il_svg_text(c->page, x, page_y(c, f->z_greatest) - 8, "font-size=\"11\" text-anchor=\"end\" fill=\"" IL_GRAY "\"",
                il_unit_name(f->head.unit));
    for (double k = first; k <= last; k++) {
        il_label l = IL_LABEL_INIT;
        il_label_height(&l, k * step, step);
        il_svg_text(c->page, x - 7, page_y(c, k * step) + 4, "font-size=\"11\" text-anchor=\"end\" fill=\"" IL_GRAY "\"", l.text);
    }
}

/* The axes as they are seen, from (X, Y) on. */
static void draw_axes(scene *c, double x, double y)
{
    static const double unit[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    static const char *const name[3] = { "x", "y", "z" };
    il_oblique o = c->o;
    const double length = 26;
    o.o[0] = o.o[1] = o.o[2] = 0;
    o.rise = o.rise / o.stretch;
    double tip[3][2];
    il_svg_path_begin(c->page, "fill=\"none\" stroke=\"" IL_INK "\" stroke-width=\"1.2\"");
    for (int k = 0; k < 3; k++) {
        il_oblique_point(&o, unit[k][0], unit[k][1], unit[k][2], tip[k]);
        il_svg_segment(c->page, x, y, x + length * tip[k][0], y - length * tip[k][1]);
    }
    il_svg_path_end(c->page);
    for (int k = 0; k < 3; k++) {
        double far = 1 + 9 / fmax(length * hypot(tip[k][0], tip[k][1]), 6);
        il_svg_text(c->page, x + far * length * tip[k][0], y - far * length * tip[k][1] + 4,
                    "font-size=\"12\" font-style=\"italic\" text-anchor=\"middle\" fill=\"" IL_INK "\"", name[k]);
    }
}

/* ---- words -------------------------------------------------------------------- */

static void describe(il_label *l, const scene *c)
{
    const il_skeleton *s = &c->s;
    il_picture_extent(l, c->f);
    il_label_words(l, ", seen from the side and 20\xC2\xB0 above. The centres of ");
    il_label_counted(l, s->n_joints, "region");
    il_label_words(l, ", joined by ");
    il_label_counted(l, s->n_bones, "link");
    il_label_words(l, ": ");
    il_label_counted(l, s->n_pieces, "piece");
    if (s->loops > 0) {
        il_label_words(l, ", ");
        il_label_counted(l, s->loops, "loop");
    }
    il_label_words(l, ".");
    if (c->o.stretch != 1) {
        il_label_words(l, " Heights are multiplied by ");
        il_label_number(l, c->o.stretch, 3);
        il_label_words(l, ".");
    }
}

/* "31 regions, z 0 to 12.5". */
static void describe_piece(il_label *l, const scene *c, size_t k)
{
    const il_piece *p = &c->s.piece[k];
    il_label_counted(l, p->n_joints, "region");
    il_label_words(l, ", z ");
    il_label_height(l, c->f->level[p->low].slice.z, c->f->spacing);
    if (p->high == p->low)
        return;
    il_label_words(l, " to ");
    il_label_height(l, c->f->level[p->high].slice.z, c->f->spacing);
}

static void describe_rest(il_label *l, const scene *c)
{
    size_t n = 0;
    for (size_t k = REST; k < c->s.n_pieces; k++)
        n += c->s.piece[k].n_joints;
    il_label_counted(l, c->s.n_pieces - REST, "smaller piece");
    il_label_words(l, ": ");
    il_label_counted(l, n, "region");
}

static void add_pieces(il_legend *l, const scene *c)
{
    for (int k = 0; k < COLORS && (size_t)k < c->s.n_pieces; k++) {
        il_label a = IL_LABEL_INIT;
        il_label_words(&a, "fill-opacity=\".3\" fill=\"");
        il_label_words(&a, name_color(k));
        il_label_words(&a, "\" stroke=\"");
        il_label_words(&a, name_color(k));
        il_label_words(&a, "\"");
        il_label *words = il_legend_add(l, a.text, IL_SWATCH_BOX);
        if (k < REST)
            describe_piece(words, c, (size_t)k);
        else
            describe_rest(words, c);
    }
}

static void add_mark(il_legend *l, const char *attributes, const char *words, size_t count)
{
    if (count == 0)
        return;
    il_label *to = il_legend_add(l, attributes, IL_SWATCH_DOT);
    il_label_words(to, words);
    il_label_count(to, count);
}

static void draw_legend(const scene *c)
{
    il_legend l = { .n = 0 };
    il_legend_add_bonds(&l, &c->s, width_of(c));
    add_mark(&l, branch_mark, "branching places: ", c->s.branches);
    add_mark(&l, end_mark, "ends inside the stack: ", c->s.ends);
    add_pieces(&l, c);
    il_picture_legend(c->page, l.entry, l.n);
}

/* ---- all of it ------------------------------------------------------------------ */

static void draw_foot(scene *c)
{
    double y = c->panel.y + c->panel.height + FOOT - 22;
    draw_axes(c, IL_PAGE_MARGIN + 34, y - 6);
    if (!il_box_is_empty(&c->o.window))
        il_picture_scale_bar(c->page, IL_PAGE_MARGIN + AXIS + 40, y, 160, c->v.scale, c->f->head.unit);
    c->page->y = c->panel.y + c->panel.height + FOOT;
}

static il_status draw(scene *c, il_error *err)
{
    il_label words = IL_LABEL_INIT;
    il_status st = il_skeleton_find(&c->s, c->f, err);
    if (st != IL_OK)
        return st;
    c->o = il_oblique_view(c->f);
    c->fine = c->s.n_bones > 2000 ? 0.55 : c->s.n_bones > 500 ? 0.75 : 1;
    describe(&words, c);
    il_picture_heading(c->page, c->f, words.text);
    c->page->y += 6;
    draw_legend(c);
    arrange(c);
    if (!draw_contours(c))
        return il_fail_nomem(err);
    draw_bones(c);
    draw_marks(c);
    if (c->f->z_greatest > c->f->z_least && !il_box_is_empty(&c->o.window))
        draw_axis(c);
    draw_foot(c);
    return il_output_status(c->page->body, err);
}

il_status il_picture_draw_skeleton(il_svg_page *page, const il_figure *f, il_error *err)
{
    if (f->head.kind == IL_KIND_TERRAIN || f->n == 0) {
        il_picture_heading(page, f, f->n == 0 ? "No slices." : "A terrain has no skeleton: its lines bound nothing by themselves.");
        return il_output_status(page->body, err);
    }
    scene c = { .page = page, .f = f };
    page->tolerance = 0.15;
    il_status st = draw(&c, err);
    il_skeleton_free(&c.s);
    il_free(c.uv);
    return st;
}
