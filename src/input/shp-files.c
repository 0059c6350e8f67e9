/* shp-files.c - a .shp and the files that belong to it. */
#include "config.h"
#include "base/alloc.h"
#include "input/shp.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool ends_with(const char *name, size_t n, const char *end)
{
    size_t m = strlen(end);
    return n > m && strncasecmp(name + n - m, end, m) == 0;
}

static size_t without_gz(const char *name)
{
    size_t n = strlen(name);
    return ends_with(name, n, ".gz") ? n - 3 : n;
}

bool il_shp_is_part(const char *name)
{
    static const char *const ends[] = { ".dbf", ".shx", ".prj", ".cpg", ".sbn", ".sbx", ".qix", ".qpj", ".shp.xml" };
    size_t n = without_gz(name);
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++)
        if (ends_with(name, n, ends[k]))
            return true;
    return false;
}

il_status il_shp_fail_part(il_error *err)
{
    return il_fail(err, IL_E_INPUT, 0, "belongs to a shapefile: give its .shp alone, the others are found beside it");
}

/* Open what NAME becomes with EXTENSION in the place of its last N_OLD bytes; it is
 * *PATH then, to be freed. */
static il_status open_as(il_source **out, const char *name, size_t n, const char *extension, const char *gz, char **path,
                         il_error *err)
{
    size_t size = n + strlen(extension) + strlen(gz) + 1;
    *out = NULL;
    *path = il_alloc(size, 1);
    if (!*path)
        return il_fail_nomem(err);
    snprintf(*path, size, "%.*s%s%s", (int)n, name, extension, gz);
    il_status st = il_source_open_if_there(out, *path, err);
    if (!*out) {
        il_free(*path);
        *path = NULL;
    }
    return st;
}

/* The file with the extension that is LOWER, or UPPER, beside NAME of which N bytes
 * stand before its own; in the case of that first, compressed if that is. */
static il_status open_beside(il_source **out, const char *name, size_t n, const char *lower, const char *upper, char **path,
                             il_error *err)
{
    bool is_upper = name[n + 1] == 'S', is_gz = without_gz(name) < strlen(name);
    const char *extension[] = { is_upper ? upper : lower, is_upper ? lower : upper };
    const char *gz[] = { is_gz ? ".gz" : "", is_gz ? "" : ".gz" };
    il_status st = IL_OK;
    *out = NULL;
    *path = NULL;
    for (int k = 0; k < 4 && st == IL_OK && !*out; k++)
        st = open_as(out, name, n, extension[k % 2], gz[k / 2], path, err);
    return st;
}

static il_status load_beside(il_shp_loaded *l, int k, il_shp_bytes *to, const char *name, const char *lower, const char *upper,
                             il_error *err)
{
    size_t n = without_gz(name);
    il_source *source = NULL;
    if (!ends_with(name, n, ".shp"))
        return IL_OK;
    il_status st = open_beside(&source, name, n - 4, lower, upper, &l->name[k], err);
    if (st == IL_OK && source) {
        st = il_source_load(source, &l->bytes[k], &to->n, err);
        to->data = l->bytes[k];
        to->name = l->name[k];
    }
    il_source_close(source);
    return st;
}

il_status il_shp_load(il_shp_loaded *l, il_source *source, il_error *err)
{
    const char *name = il_source_name(source);
    il_shp_files *f = &l->files;
    *l = (il_shp_loaded){ .files.shp.name = name };
    il_status st = il_source_load(source, &l->bytes[0], &f->shp.n, err);
    f->shp.data = l->bytes[0];
    if (st == IL_OK)
        st = load_beside(l, 1, &f->shx, name, ".shx", ".SHX", err);
    if (st == IL_OK)
        st = load_beside(l, 2, &f->dbf, name, ".dbf", ".DBF", err);
    if (st == IL_OK)
        st = load_beside(l, 3, &f->prj, name, ".prj", ".PRJ", err);
    if (st == IL_OK)
        st = load_beside(l, 4, &f->cpg, name, ".cpg", ".CPG", err);
    return st;
}

void il_shp_loaded_free(il_shp_loaded *l)
{
    for (int k = 0; k < 5; k++) {
        il_free(l->bytes[k]);
        il_free(l->name[k]);
    }
    *l = (il_shp_loaded){ .name = { NULL } };
}
