/* map-degrees.h - are the coordinates of a map longitudes and latitudes?
 *
 * What the file says is believed where it can be true: a label EPSG:4326 on metres is
 * a common fault of exports.  Where no file says anything, numbers that can be degrees
 * are taken for such if the heights fit them only then: a map in metres whose relief is
 * above three times its width would be a tower, and on one in degrees whose relief is
 * below that the land would fall by less than 1 in 37 000. */
#ifndef IL_INPUT_MAP_DEGREES_H
#define IL_INPUT_MAP_DEGREES_H

#include "input/map-data.h"

/* Settle m->degrees and m->box, and where they are degrees put all longitudes into
 * one run without a jump, which may go beyond 180.  What is not as the file says is
 * reported.  IL_E_INPUT when the options ask for what cannot be. */
il_status il_map_find_degrees(il_map *m, il_error *err);

/* Are x and y, whose box is known, within those of the globe? */
bool il_map_can_be_degrees(const il_map *m);

#endif
