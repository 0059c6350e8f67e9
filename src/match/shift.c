#include "config.h"
#include "match/shift.h"

#include <math.h>

/* Measured on sliced solids, with the rule of linkage.h. */
static const double LIES_ON = 0.3, ALIKE = 2.5;

il_status il_link_shift(const il_patch *lower, const il_patch *upper, il_scan *scan, double shift[2], il_error *err)
{
    double from[2] = { lower->centre[0], lower->centre[1] }, to[2] = { upper->centre[0], upper->centre[1] }, common;
    il_status st = il_patch_common(lower, upper, scan, &common, err);
    shift[0] = shift[1] = 0;
    if (st != IL_OK || common > LIES_ON * fmin(lower->area, upper->area))
        return st;
    if (lower->area > ALIKE * upper->area)
        il_patch_nearest(lower, to, from);
    else if (upper->area > ALIKE * lower->area)
        il_patch_nearest(upper, from, to);
    shift[0] = to[0] - from[0];
    shift[1] = to[1] - from[1];
    return IL_OK;
}
