#include "config.h"
#include "lofting.h"
#include "model/audit.h"
#include "test.h"

#include <math.h>

static il_status keep_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    (void)head, (void)err;
    ((keeper *)self)->begun++;
    return IL_OK;
}

static il_status keep_piece(il_mesh_sink *self, const il_mesh *piece, il_error *err)
{
    keeper *k = (keeper *)self;
    for (size_t i = 0; i < piece->n_vertices; i++)
        if (!il_mesh_add_vertex(&k->mesh, piece->xyz + 3 * i, piece->origin[i]))
            return il_fail_nomem(err);
    for (size_t t = 0; t < piece->n_triangles; t++)
        if (!il_mesh_add_triangle(&k->mesh, piece->tri[3 * t], piece->tri[3 * t + 1], piece->tri[3 * t + 2]))
            return il_fail_nomem(err);
    return IL_OK;
}

static il_status keep_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)err;
    ((keeper *)self)->facts = *facts;
    ((keeper *)self)->ended++;
    return IL_OK;
}

static void keep_abandon(il_mesh_sink *self)
{
    ((keeper *)self)->abandoned++;
}

static il_status keep_finish(il_mesh_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

keeper new_keeper(void)
{
    keeper k = { .sink = { keep_begin, keep_piece, keep_end, keep_abandon, keep_finish } };
    return k;
}

il_status loft_pairs(keeper *k, const il_slice *slice, size_t n, il_pair *pair, const il_loft_options *o, il_error *err)
{
    il_sink *lofter = NULL;
    il_stack_head head = IL_STACK_HEAD_INIT;
    assert_int_equal(il_lofter_new(&lofter, o, &k->sink, err), IL_OK);
    il_status st = lofter->stack_begin(lofter, &head, err);
    for (size_t i = 0; st == IL_OK && i < n; i++) {
        il_slice copy = IL_SLICE_INIT;
        assert_int_equal(il_slice_copy(&copy, &slice[i], err), IL_OK);
        st = lofter->slice(lofter, &copy, err);
        il_slice_free(&copy);
        if (st == IL_OK && i > 0 && pair)
            st = lofter->pair(lofter, &pair[i - 1], err);
    }
    if (st == IL_OK)
        st = lofter->stack_end(lofter, err);
    if (st == IL_OK)
        st = lofter->end(lofter, err);
    il_lofter_free(lofter);
    for (size_t i = 0; pair && i + 1 < n; i++)
        il_pair_free(&pair[i]);
    return st;
}

void free_slices(il_slice *slice, size_t n)
{
    for (size_t i = 0; i < n; i++)
        il_slice_free(&slice[i]);
}

void assert_sound(const keeper *k, const char *what, unsigned long long seed)
{
    il_audit a;
    assert_int_equal(il_mesh_audit(&k->mesh, &a, NULL), IL_OK);
    if (!il_audit_is_sound(&a) || a.loose_vertices > 0)
        fail_msg("%s %llu: closed %d, %zu edges and %zu vertices not manifold, oriented %d, outward %d, "
                 "%zu crossings, %zu loose",
                 what, seed, a.closed, a.nonmanifold_edges, a.nonmanifold_vertices, a.oriented, a.outward,
                 a.self_intersections, a.loose_vertices);
    assert_int_equal(a.vertices, k->facts.vertices);
    assert_int_equal(a.triangles, k->facts.triangles);
    assert_int_equal(a.components, k->facts.components);
    assert_int_equal(a.genus, k->facts.genus);
    assert_true(fabs(a.volume - k->facts.volume) <= 1e-9 * fabs(a.volume) + 1e-9);
    assert_true(fabs(a.area - k->facts.area) <= 1e-9 * a.area);
}

void assert_same_mesh(const il_mesh *a, const il_mesh *b)
{
    assert_int_equal(a->n_vertices, b->n_vertices);
    assert_int_equal(a->n_triangles, b->n_triangles);
    assert_memory_equal(a->xyz, b->xyz, 3 * a->n_vertices * sizeof *a->xyz);
    assert_memory_equal(a->origin, b->origin, a->n_vertices * sizeof *a->origin);
    assert_memory_equal(a->tri, b->tri, 3 * a->n_triangles * sizeof *a->tri);
}
