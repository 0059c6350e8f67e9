/* spool.c - bytes that wait until it is known whether they are wanted. */
#include "config.h"
#include "base/output-private.h"
#include "base/alloc.h"
#include "base/descriptor.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

il_status il_output_spool(il_output **out, il_error *err)
{
    return il_output_new(out, IL_OUTPUT_SPOOL, "temporary file", IL_SPOOL_MEMORY, err);
}

bool il_output_make_spool_file(il_output *o)
{
    if (o->failure.code != IL_OK)
        return false;
    const char *folder = getenv("TMPDIR");
    if (!folder || !*folder)
        folder = "/tmp";
    char path[4096];
    int n = snprintf(path, sizeof path, "%s/isoloft-XXXXXX", folder);
    if (n < 0 || (size_t)n >= sizeof path) {
        il_fail_system(&o->failure, folder, "cannot make a temporary file", ENAMETOOLONG);
        return false;
    }
    int fd = mkstemp(path);
    if (fd < 0) {
        il_fail_system(&o->failure, folder, "cannot make a temporary file in this folder (TMPDIR)", errno);
        return false;
    }
    unlink(path);
    o->fd = il_descriptor_above_stdio(fd);
    o->owns_fd = o->fd >= 0;
    if (o->fd < 0)
        il_fail_system(&o->failure, folder, "cannot make a temporary file", errno);
    return o->fd >= 0;
}

/* ---- reading back --------------------------------------------------------- */

static bool read_at(int fd, uint64_t at, void *to, size_t n)
{
    char *p = to;
    while (n > 0) {
        ssize_t r = pread(fd, p, n, (off_t)at);
        if (r < 0 && errno == EINTR)
            continue;
        if (r <= 0) {
            errno = r == 0 ? EIO : errno;
            return false;
        }
        p += r, at += (uint64_t)r, n -= (size_t)r;
    }
    return true;
}

il_status il_output_read_back(il_output *spool, uint64_t at, void *to, size_t n, il_error *err)
{
    if (spool->failure.code != IL_OK)
        return il_output_status(spool, err);
    if (at > spool->bytes || n > spool->bytes - at)
        return il_fail(err, IL_E_INTERNAL, 0, "a spool is read beyond its end");
    uint64_t in_file = spool->bytes - spool->used;
    size_t from_file = at >= in_file ? 0 : n < in_file - at ? n : (size_t)(in_file - at);
    if (from_file > 0 && !read_at(spool->fd, at, to, from_file)) {
        il_fail_system(&spool->failure, spool->path, "cannot read back", errno);
        return il_output_status(spool, err);
    }
    if (n > from_file)
        memcpy((char *)to + from_file, spool->buf + (at + from_file - in_file), n - from_file);
    return IL_OK;
}

il_status il_output_append_spool(il_output *o, il_output *spool, il_error *err)
{
    unsigned char *block = il_alloc(IL_OUTPUT_BLOCK, 1);
    if (!block)
        return il_fail_nomem(err);
    il_status st = il_output_status(spool, err);
    for (uint64_t at = 0; st == IL_OK && at < spool->bytes;) {
        size_t n = spool->bytes - at < IL_OUTPUT_BLOCK ? (size_t)(spool->bytes - at) : IL_OUTPUT_BLOCK;
        st = il_output_read_back(spool, at, block, n, err);
        if (st == IL_OK) {
            il_output_write(o, block, n);
            st = il_output_status(o, err);
        }
        at += n;
    }
    il_free(block);
    return st;
}

il_status il_output_rewind(il_output *spool, uint64_t bytes, il_error *err)
{
    if (spool->failure.code != IL_OK)
        return il_output_status(spool, err);
    if (bytes > spool->bytes)
        return il_fail(err, IL_E_INTERNAL, 0, "a spool is rewound beyond its end");
    uint64_t in_file = spool->bytes - spool->used;
    if (bytes >= in_file) {
        spool->used = (size_t)(bytes - in_file);
    } else {
        spool->used = 0;
        if (ftruncate(spool->fd, (off_t)bytes) != 0 || lseek(spool->fd, (off_t)bytes, SEEK_SET) < 0)
            il_fail_system(&spool->failure, spool->path, "cannot shorten", errno);
    }
    spool->bytes = bytes;
    return il_output_status(spool, err);
}
