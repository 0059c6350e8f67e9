/* map-project.h - degrees to metres in a plane.
 *
 * auto: the UTM zone of the map's middle where the map lies in it, within half a degree;
 * UPS beyond 84 north and 80 south and for maps around a pole; else transverse Mercator on
 * the middle of the map, to 60 degrees on either side.  UTM zones hold for the
 * ellipsoid of the data, whatever that is. */
#ifndef IL_INPUT_MAP_PROJECT_H
#define IL_INPUT_MAP_PROJECT_H

#include "input/map-data.h"

/* Choose the projection for M, which is in degrees, by its box and --project, which is
 * not NONE.  Its name as a CRS goes to NAME[SIZE].  IL_E_INPUT when the map is too wide. */
il_status il_map_choose_projection(const il_map *m, il_projection *p, char *name, size_t size, il_error *err);

/* Put vertices into long edges, which are straight between longitudes and latitudes
 * but not in the plane, so that none strays farther than --flatness (or a millionth of
 * the map, 1 cm at least); project all; m->crs and m->unit say what they are then.
 * Where degrees stay, nothing is done.  Reported.  IL_E_INPUT, IL_E_NOMEM. */
il_status il_map_project(il_map *m, il_error *err);

/* The N points at XY by P, as il_project_points, shared by THREADS threads. */
il_status il_map_project_points(const il_projection *p, double *xy, size_t n, int threads, il_error *err);

#endif
