/* User-defined events: their list, their signs, and events at the start and end of a run. */
#define SAME_ZERO_RESOLUTIONS 4.0 /* times the time resolution: closer zeros of one function count as one */
#define COINCIDENCE_S 1e-11 /* s: events closer to the start or end of a run are at it; above the time resolution */
#define COINCIDENCE_FRACTION 1e-9 /* of the time in which a fast motion crosses the mechanism */

/* Append user-defined event i at time t (s) to the list, if the list has space. */
static void append_event(Integrator *run, int i, double t)
{
    if (run->events.n < LISTED_EVENTS) {
        run->events.t[run->events.n] = t;
        run->events.number[run->events.n++] = i;
    }
}

/* Store whether the event that ends a step is a pole instead of a zero. */
static inline void set_pole(Integrator *run, int is_pole) { run->events.pole = is_pole; }

/* Record user-defined event i at time t with the state there, and return whether the event ends the run. */
static int record_user_event(Integrator *run, int i, double t, const double *now, const Parameters *p)
{
#if N_USER_EVENTS
    EventStates *at = event_states(run);
    const double first = t - SAME_ZERO_RESOLUTIONS * run->roots.time_resolution;
    for (int k = run->events.n - 1; k >= 0 && run->events.t[k] >= first; k--)
        if (run->events.number[k] == i)
            return 0; /* within the time resolution: the same zero, crossed again by rounding */
    if (run->events.n < LISTED_EVENTS)
        store_sample(run, t, now, p, run->events.n, at->y[0], at->latched[0], at->state[0]);
    append_event(run, i, t);
    return run->events.stop && event_stops[i];
#else
    (void)run, (void)i, (void)t, (void)now, (void)p;
    return 0;
#endif
}

/* Reverse the sign of user-defined event i at its zero, and return whether this direction counts as an event. */
static int reverse_event_sign(Integrator *run, int i)
{
    const int to = -run->discrete.event_sign[i];
    run->discrete.event_sign[i] = (signed char)to;
    return event_direction[i] * to >= 0;
}

/* Record once in a run that user-defined event i is NaN at time t: listed with number i + N_USER_EVENTS. */
static void record_nan_event(Integrator *run, int i, double t)
{
    if (!run->events.no_number[i])
        append_event(run, i + N_USER_EVENTS, t);
    run->events.no_number[i] = 1;
}

/* Set the signs of user-defined events that began at zero, or were held there, from their values at a state. */
static void update_event_signs(Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p)
{
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    int zeros = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        zeros |= run->discrete.event_sign[i] == 0;
    if (!zeros)
        return;
    evaluate_resolved_events(run, t, y, rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (run->discrete.event_sign[i] == 0)
            event_crosses(i, &run->discrete.event_sign[i], value[i]);
}

/*
 * Record user-defined events that a sudden change led across zero, and return ENDED if one of them ends the run.
 * before: their values before the change, NULL: any.
 */
static int record_crossed_events(Integrator *run, const double *before, const Parameters *p)
{
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    int status = 0;
    evaluate_resolved_events(run, run->t, run->y, &run->rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if ((!before || !have_same_sign(before[i], value[i]))
            && event_crosses(i, &run->discrete.event_sign[i], value[i]) && record_user_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

#if N_USER_EVENTS
/*
 * Evaluate the user-defined event functions `ahead` seconds after a state, along its rates; 0 below their uncertainty.
 */
static int evaluate_events_ahead(Integrator *run, double t, double ahead, const double *y, const double *dy,
    const Parameters *p, double *value)
{
    double there[N_Y], scrap[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        there[k] = y[k] + ahead * dy[k];
    const int status = rates(run, t + ahead, there, p, scrap, &rhs);
    for (int i = 0; i < N_USER_EVENTS; i++)
        value[i] = 0.0;
    if (!status)
        evaluate_resolved_events(run, t + ahead, there, &rhs, p, value);
    return status;
}

/*
 * Evaluate the right-hand side `h` seconds after the present time, and update and freeze the branches that hold there.
 */
static int evaluate_just_after(Integrator *run, double h, const Parameters *p, RhsOutputs *beyond)
{
    double y[N_Y], dy[N_Y];
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    if (!run->discrete.held)
        freeze_branches(run);
    return update_branches_at(run, run->t + h, y, dy, beyond, -1, p);
}

/*
 * Return the time difference in s within which an event counts as at the start or end of a run. It depends on the state
 * alone, and for rk4 on its step length `step`.
 */
static double coincidence_time(const Integrator *run, double step)
{
    double rate = 0.0;
    for (int k = 0; k < N_X && !(step > 0.0); k++) {
        const double least = run->norm.least[is_angle[k]];
        rate = max_of(rate, max_of(fabs(run->y[N_X + k]) / least, sqrt(fabs(run->dy[N_X + k]) / least)));
    }
    const double near = min_of(COINCIDENCE_S, COINCIDENCE_FRACTION * (step > 0.0 ? step : 1.0 / rate));
    return max_of(4.0 * DBL_EPSILON * fabs(run->t), near);
}

/*
 * Compute the sign of each user-defined event function just after the present time, 0 if it stays below its
 * uncertainty. The signs depend on the state alone. A run that ends here records events with other signs; a run that
 * begins here starts with these signs. Each event of a run that is divided anywhere is therefore recorded once.
 * Branches of switching functions are updated to those just after the present time.
 */
static int event_signs_after(Integrator *run, double step, const Parameters *p, signed char *branch)
{
    const double h = coincidence_time(run, step);
    double error[N_WATCHED], value[N_USER_EVENTS];
    int unknown = 0;
    RhsOutputs beyond;
    const int status = evaluate_just_after(run, h, p, &beyond);
    if (status)
        return status;
    uncertainty(run, run->t, run->y, p, error);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const double f = beyond.event[i];
        branch[i] = (signed char)(fabs(f) > error[N_WATCHED - N_USER_EVENTS + i] ? (f > 0.0) - (f < 0.0) : 0);
        unknown |= !branch[i];
    }
    for (double ahead = 1e3 * h; unknown && ahead < 1e10 * h; ahead *= 1e3) {
        const int known = !evaluate_events_ahead(run, run->t, ahead, run->y, run->dy, p, value);
        for (int i = 0; i < N_USER_EVENTS; i++)
            if (known && !branch[i])
                branch[i] = (signed char)((value[i] > 0.0) - (value[i] < 0.0));
    }
    return 0;
}

/*
 * Record events whose zero, or jump across it, is at the end of the run; step: length of fixed steps, 0 otherwise.
 * Return ENDED if one of them ends the run.
 */
static int record_events_at_end(Integrator *run, double step, const Parameters *p)
{
    const DiscreteState discrete = run->discrete;
    signed char branch[N_USER_EVENTS];
    const int failed = event_signs_after(run, step, p, branch);
    int status = 0;
    run->discrete = discrete;
    for (int i = 0; i < N_USER_EVENTS && !failed; i++)
        if (event_crosses(i, &run->discrete.event_sign[i], branch[i]) && record_user_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

/*
 * Start with the signs of event functions and the branches just after the start. Branches stay as they were for rk4,
 * whose steps of length `step` do not freeze them; step = 0: another method.
 */
static int start_just_after(Integrator *run, double step, const Parameters *p)
{
    signed char branch[N_USER_EVENTS];
    const DiscreteState before = run->discrete;
    const int status = event_signs_after(run, step, p, branch);
    if (step > 0.0)
        run->discrete = before;
    for (int i = 0; i < N_USER_EVENTS && !status; i++)
        run->discrete.event_sign[i] = branch[i] ? branch[i] : run->discrete.event_sign[i];
    if (status || !memcmp(before.branch, run->discrete.branch, sizeof before.branch))
        return status;
    return rates(run, run->t, run->y, p, run->dy, &run->rhs);
}
#else
/* Return 0: the scene has no user-defined events. */
static inline int record_events_at_end(Integrator *run, double step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, 0;
}

/* Return 0: the scene has no user-defined events. */
static inline int start_just_after(Integrator *run, double step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, 0;
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

/* Return a copy of the discrete state, state, rates and event functions before an event. */
static StateBeforeEvent copy_before_event(const Integrator *run)
{
    StateBeforeEvent before = {.discrete = run->discrete};
    memcpy(before.y, run->y, sizeof before.y);
    memcpy(before.dy, run->dy, sizeof before.dy);
    memcpy(before.event, run->rhs.event, sizeof before.event);
    return before;
}

/* Return whether friction sticks or a rigid contact is closed now that was not `before`. */
static int is_more_held(const DiscreteState *before, const DiscreteState *now)
{
    int more = 0;
    for (int i = 0; i < N_FRICTIONS; i++)
        more |= now->mode[i] == 0.0 && before->mode[i] != 0.0;
    for (int i = 0; i < N_CLEARANCES; i++)
        more |= !gives(i) && now->contact[i].closed && !before->contact[i].closed;
    return more;
}

/*
 * Record event functions that reach zero and are held there from now on, unless they were at zero before. A function
 * that was held and moves again gets its sign without an event. Whether it is held follows from its value `ahead`
 * seconds later, with and without the change. Return ENDED if one of them ends the run.
 */
static int record_arrivals_at_zero(Integrator *run, const StateBeforeEvent *before, double ahead, const Parameters *p)
{
    double error[N_WATCHED], now[N_USER_EVENTS], then[N_USER_EVENTS];
    const int more = is_more_held(&before->discrete, &run->discrete);
    int zeros = 0, status = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        zeros |= run->discrete.event_sign[i] == 0;
    if (!more && !zeros)
        return 0;
    DiscreteState discrete = run->discrete;
    uncertainty(run, run->t, before->y, p, error); /* before: slips that were just stopped count */
    (void)evaluate_events_ahead(run, run->t, ahead, run->y, run->dy, p, now);
    run->discrete = before->discrete;
    (void)evaluate_events_ahead(run, run->t, ahead, before->y, before->dy, p, then);
    run->discrete = discrete;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        signed char *branch = &run->discrete.event_sign[i];
        const double least = error[N_WATCHED - N_USER_EVENTS + i];
        const int from = *branch, moves = fabs(now[i]) > least + 0.01 * fabs(then[i]);
        if (from == 0 && moves)
            event_crosses(i, branch, now[i]);
        if (from == 0 || moves || !more || !(fabs(run->rhs.event[i]) <= least))
            continue;
        const int comes = from * before->event[i] > least || from * then[i] < -least;
        if (comes || from * then[i] > least)
            *branch = 0;
        if (comes && event_direction[i] * from <= 0 && record_user_event(run, i, run->t, run->y, p))
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
static StateBeforeEvent copy_before_event(const Integrator *run) { return (void)run, (StateBeforeEvent){0}; }

/* Return 0: nothing can hold an event function at zero in this scene. */
static int record_arrivals_at_zero(Integrator *run, const StateBeforeEvent *before, double ahead, const Parameters *p)
{
    return (void)run, (void)before, (void)ahead, (void)p, 0;
}
#endif

/* Set whether user-defined events may end the run. */
void gudgeon_run_stop(void *integrator, int stop) { ((Integrator *)integrator)->events.stop = stop; }

/*
 * Move the oldest user-defined events, at most `capacity`, from the list into these arrays, with the states there as
 * rows of samples. Return their number.
 */
int gudgeon_run_events(void *integrator, int capacity, double *t, int *event, double *y, double *latched,
    signed char *state)
{
    Integrator *run = integrator;
    const int n = run->events.n < capacity ? run->events.n : capacity, left = run->events.n - n;
    for (int i = 0; i < n; i++) {
        t[i] = run->events.t[i];
        event[i] = run->events.number[i];
    }
#if N_USER_EVENTS
    EventStates *at = event_states(run);
    memcpy(y, at->y, (size_t)n * sizeof at->y[0]);
    memcpy(latched, at->latched, (size_t)n * sizeof at->latched[0]);
    memcpy(state, at->state, (size_t)n * sizeof at->state[0]);
    memmove(at->y, at->y + n, (size_t)left * sizeof at->y[0]);
    memmove(at->latched, at->latched + n, (size_t)left * sizeof at->latched[0]);
    memmove(at->state, at->state + n, (size_t)left * sizeof at->state[0]);
#else
    (void)y, (void)latched, (void)state;
#endif
    memmove(run->events.t, run->events.t + n, (size_t)left * sizeof run->events.t[0]);
    memmove(run->events.number, run->events.number + n, (size_t)left * sizeof run->events.number[0]);
    run->events.n = left;
    return n;
}
