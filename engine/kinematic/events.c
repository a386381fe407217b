/*
 * Location of user-defined events in the motion of a linkage whose position is determined by its drives. The motion is
 * followed again step by step. Parts of a step are halved until bounds decide for every event function whether it has a
 * zero (watch/zeros.h). A zero is located with Newton's method at every time that is evaluated.
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

/*
 * Evaluate the user-defined event functions of a sample: solve the accelerations at its position, then store the values
 * in sample->event. A failure of that solution is ignored, because it was reported before. The uncertainties of the
 * sample become invalid (has_error = 0).
 */
static void evaluate_events(KinematicRun *run, SampledPosition *sample)
{
    RhsOutputs rhs = {0};
    double a[N_Q];
    (void)solve_accelerations(run, &sample->at, a, &rhs); /* a failure was reported before */
    memcpy(sample->event, rhs.event, sizeof sample->event);
    sample->has_error = 0;
}

#if POSITIONS_IN_TREE
enum { N_PLACE = N_X };
#define positions_of(place) ((place)->s)
#define rates_of(place) ((place)->s_rate)
#define is_turn(k) is_angle[k]

/*
 * Compute the remaining Newton step at a position, and store the velocities of the position as it is. Return 0 or a
 * status.
 */
static int compute_newton_step(Position *position, const Parameters *p, double *step)
{
    return close_step(after_jump(position->t), position->s, p, step, position->s_rate, &position->phi);
}
#else
enum { N_PLACE = N_Q };
#define positions_of(place) ((place)->q)
#define rates_of(place) ((place)->v)
#define is_turn(k) ((k) % 3 == 2)

/*
 * Compute the remaining Newton step at a position, and store the velocities of the position as it is. Return 0 or a
 * status.
 */
static int compute_newton_step(Position *position, const Parameters *p, double *step)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(after_jump(position->t), position->q, p, phi);
    const int status = project(after_jump(position->t), position->q, phi, p, step);
    return status ? status : solve_velocities(after_jump(position->t), position->q, p, position->v);
}
#endif

/*
 * Compute the largest speeds of lengths, speed[0] in m/s, and of angles, speed[1] in rad/s. Each is at least the other
 * one converted by the mechanism's size `extent` (m).
 */
static void compute_largest_speeds(const Position *position, double extent, double *speed)
{
    speed[0] = speed[1] = 0.0;
    for (int k = 0; k < N_PLACE; k++)
        speed[is_turn(k)] = max_of(speed[is_turn(k)], fabs(rates_of(position)[k]));
    speed[0] = max_of(speed[0], extent * speed[1]);
    speed[1] = max_of(speed[1], speed[0] / extent);
}

/*
 * Perturb a position by its rounding errors, with signs by the bits of `mask`, and compute its velocities, in
 * `perturbed_position`. Newton's last step is added: it is large near a singular position. If the velocities cannot be
 * solved, they are kept.
 */
static void perturb_position(const KinematicRun *run, const Position *position, int mask, Position *perturbed_position)
{
    double step[N_PLACE + 1], *q = positions_of(perturbed_position);
    *perturbed_position = *position;
    const int open = !compute_newton_step(perturbed_position, run->p, step);
    for (int k = 0; k < N_PLACE; k++) {
        const double size = ACCUMULATED_ULPS * DBL_EPSILON * max_of(is_turn(k) ? 1.0 : run->extent, fabs(q[k]));
        q[k] += (k & mask ? -1.0 : 1.0) * (size + (open && isfinite(step[k]) ? CLOSING_STEPS * fabs(step[k]) : 0.0));
    }
    if (compute_newton_step(perturbed_position, run->p, step))
        memcpy(rates_of(perturbed_position), rates_of(position), N_PLACE * sizeof *q);
}

/*
 * Return by how much rounding errors of positions and velocities change event function i at a sample; 0 where they
 * include a pole. The first call for a sample estimates and stores the uncertainties of all functions; later calls
 * return the stored ones (has_error). Four positions, perturbed with the masks 0, 1, 2 and 4 of perturb_position(), are
 * compared with the sample; those that cannot be solved are left out. Bounds of the functions over the sum of the
 * differences give the uncertainties.
 */
static double estimate_event_uncertainty(const KinematicRun *run, SampledPosition *sample, int i)
{
    const Position *at = &sample->at;
    double of_q[N_Q] = {0.0}, of_v[N_Q] = {0.0}, speed[2];
    if (sample->has_error)
        return sample->error[N_WATCHED - N_USER_EVENTS + i];
    for (int mask = 0; mask < 8; mask = mask ? 2 * mask : 1) {
        Position perturbed;
        perturb_position(run, at, mask, &perturbed);
#if POSITIONS_IN_TREE
        if (arrive(after_jump(perturbed.t), perturbed.s, perturbed.s_rate, run->p, perturbed.s_second, perturbed.q,
            perturbed.v,
                perturbed.a, &perturbed.phi))
            continue;
#endif
        for (int k = 0; k < N_Q; k++) {
            of_q[k] += fabs(perturbed.q[k] - at->q[k]);
            of_v[k] += fabs(perturbed.v[k] - at->v[k]);
        }
    }
    compute_largest_speeds(at, run->extent, speed);
    for (int k = 0; k < N_Q; k++)
        of_v[k] += ACCUMULATED_ULPS * DBL_EPSILON * speed[k % 3 == 2];
    estimate_error_by_bounds(at->t, at->q, at->v, of_q, of_v, N_Q, &(DiscreteState){0}, run->p, sample->error);
    sample->has_error = 1;
    return sample->error[N_WATCHED - N_USER_EVENTS + i];
}

/*
 * Return the value of event function i, whose last sign is `branch` (0: none); 0 if the value is below its uncertainty.
 * A value with the last sign is returned as it is.
 */
static double get_resolved_value(const KinematicRun *run, SampledPosition *sample, int i, int branch)
{
    const double f = sample->event[i];
    return branch * f > 0.0 || !(fabs(f) <= estimate_event_uncertainty(run, sample, i)) ? f : 0.0;
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

/*
 * Follow the motion from the position of `sample` to time t1 in steps, and evaluate the event functions there. Return 0
 * or a status.
 */
static int follow_motion(const Search *search, double t1, SampledPosition *sample)
{
    StepLength stride = {t1 - sample->at.t, 0};
    while (sample->at.t < t1) {
        const int status = make_step(search->run, &stride, t1, &sample->at);
        if (status)
            return status;
    }
    evaluate_events(search->run, sample);
    return 0;
}

/*
 * Return a value that is negative if `value` has the sign of `end_value`, or is undefined (NaN) as end_value is. If
 * only one of both is undefined, it is positive.
 */
static double orient_event_value(double end_value, double value)
{
    if (isnan(end_value) || isnan(value))
        return isnan(end_value) && isnan(value) ? -1.0 : 1.0;
    return end_value > 0.0 ? -value : value;
}

/*
 * Evaluate the event function of a search at time t for locate_zero(), and store the position at the matching end of
 * the bracket. context: the Search. out->f: value, negative after the zero. Return 0 or a status.
 */
static int evaluate_event(void *context, double t, Sample *out)
{
    Search *search = context;
    SampledPosition sample = search->low;
    const int status = follow_motion(search, t, &sample);
    out->f = orient_event_value(search->high.event[search->i], sample.event[search->i]);
    *(out->f < 0.0 ? &search->high : &search->low) = sample;
    return status;
}

/*
 * Locate the time *t before sample b at which event function i gets its sign at b, or becomes undefined as there.
 * is_pole: set to whether this is a pole, where the values exceed their uncertainty. Return 0 or a status.
 */
static int locate_event(Search *search, int i, const SampledPosition *b, double *t, int *is_pole)
{
    const double from = search->here.at.t, to = b->at.t, end = b->event[i];
    const ZeroTolerance near = {.width = max_of(1e-13 * (to - from), 4.0 * DBL_EPSILON * fabs(to))};
    Bracket of_zero = {{{from, orient_event_value(end, search->here.event[i]), NAN},
        {to, orient_event_value(end, end), NAN}}, 2};
    search->low = search->here, search->high = *b, search->i = i;
    const int status = locate_zero(evaluate_event, search, &near, MAX_POINTS, estimate_zero(&of_zero, 2), &of_zero);
    if (status)
        return status;
    *t = of_zero.at[1].s;
    const int lost = follow_motion(search, *t + POLE_DISTANCE * near.width, &search->low);
    *is_pole = is_near_pole(search->high.event[i], lost ? INFINITY : search->low.event[i])
        && get_resolved_value(search->run, &search->high, i, 0) != 0.0;
    return 0;
}

/*
 * Insert an event at time t (s) in order of time among the found ones from index `first` on. event: its number; plus
 * N_USER_EVENTS if it became undefined. Return 0, or EVENTS_FULL without a change if there is no capacity.
 */
static int insert_event(Search *search, long first, double t, int event)
{
    long k = search->found;
    if (k == search->capacity)
        return EVENTS_FULL;
    for (; k > first && search->t[k - 1] > t; k--) {
        search->t[k] = search->t[k - 1];
        search->event[k] = search->event[k - 1];
    }
    search->t[k] = t;
    search->event[k] = event;
    search->found++;
    return 0;
}

/*
 * Locate and collect all events of the part from search->here to b, and update the last signs. Return 0 or a status.
 * Events that become undefined are reported once. Zeros at the start of the run do not count. After an event that ends
 * the run (EVENT_STOPS) later ones are discarded.
 */
static int collect_events(Search *search, SampledPosition *b)
{
    const SampledPosition *a = &search->here;
    const long first = search->found;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        double t = a->at.t;
        int is_pole = 0, status = 0;
        if (isnan(b->event[i]) && !search->no_number[i]) {
            search->no_number[i] = 1;
            status = isnan(a->event[i]) ? 0 : locate_event(search, i, b, &t, &is_pole);
            if (!status)
                status = insert_event(search, first, t, i + N_USER_EVENTS);
        } else if (detect_event_crossing(
                       i, &search->branch[i], get_resolved_value(search->run, b, i, search->branch[i]))) {
            status = locate_event(search, i, b, &t, &is_pole);
            if (!status && !is_pole && t - search->start > 1e-12 * (b->at.t - a->at.t) + 16.0 * DBL_EPSILON * fabs(t))
                status = insert_event(search, first, t, i);
        }
        if (status)
            return status;
    }
    for (long k = first; k < search->found; k++)
        if (search->stop && search->event[k] < N_USER_EVENTS && event_stops[search->event[k]]) {
            search->found = k + 1;
            return EVENT_STOPS;
        }
    return 0;
}

/*
 * Return whether event function i is zero within rounding up to b, like a velocity that a constraint holds at zero. It
 * is at both ends, and its bounds f are near zero or narrow with the part.
 */
static int is_zero_by_constraint(Search *search, SampledPosition *b, int i, Range f)
{
    const double part = (b->at.t - search->here.at.t) / search->h, most = max_of(-f.lo, f.hi);
    const double error = estimate_event_uncertainty(search->run, &search->here, i);
    return !f.partly && fabs(search->here.event[i]) <= error
        && (most <= MAX_UNCERTAINTY_RATIO * error || is_narrowing(-most, part, -search->most[i]))
        && get_resolved_value(search->run, b, i, 0) == 0.0;
}

/*
 * Compute bounds of positions q and velocities v over the cubic between positions a and b, and of their slopes over the
 * part. Slopes are by the fraction of the part. q, v: N_Q ranges each.
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
 * Called for parts of a step from search->here; for a whole step the largest bounds are stored.
 */
static int may_have_hidden_zero(Search *search, SampledPosition *b)
{
    const SampledPosition *a = &search->here;
    const double h = b->at.t - a->at.t;
    Range q[N_Q], v[N_Q], out[N_WATCHED];
    bound_motion(&a->at, &b->at, q, v);
    watched_ranges((Range){a->at.t, b->at.t, h, h, 0}, q, v, &(DiscreteState){0}, search->run->p, out);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Range f = out[N_WATCHED - N_USER_EVENTS + i];
        const double branch = f.hi <= 0.0 || a->event[i] < 0.0 ? -1.0 : 1.0;
        if (h == search->h)
            search->most[i] = max_of(-f.lo, f.hi);
        if (classify_zero(branch < 0.0 ? range_negative(f) : f, branch * a->event[i], branch * b->event[i], 1.0, 0) < 0
            && !is_zero_by_constraint(search, b, i, f))
            return 1;
    }
    return 0;
}

/*
 * Classify the part from search->here to the last of search->end for bisect_parts(): 1 if a status ends the search, -1
 * to halve it. If the part has no hidden zero, is smallest (`is_smallest`), or its middle cannot be solved, its events
 * are collected and 0 is returned. a, b: times of its ends, s.
 */
static int classify_part(void *context, double a, double b, int is_smallest)
{
    Search *search = context;
    SampledPosition *end = &search->end[search->n - 1];
    if (!is_smallest && may_have_hidden_zero(search, end)) {
        end[1] = search->here;
        if (!follow_motion(search, a + 0.5 * (b - a), &end[1])) {
            search->n++;
            return -1;
        }
    }
    search->status = collect_events(search, end);
    search->here = *end;
    search->n--;
    return search->status != 0;
}

/* Find the events from search->here to time t1, the next sample, step by step. Return 0 or a status. */
static int find_events_in_interval(Search *search, double t1)
{
    StepLength stride = {t1 - search->here.at.t, 0};
    int status = 0;
    while (!status && search->here.at.t < t1) {
        *search->end = search->here;
        status = make_step(search->run, &stride, t1, &search->end->at);
        if (status)
            return status;
        evaluate_events(search->run, search->end);
        search->n = 1;
        search->h = search->end->at.t - search->here.at.t;
        (void)bisect_parts(search->here.at.t, search->end->at.t, SMALLEST_PART * search->h, classify_part, search);
        status = search->status;
    }
    return status;
}

/*
 * Find the user-defined events in the intervals between n + 1 samples of a kinematic motion, in order of time. branch:
 * last signs, updated; at, event: times (s) and numbers of `found` events; done: complete intervals. Return 0,
 * EVENT_STOPS after an event that ends the run, EVENTS_FULL if the capacity is used up, STOPPED, or the status of the
 * motion. An interval that is not complete is searched again by the next call.
 */
int gudgeon_kinematic_events(void *integrator, long n, const double *t, const double *parameters, const double *q,
    const double *v, double start, int stop, signed char *branch, long capacity, double *at, int *event, long *found,
    long *done)
{
    KinematicRun *run = integrator;
    SampledPosition end[DEEPEST + 2];
    Search search = {.run = run, .branch = branch, .t = at, .event = event, .capacity = capacity, .start = start,
        .stop = stop, .end = end};
    run->p = (const Parameters *)parameters;
    for (*done = 0; *done < n; ++*done) {
        signed char signs[N_USER_EVENTS];
        int status = begin_position_near(run, t[*done], q + *done * N_Q, v + *done * N_Q, &search.here.at);
        if (status)
            return status;
        evaluate_events(run, &search.here);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            (void)detect_event_crossing(i, &branch[i], branch[i] ? 0.0 : get_resolved_value(run, &search.here, i, 0));
            signs[i] = branch[i]; /* the first sign, if there was none */
        }
        *found = search.found;
        status = find_events_in_interval(&search, t[*done + 1]);
        if (run->cancellation.stop)
            status = STOPPED; /* events of this interval are discarded */
        if (status == EVENTS_FULL || status == STOPPED)
            memcpy(branch, signs, sizeof signs);
        else
            *found = search.found;
        if (status)
            return status;
    }
    return 0;
}
