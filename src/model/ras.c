#include "config.h"
#include "model/ras.h"
#include "base/alloc.h"

#include <string.h>

typedef struct ras_stage {
    il_sink sink;
    il_sink *next;
    il_report *report;
    bool told;
} ras_stage;

/* Subtraction from 0 leaves no -0 behind. */
static void turn_frame(il_stack_head *h)
{
    static const double along_the_axes[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    if (!h->has_frame)
        memcpy(h->frame, along_the_axes, sizeof h->frame);
    h->has_frame = true;
    for (int k = 0; k < 12; k++)
        h->frame[k] = k % 3 < 2 ? 0 - h->frame[k] : h->frame[k];
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    ras_stage *s = (ras_stage *)self;
    il_stack_head copy = IL_STACK_HEAD_INIT;
    il_status st = il_stack_head_copy(&copy, head, err);
    if (st == IL_OK && !il_stack_head_add_attribute(&copy, IL_ATTRIBUTE_COORDINATES, "RAS"))
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        turn_frame(&copy);
        if (!s->told)
            il_report_note(s->report, "coordinates are RAS: x to the patient's right, y to the front");
        s->told = true;
        st = s->next->stack_begin(s->next, &copy, err);
    }
    il_stack_head_free(&copy);
    return st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    ras_stage *s = (ras_stage *)self;
    return s->next->slice(s->next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    ras_stage *s = (ras_stage *)self;
    return s->next->pair(s->next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    ras_stage *s = (ras_stage *)self;
    return s->next->stack_end(s->next, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    ras_stage *s = (ras_stage *)self;
    return s->next->end(s->next, err);
}

il_status il_ras_new(il_sink **out, il_sink *next, il_report *report, il_error *err)
{
    *out = NULL;
    ras_stage *s = il_calloc(1, sizeof *s);
    if (!s)
        return il_fail_nomem(err);
    *s = (ras_stage){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, next, report, false };
    *out = &s->sink;
    return IL_OK;
}

void il_ras_free(il_sink *s)
{
    il_free(s);
}
