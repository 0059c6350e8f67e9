/* kml.c - the lines of KML (formats/kml.txt), of any version.  Elements are told by
 * their names alone: files have the namespaces of Google, of OGC and none. */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/kml-description.h"
#include "input/kml-points.h"
#include "input/map-xml.h"

#include <math.h>
#include <string.h>

/* What an element is here.  OTHER means nothing by itself, and what is inside is
 * looked at. */
typedef enum kind {
    OTHER, CONTAINER, PLACEMARK, POLYGON,
    LINE, RING, POINT, TRACK,           /* each one part of the map */
    COORDINATES, COORD,
    NAME, DESCRIPTION, MODE,
    DATA, VALUE,                        /* <Data name=""><value> */
    SIMPLE,                             /* <SimpleData name=""> */
    EXTENDED, FOREIGN,                  /* elements of others in ExtendedData */
    QUIET,                              /* values of single points: passed over */
    LEFT_OUT                            /* counted */
} kind;

typedef struct element {
    const char *name;
    kind kind;
    const char *why;                    /* it is left out */
} element;

static const element elements[] = { /* the commonest first */
    { "coord", COORD, NULL }, { "Placemark", PLACEMARK, NULL }, { "LineString", LINE, NULL },
    { "coordinates", COORDINATES, NULL }, { "name", NAME, NULL }, { "description", DESCRIPTION, NULL },
    { "SimpleData", SIMPLE, NULL }, { "value", VALUE, NULL }, { "Data", DATA, NULL }, { "ExtendedData", EXTENDED, NULL },
    { "MultiGeometry", OTHER, NULL }, { "altitudeMode", MODE, NULL }, { "Polygon", POLYGON, NULL }, { "LinearRing", RING, NULL },
    { "Point", POINT, NULL }, { "Track", TRACK, NULL }, { "MultiTrack", OTHER, NULL }, { "Folder", CONTAINER, NULL },
    { "Document", CONTAINER, NULL }, { "kml", OTHER, NULL }, { "SchemaData", EXTENDED, NULL }, { "SimpleArrayData", QUIET, NULL },
    { "NetworkLink", LEFT_OUT, "what is elsewhere is not fetched" },
    { "GroundOverlay", LEFT_OUT, "a picture has no isolines" },
    { "ScreenOverlay", LEFT_OUT, "a picture has no isolines" },
    { "PhotoOverlay", LEFT_OUT, "a picture has no isolines" },
    { "Model", LEFT_OUT, "a model has no isolines" },
    { "Tour", LEFT_OUT, "a tour has no isolines" },
    { "NetworkLinkControl", LEFT_OUT, "changes to other files are not made" } };

/* A Document or Folder: name is its own, or that of what is around it; own is owned. */
typedef struct container {
    char *own;
    const char *name;
} container;

/* part: what the part at hand is, OTHER when there is none; n_polygons: around it.
 * has_coordinates: it has had that element.  is_relative: its heights are above
 * ground or sea floor. */
typedef struct parser {
    il_map_xml xml;
    il_map_set *set;
    il_kml_points points;
    container *containers;
    size_t n_containers, cap_containers;
    bool in_placemark, has_coordinates, is_relative, said_relative, has_told_places;
    kind part;
    size_t n_polygons;
} parser;

static const element *element_named(const char *name)
{
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++)
        if (strcmp(elements[i].name, name) == 0)
            return &elements[i];
    return NULL;
}

static bool is_part(kind k)
{
    return k == LINE || k == RING || k == POINT || k == TRACK;
}

/* ---- start tags ---------------------------------------------------------------- */

/* Its name is that of what is around it until it tells its own. */
static il_status start_container(parser *p, il_error *err)
{
    if (!il_grow(&p->containers, &p->cap_containers, p->n_containers + 1, sizeof *p->containers))
        return il_fail_nomem(err);
    p->containers[p->n_containers] = (container){ NULL, p->n_containers > 0 ? p->containers[p->n_containers - 1].name : NULL };
    p->n_containers++;
    return IL_OK;
}

/* The places of heights are known by the first placemark, so that they are asked in this
 * order whatever that has. */
static il_status tell_places(parser *p, il_error *err)
{
    static const char *const places[] = { "name", "description", "folder" };
    il_status st = IL_OK;
    for (size_t k = 0; k < sizeof places / sizeof *places && st == IL_OK && !p->has_told_places; k++)
        st = il_map_place(p->set, places[k], NULL, 0, err);
    p->has_told_places = true;
    return st;
}

static il_status start_placemark(parser *p, const il_xml_element *e, il_error *err)
{
    if (p->in_placemark)
        return il_fail(err, IL_E_INPUT, e->line, "a Placemark inside another");
    p->in_placemark = true;
    il_status st = il_map_begin_feature(p->set, e->line, err);
    return st == IL_OK ? tell_places(p, err) : st;
}

/* A geometry outside of placemarks is a feature by itself. */
static il_status start_part(parser *p, kind k, const il_xml_element *e, il_error *err)
{
    if (p->part != OTHER)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s inside another geometry", e->name);
    il_status st = p->in_placemark ? IL_OK : il_map_begin_feature(p->set, e->line, err);
    p->part = k;
    p->has_coordinates = p->is_relative = false;
    il_kml_points_reset(&p->points);
    il_map_part as = k == POINT ? IL_MAP_POINT : k == RING && p->n_polygons > 0 ? IL_MAP_RING : IL_MAP_LINE;
    return st == IL_OK ? il_map_begin_part(p->set, as, e->line, err) : st;
}

static il_status start_coordinates(parser *p, kind k, kind in, const il_xml_element *e, il_error *err)
{
    if (k == COORD ? in != TRACK : !is_part(in) || in == TRACK)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s outside of a geometry that has them", e->name);
    if (k == COORDINATES && p->has_coordinates)
        return il_fail(err, IL_E_INPUT, e->line, "coordinates twice in one geometry");
    p->has_coordinates = true;
    il_kml_points_begin(&p->points, k == COORD);
    return IL_OK;
}

static il_status start_named(parser *p, const il_xml_element *e, il_error *err)
{
    size_t n;
    const char *name = il_xml_attribute(e, "name", &n);
    return il_map_xml_name(&p->xml, name ? name : "", n, err);
}

static il_status start_attribute(parser *p, kind k, const il_xml_element *e, il_error *err)
{
    il_status st = k == FOREIGN ? il_map_xml_name(&p->xml, e->name, strlen(e->name), err)
                   : k == VALUE ? IL_OK : start_named(p, e, err);
    if (st == IL_OK && k != DATA)
        il_map_xml_begin_value(&p->xml);
    return st;
}

/* What an element of kind K is where it stands: words count in their places only, and
 * data of others may have any name. */
static kind settle(const parser *p, kind k, kind in)
{
    bool is_data = k == EXTENDED || k == DATA || k == SIMPLE || k == QUIET;
    if (in == EXTENDED || in == FOREIGN)
        return is_data ? k : FOREIGN;
    if (is_data)
        return p->in_placemark ? k : OTHER;
    switch (k) {
    case NAME:        return in == PLACEMARK || in == CONTAINER ? k : OTHER;
    case DESCRIPTION: return in == PLACEMARK ? k : OTHER;
    case MODE:        return is_part(in) ? k : OTHER;
    case VALUE:       return in == DATA ? k : OTHER;
    default:          return k;
    }
}

static il_status start_kind(parser *p, kind k, kind in, const il_xml_element *e, il_error *err)
{
    switch (k) {
    case CONTAINER: return start_container(p, err);
    case PLACEMARK: return start_placemark(p, e, err);
    case POLYGON:
        p->n_polygons++;
        return IL_OK;
    case LINE:
    case RING:
    case POINT:
    case TRACK: return start_part(p, k, e, err);
    case COORDINATES:
    case COORD: return start_coordinates(p, k, in, e, err);
    case NAME:
    case DESCRIPTION:
    case MODE:
        il_map_xml_keep(&p->xml);
        return IL_OK;
    case DATA:
    case VALUE:
    case SIMPLE:
    case FOREIGN: return start_attribute(p, k, e, err);
    default: return IL_OK;
    }
}

static il_status on_start(void *self, const il_xml_element *e, il_error *err)
{
    parser *p = self;
    if (p->xml.n_skipped > 0) {
        p->xml.n_skipped++;
        return IL_OK;
    }
    const element *known = element_named(e->name);
    kind in = (kind)il_map_xml_in(&p->xml), k = settle(p, known ? known->kind : OTHER, in);
    if (p->xml.depth == 0 && !known)
        return il_fail(err, IL_E_INPUT, e->line, "'%.40s' is no element of KML", e->name);
    if (in == COORDINATES || in == COORD)
        return il_fail(err, IL_E_INPUT, e->line, "an element inside coordinates");
    if (k == LEFT_OUT || k == QUIET) {
        if (k == LEFT_OUT)
            il_map_skip(p->set, e->line, known->name, known->why);
        p->xml.n_skipped = 1;
        return IL_OK;
    }
    il_status st = start_kind(p, k, in, e, err);
    return st == IL_OK ? il_map_xml_push(&p->xml, (int)k, e, err) : st;
}

/* ---- end tags -------------------------------------------------------------------- */

static void end_container(parser *p)
{
    il_free(p->containers[--p->n_containers].own);
}

/* The text kept names the innermost folder. */
static il_status end_container_name(parser *p, il_error *err)
{
    container *c = &p->containers[p->n_containers - 1];
    bool is_blank = il_map_xml_is_blank(p->xml.text, p->xml.n_text, &(long){ 0 });
    char *own = is_blank ? NULL : il_strndup(p->xml.text, p->xml.n_text);
    p->xml.has_text = p->xml.keeps = false;
    if (is_blank)
        return IL_OK;
    if (!own)
        return il_fail_nomem(err);
    il_free(c->own);
    c->own = own;
    c->name = own;
    return IL_OK;
}

static il_status end_placemark(parser *p, il_error *err)
{
    const char *folder = p->n_containers > 0 ? p->containers[p->n_containers - 1].name : NULL;
    p->in_placemark = false;
    il_status st = folder ? il_map_place(p->set, "folder", folder, strlen(folder), err) : IL_OK;
    return st == IL_OK ? il_map_end_feature(p->set, err) : st;
}

static void note_relative(parser *p)
{
    double z = p->points.first[2];
    if (!p->is_relative || p->said_relative || p->points.n_points == 0 || !(z != 0) || isnan(z))
        return;
    p->said_relative = true;
    il_report_note(il_map_report(p->set), "%s: altitudes that are said to be above ground or sea floor are taken as they are",
                   il_map_file(p->set));
}

static il_status end_part(parser *p, long line, il_error *err)
{
    bool is_ring = p->part == RING;
    p->part = OTHER;
    note_relative(p);
    il_status st = is_ring ? il_kml_points_close(&p->points, line, err) : IL_OK;
    if (st == IL_OK)
        st = il_map_end_part(p->set, err);
    return st == IL_OK && !p->in_placemark ? il_map_end_feature(p->set, err) : st;
}

static il_status end_mode(parser *p)
{
    p->is_relative = il_text_contains(p->xml.text, p->xml.n_text, "relativeTo");
    p->xml.has_text = p->xml.keeps = false;
    return IL_OK;
}

static il_status end_description(parser *p, il_error *err)
{
    p->xml.has_text = p->xml.keeps = false;
    return il_kml_description_tell(p->set, p->xml.text, p->xml.n_text, err);
}

static il_status end_kind(parser *p, kind k, kind in, long line, il_error *err)
{
    switch (k) {
    case CONTAINER:
        end_container(p);
        return IL_OK;
    case PLACEMARK: return end_placemark(p, err);
    case POLYGON:
        p->n_polygons--;
        return IL_OK;
    case LINE:
    case RING:
    case POINT:
    case TRACK: return end_part(p, line, err);
    case COORDINATES:
    case COORD: return il_kml_points_end(&p->points, line, err);
    case NAME: return in == PLACEMARK ? il_map_xml_end_place(&p->xml, "name", err) : end_container_name(p, err);
    case DESCRIPTION: return end_description(p, err);
    case MODE: return end_mode(p);
    case DATA: /* without a value, if it has not been told yet */
    case VALUE:
    case SIMPLE:
    case FOREIGN: return il_map_xml_end_value(&p->xml, err);
    default: return IL_OK;
    }
}

static il_status on_end(void *self, long line, il_error *err)
{
    parser *p = self;
    if (p->xml.n_skipped > 0) {
        p->xml.n_skipped--;
        return IL_OK;
    }
    kind k = (kind)il_map_xml_in(&p->xml);
    p->xml.depth--;
    return end_kind(p, k, (kind)il_map_xml_in(&p->xml), line, err);
}

/* ---- text and the file -------------------------------------------------------------- */

static il_status on_text(void *self, const char *s, size_t n, long line, il_error *err)
{
    parser *p = self;
    kind in = (kind)il_map_xml_in(&p->xml);
    if (p->xml.n_skipped > 0)
        return IL_OK;
    if (in == COORDINATES || in == COORD)
        return il_kml_points_add(&p->points, s, n, line, err);
    if (p->xml.has_text)
        return p->xml.keeps ? il_map_xml_add(&p->xml, s, n, line, err) : IL_OK;
    if (is_part(in) && !il_map_xml_is_blank(s, n, &line))
        return il_fail(err, IL_E_INPUT, line, "text in a geometry, outside of its coordinates");
    return IL_OK;
}

static il_status on_finish(void *self, long line, il_error *err)
{
    return il_map_xml_finish(&((const parser *)self)->xml, line, err);
}

static const il_xml_client client = {
    .what = "KML",
    .start = on_start,
    .end = on_end,
    .text = on_text,
    .finish = on_finish,
};

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    parser p = { .set = set, .points = { .set = set, .max_text = options->max_line } };
    il_status st = il_map_xml_init(&p.xml, set, options, err);
    if (st == IL_OK)
        st = il_xml_read(source, &client, &p, options->max_line, err);
    while (p.n_containers > 0)
        end_container(&p);
    il_free(p.containers);
    il_kml_points_free(&p.points);
    il_map_xml_free(&p.xml);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("KML", parse, source, n, options, sink, report, err);
}

/* ---- the probe ------------------------------------------------------------------------- */

/* kml, or a piece of it: Placemark, or what holds them if it shows that it is KML's. */
static bool probe(const unsigned char *head, size_t n)
{
    bool is_type;
    size_t n_name;
    const char *s = (const char *)head, *name = il_xml_first_name(s, n, &n_name, &is_type);
    const char *colon = memchr(name, ':', n_name);
    size_t skip = colon ? (size_t)(colon - name) + 1 : 0;
    name += skip;
    n_name -= skip;
    if (il_text_is(name, n_name, "kml") || il_text_is(name, n_name, "Placemark"))
        return true;
    bool may_be = il_text_is(name, n_name, "Document") || il_text_is(name, n_name, "Folder");
    return may_be && (il_text_contains(s, n, "<Placemark") || il_text_contains(s, n, "/kml/2"));
}

const il_reader il_reader_kml = {
    .name = "kml",
    .extensions = "kml",
    .words = "isolines in KML",
    .is_map = true,
    .probe = probe,
    .read = read_all,
};
