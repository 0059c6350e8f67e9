/* bands-graph.h - faces of a map and the borders between them, some lines left out.
 *
 * Faces are nodes, borders arcs.  A line that is left out makes one face of those on its
 * sides; they keep their numbers, and one of them speaks for all: their leader. */
#ifndef IL_TERRAIN_BANDS_GRAPH_H
#define IL_TERRAIN_BANDS_GRAPH_H

#include "terrain/bands.h"

/* Where a face lies of a level on its border; FREE: it has levels below and above that one,
 * so it may be either. */
typedef enum il_lie { IL_LIE_BELOW, IL_LIE_ABOVE, IL_LIE_FREE } il_lie;

/* The levels on a face's border: lowest and highest, how many kinds (0, 1, 2, or 3 for more),
 * and the longest border of the lowest and of the highest.  wide: the face goes on below the
 * lowest (1), above the highest (2), for a line of that level is missing in it. */
enum { IL_WIDE_LOW = 1, IL_WIDE_HIGH = 2 };
typedef struct il_around { int32_t low, high; int kinds, wide; uint32_t border[2]; } il_around;

/* Faces that a line joined: ABSORBED speaks for itself no more. */
typedef struct il_merger { uint32_t keep, absorbed; } il_merger;

/* border[n]: sorted by line, then so that nothing depends on the order in which they came.
 * incident[first[f] .. first[f + 1]): the borders of face f; first_of_line likewise, into
 * border.  next[f]: the faces that are one with f, in a circle.  around, lie, directed:
 * of leaders; lie: of the level of a face that has only one; directed: it follows the
 * direction of its lines.  out[line].  work: borders looked at so far; beyond patience there are
 * no trials any more. */
typedef struct il_bands_graph {
    il_border *border;
    uint32_t *first, *incident, *first_of_line;
    uint32_t *leader, *next, *members;
    il_around *around;
    unsigned char *lie, *directed, *out;
    size_t n, n_faces, n_lines, n_levels, work, patience;
    il_side high;
} il_bands_graph;

/* From the arguments of il_bands_label; all lines are in, nothing is around
 * the faces yet.  IL_E_NOMEM:
 * to be freed all the same. */
il_status il_bands_graph_make(il_bands_graph *g, const il_border *border, size_t n, size_t n_faces, size_t n_lines,
                              size_t n_levels, il_side high, il_error *err);
void il_bands_graph_free(il_bands_graph *g);

/* Make one face of those on the sides of LINE, which goes out; MERGER (of n_faces) gets
 * how, their number is returned.  The caller looks around again. */
size_t il_bands_graph_take_out(il_bands_graph *g, uint32_t line, il_merger *merger);
/* The same undone, of the line that went out last. */
void il_bands_graph_put_back(il_bands_graph *g, uint32_t line, const il_merger *merger, size_t n);

/* Set around[FACE], a leader, not wide: O(its borders). */
void il_bands_graph_look_around(il_bands_graph *g, uint32_t face);
void il_bands_graph_look_all_around(il_bands_graph *g); /* of every leader */

/* Where LEADER lies of LEVEL, which is on its border. */
il_lie il_bands_graph_lie(const il_bands_graph *g, uint32_t leader, int32_t level);

/* The lie that g->high, which is known, gives to the face on that SIDE of a line. */
il_lie il_bands_graph_directed_lie(const il_bands_graph *g, int side);

/* Is something wrong with border B: does it not go from one side of its level to the other? */
bool il_bands_graph_is_bad(const il_bands_graph *g, uint32_t b);

/* Does the face lie on one side of a single level? */
static inline bool il_around_is_single(const il_around *a)
{
    return a->kinds == 1 && a->wide == 0;
}

/* The band of a face that is not single; a face without lines may have any height. */
static inline il_band il_around_band(const il_around *a, size_t n_levels)
{
    if (a->kinds == 0)
        return (il_band){ -1, (int32_t)n_levels };
    return (il_band){ a->low - (a->wide & 1), a->high + (a->wide >> 1) };
}

/* How many levels run through a face and are not there. */
static inline long il_around_missing(const il_around *a)
{
    return a->kinds == 0 || il_around_is_single(a) ? 0 : a->high - a->low - 1 + (a->wide & 1) + (a->wide >> 1);
}

static inline uint32_t il_bands_graph_leader(const il_bands_graph *g, uint32_t b, int side)
{
    return g->leader[g->border[b].face[side]];
}

/* The borders of a leader's faces, of lines that are not out; one with the same face on both
 * sides comes twice. */
typedef struct il_round { il_bands_graph *graph; uint32_t start, face, k; } il_round;

static inline il_round il_round_begin(il_bands_graph *g, uint32_t leader)
{
    return (il_round){ g, leader, leader, g->first[leader] };
}

static inline bool il_round_next(il_round *r, uint32_t *b)
{
    il_bands_graph *g = r->graph;
    for (;;) {
        while (r->k == g->first[r->face + 1]) {
            r->face = g->next[r->face];
            if (r->face == r->start)
                return false;
            r->k = g->first[r->face];
        }
        *b = g->incident[r->k++];
        g->work++;
        if (!g->out[g->border[*b].line])
            return true;
    }
}

#endif
