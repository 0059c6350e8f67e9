#include "config.h"
#include "terrain/complaint.h"

#include <math.h>
#include <stdio.h>

static const char *file_of(const il_complaint *c, uint32_t file)
{
    return file < c->head->n_files ? c->head->file[file] : "-";
}

/* Heights of a map in degrees are metres. */
static const char *unit_of_heights(const il_complaint *c)
{
    return il_unit_name(c->unit == IL_UNIT_DEG ? IL_UNIT_M : c->unit);
}

void il_complaint_name(const il_complaint *c, uint32_t l, char *to, size_t n)
{
    const il_ring *r = il_chart_ring(c->slice, c->line, l);
    char z[IL_NUMBER_MAX], where[64] = "";
    il_number_format(z, c->slice[c->line[l].level].z);
    if (r->feature > 0 && r->line > 0)
        snprintf(where, sizeof where, " (feature %ld, line %ld)", r->feature, r->line);
    else if (r->feature > 0 || r->line > 0)
        snprintf(where, sizeof where, r->feature > 0 ? " (feature %ld)" : " (line %ld)", r->feature > 0 ? r->feature : r->line);
    snprintf(to, n, "the isoline of %s %s%s", z, unit_of_heights(c), where);
}

/* Nine digits of the larger coordinate: enough to find the place, and to read it. */
static double shorten(double v, const double at[2])
{
    double size = fmax(fabs(at[0]), fabs(at[1]));
    double places = size > 0 ? 8 - floor(log10(size)) : 0;
    if (!(places > 0 && places < 300))
        return round(v) + 0.0; /* not -0 */
    return round(v * pow(10, places)) / pow(10, places) + 0.0;
}

void il_complaint_place(const double at[2], char to[IL_COMPLAINT_PLACE])
{
    char x[IL_NUMBER_MAX], y[IL_NUMBER_MAX];
    il_number_format(x, shorten(at[0], at));
    il_number_format(y, shorten(at[1], at));
    snprintf(to, IL_COMPLAINT_PLACE, "near (%s, %s)", x, y);
}

void il_complaint_against(const il_complaint *c, uint32_t l, const double at[2], const char *why, uint32_t other)
{
    char name[160], against[160], place[IL_COMPLAINT_PLACE], reason[600];
    const il_ring *r = il_chart_ring(c->slice, c->line, l);
    il_complaint_name(c, l, name, sizeof name);
    il_complaint_place(at, place);
    if (other < c->n_lines) {
        il_complaint_name(c, other, against, sizeof against);
        snprintf(reason, sizeof reason, "%s, against %s, %s; left out", why, against, place);
    } else {
        snprintf(reason, sizeof reason, "%s, %s; left out", why, place);
    }
    il_report_skip(c->report, file_of(c, r->file), r->line, name, reason);
}

void il_complaint_left_out(const il_complaint *c, uint32_t l, const double at[2], const char *why)
{
    il_complaint_against(c, l, at, why, UINT32_MAX);
}

void il_complaint_spot(const il_complaint *c, size_t i, const char *why)
{
    const il_spot *s = &c->head->spot[i];
    char z[IL_NUMBER_MAX], what[96], where[40] = "";
    il_number_format(z, s->z);
    if (s->feature > 0)
        snprintf(where, sizeof where, " (feature %ld)", s->feature);
    snprintf(what, sizeof what, "the spot height %s %s%s", z, unit_of_heights(c), where);
    il_report_skip(c->report, file_of(c, s->file), s->line, what, why);
}

void il_complaint_missing(const il_complaint *c, uint32_t a, uint32_t b, const double at[2], bool is_third)
{
    char first[160], second[160] = "the edge of the map", place[IL_COMPLAINT_PLACE];
    il_complaint_name(c, a, first, sizeof first);
    if (b < c->n_lines)
        il_complaint_name(c, b, second, sizeof second);
    il_complaint_place(at, place);
    if (is_third)
        il_report_note(c->report, "beside %s, %s, %s lies between two other levels: lines interpolated", first, place, second);
    else
        il_report_note(c->report, "between %s and %s, %s, lines are missing: interpolated", first, second, place);
}
