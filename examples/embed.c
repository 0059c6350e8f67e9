/* embed.c - isoloft in another program: a vase from circles, as arrays and as STL.
 *
 *     cc embed.c -o embed $(pkg-config --cflags --libs isoloft)
 *     ./embed vase.stl
 */
#include <isoloft.h>

#include <math.h>
#include <stdio.h>

enum { SLICES = 12, CORNERS = 60 };

static double xy[SLICES][2 * CORNERS];

/* A circle's radius at height t, from 0 at the foot to 1 at the rim. */
static double radius(double t)
{
    return 20 + 8 * sin(6 * t);
}

static void make_contours(il_contour *contour)
{
    const double turn = 2 * acos(-1);
    for (int k = 0; k < SLICES; k++) {
        double t = (double)k / (SLICES - 1);
        for (int i = 0; i < CORNERS; i++) {
            xy[k][2 * i] = radius(t) * cos(turn * i / CORNERS);
            xy[k][2 * i + 1] = radius(t) * sin(turn * i / CORNERS);
        }
        contour[k] = (il_contour){ .z = 60 * t, .xy = xy[k], .n = CORNERS };
    }
}

static int complain(const il_error *err)
{
    char message[1024];
    il_error_message(err, message, sizeof message);
    fprintf(stderr, "embed: %s\n", message);
    return (int)err->code;
}

int main(int argc, char **argv)
{
    il_contour contour[SLICES];
    make_contours(contour);
    il_from from = { .contour = contour, .n_contours = SLICES, .unit = "mm" };
    il_error err = IL_ERROR_INIT;

    il_solids vase = IL_SOLIDS_INIT;
    if (il_loft(&from, &(il_to){ .solids = &vase }, NULL, &err) != IL_OK)
        return complain(&err);
    for (size_t i = 0; i < vase.n; i++)
        printf("%zu vertices, %zu triangles, %.0f mm3, genus %ld\n", vase.solid[i].n_vertices,
               vase.solid[i].n_triangles, vase.solid[i].volume, vase.solid[i].genus);
    il_solids_free(&vase);

    if (argc > 1 && il_loft(&from, &(il_to){ .path = argv[1] }, NULL, &err) != IL_OK)
        return complain(&err);
    return 0;
}
