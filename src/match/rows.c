#include "config.h"
#include "match/rows.h"
#include "base/alloc.h"
#include "model/lattice.h"

#include <math.h>

/* An edge's image is broken where its chord is further off than this, in cells.
 * What is short before and after is taken for straight; of what is long before
 * or after, in cells or in spacings of points, the middle alone does not tell. */
static const double CHORD = 0.5, SHORT = 2, LONG = 16, LONG_SPACINGS = 10;

enum { MOST_HALVINGS = 8 };

static void apply_fit(const void *fit, double p[2])
{
    il_fit_apply(fit, p, 1);
}

il_bend il_bend_of_fit(const il_fit *fit, double cell, double spacing)
{
    return (il_bend){ apply_fit, fit, fit->n_lattices == 0, cell, spacing };
}

bool il_rows_add(il_rows *r, uint32_t vertex, double t, const double p[2])
{
    if (!il_grow(&r->row, &r->cap, r->n + 1, sizeof *r->row))
        return false;
    r->row[r->n++] = (il_course_row){ vertex, t, p[0], p[1] };
    return true;
}

/* An edge on its way: where it runs, and what it is asked about. */
typedef struct edge {
    il_rows *rows;
    const il_bend *bend;
    uint32_t vertex;
    const double *a, *b;
} edge;

static void image_at(const edge *e, double t, double out[2])
{
    for (size_t c = 0; c < 2; c++)
        out[c] = e->a[c] + t * (e->b[c] - e->a[c]);
    e->bend->apply(e->bend->context, out);
}

/* The part [T0, T1), whose ends' images are P and Q: halve it while the image of the
 * middle lies off the chord. */
static bool add_part(const edge *e, double t0, const double p[2], double t1, const double q[2], int depth)
{
    double cell = e->bend->cell, length = hypot(e->b[0] - e->a[0], e->b[1] - e->a[1]) * (t1 - t0);
    length = fmax(length, hypot(q[0] - p[0], q[1] - p[1]));
    if (depth == 0 || length < SHORT * cell)
        return il_rows_add(e->rows, e->vertex, t0, p);
    double t = (t0 + t1) / 2, middle[2];
    image_at(e, t, middle);
    double off = hypot(middle[0] - (p[0] + q[0]) / 2, middle[1] - (p[1] + q[1]) / 2);
    if (off <= CHORD * cell && length <= fmax(LONG, LONG_SPACINGS * e->bend->spacing) * cell)
        return il_rows_add(e->rows, e->vertex, t0, p);
    return add_part(e, t0, p, t, middle, depth - 1) && add_part(e, t, middle, t1, q, depth - 1);
}

bool il_rows_add_part(il_rows *r, const il_bend *b, uint32_t vertex, const double from[2], const double to[2], double t0, double t1)
{
    edge e = { r, b, vertex, from, to };
    double p[2], q[2];
    image_at(&e, t0, p);
    if (b->straight)
        return il_rows_add(r, vertex, t0, p);
    image_at(&e, t1, q);
    return add_part(&e, t0, p, t1, q, MOST_HALVINGS);
}
