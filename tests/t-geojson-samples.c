/* t-geojson-samples.c - every sample of formats/geojson.txt: texts by themselves, in
 * JavaScript, and in sequences. */
#include "config.h"
#include "samples.h"

int main(void)
{
    static const samples forms[] = {
        { "geojson", ".geojson", &il_reader_geojson, NULL, NULL, samples_json_value },
        { "geojson", ".js", &il_reader_geojson, NULL, NULL, samples_json_value },
        { "geojson", ".geojsonl", &il_reader_geojsonseq, NULL, NULL, samples_json_value },
    };
    return samples_run(forms, sizeof forms / sizeof *forms, "geojson", "3.  Objects\n\n");
}
