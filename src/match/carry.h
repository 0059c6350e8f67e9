/* carry.h - links that follow their rings when these are rounded. */
#ifndef IL_MATCH_CARRY_H
#define IL_MATCH_CARRY_H

#include "model/pair.h"
#include "model/stack.h"

/* The links of P, of the slices WAS (lower, upper), between the rings of IS, which rounding to
 * 32-bit floats and cleaning made of them: *LINK, the caller's to il_free, *N, rising, each pair
 * of rings once.  A ring goes on in the one of its direction that has most of its vertices, and
 * in those that have theirs mostly from it; so what was one may be several, and several one, and
 * what is gone has no links.  A group of P that has none counts as if its first rings overlapped
 * all others.  IL_E_NOMEM. */
il_status il_links_carry(const il_pair *p, const il_slice was[2], const il_slice is[2], il_link **link, size_t *n, il_error *err);

#endif
