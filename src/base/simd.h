/* simd.h - eight floats at a time, with the same bits on every processor.
 *
 * The vector types of gcc and clang: plain C operators work lane by lane, and
 * the compiler cuts them into whatever registers there are.  Nothing here is
 * reassociated or contracted, and whoever sums over lanes does so in one fixed
 * order, so that a result does not depend on the machine. */
#ifndef IL_BASE_SIMD_H
#define IL_BASE_SIMD_H

#include <math.h>
#include <stdint.h>
#include <string.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

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

/* Of the ways to say it these are the ones that gcc 12 makes one instruction of,
 * wherever they stand: { x, x, ... } is sometimes eight.  X - 0 is X. */
IL_LANEWISE il_f8 il_f8_all(float x)
{
    return x - (il_f8){ 0 };
}

IL_LANEWISE il_i8 il_i8_all(int32_t x)
{
    il_i8 v = { 0 };
    for (int i = 0; i < IL_LANES; i++)
        v[i] = x;
    return v;
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

IL_LANEWISE void il_i8_store(uint32_t *p, il_i8 v)
{
    memcpy(p, &v, sizeof v);
}

/* The lesser lane by lane, B where they cannot be told; compilers make one
 * instruction of the loop. */
IL_LANEWISE il_f8 il_f8_min(il_f8 a, il_f8 b)
{
    for (int i = 0; i < IL_LANES; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
}

IL_LANEWISE il_f8 il_f8_max(il_f8 a, il_f8 b)
{
    for (int i = 0; i < IL_LANES; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
}

IL_LANEWISE il_f8 il_f8_abs(il_f8 v)
{
    return (il_f8)((il_i8)v & 0x7fffffff);
}

/* Rounded correctly, as sqrtf is, which would set errno lane by lane. */
IL_LANEWISE il_f8 il_f8_root(il_f8 v)
{
#if defined __SSE2__ && (defined __clang__ || __GNUC__ >= 12)
    __m128 low = _mm_sqrt_ps(__builtin_shufflevector(v, v, 0, 1, 2, 3));
    __m128 high = _mm_sqrt_ps(__builtin_shufflevector(v, v, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    for (int i = 0; i < IL_LANES; i++)
        v[i] = sqrtf(v[i]);
    return v;
#endif
}

/* The least lane. */
IL_LANEWISE float il_f8_least(il_f8 v)
{
    float a[IL_LANES / 2];
    for (int i = 0; i < IL_LANES / 2; i++)
        a[i] = v[i] < v[i + IL_LANES / 2] ? v[i] : v[i + IL_LANES / 2];
    a[0] = a[0] < a[2] ? a[0] : a[2];
    a[1] = a[1] < a[3] ? a[1] : a[3];
    return a[0] < a[1] ? a[0] : a[1];
}

/* The sign of lane i as bit i. */
IL_LANEWISE uint32_t il_f8_signs(il_f8 v)
{
#ifdef __SSE2__
    __m128 half[2];
    memcpy(half, &v, sizeof v);
    return (uint32_t)(_mm_movemask_ps(half[0]) | _mm_movemask_ps(half[1]) << 4);
#else
    uint32_t bits = 0;
    for (int i = 0; i < IL_LANES; i++)
        bits |= (uint32_t)((il_i8)v)[i] >> 31 << i;
    return bits;
#endif
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
