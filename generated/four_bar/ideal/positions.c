/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double rocker_theta_ = q[0];
    const double coupler_theta_ = q[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double motor_rate_ = p->omega_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;

    /* closures */
    const double phi_B_x_ = -p->B0_x_ + span_coupler_head_x_ + span_crank_head_x_ - span_rocker_head_x_;
    const double phi_B_y_ = span_coupler_head_y_ + span_crank_head_y_ - span_rocker_head_y_;

    /* blocks of constraint equations that are solved one after the other */
    const double determinant_B_x_B_y_ = -span_coupler_head_x_*span_rocker_head_y_
        + span_coupler_head_y_*span_rocker_head_x_;
    const double size_B_x_coupler_theta_ = fabs(span_coupler_head_x_) + fabs(span_coupler_head_y_);
    const double size_B_x_rocker_theta_ = fabs(span_rocker_head_x_) + fabs(span_rocker_head_y_);
    const double size_B_y_coupler_theta_ = fabs(span_coupler_head_x_) + fabs(span_coupler_head_y_);
    const double size_B_y_rocker_theta_ = fabs(span_rocker_head_x_) + fabs(span_rocker_head_y_);
    const double bound_B_x_B_y_ = size_B_x_coupler_theta_*size_B_y_rocker_theta_
        + size_B_x_rocker_theta_*size_B_y_coupler_theta_;
    if (!(fabs(determinant_B_x_B_y_) > SINGULAR_SQUARE * bound_B_x_B_y_))
        return 2;
    const double inverse_B_x_B_y_ = 1.0/determinant_B_x_B_y_;

    /* Newton's step */
    const double step_coupler_theta_ = inverse_B_x_B_y_*(-phi_B_x_*span_rocker_head_x_ - phi_B_y_*span_rocker_head_y_);
    const double step_rocker_theta_ = inverse_B_x_B_y_*(-phi_B_x_*span_coupler_head_x_ - phi_B_y_*span_coupler_head_y_);

    /* rates */
    const double rate_rest_B_x_ = motor_rate_*span_crank_head_y_;
    const double rate_rest_B_y_ = -motor_rate_*span_crank_head_x_;
    const double rate_coupler_theta_ = inverse_B_x_B_y_*(-rate_rest_B_x_*span_rocker_head_x_
        - rate_rest_B_y_*span_rocker_head_y_);
    const double rate_rocker_theta_ = inverse_B_x_B_y_*(-rate_rest_B_x_*span_coupler_head_x_
        - rate_rest_B_y_*span_coupler_head_y_);

    /* results */
    step[0] = step_rocker_theta_;
    rates[0] = rate_rocker_theta_;
    step[1] = step_coupler_theta_;
    rates[1] = rate_coupler_theta_;
    *worst = max_of(0.0, fabs(phi_B_x_));
    *worst = max_of(*worst, fabs(phi_B_y_));
    return 0;
}

/*
 * Accelerations a of the tree's coordinates q with rates v, and with them the motion of all bodies:
 * all_q, all_v, all_a (N_Q). `worst`: the largest |Phi_q v - nu|.
 * Returns 0, or the number of a row that depends on others here; all_q and all_v are written also then.
 */
int compute_body_motion(const double t, const double *q, const double *v, const Parameters *p, double *a, double *all_q,
    double *all_v, double *all_a, double *worst)
{
    /* coordinates, velocities, time */
    const double rocker_theta_ = q[0];
    const double rocker_omega_ = v[0];
    const double coupler_theta_ = q[1];
    const double coupler_omega_ = v[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_com_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double span_crank_com_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double crank_vx_ = -motor_rate_*span_crank_com_y_;
    const double crank_vy_ = motor_rate_*span_crank_com_x_;
    const double span_rocker_com_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double span_rocker_com_y_ = p->rocker_head_s_x_*sin_theta_rocker_;
    const double rocker_x_ = p->B0_x_ + span_rocker_com_x_;
    const double rocker_vx_ = -rocker_omega_*span_rocker_com_y_;
    const double rocker_vy_ = rocker_omega_*span_rocker_com_x_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const double crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const double span_coupler_com_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double span_coupler_com_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double coupler_x_ = span_coupler_com_x_ + span_crank_head_x_;
    const double coupler_vx_ = -coupler_omega_*span_coupler_com_y_ + crank_head_vx_;
    const double coupler_y_ = span_coupler_com_y_ + span_crank_head_y_;
    const double coupler_vy_ = coupler_omega_*span_coupler_com_x_ + crank_head_vy_;
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;

    /* positions and velocities of the bodies */
    all_q[0] = span_crank_com_x_;
    all_v[0] = crank_vx_;
    all_q[1] = span_crank_com_y_;
    all_v[1] = crank_vy_;
    all_q[2] = motor_value_;
    all_v[2] = motor_rate_;
    all_q[3] = coupler_x_;
    all_v[3] = coupler_vx_;
    all_q[4] = coupler_y_;
    all_v[4] = coupler_vy_;
    all_q[5] = coupler_theta_;
    all_v[5] = coupler_omega_;
    all_q[6] = rocker_x_;
    all_v[6] = rocker_vx_;
    all_q[7] = span_rocker_com_y_;
    all_v[7] = rocker_vy_;
    all_q[8] = rocker_theta_;
    all_v[8] = rocker_omega_;

    /* rates of the closures */
    const double phi_dot_B_x_ = -coupler_omega_*span_coupler_head_y_ - motor_rate_*span_crank_head_y_
        + rocker_omega_*span_rocker_head_y_;
    const double phi_dot_B_y_ = coupler_omega_*span_coupler_head_x_ + motor_rate_*span_crank_head_x_
        - rocker_omega_*span_rocker_head_x_;
    *worst = max_of(0.0, fabs(phi_dot_B_x_));
    *worst = max_of(*worst, fabs(phi_dot_B_y_));

    /* blocks of constraint equations that are solved one after the other */
    const double determinant_B_x_B_y_ = -span_coupler_head_x_*span_rocker_head_y_
        + span_coupler_head_y_*span_rocker_head_x_;
    const double size_B_x_coupler_theta_ = fabs(span_coupler_head_x_) + fabs(span_coupler_head_y_);
    const double size_B_x_rocker_theta_ = fabs(span_rocker_head_x_) + fabs(span_rocker_head_y_);
    const double size_B_y_coupler_theta_ = fabs(span_coupler_head_x_) + fabs(span_coupler_head_y_);
    const double size_B_y_rocker_theta_ = fabs(span_rocker_head_x_) + fabs(span_rocker_head_y_);
    const double bound_B_x_B_y_ = size_B_x_coupler_theta_*size_B_y_rocker_theta_
        + size_B_x_rocker_theta_*size_B_y_coupler_theta_;
    if (!(fabs(determinant_B_x_B_y_) > SINGULAR_SQUARE * bound_B_x_B_y_))
        return 2;
    const double inverse_B_x_B_y_ = 1.0/determinant_B_x_B_y_;

    /* accelerations */
    const double second_rest_B_x_ = (coupler_omega_ * coupler_omega_)*span_coupler_head_x_
        + motor_acceleration_*span_crank_head_y_ + (motor_rate_ * motor_rate_)*span_crank_head_x_
        - (rocker_omega_ * rocker_omega_)*span_rocker_head_x_;
    const double second_rest_B_y_ = (coupler_omega_ * coupler_omega_)*span_coupler_head_y_
        - motor_acceleration_*span_crank_head_x_ + (motor_rate_ * motor_rate_)*span_crank_head_y_
        - (rocker_omega_ * rocker_omega_)*span_rocker_head_y_;
    const double second_coupler_theta_ = inverse_B_x_B_y_*(-second_rest_B_x_*span_rocker_head_x_
        - second_rest_B_y_*span_rocker_head_y_);
    const double second_rocker_theta_ = inverse_B_x_B_y_*(-second_rest_B_x_*span_coupler_head_x_
        - second_rest_B_y_*span_coupler_head_y_);
    a[0] = second_rocker_theta_;
    a[1] = second_coupler_theta_;
    all_a[0] = -motor_acceleration_*span_crank_com_y_ - (motor_rate_ * motor_rate_)*span_crank_com_x_;
    all_a[1] = motor_acceleration_*span_crank_com_x_ - (motor_rate_ * motor_rate_)*span_crank_com_y_;
    all_a[2] = motor_acceleration_;
    all_a[3] = -(coupler_omega_ * coupler_omega_)*span_coupler_com_x_ - motor_acceleration_*span_crank_head_y_
        - (motor_rate_ * motor_rate_)*span_crank_head_x_ - second_coupler_theta_*span_coupler_com_y_;
    all_a[4] = -(coupler_omega_ * coupler_omega_)*span_coupler_com_y_ + motor_acceleration_*span_crank_head_x_
        - (motor_rate_ * motor_rate_)*span_crank_head_y_ + second_coupler_theta_*span_coupler_com_x_;
    all_a[5] = second_coupler_theta_;
    all_a[6] = -(rocker_omega_ * rocker_omega_)*span_rocker_com_x_ - second_rocker_theta_*span_rocker_com_y_;
    all_a[7] = -(rocker_omega_ * rocker_omega_)*span_rocker_com_y_ + second_rocker_theta_*span_rocker_com_x_;
    all_a[8] = second_rocker_theta_;
    return 0;
}
