#include "config.h"
#include "input/svg-path.h"

#include <string.h>

enum { MAX_ARGUMENTS = 7 };

/* (x, y): the current point; (start_x, start_y): where the subpath began;
 * (control_x, control_y): the last control point, which S and T mirror when
 * the command before, LAST in lower case, was a curve of their kind. */
typedef struct path {
    il_svg_text *d;
    il_svg_pen *pen;
    double x, y, start_x, start_y, control_x, control_y;
    char last;
} path;

/* How many numbers a command takes, by its lower-case letter; -1: no command. */
static int count_arguments(char c)
{
    switch (c) {
    case 'z':                     return 0;
    case 'h': case 'v':           return 1;
    case 'm': case 'l': case 't': return 2;
    case 's': case 'q':           return 4;
    case 'c':                     return 6;
    case 'a':                     return 7;
    default:                      return -1;
    }
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_letter(char c)
{
    return lower(c) >= 'a' && lower(c) <= 'z';
}

/* A flag of an arc is one digit and needs nothing behind it: "a1 1 0 01.5.5". */
static il_status take_flag(il_svg_text *d, double *value, il_error *err)
{
    il_svg_text_take(d, ',');
    if (!il_svg_text_more(d) || (d->s[d->at] != '0' && d->s[d->at] != '1'))
        return il_svg_text_fail(d, err, "an arc's flag, 0 or 1, is expected");
    *value = d->s[d->at++] - '0';
    return IL_OK;
}

static il_status take_arguments(il_svg_text *d, char command, bool after_letter, double *v, il_error *err)
{
    il_status st = IL_OK;
    for (int i = 0, n = count_arguments(command); i < n && st == IL_OK; i++) {
        if (command == 'a' && (i == 3 || i == 4))
            st = take_flag(d, &v[i], err);
        else if (i == 0 && after_letter)
            st = il_svg_text_number(d, &v[i], err);
        else
            st = il_svg_text_next_number(d, &v[i], err);
    }
    return st;
}

/* Relative arguments made absolute: x and y alternate, but for h, v, and the
 * radii, angle and flags of an arc. */
static void make_absolute(const path *p, char command, double *v)
{
    int n = count_arguments(command), first = command == 'a' ? 5 : 0;
    for (int i = first; i < n; i++) {
        bool is_x = command == 'h' || (command != 'v' && (i - first) % 2 == 0);
        v[i] += is_x ? p->x : p->y;
    }
}

/* The missing first control point of S ("c") and T ("q"). */
static void mirror_control(const path *p, char kind, double to[2])
{
    bool follows = p->last == kind || p->last == (kind == 'c' ? 's' : 't');
    to[0] = follows ? 2 * p->x - p->control_x : p->x;
    to[1] = follows ? 2 * p->y - p->control_y : p->y;
}

static il_status draw_cubic(path *p, const double *v, il_error *err)
{
    p->control_x = v[2];
    p->control_y = v[3];
    return il_svg_pen_cubic(p->pen, v, err);
}

static il_status draw_quadratic(path *p, const double *v, il_error *err)
{
    p->control_x = v[0];
    p->control_y = v[1];
    return il_svg_pen_quadratic(p->pen, v, err);
}

static il_status draw_arc(path *p, const double *v, il_error *err)
{
    il_svg_arc arc = { v[0], v[1], v[2], v[3] != 0, v[4] != 0 };
    return il_svg_pen_arc(p->pen, p->x, p->y, &arc, v[5], v[6], err);
}

static il_status draw_smooth(path *p, char command, const double *v, il_error *err)
{
    double w[6];
    int n = count_arguments(command);
    mirror_control(p, command == 's' ? 'c' : 'q', w);
    memcpy(w + 2, v, (size_t)n * sizeof *v);
    return command == 's' ? draw_cubic(p, w, err) : draw_quadratic(p, w, err);
}

/* One command (lower case) with its absolute arguments; moves the current
 * point to its end. */
static il_status draw_command(path *p, char command, const double *v, il_error *err)
{
    int n = count_arguments(command);
    double x = command == 'v' ? p->x : command == 'h' ? v[0] : n > 1 ? v[n - 2] : p->start_x;
    double y = command == 'h' ? p->y : command == 'v' ? v[0] : n > 1 ? v[n - 1] : p->start_y;
    il_status st = IL_OK;
    switch (command) {
    case 'm': st = il_svg_pen_move(p->pen, x, y, err); p->start_x = x, p->start_y = y; break;
    case 'l': case 'h': case 'v': st = il_svg_pen_line(p->pen, x, y, err); break;
    case 'c': st = draw_cubic(p, v, err); break;
    case 'q': st = draw_quadratic(p, v, err); break;
    case 's': case 't': st = draw_smooth(p, command, v, err); break;
    case 'a': st = draw_arc(p, v, err); break;
    default:  il_svg_pen_close(p->pen); break;
    }
    p->x = x;
    p->y = y;
    p->last = command;
    return st;
}

/* The letter of the next command; without one the last is repeated, a moveto
 * as a lineto. */
static il_status next_command(path *p, char *letter, bool *after_letter, il_error *err)
{
    char c = p->d->s[p->d->at];
    *after_letter = is_letter(c);
    if (*after_letter) {
        if (count_arguments(lower(c)) < 0)
            return il_svg_text_fail(p->d, err, "no path command");
        if (!p->last && lower(c) != 'm')
            return il_svg_text_fail(p->d, err, "path data must begin with M");
        p->d->at++;
        *letter = c;
    } else if (!p->last || p->last == 'z') {
        return il_svg_text_fail(p->d, err, p->last ? "a path command is expected" : "path data must begin with M");
    } else if (p->last == 'm') {
        *letter = *letter == 'm' ? 'l' : 'L';
    }
    return IL_OK;
}

il_status il_svg_path_draw(il_svg_text *d, il_svg_pen *pen, il_error *err)
{
    path p = { d, pen, 0, 0, 0, 0, 0, 0, '\0' };
    char letter = '\0';
    il_status st = IL_OK;
    while (st == IL_OK && il_svg_text_more(d)) {
        double v[MAX_ARGUMENTS] = { 0 };
        bool after_letter;
        st = next_command(&p, &letter, &after_letter, err);
        char command = lower(letter);
        if (st == IL_OK)
            st = take_arguments(d, command, after_letter, v, err);
        if (st != IL_OK)
            break;
        if (letter == command)
            make_absolute(&p, command, v);
        st = draw_command(&p, command, v, err);
    }
    il_svg_pen_end(pen);
    return st;
}
