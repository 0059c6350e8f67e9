/* options.h - the command line, read once into one struct.
 *
 * Options and operands may stand in any order; "--" ends the options, "-" is
 * standard input.  The first operand is the verb if it is the name of one. */
#ifndef IL_CLI_OPTIONS_H
#define IL_CLI_OPTIONS_H

#include "base/status.h"
#include "input/reader.h"
#include "loft/lofter.h"
#include "match/linkage.h"
#include "output/writer.h"
#include "region/gapper.h"
#include "terrain/relief.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum il_verb {
    IL_VERB_CONVERT, IL_VERB_READ, IL_VERB_MATCH, IL_VERB_MESH, IL_VERB_INFO, IL_VERB_CHECK, IL_VERB_PLOT,
    IL_N_VERBS
} il_verb;

/* What is to be done: the verb, or words about the program. */
typedef enum il_action { IL_ACTION_RUN, IL_ACTION_HELP, IL_ACTION_VERSION, IL_ACTION_FORMATS } il_action;

typedef enum il_when { IL_WHEN_AUTO, IL_WHEN_ALWAYS, IL_WHEN_NEVER } il_when;

enum { IL_THREADS_MOST = 256 };

/* Texts are borrowed from argv; null where the option was not given.
 * from: null when the format is to be found out.  to: null only for verbs that
 * write neither contours nor meshes.  threads 0: as many as
 * there are processors.  verb_given: the verb stood there by name.  gap: AS_GIVEN
 * when the option was not; thickness: 0 likewise. */
typedef struct il_options {
    il_action action;
    il_verb verb;
    bool verb_given;
    const char **input;
    size_t n_inputs, cap_inputs;
    const il_reader *from;
    const il_writer *to;
    const char *output, *pairs, *json_path;
    const char *links, *links_out;  /* of --links and --links-out */
    const char **pattern;       /* of --roi and --stack, in order: see cli/select.h */
    size_t n_patterns, cap_patterns;
    bool json, quiet, verbose, strict, convert_unit, groups_by_slab, list, ras;
    il_unit to_unit;
    il_read_options read;
    bool has_keyhole;
    double keyhole;             /* tolerance in the unit of the stacks, 0: off */
    il_cap cap;
    int between;                /* IL_BETWEEN_AUTO, or from 0 to IL_BETWEEN_MOST */
    il_gap_mode gap;
    double thickness;
    il_relief_options relief;   /* threads and what comes of the formats and of --frame's file: see pipeline.c */
    const char *frame_file;     /* of IL_FRAME_OUTLINE */
    il_picture_options picture;
    double join;                /* how far apart ends of lines may be that are joined, in the unit of the stacks */
    il_matcher matcher;
    il_pieces_mode pieces;
    bool keep_lattices;
    int threads;
    il_when progress;
    uint64_t given;             /* bit k: row k of il_option_table was given */
} il_options;

void il_options_init(il_options *o);
void il_options_free(il_options *o);

/* Read ARGV[1..ARGC) into *O, which is initialised.  IL_E_USAGE when it makes
 * no sense, IL_E_NOMEM. */
il_status il_options_parse(il_options *o, int argc, char **argv, il_error *err);

typedef enum il_option_kind {
    IL_OPTION_SWITCH,           /* --NAME, --no-NAME */
    IL_OPTION_VALUE,            /* --NAME ARG, --NAME=ARG */
    IL_OPTION_VALUE_OR_NO,      /* likewise, and --no-NAME */
    IL_OPTION_MAYBE,            /* --NAME, --NAME=ARG, --no-NAME */
    IL_OPTION_ACTION            /* --NAME */
} il_option_kind;

/* One row an option.  letter: 0 when it has none.  verbs: bit v for each verb
 * that takes it.  help: the line of the long help; brief: that of the first
 * screen, null to leave it out there.  set: VALUE is null when there is none;
 * ON is false for the --no- form. */
typedef struct il_option {
    char letter;
    const char *name, *argument;
    il_option_kind kind;
    unsigned verbs;
    const char *brief, *help;
    il_status (*set)(il_options *o, const char *value, bool on, il_error *err);
} il_option;

/* Was the option called NAME, one of the table, given? */
bool il_options_given(const il_options *o, const char *name);

extern const il_option il_option_table[];   /* ends with a null name */

const char *il_verb_name(il_verb v);

#endif
