/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     ball.y with lambda of fall.y; ball.x with lambda of fall.x; ball.theta.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    (void)t, (void)discrete;
    /* coordinates, velocities, time */
    const double ball_x_ = q[0];
    const double ball_y_ = q[1];
    const double ball_vx_ = v[0];
    const double ball_vy_ = v[1];

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_fall_x_ = -ball_x_;
    const double phi_dot_fall_x_ = -ball_vx_;
    const double rhs_fall_x_ = -p->beta_squared_*phi_fall_x_ - phi_dot_fall_x_*p->two_alpha_;
    rhs->phi[0] = phi_fall_x_;
    rhs->phi_dot[0] = phi_dot_fall_x_;
    const double phi_fall_y_ = -ball_y_;
    const double phi_dot_fall_y_ = -ball_vy_;
    const double rhs_fall_y_ = -p->beta_squared_*phi_fall_y_ - phi_dot_fall_y_*p->two_alpha_;
    rhs->phi[1] = phi_fall_y_;
    rhs->phi_dot[1] = phi_dot_fall_y_;

    /* backward substitution */
    const double acceleration_ball_theta_ = 0.0;
    const double lambda_fall_x_ = -p->ball_mass_*rhs_fall_x_;
    const double acceleration_ball_x_ = -rhs_fall_x_;
    const double lambda_fall_y_ = -p->ball_mass_*rhs_fall_y_ - p->weight_ball_y_;
    const double acceleration_ball_y_ = -rhs_fall_y_;

    /* results */
    a[0] = acceleration_ball_x_;
    a[1] = acceleration_ball_y_;
    a[2] = acceleration_ball_theta_;
    rhs->lambda[0] = lambda_fall_x_;
    rhs->lambda[1] = lambda_fall_y_;
    rhs->power[0] = 0.0;
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
