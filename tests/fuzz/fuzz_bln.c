/* fuzz_bln.c - Surfer's blanking files, as map.h has it; and how they begin is asked of the probe. */
#include "config.h"
#include "map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    (void)il_reader_bln.probe(data, n);
    return fuzz_map(&il_reader_bln, data, n);
}
