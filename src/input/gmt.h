/* gmt.h - what the parts of the reader of GMT's tables share. */
#ifndef IL_INPUT_GMT_H
#define IL_INPUT_GMT_H

#include "input/map-heads.h"
#include "input/map-rows.h"
#include "input/map-text.h"

/* What the lines "# @..." of OGR/GMT say.  is_ogr: "@VGMT" was there.  part: of what kind
 * segments are.  heads: names of attributes (@N).  crs: what @J says in each of its
 * forms, null or owned; it is settled once, as they are one system in several words. */
typedef struct il_gmt_ogr {
    bool is_ogr, has_told;
    il_map_part part;
    il_map_heads heads;
    char *crs[3];
    long crs_line;
    char *text;                 size_t cap; /* scratch */
} il_gmt_ogr;

/* begun: a segment has been marked, so that rows go straight to the set; before that they
 * are held.  has_rows: a row was there.  fresh: the feature at hand has no rows and no
 * attributes yet. */
typedef struct il_gmt {
    il_map_set *set;
    il_lines lines;
    il_map_rows rows;
    il_gmt_ogr ogr;
    bool begun, has_rows, in_feature, in_part, fresh, broken;
    il_error *err;
} il_gmt;

/* Take the comment T, behind its #. */
il_status il_gmt_comment(il_gmt *g, il_map_text t);

/* All of the head of the file is known: tell its coordinate system. */
il_status il_gmt_settle_crs(il_gmt *g);
void il_gmt_ogr_free(il_gmt_ogr *o);

/* From here on rows belong to segments, and what was said before is all of the head. */
il_status il_gmt_begin_segments(il_gmt *g);

/* End the feature at hand, and begin one in LINE. */
il_status il_gmt_next_feature(il_gmt *g, long line);

/* What the header T of a segment says of its height: the values of -Z and -L and a
 * number that it begins with; null where it does not say. */
enum { IL_GMT_Z, IL_GMT_L, IL_GMT_NUMBER, IL_GMT_N_PLACES };
typedef struct il_gmt_header {
    const char *value[IL_GMT_N_PLACES];
    size_t n[IL_GMT_N_PLACES];
} il_gmt_header;

/* True when it says anything. */
bool il_gmt_header_read(il_map_text t, il_gmt_header *h);
il_status il_gmt_header_tell(const il_gmt_header *h, il_map_set *set, il_error *err);

#endif
