/* triangulation.cpp - bridge/triangulation.h on CGAL's 2-D triangulations.
 *
 * CGAL iterates in an order of its own and keeps handles that are addresses;
 * nothing of that leaves here: vertices are known by our numbers and triangles
 * are sorted by them. */
#ifdef NDEBUG
#error "bridges are never built with NDEBUG: CGAL's checks are what stops a bad number"
#endif
#include "config.h"
#include "bridge/guard.h"
#include "bridge/triangulation.h"
extern "C" {
#include "base/alloc.h"
}

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel> Vertex;
typedef CGAL::Triangulation_face_base_with_info_2<uint32_t, Kernel> Labelled_face;
typedef CGAL::Constrained_triangulation_face_base_2<Kernel, Labelled_face> Face;
typedef CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                                   CGAL::No_constraint_intersection_requiring_constructions_tag> Cdt;

struct il_triangulation {
    Cdt cdt;
    size_t n = 0;
};

static void insert_points(il_triangulation *t, const double *xy, size_t n)
{
    std::vector<std::pair<Kernel::Point_2, uint32_t>> points;
    points.reserve(n);
    for (size_t i = 0; i < n; i++)
        points.emplace_back(Kernel::Point_2(xy[2 * i], xy[2 * i + 1]), uint32_t(t->n + i));
    t->cdt.insert(points.begin(), points.end());
    t->n += n;
    if (t->cdt.number_of_vertices() != t->n)
        throw std::runtime_error("triangulation: two points are one");
}

/* CGAL walks round an edge's first end.  So that is the end with fewer edges,
 * or a point where n edges meet would cost n^2 steps. */
static void insert_edges(Cdt &cdt, const std::vector<Cdt::Vertex_handle> &at, const uint32_t *edge, size_t m)
{
    std::vector<uint32_t> degree(at.size());
    for (size_t i = 0; i < 2 * m; i++)
        degree[edge[i]]++;
    for (size_t i = 0; i < m; i++) {
        uint32_t a = edge[2 * i], b = edge[2 * i + 1];
        if (degree[b] < degree[a])
            std::swap(a, b);
        cdt.insert_constraint(at[a], at[b]);
    }
}

static void build(il_triangulation *t, const double *xy, size_t n, const uint32_t *edge, size_t m)
{
    insert_points(t, xy, n);
    std::vector<Cdt::Vertex_handle> at(n);
    for (auto v = t->cdt.finite_vertices_begin(); v != t->cdt.finite_vertices_end(); ++v)
        at[v->info()] = v;
    insert_edges(t->cdt, at, edge, m);
    if (t->cdt.number_of_vertices() != n)
        throw std::runtime_error("triangulation: edges cross");
}

il_status il_triangulation_try(il_triangulation **out, const double *xy, size_t n,
                               const uint32_t *edge, size_t m, bool *crosses, il_error *err)
{
    *out = nullptr;
    *crosses = false;
    il_triangulation *t = nullptr;
    il_status st = guarded(err, [&] {
        t = new il_triangulation;
        try {
            build(t, xy, n, edge, m);
        } catch (const Cdt::Intersection_of_constraints_exception &) {
            *crosses = true;
        }
        return IL_OK;
    });
    if (st != IL_OK || *crosses)
        delete t;
    else
        *out = t;
    return st;
}

il_status il_triangulation_new(il_triangulation **out, const double *xy, size_t n,
                               const uint32_t *edge, size_t m, il_error *err)
{
    bool crosses = false;
    il_status st = il_triangulation_try(out, xy, n, edge, m, &crosses, err);
    return crosses ? il_fail(err, IL_E_INTERNAL, 0, "triangulation: edges cross") : st;
}

il_status il_triangulation_insert(il_triangulation *t, const double *xy, size_t n, il_error *err)
{
    return guarded(err, [&] {
        insert_points(t, xy, n);
        return IL_OK;
    });
}

/* The corner from which the triangle is written: its least. */
static int first_corner(const Cdt::Face_handle &f)
{
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (f->vertex(i)->info() < f->vertex(k)->info())
            k = i;
    return k;
}

il_status il_triangulation_export(il_triangulation *t, uint32_t **corner, uint32_t **across,
                                  size_t *n, il_error *err)
{
    *corner = *across = nullptr;
    *n = 0;
    il_status st = guarded(err, [&] {
        typedef std::pair<std::array<uint32_t, 3>, Cdt::Face_handle> Entry;
        std::vector<Entry> faces;
        if (t->cdt.dimension() == 2) {
            faces.reserve(t->cdt.number_of_faces());
            for (auto f = t->cdt.finite_faces_begin(); f != t->cdt.finite_faces_end(); ++f) {
                int k = first_corner(f);
                int l = Cdt::ccw(k), m = Cdt::cw(k);
                faces.push_back({ { f->vertex(k)->info(), f->vertex(l)->info(), f->vertex(m)->info() }, f });
            }
        }
        std::sort(faces.begin(), faces.end(), [](const Entry &a, const Entry &b) { return a.first < b.first; });
        for (auto f = t->cdt.all_faces_begin(); f != t->cdt.all_faces_end(); ++f)
            f->info() = UINT32_MAX;
        for (size_t i = 0; i < faces.size(); i++)
            faces[i].second->info() = uint32_t(i);
        *corner = static_cast<uint32_t *>(il_alloc(3 * faces.size(), sizeof **corner));
        *across = static_cast<uint32_t *>(il_alloc(3 * faces.size(), sizeof **across));
        if (!*corner || !*across)
            return il_fail_nomem(err);
        for (size_t i = 0; i < faces.size(); i++) {
            int k = first_corner(faces[i].second);
            for (unsigned j = 0; j < 3; j++) {
                (*corner)[3 * i + j] = faces[i].first[j];
                /* CGAL numbers neighbours by the corner they do not touch */
                (*across)[3 * i + j] = faces[i].second->neighbor((k + int(j) + 2) % 3)->info();
            }
        }
        *n = faces.size();
        return IL_OK;
    });
    if (st != IL_OK) {
        il_free(*corner);
        il_free(*across);
        *corner = *across = nullptr;
    }
    return st;
}

void il_triangulation_free(il_triangulation *t)
{
    delete t;
}
