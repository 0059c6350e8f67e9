/* relief.c - isolines made for measuring, on standard output.
 *
 *     relief [-f FORM] HILLS LEVELS POINTS
 *
 * HILLS hills side by side with LEVELS isolines of POINTS points each: circles with
 * harmonics whose phases drift from level to level, in metres, every one a feature
 * with its height in `elev`.
 * FORM: geojson (a collection with as many decimals as a double has, as GDAL writes
 * it, the default), geojsonseq (a feature a line, 7 decimals), gmt (a segment a line),
 * wkt (a table, a row a line, as GDAL writes it), xyz (a table, a row a point), bln. */
#include "config.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HARMONICS = 5, INTERVAL = 10 };

static const double TURN = 6.283185307179586, APART = 5000;

/* What stands before and behind all features and between two of them, before and
 * behind the height, between two points and behind the last; and how a point is.
 * COUNTS: the number of points stands before it all; EACH: the height behind each
 * point, and nowhere else. */
typedef struct form {
    const char *name, *begin, *between, *end, *feature, *lines, *comma, *tail, *point;
    bool counts, each;
} form;

static const form forms[] = {
    { "geojson", "{\n\"type\": \"FeatureCollection\",\n\"name\": \"contour\",\n\"features\": [\n", ",\n", "\n]\n}\n",
      "{ \"type\": \"Feature\", \"properties\": { \"ID\": 0, \"elev\": ",
      " }, \"geometry\": { \"type\": \"LineString\", \"coordinates\": [ ", ", ", " ] } }", "[ %.15g, %.15g ]", false, false },
    { "geojsonseq", "", "\n", "\n", "{ \"type\": \"Feature\", \"properties\": { \"ID\": 0, \"elev\": ",
      " }, \"geometry\": { \"type\": \"LineString\", \"coordinates\": [ ", ", ", " ] } }", "[ %.7f, %.7f ]", false, false },
    { "gmt", "", "", "", "> -Z", "\n", "\n", "\n", "%.15g %.15g", false, false },
    { "wkt", "ID,elev,WKT\n", "", "", "0,", ",\"LINESTRING (", ",", ")\"\n", "%.15g %.15g", false, false },
    { "xyz", "x,y,elev\n", "", "", "", "", "\n", "\n", "%.15g,%.15g", false, true },
    { "bln", "", "", "", ",1,", "\n", "\n", "\n", "%.15g,%.15g", true, false },
};
enum { N_FORMS = sizeof forms / sizeof *forms };

/* Half of all isolines come back to their first point, the rest are cut. */
static void put_line(const form *f, int hill, int level, int levels, int points)
{
    double r = 0.45 * APART * (levels - level) / levels, x0 = 400000 + APART * hill, y0 = 5100000;
    int last = level % 2 ? points : points - 1;
    for (int k = 0; k < points; k++) {
        double turn = TURN * k / last, bend = 1;
        for (int h = 2; h <= HARMONICS; h++)
            bend += 0.04 / h * sin(h * turn + 0.3 * hill * h + 0.02 * level * h);
        double end = k == last ? 0 : turn;
        fputs(k > 0 ? f->comma : "", stdout);
        printf(f->point, x0 + r * bend * cos(end), y0 + r * bend * sin(end));
        if (f->each)
            printf(",%d.0", INTERVAL * level);
    }
}

int main(int argc, char **argv)
{
    bool has_form = argc > 2 && strcmp(argv[1], "-f") == 0;
    const form *f = forms;
    for (int k = 0; has_form && k < N_FORMS; k++)
        f = strcmp(forms[k].name, argv[2]) == 0 ? &forms[k] : f;
    char **number = argv + (has_form ? 3 : 1);
    if (argc != (has_form ? 6 : 4))
        return 2;
    int hills = atoi(number[0]), levels = atoi(number[1]), points = atoi(number[2]);
    fputs(f->begin, stdout);
    for (int hill = 0; hill < hills; hill++) {
        for (int level = 0; level < levels; level++) {
            fputs(hill + level > 0 ? f->between : "", stdout);
            if (f->counts)
                printf("%d", points);
            if (!f->each)
                printf("%s%d.0%s", f->feature, INTERVAL * level, f->lines);
            put_line(f, hill, level, levels, points);
            fputs(f->tail, stdout);
        }
    }
    fputs(f->end, stdout);
    return 0;
}
