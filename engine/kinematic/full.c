/*
 * Positions of a driven linkage in absolute coordinates: solution of the constraint equations, velocities and
 * accelerations.
 */

/*
 * Compute accelerations and powers by the equations of motion. A positive status is a constraint equation, numbered
 * after the N_ROWS equations of project().
 */
static int solve_motion(KinematicRun *run, const Position *here, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation, USUAL_SHARES};
    const int status = dynamics(after_jump(here->t), here->q, here->v, &discrete, run->p, a, rhs);
    return status > 0 ? N_ROWS + status : status;
}

/*
 * Solve Phi(q, t) = 0 by Newton's method until the correction no longer decreases. moved: incremented by the
 * corrections; left: the last one, rad or fraction of the size. Returns a status.
 */
static int close_linkage(const KinematicRun *run, double t, double *q, double *moved, double *last_correction)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q], before = INFINITY;
    for (int i = 0; i < MAX_NEWTON; i++) {
        constraints(t, q, run->p, phi);
        const int status = project(t, q, phi, run->p, step);
        if (status)
            return status;
        const double size = angle_norm(step, run->extent);
        for (int k = 0; k < N_Q; k++)
            q[k] -= step[k];
        *moved += size;
        *last_correction = size;
        if (isnan(size))
            return NEWTON_FAILED;
        if (size < 1e-9 && (size >= 0.5 * before || size < 1e-15))
            return 0;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/* Solve Phi_q v = nu by projection, with one step of refinement. Returns a status. */
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
 * Solve position and velocities at time t from a near position; complete_position() adds the accelerations. moved: the
 * correction of the first guess. Returns a status.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *from, Position *to, double *moved)
{
    *moved = 0.0;
    to->t = t;
    to->interpolated = 0;
    for (int k = 0; k < N_Q; k++)
        to->q[k] = from->q[k] + (t - from->t) * from->v[k];
    const int status = close_linkage(run, after_jump(t), to->q, moved, &to->last_correction);
    return status ? status : solve_velocities(after_jump(t), to->q, run->p, to->v);
}

/* Complete a position for a sample: accelerations, |Phi| and |Phi_dot|. Returns a status. */
static int complete_position(KinematicRun *run, Position *here)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    RhsOutputs rhs;
    if (here->interpolated)
        return 0;
    const int status = solve_motion(run, here, here->a, &rhs);
    if (status)
        return status;
    constraints(after_jump(here->t), here->q, run->p, phi);
    here->phi = here->phi_dot = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        here->phi = larger_or_nan(here->phi, fabs(phi[r]));
    for (int r = 0; r < N_ROWS; r++)
        here->phi_dot = larger_or_nan(here->phi_dot, fabs(rhs.phi_dot[r]));
    return 0;
}

/* Set the position at time t to given q and v (N_Q) and complete it. Returns a status. */
static int set_position(KinematicRun *run, double t, const double *q, const double *v, Position *here)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q];
    here->t = t;
    here->interpolated = 0;
    memcpy(here->q, q, sizeof here->q);
    memcpy(here->v, v, sizeof here->v);
    constraints(after_jump(t), q, run->p, phi); /* equations may depend on each other there */
    here->last_correction = project(after_jump(t), q, phi, run->p, step) ? INFINITY : 0.0;
    return complete_position(run, here);
}
