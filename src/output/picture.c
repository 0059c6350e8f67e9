/* picture.c - the sink that collects what a picture needs and has it drawn. */
#include "config.h"
#include "output/picture.h"
#include "output/picture-parts.h"
#include "base/alloc.h"

#include <math.h>

/* stacks: begun so far; most_pairs: the most that any of them has room for;
 * drawn: figures on the page.  title: the name of the first. */
typedef struct picture {
    il_sink sink;
    il_picture_options options;
    il_svg_page page;
    il_figure figure;
    size_t stacks, most_pairs, slices, drawn;
    il_label title;
} picture;

static void free_level(il_level *l)
{
    il_slice_free(&l->slice);
    il_pair_free(&l->below);
    l->has_pair = false;
}

static void empty_figure(il_figure *f)
{
    for (size_t k = 0; k < f->n; k++)
        free_level(&f->level[k]);
    il_stack_head_free(&f->head);
    f->n = f->n_slices = f->n_pairs = f->first = 0;
    f->spacing = 0;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    picture *p = (picture *)self;
    empty_figure(&p->figure);
    p->figure.index = ++p->stacks;
    return il_stack_head_copy(&p->figure.head, head, err);
}

/* ---- slices -------------------------------------------------------------- */

/* Slices of one height are one slice (formats/loft.txt, 7): move FROM's rings to TO. */
static il_status join(il_slice *to, il_slice *from, il_error *err)
{
    for (size_t i = 0; i < from->n; i++) {
        il_ring *r = il_slice_add_ring(to);
        if (!r)
            return il_fail_nomem(err);
        *r = from->ring[i];
        from->ring[i] = (il_ring)IL_RING_INIT;
    }
    return IL_OK;
}

/* Is slice K of the stack drawn? */
static bool is_wanted(const picture *p, size_t k)
{
    return p->options.what != IL_PICTURE_PAIR || k == p->options.pair || k == p->options.pair + 1;
}

static il_status keep(picture *p, size_t number, il_slice *slice, il_error *err)
{
    il_figure *f = &p->figure;
    if (!il_grow(&f->level, &f->cap, f->n + 1, sizeof *f->level))
        return il_fail_nomem(err);
    if (f->n == 0)
        f->first = number;
    f->level[f->n++] = (il_level){ *slice, IL_PAIR_INIT, false };
    *slice = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    picture *p = (picture *)self;
    il_figure *f = &p->figure;
    bool first = f->n_slices == 0;
    if (!first && slice->z == f->z_greatest)
        return is_wanted(p, f->n_slices - 1) ? join(&f->level[f->n - 1].slice, slice, err) : IL_OK;
    double spacing = first ? 0 : slice->z - f->z_greatest;
    f->spacing = f->spacing > 0 ? fmin(f->spacing, spacing) : spacing;
    f->z_least = first ? slice->z : f->z_least;
    f->z_greatest = slice->z;
    size_t number = f->n_slices++;
    return is_wanted(p, number) ? keep(p, number, slice, err) : IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    picture *p = (picture *)self;
    il_figure *f = &p->figure;
    (void)err;
    f->n_pairs += !pair->gap;
    if (f->n < 2 || f->first + f->n != f->n_slices)
        return IL_OK;
    il_level *upper = &f->level[f->n - 1];
    il_pair_free(&upper->below);
    upper->below = *pair;
    upper->has_pair = true;
    *pair = (il_pair)IL_PAIR_INIT;
    return IL_OK;
}

/* ---- the picture --------------------------------------------------------- */

static il_status draw(picture *p, il_error *err)
{
    const il_figure *f = &p->figure;
    if (p->options.what == IL_PICTURE_PAIR)
        return f->n == 2 ? il_picture_draw_pair(&p->page, f, err) : IL_OK;
    if (p->options.what == IL_PICTURE_SKELETON)
        return il_picture_draw_skeleton(&p->page, f, err);
    if (p->options.what == IL_PICTURE_SLICES || f->n_pairs == 0)
        return il_picture_draw_slices(&p->page, f, err);
    return il_picture_draw_pairs(&p->page, f, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    picture *p = (picture *)self;
    il_figure *f = &p->figure;
    size_t pairs = f->n_slices > 0 ? f->n_slices - 1 : 0;
    p->most_pairs = pairs > p->most_pairs ? pairs : p->most_pairs;
    p->slices += f->n_slices;
    if (p->drawn == 0 && (p->options.what != IL_PICTURE_PAIR || f->n == 2))
        il_picture_name(&p->title, f);
    p->drawn += p->options.what != IL_PICTURE_PAIR || f->n == 2;
    il_status st = draw(p, err);
    empty_figure(f);
    return st;
}

static il_status check_drawn(const picture *p, il_error *err)
{
    if (p->slices == 0)
        return il_fail(err, IL_E_INPUT, 0, "there are no slices, so there is nothing to draw");
    if (p->drawn > 0)
        return IL_OK;
    if (p->most_pairs == 0)
        return il_fail(err, IL_E_USAGE, 0, "there is no pair %zu: no stack has more than one slice", p->options.pair);
    return il_fail(err, IL_E_USAGE, 0, "there is no pair %zu: %s pairs 0 to %zu", p->options.pair,
                   p->stacks == 1 ? "the stack has the" : "the stacks have at most the", p->most_pairs - 1);
}

static il_status on_end(il_sink *self, il_error *err)
{
    picture *p = (picture *)self;
    il_status st = check_drawn(p, err);
    p->page.y += IL_PAGE_MARGIN;
    return st == IL_OK ? il_svg_page_finish(&p->page, p->title.text, err) : st;
}

static il_status picture_new(il_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    *out = NULL;
    picture *p = il_calloc(1, sizeof *p);
    if (!p)
        return il_fail_nomem(err);
    p->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    p->options = o ? o->picture : (il_picture_options){ IL_PICTURE_AUTO, 0 };
    il_status st = il_svg_page_begin(&p->page, to, IL_PAGE_WIDTH, err);
    if (st != IL_OK) {
        il_free(p);
        return st;
    }
    *out = &p->sink;
    return IL_OK;
}

static void picture_free(il_sink *s)
{
    picture *p = (picture *)s;
    if (!p)
        return;
    empty_figure(&p->figure);
    il_free(p->figure.level);
    il_svg_page_free(&p->page);
    il_free(p);
}

const il_writer il_writer_picture = {
    .name = "svg",
    .extension = "svg",
    .words = "a picture of contours and correspondences",
    .picture_new = picture_new,
    .contours_free = picture_free,
};
