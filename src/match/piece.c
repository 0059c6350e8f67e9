#include "config.h"
#include "match/piece.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

void il_piece_free(il_piece *p)
{
    il_free(p->xy);
    il_free(p->next);
    *p = (il_piece){ 0 };
}

il_outline il_piece_outline(const il_piece *p)
{
    return (il_outline){ p->xy, p->next, p->n };
}

bool il_piece_add_ring(il_piece *p, const il_ring *r)
{
    if (!il_grow(&p->xy, &p->cap, 2 * (p->n + r->n), sizeof *p->xy) || !il_grow(&p->next, &p->cap_next, p->n + r->n, sizeof *p->next))
        return false;
    memcpy(p->xy + 2 * p->n, r->xy, 2 * r->n * sizeof *p->xy);
    for (size_t k = 0; k < r->n; k++)
        p->next[p->n + k] = (uint32_t)(p->n + (k + 1 < r->n ? k + 1 : 0));
    p->n += r->n;
    return true;
}

bool il_piece_move(il_piece *to, const il_piece *p, double dx, double dy)
{
    *to = (il_piece){ 0 };
    if (!il_grow(&to->xy, &to->cap, 2 * p->n, sizeof *to->xy) || !il_grow(&to->next, &to->cap_next, p->n, sizeof *to->next))
        return false;
    for (size_t i = 0; i < p->n; i++) {
        to->xy[2 * i] = p->xy[2 * i] + dx;
        to->xy[2 * i + 1] = p->xy[2 * i + 1] + dy;
        to->next[i] = p->next[i];
    }
    to->n = p->n;
    return true;
}

double il_piece_centre(const il_piece *p, double out[2])
{
    double area = 0, x = 0, y = 0, x0 = p->xy[0], y0 = p->xy[1];
    for (size_t i = 0; i < p->n; i++) {
        const double *a = p->xy + 2 * i, *b = p->xy + 2 * p->next[i];
        double cross = (a[0] - x0) * (b[1] - y0) - (b[0] - x0) * (a[1] - y0);
        area += cross;
        x += cross * (a[0] + b[0] - 2 * x0);
        y += cross * (a[1] + b[1] - 2 * y0);
    }
    out[0] = x0 + (area != 0 ? x / (3 * area) : 0);
    out[1] = y0 + (area != 0 ? y / (3 * area) : 0);
    return fabs(area) / 2;
}

double il_piece_length(const il_piece *p)
{
    double sum = 0;
    for (size_t i = 0; i < p->n; i++)
        sum += hypot(p->xy[2 * p->next[i]] - p->xy[2 * i], p->xy[2 * p->next[i] + 1] - p->xy[2 * i + 1]);
    return sum;
}
