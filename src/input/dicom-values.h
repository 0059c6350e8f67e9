/* dicom-values.h - the values of one DICOM attribute, which XML has in pieces,
 * put together as DICOM files have them: a backslash between two. */
#ifndef IL_INPUT_DICOM_VALUES_H
#define IL_INPUT_DICOM_VALUES_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* text[n]: the values in the order they came.  value[n_values]: where each
 * begins and ends in it, and its number.  in_order: the numbers are 1, 2, 3, ...
 * is_text: white space in a value is part of it, except at its ends; else line
 * ends and tabs in it are blanks. */
typedef struct il_dicom_values {
    char *text;                 size_t n, cap;
    struct il_dicom_value { uint32_t number, begin, end; } *value;
    size_t n_values, cap_values, max;
    char *sorted;               size_t cap_sorted;
    bool in_order, is_text;
} il_dicom_values;

/* Values of more than MAX bytes, taken together, are refused. */
void il_dicom_values_init(il_dicom_values *v, size_t max);
void il_dicom_values_free(il_dicom_values *v);

/* Begin a new attribute; what V holds is dropped. */
void il_dicom_values_clear(il_dicom_values *v, bool is_text);

/* A value begins; it is number NUMBER[0..N) of its attribute, the next one when
 * NUMBER is null.  IL_E_INPUT, without a line, when that is no number from 1 on. */
il_status il_dicom_values_begin(il_dicom_values *v, const char *number, size_t n, il_error *err);
/* The value goes on with S[0..N). */
il_status il_dicom_values_add(il_dicom_values *v, const char *s, size_t n, il_error *err);
/* The value ends. */
void il_dicom_values_end(il_dicom_values *v);

/* All values by rising number, *N bytes, borrowed.  Where numbers are missing, one
 * empty value stands for them, so that a number that a file claims sizes nothing.
 * IL_E_INPUT, without a line, when a number occurs twice. */
il_status il_dicom_values_join(il_dicom_values *v, const char **text, size_t *n, il_error *err);

#endif
