/* sort.h - numbers by size. */
#ifndef IL_BASE_SORT_H
#define IL_BASE_SORT_H

#include <stddef.h>

/* V[0..N), none of them a NaN, by rising value. */
void il_sort_doubles(double *v, size_t n);

#endif
