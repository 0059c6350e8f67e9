/* channel.h - where a ring runs back along itself. */
#ifndef IL_REGION_CHANNEL_H
#define IL_REGION_CHANNEL_H

#include "base/status.h"
#include "model/ring.h"

#include <stdint.h>

/* A ring without repeated points: xy[2*n]; vertex[n], where each was in the ring;
 * length[n + 1], from vertex 0 on. */
typedef struct il_outline {
    double *xy, *length;
    size_t *vertex;
    size_t n;
} il_outline;

#define IL_OUTLINE_INIT { NULL, NULL, NULL, 0 }
/* O from R, which is not kept; lengths in R's unit.  O(n).  IL_E_NOMEM, and then O is
 * IL_OUTLINE_INIT. */
il_status il_outline_init(il_outline *o, const il_ring *r, il_error *err);
void il_outline_free(il_outline *o); /* leaves IL_OUTLINE_INIT */

/* Length along O from vertex 0. */
double il_outline_length(const il_outline *o);

/* The point S along O; any S, O is closed.  O(log n). */
void il_outline_at(const il_outline *o, double s, double p[2]);

/* A place P on an outline: vertex `edge`, or inside the edge that begins there. */
typedef struct il_place {
    double p[2];
    size_t edge;
    bool at_vertex;
} il_place;

/* How far along O a place is. */
double il_place_length(const il_outline *o, const il_place *q);

/* The vertex at Q, or else the next one, onwards or backwards. */
size_t il_place_vertex(const il_outline *o, const il_place *q, bool onwards);

/* O from a[0] onwards to a[1] and from b[1] onwards to b[0] run in opposite
 * directions, a[0] beside b[0] and a[1] beside b[1], nowhere more than WIDTH apart. */
typedef struct il_channel {
    il_place a[2], b[2];
    double width;
} il_channel;

/* All channels of O not wider than TOLERANCE, each as long as it can be:
 * *CHANNEL[*N], the caller's, to il_free.  Every state of a walk along both sides
 * at once is a vertex on one side that lies beside a vertex or an edge of the
 * other; between two states the distance is linear on both, so never above the
 * larger end (the criterion of Alt & Godau 1995 for the Frechet distance, taken
 * greedily).  Only those with 20 tolerances of the outline or more between their
 * sides at either end are certain to be found.  O(n log n), and linear in the pairs of edges within the tolerance;
 * where these are more than 64 a vertex no channel can be told: *N is 0 then.
 * IL_E_NOMEM. */
il_status il_channels_find(const il_outline *o, double tolerance, il_channel **channel, size_t *n, il_error *err);

#endif
