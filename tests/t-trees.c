/* t-trees.c - vessel trees whose connectivity is known: what is linked of them at which spacing
 * and slant, and what surfaces become of it. */
#include "config.h"
#include "match/linker.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "lofting.h"
#include "match/link.h"
#include "match/matcher.h"
#include "region/clean.h"
#include "test.h"
#include "trees.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TREES = 200, N_SPACINGS = 5, N_PIECES = 3 };

static const uint32_t NOTHING = UINT32_MAX;

/* In mean diameters of the tubes. */
static const double spacings[N_SPACINGS] = { .25, .5, 1, 2, 4 };

static void make(tree *t, uint64_t i)
{
    tree_make(t, (tree_kind)(i % TREE_N_KINDS), i);
}

static void cut(const tree *t, size_t spacing, uint64_t i, tree_slices *to)
{
    tree_cut(t, spacings[spacing] * t->width, i, to);
}

static bool is_true_link(const tree_slices *s, size_t slab, size_t lower, size_t upper)
{
    uint32_t piece = s->above[s->first[slab] + lower];
    return piece != NOTHING && piece == s->below[s->first[slab + 1] + upper];
}

static bool have_overlap(const il_slice *lower, const il_slice *upper, size_t i, size_t j)
{
    il_slice a = *lower, b = *upper;
    uint32_t *link = NULL;
    size_t n = 0;
    a.ring += i, a.n = 1;
    b.ring += j, b.n = 1;
    assert_int_equal(il_link_overlaps(&a, &b, &link, &n, NULL), IL_OK);
    il_free(link);
    return n > 0;
}

static uint32_t *forest_of(size_t n)
{
    uint32_t *up = il_alloc(n + 1, sizeof *up);
    assert_non_null(up);
    il_forest_plant(up, n);
    return up;
}

/* ---- the trees themselves ------------------------------------------------------------- */

static void assert_outlines(const tree_slices *s)
{
    for (size_t k = 0; k < s->n; k++) {
        bool changed = true;
        il_slice copy;
        assert_int_equal(il_slice_copy(&copy, &s->slice[k], NULL), IL_OK);
        assert_int_equal(il_slice_clean(&copy, &(il_clean_options){ false, 0, false }, NULL, &changed, NULL), IL_OK);
        assert_false(changed);
        il_slice_free(&copy);
        for (size_t i = 0; i < s->slice[k].n; i++) {
            assert_true(il_ring_area2(&s->slice[k].ring[i]) > 0);
            assert_true(k == 0 || s->below[s->first[k] + i] != NOTHING);
            assert_true(k + 1 == s->n || s->above[s->first[k] + i] != NOTHING);
        }
    }
}

static void slices_are_clean_outlines(void **state)
{
    (void)state;
    size_t n_rings = 0, n_points = 0, n_crossings = 0;
    for (uint64_t i = 0; i < TREES; i++) {
        tree t;
        make(&t, i);
        n_crossings += tree_crossings(&t) > 0;
        for (size_t k = 0; k < N_SPACINGS; k++) {
            tree_slices s;
            cut(&t, k, i, &s);
            assert_outlines(&s);
            n_rings += s.first[s.n];
            for (size_t j = 0; j < s.n; j++)
                n_points += il_slice_points(&s.slice[j]);
            tree_slices_free(&s);
        }
    }
    print_message("# %d trees, %zu with crossings in projection; %zu rings of %.3g points\n", TREES, n_crossings, n_rings,
                  (double)n_points / (double)n_rings);
    assert_true(n_crossings > TREES / 5);
}

/* Join in UP the regions of A, numbered from FROM, and of B, behind them, that overlap. */
static void join_overlaps(uint32_t *up, size_t from, const il_slice *a, const il_slice *b)
{
    uint32_t *link = NULL;
    size_t n = 0;
    assert_int_equal(il_link_overlaps(a, b, &link, &n, NULL), IL_OK);
    for (size_t i = 0; i < n; i++)
        il_forest_join(up, (uint32_t)from + link[2 * i], (uint32_t)(from + a->n) + link[2 * i + 1]);
    il_free(link);
}

enum { MOST_SECTIONS = 200, MOST_RINGS = 20 * MOST_SECTIONS };

/* Planes much closer than the thinnest tube is wide, and than tubes are to others, join by overlap just what
 * is one piece. */
static void assert_pieces(const tree *t, const tree_slices *s, size_t k)
{
    const il_slice *lower = &s->slice[k], *upper = &s->slice[k + 1];
    size_t n = (size_t)ceil((upper->z - lower->z) / .3), at = 0;
    uint32_t *up = forest_of(MOST_RINGS);
    il_slice last = *lower, next;
    assert_true(n <= MOST_SECTIONS);
    for (size_t i = 1; i <= n; i++, last = next) {
        if (i < n)
            tree_section(t, lower->z + (upper->z - lower->z) * (double)i / (double)n, &next);
        else
            next = *upper;
        assert_true(at + last.n + next.n <= MOST_RINGS);
        join_overlaps(up, at, &last, &next);
        at += last.n;
        if (i > 1)
            il_slice_free(&last);
    }
    for (size_t i = 0; i < lower->n + upper->n; i++)
        for (size_t j = 0; j < i; j++) {
            uint32_t piece[2], joined[2];
            for (int e = 0; e < 2; e++) {
                size_t r = e ? j : i;
                piece[e] = r < lower->n ? s->above[s->first[k] + r] : s->below[s->first[k + 1] + r - lower->n];
                joined[e] = il_forest_leader(up, (uint32_t)(r < lower->n ? r : at + r - lower->n));
            }
            assert_int_equal(piece[0] == piece[1], joined[0] == joined[1]);
        }
    il_free(up);
}

static void pieces_are_what_many_slices_tell(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < TREES; i += getenv("ISOLOFT_LONG") ? 1 : 4)
        for (size_t spacing = 2; spacing < N_SPACINGS; spacing++) {
            tree t;
            tree_slices s;
            make(&t, i);
            cut(&t, spacing, i, &s);
            for (size_t k = 0; k + 1 < s.n; k++)
                assert_pieces(&t, &s, k);
            tree_slices_free(&s);
        }
}

/* ---- links ------------------------------------------------------------------------------ */

/* Links between rings that bound one piece: those there are, and found; those found that are none; those there
 * are though the rings do not overlap. */
typedef struct score { size_t right, missed, wrong, apart; } score;

/* Rings linked directly or through others. */
static uint32_t *groups_of(const tree_slices *s, size_t slab, const il_linkage *l)
{
    uint32_t n_lower = (uint32_t)s->slice[slab].n, *up = forest_of(n_lower + s->slice[slab + 1].n);
    for (size_t i = l->first[slab]; i < l->first[slab + 1]; i++)
        il_forest_join(up, l->link[i].lower, n_lower + l->link[i].upper);
    return up;
}

/* overlap[]: the pairs of rings in all slabs, in order, that overlap links; which the others must find as well. */
static void score_links(const tree_slices *s, const il_linkage *l, score *to, bool *overlap, bool set)
{
    for (size_t k = 0; k + 1 < s->n; k++) {
        uint32_t n_lower = (uint32_t)s->slice[k].n, *up = groups_of(s, k, l);
        for (uint32_t i = 0; i < n_lower; i++)
            for (uint32_t j = 0; j < s->slice[k + 1].n; j++, overlap++) {
                bool linked = il_forest_leader(up, i) == il_forest_leader(up, n_lower + j), is_one = is_true_link(s, k, i, j);
                to->right += linked && is_one;
                to->missed += !linked && is_one;
                to->wrong += linked && !is_one;
                to->apart += is_one && !have_overlap(&s->slice[k], &s->slice[k + 1], i, j);
                *overlap |= linked && set;
                assert_true(linked || !*overlap);
            }
        il_free(up);
    }
}

static void find_links(const tree_slices *s, int pieces, il_linkage *l)
{
    static const il_pieces_mode all[N_PIECES] = { IL_PIECES_OVERLAP, IL_PIECES_USUAL, IL_PIECES_FEW };
    const il_pair **none = il_calloc(s->n, sizeof *none);
    il_linkage_options o = il_linkage_options_for(all[pieces]);
    assert_non_null(none);
    assert_int_equal(il_linkage_find(l, s->slice, s->n, none, &o, NULL), IL_OK);
    il_free(none);
}

static size_t count_pairs(const tree_slices *s)
{
    size_t n = 0;
    for (size_t k = 0; k + 1 < s->n; k++)
        n += s->slice[k].n * s->slice[k + 1].n;
    return n;
}

typedef struct table { score cell[N_SPACINGS][TREE_N_KINDS][N_PIECES]; } table;

static void measure(table *to)
{
    *to = (table){ 0 };
    for (uint64_t i = 0; i < TREES; i++)
        for (size_t spacing = 0; spacing < N_SPACINGS; spacing++) {
            tree t;
            tree_slices s;
            make(&t, i);
            cut(&t, spacing, i, &s);
            bool *overlap = il_calloc(count_pairs(&s) + 1, sizeof *overlap);
            assert_non_null(overlap);
            for (int p = 0; p < N_PIECES; p++) {
                il_linkage l = IL_LINKAGE_INIT;
                find_links(&s, p, &l);
                score_links(&s, &l, &to->cell[spacing][i % TREE_N_KINDS][p], overlap, p == 0);
                il_linkage_free(&l);
            }
            il_free(overlap);
            tree_slices_free(&s);
        }
}

/* Of nothing, nothing is wrong. */
static double share(size_t of, size_t all) { return all > 0 ? (double)of / (double)all : 1; }
static double precision(const score *s) { return share(s->right, s->right + s->wrong); }
static double recall(const score *s) { return share(s->right, s->right + s->missed); }
static double harmony(const score *s) { return share(2 * s->right, 2 * s->right + s->wrong + s->missed); }
static double apart(const score *s) { return share(s->apart, s->right + s->missed); }

static void print_table(const table *t)
{
    static const char *const kind[TREE_N_KINDS] = { "0-20", "20-40", "40-60", "60-80", "0-80" };
    print_message("# precision, recall and F1 of links; apart: true ones without overlap\n"
                  "# spacing/width  slant  links  apart         overlap             usual               few\n");
    for (size_t k = 0; k < N_SPACINGS; k++)
        for (int i = 0; i < TREE_N_KINDS; i++) {
            const score *s = t->cell[k][i];
            print_message("# %13g  %5s %6zu  %4.1f%%", spacings[k], kind[i], s->right + s->missed, 100 * apart(s));
            for (int p = 0; p < N_PIECES; p++)
                print_message("   %.3f %.3f %.3f", precision(&s[p]), recall(&s[p]), harmony(&s[p]));
            print_message("\n");
        }
}

/* F1 to be had at least where so much is APART: what the same rule reaches on scanned veins, the lowest of two
 * trees and three positions, at 80, 40, 20 and 10 planes. */
static double reference(double apart)
{
    static const double at[][2] = { { 0, .98 }, { .156, .98 }, { .403, .92 }, { .772, .72 }, { .908, .42 }, { 1, .42 } };
    size_t i = 1;
    while (at[i][0] < apart)
        i++;
    return at[i - 1][1] + (at[i][1] - at[i - 1][1]) * (apart - at[i - 1][0]) / (at[i][0] - at[i - 1][0]);
}

static void assert_at_least(double value, double bound, const char *what, size_t spacing, int kind)
{
    if (!(value >= bound))
        fail_msg("%s: %g < %g at spacing %g, kind %d", what, value, bound, spacings[spacing], kind);
}

/* Differences below 0.01 mean nothing: cells have a few hundred links. */
static void links_are_found_as_well_as_sampling_allows(void **state)
{
    (void)state;
    table found;
    measure(&found);
    print_table(&found);
    for (size_t k = 0; k < N_SPACINGS; k++)
        for (int i = 0; i < TREE_N_KINDS; i++) {
            const score *overlap = &found.cell[k][i][0], *usual = &found.cell[k][i][1], *few = &found.cell[k][i][2];
            assert_at_least(harmony(few), reference(apart(few)) - .01, "F1 of few, as on scans", k, i);
            assert_at_least(harmony(few), harmony(usual), "F1 of few, as usual", k, i);
            assert_at_least(recall(few), recall(usual) - .03, "recall of few, as usual", k, i);
            assert_at_least(recall(usual), recall(overlap), "recall, as by overlap", k, i);
            assert_at_least(harmony(usual), harmony(overlap) - .02, "F1, as by overlap", k, i);
            if (spacings[k] <= .5)
                assert_at_least(harmony(few), .997, "F1 where slices are close", k, i);
        }
}

/* ---- surfaces --------------------------------------------------------------------------------- */

static il_status send_slices(il_sink *to, const tree_slices *s, il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_status st = to->stack_begin(to, &head, err);
    for (size_t k = 0; k < s->n && st == IL_OK; k++) {
        il_slice copy;
        assert_int_equal(il_slice_copy(&copy, &s->slice[k], NULL), IL_OK);
        st = to->slice(to, &copy, err);
        il_slice_free(&copy);
    }
    if (st == IL_OK)
        st = to->stack_end(to, err);
    return st == IL_OK ? to->end(to, err) : st;
}

/* Linked to few pieces, matched and lofted. */
static il_status loft(const tree_slices *s, keeper *k, il_error *err)
{
    il_linkage_options link = il_linkage_options_for(IL_PIECES_FEW);
    il_match_options match = { IL_MATCHER_FFD, false, 1 };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_sink *lofter = NULL, *matcher = NULL, *linker = NULL;
    *k = new_keeper();
    assert_int_equal(il_lofter_new(&lofter, &o, &k->sink, NULL), IL_OK);
    assert_int_equal(il_matcher_new(&matcher, &match, lofter, NULL), IL_OK);
    assert_int_equal(il_linker_new(&linker, &link, NULL, matcher, NULL, NULL), IL_OK);
    il_status st = send_slices(linker, s, err);
    il_linker_free(linker);
    il_matcher_free(matcher);
    il_lofter_free(lofter);
    return st;
}

/* How many bodies there are if rings that true links join are one. */
static long count_bodies(const tree_slices *s)
{
    uint32_t n = (uint32_t)s->first[s->n], *up = forest_of(n);
    long count = 0;
    for (size_t k = 0; k + 1 < s->n; k++)
        for (size_t i = 0; i < s->slice[k].n; i++)
            for (size_t j = 0; j < s->slice[k + 1].n; j++)
                if (is_true_link(s, k, i, j))
                    il_forest_join(up, (uint32_t)(s->first[k] + i), (uint32_t)(s->first[k + 1] + j));
    for (uint32_t i = 0; i < n; i++)
        count += il_forest_leader(up, i) == i;
    il_free(up);
    return count;
}

/* Are all pairs that few links join true ones, and none missing? */
static bool is_linked_right(const tree_slices *s)
{
    il_linkage l = IL_LINKAGE_INIT;
    score found = { 0 };
    bool *overlap = il_calloc(count_pairs(s) + 1, sizeof *overlap);
    assert_non_null(overlap);
    find_links(s, 2, &l);
    score_links(s, &l, &found, overlap, false);
    il_linkage_free(&l);
    il_free(overlap);
    return found.missed + found.wrong == 0;
}

/* Trees lofted; those whose links are all right, and of these: those that came out as they are, in more
 * pieces, with handles. */
typedef struct outcome { size_t lofted, right, same, more, handles; } outcome;

static void loft_tree(uint64_t i, size_t spacing, outcome *to)
{
    tree t;
    tree_slices s;
    keeper k;
    il_error err = IL_ERROR_INIT;
    make(&t, i);
    cut(&t, spacing, i, &s);
    if (s.n < 2) { /* which has no height */
        tree_slices_free(&s);
        return;
    }
    if (loft(&s, &k, &err) != IL_OK) {
        char why[500];
        il_error_message(&err, why, sizeof why);
        fail_msg("tree %d, spacing %g: %s", (int)i, spacings[spacing], why);
    }
    assert_sound(&k, "tree", i);
    assert_true(k.facts.genus <= 2);
    to->lofted++;
    if (is_linked_right(&s)) {
        long bodies = count_bodies(&s), handles = k.facts.genus;
        to->right++;
        to->same += k.facts.components == bodies && handles == 0;
        to->more += k.facts.components > bodies;
        to->handles += handles > 0;
        assert_true(k.facts.components >= bodies && handles <= 1);
        if (spacings[spacing] <= .5 && (k.facts.components != bodies || handles > 0))
            fail_msg("tree %d, spacing %g: %ld bodies, genus %ld", (int)i, spacings[spacing], k.facts.components, handles);
    }
    il_mesh_free(&k.mesh);
    tree_slices_free(&s);
}

/* In the long form at every spacing, else at one.  Of those linked right 93 to 96 in a hundred come out as they are where
 * spacings are wide; the others have branches that fall off. */
static void all_are_lofted_soundly(void **state)
{
    (void)state;
    bool all = getenv("ISOLOFT_LONG") != NULL;
    for (size_t spacing = 0; spacing < N_SPACINGS; spacing++) {
        outcome o = { 0 };
        for (uint64_t i = 0; i < TREES; i++)
            if (all || (i + i / TREE_N_KINDS) % N_SPACINGS == spacing)
                loft_tree(i, spacing, &o);
        print_message("# spacing/width %g: %zu lofted, all links of %zu right; "
                      "of these %zu as they are, %zu in more pieces, %zu with handles\n",
                      spacings[spacing], o.lofted, o.right, o.same, o.more, o.handles);
        assert_true(10 * o.right >= 5 * o.lofted && 10 * o.same >= 8 * o.right);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slices_are_clean_outlines),
        cmocka_unit_test(pieces_are_what_many_slices_tell),
        cmocka_unit_test(links_are_found_as_well_as_sampling_allows),
        cmocka_unit_test(all_are_lofted_soundly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
