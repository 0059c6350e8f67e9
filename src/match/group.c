/* group.c - one group on its way through the matcher: frame, outlines, deformation,
 * the image of its upper rings, arcs that correspond, the record. */
#include "config.h"
#include "match/group.h"
#include "base/alloc.h"
#include "match/correspond.h"
#include "match/divide.h"
#include "match/frame.h"
#include "match/residual.h"
#include "match/rows.h"

#include <math.h>
#include <string.h>

typedef struct group_match {
    const il_group_work *work;
    il_pair *pair;
    il_group *group;
    const il_slice *slice[2];
    il_ffd *solver;
    il_frame frame;
    double *xy[2];             /* outlines, cells */
    uint32_t *next[2];
    size_t n[2];
    double spacing;            /* of the points of courses */
    bool divided;
    il_fit fit;                /* in cells; of a divided group in the stack's unit but for residuals */
    il_course course[2];
    il_rows rows;              /* the image of one ring, cells */
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
    il_free(m->rows.row);
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
    st = il_ffd_solve(m->solver, &lower, &upper, m->frame.cells_x, m->frame.cells_y, true, &m->fit, err);
    if (st == IL_OK && il_frame_is_far(&m->frame))
        stay(&m->fit);
    return st;
}

/* ---- the image of a ring ---- */

/* Vertices BEGIN .. BEGIN + N of the upper outline, to m->rows. */
static il_status map_ring(group_match *m, size_t begin, size_t n, il_error *err)
{
    const il_bend bend = il_bend_of_fit(&m->fit, 1, m->spacing);
    const double *xy = m->xy[1] + 2 * begin;
    m->rows.n = 0;
    for (size_t k = 0; k < n; k++)
        if (!il_rows_add_part(&m->rows, &bend, (uint32_t)k, xy + 2 * k, xy + 2 * (k + 1 < n ? k + 1 : 0), 0, 1))
            return il_fail_nomem(err);
    return IL_OK;
}

/* The rows in the stack's unit: each place and how far phi moves it, so that what
 * does not move stays where it is to the last bit. */
static il_status note_image(group_match *m, il_rows *to, const il_ring *ring, size_t begin, il_error *err)
{
    if (!il_grow(&to->row, &to->cap, m->rows.n, sizeof *to->row))
        return il_fail_nomem(err);
    const double *xy = m->xy[1] + 2 * begin;
    for (size_t k = 0; k < m->rows.n; k++) {
        const il_course_row *r = &m->rows.row[k];
        size_t v = r->vertex, w = v + 1 < ring->n ? v + 1 : 0;
        double was[2], is[2];
        for (size_t c = 0; c < 2; c++) {
            was[c] = ring->xy[2 * v + c] + r->t * (ring->xy[2 * w + c] - ring->xy[2 * v + c]);
            is[c] = xy[2 * v + c] + r->t * (xy[2 * w + c] - xy[2 * v + c]);
        }
        to->row[k] = (il_course_row){ r->vertex, r->t, was[0] + m->frame.cell * (r->x - is[0]), was[1] + m->frame.cell * (r->y - is[1]) };
    }
    to->n = m->rows.n;
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
            st = il_course_add(&m->course[1], m->xy[1] + 2 * begin, ring->n, m->rows.row, m->rows.n, err);
        if (st == IL_OK)
            st = note_image(m, &m->work->image[g->upper[i]], ring, begin, err);
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
    if (m->divided)
        il_frame_scale_found(&m->frame, &m->fit);
    else
        il_frame_scale_fit(&m->frame, &m->fit);
    g->fit = m->fit;
    g->fitted = true;
    m->fit = (il_fit){ 0 };
    if (!keep_lattices)
        il_fit_drop_lattices(&g->fit);
}

/* One phi for the whole group. */
static il_status match_whole(group_match *m, il_error *err)
{
    il_status st = solve(m, err);
    return st == IL_OK ? map_upper(m, err) : st;
}

/* ---- a divided group ---- */

static il_frame frame_over_images(const group_match *m)
{
    const il_group *g = m->group;
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    il_frame_extend_rings(box, m->slice[0], g->lower, g->n_lower);
    for (size_t i = 0; i < g->n_upper; i++) {
        const il_rows *image = &m->work->image[g->upper[i]];
        for (size_t k = 0; k < image->n; k++) {
            box[0] = fmin(box[0], image->row[k].x), box[2] = fmax(box[2], image->row[k].x);
            box[1] = fmin(box[1], image->row[k].y), box[3] = fmax(box[3], image->row[k].y);
        }
    }
    return il_frame_over(box);
}

/* The images that are there, as the course of the upper rings. */
static il_status take_images(group_match *m, il_error *err)
{
    const il_group *g = m->group;
    il_status st = IL_OK;
    size_t begin = 0;
    m->course[1].spacing = m->spacing;
    for (size_t i = 0; st == IL_OK && i < g->n_upper; i++) {
        const il_rows *image = &m->work->image[g->upper[i]];
        size_t n = m->slice[1]->ring[g->upper[i]].n;
        m->rows.n = 0;
        for (size_t k = 0; st == IL_OK && k < image->n; k++) {
            double p[2] = { image->row[k].x, image->row[k].y }, cells[2];
            il_frame_to_cells(&m->frame, p, cells);
            if (!il_rows_add(&m->rows, image->row[k].vertex, image->row[k].t, cells))
                st = il_fail_nomem(err);
        }
        if (st == IL_OK)
            st = il_course_add(&m->course[1], m->xy[1] + 2 * begin, n, m->rows.row, m->rows.n, err);
        begin += n;
    }
    if (st == IL_OK)
        il_course_set_normals(&m->course[1]);
    return st;
}

/* A phi for each link; m->divided unless the group cannot be divided. */
static il_status match_divided(group_match *m, il_error *err)
{
    const il_group *g = m->group;
    il_frame about = il_frame_about(g, m->slice[0], m->slice[1]);
    if (il_frame_is_far(&about))
        return IL_OK;
    il_status st = il_group_divide(m->pair, g, m->slice, m->work->outer, m->solver, m->work->image, &m->fit,
                                   &m->divided, err);
    if (st != IL_OK || !m->divided)
        return st;
    m->frame = frame_over_images(m);
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = il_frame_outline(&m->frame, m->slice[k], k == 0 ? g->lower : g->upper, k == 0 ? g->n_lower : g->n_upper,
                              &m->xy[k], &m->next[k], &m->n[k], err);
    if (st != IL_OK)
        return st;
    il_outline lower = outline(m, 0), upper = outline(m, 1);
    m->spacing = il_ffd_spacing(&lower, &upper);
    st = il_ffd_show(m->solver, &lower, m->frame.cells_x, m->frame.cells_y, err);
    return st == IL_OK ? take_images(m, err) : st;
}

il_status il_group_match(const il_group_work *w, il_group *g, il_error *err)
{
    group_match m = { .work = w, .pair = w->pair, .group = g, .slice = { w->slice[0], w->slice[1] }, .solver = w->solver };
    il_status st = w->outer[0] && il_group_lies_apart(g) ? match_divided(&m, err) : IL_OK;
    if (st == IL_OK && !m.divided)
        st = match_whole(&m, err);
    if (st == IL_OK)
        st = lay(&m, 0, &m.course[0], err);
    if (st == IL_OK)
        st = il_residuals_measure(&m.fit, &m.course[0], &m.course[1], m.solver, err);
    if (st == IL_OK)
        st = il_correspond(&m.found, &m.course[0], &m.course[1], false, m.solver, err);
    if (st == IL_OK && !record_arcs(&m))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        record_fit(&m, w->keep_lattices);
    if (st == IL_OK && !il_group_is_trusted(g))
        st = match_as_they_lie(&m, err);
    release(&m);
    return st;
}
