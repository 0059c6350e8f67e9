#include "config.h"
#include "output/label.h"
#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void append(il_label *l, const char *s, size_t n)
{
    if (n >= sizeof l->text - l->n)
        return;
    memcpy(l->text + l->n, s, n);
    l->n += n;
    l->text[l->n] = '\0';
}

void il_label_words(il_label *l, const char *words)
{
    append(l, words, strlen(words));
}

/* Columns that a character takes: letters of the Far East are as wide as two. */
static size_t columns(unsigned long code)
{
    return code >= 0x1100 ? 2 : 1;
}

void il_label_name(il_label *l, const char *name, size_t most)
{
    char shown[sizeof l->text];
    size_t n = strlen(name), used = 0, i = 0;
    while (i < n) {
        unsigned long code = 0;
        size_t length = il_utf8_char(name + i, n - i, &code);
        length = length > 0 ? length : 1;
        size_t written = il_text_printable(shown, sizeof shown, name + i, length);
        used += written > length ? written : columns(code);
        if (used > most) {
            append(l, "\xE2\x80\xA6", 3);
            return;
        }
        append(l, shown, written);
        i += length;
    }
}

void il_label_count(il_label *l, size_t count)
{
    char digits[24], *p = digits + sizeof digits;
    do
        *--p = (char)('0' + count % 10);
    while (count /= 10);
    append(l, p, (size_t)(digits + sizeof digits - p));
}

void il_label_counted(il_label *l, size_t count, const char *noun)
{
    il_label_count(l, count);
    il_label_words(l, " ");
    il_label_words(l, noun);
    il_label_words(l, count == 1 ? "" : "s");
}

/* V rounded to so many digits: a whole number of them is divided or multiplied
 * by a power of ten that is a double, so that the shortest text is the rounded one. */
static double rounded(double v, int digits)
{
    if (!(fabs(v) > 1e-15) || fabs(v) >= 1e15)
        return v;
    int places = digits - 1 - (int)floor(log10(fabs(v)));
    double power = pow(10, abs(places) < 22 ? abs(places) : 22);
    return places >= 0 ? round(v * power) / power : round(v / power) * power;
}

void il_label_number(il_label *l, double v, int digits)
{
    char text[IL_NUMBER_MAX];
    append(l, text, il_number_format(text, rounded(v, digits)));
}

void il_label_height(il_label *l, double v, double spacing)
{
    char text[IL_NUMBER_MAX], shorter[IL_NUMBER_MAX];
    size_t n = il_number_format(text, v), m;
    double power = spacing > 0 ? pow(10, fmax(ceil(-log10(spacing)), 0) + 1) : 0;
    if (power > 0 && power <= 1e22 && fabs(v) * power < 1e15) {
        m = il_number_format(shorter, round(v * power) / power);
        append(l, m < n ? shorter : text, m < n ? m : n);
    } else {
        append(l, text, n);
    }
}

double il_label_width(const char *text, double size)
{
    size_t n = strlen(text), used = 0;
    for (size_t i = 0; i < n;) {
        unsigned long code = 0;
        size_t length = il_utf8_char(text + i, n - i, &code);
        used += columns(code);
        i += length > 0 ? length : 1;
    }
    return 0.6 * size * (double)used;
}
