/* svg-arc.h - what svg-pen.c and svg-arc.c share. */
#ifndef IL_INPUT_SVG_ARC_H
#define IL_INPUT_SVG_ARC_H

#include "input/curve.h"
#include "input/svg-pen.h"

/* User to stack coordinates; IL_E_INPUT when they are beyond the limit. */
il_status il_svg_pen_place(const il_svg_pen *p, double *x, double *y, il_error *err);

/* Draw on to (X, Y), stack coordinates. */
il_status il_svg_pen_put(il_svg_pen *p, double x, double y, il_error *err);

#endif
