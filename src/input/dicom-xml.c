/* dicom-xml.c - DICOM as XML (formats/dicom.txt), in both of its forms: the Native
 * DICOM Model of PS3.19, annex A, and that of dcmtk's dcm2xml.  Elements are told
 * by their names alone; the two forms have none in common. */
#include "config.h"
#include "base/alloc.h"
#include "input/charset.h"
#include "input/dicom-quoted.h"
#include "input/dicom-values.h"
#include "input/rt-set.h"
#include "input/xml-push.h"

#include <string.h>

/* What an open element of XML is.  A wrapper stands outside of data sets, and
 * is only looked into. */
typedef enum kind {
    KIND_WRAPPER, KIND_DATASET, KIND_SEQUENCE, KIND_ITEM,
    KIND_ATTRIBUTE,     /* DicomAttribute, with Value elements inside */
    KIND_VALUE,
    KIND_ELEMENT,       /* dcmtk's element: the values are its text */
    KIND_BINARY, KIND_HEADER, KIND_UNKNOWN
} kind;

/* open[depth]: the elements around, less the n_skipped innermost, which mean
 * nothing here.  level: depth inside the data set at hand, 0 when there is none.
 * Then the attribute at hand: does the set want it, or need it, and where it begins.
 * quotes: the file declares no encoding, so non-ASCII characters may be bytes. */
typedef struct parser {
    il_rt_set *set;
    size_t max_depth;
    unsigned char *open;        size_t depth, cap;
    size_t n_skipped, level;
    bool seen, is_wanted, is_needed;
    uint32_t tag;
    long line;
    il_dicom_values values;
    char *charset;              /* of the data set at hand */
    bool quotes;
} parser;

static kind kind_of(const char *name)
{
    static const struct { const char *name; kind kind; } names[] = { /* the commonest first */
        { "Value", KIND_VALUE }, { "DicomAttribute", KIND_ATTRIBUTE }, { "element", KIND_ELEMENT }, { "Item", KIND_ITEM },
        { "item", KIND_ITEM }, { "sequence", KIND_SEQUENCE }, { "NativeDicomModel", KIND_DATASET }, { "data-set", KIND_DATASET },
        { "BulkData", KIND_BINARY }, { "InlineBinary", KIND_BINARY }, { "meta-header", KIND_HEADER } };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i].name, name) == 0)
            return names[i].kind;
    return KIND_UNKNOWN;
}

static kind innermost(const parser *p)
{
    return p->depth > 0 ? (kind)p->open[p->depth - 1] : KIND_WRAPPER;
}

/* ---- tags and VRs ------------------------------------------------------------------ */

/* Eight digits, with a comma after four or without. */
static il_status take_tag(const il_xml_element *e, uint32_t *tag, il_error *err)
{
    size_t n = 0;
    const char *s = il_xml_attribute(e, "tag", &n);
    *tag = 0;
    if (s && (il_rt_parse_tag(s, n, "xxxxxxxx", tag) || il_rt_parse_tag(s, n, "xxxx,xxxx", tag)))
        return IL_OK;
    return s ? il_fail(err, IL_E_INPUT, e->line, "'%.*s' is no tag of DICOM: eight hexadecimal digits are", (int)(n < 20 ? n : 20), s)
             : il_fail(err, IL_E_INPUT, e->line, "%.20s without a tag", e->name);
}

static bool has_value(const il_xml_element *e, const char *name, const char *value)
{
    size_t n;
    const char *s = il_xml_attribute(e, name, &n);
    return s && n == strlen(value) && memcmp(s, value, n) == 0;
}

/* Text, in which white space counts. */
static bool is_text_vr(const il_xml_element *e)
{
    static const char *const vrs[] = { "LO", "SH", "LT", "ST", "UT", "UC", "PN" };
    for (size_t i = 0; i < sizeof vrs / sizeof *vrs; i++)
        if (has_value(e, "vr", vrs[i]))
            return true;
    return false;
}

/* ---- data sets ---------------------------------------------------------------------- */

static il_status begin_dataset(parser *p, size_t level, long line, il_error *err)
{
    if (p->level > 0)
        return il_fail(err, IL_E_INPUT, line, "a data set inside another");
    p->level = level;
    p->seen = true;
    il_free(p->charset);
    p->charset = NULL;
    return il_rt_set_begin_dataset(p->set, line, err);
}

/* Attributes outside of NativeDicomModel and data-set, as in a piece of a file,
 * are a data set that ends with the element around them.  There has to be one,
 * for nothing else would tell that the piece is whole. */
static il_status need_dataset(parser *p, const il_xml_element *e, il_error *err)
{
    if (p->level > 0)
        return IL_OK;
    if (p->depth == 0)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s outside of all elements: NativeDicomModel or data-set belongs around it", e->name);
    return begin_dataset(p, p->depth, e->line, err);
}

/* ---- attributes --------------------------------------------------------------------- */

static il_status begin_attribute(parser *p, const il_xml_element *e, il_error *err)
{
    il_status st = take_tag(e, &p->tag, err);
    p->is_wanted = st == IL_OK && il_rt_set_wants(p->set, p->tag);
    p->is_needed = st == IL_OK && il_rt_set_needs(p->set, p->tag);
    p->line = e->line;
    il_dicom_values_clear(&p->values, is_text_vr(e));
    return st;
}

#define NOT_TEXT "is not in the file, or there as binary data only: make the XML with all values in it"

static il_status refuse_binary(const parser *p, const char *how, il_error *err)
{
    return il_fail(err, IL_E_INPUT, p->line, "the value of (%04lx,%04lx) %s", (unsigned long)(p->tag >> 16),
                   (unsigned long)(p->tag & 0xFFFF), how);
}

/* dcmtk's element, whose values are its text. */
static il_status begin_element(parser *p, const il_xml_element *e, il_error *err)
{
    il_status st = begin_attribute(p, e, err);
    if (st != IL_OK)
        return st;
    if (p->is_needed && has_value(e, "loaded", "no"))
        return refuse_binary(p, "was not loaded: make the XML with dcm2xml +M", err);
    if (p->is_needed && il_xml_attribute(e, "binary", &(size_t){ 0 }) && !has_value(e, "binary", "no"))
        return refuse_binary(p, "is not text but binary data", err);
    return p->is_wanted ? il_dicom_values_begin(&p->values, NULL, 0, err) : IL_OK;
}

/* The attribute at hand is whole. */
static il_status end_attribute(parser *p, il_error *err)
{
    const char *s;
    size_t n;
    if (!p->is_wanted)
        return IL_OK;
    il_status st = il_dicom_values_join(&p->values, &s, &n, err);
    if (st != IL_OK)
        return st;
    if (p->tag == IL_TAG(0x0008, 0x0005)) {
        il_free(p->charset);
        p->charset = il_strndup(s, n < IL_CHARSET_MOST ? n : IL_CHARSET_MOST);
        if (!p->charset)
            return il_fail_nomem(err);
    }
    char *text = NULL;
    if (p->quotes && p->values.is_text) {
        st = il_dicom_unquote(p->charset, s, n, &text, &n, err);
        s = text;
    }
    if (st == IL_OK)
        st = il_rt_set_element(p->set, p->tag, s, n, true, p->line, err);
    il_free(text);
    return st;
}

/* ---- start tags --------------------------------------------------------------------- */

static il_status push(parser *p, kind k, long line, il_error *err)
{
    if (p->depth >= p->max_depth)
        return il_fail(err, IL_E_INPUT, line, "elements nested more than %zu deep", p->max_depth);
    if (!il_grow(&p->open, &p->cap, p->depth + 1, 1))
        return il_fail_nomem(err);
    p->open[p->depth++] = (unsigned char)k;
    return IL_OK;
}

/* Inside a data set or an item, or where one may begin. */
static il_status start_in_item(parser *p, const il_xml_element *e, kind *k, il_error *err)
{
    uint32_t tag;
    bool is_attribute = *k == KIND_ATTRIBUTE || *k == KIND_ELEMENT || *k == KIND_SEQUENCE;
    il_status st = is_attribute ? need_dataset(p, e, err) : IL_OK;
    if (st != IL_OK)
        return st;
    if (*k == KIND_ATTRIBUTE && has_value(e, "vr", "SQ"))
        *k = KIND_SEQUENCE;
    switch (*k) {
    case KIND_DATASET:   return begin_dataset(p, p->depth + 1, e->line, err);
    case KIND_ATTRIBUTE: return begin_attribute(p, e, err);
    case KIND_ELEMENT:   return begin_element(p, e, err);
    case KIND_SEQUENCE:
        st = take_tag(e, &tag, err);
        return st == IL_OK ? il_rt_set_begin_sequence(p->set, tag, e->line, err) : st;
    case KIND_ITEM:
        return p->level > 0 ? il_rt_set_begin_item(p->set, e->line, err) : IL_OK;
    case KIND_VALUE:
        return p->level > 0 ? il_fail(err, IL_E_INPUT, e->line, "a value outside of an attribute") : IL_OK;
    default:
        return IL_OK;
    }
}

/* Inside DicomAttribute: values, or items when it does not say that it is a
 * sequence. */
static il_status start_in_attribute(parser *p, const il_xml_element *e, kind *k, il_error *err)
{
    size_t n;
    if (*k == KIND_VALUE) {
        const char *number = il_xml_attribute(e, "number", &n);
        return p->is_wanted ? il_dicom_values_begin(&p->values, number, n, err) : IL_OK;
    }
    if (*k == KIND_BINARY && p->is_needed)
        return refuse_binary(p, NOT_TEXT, err);
    if (*k != KIND_ITEM) {
        *k = KIND_UNKNOWN;
        return IL_OK;
    }
    if (p->values.n_values > 0)
        return il_fail(err, IL_E_INPUT, e->line, "an item among values");
    p->open[p->depth - 1] = KIND_SEQUENCE;
    il_status st = il_rt_set_begin_sequence(p->set, p->tag, p->line, err);
    return st == IL_OK ? il_rt_set_begin_item(p->set, e->line, err) : st;
}

static il_status start_in_sequence(parser *p, const il_xml_element *e, kind *k, il_error *err)
{
    if (*k == KIND_ITEM)
        return il_rt_set_begin_item(p->set, e->line, err);
    if (*k == KIND_BINARY || *k == KIND_VALUE)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s in a sequence, which has items", e->name);
    *k = KIND_UNKNOWN;
    return IL_OK;
}

static il_status on_start(void *self, const il_xml_element *e, il_error *err)
{
    parser *p = self;
    kind k = kind_of(e->name), in = innermost(p);
    il_status st;
    if (p->n_skipped > 0) {
        p->n_skipped++;
        return IL_OK;
    }
    if (in == KIND_VALUE || in == KIND_ELEMENT)
        st = il_fail(err, IL_E_INPUT, e->line, "an element inside a value");
    else if (in == KIND_ATTRIBUTE)
        st = start_in_attribute(p, e, &k, err);
    else if (in == KIND_SEQUENCE)
        st = start_in_sequence(p, e, &k, err);
    else
        st = start_in_item(p, e, &k, err);
    if (st != IL_OK)
        return st;
    bool is_known = k != KIND_UNKNOWN && k != KIND_HEADER && k != KIND_BINARY && p->level > 0;
    if (p->level > 0 ? is_known : k != KIND_HEADER)
        return push(p, is_known ? k : KIND_WRAPPER, e->line, err);
    p->n_skipped = 1;
    return IL_OK;
}

/* ---- end tags and text -------------------------------------------------------------- */

static il_status end_kind(parser *p, kind k, long line, il_error *err)
{
    switch (k) {
    case KIND_SEQUENCE:  return il_rt_set_end_sequence(p->set, line, err);
    case KIND_ITEM:      return il_rt_set_end_item(p->set, line, err);
    case KIND_ATTRIBUTE: return end_attribute(p, err);
    case KIND_ELEMENT:
        if (p->is_wanted)
            il_dicom_values_end(&p->values);
        return end_attribute(p, err);
    case KIND_VALUE:
        if (p->is_wanted)
            il_dicom_values_end(&p->values);
        return IL_OK;
    default:
        return IL_OK;
    }
}

static il_status on_end(void *self, long line, il_error *err)
{
    parser *p = self;
    if (p->n_skipped > 0) {
        p->n_skipped--;
        return IL_OK;
    }
    il_status st = end_kind(p, (kind)p->open[--p->depth], line, err);
    if (st != IL_OK || p->level == 0 || p->depth >= p->level)
        return st;
    p->level = 0;
    return il_rt_set_end_dataset(p->set, line, err);
}

static il_status on_text(void *self, const char *s, size_t n, long line, il_error *err)
{
    parser *p = self;
    kind in = innermost(p);
    if (p->n_skipped > 0 || p->level == 0)
        return IL_OK;
    if (in == KIND_VALUE || in == KIND_ELEMENT)
        return p->is_wanted ? il_dicom_values_add(&p->values, s, n, err) : IL_OK;
    for (size_t i = 0; i < n; i++) {
        line += s[i] == '\n' ? 1 : 0;
        if (!il_xml_is_blank(s[i]))
            return il_fail(err, IL_E_INPUT, line, "text outside of a value");
    }
    return IL_OK;
}

/* ---- the file ------------------------------------------------------------------------- */

static void on_declaration(void *self, bool has_encoding)
{
    ((parser *)self)->quotes = !has_encoding;
}

static il_status on_finish(void *self, long line, il_error *err)
{
    const parser *p = self;
    if (p->depth > 0 || p->n_skipped > 0)
        return il_fail(err, IL_E_INPUT, line, "the file ends inside an element: it was cut");
    return p->seen ? IL_OK : il_fail(err, IL_E_INPUT, line, "there is no data set of DICOM in this XML");
}

static const il_xml_client client = {
    .what = "DICOM",
    .quotes_controls = true,
    .declaration = on_declaration,
    .start = on_start,
    .end = on_end,
    .text = on_text,
    .finish = on_finish,
};

/* A sequence is an element with its items inside, in both forms. */
static size_t xml_depth(size_t max_depth)
{
    enum { AROUND = 16 };
    return max_depth < SIZE_MAX / 2 - AROUND ? 2 * max_depth + AROUND : SIZE_MAX;
}

static il_status parse(il_source *source, il_rt_set *set, const il_read_options *options, il_error *err)
{
    parser p = { .set = set, .max_depth = xml_depth(options->max_depth) };
    il_dicom_values_init(&p.values, options->max_line);
    il_status st = il_xml_read(source, &client, &p, options->max_line, err);
    il_dicom_values_free(&p.values);
    il_free(p.open);
    il_free(p.charset);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_rt_read(parse, source, n, options, sink, report, err);
}

/* ---- the probe ------------------------------------------------------------------------- */

/* Is the name S[0..N), its prefix aside, NAME? */
static bool is_name(const char *s, size_t n, const char *name)
{
    const char *colon = memchr(s, ':', n);
    size_t skip = colon ? (size_t)(colon - s) + 1 : 0;
    return n - skip == strlen(name) && memcmp(s + skip, name, n - skip) == 0;
}

/* A tag of a name that only DICOM has, anywhere in S[0..N). */
static bool has_tag(const char *s, size_t n)
{
    for (const char *p = s, *end = s + n; (p = memchr(p, '<', (size_t)(end - p))) != NULL; p++) {
        const char *name = p + 1, *stop = name;
        while (stop < end && !il_xml_is_blank(*stop) && *stop != '>')
            stop++;
        size_t length = (size_t)(stop - name);
        if (is_name(name, length, "NativeDicomModel") || is_name(name, length, "DicomAttribute") || is_name(name, length, "data-set"))
            return true;
    }
    return false;
}

/* What is wrapped in elements of other names is found by what is inside. */
static bool probe(const unsigned char *head, size_t n)
{
    bool is_type;
    size_t n_name;
    const char *s = (const char *)head, *name = il_xml_first_name(s, n, &n_name, &is_type);
    if (n_name == 0 || is_name(name, n_name, "svg"))
        return false;
    return is_name(name, n_name, "file-format") || is_name(name, n_name, "NativeDicomModel") ||
           has_tag(name - 1, n - (size_t)(name - 1 - s));
}

const il_reader il_reader_dicom_xml = {
    .name = "dicom-xml",
    .extensions = "",
    .words = "DICOM-RT structure set as XML (PS3.19, or dcm2xml)",
    .is_patient = true,
    .probe = probe,
    .read = read_all,
};
