/* check.c - is a native stream or a mesh sound? */
#include "config.h"
#include "cli/check.h"
#include "input/mesh-file.h"

il_status il_check_print(const il_options *o, void (*text)(const void *self, il_output *out),
                         void (*json)(const void *self, il_output *out), const void *self, il_voice *v, il_error *err)
{
    il_output *out = NULL;
    il_status st = IL_OK;
    if (!o->json || o->json_path) {
        st = il_output_open(&out, "-", err);
        if (st == IL_OK) {
            text(self, out);
            st = il_output_commit(out, err);
        }
    }
    return st == IL_OK ? il_command_put_json(o, true, json, self, v, err) : st;
}

enum { PROBE_BYTES = 4096 };

static il_status check_source(il_source *source, const il_options *o, il_voice *v, il_error *err)
{
    const unsigned char *head;
    size_t n;
    il_status st = il_source_peek(source, PROBE_BYTES, &head, &n, err);
    if (st != IL_OK)
        return st;
    if (n == 0)
        return il_fail(err, IL_E_INPUT, 0, "the input is empty");
    if (il_reader_loft.probe(head, n))
        return il_check_native(source, o, v, err);
    const char *format = NULL;
    st = il_mesh_file_detect(source, &format, err);
    if (st == IL_OK && !format)
        st = il_fail(err, IL_E_INPUT, 0, "is neither a native stream nor a mesh in STL, OBJ or PLY");
    return st == IL_OK ? il_check_mesh(source, o, v, err) : st;
}

il_status il_command_check(const il_options *o, il_voice *v, il_error *err)
{
    il_source *source = NULL;
    il_status st = il_source_open(&source, o->n_inputs > 0 ? o->input[0] : "-", err);
    if (st != IL_OK)
        return st;
    st = check_source(source, o, v, err);
    il_error_set_file(err, il_source_name(source));
    il_source_close(source);
    return st;
}
