/* fuzz_links.c - whatever the bytes, a file of links is refused with a sentence, or what it says of
 * a stack is: refused with a sentence, or links between rings that there are, rising, each once. */
#include "config.h"
#include "input/links-file.h"
#include "match/given.h"
#include "must.h"

#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* As in formats/links/contours.loft: slices at 0, 5, 10 and, behind a gap, 30. */
enum { SLICES = 4 };
static double square[3][8] = { { 0, 0, 10, 0, 10, 10, 0, 10 }, { 14, 0, 20, 0, 20, 10, 14, 10 }, { 3, 3, 3, 6, 6, 6, 6, 3 } };
static il_ring rings[SLICES][2];
static const il_slice slices[SLICES] = { { .z = 0, .ring = rings[0], .n = 2 }, { .z = 5, .ring = rings[1], .n = 1 },
                                         { .z = 10, .ring = rings[2], .n = 2 }, { .z = 30, .ring = rings[3], .n = 1 } };

static void look_at(const il_linkage *l)
{
    for (size_t k = 0; k + 1 < SLICES; k++)
        for (size_t i = l->first[k]; i < l->first[k + 1]; i++) {
            const il_link *a = &l->link[i];
            must(a->lower < slices[k].n && a->upper < slices[k + 1].n && a->reach >= 0, "a link of no rings");
            must(i == l->first[k] || a[-1].lower < a->lower || (a[-1].lower == a->lower && a[-1].upper < a->upper), "out of order");
        }
}

static void apply(const il_given *g, const il_given_stack *s)
{
    const il_pair gap = { .gap = true }, *const known[SLICES] = { NULL, NULL, &gap, NULL };
    il_linkage l = IL_LINKAGE_INIT;
    il_error err = IL_ERROR_INIT;
    for (int k = 0; k < SLICES; k++)
        for (int i = 0; i < 2; i++)
            rings[k][i] = (il_ring){ .xy = square[i == 0 ? 0 : k == 0 ? 1 : 2], .n = 4 };
    il_status st = il_linkage_given(&l, slices, SLICES, known, g, s, &err);
    must(st == IL_OK || (st == IL_E_INPUT && err.text[0] && err.line > 0), "refused without a reason");
    if (st == IL_OK)
        look_at(&l);
    il_linkage_free(&l);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    il_source *source = NULL;
    il_given given = IL_GIVEN_INIT;
    il_error err = IL_ERROR_INIT;
    must(il_source_from_memory(&source, data, n, "bytes", &err) == IL_OK, "no source");
    il_status st = il_links_file_read(&given, source, 1 << 20, &err);
    il_source_close(source);
    must(st == IL_OK || (st == IL_E_INPUT && err.text[0]), "refused without a reason");
    for (size_t i = 0; i < given.n_stacks; i++)
        apply(&given, &given.stack[i]);
    il_given_free(&given);
    return 0;
}
