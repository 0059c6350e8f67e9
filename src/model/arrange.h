/* arrange.h - edges in the plane made to meet in common end points only. */
#ifndef IL_MODEL_ARRANGE_H
#define IL_MODEL_ARRANGE_H

#include "base/keymap.h"
#include "base/status.h"
#include "model/stack.h"

/* Nodes are positions: xy[2*n_nodes], all distinct; mark[n_nodes] are vertex
 * marks (model/ring.h).  An edge runs from node edge[2*i] to edge[2*i + 1] and
 * belongs to input ring owner[i]; edge_mark[i] is IL_VERTEX_MAP_EDGE or 0.
 * Sub-edges of one ring follow one another along it. */
typedef struct il_arrangement {
    double *xy;            size_t n_nodes, cap_nodes;
    unsigned char *mark;   size_t cap_marks;
    uint32_t *edge;        size_t n_edges, cap_edges;
    uint32_t *owner;       size_t cap_owners;
    unsigned char *edge_mark; size_t cap_edge_marks;
    il_keymap at;          /* position -> node */
    double cell;           /* grid of inserted nodes, unit (il_slice_cell) */
} il_arrangement;

#define IL_ARRANGEMENT_INIT { 0 }
void il_arrangement_free(il_arrangement *a);

/* The node at (X, Y), made when there is none; UINT32_MAX without memory.  A
 * node counts as inserted only while every point that it stands for is. */
uint32_t il_arrangement_node(il_arrangement *a, double x, double y, unsigned char mark);

/* Append an edge; false without memory. */
bool il_arrangement_edge(il_arrangement *a, uint32_t from, uint32_t to, uint32_t owner, unsigned char mark);

/* The grid of the points inserted into S: 2^-44 of its extent, or 8 ulp of the
 * largest coordinate; ROUND_FLOAT: one that 32-bit floats hold.  A power of two.
 * Points nearer than that are the same in all but rounding. */
double il_slice_cell(const il_slice *s, bool round_float);

/* Append the closed rings of S: their vertices as nodes, ring i as owner i; the
 * cell becomes CELL.  The vertices are a cell apart (il_slice_gather). */
il_status il_arrangement_from_slice(il_arrangement *a, const il_slice *s, double cell, il_error *err);

/* Split edges until any two meet in end points or not at all (equal edges
 * apart): where edges cross, a node is inserted at the crossing, rounded to the
 * grid, or a node near there is taken; where a node lies on an edge, or nearer
 * to it than rounding could tell, the edge is led through it.  Nodes never move,
 * and all of them stay a cell apart.  A rounded crossing is not exactly on its
 * edges, so this is repeated until nothing changes (two or three rounds;
 * IL_E_INPUT after IL_ARRANGE_ROUNDS).  This is snap rounding (Halperin & Packer
 * 2002) with the input's points kept: afterwards no node is nearer to an edge
 * that it is not on, so that the lofter can always tell them apart.
 * *CROSSINGS: nodes inserted; *TOUCHES: nodes of before that edges were led
 * through. */
il_status il_arrangement_settle(il_arrangement *a, size_t *crossings, size_t *touches, il_error *err);

enum { IL_ARRANGE_ROUNDS = 40 };

#endif
