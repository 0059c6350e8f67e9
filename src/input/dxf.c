/* dxf.c - DXF drawings (formats/dxf.txt): the sections of a file. */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/dxf-drawing.h"

#include <string.h>

/* ---- HEADER ------------------------------------------------------------------------- */

/* UTF-8 came with release 2007, AC1021. */
static il_status take_version(il_dxf *d, bool *is_utf8, il_error *err)
{
    const il_dxf_scan *s = &d->scan;
    if (s->n != 6 || memcmp(s->value, "AC", 2) != 0)
        return il_fail(err, IL_E_INPUT, s->line + 1, "'%.*s' is no version of DXF ($ACADVER)", s->n < 40 ? (int)s->n : 40, s->value);
    *is_utf8 = memcmp(s->value, "AC1021", 6) >= 0;
    return *is_utf8 && !il_codepage_set(&d->layers.page, "UTF-8", 5) ? il_fail_nomem(err) : IL_OK;
}

static void take_page(il_dxf *d, bool is_utf8)
{
    const il_dxf_scan *s = &d->scan;
    if (!is_utf8 && !il_codepage_set(&d->layers.page, s->value, s->n))
        il_report_note(il_map_report(d->set), "the code page '%.*s' is not known; names that are not UTF-8 are taken as ISO-8859-1",
                       s->n < 40 ? (int)s->n : 40, s->value);
}

/* Inches stand in the files of programs that ask nobody, and of drawings of metres. */
static il_status take_unit(il_dxf *d, il_error *err)
{
    enum { INCHES = 1, SURVEY_FEET = 21 };
    static const struct { int number; il_unit unit; } units[] = {
        { 2, IL_UNIT_FT }, { 4, IL_UNIT_MM }, { 5, IL_UNIT_CM }, { 6, IL_UNIT_M }, { 7, IL_UNIT_KM }, { 13, IL_UNIT_UM },
        { SURVEY_FEET, IL_UNIT_FT } };
    il_report *report = il_map_report(d->set);
    double value;
    il_status st = il_dxf_number(&d->scan, &value, err);
    if (st != IL_OK || value == 0)
        return st;
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        if (units[k].number == value) {
            if (units[k].number == SURVEY_FEET)
                il_report_note(report, "US survey feet ($INSUNITS 21) are taken as feet, which are 2 millionths shorter");
            return il_map_unit(d->set, units[k].unit, d->scan.line + 1, err);
        }
    }
    if (value == INCHES)
        il_report_note(report, "$INSUNITS says inches, as many programs write unasked: not believed (--unit in makes it so)");
    else
        il_report_note(report, "the drawing's unit ($INSUNITS %.*s) is none that isoloft has (--unit tells one)",
                       d->scan.n < 20 ? (int)d->scan.n : 20, d->scan.value);
    return IL_OK;
}

/* A variable's name, and behind it its values. */
static il_status read_header(il_dxf *d, il_error *err)
{
    enum { VARIABLE = 9 };
    enum { OTHER, OF_VERSION, OF_PAGE, OF_UNIT } of = OTHER;
    const il_dxf_scan *s = &d->scan;
    bool is_utf8 = false;
    il_status st;
    while ((st = il_dxf_next(&d->scan, err)) == IL_OK && s->code != 0) {
        if (s->code == VARIABLE)
            of = il_dxf_is(s, VARIABLE, "$ACADVER") ? OF_VERSION : il_dxf_is(s, VARIABLE, "$DWGCODEPAGE") ? OF_PAGE
                 : il_dxf_is(s, VARIABLE, "$INSUNITS") ? OF_UNIT : OTHER;
        else if (of == OF_VERSION)
            st = take_version(d, &is_utf8, err);
        else if (of == OF_PAGE)
            take_page(d, is_utf8);
        else if (of == OF_UNIT)
            st = take_unit(d, err);
        if (st != IL_OK)
            return st;
    }
    return st;
}

/* ---- other sections ------------------------------------------------------------------- */

static il_status skip_to_next(il_dxf *d, il_error *err)
{
    il_status st;
    while ((st = il_dxf_next(&d->scan, err)) == IL_OK && d->scan.code != 0)
        continue;
    return st;
}

static bool ends_section(const il_dxf *d)
{
    return il_dxf_is(&d->scan, 0, "ENDSEC") || il_dxf_is(&d->scan, 0, "EOF") || il_dxf_is(&d->scan, 0, "SECTION");
}

/* An entry of the table of layers. */
static il_status read_layer(il_dxf *d, il_error *err)
{
    enum { NAME = 2, COLOUR = 62, FLAGS = 70, FROZEN = 1 };
    uint32_t index = IL_DXF_LAYER_0;
    bool has_name = false, is_off = false;
    il_status st;
    while ((st = il_dxf_next(&d->scan, err)) == IL_OK && d->scan.code != 0) {
        const il_dxf_scan *s = &d->scan;
        double value = 0;
        if (s->code == NAME)
            st = il_dxf_layer_find(&d->layers, s->value, s->n, s->line + 1, &index, err);
        else if (s->code == COLOUR || s->code == FLAGS)
            st = il_dxf_number(s, &value, err);
        has_name |= s->code == NAME;
        is_off |= s->code == COLOUR ? value < 0 : value >= 0 && value < 65536 && (int)value & FROZEN;
        if (st != IL_OK)
            return st;
    }
    if (st == IL_OK && has_name)
        d->layers.layer[index].is_off = is_off;
    return st;
}

static il_status read_tables(il_dxf *d, il_error *err)
{
    il_status st = skip_to_next(d, err);
    while (st == IL_OK && !ends_section(d))
        st = il_dxf_is(&d->scan, 0, "LAYER") ? read_layer(d, err) : skip_to_next(d, err);
    return st;
}

/* What the pair at hand, a BLOCK, says of itself; *INDEX is its number. */
static il_status begin_block(il_dxf *d, uint32_t *index, il_error *err)
{
    enum { NAME = 2 };
    il_dxf_block new = { .begin = d->n_entities };
    il_status st = il_dxf_find_block(d, "", 0, index, err);
    while (st == IL_OK && (st = il_dxf_next(&d->scan, err)) == IL_OK && d->scan.code != 0) {
        switch (d->scan.code) {
        case NAME: st = il_dxf_find_block(d, d->scan.value, d->scan.n, index, err); break;
        case 10: st = il_dxf_number(&d->scan, &new.x, err); break;
        case 20: st = il_dxf_number(&d->scan, &new.y, err); break;
        case 30: st = il_dxf_number(&d->scan, &new.z, err); break;
        default: break;
        }
    }
    if (st != IL_OK)
        return st;
    new.n_definitions = d->block[*index].n_definitions + 1;
    d->block[*index] = new;
    return IL_OK;
}

static il_status read_block(il_dxf *d, il_error *err)
{
    uint32_t index = 0;
    long line = d->scan.line;
    il_status st = begin_block(d, &index, err);
    while (st == IL_OK && !il_dxf_is(&d->scan, 0, "ENDBLK")) {
        il_dxf_entity e;
        if (ends_section(d) || il_dxf_is(&d->scan, 0, "BLOCK"))
            return il_fail(err, IL_E_INPUT, d->scan.line, "the BLOCK of line %ld has no ENDBLK", line);
        st = il_dxf_read_entity(d, &e, err);
        if (st == IL_OK && !il_grow(&d->entity, &d->cap_entities, d->n_entities + 1, sizeof *d->entity))
            st = il_fail_nomem(err);
        if (st == IL_OK)
            d->entity[d->n_entities++] = e;
    }
    if (st == IL_OK)
        d->block[index].n = d->n_entities - d->block[index].begin;
    return st == IL_OK ? skip_to_next(d, err) : st;
}

static il_status read_blocks(il_dxf *d, il_error *err)
{
    il_status st = skip_to_next(d, err);
    while (st == IL_OK && !ends_section(d)) {
        if (!il_dxf_is(&d->scan, 0, "BLOCK"))
            return il_fail(err, IL_E_INPUT, d->scan.line, "'%.*s' is no BLOCK", d->scan.n < 40 ? (int)d->scan.n : 40, d->scan.value);
        st = read_block(d, err);
    }
    return st;
}

/* The end of a sequence that is no polyline's belongs to the INSERT before. */
static il_status read_entities(il_dxf *d, il_error *err)
{
    static const il_dxf_place identity = IL_DXF_PLACE_IDENTITY;
    il_status st = skip_to_next(d, err);
    d->has_entities = true;
    while (st == IL_OK && !ends_section(d)) {
        il_dxf_entity e;
        bool is_end = il_dxf_is(&d->scan, 0, "SEQEND");
        st = is_end ? skip_to_next(d, err) : il_dxf_read_entity(d, &e, err);
        if (st != IL_OK || is_end)
            continue;
        st = il_dxf_draw(d, &e, &identity, err);
        d->n_groups = e.begin;
    }
    return st;
}

static il_status skip_section(il_dxf *d, il_error *err)
{
    il_status st;
    while ((st = skip_to_next(d, err)) == IL_OK && !ends_section(d))
        continue;
    return st;
}

/* ---- the file ---------------------------------------------------------------------------- */

static il_status read_section(il_dxf *d, il_error *err)
{
    static const struct { const char *name; il_status (*run)(il_dxf *, il_error *); } sections[] = {
        { "HEADER", read_header }, { "TABLES", read_tables }, { "BLOCKS", read_blocks }, { "ENTITIES", read_entities } };
    il_status (*run)(il_dxf *, il_error *) = skip_section;
    long line = d->scan.line;
    il_status st = il_dxf_next(&d->scan, err);
    if (st == IL_OK && d->scan.code != 2)
        st = il_fail(err, IL_E_INPUT, d->scan.line, "the SECTION of line %ld has no name", line);
    for (size_t k = 0; k < sizeof sections / sizeof *sections; k++)
        if (st == IL_OK && il_dxf_is(&d->scan, 2, sections[k].name))
            run = sections[k].run;
    if (st == IL_OK)
        st = run(d, err);
    if (st == IL_OK && !il_dxf_is(&d->scan, 0, "ENDSEC"))
        st = il_fail(err, IL_E_INPUT, d->scan.line, "the SECTION of line %ld has no ENDSEC", line);
    return st;
}

static il_status read_sections(il_dxf *d, il_error *err)
{
    il_status st;
    while ((st = il_dxf_next(&d->scan, err)) == IL_OK && !il_dxf_is(&d->scan, 0, "EOF")) {
        if (!il_dxf_is(&d->scan, 0, "SECTION"))
            return il_fail(err, IL_E_INPUT, d->scan.line, "here a SECTION or the EOF has to begin");
        st = read_section(d, err);
        if (st != IL_OK)
            return st;
    }
    if (st == IL_OK && !d->has_entities)
        st = il_fail(err, IL_E_INPUT, d->scan.line, "the file has no section ENTITIES");
    return st == IL_OK ? il_dxf_expect_end(&d->scan, err) : st;
}

static void tell(const il_dxf *d)
{
    il_report *report = il_map_report(d->set);
    if (d->n_curved > 0)
        il_report_note(report, "%zu points were put on arcs and curves (--flatness says how near)", d->n_curved);
    if (d->n_fit > 0)
        il_report_note(report, "%zu splines without control points: the points that they pass through are joined by straight lines",
                       d->n_fit);
}

static bool is_dwg(const unsigned char *head, size_t n)
{
    return n > 6 && memcmp(head, "AC10", 4) == 0 && head[4] >= '0' && head[4] <= '9' && head[5] >= '0' && head[5] <= '9' &&
           head[6] == 0;
}

static bool is_binary(const unsigned char *head, size_t n)
{
    return il_text_begins((const char *)head, n, "AutoCAD Binary DXF");
}

static il_status refuse_binary(il_source *source, il_error *err)
{
    const unsigned char *head;
    size_t n;
    il_status st = il_source_peek(source, 64, &head, &n, err);
    if (st == IL_OK && is_dwg(head, n))
        st = il_fail(err, IL_E_INPUT, 0, "is a DWG drawing; isoloft reads it saved as DXF (text)");
    else if (st == IL_OK && is_binary(head, n))
        st = il_fail(err, IL_E_INPUT, 0, "is a binary DXF drawing; isoloft reads it saved as text (ASCII) DXF");
    return st;
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_dxf d = { .set = set, .options = options };
    il_dxf_scan_init(&d.scan, source, options->max_line);
    il_status st = refuse_binary(source, err);
    if (st == IL_OK)
        st = il_dxf_layers_init(&d.layers, &options->map, err);
    if (st == IL_OK)
        st = read_sections(&d, err);
    if (st == IL_OK)
        st = il_dxf_layers_end(&d.layers, il_map_report(set), err);
    if (st == IL_OK)
        tell(&d);
    il_dxf_layers_free(&d.layers);
    il_dxf_scan_free(&d.scan);
    il_dictionary_free(&d.types);
    il_dictionary_free(&d.block_names);
    il_free(d.group);
    il_free(d.entity);
    il_free(d.block);
    il_free(d.work);
    return st;
}

static il_status read_dxf(il_source *const *source, size_t n, const il_read_options *options, il_sink *sink,
                          il_report *report, il_error *err)
{
    return il_map_read("DXF", parse, source, n, options, sink, report, err);
}

/* ---- the probe ----------------------------------------------------------------------------- */

/* The line at *I of the N bytes at S, without blanks around it; *I behind it. */
static const char *line_at(const char *s, size_t n, size_t *i, size_t *length)
{
    const char *lf = memchr(s + *i, '\n', n - *i), *line = s + *i, *end = lf ? lf : s + n;
    *i = (size_t)(end - s) + (lf != NULL);
    while (line < end && (*line == ' ' || *line == '\t'))
        line++;
    while (end > line && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
        end--;
    *length = (size_t)(end - line);
    return line;
}

/* The first pair that is no comment is 0, SECTION. */
static bool probe(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    size_t i = n >= 3 && memcmp(s, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0, n_code, n_value;
    if (is_dwg(head, n) || is_binary(head, n))
        return true;
    while (i < n) {
        const char *code = line_at(s, n, &i, &n_code), *value = line_at(s, n, &i, &n_value);
        if (!il_text_is(code, n_code, "999"))
            return il_text_is(code, n_code, "0") && il_text_is(value, n_value, "SECTION");
    }
    return false;
}

const il_reader il_reader_dxf = {
    .name = "dxf",
    .extensions = "dxf",
    .words = "DXF drawings, R12 to 2018",
    .is_map = true,
    .probe = probe,
    .read = read_dxf,
};
