#include "config.h"
#include "input/reader.h"
#include "base/text.h"
#include "input/shp.h"

#include <stdio.h>
#include <string.h>

const il_reader *const il_readers[] = {
    &il_reader_loft, &il_reader_dcmdump, &il_reader_dicom_json,
    &il_reader_kml, &il_reader_gpx, /* before DICOM, whose elements may stand in any others */
    &il_reader_dicom_xml, &il_reader_svg,
    &il_reader_geojsonseq, &il_reader_geojson, &il_reader_shp, &il_reader_dxf,
    &il_reader_bln, &il_reader_gmt, &il_reader_csv, /* tables of numbers, the strictest first */
    NULL };

const il_reader *il_reader_named(const char *name)
{
    for (const il_reader *const *r = il_readers; *r; r++)
        if (strcmp((*r)->name, name) == 0)
            return *r;
    return NULL;
}

enum { PROBE_BYTES = 4096, PREAMBLE = 128, NAME_MOST = 150 };

/* A first element of group 0002 or 0008, numbers in the order that LOW and HIGH,
 * the offsets of their bytes, say: it is one of the first of its group, with two
 * letters for the type of its value or a short length in 32 bits. */
static bool begins_as_dicom(const unsigned char *head, size_t n, int low, int high)
{
    if (n < 8 || (head[low] != 2 && head[low] != 8) || head[high] != 0 || head[2 + high] > 1)
        return false;
    bool letters = head[4] >= 'A' && head[4] <= 'Z' && head[5] >= 'A' && head[5] <= 'Z';
    return letters || (head[4 + 3 * high] == 0 && head[4 + 3 * high + (high ? -1 : 1)] == 0);
}

static bool is_binary_dicom(const unsigned char *head, size_t n)
{
    return (n >= PREAMBLE + 4 && memcmp(head + PREAMBLE, "DICM", 4) == 0) ||
           begins_as_dicom(head, n, 0, 1) || begins_as_dicom(head, n, 1, 0);
}

/* PK, and which record of the archive comes first. */
static bool is_zip(const unsigned char *head, size_t n)
{
    return n >= 4 && memcmp(head, "PK", 2) == 0 && head[2] < 9 && head[3] == head[2] + 1;
}

/* Text in units of two bytes: it has its byte order mark, or begins with a
 * character that text of the formats here may begin with. */
static bool is_utf_16(const unsigned char *head, size_t n)
{
    if (n < 2 || memcmp(head, "\xFF\xFE", 2) == 0 || memcmp(head, "\xFE\xFF", 2) == 0)
        return n >= 2;
    int zero = head[0] == 0 ? 0 : 1;
    return head[zero] == 0 && head[1 - zero] != 0 && strchr("#(<{[i\n\r ", head[1 - zero]) != NULL;
}

/* Only a name that can stand between quotes as it is goes into the command. */
static il_status fail_binary_dicom(const char *name, il_error *err)
{
    char shown[NAME_MOST + 1], quoted[NAME_MOST + 3] = "FILE";
    size_t n = strlen(name);
    bool plain = il_text_printable(shown, sizeof shown, name, n) == n && memcmp(shown, name, n) == 0 && !strchr(name, '\'');
    if (plain && strcmp(name, "-") != 0)
        snprintf(quoted, sizeof quoted, "'%s'", shown);
    return il_fail(err, IL_E_INPUT, 0, "is a binary DICOM file; dcmdump +L %s | isoloft reads its text", quoted);
}

static il_status looks_like(const il_reader *r, const unsigned char *head, size_t n, bool *is, il_error *err)
{
    if (r->look)
        return r->look(head, n, is, err);
    *is = r->probe(head, n);
    return IL_OK;
}

il_status il_reader_detect(il_source *source, const il_reader **out, il_error *err)
{
    const unsigned char *head;
    size_t n;
    il_status st = il_source_peek(source, PROBE_BYTES, &head, &n, err);
    if (st != IL_OK)
        return st;
    bool is = false;
    for (const il_reader *const *r = il_readers; *r && st == IL_OK; r++) {
        st = looks_like(*r, head, n, &is, err);
        if (st == IL_OK && is) {
            *out = *r;
            return IL_OK;
        }
    }
    if (st != IL_OK)
        return st;
    if (il_shp_is_part(il_source_name(source)))
        st = il_shp_fail_part(err);
    else if (n == 0)
        st = il_fail(err, IL_E_INPUT, 0, "the input is empty");
    else if (is_binary_dicom(head, n))
        st = fail_binary_dicom(il_source_name(source), err);
    else if (is_zip(head, n))
        st = il_fail(err, IL_E_INPUT, 0, "is a zip archive, as KMZ files are too; unzip it first");
    else if (is_utf_16(head, n))
        st = il_fail(err, IL_E_INPUT, 0, "is UTF-16, as shells of Windows write it; "
                                         "iconv -f UTF-16 -t UTF-8 makes the text that isoloft reads");
    else
        st = il_fail(err, IL_E_INPUT, 1, "not a format that isoloft knows (see isoloft --formats; -f names one)");
    il_error_set_file(err, il_source_name(source));
    return st;
}
