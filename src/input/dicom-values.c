#include "config.h"
#include "input/dicom-values.h"
#include "base/alloc.h"
#include "input/xml-feed.h"

#include <stdlib.h>
#include <string.h>

void il_dicom_values_init(il_dicom_values *v, size_t max)
{
    *v = (il_dicom_values){ .max = max < UINT32_MAX ? max : UINT32_MAX };
}

void il_dicom_values_free(il_dicom_values *v)
{
    il_free(v->text);
    il_free(v->value);
    il_free(v->sorted);
    il_dicom_values_init(v, v->max);
}

void il_dicom_values_clear(il_dicom_values *v, bool is_text)
{
    v->n = v->n_values = 0;
    v->in_order = true;
    v->is_text = is_text;
}

/* ---- values as they come --------------------------------------------------------- */

static bool parse_number(const char *s, size_t n, uint32_t *number)
{
    uint64_t value = 0;
    size_t i = 0;
    for (; i < n && s[i] >= '0' && s[i] <= '9' && value <= UINT32_MAX; i++)
        value = 10 * value + (uint64_t)(s[i] - '0');
    *number = (uint32_t)value;
    return n > 0 && i == n && value > 0 && value <= UINT32_MAX;
}

static il_status append(il_dicom_values *v, const char *s, size_t n, il_error *err)
{
    if (n > v->max - v->n)
        return il_fail(err, IL_E_INPUT, 0, "a value of more than %zu bytes", v->max);
    if (!il_grow(&v->text, &v->cap, v->n + n + 1, 1))
        return il_fail_nomem(err);
    memcpy(v->text + v->n, s, n);
    v->n += n;
    return IL_OK;
}

il_status il_dicom_values_begin(il_dicom_values *v, const char *number, size_t n, il_error *err)
{
    uint32_t next = v->n_values > 0 ? v->value[v->n_values - 1].number + 1 : 1, k = next;
    if (number && !parse_number(number, n, &k))
        return il_fail(err, IL_E_INPUT, 0, "'%.*s' is no number of a value: they count from 1", (int)(n < 20 ? n : 20), number);
    if (!il_grow(&v->value, &v->cap_values, v->n_values + 1, sizeof *v->value))
        return il_fail_nomem(err);
    il_status st = v->n_values > 0 ? append(v, "\\", 1, err) : append(v, "", 0, err);
    v->in_order &= k == next;
    v->value[v->n_values++] = (struct il_dicom_value){ k, (uint32_t)v->n, (uint32_t)v->n };
    return st;
}

il_status il_dicom_values_add(il_dicom_values *v, const char *s, size_t n, il_error *err)
{
    if (v->n == v->value[v->n_values - 1].begin)
        while (n > 0 && il_xml_is_blank(*s))
            s++, n--;
    il_status st = append(v, s, n, err);
    for (size_t i = v->n - n; st == IL_OK && !v->is_text && i < v->n; i++)
        if (il_xml_is_blank(v->text[i]))
            v->text[i] = ' ';
    return st;
}

void il_dicom_values_end(il_dicom_values *v)
{
    struct il_dicom_value *last = &v->value[v->n_values - 1];
    while (v->n > last->begin && il_xml_is_blank(v->text[v->n - 1]))
        v->n--;
    last->end = (uint32_t)v->n;
}

/* ---- values by number -------------------------------------------------------------- */

static int by_number(const void *a, const void *b)
{
    const struct il_dicom_value *p = a, *q = b;
    return p->number < q->number ? -1 : p->number > q->number;
}

static il_status check_numbers(const il_dicom_values *v, il_error *err)
{
    for (size_t i = 1; i < v->n_values; i++)
        if (v->value[i].number == v->value[i - 1].number)
            return il_fail(err, IL_E_INPUT, 0, "two values have the number %lu", (unsigned long)v->value[i].number);
    return IL_OK;
}

/* To v->sorted, which has room for a backslash before each value and another for
 * the numbers missing there; the bytes written. */
static size_t write_sorted(il_dicom_values *v)
{
    size_t n = 0;
    uint32_t next = 1;
    for (size_t i = 0; i < v->n_values; i++) {
        const struct il_dicom_value *p = &v->value[i];
        if (p->number > next)
            v->sorted[n++] = '\\';
        if (i > 0)
            v->sorted[n++] = '\\';
        memcpy(v->sorted + n, v->text + p->begin, p->end - p->begin);
        n += p->end - p->begin;
        next = p->number + 1;
    }
    return n;
}

il_status il_dicom_values_join(il_dicom_values *v, const char **text, size_t *n, il_error *err)
{
    *text = v->n_values > 0 ? v->text : "";
    *n = v->n_values > 0 ? v->n : 0;
    if (v->in_order || v->n_values == 0)
        return IL_OK;
    qsort(v->value, v->n_values, sizeof *v->value, by_number);
    il_status st = check_numbers(v, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(&v->sorted, &v->cap_sorted, v->n + v->n_values + 1, 1))
        return il_fail_nomem(err);
    *n = write_sorted(v);
    *text = v->sorted;
    return IL_OK;
}
