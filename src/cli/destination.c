#include "config.h"
#include "cli/destination.h"
#include "base/alloc.h"
#include "cli/filename.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* output, mesh, contours: of the one output, or of the open stack in a folder.
 * folder: null for a single output.  stacks: begun so far. */
struct il_destination {
    il_sink contours_tap;
    il_mesh_sink meshes_tap;
    const il_writer *writer;
    il_write_options options;
    il_output *output;
    il_mesh_sink *mesh;
    il_sink *contours;
    char *folder;
    char file[IL_FILENAME_MAX];
    bool has_file;
    long stacks;
    il_keymap used;
};

/* ---- one output ---------------------------------------------------------- */

static void close_output(il_destination *d)
{
    if (d->mesh)
        d->writer->mesh_free(d->mesh);
    if (d->contours)
        d->writer->contours_free(d->contours);
    il_output_discard(d->output);
    d->mesh = NULL;
    d->contours = NULL;
    d->output = NULL;
}

static il_status open_writer(il_destination *d, il_error *err)
{
    const il_writer *w = d->writer;
    if (w->mesh_new)
        return w->mesh_new(&d->mesh, d->output, &d->options, err);
    return w->picture_new ? w->picture_new(&d->contours, d->output, &d->options, err)
                          : w->contours_new(&d->contours, d->output, err);
}

static il_status open_output(il_destination *d, const char *path, il_error *err)
{
    il_status st = il_output_open(&d->output, path, err);
    if (st == IL_OK && d->writer->binary && il_output_is_terminal(d->output))
        st = il_fail(err, IL_E_USAGE, 0, "%s is binary and would go to the terminal; -o FILE, or -t with a text format",
                     d->writer->name);
    if (st == IL_OK)
        st = open_writer(d, err);
    if (st != IL_OK)
        close_output(d);
    return st;
}

static il_status commit_output(il_destination *d, il_error *err)
{
    il_output *o = d->output;
    d->output = NULL;
    il_status st = il_output_commit(o, err);
    close_output(d);
    return st;
}

/* ---- one output a stack -------------------------------------------------- */

/* The variant "NAME-ascii" leaves its extension to NAME. */
static const char *extension_of(const il_writer *w)
{
    for (const il_writer *const *p = il_writers; *p && !*w->extension; p++) {
        size_t n = strlen((*p)->name);
        if (*(*p)->extension && strncmp(w->name, (*p)->name, n) == 0 && w->name[n] == '-')
            return (*p)->extension;
    }
    return *w->extension ? w->extension : w->name;
}

static il_status open_stack_output(il_destination *d, const il_stack_head *head, il_error *err)
{
    close_output(d);
    d->stacks++;
    d->has_file = false;
    long number = head->has_number && head->number >= 0 ? head->number : d->stacks;
    if (!il_filename_make(d->file, number, il_stack_head_name(head), extension_of(d->writer), &d->used))
        return il_fail_nomem(err);
    size_t n = strlen(d->folder), m = strlen(d->file);
    char *path = il_alloc(n + m + 1, 1);
    if (!path)
        return il_fail_nomem(err);
    memcpy(path, d->folder, n);
    memcpy(path + n, d->file, m + 1);
    il_status st = open_output(d, path, err);
    il_free(path);
    return st;
}

static il_status commit_stack_output(il_destination *d, il_error *err)
{
    il_status st = commit_output(d, err);
    d->has_file = st == IL_OK;
    return st;
}

static il_destination *of_meshes(il_mesh_sink *self)
{
    return (il_destination *)(void *)((char *)self - offsetof(il_destination, meshes_tap));
}

static il_status on_mesh_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    il_destination *d = of_meshes(self);
    il_status st = open_stack_output(d, head, err);
    return st == IL_OK ? d->mesh->begin(d->mesh, head, err) : st;
}

static il_status on_mesh_piece(il_mesh_sink *self, const il_mesh *piece, il_error *err)
{
    il_destination *d = of_meshes(self);
    return d->mesh->piece(d->mesh, piece, err);
}

static void on_mesh_abandon(il_mesh_sink *self)
{
    il_destination *d = of_meshes(self);
    if (d->mesh)
        d->mesh->abandon(d->mesh);
    close_output(d);
}

static il_status on_mesh_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    il_destination *d = of_meshes(self);
    if (facts->triangles == 0) {
        on_mesh_abandon(self);
        return IL_OK;
    }
    il_status st = d->mesh->end(d->mesh, facts, err);
    if (st == IL_OK)
        st = d->mesh->finish(d->mesh, err);
    return st == IL_OK ? commit_stack_output(d, err) : st;
}

static il_status on_mesh_finish(il_mesh_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

static il_destination *of_contours(il_sink *self)
{
    return (il_destination *)(void *)((char *)self - offsetof(il_destination, contours_tap));
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_destination *d = of_contours(self);
    il_status st = open_stack_output(d, head, err);
    return st == IL_OK ? d->contours->stack_begin(d->contours, head, err) : st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    il_destination *d = of_contours(self);
    return d->contours->slice(d->contours, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    il_destination *d = of_contours(self);
    return d->contours->pair(d->contours, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    il_destination *d = of_contours(self);
    il_status st = d->contours->stack_end(d->contours, err);
    if (st == IL_OK)
        st = d->contours->end(d->contours, err);
    return st == IL_OK ? commit_stack_output(d, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

/* ---- the destination ----------------------------------------------------- */

bool il_destination_is_folder(const char *path)
{
    struct stat st;
    size_t n = strlen(path);
    return n > 0 && (path[n - 1] == '/' || (stat(path, &st) == 0 && S_ISDIR(st.st_mode)));
}

/* d->folder: PATH with one slash at its end, and the folder is there. */
static il_status prepare_folder(il_destination *d, const char *path, il_error *err)
{
    size_t n = strlen(path);
    d->folder = il_alloc(n + 2, 1);
    if (!d->folder)
        return il_fail_nomem(err);
    memcpy(d->folder, path, n);
    if (path[n - 1] != '/')
        d->folder[n++] = '/';
    d->folder[n] = '\0';
    struct stat st;
    if (mkdir(d->folder, 0777) == 0)
        return IL_OK;
    int reason = errno;
    if (stat(d->folder, &st) == 0 && S_ISDIR(st.st_mode))
        return IL_OK;
    il_fail(err, IL_E_IO, 0, "cannot make the folder: %s", strerror(reason));
    il_error_set_file(err, path);
    return IL_E_IO;
}

il_status il_destination_open(il_destination **out, const char *path, const il_writer *writer,
                              const il_write_options *options, il_error *err)
{
    *out = NULL;
    il_destination *d = il_calloc(1, sizeof *d);
    if (!d)
        return il_fail_nomem(err);
    d->writer = writer;
    d->options = *options;
    d->meshes_tap = (il_mesh_sink){ on_mesh_begin, on_mesh_piece, on_mesh_end, on_mesh_abandon, on_mesh_finish };
    d->contours_tap = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    il_status st = path && il_destination_is_folder(path) ? prepare_folder(d, path, err)
                                                          : open_output(d, path ? path : "-", err);
    if (st == IL_OK)
        *out = d;
    else
        il_destination_free(d);
    return st;
}

il_mesh_sink *il_destination_meshes(il_destination *d)
{
    return !d->writer->mesh_new ? NULL : d->folder ? &d->meshes_tap : d->mesh;
}

il_sink *il_destination_contours(il_destination *d)
{
    return d->writer->mesh_new ? NULL : d->folder ? &d->contours_tap : d->contours;
}

const char *il_destination_take_file(void *self)
{
    il_destination *d = self;
    bool has_file = d->folder && d->has_file;
    d->has_file = false;
    return has_file ? d->file : NULL;
}

const char *il_destination_folder(const il_destination *d)
{
    return d->folder;
}

il_status il_destination_commit(il_destination *d, il_error *err)
{
    return d->output && !d->folder ? commit_output(d, err) : IL_OK;
}

void il_destination_free(il_destination *d)
{
    if (!d)
        return;
    close_output(d);
    il_keymap_free(&d->used);
    il_free(d->folder);
    il_free(d);
}
