#include "config.h"
#include "input/map-units.h"
#include "base/alloc.h"
#include "base/sort.h"
#include "input/map-degrees.h"
#include "input/map-names.h"
#include "input/map-refuse.h"
#include "input/map-spots.h"

#include <math.h>
#include <string.h>

/* Levels that differ by no more than this part of all relief are one. */
static const double same_level = 1e-7;

/* ---- the unit of x and y ----------------------------------------------------- */

static void find_unit(il_map *m)
{
    const il_read_options *o = m->options;
    bool stated = m->has_unit;
    if (m->degrees) {
        m->unit = IL_UNIT_DEG;
        return;
    }
    if (o->has_unit)
        m->unit = o->unit;
    else if (m->meaning.has_unit)
        m->unit = m->meaning.unit;
    else if (!stated)
        m->unit = IL_UNIT_M;
    if (!o->has_unit && !m->meaning.has_unit && !m->meaning.odd_unit && !stated)
        il_report_note(m->report, "%s: coordinates are taken as metres (--unit %ssays otherwise)",
                       m->meaning.epsg ? "what unit the coordinate system has is not known here" : "no unit given",
                       il_map_can_be_degrees(m) ? "deg, if they are degrees, " : "");
    else if (!o->has_unit && m->meaning.us_foot)
        il_report_note(m->report, "U.S. survey feet are taken as feet, which are 2 millionths shorter");
    if (!o->has_unit && m->meaning.odd_unit)
        il_report_note(m->report, "the coordinate system's unit has no name here: coordinates are taken as %s", il_unit_name(m->unit));
}

/* ---- the unit of heights ------------------------------------------------------- */

static bool unit_of_column(const il_map_column *c, il_unit *unit)
{
    il_map_name name;
    if (c->has_unit && !c->mixed_units) {
        *unit = c->unit;
        return true;
    }
    bool named = il_map_name_read(c->name, strlen(c->name), &name) && name.has_unit;
    *unit = named ? name.unit : *unit;
    return named;
}

static bool is_depth(const il_map *m, const il_map_where *w)
{
    il_map_name name;
    const char *s = w->kind == IL_MAP_Z ? "" : m->column[w->low].name;
    return il_map_name_read(s, strlen(s), &name) && name.is_depth;
}

static il_unit find_z_unit(const il_map *m, const il_map_where *w)
{
    il_unit unit = m->unit == IL_UNIT_DEG ? IL_UNIT_M : m->unit;
    if (m->options->map.has_z_unit)
        return m->options->map.z_unit;
    if (w->kind != IL_MAP_Z && unit_of_column(&m->column[w->low], &unit))
        return unit;
    return m->meaning.has_z_unit ? m->meaning.z_unit : unit;
}

/* A name of depths says positive down, unless all of them are below 0 already. */
static bool points_down(const il_map *m, const il_map_where *w)
{
    if (m->options->map.depth != IL_DEPTH_AUTO)
        return m->options->map.depth == IL_DEPTH_DOWN;
    if (w->kind == IL_MAP_Z)
        return m->meaning.down;
    bool above = false;
    for (size_t i = 0; i < m->n_lines && !above; i++)
        above = m->line[i].height > 0;
    return above && is_depth(m, w);
}

/* The factor exactly for feet in metres and the like: the larger unit over the smaller. */
static double converted(double z, il_unit from, il_unit to)
{
    double a = il_unit_metres(from), b = il_unit_metres(to);
    return a == b ? z : b == 1 ? z * a : a == 1 ? z / b : z * a / b;
}

static il_map_scale scale_of(const il_map *m, const il_map_where *w)
{
    il_unit to = m->unit == IL_UNIT_DEG ? IL_UNIT_M : m->unit;
    return (il_map_scale){ find_z_unit(m, w), to, points_down(m, w) };
}

/* Kilometres may reach the bound when they become micrometres. */
il_status il_map_scale_height(const il_map_scale *s, double *z, const char *file, long line, il_error *err)
{
    double to = converted(*z, s->from, s->to);
    *z = (s->down ? -to : to) + 0.0;
    if (fabs(to) < IL_COORDINATE_BOUND)
        return IL_OK;
    il_fail(err, IL_E_INPUT, line, "a height reaches 1e15 when converted to %s", il_unit_name(s->to));
    il_error_set_file(err, file);
    return IL_E_INPUT;
}

static il_status convert_lines(il_map *m, const il_map_scale *s, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < m->n_lines && st == IL_OK; i++) {
        il_map_line *l = &m->line[i];
        if (il_map_takes_part(l))
            st = il_map_scale_height(s, &l->height, il_map_file_of(m, l), l->line, err);
    }
    return st;
}

static void tell_heights(const il_map *m, const il_map_scale *s)
{
    char place[200];
    bool other = s->from != s->to;
    il_report_note(m->report, "heights: %s, %s%s%s%s", il_map_place_words(m, place, sizeof place), il_unit_name(s->from),
                   other ? ", converted to " : "", other ? il_unit_name(s->to) : "", s->down ? ", positive down" : "");
    if (!s->down && is_depth(m, &m->place) && m->options->map.depth == IL_DEPTH_AUTO)
        il_report_note(m->report, "depths are below 0, so they are taken as heights (--depth turns them over)");
    if (m->place.kind != IL_MAP_Z && m->column[m->place.low].mixed_units)
        il_report_note(m->report, "heights state different units, which are not converted: all are taken as %s",
                       il_unit_name(s->from));
}

static il_status convert(il_map *m, il_error *err)
{
    const il_map_where by_z = { .kind = IL_MAP_Z };
    const il_map_scale s = scale_of(m, &m->place), own = scale_of(m, &by_z);
    il_status st = convert_lines(m, &s, err);
    if (st == IL_OK)
        tell_heights(m, &s);
    return st == IL_OK ? il_map_spots_convert(m, &s, &own, err) : st;
}

/* ---- levels --------------------------------------------------------------------- */

/* The commonest of Z[0..N), sorted; of equally common ones the least. */
static double commonest(const double *z, size_t n)
{
    size_t best = 0, most = 0;
    for (size_t k = 0, end = 0; k < n; k = end) {
        while (end < n && z[end] == z[k])
            end++;
        if (end - k > most) {
            most = end - k;
            best = k;
        }
    }
    return z[best];
}

/* LEVEL[K] is the height that lines of height Z[K] get; *N_LEVELS different ones. */
static void name_levels(const double *z, double *level, size_t n, size_t *n_levels)
{
    double same = n > 0 ? same_level * (z[n - 1] - z[0]) : 0;
    *n_levels = 0;
    for (size_t i = 0, j; i < n; i = j, ++*n_levels) {
        for (j = i + 1; j < n && z[j] - z[j - 1] <= same;)
            j++;
        double name = commonest(z + i, j - i);
        for (size_t k = i; k < j; k++)
            level[k] = name;
    }
}

static size_t find(const double *z, size_t n, double value)
{
    size_t low = 0, high = n;
    while (high - low > 1) {
        size_t mid = low + (high - low) / 2;
        if (z[mid] <= value)
            low = mid;
        else
            high = mid;
    }
    return low;
}

static void move_lines(il_map *m, const double *z, const double *level, size_t n)
{
    for (size_t i = 0; i < m->n_lines; i++) {
        il_map_line *l = &m->line[i];
        if (!il_map_takes_part(l))
            continue;
        double to = level[find(z, n, l->height)];
        if (to == l->height)
            continue;
        il_report_repair(m->report, IL_REPAIR_MOVED_CONTOUR, 1);
        if (m->report)
            m->report->largest_move = fmax(m->report->largest_move, fabs(to - l->height));
        l->height = to;
    }
}

static il_status settle_levels(il_map *m, il_error *err)
{
    double *z = il_alloc(m->n_lines, sizeof *z), *level = il_alloc(m->n_lines, sizeof *level);
    size_t n = 0, n_levels = 0;
    il_status st = z && level ? IL_OK : il_fail_nomem(err);
    for (size_t i = 0; i < m->n_lines && st == IL_OK; i++)
        if (il_map_takes_part(&m->line[i]))
            z[n++] = m->line[i].height;
    if (st == IL_OK && n == 0)
        st = il_map_refuse_no_lines(m, err);
    if (st == IL_OK) {
        il_sort_doubles(z, n);
        name_levels(z, level, n, &n_levels);
        if (memcmp(z, level, n * sizeof *z) != 0)
            move_lines(m, z, level, n);
        if (n_levels == 1 && m->options->map.high == IL_SIDE_UNKNOWN)
            st = il_map_refuse_one_level(m, z[0], err);
    }
    il_free(z);
    il_free(level);
    return st;
}

il_status il_map_settle_units(il_map *m, il_error *err)
{
    find_unit(m);
    il_status st = convert(m, err);
    return st == IL_OK ? settle_levels(m, err) : st;
}
