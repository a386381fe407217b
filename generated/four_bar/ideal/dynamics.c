/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     coupler.y with lambda of A.y; coupler.x with lambda of A.x; crank.theta with lambda of motor;
 *     rocker.y with lambda of B0.y; rocker.x with lambda of B0.x; crank.y with lambda of A0.y;
 *     crank.x with lambda of A0.x; coupler.theta; rocker.theta; lambda of B.x with lambda of B.y.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double crank_x_ = q[0];
    const double crank_y_ = q[1];
    const double crank_theta_ = q[2];
    const double crank_vx_ = v[0];
    const double crank_vy_ = v[1];
    const double crank_omega_ = v[2];
    const double coupler_x_ = q[3];
    const double coupler_y_ = q[4];
    const double coupler_theta_ = q[5];
    const double coupler_vx_ = v[3];
    const double coupler_vy_ = v[4];
    const double coupler_omega_ = v[5];
    const double rocker_x_ = q[6];
    const double rocker_y_ = q[7];
    const double rocker_theta_ = q[8];
    const double rocker_vx_ = v[6];
    const double rocker_vy_ = v[7];
    const double rocker_omega_ = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_coupler_ = cos(coupler_theta_);
    const double sin_theta_coupler_ = sin(coupler_theta_);
    const double arm_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double arm_coupler_head_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double cos_theta_rocker_ = cos(rocker_theta_);
    const double sin_theta_rocker_ = sin(rocker_theta_);
    const double arm_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double arm_rocker_head_y_ = p->rocker_head_s_x_*sin_theta_rocker_;
    const double motor_value_ = p->omega_*t + PI/2.0;
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_A0_x_ = arm_crank_head_x_ - crank_x_;
    const double phi_dot_A0_x_ = -arm_crank_head_y_*crank_omega_ - crank_vx_;
    const double rhs_A0_x_ = arm_crank_head_x_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_A0_x_
        - phi_dot_A0_x_*p->two_alpha_;
    rhs->phi[0] = phi_A0_x_;
    rhs->phi_dot[0] = phi_dot_A0_x_;
    const double phi_A0_y_ = arm_crank_head_y_ - crank_y_;
    const double phi_dot_A0_y_ = arm_crank_head_x_*crank_omega_ - crank_vy_;
    const double rhs_A0_y_ = arm_crank_head_y_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_A0_y_
        - phi_dot_A0_y_*p->two_alpha_;
    rhs->phi[1] = phi_A0_y_;
    rhs->phi_dot[1] = phi_dot_A0_y_;
    const double phi_A_x_ = arm_coupler_head_x_ + arm_crank_head_x_ - coupler_x_ + crank_x_;
    const double phi_dot_A_x_ = -arm_coupler_head_y_*coupler_omega_ - arm_crank_head_y_*crank_omega_ - coupler_vx_
        + crank_vx_;
    const double rhs_A_x_ = arm_coupler_head_x_*(coupler_omega_ * coupler_omega_)
        + arm_crank_head_x_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_A_x_ - phi_dot_A_x_*p->two_alpha_;
    rhs->phi[2] = phi_A_x_;
    rhs->phi_dot[2] = phi_dot_A_x_;
    const double phi_A_y_ = arm_coupler_head_y_ + arm_crank_head_y_ - coupler_y_ + crank_y_;
    const double phi_dot_A_y_ = arm_coupler_head_x_*coupler_omega_ + arm_crank_head_x_*crank_omega_ - coupler_vy_
        + crank_vy_;
    const double rhs_A_y_ = arm_coupler_head_y_*(coupler_omega_ * coupler_omega_)
        + arm_crank_head_y_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_A_y_ - phi_dot_A_y_*p->two_alpha_;
    rhs->phi[3] = phi_A_y_;
    rhs->phi_dot[3] = phi_dot_A_y_;
    const double phi_B_x_ = arm_coupler_head_x_ - arm_rocker_head_x_ + coupler_x_ - rocker_x_;
    const double phi_dot_B_x_ = -arm_coupler_head_y_*coupler_omega_ + arm_rocker_head_y_*rocker_omega_ + coupler_vx_
        - rocker_vx_;
    const double rhs_B_x_ = arm_coupler_head_x_*(coupler_omega_ * coupler_omega_)
        - arm_rocker_head_x_*(rocker_omega_ * rocker_omega_) - p->beta_squared_*phi_B_x_ - phi_dot_B_x_*p->two_alpha_;
    rhs->phi[4] = phi_B_x_;
    rhs->phi_dot[4] = phi_dot_B_x_;
    const double phi_B_y_ = arm_coupler_head_y_ - arm_rocker_head_y_ + coupler_y_ - rocker_y_;
    const double phi_dot_B_y_ = arm_coupler_head_x_*coupler_omega_ - arm_rocker_head_x_*rocker_omega_ + coupler_vy_
        - rocker_vy_;
    const double rhs_B_y_ = arm_coupler_head_y_*(coupler_omega_ * coupler_omega_)
        - arm_rocker_head_y_*(rocker_omega_ * rocker_omega_) - p->beta_squared_*phi_B_y_ - phi_dot_B_y_*p->two_alpha_;
    rhs->phi[5] = phi_B_y_;
    rhs->phi_dot[5] = phi_dot_B_y_;
    const double phi_B0_x_ = p->B0_x_ + arm_rocker_head_x_ - rocker_x_;
    const double phi_dot_B0_x_ = -arm_rocker_head_y_*rocker_omega_ - rocker_vx_;
    const double rhs_B0_x_ = arm_rocker_head_x_*(rocker_omega_ * rocker_omega_) - p->beta_squared_*phi_B0_x_
        - phi_dot_B0_x_*p->two_alpha_;
    rhs->phi[6] = phi_B0_x_;
    rhs->phi_dot[6] = phi_dot_B0_x_;
    const double phi_B0_y_ = arm_rocker_head_y_ - rocker_y_;
    const double phi_dot_B0_y_ = arm_rocker_head_x_*rocker_omega_ - rocker_vy_;
    const double rhs_B0_y_ = arm_rocker_head_y_*(rocker_omega_ * rocker_omega_) - p->beta_squared_*phi_B0_y_
        - phi_dot_B0_y_*p->two_alpha_;
    rhs->phi[7] = phi_B0_y_;
    rhs->phi_dot[7] = phi_dot_B0_y_;
    const double phi_motor_ = crank_theta_ - motor_value_;
    const double phi_dot_motor_ = crank_omega_ - motor_rate_;
    const double rhs_motor_ = -p->beta_squared_*phi_motor_ + motor_acceleration_ - phi_dot_motor_*p->two_alpha_;
    rhs->phi[8] = phi_motor_;
    rhs->phi_dot[8] = phi_dot_motor_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_crank_theta_A_y_ = -arm_crank_head_x_*p->coupler_mass_;
    const double l_coupler_theta_A_y_ = -arm_coupler_head_x_*p->coupler_mass_;
    const double l_crank_theta_A_x_ = arm_crank_head_y_*p->coupler_mass_;
    const double l_coupler_theta_A_x_ = arm_coupler_head_y_*p->coupler_mass_;
    const double inertia_crank_theta_ = -arm_crank_head_x_*l_crank_theta_A_y_ + arm_crank_head_y_*l_crank_theta_A_x_
        + p->crank_inertia_;
    const double w_crank_y_crank_theta_ = arm_crank_head_x_*p->coupler_mass_;
    const double w_crank_x_crank_theta_ = -arm_crank_head_y_*p->coupler_mass_;
    const double w_coupler_theta_crank_theta_ = -arm_crank_head_x_*l_coupler_theta_A_y_
        + arm_crank_head_y_*l_coupler_theta_A_x_;
    const double l_rocker_theta_B0_y_ = -arm_rocker_head_x_*p->rocker_mass_;
    const double l_rocker_theta_B0_x_ = arm_rocker_head_y_*p->rocker_mass_;
    const double inertia_crank_y_ = p->coupler_mass_ + p->crank_mass_;
    const double inertia_crank_x_ = p->coupler_mass_ + p->crank_mass_;
    const double pivot_coupler_theta_ = -arm_coupler_head_x_*l_coupler_theta_A_y_
        + arm_coupler_head_y_*l_coupler_theta_A_x_ + p->coupler_inertia_;
    if (!(pivot_coupler_theta_ > LIGHT_PIVOT * p->coupler_turning_)) {
        pivot = 10;
        goto dependent;
    }
    const double inverse_pivot_coupler_theta_ = 1.0/pivot_coupler_theta_;
    const double w_B_x_coupler_theta_ = -2.0*arm_coupler_head_y_;
    const double l_B_x_coupler_theta_ = inverse_pivot_coupler_theta_*w_B_x_coupler_theta_;
    const double w_B_y_coupler_theta_ = 2.0*arm_coupler_head_x_;
    const double l_B_y_coupler_theta_ = inverse_pivot_coupler_theta_*w_B_y_coupler_theta_;
    const double pivot_rocker_theta_ = -arm_rocker_head_x_*l_rocker_theta_B0_y_
        + arm_rocker_head_y_*l_rocker_theta_B0_x_ + p->rocker_inertia_;
    if (!(pivot_rocker_theta_ > LIGHT_PIVOT * p->rocker_turning_)) {
        pivot = 11;
        goto dependent;
    }
    const double inverse_pivot_rocker_theta_ = 1.0/pivot_rocker_theta_;
    const double w_B_x_rocker_theta_ = 2.0*arm_rocker_head_y_;
    const double l_B_x_rocker_theta_ = inverse_pivot_rocker_theta_*w_B_x_rocker_theta_;
    const double w_B_y_rocker_theta_ = -2.0*arm_rocker_head_x_;
    const double l_B_y_rocker_theta_ = inverse_pivot_rocker_theta_*w_B_y_rocker_theta_;
    const double scale_B_x_ = l_B_x_coupler_theta_*w_B_x_coupler_theta_ + l_B_x_rocker_theta_*w_B_x_rocker_theta_;
    const double scale_B_y_ = l_B_y_coupler_theta_*w_B_y_coupler_theta_ + l_B_y_rocker_theta_*w_B_y_rocker_theta_;
    const double size_B_x_ = p->mobility_B_x_ + scale_B_x_;
    const double size_B_y_ = p->mobility_B_x_ + scale_B_y_;
    const double pivot_B_x_B_y_ = l_B_y_coupler_theta_*w_B_x_coupler_theta_ + l_B_y_rocker_theta_*w_B_x_rocker_theta_;
    const double determinant_B_x_B_y_ = -(pivot_B_x_B_y_ * pivot_B_x_B_y_) + scale_B_x_*scale_B_y_;
    if (!(scale_B_x_ > discrete->min_pivot * size_B_x_)) {
        pivot = 8;
        goto dependent;
    }
    if (!(determinant_B_x_B_y_ > discrete->min_pivot * size_B_y_ * scale_B_x_)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_B_x_B_y_ = -1.0/determinant_B_x_B_y_;
    const double inverse_pivot_B_x_ = inverse_B_x_B_y_*scale_B_y_;
    const double inverse_pivot_B_y_ = inverse_B_x_B_y_*scale_B_x_;
    const double inverse_cross_B_x_B_y_ = -inverse_B_x_B_y_*pivot_B_x_B_y_;

    /* forward substitution */
    const double z_crank_theta_ = arm_crank_head_x_*p->weight_coupler_y_ - l_crank_theta_A_x_*rhs_A_x_
        - l_crank_theta_A_y_*rhs_A_y_;
    const double z_crank_y_ = p->coupler_mass_*rhs_A_y_ - rhs_motor_*w_crank_y_crank_theta_ + p->weight_coupler_y_
        + p->weight_crank_y_;
    const double z_A0_y_ = -arm_crank_head_x_*rhs_motor_ + rhs_A0_y_;
    const double z_crank_x_ = p->coupler_mass_*rhs_A_x_ - rhs_motor_*w_crank_x_crank_theta_;
    const double z_A0_x_ = arm_crank_head_y_*rhs_motor_ + rhs_A0_x_;
    const double z_coupler_theta_ = arm_coupler_head_x_*p->weight_coupler_y_ - l_coupler_theta_A_x_*rhs_A_x_
        - l_coupler_theta_A_x_*z_A0_x_ - l_coupler_theta_A_y_*rhs_A_y_ - l_coupler_theta_A_y_*z_A0_y_
        - rhs_motor_*w_coupler_theta_crank_theta_;
    const double z_rocker_theta_ = arm_rocker_head_x_*p->weight_rocker_y_ - l_rocker_theta_B0_x_*rhs_B0_x_
        - l_rocker_theta_B0_y_*rhs_B0_y_;
    const double z_B_x_ = arm_crank_head_y_*rhs_motor_ - l_B_x_coupler_theta_*z_coupler_theta_
        - l_B_x_rocker_theta_*z_rocker_theta_ + rhs_A_x_ - rhs_B0_x_ + rhs_B_x_ + z_A0_x_;
    const double z_B_y_ = -arm_crank_head_x_*rhs_motor_ - l_B_y_coupler_theta_*z_coupler_theta_
        - l_B_y_rocker_theta_*z_rocker_theta_ + rhs_A_y_ - rhs_B0_y_ + rhs_B_y_ + z_A0_y_;

    /* backward substitution */
    const double lambda_B_y_ = inverse_cross_B_x_B_y_*z_B_x_ + inverse_pivot_B_y_*z_B_y_;
    const double lambda_B_x_ = inverse_cross_B_x_B_y_*z_B_y_ + inverse_pivot_B_x_*z_B_x_;
    const double acceleration_rocker_theta_ = inverse_pivot_rocker_theta_*z_rocker_theta_
        - l_B_x_rocker_theta_*lambda_B_x_ - l_B_y_rocker_theta_*lambda_B_y_;
    const double acceleration_coupler_theta_ = inverse_pivot_coupler_theta_*z_coupler_theta_
        - l_B_x_coupler_theta_*lambda_B_x_ - l_B_y_coupler_theta_*lambda_B_y_;
    const double lambda_A0_x_ = -acceleration_coupler_theta_*l_coupler_theta_A_x_ - inertia_crank_x_*z_A0_x_
        + lambda_B_x_ - z_crank_x_;
    const double acceleration_crank_x_ = -z_A0_x_;
    const double lambda_A0_y_ = -acceleration_coupler_theta_*l_coupler_theta_A_y_ - inertia_crank_y_*z_A0_y_
        + lambda_B_y_ - z_crank_y_;
    const double acceleration_crank_y_ = -z_A0_y_;
    const double lambda_B0_x_ = -acceleration_rocker_theta_*l_rocker_theta_B0_x_ - lambda_B_x_
        - rhs_B0_x_*p->rocker_mass_;
    const double acceleration_rocker_x_ = -acceleration_rocker_theta_*arm_rocker_head_y_ - rhs_B0_x_;
    const double lambda_B0_y_ = -acceleration_rocker_theta_*l_rocker_theta_B0_y_ - lambda_B_y_
        - rhs_B0_y_*p->rocker_mass_ - p->weight_rocker_y_;
    const double acceleration_rocker_y_ = acceleration_rocker_theta_*arm_rocker_head_x_ - rhs_B0_y_;
    const double lambda_motor_ = -acceleration_coupler_theta_*w_coupler_theta_crank_theta_
        - acceleration_crank_x_*w_crank_x_crank_theta_ - acceleration_crank_y_*w_crank_y_crank_theta_
        - arm_crank_head_x_*lambda_A0_y_ - arm_crank_head_x_*lambda_B_y_ + arm_crank_head_y_*lambda_A0_x_
        + arm_crank_head_y_*lambda_B_x_ - inertia_crank_theta_*rhs_motor_ + z_crank_theta_;
    const double acceleration_crank_theta_ = rhs_motor_;
    const double lambda_A_x_ = -acceleration_coupler_theta_*l_coupler_theta_A_x_
        - acceleration_crank_theta_*l_crank_theta_A_x_ + acceleration_crank_x_*p->coupler_mass_
        - p->coupler_mass_*rhs_A_x_ + lambda_B_x_;
    const double acceleration_coupler_x_ = -acceleration_coupler_theta_*arm_coupler_head_y_
        - acceleration_crank_theta_*arm_crank_head_y_ + acceleration_crank_x_ - rhs_A_x_;
    const double lambda_A_y_ = -acceleration_coupler_theta_*l_coupler_theta_A_y_
        - acceleration_crank_theta_*l_crank_theta_A_y_ + acceleration_crank_y_*p->coupler_mass_
        - p->coupler_mass_*rhs_A_y_ + lambda_B_y_ - p->weight_coupler_y_;
    const double acceleration_coupler_y_ = acceleration_coupler_theta_*arm_coupler_head_x_
        + acceleration_crank_theta_*arm_crank_head_x_ + acceleration_crank_y_ - rhs_A_y_;

    /* results */
    a[0] = acceleration_crank_x_;
    a[1] = acceleration_crank_y_;
    a[2] = acceleration_crank_theta_;
    a[3] = acceleration_coupler_x_;
    a[4] = acceleration_coupler_y_;
    a[5] = acceleration_coupler_theta_;
    a[6] = acceleration_rocker_x_;
    a[7] = acceleration_rocker_y_;
    a[8] = acceleration_rocker_theta_;
    rhs->lambda[0] = lambda_A0_x_;
    rhs->lambda[1] = lambda_A0_y_;
    rhs->lambda[2] = lambda_A_x_;
    rhs->lambda[3] = lambda_A_y_;
    rhs->lambda[4] = lambda_B_x_;
    rhs->lambda[5] = lambda_B_y_;
    rhs->lambda[6] = lambda_B0_x_;
    rhs->lambda[7] = lambda_B0_y_;
    rhs->lambda[8] = lambda_motor_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_crank_y_;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_coupler_y_;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_rocker_y_;
        force[8] = 0.0;
        gamma_stab[0] = rhs_A0_x_;
        gamma_stab[1] = rhs_A0_y_;
        gamma_stab[2] = rhs_A_x_;
        gamma_stab[3] = rhs_A_y_;
        gamma_stab[4] = rhs_B_x_;
        gamma_stab[5] = rhs_B_y_;
        gamma_stab[6] = rhs_B0_x_;
        gamma_stab[7] = rhs_B0_y_;
        gamma_stab[8] = rhs_motor_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = -motor_rate_*rhs->lambda[8];
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
