/* t-geographic.c - projections and measures against closed forms: on the sphere, where
 * there are some, and along the equator, meridians and parallels of the ellipsoid. */
#include "config.h"
#include "bridge/geographic.h"
#include "input/map-crs.h"
#include "input/map-project.h"
#include "test.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const il_ellipsoid wgs84 = IL_ELLIPSOID_WGS84, sphere = { 6371000, 0 };

static double rad(double degrees)
{
    return degrees * pi / 180;
}

/* J. P. Snyder, Map Projections - A Working Manual (1987), equations (8-1) to (8-3). */
static void transverse_mercator_of_the_sphere(void **state)
{
    (void)state;
    il_projection p = { .kind = IL_PROJECTION_TM, .ellipsoid = sphere, .lon0 = 10, .lat0 = 20, .k0 = 0.9996, .x0 = 500000, .y0 = 100 };
    for (double lat = -80; lat <= 80; lat += 16) {
        for (double lon = -20; lon <= 40; lon += 7.3) {
            double xy[2] = { lon, lat }, b = cos(rad(lat)) * sin(rad(lon - 10));
            assert_int_equal(il_project_points(&p, xy, 1, NULL), IL_OK);
            assert_true(fabs(xy[0] - (500000 + 0.9996 * sphere.a * atanh(b))) < 1e-7);
            assert_true(fabs(xy[1] - (100 + 0.9996 * sphere.a * (atan2(tan(rad(lat)), cos(rad(lon - 10))) - rad(20)))) < 1e-7);
        }
    }
}

/* The same, (21-5) to (21-8) for the north pole and (21-9) to (21-12) for the south. */
static void stereographic_projection_of_the_sphere(void **state)
{
    (void)state;
    for (int north = 0; north < 2; north++) {
        il_projection p = { .kind = IL_PROJECTION_STEREOGRAPHIC, .ellipsoid = sphere, .k0 = 0.994, .x0 = 2e6, .y0 = 2e6, .north = north };
        for (double lon = -180; lon <= 180; lon += 31) {
            double lat = north ? 75 : -75, xy[2] = { lon, lat }, r = 2 * 0.994 * sphere.a * tan(rad(7.5));
            assert_int_equal(il_project_points(&p, xy, 1, NULL), IL_OK);
            assert_true(fabs(xy[0] - (2e6 + r * sin(rad(lon)))) < 1e-7);
            assert_true(fabs(xy[1] - (2e6 - (north ? r : -r) * cos(rad(lon)))) < 1e-7);
        }
    }
}

/* The quarter of a meridian of WGS 84 is 10001965.7293 m; on its own meridian transverse
 * Mercator is true to scale. */
static void a_meridian_keeps_its_length(void **state)
{
    (void)state;
    il_projection p = { .kind = IL_PROJECTION_TM, .ellipsoid = wgs84, .lon0 = -75, .k0 = 1 };
    double xy[4] = { -75, 90, -75, 0 }, arc[4] = { -75, 0, -75, 90 }, length, area;
    assert_int_equal(il_project_points(&p, xy, 2, NULL), IL_OK);
    assert_true(fabs(xy[1] - 10001965.7293127) < 1e-6 && fabs(xy[3]) < 1e-9);
    il_geodesic_measure(&wgs84, arc, 2, false, &length, &area);
    assert_true(fabs(length - 10001965.7293127) < 1e-6);
    assert_true(area == 0);
}

static void far_from_the_meridian_and_near_it_are_one_map(void **state)
{
    (void)state;
    il_projection p = { .kind = IL_PROJECTION_TM, .ellipsoid = wgs84, .lon0 = 0, .k0 = 1 };
    double series[2] = { IL_TM_REACH, 48 }, exact[2] = { IL_TM_REACH, 48 };
    assert_int_equal(il_project_points(&p, series, 1, NULL), IL_OK);
    p.far = true;
    assert_int_equal(il_project_points(&p, exact, 1, NULL), IL_OK);
    assert_true(hypot(series[0] - exact[0], series[1] - exact[1]) < 1e-7);
}

static void what_is_projected_comes_back(void **state)
{
    static const il_projection all[] = {
        { .kind = IL_PROJECTION_TM, .ellipsoid = IL_ELLIPSOID_WGS84, .lon0 = 177, .k0 = 0.9996, .x0 = 5e5, .y0 = 1e7 },
        { .kind = IL_PROJECTION_TM, .ellipsoid = { 6371000, 0 }, .lon0 = -75, .k0 = 1 },
        { .kind = IL_PROJECTION_TM, .ellipsoid = IL_ELLIPSOID_WGS84, .lon0 = 180, .lat0 = 33.3, .k0 = 1, .far = true },
        { .kind = IL_PROJECTION_STEREOGRAPHIC, .ellipsoid = IL_ELLIPSOID_WGS84, .k0 = 0.994, .x0 = 2e6, .y0 = 2e6, .north = true } };
    (void)state;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        for (double far = 1; far < 60; far += all[k].far ? 20 : 10) {
            double lon = all[k].lon0 + fmin(far, all[k].far ? far : IL_TM_REACH), lat = all[k].north ? 85 : -40, xy[2] = { lon, lat };
            assert_int_equal(il_project_points(&all[k], xy, 1, NULL), IL_OK);
            assert_int_equal(il_unproject_points(&all[k], xy, 1, NULL), IL_OK);
            assert_true(fabs(xy[0] - lon) < 1e-12 && fabs(xy[1] - lat) < 1e-12); /* 0.1 um */
        }
    }
}

/* The ring of four points on the equator, and a polygon along a parallel that is cut
 * fine enough: the zone from the equator to latitude t has the area
 * pi b^2 [sin t / (1 - e^2 sin^2 t) + atanh(e sin t) / e] (Snyder, 1987, (3-12)). */
static void areas_are_those_of_the_ellipsoid(void **state)
{
    enum { N = 3600 };
    static double xy[2 * (2 * N + 2)];
    double e2 = wgs84.f * (2 - wgs84.f), e = sqrt(e2), b2 = wgs84.a * wgs84.a * (1 - e2), s = sin(rad(45));
    double zone = pi * b2 * (s / (1 - e2 * s * s) + atanh(e * s) / e), length, area;
    (void)state;
    size_t n = 0;
    for (size_t k = 0; k <= N; k++, n++) {
        xy[2 * n] = 90.0 * (double)k / N;
        xy[2 * n + 1] = 45;
    }
    xy[2 * n] = 90;
    xy[2 * n++ + 1] = 0;
    xy[2 * n] = 0;
    xy[2 * n++ + 1] = 0;
    il_geodesic_measure(&wgs84, xy, n, true, &length, &area);
    /* each chord of the parallel bulges by L^3 tan(t) / 12 R, L the 1960 m of one */
    double chord = wgs84.a * cos(rad(45)) * rad(90.0 / N), bulge = N * chord * chord * chord / 12 / 6.38e6;
    assert_true(fabs(area - bulge - zone / 4) < 1e-9 * zone);
}

static void zones_have_their_exceptions(void **state)
{
    (void)state;
    assert_int_equal(il_utm_zone(-84.2, 36.5), 16);
    assert_int_equal(il_utm_zone(5, 61), 32);   /* Norway */
    assert_int_equal(il_utm_zone(10, 78), 33);  /* Svalbard */
    assert_int_equal(il_utm_zone(180, 0), 1);
    assert_int_equal(il_utm_zone(540, 0), 1);
    assert_int_equal(il_utm_zone(0, 85), 0);
    assert_int_equal(il_utm_zone(0, -81), 0);
}

/* ---- coordinate systems ----------------------------------------------------------- */

static il_crs crs(const char *text)
{
    il_crs c;
    il_crs_parse(text, &c);
    return c;
}

static void codes_say_what_they_are(void **state)
{
    static const char *const degrees[] = { "EPSG:4326", "epsg:4326", "urn:ogc:def:crs:EPSG::4326", "urn:ogc:def:crs:EPSG:6.9:4258",
        "http://www.opengis.net/def/crs/EPSG/0/4326", "urn:ogc:def:crs:OGC:1.3:CRS84", "OGC:CRS84", "EPSG:4267", "WGS84",
        "+proj=longlat +datum=WGS84 +no_defs", "+init=epsg:4326" };
    static const char *const plane[] = { "EPSG:26915", "urn:ogc:def:crs:EPSG::27700", "EPSG:3857",
        "+proj=utm +zone=15 +datum=NAD83 +units=m",
        "+init=epsg:2154" };
    static const char *const nothing[] = { "", "EPSG:", "EPSG:x", "WGS 84 / something", "urn:x", "+proj", "[]", "GEOGCS",
        "PROJCS[\"x\"" };
    (void)state;
    for (size_t k = 0; k < sizeof degrees / sizeof *degrees; k++)
        assert_int_equal(crs(degrees[k]).kind, IL_CRS_GEOGRAPHIC);
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
        assert_int_equal(crs(plane[k]).kind, IL_CRS_PROJECTED);
    for (size_t k = 0; k < sizeof nothing / sizeof *nothing; k++)
        assert_int_equal(crs(nothing[k]).kind, IL_CRS_UNKNOWN);
    assert_int_equal(crs(NULL).kind, IL_CRS_UNKNOWN);
    assert_true(crs("EPSG:4267").ellipsoid.a == 6378206.4 && crs("EPSG:4267").epsg == 4267);
    assert_int_equal(crs("EPSG:4326+5773").epsg, 4326);
    assert_int_equal(crs("urn:ogc:def:crs,crs:EPSG::4326,crs:EPSG::5773").epsg, 4326);
    assert_int_equal(crs("urn:ogc:def:crs:EPSG:6.9:4326").epsg, 4326);
    assert_int_equal(crs("http://www.opengis.net/def/crs/EPSG/0/4326").epsg, 4326);
    assert_int_equal(crs("+init=epsg:4326 +no_defs").epsg, 4326);
    assert_true(crs("+proj=lcc +units=us-ft").us_foot && crs("+proj=lcc +units=us-ft").unit == IL_UNIT_FT);
}

static void well_known_text_says_units_and_ellipsoids(void **state)
{
    (void)state;
    il_crs c = crs("PROJCS[\"a\",GEOGCS[\"b\",DATUM[\"c\",SPHEROID[\"Bessel_1841\",6377397.155,299.1528128]],PRIMEM[\"Greenwich\",0.0],"
                   "UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Krovak\"],PARAMETER[\"X_Scale\",-1.0],UNIT[\"Meter\",1.0]],"
                   "VERTCS[\"Baltic\",VDATUM[\"d\"],PARAMETER[\"Vertical_Shift\",0.0],PARAMETER[\"Direction\",-1.0],"
                   "UNIT[\"Foot\",0.3048]]");
    assert_int_equal(c.kind, IL_CRS_PROJECTED);
    assert_true(c.has_unit && c.unit == IL_UNIT_M && c.has_z_unit && c.z_unit == IL_UNIT_FT && c.down && !c.us_foot && !c.odd_unit);
    assert_true(c.ellipsoid.a == 6377397.155 && c.ellipsoid.f == 1 / 299.1528128);
    c = crs("GEOGCS[\"NTF (Paris)\",DATUM[\"x\",SPHEROID[\"Clarke 1880\",6378249.2,293.466]],UNIT[\"grad\",0.0157079632679489]]");
    assert_true(c.kind == IL_CRS_GEOGRAPHIC && c.odd_unit);
    c = crs("GEOGCRS[\"WGS \"\"84\"\"\",DATUM[\"x\",ELLIPSOID[\"WGS "
        "84\",6378137,298.257223563,LENGTHUNIT[\"metre\",1]]],CS[ellipsoidal,2],"
            "AXIS[\"latitude\",north],ANGLEUNIT[\"degree\",0.0174532925199433],ID[\"EPSG\",4326]]");
    assert_true(c.kind == IL_CRS_GEOGRAPHIC && c.epsg == 4326 && !c.has_unit && !c.odd_unit);
    c = crs("PROJCRS[\"x\",BASEGEOGCRS[\"y\",ID[\"EPSG\",4269]],CS[Cartesian,2],AXIS[\"E\",east,LENGTHUNIT[\"US survey "
        "foot\",0.304800609601219]],"
            "ID[\"EPSG\",2263]]");
    assert_true(c.kind == IL_CRS_PROJECTED && c.epsg == 2263 && c.has_unit && c.us_foot && c.unit == IL_UNIT_FT);
    c = crs("COMPD_CS[\"z\",PROJCS[\"x\",UNIT[\"link\",0.201168]],VERT_CS[\"v\",UNIT[\"metre\",1],AXIS[\"Depth\",DOWN]]]");
    assert_true(c.kind == IL_CRS_PROJECTED && c.odd_unit && !c.has_unit && c.has_z_unit && c.z_unit == IL_UNIT_M && c.down);
}

static void a_deep_tree_is_no_system(void **state)
{
    static char text[10000];
    (void)state;
    for (size_t k = 0; k + 2 < sizeof text; k += 2)
        memcpy(text + k, "A[", 2);
    assert_int_equal(crs(text).kind, IL_CRS_UNKNOWN);
}

static void words_agree_where_they_mean_the_same(void **state)
{
    (void)state;
    il_crs a = crs("EPSG:4326"), b = crs("GEOGCS[\"x\",SPHEROID[\"WGS_1984\",6378137.0,298.257223563]]"), c = crs("EPSG:4267"),
        d = crs("EPSG:27700");
    assert_true(il_crs_agree(&a, &b) && !il_crs_agree(&a, &c) && !il_crs_agree(&b, &c) && !il_crs_agree(&a, &d));
    il_crs zone10 = crs("PROJCS[\"NAD_1983_UTM_Zone_10N\",GEOGCS[\"x\",SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],"
                        "PARAMETER[\"Central_Meridian\",-123.0],PARAMETER[\"False_Northing\",0],UNIT[\"Meter\",1.0]]"),
        zone11 = crs("PROJCS[\"NAD_1983_UTM_Zone_11N\",GEOGCS[\"x\",SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],"
                     "PARAMETER[\"Central_Meridian\",-117.0],PARAMETER[\"False_Northing\",0],UNIT[\"Meter\",1.0]]"),
        same = crs("PROJCRS[\"NAD83 / UTM zone 10N\",CONVERSION[\"UTM\",PARAMETER[\"Longitude of natural origin\",-123]]]"),
        proj = crs("+proj=utm +zone=10 +ellps=GRS80 +units=m"), south = crs("+proj=utm +zone=10 +south +ellps=GRS80"),
        unknown = crs("EPSG:4999");
    assert_true(!il_crs_agree(&zone10, &zone11) && il_crs_agree(&zone10, &same) && !il_crs_agree(&zone11, &same));
    assert_true(il_crs_agree(&zone10, &proj) && !il_crs_agree(&zone11, &proj) && !il_crs_agree(&zone10, &south));
    assert_true(!il_crs_agree(&a, &unknown));
    char to[40];
    assert_string_equal(il_crs_short("EPSG:25832+7837", to, sizeof to), "EPSG:25832+7837");
    assert_string_equal(il_crs_short("urn:ogc:def:crs:EPSG::27700", to, sizeof to), "EPSG:27700");
    assert_string_equal(il_crs_short("EPSG:4326", to, sizeof to), "EPSG:4326");
    assert_string_equal(il_crs_short("whatever", to, sizeof to), "whatever");
    assert_null(il_crs_short(NULL, to, sizeof to));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transverse_mercator_of_the_sphere),
        cmocka_unit_test(stereographic_projection_of_the_sphere),
        cmocka_unit_test(a_meridian_keeps_its_length),
        cmocka_unit_test(far_from_the_meridian_and_near_it_are_one_map),
        cmocka_unit_test(what_is_projected_comes_back),
        cmocka_unit_test(areas_are_those_of_the_ellipsoid),
        cmocka_unit_test(zones_have_their_exceptions),
        cmocka_unit_test(codes_say_what_they_are),
        cmocka_unit_test(well_known_text_says_units_and_ellipsoids),
        cmocka_unit_test(a_deep_tree_is_no_system),
        cmocka_unit_test(words_agree_where_they_mean_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
