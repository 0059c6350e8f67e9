/* native-scan.h - one line of the native format, word by word.
 *
 * Each function skips blanks and takes what it is named for from the front of
 * the line, or fails with IL_E_INPUT, the line's number and a sentence. */
#ifndef IL_INPUT_NATIVE_SCAN_H
#define IL_INPUT_NATIVE_SCAN_H

#include "base/status.h"
#include "model/ring.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct il_scan {
    const char *p, *end;    /* what is left of the line; borrowed */
    long line;
} il_scan;

/* Magnitudes stay below this (formats/loft.txt, section 4). */
#define IL_NATIVE_BOUND IL_COORDINATE_BOUND

/* Does the line hold nothing that no line may hold: UTF-8, no controls? */
il_status il_scan_check(const il_scan *s, il_error *err);

/* At the end of the line, or at a comment? */
bool il_scan_at_end(il_scan *s);

/* How much of a word of N bytes messages show. */
int il_scan_shown(size_t n);

/* The next word without taking it; *N is 0 at the end of the line. */
const char *il_scan_peek(il_scan *s, size_t *n);

/* The next word is one of the null-terminated list WORDS: its place in it.
 * WHAT names the choice in the error. */
il_status il_scan_choice(il_scan *s, const char *const *words, const char *what, int *choice, il_error *err);

il_status il_scan_number(il_scan *s, double *value, il_error *err);
il_status il_scan_numbers(il_scan *s, double *to, size_t n, il_error *err);
il_status il_scan_index(il_scan *s, uint32_t *value, il_error *err);
/* Digits with an optional minus sign, LEAST to MOST. */
il_status il_scan_integer(il_scan *s, long least, long most, long *value, il_error *err);

/* A quoted string, its escapes undone: UTF-8 without NUL, terminated; *TEXT is
 * the caller's to free, and null after failure. */
il_status il_scan_string(il_scan *s, char **text, il_error *err);

/* Nothing may be left but a comment. */
il_status il_scan_end(il_scan *s, il_error *err);

#endif
