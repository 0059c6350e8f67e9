#include "config.h"
#include "input/map-outline.h"
#include "input/map-degrees.h"
#include "input/map-refuse.h"

static void leave_out_points(il_map *m)
{
    for (size_t k = 0; k < m->n_spots; k++)
        il_report_skip(m->report, m->file[m->spot[k].file], m->spot[k].line, "point", "is no outline");
    m->n_spots = 0;
}

/* Numbers are those of the map in whatever unit it has, so they need none here. */
il_status il_map_take_outline(il_map *m, il_error *err)
{
    size_t n = 0;
    for (size_t i = 0; i < m->n_lines; i++) {
        il_map_line *l = &m->line[i];
        l->height = 0;
        if (l->closed)
            n++;
        else
            il_map_drop(m, l, "line", "is not closed: no outline");
    }
    if (n == 0)
        return m->n_lines > 0 ? il_fail(err, IL_E_INPUT, 0, "no line of it is closed, so there is no outline in it")
                              : il_map_refuse_no_lines(m, err);
    leave_out_points(m);
    il_status st = il_map_find_degrees(m, err);
    m->unit = m->degrees ? IL_UNIT_DEG : IL_UNIT_M;
    return st;
}
