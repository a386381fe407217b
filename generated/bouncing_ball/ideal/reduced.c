/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     ball: on ground by fall; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = ball.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     none
 *
 * expand: state of the tree to all_q, all_v of the bodies (x, y, theta each, as in constraints.c).
 * reduce_state: the opposite direction. closures, closure_rates: Phi and its rate.
 * reduced_dynamics: the right-hand side. reduced_project: the smallest change that satisfies the closures.
 */

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
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
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
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)v, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     ball.theta.
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
 * The smallest x (n) in the metric of M with Phi_q x = r, for Newton's step and velocities. r has all rows
 * of the closed linkage; those of open joints and redundant ones are ignored.
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
