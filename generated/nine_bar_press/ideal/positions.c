/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates, double *worst)
{
    /* coordinates, velocities, time */
    const double L6_theta_ = q[0];
    const double L2_theta_ = q[1];
    const double L3_theta_ = q[2];
    const double L7_theta_ = q[3];
    const double L8_theta_ = q[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double cos_theta_L8_ = cosines_1[2];
    const double sin_theta_L8_ = sines_1[2];
    const double crank1_rate_ = p->omega_;
    const double crank4_rate_ = p->omega4_;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;

    /* closures */
    const double phi_guide_offset_ = -span_L6_head_x_ - span_L8_head_x_;
    const double phi_L2_head_L3_head_x_ = span_L1_head_x_ + span_L2_head_x_ - span_L3_head_x_ - span_L4_head_x_;
    const double phi_L2_head_L3_head_y_ = -p->O4_y_ + span_L1_head_y_ + span_L2_head_y_ - span_L3_head_y_
        - span_L4_head_y_;
    const double phi_P2_x_ = -p->O6_x_ + span_L1_head_x_ + span_L2_head_x_ - span_L6_head_x_ - span_L7_tail_x_;
    const double phi_P2_y_ = span_L1_head_y_ + span_L2_head_y_ - span_L6_head_y_ - span_L7_tail_y_;

    /* blocks of constraint equations that are solved one after the other */
    const double determinant_L2_head_L3_head_x_L2_head_L3_head_y_ = span_L2_head_x_*span_L3_head_y_
        - span_L2_head_y_*span_L3_head_x_;
    const double size_L2_head_L3_head_x_L3_theta_ = fabs(span_L3_head_x_) + fabs(span_L3_head_y_);
    const double size_L2_head_L3_head_x_L2_theta_ = fabs(span_L2_head_x_) + fabs(span_L2_head_y_);
    const double size_L2_head_L3_head_y_L3_theta_ = fabs(span_L3_head_x_) + fabs(span_L3_head_y_);
    const double size_L2_head_L3_head_y_L2_theta_ = fabs(span_L2_head_x_) + fabs(span_L2_head_y_);
    const double bound_L2_head_L3_head_x_L2_head_L3_head_y_ =
        size_L2_head_L3_head_x_L2_theta_*size_L2_head_L3_head_y_L3_theta_
        + size_L2_head_L3_head_x_L3_theta_*size_L2_head_L3_head_y_L2_theta_;
    if (!(fabs(determinant_L2_head_L3_head_x_L2_head_L3_head_y_) > SINGULAR_SQUARE
        * bound_L2_head_L3_head_x_L2_head_L3_head_y_))
        return 3;
    const double inverse_L2_head_L3_head_x_L2_head_L3_head_y_ = 1.0/determinant_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double determinant_P2_x_P2_y_ = -span_L6_head_x_*span_L7_tail_y_ + span_L6_head_y_*span_L7_tail_x_;
    const double size_P2_x_L7_theta_ = fabs(span_L7_tail_x_) + fabs(span_L7_tail_y_);
    const double size_P2_x_L6_theta_ = fabs(span_L6_head_x_) + fabs(span_L6_head_y_);
    const double size_P2_y_L7_theta_ = fabs(span_L7_tail_x_) + fabs(span_L7_tail_y_);
    const double size_P2_y_L6_theta_ = fabs(span_L6_head_x_) + fabs(span_L6_head_y_);
    const double bound_P2_x_P2_y_ = size_P2_x_L6_theta_*size_P2_y_L7_theta_ + size_P2_x_L7_theta_*size_P2_y_L6_theta_;
    if (!(fabs(determinant_P2_x_P2_y_) > SINGULAR_SQUARE * bound_P2_x_P2_y_))
        return 5;
    const double inverse_P2_x_P2_y_ = 1.0/determinant_P2_x_P2_y_;
    const double pivot_guide_offset_ = span_L8_head_y_;
    const double size_guide_offset_L8_theta_ = fabs(span_L8_head_x_) + fabs(span_L8_head_y_);
    if (!(fabs(pivot_guide_offset_) > SINGULAR_SQUARE * size_guide_offset_L8_theta_))
        return 1;
    const double inverse_guide_offset_ = 1.0/pivot_guide_offset_;

    /* Newton's step */
    const double step_L3_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_*(phi_L2_head_L3_head_x_*span_L2_head_x_
        + phi_L2_head_L3_head_y_*span_L2_head_y_);
    const double step_L2_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_*(phi_L2_head_L3_head_x_*span_L3_head_x_
        + phi_L2_head_L3_head_y_*span_L3_head_y_);
    const double step_rest_P2_x_ = phi_P2_x_ + span_L2_head_y_*step_L2_theta_;
    const double step_rest_P2_y_ = phi_P2_y_ - span_L2_head_x_*step_L2_theta_;
    const double step_L7_theta_ = inverse_P2_x_P2_y_*(-span_L6_head_x_*step_rest_P2_x_
        - span_L6_head_y_*step_rest_P2_y_);
    const double step_L6_theta_ = inverse_P2_x_P2_y_*(span_L7_tail_x_*step_rest_P2_x_
        + span_L7_tail_y_*step_rest_P2_y_);
    const double step_L8_theta_ = inverse_guide_offset_*(phi_guide_offset_ - span_L6_head_y_*step_L6_theta_);

    /* rates */
    const double rate_rest_L2_head_L3_head_x_ = crank1_rate_*span_L1_head_y_ - crank4_rate_*span_L4_head_y_;
    const double rate_rest_L2_head_L3_head_y_ = -crank1_rate_*span_L1_head_x_ + crank4_rate_*span_L4_head_x_;
    const double rate_L3_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *(rate_rest_L2_head_L3_head_x_*span_L2_head_x_ + rate_rest_L2_head_L3_head_y_*span_L2_head_y_);
    const double rate_L2_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *(rate_rest_L2_head_L3_head_x_*span_L3_head_x_ + rate_rest_L2_head_L3_head_y_*span_L3_head_y_);
    const double rate_rest_P2_x_ = crank1_rate_*span_L1_head_y_ + rate_L2_theta_*span_L2_head_y_;
    const double rate_rest_P2_y_ = -crank1_rate_*span_L1_head_x_ - rate_L2_theta_*span_L2_head_x_;
    const double rate_L7_theta_ = inverse_P2_x_P2_y_*(-rate_rest_P2_x_*span_L6_head_x_
        - rate_rest_P2_y_*span_L6_head_y_);
    const double rate_L6_theta_ = inverse_P2_x_P2_y_*(rate_rest_P2_x_*span_L7_tail_x_
        + rate_rest_P2_y_*span_L7_tail_y_);
    const double rate_L8_theta_ = -inverse_guide_offset_*rate_L6_theta_*span_L6_head_y_;

    /* results */
    step[0] = step_L6_theta_;
    rates[0] = rate_L6_theta_;
    step[1] = step_L2_theta_;
    rates[1] = rate_L2_theta_;
    step[2] = step_L3_theta_;
    rates[2] = rate_L3_theta_;
    step[3] = step_L7_theta_;
    rates[3] = rate_L7_theta_;
    step[4] = step_L8_theta_;
    rates[4] = rate_L8_theta_;
    *worst = max_of(0.0, fabs(phi_guide_offset_));
    *worst = max_of(*worst, fabs(phi_L2_head_L3_head_x_));
    *worst = max_of(*worst, fabs(phi_L2_head_L3_head_y_));
    *worst = max_of(*worst, fabs(phi_P2_x_));
    *worst = max_of(*worst, fabs(phi_P2_y_));
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
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L2_theta_ = q[1];
    const double L2_omega_ = v[1];
    const double L3_theta_ = q[2];
    const double L3_omega_ = v[2];
    const double L7_theta_ = q[3];
    const double L7_omega_ = v[3];
    const double L8_theta_ = q[4];
    const double L8_omega_ = v[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double cos_theta_L8_ = cosines_1[2];
    const double sin_theta_L8_ = sines_1[2];
    const double crank1_rate_ = p->omega_;
    const double crank1_acceleration_ = 0.0;
    const double crank4_rate_ = p->omega4_;
    const double crank4_acceleration_ = 0.0;
    const double span_L1_com_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double span_L1_com_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double L1_vx_ = -crank1_rate_*span_L1_com_y_;
    const double L1_vy_ = crank1_rate_*span_L1_com_x_;
    const double span_L4_com_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double span_L4_com_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double L4_vx_ = -crank4_rate_*span_L4_com_y_;
    const double L4_y_ = p->O4_y_ + span_L4_com_y_;
    const double L4_vy_ = crank4_rate_*span_L4_com_x_;
    const double span_L6_com_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double span_L6_com_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double L6_x_ = p->O6_x_ + span_L6_com_x_;
    const double L6_vx_ = -L6_omega_*span_L6_com_y_;
    const double L6_vy_ = L6_omega_*span_L6_com_x_;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double L1_head_vx_ = -crank1_rate_*span_L1_head_y_;
    const double L1_head_vy_ = crank1_rate_*span_L1_head_x_;
    const double span_L2_com_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double span_L2_com_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double L2_x_ = span_L1_head_x_ + span_L2_com_x_;
    const double L2_vx_ = L1_head_vx_ - L2_omega_*span_L2_com_y_;
    const double L2_y_ = span_L1_head_y_ + span_L2_com_y_;
    const double L2_vy_ = L1_head_vy_ + L2_omega_*span_L2_com_x_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double L4_head_vx_ = -crank4_rate_*span_L4_head_y_;
    const double L4_head_y_ = p->O4_y_ + span_L4_head_y_;
    const double L4_head_vy_ = crank4_rate_*span_L4_head_x_;
    const double span_L3_com_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double span_L3_com_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double L3_x_ = span_L3_com_x_ + span_L4_head_x_;
    const double L3_vx_ = -L3_omega_*span_L3_com_y_ + L4_head_vx_;
    const double L3_y_ = L4_head_y_ + span_L3_com_y_;
    const double L3_vy_ = L3_omega_*span_L3_com_x_ + L4_head_vy_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double L6_head_x_ = p->O6_x_ + span_L6_head_x_;
    const double L6_head_vx_ = -L6_omega_*span_L6_head_y_;
    const double L6_head_vy_ = L6_omega_*span_L6_head_x_;
    const double span_L7_com_x_ = p->L7_com_span_x_*cos_theta_L7_;
    const double span_L7_com_y_ = p->L7_com_span_x_*sin_theta_L7_;
    const double L7_x_ = L6_head_x_ + span_L7_com_x_;
    const double L7_vx_ = L6_head_vx_ - L7_omega_*span_L7_com_y_;
    const double L7_y_ = span_L6_head_y_ + span_L7_com_y_;
    const double L7_vy_ = L6_head_vy_ + L7_omega_*span_L7_com_x_;
    const double span_L8_com_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double span_L8_com_y_ = p->L8_head_s_x_*sin_theta_L8_;
    const double L8_x_ = L6_head_x_ + span_L8_com_x_;
    const double L8_vx_ = L6_head_vx_ - L8_omega_*span_L8_com_y_;
    const double L8_y_ = span_L6_head_y_ + span_L8_com_y_;
    const double L8_vy_ = L6_head_vy_ + L8_omega_*span_L8_com_x_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double L8_head_x_ = L6_head_x_ + span_L8_head_x_;
    const double L8_head_vx_ = L6_head_vx_ - L8_omega_*span_L8_head_y_;
    const double L8_head_y_ = span_L6_head_y_ + span_L8_head_y_;
    const double L8_head_vy_ = L6_head_vy_ + L8_omega_*span_L8_head_x_;
    const double S9_theta_ = PI/2.0;
    const double S9_omega_ = 0.0;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;

    /* positions and velocities of the bodies */
    all_q[0] = span_L1_com_x_;
    all_v[0] = L1_vx_;
    all_q[1] = span_L1_com_y_;
    all_v[1] = L1_vy_;
    all_q[2] = crank1_value_;
    all_v[2] = crank1_rate_;
    all_q[3] = L2_x_;
    all_v[3] = L2_vx_;
    all_q[4] = L2_y_;
    all_v[4] = L2_vy_;
    all_q[5] = L2_theta_;
    all_v[5] = L2_omega_;
    all_q[6] = L3_x_;
    all_v[6] = L3_vx_;
    all_q[7] = L3_y_;
    all_v[7] = L3_vy_;
    all_q[8] = L3_theta_;
    all_v[8] = L3_omega_;
    all_q[9] = span_L4_com_x_;
    all_v[9] = L4_vx_;
    all_q[10] = L4_y_;
    all_v[10] = L4_vy_;
    all_q[11] = crank4_value_;
    all_v[11] = crank4_rate_;
    all_q[12] = L6_x_;
    all_v[12] = L6_vx_;
    all_q[13] = span_L6_com_y_;
    all_v[13] = L6_vy_;
    all_q[14] = L6_theta_;
    all_v[14] = L6_omega_;
    all_q[15] = L7_x_;
    all_v[15] = L7_vx_;
    all_q[16] = L7_y_;
    all_v[16] = L7_vy_;
    all_q[17] = L7_theta_;
    all_v[17] = L7_omega_;
    all_q[18] = L8_x_;
    all_v[18] = L8_vx_;
    all_q[19] = L8_y_;
    all_v[19] = L8_vy_;
    all_q[20] = L8_theta_;
    all_v[20] = L8_omega_;
    all_q[21] = L8_head_x_;
    all_v[21] = L8_head_vx_;
    all_q[22] = L8_head_y_;
    all_v[22] = L8_head_vy_;
    all_q[23] = S9_theta_;
    all_v[23] = S9_omega_;

    /* rates of the closures */
    const double phi_dot_guide_offset_ = L6_omega_*span_L6_head_y_ + L8_omega_*span_L8_head_y_;
    const double phi_dot_L2_head_L3_head_x_ = -L2_omega_*span_L2_head_y_ + L3_omega_*span_L3_head_y_
        - crank1_rate_*span_L1_head_y_ + crank4_rate_*span_L4_head_y_;
    const double phi_dot_L2_head_L3_head_y_ = L2_omega_*span_L2_head_x_ - L3_omega_*span_L3_head_x_
        + crank1_rate_*span_L1_head_x_ - crank4_rate_*span_L4_head_x_;
    const double phi_dot_P2_x_ = -L2_omega_*span_L2_head_y_ + L6_omega_*span_L6_head_y_ + L7_omega_*span_L7_tail_y_
        - crank1_rate_*span_L1_head_y_;
    const double phi_dot_P2_y_ = L2_omega_*span_L2_head_x_ - L6_omega_*span_L6_head_x_ - L7_omega_*span_L7_tail_x_
        + crank1_rate_*span_L1_head_x_;
    *worst = max_of(0.0, fabs(phi_dot_guide_offset_));
    *worst = max_of(*worst, fabs(phi_dot_L2_head_L3_head_x_));
    *worst = max_of(*worst, fabs(phi_dot_L2_head_L3_head_y_));
    *worst = max_of(*worst, fabs(phi_dot_P2_x_));
    *worst = max_of(*worst, fabs(phi_dot_P2_y_));

    /* blocks of constraint equations that are solved one after the other */
    const double determinant_L2_head_L3_head_x_L2_head_L3_head_y_ = span_L2_head_x_*span_L3_head_y_
        - span_L2_head_y_*span_L3_head_x_;
    const double size_L2_head_L3_head_x_L3_theta_ = fabs(span_L3_head_x_) + fabs(span_L3_head_y_);
    const double size_L2_head_L3_head_x_L2_theta_ = fabs(span_L2_head_x_) + fabs(span_L2_head_y_);
    const double size_L2_head_L3_head_y_L3_theta_ = fabs(span_L3_head_x_) + fabs(span_L3_head_y_);
    const double size_L2_head_L3_head_y_L2_theta_ = fabs(span_L2_head_x_) + fabs(span_L2_head_y_);
    const double bound_L2_head_L3_head_x_L2_head_L3_head_y_ =
        size_L2_head_L3_head_x_L2_theta_*size_L2_head_L3_head_y_L3_theta_
        + size_L2_head_L3_head_x_L3_theta_*size_L2_head_L3_head_y_L2_theta_;
    if (!(fabs(determinant_L2_head_L3_head_x_L2_head_L3_head_y_) > SINGULAR_SQUARE
        * bound_L2_head_L3_head_x_L2_head_L3_head_y_))
        return 3;
    const double inverse_L2_head_L3_head_x_L2_head_L3_head_y_ = 1.0/determinant_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double determinant_P2_x_P2_y_ = -span_L6_head_x_*span_L7_tail_y_ + span_L6_head_y_*span_L7_tail_x_;
    const double size_P2_x_L7_theta_ = fabs(span_L7_tail_x_) + fabs(span_L7_tail_y_);
    const double size_P2_x_L6_theta_ = fabs(span_L6_head_x_) + fabs(span_L6_head_y_);
    const double size_P2_y_L7_theta_ = fabs(span_L7_tail_x_) + fabs(span_L7_tail_y_);
    const double size_P2_y_L6_theta_ = fabs(span_L6_head_x_) + fabs(span_L6_head_y_);
    const double bound_P2_x_P2_y_ = size_P2_x_L6_theta_*size_P2_y_L7_theta_ + size_P2_x_L7_theta_*size_P2_y_L6_theta_;
    if (!(fabs(determinant_P2_x_P2_y_) > SINGULAR_SQUARE * bound_P2_x_P2_y_))
        return 5;
    const double inverse_P2_x_P2_y_ = 1.0/determinant_P2_x_P2_y_;
    const double pivot_guide_offset_ = span_L8_head_y_;
    const double size_guide_offset_L8_theta_ = fabs(span_L8_head_x_) + fabs(span_L8_head_y_);
    if (!(fabs(pivot_guide_offset_) > SINGULAR_SQUARE * size_guide_offset_L8_theta_))
        return 1;
    const double inverse_guide_offset_ = 1.0/pivot_guide_offset_;

    /* accelerations */
    const double second_rest_L2_head_L3_head_x_ = (L2_omega_ * L2_omega_)*span_L2_head_x_
        - (L3_omega_ * L3_omega_)*span_L3_head_x_ + crank1_acceleration_*span_L1_head_y_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_x_ - crank4_acceleration_*span_L4_head_y_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_x_;
    const double second_rest_L2_head_L3_head_y_ = (L2_omega_ * L2_omega_)*span_L2_head_y_
        - (L3_omega_ * L3_omega_)*span_L3_head_y_ - crank1_acceleration_*span_L1_head_x_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_y_ + crank4_acceleration_*span_L4_head_x_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_y_;
    const double second_L3_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *(second_rest_L2_head_L3_head_x_*span_L2_head_x_ + second_rest_L2_head_L3_head_y_*span_L2_head_y_);
    const double second_L2_theta_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *(second_rest_L2_head_L3_head_x_*span_L3_head_x_ + second_rest_L2_head_L3_head_y_*span_L3_head_y_);
    const double second_rest_P2_x_ = (L2_omega_ * L2_omega_)*span_L2_head_x_ - (L6_omega_ * L6_omega_)*span_L6_head_x_
        - (L7_omega_ * L7_omega_)*span_L7_tail_x_ + crank1_acceleration_*span_L1_head_y_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_x_ + second_L2_theta_*span_L2_head_y_;
    const double second_rest_P2_y_ = (L2_omega_ * L2_omega_)*span_L2_head_y_ - (L6_omega_ * L6_omega_)*span_L6_head_y_
        - (L7_omega_ * L7_omega_)*span_L7_tail_y_ - crank1_acceleration_*span_L1_head_x_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_y_ - second_L2_theta_*span_L2_head_x_;
    const double second_L7_theta_ = inverse_P2_x_P2_y_*(-second_rest_P2_x_*span_L6_head_x_
        - second_rest_P2_y_*span_L6_head_y_);
    const double second_L6_theta_ = inverse_P2_x_P2_y_*(second_rest_P2_x_*span_L7_tail_x_
        + second_rest_P2_y_*span_L7_tail_y_);
    const double second_L8_theta_ = inverse_guide_offset_*(-(L6_omega_ * L6_omega_)*span_L6_head_x_
        - (L8_omega_ * L8_omega_)*span_L8_head_x_ - second_L6_theta_*span_L6_head_y_);
    a[0] = second_L6_theta_;
    a[1] = second_L2_theta_;
    a[2] = second_L3_theta_;
    a[3] = second_L7_theta_;
    a[4] = second_L8_theta_;
    all_a[0] = -crank1_acceleration_*span_L1_com_y_ - (crank1_rate_ * crank1_rate_)*span_L1_com_x_;
    all_a[1] = crank1_acceleration_*span_L1_com_x_ - (crank1_rate_ * crank1_rate_)*span_L1_com_y_;
    all_a[2] = crank1_acceleration_;
    all_a[3] = -(L2_omega_ * L2_omega_)*span_L2_com_x_ - crank1_acceleration_*span_L1_head_y_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_x_ - second_L2_theta_*span_L2_com_y_;
    all_a[4] = -(L2_omega_ * L2_omega_)*span_L2_com_y_ + crank1_acceleration_*span_L1_head_x_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_y_ + second_L2_theta_*span_L2_com_x_;
    all_a[5] = second_L2_theta_;
    all_a[6] = -(L3_omega_ * L3_omega_)*span_L3_com_x_ - crank4_acceleration_*span_L4_head_y_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_x_ - second_L3_theta_*span_L3_com_y_;
    all_a[7] = -(L3_omega_ * L3_omega_)*span_L3_com_y_ + crank4_acceleration_*span_L4_head_x_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_y_ + second_L3_theta_*span_L3_com_x_;
    all_a[8] = second_L3_theta_;
    all_a[9] = -crank4_acceleration_*span_L4_com_y_ - (crank4_rate_ * crank4_rate_)*span_L4_com_x_;
    all_a[10] = crank4_acceleration_*span_L4_com_x_ - (crank4_rate_ * crank4_rate_)*span_L4_com_y_;
    all_a[11] = crank4_acceleration_;
    all_a[12] = -(L6_omega_ * L6_omega_)*span_L6_com_x_ - second_L6_theta_*span_L6_com_y_;
    all_a[13] = -(L6_omega_ * L6_omega_)*span_L6_com_y_ + second_L6_theta_*span_L6_com_x_;
    all_a[14] = second_L6_theta_;
    all_a[15] = -(L6_omega_ * L6_omega_)*span_L6_head_x_ - (L7_omega_ * L7_omega_)*span_L7_com_x_
        - second_L6_theta_*span_L6_head_y_ - second_L7_theta_*span_L7_com_y_;
    all_a[16] = -(L6_omega_ * L6_omega_)*span_L6_head_y_ - (L7_omega_ * L7_omega_)*span_L7_com_y_
        + second_L6_theta_*span_L6_head_x_ + second_L7_theta_*span_L7_com_x_;
    all_a[17] = second_L7_theta_;
    all_a[18] = -(L6_omega_ * L6_omega_)*span_L6_head_x_ - (L8_omega_ * L8_omega_)*span_L8_com_x_
        - second_L6_theta_*span_L6_head_y_ - second_L8_theta_*span_L8_com_y_;
    all_a[19] = -(L6_omega_ * L6_omega_)*span_L6_head_y_ - (L8_omega_ * L8_omega_)*span_L8_com_y_
        + second_L6_theta_*span_L6_head_x_ + second_L8_theta_*span_L8_com_x_;
    all_a[20] = second_L8_theta_;
    all_a[21] = -(L6_omega_ * L6_omega_)*span_L6_head_x_ - (L8_omega_ * L8_omega_)*span_L8_head_x_
        - second_L6_theta_*span_L6_head_y_ - second_L8_theta_*span_L8_head_y_;
    all_a[22] = -(L6_omega_ * L6_omega_)*span_L6_head_y_ - (L8_omega_ * L8_omega_)*span_L8_head_y_
        + second_L6_theta_*span_L6_head_x_ + second_L8_theta_*span_L8_head_x_;
    all_a[23] = 0.0;
    return 0;
}
