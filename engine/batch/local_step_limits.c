/*
 * Limits of the steps that SIMD lanes accept without a call of the functions for single runs (lane_local_steps.c). Such
 * a step changes the state, error weights, peaks, step length and counts of the run, and nothing else. It ends no
 * search, changes no contact, branch or method and leaves the record of the audit as it is.
 */

/*
 * Return the number of steps that a run may make in the lanes without a call of the scalar code: until its next
 * progress check or audited step. It is 0 if each step is recorded (step record, envelope) or audited (AUDIT_FULL).
 */
static long count_steps_before_scalar_code(const Integrator *run)
{
    const long steps =
        run->step_record.rows || run->envelope.rows ? 0 : count_steps_before_check(&run->progress.monitor);
    const long unchecked_steps = run->audit.level == AUDIT_FULL ? 0 : run->audit.next_audited_step - run->counts.steps;
    return run->audit.level && unchecked_steps < steps ? (unchecked_steps > 0 ? unchecked_steps : 0) : steps;
}

/*
 * Return whether a step without a violation leaves the record of the audit as it is: there is no audit, or all checks
 * of the ends of steps are recorded. Their values are then 0, except the residual of the closures, for which the limit
 * of the lanes is set; its recorded value must be within its limit.
 */
static int are_end_checks_recorded(const Integrator *run)
{
    const AuditRecord *record = run->audit.record;
    int is_recorded = record[CHECK_position].max_ratio >= 0.0 && record[CHECK_position].max_ratio < 1.0
        && (N_SWITCHES == 0 || record[CHECK_branch].max_ratio >= 0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        is_recorded &= record[CHECK_gap].max_ratio >= 0.0 && (has_film(i) || record[CHECK_free].max_ratio >= 0.0);
    return !run->audit.level || is_recorded;
}

/*
 * Return whether the next step of a run is an ordinary one. It is not if it is the first of the run or after an event,
 * a contact is closed, branches are not frozen, a switching point is suppressed, or a singular position is near. Nor is
 * it while the costs of both methods of `auto` are compared, or if a stiff method without iterated stages meets a film.
 */
static int is_ordinary_step(const Integrator *run)
{
    const MethodChoice *choice = &run->choice;
    int has_contact = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        has_contact |= run->discrete.contact[i].closed;
    if (has_contact)
        return 0;
    const int is_compared = choice->method->stiff ? has_films() && choice->method->lane_method < METHOD_RADAU5
        : (choice->steps_since_change <= MIN_RETURN_STEPS && choice->rho > 0.0)
            || (choice->steps_since_change < MAX_COMPARE_STEPS && run->control.h_stiff > 0.0);
    const int is_regular = run->near_singular.n_steps_without_detection == 0 && run->near_singular.n_failed == 0
        && run->discrete.singular_policy == SINGULAR_CONTINUE;
    return !run->control.stored_first_length && run->roots.suppressed_switch < 0 && is_regular && !is_compared
        && run->counts.steps > 1 && run->discrete.is_frozen;
}

/*
 * Return the number of steps of a stiff method until the lengths of both methods are compared
 * (switch_method_after_step()).
 */
static long count_steps_before_comparison(const Integrator *run)
{
    const int phase = run->choice.steps_since_change % CHECK_STIFF_STEPS;
    return !run->choice.method->stiff ? LONG_MAX
        : (MIN_COMPARE_STEPS - phase + CHECK_STIFF_STEPS) % CHECK_STIFF_STEPS;
}

/*
 * Return the number of the next steps that the audit does not measure however long they are, because it has measured
 * enough (audit_step()). 0: long steps are measured. LONG_MAX without an audit, or if that number exceeds 1e9.
 */
static long count_steps_without_length_check(const Integrator *run)
{
    const double first_measured =
        ((double)run->audit.n_long_steps + 1.0) * compute_mean_check_interval(run->choice.method);
    const double remaining_steps = first_measured - (double)run->counts.steps;
    return !run->audit.level || remaining_steps > 1e9 ? LONG_MAX
        : remaining_steps >= 0.0 ? (long)remaining_steps + 1 : 0;
}

/*
 * Set `local_limits`: the limits of the next steps of a run (batch.h), and local_limits->max_steps, the number of steps
 * that a lane may accept before the run is called. This number is 0, and no limit is set, with fixed steps, after a
 * rejected attempt, if the next step is not ordinary (is_ordinary_step()), or if the audit is due. A step by Taylor
 * series needs that number only. parameters: those of the run.
 */
static void get_local_step_limits(const void *integrator, const double *parameters, LocalStepLimits *local_limits)
{
    const Integrator *run = integrator;
    const Method *method = run->choice.method;
    const Parameters *p = (const Parameters *)parameters;
    local_limits->max_steps = 0;
    if (run->control.fixed > 0.0 || run->control.attempt.was_rejected)
        return;
    if (run->control.attempt.lane_method == METHOD_TAYLOR)
        local_limits->max_steps = count_steps_before_scalar_code(run);
    if (run->control.attempt.lane_method == METHOD_TAYLOR || !is_ordinary_step(run) || !are_end_checks_recorded(run))
        return;
    const long steps = count_steps_before_scalar_code(run), compared_steps = count_steps_before_comparison(run);
    const long unlimited_steps = count_steps_without_length_check(run);
    local_limits->max_steps = steps < compared_steps ? steps : compared_steps;
    if (unlimited_steps > 0 && unlimited_steps < local_limits->max_steps)
        local_limits->max_steps = unlimited_steps;
    if (local_limits->max_steps <= 0)
        return;
    const double checked = max_of(run->audit.record[CHECK_position].max_ratio, 0.0), rtol = get_audit_tolerance(run);
    local_limits->limits.power = method->power;
    local_limits->limits.limiting_h_rho = method->limiting_h_rho;
    local_limits->limits.unstable = method->rejected_h_rho;
    local_limits->limits.min_rho = method->stiff ? MAX_EXPLICIT_STABILITY : -INFINITY;
    local_limits->limits.max_rho = method->stiff ? INFINITY : method->limiting_h_rho;
    local_limits->limits.max_opposing =
        !run->choice.automatic ? INFINITY : method->stiff ? run->choice.return_steps : run->choice.max_opposing_steps;
    local_limits->limits.max_length = unlimited_steps > 0 ? INFINITY
        : AUDIT_MEASURED_LENGTH_RATIO * run->audit.longest_measured;
    local_limits->limits.max_ratio = unlimited_steps > 0 ? INFINITY : AUDIT_LENGTH_RATIO;
    local_limits->limits.film_error = has_films() && method->stiff ? compute_film_error_limit(run) : INFINITY;
    local_limits->limits.peak_ratio = method->stiff ? MAXIMUM_RATIO_STIFF : MAXIMUM_RATIO;
    local_limits->limits.residual = !run->audit.level ? INFINITY
        : max_of(max_of(run->audit.phi_start, run->residuals.phi_max),
        checked * max_of(rtol * run->norm.min_size[0], AUDIT_ROUNDING * get_mechanism_size(run)));
    for (int i = 0; i < N_CLEARANCES; i++) {
        local_limits->limits.gap[i] = compute_dense_output_error(run, i, p);
        local_limits->limits.clearance[i] = radial_clearance(p, i);
    }
}
