#include "config.h"
#include "terrain/links.h"
#include "base/alloc.h"
#include "terrain/tin.h"

uint32_t il_links_from(const il_links *l, size_t k)
{
    return l->node[l->in_triangles ? k : 2 * k];
}

uint32_t il_links_to(const il_links *l, size_t k)
{
    return l->node[l->in_triangles ? il_tin_after(k) : 2 * k + 1];
}

static uint32_t lesser(const il_links *l, size_t k)
{
    uint32_t a = il_links_from(l, k), b = il_links_to(l, k);
    return a < b ? a : b;
}

static uint32_t greater(const il_links *l, size_t k)
{
    uint32_t a = il_links_from(l, k), b = il_links_to(l, k);
    return a < b ? b : a;
}

typedef uint32_t key(const il_links *l, size_t k);

/* Those of from[n] (null: 0, 1, ...) to to[n], by KEY_OF and else as they are; first[n_nodes + 2]
 * becomes where those of each key begin, behind a 0. */
static void sort(const il_links *l, key *key_of, const uint32_t *from, size_t n, size_t n_nodes, uint32_t *first, uint32_t *to)
{
    for (size_t v = 0; v < n_nodes + 2; v++)
        first[v] = 0;
    for (size_t k = 0; k < n; k++)
        first[key_of(l, k) + 2]++;
    for (size_t v = 2; v < n_nodes + 2; v++)
        first[v] += first[v - 1];
    for (size_t i = 0; i < n; i++) {
        uint32_t k = from ? from[i] : (uint32_t)i;
        to[first[key_of(l, k) + 1]++] = k;
    }
}

bool il_links_build(il_links *l, const uint32_t *node, size_t n, bool in_triangles, size_t n_nodes)
{
    uint32_t *order = il_alloc(n, sizeof *order);
    *l = (il_links){ node, in_triangles, il_alloc(n_nodes + 2, sizeof *l->first), il_alloc(n, sizeof *l->of) };
    bool ok = order && l->first && l->of;
    if (ok) {
        sort(l, greater, NULL, n, n_nodes, l->first, order);
        sort(l, lesser, order, n, n_nodes, l->first, l->of);
    }
    il_free(order);
    if (!ok)
        il_links_free(l);
    return ok;
}

void il_links_free(il_links *l)
{
    il_free(l->first);
    il_free(l->of);
    *l = (il_links)IL_LINKS_INIT;
}

il_links_range il_links_find(const il_links *l, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t begin = l->first[low], end = l->first[low + 1], last = end;
    while (begin < end) {
        uint32_t middle = begin + (end - begin) / 2;
        if (greater(l, l->of[middle]) < high)
            begin = middle + 1;
        else
            end = middle;
    }
    while (end < last && greater(l, l->of[end]) == high)
        end++;
    return (il_links_range){ begin, end };
}

size_t il_links_count_pairs(const il_links *l, size_t n)
{
    size_t pairs = n > 0;
    for (size_t i = 1; i < n; i++)
        pairs += lesser(l, l->of[i]) != lesser(l, l->of[i - 1]) || greater(l, l->of[i]) != greater(l, l->of[i - 1]);
    return pairs;
}
