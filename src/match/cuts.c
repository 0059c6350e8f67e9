/* cuts.c - the cuts of a divided group, into the record. */
#include "config.h"
#include "match/division.h"
#include "base/alloc.h"

#include <string.h>

/* The line from point FIRST on to where it ends, or round to FIRST again, as a cut of its own;
 * *USED marks its points. */
static bool add_cut(il_pair *pair, bool upper, uint32_t ring, const il_piece *line, size_t first, bool *used)
{
    if (!il_grow(&pair->cut, &pair->cap_cuts, pair->n_cuts + 1, sizeof *pair->cut))
        return false;
    il_cut *c = &pair->cut[pair->n_cuts++];
    *c = (il_cut){ .upper = upper, .ring = ring };
    for (size_t i = first;; i = line->next[i]) {
        if (!il_grow(&c->xy, &c->cap, 2 * (c->n + 1), sizeof *c->xy))
            return false;
        memcpy(c->xy + 2 * c->n++, line->xy + 2 * i, 2 * sizeof *c->xy);
        if (used[i] || line->next[i] == UINT32_MAX)
            break;
        used[i] = true;
    }
    return true;
}

/* Lines of points: first those with ends, then those that run round a cell amidst others. */
static bool add_cuts(il_pair *pair, bool upper, uint32_t ring, const il_piece *line)
{
    bool *has_before = il_calloc(line->n, sizeof *has_before), *used = il_calloc(line->n, sizeof *used);
    bool ok = has_before && used;
    for (size_t k = 0; ok && k < line->n; k++)
        if (line->next[k] != UINT32_MAX)
            has_before[line->next[k]] = true;
    for (int round = 0; round < 2; round++)
        for (size_t k = 0; ok && k < line->n; k++)
            if (!used[k] && line->next[k] != UINT32_MAX && (round == 1 || !has_before[k]))
                ok = add_cut(pair, upper, ring, line, k, used);
    il_free(has_before);
    il_free(used);
    return ok;
}

il_status il_division_record_cuts(il_division *d, il_pair *pair, il_error *err)
{
    il_status st = IL_OK;
    for (int s = 0; s < 2; s++)
        for (size_t i = 0; i < d->n_regions[s]; i++) {
            il_region *r = &d->region[s][i];
            for (size_t k = 0; st == IL_OK && r->cut && k + 1 < r->n_links; k++) {
                il_piece line = { 0 };
                st = il_dissection_cuts(&r->cutting, k, &line, err);
                if (st == IL_OK && !add_cuts(pair, s == 1, r->outer, &line))
                    st = il_fail_nomem(err);
                il_piece_free(&line);
            }
        }
    return st;
}
