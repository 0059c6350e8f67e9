/* map-value.h - heights as people write them: 100, 12,5, 10 m, 300 ft. */
#ifndef IL_INPUT_MAP_VALUE_H
#define IL_INPUT_MAP_VALUE_H

#include "model/stack.h"

typedef struct il_map_value {
    double number;
    bool has_unit;
    il_unit unit;
} il_map_value;

/* Is S[0..N) a word for a unit of heights ("m", "feet"), in any case?  *UNIT it is then. */
bool il_map_unit_word(const char *s, size_t n, il_unit *unit);

/* Read TEXT[0..N): blanks, a finite number below 1e15 (a comma is taken for its point
 * when there is no point), blanks, a word for metres or feet or nothing.  False when
 * it is anything else. */
bool il_map_value_parse(const char *text, size_t n, il_map_value *out);

/* The same, but if TEXT is more than that, the one number in it ("Isoline_100 major");
 * false when there are several. */
bool il_map_value_find(const char *text, size_t n, il_map_value *out);

#endif
