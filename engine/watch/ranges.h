/*
 * Ranges: the bounds within which an expression stays while its arguments stay within theirs, and those of its slope
 * along a step, whose whole length is the unit. Interval arithmetic with first derivatives: R. E. Moore,
 * R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (2009), chapters 5 and 6; roundings are not counted.
 */
#ifndef GUDGEON_RANGES_H
#define GUDGEON_RANGES_H
#include "../scene/function_table.h"

typedef struct {
    double lo, hi;   /* NaN: no number anywhere */
    double down, up; /* least and largest slope */
    int partly;      /* it may be no number somewhere */
} Range;

static inline Range only(double x) { return (Range){x, x, 0.0, 0.0, 0}; }
static inline int is_empty(Range x) { return !(x.lo <= x.hi); }

static inline Range range_negative(Range x) { return (Range){-x.hi, -x.lo, -x.up, -x.down, x.partly}; }

/* Zero times a bound that is infinite is zero. */
static inline double scaled(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; }

/* Bounds of x y for x in [a, b] and y in [c, d]; NaN stays. */
static inline void product_bounds(double a, double b, double c, double d, double *lo, double *hi)
{
    const double ac = scaled(a, c), ad = scaled(a, d), bc = scaled(b, c), bd = scaled(b, d);
    *lo = min_of(min_of(ac, ad), min_of(bc, bd));
    *hi = max_of(max_of(ac, ad), max_of(bc, bd));
}

/* What goes through [lo, hi], with its derivative by x in [least, most]. */
static inline Range through(Range x, double lo, double hi, double least, double most)
{
    Range y = {lo, hi, 0.0, 0.0, x.partly};
    product_bounds(least, most, x.down, x.up, &y.down, &y.up);
    return y;
}

/* One of both. */
static inline Range range_union(Range x, Range y)
{
    if (is_empty(x) || is_empty(y))
        return is_empty(x) ? y : x;
    return (Range){min_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.down, y.down), max_of(x.up, y.up),
        x.partly | y.partly};
}

static inline Range range_add(Range x, Range y)
{
    return (Range){x.lo + y.lo, x.hi + y.hi, x.down + y.down, x.up + y.up, x.partly | y.partly};
}

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

/* x^n for an integer n, a pole at zero where n is negative. */
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
    return through(x, zero && even ? 0.0 : min_of(a, b), max_of(a, b), least, most);
}

static inline Range range_inverse(Range x) { return range_power_of(x, -1.0); }
static inline Range range_square(Range x) { return range_power_of(x, 2.0); }

static inline Range range_exp(Range x)
{
    const double a = exp(x.lo), b = exp(x.hi);
    return through(x, a, b, a, b);
}

static inline Range range_log(Range x)
{
    if (!(x.hi > 0.0))
        return only(NAN);
    Range y = through(x, log(max_of(x.lo, 0.0)), log(x.hi), 1.0 / x.hi, 1.0 / max_of(x.lo, 0.0));
    y.partly |= x.lo < 0.0;
    return y;
}

/* x^c for a c that is no integer: no number below zero. */
static inline Range range_broken_power(Range x, double c)
{
    if (!(x.hi >= 0.0))
        return only(NAN);
    const double low = max_of(x.lo, 0.0), a = pow(low, c), b = pow(x.hi, c);
    const double slope_a = c * pow(low, c - 1.0), slope_b = c * pow(x.hi, c - 1.0);
    Range y = through(x, min_of(a, b), max_of(a, b), min_of(slope_a, slope_b), max_of(slope_a, slope_b));
    y.partly |= x.lo < 0.0;
    return y;
}

static inline Range range_sqrt(Range x) { return range_broken_power(x, 0.5); }

static inline Range range_pow(Range x, Range c)
{
    if (c.lo == c.hi && c.down == 0.0 && c.up == 0.0)
        return c.lo == rint(c.lo) ? range_power_of(x, c.lo) : range_broken_power(x, c.lo);
    return range_exp(range_times(c, range_log(x)));
}

/* Bounds of sin(x + quarter) over [lo, hi]. */
static inline void sine_bounds(double lo, double hi, double quarter, double *least, double *most)
{
    const double turn = 6.283185307179586, right = 1.5707963267948966, a = sin(lo + quarter), b = sin(hi + quarter);
    *most = floor((hi + quarter - right) / turn) >= ceil((lo + quarter - right) / turn) ? 1.0 : max_of(a, b);
    *least = floor((hi + quarter + right) / turn) >= ceil((lo + quarter + right) / turn) ? -1.0 : min_of(a, b);
    if (!(hi - lo < turn) && !isnan(hi - lo))
        *least = -1.0, *most = 1.0;
}

static inline Range range_turned(Range x, double quarter)
{
    double lo, hi, least, most;
    sine_bounds(x.lo, x.hi, quarter, &lo, &hi);
    sine_bounds(x.lo, x.hi, quarter + 1.5707963267948966, &least, &most);
    return through(x, lo, hi, least, most);
}

static inline Range range_sin(Range x) { return range_turned(x, 0.0); }
static inline Range range_cos(Range x) { return range_turned(x, 1.5707963267948966); }
static inline Range range_tan(Range x) { return range_times(range_sin(x), range_inverse(range_cos(x))); }

/* The part of x in a domain. */
static inline Range range_within(Range x, double from, double to)
{
    if (from == -INFINITY && to == INFINITY)
        return x;
    if (!(x.lo <= to && x.hi >= from))
        return only(NAN);
    return (Range){max_of(x.lo, from), min_of(x.hi, to), x.down, x.up, x.partly || x.lo < from || x.hi > to};
}

/* The slope is least and largest at the ends, or at its extremum. */
#define RANGE_OF_RISING(name, from, to, extremum, slope) \
    static inline double slope_of_##name(double x) { return slope; } \
    static inline Range range_##name(Range all) \
    { \
        const Range x = range_within(all, from, to); \
        const double a = slope_of_##name(x.lo), b = slope_of_##name(x.hi); \
        const double inner = x.lo <= extremum && x.hi >= extremum ? slope_of_##name(extremum) : a; \
        return through(x, name(x.lo), name(x.hi), min_of(inner, min_of(a, b)), max_of(inner, max_of(a, b))); \
    }
RISING_FUNCTIONS(RANGE_OF_RISING)

static inline Range range_acos(Range x)
{
    return range_add(only(1.5707963267948966), range_times(only(-1.0), range_asin(x)));
}

static inline Range range_cosh(Range x)
{
    const double a = cosh(x.lo), b = cosh(x.hi), least = x.lo <= 0.0 && x.hi >= 0.0 ? 1.0 : min_of(a, b);
    return through(x, least, max_of(a, b), sinh(x.lo), sinh(x.hi));
}

/* The angle of (x, y); all of them where that turns from -pi to pi, or has no direction. */
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
 * mod(a, b): between the ends of a period a - k b; on a side the periods of that side alone, half of their neighbours
 * with them. Of more than one period what any of them may be.
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

static inline Range range_mod_of(Range a, Range b) { return range_mod_on(a, b, only(0.0)); }

/* Whether first + 2 n is in [lo, hi] for a whole n. */
static inline int has_place(double lo, double hi, double first)
{
    return !(hi - lo < 2.0) || floor(0.5 * (hi - first)) >= ceil(0.5 * (lo - first));
}

/* Its slope is 4 where a period of even number begins, -4 where one of odd number does, and linear between. */
static inline double period_slope(double x)
{
    const double rest = mod_of(x, 2.0);
    return rest < 1.0 ? 4.0 - 8.0 * rest : 8.0 * rest - 12.0;
}

static inline Range range_period_branch(Range a, Range b)
{
    const Range x = range_times(a, range_inverse(b));
    if (is_empty(x))
        return x;
    const double from = period_branch(x.lo, 1.0), to = period_branch(x.hi, 1.0);
    const double rise = period_slope(x.lo), fall = period_slope(x.hi);
    return through(x, has_place(x.lo, x.hi, 1.5) ? -1.0 : min_of(from, to),
        has_place(x.lo, x.hi, 0.5) ? 1.0 : max_of(from, to), has_place(x.lo, x.hi, 1.0) ? -4.0 : min_of(rise, fall),
        has_place(x.lo, x.hi, 0.0) ? 4.0 : max_of(rise, fall));
}

/* The side of a corner: as it is held, or wherever its function may be. */
static inline Range range_branch(const double *branch, int k, Range g)
{
    const double least = g.lo < 0.0 ? -1.0 : g.lo > 0.0 ? 1.0 : 0.0, most = g.hi > 0.0 ? 1.0 : g.hi < 0.0 ? -1.0 : 0.0;
    const double slope = least < most ? INFINITY : 0.0;
    return branch ? only(branch[k]) : (Range){least, most, -slope, slope, g.partly};
}

/* The second below the corner, else the first. */
static inline Range range_pick(Range branch, Range a, Range b)
{
    return branch.hi < 0.0 ? b : branch.lo >= 0.0 ? a : range_union(a, b);
}

static inline Range range_max_of(Range x, Range y)
{
    return x.lo >= y.hi ? x : y.lo >= x.hi ? y : (Range){max_of(x.lo, y.lo), max_of(x.hi, y.hi), min_of(x.down, y.down),
        max_of(x.up, y.up), x.partly | y.partly};
}

static inline Range range_min_of(Range x, Range y)
{
    return range_times(only(-1.0), range_max_of(range_times(only(-1.0), x), range_times(only(-1.0), y)));
}

static inline Range range_fabs(Range x) { return range_max_of(x, range_times(only(-1.0), x)); }
static inline Range range_sign_of(Range x) { return range_branch(NULL, 0, x); }
static inline Range range_magnitude(Range x) { return range_add(range_fabs(x), only(1e-150)); }
static inline Range range_heaviside(Range x)
{
    return range_pick(range_sign_of(x), only(1.0), only(0.0));
}

#endif
