#include "config.h"
#include "input/links-file.h"
#include "base/alloc.h"
#include "input/native-scan.h"

#include <limits.h>
#include <string.h>

static const char byte_order_mark[] = "\xEF\xBB\xBF";
enum { BOM = sizeof byte_order_mark - 1 };

typedef struct reader {
    il_given *given;
    il_lines lines;
    il_scan at; /* the current line */
    il_error *err;
} reader;

static il_status fail(reader *r, const char *sentence)
{
    return il_fail(r->err, IL_E_INPUT, r->at.line, "%s", sentence);
}

/* *MORE is false at the end of the input. */
static il_status next_line(reader *r, bool *more)
{
    size_t n;
    il_status st = il_lines_next(&r->lines, &r->at.p, &n, r->err);
    *more = st == IL_OK && r->at.p;
    if (*more) {
        r->at.end = r->at.p + n;
        r->at.line = r->lines.line;
        st = il_scan_check(&r->at, r->err);
    }
    return st;
}

/* "1", or with any minor version. */
static bool is_version_1(const char *word, size_t n)
{
    bool ok = n == 1 || (n > 2 && word[1] == '.');
    for (size_t i = 2; i < n && ok; i++)
        ok = word[i] >= '0' && word[i] <= '9';
    return ok && word[0] == '1';
}

/* The first line, and its version. */
static il_status take_magic(reader *r)
{
    size_t n = 0;
    if (r->at.end - r->at.p >= BOM && memcmp(r->at.p, byte_order_mark, BOM) == 0)
        r->at.p += BOM;
    const char *word = il_scan_peek(&r->at, &n);
    if (n != strlen("isoloft-links") || memcmp(word, "isoloft-links", n) != 0)
        return fail(r, "the first line is not 'isoloft-links 1'");
    r->at.p += n;
    word = il_scan_peek(&r->at, &n);
    if (n == 0 || !is_version_1(word, n))
        return il_fail(r->err, IL_E_INPUT, r->at.line, "it is version '%.*s' of the format; only version 1 is known",
                       il_scan_shown(n), word);
    r->at.p += n;
    return il_scan_end(&r->at, r->err);
}

static il_status take_stack(reader *r)
{
    il_given *g = r->given;
    il_given_stack s = { .first = g->n_slabs, .line = r->at.line };
    il_status st = il_scan_integer(&r->at, LONG_MIN, LONG_MAX, &s.number, r->err);
    if (st == IL_OK)
        st = il_scan_string(&r->at, &s.name, r->err);
    if (st == IL_OK && !il_grow(&g->stack, &g->cap_stacks, g->n_stacks + 1, sizeof *g->stack)) {
        il_free(s.name);
        st = il_fail_nomem(r->err);
    }
    if (st == IL_OK)
        g->stack[g->n_stacks++] = s;
    return st;
}

static il_status take_slab(reader *r)
{
    il_given *g = r->given;
    il_given_slab s = { .first = g->n_links, .line = r->at.line };
    if (g->n_stacks == 0)
        return fail(r, "a slab stands in a stack, and none has begun");
    il_status st = il_scan_number(&r->at, &s.below, r->err);
    if (st == IL_OK)
        st = il_scan_number(&r->at, &s.above, r->err);
    if (st == IL_OK && !(s.below < s.above))
        st = fail(r, "a slab is given by the lower z and the upper z");
    if (st == IL_OK && !il_grow(&g->slab, &g->cap_slabs, g->n_slabs + 1, sizeof *g->slab))
        st = il_fail_nomem(r->err);
    if (st == IL_OK) {
        g->slab[g->n_slabs++] = s;
        g->stack[g->n_stacks - 1].n++;
    }
    return st;
}

static il_status take_reason(reader *r, il_given_link *l)
{
    static const char *const reasons[] = { "overlap", "slant", "near", "join", "opening", "given", NULL };
    int reason = 0;
    il_status st = il_scan_choice(&r->at, reasons, "a reason: overlap, slant, near, join, opening or given", &reason, r->err);
    if (st == IL_OK)
        st = il_scan_number(&r->at, &l->link.reach, r->err);
    if (st == IL_OK && l->link.reach < 0)
        st = fail(r, "a distance is not negative");
    l->link.reason = (il_link_reason)reason;
    l->explained = true;
    return st;
}

static il_status take_link(reader *r)
{
    il_given *g = r->given;
    il_given_link l = { .link.reason = IL_LINK_GIVEN, .line = r->at.line };
    if (g->n_stacks == 0 || g->stack[g->n_stacks - 1].n == 0)
        return fail(r, "a link stands in a slab, and none has begun");
    il_status st = il_scan_index(&r->at, &l.link.lower, r->err);
    if (st == IL_OK)
        st = il_scan_index(&r->at, &l.link.upper, r->err);
    if (st == IL_OK && !il_scan_at_end(&r->at))
        st = take_reason(r, &l);
    if (st == IL_OK && !il_grow(&g->link, &g->cap_links, g->n_links + 1, sizeof *g->link))
        st = il_fail_nomem(r->err);
    if (st == IL_OK) {
        g->link[g->n_links++] = l;
        g->slab[g->n_slabs - 1].n++;
    }
    return st;
}

static il_status take_line(reader *r)
{
    static const char *const words[] = { "stack", "slab", "link", NULL };
    static il_status (*const takers[])(reader *) = { take_stack, take_slab, take_link };
    int k = 0;
    if (il_scan_at_end(&r->at))
        return IL_OK;
    il_status st = il_scan_choice(&r->at, words, "a keyword: stack, slab or link", &k, r->err);
    if (st == IL_OK)
        st = takers[k](r);
    return st == IL_OK ? il_scan_end(&r->at, r->err) : st;
}

static il_status read_lines(reader *r)
{
    bool more = false;
    il_status st = next_line(r, &more);
    if (st == IL_OK && !more)
        return il_fail(r->err, IL_E_INPUT, 0, "the file is empty");
    if (st == IL_OK)
        st = take_magic(r);
    while (st == IL_OK && more) {
        st = next_line(r, &more);
        if (st == IL_OK && more)
            st = take_line(r);
    }
    return st;
}

il_status il_links_file_read(il_given *out, il_source *source, size_t max_line, il_error *err)
{
    reader r = { .given = out, .err = err };
    const char *name = il_source_name(source);
    *out = (il_given)IL_GIVEN_INIT;
    il_lines_init(&r.lines, source, max_line);
    out->file = il_strndup(name, strlen(name));
    il_status st = out->file ? read_lines(&r) : il_fail_nomem(err);
    il_lines_free(&r.lines);
    if (st != IL_OK) {
        il_error_set_file(err, name);
        il_given_free(out);
    }
    return st;
}
