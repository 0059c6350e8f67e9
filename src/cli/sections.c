#include "config.h"
#include "cli/sections.h"

void il_sections_slice(il_sections *s, const il_slice *slice)
{
    double area = il_slice_area(slice);
    s->trapezoids += s->pending;
    s->pending = s->n > 0 ? (area + s->area) / 2 * (slice->z - s->z) : 0;
    s->areas += area;
    s->area = area;
    s->z = slice->z;
    s->n++;
}

/* Are the two slices left apart, each closed by a cap?  The one place that
 * decides what the sums leave out. */
static bool is_capped_gap(const il_pair *pair)
{
    (void)pair;
    return false;
}

void il_sections_pair(il_sections *s, const il_pair *pair)
{
    if (is_capped_gap(pair))
        s->pending = 0;
}

double il_sections_trapezoids(const il_sections *s)
{
    return s->trapezoids + s->pending;
}
