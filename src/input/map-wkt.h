/* map-wkt.h - coordinate systems as well-known text, of both generations (OGC 01-009;
 * ISO 19162), as far as map-crs.h asks. */
#ifndef IL_INPUT_MAP_WKT_H
#define IL_INPUT_MAP_WKT_H

#include "input/map-crs.h"

/* Fill OUT, which is UNKNOWN, from TEXT; false when it is no WKT. */
bool il_crs_parse_wkt(const char *text, il_crs *out);

#endif
