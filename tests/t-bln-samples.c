/* t-bln-samples.c - every sample of formats/bln.txt. */
#include "config.h"
#include "samples.h"

#include <stdlib.h>
#include <string.h>

/* Up to the last point of the first block: what is cut there has too few points.  A
 * later block that is not there is not missed. */
static size_t up_to_last_point(const char *text)
{
    const char *p = text + strspn(text, "\xEF\xBB\xBF\r\n");
    for (long left = strtol(p, NULL, 10); left > 0; left -= *p != '\n' && *p != '\r')
        p = strchr(p, '\n') + 1;
    return (size_t)(p - text);
}

int main(void)
{
    static const samples form = { "bln", ".bln", &il_reader_bln, NULL, NULL, up_to_last_point };
    return samples_run(&form, 1, "bln", "3. Blocks\n\n");
}
