/* facet.h - do two triangles meet in more than they share?  The geometry of
 * intersection.cpp, for that file alone.
 *
 * Nothing is constructed: every answer is a combination of the signs of
 *     o(a, b, c, d) = det(b - a, c - a, d - a),
 * positive when d lies on the side of the plane abc that its normal
 * (b - a) x (c - a) points to, and of the same determinant in the plane.  Both
 * are exact (CGAL's filtered predicates), so the answer is. */
#ifndef IL_BRIDGE_FACET_H
#define IL_BRIDGE_FACET_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdint>
#include <utility>

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;

/* Intervals along the axes and six directions between x and y, where the walls
 * of a slab need them: a slanted wall is thin triangles side by side, and with
 * three axes 10 000 of them have 1.2 million overlapping boxes (27 ms against
 * 15).  Values are taken from the mesh's low corner and scaled by a power of
 * two, else single precision would make one box of all that lies far from the
 * origin or is tiny.  Each step rounds monotonely: an interval that holds a
 * point's exact value holds the rounded one, so boxes that overlap in truth
 * overlap here. */
enum { N_AXES = 9, LEAF_SIZE = 4 };

/* hub: see Search; NO_HUB behind the last.  group: of all that is inside, or
 * MIXED; two triangles of one group are not compared. */
const uint32_t NO_HUB = UINT32_MAX, MIXED = UINT32_MAX;

struct Box {
    float lo[N_AXES], hi[N_AXES];
    uint32_t hub[3], group;
    bool touched;
};

/* A triangle with an area.  id: its vertices, equal when their positions are.
 * normal, doubt: see side(). */
struct Facet {
    Box box;
    double normal[3], doubt;
    const double *v[3];
    uint32_t id[3], index;
};

/* ---- signs ---------------------------------------------------------------- */

Kernel::Point_3 point(const double *p)
{
    return Kernel::Point_3(p[0], p[1], p[2]);
}

int orient(const double *a, const double *b, const double *c, const double *d)
{
    return int(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

/* Orientation of abc seen along the axis that is neither X nor Y. */
int orient_plan(const double *a, const double *b, const double *c, int x, int y)
{
    return int(CGAL::orientation(Kernel::Point_2(a[x], a[y]), Kernel::Point_2(b[x], b[y]),
                                 Kernel::Point_2(c[x], c[y])));
}

/* o(f, p), first by the normal computed once.  With u = 2^-53 every term of
 * n . (p - v0) passes through at most 8 roundings (difference, difference,
 * product, sum in n; difference, product, two sums), so the error is below
 * 8.1 u times the sum of the terms' absolute values; doubt is 16 u times that
 * sum with the extent of the whole mesh for p - v0, plus what underflow loses. */
int side(const Facet &f, const double *p)
{
    double d = f.normal[0] * (p[0] - f.v[0][0]) + f.normal[1] * (p[1] - f.v[0][1])
             + f.normal[2] * (p[2] - f.v[0][2]);
    if (d > f.doubt)
        return 1;
    if (d < -f.doubt)
        return -1;
    return orient(f.v[0], f.v[1], f.v[2], p);
}

bool one_sided(int s, int t)
{
    return s * t > 0;
}

bool one_sided(const int s[3])
{
    return one_sided(s[0], s[1]) && one_sided(s[1], s[2]);
}

/* Do these signs contradict each other as "the point is to the left of each edge"? */
bool mixed(int a, int b, int c)
{
    return (a > 0 || b > 0 || c > 0) && (a < 0 || b < 0 || c < 0);
}

/* Does the segment AB meet the closed triangle T?  SA, SB: the sides of T on
 * which its ends lie, not both 0.  Then the line AB has one point x in T's
 * plane, in the segment unless both ends are strictly on one side, and
 * o(a, b, p, q) is the signed area of x p q in the plane times a factor whose
 * sign is common to the three edges p q of T. */
bool segment_meets(const double *a, const double *b, int sa, int sb, const Facet &t)
{
    if (one_sided(sa, sb))
        return false;
    int s0 = orient(a, b, t.v[0], t.v[1]), s1 = orient(a, b, t.v[1], t.v[2]);
    return !one_sided(s0, -s1) && !mixed(s0, s1, orient(a, b, t.v[2], t.v[0]));
}

/* ---- one plane -------------------------------------------------------------- */

/* Two axes on which F, which has an area, does not collapse; swapped if need be
 * so that F runs counter-clockwise there. */
struct Plan {
    int x, y;
    explicit Plan(const Facet &f)
    {
        for (x = 0, y = 1; x < 2; x++, y = (x + 1) % 3)
            if (orient_plan(f.v[0], f.v[1], f.v[2], x, y) != 0)
                break;
        if (orient_plan(f.v[0], f.v[1], f.v[2], x, y) < 0)
            std::swap(x, y);
    }
    int left(const double *a, const double *b, const double *c) const
    {
        return orient_plan(a, b, c, x, y);
    }
};

/* Is all of T strictly to the right of an edge of S, which turns by SIGN? */
bool edge_separates(const Plan &plan, const Facet &s, int sign, const Facet &t)
{
    for (int i = 0; i < 3; i++) {
        const double *a = s.v[i], *b = s.v[(i + 1) % 3];
        if (plan.left(a, b, t.v[0]) == -sign && plan.left(a, b, t.v[1]) == -sign
            && plan.left(a, b, t.v[2]) == -sign)
            return true;
    }
    return false;
}

/* Coplanar, no vertex shared.  Two convex polygons are disjoint if and only if
 * the line of an edge of one of them has the other strictly beyond it: their
 * Minkowski difference is a polygon with edges parallel to theirs, and the
 * origin is either in it or strictly outside of one of its edges. */
bool meet_in_plane(const Facet &s, const Facet &t)
{
    Plan plan(s);
    return !edge_separates(plan, s, 1, t)
        && !edge_separates(plan, t, plan.left(t.v[0], t.v[1], t.v[2]), s);
}

/* Is the direction from V to P in the closed cone spanned by VA and VB (less
 * than half a turn, SIGN: its turn)? */
bool in_cone(const Plan &plan, const double *v, const double *a, const double *b, int sign, const double *p)
{
    return plan.left(v, a, p) != -sign && plan.left(v, p, b) != -sign;
}

/* Coplanar, VAB and VCD share V alone.  At V the triangles are their cones, and
 * two convex cones that share more than their apex share a bounding ray. */
bool cones_meet(const Facet &s, const double *v, const double *a, const double *b, const double *c, const double *d)
{
    Plan plan(s);
    int first = plan.left(v, a, b), second = plan.left(v, c, d);
    return in_cone(plan, v, a, b, first, c) || in_cone(plan, v, a, b, first, d)
        || in_cone(plan, v, c, d, second, a) || in_cone(plan, v, c, d, second, b);
}

/* ---- two triangles ---------------------------------------------------------- */

/* They share no vertex: do they share a point?  In different planes what they
 * share lies on the planes' common line: the overlap of two intervals, one a
 * triangle, of which every end is an end of one of the two.  Each end is where
 * an edge that does not lie in the other plane meets that plane (an edge that
 * does lie in it ends in such edges).  So some such edge meets the other
 * triangle. */
bool meet_apart(const Facet &s, const Facet &t)
{
    int on_s[3], on_t[3];
    for (int i = 0; i < 3; i++)
        on_s[i] = side(s, t.v[i]);
    if (one_sided(on_s))
        return false;
    for (int i = 0; i < 3; i++)
        on_t[i] = side(t, s.v[i]);
    if (one_sided(on_t))
        return false;
    if (!on_s[0] && !on_s[1] && !on_s[2])
        return meet_in_plane(s, t);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if ((on_s[i] || on_s[j]) && segment_meets(t.v[i], t.v[j], on_s[i], on_s[j], s))
            return true;
        if ((on_t[i] || on_t[j]) && segment_meets(s.v[i], s.v[j], on_t[i], on_t[j], t))
            return true;
    }
    return false;
}

/* They share the vertex I of S = vab, J of T = vcd, and no other: do they share
 * another point x?  The ray from v through x leaves S on ab and T on cd; the
 * nearer of these places is in both.  So: ab meets T or cd meets S.  In
 * different planes that is segment_meets(), where
 *     o(a,b, v,c) =  o(v,a,b, c),  o(a,b, d,v) = -o(v,a,b, d)
 * are known already, and o(a,b, c,d) = o(c,d, a,b) serves both ways. */
bool meet_at_vertex(const Facet &s, int i, const Facet &t, int j)
{
    const double *v = s.v[i], *a = s.v[(i + 1) % 3], *b = s.v[(i + 2) % 3];
    const double *c = t.v[(j + 1) % 3], *d = t.v[(j + 2) % 3];
    int sc = side(s, c), sd = side(s, d);
    if (one_sided(sc, sd))
        return false;
    int sa = side(t, a), sb = side(t, b);
    if (one_sided(sa, sb))
        return false;
    if (sa == 0 && sb == 0)
        return cones_meet(s, v, a, b, c, d);
    int w = orient(a, b, c, d);
    return !mixed(sc, w, -sd) || !mixed(sa, w, -sb);
}

/* They share an edge; A of S and B of T are opposite.  In different planes they
 * share no more, since the planes share the edge's line alone.  In one plane
 * they do if A and B are on one side of the edge PQ. */
bool meet_at_edge(const Facet &s, const double *p, const double *q, const double *a, const double *b)
{
    if (side(s, b) != 0)
        return false;
    Plan plan(s);
    return plan.left(p, q, a) == plan.left(p, q, b);
}

/* Do S and T, which both have an area, meet in more than what they share? */
bool meet(const Facet &s, const Facet &t)
{
    int n = 0, i_of[3] = { 0, 0, 0 }, j_of[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (s.id[i] == t.id[j]) {
                i_of[n] = i;
                j_of[n] = j;
                n++; /* ids within a triangle differ: at most 3 */
            }
    if (n == 0)
        return meet_apart(s, t);
    if (n == 1)
        return meet_at_vertex(s, i_of[0], t, j_of[0]);
    return n == 3 || meet_at_edge(s, s.v[i_of[0]], s.v[i_of[1]],
                                  s.v[3 - i_of[0] - i_of[1]], t.v[3 - j_of[0] - j_of[1]]);
}

} // namespace

#endif
