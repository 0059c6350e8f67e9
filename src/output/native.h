/* native.h - the native writer's parts, shared by its files and by no others. */
#ifndef IL_OUTPUT_NATIVE_H
#define IL_OUTPUT_NATIVE_H

#include "base/output.h"
#include "model/pair.h"

/* Write P, a pair or a gap, in canonical form (formats/loft.txt, 8 and 9). */
il_status il_native_write_pair(il_output *to, const il_pair *p, il_error *err);

void il_native_write_extra(il_output *to, const il_extra *extra);

/* A blank and the number. */
void il_native_put_number(il_output *to, double v);
void il_native_put_index(il_output *to, uint32_t v);
/* A blank and the quoted string. */
void il_native_put_string(il_output *to, const char *s);

#endif
