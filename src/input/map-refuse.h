/* map-refuse.h - why a file is no map of isolines, in one line that says what was
 * seen instead.  Each gives IL_E_INPUT with the file named. */
#ifndef IL_INPUT_MAP_REFUSE_H
#define IL_INPUT_MAP_REFUSE_H

#include "input/map-data.h"

il_status il_map_refuse_no_lines(const il_map *m, il_error *err);
il_status il_map_refuse_no_heights(const il_map *m, il_error *err);
/* --height NAME names nothing that is there. */
il_status il_map_refuse_name(const il_map *m, const char *name, il_error *err);
/* All lines have height LEVEL. */
il_status il_map_refuse_one_level(const il_map *m, double level, il_error *err);

/* The place of the heights in words, "attribute 'elev'", in TO[SIZE]; returns TO. */
const char *il_map_place_words(const il_map *m, char *to, size_t size);

/* The map's box, "9, 50 to 10, 51", and one number, both rounded to 1e-7, in TO[SIZE];
 * each returns TO. */
enum { IL_MAP_BOX_MOST = 150 };
const char *il_map_box_words(const il_map *m, char *to, size_t size);
const char *il_map_number_words(double value, char *to, size_t size);

#endif
