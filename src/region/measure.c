#include "config.h"
#include "region/measure.h"
#include "base/alloc.h"

#include <string.h>

/* xy: the points of one line, in degrees. */
typedef struct measure {
    il_sink sink;
    il_sink *next;
    bool is_on, is_projected;
    il_projection projection;
    double scale;               /* what metres were multiplied by */
    double *xy;
    size_t cap;
} measure;

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    static const il_ellipsoid wgs84 = IL_ELLIPSOID_WGS84;
    measure *m = (measure *)self;
    m->is_projected = head->has_geographic;
    m->is_on = head->kind == IL_KIND_TERRAIN && (head->has_geographic || head->unit == IL_UNIT_DEG);
    m->projection = head->projection;
    if (!m->is_projected)
        m->projection.ellipsoid = wgs84;
    m->scale = m->is_projected ? 1 / il_unit_metres(head->unit) : 1;
    return m->next->stack_begin(m->next, head, err);
}

static bool is_inserted(const il_ring *r, size_t i)
{
    return r->mark && r->mark[i] & IL_VERTEX_INSERTED;
}

/* Points that were put into long edges when degrees became metres are none of the geodesic; a
 * line of them alone was interpolated. */
static bool is_interpolated(const il_ring *r)
{
    for (size_t i = 0; i < r->n; i++)
        if (!is_inserted(r, i))
            return false;
    return true;
}

static il_status measure_line(measure *m, const il_ring *r, il_slice *s, il_error *err)
{
    double length, area;
    size_t n = 0;
    bool whole = is_interpolated(r);
    if (!il_grow(&m->xy, &m->cap, r->n, 2 * sizeof *m->xy))
        return il_fail_nomem(err);
    for (size_t i = 0; i < r->n; i++) {
        if (!whole && is_inserted(r, i))
            continue;
        m->xy[2 * n] = r->xy[2 * i] / m->scale;
        m->xy[2 * n++ + 1] = r->xy[2 * i + 1] / m->scale;
    }
    il_status st = m->is_projected ? il_unproject_points(&m->projection, m->xy, n, err) : IL_OK;
    if (st != IL_OK)
        return st;
    il_geodesic_measure(&m->projection.ellipsoid, m->xy, n, !r->open, &length, &area);
    s->length += length;
    s->area += area;
    return IL_OK;
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    measure *m = (measure *)self;
    il_status st = IL_OK;
    if (m->is_on)
        s->length = s->area = 0;
    for (size_t i = 0; i < s->n && m->is_on && st == IL_OK; i++)
        st = measure_line(m, &s->ring[i], s, err);
    return st == IL_OK ? m->next->slice(m->next, s, err) : st;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    measure *m = (measure *)self;
    return m->next->pair(m->next, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    measure *m = (measure *)self;
    return m->next->stack_end(m->next, err);
}

static il_status end(il_sink *self, il_error *err)
{
    measure *m = (measure *)self;
    return m->next->end(m->next, err);
}

il_status il_measure_new(il_sink **out, il_sink *next, il_error *err)
{
    measure *m = il_calloc(1, sizeof *m);
    *out = m ? &m->sink : NULL;
    if (!m)
        return il_fail_nomem(err);
    m->sink = (il_sink){ stack_begin, slice, pair, stack_end, end };
    m->next = next;
    return IL_OK;
}

void il_measure_free(il_sink *s)
{
    measure *m = (measure *)s;
    if (m)
        il_free(m->xy);
    il_free(m);
}
