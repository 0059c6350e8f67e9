/* kml-description.h - heights that stand in the description of a placemark.
 *
 * Programs that write KML put the attributes of a line there, as they are to be shown:
 * rows of a table with two cells, or lines NAME: VALUE and NAME = VALUE, with or
 * without HTML around. */
#ifndef IL_INPUT_KML_DESCRIPTION_H
#define IL_INPUT_KML_DESCRIPTION_H

#include "input/map-set.h"

/* What the description TEXT[0..N), which is changed, says of the feature at hand: its
 * rows and lines of that kind as attributes; a text of a single line that is none, as
 * the place "description". */
il_status il_kml_description_tell(il_map_set *set, char *text, size_t n, il_error *err);

#endif
