#include "config.h"
#include "input/rt-levels.h"
#include "base/sort.h"

#include <math.h>
#include <stdbool.h>

/* mm; slices nearer than JITTER_MOST to one another are not drawn on patients, and
 * those nearer than PAIRS_MOST not in twos and threes. */
static const double JITTER_MOST = 0.05, PAIRS_MOST = 0.25;

/* Planes nearer than this share of the spacing are one slice; not above so many mm,
 * which are slices of their own where the spacing is large because most are missing. */
static const double SLICE_SHARE = 0.1, SLICE_MOST = 1;

/* Are the clumps that distances up to JITTER make no wider than WIDEST? */
static bool are_clumps(const double *level, size_t n, double jitter, double widest)
{
    double begin = level[0];
    for (size_t i = 1; i < n; i++) {
        if (level[i] - level[i - 1] > jitter)
            begin = level[i];
        else if (level[i] - begin > widest)
            return false;
    }
    return true;
}

/* Are the least K of the distances D[0..M), rising, jitter? */
static bool is_jitter(const double *d, size_t m, size_t k, const double *level, size_t n)
{
    bool few = k <= 2 * (m - k + 1); /* in clumps of three in the mean */
    return d[k - 1] <= (few ? PAIRS_MOST : JITTER_MOST) && d[k] * SLICE_SHARE >= d[k - 1] &&
           are_clumps(level, n, d[k - 1], SLICE_SHARE * d[k]);
}

/* The first of the distances D[0..M), rising, that is no jitter.  Distances grow
 * tenfold at most 300 times, so that is how often the levels are looked through. */
static size_t first_real(const double *d, size_t m, const double *level, size_t n)
{
    if (m > 0 && d[m - 1] <= JITTER_MOST && level[n - 1] - level[0] <= 2 * JITTER_MOST)
        return m; /* one plane */
    for (size_t k = m; k > 1; k--)
        if (is_jitter(d, m, k - 1, level, n))
            return k - 1;
    return 0;
}

double il_rt_levels_spacing(const double *level, size_t n, double *scratch)
{
    size_t m = 0;
    for (size_t i = 1; i < n; i++)
        if (level[i] > level[i - 1])
            scratch[m++] = level[i] - level[i - 1];
    il_sort_doubles(scratch, m);
    size_t first = first_real(scratch, m, level, n), left = m - first;
    if (left == 0)
        return 0;
    const double *d = scratch + first;
    return left % 2 ? d[left / 2] : (d[left / 2 - 1] + d[left / 2]) / 2;
}

size_t il_rt_levels_slice(const double *level, size_t n, size_t begin, double spacing)
{
    size_t end = begin + 1;
    while (end < n && level[end] - level[begin] <= fmin(SLICE_SHARE * spacing, SLICE_MOST))
        end++;
    return end;
}

/* The end of the run of levels equal to LEVEL[BEGIN]. */
static size_t run_end(const double *level, size_t n, size_t begin)
{
    size_t end = begin + 1;
    while (end < n && level[end] == level[begin])
        end++;
    return end;
}

double il_rt_levels_height(const double *level, size_t n)
{
    size_t longest = 0, many = 0;
    for (size_t i = 0, end; i < n; i = end) {
        end = run_end(level, n, i);
        many = end - i > longest ? 1 : end - i == longest ? many + 1 : many;
        longest = end - i > longest ? end - i : longest;
    }
    size_t wanted = (many - 1) / 2, seen = 0, i = 0;
    for (size_t end;; i = end) {
        end = run_end(level, n, i);
        if (end - i == longest && seen++ == wanted)
            return level[i];
    }
}
