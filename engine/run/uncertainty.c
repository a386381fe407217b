/*
 * Uncertainty of event and switching functions: the effect of rounding and of constraint residuals of the state. A
 * function smaller than its uncertainty has no sign and keeps its branch.
 */
#if N_WATCHED
#define OBSERVED_FACTOR 16.0 /* factor on observed differences, which may consist of rounding only */

/*
 * Add the constraint residual of a state to its error: the correction that closes the linkage, and the velocity
 * residual at perturbed positions. Near a singular position these exceed rounding. error (2 N_X): m, rad and their
 * rates.
 */
static void add_closing(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    double dq[N_X + 1], dv[N_X + 1], other[N_Y], worst;
    if (N_LOOPS == 0 || closing_of_state(t, y, &run->discrete, p, dq, dv, &worst))
        return;
    for (int k = 0; k < N_X; k++) {
        error[k] += isfinite(dq[k]) ? CLOSING_STEPS * fabs(dq[k]) : 0.0;
        error[N_X + k] += isfinite(dv[k]) ? CLOSING_STEPS * fabs(dv[k]) : 0.0;
    }
    memcpy(other, y, sizeof other);
    for (int mask = 0; mask < 3; mask++) {
        for (int k = 0; k < N_X; k++)
            other[k] = y[k] + (k & mask ? -error[k] : error[k]);
        if (closing_of_state(t, other, &run->discrete, p, dq, dv, &worst))
            continue;
        for (int k = 0; k < N_X; k++)
            error[N_X + k] += isfinite(dv[k]) ? fabs(dv[k]) : 0.0;
    }
}

/*
 * Compute the errors of coordinates and velocities of a state y: rounding of the largest length and angle, plus
 * constraint residuals. error (2 N_X): m, rad and their rates.
 */
static void rounding_errors(Integrator *run, double t, const double *y, const Parameters *p, double *error)
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
    add_closing(run, t, y, p, error);
}

#if N_FRICTIONS
/*
 * Add the residual slip of sticking friction to the velocity errors: the velocity change by which an impulse of that
 * friction would stop the slip. Other sticking elements stay at rest.
 */
static void add_stuck_slip(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    double scrap[N_Y], direction[N_Y];
    RhsOutputs rhs;
    int status = -1;
    for (int i = 0; i < N_FRICTIONS; i++) {
        if (run->discrete.mode[i] != 0.0)
            continue;
        status = status < 0 ? rates(run, t, y, p, scrap, &rhs) : status;
        const double response = status ? 0.0 : slip_response(run, t, y, i, p, direction);
        for (int k = N_X; k < 2 * N_X && response > 0.0; k++)
            error[k] += fabs(direction[k] * rhs.friction[i].v / response);
    }
    for (int k = 0; k < N_X && status >= 0; k++) /* a held coordinate may be 0: use the smallest relevant length */
        error[k] = max_of(error[k], ACCUMULATED_ULPS * DBL_EPSILON * run->norm.least[is_angle[k]]);
}
#else
/* Add nothing: the scene has no friction that may stick. */
static void add_stuck_slip(Integrator *run, double t, const double *y, const Parameters *p, double *error)
{
    (void)run, (void)t, (void)y, (void)p, (void)error;
}
#endif

/* Return the value of watched function i, a switching function or a user-defined event, on any branch. */
static inline double watched_value(const RhsOutputs *rhs, int i)
{
    const int k = watched[i] - N_CLEARANCES;
    return k < N_SWITCHES ? rhs->g[k] : rhs->event[k - N_SWITCHES - N_FRICTIONS];
}

#if KNOWN_BOUNDS
/* Estimate by bounds how much errors of the state change each watched function; 0 if the bounds contain a pole. */
static void error_of_watched(
    Integrator *run, double t, const double *y, const double *error, const Parameters *p, double *out)
{
    error_by_bounds(t, y, y + N_X, error, error + N_X, N_X, &run->discrete, p, out);
}
#else
/*
 * Estimate how much errors of the state change each watched function from differences for four patterns of error signs:
 * no bounds are known.
 */
static void error_of_watched(
    Integrator *run, double t, const double *y, const double *error, const Parameters *p, double *out)
{
    double now[N_Y], dy[N_Y];
    RhsOutputs rhs, other;
    const int failed = rates(run, t, y, p, dy, &rhs);
    memcpy(now, y, sizeof now);
    for (int i = 0; i < N_WATCHED; i++)
        out[i] = 0.0;
    for (int mask = 0; mask < 8 && !failed; mask = mask ? 2 * mask : 1) {
        for (int k = 0; k < 2 * N_X; k++)
            now[k] = y[k] + (k & mask ? -error[k] : error[k]) / OBSERVED_FACTOR;
        if (rates(run, t, now, p, dy, &other))
            continue;
        for (int i = 0; i < N_WATCHED; i++) {
            const double change = OBSERVED_FACTOR * fabs(watched_value(&other, i) - watched_value(&rhs, i));
            out[i] += isfinite(change) ? change : 0.0;
        }
    }
}
#endif

/* Estimate by how much rounding and constraint residuals of a state change each watched function (N_WATCHED values). */
static void uncertainty(Integrator *run, double t, const double *y, const Parameters *p, double *out)
{
    double error[2 * N_X + 1];
    rounding_errors(run, t, y, p, error);
    add_stuck_slip(run, t, y, p, error);
    error_of_watched(run, t, y, error, p, out);
}

/*
 * Compute the user-defined event functions at a state, with 0 for values below their uncertainty. The uncertainty is
 * estimated only if a sign differs from the stored one.
 */
static void evaluate_resolved_events(
    Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p, double *value)
{
    double error[AT_LEAST_ONE(N_WATCHED)];
    int differs = 0;
    for (int i = 0; i < N_USER_EVENTS; i++) {
        value[i] = rhs->event[i];
        differs |= !(run->discrete.event_sign[i] * value[i] > 0.0);
    }
    if (!differs)
        return;
    uncertainty(run, t, y, p, error);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (fabs(value[i]) <= error[N_WATCHED - N_USER_EVENTS + i])
            value[i] = 0.0;
}

#else
/* Do nothing: the scene has no user-defined events. */
static inline void evaluate_resolved_events(
    const Integrator *run, double t, const double *y, const RhsOutputs *rhs, const Parameters *p, double *value)
{
    (void)run, (void)t, (void)y, (void)rhs, (void)p, (void)value;
}

/* Do nothing: the scene has no watched functions. */
static inline void uncertainty(const Integrator *run, double t, const double *y, const Parameters *p, double *out)
{
    (void)run, (void)t, (void)y, (void)p, (void)out;
}
#endif
