#include "config.h"
#include "input/map-refuse.h"
#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { LIST_MOST = 300, NAME_MOST = 40 };

/* "; attributes: ID, name"; nothing where there are none. */
static void list_attributes(const il_map *m, char *to, size_t size)
{
    size_t shown = 0, n = 0;
    *to = '\0';
    for (size_t k = 0; k < m->n_columns; k++)
        n += !m->column[k].is_place;
    for (size_t k = 0; k < m->n_columns && strlen(to) + NAME_MOST + 20 < size; k++) {
        if (m->column[k].is_place)
            continue;
        il_text_append(to, size, "%s%.*s", shown == 0 ? "; attributes: " : ", ", NAME_MOST, m->column[k].name);
        shown++;
    }
    if (m->more_columns)
        il_text_append(to, size, " and many more");
    else if (shown < n)
        il_text_append(to, size, " and %zu more", n - shown);
}

static il_status name_file(const il_map *m, const il_map_line *l, il_error *err)
{
    il_error_set_file(err, l ? il_map_file_of(m, l) : m->file[0]);
    return IL_E_INPUT;
}

il_status il_map_refuse_no_lines(const il_map *m, il_error *err)
{
    if (m->place.kind == IL_MAP_BAND)
        il_fail(err, IL_E_INPUT, 0, "its bands have no border with one another, and isolines are the borders between two of them");
    else
        il_fail(err, IL_E_INPUT, 0, "has %sno lines and no polygons, so no isolines", m->n_lines > 0 ? "single points only, " : "");
    return name_file(m, NULL, err);
}

il_status il_map_refuse_name(const il_map *m, const char *name, il_error *err)
{
    char list[LIST_MOST];
    bool is_z = strcasecmp(name, "z") == 0;
    list_attributes(m, list, sizeof list);
    il_fail(err, IL_E_INPUT, 0, "no %s '%.60s'%s (--height)%s", is_z ? "point has a" : "feature has", name,
            is_z ? " coordinate" : "", list);
    return name_file(m, NULL, err);
}

/* The first line along which z varies, or null. */
static const il_map_line *first_varying(const il_map *m)
{
    for (size_t i = 0; i < m->n_lines; i++)
        if (m->line[i].n_z > 0 && m->line[i].z_low < m->line[i].z_high)
            return &m->line[i];
    return NULL;
}

il_status il_map_refuse_no_heights(const il_map *m, il_error *err)
{
    char list[LIST_MOST], low[IL_NUMBER_MAX], high[IL_NUMBER_MAX];
    const il_map_line *l = first_varying(m);
    list_attributes(m, list, sizeof list);
    if (l) {
        il_number_format(low, l->z_low);
        il_number_format(high, l->z_high);
        il_fail(err, IL_E_INPUT, l->line, "is no isoline but a track or profile: its height varies from %s to %s%s",
                low, high, list);
    } else if (m->place.kind == IL_MAP_BAND) {
        il_fail(err, IL_E_INPUT, 0, "has no bands: no polygon has its two heights in the %s",
                il_map_place_words(m, list, sizeof list));
    } else {
        il_fail(err, IL_E_INPUT, 0, "has no heights: no attribute of a usual name with numbers, no z%s%s",
                *list ? list : " and no attributes at all", *list ? " (--height NAME names one)" : "");
    }
    return name_file(m, l, err);
}

il_status il_map_refuse_one_level(const il_map *m, double level, il_error *err)
{
    char at[IL_NUMBER_MAX], place[LIST_MOST];
    il_number_format(at, level);
    il_fail(err, IL_E_INPUT, 0, "has one level only, %s (%s), which does not tell where the ground is higher: "
            "--high left|right says on which side of the lines", at, il_map_place_words(m, place, sizeof place));
    return name_file(m, NULL, err);
}

const char *il_map_place_words(const il_map *m, char *to, size_t size)
{
    const il_map_where *p = &m->place;
    *to = '\0';
    if (p->kind == IL_MAP_Z)
        il_text_append(to, size, "z coordinates");
    else if (p->kind == IL_MAP_BAND)
        il_text_append(to, size, "attributes '%.60s' and '%.60s'", m->column[p->low].name, m->column[p->high].name);
    else
        il_text_append(to, size, "%s '%.60s'", m->column[p->low].is_place ? "the text in" : "attribute", m->column[p->low].name);
    return to;
}

const char *il_map_number_words(double value, char *to, size_t size)
{
    char text[IL_NUMBER_MAX];
    double rounded = nearbyint(value * 1e7) / 1e7;
    il_number_format(text, isfinite(rounded) ? rounded : value);
    snprintf(to, size, "%s", text);
    return to;
}

const char *il_map_box_words(const il_map *m, char *to, size_t size)
{
    char v[4][IL_NUMBER_MAX];
    for (int k = 0; k < 4; k++)
        il_map_number_words(m->box[k], v[k], sizeof v[k]);
    snprintf(to, size, "%s, %s to %s, %s", v[0], v[1], v[2], v[3]);
    return to;
}
