/* summary.c - the account of a run for people. */
#include "config.h"
#include "cli/summary.h"
#include "base/number.h"
#include "base/text.h"
#include "cli/summary-terrain.h"
#include "cli/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 400, LINES_FEW = 10 };

/* "3 x crossing made a vertex, ..." for the repairs of R; "none".  Roundings
 * are the output format's, not the input's, and left out unless ALL. */
static void repairs_text(char *to, size_t size, const il_report *r, bool all)
{
    *to = '\0';
    for (int k = 0; k < IL_N_REPAIRS; k++)
        if (r->repair[k] > 0 && (all || k != IL_REPAIR_ROUNDED_POINT))
            il_text_append(to, size, "%s%zu x %s", *to ? ", " : "", r->repair[k], il_repair_words((il_repair)k));
    if (!*to)
        il_text_append(to, size, "none");
}

static void skip_text(char *to, size_t size, const il_skip *s)
{
    *to = '\0';
    il_text_append(to, size, "%s", s->file);
    if (s->line > 0)
        il_text_append(to, size, ":%ld", s->line);
    il_text_append(to, size, "%s%s: %s", *to ? ": " : "", s->what, s->why);
    if (s->count > 1)
        il_text_append(to, size, " (%zu times)", s->count);
}

static const char *stack_label(const il_stack_account *s, size_t index, char *to, size_t size)
{
    char name[120];
    il_text_printable(name, sizeof name, s->name, strlen(s->name));
    if (*name)
        snprintf(to, size, "stack '%s'", name);
    else
        snprintf(to, size, "stack %zu", index + 1);
    return to;
}

/* "12 overlap, 3 join" of F; "none". */
static void links_text(char *to, size_t size, const il_link_facts *f)
{
    *to = '\0';
    for (int k = 0; k < IL_N_LINK_REASONS; k++)
        if (f->n_by[k] > 0)
            il_text_append(to, size, "%s%zu %s", *to ? ", " : "", f->n_by[k], il_link_reason_word((il_link_reason)k));
    if (!*to)
        il_text_append(to, size, "none");
}

/* ---- the table ----------------------------------------------------------- */

/* What the input calls it. */
static void head_rows(il_output *out, const il_stack_account *s)
{
    const struct { const char *key, *text; } texts[] = {
        { "type", s->type }, { "algorithm", s->algorithm }, { "frame", s->frame_uid }, { "planes", s->planes } };
    if (s->has_number)
        il_table_row(out, "number", "%ld", s->number);
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        char shown[120];
        if (!texts[k].text)
            continue;
        il_text_printable(shown, sizeof shown, texts[k].text, strlen(texts[k].text));
        il_table_row(out, texts[k].key, "%s", shown);
    }
}

static void contour_rows(il_output *out, const il_stack_account *s)
{
    const char *unit = il_unit_name(s->unit);
    if (s->box[2] <= s->box[5]) {
        char low[IL_NUMBER_MAX], high[IL_NUMBER_MAX];
        il_number_format(low, s->box[2]);
        il_number_format(high, s->box[5]);
        il_table_row(out, "slices", "%zu, z from %s to %s %s", s->slices, low, high, unit);
        il_table_row(out, "size", "%.6g x %.6g x %.6g %s", s->box[3] - s->box[0], s->box[4] - s->box[1],
                     s->box[5] - s->box[2], unit);
    } else {
        il_table_row(out, "slices", "%zu, all empty", s->slices);
    }
    if (s->slices > 1)
        il_table_row(out, "spacing", "%.6g %s (least %.6g, largest %.6g)", s->spacing.usual, unit,
            s->spacing.least, s->spacing.largest);
    for (size_t k = 0; k < s->n_gaps && k < LINES_FEW; k++)
        il_table_row(out, "gap", "z from %.9g to %.9g %s, %s", s->gap[k].below, s->gap[k].above, unit,
                     s->gap[k].capped ? "closed on either side" : "joined across");
    if (s->n_gaps > LINES_FEW)
        il_table_row(out, "gap", "and %zu more", s->n_gaps - LINES_FEW);
    il_table_row(out, "rings", "%zu", s->rings);
    il_table_row(out, "points", "%zu", s->points);
}

static void report_rows(il_output *out, const il_report *r)
{
    char text[TEXT];
    repairs_text(text, sizeof text, r, true);
    il_table_row(out, "repairs", "%s", text);
    for (size_t k = 0; k < r->n_skips && k < LINES_FEW; k++) {
        skip_text(text, sizeof text, &r->skip[k]);
        il_table_row(out, "skipped", "%s", text);
    }
    if (r->n_skipped == 0)
        il_table_row(out, "skipped", "nothing");
    else
        il_table_row(out, "skipped", "%zu in all", r->n_skipped);
    for (size_t k = 0; k < r->n_notes; k++)
        il_table_row(out, "note", "%s", r->note[k]);
}

/* Why rings belong together, where they were looked at for that. */
static void links_rows(il_output *out, const il_link_facts *f)
{
    char text[TEXT];
    links_text(text, sizeof text, f);
    if (f->pairs > 0)
        il_table_row(out, "links", "%s", text);
    if (f->n_guesses > 0)
        il_table_row(out, "guessed", "%zu of them", f->n_guesses);
    if (f->pairs > 0 && f->parts > 0)
        il_table_row(out, "parts", "%zu, as linked", f->parts);
}

/* How the contours were settled, as shares of their length. */
static void settled_row(il_output *out, const il_mesh_facts *f)
{
    const double *by = f->length_by;
    double paired = by[IL_ATTEMPT_S] + by[IL_ATTEMPT_P] + by[IL_ATTEMPT_B], all = paired + f->length_alone;
    if (paired > 0)
        il_table_row(out, "settled", "S %.4g %%, P %.4g %%, B %.4g %% of the contours", 100 * by[IL_ATTEMPT_S] / paired,
                     100 * by[IL_ATTEMPT_P] / paired, 100 * by[IL_ATTEMPT_B] / paired);
    if (f->length_alone > 0)
        il_table_row(out, "unpaired", "%.4g %% of the contours", 100 * f->length_alone / all);
}

/* Contours between the slices, and where strips are less smooth than they should be. */
static void between_row(il_output *out, const il_mesh_facts *f)
{
    char text[TEXT] = "";
    if (f->slabs_halved > 0)
        il_text_append(text, sizeof text, "; in %zu slab%s the bend was halved where strips met", f->slabs_halved,
                       f->slabs_halved == 1 ? "" : "s");
    if (f->slabs_straight > 0)
        il_text_append(text, sizeof text, "; %zu slab%s left straight", f->slabs_straight, f->slabs_straight == 1 ? "" : "s");
    if (f->between > 0 || *text)
        il_table_row(out, "between", "%zu level%s put between the slices%s", f->between, f->between == 1 ? "" : "s", text);
}

/* A volume, and what it is in cm^3 where a unit is a mm. */
static void volume_row(il_output *out, const char *key, double volume, il_unit unit, const char *words)
{
    if (!isfinite(volume))
        il_table_row(out, key, "unknown: a single slice has no thickness");
    else if (unit == IL_UNIT_MM)
        il_table_row(out, key, "%.6g mm^3 = %.6g cm^3%s", volume, volume / 1000, words);
    else
        il_table_row(out, key, "%.6g %s^3%s", volume, il_unit_name(unit), words);
}

/* The volumes that the slices alone give. */
static void sum_rows(il_output *out, const il_stack_account *s)
{
    if (s->points == 0)
        return;
    volume_row(out, "slice sum", il_stack_account_slice_sum(s), s->unit, ", areas x usual spacing");
    if (s->sections.n > 1)
        volume_row(out, "trapezoids", il_sections_trapezoids(&s->sections), s->unit, ", between neighbouring slices");
}

static void mesh_rows(il_output *out, const il_stack_account *s)
{
    const il_mesh_facts *f = &s->facts;
    const char *unit = il_unit_name(s->unit);
    if (!s->has_mesh) {
        il_table_row(out, "surface", "%s", s->error ? s->error : "none");
        return;
    }
    il_table_row(out, "surface", "certified; %zu vertices, %zu triangles", f->vertices, f->triangles);
    il_table_row(out, "components", "%ld, genus %ld", f->components, f->genus);
    if (f->pinches > 0)
        il_table_row(out, "pinches", "%zu, where the input touches itself", f->pinches);
    settled_row(out, f);
    between_row(out, f);
    il_table_row(out, "area", "%.6g %s^2", f->area, unit);
    volume_row(out, "volume", f->volume, s->unit, "");
}

static bool boxes_overlap(const double a[6], const double b[6])
{
    for (int k = 0; k < 3; k++)
        if (!(a[k] <= b[k + 3] && b[k] <= a[k + 3]))
            return false;
    return true;
}

/* A surface is certified for its stack alone; stacks may run into each other.
 * Beyond this many, comparing all with all would be felt. */
enum { STACKS_COMPARED = 2000 };

static void overlap_row(il_output *out, const il_account *a)
{
    size_t n = a->n < STACKS_COMPARED ? a->n : STACKS_COMPARED, pairs = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 1; k < n; k++)
            pairs += !a->stack[i].is_terrain && !a->stack[k].is_terrain && boxes_overlap(a->stack[i].box, a->stack[k].box);
    if (pairs == 0)
        return;
    il_table_heading(out, "%zu pair%s of stacks may overlap: their boxes do, and each surface is certified by itself",
                     pairs, pairs == 1 ? "" : "s");
}

static void stack_rows(il_output *out, const il_account *a, bool surface)
{
    for (size_t k = 0; k < a->n; k++) {
        const il_stack_account *s = &a->stack[k];
        char label[160];
        il_table_heading(out, "%s", stack_label(s, k, label, sizeof label));
        head_rows(out, s);
        s->is_terrain ? il_summary_terrain_rows(s, out) : contour_rows(out, s);
        report_rows(out, &s->report);
        if (!surface)
            continue;
        links_rows(out, &s->links);
        s->is_terrain ? il_summary_surface_rows(s, out) : mesh_rows(out, s);
        if (!s->is_terrain)
            sum_rows(out, s);
        il_table_row(out, "seconds", "%.3f", s->seconds);
    }
}

void il_summary_text(const il_result *r, il_output *out)
{
    stack_rows(out, &r->account, true);
    overlap_row(out, &r->account);
}

void il_summary_contours(const il_result *r, il_output *out)
{
    stack_rows(out, &r->account, false);
}

/* ---- on standard error --------------------------------------------------- */

/* Gaps that are joined across, and those that are not, the first of either. */
static void say_gaps(const il_stack_account *s, const char *label, il_voice *v)
{
    for (int capped = 0; capped < 2; capped++) {
        size_t n = 0, first = 0;
        for (size_t k = s->n_gaps; k-- > 0;)
            if (s->gap[k].capped == capped)
                first = k, n++;
        if (n > 0)
            il_message_note(v, "%s: %zu gap%s %s, %sfrom z %.9g to %.9g", label, n, n == 1 ? "" : "s",
                            capped ? "closed on either side" : "wider than 2.5 usual spacings joined across",
                            n == 1 ? "" : "the first ", s->gap[first].below, s->gap[first].above);
    }
}

/* Slices of a structure set much nearer to one another than usual are heights of
 * one slice that differ too much for one, more likely than not. */
static bool has_near_slices(const il_stack_account *s)
{
    return s->set_spacing > 0 && s->slices > 2 && s->spacing.least < s->spacing.usual / 3;
}

static void say_near_slices(const il_stack_account *s, const char *label, il_voice *v)
{
    if (has_near_slices(s))
        il_message_note(v, "%s: slices as near as %.3g %s, where %.3g %s is usual: are they one?", label,
                        s->spacing.least, il_unit_name(s->unit), s->spacing.usual, il_unit_name(s->unit));
}

static void say_report(const il_stack_account *s, const char *label, il_voice *v)
{
    char text[TEXT];
    const il_report *r = &s->report;
    for (size_t k = 0; k < r->n_notes; k++)
        il_message_note(v, "%s: %s", label, r->note[k]);
    repairs_text(text, sizeof text, r, v->verbose);
    if (strcmp(text, "none") != 0)
        il_message_note(v, "%s: %s", label, text);
    size_t shown = v->verbose ? r->n_skips : LINES_FEW;
    for (size_t k = 0; k < r->n_skips && k < shown; k++) {
        skip_text(text, sizeof text, &r->skip[k]);
        il_message_note(v, "skipped: %s", text);
    }
    if (r->n_skips > shown)
        il_message_note(v, "skipped: %zu parts in all (-v lists more)", r->n_skipped);
    say_gaps(s, label, v);
    say_near_slices(s, label, v);
}

static void say_links(const il_stack_account *s, const char *label, il_voice *v)
{
    char text[TEXT];
    const il_link_facts *f = &s->links;
    links_text(text, sizeof text, f);
    if (f->pairs > 0)
        il_message_detail(v, "%s: links: %s", label, text);
    for (size_t k = 0; k < f->n_guesses; k++) {
        const il_guess *g = &f->guess[k];
        il_message_detail(v, "%s: guessed from z %.9g to %.9g: ring %lu to ring %lu, %.4g %s apart, %.3g heights", label,
                          g->below, g->above, (unsigned long)g->link.lower, (unsigned long)g->link.upper, g->link.reach,
                          il_unit_name(s->unit), g->link.reach / (g->above - g->below));
    }
}

static void say_stack(const il_stack_account *s, const char *label, il_voice *v)
{
    const il_mesh_facts *f = &s->facts;
    const char *unit = il_unit_name(s->is_terrain ? s->mesh_unit : s->unit);
    il_message_detail(v, s->is_terrain ? "%s: %zu levels, %zu lines, %zu points" : "%s: %zu slices, %zu rings, %zu points",
                      label, s->slices, s->rings, s->points);
    say_links(s, label, v);
    if (s->has_mesh && f->is_open) {
        il_message_detail(v, "%s: %zu vertices, %zu triangles, certified, open at the frame; area %.6g %s^2", label,
                          f->vertices, f->triangles, f->area, unit);
    } else if (s->has_mesh) {
        il_message_detail(v, "%s: %zu vertices, %zu triangles, certified; %ld component%s, genus %ld", label,
                          f->vertices, f->triangles, f->components, f->components == 1 ? "" : "s", f->genus);
        il_message_detail(v, "%s: area %.6g %s^2, volume %.6g %s^3", label, f->area, unit, f->volume, unit);
    }
    if (s->has_mesh && s->is_terrain) {
        il_summary_say_heights(s, label, v);
        il_summary_say_placement(s, label, v);
    }
    if (s->file)
        il_message_detail(v, "%s: written to %s", label, s->file);
}

static bool has_words(const il_stack_account *s)
{
    size_t n = s->report.n_notes + s->report.n_skips + s->n_gaps + has_near_slices(s);
    for (int k = 0; k < IL_N_REPAIRS; k++)
        n += k == IL_REPAIR_ROUNDED_POINT ? 0 : s->report.repair[k];
    return n > 0;
}

void il_summary_say(const il_result *r, il_voice *v)
{
    const il_account *a = &r->account;
    size_t told = 0;
    for (size_t k = 0; k < a->n; k++) {
        char label[160];
        stack_label(&a->stack[k], k, label, sizeof label);
        told += has_words(&a->stack[k]);
        if (v->verbose || told <= LINES_FEW)
            say_report(&a->stack[k], label, v);
        say_stack(&a->stack[k], label, v);
    }
    if (!v->verbose && told > LINES_FEW)
        il_message_note(v, "and so on: there is something to say of %zu stacks (-v says it)", told);
    il_message_detail(v, "%.2f seconds", r->seconds);
}
