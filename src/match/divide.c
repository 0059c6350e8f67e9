#include "config.h"
#include "match/divide.h"
#include "base/alloc.h"
#include "match/division.h"

#include <math.h>
#include <string.h>

/* The strip between pieces, in half breadths of the region; and how often it is halved, where
 * nothing is left of a piece. */
static const double SEAM = 0.2;
enum { SEAMS = 4 };

static bool between_outer_rings(const il_link *l)
{
    return l->reason != IL_LINK_OPENING;
}

static void free_division(il_division *d)
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

size_t il_division_region(const il_division *d, int side, uint32_t r)
{
    uint32_t outer = d->outer[side][r];
    size_t low = 0, high = d->n_regions[side]; /* they rise */
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (d->region[side][middle].outer < outer)
            low = middle + 1;
        else
            high = middle;
    }
    return low < d->n_regions[side] && d->region[side][low].outer == outer ? low : d->n_regions[side];
}

static bool add_regions(il_division *d, int side, const uint32_t *ring, size_t n)
{
    d->region[side] = il_calloc(n, sizeof *d->region[side]);
    for (size_t i = 0; d->region[side] && i < n; i++)
        if (d->outer[side][ring[i]] == ring[i])
            d->region[side][d->n_regions[side]++].outer = ring[i];
    for (size_t i = 0; d->region[side] && i < n; i++) {
        size_t at = il_division_region(d, side, ring[i]);
        if (at < d->n_regions[side] && !il_piece_add_ring(&d->region[side][at].outline, &d->slice[side]->ring[ring[i]]))
            return false;
    }
    return d->region[side] != NULL;
}

static bool add_joint(il_division *d, const il_link *l)
{
    il_joint *j = &d->joint[d->n_joints];
    *j = (il_joint){ .link = *l, .region = { il_division_region(d, 0, l->lower), il_division_region(d, 1, l->upper) } };
    for (int s = 0; s < 2; s++) {
        il_region *r = &d->region[s][j->region[s]];
        if (!il_grow(&r->link, &r->cap_links, r->n_links + 1, sizeof *r->link))
            return false;
        r->link[r->n_links++] = (uint32_t)d->n_joints;
    }
    d->n_joints++;
    return true;
}

static il_status gather(il_division *d, il_error *err)
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

/* ---- cutting ------------------------------------------------------------------------- */

static il_status begin_cut(const il_division *d, int side, il_region *r, bool *sound, il_error *err)
{
    double *site = il_alloc(r->n_links, 3 * sizeof *site), *share = site + 2 * r->n_links;
    il_outline own = il_piece_outline(&r->outline);
    if (!site)
        return il_fail_nomem(err);
    for (size_t i = 0; i < r->n_links; i++)
        share[i] = il_piece_centre(&d->region[1 - side][d->joint[r->link[i]].region[1 - side]].outline, site + 2 * i);
    il_status st = il_dissection_begin(&r->cutting, &own, site, share, r->n_links, sound, err);
    il_free(site);
    return st;
}

/* All pieces of R with the seam that it has; *SOUND: something is left of each. */
static il_status cut_pieces(il_division *d, int side, il_region *r, bool *sound, il_error *err)
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

static il_status cut_region(il_division *d, int side, il_region *r, bool *sound, il_error *err)
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

static il_status cut_regions(il_division *d, bool *sound, il_error *err)
{
    il_status st = IL_OK;
    for (int s = 0; st == IL_OK && s < 2; s++)
        for (size_t i = 0; st == IL_OK && *sound && i < d->n_regions[s]; i++)
            st = cut_region(d, s, &d->region[s][i], sound, err);
    return st;
}

/* ---- the whole -------------------------------------------------------------------------- */

/* What the links' phis say together, weighed by length of contour: the global step is the shift
 * on average.  Of a single one that is a deformation, that itself. */
static void sum_up(il_division *d, il_fit *fit)
{
    double whole = 0, squares = 0, shift[2] = { 0, 0 };
    if (d->n_joints == 1 && !d->joint[0].wrapped) {
        *fit = d->joint[0].fit;
        d->joint[0].fit = (il_fit){ 0 };
        return;
    }
    *fit = (il_fit){ .global = { 1, 0, 0, 1, 0, 0 }, .least_jacobian = INFINITY };
    for (size_t i = 0; i < d->n_joints; i++) {
        const il_joint *j = &d->joint[i];
        double length = il_piece_length(il_joint_piece(d, j, 1));
        double distortion = j->wrapped ? il_wrap_distortion(&j->wrap) : j->fit.distortion;
        whole += length;
        for (size_t c = 0; c < 2; c++)
            shift[c] += length * j->shift[c];
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
    il_division d = { .group = g, .slice = { slice[0], slice[1] }, .outer = outer, .solver = solver };
    bool sound = true;
    il_status st = gather(&d, err);
    if (st == IL_OK)
        st = cut_regions(&d, &sound, err);
    for (size_t i = 0; st == IL_OK && sound && i < d.n_joints; i++)
        st = il_joint_solve(&d, &d.joint[i], err);
    for (size_t i = 0; st == IL_OK && sound && i < g->n_upper; i++)
        st = il_division_map_ring(&d, g->upper[i], &image[g->upper[i]], &sound, err);
    if (st == IL_OK && sound)
        st = il_division_record_cuts(&d, pair, err);
    *done = st == IL_OK && sound;
    if (*done)
        sum_up(&d, fit);
    free_division(&d);
    return st;
}
