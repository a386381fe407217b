/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L7_theta = q[1];
    const double L8_theta = q[2];
    const double L8_omega = v[2];
    const double L2_theta = q[3];
    const double L3_theta = q[4];

    /* parameters */
    const double L6_head_span_x = p->L6_head_span_x;
    const double L8_head_span_x = p->L8_head_span_x;
    const double inertia_L6_L7 = p->inertia_L6_L7;
    const double inertia_L6_L2 = p->inertia_L6_L2;
    const double inertia_L7_L2 = p->inertia_L7_L2;
    const double inertia_L6_L3 = p->inertia_L6_L3;
    const double inertia_L7_L3 = p->inertia_L7_L3;
    const double inertia_L6_L8 = p->inertia_L6_L8;
    const double mass_L6_L6 = p->mass_L6_L6;
    const double mass_L7_L7 = p->mass_L7_L7;
    const double mass_L3_L3 = p->mass_L3_L3;
    const double inverse_mass_L8_L8 = p->inverse_mass_L8_L8;
    const double inverse_mass_L2_L2 = p->inverse_mass_L2_L2;

    /* directions, arms, drives */
    const Four angles_0 = {L6_theta, L7_theta, L8_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L3_theta, L3_theta, L3_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L6 = cosines_0[0];
    const double sin_theta_L6 = sines_0[0];
    const double cos_theta_L7 = cosines_0[1];
    const double sin_theta_L7 = sines_0[1];
    const double cos_theta_L8 = cosines_0[2];
    const double sin_theta_L8 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double span_L6_head_x = L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = L6_head_span_x*sin_theta_L6;
    const double span_L8_head_x = L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = L8_head_span_x*sin_theta_L8;
    const double cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const double dot_L6_L7 = cos_L7_less_L6*inertia_L6_L7;
    const double cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const double dot_L6_L2 = cos_L2_less_L6*inertia_L6_L2;
    const double cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const double dot_L7_L2 = cos_L2_less_L7*inertia_L7_L2;
    const double cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const double dot_L6_L3 = cos_L3_less_L6*inertia_L6_L3;
    const double cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const double dot_L7_L3 = cos_L3_less_L7*inertia_L7_L3;
    const double cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const double dot_L6_L8 = cos_L8_less_L6*inertia_L6_L8;

    /* Phi and Phi_dot */
    const double phi_guide_offset = -span_L6_head_x - span_L8_head_x;
    const double phi_dot_guide_offset = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;

    /* L D L^T of the KKT matrix */
    const double l_L6_theta__L8_theta_4 = dot_L6_L8*inverse_mass_L8_L8;
    const double l_guide_offset__L8_theta_4 = inverse_mass_L8_L8*span_L8_head_y;
    const double l_L7_theta__L2_theta_4 = dot_L7_L2*inverse_mass_L2_L2;
    const double l_L6_theta__L2_theta_4 = dot_L6_L2*inverse_mass_L2_L2;
    const double pivot_L7_theta_3 = -dot_L7_L2*l_L7_theta__L2_theta_4 + mass_L7_L7;
    const double determinant_L7_theta__L3_theta_3 = -(dot_L7_L3 * dot_L7_L3) + mass_L3_L3*pivot_L7_theta_3;
    const double inverse_L7_theta__L3_theta_3 = 1.0/determinant_L7_theta__L3_theta_3;
    const double inverse_pivot_L7_theta_4 = inverse_L7_theta__L3_theta_3*mass_L3_L3;
    const double inverse_pivot_L3_theta_4 = inverse_L7_theta__L3_theta_3*pivot_L7_theta_3;
    const double inverse_cross_L7_theta__L3_theta_3 = -dot_L7_L3*inverse_L7_theta__L3_theta_3;
    const double w_L6_theta__L7_theta_3 = dot_L6_L7 - dot_L7_L2*l_L6_theta__L2_theta_4;
    const double l_L6_theta__L7_theta_4 = dot_L6_L3*inverse_cross_L7_theta__L3_theta_3 +
        inverse_pivot_L7_theta_4*w_L6_theta__L7_theta_3;
    const double l_L6_theta__L3_theta_4 = dot_L6_L3*inverse_pivot_L3_theta_4 +
        inverse_cross_L7_theta__L3_theta_3*w_L6_theta__L7_theta_3;
    const double inverse_pivot_L6_theta_4 = 1.0/(-dot_L6_L2*l_L6_theta__L2_theta_4 -
        dot_L6_L3*l_L6_theta__L3_theta_4 - dot_L6_L8*l_L6_theta__L8_theta_4 -
        l_L6_theta__L7_theta_4*w_L6_theta__L7_theta_3 + mass_L6_L6);
    const double w_guide_offset__L6_theta_3 = -dot_L6_L8*l_guide_offset__L8_theta_4 + span_L6_head_y;
    const double l_guide_offset__L6_theta_4 = inverse_pivot_L6_theta_4*w_guide_offset__L6_theta_3;
    const double scale_guide_offset_4 = l_guide_offset__L6_theta_4*w_guide_offset__L6_theta_3 +
        l_guide_offset__L8_theta_4*span_L8_head_y;
    if (!(scale_guide_offset_4 > 1e-10 * scale_guide_offset_4)) return 1;
    const double inverse_pivot_guide_offset_4 = 1.0/scale_guide_offset_4;

    /* backward substitution */
    const double dq_lambda_guide_offset = -inverse_pivot_guide_offset_4*phi_guide_offset;
    const double dq_acceleration_L6_theta = -dq_lambda_guide_offset*l_guide_offset__L6_theta_4;
    const double dq_acceleration_L3_theta = -dq_acceleration_L6_theta*l_L6_theta__L3_theta_4;
    const double dq_acceleration_L7_theta = -dq_acceleration_L6_theta*l_L6_theta__L7_theta_4;
    const double dq_acceleration_L2_theta = -dq_acceleration_L6_theta*l_L6_theta__L2_theta_4 -
        dq_acceleration_L7_theta*l_L7_theta__L2_theta_4;
    const double dq_acceleration_L8_theta = -dq_acceleration_L6_theta*l_L6_theta__L8_theta_4 -
        dq_lambda_guide_offset*l_guide_offset__L8_theta_4;

    /* backward substitution */
    const double dv_lambda_guide_offset = -inverse_pivot_guide_offset_4*phi_dot_guide_offset;
    const double dv_acceleration_L6_theta = -dv_lambda_guide_offset*l_guide_offset__L6_theta_4;
    const double dv_acceleration_L3_theta = -dv_acceleration_L6_theta*l_L6_theta__L3_theta_4;
    const double dv_acceleration_L7_theta = -dv_acceleration_L6_theta*l_L6_theta__L7_theta_4;
    const double dv_acceleration_L2_theta = -dv_acceleration_L6_theta*l_L6_theta__L2_theta_4 -
        dv_acceleration_L7_theta*l_L7_theta__L2_theta_4;
    const double dv_acceleration_L8_theta = -dv_acceleration_L6_theta*l_L6_theta__L8_theta_4 -
        dv_lambda_guide_offset*l_guide_offset__L8_theta_4;

    /* results */
    dq[0] = dq_acceleration_L6_theta;
    dv[0] = dv_acceleration_L6_theta;
    dq[1] = dq_acceleration_L7_theta;
    dv[1] = dv_acceleration_L7_theta;
    dq[2] = dq_acceleration_L8_theta;
    dv[2] = dv_acceleration_L8_theta;
    dq[3] = dq_acceleration_L2_theta;
    dv[3] = dv_acceleration_L2_theta;
    dq[4] = dq_acceleration_L3_theta;
    dv[4] = dv_acceleration_L3_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_guide_offset));
    return 0;
}
