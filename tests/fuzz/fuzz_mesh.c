/* fuzz_mesh.c - whatever the bytes, the mesh readers refuse them with a sentence,
 * or give a mesh whose audit stands: turned inside out it differs in sign alone. */
#include "config.h"
#include "input/mesh-file.h"
#include "model/audit.h"
#include "must.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void must_be_whole(const il_mesh *m)
{
    must(m->n_triangles > 0, "accepted without a triangle");
    for (size_t i = 0; i < 3 * m->n_triangles; i++)
        must(m->tri[i] < m->n_vertices, "a corner names no vertex");
    for (size_t i = 0; i < 3 * m->n_vertices; i++)
        must(fabs(m->xyz[i]) < 1e15, "a coordinate out of range");
}

static il_audit audit(const il_mesh *m)
{
    il_audit a;
    il_error err = IL_ERROR_INIT;
    must(il_mesh_audit(m, &a, &err) == IL_OK, err.text);
    return a;
}

static void turn_over(il_mesh *m)
{
    for (size_t t = 0; t < m->n_triangles; t++) {
        uint32_t a = m->tri[3 * t];
        m->tri[3 * t] = m->tri[3 * t + 2];
        m->tri[3 * t + 2] = a;
    }
}

static void must_mirror(const il_audit *a, const il_audit *b)
{
    must(a->edges <= 3 * a->triangles && a->components <= a->triangles, "more edges or components than can be");
    must(a->boundary_edges == b->boundary_edges && a->inconsistent_edges == b->inconsistent_edges
         && a->nonmanifold_edges == b->nonmanifold_edges && a->nonmanifold_vertices == b->nonmanifold_vertices
         && a->components == b->components && a->genus == b->genus, "turned over, another topology");
    must(a->self_intersections == b->self_intersections && a->degenerate_triangles == b->degenerate_triangles
         && a->first_intersection[0] == b->first_intersection[0], "turned over, other crossings");
    must(!(a->outward && b->outward), "outward both ways");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    enum { MOST = 500 }; /* triangles: all may lie in one box */
    il_error err = IL_ERROR_INIT;
    il_mesh mesh = IL_MESH_INIT;
    il_mesh_file_facts facts;
    il_source *source = NULL;
    must(il_source_from_memory(&source, data, n, "bytes", &err) == IL_OK, err.text);
    il_status st = il_mesh_file_read(source, &mesh, &facts, &err);
    il_source_close(source);
    must(st == IL_OK || (st == IL_E_INPUT && err.code == st && err.text[0]), "refused without a reason");
    must(st == IL_OK || (!mesh.xyz && !mesh.tri), "refused with something left");
    if (st == IL_OK) {
        must_be_whole(&mesh);
        if (mesh.n_triangles <= MOST) {
            il_audit a = audit(&mesh);
            turn_over(&mesh);
            il_audit b = audit(&mesh);
            must_mirror(&a, &b);
        }
    }
    il_mesh_free(&mesh);
    return 0;
}
