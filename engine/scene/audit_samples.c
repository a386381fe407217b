/*
 * Independent check of the samples of a run, by other equations than those that produced the results. It also provides
 * the equations of all bodies for the audit of steps (run/audit.c). It owns no state.
 */

/*
 * Compute the accelerations a (N_Q) of all bodies by the equations of motion in absolute coordinates, at the state
 * absolute_state (q, v, works). *force: largest constraint or friction force there, N. Branches are not frozen, and
 * pivots have their usual limits. Return a status. Called by the audit of steps.
 */
int compute_absolute_accelerations(double t, const double *absolute_state, const DiscreteState *discrete,
    const Parameters *p,
    double *a,
    double *force)
{
    double rate[N_S];
    RhsOutputs rhs;
    DiscreteState discrete_state = *discrete;
    discrete_state.is_frozen = 0; /* switching functions of all bodies have other indices */
    discrete_state.min_pivot = NEARLY_SINGULAR;
    discrete_state.min_pivot_size = VANISHING;
    const int status = evaluate_rates_at(t, absolute_state, &discrete_state, p, rate, &rhs);
    for (int k = 0; k < N_Q; k++)
        a[k] = rate[N_Q + k];
    *force = 0.0;
    for (int r = 0; r < N_ROWS; r++)
        *force = max_of(*force, row_is_length[motion_row[r]] ? fabs(rhs.lambda[r]) : 0.0);
    for (int i = 0; i < N_FRICTIONS; i++)
        *force = max_of(*force, fabs(rhs.friction[i].force));
    return status;
}

/*
 * Compute the residuals Phi_q v - nu (`residual`) and nu of all N_ALL_ROWS velocity constraints. Phi_q v is the central
 * difference of Phi along v over half_interval (s) before and after; 0 if half_interval is 0. Called by the audits of
 * samples and steps.
 */
void compute_velocity_residuals(double t, const double *q, const double *v, double half_interval, const Parameters *p,
    double *residual,
    double *nu)
{
    double q_near[2][N_Q], phi[2][AT_LEAST_ONE(N_ALL_ROWS)];
    const double interval = half_interval > 0.0 ? 2.0 * half_interval : INFINITY;
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < N_Q; k++)
            q_near[side][k] = q[k] + (side ? half_interval : -half_interval) * v[k];
        constraints(t, q_near[side], p, phi[side]);
    }
    velocity_rhs(t, q, p, nu);
    for (int r = 0; r < N_ALL_ROWS; r++)
        residual[r] = (phi[1][r] - phi[0][r]) / interval - nu[r];
}

/*
 * Return whether the first or second rate of a drive jumps, or is unbounded or NaN, at time t (s). It does if its
 * values at t and `interval` (s) before and after t differ by more than 1e-5 (second rate: 1e-3) of themselves. q, v:
 * coordinates and velocities of all bodies. Called at each sample, and where an audit or a start must not rely on rates
 * at t.
 */
int has_drive_jump(double t, double interval, const double *q, const double *v, const Parameters *p)
{
    double nu[3][AT_LEAST_ONE(N_ALL_ROWS)], gamma[3][AT_LEAST_ONE(N_ALL_ROWS)];
    for (int k = 0; k < 3; k++) {
        velocity_rhs(t + (k - 1) * interval, q, p, nu[k]);
        acceleration_rhs(t + (k - 1) * interval, q, v, p, gamma[k]);
    }
    for (int drive = 0; drive < N_DRIVES; drive++) {
        const int row = drive_row[drive];
        const double rate_scale = fabs(nu[2][row]) + fabs(nu[0][row]),
            second_rate_scale = fabs(gamma[2][row]) + fabs(gamma[0][row]);
        if (!(fabs(nu[1][row] - nu[0][row]) + fabs(nu[2][row] - nu[1][row]) <= 1e-5 * rate_scale)
            || !(fabs(gamma[1][row] - gamma[0][row]) + fabs(gamma[2][row] - gamma[1][row]) <= 1e-3 * second_rate_scale))
            return 1;
    }
    return 0;
}

/* W: smaller powers are products of underflowing numbers. */
#define MIN_POWER 1e-250
/* s, of differences along v: velocities that need longer for a motion of 1e-5 sizes are rounding errors of rest */
#define MAX_AUDIT_INTERVAL 1e3

/*
 * Audit n samples (runtime/simulation/audit.py). relative_errors (n, 4), each relative to the largest term:
 *   0: v M a + lambda (Phi_q v - nu) + dV/dt - sum of powers;
 *   1: drive torques times rates - power of the drives;
 *   2: Phi, relative to `size` (m);
 *   3: Phi_q v - nu.
 * dV/dt and Phi_q v are differences along v. In Phi, the motion of drives in compute_sample_time_error() is allowed. A
 * sample without accelerations has zeros.
 */
void gudgeon_audit_samples(long n, const double *t, const double *q, const double *v, const double *discrete,
    const double *parameters, double size, double *relative_errors)
{
    const Parameters *p = (const Parameters *)parameters;
    double m[N_Q];
    mass_matrix(p, m);
    for (long i = 0; i < n; i++, q += N_Q, v += N_Q, discrete += N_DISCRETE, relative_errors += 4) {
        DiscreteState discrete_state = {0};
        RhsOutputs rhs;
        double y[N_S] = {0.0}, dy[N_S], near[2][N_Q], stored[3][2], phi[AT_LEAST_ONE(N_ALL_ROWS)], rate = 0.0;
        double reactions[3 * AT_LEAST_ONE(N_REACTIONS)], torques[AT_LEAST_ONE(N_DRIVES)];
        double series[AT_LEAST_ONE(N_SERIES)];
        double nu[AT_LEAST_ONE(N_ALL_ROWS)], missed[AT_LEAST_ONE(N_ALL_ROWS)], nu_near[2][AT_LEAST_ONE(N_ALL_ROWS)];
        double time = t[i];
        double force[2] = {0.0, 0.0}, max_speed[2] = {0.0, 0.0}, max_coordinate[2] = {0.0, 0.0};
        relative_errors[0] = relative_errors[1] = relative_errors[2] = relative_errors[3] = 0.0;
        for (int k = 0; k < N_Q; k++) {
            y[k] = q[k];
            y[N_Q + k] = v[k];
        }
        read_discrete_state(discrete, &discrete_state);
        if (evaluate_rates_at_sample(&time, y, &discrete_state, p, dy, &rhs))
            continue;
        for (int k = 0; k < N_Q; k++) {
            const int angle = k % 3 == 2;
            const double unit = angle ? 1.0 : size, a = dy[N_Q + k];
            rate = max_of(rate, max_of(fabs(v[k]) / unit, sqrt(fabs(a) / unit)));
            force[angle] += fabs(m[k] * a);
            max_speed[angle] = max_of(max_speed[angle], fabs(v[k]));
            max_coordinate[angle] = max_of(max_coordinate[angle], fabs(q[k]));
        }
        const double h = rate > 0.0 ? fmin(1e-5 / rate, MAX_AUDIT_INTERVAL) : 0.0;
        for (int branch = 0; branch < 2; branch++) {
            for (int k = 0; k < N_Q; k++)
                near[branch][k] = q[k] + (branch ? h : -h) * v[k];
            outputs(time, near[branch], v, p, rhs.lambda, reactions, torques, series, stored[branch]);
        }
        outputs(time, q, v, p, rhs.lambda, reactions, torques, series, stored[2]);
        constraints(time, q, p, phi);
        compute_velocity_residuals(time, q, v, h, p, missed, nu);
        const double time_error = compute_sample_time_error(t[i]);
        for (int side = 0; side < 2; side++)
            velocity_rhs(t[i] + (side ? time_error : -time_error), q, p, nu_near[side]);
        const double between = h > 0.0 ? 2.0 * h : INFINITY;
        double sum = (stored[1][1] - stored[0][1]) / between, driven = 0.0;
        double terms = MIN_POWER + fabs(sum) + force[0] * max_speed[0] + force[1] * max_speed[1];
        terms += 4e6 * DBL_EPSILON * fabs(stored[2][1]) / between;
        for (int i = 0; i < N_FRICTIONS; i++) /* in stick, all powers are rounding errors of friction */
            terms += fabs(rhs.friction[i].force) * (max_speed[0] + fabs(rhs.friction[i].v));
        for (int k = 0; k < N_Q; k++)
            sum += v[k] * m[k] * dy[N_Q + k];
        for (int k = 0; k < N_WORK; k++) {
            sum -= rhs.power[k];
            terms += fabs(rhs.power[k]);
        }
        double largest = fabs(rhs.power[0]);
        for (int d = 0; d < N_DRIVES; d++) {
            driven += torques[d] * nu[drive_row[d]];
            largest += fabs(torques[d]) * (row_is_length[drive_row[d]] ? max_speed[0] : max_speed[1]);
        }
        largest = max_of(largest, terms);
        for (int r = 0; r < N_ROWS; r++) {
            const int row = motion_row[r], length = row_is_length[row];
            const double unit = length ? size : 1.0;
            const double max_size = length ? max_coordinate[0] + size * max_coordinate[1] : max_coordinate[1];
            const double max_body_speed = length ? max_of(max_speed[0], size * max_speed[1])
                : max_of(max_speed[1], max_speed[0] / size);
            const double speed = max_of(max_body_speed, fabs(nu[row])) + 1e9 * DBL_EPSILON * max_size / between;
            const double moved = time_error * max_of(fabs(nu_near[0][row]), fabs(nu_near[1][row]));
            relative_errors[2] = max_of(relative_errors[2], (fabs(phi[row]) - moved) / (unit + max_size));
            if (speed > 0.0)
                relative_errors[3] = max_of(relative_errors[3], fabs(missed[row]) / speed);
            const double lost = rhs.lambda[r] * missed[row]; /* power of the velocity error, as by rounding */
            sum += lost;
            terms += fabs(lost) + 1e-2 * fabs(rhs.lambda[r]) * speed; /* missed is known to 1e-8 of speed */
        }
        relative_errors[0] = fabs(sum) / terms;
        relative_errors[1] = fabs(driven - rhs.power[0]) / largest;
    }
}

/* Return whether the sum of n values is finite. It is not if any value is NaN or infinite, nor if the sum overflows. */
static int is_sum_finite(const double *values, long n)
{
    double sum = 0.0;
    for (long k = 0; k < n; k++)
        sum += values[k];
    return isfinite(sum);
}

#define START_TOL 1e-9       /* of the size: allowed distance of the first sample from the start (audit.py) */
#define START_RATES_TOL 1e-6 /* the same of velocities, of the largest one */

/*
 * Return whether the initial state `start` (q, v) of a run has the set coordinates of the file, and the first sample y
 * differs from it by rounding only: positions by START_TOL of the size, velocities by START_RATES_TOL of the largest
 * rate in `start`. 0: not known, audit.py decides. size: of the mechanism, m.
 */
static int starts_from_initial_state(const double *y, const double *start, const Parameters *p, double size)
{
    double guess[AT_LEAST_ONE(N_GUESS)], set[AT_LEAST_ONE(N_SET + N_ECCENTRICITIES)],
        rates[AT_LEAST_ONE(N_RATES + N_ECCENTRICITIES)], largest_rate = 0.0;
    start_values(p, guess, set, rates);
    for (int i = 0; i < N_SET; i++) {
        const int k = set_coordinate[i], is_angle = k % 3 == 2;
        const double difference = fabs(start[k] - set[i]);
        const double n_turns = is_angle ? rint(difference / (2.0 * PI)) : 0.0;
        if (!(fabs(difference - n_turns * 2.0 * PI) * (is_angle ? size : 1.0) <= START_TOL * size))
            return 0;
    }
    for (int k = N_Q; k < 2 * N_Q; k++)
        largest_rate = max_of(largest_rate, fabs(start[k]));
    const double largest = max_of(size, 1.0);
    const double position_tolerance = START_TOL * size / largest;
    const double velocity_tolerance = START_RATES_TOL * min_of(size, 1.0) * largest_rate / largest;
    for (int k = 0; k < 2 * N_Q; k++)
        if (!(fabs(y[k] - start[k]) <= (k < N_Q ? position_tolerance : velocity_tolerance)))
            return 0;
    return 1;
}

/* Results of gudgeon_evaluate() at one sample, without the energy. */
typedef struct {
    double a[N_Q], lambda[AT_LEAST_ONE(N_ROWS)], reactions[N_REACTION_COLUMNS * AT_LEAST_ONE(N_REACTIONS)],
        torques[AT_LEAST_ONE(N_DRIVES)], clearance[N_CLEARANCE_COLUMNS * AT_LEAST_ONE(N_CLEARANCES)],
        series[AT_LEAST_ONE(N_SERIES)], friction[N_FRICTION_COLUMNS * AT_LEAST_ONE(N_FRICTIONS)], power[N_WORK],
        drift[N_DRIFT];
} SampleResults;

/* Columns of the largest contact forces of a joint with play, N: at samples outside contacts, at all, touching. */
enum { CONTACT_OPEN, CONTACT_ALL, CONTACT_TOUCHING, N_CONTACT_COLUMNS };

/*
 * Raise the largest contact forces (N_CLEARANCES, N_CONTACT_COLUMNS) of all joints with play to those of a sample.
 * Joints that are open by their discrete state, and whose penetration is zero within MIN_TOUCHING_PENETRATION, touch.
 */
static void update_contact_forces(const double *discrete, const double *clearance, double *contact_forces)
{
    for (int k = 0; k < N_CLEARANCES; k++, clearance += N_CLEARANCE_COLUMNS, contact_forces += N_CONTACT_COLUMNS) {
        const double force = hypot(clearance[CLEARANCE_Fx], clearance[CLEARANCE_Fy]);
        const int touches = fabs(clearance[CLEARANCE_delta]) <= MIN_TOUCHING_PENETRATION;
        contact_forces[CONTACT_ALL] = max_of(contact_forces[CONTACT_ALL], force);
        if (isnan(discrete[k])) {
            const int column = touches ? CONTACT_TOUCHING : CONTACT_OPEN;
            contact_forces[column] = max_of(contact_forces[column], force);
        }
    }
}

/*
 * Return whether all n samples y (rows of N_S) of a run can be evaluated at the times t, and pass the audit; 0: not
 * known, or they do not. energies (n, N_ENERGY, output) are for the energy balance, and contact_forces (N_CLEARANCES,
 * N_CONTACT_COLUMNS; zeros at first) for the checks of contacts: the caller checks both. The other arguments are those
 * of the audit; if `limits` is NULL, the samples are evaluated only.
 * audited: result of the audit of steps (N_CHECKS).
 * start (2 N_Q): state with which the run began; NULL: the first sample is not compared with it.
 * drawn: n_drawn indices, increasing, of the samples whose errors of gudgeon_audit_samples() must not exceed the first
 * four `limits`; the last one is that of the equations of single bodies there, which need `bodies` (NULL: not checked).
 */
int gudgeon_check_samples(long n, const double *t, const double *y, const double *discrete, const double *parameters,
    double *energies, double *contact_forces, const double *audited, const double *limits, double size,
    const double *start, long n_drawn, const long *drawn, const BodyForceTable *bodies)
{
    double m[N_Q];
    BodyResiduals residuals = {0};
    mass_matrix((const Parameters *)parameters, m);
    for (int k = 0; limits && k < N_CHECKS; k++)
        if (!(audited[k] <= AUDIT_FAILS))
            return 0;
    for (long i = 0, j = 0; i < n; i++) {
        SampleResults x = {0};
        double *energy = energies + N_ENERGY * i;
        const double *state = y + i * N_S;
        long failed;
        if (gudgeon_evaluate(1, t + i, state, state + N_Q, discrete + i * N_DISCRETE, parameters, x.a, x.lambda,
                x.reactions, x.torques, x.clearance, x.series, x.friction, energy, x.power, x.drift, &failed))
            return 0;
        if (!limits)
            continue;
        if (!is_sum_finite((const double *)&x, sizeof x / sizeof(double)) || !is_sum_finite(energy, N_ENERGY))
            return 0;
        update_contact_forces(discrete + i * N_DISCRETE, x.clearance, contact_forces);
        if (bodies && j < n_drawn && drawn[j] == i) {
            const ReportedForces reported = {x.a, x.reactions, x.torques, x.clearance, x.series, x.friction};
            add_body_residuals(bodies, state, parameters, m, &reported, &residuals);
            j++;
        }
    }
    if (limits && start && !starts_from_initial_state(y, start, (const Parameters *)parameters, size))
        return 0;
    for (long i = 0; limits && i < n_drawn; i++) {
        const double *state = y + drawn[i] * N_S;
        double errors[4];
        gudgeon_audit_samples(1, t + drawn[i], state, state + N_Q, discrete + drawn[i] * N_DISCRETE, parameters, size,
            errors);
        for (int k = 0; k < 4; k++)
            if (!(errors[k] <= limits[k]))
                return 0;
    }
    for (int body = 0; limits && body < N_BODIES; body++)
        if (!(compute_relative_residual(&residuals, body) <= limits[4]))
            return 0;
    return 1;
}
