/* terrain.c - the isolines of a made landscape, as GeoJSON on standard output.
 *
 *     terrain WIDTH HEIGHT LEVELS
 *
 * The ground is a sum of sines of five wavelengths in as many directions, so it has
 * peaks, pits and saddles without end, and a map twice as wide has twice as much of it.
 * Its isolines at LEVELS levels are followed from triangle to triangle of a grid of
 * WIDTH by HEIGHT squares, each square cut in two: no place is ambiguous, and a line
 * ends at the edge of the grid only.  Metres; a feature a line, its height in `elev`. */
#include "config.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAVES = 5, STEP = 10, RELIEF = 100 };

/* A triangle is half a square: half 0 has (0,0) (1,0) (1,1), half 1
 * (0,0) (1,1) (0,1).  An edge is that of its lower corner and a direction: 0 to (1,0),
 * 1 to (0,1), 2 to (1,1). */
typedef struct edge { int x, y, way; } edge;
typedef struct triangle { int x, y, half; } triangle;

static const int ACROSS[] = { 1, 0, 1 }, UP[] = { 0, 1, 1 };

typedef struct land {
    int width, height;
    double *z;  /* [(width + 1) * (height + 1)], by rows */
    bool *done; /* [3 * the same]: edges whose place on the present level is written */
} land;

static size_t corner(const land *l, int x, int y)
{
    return (size_t)y * (size_t)(l->width + 1) + (size_t)x;
}

static double ground(double x, double y)
{
    static const double length[WAVES] = { 173, 97, 61, 37, 23 }, angle[WAVES] = { 0.3, 1.7, 2.6, 4.1, 5.5 };
    double z = 0;
    for (int k = 0; k < WAVES; k++) {
        double turn = 6.283185307179586 / length[k];
        z += length[k] / 173 * sin(turn * (x * cos(angle[k]) + y * sin(angle[k])) + k);
        z += length[k] / 173 * cos(turn * (y * cos(angle[k]) - x * sin(angle[k])) + 2 * k);
    }
    return RELIEF * z;
}

static double height_at(const land *l, edge e, int end)
{
    return l->z[corner(l, e.x + end * ACROSS[e.way], e.y + end * UP[e.way])];
}

static bool exists(const land *l, edge e)
{
    return e.x >= 0 && e.y >= 0 && e.x + ACROSS[e.way] <= l->width && e.y + UP[e.way] <= l->height;
}

static bool is_crossed(const land *l, edge e, double level)
{
    return (height_at(l, e, 0) < level) != (height_at(l, e, 1) < level);
}

static bool *mark_of(const land *l, edge e)
{
    return &l->done[3 * corner(l, e.x, e.y) + (size_t)e.way];
}

/* The two triangles at E, of which one may lie outside. */
static triangle beside(edge e, int side)
{
    const triangle at[3][2] = { { { 0, 0, 0 }, { 0, -1, 1 } }, { { 0, 0, 1 }, { -1, 0, 0 } }, { { 0, 0, 0 }, { 0, 0, 1 } } };
    triangle t = at[e.way][side];
    return (triangle){ e.x + t.x, e.y + t.y, t.half };
}

static bool is_inside(const land *l, triangle t)
{
    return t.x >= 0 && t.y >= 0 && t.x < l->width && t.y < l->height;
}

/* The other edge of T that the level crosses. */
static edge leave(const land *l, triangle t, edge from, double level)
{
    const edge of[2][3] = { { { 0, 0, 0 }, { 1, 0, 1 }, { 0, 0, 2 } }, { { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 2 } } };
    for (int k = 0; k < 3; k++) {
        edge e = of[t.half][k];
        e.x += t.x;
        e.y += t.y;
        if (memcmp(&e, &from, sizeof e) != 0 && is_crossed(l, e, level))
            return e;
    }
    return from;
}

/* The triangle on the other side of E. */
static triangle over(edge e, triangle from)
{
    triangle t = beside(e, 0);
    return memcmp(&t, &from, sizeof t) == 0 ? beside(e, 1) : t;
}

static void put_point(const land *l, edge e, double level, bool is_first)
{
    double a = height_at(l, e, 0), b = height_at(l, e, 1), part = (level - a) / (b - a);
    printf("%s[%.4f,%.4f]", is_first ? "" : ",", STEP * (e.x + part * ACROSS[e.way]), STEP * (e.y + part * UP[e.way]));
}

/* The line through E, on from T until it leaves the grid or is at E again. */
static void put_line(const land *l, edge e, triangle t, double level)
{
    static bool is_later;
    edge first = e;
    printf("%s{\"type\":\"Feature\",\"properties\":{\"elev\":%g},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[",
           is_later ? ",\n" : "", level);
    is_later = true;
    put_point(l, e, level, true);
    *mark_of(l, e) = true;
    while (is_inside(l, t)) {
        e = leave(l, t, e, level);
        put_point(l, e, level, false);
        *mark_of(l, e) = true;
        if (memcmp(&e, &first, sizeof e) == 0)
            break;
        t = over(e, t);
    }
    fputs("]}}", stdout);
}

/* Lines that begin at the edge of the grid, or those that are left: the closed ones. */
static void put_lines(const land *l, double level, bool from_edge)
{
    for (edge e = { 0, 0, 0 }; e.y <= l->height; e.y++)
        for (e.x = 0; e.x <= l->width; e.x++)
            for (e.way = 0; e.way < 3; e.way++) {
                if (!exists(l, e) || *mark_of(l, e) || !is_crossed(l, e, level))
                    continue;
                int side = is_inside(l, beside(e, 0)) ? 0 : 1;
                if (!from_edge || side == 1 || !is_inside(l, beside(e, 1)))
                    put_line(l, e, beside(e, side), level);
            }
}

int main(int argc, char **argv)
{
    int width = argc == 4 ? atoi(argv[1]) : 0, height = argc == 4 ? atoi(argv[2]) : 0, levels = argc == 4 ? atoi(argv[3]) : 0;
    if (width < 1 || width > 100000 || height < 1 || height > 100000 || levels < 1 || levels > 1000) {
        fputs("usage: terrain WIDTH HEIGHT LEVELS\n", stderr);
        return 2;
    }
    land l = { .width = width, .height = height };
    size_t n = (size_t)(width + 1) * (size_t)(height + 1);
    l.z = malloc(n * sizeof *l.z);
    l.done = malloc(3 * n * sizeof *l.done);
    if (!l.z || !l.done)
        return 5;
    for (int y = 0; y <= height; y++)
        for (int x = 0; x <= width; x++)
            l.z[corner(&l, x, y)] = ground(x, y);
    fputs("{\"type\":\"FeatureCollection\",\"features\":[\n", stdout);
    for (int k = 0; k < levels; k++) {
        double level = 5 * round(2 * RELIEF * ((2.0 * k + 1) / levels - 1) / 5);
        memset(l.done, 0, 3 * n * sizeof *l.done);
        put_lines(&l, level, true);
        put_lines(&l, level, false);
    }
    fputs("\n]}\n", stdout);
    free(l.z);
    free(l.done);
    return ferror(stdout) || fflush(stdout) != 0 ? 4 : 0;
}
