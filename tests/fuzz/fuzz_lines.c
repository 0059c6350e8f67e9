/* fuzz_lines.c - the bytes are the isolines of a level.  Whatever they are, joining
 * them leaves lines of two vertices or more and rings of three or more, no edge twice,
 * none that was not there (but for bridged gaps), and, where no dead ends are dropped,
 * all that were there once (of those that were there twice, necks go); the order and, of rings, the start of the lines change nothing; and
 * what comes out comes out again.
 *
 * The first byte: ends are joined over so many eighths.  A vertex is two bytes: x and y,
 * four bits each, on a grid of ones; and
 *   bit 7      the line ends here;
 *   bit 6      it is a ring then;
 *   bits 0..1  the vertex's marks. */
#include "config.h"
#include "model/order.h"
#include "region/joiner.h"
#include "must.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_ENDS = 0x80, IS_RING = 0x40, MOST_VERTICES = 200 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static il_slice slice_of(const uint8_t *data, size_t n)
{
    il_slice s = IL_SLICE_INIT;
    il_ring *r = NULL;
    for (size_t i = 0; i + 2 <= n && i < 2 * MOST_VERTICES; i += 2) {
        if (!r) {
            must((r = il_slice_add_ring(&s)) != NULL, "no memory");
            r->open = true;
        }
        must(il_ring_add(r, data[i] & 15, data[i] >> 4, data[i + 1] & 3), "no memory");
        r->open = !(data[i + 1] & IS_RING);
        if (data[i + 1] & LINE_ENDS)
            r = NULL;
    }
    return s;
}

/* The lines the other way up, rings begun elsewhere. */
static il_slice in_another_order(const il_slice *s)
{
    il_slice other = IL_SLICE_INIT;
    must(il_slice_copy(&other, s, NULL) == IL_OK, "no memory");
    for (size_t i = 0; i < s->n; i++) {
        il_ring *r = &other.ring[i];
        if (!r->open && r->n > 0)
            il_ring_rotate(r, r->n / 2);
        if (i < s->n / 2) {
            il_ring swap = *r;
            *r = other.ring[s->n - 1 - i];
            other.ring[s->n - 1 - i] = swap;
        }
    }
    return other;
}

static int has_edge(const il_slice *s, const double *a, const double *b, size_t but_line, size_t but_vertex)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = s->ring[i].open, n = s->ring[i].n; k < n; k++) {
            const double *p = s->ring[i].xy + 2 * (k > 0 ? k - 1 : n - 1), *q = s->ring[i].xy + 2 * k;
            int same = (il_vertex_compare(a, p) == 0 && il_vertex_compare(b, q) == 0) ||
                       (il_vertex_compare(a, q) == 0 && il_vertex_compare(b, p) == 0);
            if (same && (i != but_line || k != but_vertex))
                return 1;
        }
    return 0;
}

/* Are all edges of S, or those that it has once, among those of IN? */
static int all_edges_are_in(const il_slice *s, const il_slice *in, bool once)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = s->ring[i].open, n = s->ring[i].n; k < n; k++) {
            const double *p = s->ring[i].xy + 2 * (k > 0 ? k - 1 : n - 1), *q = s->ring[i].xy + 2 * k;
            if (il_vertex_compare(p, q) != 0 && !has_edge(in, p, q, SIZE_MAX, 0) && !(once && has_edge(s, p, q, i, k)))
                return 0;
        }
    return 1;
}

static void check_lines(const il_slice *s)
{
    must(il_slice_in_order(s), "not in order");
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        must(r->n >= (r->open ? 2u : 3u), "a line too short");
        must(!r->open || il_vertex_compare(r->xy, r->xy + 2 * (r->n - 1)) != 0, "a ring that is open");
        for (size_t k = r->open; k < r->n; k++) {
            const double *p = r->xy + 2 * (k > 0 ? k - 1 : r->n - 1), *q = r->xy + 2 * k;
            must(il_vertex_compare(p, q) != 0, "an edge without a length");
            must(!has_edge(s, p, q, i, k), "an edge twice");
        }
    }
}

static int same_points(const il_slice *a, const il_slice *b)
{
    for (size_t i = 0; i < a->n && a->n == b->n; i++)
        if (a->ring[i].n != b->ring[i].n || a->ring[i].open != b->ring[i].open ||
            memcmp(a->ring[i].xy, b->ring[i].xy, 2 * a->ring[i].n * sizeof *a->ring[i].xy) != 0)
            return 0;
    return a->n == b->n;
}

static void join(il_slice *s, double distance, il_report *report, bool *changed)
{
    const il_join_options o = { distance };
    double largest = 0;
    must(il_slice_join(s, &o, report, changed, &largest, NULL) == IL_OK, "joining fails");
    must(largest <= distance, "a gap too wide");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    double distance = n > 0 ? data[0] / 8.0 : 0;
    il_slice drawn = slice_of(data + (n > 0), n - (n > 0)), s = IL_SLICE_INIT, other = in_another_order(&drawn);
    il_report report = IL_REPORT_INIT, report_of_other = IL_REPORT_INIT;
    bool changed = true;
    must(il_slice_copy(&s, &drawn, NULL) == IL_OK, "no memory");
    join(&s, distance, &report, NULL);
    check_lines(&s);
    must(report.repair[IL_REPAIR_BRIDGED_GAP] > 0 || all_edges_are_in(&s, &drawn, false), "an edge that was not there");
    must(report.repair[IL_REPAIR_SPIKE] + report.repair[IL_REPAIR_DEGENERATE_RING] > 0 || all_edges_are_in(&drawn, &s, true),
         "an edge lost");
    join(&other, distance, &report_of_other, NULL);
    must(same_points(&s, &other), "the order of the lines matters");
    must(memcmp(report.repair, report_of_other.repair, sizeof report.repair) == 0, "the order of the lines counts");
    il_slice_free(&other);
    must(il_slice_copy(&other, &s, NULL) == IL_OK, "no memory");
    join(&s, 0, NULL, &changed);
    must(!changed && same_points(&s, &other), "what is joined is joined again");
    il_slice_free(&s);
    il_slice_free(&other);
    il_slice_free(&drawn);
    return 0;
}
