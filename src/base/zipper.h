/* zipper.h - a strip of triangles between two chains that run the same way. */
#ifndef IL_BASE_ZIPPER_H
#define IL_BASE_ZIPPER_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* One vertex of a chain: where it lies in the deformed plane, and at which
 * place of the common reference polyline (rising along the chain). */
typedef struct il_zip_vertex {
    double x, y;
    uint32_t code;
    size_t place;
} il_zip_vertex;

/* The monotone strip between lower[n_lower] and upper[n_upper] (both at least 2,
 * ends facing each other) with the least sum of the distances of the vertices
 * that it joins, in the deformed plane: the shortest path in the grid of pairs
 * (Keppel 1975; Fuchs, Kedem & Uselton 1977), searched in a band round the
 * common order that is widened until the path keeps off its edges or the band
 * has 2^27 pairs.
 * step[n_lower + n_upper - 2]: 0 goes on along the lower chain, 1 along the
 * upper; the caller's, to il_free.  O((n_lower + n_upper) * band). */
il_status il_zip(const il_zip_vertex *lower, size_t n_lower, const il_zip_vertex *upper, size_t n_upper,
                 unsigned char **step, il_error *err);

#endif
