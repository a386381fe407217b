/*
 * Events that end a step: the first zero of any event function (contacts, switching points, friction that sticks). An
 * event is a negative value, not only a change of sign, so that a contact that restarts with penetration is registered.
 * Monitored functions are the switching functions and user events that watched.c or dense_samples.c searches.
 */

#define LONG_STEP_RATIO 7.0 /* to the last step: step-size control alone lets a step grow by less */
enum { N_INNER_SAMPLES = 8 };
#define MAX_PASSED_BRANCH_ERROR 0.1 /* of the tolerance: accepted change of a step by a branch that is not switched */

/*
 * Change the branch of each switching point that the step passes without an event (step->is_ignored); a second call
 * restores the branches. Called around an evaluation on the new branches, and when the step is accepted.
 */
static void flip_ignored_branches(Integrator *run, const Step *step)
{
    for (int k = 0; k < N_SWITCHES; k++)
        if (step->is_ignored[k])
            run->discrete.branch[k] *= -1.0;
}

/* Search every switching point again: end the suppression of a repeated one. */
static void clear_suppressed_switch(Integrator *run) { run->roots.suppressed_switch = -1; }

/* Return whether any switching function of active branches is negative at the end of a step. */
static int has_negative_switch_at_end(const Integrator *run, const Step *step)
{
    int has_negative = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        has_negative |= run->discrete.branch[k] * step->rhs.g[k] < 0.0;
    return has_negative;
}

/*
 * Mark in step->is_ignored the switching points that the step may pass without an event, and return whether there is
 * any. They are those of contact laws whose branches meet, and a suppressed repeated one (suppress_repeated_switch()),
 * crossed near the end of the step. The error of the frozen branch is at most the step times the difference of the
 * rates at its end. Below MAX_PASSED_BRANCH_ERROR tolerances, step->dy and step->rhs are replaced by those of the new
 * branch. Otherwise no point is passed, and suppressed ones are searched again. Also sets step->branch_error. Called by
 * find_first_event() before zeros are searched.
 */
static int ignore_negligible_switches(Integrator *run, Step *step, const Parameters *p)
{
    double dy[N_Y], largest_change = 0.0;
    int has_ignored = 0;
    RhsOutputs rhs;
    step->branch_error = INFINITY;
    if (!has_negative_switch_at_end(run, step)) {
        memset(step->is_ignored, 0, sizeof step->is_ignored);
        return 0;
    }
    for (int k = 0; k < N_SWITCHES; k++) {
        const int event = N_CLEARANCES + k;
        const int is_of_law = is_continuous_switch[k] && monitored_index[event] < 0 && run->control.fixed <= 0.0;
        /* of laws only with step-size control: fixed steps have no tolerance to compare with */
        const int may_ignore = is_of_law || k == run->roots.suppressed_switch;
        step->is_ignored[k] = may_ignore && compute_event_value(&run->discrete, &step->rhs, event) < 0.0;
        has_ignored |= step->is_ignored[k];
    }
    if (!has_ignored)
        return 0;
    flip_ignored_branches(run, step);
    const int status = evaluate_run_rhs(run, step->t + step->h, step->y, p, dy, &rhs);
    flip_ignored_branches(run, step); /* frozen until the step is accepted */
    for (int k = 0; k < 2 * N_X && !status; k++)
        largest_change = max_of(largest_change, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    for (int k = FIRST_STATE; k < N_Y && !status; k++)
        largest_change = max_of(largest_change, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    if (!status && all_finite(dy, N_Y))
        step->branch_error = largest_change;
    if (step->branch_error < MAX_PASSED_BRANCH_ERROR) {
        for (int k = 0; k < N_Y; k++)
            step->dy[k] = dy[k];
        step->rhs = rhs;
        step->dense_ready = step->dense_ready == IN_RUN ? IN_RUN : 0; /* a lane's has the rates of this branch */
        return 1;
    }
    for (int k = 0; k < N_SWITCHES; k++)
        step->is_ignored[k] = 0;
    clear_suppressed_switch(run); /* also the suppressed one: its error is too large */
    return 0;
}

/*
 * Return whether an event function is not searched for a zero: that of a switching point that is suppressed
 * (roots.suppressed_switch) or that this step passes (step->is_ignored). event: its number.
 */
static int is_event_ignored(const Integrator *run, const Step *step, int event)
{
    const int switch_index = event - N_CLEARANCES;
    return switch_index >= 0 && switch_index < N_SWITCHES
        && (switch_index == run->roots.suppressed_switch || step->is_ignored[switch_index]);
}

/*
 * Return the node (0 to 1) of the stage at which an event function has its minimum over the stages,
 * step->min_event_value; 1 if no stage has that value.
 */
static double find_stage_of_minimum(const Step *step, int event)
{
    const StageValues stages = get_stage_values(step, event);
    for (int i = 0; i < step->n_stored_stages; i++)
        if (read_stage(stages, i) == step->min_event_value[event])
            return step->node[i];
    return 1.0;
}

/*
 * Return the node of the first stage with a negative event function, if a later stage or the end (end_value) is not
 * negative: it may cross zero more than once. Otherwise return 1.
 */
static double find_first_negative_stage(const Step *step, int event, double end_value)
{
    const StageValues stages = get_stage_values(step, event);
    double first = 1.0, last_positive = end_value >= 0.0 ? 1.0 : 0.0;
    for (int i = 0; i < step->n_stored_stages; i++) {
        const double f = read_stage(stages, i);
        first = f < 0.0 ? min_of(first, step->node[i]) : first;
        last_positive = f >= 0.0 ? max_of(last_positive, step->node[i]) : last_positive;
    }
    return first < last_positive ? first : 1.0;
}

/*
 * Return the upper end of a bracket of an event function's zero: a fraction (0 to 1) of the step at which its value is
 * negative; 0 if there is none. *value: its value there, or at the end of the step. event: number of the function, not
 * of a gap. For a switching point or user event it is the end that find_first_negative_sample() returns. For others it
 * is a negative stage that the dense output confirms, or the end of the step.
 */
static double find_negative_end_of_bracket(Integrator *run, Step *step, int event, const Parameters *p, double *value)
{
    if (monitored_index[event] >= 0)
        return find_first_negative_sample(run, step, monitored_index[event], p, value);
    const double end_value = compute_event_value(&run->discrete, &step->rhs, event);
    for (int pass = 0; pass < 2 && step->min_event_value[event] < 0.0; pass++) {
        const double fraction = pass ? find_stage_of_minimum(step, event)
            : find_first_negative_stage(step, event, end_value);
        if (fraction >= 1.0 || compute_dense_output(run, p, step))
            continue;
        *value = evaluate_event_function_at(run, step, fraction, event, p);
        if (*value < 0.0)
            return fraction;
    }
    *value = end_value;
    return end_value < 0.0 ? 1.0 : 0.0;
}

/*
 * Return whether the magnitude of an event function is larger than its uncertainty at state y and time t (s). event:
 * number of the function; rhs: outputs of the right-hand side at y. Only monitored event functions (switching points
 * and user events) have an uncertainty: return 1 for all others, and for NaN. Also used by the audit.
 */
static int is_above_uncertainty(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int event,
    const Parameters *p)
{
    double error[AT_LEAST_ONE(N_MONITORED)] = {0.0};
    if (monitored_index[event] < 0)
        return 1;
    estimate_rounding_uncertainty(run, t, y, p, error);
    return !(fabs(compute_event_value(&run->discrete, rhs, event)) <= error[monitored_index[event]]);
}

/*
 * Return whether the magnitude of an event function is larger than its uncertainty at a fraction of the step. Return 1
 * for functions other than switching functions and user events, and if the state cannot be evaluated.
 */
static int is_event_value_significant_at(
    Integrator *run, const Step *step, double fraction, int event, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return monitored_index[event] < 0 || evaluate_state_at(run, step, fraction, p, y, dy, &rhs)
        || is_above_uncertainty(run, step->t + fraction * step->h, y, &rhs, event, p);
}

/*
 * Return the fraction of the first event before the event found at `first_fraction`, and update *event to its number.
 * Event functions other than gaps are evaluated there; one that is negative above its uncertainty, and was not at the
 * beginning, is located. This is repeated at the new fraction. If there is none, return `first_fraction`; *event = -1
 * excludes no function. Called after the first event of a step is located.
 */
static double find_earlier_event(Integrator *run, const Step *step, double first_fraction, const Parameters *p,
    int *event)
{
    for (int pass = 0; pass < N_EVENT_FUNCTIONS && first_fraction > 0.0; pass++) {
        const int sample = find_or_add_dense_sample(run, step, first_fraction, *event, p);
        int earlier = -1;
        for (int k = 0; k < N_EVENT_FUNCTIONS && sample >= 0; k++)
            if (run->roots.samples.event_function[sample][k] < 0.0 && k != *event && !is_event_ignored(run, step, k)
                && !isfinite(sample_at_step_begin(run, step, k).slope)
                    && compute_event_value(&run->discrete, &run->rhs, k) >= 0.0
                && is_event_value_significant_at(run, step, first_fraction, k, p))
                earlier = k;
        if (earlier < 0)
            return first_fraction;
        const Sample high = sample_event_function(run, step, first_fraction, earlier, p);
        const Bracket bracket = build_stage_bracket(step, earlier, sample_at_step_begin(run, step, earlier), high);
        const double s = locate_event_in_step(run, step, earlier, bracket,
            estimate_zero(&bracket, count_interpolation_points(run, earlier)), p);
        if (!(s < first_fraction))
            return first_fraction;
        first_fraction = s;
        *event = earlier;
    }
    return first_fraction;
}

/* An event function k that may end the step: bracket and estimate of its zero, and the estimate within the bracket. */
typedef struct {
    int k;
    Bracket bracket;
    double guess, clamped_guess;
} Candidate;

/*
 * Return whether an event function is negative somewhere in the step, and set *candidate to its bracket and the
 * estimates of its zero. Zeros of a gap after max_fraction may be omitted. The bracket of a monitored function begins
 * where bracket_first_zeros() found it. A function that is negative at the beginning is evaluated at three inner points
 * for a return above zero; without one the event is at the beginning. Return 0 without dense output. Called for each
 * event function that may have a zero in the step.
 */
static int find_event_candidate(Integrator *run, Step *step, int event, const Parameters *p, double max_fraction,
    Candidate *candidate)
{
    double value_high;
    Sample low = sample_at_step_begin(run, step, event), end = {0.0, NAN, NAN};
    const int is_gap = isfinite(low.slope), sampled = is_gap || is_force_or_slip_function(run, event);
    const int candidates = is_gap ? bracket_gap_zero(run, step, event, p, max_fraction, &low, &end)
        : sampled ? bracket_force_zero(run, step, event, p, &low, &end) : 0;
    const double high = sampled ? candidates * end.s : find_negative_end_of_bracket(run, step, event, p, &value_high);
    if (high == 0.0 || compute_dense_output(run, p, step))
        return 0;
    if (monitored_index[event] >= 0 && step->bracket_begin[monitored_index[event]] > 0.0) {
        const Sample from = sample_event_function(run, step, step->bracket_begin[monitored_index[event]], event, p);
        if (from.f >= 0.0 || step->value_at_begin[monitored_index[event]] >= 0.0)
            low = from;
    }
    if (monitored_index[event] >= 0 && step->value_at_begin[monitored_index[event]] >= 0.0) /* within its uncertainty */
        low.f = max_of(low.f, 0.0);
    for (int j = 1; j < 4 && !sampled && !(low.f >= 0.0); j++) { /* negative at the beginning: find a return */
        const Sample inner = sample_event_function(run, step, 0.25 * j * high, event, p);
        if (inner.f >= 0.0)
            low = inner;
    }
    candidate->k = event;
    if (!is_gap)
        end = high < 1.0 ? sample_event_function(run, step, high, event, p) : sample_at_step_end(run, step, event);
    candidate->bracket = build_stage_bracket(step, event, low, end);
    candidate->guess = low.f >= 0.0 ? estimate_zero(&candidate->bracket, count_interpolation_points(run, event))
        : low.s;
    candidate->clamped_guess = low.f >= 0.0 ? clamp_to_bracket(candidate->guess, &candidate->bracket) : low.s;
    return 1;
}

/*
 * Return the first fraction of the step at which an event function is negative, and its number *event; 1 and -1 if
 * there is none. The candidates of all functions are collected, then located in the order of their estimated zeros.
 * find_earlier_event() then tests functions that become negative and return between samples. Called by
 * find_first_event() for each tried step.
 */
static double find_first_crossing(Integrator *run, Step *step, const Parameters *p, int *event)
{
    double first = 1.0, max_fraction = 1.0; /* no event is later than that */
    double at_end[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    int has_negative = 0;
    Candidate candidates[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    int n = 0;
    *event = -1;
    evaluate_event_functions(&run->discrete, &step->rhs, at_end);
    for (int k = N_CLEARANCES; k < N_EVENT_FUNCTIONS; k++)
        has_negative |= (step->min_event_value[k] < 0.0) | (at_end[k] < 0.0);
    const int only_gaps = !N_MONITORED && !N_FRICTIONS && !has_negative; /* all others are positive */
    for (int k = 0; k < (only_gaps ? N_CLEARANCES : N_EVENT_FUNCTIONS); k++) {
        const int is_positive = k >= N_CLEARANCES && monitored_index[k] < 0 && !is_force_or_slip_function(run, k)
            && !(step->min_event_value[k] < 0.0) && !(at_end[k] < 0.0);
        Candidate candidate;
        int i = n;
        if (is_positive || is_event_ignored(run, step, k)
            || !find_event_candidate(run, step, k, p, max_fraction, &candidate))
            continue;
        for (n++; i > 0 && candidates[i - 1].clamped_guess > candidate.clamped_guess; i--)
            candidates[i] = candidates[i - 1];
        candidates[i] = candidate;
        if (k < N_CLEARANCES)
            max_fraction = min_of(max_fraction, candidate.bracket.at[1].s);
    }
    for (int i = 0; i < n; i++) {
        const Candidate *candidate = &candidates[i];
        if (*event >= 0 && candidate->bracket.at[1].s > first
            && evaluate_event_function_at(run, step, first, candidate->k, p) >= 0.0)
            continue; /* later than the event found so far */
        const double s =
            candidate->bracket.at[0].f >= 0.0 ? locate_event_in_step(run, step, candidate->k, candidate->bracket,
                candidate->guess, p)
                : candidate->bracket.at[0].s;
        if (*event < 0 || s < first) {
            first = s;
            *event = candidate->k;
        }
    }
    return *event < 0 ? first : find_earlier_event(run, step, first, p, event);
}

/*
 * Return the fraction of the first event of a long step, and update *event. The step up to the event found at
 * `fraction` is long if it exceeds LONG_STEP_RATIO times the last one, while a contact is closed. Then N_INNER_SAMPLES
 * - 1 inner points are tested for earlier events. That needs a switching function that no other search covers: not
 * monitored, not ignored, positive at the beginning and, with a non-stiff method, not bounded away from zero by its
 * stages. All other steps, and steps of fixed length, return `fraction`.
 */
static double find_first_event_of_long_step(Integrator *run, Step *step, double fraction, const Parameters *p,
    int *event)
{
    int has_contact = 0, is_unbounded_function = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        has_contact |= run->discrete.contact[i].closed;
    if (!has_contact || !(fraction * step->h > LONG_STEP_RATIO * run->control.last_step) || run->control.fixed > 0.0)
        return fraction;
    for (int k = 0; k < N_EVENT_FUNCTIONS && !is_unbounded_function; k++)
        is_unbounded_function = monitored_index[k] < 0 && !isfinite(sample_at_step_begin(run, step, k).slope)
            && !is_force_or_slip_function(run, k)
            && compute_event_value(&run->discrete, &run->rhs, k) >= 0.0 && !is_event_ignored(run, step, k)
            && (step->method->stiff || !is_bounded_away_from_zero(run, step, k, 0.0, p));
    if (!is_unbounded_function || compute_dense_output(run, p, step))
        return fraction;
    for (int i = 1; i < N_INNER_SAMPLES; i++) {
        int earlier_event = -1;
        const double first = find_earlier_event(run, step, fraction * i / N_INNER_SAMPLES, p, &earlier_event);
        if (earlier_event >= 0) {
            *event = earlier_event;
            return first;
        }
    }
    return fraction;
}

#if N_USER_EVENTS
enum { MAX_POLE_SAMPLES = 4 };

/*
 * Evaluate the user-defined event functions at a fraction of a step into `values` (N_USER_EVENTS). Values below their
 * uncertainty become 0. Beyond the end of the step (fraction > 1) the motion is extrapolated linearly. Return a status.
 */
static int evaluate_user_events_at(Integrator *run, const Step *step, double fraction, const Parameters *p,
    double *values)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    if (fraction > 1.0)
        return extrapolate_event_functions(run, step->t + step->h, (fraction - 1.0) * step->h, step->y, step->dy, p,
            values);
    const int status = evaluate_state_at(run, step, fraction, p, y, dy, &rhs);
    if (!status)
        evaluate_significant_events(run, step->t + fraction * step->h, y, &rhs, p, values);
    return status;
}

/*
 * Return whether a user-defined event function changes its sign at a pole instead of a zero, at a fraction of the step.
 * It does if it is infinite there, or more than twice as large as at the first later sample above its uncertainty. A
 * function that jumps between finite values is equally large at both. Samples are those of the dense output, because
 * drives do not move linearly. Return 0 if the state cannot be evaluated. Called for a user-defined event that ends a
 * step.
 */
static int is_pole(Integrator *run, const Step *step, double fraction, int user_event, const Parameters *p)
{
    double y[N_Y], dy[N_Y], value[N_USER_EVENTS], distance = compute_event_time_tolerance(run, step);
    RhsOutputs rhs;
    if (evaluate_state_at(run, step, fraction, p, y, dy, &rhs))
        return 0;
    for (int n = 0; n < MAX_POLE_SAMPLES && isfinite(rhs.event[user_event]); n++) {
        distance *= POLE_DISTANCE;
        if (!evaluate_user_events_at(run, step, fraction + distance, p, value) && value[user_event] != 0.0)
            return is_near_pole(rhs.event[user_event], value[user_event]);
    }
    return isinf(rhs.event[user_event]);
}
#else
/* Return 0, no pole: the scene has no user-defined events. */
static inline int is_pole(Integrator *run, const Step *step, double fraction, int user_event, const Parameters *p)
{
    return (void)run, (void)step, (void)fraction, (void)user_event, (void)p, 0;
}
#endif

/*
 * Return the first fraction of a tried step at which an event ends it, and its number *event; 1 and -1 if there is
 * none. Negligible switching points are marked in step->is_ignored first. If an event precedes the end, the marks are
 * cleared, because such a point may lie after the event, and the search is repeated. Long steps in contact are searched
 * further (find_first_event_of_long_step()). Also stores whether a user-defined event is a pole. Called for each
 * accepted attempt, before the step is shortened to the event.
 */
static double find_first_event(Integrator *run, Step *step, const Parameters *p, int *event)
{
    const int has_ignored = ignore_negligible_switches(run, step, p);
    bracket_first_zeros(run, step, p);
    double fraction = find_first_crossing(run, step, p, event);
    if (*event >= 0 && has_ignored) {
        /* the event ends the step: a passed switching point may lie after it */
        for (int k = 0; k < N_SWITCHES; k++)
            step->is_ignored[k] = 0;
        fraction = find_first_crossing(run, step, p, event);
    }
    fraction = find_first_event_of_long_step(run, step, fraction, p, event);
    const int user_event = *event - (N_EVENT_FUNCTIONS - N_USER_EVENTS);
    set_pole_flag(run, user_event >= 0 && is_pole(run, step, fraction, user_event, p));
    return fraction;
}

/* Reset the root finding of a run: no switching point is stored as crossed, none is suppressed. */
static void initialize_root_finding(Integrator *run) { run->roots.crossed = run->roots.suppressed_switch = -1; }

/*
 * Set the resolution of event times, roots.time_resolution: min(1e-12 s, 1e-11 remaining_time), where remaining_time is
 * the time to the end of the run, s. With steps of fixed length h it is min(1e-12 s, 1e-8 h), so that a resumed run
 * repeats the uninterrupted one. Called when a run begins or resumes.
 */
static void set_time_resolution(Integrator *run, double remaining_time)
{
    run->roots.time_resolution = min_of(1e-12, run->control.fixed > 0.0 ? 1e-8 * run->control.fixed
        : 1e-11 * remaining_time);
}

#define MIN_RATE_JUMP_TOL 1e-3 /* of a tolerance: smaller changes of a step by a switching point are ignored */
/*
 * Return the largest jump of the rates at a change of branch, in tolerances per second. dy_before (N_Y): rates of the
 * previous branch at the same state.
 */
static double compute_rate_jump(const Integrator *run, const double *dy_before)
{
    double largest = 0.0;
    for (int k = 0; k < N_Y; k++)
        largest = max_of(largest, fabs(run->dy[k] - dy_before[k]) * run->norm.weight[k]);
    return largest;
}

/*
 * Suppress a switching point in the next step (roots.suppressed_switch) if the motion crossed it twice within a
 * thousandth of the step length; otherwise end a suppression. This avoids chattering (Zeno behaviour); an example is a
 * journal at rest in its film. Called at each change of branch. Both branches must meet there (is_continuous_switch);
 * with step-size control it is enough that their rates times the longer of step and suppression length differ by less
 * than MIN_RATE_JUMP_TOL. dy_before: rates of the previous branch. The next step is limited to
 * roots.suppression_length: 20 times the maximum of the time between the crossings, the previous limit and 100
 * resolutions of time.
 */
static void suppress_repeated_switch(Integrator *run, int switch_index, const double *dy_before)
{
    const double elapsed = run->t - run->roots.t_crossed;
    const double suppression_length = 20.0
        * max_of(100.0 * run->roots.time_resolution, max_of(run->roots.suppression_length, elapsed));
    const int is_repeated = run->roots.crossed == switch_index && elapsed < 1e-3 * run->control.h
        && (is_continuous_switch[switch_index]
            || (run->control.fixed <= 0.0
                && compute_rate_jump(run, dy_before) * max_of(suppression_length, run->control.h) < MIN_RATE_JUMP_TOL));
    run->roots.suppressed_switch = is_repeated ? switch_index : -1;
    run->roots.suppression_length = is_repeated ? suppression_length : 0.0;
    run->roots.crossed = switch_index;
    run->roots.t_crossed = run->t;
}
