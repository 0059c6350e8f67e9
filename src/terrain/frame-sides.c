#include "config.h"
#include "terrain/frame-sides.h"
#include "base/alloc.h"
#include "terrain/frame-curves.h"
#include "terrain/frame-hull.h"
#include "terrain/frame-outline.h"

#include <math.h>
#include <string.h>

/* Of the size of the map: places that are nearer were one before they were rounded. */
static const double rounding_share = 1e-9;

void il_frame_sides_free(il_frame_sides *s)
{
    il_free(s->side);
    il_nearest_free(&s->tree);
    *s = (il_frame_sides)IL_FRAME_SIDES_INIT;
}

bool il_frame_sides_add(il_frame_sides *s, const double *xy, size_t n)
{
    if (!il_grow(&s->side, &s->cap, s->n + n, sizeof *s->side))
        return false;
    for (size_t k = 0; k < n; k++) {
        il_frame_side *side = &s->side[s->n + k];
        memcpy(side->a, xy + 2 * k, sizeof side->a);
        memcpy(side->b, xy + 2 * ((k + 1) % n), sizeof side->b);
        side->before = (uint32_t)(s->n + (k + n - 1) % n);
        side->next = (uint32_t)(s->n + (k + 1) % n);
    }
    s->n += n;
    return true;
}

static void extend(double box[4], const double *xy, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double *p = xy + 2 * k;
        box[0] = p[0] < box[0] ? p[0] : box[0];
        box[1] = p[1] < box[1] ? p[1] : box[1];
        box[2] = p[0] > box[2] ? p[0] : box[2];
        box[3] = p[1] > box[3] ? p[1] : box[3];
    }
}

static void box_of_lines(double box[4], const il_slice *level, size_t n_levels)
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < n_levels; i++)
        for (size_t r = 0; r < level[i].n; r++)
            extend(box, level[i].ring[r].xy, level[i].ring[r].n);
}

static il_status add_box(il_frame_sides *s, const double b[4], il_error *err)
{
    const double xy[] = { b[0], b[1], b[2], b[1], b[2], b[3], b[0], b[3] };
    return il_frame_sides_add(s, xy, 4) ? IL_OK : il_fail_nomem(err);
}

static double largest(const double box[4])
{
    return fmax(fmax(fabs(box[0]), fabs(box[1])), fmax(fabs(box[2]), fabs(box[3])));
}

static double longer_side(const double box[4])
{
    return fmax(box[2] - box[0], box[3] - box[1]);
}

/* What the sides have in common: their box, and what counts as nothing. */
static void measure(il_frame_sides *s)
{
    s->box[0] = s->box[1] = INFINITY;
    s->box[2] = s->box[3] = -INFINITY;
    for (size_t k = 0; k < s->n; k++)
        extend(s->box, s->side[k].a, 1);
    s->rounding = fmax(rounding_share * longer_side(s->box), 4 * 0x1p-52 * largest(s->box));
    s->slack += s->rounding;
}

static il_status build_tree(il_frame_sides *s, il_error *err)
{
    il_segment *segment = il_alloc(s->n, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t k = 0; k < s->n; k++) {
        const il_frame_side *side = &s->side[k];
        segment[k] = (il_segment){ side->a[0], side->a[1], side->b[0], side->b[1], 0, k };
    }
    return il_nearest_build(&s->tree, segment, s->n, 1, err);
}

/* Twice the area that they enclose, from the middle of their box. */
static double area2(const il_frame_sides *s)
{
    double x = (s->box[0] + s->box[2]) / 2, y = (s->box[1] + s->box[3]) / 2, sum = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double *a = s->side[k].a, *b = s->side[k].b;
        sum += (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
    }
    return sum;
}

/* An outline beside the map is often one in degrees that does not say so. */
static il_status refuse_beside(const il_frame_sides *s, const il_frame_options *o, il_error *err)
{
    const double *b = s->box;
    bool could_be_degrees = o->may_be_degrees && !s->took_degrees && b[0] >= -360 && b[2] <= 360 && b[1] >= -90 && b[3] <= 90;
    return il_fail(err, IL_E_INPUT, 0, "the outline lies beside the map%s",
                   could_be_degrees ? "; if its numbers are degrees, ogr2ogr -t_srs brings it into the system of the map" : "");
}

static il_status check(const il_frame_sides *s, const il_frame_options *o, const double lines[4], il_error *err)
{
    /* what is nowhere wider than rounding is a line */
    bool encloses = s->n > 2 && area2(s) > 2 * s->rounding * longer_side(s->box);
    if (o->kind != IL_FRAME_OUTLINE)
        return encloses ? IL_OK : il_fail(err, IL_E_INPUT, 0, "the lines of the map enclose nothing: they lie on one straight line");
    if (!encloses)
        return il_fail(err, IL_E_INPUT, 0, "the outline encloses nothing");
    if (lines[0] > s->box[2] || lines[2] < s->box[0] || lines[1] > s->box[3] || lines[3] < s->box[1])
        return refuse_beside(s, o, err);
    return IL_OK;
}

static il_status add_sides(il_frame_sides *s, const il_frame_options *o, const il_stack_head *head,
                           const il_slice *level, size_t n_levels, const double box[4], il_error *err)
{
    if (o->kind == IL_FRAME_OUTLINE)
        return il_frame_outline_add(s, o, head, box, err);
    if (o->kind == IL_FRAME_HULL)
        return il_frame_hull_add(s, level, n_levels, err);
    return il_frame_is_curved(head) ? il_frame_curves_make(s, head, err) : add_box(s, box, err);
}

il_status il_frame_sides_make(il_frame_sides *s, const il_frame_options *o, const il_stack_head *head,
                              const il_slice *level, size_t n_levels, il_error *err)
{
    double box[4];
    *s = (il_frame_sides)IL_FRAME_SIDES_INIT;
    box_of_lines(box, level, n_levels);
    il_status st = box[0] <= box[2] ? add_sides(s, o, head, level, n_levels, box, err)
                                    : il_fail(err, IL_E_INPUT, 0, "the map has no lines");
    if (st == IL_OK) {
        measure(s);
        st = check(s, o, box, err);
    }
    if (st == IL_OK)
        st = build_tree(s, err);
    if (st != IL_OK)
        il_frame_sides_free(s);
    return st;
}
