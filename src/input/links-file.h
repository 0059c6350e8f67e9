/* links-file.h - which rings belong together, from a file that people edit (formats/links.txt). */
#ifndef IL_INPUT_LINKS_FILE_H
#define IL_INPUT_LINKS_FILE_H

#include "base/source.h"
#include "model/given.h"

/* Read all of SOURCE, lines of at most MAX_LINE bytes.  *OUT is empty after failure; IL_E_INPUT
 * names the file and the line. */
il_status il_links_file_read(il_given *out, il_source *source, size_t max_line, il_error *err);

#endif
