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
    p->low = INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        const il_segment *e = &p->edge[i];
        double ax = e->ax - o->ax, ay = e->ay - o->ay, bx = e->bx - o->ax, by = e->by - o->ay, w = ax * by - bx * ay;
        sum += w;
        x += w * (ax + bx);
        y += w * (ay + by);
        p->low = fmin(p->low, e->ay);
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

/* ---- what two have in common ---------------------------------------------------- */

static double height_at(const il_segment *e, double x)
{
    if (x == e->ax || x == e->bx)
        return x == e->ax ? e->ay : e->by;
    return e->ay + (x - e->ax) / (e->bx - e->ax) * (e->by - e->ay);
}

/* The area below both edges and above LOW; > 0 when they run the same way. */
static double below_both(const il_segment *e, const il_segment *f, double low)
{
    double from = fmax(fmin(e->ax, e->bx), fmin(f->ax, f->bx)), to = fmin(fmax(e->ax, e->bx), fmax(f->ax, f->bx));
    if (!(from < to))
        return 0;
    double e0 = height_at(e, from) - low, e1 = height_at(e, to) - low;
    double f0 = height_at(f, from) - low, f1 = height_at(f, to) - low, d0 = f0 - e0, d1 = f1 - e1, heights;
    if ((d0 < 0 && d1 > 0) || (d0 > 0 && d1 < 0)) { /* they cross at T of the way */
        double t = d0 / (d0 - d1), middle = e0 + t * (e1 - e0);
        heights = t * (fmin(e0, f0) + middle) + (1 - t) * (middle + fmin(e1, f1));
    } else {
        heights = fmin(e0, f0) + fmin(e1, f1);
    }
    return ((e->ax < e->bx) == (f->ax < f->bx) ? 0.5 : -0.5) * (to - from) * heights;
}

typedef struct common { const il_segment *edge; double low, sum; } common;

static bool add_common(void *context, const il_segment *f)
{
    common *c = context;
    c->sum += below_both(c->edge, f, c->low);
    return false;
}

double il_patch_common(const il_patch *a, const il_patch *b)
{
    const il_patch *few = a->n < b->n ? a : b, *many = a->n < b->n ? b : a;
    common c = { NULL, fmin(a->low, b->low), 0 };
    for (size_t i = 0; i < few->n; i++) {
        const il_segment *e = c.edge = &few->edge[i];
        const double box[4] = { fmin(e->ax, e->bx), -INFINITY, fmax(e->ax, e->bx), INFINITY };
        il_nearest_visit(&many->tree, 0, box, add_common, &c);
    }
    return c.sum;
}
