/* fate.h - whether a solid's surface goes on from a contour to the next plane, or ends before it. */
#ifndef IL_TESTS_FATE_H
#define IL_TESTS_FATE_H

#include "solid.h"

/* level[v]: leader of the vertices that hang together with v at one height; next[up][leader]:
 * where the steepest edge leads from there, UINT32_MAX at a peak (up) or a pit.  Owned. */
typedef struct fates {
    const solid *s;
    uint32_t *level, *next[2];
} fates;

/* Of S, which has been cut; borrowed. */
void fates_find(fates *f, const solid *s);
void fates_free(fates *f);

/* From point XY of plane PLANE on triangle T: does the steepest way UP, or down, over the mesh's
 * edges come to the next plane?  Else it comes to a peak or a pit before. */
bool fates_goes_on(const fates *f, size_t t, const double xy[2], uint32_t plane, bool up);

#endif
