/* number.cpp - base/number.h on the C++ standard library's <charconv>. */
#include "config.h"
#include "base/number.h"

#include <charconv>
#include <cmath>
#include <system_error>

template <class Real> static size_t format(char *to, Real value) noexcept
{
    if (value == 0)
        value = 0; /* -0 */
    std::to_chars_result r = std::to_chars(to, to + IL_NUMBER_MAX - 1, value);
    *r.ptr = '\0';
    return size_t(r.ptr - to);
}

static bool is_digit(char c) noexcept
{
    return c >= '0' && c <= '9';
}

/* charconv reports a number too small for a double as out of range, like one
 * too large.  The text tells: below 1 when the exponent of its first nonzero
 * digit is negative.  Digits are counted, so no length overflows. */
static bool is_tiny(const char *s, const char *end) noexcept
{
    long place = 0, exponent = 0;
    bool after_point = false, significant = false;
    for (; s < end && *s != 'e' && *s != 'E'; s++) {
        if (*s == '.') {
            after_point = true;
        } else if (is_digit(*s)) {
            significant = significant || *s != '0';
            place += significant && !after_point ? 1 : !significant && after_point ? -1 : 0;
        }
    }
    if (s < end) {
        bool negative = s + 1 < end && s[1] == '-';
        for (s++; s < end; s++)
            if (is_digit(*s) && exponent < 100000000)
                exponent = 10 * exponent + (*s - '0');
        exponent = negative ? -exponent : exponent;
    }
    return place + exponent < 0;
}

size_t il_number_parse(const char *s, size_t n, double *value)
{
    const char *p = s, *end = s + n;
    if (p < end && *p == '+') {
        p++;
        if (p < end && *p == '-')
            return 0;
    }
    const char *digits = p < end && *p == '-' ? p + 1 : p;
    /* keep "inf" and "nan" out; from_chars takes ".5" and "5." */
    if (digits == end || !(is_digit(*digits) || (*digits == '.' && digits + 1 < end && is_digit(digits[1]))))
        return 0;
    double v = 0;
    std::from_chars_result r = std::from_chars(p, end, v, std::chars_format::general);
    if (r.ec == std::errc::result_out_of_range) {
        if (!is_tiny(digits, r.ptr))
            return 0;
        v = *p == '-' ? -0.0 : 0.0;
    } else if (r.ec != std::errc() || !std::isfinite(v)) {
        return 0;
    }
    *value = v;
    return size_t(r.ptr - s);
}

size_t il_number_format(char *to, double value)
{
    return format(to, value);
}

size_t il_number_format_float(char *to, float value)
{
    return format(to, value);
}
