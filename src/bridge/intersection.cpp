/* intersection.cpp - bridge/intersection.h: a tree of boxes gives the candidates,
 * facet.h decides them. */
#include "config.h"
#include "bridge/facet.h"
#include "bridge/guard.h"
#include "bridge/intersection.h"
extern "C" {
#include "base/alloc.h"
}

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace {

/* ---- facets ----------------------------------------------------------------- */

/* id[i]: the least vertex at the position of vertex i. */
std::vector<uint32_t> merge_positions(const double *xyz, size_t n)
{
    struct Place { double x, y, z; uint32_t i; };
    std::vector<Place> place(n);
    for (size_t i = 0; i < n; i++)
        place[i] = Place{ xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2], uint32_t(i) };
    std::sort(place.begin(), place.end(), [](const Place &a, const Place &b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z != b.z ? a.z < b.z : a.i < b.i;
    });
    std::vector<uint32_t> id(n);
    for (size_t k = 0; k < n; k++) {
        bool same = k > 0 && place[k].x == place[k - 1].x && place[k].y == place[k - 1].y
                 && place[k].z == place[k - 1].z;
        id[place[k].i] = same ? id[place[k - 1].i] : place[k].i;
    }
    return id;
}

/* Fill normal and doubt; false when F has no area.  doubt as in side(); a
 * component of the normal alone has seen 4 roundings. */
bool set_plane(Facet &f, const double extent[3])
{
    const double u = DBL_EPSILON / 2;
    bool area = false;
    double largest = std::max({ extent[0], extent[1], extent[2] });
    f.doubt = 4 * DBL_MIN * (1 + largest);
    for (int k = 0; k < 3; k++) {
        int x = (k + 1) % 3, y = (k + 2) % 3;
        double left = (f.v[1][x] - f.v[0][x]) * (f.v[2][y] - f.v[0][y]);
        double right = (f.v[1][y] - f.v[0][y]) * (f.v[2][x] - f.v[0][x]);
        double size = std::fabs(left) + std::fabs(right);
        f.normal[k] = left - right;
        f.doubt += 16 * u * size * extent[k];
        area = area || std::fabs(f.normal[k]) > 8 * u * size + DBL_MIN;
    }
    for (int k = 0; k < 3 && !area; k++)
        area = orient_plan(f.v[0], f.v[1], f.v[2], (k + 1) % 3, (k + 2) % 3) != 0;
    return area;
}

/* ---- boxes ------------------------------------------------------------------ */

Box empty_box()
{
    Box b;
    std::fill(b.lo, b.lo + N_AXES, INFINITY);
    std::fill(b.hi, b.hi + N_AXES, -INFINITY);
    std::fill(b.hub, b.hub + 3, NO_HUB);
    b.group = MIXED;
    b.touched = false;
    return b;
}

/* Where P stands along axis K. */
double along(const double *p, int k)
{
    const double x = p[0], y = p[1];
    switch (k) {
    case 0:  return x;
    case 1:  return y;
    case 2:  return p[2];
    case 3:  return x + y;
    case 4:  return x - y;
    case 5:  return 2 * x + y;
    case 6:  return 2 * x - y;
    case 7:  return x + 2 * y;
    default: return x - 2 * y;
    }
}

/* From places along the axes to those in boxes. */
struct Frame {
    double origin[N_AXES], scale[2]; /* scale: of plan and height */
};

/* The largest power of two at most 1 / SIZE. */
double scale_for(double size)
{
    return std::ldexp(1, std::min(-std::ilogb(size), 1000));
}

Frame make_frame(const double low[3], const double extent[3])
{
    Frame f;
    for (int k = 0; k < N_AXES; k++)
        f.origin[k] = along(low, k);
    f.scale[0] = scale_for(std::max(extent[0], extent[1]));
    f.scale[1] = scale_for(extent[2]);
    return f;
}

void add_point(Box &b, const Frame &frame, const double *p)
{
    for (int k = 0; k < N_AXES; k++) {
        float value = float((along(p, k) - frame.origin[k]) * frame.scale[k == 2]);
        b.lo[k] = std::min(b.lo[k], value);
        b.hi[k] = std::max(b.hi[k], value);
    }
}

bool has_hub(const Box &b, uint32_t hub)
{
    return std::find(b.hub, b.hub + 3, hub) != b.hub + 3;
}

uint32_t least_common_hub(const Box &a, const Box &b)
{
    uint32_t least = NO_HUB;
    for (uint32_t h : a.hub)
        if (h < least && has_hub(b, h))
            least = h;
    return least;
}

/* B and OTHER in one; of hubs, what both have.  An empty box has them all. */
void add_box(Box &b, const Box &other)
{
    if (b.lo[0] > b.hi[0]) {
        b = other;
        return;
    }
    for (uint32_t &h : b.hub)
        if (!has_hub(other, h))
            h = NO_HUB;
    for (int k = 0; k < N_AXES; k++) {
        b.lo[k] = std::min(b.lo[k], other.lo[k]);
        b.hi[k] = std::max(b.hi[k], other.hi[k]);
    }
    if (b.group != other.group)
        b.group = MIXED;
    b.touched = b.touched || other.touched;
}

bool overlap(const Box &a, const Box &b)
{
    for (int k = 0; k < N_AXES; k++)
        if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k])
            return false;
    return true;
}

/* ---- the tree --------------------------------------------------------------- */

/* The lower 20 bits of X, two zeros between each and the next. */
uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001F00000000FFFF);
    x = (x | x << 16) & UINT64_C(0x001F0000FF0000FF);
    x = (x | x << 8) & UINT64_C(0x100F00F00F00F00F);
    x = (x | x << 4) & UINT64_C(0x10C30C30C30C30C3);
    return (x | x << 2) & UINT64_C(0x1249249249249249);
}

/* What was found: how many pairs, and the least of them; between groups, which. */
struct Found {
    size_t limit, n;
    uint32_t first[2];
    std::set<std::pair<uint32_t, uint32_t>> groups;

    bool enough() const { return n >= limit; }

    void record(uint32_t a, uint32_t b)
    {
        if (a > b)
            std::swap(a, b);
        n++;
        if (a < first[0] || (a == first[0] && b < first[1])) {
            first[0] = a;
            first[1] = b;
        }
    }

    /* Need A and B be compared?  Not within a group, and groups only until they meet. */
    bool wants(const Box &a, const Box &b) const
    {
        if (a.group == MIXED || b.group == MIXED)
            return true;
        return a.group != b.group && !groups.count(std::minmax(a.group, b.group));
    }

    void record(const Facet &a, const Facet &b)
    {
        record(a.index, b.index);
        if (a.box.group != MIXED)
            groups.insert(std::minmax(a.box.group, b.box.group));
    }
};

/* Triangles at a vertex all have overlapping boxes: n of them, n^2 pairs.  So a
 * vertex of many triangles is a hub, and their pairs are left to a search of
 * its own among their directions (search_hub).  This search is for the pairs
 * whose least hub in common is HUB; NO_HUB: for those that have none. */
struct Search {
    Found &found;
    uint32_t hub;
    std::vector<Facet> facet;   /* along a Morton curve through the boxes' centres */
    std::vector<Box> node;      /* a complete binary tree; node k has 2k + 1 and 2k + 2 */
    size_t n_leaves = 1;        /* leaf i holds the facets [i n / n_leaves, (i + 1) n / n_leaves) */

    Search(Found &f, uint32_t h) : found(f), hub(h) {}

    size_t leaf_begin(size_t i) const { return i * facet.size() / n_leaves; }

    void sort_facets()
    {
        struct Key { uint64_t code; uint32_t place; };
        std::vector<Key> key(facet.size());
        Box all = empty_box();
        for (const Facet &f : facet)
            add_box(all, f.box);
        for (size_t i = 0; i < facet.size(); i++) {
            uint64_t code = 0;
            for (int k = 0; k < 3; k++) {
                double size = double(all.hi[k]) - double(all.lo[k]);
                double middle = double(facet[i].box.lo[k]) / 2 + double(facet[i].box.hi[k]) / 2;
                double part = (middle - double(all.lo[k])) / std::max(size, DBL_MIN);
                code |= spread_bits(uint64_t(std::min(1.0, std::max(0.0, part)) * 0xFFFFF)) << k;
            }
            key[i] = Key{ code, uint32_t(i) };
        }
        std::sort(key.begin(), key.end(), [](const Key &a, const Key &b) {
            return a.code != b.code ? a.code < b.code : a.place < b.place;
        });
        std::vector<Facet> sorted;
        sorted.reserve(facet.size());
        for (const Key &k : key)
            sorted.push_back(facet[k.place]);
        facet.swap(sorted);
    }

    void build_tree()
    {
        while (LEAF_SIZE * n_leaves < facet.size())
            n_leaves *= 2;
        node.assign(2 * n_leaves - 1, empty_box());
        for (size_t i = 0; i < n_leaves; i++)
            for (size_t j = leaf_begin(i); j < leaf_begin(i + 1); j++)
                add_box(node[n_leaves - 1 + i], facet[j].box);
        for (size_t k = n_leaves - 1; k-- > 0;)
            for (size_t child = 2 * k + 1; child <= 2 * k + 2; child++)
                add_box(node[k], node[child]);
    }

    /* All pairs of one facet under node A and one under node B, which are on
     * one level.  Recursion: at most one level of the tree a step. */
    void search(size_t a, size_t b)
    {
        if (found.enough() || !(node[a].touched || node[b].touched) || !overlap(node[a], node[b])
            || least_common_hub(node[a], node[b]) < hub || !found.wants(node[a], node[b]))
            return;
        if (a >= n_leaves - 1) {
            search_leaves(a - (n_leaves - 1), b - (n_leaves - 1));
            return;
        }
        search(2 * a + 1, 2 * b + 1);
        search(2 * a + 1, 2 * b + 2);
        if (a != b)
            search(2 * a + 2, 2 * b + 1);
        search(2 * a + 2, 2 * b + 2);
    }

    void search_leaves(size_t a, size_t b)
    {
        for (size_t i = leaf_begin(a); i < leaf_begin(a + 1); i++) {
            const Facet &s = facet[i];
            for (size_t j = a == b ? i + 1 : leaf_begin(b); j < leaf_begin(b + 1); j++) {
                const Facet &t = facet[j];
                if (overlap(s.box, t.box) && (s.box.touched || t.box.touched) && found.wants(s.box, t.box)
                    && least_common_hub(s.box, t.box) == hub && meet(s, t)) {
                    found.record(s, t);
                    if (found.enough())
                        return;
                }
            }
        }
    }

    void run()
    {
        sort_facets();
        build_tree();
        search(0, 0);
    }
};

/* ---- hubs ------------------------------------------------------------------- */

enum { HUB_DEGREE = 48 };

/* Direction of P seen from V on the cube with corners (+-1, +-1, +-1). */
void direction(const double *v, const double *p, double out[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = p[k] - v[k];
        largest = std::max(largest, std::fabs(out[k]));
    }
    for (int k = 0; k < 3; k++)
        out[k] /= largest;
}

/* A box round the directions in which F, seen from its vertex I, lies.  With d
 * the largest component of the chord between those of its other vertices, a
 * point of the chord has at least 1 - d/2 as its largest component, so it moves
 * by at most d/2 on its way out to the cube.  Rounding errs by 4 u at most. */
Box direction_box(const Facet &f, int i)
{
    Box b = f.box;
    double p[3], q[3], d = 0;
    direction(f.v[i], f.v[(i + 1) % 3], p);
    direction(f.v[i], f.v[(i + 2) % 3], q);
    for (int k = 0; k < 3; k++)
        d = std::max(d, std::fabs(p[k] - q[k]));
    for (int k = 0; k < N_AXES; k++)
        b.lo[k] = b.hi[k] = 0;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float(std::min(p[k], q[k]) - (d / 2 + 4 * DBL_EPSILON));
        b.hi[k] = float(std::max(p[k], q[k]) + (d / 2 + 4 * DBL_EPSILON));
    }
    return b;
}

/* A hub and one of its triangles. */
struct Spoke {
    uint32_t hub, facet;
    int corner;
};

/* Note in the facets which of their vertices are hubs; the spokes, hub by hub. */
std::vector<Spoke> find_hubs(std::vector<Facet> &facet, size_t n_vertices)
{
    std::vector<uint32_t> degree(n_vertices);
    std::vector<Spoke> spoke;
    for (const Facet &f : facet)
        for (uint32_t v : f.id)
            degree[v]++;
    for (size_t i = 0; i < facet.size(); i++)
        for (int k = 0; k < 3; k++)
            if (degree[facet[i].id[k]] >= HUB_DEGREE) {
                facet[i].box.hub[k] = facet[i].id[k];
                spoke.push_back(Spoke{ facet[i].id[k], uint32_t(i), k });
            }
    std::sort(spoke.begin(), spoke.end(), [](const Spoke &a, const Spoke &b) {
        return a.hub != b.hub ? a.hub < b.hub : a.facet < b.facet;
    });
    return spoke;
}

/* Two triangles that share a vertex meet elsewhere only if they lie in a common
 * direction from it. */
void search_hub(const std::vector<Facet> &facet, const Spoke *spoke, size_t n, Found &found)
{
    Search star(found, spoke->hub);
    star.facet.reserve(n);
    for (size_t i = 0; i < n; i++) {
        star.facet.push_back(facet[spoke[i].facet]);
        star.facet.back().box = direction_box(facet[spoke[i].facet], spoke[i].corner);
    }
    star.run();
}

void search_hubs(const std::vector<Facet> &facet, const std::vector<Spoke> &spoke, Found &found)
{
    for (size_t i = 0, j; i < spoke.size(); i = j) {
        for (j = i; j < spoke.size() && spoke[j].hub == spoke[i].hub; j++)
            continue;
        search_hub(facet, &spoke[i], j - i, found);
    }
}

/* The extent of what the triangles use, no side of it 0 (it divides). */
void find_extent(const double *xyz, const uint32_t *tri, size_t n, double low[3], double extent[3])
{
    double high[3];
    for (int k = 0; k < 3; k++)
        low[k] = high[k] = xyz[3 * size_t(tri[0]) + size_t(k)];
    for (size_t i = 0; i < 3 * n; i++)
        for (int k = 0; k < 3; k++) {
            double c = xyz[3 * size_t(tri[i]) + size_t(k)];
            low[k] = std::min(low[k], c);
            high[k] = std::max(high[k], c);
        }
    for (int k = 0; k < 3; k++)
        extent[k] = std::max(high[k] - low[k], DBL_MIN);
}

il_status find_intersections(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n,
                             const unsigned char *touched, const uint32_t *group, Found &found, il_error *err)
{
    for (size_t i = 0; i < 3 * n; i++)
        if (tri[i] >= n_vertices)
            return il_fail(err, IL_E_INTERNAL, 0, "a triangle names a vertex that is not there");
    double low[3], extent[3];
    find_extent(xyz, tri, n, low, extent);
    const Frame frame = make_frame(low, extent);
    std::vector<uint32_t> id = merge_positions(xyz, n_vertices);
    Search search(found, NO_HUB);
    search.facet.reserve(n);
    for (size_t i = 0; i < n && !found.enough(); i++) {
        if (group && group[i] == MIXED)
            continue;
        Facet f;
        for (int k = 0; k < 3; k++) {
            f.v[k] = xyz + 3 * size_t(tri[3 * i + size_t(k)]);
            f.id[k] = id[tri[3 * i + size_t(k)]];
        }
        f.index = uint32_t(i);
        f.box = empty_box();
        for (const double *v : f.v)
            add_point(f.box, frame, v);
        f.box.touched = !touched || touched[i];
        f.box.group = group ? group[i] : MIXED;
        if (set_plane(f, extent))
            search.facet.push_back(f);
        else if (f.box.touched && !group)
            found.record(f.index, f.index);
    }
    search_hubs(search.facet, find_hubs(search.facet, n_vertices), found);
    search.run();
    return IL_OK;
}

} // namespace

il_status il_intersections(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                           const unsigned char *touched, size_t limit,
                           size_t *found, uint32_t first[2], il_error *err)
{
    *found = 0;
    first[0] = first[1] = UINT32_MAX;
    if (n_triangles == 0 || limit == 0)
        return IL_OK;
    return guarded(err, [&] {
        Found all = { limit, 0, { UINT32_MAX, UINT32_MAX }, {} };
        il_status st = find_intersections(xyz, n_vertices, tri, n_triangles, touched, nullptr, all, err);
        *found = all.n;
        first[0] = all.first[0];
        first[1] = all.first[1];
        return st;
    });
}

il_status il_intersections_between(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                                   const uint32_t *group, const unsigned char *touched,
                                   uint32_t **pair, size_t *n_pairs, il_error *err)
{
    *pair = nullptr;
    *n_pairs = 0;
    if (n_triangles == 0)
        return IL_OK;
    return guarded(err, [&] {
        Found all = { SIZE_MAX, 0, { UINT32_MAX, UINT32_MAX }, {} };
        il_status st = find_intersections(xyz, n_vertices, tri, n_triangles, touched, group, all, err);
        if (st != IL_OK)
            return st;
        *pair = static_cast<uint32_t *>(il_alloc(all.groups.size(), 2 * sizeof **pair));
        if (!*pair)
            return il_fail_nomem(err);
        for (const auto &p : all.groups) {
            (*pair)[2 * *n_pairs] = p.first;
            (*pair)[2 * *n_pairs + 1] = p.second;
            ++*n_pairs;
        }
        return IL_OK;
    });
}
