/* mesh-ply.h - a PLY header as the body's reader needs it. */
#ifndef IL_INPUT_MESH_PLY_H
#define IL_INPUT_MESH_PLY_H

#include "input/mesh-parts.h"

typedef enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_format;

typedef enum ply_type {
    PLY_NONE, PLY_INT8, PLY_UINT8, PLY_INT16, PLY_UINT16, PLY_INT32, PLY_UINT32, PLY_FLOAT32, PLY_FLOAT64
} ply_type;

/* What a property is to us. */
typedef enum ply_role { PLY_IGNORED, PLY_X, PLY_Y, PLY_Z, PLY_CORNERS } ply_role;

/* count_type: PLY_NONE unless it is a list. */
typedef struct ply_property { ply_type type, count_type; ply_role role; } ply_property;

typedef enum ply_kind { PLY_OTHER, PLY_VERTEX, PLY_FACE } ply_kind;

/* property[first .. first + n_properties) of the header; n: rows. */
typedef struct ply_element {
    ply_kind kind;
    uint64_t n;
    size_t first, n_properties;
} ply_element;

/* n_lines, n_bytes: what the header took of the file. */
typedef struct ply_header {
    ply_format format;
    bool has_format, has_vertices, has_faces;
    uint64_t n_vertices;
    ply_element *element;
    size_t n_elements, cap_elements;
    ply_property *property;
    size_t n_properties, cap_properties;
    uint64_t n_bytes;
} ply_header;

/* Read the header up to the end of its last line.  H is to be freed either way. */
il_status il_ply_header_read(ply_header *h, il_words *w, il_error *err);
void il_ply_header_free(ply_header *h);

#endif
