#include "config.h"
#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The only mutable global of the program, and written by tests alone.
 * Negative: never fail. */
static atomic_long allocations_left = -1;

void il_alloc_test_fail_after(long k)
{
    atomic_store(&allocations_left, k);
}

void il_alloc_test_environment(void)
{
    const char *k = getenv("ISOLOFT_TEST_ALLOC");
    if (k && *k)
        il_alloc_test_fail_after(strtol(k, NULL, 10));
}

static bool must_fail(void)
{
    if (atomic_load_explicit(&allocations_left, memory_order_relaxed) < 0)
        return false;
    long before = atomic_fetch_sub(&allocations_left, 1);
    if (before > 0)
        return false;
    atomic_store(&allocations_left, 0);
    return true;
}

static bool product(size_t n, size_t size, size_t *bytes)
{
    if (size != 0 && n > PTRDIFF_MAX / size)
        return false;
    *bytes = n * size > 0 ? n * size : 1;
    return true;
}

void *il_alloc(size_t n, size_t size)
{
    size_t bytes;
    return product(n, size, &bytes) && !must_fail() ? malloc(bytes) : NULL;
}

void *il_calloc(size_t n, size_t size)
{
    size_t bytes;
    return product(n, size, &bytes) && !must_fail() ? calloc(1, bytes) : NULL;
}

void *il_realloc(void *p, size_t n, size_t size)
{
    size_t bytes;
    return product(n, size, &bytes) && !must_fail() ? realloc(p, bytes) : NULL;
}

void il_free(void *p)
{
    free(p);
}

char *il_strndup(const char *s, size_t n)
{
    char *copy = il_alloc(n + 1, 1);
    if (copy) {
        memcpy(copy, s, n);
        copy[n] = '\0';
    }
    return copy;
}

bool il_grow_bytes(void **p, size_t *cap, size_t need, size_t size)
{
    if (need <= *cap)
        return true;
    size_t wanted = *cap + *cap / 2 + 8;
    if (wanted < need)
        wanted = need;
    void *bigger = il_realloc(*p, wanted, size);
    if (!bigger)
        return false;
    *p = bigger;
    *cap = wanted;
    return true;
}
