/* t-linkage.c - which regions of a whole stack belong together: the rule clause by clause,
 * and against itself as it is written down, slowly, on random stacks. */
#include "config.h"
#include "contours.h"
#include "match/linkage.h"
#include "region/clean.h"
#include "regions.h"

enum { SLICES = 8, TEXT = 2000 };

/* ---- clause by clause ---------------------------------------------------------- */

/* "0: 0 0 overlap, 0 1 join 0.5; 2: ...": slab, lower ring, upper ring, why, reach. */
static char *linkage_text(const il_linkage *l, size_t n_slices, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t k = 0; k + 1 < n_slices; k++)
        for (size_t i = l->first[k]; i < l->first[k + 1]; i++) {
            const il_link *a = &l->link[i];
            n += (size_t)snprintf(to + n, TEXT - n, i > l->first[k] ? ", " : n > 0 ? "; %zu: " : "%zu: ", k);
            n += (size_t)snprintf(to + n, TEXT - n, "%u %u %s", a->lower, a->upper, il_link_reason_word(a->reason));
            if (a->reach > 0)
                n += (size_t)snprintf(to + n, TEXT - n, " %.6g", a->reach);
        }
    return to;
}

/* Slices at the heights Z, null after the last; `given`: slabs with a record, g a gap, . one
 * without groups, - none. */
typedef struct stack_text {
    const char *slice[SLICES];
    double z[SLICES];
    const char *given;
} stack_text;

static il_linkage link_stack(const il_slice *slice, size_t n, const char *given, const il_linkage_options *o)
{
    static const il_pair gap = { .gap = true }, bare = { .gap = false };
    const il_pair *known[SLICES] = { NULL };
    il_linkage l;
    for (size_t k = 0; given && given[k]; k++)
        known[k] = given[k] == 'g' ? &gap : given[k] == '.' ? &bare : NULL;
    assert_int_equal(il_linkage_find(&l, slice, n, known, o, NULL), IL_OK);
    return l;
}

/* As the linker gets them: rings in order. */
static void clean(il_slice *s)
{
    assert_int_equal(il_slice_clean(s, &(il_clean_options){ false }, NULL, NULL, NULL), IL_OK);
}

static void assert_links(const stack_text *s, const il_linkage_options *o, const char *wanted)
{
    il_slice slice[SLICES];
    char text[TEXT];
    size_t n = 0;
    for (; n < SLICES && s->slice[n]; n++) {
        slice[n] = slice_of(s->slice[n]);
        slice[n].z = s->z[n];
        clean(&slice[n]);
    }
    il_linkage l = link_stack(slice, n, s->given, o);
    assert_string_equal(linkage_text(&l, n, text), wanted);
    il_linkage_free(&l);
    for (size_t k = 0; k < n; k++)
        il_slice_free(&slice[k]);
}

static const il_linkage_options usual = IL_LINKAGE_OPTIONS_INIT;

/* Of 64, and of less: what is near it is small. */
#define BODY "0 0, 8 0, 8 8, 0 8"
#define BODY_AND(what) BODY "; " what

static void what_overlaps_is_linked_whatever_else(void **state)
{
    (void)state;
    const il_linkage_options none = { 0, 0, 2, 0, false };
    const stack_text loop = { { BODY, "0 0, 1 0, 1 8, 0 8; 7 0, 8 0, 8 8, 7 8", BODY }, { 0, 1, 2 }, NULL };
    assert_links(&loop, &none, "0: 0 0 overlap, 0 1 overlap; 1: 0 0 overlap, 1 0 overlap");
    assert_links(&loop, &usual, "0: 0 0 overlap, 0 1 overlap; 1: 0 0 overlap, 1 0 overlap");
    const stack_text touching = { { BODY, "8 0, 9 0, 9 8, 8 8" }, { 0, 1 }, NULL };
    assert_links(&touching, &none, "0: 0 0 overlap");
}

static void up_to_a_tenth_of_the_height_links_are_free_to_close_loops(void **state)
{
    (void)state;
    const stack_text near = { { BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8") }, { 0, 5, 10 }, NULL };
    assert_links(&near, &usual, "0: 0 0 overlap, 1 0 near 0.5; 1: 0 0 overlap, 0 1 near 0.5");
    const stack_text loop = { { BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), "0 0, 9 0, 9 8, 0 8" }, { 0, 5, 10 }, NULL };
    assert_links(&loop, &usual, "0: 0 0 overlap, 0 1 near 0.5; 1: 0 0 overlap, 1 0 overlap");
    const stack_text equal = { { BODY, "8.5 0, 16.5 0, 16.5 8, 8.5 8" }, { 0, 5 }, NULL }; /* neither dominates */
    assert_links(&equal, &usual, "0: 0 0 near 0.5");
}

static void in_a_group_of_its_slab_nothing_more_is_near(void **state)
{
    (void)state;
    const stack_text s = { { BODY_AND("9 0, 10 0, 10 1, 9 1"), "7 2, 12 2, 12 8, 7 8; 7.5 0.5, 9.5 0.5, 9.5 1, 7.5 1" }, { 0, 20 }, NULL };
    assert_links(&s, &usual, "0: 0 0 overlap, 0 1 overlap, 1 1 overlap"); /* ring 1 is 1 off ring 0 */
}

static void beyond_a_tenth_no_loop_is_closed(void **state)
{
    (void)state;
    const stack_text s = { { BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), "0 0, 9 0, 9 8, 0 8" }, { 0, 4, 8 }, NULL };
    assert_links(&s, &usual, "0: 0 0 overlap; 1: 0 0 overlap, 1 0 overlap");
    const stack_text open = { { BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), BODY }, { 0, 4, 8 }, NULL };
    assert_links(&open, &usual, "0: 0 0 overlap, 0 1 join 0.5; 1: 0 0 overlap"); /* the first slab of two, and no more */
}

static void joins_reach_as_far_as_they_may(void **state)
{
    (void)state;
    const stack_text in = { { BODY, BODY_AND("11 0, 12 0, 12 1, 11 1") }, { 0, 4 }, NULL };
    const stack_text out = { { BODY, BODY_AND("11.1 0, 12 0, 12 1, 11.1 1") }, { 0, 4 }, NULL };
    assert_links(&in, &usual, "0: 0 0 overlap, 0 1 join 3");
    assert_links(&out, &usual, "0: 0 0 overlap");
    const il_linkage_options far = { 0.1, 4, 0.25, 0.25, false };
    assert_links(&out, &far, "0: 0 0 overlap, 0 1 join 3.1");
    const stack_text corner = { { BODY, BODY_AND("9.5 10, 10 10, 10 11, 9.5 11") }, { 0, 4 }, NULL }; /* 1.5, 2: in a straight line */
    assert_links(&corner, &usual, "0: 0 0 overlap, 0 1 join 2.5");
}

/* Volumes: areas times half of the slabs below and above. */
static void a_part_is_joined_onto_a_quarter_of_the_volume(void **state)
{
    (void)state;
    const il_linkage_options o = { 0.1, 0.75, 0.25, 0.25, false };
    const stack_text in = { { "0 0, 1 0, 1 1, 0 1; 100 0, 130 0, 130 1, 100 1; 2 0, 12 0, 12 1, 2 1", "-1 0, -.5 0, -.5 .125, -1 .125" },
                            { 0, 2 }, NULL };
    assert_links(&in, &o, ""); /* 10 of 41.1 is less; 1 is too little to be joined onto */
    const stack_text just = { { "0 0, 10 0, 10 1, 0 1; 100 0, 129.9375 0, 129.9375 1, 100 1", "-1 0, -.5 0, -.5 .125, -1 .125" },
                              { 0, 2 }, NULL };
    assert_links(&just, &o, "0: 0 0 join 0.5"); /* 10 of 40 */
    const stack_text less = { { "0 0, 10 0, 10 1, 0 1; 100 0, 130 0, 130 1, 100 1", "-1 0, -.5 0, -.5 .125, -1 .125" }, { 0, 2 }, NULL };
    assert_links(&less, &o, "");
}

static void what_is_joined_is_less_than_a_quarter_of_what_it_is_joined_onto(void **state)
{
    (void)state;
    const stack_text less = { { BODY, "9 0, 10 0, 10 8, 9 8" }, { 0, 2 }, NULL };
    const stack_text quarter = { { BODY, "9 0, 11 0, 11 8, 9 8" }, { 0, 2 }, NULL };
    const stack_text holed = { { BODY, "9 0, 11 0, 11 8, 9 8; 9.5 0.5, 9.5 1, 10 1, 10 0.5" }, { 0, 2 }, NULL };
    const stack_text equal = { { BODY, "9 0, 17 0, 17 8, 9 8", "9 0, 17 0, 17 8, 9 8" }, { 0, 2, 4 }, NULL };
    assert_links(&less, &usual, "0: 0 0 join 1");
    assert_links(&quarter, &usual, "");
    assert_links(&holed, &usual, "0: 0 0 join 1");
    assert_links(&equal, &usual, "1: 0 0 overlap");
}

static void the_nearest_join_comes_first(void **state)
{
    (void)state;
    const stack_text s = { { BODY, BODY_AND("9 0, 10 0, 10 1, 9 1"), "0 0, 8.5 0, 8.5 8, 0 8" }, { 0, 2, 4 }, NULL };
    assert_links(&s, &usual, "0: 0 0 overlap; 1: 0 0 overlap, 1 0 join 0.5"); /* not the 1 below */
    const stack_text tied = { { BODY, BODY_AND("9 0, 10 0, 10 1, 9 1"), BODY }, { 0, 2, 4 }, NULL };
    assert_links(&tied, &usual, "0: 0 0 overlap, 0 1 join 1; 1: 0 0 overlap");
    const stack_text rings = { { "0 0, 8 0, 8 8, 0 8; 10 0, 18 0, 18 8, 10 8", "8.5 0, 9.5 0, 9.5 1, 8.5 1" }, { 0, 2 }, NULL };
    assert_links(&rings, &usual, "0: 0 0 join 0.5");
}

static void a_join_waits_until_its_part_has_grown(void **state)
{
    (void)state;
    const stack_text s = { { BODY, "9.5 0, 10.5 0, 10.5 1, 9.5 1", "11 0, 12 0, 12 1, 11 1", "13 0, 14 0, 14 1, 13 1" },
                           { 0, 4, 8, 12 }, NULL };
    assert_links(&s, &usual, "0: 0 0 join 1.5; 1: 0 0 join 0.5; 2: 0 0 join 1");
}

static void gaps_are_measured_by_the_height_of_their_own_slab(void **state)
{
    (void)state;
    const stack_text s = { { BODY, BODY_AND("9 0, 10 0, 10 1, 9 1"), BODY }, { 0, 1, 3 }, NULL };
    assert_links(&s, &usual, "0: 0 0 overlap; 1: 0 0 overlap, 1 0 join 1"); /* 1 of 1, and 1 of 2 */
    const stack_text order = { { "0 0, 8.5 0, 8.5 8, 0 8", BODY_AND("9 0, 10 0, 10 1, 9 1"), BODY }, { 0, 1, 4 }, NULL };
    assert_links(&order, &usual, "0: 0 0 overlap; 1: 0 0 overlap, 1 0 join 1"); /* 0.5 of 1, and 1 of 3 */
}

static void slabs_that_have_a_record_get_no_links(void **state)
{
    (void)state;
    const stack_text gap = { { BODY, BODY_AND("9 0, 10 0, 10 1, 9 1"), BODY }, { 0, 2, 4 }, "g-" };
    assert_links(&gap, &usual, "1: 0 0 overlap, 1 0 join 1");
    const stack_text all = { { BODY, BODY }, { 0, 2 }, "g" };
    assert_links(&all, &usual, "");
    /* Over a record without groups the two hang together, and need no second link. */
    const stack_text loop = { { BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), "0 0, 9 0, 9 8, 0 8" }, { 0, 4, 8 }, "-." };
    assert_links(&loop, &usual, "0: 0 0 overlap");
    const stack_text apart = { { BODY, BODY_AND("8.5 0, 9 0, 9 8, 8.5 8"), "0 0, 9 0, 9 8, 0 8" }, { 0, 4, 8 }, "-g" };
    assert_links(&apart, &usual, "0: 0 0 overlap, 0 1 join 0.5");
}

static void nothing_is_linked_with_nothing(void **state)
{
    (void)state;
    const stack_text empty = { { BODY, "", BODY }, { 0, 2, 4 }, NULL }, one = { { BODY }, { 0 }, NULL };
    assert_links(&empty, &usual, "");
    assert_links(&one, &usual, "");
    il_linkage l;
    assert_int_equal(il_linkage_find(&l, NULL, 0, NULL, &usual, NULL), IL_OK);
    il_linkage_free(&l);
}

/* ---- against the rule as it is written down --------------------------------------- */

enum { MOST = 400 };

typedef struct part { size_t slice; uint32_t ring; double volume; } part;
typedef struct choice { size_t slab, a, b; double gap; bool overlap, linked; } choice;

/* part_of, group_of: names; a region is in groups of two slabs, [0] of the one above it. */
typedef struct oracle {
    const il_slice *slice;
    size_t n;
    const char *given;
    part region[MOST];
    size_t n_regions, part_of[MOST], group_of[2][MOST];
    choice pair[MOST * MOST];
    size_t n_pairs;
} oracle;

static double height(const oracle *o, size_t slab)
{
    return o->slice[slab + 1].z - o->slice[slab].z;
}

static void take_regions(oracle *o)
{
    o->n_regions = 0;
    for (size_t k = 0; k < o->n; k++)
        for (uint32_t i = 0; i < o->slice[k].n; i++) {
            const il_slice *s = &o->slice[k];
            if (outer_of(s, i) != i)
                continue;
            double area = 0, mean = ((k > 0 ? height(o, k - 1) : 0) + (k + 1 < o->n ? height(o, k) : 0)) / 2;
            for (uint32_t r = 0; r < s->n; r++)
                area += outer_of(s, r) == i ? il_ring_area2(&s->ring[r]) / 2 : 0;
            o->region[o->n_regions] = (part){ k, i, area * mean };
            o->part_of[o->n_regions] = o->group_of[0][o->n_regions] = o->n_regions;
            o->group_of[1][o->n_regions] = MOST + o->n_regions;
            o->n_regions++;
        }
}

/* To the last bit what base/nearest.c finds: equal gaps are told apart by their place alone. */
static double distance_to(const double *p, const double *a, const double *b)
{
    double ux = b[0] - a[0], uy = b[1] - a[1], t = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy);
    t = fmin(fmax(t, 0), 1);
    double dx = p[0] - a[0] - t * ux, dy = p[1] - a[1] - t * uy;
    return sqrt(dx * dx + dy * dy);
}

static double distance(const il_ring *r, const il_ring *s)
{
    double least = INFINITY;
    for (size_t i = 0; i < r->n; i++)
        for (size_t j = 0; j < s->n; j++)
            least = fmin(least, fmin(distance_to(vertex(r, i), vertex(s, j), vertex(s, j + 1)),
                                     distance_to(vertex(s, j), vertex(r, i), vertex(r, i + 1))));
    return least;
}

static void rename_all(size_t *name, size_t n, size_t from, size_t to)
{
    for (size_t i = 0; i < n; i++)
        if (name[i] == from)
            name[i] = to;
}

static void merge_parts(oracle *o, size_t a, size_t b)
{
    rename_all(o->part_of, o->n_regions, o->part_of[b], o->part_of[a]);
}

static void take(oracle *o, choice *c)
{
    c->linked = true;
    merge_parts(o, c->a, c->b);
    size_t from = o->group_of[1][c->b], to = o->group_of[0][c->a];
    rename_all(o->group_of[0], o->n_regions, from, to);
    rename_all(o->group_of[1], o->n_regions, from, to);
}

static bool comes_before(const choice *a, const choice *b)
{
    if (a->gap != b->gap)
        return a->gap < b->gap;
    return a->a != b->a ? a->a < b->a : a->b < b->b;
}

static void take_pairs(oracle *o)
{
    o->n_pairs = 0;
    for (size_t a = 0; a < o->n_regions; a++)
        for (size_t b = 0; b < o->n_regions; b++) {
            size_t k = o->region[a].slice;
            if (o->region[b].slice != k + 1)
                continue;
            const il_slice *s = &o->slice[k];
            bool overlap = regions_meet(s, o->region[a].ring, s + 1, o->region[b].ring);
            char given = o->given ? o->given[k] : '-';
            double gap = overlap ? 0 : distance(&s->ring[o->region[a].ring], &s[1].ring[o->region[b].ring]) / height(o, k);
            if (given == '-')
                o->pair[o->n_pairs++] = (choice){ k, a, b, gap, overlap, false };
            else if (given == '.' && overlap)
                merge_parts(o, a, b);
        }
}

static void take_near(oracle *o, double free)
{
    for (choice *best = o->pair; best;) {
        best = NULL;
        for (size_t i = 0; i < o->n_pairs; i++) {
            choice *c = &o->pair[i];
            if (!c->linked && c->gap <= free && o->group_of[0][c->a] != o->group_of[1][c->b] && (!best || comes_before(c, best)))
                best = c;
        }
        if (best)
            take(o, best);
    }
}

static double volume_of(const oracle *o, size_t region)
{
    double sum = 0;
    for (size_t i = 0; i < o->n_regions; i++)
        sum += o->part_of[i] == o->part_of[region] ? o->region[i].volume : 0;
    return sum;
}

static void take_joins(oracle *o, const il_linkage_options *rule)
{
    double total = 0;
    for (size_t i = 0; i < o->n_regions; i++)
        total += o->region[i].volume;
    for (choice *best = o->pair; best;) {
        best = NULL;
        for (size_t i = 0; i < o->n_pairs; i++) {
            choice *c = &o->pair[i];
            double a = volume_of(o, c->a), b = volume_of(o, c->b);
            if (c->gap <= rule->reach && o->part_of[c->a] != o->part_of[c->b] && fmax(a, b) >= rule->dominant * total &&
                fmin(a, b) < rule->small * fmax(a, b) && (!best || comes_before(c, best)))
                best = c;
        }
        if (best)
            take(o, best);
    }
}

static void find(oracle *o, const il_linkage_options *rule)
{
    take_regions(o);
    take_pairs(o);
    for (size_t i = 0; i < o->n_pairs; i++)
        if (o->pair[i].overlap)
            take(o, &o->pair[i]);
    take_near(o, rule->free);
    take_joins(o, rule);
}

/* "0: 0 0 overlap; ..." of links between outer rings. */
static char *oracle_text(const oracle *o, const il_linkage_options *rule, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < o->n_pairs; i++) {
        const choice *c = &o->pair[i];
        if (c->linked)
            n += (size_t)snprintf(to + n, 100, "%zu: %u %u %s %.12g\n", c->slab, o->region[c->a].ring, o->region[c->b].ring,
                                  c->overlap ? "overlap" : c->gap <= rule->free ? "near" : "join", c->gap * height(o, c->slab));
    }
    return to;
}

static char *outer_text(const il_linkage *l, const il_slice *slice, size_t n_slices, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t k = 0; k + 1 < n_slices; k++)
        for (size_t i = l->first[k]; i < l->first[k + 1]; i++) {
            const il_link *a = &l->link[i];
            if (il_ring_area2(&slice[k].ring[a->lower]) > 0 && il_ring_area2(&slice[k + 1].ring[a->upper]) > 0)
                n += (size_t)snprintf(to + n, 100, "%zu: %u %u %s %.12g\n", k, a->lower, a->upper,
                                      il_link_reason_word(a->reason), a->reach);
        }
    return to;
}

static void add_box(il_slice *s, double x, double y, double wide, double high, bool hole)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    assert_true(il_ring_add(r, x, y, 0) && il_ring_add(r, x + wide, y, 0) && il_ring_add(r, x + wide, y + high, 0) &&
                il_ring_add(r, x, y + high, 0));
    if (hole)
        il_ring_reverse(r);
}

static double below(uint64_t *seed, unsigned n)
{
    return (double)(stack_random(seed) % n);
}

/* Boxes in the cells of a grid, some with a hole, and some of these with an island: on whole
 * numbers, so that many gaps are equal. */
static il_slice random_slice(uint64_t *seed, double z)
{
    il_slice s = IL_SLICE_INIT;
    unsigned cells = 1 + (unsigned)(stack_random(seed) % 4);
    double off = below(seed, 9), size = 9 + below(seed, 3);
    s.z = z;
    for (unsigned i = 0; i < cells * cells; i++) {
        double x = off + (i % cells) * size, y = off + (i / cells) * size, wide = 1 + below(seed, 8), high = 1 + below(seed, 8);
        if (stack_random(seed) % 3 == 0)
            continue;
        add_box(&s, x, y, wide, high, false);
        if (wide < 4 || high < 4 || stack_random(seed) % 2)
            continue;
        add_box(&s, x + 1, y + 1, wide - 2, high - 2, true);
        if (wide > 4 && high > 4)
            add_box(&s, x + 2, y + 2, wide - 4, high - 4, false);
    }
    clean(&s);
    return s;
}

static void random_stacks_are_linked_as_the_rule_says(void **state)
{
    (void)state;
    static const il_linkage_options rule[] = {
        IL_LINKAGE_OPTIONS_INIT, { 0.1, 4, 0.25, 0.25, false }, { 0, 4, 0.1, INFINITY, false },
        { 0, 0, 0.25, 0.25, false }, { 0.5, 2, 0.125, 0.5, false }
    };
    oracle *o = malloc(sizeof *o);
    char *text[2] = { malloc(100 * MOST * MOST), malloc(100 * MOST * MOST) };
    size_t made[IL_N_LINK_REASONS] = { 0 };
    assert_true(o && text[0] && text[1]);
    for (uint64_t round = 0; round < 200; round++) {
        il_slice slice[SLICES];
        uint64_t seed = round;
        size_t n = 2 + stack_random(&seed) % (SLICES - 2);
        char given[SLICES] = "";
        double z = 0;
        for (size_t k = 0; k < n; k++) {
            slice[k] = random_slice(&seed, z);
            z += ldexp(1, (int)(stack_random(&seed) % 5) - 1);
            given[k] = round % 4 < 3 || stack_random(&seed) % 4 ? '-' : stack_random(&seed) % 2 ? 'g' : '.';
        }
        given[n - 1] = '\0';
        for (size_t r = 0; r < sizeof rule / sizeof *rule; r++) {
            o->slice = slice, o->n = n, o->given = given;
            find(o, &rule[r]);
            il_linkage l = link_stack(slice, n, given, &rule[r]);
            assert_string_equal(outer_text(&l, slice, n, text[0]), oracle_text(o, &rule[r], text[1]));
            for (size_t i = 0; i < l.first[n - 1]; i++)
                made[l.link[i].reason]++;
            il_linkage_free(&l);
        }
        for (size_t k = 0; k < n; k++)
            il_slice_free(&slice[k]);
    }
    assert_true(made[IL_LINK_OVERLAP] > 1000 && made[IL_LINK_NEAR] > 100 && made[IL_LINK_JOIN] > 1000);
    free(o);
    free(text[0]);
    free(text[1]);
}

/* Each waits for the one before it, which is in the other slice: who looks at all of them
 * whenever one was joined is not done today. */
static void a_long_chain_is_joined_fast(void **state)
{
    (void)state;
    enum { MANY = 20000 };
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    slice[1].z = 4;
    add_box(&slice[0], -1000, 0, 1000, 1000, false);
    for (int i = 0; i < MANY; i++)
        add_box(&slice[1 - i % 2], 2 + 3 * i, 0, 1, 1, false);
    clean(&slice[0]);
    clean(&slice[1]);
    il_linkage l = link_stack(slice, 2, NULL, &usual);
    assert_int_equal(l.first[1], MANY);
    for (size_t i = 0; i < MANY; i++)
        assert_true(l.link[i].reason == IL_LINK_JOIN && l.link[i].reach == 2 && l.link[i].lower == (i + 1) / 2 && l.link[i].upper == i / 2);
    il_linkage_free(&l);
    il_slice_free(&slice[0]);
    il_slice_free(&slice[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_overlaps_is_linked_whatever_else),
        cmocka_unit_test(up_to_a_tenth_of_the_height_links_are_free_to_close_loops),
        cmocka_unit_test(in_a_group_of_its_slab_nothing_more_is_near),
        cmocka_unit_test(beyond_a_tenth_no_loop_is_closed),
        cmocka_unit_test(joins_reach_as_far_as_they_may),
        cmocka_unit_test(a_part_is_joined_onto_a_quarter_of_the_volume),
        cmocka_unit_test(what_is_joined_is_less_than_a_quarter_of_what_it_is_joined_onto),
        cmocka_unit_test(the_nearest_join_comes_first),
        cmocka_unit_test(a_join_waits_until_its_part_has_grown),
        cmocka_unit_test(gaps_are_measured_by_the_height_of_their_own_slab),
        cmocka_unit_test(slabs_that_have_a_record_get_no_links),
        cmocka_unit_test(nothing_is_linked_with_nothing),
        cmocka_unit_test(random_stacks_are_linked_as_the_rule_says),
        cmocka_unit_test(a_long_chain_is_joined_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
