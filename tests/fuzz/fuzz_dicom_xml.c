/* fuzz_dicom_xml.c - DICOM as XML, in both of its forms, as structure-set.h has it. */
#include "config.h"
#include "structure-set.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    return fuzz_structure_set(&il_reader_dicom_xml, data, n);
}
