/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     axle.x; axle.y; lambda of slot.offset; road.theta with lambda of bump; road.y with lambda of foot.y;
 *     road.x with lambda of foot.x; axle.theta.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double axle_vx_ = v[0];
    const double axle_vy_ = v[1];
    const double axle_omega_ = v[2];
    const double road_x_ = q[3];
    const double road_y_ = q[4];
    const double road_theta_ = q[5];
    const double road_vx_ = v[3];
    const double road_vy_ = v[4];
    const double road_omega_ = v[5];

    /* directions, arms, drives */
    const double cos_theta_road_ = cos(road_theta_);
    const double sin_theta_road_ = sin(road_theta_);
    const double arm_road_head_x_ = cos_theta_road_*p->road_head_s_x_;
    const double arm_road_head_y_ = p->road_head_s_x_*sin_theta_road_;
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double arm_axle_head_x_ = p->axle_head_s_x_*cos_theta_axle_;
    const double arm_axle_head_y_ = p->axle_head_s_x_*sin_theta_axle_;
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*sin(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*sin(p->omega_*t)*(cos(p->omega_*t)
        * cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*pow(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_), 1.5));
    const double left_span_x_ = -arm_axle_head_x_ + axle_x_;
    const double left_span_y_ = -arm_axle_head_y_ + axle_y_;
    const double left_length_ = sqrt((left_span_x_ * left_span_x_) + (left_span_y_ * left_span_y_));
    const double left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const double left_pull_ = left_force_/left_length_;
    const double right_span_x_ = arm_axle_head_x_ - arm_road_head_x_ + axle_x_ - road_x_;
    const double right_span_y_ = arm_axle_head_y_ - arm_road_head_y_ + axle_y_ - road_y_;
    const double right_length_ = sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const double right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);
    const double right_pull_ = right_force_/right_length_;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_foot_x_ = arm_road_head_x_ - road_x_;
    const double phi_dot_foot_x_ = -arm_road_head_y_*road_omega_ - road_vx_;
    const double rhs_foot_x_ = arm_road_head_x_*(road_omega_ * road_omega_) - p->beta_squared_*phi_foot_x_
        - phi_dot_foot_x_*p->two_alpha_;
    rhs->phi[0] = phi_foot_x_;
    rhs->phi_dot[0] = phi_dot_foot_x_;
    const double phi_foot_y_ = arm_road_head_y_ - road_y_;
    const double phi_dot_foot_y_ = arm_road_head_x_*road_omega_ - road_vy_;
    const double rhs_foot_y_ = arm_road_head_y_*(road_omega_ * road_omega_) - p->beta_squared_*phi_foot_y_
        - phi_dot_foot_y_*p->two_alpha_;
    rhs->phi[1] = phi_foot_y_;
    rhs->phi_dot[1] = phi_dot_foot_y_;
    const double phi_slot_offset_ = arm_axle_head_x_*cos_theta_road_ + arm_axle_head_y_*sin_theta_road_
        - arm_road_head_x_*cos_theta_road_ - arm_road_head_y_*sin_theta_road_ - axle_x_*cos_theta_road_
        - axle_y_*sin_theta_road_ + cos_theta_road_*road_x_ + road_y_*sin_theta_road_;
    const double phi_dot_slot_offset_ = axle_omega_*(arm_axle_head_x_*sin_theta_road_
        - arm_axle_head_y_*cos_theta_road_) - axle_vx_*cos_theta_road_ - axle_vy_*sin_theta_road_
        + cos_theta_road_*road_vx_ + road_omega_*(-arm_axle_head_x_*sin_theta_road_ + arm_axle_head_y_*cos_theta_road_
        + axle_x_*sin_theta_road_ - axle_y_*cos_theta_road_ + cos_theta_road_*road_y_ - road_x_*sin_theta_road_)
        + road_vy_*sin_theta_road_;
    const double rhs_slot_offset_ = -axle_omega_*(arm_axle_head_x_*(-axle_omega_*cos_theta_road_
        + cos_theta_road_*road_omega_) - arm_axle_head_y_*(axle_omega_*sin_theta_road_ - road_omega_*sin_theta_road_))
        - axle_vx_*road_omega_*sin_theta_road_ + axle_vy_*cos_theta_road_*road_omega_
        - p->beta_squared_*phi_slot_offset_ - cos_theta_road_*road_omega_*road_vy_ - phi_dot_slot_offset_*p->two_alpha_
        + road_omega_*road_vx_*sin_theta_road_ - road_omega_*(cos_theta_road_*(arm_axle_head_x_*axle_omega_ - axle_vy_
        + road_omega_*(-arm_axle_head_x_ + axle_x_ - road_x_) + road_vy_)
        - sin_theta_road_*(-arm_axle_head_y_*axle_omega_ - axle_vx_
        + road_omega_*(arm_axle_head_y_ - axle_y_ + road_y_) + road_vx_));
    rhs->phi[2] = phi_slot_offset_;
    rhs->phi_dot[2] = phi_dot_slot_offset_;
    const double phi_bump_ = -bump_value_ + road_theta_;
    const double phi_dot_bump_ = -bump_rate_ + road_omega_;
    const double rhs_bump_ = -p->beta_squared_*phi_bump_ + bump_acceleration_ - phi_dot_bump_*p->two_alpha_;
    rhs->phi[3] = phi_bump_;
    rhs->phi_dot[3] = phi_dot_bump_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_axle_mass_;
    const double l_slot_offset_axle_y_ = -p->inverse_axle_mass_*sin_theta_road_;
    const double scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_ - l_slot_offset_axle_y_*sin_theta_road_;
    if (!(scale_slot_offset_ > 0.0 && scale_slot_offset_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;
    const double w_road_theta_slot_offset_ = -arm_axle_head_x_*sin_theta_road_ + arm_axle_head_y_*cos_theta_road_
        + axle_x_*sin_theta_road_ - axle_y_*cos_theta_road_ + cos_theta_road_*road_y_ - road_x_*sin_theta_road_;
    const double l_road_theta_slot_offset_ = -inverse_pivot_slot_offset_*w_road_theta_slot_offset_;
    const double l_road_y_slot_offset_ = -inverse_pivot_slot_offset_*sin_theta_road_;
    const double l_road_x_slot_offset_ = -cos_theta_road_*inverse_pivot_slot_offset_;
    const double w_axle_theta_slot_offset_ = arm_axle_head_x_*sin_theta_road_ - arm_axle_head_y_*cos_theta_road_;
    const double l_axle_theta_slot_offset_ = -inverse_pivot_slot_offset_*w_axle_theta_slot_offset_;
    const double inertia_road_theta_ = -l_road_theta_slot_offset_*w_road_theta_slot_offset_ + p->road_inertia_;
    const double w_road_y_road_theta_ = -l_road_y_slot_offset_*w_road_theta_slot_offset_;
    const double w_road_x_road_theta_ = -l_road_x_slot_offset_*w_road_theta_slot_offset_;
    const double w_axle_theta_road_theta_ = -l_axle_theta_slot_offset_*w_road_theta_slot_offset_;
    const double inertia_road_y_ = -l_road_y_slot_offset_*sin_theta_road_ + p->road_mass_;
    const double w_road_x_road_y_ = -l_road_x_slot_offset_*sin_theta_road_;
    const double w_axle_theta_road_y_ = -l_axle_theta_slot_offset_*sin_theta_road_;
    const double inertia_road_x_ = -cos_theta_road_*l_road_x_slot_offset_ + p->road_mass_;
    const double w_axle_theta_road_x_ = -cos_theta_road_*l_axle_theta_slot_offset_;
    const double pivot_axle_theta_ = p->axle_inertia_ - l_axle_theta_slot_offset_*w_axle_theta_slot_offset_;
    if (!(pivot_axle_theta_ > LIGHT_PIVOT * p->axle_turning_)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_pivot_axle_theta_ = 1.0/pivot_axle_theta_;

    /* forward substitution */
    const double z_axle_x_ = -left_pull_*left_span_x_ - right_pull_*right_span_x_;
    const double z_axle_y_ = -left_pull_*left_span_y_ - right_pull_*right_span_y_ + p->weight_axle_y_;
    const double z_slot_offset_ = -l_slot_offset_axle_x_*z_axle_x_ - l_slot_offset_axle_y_*z_axle_y_ + rhs_slot_offset_;
    const double z_road_theta_ = arm_road_head_x_*right_pull_*right_span_y_
        - arm_road_head_y_*right_pull_*right_span_x_ - l_road_theta_slot_offset_*z_slot_offset_;
    const double z_road_y_ = -l_road_y_slot_offset_*z_slot_offset_ - rhs_bump_*w_road_y_road_theta_
        + right_pull_*right_span_y_ + p->weight_road_y_;
    const double z_foot_y_ = -arm_road_head_x_*rhs_bump_ + rhs_foot_y_;
    const double z_road_x_ = -l_road_x_slot_offset_*z_slot_offset_ - rhs_bump_*w_road_x_road_theta_
        + right_pull_*right_span_x_ + w_road_x_road_y_*z_foot_y_;
    const double z_foot_x_ = arm_road_head_y_*rhs_bump_ + rhs_foot_x_;
    const double z_axle_theta_ = arm_axle_head_x_*left_pull_*left_span_y_ - arm_axle_head_x_*right_pull_*right_span_y_
        - arm_axle_head_y_*left_pull_*left_span_x_ + arm_axle_head_y_*right_pull_*right_span_x_
        - l_axle_theta_slot_offset_*z_slot_offset_ - rhs_bump_*w_axle_theta_road_theta_
        + w_axle_theta_road_x_*z_foot_x_ + w_axle_theta_road_y_*z_foot_y_;

    /* backward substitution */
    const double acceleration_axle_theta_ = inverse_pivot_axle_theta_*z_axle_theta_;
    const double lambda_foot_x_ = acceleration_axle_theta_*w_axle_theta_road_x_ - inertia_road_x_*z_foot_x_ - z_road_x_;
    const double acceleration_road_x_ = -z_foot_x_;
    const double lambda_foot_y_ = acceleration_axle_theta_*w_axle_theta_road_y_ + acceleration_road_x_*w_road_x_road_y_
        - inertia_road_y_*z_foot_y_ - z_road_y_;
    const double acceleration_road_y_ = -z_foot_y_;
    const double lambda_bump_ = -acceleration_axle_theta_*w_axle_theta_road_theta_
        - acceleration_road_x_*w_road_x_road_theta_ - acceleration_road_y_*w_road_y_road_theta_
        - arm_road_head_x_*lambda_foot_y_ + arm_road_head_y_*lambda_foot_x_ - inertia_road_theta_*rhs_bump_
        + z_road_theta_;
    const double acceleration_road_theta_ = rhs_bump_;
    const double lambda_slot_offset_ = -acceleration_axle_theta_*l_axle_theta_slot_offset_
        - acceleration_road_theta_*l_road_theta_slot_offset_ - acceleration_road_x_*l_road_x_slot_offset_
        - acceleration_road_y_*l_road_y_slot_offset_ - inverse_pivot_slot_offset_*z_slot_offset_;
    const double acceleration_axle_y_ = p->inverse_axle_mass_*z_axle_y_ - l_slot_offset_axle_y_*lambda_slot_offset_;
    const double acceleration_axle_x_ = p->inverse_axle_mass_*z_axle_x_ - l_slot_offset_axle_x_*lambda_slot_offset_;

    /* results */
    a[0] = acceleration_axle_x_;
    a[1] = acceleration_axle_y_;
    a[2] = acceleration_axle_theta_;
    a[3] = acceleration_road_x_;
    a[4] = acceleration_road_y_;
    a[5] = acceleration_road_theta_;
    rhs->lambda[0] = lambda_foot_x_;
    rhs->lambda[1] = lambda_foot_y_;
    rhs->lambda[2] = lambda_slot_offset_;
    rhs->lambda[3] = lambda_bump_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = -left_pull_*left_span_x_ - right_pull_*right_span_x_;
        force[1] = -left_pull_*left_span_y_ - right_pull_*right_span_y_ + p->weight_axle_y_;
        force[2] = arm_axle_head_x_*left_pull_*left_span_y_ - arm_axle_head_x_*right_pull_*right_span_y_
            - arm_axle_head_y_*left_pull_*left_span_x_ + arm_axle_head_y_*right_pull_*right_span_x_;
        force[3] = right_pull_*right_span_x_;
        force[4] = right_pull_*right_span_y_ + p->weight_road_y_;
        force[5] = arm_road_head_x_*right_pull_*right_span_y_ - arm_road_head_y_*right_pull_*right_span_x_;
        gamma_stab[0] = rhs_foot_x_;
        gamma_stab[1] = rhs_foot_y_;
        gamma_stab[2] = rhs_slot_offset_;
        gamma_stab[3] = rhs_bump_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = -bump_rate_*rhs->lambda[3];
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
