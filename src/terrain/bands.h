/* bands.h - which band of heights each face of the map lies in (design 7).
 *
 * The lines and the frame divide the map into faces.  Crossing a line of level i goes from
 * the band below it to the band above, or back.  A face that lines of two levels bound is
 * settled by them; one that a single level bounds takes the other side of what its line's
 * far face has.  So peaks, pits and saddles are told apart without believing in the
 * directions of lines. */
#ifndef IL_TERRAIN_BANDS_H
#define IL_TERRAIN_BANDS_H

#include "base/status.h"
#include "model/stack.h"

/* Where line LINE, of level LEVEL, parts face[0] on its left from face[1] on its right,
 * along LENGTH of it (unit).  A line that ends inside the map has one face on both sides.
 * AT: a point of that stretch. */
typedef struct il_border {
    uint32_t face[2], line;
    int32_t level;
    double length, at[2];
} il_border;

/* The levels next below and above a face: -1 below all, N_LEVELS above all, both for a face
 * without lines.  More than one apart: the lines between are missing (terrain/missing.h).
 * Lines of a level strictly between may bound it all the same: parts of that level are there
 * (a sea that six islands rise from and, without its lowest line, a seventh). */
typedef struct il_band { int32_t low, high; } il_band;

/* What does not go together.  SIDES: both sides of line[0] lie on the same side of it
 * (below it if is_below), as line[1], of another level on one of its faces, has it: left
 * out.  MISSING: a line is missing between line[0] and line[1], which bound one face.
 * MANY: a third level, that of line[1], bounds a face between line[0]'s and another (that
 * face has a MISSING as well).  AT: a place of line[0].  line[1]: UINT32_MAX when no other
 * is to blame, as for a line that ends inside the map. */
typedef enum il_discord_kind { IL_DISCORD_SIDES, IL_DISCORD_MISSING, IL_DISCORD_MANY } il_discord_kind;
typedef struct il_discord {
    il_discord_kind kind;
    uint32_t line[2];
    double at[2];
    bool is_below;
} il_discord;

/* band[n_faces].  discord[n]: in the order of their lines.  left_out[n_lines]: lines that
 * contradict the others; where there are any, bands hold without them. */
typedef struct il_bands {
    il_band *band;
    il_discord *discord;    size_t n_discords, cap_discords;
    unsigned char *left_out;
    size_t n_left_out;
} il_bands;

#define IL_BANDS_INIT { 0 }
void il_bands_free(il_bands *b); /* safe twice */

/* Label N_FACES faces by border[n]; lines count from 0 to n_lines - 1, levels to n_levels - 1.
 * HIGH: the side of higher ground, which decides where all lines are of one level only;
 * else the lines' own directions are no guide.  Lines of a single level without HIGH:
 * IL_E_INPUT.  Where lines contradict one another, those are left out, or lines taken for
 * missing, that leave the fewest contradictions (bands-blame.h).  Does not depend on the order
 * of the borders.  O(n log n) but for contradictions, which have a limit: beyond it all that
 * goes wrong is left out without trials, and IL_E_INPUT if that does not help. */
il_status il_bands_label(il_bands *out, const il_border *border, size_t n, size_t n_faces, size_t n_lines,
                         size_t n_levels, il_side high, il_error *err);

#endif
