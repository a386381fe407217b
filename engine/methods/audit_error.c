/* Independent check of the integration errors of whole steps (run/audit.c), and the scales of these errors. */
#define AUDIT_DIGITS 1e-10 /* of a state: smaller differences are rounding */
#define AUDIT_RATE_DIGITS 1e-13 /* of positions and time: their uncertainty where rates are compared */
#define AUDIT_STEP 15.0 /* tolerances: allowed error of a step */
#define AUDIT_ORDER 1e-3 /* of the change of rates over a step: allowed mean error */
#define AUDIT_LOOSE_TOL 1e-6 /* tolerance above which that limit grows with its root */
#define AUDIT_MIN_ERROR_SUM 100.0  /* tolerances: sum of errors of all steps from which on they count */
#define AUDIT_MIN_TOL 1e-9 /* smallest tolerance of the check: below, stiff forces are rounding */
enum { AUDIT_MIN_MEASURED_STEPS = 3 }; /* measured steps for a mean error */

/*
 * Return whether the frozen branches and the contacts of compliant joints agree with the switching functions and
 * penetrations in `rhs`. Near a switching point or a separation they may not, and a check is then omitted. Rigid joints
 * are not compared.
 */
static int is_branch_consistent(const Integrator *run, const RhsOutputs *rhs)
{
    int is_consistent = 1;
    for (int k = 0; k < N_SWITCHES; k++)
        is_consistent &= !(run->discrete.branch[k] * rhs->g[k] < 0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        is_consistent &= !is_compliant(i) || !run->discrete.contact[i].closed == !(rhs->clearance[i].delta > 0.0);
    return is_consistent;
}

/*
 * Return the error weight, 1/tolerance, of component k (0 ... 2 N_X - 1: coordinates, then velocities) of the state. It
 * is computed independently of scalar_simd/error_weights.h, as a check.
 */
static double compute_audit_weight(const Integrator *run, int k)
{
    const int kind = is_angle[k % N_X];
    return run->norm.inverse_scale[k] / (k < N_X ? 1.0 : run->norm.speed[kind] + run->norm.speed_floor[kind]);
}

/*
 * Return whether a rate of a drive jumps, or is unbounded, at the beginning or at the end of a step. Checks that fail
 * in such a step are not recorded. Always 0 in scenes without drives.
 */
static int has_drive_jump_at_ends(const Integrator *run, const Step *step, const Parameters *p)
{
    for (int end = 0; end < 2 && N_DRIVES; end++) {
        const double t = end ? step->t + step->h : run->t;
        double absolute_state[N_S];
        convert_integrated_to_absolute(t, end ? step->y : run->y, &run->discrete, p, absolute_state);
        if (has_drive_jump(t, get_jump_interval(t), absolute_state, absolute_state + N_Q, p))
            return 1;
    }
    return 0;
}

/*
 * Estimate the rounding error of the rates `dy` of coordinates and velocities at time t and state y: their change if
 * positions and time change by AUDIT_RATE_DIGITS. It is large near an equilibrium, where large forces cancel.
 * rounding (2 N_X): result, in the units of dy. Return 0, or the status of an evaluation that fails.
 */
static int estimate_rounding_of_rates(Integrator *run, double t, const double *y, const double *dy,
    const Parameters *p, double *rounding)
{
    double perturbed[N_Y], rate[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        perturbed[k] = k < N_X ? y[k] * (1.0 + (k % 2 ? -AUDIT_RATE_DIGITS : AUDIT_RATE_DIGITS)) : y[k];
    const int status = evaluate_run_rhs(run, t * (1.0 - AUDIT_RATE_DIGITS), perturbed, p, rate, &rhs);
    for (int k = 0; k < 2 * N_X; k++)
        rounding[k] = fabs(rate[k] - dy[k]);
    return status;
}

/*
 * Add the error of a measured step to the sums of the audit, and record the mean error as CHECK_step. Its limit is
 * AUDIT_ORDER of the mean change of rates over a step, more for loose tolerances. A method that has lost its order
 * exceeds it. error, change: of this step, in tolerances.
 *
 * Steps limited by stability (h rho >= 1) are not counted. No check is made before AUDIT_MIN_MEASURED_STEPS steps, or
 * while the errors extrapolated to all steps sum up to less than AUDIT_MIN_ERROR_SUM tolerances.
 */
static void check_convergence_order(Integrator *run, double error, double change)
{
    Audit *audit = &run->audit;
    if (!(run->choice.h_rho < 1.0 && change < INFINITY))
        return;
    audit->n_measured++;
    audit->error_sum += error;
    audit->change_sum += change;
    const double limit = AUDIT_ORDER * max_of(1.0, sqrt(get_rtol(run) / AUDIT_LOOSE_TOL));
    if (audit->n_measured >= AUDIT_MIN_MEASURED_STEPS
        && audit->error_sum / audit->n_measured * (double)run->counts.steps > AUDIT_MIN_ERROR_SUM)
        record_check(audit, CHECK_step, audit->error_sum, limit * audit->change_sum, run->t, -1);
}

/* Nodes of Gauss quadrature of order 8 over (0, 1). */
static const double gauss_node[] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};

/* Weights of Gauss quadrature of order 8 over (0, 1). */
static const double gauss_weight[] = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307,
    0.17392742256872692};

/*
 * Return the largest component of a step's `error` (coordinates and velocities, 2 N_X) as a multiple of `allowed_error`
 * tolerances plus rounding of the state and of its rates (`rounding_of_rates`). error_norm: set to the largest error
 * less rounding, in tolerances, at least 0.
 */
static double find_largest_error(const Integrator *run, const Step *step, const double *error,
    const double *rounding_of_rates, double allowed_error, double *error_norm)
{
    double worst = 0.0;
    *error_norm = 0.0;
    for (int k = 0; k < 2 * N_X; k++) {
        const double weight = compute_audit_weight(run, k);
        const double rounding = AUDIT_DIGITS * (fabs(step->y[k]) + fabs(step->h * step->dy[k]))
            + step->h * rounding_of_rates[k];
        worst = max_of(worst, fabs(error[k]) * weight / (allowed_error + rounding * weight));
        *error_norm = max_of(*error_norm, (fabs(error[k]) - rounding) * weight);
    }
    return worst;
}

/*
 * Check the local error of a step by the integral of the defect of its dense output u, and record it as CHECK_step. The
 * error is e = y(t + h) - y(t) - int f(s, u(s)) ds by Gauss quadrature with four nodes. It uses neither the method's
 * error estimate nor its coefficients. For stiff methods, and if e is too large, e is divided by 1 - h J, as u itself
 * has errors there. Omitted are the first step, and steps with a crossed switching point, near a singular position, or
 * with other branches.
 */
static void check_step_error(Integrator *run, Step *step, const Parameters *p)
{
    const int stiff = step->method->stiff;
    const double h = step->h;
    double y[N_Y], dy[N_Y], rate[N_Y], rounding[2 * N_X];
    double mean[N_Y] = {0.0}, error[N_Y], error_norm, change = 0.0; /* mean defect, 1/s */
    RhsOutputs rhs;
    for (int k = 0; k < N_SWITCHES; k++)
        if (step->is_ignored[k])
            return;
    if (run->counts.steps == 0 || run->discrete.singular_policy != SINGULAR_CONTINUE
        || compute_dense_output(run, p, step))
        return; /* the first step projects a start that violates the constraints */
    const double limit = AUDIT_STEP * max_of(1.0, AUDIT_MIN_TOL / get_rtol(run));
    for (int n = 0; n < COUNT_OF(gauss_node); n++) {
        interpolate(run, step, gauss_node[n], y);
        if (evaluate_run_rhs(run, step->t + gauss_node[n] * h, y, p, dy, &rhs) || !is_branch_consistent(run, &rhs))
            return;
        interpolate_rates(step, gauss_node[n], N_Y, rate);
        for (int k = 0; k < N_Y; k++)
            mean[k] += gauss_weight[n] * (rate[k] - dy[k]);
        for (int k = 0; k < 2 * N_X; k++)
            change = max_of(change, h * fabs(dy[k] - run->dy[k]) * compute_audit_weight(run, k));
    }
    if (estimate_rounding_of_rates(run, step->t + gauss_node[COUNT_OF(gauss_node) - 1] * h, y, dy, p, rounding))
        return;
    for (int k = 0; k < N_Y; k++)
        error[k] = h * mean[k];
    double worst = stiff ? INFINITY : find_largest_error(run, step, error, rounding, limit, &error_norm);
    if (worst > 1.0) {
        if (factor_newton_matrix(run, h, p))
            return;
        newton_solve(&run->newton.linear, h, 0.0, mean, error);
        worst = find_largest_error(run, step, error, rounding, limit, &error_norm);
    }
    check_convergence_order(run, error_norm, change);
    run->audit.longest_measured = max_of(run->audit.longest_measured, h);
    if (worst <= 1.0 || !has_drive_jump_at_ends(run, step, p))
        record_check(&run->audit, CHECK_step, worst, 1.0, step->t + h, -1);
}
