/* map-plane.c - which projection a map in degrees gets. */
#include "config.h"
#include "base/number.h"
#include "input/map-project.h"
#include "input/map-refuse.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Degrees that a map may leave its zone by; half the width that one plane takes; from
 * where on a map around the world lies around a pole. */
static const double zone_margin = 0.5, half_width_most = 60, polar_latitude = 45;

static const il_ellipsoid wgs84 = IL_ELLIPSOID_WGS84;

static bool is_wgs84(const il_ellipsoid *e)
{
    return e->a == wgs84.a && fabs(e->f - wgs84.f) < 1e-12;
}

/* "+a=... +rf=..." of E, or WGS 84 by its name. */
static void ellipsoid_words(const il_ellipsoid *e, char *to, size_t size)
{
    char a[IL_NUMBER_MAX], rf[IL_NUMBER_MAX];
    if (is_wgs84(e)) {
        snprintf(to, size, "+datum=WGS84");
        return;
    }
    il_number_format(a, e->a);
    il_number_format(rf, e->f > 0 ? nearbyint(1e9 / e->f) / 1e9 : 0);
    snprintf(to, size, e->f > 0 ? "+a=%s +rf=%s" : "+R=%s", a, rf);
}

/* The scale of UPS at the pole is 0.994, its pole lies at 2000 km in both directions. */
static void choose_ups(const il_map *m, bool north, il_projection *p, char *name, size_t size)
{
    char e[100];
    *p = (il_projection){ .kind = IL_PROJECTION_STEREOGRAPHIC, .ellipsoid = m->meaning.ellipsoid, .k0 = 0.994,
                          .x0 = 2e6, .y0 = 2e6, .north = north };
    ellipsoid_words(&p->ellipsoid, e, sizeof e);
    if (is_wgs84(&p->ellipsoid))
        snprintf(name, size, "EPSG:%d", north ? 5041 : 5042);
    else
        snprintf(name, size, "+proj=stere +lat_0=%d +k=0.994 +x_0=2000000 +y_0=2000000 %s +units=m", north ? 90 : -90, e);
}

static double meridian_of(int zone)
{
    return 6.0 * zone - 183;
}

/* Meridian LON in the turn of longitudes in which MIDDLE lies. */
static double in_turn(double lon, double middle)
{
    return lon + 360 * nearbyint((middle - lon) / 360);
}

static void choose_utm(const il_map *m, int zone, double middle, bool north, il_projection *p, char *name, size_t size)
{
    char e[100];
    *p = (il_projection){ .kind = IL_PROJECTION_TM, .ellipsoid = m->meaning.ellipsoid, .k0 = 0.9996,
                          .lon0 = in_turn(meridian_of(zone), middle), .x0 = 500000, .y0 = north ? 0 : 1e7, .north = north };
    ellipsoid_words(&p->ellipsoid, e, sizeof e);
    if (is_wgs84(&p->ellipsoid))
        snprintf(name, size, "EPSG:%d", (north ? 32600 : 32700) + zone);
    else
        snprintf(name, size, "+proj=utm +zone=%d%s %s +units=m", zone, north ? "" : " +south", e);
}

/* The origin is rounded to 1e-6 degrees, so that its name says it in full. */
static void choose_tm(const il_map *m, double lon, double lat, il_projection *p, char *name, size_t size)
{
    char e[100], at_lon[IL_NUMBER_MAX], at_lat[IL_NUMBER_MAX];
    double lon0 = nearbyint(lon * 1e6) / 1e6, lat0 = nearbyint(lat * 1e6) / 1e6;
    *p = (il_projection){ .kind = IL_PROJECTION_TM, .ellipsoid = m->meaning.ellipsoid, .k0 = 1,
                          .lon0 = lon0, .lat0 = lat0, .north = lat >= 0 };
    ellipsoid_words(&p->ellipsoid, e, sizeof e);
    il_number_format(at_lon, lon0 > 180 ? nearbyint((lon0 - 360) * 1e6) / 1e6 : lon0);
    il_number_format(at_lat, lat0);
    snprintf(name, size, "+proj=tmerc +lat_0=%s +lon_0=%s +k=1 +x_0=0 +y_0=0 %s +units=m", at_lat, at_lon, e);
}

/* Does the map lie in its ZONE?  Those of Norway and Svalbard are of other widths. */
static bool fits_zone(const il_map *m, int zone, double lat)
{
    double middle = (m->box[0] + m->box[2]) / 2, meridian = in_turn(meridian_of(zone), middle);
    bool within = m->box[0] >= meridian - 3 - zone_margin && m->box[2] <= meridian + 3 + zone_margin;
    return within || (il_utm_zone(m->box[0], lat) == zone && il_utm_zone(m->box[2], lat) == zone && m->box[2] - m->box[0] < 13);
}

il_status il_map_choose_projection(const il_map *m, il_projection *p, char *name, size_t size, il_error *err)
{
    const double *b = m->box;
    double lon = (b[0] + b[2]) / 2, lat = (b[1] + b[3]) / 2, half = (b[2] - b[0]) / 2;
    char words[IL_NUMBER_MAX];
    int zone = il_utm_zone(lon, lat);
    bool utm = m->options->map.project == IL_PROJECT_UTM, tm = m->options->map.project == IL_PROJECT_TM;
    bool around_pole = half > half_width_most && (b[1] > polar_latitude || b[3] < -polar_latitude);
    if (!tm && (zone == 0 || around_pole)) {
        choose_ups(m, lat > 0, p, name, size);
        return IL_OK;
    }
    if (half > half_width_most)
        return il_fail(err, IL_E_INPUT, 0, "the map is %s degrees wide, and no projection here takes more than 120 "
                       "(--project none keeps degrees)", il_map_number_words(2 * half, words, sizeof words));
    if (!tm && (utm || fits_zone(m, zone, lat)))
        choose_utm(m, zone, lon, lat >= 0, p, name, size);
    else
        choose_tm(m, lon, lat, p, name, size);
    p->far = il_projection_is_far(p, b[0], b[2]);
    return IL_OK;
}
