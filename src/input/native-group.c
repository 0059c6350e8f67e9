/* native-group.c - groups of pair records: their rings and links, deformation and
 * lattices (formats/loft.txt, 8). */
#include "config.h"
#include "input/native.h"
#include "base/alloc.h"

#include <string.h>

/* Lines of a group that stand at most once. */
enum {
    SEEN_LOWER = 1, SEEN_UPPER = 2, SEEN_RESIDUAL = 4, SEEN_JACOBIAN = 8, SEEN_DISTORTION = 16,
    SEEN_STEPS = 32, SEEN_GLOBAL = 64, SEEN_BOX = 128,
    SEEN_FIT = SEEN_RESIDUAL | SEEN_JACOBIAN | SEEN_DISTORTION | SEEN_STEPS | SEEN_GLOBAL | SEEN_BOX
};

/* ---- groups -------------------------------------------------------------------- */

static il_group *open_group(il_native *n)
{
    return &n->pair.group[n->pair.n_groups - 1];
}

static il_status group_once(il_native *n, unsigned bit, const char *word)
{
    if (n->group_seen & bit)
        return il_native_fail(n, "'%s' stands twice in this group", word);
    n->group_seen |= bit;
    return IL_OK;
}

static il_status take_group(il_native *n)
{
    il_pair *p = &n->pair;
    il_status st = il_native_need_matcher(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->group, &p->cap_groups, p->n_groups + 1, sizeof *p->group))
        return il_native_nomem(n);
    memset(&p->group[p->n_groups++], 0, sizeof *p->group);
    n->in = IL_IN_GROUP;
    n->group_seen = 0;
    n->group_line = n->at.line;
    return IL_OK;
}

static il_status take_rings(il_native *n, il_native_shape *s, uint32_t **list, size_t *count, size_t *cap)
{
    do {
        uint32_t ring = 0;
        il_status st = il_scan_index(&n->at, &ring, n->err);
        if (st == IL_OK)
            st = il_native_ring_exists(n, s, ring);
        if (st != IL_OK)
            return st;
        if (s->group[ring] != 0)
            return il_native_fail(n, "ring %lu is in a group already", (unsigned long)ring);
        if (!il_grow(list, cap, *count + 1, sizeof **list))
            return il_native_nomem(n);
        s->group[ring] = (uint32_t)n->pair.n_groups;
        (*list)[(*count)++] = ring;
    } while (!il_scan_at_end(&n->at));
    return IL_OK;
}

static il_status take_lower(il_native *n)
{
    il_group *g = open_group(n);
    il_status st = group_once(n, SEEN_LOWER, "lower");
    return st != IL_OK ? st : take_rings(n, &n->lower, &g->lower, &g->n_lower, &g->cap_lower);
}

static il_status take_upper(il_native *n)
{
    il_group *g = open_group(n);
    il_status st = group_once(n, SEEN_UPPER, "upper");
    return st != IL_OK ? st : take_rings(n, &n->upper, &g->upper, &g->n_upper, &g->cap_upper);
}

static il_status take_link(il_native *n)
{
    static const char *const reasons[] = { "overlap", "slant", "near", "join", "opening", "given", NULL };
    il_group *g = open_group(n);
    il_link l = { 0 };
    int reason = 0;
    il_status st = il_scan_index(&n->at, &l.lower, n->err);
    if (st == IL_OK)
        st = il_scan_index(&n->at, &l.upper, n->err);
    if (st == IL_OK)
        st = il_scan_choice(&n->at, reasons, "a reason: overlap, slant, near, join, opening or given", &reason, n->err);
    if (st == IL_OK)
        st = il_native_take_distance(n, &l.reach);
    if (st != IL_OK)
        return st;
    if (!il_grow(&g->link, &g->cap_links, g->n_links + 1, sizeof *g->link))
        return il_native_nomem(n);
    l.reason = (il_link_reason)reason;
    g->link[g->n_links++] = l;
    return IL_OK;
}

static bool is_member(const il_native *n, const il_native_shape *s, uint32_t ring)
{
    return ring < s->n && s->group[ring] == n->pair.n_groups;
}

static il_status check_links(il_native *n, const il_group *g)
{
    for (size_t i = 0; i < g->n_links; i++)
        if (!is_member(n, &n->lower, g->link[i].lower) || !is_member(n, &n->upper, g->link[i].upper))
            return il_native_fail_at(n, n->group_line, "this group links ring %lu with ring %lu, which are not both in it",
                                     (unsigned long)g->link[i].lower, (unsigned long)g->link[i].upper);
    return IL_OK;
}

il_status il_native_close_group(il_native *n)
{
    il_group *g = open_group(n);
    unsigned fit = n->group_seen & SEEN_FIT;
    bool must_fit = n->pair.matcher == IL_MATCHER_FFD && g->n_lower > 0 && g->n_upper > 0;
    if (g->n_lower == 0 && g->n_upper == 0)
        return il_native_fail_at(n, n->group_line, "this group has no rings");
    if (fit != SEEN_FIT && (must_fit || fit != 0 || g->fit.n_lattices > 0))
        return il_native_fail_at(n, n->group_line, "this group needs residual, jacobian, distortion, steps, global and box");
    g->fitted = fit == SEEN_FIT;
    return check_links(n, g);
}

/* ---- the deformation of a group -------------------------------------------------- */

static il_status begin_fit_line(il_native *n, unsigned bit, const char *word)
{
    il_status st = il_native_need_ffd(n, word);
    return st != IL_OK ? st : group_once(n, bit, word);
}

static il_status take_residual(il_native *n)
{
    il_fit *f = &open_group(n)->fit;
    double v[4] = { 0 };
    il_status st = begin_fit_line(n, SEEN_RESIDUAL, "residual");
    for (int i = 0; st == IL_OK && i < 4; i++)
        st = il_native_take_distance(n, &v[i]);
    f->residual_up_mean = v[0], f->residual_up_max = v[1];
    f->residual_down_mean = v[2], f->residual_down_max = v[3];
    return st;
}

static il_status take_jacobian(il_native *n)
{
    il_status st = begin_fit_line(n, SEEN_JACOBIAN, "jacobian");
    return st != IL_OK ? st : il_scan_number(&n->at, &open_group(n)->fit.least_jacobian, n->err);
}

static il_status take_distortion(il_native *n)
{
    il_status st = begin_fit_line(n, SEEN_DISTORTION, "distortion");
    return st != IL_OK ? st : il_native_take_distance(n, &open_group(n)->fit.distortion);
}

static il_status take_steps(il_native *n)
{
    il_status st = begin_fit_line(n, SEEN_STEPS, "steps");
    return st != IL_OK ? st : il_scan_index(&n->at, &open_group(n)->fit.steps, n->err);
}

static il_status take_global(il_native *n)
{
    double *g = open_group(n)->fit.global;
    il_status st = begin_fit_line(n, SEEN_GLOBAL, "global");
    if (st == IL_OK)
        st = il_scan_numbers(&n->at, g, 6, n->err);
    if (st == IL_OK && !(g[0] * g[3] - g[1] * g[2] > 0))
        st = il_native_fail(n, "the determinant of the global step is not above 0");
    return st;
}

static il_status take_box(il_native *n)
{
    double *b = open_group(n)->fit.box;
    il_status st = begin_fit_line(n, SEEN_BOX, "box");
    if (st == IL_OK)
        st = il_scan_numbers(&n->at, b, 4, n->err);
    if (st == IL_OK && !(b[0] < b[2] && b[1] < b[3]))
        st = il_native_fail(n, "the box is empty: it is given as least x, least y, greatest x, greatest y");
    return st;
}

/* ---- lattices -------------------------------------------------------------------- */

static il_lattice *open_lattice(il_native *n)
{
    il_fit *f = &open_group(n)->fit;
    return &f->lattice[f->n_lattices - 1];
}

static il_status take_lattice(il_native *n)
{
    il_fit *f = &open_group(n)->fit;
    il_lattice l = { 0 };
    double v[3] = { 0 };
    il_status st = il_native_need_ffd(n, "lattice");
    if (st == IL_OK)
        st = il_scan_index(&n->at, &l.nx, n->err);
    if (st == IL_OK)
        st = il_scan_index(&n->at, &l.ny, n->err);
    if (st == IL_OK)
        st = il_scan_numbers(&n->at, v, 3, n->err);
    if (st == IL_OK && (l.nx == 0 || l.ny == 0))
        st = il_native_fail(n, "a lattice has at least one node each way");
    if (st == IL_OK && !(v[2] > 0))
        st = il_native_fail(n, "the spacing of a lattice is above 0");
    if (st == IL_OK && !il_grow(&f->lattice, &f->cap_lattices, f->n_lattices + 1, sizeof *f->lattice))
        st = il_native_nomem(n);
    if (st != IL_OK)
        return st;
    l.x = v[0], l.y = v[1], l.spacing = v[2];
    f->lattice[f->n_lattices++] = l;
    n->in = IL_IN_LATTICE;
    n->rows_line = n->at.line;
    return IL_OK;
}

il_status il_native_take_lattice_row(il_native *n)
{
    il_lattice *l = open_lattice(n);
    double d[2] = { 0 };
    il_status st = il_scan_numbers(&n->at, d, 2, n->err);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&l->d, &l->cap, l->n + 1, 2 * sizeof *l->d))
        return il_native_nomem(n);
    memcpy(&l->d[2 * l->n++], d, sizeof d);
    return IL_OK;
}

il_status il_native_close_lattice(il_native *n)
{
    const il_lattice *l = open_lattice(n);
    unsigned long long nodes = (unsigned long long)l->nx * l->ny;
    if (l->n != nodes)
        return il_native_fail_at(n, n->rows_line, "this lattice has %llu nodes, and %zu rows", nodes, l->n);
    return IL_OK;
}

const il_native_keyword il_native_group_keywords[] = {
    { "group", IL_IN_PAIR, take_group },
    { "lower", IL_IN_GROUP, take_lower },
    { "upper", IL_IN_GROUP, take_upper },
    { "link", IL_IN_GROUP, take_link },
    { "residual", IL_IN_GROUP, take_residual },
    { "jacobian", IL_IN_GROUP, take_jacobian },
    { "distortion", IL_IN_GROUP, take_distortion },
    { "steps", IL_IN_GROUP, take_steps },
    { "global", IL_IN_GROUP, take_global },
    { "box", IL_IN_GROUP, take_box },
    { "lattice", IL_IN_GROUP, take_lattice },
    { NULL, IL_IN_STREAM, NULL },
};
