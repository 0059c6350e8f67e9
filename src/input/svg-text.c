#include "config.h"
#include "input/svg-text.h"
#include "base/number.h"

#include <string.h>

bool il_svg_is_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f';
}

bool il_svg_text_more(il_svg_text *t)
{
    while (t->at < t->n && il_svg_is_blank(t->s[t->at]))
        t->at++;
    return t->at < t->n;
}

bool il_svg_text_take(il_svg_text *t, char c)
{
    if (!il_svg_text_more(t) || t->s[t->at] != c)
        return false;
    t->at++;
    return true;
}

il_status il_svg_text_number(il_svg_text *t, double *value, il_error *err)
{
    il_svg_text_more(t);
    size_t used = il_number_parse(t->s + t->at, t->n - t->at, value);
    if (used == 0)
        return il_svg_text_fail(t, err, "a finite number is expected");
    t->at += used;
    return IL_OK;
}

il_status il_svg_text_next_number(il_svg_text *t, double *value, il_error *err)
{
    il_svg_text_take(t, ',');
    return il_svg_text_number(t, value, err);
}

bool il_svg_text_is_word(const il_svg_text *t, const char *word)
{
    size_t end = t->n, len = strlen(word);
    while (end > t->at && il_svg_is_blank(t->s[end - 1]))
        end--;
    return end - t->at == len && memcmp(t->s + t->at, word, len) == 0;
}

il_status il_svg_text_fail(const il_svg_text *t, il_error *err, const char *what)
{
    enum { SHOWN = 24 };
    size_t left = t->n - t->at;
    if (left == 0)
        return il_fail(err, IL_E_INPUT, 0, "%s: %s at the end", t->name, what);
    return il_fail(err, IL_E_INPUT, 0, "%s: %s at '%.*s%s'", t->name, what,
                   (int)(left < SHOWN ? left : SHOWN), t->s + t->at, left > SHOWN ? "..." : "");
}
