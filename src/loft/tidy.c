#include "config.h"
#include "loft/tidy.h"
#include "base/alloc.h"
#include "loft/certificate.h"
#include "loft/flip.h"
#include "loft/thin.h"

#include <string.h>

/* Thinned and flipped PASSES times over; what meets is left as it was ROUNDS times. */
enum { PASSES = 2, ROUNDS = 3 };

typedef struct tidying {
    const il_section *section[2];
    il_net net;
    il_surface tidy;
    uint32_t *triangle;      /* of the net, for each of TIDY */
    unsigned char *touched;  /* the same of TIDY as the net's of the net */
} tidying;

static il_status change(tidying *d, const il_surface *s, size_t *n_changes, il_error *err)
{
    il_status st = IL_OK;
    for (int pass = 0; st == IL_OK && pass < PASSES; pass++) {
        size_t n = 0;
        st = il_thin(&d->net, &n, err);
        *n_changes += n + il_flip_edges(&d->net);
    }
    if (st == IL_OK)
        st = il_net_surface(&d->net, s, &d->tidy, &d->triangle, err);
    d->touched = st == IL_OK ? il_alloc(d->net.n_triangles, 1) : NULL;
    if (st == IL_OK && !d->touched)
        st = il_fail_nomem(err);
    for (size_t t = 0; st == IL_OK && t < d->tidy.n_triangles; t++)
        d->touched[t] = d->net.touched[d->triangle[t]];
    return st;
}

/* Fix the corners of touched triangles that meet others; *FOUND: are there any? */
static il_status fix_meeting(tidying *d, unsigned char *fixed, bool *found, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n = 0;
    il_status st = il_certify_between(&d->tidy, d->section[0], d->section[1], NULL, d->touched, &pair, &n, err);
    for (size_t i = 0; i < 2 * n; i++)
        for (size_t k = 0; d->touched[pair[i]] && k < 3; k++) {
            fixed[d->net.at[3 * (size_t)d->triangle[pair[i]] + k]] = 1;
            *found = true;
        }
    il_free(pair);
    return st;
}

/* One round with FIXED vertices, which may become more: then it is to be done AGAIN. */
static il_status try_tidy(tidying *d, const il_surface *s, unsigned char *fixed, bool *sound, bool *again, il_error *err)
{
    size_t n_changes = 0;
    il_verdict v = { .flaw = IL_FLAW_NONE };
    il_status st = il_net_make(&d->net, s, d->section[0], d->section[1], err);
    for (size_t i = 0; st == IL_OK && i < d->net.n_vertices; i++)
        d->net.fixed[i] |= fixed[i];
    if (st == IL_OK)
        st = change(d, s, &n_changes, err);
    if (st == IL_OK && n_changes > 0)
        st = il_certify_edges(&d->tidy, d->section[0], d->section[1], &v, err);
    if (st == IL_OK && n_changes > 0 && v.flaw == IL_FLAW_NONE)
        st = il_certify_touched(&d->tidy, d->section[0], d->section[1], d->touched, &v, err);
    *sound = st == IL_OK && n_changes > 0 && v.flaw == IL_FLAW_NONE;
    *again = false;
    if (st == IL_OK && v.flaw == IL_FLAW_CROSSING)
        st = fix_meeting(d, fixed, again, err);
    return st;
}

static void end_round(tidying *d)
{
    il_net_free(&d->net);
    il_surface_free(&d->tidy);
    il_free(d->triangle);
    il_free(d->touched);
    d->triangle = NULL;
    d->touched = NULL;
}

il_status il_tidy(il_surface *s, const il_section *lower, const il_section *upper, il_error *err)
{
    if (s->n_triangles == 0)
        return IL_OK;
    tidying d = { .section = { lower, upper } };
    unsigned char *fixed = il_calloc(lower->n_nodes + upper->n_nodes + s->n_inner, 1);
    il_status st = fixed ? IL_OK : il_fail_nomem(err);
    bool again = st == IL_OK, sound = false;
    for (int round = 0; again && round <= ROUNDS; round++) {
        st = try_tidy(&d, s, fixed, &sound, &again, err);
        if (sound)
            il_surface_replace(s, &d.tidy);
        end_round(&d);
    }
    il_free(fixed);
    return st;
}
