/* fuzz_dicom_json.c - DICOM JSON, as structure-set.h has it. */
#include "config.h"
#include "structure-set.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    return fuzz_structure_set(&il_reader_dicom_json, data, n);
}
