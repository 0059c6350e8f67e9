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
            assert_true(d->level < e->level || (d->level == e->level && (d->ring < e->ring || (d->ring == e->ring && e->last > d->last))));
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

/* The frame of MAP as text; then each end as "level ring first|last foot|inside". */
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
    for (size_t k = 0; k < f.n_inside; k++)
        used += (size_t)snprintf(to + used, CONTOURS_TEXT - used, " | %u %u %s inside", f.inside[k].level, f.inside[k].ring,
                                 f.inside[k].last ? "last" : "first");
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
                 " | 1 0 first 0 50 | 1 0 last 100 40 | 2 0 last 50 100 | 2 0 first inside");
}

static void ends_on_the_box_but_for_rounding_lead_it_through_them(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1e-8 50, 50 50, 50 0.00000001", "0 0, 1 0, 50 1e-08, 100 0, 100 99, 100 100, 99 100, 0 100, 1e-08 50, 0 1"
                 " | 1 0 first 1e-08 50 | 1 0 last 50 1e-08");
    assert_frame("o5 0, 100 0, 100 100, 0 100, 0 5|1e-8 2e-8, 50 50", "5 0, 100 0, 100 100, 0 100, 0 5, 1e-08 2e-08"
                 " | 1 0 first 1e-08 2e-08 | 1 0 last inside");
}

static void a_way_that_crosses_a_line_is_none(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 50|0.5 10, 0.5 90",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 90, 0 10, 0 1"
                 " | 2 0 first 0 10 | 2 0 last 0 90 | 1 0 first inside | 1 0 last inside");
}

/* The second line ends behind the first, the third on the frame where the first would be led. */
static void ends_of_two_levels_come_to_two_places(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 40|2 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50.33333333, 0 50, 0 1 | 1 0 first 0 50 | 2 0 first 0 50.33333333"
                 " | 1 0 last inside | 2 0 last inside");
    assert_frame(CORNERS "|1 50, 50 50|0 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50, 0 49.83333333, 0 1 | 1 0 first 0 49.83333333 | 2 0 first 0 50"
                 " | 1 0 last inside | 2 0 last inside");
}

static void ends_of_one_level_may_share_a_place(void **state)
{
    (void)state;
    assert_frame(CORNERS "|1 50, 50 50;0 50, 50 70",
                 "0 0, 1 0, 100 0, 100 99, 100 100, 99 100, 0 100, 0 50, 0 1 | 1 0 first 0 50 | 1 1 first 0 50"
                 " | 1 0 last inside | 1 1 last inside");
}

static void a_map_without_area_is_refused(void **state)
{
    (void)state;
    assert_frame("1 1, 5 1", "the lines of the map enclose nothing: they lie on one straight line");
    assert_frame("", "the map has no lines");
}

/* ---- hulls --------------------------------------------------------------------------- */

static void assert_frame_of(const char *map, const il_frame_options *o, const char *expected)
{
    char text[CONTOURS_TEXT];
    assert_string_equal(frame_text(map, o, text), expected);
}

static void a_hull_passes_all_vertices_on_it(void **state)
{
    (void)state;
    il_frame_options o = { .kind = IL_FRAME_HULL };
    assert_frame_of("o0 0, 4 0, 8 0, 4 4|0 3, 3 1, 2 3|4 4.01, 4 6", &o,
                    "0 0, 4 0, 8 0, 4 6, 0 3 | 1 0 first 0 3 | 2 0 last 4 6 | 1 0 last inside | 2 0 first inside");
    assert_frame_of("0 0, 1 1, 3 3", &o, "the lines of the map enclose nothing: they lie on one straight line");
}

static void a_hull_holds_every_vertex(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        uint64_t random = seed;
        il_slice level = IL_SLICE_INIT;
        il_ring *r = il_slice_add_ring(&level);
        for (int k = 0; k < 300; k++) { /* grids have many places in a row */
            double x = (double)(stack_random(&random) % 30), y = (double)(stack_random(&random) % 30);
            assert_true(il_ring_add(r, seed % 2 ? x : 0.1 * (x + 0.7 * y), y, 0));
        }
        il_frame_options o = { .kind = IL_FRAME_HULL };
        il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
        il_frame f;
        assert_int_equal(il_frame_make(&f, &o, &head, &level, 1, NULL), IL_OK);
        check_rings(&f);
        for (size_t v = 0; v < r->n; v++) {
            bool is_on = has_vertex(&f, r->xy + 2 * v);
            const il_ring *h = &f.rings.ring[0];
            for (size_t k = 0; k < h->n; k++) {
                int side = il_orientation(h->xy + 2 * k, h->xy + 2 * ((k + 1) % h->n), r->xy + 2 * v);
                assert_true(side > 0 || (side == 0 && is_on));
            }
        }
        il_frame_free(&f);
        il_slice_free(&level);
    }
}

/* ---- outlines -------------------------------------------------------------------------- */

/* Where the outline bends away from the map (4 4), the nearest place of many ends is the corner. */
static void ends_are_led_to_outlines_from_inside(void **state)
{
    (void)state;
    il_slice outline = slice_of("0 0, 100 0, 100 100, 0 100; 40 40, 40 60, 60 60, 60 40");
    il_frame_options o = { .kind = IL_FRAME_OUTLINE, .outline = &outline };
    assert_frame_of("1 50, 39 50|50 101, 50 61|45 50, 55 50|-1 20, 5 20|39.5 39, 20 20", &o,
                    "0 0, 100 0, 100 100, 0 100, 0 50; 40 40, 40 50, 40 60, 50 60, 60 60, 60 40"
                    " | 0 0 first 0 50 | 0 0 last 40 50 | 1 0 last 50 60 | 4 0 first 40 40 | 3 0 last inside | 4 0 last inside");
    assert_frame_of("200 200, 300 300", &o, "the outline lies beside the map");
    o.in_degrees = true;
    assert_frame_of("1 50, 39 50", &o, "the outline is in degrees and the map in m, of which nobody knows how they were projected");
    il_slice_free(&outline);
    outline = slice_of("0 0, 5 5, 10 10");
    assert_frame_of("1 50, 39 50", &(il_frame_options){ .kind = IL_FRAME_OUTLINE, .outline = &outline }, "the outline encloses nothing");
    il_slice_free(&outline);
}

/* ---- degrees ------------------------------------------------------------------------------ */

static const il_projection utm32 = { IL_PROJECTION_TM, IL_ELLIPSOID_WGS84, 9, 0, 0.9996, 500000, 0, true, false };
static const il_projection ups = { IL_PROJECTION_STEREOGRAPHIC, IL_ELLIPSOID_WGS84, 0, 0, 0.994, 2e6, 2e6, true, false };

/* Lines in the box of degrees G that begin or end on its sides, or touch them, by P; one of
 * them runs along each side. */
static il_slice sheet_of(const double g[4], const il_projection *p, double scale, uint64_t seed)
{
    il_slice s = IL_SLICE_INIT;
    for (int line = 0; line < 60; line++) {
        il_ring *r = il_slice_add_ring(&s);
        r->open = line % 3 > 0;
        for (int k = 0; k < 6; k++) {
            double u = stack_uniform(&seed), v = stack_uniform(&seed), q[2] = { g[0] + u * (g[2] - g[0]), g[1] + v * (g[3] - g[1]) };
            int side = line < 4 ? line : (int)(stack_random(&seed) % 4);
            if (k == 0 || k == 5 || line < 4)
                q[side % 2] = g[side];
            assert_int_equal(il_project_points(p, q, 1, NULL), IL_OK);
            assert_true(il_ring_add(r, q[0] * scale, q[1] * scale, 0));
        }
    }
    return s;
}

static void check_sheet(const double g[4], const il_projection *p, il_unit unit)
{
    double scale = 1 / il_unit_metres(unit);
    il_slice s = sheet_of(g, p, scale, 3);
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = unit, .has_geographic = true, .projection = *p };
    memcpy(head.geographic, g, sizeof head.geographic);
    il_frame_options o = { .kind = IL_FRAME_BBOX };
    il_frame f;
    size_t n;
    assert_int_equal(il_frame_make(&f, &o, &head, &s, 1, NULL), IL_OK);
    check_rings(&f);
    double *e = edges_of(&f.rings, &n);
    assert_true(n > 100 && n < 1000);
    assert_int_equal(f.n_ends, 2 * 40);
    for (size_t k = 0; k < f.n_ends; k++)
        assert_true(same_place(end_of(&s, &f.end[k]), f.end[k].foot));
    for (size_t i = 0; i < s.n; i++)
        for (size_t k = 0; k < s.ring[i].n; k++)
            assert_true(has_vertex(&f, s.ring[i].xy + 2 * k) || is_inside(e, n, s.ring[i].xy[2 * k], s.ring[i].xy[2 * k + 1]));
    free(e);
    il_frame_free(&f);
    il_slice_free(&s);
}

static void a_box_of_degrees_is_bent_and_holds_all_lines(void **state)
{
    (void)state;
    check_sheet((const double[]){ 9.5, 46, 10.25, 46.5 }, &utm32, IL_UNIT_M);
    check_sheet((const double[]){ 6.1, 46, 6.11, 46.02 }, &utm32, IL_UNIT_M);
    check_sheet((const double[]){ 6.1, 46, 6.11, 46.02 }, &utm32, IL_UNIT_FT);
    check_sheet((const double[]){ 4, -80, 14, 80 }, &utm32, IL_UNIT_KM);
    check_sheet((const double[]){ 160, 84, 200, 87 }, &ups, IL_UNIT_M);
    check_sheet((const double[]){ 10, 84, 130, 90 }, &ups, IL_UNIT_M);
}

/* The sides are straight between longitudes and latitudes, to a millionth of their length. */
static void chords_stray_little(void **state)
{
    (void)state;
    const double g[4] = { 9.5, 46, 10.25, 46.5 };
    il_slice s = sheet_of(g, &utm32, 1, 3);
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M, .has_geographic = true, .projection = utm32 };
    memcpy(head.geographic, g, sizeof head.geographic);
    il_frame f;
    il_frame_options o = { .kind = IL_FRAME_BBOX };
    assert_int_equal(il_frame_make(&f, &o, &head, &s, 1, NULL), IL_OK);
    const il_ring *r = &f.rings.ring[0];
    for (size_t k = 0; k < r->n; k++) {
        const double *a = r->xy + 2 * k, *b = r->xy + 2 * ((k + 1) % r->n);
        double q[2] = { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 };
        assert_int_equal(il_unproject_points(&utm32, q, 1, NULL), IL_OK);
        double off = fmin(fmin(fabs(q[0] - g[0]), fabs(q[0] - g[2])), fmin(fabs(q[1] - g[1]), fabs(q[1] - g[3])));
        assert_true(off < 1e-6);
    }
    il_frame_free(&f);
    il_slice_free(&s);
}

/* Behind the pole the sides of its box would meet. */
static void a_map_around_the_pole_has_a_box_of_the_plane(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 4e6 1e6, 4e6 4e6, 1e6 4e6");
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M, .has_geographic = true, .projection = ups,
                           .geographic = { -180, 70, 180, 90 } };
    il_frame f;
    char text[CONTOURS_TEXT];
    il_frame_options o = { .kind = IL_FRAME_BBOX };
    assert_int_equal(il_frame_make(&f, &o, &head, &s, 1, NULL), IL_OK);
    assert_string_equal(slice_text(&f.rings, text), "0 0, 4000000 0, 4000000 1000000, 4000000 4000000, 1000000 4000000, 0 4000000");
    il_frame_free(&f);
    il_slice_free(&s);
}

/* An outline in degrees, in whichever turn, is that of a map in degrees; where its lines end on it,
 * they end on it in the plane. */
static void an_outline_in_degrees_is_projected_like_the_map(void **state)
{
    (void)state;
    const double g[4] = { 9.5, 46, 10.25, 46.5 };
    il_slice s = sheet_of(g, &utm32, 1, 3), outline = slice_of("369.5 46, 370.25 46, 370.25 46.5, 369.5 46.5");
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M, .has_geographic = true, .projection = utm32 };
    memcpy(head.geographic, g, sizeof head.geographic);
    il_frame f;
    il_frame_options o = { .kind = IL_FRAME_OUTLINE, .outline = &outline, .in_degrees = true };
    assert_int_equal(il_frame_make(&f, &o, &head, &s, 1, NULL), IL_OK);
    check_rings(&f);
    assert_int_equal(f.n_ends, 2 * 40);
    for (size_t k = 0; k < f.n_ends; k++)
        assert_true(same_place(end_of(&s, &f.end[k]), f.end[k].foot));
    il_frame_free(&f);
    il_slice_free(&s);
    il_slice_free(&outline);
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
        il_frame_options o = { .kind = seed % 2 ? IL_FRAME_BBOX : IL_FRAME_HULL };
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
        cmocka_unit_test(a_hull_passes_all_vertices_on_it),
        cmocka_unit_test(a_hull_holds_every_vertex),
        cmocka_unit_test(ends_are_led_to_outlines_from_inside),
        cmocka_unit_test(a_box_of_degrees_is_bent_and_holds_all_lines),
        cmocka_unit_test(chords_stray_little),
        cmocka_unit_test(a_map_around_the_pole_has_a_box_of_the_plane),
        cmocka_unit_test(an_outline_in_degrees_is_projected_like_the_map),
        cmocka_unit_test(whatever_the_lines_ways_cross_nothing),
        cmocka_unit_test(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
