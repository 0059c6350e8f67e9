/* isoloft.h - stacks of planar contours in, closed and certified triangle meshes out;
 * maps of isolines in, certified surfaces out, open at the frame or closed.
 *
 * One function, il_loft, does what the program does: it takes contours from
 * files, from the bytes of a file or from arrays, makes them clean, finds what
 * corresponds, builds the surface slab by slab, and gives it out only when every
 * slab has its certificate: closed, oriented, no two triangles intersecting,
 * every contour vertex kept bit for bit.
 *
 *     double square[] = { 0,0, 9,0, 9,9, 0,9 }, smaller[] = { 2,2, 7,2, 7,7, 2,7 };
 *     il_contour c[] = { { 0, square, 4, 1 }, { 5, smaller, 4, 1 } };
 *     il_from from = { .contour = c, .n_contours = 2 };
 *     il_to to = { .path = "frustum.stl" };
 *     il_error err = IL_ERROR_INIT;
 *     if (il_loft(&from, &to, NULL, &err) != IL_OK) puts(err.text);
 *
 * Build with `pkg-config --cflags --libs isoloft`.  The library prints nothing, keeps
 * nothing between calls and never ends the process; calls at the same time are
 * safe.  It starts threads only while il_loft runs.  GPL-3.0-or-later. */
#ifndef ISOLOFT_H
#define ISOLOFT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what went wrong ------------------------------------------------------ */

/* Also the exit codes of the program. */
typedef enum il_status {
    IL_OK         = 0,
    IL_E_UNSOUND  = 1,  /* the program's `check` only: readable, but not sound */
    IL_E_USAGE    = 2,  /* the call or the command line asks for what there is not */
    IL_E_INPUT    = 3,  /* the input is not what its format allows */
    IL_E_IO       = 4,  /* the system could not read or write */
    IL_E_NOMEM    = 5,
    IL_E_SURFACE  = 6,  /* no surface passes the certificate */
    IL_E_INTERNAL = 70  /* a bug of ours */
} il_status;

/* file: as the caller named it, "" when unknown.  line: from 1, 0 when unknown.
 * path: where a format has no lines that help (JSON, XML), else "".
 * text: one sentence without a full stop.  All of it is printable UTF-8. */
typedef struct il_error {
    il_status code;
    char file[256];
    long line;
    char path[128];
    char text[400];
} il_error;

#define IL_ERROR_INIT { IL_OK, "", 0, "", "" }

/* The whole message, "FILE:LINE: TEXT" with the parts that are known, into
 * TO[SIZE]; always terminated. */
void il_error_message(const il_error *err, char *to, size_t size);

/* ---- contours in ---------------------------------------------------------- */

/* A closed polygon in the plane Z: xy[2*n] holds x0 y0 x1 y1 ..., the first
 * vertex is not repeated at the end.  Finite and below 1e15.  Direction is
 * free: where contours of a plane lie in one another, every second is a hole.
 * stack: contours of one number belong to one solid; a number other than 0 is
 * written where the format has room for it. */
typedef struct il_contour {
    double z;
    const double *xy;
    size_t n;
    long stack;
} il_contour;

/* Where contours come from: one of the three, the others 0.  Borrowed.
 * path[n_paths]: files, read as one set; "-" is standard input; may be gzip.
 * data[size]: the bytes of one file.
 * contour[n_contours]: polygons in any order.
 * format: of files and bytes, as after the program's -f; null: by the first
 * bytes.  unit: what the numbers mean ("mm", "m", "in", ...); null: what the
 * format says, and mm for arrays.  spacing: distance of slices whose format
 * gives them no height, 0 when they have one. */
typedef struct il_from {
    const char *const *path;
    size_t n_paths;
    const void *data;
    size_t size;
    const il_contour *contour;
    size_t n_contours;
    const char *format;
    const char *unit;
    double spacing;
} il_from;

/* ---- solids out ----------------------------------------------------------- */

/* The mesh of one stack: closed, or that of a map if is_open, which ends at the map's
 * frame and has neither volume nor genus (0).  name: UTF-8, "" when it has none.
 * xyz[3*n_vertices], of structure sets in patient coordinates (LPS);
 * triangle[3*n_triangles] counts vertices from 0, outward
 * normals by the right-hand rule.  contour_vertex[n_vertices]: 1 where the
 * vertex is one of the contours', 0 where isoloft inserted it.  volume, area in
 * the unit cubed and squared; genus: handles and tunnels of all components.
 * offset, scale: a vertex v of a map's mesh lies at v * scale + offset on the map, each
 * coordinate by itself; 0 and 1 where nothing was moved. */
typedef struct il_solid {
    char *name;
    double *xyz;
    unsigned char *contour_vertex;
    size_t n_vertices;
    uint32_t *triangle;
    size_t n_triangles;
    long components, genus;
    double volume, area;
    int is_open;
    double offset[3], scale[3];
} il_solid;

typedef struct il_solids {
    il_solid *solid;
    size_t n;
} il_solids;

#define IL_SOLIDS_INIT { NULL, 0 }

/* Frees what il_loft has put there; leaves IL_SOLIDS_INIT; safe twice. */
void il_solids_free(il_solids *s);

/* The bytes of a mesh file; free with il_blob_free, which leaves IL_BLOB_INIT
 * and is safe twice. */
typedef struct il_blob {
    void *data;
    size_t size;
} il_blob;

#define IL_BLOB_INIT { NULL, 0 }
void il_blob_free(il_blob *b);

/* Where the mesh goes: one of the three, the others null.
 * path: a file; it appears whole or not at all, and an older one stays as it
 * was when something fails.  "-" is standard output.
 * bytes: a file in memory.  solids: arrays, one mesh a stack.
 * format: of file and bytes, as after the program's -t; null: by the path's
 * extension, else binary STL, which holds 32-bit floats: contours are rounded to
 * them first, so that what is certified is what is written. */
typedef struct il_to {
    const char *path;
    il_blob *bytes;
    il_solids *solids;
    const char *format;
} il_to;

/* ---- the work ------------------------------------------------------------- */

/* What becomes of neighbouring slices more than 2.5 times as far apart as is usual
 * in their stack.  AS_GIVEN: what the input says (the native format can say that
 * nothing joins two slices); structure sets: CAP.  BRIDGE: they are joined.  CAP:
 * the solid is closed on either side.  FAIL: it is refused. */
typedef enum il_gap_mode {
    IL_GAPS_AS_GIVEN = 0,
    IL_GAPS_BRIDGE   = 1,
    IL_GAPS_CAP      = 2,
    IL_GAPS_FAIL     = 3
} il_gap_mode;

/* Which rings of neighbouring slices belong together, and so into how many pieces a solid comes
 * out.  Rings that overlap always do.  USUAL: across gaps, in heights of the slab, what joins two
 * parts that nothing else in the whole stack holds together, up to 0.75.  FEW: up to 4, for trees of
 * thin vessels.  OVERLAP: never; only then is not the whole stack held in memory at a time. */
typedef enum il_pieces_mode {
    IL_PIECES_USUAL   = 0,
    IL_PIECES_FEW     = 1,
    IL_PIECES_OVERLAP = 2
} il_pieces_mode;

/* How the ground runs between isolines.  MEAN: as a plate that bends between them lets expect, held in its
 * band.  PLATE: as that plate itself, smoother and a little farther off.  STRAIGHT: evenly from line
 * to line. */
typedef enum il_ground_law {
    IL_GROUND_MEAN     = 0,
    IL_GROUND_PLATE    = 1,
    IL_GROUND_STRAIGHT = 2
} il_ground_law;

/* Maps of isolines.  hull: they end at the convex hull of their lines, not at the box.
 * solid: closed with walls and a floor, has_base: at the height base of the map, else a
 * little below the lowest point.  z_scale: heights are exaggerated so many times, 0: not.
 * fit: the longer side of the frame becomes as many mm, 0: nothing is scaled.  recentre:
 * the middle goes to 0, 0 and a solid's floor to z = 0; 0: for STL, as 32-bit floats would
 * cost up to 0.7 m, 1: always, -1: never.  spread, up to 10: how far, in intervals, ground under
 * IL_GROUND_MEAN strays from the plate half a width of a band from its lines, times two; 0: measured
 * from the lines.  detail: how far the mesh may be off the ground between the lines, in intervals;
 * 0: 0.05, below 0: vertices only where it would be flat. */
typedef struct il_map_settings {
    int hull, solid, has_base, recentre;
    double base, z_scale, fit, detail;
    il_ground_law law;
    double spread;
} il_map_settings;

/* All 0 is what the program does without options.  threads: 0 is one a
 * processor; the mesh is the same for any number.  dome: close first and last
 * slice by a dome instead of flat: 1 of half a spacing, 2 of that at most, as the solid leans there.
 * between: contours put between each two slices of a solid, at most 64; 0 as many as it needs, -1
 * none.  unmatched: compare slices
 * as they lie instead of deforming them onto each other.  note: is told, sentence by
 * sentence, what of the input was repaired or skipped; may be null.  The
 * sentence is gone when it returns.  thickness: what a slice that nothing is joined
 * to is given, in the input's unit; 0: the usual spacing for structure sets, and
 * where gaps says what to do, else such a slice is refused.  map: of isolines.  pieces: of no effect with unmatched. */
typedef struct il_settings {
    int threads;
    int dome;
    int between;
    int unmatched;
    void (*note)(void *self, const char *sentence);
    void *note_self;
    il_gap_mode gaps;
    double thickness;
    il_map_settings map;
    il_pieces_mode pieces;
} il_settings;

/* Loft FROM into TO.  SETTINGS may be null, ERR too.  What TO points to must be
 * empty (IL_BLOB_INIT, IL_SOLIDS_INIT) and is empty after failure.
 * IL_E_USAGE: not one of the three sources or targets, an unknown format or
 * unit.  Other codes as above; ERR names file and line where there are any.
 * Time and memory grow linearly with the input. */
il_status il_loft(const il_from *from, const il_to *to, const il_settings *settings, il_error *err);

/* "0.1.0" */
const char *il_version(void);

#ifdef __cplusplus
}
#endif

#endif
