#include "config.h"
#include "input/map-xml.h"
#include "base/alloc.h"

#include <string.h>

il_status il_map_xml_init(il_map_xml *x, il_map_set *set, const il_read_options *options, il_error *err)
{
    static const char crs[] = "EPSG:4326";
    *x = (il_map_xml){ .set = set, .max_depth = options->max_depth, .max_text = options->max_line };
    il_map_degrees(set);
    return il_map_crs(set, crs, strlen(crs), 1, err);
}

void il_map_xml_free(il_map_xml *x)
{
    il_free(x->open);
    il_free(x->text);
    il_free(x->name);
}

il_status il_map_xml_push(il_map_xml *x, int kind, const il_xml_element *e, il_error *err)
{
    if (x->depth >= x->max_depth)
        return il_fail(err, IL_E_INPUT, e->line, "elements nested more than %zu deep", x->max_depth);
    if (!il_grow(&x->open, &x->cap_open, x->depth + 1, 1))
        return il_fail_nomem(err);
    x->open[x->depth++] = (unsigned char)kind;
    return IL_OK;
}

/* ---- text ---------------------------------------------------------------------- */

void il_map_xml_keep(il_map_xml *x)
{
    x->has_text = x->keeps = true;
    x->n_text = 0;
}

il_status il_map_xml_add(il_map_xml *x, const char *s, size_t n, long line, il_error *err)
{
    if (n > x->max_text || x->n_text > x->max_text - n)
        return il_fail(err, IL_E_INPUT, line, "a text of more than %zu bytes", x->max_text);
    if (!il_grow(&x->text, &x->cap_text, x->n_text + n, 1))
        return il_fail_nomem(err);
    memcpy(x->text + x->n_text, s, n);
    x->n_text += n;
    return IL_OK;
}

il_status il_map_xml_name(il_map_xml *x, const char *name, size_t n, il_error *err)
{
    if (!il_grow(&x->name, &x->cap_name, n + 1, 1))
        return il_fail_nomem(err);
    memcpy(x->name, name, n);
    x->n_name = n;
    return IL_OK;
}

void il_map_xml_begin_value(il_map_xml *x)
{
    il_map_xml_keep(x);
    x->keeps = x->n_name > 0 && il_map_wants(x->set, x->name, x->n_name);
}

il_status il_map_xml_end_value(il_map_xml *x, il_error *err)
{
    size_t n_name = x->n_name;
    bool is_there = x->keeps && !il_map_xml_is_blank(x->text, x->n_text, &(long){ 0 });
    x->has_text = x->keeps = false;
    x->n_name = 0;
    return n_name > 0 ? il_map_attribute(x->set, x->name, n_name, is_there ? x->text : NULL, x->n_text, err) : IL_OK;
}

il_status il_map_xml_end_place(il_map_xml *x, const char *name, il_error *err)
{
    bool is_told = x->has_text && !il_map_xml_is_blank(x->text, x->n_text, &(long){ 0 });
    x->has_text = x->keeps = false;
    return is_told ? il_map_place(x->set, name, x->text, x->n_text, err) : IL_OK;
}

bool il_map_xml_is_blank(const char *s, size_t n, long *line)
{
    for (size_t i = 0; i < n; i++) {
        *line += s[i] == '\n' ? 1 : 0;
        if (!il_xml_is_blank(s[i]))
            return false;
    }
    return true;
}

il_status il_map_xml_finish(const il_map_xml *x, long line, il_error *err)
{
    if (x->depth > 0 || x->n_skipped > 0)
        return il_fail(err, IL_E_INPUT, line, "the file ends inside an element: it was cut");
    return IL_OK;
}
