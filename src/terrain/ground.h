/* ground.h - from the lines of a map to a mesh that is proved.
 *
 *     frame > chart > tin > bands > missing lines > law > detail > skin > proof */
#ifndef IL_TERRAIN_GROUND_H
#define IL_TERRAIN_GROUND_H

#include "terrain/law.h"
#include "terrain/relief.h"
#include "terrain/skin.h"

/* What is made on the way.  Borrowed: options, head, whose placement is chosen, slice[n_slices]
 * (the levels) and report (may be null).  unit: of the map, where head's may be the mesh's.
 * spot_node[i]: of the head's spot i in the chart, IL_CHART_NONE once it is left out.  floor:
 * of the solid in the mesh, NAN for an open surface.  blank[2*n_blanks]: places in parts of the
 * frame that were left out (terrain/blank.h). */
typedef struct il_ground {
    const il_relief_options *options;
    il_stack_head *head;
    const il_slice *slice;
    size_t n_slices;
    il_report *report;
    il_unit unit;
    il_chart_line *line;     size_t n_lines;
    double *level_z;
    unsigned char *spot_out;
    uint32_t *spot_node;
    il_frame frame;
    il_chart chart;
    il_tin tin;
    il_border *border;       size_t n_borders;
    il_bands bands;
    double *blank;           size_t n_blanks;
    il_law law;
    il_skin skin;
    double floor;
} il_ground;

/* Fill *G, which knows what it borrows and is zero otherwise, up to a proved skin; to be freed
 * after failure too.  Errors as il_relief_new tells. */
il_status il_ground_make(il_ground *g, il_error *err);
void il_ground_free(il_ground *g); /* safe twice */

#endif
