/* keymap.h - from a pair of integers to a small number: a hash table that is
 * only ever asked, never walked, so that no order comes out of it. */
#ifndef IL_BASE_KEYMAP_H
#define IL_BASE_KEYMAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct il_keymap {
    struct il_keymap_slot { uint64_t a, b; uint32_t value; bool used; } *slot;
    size_t n, size; /* size: a power of two, or 0 */
} il_keymap;

#define IL_KEYMAP_INIT { NULL, 0, 0 }

/* Room for N keys without growing again; false when there is no memory. */
bool il_keymap_reserve(il_keymap *m, size_t n);

/* The value stored under (A, B), or NONE. */
uint32_t il_keymap_get(const il_keymap *m, uint64_t a, uint64_t b, uint32_t none);

/* The place of the value under (A, B), made with VALUE when the key is new;
 * null when there is no memory.  Good until the next put. */
uint32_t *il_keymap_put(il_keymap *m, uint64_t a, uint64_t b, uint32_t value);

void il_keymap_free(il_keymap *m);

/* A coordinate as half a key: equal numbers, equal keys (-0 is 0). */
uint64_t il_keymap_double(double x);

/* The undirected edge of nodes A and B, in both halves. */
#define IL_KEYMAP_EDGE(a, b) ((a) < (b) ? (a) : (b)), ((a) < (b) ? (b) : (a))

#endif
