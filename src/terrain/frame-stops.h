/* frame-stops.h - what lies on the sides of a frame, and the ends that might be led there. */
#ifndef IL_TERRAIN_FRAME_STOPS_H
#define IL_TERRAIN_FRAME_STOPS_H

#include "terrain/frame-sides.h"

/* VERTEX: of a line of `level`, which stays where it is.  FOOT: of an end of that level.
 * BULGE: only keeps the chord of a curve outside of a vertex near it. */
typedef enum il_stop_kind { IL_STOP_VERTEX, IL_STOP_FOOT, IL_STOP_BULGE } il_stop_kind;

/* A place on the frame, at t from 0 to below 1 along a side: what lies at its end lies at
 * the beginning of the next.  is_backward: the side leads to lesser x, or y if it is upright. */
typedef struct il_stop {
    double at[2], t;
    uint32_t side, level;
    unsigned char kind;         /* il_stop_kind */
    bool is_backward;
} il_stop;

/* An end of an open line that lies near the frame but not on it: from[2], how far away,
 * and the place on the frame that it would be led to. */
typedef struct il_loose_end {
    il_frame_end end;
    il_stop foot;
    double from[2], distance;
} il_loose_end;

typedef struct il_stops {
    il_stop *stop;          size_t n, cap;
    il_loose_end *loose;    size_t n_loose, cap_loose;
} il_stops;

#define IL_STOPS_INIT { 0 }
void il_stops_free(il_stops *o); /* safe twice */
bool il_stops_add(il_stops *o, const il_stop *stop);

/* The place P, which lies at T of side K or beside it. */
il_stop il_stop_at(const il_frame_sides *s, size_t k, double t, const double p[2], uint32_t level, il_stop_kind kind);

/* Along the frame, for qsort. */
int il_stop_compare(const void *a, const void *b);

/* Append E to the ends of F. */
bool il_frame_add_end(il_frame *f, const il_frame_end *e);
bool il_frame_add_inside(il_frame *f, const il_frame_end *e);

/* Find the vertices of level[n_levels] that lie on the sides S, and the ends on the map's
 * side of them that are no farther away than REACH.  Ends that lie on the sides, and those
 * that are farther away inside, go to OUT's.
 * O(n log n) for n vertices and sides.  IL_E_NOMEM. */
il_status il_stops_find(il_stops *o, il_frame *out, const il_frame_sides *s, double reach,
                        const il_slice *level, size_t n_levels, il_error *err);

#endif
