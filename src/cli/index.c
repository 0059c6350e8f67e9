#include "config.h"
#include "cli/index.h"
#include "base/alloc.h"
#include "cli/summary.h"

#include <string.h>

static void write_entry(il_json *j, const il_stack_account *s)
{
    il_json_open(j, '{');
    il_json_key(j, "file");
    il_json_string(j, s->file);
    il_json_key(j, "number");
    s->has_number ? il_json_integer(j, s->number) : il_json_null(j);
    il_json_key(j, "name");
    il_json_string(j, s->name);
    il_summary_json_color(j, s);
    il_json_key(j, "status");
    il_json_string(j, s->status != IL_OK ? "failed" : s->file ? "ok" : "empty");
    il_json_key(j, "error");
    il_json_string(j, s->error);
    il_json_close(j, '}');
}

il_status il_index_write(const char *folder, const il_account *a, il_error *err)
{
    static const char name[] = "index.json";
    size_t n = strlen(folder);
    char *path = il_alloc(n + sizeof name, 1);
    if (!path)
        return il_fail_nomem(err);
    memcpy(path, folder, n);
    memcpy(path + n, name, sizeof name);
    il_output *out = NULL;
    il_status st = il_output_open(&out, path, err);
    il_free(path);
    if (st != IL_OK)
        return st;
    il_json j = { out, false };
    il_json_open(&j, '{');
    il_json_key(&j, "stacks");
    il_json_open(&j, '[');
    for (size_t k = 0; k < a->n; k++) {
        il_output_string(out, j.comma ? "" : "\n");
        write_entry(&j, &a->stack[k]);
    }
    il_json_close(&j, ']');
    il_json_close(&j, '}');
    il_output_char(out, '\n');
    return il_output_commit(out, err);
}
