/*
 * Arithmetic that all parts share.
 */
#ifndef GUDGEON_NUMBERS_H
#define GUDGEON_NUMBERS_H

#include "functions.h"

#define PI 3.141592653589793
/* Smaller numbers, among them subnormal ones, may have fewer digits than others: no quotient of them is compared. */
#define MIN_RESOLVED (DBL_MIN / DBL_EPSILON)

/* min, max, sign that keep a NaN in x. */
static inline double max_of(double x, double y) { return x < y ? y : x; }
static inline double min_of(double x, double y) { return x > y ? y : x; }
static inline double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }

/* Whether both are positive, or both negative: their product may be too small for a number. */
static inline int have_same_sign(double x, double y) { return x > 0.0 ? y > 0.0 : x < 0.0 && y < 0.0; }

/* Whether n values are numbers and finite. */
static inline int all_finite(const double *x, int n)
{
    double none = 0.0;
    for (int k = 0; k < n; k++)
        none += 0.0 * x[k];
    return none == 0.0;
}

/* To the last bit; no number is the same as any. */
static inline int same_number(double x, double y) { return x == y && !signbit(x) == !signbit(y); }

/* How close (s) to the end t of a step of length h a sample is the end's own: both are sums of rounded numbers. */
static inline double rounded(double t, double h) { return 8.0 * DBL_EPSILON * fabs(t) + 1e-12 * h; }

#ifdef __wasm__ /* what a page carries: of what runs seldom rather little than fast */
#define SELDOM __attribute__((minsize))
#else
#define SELDOM
#endif

/*
 * Time at which step i (0, 1, ...) of a fixed length ends, from t0 towards t_end; `h` is its length. The last one ends
 * at t_end and is the shorter for it. Steps from a multiple of their length end at multiples, so that a run that goes
 * on from the end of one takes the same ones, to the bit.
 */
static inline double step_end(double t0, double t_end, double step, double i, double *h)
{
    const double total = max_of(ceil((t_end - t0) / step * (1.0 - 1e-12)), 1.0);
    const double rest = t_end - t0 - (total - 1.0) * step, count = rint(t0 / step);
    const int multiple = fabs(count * step - t0) <= rounded(t0, step);
    *h = i < total || fabs(rest - step) < 1e-9 * step ? step : rest;
    return i < total ? (multiple ? (count + i) * step : t0 + i * step) : t_end;
}

/*
 * Places beside x, and a slope: the derivative as it is written, or the rise between them where that is no number. A
 * term that is finite while its derivative overflows is saturated.
 */
static inline double just_ahead(double x) { return x + 1e-9 * (1.0 + fabs(x)); }
static inline double just_behind(double x) { return x - 1e-9 * (1.0 + fabs(x)); }
static inline double finite_slope(double derivative, double ahead, double behind, double way)
{
    return isfinite(derivative) ? derivative : (ahead - behind) / way;
}

/* So little behind t that rounding no longer hides on which side of a corner a drive goes on. */
static inline double ahead_of(double t) { return t + max_of(32.0 * DBL_EPSILON * fabs(t), 1e-100); }
/* The time at which the rate of a drive is asked for: beyond a jump, if it may jump. */
static inline double beyond_jump(double t) { return RATE_JUMPS ? ahead_of(t) : t; }

/*
 * mod(a, b), from 0 to b; on a side, in the periods of even (1) or odd (-1) number, each as it goes on half a period
 * beyond its ends. period_branch: above zero in those of even number, below it in the others, parabolas from 0 to 0.
 * The end at which mod begins anew belongs to the period that begins there, and what is rounded to its end to the one
 * left.
 */
static inline double mod_of(double a, double b)
{
    const double rest = fmod(a, b);
    return rest != 0.0 && (rest < 0.0) != (b < 0.0) ? rest + b : rest;
}

static inline double mod_on(double a, double b, double branch)
{
    const double rest = mod_of(a, 2.0 * b), x = rest / b;
    if (branch == 0.0)
        return mod_of(a, b);
    return branch > 0.0 ? (x < 1.5 ? rest : rest - 2.0 * b) : (x < 0.5 ? rest + b : rest - b);
}

static inline double period_branch(double a, double b)
{
    const double x = mod_of(a, 2.0 * b) / b;
    return x < 1.0 ? 4.0 * x * (1.0 - x) : min_of(4.0 * (x - 1.0) * (x - 2.0), -DBL_MIN);
}

/* The side of corner k: as it is held, or where g is. */
static inline double branch_of(const double *branch, double *g, int k, double value)
{
    g[k] = value;
    return branch ? branch[k] : sign_of(value);
}

#define TURN_SMALL 0.01 /* rad: below it the series of turn_back are exact to rounding */

/* Cosine and sine of an angle that became smaller by x. */
static inline void turn_back(double *direction, double x)
{
    const double z = x * x, c = direction[0], s = direction[1];
    const double sine = x * (1.0 - (1.0 / 6.0) * z * (1.0 - 0.05 * z));
    const double less = 0.5 * z * (1.0 - (1.0 / 12.0) * z * (1.0 - (1.0 / 30.0) * z));
    direction[0] = c + (s * sine - c * less);
    direction[1] = s - (c * sine + s * less);
}

/* Of Lagrange's polynomials through places -n ... -1, 1 ... n: their value at 0, for place k. */
static inline double weight_at(int n, int k)
{
    double weight = 1.0;
    for (int j = 1; j <= n; j++)
        weight *= j == k ? 0.5 : (double)(j * j) / (double)(j * j - k * k);
    return weight;
}

#endif
