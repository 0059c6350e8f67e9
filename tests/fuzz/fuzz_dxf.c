/* fuzz_dxf.c - DXF drawings, as map.h has it. */
#include "config.h"
#include "map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    return fuzz_map(&il_reader_dxf, data, n);
}
