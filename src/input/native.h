/* native.h - the native reader's state, shared by its files and by no others.
 *
 * Every line is a keyword or a row of numbers.  A keyword names the record that
 * it must stand in; the records open inside that one are closed first, inner to
 * outer, and closing is where counts are compared and slices handed on. */
#ifndef IL_INPUT_NATIVE_H
#define IL_INPUT_NATIVE_H

#include "input/native-scan.h"
#include "input/reader.h"

/* The record that is open; each stands in the one that il_native_parent names. */
typedef enum il_native_record {
    IL_IN_STREAM, IL_IN_STACK, IL_IN_HEAD, IL_IN_SLICE, IL_IN_RING,
    IL_IN_PAIR, IL_IN_GROUP, IL_IN_LATTICE, IL_IN_PHI, IL_IN_CUT, IL_IN_GAP
} il_native_record;

/* What a pair record needs to know of a slice that was handed on: the number of
 * vertices of each ring, and the group each is in, from 1; 0 for none. */
typedef struct il_native_shape {
    uint32_t *vertices, *group;
    size_t n, cap_vertices, cap_group;
    bool in_order, all_rings;       /* canonical order; closed, 3 vertices or more */
} il_native_shape;

typedef struct il_native {
    il_lines lines;
    il_scan at;                     /* the current line */
    const il_read_options *options;
    il_sink *sink;
    il_report *report;
    il_error *err;
    il_native_record in;
    char version[24];               /* as the stream gives it */
    bool has_unit, ended;
    il_unit unit;

    il_stack_head head;
    unsigned seen;                  /* header lines: bits in order of the keyword table */
    long geographic_line, projection_line; /* where they stand in the header, 0: nowhere */
    il_extra **extra;               /* where the open record's next x- line goes */

    const char *name;               /* of the source */

    il_slice slice;
    bool holds_slice;               /* SLICE was not handed on yet */
    bool pair_done;                 /* the last slice has its pair or gap record */
    size_t slices;                  /* of this stack so far */
    size_t points;                  /* vertices of this stack so far */
    double z;                       /* of the last slice */
    il_extra **slice_extra;
    bool counted, marked;           /* ring: a count was given; marks came */
    uint32_t count;
    il_native_shape lower, upper;   /* of the last two slices handed on */

    il_pair pair;
    bool has_matcher;
    unsigned group_seen;
    long group_line, rows_line;     /* where the open group, lattice, phi or cut began */
    size_t rows;                    /* of the pair record */
    uint32_t phi_rings;             /* phi blocks begun */
} il_native;

/* One keyword: the record it stands in, and what takes the rest of its line. */
typedef struct il_native_keyword {
    const char *word;
    il_native_record in;
    il_status (*take)(il_native *n);
} il_native_keyword;

/* Null-terminated tables. */
extern const il_native_keyword il_native_stack_keywords[], il_native_slice_keywords[], il_native_pair_keywords[],
    il_native_group_keywords[];

/* Rows of numbers, and what is to be done when a record closes. */
il_status il_native_take_vertex(il_native *n);
il_status il_native_close_head(il_native *n);
il_status il_native_close_stack(il_native *n);
il_status il_native_close_ring(il_native *n);
il_status il_native_flush_slice(il_native *n);  /* hand a held slice on */

/* Maps that were in degrees. */
il_status il_native_take_geographic(il_native *n);
il_status il_native_take_projection(il_native *n);
il_status il_native_check_geographic(il_native *n);  /* when the header closes */

il_status il_native_take_lattice_row(il_native *n);
il_status il_native_take_phi_row(il_native *n);
il_status il_native_take_cut_row(il_native *n);
il_status il_native_close_lattice(il_native *n);
il_status il_native_close_phi(il_native *n);
il_status il_native_close_cut(il_native *n);
il_status il_native_close_group(il_native *n);
il_status il_native_close_pair(il_native *n);
il_status il_native_close_gap(il_native *n);

/* What the lines of a pair have in common.  The first one is its matcher, on which
 * the others rely; that of WORD has a meaning for ffd alone. */
il_status il_native_need_matcher(il_native *n);
il_status il_native_need_ffd(il_native *n, const char *word);
il_status il_native_count_row(il_native *n);    /* rows are held until the record ends */
il_status il_native_ring_exists(il_native *n, const il_native_shape *s, uint32_t ring);
il_status il_native_take_distance(il_native *n, double *v);

/* IL_E_INPUT at the current line, and IL_E_NOMEM. */
#define il_native_fail(n, ...) il_fail((n)->err, IL_E_INPUT, (n)->at.line, __VA_ARGS__)
il_status il_native_nomem(il_native *n);

/* What is found out when a record closes is said of the line that began it. */
#define il_native_fail_at(n, line, ...) il_fail((n)->err, IL_E_INPUT, (line), __VA_ARGS__)

#endif
