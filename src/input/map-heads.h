/* map-heads.h - the heads of a table: the names of the attributes that all features
 * have, in the order in which their values come. */
#ifndef IL_INPUT_MAP_HEADS_H
#define IL_INPUT_MAP_HEADS_H

#include "input/map-set.h"

/* Of attributes that may be heights so many are read; the set keeps no more either. */
enum { IL_MAP_HEADS_MOST = 200 };

/* name[0..n), terminated; owned.  is_taken: it is no attribute, but says where points
 * are. */
typedef struct il_map_head {
    char *name;
    size_t n;
    bool is_taken;
} il_map_head;

/* wanted[n_wanted]: the places in head[n] of those that may be heights. */
typedef struct il_map_heads {
    il_map_head *head;          size_t n, cap;
    size_t *wanted;             size_t n_wanted, cap_wanted;
} il_map_heads;

void il_map_heads_free(il_map_heads *h); /* leaves none */

il_status il_map_heads_add(il_map_heads *h, const char *name, size_t n, il_error *err);

/* Find those that are wanted, when all are there.  Of two with the same name the first
 * counts, which is told. */
il_status il_map_heads_choose(il_map_heads *h, il_map_set *set, il_error *err);

/* Tell of all attributes, without values, so that they can be named to the user; inside
 * of a feature, once a file. */
il_status il_map_heads_tell(const il_map_heads *h, il_map_set *set, il_error *err);

#endif
