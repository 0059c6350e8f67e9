/* t-svg-samples.c - every sample of formats/svg.txt. */
#include "config.h"
#include "base/number.h"
#include "samples.h"

#include <stdio.h>
#include <string.h>

/* The options in the comment "<!-- isoloft read ... -->" of a sample. */
static il_read_options options_of(const char *text)
{
    static const char mark[] = "<!-- isoloft read ";
    il_read_options o = IL_READ_OPTIONS_INIT;
    const char *p = strstr(text, mark);
    char word[2][64];
    if (!p)
        return o;
    p += strlen(mark);
    assert_true(sscanf(p, "%63s %63s", word[0], word[1]) == 2);
    if (strcmp(word[0], "--spacing") == 0) {
        o.has_spacing = true;
        assert_true(il_number_parse(word[1], strlen(word[1]), &o.spacing) > 0);
    } else if (strcmp(word[0], "--flatness") == 0) {
        assert_true(il_number_parse(word[1], strlen(word[1]), &o.flatness) > 0);
    } else if (strcmp(word[0], "--unit") == 0) {
        o.has_unit = true;
        assert_true(il_unit_parse(word[1], strlen(word[1]), &o.unit));
    } else {
        assert_string_equal(word[0], "--no-flip");
        o.no_flip = true;
    }
    return o;
}

/* A fragment without an svg around it does not show its end. */
static size_t essential(const char *text)
{
    return strstr(text, "</svg") || strstr(text, "</s:svg") ? strlen(text) : 0;
}

int main(void)
{
    static const samples svg = { "svg", ".svg", &il_reader_svg, options_of, ": not well-formed", essential };
    return samples_run(&svg, 1, "svg", "3.  Which elements are contours\n\n");
}
