/* dxf-scan.h - the pairs that a DXF file is: a line with a group code, and one with
 * its value. */
#ifndef IL_INPUT_DXF_SCAN_H
#define IL_INPUT_DXF_SCAN_H

#include "base/source.h"

#include <stdbool.h>

/* The pair at hand.  value[n]: without the blanks around it, good until the next
 * pair.  line: of the code; the value stands in the next. */
typedef struct il_dxf_scan {
    il_lines lines;
    int code;
    const char *value;
    size_t n;
    long line;
} il_dxf_scan;

void il_dxf_scan_init(il_dxf_scan *s, il_source *source, size_t max_line);
void il_dxf_scan_free(il_dxf_scan *s);

/* Go to the next pair; comments (999) are passed over.  IL_E_INPUT also where the file
 * ends: a whole one ends with the pair 0, EOF, behind which nobody asks for more. */
il_status il_dxf_next(il_dxf_scan *s, il_error *err);

/* Is the pair at hand CODE with the value TEXT? */
bool il_dxf_is(const il_dxf_scan *s, int code, const char *text);

/* The value of the pair at hand as a number. */
il_status il_dxf_number(const il_dxf_scan *s, double *value, il_error *err);

/* Only blank lines and the mark of old systems (^Z) may follow. */
il_status il_dxf_expect_end(il_dxf_scan *s, il_error *err);

#endif
