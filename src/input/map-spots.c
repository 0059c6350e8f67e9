#include "config.h"
#include "input/map-spots.h"
#include "base/alloc.h"

#include <math.h>

/* Longitudes from the meridian of an exact transverse Mercator that have a place in it with
 * some sense. */
static const double far_most = 80;

static void skip(const il_map *m, const il_spot *s, const char *why)
{
    il_report_skip(m->report, m->file[s->file], s->line, "point", why);
}

il_status il_map_spots_add(il_map *m, const il_map_line *l, double x, double y, double z, long line, il_error *err)
{
    if (!il_grow(&m->spot, &m->cap_spots, m->n_spots + 1, sizeof *m->spot))
        return il_fail_nomem(err);
    m->spot[m->n_spots++] = (il_spot){ .x = x + 0.0, .y = y + 0.0, .z = z, .line = line,
                                       .feature = il_map_feature_of(m, l), .file = l->file };
    return IL_OK;
}

/* ---- degrees ----------------------------------------------------------------------- */

void il_map_spots_turn(il_map *m)
{
    double middle = (m->box[0] + m->box[2]) / 2;
    size_t n = 0;
    for (size_t i = 0; i < m->n_spots; i++) {
        il_spot *s = &m->spot[i];
        if (!(fabs(s->x) <= 360 && fabs(s->y) <= 90)) {
            skip(m, s, "is no longitude and latitude");
            continue;
        }
        if (fabs(s->x - middle) > 180)
            s->x += 360 * nearbyint((middle - s->x) / 360);
        m->spot[n++] = *s;
    }
    m->n_spots = n;
}

/* ---- heights ------------------------------------------------------------------------ */

/* What S has at the place of the lines, NAN when that is nothing. */
static double height_at_place(const il_map *m, const il_spot *s)
{
    if (m->place.kind != IL_MAP_COLUMN)
        return NAN;
    const il_map_column *c = &m->column[m->place.low];
    size_t feature = m->first_feature[s->file] + (size_t)s->feature - 1;
    return feature < c->n ? c->value[feature] : NAN;
}

/* Are the z of points that have nothing else all 0, as drawings have them for nothing? */
static bool z_is_zero(const il_map *m)
{
    for (size_t i = 0; i < m->n_spots; i++) {
        double z = m->spot[i].z;
        if (!isnan(z) && z != 0 && isnan(height_at_place(m, &m->spot[i])))
            return false;
    }
    return true;
}

il_status il_map_spots_convert(il_map *m, const il_map_scale *by_place, const il_map_scale *by_z, il_error *err)
{
    bool zero = z_is_zero(m);
    size_t n = 0;
    il_status st = IL_OK;
    for (size_t i = 0; i < m->n_spots && st == IL_OK; i++) {
        il_spot s = m->spot[i];
        double at_place = height_at_place(m, &s);
        bool has_own = isnan(at_place) && !zero;
        s.z = has_own ? s.z : at_place;
        if (isnan(s.z)) {
            skip(m, &s, "a point by itself is no isoline");
            continue;
        }
        st = il_map_scale_height(has_own ? by_z : by_place, &s.z, m->file[s.file], s.line, err);
        m->spot[n++] = s;
    }
    m->n_spots = n;
    return st;
}

/* ---- the plane ------------------------------------------------------------------------ */

static bool has_place(const il_projection *p, const il_spot *s)
{
    if (p->kind == IL_PROJECTION_STEREOGRAPHIC)
        return p->north ? s->y > 0 : s->y < 0;
    return fabs(s->x - p->lon0) <= (p->far ? far_most : IL_TM_REACH);
}

il_status il_map_spots_project(il_map *m, const il_projection *p, il_error *err)
{
    size_t n = 0;
    il_status st = IL_OK;
    for (size_t i = 0; i < m->n_spots && st == IL_OK; i++) {
        il_spot s = m->spot[i];
        double xy[2] = { s.x, s.y };
        if (!has_place(p, &s)) {
            skip(m, &s, "lies too far from the lines for their projection");
            continue;
        }
        st = il_project_points(p, xy, 1, err);
        s.x = xy[0] + 0.0;
        s.y = xy[1] + 0.0;
        m->spot[n++] = s;
    }
    m->n_spots = n;
    return st;
}
