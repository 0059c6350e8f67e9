#include "config.h"
#include "base/keymap.h"
#include "base/alloc.h"

/* Keys may be coordinates from a file: the table's own address goes into the
 * hash, so that no file can be made to have all its keys in one place.  Nothing
 * else depends on where a key lies. */
static struct il_keymap_slot *find(const il_keymap *m, uint64_t a, uint64_t b)
{
    size_t mask = m->size - 1, i = il_keymap_mix(il_keymap_mix(a ^ (uintptr_t)m->slot) + b) & mask;
    while (m->slot[i].used && (m->slot[i].a != a || m->slot[i].b != b))
        i = (i + 1) & mask;
    return &m->slot[i];
}

/* At most two thirds full, so that probes stay short. */
bool il_keymap_reserve(il_keymap *m, size_t n)
{
    size_t size = m->size ? m->size : 16;
    while (size / 3 * 2 < n)
        size *= 2;
    if (size == m->size)
        return true;
    il_keymap bigger = { il_calloc(size, sizeof *m->slot), m->n, size };
    if (!bigger.slot)
        return false;
    for (size_t i = 0; i < m->size; i++)
        if (m->slot[i].used)
            *find(&bigger, m->slot[i].a, m->slot[i].b) = m->slot[i];
    il_free(m->slot);
    *m = bigger;
    return true;
}

uint32_t il_keymap_get(const il_keymap *m, uint64_t a, uint64_t b, uint32_t none)
{
    if (m->size == 0)
        return none;
    const struct il_keymap_slot *s = find(m, a, b);
    return s->used ? s->value : none;
}

uint32_t *il_keymap_put(il_keymap *m, uint64_t a, uint64_t b, uint32_t value)
{
    bool room = il_keymap_reserve(m, m->n + 1);
    if (!room && m->size == 0)
        return NULL;
    struct il_keymap_slot *s = find(m, a, b);
    if (!room && !s->used)
        return NULL; /* what is known needs no room */
    if (!s->used) {
        *s = (struct il_keymap_slot){ a, b, value, true };
        m->n++;
    }
    return &s->value;
}

void il_keymap_free(il_keymap *m)
{
    il_free(m->slot);
    *m = (il_keymap)IL_KEYMAP_INIT;
}
