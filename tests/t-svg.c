/* The SVG reader as a whole: heights, units, what is skipped, hostile input. */
#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "input/reader.h"
#include "input/svg-level.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* ---- a sink that writes down what it gets ------------------------------------- */

/* One line a record: "stack NAME UNIT", "slice Z", "ring x y,x y,...", "end". */
typedef struct recorder {
    il_sink sink;
    char *text;
    size_t n, cap;
    long calls_left;        /* fail after so many; negative: never */
} recorder;

static void say(recorder *r, const char *s)
{
    size_t n = strlen(s);
    while (r->n + n + 1 > r->cap) {
        r->cap = 2 * r->cap + 256;
        r->text = realloc(r->text, r->cap);
        assert_non_null(r->text);
    }
    memcpy(r->text + r->n, s, n + 1);
    r->n += n;
}

static void say_number(recorder *r, double v)
{
    char text[IL_NUMBER_MAX];
    assert_true(isfinite(v) && !(v == 0 && signbit(v)));
    il_number_format(text, v);
    say(r, text);
}

static il_status count_call(recorder *r, il_error *err)
{
    if (r->calls_left == 0)
        return il_fail(err, IL_E_IO, 0, "the sink is full");
    r->calls_left -= r->calls_left > 0 ? 1 : 0;
    return IL_OK;
}

static il_status record_stack(il_sink *self, const il_stack_head *h, il_error *err)
{
    recorder *r = (recorder *)self;
    assert_int_equal(h->kind, IL_KIND_SOLID);
    say(r, "stack "), say(r, il_stack_head_name(h)), say(r, " "), say(r, il_unit_name(h->unit)), say(r, "\n");
    return count_call(r, err);
}

static il_status record_slice(il_sink *self, il_slice *s, il_error *err)
{
    recorder *r = (recorder *)self;
    say(r, "slice "), say_number(r, s->z), say(r, "\n");
    for (size_t i = 0; i < s->n; i++) {
        assert_false(s->ring[i].open);
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            say(r, v == 0 ? "ring " : v % 2 ? " " : ","), say_number(r, s->ring[i].xy[v]);
        say(r, "\n");
    }
    return count_call(r, err);
}

static il_status record_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)pair;
    return count_call((recorder *)self, err);
}

static il_status record_stack_end(il_sink *self, il_error *err)
{
    return count_call((recorder *)self, err);
}

static il_status record_end(il_sink *self, il_error *err)
{
    say((recorder *)self, "end\n");
    return count_call((recorder *)self, err);
}

static recorder new_recorder(void)
{
    return (recorder){ { record_stack, record_slice, record_pair, record_stack_end, record_end }, NULL, 0, 0, -1 };
}

/* ---- reading from memory --------------------------------------------------------- */

typedef struct result {
    recorder rec;
    il_report report;
    il_error err;
    il_status status;
} result;

static void free_result(result *r)
{
    free(r->rec.text);
    il_report_free(&r->report);
}

static result read_bytes(const char *const *data, const size_t *size, size_t n, const il_read_options *o)
{
    static const char *const names[] = { "a.svg", "b.svg", "c.svg", "d.svg" };
    result r = { new_recorder(), IL_REPORT_INIT, IL_ERROR_INIT, IL_OK };
    il_source *source[4] = { NULL };
    for (size_t i = 0; i < n; i++)
        assert_int_equal(il_source_from_memory(&source[i], data[i], size[i], names[i], &r.err), IL_OK);
    r.status = il_reader_svg.read(source, n, o, &r.rec.sink, &r.report, &r.err);
    assert_int_equal(r.status, r.err.code);
    for (size_t i = 0; i < n; i++)
        il_source_close(source[i]);
    return r;
}

static result read_with(const char *svg, il_read_options o)
{
    size_t n = strlen(svg);
    return read_bytes(&svg, &n, 1, &o);
}

static result read_plain(const char *svg)
{
    return read_with(svg, (il_read_options)IL_READ_OPTIONS_INIT);
}

static il_read_options with_spacing(double spacing)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.has_spacing = true;
    o.spacing = spacing;
    return o;
}

static void assert_reads(result r, const char *svg, const char *text)
{
    if (r.status != IL_OK)
        fail_msg("%s\n%s:%ld: %s", svg, r.err.file, r.err.line, r.err.text);
    assert_string_equal(r.rec.text, text);
    free_result(&r);
}

static void assert_refused(result r, const char *svg, long line, const char *words)
{
    if (r.status != IL_E_INPUT)
        fail_msg("status %d: %s\n%s", r.status, svg, r.rec.text ? r.rec.text : "");
    if (r.err.line != line || !strstr(r.err.text, words))
        fail_msg("%s\nsaid %s:%ld: %s", svg, r.err.file, r.err.line, r.err.text);
    assert_string_equal(r.err.file, "a.svg");
    free_result(&r);
}

/* ---- heights ------------------------------------------------------------------------ */

#define SQUARE "points='0,0 1,0 1,1'"
#define RING "ring 0 0,1 0,1 -1\n"          /* SQUARE with y up */
#define SLIC3R "xmlns:slic3r='http://slic3r.org/namespaces/slic3r'"
#define INKSCAPE "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'"

static void heights_come_from_the_nearest_attribute(void **state)
{
    (void)state;
    static const struct { const char *svg; const char *z; } c[] = {
        { "<svg><polygon data-z='2.5' " SQUARE "/></svg>", "2.5" },
        { "<svg><polygon z='-2.5' " SQUARE "/></svg>", "-2.5" },
        { "<svg><g data-z=' 3 '><polygon " SQUARE "/></g></svg>", "3" },
        { "<svg><g data-z='3'><polygon data-z='4' " SQUARE "/></g></svg>", "4" },
        { "<svg data-z='9'><g><g data-z='3'><g><polygon " SQUARE "/></g></g></g></svg>", "3" },
        { "<svg data-z='9'><polygon " SQUARE "/></svg>", "9" },
        { "<svg><polygon z='1' data-z='2' " SQUARE "/></svg>", "2" },
        { "<svg><g id='layer7' data-z='2'><polygon " SQUARE "/></g></svg>", "2" },
        { "<svg><g data-z='2'><g id='layer7'><polygon " SQUARE "/></g></g></svg>", "2" }, /* before any name */
        { "<svg><polygon z='-0' " SQUARE "/></svg>", "0" },
        { "<svg><polygon z='1e3' " SQUARE "/></svg>", "1000" },
        { "<svg><g id='layer12'><polygon " SQUARE "/></g></svg>", "12" },
        { "<svg><g id='z=3.5'><polygon " SQUARE "/></g></svg>", "3.5" },
        { "<svg><g id='layer1'><g id='layer2'><polygon " SQUARE "/></g></g></svg>", "2" },
        { "<svg " INKSCAPE "><g id='layer1' inkscape:label='z=3.5'><polygon " SQUARE "/></g></svg>", "3.5" },
        { "<svg><g id='layer1' inkscape:label='4.25'><polygon " SQUARE "/></g></svg>", "4.25" },
        { "<svg><g id='g1043'><polygon " SQUARE "/></g></svg>", "0" },
        { "<svg><polygon " SQUARE "/></svg>", "0" },
        { "<polygon z='6' " SQUARE "/>", "6" },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[256];
        snprintf(text, sizeof text, "stack  mm\nslice %s\n" RING "end\n", c[i].z);
        assert_reads(read_plain(c[i].svg), c[i].svg, text);
    }
}

static void names_are_heights_or_numbers_of_slices(void **state)
{
    (void)state;
    static const struct { const char *name; il_svg_level_kind kind; double value; } c[] = {
        { "layer12", IL_SVG_LEVEL_ORDINAL, 12 }, { "Layer 3", IL_SVG_LEVEL_ORDINAL, 3 },
        { "slice_0001", IL_SVG_LEVEL_ORDINAL, 1 }, { "my layer-7", IL_SVG_LEVEL_ORDINAL, 7 },
        { "Section #4", IL_SVG_LEVEL_ORDINAL, 4 }, { "LEVEL:5", IL_SVG_LEVEL_ORDINAL, 5 },
        { "z=3.5", IL_SVG_LEVEL_HEIGHT, 3.5 }, { "z3.5", IL_SVG_LEVEL_HEIGHT, 3.5 },
        { "Z = -3.5 mm", IL_SVG_LEVEL_HEIGHT, -3.5 },
        { "z-1", IL_SVG_LEVEL_HEIGHT, -1 }, { "height_2e1", IL_SVG_LEVEL_HEIGHT, 20 },
        { "layer 3 (z=0.6)", IL_SVG_LEVEL_HEIGHT, 0.6 },
        { "layer12mm", IL_SVG_LEVEL_ORDINAL, 12 }, { "42", IL_SVG_LEVEL_HEIGHT, 42 },
        { "-1.5", IL_SVG_LEVEL_HEIGHT, -1.5 },
        { "g1043", IL_SVG_LEVEL_NONE, 0 }, { "path12", IL_SVG_LEVEL_NONE, 0 }, { "layer", IL_SVG_LEVEL_NONE, 0 },
        { "layerA", IL_SVG_LEVEL_NONE, 0 }, { "layer12b", IL_SVG_LEVEL_NONE, 0 },
        { "multilayer2", IL_SVG_LEVEL_NONE, 0 },
        { "layer1.2.3", IL_SVG_LEVEL_NONE, 0 }, { "", IL_SVG_LEVEL_NONE, 0 }, { "z=1e400", IL_SVG_LEVEL_NONE, 0 },
        { "z=1e15", IL_SVG_LEVEL_NONE, 0 }, { "12 monkeys", IL_SVG_LEVEL_NONE, 0 },
        { "\xC3\xA9z=3", IL_SVG_LEVEL_NONE, 0 } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        double v = 0;
        il_svg_level_kind kind = il_svg_level_of_name(c[i].name, strlen(c[i].name), true, &v);
        if (kind != c[i].kind || (kind != IL_SVG_LEVEL_NONE && v != c[i].value))
            fail_msg("%s: %d %g", c[i].name, kind, v);
    }
    double v;
    assert_int_equal(il_svg_level_of_name("42", 2, false, &v), IL_SVG_LEVEL_NONE);
}

static void numbers_of_slices_count_spacings(void **state)
{
    (void)state;
    const char *svg = "<svg><g id='layer2'><polygon " SQUARE "/></g><g id='layer10'><polygon " SQUARE "/></g></svg>";
    assert_reads(read_with(svg, with_spacing(0.5)), svg, "stack  mm\nslice 1\n" RING "slice 5\n" RING "end\n");
    result r = read_plain(svg);
    assert_int_equal(r.report.n_notes, 2);
    assert_reads(r, svg, "stack  mm\nslice 2\n" RING "slice 10\n" RING "end\n");
}

static void document_order_counts_spacings(void **state)
{
    (void)state;
    static const char *const c[] = {
        "<svg><title/><g><polygon " SQUARE "/></g><defs><polygon " SQUARE "/></defs><polygon " SQUARE "/></svg>",
        "<g><polygon " SQUARE "/></g><polygon " SQUARE "/>",
        "<svg><polygon " SQUARE "/></svg><svg><polygon " SQUARE "/></svg>",
        "<?xml version='1.0'?>\n<!-- x --><polygon " SQUARE "/>\n<polygon " SQUARE "/>\n",
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        assert_reads(read_with(c[i], with_spacing(2)), c[i], "stack  mm\nslice 0\n" RING "slice 2\n" RING "end\n");
        result r = read_plain(c[i]);
        assert_int_equal(r.status, IL_E_INPUT);
        assert_non_null(strstr(r.err.text, "--spacing"));
        free_result(&r);
    }
}

static void several_files_are_several_slices(void **state)
{
    (void)state;
    const char *const svg[] = { "<svg><polygon " SQUARE "/><g><polygon " SQUARE "/></g></svg>", "<polygon " SQUARE "/>",
                                "<svg><title>third</title><polygon " SQUARE "/></svg>" };
    const size_t n[] = { strlen(svg[0]), strlen(svg[1]), strlen(svg[2]) };
    il_read_options o = with_spacing(1.5);
    assert_reads(read_bytes(svg, n, 3, &o), svg[0],
                 "stack third mm\nslice 0\n" RING RING "slice 1.5\n" RING "slice 3\n" RING "end\n");
    o.has_spacing = false;
    assert_refused(read_bytes(svg, n, 3, &o), svg[0], 1, "--spacing");
}

static void files_with_heights_are_one_stack(void **state)
{
    (void)state;
    const char *const svg[] = { "<svg><polygon data-z='5' " SQUARE "/></svg>",
        "<svg><polygon data-z='1' " SQUARE "/></svg>" };
    const size_t n[] = { strlen(svg[0]), strlen(svg[1]) };
    il_read_options o = IL_READ_OPTIONS_INIT;
    result r = read_bytes(svg, n, 2, &o);
    assert_int_equal(r.report.repair[IL_REPAIR_REORDERED_SLICE], 1);
    assert_reads(r, svg[0], "stack  mm\nslice 1\n" RING "slice 5\n" RING "end\n");
    const char *const half[] = { svg[0], "<svg>\n<polygon " SQUARE "/></svg>" };
    const size_t m[] = { n[0], strlen(half[1]) };
    r = read_bytes(half, m, 2, &o);
    assert_int_equal(r.status, IL_E_INPUT);
    assert_string_equal(r.err.file, "b.svg");
    assert_int_equal(r.err.line, 2);
    free_result(&r);
}

static void slices_are_sorted_and_merged_and_counted(void **state)
{
    (void)state;
    const char *svg = "<svg><g z='3'><polygon " SQUARE "/></g><g z='1'><polygon " SQUARE "/></g><g z='2'/>"
                      "<g z='1'><circle r='0'/><rect width='2' height='1'/></g><polygon z='3' " SQUARE "/></svg>";
    result r = read_plain(svg);
    assert_int_equal(r.report.repair[IL_REPAIR_REORDERED_SLICE], 3);
    assert_int_equal(r.report.repair[IL_REPAIR_MERGED_SLICE], 1); /* a single element joins its height's slice */
    assert_reads(r, svg, "stack  mm\nslice 1\n" RING "ring 0 0,2 0,2 -1,0 -1\nslice 2\nslice 3\n" RING RING "end\n");
}

static void an_empty_group_with_a_height_is_an_empty_slice(void **state)
{
    (void)state;
    const char *svg = "<svg><g z='0'/><g z='1'><polygon " SQUARE "/></g><g z='2'><!-- nothing --></g><g z='2.5'>"
        "<text>x</text></g>"
                      "<g z='3'><polygon " SQUARE "/></g><g z='4'/></svg>";
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 1\n" RING "slice 2\nslice 3\n" RING "end\n");
    svg = "<svg><g/><g><polygon " SQUARE "/></g><g/><g><polygon " SQUARE "/></g></svg>";
    assert_reads(read_with(svg, with_spacing(1)), svg, "stack  mm\nslice 1\n" RING "slice 2\nslice 3\n" RING "end\n");
}

/* ---- slic3r ---------------------------------------------------------------------------- */

static void slic3r_heights_are_millionths_and_y_points_up(void **state)
{
    (void)state;
    const char *svg = "<svg " SLIC3R "><g id='layer0' slic3r:z='1.5e-07'><polygon slic3r:type='contour' " SQUARE "/>"
        "</g>"
                      "<g id='layer1' slic3r:z='4.5e-07'><polygon slic3r:type='contour' " SQUARE "/></g></svg>";
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 0.15\nring 0 0,1 0,1 1\nslice 0.45\nring 0 0,1 0,1 1\nend\n");
    svg = "<g id='layer0' slic3r:z='2e-07'><polygon " SQUARE "/></g>"; /* a piece of one: no declaration */
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 0.2\nring 0 0,1 0,1 1\nend\n");
    svg = "<svg xmlns:q='http://slic3r.org/namespaces/slic3r'><g q:z='2e-07' data-z='7'><polygon " SQUARE "/></g>"
        "</svg>";
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 7\nring 0 0,1 0,1 1\nend\n");
    svg = "<svg width='5mm' height='5mm' viewBox='0 0 1 1' " SLIC3R "><g slic3r:z='2e-07'><polygon " SQUARE "/></g>"
        "</svg>";
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 0.2\nring 0 0,1 0,1 1\nend\n");
}

static void relatives_of_slic3r_write_millimetres(void **state)
{
    (void)state;
    const char *svg = "<svg " SLIC3R "><g slic3r:z='0'><polygon " SQUARE "/></g><g slic3r:z='0.3'>"
        "<polygon " SQUARE "/></g></svg>";
    result r = read_plain(svg);
    assert_int_equal(r.report.n_notes, 1);
    assert_reads(r, svg, "stack  mm\nslice 0\nring 0 0,1 0,1 1\nslice 0.3\nring 0 0,1 0,1 1\nend\n");
    svg = "<svg " SLIC3R "><g slic3r:z='0.3000' slic3r:slice-z='0.1500' slic3r:layer-height='0.3'>"
          "<path d='M 0 0 1 0 1 1 z'/></g></svg>"; /* its plates have y down */
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 0.15\n" RING "end\n");
}

static void millionths_are_rounded_once(void **state)
{
    (void)state;
    for (int i = -20000; i <= 20000; i += 7) {
        char text[64];
        double z = i / 1000.0, got = 99;
        snprintf(text, sizeof text, "%de-9", i);
        assert_int_equal(il_svg_parse_millionths(text, strlen(text), &got), strlen(text));
        assert_true(got == z);
        snprintf(text, sizeof text, "%.9gx", z * 1e-6);
        assert_int_equal(il_svg_parse_millionths(text, strlen(text), &got), strlen(text) - 1);
        assert_true(got == z);
    }
}

/* ---- units and places ---------------------------------------------------------------------- */

static void y_is_turned_unless_told_otherwise(void **state)
{
    (void)state;
    const char *svg = "<polygon z='0' points='1.5,2.5 3,-1e-9 0,0'/>";
    assert_reads(read_plain(svg), svg, "stack  mm\nslice 0\nring 1.5 -2.5,3 1e-09,0 0\nend\n");
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.no_flip = true;
    assert_reads(read_with(svg, o), svg, "stack  mm\nslice 0\nring 1.5 2.5,3 -1e-09,0 0\nend\n");
}

static void a_physical_size_scales_to_millimetres(void **state)
{
    (void)state;
    static const struct { const char *attributes, *ring; bool is_noted; } c[] = {
        { "", "ring 8 -4,0 -4,0 0", true },
        { "width='100' height='50' viewBox='0 0 10 5'", "ring 8 -4,0 -4,0 0", true },
        { "width='100mm' height='50mm'", "ring 8 -4,0 -4,0 0", true },
        { "width='100px' height='50px' viewBox='0 0 10 5'", "ring 8 -4,0 -4,0 0", true },
        { "width='100%' viewBox='0 0 10 5'", "ring 8 -4,0 -4,0 0", true },
        { "width='100mm' height='50mm' viewBox='0 0 100 50'", "ring 8 -4,0 -4,0 0", false },
        { "width='100mm' height='50mm' viewBox='-5 7 200 100'", "ring 4 -2,0 -2,0 0", false },
        { "width='10cm' height='5cm' viewBox='0 0 50 25'", "ring 16 -8,0 -8,0 0", false },
        { "width='2in' viewBox='0,0,25.4,10'", "ring 16 -8,0 -8,0 0", false },
        { "height='2in' viewBox='0 0 10 25.4'", "ring 16 -8,0 -8,0 0", false },
        { "width='72pt' height='6pc' viewBox='0 0 12.7 12.7'", "ring 16 -8,0 -8,0 0", false },
        { "width='400Q' height='100mm' viewBox='0 0 100 25'", "ring 8 -4,0 -4,0 0", false },
        { "width='400Q' height='100mm' viewBox='0 0 100 25' preserveAspectRatio='none'", "ring 8 -16,0 -16,0 0",
          false },
        { "width='400Q' height='100mm' viewBox='0 0 100 25' preserveAspectRatio='xMinYMax slice'",
          "ring 32 -16,0 -16,0 0", false },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char svg[512], text[256];
        snprintf(svg, sizeof svg, "<svg %s><polygon z='3' points='8,4 0,4 0,0'/></svg>", c[i].attributes);
        snprintf(text, sizeof text, "stack  mm\nslice 3\n%s\nend\n", c[i].ring);
        result r = read_plain(svg);
        assert_int_equal(r.report.n_notes, c[i].is_noted);
        assert_reads(r, svg, text);
    }
}

static void the_unit_can_be_told(void **state)
{
    (void)state;
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.has_unit = true;
    o.unit = IL_UNIT_IN;
    const char *svg = "<svg width='100mm' height='50mm' viewBox='0 0 200 100'><polygon z='3' points='8,4 0,4 0,0'/>"
        "</svg>";
    result r = read_with(svg, o);
    assert_int_equal(r.report.n_notes, 0);
    assert_reads(r, svg, "stack  in\nslice 3\nring 8 -4,0 -4,0 0\nend\n");
}

static void groups_and_viewports_nest(void **state)
{
    (void)state;
    static const struct { const char *svg, *ring; } c[] = {
        { "<g transform='translate(10)'><g transform='scale(2)'>"
            "<polygon transform='translate(0 3)' points='1,1 0,1 0,0'/></g></g>",
          "ring 12 -8,10 -8,10 -6" },
        { "<svg x='5' y='6'><polygon points='1,1 0,1 0,0'/></svg>", "ring 6 -7,5 -7,5 -6" },
        { "<svg x='5' y='6' width='20' height='20' viewBox='1 1 10 10'><polygon points='2,2 1,2 1,1'/></svg>",
          "ring 7 -8,5 -8,5 -6" },
        { "<svg width='30' height='20' viewBox='0 0 10 10'><polygon points='1,1 0,1 0,0'/></svg>",
          "ring 7 -2,5 -2,5 0" },
        { "<svg width='30' height='20' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMin meet'>"
            "<polygon points='1,1 0,1 0,0'/></svg>",
          "ring 12 -2,10 -2,10 0" },
        { "<svg width='30' height='20' viewBox='0 0 10 10' preserveAspectRatio='none'><polygon points='1,1 0,1 0,0'/>"
            "</svg>",
          "ring 3 -2,0 -2,0 0" },
        { "<svg width='30' height='20' viewBox='0 0 10 10' preserveAspectRatio='xMidYMid slice'>"
            "<polygon points='1,6 0,6 0,5'/></svg>",
          "ring 3 -13,0 -13,0 -10" },
        { "<svg transform='scale(2)' x='1'><polygon points='1,1 0,1 0,0'/></svg>", "ring 4 -2,2 -2,2 0" },
        { "<svg viewBox='0 0 50 50'><polygon points='1,1 0,1 0,0'/></svg>", "ring 2 -2,0 -2,0 0" },
          /* 100 % of the outer 100 */
        { "<svg width='50%' height='50%' viewBox='0 0 10 10'><polygon points='1,1 0,1 0,0'/></svg>",
          "ring 5 -5,0 -5,0 0" },
        { "<a><switch><polygon points='1,1 0,1 0,0'/></switch></a>", "ring 1 -1,0 -1,0 0" },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char svg[512], text[256];
        snprintf(svg, sizeof svg, "<svg viewBox='0 0 100 100' data-z='0'>%s</svg>", c[i].svg);
        snprintf(text, sizeof text, "stack  mm\nslice 0\n%s\nend\n", c[i].ring);
        assert_reads(read_plain(svg), svg, text);
    }
}

/* ---- shapes -------------------------------------------------------------------------------- */

static void every_shape_is_drawn(void **state)
{
    (void)state;
    static const struct { const char *shape, *rings; } c[] = {
        { "<polygon points='0 0 1 0 1 1'/>", "ring 0 0,1 0,1 1\n" },
        { "<polygon points='0,0 1,0 1,1 0,0'/>", "ring 0 0,1 0,1 1\n" },
        { "<polyline points='0,0 1,0 1,1'/>", "ring 0 0,1 0,1 1\n" },
        { "<polyline points='0,0,1,0,1,1,0,0'/>", "ring 0 0,1 0,1 1\n" },
        { "<path d='M0 0H1V1zM5 5h1v1z'/>", "ring 0 0,1 0,1 1\nring 5 5,6 5,6 6\n" },
        { "<rect width='2' height='1'/>", "ring 0 0,2 0,2 1,0 1\n" },
        { "<rect x='1' y='2' width='2px' height='1'/>", "ring 1 2,3 2,3 3,1 3\n" },
        { "<rect width='4' height='4' rx='9'/>", "ring 2 0,4 2,2 4,0 2\n" },           /* no more than half */
        { "<rect width='6' height='4' ry='1' rx='2'/>", "ring 2 0,4 0,6 1,6 3,4 4,2 4,0 3,0 1\n" },
        { "<circle r='1'/>", "ring 1 0,0 1,-1 0,0 -1\n" },
        { "<circle cx='2' cy='3' r='1'/>", "ring 3 3,2 4,1 3,2 2\n" },
        { "<ellipse cx='2' cy='3' rx='1' ry='2'/>", "ring 3 3,2 5,1 3,2 1\n" },
        { "<ellipse rx='1' ry='auto'/>", "ring 1 0,0 1,-1 0,0 -1\n" },
        { "<ellipse ry='1'/>", "ring 1 0,0 1,-1 0,0 -1\n" },
        { "<line x2='1'/><line x1='1' x2='1' y2='1'/><line x1='1' y1='1'/>", "ring 0 0,1 0,1 1\n" },
        { "<svg:polygon xmlns:svg='http://www.w3.org/2000/svg' points='0 0 1 0 1 1'/>", "ring 0 0,1 0,1 1\n" },
        { "<svg:polygon points='0 0 1 0 1 1'/>", "ring 0 0,1 0,1 1\n" },
        { "<polygon points='0 0 1 0 1 1'><title>x</title><animate/></polygon>", "ring 0 0,1 0,1 1\n" },
        { "<polygon points='&#48; 0 1 0 1 &#x31;'/>", "ring 0 0,1 0,1 1\n" },
    };
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.no_flip = true;
    o.flatness = 100; /* curves as their corners */
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char svg[512], text[256];
        snprintf(svg, sizeof svg, "<svg><g z='0'>%s</g></svg>", c[i].shape);
        snprintf(text, sizeof text, "stack  mm\nslice 0\n%send\n", c[i].rings);
        assert_reads(read_with(svg, o), svg, text);
    }
}

static void open_lines_join_where_they_meet(void **state)
{
    (void)state;
    static const struct { const char *shapes, *rings; size_t n_notes, n_skipped; } c[] = {
        { "<polyline points='0,0 4,0 4,4'/><polyline points='0,0 0,4 4,4'/>", "ring 0 0,4 0,4 4,0 4\n", 2, 0 },
        { "<path d='M4 4L0 4M0 0L4 0M4 0L4 4M0 4L0 0'/>", "ring 4 4,0 4,0 0,4 0\n", 2, 0 },
        { "<line x2='4'/><polygon points='9,9 8,9 8,8'/>", "ring 9 9,8 9,8 8\n", 1, 1 },
        { "<polyline points='0,0 4,0 4,4'/><line x1='4' y1='4' x2='9' y2='9'/>", "ring 0 0,4 0,4 4\n", 2, 1 },
        { "<line x2='1'/><line x1='1' x2='1' y2='1'/><line x1='1' y1='1'/><line x2='-5'/>", "ring 0 0,1 0,1 1\n", 2,
          1 },
        /* two triangles that share a corner */
        { "<path d='M0 0L1 0M1 0L1 1M1 1L0 0M0 0L-1 0M-1 0L-1-1M-1-1L0 0'/>", NULL, 2, 0 },
    };
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.no_flip = true;
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char svg[512], text[256];
        snprintf(svg, sizeof svg, "<svg><g z='0'>%s</g></svg>", c[i].shapes);
        snprintf(text, sizeof text, "stack  mm\nslice 0\n%send\n", c[i].rings);
        result r = read_with(svg, o);
        assert_int_equal(r.report.n_notes, c[i].n_notes);
        assert_int_equal(r.report.n_skipped, c[i].n_skipped);
        if (c[i].rings)
            assert_reads(r, svg, text);
        else
            free_result(&r);
    }
}

/* ---- what is left out ------------------------------------------------------------------------ */

static void what_draws_nothing_is_passed_over(void **state)
{
    (void)state;
    const char *svg = "<?xml version='1.0'?>"
        "<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.0//EN' 'http://127.0.0.1/svg10.dtd' [ <!ELEMENT x ANY> ]>"
        "<!-- <polygon> --><svg xmlns='http://www.w3.org/2000/svg' xmlns:rdf='r'><style>polygon { fill: red }</style>"
        "<metadata><rdf:x><g/></rdf:x></metadata>"
        "<rdf:polygon points='x'/><defs><polygon points='bad'/></defs><symbol><polygon points='bad'/></symbol>"
        "<clipPath><rect width='-1'/></clipPath>"
        "<mask><g z='bad'/></mask><pattern/><marker/><?php polygon ?><script><![CDATA[ if (a < b) <polygon/> ]]>"
        "</script>"
        "<g z='0'><polygon " SQUARE "/></g></svg>";
    result r = read_plain(svg);
    assert_int_equal(r.report.n_skipped, 0);
    assert_reads(r, svg, "stack  mm\nslice 0\n" RING "end\n");
}

static void what_would_draw_something_is_counted(void **state)
{
    (void)state;
    const char *svg = "<svg><g z='0'><polygon " SQUARE "/>\n<use/><text>a</text><text>b</text><image/>"
        "<foreignObject/><polygn " SQUARE "/>"
        "<polygon/><polygon points=' '/><path d=''/><path d='M1 1'/><circle/><rect width='100%' height='1'/>"
        "<g display='none'><polygon points='bad'/></g><g style='fill:none; display : none'><g/></g>"
        "<g clip-path='url(#a)' style='mask:url(#b)'/></g></svg>";
    result r = read_plain(svg);
    assert_int_equal(r.report.n_skipped, 16);
    assert_int_equal(r.report.skip[0].line, 2);
    assert_string_equal(r.report.skip[0].what, "<use>");
    assert_string_equal(r.report.skip[0].file, "a.svg");
    assert_int_equal(r.report.skip[1].count, 2);
    assert_true(il_report_any(&r.report));
    assert_reads(r, svg, "stack  mm\nslice 0\n" RING "end\n");
}

static void the_title_names_the_stack(void **state)
{
    (void)state;
    static const struct { const char *title, *name; } c[] = {
        { "<title>Part</title>", "Part" }, { "<title>  a \n b\t c </title>", "a b c" }, { "<title/>", "" },
        { "<title>&lt;&amp;&#233;</title>", "<&\xC3\xA9" }, { "<title>a<!-- x -->b</title>", "ab" },
        { "<title><![CDATA[x<y]]></title>", "x<y" }, { "<title>one</title><title>two</title>", "one" },
        { "<g><title>not</title></g>", "" }, { "<desc>not</desc>", "" } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char svg[512], text[256];
        snprintf(svg, sizeof svg, "<svg>%s<polygon z='0' " SQUARE "><title>no</title></polygon></svg>", c[i].title);
        snprintf(text, sizeof text, "stack %s mm\nslice 0\n" RING "end\n", c[i].name);
        assert_reads(read_plain(svg), svg, text);
    }
}

/* ---- errors ------------------------------------------------------------------------------------- */

static void errors_name_line_and_reason(void **state)
{
    (void)state;
    static const struct { const char *svg; long line; const char *words; } c[] = {
        { "<svg>\n<polygon z='0'\n points='0,0\n1,0\n1,x'/></svg>", 5, "points: a finite number is expected at 'x'" },
        { "<svg>\n<polygon z='0' points='0,0 1,0 1'/></svg>", 2, "an x without its y" },
        { "<svg>\r\n<path z='0' d='M0 0\r\nL1 1\r\nL1,,1'/></svg>", 4, "d: a finite number is expected at ',1'" },
        { "<svg>\n<path z='0' id='>' d='L0 0'/></svg>", 2, "must begin with M" },
        { "<svg><g\n transform='rotate(1) &#10;\nspin(3)'/></svg>", 3, "transform: matrix, translate" },
        { "<svg>\n<g z='high'><polygon " SQUARE "/></g></svg>", 2, "z: a height" },
        { "<svg>\n<g data-z='1 2'/></svg>", 2, "data-z: a height" },
        { "<svg>\n<g data-z='1e15'/></svg>", 2, "below 1e15" },
        { "<svg>\n<g data-z=''/></svg>", 2, "data-z: a height" },
        { "<svg><polygon z='0' points='0,0 1e15,0 1,1'/></svg>", 1, "not below 1e15" },
        { "<svg><polygon z='0' points='0,0 inf,0 1,1'/></svg>", 1, "finite" },
        { "<svg><g transform='scale(1e200)'><g transform='scale(1e200)'><polygon z='0' points='0,0 1,0 1,1'/></g></g>"
            "</svg>", 1, "1e15" },
        { "<svg><g z='1'><polygon " SQUARE "/></g>\n<polygon " SQUARE "/></svg>", 2, "no height here" },
        { "<svg><circle z='0' r='-1'/></svg>", 1, "r: must not be negative" },
        { "<svg><circle z='0' r='1mm'/></svg>", 1, "plain number" },
        { "<svg><circle z='0' r='1 0'/></svg>", 1, "r: a unit of length" },
        { "<svg viewBox='0 0 1'/>", 1, "viewBox: a finite number" }, { "<svg viewBox='0 0 0 1'/>", 1, "above 0" },
        { "<svg viewBox='0 0 1 1' width='-1mm'/>", 1, "width: must be above 0" },
        { "<svg viewBox='0 0 1 1' preserveAspectRatio='xMid'/>", 1, "xMidYMid" },
        { "<svg><svg viewBox='0 0 1 1'/></svg>", 1, "width and height" },
        { "<svg/>", 0, "no contour" }, { "<svg><text>1</text></svg>", 0, "no contour" },
        { "<svg><g z='1'/></svg>", 0, "no contour" },
        { "", 0, "no element" }, { "  \n ", 0, "no element" }, { "<!-- -->", 0, "no element" },
        { "<html>\n<svg/></html>", 1, "<html> is no SVG element" },
        { "isoloft 1\nunit mm\n", 1, "text outside" }, { "<svg/>\nhello", 2, "text outside" },
        { "<svg>\n<g>\n</svg>", 3, "not well-formed" },
        { "<svg>\n<g>\n<g></g>\n", 2, "the file ends inside this element" },
        { "<svg>\n<defs>\n<g>\n", 2, "the file ends inside" },
        { "<svg></svg>\n</g>", 2, "an end tag without its start tag" }, { "</g>", 1, "an end tag without" },
        { "<svg/></isoloft-input><svg/>", 1, "an end tag without its start tag" },
        { "<svg>\n<polygon points='0 0", 2, "the file ends inside what begins with '<polygon" },
        { "<svg>\n<!-- x", 2, "the file ends inside" }, { "<svg>\n<polygon a='<'/></svg>", 2, "'<' inside a tag" },
        { "<svg>\n<polygon a='1' a='1'/></svg>", 2, "not well-formed" }, { "<svg>&nbsp;</svg>", 1, "not well-formed" },
        { "<svg><polygon points='&x;'/></svg>", 1, "not well-formed" }, { "<svg>\n\xFF</svg>", 2, "not well-formed" },
        { "<svg a=1/>", 1, "not well-formed" },
        { "<!DOCTYPE svg [\n<!ENTITY a 'b'>]><svg>&a;</svg>", 1, "declares entities" },
        { "<!DOCTYPE svg [<!ENTITY % a SYSTEM 'file:///etc/passwd'> %a;]><svg/>", 1, "declares entities" },
        { "\xFF\xFE<\0s\0", 1, "UTF-16" },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        assert_refused(read_plain(c[i].svg), c[i].svg, c[i].line, c[i].words);
}

static void names_in_errors_are_made_printable(void **state)
{
    (void)state;
    const char *svg = "<polygon z='\xC2\x9B" "31m'/>";
    result r = read_plain(svg);
    assert_non_null(strstr(r.err.text, "\\xc2\\x9b31m"));
    free_result(&r);
}

static void other_encodings_are_read(void **state)
{
    (void)state;
    const char *svg = "<?xml version='1.0' encoding='ISO-8859-1'?><svg><title>\xE9</title><polygon z='0' " SQUARE "/>"
        "</svg>";
    assert_reads(read_plain(svg), svg, "stack \xC3\xA9 mm\nslice 0\n" RING "end\n");
    svg = "\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?><svg><title>\xC3\xA9</title><polygon z='0' " SQUARE "/>"
        "</svg>";
    assert_reads(read_plain(svg), svg, "stack \xC3\xA9 mm\nslice 0\n" RING "end\n");
}

/* ---- hostile input -------------------------------------------------------------------------------- */

static char *repeat(const char *before, const char *unit, size_t n, const char *after)
{
    size_t k = strlen(unit), b = strlen(before);
    char *s = malloc(b + n * k + strlen(after) + 1);
    assert_non_null(s);
    memcpy(s, before, b);
    for (size_t i = 0; i < n; i++)
        memcpy(s + b + i * k, unit, k);
    strcpy(s + b + n * k, after);
    return s;
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Generous, for slow machines and sanitizers; what is quadratic takes minutes. */
static const double patience = 20;

static void deep_nesting_is_refused_at_once(void **state)
{
    (void)state;
    char *svg = repeat("<svg>\n", "<g>\n", 1000000, "");
    double start = seconds();
    assert_refused(read_plain(svg), "1e6 groups", 1001, "nested more than 1000 deep");
    char *quiet = repeat("<svg><defs>\n", "<g>\n", 1000000, "");
    assert_refused(read_plain(quiet), "1e6 ignored groups", 1000, "nested more than 1000 deep");
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.max_depth = 10000000;
    assert_refused(read_with(svg, o), "1e6 groups allowed", 1000001, "the file ends inside this element");
    assert_true(seconds() - start < patience);
    free(svg);
    free(quiet);
}

static void long_attributes_are_read_fast(void **state)
{
    (void)state;
    char *svg = repeat("<svg>\n<polygon z='0' points='", "1.25,3.5\n", 1200000, "1'/></svg>"); /* 10 MB */
    double start = seconds();
    assert_refused(read_plain(svg), "a long list", 1200002, "an x without its y");
    free(svg);
    svg = repeat("<polygon z='0' points='0 0 1 0 1 1' id='", "&lt;0123456789", 1000000, "'/>");
    assert_reads(read_plain(svg), "a long id", "stack  mm\nslice 0\n" RING "end\n");
    free(svg);
    svg = repeat("<svg>", "<!-- -->text", 500000, "<polygon z='0' " SQUARE "/></svg>");
    assert_reads(read_plain(svg), "comments", "stack  mm\nslice 0\n" RING "end\n");
    free(svg);
    assert_true(seconds() - start < patience);
}

static void limits_hold(void **state)
{
    (void)state;
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.max_line = 1000;
    char *svg = repeat("<svg>\n<polygon z='0' points='", "1,1 ", 100000, "'/></svg>");
    assert_refused(read_with(svg, o), "a long tag", 2, "more than 1000 bytes");
    o = (il_read_options)IL_READ_OPTIONS_INIT;
    o.max_points = 99999;
    assert_refused(read_with(svg, o), "many points", 2, "more than 99999 vertices");
    free(svg);
    svg = repeat("<svg ", "a='' ", 257, "/>");
    assert_refused(read_plain(svg), "attributes", 1, "more than 256 attributes");
    free(svg);
    char *tags = malloc(300 * 40);
    size_t n = 0;
    for (int i = 0; i < 300; i++)
        n += (size_t)sprintf(tags + n, "<g xmlns:n%d='u'>", i);
    assert_refused(read_plain(tags), "namespaces", 1, "more than 256 namespaces");
    free(tags);
}

static void many_small_elements_are_linear(void **state)
{
    (void)state;
    double start = seconds();
    char *svg = repeat("<svg>", "<line z='0' x2='1'/><line z='0' x1='1' y1='1'/><line z='0' x1='1' x2='1' y2='1'/>"
        "<polygon z='1' points='0 0 1 0 1 1'/>", 50000, "</svg>");
    result r = read_plain(svg);
    assert_int_equal(r.status, IL_OK);
    free_result(&r);
    free(svg);
    svg = repeat("<svg><g z='0'>", "<g xmlns='http://www.w3.org/2000/svg'><path d='M0 0C0 1 1 1 1 0'/></g>", 50000,
        "</g></svg>");
    r = read_plain(svg);
    assert_int_equal(r.status, IL_OK);
    free_result(&r);
    free(svg);
    assert_true(seconds() - start < patience);
}

static void a_chain_of_lines_is_joined_in_linear_time(void **state)
{
    (void)state;
    size_t n = 100000, at = 0;
    char *svg = malloc(n * 80 + 64);
    assert_non_null(svg);
    at += (size_t)sprintf(svg, "<g z='0'>");
    for (size_t i = n; i-- > 0;) /* backwards, and it never closes */
        at += (size_t)sprintf(svg + at, "<line x1='%zu' x2='%zu' y1='%zu' y2='%zu'/>", i, i + 1, i * i % 7,
            (i + 1) * (i + 1) % 7);
    at += (size_t)sprintf(svg + at, "<polygon " SQUARE "/></g>");
    double start = seconds();
    result r = read_plain(svg);
    assert_int_equal(r.status, IL_OK);
    assert_int_equal(r.report.n_skipped, n);
    assert_true(seconds() - start < patience);
    free_result(&r);
    free(svg);
}

static const char *const everything =
    "<?xml version='1.0' encoding='UTF-8'?>\n<!DOCTYPE svg PUBLIC 'a' \"b\" [\n<!-- ' -->\n<!ELEMENT a (b)>\n]>"
    "\n<!-- a > b -->\n"
    "<svg xmlns='http://www.w3.org/2000/svg' " INKSCAPE " width='10mm' height='10mm' viewBox='0 0 20 20'>\r\n"
    "<title>All &amp; every</title><g inkscape:label='z=1 > 0' id=\"layer1\"><polygon points='0,0\r\n1,0 1,1'/></g>\n"
    "<g data-z='0' transform='translate(1 2)'><path d='M0 0C0 1 1 1 1 0ZM3 3A1 1 0 0 0 4 4L5 9'/><text>"
    "x &gt; y</text><circle r='3'/></g>"
    "<g data-z='3'><line x2='1'/><line x1='1' y1='1'/><line x1='1' x2='1' y2='1'/></g><![CDATA[ <g> ]]></svg>"
    "\n<?end?>\n";

/* A source read through a pipe that gives single bytes must not matter: the
 * reader sees the same. */
static void pieces_of_any_size_read_the_same(void **state)
{
    (void)state;
    result whole = read_plain(everything);
    if (whole.status != IL_OK)
        fail_msg("%ld: %s", whole.err.line, whole.err.text);
    assert_non_null(strstr(whole.rec.text, "stack All & every mm\nslice 0\n"));
    char path[64];
    for (size_t size = 1; size < 70; size += size < 8 ? 1 : 13) {
        result r = { new_recorder(), IL_REPORT_INIT, IL_ERROR_INIT, IL_OK };
        int fd[2];
        assert_int_equal(pipe(fd), 0);
        pid_t child = fork();
        if (child == 0) {
            close(fd[0]);
            for (size_t at = 0, n = strlen(everything); at < n; at += size)
                if (write(fd[1], everything + at, at + size < n ? size : n - at) < 0)
                    _exit(1);
            _exit(0);
        }
        close(fd[1]);
        snprintf(path, sizeof path, "/dev/fd/%d", fd[0]);
        il_source *source = NULL;
        assert_int_equal(il_source_open(&source, path, &r.err), IL_OK);
        il_read_options o = IL_READ_OPTIONS_INIT;
        r.status = il_reader_svg.read(&source, 1, &o, &r.rec.sink, &r.report, &r.err);
        il_source_close(source);
        close(fd[0]);
        waitpid(child, NULL, 0);
        assert_int_equal(r.status, IL_OK);
        assert_string_equal(r.rec.text, whole.rec.text);
        assert_int_equal(r.report.n_skipped, whole.report.n_skipped);
        free_result(&r);
    }
    free_result(&whole);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    result whole = read_plain(everything);
    long k = 0;
    for (;; k++) {
        il_error err = IL_ERROR_INIT;
        il_source *source = NULL;
        recorder rec = new_recorder();
        il_report report = IL_REPORT_INIT;
        il_read_options o = IL_READ_OPTIONS_INIT;
        assert_int_equal(il_source_from_memory(&source, everything, strlen(everything), "a.svg", &err), IL_OK);
        il_alloc_test_fail_after(k);
        il_status st = il_reader_svg.read(&source, 1, &o, &rec.sink, &report, &err);
        il_alloc_test_fail_after(-1);
        il_source_close(source);
        il_report_free(&report);
        bool done = st == IL_OK && strcmp(rec.text, whole.rec.text) == 0;
        free(rec.text);
        if (st != IL_OK)
            assert_int_equal(err.code, IL_E_NOMEM);
        if (done && k > 40)
            break;
        assert_true(k < 100000);
    }
    free_result(&whole);
}

static void a_failing_sink_stops_the_reader(void **state)
{
    (void)state;
    for (long k = 0; k < 6; k++) {
        il_error err = IL_ERROR_INIT;
        il_source *source = NULL;
        recorder rec = new_recorder();
        il_read_options o = IL_READ_OPTIONS_INIT;
        rec.calls_left = k;
        assert_int_equal(il_source_from_memory(&source, everything, strlen(everything), "a.svg", &err), IL_OK);
        assert_int_equal(il_reader_svg.read(&source, 1, &o, &rec.sink, NULL, &err), IL_E_IO);
        assert_string_equal(err.text, "the sink is full");
        il_source_close(source);
        free(rec.text);
    }
}

static void svg_is_told_by_its_first_bytes(void **state)
{
    (void)state;
    static const struct { const char *head; bool is_svg; } c[] = {
        { "<svg>", true }, { "<svg:svg xmlns:svg='x'>", true },
        { "\xEF\xBB\xBF \n<?xml version='1.0'?><!-- <kml> --><svg/>", true },
        { "<?xml?>\n<!DOCTYPE svg PUBLIC", true }, { "<!DOCTYPE svg><!-- long", true },
        { "<polygon points=''/>", true }, { "<g>", true },
        { "<path\nd=''/>", true }, { "<g", true }, { "<gpx>", false }, { "<kml>", false }, { "<html><svg>", false },
        { "isoloft 1", false },
        { "", false }, { "solid x", false }, { "<!-- only", false },
        { "<?xml version='1.0'?><NativeDicomModel/>", false } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        if (il_reader_svg.probe((const unsigned char *)c[i].head, strlen(c[i].head)) != c[i].is_svg)
            fail_msg("%s", c[i].head);
}

static void a_spacing_must_be_above_zero(void **state)
{
    (void)state;
    static const double c[] = { 0, -1, NAN, INFINITY };
    for (size_t i = 0; i < 4; i++) {
        result r = read_with("<polygon " SQUARE "/>", with_spacing(c[i]));
        assert_int_equal(r.status, IL_E_USAGE);
        free_result(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights_come_from_the_nearest_attribute),
        cmocka_unit_test(names_are_heights_or_numbers_of_slices),
        cmocka_unit_test(numbers_of_slices_count_spacings),
        cmocka_unit_test(document_order_counts_spacings),
        cmocka_unit_test(several_files_are_several_slices),
        cmocka_unit_test(files_with_heights_are_one_stack),
        cmocka_unit_test(slices_are_sorted_and_merged_and_counted),
        cmocka_unit_test(an_empty_group_with_a_height_is_an_empty_slice),
        cmocka_unit_test(slic3r_heights_are_millionths_and_y_points_up),
        cmocka_unit_test(relatives_of_slic3r_write_millimetres),
        cmocka_unit_test(millionths_are_rounded_once),
        cmocka_unit_test(y_is_turned_unless_told_otherwise),
        cmocka_unit_test(a_physical_size_scales_to_millimetres),
        cmocka_unit_test(the_unit_can_be_told),
        cmocka_unit_test(groups_and_viewports_nest),
        cmocka_unit_test(every_shape_is_drawn),
        cmocka_unit_test(open_lines_join_where_they_meet),
        cmocka_unit_test(what_draws_nothing_is_passed_over),
        cmocka_unit_test(what_would_draw_something_is_counted),
        cmocka_unit_test(the_title_names_the_stack),
        cmocka_unit_test(errors_name_line_and_reason),
        cmocka_unit_test(names_in_errors_are_made_printable),
        cmocka_unit_test(other_encodings_are_read),
        cmocka_unit_test(deep_nesting_is_refused_at_once),
        cmocka_unit_test(long_attributes_are_read_fast),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(many_small_elements_are_linear),
        cmocka_unit_test(a_chain_of_lines_is_joined_in_linear_time),
        cmocka_unit_test(pieces_of_any_size_read_the_same),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(a_failing_sink_stops_the_reader),
        cmocka_unit_test(svg_is_told_by_its_first_bytes),
        cmocka_unit_test(a_spacing_must_be_above_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
