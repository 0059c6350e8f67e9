#include "config.h"
#include "model/report.h"
#include "base/alloc.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct { const char *key, *words; } repairs[IL_N_REPAIRS] = {
    [IL_REPAIR_REPEATED_POINT]  = { "repeated_points",  "repeated point dropped" },
    [IL_REPAIR_DUPLICATE_RING]  = { "duplicate_rings",  "duplicate ring dropped" },
    [IL_REPAIR_DEGENERATE_RING] = { "degenerate_rings", "ring without area dropped" },
    [IL_REPAIR_CROSSING]        = { "crossings",        "crossing made a vertex" },
    [IL_REPAIR_TOUCH]           = { "touches",          "vertex on an edge made a vertex of both" },
    [IL_REPAIR_KEYHOLE]         = { "keyholes",         "keyhole opened" },
    [IL_REPAIR_KEYHOLE_EDGE]    = { "keyhole_edges",    "edge that cancels dropped" },
    [IL_REPAIR_PINCH]           = { "pinches",          "place where the region touches itself" },
    [IL_REPAIR_REVERSED_RING]   = { "reversed_rings",   "ring turned round" },
    [IL_REPAIR_REORDERED_SLICE] = { "reordered_slices", "slice put into its place" },
    [IL_REPAIR_MERGED_SLICE]    = { "merged_slices",    "slice merged with one of its height" },
    [IL_REPAIR_POINT_COUNT]     = { "wrong_point_counts", "contour that states a wrong number of points" },
    [IL_REPAIR_FLATTENED_POINT] = { "flattened_points", "point moved into the plane of its contour" },
    [IL_REPAIR_MOVED_CONTOUR]   = { "moved_contours",   "contour moved onto the plane of its slice" },
    [IL_REPAIR_XOR_PAIR]        = { "xor_pairs",        "pair of equal XOR contours, which cancel" },
    [IL_REPAIR_THICKENED_SLICE] = { "thickened_slices", "single slice given a thickness" },
    [IL_REPAIR_ROUNDED_POINT]   = { "rounded_points",   "point rounded to 32-bit floats" },
    [IL_REPAIR_POINT_LINE]      = { "point_lines",      "line of a single point dropped" },
    [IL_REPAIR_SPIKE]           = { "spikes",           "edge of a dead end dropped" },
    [IL_REPAIR_DUPLICATE_LINE]  = { "duplicate_lines",  "line that was there already dropped" },
    [IL_REPAIR_SHARED_EDGE]     = { "shared_edges",     "edge that was there already dropped from a line" },
    [IL_REPAIR_JOINED_LINE]     = { "joined_lines",     "joint where two ends meet" },
    [IL_REPAIR_BRIDGED_GAP]     = { "bridged_gaps",     "gap between two ends bridged" },
    [IL_REPAIR_REVERSED_LINE]   = { "reversed_lines",   "piece of a line turned round" },
    [IL_REPAIR_KNOT]            = { "knots",            "place where more than two ends meet, left apart" },
    [IL_REPAIR_CRUMB]           = { "crumbs",           "line of two points that nothing is joined to" },
    [IL_REPAIR_MISSING_LINE]    = { "missing_lines",    "face that lines were missing in, interpolated" },
};

const char *il_repair_key(il_repair r)
{
    return repairs[r].key;
}

const char *il_repair_words(il_repair r)
{
    return repairs[r].words;
}

void il_report_free(il_report *r)
{
    for (size_t i = 0; i < r->n_skips; i++) {
        il_free(r->skip[i].file);
        il_free(r->skip[i].what);
        il_free(r->skip[i].why);
    }
    for (size_t i = 0; i < r->n_notes; i++)
        il_free(r->note[i]);
    il_free(r->skip);
    il_free(r->note);
    *r = (il_report)IL_REPORT_INIT;
}

enum { TEXT_MOST = 400 }; /* bytes of one text, printable */

static char *printable_copy(const char *s)
{
    char text[TEXT_MOST];
    size_t n = il_text_printable(text, sizeof text, s, strlen(s));
    return il_strndup(text, n);
}

/* Count as many more of a skip that is listed already. */
static bool fold_skip(il_report *r, const il_skip *s)
{
    for (size_t i = 0; i < r->n_skips; i++) {
        il_skip *old = &r->skip[i];
        if (strcmp(old->what, s->what) == 0 && strcmp(old->why, s->why) == 0 && strcmp(old->file, s->file) == 0) {
            old->count += s->count;
            return true;
        }
    }
    return false;
}

/* List S, which is taken over, unless it is in the list or that is full. */
static void keep_skip(il_report *r, il_skip *s)
{
    if (s->file && s->what && s->why && !fold_skip(r, s) && r->n_skips < IL_REPORT_SKIPS_KEPT &&
        il_grow(&r->skip, &r->cap_skips, r->n_skips + 1, sizeof *r->skip)) {
        r->skip[r->n_skips++] = *s;
        return;
    }
    il_free(s->file);
    il_free(s->what);
    il_free(s->why);
}

void il_report_skip(il_report *r, const char *file, long line, const char *what, const char *why)
{
    if (!r)
        return;
    r->n_skipped++;
    il_skip s = { printable_copy(file), line, printable_copy(what), printable_copy(why), 1 };
    keep_skip(r, &s);
}

void il_report_note(il_report *r, const char *format, ...)
{
    if (!r)
        return;
    char text[TEXT_MOST];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    char *copy = printable_copy(text);
    if (copy && il_grow(&r->note, &r->cap_notes, r->n_notes + 1, sizeof *r->note))
        r->note[r->n_notes++] = copy;
    else
        il_free(copy);
}

void il_report_repair(il_report *r, il_repair what, size_t n)
{
    if (r)
        r->repair[what] += n;
}

void il_report_merge(il_report *to, il_report *from)
{
    if (!to) {
        il_report_free(from);
        return;
    }
    to->n_skipped += from->n_skipped;
    for (size_t i = 0; i < from->n_skips; i++)
        keep_skip(to, &from->skip[i]);
    from->n_skips = 0;
    for (int i = 0; i < IL_N_REPAIRS; i++)
        to->repair[i] += from->repair[i];
    if (from->largest_move > to->largest_move)
        to->largest_move = from->largest_move;
    for (size_t i = 0; i < from->n_notes; i++) {
        if (il_grow(&to->note, &to->cap_notes, to->n_notes + 1, sizeof *to->note))
            to->note[to->n_notes++] = from->note[i];
        else
            il_free(from->note[i]);
    }
    from->n_notes = 0;
    il_report_free(from);
}

/* Few formats say which way a ring or a line runs, and SVG's y axis turns them all;
 * a pinch, a knot and a crumb are kept as they are. */
static bool is_fault(il_repair r)
{
    return r != IL_REPAIR_REVERSED_RING && r != IL_REPAIR_REVERSED_LINE && r != IL_REPAIR_PINCH &&
           r != IL_REPAIR_KNOT && r != IL_REPAIR_CRUMB;
}

bool il_report_any(const il_report *r)
{
    size_t n = r->n_skipped;
    for (int i = 0; i < IL_N_REPAIRS; i++)
        n += is_fault((il_repair)i) ? r->repair[i] : 0;
    return n > 0;
}
