/* geojson-coordinates.c - nested arrays of numbers as points, lines and rings.
 *
 * How deep the arrays are nested tells positions, lists of them and the rest apart;
 * only whether a list is a line, a ring or points by themselves is the type's to say.
 * So coordinates that come before the type are read the same way, and kept. */
#include "config.h"
#include "input/geojson.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* In how many arrays a number of a geometry stands, and what its lists are. */
static const struct { size_t depth; il_map_part kind; } shape[IL_GEOJSON_N_TYPES] = {
    [IL_GEOJSON_POINT] = { 1, IL_MAP_POINT },
    [IL_GEOJSON_MULTI_POINT] = { 2, IL_MAP_POINT },
    [IL_GEOJSON_LINE_STRING] = { 2, IL_MAP_LINE },
    [IL_GEOJSON_MULTI_LINE_STRING] = { 3, IL_MAP_LINE },
    [IL_GEOJSON_POLYGON] = { 3, IL_MAP_RING },
    [IL_GEOJSON_MULTI_POLYGON] = { 4, IL_MAP_RING },
};
enum { DEEPEST = 4 };

/* level: arrays open.  depth: of positions, 0 while it is not known.  in_list: in a
 * list that has positions.  fresh: nothing stood in the array opened last.
 * line, line_around: where it begins, and the one opened before it. */
typedef struct walk {
    il_geojson *g;
    il_geojson_type type;
    size_t level, depth;
    bool in_list, fresh;
    long line, line_around;
} walk;

static il_status fail(const walk *w, long line, const char *words)
{
    const char *type = il_geojson_type_name[w->type];
    return il_fail(w->g->err, IL_E_INPUT, line, "the coordinates%s%s %s", *type ? " of a " : "", type, words);
}

/* ---- lists ------------------------------------------------------------------- */

static il_status begin_list(walk *w, long line)
{
    il_geojson *g = w->g;
    w->in_list = true;
    if (w->type != IL_GEOJSON_NONE)
        return shape[w->type].kind == IL_MAP_POINT ? IL_OK : il_map_begin_part(g->set, shape[w->type].kind, line, g->err);
    if (!il_grow(&g->part, &g->cap_parts, g->n_parts + 1, sizeof *g->part))
        return il_fail_nomem(g->err);
    g->part[g->n_parts++] = (il_geojson_part){ g->n, line };
    return IL_OK;
}

static il_status put_single(il_geojson *g, const il_geojson_point *p)
{
    il_status st = il_map_begin_part(g->set, IL_MAP_POINT, p->line, g->err);
    if (st == IL_OK)
        st = il_map_point(g->set, p->x, p->y, p->z, p->line, g->err);
    return st == IL_OK ? il_map_end_part(g->set, g->err) : st;
}

static il_status put_position(walk *w, const il_geojson_point *p)
{
    il_geojson *g = w->g;
    if (w->type != IL_GEOJSON_NONE && shape[w->type].kind == IL_MAP_POINT)
        return put_single(g, p);
    if (w->type != IL_GEOJSON_NONE)
        return il_map_point(g->set, p->x, p->y, p->z, p->line, g->err);
    if (g->n == g->cap && !il_grow(&g->point, &g->cap, g->n + 1, sizeof *g->point))
        return il_fail_nomem(g->err);
    g->point[g->n++] = *p;
    return IL_OK;
}

static il_status end_list(walk *w)
{
    il_geojson *g = w->g;
    w->in_list = false;
    if (w->type != IL_GEOJSON_NONE)
        return shape[w->type].kind == IL_MAP_POINT ? IL_OK : il_map_end_part(g->set, g->err);
    g->part[g->n_parts - 1].end = g->n;
    return IL_OK;
}

/* ---- positions ---------------------------------------------------------------- */

/* EVENT stands where a number belongs. */
static il_status fail_number(const walk *w, il_json_event event)
{
    const il_json_scan *j = &w->g->json;
    int n = (int)(j->n < 40 ? j->n : 40);
    if (event == IL_JSON_NUMBER)
        return il_fail(w->g->err, IL_E_INPUT, j->line, "the coordinate %.*s is no finite number", n, j->text);
    if (event == IL_JSON_STRING)
        return il_fail(w->g->err, IL_E_INPUT, j->line, "the coordinate \"%.*s\" is a string, not a number", n, j->text);
    return fail(w, j->line, event == IL_JSON_NULL ? "hold a null in place of a number" : "hold something that is no number");
}

/* Number K of a position, which EVENT is.  A z that is null or NaN is none. */
static il_status take_number(walk *w, il_json_event event, size_t k, double to[3])
{
    const il_geojson *g = w->g;
    if (event == IL_JSON_NUMBER && (k > 2 || il_json_scan_value(&g->json, &to[k])))
        return IL_OK;
    bool is_none = event == IL_JSON_NULL || (event == IL_JSON_NUMBER && il_geojson_is(g, "NaN"));
    return k >= 2 && is_none ? IL_OK : fail_number(w, event);
}

static void tell_of_more(il_geojson *g)
{
    if (!g->told_more)
        il_report_note(il_map_report(g->set), "%.200s: positions of more than three numbers; those behind the third are passed over",
                       il_map_file(g->set));
    g->told_more = true;
}

/* The position whose first number EVENT is, to the end of its array. */
static il_status take_position(walk *w, il_json_event event)
{
    il_geojson *g = w->g;
    double v[3] = { 0, 0, NAN };
    long line = g->json.line;
    size_t k = 0;
    il_status st = w->in_list || w->depth == 1 ? IL_OK : begin_list(w, w->line_around);
    for (; st == IL_OK && event != IL_JSON_ARRAY_END; k++) {
        st = take_number(w, event, k, v);
        if (st == IL_OK)
            st = il_geojson_next(g, &event);
    }
    if (st != IL_OK)
        return st;
    if (k < 2)
        return fail(w, line, "have a position of one number");
    if (k > 3)
        tell_of_more(g);
    w->level--;
    return put_position(w, &(il_geojson_point){ v[0], v[1], v[2], line });
}

/* ---- arrays -------------------------------------------------------------------- */

static il_status open_array(walk *w)
{
    w->level++;
    w->line_around = w->line;
    w->line = w->g->json.line;
    w->fresh = true;
    return w->level <= (w->depth ? w->depth : DEEPEST) ? IL_OK : fail(w, w->line, "are nested too deep");
}

/* The first number of an array that is a position then. */
static il_status take_first(walk *w, il_json_event event)
{
    if (event != IL_JSON_NUMBER)
        return fail_number(w, event);
    if (w->depth == 0)
        w->depth = w->level;
    if (w->level != w->depth || !w->fresh)
        return fail(w, w->g->json.line, "are not nested deep enough");
    w->fresh = false;
    return take_position(w, event);
}

/* Nothing stands at LEVEL, where it begins in LINE. */
static il_status leave_out_empty(walk *w, size_t level, long line)
{
    static const char *const what[] = { "polygon", "line" };
    il_geojson *g = w->g;
    bool is_part = w->type != IL_GEOJSON_NONE && level > 1;
    if (level > g->deepest_empty) {
        g->deepest_empty = level;
        g->empty_line = line;
    }
    if (w->depth > 1 && level == w->depth)
        return fail(w, line, "have a position without numbers");
    il_map_skip(g->set, line, is_part ? what[level == w->depth - 1] : "geometry", "has no coordinates");
    return IL_OK;
}

static il_status close_array(walk *w)
{
    size_t level = w->level--;
    bool fresh = w->fresh;
    w->fresh = false;
    if (fresh)
        return leave_out_empty(w, level, w->line);
    return w->in_list && level + 1 == w->depth ? end_list(w) : IL_OK;
}

static il_status take(walk *w, il_json_event event)
{
    switch (event) {
    case IL_JSON_ARRAY:     return open_array(w);
    case IL_JSON_ARRAY_END: return close_array(w);
    default:                return take_first(w, event);
    }
}

il_status il_geojson_coordinates(il_geojson *g, il_geojson_type type)
{
    walk w = { .g = g, .type = type, .depth = shape[type].depth };
    il_json_event event;
    il_status st = il_geojson_next(g, &event);
    g->n = g->n_parts = g->deepest_empty = 0;
    if (st == IL_OK && event == IL_JSON_NULL) {
        il_map_skip(g->set, g->json.line, "geometry", "has no coordinates");
        return IL_OK;
    }
    if (st == IL_OK && event != IL_JSON_ARRAY)
        return fail(&w, g->json.line, "are no array");
    while (st == IL_OK && (st = take(&w, event)) == IL_OK && w.level > 0)
        st = il_geojson_next(g, &event);
    g->depth = w.depth;
    return st;
}

/* ---- the type, behind them ------------------------------------------------------- */

static il_status check_depth(il_geojson *g, const walk *w)
{
    const il_geojson_point *first = g->n > 0 ? g->point : NULL;
    if (first && g->depth != w->depth)
        return fail(w, first->line, g->depth < w->depth ? "are not nested deep enough" : "are nested too deep");
    if (g->deepest_empty > w->depth)
        return fail(w, g->empty_line, "are nested too deep");
    if (w->depth > 1 && g->deepest_empty == w->depth)
        return fail(w, g->empty_line, "have a position without numbers");
    return IL_OK;
}

il_status il_geojson_coordinates_settle(il_geojson *g, il_geojson_type type)
{
    walk w = { .g = g, .type = type, .depth = shape[type].depth };
    il_status st = check_depth(g, &w);
    size_t n_lists = w.depth == 1 ? 0 : g->n_parts, i = 0;
    for (; w.depth == 1 && i < g->n && st == IL_OK; i++)
        st = put_position(&w, &g->point[i]);
    for (size_t k = 0; k < n_lists && st == IL_OK; k++) {
        st = begin_list(&w, g->part[k].line);
        for (; i < g->part[k].end && st == IL_OK; i++)
            st = put_position(&w, &g->point[i]);
        if (st == IL_OK)
            st = end_list(&w);
    }
    g->n = g->n_parts = 0;
    return st;
}
