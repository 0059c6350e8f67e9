#include "config.h"
#include "input/rt-roi.h"
#include "base/alloc.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- contours ------------------------------------------------------------- */

void il_rt_contour_free(il_rt_contour *c)
{
    il_free(c->p);
    *c = (il_rt_contour){ 0 };
}

/* The axis along which all of the points are equal, z first; 3: none. */
static il_rt_layout layout_of(const double *xyz, size_t n)
{
    for (int k = 2; k >= 0; k--) {
        size_t i = 1;
        while (i < n && xyz[3 * i + (size_t)k] == xyz[k])
            i++;
        if (i >= n)
            return (il_rt_layout)k;
    }
    return IL_RT_OBLIQUE;
}

/* Pairs are made of the triples where they are: no pair lies behind its triple. */
static void drop_axis(il_rt_contour *c, size_t k)
{
    double *p = c->p;
    c->level = p[k];
    for (size_t i = 0; i < c->n; i++) {
        double a = p[3 * i + (k + 1) % 3], b = p[3 * i + (k + 2) % 3];
        p[2 * i] = a;
        p[2 * i + 1] = b;
    }
    double *shrunk = il_realloc(p, c->n, 2 * sizeof *p);
    c->p = shrunk ? shrunk : p;
}

void il_rt_contour_take_points(il_rt_contour *c, double **xyz, size_t n)
{
    c->p = *xyz;
    c->n = n;
    c->layout = layout_of(*xyz, n);
    *xyz = NULL;
    if (c->layout != IL_RT_OBLIQUE)
        drop_axis(c, (size_t)c->layout);
}

void il_rt_contour_point(const il_rt_contour *c, size_t i, double xyz[3])
{
    if (c->layout == IL_RT_OBLIQUE) {
        memcpy(xyz, c->p + 3 * i, 3 * sizeof *xyz);
        return;
    }
    size_t k = (size_t)c->layout;
    xyz[k] = c->level;
    xyz[(k + 1) % 3] = c->p[2 * i];
    xyz[(k + 2) % 3] = c->p[2 * i + 1];
}

/* ---- regions of interest ------------------------------------------------------ */

void il_rt_roi_free(il_rt_roi *r)
{
    for (size_t i = 0; i < r->n; i++)
        il_rt_contour_free(&r->contour[i]);
    il_free(r->contour);
    il_free(r->name);
    il_free(r->algorithm);
    il_free(r->type);
    il_free(r->frame_uid);
    il_free(r->fault);
    il_report_free(&r->report);
    *r = (il_rt_roi){ .report = IL_REPORT_INIT };
}

bool il_rt_roi_add(il_rt_roi *r, il_rt_contour *c)
{
    if (!il_grow(&r->contour, &r->cap, r->n + 1, sizeof *r->contour))
        return false;
    r->n_points += c->n;
    r->contour[r->n++] = *c;
    *c = (il_rt_contour){ 0 };
    return true;
}

il_status il_rt_roi_fail(il_rt_roi *r, long line, il_error *err, const char *format, ...)
{
    char text[300];
    va_list args;
    if (r->fault)
        return IL_OK;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    r->fault = il_strndup(text, strlen(text));
    r->fault_line = line;
    return r->fault ? IL_OK : il_fail_nomem(err);
}

static void take_text(char **to, char **from)
{
    if (*to)
        return;
    *to = *from;
    *from = NULL;
}

il_status il_rt_roi_merge(il_rt_roi *to, il_rt_roi *from, il_error *err)
{
    if (!il_grow(&to->contour, &to->cap, to->n + from->n, sizeof *to->contour))
        return il_fail_nomem(err);
    if (from->n > 0)
        memcpy(to->contour + to->n, from->contour, from->n * sizeof *from->contour);
    to->n += from->n;
    to->n_points += from->n_points;
    from->n = 0;
    take_text(&to->name, &from->name);
    take_text(&to->algorithm, &from->algorithm);
    take_text(&to->type, &from->type);
    take_text(&to->frame_uid, &from->frame_uid);
    if (!to->fault)
        to->fault_line = from->fault_line;
    take_text(&to->fault, &from->fault);
    if (!to->has_color) {
        to->has_color = from->has_color;
        memcpy(to->color, from->color, sizeof to->color);
    }
    to->rank = from->rank < to->rank ? from->rank : to->rank;
    il_report_merge(&to->report, &from->report);
    il_rt_roi_free(from);
    return IL_OK;
}
