/* fuzz_loft.c - whatever the bytes, the native reader refuses them with a
 * sentence, or what it read is written in a form that reads back to itself. */
#include "config.h"
#include "input/reader.h"
#include "output/writer.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void must(int holds, const char *what, const il_error *err)
{
    if (holds)
        return;
    fprintf(stderr, "%s: %s\n", what, err->text);
    abort();
}

/* Read N bytes at DATA and write them; null when they are refused. */
static il_output *rewrite(const void *data, size_t n, il_error *err)
{
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_source *source = NULL;
    il_output *out = NULL;
    il_sink *writer = NULL;
    il_status st = il_source_from_memory(&source, data, n, "bytes", err);
    if (st == IL_OK)
        st = il_output_to_memory(&out, err);
    if (st == IL_OK)
        st = il_writer_loft.contours_new(&writer, out, err);
    if (st == IL_OK)
        st = il_reader_loft.read(&source, 1, &options, writer, NULL, err);
    il_writer_loft.contours_free(writer);
    il_source_close(source);
    if (st == IL_OK)
        return out;
    must(st == IL_E_INPUT && err->code == st && err->text[0], "refused without a reason", err);
    il_output_discard(out);
    return NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    il_error err = IL_ERROR_INIT;
    il_output *once = rewrite(data, n, &err);
    if (!once)
        return 0;
    size_t n_once, n_twice;
    const unsigned char *first = il_output_memory(once, &n_once);
    il_output *twice = rewrite(first, n_once, &err);
    must(twice != NULL, "the canonical form is refused", &err);
    const unsigned char *second = il_output_memory(twice, &n_twice);
    must(n_once == n_twice && memcmp(first, second, n_once) == 0, "the canonical form is not a fixed point", &err);
    il_output *cut = rewrite(first, n_once - strlen("end\n"), &err);
    must(cut == NULL, "a cut stream is accepted", &err);
    il_output_discard(once);
    il_output_discard(twice);
    return 0;
}
