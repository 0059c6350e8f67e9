#include "config.h"
#include "model/spots.h"

#include <stdlib.h>

static int compare_longs(long a, long b)
{
    return a < b ? -1 : a > b;
}

static int compare_doubles(double a, double b)
{
    return a < b ? -1 : a > b;
}

static int compare(const void *va, const void *vb)
{
    const il_spot *a = va, *b = vb;
    const int by[] = { compare_doubles(a->x, b->x), compare_doubles(a->y, b->y), compare_longs(a->file, b->file),
                       compare_longs(a->feature, b->feature), compare_longs(a->line, b->line), compare_doubles(a->z, b->z) };
    for (size_t k = 0; k < sizeof by / sizeof *by; k++)
        if (by[k] != 0)
            return by[k];
    return 0;
}

void il_spots_sort(il_spot *s, size_t n)
{
    if (n > 1)
        qsort(s, n, sizeof *s, compare);
}

static bool differ(const il_spot *s, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (s[i].z != s[0].z)
            return true;
    return false;
}

static void skip(const il_stack_head *h, const il_spot *s, il_report *report)
{
    il_report_skip(report, s->file < h->n_files ? h->file[s->file] : "", s->line, "point", "others at its place have another height");
}

void il_stack_head_settle_spots(il_stack_head *h, il_report *report)
{
    il_spot *s = h->spot;
    size_t n = 0, n_same = 0;
    il_spots_sort(s, h->n_spots);
    for (size_t i = 0, end = 0; i < h->n_spots; i = end) {
        for (end = i + 1; end < h->n_spots && il_spots_meet(&s[i], &s[end]);)
            end++;
        if (differ(s + i, end - i)) {
            for (size_t k = i; k < end; k++)
                skip(h, &s[k], report);
            continue;
        }
        n_same += end - i - 1;
        s[n++] = s[i];
    }
    h->n_spots = n;
    if (n_same > 0)
        il_report_note(report, "points that are there already, with the same height, count once: %zu", n_same);
}
