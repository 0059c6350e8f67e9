#include "config.h"
#include "bridge/geographic.h"
#include "bridge/guard.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/TransverseMercatorExact.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include <cmath>

using namespace GeographicLib;

template <class TM> static void forward(const TM &tm, const il_projection *p, double *xy, size_t n)
{
    double x0, y0;
    tm.Forward(p->lon0, p->lat0, p->lon0, x0, y0);
    for (size_t i = 0; i < n; i++) {
        double x, y;
        tm.Forward(p->lon0, xy[2 * i + 1], xy[2 * i], x, y);
        xy[2 * i] = x + p->x0;
        xy[2 * i + 1] = y - y0 + p->y0;
    }
}

/* Longitudes come back between -180 and 180, and are brought next to lon0. */
template <class TM> static void reverse(const TM &tm, const il_projection *p, double *xy, size_t n)
{
    double x0, y0;
    tm.Forward(p->lon0, p->lat0, p->lon0, x0, y0);
    for (size_t i = 0; i < n; i++) {
        double lat, lon;
        tm.Reverse(0, xy[2 * i] - p->x0, xy[2 * i + 1] - p->y0 + y0, lat, lon);
        xy[2 * i] = lon + p->lon0;
        xy[2 * i + 1] = lat;
    }
}

/* GeographicLib's meridian 0 points down from the north pole and up from the south. */
static void forward_polar(const il_projection *p, double *xy, size_t n)
{
    PolarStereographic ps(p->ellipsoid.a, p->ellipsoid.f, p->k0);
    for (size_t i = 0; i < n; i++) {
        double x, y;
        ps.Forward(p->north, xy[2 * i + 1], xy[2 * i] - p->lon0, x, y);
        xy[2 * i] = x + p->x0;
        xy[2 * i + 1] = y + p->y0;
    }
}

static void reverse_polar(const il_projection *p, double *xy, size_t n)
{
    PolarStereographic ps(p->ellipsoid.a, p->ellipsoid.f, p->k0);
    for (size_t i = 0; i < n; i++) {
        double lat, lon;
        ps.Reverse(p->north, xy[2 * i] - p->x0, xy[2 * i + 1] - p->y0, lat, lon);
        xy[2 * i] = lon + p->lon0;
        xy[2 * i + 1] = lat;
    }
}

static il_status check_finite(const double *xy, size_t n, il_error *err)
{
    for (size_t i = 0; i < 2 * n; i++)
        if (!std::isfinite(xy[i]))
            return il_fail(err, IL_E_INPUT, 0, "a point has no place in the projection");
    return IL_OK;
}

il_status il_project_points(const il_projection *p, double *xy, size_t n, il_error *err)
{
    return guarded(err, [&] {
        const il_ellipsoid &e = p->ellipsoid;
        if (p->kind == IL_PROJECTION_STEREOGRAPHIC)
            forward_polar(p, xy, n);
        else if (p->far)
            forward(TransverseMercatorExact(e.a, e.f, p->k0), p, xy, n);
        else
            forward(TransverseMercator(e.a, e.f, p->k0), p, xy, n);
        return check_finite(xy, n, err);
    });
}

il_status il_unproject_points(const il_projection *p, double *xy, size_t n, il_error *err)
{
    return guarded(err, [&] {
        const il_ellipsoid &e = p->ellipsoid;
        if (p->kind == IL_PROJECTION_STEREOGRAPHIC)
            reverse_polar(p, xy, n);
        else if (p->far)
            reverse(TransverseMercatorExact(e.a, e.f, p->k0), p, xy, n);
        else
            reverse(TransverseMercator(e.a, e.f, p->k0), p, xy, n);
        return check_finite(xy, n, err);
    });
}

bool il_projection_is_far(const il_projection *p, double west, double east)
{
    return p->kind == IL_PROJECTION_TM && std::fmax(east - p->lon0, p->lon0 - west) > IL_TM_REACH && p->ellipsoid.f > 0;
}

int il_utm_zone(double lon, double lat)
{
    try {
        return UTMUPS::StandardZone(lat, lon, UTMUPS::STANDARD);
    } catch (const std::exception &) {
        return 0;
    }
}

void il_geodesic_measure(const il_ellipsoid *e, const double *xy, size_t n, bool closed, double *length, double *area)
{
    *length = *area = NAN;
    guarded(NULL, [&] {
        Geodesic g(e->a, e->f);
        PolygonArea polygon(g, !closed);
        for (size_t i = 0; i < n; i++)
            polygon.AddPoint(xy[2 * i + 1], xy[2 * i]);
        double a = 0;
        polygon.Compute(false, true, *length, a);
        *area = closed ? std::fabs(a) : 0;
        return IL_OK;
    });
}
