/* links.h - which rings belong together, as a file that people edit (formats/links.txt). */
#ifndef IL_OUTPUT_LINKS_H
#define IL_OUTPUT_LINKS_H

#include "base/output.h"
#include "model/report.h"
#include "model/sink.h"

/* A sink that writes the links of the pairs it is shown to TO (borrowed) and takes nothing.
 * Records that name no groups and no deformation have none to write, which is told in REPORT
 * (borrowed). */
il_status il_links_writer_new(il_sink **out, il_output *to, il_report *report, il_error *err);
void il_links_writer_free(il_sink *s); /* null is fine */

#endif
