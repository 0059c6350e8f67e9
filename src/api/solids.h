/* solids.h - a mesh sink that keeps every stack's mesh as arrays. */
#ifndef IL_API_SOLIDS_H
#define IL_API_SOLIDS_H

#include "isoloft.h"
#include "model/mesh.h"

/* list: borrowed, grows by one for each stack that ends certified. */
typedef struct il_solids_sink {
    il_mesh_sink sink;
    il_solids *list;
    il_solid open;        /* the stack that is being built, in its own coordinates */
    il_stack_head head;   /* its head */
    size_t cap, cap_vertices, cap_contour_vertices, cap_triangles;
} il_solids_sink;

void il_solids_sink_init(il_solids_sink *s, il_solids *list);
void il_solids_sink_free(il_solids_sink *s); /* not the list */

#endif
