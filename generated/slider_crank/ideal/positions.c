/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double rod_theta_ = q[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double motor_rate_ = p->omega_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;

    /* closures */
    const double phi_cylinder_offset_ = span_crank_head_y_ + span_rod_head_y_;

    /* blocks of constraint equations that are solved one after the other */
    const double pivot_cylinder_offset_ = span_rod_head_x_;
    const double size_cylinder_offset_rod_theta_ = fabs(span_rod_head_x_) + fabs(span_rod_head_y_);
    if (!(fabs(pivot_cylinder_offset_) > SINGULAR_SQUARE * size_cylinder_offset_rod_theta_))
        return 1;
    const double inverse_cylinder_offset_ = 1.0/pivot_cylinder_offset_;

    /* Newton's step */
    const double step_rod_theta_ = inverse_cylinder_offset_*phi_cylinder_offset_;

    /* rates */
    const double rate_rod_theta_ = -inverse_cylinder_offset_*motor_rate_*span_crank_head_x_;

    /* results */
    step[0] = step_rod_theta_;
    rates[0] = rate_rod_theta_;
    *worst = max_of(0.0, fabs(phi_cylinder_offset_));
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
    const double rod_theta_ = q[0];
    const double rod_omega_ = v[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_com_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double span_crank_com_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double crank_vx_ = -motor_rate_*span_crank_com_y_;
    const double crank_vy_ = motor_rate_*span_crank_com_x_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const double crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double span_rod_com_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double rod_x_ = span_crank_head_x_ + span_rod_com_x_;
    const double rod_vx_ = crank_head_vx_ - rod_omega_*span_rod_com_y_;
    const double rod_y_ = span_crank_head_y_ + span_rod_com_y_;
    const double rod_vy_ = crank_head_vy_ + rod_omega_*span_rod_com_x_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const double rod_head_x_ = span_crank_head_x_ + span_rod_head_x_;
    const double rod_head_vx_ = crank_head_vx_ - rod_omega_*span_rod_head_y_;
    const double rod_head_y_ = span_crank_head_y_ + span_rod_head_y_;
    const double rod_head_vy_ = crank_head_vy_ + rod_omega_*span_rod_head_x_;
    const double slider_theta_ = 0.0;
    const double slider_omega_ = 0.0;

    /* positions and velocities of the bodies */
    all_q[0] = span_crank_com_x_;
    all_v[0] = crank_vx_;
    all_q[1] = span_crank_com_y_;
    all_v[1] = crank_vy_;
    all_q[2] = motor_value_;
    all_v[2] = motor_rate_;
    all_q[3] = rod_x_;
    all_v[3] = rod_vx_;
    all_q[4] = rod_y_;
    all_v[4] = rod_vy_;
    all_q[5] = rod_theta_;
    all_v[5] = rod_omega_;
    all_q[6] = rod_head_x_;
    all_v[6] = rod_head_vx_;
    all_q[7] = rod_head_y_;
    all_v[7] = rod_head_vy_;
    all_q[8] = slider_theta_;
    all_v[8] = slider_omega_;

    /* rates of the closures */
    const double phi_dot_cylinder_offset_ = motor_rate_*span_crank_head_x_ + rod_omega_*span_rod_head_x_;
    *worst = max_of(0.0, fabs(phi_dot_cylinder_offset_));

    /* blocks of constraint equations that are solved one after the other */
    const double pivot_cylinder_offset_ = span_rod_head_x_;
    const double size_cylinder_offset_rod_theta_ = fabs(span_rod_head_x_) + fabs(span_rod_head_y_);
    if (!(fabs(pivot_cylinder_offset_) > SINGULAR_SQUARE * size_cylinder_offset_rod_theta_))
        return 1;
    const double inverse_cylinder_offset_ = 1.0/pivot_cylinder_offset_;

    /* accelerations */
    const double second_rod_theta_ = inverse_cylinder_offset_*(-motor_acceleration_*span_crank_head_x_
        + (motor_rate_ * motor_rate_)*span_crank_head_y_ + (rod_omega_ * rod_omega_)*span_rod_head_y_);
    a[0] = second_rod_theta_;
    all_a[0] = -motor_acceleration_*span_crank_com_y_ - (motor_rate_ * motor_rate_)*span_crank_com_x_;
    all_a[1] = motor_acceleration_*span_crank_com_x_ - (motor_rate_ * motor_rate_)*span_crank_com_y_;
    all_a[2] = motor_acceleration_;
    all_a[3] = -motor_acceleration_*span_crank_head_y_ - (motor_rate_ * motor_rate_)*span_crank_head_x_
        - (rod_omega_ * rod_omega_)*span_rod_com_x_ - second_rod_theta_*span_rod_com_y_;
    all_a[4] = motor_acceleration_*span_crank_head_x_ - (motor_rate_ * motor_rate_)*span_crank_head_y_
        - (rod_omega_ * rod_omega_)*span_rod_com_y_ + second_rod_theta_*span_rod_com_x_;
    all_a[5] = second_rod_theta_;
    all_a[6] = -motor_acceleration_*span_crank_head_y_ - (motor_rate_ * motor_rate_)*span_crank_head_x_
        - (rod_omega_ * rod_omega_)*span_rod_head_x_ - second_rod_theta_*span_rod_head_y_;
    all_a[7] = motor_acceleration_*span_crank_head_x_ - (motor_rate_ * motor_rate_)*span_crank_head_y_
        - (rod_omega_ * rod_omega_)*span_rod_head_y_ + second_rod_theta_*span_rod_head_x_;
    all_a[8] = 0.0;
    return 0;
}
