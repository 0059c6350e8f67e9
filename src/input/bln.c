/* bln.c - Surfer's blanking files (formats/bln.txt): blocks of a header, which says
 * how many points follow, and the points. */
#include "config.h"
#include "input/map-set.h"
#include "input/map-text.h"

#include <math.h>
#include <string.h>

/* Beyond all limits of points. */
static const double COUNT_MOST = 4e9;

/* A header: COUNT,FLAG[,NAME].  line: where it stands; 0 before the first. */
typedef struct block {
    size_t count;
    const char *name;
    size_t n_name;
    long line;
} block;

static bool is_quote(char c)
{
    return c == '"' || c == '\'';
}

/* The name behind the flag: the rest of the line, without quotes around it. */
static void take_name(il_map_text *t, block *b)
{
    il_map_text_pass(t, true);
    if (t->end - t->p >= 2 && is_quote(*t->p) && t->end[-1] == *t->p) {
        t->p++;
        t->end--;
    }
    b->name = t->p;
    b->n_name = (size_t)(t->end - t->p);
}

/* The flag says whether Surfer blanks inside (1) or outside (0); -1 is of others. */
static bool parse_header(il_map_text t, block *b)
{
    double count, flag;
    bool is_header = il_map_text_number(&t, false, &count) && il_map_text_number(&t, true, &flag) &&
                     count >= 1 && count < COUNT_MOST && count == floor(count) && (fabs(flag) == 1 || flag == 0);
    if (is_header) {
        b->count = (size_t)count;
        take_name(&t, b);
    }
    return is_header;
}

static bool parse_point(il_map_text t, double *x, double *y, double *z)
{
    *z = NAN;
    return il_map_text_number(&t, false, x) && il_map_text_number(&t, true, y) &&
           (!il_map_text_more(&t) || il_map_text_number(&t, true, z)) && !il_map_text_more(&t);
}

/* ---- blocks ------------------------------------------------------------------- */

static il_status fail_header(const il_map_text *t, const block *before, long line, il_error *err)
{
    if (before->line == 0)
        return il_fail(err, IL_E_INPUT, line, "'%.*s' is no header of a block, COUNT,FLAG", il_map_text_shown(t), t->p);
    return il_fail(err, IL_E_INPUT, line, "'%.*s' is no header of a block, COUNT,FLAG; the block before it says in line %ld "
                   "that it has %zu points", il_map_text_shown(t), t->p, before->line, before->count);
}

static il_status read_points(il_lines *l, il_map_set *set, const block *b, il_error *err)
{
    il_status st = IL_OK;
    il_map_text t;
    double x, y, z;
    bool more;
    for (size_t k = 0; k < b->count && st == IL_OK;) {
        st = il_map_text_line(l, &t, &more, err);
        if (st == IL_OK && !more)
            return il_fail(err, IL_E_INPUT, b->line, "the block says that it has %zu points, but the file ends after %zu", b->count, k);
        if (st != IL_OK || t.p == t.end)
            continue;
        if (!parse_point(t, &x, &y, &z))
            return il_fail(err, IL_E_INPUT, l->line, "'%.*s' is no point, x,y or x,y,z; it should be number %zu of the %zu points "
                           "that line %ld says", il_map_text_shown(&t), t.p, k + 1, b->count, b->line);
        st = il_map_point(set, x, y, z, l->line, err);
        k++;
    }
    return st;
}

static il_status read_block(il_lines *l, il_map_set *set, const block *b, il_error *err)
{
    il_status st = il_map_begin_feature(set, b->line, err);
    if (st == IL_OK && b->n_name > 0)
        st = il_map_place(set, "name", b->name, b->n_name, err);
    if (st == IL_OK)
        st = il_map_begin_part(set, IL_MAP_LINE, b->line, err);
    if (st == IL_OK)
        st = read_points(l, set, b, err);
    if (st == IL_OK)
        st = il_map_end_part(set, err);
    return st == IL_OK ? il_map_end_feature(set, err) : st;
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_lines l;
    il_map_text t;
    block b = { .line = 0 };
    bool more = true;
    il_lines_init(&l, source, options->max_line);
    il_status st = IL_OK;
    while (st == IL_OK && (st = il_map_text_line(&l, &t, &more, err)) == IL_OK && more) {
        const block before = b;
        if (t.p == t.end)
            continue;
        b.line = l.line;
        st = parse_header(t, &b) ? read_block(&l, set, &b, err) : fail_header(&t, &before, l.line, err);
    }
    if (st == IL_OK && b.line == 0)
        st = il_fail(err, IL_E_INPUT, 0, "there is no block in this file");
    il_lines_free(&l);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("BLN", parse, source, n, options, sink, report, err);
}

/* ---- telling it apart ------------------------------------------------------------ */

/* No table begins like this: a name in quotes, or nothing but two whole numbers and a
 * comma between them, since a table of two columns has no heights. */
static bool is_certain(const il_map_text *t, const block *b)
{
    size_t n = (size_t)(t->end - t->p);
    if (b->n_name > 0)
        return memchr(t->p, '"', n) != NULL;
    return memchr(t->p, ',', n) && !memchr(t->p, '.', n);
}

/* Blocks, as far as HEAD goes.  Unless it is certain by the first header, as many points
 * must follow as it says: a table of numbers is another thing, however it begins. */
static bool probe(const unsigned char *head, size_t n)
{
    il_map_text t;
    block b = { .count = 0 };
    double x, y, z;
    bool whole, certain = false;
    size_t at = 0, seen = 0, left = 0;
    if (!il_map_text_is_plain(head, n))
        return false;
    while (il_map_text_head(head, n, &at, &t, &whole)) {
        bool is_cut = !whole && n >= IL_MAP_TEXT_HEAD, is_header = parse_header(t, &b);
        if (t.p == t.end || is_cut)
            continue;
        if (seen++ == 0)
            certain = is_header && is_certain(&t, &b);
        if (!(left > 0 || certain ? parse_point(t, &x, &y, &z) || (certain && is_header) : is_header))
            return false;
        left = left > 0 ? left - 1 : b.count;
    }
    return seen > 1 && (certain || left == 0 || n >= IL_MAP_TEXT_HEAD);
}

const il_reader il_reader_bln = {
    .name = "bln",
    .extensions = "bln",
    .words = "isolines as Surfer's blanking file",
    .is_map = true,
    .probe = probe,
    .read = read_all,
};
