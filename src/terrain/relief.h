/* relief.h - the surface of a map of isolines, as a stage.
 *
 *     frame > chart > tin > bands > missing lines > law > detail > skin > proof
 *
 * The map is triangulated in its own plane: lines and frame are edges of it, and heights
 * are carried by its nodes (design 7).  A whole map is held: what band a face lies in may
 * hang on a line at the far end. */
#ifndef IL_TERRAIN_RELIEF_H
#define IL_TERRAIN_RELIEF_H

#include "model/mesh.h"
#include "model/report.h"
#include "model/sink.h"
#include "terrain/frame.h"
#include "terrain/law.h"
#include "terrain/placement.h"

/* high: of maps with one level, the side of the lines where the ground is higher.
 * has_detail, detail: the tolerance of terrain/detail.h, in intervals, from 0 on; else the usual. */
typedef struct il_relief_options {
    il_frame_options frame;
    il_placement_options placement;
    il_law_options law;
    bool has_detail;
    double detail;
    il_side high;
} il_relief_options;

/* A sink that gives NEXT (borrowed) the certified surface of each stack of terrain, open at
 * the frame or, if O says so, a solid; and all other stacks to SOLIDS (borrowed; null: they
 * are IL_E_INPUT).  What was left out or put in is counted in REPORT.  IL_E_SURFACE when the
 * certificate fails, IL_E_INPUT, IL_E_NOMEM. */
il_status il_relief_new(il_sink **out, const il_relief_options *o, il_mesh_sink *next, il_sink *solids,
                         il_report *report, il_error *err);
/* The number of the stack at hand, of all that came, from 0. */
const int32_t *il_relief_stack(const il_sink *s);
void il_relief_free(il_sink *s); /* null is fine */

#endif
