#include "config.h"
#include "loft/crowd.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/boxes.h"
#include "loft/reference.h"

#include <math.h>
#include <string.h>

static void free_member(il_member *m)
{
    for (int k = 0; k < 2; k++) {
        il_section_free(&m->section[k]);
        il_free(m->node_of[k]);
        il_free(m->station_of[k]);
    }
    il_outcome_free(&m->outcome);
    memset(m, 0, sizeof *m);
}

il_status il_crowd_gather(il_crowd *c, const il_section *lower, const il_section *upper,
                          const il_pair *pair, bool round_float, il_error *err)
{
    size_t n_rings[2] = { lower->n_rings, upper->n_rings };
    *c = (il_crowd){ .whole = { lower, upper }, .pair = pair, .round_float = round_float };
    il_status st = il_groups_find(&c->groups, pair, n_rings, err);
    if (st == IL_OK)
        st = il_follow_begin(&c->follow, pair, upper, c->groups.of[1], err);
    if (st == IL_OK) {
        c->member = il_calloc(c->groups.n, sizeof *c->member);
        st = c->member ? IL_OK : il_fail_nomem(err);
    }
    return st;
}

void il_crowd_free(il_crowd *c)
{
    for (size_t i = 0; c->member && i < c->groups.n; i++)
        free_member(&c->member[i]);
    il_free(c->member);
    il_follow_free(&c->follow);
    il_groups_free(&c->groups);
    memset(c, 0, sizeof *c);
}

static bool leads(const il_crowd *c, size_t i)
{
    return c->groups.up[i] == i;
}

static size_t count_leaders(const il_crowd *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->groups.n; i++)
        n += leads(c, i);
    return n;
}

/* Member I's section of SIDE: its own, or the whole when it is all there is. */
static const il_section *section_of(const il_crowd *c, const il_member *m, int side)
{
    return m->node_of[side] ? &m->section[side] : c->whole[side];
}

static void join(il_crowd *c, uint32_t a, uint32_t b)
{
    il_forest_join(c->groups.up, a, b);
}

static void join_all(il_crowd *c)
{
    for (uint32_t i = 1; i < c->groups.n; i++)
        join(c, 0, i);
}

/* ---- each alone ---- */

/* Twice the area on the left of the rings, about one of their nodes; below 0
 * for holes without the ring that they are in. */
static double area2(const il_section *s)
{
    double sum = 0, x0 = s->n_nodes > 0 ? s->xy[0] : 0, y0 = s->n_nodes > 0 ? s->xy[1] : 0;
    for (size_t i = 0; i < s->n_stations; i++) {
        const double *a = s->xy + 2 * s->node_at[i], *b = s->xy + 2 * s->node_at[s->next[i]];
        sum += (a[0] - x0) * (b[1] - y0) - (b[0] - x0) * (a[1] - y0);
    }
    return sum;
}

/* What surrounds the group: nothing, or solid on both sides.  Solid in one
 * slice and not in the other is no group that can be lofted alone. */
static bool find_outside(const il_section *lower, const il_section *upper, unsigned char *outside)
{
    bool holes[2] = { area2(lower) < 0, area2(upper) < 0 };
    if (lower->n_stations == 0)
        holes[0] = holes[1];
    if (upper->n_stations == 0)
        holes[1] = holes[0];
    *outside = holes[0] ? IL_OUTSIDE_SOLID : 0;
    return holes[0] == holes[1];
}

/* The record, or null when it has no phi that could be used. */
static const il_pair *record_of(const il_crowd *c)
{
    return c->follow.phi.pair ? c->pair : NULL;
}

/* The matched arcs group by group: group g has match[first[g]] .. match[first[g + 1] - 1]. */
typedef struct arcs {
    uint32_t *first, *match;
} arcs;

static void free_arcs(arcs *a)
{
    il_free(a->first);
    il_free(a->match);
}

/* The joined group of matched arc I, or UINT32_MAX when it does not hold. */
static uint32_t group_of_match(il_crowd *c, size_t i)
{
    const il_match *m = &c->pair->match[i];
    if (m->lower.from.ring >= c->groups.n_rings[0] || m->upper.from.ring >= c->groups.n_rings[1])
        return UINT32_MAX;
    uint32_t own = c->groups.of[1][m->upper.from.ring];
    uint32_t a = il_forest_leader(c->groups.up, c->groups.of[0][m->lower.from.ring]), b = il_forest_leader(c->groups.up, own);
    return a == b && il_follow_holds(&c->follow, i, own) ? a : UINT32_MAX;
}

/* As the groups are joined now; none without a phi.  Of groups that do not follow
 * phi, the arcs that correspond without it. */
static il_status list_arcs(il_crowd *c, arcs *a, il_error *err)
{
    size_t n = record_of(c) ? c->pair->n_matches : 0;
    a->first = il_calloc(c->groups.n + 2, sizeof *a->first);
    a->match = il_alloc(n, sizeof *a->match);
    if (!a->first || !a->match)
        return il_fail_nomem(err);
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            uint32_t g = group_of_match(c, i);
            if (g == UINT32_MAX)
                continue;
            if (pass == 0)
                a->first[g + 2]++;
            else
                a->match[a->first[g + 1]++] = (uint32_t)i;
        }
        for (size_t g = 2; pass == 0 && g < c->groups.n + 2; g++)
            a->first[g] += a->first[g - 1];
    }
    return IL_OK;
}

/* The first of the groups joined in I that follows phi, or UINT32_MAX. */
static uint32_t first_follower(il_crowd *c, uint32_t i)
{
    const il_pair *p = record_of(c);
    for (uint32_t g = i; p && g < p->n_groups; g++)
        if (p->group[g].fitted && c->follow.group[g] && il_forest_leader(c->groups.up, g) == i)
            return g;
    return UINT32_MAX;
}

/* The part of member I's arcs that still holds: match[n_matches] of TASK, which has room. */
static void take_arcs(il_crowd *c, uint32_t i, const arcs *a, uint32_t *match, il_task *task)
{
    task->match = match;
    task->n_matches = 0;
    for (uint32_t k = a->first[i]; k < a->first[i + 1]; k++)
        if (group_of_match(c, a->match[k]) == i)
            match[task->n_matches++] = a->match[k];
}

/* The upper ring of record group G that is linked from farthest away, of those that follow and
 * are nearer than BELOW; UINT32_MAX when there is none, or it is the last that follows. */
static uint32_t farthest_ring(const il_crowd *c, uint32_t g, double below, double *reach)
{
    const il_group *group = &c->pair->group[g];
    uint32_t farthest = UINT32_MAX;
    size_t n = 0;
    *reach = 0;
    for (size_t k = 0; k < group->n_upper; k++)
        n += !c->follow.rests[group->upper[k]];
    for (size_t k = 0; n > 1 && k < group->n_links; k++)
        if (group->link[k].reach > *reach && group->link[k].reach < below && !c->follow.rests[group->link[k].upper]) {
            *reach = group->link[k].reach;
            farthest = group->link[k].upper;
        }
    return farthest;
}

/* Member I by S or P, without upper ring RING too: *NEXT is what comes of it. */
static il_status try_without(il_crowd *c, uint32_t i, uint32_t ring, const arcs *a, uint32_t *match, il_task *task,
                             il_outcome *next, bool *sound, il_error *err)
{
    il_status st = il_follow_rest(&c->follow, ring, true, err);
    take_arcs(c, i, a, match, task);
    il_outcome_free(next);
    if (st == IL_OK)
        st = il_attempt_group(next, task, err);
    *sound = st == IL_OK && next->verdict.flaw == IL_FLAW_NONE;
    return st;
}

/* Each of the rings alone, the farthest first, then the farthest for good and each of the others. */
static il_status leave_out_rings(il_crowd *c, uint32_t i, const arcs *a, uint32_t *match, il_task *task,
                                 il_outcome *next, bool *sound, il_error *err)
{
    il_status st = IL_OK;
    double reach;
    uint32_t ring = farthest_ring(c, i, INFINITY, &reach);
    while (st == IL_OK && !*sound && ring != UINT32_MAX) {
        uint32_t farthest = ring;
        for (; st == IL_OK && ring != UINT32_MAX; ring = farthest_ring(c, i, reach, &reach)) {
            st = try_without(c, i, ring, a, match, task, next, sound, err);
            if (*sound)
                return st;
            if (st == IL_OK)
                st = il_follow_rest(&c->follow, ring, false, err);
        }
        if (st == IL_OK)
            st = il_follow_rest(&c->follow, farthest, true, err);
        ring = farthest_ring(c, i, INFINITY, &reach);
    }
    return st;
}

/* Group I, which lies apart, goes by no attempt as a whole: without some of the upper rings that
 * are linked from far away it may, so that one bad vessel does not cost the others. */
static il_status settle_parts(il_crowd *c, uint32_t i, const arcs *a, il_task *task, il_error *err)
{
    il_outcome next = IL_OUTCOME_INIT;
    uint32_t *match = il_alloc(a->first[i + 1] - a->first[i], sizeof *match);
    bool sound = false;
    task->deformed_only = true;
    il_status st = match ? leave_out_rings(c, i, a, match, task, &next, &sound, err) : il_fail_nomem(err);
    if (sound) {
        il_outcome swap = c->member[i].outcome;
        c->member[i].outcome = next;
        next = swap;
    }
    il_outcome_free(&next);
    il_free(match);
    return st;
}

static il_status settle_member(il_crowd *c, uint32_t i, const arcs *a, il_error *err)
{
    il_member *m = &c->member[i];
    const il_pair *p = record_of(c);
    uint32_t follower = first_follower(c, i);
    il_task task = { .lower = section_of(c, m, 0), .upper = section_of(c, m, 1), .phi = p ? &c->follow.phi : NULL,
                     .match = a->match + a->first[i], .n_matches = a->first[i + 1] - a->first[i],
                     .fit = follower != UINT32_MAX ? &p->group[follower].fit : NULL,
                     .as_they_lie = p && p->n_groups > 0 && follower == UINT32_MAX, .round_float = c->round_float };
    m->settled = true;
    if (m->node_of[0] && !find_outside(task.lower, task.upper, &task.outside)) {
        m->outcome.attempt = IL_ATTEMPT_B;
        m->outcome.verdict.flaw = IL_FLAW_BOUNDARY;
        return IL_OK;
    }
    task.apart = follower != UINT32_MAX && il_group_lies_apart(&p->group[follower]);
    il_status st = il_attempt_group(&m->outcome, &task, err);
    bool in_parts = task.apart && follower == i && m->outcome.attempt == IL_ATTEMPT_B;
    return st == IL_OK && in_parts ? settle_parts(c, i, a, &task, err) : st;
}

/* Take the rings of group I out of the whole sections. */
static il_status take_parts(il_crowd *c, size_t i, const il_group_rings list[2], il_error *err)
{
    il_member *m = &c->member[i];
    il_status st = IL_OK;
    free_member(m);
    for (int k = 0; st == IL_OK && k < 2; k++) {
        const uint32_t *first = list[k].first;
        st = il_section_take(&m->section[k], c->whole[k], list[k].ring + first[i], first[i + 1] - first[i],
                             &m->node_of[k], &m->station_of[k], err);
    }
    return st;
}

static il_status settle_members(il_crowd *c, il_error *err)
{
    arcs a = { NULL, NULL };
    il_group_rings list[2] = { { NULL, NULL }, { NULL, NULL } };
    bool single = count_leaders(c) == 1;
    il_status st = IL_OK;
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = il_group_rings_list(&list[k], &c->groups, k, err);
    if (st == IL_OK)
        st = list_arcs(c, &a, err);
    for (uint32_t i = 0; st == IL_OK && i < c->groups.n; i++) {
        if (!leads(c, i) || c->member[i].settled)
            continue;
        if (single)
            free_member(&c->member[i]);
        else
            st = take_parts(c, i, list, err);
        if (st == IL_OK)
            st = settle_member(c, i, &a, err);
    }
    il_group_rings_free(&list[0]);
    il_group_rings_free(&list[1]);
    free_arcs(&a);
    return st;
}

/* ---- all together ---- */

/* Vertex CODE of member M in the whole, where FIRST of each kind are taken. */
static uint32_t code_in_whole(const il_crowd *c, const il_member *m, uint32_t code, const size_t first[3])
{
    uint32_t where = IL_CODE_WHERE(code), i = IL_CODE_INDEX(code);
    if (where == IL_INNER)
        return IL_CODE(IL_INNER, first[IL_INNER] + i);
    size_t n = m->section[where].n_nodes;
    return IL_CODE(where, i < n ? m->node_of[where][i] : c->whole[where]->n_nodes + first[where] + (i - n));
}

/* Add the surface of M to OUT. */
static bool append(const il_crowd *c, const il_member *m, il_surface *out)
{
    const il_surface *s = &m->outcome.surface;
    size_t first[3] = { out->n_insertions[0], out->n_insertions[1], out->n_inner };
    for (size_t i = 0; i < s->n_triangles; i++) {
        uint32_t v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = code_in_whole(c, m, s->tri[3 * i + k], first);
        if (!il_surface_add_triangle(out, v[0], v[1], v[2]))
            return false;
    }
    for (size_t i = 0; i < s->n_inner; i++)
        if (il_surface_add_inner(out, s->inner + 3 * i) == UINT32_MAX)
            return false;
    for (int k = 0; k < 2; k++) {
        size_t n = s->n_insertions[k];
        if (!il_grow(&out->insertion[k], &out->cap_insertions[k], first[k] + n, sizeof *out->insertion[k]))
            return false;
        for (size_t i = 0; i < n; i++) {
            il_split split = s->insertion[k][i];
            split.station = m->station_of[k][split.station];
            out->insertion[k][first[k] + i] = split;
        }
        out->n_insertions[k] += n;
    }
    return true;
}

/* All members in one surface; *GROUP (to il_free) gets the group of each triangle. */
static il_status assemble(il_crowd *c, il_surface *out, uint32_t **group, il_error *err)
{
    size_t cap = 0;
    for (uint32_t i = 0; i < c->groups.n; i++) {
        if (!leads(c, i))
            continue;
        size_t from = out->n_triangles;
        if (!append(c, &c->member[i], out) || !il_grow(group, &cap, out->n_triangles, sizeof **group))
            return il_fail_nomem(err);
        for (size_t t = from; t < out->n_triangles; t++)
            (*group)[t] = i;
    }
    return IL_OK;
}

/* Boxes in the plane of the groups' surfaces: box[4*groups.n]. */
static void find_boxes(const il_crowd *c, const il_surface *s, const il_section whole[2], const uint32_t *group, double *box)
{
    for (size_t i = 0; i < c->groups.n; i++) {
        box[4 * i] = box[4 * i + 1] = INFINITY;
        box[4 * i + 2] = box[4 * i + 3] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        double p[3], *b = box + 4 * (size_t)group[i / 3];
        il_surface_position(s, &whole[0], &whole[1], s->tri[i], p);
        for (size_t k = 0; k < 2; k++) {
            b[k] = fmin(b[k], p[k]);
            b[k + 2] = fmax(b[k + 2], p[k]);
        }
    }
    for (size_t i = 0; i < c->groups.n; i++) /* groups without triangles: out of the way of all */
        if (box[4 * i] > box[4 * i + 2])
            box[4 * i] = box[4 * i + 1] = box[4 * i + 2] = box[4 * i + 3] = -1e300 + 1e290 * (double)i;
}

/* Leave out the triangles of groups whose boxes overlap no other's: *ANY, are
 * there others?  Many boxes in each other are not worth the count. */
static il_status leave_out_separate(il_crowd *c, const il_surface *s, const il_section whole[2], uint32_t *group,
                                    bool *any, il_error *err)
{
    static const size_t MOST_PAIRS = 1000 * 1000;
    size_t n = c->groups.n, n_pairs = 0;
    double *box = il_alloc(n, 4 * sizeof *box);
    bool *near = il_calloc(n, sizeof *near);
    uint32_t *pair = NULL;
    *any = true;
    il_status st = box && near ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        find_boxes(c, s, whole, group, box);
        il_error many = IL_ERROR_INIT;
        st = il_box_pairs(box, n, MOST_PAIRS, &pair, &n_pairs, &many);
        if (st != IL_OK && st != IL_E_INPUT)
            *err = many;
    }
    if (st == IL_OK) {
        for (size_t i = 0; i < 2 * n_pairs; i++)
            near[pair[i]] = true;
        for (size_t t = 0; t < s->n_triangles; t++)
            if (!near[group[t]])
                group[t] = UINT32_MAX;
        *any = n_pairs > 0;
    }
    il_free(pair);
    il_free(near);
    il_free(box);
    return st == IL_E_INPUT ? IL_OK : st;
}

/* Join the groups that meet. */
static il_status join_meeting(il_crowd *c, const il_surface *s, const il_section whole[2], uint32_t *group, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n_pairs = 0;
    bool any;
    il_status st = leave_out_separate(c, s, whole, group, &any, err);
    if (st == IL_OK && any)
        st = il_certify_between(s, &whole[0], &whole[1], group, NULL, &pair, &n_pairs, err);
    for (size_t i = 0; i < n_pairs; i++)
        join(c, pair[2 * i], pair[2 * i + 1]);
    il_free(pair);
    return st;
}

/* Judge the whole of S as il_certify does, but leave to each group what it has
 * proved for itself. */
static il_status judge(il_crowd *c, const il_surface *s, uint32_t *group, il_verdict *verdict, il_error *err)
{
    il_section whole[2];
    il_status st = IL_OK;
    whole[0] = whole[1] = (il_section)IL_SECTION_INIT;
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = il_section_copy_inserted(&whole[k], c->whole[k], s->insertion[k], s->n_insertions[k], err);
    if (st == IL_OK)
        st = il_certify_edges(s, &whole[0], &whole[1], verdict, err);
    if (st == IL_OK && verdict->flaw != IL_FLAW_NONE)
        join_all(c);
    else if (st == IL_OK)
        st = join_meeting(c, s, whole, group, err);
    il_section_free(&whole[0]);
    il_section_free(&whole[1]);
    return st;
}

/* ---- failures ---- */

static void add_to_box(const il_section *s, double box[4])
{
    for (size_t i = 0; i < 2 * s->n_nodes; i++) {
        box[i % 2] = fmin(box[i % 2], s->xy[i]);
        box[i % 2 + 2] = fmax(box[i % 2 + 2], s->xy[i]);
    }
}

static void member_box(const il_member *m, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    add_to_box(&m->section[0], box);
    add_to_box(&m->section[1], box);
}

/* No attempt was sound for member I alone: what it lies in or over may be what
 * it lacks, a hole its ring for one.  If there is nothing, all are joined. */
static void join_neighbours(il_crowd *c, uint32_t i)
{
    double own[4], box[4];
    bool any = false;
    member_box(&c->member[i], own);
    for (uint32_t k = 0; k < c->groups.n; k++) {
        if (k == i || !c->member[k].node_of[0])
            continue;
        member_box(&c->member[k], box);
        if (box[0] <= own[2] && own[0] <= box[2] && box[1] <= own[3] && own[1] <= box[3]) {
            join(c, i, k);
            any = true;
        }
    }
    if (!any)
        join_all(c);
}

static void join_failed(il_crowd *c)
{
    for (uint32_t i = 0; i < c->groups.n; i++)
        if (c->member[i].settled && c->member[i].outcome.verdict.flaw != IL_FLAW_NONE)
            join_neighbours(c, i);
}

/* Members that were joined have to be settled again; *LEFT: how many groups. */
static void forget_joined(il_crowd *c, size_t *left)
{
    size_t n = count_leaders(c);
    for (uint32_t i = 0; n < *left && i < c->groups.n; i++) {
        uint32_t leader = il_forest_leader(c->groups.up, i);
        if (leader != i) {
            if (c->member[i].settled)
                free_member(&c->member[leader]);
            free_member(&c->member[i]);
        }
    }
    *left = n;
}

/* ---- the whole ---- */

/* One round: settle, assemble, judge.  *DONE unless groups were joined. */
static il_status settle_round(il_crowd *c, il_surface *out, il_verdict *verdict, size_t *left, bool *done, il_error *err)
{
    uint32_t *group = NULL;
    size_t before = *left;
    il_status st = settle_members(c, err);
    if (st == IL_OK && *left == 1) {
        il_outcome *only = &c->member[0].outcome; /* the leader of all */
        *out = only->surface;
        *verdict = only->verdict;
        only->surface = (il_surface)IL_SURFACE_INIT;
        *done = true;
        return IL_OK;
    }
    if (st == IL_OK) {
        join_failed(c);
        if (count_leaders(c) == before)
            st = assemble(c, out, &group, err);
    }
    if (st == IL_OK && count_leaders(c) == before)
        st = judge(c, out, group, verdict, err);
    if (st == IL_OK)
        forget_joined(c, left);
    *done = *left == before;
    il_free(group);
    if (!*done)
        il_surface_free(out);
    return st;
}

il_status il_crowd_settle(il_crowd *c, il_surface *out, il_verdict *verdict, il_error *err)
{
    size_t left = count_leaders(c);
    il_status st = IL_OK;
    *out = (il_surface)IL_SURFACE_INIT;
    for (bool done = false; st == IL_OK && !done;)
        st = settle_round(c, out, verdict, &left, &done, err);
    if (st != IL_OK)
        il_surface_free(out);
    return st;
}

void il_crowd_measure(const il_crowd *c, double length_by[IL_N_ATTEMPTS], double *alone)
{
    for (size_t i = 0; i < c->groups.n; i++) {
        if (!leads(c, i))
            continue;
        const il_member *m = &c->member[i];
        double low = il_section_length(section_of(c, m, 0)), high = il_section_length(section_of(c, m, 1));
        double *to = low > 0 && high > 0 ? &length_by[m->outcome.attempt] : alone;
        *to += low + high;
    }
}
