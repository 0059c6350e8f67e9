#include "config.h"
#include "pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.141592653589793;
static const double MIDDLE = PAIRS_FRAME / 2.0;

/* ---- outlines, point by point ---- */

static void add(pairs_outline *o, double x, double y)
{
    if (o->n == PAIRS_MOST_POINTS)
        abort();
    o->xy[2 * o->n] = x;
    o->xy[2 * o->n + 1] = y;
    o->n++;
}

/* The point at distance R and angle A from (CX, CY). */
static void add_polar(pairs_outline *o, double cx, double cy, double r, double a)
{
    add(o, cx + r * cos(a), cy + r * sin(a));
}

static double twice_area(const double *xy, size_t n)
{
    double sum = 0;
    for (size_t i = 0, j = n - 1; i < n; j = i++)
        sum += xy[2 * j] * xy[2 * i + 1] - xy[2 * i] * xy[2 * j + 1];
    return sum;
}

static void reverse(double *xy, size_t n)
{
    for (size_t i = 0, j = n - 1; i < j; i++, j--) {
        double p[2];
        memcpy(p, xy + 2 * i, sizeof p);
        memcpy(xy + 2 * i, xy + 2 * j, sizeof p);
        memcpy(xy + 2 * j, p, sizeof p);
    }
}

/* All points since the last ring are one, which is turned counter-clockwise. */
static void end_ring(pairs_outline *o)
{
    size_t begin = o->first[o->n_rings], n = o->n - begin;
    if (twice_area(o->xy + 2 * begin, n) < 0)
        reverse(o->xy + 2 * begin, n);
    for (size_t i = begin; i < o->n; i++)
        o->next[i] = (uint32_t)(i + 1 < o->n ? i + 1 : begin);
    o->first[++o->n_rings] = o->n;
}

/* ---- smooth random outlines ---- */

/* A linear congruential generator modulo 2^32; the lowest bits, which repeat soon, are dropped. */
static double uniform(uint32_t *state) /* in [-1/2, 1/2) */
{
    *state = *state * UINT32_C(1664525) + UINT32_C(1013904223);
    return (*state >> 8) * 0x1p-24 - .5;
}

static uint32_t seeded(uint32_t seed)
{
    return seed * UINT32_C(7919) + 1;
}

enum { N_WAVES = 12, FIRST_WAVE = 2, LAST_WAVE = 8 };

/* Wave k of an outline: cosine and sine. */
typedef struct waves { double c[N_WAVES], s[N_WAVES]; } waves;

static waves random_waves(double size, uint32_t *state)
{
    waves w;
    for (int k = 0; k < N_WAVES; k++) {
        w.c[k] = size * uniform(state);
        w.s[k] = size * uniform(state);
    }
    return w;
}

static double wavy_radius(const waves *w, double angle)
{
    double r = 62;
    for (int k = FIRST_WAVE; k <= LAST_WAVE; k++) /* the finer, the shallower */
        r += 62 * .55 / k * (w->c[k] * cos(k * angle) + w->s[k] * sin(k * angle));
    return r;
}

static void make_wavy(pairs_outline *o, const waves *w, double cx, double cy, double scale)
{
    for (int i = 0; i < 256; i++) {
        double angle = 2 * PI * i / 256, r = wavy_radius(w, angle);
        add(o, cx + scale * 1.1 * r * cos(angle), cy + scale * .9 * r * sin(angle));
    }
    end_ring(o);
}

/* An outline, and it changed by AMPLITUDE times as much as it varies itself. */
static void make_organ(pairs_pair *p, uint32_t seed, double amplitude)
{
    uint32_t state = seeded(seed);
    waves upper = random_waves(1, &state), change = random_waves(amplitude, &state), lower;
    for (int k = 0; k < N_WAVES; k++) {
        lower.c[k] = upper.c[k] + change.c[k];
        lower.s[k] = upper.s[k] + change.s[k];
    }
    double dx = 12 * amplitude * uniform(&state), dy = 12 * amplitude * uniform(&state);
    double scale = 1 + .15 * amplitude * uniform(&state);
    make_wavy(&p->upper, &upper, MIDDLE, MIDDLE, 1);
    make_wavy(&p->lower, &lower, MIDDLE + dx, MIDDLE + dy, scale);
    p->has_truth = true;
}

static void make_moved(pairs_pair *p, uint32_t seed)
{
    make_organ(p, seed, 1);
    uint32_t state = seeded(seed + 100003);
    double turn = PI / 6 * 2 * uniform(&state);
    double dx = 65 * uniform(&state), dy = 65 * uniform(&state), scale = exp(.8 * uniform(&state));
    double c = scale * cos(turn), s = scale * sin(turn);
    for (size_t i = 0; i < p->lower.n; i++) {
        double *at = p->lower.xy + 2 * i, x = at[0] - MIDDLE, y = at[1] - MIDDLE;
        at[0] = MIDDLE + dx + c * x - s * y;
        at[1] = MIDDLE + dy + s * x + c * y;
    }
}

/* ---- the named ones ---- */

static void make_ellipse(pairs_outline *o, double cx, double cy, double rx, double ry, int n)
{
    for (int i = 0; i < n; i++)
        add(o, cx + rx * cos(2 * PI * i / n), cy + ry * sin(2 * PI * i / n));
    end_ring(o);
}

static void make_disc(pairs_outline *o)
{
    make_ellipse(o, MIDDLE, MIDDLE, 75, 75, 256);
}

static void make_star(pairs_outline *o, double turn)
{
    for (int i = 0; i < 256; i++) {
        double angle = 2 * PI * i / 256;
        add_polar(o, MIDDLE, MIDDLE, 62 + 24 * cos(5 * angle), angle + turn);
    }
    end_ring(o);
}

/* From angle FROM to TO in N steps, both ends included. */
static void add_arc(pairs_outline *o, double r, double from, double to, int n)
{
    for (int i = 0; i <= n; i++)
        add_polar(o, MIDDLE, MIDDLE, r, from + (to - from) * i / n);
}

/* Half a circle that rounds an end of the C at angle AT; SIGN 1 goes inward. */
static void add_c_end(pairs_outline *o, double at, double sign)
{
    for (int i = 1; i < 10; i++) {
        double angle = PI * i / 10, along = 70 + sign * 14 * cos(angle), across = sign * 14 * sin(angle);
        add(o, MIDDLE + along * cos(at) - across * sin(at), MIDDLE + along * sin(at) + across * cos(at));
    }
}

/* A ring 28 wide with a mouth of one radian. */
static void make_c(pairs_outline *o)
{
    double end = PI - .5;
    add_arc(o, 84, -end, end, 130);
    add_c_end(o, end, 1);
    add_arc(o, 56, end, -end, 90);
    add_c_end(o, -end, -1);
    end_ring(o);
}

static void make_kidney(pairs_outline *o, double scale, double dx, double dy)
{
    for (int i = 0; i < 256; i++) {
        double angle = 2 * PI * i / 256, from_notch = (i < 128 ? angle : angle - 2 * PI) / .5;
        double r = 50 * (1 - .45 * exp(-from_notch * from_notch));
        add(o, 105 + scale * r * sin(angle) + dx, 105 + scale * 1.25 * r * cos(angle) + dy);
    }
    end_ring(o);
}

/* A point of the bar, ALONG and ACROSS its middle line, which is straight or an arc. */
static void add_to_bar(pairs_outline *o, bool bent, double along, double across)
{
    const double r = 102;
    if (bent)
        add(o, MIDDLE + (r - across) * sin(along / r), 98 + r - (r - across) * cos(along / r));
    else
        add(o, MIDDLE + along, MIDDLE + across);
}

/* 160 long and 10 wide with round ends. */
static void make_bar(pairs_outline *o, bool bent)
{
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i < 110; i++)
            add_to_bar(o, bent, side * (80 - 160.0 * i / 110), side * 5);
        for (int i = 0; i < 16; i++) {
            double angle = PI * i / 16 + side * PI / 2;
            add_to_bar(o, bent, -side * 80 + 5 * cos(angle), 5 * sin(angle));
        }
    }
    end_ring(o);
}

/* Each vertex at a quarter, a half and a quarter of its neighbours and itself. */
static void round_corners(double *xy, size_t n)
{
    double first[2] = { xy[0], xy[1] }, before[2] = { xy[2 * n - 2], xy[2 * n - 1] };
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 2; c++) {
            double here = xy[2 * i + c], after = i + 1 < n ? xy[2 * i + 2 + c] : first[c];
            xy[2 * i + c] = .25 * before[c] + .5 * here + .25 * after;
            before[c] = here;
        }
}

/* A palm with five straight fingers of these lengths. */
static void make_hand(pairs_outline *o, const double length[5], double dx, double dy)
{
    enum { N_CORNERS = 24 };
    const double base = 150, wrist = 215;
    double corner[N_CORNERS + 1][2] = { { 50, wrist }, { 50, base }, [22] = { 200, base }, { 200, wrist }, { 50, wrist } };
    for (int f = 0; f < 5; f++) {
        double x = 54 + 31 * f, tip = base - length[f];
        const double finger[4][2] = { { x, base }, { x, tip }, { x + 18, tip }, { x + 18, base } };
        memcpy(corner[2 + 4 * f], finger, sizeof finger);
    }
    for (int i = 0; i < N_CORNERS; i++) {
        const double *p = corner[i], *q = corner[i + 1];
        int steps = i == N_CORNERS - 1 ? 48 : 18;
        for (int k = 0; k < steps; k++) {
            double t = (double)k / steps;
            add(o, p[0] + dx + t * (q[0] - p[0]), p[1] + dy + t * (q[1] - p[1]));
        }
    }
    for (int k = 0; k < 12; k++)
        round_corners(o->xy, o->n);
    end_ring(o);
}

/* A disc with a finger to the right, 20 wide and 60 long. */
static void make_finger(pairs_outline *o)
{
    for (int i = 0; i <= 200; i++)
        add_polar(o, 110, MIDDLE, 50, .2 + (2 * PI - .4) * i / 200);
    for (int i = 1; i < 26; i++)
        add(o, 159 + 2.4 * i, MIDDLE - 9.9);
    for (int i = 1; i < 13; i++)
        add_polar(o, 219, MIDDLE, 9.9, PI * i / 13 - PI / 2);
    for (int i = 25; i > 0; i--)
        add(o, 159 + 2.4 * i, MIDDLE + 9.9);
    end_ring(o);
}

static void make_branches(pairs_outline *o)
{
    make_ellipse(o, 90, MIDDLE, 32, 36, 160);
    make_ellipse(o, 166, MIDDLE, 32, 36, 160);
}

static void make_blob(pairs_outline *o)
{
    make_ellipse(o, MIDDLE, MIDDLE, 78, 50, 256);
}

static void circle_to_ellipse(pairs_pair *p)
{
    make_ellipse(&p->upper, MIDDLE, MIDDLE, 60, 60, 256);
    make_ellipse(&p->lower, 131, 126, 85, 42, 256);
}

static void star_turned(pairs_pair *p)
{
    make_star(&p->upper, 0);
    make_star(&p->lower, PI / 9);
}

static void c_to_disc(pairs_pair *p)
{
    make_c(&p->upper);
    make_disc(&p->lower);
}

static void disc_to_c(pairs_pair *p)
{
    make_disc(&p->upper);
    make_c(&p->lower);
}

static void kidney_moved(pairs_pair *p)
{
    make_kidney(&p->upper, 1, 0, 0);
    make_kidney(&p->lower, 1.3, 36, 20);
}

static void bar_to_bent(pairs_pair *p)
{
    make_bar(&p->upper, false);
    make_bar(&p->lower, true);
}

static void hand_to_hand(pairs_pair *p)
{
    make_hand(&p->upper, (const double[5]){ 50, 85, 95, 85, 60 }, 0, 0);
    make_hand(&p->lower, (const double[5]){ 75, 60, 110, 70, 85 }, 3, 2);
}

static void branches_to_blob(pairs_pair *p)
{
    make_branches(&p->upper);
    make_blob(&p->lower);
}

static void blob_to_branches(pairs_pair *p)
{
    make_blob(&p->upper);
    make_branches(&p->lower);
}

static void disc_to_finger(pairs_pair *p)
{
    make_ellipse(&p->upper, 110, MIDDLE, 50, 50, 256);
    make_finger(&p->lower);
}

static void organ(pairs_pair *p)
{
    make_organ(p, 5, 1);
}

static const struct named {
    const char *name;
    void (*make)(pairs_pair *);
    bool has_truth;
} named[PAIRS_N_NAMED] = {
    { "circle to ellipse", circle_to_ellipse, true },
    { "star turned by 20 degrees", star_turned, true },
    { "C to disc", c_to_disc, false },
    { "disc to C", disc_to_c, false },
    { "kidney 1.3 times as large, shifted", kidney_moved, true },
    { "thin bar to bent bar", bar_to_bent, true },
    { "hand with other finger lengths", hand_to_hand, true },
    { "two branches to blob", branches_to_blob, false },
    { "blob to two branches", blob_to_branches, false },
    { "disc to disc with finger", disc_to_finger, false },
    { "organ", organ, true },
};

const char *pairs_name(uint32_t seed)
{
    return named[seed % PAIRS_N_NAMED].name;
}

const char *pairs_family_word(pairs_family f)
{
    static const char *const word[PAIRS_N_FAMILIES] = { "slice-like", "different", "wild", "moved", "named" };
    return word[f];
}

void pairs_make(pairs_family f, uint32_t seed, pairs_pair *out)
{
    *out = (pairs_pair){ 0 };
    switch (f) {
    case PAIRS_SLICE_LIKE: make_organ(out, seed, .3); break;
    case PAIRS_DIFFERENT: make_organ(out, seed, 1); break;
    case PAIRS_WILD: make_organ(out, seed, 2); break;
    case PAIRS_MOVED: make_moved(out, seed); break;
    case PAIRS_NAMED:
    default:
        named[seed % PAIRS_N_NAMED].make(out);
        out->has_truth = named[seed % PAIRS_N_NAMED].has_truth;
    }
}
