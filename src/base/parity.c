#include "config.h"
#include "base/parity.h"
#include "base/alloc.h"

/* Triangles whose regions are known and whose neighbours may not be. */
typedef struct front {
    uint32_t *todo;
    bool *known;
    unsigned char *inside;
    size_t n;
} front;

static void reach(front *f, uint32_t t, unsigned char inside)
{
    if (f->known[t])
        return;
    f->known[t] = true;
    f->inside[t] = inside;
    f->todo[f->n++] = t;
}

bool il_parity_flood(const uint32_t *across, const unsigned char *edge, unsigned char mask,
                     size_t n, unsigned char *inside)
{
    front f = { il_alloc(n, sizeof *f.todo), il_calloc(n, sizeof *f.known), inside, 0 };
    bool ok = f.todo && f.known;
    for (size_t e = 0; ok && e < 3 * n; e++)
        if (across[e] == UINT32_MAX)
            reach(&f, (uint32_t)(e / 3), edge[e] & mask);
    while (ok && f.n > 0) {
        uint32_t t = f.todo[--f.n];
        for (size_t e = 3 * (size_t)t; e < 3 * (size_t)t + 3; e++)
            if (across[e] != UINT32_MAX)
                reach(&f, across[e], inside[t] ^ (edge[e] & mask));
    }
    il_free(f.todo);
    il_free(f.known);
    return ok;
}
