/* cleaner.c - the stage of clean.h: slices pass through il_slice_clean. */
#include "config.h"
#include "region/clean.h"
#include "base/alloc.h"
#include "base/number.h"
#include "region/keyhole.h"

#include <math.h>

typedef struct cleaner {
    il_sink sink;
    il_clean_options options;
    double keyhole;     /* tolerance in the unit of the stack at hand */
    il_sink *next;
    il_report *report;
    il_slice held;      /* the last slice, not passed on yet: one of the same height may follow */
    bool holding;
    bool is_terrain;    /* its lines bound nothing yet: equal heights are merged, and that is all */
    bool merged;        /* the held one, of several: whose rings a pair would name is not known */
    bool passed;        /* was any slice passed on in this stack? */
    double z;           /* of the one passed on last */
    bool changed;       /* was that one changed? */
    bool before_changed;/* and the one before it? */
} cleaner;

/* The tolerance in unit U; a length in mm says nothing of degrees. */
static double keyhole_tolerance(const il_clean_options *o, il_unit u)
{
    if (!o->keyhole_is_mm || u == IL_UNIT_MM)
        return o->keyhole;
    return il_unit_metres(u) > 0 ? o->keyhole * il_unit_metres(IL_UNIT_MM) / il_unit_metres(u) : 0;
}

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    cleaner *c = (cleaner *)self;
    il_slice_free(&c->held);
    c->holding = c->merged = c->passed = c->changed = c->before_changed = false;
    c->keyhole = keyhole_tolerance(&c->options, head->unit);
    c->is_terrain = head->kind == IL_KIND_TERRAIN;
    return c->next->stack_begin(c->next, head, err);
}

static il_status clean_held(cleaner *c, il_error *err)
{
    size_t n_before = c->held.n;
    bool changed = false;
    il_status st = il_slice_open_keyholes(&c->held, c->keyhole, c->report, err);
    c->changed |= c->held.n != n_before;
    if (st == IL_OK)
        st = il_slice_clean(&c->held, &c->options, c->report, &changed, err);
    c->changed |= changed;
    return st;
}

static il_status pass_on(cleaner *c, il_error *err)
{
    if (!c->holding)
        return IL_OK;
    c->holding = false;
    c->before_changed = c->changed;
    c->passed = true;
    c->z = c->held.z;
    c->changed = c->merged;
    il_status st = c->is_terrain ? IL_OK : clean_held(c, err);
    c->merged = false;
    if (st == IL_OK)
        st = c->next->slice(c->next, &c->held, err);
    il_slice_free(&c->held);
    return st;
}

/* Move the rings of FROM behind those of TO. */
static il_status merge(il_slice *to, il_slice *from, il_error *err)
{
    for (size_t i = 0; i < from->n; i++) {
        il_ring *r = il_slice_add_ring(to);
        if (!r)
            return il_fail_nomem(err);
        *r = from->ring[i];
        from->ring[i] = (il_ring)IL_RING_INIT;
    }
    il_extra_move(&to->extra, &from->extra);
    return IL_OK;
}

static il_status fail_order(const il_slice *s, double below, il_error *err)
{
    char z[IL_NUMBER_MAX], before[IL_NUMBER_MAX];
    il_number_format(z, s->z);
    il_number_format(before, below);
    return il_fail(err, IL_E_INPUT, s->line, "slices must come in rising z: %s after %s", z, before);
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    cleaner *c = (cleaner *)self;
    if (c->options.round_float && !c->is_terrain)
        s->z = il_number_round_float(s->z);
    if (c->holding && s->z == c->held.z) {
        il_report_repair(c->report, IL_REPAIR_MERGED_SLICE, 1);
        c->merged = true;
        return merge(&c->held, s, err);
    }
    if (c->holding && s->z < c->held.z)
        return fail_order(s, c->held.z, err);
    if (!c->holding && c->passed && s->z <= c->z) /* a pair came between: it is too late to merge */
        return fail_order(s, c->z, err);
    il_status st = pass_on(c, err);
    if (st == IL_OK) {
        c->held = *s;
        *s = (il_slice)IL_SLICE_INIT;
        c->holding = true;
    }
    return st;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    cleaner *c = (cleaner *)self;
    il_status st = pass_on(c, err);
    if (st == IL_OK && (c->changed || c->before_changed) && il_pair_names_rings(p))
        st = il_fail(err, IL_E_INPUT, p->line,
                     "this pair speaks of slices that are not clean: run isoloft read on the contours, then match");
    return st == IL_OK ? c->next->pair(c->next, p, err) : st;
}

static il_status stack_end(il_sink *self, il_error *err)
{
    cleaner *c = (cleaner *)self;
    il_status st = pass_on(c, err);
    return st == IL_OK ? c->next->stack_end(c->next, err) : st;
}

static il_status end(il_sink *self, il_error *err)
{
    cleaner *c = (cleaner *)self;
    return c->next->end(c->next, err);
}

il_status il_cleaner_new(il_sink **out, const il_clean_options *o, il_sink *next,
                         il_report *report, il_error *err)
{
    cleaner *c = il_calloc(1, sizeof *c);
    *out = NULL;
    if (!c)
        return il_fail_nomem(err);
    c->sink = (il_sink){ stack_begin, slice, pair, stack_end, end };
    c->options = *o;
    c->next = next;
    c->report = report;
    *out = &c->sink;
    return IL_OK;
}

void il_cleaner_free(il_sink *s)
{
    cleaner *c = (cleaner *)s;
    if (c)
        il_slice_free(&c->held);
    il_free(c);
}
