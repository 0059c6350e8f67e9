/* shp-index.c - where the records of a .shp are, and what they may say.
 *
 * "ESRI Shapefile Technical Description", July 1998.  Lengths and offsets there are
 * in words of two bytes; records count from 1. */
#include "config.h"
#include "base/alloc.h"
#include "input/shp.h"

#include <string.h>

enum { HEADER = 100, RECORD_HEADER = 8, ENTRY = 8 };

/* As many as shapelib takes. */
enum { RECORDS_MOST = 256 * 1000 * 1000 };

static const uint64_t SIZE_MOST = UINT64_C(0xFFFFFFFF);

static bool has_magic(const il_shp_bytes *f)
{
    return f->n >= 4 && memcmp(f->data, "\0\0\x27\x0A", 4) == 0;
}

/* The length of a file of this family as its header says; the file is that long. */
static il_status check_header(const il_shp_bytes *f, uint64_t *length, il_error *err)
{
    if (!has_magic(f))
        return il_fail(err, IL_E_INPUT, 0, "does not begin as a shapefile does");
    *length = f->n >= HEADER ? 2 * (uint64_t)il_shp_big(f->data + 24) : HEADER;
    if (f->n < HEADER || f->n < *length)
        return il_fail(err, IL_E_INPUT, 0, "is cut short: its header says that it has %llu bytes, and there are %zu",
                       (unsigned long long)*length, f->n);
    if (*length < HEADER)
        return il_fail(err, IL_E_INPUT, 0, "has a header that says it has %llu bytes, fewer than the header itself",
                       (unsigned long long)*length);
    if (il_shp_little(f->data + 28) != 1000)
        return il_fail(err, IL_E_INPUT, 0, "is of version %u, and there is 1000 only", (unsigned)il_shp_little(f->data + 28));
    return IL_OK;
}

static il_status add(il_shp_index *x, uint64_t at, const il_shp_bytes *shp, uint64_t end, il_error *err)
{
    if (x->n >= RECORDS_MOST)
        return il_fail(err, IL_E_INPUT, 0, "more than %d records", RECORDS_MOST);
    if (at < HEADER || at + RECORD_HEADER > end)
        return il_fail(err, IL_E_INPUT, 0, "record %zu would begin at byte %llu, and the file ends at %llu", x->n + 1,
                       (unsigned long long)at, (unsigned long long)end);
    uint64_t n = 2 * (uint64_t)il_shp_big(shp->data + at + 4);
    if (n < 4 || n > end - at - RECORD_HEADER)
        return il_fail(err, IL_E_INPUT, 0, "record %zu says that it has %llu bytes, and the file has %llu for it", x->n + 1,
                       (unsigned long long)n, (unsigned long long)(end - at - RECORD_HEADER));
    if (x->n == x->cap && !il_grow(&x->record, &x->cap, x->n + 1, sizeof *x->record))
        return il_fail_nomem(err);
    x->record[x->n++] = (il_shp_record){ (size_t)at + RECORD_HEADER, (size_t)n };
    return IL_OK;
}

/* Records that were written anew may stand anywhere, and what they were before is
 * still in the file: the .shx alone knows. */
static il_status follow_index(il_shp_index *x, const il_shp_files *f, il_error *err)
{
    uint64_t length;
    il_status st = check_header(&f->shx, &length, err);
    if (st != IL_OK)
        il_error_set_file(err, f->shx.name);
    for (uint64_t k = HEADER; st == IL_OK && k + ENTRY <= length; k += ENTRY)
        st = add(x, 2 * (uint64_t)il_shp_big(f->shx.data + k), &f->shp, f->shp.n, err);
    return st;
}

static il_status follow_records(il_shp_index *x, const il_shp_bytes *shp, uint64_t length, il_error *err)
{
    il_status st = IL_OK;
    for (uint64_t at = HEADER; st == IL_OK && at < length;) {
        st = add(x, at, shp, length, err);
        at = st == IL_OK ? x->record[x->n - 1].begin + x->record[x->n - 1].n : length;
    }
    x->n_ignored = shp->n - (size_t)length;
    return st;
}

il_status il_shp_index_make(il_shp_index *x, const il_shp_files *f, il_error *err)
{
    uint64_t length = 0;
    *x = (il_shp_index){ NULL, 0, 0, 0 };
    if (f->shp.n > SIZE_MOST)
        return il_fail(err, IL_E_INPUT, 0, "has more than 4 GB");
    il_status st = check_header(&f->shp, &length, err);
    if (st != IL_OK)
        return st;
    return f->shx.data ? follow_index(x, f, err) : follow_records(x, &f->shp, length, err);
}

void il_shp_index_free(il_shp_index *x)
{
    il_free(x->record);
    *x = (il_shp_index){ NULL, 0, 0, 0 };
}

/* ---- what a record says ------------------------------------------------------------ */

/* begin: where parts and points begin, behind type and box; has_parts: and their
 * counts.  z: bytes of the range of z and of each z. */
typedef struct layout {
    int type;
    size_t head;
    bool has_parts, has_count;
    size_t z_range, z_each;
} layout;

static const layout layouts[] = {
    { SHPT_NULL, 4, false, false, 0, 0 },
    { SHPT_POINT, 20, false, false, 0, 0 },
    { SHPT_POINTZ, 28, false, false, 0, 0 }, /* its M may be missing */
    { SHPT_POINTM, 28, false, false, 0, 0 },
    { SHPT_MULTIPOINT, 36, false, true, 0, 0 },
    { SHPT_MULTIPOINTZ, 36, false, true, 16, 8 },
    { SHPT_MULTIPOINTM, 36, false, true, 0, 0 },
    { SHPT_ARC, 36, true, true, 0, 0 },
    { SHPT_ARCZ, 36, true, true, 16, 8 },
    { SHPT_ARCM, 36, true, true, 0, 0 },
    { SHPT_POLYGON, 36, true, true, 0, 0 },
    { SHPT_POLYGONZ, 36, true, true, 16, 8 },
    { SHPT_POLYGONM, 36, true, true, 0, 0 },
    { SHPT_MULTIPATCH, 4, false, false, 0, 0 }, /* not read */
};

static const layout *find_layout(uint32_t type)
{
    for (size_t k = 0; k < sizeof layouts / sizeof *layouts; k++)
        if ((uint32_t)layouts[k].type == type)
            return &layouts[k];
    return NULL;
}

/* The table P of where N parts begin among the points: from 0, rising, inside. */
static il_status check_parts(const unsigned char *p, uint32_t n, uint32_t n_points, size_t number, il_error *err)
{
    if (n == 0 && n_points > 0)
        return il_fail(err, IL_E_INPUT, 0, "record %zu has %u points and no parts", number, (unsigned)n_points);
    for (uint32_t k = 0; k < n; k++) {
        uint32_t begin = il_shp_little(p + 4 * (size_t)k), before = k > 0 ? il_shp_little(p + 4 * (size_t)(k - 1)) : 0;
        if (begin >= n_points || (k == 0 ? begin != 0 : begin <= before))
            return il_fail(err, IL_E_INPUT, 0, "record %zu: its parts are out of order, for part %u begins behind %u of %u points",
                           number, (unsigned)k + 1, (unsigned)begin, (unsigned)n_points);
    }
    return IL_OK;
}

il_status il_shp_check_record(const il_shp_index *x, const il_shp_files *f, size_t i, int *type, il_error *err)
{
    const il_shp_record *r = &x->record[i];
    const unsigned char *p = f->shp.data + r->begin;
    const layout *l = find_layout(il_shp_little(p));
    if (!l)
        return il_fail(err, IL_E_INPUT, 0, "record %zu has the shape type %u, which is none", i + 1, (unsigned)il_shp_little(p));
    *type = l->type;
    uint64_t need = l->head + (l->has_count ? 4u : 0u) + (l->has_parts ? 4u : 0u);
    uint32_t n_parts = 0, n_points = 0;
    if (r->n >= need && l->has_count) {
        n_parts = l->has_parts ? il_shp_little(p + l->head) : 0;
        n_points = il_shp_little(p + l->head + (l->has_parts ? 4 : 0));
        need += 4 * (uint64_t)n_parts + (16 + l->z_each) * (uint64_t)n_points + l->z_range;
    }
    if (r->n < need)
        return il_fail(err, IL_E_INPUT, 0, "record %zu has %zu bytes, and what it holds takes %llu", i + 1, r->n,
                       (unsigned long long)need);
    return l->has_parts ? check_parts(p + l->head + 8, n_parts, n_points, i + 1, err) : IL_OK;
}
