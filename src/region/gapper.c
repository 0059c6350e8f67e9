#include "config.h"
#include "region/gapper.h"
#include "base/alloc.h"
#include "base/number.h"
#include "model/spacing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A thickened slice keeps clear of the middle of the gap, which the one on the
 * other side may come near as well. */
static const double GAP_SHARE = 0.45;

/* A slice at height z, and the record of it and the one below, if there is one. */
typedef struct level {
    double z;
    il_slice slice;
    il_pair below;
    bool has_pair;
} level;

/* level[n]: of the stack at hand, whose head is passed on when all is known.
 * passing: it is no solid, and goes through as it comes. */
typedef struct gapper {
    il_sink sink;
    il_gap_options options;
    il_sink *next;
    il_report *report;
    il_stack_head head;
    level *level;       size_t n, cap;
    bool passing;
} gapper;

/* ---- what is held -------------------------------------------------------- */

static void drop_pair(level *l)
{
    il_pair_free(&l->below);
    l->has_pair = false;
}

static void free_level(level *l)
{
    il_slice_free(&l->slice);
    drop_pair(l);
}

static void forget(gapper *g)
{
    for (size_t k = 0; k < g->n; k++)
        free_level(&g->level[k]);
    g->n = 0;
    il_stack_head_free(&g->head);
    g->passing = false;
}

static bool is_gap(const gapper *g, size_t k)
{
    return g->level[k].has_pair && g->level[k].below.gap;
}

/* How far level K lies above the one below it. */
static double distance(const gapper *g, size_t k)
{
    return g->level[k].z - g->level[k - 1].z;
}

/* Without the slices that hold nothing.  What was known of one of them is known of
 * nothing else, but for a gap, which is wider now. */
static void drop_empty(gapper *g)
{
    size_t n = 0;
    bool gap = false, dropped = false;
    for (size_t k = 0; k < g->n; k++) {
        level *l = &g->level[k];
        gap |= is_gap(g, k);
        if (l->slice.n == 0) {
            free_level(l);
            dropped = true;
            continue;
        }
        if (dropped || n == 0)
            drop_pair(l);
        if (dropped && gap && n > 0) {
            il_pair_make_gap(&l->below);
            l->has_pair = true;
        }
        g->level[n++] = *l;
        gap = dropped = false;
    }
    g->n = n;
}

/* ---- gaps ---------------------------------------------------------------- */

static il_status measure(const gapper *g, il_spacing *out, il_error *err)
{
    double *z = il_alloc(g->n, sizeof *z);
    if (!z)
        return il_fail_nomem(err);
    for (size_t k = 0; k < g->n; k++)
        z[k] = g->level[k].z;
    il_status st = il_spacing_measure(out, z, g->n, err);
    il_free(z);
    return st;
}

/* The stack is not fit to be lofted: see level K. */
static il_status set_fault(gapper *g, size_t k, const char *text, il_error *err)
{
    g->head.fault = il_strndup(text, strlen(text));
    g->head.fault_line = g->level[k].slice.line;
    return g->head.fault ? IL_OK : il_fail_nomem(err);
}

static il_status refuse_gap(gapper *g, size_t k, double usual, il_error *err)
{
    char below[IL_NUMBER_MAX], above[IL_NUMBER_MAX], apart[IL_NUMBER_MAX], text[200];
    il_number_format(below, g->level[k - 1].z);
    il_number_format(above, g->level[k].z);
    il_number_format_float(apart, (float)usual);
    snprintf(text, sizeof text, "a gap from z = %s to z = %s, where slices are usually %s apart (--gap fail)", below, above, apart);
    return set_fault(g, k, text, err);
}

static il_status mark_gaps(gapper *g, const il_spacing *spacing, il_error *err)
{
    for (size_t k = 1; k < g->n; k++) {
        level *l = &g->level[k];
        bool wide = il_spacing_is_gap(spacing, g->level[k - 1].z, l->z);
        if (g->options.mode == IL_GAPS_FAIL && (wide || is_gap(g, k)))
            return refuse_gap(g, k, spacing->usual, err);
        if (g->options.mode == IL_GAPS_BRIDGE && is_gap(g, k))
            drop_pair(l);
        if (g->options.mode == IL_GAPS_CAP && wide) {
            il_pair_make_gap(&l->below);
            l->has_pair = true;
        }
    }
    return IL_OK;
}

/* ---- slices that stand alone --------------------------------------------- */

static bool is_alone(const gapper *g, size_t k)
{
    return g->level[k].slice.n > 0 && (k == 0 || is_gap(g, k)) && (k + 1 == g->n || is_gap(g, k + 1));
}

/* One millimetre in the unit of the stack's heights. */
static double millimetre(il_unit u)
{
    return il_unit_metres(u) > 0 ? 0.001 / il_unit_metres(u) : 0.001;
}

/* For all of the stack's slices that need one; *GUESSED: it is of our own making. */
static double thickness(const gapper *g, const il_spacing *spacing, bool *guessed)
{
    const il_stack_head *h = &g->head;
    *guessed = false;
    if (g->options.thickness > 0)
        return g->options.thickness * (h->length_scale > 0 ? h->length_scale : 1);
    if (spacing->usual > 0)
        return spacing->usual;
    if (h->usual_spacing > 0)
        return h->usual_spacing;
    *guessed = true;
    return millimetre(h->unit);
}

/* Half the thickness of slice K, which keeps clear of its neighbours. */
static double half_thickness(const gapper *g, size_t k, double t)
{
    double half = t / 2;
    if (k > 0)
        half = fmin(half, GAP_SHARE * distance(g, k));
    if (k + 1 < g->n)
        half = fmin(half, GAP_SHARE * distance(g, k + 1));
    return half;
}

/* Of N slices alone N_THIN, the first of them slice FIRST, are thinner than T. */
static void tell_thickness(gapper *g, size_t n, size_t n_thin, size_t first, double t, bool guessed)
{
    char z[IL_NUMBER_MAX], is[IL_NUMBER_MAX], wanted[IL_NUMBER_MAX];
    il_report_repair(g->report, IL_REPAIR_THICKENED_SLICE, n);
    if (n > 0 && guessed)
        il_report_note(g->report, "a thickness of 1 mm is assumed for the single slice (--thickness says otherwise)");
    if (n_thin == 0)
        return;
    il_number_format(z, g->level[first].z);
    il_number_format_float(is, (float)(2 * half_thickness(g, first, t)));
    il_number_format_float(wanted, (float)t);
    il_report_note(g->report, "%zu of %zu single slices are less than %s thick, to keep clear of their neighbours; "
                   "the first, at z = %s, is %s", n_thin, n, wanted, z, is);
}

static il_status refuse_thickness(gapper *g, size_t k, double t, il_error *err)
{
    char z[IL_NUMBER_MAX], wanted[IL_NUMBER_MAX], text[160];
    il_number_format(z, g->level[k].z);
    il_number_format(wanted, t);
    snprintf(text, sizeof text, "the single slice at z = %s cannot be made %s thick", z, wanted);
    return set_fault(g, k, text, err);
}

/* Is there room for a body between the numbers at that height? */
static bool has_body(double z, double half)
{
    return z - half < z && z < z + half && fabs(z) + half < IL_COORDINATE_BOUND;
}

static il_status check_alone(gapper *g, double t, bool guessed, il_error *err)
{
    size_t n = 0, n_thin = 0, first = 0;
    for (size_t k = 0; k < g->n; k++) {
        if (!is_alone(g, k))
            continue;
        double half = half_thickness(g, k, t);
        if (!has_body(g->level[k].z, half))
            return refuse_thickness(g, k, t, err);
        n++;
        if (half < t / 2 && n_thin++ == 0)
            first = k;
    }
    tell_thickness(g, n, n_thin, first, t, guessed);
    return IL_OK;
}

static bool mark_inserted(il_slice *s)
{
    il_extra_free(&s->extra);
    for (size_t i = 0; i < s->n; i++) {
        il_ring *r = &s->ring[i];
        il_extra_free(&r->extra);
        if (!il_grow(&r->mark, &r->cap_mark, r->n, 1))
            return false;
        memset(r->mark, IL_VERTEX_INSERTED, r->n);
    }
    return true;
}

static il_status send_copy(gapper *g, const il_slice *s, double z, il_error *err)
{
    il_slice copy;
    il_status st = il_slice_copy(&copy, s, err);
    copy.z = z;
    if (st == IL_OK && !mark_inserted(&copy))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        st = g->next->slice(g->next, &copy, err);
    il_slice_free(&copy);
    return st;
}

/* ---- the stack, passed on ------------------------------------------------ */

static il_status send_pair(gapper *g, level *l, il_error *err)
{
    return l->has_pair ? g->next->pair(g->next, &l->below, err) : IL_OK;
}

/* The record stands behind the lowest of the three slices: that is the one it is about. */
static il_status send_thickened(gapper *g, size_t k, double t, il_error *err)
{
    level *l = &g->level[k];
    double half = half_thickness(g, k, t);
    il_slice copy;
    il_status st = il_slice_copy(&copy, &l->slice, err);
    if (st == IL_OK)
        st = send_copy(g, &copy, l->z - half, err);
    if (st == IL_OK)
        st = send_pair(g, l, err);
    if (st == IL_OK)
        st = g->next->slice(g->next, &l->slice, err);
    if (st == IL_OK)
        st = send_copy(g, &copy, l->z + half, err);
    il_slice_free(&copy);
    return st;
}

static il_status send_level(gapper *g, size_t k, double t, il_error *err)
{
    level *l = &g->level[k];
    if (is_alone(g, k))
        return send_thickened(g, k, t, err);
    il_status st = g->next->slice(g->next, &l->slice, err);
    return st == IL_OK ? send_pair(g, l, err) : st;
}

static il_status send(gapper *g, il_error *err)
{
    il_spacing spacing = IL_SPACING_INIT;
    bool guessed;
    if (g->options.drop_empty)
        drop_empty(g);
    il_status st = measure(g, &spacing, err);
    if (st == IL_OK && !g->head.fault)
        st = mark_gaps(g, &spacing, err);
    double t = thickness(g, &spacing, &guessed);
    if (st == IL_OK && !g->head.fault)
        st = check_alone(g, t, guessed, err);
    if (st == IL_OK)
        st = g->next->stack_begin(g->next, &g->head, err);
    for (size_t k = 0; st == IL_OK && !g->head.fault && k < g->n; k++)
        st = send_level(g, k, t, err);
    return st;
}

/* ---- the sink ------------------------------------------------------------ */

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    gapper *g = (gapper *)self;
    forget(g);
    g->passing = head->kind != IL_KIND_SOLID;
    return g->passing ? g->next->stack_begin(g->next, head, err) : il_stack_head_copy(&g->head, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    gapper *g = (gapper *)self;
    if (g->passing)
        return g->next->slice(g->next, slice, err);
    if (!il_grow(&g->level, &g->cap, g->n + 1, sizeof *g->level))
        return il_fail_nomem(err);
    g->level[g->n++] = (level){ .z = slice->z, .slice = *slice };
    *slice = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    gapper *g = (gapper *)self;
    if (g->passing)
        return g->next->pair(g->next, pair, err);
    if (g->n < 2 || g->level[g->n - 1].has_pair)
        return il_fail(err, IL_E_INPUT, pair->line, "a pair record must follow the upper one of its two slices, once");
    g->level[g->n - 1].below = *pair;
    g->level[g->n - 1].has_pair = true;
    *pair = (il_pair)IL_PAIR_INIT;
    return IL_OK;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    gapper *g = (gapper *)self;
    il_status st = g->passing ? IL_OK : send(g, err);
    forget(g);
    return st == IL_OK ? g->next->stack_end(g->next, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    gapper *g = (gapper *)self;
    return g->next->end(g->next, err);
}

bool il_gap_options_settle(il_gap_options *o, bool is_set)
{
    o->drop_empty = is_set;
    if (is_set && o->mode == IL_GAPS_AS_GIVEN)
        o->mode = IL_GAPS_CAP;
    return o->mode != IL_GAPS_AS_GIVEN || o->thickness > 0;
}

il_status il_gapper_new(il_sink **out, const il_gap_options *o, il_sink *next, il_report *report, il_error *err)
{
    *out = NULL;
    gapper *g = il_calloc(1, sizeof *g);
    if (!g)
        return il_fail_nomem(err);
    g->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    g->options = *o;
    g->next = next;
    g->report = report;
    *out = &g->sink;
    return IL_OK;
}

void il_gapper_free(il_sink *s)
{
    gapper *g = (gapper *)s;
    if (!g)
        return;
    forget(g);
    il_free(g->level);
    il_free(g);
}
