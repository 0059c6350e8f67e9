#include "config.h"
#include "match/course.h"
#include "base/alloc.h"

#include <math.h>

void il_course_free(il_course *c)
{
    il_free(c->point);
    il_free(c->first);
    il_free(c->length);
    *c = (il_course)IL_COURSE_INIT;
}

static bool add_point(il_course *c, const il_course_point *p)
{
    if (!il_grow(&c->point, &c->cap, c->n + 1, sizeof *c->point))
        return false;
    c->point[c->n++] = *p;
    return true;
}

/* From row A up to row B, which lie on edge A.vertex of LENGTH, begun at AT. */
static bool add_piece(il_course *c, const il_course_row *a, const il_course_row *b, double end_t, double at, double length)
{
    double share = end_t - a->t;
    size_t parts = (size_t)fmax(1, ceil(length * share / c->spacing));
    for (size_t k = 0; k < parts; k++) {
        double u = (double)k / (double)parts;
        il_course_point p = { a->x + u * (b->x - a->x), a->y + u * (b->y - a->y), 0, 0, at + length * (a->t + u * share),
                              a->t + u * share, a->vertex, (uint32_t)c->n_rings };
        if (!add_point(c, &p))
            return false;
    }
    return true;
}

static il_course_row row_at(const double *xy, const il_course_row *row, size_t k)
{
    return row ? row[k] : (il_course_row){ (uint32_t)k, 0, xy[2 * k], xy[2 * k + 1] };
}

il_status il_course_add(il_course *c, const double *xy, size_t n, const il_course_row *row, size_t n_rows, il_error *err)
{
    if (!il_grow(&c->first, &c->cap_first, c->n_rings + 2, sizeof *c->first) ||
        !il_grow(&c->length, &c->cap_length, c->n_rings + 1, sizeof *c->length))
        return il_fail_nomem(err);
    double at = 0, length = 0;
    n_rows = row ? n_rows : n;
    c->first[c->n_rings] = c->n;
    for (size_t k = 0; k < n_rows; k++) {
        il_course_row a = row_at(xy, row, k), b = row_at(xy, row, k + 1 < n_rows ? k + 1 : 0);
        if (a.t == 0) { /* a vertex: its edge begins */
            size_t v = a.vertex, w = v + 1 < n ? v + 1 : 0;
            at += length;
            length = hypot(xy[2 * w] - xy[2 * v], xy[2 * w + 1] - xy[2 * v + 1]);
        }
        if (!add_piece(c, &a, &b, b.vertex == a.vertex && b.t > a.t ? b.t : 1, at, length))
            return il_fail_nomem(err);
    }
    c->length[c->n_rings++] = at + length;
    c->first[c->n_rings] = c->n;
    return IL_OK;
}

void il_course_set_normals(il_course *c)
{
    for (size_t k = 0; k < c->n; k++) {
        const il_course_point *a = &c->point[il_course_before(c, k)], *b = &c->point[il_course_after(c, k)];
        double dx = b->x - a->x, dy = b->y - a->y, length = hypot(dx, dy);
        c->point[k].nx = length > 0 ? dy / length : 0;
        c->point[k].ny = length > 0 ? -dx / length : 0;
    }
}
