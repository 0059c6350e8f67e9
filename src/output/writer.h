/* writer.h - what isoloft writes: one table entry a format. */
#ifndef IL_OUTPUT_WRITER_H
#define IL_OUTPUT_WRITER_H

#include "base/output.h"
#include "model/mesh.h"
#include "model/sink.h"

/* Pictures: all pairs of each stack, or the slices of one that has none; the
 * slices; the pair above slice PAIR, from 0; what holds together in the stack. */
typedef enum il_picture { IL_PICTURE_AUTO, IL_PICTURE_SLICES, IL_PICTURE_PAIR, IL_PICTURE_SKELETON } il_picture;
typedef struct il_picture_options {
    il_picture what;
    size_t pair;
} il_picture_options;

/* What the writers are told.  comment: lines for headers that have room
 * (null-terminated list, borrowed, made printable there; or null).
 * groups_by_slab: OBJ begins a group with each slab, not only with each stack.
 * picture: what a picture shows. */
typedef struct il_write_options {
    const char *const *comment;
    bool groups_by_slab;
    il_picture_options picture;
} il_write_options;

/* name: as after -t.  extension: the one that chooses it, or "" when another
 * entry has it.  One of mesh_new, contours_new and picture_new is set: what it
 * takes; contours_free frees the sinks of the last two.
 * mesh_new: a mesh sink that spools and writes to TO (borrowed) at `finish`;
 * nothing reaches TO before.  The caller commits TO, and with it the MTL that
 * OBJ puts beside a regular file.  Positions come in the stack's coordinates;
 * the writer takes them to the world's by the head's frame, and turns the
 * triangles where that frame is left-handed.  -0 is written 0.  Options may be
 * null.  round_float: it holds 32-bit floats only. */
typedef struct il_writer {
    const char *name, *extension, *words;
    bool binary, round_float;
    il_status (*mesh_new)(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err);
    void (*mesh_free)(il_mesh_sink *s);
    il_status (*contours_new)(il_sink **out, il_output *to, il_error *err);
    il_status (*picture_new)(il_sink **out, il_output *to, const il_write_options *o, il_error *err);
    void (*contours_free)(il_sink *s);
} il_writer;

extern const il_writer *const il_writers[];                 /* null-terminated */
const il_writer *il_writer_named(const char *name);         /* null when unknown */
const il_writer *il_writer_for_path(const char *path);      /* by extension, null when unknown */

extern const il_writer il_writer_stl, il_writer_stl_ascii, il_writer_obj, il_writer_ply,
                       il_writer_ply_ascii, il_writer_loft;

#endif
