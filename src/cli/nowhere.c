#include "config.h"
#include "cli/nowhere.h"

/* ---- contours -------------------------------------------------------------- */

static il_status take_head(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self;
    (void)head;
    (void)err;
    return IL_OK;
}

static il_status take_slice(il_sink *self, il_slice *slice, il_error *err)
{
    (void)self;
    (void)slice;
    (void)err;
    return IL_OK;
}

static il_status take_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self;
    (void)pair;
    (void)err;
    return IL_OK;
}

static il_status take_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

il_sink il_nowhere_contours(void)
{
    return (il_sink){ take_head, take_slice, take_pair, take_end, take_end };
}

/* ---- meshes ------------------------------------------------------------------ */

static il_status mesh_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self;
    (void)head;
    (void)err;
    return IL_OK;
}

static il_status mesh_piece(il_mesh_sink *self, const il_mesh *piece, il_error *err)
{
    (void)self;
    (void)piece;
    (void)err;
    return IL_OK;
}

static il_status mesh_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)self;
    (void)facts;
    (void)err;
    return IL_OK;
}

static void mesh_abandon(il_mesh_sink *self)
{
    (void)self;
}

static il_status mesh_finish(il_mesh_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

il_mesh_sink il_nowhere_meshes(void)
{
    return (il_mesh_sink){ mesh_begin, mesh_piece, mesh_end, mesh_abandon, mesh_finish };
}
