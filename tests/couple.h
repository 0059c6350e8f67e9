/* couple.h - two slices, what the matcher says of them, and what every record must be. */
#ifndef IL_TESTS_COUPLE_H
#define IL_TESTS_COUPLE_H

#include "base/output.h"
#include "base/source.h"
#include "contours.h"
#include "input/reader.h"
#include "match/ffd.h"
#include "match/matcher.h"
#include "matching.h"
#include "model/lattice.h"
#include "model/order.h"
#include "output/writer.h"
#include "region/clean.h"

/* ---- two slices and their pair ---- */

typedef struct couple {
    il_slice slice[2];        /* lower, upper */
    il_pair pair;
} couple;

static inline void clean(il_slice *s)
{
    assert_int_equal(il_slice_clean(s, &(il_clean_options){ false }, NULL, NULL, NULL), IL_OK);
}

static inline couple of_text(const char *lower, const char *upper)
{
    couple c = { { slice_of(lower), slice_of(upper) }, IL_PAIR_INIT };
    c.slice[1].z = 1;
    il_slice_put_in_order(&c.slice[0]);
    il_slice_put_in_order(&c.slice[1]);
    return c;
}

static inline il_ffd *new_solver(void)
{
    il_ffd *f = NULL;
    assert_int_equal(il_ffd_new(&f, NULL), IL_OK);
    return f;
}

static inline void match_with(couple *c, il_ffd *solver)
{
    const il_match_options o = { IL_MATCHER_FFD, true, 1 };
    il_pair_free(&c->pair);
    assert_int_equal(il_match_slices(&c->slice[0], &c->slice[1], &o, solver, &c->pair, NULL), IL_OK);
}

static inline void match(couple *c)
{
    il_ffd *solver = new_solver();
    match_with(c, solver);
    il_ffd_free(solver);
}

static inline couple copy_of(const couple *c)
{
    couple d = { { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT };
    for (int k = 0; k < 2; k++)
        assert_int_equal(il_slice_copy(&d.slice[k], &c->slice[k], NULL), IL_OK);
    return d;
}

static inline void free_couple(couple *c)
{
    il_slice_free(&c->slice[0]);
    il_slice_free(&c->slice[1]);
    il_pair_free(&c->pair);
}

/* ---- as text ---- */

/* A whole stream with the two slices and the pair; the caller discards it. */
static inline il_output *written(const couple *c)
{
    const il_stack_head head = IL_STACK_HEAD_INIT;
    couple d = copy_of(c); /* a sink may take what it gets */
    il_pair pair = c->pair;
    il_output *out;
    il_sink *w = NULL;
    assert_int_equal(il_output_to_memory(&out, NULL), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&w, out, NULL), IL_OK);
    assert_int_equal(w->stack_begin(w, &head, NULL), IL_OK);
    assert_int_equal(w->slice(w, &d.slice[0], NULL), IL_OK);
    assert_int_equal(w->slice(w, &d.slice[1], NULL), IL_OK);
    assert_int_equal(w->pair(w, &pair, NULL), IL_OK);
    assert_int_equal(w->stack_end(w, NULL), IL_OK);
    assert_int_equal(w->end(w, NULL), IL_OK);
    il_writer_loft.contours_free(w);
    free_couple(&d);
    return out;
}

/* The reader takes the record, and writing what it read gives the same bytes. */
static inline void assert_readable(const couple *c)
{
    const il_read_options o = IL_READ_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    il_output *was = written(c), *is;
    il_sink *w = NULL;
    il_source *source;
    size_t n, m;
    const unsigned char *text = il_output_memory(was, &n);
    assert_int_equal(il_source_from_memory(&source, text, n, "record", NULL), IL_OK);
    assert_int_equal(il_output_to_memory(&is, NULL), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&w, is, NULL), IL_OK);
    if (il_reader_loft.read(&source, 1, &o, w, NULL, &err) != IL_OK)
        fail_msg("line %ld: %s", err.line, err.text);
    il_writer_loft.contours_free(w);
    const unsigned char *again = il_output_memory(is, &m);
    assert_int_equal(n, m);
    assert_memory_equal(text, again, n);
    il_source_close(source);
    il_output_discard(was);
    il_output_discard(is);
}

static inline void assert_same_text(const couple *a, const couple *b)
{
    il_output *p = written(a), *q = written(b);
    size_t n, m;
    const unsigned char *s = il_output_memory(p, &n), *t = il_output_memory(q, &m);
    assert_int_equal(n, m);
    assert_memory_equal(s, t, n);
    il_output_discard(p);
    il_output_discard(q);
}

/* ---- what a record must be ---- */

/* How often each edge of a slice is in an arc: count[ring][edge]. */
typedef struct coverage {
    const il_slice *slice;
    unsigned char **count;
} coverage;

static inline coverage new_coverage(const il_slice *s)
{
    coverage c = { s, calloc(s->n + 1, sizeof *c.count) };
    for (size_t r = 0; r < s->n; r++)
        assert_non_null(c.count[r] = calloc(s->ring[r].n, 1));
    return c;
}

static inline void free_coverage(coverage *c)
{
    for (size_t r = 0; r < c->slice->n; r++)
        free(c->count[r]);
    free(c->count);
}

static inline void cover(coverage *c, const il_arc *a)
{
    size_t n = c->slice->ring[a->from.ring].n, k = a->from.vertex;
    assert_true(a->from.ring == a->to.ring && a->from.vertex < n && a->to.vertex < n);
    assert_true(a->from.t == 0 && a->to.t == 0); /* arcs end at vertices */
    do {
        c->count[a->from.ring][k]++;
        k = (k + 1) % n;
    } while (k != a->to.vertex);
}

/* No edge is in two matches of those as the slices lie. */
static inline void assert_arcs_as_they_lie(const couple *c)
{
    coverage side[2] = { new_coverage(&c->slice[0]), new_coverage(&c->slice[1]) };
    for (size_t i = 0; i < c->pair.n_matches; i++)
        if (c->pair.match[i].as_they_lie) {
            cover(&side[0], &c->pair.match[i].lower);
            cover(&side[1], &c->pair.match[i].upper);
        }
    for (int k = 0; k < 2; k++) {
        for (size_t r = 0; r < c->slice[k].n; r++)
            for (size_t v = 0; v < c->slice[k].ring[r].n; v++)
                assert_true(side[k].count[r][v] <= 1);
        free_coverage(&side[k]);
    }
}

/* Every edge of the groups that were fitted is in one arc of phi, matched or not. */
static inline void assert_arcs(const couple *c)
{
    const il_pair *p = &c->pair;
    coverage side[2] = { new_coverage(&c->slice[0]), new_coverage(&c->slice[1]) };
    for (size_t i = 0; i < p->n_matches; i++)
        if (!p->match[i].as_they_lie) {
            cover(&side[0], &p->match[i].lower);
            cover(&side[1], &p->match[i].upper);
        }
    for (size_t i = 0; i < p->n_unmatched; i++)
        cover(&side[p->unmatched[i].upper], &p->unmatched[i].arc);
    for (size_t i = 0; i < p->n_groups; i++)
        for (int k = 0; k < 2; k++)
            for (size_t r = 0; r < (k ? p->group[i].n_upper : p->group[i].n_lower); r++) {
                uint32_t ring = k ? p->group[i].upper[r] : p->group[i].lower[r];
                for (size_t v = 0; v < c->slice[k].ring[ring].n; v++)
                    if (side[k].count[ring][v] != p->group[i].fitted)
                        fail_msg("%s ring %u edge %zu is in %u arcs", k ? "upper" : "lower", (unsigned)ring, v, side[k].count[ring][v]);
            }
    free_coverage(&side[0]);
    free_coverage(&side[1]);
}

static inline double distance_to_edge(const double *p, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
    double t = l2 > 0 ? fmin(fmax(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / l2, 0), 1) : 0;
    return hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
}

static inline double distance_to_arc(const il_slice *s, const il_arc *a, const double *p)
{
    const il_ring *r = &s->ring[a->from.ring];
    size_t k = a->from.vertex;
    double least = INFINITY;
    do {
        size_t w = (k + 1) % r->n;
        least = fmin(least, distance_to_edge(p, r->xy + 2 * k, r->xy + 2 * w));
        k = w;
    } while (k != a->to.vertex);
    return least;
}

/* Its row of phi for vertex V of ring R. */
static inline size_t row_of(const il_pair *p, uint32_t r, uint32_t v)
{
    size_t k = 0;
    while (p->phi[k].at.ring != r || p->phi[k].at.vertex != v)
        k++;
    return k;
}

/* The residuals of a match: the distance of phi(upper arc), straight between its
 * rows, from the lower arc.  The mean is no further off than samples allow. */
static inline void assert_residual(const couple *c, const il_match *m)
{
    const il_pair *p = &c->pair;
    size_t first = row_of(p, m->upper.from.ring, 0), end = first, n = 0;
    while (end < p->n_phi && p->phi[end].at.ring == m->upper.from.ring)
        end++;
    size_t k = row_of(p, m->upper.from.ring, m->upper.from.vertex), last = row_of(p, m->upper.from.ring, m->upper.to.vertex);
    double rows_max = 0, max = 0, sum = 0;
    do {
        size_t w = k + 1 < end ? k + 1 : first;
        const il_phi_point *a = &p->phi[k], *b = &p->phi[w];
        for (int i = 0; i <= 16; i++, n++) {
            double q[2] = { a->x + i / 16. * (b->x - a->x), a->y + i / 16. * (b->y - a->y) };
            double d = distance_to_arc(&c->slice[0], &m->lower, q);
            rows_max = i == 0 || i == 16 ? fmax(rows_max, d) : rows_max;
            max = fmax(max, d);
            sum += d;
        }
        k = w;
    } while (k != last);
    double box = p->group[0].fit.box[2] - p->group[0].fit.box[0], cell = box / 200;
    assert_true(m->residual_mean >= 0 && m->residual_mean <= m->residual_max);
    assert_true(m->residual_max >= rows_max - 1e-9 * box && m->residual_max <= max + .02 * cell);
    assert_near(m->residual_mean, sum / (double)n, .3 * cell);
}

/* A fit says what is possible. */
static inline void assert_fit(const il_group *g)
{
    const il_fit *f = &g->fit;
    if (!g->fitted)
        return;
    assert_true(f->residual_up_mean >= 0 && f->residual_up_mean <= f->residual_up_max && isfinite(f->residual_up_max));
    assert_true(f->residual_down_mean >= 0 && f->residual_down_mean <= f->residual_down_max && isfinite(f->residual_down_max));
    assert_true(f->least_jacobian > 0 && isfinite(f->least_jacobian) && f->distortion >= 0 && isfinite(f->distortion));
    assert_int_equal(f->n_lattices, f->steps);
}

/* What was matched piece by piece has none. */
static inline bool has_one_fit(const il_group *g)
{
    return g->fitted && !(il_group_lies_apart(g) && g->fit.steps == 0);
}

/* phi of the vertices is the fit's. */
static inline void assert_phi(const couple *c)
{
    const il_pair *p = &c->pair;
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->n_phi && has_one_fit(&p->group[i]); k++) {
            const il_place *at = &p->phi[k].at;
            const il_ring *r = &c->slice[1].ring[at->ring];
            bool in = false;
            for (size_t u = 0; u < p->group[i].n_upper; u++)
                in |= p->group[i].upper[u] == at->ring;
            if (!in)
                continue;
            double q[2], size = p->group[i].fit.box[2] - p->group[i].fit.box[0];
            for (size_t x = 0; x < 2; x++)
                q[x] = (1 - at->t) * r->xy[2 * at->vertex + x] + at->t * r->xy[2 * ((at->vertex + 1) % r->n) + x];
            il_fit_apply(&p->group[i].fit, q, 1);
            assert_near(q[0], p->phi[k].x, 1e-9 * size);
            assert_near(q[1], p->phi[k].y, 1e-9 * size);
        }
}

/* As the reader gives them behind a pipe. */
static inline void assert_canonical_order(const il_pair *p)
{
    for (size_t i = 1; i < p->n_matches; i++) {
        const il_match *a = &p->match[i - 1], *b = &p->match[i];
        const il_place *s = &a->lower.from, *t = &b->lower.from;
        assert_true(a->as_they_lie != b->as_they_lie ? b->as_they_lie
                                                     : s->ring != t->ring ? s->ring < t->ring : s->vertex < t->vertex);
    }
}

static inline void assert_record(const couple *c)
{
    assert_canonical_order(&c->pair);
    assert_readable(c);
    assert_arcs(c);
    assert_arcs_as_they_lie(c);
    assert_phi(c);
    for (size_t i = 0; i < c->pair.n_groups; i++)
        assert_fit(&c->pair.group[i]);
}

#endif
