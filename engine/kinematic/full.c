/* The closed linkage in absolute coordinates. */

/* Accelerations and powers: those of the equations of motion. A status counts on behind the rows of `project`. */
static int solve_motion(Course *course, const Position *here, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &course->cancellation, USUAL_SHARES};
    const int status = dynamics(beyond_jump(here->t), here->q, here->v, &discrete, course->p, a, rhs);
    return status > 0 ? N_ROWS + status : status;
}

/* Newton on Phi(q, t) = 0 until the step no longer shrinks; `moved` is the way from the first guess. */
static int close_linkage(const Course *course, double t, double *q, double *moved, double *left)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q], before = INFINITY;
    for (int i = 0; i < MAX_NEWTON; i++) {
        constraints(t, q, course->p, phi);
        const int status = project(t, q, phi, course->p, step);
        if (status)
            return status;
        const double size = turn_of(step, course->extent);
        for (int k = 0; k < N_Q; k++)
            q[k] -= step[k];
        *moved += size;
        *left = size;
        if (isnan(size))
            return NEWTON_FAILED;
        if (size < 1e-9 && (size >= 0.5 * before || size < 1e-15))
            return 0;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/* Phi_q v = nu by projection, with one step of refinement. */
static int velocities(double t, const double *q, const Parameters *p, double *v)
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

/* From one place to another near by; accelerations come with `settle`. */
static int bracket_point_at(const Course *course, double t, const Position *from, Position *to, double *moved)
{
    *moved = 0.0;
    to->t = t;
    to->interpolated = 0;
    for (int k = 0; k < N_Q; k++)
        to->q[k] = from->q[k] + (t - from->t) * from->v[k];
    const int status = close_linkage(course, beyond_jump(t), to->q, moved, &to->left);
    return status ? status : velocities(beyond_jump(t), to->q, course->p, to->v);
}

/* What a sample has beside positions and velocities. */
static int update_modes(Course *course, Position *here)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    RhsOutputs rhs;
    if (here->interpolated)
        return 0;
    const int status = solve_motion(course, here, here->a, &rhs);
    if (status)
        return status;
    constraints(beyond_jump(here->t), here->q, course->p, phi);
    here->phi = here->phi_dot = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        here->phi = larger(here->phi, fabs(phi[r]));
    for (int r = 0; r < N_ROWS; r++)
        here->phi_dot = larger(here->phi_dot, fabs(rhs.phi_dot[r]));
    return 0;
}

static int begin(Course *course, double t, const double *q, const double *v, Position *here)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], step[N_Q];
    here->t = t;
    here->interpolated = 0;
    memcpy(here->q, q, sizeof here->q);
    memcpy(here->v, v, sizeof here->v);
    constraints(beyond_jump(t), q, course->p, phi); /* rows may depend on each other there */
    here->left = project(beyond_jump(t), q, phi, course->p, step) ? INFINITY : 0.0;
    return update_modes(course, here);
}
