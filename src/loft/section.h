/* section.h - a clean slice as the lofter needs it: nodes, and edges that grow points. */
#ifndef IL_LOFT_SECTION_H
#define IL_LOFT_SECTION_H

#include "base/keymap.h"
#include "base/status.h"
#include "model/stack.h"

/* The two sections of a slab. */
enum { IL_LOWER = 0, IL_UPPER = 1 };

/* Nodes are distinct positions: xy[2*n_nodes]; rings that touch share a node.
 * ring[i], vertex[i]: where node i first comes in the slice, or -1 when it was
 * inserted.  Stations are the vertices of all rings in order: station s stands
 * at node node_at[s], and edge s runs from station s to next[s].  Inserted
 * nodes follow the others, so that the numbers of nodes never change.
 * ring_at[s], vertex_at[s], t_at[s]: the place of station s on the slice's rings
 * as they came (model/pair.h), which insertions do not change; stations stand in
 * the order of their places. */
typedef struct il_section {
    double z;
    double *xy;              size_t n_nodes, cap_nodes;
    int32_t *ring, *vertex;  size_t cap_ring, cap_vertex;
    uint32_t *node_at, *next, *ring_at, *vertex_at;
    double *t_at;            size_t n_stations, n_rings;
} il_section;

#define IL_SECTION_INIT { 0 }
void il_section_free(il_section *s);

/* Products of four lengths of a smaller slice run out of exponents. */
#define IL_SECTION_EXTENT_LEAST 1e-40

/* The section of the clean slice S.  IL_E_INPUT when it is smaller than
 * IL_SECTION_EXTENT_LEAST across, or has too many points. */
il_status il_section_from_slice(il_section *out, const il_slice *s, il_error *err);

/* The section of the rings ring[N] of WHOLE (rising), with nodes and stations of
 * its own: node k of it is (*node_of)[k] of WHOLE, and station k is
 * (*station_of)[k]; both are the caller's, to il_free, and null after failure.
 * Places and numbers of rings are those of WHOLE.  O(n log n) in what is taken. */
il_status il_section_take(il_section *part, const il_section *whole, const uint32_t *ring, size_t n,
                          uint32_t **node_of, uint32_t **station_of, il_error *err);

/* The first station of ring RING; n_stations when RING is n_rings.  O(log n). */
uint32_t il_section_first_station(const il_section *s, size_t ring);

/* Where edge STATION ends, in the parameter of its original edge: 1, or the t of
 * a point inserted there. */
double il_section_end_t(const il_section *s, uint32_t station);

/* The length of all rings, unit. */
double il_section_length(const il_section *s);

/* A point that a slab puts on edge STATION at parameter T in (0, 1). */
typedef struct il_split {
    uint32_t station;
    double t;
    double xy[2];
} il_split;

/* Insert P[0..N) into S: node k of them becomes n_nodes + k, in the order given,
 * and its edge is split at it; several on one edge go by t. */
il_status il_section_insert(il_section *s, const il_split *p, size_t n, il_error *err);

/* *TO, whatever it held: FROM with P[0..N) inserted; to be freed after failure too. */
il_status il_section_copy_inserted(il_section *to, const il_section *from, const il_split *p, size_t n, il_error *err);

#endif
