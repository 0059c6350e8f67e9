#include "config.h"
#include "base/zipper.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* The band is at first REACH vertices wide to either side, and is not widened
 * beyond MOST_CELLS: a path that leans on a band of that size is good enough. */
static const size_t REACH = 32, MOST_CELLS = (size_t)1 << 27;

/* Pairs (i, j) by their diagonal k = i + j, the number of steps to get there.
 * Of diagonal k the band holds i = begin[k] .. begin[k] + width - 1, round the
 * pair that the common order reaches by then.  So its size does not depend on
 * how unevenly the vertices of either chain lie along it. */
typedef struct band {
    const il_zip_vertex *lower, *upper;
    size_t n_lower, n_upper, n_diagonals, width;
    size_t *begin;         /* [n_diagonals] */
    double *row[2];        /* [width] costs on the diagonal at hand and the one before */
    unsigned char *from;   /* [n_diagonals*width] the step that led there: see il_zip */
} band;

static void band_free(band *b)
{
    il_free(b->begin);
    il_free(b->row[0]);
    il_free(b->row[1]);
    il_free(b->from);
}

/* The least and the greatest i on diagonal K. */
static size_t least_on(const band *b, size_t k)
{
    return k < b->n_upper ? 0 : k - (b->n_upper - 1);
}

static size_t most_on(const band *b, size_t k)
{
    return k < b->n_lower ? k : b->n_lower - 1;
}

/* Merge the chains by place; lay the band round the pairs so met. */
static void lay_out(band *b, size_t reach)
{
    size_t i = 0, j = 0;
    for (size_t k = 0; k < b->n_diagonals; k++) {
        size_t least = least_on(b, k);
        b->begin[k] = i > least + reach ? i - reach : least;
        if (j + 1 == b->n_upper || (i + 1 < b->n_lower && b->lower[i + 1].place <= b->upper[j + 1].place))
            i++;
        else
            j++;
    }
}

static bool band_new(band *b, size_t reach)
{
    b->n_diagonals = b->n_lower + b->n_upper - 1;
    b->width = 2 * reach + 1;
    b->begin = il_alloc(b->n_diagonals, sizeof *b->begin);
    b->row[0] = il_alloc(b->width, sizeof **b->row);
    b->row[1] = il_alloc(b->width, sizeof **b->row);
    b->from = il_alloc(b->n_diagonals, b->width);
    if (!b->begin || !b->row[0] || !b->row[1] || !b->from)
        return false;
    lay_out(b, reach);
    return true;
}

/* Not hypot: this is half of the work, and squares of lengths do not run out of
 * exponents (loft/section.h, IL_SECTION_EXTENT_LEAST). */
static double cost(const band *b, size_t i, size_t j)
{
    double dx = b->lower[i].x - b->upper[j].x, dy = b->lower[i].y - b->upper[j].y;
    return sqrt(dx * dx + dy * dy);
}

/* Cost of the best way to lower vertex I on diagonal K, if the band holds it. */
static double reached(const band *b, size_t k, size_t i)
{
    size_t begin = b->begin[k];
    return i >= begin && i - begin < b->width && i <= most_on(b, k) ? b->row[k & 1][i - begin] : INFINITY;
}

static void fill(band *b)
{
    b->row[0][0] = 0;
    for (size_t k = 1; k < b->n_diagonals; k++) {
        size_t begin = b->begin[k], most = most_on(b, k);
        for (size_t i = begin; i < begin + b->width && i <= most; i++) {
            double by_lower = i > 0 ? reached(b, k - 1, i - 1) : INFINITY, by_upper = reached(b, k - 1, i);
            b->from[k * b->width + (i - begin)] = by_upper < by_lower;
            b->row[k & 1][i - begin] = fmin(by_lower, by_upper) + cost(b, i, k - i);
        }
    }
}

/* Walk back from the last pair; false when the path leans on the band's edge. */
static bool walk_back(const band *b, unsigned char *step)
{
    size_t i = b->n_lower - 1;
    bool free = true;
    for (size_t k = b->n_diagonals - 1; k > 0; k--) {
        size_t begin = b->begin[k], last = begin + b->width - 1;
        if ((i == begin && begin > least_on(b, k)) || (i == last && last < most_on(b, k)))
            free = false;
        step[k - 1] = b->from[k * b->width + (i - begin)];
        i -= !step[k - 1];
    }
    return free;
}

il_status il_zip(const il_zip_vertex *lower, size_t n_lower, const il_zip_vertex *upper, size_t n_upper,
                 unsigned char **step, il_error *err)
{
    *step = il_alloc(n_lower + n_upper - 2, 1);
    if (!*step)
        return il_fail_nomem(err);
    for (size_t reach = REACH;; reach *= 2) {
        band b = { lower, upper, n_lower, n_upper, 0, 0, NULL, { NULL, NULL }, NULL };
        bool ok = band_new(&b, reach), done = false;
        if (ok) {
            fill(&b);
            done = walk_back(&b, *step) || b.n_diagonals > MOST_CELLS / (2 * b.width);
        }
        band_free(&b);
        if (!ok) {
            il_free(*step);
            *step = NULL;
            return il_fail_nomem(err);
        }
        if (done)
            return IL_OK;
    }
}
