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
 *   halve_parts     halves an interval until bounds decide, its first part first: finds zeros of odd order, and pairs
 *                  of them (grazes) however near; a zero of even order changes no sign and is not an event.
 *   zero_verdict   decides by bounds and two values: a zero, none, or to be halved.
 *   is_near_pole   distinguishes poles, at which a sign changes as well, from zeros.
 *
 * Guarantees: a bracket with f >= 0 at its lower end and f < 0 at its upper end remains one, whatever f does between.
 * From the FAST_EVALUATIONS-th one on, three evaluations at least halve it. halve_parts misses no zero of a function
 * whose bounds hold, if parts are wider than `width` and no more than MAX_PARTS_SEEN are needed.
 */
#ifndef GUDGEON_ZEROS_H
#define GUDGEON_ZEROS_H
#include "ranges.h"

enum {
    FAST_EVALUATIONS = 6, /* evaluations that usually locate a zero */
    MAX_POINTS = 4,      /* samples through which a zero is interpolated */
    DEEPEST = 64,         /* halvings of an interval */
    MAX_PARTS_SEEN = 2000
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
 * The tolerance of a location: `width`, or a sample after the zero with f < 0 at a distance d <= beyond whose error is
 * small: harm |df/ds| d^2 <= harmless, in any common unit. beyond = 0: `width` only.
 */
typedef struct {
    double width, beyond, harmless, harm;
} ZeroTolerance;

/* Evaluate f and slope of `now` at s, which lies within the bracket. Return a status. */
typedef int EvaluateEventFunction(void *context, double s, Sample *now);

/*
 * Classify the part from a to b. Return 1 if the search ends in it, 0 if the next part follows, which begins at b, and
 * -1 if it is to be halved: its first half follows, then its second half. A `small` part is never halved.
 */
typedef int ClassifyPart(void *context, double a, double b, int small);

/*
 * Return s at f = 0 of the polynomial s(f) through n samples of different f (inverse interpolation, Neville's scheme).
 */
static inline double inverse_zero(const Sample *place, int n)
{
    double s[MAX_POINTS];
    for (int i = 0; i < n; i++)
        s[i] = place[i].s;
    for (int m = 1; m < n; m++)
        for (int i = 0; i + m < n; i++)
            s[i] = (place[i].f * s[i + 1] - place[i + m].f * s[i]) / (place[i].f - place[i + m].f);
    return s[0];
}

/*
 * Return a zero, between both ends of a bracket, of the cubic that has their values and slopes. If a third sample is
 * finite and far enough from both ends, use the polynomial of degree 4 that has its value as well.
 */
static inline double hermite_zero(Sample low, Sample high, Sample third)
{
    const double w = high.s - low.s, a = low.f, b = high.f - a, r = w * low.slope, r_end = w * high.slope;
    const double c = 3.0 * b - 2.0 * r - r_end, d = r + r_end - 2.0 * b, x = (third.s - low.s) / w, v = (1.0 - x) * x;
    const double less = third.f - (a + x * (r + x * (c + x * d))); /* than the cubic there */
    const double e = isfinite(third.f) && fabs(v) > MIN_THIRD_DISTANCE ? less / (v * v) : 0.0;
    double from = 0.0, to = 1.0, u = -a / b;
    for (int i = 0; i < 60 && to - from > DBL_EPSILON; i++) {
        const double back = 1.0 - u, bend = u * back;
        const double f = a + u * (r + u * (c + u * d)) + e * bend * bend;
        const double f_u = r + u * (2.0 * c + 3.0 * u * d) + 2.0 * e * bend * (back - u), before = u;
        if (f >= 0.0)
            from = u;
        else
            to = u;
        u -= f / f_u;
        if (!(u > from && u < to))
            u = 0.5 * (from + to);
        if (fabs(u - before) < 1e-5) /* Newton's next step is its square */
            break;
    }
    return low.s + w * u;
}

/*
 * Return the estimated location of the zero of a bracket: by a Hermite polynomial if slopes are known, else by inverse
 * interpolation through at most `n_points` samples.
 */
static inline double guess_zero(const Bracket *of, int n_points)
{
    const Sample low = of->at[0], high = of->at[1];
    if (isfinite(low.f + low.slope + high.f + high.slope))
        return hermite_zero(low, high, of->n > 2 ? of->at[2] : (Sample){NAN, NAN, NAN});
    return inverse_zero(of->at, of->n < n_points ? of->n : n_points);
}

/* Return a guess of the zero if it lies within the bracket, else the middle of the bracket. */
static inline double clamp_to_bracket(double guess, const Bracket *of)
{
    const double low = of->at[0].s, high = of->at[1].s;
    return guess > low && guess < high ? guess : 0.5 * (low + high);
}

/*
 * Return the largest allowed distance of the location after the zero, which is near `about`. The slope of the function
 * is estimated as the steepest one from there to the known samples.
 */
static inline double distance_beyond(const Bracket *of, const ZeroTolerance *near, double about)
{
    const double s = clamp_to_bracket(about, of);
    double falls = 0.0;
    for (int i = 0; i < of->n && near->beyond > 0.0; i++)
        falls = max_of(falls, fabs(of->at[i].f / (of->at[i].s - s)));
    return min_of(near->beyond, sqrt(near->harmless / (near->harm * falls)));
}

/*
 * Locate the zero of a bracket to a tolerance, by zeros of interpolants, and by bisection if they do not halve the
 * bracket. guess: the first location to evaluate; NAN: the middle. n_points: number of samples for inverse
 * interpolation; 2 for a function of which only the sign is known. `of` is narrowed; its upper end, with f < 0, is the
 * location. Returns a status.
 */
static inline int locate_zero(EvaluateEventFunction *evaluate, void *context, const ZeroTolerance *near, int n_points,
    double guess, Bracket *of)
{
    double width = INFINITY, before = INFINITY;
    for (int i = 0;; i++) {
        const double from = of->at[0].s, to = of->at[1].s;
        double s = i ? guess_zero(of, n_points) : guess;
        const double distance = distance_beyond(of, near, s), close = max_of(distance, near->width);
        if (!(to - from > close))
            return 0;
        if (!(s > from && s < to) || (i >= FAST_EVALUATIONS && to - from > 0.5 * before))
            s = 0.5 * (from + to);
        else if (s - from < 2.0 * close)
            s = min_of(from + 0.9 * (to - from), s + 0.75 * close);
        else if (distance > 0.0)
            s += min_of(0.5 * distance, 0.9 * (to - s));
        else if (to - s < 2.0 * close)
            s = max_of(to - 0.9 * (to - from), s - 0.75 * close);
        if (!(s > from && s < to))
            return 0; /* nothing lies between */
        before = width;
        width = to - from;
        Sample now = {s, NAN, NAN};
        const int status = evaluate(context, s, &now), end = now.f >= 0.0 ? 0 : 1;
        if (status)
            return status;
        /* df/ds there, or the mean slope from the bracket's lower end to there */
        const double slope = isfinite(now.slope) ? now.slope : (now.f - of->at[0].f) / (s - from);
        const int reached = now.f < 0.0 && now.f >= slope * distance;
        of->n = of->n < MAX_POINTS ? of->n + 1 : MAX_POINTS;
        of->at[3] = of->at[2];
        of->at[2] = of->at[end];
        of->at[end] = now;
        if (reached)
            return 0;
    }
}

/* Classify the parts of an interval from a to b in order, by bisection. Return 1 if a part ends the search, else 0. */
static inline int halve_parts(double a, double b, double width, ClassifyPart *judge, void *context)
{
    double end[DEEPEST + 2] = {b};
    for (int n = 1, seen = 0; n > 0;) {
        const double middle = a + 0.5 * (end[n - 1] - a);
        const int small = end[n - 1] - a <= width || n > DEEPEST || ++seen > MAX_PARTS_SEEN
            || !(a < middle && middle < end[n - 1]);
        const int result = judge(context, a, end[n - 1], small);
        if (result > 0)
            return 1;
        if (result < 0)
            end[n++] = middle;
        else
            a = end[--n];
    }
    return 0;
}

/*
 * Decide by bounds whether a function has a zero in a part. f: bounds of its values and slopes; at_a, at_b: values at
 * both ends; width: length of the part in the unit of the slopes. Return 1 if it is negative at the end and not before,
 * 0 if it is negative nowhere, -1 if that is not known (never for a `small` part). Bounds contain rounding errors: the
 * sign computed at the end has priority.
 */
static inline int zero_verdict(Range f, double at_a, double at_b, double width, int small)
{
    if (is_empty(f) || (f.lo >= 0.0 && !(at_b < 0.0)))
        return 0;
    if (small)
        return at_b < 0.0;
    if (f.partly)
        return -1;
    if (f.down >= 0.0 || f.up <= 0.0)
        return at_b < 0.0;
    /* the lowest that a function of these slopes between these ends may reach */
    const double lowest = at_a + f.down * (at_b - at_a - f.up * width) / (f.down - f.up);
    return at_a >= 0.0 && at_b >= 0.0 && lowest >= 0.0 ? 0 : -1;
}

/*
 * Return whether a lower bound over a fraction `width` of an interval is negative only because interval arithmetic
 * overestimates. It is if the bound has narrowed with the part, as for a function without a zero. whole: the lower
 * bound over the whole interval.
 */
static inline int is_narrowing(double lo, double width, double whole)
{
    return width <= NARROWING_WIDTH && lo >= 4.0 * width * whole;
}

/* Return whether a change of sign is a pole: the function is larger at it than POLE_DISTANCE tolerances further on. */
static inline int is_near_pole(double here, double further) { return isinf(here) || fabs(here) > 2.0 * fabs(further); }

/*
 * Return whether user event i has crossed zero to `value` in a direction that counts. `branch`: the last sign of its
 * function (1 or -1; 0: none yet), updated. A value of zero keeps the sign.
 */
static inline int event_crosses(int i, signed char *branch, double value)
{
    const int from = *branch, to = (value > 0.0) - (value < 0.0);
    if (to)
        *branch = (signed char)to;
    return from * to < 0 && event_direction[i] * to >= 0;
}

#if N_WATCHED && KNOWN_BOUNDS
/*
 * Estimate by how much errors of n positions and velocities (q_error, v_error) change each watched function. out:
 * N_WATCHED half widths of its bounds; 0 where they include a pole.
 */
static inline void error_by_bounds(double t, const double *q, const double *v, const double *q_error,
    const double *v_error, int n, const DiscreteState *discrete, const Parameters *p, double *out)
{
    Range at_q[N_Q + N_X], at_v[N_Q + N_X], f[N_WATCHED];
    const double rounded = 4.0 * DBL_EPSILON * fabs(t);
    for (int k = 0; k < n; k++) {
        at_q[k] = (Range){q[k] - q_error[k], q[k] + q_error[k], 0.0, 0.0, 0};
        at_v[k] = (Range){v[k] - v_error[k], v[k] + v_error[k], 0.0, 0.0, 0};
    }
    watched_ranges((Range){t - rounded, t + rounded, 0.0, 0.0, 0}, at_q, at_v, discrete, p, f);
    for (int i = 0; i < N_WATCHED; i++)
        out[i] = isfinite(f[i].hi - f[i].lo) ? 0.5 * (f[i].hi - f[i].lo) : 0.0;
}
#endif

#endif
