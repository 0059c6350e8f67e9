#include "config.h"
#include "match/divide.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "match/dissect.h"
#include "match/wrap.h"
#include "model/lattice.h"

#include <math.h>
#include <string.h>

/* The strip between pieces, in half breadths of the region; and how often it is halved, where
 * nothing is left of a piece. */
static const double SEAM = 0.2;
enum { SEAMS = 4 };

/* Edges are looked at every so many cells to see whose piece they are in. */
static const double LOOK = 2;

/* A point of the ring is on its piece when it is as near as this, in cells. */
static const double NEAR = 0.05;

/* An outer ring of the group with its holes, and the links that it has: link[n_links]. */
struct region {
    uint32_t outer;
    il_piece outline;          /* of all its rings, unit */
    uint32_t *link;          size_t n_links, cap_links;
    bool cut;
    il_dissection cutting;
    double seam;               /* cells of the dissection */
};

/* A link with the numbers of its regions, its pieces, and its phi, unit: the fit, or the wrap
 * where that does not fit. */
typedef struct joint {
    il_link link;
    size_t region[2];
    il_piece piece[2];
    il_fit fit;
    bool wrapped;
    il_wrap wrap;
    il_bend bend;
} joint;

typedef struct division {
    const il_group *group;
    const il_slice *slice[2];
    const uint32_t *const *outer;
    il_ffd *solver;
    struct region *region[2];       size_t n_regions[2];
    joint *joint;            size_t n_joints;
} division;

static bool between_outer_rings(const il_link *l)
{
    return l->reason != IL_LINK_OPENING;
}

static void free_division(division *d)
{
    for (int s = 0; s < 2; s++) {
        for (size_t i = 0; d->region[s] && i < d->n_regions[s]; i++) {
            il_piece_free(&d->region[s][i].outline);
            il_free(d->region[s][i].link);
            il_dissection_free(&d->region[s][i].cutting);
        }
        il_free(d->region[s]);
    }
    for (size_t i = 0; d->joint && i < d->n_joints; i++) {
        il_piece_free(&d->joint[i].piece[0]);
        il_piece_free(&d->joint[i].piece[1]);
        il_fit_free(&d->joint[i].fit);
        il_wrap_free(&d->joint[i].wrap);
    }
    il_free(d->joint);
}

/* ---- regions and links ------------------------------------------------------------ */

static bool add_ring(il_piece *p, const il_ring *r)
{
    if (!il_grow(&p->xy, &p->cap, 2 * (p->n + r->n), sizeof *p->xy) || !il_grow(&p->next, &p->cap_next, p->n + r->n, sizeof *p->next))
        return false;
    memcpy(p->xy + 2 * p->n, r->xy, 2 * r->n * sizeof *p->xy);
    for (size_t k = 0; k < r->n; k++)
        p->next[p->n + k] = (uint32_t)(p->n + (k + 1 < r->n ? k + 1 : 0));
    p->n += r->n;
    return true;
}

/* The region of ring R on SIDE, or their number. */
static size_t region_of(const division *d, int side, uint32_t r)
{
    size_t i = 0;
    while (i < d->n_regions[side] && d->region[side][i].outer != d->outer[side][r])
        i++;
    return i;
}

static bool add_regions(division *d, int side, const uint32_t *ring, size_t n)
{
    d->region[side] = il_calloc(n, sizeof *d->region[side]);
    for (size_t i = 0; d->region[side] && i < n; i++)
        if (d->outer[side][ring[i]] == ring[i])
            d->region[side][d->n_regions[side]++].outer = ring[i];
    for (size_t i = 0; d->region[side] && i < n; i++) {
        size_t at = region_of(d, side, ring[i]);
        if (at < d->n_regions[side] && !add_ring(&d->region[side][at].outline, &d->slice[side]->ring[ring[i]]))
            return false;
    }
    return d->region[side] != NULL;
}

static bool add_joint(division *d, const il_link *l)
{
    joint *j = &d->joint[d->n_joints];
    *j = (joint){ .link = *l, .region = { region_of(d, 0, l->lower), region_of(d, 1, l->upper) } };
    for (int s = 0; s < 2; s++) {
        struct region *r = &d->region[s][j->region[s]];
        if (!il_grow(&r->link, &r->cap_links, r->n_links + 1, sizeof *r->link))
            return false;
        r->link[r->n_links++] = (uint32_t)d->n_joints;
    }
    d->n_joints++;
    return true;
}

static il_status gather(division *d, il_error *err)
{
    const il_group *g = d->group;
    bool ok = add_regions(d, 0, g->lower, g->n_lower) && add_regions(d, 1, g->upper, g->n_upper);
    d->joint = ok ? il_calloc(g->n_links, sizeof *d->joint) : NULL;
    ok = d->joint != NULL;
    for (size_t i = 0; ok && i < g->n_links; i++) {
        const il_link *l = &g->link[i];
        if (between_outer_rings(l) && d->outer[0][l->lower] == l->lower && d->outer[1][l->upper] == l->upper)
            ok = add_joint(d, l);
    }
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- shapes ------------------------------------------------------------------------ */

/* The centre of area, and how large it is. */
static double centre_of(const il_piece *p, double out[2])
{
    double area = 0, x = 0, y = 0, x0 = p->xy[0], y0 = p->xy[1];
    for (size_t i = 0; i < p->n; i++) {
        const double *a = p->xy + 2 * i, *b = p->xy + 2 * p->next[i];
        double cross = (a[0] - x0) * (b[1] - y0) - (b[0] - x0) * (a[1] - y0);
        area += cross;
        x += cross * (a[0] + b[0] - 2 * x0);
        y += cross * (a[1] + b[1] - 2 * y0);
    }
    out[0] = x0 + (area != 0 ? x / (3 * area) : 0);
    out[1] = y0 + (area != 0 ? y / (3 * area) : 0);
    return fabs(area) / 2;
}

/* A copy of P, moved. */
static bool moved(il_piece *to, const il_piece *p, double dx, double dy)
{
    *to = (il_piece){ 0 };
    if (!il_grow(&to->xy, &to->cap, 2 * p->n, sizeof *to->xy) || !il_grow(&to->next, &to->cap_next, p->n, sizeof *to->next))
        return false;
    for (size_t i = 0; i < p->n; i++) {
        to->xy[2 * i] = p->xy[2 * i] + dx;
        to->xy[2 * i + 1] = p->xy[2 * i + 1] + dy;
        to->next[i] = p->next[i];
    }
    to->n = p->n;
    return true;
}

/* ---- cutting ------------------------------------------------------------------------- */

static il_status begin_cut(const division *d, int side, struct region *r, bool *sound, il_error *err)
{
    double *site = il_alloc(r->n_links, 3 * sizeof *site), *share = site + 2 * r->n_links;
    il_outline own = il_piece_outline(&r->outline);
    if (!site)
        return il_fail_nomem(err);
    for (size_t i = 0; i < r->n_links; i++)
        share[i] = centre_of(&d->region[1 - side][d->joint[r->link[i]].region[1 - side]].outline, site + 2 * i);
    il_status st = il_dissection_begin(&r->cutting, &own, site, share, r->n_links, sound, err);
    il_free(site);
    return st;
}

/* All pieces of R with the seam that it has; *SOUND: something is left of each. */
static il_status cut_pieces(division *d, int side, struct region *r, bool *sound, il_error *err)
{
    il_status st = IL_OK;
    *sound = true;
    for (size_t i = 0; st == IL_OK && *sound && i < r->n_links; i++) {
        il_piece *p = &d->joint[r->link[i]].piece[side];
        il_piece_free(p);
        st = il_dissection_piece(&r->cutting, i, r->seam, p, err);
        *sound = p->n >= 3;
    }
    return st;
}

static il_status cut_region(division *d, int side, struct region *r, bool *sound, il_error *err)
{
    if (r->n_links < 2)
        return IL_OK;
    il_status st = begin_cut(d, side, r, sound, err);
    if (st != IL_OK || !*sound)
        return st;
    r->cut = true;
    r->seam = SEAM * il_dissection_breadth(&r->cutting);
    for (int k = 0; st == IL_OK && k < SEAMS; k++, r->seam /= 2) {
        st = cut_pieces(d, side, r, sound, err);
        if (*sound)
            break;
    }
    return st;
}

static il_status cut_regions(division *d, bool *sound, il_error *err)
{
    il_status st = IL_OK;
    for (int s = 0; st == IL_OK && s < 2; s++)
        for (size_t i = 0; st == IL_OK && *sound && i < d->n_regions[s]; i++)
            st = cut_region(d, s, &d->region[s][i], sound, err);
    return st;
}

/* ---- each link ----------------------------------------------------------------------- */

static const il_piece *piece_of(const division *d, const joint *j, int side)
{
    const struct region *r = &d->region[side][j->region[side]];
    return r->cut ? &j->piece[side] : &r->outline;
}

static void extend(double box[4], const il_piece *p)
{
    for (size_t k = 0; k < 2 * p->n; k++) {
        box[k % 2] = fmin(box[k % 2], p->xy[k]);
        box[k % 2 + 2] = fmax(box[k % 2 + 2], p->xy[k]);
    }
}

static bool in_cells(const il_frame *f, const il_piece *p, il_piece *out)
{
    bool ok = moved(out, p, 0, 0);
    for (size_t i = 0; ok && i < p->n; i++)
        il_frame_to_cells(f, p->xy + 2 * i, out->xy + 2 * i);
    return ok;
}

/* Residuals in cells, distortion, least Jacobian, and length of the image over that of where it
 * lies, beyond which a deformation is no good guide: the last tells where it goes to and fro
 * along the outline, which no residual sees. */
static const double FITS = 1, DISTORTION_MOST = 0.5, JACOBIAN_LEAST = 0.1, LENGTH_MOST = 1.03;

static double way_of(const il_piece *p, const il_fit *f)
{
    enum { PARTS = 4 };
    double sum = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double *a = p->xy + 2 * i, *b = p->xy + 2 * p->next[i];
        double q[2 * (PARTS + 1)];
        for (size_t k = 0; k <= PARTS; k++)
            for (size_t c = 0; c < 2; c++)
                q[2 * k + c] = a[c] + (double)k / PARTS * (b[c] - a[c]);
        if (f)
            il_fit_apply(f, q, PARTS + 1);
        for (size_t k = 0; k < PARTS; k++)
            sum += hypot(q[2 * k + 2] - q[2 * k], q[2 * k + 3] - q[2 * k + 1]);
    }
    return sum;
}

static bool fits(const il_fit *f, const il_piece *upper, const il_piece *lower)
{
    return f->residual_up_max <= FITS && f->residual_down_max <= FITS && f->distortion <= DISTORTION_MOST &&
           f->least_jacobian >= JACOBIAN_LEAST && way_of(upper, f) <= LENGTH_MOST * way_of(lower, NULL);
}

static void apply_wrap(const void *wrap, double p[2])
{
    il_wrap_apply(wrap, p);
}

/* The point of P that is nearest to the outline of Q. */
static void nearest_to(const il_piece *p, const il_piece *q, double out[2])
{
    double least = INFINITY;
    for (size_t i = 0; i < p->n; i++)
        for (size_t k = 0; k < q->n; k++) {
            double away = hypot(p->xy[2 * i] - q->xy[2 * k], p->xy[2 * i + 1] - q->xy[2 * k + 1]);
            if (away < least) {
                least = away;
                memcpy(out, p->xy + 2 * i, 2 * sizeof *out);
            }
        }
}

/* Where joint J's region on SIDE was cut, and where on the other side it faces what lies beyond:
 * anchors of the one to the other, *N of them in TO, which has room. */
static void add_anchors(const division *d, const joint *j, int side, il_anchor *to, size_t *n, il_error *err)
{
    struct region *r = &d->region[side][j->region[side]];
    size_t own = 0;
    while (&d->joint[r->link[own]] != j)
        own++;
    for (size_t k = 0; r->cut && k < r->n_links; k++) {
        const joint *other = &d->joint[r->link[k]];
        double *cut = side == 0 ? to[*n].to : to[*n].from, *faces = side == 0 ? to[*n].from : to[*n].to;
        if (other == j || !il_dissection_meet(&r->cutting, own, k, cut, err))
            continue;
        nearest_to(piece_of(d, j, 1 - side), piece_of(d, other, 1 - side), faces);
        ++*n;
    }
}

static il_status find_anchors(const division *d, const joint *j, il_anchor **anchor, size_t *n, il_error *err)
{
    il_error none = IL_ERROR_INIT;
    *n = 0;
    *anchor = il_alloc(d->region[0][j->region[0]].n_links + d->region[1][j->region[1]].n_links, sizeof **anchor);
    if (!*anchor)
        return il_fail_nomem(err);
    for (int side = 0; side < 2; side++)
        add_anchors(d, j, side, *anchor, n, &none);
    return none.code == IL_OK ? IL_OK : il_fail_nomem(err);
}

static il_status wrap_joint(const division *d, joint *j, const il_piece *upper, const il_piece *lower, il_error *err)
{
    il_anchor *anchor = NULL;
    size_t n;
    il_status st = find_anchors(d, j, &anchor, &n, err);
    if (st == IL_OK)
        st = il_wrap_begin(&j->wrap, upper, lower, anchor, n, &j->wrapped, err);
    il_free(anchor);
    if (st == IL_OK && j->wrapped) {
        j->bend.apply = apply_wrap;
        j->bend.context = &j->wrap;
    }
    return st;
}

/* phi of the link: first the shift that lays centre on centre, then what the solver finds. */
static il_status solve_joint(division *d, joint *j, il_error *err)
{
    const il_piece *lower = piece_of(d, j, 0), *upper = piece_of(d, j, 1);
    il_piece shifted = { 0 }, cells[2] = { { 0 }, { 0 } };
    double to[2], from[2], box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    centre_of(lower, to);
    centre_of(upper, from);
    double shift[2] = { to[0] - from[0], to[1] - from[1] };
    bool ok = moved(&shifted, upper, shift[0], shift[1]);
    if (ok) {
        extend(box, lower);
        extend(box, &shifted);
    }
    il_frame frame = ok ? il_frame_over(box) : (il_frame){ 0 };
    ok = ok && in_cells(&frame, lower, &cells[0]) && in_cells(&frame, &shifted, &cells[1]);
    il_status st = ok ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        il_outline low = il_piece_outline(&cells[0]), high = il_piece_outline(&cells[1]);
        st = il_ffd_solve(d->solver, &low, &high, frame.cells_x, frame.cells_y, false, &j->fit, err);
        j->bend = il_bend_of_fit(&j->fit, frame.cell, il_ffd_spacing(&low, &high));
    }
    if (st == IL_OK && !fits(&j->fit, &cells[1], &cells[0]))
        st = wrap_joint(d, j, upper, lower, err);
    if (st == IL_OK) {
        double *g = j->fit.global;
        il_frame_scale_fit(&frame, &j->fit);
        g[4] += g[0] * shift[0] + g[1] * shift[1];
        g[5] += g[2] * shift[0] + g[3] * shift[1];
        j->bend.straight = !j->wrapped && j->fit.n_lattices == 0;
    }
    il_piece_free(&shifted);
    il_piece_free(&cells[0]);
    il_piece_free(&cells[1]);
    return st;
}

/* ---- images --------------------------------------------------------------------------- */

#define LOOSE UINT32_MAX

/* A ring of an upper region: its points are looked at in order. */
typedef struct walk {
    division *d;
    struct region *region;
    const il_ring *ring;
    il_rows *rows;
    uint32_t *own;           size_t cap_own;   /* of rows: the link that maps them, LOOSE on a seam */
} walk;

static void point_on(const walk *w, size_t k, double t, double out[2])
{
    const double *a = w->ring->xy + 2 * k, *b = w->ring->xy + 2 * (k + 1 < w->ring->n ? k + 1 : 0);
    for (size_t c = 0; c < 2; c++)
        out[c] = a[c] + t * (b[c] - a[c]);
}

/* Is Q on the outline of P, within NEAR? */
static bool is_on(const il_piece *p, const double q[2], double near)
{
    for (size_t i = 0; i < p->n; i++) {
        const double *a = p->xy + 2 * i, *b = p->xy + 2 * p->next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? fmin(fmax(((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / l2, 0), 1) : 0;
        if (hypot(a[0] + t * dx - q[0], a[1] + t * dy - q[1]) <= near)
            return true;
    }
    return false;
}

/* The link, by its number in the region, in whose piece edge K at T is, or UINT32_MAX. */
static uint32_t owner(const walk *w, size_t k, double t)
{
    double p[2];
    point_on(w, k, t, p);
    for (uint32_t i = 0; i < w->region->n_links; i++) {
        if (!w->region->cut)
            return i;
        const il_piece *piece = &w->d->joint[w->region->link[i]].piece[1];
        if (il_dissection_side(&w->region->cutting, i, p, NULL) > w->region->seam)
            return !piece->crumbs || is_on(piece, p, NEAR * w->region->cutting.frame.cell) ? i : LOOSE;
    }
    return LOOSE;
}

/* Between T0, where OWN owns, and T1, where it does not (or the other way round): how far it
 * goes, on its own side. */
static double border(const walk *w, size_t k, uint32_t own, double t0, double t1)
{
    for (int i = 0; i < 30; i++) {
        double t = (t0 + t1) / 2;
        if (owner(w, k, t) == own)
            t0 = t;
        else
            t1 = t;
    }
    return t0;
}

static bool add_loose(walk *w, size_t k)
{
    double p[2];
    point_on(w, k, 0, p);
    size_t n = w->rows->n;
    if (!il_rows_add(w->rows, (uint32_t)k, 0, p) || !il_grow(&w->own, &w->cap_own, w->rows->n, sizeof *w->own))
        return false;
    w->own[n] = LOOSE;
    return true;
}

/* [T0, T1) of edge K as link I maps it; T1 itself, too, when it is no vertex. */
static bool add_mapped(walk *w, size_t k, uint32_t i, double t0, double t1)
{
    const joint *j = &w->d->joint[w->region->link[i]];
    double a[2], b[2], end[2];
    size_t from = w->rows->n;
    point_on(w, k, 0, a);
    point_on(w, k, 1, b);
    if (from > 0 && w->rows->row[from - 1].vertex == k && w->rows->row[from - 1].t >= t0)
        from = --w->rows->n; /* where two pieces meet in one double */
    if (t0 < t1 && !il_rows_add_part(w->rows, &j->bend, (uint32_t)k, a, b, t0, t1))
        return false;
    if (t1 < 1) {
        point_on(w, k, t1, end);
        j->bend.apply(j->bend.context, end);
        if (!il_rows_add(w->rows, (uint32_t)k, t1, end))
            return false;
    }
    if (!il_grow(&w->own, &w->cap_own, w->rows->n, sizeof *w->own))
        return false;
    for (; from < w->rows->n; from++)
        w->own[from] = i;
    return true;
}

/* Edge K: a vertex, and then as the pieces have it. */
static bool add_edge(walk *w, size_t k)
{
    double a[2], b[2];
    point_on(w, k, 0, a);
    point_on(w, k, 1, b);
    double cells = w->region->cut ? hypot(b[0] - a[0], b[1] - a[1]) / w->region->cutting.frame.cell : 0;
    size_t looks = (size_t)fmax(1, fmin(ceil(cells / LOOK), 1000));
    uint32_t own = owner(w, k, 0);
    double since = 0;
    if (own == UINT32_MAX && !add_loose(w, k))
        return false;
    for (size_t i = 1; i <= looks; i++) {
        double t0 = (double)(i - 1) / (double)looks, t1 = (double)i / (double)looks;
        uint32_t next = owner(w, k, t1);
        if (next == own)
            continue;
        if (own != UINT32_MAX && !add_mapped(w, k, own, since, border(w, k, own, t0, t1)))
            return false;
        since = next != UINT32_MAX ? border(w, k, next, t1, t0) : 1;
        own = next;
    }
    return own == UINT32_MAX || since >= 1 || add_mapped(w, k, own, since, 1);
}

static double way(const walk *w, size_t from, size_t to)
{
    double a[2], b[2];
    point_on(w, w->rows->row[from].vertex, w->rows->row[from].t, a);
    point_on(w, w->rows->row[to].vertex, w->rows->row[to].t, b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Loose rows lie on the straight line between the mapped ones before and behind them, in
 * proportion to the way along the ring.  False when none is mapped. */
static bool tie_loose(walk *w)
{
    size_t n = w->rows->n, first = 0;
    il_course_row *row = w->rows->row;
    while (first < n && w->own[first] == LOOSE)
        first++;
    if (first == n)
        return false;
    for (size_t i = first, step = 0; step < n;) {
        size_t end = i, count = 0;
        double whole = 0, so_far = 0;
        do {
            size_t after = (end + 1) % n;
            whole += way(w, end, after);
            end = after;
            count++;
        } while (w->own[end] == LOOSE);
        for (size_t k = 1, at = i; k < count; k++) {
            size_t after = (at + 1) % n;
            so_far += way(w, at, after);
            double part = whole > 0 ? so_far / whole : 0.5;
            row[after].x = row[i].x + part * (row[end].x - row[i].x);
            row[after].y = row[i].y + part * (row[end].y - row[i].y);
            at = after;
        }
        i = end;
        step += count;
    }
    return true;
}

static bool crosses(const il_course_row *a, const il_course_row *b, const il_course_row *c, const il_course_row *e)
{
    const double p[2] = { a->x, a->y }, q[2] = { b->x, b->y }, r[2] = { c->x, c->y }, s[2] = { e->x, e->y };
    return il_orientation(p, q, r) * il_orientation(p, q, s) <= 0 && il_orientation(r, s, p) * il_orientation(r, s, q) <= 0;
}

/* The next mapped row after I, or before it. */
static size_t mapped_from(const walk *w, size_t i, bool ahead)
{
    size_t n = w->rows->n;
    do
        i = ahead ? (i + 1) % n : (i + n - 1) % n;
    while (w->own[i] == LOOSE);
    return i;
}

/* The way over the seam from row I to row K: does it cross the image of I's piece on the other
 * side of I (AHEAD: on which side that is)?  Then I is loose up to there. */
static bool trim_end(walk *w, size_t i, size_t k, bool ahead)
{
    enum { LOOKS = 40 };
    const il_course_row *row = w->rows->row;
    size_t at = mapped_from(w, i, ahead);
    for (int look = 0; look < LOOKS; look++) {
        size_t after = mapped_from(w, at, ahead);
        if (w->own[at] != w->own[i] || w->own[after] != w->own[i] || after == k || after == i)
            return false;
        if (crosses(&row[i], &row[k], &row[at], &row[after])) {
            for (size_t r = i; r != after; r = mapped_from(w, r, ahead))
                w->own[r] = LOOSE;
            return true;
        }
        at = after;
    }
    return false;
}

/* The straight ways over seams must not run into the pieces that they join: where they do, the
 * pieces end sooner. */
static void trim_ends(walk *w)
{
    enum { ROUNDS = 8 };
    size_t n = w->rows->n;
    bool trimmed = true;
    for (int round = 0; trimmed && round < ROUNDS; round++) {
        trimmed = false;
        for (size_t i = 0; i < n; i++) {
            if (w->own[i] == LOOSE)
                continue;
            size_t k = mapped_from(w, i, true);
            if (k != i && w->own[k] != w->own[i])
                trimmed = trim_end(w, i, k, false) || trim_end(w, k, i, true) || trimmed;
        }
    }
}

static il_status map_ring(division *d, uint32_t ring, il_rows *rows, bool *sound, il_error *err)
{
    struct region *r = &d->region[1][region_of(d, 1, ring)];
    walk w = { .d = d, .region = r, .ring = &d->slice[1]->ring[ring], .rows = rows };
    bool ok = true;
    rows->n = 0;
    for (size_t k = 0; ok && k < w.ring->n; k++)
        ok = add_edge(&w, k);
    if (ok && w.region->cut)
        trim_ends(&w);
    *sound = ok && tie_loose(&w);
    il_free(w.own);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- the whole -------------------------------------------------------------------------- */

/* Lines of points, each to be a cut of its own. */
static bool add_cuts(il_pair *pair, bool upper, uint32_t ring, const il_piece *line)
{
    bool *has_before = il_calloc(line->n, sizeof *has_before);
    bool ok = has_before != NULL;
    for (size_t k = 0; ok && k < line->n; k++)
        if (line->next[k] != UINT32_MAX)
            has_before[line->next[k]] = true;
    for (size_t k = 0; ok && k < line->n; k++) {
        if (has_before[k] || line->next[k] == UINT32_MAX)
            continue;
        ok = il_grow(&pair->cut, &pair->cap_cuts, pair->n_cuts + 1, sizeof *pair->cut);
        if (!ok)
            break;
        il_cut *c = &pair->cut[pair->n_cuts++];
        *c = (il_cut){ .upper = upper, .ring = ring };
        for (size_t i = k; ok && i != UINT32_MAX; i = line->next[i]) {
            ok = il_grow(&c->xy, &c->cap, 2 * (c->n + 1), sizeof *c->xy);
            if (ok)
                memcpy(c->xy + 2 * c->n++, line->xy + 2 * i, 2 * sizeof *c->xy);
            if (line->next[i] == UINT32_MAX)
                break;
        }
    }
    il_free(has_before);
    return ok;
}

static il_status record_cuts(division *d, il_pair *pair, il_error *err)
{
    il_status st = IL_OK;
    for (int s = 0; s < 2; s++)
        for (size_t i = 0; i < d->n_regions[s]; i++) {
            struct region *r = &d->region[s][i];
            for (size_t k = 0; st == IL_OK && r->cut && k + 1 < r->n_links; k++) {
                il_piece line = { 0 };
                st = il_dissection_cuts(&r->cutting, k, &line, err);
                if (st == IL_OK && !add_cuts(pair, s == 1, r->outer, &line))
                    st = il_fail_nomem(err);
                il_piece_free(&line);
            }
        }
    return st;
}

/* What the links' phis say together, weighed by length of contour: the global step is the shift
 * on average.  Of a single one that is a deformation, that itself. */
static void sum_up(division *d, il_fit *fit)
{
    double whole = 0, squares = 0, shift[2] = { 0, 0 };
    if (d->n_joints == 1 && !d->joint[0].wrapped) {
        *fit = d->joint[0].fit;
        d->joint[0].fit = (il_fit){ 0 };
        return;
    }
    *fit = (il_fit){ .global = { 1, 0, 0, 1, 0, 0 }, .least_jacobian = INFINITY };
    for (size_t i = 0; i < d->n_joints; i++) {
        const joint *j = &d->joint[i];
        const il_piece *from = piece_of(d, j, 1), *to = piece_of(d, j, 0);
        double length = way_of(from, NULL), centre[2][2];
        double distortion = j->wrapped ? il_wrap_distortion(&j->wrap) : j->fit.distortion;
        centre_of(to, centre[0]);
        centre_of(from, centre[1]);
        whole += length;
        for (size_t c = 0; c < 2; c++)
            shift[c] += length * (centre[0][c] - centre[1][c]);
        squares += length * distortion * distortion;
        fit->least_jacobian = fmin(fit->least_jacobian, j->wrapped ? 1 : j->fit.least_jacobian);
    }
    fit->global[4] = shift[0] / whole;
    fit->global[5] = shift[1] / whole;
    fit->distortion = sqrt(squares / whole);
}

il_status il_group_divide(il_pair *pair, const il_group *g, const il_slice *const slice[2], const uint32_t *const outer[2],
                          il_ffd *solver, il_rows *image, il_fit *fit, bool *done, il_error *err)
{
    division d = { .group = g, .slice = { slice[0], slice[1] }, .outer = outer, .solver = solver };
    bool sound = true;
    il_status st = gather(&d, err);
    if (st == IL_OK)
        st = cut_regions(&d, &sound, err);
    for (size_t i = 0; st == IL_OK && sound && i < d.n_joints; i++)
        st = solve_joint(&d, &d.joint[i], err);
    for (size_t i = 0; st == IL_OK && sound && i < g->n_upper; i++)
        st = map_ring(&d, g->upper[i], &image[g->upper[i]], &sound, err);
    if (st == IL_OK && sound)
        st = record_cuts(&d, pair, err);
    *done = st == IL_OK && sound;
    if (*done)
        sum_up(&d, fit);
    free_division(&d);
    return st;
}
