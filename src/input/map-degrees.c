#include "config.h"
#include "input/map-degrees.h"
#include "base/alloc.h"
#include "input/map-refuse.h"
#include "input/map-spots.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* See the head of map-degrees.h. */
static const double relief_most = 3;

/* ---- what the numbers look like ---------------------------------------------- */

static void measure(il_map *m)
{
    double *b = m->box;
    b[0] = b[1] = INFINITY;
    b[2] = b[3] = -INFINITY;
    for (size_t i = 0; i < m->n_lines; i++) {
        const il_map_line *l = &m->line[i];
        for (size_t k = l->begin; k < l->begin + (il_map_takes_part(l) ? l->n : 0); k++) {
            const double *p = m->xy + 2 * k;
            b[0] = p[0] < b[0] ? p[0] : b[0];
            b[1] = p[1] < b[1] ? p[1] : b[1];
            b[2] = p[0] > b[2] ? p[0] : b[2];
            b[3] = p[1] > b[3] ? p[1] : b[3];
        }
    }
}

/* Longitudes run from -180 or from 0; maps across the antimeridian a little beyond. */
bool il_map_can_be_degrees(const il_map *m)
{
    return m->box[0] >= -360 && m->box[2] <= 360 && m->box[2] - m->box[0] <= 360 && m->box[1] >= -90 && m->box[3] <= 90;
}

/* ---- one run of longitudes ------------------------------------------------------ */

enum { BINS = 3600 };

static size_t bin_of(double lon)
{
    double turn = lon / 360;
    size_t bin = (size_t)((turn - floor(turn)) * BINS);
    return bin < BINS ? bin : BINS - 1;
}

/* All bins of the edge from longitude P to Q: the short way round, as lines that jump
 * from 179.9 to -179.9 mean it.  CHANGE[k]: how many more edges use bin k than the one
 * before it; CHANGE[BINS] closes those that run to the end. */
static void use_edge(ptrdiff_t change[BINS + 1], double p, double q)
{
    bool eastward = (q > p) == (fabs(q - p) <= 180);
    size_t from = bin_of(eastward ? p : q), to = bin_of(eastward ? q : p);
    change[from]++;
    change[to + 1]--;
    if (from > to) { /* round the end */
        change[0]++;
        change[BINS]--;
    }
}

/* How many degrees of the circle the lines take, in one run.  *START is where, from 0 to
 * 360, the longest stretch without a line ends; -1 when longitudes need not be brought
 * into one run, or cannot be. */
static double turn_used(const il_map *m, double *start)
{
    *start = -1;
    if (m->box[2] - m->box[0] <= 180)
        return m->box[2] - m->box[0];
    ptrdiff_t change[BINS + 1] = { 0 };
    for (size_t i = 0; i < m->n_lines; i++) {
        const il_map_line *l = &m->line[i];
        for (size_t k = 0; k < (il_map_takes_part(l) ? l->n : 0); k++) {
            size_t next = k + 1 < l->n ? k + 1 : l->closed ? 0 : k;
            use_edge(change, m->xy[2 * (l->begin + k)], m->xy[2 * (l->begin + next)]);
        }
    }
    size_t longest = 0, end = 0, run = 0;
    ptrdiff_t used = 0;
    for (size_t k = 0; k < (size_t)2 * BINS; k++) {
        used = k % BINS == 0 ? change[0] : used + change[k % BINS];
        run = used > 0 ? 0 : run + 1;
        if (run > longest && run <= BINS) {
            longest = run;
            end = k + 1;
        }
    }
    if (longest < 2)
        return 360;
    *start = (double)(end % BINS) * 360 / BINS;
    return 360 - (double)longest * 360 / BINS;
}

/* Bring all longitudes into one turn that begins in the stretch before START: half a bin
 * before it, out of the way of what rounding does to points at its end. */
static void turn_longitudes(il_map *m, double start)
{
    double first = (start > 180 ? start - 360 : start) - 180.0 / BINS;
    for (size_t i = 0; i < m->n_lines; i++) {
        const il_map_line *l = &m->line[i];
        for (size_t k = l->begin; k < l->begin + l->n; k++)
            m->xy[2 * k] -= 360 * floor((m->xy[2 * k] - first) / 360);
    }
}

/* ---- the decision -------------------------------------------------------------- */

static double relief(const il_map *m)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < m->n_lines; i++) {
        if (il_map_takes_part(&m->line[i])) {
            low = fmin(low, m->line[i].height);
            high = fmax(high, m->line[i].height);
        }
    }
    return high - low;
}

static bool looks_like_degrees(const il_map *m)
{
    double start;
    return il_map_can_be_degrees(m) && relief(m) > relief_most * fmax(turn_used(m, &start), m->box[3] - m->box[1]);
}

static il_status fail_impossible(const il_map *m, const char *asked, il_error *err)
{
    char box[IL_MAP_BOX_MOST];
    return il_fail(err, IL_E_INPUT, 0, "coordinates from %s are no degrees, which %s asks for",
                   il_map_box_words(m, box, sizeof box), asked);
}

/* The stack must not say of lengths that they are degrees. */
static void forget_crs(il_map *m)
{
    il_free(m->crs);
    m->crs = NULL;
    m->meaning.kind = IL_CRS_UNKNOWN;
    m->meaning.epsg = 0;
}

static void tell_disbelief(const il_map *m)
{
    bool swapped = m->box[1] >= -180 && m->box[3] <= 180 && m->box[0] >= -90 && m->box[2] <= 90;
    char box[IL_MAP_BOX_MOST];
    il_report_note(m->report, "labelled as degrees%s%.40s%s, which coordinates from %s cannot be%s: taken as lengths",
                   m->crs ? " (" : "", m->crs ? m->crs : "", m->crs ? ")" : "", il_map_box_words(m, box, sizeof box),
                   swapped ? " (are x and y exchanged?)" : "");
}

/* What the user says counts first, then what the files say, then how it looks. */
static il_status decide(il_map *m, il_error *err)
{
    const il_read_options *o = m->options;
    bool asked = o->map.project == IL_PROJECT_UTM || o->map.project == IL_PROJECT_TM;
    bool labelled = m->degrees || m->meaning.kind == IL_CRS_GEOGRAPHIC;
    bool lengths = m->meaning.kind == IL_CRS_PROJECTED || m->meaning.kind == IL_CRS_LOCAL || m->has_unit;
    m->degrees = false;
    if (!o->has_unit && m->meaning.kind == IL_CRS_GEOGRAPHIC && m->meaning.odd_unit)
        return il_fail(err, IL_E_INPUT, 0, "its angles are not degrees (%.80s): ogr2ogr -t_srs EPSG:4326 makes degrees of them", m->crs);
    if (o->has_unit && o->unit != IL_UNIT_DEG) {
        if (labelled)
            forget_crs(m);
        return asked ? il_fail(err, IL_E_USAGE, 0, "--project has nothing to project where --unit says lengths") : IL_OK;
    }
    if (o->has_unit || (asked && !labelled)) {
        const char *by = o->has_unit ? "--unit deg" : "--project";
        if (!o->has_unit && lengths)
            return il_fail(err, IL_E_INPUT, 0, "its coordinates are lengths already (%.60s): --project has nothing to project",
                           m->crs ? m->crs : "by their unit");
        m->degrees = il_map_can_be_degrees(m);
        return m->degrees ? IL_OK : fail_impossible(m, by, err);
    }
    m->degrees = labelled ? il_map_can_be_degrees(m) : !lengths && looks_like_degrees(m);
    if (labelled && !m->degrees && asked)
        return fail_impossible(m, "--project", err);
    if (labelled && !m->degrees) {
        tell_disbelief(m);
        forget_crs(m);
    } else if (!labelled && m->degrees) {
        il_report_note(m->report, "%s%.60s%s; numbers and relief are those of degrees, so they are taken as such "
                                  "(--unit m: as metres)", m->crs ? "the coordinate system '" : "no coordinate system given",
                       m->crs ? m->crs : "", m->crs ? "' is not known here" : "");
    }
    return IL_OK;
}

il_status il_map_find_degrees(il_map *m, il_error *err)
{
    measure(m);
    il_status st = decide(m, err);
    double start;
    if (st != IL_OK || !m->degrees)
        return st;
    turn_used(m, &start);
    if (start >= 0) {
        turn_longitudes(m, start);
        measure(m);
    }
    il_map_spots_turn(m);
    return IL_OK;
}
