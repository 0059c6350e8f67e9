#include "config.h"
#include "stacks.h"

#include <math.h>
#include <stdlib.h>

static const double TURN = 6.283185307179586;

uint64_t stack_random(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

double stack_uniform(uint64_t *state)
{
    return (double)(stack_random(state) >> 11) * 0x1p-53;
}

static int below(uint64_t *s, int n)
{
    return (int)(stack_random(s) % (uint64_t)n);
}

static il_ring *new_ring(il_slice *slice)
{
    il_ring *r = il_slice_add_ring(slice);
    if (!r)
        abort();
    return r;
}

static void add(il_ring *r, double x, double y)
{
    if (!il_ring_add(r, x, y, 0))
        abort();
}

static double ulp_off(double v, uint64_t *s)
{
    int way = below(s, 3);
    return way == 0 ? v : nextafter(v, way == 1 ? INFINITY : -INFINITY);
}

/* Grid points (0..6)^2, each moved a little; equal for all cells of a slice. */
typedef struct grid { double x[7][7], y[7][7]; } grid;

static void make_grid(grid *g, stack_kind kind, uint64_t *s)
{
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++) {
            g->x[i][j] = i + 10.25, g->y[i][j] = j + 0.75;
            if (kind == STACK_CELLS_ULP)
                g->x[i][j] = ulp_off(g->x[i][j], s), g->y[i][j] = ulp_off(g->y[i][j], s);
            if (kind == STACK_CELLS_NANO)
                g->x[i][j] += 2e-9 * (stack_uniform(s) - .5), g->y[i][j] += 2e-9 * (stack_uniform(s) - .5);
        }
}

/* Random cells, each a ring of its own: borders between cells cancel. */
static void make_cells(il_slice *slice, stack_kind kind, uint64_t *s)
{
    grid g;
    make_grid(&g, kind, s);
    double share = .3 + .5 * stack_uniform(s);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            if (stack_uniform(s) > share && !(i == 2 && j == 2))
                continue;
            il_ring *r = new_ring(slice);
            add(r, g.x[i][j], g.y[i][j]);
            add(r, g.x[i + 1][j], g.y[i + 1][j]);
            add(r, g.x[i + 1][j + 1], g.y[i + 1][j + 1]);
            add(r, g.x[i][j + 1], g.y[i][j + 1]);
        }
}

static void make_star(il_slice *slice, double cx, double cy, double size, int n, uint64_t *s)
{
    il_ring *r = new_ring(slice);
    for (int i = 0; i < n; i++) {
        double radius = size * (.3 + .7 * stack_uniform(s)), angle = TURN * i / n;
        add(r, cx + radius * cos(angle), cy + radius * sin(angle));
    }
}

static void make_box(il_slice *slice, double x0, double y0, double x1, double y1, uint64_t *s)
{
    il_ring *r = new_ring(slice);
    double x[4] = { x0, x1, x1, x0 }, y[4] = { y0, y0, y1, y1 };
    for (int i = 0; i < 4; i++) { /* with a random number of points on each side */
        int n = 1 + below(s, 4);
        for (int k = 0; k < n; k++)
            add(r, x[i] + (x[(i + 1) % 4] - x[i]) * k / n, y[i] + (y[(i + 1) % 4] - y[i]) * k / n);
    }
}

static void make_frame(il_slice *slice, uint64_t *s)
{
    make_box(slice, 0, 0, 40, 30, s);
    for (int k = below(s, 4); k >= 0; k--)
        make_star(slice, 8 + 24 * stack_uniform(s), 8 + 14 * stack_uniform(s), 7, 3 + below(s, 9), s);
}

static void make_tangled(il_slice *slice, uint64_t *s)
{
    for (int k = below(s, 3); k >= 0; k--) {
        il_ring *r = new_ring(slice);
        for (int n = 3 + below(s, 8); n > 0; n--)
            add(r, below(s, 8), below(s, 8));
    }
    make_box(slice, 20, 0, 22, 2, s); /* so that no slice is empty */
}

static void make_copy(il_slice *slice, uint64_t shape, uint64_t *s)
{
    make_star(slice, 3.3, 7.7, 5, 5 + (int)(shape % 30), &shape);
    il_ring *r = &slice->ring[slice->n - 1];
    for (size_t i = 0; i < 2 * r->n; i++)
        r->xy[i] = ulp_off(r->xy[i], s);
}

static void make_slice(il_slice *slice, stack_kind kind, int k, uint64_t seed, uint64_t *s)
{
    uint64_t shape = seed; /* the same for all slices of the stack */
    switch (kind) {
    case STACK_EQUAL:      make_star(slice, 0, 0, 10, 3 + (int)(shape % 40), &shape); break;
    case STACK_CELLS:
    case STACK_CELLS_ULP:
    case STACK_CELLS_NANO: make_cells(slice, kind, s); break;
    case STACK_UNRELATED:
        for (int n = below(s, 3); n >= 0; n--)
            make_star(slice, 20 * stack_uniform(s), 20 * stack_uniform(s), 3 + 9 * stack_uniform(s), 3 + below(s, 30), s);
        break;
    case STACK_FRAME:      make_frame(slice, s); break;
    case STACK_SLIDING: {
        double dx = below(s, 5), dy = below(s, 2) ? 0 : below(s, 5);
        make_box(slice, dx, dy, dx + 6, dy + 4, s);
        break;
    }
    case STACK_HALVES:     make_box(slice, 5.0 * (k % 2), 0, 5.0 * (k % 2) + 5, 5, s); break;
    case STACK_ULP_COPIES: make_copy(slice, shape, s); break;
    case STACK_TANGLED:    make_tangled(slice, s); break;
    case STACK_N_KINDS:    break;
    }
}

size_t stack_make(stack_kind kind, uint64_t seed, il_slice slice[6])
{
    uint64_t s = seed * 1000003 + (uint64_t)kind;
    size_t n = 2 + (size_t)below(&s, 5);
    double z = 0;
    for (size_t k = 0; k < n; k++) {
        slice[k] = (il_slice)IL_SLICE_INIT;
        slice[k].z = z;
        z += .25 + 2 * stack_uniform(&s);
        make_slice(&slice[k], kind, (int)k, seed, &s);
    }
    return n;
}
