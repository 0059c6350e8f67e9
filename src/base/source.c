#include "config.h"
#include "base/source.h"
#include "base/alloc.h"
#include "base/descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { BLOCK = 65536, PEEK_MOST = 65536 };

/* Bytes flow  descriptor or memory -> raw -> (inflate) -> ahead -> reader.
 * raw[raw_begin..raw_end) came from outside and is not decoded yet: the block,
 * or all of a memory source.  ahead holds what was peeked at and not yet read. */
struct il_source {
    char *name;
    int fd;                     /* -1: memory */
    unsigned char *block;       /* BLOCK bytes, for descriptors */
    const unsigned char *raw;
    size_t raw_begin, raw_end;
    bool raw_ended;
    bool begun, gzip, inflating, in_member, ended;
    z_stream z;
    unsigned char *ahead;       /* PEEK_MOST bytes, once something is peeked at */
    size_t ahead_begin, ahead_end;
    il_error failure;           /* kept: every later call fails alike */
};

/* ---- opening and closing -------------------------------------------------- */

static il_status source_new(il_source **out, const char *name, il_error *err)
{
    il_source *s = il_calloc(1, sizeof *s);
    if (s)
        s->name = il_strndup(name, strlen(name));
    if (!s || !s->name) {
        il_free(s);
        return il_fail_nomem(err);
    }
    s->fd = -1;
    *out = s;
    return IL_OK;
}

static il_status open_descriptor(il_source *s, il_error *err)
{
    bool standard = strcmp(s->name, "-") == 0;
    s->fd = standard ? STDIN_FILENO : il_descriptor_above_stdio(open(s->name, O_RDONLY | O_CLOEXEC | O_NOCTTY));
    struct stat st;
    if (s->fd < 0 || fstat(s->fd, &st) != 0)
        return il_fail_system(err, s->name, "cannot open", errno);
    if (S_ISDIR(st.st_mode))
        return il_fail_system(err, s->name, "cannot read", EISDIR);
    return IL_OK;
}

il_status il_source_open(il_source **out, const char *path, il_error *err)
{
    *out = NULL;
    il_source *s = NULL;
    il_status st = source_new(&s, path, err);
    if (st == IL_OK)
        st = open_descriptor(s, err);
    if (st == IL_OK) {
        s->block = il_alloc(BLOCK, 1);
        s->raw = s->block;
        if (!s->block)
            st = il_fail_nomem(err);
    }
    if (st == IL_OK)
        *out = s;
    else
        il_source_close(s);
    return st;
}

il_status il_source_open_if_there(il_source **out, const char *path, il_error *err)
{
    struct stat st;
    *out = NULL;
    if (stat(path, &st) != 0 && (errno == ENOENT || errno == ENOTDIR))
        return IL_OK;
    return il_source_open(out, path, err);
}

il_status il_source_from_memory(il_source **out, const void *data, size_t n,
                                const char *name, il_error *err)
{
    *out = NULL;
    il_status st = source_new(out, name, err);
    if (st == IL_OK) {
        (*out)->raw = data;
        (*out)->raw_end = n;
        (*out)->raw_ended = true;
    }
    return st;
}

void il_source_close(il_source *s)
{
    if (!s)
        return;
    if (s->inflating)
        inflateEnd(&s->z);
    if (s->fd > STDIN_FILENO)
        close(s->fd);
    il_free(s->ahead);
    il_free(s->block);
    il_free(s->name);
    il_free(s);
}

const char *il_source_name(const il_source *s)
{
    return s->name;
}

/* ---- raw bytes ------------------------------------------------------------ */

static il_status fail_gzip(il_source *s, const char *what)
{
    il_status st = il_fail(&s->failure, IL_E_INPUT, 0, "%s", what);
    il_error_set_file(&s->failure, s->name);
    return st;
}

/* Have at least NEED raw bytes (NEED at most BLOCK), or all that there are. */
static il_status fill_raw(il_source *s, size_t need)
{
    while (!s->raw_ended && s->raw_end - s->raw_begin < need) {
        if (s->raw_begin > 0) {
            memmove(s->block, s->block + s->raw_begin, s->raw_end - s->raw_begin);
            s->raw_end -= s->raw_begin;
            s->raw_begin = 0;
        }
        size_t got = 0;
        if (!il_descriptor_read(s->fd, s->block + s->raw_end, BLOCK - s->raw_end, &got))
            return il_fail_system(&s->failure, s->name, "cannot read", errno);
        s->raw_end += got;
        s->raw_ended = got == 0;
    }
    return IL_OK;
}

static bool at_gzip_magic(const il_source *s)
{
    const unsigned char *p = s->raw + s->raw_begin;
    return s->raw_end - s->raw_begin >= 2 && p[0] == 0x1f && p[1] == 0x8b;
}

/* ---- gzip ----------------------------------------------------------------- */

static voidpf zlib_alloc(voidpf self, uInt n, uInt size)
{
    (void)self;
    return il_alloc(n, size);
}

static void zlib_free(voidpf self, voidpf p)
{
    (void)self;
    il_free(p);
}

static il_status begin(il_source *s)
{
    il_status st = fill_raw(s, 2);
    if (st != IL_OK)
        return st;
    s->begun = true;
    s->gzip = at_gzip_magic(s);
    if (!s->gzip)
        return IL_OK;
    s->z.zalloc = zlib_alloc;
    s->z.zfree = zlib_free;
    enum { GZIP_ONLY = 16 };
    if (inflateInit2(&s->z, MAX_WBITS + GZIP_ONLY) != Z_OK)
        return il_fail_nomem(&s->failure);
    s->inflating = s->in_member = true;
    return IL_OK;
}

/* Behind a member: another one, zero bytes to the end, or the end. */
static il_status after_member(il_source *s)
{
    il_status st = fill_raw(s, 2);
    if (st != IL_OK)
        return st;
    if (at_gzip_magic(s)) {
        s->in_member = true;
        return inflateReset(&s->z) == Z_OK ? IL_OK : fail_gzip(s, "the gzip stream is damaged");
    }
    while (s->raw_begin < s->raw_end) {
        if (s->raw[s->raw_begin++] != 0)
            return fail_gzip(s, "something that is not gzip follows the gzip stream");
        if (s->raw_begin == s->raw_end && (st = fill_raw(s, 1)) != IL_OK)
            return st;
    }
    s->ended = true;
    return IL_OK;
}

/* Inflate up to N bytes of the current member. */
static il_status inflate_some(il_source *s, unsigned char *to, size_t n, size_t *got)
{
    il_status st = fill_raw(s, 1);
    if (st != IL_OK)
        return st;
    size_t in = s->raw_end - s->raw_begin, most = UINT32_MAX / 2; /* uInt counts both */
    in = in < most ? in : most;
    n = n < most ? n : most;
    s->z.next_in = (z_const Bytef *)(uintptr_t)(s->raw + s->raw_begin);
    s->z.avail_in = (uInt)in;
    s->z.next_out = to;
    s->z.avail_out = (uInt)n;
    int z = inflate(&s->z, Z_NO_FLUSH);
    s->raw_begin += in - s->z.avail_in;
    *got = n - s->z.avail_out;
    if (z == Z_STREAM_END)
        s->in_member = false;
    else if (z == Z_MEM_ERROR)
        return il_fail_nomem(&s->failure);
    else if (z == Z_BUF_ERROR && in == 0)
        return fail_gzip(s, "the gzip stream is cut short");
    else if (z != Z_OK && z != Z_BUF_ERROR)
        return fail_gzip(s, "the gzip stream is damaged");
    return IL_OK;
}

static il_status read_gzip(il_source *s, unsigned char *to, size_t n, size_t *got)
{
    il_status st = IL_OK;
    while (st == IL_OK && *got == 0 && !s->ended)
        st = s->in_member ? inflate_some(s, to, n, got) : after_member(s);
    return st;
}

static il_status read_plain(il_source *s, unsigned char *to, size_t n, size_t *got)
{
    il_status st = fill_raw(s, 1);
    if (st != IL_OK)
        return st;
    size_t there = s->raw_end - s->raw_begin;
    *got = n < there ? n : there;
    if (*got > 0)
        memcpy(to, s->raw + s->raw_begin, *got);
    s->raw_begin += *got;
    s->ended = there == 0;
    return IL_OK;
}

/* Decoded bytes past those peeked at.  What came out before a failure is given
 * first; the failure is the next call's. */
static il_status read_decoded(il_source *s, unsigned char *to, size_t n, size_t *got)
{
    *got = 0;
    il_status st = s->failure.code;
    if (st == IL_OK && !s->begun)
        st = begin(s);
    if (st == IL_OK && n > 0 && !s->ended)
        st = s->gzip ? read_gzip(s, to, n, got) : read_plain(s, to, n, got);
    return *got > 0 ? IL_OK : st;
}

/* ---- what readers call ---------------------------------------------------- */

static il_status tell_failure(const il_source *s, il_error *err)
{
    if (err && err->code == IL_OK)
        *err = s->failure;
    return s->failure.code;
}

il_status il_source_read(il_source *s, void *buf, size_t n, size_t *got, il_error *err)
{
    size_t there = s->ahead_end - s->ahead_begin;
    if (there > 0) {
        *got = n < there ? n : there;
        memcpy(buf, s->ahead + s->ahead_begin, *got);
        s->ahead_begin += *got;
        return IL_OK;
    }
    return read_decoded(s, buf, n, got) == IL_OK ? IL_OK : tell_failure(s, err);
}

il_status il_source_load(il_source *s, unsigned char **bytes, size_t *n, il_error *err)
{
    size_t cap = 0, got = 1;
    il_status st = IL_OK;
    *bytes = NULL;
    *n = 0;
    while (st == IL_OK && got > 0) {
        st = il_grow(bytes, &cap, *n + BLOCK, 1) ? il_source_read(s, *bytes + *n, cap - *n, &got, err) : il_fail_nomem(err);
        *n += st == IL_OK ? got : 0;
    }
    if (st == IL_OK)
        return IL_OK;
    il_free(*bytes);
    *bytes = NULL;
    *n = 0;
    return st;
}

il_status il_source_peek(il_source *s, size_t n, const unsigned char **data, size_t *got, il_error *err)
{
    *data = NULL;
    *got = 0;
    if (!s->ahead && !(s->ahead = il_alloc(PEEK_MOST, 1)))
        return il_fail_nomem(err);
    if (s->ahead_begin > 0) {
        memmove(s->ahead, s->ahead + s->ahead_begin, s->ahead_end - s->ahead_begin);
        s->ahead_end -= s->ahead_begin;
        s->ahead_begin = 0;
    }
    size_t more = 1;
    while (more > 0 && s->ahead_end < n && s->ahead_end < PEEK_MOST) {
        if (read_decoded(s, s->ahead + s->ahead_end, PEEK_MOST - s->ahead_end, &more) != IL_OK)
            return tell_failure(s, err);
        s->ahead_end += more;
    }
    *data = s->ahead;
    *got = s->ahead_end;
    return IL_OK;
}
