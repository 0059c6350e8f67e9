/* destination.h - where the last stage's bytes go: one file, standard output,
 * or one file a stack in a folder. */
#ifndef IL_CLI_DESTINATION_H
#define IL_CLI_DESTINATION_H

#include "base/output.h"
#include "output/writer.h"

typedef struct il_destination il_destination;

/* Does -o PATH mean a folder?  It ends in a slash, or is one. */
bool il_destination_is_folder(const char *path);

/* PATH: null or "-" for standard output; a folder is made if it is missing (its
 * parent is not).  WRITER decides whether meshes or contours are taken; OPTIONS
 * is copied.  Binary to a terminal is IL_E_USAGE. */
il_status il_destination_open(il_destination **out, const char *path, const il_writer *writer,
                              const il_write_options *options, il_error *err);

/* The sink to write to; the one for what the writer does not take is null.  In
 * a folder a stack's file is put in place when the stack ends, and one without
 * a triangle gets none; a stack_begin where a stack is open gives that one up. */
il_mesh_sink *il_destination_meshes(il_destination *d);
il_sink *il_destination_contours(il_destination *d);

/* In a folder: the file that was put in place since the last call, or null.  D
 * is an il_destination; the name is good until the next stack begins. */
const char *il_destination_take_file(void *d);

/* The folder with a slash at its end; null for a single output. */
const char *il_destination_folder(const il_destination *d);

/* Put a single output in place.  The caller frees D all the same. */
il_status il_destination_commit(il_destination *d, il_error *err);

/* What was not committed is discarded.  Null is fine. */
void il_destination_free(il_destination *d);

#endif
