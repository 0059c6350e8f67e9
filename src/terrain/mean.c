#include "config.h"
#include "terrain/mean.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

double il_mean_exp(double x)
{
    static const double LN2 = 0.69314718055994531;
    if (x < -700)
        return 0;
    double k = floor(x / LN2 + 0.5), r = x - k * LN2; /* |r| <= 0.35: what the series leaves is below 1e-10 */
    double sum = 1 / 24.0 + r * (1 / 120.0 + r * (1 / 720.0 + r * (1 / 5040.0 + r / 40320)));
    sum = 1 + r * (1 + r * (0.5 + r * (1 / 6.0 + r * sum)));
    uint64_t bits = (uint64_t)(1023 + (int)k) << 52; /* 2^k, at least 2^-1011 */
    double power;
    memcpy(&power, &bits, sizeof power);
    return sum * power;
}

/* 1 - Phi(x) for x >= 0, divided by phi(x) sqrt(2 pi) = GAUSS: the rational approximation of
 * Hastings (Abramowitz and Stegun 1964, 26.2.17), 7.5e-8. */
static double tail(double x, double gauss)
{
    double t = 1 / (1 + 0.2316419 * x);
    double sum = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
    return sum * gauss * 0.39894228040143268;
}

double il_mean_in_band(double u, double s)
{
    static const double PHI0 = 0.39894228040143268; /* 1 / sqrt(2 pi) */
    if (!(s > 0))
        return u;
    double a = u / s, b = (1 - u) / s;
    double at_a = il_mean_exp(-a * a / 2), at_b = il_mean_exp(-b * b / 2);
    double inside = 1 - tail(a, at_a) - tail(b, at_b);
    return u + s * PHI0 * (at_a - at_b) / inside;
}
