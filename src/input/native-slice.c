/* native-slice.c - stacks, slices and rings of the native format. */
#include "config.h"
#include "input/native.h"
#include "base/alloc.h"
#include "model/order.h"
#include "model/spots.h"

#include <string.h>

/* ---- stacks ------------------------------------------------------------------ */

enum { SEEN_NUMBER = 1, SEEN_KIND = 2, SEEN_COLOR = 4, SEEN_CRS = 8, SEEN_FRAME = 16, SEEN_GEOGRAPHIC = 32, SEEN_PROJECTION = 64 };

static il_status once(il_native *n, unsigned bit, const char *word)
{
    if (n->seen & bit)
        return il_native_fail(n, "'%s' stands twice in the header of this stack", word);
    n->seen |= bit;
    return IL_OK;
}

static il_status take_unit(il_native *n)
{
    size_t length;
    const char *word = il_scan_peek(&n->at, &length);
    if (!il_unit_parse(word, length, &n->unit))
        return il_native_fail(n, "'%.*s' is not a unit: mm, cm, m, km, um, in, ft or deg", il_scan_shown(length), word);
    n->at.p += length;
    n->has_unit = true;
    return IL_OK;
}

static void forget_stack(il_native *n)
{
    il_stack_head_free(&n->head);
    il_slice_free(&n->slice);
    n->holds_slice = n->pair_done = false;
    n->seen = 0;
    n->geographic_line = n->projection_line = 0;
    n->slices = n->points = 0;
}

static il_status take_stack(il_native *n)
{
    if (!n->has_unit)
        return il_native_fail(n, "no 'unit' stands before this stack");
    forget_stack(n);
    n->in = IL_IN_HEAD;
    n->extra = &n->head.extra;
    n->head.line = n->at.line;
    n->head.unit = n->options->has_unit ? n->options->unit : n->unit;
    if (n->head.unit != n->unit)
        il_report_note(n->report, "numbers taken as %s, as asked for, where the stream says %s",
                       il_unit_name(n->head.unit), il_unit_name(n->unit));
    return il_scan_string(&n->at, &n->head.name, n->err);
}

static il_status take_stack_number(il_native *n)
{
    il_status st = once(n, SEEN_NUMBER, "number");
    n->head.has_number = true;
    return st != IL_OK ? st : il_scan_integer(&n->at, -2147483647 - 1, 2147483647, &n->head.number, n->err);
}

static il_status take_kind(il_native *n)
{
    static const char *const kinds[] = { "solid", "terrain", NULL };
    int kind = 0;
    il_status st = once(n, SEEN_KIND, "kind");
    if (st == IL_OK)
        st = il_scan_choice(&n->at, kinds, "a kind: solid or terrain", &kind, n->err);
    n->head.kind = (il_kind)kind;
    return st;
}

static il_status take_color(il_native *n)
{
    il_status st = once(n, SEEN_COLOR, "color");
    for (int i = 0; st == IL_OK && i < 3; i++) {
        uint32_t v = 0;
        st = il_scan_index(&n->at, &v, n->err);
        if (st == IL_OK && v > 255)
            st = il_native_fail(n, "%lu is not a colour value from 0 to 255", (unsigned long)v);
        n->head.color[i] = (unsigned char)v;
    }
    n->head.has_color = true;
    return st;
}

static il_status take_crs(il_native *n)
{
    il_status st = once(n, SEEN_CRS, "crs");
    if (st == IL_OK)
        st = il_scan_string(&n->at, &n->head.crs, n->err);
    if (st == IL_OK && !n->head.crs[0])
        st = il_native_fail(n, "'crs' is empty");
    return st;
}

static il_status take_geographic(il_native *n)
{
    il_status st = once(n, SEEN_GEOGRAPHIC, "geographic");
    return st != IL_OK ? st : il_native_take_geographic(n);
}

static il_status take_projection(il_native *n)
{
    il_status st = once(n, SEEN_PROJECTION, "projection");
    return st != IL_OK ? st : il_native_take_projection(n);
}

static double determinant(const double *a, const double *b, const double *c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static il_status take_frame(il_native *n)
{
    double *f = n->head.frame;
    il_status st = once(n, SEEN_FRAME, "frame");
    if (st == IL_OK)
        st = il_scan_numbers(&n->at, f, 12, n->err);
    n->head.has_frame = true;
    if (st == IL_OK && !(determinant(f + 3, f + 6, f + 9) > 0))
        st = il_native_fail(n, "the axes of the frame are not three right-handed directions");
    return st;
}

static il_status take_attribute(il_native *n)
{
    il_stack_head *h = &n->head;
    if (!il_grow(&h->attribute, &h->cap_attributes, h->n_attributes + 1, sizeof *h->attribute))
        return il_native_nomem(n);
    il_attribute *a = &h->attribute[h->n_attributes++];
    *a = (il_attribute){ NULL, NULL };
    il_status st = il_scan_string(&n->at, &a->key, n->err);
    return st != IL_OK ? st : il_scan_string(&n->at, &a->value, n->err);
}

/* Each is a point more of the stack. */
static il_status take_spot(il_native *n)
{
    il_stack_head *h = &n->head;
    double xyz[3];
    il_status st = il_scan_numbers(&n->at, xyz, 3, n->err);
    if (st == IL_OK && n->points >= n->options->max_points)
        st = il_native_fail(n, "more than %zu vertices in one stack", n->points);
    if (st == IL_OK && !il_grow(&h->spot, &h->cap_spots, h->n_spots + 1, sizeof *h->spot))
        st = il_native_nomem(n);
    if (st != IL_OK)
        return st;
    n->points++;
    h->spot[h->n_spots++] = (il_spot){ .x = xyz[0] + 0.0, .y = xyz[1] + 0.0, .z = xyz[2] + 0.0, .line = n->at.line };
    return IL_OK;
}

static il_status check_spots(il_native *n)
{
    const il_stack_head *h = &n->head;
    if (h->n_spots > 0 && h->kind != IL_KIND_TERRAIN)
        return il_native_fail_at(n, h->spot[0].line, "a spot height stands in a stack that is no terrain");
    il_spots_sort(h->spot, h->n_spots);
    for (size_t i = 1; i < h->n_spots; i++)
        if (il_spots_meet(&h->spot[i - 1], &h->spot[i]))
            return il_native_fail_at(n, h->spot[i].line, "another spot height stands at this place, in line %ld", h->spot[i - 1].line);
    return IL_OK;
}

il_status il_native_close_head(il_native *n)
{
    il_status st = check_spots(n);
    if (st == IL_OK)
        st = il_native_check_geographic(n);
    if (st == IL_OK && !il_stack_head_set_files(&n->head, &n->name, 1))
        st = il_native_nomem(n);
    return st != IL_OK ? st : n->sink->stack_begin(n->sink, &n->head, n->err);
}

il_status il_native_close_stack(il_native *n)
{
    il_status st = il_native_flush_slice(n);
    return st != IL_OK ? st : n->sink->stack_end(n->sink, n->err);
}

const il_native_keyword il_native_stack_keywords[] = {
    { "unit", IL_IN_STREAM, take_unit },
    { "stack", IL_IN_STREAM, take_stack },
    { "number", IL_IN_HEAD, take_stack_number },
    { "kind", IL_IN_HEAD, take_kind },
    { "color", IL_IN_HEAD, take_color },
    { "crs", IL_IN_HEAD, take_crs },
    { "geographic", IL_IN_HEAD, take_geographic },
    { "projection", IL_IN_HEAD, take_projection },
    { "frame", IL_IN_HEAD, take_frame },
    { "attribute", IL_IN_HEAD, take_attribute },
    { "spot", IL_IN_HEAD, take_spot },
    { NULL, IL_IN_STREAM, NULL },
};

/* ---- slices ------------------------------------------------------------------ */

static il_status measure_shape(il_native *n, il_native_shape *shape, const il_slice *s)
{
    if (!il_grow(&shape->vertices, &shape->cap_vertices, s->n, sizeof *shape->vertices) ||
        !il_grow(&shape->group, &shape->cap_group, s->n, sizeof *shape->group))
        return il_native_nomem(n);
    shape->n = s->n;
    shape->all_rings = true;
    shape->in_order = il_slice_in_order(s);
    for (size_t i = 0; i < s->n; i++) {
        shape->vertices[i] = (uint32_t)s->ring[i].n;
        shape->all_rings = shape->all_rings && !s->ring[i].open && s->ring[i].n >= 3;
    }
    return IL_OK;
}

/* A slice is held until what follows shows that it is whole. */
il_status il_native_flush_slice(il_native *n)
{
    if (!n->holds_slice)
        return IL_OK;
    n->holds_slice = false;
    il_native_shape lower = n->lower;
    n->lower = n->upper;
    n->upper = lower;
    il_status st = measure_shape(n, &n->upper, &n->slice);
    if (st == IL_OK)
        st = n->sink->slice(n->sink, &n->slice, n->err);
    il_slice_free(&n->slice);
    return st;
}

static il_status begin_slice(il_native *n, double z)
{
    il_status st = il_native_flush_slice(n);
    n->slice.z = n->z = z;
    n->slice.line = n->at.line;
    n->slice_extra = &n->slice.extra;
    n->holds_slice = true;
    n->pair_done = false;
    n->slices++;
    return st;
}

static il_status take_slice(il_native *n)
{
    double z = 0;
    il_status st = il_scan_number(&n->at, &z, n->err);
    if (st != IL_OK)
        return st;
    if (n->slices > 0 && z < n->z)
        return il_native_fail(n, "this slice lies below the one before it; slices stand in rising z");
    if (n->slices > 0 && z == n->z && n->pair_done)
        return il_native_fail(n, "this slice lies at the height of the one before it, which has its pair or gap already");
    if (n->slices > 0 && z == n->z)
        il_report_repair(n->report, IL_REPAIR_MERGED_SLICE, 1);
    else
        st = begin_slice(n, z);
    n->in = IL_IN_SLICE;
    n->extra = n->slice_extra;
    return st;
}

/* ---- rings ------------------------------------------------------------------- */

static il_ring *open_ring(il_native *n)
{
    return &n->slice.ring[n->slice.n - 1];
}

static il_status begin_ring(il_native *n, bool open)
{
    if (n->slice.n == UINT32_MAX)
        return il_native_fail(n, "more than 4294967295 rings in one slice");
    il_ring *r = il_slice_add_ring(&n->slice);
    if (!r)
        return il_native_nomem(n);
    r->open = open;
    r->line = n->at.line;
    n->in = IL_IN_RING;
    n->extra = &r->extra;
    n->marked = false;
    n->counted = !il_scan_at_end(&n->at);
    return n->counted ? il_scan_index(&n->at, &n->count, n->err) : IL_OK;
}

static il_status take_ring(il_native *n)
{
    return begin_ring(n, false);
}

static il_status take_open_line(il_native *n)
{
    return begin_ring(n, true);
}

il_status il_native_take_vertex(il_native *n)
{
    double x = 0, y = 0;
    il_ring *r = open_ring(n);
    il_status st = il_scan_number(&n->at, &x, n->err);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &y, n->err);
    if (st != IL_OK)
        return st;
    if (n->marked)
        return il_native_fail(n, "a vertex cannot stand behind the marks of its ring");
    if (n->points >= n->options->max_points || r->n == UINT32_MAX)
        return il_native_fail(n, "more than %zu vertices in one stack", n->points);
    n->points++;
    return il_ring_add(r, x, y, 0) ? IL_OK : il_native_nomem(n);
}

/* The marks of the open ring, made when the first one comes. */
static unsigned char *ring_marks(il_native *n, il_ring *r)
{
    if (!r->mark) {
        r->mark = il_calloc(r->n, 1);
        r->cap_mark = r->mark ? r->n : 0;
    }
    if (!r->mark)
        il_native_nomem(n);
    return r->mark;
}

static il_status take_mark_line(il_native *n, unsigned char mark)
{
    il_ring *r = open_ring(n);
    size_t marked_below = mark == IL_VERTEX_MAP_EDGE && r->open && r->n > 0 ? r->n - 1 : r->n;
    n->marked = true;
    do {
        uint32_t i = 0;
        il_status st = il_scan_index(&n->at, &i, n->err);
        if (st != IL_OK)
            return st;
        if (i >= marked_below)
            return il_native_fail(n, "there is no %s %lu to mark", mark == IL_VERTEX_MAP_EDGE ? "edge" : "vertex",
                                  (unsigned long)i);
        unsigned char *marks = ring_marks(n, r);
        if (!marks)
            return IL_E_NOMEM;
        marks[i] |= mark;
    } while (!il_scan_at_end(&n->at));
    return IL_OK;
}

static il_status take_inserted(il_native *n)
{
    return take_mark_line(n, IL_VERTEX_INSERTED);
}

static il_status take_map_edge(il_native *n)
{
    return take_mark_line(n, IL_VERTEX_MAP_EDGE);
}

il_status il_native_close_ring(il_native *n)
{
    const il_ring *r = open_ring(n);
    if (n->counted && r->n != n->count)
        return il_fail(n->err, IL_E_INPUT, r->line, "%lu vertices were announced, and there are %zu",
                       (unsigned long)n->count, r->n);
    return IL_OK;
}

const il_native_keyword il_native_slice_keywords[] = {
    { "slice", IL_IN_STACK, take_slice },
    { "ring", IL_IN_SLICE, take_ring },
    { "line", IL_IN_SLICE, take_open_line },
    { "inserted", IL_IN_RING, take_inserted },
    { "map-edge", IL_IN_RING, take_map_edge },
    { NULL, IL_IN_STREAM, NULL },
};
