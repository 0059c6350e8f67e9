/* t-link.c - which rings belong together, against a search by brute force. */
#include "config.h"
#include "contours.h"
#include "match/link.h"
#include "model/order.h"
#include "region/clean.h"
#include "regions.h"

/* ---- the oracle ---- */

enum { MOST = 60 };

/* Sets over the lower rings and then the upper ones, named by their least member. */
typedef struct sets { uint32_t of[2 * MOST]; size_t n; } sets;

static void join(sets *s, uint32_t a, uint32_t b)
{
    uint32_t to = s->of[a] < s->of[b] ? s->of[a] : s->of[b], from = s->of[a] < s->of[b] ? s->of[b] : s->of[a];
    for (size_t k = 0; k < s->n; k++)
        if (s->of[k] == from)
            s->of[k] = to;
}

/* ---- the record ---- */

static const il_link *find_link(const il_pair *p, uint32_t lower, uint32_t upper)
{
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->group[i].n_links; k++)
            if (p->group[i].link[k].lower == lower && p->group[i].link[k].upper == upper)
                return &p->group[i].link[k];
    return NULL;
}

static void assert_rising(const uint32_t *ring, size_t n)
{
    for (size_t k = 1; k < n; k++)
        assert_true(ring[k - 1] < ring[k]);
}

/* Every ring in one group, and all in the order that the format calls canonical. */
static void assert_canonical(const il_pair *p, const il_slice *lower, const il_slice *upper)
{
    size_t n_lower = 0, n_upper = 0;
    for (size_t i = 0; i < p->n_groups; i++) {
        const il_group *g = &p->group[i], *before = i > 0 ? &p->group[i - 1] : NULL;
        assert_true(g->n_lower + g->n_upper > 0 && !g->fitted);
        assert_rising(g->lower, g->n_lower);
        assert_rising(g->upper, g->n_upper);
        if (before && g->n_lower > 0)
            assert_true(before->n_lower > 0 && before->lower[0] < g->lower[0]);
        else if (before && before->n_lower == 0)
            assert_true(before->upper[0] < g->upper[0]);
        for (size_t k = 1; k < g->n_links; k++) {
            const il_link *a = &g->link[k - 1], *b = &g->link[k];
            assert_true(a->lower < b->lower || (a->lower == b->lower && a->upper < b->upper));
        }
        n_lower += g->n_lower;
        n_upper += g->n_upper;
    }
    assert_int_equal(n_lower, lower->n);
    assert_int_equal(n_upper, upper->n);
}

/* The sets of rings that the record's groups are. */
static void take_sets(sets *s, const il_pair *p, const il_slice *lower, const il_slice *upper)
{
    s->n = lower->n + upper->n;
    for (size_t k = 0; k < s->n; k++)
        s->of[k] = UINT32_MAX;
    for (size_t i = 0; i < p->n_groups; i++) {
        const il_group *g = &p->group[i];
        uint32_t name = g->n_lower > 0 ? g->lower[0] : (uint32_t)lower->n + g->upper[0];
        for (size_t k = 0; k < g->n_lower; k++) {
            assert_true(g->lower[k] < lower->n && s->of[g->lower[k]] == UINT32_MAX);
            s->of[g->lower[k]] = name;
        }
        for (size_t k = 0; k < g->n_upper; k++) {
            assert_true(g->upper[k] < upper->n && s->of[lower->n + g->upper[k]] == UINT32_MAX);
            s->of[lower->n + g->upper[k]] = name;
        }
    }
}

/* S turned round, in a frame, its last ring: what lies about it. */
static il_slice complement_of(const il_slice *s)
{
    static const double corner[8] = { -1e9, -1e9, 1e9, -1e9, 1e9, 1e9, -1e9, 1e9 };
    il_slice c;
    assert_int_equal(il_slice_copy(&c, s, NULL), IL_OK);
    for (size_t i = 0; i < c.n; i++)
        il_ring_reverse(&c.ring[i]);
    il_ring *frame = il_slice_add_ring(&c);
    assert_non_null(frame);
    for (int k = 0; k < 4; k++)
        assert_true(il_ring_add(frame, corner[2 * k], corner[2 * k + 1], 0));
    return c;
}

static il_pair linked(const il_slice *lower, const il_slice *upper)
{
    il_pair p = IL_PAIR_INIT;
    assert_int_equal(il_link_slices(&p, lower, upper, NULL), IL_OK);
    return p;
}

/* Holes of one group that overlap are linked, and no others; to outer rings they open. */
static void assert_holes_linked(const il_pair *p, const sets *group, const il_slice *lower, const il_slice *upper)
{
    il_slice a = complement_of(lower), b = complement_of(upper);
    for (uint32_t i = 0; i < lower->n; i++)
        for (uint32_t j = 0; j < upper->n; j++) {
            bool hole_a = il_ring_area2(&lower->ring[i]) < 0, hole_b = il_ring_area2(&upper->ring[j]) < 0;
            const il_link *link = find_link(p, i, j);
            if (hole_a && hole_b)
                assert_true((link != NULL) == (group->of[i] == group->of[lower->n + j] && regions_meet(&a, i, &b, j)));
            if (link && (hole_a || hole_b))
                assert_true(link->reason == (hole_a && hole_b ? IL_LINK_OVERLAP : IL_LINK_OPENING) && link->reach >= 0);
        }
    il_slice_free(&a);
    il_slice_free(&b);
}

/* What il_link_slices makes of two clean slices is what the oracle says. */
static void assert_linked(const il_slice *lower, const il_slice *upper)
{
    sets wanted = { { 0 }, lower->n + upper->n }, got;
    uint32_t n_lower = (uint32_t)lower->n;
    assert_true(wanted.n <= 2 * MOST);
    for (uint32_t k = 0; k < wanted.n; k++)
        wanted.of[k] = k;
    il_pair p = linked(lower, upper);
    assert_canonical(&p, lower, upper);
    for (uint32_t i = 0; i < lower->n; i++)
        join(&wanted, i, outer_of(lower, i));
    for (uint32_t j = 0; j < upper->n; j++)
        join(&wanted, n_lower + j, n_lower + outer_of(upper, j));
    for (uint32_t i = 0; i < lower->n; i++)
        for (uint32_t j = 0; j < upper->n; j++) {
            if (outer_of(lower, i) != i || outer_of(upper, j) != j)
                continue;
            bool meet = regions_meet(lower, i, upper, j);
            const il_link *link = find_link(&p, i, j);
            if (meet)
                join(&wanted, i, n_lower + j);
            assert_true((link != NULL) == meet);
            assert_true(!link || ((link->reason == IL_LINK_OVERLAP || link->reason == IL_LINK_SLANT) && link->reach == 0));
        }
    take_sets(&got, &p, lower, upper);
    assert_memory_equal(got.of, wanted.of, wanted.n * sizeof *wanted.of);
    assert_holes_linked(&p, &got, lower, upper);
    il_pair_free(&p);
}

/* ---- cases ---- */

/* "0 1|0 2; 3|; |4": groups as lower|upper. */
static char *groups_text(const il_pair *p, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < p->n_groups; i++) {
        const il_group *g = &p->group[i];
        n += (size_t)sprintf(to + n, "%s", i > 0 ? "; " : "");
        for (size_t k = 0; k < g->n_lower; k++)
            n += (size_t)sprintf(to + n, "%s%u", k > 0 ? " " : "", (unsigned)g->lower[k]);
        n += (size_t)sprintf(to + n, "|");
        for (size_t k = 0; k < g->n_upper; k++)
            n += (size_t)sprintf(to + n, "%s%u", k > 0 ? " " : "", (unsigned)g->upper[k]);
    }
    return to;
}

#define SQUARE "0 0, 9 0, 9 9, 0 9"
#define FRAMED SQUARE "; 2 2, 2 7, 7 7, 7 2"

static void rings_are_grouped_with_what_they_overlap(void **state)
{
    (void)state;
    static const struct { const char *lower, *upper, *groups; } c[] = {
        { SQUARE, SQUARE, "0|0" },
        { SQUARE, "1 1, 2 1, 2 2, 1 2", "0|0" },                             /* inside */
        { "1 1, 2 1, 2 2, 1 2", SQUARE, "0|0" },
        { SQUARE, "9 0, 12 0, 12 9, 9 9", "0|0" },                           /* touch along an edge */
        { SQUARE, "9 9, 12 9, 12 12", "0|0" },                               /* in a vertex */
        { SQUARE, "9 4, 12 3, 12 5", "0|0" },                                /* a vertex on an edge */
        { SQUARE, "10 0, 12 0, 12 9, 10 9", "0|; |0" },                      /* apart */
        { FRAMED, "3 3, 6 3, 6 6, 3 6", "0 1|; |0" },                        /* nested in a hole */
        { "3 3, 6 3, 6 6, 3 6", FRAMED, "0|; |0 1" },
        { FRAMED, "2 3, 6 3, 6 6, 2 6", "0 1|0" },                           /* touches the hole */
        { FRAMED, "0.5 0.5, 1 0.5, 1 1, 0.5 1", "0 1|0" },                   /* in the frame itself */
        { FRAMED, FRAMED, "0 1|0 1" },
        { FRAMED, SQUARE, "0 1|0" },
        { "0 0, 9 0, 9 9, 0 9; 20 0, 29 0, 29 9, 20 9", "5 3, 25 3, 25 6, 5 6", "0 1|0" },          /* a bridge */
        { "0 0, 9 0, 9 9, 0 9; 20 0, 29 0, 29 9, 20 9", "21 1, 28 1, 28 8; 40 0, 41 0, 41 1", "0|; 1|0; |1" },
        { FRAMED "; 3 3, 6 3, 6 6, 3 6", "4 4, 5 4, 5 5, 4 5", "0 1|; 2|0" },                       /* an island */
        { "", "", "" }, { SQUARE, "", "0|" }, { "", FRAMED, "|0 1" },
    };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        char text[200];
        il_slice lower = slice_of(c[k].lower), upper = slice_of(c[k].upper);
        assert_true(il_slice_in_order(&lower) && il_slice_in_order(&upper));
        il_pair p = linked(&lower, &upper);
        assert_string_equal(groups_text(&p, text), c[k].groups);
        assert_linked(&lower, &upper);
        il_pair_free(&p);
        il_slice_free(&lower);
        il_slice_free(&upper);
    }
}

/* "0 0 overlap, 1 0 opening 0.5": the links of P; TO[500]. */
static char *links_text(const il_pair *p, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->group[i].n_links; k++) {
            const il_link *l = &p->group[i].link[k];
            n += (size_t)snprintf(to + n, 500 - n, "%s%u %u %s", n > 0 ? ", " : "", l->lower, l->upper, il_link_reason_word(l->reason));
            if (l->reach > 0)
                n += (size_t)snprintf(to + n, 500 - n, " %.6g", l->reach);
        }
    return to;
}

#define NOTCHED "0 0, 9 0, 9 9, 5 9, 5 5, 4 5, 4 9, 0 9"

/* Both ways up: what is lower is upper then. */
static void holes_are_linked_with_holes_and_with_what_they_open_to(void **state)
{
    (void)state;
    static const struct { const char *lower, *upper, *links, *turned; } c[] = {
        { FRAMED, FRAMED, "0 0 overlap, 1 1 overlap", "0 0 overlap, 1 1 overlap" },
        { FRAMED, SQUARE, "0 0 overlap", "0 0 overlap" },                      /* it closes */
        { SQUARE "; 1 1, 1 4, 4 4, 4 1", SQUARE "; 5 5, 5 8, 8 8, 8 5", "0 0 overlap", "0 0 overlap" }, /* one closes, one begins */
        { SQUARE "; 4 4, 4 8, 5 8, 5 4", NOTCHED, "0 0 overlap, 1 0 opening", "0 0 overlap, 0 1 opening" },   /* 3 of 4 */
        { FRAMED, "0 0, 9 0, 9 9, 4.45 9, 4.45 6.8, 4.4 6.8, 4.4 9, 0 9", "0 0 overlap", "0 0 overlap" },      /* 0.01 of 25 */
        { FRAMED, "0 0, 9 0, 9 9, 5 9, 5 6, 4 6, 4 9, 0 9", "0 0 overlap, 1 0 opening", "0 0 overlap, 0 1 opening" }, /* 1 of 25 */
        { FRAMED, "0 0, 9 0, 9 9, 5 9, 5 6, 4 6, 4 9, 0 9; 3 3, 3 5, 6 5, 6 3", "0 0 overlap, 1 1 overlap",
          "0 0 overlap, 1 1 overlap" },
        { FRAMED, "0 0, 9 0, 9 9, 0 9, 0 8.5, 6.5 8.5, 6.5 3.5, 0 3.5; 1 1, 1 3, 8 3, 8 1",                  /* most of it opens */
          "0 0 overlap, 0 1 opening 1, 1 0 opening, 1 1 overlap", "0 0 overlap, 0 1 opening, 1 0 opening 1, 1 1 overlap" },
        { FRAMED, "0 0, 9 0, 9 1, 0 1", "0 0 overlap, 1 0 opening 1", "0 0 overlap, 0 1 opening 1" },
        { FRAMED, "0 0, 9 0, 9 1, 0 1; 0 8.5, 9 8.5, 9 9, 0 9", "0 0 overlap, 0 1 overlap, 1 0 opening 1",
          "0 0 overlap, 0 1 opening 1, 1 0 overlap" },
        { FRAMED, "3 3, 6 3, 6 6, 3 6", "", "" },                              /* no region is linked */
        { FRAMED "; 3 3, 6 3, 6 6, 3 6", SQUARE "; 1 1, 1 8, 8 8, 8 1; 4 4, 7.5 4, 7.5 6, 4 6",              /* an island lands */
          "0 0 overlap, 0 2 overlap, 1 1 overlap, 1 2 opening, 2 2 overlap",
          "0 0 overlap, 1 1 overlap, 2 0 overlap, 2 1 opening, 2 2 overlap" },
    };
    for (size_t k = 0; k < 2 * sizeof c / sizeof *c; k++) {
        char text[500];
        il_slice s[2] = { slice_of(c[k / 2].lower), slice_of(c[k / 2].upper) };
        assert_true(il_slice_in_order(&s[0]) && il_slice_in_order(&s[1]));
        il_pair p = linked(&s[k % 2], &s[1 - k % 2]);
        assert_string_equal(links_text(&p, text), k % 2 ? c[k / 2].turned : c[k / 2].links);
        il_pair_free(&p);
        il_slice_free(&s[0]);
        il_slice_free(&s[1]);
    }
}

static void clean(il_slice *s)
{
    assert_int_equal(il_slice_clean(s, &(il_clean_options){ false }, NULL, NULL, NULL), IL_OK);
}

/* On few grid points everything touches, coincides and nests. */
static void tangles_are_linked_as_brute_force_says(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int round = 0; round < 400; round++) {
        unsigned size = 4 + (unsigned)round % 20;
        il_slice lower = random_tangle(&seed, size), upper = random_tangle(&seed, size);
        clean(&lower);
        clean(&upper);
        if (lower.n <= MOST && upper.n <= MOST)
            assert_linked(&lower, &upper);
        il_slice_free(&lower);
        il_slice_free(&upper);
    }
}

static void hard_stacks_are_linked_as_brute_force_says(void **state)
{
    (void)state;
    for (int kind = 0; kind < STACK_N_KINDS; kind++)
        for (uint64_t seed = 0; seed < 12; seed++) {
            il_slice slice[6];
            size_t n = stack_make((stack_kind)kind, seed, slice);
            for (size_t k = 0; k < n; k++)
                clean(&slice[k]);
            for (size_t k = 0; k + 1 < n; k++)
                if (slice[k].n <= MOST && slice[k + 1].n <= MOST)
                    assert_linked(&slice[k], &slice[k + 1]);
            for (size_t k = 0; k < n; k++)
                il_slice_free(&slice[k]);
        }
}

/* Squares in squares in squares, DEEP of them, holes and islands by turns. */
static il_slice nested_squares(int deep, double off)
{
    il_slice s = IL_SLICE_INIT;
    for (int k = 0; k < deep; k++) {
        double a = off + k, b = off + 100 - k;
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        assert_true(il_ring_add(r, a, a, 0) && il_ring_add(r, b, a, 0) && il_ring_add(r, b, b, 0) && il_ring_add(r, a, b, 0));
        if (k % 2) {
            il_ring_reverse(r);
            il_ring_rotate(r, 0);
        }
    }
    return s;
}

static void islands_in_holes_in_islands_keep_apart(void **state)
{
    (void)state;
    for (int deep = 1; deep < 12; deep++) {
        il_slice lower = nested_squares(deep, 0), upper = nested_squares(deep, .25), above = nested_squares(deep, .75);
        assert_linked(&lower, &upper);
        il_pair p = linked(&lower, &upper);
        assert_int_equal(p.n_groups, (deep + 1) / 2);
        il_pair_free(&p);
        assert_linked(&lower, &above);
        il_slice_free(&lower);
        il_slice_free(&upper);
        il_slice_free(&above);
    }
}

/* Rows, columns, grids of rings one above the other, and those as holes of a plate:
 * neither time nor memory may grow with the pairs of rings that share a line. */
static void many_rings_are_linked_fast(void **state)
{
    (void)state;
    enum { MANY = 10000 };
    static const int row[] = { MANY, 1, 100 };
    for (int shape = 0; shape < 6; shape++) {
        il_slice s[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
        bool plate = shape >= 3;
        for (int side = 0; side < 2; side++) {
            for (int i = plate ? -1 : 0; i < MANY; i++) {
                double x = i / row[shape % 3] * 4., y = i % row[shape % 3] * 4., size = side ? 2 : 3;
                x = i < 0 ? -8 : x, y = i < 0 ? -8 : y, size = i < 0 ? 1e6 : size;
                il_ring *r = il_slice_add_ring(&s[side]);
                assert_non_null(r);
                assert_true(il_ring_add(r, x, y, 0) && il_ring_add(r, x + size, y, 0) && il_ring_add(r, x, y + size, 0));
                if (plate && i >= 0)
                    il_ring_reverse(r);
            }
            assert_true(il_slice_in_order(&s[side]));
        }
        il_pair p = linked(&s[0], &s[1]);
        assert_int_equal(p.n_groups, plate ? 1 : MANY);
        for (uint32_t k = 0; k < MANY; k++) {
            const il_group *g = &p.group[plate ? 0 : k];
            assert_true(g->n_lower == (plate ? MANY + 1 : 1) && g->n_upper == g->n_lower && g->lower[0] == (plate ? 0 : k));
        }
        il_pair_free(&p);
        il_slice_free(&s[0]);
        il_slice_free(&s[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_are_grouped_with_what_they_overlap),
        cmocka_unit_test(holes_are_linked_with_holes_and_with_what_they_open_to),
        cmocka_unit_test(tangles_are_linked_as_brute_force_says),
        cmocka_unit_test(hard_stacks_are_linked_as_brute_force_says),
        cmocka_unit_test(islands_in_holes_in_islands_keep_apart),
        cmocka_unit_test(many_rings_are_linked_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
