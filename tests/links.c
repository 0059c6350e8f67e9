/* links.c - how well a stream with pair records knows which rings belong together.
 *
 *     links TRUTH STREAM MATCHED
 *
 * TRUTH is what tests/truth.c says of the contours in STREAM, MATCHED the native stream that
 * `isoloft match` makes of them.  What is linked in a slab falls into parts, and so does what
 * lies about it, through holes that are linked to holes, or to the ring whose outside they
 * open to: rings with the same part of both belong together.  Links are counted as pairs of a
 * lower and an upper ring that belong together; parts as what hangs together through the
 * stack.  Prints
 *
 *     RIGHT OURS TRUTH  ON ON-END END-ON END  PARTS PARTS-TRUTH  MISSING
 *
 * links of ours that are right, ours, and the truth's; of the ends of rings in slabs that go
 * on by the truth those that do and those that do not by us, then of those that end by the
 * truth; parts; rings of STREAM that MATCHED does not have, which count in nothing else. */
#include "config.h"
#include "gathered.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "match/link.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Which rings belong together in a slab: class[side][ring], by the rings of whose the slab is, NONE when
 * that is not told; goes_on[side][ring of the stream]. */
typedef struct slab {
    uint32_t *class[2];
    bool *goes_on[2];
} slab;

/* The counts, and forests over all rings, ours and the truth's. */
typedef struct score {
    size_t right, ours, truth, missing;
    size_t end[2][2]; /* by the truth, by us: 0 goes on */
    uint32_t *part[2];
} score;

static void *must(void *p)
{
    if (!p)
        abort();
    return p;
}

/* ---- the truth's ------------------------------------------------------------------ */

static void read_side(const char **at, uint32_t *class, size_t n, uint32_t first, uint32_t name)
{
    char *end;
    for (unsigned long r; r = strtoul(*at, &end, 10), end > *at; *at = end)
        if (r >= first && r - first < n)
            class[r - first] = name;
    *at += strcspn(*at, ";");
    *at += **at == ';';
}

/* Slab K between slices of first ring FIRST[0] and FIRST[1], from lines of text. */
static void read_truth(slab *to, const char *text, size_t k, const gathered *g, const uint32_t first[2])
{
    uint32_t name = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const char *at = strchr(line, ';');
        if (strtoul(line, NULL, 10) != k || *line == '#' || !at++)
            continue;
        read_side(&at, to->class[0], g->slice[k - 1].n, first[0], name);
        read_side(&at, to->class[1], g->slice[k].n, first[1], name++);
    }
}

/* ---- ours --------------------------------------------------------------------------- */

/* The hole about ring I is about[i], NONE out in the open; outer[i] as of il_link_outers. */
typedef struct nest { uint32_t *outer, *about; } nest;

/* What lies about is what lies inside once all rings are turned round. */
static il_status find_nest(nest *to, const il_slice *s, il_error *err)
{
    il_slice turned;
    to->outer = must(il_alloc(s->n, sizeof *to->outer));
    to->about = must(il_alloc(s->n, sizeof *to->about));
    il_status st = il_slice_copy(&turned, s, err);
    for (size_t i = 0; st == IL_OK && i < turned.n; i++)
        il_ring_reverse(&turned.ring[i]);
    if (st == IL_OK)
        st = il_link_outers(s, to->outer, err);
    if (st == IL_OK)
        st = il_link_outers(&turned, to->about, err);
    for (size_t i = 0; st == IL_OK && i < s->n; i++)
        if (il_ring_area2(&s->ring[to->about[i]]) > 0)
            to->about[i] = NONE;
    il_slice_free(&turned);
    return st;
}

/* Forests over the lower rings, then the upper ones, then the open: by solid, by what is about. */
static void join_links(uint32_t *solid, uint32_t *about, const il_pair *p, const il_slice *lower, const nest n[2])
{
    uint32_t below = (uint32_t)lower->n;
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->group[i].n_links; k++) {
            const il_link *l = &p->group[i].link[k];
            if (n[0].outer[l->lower] == l->lower && n[1].outer[l->upper] == l->upper)
                il_forest_join(solid, l->lower, below + l->upper);
            else
                il_forest_join(about, l->lower, below + l->upper);
        }
}

static il_status find_classes(slab *to, const il_pair *p, const il_slice s[2], il_error *err)
{
    nest n[2] = { { NULL, NULL }, { NULL, NULL } };
    uint32_t below = (uint32_t)s[0].n, all = below + (uint32_t)s[1].n;
    uint32_t *solid = must(il_alloc(all + 1, sizeof *solid)), *about = must(il_alloc(all + 1, sizeof *about));
    il_forest_plant(solid, all + 1);
    il_forest_plant(about, all + 1);
    il_status st = find_nest(&n[0], &s[0], err);
    if (st == IL_OK)
        st = find_nest(&n[1], &s[1], err);
    for (uint32_t i = 0; i < all && st == IL_OK; i++) {
        const nest *m = &n[i >= below];
        uint32_t first = i >= below ? below : 0, k = i - first;
        il_forest_join(solid, i, first + m->outer[k]);
        il_forest_join(about, i, m->about[k] == NONE ? all : first + m->about[k]);
    }
    if (st == IL_OK)
        join_links(solid, about, p, &s[0], n);
    for (uint32_t i = 0; i < all && st == IL_OK; i++) { /* the first ring with the same two */
        uint32_t k = 0;
        while (il_forest_leader(solid, k) != il_forest_leader(solid, i) || il_forest_leader(about, k) != il_forest_leader(about, i))
            k++;
        to->class[i >= below][i >= below ? i - below : i] = k;
    }
    for (int k = 0; k < 2; k++) {
        il_free(n[k].outer);
        il_free(n[k].about);
    }
    il_free(solid);
    il_free(about);
    return st;
}

/* ---- the two compared ------------------------------------------------------------------ */

static void slab_make(slab *s, const gathered *whose, const gathered *stream, size_t k)
{
    for (size_t side = 0; side < 2; side++) {
        size_t n = whose->slice[k - 1 + side].n;
        s->class[side] = must(il_alloc(n, sizeof *s->class[side]));
        s->goes_on[side] = must(il_calloc(stream->slice[k - 1 + side].n, sizeof *s->goes_on[side]));
        memset(s->class[side], 0xff, n * sizeof *s->class[side]);
    }
}

static void slab_free(slab *s)
{
    for (int side = 0; side < 2; side++) {
        il_free(s->class[side]);
        il_free(s->goes_on[side]);
    }
}

/* OURS by rings of the stream: ring i of side 0 or 1 is at[side][i] of the matched one. */
static void compare(score *c, slab *ours, slab *truth, const gathered *g, size_t k, uint32_t *const at[2], const uint32_t first[2])
{
    for (uint32_t i = 0; i < g->slice[k - 1].n; i++)
        for (uint32_t j = 0; j < g->slice[k].n; j++) {
            bool known = at[0][i] != NONE && at[1][j] != NONE;
            bool we = known && ours->class[0][at[0][i]] == ours->class[1][at[1][j]];
            bool it = known && truth->class[0][i] != NONE && truth->class[0][i] == truth->class[1][j];
            c->ours += we;
            c->truth += it;
            c->right += we && it;
            if (we) {
                ours->goes_on[0][i] = ours->goes_on[1][j] = true;
                il_forest_join(c->part[0], first[0] + i, first[1] + j);
            }
            if (it) {
                truth->goes_on[0][i] = truth->goes_on[1][j] = true;
                il_forest_join(c->part[1], first[0] + i, first[1] + j);
            }
        }
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < g->slice[k - 1 + side].n; i++)
            c->end[!truth->goes_on[side][i]][!ours->goes_on[side][i]] += at[side][i] != NONE;
}

/* Rings of one side that belong together, too: loops of a surface that turns back. */
static void join_sides(score *c, const slab *ours, const slab *truth, size_t side, const uint32_t *at, size_t n, uint32_t first)
{
    const uint32_t *we = ours->class[side], *it = truth->class[side];
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++) {
            if (at[i] != NONE && at[j] != NONE && we[at[i]] == we[at[j]])
                il_forest_join(c->part[0], first + i, first + j);
            if (it[i] != NONE && it[i] == it[j])
                il_forest_join(c->part[1], first + i, first + j);
        }
}

static const double *least_vertex(const il_ring *r)
{
    const double *least = r->xy;
    for (size_t i = 1; i < r->n; i++) {
        const double *p = r->xy + 2 * i;
        if (p[0] < least[0] || (p[0] == least[0] && p[1] < least[1]))
            least = p;
    }
    return least;
}

/* at[i]: ring I of slice A in B, which has the same rings in another order; NONE when it is not
 * there: where a solid crosses itself, contours do, and are repaired.  How many are not. */
static size_t find_rings(uint32_t *at, const il_slice *a, const il_slice *b)
{
    size_t missing = 0;
    for (uint32_t i = 0; i < a->n; i++) {
        const il_ring *r = &a->ring[i];
        const double *p = least_vertex(r);
        at[i] = NONE;
        for (uint32_t k = 0; k < b->n && at[i] == NONE; k++) {
            const double *q = least_vertex(&b->ring[k]);
            if (p[0] == q[0] && p[1] == q[1] && (il_ring_area2(r) > 0) == (il_ring_area2(&b->ring[k]) > 0))
                at[i] = k;
        }
        missing += at[i] == NONE;
    }
    return missing;
}

static il_status score_slab(score *c, const char *text, const gathered *stream, const gathered *matched, size_t k,
                            uint32_t *const at[2], const uint32_t first[2], il_error *err)
{
    slab ours, truth;
    slab_make(&ours, matched, stream, k);
    slab_make(&truth, stream, stream, k);
    read_truth(&truth, text, k, stream, first);
    il_status st = find_classes(&ours, &matched->pair[k], matched->slice + k - 1, err);
    if (st == IL_OK)
        compare(c, &ours, &truth, stream, k, at, first);
    for (size_t side = 0; side < 2 && st == IL_OK; side++)
        join_sides(c, &ours, &truth, side, at[side], stream->slice[k - 1 + side].n, first[side]);
    slab_free(&ours);
    slab_free(&truth);
    return st;
}

static il_status score_all(score *c, const char *text, const gathered *stream, const gathered *matched, il_error *err)
{
    uint32_t *at[2] = { NULL, NULL }, first[2] = { 0, 0 };
    il_status st = stream->n == matched->n ? IL_OK : il_fail(err, IL_E_INPUT, 0, "there are other slices");
    for (size_t k = 0; k < stream->n && st == IL_OK; k++) {
        il_free(at[0]);
        at[0] = at[1];
        at[1] = must(il_alloc(stream->slice[k].n, sizeof *at[1]));
        c->missing += find_rings(at[1], &stream->slice[k], &matched->slice[k]);
        if (stream->slice[k].z != matched->slice[k].z)
            st = il_fail(err, IL_E_INPUT, 0, "there is no slice %.9g", stream->slice[k].z);
        else if (k > 0)
            st = score_slab(c, text, stream, matched, k, at, first, err);
        first[0] = first[1];
        first[1] += (uint32_t)stream->slice[k].n;
        if (k == 0)
            first[0] = 0;
    }
    il_free(at[0]);
    il_free(at[1]);
    return st;
}

static size_t count_parts(uint32_t *part, size_t n)
{
    size_t parts = 0;
    for (uint32_t i = 0; i < n; i++)
        parts += il_forest_leader(part, i) == i;
    return parts;
}

/* ---- the whole ---------------------------------------------------------------------------- */

static char *read_text(const char *path)
{
    FILE *f = fopen(path, "r");
    char *text = NULL;
    size_t n = 0, cap = 0;
    while (f && !feof(f) && !ferror(f)) {
        if (!il_grow(&text, &cap, n + 4097, 1))
            abort();
        n += fread(text + n, 1, 4096, f);
    }
    if (text)
        text[n] = '\0';
    if (f)
        fclose(f);
    return text;
}

int main(int argc, char **argv)
{
    gathered stream = { .n = 0 }, matched = { .n = 0 };
    score c = { .right = 0 };
    il_error err = IL_ERROR_INIT;
    size_t n = 0;
    if (argc != 4) {
        fputs("usage: links TRUTH STREAM MATCHED\n", stderr);
        return IL_E_USAGE;
    }
    char *text = read_text(argv[1]);
    il_status st = text ? gathered_read(&stream, argv[2], &err) : il_fail(&err, IL_E_IO, 0, "no truth");
    if (st == IL_OK)
        st = gathered_read(&matched, argv[3], &err);
    for (size_t k = 0; k < stream.n; k++)
        n += stream.slice[k].n;
    for (int k = 0; k < 2; k++) {
        c.part[k] = must(il_alloc(n, sizeof *c.part[k]));
        il_forest_plant(c.part[k], n);
    }
    if (st == IL_OK)
        st = score_all(&c, text, &stream, &matched, &err);
    if (st == IL_OK)
        printf("%zu %zu %zu %zu %zu %zu %zu %zu %zu %zu\n", c.right, c.ours, c.truth, c.end[0][0], c.end[0][1], c.end[1][0],
               c.end[1][1], count_parts(c.part[0], n), count_parts(c.part[1], n), c.missing);
    else
        fprintf(stderr, "links: %s\n", err.text);
    for (int k = 0; k < 2; k++)
        il_free(c.part[k]);
    gathered_free(&stream);
    gathered_free(&matched);
    il_free(text);
    return (int)st;
}
