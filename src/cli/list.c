/* list.c - --list: a line a stack, before anything is made of it. */
#include "config.h"
#include "cli/command.h"
#include "cli/grid.h"
#include "cli/oddities.h"

#include <stdio.h>

/* Names and types take this many columns on a terminal; elsewhere all are whole. */
enum { NAME_COLUMNS = 32, TYPE_COLUMNS = 20 };

/* The oddities of one stack, put together in MEMORY. */
static void add_oddity(void *self, const char *words)
{
    il_output *memory = self;
    size_t n;
    il_output_memory(memory, &n);
    il_output_string(memory, n > 0 ? ", " : "");
    il_output_string(memory, words);
}

static bool add_oddities(il_grid *g, const il_stack_account *s)
{
    il_output *memory = NULL;
    if (il_output_to_memory(&memory, NULL) != IL_OK)
        return false;
    il_oddities_each(s, add_oddity, memory);
    if (s->error) {
        add_oddity(memory, "failed: ");
        il_output_string(memory, s->error);
    }
    il_output_char(memory, '\0');
    size_t n;
    const unsigned char *text = il_output_memory(memory, &n);
    bool ok = il_output_status(memory, NULL) == IL_OK && il_grid_add(g, (const char *)text, 0);
    il_output_discard(memory);
    return ok;
}

static bool add_count(il_grid *g, size_t n)
{
    char text[24];
    snprintf(text, sizeof text, "%zu", n);
    return il_grid_add(g, text, 0);
}

static bool add_row(il_grid *g, const il_stack_account *s, bool narrow)
{
    char number[24] = "-", color[8] = "-", spacing[40] = "-";
    const char *type = s->type && *s->type ? s->type : s->is_terrain ? "terrain" : "-";
    if (s->has_number)
        snprintf(number, sizeof number, "%ld", s->number);
    if (s->has_color)
        snprintf(color, sizeof color, "#%02x%02x%02x", s->color[0], s->color[1], s->color[2]);
    if (s->slices > 1)
        snprintf(spacing, sizeof spacing, "%.6g %s", s->spacing.usual,
                 il_unit_name(s->is_terrain ? il_terrain_unit_of_z(s->unit) : s->unit));
    return il_grid_add(g, number, 0) && il_grid_add(g, s->name, narrow ? NAME_COLUMNS : 0) &&
           il_grid_add(g, type, narrow ? TYPE_COLUMNS : 0) && il_grid_add(g, color, 0) &&
           add_count(g, s->slices) && add_count(g, s->rings) && add_count(g, s->points) && il_grid_add(g, spacing, 0) &&
           add_oddities(g, s);
}

/* A table with a line a stack, to OUT. */
static il_status write_list(const il_result *r, il_output *out, il_error *err)
{
    static const char *const heads[] = { "NUMBER", "NAME", "TYPE", "COLOUR", "SLICES", "RINGS", "POINTS", "SPACING", "ODDITIES" };
    il_grid g = { .columns = sizeof heads / sizeof *heads };
    bool ok = true, narrow = il_output_is_terminal(out);
    for (size_t k = 0; k < g.columns && ok; k++)
        ok = il_grid_add(&g, heads[k], 0);
    for (size_t k = 0; k < r->account.n && ok; k++)
        ok = add_row(&g, &r->account.stack[k], narrow);
    if (ok)
        il_grid_write(&g, "100011110", out);
    il_grid_free(&g);
    return ok ? IL_OK : il_fail_nomem(err);
}

il_status il_command_list(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .survey = true };
    return il_command_survey(o, &plan, write_list, v, err);
}
