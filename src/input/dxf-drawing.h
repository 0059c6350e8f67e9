/* dxf-drawing.h - what is known of a DXF file while it is read.
 *
 * The pairs of an entity that matter are kept as groups, numbers with their codes:
 * one entity at a time of the section ENTITIES, all of them of BLOCKS, because INSERT
 * may draw them many times.
 *     dxf          sections, header, tables, blocks
 *     dxf-scan     pairs
 *     dxf-entity   pairs to groups
 *     dxf-draw     groups to parts of the map
 *     dxf-insert   blocks in their places
 *     dxf-layer    names of layers */
#ifndef IL_INPUT_DXF_DRAWING_H
#define IL_INPUT_DXF_DRAWING_H

#include "input/affine.h"
#include "input/curve.h"
#include "input/dxf-layer.h"
#include "input/dxf-scan.h"

typedef enum il_dxf_kind {
    IL_DXF_OTHER, IL_DXF_ARC, IL_DXF_CIRCLE, IL_DXF_ELLIPSE, IL_DXF_INSERT, IL_DXF_LINE, IL_DXF_LWPOLYLINE, IL_DXF_POINT,
    IL_DXF_POLYLINE, IL_DXF_SPLINE
} il_dxf_kind;

/* The vertices of a POLYLINE follow its own groups, each behind a group of code 0.
 * line: counted from the entity's. */
typedef struct il_dxf_group {
    double value;
    int32_t code;
    uint32_t line;
} il_dxf_group;

/* begin, n: its groups.  name: its type, for reports, a word of `types`; block: what
 * INSERT draws. */
typedef struct il_dxf_entity {
    il_dxf_kind kind;
    uint32_t name, layer, block;
    bool is_paper, is_hidden;
    long line;
    size_t begin, n;
} il_dxf_entity;

/* x, y, z: what is put on the point of an INSERT.  begin, n: its entities.
 * n_definitions: 0 while it is only spoken of. */
typedef struct il_dxf_block {
    double x, y, z;
    size_t begin, n, n_definitions;
    bool is_open;               /* being drawn */
} il_dxf_block;

/* Where a drawing lies: xy and z' = z_scale z + z_shift. */
typedef struct il_dxf_place {
    il_affine xy;
    double z_scale, z_shift;
} il_dxf_place;

#define IL_DXF_PLACE_IDENTITY { IL_AFFINE_IDENTITY, 1, 0 }

/* group: of the blocks' entities, and of the entity at hand behind them.  work: for
 * splines.  n_curved: points that were put on curves; n_fit: splines that had only
 * points to pass through; n_inserted, depth: of blocks, against hostile ones. */
typedef struct il_dxf {
    il_dxf_scan scan;
    il_map_set *set;
    const il_read_options *options;
    il_dxf_layers layers;
    il_dictionary types, block_names;
    il_dxf_group *group;
    size_t n_groups, cap_groups;
    il_dxf_entity *entity;      /* of blocks */
    size_t n_entities, cap_entities;
    il_dxf_block *block;        /* by the number of its name */
    size_t n_blocks, cap_blocks;
    double *work;
    size_t cap_work;
    size_t n_curved, n_fit, n_inserted, depth;
    bool has_entities;
} il_dxf;

/* Read the entity that the pair at hand begins, up to the pair that begins the next
 * one; its groups are added to those of D. */
il_status il_dxf_read_entity(il_dxf *d, il_dxf_entity *e, il_error *err);

/* The number of the block called S[0..N), new or not. */
il_status il_dxf_find_block(il_dxf *d, const char *s, size_t n, uint32_t *index, il_error *err);

/* Hand what E draws at PLACE to the map, or count it as left out. */
il_status il_dxf_draw(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err);

/* ---- for the files that draw --------------------------------------------------- */

/* The first group CODE of E before its vertices, or OTHERWISE. */
double il_dxf_value(const il_dxf *d, const il_dxf_entity *e, int code, double otherwise);

/* The same as a whole number from 0 to 2^31, for flags and counts. */
il_status il_dxf_whole(const il_dxf *d, const il_dxf_entity *e, int code, unsigned long *value, il_error *err);

/* PLACE for what is given in coordinates of the entity's own plane (groups 210, 220,
 * 230); false when that is tilted, which has been counted. */
bool il_dxf_own_place(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_dxf_place *own);

/* E is left out; WHY. */
void il_dxf_skip(il_dxf *d, const il_dxf_entity *e, const char *why);

/* Put what the file gives as (X, Y, Z) in its group G into the part at hand. */
il_status il_dxf_put(il_dxf *d, const il_dxf_place *place, double x, double y, double z, long line, il_error *err);

/* The tolerance for a curve of the size SIZE, drawn at PLACE. */
double il_dxf_flatness(const il_dxf *d, double size);

il_status il_dxf_draw_spline(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err);
il_status il_dxf_draw_insert(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err);

#endif
