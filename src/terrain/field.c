#include "config.h"
#include "terrain/field.h"
#include "base/alloc.h"
#include "terrain/field-near.h"
#include "terrain/law.h"

#include <math.h>

enum { FIELD_NODES = 3, NODES_LEAST = 10000 };

void il_field_free(il_field *f)
{
    il_free(f->face);
    il_free(f->near);
    il_free(f->first);
    il_free(f->through);
    il_free(f->line);
    *f = (il_field)IL_FIELD_INIT;
}

/* ---- the grid ------------------------------------------------------------------- */

/* Least x and y, greatest x and y, of all that lies inside the frame. */
static void find_box(const il_field *f, const il_tin *t, const il_chart *c, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t k = 0; k < 3 * t->n; k++) {
        const double *p = c->xy + 2 * (size_t)t->corner[k];
        if (t->face[k / 3] == IL_CHART_NONE)
            continue;
        box[0] = fmin(box[0], p[0] * f->east), box[2] = fmax(box[2], p[0] * f->east);
        box[1] = fmin(box[1], p[1]), box[3] = fmax(box[3], p[1]);
    }
}

/* Nodes stand half a step off the box, and one beyond it. */
static void choose_grid(il_field *f, const double box[4], size_t n_nodes)
{
    double size[2] = { box[2] - box[0], box[3] - box[1] }, length = 0;
    size_t n = 0;
    for (size_t e = 0; e < f->n_lines; e++) {
        const il_field_line *l = &f->line[e];
        n += l->level >= 0;
        length += l->level >= 0 ? hypot(l->bx - l->ax, l->by - l->ay) : 0;
    }
    if (n == 0 || !(size[0] > 0 && size[1] > 0 && length > 0))
        return;
    double most = (double)(FIELD_NODES * n_nodes + NODES_LEAST), area = size[0] * size[1];
    /* the second: a long and narrow map has no more nodes along it */
    double least = fmax(sqrt(area / most), fmax(size[0], size[1]) / most);
    f->step = fmax(least, fmin(length / (double)n, area / length / 4));
    for (int i = 0; i < 2; i++) {
        f->at[i] = box[i] - f->step / 2;
        f->n[i] = (size_t)ceil(size[i] / f->step) + 2;
    }
}

/* ---- lines and faces -------------------------------------------------------------- */

static bool copy_lines(il_field *f, const il_tin *t, const il_chart *c, const il_band *band)
{
    f->n_lines = c->n_edges;
    f->line = il_alloc(c->n_edges, sizeof *f->line);
    for (size_t e = 0; f->line && e < c->n_edges; e++) {
        const double *a = c->xy + 2 * (size_t)c->edge[2 * e], *b = c->xy + 2 * (size_t)c->edge[2 * e + 1];
        bool after = e + 1 < c->n_edges && c->owner[e + 1] == c->owner[e] && c->edge[2 * e + 2] == c->edge[2 * e + 1];
        bool before = e > 0 && f->line[e - 1].after;
        il_field_line *l = &f->line[e];
        *l = (il_field_line){ a[0] * f->east, a[1], b[0] * f->east, b[1], c->height[e], .before = before, .after = after };
        for (size_t side = 0; side < 2; side++) {
            l->face[side] = l->level >= 0 ? t->side[2 * e + side] : IL_CHART_NONE;
            l->above[side] = l->face[side] != IL_CHART_NONE && il_law_is_above(t, c, band, 2 * e + side);
        }
    }
    return f->line != NULL;
}

/* Where the edge from A to B meets height Y, the same from both of its ends. */
static double meet(const double *a, const double *b, double y)
{
    const double *low = a[1] < b[1] ? a : b, *high = low == a ? b : a;
    return low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
}

/* Rows begin where the triangle does and end before it does, so that of nodes on edges one has
 * them. */
static void label_triangle(il_field *f, const double p[3][2], uint32_t face)
{
    double low = fmin(p[0][1], fmin(p[1][1], p[2][1])), high = fmax(p[0][1], fmax(p[1][1], p[2][1]));
    size_t last = (size_t)ceil(fmax((high - f->at[1]) / f->step, 0));
    for (size_t j = (size_t)ceil(fmax((low - f->at[1]) / f->step, 0)); j < last && j < f->n[1]; j++) {
        double y = f->at[1] + (double)j * f->step, x[2] = { INFINITY, -INFINITY };
        for (int k = 0; k < 3; k++) {
            const double *a = p[k], *b = p[(k + 1) % 3];
            if ((a[1] <= y) == (b[1] <= y))
                continue;
            double at = meet(a, b, y);
            x[0] = fmin(x[0], at), x[1] = fmax(x[1], at);
        }
        if (!(x[0] < x[1]))
            continue;
        size_t end = (size_t)ceil(fmax((x[1] - f->at[0]) / f->step, 0));
        for (size_t i = (size_t)ceil(fmax((x[0] - f->at[0]) / f->step, 0)); i < end && i < f->n[0]; i++)
            f->face[i + f->n[0] * j] = face;
    }
}

static bool label_nodes(il_field *f, const il_tin *t, const il_chart *c)
{
    f->face = il_alloc(il_field_size(f), sizeof *f->face);
    for (size_t k = 0; f->face && k < il_field_size(f); k++)
        f->face[k] = IL_CHART_NONE;
    for (size_t k = 0; f->face && k < t->n; k++) {
        double p[3][2];
        if (t->face[k] == IL_CHART_NONE)
            continue;
        for (size_t i = 0; i < 3; i++) {
            const double *at = c->xy + 2 * (size_t)t->corner[3 * k + i];
            p[i][0] = at[0] * f->east, p[i][1] = at[1];
        }
        label_triangle(f, p, t->face[k]);
    }
    return f->face != NULL;
}

il_status il_field_build(il_field *f, const il_tin *t, const il_chart *c, const il_band *band, double east, il_error *err)
{
    double box[4];
    *f = (il_field){ .east = east };
    find_box(f, t, c, box);
    bool ok = copy_lines(f, t, c, band);
    if (ok)
        choose_grid(f, box, c->n_nodes);
    if (ok && f->step > 0)
        ok = label_nodes(f, t, c) && il_field_find_near(f);
    if (!ok)
        il_field_free(f);
    return ok ? IL_OK : il_fail_nomem(err);
}
