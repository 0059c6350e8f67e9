/* joint.c - phi of one link of a divided group: see divide.h. */
#include "config.h"
#include "match/division.h"
#include "base/alloc.h"
#include "model/lattice.h"

#include <math.h>
#include <string.h>

const il_piece *il_joint_piece(const il_division *d, const il_joint *j, int side)
{
    const il_region *r = &d->region[side][j->region[side]];
    return r->cut ? &j->piece[side] : &r->outline;
}

static bool in_cells(const il_frame *f, const il_piece *p, il_piece *out)
{
    bool ok = il_piece_move(out, p, 0, 0);
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
        il_fit_apply(f, q, PARTS + 1);
        for (size_t k = 0; k < PARTS; k++)
            sum += hypot(q[2 * k + 2] - q[2 * k], q[2 * k + 3] - q[2 * k + 1]);
    }
    return sum;
}

static bool fits(const il_fit *f, const il_piece *upper, const il_piece *lower)
{
    return f->residual_up_max <= FITS && f->residual_down_max <= FITS && f->distortion <= DISTORTION_MOST &&
           f->least_jacobian >= JACOBIAN_LEAST && way_of(upper, f) <= LENGTH_MOST * il_piece_length(lower);
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
static il_status add_anchors(const il_division *d, const il_joint *j, int side, il_anchor *to, size_t *n, il_error *err)
{
    il_region *r = &d->region[side][j->region[side]];
    il_status st = IL_OK;
    size_t own = 0;
    while (&d->joint[r->link[own]] != j)
        own++;
    for (size_t k = 0; r->cut && k < r->n_links && st == IL_OK; k++) {
        const il_joint *other = &d->joint[r->link[k]];
        double *cut = side == 0 ? to[*n].to : to[*n].from, *faces = side == 0 ? to[*n].from : to[*n].to;
        bool meet = false;
        if (other != j)
            st = il_dissection_meet(&r->cutting, own, k, &meet, cut, err);
        if (!meet)
            continue;
        nearest_to(il_joint_piece(d, j, 1 - side), il_joint_piece(d, other, 1 - side), faces);
        ++*n;
    }
    return st;
}

static il_status find_anchors(const il_division *d, const il_joint *j, il_anchor **anchor, size_t *n, il_error *err)
{
    *n = 0;
    *anchor = il_alloc(d->region[0][j->region[0]].n_links + d->region[1][j->region[1]].n_links, sizeof **anchor);
    il_status st = *anchor ? IL_OK : il_fail_nomem(err);
    for (int side = 0; side < 2 && st == IL_OK; side++)
        st = add_anchors(d, j, side, *anchor, n, err);
    return st;
}

static il_status wrap_joint(const il_division *d, il_joint *j, const il_piece *upper, const il_piece *lower, il_error *err)
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

/* First the shift that lays centre on centre, then what the solver finds. */
il_status il_joint_solve(il_division *d, il_joint *j, il_error *err)
{
    const il_piece *lower = il_joint_piece(d, j, 0), *upper = il_joint_piece(d, j, 1);
    il_piece shifted = { 0 }, cells[2] = { { 0 }, { 0 } };
    double to[2], from[2], box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    il_piece_centre(lower, to);
    il_piece_centre(upper, from);
    double *shift = j->shift;
    shift[0] = to[0] - from[0];
    shift[1] = to[1] - from[1];
    bool ok = il_piece_move(&shifted, upper, shift[0], shift[1]);
    if (ok) {
        il_frame_extend(box, lower->xy, lower->n);
        il_frame_extend(box, shifted.xy, shifted.n);
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
