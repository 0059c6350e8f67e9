#include "config.h"
#include "model/stack.h"
#include "base/alloc.h"
#include "base/text.h"

#include <string.h>

/* ---- units ---------------------------------------------------------------- */

/* International inch and foot: 25.4 mm and 12 inches exactly. */
static const struct { const char *name; double metres; } units[IL_N_UNITS] = {
    [IL_UNIT_MM] = { "mm", 1e-3 },   [IL_UNIT_CM] = { "cm", 1e-2 },   [IL_UNIT_M] = { "m", 1 },
    [IL_UNIT_KM] = { "km", 1e3 },    [IL_UNIT_IN] = { "in", 0.0254 }, [IL_UNIT_FT] = { "ft", 0.3048 },
    [IL_UNIT_UM] = { "um", 1e-6 },   [IL_UNIT_DEG] = { "deg", 0 },
};

const char *il_unit_name(il_unit u)
{
    return units[u].name;
}

bool il_unit_parse(const char *s, size_t n, il_unit *u)
{
    for (int i = 0; i < IL_N_UNITS; i++) {
        if (strlen(units[i].name) == n && memcmp(units[i].name, s, n) == 0) {
            *u = (il_unit)i;
            return true;
        }
    }
    return false;
}

double il_unit_metres(il_unit u)
{
    return units[u].metres;
}

/* ---- stack head ----------------------------------------------------------- */

enum { SHOWN_MOST = 512 }; /* bytes of the name of a file */

void il_stack_head_free(il_stack_head *h)
{
    il_free(h->name);
    il_free(h->crs);
    il_free(h->fault);
    for (size_t i = 0; i < h->n_attributes; i++) {
        il_free(h->attribute[i].key);
        il_free(h->attribute[i].value);
    }
    il_free(h->attribute);
    for (size_t i = 0; i < h->n_files; i++)
        il_free(h->file[i]);
    il_free(h->file);
    il_free(h->spot);
    il_extra_free(&h->extra);
    *h = (il_stack_head)IL_STACK_HEAD_INIT;
}

bool il_stack_head_set_name(il_stack_head *h, const char *s, size_t n)
{
    char *name = il_strndup(s, n);
    if (!name)
        return false;
    il_free(h->name);
    h->name = name;
    return true;
}

const char *il_stack_head_attribute(const il_stack_head *h, const char *key)
{
    for (size_t i = 0; i < h->n_attributes; i++)
        if (strcmp(h->attribute[i].key, key) == 0)
            return h->attribute[i].value;
    return NULL;
}

bool il_stack_head_add_attribute(il_stack_head *h, const char *key, const char *value)
{
    if (!il_grow(&h->attribute, &h->cap_attributes, h->n_attributes + 1, sizeof *h->attribute))
        return false;
    il_attribute a = { il_strndup(key, strlen(key)), il_strndup(value, strlen(value)) };
    h->attribute[h->n_attributes++] = a;
    return a.key && a.value;
}

bool il_stack_head_set_files(il_stack_head *h, const char *const *name, size_t n)
{
    char shown[SHOWN_MOST];
    h->file = il_calloc(n, sizeof *h->file);
    for (size_t i = 0; i < n && h->file; i++) {
        h->file[i] = il_strndup(shown, il_text_printable(shown, sizeof shown, name[i], strlen(name[i])));
        if (!h->file[i])
            return false;
        h->n_files++;
    }
    return h->file != NULL;
}

const char *il_stack_head_name(const il_stack_head *h)
{
    return h->name ? h->name : "";
}

void il_stack_head_place(const il_stack_head *h, const double from[3], double to[3])
{
    double x = from[0], y = from[1], z = from[2], as_is[3] = { x, y, z };
    for (int i = 0; i < 3; i++) {
        double p = h->has_frame ? h->frame[i] + x * h->frame[3 + i] + y * h->frame[6 + i] + z * h->frame[9 + i] : as_is[i];
        to[i] = p + 0.0; /* -0 becomes 0: one value, one form, whatever the input wrote */
    }
}

bool il_stack_head_mirrors(const il_stack_head *h)
{
    const double *a = h->frame + 3, *b = h->frame + 6, *c = h->frame + 9;
    return h->has_frame && a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                               a[2] * (b[0] * c[1] - b[1] * c[0]) < 0;
}

il_status il_stack_head_refuse_fault(const il_stack_head *h, il_error *err)
{
    if (!h->fault)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, h->fault_line, "stack '%.80s': %s", il_stack_head_name(h), h->fault);
}

/* Null stays null. */
static bool copy_text(char **to, const char *from)
{
    *to = from ? il_strndup(from, strlen(from)) : NULL;
    return *to || !from;
}

static bool copy_extra(il_extra **to, const il_extra *from)
{
    *to = NULL;
    for (; from; from = from->next) {
        if (!il_extra_add(to, from->text, strlen(from->text)))
            return false;
        to = &(*to)->next;
    }
    return true;
}

static bool copy_attributes(il_stack_head *to, const il_stack_head *from)
{
    if (from->n_attributes == 0)
        return true;
    to->attribute = il_alloc(from->n_attributes, sizeof *to->attribute);
    if (!to->attribute)
        return false;
    to->cap_attributes = from->n_attributes;
    for (size_t i = 0; i < from->n_attributes; i++) {
        il_attribute *a = &to->attribute[to->n_attributes++];
        *a = (il_attribute){ NULL, NULL };
        if (!copy_text(&a->key, from->attribute[i].key) || !copy_text(&a->value, from->attribute[i].value))
            return false;
    }
    return true;
}

static bool copy_files(il_stack_head *to, const il_stack_head *from)
{
    if (from->n_files == 0)
        return true;
    to->file = il_calloc(from->n_files, sizeof *to->file);
    for (; to->file && to->n_files < from->n_files; to->n_files++)
        if (!copy_text(&to->file[to->n_files], from->file[to->n_files]))
            return false;
    return to->file != NULL;
}

static bool copy_spots(il_stack_head *to, const il_stack_head *from)
{
    if (from->n_spots == 0)
        return true;
    to->spot = il_alloc(from->n_spots, sizeof *to->spot);
    if (!to->spot)
        return false;
    memcpy(to->spot, from->spot, from->n_spots * sizeof *to->spot);
    to->n_spots = to->cap_spots = from->n_spots;
    return true;
}

il_status il_stack_head_copy(il_stack_head *to, const il_stack_head *from, il_error *err)
{
    *to = *from;
    to->name = to->crs = to->fault = NULL;
    to->attribute = NULL;
    to->n_attributes = to->cap_attributes = 0;
    to->file = NULL;
    to->n_files = 0;
    to->spot = NULL;
    to->n_spots = to->cap_spots = 0;
    to->extra = NULL;
    if (copy_text(&to->name, from->name) && copy_text(&to->crs, from->crs) &&
        copy_text(&to->fault, from->fault) &&
        copy_attributes(to, from) && copy_files(to, from) && copy_spots(to, from) &&
        copy_extra(&to->extra, from->extra))
        return IL_OK;
    il_stack_head_free(to);
    return il_fail_nomem(err);
}

/* ---- slice ---------------------------------------------------------------- */

void il_slice_free(il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        il_ring_free(&s->ring[i]);
    il_free(s->ring);
    il_extra_free(&s->extra);
    *s = (il_slice)IL_SLICE_INIT;
}

il_ring *il_slice_add_ring(il_slice *s)
{
    if (!il_grow(&s->ring, &s->cap, s->n + 1, sizeof *s->ring))
        return NULL;
    s->ring[s->n] = (il_ring)IL_RING_INIT;
    return &s->ring[s->n++];
}

double il_slice_area(const il_slice *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++)
        sum += il_ring_area2(&s->ring[i]);
    return sum / 2;
}

size_t il_slice_points(const il_slice *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++)
        n += s->ring[i].n;
    return n;
}

static unsigned char mark_of(const il_ring *r, size_t i)
{
    return r->mark ? r->mark[i] : 0;
}

bool il_slice_is_inserted(const il_slice *s)
{
    bool any = false;
    for (size_t i = 0; i < s->n; i++) {
        any |= s->ring[i].n > 0;
        for (size_t k = 0; k < s->ring[i].n; k++)
            if (!(mark_of(&s->ring[i], k) & IL_VERTEX_INSERTED))
                return false;
    }
    return any;
}

bool il_slice_equal_rings(const il_slice *a, const il_slice *b)
{
    if (a->n != b->n)
        return false;
    for (size_t i = 0; i < a->n; i++) {
        const il_ring *p = &a->ring[i], *q = &b->ring[i];
        if (p->n != q->n || (p->n > 0 && memcmp(p->xy, q->xy, 2 * p->n * sizeof *p->xy) != 0))
            return false;
        for (size_t k = 0; k < p->n; k++)
            if (mark_of(p, k) != mark_of(q, k))
                return false;
    }
    return true;
}

static bool copy_ring(il_ring *to, const il_ring *from)
{
    to->open = from->open;
    il_ring_take_origin(to, from);
    if (from->n > 0) {
        if (!il_grow(&to->xy, &to->cap, from->n, 2 * sizeof *to->xy))
            return false;
        memcpy(to->xy, from->xy, from->n * 2 * sizeof *to->xy);
    }
    if (from->n > 0 && from->mark) {
        if (!il_grow(&to->mark, &to->cap_mark, from->n, sizeof *to->mark))
            return false;
        memcpy(to->mark, from->mark, from->n * sizeof *to->mark);
    }
    to->n = from->n;
    return copy_extra(&to->extra, from->extra);
}

il_status il_slice_copy(il_slice *to, const il_slice *from, il_error *err)
{
    *to = (il_slice)IL_SLICE_INIT;
    to->z = from->z;
    to->line = from->line;
    to->length = from->length;
    to->area = from->area;
    bool ok = copy_extra(&to->extra, from->extra);
    for (size_t i = 0; ok && i < from->n; i++) {
        il_ring *r = il_slice_add_ring(to);
        ok = r && copy_ring(r, &from->ring[i]);
    }
    if (ok)
        return IL_OK;
    il_slice_free(to);
    return il_fail_nomem(err);
}
