/* check-mesh.c - is a mesh closed, manifold, oriented, and free of crossings? */
#include "config.h"
#include "cli/check.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/summary.h"
#include "cli/table.h"
#include "input/mesh-file.h"
#include "model/audit.h"

#include <stdio.h>

typedef struct finding {
    const char *name;
    il_mesh_file_facts facts;
    il_audit audit;
    double seconds;
} finding;

static const char *yes_or_no(bool yes)
{
    return yes ? "yes" : "no";
}

/* "no, 3 edges of one triangle" */
static void verdict_row(il_output *out, const char *key, bool good, size_t n, const char *what)
{
    if (good || n == 0)
        il_table_row(out, key, "%s", yes_or_no(good));
    else
        il_table_row(out, key, "no, %zu %s", n, what);
}

static void write_text(const void *self, il_output *out)
{
    const finding *f = self;
    const il_audit *a = &f->audit;
    il_table_heading(out, "%s: %s, %s", f->name, f->facts.format, il_audit_is_sound(a) ? "sound" : "not sound");
    il_table_row(out, "triangles", "%zu", a->triangles);
    il_table_row(out, "vertices", "%zu", a->vertices - a->loose_vertices);
    if (a->loose_vertices > 0)
        il_table_row(out, "loose", "%zu vertices of no triangle", a->loose_vertices);
    if (f->facts.polygons > 0)
        il_table_row(out, "polygons", "%zu faces of more than three corners, taken as fans", f->facts.polygons);
    verdict_row(out, "closed", a->closed, a->boundary_edges, "edges of one triangle only");
    verdict_row(out, "manifold", a->manifold, a->nonmanifold_edges + a->nonmanifold_vertices,
                "edges of more than two triangles, or vertices of several fans");
    verdict_row(out, "oriented", a->oriented, a->inconsistent_edges, "edges that both sides run along alike");
    il_table_row(out, "outward", "%s", yes_or_no(a->outward));
    if (a->self_intersections > 0)
        il_table_row(out, "crossings", "%s%zu pairs of triangles, the first are %lu and %lu",
                     a->more_intersections ? "more than " : "", a->self_intersections,
                     (unsigned long)a->first_intersection[0], (unsigned long)a->first_intersection[1]);
    else
        il_table_row(out, "crossings", "none");
    if (a->degenerate_triangles > 0)
        il_table_row(out, "degenerate", "%zu triangles without area", a->degenerate_triangles);
    if (a->duplicate_triangles > 0)
        il_table_row(out, "duplicate", "%zu triangles", a->duplicate_triangles);
    if (a->has_genus)
        il_table_row(out, "components", "%zu, genus %ld", a->components, a->genus);
    else
        il_table_row(out, "components", "%zu", a->components);
    il_table_row(out, "size", "%.6g x %.6g x %.6g", a->hi[0] - a->lo[0], a->hi[1] - a->lo[1], a->hi[2] - a->lo[2]);
    il_table_row(out, "area", "%.6g", a->area);
    il_table_row(out, "volume", "%.6g", a->volume);
}

static void write_json(const void *self, il_output *out)
{
    const finding *f = self;
    const il_audit *a = &f->audit;
    const struct { const char *key; bool value; } verdicts[] = {
        { "sound", il_audit_is_sound(a) }, { "closed", a->closed }, { "manifold", a->manifold },
        { "oriented", a->oriented }, { "outward", a->outward } };
    const struct { const char *key; size_t value; } counts[] = {
        { "vertices", a->vertices }, { "triangles", a->triangles }, { "loose_vertices", a->loose_vertices },
        { "boundary_edges", a->boundary_edges }, { "nonmanifold_edges", a->nonmanifold_edges },
        { "nonmanifold_vertices", a->nonmanifold_vertices }, { "inconsistent_edges", a->inconsistent_edges },
        { "degenerate_triangles", a->degenerate_triangles }, { "duplicate_triangles", a->duplicate_triangles },
        { "self_intersections", a->self_intersections }, { "components", a->components } };
    il_json j = { out, false };
    il_json_open(&j, '{');
    il_json_key(&j, "file");
    il_json_string(&j, f->name);
    il_json_key(&j, "format");
    il_json_string(&j, f->facts.format);
    for (size_t k = 0; k < sizeof verdicts / sizeof *verdicts; k++) {
        il_json_key(&j, verdicts[k].key);
        il_json_bool(&j, verdicts[k].value);
    }
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        il_json_key(&j, counts[k].key);
        il_json_integer(&j, (long long)counts[k].value);
    }
    il_json_key(&j, "genus");
    a->has_genus ? il_json_integer(&j, a->genus) : il_json_null(&j);
    il_json_key(&j, "volume");
    il_json_number(&j, a->volume);
    il_json_key(&j, "area");
    il_json_number(&j, a->area);
    il_summary_json_cost(&j, f->seconds);
    il_json_close(&j, '}');
    il_output_char(out, '\n');
}

il_status il_check_mesh(il_source *source, const il_options *o, il_voice *v, il_error *err)
{
    finding f = { .name = il_source_name(source), .facts = IL_MESH_FILE_FACTS_INIT };
    il_mesh mesh = IL_MESH_INIT;
    double start = il_clock_seconds();
    il_status st = il_mesh_file_read(source, &mesh, &f.facts, err);
    if (st == IL_OK)
        st = il_mesh_audit(&mesh, &f.audit, err);
    il_mesh_free(&mesh);
    f.seconds = il_clock_seconds() - start;
    if (st == IL_OK)
        st = il_check_print(o, write_text, write_json, &f, v, err);
    return st == IL_OK && !il_audit_is_sound(&f.audit) ? IL_E_UNSOUND : st;
}
