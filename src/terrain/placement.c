#include "config.h"
#include "terrain/placement.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>

/* Of the map's longer side: how far the floor of a solid lies below its lowest point. */
static const double FLOOR_DEPTH = 0.02;

/* Whole numbers above this are not all doubles. */
static const double WHOLE = 0x1p53;

double il_placement_round(const il_placement_options *o, double value)
{
    return o->round_float ? il_number_round_float(value) : value;
}

static double longer_side(const double box[4])
{
    return fmax(box[2] - box[0], box[3] - box[1]);
}

/* ---- numbers that can be typed ------------------------------------------------ */

/* 10^N by multiplication, which is exact up to 10^22, where pow need not be. */
static double power_of_ten(int n)
{
    double p = 1;
    for (; n > 0; n--)
        p *= 10;
    return p;
}

double il_placement_shorten(double value, double size, double (*way)(double))
{
    int exponent = (int)floor(log10(size));
    double power = power_of_ten(abs(exponent)), n = way(exponent < 0 ? value * power : value / power);
    if (!(fabs(n) < WHOLE))
        return value;
    return (exponent < 0 ? n / power : n * power) + 0.0; /* not -0 */
}

/* ---- x and y ------------------------------------------------------------------- */

/* A map as wide in metres as it is to be in mm keeps its numbers, but not their meaning. */
static bool is_identity(const il_stack_head *head)
{
    const il_placement *p = &head->placement;
    bool same = head->unit == p->unit;
    for (int k = 0; k < 3; k++)
        same = same && p->offset[k] == 0 && p->scale[k] == 1;
    return same;
}

static il_status check_extent(const il_stack_head *head, const il_placement_options *o, const double box[4], il_error *err)
{
    double least[2], most[2];
    il_placement_apply(head, o, box, least);
    il_placement_apply(head, o, box + 2, most);
    for (int k = 0; k < 2; k++) {
        if (!(fabs(least[k]) < IL_COORDINATE_BOUND) || !(fabs(most[k]) < IL_COORDINATE_BOUND))
            return il_fail(err, IL_E_INPUT, head->line, "the map reaches 1e15 when put to its size");
        if (!(least[k] < most[k]))
            return il_fail(err, IL_E_INPUT, head->line, "the map has no extent left in %c%s", 'x' + k,
                           o->round_float ? " in 32-bit floats: put it near the origin (--recentre)" : " when put to its size");
    }
    return IL_OK;
}

il_status il_placement_choose(il_stack_head *head, const il_placement_options *o, const double box[4], il_error *err)
{
    il_placement p = { { 0, 0, 0 }, { 1, 1, 1 }, head->unit };
    double side = longer_side(box);
    if (o->fit > 0) {
        if (!(il_unit_metres(head->unit) > 0))
            return il_fail(err, IL_E_INPUT, head->line,
                           "a map in degrees has no length that --fit could make another: --project makes metres of it");
        p.scale[0] = p.scale[1] = side / o->fit;
        head->unit = IL_UNIT_MM;
    }
    p.scale[2] = p.scale[0] / o->z_scale;
    for (int k = 0; k < 2 && o->recentre; k++)
        p.offset[k] = il_placement_shorten(box[k] / 2 + box[2 + k] / 2, side / 1000, round);
    head->placement = p;
    head->has_placement = !is_identity(head);
    if (head->has_frame && (o->recentre || head->has_placement))
        return il_fail(err, IL_E_INPUT, head->line, "a map with a frame of its own stays where that puts it: --no-recentre, "
                       "and neither --fit nor --z-scale");
    return check_extent(head, o, box, err);
}

void il_placement_apply(const il_stack_head *head, const il_placement_options *o, const double from[2], double to[2])
{
    const il_placement *p = &head->placement;
    for (int k = 0; k < 2; k++)
        to[k] = il_placement_round(o, head->has_placement ? (from[k] - p->offset[k]) / p->scale[k] : from[k]);
}

/* ---- z -------------------------------------------------------------------------- */

/* How far below the lowest point the floor goes, on the map. */
static double floor_depth(const il_stack_head *head, const il_placement_options *o, const double box[4],
                          double lowest, double highest)
{
    if (il_unit_metres(head->unit) > 0)
        return FLOOR_DEPTH * longer_side(box) / o->z_scale;
    return highest > lowest ? (highest - lowest) / 10 : 1;
}

static il_status choose_floor(const il_stack_head *head, const il_placement_options *o, const double box[4],
                              double lowest, double highest, double *bottom, il_error *err)
{
    double depth = floor_depth(head, o, box, lowest, highest);
    *bottom = o->has_base ? o->base : il_placement_shorten(lowest - depth, depth / 10, floor);
    char floor_text[IL_NUMBER_MAX], lowest_text[IL_NUMBER_MAX];
    il_number_format(floor_text, *bottom);
    il_number_format(lowest_text, lowest);
    if (!(*bottom < lowest))
        return il_fail(err, IL_E_INPUT, head->line, "a solid's floor at height %s is not below the lowest point of the surface, %s",
                       floor_text, lowest_text);
    return IL_OK;
}

/* Is the floor below the surface in the mesh too, after its rounding? */
static il_status check_heights(const il_stack_head *head, const il_placement_options *o, double bottom, double lowest,
                               double highest, il_error *err)
{
    const double z[3] = { bottom, lowest, highest };
    for (int k = 0; k < 3; k++)
        if (!(fabs(il_placement_height(head, o, z[k])) < IL_COORDINATE_BOUND))
            return il_fail(err, IL_E_INPUT, head->line, "the heights reach 1e15 when put to their size");
    if (o->solid && !(il_placement_height(head, o, bottom) < il_placement_height(head, o, lowest)))
        return il_fail(err, IL_E_INPUT, head->line, "the floor of the solid and its lowest point become one height: "
                       "a lower --base parts them");
    return IL_OK;
}

il_status il_placement_settle(il_stack_head *head, const il_placement_options *o, const double box[4],
                              double lowest, double highest, double *bottom, il_error *err)
{
    *bottom = lowest;
    il_status st = o->solid ? choose_floor(head, o, box, lowest, highest, bottom, err) : IL_OK;
    if (st != IL_OK)
        return st;
    if (o->solid && o->recentre)
        head->placement.offset[2] = *bottom;
    head->has_placement = !is_identity(head);
    return check_heights(head, o, *bottom, lowest, highest, err);
}

double il_placement_height(const il_stack_head *head, const il_placement_options *o, double z)
{
    const il_placement *p = &head->placement;
    return il_placement_round(o, head->has_placement ? (z - p->offset[2]) / p->scale[0] * o->z_scale : z);
}
