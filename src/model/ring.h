/* ring.h - one closed planar polygon (or, in input only, an open line). */
#ifndef IL_MODEL_RING_H
#define IL_MODEL_RING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Coordinates, and whatever else a stack says in its unit, stay below this. */
#define IL_COORDINATE_BOUND 1e15

/* Marks of a vertex. */
enum {
    IL_VERTEX_INSERTED = 1, /* not from the input: put there by isoloft */
    IL_VERTEX_MAP_EDGE = 2  /* the edge from this vertex to the next lies on the map frame */
};

/* xy[2*n]: x0 y0 x1 y1 ..., in the stack's unit; owned.  A closed ring does not
 * repeat its first vertex.  After normalisation: no two neighbours are equal, no
 * vertex comes twice, the region lies on the left (outer rings counter-clockwise
 * seen from +z, holes clockwise).  mark[n] holds the marks, or is null for none.
 * file, line, feature: where the record stood in the input: which of the stack head's
 * files, where they are known; the line there, and which of its features it was, from 1;
 * 0 unknown.  extra: unknown x- lines of the record, carried through (see il_extra). */
typedef struct il_ring {
    double *xy;
    unsigned char *mark;
    size_t n, cap, cap_mark;
    bool open;
    uint32_t file;
    long line, feature;
    struct il_extra *extra;
} il_ring;

#define IL_RING_INIT { NULL, NULL, 0, 0, 0, false, 0, 0, 0, NULL }

void il_ring_free(il_ring *r); /* leaves IL_RING_INIT; safe twice */

/* TO came from where FROM did. */
static inline void il_ring_take_origin(il_ring *to, const il_ring *from)
{
    to->file = from->file;
    to->line = from->line;
    to->feature = from->feature;
}

/* Append (x, y) with marks; false when there is no memory. */
bool il_ring_add(il_ring *r, double x, double y, unsigned char mark);

/* Twice the signed area of R, unit^2; > 0 when counter-clockwise.  Shoelace sum
 * about vertex 0, which keeps the terms small for rings far from the origin. */
double il_ring_area2(const il_ring *r);

/* Length of R, unit; with the closing edge unless it is open. */
double il_ring_length(const il_ring *r);

/* Turn R round: the direction changes, vertex 0 stays first (of an open line the
 * last becomes first).  Map-edge marks move with their edges. */
void il_ring_reverse(il_ring *r);

/* Make vertex K the first; K < n. */
void il_ring_rotate(il_ring *r, size_t k);

/* Drop vertices equal to the one before, and of a closed ring last ones equal to
 * the first; how many.  A vertex is marked as inserted when all were of which it
 * is left, and has the map-edge mark of the last. */
size_t il_ring_drop_repeated(il_ring *r);

/* Drop where R, without repeated vertices, goes and comes back over the same edges:
 * of ... a b c b d ... is left a b d.  How many edges were gone over twice; marks as
 * above.  A ring may be left with two vertices, an open line has its two ends. */
size_t il_ring_drop_spikes(il_ring *r);

/* Lines that start with x-, kept in order for whoever understands them. */
typedef struct il_extra {
    char *text;             /* without the line's end */
    struct il_extra *next;
} il_extra;

bool il_extra_add(il_extra **list, const char *text, size_t n);
/* All of FROM behind what TO has; FROM is empty then.  They are two lists. */
void il_extra_move(il_extra **to, il_extra **from);
void il_extra_free(il_extra **list);

#endif
