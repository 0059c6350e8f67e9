/* sector.h - which copy of a point each corner of a sheet triangle is (loft.md 5).
 *
 * Over a contour point the surface may need a copy in the lower plane, one in
 * the upper, or both.  A sector is a run of sheet triangles round a point
 * between two contour edges; the labels of these edges decide.  Where they
 * differ the sheet contains the vertical edge between the two copies, and one
 * triangle of the sector has both as its corner. */
#ifndef IL_LOFT_SECTOR_H
#define IL_LOFT_SECTOR_H

#include "loft/overlay.h"

/* Beside IL_LOWER and IL_UPPER: a point inside a sheet, between the planes. */
enum { IL_FREE = 2 };

/* out[3*t + k]: the copy of corner k that the edge leaving it in t ends in;
 * in[3*t + k]: the one that the edge arriving at it ends in.  They differ at
 * two-copy corners only.  Meaningless for triangles that are no sheet. */
typedef struct il_labels {
    unsigned char *in, *out;
} il_labels;

il_status il_labels_assign(il_labels *l, const il_overlay *o, il_error *err);
void il_labels_free(il_labels *l);

/* The plane, IL_LOWER or IL_UPPER, in which contour edge E = 3 * t + k of sheet
 * triangle t runs.  Where both boundaries run there, against each other, the
 * sheet of the upper region hangs from the upper plane and that of the lower
 * stands on the lower: the solids stay apart. */
unsigned char il_edge_plane(const il_overlay *o, uint32_t e);

/* Would edge K of sheet triangle T lie flat in a slice's plane although it is
 * no contour edge?  Such edges are broken at their middle (axis.h). */
static inline bool il_labels_flat(const il_labels *l, const il_overlay *o, size_t t, size_t k)
{
    unsigned char a = l->out[3 * t + k], b = l->in[3 * t + (k + 1) % 3];
    return !(o->edge[3 * t + k] & IL_EDGE_CONTOUR) && a == b && a != IL_FREE;
}

#endif
