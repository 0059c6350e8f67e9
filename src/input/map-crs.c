#include "config.h"
#include "input/map-crs.h"
#include "base/number.h"
#include "base/text.h"
#include "input/map-wkt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const il_ellipsoid wgs84 = IL_ELLIPSOID_WGS84, grs80 = { 6378137.0, 1 / 298.257222101 },
                          clarke66 = { 6378206.4, 1 / 294.978698213898 }, bessel = { 6377397.155, 1 / 299.1528128 },
                          hayford = { 6378388.0, 1 / 297.0 }, airy = { 6377563.396, 1 / 299.3249646 };

/* The geographic systems that files name most (EPSG's numbers for them). */
static const struct { long epsg; const il_ellipsoid *ellipsoid; } geographic[] = {
    { 4326, &wgs84 }, { 4979, &wgs84 }, { 4322, &wgs84 }, { 9057, &wgs84 }, { 4269, &grs80 }, { 6318, &grs80 },
    { 6319, &grs80 }, { 4258, &grs80 }, { 4937, &grs80 }, { 4283, &grs80 }, { 7844, &grs80 }, { 4167, &grs80 },
    { 4617, &grs80 }, { 4612, &grs80 }, { 6668, &grs80 }, { 4674, &grs80 }, { 4171, &grs80 }, { 4490, &grs80 },
    { 4267, &clarke66 }, { 4314, &bessel }, { 4156, &bessel }, { 4289, &bessel }, { 4301, &bessel },
    { 4230, &hayford }, { 4277, &airy } };

/* Words of PROJ for ellipsoids, and for datums that are named by one. */
static const struct { const char *word; const il_ellipsoid *ellipsoid; } named[] = {
    { "WGS84", &wgs84 }, { "GRS80", &grs80 }, { "clrk66", &clarke66 }, { "bessel", &bessel }, { "intl", &hayford },
    { "airy", &airy }, { "NAD83", &grs80 }, { "NAD27", &clarke66 } };

/* ---- codes ----------------------------------------------------------------- */

static void set_ellipsoid(il_crs *c, const il_ellipsoid *e)
{
    c->has_ellipsoid = true;
    c->ellipsoid = *e;
}

/* The zones of UTM on WGS 84, ETRS89, NAD83, NAD27 and ED50, and Web Mercator. */
static bool is_metric(long code)
{
    static const long ranges[][2] = { { 32601, 32660 }, { 32701, 32760 }, { 25828, 25838 }, { 26901, 26923 },
                                      { 26701, 26722 }, { 23028, 23038 }, { 3857, 3857 } };
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        if (code >= ranges[k][0] && code <= ranges[k][1])
            return true;
    return false;
}

/* EPSG numbers its geographic systems from 4000 on. */
static void take_epsg(long code, il_crs *c)
{
    c->epsg = code;
    for (size_t k = 0; k < sizeof geographic / sizeof *geographic; k++) {
        if (geographic[k].epsg == code) {
            c->kind = IL_CRS_GEOGRAPHIC;
            set_ellipsoid(c, geographic[k].ellipsoid);
        }
    }
    if (c->kind == IL_CRS_UNKNOWN && (code < 4001 || code > 4999))
        c->kind = IL_CRS_PROJECTED;
    c->has_unit = is_metric(code);
    c->unit = IL_UNIT_M;
}

/* The number that S[0..N) begins with, up to AT its end or a comma or plus; or 0. */
static long number_at(const char *s)
{
    size_t n = strspn(s, "0123456789");
    return n > 0 && n <= 7 && strchr(",+", s[n]) ? strtol(s, NULL, 10) : 0;
}

/* "EPSG:4326", "urn:ogc:def:crs:EPSG:6.9:4326", "http://www.opengis.net/def/crs/EPSG/0/4326";
 * 0 when TEXT is nothing of the kind.  Behind that of the plane a code of heights may
 * stand: "EPSG:25832+7837", "urn:ogc:def:crs,crs:EPSG::4326,crs:EPSG::5773". */
static long epsg_of(const char *text)
{
    const char *urn = strncasecmp(text, "urn:", 4) == 0 ? strstr(text, "EPSG:") : NULL;
    const char *url = strncasecmp(text, "http", 4) == 0 ? strstr(text, "/EPSG/") : NULL;
    if (strncasecmp(text, "EPSG:", 5) == 0)
        return number_at(text + 5);
    const char *version = urn ? urn + 5 : url ? url + 6 : "", *code = strpbrk(version, urn ? ":" : "/");
    return code ? number_at(code + 1) : 0;
}

static bool is_crs84(const char *text)
{
    size_t n = strlen(text);
    return n >= 5 && strcasecmp(text + n - 5, "CRS84") == 0;
}

/* ---- PROJ strings ----------------------------------------------------------- */

/* The value of +KEY= in TEXT, *N bytes; null when it is not there. */
static const char *proj_value(const char *text, const char *key, size_t *n)
{
    size_t length = strlen(key);
    for (const char *p = strchr(text, '+'); p; p = strchr(p + 1, '+')) {
        if (strncmp(p + 1, key, length) == 0 && p[1 + length] == '=') {
            p += length + 2;
            *n = strcspn(p, " \t");
            return p;
        }
    }
    return NULL;
}

static bool proj_is(const char *text, const char *key, const char *value)
{
    size_t n;
    const char *found = proj_value(text, key, &n);
    return found && n == strlen(value) && strncasecmp(found, value, n) == 0;
}

static bool proj_number(const char *text, const char *key, double *value)
{
    size_t n;
    const char *found = proj_value(text, key, &n);
    return found && n > 0 && il_number_parse(found, n, value) == n;
}

static void take_proj_ellipsoid(const char *text, il_crs *c)
{
    double a, rf;
    for (size_t k = 0; k < sizeof named / sizeof *named; k++)
        if (proj_is(text, "ellps", named[k].word) || proj_is(text, "datum", named[k].word))
            set_ellipsoid(c, named[k].ellipsoid);
    if (proj_number(text, "a", &a) && proj_number(text, "rf", &rf) && a > 1e6 && a < 1e7 && rf > 100)
        set_ellipsoid(c, &(il_ellipsoid){ a, 1 / rf });
}

static void take_proj_unit(const char *text, il_crs *c)
{
    size_t n;
    const char *unit = proj_value(text, "units", &n);
    double factor;
    c->us_foot = proj_is(text, "units", "us-ft");
    c->has_unit = unit && (c->us_foot || il_unit_parse(unit, n, &c->unit));
    if (c->us_foot)
        c->unit = IL_UNIT_FT;
    else if (proj_number(text, "to_meter", &factor) && factor != 1)
        c->odd_unit = true;
}

/* Zones of UTM are numbered from the antimeridian on. */
static void take_proj_origin(const char *text, il_crs *c)
{
    double zone;
    proj_number(text, "lon_0", &c->origin[0]);
    proj_number(text, "lat_0", &c->origin[1]);
    if (!proj_is(text, "proj", "utm") || !proj_number(text, "zone", &zone))
        return;
    c->origin[0] = 6 * zone - 183;
    c->origin[3] = strstr(text, "+south") ? 1e7 : 0;
}

static bool parse_proj(const char *text, il_crs *c)
{
    if (!strstr(text, "+proj=") && !strstr(text, "+init="))
        return false;
    size_t n;
    const char *code = proj_value(text, "init", &n);
    if (code) {
        long number = strncasecmp(code, "epsg:", 5) == 0 ? strtol(code + 5, NULL, 10) : 0;
        if (number > 0)
            take_epsg(number, c);
        return true;
    }
    bool degrees = proj_is(text, "proj", "longlat") || proj_is(text, "proj", "latlong") || proj_is(text, "proj", "lonlat");
    c->kind = degrees ? IL_CRS_GEOGRAPHIC : IL_CRS_PROJECTED;
    take_proj_ellipsoid(text, c);
    if (!degrees) {
        take_proj_unit(text, c);
        take_proj_origin(text, c);
    }
    return true;
}

/* ---- any words ------------------------------------------------------------- */

static const il_crs no_crs = { .ellipsoid = IL_ELLIPSOID_WGS84, .origin = { NAN, NAN, NAN, NAN } };

void il_crs_parse(const char *text, il_crs *c)
{
    *c = no_crs;
    if (!text)
        return;
    long code = epsg_of(text);
    if (code > 0) {
        take_epsg(code, c);
    } else if (is_crs84(text) || strcasecmp(text, "WGS84") == 0 || strcasecmp(text, "WGS 84") == 0) {
        c->kind = IL_CRS_GEOGRAPHIC;
        c->epsg = 4326;
        set_ellipsoid(c, &wgs84);
    } else if (!parse_proj(text, c) && !il_crs_parse_wkt(text, c)) {
        *c = no_crs;
    }
}

const char *il_crs_short(const char *text, char *to, size_t size)
{
    long code = text && !strpbrk(text, "+,") ? epsg_of(text) : 0;
    if (code == 0)
        return text && is_crs84(text) ? "OGC:CRS84" : text;
    snprintf(to, size, "EPSG:%ld", code);
    return to;
}

static bool same_origin(const il_crs *x, const il_crs *y)
{
    for (size_t k = 0; k < sizeof x->origin / sizeof *x->origin; k++)
        if (fabs(x->origin[k] - y->origin[k]) > 1e-6)
            return false;
    return true;
}

bool il_crs_agree(const il_crs *x, const il_crs *y)
{
    if (x->epsg && y->epsg && x->epsg != y->epsg)
        return false;
    if (x->kind == IL_CRS_UNKNOWN || y->kind == IL_CRS_UNKNOWN)
        return true;
    bool unit = !x->has_unit || !y->has_unit || x->unit == y->unit;
    bool ellipsoid = !x->has_ellipsoid || !y->has_ellipsoid ||
                     (x->ellipsoid.a == y->ellipsoid.a && fabs(x->ellipsoid.f - y->ellipsoid.f) < 1e-9);
    return x->kind == y->kind && unit && ellipsoid && same_origin(x, y);
}
