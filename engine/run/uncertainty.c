/*
 * Uncertainty of event and switching functions: the effect of rounding and of constraint residuals of the state. A
 * function smaller than its uncertainty has no sign and keeps its branch.
 */
#if N_MONITORED
#define OBSERVED_FACTOR 16.0 /* factor on observed differences, which may consist of rounding only */

/*
 * Add the constraint residual of a state to its error: CLOSING_STEPS times the correction that closes the loops, and
 * the velocity residuals at three patterns of perturbed positions. Near a singular position these exceed rounding.
 * error (2 N_X): m, rad and their rates. Nothing is added without loops or if the correction fails. Called by
 * estimate_state_errors().
 */
static void add_constraint_residuals(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    double dq[N_X + 1], dv[N_X + 1], perturbed[N_Y], residual;
    if (N_LOOPS == 0 || compute_correction(t, y, &run->discrete, p, dq, dv, &residual))
        return;
    for (int k = 0; k < N_X; k++) {
        error[k] += isfinite(dq[k]) ? CLOSING_STEPS * fabs(dq[k]) : 0.0;
        error[N_X + k] += isfinite(dv[k]) ? CLOSING_STEPS * fabs(dv[k]) : 0.0;
    }
    memcpy(perturbed, y, sizeof perturbed);
    for (int pattern = 0; pattern < 3; pattern++) {
        for (int k = 0; k < N_X; k++)
            perturbed[k] = y[k] + (k & pattern ? -error[k] : error[k]);
        if (compute_correction(t, perturbed, &run->discrete, p, dq, dv, &residual))
            continue;
        for (int k = 0; k < N_X; k++)
            error[N_X + k] += isfinite(dv[k]) ? fabs(dv[k]) : 0.0;
    }
}

/*
 * Compute error bounds of coordinates and velocities of a state y: accumulated rounding (ACCUMULATED_ULPS) of the
 * largest length, angle and speed of each kind, plus constraint residuals. error (2 N_X): m, rad and their rates.
 */
static void estimate_state_errors(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    double size[2] = {0.0, 1.0}, speed[2] = {run->norm.speed[0], run->norm.speed[1]};
    for (int k = 0; k < N_X; k++) {
        size[is_angle[k]] = max_of(size[is_angle[k]], fabs(y[k]));
        speed[is_angle[k]] = max_of(speed[is_angle[k]], fabs(y[N_X + k]));
    }
    for (int k = 0; k < N_X; k++) {
        error[k] = ACCUMULATED_ULPS * DBL_EPSILON * size[is_angle[k]];
        error[N_X + k] = ACCUMULATED_ULPS * DBL_EPSILON * (speed[is_angle[k]] + run->norm.speed_rounded[is_angle[k]]);
    }
    add_constraint_residuals(run, t, y, p, error);
}

#if N_FRICTIONS
/*
 * Add the residual slip of sticking friction to the velocity errors in `error` (2 N_X): the velocity change by which an
 * impulse of that friction would stop the slip, with other sticking elements at rest. With a sticking element,
 * coordinate errors are raised to the rounding of the smallest relevant length. Called by
 * estimate_rounding_uncertainty().
 */
static void add_residual_slips(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    double dy_unused[N_Y], direction[N_Y];
    RhsOutputs rhs;
    int status = -1;
    for (int element = 0; element < N_FRICTIONS; element++) {
        if (run->discrete.mode[element] != 0.0)
            continue;
        status = status < 0 ? evaluate_run_rhs(run, t, y, p, dy_unused, &rhs) : status;
        const double response = status ? 0.0 : compute_slip_response(run, t, y, element, p, direction);
        for (int k = N_X; k < 2 * N_X && response > 0.0; k++)
            error[k] += fabs(direction[k] * rhs.friction[element].v / response);
    }
    for (int k = 0; k < N_X && status >= 0; k++) /* a held coordinate may be 0: use the smallest relevant length */
        error[k] = max_of(error[k], ACCUMULATED_ULPS * DBL_EPSILON * run->norm.min_size[is_angle[k]]);
}
#else
/* Leave `error` unchanged: the scene has no friction that may stick. */
static void add_residual_slips(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    (void)run, (void)t, (void)y, (void)p, (void)error;
}
#endif

/*
 * Return the value of monitored event function number `index`, a switching function or a user-defined event, not
 * multiplied by its branch or sign.
 */
static inline double get_monitored_value(const RhsOutputs *rhs, int index)
{
    const int k = monitored_event[index] - N_CLEARANCES;
    return k < N_SWITCHES ? rhs->g[k] : rhs->event[k - N_SWITCHES - N_FRICTIONS];
}

#if KNOWN_BOUNDS
/*
 * Estimate how much errors of the state change each monitored event function, by interval arithmetic. Monitored are
 * switching functions and user-defined events. error (2 N_X): bounds of the error of each coordinate and rate, such as
 * the tolerance of the step or the constraint residuals. uncertainty (N_MONITORED): 0 if the bounds contain a pole.
 * Called by estimate_rounding_uncertainty() and by the search for zeros (watch/watched.c).
 */
static void estimate_monitored_function_errors(
    Integrator *run, double t, const double *y, const double *error, const Parameters *p, double *uncertainty)
{
    estimate_error_by_bounds(t, y, y + N_X, error, error + N_X, N_X, &run->discrete, p, uncertainty);
}
#else
/*
 * Estimate how much errors of the state change each monitored event function, because no interval bounds are known.
 * error (2 N_X): bounds of the error of each coordinate and rate. uncertainty (N_MONITORED): the sum of finite
 * differences for four patterns of error signs; 0 if the evaluation at y fails. The differences are taken for errors
 * divided by OBSERVED_FACTOR and multiplied by it again. A pattern whose evaluation fails, or whose change is not
 * finite, is omitted.
 */
static void estimate_monitored_function_errors(
    Integrator *run, double t, const double *y, const double *error, const Parameters *p, double *uncertainty)
{
    double y_perturbed[N_Y], dy[N_Y];
    RhsOutputs rhs, rhs_perturbed;
    const int failed = evaluate_run_rhs(run, t, y, p, dy, &rhs);
    memcpy(y_perturbed, y, sizeof y_perturbed);
    for (int i = 0; i < N_MONITORED; i++)
        uncertainty[i] = 0.0;
    for (int pattern = 0; pattern < 8 && !failed; pattern = pattern ? 2 * pattern : 1) {
        for (int k = 0; k < 2 * N_X; k++)
            y_perturbed[k] = y[k] + (k & pattern ? -error[k] : error[k]) / OBSERVED_FACTOR;
        if (evaluate_run_rhs(run, t, y_perturbed, p, dy, &rhs_perturbed))
            continue;
        for (int i = 0; i < N_MONITORED; i++) {
            const double change = OBSERVED_FACTOR * fabs(get_monitored_value(&rhs_perturbed, i)
                - get_monitored_value(&rhs, i));
            uncertainty[i] += isfinite(change) ? change : 0.0;
        }
    }
}
#endif

/*
 * Estimate how much rounding, constraint residuals and residual slips of the state y at time t (s) change each
 * monitored event function: uncertainty (N_MONITORED). A value below its uncertainty has no sign. Called when a value
 * near zero must be distinguished from rounding.
 */
static void estimate_rounding_uncertainty(
    Integrator *run, double t, const double *y, const Parameters *p, double *uncertainty)
{
    double error[2 * N_X + 1];
    estimate_state_errors(run, t, y, p, error);
    add_residual_slips(run, t, y, p, error);
    estimate_monitored_function_errors(run, t, y, error, p, uncertainty);
}

/*
 * Compute the user-defined event functions at a state y into `values` (N_USER_EVENTS), with 0 for values below their
 * uncertainty. The uncertainty is estimated only if a sign differs from the stored one (event_sign); otherwise values
 * are those of `rhs`, the outputs at y.
 */
static void evaluate_significant_events(
    Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p, double *values)
{
    double error[AT_LEAST_ONE(N_MONITORED)];
    int has_new_sign = 0;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        values[i] = rhs->event[i];
        has_new_sign |= !(run->discrete.event_sign[i] * values[i] > 0.0);
    }
    if (!has_new_sign)
        return;
    estimate_rounding_uncertainty(run, t, y, p, error);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (fabs(values[i]) <= error[N_MONITORED - N_USER_EVENTS + i])
            values[i] = 0.0;
}

#else
/* Do nothing: the scene has no monitored functions, so no user-defined events. */
static inline void evaluate_significant_events(
    const Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p, double *values)
{
    (void)run, (void)t, (void)y, (void)rhs, (void)p, (void)values;
}

/* Do nothing: the scene has no monitored functions. Replaces the function above in such scenes. */
static inline void estimate_rounding_uncertainty(const Integrator *run, double t, const double *y, const Parameters *p,
    double *uncertainty)
{
    (void)run, (void)t, (void)y, (void)p, (void)uncertainty;
}
#endif
