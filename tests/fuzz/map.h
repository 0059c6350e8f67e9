/* map.h - what the harnesses of the readers of maps assert: whatever the bytes, they
 * are refused with a sentence and a line inside the input, or handed on as the sink's
 * contract has it: one terrain, rising heights, no empty levels or lines, finite
 * coordinates below the limit. */
#ifndef IL_FUZZ_MAP_H
#define IL_FUZZ_MAP_H

#include "base/text.h"
#include "input/reader.h"
#include "must.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* The contract as a sink: `calls` is where in it we are. */
typedef struct map_contract {
    il_sink sink;
    enum { BEFORE, INSIDE, BETWEEN, AFTER } calls;
    double z;
} map_contract;

static inline void check_text(const char *s, const char *what)
{
    must(!s || il_utf8_valid(s, strlen(s)), what);
}

static inline il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    map_contract *c = (map_contract *)self;
    (void)err;
    must(c->calls == BEFORE, "a second stack");
    must(head->kind == IL_KIND_TERRAIN && head->unit < IL_N_UNITS, "an unknown kind of stack");
    must(head->fault == NULL, "a map with a fault is refused");
    check_text(il_stack_head_name(head), "a name is not UTF-8");
    check_text(head->crs, "a coordinate system is not UTF-8");
    for (size_t k = 0; k < head->n_attributes; k++) {
        check_text(head->attribute[k].key, "a key is not UTF-8");
        check_text(head->attribute[k].value, "an attribute is not UTF-8");
    }
    c->calls = INSIDE;
    c->z = -INFINITY;
    return IL_OK;
}

/* Lines and rings with too few points are for those who clean and join. */
static inline il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    map_contract *c = (map_contract *)self;
    (void)err;
    must(c->calls == INSIDE, "a slice outside a stack");
    must(fabs(s->z) < IL_COORDINATE_BOUND && s->z > c->z, "heights do not rise");
    c->z = s->z;
    must(s->n > 0, "a level without lines");
    for (size_t i = 0; i < s->n; i++) {
        must(s->ring[i].n > 0, "a line without points");
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            must(fabs(s->ring[i].xy[v]) < IL_COORDINATE_BOUND, "a coordinate is beyond the limit");
    }
    return IL_OK;
}

static inline il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self, (void)pair, (void)err;
    must(0, "a pair record");
    return IL_OK;
}

static inline il_status on_stack_end(il_sink *self, il_error *err)
{
    map_contract *c = (map_contract *)self;
    (void)err;
    must(c->calls == INSIDE, "an end without a stack");
    c->calls = BETWEEN;
    return IL_OK;
}

static inline il_status on_end(il_sink *self, il_error *err)
{
    map_contract *c = (map_contract *)self;
    (void)err;
    must(c->calls == BETWEEN, "an end inside a stack");
    c->calls = AFTER;
    return IL_OK;
}

static inline long count_lines(const uint8_t *data, size_t n)
{
    long lines = 1;
    for (size_t i = 0; i < n; i++)
        lines += data[i] == '\n';
    return lines;
}

/* Half of the inputs, by their length, keep their numbers, so that degrees reach
 * the sink in both ways. */
static inline int fuzz_map(const il_reader *reader, const uint8_t *data, size_t n)
{
    map_contract c = { { on_stack, on_slice, on_pair, on_stack_end, on_end }, BEFORE, 0 };
    il_read_options options = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source = NULL;
    options.max_depth = 50;
    options.max_points = 200000;
    options.map.project = n % 2 == 0 ? IL_PROJECT_AUTO : IL_PROJECT_NONE;
    must(reader->is_map, "not the reader of a map");
    il_status st = il_source_from_memory(&source, data, n, "bytes", &err);
    if (st == IL_OK)
        st = reader->read(&source, 1, &options, &c.sink, &report, &err);
    il_source_close(source);
    il_report_free(&report);
    if (st == IL_OK) {
        must(c.calls == AFTER, "a stack was not ended");
    } else {
        bool is_gzip = n >= 2 && data[0] == 0x1f && data[1] == 0x8b; /* its lines are not those of DATA */
        must(st == IL_E_INPUT && err.code == st && err.text[0], "refused without a reason");
        must(err.line >= 0 && (is_gzip || err.line <= count_lines(data, n)), "refused in a line that is not there");
    }
    return 0;
}

#endif
