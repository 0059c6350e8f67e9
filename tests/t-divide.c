/* t-divide.c - groups that lie apart: a phi for each link, and the cuts between them. */
#include "config.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "couple.h"
#include "lofting.h"
#include "match/link.h"

static const double TURN = 6.283185307179586;

/* ---- slices and links by hand ---- */

/* A ring of N points about (X, Y), in the order that it is given; a hole with RX < 0. */
static void add_ellipse(il_slice *s, double x, double y, double rx, double ry, int n)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (int k = 0; k < n; k++)
        assert_true(il_ring_add(r, x + rx * cos(TURN * k / n), y + ry * sin(TURN * k / n), 0));
}

static couple new_couple(void)
{
    couple c = { { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT };
    c.slice[1].z = 1;
    return c;
}

static void add_circle(couple *c, int side, double x, double y, double radius)
{
    add_ellipse(&c->slice[side], x, y, radius, fabs(radius), 60);
}

enum { MOST = 8 };

static int compare_links(const void *p, const void *q)
{
    const il_link *a = p, *b = q;
    if (a->lower != b->lower)
        return a->lower < b->lower ? -1 : 1;
    return a->upper < b->upper ? -1 : a->upper > b->upper;
}

/* Both slices as a stream has them, and link[N], between the rings as they were added, as the linker gives them. */
static void put_in_order(couple *c, il_link *link, size_t n)
{
    uint32_t is[2][MOST];
    for (int side = 0; side < 2; side++) {
        il_slice was;
        assert_int_equal(il_slice_copy(&was, &c->slice[side], NULL), IL_OK);
        assert_true(was.n <= MOST);
        il_slice_put_in_order(&c->slice[side]);
        for (uint32_t r = 0; r < was.n; r++)
            for (uint32_t k = 0; k < was.n; k++)
                if (same_place(was.ring[r].xy + 2 * il_ring_first(&was.ring[r]), c->slice[side].ring[k].xy))
                    is[side][r] = k;
        il_slice_free(&was);
    }
    for (size_t i = 0; i < n; i++)
        link[i].lower = is[0][link[i].lower], link[i].upper = is[1][link[i].upper];
    qsort(link, n, sizeof *link, compare_links);
}

/* The groups that link[N] make of C, as the linker gives them. */
static void group(couple *c, const il_link *link, size_t n)
{
    il_link own[MOST];
    memcpy(own, link, n * sizeof *own);
    put_in_order(c, own, n);
    il_pair_free(&c->pair);
    assert_int_equal(il_link_group(&c->pair, &c->slice[0], &c->slice[1], own, n, NULL), IL_OK);
    assert_int_equal(il_link_slants(&c->pair, &c->slice[0], &c->slice[1], NULL), IL_OK);
    c->pair.linked = true;
}

static const il_match_options FFD = { IL_MATCHER_FFD, true, 1 };

static void divide(couple *c, const il_link *link, size_t n)
{
    il_ffd *solver = new_solver();
    group(c, link, n);
    assert_int_equal(il_match_slices(&c->slice[0], &c->slice[1], &FFD, solver, &c->pair, NULL), IL_OK);
    il_ffd_free(solver);
}

static const il_link near00 = { 0, 0, IL_LINK_NEAR, 1 }, near01 = { 0, 1, IL_LINK_NEAR, 1 }, near10 = { 1, 0, IL_LINK_NEAR, 1 },
                     near11 = { 1, 1, IL_LINK_NEAR, 1 };

/* ---- what holds of all ---- */

static void assert_rows_rise(const couple *c)
{
    const il_pair *p = &c->pair;
    size_t vertices = 0;
    for (size_t k = 0; k < p->n_phi; k++) {
        assert_true(p->phi[k].at.t >= 0 && p->phi[k].at.t < 1 && isfinite(p->phi[k].x) && isfinite(p->phi[k].y));
        assert_true(k == 0 || il_place_compare(&p->phi[k - 1].at, &p->phi[k].at) < 0);
        vertices += p->phi[k].at.t == 0;
    }
    assert_int_equal(vertices, il_slice_points(&c->slice[1]));
}

/* No two edges of the images cross, of one ring or of two. */
static void assert_images_do_not_cross(const couple *c)
{
    const il_pair *p = &c->pair;
    double *e = malloc((p->n_phi + 1) * 4 * sizeof *e);
    assert_non_null(e);
    for (size_t k = 0, first = 0; k < p->n_phi; k++) {
        bool last = k + 1 == p->n_phi || p->phi[k + 1].at.ring != p->phi[k].at.ring;
        const il_phi_point *a = &p->phi[k], *b = &p->phi[last ? first : k + 1];
        e[4 * k] = a->x, e[4 * k + 1] = a->y, e[4 * k + 2] = b->x, e[4 * k + 3] = b->y;
        first = last ? k + 1 : first;
    }
    for (size_t i = 0; i < p->n_phi; i++)
        for (size_t k = 0; k < i; k++) {
            const double *a = e + 4 * i, *b = a + 2, *q = e + 4 * k, *r = q + 2;
            if (il_orientation(a, b, q) * il_orientation(a, b, r) < 0 && il_orientation(q, r, a) * il_orientation(q, r, b) < 0)
                fail_msg("images of %u:%u and %u:%u cross", p->phi[i].at.ring, p->phi[i].at.vertex, p->phi[k].at.ring, p->phi[k].at.vertex);
        }
    free(e);
}

static double distance_to_slice(const il_slice *s, const double *p)
{
    double least = INFINITY;
    for (size_t r = 0; r < s->n; r++)
        for (size_t k = 0; k < s->ring[r].n; k++)
            least = fmin(least, distance_to_edge(p, s->ring[r].xy + 2 * k, s->ring[r].xy + 2 * ((k + 1) % s->ring[r].n)));
    return least;
}

/* Every cut of a region begins and ends on its outline, or where another cut ends. */
static void assert_cuts(const couple *c)
{
    const il_pair *p = &c->pair;
    for (size_t i = 0; i < p->n_cuts; i++) {
        const il_cut *t = &p->cut[i];
        const il_slice *s = &c->slice[t->upper];
        assert_true(t->ring < s->n && il_ring_area2(&s->ring[t->ring]) > 0 && t->n >= 2);
        if (t->xy[0] == t->xy[2 * t->n - 2] && t->xy[1] == t->xy[2 * t->n - 1])
            continue; /* round a cell in the midst of others */
        for (size_t end = 0; end < 2; end++) {
            const double *q = t->xy + (end ? 2 * t->n - 2 : 0);
            double off = distance_to_slice(s, q);
            for (size_t k = 0; k < p->n_cuts; k++)
                for (size_t v = 0; k != i && v + 1 < p->cut[k].n; v++)
                    off = fmin(off, distance_to_edge(q, p->cut[k].xy + 2 * v, p->cut[k].xy + 2 * v + 2));
            assert_near(off, 0, 2);
        }
    }
}

static bool is_divided(const couple *c)
{
    return c->pair.n_groups == 1 && c->pair.group[0].fitted && !has_one_fit(&c->pair.group[0]);
}

static void assert_divided(const couple *c, size_t n_cuts)
{
    assert_true(is_divided(c));
    assert_int_equal(c->pair.n_cuts, n_cuts);
    assert_record(c);
    assert_rows_rise(c);
    assert_images_do_not_cross(c);
    assert_cuts(c);
}

/* Largest distance of the images of upper ring R from the lower contours. */
static double image_off(const couple *c, uint32_t r)
{
    double most = 0;
    for (size_t k = 0; k < c->pair.n_phi; k++)
        if (c->pair.phi[k].at.ring == r)
            most = fmax(most, distance_to_slice(&c->slice[0], (const double[2]){ c->pair.phi[k].x, c->pair.phi[k].y }));
    return most;
}

/* ---- cases ---- */

/* One goes over into two: its image lies on both but for where it spans from one to the other. */
static void one_over_two(void **state)
{
    (void)state;
    couple c = new_couple();
    add_circle(&c, 0, -40, 0, 10), add_circle(&c, 0, 40, 0, 10), add_ellipse(&c.slice[1], 0, 100, 20, 10, 80);
    divide(&c, (il_link[]){ near00, near10 }, 2);
    assert_divided(&c, 1);
    size_t on[2] = { 0, 0 };
    for (size_t k = 0; k < c.pair.n_phi; k++) {
        const il_phi_point *p = &c.pair.phi[k];
        double off = distance_to_slice(&c.slice[0], (const double[2]){ p->x, p->y });
        if (off < .5)
            on[p->x > 0]++;
        assert_true((p->x > 0) == (c.slice[1].ring[0].xy[2 * p->at.vertex] > 0) || p->at.t > 0 || off > .5);
    }
    assert_true(on[0] > 25 && on[1] > 25);
    const il_cut *t = &c.pair.cut[0];
    assert_true(t->upper && t->ring == 0);
    for (size_t k = 0; k < t->n; k++)
        assert_near(t->xy[2 * k], 0, .5);
    free_couple(&c);
}

static void two_over_one(void **state)
{
    (void)state;
    couple c = new_couple();
    add_ellipse(&c.slice[0], 0, 100, 20, 10, 80), add_circle(&c, 1, -40, 0, 10), add_circle(&c, 1, 40, 0, 10);
    divide(&c, (il_link[]){ near00, near01 }, 2);
    assert_divided(&c, 1);
    assert_true(!c.pair.cut[0].upper);
    for (size_t k = 0; k < c.pair.n_phi; k++) /* each into its own half */
        assert_true((c.pair.phi[k].x > 0) == (c.pair.phi[k].at.ring == 1) && c.pair.phi[k].y > 80);
    free_couple(&c);
}

static void two_and_two_in_a_row(void **state)
{
    (void)state;
    couple c = new_couple();
    add_circle(&c, 0, 0, 0, 10), add_circle(&c, 0, 60, 0, 10), add_circle(&c, 1, 30, 0, 10), add_circle(&c, 1, 90, 0, 10);
    divide(&c, (il_link[]){ near00, near10, near11 }, 3);
    assert_divided(&c, 2); /* the lower right one, and the upper left one */
    free_couple(&c);
}

static void one_over_five_with_one_in_the_midst(void **state)
{
    (void)state;
    couple c = new_couple();
    add_ellipse(&c.slice[0], 0, 0, 60, 2, 60); /* the first ring */
    il_link link[5] = { near00 };
    for (uint32_t k = 0; k < 4; k++) {
        add_circle(&c, 0, 40 * cos(TURN * (k + .5) / 4), 40 * sin(TURN * (k + .5) / 4), 9);
        link[k + 1] = (il_link){ k + 1, 0, IL_LINK_NEAR, 1 };
    }
    add_circle(&c, 1, 0, 0, 20);
    divide(&c, link, 5);
    assert_true(is_divided(&c));
    assert_int_equal(c.pair.n_cuts, 5); /* four from the outline, and one about the middle */
    size_t round = 0;
    for (size_t i = 0; i < 5; i++) {
        const il_cut *t = &c.pair.cut[i];
        round += same_place(t->xy, t->xy + 2 * t->n - 2);
    }
    assert_int_equal(round, 1);
    assert_cuts(&c);
    assert_record(&c);
    assert_rows_rise(&c);
    assert_images_do_not_cross(&c);
    free_couple(&c);
}

static void regions_with_holes(void **state)
{
    (void)state;
    couple c = new_couple(), d = new_couple();
    add_circle(&c, 0, 0, 0, 10), add_circle(&c, 0, 0, 0, -5), add_circle(&c, 1, 40, 0, 10), add_circle(&c, 1, 40, 0, -5);
    divide(&c, &near00, 1);
    assert_record(&c);
    assert_rows_rise(&c);
    assert_images_do_not_cross(&c);
    assert_true(image_off(&c, 0) < .5 && image_off(&c, 1) < .5); /* hole on hole */
    free_couple(&c);
    /* an upper one with a hole in one of the halves that it is cut into */
    add_circle(&d, 0, -60, 0, 10), add_circle(&d, 0, 60, 0, 10),
    add_ellipse(&d.slice[1], 0, 100, 40, 20, 90), add_circle(&d, 1, -20, 100, -6);
    divide(&d, (il_link[]){ near00, near10 }, 2);
    assert_divided(&d, 1);
    for (size_t k = 0; k < d.pair.n_phi; k++)
        assert_true(d.pair.phi[k].at.ring == 0 || d.pair.phi[k].x < 0);
    free_couple(&d);
}

/* A hole that is in no piece, for it lies on the seam. */
static void a_hole_on_the_seam_goes_with_what_is_about_it(void **state)
{
    (void)state;
    couple c = new_couple();
    add_circle(&c, 0, -60, 0, 10), add_circle(&c, 0, 60, 0, 10),
    add_ellipse(&c.slice[1], 0, 100, 40, 20, 90), add_circle(&c, 1, 0, 100, -1);
    divide(&c, (il_link[]){ near00, near10 }, 2);
    assert_true(is_divided(&c));
    assert_record(&c);
    assert_rows_rise(&c);
    assert_images_do_not_cross(&c);
    free_couple(&c);
}

/* What slants a little is laid on each other, whatever its shape. */
static void what_slants_is_laid_on_each_other(void **state)
{
    (void)state;
    static const double size[][4] = { { 10, 10, 10, 10 }, { 10, 10, 14, 7 }, { 20, 4, 9, 9 }, { 3, 12, 12, 3 } };
    for (int k = 0; k < 4; k++) {
        couple c = new_couple();
        add_ellipse(&c.slice[0], 0, 0, size[k][0], size[k][1], 60);
        add_ellipse(&c.slice[1], 45, 13, size[k][2], size[k][3], 70);
        divide(&c, &near00, 1);
        assert_record(&c);
        assert_rows_rise(&c);
        assert_images_do_not_cross(&c);
        assert_true(image_off(&c, 0) < 1);
        assert_int_equal(c.pair.n_cuts, 0);
        free_couple(&c);
    }
}

static void centres_at_one_place_are_not_divided(void **state)
{
    (void)state;
    couple c = new_couple();
    add_circle(&c, 0, 0, 0, 20), add_circle(&c, 0, 0, 0, -15), add_circle(&c, 0, 0, 0, 5), add_circle(&c, 1, 50, 0, 20);
    divide(&c, (il_link[]){ near00, { 2, 0, IL_LINK_NEAR, 1 } }, 2);
    assert_int_equal(c.pair.n_cuts, 0);
    assert_record(&c);
    assert_rows_rise(&c);
    free_couple(&c);
}

/* ---- of any ---- */

/* Convex rings about points of a grid, so that they keep apart. */
static void random_side(couple *c, int side, size_t n, double dx, uint64_t *seed)
{
    for (size_t k = 0; k < n; k++) {
        double rx = random_between(seed, 3, 14), ry = random_between(seed, 3, 14);
        add_ellipse(&c->slice[side], dx + 40 * (double)k + random_between(seed, -5, 5), random_between(seed, -30, 30), rx, ry,
                    5 + (int)(stack_random(seed) % 40));
    }
}

/* A chain: what lies next to each other is linked, so that no two links cross. */
static size_t chain(size_t n_lower, size_t n_upper, il_link *link, uint64_t *seed)
{
    size_t n = 0;
    for (uint32_t i = 0, j = 0;;) {
        link[n++] = (il_link){ i, j, IL_LINK_NEAR, 1 };
        if (i + 1 == n_lower && j + 1 == n_upper)
            return n;
        bool up = i + 1 == n_lower || (j + 1 < n_upper && stack_random(seed) % 2);
        i += !up, j += up;
    }
}

static void random_couple(couple *c, il_link *link, size_t *n, uint64_t *seed)
{
    size_t m[2] = { 1 + stack_random(seed) % 3, 1 + stack_random(seed) % 3 };
    *c = new_couple();
    for (int side = 0; side < 2; side++)
        random_side(c, side, m[side], 20 * side, seed);
    *n = chain(m[0], m[1], link, seed);
}

static void any_chain_has_a_sound_record(void **state)
{
    (void)state;
    uint64_t seed = 11;
    size_t divided = 0;
    for (int round = 0; round < 60; round++) {
        couple c;
        il_link link[MOST];
        size_t n;
        random_couple(&c, link, &n, &seed);
        divide(&c, link, n);
        divided += n == 1 || c.pair.n_cuts > 0;
        assert_record(&c);
        assert_rows_rise(&c);
        assert_cuts(&c);
        free_couple(&c);
    }
    assert_int_equal(divided, 60);
}

static void scaling_by_a_power_of_two_scales_the_record(void **state)
{
    (void)state;
    uint64_t seed = 21;
    for (int round = 0; round < 6; round++) {
        couple c;
        il_link link[MOST];
        size_t n;
        random_couple(&c, link, &n, &seed);
        couple d = copy_of(&c);
        double scale = ldexp(1, 7 * round - 20);
        for (int side = 0; side < 2; side++)
            for (size_t r = 0; r < d.slice[side].n; r++)
                for (size_t k = 0; k < 2 * d.slice[side].ring[r].n; k++)
                    d.slice[side].ring[r].xy[k] *= scale;
        divide(&c, link, n);
        divide(&d, link, n);
        assert_int_equal(c.pair.n_phi, d.pair.n_phi);
        for (size_t k = 0; k < c.pair.n_phi; k++)
            assert_true(scale * c.pair.phi[k].x == d.pair.phi[k].x && scale * c.pair.phi[k].y == d.pair.phi[k].y);
        assert_int_equal(c.pair.n_cuts, d.pair.n_cuts);
        assert_int_equal(c.pair.n_matches, d.pair.n_matches);
        free_couple(&c);
        free_couple(&d);
    }
}

static void a_solver_that_was_used_gives_the_same_bytes(void **state)
{
    (void)state;
    uint64_t seed = 31;
    il_ffd *solver = new_solver();
    for (int round = 0; round < 6; round++) {
        couple c;
        il_link link[MOST];
        size_t n;
        random_couple(&c, link, &n, &seed);
        couple d = copy_of(&c);
        divide(&c, link, n);
        group(&d, link, n);
        assert_int_equal(il_match_slices(&d.slice[0], &d.slice[1], &FFD, solver, &d.pair, NULL), IL_OK);
        assert_same_text(&c, &d);
        free_couple(&c);
        free_couple(&d);
    }
    il_ffd_free(solver);
}

static void little_memory_is_told(void **state)
{
    (void)state;
    couple c = new_couple();
    add_ellipse(&c.slice[0], -20, 0, 10, 10, 12), add_ellipse(&c.slice[0], 20, 0, 10, 10, 12);
    add_ellipse(&c.slice[1], 0, 80, 30, 4, 12);
    const il_link link[] = { near00, near10 };
    long k = 0;
    for (il_status st = IL_E_NOMEM; st != IL_OK; k++) {
        il_ffd *solver = new_solver();
        il_error err = IL_ERROR_INIT;
        group(&c, link, 2);
        il_alloc_test_fail_after(k);
        st = il_match_slices(&c.slice[0], &c.slice[1], &FFD, solver, &c.pair, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        assert_true(st == IL_OK || (c.pair.n_groups == 0 && c.pair.phi == NULL && c.pair.cut == NULL));
        il_ffd_free(solver);
        assert_true(k < 10000);
    }
    assert_true(k > 50);
    assert_divided(&c, 1);
    free_couple(&c);
}

/* ---- lofted ---- */

/* A convex ring with N corners in any places of an ellipse. */
static void add_convex(il_slice *s, double x, double y, double rx, double ry, int n, uint64_t *seed)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (int k = 0; k < n; k++) {
        double a = TURN * (k + random_between(seed, 0, .8)) / n;
        assert_true(il_ring_add(r, x + rx * cos(a), y + ry * sin(a), 0));
    }
}

/* N of them, each in a square of its own of 3 by 3. */
static void scatter(il_slice *s, size_t n, uint64_t *seed)
{
    bool taken[9] = { false };
    for (size_t k = 0; k < n; k++) {
        size_t at;
        do
            at = stack_random(seed) % 9;
        while (taken[at]);
        taken[at] = true;
        double x = 40 * (double)(at % 3) + random_between(seed, -5, 5), y = 40 * (double)(at / 3) + random_between(seed, -5, 5);
        add_convex(s, x, y, random_between(seed, 4, 14), random_between(seed, 4, 14), 3 + (int)(stack_random(seed) % 30), seed);
    }
}

/* A random forest of links over N_LOWER and N_UPPER rings: how many. */
static size_t plant(uint32_t n_lower, uint32_t n_upper, il_link *link, uint64_t *seed)
{
    uint32_t up[2 * MOST];
    size_t n = 0;
    il_forest_plant(up, n_lower + n_upper);
    for (int turn = 0; turn < 100 && n + 1 < MOST; turn++) {
        uint32_t i = (uint32_t)(stack_random(seed) % n_lower), j = (uint32_t)(stack_random(seed) % n_upper);
        if (il_forest_leader(up, i) == il_forest_leader(up, n_lower + j))
            continue;
        il_forest_join(up, i, n_lower + j);
        link[n++] = (il_link){ i, j, IL_LINK_GIVEN, 1 };
        if (stack_random(seed) % 8 == 0)
            break;
    }
    return n;
}

/* What came of all: those with as many bodies as groups, the groups, and how many of these were made as
 * the slices lie, by length. */
typedef struct tally { size_t stacks, same, bodies, groups; double lying, length; } tally;

static void loft_forest(uint64_t at, tally *to)
{
    uint64_t seed = at;
    il_link link[MOST];
    couple c = new_couple();
    uint32_t n_lower = 1 + (uint32_t)(stack_random(&seed) % 4), n_upper = 1 + (uint32_t)(stack_random(&seed) % 4);
    scatter(&c.slice[0], n_lower, &seed);
    scatter(&c.slice[1], n_upper, &seed);
    c.slice[1].z = random_between(&seed, 5, 60);
    divide(&c, link, plant(n_lower, n_upper, link, &seed));
    assert_record(&c);
    assert_rows_rise(&c);
    size_t groups = c.pair.n_groups;
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    if (loft_pairs(&k, c.slice, 2, &c.pair, &o, &err) != IL_OK)
        fail_msg("forest %d: %s", (int)at, err.text);
    assert_sound(&k, "forest", at);
    to->stacks++;
    to->same += (size_t)k.facts.components == groups && k.facts.genus == 0;
    to->groups += groups;
    to->bodies += (size_t)k.facts.components;
    to->lying += k.facts.length_by[IL_ATTEMPT_B];
    for (int a = 0; a < IL_N_ATTEMPTS; a++)
        to->length += k.facts.length_by[a];
    il_mesh_free(&k.mesh);
    free_couple(&c);
}

/* Links at random may cross, and then no surface can have them all. */
static void any_forest_is_lofted_soundly(void **state)
{
    (void)state;
    tally t = { 0 };
    for (uint64_t at = 0; at < 100; at++)
        loft_forest(at, &t);
    print_message("# %zu forests, %zu as linked; %zu groups, %zu bodies; as the slices lie %.1f%% of the length\n",
                  t.stacks, t.same, t.groups, t.bodies, 100 * t.lying / t.length);
    assert_true(t.same >= 65);
}

/* Forests with a saddle between arms that folds unless it hangs as a star round its middle; then the whole
 * is made as the slices lie, in several bodies. */
static void saddles_that_fold_hang_as_stars(void **state)
{
    (void)state;
    static const uint64_t folded[] = { 1, 5, 27, 28, 64, 88, 92 };
    tally t = { 0 };
    for (size_t i = 0; i < sizeof folded / sizeof *folded; i++)
        loft_forest(folded[i], &t);
    assert_int_equal(t.same, t.stacks);
    assert_true(t.lying == 0);
}

/* ---- slants ---- */

/* Squares of side 10 that have WIDTH of it in common, the lesser one of side SIDE. */
static il_link_reason reason_of(double side, double width, double depth)
{
    char text[200];
    snprintf(text, sizeof text, "%.17g 0, %.17g 0, %.17g %.17g, %.17g %.17g",
             10 - width, 10 - width + side, 10 - width + side, depth, 10 - width, depth);
    couple c = of_text("0 0, 10 0, 10 10, 0 10", text);
    assert_int_equal(il_link_slices(&c.pair, &c.slice[0], &c.slice[1], NULL), IL_OK);
    assert_int_equal(c.pair.n_groups, 1);
    assert_int_equal(c.pair.group[0].link[0].reason, IL_LINK_OVERLAP);
    assert_int_equal(il_link_slants(&c.pair, &c.slice[0], &c.slice[1], NULL), IL_OK);
    il_link_reason why = c.pair.group[0].link[0].reason;
    free_couple(&c);
    return why;
}

static void less_than_three_tenths_of_the_lesser_in_common_slants(void **state)
{
    (void)state;
    assert_int_equal(reason_of(10, 3.001, 10), IL_LINK_OVERLAP);
    assert_int_equal(reason_of(10, 2.999, 10), IL_LINK_SLANT);
    assert_int_equal(reason_of(4, 1.2001, 4), IL_LINK_OVERLAP); /* of the lesser */
    assert_int_equal(reason_of(4, 1.1999, 4), IL_LINK_SLANT);
    assert_int_equal(reason_of(30, 3.001, 10), IL_LINK_OVERLAP);
    assert_int_equal(reason_of(30, 2.999, 10), IL_LINK_SLANT);
    assert_int_equal(reason_of(10, 0, 10), IL_LINK_SLANT); /* they only touch */
    assert_int_equal(reason_of(2, 9, 2), IL_LINK_OVERLAP);  /* one in the other */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_over_two),
        cmocka_unit_test(two_over_one),
        cmocka_unit_test(two_and_two_in_a_row),
        cmocka_unit_test(one_over_five_with_one_in_the_midst),
        cmocka_unit_test(regions_with_holes),
        cmocka_unit_test(a_hole_on_the_seam_goes_with_what_is_about_it),
        cmocka_unit_test(what_slants_is_laid_on_each_other),
        cmocka_unit_test(centres_at_one_place_are_not_divided),
        cmocka_unit_test(any_chain_has_a_sound_record),
        cmocka_unit_test(scaling_by_a_power_of_two_scales_the_record),
        cmocka_unit_test(a_solver_that_was_used_gives_the_same_bytes),
        cmocka_unit_test(little_memory_is_told),
        cmocka_unit_test(any_forest_is_lofted_soundly),
        cmocka_unit_test(saddles_that_fold_hang_as_stars),
        cmocka_unit_test(less_than_three_tenths_of_the_lesser_in_common_slants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
