/* native-pair.c - pair and gap records in the native format's canonical form. */
#include "config.h"
#include "output/native.h"
#include "base/alloc.h"

#include <stdlib.h>
#include <string.h>

/* ---- orders: total, so that equal content gives equal bytes --------------------- */

static int by_index(uint32_t a, uint32_t b)
{
    return a < b ? -1 : a > b;
}

static int by_number(double a, double b)
{
    return a < b ? -1 : a > b;
}

static int by_arc(const il_arc *a, const il_arc *b)
{
    int c = il_place_compare(&a->from, &b->from);
    return c != 0 ? c : il_place_compare(&a->to, &b->to);
}

static int compare_rings(const void *a, const void *b)
{
    return by_index(*(const uint32_t *)a, *(const uint32_t *)b);
}

static int compare_links(const void *va, const void *vb)
{
    const il_link *a = va, *b = vb;
    int c = by_index(a->lower, b->lower);
    if (c == 0)
        c = by_index(a->upper, b->upper);
    if (c == 0)
        c = (int)a->reason - (int)b->reason;
    return c != 0 ? c : by_number(a->reach, b->reach);
}

static int compare_matches(const void *va, const void *vb)
{
    const il_match *a = va, *b = vb;
    int c = (int)a->as_they_lie - (int)b->as_they_lie;
    if (c == 0)
        c = il_place_compare(&a->lower.from, &b->lower.from);
    if (c == 0)
        c = il_place_compare(&a->upper.from, &b->upper.from);
    if (c == 0)
        c = il_place_compare(&a->lower.to, &b->lower.to);
    if (c == 0)
        c = il_place_compare(&a->upper.to, &b->upper.to);
    if (c == 0)
        c = by_number(a->residual_mean, b->residual_mean);
    return c != 0 ? c : by_number(a->residual_max, b->residual_max);
}

static int compare_unmatched(const void *va, const void *vb)
{
    const il_unmatched *a = va, *b = vb;
    int c = (int)a->upper - (int)b->upper;
    if (c == 0)
        c = by_arc(&a->arc, &b->arc);
    return c != 0 ? c : (int)a->event - (int)b->event;
}

static int compare_insertions(const void *va, const void *vb)
{
    const il_insertion *a = va, *b = vb;
    int c = (int)a->upper - (int)b->upper;
    if (c == 0)
        c = il_place_compare(&a->at, &b->at);
    if (c == 0)
        c = by_number(a->x, b->x);
    return c != 0 ? c : by_number(a->y, b->y);
}

/* A cut, and whether its points are written last to first: a line has two
 * spellings, and the lesser one is the canonical. */
typedef struct cut_order {
    const il_cut *cut;
    bool backward;
} cut_order;

static const double *cut_point(const cut_order *c, size_t i)
{
    return c->cut->xy + 2 * (c->backward ? c->cut->n - 1 - i : i);
}

static int by_points(const cut_order *a, const cut_order *b)
{
    size_t n = a->cut->n < b->cut->n ? a->cut->n : b->cut->n;
    int c = 0;
    for (size_t i = 0; c == 0 && i < n; i++) {
        const double *p = cut_point(a, i), *q = cut_point(b, i);
        c = p[0] != q[0] ? by_number(p[0], q[0]) : by_number(p[1], q[1]);
    }
    return c != 0 ? c : (a->cut->n > n) - (b->cut->n > n);
}

static int compare_cuts(const void *va, const void *vb)
{
    const cut_order *a = va, *b = vb;
    int c = (int)a->cut->upper - (int)b->cut->upper;
    if (c == 0)
        c = by_index(a->cut->ring, b->cut->ring);
    return c != 0 ? c : by_points(a, b);
}

/* A group and the ring it is ordered by; groups share no ring. */
typedef struct group_order {
    const il_group *group;
    bool upper;
    uint32_t least;
} group_order;

static int compare_groups(const void *va, const void *vb)
{
    const group_order *a = va, *b = vb;
    int c = (int)a->upper - (int)b->upper;
    return c != 0 ? c : by_index(a->least, b->least);
}

/* A sorted copy of the N elements at FROM; null when there is no memory, and a
 * pointer to free otherwise. */
static void *sorted(const void *from, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    void *copy = il_alloc(n, size);
    if (copy && n > 0) {
        memcpy(copy, from, n * size);
        qsort(copy, n, size, compare);
    }
    return copy;
}

/* ---- words ---------------------------------------------------------------------- */

static void put_numbers(il_output *to, const char *word, const double *v, size_t n)
{
    il_output_string(to, word);
    for (size_t i = 0; i < n; i++)
        il_native_put_number(to, v[i]);
    il_output_char(to, '\n');
}

static void put_point(il_output *to, const double xy[2])
{
    il_output_number(to, xy[0]);
    put_numbers(to, "", xy + 1, 1);
}

static void put_place(il_output *to, const il_place *p)
{
    il_native_put_index(to, p->vertex);
    il_native_put_number(to, p->t);
}

static void put_arc(il_output *to, const il_arc *a)
{
    il_native_put_index(to, a->from.ring);
    put_place(to, &a->from);
    put_place(to, &a->to);
}

/* ---- groups --------------------------------------------------------------------- */

static void write_lattice(il_output *to, const il_lattice *l)
{
    il_output_string(to, "lattice");
    il_native_put_index(to, l->nx);
    il_native_put_index(to, l->ny);
    put_numbers(to, "", (const double[]){ l->x, l->y, l->spacing }, 3);
    for (size_t i = 0; i < l->n; i++)
        put_point(to, &l->d[2 * i]);
}

static void write_fit(il_output *to, const il_fit *f)
{
    const double residual[4] = { f->residual_up_mean, f->residual_up_max, f->residual_down_mean, f->residual_down_max };
    put_numbers(to, "residual", residual, 4);
    put_numbers(to, "jacobian", &f->least_jacobian, 1);
    put_numbers(to, "distortion", &f->distortion, 1);
    il_output_string(to, "steps");
    il_native_put_index(to, f->steps);
    put_numbers(to, "\nglobal", f->global, 6);
    put_numbers(to, "box", f->box, 4);
    for (size_t i = 0; i < f->n_lattices; i++)
        write_lattice(to, &f->lattice[i]);
}

static il_status write_rings(il_output *to, const char *word, const uint32_t *ring, size_t n, il_error *err)
{
    if (n == 0)
        return IL_OK;
    uint32_t *order = sorted(ring, n, sizeof *ring, compare_rings);
    if (!order)
        return il_fail_nomem(err);
    il_output_string(to, word);
    for (size_t i = 0; i < n; i++)
        il_native_put_index(to, order[i]);
    il_output_char(to, '\n');
    il_free(order);
    return IL_OK;
}

static il_status write_links(il_output *to, const il_group *g, il_error *err)
{
    il_link *order = sorted(g->link, g->n_links, sizeof *order, compare_links);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < g->n_links; i++) {
        il_output_string(to, "link");
        il_native_put_index(to, order[i].lower);
        il_native_put_index(to, order[i].upper);
        il_output_char(to, ' ');
        put_numbers(to, il_link_reason_word(order[i].reason), &order[i].reach, 1);
    }
    il_free(order);
    return IL_OK;
}

static il_status write_group(il_output *to, const il_group *g, il_error *err)
{
    il_output_string(to, "group\n");
    il_status st = write_rings(to, "lower", g->lower, g->n_lower, err);
    if (st == IL_OK)
        st = write_rings(to, "upper", g->upper, g->n_upper, err);
    if (st == IL_OK)
        st = write_links(to, g, err);
    if (st == IL_OK && g->fitted)
        write_fit(to, &g->fit);
    return st;
}

static uint32_t least_ring(const il_group *g)
{
    const uint32_t *ring = g->n_lower > 0 ? g->lower : g->upper;
    size_t n = g->n_lower > 0 ? g->n_lower : g->n_upper;
    uint32_t least = UINT32_MAX;
    for (size_t i = 0; i < n; i++)
        least = ring[i] < least ? ring[i] : least;
    return least;
}

static il_status write_groups(il_output *to, const il_pair *p, il_error *err)
{
    group_order *order = il_alloc(p->n_groups, sizeof *order);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n_groups; i++)
        order[i] = (group_order){ &p->group[i], p->group[i].n_lower == 0, least_ring(&p->group[i]) };
    qsort(order, p->n_groups, sizeof *order, compare_groups);
    il_status st = IL_OK;
    for (size_t i = 0; st == IL_OK && i < p->n_groups; i++)
        st = write_group(to, order[i].group, err);
    il_free(order);
    return st;
}

/* ---- phi, arcs and points ---------------------------------------------------------- */

/* phi[] stands in order of place already. */
static void write_phi(il_output *to, const il_pair *p)
{
    for (size_t i = 0; i < p->n_phi; i++) {
        const il_phi_point *q = &p->phi[i];
        if (i == 0 || q->at.ring != q[-1].at.ring) {
            il_output_string(to, "phi");
            il_native_put_index(to, q->at.ring);
            il_output_char(to, '\n');
        }
        il_output_integer(to, q->at.vertex);
        put_numbers(to, "", (const double[]){ q->at.t, q->x, q->y }, 3);
    }
}

static il_status write_matches(il_output *to, const il_pair *p, il_error *err)
{
    il_match *order = sorted(p->match, p->n_matches, sizeof *order, compare_matches);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n_matches; i++) {
        il_output_string(to, order[i].as_they_lie ? "near" : "match");
        put_arc(to, &order[i].lower);
        put_arc(to, &order[i].upper);
        put_numbers(to, "", (const double[]){ order[i].residual_mean, order[i].residual_max }, 2);
    }
    il_free(order);
    return IL_OK;
}

static il_status write_unmatched(il_output *to, const il_pair *p, il_error *err)
{
    static const char *const events[] = {
        [IL_EVENT_BRANCH] = " branch\n", [IL_EVENT_CAP] = " cap\n", [IL_EVENT_HOLE] = " hole\n" };
    il_unmatched *order = sorted(p->unmatched, p->n_unmatched, sizeof *order, compare_unmatched);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n_unmatched; i++) {
        il_output_string(to, order[i].upper ? "unmatched upper" : "unmatched lower");
        put_arc(to, &order[i].arc);
        il_output_string(to, events[order[i].event]);
    }
    il_free(order);
    return IL_OK;
}

static il_status write_cuts(il_output *to, const il_pair *p, il_error *err)
{
    cut_order *order = il_alloc(p->n_cuts, sizeof *order);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n_cuts; i++) {
        const cut_order forward = { &p->cut[i], false }, backward = { &p->cut[i], true };
        order[i] = by_points(&backward, &forward) < 0 ? backward : forward;
    }
    qsort(order, p->n_cuts, sizeof *order, compare_cuts);
    for (size_t i = 0; i < p->n_cuts; i++) {
        il_output_string(to, order[i].cut->upper ? "cut upper" : "cut lower");
        il_native_put_index(to, order[i].cut->ring);
        il_output_char(to, '\n');
        for (size_t k = 0; k < order[i].cut->n; k++)
            put_point(to, cut_point(&order[i], k));
    }
    il_free(order);
    return IL_OK;
}

static il_status write_insertions(il_output *to, const il_pair *p, il_error *err)
{
    il_insertion *order = sorted(p->insertion, p->n_insertions, sizeof *order, compare_insertions);
    if (!order)
        return il_fail_nomem(err);
    for (size_t i = 0; i < p->n_insertions; i++) {
        il_output_string(to, order[i].upper ? "insert upper" : "insert lower");
        il_native_put_index(to, order[i].at.ring);
        put_place(to, &order[i].at);
        put_numbers(to, "", (const double[]){ order[i].x, order[i].y }, 2);
    }
    il_free(order);
    return IL_OK;
}

il_status il_native_write_pair(il_output *to, const il_pair *p, il_error *err)
{
    if (p->gap) {
        il_output_string(to, "gap\n");
        il_native_write_extra(to, p->extra);
        return IL_OK;
    }
    il_output_string(to, p->matcher == IL_MATCHER_FFD ? "pair\nmatcher ffd\n" : "pair\nmatcher none\n");
    il_status st = write_groups(to, p, err);
    if (st != IL_OK)
        return st;
    write_phi(to, p);
    st = write_matches(to, p, err);
    if (st == IL_OK)
        st = write_unmatched(to, p, err);
    if (st == IL_OK)
        st = write_insertions(to, p, err);
    if (st == IL_OK)
        st = write_cuts(to, p, err);
    il_native_write_extra(to, p->extra);
    return st;
}
