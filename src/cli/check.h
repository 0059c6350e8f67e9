/* check.h - the two kinds of `check`; for src/cli/check*.c only. */
#ifndef IL_CLI_CHECK_H
#define IL_CLI_CHECK_H

#include "cli/command.h"

/* Is the native stream, or the mesh, in SOURCE sound?  Says so on standard
 * output and in JSON.  IL_OK, IL_E_UNSOUND, or why it cannot be told. */
il_status il_check_native(il_source *source, const il_options *o, il_voice *v, il_error *err);
il_status il_check_mesh(il_source *source, const il_options *o, il_voice *v, il_error *err);

/* Print what WRITE makes of SELF where --json asks, and what TEXT makes of it as
 * a table on standard output unless that takes the JSON. */
il_status il_check_print(const il_options *o, void (*text)(const void *self, il_output *out),
                         void (*json)(const void *self, il_output *out), const void *self, il_voice *v, il_error *err);

#endif
