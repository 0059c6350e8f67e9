/* law.h - the heights between the lines.
 *
 * The one place that decides how high a point of a face lies.  The straight law: in a band, z
 * runs evenly from one line to the other, by the distances to both; in a face that one level
 * alone bounds, a dome or hollow that begins with the slope of the band across its line.  Over
 * it lies the one that bends (terrain/smooth.h), and where that knows nothing, because a face
 * lies between nodes of its field, the straight one holds. */
#ifndef IL_TERRAIN_LAW_H
#define IL_TERRAIN_LAW_H

#include "base/nearest.h"
#include "terrain/smooth.h"

/* MEAN: what a plate between the lines and its band let expect; PLATE: the plate alone; STRAIGHT.
 * has_spread, spread: of the mean (terrain/smooth.h), else it is measured. */
typedef enum il_law_kind { IL_LAW_MEAN, IL_LAW_PLATE, IL_LAW_STRAIGHT } il_law_kind;
typedef struct il_law_options {
    il_law_kind kind;
    bool has_spread;
    double spread;
} il_law_options;

/* width[f]: how far apart the lines of face f lie on average, the mesh's unit; of a face with
 * one level, that of the faces around it; 0 where there is none.
 * borders: the edges of lines, class 2 f for those that face f lies above, 2 f + 1 below.
 * spots: spot heights, in the class of their face, by their nodes; excess[node]: how much
 * higher they are than the law has it without them.
 * east: how much longer a unit of y is than one of x, 1 but for degrees; distances are in the
 * unit of y.  smooth: empty while the law is straight. */
typedef struct il_law {
    const il_chart *chart;
    const il_band *band;
    double *width;
    il_nearest borders, spots;
    double *excess;
    double east;
    il_smooth smooth;
} il_law;

/* The straight law on the faces of T, which C's lines bound as BAND says. */
il_status il_law_build(il_law *l, const il_tin *t, const il_chart *c, const il_band *band, double east, il_error *err);
/* From now on the law that O names; T as before.  IL_E_NOMEM; L can only be freed then. */
il_status il_law_bend(il_law *l, const il_tin *t, const il_law_options *o, il_error *err);
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
