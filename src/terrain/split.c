#include "config.h"
#include "terrain/split.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "terrain/links.h"

#include <string.h>

enum { PARTS_MOST = 4 };

/* The parts of one triangle, each with the parent's edge that each of its edges lies on whole,
 * or 3. */
typedef struct parts {
    uint32_t corner[3 * PARTS_MOST];
    unsigned char edge[3 * PARTS_MOST];
    size_t n;
} parts;

static void add(parts *p, const uint32_t corner[3], const unsigned char edge[3])
{
    memcpy(p->corner + 3 * p->n, corner, 3 * sizeof *corner);
    memcpy(p->edge + 3 * p->n, edge, 3);
    p->n++;
}

/* Edge K alone has a middle: from it to the corner opposite. */
static void halve(parts *p, const uint32_t v[3], const uint32_t m[3], unsigned k)
{
    unsigned next = (k + 1) % 3, last = (k + 2) % 3;
    add(p, (uint32_t[3]){ v[k], m[k], v[last] }, (unsigned char[3]){ 3, 3, (unsigned char)last });
    add(p, (uint32_t[3]){ m[k], v[next], v[last] }, (unsigned char[3]){ 3, (unsigned char)next, 3 });
}

/* Edge K alone has none: the corner opposite is cut off, and four points are left. */
static void cut_corner(parts *p, const il_chart *c, const uint32_t v[3], const uint32_t m[3], unsigned k)
{
    unsigned next = (k + 1) % 3, last = (k + 2) % 3;
    add(p, (uint32_t[3]){ m[next], v[last], m[last] }, (unsigned char[3]){ 3, 3, 3 });
    if (il_chart_distance(c, v[k], m[next]) < il_chart_distance(c, v[next], m[last])) {
        add(p, (uint32_t[3]){ v[k], v[next], m[next] }, (unsigned char[3]){ (unsigned char)k, 3, 3 });
        add(p, (uint32_t[3]){ v[k], m[next], m[last] }, (unsigned char[3]){ 3, 3, 3 });
    } else {
        add(p, (uint32_t[3]){ v[k], v[next], m[last] }, (unsigned char[3]){ (unsigned char)k, 3, 3 });
        add(p, (uint32_t[3]){ v[next], m[next], m[last] }, (unsigned char[3]){ 3, 3, 3 });
    }
}

static void divide(parts *p, const il_chart *c, const uint32_t v[3], const uint32_t m[3])
{
    unsigned n = 0, with = 0, without = 0;
    p->n = 0;
    for (unsigned k = 0; k < 3; k++) {
        bool has = m[k] != IL_CHART_NONE;
        n += has;
        with = has ? k : with;
        without = has ? without : k;
    }
    if (n == 0)
        add(p, v, (unsigned char[3]){ 0, 1, 2 });
    else if (n == 1)
        halve(p, v, m, with);
    else if (n == 2)
        cut_corner(p, c, v, m, without);
    else {
        for (unsigned k = 0; k < 3; k++)
            add(p, (uint32_t[3]){ v[k], m[k], m[(k + 2) % 3] }, (unsigned char[3]){ 3, 3, 3 });
        add(p, m, (unsigned char[3]){ 3, 3, 3 });
    }
}

bool il_split_is_sound(const il_chart *c, const uint32_t corner[3], const uint32_t middle[3])
{
    parts p;
    divide(&p, c, corner, middle);
    for (size_t i = 0; i < p.n; i++) {
        const uint32_t *v = p.corner + 3 * i;
        if (il_orientation(c->xy + 2 * (size_t)v[0], c->xy + 2 * (size_t)v[1], c->xy + 2 * (size_t)v[2]) <= 0)
            return false;
    }
    return true;
}

static size_t count_parts(const il_tin *t, const uint32_t *middle)
{
    size_t n = t->n;
    for (size_t k = 0; k < 3 * t->n; k++)
        n += middle[k] != IL_CHART_NONE;
    return n;
}

/* Who is across. */
static bool find_across(const uint32_t *corner, size_t n, size_t n_nodes, uint32_t *across)
{
    il_links l = IL_LINKS_INIT;
    bool ok = il_links_build(&l, corner, 3 * n, true, n_nodes);
    for (size_t k = 0; ok && k < 3 * n; k++) {
        il_links_range r = il_links_find(&l, corner[k], corner[il_tin_after(k)]);
        across[k] = IL_CHART_NONE;
        for (uint32_t i = r.begin; i < r.end; i++)
            if (corner[l.of[i]] != corner[k])
                across[k] = l.of[i] / 3;
    }
    il_links_free(&l);
    return ok;
}

bool il_tin_split(il_tin *t, const il_chart *c, const uint32_t *middle)
{
    size_t n = count_parts(t, middle), at = 0;
    uint32_t *corner = il_alloc(3 * n, sizeof *corner), *across = il_alloc(3 * n, sizeof *across);
    uint32_t *edge = il_alloc(3 * n, sizeof *edge), *face = il_alloc(n, sizeof *face);
    bool ok = corner && across && edge && face;
    for (size_t k = 0; ok && k < t->n; k++) {
        parts p;
        divide(&p, c, t->corner + 3 * k, middle + 3 * k);
        for (size_t i = 0; i < p.n; i++, at++) {
            face[at] = t->face[k];
            for (size_t j = 3 * i; j < 3 * i + 3; j++) {
                corner[3 * at + j % 3] = p.corner[j];
                edge[3 * at + j % 3] = p.edge[j] < 3 ? t->edge[3 * k + p.edge[j]] : IL_CHART_NONE;
            }
        }
    }
    ok = ok && find_across(corner, n, c->n_nodes, across);
    il_free(ok ? t->corner : corner);
    il_free(ok ? t->across : across);
    il_free(ok ? t->edge : edge);
    il_free(ok ? t->face : face);
    if (ok) {
        t->corner = corner, t->across = across, t->edge = edge, t->face = face;
        t->n = n;
    }
    return ok;
}
