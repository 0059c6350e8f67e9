/* source.h - where input bytes come from: a file, standard input, memory.
 *
 * Readers see only this: they know no files and no compression.  gzip streams
 * (RFC 1952, also several members in a row) are undone on the way.  Zero bytes
 * behind the last member are padding, as tapes and block devices leave it; any
 * other byte there is IL_E_INPUT, because it is as likely the rest of a member
 * whose head is damaged as something that may be dropped. */
#ifndef IL_BASE_SOURCE_H
#define IL_BASE_SOURCE_H

#include "base/status.h"

#include <stddef.h>

typedef struct il_source il_source;

/* Open PATH, or standard input for "-"; the name shown in errors is PATH, or
 * "-".  A folder, a missing file, one that may not be read: IL_E_IO. */
il_status il_source_open(il_source **out, const char *path, il_error *err);

/* The same, but *OUT is null and nothing has failed when there is no such file. */
il_status il_source_open_if_there(il_source **out, const char *path, il_error *err);

/* Read from N bytes at DATA, which must outlive the source.  For tests,
 * fuzzers and embedding; NAME is shown in errors and copied. */
il_status il_source_from_memory(il_source **out, const void *data, size_t n,
                                const char *name, il_error *err);

/* What errors call it. */
const char *il_source_name(const il_source *s);

/* Up to N bytes to BUF; *GOT is 0 only at the end.  May give fewer than asked
 * for although more will come.  A damaged gzip stream: IL_E_INPUT, once all that
 * could be decoded before the damage was given.  A failure stays. */
il_status il_source_read(il_source *s, void *buf, size_t n, size_t *got, il_error *err);

/* All the bytes that are left, to be freed by il_free, in *BYTES, and how many in *N;
 * null after a failure. */
il_status il_source_load(il_source *s, unsigned char **bytes, size_t *n, il_error *err);

/* The next bytes without taking them, at least N unless the input ends before
 * (N at most 65536): for telling formats apart.  The pointer is good until the
 * next call on S. */
il_status il_source_peek(il_source *s, size_t n, const unsigned char **data, size_t *got, il_error *err);

void il_source_close(il_source *s); /* null is fine */

/* Lines of a source, each without its end (LF or CR LF); the last need not have
 * one (a CR without its LF is then part of it).  The buffer belongs to the line reader
 * and holds until the next call; lines above MAX_LINE bytes: IL_E_INPUT. */
typedef struct il_lines {
    il_source *source;   /* borrowed */
    size_t max_line;
    char *buf;
    size_t cap, begin, end;
    long line;           /* number of the line last returned, from 1 */
    int at_end;
    int had_cr;          /* the line last returned ended in CR LF */
} il_lines;

void il_lines_init(il_lines *l, il_source *source, size_t max_line);
/* *LINE is null at the end of the input. */
il_status il_lines_next(il_lines *l, const char **line, size_t *n, il_error *err);
void il_lines_free(il_lines *l);

#endif
