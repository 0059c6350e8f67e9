/* mean.h - the mean of a normal law that is cut to a band. */
#ifndef IL_TERRAIN_MEAN_H
#define IL_TERRAIN_MEAN_H

/* The mean of a normal law about U in [0, 1], of standard deviation S > 0, cut to [0, 1]:
 *
 *     u + s (phi(a) - phi(b)) / (Phi(b) - Phi(a)),  a = -u / s, b = (1 - u) / s
 *
 * (Johnson, Kotz and Balakrishnan 1994, 13.134.)  Strictly inside for all but the least S, rising
 * with U, U itself for S = 0 and U = 1/2.  Good to 1e-6, and the same bits on every machine: no
 * function of the C library takes part, whose last digit may differ. */
double il_mean_in_band(double u, double s);

/* e^x for X at most 0, to nine digits, likewise. */
double il_mean_exp(double x);

#endif
