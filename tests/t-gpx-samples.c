/* t-gpx-samples.c - every sample of formats/gpx.txt. */
#include "config.h"
#include "samples.h"

#include <string.h>

static il_read_options as_they_are(const char *text)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    (void)text;
    o.map.project = IL_PROJECT_NONE;
    return o;
}

/* Up to the end of the first gpx: a second one that is not there is not missed. */
static size_t essential(const char *text)
{
    const char *end = strstr(text, "</gpx>"), *prefixed = strstr(text, "</g:gpx>");
    assert_true(end || prefixed);
    return (size_t)((end ? end : prefixed) - text);
}

int main(void)
{
    static const samples gpx = { "gpx", ".gpx", &il_reader_gpx, as_they_are, ": not well-formed", essential };
    return samples_run(&gpx, 1, "gpx", "3.  Tracks and routes\n\n");
}
