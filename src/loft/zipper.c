#include "config.h"
#include "loft/zipper.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* Row i of the grid holds the columns begin[i] .. begin[i] + width - 1. */
typedef struct band {
    const il_zip_vertex *lower, *upper;
    size_t n_lower, n_upper, width;
    size_t *begin;
    double *row[2];
    unsigned char *from;   /* [n_lower*width] 0: from the row before, 1: from the column before */
} band;

static void band_free(band *b)
{
    il_free(b->begin);
    il_free(b->row[0]);
    il_free(b->row[1]);
    il_free(b->from);
}

/* Columns near the upper vertex that stands where lower vertex i does. */
static void lay_out(band *b, size_t reach)
{
    size_t last = b->n_upper - b->width;
    for (size_t i = 0, j = 0; i < b->n_lower; i++) {
        while (j + 1 < b->n_upper && b->upper[j + 1].place <= b->lower[i].place)
            j++;
        size_t begin = j > reach ? j - reach : 0;
        b->begin[i] = begin < last ? begin : last;
    }
}

static bool band_new(band *b, size_t reach)
{
    b->width = 2 * reach + 1 < b->n_upper ? 2 * reach + 1 : b->n_upper;
    b->begin = il_alloc(b->n_lower, sizeof *b->begin);
    b->row[0] = il_alloc(b->width, sizeof **b->row);
    b->row[1] = il_alloc(b->width, sizeof **b->row);
    b->from = il_alloc(b->n_lower, b->width);
    if (!b->begin || !b->row[0] || !b->row[1] || !b->from)
        return false;
    lay_out(b, reach);
    return true;
}

static double cost(const band *b, size_t i, size_t j)
{
    return hypot(b->lower[i].x - b->upper[j].x, b->lower[i].y - b->upper[j].y);
}

static void fill(band *b)
{
    for (size_t i = 0; i < b->n_lower; i++) {
        double *now = b->row[i & 1], *before = b->row[~i & 1];
        for (size_t c = 0; c < b->width; c++) {
            size_t j = b->begin[i] + c;
            double left = c > 0 ? now[c - 1] : INFINITY, up = INFINITY;
            if (i > 0 && j >= b->begin[i - 1] && j - b->begin[i - 1] < b->width)
                up = before[j - b->begin[i - 1]];
            b->from[i * b->width + c] = left < up;
            double least = i == 0 && j == 0 ? 0 : fmin(left, up);
            now[c] = least + cost(b, i, j);
        }
    }
}

/* Walk back from the last pair; false when the path leans on the band's edge. */
static bool walk_back(const band *b, unsigned char *step)
{
    size_t i = b->n_lower - 1, j = b->n_upper - 1, n = b->n_lower + b->n_upper - 2;
    bool free = true;
    while (n > 0) {
        size_t c = j - b->begin[i];
        if ((c == 0 && b->begin[i] > 0) || (c == b->width - 1 && j + 1 < b->n_upper))
            free = false;
        step[--n] = i == 0 ? 1 : j == 0 ? 0 : b->from[i * b->width + c];
        if (step[n])
            j--;
        else
            i--;
        if (j < b->begin[i] || j - b->begin[i] >= b->width)
            return false;
    }
    return free;
}

il_status il_zip(const il_zip_vertex *lower, size_t n_lower, const il_zip_vertex *upper, size_t n_upper,
                 unsigned char **step, il_error *err)
{
    *step = il_alloc(n_lower + n_upper - 2, 1);
    if (!*step)
        return il_fail_nomem(err);
    for (size_t reach = 32;; reach *= 2) {
        band b = { lower, upper, n_lower, n_upper, 0, NULL, { NULL, NULL }, NULL };
        bool ok = band_new(&b, reach), whole = false;
        if (ok) {
            fill(&b);
            whole = walk_back(&b, *step) || b.width == n_upper;
        }
        band_free(&b);
        if (!ok) {
            il_free(*step);
            *step = NULL;
            return il_fail_nomem(err);
        }
        if (whole)
            return IL_OK;
    }
}
