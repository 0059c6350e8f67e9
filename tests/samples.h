/* samples.h - the samples of a format's specification as test cases: each is read
 * as `isoloft read` does, reader, cleaning, joining, native writer. */
#ifndef IL_TESTS_SAMPLES_H
#define IL_TESTS_SAMPLES_H

#include "input/reader.h"
#include "test.h"

#include <stdbool.h>

/* Samples of one reader: FOLDER/valid and FOLDER/invalid below formats/, names
 * ending in EXTENSION; beside each NAME.loft or NAME.error.  options: what the
 * sample asks for, null for the defaults.  foreign: "FILE:LINE" and these words
 * begin messages whose rest is a library's, null for none.  essential: how many
 * bytes of a sample have to be there, lest it be refused; null for all. */
typedef struct samples {
    const char *folder, *extension;
    const il_reader *reader;
    il_read_options (*options)(const char *text);
    const char *foreign;
    size_t (*essential)(const char *text);
} samples;

/* Run the cases of all N kinds, and that of the specification SPEC (a name below
 * formats/, without .txt): every sample [x_...] that it names is there, and every
 * MUST behind FIRST is followed by one before its paragraph ends. */
int samples_run(const samples *kind, size_t n, const char *spec, const char *first);

/* For `essential`: up to the end of the first value of JSON.  That another behind it is
 * not there is not missed. */
size_t samples_json_value(const char *text);

#endif
