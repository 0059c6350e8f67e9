/* gmt-header.c - the header of a segment, > 100 contour -Z100 -L"100 m": where its
 * height may stand. */
#include "config.h"
#include "input/gmt.h"

/* A word of a header: an option's letter and its value, or no letter and the word. */
typedef struct word {
    char option;
    il_map_text value;
} word;

static bool is_letter(char c)
{
    return (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
}

/* The next word; what stands in quotes is one, without them. */
static bool next_word(il_map_text *t, word *w)
{
    if (!il_map_text_more(t))
        return false;
    bool is_option = *t->p == '-' && t->end - t->p > 1 && is_letter(t->p[1]);
    w->option = is_option ? t->p[1] : '\0';
    t->p += is_option ? 2 : 0;
    char quote = t->p < t->end && (*t->p == '"' || *t->p == '\'') ? *t->p : '\0';
    w->value.p = quote ? ++t->p : t->p;
    while (t->p < t->end && (quote ? *t->p != quote : !il_map_text_is_blank(*t->p)))
        t->p++;
    w->value.end = t->p;
    t->p += quote && t->p < t->end;
    return true;
}

static bool is_number(il_map_text t)
{
    double value;
    return il_map_text_number(&t, false, &value) && t.p == t.end;
}

bool il_gmt_header_read(il_map_text t, il_gmt_header *h)
{
    word w;
    bool has_any = false;
    *h = (il_gmt_header){ { NULL }, { 0 } };
    for (bool is_first = true; next_word(&t, &w); is_first = false) {
        int place = w.option == 'Z' ? IL_GMT_Z : w.option == 'L' ? IL_GMT_L
                  : is_first && w.option == '\0' && is_number(w.value) ? IL_GMT_NUMBER : IL_GMT_N_PLACES;
        if (place == IL_GMT_N_PLACES)
            continue;
        h->value[place] = w.value.p;
        h->n[place] = (size_t)(w.value.end - w.value.p);
        has_any = true;
    }
    return has_any;
}

/* All three each time, so that they are asked in this order in any file: the number
 * may be that of the segment. */
il_status il_gmt_header_tell(const il_gmt_header *h, il_map_set *set, il_error *err)
{
    static const char *const name[IL_GMT_N_PLACES] = { [IL_GMT_Z] = "-Z", [IL_GMT_L] = "-L", [IL_GMT_NUMBER] = "header" };
    il_status st = IL_OK;
    for (int k = 0; k < IL_GMT_N_PLACES && st == IL_OK; k++)
        st = il_map_place(set, name[k], h->value[k], h->n[k], err);
    return st;
}
