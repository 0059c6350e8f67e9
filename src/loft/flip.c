#include "config.h"
#include "loft/flip.h"

/* Edges are tried PASSES times over. */
enum { PASSES = 6 };

/* A flip makes the smaller of the smallest angles so many times what it was, or it is not worth it. */
static const double GAIN = 1.05;

/* Edge v[0] v[1] has the triangles v[0] v[1] v[2] and v[1] v[0] v[3]: is v[2] v[3] the better
 * diagonal?  The quadrilateral is convex when the new triangles look where both old ones do. */
static bool is_better(const il_net *net, const uint32_t v[4])
{
    double old[2][3], new[2][3];
    double before = fmin(il_net_shape(net, v[0], v[1], v[2], old[0]), il_net_shape(net, v[1], v[0], v[3], old[1]));
    double after = fmin(il_net_shape(net, v[0], v[3], v[2], new[0]), il_net_shape(net, v[3], v[1], v[2], new[1]));
    if (!(after > GAIN * before))
        return false;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (!(il_net_dot(old[i], new[k]) > 0))
                return false;
    return true;
}

/* How far the surface moves when the diagonal is the other one: they pass each other at the
 * distance |AB x CD . AC| / |AB x CD|. */
static double distance(const il_net *net, const uint32_t v[4])
{
    double ab[3], cd[3], ac[3], axis[3];
    il_net_way(net, v[0], v[1], ab);
    il_net_way(net, v[2], v[3], cd);
    il_net_way(net, v[0], v[2], ac);
    il_net_cross(ab, cd, axis);
    return fabs(il_net_dot(axis, ac)) / sqrt(il_net_dot(axis, axis));
}

/* Is there an edge from the vertex of CORNER, which is single, to V? */
static bool has_edge(const il_net *net, uint32_t corner, uint32_t v)
{
    uint32_t fan[IL_NET_FAN_MOST];
    bool closed;
    size_t n = il_net_fan(net, corner, fan, &closed);
    for (size_t k = 0; k < n; k++)
        if (net->at[il_net_next(fan[k])] == v || net->at[il_net_previous(fan[k])] == v)
            return true;
    return n == 0; /* too many to tell */
}

/* May the vertices at corners C and D be joined? */
static bool may_join(const il_net *net, uint32_t c, uint32_t d)
{
    uint32_t v = net->at[c], w = net->at[d];
    if (v == w || il_net_in_plane(net, v, w) || (!net->single[v] && !net->single[w]))
        return false;
    return net->single[v] ? !has_edge(net, c, w) : !has_edge(net, d, v);
}

static void join_mates(il_net *net, uint32_t i, uint32_t j)
{
    net->mate[i] = j;
    if (j != IL_NET_NONE)
        net->mate[j] = i;
}

/* Half-edges I and J, a b and b a: a b c becomes a d c, and b a d becomes b c d. */
static void flip(il_net *net, uint32_t i, uint32_t j)
{
    uint32_t i1 = il_net_next(i), j1 = il_net_next(j);
    uint32_t c = net->at[il_net_previous(i)], d = net->at[il_net_previous(j)];
    uint32_t beside_bc = net->mate[i1], beside_ad = net->mate[j1];
    net->at[i1] = d;
    net->at[j1] = c;
    join_mates(net, i, beside_ad);
    join_mates(net, j, beside_bc);
    join_mates(net, i1, j1);
    net->touched[i / 3] = net->touched[j / 3] = 1;
}

static bool try_edge(il_net *net, uint32_t i)
{
    uint32_t j = net->mate[i], c = il_net_previous(i);
    if (j == IL_NET_NONE || j < i || net->at[i] == IL_NET_NONE)
        return false;
    uint32_t d = il_net_previous(j), v[4] = { net->at[i], net->at[j], net->at[c], net->at[d] };
    if (net->fixed[v[0]] || net->fixed[v[1]] || net->fixed[v[2]] || net->fixed[v[3]])
        return false;
    if (il_net_on_level(net, v[0], v[1]) || !is_better(net, v))
        return false;
    double moved = distance(net, v) + fmax(fmax(net->moved[v[0]], net->moved[v[1]]), fmax(net->moved[v[2]], net->moved[v[3]]));
    if (!(moved <= IL_NET_MOVE * net->height) || !may_join(net, c, d))
        return false;
    flip(net, i, j);
    for (int k = 0; k < 4; k++)
        net->moved[v[k]] = moved;
    return true;
}

size_t il_flip_edges(il_net *net)
{
    size_t n = 0, before = 1;
    for (int pass = 0; n != before && pass < PASSES; pass++) {
        before = n;
        for (uint32_t i = 0; i < 3 * net->n_triangles; i++)
            n += try_edge(net, i);
    }
    return n;
}
