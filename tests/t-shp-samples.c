/* t-shp-samples.c - every sample of formats/shp.txt. */
#include "config.h"
#include "samples.h"

int main(void)
{
    static const samples cases[] = {
        { "shp", ".shp", &il_reader_shp, NULL, NULL, NULL },
        { "shp", ".SHP", &il_reader_shp, NULL, NULL, NULL },
    };
    return samples_run(cases, 2, "shp", "3.  Records\n\n");
}
