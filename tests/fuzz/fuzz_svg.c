/* fuzz_svg.c - whatever the bytes, the SVG reader refuses them with a sentence
 * and a line inside the input, or hands on a stack as the sink's contract has
 * it: rising heights, finite coordinates below the limit, closed lines. */
#include "config.h"
#include "input/reader.h"
#include "must.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* The contract as a sink: `calls` is where in it we are. */
typedef struct contract {
    il_sink sink;
    enum { BEFORE, INSIDE, BETWEEN, AFTER } calls;
    double z;
} contract;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == BEFORE, "a second stack");
    must(head->unit == IL_UNIT_MM && head->kind == IL_KIND_SOLID, "an unknown kind of stack");
    c->calls = INSIDE;
    c->z = -INFINITY;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == INSIDE, "a slice outside a stack");
    must(fabs(s->z) < 1e15 && s->z > c->z, "heights do not rise");
    c->z = s->z;
    for (size_t i = 0; i < s->n; i++) {
        must(!s->ring[i].open && s->ring[i].n > 0, "a line is open, or empty");
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            must(fabs(s->ring[i].xy[v]) < 1e15, "a coordinate is beyond the limit");
    }
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self, (void)pair, (void)err;
    must(0, "a pair record");
    return IL_OK;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == INSIDE, "an end without a stack");
    c->calls = BETWEEN;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == BETWEEN, "an end inside a stack");
    c->calls = AFTER;
    return IL_OK;
}

static long count_lines(const uint8_t *data, size_t n)
{
    long lines = 1;
    for (size_t i = 0; i < n; i++)
        lines += data[i] == '\n';
    return lines;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    contract c = { { on_stack, on_slice, on_pair, on_stack_end, on_end }, BEFORE, 0 };
    il_read_options options = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source = NULL;
    options.has_spacing = n % 2 == 0; /* both ways to a height */
    options.spacing = 0.5;
    options.max_points = 200000;
    il_status st = il_source_from_memory(&source, data, n, "bytes", &err);
    if (st == IL_OK)
        st = il_reader_svg.read(&source, 1, &options, &c.sink, &report, &err);
    il_source_close(source);
    il_report_free(&report);
    if (st == IL_OK) {
        must(c.calls == AFTER, "a stack was not ended");
    } else {
        must(st == IL_E_INPUT && err.code == st && err.text[0], "refused without a reason");
        must(err.line >= 0 && err.line <= count_lines(data, n), "refused in a line that is not there");
    }
    return 0;
}
