/* index.h - the table of contents of a folder that was written to. */
#ifndef IL_CLI_INDEX_H
#define IL_CLI_INDEX_H

#include "cli/account.h"

/* Write FOLDER (with its slash) index.json: for every stack of A, in order, its
 * file, number, name, colour and status, as isoloft(1) describes it. */
il_status il_index_write(const char *folder, const il_account *a, il_error *err);

#endif
