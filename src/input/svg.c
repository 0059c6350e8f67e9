/* svg.c - SVG-like polylines (formats/svg.txt): libxml2's push parser between
 * the feed, which cuts the bytes, and the drawing, which knows what they mean. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "input/svg-drawing.h"
#include "input/xml-push.h"

#include <string.h>

/* ---- from the parser to the drawing --------------------------------------------- */

static bool declares_slic3r(const il_xml_element *e)
{
    for (size_t i = 0; i < e->n_bindings; i++)
        if (il_svg_namespace_of(NULL, (const char *)e->binding[2 * i + 1]) == IL_SVG_NS_SLIC3R)
            return true;
    return false;
}

static il_status on_start(void *self, const il_xml_element *e, il_error *err)
{
    il_svg_element drawn = { e->name, il_svg_namespace_of(e->prefix, e->uri), e->attribute, e->n_attributes,
                             declares_slic3r(e), e->line };
    return il_svg_drawing_start(self, &drawn, err);
}

static il_status on_end(void *self, long line, il_error *err)
{
    il_svg_drawing *d = self;
    (void)line;
    d->at.name = NULL;
    return il_svg_drawing_end(d, err);
}

static il_status on_text(void *self, const char *s, size_t n, long line, il_error *err)
{
    il_svg_drawing *d = self;
    (void)line;
    d->at.name = NULL;
    return il_svg_drawing_text(d, s, n, err);
}

static il_status on_finish(void *self, long line, il_error *err)
{
    (void)line;
    return il_svg_drawing_end_file(self, err);
}

/* The line of what was refused: inside an attribute that may be a later one. */
static long place(void *self, const il_xml_token *t)
{
    const il_svg_text *at = &((il_svg_drawing *)self)->at;
    return at->name ? il_xml_token_line(t, at->name, at->at) : t->line;
}

static const il_xml_client client = {
    .what = "SVG",
    .start = on_start,
    .end = on_end,
    .text = on_text,
    .finish = on_finish,
    .place = place,
};

static il_status read_file(il_svg_drawing *drawing, il_source *source, size_t number, il_error *err)
{
    il_svg_drawing_begin_file(drawing, number, il_source_name(source));
    il_status st = il_xml_read(source, &client, drawing, drawing->options->max_line, err);
    if (st != IL_OK)
        il_error_set_file(err, il_source_name(source));
    return st;
}

/* ---- the reader ---------------------------------------------------------------------- */

static il_status send(il_svg_drawing *d, il_source *const *source, size_t n, il_sink *sink, il_error *err)
{
    const il_read_options *o = d->options;
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_status st = IL_OK;
    head.unit = o->has_unit ? o->unit : IL_UNIT_MM;
    if (d->n_unscaled > 0)
        il_report_note(d->report, "user units are taken as mm (--unit tells otherwise)");
    if (!il_stack_head_set_name(&head, d->title ? d->title : "", d->n_title))
        st = il_fail_nomem(err);
    else
        st = il_svg_slices_send(&d->slices, &head, source, n, o, sink, d->report, err);
    il_stack_head_free(&head);
    return st;
}

static il_status read_svg(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    if (options->has_spacing && !(options->spacing > 0 && options->spacing < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "the spacing must be above 0");
    il_svg_drawing d;
    il_status st = IL_OK;
    il_svg_drawing_init(&d, options, report);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        st = read_file(&d, source[i], i, err);
    if (st == IL_OK)
        st = send(&d, source, n, sink, err);
    il_svg_drawing_free(&d);
    return st;
}

/* ---- the probe ------------------------------------------------------------------------- */

static bool is_svg_name(const char *s, size_t n)
{
    static const char *const names[] = { "svg", "g", "polygon", "polyline", "path", "line", "rect", "circle",
        "ellipse" };
    if (n > 4 && memcmp(s, "svg:", 4) == 0)
        s += 4, n -= 4;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (n == strlen(names[i]) && memcmp(s, names[i], n) == 0)
            return true;
    return false;
}

/* The document type is svg, or there is none and the first element is SVG's. */
static bool probe(const unsigned char *head, size_t n)
{
    bool is_type;
    size_t n_name;
    const char *name = il_xml_first_name((const char *)head, n, &n_name, &is_type);
    return is_type ? n_name == 3 && memcmp(name, "svg", 3) == 0 : is_svg_name(name, n_name);
}

const il_reader il_reader_svg = {
    .name = "svg",
    .extensions = "svg",
    .words = "SVG-like polylines, paths and shapes by layer",
    .probe = probe,
    .read = read_svg,
};
