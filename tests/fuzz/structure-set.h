/* structure-set.h - what the harnesses of the readers of structure sets assert:
 * whatever the bytes, they are refused with a sentence and a line inside the
 * input, or handed on as the sink's contract has it: rising heights, finite
 * coordinates, closed rings of three points or more, right-handed frames. */
#ifndef IL_FUZZ_STRUCTURE_SET_H
#define IL_FUZZ_STRUCTURE_SET_H

#include "base/text.h"
#include "input/reader.h"
#include "must.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The contract as a sink: `calls` is where in it we are. */
typedef struct contract {
    il_sink sink;
    enum { BETWEEN, INSIDE, AFTER } calls;
    int has_fault;
    double z;
} contract;

static inline void check_frame(const il_stack_head *h)
{
    const double *a = h->frame + 3, *b = h->frame + 6, *c = h->frame + 9;
    for (size_t i = 0; i < 3; i++) {
        size_t j = (i + 1) % 3, k = (i + 2) % 3;
        must(fabs(a[j] * b[k] - a[k] * b[j] - c[i]) < 1e-12, "a frame is not right-handed");
    }
}

static inline il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == BETWEEN, "a stack inside a stack");
    must(head->unit == IL_UNIT_MM && head->kind == IL_KIND_SOLID, "an unknown kind of stack");
    must(il_utf8_valid(il_stack_head_name(head), strlen(il_stack_head_name(head))), "a name is not UTF-8");
    for (size_t k = 0; k < head->n_attributes; k++)
        must(il_utf8_valid(head->attribute[k].value, strlen(head->attribute[k].value)), "an attribute is not UTF-8");
    must(head->usual_spacing >= 0, "a negative spacing");
    if (head->has_frame)
        check_frame(head);
    c->has_fault = head->fault != NULL;
    c->calls = INSIDE;
    c->z = -INFINITY;
    return IL_OK;
}

static inline il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == INSIDE && !c->has_fault, "a slice outside a stack, or in one with a fault");
    must(fabs(s->z) < 2e15 && s->z > c->z, "heights do not rise");
    c->z = s->z;
    must(s->n > 0, "a slice without contours");
    for (size_t i = 0; i < s->n; i++) {
        must(!s->ring[i].open && s->ring[i].n >= 3, "a line is open, or no ring");
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            must(fabs(s->ring[i].xy[v]) < 2e15, "a coordinate is beyond the limit");
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
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == INSIDE, "an end without a stack");
    c->calls = BETWEEN;
    return IL_OK;
}

static inline il_status on_end(il_sink *self, il_error *err)
{
    contract *c = (contract *)self;
    (void)err;
    must(c->calls == BETWEEN, "an end inside a stack");
    c->calls = AFTER;
    return IL_OK;
}

static inline int fuzz_structure_set(const il_reader *reader, const uint8_t *data, size_t n)
{
    contract c = { { on_stack, on_slice, on_pair, on_stack_end, on_end }, BETWEEN, 0, 0 };
    il_read_options options = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_source *source = NULL;
    long lines = 1;
    for (size_t i = 0; i < n; i++)
        lines += data[i] == '\n';
    options.max_depth = 50;
    il_status st = il_source_from_memory(&source, data, n, "bytes", &err);
    if (st == IL_OK)
        st = reader->read(&source, 1, &options, &c.sink, &report, &err);
    il_source_close(source);
    il_report_free(&report);
    if (st == IL_OK) {
        must(c.calls == AFTER, "a stack was not ended");
    } else {
        must(st == IL_E_INPUT && err.code == st && err.text[0], "refused without a reason");
        must(err.line >= 0 && err.line <= lines, "refused in a line that is not there");
    }
    return 0;
}

#endif
