/* mesh-spool.h - what all mesh writers share: stacks wait here until the last
 * one is certified, and only then does a format write them.
 *
 * Vertices and triangles lie in two spools (base/output.h) as records of 40 and
 * 16 bytes, so memory is bounded by the spools' buffers, a head for each stack
 * and, for formats that ask for vertices in any order, VERTEX_CACHE below. */
#ifndef IL_OUTPUT_MESH_SPOOL_H
#define IL_OUTPUT_MESH_SPOOL_H

#include "output/writer.h"

typedef struct il_mesh_spool il_mesh_spool;

/* Positions are in world coordinates (the head's frame applied), -0 made 0. */
typedef struct il_spooled_vertex { double xyz[3]; il_origin origin; } il_spooled_vertex;

/* v: vertices of the triangle's stack, from 0; anticlockwise seen from outside. */
typedef struct il_spooled_triangle { uint32_t v[3]; int32_t slab; } il_spooled_triangle;

/* first_…: counts of all stacks before.  index: the stack's place in the input
 * as its vertices' origins say, else its place among those begun.  rounds: its
 * frame does; then vertices wait in the stack's own coordinates for its end. */
typedef struct il_spooled_stack {
    il_stack_head head;
    uint64_t first_vertex, n_vertices, first_triangle, n_triangles;
    int32_t index;
    bool index_known, left_handed, rounds;
} il_spooled_stack;

/* Write all of M to TO; called once, at `finish`.  Failures of TO itself need
 * not be looked for. */
typedef il_status (*il_mesh_format)(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err);

struct il_mesh_spool {
    il_mesh_sink sink;
    il_output *to;
    il_write_options options;
    il_mesh_format write;
    il_output *vertices, *triangles;
    il_spooled_stack *stack;
    size_t n_stacks, cap_stacks;
    int32_t n_begun;
    bool open;                     /* between begin and end */
    bool floats;                   /* what is written are 32-bit floats */
    struct il_vertex_page *cache;  /* see il_mesh_spool_vertex */
};

/* A sink that spools, and calls WRITE at the end.  O may be null.  FLOATS: the
 * format holds 32-bit floats only.  A stack whose frame rounds (output/mesh-settle.h)
 * is held in memory when it ends, and IL_E_SURFACE when it does not settle. */
il_status il_mesh_spool_new(il_mesh_sink **out, il_output *to, const il_write_options *o,
                            bool floats, il_mesh_format write, il_error *err);
void il_mesh_spool_free(il_mesh_sink *s);

/* Of all stacks together. */
uint64_t il_mesh_spool_n_vertices(const il_mesh_spool *m);
uint64_t il_mesh_spool_n_triangles(const il_mesh_spool *m);

/* Call EACH with every vertex (triangle) of stack K in order, until it fails or
 * the output has failed. */
il_status il_mesh_spool_each_vertex(il_mesh_spool *m, size_t k, void *self,
                                    il_status (*each)(void *self, const il_spooled_vertex *v, il_error *err),
                                    il_error *err);
il_status il_mesh_spool_each_triangle(il_mesh_spool *m, size_t k, void *self,
                                      il_status (*each)(void *self, const il_spooled_triangle *t, il_error *err),
                                      il_error *err);

/* Position of vertex I, counted over all stacks.  Any order is right; it is fast
 * when most of what is asked for was asked for lately, as the triangles of a
 * slab do: 128 pages of 1024 positions are kept (3 MB). */
il_status il_mesh_spool_position(il_mesh_spool *m, uint64_t i, double xyz[3], il_error *err);

/* Do the stacks' safe names (output/names.h) differ from one another? */
il_status il_mesh_spool_names_differ(const il_mesh_spool *m, bool *differ, il_error *err);

/* The safe name of stack K, with "-K+1" behind it unless names differ: so no
 * two stacks ever share one. */
enum { IL_STACK_NAME_MAX = 96 };
void il_mesh_spool_name(const il_mesh_spool *m, size_t k, bool differ, char to[IL_STACK_NAME_MAX]);

/* What is known of stack K as comment lines that begin with PREFIX. */
void il_mesh_spool_describe(const il_mesh_spool *m, size_t k, il_output *to, const char *prefix);

#endif
