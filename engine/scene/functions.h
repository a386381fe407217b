/*
 * Implementations of sin, cos, asin, exp, log and pow that give the same bits with every compiler. C libraries round
 * them differently, but results must be the same bits from gcc, clang and for web pages. No fused multiply-add is used
 * or allowed. exp, log and pow are within 0.56 units in the last place, the others within 0.8 (fdlibm's polynomials,
 * Sun Microsystems, 1993; angles as in trigonometry.h). Arguments outside their ranges go to the library.
 *
 * exp, log, pow: x = 2^k z with z from 0.6895 on, z c = 1 + r for a short c of a table, log x = k log 2 - log c + log(1
 * + r) in two parts; exp x = 2^(k + j/128) e^r (P. T. P. Tang, ACM Trans. Math. Softw. 15 (1989) 144-157 and 16 (1990)
 * 378-400; splitting of r without fused operations: S. Nagy, ARM Optimized Routines, 2018).
 */
#ifndef GUDGEON_FUNCTIONS_H
#define GUDGEON_FUNCTIONS_H
#include <stdint.h>
#include <string.h>
#include "powers.h"

static const double TURN_LIMIT = 1e5; /* rad; larger angles go to the library's functions */

/* Return the bits of a floating-point number as an integer. */
static inline uint64_t to_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Return the floating-point number with these bits. */
static inline double from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

#define NUMBER_TYPE double
#define NUMBER_BITS uint64_t
#define TYPED_NAME(name) name
#define EXPONENT_OF(bits) ((double)((int64_t)(bits) >> 52))
#define TABLE_ENTRY(table, bits, k) table[(bits) & 127][k]
#include "elementary_functions.h"
#undef NUMBER_TYPE
#undef NUMBER_BITS
#undef TYPED_NAME
#undef EXPONENT_OF
#undef TABLE_ENTRY

/*
 * Return sin x, x in rad, with the same bits on every platform up to TURN_LIMIT; larger angles, infinity and NaN use
 * the C library.
 */
static inline double compute_sine(double x)
{
    if (!(fabs(x) < TURN_LIMIT))
        return sin(x);
    double r, r_error;
    const uint64_t quadrant = reduce_angle(x, &r, &r_error);
    const double value = quadrant & 1 ? cosine_near_zero(r, r_error) : sine_near_zero(r, r_error);
    return quadrant & 2 ? -value : value;
}

/*
 * Return cos x, x in rad, with the same bits on every platform up to TURN_LIMIT; larger angles, infinity and NaN use
 * the C library.
 */
static inline double compute_cosine(double x)
{
    if (!(fabs(x) < TURN_LIMIT))
        return cos(x);
    double r, r_error;
    const uint64_t quadrant = reduce_angle(x, &r, &r_error);
    const double value = quadrant & 1 ? sine_near_zero(r, r_error) : cosine_near_zero(r, r_error);
    return (quadrant + 1) & 2 ? -value : value;
}

/* Return whether x is positive, finite and not subnormal. */
static inline int is_normal(double x) { return x >= DBL_MIN && x <= DBL_MAX; }

/* Return whether x^y is computed by a square root: powers 3/2 and 1/2, as in Hertz's force and its slope. */
static inline int is_square_root_power(double x, double y) { return x > 1e-150 && x < 1e150 && (y == 1.5 || y == 0.5); }

/* Return exp x. */
static inline double compute_exponential(double x) { return fabs(x) < 700.0 ? exp_with_error(x, 0.0) : exp(x); }

/*
 * Return ln x with the same bits on every platform; zero, negative, subnormal and infinite x and NaN use the C library.
 */
static inline double compute_logarithm(double x)
{
    double error;
    return is_normal(x) ? log_with_error(x, &error) : log(x);
}

/*
 * Return x^y with the same bits on every platform: square roots for y = 1/2 and 3/2, else exp(y ln x) in two parts.
 * Arguments or results outside of the range use the C library.
 */
static inline double raise_to_power(double x, double y)
{
    if (is_square_root_power(x, y))
        return y == 0.5 ? sqrt(x) : power_three_halves(x, sqrt(x));
    if (is_normal(x) && fabs(y) < 0x1p60) {
        double log_error;
        const double log_x = log_with_error(x, &log_error);
        const double x_high = round_to_26_bits(log_x), y_high = round_to_26_bits(y);
        const double high = y_high * x_high;
        if (fabs(high) < 690.0)
            return exp_with_error(high, (y - y_high) * x_high + y * (log_x - x_high + log_error));
    }
    return pow(x, y);
}

/* Return (asin(x) - x) / x from z = x^2 <= 1/4, by a rational approximation. */
static inline double compute_arcsine_quotient(double z)
{
    const double p = z * (1.66666666666666657415e-01 + z * (-3.25565818622400915405e-01
        + z * (2.01212532134862925881e-01 + z * (-4.00555345006794114027e-02
        + z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
    return p / (1.0 + z * (-2.40339491173441421878e+00 + z * (2.02094576023350569471e+00
        + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02))));
}

/* Return arcsin x in rad with the same bits on every platform; |x| >= 1 and NaN use the C library. */
static inline double compute_arcsine(double x)
{
    const double half_pi = 1.57079632679489655800e+00, half_pi_low = 6.12323399573676603587e-17, a = fabs(x);
    const double shift = 50331648.0; /* adding and subtracting it rounds to a multiple of 2^-27 */
    if (!(a < 1.0))
        return asin(x);
    if (a < 0.5)
        return x + x * compute_arcsine_quotient(x * x);
    /* pi/2 - 2 asin s with s = f + c: right - 2 f and f^2 are exact */
    const double z = 0.5 - 0.5 * a, s = sqrt(z), f = s + shift - shift, c = (z - f * f) / (s + f);
    const double value = half_pi - 2.0 * f - (2.0 * s * compute_arcsine_quotient(z) - (half_pi_low - 2.0 * c));
    return x < 0.0 ? -value : value;
}

#define sin(x) compute_sine(x)
#define cos(x) compute_cosine(x)
#define asin(x) compute_arcsine(x)
#define exp(x) compute_exponential(x)
#define log(x) compute_logarithm(x)
#define pow(x, y) raise_to_power(x, y)

#endif
