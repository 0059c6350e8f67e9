/* complaint.h - what is wrong with the lines of a map, in words that name them. */
#ifndef IL_TERRAIN_COMPLAINT_H
#define IL_TERRAIN_COMPLAINT_H

#include "base/number.h"
#include "model/report.h"
#include "terrain/chart.h"

/* Whom complaints are about, and where they go (REPORT may be null).  All borrowed.  unit: of
 * the map. */
typedef struct il_complaint {
    const il_stack_head *head;
    il_unit unit;
    const il_slice *slice;
    const il_chart_line *line;
    size_t n_lines;
    il_report *report;
} il_complaint;

/* Line L, of those that the chart may have, is left out: WHY, near the point AT of the map. */
void il_complaint_left_out(const il_complaint *c, uint32_t l, const double at[2], const char *why);

/* The same, because of line OTHER (UINT32_MAX: of none): "WHY, against ...". */
void il_complaint_against(const il_complaint *c, uint32_t l, const double at[2], const char *why, uint32_t other);

/* Spot I of the head is left out: WHY. */
void il_complaint_spot(const il_complaint *c, size_t i, const char *why);

/* Between lines A and B others are missing, and were interpolated; IS_THIRD: B is of a level
 * between A's and that of another line on the same face. */
void il_complaint_missing(const il_complaint *c, uint32_t a, uint32_t b, const double at[2], bool is_third);

/* "the isoline of 40 m (feature 12, line 340)"; N bytes at TO. */
void il_complaint_name(const il_complaint *c, uint32_t l, char *to, size_t n);

/* "near (300.5, 40)": AT, a point of the map. */
#define IL_COMPLAINT_PLACE (2 * IL_NUMBER_MAX + 16)
void il_complaint_place(const double at[2], char to[IL_COMPLAINT_PLACE]);

#endif
