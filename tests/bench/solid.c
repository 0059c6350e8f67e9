/* solid.c - a solid made for measuring, as contours on standard output.
 *
 *     solid [-s] SLICES POINTS
 *
 * A body with a wavy outline and a slanted channel, out of which grow two arms
 * that part and thin out: nesting, branches and ends, in SLICES slices of about
 * POINTS vertices each.  Native text, or with -s SVG. */
#include "config.h"
#include "base/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An outline: radius R with WAVES waves of relative height DEPTH, about (X, Y). */
typedef struct outline {
    double x, y, r, depth;
    int waves, points;
    bool hole;
} outline;

static bool as_svg;

static void put(double v)
{
    char text[IL_NUMBER_MAX];
    il_number_format(text, v);
    fputs(text, stdout);
}

static void put_point(const outline *o, int i)
{
    double turn = 2 * acos(-1) * i / o->points * (o->hole ? -1 : 1);
    double r = o->r * (1 + o->depth * sin(o->waves * turn));
    if (as_svg)
        putchar(i > 0 ? 'L' : 'M');
    put(o->x + r * cos(turn));
    putchar(' ');
    put((o->y + r * sin(turn)) * (as_svg ? -1 : 1));
    if (!as_svg)
        putchar('\n');
}

static void put_outline(const outline *o)
{
    fputs(as_svg ? "<path d=\"" : "ring\n", stdout);
    for (int i = 0; i < o->points; i++)
        put_point(o, i);
    fputs(as_svg ? "Z\"/>\n" : "", stdout);
}

/* The outlines at height T, from 0 at the foot to 1 at the top. */
static int outlines_at(double t, int points, outline o[4])
{
    int n = 0;
    if (t < 0.7) {
        o[n++] = (outline){ 0, 0, 50 + 10 * sin(5 * t), 0.06, 9, points * 7 / 10, false };
        o[n++] = (outline){ 40 * t - 15, 8, 9 + 4 * t, 0.04, 5, points * 3 / 10, true };
    } else {
        double apart = 18 + 30 * (t - 0.7);
        o[n++] = (outline){ -apart, 4, 16 * (1.3 - t), 0.08, 7, points / 2, false };
        o[n++] = (outline){ apart, -4, 14 * (1.3 - t), 0.08, 6, points / 2, false };
    }
    return n;
}

static void put_slice(int k, int slices, int points)
{
    double t = (double)k / (slices - 1);
    outline o[4];
    int n = outlines_at(t, points, o);
    fputs(as_svg ? "<g data-z=\"" : "slice ", stdout);
    put(120 * t);
    fputs(as_svg ? "\">\n" : "\n", stdout);
    for (int i = 0; i < n; i++)
        put_outline(&o[i]);
    fputs(as_svg ? "</g>\n" : "", stdout);
}

int main(int argc, char **argv)
{
    as_svg = argc > 1 && strcmp(argv[1], "-s") == 0;
    if (argc != (as_svg ? 4 : 3)) {
        fputs("usage: solid [-s] SLICES POINTS\n", stderr);
        return 2;
    }
    int slices = atoi(argv[argc - 2]), points = atoi(argv[argc - 1]);
    if (slices < 2 || slices > 100000 || points < 20 || points > 10000000)
        return 2;
    fputs(as_svg ? "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" : "isoloft 1\nunit mm\nstack \"bench\"\n", stdout);
    for (int k = 0; k < slices; k++)
        put_slice(k, slices, points);
    fputs(as_svg ? "</svg>\n" : "end\n", stdout);
    return ferror(stdout) || fflush(stdout) != 0 ? 4 : 0;
}
