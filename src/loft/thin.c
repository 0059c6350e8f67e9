#include "config.h"
#include "loft/thin.h"
#include "base/alloc.h"

/* All vertices are tried PASSES times over. */
enum { PASSES = 4 };

/* Angles whose sine is BAD or more are good enough; a vertex that goes makes the smallest
 * angle so many times what it was. */
static const double BAD = 0.35, GAIN = 1.05;

/* fan[n]: the corners at vertex U, counter-clockwise; it goes to vertex W, along half-edge fan[j]. */
typedef struct thinning {
    il_net *net;
    uint32_t u, w, fan[IL_NET_FAN_MOST];
    size_t n, j;
} thinning;

static uint32_t beside(const thinning *t, size_t k)
{
    return t->net->at[il_net_next(t->fan[k])];
}

/* The sine of the smallest angle about U; its nearest neighbour becomes W, on its contour when it has one. */
static double judge(thinning *t)
{
    double worst = 1, least = INFINITY;
    bool level = false;
    for (size_t k = 0; k < t->n; k++) {
        double normal[3], way[3];
        uint32_t v = beside(t, k);
        worst = fmin(worst, il_net_shape(t->net, t->u, v, t->net->at[il_net_previous(t->fan[k])], normal));
        il_net_way(t->net, t->u, v, way);
        double l = il_net_dot(way, way);
        bool same = il_net_on_level(t->net, t->u, v);
        if (same > level || (same == level && l < least))
            least = l, t->j = k, t->w = v, level = same;
    }
    return worst;
}

/* Have U and W no common neighbours but the corners of the two triangles at their edge, and W no
 * others in the plane of its section but the next on its contour? */
static bool may_join(const thinning *t)
{
    uint32_t fan[IL_NET_FAN_MOST], common = 0;
    bool closed;
    size_t n = il_net_fan(t->net, il_net_next(t->fan[t->j]), fan, &closed);
    for (size_t k = 0; k < t->n; k++) {
        uint32_t v = beside(t, k);
        bool joined = false;
        for (size_t i = 0; i < n && v != t->w; i++)
            joined = joined || t->net->at[il_net_next(fan[i])] == v || t->net->at[il_net_previous(fan[i])] == v;
        common += joined;
        if (v != t->w && !joined && il_net_in_plane(t->net, t->w, v))
            return false;
    }
    return n > 0 && common == 2;
}

/* The triangles with W for U: are they better than BEFORE, do they look where the others do and lie near U?
 * How far the surface may have moved then, or infinity. */
static double move(const thinning *t, double before)
{
    const il_net *net = t->net;
    double most = 0, uw[3];
    il_net_way(net, t->u, t->w, uw);
    for (size_t k = 0; k < t->n; k++) {
        uint32_t v = beside(t, k), x = net->at[il_net_previous(t->fan[k])];
        if (v == t->w || x == t->w)
            continue;
        double old[3], new[3];
        il_net_shape(net, t->u, v, x, old);
        if (!(il_net_shape(net, t->w, v, x, new) > GAIN * before) || !(il_net_dot(old, new) > 0))
            return INFINITY;
        if (il_net_in_plane(net, t->w, v) && il_net_in_plane(net, v, x))
            return INFINITY;
        most = fmax(most, fabs(il_net_dot(new, uw)) / sqrt(il_net_dot(new, new)));
    }
    return most + net->moved[t->u];
}

static void join_mates(il_net *net, uint32_t i, uint32_t j)
{
    if (i != IL_NET_NONE)
        net->mate[i] = j;
    if (j != IL_NET_NONE)
        net->mate[j] = i;
}

static void collapse(thinning *t, double moved)
{
    il_net *net = t->net;
    uint32_t left = t->fan[t->j], right = t->fan[(t->j + t->n - 1) % t->n];
    for (size_t k = 0; k < t->n; k++) {
        uint32_t v = beside(t, k);
        net->moved[v] = fmax(net->moved[v], moved);
    }
    join_mates(net, net->mate[il_net_next(left)], net->mate[il_net_previous(left)]);
    join_mates(net, net->mate[il_net_next(right)], net->mate[right]);
    for (size_t k = 0; k < t->n; k++) {
        net->at[t->fan[k]] = t->w;
        net->touched[t->fan[k] / 3] = 1;
    }
    for (uint32_t k = 0; k < 3; k++)
        net->at[left - left % 3 + k] = net->at[right - right % 3 + k] = IL_NET_NONE;
}

/* The vertex at CORNER. */
static bool try_vertex(thinning *t, uint32_t corner)
{
    il_net *net = t->net;
    bool closed;
    t->u = net->at[corner];
    if (t->u == IL_NET_NONE || t->u < net->first[1] || net->fixed[t->u] || !net->single[t->u])
        return false;
    t->n = il_net_fan(net, corner, t->fan, &closed);
    if (t->n < 3 || !closed)
        return false;
    double before = judge(t);
    if (before >= BAD || net->fixed[t->w] || !net->single[t->w])
        return false;
    double moved = move(t, before);
    if (!(moved <= IL_NET_MOVE * net->height) || !may_join(t))
        return false;
    collapse(t, moved);
    return true;
}

il_status il_thin(il_net *net, size_t *n, il_error *err)
{
    thinning t = { .net = net };
    unsigned char *seen = il_calloc(net->n_vertices, 1);
    size_t before = 1;
    *n = 0;
    if (!seen)
        return il_fail_nomem(err);
    for (int pass = 0; *n != before && pass < PASSES; pass++) {
        before = *n;
        for (uint32_t i = 0; i < 3 * net->n_triangles; i++) {
            uint32_t v = net->at[i];
            if (v == IL_NET_NONE || seen[v] == pass + 1)
                continue;
            seen[v] = (unsigned char)(pass + 1);
            *n += try_vertex(&t, i);
        }
    }
    il_free(seen);
    return IL_OK;
}
