/* kml-points.h - the text of KML's coordinates, read as it arrives. */
#ifndef IL_INPUT_KML_POINTS_H
#define IL_INPUT_KML_POINTS_H

#include "input/map-set.h"

/* is_coord: of gx:coord, which is one point with blanks between its numbers.
 * value[n]: the numbers of the point at hand, which begins in line; comma: another
 * one has to follow.  rest[n_rest]: the beginning of a number that goes on in the next
 * piece.  first, last: of the n_points points since il_kml_points_reset; z NAN. */
typedef struct il_kml_points {
    il_map_set *set;            /* borrowed */
    size_t max_text;
    bool is_coord, comma;
    double value[3];
    size_t n;
    long line, at;              /* at: the line that reading has come to */
    char *rest;
    size_t n_rest, cap_rest;
    double first[3], last[3];
    size_t n_points;
} il_kml_points;

/* The part at hand begins. */
void il_kml_points_reset(il_kml_points *p);

/* One element: begin, its text S[0..N) in any pieces, each with the line it begins in,
 * end.  IL_E_INPUT: what is no number, and commas that leave a doubt. */
void il_kml_points_begin(il_kml_points *p, bool is_coord);
il_status il_kml_points_add(il_kml_points *p, const char *s, size_t n, long line, il_error *err);
il_status il_kml_points_end(il_kml_points *p, long line, il_error *err);

/* Let the part end where it began. */
il_status il_kml_points_close(il_kml_points *p, long line, il_error *err);

void il_kml_points_free(il_kml_points *p);

#endif
