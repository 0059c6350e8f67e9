/* bench-match.c - what matching two slices takes, and how good it is.
 *
 *     bench-match [--family NAME]... [--seeds N] [--runs N] [--no-peer] [--csv]
 *
 * Solves pairs of slices (tests/pairs.h) by the free-form deformation, N seeds a
 * family (default 200) and the named pairs one by one, in one thread.  The time is
 * the processor's, that of il_ffd_solve and nothing else, the best of N runs
 * (default 5) after one to warm up.  How good phi is, judge.c finds out by itself.
 * Where elastix is installed (Debian: apt-get install elastix) it is put to the
 * named pairs and to some of neighbouring slices, unless --no-peer.  --csv: a row for
 * each pair, and no limits.  The exit status is 1 when a limit is broken, 2 for a wrong option. */
#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "judge.h"
#include "match-table.h"
#include "match/ffd.h"
#include "peer.h"
#include "../pairs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Pairs of neighbouring slices that elastix gets, and how often, for limits hang on
 * them; the named pairs it gets once.  Each run takes it seconds. */
enum { PEER_SEEDS = 3, PEER_RUNS = 3 };

typedef struct options {
    bool family[PAIRS_N_FAMILIES];
    bool csv, no_peer;
    uint32_t seeds, runs;
} options;

/* ---- a pair, placed in the frame ---- */

typedef struct box { double least[2], most[2]; } box;

static void grow_box(box *b, const pairs_outline *o)
{
    for (size_t i = 0; i < 2 * o->n; i++) {
        b->least[i % 2] = fmin(b->least[i % 2], o->xy[i]);
        b->most[i % 2] = fmax(b->most[i % 2], o->xy[i]);
    }
}

static void place(pairs_outline *o, double scale, const double shift[2])
{
    for (size_t i = 0; i < 2 * o->n; i++)
        o->xy[i] = scale * o->xy[i] + shift[i % 2];
}

/* The matcher leaves 0.15 of the longer side all round; a pair that has less is
 * put into the middle, and scaled only when there is no room.  Returns whether. */
static bool put_in_frame(pairs_pair *p)
{
    const double margin = .15;
    box b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
    grow_box(&b, &p->lower);
    grow_box(&b, &p->upper);
    double size = fmax(b.most[0] - b.least[0], b.most[1] - b.least[1]), room = margin * size;
    if (fmin(b.least[0], b.least[1]) >= room && fmax(b.most[0], b.most[1]) <= PAIRS_FRAME - room)
        return false;
    double scale = fmin(1, PAIRS_FRAME / (size + 2 * room)), shift[2];
    for (int c = 0; c < 2; c++)
        shift[c] = PAIRS_FRAME / 2.0 - scale * (b.least[c] + b.most[c]) / 2;
    place(&p->lower, scale, shift);
    place(&p->upper, scale, shift);
    return scale < 1;
}

/* ---- solving it ---- */

static double processor_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static il_outline outline_of(const pairs_outline *o)
{
    return (il_outline){ .xy = o->xy, .next = o->next, .n = o->n };
}

/* Are two fits the same, bit for bit? */
static bool same_fit(const il_fit *a, const il_fit *b)
{
    if (memcmp(a->global, b->global, sizeof a->global) != 0 || a->n_lattices != b->n_lattices ||
        memcmp(&a->least_jacobian, &b->least_jacobian, sizeof a->least_jacobian) != 0)
        return false;
    for (size_t k = 0; k < a->n_lattices; k++) {
        const il_lattice *l = &a->lattice[k], *m = &b->lattice[k];
        if (l->n != m->n || memcmp(l->d, m->d, 2 * l->n * sizeof *l->d) != 0)
            return false;
    }
    return true;
}

static void solve(il_ffd *f, const pairs_pair *p, il_fit *fit)
{
    il_outline lower = outline_of(&p->lower), upper = outline_of(&p->upper);
    il_error err = { 0 };
    *fit = (il_fit){ 0 };
    if (il_ffd_solve(f, &lower, &upper, PAIRS_FRAME, PAIRS_FRAME, true, fit, &err) != IL_OK) {
        fputs("bench-match: out of memory\n", stderr);
        exit(5);
    }
}

/* RUNS times after once; R gets the least time, FIT is the first run's. */
static void solve_often(il_ffd *f, const pairs_pair *p, uint32_t runs, il_fit *fit, match_result *r)
{
    solve(f, p, fit);
    r->ours.ms = INFINITY;
    r->same_again = true;
    for (uint32_t k = 0; k < runs; k++) {
        il_fit again;
        double began = processor_ms();
        solve(f, p, &again);
        r->ours.ms = fmin(r->ours.ms, processor_ms() - began);
        r->same_again = r->same_again && same_fit(fit, &again);
        il_fit_free(&again);
    }
}

/* The least time of RUNS; the result is the same each time. */
static void try_peer(const pairs_pair *p, int runs, match_result *r)
{
    for (int k = 0; k < runs; k++) {
        peer_result peer;
        if (peer_match(p, &peer)) {
            double ms = 1e3 * peer.processor_s;
            if (!r->has_peer)
                r->peer = (match_figures){ .ms = ms, .is = judge(p, &peer.phi), .steps = 1 };
            r->peer.ms = fmin(r->peer.ms, ms);
            r->has_peer = true;
        }
        peer_free(&peer);
    }
}

static match_result measure(il_ffd *f, pairs_family family, uint32_t seed, uint32_t runs, bool with_peer)
{
    match_result r = { .family = family, .seed = seed };
    pairs_pair p;
    il_fit fit;
    pairs_make(family, seed, &p);
    r.scaled = put_in_frame(&p);
    solve_often(f, &p, runs, &fit, &r);
    r.ours.is = judge(&p, &fit);
    r.ours.steps = fit.steps;
    r.said_up_mean = fit.residual_up_mean;
    r.said_down_mean = fit.residual_down_mean;
    r.said_jacobian = fit.least_jacobian;
    r.said_distortion = fit.distortion;
    il_fit_free(&fit);
    if (with_peer)
        try_peer(&p, family == PAIRS_NAMED ? 1 : PEER_RUNS, &r);
    return r;
}

/* ---- all of them ---- */

/* The results, *N of them; free them. */
static match_result *measure_all(const options *o, bool with_peer, size_t *n)
{
    il_ffd *f = NULL;
    match_result *r = NULL;
    size_t cap = 0;
    if (il_ffd_new(&f, NULL) != IL_OK)
        exit(5);
    for (int family = 0; family < PAIRS_N_FAMILIES; family++) {
        uint32_t seeds = family != PAIRS_NAMED ? o->seeds : PAIRS_N_NAMED;
        for (uint32_t seed = 0; o->family[family] && seed < seeds; seed++) {
            bool peer = with_peer && (family == PAIRS_NAMED || (family == PAIRS_SLICE_LIKE && seed < PEER_SEEDS));
            if (!il_grow(&r, &cap, *n + 1, sizeof *r))
                exit(5);
            r[(*n)++] = measure(f, (pairs_family)family, seed, o->runs, peer);
        }
    }
    il_ffd_free(f);
    return r;
}

/* Other work on the machine spoils times: the load of the last minute, or -1. */
static double machine_load(void)
{
    char text[80] = "";
    double load = -1;
    FILE *f = fopen("/proc/loadavg", "r");
    if (f) {
        if (fgets(text, sizeof text, f))
            il_number_parse(text, strcspn(text, " "), &load);
        fclose(f);
    }
    return load;
}

static void print_conditions(const options *o, bool has_peer)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    double load = machine_load();
    printf("matching in one thread, best of %u runs, processor time; px: cells of a %d x %d frame\n", (unsigned)o->runs,
           PAIRS_FRAME, PAIRS_FRAME);
    printf("solved: both mean residuals below 0.25 px, no fold;  up: phi(upper) to lower, down: lower to phi(upper)\n");
    if (load > (double)processors)
        printf("the machine is busy: load %.1f on %ld processors; times are too long\n", load, processors);
    if (has_peer)
        printf("elastix on distance maps of the same outlines, one thread, start included: neighbouring slices best of %d runs, "
               "named pairs one run\n", PEER_RUNS);
    else if (!o->no_peer)
        puts("elastix is not installed: no ratio");
    putchar('\n');
    fflush(stdout);
}

/* ---- options ---- */

static bool take_family(options *o, const char *word, bool *first)
{
    for (int f = 0; f < PAIRS_N_FAMILIES; f++)
        if (strcmp(word, pairs_family_word((pairs_family)f)) == 0) {
            if (*first)
                memset(o->family, 0, sizeof o->family);
            *first = false;
            o->family[f] = true;
            return true;
        }
    return false;
}

static bool take_count(const char *word, uint32_t *to)
{
    double v;
    size_t n = strlen(word);
    if (il_number_parse(word, n, &v) != n || n == 0 || !(v >= 1 && v <= 1e6) || v != floor(v))
        return false;
    *to = (uint32_t)v;
    return true;
}

static bool take_options(int argc, char **argv, options *o)
{
    bool first = true, good = true;
    for (int i = 1; good && i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--csv") == 0)
            o->csv = true;
        else if (strcmp(argv[i], "--no-peer") == 0)
            o->no_peer = true;
        else if (strcmp(argv[i], "--family") == 0)
            good = take_family(o, value, &first), i++;
        else if (strcmp(argv[i], "--seeds") == 0)
            good = take_count(value, &o->seeds), i++;
        else if (strcmp(argv[i], "--runs") == 0)
            good = take_count(value, &o->runs), i++;
        else
            good = false;
    }
    return good;
}

int main(int argc, char **argv)
{
    options o = { .family = { true, true, true, true, true }, .seeds = 200, .runs = 5 };
    size_t n = 0;
    if (!take_options(argc, argv, &o)) {
        fputs("usage: bench-match [--family slice-like|different|wild|moved|named]... [--seeds N] [--runs N]\n"
              "                   [--no-peer] [--csv]\n", stderr);
        return 2;
    }
    bool with_peer = !o.no_peer && peer_is_there(), good = true;
    if (!o.csv)
        print_conditions(&o, with_peer);
    match_result *r = measure_all(&o, with_peer, &n);
    if (o.csv) {
        match_print_csv(r, n);
    } else {
        match_print_tables(r, n);
        good = match_check_limits(r, n);
    }
    il_free(r);
    return ferror(stdout) || fflush(stdout) != 0 ? 4 : good ? 0 : 1;
}
