#include "config.h"
#include "slabs.h"
#include "base/number.h"
#include "region/clean.h"
#include "test.h"

#include <math.h>

void add_ellipse(il_slice *s, double x, double y, double a, double b, size_t n)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (size_t i = 0; i < n; i++) {
        double angle = 6.283185307179586 * (double)i / (double)n;
        assert_true(il_ring_add(r, x + a * cos(angle), y + b * sin(angle), 0));
    }
}

void add_circle(il_slice *s, double x, double y, double r, size_t n)
{
    add_ellipse(s, x, y, r, r, n);
}

il_slice circle(double z, double x, double y, double r, size_t n)
{
    il_slice s = IL_SLICE_INIT;
    s.z = z;
    add_circle(&s, x, y, r, n);
    return s;
}

il_slice clean_slice(const il_slice *s, bool round_float)
{
    il_clean_options c = { .round_float = round_float };
    il_slice clean = IL_SLICE_INIT;
    assert_int_equal(il_slice_copy(&clean, s, NULL), IL_OK);
    assert_int_equal(il_slice_clean(&clean, &c, NULL, NULL, NULL), IL_OK);
    clean.z = round_float ? il_number_round_float(clean.z) : clean.z;
    return clean;
}

test_slab new_slab(const il_slice slice[2], bool round_float)
{
    test_slab t = { .slab = IL_SLAB_INIT };
    il_error err = IL_ERROR_INIT;
    for (int side = 0; side < 2; side++) {
        il_slice clean = clean_slice(&slice[side], round_float);
        assert_int_equal(il_section_from_slice(&t.section[side], &clean, &err), IL_OK);
        il_slice_free(&clean);
    }
    assert_int_equal(il_slab_loft(&t.slab, &t.section[0], &t.section[1], NULL, round_float, &err), IL_OK);
    assert_int_equal(il_slab_follow(&t.slab, &t.section[0], &t.section[1], &err), IL_OK);
    for (int side = 0; side < 2; side++)
        assert_int_equal(il_lean_measure(&t.slab.lean[side], &t.slab.surface, &t.section[0], &t.section[1], side, &err), IL_OK);
    return t;
}

void free_slab(test_slab *t)
{
    il_section_free(&t->section[0]);
    il_section_free(&t->section[1]);
    il_slab_free(&t->slab);
}
