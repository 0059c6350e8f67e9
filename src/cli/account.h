/* account.h - what became of each stack, collected while it passes by.
 *
 * Two taps in the pipeline, one among the contours right before the last stage
 * and one among the meshes right behind the lofter, fill one record a stack. */
#ifndef IL_CLI_ACCOUNT_H
#define IL_CLI_ACCOUNT_H

#include "cli/message.h"
#include "cli/sections.h"
#include "cli/slicing.h"
#include "cli/terrain.h"
#include "match/survey.h"
#include "model/mesh.h"
#include "model/report.h"
#include "model/sink.h"
#include "model/spacing.h"
#include "terrain/frame.h"
#include "terrain/law.h"

/* Two neighbouring slices much farther apart than is usual in their stack, or with
 * a gap record.  capped: nothing joins them. */
typedef struct il_gap {
    double below, above;
    bool capped;
} il_gap;

/* Lengths in the stack's unit.  name: UTF-8 as the input has it.  box: least
 * x, y, z and greatest x, y, z; least > greatest when there is no vertex.  Slices
 * of solids of inserted vertices alone count for the box and the surface only, unless there
 * are no others.
 * set_spacing: usual in the set that the stack came from, 0 unknown.  type,
 * algorithm, frame_uid: of an ROI, or null.  planes: where slices lie otherwise
 * than across z, in words, or null.  seconds: from when the
 * reader hands over the stack's beginning until its surface is done, wall-clock.
 * has_mesh: facts were given, so the surface is certified.  file: what it was
 * written to in a folder, or null.  error: one line, null unless it failed.
 * is_terrain: its slices are levels, and its rings lines; terrain tells of them, and
 * there are no gaps and no sections.  links: where its slices were matched.  frame, law, mesh_unit, placement: of its mesh. */
typedef struct il_stack_account {
    char *name, *type, *algorithm, *frame_uid, *file, *error;
    const char *planes;
    bool has_number, has_color, has_mesh, is_terrain;
    long number;
    unsigned char color[3];
    il_unit unit;
    size_t slices, rings, points;
    double box[6];
    il_spacing spacing;
    double set_spacing;
    il_sections sections;
    il_link_facts links;
    il_terrain terrain;
    double seconds;
    il_gap *gap;        size_t n_gaps, cap_gaps;
    il_report report;
    il_mesh_facts facts;
    il_frame_kind frame;
    il_law_kind law;
    il_unit mesh_unit;
    il_placement placement;
    il_status status;
} il_stack_account;

/* keep_going: a stack without a surface does not end the run.  strict: a stack
 * that was repaired, or that something of was skipped, fails.  empty_allowed: a
 * run without any stack is no failure.  input: the name for errors that know
 * none, null when there are several.  note_on_solids, note_on_terrain: a sentence that each
 * stack of that kind gets, or null.  no_unit: what is written says nothing of the unit,
 * which meshes of maps in metres are told.  frame, law: of maps.  file_of: names the file of the stack that
 * has just ended, null when there is none. */
typedef struct il_account_options {
    bool keep_going, strict, empty_allowed;
    bool no_unit;
    il_frame_kind frame;
    il_law_kind law;
    const char *input, *note_on_solids, *note_on_terrain;
    il_voice *voice;
    const char *(*file_of)(void *self);
    void *file_of_self;
} il_account_options;

/* report: for all stages to count into; what is in it goes to the stack that
 * ends next.  rounding: that of the stage that rounds for STL, which cleans what
 * is clean already.  slicing, inserted_...: of the current stack, and how much of
 * its slices isoloft put there (il_slice_is_inserted).  links: of the current stack, for a survey to
 * fill (match/survey.h).  skipping: it has failed,
 * and what still comes of it is dropped.
 * began: when the current stack did, for a stopwatch to set (0: at the tap).
 * worst: the highest code of any stack. */
typedef struct il_account {
    il_sink contours;
    il_mesh_sink meshes;
    il_sink *next;
    il_mesh_sink *next_mesh;
    il_account_options options;
    il_report report, rounding;
    il_stack_account *stack;    size_t n, cap;
    il_slicing slicing;
    size_t inserted_slices, inserted_rings, inserted_points;
    il_link_facts links;
    bool in_stack, in_mesh, skipping;
    double began;
    size_t n_triangles;
    il_status worst;
} il_account;

void il_account_init(il_account *a, const il_account_options *o);
void il_account_free(il_account *a);

/* Sum of the slices' areas times the usual spacing, unit^3, that of the set for
 * a single slice; NAN where there is none. */
double il_stack_account_slice_sum(const il_stack_account *s);

/* The taps, in front of NEXT (borrowed). */
il_sink *il_account_contours(il_account *a, il_sink *next);
il_mesh_sink *il_account_meshes(il_account *a, il_mesh_sink *next);

/* The run is over with ST: a stack that is still open failed with it. */
void il_account_close(il_account *a, il_status st, const il_error *err);

/* For the lofter's progress callback; SELF is the account. */
void il_account_progress(void *self, size_t slabs_done);

#endif
