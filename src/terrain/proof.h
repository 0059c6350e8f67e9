/* proof.h - what a terrain's mesh must show before it leaves (design 7).
 *
 * Every half-edge is matched by its reverse or lies over the frame, once; all triangles of
 * the surface turn counter-clockwise in plan, exactly.  So the surface covers what the frame
 * encloses once: the number of triangles over a point changes at the frame only, where it
 * goes from none to one.  A surface without an overlap in plan does not meet itself.  The floor
 * of a solid is such a surface seen from below; walls stand on the frame between the two, and
 * their tops lie above the floor. */
#ifndef IL_TERRAIN_PROOF_H
#define IL_TERRAIN_PROOF_H

#include "terrain/skin.h"

/* Prove S over T and C; FLOOR: of a solid, NAN for an open surface.  Each line's vertex inside
 * the frame must be one of S, at its level's height by HEAD's placement.  IL_E_SURFACE names
 * what fails and near which place; IL_E_NOMEM.  O(n). */
il_status il_skin_prove(const il_skin *s, const il_tin *t, const il_chart *c, const il_stack_head *head,
                        const il_placement_options *o, double floor, il_error *err);

#endif
