/* mesh-spool-read.c - records back out of the spools, for the formats. */
#include "config.h"
#include "output/mesh-spool.h"
#include "base/alloc.h"
#include "output/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_RECORDS = 512, PAGE_VERTICES = 1024, PAGES = 128 };

/* ---- in order ------------------------------------------------------------- */

static size_t block_size(uint64_t left)
{
    return left < BLOCK_RECORDS ? (size_t)left : BLOCK_RECORDS;
}

il_status il_mesh_spool_each_vertex(il_mesh_spool *m, size_t k, void *self,
                                    il_status (*each)(void *self, const il_spooled_vertex *v, il_error *err),
                                    il_error *err)
{
    il_spooled_vertex block[BLOCK_RECORDS];
    il_status st = IL_OK;
    uint64_t at = m->stack[k].first_vertex, end = at + m->stack[k].n_vertices;
    while (at < end && st == IL_OK) {
        size_t n = block_size(end - at);
        st = il_output_read_back(m->vertices, at * sizeof *block, block, n * sizeof *block, err);
        for (size_t i = 0; i < n && st == IL_OK; i++)
            st = each(self, &block[i], err);
        if (st == IL_OK)
            st = il_output_status(m->to, err);
        at += n;
    }
    return st;
}

il_status il_mesh_spool_each_triangle(il_mesh_spool *m, size_t k, void *self,
                                      il_status (*each)(void *self, const il_spooled_triangle *t, il_error *err),
                                      il_error *err)
{
    il_spooled_triangle block[BLOCK_RECORDS];
    il_status st = IL_OK;
    uint64_t at = m->stack[k].first_triangle, end = at + m->stack[k].n_triangles;
    while (at < end && st == IL_OK) {
        size_t n = block_size(end - at);
        st = il_output_read_back(m->triangles, at * sizeof *block, block, n * sizeof *block, err);
        for (size_t i = 0; i < n && st == IL_OK; i++)
            st = each(self, &block[i], err);
        if (st == IL_OK)
            st = il_output_status(m->to, err);
        at += n;
    }
    return st;
}

/* ---- in any order --------------------------------------------------------- */

/* Page P of the file can only lie in slot P modulo PAGES. */
struct il_vertex_page {
    uint64_t first_after;       /* first vertex + 1; 0: nothing here */
    double xyz[3 * PAGE_VERTICES];
};

static il_status load_page(il_mesh_spool *m, struct il_vertex_page *page, uint64_t first, il_error *err)
{
    il_spooled_vertex block[BLOCK_RECORDS];
    uint64_t end = il_mesh_spool_n_vertices(m);
    end = end - first < PAGE_VERTICES ? end : first + PAGE_VERTICES;
    page->first_after = 0;
    for (uint64_t at = first; at < end;) {
        size_t n = block_size(end - at);
        il_status st = il_output_read_back(m->vertices, at * sizeof *block, block, n * sizeof *block, err);
        if (st != IL_OK)
            return st;
        for (size_t i = 0; i < n; i++)
            memcpy(page->xyz + 3 * (at - first + i), block[i].xyz, sizeof block[i].xyz);
        at += n;
    }
    page->first_after = first + 1;
    return IL_OK;
}

il_status il_mesh_spool_position(il_mesh_spool *m, uint64_t i, double xyz[3], il_error *err)
{
    if (!m->cache && !(m->cache = il_calloc(PAGES, sizeof *m->cache)))
        return il_fail_nomem(err);
    uint64_t first = i - i % PAGE_VERTICES;
    struct il_vertex_page *page = &m->cache[i / PAGE_VERTICES % PAGES];
    if (page->first_after != first + 1) {
        il_status st = load_page(m, page, first, err);
        if (st != IL_OK)
            return st;
    }
    memcpy(xyz, page->xyz + 3 * (i - first), 3 * sizeof *xyz);
    return IL_OK;
}

/* ---- names ---------------------------------------------------------------- */

static int compare_names(const void *a, const void *b)
{
    return strcmp(a, b);
}

il_status il_mesh_spool_names_differ(const il_mesh_spool *m, bool *differ, il_error *err)
{
    char (*name)[IL_NAME_SAFE_MAX + 1] = il_alloc(m->n_stacks, sizeof *name);
    if (!name)
        return il_fail_nomem(err);
    for (size_t k = 0; k < m->n_stacks; k++)
        il_name_safe(name[k], il_stack_head_name(&m->stack[k].head));
    qsort(name, m->n_stacks, sizeof *name, compare_names);
    *differ = true;
    for (size_t k = 1; k < m->n_stacks && *differ; k++)
        *differ = strcmp(name[k - 1], name[k]) != 0;
    il_free(name);
    return IL_OK;
}

void il_mesh_spool_name(const il_mesh_spool *m, size_t k, bool differ, char to[IL_STACK_NAME_MAX])
{
    char name[IL_NAME_SAFE_MAX + 1];
    il_name_safe(name, il_stack_head_name(&m->stack[k].head));
    if (differ)
        snprintf(to, IL_STACK_NAME_MAX, "%s", name);
    else
        snprintf(to, IL_STACK_NAME_MAX, "%s-%zu", name, k + 1);
}

/* Three lines that begin with START. */
static void describe_placement(il_output *to, const char *start, const il_placement *p)
{
    const struct { const char *word; const double *value; } row[2] = { { "offset", p->offset }, { "scale", p->scale } };
    for (int i = 0; i < 2; i++) {
        il_output_string(to, start);
        il_output_string(to, row[i].word);
        for (int k = 0; k < 3; k++) {
            il_output_char(to, ' ');
            il_output_number(to, row[i].value[k]);
        }
        il_output_char(to, '\n');
    }
    il_output_string(to, start);
    il_output_string(to, "a vertex times scale plus offset is its place on the map, in ");
    il_output_string(to, il_unit_name(p->unit));
    il_output_char(to, '\n');
}

void il_mesh_spool_describe(const il_mesh_spool *m, size_t k, il_output *to, const char *prefix)
{
    const il_spooled_stack *s = &m->stack[k];
    const il_stack_head *h = &s->head;
    char start[64];
    snprintf(start, sizeof start, "%sstack %ld ", prefix, (long)s->index);
    il_output_string(to, start);
    il_output_string(to, "vertices ");
    il_output_integer(to, (long long)s->n_vertices);
    il_output_string(to, " triangles ");
    il_output_integer(to, (long long)s->n_triangles);
    il_output_string(to, " unit ");
    il_output_string(to, il_unit_name(h->unit));
    if (h->has_number) {
        il_output_string(to, " number ");
        il_output_integer(to, h->number);
    }
    if (h->has_color) {
        char color[32];
        snprintf(color, sizeof color, " color %d %d %d", h->color[0], h->color[1], h->color[2]);
        il_output_string(to, color);
    }
    const char *name = il_stack_head_name(h);
    il_output_comment(to, *name ? " name " : "", name);
    if (h->crs) {
        il_output_string(to, start);
        il_output_comment(to, "crs ", h->crs);
    }
    if (h->has_placement)
        describe_placement(to, start, &h->placement);
    const char *coordinates = il_stack_head_attribute(h, IL_ATTRIBUTE_COORDINATES);
    if (coordinates) {
        il_output_string(to, start);
        il_output_comment(to, "coordinates ", coordinates);
    }
}
