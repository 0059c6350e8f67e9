/* mesh-parts.h - what the mesh readers share; for them alone. */
#ifndef IL_INPUT_MESH_PARTS_H
#define IL_INPUT_MESH_PARTS_H

#include "base/source.h"
#include "input/mesh-file.h"
#include "model/mesh.h"

#include <stdbool.h>
#include <stdint.h>

/* ---- words: text as blank-separated words that know their line ---------------- */

typedef struct il_words {
    il_lines lines;
    const char *at, *end;       /* what is left of the current line */
} il_words;

/* A word; n is 0 at the end of the input.  Good until the next call. */
typedef struct il_word { const char *s; size_t n; } il_word;

void il_words_init(il_words *w, il_source *source);
void il_words_free(il_words *w);
il_status il_words_next(il_words *w, il_word *word, il_error *err);
/* The next word of the current line; n is 0 at its end. */
il_word il_words_in_line(il_words *w);
/* Go on to the next line; *MORE is false when there is none. */
il_status il_words_next_line(il_words *w, bool *more, il_error *err);
bool il_word_is(il_word word, const char *s);           /* without regard to case */
/* printf arguments for "%.*s": the word, or what is worth showing of it. */
#define IL_WORD_SHOWN(w) (int)((w).n < 40 ? (w).n : 40), (w).s

/* The word as a finite number below 1e15 in magnitude. */
bool il_word_number(il_word word, double *value);
il_status il_fail_number(il_word word, long line, il_error *err);

/* ---- bytes: fixed-size records ------------------------------------------------- */

typedef struct il_bytes {
    il_source *source;
    unsigned char *buf;
    size_t cap, begin, end;
    uint64_t offset;            /* of the next byte in the file */
} il_bytes;

/* OFFSET: where in the file the reading starts; REST: N bytes already taken
 * from SOURCE that come first. */
il_status il_bytes_init(il_bytes *b, il_source *source, uint64_t offset, const void *rest, size_t n, il_error *err);
void il_bytes_free(il_bytes *b);
/* N bytes (at most 256) at *P, or *P null when fewer are left. */
il_status il_bytes_take(il_bytes *b, size_t n, const unsigned char **p, il_error *err);

uint32_t il_u32le_at(const unsigned char *p);
double il_f32le_at(const unsigned char *p);

/* ---- meshes --------------------------------------------------------------------- */

bool il_coordinate_fits(double c);
il_status il_mesh_file_add_vertex(il_mesh *m, const double xyz[3], il_error *err);

/* A face of any number of corners, given one by one. */
typedef struct il_fan { uint32_t first, last; size_t n; } il_fan;
il_status il_fan_add(il_fan *f, uint32_t corner, il_mesh *m, il_error *err);

bool il_mesh_obj_starts(const unsigned char *head, size_t n);

il_status il_mesh_read_stl(il_source *source, il_mesh *out, il_error *err);
il_status il_mesh_read_stl_ascii(il_source *source, il_mesh *out, il_error *err);
il_status il_mesh_read_obj(il_source *source, il_mesh *out, size_t *polygons, il_error *err);
il_status il_mesh_read_ply(il_source *source, il_mesh *out, size_t *polygons, il_error *err);

#endif
