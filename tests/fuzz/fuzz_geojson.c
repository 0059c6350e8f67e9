/* fuzz_geojson.c - GeoJSON and its text sequences, as map.h has it; and how a text
 * begins is asked of both probes. */
#include "config.h"
#include "map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    bool is_sequence = il_reader_geojsonseq.probe(data, n), is_any = il_reader_geojson.probe(data, n);
    must(is_any || !is_sequence, "a sequence that begins as no JSON");
    return fuzz_map(is_sequence ? &il_reader_geojsonseq : &il_reader_geojson, data, n);
}
