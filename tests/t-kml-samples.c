/* t-kml-samples.c - every sample of formats/kml.txt. */
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

/* A piece without one element around it does not show its end. */
static size_t essential(const char *text)
{
    return strstr(text, "</kml") || strstr(text, ":kml>") || strstr(text, "</Document") ? strlen(text) : 0;
}

int main(void)
{
    static const samples kml = { "kml", ".kml", &il_reader_kml, as_they_are, ": not well-formed", essential };
    return samples_run(&kml, 1, "kml", "3.  Placemarks and their lines\n\n");
}
