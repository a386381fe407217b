/* User-defined events: their list, their signs, and events at the start and end of a run. */
#define SAME_ZERO_RESOLUTIONS 4.0 /* times the time resolution: closer zeros of one function count as one */
#define COINCIDENCE_S 1e-11 /* s: events closer to the start or end of a run are at it; above the time resolution */
#define COINCIDENCE_FRACTION 1e-9 /* of the time in which a fast motion crosses the mechanism */

/* Append a user-defined event at time t (s) to the list, without its state; a full list is left unchanged. */
static void append_user_event(Integrator *run, int event, double t)
{
    if (run->events.n < LISTED_EVENTS) {
        run->events.t[run->events.n] = t;
        run->events.number[run->events.n++] = event;
    }
}

/* Store whether the user-defined event that ends a step is a pole of its function instead of a zero. */
static inline void set_pole_flag(Integrator *run, int is_pole) { run->events.pole = is_pole; }

/*
 * Record a user-defined event at time t (s) with the integrated state there, and return whether the event ends the run
 * (event_stops, if events may stop it). A second event of the same function within SAME_ZERO_RESOLUTIONS of the time
 * resolution counts as the same zero: nothing is recorded and 0 is returned. A full list is left unchanged.
 */
static int record_user_event(Integrator *run, int event, double t, const double *state_vector, const Parameters *p)
{
#if N_USER_EVENTS
    EventStates *states = get_event_states(run);
    const double t_first = t - SAME_ZERO_RESOLUTIONS * run->roots.time_resolution;
    for (int k = run->events.n - 1; k >= 0 && run->events.t[k] >= t_first; k--)
        if (run->events.number[k] == event)
            return 0; /* within the time resolution: the same zero, crossed again by rounding */
    if (run->events.n < LISTED_EVENTS)
        store_sample(run, t, state_vector, p, run->events.n, states->y[0], states->discrete_states[0],
            states->contact_codes[0]);
    append_user_event(run, event, t);
    return run->events.stop && event_stops[event];
#else
    (void)run, (void)event, (void)t, (void)state_vector, (void)p;
    return 0;
#endif
}

/*
 * Reverse the stored sign of a user-defined event at its zero, and return whether this direction (rising or falling)
 * counts as an event. Called when a located zero ends a step.
 */
static int reverse_event_sign(Integrator *run, int event)
{
    const int sign = -run->discrete.event_sign[event];
    run->discrete.event_sign[event] = (signed char)sign;
    return event_direction[event] * sign >= 0;
}

/*
 * Record once in a run that a user-defined event function is NaN at time t (s): listed with number event +
 * N_USER_EVENTS. Called when a user-defined event function is evaluated as NaN.
 */
static void record_nan_event(Integrator *run, int event, double t)
{
    if (!run->events.is_nan_reported[event])
        append_user_event(run, event + N_USER_EVENTS, t);
    run->events.is_nan_reported[event] = 1;
}

/*
 * Set the unset signs (0) of user-defined events that began at zero, or were held there, from their values at a state
 * y, without recording an event. rhs: outputs at y. Signs that are known stay. Called after each accepted step, and
 * inside a step that a contact or friction event ends.
 */
static void update_event_signs(Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p)
{
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    int has_zero = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        has_zero |= run->discrete.event_sign[i] == 0;
    if (!has_zero)
        return;
    evaluate_significant_events(run, t, y, rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (run->discrete.event_sign[i] == 0)
            detect_event_crossing(i, &run->discrete.event_sign[i], value[i]);
}

/*
 * Record user-defined events that a sudden change of the state led across zero, and return ENDED if one of them ends
 * the run, else 0. An event is crossed if its value has left the stored sign event_sign in the event's direction
 * (detect_event_crossing()); event_sign is updated. values_before (N_USER_EVENTS): values before the change, of which
 * the same sign as now excludes an event; NULL: any sign. Called after impacts, impulses of drives and changes of
 * branches or modes.
 */
static int record_crossed_events(Integrator *run, const double *values_before, const Parameters *p)
{
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    int status = 0;
    evaluate_significant_events(run, run->t, run->y, &run->rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if ((!values_before || !have_same_sign(values_before[i], value[i]))
            && detect_event_crossing(i, &run->discrete.event_sign[i], value[i])
                && record_user_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

#if N_USER_EVENTS
/*
 * Evaluate the user-defined event functions `duration` seconds after the state y at time t, extrapolated along its
 * rates dy, into `values` (N_USER_EVENTS). Values below their uncertainty are 0; all are 0 if the evaluation fails.
 * Return a status.
 */
static int extrapolate_event_functions(Integrator *run, double t, double duration, const double *y, const double *dy,
    const Parameters *p, double *values)
{
    double y_after[N_Y], dy_unused[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        y_after[k] = y[k] + duration * dy[k];
    const int status = evaluate_run_rhs(run, t + duration, y_after, p, dy_unused, &rhs);
    for (int i = 0; i < N_USER_EVENTS; i++)
        values[i] = 0.0;
    if (!status)
        evaluate_significant_events(run, t + duration, y_after, &rhs, p, values);
    return status;
}

/*
 * Evaluate the right-hand side `duration` seconds after the current time, along the current rates, and update and
 * freeze the branches that hold there. rhs_after: the outputs. The discrete state of the run is changed; callers that
 * need it restore it. Return a status.
 */
static int evaluate_rates_just_after(Integrator *run, double duration, const Parameters *p, RhsOutputs *rhs_after)
{
    double y[N_Y], dy[N_Y];
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + duration * run->dy[k];
    if (!run->discrete.is_frozen)
        freeze_branches(run);
    return update_branches_at(run, run->t + duration, y, dy, rhs_after, -1, p);
}

/*
 * Return the time difference in s within which an event counts as at the start or end of a run. It is
 * COINCIDENCE_FRACTION of the time scale of the state; of fixed_step (s) if that is positive. It is COINCIDENCE_S at
 * most and at least 4 ulp of the time. Used where events at the start and end of a run are found.
 */
static double compute_coincidence_time(const Integrator *run, double fixed_step)
{
    double rate = 0.0;
    for (int k = 0; k < N_X && !(fixed_step > 0.0); k++) {
        const double scale = run->norm.min_size[is_angle[k]];
        rate = max_of(rate, max_of(fabs(run->y[N_X + k]) / scale, sqrt(fabs(run->dy[N_X + k]) / scale)));
    }
    const double limit = min_of(COINCIDENCE_S, COINCIDENCE_FRACTION * (fixed_step > 0.0 ? fixed_step : 1.0 / rate));
    return max_of(4.0 * DBL_EPSILON * fabs(run->t), limit);
}

/*
 * Compute the sign of each user-defined event function just after the current time into `signs`. A value below its
 * uncertainty is evaluated again up to 1e9 coincidence times later; 0 if it then has no sign. fixed_step: see
 * compute_coincidence_time(). Return a status.
 *
 * The signs depend on the state alone. A run that ends here records events with other signs; a run that begins here
 * starts with these signs. Each event of a run that is divided anywhere is therefore recorded once. Branches of
 * switching functions are updated to those just after the current time, and stay so.
 */
static int compute_event_signs_just_after(Integrator *run, double fixed_step, const Parameters *p, signed char *signs)
{
    const double h = compute_coincidence_time(run, fixed_step);
    double error[N_MONITORED], value_later[N_USER_EVENTS];
    int has_unknown = 0;
    RhsOutputs rhs_after;
    const int status = evaluate_rates_just_after(run, h, p, &rhs_after);
    if (status)
        return status;
    estimate_rounding_uncertainty(run, run->t, run->y, p, error);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const double value_after = rhs_after.event[i];
        signs[i] = (signed char)(fabs(value_after) > error[N_MONITORED - N_USER_EVENTS + i]
            ? (value_after > 0.0) - (value_after < 0.0) : 0);
        has_unknown |= !signs[i];
    }
    for (double later = 1e3 * h; has_unknown && later < 1e10 * h; later *= 1e3) {
        const int is_evaluated = !extrapolate_event_functions(run, run->t, later, run->y, run->dy, p, value_later);
        for (int i = 0; i < N_USER_EVENTS; i++)
            if (is_evaluated && !signs[i])
                signs[i] = (signed char)((value_later[i] > 0.0) - (value_later[i] < 0.0));
    }
    return 0;
}

/*
 * Record user-defined events whose zero, or jump across it, is at the last time of a run: their sign just after it
 * differs from the stored one. Stored signs are updated; the rest of the discrete state is restored. fixed_step: see
 * compute_coincidence_time(). Return ENDED if one of the events ends the run, else 0, also if the signs cannot be
 * computed. Called once, when the time loop reaches the last output time.
 */
static int record_user_events_at_run_end(Integrator *run, double fixed_step, const Parameters *p)
{
    const DiscreteState discrete_before = run->discrete;
    signed char sign[N_USER_EVENTS];
    const int failed = compute_event_signs_just_after(run, fixed_step, p, sign);
    int status = 0;
    run->discrete = discrete_before;
    for (int i = 0; i < N_USER_EVENTS && !failed; i++)
        if (detect_event_crossing(i, &run->discrete.event_sign[i], sign[i])
            && record_user_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

/*
 * Set the signs of user-defined event functions and the branches to those just after the start of a run. A sign of 0
 * keeps the stored one. With a positive fixed_step (length of steps that do not freeze branches, s) branches stay as
 * they were. If branches change, the right-hand side is evaluated again. Return a status. Called once, by
 * begin_integration().
 */
static int initialize_event_signs(Integrator *run, double fixed_step, const Parameters *p)
{
    signed char sign[N_USER_EVENTS];
    const DiscreteState discrete_before = run->discrete;
    const int status = compute_event_signs_just_after(run, fixed_step, p, sign);
    if (fixed_step > 0.0)
        run->discrete = discrete_before;
    for (int i = 0; i < N_USER_EVENTS && !status; i++)
        run->discrete.event_sign[i] = sign[i] ? sign[i] : run->discrete.event_sign[i];
    if (status || !memcmp(discrete_before.branch, run->discrete.branch, sizeof discrete_before.branch))
        return status;
    return evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
}
#else
/* Return the status 0: the scene has no user-defined events. */
static inline int record_user_events_at_run_end(Integrator *run, double fixed_step, const Parameters *p)
{
    return (void)run, (void)fixed_step, (void)p, 0;
}

/* Return the status 0: the scene has no user-defined events. */
static inline int initialize_event_signs(Integrator *run, double fixed_step, const Parameters *p)
{
    return (void)run, (void)fixed_step, (void)p, 0;
}
#endif

#if N_USER_EVENTS && (N_FRICTIONS || N_RIGID)
/*
 * The state before friction changes mode or a rigid contact begins, after which an event function may be held at zero.
 */
typedef struct {
    DiscreteState discrete;
    double y[N_Y], dy[N_Y], event[N_USER_EVENTS];
} StateBeforeEvent;

/*
 * Return a copy of the discrete state, state, rates and event functions of a run, before an event changes them. Called
 * by apply_event(), which passes it to record_events_at_constraint().
 */
static StateBeforeEvent copy_state_before_event(const Integrator *run)
{
    StateBeforeEvent copy = {.discrete = run->discrete};
    memcpy(copy.y, run->y, sizeof copy.y);
    memcpy(copy.dy, run->dy, sizeof copy.dy);
    memcpy(copy.event, run->rhs.event, sizeof copy.event);
    return copy;
}

/*
 * Return whether an event has added a constraint: a friction element sticks, or a rigid contact is closed, in
 * discrete_after but not in discrete_before.
 */
static int has_new_constraint(const DiscreteState *discrete_before, const DiscreteState *discrete_after)
{
    int is_new = 0;
    for (int i = 0; i < N_FRICTIONS; i++)
        is_new |= discrete_after->mode[i] == 0.0 && discrete_before->mode[i] != 0.0;
    for (int i = 0; i < N_CLEARANCES; i++)
        is_new |= !is_compliant(i) && discrete_after->contact[i].closed && !discrete_before->contact[i].closed;
    return is_new;
}

/*
 * Record event functions that reach zero because an event has added a constraint that keeps them there: a closed rigid
 * contact or a stick. Nothing is done if no constraint is new and no stored sign is 0. Each function is compared at
 * `duration` seconds later with its value there without the event:
 *
 * 1. A function with the stored sign 0 that moves from zero gets its sign. No event is recorded.
 *
 * 2. A function that is zero with a new constraint and was not zero before gets the sign 0. If it would have crossed
 * zero or has just reached it, an event is recorded, if the event counts this direction.
 *
 * 3. A function that was zero before stays as it is.
 *
 * Return ENDED if a recorded event ends the run, else 0. Called by apply_event() after all changes.
 */
static int record_events_at_constraint(Integrator *run, const StateBeforeEvent *state_before, double duration,
    const Parameters *p)
{
    double error[N_MONITORED], value_after[N_USER_EVENTS], value_without[N_USER_EVENTS];
    const int has_constraint = has_new_constraint(&state_before->discrete, &run->discrete);
    int has_zero = 0, status = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        has_zero |= run->discrete.event_sign[i] == 0;
    if (!has_constraint && !has_zero)
        return 0;
    DiscreteState discrete = run->discrete;
    /* of the state before: slips that were just stopped count */
    estimate_rounding_uncertainty(run, run->t, state_before->y, p, error);
    (void)extrapolate_event_functions(run, run->t, duration, run->y, run->dy, p, value_after);
    run->discrete = state_before->discrete;
    (void)extrapolate_event_functions(run, run->t, duration, state_before->y, state_before->dy, p, value_without);
    run->discrete = discrete;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        signed char *event_sign = &run->discrete.event_sign[i];
        const double uncertainty = error[N_MONITORED - N_USER_EVENTS + i];
        const int sign_before = *event_sign,
                  is_moving = fabs(value_after[i]) > uncertainty + 0.01 * fabs(value_without[i]);
        if (sign_before == 0 && is_moving)
            detect_event_crossing(i, event_sign, value_after[i]);
        if (sign_before == 0 || is_moving || !has_constraint || !(fabs(run->rhs.event[i]) <= uncertainty))
            continue;
        const int reaches_zero = sign_before * state_before->event[i] > uncertainty
            || sign_before * value_without[i] < -uncertainty;
        if (reaches_zero || sign_before * value_without[i] > uncertainty)
            *event_sign = 0;
        if (reaches_zero && event_direction[i] * sign_before <= 0 && record_user_event(run, i, run->t, run->y, p))
            status = ENDED;
    }
    return status;
}
#else
/* Placeholder: nothing can hold an event function at zero in this scene. */
typedef struct {
    int none;
} StateBeforeEvent;

/* Return a placeholder: nothing can hold an event function at zero in this scene. */
static StateBeforeEvent copy_state_before_event(const Integrator *run) { return (void)run, (StateBeforeEvent){0}; }

/* Return the status 0: nothing can hold an event function at zero in this scene. */
static int record_events_at_constraint(Integrator *run, const StateBeforeEvent *state_before, double duration,
    const Parameters *p)
{
    return (void)run, (void)state_before, (void)duration, (void)p, 0;
}
#endif

/* Set whether user-defined events that are declared to end the run may do so. */
void gudgeon_run_enable_end_events(void *integrator, int stop) { ((Integrator *)integrator)->events.stop = stop; }

/* Remove all user-defined events from the list, whose records the caller does not need. */
static void discard_user_events(Integrator *run) { run->events.n = 0; }

/*
 * Move the oldest user-defined events, at most `capacity`, from the list into these arrays: times t (s), numbers, and
 * states there as rows of samples (y, discrete states, contact codes). A number from N_USER_EVENTS on means NaN. Return
 * how many were moved.
 */
int gudgeon_run_events(void *integrator, int capacity, double *t, int *event, double *y, double *discrete,
    signed char *codes)
{
    Integrator *run = integrator;
    const int count = run->events.n < capacity ? run->events.n : capacity, n_remaining = run->events.n - count;
    for (int i = 0; i < count; i++) {
        t[i] = run->events.t[i];
        event[i] = run->events.number[i];
    }
#if N_USER_EVENTS
    EventStates *states = get_event_states(run);
    memcpy(y, states->y, (size_t)count * sizeof states->y[0]);
    memcpy(discrete, states->discrete_states, (size_t)count * sizeof states->discrete_states[0]);
    memcpy(codes, states->contact_codes, (size_t)count * sizeof states->contact_codes[0]);
    memmove(states->y, states->y + count, (size_t)n_remaining * sizeof states->y[0]);
    memmove(states->discrete_states, states->discrete_states + count,
        (size_t)n_remaining * sizeof states->discrete_states[0]);
    memmove(states->contact_codes, states->contact_codes + count,
        (size_t)n_remaining * sizeof states->contact_codes[0]);
#else
    (void)y, (void)discrete, (void)codes;
#endif
    memmove(run->events.t, run->events.t + count, (size_t)n_remaining * sizeof run->events.t[0]);
    memmove(run->events.number, run->events.number + count, (size_t)n_remaining * sizeof run->events.number[0]);
    run->events.n = n_remaining;
    return count;
}
