/* predicates.cpp - bridge/predicates.h on CGAL's filtered kernel. */
#include "config.h"
#include "bridge/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;

int il_orientation(const double a[2], const double b[2], const double c[2])
{
    return CGAL::orientation(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]), Kernel::Point_2(c[0], c[1]));
}

int il_in_circle(const double a[2], const double b[2], const double c[2], const double d[2])
{
    return CGAL::side_of_oriented_circle(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]), Kernel::Point_2(c[0], c[1]),
                                         Kernel::Point_2(d[0], d[1]));
}
