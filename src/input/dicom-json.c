/* dicom-json.c - structure sets as DICOM JSON (DICOM PS3.18, annex F).
 *
 * A dataset is an object: "ggggeeee": { "vr": "DS", "Value": [ ... ] }.  The
 * Value of a sequence holds its items, objects like the dataset.  Members may
 * come in any order, so what a Value holds tells what the element is: objects
 * with tags for keys are items.  Nothing is kept but the values of the element
 * at hand, joined by backslashes as in a DICOM file. */
#include "config.h"
#include "base/alloc.h"
#include "input/json-scan.h"
#include "input/rt-set.h"

#include <string.h>

/* An element whose object is open.  is_wanted: the set takes its value;
 * is_needed: or it is one of the sequences around such elements.
 * is_sequence: its items are given to the set.  says_sequence: so says its vr. */
typedef struct element {
    uint32_t tag;
    long line;
    bool is_wanted, is_needed, is_sequence, says_sequence;
    bool has_value;     /* the member Value was there */
    size_t n_values;    /* those that are no items */
} element;

/* open: the elements around, the innermost last.  text: the values of the
 * innermost, joined. */
typedef struct document {
    il_json_scan json;
    il_rt_set *set;
    size_t max_value;
    enum { OUTSIDE, IN_DATASET, IN_ELEMENT, IN_VALUES } place;
    bool seen;
    element *open;      size_t n, cap;
    char *text;         size_t n_text, cap_text;
    il_error *err;
} document;

static const char TAG_FORM[] = "xxxxxxxx";
enum { TAG_LENGTH = sizeof TAG_FORM - 1 };

static element *innermost(const document *d)
{
    return &d->open[d->n - 1];
}

static il_status fail_element(const document *d, const element *e, const char *words)
{
    return il_fail(d->err, IL_E_INPUT, d->json.line, "(%04x,%04x): %s", e->tag >> 16, e->tag & 0xffff, words);
}

static il_status next(document *d, il_json_event *event)
{
    return il_json_scan_next(&d->json, event, d->err);
}

/* ---- values ---------------------------------------------------------------------- */

/* The JSON text at hand behind the values before it. */
static il_status append_value(document *d, const element *e, size_t n)
{
    const il_json_scan *j = &d->json;
    size_t separator = e->n_values > 0;
    if (d->n_text + separator + n > d->max_value)
        return il_fail(d->err, IL_E_INPUT, j->line, "a value of more than %zu bytes", d->max_value);
    if (!il_grow(&d->text, &d->cap_text, d->n_text + separator + n + 1, 1))
        return il_fail_nomem(d->err);
    if (separator)
        d->text[d->n_text++] = '\\';
    if (n > 0)
        memcpy(d->text + d->n_text, j->text, n);
    d->n_text += n;
    return IL_OK;
}

/* null is a value that is empty. */
static il_status take_scalar(document *d, element *e, il_json_event event)
{
    il_status st = IL_OK;
    if (e->is_sequence && event == IL_JSON_NULL)
        return IL_OK;
    if (e->is_sequence)
        return fail_element(d, e, "not all values of this sequence are items");
    if (e->is_wanted && (event == IL_JSON_TRUE || event == IL_JSON_FALSE))
        return fail_element(d, e, "a value is neither a number nor a string");
    if (e->is_wanted)
        st = append_value(d, e, event == IL_JSON_NULL ? 0 : d->json.n);
    e->n_values++;
    return st;
}

static il_status take_member(document *d, il_json_event event);

/* An object among the values is an item when its first key is a tag, or when it
 * is empty.  Others are names of persons, {"Alphabetic": ...}, which no
 * structure set needs. */
static il_status take_object(document *d, element *e)
{
    il_json_event event;
    uint32_t tag;
    size_t outside = d->json.depth - 1;
    long line = d->json.line;
    if (e->is_wanted)
        return fail_element(d, e, "a value is an object");
    il_status st = next(d, &event);
    if (st != IL_OK)
        return st;
    if (event == IL_JSON_KEY && !il_rt_parse_tag(d->json.text, d->json.n, TAG_FORM, &tag) && !e->is_needed) {
        while (st == IL_OK && d->json.depth > outside)
            st = next(d, &event);
        return st;
    }
    if (e->n_values > 0)
        return fail_element(d, e, "not all values of this sequence are items");
    if (!e->is_sequence)
        st = il_rt_set_begin_sequence(d->set, e->tag, e->line, d->err);
    e->is_sequence = true;
    if (st == IL_OK)
        st = il_rt_set_begin_item(d->set, line, d->err);
    d->place = IN_DATASET;
    return st == IL_OK ? take_member(d, event) : st;
}

static il_status take_value(document *d, il_json_event event)
{
    element *e = innermost(d);
    switch (event) {
    case IL_JSON_ARRAY_END:
        d->place = IN_ELEMENT;
        return IL_OK;
    case IL_JSON_OBJECT:
        return take_object(d, e);
    case IL_JSON_ARRAY:
        return e->is_needed ? fail_element(d, e, "a value is an array") : il_json_scan_skip(&d->json, event, d->err);
    default:
        return take_scalar(d, e, event);
    }
}

/* ---- elements -------------------------------------------------------------------- */

/* The member Value, whose own value EVENT begins. */
static il_status begin_values(document *d, element *e, il_json_event event)
{
    if (e->has_value)
        return fail_element(d, e, "it has two Values");
    e->has_value = true;
    if (event == IL_JSON_ARRAY)
        d->place = IN_VALUES;
    return event == IL_JSON_ARRAY || event == IL_JSON_NULL ? IL_OK : fail_element(d, e, "its Value is no array");
}

static il_status take_vr(document *d, element *e, il_json_event event)
{
    if (event != IL_JSON_STRING)
        return fail_element(d, e, "its vr is no string");
    e->says_sequence = d->json.n == 2 && memcmp(d->json.text, "SQ", 2) == 0;
    return IL_OK;
}

static il_status take_bulk(document *d, const element *e, il_json_event event)
{
    if (e->is_needed)
        return fail_element(d, e, "its value is elsewhere (BulkDataURI): have it written into the JSON");
    return il_json_scan_skip(&d->json, event, d->err);
}

static il_status take_binary(document *d, const element *e, il_json_event event)
{
    if (e->is_needed)
        return fail_element(d, e, "its value is binary (InlineBinary), as its type was not known when the JSON was made");
    return il_json_scan_skip(&d->json, event, d->err);
}

/* The element is whole. */
static il_status end_element(document *d)
{
    element *e = innermost(d);
    il_status st = IL_OK;
    if (e->says_sequence && e->n_values > 0 && e->is_needed)
        return fail_element(d, e, "not all values of this sequence are items");
    if (e->says_sequence && !e->is_sequence)
        st = il_rt_set_begin_sequence(d->set, e->tag, e->line, d->err);
    if (st == IL_OK && (e->says_sequence || e->is_sequence))
        st = il_rt_set_end_sequence(d->set, d->json.line, d->err);
    else if (st == IL_OK && e->is_wanted)
        st = il_rt_set_element(d->set, e->tag, d->n_text > 0 ? d->text : "", d->n_text, true, e->line, d->err);
    d->n--;
    d->place = IN_DATASET;
    return st;
}

/* Inside of an element's object: a key with its value, or the end. */
static il_status take_attribute(document *d, il_json_event event)
{
    static const struct { const char *key; int which; } keys[] = {
        { "vr", 0 }, { "Value", 1 }, { "BulkDataURI", 2 }, { "InlineBinary", 3 } };
    element *e = innermost(d);
    int which = -1;
    if (event == IL_JSON_OBJECT_END)
        return end_element(d);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (d->json.n == strlen(keys[i].key) && memcmp(d->json.text, keys[i].key, d->json.n) == 0)
            which = keys[i].which;
    il_status st = next(d, &event);
    if (st != IL_OK)
        return st;
    switch (which) {
    case 0:  return take_vr(d, e, event);
    case 1:  return begin_values(d, e, event);
    case 2:  return take_bulk(d, e, event);
    case 3:  return take_binary(d, e, event);
    default: return il_json_scan_skip(&d->json, event, d->err);
    }
}

/* ---- datasets and items ------------------------------------------------------------ */

static il_status end_of_object(document *d)
{
    long line = d->json.line;
    if (d->n > 0) {
        d->place = IN_VALUES;
        return il_rt_set_end_item(d->set, line, d->err);
    }
    d->place = OUTSIDE;
    return il_rt_set_end_dataset(d->set, line, d->err);
}

/* Inside of a dataset or item: a tag with its element, or the end. */
static il_status take_member(document *d, il_json_event event)
{
    const il_json_scan *j = &d->json;
    element e = { .line = j->line };
    if (event == IL_JSON_OBJECT_END)
        return end_of_object(d);
    if (!il_rt_parse_tag(j->text, j->n, TAG_FORM, &e.tag))
        return il_fail(d->err, IL_E_INPUT, j->line, "'%.*s' is no tag: eight hex digits",
                       (int)(j->n < 40 ? j->n : 40), j->text);
    e.is_wanted = il_rt_set_wants(d->set, e.tag);
    e.is_needed = il_rt_set_needs(d->set, e.tag);
    il_status st = next(d, &event);
    if (st != IL_OK)
        return st;
    if (event != IL_JSON_OBJECT)
        return fail_element(d, &e, "the element is no object");
    if (!il_grow(&d->open, &d->cap, d->n + 1, sizeof *d->open))
        return il_fail_nomem(d->err);
    d->open[d->n++] = e;
    d->n_text = 0;
    d->place = IN_ELEMENT;
    return IL_OK;
}

/* A dataset begins, or an array of them begins or ends. */
static il_status take_outside(document *d, il_json_event event)
{
    long line = d->json.line;
    bool is_list = event == IL_JSON_ARRAY && d->json.depth == 1;
    if (is_list || event == IL_JSON_ARRAY_END)
        return IL_OK;
    if (event != IL_JSON_OBJECT)
        return il_fail(d->err, IL_E_INPUT, line, "a data set is an object, { ... }, and nothing else");
    d->seen = true;
    d->place = IN_DATASET;
    return il_rt_set_begin_dataset(d->set, line, d->err);
}

static il_status take(document *d, il_json_event event)
{
    switch (d->place) {
    case IN_VALUES:  return take_value(d, event);
    case IN_ELEMENT: return take_attribute(d, event);
    case IN_DATASET: return take_member(d, event);
    default:         return take_outside(d, event);
    }
}

static il_status parse(il_source *source, il_rt_set *set, const il_read_options *options, il_error *err)
{
    document d = { .set = set, .max_value = options->max_line, .err = err };
    il_json_event event;
    il_json_scan_init(&d.json, source, options);
    il_status st = next(&d, &event);
    while (st == IL_OK && event != IL_JSON_END) {
        st = take(&d, event);
        if (st == IL_OK)
            st = next(&d, &event);
    }
    if (st == IL_OK && !d.seen)
        st = il_fail(err, IL_E_INPUT, d.json.line, "there is no data set in this file");
    il_json_scan_free(&d.json);
    il_free(d.open);
    il_free(d.text);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_rt_read(parse, source, n, options, sink, report, err);
}

/* ---- telling it apart --------------------------------------------------------------- */

/* An object, or an array of them, whose first key is a tag with an object. */
static bool probe(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    uint32_t tag;
    size_t i = n >= 3 && memcmp(s, "\xef\xbb\xbf", 3) == 0 ? 3 : 0, list = il_json_behind(s, n, i, '[');
    i = il_json_behind(s, n, list ? list : i, '{');
    if (i == 0 || (i = il_json_behind(s, n, i, '"')) == 0 || n - i < TAG_LENGTH || !il_rt_parse_tag(s + i, TAG_LENGTH, TAG_FORM, &tag))
        return false;
    i += TAG_LENGTH;
    if (i >= n || s[i] != '"')
        return false;
    i = il_json_behind(s, n, i + 1, ':');
    return i > 0 && il_json_behind(s, n, i, '{') > 0;
}

const il_reader il_reader_dicom_json = {
    .name = "dicom-json",
    .extensions = "",
    .words = "DICOM-RT structure set as DICOM JSON (dcm2json)",
    .is_patient = true,
    .probe = probe,
    .read = read_all,
};
