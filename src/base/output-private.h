/* output-private.h - what the three kinds of output share; for src/base only. */
#ifndef IL_BASE_OUTPUT_PRIVATE_H
#define IL_BASE_OUTPUT_PRIVATE_H

#include "base/output.h"

enum { IL_OUTPUT_BLOCK = 65536 };

typedef enum il_output_kind {
    IL_OUTPUT_REPLACED,  /* a regular file: temporary, then rename */
    IL_OUTPUT_IN_PLACE,  /* standard output, a device, a FIFO */
    IL_OUTPUT_MEMORY,
    IL_OUTPUT_SPOOL      /* memory, and an unlinked file once that is full */
} il_output_kind;

/* buf[used] of buf[cap] is not in the file yet; for IL_OUTPUT_MEMORY it is all
 * there is.  fd is -1 while there is no file: a temporary appears when the
 * first block is full, a spool's file when its memory is. */
struct il_output {
    il_output_kind kind;
    char *path;          /* as errors show it */
    char *target;        /* REPLACED: where the rename goes, symbolic links followed */
    char *temporary;     /* REPLACED: not null once it exists */
    unsigned mode;       /* REPLACED: permissions of the old file */
    bool existed, owns_fd;
    unsigned owner, group; /* REPLACED: of the old file */
    int fd;
    unsigned char *buf;
    size_t used, cap;
    uint64_t bytes;
    il_output *beside;   /* committed and discarded with this one */
    il_error failure;    /* the first one */
};

/* A new output called PATH with a buffer of CAP bytes. */
il_status il_output_new(il_output **out, il_output_kind kind, const char *path, size_t cap, il_error *err);

/* Write what is buffered to the file, which is made if there is none. */
void il_output_empty_buffer(il_output *o);

/* Make O's file; failures go into O->failure. */
bool il_output_make_temporary(il_output *o);
bool il_output_make_spool_file(il_output *o);

/* Close the descriptor: false with errno when the system could not keep what
 * was written. */
bool il_output_close_descriptor(il_output *o);

#endif
