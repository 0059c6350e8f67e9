#include "config.h"
#include "base/dictionary.h"
#include "base/alloc.h"

#include <string.h>

static unsigned char fold(char c)
{
    return (unsigned char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

/* Fowler, Noll and Vo's FNV-1a. */
static uint64_t hash(const char *s, size_t n)
{
    uint64_t h = UINT64_C(0xCBF29CE484222325);
    for (size_t i = 0; i < n; i++)
        h = (h ^ fold(s[i])) * UINT64_C(0x100000001B3);
    return h;
}

static size_t length_of(const il_dictionary *w, size_t i)
{
    return (i + 1 < w->n ? w->begin[i + 1] : w->n_pool) - w->begin[i] - 1;
}

static bool is_word(const il_dictionary *w, size_t i, const char *s, size_t n)
{
    const char *t = w->pool + w->begin[i];
    if (length_of(w, i) != n)
        return false;
    for (size_t k = 0; k < n; k++)
        if (fold(s[k]) != fold(t[k]))
            return false;
    return true;
}

static bool add(il_dictionary *w, const char *s, size_t n)
{
    if (!il_grow(&w->begin, &w->cap, w->n + 1, sizeof *w->begin) || !il_grow(&w->pool, &w->cap_pool, w->n_pool + n + 1, 1))
        return false;
    w->begin[w->n++] = w->n_pool;
    if (n > 0)
        memcpy(w->pool + w->n_pool, s, n);
    w->n_pool += n;
    w->pool[w->n_pool++] = '\0';
    return true;
}

/* Texts of one hash have the keys (hash, 0), (hash, 1) and so on. */
bool il_dictionary_put(il_dictionary *w, const char *s, size_t n, uint32_t *index)
{
    uint64_t h = hash(s, n), like = 0;
    uint32_t i;
    while ((i = il_keymap_get(&w->at, h, like, UINT32_MAX)) != UINT32_MAX && !is_word(w, i, s, n))
        like++;
    *index = i != UINT32_MAX ? i : (uint32_t)w->n;
    if (i != UINT32_MAX)
        return true;
    if (w->n >= IL_DICTIONARY_MOST || !il_keymap_reserve(&w->at, w->n + 1) || !add(w, s, n))
        return false;
    return il_keymap_put(&w->at, h, like, *index) != NULL;
}

const char *il_dictionary_text(const il_dictionary *w, size_t i)
{
    return w->pool + w->begin[i];
}

void il_dictionary_free(il_dictionary *w)
{
    il_keymap_free(&w->at);
    il_free(w->pool);
    il_free(w->begin);
    *w = (il_dictionary)IL_DICTIONARY_INIT;
}
