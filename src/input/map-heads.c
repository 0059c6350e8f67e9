#include "config.h"
#include "input/map-heads.h"
#include "base/alloc.h"

#include <string.h>

void il_map_heads_free(il_map_heads *h)
{
    for (size_t k = 0; k < h->n; k++)
        il_free(h->head[k].name);
    il_free(h->head);
    il_free(h->wanted);
    *h = (il_map_heads){ NULL, 0, 0, NULL, 0, 0 };
}

il_status il_map_heads_add(il_map_heads *h, const char *name, size_t n, il_error *err)
{
    char *copy = il_strndup(name, n);
    if (!copy || !il_grow(&h->head, &h->cap, h->n + 1, sizeof *h->head)) {
        il_free(copy);
        return il_fail_nomem(err);
    }
    h->head[h->n++] = (il_map_head){ copy, n, false };
    return IL_OK;
}

static bool is_repeated(const il_map_heads *h, const il_map_head *head)
{
    for (size_t k = 0; k < h->n_wanted; k++) {
        const il_map_head *other = &h->head[h->wanted[k]];
        if (other->n == head->n && memcmp(other->name, head->name, head->n) == 0)
            return true;
    }
    return false;
}

il_status il_map_heads_choose(il_map_heads *h, il_map_set *set, il_error *err)
{
    const char *repeated = NULL;
    for (size_t k = 0; k < h->n && h->n_wanted < IL_MAP_HEADS_MOST; k++) {
        const il_map_head *head = &h->head[k];
        if (head->is_taken || !il_map_wants(set, head->name, head->n))
            continue;
        if (is_repeated(h, head)) {
            repeated = head->name;
            continue;
        }
        if (!il_grow(&h->wanted, &h->cap_wanted, h->n_wanted + 1, sizeof *h->wanted))
            return il_fail_nomem(err);
        h->wanted[h->n_wanted++] = k;
    }
    if (repeated)
        il_report_note(il_map_report(set), "%.200s: '%.40s' names more than one column; the first is read", il_map_file(set), repeated);
    return IL_OK;
}

il_status il_map_heads_tell(const il_map_heads *h, il_map_set *set, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < h->n && st == IL_OK; k++)
        if (!h->head[k].is_taken)
            st = il_map_attribute(set, h->head[k].name, h->head[k].n, NULL, 0, err);
    return st;
}
