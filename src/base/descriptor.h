/* descriptor.h - the few things that every file descriptor wants alike.
 *
 * For source and output only: nobody else sees descriptors. */
#ifndef IL_BASE_DESCRIPTOR_H
#define IL_BASE_DESCRIPTOR_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* FD, or a duplicate of it above 2 when it took the place of a closed standard
 * stream: else what is meant for the screen would land in a user's file.  -1
 * with errno on failure, and FD is closed then; -1 stays -1. */
int il_descriptor_above_stdio(int fd);

/* read(2) that is not disturbed by signals and waits on a non-blocking FD.
 * False with errno; *GOT is 0 at the end. */
bool il_descriptor_read(int fd, void *to, size_t n, size_t *got);

/* write(2) of all N bytes, likewise. */
bool il_descriptor_write(int fd, const void *from, size_t n);

/* IL_E_IO for FILE: "WHAT: the system's words for REASON" (an errno). */
il_status il_fail_system(il_error *err, const char *file, const char *what, int reason);

#endif
