/* mesh-settle.h - a sound mesh kept sound where a frame has turned and moved it.
 *
 * What is certified are positions in the stack's own coordinates.  A frame along
 * the axes takes them to the world's without rounding; any other rounds every
 * coordinate, and surfaces that lie nearer to each other than that may cross. */
#ifndef IL_OUTPUT_MESH_SETTLE_H
#define IL_OUTPUT_MESH_SETTLE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The frame FRAME (model/stack.h) permutes and mirrors coordinates, no more. */
bool il_frame_is_exact(const double frame[12]);

/* xyz[3*n_vertices]: sound and closed; to[3*n_vertices]: the same, placed, which
 * are rounded to 32-bit floats if FLOATS.  Where positions of TO that differ in
 * XYZ are equal, a triangle has no area, two triangles of tri[3*n_triangles]
 * meet in more than they share, or a component is turned inside out, their
 * vertices are put on other places of the grid of last digits beside theirs, at
 * random but always alike, until nothing of that kind is left.  Such a vertex
 * lies within STEPS digits of its place, a digit being the last one of the
 * largest coordinate.
 *
 * IL_E_SURFACE when that fails, *PLACE being one of the vertices then;
 * IL_E_INPUT when a coordinate is beyond what floats hold; IL_E_NOMEM.  Takes
 * about 150 bytes a vertex; O(n log n) as il_intersections. */
enum { IL_SETTLE_STEPS = 4 };
il_status il_mesh_settle(const double *xyz, double *to, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                         bool floats, size_t *place, il_error *err);

#endif
