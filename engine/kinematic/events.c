/*
 * Location of user-defined events in the motion of a linkage whose position is determined by its drives. The motion is
 * followed again step by step. Parts of a step are halved until bounds decide for every event function whether it has a
 * zero (watch/zeros.h). A zero is located with Newton's method at every time that is evaluated.
 */
#include "../watch/zeros.h"

#define MIN_PART_FRACTION 1.5e-11 /* of a step: 36 halvings */
#define MAX_UNCERTAINTY_RATIO 1e4 /* uncertainties: error of bounds over a cubic */

enum { FIRST_USER_EVENT = N_MONITORED - N_USER_EVENTS }; /* number of user event 0 among the monitored functions */

/* A position with the values of event functions and, if has_uncertainty, the uncertainties of monitored functions. */
typedef struct {
    Position position;
    double event[N_USER_EVENTS], uncertainty[N_MONITORED];
    int has_uncertainty;
} SampledPosition;

/*
 * Evaluate the user-defined event functions at the position of a sample into sample->event, by solving the
 * accelerations. A failure of that solution is ignored, because it was reported before. The uncertainties of the sample
 * become invalid (has_uncertainty = 0).
 */
static void evaluate_sample_events(KinematicRun *run, SampledPosition *sample)
{
    RhsOutputs rhs = {0};
    double a[N_Q];
    (void)solve_accelerations(run, &sample->position, a, &rhs); /* a failure was reported before */
    memcpy(sample->event, rhs.event, sizeof sample->event);
    sample->has_uncertainty = 0;
}

#if POSITIONS_IN_TREE
enum { N_COORDINATES = N_X };
#define get_coordinates(position) ((position)->s)
#define get_rates(position) ((position)->s_rate)
#define is_angle_coordinate(k) is_angle[k]

/*
 * Compute the remaining Newton step (N_X) at a position, in tree coordinates; also set its rates s_rate and phi. Return
 * 0 or a status.
 */
static int compute_newton_step(Position *position, const Parameters *p, double *step)
{
    return close_step(get_time_after_jump(position->t), position->s, p, step, position->s_rate, &position->phi);
}
#else
enum { N_COORDINATES = N_Q };
#define get_coordinates(position) ((position)->q)
#define get_rates(position) ((position)->v)
#define is_angle_coordinate(k) ((k) % 3 == 2)

/*
 * Compute the remaining Newton step (N_Q) at a position, in absolute coordinates; also set its velocities v. Return 0
 * or a status.
 */
static int compute_newton_step(Position *position, const Parameters *p, double *step)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(get_time_after_jump(position->t), position->q, p, phi);
    const int status = project(get_time_after_jump(position->t), position->q, phi, p, step);
    return status ? status : solve_velocities(get_time_after_jump(position->t), position->q, p, position->v);
}
#endif

/*
 * Compute the largest speeds of lengths, speed[0] in m/s, and of angles, speed[1] in rad/s. Each is at least the other
 * one converted by the mechanism's size `extent` (m).
 */
static void compute_largest_speeds(const Position *position, double extent, double *speed)
{
    speed[0] = speed[1] = 0.0;
    for (int k = 0; k < N_COORDINATES; k++)
        speed[is_angle_coordinate(k)] = max_of(speed[is_angle_coordinate(k)], fabs(get_rates(position)[k]));
    speed[0] = max_of(speed[0], extent * speed[1]);
    speed[1] = max_of(speed[1], speed[0] / extent);
}

/*
 * Copy `position` to `perturbed_position`, change its coordinates by their rounding errors, and compute its velocities
 * there. Bit k of `mask` selects the sign of coordinate k. Newton's remaining step is added: it is large near a
 * singular position. If the velocities cannot be solved, those of `position` are kept.
 */
static void perturb_position(const KinematicRun *run, const Position *position, int mask, Position *perturbed_position)
{
    double step[N_COORDINATES + 1], *q = get_coordinates(perturbed_position);
    *perturbed_position = *position;
    const int is_solved = !compute_newton_step(perturbed_position, run->p, step);
    for (int k = 0; k < N_COORDINATES; k++) {
        const double min_size = is_angle_coordinate(k) ? 1.0 : run->extent;
        const double size = ACCUMULATED_ULPS * DBL_EPSILON * max_of(min_size, fabs(q[k]));
        const double correction = is_solved && isfinite(step[k]) ? CLOSING_STEPS * fabs(step[k]) : 0.0;
        q[k] += (k & mask ? -1.0 : 1.0) * (size + correction);
    }
    if (compute_newton_step(perturbed_position, run->p, step))
        memcpy(get_rates(perturbed_position), get_rates(position), N_COORDINATES * sizeof *q);
}

/*
 * Return by how much rounding errors of positions and velocities change event function i at a sample; 0 where they
 * include a pole. The first call for a sample estimates and stores the uncertainties of all monitored functions; later
 * calls return the stored ones (has_uncertainty).
 *
 * Four positions, perturbed with the masks 0, 1, 2 and 4 of perturb_position(), are compared with the sample; those
 * that cannot be solved are left out. The errors are the sums of the differences; ACCUMULATED_ULPS roundings of the
 * largest speed are added to those of velocities. Bounds of the functions over these errors give the uncertainties.
 */
static double estimate_event_uncertainty(const KinematicRun *run, SampledPosition *sample, int i)
{
    const Position *position = &sample->position;
    double q_error[N_Q] = {0.0}, v_error[N_Q] = {0.0}, speed[2];
    if (sample->has_uncertainty)
        return sample->uncertainty[FIRST_USER_EVENT + i];
    for (int mask = 0; mask < 8; mask = mask ? 2 * mask : 1) {
        Position perturbed;
        perturb_position(run, position, mask, &perturbed);
#if POSITIONS_IN_TREE
        if (compute_body_motion(get_time_after_jump(perturbed.t), perturbed.s, perturbed.s_rate, run->p,
            perturbed.s_second, perturbed.q, perturbed.v, perturbed.a, &perturbed.phi))
            continue;
#endif
        for (int k = 0; k < N_Q; k++) {
            q_error[k] += fabs(perturbed.q[k] - position->q[k]);
            v_error[k] += fabs(perturbed.v[k] - position->v[k]);
        }
    }
    compute_largest_speeds(position, run->extent, speed);
    for (int k = 0; k < N_Q; k++)
        v_error[k] += ACCUMULATED_ULPS * DBL_EPSILON * speed[k % 3 == 2];
    estimate_error_by_bounds(position->t, position->q, position->v, q_error, v_error, N_Q, &(DiscreteState){0}, run->p,
        sample->uncertainty);
    sample->has_uncertainty = 1;
    return sample->uncertainty[FIRST_USER_EVENT + i];
}

/*
 * Return the value of event function i, whose last sign is `last_sign` (0: none); 0 if the value is below its
 * uncertainty. A value with the last sign is returned as it is.
 */
static double get_significant_event_value(const KinematicRun *run, SampledPosition *sample, int i, int last_sign)
{
    const double f = sample->event[i];
    return last_sign * f > 0.0 || !(fabs(f) <= estimate_event_uncertainty(run, sample, i)) ? f : 0.0;
}

/*
 * The search for events. From Python: last signs, arrays of times and numbers, their capacity. Of the current step: its
 * length, the largest bound of each event function, the positions at the beginning of the current part (`begin`) and at
 * the ends of this and the n - 1 later parts (`end`), the last status.
 */
typedef struct {
    KinematicRun *run;
    signed char *last_sign;
    double *t;
    int *event;
    long n_found, capacity;
    double run_begin; /* s: a zero on which it begins is not crossed */
    int can_stop;     /* whether an event may end the run */
    unsigned char is_reported_undefined[N_USER_EVENTS]; /* reported as undefined */
    double h, max_bound[N_USER_EVENTS];
    SampledPosition begin, *end;
    int n, status;
    SampledPosition low, high; /* of event function i, before and after the zero that is located */
    int i;
} Search;

/*
 * Advance `sample` to time t1: follow the motion from its position in steps, and evaluate the event functions at t1.
 * Return 0 or a status.
 */
static int advance_sample(const Search *search, double t1, SampledPosition *sample)
{
    StepLength step_length = {t1 - sample->position.t, 0};
    while (sample->position.t < t1) {
        const int status = make_step(search->run, &step_length, t1, &sample->position);
        if (status)
            return status;
    }
    evaluate_sample_events(search->run, sample);
    return 0;
}

/*
 * Return `value` with the sign that makes it negative after the zero: -value if end_value is positive, else value. If
 * both are NaN, return -1; if only one of them is, 1.
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
    const int status = advance_sample(search, t, &sample);
    out->f = orient_event_value(search->high.event[search->i], sample.event[search->i]);
    *(out->f < 0.0 ? &search->high : &search->low) = sample;
    return status;
}

/*
 * Locate the time *t before sample b at which event function i gets its sign at b, or becomes NaN as there, from
 * search->begin on. is_pole: set to 1 for a pole instead of a zero. Return 0 or a status.
 */
static int locate_event(Search *search, int i, const SampledPosition *b, double *t, int *is_pole)
{
    const double t_begin = search->begin.position.t, t_end = b->position.t, end = b->event[i];
    const ZeroTolerance tolerance = {.width = max_of(1e-13 * (t_end - t_begin), 4.0 * DBL_EPSILON * fabs(t_end))};
    Bracket bracket = {{{t_begin, orient_event_value(end, search->begin.event[i]), NAN},
        {t_end, orient_event_value(end, end), NAN}}, 2};
    search->low = search->begin, search->high = *b, search->i = i;
    const double guess = estimate_zero(&bracket, 2);
    const int status = locate_zero(evaluate_event, search, &tolerance, MAX_POINTS, guess, &bracket);
    if (status)
        return status;
    *t = bracket.at[1].s;
    const int is_undefined = advance_sample(search, *t + POLE_DISTANCE * tolerance.width, &search->low);
    *is_pole = is_near_pole(search->high.event[i], is_undefined ? INFINITY : search->low.event[i])
        && get_significant_event_value(search->run, &search->high, i, 0) != 0.0;
    return 0;
}

/*
 * Insert an event at time t (s) in order of time among the found ones from index `first` on. event: its number; plus
 * N_USER_EVENTS if it became undefined. Return 0, or EVENTS_FULL without a change if there is no capacity.
 */
static int insert_event(Search *search, long first, double t, int event)
{
    long k = search->n_found;
    if (k == search->capacity)
        return EVENTS_FULL;
    for (; k > first && search->t[k - 1] > t; k--) {
        search->t[k] = search->t[k - 1];
        search->event[k] = search->event[k - 1];
    }
    search->t[k] = t;
    search->event[k] = event;
    search->n_found++;
    return 0;
}

/*
 * Locate and collect all events of the part from search->begin to b, and update the last signs. Poles and zeros at the
 * start of the run are not events. A function that becomes undefined is reported once. Return 0 or a status;
 * EVENT_STOPS after an event that ends the run, of which later ones are discarded.
 */
static int collect_events(Search *search, SampledPosition *b)
{
    const SampledPosition *a = &search->begin;
    const long first = search->n_found;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        double t = a->position.t;
        int is_pole = 0, status = 0;
        if (isnan(b->event[i]) && !search->is_reported_undefined[i]) {
            search->is_reported_undefined[i] = 1;
            status = isnan(a->event[i]) ? 0 : locate_event(search, i, b, &t, &is_pole);
            if (!status)
                status = insert_event(search, first, t, i + N_USER_EVENTS);
        } else if (detect_event_crossing(i, &search->last_sign[i],
                       get_significant_event_value(search->run, b, i, search->last_sign[i]))) {
            status = locate_event(search, i, b, &t, &is_pole);
            const double rounding = 1e-12 * (b->position.t - a->position.t) + 16.0 * DBL_EPSILON * fabs(t);
            if (!status && !is_pole && t - search->run_begin > rounding)
                status = insert_event(search, first, t, i);
        }
        if (status)
            return status;
    }
    for (long k = first; k < search->n_found; k++)
        if (search->can_stop && search->event[k] < N_USER_EVENTS && event_stops[search->event[k]]) {
            search->n_found = k + 1;
            return EVENT_STOPS;
        }
    return 0;
}

/*
 * Return whether event function i is identically zero up to b, like a velocity that a constraint holds at zero. It is
 * zero within its uncertainty at both ends. Its bounds f are within MAX_UNCERTAINTY_RATIO uncertainties, or narrow with
 * the length of the part.
 */
static int is_zero_by_constraint(Search *search, SampledPosition *b, int i, Interval f)
{
    const double fraction = (b->position.t - search->begin.position.t) / search->h, bound = max_of(-f.lo, f.hi);
    const double error = estimate_event_uncertainty(search->run, &search->begin, i);
    return !f.may_be_undefined && fabs(search->begin.event[i]) <= error
        && (bound <= MAX_UNCERTAINTY_RATIO * error || is_bound_narrowing(-bound, fraction, -search->max_bound[i]))
        && get_significant_event_value(search->run, b, i, 0) == 0.0;
}

/*
 * Compute bounds of positions q and velocities v (N_Q intervals each) over the cubic Hermite interpolant between
 * positions a and b. Each Interval has bounds of the value, and of its derivative with respect to the fraction s of the
 * part (0 <= s <= 1). The bounds of dq/ds contain both ends and the extremum of that quadratic. The bounds of q follow
 * from the bounds of dq/ds, from both ends; v is dq/ds divided by the length of the part in s.
 */
static void bound_motion(const Position *a, const Position *b, Interval *q, Interval *v)
{
    const double h = b->t - a->t;
    for (int k = 0; k < N_Q; k++) {
        const double change = b->q[k] - a->q[k], slope_0 = h * a->v[k], slope_1 = h * b->v[k];
        /* q = q0 + slope_0 s + c2 s^2 + c3 s^3, 0 <= s <= 1 */
        const double c2 = 3.0 * change - 2.0 * slope_0 - slope_1, c3 = slope_0 + slope_1 - 2.0 * change;
        const double end_curvature = 2.0 * c2 + 6.0 * c3, s_extremum = -c2 / (3.0 * c3);
        const double extremum = s_extremum > 0.0 && s_extremum < 1.0
            ? slope_0 + s_extremum * (2.0 * c2 + 3.0 * s_extremum * c3) : slope_0;
        const double min_slope = min_of(extremum, min_of(slope_0, slope_1));
        const double max_slope = max_of(extremum, max_of(slope_0, slope_1));
        q[k] = (Interval){max_of(a->q[k] + min_of(min_slope, 0.0), b->q[k] - max_of(max_slope, 0.0)),
            min_of(a->q[k] + max_of(max_slope, 0.0), b->q[k] - min_of(min_slope, 0.0)), min_slope, max_slope, 0};
        v[k] = (Interval){min_slope / h, max_slope / h, min_of(2.0 * c2, end_curvature) / h,
            max_of(2.0 * c2, end_curvature) / h, 0};
    }
}

/*
 * Return whether interval bounds leave open a zero of some event function between search->begin and b that the signs at
 * both ends do not show. For a whole step, the largest bounds are stored in search->max_bound.
 */
static int may_have_hidden_zero(Search *search, SampledPosition *b)
{
    const SampledPosition *a = &search->begin;
    const double h = b->position.t - a->position.t;
    Interval q[N_Q], v[N_Q], out[N_MONITORED];
    bound_motion(&a->position, &b->position, q, v);
    bound_monitored_functions((Interval){a->position.t, b->position.t, h, h, 0}, q, v, &(DiscreteState){0},
        search->run->p, out);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Interval f = out[FIRST_USER_EVENT + i];
        const double sign = f.hi <= 0.0 || a->event[i] < 0.0 ? -1.0 : 1.0;
        if (h == search->h)
            search->max_bound[i] = max_of(-f.lo, f.hi);
        const Interval bounds = sign < 0.0 ? interval_negative(f) : f;
        if (classify_zero(bounds, sign * a->event[i], sign * b->event[i], 1.0, 0) < 0
            && !is_zero_by_constraint(search, b, i, f))
            return 1;
    }
    return 0;
}

/*
 * Classify the part of a step from search->begin to the last of search->end, as a callback of bisect_interval(). If the
 * part may have a hidden zero, is not smallest, and its middle can be solved, push the middle onto the stack
 * search->end and return -1: bisect. Otherwise collect its events, pop its end from the stack and make it
 * search->begin; return 0, or 1 if search->status ends the search. a, b: times of its ends, s.
 */
static int classify_subinterval(void *context, double a, double b, int is_smallest)
{
    Search *search = context;
    SampledPosition *end = &search->end[search->n - 1];
    if (!is_smallest && may_have_hidden_zero(search, end)) {
        end[1] = search->begin;
        if (!advance_sample(search, a + 0.5 * (b - a), &end[1])) {
            search->n++;
            return -1;
        }
    }
    search->status = collect_events(search, end);
    search->begin = *end;
    search->n--;
    return search->status != 0;
}

/*
 * Find the events from search->begin to time t1, the next sample, step by step. search->begin becomes the sample at t1.
 * Return 0 or a status.
 */
static int find_events_in_interval(Search *search, double t1)
{
    StepLength step_length = {t1 - search->begin.position.t, 0};
    int status = 0;
    while (!status && search->begin.position.t < t1) {
        *search->end = search->begin;
        status = make_step(search->run, &step_length, t1, &search->end->position);
        if (status)
            return status;
        evaluate_sample_events(search->run, search->end);
        search->n = 1;
        search->h = search->end->position.t - search->begin.position.t;
        (void)bisect_interval(search->begin.position.t, search->end->position.t, MIN_PART_FRACTION * search->h,
            classify_subinterval, search);
        status = search->status;
    }
    return status;
}

/*
 * Find the user-defined events in the intervals between n + 1 samples of a kinematic motion, in order of time.
 * run_begin: time at which the run began, s; can_stop: whether an event may end it. last_sign: last signs, updated;
 * event_time, event: times (s) and numbers of `n_found` events; n_done: number of complete intervals. Return 0,
 * EVENT_STOPS after an event that ends the run, EVENTS_FULL if the capacity is used up, STOPPED, or the status of the
 * motion. An interval that is not complete is searched again by the next call.
 */
int gudgeon_kinematic_events(void *analysis, long n, const double *t, const double *parameters, const double *q,
    const double *v, double run_begin, int can_stop, signed char *last_sign, long capacity, double *event_time,
    int *event, long *n_found, long *n_done)
{
    KinematicRun *run = analysis;
    SampledPosition end[MAX_PART_HALVINGS + 2];
    Search search = {.run = run, .last_sign = last_sign, .t = event_time, .event = event, .capacity = capacity,
        .run_begin = run_begin, .can_stop = can_stop, .end = end};
    run->p = (const Parameters *)parameters;
    for (*n_done = 0; *n_done < n; ++*n_done) {
        signed char signs[N_USER_EVENTS];
        const long row = *n_done * N_Q;
        int status = set_initial_position(run, t[*n_done], q + row, v + row, &search.begin.position);
        if (status)
            return status;
        evaluate_sample_events(run, &search.begin);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            (void)detect_event_crossing(
                i, &last_sign[i], last_sign[i] ? 0.0 : get_significant_event_value(run, &search.begin, i, 0));
            signs[i] = last_sign[i]; /* the first sign, if there was none */
        }
        *n_found = search.n_found;
        status = find_events_in_interval(&search, t[*n_done + 1]);
        if (run->cancellation.stop)
            status = STOPPED; /* events of this interval are discarded */
        if (status == EVENTS_FULL || status == STOPPED)
            memcpy(last_sign, signs, sizeof signs);
        else
            *n_found = search.n_found;
        if (status)
            return status;
    }
    return 0;
}
