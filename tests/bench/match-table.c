#include "config.h"
#include "match-table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The pairs of one family lie side by side: R[0..N). */
static size_t family_run(const match_result *r, size_t n)
{
    size_t k = 0;
    while (k < n && r[k].family == r->family)
        k++;
    return k;
}

/* ---- what holds for a family ---- */

typedef struct family_figures {
    size_t pairs, solved, scaled, differing;
    double ms_mean, ms_median, ms_worst;
    double up, down, worst, least_jacobian, distortion, off_truth;
    double steps_mean;
    uint32_t steps_most;
} family_figures;

static int compare_doubles(const void *p, const void *q)
{
    double a = *(const double *)p, b = *(const double *)q;
    return a < b ? -1 : a > b;
}

static double median_ms(const match_result *r, size_t n)
{
    double *ms = malloc(n * sizeof *ms), middle = NAN;
    for (size_t i = 0; ms && i < n; i++)
        ms[i] = r[i].ours.ms;
    if (ms) {
        qsort(ms, n, sizeof *ms, compare_doubles);
        middle = (ms[n / 2] + ms[(n - 1) / 2]) / 2;
    }
    free(ms);
    return middle;
}

static double worse(double a, double b)
{
    return a > b || isnan(a) ? a : b;
}

static family_figures figures_of(const match_result *r, size_t n)
{
    family_figures f = { .pairs = n, .ms_median = median_ms(r, n), .least_jacobian = INFINITY };
    double share = 1 / (double)n;
    for (size_t i = 0; i < n; i++) {
        const judged *j = &r[i].ours.is;
        f.solved += judged_solved(j);
        f.scaled += r[i].scaled;
        f.differing += !r[i].same_again;
        f.ms_mean += share * r[i].ours.ms;
        f.ms_worst = worse(f.ms_worst, r[i].ours.ms);
        f.up += share * j->up_mean;
        f.down += share * j->down_mean;
        f.worst = worse(worse(f.worst, j->up_max), j->down_max);
        f.least_jacobian = -worse(-f.least_jacobian, -j->least_jacobian);
        f.distortion += share * j->distortion;
        f.off_truth += share * j->off_truth;
        f.steps_mean += share * r[i].ours.steps;
        f.steps_most = r[i].ours.steps > f.steps_most ? r[i].ours.steps : f.steps_most;
    }
    return f;
}

/* ---- tables ---- */

/* Seeds that were not solved, the first few of them. */
static void print_failures(const match_result *r, size_t n)
{
    size_t shown = 0, failed = 0;
    for (size_t i = 0; i < n; i++)
        if (!judged_solved(&r[i].ours.is) && failed++ < 12)
            printf("%s%u", shown++ ? " " : "", (unsigned)r[i].seed);
    printf("%s\n", failed == 0 ? "-" : failed > shown ? " ..." : "");
}

static void print_family(const match_result *r, size_t n)
{
    family_figures f = figures_of(r, n);
    printf("%-11s %5zu %6zu %7.3f %7.3f %7.3f %8.4f %8.4f %7.2f %8.4f %8.3f %7.2f %6.1f %5u  ", pairs_family_word(r->family),
           f.pairs, f.solved, f.ms_mean, f.ms_median, f.ms_worst, f.up, f.down, f.worst, f.least_jacobian, f.distortion,
           f.off_truth, f.steps_mean, (unsigned)f.steps_most);
    print_failures(r, n);
    if (f.scaled > 0)
        printf("  %zu of them scaled to lie in the frame with a margin\n", f.scaled);
    if (f.differing > 0)
        printf("  %zu of them came out different in another run\n", f.differing);
}

static void print_families(const match_result *r, size_t n)
{
    printf("%-11s %5s %6s %23s %17s %7s %8s %8s %7s %12s  %s\n%-11s %5s %6s %7s %7s %7s %8s %8s %7s %8s %8s %7s %6s %5s  %s\n",
           "", "", "", "solver ms", "mean residual px", "worst", "least", "mean", "px off", "steps", "not solved:",
           "family", "pairs", "solved", "mean", "median", "worst", "up", "down", "px", "Jacobian", "distort.", "truth", "mean",
           "most", "seeds");
    for (size_t i = 0, k; i < n; i += k) {
        k = family_run(r + i, n - i);
        if (r[i].family != PAIRS_NAMED)
            print_family(r + i, k);
    }
}

static void print_figures(const char *words, const match_figures *f)
{
    const judged *j = &f->is;
    printf("%-34s %6s %9.3f %8.4f %7.2f %8.4f %7.2f %9.4f %8.3f", words, judged_solved(j) ? "yes" : "NO", f->ms,
           j->up_mean, j->up_max, j->down_mean, j->down_max, j->least_jacobian, j->distortion);
    if (isnan(j->off_truth))
        printf(" %7s", "-");
    else
        printf(" %7.2f", j->off_truth);
}

static void print_single(const match_result *r)
{
    char words[40];
    if (r->family == PAIRS_NAMED)
        snprintf(words, sizeof words, "%s", pairs_name(r->seed));
    else
        snprintf(words, sizeof words, "%s, seed %u", pairs_family_word(r->family), (unsigned)r->seed);
    print_figures(words, &r->ours);
    printf(" %6u%s\n", (unsigned)r->ours.steps, r->same_again ? "" : "  DIFFERENT in another run");
    if (r->has_peer) {
        print_figures("  elastix", &r->peer);
        printf(" %6s  ours is %.0f times as fast\n", "", r->peer.ms / r->ours.ms);
    }
}

static bool is_single(const match_result *r)
{
    return r->family == PAIRS_NAMED || r->has_peer;
}

static void print_singles(const match_result *r, size_t n)
{
    printf("\n%-34s %6s %9s %16s %16s %9s %8s %7s\n%-34s %6s %9s %8s %7s %8s %7s %9s %8s %7s %6s\n",
           "", "", "", "px up", "px down", "least", "", "px off", "pair", "solved", "ms", "mean", "max", "mean", "max",
           "Jacobian", "distort.", "truth", "steps");
    for (size_t i = 0; i < n; i++)
        if (is_single(&r[i]))
            print_single(&r[i]);
}

void match_print_tables(const match_result *r, size_t n)
{
    bool families = false, singles = false;
    for (size_t i = 0; i < n; i++) {
        families = families || r[i].family != PAIRS_NAMED;
        singles = singles || is_single(&r[i]);
    }
    if (families)
        print_families(r, n);
    if (singles)
        print_singles(r, n);
}

static void print_csv_row(const match_result *r, const char *solver, const match_figures *f)
{
    const judged *j = &f->is;
    printf("%s,%u,%s,%d,%.4f,%.5f,%.4f,%.5f,%.4f,%.5f,%.4f,", pairs_family_word(r->family), (unsigned)r->seed, solver,
           judged_solved(j), f->ms, j->up_mean, j->up_max, j->down_mean, j->down_max, j->least_jacobian, j->distortion);
    if (!isnan(j->off_truth))
        printf("%.4f", j->off_truth);
    printf(",%u,%d", (unsigned)f->steps, r->scaled);
    if (f == &r->ours)
        printf(",%.5f,%.5f,%.5f,%.4f\n", r->said_up_mean, r->said_down_mean, r->said_jacobian, r->said_distortion);
    else
        puts(",,,,");
}

void match_print_csv(const match_result *r, size_t n)
{
    puts("family,seed,solver,solved,ms,up_mean_px,up_max_px,down_mean_px,down_max_px,least_jacobian,distortion,"
         "off_truth_px,steps,scaled,said_up_mean_px,said_down_mean_px,said_jacobian,said_distortion");
    for (size_t i = 0; i < n; i++) {
        print_csv_row(&r[i], "isoloft", &r[i].ours);
        if (r[i].has_peer)
            print_csv_row(&r[i], "elastix", &r[i].peer);
    }
}

/* ---- limits ---- */

/* 0: none.  Machines differ: where a time is beyond its limit, it stands in that
 * elastix takes RATIO times as long, for neighbouring slices, or for the slowest of
 * the named pairs: what it took where the limits were set. */
static const struct limits {
    pairs_family family;
    size_t may_fail;
    double ms_mean, ms_worst, ratio, residual, off_truth;
} limits[] = {
    { PAIRS_SLICE_LIKE, 0, .25, .5, 3000, .05, 1.3 },
    { PAIRS_DIFFERENT, 0, .6, 0, 3000, 0, 0 },
    { PAIRS_WILD, 0, 0, 0, 0, 0, 0 },
    { PAIRS_MOVED, 0, 0, 0, 0, 0, 0 },
    { PAIRS_NAMED, 1, 0, 7, 200, 0, 0 },
};

enum { STAR = 1 };
static const double STAR_OFF_TRUTH = .5;

static bool say(const char *word, double value, const char *unit, double limit)
{
    bool good = value <= limit;
    printf(", %s %.3g%s %s %.3g", word, value, unit, good ? "within" : "BEYOND", limit);
    return good;
}

/* How many times as long elastix takes for the same neighbouring slices, on
 * average; 0 when it was not tried. */
static double neighbours_ratio(const match_result *r, size_t n)
{
    double peer = 0, ours = 0;
    for (size_t i = 0; i < n; i++)
        if (r[i].family == PAIRS_SLICE_LIKE && r[i].has_peer) {
            peer += r[i].peer.ms;
            ours += r[i].ours.ms;
        }
    return ours > 0 ? peer / ours : 0;
}

/* The same for the pair that takes us longest. */
static double slowest_ratio(const match_result *r, size_t n)
{
    size_t slowest = 0;
    for (size_t i = 0; i < n; i++)
        if (r[i].ours.ms > r[slowest].ours.ms)
            slowest = i;
    return r[slowest].has_peer ? r[slowest].peer.ms / r[slowest].ours.ms : 0;
}

/* Within the limits of time, or so far ahead of elastix that it must be the machine? */
static bool check_time(const family_figures *f, const struct limits *l, double ratio)
{
    bool good = true;
    if (l->ms_mean > 0)
        good = say("mean", f->ms_mean, " ms", l->ms_mean) && good;
    if (l->ms_worst > 0)
        good = say("worst", f->ms_worst, " ms", l->ms_worst) && good;
    if (!good && ratio > 0) {
        good = ratio >= l->ratio;
        printf(" (elastix: %.0f times that, %s %.0f)", ratio, good ? "which stands in: at least" : "LESS than", l->ratio);
    }
    return good;
}

/* R[0..N) is one family; RATIO: neighbours_ratio. */
static bool check_family(const match_result *r, size_t n, double ratio)
{
    const struct limits *l = &limits[r->family];
    family_figures f = figures_of(r, n);
    bool solved = f.pairs - f.solved <= l->may_fail, unfolded = f.least_jacobian > 0, same = f.differing == 0;
    bool good = solved && unfolded && same;
    printf("%-11s %s, %s, %s", pairs_family_word(l->family), solved ? "solved" : "NOT SOLVED", unfolded ? "no fold" : "FOLDED",
           same ? "the same each time" : "DIFFERENT each time");
    good = check_time(&f, l, l->family == PAIRS_NAMED ? slowest_ratio(r, n) : ratio) && good;
    if (l->residual > 0)
        good = say("residual", worse(f.up, f.down), " px", l->residual) && good;
    if (l->off_truth > 0)
        good = say("off truth", f.off_truth, " px", l->off_truth) && good;
    for (size_t i = 0; i < n; i++)
        if (l->family == PAIRS_NAMED && r[i].seed == STAR)
            good = say("star off truth", r[i].ours.is.off_truth, " px", STAR_OFF_TRUTH) && good;
    putchar('\n');
    return good;
}

bool match_check_limits(const match_result *r, size_t n)
{
    double ratio = neighbours_ratio(r, n);
    bool good = true;
    puts("\nlimits");
    for (size_t i = 0, k; i < n; i += k) {
        k = family_run(r + i, n - i);
        good = check_family(r + i, k, ratio) && good;
    }
    if (!good)
        puts("a limit is broken");
    return good;
}
