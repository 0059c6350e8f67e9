/* matcher.c - two slices in, the record of what corresponds out. */
#include "config.h"
#include "match/matcher.h"
#include "base/alloc.h"
#include "match/divide.h"
#include "match/group.h"
#include "match/link.h"

#include <stdlib.h>

/* phi of all upper rings, in order; a ring that was not matched stays. */
static il_status record_images(il_pair *pair, const il_slice *upper, const il_rows *image, il_error *err)
{
    for (uint32_t r = 0; r < upper->n; r++) {
        const il_ring *ring = &upper->ring[r];
        size_t n = image[r].n > 0 ? image[r].n : ring->n;
        if (!il_grow(&pair->phi, &pair->cap_phi, pair->n_phi + n, sizeof *pair->phi))
            return il_fail_nomem(err);
        for (uint32_t k = 0; k < n; k++) {
            il_course_row a = { k, 0, 0, 0 };
            if (image[r].n > 0)
                a = image[r].row[k];
            else
                a.x = ring->xy[2 * k], a.y = ring->xy[2 * k + 1];
            pair->phi[pair->n_phi++] = (il_phi_point){ { r, a.vertex, a.t }, a.x, a.y };
        }
    }
    return IL_OK;
}

/* By whether phi is followed, then by where the lower arc begins, where no other
 * does: the order of the canonical form (formats/loft.txt, section 9), so that
 * lofting, which cuts the first of two seams that meet, sees the same in one
 * process as behind a pipe. */
static int compare_matches(const void *p, const void *q)
{
    const il_match *a = p, *b = q;
    if (a->as_they_lie != b->as_they_lie)
        return a->as_they_lie ? 1 : -1;
    return il_place_compare(&a->lower.from, &b->lower.from);
}

/* The outer rings of all regions, where a group wants them. */
static il_status find_outers(il_group_work *w, uint32_t *outer[2], il_error *err)
{
    bool wanted = false;
    il_status st = IL_OK;
    for (size_t i = 0; i < w->pair->n_groups && !wanted; i++)
        wanted = il_group_lies_apart(&w->pair->group[i]);
    for (int k = 0; k < 2 && wanted && st == IL_OK; k++) {
        w->outer[k] = outer[k] = il_alloc(w->slice[k]->n, sizeof *outer[k]);
        st = outer[k] ? il_link_outers(w->slice[k], outer[k], err) : il_fail_nomem(err);
    }
    return st;
}

static il_status match_groups(il_group_work *w, il_error *err)
{
    uint32_t *outer[2] = { NULL, NULL };
    il_pair *p = w->pair;
    il_status st = find_outers(w, outer, err);
    for (size_t i = 0; st == IL_OK && i < p->n_groups; i++)
        if (p->group[i].n_lower > 0 && p->group[i].n_upper > 0)
            st = il_group_match(w, &p->group[i], err);
    il_free(outer[0]);
    il_free(outer[1]);
    return st;
}

il_status il_match_slices(const il_slice *lower, const il_slice *upper, const il_match_options *o,
                          il_ffd *solver, il_pair *out, il_error *err)
{
    il_group_work w = { .pair = out, .slice = { lower, upper }, .solver = solver, .keep_lattices = o->keep_lattices };
    out->matcher = o->matcher;
    if (o->matcher == IL_MATCHER_NONE)
        return IL_OK; /* the identity: there is nothing to say of it */
    w.image = il_calloc(upper->n, sizeof *w.image);
    il_status st = w.image ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK && !out->linked)
        st = il_link_slices(out, lower, upper, err);
    out->linked = false;
    if (st == IL_OK)
        st = match_groups(&w, err);
    if (st == IL_OK && out->n_matches > 0)
        qsort(out->match, out->n_matches, sizeof *out->match, compare_matches);
    if (st == IL_OK)
        st = record_images(out, upper, w.image, err);
    for (size_t r = 0; w.image && r < upper->n; r++)
        il_free(w.image[r].row);
    il_free(w.image);
    if (st != IL_OK)
        il_pair_free(out);
    return st;
}
