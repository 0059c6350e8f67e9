/* csv-names.h - what the names of columns say; without regard to case. */
#ifndef IL_INPUT_CSV_NAMES_H
#define IL_INPUT_CSV_NAMES_H

#include "model/stack.h"

/* The pairs of names that x and y have, in the order in which they are preferred. */
typedef enum il_csv_pair { IL_CSV_XY, IL_CSV_EASTING, IL_CSV_DEGREES, IL_CSV_N_PAIRS } il_csv_pair;

/* A coordinate: that of x or of y, and its unit where the name says it (_ft, (m)). */
typedef struct il_csv_axis {
    il_csv_pair pair;
    bool is_y, has_unit;
    il_unit unit;
} il_csv_axis;

/* Read NAME[0..N): words joined by _ - . or blanks: one for a coordinate, and besides
 * only units and words such as "coord" and "point".  False when it is no coordinate. */
bool il_csv_name_axis(const char *name, size_t n, il_csv_axis *out);

/* Is NAME[0..N) one of those of the number of a line or of a part of one? */
bool il_csv_name_numbers_lines(const char *name, size_t n);

/* Is it one of those that programs give the column of geometries? */
bool il_csv_name_is_geometry(const char *name, size_t n);

#endif
