/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L2_theta = q[1];
    const double L3_theta = q[2];
    const double L7_theta = q[3];
    const double L8_theta = q[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double cos_theta_L8 = cosines_1[2];
    const double sin_theta_L8 = sines_1[2];
    const double crank1_rate = p->omega;
    const double crank4_rate = p->omega4;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;

    /* closures */
    const double phi_guide_offset = -span_L6_head_x - span_L8_head_x;
    const double phi_L2_head_L3_head_x = span_L1_head_x + span_L2_head_x - span_L3_head_x - span_L4_head_x;
    const double phi_L2_head_L3_head_y = -p->O4_y + span_L1_head_y + span_L2_head_y - span_L3_head_y - span_L4_head_y;
    const double phi_P2_x = -p->O6_x + span_L1_head_x + span_L2_head_x - span_L6_head_x - span_L7_tail_x;
    const double phi_P2_y = span_L1_head_y + span_L2_head_y - span_L6_head_y - span_L7_tail_y;

    /* groups of rows that are solved one after the other */
    const double determinant_L2_head_L3_head_x__L2_head_L3_head_y = span_L2_head_x*span_L3_head_y
        - span_L2_head_y*span_L3_head_x;
    const double size_L2_head_L3_head_x__L3_theta = fabs(span_L3_head_x) + fabs(span_L3_head_y);
    const double size_L2_head_L3_head_x__L2_theta = fabs(span_L2_head_x) + fabs(span_L2_head_y);
    const double size_L2_head_L3_head_y__L3_theta = fabs(span_L3_head_x) + fabs(span_L3_head_y);
    const double size_L2_head_L3_head_y__L2_theta = fabs(span_L2_head_x) + fabs(span_L2_head_y);
    const double bound_L2_head_L3_head_x__L2_head_L3_head_y =
        size_L2_head_L3_head_x__L2_theta*size_L2_head_L3_head_y__L3_theta
        + size_L2_head_L3_head_x__L3_theta*size_L2_head_L3_head_y__L2_theta;
    if (!(fabs(determinant_L2_head_L3_head_x__L2_head_L3_head_y) > SINGULAR_SQUARE
        * bound_L2_head_L3_head_x__L2_head_L3_head_y))
        return 3;
    const double inverse_L2_head_L3_head_x__L2_head_L3_head_y = 1.0/determinant_L2_head_L3_head_x__L2_head_L3_head_y;
    const double determinant_P2_x__P2_y = -span_L6_head_x*span_L7_tail_y + span_L6_head_y*span_L7_tail_x;
    const double size_P2_x__L7_theta = fabs(span_L7_tail_x) + fabs(span_L7_tail_y);
    const double size_P2_x__L6_theta = fabs(span_L6_head_x) + fabs(span_L6_head_y);
    const double size_P2_y__L7_theta = fabs(span_L7_tail_x) + fabs(span_L7_tail_y);
    const double size_P2_y__L6_theta = fabs(span_L6_head_x) + fabs(span_L6_head_y);
    const double bound_P2_x__P2_y = size_P2_x__L6_theta*size_P2_y__L7_theta + size_P2_x__L7_theta*size_P2_y__L6_theta;
    if (!(fabs(determinant_P2_x__P2_y) > SINGULAR_SQUARE * bound_P2_x__P2_y))
        return 5;
    const double inverse_P2_x__P2_y = 1.0/determinant_P2_x__P2_y;
    const double pivot_guide_offset = span_L8_head_y;
    const double size_guide_offset__L8_theta = fabs(span_L8_head_x) + fabs(span_L8_head_y);
    if (!(fabs(pivot_guide_offset) > SINGULAR_SQUARE * size_guide_offset__L8_theta))
        return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* Newton's step */
    const double step_L3_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y*(phi_L2_head_L3_head_x*span_L2_head_x
        + phi_L2_head_L3_head_y*span_L2_head_y);
    const double step_L2_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y*(phi_L2_head_L3_head_x*span_L3_head_x
        + phi_L2_head_L3_head_y*span_L3_head_y);
    const double step_rest_P2_x = phi_P2_x + span_L2_head_y*step_L2_theta;
    const double step_rest_P2_y = phi_P2_y - span_L2_head_x*step_L2_theta;
    const double step_L7_theta = inverse_P2_x__P2_y*(-span_L6_head_x*step_rest_P2_x - span_L6_head_y*step_rest_P2_y);
    const double step_L6_theta = inverse_P2_x__P2_y*(span_L7_tail_x*step_rest_P2_x + span_L7_tail_y*step_rest_P2_y);
    const double step_L8_theta = inverse_guide_offset*(phi_guide_offset - span_L6_head_y*step_L6_theta);

    /* rates */
    const double rate_rest_L2_head_L3_head_x = crank1_rate*span_L1_head_y - crank4_rate*span_L4_head_y;
    const double rate_rest_L2_head_L3_head_y = -crank1_rate*span_L1_head_x + crank4_rate*span_L4_head_x;
    const double rate_L3_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y
        *(rate_rest_L2_head_L3_head_x*span_L2_head_x + rate_rest_L2_head_L3_head_y*span_L2_head_y);
    const double rate_L2_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y
        *(rate_rest_L2_head_L3_head_x*span_L3_head_x + rate_rest_L2_head_L3_head_y*span_L3_head_y);
    const double rate_rest_P2_x = crank1_rate*span_L1_head_y + rate_L2_theta*span_L2_head_y;
    const double rate_rest_P2_y = -crank1_rate*span_L1_head_x - rate_L2_theta*span_L2_head_x;
    const double rate_L7_theta = inverse_P2_x__P2_y*(-rate_rest_P2_x*span_L6_head_x - rate_rest_P2_y*span_L6_head_y);
    const double rate_L6_theta = inverse_P2_x__P2_y*(rate_rest_P2_x*span_L7_tail_x + rate_rest_P2_y*span_L7_tail_y);
    const double rate_L8_theta = -inverse_guide_offset*rate_L6_theta*span_L6_head_y;

    /* results */
    step[0] = step_L6_theta;
    rates[0] = rate_L6_theta;
    step[1] = step_L2_theta;
    rates[1] = rate_L2_theta;
    step[2] = step_L3_theta;
    rates[2] = rate_L3_theta;
    step[3] = step_L7_theta;
    rates[3] = rate_L7_theta;
    step[4] = step_L8_theta;
    rates[4] = rate_L8_theta;
    *worst = max_of(0.0, fabs(phi_guide_offset));
    *worst = max_of(*worst, fabs(phi_L2_head_L3_head_x));
    *worst = max_of(*worst, fabs(phi_L2_head_L3_head_y));
    *worst = max_of(*worst, fabs(phi_P2_x));
    *worst = max_of(*worst, fabs(phi_P2_y));
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
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L2_theta = q[1];
    const double L2_omega = v[1];
    const double L3_theta = q[2];
    const double L3_omega = v[2];
    const double L7_theta = q[3];
    const double L7_omega = v[3];
    const double L8_theta = q[4];
    const double L8_omega = v[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double cos_theta_L8 = cosines_1[2];
    const double sin_theta_L8 = sines_1[2];
    const double crank1_rate = p->omega;
    const double crank1_acceleration = 0.0;
    const double crank4_rate = p->omega4;
    const double crank4_acceleration = 0.0;
    const double span_L1_com_x = p->L1_head_s_x*cos_theta_L1;
    const double span_L1_com_y = p->L1_head_s_x*sin_theta_L1;
    const double L1_vx = -crank1_rate*span_L1_com_y;
    const double L1_vy = crank1_rate*span_L1_com_x;
    const double span_L4_com_x = p->L4_head_s_x*cos_theta_L4;
    const double span_L4_com_y = p->L4_head_s_x*sin_theta_L4;
    const double L4_vx = -crank4_rate*span_L4_com_y;
    const double L4_y = p->O4_y + span_L4_com_y;
    const double L4_vy = crank4_rate*span_L4_com_x;
    const double span_L6_com_x = p->L6_head_s_x*cos_theta_L6;
    const double span_L6_com_y = p->L6_head_s_x*sin_theta_L6;
    const double L6_x = p->O6_x + span_L6_com_x;
    const double L6_vx = -L6_omega*span_L6_com_y;
    const double L6_vy = L6_omega*span_L6_com_x;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double L1_head_vx = -crank1_rate*span_L1_head_y;
    const double L1_head_vy = crank1_rate*span_L1_head_x;
    const double span_L2_com_x = p->L2_head_s_x*cos_theta_L2;
    const double span_L2_com_y = p->L2_head_s_x*sin_theta_L2;
    const double L2_x = span_L1_head_x + span_L2_com_x;
    const double L2_vx = L1_head_vx - L2_omega*span_L2_com_y;
    const double L2_y = span_L1_head_y + span_L2_com_y;
    const double L2_vy = L1_head_vy + L2_omega*span_L2_com_x;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double L4_head_vx = -crank4_rate*span_L4_head_y;
    const double L4_head_y = p->O4_y + span_L4_head_y;
    const double L4_head_vy = crank4_rate*span_L4_head_x;
    const double span_L3_com_x = p->L3_head_s_x*cos_theta_L3;
    const double span_L3_com_y = p->L3_head_s_x*sin_theta_L3;
    const double L3_x = span_L3_com_x + span_L4_head_x;
    const double L3_vx = -L3_omega*span_L3_com_y + L4_head_vx;
    const double L3_y = L4_head_y + span_L3_com_y;
    const double L3_vy = L3_omega*span_L3_com_x + L4_head_vy;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double L6_head_x = p->O6_x + span_L6_head_x;
    const double L6_head_vx = -L6_omega*span_L6_head_y;
    const double L6_head_vy = L6_omega*span_L6_head_x;
    const double span_L7_com_x = p->L7_com_span_x*cos_theta_L7;
    const double span_L7_com_y = p->L7_com_span_x*sin_theta_L7;
    const double L7_x = L6_head_x + span_L7_com_x;
    const double L7_vx = L6_head_vx - L7_omega*span_L7_com_y;
    const double L7_y = span_L6_head_y + span_L7_com_y;
    const double L7_vy = L6_head_vy + L7_omega*span_L7_com_x;
    const double span_L8_com_x = p->L8_head_s_x*cos_theta_L8;
    const double span_L8_com_y = p->L8_head_s_x*sin_theta_L8;
    const double L8_x = L6_head_x + span_L8_com_x;
    const double L8_vx = L6_head_vx - L8_omega*span_L8_com_y;
    const double L8_y = span_L6_head_y + span_L8_com_y;
    const double L8_vy = L6_head_vy + L8_omega*span_L8_com_x;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double L8_head_x = L6_head_x + span_L8_head_x;
    const double L8_head_vx = L6_head_vx - L8_omega*span_L8_head_y;
    const double L8_head_y = span_L6_head_y + span_L8_head_y;
    const double L8_head_vy = L6_head_vy + L8_omega*span_L8_head_x;
    const double S9_theta = PI/2.0;
    const double S9_omega = 0.0;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;

    /* positions and velocities of the bodies */
    all_q[0] = span_L1_com_x;
    all_v[0] = L1_vx;
    all_q[1] = span_L1_com_y;
    all_v[1] = L1_vy;
    all_q[2] = crank1_value;
    all_v[2] = crank1_rate;
    all_q[3] = L2_x;
    all_v[3] = L2_vx;
    all_q[4] = L2_y;
    all_v[4] = L2_vy;
    all_q[5] = L2_theta;
    all_v[5] = L2_omega;
    all_q[6] = L3_x;
    all_v[6] = L3_vx;
    all_q[7] = L3_y;
    all_v[7] = L3_vy;
    all_q[8] = L3_theta;
    all_v[8] = L3_omega;
    all_q[9] = span_L4_com_x;
    all_v[9] = L4_vx;
    all_q[10] = L4_y;
    all_v[10] = L4_vy;
    all_q[11] = crank4_value;
    all_v[11] = crank4_rate;
    all_q[12] = L6_x;
    all_v[12] = L6_vx;
    all_q[13] = span_L6_com_y;
    all_v[13] = L6_vy;
    all_q[14] = L6_theta;
    all_v[14] = L6_omega;
    all_q[15] = L7_x;
    all_v[15] = L7_vx;
    all_q[16] = L7_y;
    all_v[16] = L7_vy;
    all_q[17] = L7_theta;
    all_v[17] = L7_omega;
    all_q[18] = L8_x;
    all_v[18] = L8_vx;
    all_q[19] = L8_y;
    all_v[19] = L8_vy;
    all_q[20] = L8_theta;
    all_v[20] = L8_omega;
    all_q[21] = L8_head_x;
    all_v[21] = L8_head_vx;
    all_q[22] = L8_head_y;
    all_v[22] = L8_head_vy;
    all_q[23] = S9_theta;
    all_v[23] = S9_omega;

    /* rates of the closures */
    const double phi_dot_guide_offset = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;
    const double phi_dot_L2_head_L3_head_x = -L2_omega*span_L2_head_y + L3_omega*span_L3_head_y
        - crank1_rate*span_L1_head_y + crank4_rate*span_L4_head_y;
    const double phi_dot_L2_head_L3_head_y = L2_omega*span_L2_head_x - L3_omega*span_L3_head_x
        + crank1_rate*span_L1_head_x - crank4_rate*span_L4_head_x;
    const double phi_dot_P2_x = -L2_omega*span_L2_head_y + L6_omega*span_L6_head_y + L7_omega*span_L7_tail_y
        - crank1_rate*span_L1_head_y;
    const double phi_dot_P2_y = L2_omega*span_L2_head_x - L6_omega*span_L6_head_x - L7_omega*span_L7_tail_x
        + crank1_rate*span_L1_head_x;
    *worst = max_of(0.0, fabs(phi_dot_guide_offset));
    *worst = max_of(*worst, fabs(phi_dot_L2_head_L3_head_x));
    *worst = max_of(*worst, fabs(phi_dot_L2_head_L3_head_y));
    *worst = max_of(*worst, fabs(phi_dot_P2_x));
    *worst = max_of(*worst, fabs(phi_dot_P2_y));

    /* groups of rows that are solved one after the other */
    const double determinant_L2_head_L3_head_x__L2_head_L3_head_y = span_L2_head_x*span_L3_head_y
        - span_L2_head_y*span_L3_head_x;
    const double size_L2_head_L3_head_x__L3_theta = fabs(span_L3_head_x) + fabs(span_L3_head_y);
    const double size_L2_head_L3_head_x__L2_theta = fabs(span_L2_head_x) + fabs(span_L2_head_y);
    const double size_L2_head_L3_head_y__L3_theta = fabs(span_L3_head_x) + fabs(span_L3_head_y);
    const double size_L2_head_L3_head_y__L2_theta = fabs(span_L2_head_x) + fabs(span_L2_head_y);
    const double bound_L2_head_L3_head_x__L2_head_L3_head_y =
        size_L2_head_L3_head_x__L2_theta*size_L2_head_L3_head_y__L3_theta
        + size_L2_head_L3_head_x__L3_theta*size_L2_head_L3_head_y__L2_theta;
    if (!(fabs(determinant_L2_head_L3_head_x__L2_head_L3_head_y) > SINGULAR_SQUARE
        * bound_L2_head_L3_head_x__L2_head_L3_head_y))
        return 3;
    const double inverse_L2_head_L3_head_x__L2_head_L3_head_y = 1.0/determinant_L2_head_L3_head_x__L2_head_L3_head_y;
    const double determinant_P2_x__P2_y = -span_L6_head_x*span_L7_tail_y + span_L6_head_y*span_L7_tail_x;
    const double size_P2_x__L7_theta = fabs(span_L7_tail_x) + fabs(span_L7_tail_y);
    const double size_P2_x__L6_theta = fabs(span_L6_head_x) + fabs(span_L6_head_y);
    const double size_P2_y__L7_theta = fabs(span_L7_tail_x) + fabs(span_L7_tail_y);
    const double size_P2_y__L6_theta = fabs(span_L6_head_x) + fabs(span_L6_head_y);
    const double bound_P2_x__P2_y = size_P2_x__L6_theta*size_P2_y__L7_theta + size_P2_x__L7_theta*size_P2_y__L6_theta;
    if (!(fabs(determinant_P2_x__P2_y) > SINGULAR_SQUARE * bound_P2_x__P2_y))
        return 5;
    const double inverse_P2_x__P2_y = 1.0/determinant_P2_x__P2_y;
    const double pivot_guide_offset = span_L8_head_y;
    const double size_guide_offset__L8_theta = fabs(span_L8_head_x) + fabs(span_L8_head_y);
    if (!(fabs(pivot_guide_offset) > SINGULAR_SQUARE * size_guide_offset__L8_theta))
        return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* accelerations */
    const double second_rest_L2_head_L3_head_x = (L2_omega * L2_omega)*span_L2_head_x
        - (L3_omega * L3_omega)*span_L3_head_x + crank1_acceleration*span_L1_head_y
        + (crank1_rate * crank1_rate)*span_L1_head_x - crank4_acceleration*span_L4_head_y
        - (crank4_rate * crank4_rate)*span_L4_head_x;
    const double second_rest_L2_head_L3_head_y = (L2_omega * L2_omega)*span_L2_head_y
        - (L3_omega * L3_omega)*span_L3_head_y - crank1_acceleration*span_L1_head_x
        + (crank1_rate * crank1_rate)*span_L1_head_y + crank4_acceleration*span_L4_head_x
        - (crank4_rate * crank4_rate)*span_L4_head_y;
    const double second_L3_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y
        *(second_rest_L2_head_L3_head_x*span_L2_head_x + second_rest_L2_head_L3_head_y*span_L2_head_y);
    const double second_L2_theta = inverse_L2_head_L3_head_x__L2_head_L3_head_y
        *(second_rest_L2_head_L3_head_x*span_L3_head_x + second_rest_L2_head_L3_head_y*span_L3_head_y);
    const double second_rest_P2_x = (L2_omega * L2_omega)*span_L2_head_x - (L6_omega * L6_omega)*span_L6_head_x
        - (L7_omega * L7_omega)*span_L7_tail_x + crank1_acceleration*span_L1_head_y
        + (crank1_rate * crank1_rate)*span_L1_head_x + second_L2_theta*span_L2_head_y;
    const double second_rest_P2_y = (L2_omega * L2_omega)*span_L2_head_y - (L6_omega * L6_omega)*span_L6_head_y
        - (L7_omega * L7_omega)*span_L7_tail_y - crank1_acceleration*span_L1_head_x
        + (crank1_rate * crank1_rate)*span_L1_head_y - second_L2_theta*span_L2_head_x;
    const double second_L7_theta = inverse_P2_x__P2_y*(-second_rest_P2_x*span_L6_head_x
        - second_rest_P2_y*span_L6_head_y);
    const double second_L6_theta = inverse_P2_x__P2_y*(second_rest_P2_x*span_L7_tail_x
        + second_rest_P2_y*span_L7_tail_y);
    const double second_L8_theta = inverse_guide_offset*(-(L6_omega * L6_omega)*span_L6_head_x
        - (L8_omega * L8_omega)*span_L8_head_x - second_L6_theta*span_L6_head_y);
    a[0] = second_L6_theta;
    a[1] = second_L2_theta;
    a[2] = second_L3_theta;
    a[3] = second_L7_theta;
    a[4] = second_L8_theta;
    all_a[0] = -crank1_acceleration*span_L1_com_y - (crank1_rate * crank1_rate)*span_L1_com_x;
    all_a[1] = crank1_acceleration*span_L1_com_x - (crank1_rate * crank1_rate)*span_L1_com_y;
    all_a[2] = crank1_acceleration;
    all_a[3] = -(L2_omega * L2_omega)*span_L2_com_x - crank1_acceleration*span_L1_head_y
        - (crank1_rate * crank1_rate)*span_L1_head_x - second_L2_theta*span_L2_com_y;
    all_a[4] = -(L2_omega * L2_omega)*span_L2_com_y + crank1_acceleration*span_L1_head_x
        - (crank1_rate * crank1_rate)*span_L1_head_y + second_L2_theta*span_L2_com_x;
    all_a[5] = second_L2_theta;
    all_a[6] = -(L3_omega * L3_omega)*span_L3_com_x - crank4_acceleration*span_L4_head_y
        - (crank4_rate * crank4_rate)*span_L4_head_x - second_L3_theta*span_L3_com_y;
    all_a[7] = -(L3_omega * L3_omega)*span_L3_com_y + crank4_acceleration*span_L4_head_x
        - (crank4_rate * crank4_rate)*span_L4_head_y + second_L3_theta*span_L3_com_x;
    all_a[8] = second_L3_theta;
    all_a[9] = -crank4_acceleration*span_L4_com_y - (crank4_rate * crank4_rate)*span_L4_com_x;
    all_a[10] = crank4_acceleration*span_L4_com_x - (crank4_rate * crank4_rate)*span_L4_com_y;
    all_a[11] = crank4_acceleration;
    all_a[12] = -(L6_omega * L6_omega)*span_L6_com_x - second_L6_theta*span_L6_com_y;
    all_a[13] = -(L6_omega * L6_omega)*span_L6_com_y + second_L6_theta*span_L6_com_x;
    all_a[14] = second_L6_theta;
    all_a[15] = -(L6_omega * L6_omega)*span_L6_head_x - (L7_omega * L7_omega)*span_L7_com_x
        - second_L6_theta*span_L6_head_y - second_L7_theta*span_L7_com_y;
    all_a[16] = -(L6_omega * L6_omega)*span_L6_head_y - (L7_omega * L7_omega)*span_L7_com_y
        + second_L6_theta*span_L6_head_x + second_L7_theta*span_L7_com_x;
    all_a[17] = second_L7_theta;
    all_a[18] = -(L6_omega * L6_omega)*span_L6_head_x - (L8_omega * L8_omega)*span_L8_com_x
        - second_L6_theta*span_L6_head_y - second_L8_theta*span_L8_com_y;
    all_a[19] = -(L6_omega * L6_omega)*span_L6_head_y - (L8_omega * L8_omega)*span_L8_com_y
        + second_L6_theta*span_L6_head_x + second_L8_theta*span_L8_com_x;
    all_a[20] = second_L8_theta;
    all_a[21] = -(L6_omega * L6_omega)*span_L6_head_x - (L8_omega * L8_omega)*span_L8_head_x
        - second_L6_theta*span_L6_head_y - second_L8_theta*span_L8_head_y;
    all_a[22] = -(L6_omega * L6_omega)*span_L6_head_y - (L8_omega * L8_omega)*span_L8_head_y
        + second_L6_theta*span_L6_head_x + second_L8_theta*span_L8_head_x;
    all_a[23] = 0.0;
    return 0;
}
