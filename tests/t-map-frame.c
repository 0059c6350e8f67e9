/* t-map-frame.c - the edge of a map and the ends of lines, against plain rules. */
#include "config.h"
#include "base/alloc.h"
#include "contours.h"
#include "terrain/frame.h"

enum { LEVELS = 8 };

/* Two lines that make the box of a map. */
#define CORNERS "o0 0, 1 0, 0 1;o100 100, 99 100, 100 99"

/* ---- plain rules -------------------------------------------------------------- */

static bool has_vertex(const il_frame *f, const double *p)
{
    for (size_t r = 0; r < f->rings.n; r++)
        for (size_t k = 0; k < f->rings.ring[r].n; k++)
            if (same_place(f->rings.ring[r].xy + 2 * k, p))
                return true;
    return false;
}

/* WAY, x y x y, meets the line from A to B at most where both end. */
static void assert_is_free(const double *way, const double *a, const double *b)
{
    double edge[4] = { a[0], a[1], b[0], b[1] };
    assert_false(edges_meet(way, edge));
    assert_false(lies_on(a, way, way + 2) && !same_place(a, way) && !same_place(a, way + 2));
}

static const double *end_of(const il_slice *level, const il_frame_end *e)
{
    const il_ring *r = &level[e->level].ring[e->ring];
    return r->xy + (e->last ? 2 * r->n - 2 : 0);
}

static void check_ways(const il_frame *f, const il_slice *level, size_t n_levels)
{
    for (size_t i = 0; i < f->n_ends; i++) {
        const il_frame_end *e = &f->end[i];
        const double *p = end_of(level, e);
        double way[4] = { p[0], p[1], e->foot[0], e->foot[1] };
        assert_true(level[e->level].ring[e->ring].open);
        assert_true(has_vertex(f, e->foot));
        if (i > 0) {
            const il_frame_end *d = e - 1;
            assert_true(d->level < e->level || (d->level == e->level && (d->ring < e->ring || (d->ring == e->ring && !d->last && e->last))));
        }
        if (same_place(p, e->foot))
            continue;
        for (size_t l = 0; l < n_levels; l++)
            for (size_t r = 0; r < level[l].n; r++)
                for (size_t k = 0; k + 1 < level[l].ring[r].n + !level[l].ring[r].open; k++)
                    assert_is_free(way, level[l].ring[r].xy + 2 * k, level[l].ring[r].xy + 2 * ((k + 1) % level[l].ring[r].n));
        for (size_t j = 0; j < i; j++) {
            const double *q = end_of(level, &f->end[j]);
            assert_true(!same_place(f->end[j].foot, e->foot) || f->end[j].level == e->level);
            if (!same_place(q, f->end[j].foot))
                assert_is_free(way, q, f->end[j].foot);
        }
    }
}

/* The rings cross nowhere and have the map on their left. */
static void check_rings(const il_frame *f)
{
    size_t n;
    double *e = edges_of(&f->rings, &n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            assert_false(edges_meet(e + 4 * i, e + 4 * j));
    free(e);
    double sum = 0;
    for (size_t r = 0; r < f->rings.n; r++) {
        assert_true(f->rings.ring[r].n > 2);
        sum += il_ring_area2(&f->rings.ring[r]);
    }
    assert_true(sum > 0);
}

/* ---- maps as text ---------------------------------------------------------------- */

/* Level by level, "|" between them; lines are open but those that begin with "o". */
static size_t map_of(const char *s, il_slice level[LEVELS])
{
    size_t n = 0;
    char one[CONTOURS_TEXT];
    while (*s) {
        size_t length = strcspn(s, "|");
        assert_true(n < LEVELS && length < sizeof one);
        level[n] = (il_slice)IL_SLICE_INIT;
        level[n].z = (double)n;
        for (const char *p = s; p < s + length; p += p < s + length && *p == ';') {
            size_t m = strcspn(p, ";|");
            bool closed = *p == 'o';
            memcpy(one, p + closed, m - closed);
            one[m - closed] = '\0';
            il_slice line = slice_of(one);
            il_ring *r = il_slice_add_ring(&level[n]);
            *r = line.ring[0];
            r->open = !closed;
            il_free(line.ring);
            p += m;
        }
        s += length + (s[length] == '|');
        n++;
    }
    return n;
}

static void free_map(il_slice *level, size_t n)
{
    for (size_t k = 0; k < n; k++)
        il_slice_free(&level[k]);
}

/* The frame of MAP as text; then each end as "level ring first|last foot". */
static char *frame_text(const char *map, const il_frame_options *o, char *to)
{
    il_slice level[LEVELS];
    size_t n = map_of(map, level), used;
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
    il_frame f;
    il_error err = IL_ERROR_INIT;
    if (il_frame_make(&f, o, &head, level, n, &err) != IL_OK) {
        snprintf(to, CONTOURS_TEXT, "%s", err.text);
        free_map(level, n);
        return to;
    }
    check_rings(&f);
    check_ways(&f, level, n);
    used = strlen(slice_text(&f.rings, to));
    for (size_t k = 0; k < f.n_ends; k++)
        used += (size_t)snprintf(to + used, CONTOURS_TEXT - used, " | %u %u %s %.10g %.10g", f.end[k].level, f.end[k].ring,
                                 f.end[k].last ? "last" : "first", f.end[k].foot[0], f.end[k].foot[1]);
    il_frame_free(&f);
    il_frame_free(&f);
    free_map(level, n);
    return to;
}

static void assert_frame(const char *map, const char *expected)
{
    char text[CONTOURS_TEXT];
    il_frame_options o = { .kind = IL_FRAME_BBOX };
    assert_string_equal(frame_text(map, &o, text), expected);
}

/* ---- boxes ------------------------------------------------------------------------- */

static void lines_that_end_on_the_box_are_led_nowhere(void **state)
{
    (void)state;
    assert_frame("0 2, 5 3, 10 4|4 0, 5 10", "0 0, 4 0, 10 0, 10 4, 10 10, 5 10, 0 10, 0 2"
                 " | 0 0 first 0 2 | 0 0 last 10 4 | 1 0 first 4 0 | 1 0 last 5 10");
}

static void all_vertices_on_the_box_are_vertices_of_it(void **state)
{
    (void)state;
    assert_frame("o0 5, 5 0, 10 5, 5 10", "0 0, 5 0, 10 0, 10 5, 10 10, 5 10, 0 10, 0 5");
    assert_frame("o0 0, 3 0, 10 0, 10 10, 0 10, 0 7", "0 0, 3 0, 10 0, 10 10, 0 10, 0 7");
}

static void ends_near_the_box_are_led_to_it(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 50, 98.5 40|3 70, 50 70, 50 99",
                 "0 0, 1 0, 100 0, 100 40, 100 99, 100 100, 99 100, 50 100, 0 100, 0 50, 0 1"
                 " | 1 0 first 0 50 | 1 0 last 100 40 | 2 0 last 50 100");
}

static void ends_on_the_box_but_for_rounding_lead_it_through_them(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1e-8 50, 50 50, 50 0.00000001", "0 0, 1 0, 50 1e-08, 100 0, 100 99, 100 100, 99 100, 0 100, 1e-08 50, 0 1"
                 " | 1 0 first 1e-08 50 | 1 0 last 50 1e-08");
    assert_frame("o5 0, 100 0, 100 100, 0 100, 0 5|1e-8 2e-8, 50 50", "5 0, 100 0, 100 100, 0 100, 0 5, 1e-08 2e-08"
                 " | 1 0 first 1e-08 2e-08");
}

static void a_way_that_crosses_a_line_is_none(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 50|0.5 10, 0.5 90",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 90, 0 10, 0 1 | 2 0 first 0 10 | 2 0 last 0 90");
}

/* The second line ends behind the first, the third on the frame where the first would be led. */
static void ends_of_two_levels_come_to_two_places(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 40|2 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50.33333333, 0 50, 0 1 | 1 0 first 0 50 | 2 0 first 0 50.33333333");
    assert_frame(CORNERS "|1 50, 50 50|0 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50, 0 49.83333333, 0 1 | 1 0 first 0 49.83333333 | 2 0 first 0 50");
}

static void ends_of_one_level_may_share_a_place(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 50;0 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50, 0 1 | 1 0 first 0 50 | 1 1 first 0 50");
}

static void a_map_without_area_is_refused(void **state)
{
    (void)state;
    assert_frame("1 1, 5 1", "the lines of the map lie on one straight line: there is no ground between them");
    assert_frame("", "the map has no lines");
}

/* ---- many random lines --------------------------------------------------------------- */

static void add_line(il_slice *level, uint64_t *seed)
{
    il_ring *r = il_slice_add_ring(level);
    double x = 100 * stack_uniform(seed), y = 100 * stack_uniform(seed);
    r->open = stack_random(seed) % 4 > 0;
    for (uint64_t k = 3 + stack_random(seed) % 5; k > 0; k--) {
        assert_true(il_ring_add(r, x, y, 0));
        x = fmin(fmax(x + 30 * stack_uniform(seed) - 15, 0), 100);
        y = fmin(fmax(y + 30 * stack_uniform(seed) - 15, 0), 100);
    }
}

static void whatever_the_lines_ways_cross_nothing(void **state)
{
    (void)state;
    size_t n_led = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t random = seed;
        il_slice level[3] = { IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT };
        for (int k = 0; k < 40; k++)
            add_line(&level[k % 3], &random);
        il_frame_options o = { .kind = IL_FRAME_BBOX };
        il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
        il_frame f;
        assert_int_equal(il_frame_make(&f, &o, &head, level, 3, NULL), IL_OK);
        check_rings(&f);
        check_ways(&f, level, 3);
        for (size_t k = 0; k < f.n_ends; k++)
            n_led += !same_place(end_of(level, &f.end[k]), f.end[k].foot);
        il_frame_free(&f);
        free_map(level, 3);
    }
    assert_true(n_led > 50);
}

static void memory_may_run_out_anywhere(void **state)
{
    (void)state;
    il_slice level[LEVELS];
    size_t n = map_of(CORNERS "|1 50, 50 40|2 50, 50 70", level);
    il_frame_options o = { .kind = IL_FRAME_BBOX };
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st != IL_OK && k < 1000; k++) {
        il_frame f;
        il_alloc_test_fail_after(k);
        st = il_frame_make(&f, &o, &head, level, n, NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
        il_frame_free(&f);
    }
    assert_true(k > 10 && st == IL_OK);
    free_map(level, n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_that_end_on_the_box_are_led_nowhere),
        cmocka_unit_test(all_vertices_on_the_box_are_vertices_of_it),
        cmocka_unit_test(ends_near_the_box_are_led_to_it),
        cmocka_unit_test(ends_on_the_box_but_for_rounding_lead_it_through_them),
        cmocka_unit_test(a_way_that_crosses_a_line_is_none),
        cmocka_unit_test(ends_of_two_levels_come_to_two_places),
        cmocka_unit_test(ends_of_one_level_may_share_a_place),
        cmocka_unit_test(a_map_without_area_is_refused),
        cmocka_unit_test(whatever_the_lines_ways_cross_nothing),
        cmocka_unit_test(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
