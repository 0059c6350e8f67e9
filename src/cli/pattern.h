/* pattern.h - names against the patterns that shells know. */
#ifndef IL_CLI_PATTERN_H
#define IL_CLI_PATTERN_H

#include <stdbool.h>

/* Does all of NAME match PATTERN?  * stands for any characters, ? for one, [a-z]
 * for one of a set, [!a-z] or [^a-z] for one of the others, and \ before a
 * character for that character; so does a [ that no ] closes.  Characters are
 * those of UTF-8, ordered by their codes; a byte that is none is one too.
 *
 * fnmatch(3) is not it: what it takes for a character depends on the locale, and
 * where its locale is UTF-8, glibc tries again with bytes.  O(nm) time at most. */
bool il_pattern_matches(const char *pattern, const char *name);

#endif
