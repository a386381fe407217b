/*
 * Interval arithmetic with first derivatives: bounds of an expression and of its slope along a step. The bounds hold
 * while the arguments of the expression stay within their bounds. The unit of slopes is the whole step. Source: R. E.
 * Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (2009), chapters 5 and 6. Rounding errors are
 * not included.
 */
#ifndef GUDGEON_RANGES_H
#define GUDGEON_RANGES_H
#include "../scene/function_table.h"

/* Bounds of a function over a part of a step, and of its slope there. */
typedef struct {
    double lo, hi;               /* bounds of its values; NaN: undefined everywhere */
    double min_slope, max_slope; /* bounds of its slope */
    int may_be_undefined;        /* whether it may be undefined somewhere */
} Interval;

/* Return the interval of a constant x, with slope 0; x = NAN: the empty interval. */
static inline Interval make_interval(double x) { return (Interval){x, x, 0.0, 0.0, 0}; }
/* Return whether a function is undefined everywhere. */
static inline int is_empty(Interval x) { return !(x.lo <= x.hi); }

/* Return bounds of -x. */
static inline Interval interval_negative(Interval x)
{
    return (Interval){-x.hi, -x.lo, -x.max_slope, -x.min_slope, x.may_be_undefined};
}

/* Return the product of two bounds; zero times an infinite bound is zero. */
static inline double multiply_bounds(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; }

/*
 * Compute the bounds lower, upper of the product x y for x in [a, b] and y in [c, d]. Zero times infinity is zero; NaN
 * is propagated.
 */
static inline void compute_product_bounds(double a, double b, double c, double d, double *lower, double *upper)
{
    const double ac = multiply_bounds(a, c), ad = multiply_bounds(a, d), bc = multiply_bounds(b, c),
        bd = multiply_bounds(b, d);
    *lower = min_of(min_of(ac, ad), min_of(bc, bd));
    *upper = max_of(max_of(ac, ad), max_of(bc, bd));
}

/*
 * Return the bounds of f(x) with values in [lower, upper]; the bounds of its slope are the products of df/dx in
 * [min_derivative, max_derivative] with the slope of x.
 */
static inline Interval apply_chain_rule(Interval x, double lower, double upper, double min_derivative,
    double max_derivative)
{
    Interval y = {lower, upper, 0.0, 0.0, x.may_be_undefined};
    compute_product_bounds(min_derivative, max_derivative, x.min_slope, x.max_slope, &y.min_slope, &y.max_slope);
    return y;
}

/* Return bounds that contain both x and y. An empty one is left out; both empty: y, which is empty. */
static inline Interval interval_union(Interval x, Interval y)
{
    if (is_empty(x) || is_empty(y))
        return is_empty(x) ? y : x;
    return (Interval){min_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.min_slope, y.min_slope),
        max_of(x.max_slope, y.max_slope), x.may_be_undefined | y.may_be_undefined};
}

/* Return bounds of x + y. */
static inline Interval interval_add(Interval x, Interval y)
{
    return (Interval){x.lo + y.lo, x.hi + y.hi, x.min_slope + y.min_slope, x.max_slope + y.max_slope,
        x.may_be_undefined | y.may_be_undefined};
}

/* Return bounds of the product x y and of its slope, by the product rule. Empty if x or y is. */
static inline Interval interval_mul(Interval x, Interval y)
{
    Interval z = {0.0, 0.0, 0.0, 0.0, x.may_be_undefined | y.may_be_undefined};
    double slope_lower, slope_upper;
    if (is_empty(x) || is_empty(y))
        return make_interval(NAN);
    compute_product_bounds(x.lo, x.hi, y.lo, y.hi, &z.lo, &z.hi);
    compute_product_bounds(x.lo, x.hi, y.min_slope, y.max_slope, &z.min_slope, &z.max_slope);
    compute_product_bounds(x.min_slope, x.max_slope, y.lo, y.hi, &slope_lower, &slope_upper);
    z.min_slope += slope_lower;
    z.max_slope += slope_upper;
    return z;
}

/* Return bounds of x^n for an integer n. Unbounded if n is negative and x may be zero; 1 for n = 0; empty if x is. */
static inline Interval interval_integer_power(Interval x, double n)
{
    const int is_even = fmod(n, 2.0) == 0.0, contains_zero = x.lo <= 0.0 && x.hi >= 0.0;
    if (is_empty(x) || n == 0.0)
        return is_empty(x) ? make_interval(NAN) : make_interval(1.0);
    if (contains_zero && n < 0.0)
        return (Interval){is_even ? pow(max_of(-x.lo, x.hi), n) : x.lo < 0.0 ? -INFINITY : pow(x.hi, n),
            is_even || x.hi > 0.0 ? INFINITY : pow(x.lo, n), -INFINITY, INFINITY, x.may_be_undefined};
    const double a = pow(x.lo, n), b = pow(x.hi, n);
    const double slope_a = n * pow(x.lo, n - 1.0), slope_b = n * pow(x.hi, n - 1.0);
    double min_slope = min_of(slope_a, slope_b), max_slope = max_of(slope_a, slope_b);
    if (contains_zero && !is_even) /* the slope has its minimum, 0 or 1, at zero */
        min_slope = n == 1.0 ? 1.0 : 0.0;
    return apply_chain_rule(x, contains_zero && is_even ? 0.0 : min_of(a, b), max_of(a, b), min_slope, max_slope);
}

/* Return bounds of 1/x. */
static inline Interval interval_inverse(Interval x) { return interval_integer_power(x, -1.0); }
/* Return bounds of x^2. */
static inline Interval interval_square(Interval x) { return interval_integer_power(x, 2.0); }

/* Return bounds of exp(x), which increases with x. */
static inline Interval interval_exp(Interval x)
{
    const double a = exp(x.lo), b = exp(x.hi);
    return apply_chain_rule(x, a, b, a, b);
}

/* Return bounds of ln x. Empty if x is nowhere positive; it may be undefined if x may be negative. */
static inline Interval interval_log(Interval x)
{
    if (!(x.hi > 0.0))
        return make_interval(NAN);
    Interval y = apply_chain_rule(x, log(max_of(x.lo, 0.0)), log(x.hi), 1.0 / x.hi, 1.0 / max_of(x.lo, 0.0));
    y.may_be_undefined |= x.lo < 0.0;
    return y;
}

/*
 * Return bounds of x^exponent for a non-integer exponent. Empty if x is negative everywhere; it may be undefined if x
 * may be negative.
 */
static inline Interval interval_noninteger_power(Interval x, double exponent)
{
    if (!(x.hi >= 0.0))
        return make_interval(NAN);
    const double low = max_of(x.lo, 0.0), a = pow(low, exponent), b = pow(x.hi, exponent);
    const double slope_a = exponent * pow(low, exponent - 1.0), slope_b = exponent * pow(x.hi, exponent - 1.0);
    Interval y = apply_chain_rule(x, min_of(a, b), max_of(a, b), min_of(slope_a, slope_b), max_of(slope_a, slope_b));
    y.may_be_undefined |= x.lo < 0.0;
    return y;
}

/* Return bounds of the square root of x. */
static inline Interval interval_sqrt(Interval x) { return interval_noninteger_power(x, 0.5); }

/* Return bounds of x^exponent: by a power rule if the exponent is constant, else as exp(exponent ln x). */
static inline Interval interval_pow(Interval x, Interval exponent)
{
    if (exponent.lo == exponent.hi && exponent.min_slope == 0.0 && exponent.max_slope == 0.0)
        return exponent.lo == rint(exponent.lo) ? interval_integer_power(x, exponent.lo)
            : interval_noninteger_power(x, exponent.lo);
    return interval_exp(interval_mul(exponent, interval_log(x)));
}

/*
 * Compute the bounds min_sine, max_sine of sin(x + phase) for x in [lower, upper], rad. Intervals of a turn or more
 * have the bounds -1 and 1; NaN is propagated.
 */
static inline void compute_sine_bounds(double lower, double upper, double phase, double *min_sine, double *max_sine)
{
    const double turn = 6.283185307179586, quarter_turn = 1.5707963267948966, a = sin(lower + phase),
        b = sin(upper + phase);
    *max_sine = floor((upper + phase - quarter_turn) / turn)
            >= ceil((lower + phase - quarter_turn) / turn) ? 1.0 : max_of(a, b);
    *min_sine = floor((upper + phase + quarter_turn) / turn)
            >= ceil((lower + phase + quarter_turn) / turn) ? -1.0 : min_of(a, b);
    if (!(upper - lower < turn) && !isnan(upper - lower))
        *min_sine = -1.0, *max_sine = 1.0;
}

/* Return bounds of sin(x + phase); phase in rad: 0 for the sine, pi/2 for the cosine. */
static inline Interval interval_shifted_sine(Interval x, double phase)
{
    double lower, upper, min_slope, max_slope;
    compute_sine_bounds(x.lo, x.hi, phase, &lower, &upper);
    compute_sine_bounds(x.lo, x.hi, phase + 1.5707963267948966, &min_slope, &max_slope);
    return apply_chain_rule(x, lower, upper, min_slope, max_slope);
}

/* Return bounds of sin x. */
static inline Interval interval_sin(Interval x) { return interval_shifted_sine(x, 0.0); }
/* Return bounds of cos x. */
static inline Interval interval_cos(Interval x) { return interval_shifted_sine(x, 1.5707963267948966); }
/* Return bounds of tan x. */
static inline Interval interval_tan(Interval x)
{
    return interval_mul(interval_sin(x), interval_inverse(interval_cos(x)));
}

/*
 * Return the part of x within the domain [lower, upper] of a function. Empty if x is outside it; may be undefined if x
 * exceeds the domain.
 */
static inline Interval restrict_to_domain(Interval x, double lower, double upper)
{
    if (lower == -INFINITY && upper == INFINITY)
        return x;
    if (!(x.lo <= upper && x.hi >= lower))
        return make_interval(NAN);
    return (Interval){max_of(x.lo, lower), min_of(x.hi, upper), x.min_slope, x.max_slope,
        x.may_be_undefined || x.lo < lower || x.hi > upper};
}

/* Define the bounds of an increasing function, whose slope has its extrema at the ends or at `extremum`. */
#define RANGE_OF_RISING(name, from, to, extremum, slope) \
    static inline double slope_of_##name(double x) { return slope; } \
    static inline Interval interval_##name(Interval all) \
    { \
        const Interval x = restrict_to_domain(all, from, to); \
        const double a = slope_of_##name(x.lo), b = slope_of_##name(x.hi); \
        const double inner = x.lo <= extremum && x.hi >= extremum ? slope_of_##name(extremum) : a; \
        return apply_chain_rule(x, name(x.lo), name(x.hi), min_of(inner, min_of(a, b)), max_of(inner, max_of(a, b))); \
    }
RISING_FUNCTIONS(RANGE_OF_RISING)

/* Return bounds of arccos x = pi/2 - arcsin x; it may be undefined if x exceeds [-1, 1]. */
static inline Interval interval_acos(Interval x)
{
    return interval_add(make_interval(1.5707963267948966), interval_mul(make_interval(-1.0), interval_asin(x)));
}

/* Return bounds of cosh x, whose minimum 1 is at zero. */
static inline Interval interval_cosh(Interval x)
{
    const double a = cosh(x.lo), b = cosh(x.hi), minimum = x.lo <= 0.0 && x.hi >= 0.0 ? 1.0 : min_of(a, b);
    return apply_chain_rule(x, minimum, max_of(a, b), sinh(x.lo), sinh(x.hi));
}

/*
 * Return bounds of the angle of the point (x, y), rad; note the order of the arguments. Where the angle may jump or is
 * undefined (y = 0, x <= 0) they are [-pi, pi] with unbounded slope. Empty if x or y is.
 */
static inline Interval interval_atan2(Interval y, Interval x)
{
    if (is_empty(x) || is_empty(y))
        return make_interval(NAN);
    if (y.lo <= 0.0 && y.hi >= 0.0 && x.lo <= 0.0)
        return (Interval){-PI, PI, -INFINITY, INFINITY, x.may_be_undefined | y.may_be_undefined};
    const double a = atan2(y.lo, x.lo), b = atan2(y.lo, x.hi), c = atan2(y.hi, x.lo), d = atan2(y.hi, x.hi);
    const Interval square = interval_add(interval_square(x), interval_square(y));
    const Interval by_x = interval_mul(x, interval_inverse(square)),
        by_y = interval_mul(y, interval_inverse(square));
    Interval z = {min_of(min_of(a, b), min_of(c, d)), max_of(max_of(a, b), max_of(c, d)), 0.0, 0.0,
        x.may_be_undefined | y.may_be_undefined};
    double slope_lower, slope_upper;
    compute_product_bounds(by_x.lo, by_x.hi, y.min_slope, y.max_slope, &z.min_slope, &z.max_slope);
    compute_product_bounds(by_y.lo, by_y.hi, x.min_slope, x.max_slope, &slope_lower, &slope_upper);
    z.min_slope -= slope_upper;
    z.max_slope -= slope_lower;
    return z;
}

/*
 * Return bounds of mod(a, b) = a - k b. branch: 0, or the frozen branch of the periods (1: even k, -1: odd k), which
 * extends by half of the neighbouring periods. If more than one period is possible, the whole period with unbounded
 * slope is returned. Empty if a/b is.
 */
static inline Interval interval_mod_on_branch(Interval a, Interval b, Interval branch)
{
    const Interval x = interval_mul(a, interval_inverse(b));
    const double frozen = branch.lo == branch.hi ? branch.lo : 0.0, offset = frozen < 0.0 ? 1.0 : 0.0;
    const double period_step = frozen == 0.0 ? 1.0 : 2.0, extension = frozen == 0.0 ? 0.0 : 0.5;
    const double first = period_step * floor((x.lo + extension - offset) / period_step) + offset;
    const double last = period_step * floor((x.hi + extension - offset) / period_step) + offset;
    if (is_empty(x))
        return x;
    if (first == last)
        return interval_add(a, interval_mul(make_interval(-first), b));
    Interval y = interval_mul((Interval){-extension, 1.0 + extension, 0.0, 0.0, x.may_be_undefined}, b);
    y.min_slope = -INFINITY;
    y.max_slope = INFINITY;
    return y;
}

/* Return bounds of mod(a, b) without a frozen branch. */
static inline Interval interval_mod_of(Interval a, Interval b)
{
    return interval_mod_on_branch(a, b, make_interval(0.0));
}

/* Return whether one of the points first + 2 n, n being an integer, is in [lower, upper]. */
static inline int contains_sequence_point(double lower, double upper, double first)
{
    return !(upper - lower < 2.0) || floor(0.5 * (upper - first)) >= ceil(0.5 * (lower - first));
}

/*
 * Return the derivative by x of mod_switching_function(x, 1), the switching function of mod(x, 1). It has the period 2:
 * 4 at even integers x, -4 at odd ones, and linear between, with a jump of its slope at integers. Used for the bounds
 * of slopes.
 */
static inline double compute_mod_switching_slope(double x)
{
    const double remainder = mod_of(x, 2.0);
    return remainder < 1.0 ? 4.0 - 8.0 * remainder : 8.0 * remainder - 12.0;
}

/*
 * Return bounds of mod_switching_function(a, b), the continuous switching function of mod(a, b): parabolas of
 * height 1 in even periods of a/b and -1 in odd ones, with the slope 4 or -4 at multiples of b.
 * Empty if a/b is.
 */
static inline Interval interval_mod_switching_function(Interval a, Interval b)
{
    const Interval x = interval_mul(a, interval_inverse(b));
    if (is_empty(x))
        return x;
    const double value_lower = mod_switching_function(x.lo, 1.0), value_upper = mod_switching_function(x.hi, 1.0);
    const double slope_lower = compute_mod_switching_slope(x.lo), slope_upper = compute_mod_switching_slope(x.hi);
    return apply_chain_rule(x, contains_sequence_point(x.lo, x.hi, 1.5) ? -1.0 : min_of(value_lower, value_upper),
        contains_sequence_point(x.lo, x.hi, 0.5) ? 1.0 : max_of(value_lower, value_upper),
            contains_sequence_point(x.lo, x.hi, 1.0) ? -4.0
            : min_of(slope_lower, slope_upper),
        contains_sequence_point(x.lo, x.hi, 0.0) ? 4.0 : max_of(slope_lower, slope_upper));
}

/*
 * Return bounds of the branch of switching function k: the frozen one (1 or -1), or by the sign of its values g if
 * `branch` is NULL. A sign that may change has an unbounded slope.
 */
static inline Interval interval_branch(const double *branch, int k, Interval g)
{
    const double lower = g.lo < 0.0 ? -1.0 : g.lo > 0.0 ? 1.0 : 0.0, upper = g.hi > 0.0 ? 1.0 : g.hi < 0.0 ? -1.0 : 0.0;
    const double slope = lower < upper ? INFINITY : 0.0;
    return branch ? make_interval(branch[k]) : (Interval){lower, upper, -slope, slope, g.may_be_undefined};
}

/*
 * Return the bounds of the active expression: b on the negative branch, a on the other one, or those of both if the
 * branch may change.
 */
static inline Interval interval_select(Interval branch, Interval a, Interval b)
{
    return branch.hi < 0.0 ? b : branch.lo >= 0.0 ? a : interval_union(a, b);
}

/* Return bounds of max(x, y): those of one if it is nowhere less than the other, else of both. */
static inline Interval interval_max_of(Interval x, Interval y)
{
    return x.lo >= y.hi ? x : y.lo >= x.hi ? y : (Interval){max_of(x.lo, y.lo), max_of(x.hi, y.hi),
        min_of(x.min_slope, y.min_slope), max_of(x.max_slope, y.max_slope), x.may_be_undefined | y.may_be_undefined};
}

/* Return bounds of min(x, y) = -max(-x, -y). */
static inline Interval interval_min_of(Interval x, Interval y)
{
    const Interval minus_one = make_interval(-1.0);
    return interval_mul(minus_one, interval_max_of(interval_mul(minus_one, x), interval_mul(minus_one, y)));
}

/* Return bounds of |x|. */
static inline Interval interval_fabs(Interval x) { return interval_max_of(x, interval_mul(make_interval(-1.0), x)); }
/* Return bounds of the sign of x. */
static inline Interval interval_sign_of(Interval x) { return interval_branch(NULL, 0, x); }
/* Return bounds of |x| + 1e-150, which never vanishes. */
static inline Interval interval_magnitude(Interval x) { return interval_add(interval_fabs(x), make_interval(1e-150)); }
/* Return bounds of Heaviside's function: 1 for x >= 0, else 0; both if x may change its sign. */
static inline Interval interval_heaviside(Interval x)
{
    return interval_select(interval_sign_of(x), make_interval(1.0), make_interval(0.0));
}

#endif
