#include "config.h"
#include "input/map-text.h"
#include "base/number.h"

#include <string.h>

static const char byte_order_mark[] = "\xEF\xBB\xBF";
enum { BOM = sizeof byte_order_mark - 1 };

static void trim(il_map_text *t, bool is_first)
{
    if (is_first && t->end - t->p >= BOM && memcmp(t->p, byte_order_mark, BOM) == 0)
        t->p += BOM;
    while (t->p < t->end && il_map_text_is_blank(*t->p))
        t->p++;
    while (t->p < t->end && il_map_text_is_blank(t->end[-1]))
        t->end--;
}

il_status il_map_text_line(il_lines *l, il_map_text *t, bool *more, il_error *err)
{
    size_t n;
    il_status st = il_lines_next(l, &t->p, &n, err);
    *more = st == IL_OK && t->p;
    if (*more) {
        t->end = t->p + n;
        trim(t, l->line == 1);
    }
    return st;
}

bool il_map_text_more(il_map_text *t)
{
    while (t->p < t->end && il_map_text_is_blank(*t->p))
        t->p++;
    return t->p < t->end;
}

static bool is_mark(char c)
{
    return c == ',' || c == ';';
}

void il_map_text_pass(il_map_text *t, bool behind)
{
    if (il_map_text_more(t) && behind && is_mark(*t->p)) {
        t->p++;
        il_map_text_more(t);
    }
}

bool il_map_text_ends(const il_map_text *t)
{
    return t->p == t->end || il_map_text_is_blank(*t->p) || is_mark(*t->p);
}

bool il_map_text_number(il_map_text *t, bool behind, double *value)
{
    il_map_text at = *t;
    il_map_text_pass(&at, behind);
    size_t n = il_number_parse(at.p, (size_t)(at.end - at.p), value);
    at.p += n;
    if (n == 0 || !il_map_text_ends(&at))
        return false;
    *t = at;
    return true;
}

int il_map_text_shown(const il_map_text *t)
{
    enum { MOST = 40 };
    return t->end - t->p < MOST ? (int)(t->end - t->p) : MOST;
}

/* A form feed stands between pages. */
bool il_map_text_is_plain(const unsigned char *head, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (head[i] == 0x7f || (head[i] < 0x20 && head[i] != '\t' && head[i] != '\n' && head[i] != '\r' && head[i] != '\f'))
            return false;
    return true;
}

bool il_map_text_head(const unsigned char *head, size_t n, size_t *at, il_map_text *t, bool *whole)
{
    if (*at >= n)
        return false;
    const char *p = (const char *)head + *at, *lf = memchr(p, '\n', n - *at);
    *whole = lf != NULL;
    *t = (il_map_text){ p, lf ? lf : (const char *)head + n };
    trim(t, *at == 0);
    *at = (size_t)((lf ? lf + 1 : (const char *)head + n) - (const char *)head);
    return true;
}
