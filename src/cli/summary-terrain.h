/* summary-terrain.h - what the account of a run says of terrain. */
#ifndef IL_CLI_SUMMARY_TERRAIN_H
#define IL_CLI_SUMMARY_TERRAIN_H

#include "cli/account.h"
#include "cli/json.h"

/* Rows of the table: levels, lines, extent, length, area. */
void il_summary_terrain_rows(const il_stack_account *s, il_output *out);

/* Rows of the mesh that was made of it: what it is, where it was put. */
void il_summary_surface_rows(const il_stack_account *s, il_output *out);

/* On standard error, how its heights were found. */
void il_summary_say_heights(const il_stack_account *s, const char *label, il_voice *v);

/* The same of its place, on standard error. */
void il_summary_say_placement(const il_stack_account *s, const char *label, il_voice *v);

/* The keys that stacks of terrain have beyond those of all, as
 * formats/summary.schema.json has them. */
void il_summary_terrain_json(const il_stack_account *s, il_json *j);

#endif
