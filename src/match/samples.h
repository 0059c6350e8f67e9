/* samples.h - contours as points at even spacing, as the solver sees them. */
#ifndef IL_MATCH_SAMPLES_H
#define IL_MATCH_SAMPLES_H

#include "base/status.h"
#include "match/ffd.h"

/* Sample k lies at (x, y)[k] with the outward unit normal (nx, ny)[k]; before[k]
 * and after[k] are its neighbours on the ring.  Behind the last there are
 * IL_LANES more, far away and without a normal, for whoever goes by lanes.
 * Cells.  Who returns a status has no other failure than IL_E_NOMEM, after which
 * S is only good to be filled again or freed. */
typedef struct il_samples {
    float *x, *y, *nx, *ny;
    uint32_t *before, *after;
    size_t n, cap_x, cap_y, cap_nx, cap_ny, cap_before, cap_after;
} il_samples;

#define IL_SAMPLES_INIT { 0 }
void il_samples_free(il_samples *s);

/* Resample every ring of O at equal arcs of about SPACING cells, at least
 * IL_SAMPLES_LEAST a ring, from its first vertex on.  S keeps its memory. */
enum { IL_SAMPLES_LEAST = 8 };
il_status il_samples_take(il_samples *s, const il_outline *o, double spacing, il_error *err);

/* The same samples at the same places; S keeps its memory, and has no normals. */
il_status il_samples_copy(il_samples *s, const il_samples *from, il_error *err);

/* Every STRIDE-th sample of each ring of FROM, but at least IL_SAMPLES_LEAST;
 * from_at[k] (grown) says which. */
il_status il_samples_thin(il_samples *s, uint32_t **from_at, size_t *cap_from_at, const il_samples *from,
                          uint32_t stride, il_error *err);

/* Positions anew from FROM, of which S was thinned. */
void il_samples_follow(il_samples *s, const uint32_t *from_at, const il_samples *from);

/* Normals anew from the neighbours' positions. */
void il_samples_set_normals(il_samples *s);

#endif
