/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double rod_theta = q[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;

    /* closures */
    const double phi_cylinder_offset = span_crank_head_y + span_rod_head_y;

    /* groups of rows that are solved one after the other */
    const double pivot_cylinder_offset = span_rod_head_x;
    const double size_cylinder_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_cylinder_offset) > SINGULAR_SQUARE * size_cylinder_offset__rod_theta))
        return 1;
    const double inverse_cylinder_offset = 1.0/pivot_cylinder_offset;

    /* Newton's step */
    const double step_rod_theta = inverse_cylinder_offset*phi_cylinder_offset;

    /* rates */
    const double rate_rod_theta = -inverse_cylinder_offset*motor_rate*span_crank_head_x;

    /* results */
    step[0] = step_rod_theta;
    rates[0] = rate_rod_theta;
    *worst = max_of(0.0, fabs(phi_cylinder_offset));
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
    const double rod_theta = q[0];
    const double rod_omega = v[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_head_s_x;
    const double span_rod_com_y = p->rod_head_s_x*sin_theta_rod;
    const double rod_x = span_crank_head_x + span_rod_com_x;
    const double rod_vx = crank_head_vx - rod_omega*span_rod_com_y;
    const double rod_y = span_crank_head_y + span_rod_com_y;
    const double rod_vy = crank_head_vy + rod_omega*span_rod_com_x;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const double rod_head_x = span_crank_head_x + span_rod_head_x;
    const double rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const double rod_head_y = span_crank_head_y + span_rod_head_y;
    const double rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const double slider_theta = 0.0;
    const double slider_omega = 0.0;

    /* positions and velocities of the bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = rod_x;
    all_v[3] = rod_vx;
    all_q[4] = rod_y;
    all_v[4] = rod_vy;
    all_q[5] = rod_theta;
    all_v[5] = rod_omega;
    all_q[6] = rod_head_x;
    all_v[6] = rod_head_vx;
    all_q[7] = rod_head_y;
    all_v[7] = rod_head_vy;
    all_q[8] = slider_theta;
    all_v[8] = slider_omega;

    /* rates of the closures */
    const double phi_dot_cylinder_offset = motor_rate*span_crank_head_x + rod_omega*span_rod_head_x;
    *worst = max_of(0.0, fabs(phi_dot_cylinder_offset));

    /* groups of rows that are solved one after the other */
    const double pivot_cylinder_offset = span_rod_head_x;
    const double size_cylinder_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_cylinder_offset) > SINGULAR_SQUARE * size_cylinder_offset__rod_theta))
        return 1;
    const double inverse_cylinder_offset = 1.0/pivot_cylinder_offset;

    /* accelerations */
    const double second_rod_theta = inverse_cylinder_offset*(-motor_acceleration*span_crank_head_x
        + (motor_rate * motor_rate)*span_crank_head_y + (rod_omega * rod_omega)*span_rod_head_y);
    a[0] = second_rod_theta;
    all_a[0] = -motor_acceleration*span_crank_com_y - (motor_rate * motor_rate)*span_crank_com_x;
    all_a[1] = motor_acceleration*span_crank_com_x - (motor_rate * motor_rate)*span_crank_com_y;
    all_a[2] = motor_acceleration;
    all_a[3] = -motor_acceleration*span_crank_head_y - (motor_rate * motor_rate)*span_crank_head_x
        - (rod_omega * rod_omega)*span_rod_com_x - second_rod_theta*span_rod_com_y;
    all_a[4] = motor_acceleration*span_crank_head_x - (motor_rate * motor_rate)*span_crank_head_y
        - (rod_omega * rod_omega)*span_rod_com_y + second_rod_theta*span_rod_com_x;
    all_a[5] = second_rod_theta;
    all_a[6] = -motor_acceleration*span_crank_head_y - (motor_rate * motor_rate)*span_crank_head_x
        - (rod_omega * rod_omega)*span_rod_head_x - second_rod_theta*span_rod_head_y;
    all_a[7] = motor_acceleration*span_crank_head_x - (motor_rate * motor_rate)*span_crank_head_y
        - (rod_omega * rod_omega)*span_rod_head_y + second_rod_theta*span_rod_head_x;
    all_a[8] = 0.0;
    return 0;
}
