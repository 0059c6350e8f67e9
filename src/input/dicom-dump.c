/* dicom-dump.c - the text that `dcmdump +L` writes (formats/dicom.txt).
 *
 * A line an element: "(gggg,eeee) VR value  # length, VM name".  Brackets are
 * lines too, so the indentation says nothing that they do not.  Values stand in
 * [ ] as they are in the file, so that only the last ']' before the last '#'
 * can be the value's end. */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/rt-set.h"

#include <stdio.h>
#include <string.h>

static const char TAG_FORM[] = "(xxxx,xxxx)";
enum { TAG_LENGTH = sizeof TAG_FORM - 1 };

static const char byte_order_mark[] = "\xEF\xBB\xBF"; /* what shells of Windows put in front */

static const uint32_t TAG_DATA = IL_TAG(0x3006, 0x0050), TAG_ITEM = IL_TAG(0xfffe, 0xe000),
                      TAG_ITEM_END = IL_TAG(0xfffe, 0xe00d), TAG_SEQUENCE_END = IL_TAG(0xfffe, 0xe0dd);

/* value: the lines of a value that contains line ends, put together again. */
typedef struct dump {
    il_lines lines;
    il_rt_set *set;
    bool in_dataset;
    size_t max_value;
    char *value;        size_t n_value, cap_value;
    il_error *err;
} dump;

/* ---- the parts of a line ------------------------------------------------------ */

/* One element as text: value[0..n), between the VR and the '#'. */
typedef struct element_line {
    uint32_t tag;
    char vr[3];
    const char *value;
    size_t n;
    size_t vm;          /* how many values there are, by what stands behind the '#' */
    bool has_tail;      /* it is there */
    long line;
} element_line;

/* A tag at the start of S[0..N). */
static bool parse_tag(const char *s, size_t n, uint32_t *tag)
{
    return n >= TAG_LENGTH && il_rt_parse_tag(s, TAG_LENGTH, TAG_FORM, tag);
}

static size_t skip_blanks(const char *s, size_t n, size_t i)
{
    while (i < n && (s[i] == ' ' || s[i] == '\t'))
        i++;
    return i;
}

static size_t skip_digits(const char *s, size_t n, size_t i)
{
    while (i < n && s[i] >= '0' && s[i] <= '9')
        i++;
    return i;
}

/* "# length, VM name" at S[0..N): the length is a number, or u/l where undefined. */
static bool parse_tail(const char *s, size_t n, size_t *vm)
{
    size_t i = skip_blanks(s, n, 1), from = i;
    i = n - i >= 3 && memcmp(s + i, "u/l", 3) == 0 ? i + 3 : skip_digits(s, n, i);
    if (i == from || i >= n || s[i] != ',')
        return false;
    from = skip_blanks(s, n, i + 1);
    i = skip_digits(s, n, from);
    *vm = 0;
    for (size_t k = from; k < i && *vm < SIZE_MAX / 20; k++)
        *vm = 10 * *vm + (size_t)(s[k] - '0');
    return i > from && (i == n || s[i] == ' ');
}

/* The last '#' of S[0..N), or null. */
static const char *last_hash(const char *s, size_t n)
{
    while (n > 0 && s[n - 1] != '#')
        n--;
    return n > 0 ? s + n - 1 : NULL;
}

/* Cut the value at S[0..N) at its tail, if it has one; that begins in its last
 * line, at FROM or later. */
static void cut_tail(element_line *e, const char *s, size_t from, size_t n)
{
    const char *hash = last_hash(s + from, n - from);
    e->value = s;
    e->has_tail = hash && parse_tail(hash, (size_t)(s + n - hash), &e->vm);
    e->n = e->has_tail ? (size_t)(hash - s) : n;
    while (e->has_tail && e->n > 0 && s[e->n - 1] == ' ')
        e->n--;
}

/* False when S[0..N) is no element. */
static bool parse_element(element_line *e, const char *s, size_t n, long line)
{
    size_t i = 0;
    while (i < n && (s[i] == ' ' || s[i] == '|'))
        i++;
    *e = (element_line){ .line = line };
    if (!parse_tag(s + i, n - i, &e->tag))
        return false;
    i = skip_blanks(s, n, i + TAG_LENGTH);
    if (n - i < 2)
        return false;
    memcpy(e->vr, s + i, 2);
    i = skip_blanks(s, n, i + 2);
    cut_tail(e, s + i, 0, n - i);
    return true;
}

static bool starts(const element_line *e, const char *with)
{
    return il_text_begins(e->value, e->n, with);
}

/* ---- elements ------------------------------------------------------------------------ */

static bool append(dump *d, const char *s, size_t n)
{
    if (!il_grow(&d->value, &d->cap_value, d->n_value + n + 1, 1))
        return false;
    memcpy(d->value + d->n_value, s, n);
    d->n_value += n;
    return true;
}

/* A value with line ends in it goes on in the next lines, up to the one with
 * the tail. */
static il_status join_lines(dump *d, element_line *e)
{
    d->n_value = 0;
    if (!append(d, e->value, e->n))
        return il_fail_nomem(d->err);
    while (!e->has_tail) {
        const char *line;
        size_t n;
        il_status st = il_lines_next(&d->lines, &line, &n, d->err);
        if (st != IL_OK)
            return st;
        if (!line)
            return il_fail(d->err, IL_E_INPUT, e->line, "the file ends inside this value: it was cut");
        if (d->n_value + n > d->max_value)
            return il_fail(d->err, IL_E_INPUT, e->line, "a value of more than %zu bytes", d->max_value);
        size_t from = d->n_value + 1;
        if (!append(d, "\n", 1) || !append(d, line, n))
            return il_fail_nomem(d->err);
        cut_tail(e, d->value, from, d->n_value);
    }
    return IL_OK;
}

static size_t count_values(const char *s, size_t n)
{
    size_t many = n > 0;
    for (size_t i = 0; i < n; i++)
        many += s[i] == '\\';
    return many;
}

/* Give the set a value it wants, which must be there in full. */
static il_status take_value(dump *d, const element_line *e)
{
    const char *s = e->value;
    size_t n = e->n;
    if (starts(e, "(no value available)"))
        return il_rt_set_element(d->set, e->tag, "", 0, false, e->line, d->err);
    if (starts(e, "(not loaded)"))
        return il_fail(d->err, IL_E_INPUT, e->line, "a value was not loaded: make the text with dcmdump +L (and without -M)");
    if (n > 0 && s[0] == '=')
        return il_rt_set_element(d->set, e->tag, s + 1, n - 1, false, e->line, d->err);
    if (n > 0 && s[0] == '[') {
        if (n < 2 || s[n - 1] != ']')
            return il_fail(d->err, IL_E_INPUT, e->line, "a value is cut: make the text with dcmdump +L");
        s++;
        n -= 2;
    }
    if (e->tag == TAG_DATA && count_values(s, n) != e->vm)
        return il_fail(d->err, IL_E_INPUT, e->line, "the contour data shows %zu of its %zu values: make the text with dcmdump +L",
                       count_values(s, n), e->vm);
    return il_rt_set_element(d->set, e->tag, s, n, false, e->line, d->err);
}

static il_status take_element(dump *d, element_line *e)
{
    bool is_item_of_bytes = e->tag == TAG_ITEM && memcmp(e->vr, "pi", 2) == 0;
    if (is_item_of_bytes)
        return IL_OK;
    if (e->tag == TAG_ITEM)
        return il_rt_set_begin_item(d->set, e->line, d->err);
    if (e->tag == TAG_ITEM_END)
        return il_rt_set_end_item(d->set, e->line, d->err);
    if (e->tag == TAG_SEQUENCE_END)
        return il_rt_set_end_sequence(d->set, e->line, d->err);
    if (starts(e, "(Sequence") || starts(e, "(PixelSequence"))
        return il_rt_set_begin_sequence(d->set, e->tag, e->line, d->err);
    if (starts(e, "[") && !e->has_tail) {
        il_status st = join_lines(d, e);
        if (st != IL_OK)
            return st;
    }
    return il_rt_set_wants(d->set, e->tag) ? take_value(d, e) : IL_OK;
}

/* ---- the file ------------------------------------------------------------------------- */

static il_status end_dataset(dump *d)
{
    if (!d->in_dataset)
        return IL_OK;
    d->in_dataset = false;
    return il_rt_set_end_dataset(d->set, d->lines.line, d->err);
}

static il_status begin_dataset(dump *d)
{
    if (d->in_dataset)
        return IL_OK;
    d->in_dataset = true;
    return il_rt_set_begin_dataset(d->set, d->lines.line, d->err);
}

/* A line that is no element: dcmdump's headings, and its warnings when they were
 * led into the same file. */
static il_status take_heading(dump *d, const char *s, size_t n)
{
    if (il_text_begins(s, n, "# Dicom-File-Format") || il_text_begins(s, n, "# Dicom-Meta-Information-Header"))
        return end_dataset(d);
    if (il_text_begins(s, n, "# Dicom-Data-Set")) {
        il_status st = end_dataset(d);
        return st == IL_OK ? begin_dataset(d) : st;
    }
    if (skip_blanks(s, n, 0) == n || s[0] == '#' || il_text_begins(s, n, "W: "))
        return IL_OK;
    return il_fail(d->err, IL_E_INPUT, d->lines.line, "no line that dcmdump writes: '%.*s'", (int)(n < 60 ? n : 60), s);
}

static il_status take_line(dump *d, const char *s, size_t n)
{
    element_line e;
    size_t mark = d->lines.line == 1 && il_text_begins(s, n, byte_order_mark) ? strlen(byte_order_mark) : 0;
    s += mark;
    n -= mark;
    if (!parse_element(&e, s, n, d->lines.line))
        return take_heading(d, s, n);
    if (e.tag >> 16 == 0x0002)
        return IL_OK; /* of the file, not of the dataset */
    il_status st = begin_dataset(d);
    return st == IL_OK ? take_element(d, &e) : st;
}

static il_status parse(il_source *source, il_rt_set *set, const il_read_options *options, il_error *err)
{
    dump d = { .set = set, .err = err, .max_value = options->max_line };
    bool seen = false;
    il_status st;
    il_lines_init(&d.lines, source, options->max_line);
    for (;;) {
        const char *line;
        size_t n;
        st = il_lines_next(&d.lines, &line, &n, err);
        if (st != IL_OK || !line)
            break;
        st = take_line(&d, line, n);
        seen |= d.in_dataset;
        if (st != IL_OK)
            break;
    }
    if (st == IL_OK && !seen)
        st = il_fail(err, IL_E_INPUT, d.lines.line, "there is no data set in this text");
    if (st == IL_OK)
        st = end_dataset(&d);
    il_lines_free(&d.lines);
    il_free(d.value);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_rt_read(parse, source, n, options, sink, report, err);
}

static bool probe(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    uint32_t tag;
    size_t i = il_text_begins(s, n, byte_order_mark) ? strlen(byte_order_mark) : 0;
    while (i < n && (s[i] == '\n' || s[i] == '\r' || s[i] == ' '))
        i++;
    return il_text_begins(s + i, n - i, "# Dicom-") || il_text_begins(s + i, n - i, "# dcmdump") || parse_tag(s + i, n - i, &tag);
}

const il_reader il_reader_dcmdump = {
    .name = "dcmdump",
    .extensions = "",
    .words = "DICOM-RT structure set as the text of dcmdump +L",
    .is_patient = true,
    .probe = probe,
    .read = read_all,
};
