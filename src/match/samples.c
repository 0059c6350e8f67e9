#include "config.h"
#include "match/samples.h"
#include "base/alloc.h"
#include "base/simd.h"

#include <math.h>
#include <string.h>

void il_samples_free(il_samples *s)
{
    il_free(s->x);
    il_free(s->y);
    il_free(s->nx);
    il_free(s->ny);
    il_free(s->before);
    il_free(s->after);
    *s = (il_samples)IL_SAMPLES_INIT;
}

/* Room for N and for the padding behind them. */
static bool reserve(il_samples *s, size_t n)
{
    n += IL_LANES;
    return il_grow(&s->x, &s->cap_x, n, sizeof *s->x) && il_grow(&s->y, &s->cap_y, n, sizeof *s->y) &&
           il_grow(&s->nx, &s->cap_nx, n, sizeof *s->nx) && il_grow(&s->ny, &s->cap_ny, n, sizeof *s->ny) &&
           il_grow(&s->before, &s->cap_before, n, sizeof *s->before) &&
           il_grow(&s->after, &s->cap_after, n, sizeof *s->after);
}

/* Samples [first, s->n) become one ring. */
static void close_ring(il_samples *s, size_t first)
{
    for (size_t k = first; k < s->n; k++) {
        s->before[k] = (uint32_t)(k == first ? s->n - 1 : k - 1);
        s->after[k] = (uint32_t)(k + 1 == s->n ? first : k + 1);
    }
}

static double edge_length(const il_outline *o, uint32_t v)
{
    const double *a = o->xy + 2 * v, *b = o->xy + 2 * o->next[v];
    double dx = b[0] - a[0], dy = b[1] - a[1];
    return sqrt(dx * dx + dy * dy); /* cells: nothing to overflow */
}

/* N points at equal arcs along the ring from vertex FIRST, LENGTH long. */
static void walk(il_samples *s, const il_outline *o, uint32_t first, double length, size_t n)
{
    double passed = 0, edge = edge_length(o, first);
    uint32_t v = first;
    for (size_t k = 0; k < n; k++) {
        double at = length * (double)k / (double)n;
        while (at >= passed + edge && o->next[v] != first) {
            passed += edge;
            v = o->next[v];
            edge = edge_length(o, v);
        }
        double t = edge > 0 ? fmin((at - passed) / edge, 1) : 0;
        const double *a = o->xy + 2 * v, *b = o->xy + 2 * o->next[v];
        s->x[s->n] = (float)(a[0] + t * (b[0] - a[0]));
        s->y[s->n] = (float)(a[1] + t * (b[1] - a[1]));
        s->n++;
    }
}

il_status il_samples_take(il_samples *s, const il_outline *o, double spacing, il_error *err)
{
    s->n = 0;
    for (size_t first = 0, end; first < o->n; first = end) {
        double length = 0;
        for (end = first; end < o->n; end++) {
            length += edge_length(o, (uint32_t)end);
            if (o->next[end] <= end)
                break;
        }
        end++;
        size_t n = (size_t)ceil(length / spacing), start = s->n;
        n = n < IL_SAMPLES_LEAST ? IL_SAMPLES_LEAST : n;
        if (!reserve(s, s->n + n))
            return il_fail_nomem(err);
        walk(s, o, (uint32_t)first, length, n);
        close_ring(s, start);
    }
    il_samples_set_normals(s);
    return IL_OK;
}

il_status il_samples_copy(il_samples *s, const il_samples *from, il_error *err)
{
    if (!reserve(s, from->n))
        return il_fail_nomem(err);
    s->n = from->n;
    memcpy(s->x, from->x, (from->n + IL_LANES) * sizeof *s->x);
    memcpy(s->y, from->y, (from->n + IL_LANES) * sizeof *s->y);
    memcpy(s->before, from->before, from->n * sizeof *s->before);
    memcpy(s->after, from->after, from->n * sizeof *s->after);
    return IL_OK;
}

il_status il_samples_thin(il_samples *s, uint32_t **from_at, size_t *cap_from_at, const il_samples *from,
                          uint32_t stride, il_error *err)
{
    s->n = 0;
    for (size_t first = 0, end; first < from->n; first = end) {
        end = (size_t)from->before[first] + 1;
        size_t n = end - first, start = s->n, fewer = (n + stride - 1) / stride;
        fewer = fewer < IL_SAMPLES_LEAST ? IL_SAMPLES_LEAST : fewer;
        if (!reserve(s, s->n + fewer) || !il_grow(from_at, cap_from_at, s->n + fewer, sizeof **from_at))
            return il_fail_nomem(err);
        for (size_t k = 0; k < fewer; k++)
            (*from_at)[s->n++] = (uint32_t)(first + k * n / fewer);
        close_ring(s, start);
    }
    il_samples_follow(s, *from_at, from);
    return IL_OK;
}

void il_samples_follow(il_samples *s, const uint32_t *from_at, const il_samples *from)
{
    for (size_t k = 0; k < s->n; k++) {
        s->x[k] = from->x[from_at[k]];
        s->y[k] = from->y[from_at[k]];
    }
    il_samples_set_normals(s);
}

void il_samples_set_normals(il_samples *s)
{
    for (size_t k = 0; k < s->n; k++) {
        float dx = s->x[s->after[k]] - s->x[s->before[k]], dy = s->y[s->after[k]] - s->y[s->before[k]];
        float length = sqrtf(dx * dx + dy * dy);
        s->nx[k] = length > 0 ? dy / length : 0;
        s->ny[k] = length > 0 ? -dx / length : 0;
    }
    for (size_t k = s->n; k < s->n + IL_LANES; k++) {
        s->x[k] = s->y[k] = 1e6f;
        s->nx[k] = s->ny[k] = 0;
    }
}
