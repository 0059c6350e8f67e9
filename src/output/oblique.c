#include "config.h"
#include "output/oblique.h"

#include <math.h>

/* 20 degrees above the slices; the parts of a height and of a depth that are seen. */
static const double LEAN = 0.3420201433256687, RISE = 0.9396926207859084;

/* From straight in front, so that no axis hides another; 15 degrees. */
static const double TURN = 0.2617993877991494;

/* A stack is seen at most this much flatter or higher than wide, unless heights are scaled. */
static const double FLATTEST = 0.4, HIGHEST = 2.5;

/* Second moments that differ by less do not make a direction. */
static const double ROUND = 0.75;

static il_box box_of(const il_figure *f)
{
    il_box b = il_box_empty();
    for (size_t k = 0; k < f->n; k++)
        il_box_add_slice(&b, &f->level[k].slice);
    return b;
}

/* The direction of the greater principal axis of all vertices about O, in parts of SIZE. */
static void find_across(il_oblique *o, const il_figure *f, double size)
{
    double xx = 0, xy = 0, yy = 0;
    for (size_t k = 0; k < f->n; k++) {
        for (size_t i = 0; i < f->level[k].slice.n; i++) {
            const il_ring *r = &f->level[k].slice.ring[i];
            for (size_t v = 0; v < r->n; v++) {
                double x = (r->xy[2 * v] - o->o[0]) / size, y = (r->xy[2 * v + 1] - o->o[1]) / size;
                xx += x * x, xy += x * y, yy += y * y;
            }
        }
    }
    double half = hypot(xx - yy, 2 * xy) / 2, mean = (xx + yy) / 2, angle = atan2(2 * xy, xx - yy) / 2;
    bool stands_out = mean - half < ROUND * (mean + half);
    angle = (stands_out ? angle : 0) + TURN;
    double turn = cos(angle) < 0 ? -1 : 1; /* x runs to the right */
    o->across[0] = turn * cos(angle);
    o->across[1] = turn * sin(angle);
}

/* The least 1, 2 or 5 times a power of ten that is not below V. */
static double round_up(double v)
{
    double power = pow(10, floor(log10(v)));
    return v <= power ? power : v <= 2 * power ? 2 * power : v <= 5 * power ? 5 * power : 10 * power;
}

static double stretch_for(double height, double width)
{
    double shape = height / width;
    if (!(height > 0) || !isfinite(shape) || !(shape > 0))
        return 1;
    return shape < FLATTEST ? round_up(FLATTEST / shape) : shape > HIGHEST ? 1 / round_up(shape / HIGHEST) : 1;
}

static void find_window(il_oblique *o, const il_figure *f)
{
    double uv[2];
    o->window = il_box_empty();
    for (size_t k = 0; k < f->n; k++) {
        for (size_t i = 0; i < f->level[k].slice.n; i++) {
            const il_ring *r = &f->level[k].slice.ring[i];
            for (size_t v = 0; v < r->n; v++) {
                il_oblique_point(o, r->xy[2 * v], r->xy[2 * v + 1], f->level[k].slice.z, uv);
                il_box_add(&o->window, uv[0], uv[1]);
            }
        }
    }
}

il_oblique il_oblique_view(const il_figure *f)
{
    il_oblique o = { .across = { 1, 0 }, .rise = RISE, .lean = LEAN, .stretch = 1 };
    il_box box = box_of(f);
    if (il_box_is_empty(&box)) {
        o.window = box;
        return o;
    }
    for (int k = 0; k < 2; k++)
        o.o[k] = box.low[k] / 2 + box.high[k] / 2;
    o.o[2] = f->z_least / 2 + f->z_greatest / 2;
    find_across(&o, f, fmax(il_box_side(&box, 0), il_box_side(&box, 1)));
    find_window(&o, f);
    o.stretch = stretch_for(f->z_greatest - f->z_least, il_box_side(&o.window, 0));
    o.rise = RISE * o.stretch;
    find_window(&o, f);
    return o;
}

void il_oblique_point(const il_oblique *o, double x, double y, double z, double uv[2])
{
    double dx = x - o->o[0], dy = y - o->o[1];
    uv[0] = o->across[0] * dx + o->across[1] * dy;
    uv[1] = o->rise * (z - o->o[2]) + o->lean * (o->across[0] * dy - o->across[1] * dx);
}

void il_oblique_ring(const il_oblique *o, const il_ring *r, double z, double *uv)
{
    for (size_t k = 0; k < r->n; k++)
        il_oblique_point(o, r->xy[2 * k], r->xy[2 * k + 1], z, uv + 2 * k);
}
