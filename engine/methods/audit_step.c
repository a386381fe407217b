/*
 * Independent checks of a run within its steps (run/audit.c): at random points, at events, and in long steps. Checks:
 * defect of the dense output, discrete states. At random points in addition: all constraint equations, accelerations by
 * the equations of all bodies, film forces.
 */
#define AUDIT_LENGTH_RATIO 8.0 /* times the step before: longer steps are always checked */
#define AUDIT_RATE 1e-3 /* of the largest rate: allowed error of rates */
#define AUDIT_CHANGE 0.1 /* of their change over the step: allowed error of rates */
#define AUDIT_SLIP 1e-9 /* m/s: smaller slips of sticking friction count as zero */
#define AUDIT_DRIFT 1e2 /* tolerances: allowed sum of errors of rates */
#define AUDIT_STABILITY_ERROR 10.0 /* tolerances: allowed error of a step limited by stability */
#define AUDIT_DEFECT 1e4 /* tolerances: allowed defect of the dense output */
#define AUDIT_MEASURED_LENGTH_RATIO 1.5 /* times the longest measured step: longer steps are measured */
#define AUDIT_MIN_LENGTH_RATIO 1e-3 /* of the longest step: shorter ones near a pole do not set the scale of events */
#define AUDIT_FIRST_FRACTION 0.25 /* of the interval between drawn steps: the first one */
#define AUDIT_COST_FRACTION 0.008 /* of the evaluations of a run: cost of the checks of drawn steps */
#define AUDIT_CHECK_EVALUATIONS 8.0   /* typical evaluations of one check */
#define AUDIT_ITERATIONS 4.0 /* evaluations of an iterated stage */
#define AUDIT_MIN_EVALUATIONS 8.0 /* smallest number of evaluations of a step */
/* bisections that locate a zero; points inside a step */
enum { AUDIT_HALVINGS = 30, AUDIT_POINTS_PER_STEP = 4 };

/*
 * Return the defect of rates `rate` of the dense output against the right-hand side `dy` at state y, in multiples of
 * its limit. Return 0 if the defect is not larger than the largest one recorded so far. A stiff component within its
 * tolerance may have any rate: with stiff methods, defects above 1 are divided by 1 - h J. With films only positions
 * are compared (check_film_forces() checks the velocities).
 */
static double compute_scaled_defect(Integrator *run, const Step *step, const double *y, const double *rate,
    const double *dy, const Parameters *p)
{
    const double known = max_of(run->audit.record[CHECK_defect].max_ratio, 0.0), h = step->h;
    const int rows = has_films() ? N_X : 2 * N_X; /* check_film_forces() checks velocities with films */
    const ErrorNorm *norm = &run->norm;
    const double lengths = norm->speed[0] + norm->speed_floor[0], angles = norm->speed[1] + norm->speed_floor[1];
    const double fast[2] = {1.0 / lengths, 1.0 / angles};
    double rate_error[N_Y] = {0.0}, scaled_error[N_Y] = {0.0}, defect = known, min_relevant_size;
    for (int k = 0; k < rows; k++) {
        rate_error[k] = rate[k] - dy[k];
        scaled_error[k] = h * rate_error[k];
    }
    for (int pass = 0; pass < 2; pass++) {
        defect = known, min_relevant_size = known * AUDIT_DEFECT;
        for (int k = 0; k < rows; k++) {
            /* compute_audit_weight() */
            const double weight = norm->inverse_scale[k] * (k < N_X ? 1.0 : fast[is_angle[k % N_X]]);
            const double size = fabs(scaled_error[k]) * weight;
            if (size <= min_relevant_size)
                continue;
            const double limit = AUDIT_DEFECT + AUDIT_DIGITS * (fabs(y[k]) + fabs(h * dy[k])) * weight;
            if (size > defect * limit)
                defect = size / limit, min_relevant_size = size * AUDIT_DEFECT / limit;
        }
        if (pass || defect <= 1.0 || !step->method->stiff || has_films() || factor_newton_matrix(run, h, p))
            break;
        newton_solve(&run->newton.linear, h, 0.0, rate_error, scaled_error);
    }
    return defect > known ? defect : 0.0;
}

/*
 * Check the rates `rate` of the dense output at time t against the right-hand side `dy` at state y. Positions and
 * velocities are checked separately, with films positions only. Each check records CHECK_rate with the maximum of the
 * weighted errors and its limit, passed or failed; only a failure at a jump of a drive is not recorded.
 *
 * The limit is a fraction of the largest rate and of the change of rates over the step. Rates of errors that add up to
 * few tolerances over the time passed are allowed in addition. Explicit steps limited by stability are allowed more. If
 * this limit is exceeded, the rounding error of rates is added to it. `order`: 0 for positions, 1 for velocities.
 */
static void check_dense_output_rates(Integrator *run, const Step *step, double t, const double *y, const double *rate,
    const double *dy, const Parameters *p)
{
    double rounding[2 * N_X];
    for (int order = 0; order < (has_films() ? 1 : 2); order++) {
        const double slip = N_FRICTIONS ? AUDIT_SLIP / (order ? step->h : 1.0) : 0.0;
        const double elapsed = max_of(min_of(fabs(t), step->h * (double)(run->counts.steps + 1)), step->h);
        const int is_limited = !step->method->stiff && run->choice.h_rho > 1.0;
        double allowed = max_of(AUDIT_DRIFT / elapsed, is_limited ? AUDIT_STABILITY_ERROR / step->h : 0.0);
        double largest_error = 0.0, largest_rate = 0.0;
        for (int k = order * N_X; k < (order + 1) * N_X; k++) {
            const double weight = compute_audit_weight(run, k), change = fabs(step->dy[k] - run->dy[k]);
            largest_error = max_of(largest_error, fabs(rate[k] - dy[k]) * weight);
            largest_rate = max_of(largest_rate, (fabs(dy[k]) + (order ? 0.0 : fabs(step->h * dy[N_X + k]))) * weight);
            allowed = max_of(allowed, (AUDIT_CHANGE * change + AUDIT_DIGITS * fabs(y[k]) / step->h + slip) * weight);
        }
        double limit = AUDIT_RATE * largest_rate + allowed;
        if (largest_error > limit) {
            if (estimate_rounding_of_rates(run, t, y, dy, p, rounding))
                return;
            for (int k = order * N_X; k < (order + 1) * N_X; k++)
                limit = max_of(limit, AUDIT_RATE * largest_rate + allowed + rounding[k] * compute_audit_weight(run, k));
        }
        if (largest_error <= limit || !has_drive_jump_at_ends(run, step, p))
            record_check(&run->audit, CHECK_rate, largest_error, limit, t, -1);
    }
}

/*
 * Check the rates that a step used at its end against a new evaluation of the right-hand side, and record CHECK_defect.
 * Nothing is checked in runs with fixed steps or if the evaluation fails. Called for drawn steps that no event ends.
 */
static void check_rates_at_step_end(Integrator *run, Step *step, const Parameters *p)
{
    double dy[N_Y];
    RhsOutputs rhs;
    if (has_step_size_control(run) && !evaluate_run_rhs(run, step->t + step->h, step->y, p, dy, &rhs))
        record_check(&run->audit, CHECK_defect, compute_scaled_defect(run, step, step->y, step->dy, dy, p), 1.0,
            step->t + step->h, -1);
}

/*
 * Check the film forces at time t of a step by the accelerations `dy` that they cause, against those of the dense
 * output, `rate`. The error is recorded as CHECK_force of the joint with the largest film force. It is relative to that
 * force or, if larger, to MIN_FILM_FORCE_FRACTION of a peak force in the run. Omitted without films, in runs with fixed
 * steps, in the first step, and where a failure is at a jump of a drive.
 */
static void check_film_forces(Integrator *run, const Step *step, double t, const RhsOutputs *rhs, const double *rate,
    const double *dy, const Parameters *p)
{
    int joint;
    if (!has_films())
        return;
    double max_force = find_joint_of_largest_film_force(rhs, &joint);
    for (int i = 0; i < N_CLEARANCES; i++)
        max_force = has_film(i) ? max_of(max_force, MIN_FILM_FORCE_FRACTION * run->contacts.F_peak[i]) : max_force;
    const double fraction = compute_relative_film_error(run, step, rate, dy, max_force, 1.0);
    const double limit = compute_film_audit_limit(run, step);
    if (joint >= 0 && has_step_size_control(run) && run->counts.steps > 0
        && (fraction <= limit || !has_drive_jump_at_ends(run, step, p)))
        record_check(&run->audit, CHECK_force, fraction, limit, t, joint);
}

/*
 * Check one state y inside a step, at fraction theta. dy, rhs: rates and outputs of the right-hand side at y. In runs
 * with step-size control, the rates of the dense output are compared with dy (compute_scaled_defect()) and recorded as
 * CHECK_defect; a failure at a jump of a drive is not recorded.
 *
 * At random points (`is_random`) of scenes without play, check_dense_output_rates() compares them too. Film forces
 * and the conditions of discrete states are always checked.
 */
static void check_interior_state(Integrator *run, Step *step, double theta, int is_random, const double *y,
    const double *dy, const RhsOutputs *rhs, const Parameters *p)
{
    const double t = step->t + theta * step->h;
    double rate[2 * N_X];
    interpolate_rates(step, theta, 2 * N_X, rate);
    const double defect = has_step_size_control(run) ? compute_scaled_defect(run, step, y, rate, dy, p) : 0.0;
    if (has_step_size_control(run) && (defect <= 1.0 || !has_drive_jump_at_ends(run, step, p)))
        record_check(&run->audit, CHECK_defect, defect, 1.0, t, -1);
    if (is_random && has_step_size_control(run) && !N_CLEARANCES) /* rates in contacts change quickly inside a step */
        check_dense_output_rates(run, step, t, y, rate, dy, p);
    check_film_forces(run, step, t, rhs, rate, dy, p);
    check_gaps(run, t, rhs, p);
    check_rigid_forces(run, t, rhs);
    check_friction_modes(run, t, rhs);
    check_frozen_branches(run, step, t, y, rhs, p);
}

/*
 * Compute the state at fraction theta of a step from its dense output, and check it by check_interior_state(). At a
 * random point (`is_random`) also check all constraint equations and, on consistent branches, the accelerations by the
 * equations of all bodies. In the first step the state is not projected. Nothing is checked if the state cannot be
 * evaluated.
 */
static void check_interior_point(Integrator *run, Step *step, double theta, int is_random, const Parameters *p)
{
    const double t = step->t + theta * step->h;
    double y[N_Y], dy[N_Y], absolute_state[N_S];
    RhsOutputs rhs;
    if (compute_dense_output(run, p, step))
        return;
    if (run->counts.steps == 0) { /* the first step projects a start that violates the constraints */
        interpolate(run, step, theta, y);
        if (evaluate_run_rhs(run, t, y, p, dy, &rhs))
            return;
    } else if (evaluate_state_at(run, step, theta, p, y, dy, &rhs))
        return; /* states after an event may be undefined */
    check_interior_state(run, step, theta, is_random, y, dy, &rhs, p);
    if (!is_random)
        return;
    convert_integrated_to_absolute(t, y, &run->discrete, p, absolute_state);
    check_constraints(run, t, absolute_state, !RATE_JUMPS, p);
    if (is_branch_consistent(run, &rhs))
        check_accelerations(run, t, step->h, y, dy, absolute_state, p);
}

/*
 * Return whether user-defined event i has a zero, not a pole, between the beginning of a step and `fraction`, at which
 * its values have opposite signs. The dense output is bisected AUDIT_HALVINGS times. It is a zero if the last value is
 * below 0.01 of both end values. Return 0 if a state cannot be evaluated.
 */
static int has_event_zero(Integrator *run, Step *step, double fraction, int i, const Parameters *p)
{
    double low = 0.0, high = fraction, y[N_Y], dy[N_Y];
    const double before = run->rhs.event[i], after = step->rhs.event[i];
    double nearest = INFINITY;
    RhsOutputs rhs;
    for (int n = 0; n < AUDIT_HALVINGS && compute_dense_output(run, p, step) == 0; n++) {
        const double middle = 0.5 * (low + high);
        if (evaluate_state_at(run, step, middle, p, y, dy, &rhs))
            return 0;
        nearest = fabs(rhs.event[i]);
        if (rhs.event[i] * before > 0.0)
            low = middle;
        else
            high = middle;
    }
    return nearest < 0.01 * min_of(fabs(before), fabs(after));
}

/*
 * Return whether the value of user-defined event i exceeds its uncertainty at the end of a step (`is_end`), else at its
 * beginning (is_above_uncertainty()).
 */
static int is_event_value_significant(Integrator *run, const Step *step, int is_end, int i, const Parameters *p)
{
    const int k = N_EVENT_FUNCTIONS - N_USER_EVENTS + i;
    return is_end ? is_above_uncertainty(run, step->t + step->h, step->y, &step->rhs, k, p)
        : is_above_uncertainty(run, run->t, run->y, &run->rhs, k, p);
}

/*
 * Prepare the check of user-defined events (check_user_event()) before a step is committed. Store in the audit the
 * scale of each, whether it left zero, and whether it crosses zero without ending the step (has_zero). A crossing
 * counts only if it has the requested direction and both end values are resolved. `event` is the one that ends the step
 * at `fraction`, -1: none.
 */
static void check_event_zeros(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    Audit *audit = &run->audit;
    audit->end_event = event - (N_EVENT_FUNCTIONS - N_USER_EVENTS);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const double before = run->rhs.event[i], after = step->rhs.event[i];
        const StageValues stages = get_stage_values(step, N_EVENT_FUNCTIONS - N_USER_EVENTS + i);
        double inside = fabs(after); /* the beginning may be a located pole */
        for (int k = 0; k < step->n_stored_stages; k++)
            inside = max_of(inside, fabs(read_stage(stages, k)));
        if (step->h > AUDIT_MIN_LENGTH_RATIO * audit->longest_measured && isfinite(inside))
            audit->event_scale[i] = max_of(audit->event_scale[i], inside);
        const double noise = AUDIT_NOISE_FRACTION * audit->event_scale[i];
        audit->was_nonzero_since_event[i] |= max_of(fabs(before), inside) > noise;
        /* initialize_event_signs() set the sign already */
        const int begins_beyond = run->counts.steps == 0 && run->discrete.event_sign[i] * after > 0.0;
        /* also from a pole, near which it grows and falls at once */
        const int far = fraction * step->h > compute_event_location_tolerance(run);
        audit->event_before[i] =
            audit->end_event == i && far && is_event_value_significant(run, step, 0, i, p) ? before : 0.0;
        audit->has_zero[i] = fraction >= 1.0 && audit->end_event != i && !begins_beyond && before * after < 0.0
            && fabs(before) > noise && fabs(after) > noise && event_direction[i] * after >= 0.0
            && is_event_value_significant(run, step, 0, i, p) && is_event_value_significant(run, step, 1, i, p)
            && has_event_zero(run, step, fraction, i, p);
    }
}

/*
 * Return the mean number of steps between two steps drawn for checks: AUDIT_CHECK_EVALUATIONS / (AUDIT_COST_FRACTION
 * n), with n evaluations of a step, at least AUDIT_MIN_EVALUATIONS. Their cost is thus limited to AUDIT_COST_FRACTION
 * of the evaluations. The interval depends on the method alone, so that a run in a batch is checked at the same steps.
 */
static double compute_mean_check_interval(const Method *method)
{
    const double evaluations = method->stages * (method->lane_method >= METHOD_RADAU5 ? AUDIT_ITERATIONS : 1.0);
    return AUDIT_CHECK_EVALUATIONS / (AUDIT_COST_FRACTION * max_of(evaluations, AUDIT_MIN_EVALUATIONS));
}

/*
 * Check the inside of an accepted step up to `fraction`, where `event` (-1: none) ends it, before it is committed.
 * Checked are the state at the event, drawn random points, and the local error of drawn or unusually long steps.
 * AUDIT_FULL checks every step at AUDIT_POINTS_PER_STEP points. Nothing is done if the audit is off. Evaluations and
 * the dense output do not count as integration, and the discrete state is restored.
 */
static void audit_step(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (!audit->level)
        return;
    const long evaluations = run->counts.evaluations;
    const int dense_ready = step->dense_ready;
    const double h = fraction * step->h;
    const int checks_all = audit->level == AUDIT_FULL, is_due = run->counts.steps >= audit->next_audited_step;
    const int is_whole = fraction >= 1.0 && event < 0;
    const int is_long = h > AUDIT_LENGTH_RATIO * run->control.last_step
        || (is_whole && h > AUDIT_MEASURED_LENGTH_RATIO * audit->longest_measured);
    const int is_longer = is_long && !step->method->controls_length
        && ((double)audit->n_long_steps + 1.0) * compute_mean_check_interval(step->method) < (double)run->counts.steps;
    const int by_turn = (int)(audit->n_drawn % 2);
    const int is_random = checks_all || (is_due && !by_turn);
    const int is_measured = checks_all || is_longer || (is_due && by_turn);
    const int n_points = checks_all ? AUDIT_POINTS_PER_STEP : is_random || (is_longer && !is_whole);
    check_event_zeros(run, step, fraction, event, p);
    if (fraction >= 1.0) {
        check_rigid_forces(run, step->t + h, &step->rhs);
        check_friction_modes(run, step->t + h, &step->rhs);
    }
    const int has_end_event = event >= 0 && fraction < 1.0;
    const int is_known = has_end_event && run->counts.steps > 0 && run->roots.samples.negative_fraction == fraction;
    if (is_known)
        check_interior_state(
            run, step, fraction, 0, run->roots.samples.y, run->roots.samples.dy, &run->roots.samples.rhs, p);
    if (n_points || (has_end_event && !is_known) || is_measured) {
        const DiscreteState discrete = run->discrete;
        if (has_end_event && !is_known)
            check_interior_point(run, step, fraction, 0, p);
        for (int k = 0; k < n_points; k++)
            check_interior_point(run, step, fraction * (k + draw_random_number(audit)) / n_points, is_random, p);
        if (is_random && fraction >= 1.0)
            check_rates_at_step_end(run, step, p);
        if (is_measured && is_whole && has_step_size_control(run))
            check_step_error(run, step, p);
        if (is_random || (is_due && is_whole)) {
            const double first = audit->n_drawn++ ? 1.0 : AUDIT_FIRST_FRACTION;
            audit->next_audited_step = run->counts.steps + 1 + (long)(2.0 * draw_random_number(audit) * first
                * compute_mean_check_interval(step->method));
        }
        audit->n_long_steps += is_longer;
        run->discrete = discrete;
    }
    /* checks do not count as integration: the dense output is computed and counted again when needed */
    restore_evaluations(run, evaluations);
    step->dense_ready = dense_ready;
}

