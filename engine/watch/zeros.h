/*
 * Root finding: zeros of event functions along an interval. This file does not depend on a run, a step or a method.
 * Steps (roots.c, watched.c) and kinematic motions (kinematic/events.c) pass their functions.
 *
 * Arguments, which mean the same everywhere:
 *   s         location in the interval: a fraction of a step, or a time in s, as the caller chooses; finite.
 *   f         value of an event function times its branch, in any unit: f >= 0 before the event, f < 0 after it.
 *   slope     df/ds; NAN: not known.
 *   width     in s: locations nearer than that are the same. 0: neighbouring floating-point numbers.
 *   context   of the caller, passed to its functions; no function here reads or stores it.
 * All memory belongs to the caller. A status is 0, or the value with which a function of the caller ended the search.
 *
 *   locate_zero    narrows a bracket until it is at most `width` wide.
 *   bisect_interval  halves an interval until bounds decide, its first part first: finds zeros of odd order, and pairs
 *                  of them (grazes) however near; a zero of even order changes no sign and is not an event.
 *   classify_zero  decides by bounds and two values: a zero, none, or to be halved.
 *   is_near_pole   distinguishes poles, at which a sign changes as well, from zeros.
 *
 * Guarantees: a bracket with f >= 0 at its lower end and f < 0 at its upper end remains one, whatever f does between.
 * From the FAST_EVALUATIONS-th one on, three evaluations at least halve it. bisect_interval misses no zero of a
 * function whose bounds hold, if parts are wider than `width` and no more than MAX_BISECTED_PARTS are needed.
 */
#ifndef GUDGEON_ZEROS_H
#define GUDGEON_ZEROS_H
#include "ranges.h"

enum {
    FAST_EVALUATIONS = 6,   /* evaluations that usually locate a zero */
    MAX_POINTS = 4,         /* samples through which a zero is interpolated */
    MAX_PART_HALVINGS = 64, /* halvings of an interval */
    MAX_BISECTED_PARTS = 2000
};
#define MIN_THIRD_DISTANCE 1e-4 /* of a bracket: a third point nearer to an end shows rounding only */
#define NARROWING_WIDTH 0.13 /* of an interval: longer parts do not show whether bounds narrow */
#define POLE_DISTANCE 64.0  /* event tolerances after a change of sign, at which its function is compared */
#define ACCUMULATED_ULPS 1024.0    /* ulp: accumulated rounding error of a coordinate or a velocity */
#define CLOSING_STEPS 16.0           /* error of a state, in remaining Newton steps of the closures */

/* A sample of an event function: location s, value f and slope df/ds there. */
typedef struct {
    double s, f, slope;
} Sample;

/* The bracket of a zero and other samples near it, nearest first. Less accurate ones may serve for the first guess. */
typedef struct {
    Sample at[MAX_POINTS]; /* low: f >= 0, high: f < 0, others */
    int n;                 /* number of known samples, at least 2 */
} Bracket;

/*
 * The tolerance of a location: `width`, or a sample after the zero with f < 0 at a distance d <= max_overshoot. Its
 * error must be small: error_factor |df/ds| d^2 <= max_error, in any common unit. max_overshoot = 0: `width` only.
 */
typedef struct {
    double width, max_overshoot, max_error, error_factor;
} ZeroTolerance;

/* Evaluate f and slope of `now` at s, which lies within the bracket. Return a status. */
typedef int EvaluateEventFunction(void *context, double s, Sample *now);

/*
 * Classify the part from a to b. Return 1 if the search ends in it, 0 if the next part follows, which begins at b, and
 * -1 if it is to be halved: its first half follows, then its second half. A `small` part is never halved.
 */
typedef int ClassifySubinterval(void *context, double a, double b, int small);

/*
 * Return the location at f = 0 of the polynomial s(f) through n samples of different f, at most MAX_POINTS (inverse
 * interpolation, Neville's scheme).
 */
static inline double find_zero_by_inverse_interpolation(const Sample *samples, int n)
{
    double estimate[MAX_POINTS];
    for (int i = 0; i < n; i++)
        estimate[i] = samples[i].s;
    for (int m = 1; m < n; m++)
        for (int i = 0; i + m < n; i++)
            estimate[i] = (samples[i].f * estimate[i + 1] - samples[i + m].f * estimate[i]) / (samples[i].f
                - samples[i + m].f);
    return estimate[0];
}

/*
 * Return the location of a zero, between both ends of a bracket, of the cubic that has their values and slopes. If the
 * third sample is finite and far enough from both ends, use the polynomial of degree 4 that has its value as well.
 * Newton's method with bisection.
 */
static inline double find_hermite_zero(Sample low, Sample high, Sample third_sample)
{
    const double w = high.s - low.s, a = low.f, b = high.f - a, slope_low = w * low.slope, slope_high = w * high.slope;
    const double c = 3.0 * b - 2.0 * slope_low - slope_high, d = slope_low + slope_high - 2.0 * b,
        x = (third_sample.s - low.s) / w, v = (1.0 - x) * x;
    const double difference = third_sample.f - (a + x * (slope_low + x * (c + x * d))); /* than the cubic there */
    const double e = isfinite(third_sample.f) && fabs(v) > MIN_THIRD_DISTANCE ? difference / (v * v) : 0.0;
    double left = 0.0, right = 1.0, u = -a / b;
    for (int i = 0; i < 60 && right - left > DBL_EPSILON; i++) {
        const double back = 1.0 - u, bend = u * back;
        const double f = a + u * (slope_low + u * (c + u * d)) + e * bend * bend;
        const double f_u = slope_low + u * (2.0 * c + 3.0 * u * d) + 2.0 * e * bend * (back - u), before = u;
        if (f >= 0.0)
            left = u;
        else
            right = u;
        u -= f / f_u;
        if (!(u > left && u < right))
            u = 0.5 * (left + right);
        if (fabs(u - before) < 1e-5) /* Newton's next step is its square */
            break;
    }
    return low.s + w * u;
}

/*
 * Return the estimated location of the zero of a bracket: by a Hermite polynomial if both slopes are known, else by
 * inverse interpolation through at most n_points of its samples. It may lie outside of the bracket.
 */
static inline double estimate_zero(const Bracket *bracket, int n_points)
{
    const Sample low = bracket->at[0], high = bracket->at[1];
    if (isfinite(low.f + low.slope + high.f + high.slope))
        return find_hermite_zero(low, high, bracket->n > 2 ? bracket->at[2] : (Sample){NAN, NAN, NAN});
    return find_zero_by_inverse_interpolation(bracket->at, bracket->n < n_points ? bracket->n : n_points);
}

/* Return `guess` if it lies strictly within the bracket, else the middle of the bracket, also for NaN. */
static inline double clamp_to_bracket(double guess, const Bracket *bracket)
{
    const double low = bracket->at[0].s, high = bracket->at[1].s;
    return guess > low && guess < high ? guess : 0.5 * (low + high);
}

/*
 * Return the largest distance after the zero, estimated at `guess`, at which it may be located within the tolerance. It
 * follows from error_factor |df/ds| d^2 <= max_error, with the steepest slope from there to the known samples. 0 if the
 * tolerance allows no distance.
 */
static inline double compute_allowed_overshoot(const Bracket *bracket, const ZeroTolerance *tolerance, double guess)
{
    const double location = clamp_to_bracket(guess, bracket);
    double largest_slope = 0.0;
    for (int i = 0; i < bracket->n && tolerance->max_overshoot > 0.0; i++)
        largest_slope = max_of(largest_slope, fabs(bracket->at[i].f / (bracket->at[i].s - location)));
    return min_of(tolerance->max_overshoot, sqrt(tolerance->max_error / (tolerance->error_factor * largest_slope)));
}

/*
 * Locate the zero of a bracket to a tolerance, by zeros of interpolants, and by bisection if they do not halve the
 * bracket. evaluate(context, s, &sample): the function; guess: the first location to evaluate, NAN: the middle.
 * n_points: number of samples for inverse interpolation; 2 for a function of which only the sign is known. The bracket
 * is narrowed; its upper end, with f < 0, is the location. Return 0, or the status with which `evaluate` ended the
 * search.
 */
static inline int locate_zero(EvaluateEventFunction *evaluate, void *context, const ZeroTolerance *tolerance,
    int n_points,
    double guess, Bracket *bracket)
{
    double width = INFINITY, width_before = INFINITY;
    for (int i = 0;; i++) {
        const double low = bracket->at[0].s, high = bracket->at[1].s;
        double s = i ? estimate_zero(bracket, n_points) : guess;
        const double distance = compute_allowed_overshoot(bracket, tolerance, s),
            min_distance = max_of(distance, tolerance->width);
        if (!(high - low > min_distance))
            return 0;
        if (!(s > low && s < high) || (i >= FAST_EVALUATIONS && high - low > 0.5 * width_before))
            s = 0.5 * (low + high);
        else if (s - low < 2.0 * min_distance)
            s = min_of(low + 0.9 * (high - low), s + 0.75 * min_distance);
        else if (distance > 0.0)
            s += min_of(0.5 * distance, 0.9 * (high - s));
        else if (high - s < 2.0 * min_distance)
            s = max_of(high - 0.9 * (high - low), s - 0.75 * min_distance);
        if (!(s > low && s < high))
            return 0; /* nothing lies between */
        width_before = width;
        width = high - low;
        Sample sample = {s, NAN, NAN};
        const int status = evaluate(context, s, &sample), replaced = sample.f >= 0.0 ? 0 : 1;
        if (status)
            return status;
        /* df/ds there, or the mean slope from the bracket's lower end to there */
        const double slope = isfinite(sample.slope) ? sample.slope : (sample.f - bracket->at[0].f) / (s - low);
        const int is_located = sample.f < 0.0 && sample.f >= slope * distance;
        bracket->n = bracket->n < MAX_POINTS ? bracket->n + 1 : MAX_POINTS;
        bracket->at[3] = bracket->at[2];
        bracket->at[2] = bracket->at[replaced];
        bracket->at[replaced] = sample;
        if (is_located)
            return 0;
    }
}

/*
 * Classify the parts of an interval from `begin` to `end` in order, by bisection: classify(context, begin, end,
 * is_small) returns 1, 0 or -1 (ClassifySubinterval). Parts of at most `width`, beyond MAX_PART_HALVINGS halvings or
 * MAX_BISECTED_PARTS parts are small: they are not halved. Return 1 if a part ends the search, else 0.
 */
static inline int bisect_interval(double begin, double end, double width, ClassifySubinterval *classify, void *context)
{
    double ends[MAX_PART_HALVINGS + 2] = {end};
    for (int n_ends = 1, n_parts = 0; n_ends > 0;) {
        const double middle = begin + 0.5 * (ends[n_ends - 1] - begin);
        const int is_small = ends[n_ends - 1] - begin <= width || n_ends > MAX_PART_HALVINGS
            || ++n_parts > MAX_BISECTED_PARTS
            || !(begin < middle && middle < ends[n_ends - 1]);
        const int result = classify(context, begin, ends[n_ends - 1], is_small);
        if (result > 0)
            return 1;
        if (result < 0)
            ends[n_ends++] = middle;
        else
            begin = ends[--n_ends];
    }
    return 0;
}

/*
 * Decide by bounds whether a function has a zero in a part. bounds: of its values and slopes; value_begin, value_end:
 * values at both ends; width: length of the part in the unit of the slopes. Return 1 if it is negative at the end and
 * not before, 0 if it is negative nowhere, -1 if that is not known (never if is_small). Bounds contain rounding errors:
 * the sign computed at the end has priority.
 */
static inline int classify_zero(Interval bounds, double value_begin, double value_end, double width, int is_small)
{
    if (is_empty(bounds) || (bounds.lo >= 0.0 && !(value_end < 0.0)))
        return 0;
    if (is_small)
        return value_end < 0.0;
    if (bounds.may_be_undefined)
        return -1;
    if (bounds.min_slope >= 0.0 || bounds.max_slope <= 0.0)
        return value_end < 0.0;
    /* the lowest that a function of these slopes between these ends may reach */
    const double lowest = value_begin + bounds.min_slope
        * (value_end - value_begin - bounds.max_slope * width) / (bounds.min_slope - bounds.max_slope);
    return value_begin >= 0.0 && value_end >= 0.0 && lowest >= 0.0 ? 0 : -1;
}

/*
 * Return whether a lower bound over a fraction `width` of an interval is negative only because interval arithmetic
 * overestimates. It is if the bound has narrowed in proportion to the part (within a factor 4), as for a function
 * without a zero. lower_bound_of_interval: the lower bound over the whole interval. Parts longer than NARROWING_WIDTH
 * return 0.
 */
static inline int is_bound_narrowing(double lower_bound, double width, double lower_bound_of_interval)
{
    return width <= NARROWING_WIDTH && lower_bound >= 4.0 * width * lower_bound_of_interval;
}

/*
 * Return whether a change of sign is at a pole: the function is infinite there, or more than twice as large as at
 * value_beyond, POLE_DISTANCE event tolerances later.
 */
static inline int is_near_pole(double value_at_change, double value_beyond)
{
    return isinf(value_at_change) || fabs(value_at_change) > 2.0 * fabs(value_beyond);
}

/*
 * Return whether a user-defined event function has crossed zero to `value` in its event direction. *sign: the last sign
 * of the function (1 or -1; 0: none yet), updated. A value of zero keeps the sign; a first sign is not an event.
 */
static inline int detect_event_crossing(int event, signed char *sign, double value)
{
    const int sign_before = *sign, sign_now = (value > 0.0) - (value < 0.0);
    if (sign_now)
        *sign = (signed char)sign_now;
    return sign_before * sign_now < 0 && event_direction[event] * sign_now >= 0;
}

#if N_MONITORED && KNOWN_BOUNDS
/*
 * Estimate by how much errors of positions and velocities (q_error, v_error, n_coordinates each) change each monitored
 * function: uncertainty (N_MONITORED), half widths of its bounds over the box of these errors. 0 where the bounds are
 * infinite, at a pole. The time has an error of 4 ulp.
 */
static inline void estimate_error_by_bounds(double t, const double *q, const double *v, const double *q_error,
    const double *v_error, int n_coordinates, const DiscreteState *discrete, const Parameters *p, double *uncertainty)
{
    Interval q_bounds[N_Q + N_X], v_bounds[N_Q + N_X], bounds[N_MONITORED];
    const double t_error = 4.0 * DBL_EPSILON * fabs(t);
    for (int k = 0; k < n_coordinates; k++) {
        q_bounds[k] = (Interval){q[k] - q_error[k], q[k] + q_error[k], 0.0, 0.0, 0};
        v_bounds[k] = (Interval){v[k] - v_error[k], v[k] + v_error[k], 0.0, 0.0, 0};
    }
    bound_monitored_functions(
        (Interval){t - t_error, t + t_error, 0.0, 0.0, 0}, q_bounds, v_bounds, discrete, p, bounds);
    for (int i = 0; i < N_MONITORED; i++)
        uncertainty[i] = isfinite(bounds[i].hi - bounds[i].lo) ? 0.5 * (bounds[i].hi - bounds[i].lo) : 0.0;
}
#endif

#endif
