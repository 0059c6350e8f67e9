/* frame-sides.h - the sides of a frame, before anything is known of what lies on them. */
#ifndef IL_TERRAIN_FRAME_SIDES_H
#define IL_TERRAIN_FRAME_SIDES_H

#include "base/nearest.h"
#include "terrain/frame.h"

/* From a to b, the map on its left.  before, next: its neighbours in the ring. */
typedef struct il_frame_side {
    double a[2], b[2];
    uint32_t before, next;
} il_frame_side;

/* The box of a map that was in degrees: its sides are curves, here in chords.  corner[k]:
 * longitude and latitude where curve k begins, from the south-west on counter-clockwise;
 * its sides are first[k] .. first[k + 1], at equal steps.  scale: what metres were
 * multiplied by.  rounding: of degrees. */
typedef struct il_frame_curves {
    il_projection projection;
    double scale, rounding;
    double corner[5][2];
    uint32_t first[5];
} il_frame_curves;

/* side[n], ring by ring.  tree: of them, one class, by their numbers.  box: of them (least
 * x and y, greatest x and y).  rounding: places no farther apart are one.  slack: how far
 * from its sides lies what lies on the frame: more, where the sides are chords.
 * took_degrees: as in il_frame. */
typedef struct il_frame_sides {
    il_frame_side *side;    size_t n, cap;
    il_nearest tree;
    double box[4], rounding, slack;
    bool is_curved, took_degrees;
    il_frame_curves curves;
} il_frame_sides;

#define IL_FRAME_SIDES_INIT { 0 }
void il_frame_sides_free(il_frame_sides *s); /* safe twice */

/* The sides that O asks for around the lines level[n_levels].  IL_E_INPUT when they
 * enclose nothing, IL_E_NOMEM. */
il_status il_frame_sides_make(il_frame_sides *s, const il_frame_options *o, const il_stack_head *head,
                              const il_slice *level, size_t n_levels, il_error *err);

/* For the files that know one kind each: a ring of N places xy[2*n] as sides. */
bool il_frame_sides_add(il_frame_sides *s, const double *xy, size_t n);

#endif
