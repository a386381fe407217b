/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     block.y with lambda of guide.offset; block.theta with lambda of guide.angle; block.x; lambda of rub.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    (void)t;
    /* coordinates, velocities, time */
    const double block_x_ = q[0];
    const double block_y_ = q[1];
    const double block_theta_ = q[2];
    const double block_vx_ = v[0];
    const double block_vy_ = v[1];
    const double block_omega_ = v[2];

    /* directions, arms, drives */
    const double spring_span_x_ = block_x_ - p->wall_x_;
    const double spring_length_ = sqrt((block_y_ * block_y_) + (spring_span_x_ * spring_span_x_));
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const double spring_pull_ = spring_force_/spring_length_;

    /* friction: slip, or stick as a constraint equation */
    const double slip_rub_ = block_vx_ - p->rub_speed_;
    const double mode_rub_ = discrete->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub_ = mode_rub_ == 0.0 ? 1.0 : 0.0;
    const double sign_rub_ = fabs(mode_rub_) > 1.0 ? 0.0 : mode_rub_;
    const double kinetic_rub_ = -p->rub_kinetic_*sign_rub_;
    const double rhs_rub_ = -slip_rub_*p->two_alpha_stick_;
    rhs->friction[0].v = slip_rub_;
    rhs->friction[0].static_limit = p->rub_static_;
    rhs->friction[0].speed = p->rub_speed_;
    rhs->friction[0].force = kinetic_rub_;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_guide_offset_ = block_y_;
    const double phi_dot_guide_offset_ = block_vy_;
    const double rhs_guide_offset_ = -p->beta_squared_*phi_guide_offset_ - phi_dot_guide_offset_*p->two_alpha_;
    rhs->phi[0] = phi_guide_offset_;
    rhs->phi_dot[0] = phi_dot_guide_offset_;
    const double phi_guide_angle_ = block_theta_;
    const double phi_dot_guide_angle_ = block_omega_;
    const double rhs_guide_angle_ = -p->beta_squared_*phi_guide_angle_ - phi_dot_guide_angle_*p->two_alpha_;
    rhs->phi[1] = phi_guide_angle_;
    rhs->phi_dot[1] = phi_dot_guide_angle_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double scale_rub_ = p->inverse_block_mass_;
    if (stick_rub_ != 0.0 && !(scale_rub_ > 0.0 && scale_rub_ < INFINITY))
        return 3;
    const double inverse_pivot_rub_ = stick_rub_ != 0.0 ? 1.0/scale_rub_ : 0.0;

    /* forward substitution */
    const double z_block_y_ = -block_y_*spring_pull_;
    const double z_block_x_ = kinetic_rub_ - spring_pull_*spring_span_x_;
    const double z_rub_ = -p->inverse_block_mass_*z_block_x_ + rhs_rub_;

    /* backward substitution */
    const double lambda_rub_ = -inverse_pivot_rub_*z_rub_;
    const double acceleration_block_x_ = -p->inverse_block_mass_*lambda_rub_ + p->inverse_block_mass_*z_block_x_;
    const double lambda_guide_angle_ = -p->block_inertia_*rhs_guide_angle_;
    const double acceleration_block_theta_ = rhs_guide_angle_;
    const double lambda_guide_offset_ = -p->block_mass_*rhs_guide_offset_ + z_block_y_;
    const double acceleration_block_y_ = rhs_guide_offset_;

    /* results */
    a[0] = acceleration_block_x_;
    a[1] = acceleration_block_y_;
    a[2] = acceleration_block_theta_;
    rhs->lambda[0] = lambda_guide_offset_;
    rhs->lambda[1] = lambda_guide_angle_;
    rhs->friction[0].rate = acceleration_block_x_;
    if (stick_rub_ != 0.0)
        rhs->friction[0].force = -lambda_rub_;  /* stick of rub */
    rhs->power[0] = 0.0;
    rhs->power[1] = rhs->friction[0].force*(rhs->friction[0].speed + rhs->friction[0].v);
    rhs->power[2] = 0.0;
    return 0;
}
