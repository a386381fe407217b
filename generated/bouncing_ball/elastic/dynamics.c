/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     ball.x; ball.y; ball.theta.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    (void)t;
    /* branches of switching functions that are held, if any */
    const double *const branch = discrete->is_frozen ? discrete->branch : NULL;
    double *const g = rhs->g;

    /* coordinates, velocities, time */
    const double ball_x_ = q[0];
    const double ball_y_ = q[1];
    const double ball_vx_ = v[0];
    const double ball_vy_ = v[1];
    const double ball_omega_ = v[2];

    /* clearance joint fall */
    const double e_fall_x_ = ball_x_;
    const double e_fall_y_ = ball_y_;
    const double edot_fall_x_ = ball_vx_;
    const double edot_fall_y_ = ball_vy_;
    clearance_fall_(e_fall_x_, e_fall_y_, edot_fall_x_, edot_fall_y_, 0, ball_omega_, &discrete->contact[0], p, branch,
        g, &rhs->clearance[0]);
    const double F_fall_x_ = rhs->clearance[0].Fx;
    const double F_fall_y_ = rhs->clearance[0].Fy;
    const double M_fall_second_ = rhs->clearance[0].moment_second;
    rhs->clearance[0].power = F_fall_x_*edot_fall_x_ + F_fall_y_*edot_fall_y_ + M_fall_second_*ball_omega_;

    /* forward substitution */
    const double z_ball_y_ = F_fall_y_ + p->weight_ball_y_;

    /* backward substitution */
    const double acceleration_ball_theta_ = M_fall_second_*p->inverse_ball_inertia_;
    const double acceleration_ball_y_ = p->inverse_ball_mass_*z_ball_y_;
    const double acceleration_ball_x_ = F_fall_x_*p->inverse_ball_mass_;

    /* results */
    a[0] = acceleration_ball_x_;
    a[1] = acceleration_ball_y_;
    a[2] = acceleration_ball_theta_;
    rhs->power[0] = 0.0;
    rhs->power[1] = 0.0;
    rhs->power[2] = rhs->clearance[0].power;
    return 0;
}
