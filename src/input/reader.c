#include "config.h"
#include "input/reader.h"

#include <string.h>

const il_reader *const il_readers[] = {
    &il_reader_loft, &il_reader_dcmdump, &il_reader_dicom_json, &il_reader_dicom_xml, &il_reader_svg, NULL
};

const il_reader *il_reader_named(const char *name)
{
    for (const il_reader *const *r = il_readers; *r; r++)
        if (strcmp((*r)->name, name) == 0)
            return *r;
    return NULL;
}

enum { PROBE_BYTES = 4096 };

il_status il_reader_detect(il_source *source, const il_reader **out, il_error *err)
{
    const unsigned char *head;
    size_t n;
    il_status st = il_source_peek(source, PROBE_BYTES, &head, &n, err);
    if (st != IL_OK)
        return st;
    for (const il_reader *const *r = il_readers; *r; r++) {
        if ((*r)->probe(head, n)) {
            *out = *r;
            return IL_OK;
        }
    }
    if (n == 0)
        st = il_fail(err, IL_E_INPUT, 0, "the input is empty");
    else
        st = il_fail(err, IL_E_INPUT, 1, "not a format that isoloft knows (see isoloft --formats; -f names one)");
    il_error_set_file(err, il_source_name(source));
    return st;
}
