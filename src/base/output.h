/* output.h - output that arrives whole or not at all.
 *
 * A named file is written under a temporary name in its own folder and renamed
 * when it is complete, so that a failure leaves an older file as it was and
 * nothing beside it.  Standard output is checked to its last byte.  Only this
 * module opens, closes and renames what isoloft writes. */
#ifndef IL_BASE_OUTPUT_H
#define IL_BASE_OUTPUT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct il_output il_output;

/* PATH, or standard output for "-".  The folder must exist and be writable: the
 * temporary is made in it when the first block is full.  An existing file keeps
 * its permissions (and its owner, where the system allows that), one that is
 * write-protected is refused; a new one gets 0666 less the umask.  A symbolic
 * link stays, and what it points to is replaced.  A path that is no regular file
 * (/dev/full, a FIFO), or is where standard output goes, is written in place. */
il_status il_output_open(il_output **out, const char *path, il_error *err);

/* Output into memory that grows; for tests and embedding. */
il_status il_output_to_memory(il_output **out, il_error *err);
const unsigned char *il_output_memory(const il_output *o, size_t *n);

/* A spool: an unlinked temporary file in TMPDIR (or /tmp) that is written, and
 * then appended to another output.  Up to IL_SPOOL_MEMORY bytes stay in memory,
 * and no file is made.  Ends with il_output_discard. */
enum { IL_SPOOL_MEMORY = 256 * 1024 };
il_status il_output_spool(il_output **out, il_error *err);
/* Append all that SPOOL holds to O, in blocks; SPOOL stays open. */
il_status il_output_append_spool(il_output *o, il_output *spool, il_error *err);
/* The N bytes of SPOOL from AT on to TO; writing goes on at the end after it. */
il_status il_output_read_back(il_output *spool, uint64_t at, void *to, size_t n, il_error *err);
/* Forget all of SPOOL but its first BYTES. */
il_status il_output_rewind(il_output *spool, uint64_t bytes, il_error *err);

bool il_output_is_terminal(const il_output *o);
/* The path of the regular file that O will be; null for everything else. */
const char *il_output_file_path(const il_output *o);
/* BESIDE is O's from now on: both get their names when O is committed, after
 * all bytes of both are safe, and neither does when one fails.  One a file. */
void il_output_also(il_output *o, il_output *beside);
uint64_t il_output_bytes(const il_output *o);

/* Write; buffered.  The first failure is kept: later writes do nothing, and
 * commit reports it.  So a writer may check once, at the end. */
void il_output_write(il_output *o, const void *data, size_t n);
void il_output_string(il_output *o, const char *s);
void il_output_char(il_output *o, char c);
void il_output_number(il_output *o, double value);          /* il_number_format */
void il_output_float(il_output *o, float value);            /* il_number_format_float */
void il_output_integer(il_output *o, long long value);
void il_output_u32le(il_output *o, uint32_t v);
void il_output_f32le(il_output *o, float v);
void il_output_f64le(il_output *o, double v);

/* Push what is buffered to the file; for streams that a reader waits for. */
il_status il_output_flush(il_output *o, il_error *err);

/* The first error so far as a status, without ending anything. */
il_status il_output_status(const il_output *o, il_error *err);

/* Flush, close, rename.  IL_E_IO names the path and the system's reason; the
 * temporary file is gone then.  Frees O either way. */
il_status il_output_commit(il_output *o, il_error *err);

/* Give up: the temporary file is removed, an old file is left as it was.
 * Frees O; null is fine. */
void il_output_discard(il_output *o);

#endif
