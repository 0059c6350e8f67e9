/* table.h - lines of two columns for people. */
#ifndef IL_CLI_TABLE_H
#define IL_CLI_TABLE_H

#include "base/output.h"

/* "  KEY        text" to OUT.  Texts from files come in printable. */
void il_table_row(il_output *out, const char *key, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The heading above such rows, made printable. */
void il_table_heading(il_output *out, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
