/*
 * The time loop of all methods: attempts at a step (methods/step_length.c), events in the accepted step, samples from
 * its dense output, and what changes at its end.
 */
enum { N_SIGN_PARTS = 4, MAX_REPEATS = 8 /* repetitions of a step to end just after an event */ };

/*
 * Set the signs of user-defined events that are at zero before and after a step, held by friction or a contact, from
 * their values inside the step.
 */
static void update_event_signs_inside(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    const int is_friction = event >= N_CLEARANCES + N_SWITCHES && event < N_EVENT_FUNCTIONS - N_USER_EVENTS;
    int unknown = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        unknown |= run->discrete.event_sign[i] == 0;
    if (!unknown || event < 0 || !(event < N_CLEARANCES || is_friction) || compute_dense_output(run, p, step))
        return;
    for (int part = 1; part < N_SIGN_PARTS; part++) {
        double y[N_Y], dy[N_Y];
        const double s = fraction * part / N_SIGN_PARTS;
        RhsOutputs rhs;
        if (state_at(run, step, s, p, y, dy, &rhs))
            return;
        update_event_signs(run, step->t + s * step->h, y, &rhs, p);
    }
}

/*
 * Make the end of a step, or the point at `fraction` of it where an event occurs, the new state at time t_new. Then
 * apply the event (-1: none). Return 0 or the status.
 */
static int commit_step(Integrator *run, Step *step, double fraction, double t_new, int event, const Parameters *p)
{
    update_event_signs_inside(run, step, fraction, event, p);
    /* the dense output exists if the step ends early: its end may be replaced */
    int status = fraction < 1.0 ? state_at(run, step, fraction, p, step->y, step->dy, &step->rhs) : 0;
    if (status)
        return status;
    find_inner_peaks(run, step, fraction, p);
    flip_ignored_branches(run, step);
    add_works(run, 1, step->y);
    for (int k = 0; k < N_Y; k++) {
        run->y[k] = step->y[k];
        run->dy[k] = step->dy[k];
    }
    run->rhs = step->rhs;
    set_last_length(run, t_new - run->t);
    record_step_end(run, event, event >= 0 && t_new - run->t < 1e-9 * step->h);
    run->t = t_new;
    count_step(run, !!step->method->stiff);
    discard_linearization(run);
    discard_series(run);
    update_speeds(run);
    update_error_weights(run);
    for (int i = 0; i < N_CLEARANCES; i++)
        update_compression(run, i, run->rhs.clearance[i].deltadot);
    const double drift = run->residuals.phi_dot_max; /* at a jump of a drive, rates are those before the impulse */
    status = record_accepted_state(run, p);
    if (DRIVE_IMPULSES && event >= N_CLEARANCES && event < N_CLEARANCES + N_SWITCHES)
        set_phi_dot_max(run, drift);
    if (!status && event < 0 && run->roots.skip >= 0) { /* away from the switching point, on either branch */
        watch_every_switch(run);
        status = update_branches(run, -1, p);
    }
    update_event_signs(run, run->t, run->y, &run->rhs, p);
    if (!status && event >= 0)
        status = is_chattering(run) ? CHATTERING : apply_event(run, event, p);
    return status ? status : check_contacts(run, p);
}

/* Return the time difference in s within which a sample is at the end t of a fixed step: both are rounded products. */
static double end_time_rounding(const Integrator *run, double t)
{
    return run->control.fixed > 0.0 ? rounded(t, run->control.fixed) : 0.0;
}

/* Store the samples of a step before time t_new from its dense output. Return 0 or the status. */
static int sample_step(Integrator *run, Step *step, double t_new, const Parameters *p, const Samples *out)
{
    const long evaluations = run->counts.evaluations;
    for (; *out->done < out->n && out->t[*out->done] < t_new; ++*out->done) {
        const double t = out->t[*out->done];
        double now[N_Y];
        const int status = compute_dense_output(run, p, step);
        if (status)
            return status;
        interpolate(run, step, (t - step->t) / step->h, now);
        project_state(run, t, now, p);
        project_slips(run, t, now, p);
        store_sample(run, t, now, p, *out->done, out->y, out->latched, out->state);
    }
    restore_evaluations(run, evaluations); /* samples are output, not integration */
    return 0;
}

/*
 * Append rows inside a step, up to `fraction`, to the step record before the step is committed. Rows are the ends of
 * its parts, and points next to its ends if something jumps there (`jumps`: at the last end).
 */
static int record_inside_step(Integrator *run, Step *step, double fraction, int jumps, const Parameters *p)
{
    const long evaluations = run->counts.evaluations;
    const double located = max_of(64.0 * DBL_EPSILON * fabs(step->t), 4.0 * run->roots.time_resolution) / step->h;
    const double offset = max_of(JUMP_OFFSET * fraction, located);
    if (!run->step_record.rows)
        return 0;
    int status = compute_dense_output(run, p, step);
    for (int k = !run->step_record.jumped; k < RECORD_PARTS + jumps && !status; k++) {
        const double s = k == 0 ? offset : k == RECORD_PARTS ? fraction - offset : fraction * k / RECORD_PARTS;
        const double t = step->t + s * step->h;
        double now[N_Y];
        if (!(s > 0.0 && s < fraction && t > step->t))
            continue; /* so short a step has no such rows */
        interpolate(run, step, s, now);
        project_state(run, t, now, p);
        record_state(run, t, now, p);
    }
    restore_evaluations(run, evaluations); /* output, not integration */
    return status;
}

/*
 * Append the end of a step to the step record. After a change the row follows with the next step, unless this is the
 * last.
 */
static void record_step_end_state(Integrator *run, int jumped, int is_last, const Parameters *p)
{
    mark_jump(run, jumped);
    if (!jumped || is_last)
        record_state(run, run->t, run->y, p);
}

/* Whether the scene has periodic functions (mod). */
#ifndef PERIODS
#define PERIODS 0
#endif
#define NEAR_END 1.02 /* times the fraction of the event: length of a repeated step that ends just after it */
#define PERIOD_END 1.1 /* the same for scenes with periodic functions */
/* Whether the scene has curves with knots. */
#ifndef KNOTS
#define KNOTS 0
#endif
#define KNOT_REACH 0.4 /* of a piece of a curve: it is extrapolated this far beyond its knot (scene/curves.h) */

/* Repeat a step with length h (s), and find its first event. Return 0 or the status. */
static int repeat_step(
    Integrator *run, double h, double t_end, const Parameters *p, Step *step, double *fraction, int *event)
{
    set_length(run, h);
    open_attempt(run, t_end, p);
    run->discrete.held = 1;
    const int status = find_accepted_step(run, p, step);
    if (!status)
        *fraction = first_event(run, step, p, event);
    return status;
}

/* Return whether the dense output of a step is needed, for an event or a sample, and cannot be computed. */
static int is_dense_output_missing(Integrator *run, Step *step, const Parameters *p, const Samples *out)
{
    const long evaluations = run->counts.evaluations; /* samples are output, not integration */
    const int needed = step->dense_ready == FAILED || out->t[*out->done] < step->t + step->h;
    const int failed = needed && compute_dense_output(run, p, step);
    restore_evaluations(run, evaluations);
    return failed;
}

/*
 * Return whether a step extends so far beyond a knot at `fraction` that it may have evaluated another piece of the
 * curve.
 */
static int is_far_beyond_knot(const Integrator *run, const Step *step, double fraction)
{
    const double piece = step->t + fraction * step->h - run->roots.t_crossed;
    return KNOTS && (1.0 - fraction) * step->h > KNOT_REACH * piece;
}

/*
 * Find the first event of an accepted step and its fraction; 1 and -1: none. Three kinds of steps are repeated to end
 * just after the event: steps far beyond a period of mod, whose branch is extended by half a period only; steps far
 * beyond a knot of a curve; steps whose film forces are wrong at the event. A step without dense output is repeated
 * with a shorter length. Return 0 or the status.
 */
static int find_event_of_step(
    Integrator *run, const Samples *out, const Parameters *p, Step *step, double *fraction, int *event)
{
    const double t_end = out->t[out->n - 1], longer = PERIODS ? PERIOD_END : NEAR_END;
    const int free = run->control.fixed <= 0.0;
    int status = 0;
    *fraction = first_event(run, step, p, event);
    for (int k = 0; k < MAX_SHORTENED && !status && free && is_dense_output_missing(run, step, p, out); k++)
        status = repeat_step(run, 0.25 * step->h, t_end, p, step, fraction, event);
    for (int k = 0; k < MAX_REPEATS && !status && *event >= 0 && longer * *fraction < 1.0; k++) {
        const double next = run->control.h, h = longer * *fraction * step->h;
        if (h <= run->roots.time_resolution)
            break; /* the event is at the beginning of the step, where constraints do not differ */
        if (free && !PERIODS && !is_far_beyond_knot(run, step, *fraction)
            && !has_wrong_film_force_at(run, step, *fraction, p))
            break; /* a fixed step is repeated: its dense output may be of low order */
        status = repeat_step(run, h, t_end, p, step, fraction, event);
        set_length(run, next);
    }
    return status;
}

/*
 * Prepare a step: begin the run if needed, and store samples that are due. Return whether a step must be computed
 * (run->control.attempt), which `last` leaves to another call. If not, *status is 0, EVENTS_FULL, STOPPED or another
 * status.
 */
static int needs_step(Integrator *run, int last, const Parameters *p, const Samples *out, int *status)
{
    const double t_end = out->t[out->n - 1];
    const int begins = !run->discrete.held && !run->control.attempt.open;
    *status = begins ? begin_adaptive(run, t_end - run->t, p) : 0;
    if (!*status && begins)
        record_after_jump(run, p);
    mark_jump(run, begins);
    if (run->control.attempt.open)
        return !last; /* attempts continue */
    if (*status)
        return 0;
    const double here = run->t + end_time_rounding(run, run->t);
    for (; *out->done < out->n && out->t[*out->done] <= here; ++*out->done)
        store_sample(run, run->t, run->y, p, *out->done, out->y, out->latched, out->state);
    if (*out->done == out->n || last)
        return 0;
    if (run->cancellation.stop)
        *status = STOPPED;
    else if (has_full_lists(run))
        *status = EVENTS_FULL;
    else if (run->control.fixed <= 0.0 && is_stalled(run, t_end))
        *status = diagnose_stall(run, STALLED, p);
    else
        open_attempt(run, t_end, p);
    return !*status;
}

/*
 * Complete an accepted step up to its first event: samples, step record, audit, commit, and changes at its end.
 * Afterwards the run is at the end of a step with its changes, whatever the status.
 */
static int accept_step(Integrator *run, const Parameters *p, const Samples *out)
{
    const double t_end = out->t[out->n - 1];
    Step *step = &run->step;
    int event;
    double fraction;
    choose_method(run, p);
    int status = find_event_of_step(run, out, p, step, &fraction, &event);
    if (status || run->cancellation.stop)
        return status ? status : STOPPED; /* results of a cancelled search are invalid */
    if (run->control.fixed > 0.0)
        run->discrete.held = 1;
    const double t_whole = run->control.fixed > 0.0 ? run->control.attempt.end
        : step->h == t_end - run->t ? t_end : run->t + step->h;
    const double t_new = fraction < 1.0 ? run->t + fraction * step->h : t_whole;
    /* samples this close to the event are at it */
    const double close = event < 0 ? end_time_rounding(run, t_new)
        : max_of(8.0 * DBL_EPSILON * fabs(t_new), 2.0 * run->roots.time_resolution);
    status = sample_step(run, step, t_new - close, p, out);
    /* the end of a fixed step may lie at the jump of a drive, as that of a run may */
    const int may_jump = DRIVE_IMPULSES && (t_new == t_end || (run->control.fixed > 0.0 && fraction >= 1.0));
    const int jumps = may_jump || (event >= 0 && event < N_EVENT_FUNCTIONS - N_USER_EVENTS);
    if (!status)
        status = record_inside_step(run, step, fraction, jumps, p);
    defer_stop(&run->cancellation);
    if (AUDITS && !status)
        audit_step(run, step, fraction, event, p);
    const int listed = run->events.n;
    const double drift = run->residuals.phi_dot_max;
    if (!status)
        status = commit_step(run, step, fraction, t_new, event, p);
    if (!status && event >= 0)
        status = first_step_after_event(run, t_end - run->t, p);
    run->discrete.held = 1;
    if (may_jump && !status) {
        set_phi_dot_max(run, drift); /* the branch of a rate exactly at the jump is arbitrary */
        status = pass_drive_jumps_here(run, p);
    }
    if (!status && run->t == t_end)
        status = record_events_at_end(run, 0.0, p);
    if (AUDITS && (!status || status == ENDED))
        status = audit_state(run, listed, p) ? AUDITED : status;
    if (!status || status == ENDED)
        record_step_end_state(run, jumps, status == ENDED || run->t == t_end, p);
    allow_stop(&run->cancellation);
    return status;
}

/*
 * Integrate towards the last of n output times t, with at most `limit` steps; samples are stored from row *done on.
 * Return 0 (at the end, or to be called again), EVENTS_FULL, STOPPED or another status.
 */
int gudgeon_adaptive_run(void *integrator, const double *parameters, long n, const double *t, long limit,
    double *y, double *latched, signed char *state, long *done)
{
    Integrator *run = integrator;
    const Parameters *p = (const Parameters *)parameters;
    const Samples out = {.n = n, .done = done, .t = t, .y = y, .latched = latched, .state = state};
    int status;
    relink_choice(run);
    run->step.method = local_method(run->step.method);
    for (long i = 0; needs_step(run, i == limit, p, &out, &status); i++) {
        status = find_accepted_step(run, p, &run->step);
        if (!status)
            status = accept_step(run, p, &out);
        if (status)
            break;
    }
    return status;
}
