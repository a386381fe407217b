/*
 * Events of a step: the first zero of the event functions of contacts, switching points and friction that may stick
 * ends it. An event is a negative value, not only a change of sign, so that a contact that restarts with penetration is
 * registered.
 */

#define LONG_STEP 7.0 /* times the last step: step-size control alone lets a step grow by less */
enum { N_INNER_SAMPLES = 8 };
#define HARMLESS 0.1 /* of the tolerance: change of a step by the inactive branch that is accepted */

/* Change the branch of each switching point that the step passes without an event; a second call restores it. */
static void flip_ignored_branches(Integrator *run, const Step *step)
{
    for (int k = 0; k < N_SWITCHES; k++)
        if (step->passed[k])
            run->discrete.branch[k] *= -1.0;
}

/* Search every switching point again: end the suppression of a repeated one. */
static void watch_every_switch(Integrator *run) { run->roots.skip = -1; }

/*
 * Mark in step->passed the switching points that the step may pass without an event. They are those of contact laws
 * whose branches meet, and a suppressed repeated one (suppress_repeated_switch), crossed near the end of the step. The
 * error of the frozen branch is at most the step times the difference of the rates at its end. If it is below HARMLESS
 * tolerances, the end of the step gets the rates of the new branch. Returns whether any is passed.
 */
static int ignore_harmless_switches(Integrator *run, Step *step, const Parameters *p)
{
    double dy[N_Y], most = 0.0;
    int crossed = 0;
    RhsOutputs rhs;
    step->harm = INFINITY;
    for (int k = 0; k < N_SWITCHES; k++) {
        const int gap_function = N_CLEARANCES + k;
        const int law = meets[k] && watched_as[gap_function] < 0 && run->control.fixed <= 0.0;
        const int may_pass = law || k == run->roots.skip; /* fixed steps have no tolerance to compare with */
        step->passed[k] = may_pass && event_function(&run->discrete, &step->rhs, gap_function) < 0.0;
        crossed |= step->passed[k];
    }
    if (!crossed)
        return 0;
    flip_ignored_branches(run, step);
    const int status = rates(run, step->t + step->h, step->y, p, dy, &rhs);
    flip_ignored_branches(run, step); /* frozen until the step is accepted */
    for (int k = 0; k < 2 * N_X && !status; k++)
        most = max_of(most, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    for (int k = FIRST_STATE; k < N_Y && !status; k++)
        most = max_of(most, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    if (!status && all_finite(dy, N_Y))
        step->harm = most;
    if (step->harm < HARMLESS) {
        for (int k = 0; k < N_Y; k++)
            step->dy[k] = dy[k];
        step->rhs = rhs;
        step->dense_ready = step->dense_ready == IN_RUN ? IN_RUN : 0; /* a lane's has the rates of this branch */
        return 1;
    }
    for (int k = 0; k < N_SWITCHES; k++)
        step->passed[k] = 0;
    watch_every_switch(run); /* also the suppressed one: its error is too large */
    return 0;
}

/* Return whether event function k is not searched: a switching point that is suppressed or passed by this step. */
static int is_ignored(const Integrator *run, const Step *step, int k)
{
    const int switch_index = k - N_CLEARANCES;
    return switch_index >= 0 && switch_index < N_SWITCHES
        && (switch_index == run->roots.skip || step->passed[switch_index]);
}

/* Return the node of the stage at which event function k was lowest; 1: none. */
static double stage_of_minimum(const Step *step, int k)
{
    const StageValues seen = stage_values(step, k);
    for (int i = 0; i < step->n_seen; i++)
        if (stage_value(seen, i) == step->lowest[k])
            return step->node[i];
    return 1.0;
}

/*
 * Return the node of the first stage with a negative event function k if a later stage or the end is not negative: it
 * may cross zero more than once. Otherwise return 1.
 */
static double first_negative_stage(const Step *step, int k, double end)
{
    const StageValues seen = stage_values(step, k);
    double first = 1.0, back = end >= 0.0 ? 1.0 : 0.0;
    for (int i = 0; i < step->n_seen; i++) {
        const double f = stage_value(seen, i);
        first = f < 0.0 ? min_of(first, step->node[i]) : first;
        back = f >= 0.0 ? max_of(back, step->node[i]) : back;
    }
    return first < back ? first : 1.0;
}

/*
 * Return a fraction of the step at which event function k, not one of a gap, is negative: the upper end of its bracket;
 * 0: none. `value` is set to its value there.
 */
static double last_negative_stage(Integrator *run, Step *step, int k, const Parameters *p, double *value)
{
    if (watched_as[k] >= 0)
        return first_negative_sample(run, step, watched_as[k], p, value);
    const double end = event_function(&run->discrete, &step->rhs, k);
    for (int last = 0; last < 2 && step->lowest[k] < 0.0; last++) {
        const double at = last ? stage_of_minimum(step, k) : first_negative_stage(step, k, end);
        if (at >= 1.0 || compute_dense_output(run, p, step))
            continue;
        *value = event_function_at(run, step, at, k, p);
        if (*value < 0.0)
            return at;
    }
    *value = end;
    return end < 0.0 ? 1.0 : 0.0;
}

/* Return whether a watched event function k is larger than its uncertainty at a state; 1 for all other functions. */
static int is_resolved(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int k, const Parameters *p)
{
    double error[AT_LEAST_ONE(N_WATCHED)] = {0.0};
    if (watched_as[k] < 0)
        return 1;
    uncertainty(run, t, y, p, error);
    return !(fabs(event_function(&run->discrete, rhs, k)) <= error[watched_as[k]]);
}

/* Return whether a watched event function k is larger than its uncertainty at a fraction of the step. */
static int is_resolved_at(Integrator *run, const Step *step, double fraction, int k, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return watched_as[k] < 0 || state_at(run, step, fraction, p, y, dy, &rhs)
        || is_resolved(run, step->t + fraction * step->h, y, &rhs, k, p);
}

/*
 * Return the fraction of the first event that precedes `first`, at which an event was found. Event functions that no
 * stage shows negative are evaluated there and, if negative, located. `event` is updated.
 */
static double event_before(Integrator *run, const Step *step, double first, const Parameters *p, int *event)
{
    for (int again = 0; again < N_EVENT_FUNCTIONS && first > 0.0; again++) {
        const int slot = sample_at(run, step, first, *event, p);
        int found = -1;
        for (int k = 0; k < N_EVENT_FUNCTIONS && slot >= 0; k++)
            if (run->roots.samples.event_function[slot][k] < 0.0 && k != *event && !is_ignored(run, step, k)
                && !isfinite(bracket_begin(run, step, k).slope) && event_function(&run->discrete, &run->rhs, k) >= 0.0
                && is_resolved_at(run, step, first, k, p))
                found = k;
        if (found < 0)
            return first;
        const Sample high = bracket_point_at(run, step, first, found, p);
        const Bracket of = stage_bracket(step, found, bracket_begin(run, step, found), high);
        const double s = locate_root(run, step, found, of, guess_zero(&of, n_interpolation_points(run, found)), p);
        if (!(s < first))
            return first;
        first = s;
        *event = found;
    }
    return first;
}

/* An event function k that may end the step: the bracket of its zero and two estimates of its location. */
typedef struct {
    int k;
    Bracket of;
    double guess, about;
} Candidate;

/*
 * Return whether event function k is negative somewhere in the step, and set `now` to its bracket. Zeros of a gap after
 * the fraction `until` may be omitted.
 */
static int is_candidate(Integrator *run, Step *step, int k, const Parameters *p, double until, Candidate *now)
{
    double at_high;
    Sample low = bracket_begin(run, step, k), end = {0.0, NAN, NAN};
    const int is_gap = isfinite(low.slope), sampled = is_gap || is_contact_force_function(run, k);
    const int candidates = is_gap ? has_zero(run, step, k, p, until, &low, &end)
        : sampled ? has_force_zero(run, step, k, p, &low, &end) : 0;
    const double high = sampled ? candidates * end.s : last_negative_stage(run, step, k, p, &at_high);
    if (high == 0.0 || compute_dense_output(run, p, step))
        return 0;
    if (watched_as[k] >= 0 && step->from[watched_as[k]] > 0.0) {
        const Sample from = bracket_point_at(run, step, step->from[watched_as[k]], k, p);
        if (from.f >= 0.0 || step->above[watched_as[k]] >= 0.0)
            low = from;
    }
    if (watched_as[k] >= 0 && step->above[watched_as[k]] >= 0.0) /* negative within its uncertainty only */
        low.f = max_of(low.f, 0.0);
    for (int j = 1; j < 4 && !sampled && !(low.f >= 0.0); j++) { /* negative at the beginning: find a return */
        const Sample part = bracket_point_at(run, step, 0.25 * j * high, k, p);
        if (part.f >= 0.0)
            low = part;
    }
    now->k = k;
    if (!is_gap)
        end = high < 1.0 ? bracket_point_at(run, step, high, k, p) : bracket_end(run, step, k);
    now->of = stage_bracket(step, k, low, end);
    now->guess = low.f >= 0.0 ? guess_zero(&now->of, n_interpolation_points(run, k)) : low.s;
    now->about = low.f >= 0.0 ? clamp_to_bracket(now->guess, &now->of) : low.s;
    return 1;
}

/*
 * Return the first fraction of the step at which an event function ends it. `event`: its number, -1 if none (fraction
 * 1).
 */
static double first_crossing(Integrator *run, Step *step, const Parameters *p, int *event)
{
    double first = 1.0, until = 1.0; /* no event is later than that */
    double at_end[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    Candidate candidates[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    int n = 0;
    *event = -1;
    evaluate_event_functions(&run->discrete, &step->rhs, at_end);
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) {
        const int quiet = k >= N_CLEARANCES && watched_as[k] < 0 && !is_contact_force_function(run, k)
            && !(step->lowest[k] < 0.0) && !(at_end[k] < 0.0);
        Candidate now;
        int i = n;
        if (quiet || is_ignored(run, step, k) || !is_candidate(run, step, k, p, until, &now))
            continue;
        for (n++; i > 0 && candidates[i - 1].about > now.about; i--)
            candidates[i] = candidates[i - 1];
        candidates[i] = now;
        if (k < N_CLEARANCES)
            until = min_of(until, now.of.at[1].s);
    }
    for (int i = 0; i < n; i++) {
        const Candidate *now = &candidates[i];
        if (*event >= 0 && now->of.at[1].s > first && event_function_at(run, step, first, now->k, p) >= 0.0)
            continue; /* later than the event found so far */
        const double s =
            now->of.at[0].f >= 0.0 ? locate_root(run, step, now->k, now->of, now->guess, p) : now->of.at[0].s;
        if (*event < 0 || s < first) {
            first = s;
            *event = now->k;
        }
    }
    return *event < 0 ? first : event_before(run, step, first, p, event);
}

/*
 * Return the first event of a step in contact that is far longer than the previous one. Event functions without bounds
 * may cross zero and return between its stages, and stages of stiff methods are inaccurate. The dense output is
 * therefore sampled up to the event at `fraction` that was already found.
 */
static double first_event_of_long_step(Integrator *run, Step *step, double fraction, const Parameters *p, int *event)
{
    int closed = 0, hidden = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        closed |= run->discrete.contact[i].closed;
    if (!closed || !(fraction * step->h > LONG_STEP * run->control.last_step) || run->control.fixed > 0.0)
        return fraction;
    for (int k = 0; k < N_EVENT_FUNCTIONS && !hidden; k++)
        hidden = watched_as[k] < 0 && !isfinite(bracket_begin(run, step, k).slope) && !is_contact_force_function(run, k)
            && event_function(&run->discrete, &run->rhs, k) >= 0.0 && !is_ignored(run, step, k)
            && (step->method->stiff || !is_clear_of_zero(run, step, k, 0.0, p));
    if (!hidden || compute_dense_output(run, p, step))
        return fraction;
    for (int i = 1; i < N_INNER_SAMPLES; i++) {
        int earlier = -1;
        const double first = event_before(run, step, fraction * i / N_INNER_SAMPLES, p, &earlier);
        if (earlier >= 0) {
            *event = earlier;
            return first;
        }
    }
    return fraction;
}

#if N_USER_EVENTS
enum { FAR_PLACES = 4 };

/*
 * Evaluate user events at fraction s of a step, extrapolated linearly beyond its end. value: 0 for those below their
 * uncertainty. Returns a status.
 */
static int events_at(Integrator *run, const Step *step, double s, const Parameters *p, double *value)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    if (s > 1.0)
        return evaluate_events_ahead(run, step->t + step->h, (s - 1.0) * step->h, step->y, step->dy, p, value);
    const int status = state_at(run, step, s, p, y, dy, &rhs);
    if (!status)
        evaluate_resolved_events(run, step->t + s * step->h, y, &rhs, p, value);
    return status;
}

/*
 * Return whether user event i changes its sign at a pole instead of a zero. It does if its value is larger at the
 * located fraction than at the first later sample above its uncertainty. A function that jumps between finite values is
 * equally large at both. Samples are those of the dense output, because drives do not move linearly.
 */
static int is_pole(Integrator *run, const Step *step, double fraction, int i, const Parameters *p)
{
    double y[N_Y], dy[N_Y], value[N_USER_EVENTS], ahead = event_time_tolerance(run, step);
    RhsOutputs rhs;
    if (state_at(run, step, fraction, p, y, dy, &rhs))
        return 0;
    for (int n = 0; n < FAR_PLACES && isfinite(rhs.event[i]); n++) {
        ahead *= POLE_DISTANCE;
        if (!events_at(run, step, fraction + ahead, p, value) && value[i] != 0.0)
            return is_near_pole(rhs.event[i], value[i]);
    }
    return isinf(rhs.event[i]);
}
#else
/* Return 0: the scene has no user events. */
static inline int is_pole(Integrator *run, const Step *step, double fraction, int i, const Parameters *p)
{
    return (void)run, (void)step, (void)fraction, (void)i, (void)p, 0;
}
#endif

/*
 * Return the first fraction of the step at which an event ends it, and its number `event` (-1: none, fraction 1).
 * Switching points passed without an event are determined first.
 */
static double first_event(Integrator *run, Step *step, const Parameters *p, int *event)
{
    const int passed = ignore_harmless_switches(run, step, p);
    search_step(run, step, p);
    double fraction = first_crossing(run, step, p, event);
    if (*event >= 0 && passed) {
        /* the event ends the step: a passed switching point may lie after it */
        for (int k = 0; k < N_SWITCHES; k++)
            step->passed[k] = 0;
        fraction = first_crossing(run, step, p, event);
    }
    fraction = first_event_of_long_step(run, step, fraction, p, event);
    const int user_event = *event - (N_EVENT_FUNCTIONS - N_USER_EVENTS);
    set_pole(run, user_event >= 0 && is_pole(run, step, fraction, user_event, p));
    return fraction;
}

/* Reset the root finding of a run: no switching point was crossed, none is suppressed. */
static void start_roots(Integrator *run) { run->roots.crossed = run->roots.skip = -1; }

/*
 * Set the resolution of event times, s, from the time `left` of the run, s. With fixed steps it does not depend on that
 * time, so that a resumed run repeats the uninterrupted one.
 */
static void set_time_resolution(Integrator *run, double left)
{
    run->roots.time_resolution = min_of(1e-12, run->control.fixed > 0.0 ? 1e-8 * run->control.fixed : 1e-11 * left);
}

#define MIN_RATE_JUMP_TOL 1e-3 /* of a tolerance: smaller changes of a step by a switching point are ignored */
/* Return the jump of the rates at a change of branch, in tolerances per second. before: rates of the old branch. */
static double rate_jump(const Integrator *run, const double *before)
{
    double most = 0.0;
    for (int k = 0; k < N_Y; k++)
        most = max_of(most, fabs(run->dy[k] - before[k]) * run->norm.weight[k]);
    return most;
}

/*
 * Suppress a switching point in the next step if the motion crossed it twice within a short time, such as a journal at
 * rest in its film. The next step is as short as the time between the crossings, and the following ones grow. Both
 * branches meet there, or differ by rounding only, so that the frozen branch has a small error.
 */
static void suppress_repeated_switch(Integrator *run, int switch_index, const double *before)
{
    const double elapsed = run->t - run->roots.t_crossed;
    const double monitor = 20.0 * max_of(100.0 * run->roots.time_resolution, max_of(run->roots.monitor, elapsed));
    const int is_repeated = run->roots.crossed == switch_index && elapsed < 1e-3 * run->control.h
        && (meets[switch_index]
            || (run->control.fixed <= 0.0
                && rate_jump(run, before) * max_of(monitor, run->control.h) < MIN_RATE_JUMP_TOL));
    run->roots.skip = is_repeated ? switch_index : -1;
    run->roots.monitor = is_repeated ? monitor : 0.0;
    run->roots.crossed = switch_index;
    run->roots.t_crossed = run->t;
}
