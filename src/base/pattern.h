/* pattern.h - names against the patterns that shells know. */
#ifndef IL_BASE_PATTERN_H
#define IL_BASE_PATTERN_H

#include <stdbool.h>
#include <stddef.h>

/* Does all of NAME match PATTERN?  * stands for any characters, ? for one, [a-z]
 * for one of a set, [!a-z] or [^a-z] for one of the others, and \ before a
 * character for that character; so does a [ that no ] closes.  Characters are
 * those of UTF-8, ordered by their codes; a byte that is none is one too.
 *
 * fnmatch(3) is not it: what it takes for a character depends on the locale, and
 * where its locale is UTF-8, glibc tries again with bytes.  O(nm) time at most. */
bool il_pattern_matches(const char *pattern, const char *name);

/* Do PATTERN[0..N) choose NAME?  A pattern that begins with ! chooses what does not
 * match the rest of it; NAME is chosen when a plain pattern matches it, or there is
 * none, and none of those with ! does.  MATCHED[N], may be null: which of them did
 * match NAME is added to it. */
bool il_pattern_choose(const char *const *pattern, size_t n, const char *name, bool *matched);

#endif
