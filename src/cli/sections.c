#include "config.h"
#include "cli/sections.h"

void il_sections_slice(il_sections *s, const il_slice *slice, bool counts)
{
    double area = il_slice_area(slice);
    s->trapezoids += s->pending;
    s->pending = s->n > 0 ? (area + s->area) / 2 * (slice->z - s->z) : 0;
    s->areas += counts ? area : 0;
    s->area = area;
    s->z = slice->z;
    s->n++;
}

void il_sections_pair(il_sections *s, const il_pair *pair)
{
    if (pair->gap)
        s->pending = 0;
}

double il_sections_trapezoids(const il_sections *s)
{
    return s->trapezoids + s->pending;
}
