/* stack.h - slices of one solid or terrain, and what is known of the whole. */
#ifndef IL_MODEL_STACK_H
#define IL_MODEL_STACK_H

#include "model/ring.h"
#include "base/status.h"
#include "bridge/geographic.h"

typedef enum il_kind { IL_KIND_SOLID, IL_KIND_TERRAIN } il_kind;

typedef enum il_unit { IL_UNIT_MM, IL_UNIT_CM, IL_UNIT_M, IL_UNIT_KM, IL_UNIT_IN, IL_UNIT_FT,
                       IL_UNIT_UM, IL_UNIT_DEG, IL_N_UNITS } il_unit;

/* On which side of isolines, seen along them, the ground is higher. */
typedef enum il_side { IL_SIDE_UNKNOWN, IL_SIDE_LEFT, IL_SIDE_RIGHT } il_side;

/* How a mesh was moved and scaled: a vertex v of it lies at v * scale + offset on the map,
 * each coordinate by itself, in the map's UNIT. */
typedef struct il_placement { double offset[3], scale[3]; il_unit unit; } il_placement;

const char *il_unit_name(il_unit u);                   /* "mm" ... */
bool il_unit_parse(const char *s, size_t n, il_unit *u);
/* Metres in one of U; 0 for degrees, which are no length. */
double il_unit_metres(il_unit u);

/* "key" "value", in input order; both UTF-8, owned. */
typedef struct il_attribute { char *key, *value; } il_attribute;

/* A point and its height, in the unit of its stack; where it stood in the input: as of
 * rings. */
typedef struct il_spot {
    double x, y, z;
    long line, feature;
    uint32_t file;
} il_spot;

/* What stands before the slices.  name: UTF-8 without NUL, "" when none; crs:
 * text or null.  frame: origin, x axis, y axis, z axis in world coordinates
 * (3 numbers each): a point (x, y, z) of the stack lies at o + x a + y b + z c.
 * fault: why the reader could not make sense of the stack, null when it could;
 * a stack with a fault has no slices.  usual_spacing: of the slices of the set
 * that it came from, 0 when that is not known; for those that have no other.
 * length_scale: what its lengths were multiplied by since they were read, 0 where
 * they were not.  has_geographic: it was in degrees, from west, south, east and
 * north as in geographic, and `projection` made metres of them, which are here in the
 * unit.  has_placement: the mesh made of it is not where its contours are.
 * spot[n_spots]: points of a terrain whose height is known, by x and then y, no two at
 * one place.  file[n_files]: what it was read from, by names that can be shown; rings tell which of
 * them; none where that is not known. */
typedef struct il_stack_head {
    char *name;
    char *crs;
    bool has_number, has_color, has_frame;
    long number;
    unsigned char color[3];
    il_kind kind;
    il_unit unit;
    double frame[12];
    double usual_spacing, length_scale;
    bool has_geographic;
    il_projection projection;
    double geographic[4];
    bool has_placement;
    il_placement placement;
    char *fault;
    long fault_line;
    il_spot *spot;
    size_t n_spots, cap_spots;
    char **file;
    size_t n_files;
    il_attribute *attribute;
    size_t n_attributes, cap_attributes;
    il_extra *extra;
    long line;
} il_stack_head;

#define IL_STACK_HEAD_INIT { 0 }

void il_stack_head_free(il_stack_head *h);
/* TO is overwritten, whatever it held; empty after failure. */
il_status il_stack_head_copy(il_stack_head *to, const il_stack_head *from, il_error *err);
/* Replace the name by the N bytes at S. */
bool il_stack_head_set_name(il_stack_head *h, const char *s, size_t n);
/* Name the N files of a head that has none; false when there is no memory. */
bool il_stack_head_set_files(il_stack_head *h, const char *const *name, size_t n);
/* A point of the stack in world coordinates, by the frame if there is one; -0 as
 * 0.  TO may be FROM. */
void il_stack_head_place(const il_stack_head *h, const double from[3], double to[3]);
/* Does the frame turn surfaces inside out: are its axes left-handed? */
bool il_stack_head_mirrors(const il_stack_head *h);
/* IL_E_INPUT with its fault's words and line when it has one; whoever makes
 * something of a stack asks first. */
il_status il_stack_head_refuse_fault(const il_stack_head *h, il_error *err);
/* The name, and "" when it has none. */
const char *il_stack_head_name(const il_stack_head *h);

/* The value of the first attribute called KEY, or null. */
const char *il_stack_head_attribute(const il_stack_head *h, const char *key);
/* Append an attribute; false when there is no memory. */
bool il_stack_head_add_attribute(il_stack_head *h, const char *key, const char *value);

/* The attribute that names the directions of world coordinates where they are
 * not those of the format that they came from: "RAS". */
#define IL_ATTRIBUTE_COORDINATES "coordinates"

/* One plane with its rings; z in the stack's unit.  length, area: on the ellipsoid,
 * m and m^2, summed over its lines, the area of what each closed one encloses; 0 when
 * not measured. */
typedef struct il_slice {
    double z;
    il_ring *ring;
    size_t n, cap;
    long line;
    il_extra *extra;
    double length, area;
} il_slice;

#define IL_SLICE_INIT { 0, NULL, 0, 0, 0, NULL, 0, 0 }

void il_slice_free(il_slice *s); /* with its rings; leaves IL_SLICE_INIT */
/* Append an empty ring; null when there is no memory. */
il_ring *il_slice_add_ring(il_slice *s);
/* Area of the region, unit^2: sum of the rings' signed areas (normalised slice). */
double il_slice_area(const il_slice *s);
size_t il_slice_points(const il_slice *s);
/* Are there vertices, all of them marked as inserted?  Such a slice is isoloft's own. */
bool il_slice_is_inserted(const il_slice *s);
/* The same rings in the same order, bit for bit, with the same marks? */
bool il_slice_equal_rings(const il_slice *a, const il_slice *b);
/* TO is overwritten, whatever it held; empty after failure. */
il_status il_slice_copy(il_slice *to, const il_slice *from, il_error *err);

#endif
