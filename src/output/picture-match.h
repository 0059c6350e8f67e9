/* picture-match.h - two slices over each other, with what corresponds in them. */
#ifndef IL_OUTPUT_PICTURE_MATCH_H
#define IL_OUTPUT_PICTURE_MATCH_H

#include "output/picture-arcs.h"
#include "output/picture-parts.h"

/* Line widths on the page, as attributes; how far apart links are drawn, and how
 * many at most, about. */
typedef struct il_match_style {
    const char *contour, *matched, *unmatched, *links, *inserted;
    double link_spacing, links_most, cut_width;
} il_match_style;

extern const il_match_style il_match_large, il_match_small;

/* What a pair holds, counted, and with lengths in the stack's unit. */
typedef struct il_match_facts {
    size_t unmatched[3];                /* by il_event */
    double lower_matched, upper_matched, lower_length, upper_length;
} il_match_facts;

/* Draw A's slices with their pieces and cuts, links, matched and unmatched arcs.  *FACTS may be null. */
il_status il_picture_match(il_svg_page *page, const il_svg_view *v, il_arcs *a, const il_match_style *style,
                           il_match_facts *facts, il_error *err);

/* The legend's entries for what has been drawn: at most IL_MATCH_ENTRIES into ENTRY;
 * returns how many. */
typedef struct il_match_drawn {
    bool matched, inserted, cut;
    size_t unmatched[3];                /* by il_event */
} il_match_drawn;
enum { IL_MATCH_ENTRIES = 10 };
size_t il_picture_match_legend(il_legend_entry *entry, const il_match_drawn *d);

#endif
