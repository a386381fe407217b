/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     rod.y with lambda of pin.y; rod.x with lambda of pin.x; crank.y with lambda of O.y;
 *     crank.x with lambda of O.x; crank.theta with rod.theta; lambda of slider.offset.
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

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double arm_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_crankpin_x_ = cos_theta_rod_*p->rod_points_crankpin_x_;
    const double arm_rod_crankpin_y_ = p->rod_points_crankpin_x_*sin_theta_rod_;
    const double arm_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const double arm_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const double arm_rod_middle_x_ = cos_theta_rod_*p->rod_points_middle_x_;
    const double arm_rod_middle_y_ = p->rod_points_middle_x_*sin_theta_rod_;
    const double coil_span_x_ = -arm_crank_middle_x_ + arm_rod_middle_x_ - crank_x_ + rod_x_;
    const double coil_span_y_ = -arm_crank_middle_y_ + arm_rod_middle_y_ - crank_y_ + rod_y_;
    const double coil_span_rate_x_ = arm_crank_middle_y_*crank_omega_ - arm_rod_middle_y_*rod_omega_ - crank_vx_
        + rod_vx_;
    const double coil_span_rate_y_ = -arm_crank_middle_x_*crank_omega_ + arm_rod_middle_x_*rod_omega_ - crank_vy_
        + rod_vy_;
    const double coil_length_ = sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const double coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const double coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);
    const double coil_pull_ = coil_force_/coil_length_;
    const double arm_rod_tip_y_ = p->rod_points_tip_x_*sin_theta_rod_;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x_ = -crank_x_;
    const double phi_dot_O_x_ = -crank_vx_;
    const double rhs_O_x_ = -p->beta_squared_*phi_O_x_ - phi_dot_O_x_*p->two_alpha_;
    rhs->phi[0] = phi_O_x_;
    rhs->phi_dot[0] = phi_dot_O_x_;
    const double phi_O_y_ = -crank_y_;
    const double phi_dot_O_y_ = -crank_vy_;
    const double rhs_O_y_ = -p->beta_squared_*phi_O_y_ - phi_dot_O_y_*p->two_alpha_;
    rhs->phi[1] = phi_O_y_;
    rhs->phi_dot[1] = phi_dot_O_y_;
    const double phi_pin_x_ = arm_crank_head_x_ - arm_rod_crankpin_x_ + crank_x_ - rod_x_;
    const double phi_dot_pin_x_ = -arm_crank_head_y_*crank_omega_ + arm_rod_crankpin_y_*rod_omega_ + crank_vx_
        - rod_vx_;
    const double rhs_pin_x_ = arm_crank_head_x_*(crank_omega_ * crank_omega_)
        - arm_rod_crankpin_x_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_pin_x_ - phi_dot_pin_x_*p->two_alpha_;
    rhs->phi[2] = phi_pin_x_;
    rhs->phi_dot[2] = phi_dot_pin_x_;
    const double phi_pin_y_ = arm_crank_head_y_ - arm_rod_crankpin_y_ + crank_y_ - rod_y_;
    const double phi_dot_pin_y_ = arm_crank_head_x_*crank_omega_ - arm_rod_crankpin_x_*rod_omega_ + crank_vy_ - rod_vy_;
    const double rhs_pin_y_ = arm_crank_head_y_*(crank_omega_ * crank_omega_)
        - arm_rod_crankpin_y_*(rod_omega_ * rod_omega_) - p->beta_squared_*phi_pin_y_ - phi_dot_pin_y_*p->two_alpha_;
    rhs->phi[3] = phi_pin_y_;
    rhs->phi_dot[3] = phi_dot_pin_y_;
    const double phi_slider_offset_ = rod_y_;
    const double phi_dot_slider_offset_ = rod_vy_;
    const double rhs_slider_offset_ = -p->beta_squared_*phi_slider_offset_ - phi_dot_slider_offset_*p->two_alpha_;
    rhs->phi[4] = phi_slider_offset_;
    rhs->phi_dot[4] = phi_dot_slider_offset_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_crank_theta_pin_y_ = -arm_crank_head_x_*p->rod_mass_;
    const double l_rod_theta_pin_y_ = arm_rod_crankpin_x_*p->rod_mass_;
    const double l_crank_theta_pin_x_ = arm_crank_head_y_*p->rod_mass_;
    const double l_rod_theta_pin_x_ = -arm_rod_crankpin_y_*p->rod_mass_;
    const double inertia_crank_y_ = p->crank_mass_ + p->rod_mass_;
    const double inertia_crank_x_ = p->crank_mass_ + p->rod_mass_;
    const double pivot_crank_theta_ = -arm_crank_head_x_*l_crank_theta_pin_y_ + arm_crank_head_y_*l_crank_theta_pin_x_
        + p->crank_inertia_;
    const double pivot_rod_theta_ = arm_rod_crankpin_x_*l_rod_theta_pin_y_ - arm_rod_crankpin_y_*l_rod_theta_pin_x_
        + p->rod_inertia_;
    const double pivot_crank_theta_rod_theta_ = -arm_crank_head_x_*l_rod_theta_pin_y_
        + arm_crank_head_y_*l_rod_theta_pin_x_;
    const double determinant_crank_theta_rod_theta_ = pivot_crank_theta_*pivot_rod_theta_
        - (pivot_crank_theta_rod_theta_ * pivot_crank_theta_rod_theta_);
    if (!(pivot_crank_theta_ > LIGHT_PIVOT * p->crank_turning_)) {
        pivot = 6;
        goto dependent;
    }
    if (!(determinant_crank_theta_rod_theta_ > LIGHT_PIVOT * p->rod_turning_ * pivot_crank_theta_)) {
        pivot = 7;
        goto dependent;
    }
    const double inverse_crank_theta_rod_theta_ = 1.0/determinant_crank_theta_rod_theta_;
    const double inverse_pivot_crank_theta_ = inverse_crank_theta_rod_theta_*pivot_rod_theta_;
    const double inverse_pivot_rod_theta_ = inverse_crank_theta_rod_theta_*pivot_crank_theta_;
    const double inverse_cross_crank_theta_rod_theta_ = -inverse_crank_theta_rod_theta_*pivot_crank_theta_rod_theta_;
    const double l_slider_offset_crank_theta_ = arm_crank_head_x_*inverse_pivot_crank_theta_
        - arm_rod_crankpin_x_*inverse_cross_crank_theta_rod_theta_;
    const double l_slider_offset_rod_theta_ = arm_crank_head_x_*inverse_cross_crank_theta_rod_theta_
        - arm_rod_crankpin_x_*inverse_pivot_rod_theta_;
    const double scale_slider_offset_ = arm_crank_head_x_*l_slider_offset_crank_theta_
        - arm_rod_crankpin_x_*l_slider_offset_rod_theta_;
    const double pivot_slider_offset_ = scale_slider_offset_;
    const double size_slider_offset_ = p->mobility_slider_offset_ + scale_slider_offset_;
    if (!(pivot_slider_offset_ > discrete->min_pivot * size_slider_offset_)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_pivot_slider_offset_ = 1.0/pivot_slider_offset_;

    /* forward substitution */
    const double z_rod_y_ = -coil_pull_*coil_span_y_;
    const double z_rod_x_ = -coil_pull_*coil_span_x_ + p->push_value_x_;
    const double z_crank_y_ = coil_pull_*coil_span_y_ + rhs_pin_y_*p->rod_mass_ + z_rod_y_;
    const double z_crank_x_ = coil_pull_*coil_span_x_ + rhs_pin_x_*p->rod_mass_ + z_rod_x_;
    const double z_crank_theta_ = arm_crank_head_x_*z_rod_y_ - arm_crank_head_y_*z_rod_x_
        + arm_crank_middle_x_*coil_pull_*coil_span_y_ - arm_crank_middle_y_*coil_pull_*coil_span_x_
        - l_crank_theta_pin_x_*rhs_O_x_ - l_crank_theta_pin_x_*rhs_pin_x_ - l_crank_theta_pin_y_*rhs_O_y_
        - l_crank_theta_pin_y_*rhs_pin_y_;
    const double z_rod_theta_ = -arm_rod_crankpin_x_*z_rod_y_ + arm_rod_crankpin_y_*z_rod_x_
        - arm_rod_middle_x_*coil_pull_*coil_span_y_ + arm_rod_middle_y_*coil_pull_*coil_span_x_
        - arm_rod_tip_y_*p->push_value_x_ - l_rod_theta_pin_x_*rhs_O_x_ - l_rod_theta_pin_x_*rhs_pin_x_
        - l_rod_theta_pin_y_*rhs_O_y_ - l_rod_theta_pin_y_*rhs_pin_y_;
    const double z_slider_offset_ = -l_slider_offset_crank_theta_*z_crank_theta_
        - l_slider_offset_rod_theta_*z_rod_theta_ + rhs_O_y_ + rhs_pin_y_ + rhs_slider_offset_;

    /* backward substitution */
    const double lambda_slider_offset_ = -inverse_pivot_slider_offset_*z_slider_offset_;
    const double acceleration_rod_theta_ = inverse_cross_crank_theta_rod_theta_*z_crank_theta_
        + inverse_pivot_rod_theta_*z_rod_theta_ - l_slider_offset_rod_theta_*lambda_slider_offset_;
    const double acceleration_crank_theta_ = inverse_cross_crank_theta_rod_theta_*z_rod_theta_
        + inverse_pivot_crank_theta_*z_crank_theta_ - l_slider_offset_crank_theta_*lambda_slider_offset_;
    const double lambda_O_x_ = -acceleration_crank_theta_*l_crank_theta_pin_x_
        - acceleration_rod_theta_*l_rod_theta_pin_x_ - inertia_crank_x_*rhs_O_x_ - z_crank_x_;
    const double acceleration_crank_x_ = -rhs_O_x_;
    const double lambda_O_y_ = -acceleration_crank_theta_*l_crank_theta_pin_y_
        - acceleration_rod_theta_*l_rod_theta_pin_y_ - inertia_crank_y_*rhs_O_y_ + lambda_slider_offset_ - z_crank_y_;
    const double acceleration_crank_y_ = -rhs_O_y_;
    const double lambda_pin_x_ = -acceleration_crank_theta_*l_crank_theta_pin_x_ + acceleration_crank_x_*p->rod_mass_
        - acceleration_rod_theta_*l_rod_theta_pin_x_ - rhs_pin_x_*p->rod_mass_ - z_rod_x_;
    const double acceleration_rod_x_ = -acceleration_crank_theta_*arm_crank_head_y_ + acceleration_crank_x_
        + acceleration_rod_theta_*arm_rod_crankpin_y_ - rhs_pin_x_;
    const double lambda_pin_y_ = -acceleration_crank_theta_*l_crank_theta_pin_y_ + acceleration_crank_y_*p->rod_mass_
        - acceleration_rod_theta_*l_rod_theta_pin_y_ + lambda_slider_offset_ - rhs_pin_y_*p->rod_mass_ - z_rod_y_;
    const double acceleration_rod_y_ = acceleration_crank_theta_*arm_crank_head_x_ + acceleration_crank_y_
        - acceleration_rod_theta_*arm_rod_crankpin_x_ - rhs_pin_y_;

    /* results */
    a[0] = acceleration_crank_x_;
    a[1] = acceleration_crank_y_;
    a[2] = acceleration_crank_theta_;
    a[3] = acceleration_rod_x_;
    a[4] = acceleration_rod_y_;
    a[5] = acceleration_rod_theta_;
    rhs->lambda[0] = lambda_O_x_;
    rhs->lambda[1] = lambda_O_y_;
    rhs->lambda[2] = lambda_pin_x_;
    rhs->lambda[3] = lambda_pin_y_;
    rhs->lambda[4] = lambda_slider_offset_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = coil_pull_*coil_span_x_;
        force[1] = coil_pull_*coil_span_y_;
        force[2] = arm_crank_middle_x_*coil_pull_*coil_span_y_ - arm_crank_middle_y_*coil_pull_*coil_span_x_;
        force[3] = -coil_pull_*coil_span_x_ + p->push_value_x_;
        force[4] = -coil_pull_*coil_span_y_;
        force[5] = -arm_rod_middle_x_*coil_pull_*coil_span_y_ + arm_rod_middle_y_*coil_pull_*coil_span_x_
            - arm_rod_tip_y_*p->push_value_x_;
        gamma_stab[0] = rhs_O_x_;
        gamma_stab[1] = rhs_O_y_;
        gamma_stab[2] = rhs_pin_x_;
        gamma_stab[3] = rhs_pin_y_;
        gamma_stab[4] = rhs_slider_offset_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = -p->coil_damping_*(coil_length_rate_ * coil_length_rate_)
        + p->push_value_x_*(-arm_rod_tip_y_*rod_omega_ + rod_vx_);
    rhs->power[2] = 0.0;
    return pivot;
}
