/* shp.c - shapefiles (formats/shp.txt): features from records and rows. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "input/shp.h"

#include <math.h>
#include <string.h>

/* ---- shapes ------------------------------------------------------------------------ */

/* Below this a value says that there is none. */
#define NO_DATA (-1e38)

static il_status put_point(const SHPObject *o, bool has_z, int k, size_t number, il_map_set *set, il_error *err)
{
    double x = o->padfX[k], y = o->padfY[k], z = has_z && o->padfZ[k] > NO_DATA ? o->padfZ[k] : NAN;
    if (!isfinite(x) || !isfinite(y) || isinf(z))
        return il_fail(err, IL_E_INPUT, 0, "record %zu: a coordinate is no finite number", number);
    if (!(fabs(x) < IL_COORDINATE_BOUND) || !(fabs(y) < IL_COORDINATE_BOUND) || fabs(z) >= IL_COORDINATE_BOUND)
        return il_fail(err, IL_E_INPUT, 0, "record %zu: a coordinate is not below 1e15", number);
    return il_map_point(set, x, y, z, 0, err);
}

/* A shape with its parts, or the points of one each by itself. */
typedef struct kind { il_map_part part; bool has_z; } kind;

static kind kind_of(int type)
{
    switch (type) {
    case SHPT_ARC: case SHPT_ARCM:         return (kind){ IL_MAP_LINE, false };
    case SHPT_ARCZ:                        return (kind){ IL_MAP_LINE, true };
    case SHPT_POLYGON: case SHPT_POLYGONM: return (kind){ IL_MAP_RING, false };
    case SHPT_POLYGONZ:                    return (kind){ IL_MAP_RING, true };
    case SHPT_POINTZ: case SHPT_MULTIPOINTZ: return (kind){ IL_MAP_POINT, true };
    default:                               return (kind){ IL_MAP_POINT, false };
    }
}

static il_status put_part(const SHPObject *o, kind k, int begin, int end, size_t number, il_map_set *set, il_error *err)
{
    il_status st = il_map_begin_part(set, k.part, 0, err);
    for (int i = begin; i < end && st == IL_OK; i++)
        st = put_point(o, k.has_z, i, number, set, err);
    return st == IL_OK ? il_map_end_part(set, err) : st;
}

static il_status put_shape(const SHPObject *o, int type, size_t number, il_map_set *set, il_error *err)
{
    kind k = kind_of(type);
    bool is_points = k.part == IL_MAP_POINT;
    int n = is_points ? o->nVertices : o->nParts;
    il_status st = IL_OK;
    if (n == 0)
        il_map_skip(set, 0, "shape", "has no points");
    for (int i = 0; i < n && st == IL_OK; i++) {
        int begin = is_points ? i : o->panPartStart[i];
        int end = is_points ? i + 1 : i + 1 < n ? o->panPartStart[i + 1] : o->nVertices;
        st = put_part(o, k, begin, end, number, set, err);
    }
    return st;
}

/* ---- records ------------------------------------------------------------------------ */

typedef struct reading {
    const il_shp_files *files;
    il_map_set *set;
    il_shp_index index;
    il_shp_memory memory;
    il_shp_table table;
    SHPHandle shp;
    size_t n_shapes, n_with_z;
} reading;

static il_status read_shape(reading *r, size_t i, int type, il_error *err)
{
    SHPObject *o = SHPReadObject(r->shp, (int)i);
    if (!o)
        return il_fail(err, IL_E_INPUT, 0, "record %zu is none that can be read", i + 1);
    il_status st = il_map_begin_feature(r->set, 0, err);
    if (st == IL_OK)
        st = il_shp_tell_row(&r->table, i, r->set, err);
    if (st == IL_OK)
        st = put_shape(o, type, i + 1, r->set, err);
    SHPDestroyObject(o);
    r->n_shapes++;
    r->n_with_z += kind_of(type).has_z;
    return st == IL_OK ? il_map_end_feature(r->set, err) : st;
}

/* A record that is no shape is a feature all the same, so that those behind it keep
 * their numbers. */
static il_status leave_out(reading *r, const char *what, const char *why, il_error *err)
{
    il_map_skip(r->set, 0, what, why);
    il_status st = il_map_begin_feature(r->set, 0, err);
    return st == IL_OK ? il_map_end_feature(r->set, err) : st;
}

static il_status read_record(reading *r, size_t i, il_error *err)
{
    int type = SHPT_NULL;
    il_status st = il_shp_check_record(&r->index, r->files, i, &type, err);
    if (st != IL_OK)
        return st;
    if (il_shp_row_is_deleted(&r->table, i))
        return leave_out(r, "shape", "its row in the .dbf is deleted", err);
    if (type == SHPT_NULL)
        return leave_out(r, "shape", "is a null shape", err);
    if (type == SHPT_MULTIPATCH)
        return leave_out(r, "MultiPatch", "is a surface, no line", err);
    return read_shape(r, i, type, err);
}

/* Rows belong to records by their order, so that one more of either may have put all
 * of them out of step. */
static il_status check_counts(const reading *r, il_error *err)
{
    if (r->table.dbf && r->table.n_rows != r->index.n)
        return il_fail(err, IL_E_INPUT, 0, "has %zu records, and the .dbf beside it has %zu rows", r->index.n, r->table.n_rows);
    return IL_OK;
}

static il_status read_records(reading *r, il_error *err)
{
    il_status st = check_counts(r, err);
    if (st != IL_OK)
        return st;
    r->shp = il_shp_open_shapes(&r->memory);
    if (!r->shp)
        return il_fail(err, IL_E_INPUT, 0, "is no shapefile that can be read");
    for (size_t i = 0; i < r->index.n && st == IL_OK; i++)
        st = read_record(r, i, err);
    SHPClose(r->shp);
    return st;
}

/* Without a table heights can be z coordinates only. */
static il_status tell_missing_table(const reading *r, il_error *err)
{
    bool is_piped = strcmp(r->files->shp.name, "-") == 0;
    if (r->files->dbf.data)
        return IL_OK;
    if (r->n_shapes > 0 && r->n_with_z == 0)
        return il_fail(err, IL_E_INPUT, 0, is_piped ? "has no heights: its shapes have no z, and standard input brings no .dbf; "
                                                      "give the path of the .shp, beside which it is found"
                                                    : "has no heights: its shapes have no z, and there is no .dbf beside it");
    il_report_note(il_map_report(r->set), "%s: there are no attributes",
                   is_piped ? "standard input brings a .shp without its .dbf" : "no .dbf beside the .shp");
    return IL_OK;
}

static il_status tell(const reading *r, il_error *err)
{
    if (r->index.n_ignored > 0)
        il_report_note(il_map_report(r->set), "%zu bytes behind the end that the header of the .shp states are not read",
                       r->index.n_ignored);
    return tell_missing_table(r, err);
}

/* Text of the .prj without what may follow it; names in it may be in any code page. */
static il_status take_crs(const reading *r, il_error *err)
{
    const il_shp_bytes *prj = &r->files->prj;
    il_codepage page = IL_CODEPAGE_INIT;
    const char *given = (const char *)prj->data, *nul = given ? memchr(given, 0, prj->n) : NULL;
    size_t n = nul ? (size_t)(nul - given) : prj->n;
    char *text = NULL;
    while (n > 0 && (given[n - 1] == ' ' || given[n - 1] == '\n' || given[n - 1] == '\r' || given[n - 1] == '\t'))
        n--;
    il_status st = given ? il_codepage_text(&page, given, n, &text, &n, err) : IL_OK;
    if (st == IL_OK && text)
        st = il_map_crs(r->set, text, n, 0, err);
    if (st == IL_E_INPUT)
        il_error_set_file(err, prj->name);
    il_free(text);
    return st;
}

il_status il_shp_read(const il_shp_files *f, il_map_set *set, il_error *err)
{
    reading r = { .files = f, .set = set };
    il_status st = il_shp_index_make(&r.index, f, err);
    if (st == IL_OK)
        st = il_shp_memory_init(&r.memory, f, &r.index, err);
    if (st == IL_OK)
        st = il_shp_table_open(&r.table, f, &r.memory, set, err);
    if (st == IL_OK)
        st = take_crs(&r, err);
    if (st == IL_OK)
        st = read_records(&r, err);
    if (st == IL_OK)
        st = tell(&r, err);
    il_shp_table_close(&r.table);
    il_shp_memory_free(&r.memory);
    il_shp_index_free(&r.index);
    return st;
}

/* ---- the reader ------------------------------------------------------------------------ */

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_shp_loaded l;
    (void)options;
    if (il_shp_is_part(il_source_name(source)))
        return il_shp_fail_part(err);
    il_status st = il_shp_load(&l, source, err);
    if (st == IL_OK)
        st = il_shp_read(&l.files, set, err);
    il_shp_loaded_free(&l);
    return st;
}

static il_status read_shp(il_source *const *source, size_t n, const il_read_options *options, il_sink *sink,
                          il_report *report, il_error *err)
{
    return il_map_read("Shapefile", parse, source, n, options, sink, report, err);
}

static bool probe(const unsigned char *head, size_t n)
{
    return n >= 4 && memcmp(head, "\0\0\x27\x0A", 4) == 0;
}

const il_reader il_reader_shp = {
    .name = "shp",
    .extensions = "shp",
    .words = "Shapefiles, with the .dbf and .prj beside them",
    .is_map = true,
    .probe = probe,
    .read = read_shp,
};
