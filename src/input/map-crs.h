/* map-crs.h - what the words for a coordinate system say of its numbers.
 *
 * isoloft holds no table of coordinate systems: it must know only whether numbers are
 * degrees, on which ellipsoid, or what length they are.  The rest is carried as text. */
#ifndef IL_INPUT_MAP_CRS_H
#define IL_INPUT_MAP_CRS_H

#include "bridge/geographic.h"
#include "model/stack.h"

/* GEOGRAPHIC: longitudes and latitudes in degrees.  PROJECTED: lengths in a plane.
 * LOCAL: lengths of no place on earth.  UNKNOWN: the words do not tell. */
typedef enum il_crs_kind { IL_CRS_UNKNOWN, IL_CRS_GEOGRAPHIC, IL_CRS_PROJECTED, IL_CRS_LOCAL } il_crs_kind;

/* unit: of x and y, where it is said, and z_unit of heights; us_foot: the unit is the
 * U.S. survey foot, which is taken for the foot (2 millionths less).  odd_unit: it is
 * one that isoloft has no name for.  ellipsoid: where it is said, else WGS 84.
 * epsg: 0 when not said.  down: the vertical axis points down.  origin: of a plane, the
 * longitude and latitude of its origin, degrees, and where that lies in it, in its unit;
 * NAN where it is not said. */
typedef struct il_crs {
    il_crs_kind kind;
    bool has_unit, has_z_unit, us_foot, odd_unit, has_ellipsoid, down;
    il_unit unit, z_unit;
    il_ellipsoid ellipsoid;
    long epsg;
    double origin[4];
} il_crs;

/* Read TEXT, null for none: "EPSG:n" and the URN and URL forms of it, CRS84, WKT of
 * both generations, PROJ strings.  Words that mean nothing here give UNKNOWN. */
void il_crs_parse(const char *text, il_crs *out);

/* TEXT in its short form where it has one, "EPSG:26915" for the URN and URL forms, in
 * TO[SIZE]; TEXT itself when it has none. */
const char *il_crs_short(const char *text, char *to, size_t size);

/* May X and Y be said by two files of one map?  Different words may mean the same, so
 * only what both say counts. */
bool il_crs_agree(const il_crs *x, const il_crs *y);

#endif
