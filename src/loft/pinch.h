/* pinch.h - where a solid touches itself: taken apart, so that the mesh is manifold. */
#ifndef IL_LOFT_PINCH_H
#define IL_LOFT_PINCH_H

#include "loft/certificate.h"

/* Split every edge that more than two triangles of S share at its middle, with
 * a middle of its own for each two triangles between which the solid lies: the
 * half-edges are paired in the order of their angles round the edge (loft.md 9).
 * The middles coincide in space, rounded when ROUND_FLOAT says.  touched[] (grown to the number of triangles,
 * the caller's to il_free; null before) marks the triangles that changed.
 * *N_SPLIT counts edges.  IL_E_SURFACE when the sheets do not alternate. */
il_status il_pinch_split_edges(il_surface *s, const il_section *lower, const il_section *upper,
                               bool round_float, unsigned char **touched, size_t *n_split, il_error *err);

/* The triangles that meet a section from one side.  `side` is the section's
 * place in S (IL_UPPER for what lies below it); no surface: nothing there. */
typedef struct il_collar {
    const il_surface *surface;
    int side;
} il_collar;

/* How the nodes of a section become vertices.  Node i has the vertices first[i]
 * (always) and, where fans of triangles meet in nothing but the point, others:
 * other[] tells for corner 3 * t + k of collar c, under key (c, corner), which.
 * n_vertices: all of them; node_of[v]: the node of vertex v.  Vertices count
 * from 0 in each section; the first n_nodes are the first[]. */
typedef struct il_umbrellas {
    il_keymap other;
    uint32_t *node_of;
    size_t n_vertices, cap;
    size_t n_pinches;         /* nodes with more than one vertex */
} il_umbrellas;

#define IL_UMBRELLAS_INIT { IL_KEYMAP_INIT, NULL, 0, 0, 0 }

/* collar[0] lies below SECTION, collar[1] above. */
il_status il_umbrellas_find(il_umbrellas *u, const il_section *section, const il_collar collar[2], il_error *err);
void il_umbrellas_free(il_umbrellas *u);

/* Vertex of the corner, counted in its section: node i unless told otherwise. */
uint32_t il_umbrellas_vertex(const il_umbrellas *u, int collar, size_t corner, uint32_t node);

#endif
