/*
 * Interval arithmetic with first derivatives: bounds of an expression and of its slope along a step, while its
 * arguments stay within their bounds. The unit of slopes is the whole step. Source: R. E. Moore, R. B. Kearfott, M. J.
 * Cloud, Introduction to Interval Analysis (2009), chapters 5 and 6. Rounding errors are not included.
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
static inline double multiply_ends(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; }

/* Compute bounds lo, hi of x y for x in [a, b] and y in [c, d]; NaN is propagated. */
static inline void product_bounds(double a, double b, double c, double d, double *lo, double *hi)
{
    const double ac = multiply_ends(a, c), ad = multiply_ends(a, d), bc = multiply_ends(b, c), bd = multiply_ends(b, d);
    *lo = min_of(min_of(ac, ad), min_of(bc, bd));
    *hi = max_of(max_of(ac, ad), max_of(bc, bd));
}

/* Return bounds of f(x), whose values are in [lo, hi] and whose derivative df/dx is in [least, most]. */
static inline Range apply_chain_rule(Range x, double lo, double hi, double least, double most)
{
    Range y = {lo, hi, 0.0, 0.0, x.partly};
    product_bounds(least, most, x.down, x.up, &y.down, &y.up);
    return y;
}

/* Return bounds that contain both x and y; an empty one is left out. */
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

/* Return bounds of x y, its slope by the product rule. */
static inline Range range_times(Range x, Range y)
{
    Range z = {0.0, 0.0, 0.0, 0.0, x.partly | y.partly};
    double down, up;
    if (is_empty(x) || is_empty(y))
        return only(NAN);
    product_bounds(x.lo, x.hi, y.lo, y.hi, &z.lo, &z.hi);
    product_bounds(x.lo, x.hi, y.down, y.up, &z.down, &z.up);
    product_bounds(x.down, x.up, y.lo, y.hi, &down, &up);
    z.down += down;
    z.up += up;
    return z;
}

/* Return bounds of x^n for an integer n, unbounded if n is negative and x may be zero. */
static inline Range range_power_of(Range x, double n)
{
    const int even = fmod(n, 2.0) == 0.0, zero = x.lo <= 0.0 && x.hi >= 0.0;
    if (is_empty(x) || n == 0.0)
        return is_empty(x) ? only(NAN) : only(1.0);
    if (zero && n < 0.0)
        return (Range){even ? pow(max_of(-x.lo, x.hi), n) : x.lo < 0.0 ? -INFINITY : pow(x.hi, n),
            even || x.hi > 0.0 ? INFINITY : pow(x.lo, n), -INFINITY, INFINITY, x.partly};
    const double a = pow(x.lo, n), b = pow(x.hi, n);
    const double slope_a = n * pow(x.lo, n - 1.0), slope_b = n * pow(x.hi, n - 1.0);
    double least = min_of(slope_a, slope_b), most = max_of(slope_a, slope_b);
    if (zero && !even) /* the slope is least, or zero, at zero */
        least = n == 1.0 ? 1.0 : 0.0;
    return apply_chain_rule(x, zero && even ? 0.0 : min_of(a, b), max_of(a, b), least, most);
}

/* Return bounds of 1/x. */
static inline Range range_inverse(Range x) { return range_power_of(x, -1.0); }
/* Return bounds of x^2. */
static inline Range range_square(Range x) { return range_power_of(x, 2.0); }

/* Return bounds of exp(x). */
static inline Range range_exp(Range x)
{
    const double a = exp(x.lo), b = exp(x.hi);
    return apply_chain_rule(x, a, b, a, b);
}

/* Return bounds of ln x, which is undefined below zero. */
static inline Range range_log(Range x)
{
    if (!(x.hi > 0.0))
        return only(NAN);
    Range y = apply_chain_rule(x, log(max_of(x.lo, 0.0)), log(x.hi), 1.0 / x.hi, 1.0 / max_of(x.lo, 0.0));
    y.partly |= x.lo < 0.0;
    return y;
}

/* Return bounds of x^c for a non-integer c; it is undefined below zero. */
static inline Range range_broken_power(Range x, double c)
{
    if (!(x.hi >= 0.0))
        return only(NAN);
    const double low = max_of(x.lo, 0.0), a = pow(low, c), b = pow(x.hi, c);
    const double slope_a = c * pow(low, c - 1.0), slope_b = c * pow(x.hi, c - 1.0);
    Range y = apply_chain_rule(x, min_of(a, b), max_of(a, b), min_of(slope_a, slope_b), max_of(slope_a, slope_b));
    y.partly |= x.lo < 0.0;
    return y;
}

/* Return bounds of the square root of x. */
static inline Range range_sqrt(Range x) { return range_broken_power(x, 0.5); }

/* Return bounds of x^c: by a power rule if c is constant, else as exp(c ln x). */
static inline Range range_pow(Range x, Range c)
{
    if (c.lo == c.hi && c.down == 0.0 && c.up == 0.0)
        return c.lo == rint(c.lo) ? range_power_of(x, c.lo) : range_broken_power(x, c.lo);
    return range_exp(range_times(c, range_log(x)));
}

/* Compute the bounds least, most of sin(x + quarter) for x in [lo, hi], rad. */
static inline void sine_bounds(double lo, double hi, double quarter, double *least, double *most)
{
    const double turn = 6.283185307179586, right = 1.5707963267948966, a = sin(lo + quarter), b = sin(hi + quarter);
    *most = floor((hi + quarter - right) / turn) >= ceil((lo + quarter - right) / turn) ? 1.0 : max_of(a, b);
    *least = floor((hi + quarter + right) / turn) >= ceil((lo + quarter + right) / turn) ? -1.0 : min_of(a, b);
    if (!(hi - lo < turn) && !isnan(hi - lo))
        *least = -1.0, *most = 1.0;
}

/* Return bounds of sin(x + quarter). */
static inline Range range_shifted_sine(Range x, double quarter)
{
    double lo, hi, least, most;
    sine_bounds(x.lo, x.hi, quarter, &lo, &hi);
    sine_bounds(x.lo, x.hi, quarter + 1.5707963267948966, &least, &most);
    return apply_chain_rule(x, lo, hi, least, most);
}

/* Return bounds of sin x. */
static inline Range range_sin(Range x) { return range_shifted_sine(x, 0.0); }
/* Return bounds of cos x. */
static inline Range range_cos(Range x) { return range_shifted_sine(x, 1.5707963267948966); }
/* Return bounds of tan x. */
static inline Range range_tan(Range x) { return range_times(range_sin(x), range_inverse(range_cos(x))); }

/* Return the part of x within the domain [from, to] of a function; it is partly undefined if x exceeds the domain. */
static inline Range range_within(Range x, double from, double to)
{
    if (from == -INFINITY && to == INFINITY)
        return x;
    if (!(x.lo <= to && x.hi >= from))
        return only(NAN);
    return (Range){max_of(x.lo, from), min_of(x.hi, to), x.down, x.up, x.partly || x.lo < from || x.hi > to};
}

/* Define the bounds of an increasing function, whose slope is least and largest at the ends or at its extremum. */
#define RANGE_OF_RISING(name, from, to, extremum, slope) \
    static inline double slope_of_##name(double x) { return slope; } \
    static inline Range range_##name(Range all) \
    { \
        const Range x = range_within(all, from, to); \
        const double a = slope_of_##name(x.lo), b = slope_of_##name(x.hi); \
        const double inner = x.lo <= extremum && x.hi >= extremum ? slope_of_##name(extremum) : a; \
        return apply_chain_rule(x, name(x.lo), name(x.hi), min_of(inner, min_of(a, b)), max_of(inner, max_of(a, b))); \
    }
RISING_FUNCTIONS(RANGE_OF_RISING)

/* Return bounds of arccos x = pi/2 - arcsin x. */
static inline Range range_acos(Range x)
{
    return range_add(only(1.5707963267948966), range_times(only(-1.0), range_asin(x)));
}

/* Return bounds of cosh x. */
static inline Range range_cosh(Range x)
{
    const double a = cosh(x.lo), b = cosh(x.hi), least = x.lo <= 0.0 && x.hi >= 0.0 ? 1.0 : min_of(a, b);
    return apply_chain_rule(x, least, max_of(a, b), sinh(x.lo), sinh(x.hi));
}

/* Return bounds of the angle of (x, y); [-pi, pi] with unbounded slope where it may jump or is undefined. */
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
    double down, up;
    product_bounds(by_x.lo, by_x.hi, y.down, y.up, &z.down, &z.up);
    product_bounds(by_y.lo, by_y.hi, x.down, x.up, &down, &up);
    z.down -= up;
    z.up -= down;
    return z;
}

/*
 * Return bounds of mod(a, b) = a - k b. branch: 0, or the frozen branch of the periods (1: even k, -1: odd k), which
 * extends by half of the neighbouring periods. If more than one period is possible, the whole period is returned.
 */
static inline Range range_mod_on(Range a, Range b, Range branch)
{
    const Range x = range_times(a, range_inverse(b));
    const double held = branch.lo == branch.hi ? branch.lo : 0.0, odd = held < 0.0 ? 1.0 : 0.0;
    const double every = held == 0.0 ? 1.0 : 2.0, before = held == 0.0 ? 0.0 : 0.5;
    const double first = every * floor((x.lo + before - odd) / every) + odd;
    const double last = every * floor((x.hi + before - odd) / every) + odd;
    if (is_empty(x))
        return x;
    if (first == last)
        return range_add(a, range_times(only(-first), b));
    Range y = range_times((Range){-before, 1.0 + before, 0.0, 0.0, x.partly}, b);
    y.down = -INFINITY;
    y.up = INFINITY;
    return y;
}

/* Return bounds of mod(a, b) without a frozen branch. */
static inline Range range_mod_of(Range a, Range b) { return range_mod_on(a, b, only(0.0)); }

/* Return whether first + 2 n is in [lo, hi] for an integer n. */
static inline int has_point(double lo, double hi, double first)
{
    return !(hi - lo < 2.0) || floor(0.5 * (hi - first)) >= ceil(0.5 * (lo - first));
}

/*
 * Return the derivative of period_branch(x, 1): 4 where an even period begins, -4 where an odd one does, linear
 * between.
 */
static inline double period_slope(double x)
{
    const double rest = mod_of(x, 2.0);
    return rest < 1.0 ? 4.0 - 8.0 * rest : 8.0 * rest - 12.0;
}

/*
 * Return bounds of period_branch(a, b), the function that is positive in even periods of a/b and negative in odd ones.
 */
static inline Range range_period_branch(Range a, Range b)
{
    const Range x = range_times(a, range_inverse(b));
    if (is_empty(x))
        return x;
    const double from = period_branch(x.lo, 1.0), to = period_branch(x.hi, 1.0);
    const double rise = period_slope(x.lo), fall = period_slope(x.hi);
    return apply_chain_rule(x, has_point(x.lo, x.hi, 1.5) ? -1.0 : min_of(from, to),
        has_point(x.lo, x.hi, 0.5) ? 1.0 : max_of(from, to), has_point(x.lo, x.hi, 1.0) ? -4.0 : min_of(rise, fall),
        has_point(x.lo, x.hi, 0.0) ? 4.0 : max_of(rise, fall));
}

/*
 * Return bounds of the branch of switching function k (1 or -1): the frozen one, or by the sign of its values g if
 * `branch` is NULL.
 */
static inline Range range_branch(const double *branch, int k, Range g)
{
    const double least = g.lo < 0.0 ? -1.0 : g.lo > 0.0 ? 1.0 : 0.0, most = g.hi > 0.0 ? 1.0 : g.hi < 0.0 ? -1.0 : 0.0;
    const double slope = least < most ? INFINITY : 0.0;
    return branch ? only(branch[k]) : (Range){least, most, -slope, slope, g.partly};
}

/* Return the bounds of the active expression: b on the negative branch, a on the other one, or of both. */
static inline Range range_pick(Range branch, Range a, Range b)
{
    return branch.hi < 0.0 ? b : branch.lo >= 0.0 ? a : range_union(a, b);
}

/* Return bounds of max(x, y). */
static inline Range range_max_of(Range x, Range y)
{
    return x.lo >= y.hi ? x : y.lo >= x.hi ? y : (Range){max_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.down, y.down),
        max_of(x.up, y.up), x.partly | y.partly};
}

/* Return bounds of min(x, y). */
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
/* Return bounds of Heaviside's function: 1 for x >= 0, else 0. */
static inline Range range_heaviside(Range x)
{
    return range_pick(range_sign_of(x), only(1.0), only(0.0));
}

#endif
