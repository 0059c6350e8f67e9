/* fuzz_csv.c - separated values and WKT, as map.h has it; and how they begin is asked of the probe. */
#include "config.h"
#include "map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    (void)il_reader_csv.probe(data, n);
    return fuzz_map(&il_reader_csv, data, n);
}
