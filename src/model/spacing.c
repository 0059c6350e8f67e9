#include "config.h"
#include "model/spacing.h"
#include "base/alloc.h"
#include "base/sort.h"

il_status il_spacing_measure(il_spacing *out, const double *z, size_t n, il_error *err)
{
    *out = (il_spacing)IL_SPACING_INIT;
    if (n < 2)
        return IL_OK;
    double *d = il_alloc(n - 1, sizeof *d);
    if (!d)
        return il_fail_nomem(err);
    for (size_t k = 0; k < n - 1; k++)
        d[k] = z[k + 1] - z[k];
    il_sort_doubles(d, n - 1);
    *out = (il_spacing){ d[0], d[(n - 2) / 2], d[n - 2] };
    il_free(d);
    return IL_OK;
}

bool il_spacing_is_gap(const il_spacing *s, double below, double above)
{
    return above - below > IL_GAP_SPACINGS * s->usual;
}
