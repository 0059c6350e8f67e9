/* contour-tin.cpp - the peer of surfaces: a contour TIN, as CGAL's manual has one built.
 *
 *     contour-tin <STREAM >TIN.ply
 *
 * The constrained Delaunay triangulation of all vertices of a native stream's lines, with every
 * line in it, as binary PLY.  What lies flat stays flat, and nothing is looked at again. */
#include "config.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <unordered_map>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Constrained_Delaunay_triangulation_2<CGAL::Projection_traits_xy_3<Kernel>, CGAL::Default, CGAL::Exact_predicates_tag> Tin;
typedef Kernel::Point_3 Point;

struct Line {
    bool closed;
    std::vector<Point> point;
};

static const char *parse(const char *s, const char *end, double *value)
{
    while (s < end && *s == ' ')
        s++;
    auto [next, failed] = std::from_chars(s, end, *value);
    return failed == std::errc() ? next : nullptr;
}

static bool begins(const std::string &s, const char *word)
{
    return s.compare(0, std::strlen(word), word) == 0;
}

static std::vector<Line> read_lines()
{
    std::vector<Line> lines;
    double z = 0, x, y;
    for (std::string s; std::getline(std::cin, s);) {
        const char *begin = s.data(), *end = begin + s.size();
        if (begins(s, "slice "))
            parse(begin + 6, end, &z);
        else if (begins(s, "ring") || begins(s, "line"))
            lines.push_back({ s[0] == 'r', {} });
        else if (!lines.empty() && (begin = parse(begin, end, &x)) && parse(begin, end, &y))
            lines.back().point.emplace_back(x, y, z);
    }
    return lines;
}

/* Along a line each point is looked for from the one before. */
static void add_line(Tin &tin, const Line &l)
{
    Tin::Vertex_handle first, last;
    for (const Point &p : l.point) {
        Tin::Vertex_handle next = tin.insert(p, first == nullptr ? Tin::Face_handle() : last->face());
        if (first == nullptr)
            first = next;
        else if (next != last)
            tin.insert_constraint(last, next);
        last = next;
    }
    if (l.closed && first != last)
        tin.insert_constraint(last, first);
}

/* All points at once, which CGAL sorts first; then the lines, whose points are there. */
static void triangulate(Tin &tin, const std::vector<Line> &lines)
{
    std::vector<Point> all;
    for (const Line &l : lines)
        all.insert(all.end(), l.point.begin(), l.point.end());
    tin.insert(all.begin(), all.end());
    for (const Line &l : lines)
        add_line(tin, l);
}

static void write(const Tin &tin)
{
    std::printf("ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty double x\nproperty double y\nproperty double z\n"
                "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                size_t(tin.number_of_vertices()), size_t(tin.number_of_faces()));
    std::unordered_map<Tin::Vertex_handle, int32_t> number;
    for (auto v = tin.finite_vertices_begin(); v != tin.finite_vertices_end(); ++v) {
        const double xyz[] = { v->point().x(), v->point().y(), v->point().z() };
        number.emplace(v, int32_t(number.size()));
        std::fwrite(xyz, sizeof xyz, 1, stdout);
    }
    for (auto f = tin.finite_faces_begin(); f != tin.finite_faces_end(); ++f) {
        const int32_t corner[] = { number[f->vertex(0)], number[f->vertex(1)], number[f->vertex(2)] };
        std::putchar(3);
        std::fwrite(corner, sizeof corner, 1, stdout);
    }
}

int main()
{
    std::ios::sync_with_stdio(false);
    Tin tin;
    triangulate(tin, read_lines());
    write(tin);
    return std::fflush(stdout) == 0 && !std::ferror(stdout) ? 0 : 4;
}
