/* dictionary.h - texts, numbered in the order in which they first came. */
#ifndef IL_BASE_DICTIONARY_H
#define IL_BASE_DICTIONARY_H

#include "base/keymap.h"

/* Names of files in which A to Z are the same as a to z: the spelling that came
 * first is kept.  pool: the texts with a terminator each; begin[n]: where they
 * stand in it. */
typedef struct il_dictionary {
    il_keymap at;
    char *pool;
    size_t n_pool, cap_pool;
    size_t *begin;
    size_t n, cap;
} il_dictionary;

#define IL_DICTIONARY_INIT { IL_KEYMAP_INIT, NULL, 0, 0, NULL, 0, 0 }

enum { IL_DICTIONARY_MOST = 1000 * 1000 };

/* The number of the text S[0..N), given to it now if it is new, in *INDEX; what lies
 * behind a NUL byte is another text, but not shown.  False when there is no memory, or
 * there are IL_DICTIONARY_MOST texts already (*INDEX is IL_DICTIONARY_MOST then). */
bool il_dictionary_put(il_dictionary *w, const char *s, size_t n, uint32_t *index);

/* The text with number I; good until the next put. */
const char *il_dictionary_text(const il_dictionary *w, size_t i);

void il_dictionary_free(il_dictionary *w);

#endif
