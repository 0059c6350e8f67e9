/* links.h - edges found by their two nodes, however many meet at one. */
#ifndef IL_TERRAIN_LINKS_H
#define IL_TERRAIN_LINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Edge k leads from node[2*k] to node[2*k + 1] or, in triangles, from node[k] to the next of
 * its triangle's three.  node[] is borrowed.  of[first[v]] .. of[first[v + 1]]: the edges whose
 * lesser node is v, by their greater one, then by number. */
typedef struct il_links {
    const uint32_t *node;
    bool in_triangles;
    uint32_t *first, *of;
} il_links;

#define IL_LINKS_INIT { 0 }

/* The N edges of node[], whose entries lie below N_NODES.  Linear: sorted by counting.  False
 * without memory. */
bool il_links_build(il_links *l, const uint32_t *node, size_t n, bool in_triangles, size_t n_nodes);
void il_links_free(il_links *l); /* safe twice */

/* The nodes that edge K leads from and to. */
uint32_t il_links_from(const il_links *l, size_t k);
uint32_t il_links_to(const il_links *l, size_t k);

/* The edges that join A and B, in either direction: of[begin] .. of[end].  O(log n). */
typedef struct il_links_range {
    uint32_t begin, end;
} il_links_range;

il_links_range il_links_find(const il_links *l, uint32_t a, uint32_t b);

/* How many pairs of nodes the N edges join. */
size_t il_links_count_pairs(const il_links *l, size_t n);

#endif
