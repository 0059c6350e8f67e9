#include "config.h"
#include "loft/emit.h"
#include "base/alloc.h"
#include "loft/cap.h"

#include <math.h>
#include <string.h>

void il_emitter_begin(il_emitter *e, il_mesh_sink *next, int32_t stack, bool flat_caps)
{
    memset(e, 0, sizeof *e);
    e->next = next;
    e->stack = stack;
    e->flat_caps = flat_caps;
}

void il_emitter_free(il_emitter *e)
{
    il_umbrellas_free(&e->lower);
    il_surface_free(&e->lid);
    il_census_free(&e->census);
}

/* One slab on its way out: the sections with their vertices' numbers in the
 * stack's mesh, and the piece that takes it. */
typedef struct passage {
    il_emitter *e;
    const il_window_place *low, *high;
    il_umbrellas *lower, upper;
    uint32_t lower_first, inner_first, upper_first;
    il_surface lid;           /* flat cap on the last section */
    il_mesh mesh;
} passage;

static bool add_section(passage *p, const il_window_place *place, const il_umbrellas *u)
{
    const il_section *s = &place->section;
    for (size_t v = 0; v < u->n_vertices; v++) {
        uint32_t node = u->node_of[v];
        double xyz[3] = { s->xy[2 * node], s->xy[2 * node + 1], s->z };
        il_origin from = { p->e->stack, place->slice, s->ring[node], s->vertex[node] };
        if (!il_mesh_add_vertex(&p->mesh, xyz, from))
            return false;
    }
    return true;
}

static bool add_inner(passage *p)
{
    const il_surface *s = &p->low->slab.surface;
    il_origin from = { p->e->stack, -1, -1, -1 };
    for (size_t i = 0; i < s->n_inner; i++)
        if (!il_mesh_add_vertex(&p->mesh, s->inner + 3 * i, from))
            return false;
    return true;
}

/* Vertex of corner C of the slab's surface in the stack's mesh. */
static uint32_t slab_vertex(const passage *p, size_t c)
{
    uint32_t code = p->low->slab.surface.tri[c], i = IL_CODE_INDEX(code);
    switch (IL_CODE_WHERE(code)) {
    case IL_LOWER: return p->lower_first + il_umbrellas_vertex(p->lower, 1, c, i);
    case IL_UPPER: return p->upper_first + il_umbrellas_vertex(&p->upper, 0, c, i);
    default:       return p->inner_first + i;
    }
}

static bool add_slab_triangles(passage *p)
{
    for (size_t t = 0; t < p->low->slab.surface.n_triangles; t++)
        if (!il_mesh_add_triangle(&p->mesh, slab_vertex(p, 3 * t), slab_vertex(p, 3 * t + 1), slab_vertex(p, 3 * t + 2)))
            return false;
    return true;
}

/* A lid lies below its section (collar 0) or above it (collar 1). */
static bool add_lid(passage *p, const il_surface *lid, const il_umbrellas *u, uint32_t first, int collar)
{
    for (size_t t = 0; t < lid->n_triangles; t++) {
        uint32_t v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = first + il_umbrellas_vertex(u, collar, 3 * t + k, IL_CODE_INDEX(lid->tri[3 * t + k]));
        if (!il_mesh_add_triangle(&p->mesh, v[0], v[1], v[2]))
            return false;
    }
    return true;
}

/* The lid's share of the volume about the origin, and its area. */
static void measure_lid(il_emitter *e, const il_surface *lid, const il_section *s, const double origin[3])
{
    for (size_t t = 0; t < lid->n_triangles; t++) {
        const double *a = s->xy + 2 * IL_CODE_INDEX(lid->tri[3 * t]), *b = s->xy + 2 * IL_CODE_INDEX(lid->tri[3 * t + 1]),
                     *c = s->xy + 2 * IL_CODE_INDEX(lid->tri[3 * t + 2]);
        double area2 = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        e->facts.volume += area2 * (s->z - origin[2]) / 6;
        e->facts.area += fabs(area2) / 2;
    }
}

/* Number the first section of the stack, under which only a lid may be. */
static il_status begin_stack(il_emitter *e, il_window *w, il_error *err)
{
    const il_window_place *low = il_window_at(w, 0);
    il_collar collar[2] = { { &e->lid, IL_UPPER }, { &low->slab.surface, IL_LOWER } };
    il_status st = e->flat_caps ? il_cap_flat(&e->lid, &low->section, IL_UPPER, err) : IL_OK;
    if (st == IL_OK)
        st = il_umbrellas_find(&e->lower, &low->section, collar, err);
    if (st == IL_OK)
        st = il_census_begin(&e->census, e->lower.n_vertices, err);
    if (st == IL_OK) {
        e->n_vertices = (uint32_t)e->lower.n_vertices;
        e->facts.pinches += e->lower.n_pinches;
        measure_lid(e, &e->lid, &low->section, w->origin);
    }
    return st;
}

/* Number the section above the slab; what lies on it is the next slab or a lid. */
static il_status number_upper(passage *p, il_window *w, bool is_last, il_error *err)
{
    il_collar collar[2] = { { &p->low->slab.surface, IL_UPPER }, { &p->high->slab.surface, IL_LOWER } };
    il_status st = IL_OK;
    if (is_last) {
        collar[1].surface = &p->lid;
        st = p->e->flat_caps ? il_cap_flat(&p->lid, &p->high->section, IL_LOWER, err) : IL_OK;
    }
    if (st == IL_OK)
        st = il_umbrellas_find(&p->upper, &p->high->section, collar, err);
    if (st == IL_OK && is_last)
        measure_lid(p->e, &p->lid, &p->high->section, w->origin);
    return st;
}

static bool fill_mesh(passage *p, bool is_first)
{
    return (!is_first || add_section(p, p->low, p->lower)) && add_inner(p) && add_section(p, p->high, &p->upper) &&
           (!is_first || add_lid(p, &p->e->lid, p->lower, p->lower_first, 0)) && add_slab_triangles(p) &&
           add_lid(p, &p->lid, &p->upper, p->upper_first, 1);
}

/* Local numbers for the census: lower section, inner points, upper section. */
static il_status count(passage *p, il_error *err)
{
    il_mesh *m = &p->mesh;
    uint32_t *tri = il_alloc(m->n_triangles, 3 * sizeof *tri);
    if (!tri)
        return il_fail_nomem(err);
    for (size_t i = 0; i < 3 * m->n_triangles; i++)
        tri[i] = m->tri[i] < p->inner_first ? m->tri[i] - p->lower_first
                                            : m->tri[i] - p->inner_first + (uint32_t)p->lower->n_vertices;
    il_status st = il_census_add(&p->e->census, tri, m->n_triangles, p->low->slab.surface.n_inner, p->upper.n_vertices, err);
    il_free(tri);
    return st;
}

static void account(passage *p)
{
    il_mesh_facts *f = &p->e->facts;
    for (int k = 0; k < IL_N_ATTEMPTS; k++)
        f->length_by[k] += p->low->slab.length_by[k];
    f->length_alone += p->low->slab.length_alone;
    f->volume += p->low->volume;
    f->area += p->low->area;
    f->pinches += p->low->n_split + p->upper.n_pinches;
    f->between += p->low->bending.contours;
    f->slabs_halved += p->low->bending.halved;
    f->slabs_straight += p->low->bending.straight;
}

il_status il_emitter_slab(il_emitter *e, il_window *w, il_error *err)
{
    size_t first = w->first;
    bool is_first = first == 0, is_last = !il_window_has_slab(w, first + 1);
    passage p = { e, il_window_at(w, first), il_window_at(w, first + 1), &e->lower, IL_UMBRELLAS_INIT, 0, 0, 0,
                  IL_SURFACE_INIT, IL_MESH_INIT };
    il_status st = is_first ? begin_stack(e, w, err) : IL_OK;
    if (st == IL_OK)
        st = number_upper(&p, w, is_last, err);
    uint64_t total = (uint64_t)e->n_vertices + p.low->slab.surface.n_inner + p.upper.n_vertices;
    if (st == IL_OK && total >= UINT32_MAX)
        st = il_fail(err, IL_E_INPUT, 0, "more than %u vertices in one mesh", UINT32_MAX);
    if (st == IL_OK) {
        p.lower_first = e->lower_first;
        p.inner_first = e->n_vertices;
        p.upper_first = e->n_vertices + (uint32_t)p.low->slab.surface.n_inner;
        p.mesh.slab = p.low->slice;
        st = fill_mesh(&p, is_first) ? count(&p, err) : il_fail_nomem(err);
    }
    if (st == IL_OK) {
        account(&p);
        st = e->next->piece(e->next, &p.mesh, err);
    }
    if (st == IL_OK) {
        e->n_vertices = (uint32_t)total;
        e->lower_first = p.upper_first;
        il_umbrellas_free(&e->lower);
        e->lower = p.upper;
        p.upper = (il_umbrellas)IL_UMBRELLAS_INIT;
    }
    il_umbrellas_free(&p.upper);
    il_surface_free(&p.lid);
    il_mesh_free(&p.mesh);
    return st;
}

void il_emitter_end(il_emitter *e)
{
    e->facts.vertices = (size_t)e->census.vertices;
    e->facts.triangles = (size_t)e->census.triangles;
    il_census_result(&e->census, &e->facts.components, &e->facts.genus);
}
