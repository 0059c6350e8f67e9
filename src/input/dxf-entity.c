/* dxf-entity.c - the pairs of an entity as groups. */
#include "config.h"
#include "base/alloc.h"
#include "input/dxf-drawing.h"

#include <string.h>

static il_dxf_kind kind_of(const il_dxf_scan *s)
{
    static const struct { const char *name; il_dxf_kind kind; } kinds[] = {
        { "LWPOLYLINE", IL_DXF_LWPOLYLINE }, { "POLYLINE", IL_DXF_POLYLINE }, { "LINE", IL_DXF_LINE },
        { "SPLINE", IL_DXF_SPLINE }, { "ARC", IL_DXF_ARC }, { "INSERT", IL_DXF_INSERT }, { "POINT", IL_DXF_POINT },
        { "CIRCLE", IL_DXF_CIRCLE }, { "ELLIPSE", IL_DXF_ELLIPSE } };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (il_dxf_is(s, 0, kinds[k].name))
            return kinds[k].kind;
    return IL_DXF_OTHER;
}

/* Coordinates and what goes with them, flags and counts, the extrusion direction. */
static bool is_wanted(il_dxf_kind kind, int code)
{
    return kind != IL_DXF_OTHER && ((code >= 10 && code < 60) || (code >= 70 && code < 80) || (code >= 210 && code < 240));
}

static il_status keep_group(il_dxf *d, const il_dxf_entity *e, int code, double value, il_error *err)
{
    if (d->n_groups == d->cap_groups && !il_grow(&d->group, &d->cap_groups, d->n_groups + 1, sizeof *d->group))
        return il_fail_nomem(err);
    d->group[d->n_groups++] = (il_dxf_group){ value, code, (uint32_t)(d->scan.line + 1 - e->line) };
    return IL_OK;
}

static il_status keep_number(il_dxf *d, const il_dxf_entity *e, il_error *err)
{
    double value = 0;
    il_status st = il_dxf_number(&d->scan, &value, err);
    return st == IL_OK ? keep_group(d, e, d->scan.code, value, err) : st;
}

il_status il_dxf_find_block(il_dxf *d, const char *s, size_t n, uint32_t *index, il_error *err)
{
    if (!il_dictionary_put(&d->block_names, s, n, index))
        return *index == IL_DICTIONARY_MOST ? il_fail(err, IL_E_INPUT, d->scan.line, "more than %d blocks", IL_DICTIONARY_MOST)
                                       : il_fail_nomem(err);
    if (!il_grow(&d->block, &d->cap_blocks, (size_t)*index + 1, sizeof *d->block))
        return il_fail_nomem(err);
    while (d->n_blocks <= *index)
        d->block[d->n_blocks++] = (il_dxf_block){ 0 };
    return IL_OK;
}

/* The pair at hand, if it says something of the whole entity. */
static il_status take_common(il_dxf *d, il_dxf_entity *e, il_error *err)
{
    enum { NAME = 2, LAYER = 8, HIDDEN = 60, PAPER = 67 };
    const il_dxf_scan *s = &d->scan;
    double value = 0;
    il_status st = IL_OK;
    if (s->code == LAYER)
        return il_dxf_layer_find(&d->layers, s->value, s->n, s->line + 1, &e->layer, err);
    if (s->code == NAME && e->kind == IL_DXF_INSERT)
        return il_dxf_find_block(d, s->value, s->n, &e->block, err);
    if (s->code != HIDDEN && s->code != PAPER)
        return IL_OK;
    st = il_dxf_number(s, &value, err);
    if (s->code == HIDDEN)
        e->is_hidden = value != 0;
    else
        e->is_paper = value != 0;
    return st;
}

/* Up to the pair that begins something else.  A vertex lies where its polyline does. */
static il_status read_groups(il_dxf *d, il_dxf_entity *e, bool is_vertex, il_error *err)
{
    il_status st;
    while ((st = il_dxf_next(&d->scan, err)) == IL_OK && d->scan.code != 0) {
        if (is_wanted(e->kind, d->scan.code))
            st = keep_number(d, e, err);
        else if (!is_vertex)
            st = take_common(d, e, err);
        if (st != IL_OK)
            return st;
    }
    return st;
}

/* What follows a POLYLINE up to its SEQEND, which is passed over. */
static il_status read_vertices(il_dxf *d, il_dxf_entity *e, il_error *err)
{
    il_status st = IL_OK;
    while (st == IL_OK && il_dxf_is(&d->scan, 0, "VERTEX")) {
        st = keep_group(d, e, 0, 0, err);
        if (st == IL_OK)
            st = read_groups(d, e, true, err);
    }
    if (st == IL_OK && !il_dxf_is(&d->scan, 0, "SEQEND"))
        st = il_fail(err, IL_E_INPUT, d->scan.line, "the POLYLINE of line %ld has no SEQEND", e->line);
    while (st == IL_OK && (st = il_dxf_next(&d->scan, err)) == IL_OK && d->scan.code != 0)
        continue;
    return st;
}

il_status il_dxf_read_entity(il_dxf *d, il_dxf_entity *e, il_error *err)
{
    *e = (il_dxf_entity){ .kind = kind_of(&d->scan), .block = UINT32_MAX, .line = d->scan.line, .begin = d->n_groups };
    if (!il_dictionary_put(&d->types, d->scan.value, d->scan.n, &e->name))
        return e->name == IL_DICTIONARY_MOST ? il_fail(err, IL_E_INPUT, e->line, "more than %d types of entities", IL_DICTIONARY_MOST)
                                        : il_fail_nomem(err);
    il_status st = read_groups(d, e, false, err);
    if (st == IL_OK && e->kind == IL_DXF_POLYLINE)
        st = read_vertices(d, e, err);
    e->n = d->n_groups - e->begin;
    return st;
}
