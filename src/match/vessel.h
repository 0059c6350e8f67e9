/* vessel.h - names that tell of vessels. */
#ifndef IL_MATCH_VESSEL_H
#define IL_MATCH_VESSEL_H

#include <stdbool.h>

/* Does a word of TEXT (or null), of those that its punctuation, blanks, digits and changes from
 * lower to upper case part, begin as words for vessels and airways do (the list in vessel.c),
 * without regard to case? */
bool il_vessel_is_said(const char *text);

#endif
