/* native.c - contours in the native format's canonical form (formats/loft.txt,
 * section 9), as they come: one slice is held in memory, and nothing else. */
#include "config.h"
#include "output/native.h"
#include "output/writer.h"
#include "base/alloc.h"
#include "base/text.h"
#include "model/order.h"

#include <stdlib.h>
#include <string.h>

typedef struct writer {
    il_sink sink;           /* first: a sink is a writer */
    il_output *to;
    bool begun, has_unit;
    il_unit unit;           /* last one written */
    il_ring_order *order;   /* of the slice at hand */
    size_t cap_order;
    bool lower_in_order, upper_in_order; /* the last two slices came as they are written */
} writer;

/* ---- words ------------------------------------------------------------------- */

void il_native_put_number(il_output *to, double v)
{
    il_output_char(to, ' ');
    il_output_number(to, v);
}

void il_native_put_index(il_output *to, uint32_t v)
{
    il_output_char(to, ' ');
    il_output_integer(to, v);
}

/* One character of N bytes; N is 0 for a byte that is not UTF-8, which strings
 * of the model do not hold, but which a reader would refuse. */
static void put_character(il_output *to, const char *s, size_t n)
{
    char shown[17];
    if (n == 0) {
        il_output_string(to, "\xEF\xBF\xBD"); /* U+FFFD, the replacement character */
    } else if (*s == '"' || *s == '\\') {
        il_output_char(to, '\\');
        il_output_char(to, *s);
    } else if (*s == '\n') {
        il_output_string(to, "\\n");
    } else {
        il_text_printable(shown, sizeof shown, s, n);
        il_output_string(to, shown);
    }
}

void il_native_put_string(il_output *to, const char *s)
{
    size_t n = strlen(s);
    il_output_string(to, " \"");
    for (size_t i = 0; i < n;) {
        size_t length = il_utf8_char(s + i, n - i, NULL);
        put_character(to, s + i, length);
        i += length > 0 ? length : 1;
    }
    il_output_char(to, '"');
}

void il_native_write_extra(il_output *to, const il_extra *extra)
{
    for (; extra; extra = extra->next) {
        il_output_string(to, extra->text);
        il_output_char(to, '\n');
    }
}

/* ---- stacks ------------------------------------------------------------------ */

static void begin_stream(writer *w)
{
    if (!w->begun)
        il_output_string(w->to, "isoloft 1\n");
    w->begun = true;
}

static void write_unit(writer *w, il_unit unit)
{
    if (w->has_unit && w->unit == unit)
        return;
    w->has_unit = true;
    w->unit = unit;
    il_output_string(w->to, "unit ");
    il_output_string(w->to, il_unit_name(unit));
    il_output_char(w->to, '\n');
}

static void write_color(il_output *to, const unsigned char *color)
{
    il_output_string(to, "color");
    for (int i = 0; i < 3; i++)
        il_native_put_index(to, color[i]);
    il_output_char(to, '\n');
}

/* How degrees became the numbers of the stack. */
static void write_geographic(il_output *to, const il_stack_head *h)
{
    const il_projection *p = &h->projection;
    bool polar = p->kind == IL_PROJECTION_STEREOGRAPHIC;
    const double v[] = { p->ellipsoid.a, p->ellipsoid.f, p->lon0, polar ? (p->north ? 90 : -90) : p->lat0, p->k0, p->x0, p->y0 };
    il_output_string(to, "geographic");
    for (int i = 0; i < 4; i++)
        il_native_put_number(to, h->geographic[i]);
    il_output_string(to, polar ? "\nprojection polar" : "\nprojection tm");
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        il_native_put_number(to, v[i]);
    il_output_char(to, '\n');
}

static void write_frame(il_output *to, const double *frame)
{
    il_output_string(to, "frame");
    for (int i = 0; i < 12; i++)
        il_native_put_number(to, frame[i]);
    il_output_char(to, '\n');
}

static void write_attributes(il_output *to, const il_stack_head *h)
{
    for (size_t i = 0; i < h->n_attributes; i++) {
        il_output_string(to, "attribute");
        il_native_put_string(to, h->attribute[i].key);
        il_native_put_string(to, h->attribute[i].value);
        il_output_char(to, '\n');
    }
}

static void write_spots(il_output *to, const il_stack_head *h)
{
    for (size_t i = 0; i < h->n_spots; i++) {
        il_output_string(to, "spot");
        il_native_put_number(to, h->spot[i].x);
        il_native_put_number(to, h->spot[i].y);
        il_native_put_number(to, h->spot[i].z);
        il_output_char(to, '\n');
    }
}

static void write_head(il_output *to, const il_stack_head *h)
{
    il_output_string(to, "stack");
    il_native_put_string(to, il_stack_head_name(h));
    il_output_char(to, '\n');
    if (h->has_number) {
        il_output_string(to, "number ");
        il_output_integer(to, h->number);
        il_output_char(to, '\n');
    }
    if (h->kind == IL_KIND_TERRAIN)
        il_output_string(to, "kind terrain\n");
    if (h->has_color)
        write_color(to, h->color);
    if (h->crs && h->crs[0]) {
        il_output_string(to, "crs");
        il_native_put_string(to, h->crs);
        il_output_char(to, '\n');
    }
    if (h->has_geographic)
        write_geographic(to, h);
    if (h->has_frame)
        write_frame(to, h->frame);
    write_attributes(to, h);
    write_spots(to, h);
    il_native_write_extra(to, h->extra);
}

static il_status take_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    writer *w = (writer *)self;
    begin_stream(w);
    write_unit(w, head->unit);
    write_head(w->to, head);
    return il_output_status(w->to, err);
}

/* ---- slices ------------------------------------------------------------------ */

static void write_marks(il_output *to, const il_ring_order *o, const char *word, unsigned char mark)
{
    const il_ring *r = o->ring;
    bool any = false;
    for (size_t i = 0; i < r->n; i++) {
        size_t k = o->first + i < r->n ? o->first + i : o->first + i - r->n;
        if (!(r->mark[k] & mark))
            continue;
        if (!any)
            il_output_string(to, word);
        any = true;
        il_native_put_index(to, (uint32_t)i);
    }
    if (any)
        il_output_char(to, '\n');
}

static void write_vertices(il_output *to, const il_ring *r, size_t from, size_t n)
{
    for (size_t i = from; i < n; i++) {
        il_output_number(to, r->xy[2 * i]);
        il_output_char(to, ' ');
        il_output_number(to, r->xy[2 * i + 1]);
        il_output_char(to, '\n');
    }
}

static void write_ring(il_output *to, const il_ring_order *o)
{
    il_output_string(to, o->ring->open ? "line\n" : "ring\n");
    write_vertices(to, o->ring, o->first, o->ring->n);
    write_vertices(to, o->ring, 0, o->first);
    if (o->ring->mark) {
        write_marks(to, o, "inserted", IL_VERTEX_INSERTED);
        write_marks(to, o, "map-edge", IL_VERTEX_MAP_EDGE);
    }
    il_native_write_extra(to, o->ring->extra);
}

/* Find the order in which S is written, and whether it came in that order. */
static il_status order_rings(writer *w, const il_slice *s, il_error *err)
{
    if (!il_grow(&w->order, &w->cap_order, s->n, sizeof *w->order))
        return il_fail_nomem(err);
    for (size_t i = 0; i < s->n; i++)
        w->order[i] = (il_ring_order){ &s->ring[i], il_ring_first(&s->ring[i]), i };
    if (s->n > 1)
        qsort(w->order, s->n, sizeof *w->order, il_ring_order_compare);
    w->lower_in_order = w->upper_in_order;
    w->upper_in_order = true;
    for (size_t i = 0; i < s->n; i++)
        w->upper_in_order = w->upper_in_order && w->order[i].index == i && w->order[i].first == 0;
    return IL_OK;
}

static il_status take_slice(il_sink *self, il_slice *slice, il_error *err)
{
    writer *w = (writer *)self;
    il_status st = order_rings(w, slice, err);
    if (st != IL_OK)
        return st;
    il_output_string(w->to, "slice");
    il_native_put_number(w->to, slice->z);
    il_output_char(w->to, '\n');
    il_native_write_extra(w->to, slice->extra);
    for (size_t i = 0; i < slice->n; i++)
        write_ring(w->to, &w->order[i]);
    return il_output_status(w->to, err);
}

static il_status take_pair(il_sink *self, il_pair *pair, il_error *err)
{
    writer *w = (writer *)self;
    if (!pair->gap && (!w->lower_in_order || !w->upper_in_order))
        return il_fail(err, IL_E_INTERNAL, pair->line, "a pair of slices whose rings are not in canonical order");
    il_status st = il_native_write_pair(w->to, pair, err);
    return st == IL_OK ? il_output_status(w->to, err) : st;
}

static il_status take_stack_end(il_sink *self, il_error *err)
{
    return il_output_status(((writer *)self)->to, err);
}

static il_status take_end(il_sink *self, il_error *err)
{
    writer *w = (writer *)self;
    begin_stream(w);
    il_output_string(w->to, "end\n");
    return il_output_status(w->to, err);
}

/* ---- the writer -------------------------------------------------------------- */

static il_status contours_new(il_sink **out, il_output *to, il_error *err)
{
    writer *w = il_calloc(1, sizeof *w);
    *out = NULL;
    if (!w)
        return il_fail_nomem(err);
    w->sink = (il_sink){ take_stack, take_slice, take_pair, take_stack_end, take_end };
    w->to = to;
    *out = &w->sink;
    return IL_OK;
}

static void contours_free(il_sink *s)
{
    if (s)
        il_free(((writer *)s)->order);
    il_free(s);
}

const il_writer il_writer_loft = {
    .name = "loft",
    .extension = "loft",
    .words = "isoloft's own format: contours and correspondences",
    .contours_new = contours_new,
    .contours_free = contours_free,
};
