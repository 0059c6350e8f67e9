#include "config.h"
#include "terrain/frame-outline.h"
#include "base/alloc.h"
#include "terrain/frame-curves.h"

#include <math.h>

/* Of the outline's size, how far its chords may be off. */
static const double chord_share = 1e-6;

/* tolerance: of the plane. */
typedef struct drawing {
    il_frame_sides *sides;
    const il_stack_head *head;
    double tolerance;
    double *xy;             size_t n, cap;
} drawing;

/* The longitudes of R in one run, and that in the turn of MIDDLE. */
static void unroll(il_ring *r, double middle)
{
    double least = r->xy[0], most = r->xy[0];
    for (size_t k = 1; k < r->n; k++) {
        double step = remainder(r->xy[2 * k] - r->xy[2 * k - 2], 360);
        r->xy[2 * k] = fabs(r->xy[2 * k] - r->xy[2 * k - 2]) > 180 ? r->xy[2 * k - 2] + step : r->xy[2 * k];
        least = fmin(least, r->xy[2 * k]);
        most = fmax(most, r->xy[2 * k]);
    }
    double turn = 360 * nearbyint((middle - (least + most) / 2) / 360);
    for (size_t k = 0; k < r->n; k++)
        r->xy[2 * k] += turn;
}

static il_status add_pieces(drawing *d, const double *from, const double *to, il_error *err)
{
    double scale = il_frame_scale(d->head), stray;
    size_t n;
    il_status st = il_frame_count_pieces(&d->head->projection, scale, from, to, d->tolerance, &n, &stray, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(&d->xy, &d->cap, d->n + n, 2 * sizeof *d->xy))
        return il_fail_nomem(err);
    for (size_t k = 0; k < n; k++) {
        double u = (double)k / (double)n;
        for (int c = 0; c < 2; c++)
            d->xy[2 * (d->n + k) + (size_t)c] = from[c] + u * (to[c] - from[c]);
    }
    d->n += n;
    d->sides->slack = fmax(d->sides->slack, 1.1 * stray);
    return IL_OK;
}

static il_status add_projected(drawing *d, const il_ring *r, il_error *err)
{
    il_status st = IL_OK;
    d->n = 0;
    for (size_t k = 0; k < r->n && st == IL_OK; k++)
        st = add_pieces(d, r->xy + 2 * k, r->xy + 2 * ((k + 1) % r->n), err);
    if (st == IL_OK)
        st = il_frame_project(&d->head->projection, il_frame_scale(d->head), d->xy, d->n, err);
    if (st == IL_OK && !il_frame_sides_add(d->sides, d->xy, d->n))
        st = il_fail_nomem(err);
    return st;
}

static void find_box(const il_slice *outline, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < outline->n; i++)
        for (size_t k = 0; k < 2 * outline->ring[i].n; k++) {
            box[k % 2] = fmin(box[k % 2], outline->ring[i].xy[k]);
            box[2 + k % 2] = fmax(box[2 + k % 2], outline->ring[i].xy[k]);
        }
}

/* The outline's size in the plane, by its box in degrees at the middle of the map. */
static double size_of(const il_slice *outline, const il_stack_head *head)
{
    static const double metres_a_degree = 111195;
    double box[4], lat = (head->geographic[1] + head->geographic[3]) / 2 * 3.14159265358979323846 / 180;
    find_box(outline, box);
    return metres_a_degree * il_frame_scale(head) * fmax((box[2] - box[0]) * cos(lat), box[3] - box[1]);
}

static il_status add_degrees(il_frame_sides *s, const il_slice *outline, const il_stack_head *head, il_error *err)
{
    bool is_projected = head->has_geographic;
    drawing d = { .sides = s, .head = head };
    il_slice copy;
    il_status st = il_slice_copy(&copy, outline, err);
    for (size_t i = 0; i < copy.n && st == IL_OK; i++)
        if (copy.ring[i].n > 0)
            unroll(&copy.ring[i], is_projected ? (head->geographic[0] + head->geographic[2]) / 2 : 0);
    if (is_projected)
        d.tolerance = chord_share * size_of(&copy, head);
    for (size_t i = 0; i < copy.n && st == IL_OK; i++) {
        const il_ring *r = &copy.ring[i];
        if (r->n < 3)
            continue;
        if (is_projected)
            st = add_projected(&d, r, err);
        else
            st = il_frame_sides_add(s, r->xy, r->n) ? IL_OK : il_fail_nomem(err);
    }
    il_free(d.xy);
    il_slice_free(&copy);
    return st;
}

/* ---- what its numbers are --------------------------------------------------- */

static bool boxes_meet(const double *a, const double *b)
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* What the outline's numbers are multiplied by: those of the map were since they were read. */
static double factor_of(const il_frame_options *o, const il_stack_head *head)
{
    double from = o->has_unit ? il_unit_metres(o->unit) : 0, to = il_unit_metres(head->unit);
    if (from > 0 && to > 0)
        return from == to ? 1 : from / to;
    return !o->has_unit && head->length_scale > 0 ? head->length_scale : 1;
}

/* Where nobody said what they are. */
static bool are_degrees(const il_frame_options *o, const il_stack_head *head, const double lines[4], double factor)
{
    double box[4], scaled[4];
    find_box(o->outline, box);
    for (int k = 0; k < 4; k++)
        scaled[k] = box[k] * factor;
    return head->has_geographic && !boxes_meet(scaled, lines) && boxes_meet(box, head->geographic);
}

static il_status add_scaled(il_frame_sides *s, const il_slice *outline, double factor, il_error *err)
{
    il_slice copy;
    il_status st = il_slice_copy(&copy, outline, err);
    for (size_t i = 0; i < copy.n && st == IL_OK; i++) {
        for (size_t k = 0; k < 2 * copy.ring[i].n; k++)
            copy.ring[i].xy[k] *= factor;
        if (copy.ring[i].n > 2 && !il_frame_sides_add(s, copy.ring[i].xy, copy.ring[i].n))
            st = il_fail_nomem(err);
    }
    il_slice_free(&copy);
    return st;
}

il_status il_frame_outline_add(il_frame_sides *s, const il_frame_options *o, const il_stack_head *head,
                               const double lines[4], il_error *err)
{
    double factor = factor_of(o, head);
    if (o->in_degrees && head->unit != IL_UNIT_DEG && !head->has_geographic)
        return il_fail(err, IL_E_INPUT, 0, "the outline is in degrees and the map in %s, of which nobody knows how they were projected",
                       il_unit_name(head->unit));
    s->took_degrees = !o->in_degrees && o->may_be_degrees && are_degrees(o, head, lines, factor);
    if (o->in_degrees || s->took_degrees)
        return add_degrees(s, o->outline, head, err);
    return add_scaled(s, o->outline, factor, err);
}
