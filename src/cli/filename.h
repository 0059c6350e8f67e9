/* filename.h - file names made of what a stack calls itself. */
#ifndef IL_CLI_FILENAME_H
#define IL_CLI_FILENAME_H

#include "base/keymap.h"

#include <stdbool.h>
#include <stddef.h>

enum { IL_FILENAME_NAME = 64, IL_FILENAME_MAX = 160 };

/* NNNN-NAME.EXT into TO[IL_FILENAME_MAX].  NNNN is NUMBER with at least four
 * digits, and NNNN-2, NNNN-3 ... where USED has seen it before; NAME is the
 * first IL_FILENAME_NAME bytes of NAME with every byte outside [A-Za-z0-9_-]
 * made _, and is left out with its hyphen when empty.  NUMBER >= 0.  No two
 * names made with one USED are equal, and none is a path or begins with a
 * hyphen or a point.  False when there is no memory. */
bool il_filename_make(char *to, long number, const char *name, const char *extension, il_keymap *used);

/* The extension of PATH behind its last point, or "" when its last part has
 * none (a point that it begins with makes no extension). */
const char *il_filename_extension(const char *path);

#endif
