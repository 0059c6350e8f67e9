/* measure.h - the lines of a map measured on the ellipsoid, as a stage.
 *
 * A projection stretches lengths and areas, so they are measured where the points came
 * from: in degrees.  Vertices that were put into edges for the projection's sake are
 * left out, and so an edge is the geodesic between the vertices of the input. */
#ifndef IL_REGION_MEASURE_H
#define IL_REGION_MEASURE_H

#include "model/sink.h"

/* A sink that sets length and area of each slice of terrain that is in degrees or was
 * (il_stack_head, geographic), and passes all on to NEXT (borrowed) as it is. */
il_status il_measure_new(il_sink **out, il_sink *next, il_error *err);
void il_measure_free(il_sink *s); /* null is fine */

#endif
