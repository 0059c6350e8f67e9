#include "config.h"
#include "loft/snap.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "bridge/boxes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 wide; /* products of two 54-bit differences */

enum { MAX_ROUNDS = 24, MAX_FOLDS = 64, LEAST_EXPONENT = -1022 }; /* below, 1 / cell overflows */
static const size_t MAX_PAIRS = 20 * 1000 * 1000;
/* A deformation that makes more candidates than this for each edge is wrong:
 * measured are 2 to 12. */
static const size_t MAX_PAIRS_DEFORMED = 200;

/* A piece of a reference edge; the pieces of one edge are linked in order. */
typedef struct piece { uint32_t a, b, next; } piece;

/* Piece runs through POINT; along, from its lesser end, orders a piece's cuts. */
typedef struct cut {
    uint32_t piece, point;
    long double along;
} cut;

typedef struct snapper {
    il_snapped *out;
    il_keymap at;
    piece *piece; size_t n_pieces, cap_pieces;
    cut *cut; size_t n_cuts, cap_cuts;
    size_t max_pairs;
    size_t n_lower;           /* the first of the pieces are the lower side's edges */
    bool whole, folded;       /* no edge was cut yet; two of one deformed side cross, which ends it */
    bool deformed;
} snapper;

static const uint32_t NONE = UINT32_MAX;

/* ---- the grid ---- */

static void extent(const il_reference *r, double low[2], double high[2])
{
    low[0] = low[1] = INFINITY;
    high[0] = high[1] = -INFINITY;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < r->side[k].n; i++) {
            const il_ref_vertex *v = &r->side[k].vertex[i];
            low[0] = fmin(low[0], v->x), high[0] = fmax(high[0], v->x);
            low[1] = fmin(low[1], v->y), high[1] = fmax(high[1], v->y);
        }
}

static double size_of(const il_reference *r)
{
    double low[2], high[2];
    extent(r, low, high);
    double size = fmax(high[0] - low[0], high[1] - low[1]);
    return size > 0 && isfinite(size) ? size : 1;
}

int il_snap_last_exponent(const il_reference *r)
{
    int exponent = ilogb(size_of(r)) - 52;
    return exponent > LEAST_EXPONENT ? exponent : LEAST_EXPONENT;
}

int il_snap_first_exponent(const il_reference *r, bool round_float)
{
    int exponent = ilogb(size_of(r)) - 24, last = il_snap_last_exponent(r); /* 2^-24 is 0.6e-7 */
    double low[2], high[2];
    extent(r, low, high);
    double largest = fmax(fmax(-low[0], high[0]), fmax(-low[1], high[1]));
    exponent = exponent > last ? exponent : last;
    if (!(largest > 0) || !isfinite(largest))
        return exponent;
    int eight_ulps = ilogb(largest) - (round_float ? 20 : 49);
    return eight_ulps > exponent ? eight_ulps : exponent;
}

static uint32_t grid_point(snapper *s, int64_t x, int64_t y)
{
    il_snapped *o = s->out;
    uint32_t *id = il_keymap_put(&s->at, (uint64_t)x, (uint64_t)y, (uint32_t)o->n);
    if (!id)
        return NONE;
    if (*id < o->n)
        return *id;
    if (!il_grow(&o->x, &o->cap_x, o->n + 1, sizeof *o->x) || !il_grow(&o->y, &o->cap_y, o->n + 1, sizeof *o->y))
        return NONE;
    o->x[o->n] = x;
    o->y[o->n] = y;
    return (uint32_t)o->n++;
}

/* The nearest of the first N grid points that is less than a cell from (X, Y), in
 * cells, in both axes; NONE when there is none. */
static uint32_t near_point(const snapper *s, double x, double y, size_t n)
{
    uint32_t best = NONE;
    double least = 1;
    for (int k = 0; k < 4; k++) {
        int64_t gx = (int64_t)floor(x) + k % 2, gy = (int64_t)floor(y) + k / 2;
        uint32_t p = il_keymap_get(&s->at, (uint64_t)gx, (uint64_t)gy, NONE);
        double far = fmax(fabs(x - (double)gx), fabs(y - (double)gy));
        if (p != NONE && p < n && far < least)
            best = p, least = far;
    }
    return best;
}

/* Vertices go to the nearest grid point; those of the upper side to one of the
 * lower side's, if any is near: what is the same but for noise is to be the same
 * here, on whichever side of a rounding threshold it lies. */
static bool place_edges(snapper *s, const il_reference *r)
{
    size_t n_lower = 0;
    for (int k = 0; k < 2; k++) {
        const il_ref_side *side = &r->side[k];
        size_t first = s->n_pieces;
        if (!il_grow(&s->piece, &s->cap_pieces, first + side->n, sizeof *s->piece))
            return false;
        for (size_t i = 0; i < side->n; i++) {
            double x = (side->vertex[i].x - s->out->origin[0]) / s->out->cell;
            double y = (side->vertex[i].y - s->out->origin[1]) / s->out->cell;
            uint32_t p = near_point(s, x, y, n_lower);
            if (p == NONE)
                p = grid_point(s, llrint(x), llrint(y));
            if (p == NONE)
                return false;
            s->piece[first + i] = (piece){ p, NONE, NONE };
        }
        for (size_t i = 0; i < side->n; i++)
            s->piece[first + i].b = s->piece[first + side->next[i]].a;
        s->n_pieces += side->n;
        n_lower = s->out->n;
    }
    return true;
}

/* ---- one round ---- */

static wide cross(const il_snapped *o, uint32_t a, uint32_t b, uint32_t c)
{
    return (wide)(o->x[b] - o->x[a]) * (o->y[c] - o->y[a]) - (wide)(o->y[b] - o->y[a]) * (o->x[c] - o->x[a]);
}

static wide dot(const il_snapped *o, uint32_t a, uint32_t b, uint32_t c)
{
    return (wide)(o->x[b] - o->x[a]) * (o->x[c] - o->x[a]) + (wide)(o->y[b] - o->y[a]) * (o->y[c] - o->y[a]);
}

static bool is_less(const il_snapped *o, uint32_t p, uint32_t q)
{
    return o->x[p] != o->x[q] ? o->x[p] < o->x[q] : o->y[p] < o->y[q];
}

static bool add_cut(snapper *s, uint32_t p, uint32_t point)
{
    const piece *e = &s->piece[p];
    uint32_t from = is_less(s->out, e->a, e->b) ? e->a : e->b, to = from == e->a ? e->b : e->a;
    if (point == e->a || point == e->b)
        return true;
    if (!il_grow(&s->cut, &s->cap_cuts, s->n_cuts + 1, sizeof *s->cut))
        return false;
    s->cut[s->n_cuts++] = (cut){ p, point, (long double)dot(s->out, from, to, point) };
    return true;
}

/* Lead piece P through POINT when it is near: distance^2 = cross^2 / length^2. */
static bool attract(snapper *s, uint32_t p, uint32_t point, wide area)
{
    const piece *e = &s->piece[p];
    if (point == e->a || point == e->b)
        return true;
    wide along = dot(s->out, e->a, e->b, point), length2 = dot(s->out, e->a, e->b, e->b);
    if (along <= 0 || along >= length2)
        return true;
    long double reach2 = (long double)(IL_SNAP_REACH * IL_SNAP_REACH) * (long double)length2;
    if ((long double)area * (long double)area >= reach2)
        return true;
    return add_cut(s, p, point);
}

static int sign(wide v)
{
    return (v > 0) - (v < 0);
}

static bool add_fold(il_snapped *o, uint32_t i, uint32_t j)
{
    if (o->n_folds == MAX_FOLDS)
        return true;
    if (!il_grow(&o->fold, &o->cap_folds, 2 * (o->n_folds + 1), sizeof *o->fold))
        return false;
    o->fold[2 * o->n_folds] = i;
    o->fold[2 * o->n_folds + 1] = j;
    o->n_folds++;
    return true;
}

static bool cut_pair(snapper *s, uint32_t p, uint32_t q)
{
    const piece e = s->piece[p], f = s->piece[q];
    const il_snapped *o = s->out;
    if ((e.a == f.a && e.b == f.b) || (e.a == f.b && e.b == f.a) || e.a == e.b || f.a == f.b)
        return true;
    wide fa = cross(o, e.a, e.b, f.a), fb = cross(o, e.a, e.b, f.b);
    wide ea = cross(o, f.a, f.b, e.a), eb = cross(o, f.a, f.b, e.b);
    size_t before = s->n_cuts;
    if (!attract(s, p, f.a, fa) || !attract(s, p, f.b, fb) || !attract(s, q, e.a, ea) || !attract(s, q, e.b, eb))
        return false;
    if (s->n_cuts > before || sign(fa) * sign(fb) >= 0 || sign(ea) * sign(eb) >= 0)
        return true;
    if (s->deformed && s->whole && (p < s->n_lower) == (q < s->n_lower)) {
        s->folded = true;
        return p < s->n_lower || add_fold(s->out, (uint32_t)(p - s->n_lower), (uint32_t)(q - s->n_lower));
    }
    /* they cross at e.a + t (e.b - e.a), t = ea / (ea - eb) */
    long double t = (long double)ea / (long double)(ea - eb);
    int64_t x = o->x[e.a] + llrintl(t * (long double)(o->x[e.b] - o->x[e.a]));
    int64_t y = o->y[e.a] + llrintl(t * (long double)(o->y[e.b] - o->y[e.a]));
    uint32_t point = grid_point(s, x, y);
    return point != NONE && add_cut(s, p, point) && add_cut(s, q, point);
}

static double *piece_boxes(const snapper *s)
{
    double *box = il_alloc(s->n_pieces, 4 * sizeof *box);
    const il_snapped *o = s->out;
    for (size_t i = 0; box && i < s->n_pieces; i++) {
        double ax = (double)o->x[s->piece[i].a], ay = (double)o->y[s->piece[i].a];
        double bx = (double)o->x[s->piece[i].b], by = (double)o->y[s->piece[i].b];
        box[4 * i] = fmin(ax, bx) - 0.5, box[4 * i + 1] = fmin(ay, by) - 0.5;
        box[4 * i + 2] = fmax(ax, bx) + 0.5, box[4 * i + 3] = fmax(ay, by) + 0.5;
    }
    return box;
}

static il_status find_cuts(snapper *s, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n_pairs = 0;
    double *box = piece_boxes(s);
    if (!box)
        return il_fail_nomem(err);
    s->n_cuts = 0;
    il_status st = il_box_pairs(box, s->n_pieces, s->max_pairs, &pair, &n_pairs, err);
    for (size_t i = 0; st == IL_OK && i < n_pairs && s->out->n_folds < MAX_FOLDS; i++)
        if (!cut_pair(s, pair[2 * i], pair[2 * i + 1]))
            st = il_fail_nomem(err);
    il_free(pair);
    il_free(box);
    return st;
}

static int compare_cuts(const void *p, const void *q)
{
    const cut *a = p, *b = q;
    if (a->piece != b->piece)
        return a->piece < b->piece ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return a->point < b->point ? -1 : a->point > b->point;
}

/* Is P nearer to A and to B than they are to each other?  Any one cut is; of
 * several in one piece only those are made that are so one after another.  Then
 * pieces grow shorter with every cut, and cutting comes to an end. */
static bool shortens(const il_snapped *o, uint32_t a, uint32_t b, uint32_t p)
{
    wide length2 = dot(o, a, b, b);
    return dot(o, a, p, p) < length2 && dot(o, b, p, p) < length2;
}

/* Of the cuts K..END - 1 of a piece, from its lesser end FROM on, keep those that
 * shorten what is left of it; the others wait for the next round. */
static size_t keep_cuts(snapper *s, uint32_t from, uint32_t to, size_t k, size_t end)
{
    size_t kept = k;
    for (; k < end; k++)
        if (shortens(s->out, from, to, s->cut[k].point)) {
            from = s->cut[k].point;
            s->cut[kept++] = s->cut[k];
        }
    return kept;
}

/* Lead piece P through the points of the cuts K..END - 1. */
static bool cut_piece(snapper *s, uint32_t p, size_t k, size_t end)
{
    uint32_t a = s->piece[p].a, b = s->piece[p].b, last = p;
    bool up = is_less(s->out, a, b);
    size_t n = keep_cuts(s, up ? a : b, up ? b : a, k, end) - k;
    if (!il_grow(&s->piece, &s->cap_pieces, s->n_pieces + n, sizeof *s->piece))
        return false;
    for (size_t i = 0; i < n; i++) {
        uint32_t point = s->cut[up ? k + i : k + n - 1 - i].point;
        s->piece[s->n_pieces] = (piece){ point, b, s->piece[last].next };
        s->piece[last].b = point;
        s->piece[last].next = (uint32_t)s->n_pieces;
        last = (uint32_t)s->n_pieces++;
    }
    return true;
}

static bool apply_cuts(snapper *s)
{
    qsort(s->cut, s->n_cuts, sizeof *s->cut, compare_cuts);
    for (size_t k = 0, end; k < s->n_cuts; k = end) {
        for (end = k; end < s->n_cuts && s->cut[end].piece == s->cut[k].piece; end++)
            continue;
        if (!cut_piece(s, s->cut[k].piece, k, end))
            return false;
    }
    return true;
}

/* ---- the result ---- */

static bool collect_runs(snapper *s, const il_reference *r)
{
    size_t first = 0;
    for (int k = 0; k < 2; k++) {
        size_t n_edges = r->side[k].n, n = 0;
        s->out->run[k] = il_alloc(n_edges + 1, sizeof *s->out->run[k]);
        s->out->point[k] = il_alloc(s->n_pieces, sizeof *s->out->point[k]);
        if (!s->out->run[k] || !s->out->point[k])
            return false;
        for (size_t i = 0; i < n_edges; i++) {
            s->out->run[k][i] = (uint32_t)n;
            for (uint32_t p = (uint32_t)(first + i); p != NONE; p = s->piece[p].next)
                s->out->point[k][n++] = s->piece[p].a;
        }
        s->out->run[k][n_edges] = (uint32_t)n;
        s->out->n_points[k] = n;
        first += n_edges;
    }
    return true;
}

/* Who visits a grid point: a node, or POINT, and from which reference vertex. */
typedef struct visitor {
    int32_t who;
    uint32_t vertex;
} visitor;

/* I1: one side visits each grid point once, or as often as rings touch in the
 * one real node that stands there. */
static il_status is_injective(il_snapped *o, const il_reference *r, bool *injective, il_error *err)
{
    enum { FREE = -1, POINT = -2 };
    visitor *list = il_alloc(o->n, sizeof *list);
    il_status st = list ? IL_OK : il_fail_nomem(err);
    for (int k = 0; st == IL_OK && k < 2 && *injective; k++) {
        for (size_t i = 0; i < o->n; i++)
            list[i].who = FREE;
        for (uint32_t i = 0; i < r->side[k].n; i++) {
            const il_ref_vertex *v = &r->side[k].vertex[i];
            for (uint32_t j = o->run[k][i]; j < o->run[k][i + 1]; j++) {
                bool is_node = j == o->run[k][i] && v->t == 0;
                int32_t who = is_node ? (int32_t)r->section[k]->node_at[v->station] : POINT;
                visitor *there = &list[o->point[k][j]];
                if (there->who != FREE && (there->who == POINT || there->who != who)) {
                    *injective = false;
                    if (k == IL_UPPER && r->deformed && !add_fold(o, there->vertex, i))
                        st = il_fail_nomem(err);
                }
                *there = (visitor){ who, i };
            }
        }
    }
    il_free(list);
    return st;
}

il_status il_snap(il_snapped *out, const il_reference *r, int exponent, bool *injective, il_error *err)
{
    size_t n_edges = r->side[0].n + r->side[1].n;
    snapper s = { .out = out, .max_pairs = MAX_PAIRS, .n_lower = r->side[IL_LOWER].n, .deformed = r->deformed, .whole = true };
    if (r->deformed && n_edges < MAX_PAIRS / MAX_PAIRS_DEFORMED)
        s.max_pairs = 100000 + MAX_PAIRS_DEFORMED * n_edges;
    double low[2], high[2];
    il_status st = IL_OK;
    memset(out, 0, sizeof *out);
    extent(r, low, high);
    out->cell = ldexp(1, exponent);
    for (int k = 0; k < 2; k++) /* a multiple of the cell, so that no bit is lost */
        out->origin[k] = isfinite(low[k]) ? rint((low[k] + (high[k] - low[k]) / 2) / out->cell) * out->cell : 0;
    if (!place_edges(&s, r))
        st = il_fail_nomem(err);
    *injective = true;
    for (int round = 0; st == IL_OK && *injective; round++) {
        st = find_cuts(&s, err);
        if (s.folded)
            *injective = false;
        if (st != IL_OK || s.folded || s.n_cuts == 0)
            break;
        if (!apply_cuts(&s))
            st = il_fail_nomem(err);
        s.whole = false;
        *injective = round < MAX_ROUNDS;
    }
    if (st == IL_OK && !collect_runs(&s, r))
        st = il_fail_nomem(err);
    if (st == IL_OK && *injective)
        st = is_injective(out, r, injective, err);
    il_keymap_free(&s.at);
    il_free(s.piece);
    il_free(s.cut);
    if (st != IL_OK)
        il_snapped_free(out);
    return st;
}

void il_snapped_free(il_snapped *s)
{
    il_free(s->x);
    il_free(s->y);
    for (int k = 0; k < 2; k++) {
        il_free(s->run[k]);
        il_free(s->point[k]);
    }
    il_free(s->fold);
    memset(s, 0, sizeof *s);
}

void il_snapped_point(const il_snapped *s, size_t i, double out[2])
{
    out[0] = s->origin[0] + s->cell * (double)s->x[i];
    out[1] = s->origin[1] + s->cell * (double)s->y[i];
}
