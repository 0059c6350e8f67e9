#include "config.h"
#include "output/writer.h"

#include <string.h>
#include <strings.h>

/* In the order in which --formats lists them. */
const il_writer *const il_writers[] = {
    &il_writer_stl, &il_writer_stl_ascii, &il_writer_obj, &il_writer_ply, &il_writer_ply_ascii,
    &il_writer_loft, NULL };

const il_writer *il_writer_named(const char *name)
{
    for (const il_writer *const *w = il_writers; *w; w++)
        if (strcmp((*w)->name, name) == 0)
            return *w;
    return NULL;
}

const il_writer *il_writer_for_path(const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    if (!dot || dot == base || dot[1] == '\0')
        return NULL;
    for (const il_writer *const *w = il_writers; *w; w++)
        if (strcasecmp((*w)->extension, dot + 1) == 0)
            return *w;
    return NULL;
}
