#include "config.h"
#include "terrain/ground.h"
#include "base/alloc.h"
#include "terrain/blank.h"
#include "terrain/cliff.h"
#include "terrain/complaint.h"
#include "terrain/crossing.h"
#include "terrain/detail.h"
#include "terrain/loose.h"
#include "terrain/missing.h"
#include "terrain/proof.h"
#include "terrain/rim.h"
#include "terrain/spots.h"

#include <math.h>
#include <stdio.h>

/* How often lines that let no ground stand are left out; what is left may show others. */
enum { ROUNDS = 8 };

void il_ground_free(il_ground *g)
{
    il_free(g->line);
    il_free(g->level_z);
    il_free(g->spot_out);
    il_free(g->spot_node);
    il_frame_free(&g->frame);
    il_chart_free(&g->chart);
    il_tin_free(&g->tin);
    il_free(g->border);
    il_bands_free(&g->bands);
    il_law_free(&g->law);
    il_skin_free(&g->skin);
    il_free(g->blank);
    g->blank = NULL;
    g->line = NULL;
    g->level_z = NULL;
    g->spot_out = NULL;
    g->spot_node = NULL;
    g->border = NULL;
}

static il_complaint complaint_of(const il_ground *g)
{
    return (il_complaint){ g->head, g->unit, g->slice, g->line, g->n_lines, g->report };
}

/* ---- lines -------------------------------------------------------------------- */

static il_status list_lines(il_ground *g, il_error *err)
{
    size_t n = 0;
    for (size_t k = 0; k < g->n_slices; k++)
        n += g->slice[k].n;
    g->line = il_alloc(n, sizeof *g->line);
    g->level_z = il_alloc(g->n_slices, sizeof *g->level_z);
    g->spot_out = il_calloc(g->head->n_spots, 1);
    g->spot_node = il_alloc(g->head->n_spots, sizeof *g->spot_node);
    if (!g->line || !g->level_z || !g->spot_out || !g->spot_node)
        return il_fail_nomem(err);
    for (size_t k = 0; k < g->n_slices; k++) {
        g->level_z[k] = g->slice[k].z;
        for (size_t i = 0; i < g->slice[k].n; i++)
            g->line[g->n_lines++] = (il_chart_line){ (int32_t)k, (int32_t)i, false };
    }
    return IL_OK;
}

static size_t count_left_out(const il_ground *g)
{
    size_t n = 0;
    for (size_t l = 0; l < g->n_lines; l++)
        n += g->line[l].left_out;
    return n;
}

/* Of few lines little ground can be made, and the user may not see that from what is written. */
static void tell_loose(const il_ground *g)
{
    size_t n = count_left_out(g);
    if (2 * n > g->n_lines)
        il_report_note(g->report, "%zu of %zu isolines end inside the map and are left out, so that little of it is left: "
                       "--join closes gaps, --frame hull or a file draws the edge nearer", n, g->n_lines);
}

static il_status leave_out_loose(il_ground *g, il_error *err)
{
    il_complaint c = complaint_of(g);
    il_status st = il_loose_leave_out(g->line, g->n_lines, g->slice, &g->frame, &c, err);
    if (st == IL_OK)
        tell_loose(g);
    return st;
}

/* A place of the mesh on the map. */
static void put_back(const il_ground *g, const double from[2], double to[2])
{
    const il_placement *p = &g->head->placement;
    for (int i = 0; i < 2; i++)
        to[i] = g->head->has_placement ? from[i] * p->scale[i] + p->offset[i] : from[i];
}

/* ---- faces and their bands ------------------------------------------------------ */

static void forget_chart(il_ground *g)
{
    il_chart_free(&g->chart);
    il_tin_free(&g->tin);
}

/* The chart as a planar graph, in triangles. */
static il_status triangulate(il_ground *g, il_error *err)
{
    bool crosses = false;
    il_tin_free(&g->tin);
    il_status st = il_tin_build(&g->tin, &g->chart, &crosses, err);
    if (st != IL_OK || !crosses)
        return st;
    st = il_chart_divide(&g->chart, g->options->placement.round_float, err);
    if (st == IL_OK)
        st = il_tin_build(&g->tin, &g->chart, &crosses, err);
    return st == IL_OK && crosses ? il_fail(err, IL_E_INTERNAL, 0, "a map's lines cross though they were divided") : st;
}

static il_status draw_chart(il_ground *g, il_error *err)
{
    forget_chart(g);
    g->chart.level_z = g->level_z;
    g->chart.n_levels = g->n_slices;
    il_status st = il_chart_build(&g->chart, g->slice, g->line, g->n_lines, &g->frame, g->head, &g->options->placement, err);
    if (st == IL_OK && !il_spots_add(&g->chart, g->head, &g->options->placement, g->spot_out, g->spot_node))
        st = il_fail_nomem(err);
    return st == IL_OK ? triangulate(g, err) : st;
}

static il_status label(il_ground *g, size_t n_lines, il_error *err)
{
    il_free(g->border);
    il_bands_free(&g->bands);
    size_t n_faces = 0;
    il_status st = il_tin_borders(&g->tin, &g->chart, &g->border, &g->n_borders, &n_faces, err);
    if (st == IL_OK)
        st = il_bands_label(&g->bands, g->border, g->n_borders, n_faces, n_lines, g->n_slices, g->options->high, err);
    if (st == IL_OK && g->tin.n_cliffs > 0)
        st = il_cliff_label(&g->tin, &g->chart, g->bands.band, err);
    il_free(g->blank);
    g->blank = NULL;
    g->n_blanks = 0;
    if (st == IL_OK && g->bands.n_left_out == 0)
        st = il_blank_leave_out(&g->tin, &g->chart, g->bands.band, &g->blank, &g->n_blanks, err);
    return st;
}

static void tell_discord(il_ground *g, const il_discord *d)
{
    il_complaint c = complaint_of(g);
    double at[2];
    put_back(g, d->at, at);
    if (d->kind == IL_DISCORD_SIDES)
        il_complaint_against(&c, d->line[0], at, d->is_below ? "both of its sides lie below it" : "both of its sides lie above it",
                             d->line[1]);
    else
        il_complaint_missing(&c, d->line[0], d->line[1], at, d->kind == IL_DISCORD_MANY);
}

/* Lines that are missing may be so at any number of places, and levels between others at one:
 * beyond these many sentences they are counted. */
enum { MISSING_TOLD = 20 };

static void tell_discords(il_ground *g)
{
    size_t n_missing = 0;
    for (size_t k = 0; k < g->bands.n_discords; k++) {
        const il_discord *d = &g->bands.discord[k];
        bool is_missing = d->kind != IL_DISCORD_SIDES;
        if (is_missing && g->bands.n_left_out > 0)
            continue; /* what is missing is seen when those that contradict are out */
        n_missing += is_missing;
        if (!is_missing || n_missing <= MISSING_TOLD)
            tell_discord(g, d);
    }
    if (n_missing > MISSING_TOLD)
        il_report_note(g->report, "%zu more pairs of isolines have others missing between them: interpolated", n_missing - MISSING_TOLD);
}

/* The bands of all faces; lines that contradict the others are left out, and what the rest
 * parts is looked at anew. */
static il_status find_bands(il_ground *g, il_error *err)
{
    il_status st = IL_OK;
    do {
        st = draw_chart(g, err);
        if (st == IL_OK)
            st = label(g, g->n_lines, err);
        if (st == IL_OK)
            tell_discords(g);
        for (size_t l = 0; l < g->n_lines && st == IL_OK && g->bands.n_left_out > 0; l++)
            g->line[l].left_out |= g->bands.left_out[l];
    } while (st == IL_OK && g->bands.n_left_out > 0);
    return st;
}

/* ---- heights --------------------------------------------------------------------- */

/* How much longer a unit of y is than one of x: of degrees, in the middle of the map. */
static double east_of(const il_ground *g)
{
    static const double DEGREE = 0.017453292519943295, LEAST = 0.01;
    return g->unit == IL_UNIT_DEG ? fmax(cos((g->frame.box[1] + g->frame.box[3]) / 2 * DEGREE), LEAST) : 1;
}

static il_status build_law(il_ground *g, il_error *err)
{
    il_law_free(&g->law);
    return il_law_build(&g->law, &g->tin, &g->chart, g->bands.band, east_of(g), err);
}

static il_status judge_spots(il_ground *g, il_error *err)
{
    il_complaint complaint = complaint_of(g);
    return il_spots_judge(&g->chart, &g->tin, g->bands.band, &complaint, g->spot_out, g->spot_node, err);
}

static il_status draw_missing(il_ground *g, il_error *err)
{
    size_t n = 0;
    il_status st = il_missing_draw(&g->chart, &g->tin, &g->law, g->n_lines, &g->options->placement, &n, err);
    if (st != IL_OK || n == 0)
        return st;
    il_report_repair(g->report, IL_REPAIR_MISSING_LINE, n);
    st = triangulate(g, err);
    if (st == IL_OK)
        st = label(g, g->n_lines + g->n_slices, err);
    if (st == IL_OK)
        st = judge_spots(g, err); /* dividing the chart anew may have led lines through some */
    return st == IL_OK ? build_law(g, err) : st;
}

static il_status find_heights(il_ground *g, il_error *err)
{
    il_status st = il_rim_raise(&g->chart) ? build_law(g, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = draw_missing(g, err);
    if (st == IL_OK)
        st = il_law_bend(&g->law, &g->tin, &g->options->law, err);
    if (st == IL_OK && g->options->law.kind != IL_LAW_STRAIGHT)
        il_rim_lower(&g->chart);
    if (st == IL_OK)
        st = il_detail_insert(&g->tin, &g->chart, &g->law, &g->options->placement,
                              g->options->has_detail ? g->options->detail : IL_DETAIL_USUAL, err);
    return st;
}

/* ---- the mesh -------------------------------------------------------------------- */

/* Is there any part of the frame whose height a line tells? */
static il_status require_ground(const il_ground *g, il_error *err)
{
    for (size_t k = 0; k < g->tin.n; k++)
        if (g->tin.face[k] != IL_CHART_NONE)
            return IL_OK;
    if (g->tin.n == 0)
        return il_fail(err, IL_E_INPUT, g->head->line, "the map has no extent left%s", g->options->placement.round_float
                       ? " in 32-bit floats: it is narrow, or far from the origin (--recentre)" : " when put to its size");
    if (count_left_out(g) == g->n_lines)
        return il_fail(err, IL_E_INPUT, g->head->line, "no isoline tells the height of the ground: all had to be left out, "
                       "as they end inside the map or contradict one another");
    return il_fail(err, IL_E_INPUT, g->head->line, "no line of the map lies inside the frame");
}

static il_status settle_heights(il_ground *g, il_error *err)
{
    double lowest = INFINITY, highest = -INFINITY, floor = 0;
    for (size_t k = 0; k < 3 * g->tin.n; k++) {
        if (g->tin.face[k / 3] == IL_CHART_NONE)
            continue;
        double z = il_cliff_z(&g->tin, &g->chart, g->bands.band, k);
        lowest = fmin(lowest, z);
        highest = fmax(highest, z);
    }
    il_status st = il_placement_settle(g->head, &g->options->placement, g->frame.box, lowest, highest, &floor, err);
    g->floor = g->options->placement.solid ? il_placement_height(g->head, &g->options->placement, floor) : NAN;
    return st;
}

static il_status make_mesh(il_ground *g, il_error *err)
{
    il_status st = require_ground(g, err);
    if (st == IL_OK)
        st = settle_heights(g, err);
    if (st == IL_OK)
        st = il_skin_lay(&g->skin, &g->tin, &g->chart, g->bands.band, g->head, &g->options->placement, err);
    if (st == IL_OK && g->options->placement.solid)
        st = il_skin_close(&g->skin, &g->tin, &g->chart, g->floor, err);
    return st == IL_OK ? il_skin_prove(&g->skin, &g->tin, &g->chart, g->head, &g->options->placement, g->floor, err) : st;
}

/* ---- lines that cannot all stay ------------------------------------------------------- */

static double *measure_lines(const il_ground *g)
{
    double *length = il_alloc(g->n_lines, sizeof *length);
    for (size_t l = 0; length && l < g->n_lines; l++)
        length[l] = il_ring_length(il_chart_ring(g->slice, g->line, l));
    return length;
}

/* longest[v]: of the lines through node V, where several levels meet, the longest. */
static void find_longest(const il_ground *g, const double *length, uint32_t *longest)
{
    const il_chart *c = &g->chart;
    for (size_t v = 0; v < c->n_nodes; v++)
        longest[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 2 * c->n_edges; k++) {
        uint32_t v = c->edge[k], l = c->owner[k / 2];
        if (c->node[v].level == c->node[v].top || l >= g->n_lines)
            continue;
        if (longest[v] == IL_CHART_NONE || length[l] > length[longest[v]])
            longest[v] = l;
    }
}

/* Lines that run together with others so that no ground can stand there: of those that meet,
 * the longest stays.  *ANY: were there some? */
static il_status leave_out_meeting(il_ground *g, bool *any, il_error *err)
{
    const il_chart *c = &g->chart;
    il_complaint complaint = complaint_of(g);
    double *length = measure_lines(g);
    uint32_t *longest = il_alloc(c->n_nodes, sizeof *longest);
    if (length && longest)
        find_longest(g, length, longest);
    for (size_t k = 0; length && longest && k < 2 * c->n_edges; k++) {
        uint32_t v = c->edge[k], l = c->owner[k / 2], other = longest[v];
        double at[2];
        if (other == IL_CHART_NONE || l >= g->n_lines || g->line[l].left_out || g->line[l].level == g->line[other].level)
            continue;
        put_back(g, c->xy + 2 * (size_t)v, at);
        g->line[l].left_out = *any = true;
        il_complaint_against(&complaint, l, at, "it meets another level", other);
    }
    bool ok = length && longest;
    il_free(length);
    il_free(longest);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* Lines that part nothing: that go and come back over the same places, or lead from the outer
 * side of the frame to a hole of it. */
static void leave_out_idle(il_ground *g, bool *any)
{
    const il_chart *c = &g->chart;
    il_complaint complaint = complaint_of(g);
    for (size_t e = 0; e < g->tin.n_sides; e++) {
        uint32_t l = c->owner[e], left = g->tin.side[2 * e], right = g->tin.side[2 * e + 1];
        bool is_fold = g->tin.cliff[2 * e] >= 0 && g->tin.cliff[2 * e] == g->tin.cliff[2 * e + 1];
        double at[2];
        if (l >= g->n_lines || g->line[l].left_out || !(is_fold || (left == right && left != IL_CHART_NONE)))
            continue;
        put_back(g, c->xy + 2 * (size_t)c->edge[2 * e], at);
        g->line[l].left_out = *any = true;
        il_complaint_left_out(&complaint, (uint32_t)l, at, "the ground on both of its sides is the same");
    }
}

/* From the lines that are not left out to a mesh that is proved. */
static il_status make_ground(il_ground *g, il_error *err)
{
    il_status st = find_bands(g, err);
    if (st == IL_OK)
        st = judge_spots(g, err);
    if (st == IL_OK)
        st = find_heights(g, err);
    return st == IL_OK ? make_mesh(g, err) : st;
}

/* No ground stands on the lines as they are, or nothing tells what is higher across a cliff:
 * without those that meet others it may. */
static il_status make_ground_apart(il_ground *g, il_error *err)
{
    const il_error why = *err;
    bool any = false;
    il_error_clear(err);
    il_status st = leave_out_meeting(g, &any, err);
    if (st != IL_OK)
        return st;
    if (!any)
        leave_out_idle(g, &any);
    if (any) {
        il_skin_free(&g->skin);
        return make_ground(g, err);
    }
    *err = why;
    return why.code;
}

static void tell_blanks(const il_ground *g)
{
    for (size_t k = 0; k < g->n_blanks; k++) {
        char place[IL_COMPLAINT_PLACE], why[IL_COMPLAINT_PLACE + 60];
        double at[2];
        put_back(g, g->blank + 2 * k, at);
        il_complaint_place(at, place);
        snprintf(why, sizeof why, "no isoline tells its height, %s; left out", place);
        il_report_skip(g->report, g->head->n_files > 0 ? g->head->file[0] : "-", 0, "a part of the frame", why);
    }
}

/* How much of the lines an outline cuts off. */
static il_status tell_outside(il_ground *g, il_error *err)
{
    size_t n = 0;
    unsigned char *there = il_calloc(g->chart.n_nodes, 1);
    if (!there)
        return il_fail_nomem(err);
    for (size_t v = 0; v < g->skin.n_vertices; v++)
        there[g->skin.node[v]] = 1;
    for (size_t v = 0; v < g->chart.n_nodes; v++)
        n += g->chart.node[v].vertex >= 0 && !there[v];
    il_free(there);
    if (n > 0)
        il_report_note(g->report, "%zu point%s of isolines lie%s outside the frame: left out", n, n == 1 ? "" : "s", n == 1 ? "s" : "");
    return IL_OK;
}

il_status il_ground_make(il_ground *g, il_error *err)
{
    g->unit = g->head->unit;
    g->floor = NAN;
    il_status st = list_lines(g, err);
    if (st == IL_OK && g->n_lines == 0)
        st = il_fail(err, IL_E_INPUT, g->head->line, "stack \"%.60s\" has no isolines", il_stack_head_name(g->head));
    if (st == IL_OK)
        st = il_frame_make(&g->frame, &g->options->frame, g->head, g->slice, g->n_slices, err);
    if (st == IL_OK)
        st = il_placement_choose(g->head, &g->options->placement, g->frame.box, err);
    if (g->frame.took_degrees)
        il_report_note(g->report, "the outline's numbers are taken as degrees: the map was in degrees there, and has no lines "
                       "where they would lie as lengths");
    if (st == IL_OK)
        st = leave_out_loose(g, err);
    if (st == IL_OK)
        st = make_ground(g, err);
    for (int round = 0; (st == IL_E_SURFACE || (st == IL_E_INPUT && g->tin.n_cliffs > 0)) && round < ROUNDS; round++)
        st = make_ground_apart(g, err);
    if (st == IL_OK)
        st = tell_outside(g, err);
    if (st == IL_OK)
        tell_blanks(g);
    if (st == IL_OK && g->skin.n_cliff > 0)
        il_report_note(g->report, "isolines of different heights run together: %zu triangles stand upright", g->skin.n_cliff);
    return st;
}
