/* rt-set.c - where the elements of a structure set go: PS3.3, C.8.8.5 (names),
 * C.8.8.6 (contours) and C.8.8.8 (interpreted types). */
#include "config.h"
#include "input/rt-set.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "base/number.h"
#include "base/text.h"
#include "input/charset.h"
#include "input/rt-roi.h"
#include "input/rt-stacks.h"
#include "model/ring.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Where in the dataset the parser is: each list is a sequence and odd, the place
 * behind it one of its items. */
typedef enum place {
    PLACE_DATASET,
    PLACE_ROI_LIST, PLACE_ROI,
    PLACE_CONTOURS_LIST, PLACE_CONTOURS,
    PLACE_CONTOUR_LIST, PLACE_CONTOUR,
    PLACE_OBSERVATION_LIST, PLACE_OBSERVATION,
    PLACE_OTHER_LIST, PLACE_OTHER
} place;

/* Ranks of ROIs: those of the list (3006,0020) as it has them, then those that only
 * contours name, as they came, then those that are only observed, of which
 * nothing becomes.  A file may have these three in any order.  To these the number
 * of the item is added, so that no two are equal. */
static const size_t RANK_DRAWN = SIZE_MAX / 4, RANK_OBSERVED = SIZE_MAX / 2;

struct il_rt_set {
    const char *file;
    const il_read_options *options;
    il_sink *sink;
    il_report *report;
    unsigned char *place;       /* open brackets, the innermost last */
    size_t depth, cap_depth;
    char *charset, *modality;
    bool has_list, has_contours, has_observations; /* there are these sequences, be they empty */
    bool is_charset_noted;      /* that it is unknown has been told */
    il_rt_roi *roi;             size_t n, cap;
    size_t n_items;             /* of all three sequences by now */
    il_keymap by_number;        /* ROI number -> index in roi */
    il_rt_roi item;             /* of the item at hand */
    il_rt_contour contour;      /* likewise */
    char *kind;                 /* of the contour at hand: CLOSED_PLANAR, ... */
    bool has_data, has_count;
    size_t n_points;            /* that the file states for it */
};

/* ---- texts and numbers --------------------------------------------------------- */

/* Spaces at the ends mean nothing in DICOM (PS3.5, 6.2), and NUL fills up. */
static void trim(const char **s, size_t *n)
{
    while (*n > 0 && ((*s)[*n - 1] == ' ' || (*s)[*n - 1] == '\0'))
        (*n)--;
    while (*n > 0 && **s == ' ')
        (*s)++, (*n)--;
}

static bool is_ascii(const char *s, size_t n)
{
    size_t i = 0;
    while (i < n && !((unsigned char)s[i] & 0x80))
        i++;
    return i == n;
}

/* Replace *TO by the value in UTF-8; null when it is empty. */
static il_status take_text(il_rt_set *s, char **to, const char *text, size_t n, bool is_utf8, il_error *err)
{
    il_free(*to);
    *to = NULL;
    trim(&text, &n);
    if (n == 0)
        return IL_OK;
    if (is_utf8 && il_utf8_valid(text, n) && !memchr(text, '\0', n)) {
        *to = il_strndup(text, n);
        return *to ? IL_OK : il_fail_nomem(err);
    }
    const char *charset = is_utf8 ? "ISO_IR 192" : s->charset ? s->charset : "";
    size_t n_out = 0, n_bad = 0;
    bool known = true;
    il_status st = il_charset_to_utf8(charset, strlen(charset), text, n, to, &n_out, &n_bad, &known, err);
    if (st == IL_OK && !known && !s->is_charset_noted && !is_ascii(text, n)) {
        s->is_charset_noted = true;
        il_report_note(s->report, "the character set '%s' is not known; names are taken as UTF-8 or ISO-8859-1", charset);
    }
    if (st == IL_OK && n_bad > 0)
        il_report_note(&s->item.report, "%zu bytes of '%s' are no characters of the file's character set", n_bad, *to);
    return st;
}

static bool parse_whole(const char *text, size_t n, long *value)
{
    double v = 0;
    trim(&text, &n);
    if (n == 0 || il_number_parse(text, n, &v) != n || v != floor(v) || fabs(v) > INT_MAX)
        return false;
    *value = (long)v;
    return true;
}

bool il_rt_parse_tag(const char *s, size_t n, const char *form, uint32_t *tag)
{
    uint32_t value = 0;
    if (n != strlen(form))
        return false;
    for (size_t i = 0; i < n; i++) {
        int digit = il_hex_digit(s[i]);
        if (form[i] == 'x' ? digit < 0 : s[i] != form[i])
            return false;
        if (form[i] == 'x')
            value = value << 4 | (uint32_t)digit;
    }
    *tag = value;
    return true;
}

/* ---- elements ------------------------------------------------------------------- */

typedef struct element {
    const char *text;
    size_t n;
    bool is_utf8;
    long line;
} element;

static il_status take_charset(il_rt_set *s, const element *e, il_error *err)
{
    il_free(s->charset);
    s->charset = il_strndup(e->text, e->n < IL_CHARSET_MOST ? e->n : IL_CHARSET_MOST);
    return s->charset ? IL_OK : il_fail_nomem(err);
}

static il_status take_modality(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->modality, e->text, e->n, true, err);
}

static il_status take_number(il_rt_set *s, const element *e, il_error *err)
{
    (void)err;
    s->item.has_number = parse_whole(e->text, e->n, &s->item.number);
    return IL_OK;
}

static il_status take_name(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->item.name, e->text, e->n, e->is_utf8, err);
}

static il_status take_frame_uid(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->item.frame_uid, e->text, e->n, true, err);
}

static il_status take_algorithm(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->item.algorithm, e->text, e->n, true, err);
}

static il_status take_type(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->item.type, e->text, e->n, true, err);
}

/* Red, green and blue, 0 to 255. */
static il_status take_color(il_rt_set *s, const element *e, il_error *err)
{
    const char *at = e->text, *end = e->text + e->n;
    long part[3];
    size_t n = 0;
    (void)err;
    for (; n < 3 && at <= end; n++) {
        const char *stop = memchr(at, '\\', (size_t)(end - at));
        stop = stop ? stop : end;
        if (!parse_whole(at, (size_t)(stop - at), &part[n]) || part[n] < 0 || part[n] > 255)
            break;
        at = stop + 1;
    }
    s->item.has_color = n == 3 && at > end;
    for (size_t k = 0; k < 3 && s->item.has_color; k++)
        s->item.color[k] = (unsigned char)part[k];
    if (!s->item.has_color && e->n > 0)
        il_report_skip(&s->item.report, s->file, e->line, "ROIDisplayColor", "not three numbers from 0 to 255");
    return IL_OK;
}

static il_status take_kind(il_rt_set *s, const element *e, il_error *err)
{
    return take_text(s, &s->kind, e->text, e->n, true, err);
}

static il_status take_count(il_rt_set *s, const element *e, il_error *err)
{
    long n = 0;
    (void)err;
    s->has_count = parse_whole(e->text, e->n, &n) && n >= 0;
    s->n_points = s->has_count ? (size_t)n : 0;
    return IL_OK;
}

size_t il_rt_count_values(const char *text, size_t n)
{
    size_t many = n > 0;
    for (size_t i = 0; i < n; i++)
        many += text[i] == '\\';
    return many;
}

/* The N numbers of a value to XYZ.  One that is no finite number below 1e15 makes
 * the ROI unfit: half a contour is a wrong one. */
static il_status parse_numbers(il_rt_set *s, const element *e, double *xyz, size_t n, il_error *err)
{
    const char *at = e->text, *end = e->text + e->n;
    for (size_t i = 0; i < n; i++) {
        while (at < end && *at == ' ')
            at++;
        size_t used = il_number_parse(at, (size_t)(end - at), &xyz[i]);
        const char *stop = at + used;
        while (stop < end && (*stop == ' ' || *stop == '\0'))
            stop++;
        if (used == 0 || (stop < end && *stop != '\\') || !(fabs(xyz[i]) < IL_COORDINATE_BOUND)) {
            const char *next = memchr(at, '\\', (size_t)(end - at));
            size_t length = next ? (size_t)(next - at) : (size_t)(end - at);
            return il_rt_roi_fail(&s->item, e->line, err, "value %zu of the contour data, '%.*s', is no number below 1e15",
                                  i + 1, (int)(length < 40 ? length : 40), at);
        }
        at = stop < end ? stop + 1 : end;
    }
    return IL_OK;
}

/* Code strings are upper case, by the standard; not all programs know. */
static bool is_kind(const il_rt_set *s, const char *kind)
{
    return s->kind && strcasecmp(s->kind, kind) == 0;
}

static bool is_xor(const il_rt_set *s)
{
    return is_kind(s, "CLOSEDPLANAR_XOR");
}

static bool is_closed(const il_rt_set *s)
{
    return !s->kind || is_xor(s) || is_kind(s, "CLOSED_PLANAR");
}

/* Points of what bounds nothing are not looked at. */
static il_status take_data(il_rt_set *s, const element *e, il_error *err)
{
    element data = *e;
    trim(&data.text, &data.n);
    size_t n = il_rt_count_values(data.text, data.n);
    il_rt_contour_free(&s->contour);
    s->contour.line = e->line;
    s->has_data = n > 0;
    if (s->item.fault || !is_closed(s) || n == 0)
        return IL_OK;
    if (n % 3 != 0)
        return il_rt_roi_fail(&s->item, e->line, err, "the contour data has %zu values, which is no multiple of 3", n);
    double *xyz = il_alloc(n, sizeof *xyz);
    il_status st = xyz ? parse_numbers(s, &data, xyz, n, err) : il_fail_nomem(err);
    if (st == IL_OK && !s->item.fault)
        il_rt_contour_take_points(&s->contour, &xyz, n / 3);
    il_free(xyz);
    return st;
}

static const struct wanted {
    place place;
    uint32_t tag;
    il_status (*take)(il_rt_set *s, const element *e, il_error *err);
} elements[] = {
    { PLACE_CONTOUR, IL_TAG(0x3006, 0x0050), take_data },
    { PLACE_CONTOUR, IL_TAG(0x3006, 0x0042), take_kind },
    { PLACE_CONTOUR, IL_TAG(0x3006, 0x0046), take_count },
    { PLACE_CONTOURS, IL_TAG(0x3006, 0x002a), take_color },
    { PLACE_CONTOURS, IL_TAG(0x3006, 0x0084), take_number },
    { PLACE_ROI, IL_TAG(0x3006, 0x0022), take_number },
    { PLACE_ROI, IL_TAG(0x3006, 0x0024), take_frame_uid },
    { PLACE_ROI, IL_TAG(0x3006, 0x0026), take_name },
    { PLACE_ROI, IL_TAG(0x3006, 0x0036), take_algorithm },
    { PLACE_OBSERVATION, IL_TAG(0x3006, 0x0084), take_number },
    { PLACE_OBSERVATION, IL_TAG(0x3006, 0x00a4), take_type },
    { PLACE_DATASET, IL_TAG(0x0008, 0x0005), take_charset },
    { PLACE_DATASET, IL_TAG(0x0008, 0x0060), take_modality },
};

static place innermost(const il_rt_set *s)
{
    return s->depth > 0 ? (place)s->place[s->depth - 1] : PLACE_OTHER;
}

static const struct wanted *find_wanted(const il_rt_set *s, uint32_t tag)
{
    place at = innermost(s);
    for (size_t i = 0; i < sizeof elements / sizeof *elements && at != PLACE_OTHER; i++)
        if (elements[i].tag == tag && elements[i].place == at)
            return &elements[i];
    return NULL;
}

/* What the sequence TAG is where the parser is. */
static place find_list(const il_rt_set *s, uint32_t tag)
{
    static const struct { place in; uint32_t tag; place list; } lists[] = {
        { PLACE_DATASET, IL_TAG(0x3006, 0x0020), PLACE_ROI_LIST },
        { PLACE_DATASET, IL_TAG(0x3006, 0x0039), PLACE_CONTOURS_LIST },
        { PLACE_CONTOURS, IL_TAG(0x3006, 0x0040), PLACE_CONTOUR_LIST },
        { PLACE_DATASET, IL_TAG(0x3006, 0x0080), PLACE_OBSERVATION_LIST } };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (lists[i].in == innermost(s) && lists[i].tag == tag)
            return lists[i].list;
    return PLACE_OTHER_LIST;
}

bool il_rt_set_wants(const il_rt_set *s, uint32_t tag)
{
    return find_wanted(s, tag) != NULL;
}

bool il_rt_set_needs(const il_rt_set *s, uint32_t tag)
{
    return il_rt_set_wants(s, tag) || find_list(s, tag) != PLACE_OTHER_LIST;
}

il_status il_rt_set_element(il_rt_set *s, uint32_t tag, const char *text, size_t n, bool is_utf8,
                            long line, il_error *err)
{
    const struct wanted *w = find_wanted(s, tag);
    element e = { text, n, is_utf8, line };
    return w ? w->take(s, &e, err) : IL_OK;
}

/* ---- items that are complete ------------------------------------------------------ */

/* An ROI is a stack, which the options bound. */
static il_status check_points(const il_rt_set *s, const il_rt_roi *r, long line, il_error *err)
{
    if (r->n_points <= s->options->max_points)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, line, "more than %zu points in the contours of one ROI", s->options->max_points);
}

static il_status end_contour(il_rt_set *s, il_error *err)
{
    char what[80];
    s->contour.is_xor = is_xor(s);
    if (!is_closed(s)) {
        snprintf(what, sizeof what, "%.40s contour", s->kind);
        il_report_skip(&s->item.report, s->file, s->contour.line, what, "it bounds no area: CLOSED_PLANAR does");
    } else if (s->item.fault) {
        /* its data is damaged or was not looked at: the ROI is refused as a whole */
    } else if (!s->has_data) {
        il_report_skip(&s->item.report, s->file, s->contour.line, "contour", "it has no points");
    } else if (s->contour.n < 3) {
        snprintf(what, sizeof what, "contour of %zu point%s", s->contour.n, s->contour.n == 1 ? "" : "s");
        il_report_skip(&s->item.report, s->file, s->contour.line, what, "it bounds no area");
    } else {
        if (s->has_count && s->n_points != s->contour.n)
            il_report_repair(&s->item.report, IL_REPAIR_POINT_COUNT, 1);
        long line = s->contour.line;
        return il_rt_roi_add(&s->item, &s->contour) ? check_points(s, &s->item, line, err) : il_fail_nomem(err);
    }
    il_rt_contour_free(&s->contour);
    return IL_OK;
}

static il_rt_roi *find_roi(il_rt_set *s, long number)
{
    uint32_t k = il_keymap_get(&s->by_number, (uint64_t)number, 0, UINT32_MAX);
    return k == UINT32_MAX ? NULL : &s->roi[k];
}

/* Append the item at hand to the ROIs. */
static il_status add_item(il_rt_set *s, il_error *err)
{
    if (!il_grow(&s->roi, &s->cap, s->n + 1, sizeof *s->roi))
        return il_fail_nomem(err);
    if (s->item.has_number && !il_keymap_put(&s->by_number, (uint64_t)s->item.number, 0, (uint32_t)s->n))
        return il_fail_nomem(err);
    s->roi[s->n++] = s->item;
    s->item = (il_rt_roi){ .report = IL_REPORT_INIT };
    return IL_OK;
}

static il_status end_roi(il_rt_set *s, il_error *err)
{
    il_rt_roi *old = s->item.has_number ? find_roi(s, s->item.number) : NULL;
    s->item.rank = s->n_items++;
    if (!old)
        return add_item(s, err);
    if (old->rank < RANK_DRAWN)
        il_report_note(&old->report, "ROI number %ld is given twice; the first name stands", s->item.number);
    return il_rt_roi_merge(old, &s->item, err);
}

static il_status end_contours(il_rt_set *s, long line, il_error *err)
{
    il_rt_roi *roi = s->item.has_number ? find_roi(s, s->item.number) : NULL;
    if (roi && roi->n > 0 && s->item.n > 0)
        il_report_note(&roi->report, "its contours stand in several places of the file");
    s->item.rank = RANK_DRAWN + s->n_items++;
    if (!roi)
        return add_item(s, err);
    il_status st = il_rt_roi_merge(roi, &s->item, err);
    return st == IL_OK ? check_points(s, roi, line, err) : st;
}

static il_status end_observation(il_rt_set *s, il_error *err)
{
    il_rt_roi *roi = s->item.has_number ? find_roi(s, s->item.number) : NULL;
    s->item.rank = RANK_OBSERVED + s->n_items++;
    if (s->item.has_number)
        return roi ? il_rt_roi_merge(roi, &s->item, err) : add_item(s, err);
    il_rt_roi_free(&s->item);
    return IL_OK;
}

/* ---- brackets ---------------------------------------------------------------------- */

/* A sequence is two brackets, its own and that of the item at hand. */
static il_status push(il_rt_set *s, place at, long line, il_error *err)
{
    if ((s->depth + 1) / 2 > s->options->max_depth)
        return il_fail(err, IL_E_INPUT, line, "sequences nested more than %zu deep", s->options->max_depth);
    if (!il_grow(&s->place, &s->cap_depth, s->depth + 1, 1))
        return il_fail_nomem(err);
    s->place[s->depth++] = (unsigned char)at;
    return IL_OK;
}

static bool is_list(place at)
{
    return at % 2 == 1;
}

static void forget_dataset(il_rt_set *s)
{
    for (size_t i = 0; i < s->n; i++)
        il_rt_roi_free(&s->roi[i]);
    il_rt_roi_free(&s->item);
    il_rt_contour_free(&s->contour);
    il_keymap_free(&s->by_number);
    il_free(s->charset);
    il_free(s->modality);
    il_free(s->kind);
    s->charset = s->modality = s->kind = NULL;
    s->n = s->n_items = s->depth = 0;
    s->has_list = s->has_contours = s->has_observations = s->is_charset_noted = false;
}

il_status il_rt_set_begin_dataset(il_rt_set *s, long line, il_error *err)
{
    forget_dataset(s);
    return push(s, PLACE_DATASET, line, err);
}

il_status il_rt_set_begin_sequence(il_rt_set *s, uint32_t tag, long line, il_error *err)
{
    if (s->depth == 0 || is_list(innermost(s)))
        return il_fail(err, IL_E_INPUT, line, "a sequence outside of an item");
    place list = find_list(s, tag);
    s->has_list |= list == PLACE_ROI_LIST;
    s->has_contours |= list == PLACE_CONTOURS_LIST;
    s->has_observations |= list == PLACE_OBSERVATION_LIST;
    return push(s, list, line, err);
}

il_status il_rt_set_begin_item(il_rt_set *s, long line, il_error *err)
{
    if (s->depth == 0 || !is_list(innermost(s)))
        return il_fail(err, IL_E_INPUT, line, "an item outside of a sequence");
    place at = (place)(innermost(s) + 1);
    if (at == PLACE_ROI || at == PLACE_CONTOURS || at == PLACE_OBSERVATION) {
        il_rt_roi_free(&s->item);
        s->item.line = line;
    } else if (at == PLACE_CONTOUR) {
        il_rt_contour_free(&s->contour);
        il_free(s->kind);
        s->kind = NULL;
        s->has_data = s->has_count = false;
        s->contour.line = line;
    }
    return push(s, at, line, err);
}

il_status il_rt_set_end_item(il_rt_set *s, long line, il_error *err)
{
    place at = innermost(s);
    if (s->depth < 2 || is_list(at))
        return il_fail(err, IL_E_INPUT, line, "the end of an item that did not begin");
    s->depth--;
    switch (at) {
    case PLACE_ROI:         return end_roi(s, err);
    case PLACE_CONTOURS:    return end_contours(s, line, err);
    case PLACE_CONTOUR:     return end_contour(s, err);
    case PLACE_OBSERVATION: return end_observation(s, err);
    default:                return IL_OK;
    }
}

il_status il_rt_set_end_sequence(il_rt_set *s, long line, il_error *err)
{
    if (s->depth < 2 || !is_list(innermost(s)))
        return il_fail(err, IL_E_INPUT, line, "the end of a sequence that did not begin");
    s->depth--;
    return IL_OK;
}

static int by_rank(const void *a, const void *b)
{
    size_t i = ((const il_rt_roi *)a)->rank, j = ((const il_rt_roi *)b)->rank;
    return (i > j) - (i < j);
}

/* The ROIs in their order, without those that are only observed. */
static void sort_rois(il_rt_set *s)
{
    if (s->n > 1)
        qsort(s->roi, s->n, sizeof *s->roi, by_rank);
    while (s->n > 0 && s->roi[s->n - 1].rank >= RANK_OBSERVED)
        il_rt_roi_free(&s->roi[--s->n]);
}

/* What is odd about the set as a whole is told with the ROI it befalls. */
static void add_notes(il_rt_set *s)
{
    for (size_t k = 0; k < s->n; k++) {
        il_rt_roi *r = &s->roi[k];
        bool is_listed = r->rank < RANK_DRAWN;
        if (!is_listed && r->has_number)
            il_report_note(&r->report, "no ROI has number %ld, so these contours have no name", r->number);
        else if (!is_listed)
            il_report_note(&r->report, "these contours name no ROI");
    }
    if (s->n > 0 && !s->has_observations)
        il_report_note(&s->roi[0].report, "the observations (3006,0080) are missing: no ROI of the set has a type");
}

il_status il_rt_set_end_dataset(il_rt_set *s, long line, il_error *err)
{
    if (s->depth != 1)
        return il_fail(err, IL_E_INPUT, line, "the file ends inside a sequence: it was cut");
    bool has_any = s->has_list || s->has_contours;
    if (!has_any && s->modality && strcmp(s->modality, "RTSTRUCT") != 0)
        return il_fail(err, IL_E_INPUT, line, "a DICOM file of modality %.20s; contours are in structure sets (RTSTRUCT)", s->modality);
    if (!has_any)
        return il_fail(err, IL_E_INPUT, line, "there are no ROIs in this DICOM file: it is no structure set");
    if (!s->has_list || !s->has_contours)
        return il_fail(err, IL_E_INPUT, line, "the %s are missing: the file was cut",
                       s->has_list ? "contours (3006,0039)" : "names of the ROIs (3006,0020)");
    sort_rois(s);
    add_notes(s);
    il_status st = il_rt_stacks_emit(s->roi, s->n, s->file, s->options, s->sink, s->report, err);
    forget_dataset(s);
    return st;
}

/* ---- the set -------------------------------------------------------------------------- */

static void free_set(il_rt_set *s)
{
    forget_dataset(s);
    il_free(s->roi);
    il_free(s->place);
}

il_status il_rt_read(il_rt_parse *parse, il_source *const *source, size_t n, const il_read_options *options,
                     il_sink *sink, il_report *report, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; st == IL_OK && i < n; i++) {
        il_rt_set set = { .file = il_source_name(source[i]), .options = options, .sink = sink, .report = report,
                          .item.report = IL_REPORT_INIT };
        st = parse(source[i], &set, options, err);
        if (st == IL_E_INPUT)
            il_error_set_file(err, set.file);
        free_set(&set);
    }
    return st == IL_OK ? sink->end(sink, err) : st;
}
