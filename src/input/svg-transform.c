#include "config.h"
#include "input/svg-transform.h"

#include <string.h>

/* ---- the functions of the list, each with its arguments V[0..N) ------------- */

enum { MAX_ARGUMENTS = 6 };

static il_affine make_matrix(const double *v, int n)
{
    (void)n;
    return (il_affine){ v[0], v[1], v[2], v[3], v[4], v[5] };
}

static il_affine make_translate(const double *v, int n)
{
    return (il_affine){ 1, 0, 0, 1, v[0], n > 1 ? v[1] : 0 };
}

static il_affine make_scale(const double *v, int n)
{
    return (il_affine){ v[0], 0, 0, n > 1 ? v[1] : v[0], 0, 0 };
}

static il_affine make_rotate(const double *v, int n)
{
    double s, c;
    il_sincos_deg(v[0], &s, &c);
    il_affine turn = { c, s, -s, c, 0, 0 };
    if (n == 1)
        return turn;
    il_affine to = { 1, 0, 0, 1, v[1], v[2] }, back = { 1, 0, 0, 1, -v[1], -v[2] };
    il_affine there = il_affine_multiply(&to, &turn);
    return il_affine_multiply(&there, &back);
}

static il_affine make_skew_x(const double *v, int n)
{
    (void)n;
    double s, c;
    il_sincos_deg(v[0], &s, &c);
    return (il_affine){ 1, 0, s / c, 1, 0, 0 };
}

static il_affine make_skew_y(const double *v, int n)
{
    (void)n;
    double s, c;
    il_sincos_deg(v[0], &s, &c);
    return (il_affine){ 1, s / c, 0, 1, 0, 0 };
}

/* counts: the numbers of arguments it takes, as bits. */
static const struct function {
    const char *name;
    unsigned counts;
    il_affine (*make)(const double *v, int n);
} functions[] = {
    { "matrix", 1u << 6, make_matrix },
    { "translate", 1u << 1 | 1u << 2, make_translate },
    { "scale", 1u << 1 | 1u << 2, make_scale },
    { "rotate", 1u << 1 | 1u << 3, make_rotate },
    { "skewX", 1u << 1, make_skew_x },
    { "skewY", 1u << 1, make_skew_y },
};

static const struct function *take_name(il_svg_text *t)
{
    il_svg_text_more(t);
    for (size_t k = 0; k < sizeof functions / sizeof *functions; k++) {
        size_t n = strlen(functions[k].name);
        if (t->n - t->at >= n && memcmp(t->s + t->at, functions[k].name, n) == 0) {
            t->at += n;
            return &functions[k];
        }
    }
    return NULL;
}

static il_status take_arguments(il_svg_text *t, double *v, int *n, il_error *err)
{
    il_status st = IL_OK;
    for (*n = 0; st == IL_OK && !il_svg_text_take(t, ')'); ++*n) {
        if (*n == MAX_ARGUMENTS)
            return il_svg_text_fail(t, err, "')' is expected");
        st = *n == 0 ? il_svg_text_number(t, &v[0], err) : il_svg_text_next_number(t, &v[*n], err);
    }
    return st;
}

il_status il_svg_transform_parse(il_svg_text *t, il_affine *m, il_error *err)
{
    il_affine all = *m;
    if (il_svg_text_more(t) && il_svg_text_is_word(t, "none"))
        return IL_OK;
    for (bool first = true; il_svg_text_more(t); first = false) {
        double v[MAX_ARGUMENTS];
        int n = 0;
        if (!first)
            il_svg_text_take(t, ',');
        const struct function *f = take_name(t);
        if (!f || !il_svg_text_take(t, '('))
            return il_svg_text_fail(t, err, f ? "'(' is expected"
                : "matrix, translate, scale, rotate, skewX or skewY is expected");
        il_status st = take_arguments(t, v, &n, err);
        if (st != IL_OK)
            return st;
        if (!(f->counts >> n & 1))
            return il_fail(err, IL_E_INPUT, 0, "%s: %s cannot take %d numbers", t->name, f->name, n);
        il_affine one = f->make(v, n);
        all = il_affine_multiply(&all, &one);
    }
    *m = all;
    return IL_OK;
}
