/* predicates.cpp - bridge/predicates.h on CGAL's filtered kernel. */
#include "config.h"
#include "bridge/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;

int il_orientation(const double a[2], const double b[2], const double c[2])
{
    return CGAL::orientation(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]), Kernel::Point_2(c[0], c[1]));
}
