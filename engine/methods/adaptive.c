/*
 * The time loop of all methods: trial steps, events in the accepted step, samples from its dense output, and changes of
 * branches and contact states at its end.
 */
enum { N_SIGN_PARTS = 4, MAX_REPEATS = 8 /* repetitions of a step to end just after an event */ };

/*
 * Set the unset signs of user-defined events from their values at inner points of a step, before the step is committed.
 * Acts only if a contact or friction event ends the step at `fraction` and a sign is unset (0). Such an event holds the
 * user-defined one at zero at both ends.
 *
 * The points are at 1/4, 2/4 and 3/4 of `fraction`. The function returns early if the dense output or a state there
 * cannot be computed; signs set before remain.
 */
static void update_event_signs_within_step(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    const int is_friction = event >= N_CLEARANCES + N_SWITCHES && event < N_EVENT_FUNCTIONS - N_USER_EVENTS;
    int has_unset_sign = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        has_unset_sign |= run->discrete.event_sign[i] == 0;
    if (!has_unset_sign || event < 0 || !(event < N_CLEARANCES || is_friction) || compute_dense_output(run, p, step))
        return;
    for (int part = 1; part < N_SIGN_PARTS; part++) {
        double y[N_Y], dy[N_Y];
        const double s = fraction * part / N_SIGN_PARTS;
        RhsOutputs rhs;
        if (evaluate_state_at(run, step, s, p, y, dy, &rhs))
            return;
        update_event_signs(run, step->t + s * step->h, y, &rhs, p);
    }
}

/*
 * Make the end of an accepted step, or its state at `fraction` < 1 where `event` occurs, the new state of the run at
 * time t_new (s). `fraction` < 1 needs a dense output that exists. In order, the following is updated:
 *   - unset signs of user-defined events, peaks within the step, branches of switching points crossed within the
 *       tolerance;
 *   - state, counts, error weights and their scales; stored linearization and series are discarded;
 *   - compression flags, constraint residuals (at an event of a drive, |Phi_dot| keeps its largest value), step record;
 *   - after a step without event: the switching point that was suppressed, and its branch;
 *   - signs of user-defined events; the event (-1: none) is applied; open contacts are checked.
 *
 * Return 0 or the status: that of the state, CHATTERING after too many events without advance, that of the event (also
 * ENDED) or of the contacts.
 */
static int commit_step(Integrator *run, Step *step, double fraction, double t_new, int event, const Parameters *p)
{
    update_event_signs_within_step(run, step, fraction, event, p);
    /* the dense output exists if the step ends early: its end may be replaced */
    int status = fraction < 1.0 ? evaluate_state_at(run, step, fraction, p, step->y, step->dy, &step->rhs) : 0;
    if (status)
        return status;
    record_peaks_within_step(run, step, fraction, p);
    flip_ignored_branches(run, step);
    update_energy_scale(run, 1, step->y);
    for (int k = 0; k < N_Y; k++) {
        run->y[k] = step->y[k];
        run->dy[k] = step->dy[k];
    }
    run->rhs = step->rhs;
    set_last_step_length(run, t_new - run->t);
    count_step_end(run, event, event >= 0 && t_new - run->t < 1e-9 * step->h);
    run->t = t_new;
    count_step(run, !!step->method->stiff);
    discard_linearization(run);
    discard_series(run, fraction >= 1.0);
    update_speeds(run);
    update_error_weights(run);
    for (int i = 0; i < N_CLEARANCES; i++)
        update_compression(run, i, run->rhs.clearance[i].deltadot);
    /* the end of the step in the lanes is the new state, at the same time to the last bit */
    const int knows_residuals = step->stage_values_lane && fraction >= 1.0 && run->t == step->t + step->h;
    const double drift = run->residuals.phi_dot_max; /* at a jump of a drive, rates are those before the impulse */
    status = record_accepted_state(run, knows_residuals ? step->residual : NULL, p);
    if (DRIVE_IMPULSES && event >= N_CLEARANCES && event < N_CLEARANCES + N_SWITCHES)
        set_phi_dot_max(run, drift);
    if (!status && event < 0 && run->roots.suppressed_switch >= 0) { /* away from it, on either branch */
        clear_suppressed_switch(run);
        status = update_branches_at_current_state(run, -1, p);
    }
    update_event_signs(run, run->t, run->y, &run->rhs, p);
    if (!status && event >= 0)
        status = is_chattering(run) ? CHATTERING : apply_event(run, event, p);
    return status ? status : check_open_contacts(run, p);
}

/*
 * Return the rounding error in s of the end time t of a fixed step, a multiple of the step length; 0 without fixed
 * steps. Samples within that difference of t are taken from the state at t.
 */
static double compute_end_time_tolerance(const Integrator *run, double t)
{
    return run->control.fixed > 0.0 ? compute_time_tolerance(t, run->control.fixed) : 0.0;
}

/*
 * Store all samples whose output times lie before t_new (s), from the dense output of a step, and increment
 * *samples->done for each. Each interpolated state is projected onto the constraints, closed contacts and sticking
 * friction. The right-hand sides evaluated here are not counted. Return 0, or the status if the dense output cannot be
 * computed.
 */
static int store_samples_of_step(Integrator *run, Step *step, double t_new, const Parameters *p, const Samples *samples)
{
    const long evaluations = run->counts.evaluations;
    for (; *samples->done < samples->n && samples->t[*samples->done] < t_new; ++*samples->done) {
        const double t = samples->t[*samples->done];
        double y[N_Y];
        const int status = compute_dense_output(run, p, step);
        if (status)
            return status;
        interpolate(run, step, (t - step->t) / step->h, y);
        project_state(run, t, y, p);
        project_slips(run, t, y, p);
        store_sample(run, t, y, p, *samples->done, samples->y, samples->discrete_states, samples->contact_codes);
    }
    restore_evaluations(run, evaluations); /* samples are output, not integration */
    return 0;
}

/*
 * Append inner points of a step, up to `fraction`, to the step record before the step is committed. The points divide
 * the step into RECORD_INTERVALS parts. Further points lie next to the beginning after a jump, and next to the end
 * before one (`has_jump`).
 *
 * Points that coincide with an end are omitted. Return 0, also if no record is kept, or the status of the dense output.
 * Evaluations are not counted.
 */
static int append_step_interior_rows(Integrator *run, Step *step, double fraction, int has_jump, const Parameters *p)
{
    const long evaluations = run->counts.evaluations;
    const double event_width = max_of(64.0 * DBL_EPSILON * fabs(step->t), 4.0 * run->roots.time_resolution) / step->h;
    const double offset = max_of(JUMP_OFFSET * fraction, event_width);
    if (!run->step_record.rows)
        return 0;
    int status = compute_dense_output(run, p, step);
    for (int k = !run->step_record.jumped; k < RECORD_INTERVALS + has_jump && !status; k++) {
        const double s = k == 0 ? offset : k == RECORD_INTERVALS ? fraction - offset : fraction * k / RECORD_INTERVALS;
        const double t = step->t + s * step->h;
        double y[N_Y];
        if (!(s > 0.0 && s < fraction && t > step->t))
            continue; /* so short a step has no such rows */
        interpolate(run, step, s, y);
        project_state(run, t, y, p);
        append_record_row(run, t, y, p);
    }
    restore_evaluations(run, evaluations); /* output, not integration */
    return status;
}

/*
 * Append the run's state at the end of a step to the step record. If the state jumped there (`has_jump`), the next row
 * is marked and nothing is appended: the next step appends the row after the jump. In the last step of a run
 * (`is_last`) the state after the jump is appended here. Nothing happens without a record. Called by accept_step()
 * after the step is committed.
 */
static void append_step_end_row(Integrator *run, int has_jump, int is_last, const Parameters *p)
{
    mark_jump_before_next_row(run, has_jump);
    if (!has_jump || is_last)
        append_record_row(run, run->t, run->y, p);
}

/* Whether the scene has periodic functions (mod). */
#ifndef PERIODS
#define PERIODS 0
#endif
#define EVENT_END_RATIO 1.02 /* times the fraction of the event: length of a repeated step that ends just after it */
#define PERIOD_END_RATIO 1.1 /* the same for scenes with periodic functions */
/* Whether the scene has curves with knots. */
#ifndef KNOTS
#define KNOTS 0
#endif
#define MAX_KNOT_EXTRAPOLATION 0.4 /* of a piece of a curve, which continues beyond its knot (scene/curves.h) */

/*
 * Repeat the current step from its beginning with a length of at most h (s), and find its first event: *event and its
 * *fraction of the step. Contacts and branches are frozen meanwhile. Sets the run's next step length to h and replaces
 * *step. Return 0 or the status; then *event and *fraction are unchanged.
 */
static int repeat_step(
    Integrator *run, double h, double t_end, const Parameters *p, Step *step, double *fraction, int *event)
{
    set_next_step_length(run, h);
    open_attempt(run, t_end, p);
    run->discrete.is_frozen = 1;
    const int status = find_accepted_step(run, p, step);
    if (!status)
        *fraction = find_first_event(run, step, p, event);
    return status;
}

/*
 * Compute the dense output of a step if it is needed, and return whether that failed. It is needed if its computation
 * has failed before, or if the next sample lies inside the step. Evaluations are not counted. Called in a loop that
 * repeats the step with a shorter length.
 */
static int compute_needed_dense_output(Integrator *run, Step *step, const Parameters *p, const Samples *samples)
{
    const long evaluations = run->counts.evaluations; /* samples are output, not integration */
    const int needed = step->dense_ready == FAILED || samples->t[*samples->done] < step->t + step->h;
    const int failed = needed && compute_dense_output(run, p, step);
    restore_evaluations(run, evaluations);
    return failed;
}

/*
 * Return whether a step extends beyond an event at `fraction` by more than MAX_KNOT_EXTRAPOLATION times the time since
 * the last crossing of a switching point. Such a step may have evaluated another piece of a curve beyond the knot.
 * Always 0 in scenes without curves.
 */
static int is_far_beyond_knot(const Integrator *run, const Step *step, double fraction)
{
    const double piece_length = step->t + fraction * step->h - run->roots.t_crossed;
    return KNOTS && (1.0 - fraction) * step->h > MAX_KNOT_EXTRAPOLATION * piece_length;
}

/*
 * Find the first event of an accepted step: *event (-1: none) and its *fraction of the step (1: none), and repeat the
 * step where its results are not valid. Return 0 or the status. The next step length of the run is restored.
 *
 * A step whose needed dense output cannot be computed is repeated with a quarter of its length. Four kinds of steps are
 * repeated to end just after the event: fixed steps, steps with periods of mod, steps far beyond a knot, and steps with
 * inaccurate film forces at the event.
 */
static int find_event_of_step(
    Integrator *run, const Samples *samples, const Parameters *p, Step *step, double *fraction, int *event)
{
    const double t_end = samples->t[samples->n - 1], length_factor = PERIODS ? PERIOD_END_RATIO : EVENT_END_RATIO;
    const int is_adaptive = run->control.fixed <= 0.0;
    int status = 0;
    *fraction = find_first_event(run, step, p, event);
    for (int k = 0;
         k < MAX_REDUCTIONS && !status && is_adaptive && compute_needed_dense_output(run, step, p, samples); k++)
        status = repeat_step(run, 0.25 * step->h, t_end, p, step, fraction, event);
    for (int k = 0; k < MAX_REPEATS && !status && *event >= 0 && length_factor * *fraction < 1.0; k++) {
        const double next = run->control.h, h = length_factor * *fraction * step->h;
        if (h <= run->roots.time_resolution)
            break; /* the event is at the beginning of the step, where constraints do not differ */
        if (is_adaptive && !PERIODS && !is_far_beyond_knot(run, step, *fraction)
            && !has_inaccurate_film_force_at_event(run, step, *fraction, p))
            break; /* a fixed step is repeated: its dense output may be of low order */
        status = repeat_step(run, h, t_end, p, step, fraction, event);
        set_next_step_length(run, next);
    }
    return status;
}

/*
 * Begin the next step of a run: begin or resume the integration if necessary, store samples due at the current time,
 * and open an attempt. Return 1 if a step of length run->control.attempt.h must now be computed; an attempt that is
 * open already is continued.
 *
 * Return 0 at the last sample, or if `is_last`: the step is left to the next call. Also return 0 if *status is
 * EVENTS_FULL (Python must fetch the lists), STOPPED, STALLED or an error.
 */
static int begin_step(Integrator *run, int is_last, const Parameters *p, const Samples *samples, int *status)
{
    const double t_end = samples->t[samples->n - 1];
    const int is_new_step = !run->discrete.is_frozen && !run->control.attempt.is_open;
    *status = is_new_step ? begin_integration(run, t_end - run->t, p) : 0;
    if (!*status && is_new_step)
        append_row_after_jump(run, p);
    mark_jump_before_next_row(run, is_new_step);
    if (run->control.attempt.is_open)
        return !is_last; /* attempts continue */
    if (*status)
        return 0;
    const double t_due = run->t + compute_end_time_tolerance(run, run->t);
    for (; *samples->done < samples->n && samples->t[*samples->done] <= t_due; ++*samples->done)
        store_sample(run, run->t, run->y, p, *samples->done, samples->y, samples->discrete_states,
            samples->contact_codes);
    if (*samples->done == samples->n || is_last)
        return 0;
    if (run->cancellation.stop)
        *status = STOPPED;
    else if (has_full_buffers(run))
        *status = EVENTS_FULL;
    else if (run->control.fixed <= 0.0 && detect_run_stall(run, t_end))
        *status = diagnose_stall(run, STALLED, p);
    else
        open_attempt(run, t_end, p);
    return !*status;
}

/*
 * Complete an accepted step: find its first event, store samples, record and audit it, commit it, and apply the changes
 * at its end. Called by the time loop after run->step has been computed. Return 0, STOPPED, or another status. After a
 * failure the run is at the end of this step or, if it was not committed, of the step before.
 */
static int accept_step(Integrator *run, const Parameters *p, const Samples *samples)
{
    const double t_end = samples->t[samples->n - 1];
    Step *step = &run->step;
    int event;
    double fraction;
    switch_method_after_step(run, p);
    int status = find_event_of_step(run, samples, p, step, &fraction, &event);
    if (status || run->cancellation.stop)
        return status ? status : STOPPED; /* results of a cancelled search are invalid */
    if (run->control.fixed > 0.0)
        run->discrete.is_frozen = 1;
    const double t_uncut = run->control.fixed > 0.0 ? run->control.attempt.end
        : step->h == t_end - run->t ? t_end : run->t + step->h;
    const double t_new = fraction < 1.0 ? run->t + fraction * step->h : t_uncut;
    /* samples this close to the event are at it */
    const double tolerance = event < 0 ? compute_end_time_tolerance(run, t_new)
        : max_of(8.0 * DBL_EPSILON * fabs(t_new), 2.0 * run->roots.time_resolution);
    status = store_samples_of_step(run, step, t_new - tolerance, p, samples);
    /* the end of a fixed step may lie at the jump of a drive, as that of a run may */
    const int may_jump = DRIVE_IMPULSES && (t_new == t_end || (run->control.fixed > 0.0 && fraction >= 1.0));
    const int has_jump = may_jump || (event >= 0 && event < N_EVENT_FUNCTIONS - N_USER_EVENTS);
    if (!status)
        status = append_step_interior_rows(run, step, fraction, has_jump, p);
    defer_stop(&run->cancellation);
    if (AUDITS && !status)
        audit_step(run, step, fraction, event, p);
    const int n_listed = run->events.n;
    const double drift = run->residuals.phi_dot_max;
    if (!status)
        status = commit_step(run, step, fraction, t_new, event, p);
    if (!status && event >= 0)
        status = fit_first_step_after_event(run, t_end - run->t, p);
    run->discrete.is_frozen = 1;
    if (may_jump && !status) {
        set_phi_dot_max(run, drift); /* the branch of a rate exactly at the jump is arbitrary */
        status = apply_drive_jumps_at_current_time(run, p);
    }
    if (!status && run->t == t_end)
        status = record_user_events_at_run_end(run, 0.0, p);
    if (AUDITS && (!status || status == ENDED))
        status = check_step_end(run, n_listed, p) ? AUDITED : status;
    if (!status || status == ENDED)
        append_step_end_row(run, has_jump, status == ENDED || run->t == t_end, p);
    allow_stop(&run->cancellation);
    return status;
}

/*
 * Integrate a run towards the last of n output times t (s), with at most `max_steps` steps. Samples are stored from row
 * *n_stored on, which counts them: states y, discrete states, contact codes. Return 0 if all samples are stored, or
 * after `max_steps` steps: then *n_stored < n, and the caller calls again. Return EVENTS_FULL if the caller must fetch
 * the lists first, STOPPED, or another status.
 */
int gudgeon_adaptive_run(void *integrator, const double *parameters, long n, const double *t, long max_steps,
    double *y, double *discrete_states, signed char *contact_codes, long *n_stored)
{
    Integrator *run = integrator;
    const Parameters *p = (const Parameters *)parameters;
    const Samples samples = {.n = n, .done = n_stored, .t = t, .y = y,
        .discrete_states = discrete_states, .contact_codes = contact_codes};
    int status;
    relink_methods(run);
    run->step.method = find_method_in_library(run->step.method);
    for (long i = 0; begin_step(run, i == max_steps, p, &samples, &status); i++) {
        status = find_accepted_step(run, p, &run->step);
        if (!status)
            status = accept_step(run, p, &samples);
        if (status)
            break;
    }
    return status;
}
