/* t-dicom-samples.c - every sample of formats/dicom.txt, in each of its forms. */
#include "config.h"
#include "samples.h"

#include <string.h>

/* Up to the tag that ends the contours.  Types may be missing, which is told, and
 * so nobody can say whether they were cut off. */
static size_t up_to_contours(const char *text)
{
    static const char end[] = "\n(fffe,e0dd)";
    const char *last = text, *types = strstr(text, "(3006,0080)");
    for (const char *p = strstr(text, end); p && (!types || p < types); p = strstr(p + 1, end))
        last = p + strlen(end);
    return (size_t)(last - text);
}

int main(void)
{
    static const samples forms[] = {
        { "dcmdump", ".txt", &il_reader_dcmdump, NULL, NULL, up_to_contours },
        { "dicom-json", ".json", &il_reader_dicom_json, NULL, NULL, samples_json_value },
        { "dicom-xml", ".xml", &il_reader_dicom_xml, NULL, ": not well-formed", NULL },
    };
    return samples_run(forms, sizeof forms / sizeof *forms, "dicom", "3.  What is read of a structure set\n\n");
}
