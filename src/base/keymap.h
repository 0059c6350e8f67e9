/* keymap.h - from a pair of integers to a small number: a hash table that is
 * only ever asked, never walked, so that no order comes out of it. */
#ifndef IL_BASE_KEYMAP_H
#define IL_BASE_KEYMAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

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
static inline uint64_t il_keymap_double(double x)
{
    uint64_t bits;
    x = x == 0 ? 0 : x;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* For tables of one's own: the finaliser of splitmix64 (Steele, Lea & Flood 2014),
 * by which every bit of Z reaches every bit of the result. */
static inline uint64_t il_keymap_mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

/* The undirected edge of nodes A and B, in both halves. */
#define IL_KEYMAP_EDGE(a, b) ((a) < (b) ? (a) : (b)), ((a) < (b) ? (b) : (a))

#endif
