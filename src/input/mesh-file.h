/* mesh-file.h - read a mesh file as it is: STL, OBJ, PLY, told apart by content. */
#ifndef IL_INPUT_MESH_FILE_H
#define IL_INPUT_MESH_FILE_H

#include "base/source.h"
#include "model/mesh.h"

#include <stddef.h>

/* What the file says beside the mesh.  format: "stl", "stl-ascii", "obj",
 * "ply", "ply-ascii".  polygons: faces of more than three corners, split into
 * fans from their first corner whatever their shape. */
typedef struct il_mesh_file_facts {
    const char *format;
    size_t polygons;
} il_mesh_file_facts;

#define IL_MESH_FILE_FACTS_INIT { NULL, 0 }

/* The format of SOURCE by its first bytes, none of them taken; *FORMAT is null
 * when it is none of these.  PLY by its first line, OBJ by the first word that
 * is no comment.  STL: a binary one has its triangle count in bytes 80 to 83,
 * and no text has a count there that a file could hold; so a binary file that
 * starts with "solid", as some do, is not mistaken for text.  A binary STL that
 * fits the look-ahead (64 KB) must be as long as its count says. */
il_status il_mesh_file_detect(il_source *source, const char **format, il_error *err);

/* Read all of SOURCE into *OUT (IL_MESH_INIT; emptied on failure; the caller
 * frees it).  Vertices and triangles keep the file's order.  STL has no shared
 * vertices: corners of equal position become one, in order of first appearance.
 * OBJ and PLY keep their vertices apart as the file has them.
 * IL_E_INPUT, with the line or the byte offset: not a mesh file, damaged, cut
 * short, trailed by something else, a coordinate that is not finite or not below
 * 1e15, a corner that names no vertex, no triangle at all, more vertices than
 * 2^32 - 2.  Claimed counts size no allocation. */
il_status il_mesh_file_read(il_source *source, il_mesh *out, il_mesh_file_facts *facts, il_error *err);

#endif
