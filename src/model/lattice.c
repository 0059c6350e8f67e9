#include "config.h"
#include "model/lattice.h"

#include <math.h>

void il_lattice_weights(double u, double b[4])
{
    double v = 1 - u;
    b[0] = v * v * v / 6;
    b[1] = (3 * u * u * u - 6 * u * u + 4) / 6;
    b[2] = (3 * v * v * v - 6 * v * v + 4) / 6;
    b[3] = u * u * u / 6;
}

/* Their derivatives by u. */
static void slopes(double u, double b[4])
{
    double v = 1 - u;
    b[0] = -v * v / 2;
    b[1] = (3 * u - 4) * u / 2;
    b[2] = -(3 * v - 4) * v / 2;
    b[3] = u * u / 2;
}

/* The node before the place and what is beyond it, in spacings. */
static long locate(double at, double *u)
{
    double whole = floor(at);
    *u = at - whole;
    return (long)whole - 1;
}

/* Displacement component C at nodes (i, j) .. (i + 3, j + 3), weighted. */
static double weighted(const il_lattice *l, long i, long j, const double *bx, const double *by, int c)
{
    double sum = 0;
    for (long n = 0; n < 4; n++) {
        if (j + n < 0 || j + n >= (long)l->ny)
            continue;
        double row = 0;
        for (long m = 0; m < 4; m++)
            if (i + m >= 0 && i + m < (long)l->nx)
                row += bx[m] * l->d[2 * ((size_t)(j + n) * l->nx + (size_t)(i + m)) + (size_t)c];
        sum += by[n] * row;
    }
    return sum;
}

/* Far from the lattice nothing moves; also keeps numbers within a long. */
static bool is_near(const il_lattice *l, double x, double y)
{
    return x > -3 && y > -3 && x < l->nx + 3.0 && y < l->ny + 3.0;
}

void il_lattice_apply(const il_lattice *l, double *xy, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        double at[2] = { (xy[2 * k] - l->x) / l->spacing, (xy[2 * k + 1] - l->y) / l->spacing };
        double u[2], bx[4], by[4];
        if (!is_near(l, at[0], at[1]))
            continue;
        long i = locate(at[0], &u[0]), j = locate(at[1], &u[1]);
        il_lattice_weights(u[0], bx);
        il_lattice_weights(u[1], by);
        for (int c = 0; c < 2; c++)
            xy[2 * k + (size_t)c] += weighted(l, i, j, bx, by, c); /* eq. (3) */
    }
}

void il_fit_apply(const il_fit *f, double *xy, size_t n)
{
    const double *g = f->global;
    for (size_t k = 0; k < n; k++) {
        double x = xy[2 * k], y = xy[2 * k + 1];
        xy[2 * k] = g[0] * x + g[1] * y + g[4];
        xy[2 * k + 1] = g[2] * x + g[3] * y + g[5];
    }
    for (size_t k = 0; k < f->n_lattices; k++)
        il_lattice_apply(&f->lattice[k], xy, n);
}

double il_lattice_jacobian(const il_lattice *l, const double p[2])
{
    double at[2] = { (p[0] - l->x) / l->spacing, (p[1] - l->y) / l->spacing };
    double u[2], bx[4], by[4], sx[4], sy[4];
    if (!is_near(l, at[0], at[1]))
        return 1;
    long i = locate(at[0], &u[0]), j = locate(at[1], &u[1]);
    il_lattice_weights(u[0], bx);
    il_lattice_weights(u[1], by);
    slopes(u[0], sx);
    slopes(u[1], sy);
    double xx = weighted(l, i, j, sx, by, 0), xy = weighted(l, i, j, bx, sy, 0);
    double yx = weighted(l, i, j, sx, by, 1), yy = weighted(l, i, j, bx, sy, 1);
    double h = l->spacing;
    return (1 + xx / h) * (1 + yy / h) - (xy / h) * (yx / h);
}
