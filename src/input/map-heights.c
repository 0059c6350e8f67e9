#include "config.h"
#include "input/map-heights.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static const char *const usual[] = { "elev", "elevation", "ele", "height", "contour", "level", "z", "alt", "hoogte", "depth" };

bool il_map_heights_wants(const il_read_options *o, const char *name, size_t n)
{
    (void)o;
    for (size_t k = 0; k < sizeof usual / sizeof *usual; k++)
        if (strlen(usual[k]) == n && strncasecmp(usual[k], name, n) == 0)
            return true;
    return false;
}

il_status il_map_find_heights(il_map *m, il_error *err)
{
    (void)err;
    for (size_t i = 0; i < m->n_lines; i++) {
        il_map_line *l = &m->line[i];
        for (size_t k = 0; k < m->n_columns && isnan(l->height); k++)
            if (l->feature < m->column[k].n && m->column[k].wanted)
                l->height = m->column[k].value[l->feature];
        if (isnan(l->height) && l->n_z == l->n && l->z_low == l->z_high)
            l->height = l->z_low;
        if (isnan(l->height))
            il_map_drop(m, l, "line", "has no height");
    }
    return IL_OK;
}
