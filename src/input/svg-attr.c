#include "config.h"
#include "input/svg-attr.h"

#include <string.h>

static const struct { il_svg_namespace ns; const char *prefix, *uri; } namespaces[] = {
    { IL_SVG_NS_SVG, "svg", "http://www.w3.org/2000/svg" },
    { IL_SVG_NS_SLIC3R, "slic3r", "http://slic3r.org/namespaces/slic3r" },
    { IL_SVG_NS_INKSCAPE, "inkscape", "http://www.inkscape.org/namespaces/inkscape" },
};

il_svg_namespace il_svg_namespace_of(const char *prefix, const char *uri)
{
    if (!uri && !prefix)
        return IL_SVG_NS_NONE;
    for (size_t i = 0; i < sizeof namespaces / sizeof *namespaces; i++)
        if (strcmp(uri ? uri : prefix, uri ? namespaces[i].uri : namespaces[i].prefix) == 0)
            return namespaces[i].ns;
    return IL_SVG_NS_OTHER;
}

bool il_svg_element_is_svg(const il_svg_element *e)
{
    return e->ns == IL_SVG_NS_SVG || e->ns == IL_SVG_NS_NONE;
}

bool il_svg_attr(const il_svg_element *e, il_svg_namespace ns, const char *name, il_svg_text *value)
{
    for (size_t i = 0; i < e->n_attributes; i++) {
        const char *const *a = (const char *const *)(e->attribute + 5 * i);
        if (strcmp(a[0], name) == 0 && il_svg_namespace_of(a[1], a[2]) == ns) {
            *value = (il_svg_text){ name, a[3], (size_t)(a[4] - a[3]), 0 };
            return true;
        }
    }
    return false;
}

/* The declaration "NAME : value" in the list STYLE, which may hold strings but
 * in which no semicolon is expected inside them. */
static bool find_declaration(il_svg_text style, const char *name, il_svg_text *value)
{
    size_t len = strlen(name);
    while (il_svg_text_more(&style)) {
        const char *s = style.s + style.at, *end = memchr(s, ';', style.n - style.at);
        size_t n = end ? (size_t)(end - s) : style.n - style.at;
        il_svg_text rest = { name, s, n, len };
        style.at += end ? n + 1 : n;
        if (n > len && memcmp(s, name, len) == 0 && il_svg_text_take(&rest, ':')) {
            il_svg_text_more(&rest);
            *value = (il_svg_text){ name, s + rest.at, n - rest.at, 0 };
            return true;
        }
    }
    return false;
}

bool il_svg_property(const il_svg_element *e, const char *name, il_svg_text *value)
{
    il_svg_text style;
    return (il_svg_attr(e, IL_SVG_NS_NONE, "style", &style) && find_declaration(style, name, value)) ||
           il_svg_attr(e, IL_SVG_NS_NONE, name, value);
}
