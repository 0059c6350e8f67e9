/* fuzz_keyhole.c - the bytes are the rings of a slice.  Whatever they are, opening
 * keyholes makes no vertex and no more rings than it counts channels, moves no more
 * area than the channels have, and leaves what il_slice_clean makes clean once and
 * for all.
 *
 * A vertex is three bytes, x, y and a tweak, on a grid of a half:
 *   bit 7      the ring ends here;
 *   bit 6      it is the vertex 1 + x back in its ring (as the way back along a
 *              channel is), and y says nothing;
 *   bits 3..5  y is so many times 0.01 further on, and bits 0..2 x.
 * So the sides of channels lie at, within and beyond the tolerance apart. */
#include "config.h"
#include "region/clean.h"
#include "region/keyhole.h"
#include "must.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { RING_ENDS = 0x80, COMES_BACK = 0x40, MOST_VERTICES = 250 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void add_vertex(il_ring *r, const uint8_t b[3])
{
    double x = b[0] / 2.0, y = b[1] / 2.0;
    if ((b[2] & COMES_BACK) && r->n > 0) {
        size_t k = r->n - 1 - b[0] % r->n;
        x = r->xy[2 * k], y = r->xy[2 * k + 1];
    }
    must(il_ring_add(r, x + 0.01 * (b[2] & 7), y + 0.01 * (b[2] >> 3 & 7), 0), "no memory");
}

static il_slice slice_of(const uint8_t *data, size_t n)
{
    il_slice s = IL_SLICE_INIT;
    il_ring *r = NULL;
    for (size_t i = 0; i + 3 <= n && i < 3 * MOST_VERTICES; i += 3) {
        if (!r)
            must((r = il_slice_add_ring(&s)) != NULL, "no memory");
        add_vertex(r, data + i);
        if (data[i + 2] & RING_ENDS)
            r = NULL;
    }
    return s;
}

static int has_point(const il_slice *s, const double *p)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++)
            if (memcmp(s->ring[i].xy + 2 * k, p, 2 * sizeof *p) == 0)
                return 1;
    return 0;
}

static void check_opened(const il_slice *opened, const il_slice *drawn, const il_report *report)
{
    must(opened->n <= drawn->n + report->repair[IL_REPAIR_KEYHOLE], "a channel makes several rings");
    for (size_t i = 0; i < opened->n; i++)
        for (size_t k = 0; k < opened->ring[i].n; k++)
            must(has_point(drawn, opened->ring[i].xy + 2 * k), "a vertex that was not drawn");
}

/* The rings' lengths together: no channel is longer than half of it. */
static double length_of(const il_slice *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++)
        sum += il_ring_length(&s->ring[i]);
    return sum;
}

/* False when crossings do not settle, which is told. */
static int clean(il_slice *s, il_report *report)
{
    static const il_clean_options options;
    il_error err = IL_ERROR_INIT;
    il_status st = il_slice_clean(s, &options, report, NULL, &err);
    must(st == IL_OK || (st == IL_E_INPUT && err.text[0]), "refused without a reason");
    return st == IL_OK;
}

static void check_clean(const il_slice *s)
{
    static const il_clean_options options;
    il_slice again = IL_SLICE_INIT;
    bool changed = true;
    must(il_slice_copy(&again, s, NULL) == IL_OK, "no memory");
    must(il_slice_clean(&again, &options, NULL, &changed, NULL) == IL_OK && !changed, "what is clean is cleaned again");
    must(again.n == s->n, "a ring comes or goes");
    for (size_t i = 0; i < s->n; i++)
        must(again.ring[i].n == s->ring[i].n &&
                 memcmp(again.ring[i].xy, s->ring[i].xy, 2 * s->ring[i].n * sizeof *s->ring[i].xy) == 0,
             "a vertex moves");
    il_slice_free(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    il_slice drawn = slice_of(data, n), s = IL_SLICE_INIT;
    il_report report = IL_REPORT_INIT;
    must(il_slice_copy(&s, &drawn, NULL) == IL_OK, "no memory");
    double length = length_of(&drawn);
    must(il_slice_open_keyholes(&s, IL_KEYHOLE_MM, &report, NULL) == IL_OK, "keyholes fail");
    check_opened(&s, &drawn, &report);
    if (clean(&s, &report) && clean(&drawn, &report)) {
        check_clean(&s);
        double moved = fabs(il_slice_area(&s) - il_slice_area(&drawn));
        /* Twins count once: a ring that runs round twice is nothing by parity, cut in two it is one. */
        must(report.repair[IL_REPAIR_DUPLICATE_RING] > 0 || moved <= IL_KEYHOLE_MM * length / 2 + 1e-6,
             "more area moves than channels have");
    }
    il_report_free(&report);
    il_slice_free(&s);
    il_slice_free(&drawn);
    return 0;
}
