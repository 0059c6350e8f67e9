/* law.h - the heights between the lines.
 *
 * The one place that decides how high a point of a face lies.  What is here is the straight
 * law: in a band, z runs evenly from one line to the other, by the distances to both; in a
 * face that one level alone bounds, a dome or hollow that begins with the slope of the band
 * across its line.  A smooth law (a bending plate held in its band, then the band's mean)
 * would take its place: it needs what is here, the distances to both lines, the widths of
 * this band and the next, and heights that stay inside the band. */
#ifndef IL_TERRAIN_LAW_H
#define IL_TERRAIN_LAW_H

#include "base/nearest.h"
#include "terrain/tin.h"

/* width[f]: how far apart the lines of face f lie on average, the mesh's unit; of a face with
 * one level, that of the faces around it; 0 where there is none.
 * borders: the edges of lines, class 2 f for those that face f lies above, 2 f + 1 below.
 * spots: spot heights, in the class of their face, by their nodes; excess[node]: how much
 * higher they are than the law has it without them. */
typedef struct il_law {
    const il_chart *chart;
    const il_band *band;
    double *width;
    il_nearest borders, spots;
    double *excess;
} il_law;

/* The law on the faces of T, which C's lines bound as BAND says. */
il_status il_law_build(il_law *l, const il_tin *t, const il_chart *c, const il_band *band, il_error *err);
void il_law_free(il_law *l); /* safe twice */

/* The height on the map at the mesh's (x, y) in face F: strictly between the levels of its
 * band, or beyond the only one by less than IL_LAW_MOST of an interval.  O(log n). */
#define IL_LAW_MOST 0.99
double il_law_height(const il_law *l, uint32_t face, double x, double y);

/* Does the face on side K of T's, where a line is, lie above it?  Where a face lacks lines that is
 * not always told by its own band, but by that of the face across. */
bool il_law_is_above(const il_tin *t, const il_chart *c, const il_band *band, size_t k);

/* The distance of the levels of face F, on the map. */
double il_law_interval(const il_law *l, uint32_t face);

#endif
