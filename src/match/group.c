/* group.c - one group on its way through the matcher: frame, outlines, deformation,
 * the image of its upper rings, arcs that correspond, the record. */
#include "config.h"
#include "match/group.h"
#include "base/alloc.h"
#include "match/correspond.h"
#include "match/frame.h"
#include "match/residual.h"
#include "model/lattice.h"

#include <math.h>
#include <string.h>

/* An edge's image is broken where its chord is further off than this, in cells.
 * What is short before and after is taken for straight; of what is long before
 * or after, in cells or in spacings of points, the middle alone does not tell. */
static const double CHORD = 0.5, SHORT = 2, LONG = 16, LONG_SPACINGS = 10;

typedef struct group_match {
    il_pair *pair;
    il_group *group;
    const il_slice *slice[2];
    il_ffd *solver;
    il_frame frame;
    double *xy[2];             /* outlines, cells */
    uint32_t *next[2];
    size_t n[2];
    double spacing;            /* of the points of courses */
    il_fit fit;                /* in cells */
    il_course course[2];
    il_image *image;           /* of the slice's rings */
    il_course_row *row;        /* the image of one ring, cells */
    size_t n_rows, cap_rows;
    il_correspondence found;
} group_match;

static void release(group_match *m)
{
    for (int k = 0; k < 2; k++) {
        il_free(m->xy[k]);
        il_free(m->next[k]);
        il_course_free(&m->course[k]);
    }
    il_fit_free(&m->fit);
    il_free(m->row);
    il_correspondence_free(&m->found);
}

static il_outline outline(const group_match *m, int side)
{
    return (il_outline){ m->xy[side], m->next[side], m->n[side] };
}

/* phi becomes the identity. */
static void stay(il_fit *fit)
{
    il_fit_drop_lattices(fit);
    fit->steps = 0;
    fit->least_jacobian = 1;
    fit->distortion = 0;
    memcpy(fit->global, (double[6]){ 1, 0, 0, 1, 0, 0 }, sizeof fit->global);
}

static il_status solve(group_match *m, il_error *err)
{
    const il_group *g = m->group;
    m->frame = il_frame_about(g, m->slice[0], m->slice[1]);
    il_status st = il_frame_outline(&m->frame, m->slice[0], g->lower, g->n_lower, &m->xy[0], &m->next[0], &m->n[0], err);
    if (st == IL_OK)
        st = il_frame_outline(&m->frame, m->slice[1], g->upper, g->n_upper, &m->xy[1], &m->next[1], &m->n[1], err);
    if (st != IL_OK)
        return st;
    il_outline lower = outline(m, 0), upper = outline(m, 1);
    m->spacing = il_ffd_spacing(&lower, &upper);
    st = il_ffd_solve(m->solver, &lower, &upper, m->frame.cells_x, m->frame.cells_y, &m->fit, err);
    if (st == IL_OK && il_frame_is_far(&m->frame))
        stay(&m->fit);
    return st;
}

/* ---- the image of a ring ---- */

static bool add_row(group_match *m, uint32_t vertex, double t, const double p[2])
{
    if (!il_grow(&m->row, &m->cap_rows, m->n_rows + 1, sizeof *m->row))
        return false;
    m->row[m->n_rows++] = (il_course_row){ vertex, t, p[0], p[1] };
    return true;
}

/* The part [T0, T1) of the edge from A to B, whose ends' images are P and Q: halve it
 * while the image of the middle lies off the chord.  DEPTH halvings at most. */
static bool add_part(group_match *m, uint32_t vertex, const double a[2], const double b[2],
                     double t0, const double p[2], double t1, const double q[2], int depth)
{
    double length = hypot(b[0] - a[0], b[1] - a[1]) * (t1 - t0);
    length = fmax(length, hypot(q[0] - p[0], q[1] - p[1]));
    if (depth == 0 || length < SHORT)
        return add_row(m, vertex, t0, p);
    double t = (t0 + t1) / 2, middle[2] = { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]) };
    il_fit_apply(&m->fit, middle, 1);
    double off = hypot(middle[0] - (p[0] + q[0]) / 2, middle[1] - (p[1] + q[1]) / 2);
    if (off <= CHORD && length <= fmax(LONG, LONG_SPACINGS * m->spacing))
        return add_row(m, vertex, t0, p);
    return add_part(m, vertex, a, b, t0, p, t, middle, depth - 1) &&
           add_part(m, vertex, a, b, t, middle, t1, q, depth - 1);
}

/* Vertices BEGIN .. BEGIN + N of the upper outline, to m->row. */
static il_status map_ring(group_match *m, size_t begin, size_t n, il_error *err)
{
    const double *xy = m->xy[1] + 2 * begin;
    double *image = il_alloc(n, 2 * sizeof *image);
    bool ok = image != NULL;
    m->n_rows = 0;
    if (ok) {
        memcpy(image, xy, 2 * n * sizeof *image);
        il_fit_apply(&m->fit, image, n);
    }
    for (size_t k = 0; ok && k < n; k++) {
        size_t w = k + 1 < n ? k + 1 : 0;
        ok = m->fit.n_lattices == 0 ? add_row(m, (uint32_t)k, 0, image + 2 * k)
                                    : add_part(m, (uint32_t)k, xy + 2 * k, xy + 2 * w, 0, image + 2 * k, 1, image + 2 * w, 8);
    }
    il_free(image);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* The rows in the stack's unit: each place and how far phi moves it, so that what
 * does not move stays where it is to the last bit. */
static il_status note_image(group_match *m, il_image *to, const il_ring *ring, size_t begin, il_error *err)
{
    if (!il_grow(&to->row, &to->cap, m->n_rows, sizeof *to->row))
        return il_fail_nomem(err);
    const double *xy = m->xy[1] + 2 * begin;
    for (size_t k = 0; k < m->n_rows; k++) {
        const il_course_row *r = &m->row[k];
        size_t v = r->vertex, w = v + 1 < ring->n ? v + 1 : 0;
        double was[2], is[2];
        for (size_t c = 0; c < 2; c++) {
            was[c] = ring->xy[2 * v + c] + r->t * (ring->xy[2 * w + c] - ring->xy[2 * v + c]);
            is[c] = xy[2 * v + c] + r->t * (xy[2 * w + c] - xy[2 * v + c]);
        }
        to->row[k] = (il_course_row){ r->vertex, r->t, was[0] + m->frame.cell * (r->x - is[0]), was[1] + m->frame.cell * (r->y - is[1]) };
    }
    to->n = m->n_rows;
    return IL_OK;
}

static il_status map_upper(group_match *m, il_error *err)
{
    const il_group *g = m->group;
    il_status st = IL_OK;
    size_t begin = 0;
    m->course[1].spacing = m->spacing;
    for (size_t i = 0; st == IL_OK && i < g->n_upper; i++) {
        const il_ring *ring = &m->slice[1]->ring[g->upper[i]];
        st = map_ring(m, begin, ring->n, err);
        if (st == IL_OK)
            st = il_course_add(&m->course[1], m->xy[1] + 2 * begin, ring->n, m->row, m->n_rows, err);
        if (st == IL_OK)
            st = note_image(m, &m->image[g->upper[i]], ring, begin, err);
        begin += ring->n;
    }
    if (st == IL_OK)
        il_course_set_normals(&m->course[1]);
    return st;
}

/* The rings of SIDE as they lie. */
static il_status lay(group_match *m, int side, il_course *course, il_error *err)
{
    const il_group *g = m->group;
    const uint32_t *ring = side == 0 ? g->lower : g->upper;
    il_status st = IL_OK;
    size_t begin = 0;
    course->spacing = m->spacing;
    for (size_t i = 0; st == IL_OK && i < (side == 0 ? g->n_lower : g->n_upper); i++) {
        size_t n = m->slice[side]->ring[ring[i]].n;
        st = il_course_add(course, m->xy[side] + 2 * begin, n, NULL, 0, err);
        begin += n;
    }
    if (st == IL_OK)
        il_course_set_normals(course);
    return st;
}

/* ---- into the record ---- */

static il_arc arc_in_slice(const uint32_t *ring, il_arc a)
{
    a.from.ring = a.to.ring = ring[a.from.ring];
    return a;
}

static bool record_arcs(group_match *m)
{
    il_pair *p = m->pair;
    il_group *g = m->group;
    const il_correspondence *c = &m->found;
    if (!il_grow(&p->match, &p->cap_matches, p->n_matches + c->n_matches, sizeof *p->match) ||
        !il_grow(&p->unmatched, &p->cap_unmatched, p->n_unmatched + c->n_unmatched, sizeof *p->unmatched))
        return false;
    for (size_t i = 0; i < c->n_matches; i++) {
        il_match a = c->match[i];
        a.lower = arc_in_slice(g->lower, a.lower);
        a.upper = arc_in_slice(g->upper, a.upper);
        a.residual_mean *= m->frame.cell;
        a.residual_max *= m->frame.cell;
        p->match[p->n_matches++] = a;
    }
    for (size_t i = 0; i < c->n_unmatched; i++) {
        il_unmatched a = c->unmatched[i];
        a.arc = arc_in_slice(a.upper ? g->upper : g->lower, a.arc);
        p->unmatched[p->n_unmatched++] = a;
    }
    return true;
}

/* Where phi is not trusted: the arcs that correspond without it, but not what
 * is left over, for that is said of phi. */
static il_status match_as_they_lie(group_match *m, il_error *err)
{
    il_course upper = IL_COURSE_INIT;
    il_correspondence_free(&m->found);
    il_status st = lay(m, 1, &upper, err);
    if (st == IL_OK)
        st = il_correspond(&m->found, &m->course[0], &upper, true, m->solver, err);
    m->found.n_unmatched = 0;
    if (st == IL_OK && !record_arcs(m))
        st = il_fail_nomem(err);
    il_course_free(&upper);
    return st;
}

static void record_fit(group_match *m, bool keep_lattices)
{
    il_group *g = m->group;
    il_frame_scale_fit(&m->frame, &m->fit);
    g->fit = m->fit;
    g->fitted = true;
    m->fit = (il_fit){ 0 };
    if (!keep_lattices)
        il_fit_drop_lattices(&g->fit);
}

il_status il_group_match(il_pair *pair, il_group *g, const il_slice *lower, const il_slice *upper,
                         il_ffd *solver, bool keep_lattices, il_image *image, il_error *err)
{
    group_match m = { .pair = pair, .group = g, .slice = { lower, upper }, .solver = solver, .image = image };
    il_status st = solve(&m, err);
    if (st == IL_OK)
        st = map_upper(&m, err);
    if (st == IL_OK)
        st = lay(&m, 0, &m.course[0], err);
    if (st == IL_OK)
        st = il_residuals_measure(&m.fit, &m.course[0], &m.course[1], solver, err);
    if (st == IL_OK)
        st = il_correspond(&m.found, &m.course[0], &m.course[1], false, solver, err);
    if (st == IL_OK && !record_arcs(&m))
        st = il_fail_nomem(err);
    if (st == IL_OK) record_fit(&m, keep_lattices);
    if (st == IL_OK && !il_group_is_trusted(g))
        st = match_as_they_lie(&m, err);
    release(&m);
    return st;
}
