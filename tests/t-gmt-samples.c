/* t-gmt-samples.c - every sample of formats/gmt.txt. */
#include "config.h"
#include "samples.h"

static il_read_options numbers_as_they_are(const char *text)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    (void)text;
    o.map.project = IL_PROJECT_NONE;
    return o;
}

/* Where a table is cut cannot be told. */
static size_t nothing(const char *text)
{
    (void)text;
    return 0;
}

int main(void)
{
    static const samples form = { "gmt", ".gmt", &il_reader_gmt, numbers_as_they_are, NULL, nothing };
    return samples_run(&form, 1, "gmt", "3. Segments\n\n");
}
