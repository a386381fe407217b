/*
 * Acceptance in SIMD lanes of steps with error control, while no contact is closed (lane_local_steps.c): tests whether
 * a step needs the functions for single runs, and all changes that an accepted step makes.
 */

/*
 * Load into lane k the step limits of a run and the state of its step-size control: length before limits, last error,
 * observed order, last length, and for the choice of the method the number of successive steps that favour the other
 * method (n_opposing_steps) and the length of the first of them. Also its largest constraint residuals, its record of
 * film errors, its peaks, and scales of switching functions. The count of evaluations starts at 0. Called before steps
 * that are accepted in the lane (local steps).
 */
static void load_controller_state(
    LaneLocalSteps *local_steps, int k, const LocalStepLimits *limits, const Integrator *run)
{
    for (size_t j = 0; j < sizeof limits->limits / sizeof(double); j++)
        ((Lanes *)&local_steps->limits)[j][k] = ((const double *)&limits->limits)[j];
    local_steps->h[k] = run->control.h;
    local_steps->error_before[k] = run->control.error_before;
    local_steps->observed_order[k] = run->control.observed_order;
    local_steps->last_step[k] = run->control.last_step;
    local_steps->n_opposing[k] = run->choice.n_opposing_steps;
    local_steps->opposing_length[k] = run->choice.opposing_length;
    local_steps->phi_max[k] = run->residuals.phi_max;
    local_steps->phi_dot_max[k] = run->residuals.phi_dot_max;
    local_steps->evaluations[k] = 0.0;
    local_steps->film_error[k] = run->films.error;
    local_steps->film_h[k] = run->films.h;
    local_steps->film_steps[k] = (double)(run->counts.steps - run->films.steps);
    for (int i = 0; i < N_CLEARANCES; i++) {
        local_steps->e_max[i][k] = run->contacts.e_max[i];
        local_steps->F_peak[i][k] = run->contacts.F_peak[i];
        local_steps->t_peak[i][k] = run->contacts.t_peak[i];
        local_steps->is_rising[i][k] = -!!run->contacts.is_rising[i];
    }
    for (int i = 0; i < N_SWITCHES; i++)
        local_steps->switch_scale[i][k] = run->audit.switch_scale[i];
}

/* Return the magnitude of the force of joint i in each lane, N. */
static Lanes compute_lane_force(const LaneRhsOutputs *rhs, int i) { return lanes_sqrt(compute_squared_force(rhs, i)); }

/*
 * Return the mask of the lanes in which no event function of a step has a zero: none is negative at a stage or at the
 * end, and no gap can reach zero between. event_functions: at the end of the step.
 */
static LaneBits find_lanes_without_events(
    const LaneLocalSteps *local_steps, const LaneIntegrator *lanes, const LaneStep *step, const Lanes *event_functions)
{
    LaneBits found = ~(LaneBits){0};
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        found &= ~((event_functions[j] < 0.0) | (step->min_event_value[j] < 0.0));
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *begin = &lanes->rhs.clearance[i], *end = &step->rhs.clearance[i];
        found &= compute_gap_lower_bound(step, i, -begin->delta, -end->delta, begin->deltadot, end->deltadot)
            > local_steps->limits.gap[i];
    }
    return found;
}

/*
 * Return the largest force (N) of joint i over the stored stages strictly inside the step, 0 if no stage is. It is the
 * square root of stage_values, which hold squares of forces.
 */
static Lanes find_largest_stage_force(const LaneStep *step, int i)
{
    Lanes largest_square = broadcast(0.0);
    for (int s = 0; s < step->n_stored_stages; s++)
        if (step->node[s] > 0.0 && step->node[s] < 1.0)
            largest_square = lanes_max_of(largest_square, step->stage_values[s][STAGE_FORCES + i]);
    return lanes_sqrt(largest_square);
}

#if IMPLICIT_STAGES
/*
 * Return the error of film forces inside a step of radau5 or radau9 in multiples of its limit, as measure_film_error()
 * does, in all lanes. Lanes in which the state there cannot be evaluated are removed from the mask `found`.
 */
static Lanes measure_lane_film_error(const LaneLocalSteps *local_steps, LaneIntegrator *lanes, int method,
    const LaneStep *step, const LaneParameters *p, LaneBits *found)
{
    const int stages = method == METHOD_RADAU5 ? 3 : 5;
    const double fraction = method == METHOD_RADAU5 ? RADAU5_ERROR_FRACTION : RADAU9_ERROR_FRACTION;
    Lanes change[N_Y], dense[RADAU_MAX_STAGES][N_Y], y[N_Y], dy[N_Y], rate[N_Y];
    const Lanes *values[RADAU_MAX_STAGES], t = step->t + fraction * step->h;
    LaneRhsOutputs rhs;
    for (int i = 0; i < N_Y; i++)
        change[i] = step->y[i] - lanes->y[i];
    for (int s = 0; s < stages; s++)
        values[s] = s < stages - 1 ? step->k[s] : change;
    compute_collocation_polynomial(method == METHOD_RADAU5 ? &RADAU5 : &RADAU9, stages, values, dense);
    evaluate_collocation_polynomial(lanes->y, (const Lanes (*)[N_Y])dense, fraction, y);
    lanes->discrete.needs_scalar = (LaneBits){0};
    project_onto_constraints(lanes, t, y, NULL, p);
    evaluate_run_rhs(lanes, t, y, p, dy, &rhs);
    *found &= ~lanes->discrete.needs_scalar;
    differentiate_dense_output(step->h, (const Lanes (*)[N_Y])dense, RADAU_DEGREE, RADAU_REVERSED, fraction, 2 * N_X,
        rate);
    const Lanes force_at_ends =
        lanes_max_of(compute_largest_film_force(&step->rhs), compute_largest_film_force(&lanes->rhs));
    return compute_relative_film_error(lanes, step, rate, dy,
        lanes_max_of(force_at_ends, compute_largest_film_force(&rhs)), FILM_SCALE_FRACTION)
        / local_steps->limits.film_error;
}
#endif

/*
 * Check the error of film forces of a step by radau5 or radau9 in the lanes `found`, as accept_or_retry_step() does,
 * and return the error norm of the step, which is at least that of the films where these were measured. Lanes that do
 * not accept the step are removed from `found`. is_measured: set to the lanes in which film_error is the measured
 * error, in multiples of its limit. Nothing is checked without films or for other methods.
 */
static Lanes check_film_errors(const LaneLocalSteps *local_steps, LaneIntegrator *lanes, int method,
    const LaneStep *step, const LaneParameters *p, LaneBits *found, LaneBits *is_measured, Lanes *film_error)
{
    Lanes error = step->error;
    *is_measured = (LaneBits){0};
#if IMPLICIT_STAGES
    if (!has_films() || method < METHOD_RADAU5)
        return error;
    const Lanes end_error = step->film_error / local_steps->limits.film_error;
    *found &= ~(end_error > 1.0);
    *is_measured = *found & ~is_last_film_error_valid(end_error, step->h, local_steps->film_error, local_steps->film_h,
        local_steps->film_steps);
    if (any_of(*is_measured)) {
        LaneBits is_known = ~(LaneBits){0};
        *film_error = measure_lane_film_error(local_steps, lanes, method, step, p, &is_known);
        error = select_value(*is_measured, lanes_max_of(error, *film_error), error);
        *found &= ~*is_measured | (is_known & (error <= lanes->control.max_accepted_error));
    }
#else
    (void)local_steps, (void)lanes, (void)method, (void)p, (void)found, (void)film_error;
#endif
    return error;
}

/*
 * Find the lanes in which no peak of a force or an eccentricity lies inside a step, as find_inner_peaks() does for open
 * contacts. `found`: lanes for which that is to be known. Lanes with a peak, or for which the single run must search
 * it, are removed. Return the mask of the lanes that evaluated the forces just after the step. is_rising: set to
 * whether the force of each joint rises at the end.
 */
static LaneBits exclude_peaks_within_step(const LaneLocalSteps *local_steps, LaneIntegrator *lanes, int method,
    const LaneStep *step, const LaneParameters *p, LaneBits *found, LaneBits *is_rising)
{
    LaneBits is_candidate[AT_LEAST_ONE(N_CLEARANCES)], has_trend[AT_LEAST_ONE(N_CLEARANCES)], needs_trend = {0};
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *begin = &lanes->rhs.clearance[i], *end = &step->rhs.clearance[i];
        is_rising[i] = ~(LaneBits){0};
        is_candidate[i] = (LaneBits){0};
        *found &= ~((begin->deltadot > 0.0) & (end->deltadot < 0.0));
        if (!has_film(i))
            continue;
        const Lanes force_begin = compute_lane_force(&lanes->rhs, i), force_end = compute_lane_force(&step->rhs, i);
        const Lanes larger = lanes_max_of(force_begin, force_end);
        *found &= ~(find_largest_stage_force(step, i) > local_steps->limits.peak_ratio * larger);
        is_candidate[i] = (larger > FILM_PEAK_RATIO * local_steps->F_peak[i]) & (larger > 0.0);
        has_trend[i] = force_end < 1e-6 * force_begin;
        needs_trend |= is_candidate[i] & ~has_trend[i];
    }
    if (method < METHOD_RODAS5P)
        *found &= ~needs_trend; /* the stages of an explicit step show the trend */
    needs_trend &= *found;
    if (any_of(needs_trend)) {
        Lanes y[N_Y], dy[N_Y];
        LaneRhsOutputs rhs;
        const Lanes duration = FORCE_AHEAD * step->h;
        for (int j = 0; j < N_Y; j++)
            y[j] = step->y[j] + duration * step->dy[j];
        lanes->discrete.needs_scalar = (LaneBits){0};
        evaluate_run_rhs(lanes, step->t + step->h + duration, y, p, dy, &rhs);
        *found &= ~(needs_trend & lanes->discrete.needs_scalar);
        for (int i = 0; i < N_CLEARANCES; i++)
            if (has_film(i))
                is_rising[i] = ~is_candidate[i]
                    | (~has_trend[i] & (compute_lane_force(&rhs, i) > compute_lane_force(&step->rhs, i)));
    }
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i)) {
            const LaneBits reverses = lanes->rhs.clearance[i].F_n * step->rhs.clearance[i].F_n < 0.0;
            is_rising[i] &= ~(is_candidate[i] & has_trend[i]);
            *found &= ~(is_candidate[i] & (~is_rising[i] | reverses) & local_steps->is_rising[i]);
        }
    return needs_trend;
}

/*
 * Update, in the lanes `accepted`, the largest eccentricity and the largest force of each joint, with its time, by
 * their values at the end of the step, time t (s). is_rising: whether each force rises there; stored for the next step.
 */
static void update_lane_peaks(LaneLocalSteps *local_steps, const LaneStep *step, LaneBits accepted, Lanes t,
    const LaneBits *is_rising)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes force = compute_lane_force(&step->rhs, i);
        const LaneBits is_higher = accepted & (force > local_steps->F_peak[i]);
        local_steps->e_max[i] = select_value(accepted,
            lanes_max_of(step->rhs.clearance[i].e, local_steps->e_max[i]), local_steps->e_max[i]);
        local_steps->F_peak[i] = select_value(is_higher, force, local_steps->F_peak[i]);
        local_steps->t_peak[i] = select_value(is_higher, t, local_steps->t_peak[i]);
        local_steps->is_rising[i] = (accepted & is_rising[i]) | (~accepted & local_steps->is_rising[i]);
    }
}

/*
 * Make the end of the step the state of the lanes `accepted`, at time t (s), and update speeds, energy scale and error
 * weights. The state at the beginning is stored as start of the previous step for the stage predictor.
 */
static void move_to_step_end(
    LaneLocalSteps *local_steps, LaneIntegrator *lanes, const LaneStep *step, LaneBits accepted, Lanes t)
{
    update_energy_scale(lanes, accepted, step->y);
    local_steps->begin = select_value(accepted, lanes->t, local_steps->begin);
    local_steps->last_step = select_value(accepted, t - lanes->t, local_steps->last_step);
    for (int j = 0; j < N_Y; j++) {
#if IMPLICIT_STAGES
        lanes->newton.previous_y[j] = select_value(accepted, lanes->y[j], lanes->newton.previous_y[j]);
        lanes->newton.previous_dy[j] = select_value(accepted, lanes->dy[j], lanes->newton.previous_dy[j]);
#endif
        lanes->y[j] = select_value(accepted, step->y[j], lanes->y[j]);
        lanes->dy[j] = select_value(accepted, step->dy[j], lanes->dy[j]);
    }
#if IMPLICIT_STAGES
    lanes->newton.last_h = select_value(accepted, t - lanes->t, lanes->newton.last_h);
    lanes->newton.can_extrapolate |= accepted;
    local_steps->convergence_rate =
        select_value(accepted, lanes->newton.convergence_rate, local_steps->convergence_rate);
#endif
    for (size_t j = 0; j < sizeof lanes->rhs / sizeof(Lanes); j++)
        ((Lanes *)&lanes->rhs)[j] =
            select_value(accepted, ((const Lanes *)&step->rhs)[j], ((const Lanes *)&lanes->rhs)[j]);
    lanes->t = select_value(accepted, t, lanes->t);
    update_speeds(lanes);
    update_error_weights(lanes);
}

/*
 * Choose the length *h (s) of the next step in the lanes `accepted`, as choose_next_length() and open_attempt() do:
 * from the error norm of the step (`step_error`), and not beyond the next contact of an approaching joint or the end of
 * the run. Also store what the controller of later steps needs: last error, observed order, length before these two
 * limits, mean length, h rho.
 */
static void choose_lane_lengths(LaneLocalSteps *local_steps, const LaneIntegrator *lanes, const LaneStep *step,
    Lanes step_error, LaneBits accepted, Lanes *h)
{
    const Lanes error = lanes_max_of(broadcast(MIN_ERROR), step_error), h_rho = lanes->choice.h_rho;
    const Lanes order = local_steps->observed_order * ORDER_DECAY;
    const Lanes ratio = compute_length_ratio(error, local_steps->error_before, h_rho, order, local_steps->limits.power,
        local_steps->limits.limiting_h_rho);
    Lanes next = step->h
        * lanes_min_of(broadcast(MAX_GROWTH), lanes_max_of(broadcast(MIN_GROWTH), ratio));
    local_steps->observed_order = select_value(accepted, order, local_steps->observed_order);
    local_steps->error_before =
        select_value(accepted, lanes_max_of(broadcast(MIN_LAST_ERROR), error), local_steps->error_before);
    local_steps->mean_length =
        select_value(accepted, update_mean_length(local_steps->mean_length, step->h), local_steps->mean_length);
    local_steps->h_rho = select_value(accepted, h_rho, local_steps->h_rho);
    local_steps->h = select_value(accepted, next, local_steps->h);
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *joint = &step->rhs.clearance[i];
        const Lanes flight = compute_flight_length(local_steps->limits.clearance[i], joint->delta, joint->deltadot);
        next = select_value(joint->deltadot < 0.0, lanes_min_of(next, flight), next);
    }
    *h = select_value(accepted, limit_length_by_end(local_steps, lanes, next), *h);
}

/*
 * Return, for each lane, the number of successive steps, including this one, whose stiffness h rho speaks for the other
 * method (explicit or stiff): h_rho is outside min_rho..max_rho of the limits. 0 where it is within. This stiffness
 * detection decides the switch of the method (switch_method_after_step()).
 */
static Lanes count_steps_for_method_switch(const LaneLocalSteps *local_steps, Lanes h_rho)
{
    const LaneBits is_against = (h_rho < local_steps->limits.min_rho) | (h_rho > local_steps->limits.max_rho);
    return select_value(is_against, local_steps->n_opposing + 1.0, broadcast(0.0));
}

/*
 * Accept the steps tried by `method` that need no action of their run, in the lanes of the mask `requested`, and return
 * the mask of their lanes. Time, state, error weights, peaks, residuals and the lengths h (s) of the next steps are
 * updated as after a single step.
 */
static LaneBits accept_lane_local_steps(LaneLocalSteps *local_steps, LaneIntegrator *lanes, int method,
    LaneBits requested, LaneStep *step, const LaneParameters *p, Lanes *h)
{
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    LaneBits is_rising[AT_LEAST_ONE(N_CLEARANCES)], is_measured;
    Lanes film_error = broadcast(0.0);
    const Lanes t = lanes->t + step->h, h_rho = lanes->choice.h_rho;
    LaneBits accepted = requested & local_steps->may_accept & step->is_accepted;
    if (!any_of(accepted))
        return accepted;
    const Lanes n_opposing = count_steps_for_method_switch(local_steps, h_rho);
    const Lanes phi_max = lanes_max_of(step->residual[0], local_steps->phi_max);
    evaluate_lane_event_functions(lanes, &step->rhs, event_functions);
    accepted &= find_unsampled_steps(local_steps, lanes, step, t) & (step->h < local_steps->limits.max_length)
        & (step->h <= local_steps->limits.max_ratio * local_steps->last_step)
        & ~(h_rho > local_steps->limits.unstable) & (n_opposing < local_steps->limits.max_opposing)
        & (phi_max <= local_steps->limits.residual)
        & find_lanes_without_events(local_steps, lanes, step, event_functions);
    if (!any_of(accepted))
        return accepted;
    const Lanes error =
        check_film_errors(local_steps, lanes, method, step, p, &accepted, &is_measured, &film_error);
    LaneBits has_looked_ahead = exclude_peaks_within_step(local_steps, lanes, method, step, p, &accepted, is_rising);
    has_looked_ahead &= accepted;
    is_measured &= accepted;
    local_steps->film_error = select_value(is_measured, film_error, local_steps->film_error);
    local_steps->film_h = select_value(is_measured, step->h, local_steps->film_h);
    local_steps->film_steps = select_value(is_measured, broadcast(0.0), local_steps->film_steps)
        + select_value(accepted, broadcast(1.0), broadcast(0.0));
    const Lanes evaluations = count_trial_evaluations(lanes, method) + 1.0; /* and that at the end */
    local_steps->evaluations += select_value(accepted, evaluations, broadcast(0.0))
        + select_value(has_looked_ahead, broadcast(1.0), broadcast(0.0))
        + select_value(is_measured, broadcast(1.0), broadcast(0.0));
    local_steps->n_opposing = select_value(accepted, n_opposing, local_steps->n_opposing);
    local_steps->opposing_length =
        select_value(accepted & (n_opposing == 1.0), step->h, local_steps->opposing_length);
    local_steps->phi_max = select_value(accepted, phi_max, local_steps->phi_max);
    local_steps->phi_dot_max = select_value(accepted,
        lanes_max_of(step->residual[1], local_steps->phi_dot_max), local_steps->phi_dot_max);
    for (int i = 0; i < N_SWITCHES; i++)
        local_steps->switch_scale[i] = select_value(accepted,
            lanes_max_of(local_steps->switch_scale[i], lanes_fabs(event_functions[N_CLEARANCES + i])),
            local_steps->switch_scale[i]);
    update_lane_peaks(local_steps, step, accepted, t, is_rising);
    move_to_step_end(local_steps, lanes, step, accepted, t);
    choose_lane_lengths(local_steps, lanes, step, error, accepted, h);
    count_local_steps(local_steps, accepted);
    return accepted;
}

static void scatter_rhs(const LaneRhsOutputs *lane_rhs, int k, RhsOutputs *rhs); /* lane_exchange.c */

#if IMPLICIT_STAGES
/*
 * Copy the beginning of the last step accepted in lane k, from which guesses of the next stages are extrapolated, to
 * its run. Then move the run's predictor to the present step, as gather_stage_predictor() does: that step has been
 * tried already.
 */
static void flush_stage_predictor(
    const LaneLocalSteps *local_steps, const LaneIntegrator *lanes, int k, Integrator *run)
{
    run->newton.convergence_rate = local_steps->convergence_rate[k];
    run->newton.n_recorded_steps = run->counts.steps - 1;
    run->newton.current_start.t = local_steps->begin[k];
    for (int j = 0; j < N_Y; j++) {
        run->newton.current_start.y[j] = lanes->newton.previous_y[j][k];
        run->newton.current_start.dy[j] = lanes->newton.previous_dy[j][k];
    }
    update_stage_predictor(run);
}
#endif

/*
 * Copy the peaks of the joints, the largest constraint residuals and, with an audit, the scales of switching functions
 * of lane k to its run. Its counts of steps that ended on a wrong branch become 0.
 */
static void flush_peaks_and_residuals(const LaneLocalSteps *local_steps, int k, Integrator *run)
{
    run->residuals.phi_max = local_steps->phi_max[k];
    run->residuals.phi_dot_max = local_steps->phi_dot_max[k];
    for (int i = 0; i < N_CLEARANCES; i++) {
        run->contacts.e_max[i] = local_steps->e_max[i][k];
        run->contacts.F_peak[i] = local_steps->F_peak[i][k];
        run->contacts.t_peak[i] = local_steps->t_peak[i][k];
        run->contacts.is_rising[i] = -(int)local_steps->is_rising[i][k];
    }
    for (int i = 0; i < N_SWITCHES && run->audit.level; i++) {
        run->audit.switch_scale[i] = local_steps->switch_scale[i][k];
        run->audit.n_wrong_steps[i] = 0;
    }
}

/*
 * Copy the steps accepted in lane k to its run: state, counts, peaks, residuals, film-error record, method counters and
 * controller state. Then open the run's next attempt with length h (s) by the same method. The run's linearization is
 * discarded. Copies nothing if the lane has accepted no step since it was loaded; the lane is empty afterwards in any
 * case.
 */
static void flush_lane_local_steps(
    LaneLocalSteps *local_steps, const LaneIntegrator *lanes, int k, double h, Integrator *run)
{
    const long steps = local_steps->steps[k];
    const int method = run->control.attempt.lane_method, is_stiff = method >= METHOD_RODAS5P;
    local_steps->has_state[k] = 0;
    if (!steps)
        return;
    flush_state(lanes, k, steps, run);
    scatter_rhs(&lanes->rhs, k, &run->rhs);
    run->counts.evaluations += (long)local_steps->evaluations[k];
    run->counts.stiff_steps += is_stiff ? steps : 0;
    run->counts.jacobians += is_stiff ? steps - !!run->newton.ready : 0;
    run->newton.ready = 0;
    flush_peaks_and_residuals(local_steps, k, run);
    run->films.error = local_steps->film_error[k];
    run->films.h = local_steps->film_h[k];
    run->films.steps = run->counts.steps - (long)local_steps->film_steps[k];
    run->choice.h_rho = local_steps->h_rho[k];
    run->choice.mean_length[is_stiff] = local_steps->mean_length[k];
    run->choice.n_opposing_steps = (int)local_steps->n_opposing[k];
    run->choice.opposing_length = local_steps->opposing_length[k];
    run->control.h = local_steps->h[k];
    run->control.error_before = local_steps->error_before[k];
    run->control.observed_order = local_steps->observed_order[k];
    run->control.last_step = local_steps->last_step[k];
    run->control.attempt = (Attempt){.h = h, .first_h = h, .remaining_time = local_steps->t_end[k] - run->t,
        .end = local_steps->t_end[k], .time_magnitude = compute_time_scale(local_steps, lanes)[k], .is_open = 1,
        .lane_method = method, .film_error_norm = INFINITY};
#if IMPLICIT_STAGES
    if (method >= METHOD_RADAU5)
        flush_stage_predictor(local_steps, lanes, k, run);
#endif
}
