/*
 * Arithmetic that all parts of the engine share: minima and maxima with NaN, periodic functions, interpolation. Also
 * ends of fixed steps and branches of switching functions.
 */
#ifndef GUDGEON_NUMBERS_H
#define GUDGEON_NUMBERS_H

#include "functions.h"

#define PI 3.141592653589793
/* Smaller numbers may have fewer digits, as subnormal ones do: quotients of them are not compared. */
#define MIN_RESOLVED (DBL_MIN / DBL_EPSILON)

/* Return the maximum of two numbers; a NaN in x is propagated. */
static inline double max_of(double x, double y) { return x < y ? y : x; }
/* Return the minimum of two numbers; a NaN in x is propagated. */
static inline double min_of(double x, double y) { return x > y ? y : x; }
/* Return the sign of x: 1, -1, or x itself for zero and NaN. */
static inline double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }

/* Return whether both numbers are positive or both negative; their product may underflow. */
static inline int have_same_sign(double x, double y) { return x > 0.0 ? y > 0.0 : x < 0.0 && y < 0.0; }

/* Return whether the n values x are all finite; 1 for n = 0. */
static inline int all_finite(const double *x, int n)
{
    double zero = 0.0;
    for (int k = 0; k < n; k++)
        zero += 0.0 * x[k];
    return zero == 0.0;
}

/* Return whether two numbers are equal to the last bit; NaN equals nothing. */
static inline int is_same_number(double x, double y) { return x == y && !signbit(x) == !signbit(y); }

/*
 * Return the distance, s, below which a sample coincides with the end t of a step of length h: both contain rounding
 * errors.
 */
static inline double compute_time_tolerance(double t, double h) { return 8.0 * DBL_EPSILON * fabs(t) + 1e-12 * h; }

#ifdef __wasm__ /* in a web page, seldom used functions are compiled for size */
#define OPTIMIZE_SIZE __attribute__((minsize))
#else
#define OPTIMIZE_SIZE
#endif

/*
 * Return the time in s at which step `index` (from 0) of fixed length ends, from t_begin towards t_end, and its length
 * *length. The last step ends at t_end and may be shorter. Steps from a multiple of their length end at multiples, so
 * that a resumed run makes the same steps to the bit.
 */
static inline double compute_step_end(double t_begin, double t_end, double fixed_step, double index, double *length)
{
    const double n_steps = max_of(ceil((t_end - t_begin) / fixed_step * (1.0 - 1e-12)), 1.0);
    const double last_length = t_end - t_begin - (n_steps - 1.0) * fixed_step, n_before = rint(t_begin / fixed_step);
    const int is_multiple = fabs(n_before * fixed_step - t_begin) <= compute_time_tolerance(t_begin, fixed_step);
    *length = index < n_steps || fabs(last_length - fixed_step) < 1e-9 * fixed_step ? fixed_step : last_length;
    return index < n_steps ? (is_multiple ? (n_before + index) * fixed_step : t_begin + index * fixed_step) : t_end;
}

/* Return a point slightly larger than x, for a difference quotient. */
static inline double slightly_above(double x) { return x + 1e-9 * (1.0 + fabs(x)); }
/* Return a point slightly smaller than x, for a difference quotient. */
static inline double slightly_below(double x) { return x - 1e-9 * (1.0 + fabs(x)); }
/*
 * Return the derivative, or the difference quotient of two values `distance` apart if the derivative is not finite, as
 * of a saturated term whose derivative overflows.
 */
static inline double finite_slope(double derivative, double value_after, double value_before, double distance)
{
    return isfinite(derivative) ? derivative : (value_after - value_before) / distance;
}

/* Return a time just after t, so that rounding does not hide on which branch a drive continues. */
static inline double get_time_just_after(double t) { return t + max_of(32.0 * DBL_EPSILON * fabs(t), 1e-100); }
/* Return the time at which rates of drives are evaluated: just after t if they may jump, else t. */
static inline double get_time_after_jump(double t) { return RATE_JUMPS ? get_time_just_after(t) : t; }

/* Return the time in s before and after t within which audits and starts do not rely on rates at a jump of a drive. */
static inline double get_jump_interval(double t) { return max_of(1e-9 * fabs(t), 1e-12); }

/*
 * Return a mod b by floored division: 0 or with the sign of b, and |result| <= |b|. The result equals b only if a tiny
 * remainder of the other sign rounds to b.
 */
static inline double mod_of(double a, double b)
{
    const double remainder = fmod(a, b);
    return remainder != 0.0 && (remainder < 0.0) != (b < 0.0) ? remainder + b : remainder;
}

/*
 * Return mod(a, b) on a frozen branch: that of the even (branch 1) or odd (-1) periods, continued half a period beyond
 * both ends. branch 0: mod(a, b).
 */
static inline double mod_on_branch(double a, double b, double branch)
{
    const double remainder = mod_of(a, 2.0 * b), n_periods = remainder / b;
    if (branch == 0.0)
        return mod_of(a, b);
    return branch > 0.0 ? (n_periods < 1.5 ? remainder : remainder - 2.0 * b)
        : (n_periods < 0.5 ? remainder + b : remainder - b);
}

/*
 * Return the continuous switching function of mod(a, b), whose zeros are the multiples of b: parabolas of height 1 in
 * even periods of a/b and -1 in odd ones. It is negative throughout odd periods.
 */
static inline double mod_switching_function(double a, double b)
{
    const double n_periods = mod_of(a, 2.0 * b) / b;
    return n_periods < 1.0 ? 4.0 * n_periods * (1.0 - n_periods)
        : min_of(4.0 * (n_periods - 1.0) * (n_periods - 2.0), -DBL_MIN);
}

/*
 * Return the branch of a switching function: the frozen one, branch[switch_index], or the sign of `value` if `branch`
 * is NULL. Also sets g[switch_index] to `value`.
 */
static inline double branch_of(const double *branch, double *g, int switch_index, double value)
{
    g[switch_index] = value;
    return branch ? branch[switch_index] : sign_of(value);
}

#define MAX_SERIES_ANGLE 0.01 /* rad: up to it the series of rotate_back_by_small_angle() are exact to rounding */

/*
 * Rotate the unit vector direction[2], cosine and sine of an angle, back by a small angle (at most MAX_SERIES_ANGLE,
 * rad), by series. Called by emitted code (driven_loops.c): a Newton correction of an angle that is stored as a
 * direction is subtracted.
 */
static inline void rotate_back_by_small_angle(double *direction, double angle)
{
    const double angle_squared = angle * angle, c = direction[0], s = direction[1];
    const double sine = angle * (1.0 - (1.0 / 6.0) * angle_squared * (1.0 - 0.05 * angle_squared));
    const double one_minus_cosine = 0.5 * angle_squared
        * (1.0 - (1.0 / 12.0) * angle_squared * (1.0 - (1.0 / 30.0) * angle_squared));
    direction[0] = c + (s * sine - c * one_minus_cosine);
    direction[1] = s - (c * sine + s * one_minus_cosine);
}

/* Return the weight of a node at 0 for Lagrange's interpolation through the nodes -n ... -1, 1 ... n. */
static inline double compute_lagrange_weight(int n, int node)
{
    double weight = 1.0;
    for (int other = 1; other <= n; other++)
        weight *= other == node ? 0.5 : (double)(other * other) / (double)(other * other - node * node);
    return weight;
}

#endif
