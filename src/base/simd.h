/* simd.h - eight floats at a time, with the same bits on every processor.
 *
 * The vector types of gcc and clang: plain C operators work lane by lane, and
 * the compiler cuts them into whatever registers there are.  Nothing here is
 * reassociated or contracted, and whoever sums over lanes does so in one fixed
 * order, so that a result does not depend on the machine. */
#ifndef IL_BASE_SIMD_H
#define IL_BASE_SIMD_H

#include <stdint.h>
#include <string.h>

enum { IL_LANES = 8 };

typedef float il_f8 __attribute__((vector_size(32)));
typedef int32_t il_i8 __attribute__((vector_size(32)));

/* Before a function that works on these types: it is compiled for newer
 * processors too, and the loader picks the best. */
#ifdef HAVE_TARGET_CLONES
#define IL_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define IL_CLONES
#endif

/* A function of these types must vanish into its caller, for by value they have
 * no one way of being passed. */
#define IL_LANEWISE static inline __attribute__((always_inline))

IL_LANEWISE il_f8 il_f8_all(float x)
{
    return (il_f8){ x, x, x, x, x, x, x, x };
}

/* From and to any address of floats. */
IL_LANEWISE il_f8 il_f8_load(const float *p)
{
    il_f8 v;
    memcpy(&v, p, sizeof v);
    return v;
}

IL_LANEWISE void il_f8_store(float *p, il_f8 v)
{
    memcpy(p, &v, sizeof v);
}

/* Lane by lane A where MASK is -1, B where it is 0. */
IL_LANEWISE il_f8 il_f8_choose(il_i8 mask, il_f8 a, il_f8 b)
{
    return (il_f8)((mask & (il_i8)a) | (~mask & (il_i8)b));
}

IL_LANEWISE il_i8 il_i8_choose(il_i8 mask, il_i8 a, il_i8 b)
{
    return (mask & a) | (~mask & b);
}

/* The sum of the lanes, always in this order. */
IL_LANEWISE float il_f8_sum(il_f8 v)
{
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

#endif
