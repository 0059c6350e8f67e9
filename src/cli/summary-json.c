/* summary-json.c - the account of a run for programs (formats/summary.schema.json). */
#include "config.h"
#include "cli/oddities.h"
#include "cli/summary.h"
#include "cli/summary-terrain.h"

#include <sys/resource.h>

static void put_count(il_json *j, const char *key, size_t n)
{
    il_json_key(j, key);
    il_json_integer(j, (long long)n);
}

static void put_number(il_json *j, const char *key, double value)
{
    il_json_key(j, key);
    il_json_number(j, value);
}

static void put_skipped(il_json *j, const il_report *r)
{
    il_json_key(j, "skipped");
    il_json_open(j, '[');
    for (size_t k = 0; k < r->n_skips; k++) {
        const il_skip *s = &r->skip[k];
        il_json_open(j, '{');
        il_json_key(j, "file");
        il_json_string(j, s->file);
        il_json_key(j, "line");
        s->line > 0 ? il_json_integer(j, s->line) : il_json_null(j);
        il_json_key(j, "what");
        il_json_string(j, s->what);
        il_json_key(j, "why");
        il_json_string(j, s->why);
        put_count(j, "count", s->count);
        il_json_close(j, '}');
    }
    il_json_close(j, ']');
}

/* Repairs that only terrain needs are told of terrain only. */
static void put_report(il_json *j, const il_report *r, bool is_terrain)
{
    put_skipped(j, r);
    put_count(j, "skipped_total", r->n_skipped);
    il_json_key(j, "repairs");
    il_json_open(j, '{');
    for (int k = 0; k < (is_terrain ? (int)IL_N_REPAIRS : (int)IL_N_REPAIRS_OF_SOLIDS); k++)
        put_count(j, il_repair_key((il_repair)k), r->repair[k]);
    il_json_close(j, '}');
    put_number(j, "largest_move", r->largest_move);
    il_json_key(j, "notes");
    il_json_open(j, '[');
    for (size_t k = 0; k < r->n_notes; k++)
        il_json_string(j, r->note[k]);
    il_json_close(j, ']');
}

static void put_heights(il_json *j, const il_stack_account *s)
{
    bool any = s->box[2] <= s->box[5];
    il_json_key(j, "z");
    il_json_open(j, '[');
    for (int k = 2; k < 6 && any; k += 3)
        il_json_number(j, s->box[k]);
    il_json_close(j, ']');
    il_json_key(j, "spacing");
    il_json_open(j, '{');
    put_number(j, "least", s->spacing.least);
    put_number(j, "usual", s->spacing.usual);
    put_number(j, "largest", s->spacing.largest);
    il_json_close(j, '}');
    il_json_key(j, "gaps");
    il_json_open(j, '[');
    for (size_t k = 0; k < s->n_gaps; k++) {
        il_json_open(j, '{');
        put_number(j, "from", s->gap[k].below);
        put_number(j, "to", s->gap[k].above);
        il_json_key(j, "capped");
        il_json_bool(j, s->gap[k].capped);
        il_json_close(j, '}');
    }
    il_json_close(j, ']');
}

static void put_guesses(il_json *j, const il_link_facts *f)
{
    il_json_key(j, "guessed");
    il_json_open(j, '[');
    for (size_t k = 0; k < f->n_guesses; k++) {
        const il_guess *g = &f->guess[k];
        il_json_open(j, '{');
        put_number(j, "from", g->below);
        put_number(j, "to", g->above);
        put_count(j, "lower", g->link.lower);
        put_count(j, "upper", g->link.upper);
        put_number(j, "reach", g->link.reach);
        put_number(j, "heights", g->link.reach / (g->above - g->below));
        il_json_close(j, '}');
    }
    il_json_close(j, ']');
}

/* Null where slices were not matched. */
static void put_links(il_json *j, const il_link_facts *f)
{
    il_json_key(j, "links");
    if (f->pairs == 0) {
        il_json_null(j);
    } else {
        il_json_open(j, '{');
        for (int k = 0; k < IL_N_LINK_REASONS; k++)
            put_count(j, il_link_reason_word((il_link_reason)k), f->n_by[k]);
        il_json_close(j, '}');
    }
    put_guesses(j, f);
    il_json_key(j, "parts");
    f->pairs > 0 && f->parts > 0 ? il_json_integer(j, (long long)f->parts) : il_json_null(j);
    put_number(j, "median_join", f->joined);
    il_json_key(j, "undersampled");
    il_json_bool(j, f->undersampled);
}

/* Null where no surface was made. */
static void put_mesh(il_json *j, const il_stack_account *s)
{
    static const char *const keys[] = { "vertices", "triangles", "components", "genus" };
    static const char *const attempts[IL_N_ATTEMPTS] = { "S", "P", "B" };
    const il_mesh_facts *f = &s->facts;
    const long long values[] = { (long long)f->vertices, (long long)f->triangles, f->components, f->genus };
    bool bounds = s->has_mesh && !f->is_open;
    il_json_key(j, "slabs");
    il_json_open(j, '{');
    for (int k = 0; k < IL_N_ATTEMPTS; k++)
        put_number(j, attempts[k], s->has_mesh ? f->length_by[k] : 0);
    il_json_close(j, '}');
    put_number(j, "unpaired", s->has_mesh ? f->length_alone : 0);
    il_json_key(j, "between");
    il_json_open(j, '{');
    put_count(j, "levels", s->has_mesh ? f->between : 0);
    put_count(j, "slabs_halved", s->has_mesh ? f->slabs_halved : 0);
    put_count(j, "slabs_straight", s->has_mesh ? f->slabs_straight : 0);
    il_json_close(j, '}');
    for (int k = 0; k < 4; k++) {
        il_json_key(j, keys[k]);
        (k < 3 ? s->has_mesh : bounds) ? il_json_integer(j, values[k]) : il_json_null(j);
    }
    il_json_key(j, "volume");
    bounds ? il_json_number(j, f->volume) : il_json_null(j);
    il_json_key(j, "area");
    s->has_mesh ? il_json_number(j, f->area) : il_json_null(j);
    il_json_key(j, "certified");
    il_json_bool(j, s->has_mesh);
}

void il_summary_json_color(il_json *j, const il_stack_account *s)
{
    il_json_key(j, "colour");
    if (!s->has_color) {
        il_json_null(j);
        return;
    }
    il_json_open(j, '[');
    for (int k = 0; k < 3; k++)
        il_json_integer(j, s->color[k]);
    il_json_close(j, ']');
}

static void put_head(il_json *j, const il_stack_account *s)
{
    const struct { const char *key, *text; } texts[] = {
        { "type", s->type }, { "algorithm", s->algorithm }, { "frame_of_reference", s->frame_uid }, { "planes", s->planes } };
    il_json_key(j, "name");
    il_json_string(j, s->name);
    il_json_key(j, "number");
    s->has_number ? il_json_integer(j, s->number) : il_json_null(j);
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        il_json_key(j, texts[k].key);
        il_json_string(j, texts[k].text);
    }
    il_summary_json_color(j, s);
    il_json_key(j, "unit");
    il_json_string(j, il_unit_name(s->unit));
}

static void put_oddity(void *self, const char *words)
{
    il_json_string(self, words);
}

static void put_oddities(il_json *j, const il_stack_account *s)
{
    il_json_key(j, "oddities");
    il_json_open(j, '[');
    il_oddities_each(s, put_oddity, j);
    il_json_close(j, ']');
}

/* Null where the slices do not tell. */
static void put_sums(il_json *j, const il_stack_account *s)
{
    il_json_key(j, "slice_sum");
    s->is_terrain ? il_json_null(j) : il_json_number(j, il_stack_account_slice_sum(s));
    il_json_key(j, "trapezoid_sum");
    (s->sections.n > 1 || s->points == 0) && !s->is_terrain ? il_json_number(j, il_sections_trapezoids(&s->sections)) : il_json_null(j);
    put_number(j, "seconds", s->seconds);
}

static void put_stack(il_json *j, const il_stack_account *s)
{
    il_json_open(j, '{');
    put_head(j, s);
    put_count(j, "slices", s->slices);
    put_count(j, "rings", s->rings);
    put_count(j, "points", s->points);
    put_heights(j, s);
    put_report(j, &s->report, s->is_terrain);
    put_oddities(j, s);
    put_links(j, &s->links);
    put_mesh(j, s);
    put_sums(j, s);
    if (s->is_terrain)
        il_summary_terrain_json(s, j);
    il_json_key(j, "file");
    il_json_string(j, s->file);
    il_json_key(j, "status");
    il_json_integer(j, s->status);
    il_json_key(j, "error");
    il_json_string(j, s->error);
    il_json_close(j, '}');
}

void il_summary_json_stacks(il_json *j, const il_result *r)
{
    il_json_key(j, "stacks");
    il_json_open(j, '[');
    for (size_t k = 0; k < r->account.n; k++)
        put_stack(j, &r->account.stack[k]);
    il_json_close(j, ']');
}

void il_summary_json_cost(il_json *j, double seconds)
{
    struct rusage usage;
    put_number(j, "seconds", seconds);
    il_json_key(j, "peak_bytes");
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        il_json_integer(j, 1024LL * usage.ru_maxrss); /* kibibytes on Linux and the BSDs */
    else
        il_json_null(j);
}

void il_summary_json(const il_result *r, il_output *out)
{
    il_json j = { out, false };
    il_json_open(&j, '{');
    il_summary_json_stacks(&j, r);
    il_summary_json_cost(&j, r->seconds);
    il_json_close(&j, '}');
    il_output_char(out, '\n');
}
