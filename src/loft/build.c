#include "config.h"
#include "loft/build.h"
#include "base/alloc.h"

#include <string.h>

il_status il_build_surface(il_surface *out, il_overlay *o, const il_build_options *options, il_error *err)
{
    il_builder b = { o, { o->reference->section[0], o->reference->section[1] }, *options, out, { NULL, NULL } };
    il_status st = IL_OK;
    for (int k = 0; k < 2; k++) {
        b.inserted[k] = il_alloc(o->n_contour, sizeof *b.inserted[k]);
        if (!b.inserted[k])
            st = il_fail_nomem(err);
        else
            memset(b.inserted[k], 0xFF, o->n_contour * sizeof *b.inserted[k]);
    }
    if (st == IL_OK)
        st = il_build_sheets(&b, err);
    if (st == IL_OK)
        st = il_build_walls(&b, err);
    il_free(b.inserted[0]);
    il_free(b.inserted[1]);
    if (st != IL_OK)
        il_surface_free(out);
    return st;
}
