/* report.h - the account of what was skipped and repaired: counted, never lost. */
#ifndef IL_MODEL_REPORT_H
#define IL_MODEL_REPORT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Repairs of contours, each counted once per place. */
typedef enum il_repair {
    IL_REPAIR_REPEATED_POINT,   /* consecutive equal vertices dropped */
    IL_REPAIR_DUPLICATE_RING,   /* a ring that was there already, dropped */
    IL_REPAIR_DEGENERATE_RING,  /* fewer than 3 distinct vertices or no area, dropped */
    IL_REPAIR_CROSSING,         /* vertices inserted where rings cross */
    IL_REPAIR_TOUCH,            /* a vertex on another ring's edge, made a vertex of both */
    IL_REPAIR_KEYHOLE,          /* keyhole channels cut out of a ring */
    IL_REPAIR_KEYHOLE_EDGE,     /* edges that cancel: shared borders, channels that were not cut out */
    IL_REPAIR_PINCH,            /* a vertex where the region touches itself; kept */
    IL_REPAIR_REVERSED_RING,    /* turned so that the region lies on the left */
    IL_REPAIR_REORDERED_SLICE,  /* slices put into rising z */
    IL_REPAIR_MERGED_SLICE,     /* slices of one height made one */
    IL_REPAIR_POINT_COUNT,      /* contours that state another number of points than they have */
    IL_REPAIR_FLATTENED_POINT,  /* points moved into the plane of their contour */
    IL_REPAIR_MOVED_CONTOUR,    /* contours moved onto the plane of their slice */
    IL_REPAIR_XOR_PAIR,         /* equal contours of type CLOSEDPLANAR_XOR, which cancel */
    IL_REPAIR_THICKENED_SLICE,  /* a slice that nothing is joined to, given a thickness */
    IL_REPAIR_ROUNDED_POINT,    /* coordinates rounded to 32-bit floats (STL) */
    IL_REPAIR_POINT_LINE,       /* lines of terrain with a single point, dropped; the first that solids have not */
    IL_REPAIR_SPIKE,            /* edges over which a line goes and comes back at once, dropped */
    IL_REPAIR_DUPLICATE_LINE,   /* lines of which every edge is in others, dropped */
    IL_REPAIR_SHARED_EDGE,      /* edges that were there already, dropped */
    IL_REPAIR_JOINED_LINE,      /* joints of ends that coincide */
    IL_REPAIR_BRIDGED_GAP,      /* joints of ends that lie apart (--join) */
    IL_REPAIR_REVERSED_LINE,    /* pieces turned round so that a joined line runs one way */
    IL_REPAIR_KNOT,             /* places where more than two ends meet; left apart */
    IL_REPAIR_CRUMB,            /* lines of two points that nothing is joined to; kept */
    IL_REPAIR_MISSING_LINE,     /* faces of a map between levels that are no neighbours; lines interpolated */
    IL_N_REPAIRS
} il_repair;

enum { IL_N_REPAIRS_OF_SOLIDS = IL_REPAIR_POINT_LINE };

/* snake_case key of the JSON summary, and the words for people (singular). */
const char *il_repair_key(il_repair r);
const char *il_repair_words(il_repair r);

/* Something of the input that was left out: WHERE (file:line or a path in the
 * file), WHAT (element, record), WHY.  Kept up to a limit, counted beyond it. */
typedef struct il_skip {
    char *file;
    long line;
    char *what, *why;
    size_t count;               /* equal what and why at later lines fold into one */
} il_skip;

enum { IL_REPORT_SKIPS_KEPT = 100 };

typedef struct il_report {
    size_t repair[IL_N_REPAIRS];
    double largest_move;        /* farthest a vertex was moved by rounding or into its plane, unit */
    il_skip *skip;
    size_t n_skips, cap_skips, n_skipped;
    char **note;                /* sentences such as "user units taken as mm" */
    size_t n_notes, cap_notes;
} il_report;

#define IL_REPORT_INIT { { 0 }, 0, NULL, 0, 0, 0, NULL, 0, 0 }
void il_report_free(il_report *r);

/* Any text is made printable here; running out of memory loses words but not
 * the count.  A null report ignores everything. */
void il_report_skip(il_report *r, const char *file, long line, const char *what, const char *why);
void il_report_note(il_report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
void il_report_repair(il_report *r, il_repair what, size_t n);

/* All of FROM is counted in TO as well; FROM is empty then. */
void il_report_merge(il_report *to, il_report *from);

/* Was anything wrong with the input: skipped or repaired?  (--strict)  Rings and
 * lines turned round, and what is kept as it is (pinches, knots, crumbs), are told,
 * but they are no faults. */
bool il_report_any(const il_report *r);

#endif
