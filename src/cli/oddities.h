/* oddities.h - what is unusual about the contours of a stack, in a few words each.
 *
 * What went wrong with it is another matter: il_stack_account.error. */
#ifndef IL_CLI_ODDITIES_H
#define IL_CLI_ODDITIES_H

#include "cli/account.h"

/* Call EACH with every oddity of S in a fixed order: "single slice", "2 gaps".
 * The words are good during the call. */
void il_oddities_each(const il_stack_account *s, void (*each)(void *self, const char *words), void *self);

#endif
