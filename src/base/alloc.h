/* alloc.h - the one door to the heap: checked growth, and a seam for tests.
 *
 * Everything of isoloft's own that lives on the heap comes through here, so
 * that a test can make the k-th allocation fail and see the program stand.
 * What libraries allocate for themselves does not. */
#ifndef IL_BASE_ALLOC_H
#define IL_BASE_ALLOC_H

#include <stdbool.h>
#include <stddef.h>

/* N * SIZE bytes, uninitialised; null when it overflows or there are none.
 * N or SIZE 0 gives a valid pointer to free.  Free with il_free. */
void *il_alloc(size_t n, size_t size);

/* As il_alloc, all bytes zero. */
void *il_calloc(size_t n, size_t size);

/* Resize P (or null) to N * SIZE bytes; on failure null, and P still stands. */
void *il_realloc(void *p, size_t n, size_t size);

void il_free(void *p);

/* A copy of the N bytes at S with a terminator behind them. */
char *il_strndup(const char *s, size_t n);

/* Make room for NEED elements of SIZE bytes in the array *P with capacity *CAP.
 * Grows by half again, so that appending is linear; false when it overflows or
 * there is no memory, and then *P and *CAP are as before.
 *     if (!il_grow(&a->xy, &a->cap, n + 1, sizeof *a->xy)) return il_fail_nomem(err); */
#define il_grow(p, cap, need, size) il_grow_bytes((void **)(void *)(p), (cap), (need), (size))
bool il_grow_bytes(void **p, size_t *cap, size_t need, size_t size);

/* Tests only: let K more allocations succeed, then fail them all; negative K
 * never fails.  Also set by the environment variable ISOLOFT_TEST_ALLOC in
 * programs that call il_alloc_test_environment. */
void il_alloc_test_fail_after(long k);
void il_alloc_test_environment(void);

#endif
