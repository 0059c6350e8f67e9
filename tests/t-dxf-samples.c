/* t-dxf-samples.c - every sample of formats/dxf.txt. */
#include "config.h"
#include "base/number.h"
#include "samples.h"

#include <stdio.h>
#include <string.h>

/* The option in a comment "isoloft read ..." of a sample; its words stay where
 * samples are read one after the other. */
static il_read_options options_of(const char *text)
{
    static const char mark[] = "isoloft read ";
    static char word[2][64];
    static const char *layer[] = { word[1] };
    il_read_options o = IL_READ_OPTIONS_INIT;
    const char *p = strstr(text, mark);
    if (!p)
        return o;
    assert_true(sscanf(p + strlen(mark), "%63s %63s", word[0], word[1]) == 2);
    if (strcmp(word[0], "--flatness") == 0) {
        assert_true(il_number_parse(word[1], strlen(word[1]), &o.flatness) > 0);
    } else if (strcmp(word[0], "--height") == 0) {
        o.map.height = word[1];
    } else {
        assert_string_equal(word[0], "--layer");
        o.map.layer = layer;
        o.map.n_layers = 1;
    }
    return o;
}

int main(void)
{
    static const samples dxf = { "dxf", ".dxf", &il_reader_dxf, options_of, NULL, NULL };
    return samples_run(&dxf, 1, "dxf", "3.  Sections\n\n");
}
