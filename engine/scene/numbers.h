/*
 * Arithmetic that all parts of the engine share: minima and maxima with NaN, ends of fixed steps, periodic functions,
 * branches of switching functions, weights of interpolation.
 */
#ifndef GUDGEON_NUMBERS_H
#define GUDGEON_NUMBERS_H

#include "functions.h"

#define PI 3.141592653589793
/* Smaller numbers may have fewer digits, as subnormal ones do: quotients of them are not compared. */
#define MIN_RESOLVED (DBL_MIN / DBL_EPSILON)

/* Return the larger number; a NaN in x is propagated. */
static inline double max_of(double x, double y) { return x < y ? y : x; }
/* Return the smaller number; a NaN in x is propagated. */
static inline double min_of(double x, double y) { return x > y ? y : x; }
/* Return the sign of x: 1, -1, or x itself for zero and NaN. */
static inline double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }

/* Return whether both numbers are positive or both negative; their product may underflow. */
static inline int have_same_sign(double x, double y) { return x > 0.0 ? y > 0.0 : x < 0.0 && y < 0.0; }

/* Return whether n values are finite. */
static inline int all_finite(const double *x, int n)
{
    double none = 0.0;
    for (int k = 0; k < n; k++)
        none += 0.0 * x[k];
    return none == 0.0;
}

/* Return whether two numbers are equal to the last bit; NaN equals nothing. */
static inline int same_number(double x, double y) { return x == y && !signbit(x) == !signbit(y); }

/*
 * Return the distance, s, below which a sample coincides with the end t of a step of length h: both are sums of rounded
 * numbers.
 */
static inline double rounded(double t, double h) { return 8.0 * DBL_EPSILON * fabs(t) + 1e-12 * h; }

#ifdef __wasm__ /* in a web page, rare functions are compiled for size */
#define SELDOM __attribute__((minsize))
#else
#define SELDOM
#endif

/*
 * Return the time at which step i (0, 1, ...) of fixed length `step` ends, from t0 towards t_end, and its length h. The
 * last step ends at t_end and may be shorter. Steps from a multiple of their length end at multiples, so that a resumed
 * run makes the same steps to the bit.
 */
static inline double step_end(double t0, double t_end, double step, double i, double *h)
{
    const double total = max_of(ceil((t_end - t0) / step * (1.0 - 1e-12)), 1.0);
    const double rest = t_end - t0 - (total - 1.0) * step, count = rint(t0 / step);
    const int multiple = fabs(count * step - t0) <= rounded(t0, step);
    *h = i < total || fabs(rest - step) < 1e-9 * step ? step : rest;
    return i < total ? (multiple ? (count + i) * step : t0 + i * step) : t_end;
}

/* Return a point slightly larger than x, for a difference quotient. */
static inline double just_ahead(double x) { return x + 1e-9 * (1.0 + fabs(x)); }
/* Return a point slightly smaller than x, for a difference quotient. */
static inline double just_behind(double x) { return x - 1e-9 * (1.0 + fabs(x)); }
/*
 * Return the derivative, or the difference quotient of two values `way` apart if it is not finite. A finite term whose
 * derivative overflows is saturated.
 */
static inline double finite_slope(double derivative, double ahead, double behind, double way)
{
    return isfinite(derivative) ? derivative : (ahead - behind) / way;
}

/* Return a time just after t, so that rounding does not hide on which branch a drive continues. */
static inline double just_after(double t) { return t + max_of(32.0 * DBL_EPSILON * fabs(t), 1e-100); }
/* Return the time at which rates of drives are evaluated: just after t if they may jump, else t. */
static inline double after_jump(double t) { return RATE_JUMPS ? just_after(t) : t; }

/* Return mod(a, b) in [0, b). The end of a period belongs to the period that begins there. */
static inline double mod_of(double a, double b)
{
    const double rest = fmod(a, b);
    return rest != 0.0 && (rest < 0.0) != (b < 0.0) ? rest + b : rest;
}

/*
 * Return mod(a, b) on a frozen branch: continued half a period beyond both ends of the even (1) or odd (-1) periods;
 * branch 0: mod(a, b).
 */
static inline double mod_on(double a, double b, double branch)
{
    const double rest = mod_of(a, 2.0 * b), x = rest / b;
    if (branch == 0.0)
        return mod_of(a, b);
    return branch > 0.0 ? (x < 1.5 ? rest : rest - 2.0 * b) : (x < 0.5 ? rest + b : rest - b);
}

/*
 * Return a function whose zeros are the ends of the periods: parabolas, positive in even periods of a/b, negative in
 * odd ones.
 */
static inline double period_branch(double a, double b)
{
    const double x = mod_of(a, 2.0 * b) / b;
    return x < 1.0 ? 4.0 * x * (1.0 - x) : min_of(4.0 * (x - 1.0) * (x - 2.0), -DBL_MIN);
}

/*
 * Return the branch of switching function k: the frozen one, or the sign of `value` if `branch` is NULL. g[k] is set to
 * `value`.
 */
static inline double branch_of(const double *branch, double *g, int k, double value)
{
    g[k] = value;
    return branch ? branch[k] : sign_of(value);
}

#define TURN_SMALL 0.01 /* rad: below it the series of turn_back are exact to rounding */

/* Update cosine and sine, direction[2], of an angle that is reduced by x < TURN_SMALL rad. */
static inline void turn_back(double *direction, double x)
{
    const double z = x * x, c = direction[0], s = direction[1];
    const double sine = x * (1.0 - (1.0 / 6.0) * z * (1.0 - 0.05 * z));
    const double less = 0.5 * z * (1.0 - (1.0 / 12.0) * z * (1.0 - (1.0 / 30.0) * z));
    direction[0] = c + (s * sine - c * less);
    direction[1] = s - (c * sine + s * less);
}

/* Return the weight of node k at 0 for Lagrange's polynomial through the nodes -n ... -1, 1 ... n. */
static inline double weight_at(int n, int k)
{
    double weight = 1.0;
    for (int j = 1; j <= n; j++)
        weight *= j == k ? 0.5 : (double)(j * j) / (double)(j * j - k * k);
    return weight;
}

#endif
