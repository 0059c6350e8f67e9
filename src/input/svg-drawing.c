#include "config.h"
#include "input/svg-drawing.h"
#include "base/alloc.h"
#include "input/svg-shape.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST_TITLE = 1024 };

/* Largest distance of a flattened curve when the user names none, stack units. */
#define DEFAULT_FLATNESS 0.01

void il_svg_drawing_init(il_svg_drawing *d, const il_read_options *options, il_report *report)
{
    *d = (il_svg_drawing){ .options = options, .report = report };
}

void il_svg_drawing_free(il_svg_drawing *d)
{
    il_svg_slices_free(&d->slices);
    il_free(d->title);
    il_free(d->frame);
    il_svg_drawing_init(d, d->options, d->report);
}

void il_svg_drawing_begin_file(il_svg_drawing *d, size_t file, const char *name)
{
    d->file = file;
    d->file_name = name;
    d->n_frames = d->n_ignored = d->n_slots = 0;
    d->n_owners = 0;
    d->is_slic3r = d->is_plate = d->is_physical = d->is_seen = d->in_title = false;
}

size_t il_svg_drawing_depth(const il_svg_drawing *d)
{
    return d->n_frames + d->n_ignored;
}

/* ---- what there is, by name ------------------------------------------------------ */

typedef enum role {
    ROLE_GROUP, ROLE_SVG, ROLE_SHAPE, ROLE_TITLE,
    ROLE_QUIET,     /* draws nothing by itself: no loss */
    ROLE_FOREIGN,   /* of another namespace: likewise */
    ROLE_LOST,      /* would draw something: left out and counted */
    ROLE_UNKNOWN    /* in SVG's namespace, but not of it: likewise, or a typing error */
} role;

static const struct { const char *name; role role; const char *why; } elements[] = {
    { "g", ROLE_GROUP, NULL },          { "a", ROLE_GROUP, NULL },
    { "switch", ROLE_GROUP, NULL },     { "svg", ROLE_SVG, NULL },
    { "title", ROLE_TITLE, NULL },      { "desc", ROLE_QUIET, NULL },
    { "metadata", ROLE_QUIET, NULL },   { "defs", ROLE_QUIET, NULL },
    { "symbol", ROLE_QUIET, NULL },     { "clipPath", ROLE_QUIET, NULL },
    { "mask", ROLE_QUIET, NULL },       { "pattern", ROLE_QUIET, NULL },
    { "marker", ROLE_QUIET, NULL },     { "linearGradient", ROLE_QUIET, NULL },
    { "radialGradient", ROLE_QUIET, NULL }, { "filter", ROLE_QUIET, NULL },
    { "style", ROLE_QUIET, NULL },      { "script", ROLE_QUIET, NULL },
    { "view", ROLE_QUIET, NULL },       { "cursor", ROLE_QUIET, NULL },
    { "font", ROLE_QUIET, NULL },       { "font-face", ROLE_QUIET, NULL },
    { "color-profile", ROLE_QUIET, NULL }, { "animate", ROLE_QUIET, NULL },
    { "animateColor", ROLE_QUIET, NULL }, { "animateMotion", ROLE_QUIET, NULL },
    { "animateTransform", ROLE_QUIET, NULL }, { "set", ROLE_QUIET, NULL },
    { "use", ROLE_LOST, "references are not followed" },
    { "text", ROLE_LOST, "letters are no contours" },
    { "image", ROLE_LOST, "a picture has no contours" },
    { "foreignObject", ROLE_LOST, "its content is not SVG" },
};

static role role_of(const il_svg_element *e, const il_svg_shape **shape, const char **why)
{
    *why = "no element that isoloft knows";
    *shape = NULL;
    if (!il_svg_element_is_svg(e))
        return ROLE_FOREIGN;
    *shape = il_svg_shape_named(e->name);
    if (*shape)
        return ROLE_SHAPE;
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++) {
        if (strcmp(elements[i].name, e->name) == 0) {
            *why = elements[i].why;
            return elements[i].role;
        }
    }
    return ROLE_UNKNOWN;
}

/* ---- what is left out --------------------------------------------------------------- */

static void skip(il_svg_drawing *d, const il_svg_element *e, const char *why)
{
    char what[64];
    snprintf(what, sizeof what, "<%.40s>", e->name);
    il_report_skip(d->report, d->file_name, e->line, what, why);
    if (d->n_frames > 0)
        d->frame[d->n_frames - 1].holds = true;
}

static bool is_hidden(const il_svg_element *e)
{
    il_svg_text t;
    return il_svg_property(e, "display", &t) && il_svg_text_is_word(&t, "none");
}

/* Properties that change what is drawn and are not followed. */
static void count_lost_properties(il_svg_drawing *d, const il_svg_element *e)
{
    static const struct { const char *name, *why; } lost[] = {
        { "clip-path", "clip-path is not applied" }, { "mask", "mask is not applied" },
        { "transform-origin", "transform-origin is not applied" } };
    il_svg_text t;
    for (size_t i = 0; i < sizeof lost / sizeof *lost; i++)
        if (il_svg_property(e, lost[i].name, &t) && !il_svg_text_is_word(&t, "none"))
            skip(d, e, lost[i].why);
    bool styled = il_svg_property(e, "transform", &t), plain = il_svg_attr(e, IL_SVG_NS_NONE, "transform", &t);
    if (styled && !plain)
        skip(d, e, "a transform in a style is not applied");
}

/* ---- open elements -------------------------------------------------------------------- */

static il_svg_frame outermost(void)
{
    return (il_svg_frame){ .matrix = IL_AFFINE_IDENTITY, .given = IL_SVG_LEVEL_INIT, .named = IL_SVG_LEVEL_INIT };
}

/* An element that counts as a slice of its own when none has a height: a child
 * of the outermost svg, or of the file when that is a fragment. */
static bool begins_slot(const il_svg_drawing *d, role r)
{
    return (d->n_frames == 0 && r != ROLE_SVG) || (d->n_frames == 1 && d->frame[0].is_svg);
}

static il_status read_level(il_svg_drawing *d, const il_svg_element *e, role r, il_svg_frame *f, il_error *err)
{
    il_svg_level given = IL_SVG_LEVEL_INIT, named = IL_SVG_LEVEL_INIT;
    bool is_plate = false;
    il_status st = il_svg_level_read(e, &given, &is_plate, err);
    il_svg_level_read_name(e, &named);
    given.owner = named.owner = r == ROLE_SHAPE ? -1 : d->n_owners++;
    d->is_plate = d->is_plate || is_plate;
    if (given.kind != IL_SVG_LEVEL_NONE)
        f->given = given;
    if (named.kind != IL_SVG_LEVEL_NONE)
        f->named = named;
    f->own_level = given.kind != IL_SVG_LEVEL_NONE || named.kind != IL_SVG_LEVEL_NONE;
    return st;
}

/* Place E's user units: the outermost svg's are scaled to mm where it says how
 * large it is, an inner svg has its viewport, and then comes its transform.
 * Slic3r's files are in mm already, and --unit says what the numbers are. */
static il_status read_place(il_svg_drawing *d, const il_svg_element *e, role r, il_svg_frame *f, il_error *err)
{
    il_affine m = IL_AFFINE_IDENTITY;
    il_status st = IL_OK;
    bool is_physical = false;
    if (r == ROLE_SVG && d->n_frames == 0)
        st = il_svg_view_root(e, &m, &is_physical, &f->viewport, err);
    else if (r == ROLE_SVG)
        st = il_svg_view_nested(e, f->viewport, &m, &f->viewport, err);
    if (is_physical && (d->is_slic3r || d->options->has_unit))
        m = (il_affine)IL_AFFINE_IDENTITY;
    d->is_physical = d->is_physical || is_physical;
    if (st == IL_OK) {
        il_affine outer = f->matrix, inner = IL_AFFINE_IDENTITY;
        il_svg_text t;
        if (il_svg_attr(e, IL_SVG_NS_NONE, "transform", &t)) {
            d->at = t;
            st = il_svg_transform_parse(&d->at, &inner, err);
        }
        /* on an inner svg the transform stands outside its viewport */
        f->matrix = r == ROLE_SVG ? il_affine_multiply(&inner, &m) : inner;
        f->matrix = il_affine_multiply(&outer, &f->matrix);
    }
    return st;
}

/* The frame of E inside the innermost open one. */
static il_status make_frame(il_svg_drawing *d, const il_svg_element *e, role r, il_svg_frame *f, il_error *err)
{
    *f = d->n_frames > 0 ? d->frame[d->n_frames - 1] : outermost();
    f->line = e->line;
    f->is_svg = r == ROLE_SVG;
    f->holds = false;
    f->is_slot = begins_slot(d, r);
    if (f->is_slot)
        f->slot = d->n_slots++;
    d->at.name = NULL;
    il_status st = read_level(d, e, r, f, err);
    return st == IL_OK ? read_place(d, e, r, f, err) : st;
}

static const il_svg_level *level_of(const il_svg_frame *f)
{
    return f->given.kind != IL_SVG_LEVEL_NONE ? &f->given : &f->named;
}

static il_status open_container(il_svg_drawing *d, const il_svg_element *e, role r, il_error *err)
{
    il_svg_frame f;
    il_status st = make_frame(d, e, r, &f, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(&d->frame, &d->cap_frames, d->n_frames + 1, sizeof *d->frame))
        return il_fail_nomem(err);
    d->frame[d->n_frames++] = f;
    return IL_OK;
}

/* ---- shapes ------------------------------------------------------------------------------ */

static il_status draw_shape(il_svg_drawing *d, const il_svg_element *e, const il_svg_shape *shape, il_error *err)
{
    il_svg_frame f;
    il_slice drawn = IL_SLICE_INIT;
    const char *why = NULL;
    il_status st = make_frame(d, e, ROLE_SHAPE, &f, err);
    if (st != IL_OK)
        return st;
    double flatness = d->options->flatness > 0 ? d->options->flatness : DEFAULT_FLATNESS;
    il_svg_pen pen = { .matrix = f.matrix, .flatness = flatness, .max_points = d->options->max_points,
                       .n_points = d->n_points, .line = e->line, .slice = &drawn };
    st = il_svg_shape_draw(shape, e, &pen, &why, &d->at, err);
    d->n_points = pen.n_points;
    if (st == IL_OK && drawn.n > 0)
        st = il_svg_slices_add(&d->slices, level_of(&f), f.slot, d->file, e->line, &drawn, err);
    else if (st == IL_OK)
        skip(d, e, why ? why : "it has no edge");
    if (st == IL_OK && d->n_frames > 0)
        d->frame[d->n_frames - 1].holds = true;
    il_slice_free(&drawn);
    return st;
}

/* ---- tags and text -------------------------------------------------------------------------- */

static bool is_for_title(const il_svg_drawing *d, role r)
{
    return r == ROLE_TITLE && !d->has_title && (d->n_frames == 0 || (d->n_frames == 1 && d->frame[0].is_svg));
}

static void note_slic3r(il_svg_drawing *d, const il_svg_element *e)
{
    il_svg_text t;
    d->is_slic3r = d->is_slic3r || e->declares_slic3r || il_svg_attr(e, IL_SVG_NS_SLIC3R, "z", &t) ||
                   il_svg_attr(e, IL_SVG_NS_SLIC3R, "type", &t);
}

il_status il_svg_drawing_start(il_svg_drawing *d, const il_svg_element *e, il_error *err)
{
    const il_svg_shape *shape;
    const char *why;
    d->at.name = NULL;
    if (il_svg_drawing_depth(d) >= d->options->max_depth)
        return il_fail(err, IL_E_INPUT, e->line, "elements nested more than %zu deep", d->options->max_depth);
    if (d->n_ignored > 0) {
        d->n_ignored++;
        return IL_OK;
    }
    role r = role_of(e, &shape, &why);
    if (d->n_frames == 0 && (r == ROLE_FOREIGN || r == ROLE_UNKNOWN))
        return il_fail(err, IL_E_INPUT, e->line, "<%.40s> is no SVG element", e->name);
    d->is_seen = true;
    note_slic3r(d, e);
    bool draws = r == ROLE_GROUP || r == ROLE_SVG || r == ROLE_SHAPE;
    if (draws && is_hidden(e)) {
        skip(d, e, "display: none");
        draws = false;
    } else if (draws) {
        count_lost_properties(d, e);
    } else if (r == ROLE_LOST || r == ROLE_UNKNOWN) {
        skip(d, e, why);
    }
    if (draws && !shape)
        return open_container(d, e, r, err);
    d->n_ignored = 1;
    d->ignored_line = e->line;
    d->in_title = is_for_title(d, r);
    return draws ? draw_shape(d, e, shape, err) : IL_OK;
}

/* A group that says where it is, or counts as a slice, and holds nothing at all
 * is an empty slice. */
static il_status close_container(il_svg_drawing *d, il_error *err)
{
    il_svg_frame f = d->frame[--d->n_frames];
    il_slice nothing = IL_SLICE_INIT;
    if (!f.holds && !f.own_level && !f.is_slot)
        return IL_OK;
    if (d->n_frames > 0)
        d->frame[d->n_frames - 1].holds = true;
    return f.holds ? IL_OK : il_svg_slices_add(&d->slices, level_of(&f), f.slot, d->file, f.line, &nothing, err);
}

il_status il_svg_drawing_end(il_svg_drawing *d, il_error *err)
{
    if (d->n_ignored == 0)
        return close_container(d, err);
    d->n_ignored--;
    if (d->n_ignored == 0 && d->in_title) {
        d->in_title = false;
        while (d->n_title > 0 && d->title[d->n_title - 1] == ' ')
            d->n_title--;
        d->has_title = d->n_title > 0;
    }
    return IL_OK;
}

/* White space in a title is one space, and none at its ends. */
static il_status add_to_title(il_svg_drawing *d, char c, il_error *err)
{
    bool blank = il_svg_is_blank(c);
    if (blank && (d->n_title == 0 || d->title[d->n_title - 1] == ' '))
        return IL_OK;
    if (d->n_title >= LONGEST_TITLE)
        return il_fail(err, IL_E_INPUT, 0, "the title is longer than %d bytes", LONGEST_TITLE);
    if (!il_grow(&d->title, &d->cap_title, d->n_title + 1, 1))
        return il_fail_nomem(err);
    d->title[d->n_title++] = blank ? ' ' : c;
    return IL_OK;
}

il_status il_svg_drawing_text(il_svg_drawing *d, const char *s, size_t n, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < n && d->in_title && st == IL_OK; i++)
        st = add_to_title(d, s[i], err);
    return st;
}

il_status il_svg_drawing_end_file(il_svg_drawing *d, il_error *err)
{
    if (il_svg_drawing_depth(d) > 0)
        return il_fail(err, IL_E_INPUT, d->n_ignored > 0 ? d->ignored_line : d->frame[d->n_frames - 1].line,
                       "the file ends inside this element");
    if (!d->is_seen)
        return il_fail(err, IL_E_INPUT, 0, "no element at all: this is no SVG");
    bool is_up = d->options->no_flip || (d->is_slic3r && !d->is_plate);
    il_svg_slices_end_file(&d->slices, d->file, d->file_name, !is_up, d->report);
    d->n_unscaled += !d->is_slic3r && !d->is_physical && !d->options->has_unit ? 1 : 0;
    return IL_OK;
}
