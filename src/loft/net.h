/* net.h - a slab's triangles with what lies beside them, to be changed in place. */
#ifndef IL_LOFT_NET_H
#define IL_LOFT_NET_H

#include "loft/surface.h"

#include <math.h>

#define IL_NET_NONE UINT32_MAX

/* The most triangles about a vertex that are looked at. */
enum { IL_NET_FAN_MOST = 64 };

/* How far changes may move the surface of a slab, in slab heights. */
#define IL_NET_MOVE 0.005

/* Vertices stand in the row of il_surface_row: xyz[3*n_vertices], with those of the upper section from
 * FIRST[0] on and the inner ones from first[1] on.  at[3*n_triangles]: the vertex at each
 * corner; IL_NET_NONE at those of triangles that are gone.  Corner i is also the half-edge that starts there;
 * mate[i] is its reverse, IL_NET_NONE for contour edges and what more than two triangles share.
 * single[v]: the triangles about v are one fan, of at most IL_NET_FAN_MOST.  Nothing that has a
 * FIXED vertex is to be changed.  moved[v]: how far the surface about vertex v may have moved.
 * touched[t]: triangle t is not what it was. */
typedef struct il_net {
    double *xyz, *moved, height;
    uint32_t *at, *mate;
    unsigned char *single, *fixed, *touched;
    size_t n_vertices, n_triangles, first[2];
} il_net;

/* Of S; no vertex is fixed but the pinched.  To be freed after failure too.  IL_E_NOMEM. */
il_status il_net_make(il_net *net, const il_surface *s, const il_section *lower, const il_section *upper, il_error *err);
void il_net_free(il_net *net); /* safe twice */

/* *OUT: the surface FROM with the triangles of NET and the inner points that they have; from[t] of them
 * are triangle (*triangle)[t] of NET.  Both to be freed after failure too.  Insertions stay with FROM. */
il_status il_net_surface(const il_net *net, const il_surface *from, il_surface *out, uint32_t **triangle, il_error *err);

static inline uint32_t il_net_next(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t il_net_previous(uint32_t corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/* The triangles about the vertex of CORNER as their corners there, counter-clockwise, from the
 * first of an open fan or from CORNER; how many, 0 when there are more than the most. */
size_t il_net_fan(const il_net *net, uint32_t corner, uint32_t fan[IL_NET_FAN_MOST], bool *closed);

/* Are vertices A and B nodes of one section, so that an edge between them would lie in its plane? */
static inline bool il_net_in_plane(const il_net *net, uint32_t a, uint32_t b)
{
    return a < net->first[1] && b < net->first[1] && (a < net->first[0]) == (b < net->first[0]);
}

/* Are A and B inner vertices of one height, as on a contour between the slices (levels.h)? */
static inline bool il_net_on_level(const il_net *net, uint32_t a, uint32_t b)
{
    return a >= net->first[1] && b >= net->first[1] && net->xyz[3 * (size_t)a + 2] == net->xyz[3 * (size_t)b + 2];
}

/* ---- shapes ---- */

static inline double il_net_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void il_net_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void il_net_way(const il_net *net, uint32_t from, uint32_t to, double out[3])
{
    for (size_t k = 0; k < 3; k++)
        out[k] = net->xyz[3 * (size_t)to + k] - net->xyz[3 * (size_t)from + k];
}

/* The normal of triangle ABC, as long as twice its area; the sine of its smallest angle, which is
 * that between its two longest edges. */
double il_net_shape(const il_net *net, uint32_t a, uint32_t b, uint32_t c, double normal[3]);

#endif
