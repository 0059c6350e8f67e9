/* dxf-insert.c - blocks, drawn where INSERT places them. */
#include "config.h"
#include "input/dxf-drawing.h"

/* A drawing of a few bytes could ask for more than any machine has. */
enum { DEEPEST = 64, INSERTED_MOST = 10 * 1000 * 1000 };

/* What is the same for all of an array: points of a block are put on its base and
 * scaled by INNER, moved to their column and row, and put in place by OUTER. */
typedef struct array {
    il_affine inner, outer;
    double dx, dy, z_scale, z_shift;
    unsigned long columns, rows;
} array;

static il_status find_array(const il_dxf *d, const il_dxf_entity *e, const il_dxf_block *b, const il_dxf_place *place,
                            array *a, il_error *err)
{
    double s, c, z_scale = il_dxf_value(d, e, 43, 1);
    il_sincos_deg(il_dxf_value(d, e, 50, 0), &s, &c);
    const il_affine base = { 1, 0, 0, 1, -b->x, -b->y };
    const il_affine scale = { il_dxf_value(d, e, 41, 1), 0, 0, il_dxf_value(d, e, 42, 1), 0, 0 };
    const il_affine turn = { c, s, -s, c, il_dxf_value(d, e, 10, 0), il_dxf_value(d, e, 20, 0) };
    a->inner = il_affine_multiply(&scale, &base);
    a->outer = il_affine_multiply(&place->xy, &turn);
    a->dx = il_dxf_value(d, e, 44, 0);
    a->dy = il_dxf_value(d, e, 45, 0);
    a->z_scale = place->z_scale * z_scale;
    a->z_shift = place->z_scale * (il_dxf_value(d, e, 30, 0) - z_scale * b->z) + place->z_shift;
    il_status st = il_dxf_whole(d, e, 70, &a->columns, err);
    return st == IL_OK ? il_dxf_whole(d, e, 71, &a->rows, err) : st;
}

static il_dxf_place place_at(const array *a, unsigned long column, unsigned long row)
{
    il_affine inner = a->inner;
    inner.e += (double)column * a->dx;
    inner.f += (double)row * a->dy;
    return (il_dxf_place){ il_affine_multiply(&a->outer, &inner), a->z_scale, a->z_shift };
}

static il_status draw_block(il_dxf *d, const il_dxf_entity *e, const il_dxf_block *b, const il_dxf_place *place, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < b->n && st == IL_OK; k++) {
        il_dxf_entity inner = d->entity[b->begin + k];
        if (inner.layer == IL_DXF_LAYER_0)
            inner.layer = e->layer;
        if (d->n_inserted >= INSERTED_MOST || d->n_inserted >= d->options->max_points)
            return il_fail(err, IL_E_INPUT, e->line, "inserted blocks draw more than %zu entities", d->n_inserted);
        d->n_inserted++;
        st = il_dxf_draw(d, &inner, place, err);
    }
    return st;
}

/* No rows or columns are one. */
static il_status draw_array(il_dxf *d, const il_dxf_entity *e, const il_dxf_block *b, const il_dxf_place *place, il_error *err)
{
    array a;
    il_status st = find_array(d, e, b, place, &a, err);
    if (st != IL_OK || b->n == 0)
        return st;
    unsigned long columns = a.columns > 0 ? a.columns : 1, rows = a.rows > 0 ? a.rows : 1;
    for (unsigned long k = 0; k / columns < rows && st == IL_OK; k++) {
        il_dxf_place inner = place_at(&a, k % columns, k / columns);
        st = draw_block(d, e, b, &inner, err);
    }
    return st;
}

static const char *why_not(const il_dxf *d, const il_dxf_entity *e)
{
    if (e->block == UINT32_MAX || d->block[e->block].n_definitions == 0)
        return "its block is not in the file";
    if (d->block[e->block].n_definitions > 1)
        return "its block is defined more than once";
    if (il_dxf_value(d, e, 41, 1) == 0 || il_dxf_value(d, e, 42, 1) == 0 || il_dxf_value(d, e, 43, 1) == 0)
        return "is scaled by 0";
    return NULL;
}

il_status il_dxf_draw_insert(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_dxf_place own;
    const char *why = why_not(d, e);
    if (why) {
        il_dxf_skip(d, e, why);
        return IL_OK;
    }
    if (!il_dxf_own_place(d, e, place, &own))
        return IL_OK;
    il_dxf_block *b = &d->block[e->block];
    if (b->is_open)
        return il_fail(err, IL_E_INPUT, e->line, "the block '%.60s' holds itself", il_dictionary_text(&d->block_names, e->block));
    if (d->depth >= DEEPEST)
        return il_fail(err, IL_E_INPUT, e->line, "blocks are inserted in blocks more than %d deep", DEEPEST);
    b->is_open = true;
    d->depth++;
    il_status st = draw_array(d, e, b, &own, err);
    d->depth--;
    b->is_open = false;
    return st;
}
