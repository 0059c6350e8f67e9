/* frame.h - the edge of the map, and how lines meet it. */
#ifndef IL_TERRAIN_FRAME_H
#define IL_TERRAIN_FRAME_H

#include "model/stack.h"

/* The box of all lines (of a map that was in degrees: the box of longitudes and latitudes,
 * projected like the lines, but not half way around a pole or farther, where its sides would
 * meet); the convex hull of all lines; outlines of the user's. */
typedef enum il_frame_kind { IL_FRAME_BBOX, IL_FRAME_HULL, IL_FRAME_OUTLINE } il_frame_kind;

/* outline: closed rings with the map on their left, which cross nowhere; borrowed, for
 * IL_FRAME_OUTLINE only.  In degrees when in_degrees; or where the map was, when
 * may_be_degrees, and the outline lies there but beside the lines.  Else in the
 * coordinates that the map was read in, or in `unit` if has_unit. */
typedef struct il_frame_options {
    il_frame_kind kind;
    const il_slice *outline;
    bool in_degrees, may_be_degrees, has_unit;
    il_unit unit;
} il_frame_options;

/* The end of an open line: of line RING of level LEVEL, its last vertex if LAST.  FOOT: the
 * vertex (x, y) of the frame that a straight edge leads to; equal to the end where that
 * lies on the frame. */
typedef struct il_frame_end {
    uint32_t level, ring;
    bool last;
    double foot[2];
} il_frame_end;

/* rings: the frame, map on their left, all feet and all vertices of lines that lie on it
 * exactly among their vertices.  end[n_ends]: ends that reach it, by level, ring, then first
 * before last; the edges from them to their feet cross and touch no line and none of each
 * other, but that feet of one level may be one.  inside[n_inside]: likewise the ends that
 * lie inside the frame and do not reach it; they have no feet.  All other ends lie outside
 * of it.  No line goes out of a frame but of an outline.
 * box: least x and y, greatest x and y of the rings.  took_degrees: an outline that may be
 * in degrees was taken to be. */
typedef struct il_frame {
    il_slice rings;
    il_frame_end *end;      size_t n_ends, cap_ends;
    il_frame_end *inside;   size_t n_inside, cap_inside;
    double box[4];
    bool took_degrees;
} il_frame;

#define IL_FRAME_INIT { 0 }
void il_frame_free(il_frame *f); /* safe twice */

/* The frame of the lines level[n_levels] of a terrain with head HEAD.  An end within
 * IL_FRAME_REACH of the frame's shorter side from it is led there, for isolines of a
 * raster end half a cell before it: to the nearest place, or beside it where something is
 * in the way.  An end that lies on it but for rounding (1e-9 of the frame's size; in
 * degrees also what the chords of bent sides are off) bends it, so that end and foot are one.
 * O(n log n).  IL_E_INPUT for a frame without area, for an outline beside the map or in
 * degrees that nobody knows how to project; IL_E_NOMEM. */
#define IL_FRAME_REACH 0.02
il_status il_frame_make(il_frame *out, const il_frame_options *o, const il_stack_head *head,
                        const il_slice *level, size_t n_levels, il_error *err);

#endif
