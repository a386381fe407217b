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
    double lo, hi;   /* bounds of its values; NaN: undefined everywhere */
    double down, up; /* bounds of its slope */
    int partly;      /* whether it may be undefined somewhere */
} Range;

/* Return the bounds of a constant x. */
static inline Range only(double x) { return (Range){x, x, 0.0, 0.0, 0}; }
/* Return whether a function is undefined everywhere. */
static inline int is_empty(Range x) { return !(x.lo <= x.hi); }

/* Return bounds of -x. */
static inline Range range_negative(Range x) { return (Range){-x.hi, -x.lo, -x.up, -x.down, x.partly}; }

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
static inline Range apply_chain_rule(Range x, double lower, double upper, double min_derivative, double max_derivative)
{
    Range y = {lower, upper, 0.0, 0.0, x.partly};
    compute_product_bounds(min_derivative, max_derivative, x.down, x.up, &y.down, &y.up);
    return y;
}

/* Return bounds that contain both x and y. An empty one is left out; both empty: y, which is empty. */
static inline Range range_union(Range x, Range y)
{
    if (is_empty(x) || is_empty(y))
        return is_empty(x) ? y : x;
    return (Range){min_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.down, y.down), max_of(x.up, y.up),
        x.partly | y.partly};
}

/* Return bounds of x + y. */
static inline Range range_add(Range x, Range y)
{
    return (Range){x.lo + y.lo, x.hi + y.hi, x.down + y.down, x.up + y.up, x.partly | y.partly};
}

/* Return bounds of the product x y and of its slope, by the product rule. Empty if x or y is. */
static inline Range range_times(Range x, Range y)
{
    Range z = {0.0, 0.0, 0.0, 0.0, x.partly | y.partly};
    double slope_lower, slope_upper;
    if (is_empty(x) || is_empty(y))
        return only(NAN);
    compute_product_bounds(x.lo, x.hi, y.lo, y.hi, &z.lo, &z.hi);
    compute_product_bounds(x.lo, x.hi, y.down, y.up, &z.down, &z.up);
    compute_product_bounds(x.down, x.up, y.lo, y.hi, &slope_lower, &slope_upper);
    z.down += slope_lower;
    z.up += slope_upper;
    return z;
}

/* Return bounds of x^n for an integer n. Unbounded if n is negative and x may be zero; 1 for n = 0; empty if x is. */
static inline Range range_integer_power(Range x, double n)
{
    const int is_even = fmod(n, 2.0) == 0.0, contains_zero = x.lo <= 0.0 && x.hi >= 0.0;
    if (is_empty(x) || n == 0.0)
        return is_empty(x) ? only(NAN) : only(1.0);
    if (contains_zero && n < 0.0)
        return (Range){is_even ? pow(max_of(-x.lo, x.hi), n) : x.lo < 0.0 ? -INFINITY : pow(x.hi, n),
            is_even || x.hi > 0.0 ? INFINITY : pow(x.lo, n), -INFINITY, INFINITY, x.partly};
    const double a = pow(x.lo, n), b = pow(x.hi, n);
    const double slope_a = n * pow(x.lo, n - 1.0), slope_b = n * pow(x.hi, n - 1.0);
    double min_slope = min_of(slope_a, slope_b), max_slope = max_of(slope_a, slope_b);
    if (contains_zero && !is_even) /* the slope is least, or zero, at zero */
        min_slope = n == 1.0 ? 1.0 : 0.0;
    return apply_chain_rule(x, contains_zero && is_even ? 0.0 : min_of(a, b), max_of(a, b), min_slope, max_slope);
}

/* Return bounds of 1/x. */
static inline Range range_inverse(Range x) { return range_integer_power(x, -1.0); }
/* Return bounds of x^2. */
static inline Range range_square(Range x) { return range_integer_power(x, 2.0); }

/* Return bounds of exp(x), which increases with x. */
static inline Range range_exp(Range x)
{
    const double a = exp(x.lo), b = exp(x.hi);
    return apply_chain_rule(x, a, b, a, b);
}

/* Return bounds of ln x. Empty if x is nowhere positive; partly undefined if x may be negative. */
static inline Range range_log(Range x)
{
    if (!(x.hi > 0.0))
        return only(NAN);
    Range y = apply_chain_rule(x, log(max_of(x.lo, 0.0)), log(x.hi), 1.0 / x.hi, 1.0 / max_of(x.lo, 0.0));
    y.partly |= x.lo < 0.0;
    return y;
}

/*
 * Return bounds of x^exponent for a non-integer exponent. Empty if x is negative everywhere; partly undefined if x may
 * be negative.
 */
static inline Range range_noninteger_power(Range x, double exponent)
{
    if (!(x.hi >= 0.0))
        return only(NAN);
    const double low = max_of(x.lo, 0.0), a = pow(low, exponent), b = pow(x.hi, exponent);
    const double slope_a = exponent * pow(low, exponent - 1.0), slope_b = exponent * pow(x.hi, exponent - 1.0);
    Range y = apply_chain_rule(x, min_of(a, b), max_of(a, b), min_of(slope_a, slope_b), max_of(slope_a, slope_b));
    y.partly |= x.lo < 0.0;
    return y;
}

/* Return bounds of the square root of x. */
static inline Range range_sqrt(Range x) { return range_noninteger_power(x, 0.5); }

/* Return bounds of x^exponent: by a power rule if the exponent is constant, else as exp(exponent ln x). */
static inline Range range_pow(Range x, Range exponent)
{
    if (exponent.lo == exponent.hi && exponent.down == 0.0 && exponent.up == 0.0)
        return exponent.lo == rint(exponent.lo) ? range_integer_power(x, exponent.lo)
            : range_noninteger_power(x, exponent.lo);
    return range_exp(range_times(exponent, range_log(x)));
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
static inline Range range_shifted_sine(Range x, double phase)
{
    double lower, upper, min_slope, max_slope;
    compute_sine_bounds(x.lo, x.hi, phase, &lower, &upper);
    compute_sine_bounds(x.lo, x.hi, phase + 1.5707963267948966, &min_slope, &max_slope);
    return apply_chain_rule(x, lower, upper, min_slope, max_slope);
}

/* Return bounds of sin x. */
static inline Range range_sin(Range x) { return range_shifted_sine(x, 0.0); }
/* Return bounds of cos x. */
static inline Range range_cos(Range x) { return range_shifted_sine(x, 1.5707963267948966); }
/* Return bounds of tan x. */
static inline Range range_tan(Range x) { return range_times(range_sin(x), range_inverse(range_cos(x))); }

/*
 * Return the part of x within the domain [lower, upper] of a function. Empty if x is outside it; partly undefined if x
 * exceeds the domain.
 */
static inline Range restrict_to_domain(Range x, double lower, double upper)
{
    if (lower == -INFINITY && upper == INFINITY)
        return x;
    if (!(x.lo <= upper && x.hi >= lower))
        return only(NAN);
    return (Range){max_of(x.lo, lower), min_of(x.hi, upper), x.down, x.up, x.partly || x.lo < lower || x.hi > upper};
}

/* Define the bounds of an increasing function, whose slope is least and largest at the ends or at its extremum. */
#define RANGE_OF_RISING(name, from, to, extremum, slope) \
    static inline double slope_of_##name(double x) { return slope; } \
    static inline Range range_##name(Range all) \
    { \
        const Range x = restrict_to_domain(all, from, to); \
        const double a = slope_of_##name(x.lo), b = slope_of_##name(x.hi); \
        const double inner = x.lo <= extremum && x.hi >= extremum ? slope_of_##name(extremum) : a; \
        return apply_chain_rule(x, name(x.lo), name(x.hi), min_of(inner, min_of(a, b)), max_of(inner, max_of(a, b))); \
    }
RISING_FUNCTIONS(RANGE_OF_RISING)

/* Return bounds of arccos x = pi/2 - arcsin x; x beyond [-1, 1] is partly undefined. */
static inline Range range_acos(Range x)
{
    return range_add(only(1.5707963267948966), range_times(only(-1.0), range_asin(x)));
}

/* Return bounds of cosh x, which is least at zero. */
static inline Range range_cosh(Range x)
{
    const double a = cosh(x.lo), b = cosh(x.hi), minimum = x.lo <= 0.0 && x.hi >= 0.0 ? 1.0 : min_of(a, b);
    return apply_chain_rule(x, minimum, max_of(a, b), sinh(x.lo), sinh(x.hi));
}

/*
 * Return bounds of the angle of the point (x, y), rad; note the order of the arguments. Where the angle may jump or is
 * undefined (y = 0, x <= 0) they are [-pi, pi] with unbounded slope. Empty if x or y is.
 */
static inline Range range_atan2(Range y, Range x)
{
    if (is_empty(x) || is_empty(y))
        return only(NAN);
    if (y.lo <= 0.0 && y.hi >= 0.0 && x.lo <= 0.0)
        return (Range){-PI, PI, -INFINITY, INFINITY, x.partly | y.partly};
    const double a = atan2(y.lo, x.lo), b = atan2(y.lo, x.hi), c = atan2(y.hi, x.lo), d = atan2(y.hi, x.hi);
    const Range square = range_add(range_square(x), range_square(y));
    const Range by_x = range_times(x, range_inverse(square)), by_y = range_times(y, range_inverse(square));
    Range z = {min_of(min_of(a, b), min_of(c, d)), max_of(max_of(a, b), max_of(c, d)), 0.0, 0.0, x.partly | y.partly};
    double slope_lower, slope_upper;
    compute_product_bounds(by_x.lo, by_x.hi, y.down, y.up, &z.down, &z.up);
    compute_product_bounds(by_y.lo, by_y.hi, x.down, x.up, &slope_lower, &slope_upper);
    z.down -= slope_upper;
    z.up -= slope_lower;
    return z;
}

/*
 * Return bounds of mod(a, b) = a - k b. branch: 0, or the frozen branch of the periods (1: even k, -1: odd k), which
 * extends by half of the neighbouring periods. If more than one period is possible, the whole period with unbounded
 * slope is returned. Empty if a/b is.
 */
static inline Range range_mod_on(Range a, Range b, Range branch)
{
    const Range x = range_times(a, range_inverse(b));
    const double frozen = branch.lo == branch.hi ? branch.lo : 0.0, offset = frozen < 0.0 ? 1.0 : 0.0;
    const double period_step = frozen == 0.0 ? 1.0 : 2.0, extension = frozen == 0.0 ? 0.0 : 0.5;
    const double first = period_step * floor((x.lo + extension - offset) / period_step) + offset;
    const double last = period_step * floor((x.hi + extension - offset) / period_step) + offset;
    if (is_empty(x))
        return x;
    if (first == last)
        return range_add(a, range_times(only(-first), b));
    Range y = range_times((Range){-extension, 1.0 + extension, 0.0, 0.0, x.partly}, b);
    y.down = -INFINITY;
    y.up = INFINITY;
    return y;
}

/* Return bounds of mod(a, b) without a frozen branch. */
static inline Range range_mod_of(Range a, Range b) { return range_mod_on(a, b, only(0.0)); }

/* Return whether one of the points first + 2 n, n being an integer, is in [lower, upper]. */
static inline int contains_sequence_point(double lower, double upper, double first)
{
    return !(upper - lower < 2.0) || floor(0.5 * (upper - first)) >= ceil(0.5 * (lower - first));
}

/*
 * Return the derivative by x of period_branch(x, 1), the switching function of mod(x, 1). It has the period 2: 4 at
 * even integers x, -4 at odd ones, and linear between. Called for the bounds of slopes.
 */
static inline double compute_period_slope(double x)
{
    const double rest = mod_of(x, 2.0);
    return rest < 1.0 ? 4.0 - 8.0 * rest : 8.0 * rest - 12.0;
}

/*
 * Return bounds of period_branch(a, b), the function that is positive in even periods of a/b and negative in odd ones.
 * Empty if a/b is.
 */
static inline Range range_period_branch(Range a, Range b)
{
    const Range x = range_times(a, range_inverse(b));
    if (is_empty(x))
        return x;
    const double value_lower = period_branch(x.lo, 1.0), value_upper = period_branch(x.hi, 1.0);
    const double slope_lower = compute_period_slope(x.lo), slope_upper = compute_period_slope(x.hi);
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
static inline Range range_branch(const double *branch, int k, Range g)
{
    const double lower = g.lo < 0.0 ? -1.0 : g.lo > 0.0 ? 1.0 : 0.0, upper = g.hi > 0.0 ? 1.0 : g.hi < 0.0 ? -1.0 : 0.0;
    const double slope = lower < upper ? INFINITY : 0.0;
    return branch ? only(branch[k]) : (Range){lower, upper, -slope, slope, g.partly};
}

/*
 * Return the bounds of the active expression: b on the negative branch, a on the other one, or those of both if the
 * branch may change.
 */
static inline Range range_pick(Range branch, Range a, Range b)
{
    return branch.hi < 0.0 ? b : branch.lo >= 0.0 ? a : range_union(a, b);
}

/* Return bounds of max(x, y): those of one if it is nowhere less than the other, else of both. */
static inline Range range_max_of(Range x, Range y)
{
    return x.lo >= y.hi ? x : y.lo >= x.hi ? y : (Range){max_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.down, y.down),
        max_of(x.up, y.up), x.partly | y.partly};
}

/* Return bounds of min(x, y) = -max(-x, -y). */
static inline Range range_min_of(Range x, Range y)
{
    return range_times(only(-1.0), range_max_of(range_times(only(-1.0), x), range_times(only(-1.0), y)));
}

/* Return bounds of |x|. */
static inline Range range_fabs(Range x) { return range_max_of(x, range_times(only(-1.0), x)); }
/* Return bounds of the sign of x. */
static inline Range range_sign_of(Range x) { return range_branch(NULL, 0, x); }
/* Return bounds of |x| + 1e-150, which never vanishes. */
static inline Range range_magnitude(Range x) { return range_add(range_fabs(x), only(1e-150)); }
/* Return bounds of Heaviside's function: 1 for x >= 0, else 0; both if x may change its sign. */
static inline Range range_heaviside(Range x)
{
    return range_pick(range_sign_of(x), only(1.0), only(0.0));
}

#endif
