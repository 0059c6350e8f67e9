/* patient.c - a structure set made for measuring, on standard output.
 *
 *     patient [-f FORM] ORGANS SLICES POINTS
 *
 * ORGANS regions of interest of SLICES contours with POINTS points each.  A contour
 * is a circle with harmonics whose heights and phases drift from slice to slice, on
 * a trunk that bends; radii close like an ellipsoid's towards both ends.  Decimals
 * by turns as planning systems write them: two, three, and as many as there are.
 * FORM: dump (as dcmdump +L writes it, the default), json, xml (PS3.19), dcmtk (its
 * own XML), loft (native), svg (levels in data-z, y down). */
#include "config.h"
#include "base/number.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HARMONICS = 6, VALUE_MOST = 64, DIGITS = 3 };

static const double SPACING = 2.5, TURN = 6.283185307179586;

typedef enum form { DUMP, JSON, XML, DCMTK, LOFT, SVG, N_FORMS } form;
static const char *const form_names[N_FORMS] = { "dump", "json", "xml", "dcmtk", "loft", "svg" };

/* The value at hand as text: all of a contour's numbers. */
static char *text;
static size_t n_text, cap_text, n_values;

static void add_text(const char *s, size_t n)
{
    if (n_text + n + 1 > cap_text) {
        cap_text = 2 * (n_text + n) + 4096;
        text = realloc(text, cap_text);
        if (!text)
            abort();
    }
    memcpy(text + n_text, s, n);
    n_text += n;
    text[n_text] = '\0';
}

static size_t format_number(char to[VALUE_MOST], double v, int decimals)
{
    if (decimals < DIGITS)
        return (size_t)snprintf(to, VALUE_MOST, "%.*f", decimals + 2, v);
    return (size_t)snprintf(to, VALUE_MOST, "%.12g", v); /* as much as a decimal string of 16 bytes holds */
}

/* ---- shapes ---------------------------------------------------------------------- */

/* splitmix64, as a number in [0, 1). */
static double uniform(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

typedef struct organ {
    double x, y, r, bend, sway;
    double height[HARMONICS], phase[HARMONICS], drift[HARMONICS];
    int decimals;
} organ;

static organ make_organ(int index)
{
    uint64_t seed = 77 + (uint64_t)index;
    organ o = { 400 * uniform(&seed) - 200, 400 * uniform(&seed) - 200, 0, 0, 0, { 0 }, { 0 }, { 0 }, index % DIGITS };
    o.r = index == 0 ? 120 : 15 + 30 * uniform(&seed);
    o.bend = o.r * uniform(&seed) / 2;
    o.sway = 4 * uniform(&seed);
    for (int k = 0; k < HARMONICS; k++) {
        o.height[k] = 0.15 * uniform(&seed) / (k + 1);
        o.phase[k] = TURN * uniform(&seed);
        o.drift[k] = 6 * uniform(&seed) - 3;
    }
    return o;
}

/* Point K of N of O at height T, from 0 to 1. */
static void point_of(const organ *o, double t, int k, int n, double p[2])
{
    double turn = TURN * k / n, r = 1;
    for (int h = 0; h < HARMONICS; h++)
        r += o->height[h] * cos((h + 2) * turn + o->phase[h] + o->drift[h] * t);
    r *= o->r * sqrt(0.05 + 0.95 * (1 - (2 * t - 1) * (2 * t - 1)));
    p[0] = o->x + o->bend * sin(o->sway * t) + r * cos(turn);
    p[1] = o->y + o->bend * cos(o->sway * t) + 0.8 * r * sin(turn);
}

/* ---- elements ---------------------------------------------------------------------- */

/* depth: of brackets; first[d]: is nothing there yet?  (JSON's commas) */
static form as;
static int depth;
static bool first[16];

static void comma(void)
{
    if (as == JSON && !first[depth])
        putchar(',');
    first[depth] = false;
}

static void open_json(const char *vr, const char *group, const char *element)
{
    comma();
    printf("\"%s%s\":{\"vr\":\"%s\"", group, element, vr);
}

/* One element of tag (GROUP,ELEMENT): VALUES with backslashes between them. */
static void put_element(const char *group, const char *element, const char *vr, const char *values, size_t n_in_value, const char *name)
{
    bool is_number = strcmp(vr, "DS") == 0 || strcmp(vr, "IS") == 0;
    if (as == DUMP) {
        printf("%*s(%s,%s) %s [%s] # %zu,%zu %s\n", 2 * depth, "", group, element, vr, values, strlen(values), n_in_value, name);
    } else if (as == DCMTK) {
        printf("<element tag=\"%s,%s\" vr=\"%s\" vm=\"%zu\" len=\"%zu\" name=\"%s\">%s</element>\n", group, element, vr, n_in_value,
               strlen(values), name, values);
    } else if (as == JSON) {
        open_json(vr, group, element);
        printf(",\"Value\":[%s", is_number ? "" : "\"");
        for (const char *s = values; *s; s++)
            putchar(*s == '\\' ? ',' : *s);
        printf("%s]}", is_number ? "" : "\"");
    } else {
        printf("<DicomAttribute tag=\"%s%s\" vr=\"%s\" keyword=\"%s\">\n", group, element, vr, name);
        int i = 1;
        for (const char *s = values, *end; s; s = end ? end + 1 : NULL, i++) {
            end = strchr(s, '\\');
            printf("<Value number=\"%d\">%.*s</Value>\n", i, end ? (int)(end - s) : (int)strlen(s), s);
        }
        printf("</DicomAttribute>\n");
    }
}

static void put_text(const char *group, const char *element, const char *vr, const char *name, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
static void put_text(const char *group, const char *element, const char *vr, const char *name, const char *format, ...)
{
    char value[200];
    va_list args;
    size_t n = 1;
    va_start(args, format);
    vsnprintf(value, sizeof value, format, args);
    va_end(args);
    for (const char *s = value; *s; s++)
        n += *s == '\\';
    put_element(group, element, vr, value, n, name);
}

static void begin_sequence(const char *element, int n, const char *name)
{
    if (as == DUMP)
        printf("%*s(3006,%s) SQ (Sequence with undefined length #=%d) # u/l, 1 %s\n", 2 * depth, "", element, n, name);
    else if (as == DCMTK)
        printf("<sequence tag=\"3006,%s\" vr=\"SQ\" card=\"%d\" name=\"%s\">\n", element, n, name);
    else if (as == XML)
        printf("<DicomAttribute tag=\"3006%s\" vr=\"SQ\" keyword=\"%s\">\n", element, name);
    else {
        open_json("SQ", "3006", element);
        fputs(",\"Value\":[", stdout);
    }
    first[++depth] = true;
}

static void end_sequence(void)
{
    static const char *const ends[N_FORMS] = { "", "]}", "</DicomAttribute>\n", "</sequence>\n", "", "" };
    depth--;
    if (as == DUMP)
        printf("%*s(fffe,e0dd) na (SequenceDelimitationItem) # 0, 0 SequenceDelimitationItem\n", 2 * depth, "");
    fputs(ends[as], stdout);
}

static void begin_item(int number)
{
    comma();
    if (as == DUMP)
        printf("%*s(fffe,e000) na (Item with undefined length) # u/l, 1 Item\n", 2 * depth, "");
    else if (as == DCMTK)
        puts("<item card=\"1\">");
    else if (as == XML)
        printf("<Item number=\"%d\">\n", number);
    else
        putchar('{');
    first[++depth] = true;
}

static void end_item(void)
{
    static const char *const ends[N_FORMS] = { "", "}", "</Item>\n", "</item>\n", "", "" };
    depth--;
    if (as == DUMP)
        printf("%*s(fffe,e00d) na (ItemDelimitationItem) # 0, 0 ItemDelimitationItem\n", 2 * depth, "");
    fputs(ends[as], stdout);
}

/* ---- the set ------------------------------------------------------------------------ */

static void put_contour(const organ *o, int slice, int slices, int points)
{
    char number[VALUE_MOST], z[VALUE_MOST];
    size_t n_z = format_number(z, SPACING * slice - 300, o->decimals);
    double p[2];
    n_text = n_values = 0;
    for (int k = 0; k < points; k++) {
        point_of(o, slices > 1 ? (double)slice / (slices - 1) : 0.5, k, points, p);
        for (int i = 0; i < 2; i++, n_values++) {
            if (n_values > 0)
                add_text("\\", 1);
            add_text(number, format_number(number, p[i], o->decimals));
        }
        add_text("\\", 1);
        add_text(z, n_z);
        n_values++;
    }
    begin_item(slice + 1);
    put_text("3006", "0042", "CS", "ContourGeometricType", "CLOSED_PLANAR");
    put_text("3006", "0046", "IS", "NumberOfContourPoints", "%d", points);
    put_element("3006", "0050", "DS", text, n_values, "ContourData");
    end_item();
}

static void put_set(int organs, int slices, int points)
{
    static const char *const begins[N_FORMS] = {
        "# Dicom-Data-Set\n# Used TransferSyntax: Little Endian Explicit\n", "{",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<NativeDicomModel xml:space=\"preserve\">\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<file-format>\n<data-set xfer=\"1.2.840.10008.1.2.1\">\n", "", "" };
    static const char *const ends[N_FORMS] = { "", "}\n", "</NativeDicomModel>\n", "</data-set>\n</file-format>\n", "", "" };
    fputs(begins[as], stdout);
    first[0] = true;
    put_text("0008", "0060", "CS", "Modality", "RTSTRUCT");
    begin_sequence("0020", organs, "StructureSetROISequence");
    for (int k = 0; k < organs; k++) {
        begin_item(k + 1);
        put_text("3006", "0022", "IS", "ROINumber", "%d", k + 1);
        put_text("3006", "0026", "LO", "ROIName", "Organ %d", k + 1);
        end_item();
    }
    end_sequence();
    begin_sequence("0039", organs, "ROIContourSequence");
    for (int k = 0; k < organs; k++) {
        organ o = make_organ(k);
        begin_item(k + 1);
        put_text("3006", "002a", "IS", "ROIDisplayColor", "%d\\%d\\%d", 255 - 20 * k % 256, 40 * k % 256, 90);
        begin_sequence("0040", slices, "ContourSequence");
        for (int s = 0; s < slices; s++)
            put_contour(&o, s, slices, points);
        end_sequence();
        put_text("3006", "0084", "IS", "ReferencedROINumber", "%d", k + 1);
        end_item();
    }
    end_sequence();
    fputs(ends[as], stdout);
}

/* The same contours as native text or SVG; SVG has one stack, so organs lie over
 * one another there. */
static void put_plain(int organs, int slices, int points)
{
    char number[VALUE_MOST];
    fputs(as == LOFT ? "isoloft 1\nunit mm\n" : "<svg xmlns=\"http://www.w3.org/2000/svg\">\n", stdout);
    for (int k = 0; k < organs; k++) {
        organ o = make_organ(k);
        if (as == LOFT)
            printf("stack \"Organ %d\"\n", k + 1);
        for (int s = 0; s < slices; s++) {
            printf(as == LOFT ? "slice %.12g\nring\n" : "<path data-z=\"%.12g\" d=\"", SPACING * s - 300);
            for (int i = 0; i < points; i++) {
                double p[2];
                point_of(&o, slices > 1 ? (double)s / (slices - 1) : 0.5, i, points, p);
                fputs(as == LOFT ? "" : i == 0 ? "M" : "L", stdout);
                format_number(number, p[0], o.decimals);
                printf("%s ", number);
                format_number(number, as == LOFT ? p[1] : -p[1], o.decimals);
                printf("%s%s", number, as == LOFT ? "\n" : "");
            }
            fputs(as == LOFT ? "" : "Z\"/>\n", stdout);
        }
    }
    fputs(as == LOFT ? "end\n" : "</svg>\n", stdout);
}

int main(int argc, char **argv)
{
    if (argc > 2 && strcmp(argv[1], "-f") == 0) {
        for (as = DUMP; as < N_FORMS && strcmp(form_names[as], argv[2]) != 0; as++)
            continue;
        argv += 2;
        argc -= 2;
    }
    int organs = argc == 4 ? atoi(argv[1]) : 0, slices = argc == 4 ? atoi(argv[2]) : 0, points = argc == 4 ? atoi(argv[3]) : 0;
    if (as == N_FORMS || organs < 1 || slices < 1 || points < 3) {
        fputs("usage: patient [-f dump|json|xml|dcmtk|loft|svg] ORGANS SLICES POINTS\n", stderr);
        return 2;
    }
    if (as == LOFT || as == SVG)
        put_plain(organs, slices, points);
    else
        put_set(organs, slices, points);
    free(text);
    return ferror(stdout) || fclose(stdout) != 0;
}
