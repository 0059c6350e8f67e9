#include "config.h"
#include "input/dxf-layer.h"
#include "base/alloc.h"
#include "base/pattern.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* Layers that a sentence names. */
enum { NAMED_MOST = 8, NAME_SHOWN = 40 };

il_status il_dxf_layers_init(il_dxf_layers *l, const il_map_options *options, il_error *err)
{
    uint32_t zero;
    *l = (il_dxf_layers){ .words = IL_DICTIONARY_INIT, .page = IL_CODEPAGE_INIT, .options = options };
    l->matched = il_calloc(options->n_layers, sizeof *l->matched);
    return l->matched ? il_dxf_layer_find(l, "0", 1, 0, &zero, err) : il_fail_nomem(err);
}

void il_dxf_layers_free(il_dxf_layers *l)
{
    for (size_t i = 0; i < l->n; i++)
        il_free(l->layer[i].name);
    il_free(l->layer);
    il_free(l->matched);
    il_dictionary_free(&l->words);
    il_codepage_free(&l->page);
}

/* Names may have characters as \U+00E9, so that they outlive any code page; in place. */
static size_t decode_escapes(char *s, size_t n)
{
    size_t to = 0;
    for (size_t i = 0; i < n;) {
        unsigned long code = 0;
        int digits = n - i >= 7 && memcmp(s + i, "\\U+", 3) == 0 ? 0 : -1;
        while (digits >= 0 && digits < 4 && il_hex_digit(s[i + 3 + (size_t)digits]) >= 0)
            code = 16 * code + (unsigned long)il_hex_digit(s[i + 3 + (size_t)digits++]);
        bool is_escape = digits == 4 && code > 0 && (code < 0xD800 || code > 0xDFFF);
        if (is_escape)
            to += il_utf8_encode(s + to, code);
        else
            s[to++] = s[i];
        i += is_escape ? 7 : 1;
    }
    s[to] = '\0';
    return to;
}

static il_status add_layer(il_dxf_layers *l, const char *s, size_t n, il_error *err)
{
    il_dxf_layer new = { NULL, 0, true, false, 0, 0 };
    if (!il_grow(&l->layer, &l->cap, l->n + 1, sizeof *l->layer))
        return il_fail_nomem(err);
    il_status st = il_codepage_text(&l->page, s, n, &new.name, &new.n_name, err);
    if (st != IL_OK)
        return st;
    new.n_name = decode_escapes(new.name, new.n_name);
    l->layer[l->n++] = new;
    return IL_OK;
}

il_status il_dxf_layer_find(il_dxf_layers *l, const char *s, size_t n, long line, uint32_t *index, il_error *err)
{
    if (!il_dictionary_put(&l->words, s, n, index))
        return *index == IL_DICTIONARY_MOST ? il_fail(err, IL_E_INPUT, line, "more than %d layers", IL_DICTIONARY_MOST)
                                            : il_fail_nomem(err);
    if (*index < l->n)
        return IL_OK;
    il_status st = add_layer(l, s, n, err);
    const il_map_options *o = l->options;
    if (st == IL_OK && o->n_layers > 0)
        l->layer[*index].is_chosen = il_pattern_choose(o->layer, o->n_layers, l->layer[*index].name, l->matched);
    return st;
}

/* ---- at the end ------------------------------------------------------------------ */

static bool is_used(const il_dxf_layer *l)
{
    return l->n_taken + l->n_left > 0;
}

static bool is_used_and_off(const il_dxf_layer *l)
{
    return l->n_taken > 0 && l->is_off;
}

/* "'A', 'B' and 3 more": the layers of which WHICH is true, in TEXT[SIZE].  Whole
 * characters: il_fail and il_report_note show what is left of a cut one as bytes. */
static void name_layers(const il_dxf_layers *l, bool (*which)(const il_dxf_layer *), char *text, size_t size)
{
    size_t used = 0, n = 0;
    for (size_t i = 0; i < l->n; i++) {
        const il_dxf_layer *a = &l->layer[i];
        char shown[NAME_SHOWN + 1];
        if (!which(a) || n++ >= NAMED_MOST)
            continue;
        il_text_printable(shown, sizeof shown, a->name, a->n_name);
        used += (size_t)snprintf(text + used, size - used, "%s'%s'", n > 1 ? ", " : "", shown);
    }
    if (n > NAMED_MOST)
        snprintf(text + used, size - used, " and %zu more", n - NAMED_MOST);
}

static void tell_patterns(const il_dxf_layers *l, il_report *report)
{
    const il_map_options *o = l->options;
    for (size_t k = 0; k < o->n_layers; k++)
        if (!l->matched[k])
            il_report_note(report, "no layer matches '%.60s'", o->layer[k] + (o->layer[k][0] == '!'));
}

il_status il_dxf_layers_end(il_dxf_layers *l, il_report *report, il_error *err)
{
    char names[NAMED_MOST * (NAME_SHOWN + 5) + 40] = "";
    size_t n_taken = 0, n_left = 0;
    for (size_t i = 0; i < l->n; i++) {
        n_taken += l->layer[i].n_taken;
        n_left += l->layer[i].n_left;
    }
    name_layers(l, is_used, names, sizeof names);
    if (n_taken == 0 && n_left > 0)
        return il_fail(err, IL_E_INPUT, 0, "nothing is on a layer that --layer chooses; there are %s", names);
    if (n_left > 0)
        il_report_note(report, "%zu entities on layers that --layer does not choose are left out", n_left);
    tell_patterns(l, report);
    *names = '\0';
    name_layers(l, is_used_and_off, names, sizeof names);
    if (*names)
        il_report_note(report, "layers that are off or frozen are read all the same: %s", names);
    return IL_OK;
}
