#include "config.h"
#include "cli/slicing.h"
#include "base/alloc.h"

il_status il_slicing_slice(il_slicing *h, double z, bool counts, il_error *err)
{
    h->last_counts = counts;
    if (!counts)
        return IL_OK;
    if (!il_grow(&h->z, &h->cap_z, h->n + 1, sizeof *h->z) ||
        !il_grow(&h->gap_below, &h->cap_gap_below, h->n + 1, sizeof *h->gap_below))
        return il_fail_nomem(err);
    h->z[h->n] = z;
    h->gap_below[h->n++] = h->pending;
    h->pending = false;
    return IL_OK;
}

void il_slicing_gap(il_slicing *h)
{
    if (h->last_counts)
        h->gap_below[h->n - 1] = true;
    else
        h->pending = true;
}

void il_slicing_clear(il_slicing *h)
{
    h->n = 0;
    h->last_counts = h->pending = false;
}

void il_slicing_free(il_slicing *h)
{
    il_free(h->z);
    il_free(h->gap_below);
    *h = (il_slicing)IL_SLICING_INIT;
}
