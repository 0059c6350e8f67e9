/* parity.h - even-odd regions of a triangulation. */
#ifndef IL_BASE_PARITY_H
#define IL_BASE_PARITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* inside[N]: which regions each of N triangles lies in, a bit for each.
 * across[3*N]: the triangle beyond edge k of t, or UINT32_MAX beyond the hull,
 * where there is no region; edge[3*N]: the regions whose boundary the edge is
 * on (bits within MASK), flipped on crossing it.  O(N); false without memory. */
bool il_parity_flood(const uint32_t *across, const unsigned char *edge, unsigned char mask,
                     size_t n, unsigned char *inside);

#endif
