#include "config.h"
#include "cli/summary-terrain.h"
#include "base/number.h"
#include "base/text.h"
#include "cli/table.h"

#include <math.h>
#include <string.h>

/* ---- for people ------------------------------------------------------------------ */

/* Map coordinates have up to this many digits that matter: 10 000 km to the mm. */
#define COORDINATE "%.10g"

/* From here on, metres are told in kilometres, and square metres likewise. */
static const double FAR = 10000, WIDE = 1e6;

static void crs_row(il_output *out, const il_terrain *t)
{
    char shown[200];
    if (!t->crs)
        return;
    il_text_printable(shown, sizeof shown, t->crs, strlen(t->crs));
    il_table_row(out, "crs", "%s", shown);
}

static void level_rows(il_output *out, const il_stack_account *s)
{
    const il_terrain *t = &s->terrain;
    const char *unit = il_unit_name(il_terrain_unit_of_z(s->unit));
    if (t->n == 0)
        il_table_row(out, "levels", "none");
    else
        il_table_row(out, "levels", "%zu, from " COORDINATE " to " COORDINATE " %s", t->n, t->level[0].z, t->level[t->n - 1].z, unit);
    if (t->interval > 0)
        il_table_row(out, "interval", COORDINATE " %s", t->interval, unit);
    else if (t->n > 1)
        il_table_row(out, "interval", "uneven: usually " COORDINATE " %s, least " COORDINATE ", largest " COORDINATE,
                     s->spacing.usual, unit, s->spacing.least, s->spacing.largest);
    if (t->n_missing > 0)
        il_table_row(out, "missing", "%zu level%s", t->n_missing, t->n_missing == 1 ? "" : "s");
}

static void extent_row(il_output *out, const il_stack_account *s)
{
    const double *b = s->box;
    double width = b[3] - b[0], height = b[4] - b[1];
    bool far = s->unit == IL_UNIT_M && fmax(width, height) >= FAR;
    if (!(b[0] <= b[3]))
        return;
    il_table_row(out, "extent", "x " COORDINATE " to " COORDINATE ", y " COORDINATE " to " COORDINATE " %s", b[0], b[3], b[1], b[4],
                 il_unit_name(s->unit));
    il_table_row(out, "size", "%.6g x %.6g %s", far ? width / 1000 : width, far ? height / 1000 : height,
                 far ? "km" : il_unit_name(s->unit));
}

static void degrees_row(il_output *out, const il_terrain *t)
{
    const double *g = t->geographic;
    if (t->has_geographic)
        il_table_row(out, "degrees", "longitude %.9g to %.9g, latitude %.9g to %.9g", g[0], g[2], g[1], g[3]);
}

static void measure_rows(il_output *out, const il_stack_account *s, const il_terrain_level *sum)
{
    const il_terrain *t = &s->terrain;
    const char *unit = il_unit_name(t->on_ellipsoid ? IL_UNIT_M : s->unit), *where = t->on_ellipsoid ? ", on the ellipsoid" : "";
    bool metres = strcmp(unit, "m") == 0;
    if (!t->has_measures)
        return;
    if (metres && sum->length >= FAR)
        il_table_row(out, "length", "%.6g km%s", sum->length / 1000, where);
    else
        il_table_row(out, "length", "%.6g %s%s", sum->length, unit, where);
    if (sum->closed == 0)
        return;
    if (metres && sum->area >= WIDE)
        il_table_row(out, "area", "%.6g km^2 in closed lines%s", sum->area / 1e6, where);
    else
        il_table_row(out, "area", "%.6g %s^2 in closed lines%s", sum->area, unit, where);
}

static void end_row(il_output *out, const il_terrain *t)
{
    if (t->n_ends > 0)
        il_table_row(out, "open ends", "%zu, %zu of them inside the map", t->n_ends, t->n_inside);
}

void il_summary_terrain_rows(const il_stack_account *s, il_output *out)
{
    il_terrain_level sum = il_terrain_sum(&s->terrain);
    il_table_row(out, "kind", "terrain");
    crs_row(out, &s->terrain);
    level_rows(out, s);
    il_table_row(out, "lines", "%zu: %zu open, %zu closed", sum.open + sum.closed, sum.open, sum.closed);
    end_row(out, &s->terrain);
    il_table_row(out, "points", "%zu", sum.points);
    if (s->terrain.n_spots > 0)
        il_table_row(out, "spot heights", "%zu", s->terrain.n_spots);
    extent_row(out, s);
    degrees_row(out, &s->terrain);
    measure_rows(out, s, &sum);
}

static const char *const frames[] = { [IL_FRAME_BBOX] = "bbox", [IL_FRAME_HULL] = "hull", [IL_FRAME_OUTLINE] = "outline" };

static void numbers_text(char *to, size_t size, const double v[3])
{
    *to = '\0';
    for (int k = 0; k < 3; k++) {
        char number[IL_NUMBER_MAX];
        il_number_format(number, v[k]);
        il_text_append(to, size, k > 0 ? " %s" : "%s", number);
    }
}

typedef struct placement_text { char offset[3 * IL_NUMBER_MAX], scale[3 * IL_NUMBER_MAX]; } placement_text;

/* False where the mesh lies on the map as it is. */
static bool describe_placement(const il_stack_account *s, placement_text *t)
{
    numbers_text(t->offset, sizeof t->offset, s->placement.offset);
    numbers_text(t->scale, sizeof t->scale, s->placement.scale);
    return s->mesh_unit != s->placement.unit || strcmp(t->offset, "0 0 0") != 0 || strcmp(t->scale, "1 1 1") != 0;
}

static const char way_back[] = "a vertex times scale plus offset is its place on the map";

static void placement_rows(const il_stack_account *s, il_output *out)
{
    placement_text t;
    if (!describe_placement(s, &t))
        return;
    il_table_row(out, "offset", "%s %s", t.offset, il_unit_name(s->placement.unit));
    il_table_row(out, "scale", "%s; %s", t.scale, way_back);
}

void il_summary_say_placement(const il_stack_account *s, const char *label, il_voice *v)
{
    placement_text t;
    if (describe_placement(s, &t))
        il_message_detail(v, "%s: offset %s, scale %s: %s, in %s", label, t.offset, t.scale, way_back,
                          il_unit_name(s->placement.unit));
}

static const char *const laws[] = { [IL_LAW_MEAN] = "mean", [IL_LAW_PLATE] = "plate", [IL_LAW_STRAIGHT] = "straight" };

void il_summary_say_heights(const il_stack_account *s, const char *label, il_voice *v)
{
    const il_mesh_facts *f = &s->facts;
    if (s->has_mesh && f->step > 0)
        il_message_detail(v, "%s: heights by a plate on a grid of %.3g %s, spread %.3g", label, f->step,
                          il_unit_name(s->mesh_unit), f->spread);
}

void il_summary_surface_rows(const il_stack_account *s, il_output *out)
{
    const il_mesh_facts *f = &s->facts;
    const char *unit = il_unit_name(s->mesh_unit);
    if (!s->has_mesh) {
        il_table_row(out, "surface", "%s", s->error ? s->error : "none");
        return;
    }
    il_table_row(out, "surface", "certified, %s; %zu vertices, %zu triangles", f->is_open ? "open at the frame" : "a solid",
                 f->vertices, f->triangles);
    il_table_row(out, "frame", "%s, %zu face%s", frames[s->frame], f->faces, f->faces == 1 ? "" : "s");
    if (f->is_open)
        il_table_row(out, "components", "%ld", f->components);
    else
        il_table_row(out, "components", "%ld, genus %ld", f->components, f->genus);
    placement_rows(s, out);
    if (f->pinches > 0)
        il_table_row(out, "pinches", "%zu, where the frame touches itself", f->pinches);
    il_table_row(out, "mesh area", "%.6g %s^2", f->area, unit);
    if (!f->is_open)
        il_table_row(out, "volume", "%.6g %s^3", f->volume, unit);
}

/* ---- for programs ------------------------------------------------------------------ */

static void put_count(il_json *j, const char *key, size_t n)
{
    il_json_key(j, key);
    il_json_integer(j, (long long)n);
}

/* Null unless KNOWN. */
static void put_number(il_json *j, const char *key, double value, bool known)
{
    il_json_key(j, key);
    known ? il_json_number(j, value) : il_json_null(j);
}

static void put_numbers(il_json *j, const char *key, const double *value, int n, bool known)
{
    il_json_key(j, key);
    if (!known) {
        il_json_null(j);
        return;
    }
    il_json_open(j, '[');
    for (int k = 0; k < n; k++)
        il_json_number(j, value[k]);
    il_json_close(j, ']');
}

static void put_level(il_json *j, const il_terrain_level *l, bool has_measures)
{
    il_json_open(j, '{');
    put_number(j, "z", l->z, true);
    put_count(j, "open", l->open);
    put_count(j, "closed", l->closed);
    put_count(j, "points", l->points);
    put_number(j, "length", l->length, has_measures);
    put_number(j, "area", l->area, has_measures);
    il_json_close(j, '}');
}

/* Null where no mesh was made. */
static void put_surface(const il_stack_account *s, il_json *j)
{
    il_json_key(j, "surface");
    if (!s->has_mesh) {
        il_json_null(j);
        return;
    }
    il_json_open(j, '{');
    il_json_key(j, "solid");
    il_json_bool(j, !s->facts.is_open);
    il_json_key(j, "frame");
    il_json_string(j, frames[s->frame]);
    put_count(j, "faces", s->facts.faces);
    il_json_key(j, "law");
    il_json_string(j, laws[s->law]);
    put_number(j, "step", s->facts.step, s->facts.step > 0);
    put_number(j, "spread", s->facts.spread, s->facts.step > 0);
    il_json_key(j, "unit");
    il_json_string(j, il_unit_name(s->mesh_unit));
    put_numbers(j, "offset", s->placement.offset, 3, true);
    put_numbers(j, "scale", s->placement.scale, 3, true);
    il_json_close(j, '}');
}

void il_summary_terrain_json(const il_stack_account *s, il_json *j)
{
    const il_terrain *t = &s->terrain;
    const double extent[4] = { s->box[0], s->box[1], s->box[3], s->box[4] };
    il_terrain_level sum = il_terrain_sum(t);
    il_json_key(j, "kind");
    il_json_string(j, "terrain");
    il_json_key(j, "crs");
    il_json_string(j, t->crs);
    put_numbers(j, "geographic", t->geographic, 4, t->has_geographic);
    put_numbers(j, "extent", extent, 4, s->points > 0);
    put_number(j, "interval", t->interval, t->interval > 0);
    put_count(j, "missing_levels", t->n_missing);
    put_count(j, "open", sum.open);
    put_count(j, "closed", sum.closed);
    put_count(j, "ends_inside", t->n_inside);
    put_count(j, "spots", t->n_spots);
    il_json_key(j, "measured_on");
    il_json_string(j, t->on_ellipsoid ? "ellipsoid" : t->has_measures ? "plane" : NULL);
    put_number(j, "length", sum.length, t->has_measures);
    put_number(j, "enclosed_area", sum.area, t->has_measures);
    put_surface(s, j);
    il_json_key(j, "levels");
    il_json_open(j, '[');
    for (size_t k = 0; k < t->n; k++)
        put_level(j, &t->level[k], t->has_measures);
    il_json_close(j, ']');
}
