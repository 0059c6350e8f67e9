#include "config.h"
#include "match/patch.h"
#include "base/alloc.h"

#include <math.h>

void il_patch_free(il_patch *p)
{
    il_free(p->edge);
    il_nearest_free(&p->tree);
    *p = (il_patch)IL_PATCH_INIT;
}

bool il_patch_add(il_patch *p, const il_ring *r, bool turned)
{
    if (!il_grow(&p->edge, &p->cap, p->n + r->n, sizeof *p->edge))
        return false;
    for (size_t i = 0; i < r->n; i++) {
        const double *a = r->xy + 2 * i, *b = r->xy + 2 * (i + 1 < r->n ? i + 1 : 0);
        p->edge[p->n] = turned ? (il_segment){ b[0], b[1], a[0], a[1], 0, p->n } : (il_segment){ a[0], a[1], b[0], b[1], 0, p->n };
        p->n++;
    }
    return true;
}

void il_patch_move(il_patch *p, const double by[2])
{
    for (size_t i = 0; i < p->n; i++) {
        il_segment *e = &p->edge[i];
        e->ax += by[0], e->ay += by[1];
        e->bx += by[0], e->by += by[1];
    }
}

/* About the first end of the first edge, which keeps terms small. */
static void measure(il_patch *p)
{
    const il_segment *o = p->edge;
    double sum = 0, x = 0, y = 0;
    p->box[0] = p->box[1] = INFINITY;
    p->box[2] = p->box[3] = -INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        const il_segment *e = &p->edge[i];
        double ax = e->ax - o->ax, ay = e->ay - o->ay, bx = e->bx - o->ax, by = e->by - o->ay, w = ax * by - bx * ay;
        sum += w;
        x += w * (ax + bx);
        y += w * (ay + by);
        p->box[0] = fmin(p->box[0], e->ax), p->box[1] = fmin(p->box[1], e->ay);
        p->box[2] = fmax(p->box[2], e->ax), p->box[3] = fmax(p->box[3], e->ay);
    }
    p->area = sum / 2;
    p->centre[0] = p->n > 0 ? o->ax + x / (3 * sum) : 0;
    p->centre[1] = p->n > 0 ? o->ay + y / (3 * sum) : 0;
}

il_status il_patch_plant(il_patch *p, il_error *err)
{
    il_segment *copy = il_alloc(p->n, sizeof *copy);
    if (!copy)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n; i++)
        copy[i] = p->edge[i];
    measure(p);
    return il_nearest_build(&p->tree, copy, p->n, 1, err);
}

/* How many edges a ray from (x, y) to the right goes through. */
typedef struct ray { double x, y; size_t n; } ray;

static bool cross(void *context, const il_segment *e)
{
    ray *r = context;
    r->n += (e->ay > r->y) != (e->by > r->y) && r->x < e->ax + (r->y - e->ay) / (e->by - e->ay) * (e->bx - e->ax);
    return false;
}

void il_patch_nearest(const il_patch *p, const double at[2], double nearest[2])
{
    const double box[4] = { at[0], at[1], INFINITY, at[1] };
    ray r = { at[0], at[1], 0 };
    il_nearest_place place;
    il_nearest_visit(&p->tree, 0, box, cross, &r);
    nearest[0] = at[0], nearest[1] = at[1];
    if (r.n % 2 == 1 || !il_nearest_point(&p->tree, 0, at[0], at[1], &place))
        return;
    const il_segment *e = &p->edge[place.id];
    nearest[0] = e->ax + place.t * (e->bx - e->ax);
    nearest[1] = e->ay + place.t * (e->by - e->ay);
}

typedef struct scanned { il_scan *scan; int side; } scanned;

static bool add(void *context, const il_segment *e)
{
    scanned *s = context;
    il_scan_add(s->scan, s->side, e);
    return false;
}

void il_patch_scan(const il_patch *p, il_scan *s, int side)
{
    const double box[4] = { -INFINITY, s->box[1], s->box[2], s->box[3] };
    scanned to = { s, side };
    il_nearest_visit(&p->tree, 0, box, add, &to);
}

il_status il_patch_common(const il_patch *a, const il_patch *b, il_scan *s, double *area, il_error *err)
{
    double own;
    const double box[4] = { fmax(a->box[0], b->box[0]), fmax(a->box[1], b->box[1]),
                            fmin(a->box[2], b->box[2]), fmin(a->box[3], b->box[3]) };
    *area = 0;
    if (!(box[0] < box[2] && box[1] < box[3]))
        return IL_OK;
    il_scan_begin(s, box);
    il_patch_scan(a, s, 0);
    il_patch_scan(b, s, 1);
    return il_scan_measure(s, &own, area, err);
}
