#include "config.h"
#include "match/matcher.h"
#include "base/alloc.h"
#include "match/group.h"
#include "match/link.h"

/* phi of all upper rings, in order; a ring that was not matched stays. */
static il_status record_images(il_pair *pair, const il_slice *upper, const il_image *image, il_error *err)
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

il_status il_match_slices(const il_slice *lower, const il_slice *upper, const il_match_options *o,
                          il_ffd *solver, il_pair *out, il_error *err)
{
    *out = (il_pair)IL_PAIR_INIT;
    out->matcher = o->matcher;
    if (o->matcher == IL_MATCHER_NONE)
        return IL_OK; /* the identity: there is nothing to say of it */
    il_image *image = il_calloc(upper->n, sizeof *image);
    il_status st = image ? il_link_slices(out, lower, upper, err) : il_fail_nomem(err);
    for (size_t i = 0; st == IL_OK && i < out->n_groups; i++)
        if (out->group[i].n_lower > 0 && out->group[i].n_upper > 0)
            st = il_group_match(out, &out->group[i], lower, upper, solver, o->keep_lattices, image, err);
    if (st == IL_OK)
        st = record_images(out, upper, image, err);
    for (size_t r = 0; image && r < upper->n; r++)
        il_free(image[r].row);
    il_free(image);
    if (st != IL_OK)
        il_pair_free(out);
    return st;
}

/* Whether the stream brings a pair is known only when the call after the upper
 * slice comes.  The next stage may take the slices it is given, hence copies.
 * n: slices of this stack so far; waiting: the pair of lower and upper is due. */
typedef struct matcher_stage {
    il_sink sink;
    il_sink *next;
    il_match_options options;
    il_ffd *solver;
    il_slice lower, upper;
    size_t n;
    bool waiting;
} matcher_stage;

static void forget(matcher_stage *m)
{
    il_slice_free(&m->lower);
    il_slice_free(&m->upper);
    m->n = 0;
    m->waiting = false;
}

static il_status match_waiting(matcher_stage *m, il_error *err)
{
    if (!m->waiting)
        return IL_OK;
    m->waiting = false;
    il_pair pair = IL_PAIR_INIT;
    il_status st = il_match_slices(&m->lower, &m->upper, &m->options, m->solver, &pair, err);
    if (st == IL_OK)
        st = m->next->pair(m->next, &pair, err);
    il_pair_free(&pair);
    return st;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    forget(m);
    return m->next->stack_begin(m->next, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    il_status st = match_waiting(m, err);
    if (st != IL_OK)
        return st;
    il_slice_free(&m->lower);
    m->lower = m->upper;
    m->upper = (il_slice)IL_SLICE_INIT;
    st = il_slice_copy(&m->upper, slice, err);
    if (st != IL_OK)
        return st;
    m->waiting = m->n++ > 0;
    return m->next->slice(m->next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    if (!m->waiting)
        return il_fail(err, IL_E_INPUT, pair->line, "a pair record must follow the upper one of its two slices, once");
    m->waiting = false;
    return m->next->pair(m->next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    il_status st = match_waiting(m, err);
    forget(m);
    return st == IL_OK ? m->next->stack_end(m->next, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    return m->next->end(m->next, err);
}

il_status il_matcher_new(il_sink **out, const il_match_options *o, il_sink *next, il_error *err)
{
    *out = NULL;
    matcher_stage *m = il_calloc(1, sizeof *m);
    if (!m)
        return il_fail_nomem(err);
    m->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    m->next = next;
    m->options = *o;
    m->lower = m->upper = (il_slice)IL_SLICE_INIT;
    il_status st = o->matcher == IL_MATCHER_FFD ? il_ffd_new(&m->solver, err) : IL_OK;
    if (st != IL_OK) {
        il_free(m);
        return st;
    }
    *out = &m->sink;
    return IL_OK;
}

void il_matcher_free(il_sink *s)
{
    matcher_stage *m = (matcher_stage *)s;
    if (!m)
        return;
    forget(m);
    il_ffd_free(m->solver);
    il_free(m);
}
