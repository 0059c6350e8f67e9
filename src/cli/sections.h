/* sections.h - what the areas of a stack's slices add up to: the volumes that
 * planning systems give, to hold the mesh against. */
#ifndef IL_CLI_SECTIONS_H
#define IL_CLI_SECTIONS_H

#include "model/pair.h"
#include "model/stack.h"

/* areas: sum of those of the input's slices, unit^2.  trapezoids: sum of (A + A') / 2 (z' - z)
 * over neighbouring slices, unit^3, without pending, that of the last two, which
 * counts unless its pair says that they are not joined. */
typedef struct il_sections {
    double areas, trapezoids, pending;
    double z, area;             /* of the last slice */
    size_t n;
} il_sections;

/* Slices by rising z, a pair behind the upper one of its two, as they come.  COUNTS:
 * the slice is one of the input. */
void il_sections_slice(il_sections *s, const il_slice *slice, bool counts);
void il_sections_pair(il_sections *s, const il_pair *pair);

/* Of all slices so far. */
double il_sections_trapezoids(const il_sections *s);

#endif
