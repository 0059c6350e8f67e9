#include "config.h"
#include "input/mesh-file.h"
#include "input/mesh-parts.h"

#include <string.h>
#include <strings.h>

enum { LOOK_AHEAD = 65536, STL_HEADER = 84, STL_RECORD = 50 };

static bool is_text(unsigned char c)
{
    return c >= ' ' || (c >= '\t' && c <= '\r');
}

/* Bytes 80 to 83 of a text are no control characters; as a count they would
 * promise at least 0x09090909 triangles, 7.5 GB of file. */
static bool has_stl_count(const unsigned char *head, size_t n)
{
    if (n < STL_HEADER)
        return false;
    if (is_text(head[80]) && is_text(head[81]) && is_text(head[82]) && is_text(head[83]))
        return false;
    uint64_t size = STL_HEADER + STL_RECORD * (uint64_t)il_u32le_at(head + 80);
    return n < LOOK_AHEAD ? size == n : size >= n;
}

static bool starts_with_solid(const unsigned char *head, size_t n)
{
    return n >= 6 && strncasecmp((const char *)head, "solid", 5) == 0
        && (head[5] == ' ' || (head[5] >= '\t' && head[5] <= '\r'));
}

static bool starts_with_line(const unsigned char *head, size_t n, const char *line)
{
    size_t k = strlen(line);
    return n > k && memcmp(head, line, k) == 0
        && (head[k] == '\n' || (head[k] == '\r' && n > k + 1 && head[k + 1] == '\n'));
}

/* The word behind "format", which may stand behind comments. */
static bool ply_is_ascii(const unsigned char *head, size_t n)
{
    for (size_t i = 3; i + 13 <= n; i++)
        if (head[i] == '\n' && memcmp(head + i + 1, "format ", 7) == 0)
            return memcmp(head + i + 8, "ascii", 5) == 0;
    return false;
}

static const char *format_of(const unsigned char *head, size_t n)
{
    if (starts_with_line(head, n, "ply"))
        return ply_is_ascii(head, n) ? "ply-ascii" : "ply";
    if (has_stl_count(head, n))
        return "stl";
    if (starts_with_solid(head, n))
        return "stl-ascii";
    return il_mesh_obj_starts(head, n) ? "obj" : NULL;
}

il_status il_mesh_file_detect(il_source *source, const char **format, il_error *err)
{
    const unsigned char *head;
    size_t n;
    *format = NULL;
    il_status st = il_source_peek(source, LOOK_AHEAD, &head, &n, err);
    if (st == IL_OK)
        *format = format_of(head, n);
    return st;
}

static il_status read_format(il_source *source, const char *format, il_mesh *out, size_t *polygons, il_error *err)
{
    if (strcmp(format, "stl") == 0)
        return il_mesh_read_stl(source, out, err);
    if (strcmp(format, "stl-ascii") == 0)
        return il_mesh_read_stl_ascii(source, out, err);
    if (strcmp(format, "obj") == 0)
        return il_mesh_read_obj(source, out, polygons, err);
    return il_mesh_read_ply(source, out, polygons, err);
}

il_status il_mesh_file_read(il_source *source, il_mesh *out, il_mesh_file_facts *facts, il_error *err)
{
    *facts = (il_mesh_file_facts)IL_MESH_FILE_FACTS_INIT;
    il_status st = il_mesh_file_detect(source, &facts->format, err);
    if (st == IL_OK && !facts->format)
        st = il_fail(err, IL_E_INPUT, 0, "neither STL nor OBJ nor PLY, "
                     "or a binary STL of another length than its count says");
    if (st == IL_OK)
        st = read_format(source, facts->format, out, &facts->polygons, err);
    if (st == IL_OK && out->n_triangles == 0)
        st = il_fail(err, IL_E_INPUT, 0, "there is no triangle in it");
    if (st != IL_OK)
        il_mesh_free(out);
    il_error_set_file(err, il_source_name(source));
    return st;
}
