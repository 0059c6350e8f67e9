/* chart.h - the lines of a map and its frame as one planar graph. */
#ifndef IL_TERRAIN_CHART_H
#define IL_TERRAIN_CHART_H

#include "base/keymap.h"
#include "model/report.h"
#include "terrain/frame.h"
#include "terrain/placement.h"

#define IL_CHART_NONE UINT32_MAX

/* A point of the plane.  z: its height on the map, NAN while nothing gives it one (corners of
 * the frame, points put into faces).  level, top: index of the lowest and the highest level that
 * it lies on, which differ where lines run together; -1 on none; z is that of the lowest.
 * slice, ring, vertex: of the input, -1 for points that were put in.  is_frame: on it.
 * is_spot: z is that of a spot height. */
typedef struct il_chart_node {
    double z;
    int32_t level, top, slice, ring, vertex;
    bool is_frame, is_spot;
} il_chart_node;

/* An isoline of the map: ring RING of slice LEVEL.  left_out: it is not in the chart. */
typedef struct il_chart_line {
    int32_t level, ring;
    bool left_out;
} il_chart_line;

/* The ring that line L of line[] is, in the levels slice[]. */
static inline const il_ring *il_chart_ring(const il_slice *slice, const il_chart_line *line, size_t l)
{
    return &slice[line[l].level].ring[line[l].ring];
}

/* xy[2*n_nodes], in the coordinates of the mesh (terrain/placement.h), distinct.
 * edge[2*n_edges]: nodes, along the lines; owner[e]: the line that it belongs to, n_lines and
 * more for interpolated ones, IL_CHART_NONE for the frame; height[e]: its level, -1 for the
 * frame.  Edges of the frame have the map on their left.
 * at: position -> node.  level_z[n_levels]: rising. */
typedef struct il_chart {
    double *xy;              size_t cap_xy;
    il_chart_node *node;     size_t n_nodes, cap_nodes;
    uint32_t *edge;          size_t n_edges, cap_edges;
    uint32_t *owner;         size_t cap_owners;
    int32_t *height;         size_t cap_heights;
    il_keymap at;
    const double *level_z;   size_t n_levels;
} il_chart;

#define IL_CHART_INIT { 0 }
void il_chart_free(il_chart *c); /* safe twice */

/* The node at the mesh's (x, y), made free of any height when there is none; IL_CHART_NONE
 * without memory. */
uint32_t il_chart_node_at(il_chart *c, double x, double y);

/* Append an edge of OWNER, on level LEVEL or -1 of the frame; false without memory.  One from
 * a node to itself is none. */
bool il_chart_add_edge(il_chart *c, uint32_t from, uint32_t to, uint32_t owner, int32_t level);

/* Is edge E one of the frame? */
static inline bool il_chart_is_frame(const il_chart *c, size_t e)
{
    return c->owner[e] == IL_CHART_NONE;
}

/* Distances of nodes A and B, and of the ends of edge E, in the plane of the mesh. */
double il_chart_distance(const il_chart *c, uint32_t a, uint32_t b);
double il_chart_length(const il_chart *c, size_t e);

/* Drop edges of the frame that are there twice, for it leads in and out at once there: rounding
 * may fold it.  False without memory. */
bool il_chart_unfold_frame(il_chart *c);

/* Drop edges from a node to itself. */
void il_chart_drop_points(il_chart *c);

/* A line of level LEVEL passes through NODE. */
void il_chart_put_on(il_chart *c, uint32_t node, int32_t level);

/* The chart of the lines line[n_lines] of slice[n_slices] that are not left out, without their
 * edges that are marked as the map's, and of FRAME.
 * HEAD's placement is chosen.  Long pieces of the frame are divided, and those between two
 * ends of one level.  IL_E_NOMEM, IL_E_INPUT beyond 2^31 nodes. */
il_status il_chart_build(il_chart *c, const il_slice *slice, const il_chart_line *line, size_t n_lines,
                         const il_frame *frame, const il_stack_head *head, const il_placement_options *o,
                         il_error *err);

#endif
