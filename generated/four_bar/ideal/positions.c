/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double coupler_theta = q[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double motor_rate = p->omega;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;

    /* closures */
    const double phi_B_x = -p->B0_x + span_coupler_head_x + span_crank_head_x - span_rocker_head_x;
    const double phi_B_y = span_coupler_head_y + span_crank_head_y - span_rocker_head_y;

    /* groups of rows that are solved one after the other */
    const double determinant_B_x__B_y = -span_coupler_head_x*span_rocker_head_y
        + span_coupler_head_y*span_rocker_head_x;
    const double size_B_x__coupler_theta = fabs(span_coupler_head_x) + fabs(span_coupler_head_y);
    const double size_B_x__rocker_theta = fabs(span_rocker_head_x) + fabs(span_rocker_head_y);
    const double size_B_y__coupler_theta = fabs(span_coupler_head_x) + fabs(span_coupler_head_y);
    const double size_B_y__rocker_theta = fabs(span_rocker_head_x) + fabs(span_rocker_head_y);
    const double bound_B_x__B_y = size_B_x__coupler_theta*size_B_y__rocker_theta
        + size_B_x__rocker_theta*size_B_y__coupler_theta;
    if (!(fabs(determinant_B_x__B_y) > SINGULAR_SQUARE * bound_B_x__B_y))
        return 2;
    const double inverse_B_x__B_y = 1.0/determinant_B_x__B_y;

    /* Newton's step */
    const double step_coupler_theta = inverse_B_x__B_y*(-phi_B_x*span_rocker_head_x - phi_B_y*span_rocker_head_y);
    const double step_rocker_theta = inverse_B_x__B_y*(-phi_B_x*span_coupler_head_x - phi_B_y*span_coupler_head_y);

    /* rates */
    const double rate_rest_B_x = motor_rate*span_crank_head_y;
    const double rate_rest_B_y = -motor_rate*span_crank_head_x;
    const double rate_coupler_theta = inverse_B_x__B_y*(-rate_rest_B_x*span_rocker_head_x
        - rate_rest_B_y*span_rocker_head_y);
    const double rate_rocker_theta = inverse_B_x__B_y*(-rate_rest_B_x*span_coupler_head_x
        - rate_rest_B_y*span_coupler_head_y);

    /* results */
    step[0] = step_rocker_theta;
    rates[0] = rate_rocker_theta;
    step[1] = step_coupler_theta;
    rates[1] = rate_coupler_theta;
    *worst = max_of(0.0, fabs(phi_B_x));
    *worst = max_of(*worst, fabs(phi_B_y));
    return 0;
}

/*
 * Accelerations a of the tree's coordinates q with rates v, and with them the motion of all bodies:
 * all_q, all_v, all_a (N_Q). `worst`: the largest |Phi_q v - nu|.
 * Returns 0, or the number of a row that depends on others here; all_q and all_v are known also then.
 */
int arrive(const double t, const double *q, const double *v, const Parameters *p, double *a, double *all_q,
    double *all_v, double *all_a, double *worst)
{
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double rocker_omega = v[0];
    const double coupler_theta = q[1];
    const double coupler_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double span_rocker_com_x = cos_theta_rocker*p->rocker_head_s_x;
    const double span_rocker_com_y = p->rocker_head_s_x*sin_theta_rocker;
    const double rocker_x = p->B0_x + span_rocker_com_x;
    const double rocker_vx = -rocker_omega*span_rocker_com_y;
    const double rocker_vy = rocker_omega*span_rocker_com_x;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_coupler_com_x = cos_theta_coupler*p->coupler_head_s_x;
    const double span_coupler_com_y = p->coupler_head_s_x*sin_theta_coupler;
    const double coupler_x = span_coupler_com_x + span_crank_head_x;
    const double coupler_vx = -coupler_omega*span_coupler_com_y + crank_head_vx;
    const double coupler_y = span_coupler_com_y + span_crank_head_y;
    const double coupler_vy = coupler_omega*span_coupler_com_x + crank_head_vy;
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;

    /* positions and velocities of the bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = coupler_x;
    all_v[3] = coupler_vx;
    all_q[4] = coupler_y;
    all_v[4] = coupler_vy;
    all_q[5] = coupler_theta;
    all_v[5] = coupler_omega;
    all_q[6] = rocker_x;
    all_v[6] = rocker_vx;
    all_q[7] = span_rocker_com_y;
    all_v[7] = rocker_vy;
    all_q[8] = rocker_theta;
    all_v[8] = rocker_omega;

    /* rates of the closures */
    const double phi_dot_B_x = -coupler_omega*span_coupler_head_y - motor_rate*span_crank_head_y
        + rocker_omega*span_rocker_head_y;
    const double phi_dot_B_y = coupler_omega*span_coupler_head_x + motor_rate*span_crank_head_x
        - rocker_omega*span_rocker_head_x;
    *worst = max_of(0.0, fabs(phi_dot_B_x));
    *worst = max_of(*worst, fabs(phi_dot_B_y));

    /* groups of rows that are solved one after the other */
    const double determinant_B_x__B_y = -span_coupler_head_x*span_rocker_head_y
        + span_coupler_head_y*span_rocker_head_x;
    const double size_B_x__coupler_theta = fabs(span_coupler_head_x) + fabs(span_coupler_head_y);
    const double size_B_x__rocker_theta = fabs(span_rocker_head_x) + fabs(span_rocker_head_y);
    const double size_B_y__coupler_theta = fabs(span_coupler_head_x) + fabs(span_coupler_head_y);
    const double size_B_y__rocker_theta = fabs(span_rocker_head_x) + fabs(span_rocker_head_y);
    const double bound_B_x__B_y = size_B_x__coupler_theta*size_B_y__rocker_theta
        + size_B_x__rocker_theta*size_B_y__coupler_theta;
    if (!(fabs(determinant_B_x__B_y) > SINGULAR_SQUARE * bound_B_x__B_y))
        return 2;
    const double inverse_B_x__B_y = 1.0/determinant_B_x__B_y;

    /* accelerations */
    const double second_rest_B_x = (coupler_omega * coupler_omega)*span_coupler_head_x
        + motor_acceleration*span_crank_head_y + (motor_rate * motor_rate)*span_crank_head_x
        - (rocker_omega * rocker_omega)*span_rocker_head_x;
    const double second_rest_B_y = (coupler_omega * coupler_omega)*span_coupler_head_y
        - motor_acceleration*span_crank_head_x + (motor_rate * motor_rate)*span_crank_head_y
        - (rocker_omega * rocker_omega)*span_rocker_head_y;
    const double second_coupler_theta = inverse_B_x__B_y*(-second_rest_B_x*span_rocker_head_x
        - second_rest_B_y*span_rocker_head_y);
    const double second_rocker_theta = inverse_B_x__B_y*(-second_rest_B_x*span_coupler_head_x
        - second_rest_B_y*span_coupler_head_y);
    a[0] = second_rocker_theta;
    a[1] = second_coupler_theta;
    all_a[0] = -motor_acceleration*span_crank_com_y - (motor_rate * motor_rate)*span_crank_com_x;
    all_a[1] = motor_acceleration*span_crank_com_x - (motor_rate * motor_rate)*span_crank_com_y;
    all_a[2] = motor_acceleration;
    all_a[3] = -(coupler_omega * coupler_omega)*span_coupler_com_x - motor_acceleration*span_crank_head_y
        - (motor_rate * motor_rate)*span_crank_head_x - second_coupler_theta*span_coupler_com_y;
    all_a[4] = -(coupler_omega * coupler_omega)*span_coupler_com_y + motor_acceleration*span_crank_head_x
        - (motor_rate * motor_rate)*span_crank_head_y + second_coupler_theta*span_coupler_com_x;
    all_a[5] = second_coupler_theta;
    all_a[6] = -(rocker_omega * rocker_omega)*span_rocker_com_x - second_rocker_theta*span_rocker_com_y;
    all_a[7] = -(rocker_omega * rocker_omega)*span_rocker_com_y + second_rocker_theta*span_rocker_com_x;
    all_a[8] = second_rocker_theta;
    return 0;
}
