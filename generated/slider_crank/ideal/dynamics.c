/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     slider.y with lambda of wristpin.y; slider.x with lambda of wristpin.x; rod.y with lambda of crankpin.y;
 *     rod.x with lambda of crankpin.x; crank.theta with lambda of motor;
 *     slider.theta with lambda of cylinder.angle; crank.y with lambda of O.y; crank.x with lambda of O.x;
 *     rod.theta; lambda of cylinder.offset.
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
    const double rod_x_ = q[3];
    const double rod_y_ = q[4];
    const double rod_theta_ = q[5];
    const double rod_vx_ = v[3];
    const double rod_vy_ = v[4];
    const double rod_omega_ = v[5];
    const double slider_x_ = q[6];
    const double slider_y_ = q[7];
    const double slider_theta_ = q[8];
    const double slider_vx_ = v[6];
    const double slider_vy_ = v[7];
    const double slider_omega_ = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double motor_value_ = p->omega_*t;
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x_ = arm_crank_head_x_ - crank_x_;
    const double phi_dot_O_x_ = -arm_crank_head_y_*crank_omega_ - crank_vx_;
    const double rhs_O_x_ = arm_crank_head_x_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_O_x_
        - phi_dot_O_x_*p->two_alpha_;
    rhs->phi[0] = phi_O_x_;
    rhs->phi_dot[0] = phi_dot_O_x_;
    const double phi_O_y_ = arm_crank_head_y_ - crank_y_;
    const double phi_dot_O_y_ = arm_crank_head_x_*crank_omega_ - crank_vy_;
    const double rhs_O_y_ = arm_crank_head_y_*(crank_omega_ * crank_omega_) - p->beta_squared_*phi_O_y_
        - phi_dot_O_y_*p->two_alpha_;
    rhs->phi[1] = phi_O_y_;
    rhs->phi_dot[1] = phi_dot_O_y_;
    const double phi_crankpin_x_ = arm_crank_head_x_ + arm_rod_head_x_ + crank_x_ - rod_x_;
    const double phi_dot_crankpin_x_ = -arm_crank_head_y_*crank_omega_ - arm_rod_head_y_*rod_omega_ + crank_vx_
        - rod_vx_;
    const double rhs_crankpin_x_ = arm_crank_head_x_*(crank_omega_ * crank_omega_)
        + arm_rod_head_x_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_crankpin_x_
        - phi_dot_crankpin_x_*p->two_alpha_;
    rhs->phi[2] = phi_crankpin_x_;
    rhs->phi_dot[2] = phi_dot_crankpin_x_;
    const double phi_crankpin_y_ = arm_crank_head_y_ + arm_rod_head_y_ + crank_y_ - rod_y_;
    const double phi_dot_crankpin_y_ = arm_crank_head_x_*crank_omega_ + arm_rod_head_x_*rod_omega_ + crank_vy_
        - rod_vy_;
    const double rhs_crankpin_y_ = arm_crank_head_y_*(crank_omega_ * crank_omega_)
        + arm_rod_head_y_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_crankpin_y_
        - phi_dot_crankpin_y_*p->two_alpha_;
    rhs->phi[3] = phi_crankpin_y_;
    rhs->phi_dot[3] = phi_dot_crankpin_y_;
    const double phi_wristpin_x_ = arm_rod_head_x_ + rod_x_ - slider_x_;
    const double phi_dot_wristpin_x_ = -arm_rod_head_y_*rod_omega_ + rod_vx_ - slider_vx_;
    const double rhs_wristpin_x_ = arm_rod_head_x_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_wristpin_x_
        - phi_dot_wristpin_x_*p->two_alpha_;
    rhs->phi[4] = phi_wristpin_x_;
    rhs->phi_dot[4] = phi_dot_wristpin_x_;
    const double phi_wristpin_y_ = arm_rod_head_y_ + rod_y_ - slider_y_;
    const double phi_dot_wristpin_y_ = arm_rod_head_x_*rod_omega_ + rod_vy_ - slider_vy_;
    const double rhs_wristpin_y_ = arm_rod_head_y_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_wristpin_y_
        - phi_dot_wristpin_y_*p->two_alpha_;
    rhs->phi[5] = phi_wristpin_y_;
    rhs->phi_dot[5] = phi_dot_wristpin_y_;
    const double phi_cylinder_offset_ = slider_y_;
    const double phi_dot_cylinder_offset_ = slider_vy_;
    const double rhs_cylinder_offset_ = -p->beta_squared_*phi_cylinder_offset_ - phi_dot_cylinder_offset_*p->two_alpha_;
    rhs->phi[6] = phi_cylinder_offset_;
    rhs->phi_dot[6] = phi_dot_cylinder_offset_;
    const double phi_cylinder_angle_ = slider_theta_;
    const double phi_dot_cylinder_angle_ = slider_omega_;
    const double rhs_cylinder_angle_ = -p->beta_squared_*phi_cylinder_angle_ - phi_dot_cylinder_angle_*p->two_alpha_;
    rhs->phi[7] = phi_cylinder_angle_;
    rhs->phi_dot[7] = phi_dot_cylinder_angle_;
    const double phi_motor_ = crank_theta_ - motor_value_;
    const double phi_dot_motor_ = crank_omega_ - motor_rate_;
    const double rhs_motor_ = -p->beta_squared_*phi_motor_ + motor_acceleration_ - phi_dot_motor_*p->two_alpha_;
    rhs->phi[8] = phi_motor_;
    rhs->phi_dot[8] = phi_dot_motor_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_rod_theta_wristpin_y_ = -arm_rod_head_x_*p->slider_mass_;
    const double l_rod_theta_wristpin_x_ = arm_rod_head_y_*p->slider_mass_;
    const double inertia_rod_y_ = p->rod_mass_ + p->slider_mass_;
    const double l_crank_theta_crankpin_y_ = -arm_crank_head_x_*inertia_rod_y_;
    const double l_rod_theta_crankpin_y_ = -arm_rod_head_x_*inertia_rod_y_ + l_rod_theta_wristpin_y_;
    const double inertia_rod_x_ = p->rod_mass_ + p->slider_mass_;
    const double l_crank_theta_crankpin_x_ = arm_crank_head_y_*inertia_rod_x_;
    const double l_rod_theta_crankpin_x_ = arm_rod_head_y_*inertia_rod_x_ + l_rod_theta_wristpin_x_;
    const double inertia_crank_theta_ = -arm_crank_head_x_*l_crank_theta_crankpin_y_
        + arm_crank_head_y_*l_crank_theta_crankpin_x_ + p->crank_inertia_;
    const double w_crank_y_crank_theta_ = arm_crank_head_x_*inertia_rod_y_;
    const double w_crank_x_crank_theta_ = -arm_crank_head_y_*inertia_rod_x_;
    const double w_rod_theta_crank_theta_ = -arm_crank_head_x_*l_rod_theta_crankpin_y_
        + arm_crank_head_y_*l_rod_theta_crankpin_x_;
    const double inertia_crank_y_ = p->crank_mass_ + inertia_rod_y_;
    const double inertia_crank_x_ = p->crank_mass_ + inertia_rod_x_;
    const double pivot_rod_theta_ = -arm_rod_head_x_*l_rod_theta_crankpin_y_
        - 2.0*arm_rod_head_x_*l_rod_theta_wristpin_y_ + arm_rod_head_y_*l_rod_theta_crankpin_x_
        + 2.0*arm_rod_head_y_*l_rod_theta_wristpin_x_ + p->rod_inertia_;
    if (!(pivot_rod_theta_ > LIGHT_PIVOT * p->rod_turning_)) {
        pivot = 10;
        goto dependent;
    }
    const double inverse_pivot_rod_theta_ = 1.0/pivot_rod_theta_;
    const double w_cylinder_offset_rod_theta_ = 2.0*arm_rod_head_x_;
    const double l_cylinder_offset_rod_theta_ = inverse_pivot_rod_theta_*w_cylinder_offset_rod_theta_;
    const double scale_cylinder_offset_ = l_cylinder_offset_rod_theta_*w_cylinder_offset_rod_theta_;
    const double pivot_cylinder_offset_ = scale_cylinder_offset_;
    const double size_cylinder_offset_ = p->mobility_cylinder_offset_ + scale_cylinder_offset_;
    if (!(pivot_cylinder_offset_ > discrete->min_pivot * size_cylinder_offset_)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pivot_cylinder_offset_ = 1.0/pivot_cylinder_offset_;

    /* forward substitution */
    const double z_rod_y_ = rhs_wristpin_y_*p->slider_mass_;
    const double z_rod_x_ = rhs_wristpin_x_*p->slider_mass_;
    const double z_crank_theta_ = arm_crank_head_x_*z_rod_y_ - arm_crank_head_y_*z_rod_x_
        - l_crank_theta_crankpin_x_*rhs_crankpin_x_ - l_crank_theta_crankpin_y_*rhs_crankpin_y_;
    const double z_crank_y_ = inertia_rod_y_*rhs_crankpin_y_ - rhs_motor_*w_crank_y_crank_theta_ + z_rod_y_;
    const double z_O_y_ = -arm_crank_head_x_*rhs_motor_ + rhs_O_y_;
    const double z_crank_x_ = inertia_rod_x_*rhs_crankpin_x_ - rhs_motor_*w_crank_x_crank_theta_ + z_rod_x_;
    const double z_O_x_ = arm_crank_head_y_*rhs_motor_ + rhs_O_x_;
    const double z_rod_theta_ = arm_rod_head_x_*z_rod_y_ - arm_rod_head_y_*z_rod_x_
        - l_rod_theta_crankpin_x_*rhs_crankpin_x_ - l_rod_theta_crankpin_x_*z_O_x_
        - l_rod_theta_crankpin_y_*rhs_crankpin_y_ - l_rod_theta_crankpin_y_*z_O_y_
        - l_rod_theta_wristpin_x_*rhs_wristpin_x_ - l_rod_theta_wristpin_y_*rhs_wristpin_y_
        - rhs_motor_*w_rod_theta_crank_theta_;
    const double z_cylinder_offset_ = -arm_crank_head_x_*rhs_motor_ - l_cylinder_offset_rod_theta_*z_rod_theta_
        + rhs_crankpin_y_ + rhs_cylinder_offset_ + rhs_wristpin_y_ + z_O_y_;

    /* backward substitution */
    const double lambda_cylinder_offset_ = -inverse_pivot_cylinder_offset_*z_cylinder_offset_;
    const double acceleration_rod_theta_ = inverse_pivot_rod_theta_*z_rod_theta_
        - l_cylinder_offset_rod_theta_*lambda_cylinder_offset_;
    const double lambda_O_x_ = -acceleration_rod_theta_*l_rod_theta_crankpin_x_ - inertia_crank_x_*z_O_x_ - z_crank_x_;
    const double acceleration_crank_x_ = -z_O_x_;
    const double lambda_O_y_ = -acceleration_rod_theta_*l_rod_theta_crankpin_y_ - inertia_crank_y_*z_O_y_
        + lambda_cylinder_offset_ - z_crank_y_;
    const double acceleration_crank_y_ = -z_O_y_;
    const double lambda_cylinder_angle_ = -rhs_cylinder_angle_*p->slider_inertia_;
    const double acceleration_slider_theta_ = rhs_cylinder_angle_;
    const double lambda_motor_ = -acceleration_crank_x_*w_crank_x_crank_theta_
        - acceleration_crank_y_*w_crank_y_crank_theta_ - acceleration_rod_theta_*w_rod_theta_crank_theta_
        - arm_crank_head_x_*lambda_O_y_ - arm_crank_head_x_*lambda_cylinder_offset_ + arm_crank_head_y_*lambda_O_x_
        - inertia_crank_theta_*rhs_motor_ + z_crank_theta_;
    const double acceleration_crank_theta_ = rhs_motor_;
    const double lambda_crankpin_x_ = -acceleration_crank_theta_*l_crank_theta_crankpin_x_
        + acceleration_crank_x_*inertia_rod_x_ - acceleration_rod_theta_*l_rod_theta_crankpin_x_
        - inertia_rod_x_*rhs_crankpin_x_ - z_rod_x_;
    const double acceleration_rod_x_ = -acceleration_crank_theta_*arm_crank_head_y_ + acceleration_crank_x_
        - acceleration_rod_theta_*arm_rod_head_y_ - rhs_crankpin_x_;
    const double lambda_crankpin_y_ = -acceleration_crank_theta_*l_crank_theta_crankpin_y_
        + acceleration_crank_y_*inertia_rod_y_ - acceleration_rod_theta_*l_rod_theta_crankpin_y_
        - inertia_rod_y_*rhs_crankpin_y_ + lambda_cylinder_offset_ - z_rod_y_;
    const double acceleration_rod_y_ = acceleration_crank_theta_*arm_crank_head_x_ + acceleration_crank_y_
        + acceleration_rod_theta_*arm_rod_head_x_ - rhs_crankpin_y_;
    const double lambda_wristpin_x_ = -acceleration_rod_theta_*l_rod_theta_wristpin_x_
        + acceleration_rod_x_*p->slider_mass_ - rhs_wristpin_x_*p->slider_mass_;
    const double acceleration_slider_x_ = -acceleration_rod_theta_*arm_rod_head_y_ + acceleration_rod_x_
        - rhs_wristpin_x_;
    const double lambda_wristpin_y_ = -acceleration_rod_theta_*l_rod_theta_wristpin_y_
        + acceleration_rod_y_*p->slider_mass_ + lambda_cylinder_offset_ - rhs_wristpin_y_*p->slider_mass_;
    const double acceleration_slider_y_ = acceleration_rod_theta_*arm_rod_head_x_ + acceleration_rod_y_
        - rhs_wristpin_y_;

    /* results */
    a[0] = acceleration_crank_x_;
    a[1] = acceleration_crank_y_;
    a[2] = acceleration_crank_theta_;
    a[3] = acceleration_rod_x_;
    a[4] = acceleration_rod_y_;
    a[5] = acceleration_rod_theta_;
    a[6] = acceleration_slider_x_;
    a[7] = acceleration_slider_y_;
    a[8] = acceleration_slider_theta_;
    rhs->lambda[0] = lambda_O_x_;
    rhs->lambda[1] = lambda_O_y_;
    rhs->lambda[2] = lambda_crankpin_x_;
    rhs->lambda[3] = lambda_crankpin_y_;
    rhs->lambda[4] = lambda_wristpin_x_;
    rhs->lambda[5] = lambda_wristpin_y_;
    rhs->lambda[6] = lambda_cylinder_offset_;
    rhs->lambda[7] = lambda_cylinder_angle_;
    rhs->lambda[8] = lambda_motor_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = 0.0;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = 0.0;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = 0.0;
        force[8] = 0.0;
        gamma_stab[0] = rhs_O_x_;
        gamma_stab[1] = rhs_O_y_;
        gamma_stab[2] = rhs_crankpin_x_;
        gamma_stab[3] = rhs_crankpin_y_;
        gamma_stab[4] = rhs_wristpin_x_;
        gamma_stab[5] = rhs_wristpin_y_;
        gamma_stab[6] = rhs_cylinder_offset_;
        gamma_stab[7] = rhs_cylinder_angle_;
        gamma_stab[8] = rhs_motor_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = -motor_rate_*rhs->lambda[8];
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
