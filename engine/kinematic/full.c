/* Kinematic analysis in absolute coordinates q: Newton's method for positions, velocities and accelerations. */

/*
 * Compute the accelerations a (N_Q) and the outputs rhs (powers, event functions, Phi_dot) of a position by the
 * equations of motion. They are right limits in time: just after a jump of a drive. Discrete states are zero. Return 0,
 * a negative status, or N_ROWS plus the number of a dependent constraint equation.
 */
static int solve_accelerations(KinematicRun *run, const Position *position, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation, DEFAULT_PIVOT_LIMITS};
    const int status = dynamics(get_time_after_jump(position->t), position->q, position->v, &discrete, run->p, a, rhs);
    return status > 0 ? N_ROWS + status : status;
}

/*
 * Solve Phi(q, t) = 0 by Newton's method from the guess in q. It ends when the correction is below 1e-9 and no longer
 * halved, or below 1e-15. correction: incremented by the corrections; last_correction: the last one; both in rad or
 * fractions of the size. Return 0, the status of project(), or NEWTON_FAILED if a correction is NaN or the last of
 * MAX_NEWTON iterations corrects by 1e-9 or more.
 */
static int solve_position_equations(const KinematicRun *run, double t, double *q, double *correction,
    double *last_correction)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q], before = INFINITY;
    for (int i = 0; i < MAX_NEWTON; i++) {
        constraints(t, q, run->p, phi);
        const int status = project(t, q, phi, run->p, step);
        if (status)
            return status;
        const double size = compute_scaled_max_norm(step, run->extent);
        for (int k = 0; k < N_Q; k++)
            q[k] -= step[k];
        *correction += size;
        *last_correction = size;
        if (isnan(size))
            return NEWTON_FAILED;
        if (size < 1e-9 && (size >= 0.5 * before || size < 1e-15))
            return 0;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/*
 * Solve Phi_q v = nu at positions q for the velocities v (N_Q) by project(), with one step of iterative refinement.
 * Return 0 or a status.
 */
static int solve_velocities(double t, const double *q, const Parameters *p, double *v)
{
    double r[AT_LEAST_ONE(N_ALL_ROWS)], phi_q[AT_LEAST_ONE(N_ALL_ROWS) * N_Q], step[N_Q];
    for (int k = 0; k < N_Q; k++)
        v[k] = 0.0;
    gudgeon_phi_q(t, q, (const double *)p, phi_q);
    for (int pass = 0; pass < 2; pass++) {
        velocity_rhs(t, q, p, r);
        for (int row = 0; row < N_ALL_ROWS; row++)
            for (int k = 0; k < N_Q; k++)
                r[row] -= phi_q[(long)row * N_Q + k] * v[k];
        const int status = project(t, q, r, p, step);
        if (status)
            return status;
        for (int k = 0; k < N_Q; k++)
            v[k] += step[k];
    }
    return 0;
}

/*
 * Solve the constraint equations at time t for the coordinates and velocities of `position`. The first guess is `start`
 * moved along its velocities. At a jump of a drive the values just after it count. Also sets position->last_correction;
 * complete_position() adds the accelerations. correction: set to the sum of Newton's corrections, rad or fraction of
 * the size. Return 0 or a status.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *start, Position *position,
    double *correction)
{
    *correction = 0.0;
    position->t = t;
    position->is_interpolated = 0;
    for (int k = 0; k < N_Q; k++)
        position->q[k] = start->q[k] + (t - start->t) * start->v[k];
    const int status = solve_position_equations(run, get_time_after_jump(t), position->q, correction,
        &position->last_correction);
    return status ? status : solve_velocities(get_time_after_jump(t), position->q, run->p, position->v);
}

/*
 * Compute the accelerations and the largest |Phi| and |Phi_dot| of a position that becomes a sample. Return 0 or a
 * status. An interpolated position is complete already and is left unchanged.
 */
static int complete_position(KinematicRun *run, Position *position)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    RhsOutputs rhs;
    if (position->is_interpolated)
        return 0;
    const int status = solve_accelerations(run, position, position->a, &rhs);
    if (status)
        return status;
    constraints(get_time_after_jump(position->t), position->q, run->p, phi);
    position->phi = position->phi_dot = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        position->phi = get_larger_or_nan(position->phi, fabs(phi[r]));
    for (int r = 0; r < N_ROWS; r++)
        position->phi_dot = get_larger_or_nan(position->phi_dot, fabs(rhs.phi_dot[r]));
    return 0;
}

/*
 * Set the position at time t to a state q, v (N_Q each), unchanged, and complete it. Return 0 or a status.
 * last_correction is set to 0, or to infinity where constraint equations depend on each other.
 */
static int initialize_position(KinematicRun *run, double t, const double *q, const double *v, Position *position)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q];
    position->t = t;
    position->is_interpolated = 0;
    memcpy(position->q, q, sizeof position->q);
    memcpy(position->v, v, sizeof position->v);
    constraints(get_time_after_jump(t), q, run->p, phi); /* equations may depend on each other there */
    position->last_correction = project(get_time_after_jump(t), q, phi, run->p, step) ? INFINITY : 0.0;
    return complete_position(run, position);
}
