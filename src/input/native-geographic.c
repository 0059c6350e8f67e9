/* native-geographic.c - maps of the native format that were in degrees. */
#include "config.h"
#include "input/native.h"

#include <math.h>

static const double lon_most = 720, lat_most = 90;

il_status il_native_take_geographic(il_native *n)
{
    double *g = n->head.geographic;
    il_status st = il_scan_numbers(&n->at, g, 4, n->err);
    n->geographic_line = n->at.line;
    if (st != IL_OK)
        return st;
    if (!(g[0] >= -lon_most && g[0] <= g[2] && g[2] <= lon_most && g[2] - g[0] <= 360))
        return il_native_fail(n, "the longitudes are no range of 360 degrees at most, from -720 to 720");
    if (!(g[1] >= -lat_most && g[1] <= g[3] && g[3] <= lat_most))
        return il_native_fail(n, "the latitudes are no range, from -90 to 90");
    n->head.has_geographic = true;
    return IL_OK;
}

static il_status check_numbers(il_native *n, const il_projection *p)
{
    const il_ellipsoid *e = &p->ellipsoid;
    if (!(e->a > 1e6 && e->a < 1e7 && e->f > -0.01 && e->f < 0.01))
        return il_native_fail(n, "the ellipsoid is none of a planet: radius above 1e6 and below 1e7, flattening within 0.01");
    if (!(p->lon0 >= -lon_most && p->lon0 <= lon_most && p->lat0 >= -lat_most && p->lat0 <= lat_most))
        return il_native_fail(n, "the origin has no longitude from -720 to 720, or no latitude from -90 to 90");
    if (!(p->k0 >= 0.1 && p->k0 <= 10))
        return il_native_fail(n, "the scale is not from 0.1 to 10");
    if (p->kind == IL_PROJECTION_STEREOGRAPHIC && fabs(p->lat0) != lat_most)
        return il_native_fail(n, "the origin of a polar projection is no pole: its latitude is 90 or -90");
    return IL_OK;
}

il_status il_native_take_projection(il_native *n)
{
    static const char *const kinds[] = { "tm", "polar", NULL };
    double v[7];
    int kind = 0;
    il_projection *p = &n->head.projection;
    il_status st = il_scan_choice(&n->at, kinds, "a projection: tm or polar", &kind, n->err);
    n->projection_line = n->at.line;
    if (st == IL_OK)
        st = il_scan_numbers(&n->at, v, 7, n->err);
    if (st != IL_OK)
        return st;
    *p = (il_projection){ .kind = kind == 0 ? IL_PROJECTION_TM : IL_PROJECTION_STEREOGRAPHIC, .ellipsoid = { v[0], v[1] },
                          .lon0 = v[2], .lat0 = v[3], .k0 = v[4], .x0 = v[5], .y0 = v[6], .north = v[3] >= 0 };
    return check_numbers(n, p);
}

/* Places that the projection does not have, or has infinitely far away. */
static il_status check_reach(il_native *n)
{
    const il_projection *p = &n->head.projection;
    const double *g = n->head.geographic;
    bool polar = p->kind == IL_PROJECTION_STEREOGRAPHIC;
    if (polar && !(p->north ? g[1] >= 0 : g[3] <= 0))
        return il_native_fail_at(n, n->projection_line, "the map does not lie on the pole's side of the equator");
    if (!polar && !(g[0] > p->lon0 - 90 && g[2] < p->lon0 + 90))
        return il_native_fail_at(n, n->projection_line, "the map does not lie within 90 degrees of the projection's meridian");
    return IL_OK;
}

/* Numbers that the user says are in another unit are not those that were projected. */
il_status il_native_check_geographic(il_native *n)
{
    il_stack_head *h = &n->head;
    long line = n->geographic_line > 0 ? n->geographic_line : n->projection_line;
    if (line == 0)
        return IL_OK;
    if (n->geographic_line == 0 || n->projection_line == 0)
        return il_native_fail_at(n, line, "%s", n->geographic_line > 0 ? "'geographic' stands without 'projection'"
                                                                       : "'projection' stands without 'geographic'");
    if (h->kind != IL_KIND_TERRAIN)
        return il_native_fail_at(n, line, "'geographic' stands in a stack that is no terrain");
    if (n->unit == IL_UNIT_DEG)
        return il_native_fail_at(n, line, "'geographic' stands in a stack that is in degrees");
    il_status st = check_reach(n);
    h->projection.far = il_projection_is_far(&h->projection, h->geographic[0], h->geographic[2]);
    if (st == IL_OK && h->unit != n->unit) {
        h->has_geographic = false;
        il_report_note(n->report, "how the map was projected is dropped: its coordinates are not in %s", il_unit_name(h->unit));
    }
    return st;
}
