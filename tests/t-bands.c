/* t-bands.c - faces get the bands that a map of closed lines must have, and contradictions
 * are blamed on the line that makes them. */
#include "config.h"
#include "terrain/bands.h"
#include "base/alloc.h"
#include "stacks.h"
#include "test.h"

#include <string.h>

enum { MOST = 64 };

/* A map as borders; made by hand. */
typedef struct map { il_border border[MOST]; size_t n, n_faces, n_lines; } map;

static void part(map *m, uint32_t line, int32_t level, uint32_t left, uint32_t right, double length)
{
    assert_true(m->n < MOST);
    m->border[m->n++] = (il_border){ { left, right }, line, level, length, { line + 0.25, length } };
    m->n_lines = m->n_lines > line + 1 ? m->n_lines : line + 1;
    for (int side = 0; side < 2; side++)
        m->n_faces = m->n_faces > m->border[m->n - 1].face[side] + 1 ? m->n_faces : m->border[m->n - 1].face[side] + 1;
}

/* Line i is ring i of N, of level[i], around face i + 1 and in face i. */
static map nest(const int32_t *level, size_t n)
{
    map m = { .n = 0 };
    for (uint32_t i = 0; i < n; i++)
        part(&m, i, level[i], i % 2 ? i : i + 1, i % 2 ? i + 1 : i, 100. - i);
    return m;
}

static il_bands label(const map *m, size_t n_levels)
{
    il_bands b;
    il_error err = { 0 };
    assert_int_equal(il_bands_label(&b, m->border, m->n, m->n_faces, m->n_lines, n_levels, IL_SIDE_UNKNOWN, &err), IL_OK);
    return b;
}

/* The faces' bands are low[], each as high as one level more but where `high` says so. */
static void assert_bands(const map *m, const il_bands *b, const int32_t *low)
{
    for (size_t f = 0; f < m->n_faces; f++) {
        assert_int_equal(b->band[f].low, low[f]);
        assert_int_equal(b->band[f].high, low[f] + 1);
    }
}

static void assert_clean(const map *m, size_t n_levels, const int32_t *low)
{
    il_bands b = label(m, n_levels);
    assert_int_equal(b.n_discords, 0);
    assert_int_equal(b.n_left_out, 0);
    assert_bands(m, &b, low);
    il_bands_free(&b);
}

static void assert_discord(const il_discord *d, il_discord_kind kind, uint32_t line, uint32_t other)
{
    assert_int_equal(d->kind, kind);
    assert_int_equal(d->line[0], line);
    assert_int_equal(d->line[1], other);
    assert_true(d->at[0] == line + 0.25);
}

static bool is_named(const il_bands *b, uint32_t line)
{
    for (size_t i = 0; i < b->n_discords; i++)
        if (b->discord[i].line[0] == line || b->discord[i].line[1] == line)
            return true;
    return false;
}

/* ---- maps that are right ----------------------------------------------------------------- */

static void rings_in_rings_are_a_hill_or_a_pit(void **state)
{
    (void)state;
    map hill = nest((int32_t[]){ 0, 1, 2, 3 }, 4), pit = nest((int32_t[]){ 3, 2, 1, 0 }, 4);
    assert_clean(&hill, 4, (int32_t[]){ -1, 0, 1, 2, 3 });
    assert_clean(&pit, 4, (int32_t[]){ 3, 2, 1, 0, -1 });
}

static void a_ring_of_the_same_level_in_a_hill_is_a_crater(void **state)
{
    (void)state;
    map crater = nest((int32_t[]){ 0, 1, 2, 2, 1 }, 5), moat = nest((int32_t[]){ 1, 0, 0, 1, 1, 0 }, 6);
    assert_clean(&crater, 3, (int32_t[]){ -1, 0, 1, 2, 1, 0 });
    assert_clean(&moat, 2, (int32_t[]){ 1, 0, -1, 0, 1, 0, -1 });
}

/* Two peaks above a saddle, two valleys below it, all lines cut by the frame but the peaks'. */
static void a_saddle_lies_between_its_peaks_and_its_valleys(void **state)
{
    (void)state;
    map m = { .n = 0 };
    for (uint32_t k = 0; k < 2; k++) {
        part(&m, k, 1, 0, 1 + k, 10);
        part(&m, 2 + k, 0, 3 + k, 0, 20);
        part(&m, 4 + k, 2, 5 + k, 1 + k, 5);
    }
    assert_clean(&m, 3, (int32_t[]){ 0, 1, 1, -1, -1, 2, 2 });
}

/* Islands in a sea: each of them says where the sea lies, the empty ones learn it from it. */
static void a_face_of_one_level_learns_from_far_away(void **state)
{
    (void)state;
    map m = { .n = 0 };
    for (uint32_t k = 0; k < 5; k++)
        part(&m, k, 0, 1 + k, 0, 1 + k);
    part(&m, 5, 1, 6, 5, 1);
    part(&m, 6, 0, 7, 1, 1);
    assert_clean(&m, 2, (int32_t[]){ -1, 0, 0, 0, 0, 0, 1, -1 });
}

/* Where a line touches others or the frame it has several borders. */
static void a_line_in_pieces_is_one_line(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 2 }, 3);
    part(&m, 0, 0, 0, 1, 7);
    part(&m, 1, 1, 1, 2, 3);
    part(&m, 1, 1, 4, 1, 3); /* line 1 touches itself: a second hill */
    assert_clean(&m, 3, (int32_t[]){ -1, 0, 1, 2, 1 });
}

static void a_map_without_lines_has_any_height(void **state)
{
    (void)state;
    map m = { .n_faces = 1 };
    il_bands b = label(&m, 4);
    assert_int_equal(b.band[0].low, -1);
    assert_int_equal(b.band[0].high, 4);
    il_bands_free(&b);
    il_bands_free(&b);
}

/* ---- one level ----------------------------------------------------------------------------- */

static il_status label_one(const map *m, il_side high, il_bands *b)
{
    il_error err = { 0 };
    il_status st = il_bands_label(b, m->border, m->n, m->n_faces, m->n_lines, 1, high, &err);
    char words[400];
    il_error_message(&err, words, sizeof words);
    assert_true(st == IL_OK || strstr(words, "--high"));
    return st;
}

static void lines_of_one_level_go_by_their_direction(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 0, 0 }, 3);
    il_bands b;
    assert_int_equal(label_one(&m, IL_SIDE_UNKNOWN, &b), IL_E_INPUT);
    assert_null(b.band);
    assert_int_equal(label_one(&m, IL_SIDE_LEFT, &b), IL_OK);
    assert_bands(&m, &b, (int32_t[]){ -1, 0, -1, 0 });
    il_bands_free(&b);
    assert_int_equal(label_one(&m, IL_SIDE_RIGHT, &b), IL_OK);
    assert_bands(&m, &b, (int32_t[]){ 0, -1, 0, -1 });
    assert_int_equal(b.n_discords, 0);
    il_bands_free(&b);
}

static void a_direction_that_contradicts_another_is_left_out(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 3; k++) {
        map m = nest((int32_t[]){ 0, 0, 0 }, 3);
        m.border[k].face[0] ^= m.border[k].face[1];
        m.border[k].face[1] ^= m.border[k].face[0];
        m.border[k].face[0] ^= m.border[k].face[1];
        il_bands b;
        assert_int_equal(label_one(&m, IL_SIDE_LEFT, &b), IL_OK);
        assert_int_equal(b.n_discords, b.n_left_out);
        assert_in_range(b.n_left_out, 1, 2);
        il_bands_free(&b);
    }
}

/* Directions are no guide where heights are, right or wrong. */
static void directions_do_not_matter_beside_heights(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 1, 0 }, 4);
    for (int high = IL_SIDE_UNKNOWN; high <= IL_SIDE_RIGHT; high++) {
        il_bands b;
        il_error err = { 0 };
        assert_int_equal(il_bands_label(&b, m.border, m.n, m.n_faces, m.n_lines, 2, (il_side)high, &err), IL_OK);
        assert_int_equal(b.n_discords, 0);
        assert_bands(&m, &b, (int32_t[]){ -1, 0, 1, 0, -1 });
        il_bands_free(&b);
    }
}

/* ---- contradictions ------------------------------------------------------------------------- */

static void the_line_of_a_wrong_height_is_left_out_and_the_missing_one_told(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 2, 5, 4, 5 }, 6); /* 5 for 3 */
    il_bands b = label(&m, 6);
    assert_int_equal(b.n_left_out, 1);
    assert_true(b.left_out[3]);
    assert_int_equal(b.n_discords, 2);
    assert_discord(&b.discord[0], IL_DISCORD_MISSING, 2, 4);
    assert_discord(&b.discord[1], IL_DISCORD_SIDES, 3, 4);
    assert_true(b.discord[1].is_below);
    for (uint32_t f = 3; f < 5; f++) {
        assert_int_equal(b.band[f].low, 2);
        assert_int_equal(b.band[f].high, 4);
    }
    il_bands_free(&b);
}

/* The innermost of a hill may be a crater's, the outermost a valley's: then nothing is wrong.
 * The innermost may be as high as it likes: lines are missing then.  All else names it, and
 * leaves out nothing else. */
static void a_wrong_height_anywhere_is_named(void **state)
{
    (void)state;
    enum { N = 7 };
    for (int32_t at = 0; at < N; at++)
        for (int32_t wrong = 0; wrong < N; wrong++) {
            int32_t level[N] = { 0, 1, 2, 3, 4, 5, 6 };
            level[at] = wrong;
            map m = nest(level, N);
            il_bands b = label(&m, N);
            bool may_be = wrong == at || (at == N - 1 && wrong == N - 2) || (at == 0 && wrong == 1);
            if (may_be)
                assert_int_equal(b.n_discords, 0);
            else
                assert_true(is_named(&b, (uint32_t)at));
            for (int32_t i = 0; i < N; i++)
                assert_true(i == at || !b.left_out[i]);
            il_bands_free(&b);
        }
}

/* A hill of seven lines among six others like it, in one sea. */
static void a_wrong_height_among_neighbours_is_named(void **state)
{
    (void)state;
    enum { HILLS = 7, N = 7 };
    for (uint32_t at = 0; at < N; at++)
        for (int32_t wrong = 0; wrong < N; wrong++) {
            map m = { .n = 0 };
            for (uint32_t h = 0; h < HILLS; h++)
                for (uint32_t i = 0; i < N; i++)
                    part(&m, h * N + i, h == 3 && i == at ? wrong : (int32_t)i, i == 0 ? 0 : h * N + i, h * N + i + 1, 20. - i);
            il_bands b = label(&m, N);
            if (wrong == (int32_t)at || (at == N - 1 && wrong == N - 2))
                assert_int_equal(b.n_discords, 0);
            else
                assert_true(is_named(&b, 3 * N + at));
            for (uint32_t i = 0; i < HILLS * N; i++)
                assert_true(i == 3 * N + at || !b.left_out[i]);
            il_bands_free(&b);
        }
}

static void lines_that_changed_heights_are_named(void **state)
{
    (void)state;
    enum { N = 8 };
    for (uint32_t i = 1; i < N - 1; i++)
        for (uint32_t j = i + 1; j < N - 1; j++) {
            int32_t level[N] = { 0, 1, 2, 3, 4, 5, 6, 7 };
            level[i] = (int32_t)j;
            level[j] = (int32_t)i;
            map m = nest(level, N);
            il_bands b = label(&m, N);
            assert_true(is_named(&b, i) && is_named(&b, j));
            for (uint32_t k = 0; k < N; k++)
                assert_true(k == i || k == j || !b.left_out[k]);
            il_bands_free(&b);
        }
}

static void a_missing_line_is_told_by_its_neighbours(void **state)
{
    (void)state;
    for (uint32_t gap = 1; gap < 6; gap++) {
        int32_t level[6] = { 0, 1, 2, 3, 4, 5 };
        for (uint32_t i = gap; i < 6; i++)
            level[i]++;
        map m = nest(level, 6);
        il_bands b = label(&m, 7);
        assert_int_equal(b.n_discords, 1);
        assert_int_equal(b.n_left_out, 0);
        assert_discord(&b.discord[0], IL_DISCORD_MISSING, gap - 1, gap);
        for (uint32_t f = 0; f < 7; f++) {
            assert_int_equal(b.band[f].low, (int32_t)f - 1 + (f > gap));
            assert_int_equal(b.band[f].high, (int32_t)f + (f >= gap));
        }
        il_bands_free(&b);
    }
}

/* Six hills, of which one lacks its lowest line: the sea goes on below that level there. */
static void a_line_that_is_missing_in_the_sea_leaves_the_others(void **state)
{
    (void)state;
    for (uint32_t hills = 2; hills < 7; hills++) {
        map m = { .n = 0 };
        for (uint32_t h = 0; h < hills; h++)
            for (uint32_t i = 0; i < 3; i++)
                if (h > 0 || i > 0)
                    part(&m, 3 * h + i - 1, (int32_t)i, i == 0 || (h == 0 && i == 1) ? 0 : 3 * h + i - 1, 3 * h + i, 9. - i);
        il_bands b = label(&m, 3);
        assert_int_equal(b.n_left_out, 0);
        assert_int_equal(b.n_discords, 1);
        assert_discord(&b.discord[0], IL_DISCORD_MISSING, 2, 0);
        assert_true(b.band[0].low == -1 && b.band[0].high == 1);
        for (uint32_t f = 1; f < 3 * hills; f++)
            assert_int_equal(b.band[f].low, (int32_t)(f % 3));
        il_bands_free(&b);
    }
}

static void a_third_level_is_told(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 3 }, 3);
    part(&m, 3, 2, 4, 2, 1); /* a knoll, or a hollow, where line 2 is not */
    part(&m, 4, 2, 5, 2, 2);
    part(&m, 5, 3, 6, 5, 2);
    il_bands b = label(&m, 4);
    assert_int_equal(b.n_left_out, 0);
    assert_int_equal(b.n_discords, 2);
    assert_discord(&b.discord[0], IL_DISCORD_MISSING, 1, 2);
    assert_discord(&b.discord[1], IL_DISCORD_MANY, 1, 4);
    assert_int_equal(b.band[5].low, 2);
    assert_int_equal(b.band[4].low, 2); /* nothing tells: a knoll */
    il_bands_free(&b);
}

static void a_line_with_one_face_on_both_sides_is_left_out(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 2 }, 3);
    part(&m, 3, 2, 1, 1, 5);
    part(&m, 4, 0, 2, 2, 5);
    il_bands b = label(&m, 3);
    assert_int_equal(b.n_left_out, 2);
    assert_int_equal(b.n_discords, 2);
    assert_discord(&b.discord[0], IL_DISCORD_SIDES, 3, UINT32_MAX);
    assert_discord(&b.discord[1], IL_DISCORD_SIDES, 4, UINT32_MAX);
    assert_bands(&m, &b, (int32_t[]){ -1, 0, 1, 2 });
    il_bands_free(&b);
}

/* Ring A of level 1 and ring B of level 2 cross in two places: a face in both, one in each. */
static void lines_that_cross_are_both_named(void **state)
{
    (void)state;
    map m = { .n = 0 };
    part(&m, 0, 0, 1, 0, 90);
    part(&m, 1, 1, 2, 1, 30);   /* A outside of B, A inside of B */
    part(&m, 1, 1, 4, 3, 10);
    part(&m, 2, 2, 3, 1, 10);   /* B outside of A, B inside of A */
    part(&m, 2, 2, 4, 2, 25);
    part(&m, 3, 3, 5, 4, 5);
    il_bands b = label(&m, 4);
    assert_int_equal(b.n_left_out, 1);
    assert_true(is_named(&b, 1) && is_named(&b, 2));
    il_bands_free(&b);
}

/* ---- any map of closed lines ------------------------------------------------------------------ */

/* A tree of faces, each a band above or below the one it lies in. */
typedef struct tree { il_border *border; int32_t *low; size_t n, n_faces, n_levels; } tree;

static void tree_free(tree *t)
{
    il_free(t->border);
    il_free(t->low);
}

/* reach: 0: all in the first face; 1: any face is as likely; more: one in another. */
static tree random_tree(uint64_t *seed, size_t n_faces, int reach)
{
    tree t = { il_alloc(3 * n_faces, sizeof *t.border), il_alloc(n_faces, sizeof *t.low), 0, n_faces, 0 };
    int32_t least = 0, most = 0;
    assert_true(t.border && t.low);
    uint32_t *outer = il_alloc(n_faces, sizeof *outer);
    assert_non_null(outer);
    t.low[0] = 0;
    for (uint32_t f = 1; f < n_faces; f++) {
        uint32_t from = reach == 0 || f < 3 ? 0 : reach == 1 ? 0 : f > 4 ? f - 4 : 0;
        outer[f] = reach == 0 ? (f < 3 ? f - 1 : 0) : from + (uint32_t)(stack_random(seed) % (f - from));
        t.low[f] = t.low[outer[f]] + (stack_random(seed) % 3 ? 1 : -1);
        least = t.low[f] < least ? t.low[f] : least;
        most = t.low[f] > most ? t.low[f] : most;
    }
    for (uint32_t f = 0; f < n_faces; f++)
        t.low[f] -= least + 1;
    t.n_levels = (size_t)(most - least);
    for (uint32_t f = 1; f < n_faces; f++) {
        int32_t level = t.low[f] > t.low[outer[f]] ? t.low[f] : t.low[outer[f]];
        for (uint64_t k = stack_random(seed) % 8 ? 1 : 3; k > 0; k--) {
            bool left = stack_random(seed) % 2;
            t.border[t.n++] = (il_border){ { left ? f : outer[f], left ? outer[f] : f }, f - 1, level,
                                           stack_uniform(seed) + 1, { stack_uniform(seed), f } };
        }
    }
    il_free(outer);
    return t;
}

static void shuffle(il_border *b, size_t n, uint64_t *seed)
{
    for (size_t i = n; i > 1; i--) {
        size_t k = stack_random(seed) % i;
        il_border keep = b[k];
        b[k] = b[i - 1];
        b[i - 1] = keep;
    }
}

static void every_tree_of_faces_gets_its_bands_back(void **state)
{
    (void)state;
    uint64_t seed = 61;
    size_t asked = 0;
    for (int k = 0; k < 3000; k++) {
        tree t = random_tree(&seed, 2 + stack_random(&seed) % (k % 10 ? 40 : 2000), k % 4);
        il_bands b;
        il_error err = { 0 };
        shuffle(t.border, t.n, &seed);
        il_status st = il_bands_label(&b, t.border, t.n, t.n_faces, t.n_faces - 1, t.n_levels, IL_SIDE_UNKNOWN, &err);
        assert_int_equal(st, t.n_levels > 1 ? IL_OK : IL_E_INPUT);
        asked += t.n_levels > 1;
        if (st == IL_OK) {
            assert_int_equal(b.n_discords, 0);
            for (size_t f = 0; f < t.n_faces; f++) {
                assert_int_equal(b.band[f].low, t.low[f]);
                assert_int_equal(b.band[f].high, t.low[f] + 1);
            }
        }
        il_bands_free(&b);
        tree_free(&t);
    }
    assert_true(asked > 2500);
}

static void assert_same(const il_bands *a, const il_bands *b, size_t n_faces, size_t n_lines)
{
    assert_memory_equal(a->band, b->band, n_faces * sizeof *a->band);
    assert_memory_equal(a->left_out, b->left_out, n_lines);
    assert_int_equal(a->n_left_out, b->n_left_out);
    assert_int_equal(a->n_discords, b->n_discords);
    for (size_t i = 0; i < a->n_discords; i++) {
        const il_discord *c = &a->discord[i], *d = &b->discord[i];
        assert_true(c->kind == d->kind && c->line[0] == d->line[0] && c->line[1] == d->line[1] && c->is_below == d->is_below &&
                    c->at[0] == d->at[0] && c->at[1] == d->at[1]);
    }
}

static void spoil(tree *t, uint64_t *seed, size_t times)
{
    for (; times > 0; times--) {
        uint32_t line = t->border[stack_random(seed) % t->n].line;
        int32_t level = (int32_t)(stack_random(seed) % t->n_levels);
        for (size_t i = 0; i < t->n; i++)
            if (t->border[i].line == line)
                t->border[i].level = level;
    }
}

/* Nothing goes wrong in the map that is left. */
static void assert_rest_is_right(const tree *t, const il_bands *b)
{
    for (size_t i = 0; i < t->n; i++) {
        const il_border *e = &t->border[i];
        if (b->left_out[e->line])
            continue;
        il_band left = b->band[e->face[0]], right = b->band[e->face[1]];
        bool left_inner = left.low < e->level && e->level < left.high, right_inner = right.low < e->level && e->level < right.high;
        assert_true(left.low <= e->level && e->level <= left.high && right.low <= e->level && e->level <= right.high);
        assert_true(left_inner || right_inner || (left.low == e->level) != (right.low == e->level));
    }
}

static void the_order_of_borders_does_not_matter(void **state)
{
    (void)state;
    uint64_t seed = 62;
    for (int k = 0; k < 1000; k++) {
        tree t = random_tree(&seed, 12 + stack_random(&seed) % 60, 1 + k % 3);
        il_bands b[2];
        il_status st[2];
        if (t.n_levels < 3) {
            tree_free(&t);
            continue;
        }
        spoil(&t, &seed, 1 + (size_t)k % 5);
        for (int i = 0; i < 2; i++) {
            shuffle(t.border, t.n, &seed);
            st[i] = il_bands_label(&b[i], t.border, t.n, t.n_faces, t.n_faces - 1, t.n_levels, IL_SIDE_UNKNOWN, NULL);
        }
        assert_int_equal(st[0], st[1]);
        if (st[0] == IL_OK) {
            assert_same(&b[0], &b[1], t.n_faces, t.n_faces - 1);
            assert_rest_is_right(&t, &b[0]);
        }
        for (int i = 0; i < 2; i++)
            il_bands_free(&b[i]);
        tree_free(&t);
    }
}

/* Every third line wrong, in a sea of islands or a heap of all: trials come to an end. */
static void a_hostile_map_takes_no_quadratic_time(void **state)
{
    (void)state;
    uint64_t seed = 63;
    for (int reach = 0; reach < 3; reach++) {
        tree t = random_tree(&seed, 30000, reach);
        il_bands b;
        spoil(&t, &seed, 100);
        for (size_t i = 0; i < t.n; i++)
            if (t.border[i].line % 3 == 0)
                t.border[i].level = (int32_t)(t.border[i].line / 3 % t.n_levels);
        il_status st = il_bands_label(&b, t.border, t.n, t.n_faces, t.n_faces - 1, t.n_levels, IL_SIDE_UNKNOWN, NULL);
        assert_true(st == IL_OK || st == IL_E_INPUT);
        if (st == IL_OK)
            assert_rest_is_right(&t, &b);
        il_bands_free(&b);
        tree_free(&t);
    }
}

static void memory_that_runs_out_is_told(void **state)
{
    (void)state;
    map m = nest((int32_t[]){ 0, 1, 2, 5, 4, 5, 3, 7 }, 8);
    il_status st = IL_E_NOMEM;
    for (long k = 0; st == IL_E_NOMEM; k++) {
        il_bands b;
        assert_true(k < 100);
        il_alloc_test_fail_after(k);
        st = il_bands_label(&b, m.border, m.n, m.n_faces, m.n_lines, 8, IL_SIDE_UNKNOWN, NULL);
        il_alloc_test_fail_after(-1);
        il_bands_free(&b);
    }
    assert_int_equal(st, IL_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_in_rings_are_a_hill_or_a_pit),
        cmocka_unit_test(a_ring_of_the_same_level_in_a_hill_is_a_crater),
        cmocka_unit_test(a_saddle_lies_between_its_peaks_and_its_valleys),
        cmocka_unit_test(a_face_of_one_level_learns_from_far_away),
        cmocka_unit_test(a_line_in_pieces_is_one_line),
        cmocka_unit_test(a_map_without_lines_has_any_height),
        cmocka_unit_test(lines_of_one_level_go_by_their_direction),
        cmocka_unit_test(a_direction_that_contradicts_another_is_left_out),
        cmocka_unit_test(directions_do_not_matter_beside_heights),
        cmocka_unit_test(the_line_of_a_wrong_height_is_left_out_and_the_missing_one_told),
        cmocka_unit_test(a_wrong_height_anywhere_is_named),
        cmocka_unit_test(a_wrong_height_among_neighbours_is_named),
        cmocka_unit_test(lines_that_changed_heights_are_named),
        cmocka_unit_test(a_missing_line_is_told_by_its_neighbours),
        cmocka_unit_test(a_line_that_is_missing_in_the_sea_leaves_the_others),
        cmocka_unit_test(a_third_level_is_told),
        cmocka_unit_test(a_line_with_one_face_on_both_sides_is_left_out),
        cmocka_unit_test(lines_that_cross_are_both_named),
        cmocka_unit_test(every_tree_of_faces_gets_its_bands_back),
        cmocka_unit_test(the_order_of_borders_does_not_matter),
        cmocka_unit_test(a_hostile_map_takes_no_quadratic_time),
        cmocka_unit_test(memory_that_runs_out_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
