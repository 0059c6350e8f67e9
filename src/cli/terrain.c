#include "config.h"
#include "cli/terrain.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* Intervals that differ by no more than this share are one: heights have few decimals,
 * and may have been converted from feet. */
static const double EVEN = 0.01;

/* Ends within this share of the map's width across an edge are on that edge: isolines end
 * half a cell of the raster before it, and where degrees were projected, edges are not
 * quite straight. */
static const double EDGE = 0.02;

il_status il_terrain_begin(il_terrain *t, const il_stack_head *head, il_error *err)
{
    *t = (il_terrain){ .hull = IL_HULL_INIT, .has_geographic = head->has_geographic, .has_measures = head->unit != IL_UNIT_DEG,
                       .n_spots = head->n_spots };
    memcpy(t->geographic, head->geographic, sizeof t->geographic);
    if (head->crs)
        t->crs = il_strndup(head->crs, strlen(head->crs));
    return t->crs || !head->crs ? IL_OK : il_fail_nomem(err);
}

void il_terrain_free(il_terrain *t)
{
    il_free(t->crs);
    il_free(t->level);
    il_free(t->end);
    il_hull_free(&t->hull);
    *t = (il_terrain){ 0 };
}

static bool add_ends(il_terrain *t, const il_ring *r)
{
    if (!il_grow(&t->end, &t->cap_ends, t->n_ends + 2, 2 * sizeof *t->end))
        return false;
    memcpy(t->end + 2 * t->n_ends, r->xy, 2 * sizeof *t->end);
    memcpy(t->end + 2 * t->n_ends + 2, r->xy + 2 * (r->n - 1), 2 * sizeof *t->end);
    t->n_ends += 2;
    return true;
}

il_status il_terrain_slice(il_terrain *t, const il_slice *s, il_error *err)
{
    il_terrain_level l = { .z = s->z };
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        l.points += r->n;
        l.length += il_ring_length(r);
        l.open += r->open;
        l.closed += !r->open;
        l.area += r->open ? 0 : fabs(il_ring_area2(r)) / 2;
        if ((r->open && r->n > 0 && !add_ends(t, r)) || !il_hull_add(&t->hull, r->xy, r->n))
            return il_fail_nomem(err);
    }
    if (s->length > 0) {
        t->on_ellipsoid = t->has_measures = true;
        l.length = s->length;
        l.area = s->area;
    }
    if (!il_grow(&t->level, &t->cap, t->n + 1, sizeof *t->level))
        return il_fail_nomem(err);
    t->level[t->n++] = l;
    return IL_OK;
}

/* How many intervals DISTANCE is, 0 when it is not a whole number of them. */
static double count_intervals(double distance, double interval)
{
    double n = round(distance / interval);
    return fabs(distance - n * interval) <= EVEN * interval ? n : 0;
}

/* The usual distance is the interval when all are multiples of it. */
static void find_interval(il_terrain *t, const il_spacing *spacing)
{
    double missing = 0;
    if (!(spacing->usual > 0))
        return;
    for (size_t k = 1; k < t->n; k++) {
        double n = count_intervals(t->level[k].z - t->level[k - 1].z, spacing->usual);
        if (n == 0)
            return;
        missing += n - 1;
    }
    t->interval = spacing->usual;
    t->n_missing = missing < 1e15 ? (size_t)missing : 0;
}

il_status il_terrain_settle(il_terrain *t, const il_spacing *spacing, il_error *err)
{
    find_interval(t, spacing);
    if (!il_hull_settle(&t->hull))
        return il_fail_nomem(err);
    for (size_t k = 0; k < t->n_ends; k++)
        t->n_inside += il_hull_is_inside(&t->hull, t->end + 2 * k, EDGE);
    return IL_OK;
}

il_terrain_level il_terrain_sum(const il_terrain *t)
{
    il_terrain_level sum = { 0 };
    for (size_t k = 0; k < t->n; k++) {
        sum.open += t->level[k].open;
        sum.closed += t->level[k].closed;
        sum.points += t->level[k].points;
        sum.length += t->level[k].length;
        sum.area += t->level[k].area;
    }
    return sum;
}

il_unit il_terrain_unit_of_z(il_unit unit)
{
    return unit == IL_UNIT_DEG ? IL_UNIT_M : unit;
}
