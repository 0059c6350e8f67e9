/* gpx.c - tracks and routes of GPX 1.0 and 1.1 (formats/gpx.txt) as lines of a map.
 * Elements are told by their names alone. */
#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "input/map-xml.h"

#include <math.h>
#include <string.h>

/* What an element is here.  OTHER means nothing by itself, and what is inside is
 * looked at. */
typedef enum kind {
    OTHER, GPX, TRACK, SEGMENT, ROUTE, TRACK_POINT, ROUTE_POINT, WAYPOINT, ELEVATION,
    PLACE,              /* a text that may hold the height */
    EXTENSIONS, VALUE,  /* VALUE: an attribute, in extensions or not */
    QUIET               /* passed over */
} kind;

typedef struct element {
    const char *name;
    kind kind;
} element;

static const element elements[] = { /* the commonest first */
    { "trkpt", TRACK_POINT }, { "ele", ELEVATION }, { "rtept", ROUTE_POINT }, { "trkseg", SEGMENT }, { "trk", TRACK },
    { "rte", ROUTE }, { "wpt", WAYPOINT }, { "name", PLACE }, { "desc", PLACE }, { "cmt", PLACE },
    { "extensions", EXTENSIONS }, { "metadata", QUIET }, { "gpx", GPX } };

typedef struct point {
    double x, y, z;
    long line;
} point;

/* point[n_points]: of the segment or route at hand, which is handed on when it is
 * whole, since names may stand among the points of a route.  begin: its line. */
typedef struct parser {
    il_map_xml xml;
    il_map_set *set;
    point *point;
    size_t n_points, cap;
    long begin;
    bool in_feature;
    const char *place;          /* the name of the PLACE at hand */
} parser;

static const element *element_named(const char *name)
{
    static const element other = { NULL, OTHER };
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++)
        if (strcmp(elements[i].name, name) == 0)
            return &elements[i];
    return &other;
}

/* ---- points ----------------------------------------------------------------------- */

/* The number S[0..N), blanks around it aside. */
static bool read_number(const char *s, size_t n, double *value)
{
    while (n > 0 && il_xml_is_blank(*s))
        s++, n--;
    while (n > 0 && il_xml_is_blank(s[n - 1]))
        n--;
    return n > 0 && il_number_parse(s, n, value) == n;
}

static il_status read_degrees(const il_xml_element *e, const char *name, double *value, il_error *err)
{
    size_t n;
    const char *s = il_xml_attribute(e, name, &n);
    if (!s)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s without %s", e->name, name);
    if (read_number(s, n, value))
        return IL_OK;
    return il_fail(err, IL_E_INPUT, e->line, "%s '%.*s' is not a finite number", name, (int)(n < 40 ? n : 40), s);
}

static il_status start_point(parser *p, const il_xml_element *e, il_error *err)
{
    if (!il_grow(&p->point, &p->cap, p->n_points + 1, sizeof *p->point))
        return il_fail_nomem(err);
    point *at = &p->point[p->n_points++];
    at->z = NAN;
    at->line = e->line;
    il_status st = read_degrees(e, "lon", &at->x, err);
    return st == IL_OK ? read_degrees(e, "lat", &at->y, err) : st;
}

static il_status end_elevation(parser *p, long line, il_error *err)
{
    const char *s = p->xml.text;
    size_t n = p->xml.n_text;
    p->xml.has_text = p->xml.keeps = false;
    if (il_map_xml_is_blank(s, n, &(long){ 0 }) || read_number(s, n, &p->point[p->n_points - 1].z))
        return IL_OK;
    return il_fail(err, IL_E_INPUT, line, "ele '%.*s' is not a finite number", (int)(n < 40 ? n : 40), s);
}

/* The points of the segment or route, or the waypoint, are one part. */
static il_status hand_on(parser *p, il_map_part as, il_error *err)
{
    il_status st = il_map_begin_part(p->set, as, p->begin, err);
    for (size_t i = 0; i < p->n_points && st == IL_OK; i++) {
        const point *at = &p->point[i];
        st = il_map_point(p->set, at->x, at->y, at->z, at->line, err);
    }
    p->n_points = 0;
    return st == IL_OK ? il_map_end_part(p->set, err) : st;
}

/* ---- start tags ----------------------------------------------------------------------- */

static il_status start_feature(parser *p, const il_xml_element *e, il_error *err)
{
    if (p->in_feature)
        return il_fail(err, IL_E_INPUT, e->line, "%.20s inside a track or route", e->name);
    p->in_feature = true;
    p->begin = e->line;
    return il_map_begin_feature(p->set, e->line, err);
}

static il_status start_segment(parser *p, kind in, const il_xml_element *e, il_error *err)
{
    if (in != TRACK)
        return il_fail(err, IL_E_INPUT, e->line, "trkseg outside of trk");
    p->begin = e->line;
    return IL_OK;
}

static il_status start_value(parser *p, const il_xml_element *e, il_error *err)
{
    il_status st = il_map_xml_name(&p->xml, e->name, strlen(e->name), err);
    il_map_xml_begin_value(&p->xml);
    return st;
}

static bool is_line_or_point(kind k)
{
    return k >= TRACK && k <= WAYPOINT;
}

/* What an element of kind K is where it stands.  Of points only the elevation counts;
 * what stands in tracks, routes and their extensions under other names are attributes. */
static kind settle(kind k, kind in)
{
    switch (in) {
    case TRACK_POINT:
    case ROUTE_POINT:
    case WAYPOINT:    return k == ELEVATION || is_line_or_point(k) ? k : QUIET;
    case SEGMENT:     return is_line_or_point(k) ? k : QUIET;
    case EXTENSIONS:
    case VALUE:       return VALUE;
    case TRACK:
    case ROUTE:       return k == OTHER || k == ELEVATION ? VALUE : k;
    case PLACE:       return OTHER;
    default:          return k == PLACE || k == EXTENSIONS || k == ELEVATION ? QUIET : k;
    }
}

static il_status start_waypoint(parser *p, const il_xml_element *e, il_error *err)
{
    il_status st = start_feature(p, e, err);
    return st == IL_OK ? start_point(p, e, err) : st;
}

static il_status start_kind(parser *p, kind k, kind in, const il_xml_element *e, il_error *err)
{
    switch (k) {
    case TRACK:
    case ROUTE: return start_feature(p, e, err);
    case SEGMENT: return start_segment(p, in, e, err);
    case TRACK_POINT:
        return in == SEGMENT ? start_point(p, e, err) : il_fail(err, IL_E_INPUT, e->line, "trkpt outside of trkseg");
    case ROUTE_POINT:
        return in == ROUTE ? start_point(p, e, err) : il_fail(err, IL_E_INPUT, e->line, "rtept outside of rte");
    case WAYPOINT: return start_waypoint(p, e, err);
    case ELEVATION:
    case PLACE:
        il_map_xml_keep(&p->xml);
        return IL_OK;
    case VALUE: return start_value(p, e, err);
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
    kind in = (kind)il_map_xml_in(&p->xml), k = settle(known->kind, in);
    if (p->xml.depth == 0 && k != GPX)
        return il_fail(err, IL_E_INPUT, e->line, "'%.40s' outermost, where gpx belongs", e->name);
    if (in == ELEVATION)
        return il_fail(err, IL_E_INPUT, e->line, "an element inside ele");
    p->place = k == PLACE ? known->name : p->place;
    if (k == QUIET) {
        p->xml.n_skipped = 1;
        return IL_OK;
    }
    il_status st = start_kind(p, k, in, e, err);
    return st == IL_OK ? il_map_xml_push(&p->xml, (int)k, e, err) : st;
}

/* ---- end tags, text and the file -------------------------------------------------------- */

static il_status end_feature(parser *p, il_error *err)
{
    p->in_feature = false;
    return il_map_end_feature(p->set, err);
}

static il_status end_kind(parser *p, kind k, long line, il_error *err)
{
    il_status st = IL_OK;
    switch (k) {
    case TRACK: return end_feature(p, err);
    case SEGMENT: return hand_on(p, IL_MAP_LINE, err);
    case ROUTE:
    case WAYPOINT:
        st = hand_on(p, k == ROUTE ? IL_MAP_LINE : IL_MAP_POINT, err);
        return st == IL_OK ? end_feature(p, err) : st;
    case ELEVATION: return end_elevation(p, line, err);
    case PLACE: return il_map_xml_end_place(&p->xml, p->place, err);
    case VALUE: return il_map_xml_end_value(&p->xml, err);
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
    return end_kind(p, (kind)p->xml.open[--p->xml.depth], line, err);
}

static il_status on_text(void *self, const char *s, size_t n, long line, il_error *err)
{
    parser *p = self;
    int in = il_map_xml_in(&p->xml);
    if (p->xml.n_skipped > 0)
        return IL_OK;
    if (p->xml.has_text)
        return p->xml.keeps ? il_map_xml_add(&p->xml, s, n, line, err) : IL_OK;
    if ((in == SEGMENT || in == ROUTE) && !il_map_xml_is_blank(s, n, &line))
        return il_fail(err, IL_E_INPUT, line, "text among points");
    return IL_OK;
}

static il_status on_finish(void *self, long line, il_error *err)
{
    return il_map_xml_finish(&((const parser *)self)->xml, line, err);
}

static const il_xml_client client = {
    .what = "GPX",
    .start = on_start,
    .end = on_end,
    .text = on_text,
    .finish = on_finish,
};

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    parser p = { .set = set };
    il_status st = il_map_xml_init(&p.xml, set, options, err);
    if (st == IL_OK)
        st = il_xml_read(source, &client, &p, options->max_line, err);
    il_free(p.point);
    il_map_xml_free(&p.xml);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("GPX", parse, source, n, options, sink, report, err);
}

/* ---- the probe ------------------------------------------------------------------------- */

static bool probe(const unsigned char *head, size_t n)
{
    bool is_type;
    size_t n_name;
    const char *name = il_xml_first_name((const char *)head, n, &n_name, &is_type);
    return n_name >= 3 && memcmp(name + n_name - 3, "gpx", 3) == 0 && (n_name == 3 || name[n_name - 4] == ':');
}

const il_reader il_reader_gpx = {
    .name = "gpx",
    .extensions = "gpx",
    .words = "tracks and routes of GPX that are isolines",
    .is_map = true,
    .probe = probe,
    .read = read_all,
};
