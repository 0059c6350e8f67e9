/* output.c - buffering, numbers, and the first failure kept. */
#include "config.h"
#include "base/output-private.h"
#include "base/alloc.h"
#include "base/descriptor.h"
#include "base/number.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

il_status il_output_new(il_output **out, il_output_kind kind, const char *path, size_t cap, il_error *err)
{
    *out = NULL;
    il_output *o = il_calloc(1, sizeof *o);
    if (!o)
        return il_fail_nomem(err);
    o->kind = kind;
    o->fd = -1;
    o->path = il_strndup(path, strlen(path));
    o->buf = il_alloc(cap, 1);
    o->cap = cap;
    if (!o->path || !o->buf) {
        il_output_discard(o);
        return il_fail_nomem(err);
    }
    *out = o;
    return IL_OK;
}

il_status il_output_to_memory(il_output **out, il_error *err)
{
    return il_output_new(out, IL_OUTPUT_MEMORY, "memory", 256, err);
}

const unsigned char *il_output_memory(const il_output *o, size_t *n)
{
    *n = o->used;
    return o->buf;
}

bool il_output_is_terminal(const il_output *o)
{
    return o->fd >= 0 && isatty(o->fd);
}

const char *il_output_file_path(const il_output *o)
{
    return o->kind == IL_OUTPUT_REPLACED ? o->path : NULL;
}

void il_output_also(il_output *o, il_output *beside)
{
    o->beside = beside;
}

uint64_t il_output_bytes(const il_output *o)
{
    return o->bytes;
}

il_status il_output_status(const il_output *o, il_error *err)
{
    if (err && err->code == IL_OK)
        *err = o->failure;
    return o->failure.code;
}

/* ---- bytes ---------------------------------------------------------------- */

static bool have_file(il_output *o)
{
    if (o->fd >= 0)
        return true;
    return o->kind == IL_OUTPUT_SPOOL ? il_output_make_spool_file(o) : il_output_make_temporary(o);
}

static void write_through(il_output *o, const void *data, size_t n)
{
    if (have_file(o) && !il_descriptor_write(o->fd, data, n))
        il_fail_system(&o->failure, o->path, "cannot write", errno);
}

void il_output_empty_buffer(il_output *o)
{
    if (o->failure.code != IL_OK || o->used == 0)
        return;
    write_through(o, o->buf, o->used);
    o->used = 0;
}

static void write_memory(il_output *o, const void *data, size_t n)
{
    size_t need = n <= SIZE_MAX - o->used ? o->used + n : SIZE_MAX;
    if (!il_grow(&o->buf, &o->cap, need, 1)) {
        il_fail_nomem(&o->failure);
        return;
    }
    memcpy(o->buf + o->used, data, n);
    o->used += n;
}

void il_output_write(il_output *o, const void *data, size_t n)
{
    if (n == 0 || o->failure.code != IL_OK)
        return;
    if (o->kind == IL_OUTPUT_MEMORY) {
        write_memory(o, data, n);
    } else {
        if (n > o->cap - o->used)
            il_output_empty_buffer(o);
        if (n >= o->cap) {
            write_through(o, data, n);
        } else {
            memcpy(o->buf + o->used, data, n);
            o->used += n;
        }
    }
    if (o->failure.code == IL_OK)
        o->bytes += n;
}

il_status il_output_flush(il_output *o, il_error *err)
{
    if (o->kind == IL_OUTPUT_IN_PLACE || o->kind == IL_OUTPUT_REPLACED)
        il_output_empty_buffer(o);
    return il_output_status(o, err);
}

/* ---- text and numbers ----------------------------------------------------- */

void il_output_string(il_output *o, const char *s)
{
    il_output_write(o, s, strlen(s));
}

void il_output_char(il_output *o, char c)
{
    il_output_write(o, &c, 1);
}

void il_output_number(il_output *o, double value)
{
    char text[IL_NUMBER_MAX];
    il_output_write(o, text, il_number_format(text, value));
}

void il_output_float(il_output *o, float value)
{
    char text[IL_NUMBER_MAX];
    il_output_write(o, text, il_number_format_float(text, value));
}

void il_output_integer(il_output *o, long long value)
{
    char text[24], *p = text + sizeof text;
    unsigned long long rest = value < 0 ? 0 - (unsigned long long)value : (unsigned long long)value;
    do
        *--p = (char)('0' + rest % 10);
    while (rest /= 10);
    if (value < 0)
        *--p = '-';
    il_output_write(o, p, (size_t)(text + sizeof text - p));
}

void il_output_u32le(il_output *o, uint32_t v)
{
    unsigned char b[4];
    for (int i = 0; i < 4; i++)
        b[i] = (unsigned char)(v >> 8 * i);
    il_output_write(o, b, sizeof b);
}

void il_output_f32le(il_output *o, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    il_output_u32le(o, bits);
}

void il_output_f64le(il_output *o, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    il_output_u32le(o, (uint32_t)bits);
    il_output_u32le(o, (uint32_t)(bits >> 32));
}
