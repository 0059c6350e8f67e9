#include "config.h"
#include "loft/net.h"
#include "base/alloc.h"

#include <string.h>

void il_net_free(il_net *net)
{
    il_free(net->xyz);
    il_free(net->moved);
    il_free(net->at);
    il_free(net->mate);
    il_free(net->single);
    il_free(net->fixed);
    il_free(net->touched);
    *net = (il_net){ .height = 0 };
}

double il_net_shape(const il_net *net, uint32_t a, uint32_t b, uint32_t c, double normal[3])
{
    double u[3], v[3], w[3];
    il_net_way(net, a, b, u);
    il_net_way(net, b, c, v);
    il_net_way(net, c, a, w);
    il_net_cross(u, v, normal);
    double l[3] = { il_net_dot(u, u), il_net_dot(v, v), il_net_dot(w, w) };
    double least = fmin(fmin(l[0], l[1]), l[2]);
    double others = least == l[0] ? l[1] * l[2] : least == l[1] ? l[2] * l[0] : l[0] * l[1];
    return others > 0 ? sqrt(il_net_dot(normal, normal) / others) : 0;
}

/* ---- what lies beside what ---- */

/* Half-edges meet their reverse where there is one of each. */
static bool find_mates(il_net *net)
{
    static const uint32_t SEVERAL = UINT32_MAX - 1;
    il_keymap half = IL_KEYMAP_INIT;
    uint32_t n = (uint32_t)(3 * net->n_triangles);
    bool ok = il_keymap_reserve(&half, n);
    for (uint32_t i = 0; ok && i < n; i++) {
        uint32_t *first = il_keymap_put(&half, net->at[i], net->at[il_net_next(i)], IL_NET_NONE);
        *first = *first == IL_NET_NONE ? i : SEVERAL;
    }
    for (uint32_t i = 0; ok && i < n; i++) {
        uint32_t a = net->at[i], b = net->at[il_net_next(i)];
        uint32_t j = il_keymap_get(&half, b, a, IL_NET_NONE);
        bool one = j < SEVERAL && il_keymap_get(&half, a, b, IL_NET_NONE) == i;
        net->mate[i] = one ? j : IL_NET_NONE;
    }
    il_keymap_free(&half);
    return ok;
}

size_t il_net_fan(const il_net *net, uint32_t corner, uint32_t fan[IL_NET_FAN_MOST], bool *closed)
{
    uint32_t first = corner;
    size_t n = 0;
    *closed = true;
    while (net->mate[first] != IL_NET_NONE) {
        first = il_net_next(net->mate[first]);
        if (first == corner || ++n > IL_NET_FAN_MOST)
            break;
    }
    *closed = net->mate[first] != IL_NET_NONE;
    uint32_t i = first;
    n = 0;
    do {
        if (n == IL_NET_FAN_MOST)
            return 0;
        fan[n++] = i;
        i = net->mate[il_net_previous(i)];
    } while (i != IL_NET_NONE && i != first);
    return n;
}

static bool find_single(il_net *net)
{
    uint32_t *n_at = il_calloc(net->n_vertices, sizeof *n_at), fan[IL_NET_FAN_MOST];
    if (!n_at)
        return false;
    for (size_t i = 0; i < 3 * net->n_triangles; i++)
        n_at[net->at[i]]++;
    for (uint32_t i = 0; i < 3 * net->n_triangles; i++) {
        uint32_t v = net->at[i];
        bool closed;
        if (n_at[v] > 0 && n_at[v] <= IL_NET_FAN_MOST)
            net->single[v] = il_net_fan(net, i, fan, &closed) == n_at[v];
        n_at[v] = 0; /* once */
    }
    il_free(n_at);
    return true;
}

il_status il_net_make(il_net *net, const il_surface *s, const il_section *lower, const il_section *upper, il_error *err)
{
    *net = (il_net){ .height = upper->z - lower->z, .n_triangles = s->n_triangles };
    net->first[0] = lower->n_nodes;
    net->first[1] = lower->n_nodes + upper->n_nodes;
    net->n_vertices = net->first[1] + s->n_inner;
    net->xyz = il_surface_positions(s, lower, upper);
    net->at = il_alloc(s->n_triangles, 3 * sizeof *net->at);
    net->mate = il_alloc(s->n_triangles, 3 * sizeof *net->mate);
    net->moved = il_calloc(net->n_vertices, sizeof *net->moved);
    net->single = il_calloc(net->n_vertices, 1);
    net->fixed = il_calloc(net->n_vertices, 1);
    net->touched = il_calloc(s->n_triangles, 1);
    if (!net->xyz || !net->moved || !net->at || !net->mate || !net->single || !net->fixed || !net->touched)
        return il_fail_nomem(err);
    for (size_t i = 0; i < 3 * s->n_triangles; i++)
        net->at[i] = (uint32_t)il_surface_row(lower, upper, s->tri[i]);
    for (size_t i = 0; i < s->n_pinched; i++)
        net->fixed[il_surface_row(lower, upper, s->pinched[i])] = 1;
    return find_mates(net) && find_single(net) ? IL_OK : il_fail_nomem(err);
}

/* ---- and back ---- */

/* code[v]: what vertex v is called in OUT, whose inner points are those that triangles have. */
static bool name_vertices(const il_net *net, il_surface *out, uint32_t *code)
{
    for (size_t v = 0; v < net->n_vertices; v++)
        code[v] = IL_NET_NONE;
    for (size_t i = 0; i < 3 * net->n_triangles; i++)
        if (net->at[i] != IL_NET_NONE)
            code[net->at[i]] = 0;
    for (size_t v = 0; v < net->n_vertices; v++) {
        if (v < net->first[1])
            code[v] = v < net->first[0] ? IL_CODE(IL_LOWER, v) : IL_CODE(IL_UPPER, v - net->first[0]);
        else if (code[v] == 0)
            code[v] = il_surface_add_inner(out, net->xyz + 3 * v);
        else
            continue;
        if (code[v] == IL_NET_NONE)
            return false;
    }
    return true;
}

static bool add_triangles(const il_net *net, il_surface *out, const uint32_t *code, uint32_t *triangle)
{
    for (uint32_t t = 0; t < net->n_triangles; t++) {
        const uint32_t *v = net->at + 3 * (size_t)t;
        if (v[0] == IL_NET_NONE)
            continue;
        triangle[out->n_triangles] = t;
        if (!il_surface_add_triangle(out, code[v[0]], code[v[1]], code[v[2]]))
            return false;
    }
    return true;
}

static bool add_pinched(const il_net *net, il_surface *out, const uint32_t *code, const il_surface *from)
{
    for (size_t i = 0; i < from->n_pinched; i++) {
        size_t before[3] = { 0, net->first[0], net->first[1] };
        size_t v = before[IL_CODE_WHERE(from->pinched[i])] + IL_CODE_INDEX(from->pinched[i]);
        if (!il_grow(&out->pinched, &out->cap_pinched, out->n_pinched + 1, sizeof *out->pinched))
            return false;
        out->pinched[out->n_pinched++] = code[v];
    }
    return true;
}

il_status il_net_surface(const il_net *net, const il_surface *from, il_surface *out, uint32_t **triangle, il_error *err)
{
    uint32_t *code = il_alloc(net->n_vertices, sizeof *code);
    *out = (il_surface)IL_SURFACE_INIT;
    out->walled = from->walled;
    *triangle = il_alloc(net->n_triangles, sizeof **triangle);
    bool ok = code && *triangle && name_vertices(net, out, code) && add_triangles(net, out, code, *triangle) &&
              add_pinched(net, out, code, from);
    il_free(code);
    return ok ? IL_OK : il_fail_nomem(err);
}
