/*
 * Events on the way of a kinematic motion: the way is gone again step by step, a step being halved until no expression
 * turns back in its parts, by their bounds (ranges.h). Where one has changed its sign over a part, the time is found by
 * bisection with Newton's method at every time that is tried.
 */
enum { DEEPEST = 36, MAX_VIEWS = 2000 };
#define ENOUGH 0.13 /* of a step, over which bounds tell whether they become narrower with it */
#define ALIKE 1e4   /* uncertainties that bounds over a cubic may be wrong by */

#include "uncertainty.c"

/* What Python hands over: sides seen last, times and numbers of what was found, room for so many. */
typedef struct {
    signed char *side;
    double *t;
    int *event;
    long found, capacity;
    double start; /* of the run: a zero on which it begins is not crossed */
    int stop;     /* whether an event may end the run */
    unsigned char no_number[N_USER_EVENTS]; /* told to be none */
} Log;

/* A step before it is halved: its length, and how large the bounds of each expression are over it. */
typedef struct {
    double h, most[N_USER_EVENTS];
} Whole;

/* All the way to t1. */
static int follow(double t1, const Parameters *p, double reach, double extent, Place *here, long *steps)
{
    Stride stride = {reach, extent, t1 - here->t, 0};
    while (here->t < t1) {
        const int status = step_on(&stride, t1, p, here);
        if (status)
            return status;
        ++*steps;
    }
    return 0;
}

/*
 * The time between a and b at which expression i comes to the side where it is at b, or to be no number as there;
 * whether it does so at a pole.
 */
static int locate(int i, const Parameters *p, double reach, double extent, View a, const View *b, double *t, int *pole)
{
    double low = a.at.t, high = b->at.t;
    View near = *b;
    const double width = high - low, close = max_of(1e-12 * width, 4.0 * DBL_EPSILON * fabs(high));
    while (high - low > close) {
        long steps = 0;
        const double middle = low + 0.5 * (high - low);
        View mid = a;
        const int status = follow(middle, p, reach, extent, &mid.at, &steps);
        if (status)
            return status;
        look(p, &mid);
        if (isnan(b->event[i]) ? isnan(mid.event[i]) : have_same_sign(mid.event[i], b->event[i])) {
            high = middle;
            near = mid;
        } else {
            low = middle;
            a = mid;
        }
    }
    View far = a;
    long steps = 0;
    *t = high;
    *pole = follow(high + 64.0 * close, p, reach, extent, &far.at, &steps) == 0;
    look(p, &far);
    /* it grows towards the place, to values that are larger than their uncertainty */
    *pole = isinf(near.event[i])
        || (*pole && fabs(near.event[i]) > 2.0 * fabs(far.event[i]) && resolved(&near, i, 0, extent, p) != 0.0);
    return 0;
}

/* Puts an event in its place by time among those of this part of the way. */
static int note(Log *log, long first, double t, int event)
{
    long k = log->found;
    if (k == log->capacity)
        return EVENTS_FULL;
    for (; k > first && log->t[k - 1] > t; k--) {
        log->t[k] = log->t[k - 1];
        log->event[k] = log->event[k - 1];
    }
    log->t[k] = t;
    log->event[k] = event;
    log->found++;
    return 0;
}

/* All events between two places; what comes after one that ends the run is forgotten. */
static int compare(Log *log, const View *a, const View *b, const Parameters *p, double reach, double extent)
{
    const long first = log->found;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        double t;
        int pole;
        if (isnan(b->event[i]) && !log->no_number[i]) {
            log->no_number[i] = 1;
            const int lost = isnan(a->event[i]) ? 0 : locate(i, p, reach, extent, *a, b, &t, &pole);
            const int full = lost ? lost : note(log, first, isnan(a->event[i]) ? a->at.t : t, i + N_USER_EVENTS);
            if (full)
                return full;
        }
        if (!event_crosses(i, &log->side[i], resolved(b, i, log->side[i], extent, p)))
            continue;
        int status = locate(i, p, reach, extent, *a, b, &t, &pole);
        if (!status && !pole && t - log->start > 1e-12 * (b->at.t - a->at.t) + 16.0 * DBL_EPSILON * fabs(t))
            status = note(log, first, t, i);
        if (status)
            return status;
    }
    for (long k = first; k < log->found; k++)
        if (log->stop && log->event[k] < N_USER_EVENTS && event_stops[log->event[k]]) {
            log->found = k + 1;
            return EVENT_STOPS;
        }
    return 0;
}

#if KNOWN_BOUNDS
/*
 * Whether expression i is zero between two places but for rounding, as a velocity that the linkage holds at zero: it is
 * so at both, and its bounds are not far from that; or they, which do not know how its terms depend on each other,
 * become narrower with the way, as those of a function do that hides nothing in it.
 */
static int is_held(const View *a, const View *b, int i, Range f, const Whole *whole, double extent, const Parameters *p)
{
    const double part = (b->at.t - a->at.t) / whole->h, most = max_of(-f.lo, f.hi);
    double error[N_USER_EVENTS];
    uncertainty(a, extent, p, error);
    return fabs(a->event[i]) <= error[i]
        && (most <= ALIKE * error[i] || (part < ENOUGH && most <= 4.0 * part * whole->most[i]))
        && resolved(b, i, 0, extent, p) == 0.0;
}

/*
 * Whether every expression keeps its sign between two places or goes one way only: bounds over the cubic through both
 * (positions) and over its slope (velocities).
 */
static int is_plain(const View *from_view, const View *to_view, const Parameters *p, double extent, Whole *whole)
{
    const Place *a = &from_view->at, *b = &to_view->at;
    const double h = b->t - a->t;
    Range q[N_Q], v[N_Q], out[N_WATCHED];
    for (int k = 0; k < N_Q; k++) {
        const double way = b->q[k] - a->q[k], from = h * a->v[k], to = h * b->v[k];
        /* q = q0 + s from + s^2 two + s^3 three */
        const double two = 3.0 * way - 2.0 * from - to, three = from + to - 2.0 * way;
        const double end = 2.0 * two + 6.0 * three, turn = -two / (3.0 * three);
        const double top = turn > 0.0 && turn < 1.0 ? from + turn * (2.0 * two + 3.0 * turn * three) : from;
        const double least = min_of(top, min_of(from, to)), most = max_of(top, max_of(from, to));
        q[k] = (Range){max_of(a->q[k] + min_of(least, 0.0), b->q[k] - max_of(most, 0.0)),
            min_of(a->q[k] + max_of(most, 0.0), b->q[k] - min_of(least, 0.0)), least, most, 0};
        v[k] = (Range){least / h, most / h, min_of(2.0 * two, end) / h, max_of(2.0 * two, end) / h, 0};
    }
    watched_ranges((Range){a->t, b->t, h, h, 0}, q, v, &(Memory){0}, p, out);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Range f = out[N_WATCHED - N_USER_EVENTS + i];
        if (whole->h == h)
            whole->most[i] = max_of(-f.lo, f.hi);
        if (!is_empty(f) && !(f.lo >= 0.0) && !(f.hi <= 0.0) && (f.partly || !(f.down >= 0.0 || f.up <= 0.0))
            && (f.partly || !is_held(from_view, to_view, i, f, whole, extent, p)))
            return 0;
    }
    return 1;
}

#endif
/* All events between two places, over parts in which no expression turns back. */
static int compare_parts(Log *log, const View *a, const View *b, const Parameters *p, double reach, double extent,
    int depth, int *left, Whole *whole)
{
#if KNOWN_BOUNDS
    if (depth < DEEPEST && --*left > 0 && !is_plain(a, b, p, extent, whole)) {
        View middle = *a;
        long steps = 0;
        const double t = a->at.t + 0.5 * (b->at.t - a->at.t);
        int status = t > a->at.t && t < b->at.t ? follow(t, p, reach, extent, &middle.at, &steps) : NEWTON_FAILED;
        if (!status) {
            look(p, &middle);
            status = compare_parts(log, a, &middle, p, reach, extent, depth + 1, left, whole);
            return status ? status : compare_parts(log, &middle, b, p, reach, extent, depth + 1, left, whole);
        }
    }
#else
    (void)depth, (void)left, (void)whole;
#endif
    return compare(log, a, b, p, reach, extent);
}

/* From one sample to the next. */
static int search(Log *log, View *here, double t1, const Parameters *p, double reach, double extent)
{
    Stride stride = {reach, extent, t1 - here->at.t, 0};
    int status = 0;
    while (!status && here->at.t < t1) {
        const View before = *here;
        status = step_on(&stride, t1, p, &here->at);
        if (!status) {
            int left = MAX_VIEWS;
            Whole whole = {.h = here->at.t - before.at.t};
            look(p, here);
            status = compare_parts(log, &before, here, p, reach, extent, 0, &left, &whole);
        }
    }
    return status;
}

/*
 * Looks through the intervals between n + 1 samples. Returns 0, EVENT_STOPS after an event that ends the run,
 * EVENTS_FULL where there was no room for those of an interval (`done` intervals are complete), or why the motion
 * could not be followed.
 */
int gudgeon_kinematic_events(void *memory, long n, const double *t, const double *parameters, const double *q,
    const double *v, double start, int stop, signed char *side, long capacity, double *at, int *event, long *found,
    long *done)
{
    Course *course = memory;
    const double reach = course->reach, extent = course->extent;
    const Parameters *p = (const Parameters *)parameters;
    Log log = {side, at, event, 0, capacity, start, stop, {0}};
    for (*done = 0; *done < n; ++*done) {
        signed char sides[N_USER_EVENTS];
        View here = {.at.asked = &course->asked};
        int status = begin_near(t[*done], q + *done * N_Q, v + *done * N_Q, reach, extent, p, &here.at);
        if (status)
            return status;
        look(p, &here);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            (void)event_crosses(i, &side[i], side[i] ? 0.0 : resolved(&here, i, 0, extent, p)); /* the first side */
            sides[i] = side[i];
        }
        *found = log.found;
        status = search(&log, &here, t[*done + 1], p, reach, extent);
        if (course->asked.stop)
            status = STOPPED; /* what was found in this interval means nothing */
        if (status == EVENTS_FULL || status == STOPPED)
            for (int i = 0; i < N_USER_EVENTS; i++)
                side[i] = sides[i];
        else
            *found = log.found;
        if (status)
            return status;
    }
    return 0;
}
