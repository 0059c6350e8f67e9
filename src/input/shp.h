/* shp.h - what the files of the Shapefile reader share.
 *
 *     shp          the reader: features from records and rows
 *     shp-files    the .shp and the files beside it, into memory
 *     shp-index    where the records are; nothing leaves it that is not inside the file
 *     shp-hooks    shapelib on bytes in memory
 *     shp-table    the attributes of the .dbf
 *
 * shapelib believes much of what files say.  So records and tables are examined here
 * before shapelib sees them, and the .shx that it wants is made from what was found. */
#ifndef IL_INPUT_SHP_H
#define IL_INPUT_SHP_H

#include "input/codepage.h"
#include "input/map-set.h"

#include <shapefil.h>
#include <stdint.h>

/* Bytes of a file, and its name for errors; data is null when there is no such file. */
typedef struct il_shp_bytes {
    const unsigned char *data;
    size_t n;
    const char *name;
} il_shp_bytes;

typedef struct il_shp_files {
    il_shp_bytes shp, shx, dbf, prj, cpg;
} il_shp_files;

/* Read the features of F into SET. */
il_status il_shp_read(const il_shp_files *f, il_map_set *set, il_error *err);

/* Is NAME that of a file which belongs to a .shp and is not it? */
bool il_shp_is_part(const char *name);
il_status il_shp_fail_part(il_error *err);

/* ---- shp-files --------------------------------------------------------------- */

/* All of SOURCE, and of the files beside it by its name; free in any case. */
typedef struct il_shp_loaded {
    il_shp_files files;
    unsigned char *bytes[5];
    char *name[5];
} il_shp_loaded;

il_status il_shp_load(il_shp_loaded *l, il_source *source, il_error *err);
void il_shp_loaded_free(il_shp_loaded *l);

/* ---- shp-index --------------------------------------------------------------- */

/* A record: its content of N bytes begins at BEGIN of the .shp. */
typedef struct il_shp_record {
    size_t begin, n;
} il_shp_record;

/* n_ignored: bytes of the .shp behind what its header says is the end. */
typedef struct il_shp_index {
    il_shp_record *record;
    size_t n, cap, n_ignored;
} il_shp_index;

/* Find the records by the .shx, or, where there is none, one behind the other. */
il_status il_shp_index_make(il_shp_index *x, const il_shp_files *f, il_error *err);
void il_shp_index_free(il_shp_index *x);

/* Is all that the record I says it has inside of it, and are its parts in order?  Its
 * type is in *TYPE then. */
il_status il_shp_check_record(const il_shp_index *x, const il_shp_files *f, size_t i, int *type, il_error *err);

/* ---- shp-hooks --------------------------------------------------------------- */

/* What shapelib opens: a file, and where its next byte is read. */
typedef struct il_shp_cursor {
    il_shp_bytes file;
    size_t at;
} il_shp_cursor;

/* made: the .shx, from the index. */
typedef struct il_shp_memory {
    il_shp_cursor shp, shx, dbf;
    unsigned char *made;
} il_shp_memory;

il_status il_shp_memory_init(il_shp_memory *m, const il_shp_files *f, const il_shp_index *x, il_error *err);
void il_shp_memory_free(il_shp_memory *m);

/* Null when shapelib does not like it.  M must stay where it is while it is open. */
SHPHandle il_shp_open_shapes(il_shp_memory *m);
DBFHandle il_shp_open_table(il_shp_memory *m);

/* ---- shp-table --------------------------------------------------------------- */

/* A field of the table: its name in UTF-8. */
typedef struct il_shp_field {
    char *name;
    size_t n_name;
    bool is_wanted, is_text;
} il_shp_field;

/* n_rows, n_deleted.  dbf is null when there is no table. */
typedef struct il_shp_table {
    DBFHandle dbf;
    il_codepage page;
    il_shp_field *field;
    size_t n_fields, n_rows;
    bool has_told;              /* the names of fields that are not wanted */
} il_shp_table;

il_status il_shp_table_open(il_shp_table *t, const il_shp_files *f, il_shp_memory *m, il_map_set *set, il_error *err);
void il_shp_table_close(il_shp_table *t);

bool il_shp_row_is_deleted(il_shp_table *t, size_t row);
/* Tell SET the attributes of ROW. */
il_status il_shp_tell_row(il_shp_table *t, size_t row, il_map_set *set, il_error *err);

static inline uint32_t il_shp_big(const unsigned char *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static inline uint32_t il_shp_little(const unsigned char *p)
{
    return (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

#endif
