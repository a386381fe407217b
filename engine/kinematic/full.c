/* Positions, velocities and accelerations in absolute coordinates of a linkage that drives determine. */

/*
 * Compute accelerations a and powers at a position by the equations of motion. Return 0 or a status. A positive status
 * is a constraint equation, numbered after the N_ROWS equations of project().
 */
static int solve_accelerations(KinematicRun *run, const Position *position, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation, DEFAULT_PIVOT_LIMITS};
    const int status = dynamics(get_time_after_jump(position->t), position->q, position->v, &discrete, run->p, a, rhs);
    return status > 0 ? N_ROWS + status : status;
}

/*
 * Solve Phi(q, t) = 0 by Newton's method from the guess in q, until the correction no longer decreases. Return 0 or a
 * status. correction: incremented by the corrections; last_correction: the last one; both in rad or fractions of the
 * size.
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
        const double size = compute_angle_norm(step, run->extent);
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
 * Solve Phi_q v = nu at positions q for the velocities v (N_Q) by projection, with one step of refinement. Return 0 or
 * a status.
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
 * Solve the position and velocities at time t from the near position `start`, moved along its velocities as first
 * guess. complete_position() adds the accelerations. correction: set to the correction of the first guess. Return 0 or
 * a status.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *start, Position *position,
    double *correction)
{
    *correction = 0.0;
    position->t = t;
    position->interpolated = 0;
    for (int k = 0; k < N_Q; k++)
        position->q[k] = start->q[k] + (t - start->t) * start->v[k];
    const int status = solve_position_equations(run, get_time_after_jump(t), position->q, correction,
        &position->last_correction);
    return status ? status : solve_velocities(get_time_after_jump(t), position->q, run->p, position->v);
}

/*
 * Complete a position for a sample: accelerations and the largest |Phi| and |Phi_dot|. Return 0 or a status. An
 * interpolated position is complete already.
 */
static int complete_position(KinematicRun *run, Position *position)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    RhsOutputs rhs;
    if (position->interpolated)
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
 * Set the position at time t to given q and v (N_Q), and complete it. Return 0 or a status. Where constraint equations
 * depend on each other, its last correction is set to infinity.
 */
static int set_position(KinematicRun *run, double t, const double *q, const double *v, Position *position)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q];
    position->t = t;
    position->interpolated = 0;
    memcpy(position->q, q, sizeof position->q);
    memcpy(position->v, v, sizeof position->v);
    constraints(get_time_after_jump(t), q, run->p, phi); /* equations may depend on each other there */
    position->last_correction = project(get_time_after_jump(t), q, phi, run->p, step) ? INFINITY : 0.0;
    return complete_position(run, position);
}
