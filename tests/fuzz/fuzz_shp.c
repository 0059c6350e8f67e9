/* fuzz_shp.c - shapefiles, as map.h has it: bytes that are a .shp, and behind marks the
 * .dbf, the .shx, the .prj and the .cpg that belong to it. */
#include "config.h"
#include "base/alloc.h"
#include "input/shp.h"
#include "map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static const char MARK[] = "<<<<>>>>";

enum { LENGTH = sizeof MARK - 1, FILES = 5 };

/* Where the next mark stands in the N bytes at P, or their end. */
static const unsigned char *find_mark(const unsigned char *p, size_t n)
{
    for (size_t i = 0; i + LENGTH <= n; i++)
        if (p[i] == '<' && memcmp(p + i, MARK, LENGTH) == 0)
            return p + i;
    return p + n;
}

/* Each file has a block of its own, so that reading beyond it is seen; an empty one
 * is not there. */
static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_shp_files f = { .shp = { NULL, 0, "a.shp" } };
    il_shp_bytes *const file[FILES] = { &f.shp, &f.dbf, &f.shx, &f.prj, &f.cpg };
    static const char *const names[FILES] = { "a.shp", "a.dbf", "a.shx", "a.prj", "a.cpg" };
    unsigned char *all, *copy[FILES] = { NULL };
    size_t n;
    (void)options;
    il_status st = il_source_load(source, &all, &n, err);
    const unsigned char *p = all, *end = all + n;
    for (int k = 0; k < FILES && st == IL_OK && p; k++) {
        const unsigned char *mark = find_mark(p, (size_t)(end - p));
        *file[k] = (il_shp_bytes){ NULL, (size_t)(mark - p), names[k] };
        copy[k] = il_alloc(file[k]->n, 1);
        must(copy[k] != NULL, "no memory");
        memcpy(copy[k], p, file[k]->n);
        file[k]->data = k == 0 || file[k]->n > 0 ? copy[k] : NULL;
        p = mark < end ? mark + LENGTH : NULL;
    }
    if (st == IL_OK)
        st = il_shp_read(&f, set, err);
    for (int k = 0; k < FILES; k++)
        il_free(copy[k]);
    il_free(all);
    return st;
}

static il_status read_files(il_source *const *source, size_t n, const il_read_options *options, il_sink *sink,
                            il_report *report, il_error *err)
{
    return il_map_read("Shapefile", parse, source, n, options, sink, report, err);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    static const il_reader reader = { .name = "shp", .is_map = true, .read = read_files };
    return fuzz_map(&reader, data, n);
}
