/* window.h - a few sections and the slabs between them, lofted by all threads.
 *
 * Even slabs are lofted first, each alone on its two sections.  An odd slab
 * follows when both neighbours are done, and takes the sections with what they
 * inserted; then the even slabs follow its own insertions.  So every insertion
 * is made once, in an order that does not depend on the threads or on how much
 * of the stack is known (loft.md 8).  A slab is bent (curve.h) when its neighbours are finished,
 * by how they lean, which bending them does not change. */
#ifndef IL_LOFT_WINDOW_H
#define IL_LOFT_WINDOW_H

#include "base/threads.h"
#include "loft/lofter.h"
#include "loft/slab.h"

typedef enum il_slab_state {
    IL_SLAB_WAITING, IL_SLAB_LOFTING, IL_SLAB_LOFTED, IL_SLAB_FINISHING, IL_SLAB_FINISHED, IL_SLAB_BENDING, IL_SLAB_BENT
} il_slab_state;

/* A section at one end and the slab above it.  slice: its index in the stack.
 * beyond: it is an empty one that a dome ends at; then slice is -1 or the number
 * of slices at the ends of the stack, and in a gap that of the slice below. */
typedef struct il_window_place {
    il_section section;
    int32_t slice;
    bool beyond;
    il_pair pair;             /* of this slice and the one above, when there is one */
    il_slab slab;
    il_slab_state state;
    il_status status;         /* of the slab's work; it is finished when not IL_OK */
    il_error error;
    size_t n_split;           /* pinched edges taken apart */
    double volume, area;      /* of the slab's triangles, about origin, unit^3 and unit^2 */
} il_window_place;

/* Sections first .. first + n - 1 of the stack are held; section p is
 * place[p % IL_LOFT_WINDOW].  All fields belong to the crew's mutex. */
typedef struct il_window {
    il_window_place place[IL_LOFT_WINDOW];
    size_t first, n;
    bool ended, cancelled, round_float;
    int between;              /* contours put into each slab, or IL_BETWEEN_AUTO */
    il_cap cap;
    double origin[3];         /* for volumes, near the stack */
    il_crew crew;
} il_window;

il_status il_window_start(il_window *w, const il_loft_options *o, il_error *err);
void il_window_stop(il_window *w);    /* ends the threads, frees all */

/* With the crew's mutex held, from here on. */

static inline il_window_place *il_window_at(il_window *w, size_t p)
{
    return &w->place[p % IL_LOFT_WINDOW];
}

/* Append a section (taken over) with what is known of it and the one before: PAIR
 * (taken over), or null for nothing.  There must be room (n < IL_LOFT_WINDOW). */
void il_window_push(il_window *w, il_section *section, int32_t slice, bool beyond, il_pair *pair);

/* No section will follow. */
void il_window_end(il_window *w);

/* Is slab P, between sections P and P + 1, there at all? */
static inline bool il_window_has_slab(const il_window *w, size_t p)
{
    return p >= w->first && p + 1 < w->first + w->n;
}

/* May the first slab leave?  It is finished, and so is the next, if any. */
bool il_window_ready(il_window *w);

/* Drop the first section with its slab. */
void il_window_pop(il_window *w);

/* Forget the stack: waits for running work, then empties the window. */
void il_window_clear(il_window *w);

#endif
