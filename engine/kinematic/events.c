/*
 * User events of a kinematic motion. The motion is followed again step by step. Parts of a step are halved until bounds
 * decide for every event function whether it has a zero (watch/zeros.h). A zero is located with Newton's method at
 * every time that is evaluated.
 */
#include "../watch/zeros.h"

#define SMALLEST_PART 1.5e-11 /* of a step: 36 halvings */
#define MAX_UNCERTAINTY_RATIO 1e4 /* uncertainties: error of bounds over a cubic */

/* A position with the values of event functions and, if has_error, their uncertainties. */
typedef struct {
    Position at;
    double event[N_USER_EVENTS], error[N_WATCHED];
    int has_error;
} SampledPosition;

/* Evaluate the event functions at a position. */
static void evaluate_events(KinematicRun *run, SampledPosition *view)
{
    RhsOutputs rhs = {0};
    double a[N_Q];
    (void)solve_motion(run, &view->at, a, &rhs); /* a failure was reported before */
    memcpy(view->event, rhs.event, sizeof view->event);
    view->has_error = 0;
}

#if POSITIONS_IN_TREE
enum { N_PLACE = N_X };
#define positions_of(place) ((place)->s)
#define rates_of(place) ((place)->s_rate)
#define is_turn(k) is_angle[k]

/* Compute the remaining Newton step at a position, and the rates of the position as it is. Returns a status. */
static int newton_step(Position *at, const Parameters *p, double *step)
{
    return close_step(after_jump(at->t), at->s, p, step, at->s_rate, &at->phi);
}
#else
enum { N_PLACE = N_Q };
#define positions_of(place) ((place)->q)
#define rates_of(place) ((place)->v)
#define is_turn(k) ((k) % 3 == 2)

/* Compute the remaining Newton step at a position, and the velocities of the position as it is. Returns a status. */
static int newton_step(Position *at, const Parameters *p, double *step)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(after_jump(at->t), at->q, p, phi);
    const int status = project(after_jump(at->t), at->q, phi, p, step);
    return status ? status : solve_velocities(after_jump(at->t), at->q, p, at->v);
}
#endif

/*
 * Compute the largest speeds of lengths (m/s) and angles (rad/s), each at least the other one converted by the size
 * `extent`.
 */
static void speeds_of(const Position *at, double extent, double *speed)
{
    speed[0] = speed[1] = 0.0;
    for (int k = 0; k < N_PLACE; k++)
        speed[is_turn(k)] = max_of(speed[is_turn(k)], fabs(rates_of(at)[k]));
    speed[0] = max_of(speed[0], extent * speed[1]);
    speed[1] = max_of(speed[1], speed[0] / extent);
}

/*
 * Perturb a position by its rounding errors, with signs by the bits of `mask`, and compute its velocities. Near a
 * singular position, Newton's last step shows that rounding counts for more.
 */
static void perturb_position(const KinematicRun *run, const Position *here, int mask, Position *other)
{
    double step[N_PLACE + 1], *q = positions_of(other);
    *other = *here;
    const int open = !newton_step(other, run->p, step);
    for (int k = 0; k < N_PLACE; k++) {
        const double size = ACCUMULATED_ULPS * DBL_EPSILON * max_of(is_turn(k) ? 1.0 : run->extent, fabs(q[k]));
        q[k] += (k & mask ? -1.0 : 1.0) * (size + (open && isfinite(step[k]) ? CLOSING_STEPS * fabs(step[k]) : 0.0));
    }
    if (newton_step(other, run->p, step))
        memcpy(rates_of(other), rates_of(here), N_PLACE * sizeof *q);
}

/*
 * Return by how much rounding errors of positions and velocities change event function i; 0 where they include a pole.
 * Several combinations of signs are tried.
 */
static double event_uncertainty(const KinematicRun *run, SampledPosition *here, int i)
{
    const Position *at = &here->at;
    double of_q[N_Q] = {0.0}, of_v[N_Q] = {0.0}, speed[2];
    if (here->has_error)
        return here->error[N_WATCHED - N_USER_EVENTS + i];
    for (int mask = 0; mask < 8; mask = mask ? 2 * mask : 1) {
        Position other;
        perturb_position(run, at, mask, &other);
#if POSITIONS_IN_TREE
        if (arrive(after_jump(other.t), other.s, other.s_rate, run->p, other.s_second, other.q, other.v,
                other.a, &other.phi))
            continue;
#endif
        for (int k = 0; k < N_Q; k++) {
            of_q[k] += fabs(other.q[k] - at->q[k]);
            of_v[k] += fabs(other.v[k] - at->v[k]);
        }
    }
    speeds_of(at, run->extent, speed);
    for (int k = 0; k < N_Q; k++)
        of_v[k] += ACCUMULATED_ULPS * DBL_EPSILON * speed[k % 3 == 2];
    error_by_bounds(at->t, at->q, at->v, of_q, of_v, N_Q, &(DiscreteState){0}, run->p, here->error);
    here->has_error = 1;
    return here->error[N_WATCHED - N_USER_EVENTS + i];
}

/* Return the value of event function i, whose last sign is `branch`, or 0 if it is below its uncertainty. */
static double resolved_value(const KinematicRun *run, SampledPosition *here, int i, int branch)
{
    const double f = here->event[i];
    return branch * f > 0.0 || !(fabs(f) <= event_uncertainty(run, here, i)) ? f : 0.0;
}

/*
 * The search for events. From Python: last signs, arrays of times and numbers, their capacity. Of the current step: its
 * length, the largest bound of each event function, the positions `here` at the beginning of the current part and `end`
 * at the ends of this and the n - 1 later parts, the last status.
 */
typedef struct {
    KinematicRun *run;
    signed char *branch;
    double *t;
    int *event;
    long found, capacity;
    double start; /* of the run: a zero on which it begins is not crossed */
    int stop;     /* whether an event may end the run */
    unsigned char no_number[N_USER_EVENTS]; /* reported as undefined */
    double h, most[N_USER_EVENTS];
    SampledPosition here, *end;
    int n, status;
    SampledPosition low, high; /* of event function i, before and after the zero that is located */
    int i;
} Search;

/* Follow the motion to t1 and evaluate the event functions there. Returns a status. */
static int follow_motion(const Search *of, double t1, SampledPosition *view)
{
    StepLength stride = {t1 - view->at.t, 0};
    while (view->at.t < t1) {
        const int status = make_step(of->run, &stride, t1, &view->at);
        if (status)
            return status;
    }
    evaluate_events(of->run, view);
    return 0;
}

/* Return a value that is negative if x has the sign of `end`, or is undefined as `end` is. */
static double value_before(double end, double x)
{
    if (isnan(end) || isnan(x))
        return isnan(end) && isnan(x) ? -1.0 : 1.0;
    return end > 0.0 ? -x : x;
}

/*
 * Evaluate the event function at time t for locate_zero(), and store the position at the matching end of the bracket.
 */
static int evaluate_event(void *context, double t, Sample *now)
{
    Search *of = context;
    SampledPosition view = of->low;
    const int status = follow_motion(of, t, &view);
    now->f = value_before(of->high.event[of->i], view.event[of->i]);
    *(now->f < 0.0 ? &of->high : &of->low) = view;
    return status;
}

/*
 * Locate the time t before b at which event function i gets its sign at b, or becomes undefined as there. pole: whether
 * it does so at a pole, where its values exceed their uncertainty. Returns a status.
 */
static int locate_event(Search *of, int i, const SampledPosition *b, double *t, int *pole)
{
    const double from = of->here.at.t, to = b->at.t, end = b->event[i];
    const ZeroTolerance near = {.width = max_of(1e-13 * (to - from), 4.0 * DBL_EPSILON * fabs(to))};
    Bracket of_zero = {{{from, value_before(end, of->here.event[i]), NAN}, {to, value_before(end, end), NAN}}, 2};
    of->low = of->here, of->high = *b, of->i = i;
    const int status = locate_zero(evaluate_event, of, &near, MAX_POINTS, guess_zero(&of_zero, 2), &of_zero);
    if (status)
        return status;
    *t = of_zero.at[1].s;
    const int lost = follow_motion(of, *t + POLE_DISTANCE * near.width, &of->low);
    *pole = is_near_pole(of->high.event[i], lost ? INFINITY : of->low.event[i])
        && resolved_value(of->run, &of->high, i, 0) != 0.0;
    return 0;
}

/*
 * Insert an event in order of time among those of this part, from index `first` on. Returns EVENTS_FULL if there is no
 * capacity left.
 */
static int insert_event(Search *of, long first, double t, int event)
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

/*
 * Collect all events of the part from `here` to b; events after one that ends the run are discarded. Returns a status.
 */
static int collect_events(Search *of, SampledPosition *b)
{
    const SampledPosition *a = &of->here;
    const long first = of->found;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        double t = a->at.t;
        int pole = 0, status = 0;
        if (isnan(b->event[i]) && !of->no_number[i]) {
            of->no_number[i] = 1;
            status = isnan(a->event[i]) ? 0 : locate_event(of, i, b, &t, &pole);
            if (!status)
                status = insert_event(of, first, t, i + N_USER_EVENTS);
        } else if (event_crosses(i, &of->branch[i], resolved_value(of->run, b, i, of->branch[i]))) {
            status = locate_event(of, i, b, &t, &pole);
            if (!status && !pole && t - of->start > 1e-12 * (b->at.t - a->at.t) + 16.0 * DBL_EPSILON * fabs(t))
                status = insert_event(of, first, t, i);
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
 * Return whether event function i is zero within rounding up to b, as a velocity that a constraint holds at zero. It is
 * at both ends, and its bounds are near zero or narrow with the part.
 */
static int is_zero_by_constraint(Search *of, SampledPosition *b, int i, Range f)
{
    const double part = (b->at.t - of->here.at.t) / of->h, most = max_of(-f.lo, f.hi);
    const double error = event_uncertainty(of->run, &of->here, i);
    return !f.partly && fabs(of->here.event[i]) <= error
        && (most <= MAX_UNCERTAINTY_RATIO * error || is_narrowing(-most, part, -of->most[i]))
        && resolved_value(of->run, b, i, 0) == 0.0;
}

/*
 * Compute bounds of positions and velocities over the cubic between two positions, and of their slopes over the part.
 */
static void bound_motion(const Position *a, const Position *b, Range *q, Range *v)
{
    const double h = b->t - a->t;
    for (int k = 0; k < N_Q; k++) {
        const double way = b->q[k] - a->q[k], from = h * a->v[k], to = h * b->v[k];
        /* q = q0 + from s + two s^2 + three s^3, 0 <= s <= 1 */
        const double two = 3.0 * way - 2.0 * from - to, three = from + to - 2.0 * way;
        const double end = 2.0 * two + 6.0 * three, turn = -two / (3.0 * three);
        const double top = turn > 0.0 && turn < 1.0 ? from + turn * (2.0 * two + 3.0 * turn * three) : from;
        const double least = min_of(top, min_of(from, to)), most = max_of(top, max_of(from, to));
        q[k] = (Range){max_of(a->q[k] + min_of(least, 0.0), b->q[k] - max_of(most, 0.0)),
            min_of(a->q[k] + max_of(most, 0.0), b->q[k] - min_of(least, 0.0)), least, most, 0};
        v[k] = (Range){least / h, most / h, min_of(2.0 * two, end) / h, max_of(2.0 * two, end) / h, 0};
    }
}

/*
 * Return whether bounds do not exclude a zero of some event function before b that the signs at both ends do not show.
 */
static int is_undecided(Search *of, SampledPosition *b)
{
    const SampledPosition *a = &of->here;
    const double h = b->at.t - a->at.t;
    Range q[N_Q], v[N_Q], out[N_WATCHED];
    bound_motion(&a->at, &b->at, q, v);
    watched_ranges((Range){a->at.t, b->at.t, h, h, 0}, q, v, &(DiscreteState){0}, of->run->p, out);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Range f = out[N_WATCHED - N_USER_EVENTS + i];
        const double branch = f.hi <= 0.0 || a->event[i] < 0.0 ? -1.0 : 1.0;
        if (h == of->h)
            of->most[i] = max_of(-f.lo, f.hi);
        if (zero_verdict(branch < 0.0 ? range_negative(f) : f, branch * a->event[i], branch * b->event[i], 1.0, 0) < 0
            && !is_zero_by_constraint(of, b, i, f))
            return 1;
    }
    return 0;
}

/*
 * Classify the part from `here` to the last of `end` for halve_parts(): 1 if `status` ends the search, -1 to halve it.
 */
static int judge_part(void *context, double a, double b, int small)
{
    Search *of = context;
    SampledPosition *end = &of->end[of->n - 1];
    if (!small && is_undecided(of, end)) {
        end[1] = of->here;
        if (!follow_motion(of, a + 0.5 * (b - a), &end[1])) {
            of->n++;
            return -1;
        }
    }
    of->status = collect_events(of, end);
    of->here = *end;
    of->n--;
    return of->status != 0;
}

/* Find the events from one sample to the next. Returns a status. */
static int search_interval(Search *of, double t1)
{
    StepLength stride = {t1 - of->here.at.t, 0};
    int status = 0;
    while (!status && of->here.at.t < t1) {
        *of->end = of->here;
        status = make_step(of->run, &stride, t1, &of->end->at);
        if (status)
            return status;
        evaluate_events(of->run, of->end);
        of->n = 1;
        of->h = of->end->at.t - of->here.at.t;
        (void)halve_parts(of->here.at.t, of->end->at.t, SMALLEST_PART * of->h, judge_part, of);
        status = of->status;
    }
    return status;
}

/*
 * Find the events in the intervals between n + 1 samples. branch: last signs, updated; at, event: times (s) and numbers
 * of `found` events; done: complete intervals. Returns 0, EVENT_STOPS after an event that ends the run, EVENTS_FULL if
 * the capacity is used up, or the status of the motion.
 */
int gudgeon_kinematic_events(void *integrator, long n, const double *t, const double *parameters, const double *q,
    const double *v, double start, int stop, signed char *branch, long capacity, double *at, int *event, long *found,
    long *done)
{
    KinematicRun *run = integrator;
    SampledPosition end[DEEPEST + 2];
    Search of = {.run = run, .branch = branch, .t = at, .event = event, .capacity = capacity, .start = start,
        .stop = stop, .end = end};
    run->p = (const Parameters *)parameters;
    for (*done = 0; *done < n; ++*done) {
        signed char sides[N_USER_EVENTS];
        int status = set_position_near(run, t[*done], q + *done * N_Q, v + *done * N_Q, &of.here.at);
        if (status)
            return status;
        evaluate_events(run, &of.here);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            (void)event_crosses(i, &branch[i], branch[i] ? 0.0 : resolved_value(run, &of.here, i, 0));
            sides[i] = branch[i]; /* the first sign, if there was none */
        }
        *found = of.found;
        status = search_interval(&of, t[*done + 1]);
        if (run->cancellation.stop)
            status = STOPPED; /* events of this interval are discarded */
        if (status == EVENTS_FULL || status == STOPPED)
            memcpy(branch, sides, sizeof sides);
        else
            *found = of.found;
        if (status)
            return status;
    }
    return 0;
}
