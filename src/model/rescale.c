#include "config.h"
#include "model/rescale.h"
#include "base/alloc.h"
#include "model/spots.h"

#include <math.h>

/* Micrometres in one of each unit: whole numbers, so that every conversion is
 * a ratio of whole numbers and 1000 mm are 1 m to the last bit. */
static const long micrometres[IL_N_UNITS] = {
    [IL_UNIT_UM] = 1, [IL_UNIT_MM] = 1000, [IL_UNIT_CM] = 10000, [IL_UNIT_M] = 1000000,
    [IL_UNIT_KM] = 1000000000, [IL_UNIT_IN] = 25400, [IL_UNIT_FT] = 304800, [IL_UNIT_DEG] = 0
};

/* numerator / denominator: units TO in one of the stack's, in lowest terms.
 * n_rounded, n_values: of this stack, coordinates that were rounded, and all. */
typedef struct rescaler {
    il_sink sink;
    il_sink *next;
    il_report *report;
    il_unit from, to;
    double numerator, denominator;
    size_t n_rounded, n_values;
} rescaler;

static long common_divisor(long a, long b)
{
    while (b != 0) {
        long rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

double il_rescale_value(double value, double numerator, double denominator, bool *exact)
{
    double product = value * numerator, result = product / denominator;
    /* The remainders of both operations are doubles, which fma gives exactly. */
    *exact = fma(value, numerator, -product) == 0 && fma(result, denominator, -product) == 0;
    return result;
}

/* Units TO in one FROM, in lowest terms. */
static void find_ratio(il_unit from, il_unit to, double *numerator, double *denominator)
{
    long divisor = common_divisor(micrometres[from], micrometres[to]);
    *numerator = (double)(micrometres[from] / divisor);
    *denominator = (double)(micrometres[to] / divisor);
}

double il_rescale_length(double length, il_unit from, il_unit to)
{
    double numerator, denominator;
    bool exact;
    find_ratio(from, to, &numerator, &denominator);
    return il_rescale_value(length, numerator, denominator, &exact);
}

static bool is_identity(const rescaler *r)
{
    return r->numerator == r->denominator;
}

/* A coordinate: counted, and checked against the model's bound. */
static il_status convert(rescaler *r, double *value, long line, il_error *err)
{
    bool exact;
    double result = il_rescale_value(*value, r->numerator, r->denominator, &exact);
    if (!(fabs(result) < IL_COORDINATE_BOUND))
        return il_fail(err, IL_E_INPUT, line, "a coordinate reaches 1e15 when converted to %s", il_unit_name(r->to));
    r->n_values++;
    if (!exact) {
        r->n_rounded++;
        double move = fabs(result) * 0x1p-52; /* two roundings of half a unit in the last place */
        if (r->report && move > r->report->largest_move)
            r->report->largest_move = move;
    }
    *value = result;
    return IL_OK;
}

static void convert_length(const rescaler *r, double *length)
{
    *length = *length * r->numerator / r->denominator;
}

/* Two that were apart may come to one place. */
static il_status convert_spots(rescaler *r, il_stack_head *h, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < h->n_spots; i++) {
        double *const xyz[] = { &h->spot[i].x, &h->spot[i].y, &h->spot[i].z };
        for (int k = 0; k < 3 && st == IL_OK; k++)
            st = convert(r, xyz[k], h->spot[i].line, err);
    }
    il_stack_head_settle_spots(h, r->report);
    return st;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    rescaler *r = (rescaler *)self;
    r->from = head->unit;
    r->n_rounded = r->n_values = 0;
    if (micrometres[head->unit] == 0)
        return il_fail(err, IL_E_INPUT, head->line, "the stack is in %s, which cannot be converted to %s",
                       il_unit_name(head->unit), il_unit_name(r->to));
    find_ratio(r->from, r->to, &r->numerator, &r->denominator);
    if (is_identity(r))
        return r->next->stack_begin(r->next, head, err);
    il_stack_head copy = IL_STACK_HEAD_INIT;
    il_status st = il_stack_head_copy(&copy, head, err);
    if (st != IL_OK)
        return st;
    copy.unit = r->to;
    copy.length_scale = r->numerator / r->denominator;
    convert_length(r, &copy.usual_spacing);
    if (copy.crs) {
        il_report_note(r->report, "the CRS is dropped: its coordinates are not in %s", il_unit_name(r->to));
        il_free(copy.crs);
        copy.crs = NULL;
    }
    for (int k = 0; k < 3 && copy.has_frame && st == IL_OK; k++)
        st = convert(r, &copy.frame[k], head->line, err);
    if (st == IL_OK)
        st = convert_spots(r, &copy, err);
    if (st == IL_OK)
        st = r->next->stack_begin(r->next, &copy, err);
    il_stack_head_free(&copy);
    return st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    rescaler *r = (rescaler *)self;
    il_status st = IL_OK;
    if (!is_identity(r)) {
        st = convert(r, &slice->z, slice->line, err);
        for (size_t i = 0; i < slice->n; i++)
            for (size_t k = 0; k < 2 * slice->ring[i].n && st == IL_OK; k++)
                st = convert(r, &slice->ring[i].xy[k], slice->ring[i].line, err);
    }
    return st == IL_OK ? r->next->slice(r->next, slice, err) : st;
}

/* phi and its parts: what is a length in a fit; ratios and angles stay. */
static void convert_fit(const rescaler *r, il_fit *f)
{
    double *const lengths[] = { &f->residual_up_mean, &f->residual_up_max, &f->residual_down_mean, &f->residual_down_max,
                                &f->global[4], &f->global[5], &f->box[0], &f->box[1], &f->box[2], &f->box[3] };
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        convert_length(r, lengths[k]);
    for (size_t i = 0; i < f->n_lattices; i++) {
        il_lattice *l = &f->lattice[i];
        convert_length(r, &l->x);
        convert_length(r, &l->y);
        convert_length(r, &l->spacing);
        for (size_t k = 0; k < 2 * l->n; k++)
            convert_length(r, &l->d[k]);
    }
}

static void convert_pair(const rescaler *r, il_pair *p)
{
    for (size_t i = 0; i < p->n_groups; i++) {
        for (size_t k = 0; k < p->group[i].n_links; k++)
            convert_length(r, &p->group[i].link[k].reach);
        if (p->group[i].fitted)
            convert_fit(r, &p->group[i].fit);
    }
    for (size_t k = 0; k < p->n_phi; k++) {
        convert_length(r, &p->phi[k].x);
        convert_length(r, &p->phi[k].y);
    }
    for (size_t k = 0; k < p->n_matches; k++) {
        convert_length(r, &p->match[k].residual_mean);
        convert_length(r, &p->match[k].residual_max);
    }
    for (size_t k = 0; k < p->n_insertions; k++) {
        convert_length(r, &p->insertion[k].x);
        convert_length(r, &p->insertion[k].y);
    }
    for (size_t i = 0; i < p->n_cuts; i++)
        for (size_t k = 0; k < 2 * p->cut[i].n; k++)
            convert_length(r, &p->cut[i].xy[k]);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    rescaler *r = (rescaler *)self;
    if (!is_identity(r))
        convert_pair(r, pair);
    return r->next->pair(r->next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    rescaler *r = (rescaler *)self;
    if (!is_identity(r))
        il_report_note(r->report, "converted from %s to %s: %zu of %zu coordinates rounded in the last place",
                       il_unit_name(r->from), il_unit_name(r->to), r->n_rounded, r->n_values);
    return r->next->stack_end(r->next, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    rescaler *r = (rescaler *)self;
    return r->next->end(r->next, err);
}

il_status il_rescaler_new(il_sink **out, il_unit to, il_sink *next, il_report *report, il_error *err)
{
    *out = NULL;
    rescaler *r = il_calloc(1, sizeof *r);
    if (!r)
        return il_fail_nomem(err);
    *r = (rescaler){ .sink = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end },
                     .next = next, .report = report, .from = to, .to = to, .numerator = 1, .denominator = 1 };
    *out = &r->sink;
    return IL_OK;
}

void il_rescaler_free(il_sink *s)
{
    il_free(s);
}
