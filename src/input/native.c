/* native.c - the reader of the native format (formats/loft.txt): streams, and
 * the road of each line to what takes it. */
#include "config.h"
#include "input/native.h"
#include "base/alloc.h"

#include <stdio.h>
#include <string.h>

/* ---- records ----------------------------------------------------------------- */

static const struct {
    il_native_record parent;
    const char *name;                     /* "... cannot stand in NAME" */
    il_status (*close)(il_native *n);     /* null: nothing to do */
} records[] = {
    [IL_IN_STREAM]  = { IL_IN_STREAM, "the stream outside a stack", NULL },
    [IL_IN_STACK]   = { IL_IN_STREAM, "a stack",                    il_native_close_stack },
    [IL_IN_HEAD]    = { IL_IN_STACK,  "the header of a stack",      il_native_close_head },
    [IL_IN_SLICE]   = { IL_IN_STACK,  "a slice",                    NULL },
    [IL_IN_RING]    = { IL_IN_SLICE,  "a ring",                     il_native_close_ring },
    [IL_IN_PAIR]    = { IL_IN_STACK,  "a pair",                     il_native_close_pair },
    [IL_IN_GROUP]   = { IL_IN_PAIR,   "a group",                    il_native_close_group },
    [IL_IN_LATTICE] = { IL_IN_GROUP,  "a lattice",                  il_native_close_lattice },
    [IL_IN_PHI]     = { IL_IN_PAIR,   "phi",                        il_native_close_phi },
    [IL_IN_CUT]     = { IL_IN_PAIR,   "a cut",                      il_native_close_cut },
    [IL_IN_GAP]     = { IL_IN_STACK,  "a gap",                      il_native_close_gap },
};

static bool is_inside(il_native_record inner, il_native_record outer)
{
    while (inner != outer && inner != IL_IN_STREAM)
        inner = records[inner].parent;
    return inner == outer;
}

static il_status close_until(il_native *n, il_native_record outer)
{
    il_status st = IL_OK;
    while (st == IL_OK && n->in != outer) {
        if (records[n->in].close)
            st = records[n->in].close(n);
        n->in = records[n->in].parent;
    }
    return st;
}

il_status il_native_nomem(il_native *n)
{
    return il_fail_nomem(n->err);
}

/* ---- lines ------------------------------------------------------------------- */

static il_status take_end(il_native *n)
{
    n->ended = true;
    return IL_OK;
}

static const il_native_keyword stream_keywords[] = {
    { "end", IL_IN_STREAM, take_end },
    { NULL, IL_IN_STREAM, NULL },
};

static const il_native_keyword *find_keyword(const char *word, size_t n)
{
    static const il_native_keyword *const tables[] = {
        il_native_slice_keywords, il_native_pair_keywords, il_native_group_keywords, il_native_stack_keywords,
        stream_keywords };
    for (size_t t = 0; t < sizeof tables / sizeof *tables; t++)
        for (const il_native_keyword *k = tables[t]; k->word; k++)
            if (strlen(k->word) == n && memcmp(k->word, word, n) == 0)
                return k;
    return NULL;
}

static il_status unknown_keyword(il_native *n, const char *word, size_t length)
{
    if (strcmp(n->version, "1") != 0 && strcmp(n->version, "1.0") != 0)
        return il_native_fail(n, "'%.*s' is unknown in isoloft 1.0, which this program reads; the stream is isoloft %s",
                              il_scan_shown(length), word, n->version);
    return il_native_fail(n, "'%.*s' is neither a keyword nor a number", il_scan_shown(length), word);
}

static bool is_private_name(const char *word, size_t n)
{
    for (size_t i = 2; i < n; i++)
        if (!(word[i] == '-' || (word[i] >= 'a' && word[i] <= 'z') || (word[i] >= '0' && word[i] <= '9')))
            return false;
    return n > 2;
}

/* An x- line, carried with the record that is open. */
static il_status take_private(il_native *n, const char *word, size_t length)
{
    if (!is_private_name(word, length))
        return il_native_fail(n, "the name of an x- line is made of a-z, 0-9 and '-'");
    if (n->in == IL_IN_STREAM)
        return il_native_fail(n, "an x- line cannot stand in %s", records[n->in].name);
    const char *end = n->at.end;
    while (end[-1] == ' ' || end[-1] == '\t')
        end--;
    if (!il_extra_add(n->extra, word, (size_t)(end - word)))
        return il_native_nomem(n);
    n->extra = &(*n->extra)->next;
    if (n->in == IL_IN_SLICE)
        n->slice_extra = n->extra;
    return IL_OK;
}

static il_status take_keyword(il_native *n)
{
    size_t length;
    const char *word = il_scan_peek(&n->at, &length);
    if (length >= 2 && memcmp(word, "x-", 2) == 0)
        return take_private(n, word, length);
    const il_native_keyword *k = find_keyword(word, length);
    if (!k)
        return unknown_keyword(n, word, length);
    if (!is_inside(n->in, k->in))
        return il_native_fail(n, "'%s' cannot stand in %s", k->word, records[n->in].name);
    n->at.p += length;
    il_status st = close_until(n, k->in);
    if (st == IL_OK)
        st = k->take(n);
    return st == IL_OK ? il_scan_end(&n->at, n->err) : st;
}

static il_status take_row(il_native *n)
{
    il_status st;
    switch (n->in) {
    case IL_IN_RING:    st = il_native_take_vertex(n); break;
    case IL_IN_LATTICE: st = il_native_take_lattice_row(n); break;
    case IL_IN_PHI:     st = il_native_take_phi_row(n); break;
    case IL_IN_CUT:     st = il_native_take_cut_row(n); break;
    default:            return il_native_fail(n, "a row of numbers cannot stand in %s", records[n->in].name);
    }
    return st == IL_OK && n->at.p < n->at.end ? il_scan_end(&n->at, n->err) : st;
}

static bool begins_number(const il_scan *s)
{
    return s->p < s->end && ((*s->p >= '0' && *s->p <= '9') || *s->p == '-' || *s->p == '.' || *s->p == '+');
}

/* Rows are checked by being numbers; only what is behind them is text. */
static il_status take_line(il_native *n)
{
    il_status st;
    const il_scan whole = n->at;
    if (!begins_number(&n->at)) {
        st = il_scan_check(&whole, n->err);
        if (st != IL_OK || il_scan_at_end(&n->at))
            return st;
    }
    if (n->ended)
        return il_native_fail(n, "nothing may follow 'end'");
    if (!begins_number(&n->at))
        return take_keyword(n);
    st = take_row(n);
    if (st == IL_OK && n->at.p < n->at.end)
        st = il_scan_check(&whole, n->err);
    return st;
}

/* ---- streams ----------------------------------------------------------------- */

static const char magic[] = "isoloft ";
static const char byte_order_mark[] = "\xEF\xBB\xBF";
enum { MAGIC = sizeof magic - 1, BOM = sizeof byte_order_mark - 1 };

static size_t digits(const char *p, const char *end)
{
    const char *q = p;
    while (q < end && *q >= '0' && *q <= '9')
        q++;
    return (size_t)(q - p);
}

/* MAJOR or MAJOR.MINOR, all of WORD? */
static bool is_version(const char *word, size_t n)
{
    const char *end = word + n;
    size_t major = digits(word, end), minor = digits(word + major + (major < n), end);
    return major == n ? n > 0 : major > 0 && word[major] == '.' && minor > 0 && major + 1 + minor == n;
}

static bool is_major_1(const char *word)
{
    while (*word == '0')
        word++;
    return word[0] == '1' && !(word[1] >= '0' && word[1] <= '9');
}

static il_status take_version(il_native *n)
{
    size_t length;
    const char *word = il_scan_peek(&n->at, &length);
    if (!is_version(word, length))
        return il_native_fail(n, "the first line is not 'isoloft 1'");
    snprintf(n->version, sizeof n->version, "%.*s", il_scan_shown(length), word);
    if (!is_major_1(n->version))
        return il_native_fail(n, "the stream is isoloft %s; this program reads isoloft 1", n->version);
    n->at.p += length;
    return il_scan_end(&n->at, n->err);
}

static il_status take_first_line(il_native *n)
{
    if (n->at.end - n->at.p >= BOM && memcmp(n->at.p, byte_order_mark, BOM) == 0)
        n->at.p += BOM;
    il_status st = il_scan_check(&n->at, n->err);
    if (st != IL_OK)
        return st;
    if (n->at.end - n->at.p < MAGIC || memcmp(n->at.p, magic, MAGIC) != 0)
        return il_native_fail(n, "the first line is not 'isoloft 1'");
    n->at.p += MAGIC;
    return take_version(n);
}

/* *MORE is false at the end of the input. */
static il_status next_line(il_native *n, bool *more)
{
    size_t length;
    il_status st = il_lines_next(&n->lines, &n->at.p, &length, n->err);
    *more = st == IL_OK && n->at.p;
    if (*more) {
        n->at.end = n->at.p + length;
        n->at.line = n->lines.line;
    }
    return st;
}

static il_status read_stream(il_native *n)
{
    bool more;
    il_status st = next_line(n, &more);
    if (st == IL_OK && !more)
        return il_fail(n->err, IL_E_INPUT, 0, "the input is empty");
    if (st == IL_OK)
        st = take_first_line(n);
    while (st == IL_OK) {
        st = next_line(n, &more);
        if (st != IL_OK || !more)
            break;
        st = take_line(n);
    }
    if (st == IL_OK && !n->ended)
        st = il_native_fail(n, "the stream ends here without 'end': it was cut");
    return st;
}

/* All but the lines. */
static void free_state(il_native *n)
{
    il_stack_head_free(&n->head);
    il_slice_free(&n->slice);
    il_pair_free(&n->pair);
    il_free(n->lower.vertices);
    il_free(n->lower.group);
    il_free(n->upper.vertices);
    il_free(n->upper.group);
}

static il_status read_source(il_source *source, const il_read_options *options,
                             il_sink *sink, il_report *report, il_error *err)
{
    il_native n = { .options = options, .sink = sink, .report = report, .err = err, .name = il_source_name(source) };
    il_lines_init(&n.lines, source, options->max_line);
    il_status st = read_stream(&n);
    if (st == IL_E_INPUT)
        il_error_set_file(err, il_source_name(source));
    free_state(&n);
    il_lines_free(&n.lines);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; st == IL_OK && i < n; i++)
        st = read_source(source[i], options, sink, report, err);
    return st == IL_OK ? sink->end(sink, err) : st;
}

static bool probe(const unsigned char *head, size_t n)
{
    size_t at = n >= BOM && memcmp(head, byte_order_mark, BOM) == 0 ? BOM : 0;
    return n - at >= MAGIC && memcmp(head + at, magic, MAGIC) == 0;
}

const il_reader il_reader_loft = {
    .name = "loft",
    .extensions = "loft",
    .words = "isoloft's own format: contours and correspondences",
    .probe = probe,
    .read = read_all,
};
