/* number.h - text to number and back: locale-free, correctly rounded, shortest.
 *
 * Both ways go through <charconv> (src/bridge/number.cpp), which guarantees
 * that every finite double survives il_number_format, il_number_parse bit for
 * bit, and that no shorter text would. */
#ifndef IL_BASE_NUMBER_H
#define IL_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Room for any double in il_number_format's form, and for any float. */
#define IL_NUMBER_MAX 32

/* Read the number at the start of S[0..N): a sign (+ or -), digits with at most
 * one point, an exponent; at least one digit; no blanks, no hex, no inf or nan.
 * Returns the bytes used, 0 when there is no number or it does not fit a
 * finite double; *VALUE is set only on success.  "1e-400" reads as 0. */
size_t il_number_parse(const char *s, size_t n, double *value);

/* Write the shortest text that reads back as VALUE to TO[IL_NUMBER_MAX], with
 * a terminator; -0 as "0".  VALUE must be finite.  Returns its length. */
size_t il_number_format(char *to, double value);

/* As il_number_format, shortest for a 32-bit float. */
size_t il_number_format_float(char *to, float value);

/* VALUE rounded to a 32-bit float.  Through memory on purpose: gcc 12 at -O2
 * drops the conversion there and back where it turns two of them into one
 * vector operation. */
static inline double il_number_round_float(double value)
{
    volatile float rounded = (float)value;
    return (double)rounded;
}

#ifdef __cplusplus
}
#endif
#endif
