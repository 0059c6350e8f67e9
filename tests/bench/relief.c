/* relief.c - isolines made for measuring, on standard output.
 *
 *     relief [-f FORM] HILLS LEVELS POINTS
 *
 * HILLS hills side by side with LEVELS isolines of POINTS points each: circles with
 * harmonics whose phases drift from level to level, in metres, or in degrees where
 * the form has no other, every one a feature with its height in `elev`.
 * FORM: geojson (a collection with as many decimals as a double has, as GDAL writes
 * it, the default), geojsonseq (a feature a line, 7 decimals), dxf (LWPOLYLINE), kml, gpx
 * (lines with z), gmt (a segment a line), wkt (a table, a row a line), all as GDAL writes
 * them; xyz (a table, a row a point), bln; shp (PolyLineZ, which needs no table for its
 * heights). */
#include "config.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HARMONICS = 5, INTERVAL = 10 };

static const double TURN = 6.283185307179586, APART = 5000, DEGREES = 1e-5;

/* What stands before and behind all features and between two of them, before and
 * behind the height, between two points and behind the last; and how a point is: x, y
 * and height.  COUNTS: the number of points stands before it all; FEATURE is null where
 * the height stands with the points only. */
static const struct form {
    const char *name, *begin, *between, *end, *feature, *lines, *comma, *tail, *point;
    bool is_degrees, counts;
} forms[] = {
    { "geojson", "{\n\"type\": \"FeatureCollection\",\n\"name\": \"contour\",\n\"features\": [\n", ",\n", "\n]\n}\n",
      "{ \"type\": \"Feature\", \"properties\": { \"ID\": 0, \"elev\": ",
      " }, \"geometry\": { \"type\": \"LineString\", \"coordinates\": [ ", ", ", " ] } }", "[ %.15g, %.15g ]", false, false },
    { "geojsonseq", "", "\n", "\n", "{ \"type\": \"Feature\", \"properties\": { \"ID\": 0, \"elev\": ",
      " }, \"geometry\": { \"type\": \"LineString\", \"coordinates\": [ ", ", ", " ] } }", "[ %.7f, %.7f ]", false, false },
    { "dxf", "  0\nSECTION\n  2\nENTITIES\n", "", "  0\nENDSEC\n  0\nEOF\n",
      "  0\nLWPOLYLINE\n  8\nCONTOURS\n 70\n0\n 38\n", "\n", "", "", " 10\n%.15g\n 20\n%.15g\n", false, false },
    { "kml", "<?xml version=\"1.0\" encoding=\"utf-8\" ?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n", "\n",
      "\n</Document></kml>\n", "<Placemark>\n<ExtendedData><SchemaData schemaUrl=\"#contour\"><SimpleData name=\"elev\">",
      "</SimpleData></SchemaData></ExtendedData>\n<LineString><altitudeMode>absolute</altitudeMode><coordinates>", " ",
      "</coordinates></LineString></Placemark>", "%.15g,%.15g,%d", true, false },
    { "gpx", "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n", "\n", "\n</gpx>\n",
      "<trk>\n  <extensions>\n    <ogr:elev>", "</ogr:elev>\n  </extensions>\n  <trkseg>\n", "\n", "\n  </trkseg>\n</trk>",
      "    <trkpt lat=\"%2$.17g\" lon=\"%1$.17g\">\n      <ele>%3$d</ele>\n    </trkpt>", true, false },
    { "gmt", "", "", "", "> -Z", "\n", "\n", "\n", "%.15g %.15g", false, false },
    { "wkt", "ID,elev,WKT\n", "", "", "0,", ",\"LINESTRING (", ",", ")\"\n", "%.15g %.15g", false, false },
    { "xyz", "x,y,elev\n", "", "", NULL, "", "\n", "\n", "%.15g,%.15g,%d.0", false, false },
    { "bln", "", "", "", ",1,", "\n", "\n", "\n", "%.15g,%.15g", false, true },
};
enum { N_FORMS = sizeof forms / sizeof *forms };

/* Point K of a level.  Half of all isolines come back to their first point, the rest are cut. */
static void find_point(int hill, int level, int levels, int points, int k, double *xy)
{
    double r = 0.45 * APART * (levels - level) / levels;
    int last = level % 2 ? points : points - 1;
    double turn = TURN * k / last, bend = 1;
    for (int h = 2; h <= HARMONICS; h++)
        bend += 0.04 / h * sin(h * turn + 0.3 * hill * h + 0.02 * level * h);
    double end = k == last ? 0 : turn;
    xy[0] = 400000 + APART * hill + r * bend * cos(end);
    xy[1] = 5100000 + r * bend * sin(end);
}

static void put_line(const struct form *f, int hill, int level, int levels, int points)
{
    double scale = f->is_degrees ? DEGREES : 1;
    for (int k = 0; k < points; k++) {
        double xy[2];
        find_point(hill, level, levels, points, k, xy);
        fputs(k > 0 ? f->comma : "", stdout);
        printf(f->point, scale * xy[0], scale * xy[1], INTERVAL * level);
    }
}

static void put_text(const struct form *f, int hills, int levels, int points)
{
    fputs(f->begin, stdout);
    for (int hill = 0; hill < hills; hill++) {
        for (int level = 0; level < levels; level++) {
            fputs(hill + level > 0 ? f->between : "", stdout);
            if (f->counts)
                printf("%d", points);
            if (f->feature)
                printf("%s%d.0%s", f->feature, INTERVAL * level, f->lines);
            put_line(f, hill, level, levels, points);
            fputs(f->tail, stdout);
        }
    }
    fputs(f->end, stdout);
}

/* ---- shapefiles, on machines whose least byte comes first ------------------------------ */

static void put_big(unsigned value)
{
    for (int k = 24; k >= 0; k -= 8)
        putchar((int)(value >> k & 255));
}

static void put_ints(const int *value, size_t n)
{
    fwrite(value, sizeof *value, n, stdout);
}

static void put_doubles(double value, int n)
{
    for (int k = 0; k < n; k++)
        fwrite(&value, sizeof value, 1, stdout);
}

/* Type, box, one part, its points, the range of z and all of them. */
static void put_record(unsigned number, unsigned n_bytes, int hill, int level, int levels, int points)
{
    const int type = 13, counts[] = { 1, points, 0 };
    put_big(number);
    put_big(n_bytes / 2);
    put_ints(&type, 1);
    put_doubles(0, 4);
    put_ints(counts, 3);
    for (int k = 0; k < points; k++) {
        double xy[2];
        find_point(hill, level, levels, points, k, xy);
        fwrite(xy, sizeof *xy, 2, stdout);
    }
    put_doubles(INTERVAL * level, 2 + points);
}

static void put_shapes(int hills, int levels, int points)
{
    const int about[] = { 1000, 13 };
    unsigned n_bytes = 64 + 24 * (unsigned)points, number = 0;
    put_big(9994);
    for (int k = 0; k < 5; k++)
        put_big(0);
    put_big((100 + (8 + n_bytes) * (unsigned)(hills * levels)) / 2);
    put_ints(about, 2);
    put_doubles(0, 8);
    for (int hill = 0; hill < hills; hill++)
        for (int level = 0; level < levels; level++)
            put_record(++number, n_bytes, hill, level, levels, points);
}

int main(int argc, char **argv)
{
    bool has_form = argc > 2 && strcmp(argv[1], "-f") == 0;
    const struct form *f = forms;
    for (int k = 0; has_form && k < N_FORMS; k++)
        f = strcmp(forms[k].name, argv[2]) == 0 ? &forms[k] : f;
    char **number = argv + (has_form ? 3 : 1);
    if (argc != (has_form ? 6 : 4))
        return 2;
    int hills = atoi(number[0]), levels = atoi(number[1]), points = atoi(number[2]);
    if (has_form && strcmp(argv[2], "shp") == 0)
        put_shapes(hills, levels, points);
    else
        put_text(f, hills, levels, points);
    return 0;
}
