/* shp-hooks.c - files for shapelib that are bytes in memory.
 *
 * shapelib opens files by their names and hands its hooks nothing else.  So the name
 * that it gets is the address of the bytes' structure, written out: no table of open
 * files is needed, which would be global. */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/shp.h"

#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 2 * sizeof(uintptr_t) + 8 };

static void make_name(char *name, il_shp_memory *m)
{
    snprintf(name, NAME_SIZE, "%0*jx.shp", (int)(2 * sizeof(uintptr_t)), (uintmax_t)(uintptr_t)m);
}

/* Only names of make_name arrive here, with the extension that shapelib wants. */
static SAFile on_open(const char *name, const char *access)
{
    uintptr_t address = 0;
    const char *p = name;
    (void)access;
    for (; il_hex_digit(*p) >= 0; p++)
        address = 16 * address + (uintptr_t)il_hex_digit(*p);
    il_shp_memory *m = (il_shp_memory *)address;
    il_shp_cursor *c = strcmp(p, ".shp") == 0 ? &m->shp : strcmp(p, ".shx") == 0 ? &m->shx
                       : strcmp(p, ".dbf") == 0 ? &m->dbf : NULL;
    if (c)
        c->at = 0;
    return (SAFile)(void *)c;
}

static SAOffset on_read(void *to, SAOffset size, SAOffset n, SAFile file)
{
    il_shp_cursor *c = (il_shp_cursor *)(void *)file;
    size_t left = c->file.n - c->at, whole = size > 0 ? left / size : 0;
    whole = whole < n ? whole : n;
    if (whole > 0)
        memcpy(to, c->file.data + c->at, whole * size);
    c->at += whole * size;
    return whole;
}

static SAOffset on_write(void *from, SAOffset size, SAOffset n, SAFile file)
{
    (void)from, (void)size, (void)n, (void)file;
    return 0;
}

/* 0 for what is inside the file. */
static SAOffset on_seek(SAFile file, SAOffset offset, int whence)
{
    il_shp_cursor *c = (il_shp_cursor *)(void *)file;
    size_t from = whence == SEEK_END ? c->file.n : whence == SEEK_CUR ? c->at : 0;
    if (offset > c->file.n - from)
        return 1;
    c->at = from + offset;
    return 0;
}

static SAOffset on_tell(SAFile file)
{
    return ((il_shp_cursor *)(void *)file)->at;
}

/* Flushing and closing. */
static int on_nothing(SAFile file)
{
    (void)file;
    return 0;
}

/* It would go to stderr; the failure shows in what is returned. */
static void on_error(const char *message)
{
    (void)message;
}

static SAHooks make_hooks(void)
{
    return (SAHooks){ .FOpen = on_open, .FRead = on_read, .FWrite = on_write, .FSeek = on_seek, .FTell = on_tell,
                      .FFlush = on_nothing, .FClose = on_nothing, .Error = on_error };
}

SHPHandle il_shp_open_shapes(il_shp_memory *m)
{
    char name[NAME_SIZE];
    SAHooks hooks = make_hooks();
    make_name(name, m);
    SHPHandle shp = SHPOpenLL(name, "rb", &hooks);
    if (shp)
        SHPSetFastModeReadObject(shp, 1); /* one buffer for all shapes */
    return shp;
}

DBFHandle il_shp_open_table(il_shp_memory *m)
{
    char name[NAME_SIZE];
    SAHooks hooks = make_hooks();
    make_name(name, m);
    return DBFOpenLL(name, "rb", &hooks);
}

/* ---- the .shx ------------------------------------------------------------------------- */

enum { HEADER = 100, RECORD_HEADER = 8, ENTRY = 8 };

static void put_big(unsigned char *to, uint64_t value)
{
    for (int k = 3; k >= 0; k--, value >>= 8)
        to[k] = (unsigned char)value;
}

/* Offsets are even: an index holds words of two bytes. */
il_status il_shp_memory_init(il_shp_memory *m, const il_shp_files *f, const il_shp_index *x, il_error *err)
{
    size_t n = HEADER + ENTRY * x->n;
    *m = (il_shp_memory){ .shp.file = f->shp, .dbf.file = f->dbf, .made = il_alloc(n, 1) };
    if (!m->made)
        return il_fail_nomem(err);
    memcpy(m->made, f->shp.data, HEADER);
    put_big(m->made + 24, n / 2);
    for (size_t i = 0; i < x->n; i++) {
        put_big(m->made + HEADER + ENTRY * i, (x->record[i].begin - RECORD_HEADER) / 2);
        put_big(m->made + HEADER + ENTRY * i + 4, x->record[i].n / 2);
    }
    m->shx.file = (il_shp_bytes){ m->made, n, "shx" };
    return IL_OK;
}

void il_shp_memory_free(il_shp_memory *m)
{
    il_free(m->made);
    m->made = NULL;
}
