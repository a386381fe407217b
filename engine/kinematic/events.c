/*
 * Events on the way of a kinematic motion: the way is followed again step by step. Parts of a step are halved until
 * bounds of no event function leave open whether it has a zero there (watch/zeros.h). Where one has changed its sign
 * over a part, its zero is located with Newton's method at every time that is tried.
 */
#include "../watch/zeros.h"

#define SMALLEST_PART 1.5e-11 /* of a step: 36 halvings */
#define ALIKE 1e4 /* uncertainties that bounds over a cubic may be wrong by */

/* A place on the way with the values of event functions and, once it is asked for, their uncertainty. */
typedef struct {
    Position at;
    double event[N_USER_EVENTS], error[N_WATCHED];
    int has_error;
} View;

static void look(Course *course, View *view)
{
    RhsOutputs rhs = {0};
    double a[N_Q];
    (void)solve_motion(course, &view->at, a, &rhs); /* told before, where it cannot be solved */
    memcpy(view->event, rhs.event, sizeof view->event);
    view->has_error = 0;
}

#if POSITIONS_IN_TREE
enum { N_PLACE = N_X };
#define positions_of(place) ((place)->s)
#define rates_of(place) ((place)->s_rate)
#define is_turn(k) is_angle[k]

/* The step that Newton's method has left; rates that belong to the positions as they are. */
static int newton_step(Position *at, const Parameters *p, double *step)
{
    return close_step(beyond_jump(at->t), at->s, p, step, at->s_rate, &at->phi);
}
#else
enum { N_PLACE = N_Q };
#define positions_of(place) ((place)->q)
#define rates_of(place) ((place)->v)
#define is_turn(k) ((k) % 3 == 2)

static int newton_step(Position *at, const Parameters *p, double *step)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(beyond_jump(at->t), at->q, p, phi);
    const int status = project(beyond_jump(at->t), at->q, phi, p, step);
    return status ? status : velocities(beyond_jump(at->t), at->q, p, at->v);
}
#endif

/* The largest speeds, of lengths and of angles, each at least what the other one is at the size of the linkage. */
static void speeds_of(const Position *at, double extent, double *speed)
{
    speed[0] = speed[1] = 0.0;
    for (int k = 0; k < N_PLACE; k++)
        speed[is_turn(k)] = max_of(speed[is_turn(k)], fabs(rates_of(at)[k]));
    speed[0] = max_of(speed[0], extent * speed[1]);
    speed[1] = max_of(speed[1], speed[0] / extent);
}

/*
 * A place at positions that are wrong by ROUNDINGS, by signs of a mask, with the velocities that belong to them.
 * Newton's last step tells of positions near a singular one, where rounding counts for more.
 */
static void disturb(const Course *course, const Position *here, int mask, Position *other)
{
    double step[N_PLACE + 1], *q = positions_of(other);
    *other = *here;
    const int open = !newton_step(other, course->p, step);
    for (int k = 0; k < N_PLACE; k++) {
        const double size = ROUNDINGS * DBL_EPSILON * max_of(is_turn(k) ? 1.0 : course->extent, fabs(q[k]));
        q[k] += (k & mask ? -1.0 : 1.0) * (size + (open && isfinite(step[k]) ? LEFT * fabs(step[k]) : 0.0));
    }
    if (newton_step(other, course->p, step))
        memcpy(rates_of(other), rates_of(here), N_PLACE * sizeof *q);
}

/*
 * By how much rounding errors of positions and velocities change event function i; 0 where they lead to a pole. Some
 * signs are tried, of neighbours the same and others.
 */
static double uncertainty(const Course *course, View *here, int i)
{
    const Position *at = &here->at;
    double of_q[N_Q] = {0.0}, of_v[N_Q] = {0.0}, speed[2];
    if (here->has_error)
        return here->error[N_WATCHED - N_USER_EVENTS + i];
    for (int mask = 0; mask < 8; mask = mask ? 2 * mask : 1) {
        Position other;
        disturb(course, at, mask, &other);
#if POSITIONS_IN_TREE
        if (arrive(beyond_jump(other.t), other.s, other.s_rate, course->p, other.s_second, other.q, other.v,
                other.a, &other.phi))
            continue;
#endif
        for (int k = 0; k < N_Q; k++) {
            of_q[k] += fabs(other.q[k] - at->q[k]);
            of_v[k] += fabs(other.v[k] - at->v[k]);
        }
    }
    speeds_of(at, course->extent, speed);
    for (int k = 0; k < N_Q; k++)
        of_v[k] += ROUNDINGS * DBL_EPSILON * speed[k % 3 == 2];
    error_by_bounds(at->t, at->q, at->v, of_q, of_v, N_Q, &(DiscreteState){0}, course->p, here->error);
    here->has_error = 1;
    return here->error[N_WATCHED - N_USER_EVENTS + i];
}

/* The value of event function i, last on `branch`; 0 where it is below its uncertainty. */
static double resolved(const Course *course, View *here, int i, int branch)
{
    const double f = here->event[i];
    return branch * f > 0.0 || !(fabs(f) <= uncertainty(course, here, i)) ? f : 0.0;
}

/*
 * The search. What Python hands over: sides seen last, times and numbers of what was found, room for so many. Of a
 * step: its length, how large the bounds of each event function are over it, where the part begins that is judged,
 * where it and those after it end, the last status.
 */
typedef struct {
    Course *course;
    signed char *branch;
    double *t;
    int *event;
    long found, capacity;
    double start; /* of the run: a zero on which it begins is not crossed */
    int stop;     /* whether an event may end the run */
    unsigned char no_number[N_USER_EVENTS]; /* told to be none */
    double h, most[N_USER_EVENTS];
    View here, *end;
    int n, status;
    View low, high; /* of event function i, before and after the zero that is located */
    int i;
} Search;

/* Follows the motion to t1, in steps. */
static int follow(const Search *of, double t1, View *view)
{
    Stride stride = {t1 - view->at.t, 0};
    while (view->at.t < t1) {
        const int status = step_on(of->course, &stride, t1, &view->at);
        if (status)
            return status;
    }
    look(of->course, view);
    return 0;
}

/* Negative where a value is on the side of the one at the end, or no number as there. */
static double value_before(double end, double x)
{
    if (isnan(end) || isnan(x))
        return isnan(end) && isnan(x) ? -1.0 : 1.0;
    return end > 0.0 ? -x : x;
}

static int evaluate_event(void *context, double t, Place *now)
{
    Search *of = context;
    View view = of->low;
    const int status = follow(of, t, &view);
    now->f = value_before(of->high.event[of->i], view.event[of->i]);
    *(now->f < 0.0 ? &of->high : &of->low) = view;
    return status;
}

/*
 * The time before b at which event function i comes to the side where it is at b, or to be no number as there; whether
 * it does so at a pole: there it grows to values that are larger than their uncertainty.
 */
static int locate(Search *of, int i, const View *b, double *t, int *pole)
{
    const double from = of->here.at.t, to = b->at.t, end = b->event[i];
    const ZeroTolerance near = {.width = max_of(1e-13 * (to - from), 4.0 * DBL_EPSILON * fabs(to))};
    Bracket of_zero = {{{from, value_before(end, of->here.event[i]), NAN}, {to, value_before(end, end), NAN}}, 2};
    of->low = of->here, of->high = *b, of->i = i;
    const int status = locate_zero(evaluate_event, of, &near, MOST_PLACES, guess_zero(&of_zero, 2), &of_zero);
    if (status)
        return status;
    *t = of_zero.at[1].s;
    const int lost = follow(of, *t + POLE_DISTANCE * near.width, &of->low);
    *pole = is_near_pole(of->high.event[i], lost ? INFINITY : of->low.event[i])
        && resolved(of->course, &of->high, i, 0) != 0.0;
    return 0;
}

/* Puts an event in its place by time among those of this part of the way. */
static int note(Search *of, long first, double t, int event)
{
    long k = of->found;
    if (k == of->capacity)
        return EVENTS_FULL;
    for (; k > first && of->t[k - 1] > t; k--) {
        of->t[k] = of->t[k - 1];
        of->event[k] = of->event[k - 1];
    }
    of->t[k] = t;
    of->event[k] = event;
    of->found++;
    return 0;
}

/* All events of a part up to b; what comes after one that ends the run is forgotten. */
static int compare(Search *of, View *b)
{
    const View *a = &of->here;
    const long first = of->found;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        double t = a->at.t;
        int pole = 0, status = 0;
        if (isnan(b->event[i]) && !of->no_number[i]) {
            of->no_number[i] = 1;
            status = isnan(a->event[i]) ? 0 : locate(of, i, b, &t, &pole);
            if (!status)
                status = note(of, first, t, i + N_USER_EVENTS);
        } else if (event_crosses(i, &of->branch[i], resolved(of->course, b, i, of->branch[i]))) {
            status = locate(of, i, b, &t, &pole);
            if (!status && !pole && t - of->start > 1e-12 * (b->at.t - a->at.t) + 16.0 * DBL_EPSILON * fabs(t))
                status = note(of, first, t, i);
        }
        if (status)
            return status;
    }
    for (long k = first; k < of->found; k++)
        if (of->stop && of->event[k] < N_USER_EVENTS && event_stops[of->event[k]]) {
            of->found = k + 1;
            return EVENT_STOPS;
        }
    return 0;
}

/*
 * Whether event function i is zero up to b but for rounding, as a velocity that the linkage holds at zero: it is so at
 * both ends, and its bounds are not far from that, or become narrower with the part.
 */
static int is_held(Search *of, View *b, int i, Range f)
{
    const double part = (b->at.t - of->here.at.t) / of->h, most = max_of(-f.lo, f.hi);
    const double error = uncertainty(of->course, &of->here, i);
    return !f.partly && fabs(of->here.event[i]) <= error
        && (most <= ALIKE * error || is_narrowing(-most, part, -of->most[i]))
        && resolved(of->course, b, i, 0) == 0.0;
}

/* Bounds of positions and velocities over the cubic between two places; slopes by the way between them. */
static void bound_motion(const Position *a, const Position *b, Range *q, Range *v)
{
    const double h = b->t - a->t;
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
}

/* Whether bounds leave open whether some event function has a zero before b that does not show at both ends. */
static int is_open(Search *of, View *b)
{
    const View *a = &of->here;
    const double h = b->at.t - a->at.t;
    Range q[N_Q], v[N_Q], out[N_WATCHED];
    bound_motion(&a->at, &b->at, q, v);
    watched_ranges((Range){a->at.t, b->at.t, h, h, 0}, q, v, &(DiscreteState){0}, of->course->p, out);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Range f = out[N_WATCHED - N_USER_EVENTS + i];
        const double branch = f.hi <= 0.0 || a->event[i] < 0.0 ? -1.0 : 1.0;
        if (h == of->h)
            of->most[i] = max_of(-f.lo, f.hi);
        if (zero_verdict(branch < 0.0 ? range_negative(f) : f, branch * a->event[i], branch * b->event[i], 1.0, 0) < 0
            && !is_held(of, b, i, f))
            return 1;
    }
    return 0;
}

/* Judges a part from `here` to the last of `end`: 1 where the search ends in it, by `status`. */
static int judge_part(void *context, double a, double b, int small)
{
    Search *of = context;
    View *end = &of->end[of->n - 1];
    if (!small && is_open(of, end)) {
        end[1] = of->here;
        if (!follow(of, a + 0.5 * (b - a), &end[1])) {
            of->n++;
            return -1;
        }
    }
    of->status = compare(of, end);
    of->here = *end;
    of->n--;
    return of->status != 0;
}

/* From one sample to the next. */
static int search(Search *of, double t1)
{
    Stride stride = {t1 - of->here.at.t, 0};
    int status = 0;
    while (!status && of->here.at.t < t1) {
        *of->end = of->here;
        status = step_on(of->course, &stride, t1, &of->end->at);
        if (status)
            return status;
        look(of->course, of->end);
        of->n = 1;
        of->h = of->end->at.t - of->here.at.t;
        (void)first_part(of->here.at.t, of->end->at.t, SMALLEST_PART * of->h, judge_part, of);
        status = of->status;
    }
    return status;
}

/*
 * Looks through the intervals between n + 1 samples. Returns 0, EVENT_STOPS after an event that ends the run,
 * EVENTS_FULL where there was no room for those of an interval (`done` intervals are complete), or why the motion
 * could not be followed.
 */
int gudgeon_kinematic_events(void *integrator, long n, const double *t, const double *parameters, const double *q,
    const double *v, double start, int stop, signed char *branch, long capacity, double *at, int *event, long *found,
    long *done)
{
    Course *course = integrator;
    View end[DEEPEST + 2];
    Search of = {.course = course, .branch = branch, .t = at, .event = event, .capacity = capacity, .start = start,
        .stop = stop, .end = end};
    course->p = (const Parameters *)parameters;
    for (*done = 0; *done < n; ++*done) {
        signed char sides[N_USER_EVENTS];
        int status = begin_near(course, t[*done], q + *done * N_Q, v + *done * N_Q, &of.here.at);
        if (status)
            return status;
        look(course, &of.here);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            (void)event_crosses(i, &branch[i], branch[i] ? 0.0 : resolved(course, &of.here, i, 0));
            sides[i] = branch[i]; /* the first one, where there was none */
        }
        *found = of.found;
        status = search(&of, t[*done + 1]);
        if (course->cancellation.stop)
            status = STOPPED; /* what was found in this interval means nothing */
        if (status == EVENTS_FULL || status == STOPPED)
            memcpy(branch, sides, sizeof sides);
        else
            *found = of.found;
        if (status)
            return status;
    }
    return 0;
}
