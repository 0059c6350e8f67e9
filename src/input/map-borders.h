/* map-borders.h - polygons as the lines between them.
 *
 * The borders of bands (gdal_contour -p: ground from 10 to 20, from 20 to 30) are
 * isolines where two bands meet, and the edge of the map elsewhere.  Polygons of one
 * height each ("all above 10") may be cut by sheets: where two of one height meet is no
 * isoline. */
#ifndef IL_INPUT_MAP_BORDERS_H
#define IL_INPUT_MAP_BORDERS_H

#include "input/map-data.h"

/* Replace the outlines of polygons by their runs of edges that are isolines.  Edges
 * meet when both their ends are the same, bit for bit.  IL_E_INPUT when polygons of one
 * height each share their borders as bands do, so that one of the heights is missing;
 * IL_E_NOMEM. */
il_status il_map_find_borders(il_map *m, il_error *err);

#endif
