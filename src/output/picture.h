/* picture.h - contours and correspondences as SVG, for people to look at.
 *
 * Four pictures: one pair of slices with its deformation (the paper's Figures 4b
 * and 5), all slices side by side, all pairs as small multiples, and the skeleton
 * of the stack (Figure 4a). */
#ifndef IL_OUTPUT_PICTURE_H
#define IL_OUTPUT_PICTURE_H

#include "output/writer.h"

/* Takes contours as they are in the stream, cleaned or not, through picture_new:
 * one figure a stack, one under another.  It holds one stack, and for a single
 * pair two slices.  At the end IL_E_USAGE when no stack has the pair that is
 * asked for, IL_E_INPUT when there is nothing to draw. */
extern const il_writer il_writer_picture;

#endif
