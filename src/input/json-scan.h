/* json-scan.h - JSON (RFC 8259) as a stream of events, one token at a time.
 *
 *     il_json_scan j;
 *     il_json_event event;
 *     il_json_scan_init(&j, source, options);
 *     while ((st = il_json_scan_next(&j, &event, err)) == IL_OK && event != IL_JSON_END)
 *         ...
 *     il_json_scan_free(&j);
 *
 * Several values may follow one another, with or without blanks between them.
 * More lenient than the RFC where files in use need it, and nowhere else:
 *   o  numbers may have a plus, leading zeros, and nothing on one side of the
 *      point: +1.5, 007, 5., .5;
 *   o  NaN, Infinity and -Infinity are numbers, though without a value;
 *   o  a byte order mark is dropped, tabs in strings are taken;
 *   o  bytes of strings that are no UTF-8 are handed on as they are.
 * A comma with no value behind it is refused, as what it stands for (a value
 * that was lost, or nothing) cannot be told.
 *
 * Memory: a block, the longest token, and 16 bytes a level. */
#ifndef IL_INPUT_JSON_SCAN_H
#define IL_INPUT_JSON_SCAN_H

#include "input/reader.h"

/* KEY comes before the value of every member of an object.  END: there are no
 * more values; it comes again when asked again. */
typedef enum il_json_event {
    IL_JSON_END,
    IL_JSON_OBJECT, IL_JSON_OBJECT_END,
    IL_JSON_ARRAY, IL_JSON_ARRAY_END,
    IL_JSON_KEY, IL_JSON_STRING, IL_JSON_NUMBER,
    IL_JSON_TRUE, IL_JSON_FALSE, IL_JSON_NULL
} il_json_event;

typedef struct il_json_scan {
    /* Of the event last given.  text[0..n): a key or string without quotes and
     * escapes, in which zero bytes may be; a number as it is written.  No
     * terminator; good until the next call.  line: where it begins, from 1.
     * depth: objects and arrays that are open now, the one counted that the
     * event has opened, and not the one that it has closed. */
    const char *text;
    size_t n;
    long line;
    size_t depth;

    /* May be set before the first call: bytes that are passed over between the
     * outermost values, like blanks ("\x1e" for RFC 8142); and `line`, when lines
     * before the JSON were taken from the source already. */
    const char *between;

    /* The parser's own. */
    il_source *source;          /* borrowed */
    size_t max_token, max_depth;
    char *buf;                  /* bytes begin..end are to come; a zero byte stands behind */
    size_t cap, begin, end;
    bool begun, at_end, after_lf;
    unsigned expected;          /* what may come next */
    struct il_json_scan_level { long line; char close; } *level;
    size_t cap_levels;
} il_json_scan;

/* The limits are max_line, for a token, and max_depth of OPTIONS. */
void il_json_scan_init(il_json_scan *j, il_source *source, const il_read_options *options);
void il_json_scan_free(il_json_scan *j);

/* The next event.  IL_E_INPUT with the line for what is no JSON, or beyond the
 * limits, or ends inside of a value; IL_E_IO, IL_E_NOMEM.  After a failure J can only
 * be freed. */
il_status il_json_scan_next(il_json_scan *j, il_json_event *event, il_error *err);

/* Go to the end of the value that EVENT, the last one, began; of the member,
 * when it was a key. */
il_status il_json_scan_skip(il_json_scan *j, il_json_event event, il_error *err);

/* The value of the number last given; false when no finite double has it. */
bool il_json_scan_value(const il_json_scan *j, double *value);

/* For telling texts apart: where the blanks at S[I..N) end; and behind them stands C:
 * where it ends, 0 when it does not stand there. */
size_t il_json_skip_blanks(const char *s, size_t n, size_t i);
size_t il_json_behind(const char *s, size_t n, size_t i, char c);

#endif
