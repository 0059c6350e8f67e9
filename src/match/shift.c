#include "config.h"
#include "match/shift.h"

#include <math.h>

/* Measured on sliced solids, with the rule of linkage.h. */
static const double LIES_ON = 0.3, ALIKE = 2.5;

void il_link_shift(const il_patch *lower, const il_patch *upper, double shift[2])
{
    double from[2] = { lower->centre[0], lower->centre[1] }, to[2] = { upper->centre[0], upper->centre[1] };
    shift[0] = shift[1] = 0;
    if (il_patch_common(lower, upper) > LIES_ON * fmin(lower->area, upper->area))
        return;
    if (lower->area > ALIKE * upper->area)
        il_patch_nearest(lower, to, from);
    else if (upper->area > ALIKE * lower->area)
        il_patch_nearest(upper, from, to);
    shift[0] = to[0] - from[0];
    shift[1] = to[1] - from[1];
}
