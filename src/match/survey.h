/* survey.h - how the rings of each stack are linked, in figures and words. */
#ifndef IL_MATCH_SURVEY_H
#define IL_MATCH_SURVEY_H

#include "model/report.h"
#include "model/sink.h"

/* A link with the reason JOIN that reaches farther than its slab, from z = below to above, is high. */
typedef struct il_guess {
    double below, above;
    il_link link;
} il_guess;

/* Of one stack.  n_by[reason]: links.  parts: into how many separate ones the links leave its outer
 * rings; 0 when some record does not tell.  pairs: records without gaps.  joined: the middle one of
 * the joins' reaches, in heights of their slabs, 0 without joins.  undersampled: the slices are
 * too far apart for what is in them, so that much is guessed. */
typedef struct il_link_facts {
    size_t n_by[IL_N_LINK_REASONS];
    size_t pairs, parts;
    double joined;
    bool undersampled;
    il_guess *guess;        size_t n_guesses, cap_guesses;
} il_link_facts;

#define IL_LINK_FACTS_INIT { { 0 }, 0, 0, 0, false, NULL, 0, 0 }
void il_link_facts_free(il_link_facts *f); /* safe twice */

/* Slices too far apart: at least so many joins, which are more than a third of all links, and
 * reach farther than so many heights in the middle.  Measured on two trees of vessels: at 10 and
 * 20 slices, where one link in two to eight is false, this holds, and at 40, where one in fifty
 * is, it does not. */
enum { IL_JOINS_TOLD = 5 };
#define IL_JOINED_MOST 0.3

/* A sink that fills *FACTS (borrowed) with those of the stack it is shown, complete when that ends
 * and empty when the next begins, and says in REPORT (borrowed) what the user has to know.  hints:
 * a stack of vessels in parts is told what option helps.  It takes nothing. */
il_status il_survey_new(il_sink **out, bool hints, il_link_facts *facts, il_report *report, il_error *err);
void il_survey_free(il_sink *s); /* null is fine */

#endif
