#include "config.h"
#include "input/map-rows.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* See the head of map-rows.h. */
static const double median_times = 10, decile_times = 5;
enum { STEPS_LEAST = 20 };

void il_map_rows_init(il_map_rows *r, const il_read_options *options)
{
    *r = (il_map_rows){ .most = options->max_points };
}

void il_map_rows_free(il_map_rows *r)
{
    il_free(r->xy);
    il_free(r->run);
    il_free(r->pool);
    *r = (il_map_rows){ 0 };
}

/* ---- adding ------------------------------------------------------------------ */

static bool is_other(double a, double b)
{
    return !(a == b || (isnan(a) && isnan(b)));
}

bool il_map_rows_same(const il_map_rows *r, const char *text, size_t n)
{
    const il_map_run *last = r->n_runs > 0 ? &r->run[r->n_runs - 1] : NULL;
    return last && last->n_text == n && memcmp(r->pool + last->text, text, n) == 0;
}

/* RUN gets the text of the run before it, or TEXT[0..N) when that is another. */
static bool keep_text(il_map_rows *r, il_map_run *run, const char *text, size_t n)
{
    const il_map_run *last = run - 1;
    if (r->n_runs > 0 && !(run->news & IL_MAP_ROWS_HEIGHT)) {
        run->text = last->text;
        run->n_text = last->n_text;
        return true;
    }
    if (!il_grow(&r->pool, &r->cap_pool, r->n_pool + n + 1, 1))
        return false;
    memcpy(r->pool + r->n_pool, text, n);
    run->text = r->n_pool;
    run->n_text = (uint32_t)n;
    r->n_pool += n;
    return true;
}

il_status il_map_rows_add(il_map_rows *r, double x, double y, double z, const char *text, size_t n,
                          unsigned news, long line, il_error *err)
{
    if (r->n >= r->most)
        return il_fail(err, IL_E_INPUT, line, "more than %zu points (--max-points)", r->most);
    if (r->n == r->cap && !il_grow(&r->xy, &r->cap, r->n + 1, 2 * sizeof *r->xy))
        return il_fail_nomem(err);
    if (r->n_runs == 0 || is_other(z, r->run[r->n_runs - 1].z))
        news |= IL_MAP_ROWS_HEIGHT;
    if (news || line != r->line + 1) {
        if (!il_grow(&r->run, &r->cap_runs, r->n_runs + 1, sizeof *r->run))
            return il_fail_nomem(err);
        il_map_run *run = &r->run[r->n_runs];
        *run = (il_map_run){ .begin = r->n, .line = line, .z = z, .news = news };
        if (text && !keep_text(r, run, text, n))
            return il_fail_nomem(err);
        r->n_runs++;
    }
    r->line = line;
    r->xy[2 * r->n] = x;
    r->xy[2 * r->n + 1] = y;
    r->n++;
    return IL_OK;
}

static size_t run_end(const il_map_rows *r, size_t k)
{
    return k + 1 < r->n_runs ? r->run[k + 1].begin : r->n;
}

/* ---- how far apart rows are --------------------------------------------------- */

/* Steps counted by the upper bits of their 32-bit floats, which tell them apart to
 * 1 in 256. */
enum { BIN_BITS = 16, BINS = 1 << (BIN_BITS - 1) };

static size_t bin_of(float step)
{
    uint32_t bits;
    memcpy(&bits, &step, sizeof bits);
    return bits >> (32 - BIN_BITS);
}

static float step_of(size_t bin)
{
    uint32_t bits = (uint32_t)bin << (32 - BIN_BITS);
    float step;
    memcpy(&step, &bits, sizeof step);
    return step;
}

static float step_to(const il_map_rows *r, size_t i)
{
    double dx = r->xy[2 * i] - r->xy[2 * i - 2], dy = r->xy[2 * i + 1] - r->xy[2 * i - 1];
    return (float)sqrt(dx * dx + dy * dy);
}

/* The step below which PART of all N lie. */
static double quantile(const size_t *count, size_t n, double part)
{
    size_t k = 0, least = (size_t)(part * (double)n);
    for (size_t seen = count[0]; k + 1 < BINS && seen <= least;)
        seen += count[++k];
    return step_of(k);
}

/* What step is a gap?  INFINITY when no step is. */
static il_status find_gap(const il_map_rows *r, double *gap, il_error *err)
{
    size_t *count = il_calloc(BINS, sizeof *count), n = 0;
    *gap = INFINITY;
    if (!count)
        return il_fail_nomem(err);
    for (size_t k = 0; k < r->n_runs; k++) {
        bool apart = r->run[k].news & (IL_MAP_ROWS_BREAK | IL_MAP_ROWS_HEIGHT);
        for (size_t i = r->run[k].begin + apart; i < run_end(r, k); i++) {
            float step = step_to(r, i);
            count[bin_of(step)] += step > 0;
            n += step > 0;
        }
    }
    if (n >= STEPS_LEAST)
        *gap = fmax(median_times * quantile(count, n, 0.5), decile_times * quantile(count, n, 0.9));
    il_free(count);
    return IL_OK;
}

/* A table in which the height changes at most rows has no lines in it. */
static il_status refuse_points(const il_map_rows *r, il_error *err)
{
    size_t n = 0;
    for (size_t k = 0; k < r->n_runs; k++)
        n += (r->run[k].news & IL_MAP_ROWS_HEIGHT) != 0;
    if (n <= r->n / 2 || n < 2)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, r->run[0].line, "has no isolines: the height changes %zu times in %zu rows, as in scattered "
                   "points or a grid (gdal_contour makes isolines of a grid)", n - 1, r->n);
}

/* ---- which columns number lines ------------------------------------------------- */

/* How often column K changes. */
static size_t count_changes(const il_map_rows *r, size_t k)
{
    size_t n = 0;
    for (size_t i = 1; i < r->n_runs; i++)
        n += (r->run[i].news & (unsigned)IL_MAP_ROWS_COLUMN << k) != 0;
    return n;
}

static unsigned find_numbering(const il_map_rows *r, const il_map_rows_names *names, il_map_set *set)
{
    unsigned bits = 0;
    for (size_t k = 0; k < names->n_columns; k++) {
        size_t n = count_changes(r, k);
        int shown = names->n_column[k] < 40 ? (int)names->n_column[k] : 40;
        bool numbers = n > 0 && n <= r->n / 2;
        if (numbers)
            bits |= (unsigned)IL_MAP_ROWS_COLUMN << k;
        if (numbers)
            il_report_note(il_map_report(set), "%.200s: a line ends where '%.*s' changes", il_map_file(set), shown, names->column[k]);
        else if (n > 0)
            il_report_note(il_map_report(set), "%.200s: '%.*s' is another one in most rows, so it does not number lines",
                           il_map_file(set), shown, names->column[k]);
    }
    return bits;
}

/* ---- lines ---------------------------------------------------------------------- */

/* cuts: the news that end a line.  by_shape: so do closing and gaps.  begin: the row
 * that the line at hand begins with.  skipping: it is left out. */
typedef struct division {
    const il_map_rows *rows;
    const il_map_rows_names *names;
    il_map_set *set;
    unsigned cuts;
    bool by_shape, open, skipping;
    double gap;
    size_t begin, n_lines, n_heights, n_closed, n_gaps;
} division;

/* Do heights change before the next cut behind run K? */
static bool varies(const division *d, size_t k)
{
    const il_map_rows *r = d->rows;
    if (d->by_shape || !d->names->height)
        return false;
    for (k++; k < r->n_runs && !(r->run[k].news & d->cuts); k++)
        if (r->run[k].news & IL_MAP_ROWS_HEIGHT)
            return true;
    return false;
}

static il_status begin_line(division *d, size_t k, size_t i, il_error *err)
{
    const il_map_run *run = &d->rows->run[k];
    const il_map_rows_names *names = d->names;
    long line = run->line + (long)(i - run->begin);
    d->begin = i;
    d->n_lines++;
    d->skipping = varies(d, k);
    d->open = !d->skipping;
    if (d->skipping) {
        il_map_skip(d->set, line, "line", "its height varies: it is no isoline");
        il_status st = il_map_begin_feature(d->set, line, err);
        return st == IL_OK ? il_map_end_feature(d->set, err) : st;
    }
    il_status st = il_map_begin_feature(d->set, line, err);
    if (st == IL_OK && names->height)
        st = il_map_attribute(d->set, names->height, names->n_height, d->rows->pool + run->text, run->n_text, err);
    return st == IL_OK ? il_map_begin_part(d->set, IL_MAP_LINE, line, err) : st;
}

static il_status end_line(division *d, il_error *err)
{
    il_status st = d->open ? il_map_end_part(d->set, err) : IL_OK;
    if (st == IL_OK && d->open)
        st = il_map_end_feature(d->set, err);
    d->open = false;
    return st;
}

static bool is_same_point(const double *xy, size_t i, size_t k)
{
    return xy[2 * i] == xy[2 * k] && xy[2 * i + 1] == xy[2 * k + 1];
}

/* Has the line come back to its first point with the row before I? */
static bool is_closed_before(const division *d, size_t i)
{
    const double *xy = d->rows->xy;
    return i - d->begin > 3 && is_same_point(xy, i - 1, d->begin) && !is_same_point(xy, i - 2, d->begin);
}

/* Does a line begin with row I of run K? */
static bool is_cut(division *d, size_t k, size_t i)
{
    const il_map_run *run = &d->rows->run[k];
    if (i == 0)
        return true;
    if (i == run->begin && run->news & d->cuts) {
        d->n_heights += run->news & IL_MAP_ROWS_HEIGHT && !(run->news & IL_MAP_ROWS_BREAK);
        return true;
    }
    if (!d->by_shape)
        return false;
    bool closed = is_closed_before(d, i), gap = !closed && step_to(d->rows, i) > d->gap;
    d->n_closed += closed;
    d->n_gaps += gap;
    return closed || gap;
}

static il_status divide(division *d, il_error *err)
{
    const il_map_rows *r = d->rows;
    il_status st = IL_OK;
    for (size_t k = 0; k < r->n_runs; k++) {
        for (size_t i = r->run[k].begin; i < run_end(r, k) && st == IL_OK; i++) {
            if (is_cut(d, k, i)) {
                st = end_line(d, err);
                if (st == IL_OK)
                    st = begin_line(d, k, i, err);
            }
            long line = r->run[k].line + (long)(i - r->run[k].begin);
            if (st == IL_OK && d->open)
                st = il_map_point(d->set, r->xy[2 * i], r->xy[2 * i + 1], d->names->height ? NAN : r->run[k].z, line, err);
        }
    }
    return st == IL_OK ? end_line(d, err) : st;
}

static void tell_shape(const division *d)
{
    if (d->n_lines > 1)
        il_report_note(il_map_report(d->set), "%.200s: nothing numbers the lines of this table: it is divided where the height "
                       "changes (%zu), behind closed lines (%zu) and at gaps (%zu)", il_map_file(d->set),
                       d->n_heights, d->n_closed, d->n_gaps);
}

il_status il_map_rows_emit(const il_map_rows *r, const il_map_rows_names *names, il_map_set *set, il_error *err)
{
    division d = { .rows = r, .names = names, .set = set, .gap = INFINITY };
    il_status st = IL_OK;
    unsigned numbering = find_numbering(r, names, set);
    il_map_count_from_here(set);
    d.by_shape = numbering == 0;
    d.cuts = IL_MAP_ROWS_BREAK | (d.by_shape ? IL_MAP_ROWS_HEIGHT : numbering);
    if (d.by_shape)
        st = refuse_points(r, err);
    if (st == IL_OK && d.by_shape)
        st = find_gap(r, &d.gap, err);
    if (st == IL_OK)
        st = divide(&d, err);
    if (st == IL_OK && d.by_shape)
        tell_shape(&d);
    return st;
}

il_status il_map_rows_emit_one(const il_map_rows *r, il_map_set *set, il_error *err)
{
    static const il_map_rows_names none = { .height = NULL };
    division d = { .rows = r, .names = &none, .set = set, .cuts = IL_MAP_ROWS_BREAK };
    return divide(&d, err);
}
