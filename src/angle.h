/* Sine and cosine of an angle on the host, in double precision.
 *
 * libm's differ in the last bit from one host to the next, and then so do pictures and measures. This needs only
 * + - * and floor, so it gives the same bits wherever doubles are IEEE 754; its error is below 2e-16.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_ANGLE_H
#define CAROM_ANGLE_H

#include <math.h>

#define CAROM_HALF_PI 1.5707963267948966
#define CAROM_HALF_PI_REST 6.123233995736766e-17 /* what the double above lacks */

/* The Taylor polynomials, for |x| <= pi / 4: there the first term left out is below 1e-16. */
static inline double carom_sine_near_zero(double x)
{
	double s = x * x;
	double rest = 1.0 / 6227020800 - s / 1307674368000;
	return x - x * s * (1.0 / 6 - s * (1.0 / 120 - s * (1.0 / 5040 - s * (1.0 / 362880 - s * (1.0 / 39916800 - s * rest)))));
}

static inline double carom_cosine_near_zero(double x)
{
	double s = x * x;
	double rest = 1.0 / 479001600 - s * (1.0 / 87178291200 - s / 20922789888000);
	return 1 - s * (0.5 - s * (1.0 / 24 - s * (1.0 / 720 - s * (1.0 / 40320 - s * (1.0 / 3628800 - s * rest)))));
}

static inline void carom_sincos(double angle, double *sine, double *cosine)
{
	double quarters = floor(angle / CAROM_HALF_PI + 0.5);
	double rest = angle - quarters * CAROM_HALF_PI - quarters * CAROM_HALF_PI_REST;
	double s = carom_sine_near_zero(rest), c = carom_cosine_near_zero(rest);
	double turn = quarters - 4 * floor(quarters / 4);
	if (turn == 0) {
		*sine = s, *cosine = c;
	} else if (turn == 1) {
		*sine = c, *cosine = -s;
	} else if (turn == 2) {
		*sine = -s, *cosine = -c;
	} else {
		*sine = -c, *cosine = s;
	}
}

#endif
