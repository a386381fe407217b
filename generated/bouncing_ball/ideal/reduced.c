/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double ball_theta_ = q[0];
    const double ball_omega_ = v[0];

    /* directions, arms, drives */
    const double ball_x_ = 0.0;
    const double ball_y_ = 0.0;
    const double ball_vx_ = 0.0;
    const double ball_vy_ = 0.0;

    /* bodies */
    all_q[0] = ball_x_;
    all_v[0] = ball_vx_;
    all_q[1] = ball_y_;
    all_v[1] = ball_vy_;
    all_q[2] = ball_theta_;
    all_v[2] = ball_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double ball_theta_ = q[2];
    const double ball_omega_ = v[2];

    /* tree coordinates */
    s[0] = ball_theta_;  /* ball */
    s_rate[0] = ball_omega_;
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)v, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `rhs`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    (void)t, (void)q, (void)v, (void)discrete, (void)p;
    /* backward substitution */
    const double acceleration_ball_theta_ = 0.0;

    /* results */
    a[0] = acceleration_ball_theta_;
    rhs->power[0] = 0.0;
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return 0;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t, (void)q, (void)r, (void)p;
    /* backward substitution */
    const double step_acceleration_ball_theta_ = 0.0;

    /* results */
    x[0] = step_acceleration_ball_theta_;
    return 0;
}
