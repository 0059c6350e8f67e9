/* geographic.h - the ellipsoid of the earth: map projections, lengths and areas
 * (GeographicLib).
 *
 * Points are pairs lon, lat in degrees, east and north positive; longitudes may run
 * beyond 180, so that lines are not torn. */
#ifndef IL_BRIDGE_GEOGRAPHIC_H
#define IL_BRIDGE_GEOGRAPHIC_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* a: equatorial radius, m; f: flattening. */
typedef struct il_ellipsoid { double a, f; } il_ellipsoid;

#define IL_ELLIPSOID_WGS84 { 6378137.0, 1 / 298.257223563 }

/* TM: transverse Mercator on meridian lon0 (L. Krueger, 1912, to the sixth order, which
 * is good to 5 nm within IL_TM_REACH degrees of it; if `far` exactly, by elliptic
 * functions after L. P. Lee, 1976, which take longer).  STEREOGRAPHIC: polar, around the pole that `north` says, with
 * meridian lon0 pointing down from the north pole and up from the south one.
 * Scale k0 on the meridian or at the pole; the origin (lon0, lat0, or the pole) comes
 * to (x0, y0), m. */
enum { IL_TM_REACH = 35 };

typedef enum il_projection_kind { IL_PROJECTION_TM, IL_PROJECTION_STEREOGRAPHIC } il_projection_kind;
typedef struct il_projection {
    il_projection_kind kind;
    il_ellipsoid ellipsoid;
    double lon0, lat0, k0, x0, y0;
    bool north, far;
} il_projection;

/* The N points at XY, in place, in metres.  IL_E_INPUT when one has no finite
 * place, IL_E_NOMEM. */
il_status il_project_points(const il_projection *p, double *xy, size_t n, il_error *err);

/* And back: metres to degrees, in the turn of longitudes around lon0. */
il_status il_unproject_points(const il_projection *p, double *xy, size_t n, il_error *err);

/* Is P, with all but `far` set, to be exact for a map from WEST to EAST? */
bool il_projection_is_far(const il_projection *p, double west, double east);

/* The zone of UTM, 1 to 60 with the exceptions of Norway and Svalbard, that (lon, lat)
 * lies in, 0 beyond 84 north and 80 south, where UPS holds. */
int il_utm_zone(double lon, double lat);

/* Length, m, of the geodesics along the N points; with the one that closes them when
 * CLOSED (C. F. F. Karney, 2013, good to about 15 nm an edge).  And the area that they
 * enclose then, m^2, not negative: of the smaller side of a ring.  NAN when out of
 * memory. */
void il_geodesic_measure(const il_ellipsoid *e, const double *xy, size_t n, bool closed,
                         double *length, double *area);

#ifdef __cplusplus
}
#endif
#endif
