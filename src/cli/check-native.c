/* check-native.c - is a native stream sound and canonical? */
#include "config.h"
#include "base/alloc.h"
#include "cli/check.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/summary.h"
#include "cli/table.h"
#include "model/tee.h"
#include "region/clean.h"
#include "region/joiner.h"

/* result: the account of the stream as cleaning found it.  different_line: of
 * the first that is not as the canonical form has it; 0 when none is. */
typedef struct finding {
    const char *name;
    il_result result;
    long different_line;
    bool sound;
} finding;

/* ---- the last stage: nowhere --------------------------------------------- */

static il_status ignore_head(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self;
    (void)head;
    (void)err;
    return IL_OK;
}

static il_status ignore_slice(il_sink *self, il_slice *slice, il_error *err)
{
    (void)self;
    (void)slice;
    (void)err;
    return IL_OK;
}

static il_status ignore_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self;
    (void)pair;
    (void)err;
    return IL_OK;
}

static il_status ignore_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

/* ---- the examination ----------------------------------------------------- */

/* The line of A in which it first differs from B; 0 when they are equal. */
static long first_difference(const unsigned char *a, size_t n_a, const unsigned char *b, size_t n_b)
{
    long line = 1;
    size_t k = 0;
    for (; k < n_a && k < n_b && a[k] == b[k]; k++)
        line += a[k] == '\n';
    return k == n_a && k == n_b ? 0 : line;
}

/* The stream goes to the writer as it is, and through cleaning and joining into the account. */
static il_status examine(finding *f, il_source *bytes, const il_options *o, il_output *canonical, il_error *err)
{
    il_sink nowhere = { ignore_head, ignore_slice, ignore_pair, ignore_end, ignore_end };
    il_account *a = &f->result.account;
    il_clean_options c = { .round_float = false };
    il_join_options ends_meet = { 0 };
    il_sink *writer = NULL, *joiner = NULL, *cleaner = NULL, *tee = NULL;
    il_status st = il_writer_loft.contours_new(&writer, canonical, err);
    if (st == IL_OK)
        st = il_joiner_new(&joiner, &ends_meet, il_account_contours(a, &nowhere), &a->report, err);
    if (st == IL_OK)
        st = il_cleaner_new(&cleaner, &c, joiner, &a->report, err);
    if (st == IL_OK)
        st = il_tee_new(&tee, writer, cleaner, err);
    if (st == IL_OK)
        st = il_reader_loft.read(&bytes, 1, &o->read, tee, &a->report, err);
    il_tee_free(tee);
    if (cleaner)
        il_cleaner_free(cleaner);
    il_joiner_free(joiner);
    if (writer)
        il_writer_loft.contours_free(writer);
    return st;
}

/* What is kept as it is is no repair. */
static bool is_kept(int repair)
{
    return repair == IL_REPAIR_PINCH || repair == IL_REPAIR_KNOT || repair == IL_REPAIR_CRUMB;
}

static bool needs_no_repair(const il_account *a)
{
    size_t n = 0;
    for (size_t i = 0; i < a->n; i++)
        for (int k = 0; k < IL_N_REPAIRS; k++)
            n += is_kept(k) ? 0 : a->stack[i].report.repair[k];
    return n == 0;
}

/* ---- what is said -------------------------------------------------------- */

static void write_text(const void *self, il_output *out)
{
    const finding *f = self;
    il_table_heading(out, "%s: loft, %s", f->name, f->sound ? "sound" : "not sound");
    if (f->different_line == 0)
        il_table_row(out, "canonical", "yes");
    else
        il_table_row(out, "canonical", "no, line %ld is the first that differs", f->different_line);
    il_summary_contours(&f->result, out);
}

static void write_json(const void *self, il_output *out)
{
    const finding *f = self;
    il_json j = { out, false };
    il_json_open(&j, '{');
    il_json_key(&j, "file");
    il_json_string(&j, f->name);
    il_json_key(&j, "format");
    il_json_string(&j, "loft");
    il_json_key(&j, "sound");
    il_json_bool(&j, f->sound);
    il_json_key(&j, "canonical");
    il_json_bool(&j, f->different_line == 0);
    il_summary_json_stacks(&j, &f->result);
    il_summary_json_cost(&j, f->result.seconds);
    il_json_close(&j, '}');
    il_output_char(out, '\n');
}

il_status il_check_native(il_source *source, const il_options *o, il_voice *v, il_error *err)
{
    finding f = { .name = il_source_name(source) };
    il_account_options a = { .empty_allowed = true, .voice = v };
    double start = il_clock_seconds();
    unsigned char *bytes = NULL;
    size_t n = 0, n_canonical;
    il_source *memory = NULL;
    il_output *canonical = NULL;
    il_account_init(&f.result.account, &a);
    il_status st = il_source_load(source, &bytes, &n, err);
    if (st == IL_OK)
        st = il_source_from_memory(&memory, bytes, n, f.name, err);
    if (st == IL_OK)
        st = il_output_to_memory(&canonical, err);
    if (st == IL_OK)
        st = examine(&f, memory, o, canonical, err);
    if (st == IL_OK)
        st = il_output_status(canonical, err);
    il_account_close(&f.result.account, st, err);
    if (st == IL_OK) {
        const unsigned char *text = il_output_memory(canonical, &n_canonical);
        f.different_line = first_difference(bytes, n, text, n_canonical);
        f.sound = needs_no_repair(&f.result.account);
        f.result.seconds = il_clock_seconds() - start;
        st = il_check_print(o, write_text, write_json, &f, v, err);
    }
    if (st == IL_OK && !f.sound)
        st = IL_E_UNSOUND;
    il_output_discard(canonical);
    il_source_close(memory);
    il_free(bytes);
    il_account_free(&f.result.account);
    return st;
}
