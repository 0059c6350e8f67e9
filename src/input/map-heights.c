#include "config.h"
#include "input/map-heights.h"
#include "input/map-names.h"
#include "input/map-refuse.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* Heights along a line, and levels, that differ by no more than this part of all relief
 * are one: the files' decimals and 32-bit floats, not the ground. */
static const double same_height = 1e-7;

/* ---- which attributes are read --------------------------------------------- */

/* Is NAME the part of --height before the comma, or behind it, or all of it? */
static bool is_named(const char *height, const char *name, size_t n)
{
    const char *comma = strchr(height, ',');
    if (strlen(height) == n && strncasecmp(height, name, n) == 0)
        return true;
    return comma && (((size_t)(comma - height) == n && strncasecmp(height, name, n) == 0) ||
                     (strlen(comma + 1) == n && strncasecmp(comma + 1, name, n) == 0));
}

bool il_map_heights_wants(const il_read_options *o, const char *name, size_t n)
{
    il_map_name meaning;
    if (o->map.height)
        return is_named(o->map.height, name, n);
    return il_map_name_read(name, n, &meaning);
}

bool il_map_heights_value(const il_read_options *o, const char *text, size_t n, il_map_value *out)
{
    return o->map.height ? il_map_value_find(text, n, out) : il_map_value_parse(text, n, out);
}

/* ---- places ------------------------------------------------------------------ */

static double value_of(const il_map_column *c, const il_map_line *l)
{
    return l->feature < c->n ? c->value[l->feature] : NAN;
}

static double relief_of_z(const il_map *m)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < m->n_lines; i++) {
        low = fmin(low, m->line[i].z_low);
        high = fmax(high, m->line[i].z_high);
    }
    return high > low ? high - low : 0;
}

/* The z of L, NAN when it has none or it varies. */
static double z_of(const il_map_line *l, double relief)
{
    bool flat = l->n_z > 0 && l->z_high - l->z_low <= same_height * relief;
    return flat ? l->z_low : NAN;
}

/* The lower height of a band, whose other end may be made up: the lowest and the highest
 * band of a map often have one only, and gdal_contour then writes 0 for the other. */
static double band_from(double low, double *upper)
{
    if (isnan(low) || (low == 0 && *upper < 0))
        return nextafter(*upper, -INFINITY);
    if (low > 0 && *upper == 0)
        *upper = NAN;
    if (isnan(*upper))
        *upper = nextafter(low, INFINITY);
    return low < *upper ? low : NAN;
}

/* The height of L at PLACE, and *UPPER that of a band. */
static double height_at(const il_map *m, const il_map_where *place, const il_map_line *l, double relief, double *upper)
{
    *upper = NAN;
    if (place->kind == IL_MAP_Z)
        return z_of(l, relief);
    double low = value_of(&m->column[place->low], l);
    if (place->kind == IL_MAP_COLUMN)
        return low;
    *upper = value_of(&m->column[place->high], l);
    return l->kind == IL_MAP_RING ? band_from(low, upper) : NAN;
}

/* How many lines have a height at PLACE, and whether there are two different ones. */
static size_t count_at(const il_map *m, const il_map_where *place, bool *differ)
{
    double first = NAN, upper, relief = relief_of_z(m);
    size_t n = 0;
    *differ = false;
    for (size_t i = 0; i < m->n_lines; i++) {
        double h = height_at(m, place, &m->line[i], relief, &upper);
        if (isnan(h))
            continue;
        first = n++ == 0 ? h : first;
        *differ |= h != first;
    }
    return n;
}

/* ---- the choice -------------------------------------------------------------- */

/* best: of the places seen so far, by these classes: it covers half of the lines and
 * tells levels apart; tells them apart; covers any line. */
typedef struct choice {
    const il_map *map;
    il_map_where best;
    int rank;                   /* 0 none, 1 to 3 */
} choice;

static void consider(choice *c, const il_map_where *place)
{
    bool differ;
    size_t n = count_at(c->map, place, &differ);
    int rank = n == 0 ? 0 : !differ ? 1 : 2 * n < c->map->n_lines ? 2 : 3;
    if (rank > c->rank) {
        c->rank = rank;
        c->best = *place;
    }
}

static bool names_end(const il_map_column *c, il_map_end end, il_map_name *name)
{
    return !c->is_place && c->n_numbers > 0 && il_map_name_read(c->name, strlen(c->name), name) && name->end == end;
}

/* Two attributes that are alike but for the end of the band that they name. */
static void consider_bands(choice *c)
{
    const il_map *m = c->map;
    il_map_name low, high;
    for (size_t i = 0; i < m->n_columns; i++)
        for (size_t k = 0; k < m->n_columns; k++)
            if (names_end(&m->column[i], IL_MAP_END_LOW, &low) && names_end(&m->column[k], IL_MAP_END_HIGH, &high) &&
                low.rank == high.rank)
                consider(c, &(il_map_where){ IL_MAP_BAND, i, k });
}

/* Attributes of usual names, in the order of those; of one name in that of the file. */
static void consider_columns(choice *c)
{
    const il_map *m = c->map;
    enum { RANKS_MOST = 100 };
    for (int rank = 0; rank < RANKS_MOST; rank++) {
        for (size_t k = 0; k < m->n_columns; k++) {
            il_map_name name;
            const il_map_column *column = &m->column[k];
            if (!column->is_place && column->n_numbers > 0 &&
                il_map_name_read(column->name, strlen(column->name), &name) && name.rank == rank)
                consider(c, &(il_map_where){ IL_MAP_COLUMN, k, k });
        }
    }
}

static bool z_is_zero(const il_map *m)
{
    for (size_t i = 0; i < m->n_lines; i++)
        if (m->line[i].n_z > 0 && (m->line[i].z_low != 0 || m->line[i].z_high != 0))
            return false;
    return true;
}

static il_map_where choose(const il_map *m)
{
    choice c = { .map = m };
    consider_bands(&c);
    if (c.rank < 3)
        consider_columns(&c);
    if (!z_is_zero(m))
        consider(&c, &(il_map_where){ .kind = IL_MAP_Z });
    for (size_t k = 0; k < m->n_columns; k++)
        if (m->column[k].is_place)
            consider(&c, &(il_map_where){ IL_MAP_COLUMN, k, k });
    return c.best;
}

/* ---- the user's choice -------------------------------------------------------- */

static bool find_named(const il_map *m, const char *name, size_t n, size_t *at)
{
    for (int fold = 0; fold < 2; fold++) {
        for (*at = 0; *at < m->n_columns; ++*at) {
            const char *s = m->column[*at].name;
            if (strlen(s) == n && (fold ? strncasecmp(s, name, n) : strncmp(s, name, n)) == 0)
                return true;
        }
    }
    return false;
}

static bool has_z(const il_map *m)
{
    for (size_t i = 0; i < m->n_lines; i++)
        if (m->line[i].n_z > 0)
            return true;
    return false;
}

/* The place that --height names. */
static bool choose_named(const il_map *m, const char *height, il_map_where *place)
{
    const char *comma = strchr(height, ',');
    if (strcasecmp(height, "z") == 0 && has_z(m)) {
        *place = (il_map_where){ .kind = IL_MAP_Z };
        return true;
    }
    *place = (il_map_where){ .kind = IL_MAP_COLUMN };
    if (find_named(m, height, strlen(height), &place->low))
        return true;
    place->kind = IL_MAP_BAND;
    return comma && find_named(m, height, (size_t)(comma - height), &place->low) &&
           find_named(m, comma + 1, strlen(comma + 1), &place->high);
}

/* ---- every line's height ------------------------------------------------------- */

static void drop(il_map *m, il_map_line *l)
{
    if (m->place.kind == IL_MAP_Z && l->n_z > 0)
        il_map_drop(m, l, "line", "its height varies: it is no isoline");
    else if (m->place.kind == IL_MAP_BAND && l->kind != IL_MAP_RING)
        il_map_drop(m, l, "line", "is no polygon, and heights are those of bands");
    else
        il_map_drop(m, l, "line", "has no height");
}

/* Set the heights of the lines; the number of those that have one. */
static size_t set_heights(il_map *m)
{
    double relief = relief_of_z(m);
    size_t n = 0;
    for (size_t i = 0; i < m->n_lines; i++) {
        il_map_line *l = &m->line[i];
        l->height = height_at(m, &m->place, l, relief, &l->upper);
        if (isnan(l->height))
            drop(m, l);
        else
            n++;
    }
    return n;
}

/* Points by themselves, as in a table of spot heights, are no lines. */
static bool has_lines(const il_map *m)
{
    for (size_t i = 0; i < m->n_lines; i++)
        if (m->line[i].n > 1)
            return true;
    return false;
}

il_status il_map_find_heights(il_map *m, il_error *err)
{
    const char *named = m->options->map.height;
    if (!has_lines(m))
        return il_map_refuse_no_lines(m, err);
    if (named && !choose_named(m, named, &m->place))
        return il_map_refuse_name(m, named, err);
    if (!named)
        m->place = choose(m);
    if (m->place.kind == IL_MAP_NOWHERE || set_heights(m) == 0)
        return il_map_refuse_no_heights(m, err);
    return IL_OK;
}
