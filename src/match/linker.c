#include "config.h"
#include "match/linker.h"
#include "base/alloc.h"
#include "match/given.h"
#include "match/link.h"

#include <stdlib.h>
#include <string.h>

/* slice[n], and the pair of slices k - 1 and k in pair[k], if has_pair[k].  given: null when
 * nothing is said; now: what it says of this stack, or null.  has_come[n_stacks]: which of its
 * stacks have; order[n_stacks]: they by number and name; n_come[n_stacks]: where order[i] is the
 * first of several alike, how many of them have come.  n_begun: stacks so far. */
typedef struct linker {
    il_sink sink;
    il_sink *next;
    il_linkage_options options;
    const il_given *given;
    const il_given_stack *now;
    unsigned char *has_come;
    const il_given_stack **order;
    size_t *n_come;
    size_t n_begun;
    il_report *report;
    bool is_terrain;
    il_slice *slice;         size_t n, cap;
    il_pair *pair;           size_t cap_pairs;
    unsigned char *has_pair; size_t cap_has;
} linker;

static void forget(linker *l)
{
    for (size_t k = 0; k < l->n; k++) {
        il_slice_free(&l->slice[k]);
        il_pair_free(&l->pair[k]);
    }
    l->n = 0;
}

static int compare_keys(const il_given_stack *a, long number, const char *name)
{
    return a->number != number ? (a->number < number ? -1 : 1) : strcmp(a->name, name);
}

/* By number and name, then as they stand in the file. */
static int compare_given(const void *pa, const void *pb)
{
    const il_given_stack *a = *(const il_given_stack *const *)pa, *b = *(const il_given_stack *const *)pb;
    int c = compare_keys(a, b->number, b->name);
    return c != 0 ? c : (a > b) - (a < b);
}

/* The first that is for HEAD and has not come; null when none is. */
static const il_given_stack *find_given(linker *l, const il_stack_head *head)
{
    long number = head->has_number ? head->number : (long)l->n_begun;
    const char *name = il_stack_head_name(head);
    size_t n = l->given ? l->given->n_stacks : 0, low = 0, high = n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_keys(l->order[middle], number, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == n || compare_keys(l->order[low], number, name) != 0)
        return NULL;
    size_t at = low + l->n_come[low];
    if (at >= n || compare_keys(l->order[at], number, name) != 0)
        return NULL;
    l->n_come[low]++;
    l->has_come[l->order[at] - l->given->stack] = 1;
    return l->order[at];
}

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    linker *l = (linker *)self;
    forget(l);
    l->is_terrain = head->kind == IL_KIND_TERRAIN;
    l->n_begun++;
    l->now = l->is_terrain ? NULL : find_given(l, head);
    if (l->given && !l->now && !l->is_terrain)
        il_report_note(l->report, "%s says nothing of it, so its links are found as without it", l->given->file);
    return l->next->stack_begin(l->next, head, err);
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    linker *l = (linker *)self;
    if (l->is_terrain)
        return l->next->slice(l->next, s, err);
    if (!il_grow(&l->slice, &l->cap, l->n + 1, sizeof *l->slice) || !il_grow(&l->pair, &l->cap_pairs, l->n + 1, sizeof *l->pair) ||
        !il_grow(&l->has_pair, &l->cap_has, l->n + 1, 1))
        return il_fail_nomem(err);
    l->slice[l->n] = *s;
    l->pair[l->n] = (il_pair)IL_PAIR_INIT;
    l->has_pair[l->n++] = 0;
    *s = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    linker *l = (linker *)self;
    if (l->is_terrain)
        return l->next->pair(l->next, p, err);
    if (l->n < 2 || l->has_pair[l->n - 1])
        return il_fail(err, IL_E_INPUT, p->line, "a pair record must follow the upper one of its two slices, once");
    l->pair[l->n - 1] = *p;
    l->has_pair[l->n - 1] = 1;
    *p = (il_pair)IL_PAIR_INIT;
    return IL_OK;
}

/* The pair below slice K. */
static il_status make_pair(linker *l, const il_linkage *links, size_t k, il_error *err)
{
    il_pair *p = &l->pair[k];
    p->matcher = IL_MATCHER_FFD;
    p->linked = true;
    il_status st = il_link_group(p, &l->slice[k - 1], &l->slice[k], links->link + links->first[k - 1],
                                 links->first[k] - links->first[k - 1], err);
    return st == IL_OK && l->options.slants ? il_link_slants(p, &l->slice[k - 1], &l->slice[k], err) : st;
}

/* A slice is the next stage's once it is passed on, so the pair above it is made before. */
static il_status pass_on(linker *l, const il_linkage *links, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < l->n && st == IL_OK; k++) {
        if (k + 1 < l->n && !l->has_pair[k + 1])
            st = make_pair(l, links, k + 1, err);
        if (st == IL_OK)
            st = l->next->slice(l->next, &l->slice[k], err);
        if (st == IL_OK && k > 0)
            st = l->next->pair(l->next, &l->pair[k], err);
        il_slice_free(&l->slice[k]);
        il_pair_free(&l->pair[k]);
    }
    return st;
}

/* What is said overrules what the stream brought, but for gaps. */
static void drop_records(linker *l)
{
    for (size_t k = 0; k < l->n; k++) {
        if (!l->has_pair[k] || l->pair[k].gap)
            continue;
        il_pair none = { .extra = l->pair[k].extra };
        l->pair[k].extra = NULL;
        il_pair_free(&l->pair[k]);
        l->pair[k] = none;
        l->has_pair[k] = 0;
    }
}

static il_status link_stack(linker *l, il_linkage *links, il_error *err)
{
    const il_pair **known = il_alloc(l->n, sizeof *known);
    if (!known)
        return il_fail_nomem(err);
    if (l->now)
        drop_records(l);
    for (size_t k = 0; k < l->n; k++)
        known[k] = k + 1 < l->n && l->has_pair[k + 1] ? &l->pair[k + 1] : NULL;
    il_status st = l->now ? il_linkage_given(links, l->slice, l->n, known, l->given, l->now, err)
                          : il_linkage_find(links, l->slice, l->n, known, &l->options, err);
    il_free(known);
    return st;
}

static il_status stack_end(il_sink *self, il_error *err)
{
    linker *l = (linker *)self;
    il_linkage links = IL_LINKAGE_INIT;
    il_status st = IL_OK;
    if (!l->is_terrain && l->n > 0) {
        st = link_stack(l, &links, err);
        if (st == IL_OK)
            st = pass_on(l, &links, err);
        il_linkage_free(&links);
        forget(l);
    }
    return st == IL_OK ? l->next->stack_end(l->next, err) : st;
}

static il_status end(il_sink *self, il_error *err)
{
    linker *l = (linker *)self;
    return l->next->end(l->next, err);
}

static il_status take_given(linker *l, const il_given *given, il_error *err)
{
    size_t n = given ? given->n_stacks : 0;
    l->given = given;
    l->has_come = il_calloc(n, 1);
    l->order = il_alloc(n, sizeof *l->order);
    l->n_come = il_calloc(n, sizeof *l->n_come);
    if (!l->has_come || !l->order || !l->n_come)
        return il_fail_nomem(err);
    for (size_t i = 0; i < n; i++)
        l->order[i] = &given->stack[i];
    if (n > 1)
        qsort(l->order, n, sizeof *l->order, compare_given);
    return IL_OK;
}

il_status il_linker_new(il_sink **out, const il_linkage_options *o, const il_given *given, il_sink *next,
                        il_report *report, il_error *err)
{
    linker *l = il_calloc(1, sizeof *l);
    *out = NULL;
    if (!l)
        return il_fail_nomem(err);
    *l = (linker){ .sink = { stack_begin, slice, pair, stack_end, end }, .next = next, .options = *o, .report = report };
    il_status st = take_given(l, given, err);
    if (st == IL_OK)
        *out = &l->sink;
    else
        il_linker_free(&l->sink);
    return st;
}

size_t il_linker_missed(const il_sink *s, size_t k)
{
    const linker *l = (const linker *)s;
    while (k < l->given->n_stacks && l->has_come[k])
        k++;
    return k;
}

void il_linker_free(il_sink *s)
{
    linker *l = (linker *)s;
    if (!l)
        return;
    forget(l);
    il_free(l->slice);
    il_free(l->pair);
    il_free(l->has_pair);
    il_free(l->has_come);
    il_free(l->order);
    il_free(l->n_come);
    il_free(l);
}
