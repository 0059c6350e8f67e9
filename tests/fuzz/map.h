/* map.h - what the harnesses of the readers of maps assert: whatever the bytes, they
 * are refused with a sentence and a line inside the input, or handed on as the sink's
 * contract has it: one terrain, rising heights, no empty levels or lines, finite
 * coordinates below the limit, spot heights in order; and when they are joined, rings of three vertices and
 * more, lines of two.
 *
 * What the user may say comes from the input, too, when that begins with OPTIONS:
 *   the byte 1;
 *   which attribute has the heights, by its place in a list of names;
 *   bits 0..1 --project, 2..3 --depth, 4..5 --high, 6 --layer;
 *   bits 0..3 --unit, 4..7 --z-unit, 0 or beyond all units: not given;
 *   --join: 0 not joined, else over this many less one.
 * Other inputs are the files themselves, and half of them, by their length, keep their
 * numbers, so that degrees reach the sink in both ways. */
#ifndef IL_FUZZ_MAP_H
#define IL_FUZZ_MAP_H

#include "base/text.h"
#include "input/reader.h"
#include "must.h"
#include "region/joiner.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* The contract as a sink: `calls` is where in it we are. */
typedef struct map_contract {
    il_sink sink;
    enum { BEFORE, INSIDE, BETWEEN, AFTER } calls;
    double z;
    bool is_joined;
} map_contract;

static inline void check_text(const char *s, const char *what)
{
    must(!s || il_utf8_valid(s, strlen(s)), what);
}

static inline void check_spots(const il_stack_head *h)
{
    for (size_t i = 0; i < h->n_spots; i++) {
        const il_spot *s = &h->spot[i], *before = s - (i > 0);
        must(fabs(s->x) < IL_COORDINATE_BOUND && fabs(s->y) < IL_COORDINATE_BOUND, "a spot beyond the limit");
        must(fabs(s->z) < IL_COORDINATE_BOUND, "a spot height beyond the limit");
        must(i == 0 || before->x < s->x || (before->x == s->x && before->y < s->y), "spots do not rise");
        must(s->file < h->n_files && s->feature > 0, "a spot of nowhere");
    }
}

static inline il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    map_contract *c = (map_contract *)self;
    (void)err;
    must(c->calls == BEFORE, "a second stack");
    must(head->kind == IL_KIND_TERRAIN && head->unit < IL_N_UNITS, "an unknown kind of stack");
    must(head->fault == NULL, "a map with a fault is refused");
    check_spots(head);
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

/* Lines and rings with too few points are for those who join. */
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
        must(!c->is_joined || s->ring[i].n >= (s->ring[i].open ? 2u : 3u), "a joined line too short");
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

/* ---- what the user says ----------------------------------------------------------- */

enum { OPTION_BYTES = 5 };

static const char *const fuzz_heights[] = { NULL, "z", "elev", "ELEV", "depth", "name", "-Z", "id", "a,b", "amin,amax", "low,high",
                                            "elev_min,elev_max", "z,elev", ",", "" };

/* The options that the first OPTION_BYTES of DATA say; the distance of --join, below 0
 * for none. */
static inline double take_options(const uint8_t *data, il_read_options *o)
{
    static const char *layers[] = { "*[1e]*" };
    o->map.height = fuzz_heights[data[1] % (sizeof fuzz_heights / sizeof *fuzz_heights)];
    o->map.project = (il_project)(data[2] & 3);
    o->map.depth = (il_depth)((data[2] >> 2 & 3) % 3);
    o->map.high = (il_side)((data[2] >> 4 & 3) % 3);
    if (data[2] & 0x40) {
        o->map.layer = layers;
        o->map.n_layers = 1;
    }
    unsigned unit = data[3] & 15, z_unit = data[3] >> 4;
    o->has_unit = unit > 0 && unit <= IL_N_UNITS;
    o->unit = o->has_unit ? (il_unit)(unit - 1) : IL_UNIT_MM;
    o->map.has_z_unit = z_unit > 0 && z_unit <= IL_N_UNITS && z_unit - 1 != IL_UNIT_DEG;
    o->map.z_unit = o->map.has_z_unit ? (il_unit)(z_unit - 1) : IL_UNIT_M;
    return data[4] - 1.0;
}

static inline il_status read_bytes(const il_reader *reader, const uint8_t *data, size_t n, const il_read_options *o,
                                   il_sink *sink, il_report *report, il_error *err)
{
    il_source *source = NULL;
    il_status st = il_source_from_memory(&source, data, n, "bytes", err);
    if (st == IL_OK)
        st = reader->read(&source, 1, o, sink, report, err);
    il_source_close(source);
    return st;
}

static inline void check_refusal(il_status st, const il_error *err, bool has_options, const uint8_t *data, size_t n)
{
    bool is_gzip = n >= 2 && data[0] == 0x1f && data[1] == 0x8b; /* its lines are not those of DATA */
    must(st == IL_E_INPUT || (has_options && st == IL_E_USAGE), "refused as something else");
    must(err->code == st && err->text[0], "refused without a reason");
    must(err->line >= 0 && (is_gzip || err->line <= count_lines(data, n)), "refused in a line that is not there");
}

static inline int fuzz_map(const il_reader *reader, const uint8_t *data, size_t n)
{
    map_contract c = { .sink = { on_stack, on_slice, on_pair, on_stack_end, on_end }, .calls = BEFORE };
    bool has_options = n >= OPTION_BYTES && data[0] == 1;
    il_read_options options = IL_READ_OPTIONS_INIT;
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    il_sink *joiner = NULL;
    il_status st = IL_OK;
    il_join_options join = { -1 };
    must(reader->is_map, "not the reader of a map");
    options.max_depth = 50;
    options.max_points = 200000;
    options.map.project = n % 2 == 0 ? IL_PROJECT_AUTO : IL_PROJECT_NONE;
    if (has_options) {
        join.distance = take_options(data, &options);
        data += OPTION_BYTES;
        n -= OPTION_BYTES;
    }
    c.is_joined = join.distance >= 0;
    if (c.is_joined)
        st = il_joiner_new(&joiner, &join, &c.sink, &report, &err);
    if (st == IL_OK)
        st = read_bytes(reader, data, n, &options, joiner ? joiner : &c.sink, &report, &err);
    il_joiner_free(joiner);
    il_report_free(&report);
    if (st != IL_OK)
        check_refusal(st, &err, has_options, data, n);
    must(st != IL_OK || c.calls == AFTER, "a stack was not ended");
    return 0;
}

#endif
