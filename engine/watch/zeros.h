/*
 * Root finding: zeros of event functions along an interval. Nothing here knows of a run, a step or a method; steps
 * (roots.c, watched.c) and kinematic motions (kinematic/events.c) hand over their functions.
 *
 * Arguments, which mean the same everywhere:
 *   s         location in the interval: a fraction of a step, or a time in s, as the caller likes; finite.
 *   f         value of an event function times its branch, in any unit: f >= 0 before the event, f < 0 after it.
 *   slope     df/ds; NAN: not known.
 *   width     in s: closer locations are the same. 0: neighbouring numbers.
 *   context   of the caller, handed back to its functions; nothing here reads it or keeps it.
 * All memory belongs to the caller. A status is 0, or what a function of the caller returned to end the search.
 *
 *   locate_zero    narrows a bracket until it is at most `width` wide.
 *   first_part     halves an interval until bounds decide, its first part first: finds zeros of odd order, and pairs
 *                  of them (grazes) however near; a zero of even order changes no sign and is no event.
 *   zero_verdict   decides by bounds and two values: a zero, none, or to be halved.
 *   is_near_pole   tells poles, at which a sign changes as well.
 *
 * Guarantees: a bracket with f >= 0 at its lower end and f < 0 at its upper one stays so, whatever f does between, and
 * three evaluations halve it at least from the QUICK-th one on. first_part misses no zero of a function whose bounds
 * hold, as far as parts are wider than `width` and no more than MAX_PARTS_SEEN are needed.
 */
#ifndef GUDGEON_ZEROS_H
#define GUDGEON_ZEROS_H
#include "ranges.h"

enum {
    QUICK = 6,          /* evaluations by which a zero is located as a rule */
    MOST_PLACES = 4,    /* that tell where a zero is */
    DEEPEST = 64,       /* halvings of an interval */
    MAX_PARTS_SEEN = 2000
};
#define FAR_ENOUGH 1e-4     /* of a bracket, a third place from its ends: a nearer one tells of rounding */
#define ENOUGH_PARTS 0.13   /* of an interval, over which bounds tell whether they become narrower with it */
#define POLE_DISTANCE 64.0  /* widths after a located change of sign, where its function is compared */
#define ROUNDINGS 1024.0    /* ulp: rounding errors that a coordinate or a velocity collects */
#define LEFT 16.0           /* steps that close the linkage, as they are left over, that a state may be wrong by */

/* An event function at a location. */
typedef struct {
    double s, f, slope;
} Place;

/* A zero's bracket, and other places near it, nearest first. Samples of less accuracy may serve for the first guess. */
typedef struct {
    Place at[MOST_PLACES]; /* low: f >= 0, high: f < 0, others */
    int n;                 /* how many are known, at least 2 */
} Bracket;

/*
 * How near a zero is located: to `width`, or earlier at a place after it with f < 0, at a distance d <= beyond at which
 * what is wrong does no harm: harm |df/ds| d^2 <= harmless, in any common unit. beyond = 0: to `width`.
 */
typedef struct {
    double width, beyond, harmless, harm;
} ZeroTolerance;

/* Sets f and slope of `now` at s, which lies within the bracket. Returns a status. */
typedef int EvaluatePlace(void *context, double s, Place *now);

/*
 * Judges the part from a to b: 1 where the search ends in it, 0 where the next part follows, which begins at b, -1
 * where it is to be halved: its first half follows, then its second one. Not -1 if it is `small`.
 */
typedef int JudgePart(void *context, double a, double b, int small);

/* Where the polynomial s(f) through n places of different f meets f = 0 (Neville's scheme). */
static inline double inverse_zero(const Place *place, int n)
{
    double s[MOST_PLACES];
    for (int i = 0; i < n; i++)
        s[i] = place[i].s;
    for (int m = 1; m < n; m++)
        for (int i = 0; i + m < n; i++)
            s[i] = (place[i].f * s[i + 1] - place[i + m].f * s[i]) / (place[i].f - place[i + m].f);
    return s[0];
}

/*
 * A zero, between a bracket's ends, of the cubic that has their values and slopes and, where that helps, the value of a
 * third place too: of the polynomial of order 4 then.
 */
static inline double hermite_zero(Place low, Place high, Place third)
{
    const double w = high.s - low.s, a = low.f, b = high.f - a, r = w * low.slope, r_end = w * high.slope;
    const double c = 3.0 * b - 2.0 * r - r_end, d = r + r_end - 2.0 * b, x = (third.s - low.s) / w, v = (1.0 - x) * x;
    const double less = third.f - (a + x * (r + x * (c + x * d))); /* than the cubic there */
    const double e = isfinite(third.f) && fabs(v) > FAR_ENOUGH ? less / (v * v) : 0.0;
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

/* Where a polynomial through what is known has its zero; of values alone through so many places at most. */
static inline double guess_zero(const Bracket *of, int places)
{
    const Place low = of->at[0], high = of->at[1];
    if (isfinite(low.f + low.slope + high.f + high.slope))
        return hermite_zero(low, high, of->n > 2 ? of->at[2] : (Place){NAN, NAN, NAN});
    return inverse_zero(of->at, of->n < places ? of->n : places);
}

/* A guess within the bracket. */
static inline double about_where(double guess, const Bracket *of)
{
    const double low = of->at[0].s, high = of->at[1].s;
    return guess > low && guess < high ? guess : 0.5 * (low + high);
}

/*
 * How far after the zero near `about` a place may be found. Its function falls there at most as fast as towards the
 * places that are known.
 */
static inline double distance_beyond(const Bracket *of, const ZeroTolerance *near, double about)
{
    const double s = about_where(about, of);
    double falls = 0.0;
    for (int i = 0; i < of->n && near->beyond > 0.0; i++)
        falls = max_of(falls, fabs(of->at[i].f / (of->at[i].s - s)));
    return min_of(near->beyond, sqrt(near->harmless / (near->harm * falls)));
}

/*
 * Locates the zero of a bracket to a tolerance: at the zero of a polynomial through what is known, or a little after
 * it, on the other side of it once that is known so well, and in the middle where evaluations do not halve the bracket.
 * guess: the first of these zeros; NAN: the middle. places: so many tell where it is, 2: of a function with nothing but
 * a sign. `of` is narrowed; f < 0 at its upper end, where the zero is located.
 */
static inline int locate_zero(EvaluatePlace *evaluate, void *context, const ZeroTolerance *near, int places,
    double guess, Bracket *of)
{
    double width = INFINITY, before = INFINITY;
    for (int i = 0;; i++) {
        const double from = of->at[0].s, to = of->at[1].s;
        double s = i ? guess_zero(of, places) : guess;
        const double distance = distance_beyond(of, near, s), close = max_of(distance, near->width);
        if (!(to - from > close))
            return 0;
        if (!(s > from && s < to) || (i >= QUICK && to - from > 0.5 * before))
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
        Place now = {s, NAN, NAN};
        const int status = evaluate(context, s, &now), end = now.f >= 0.0 ? 0 : 1;
        if (status)
            return status;
        /* how f falls there, or from the bracket's lower end to there */
        const double slope = isfinite(now.slope) ? now.slope : (now.f - of->at[0].f) / (s - from);
        const int reached = now.f < 0.0 && now.f >= slope * distance;
        of->n = of->n < MOST_PLACES ? of->n + 1 : MOST_PLACES;
        of->at[3] = of->at[2];
        of->at[2] = of->at[end];
        of->at[end] = now;
        if (reached)
            return 0;
    }
}

/* Judges the parts of an interval from a to b in order; 1 where one ends the search, else 0. */
static inline int first_part(double a, double b, double width, JudgePart *judge, void *context)
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
 * What bounds f of an event function tell of a part whose length is `width` times the unit of its slopes, with values
 * at both ends: it is below zero at the end and not before (1), nowhere (0), or that is not known (-1; never of a small
 * part). Bounds are rounded: what is computed at the end comes first.
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
 * Whether a lower bound over a share `width` of an interval is negative only because bounds do not know how their terms
 * depend on each other: it has become narrower with the part, as that of a function does that hides nothing in it.
 * whole: the lower bound over the interval.
 */
static inline int is_narrowing(double lo, double width, double whole)
{
    return width <= ENOUGH_PARTS && lo >= 4.0 * width * whole;
}

/* Whether a sign changes at a pole: a function is larger where it does than POLE_DISTANCE widths further on. */
static inline int is_near_pole(double here, double further) { return isinf(here) || fabs(here) > 2.0 * fabs(further); }

/*
 * Whether event i of the user, seen last on `branch` of zero (1 or -1; 0: nowhere yet), has crossed to `value` in a
 * direction that counts; `branch` is where it is then. A zero itself lies on neither side.
 */
static inline int event_crosses(int i, signed char *branch, double value)
{
    const int from = *branch, to = (value > 0.0) - (value < 0.0);
    if (to)
        *branch = (signed char)to;
    return from * to < 0 && event_direction[i] * to >= 0;
}

#if N_WATCHED && KNOWN_BOUNDS
/* By how much errors of n positions and velocities change each watched function; 0 where they lead to a pole. */
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
