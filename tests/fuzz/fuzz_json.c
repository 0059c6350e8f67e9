/* fuzz_json.c - whatever the bytes, the scanner refuses them with a sentence and
 * a line inside the input, or gives events that are balanced and in order; and
 * these, written as JSON, give themselves again. */
#include "config.h"
#include "input/json-scan.h"
#include "must.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* ---- events as JSON ------------------------------------------------------- */

typedef struct text {
    char *s;
    size_t n, cap;
} text;

static void put(text *t, const char *s, size_t n)
{
    if (t->n + n > t->cap) {
        t->cap = 2 * (t->n + n) + 100;
        t->s = realloc(t->s, t->cap);
        must(t->s != NULL, "no memory");
    }
    memcpy(t->s + t->n, s, n);
    t->n += n;
}

static void put_string(text *t, const char *s, size_t n)
{
    put(t, "\"", 1);
    for (size_t i = 0; i < n; i++) {
        char escape[8];
        int length = snprintf(escape, sizeof escape, "\\u%04x", (unsigned)(unsigned char)s[i]);
        bool is_plain = (unsigned char)s[i] >= ' ' && s[i] != '"' && s[i] != '\\';
        put(t, is_plain ? s + i : escape, is_plain ? 1 : (size_t)length);
    }
    put(t, "\"", 1);
}

/* EVENT behind those before; NEW_ITEM: a comma is due when another item comes. */
static void put_event(text *t, const il_json_scan *j, il_json_event event, bool *is_after_item)
{
    static const char *const fixed[] = { "", "{", "}", "[", "]", "", "", "", "true", "false", "null" };
    bool is_end = event == IL_JSON_OBJECT_END || event == IL_JSON_ARRAY_END;
    if (*is_after_item && !is_end)
        put(t, j->depth > (event == IL_JSON_OBJECT || event == IL_JSON_ARRAY) ? "," : "\n", 1);
    put(t, fixed[event], strlen(fixed[event]));
    if (event == IL_JSON_KEY || event == IL_JSON_STRING)
        put_string(t, j->text, j->n);
    if (event == IL_JSON_KEY)
        put(t, ":", 1);
    if (event == IL_JSON_NUMBER)
        put(t, j->text, j->n);
    *is_after_item = event != IL_JSON_KEY && event != IL_JSON_OBJECT && event != IL_JSON_ARRAY;
}

/* ---- the contract ------------------------------------------------------------ */

static void check_number(const il_json_scan *j)
{
    double value = 0;
    bool is_word = strchr("NI", j->text[0]) || (j->n > 1 && j->text[1] == 'I');
    must(j->n > 0, "a number of no bytes");
    must(!(is_word && il_json_scan_value(j, &value)), "a word with a value");
}

static size_t depth_after(size_t depth, il_json_event event)
{
    if (event == IL_JSON_OBJECT || event == IL_JSON_ARRAY)
        return depth + 1;
    if (event == IL_JSON_OBJECT_END || event == IL_JSON_ARRAY_END)
        return depth - 1;
    return depth;
}

/* All of DATA[0..N) to *T as JSON; the line of the end to *LINE. */
static il_status rewrite(const void *data, size_t n, text *t, il_error *err)
{
    il_read_options options = IL_READ_OPTIONS_INIT;
    il_json_scan j;
    il_json_event event = IL_JSON_NULL;
    il_source *source = NULL;
    bool is_after_item = false;
    size_t depth = 0;
    long line = 1;
    options.max_depth = 20;
    il_status st = il_source_from_memory(&source, data, n, "bytes", err);
    must(st == IL_OK, "no memory");
    il_json_scan_init(&j, source, &options);
    j.between = "\x1e";
    while ((st = il_json_scan_next(&j, &event, err)) == IL_OK && event != IL_JSON_END) {
        must(j.line >= line, "lines go back");
        line = j.line;
        depth = depth_after(depth, event);
        must(j.depth == depth && depth <= options.max_depth, "a wrong depth");
        if (event == IL_JSON_NUMBER)
            check_number(&j);
        put_event(t, &j, event, &is_after_item);
    }
    must(st != IL_OK || depth == 0, "an end inside a value");
    il_json_scan_free(&j);
    il_source_close(source);
    return st;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    text once = { 0 }, again = { 0 };
    il_error err = IL_ERROR_INIT;
    long lines = 1;
    for (size_t i = 0; i < n; i++)
        lines += data[i] == '\n';
    bool is_gzip = n >= 2 && data[0] == 0x1f && data[1] == 0x8b;
    il_status st = rewrite(data, n, &once, &err);
    if (st == IL_OK) {
        must(rewrite(once.s, once.n, &again, NULL) == IL_OK, "refuses its own JSON");
        must(once.n == again.n && (once.n == 0 || memcmp(once.s, again.s, once.n) == 0), "reads its own JSON as another");
    } else {
        must(st == IL_E_INPUT && err.code == st && err.text[0], "refused without a reason");
        must(is_gzip || (err.line >= 1 && err.line <= lines), "refused in a line that is not there");
    }
    free(once.s);
    free(again.s);
    return 0;
}
