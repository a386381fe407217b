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
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];

    /* parameters */
    const double O1_x = p->O1_x;
    const double O2_x = p->O2_x;
    const double crank0_head_span_x = p->crank0_head_span_x;
    const double crank1_head_span_x = p->crank1_head_span_x;
    const double coupler2_head_span_x = p->coupler2_head_span_x;
    const double crank2_head_span_x = p->crank2_head_span_x;
    const double coupler1_head_span_x = p->coupler1_head_span_x;
    const double inertia_crank0_coupler1 = p->inertia_crank0_coupler1;
    const double inertia_crank1_coupler2 = p->inertia_crank1_coupler2;
    const double mass_crank1_crank1 = p->mass_crank1_crank1;
    const double mass_coupler1_coupler1 = p->mass_coupler1_coupler1;
    const double inverse_mass_crank2_crank2 = p->inverse_mass_crank2_crank2;
    const double inverse_mass_coupler2_coupler2 = p->inverse_mass_coupler2_coupler2;
    const double inverse_mass_crank0_crank0 = p->inverse_mass_crank0_crank0;

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*crank0_head_span_x;
    const double span_crank0_head_y = crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*crank1_head_span_x;
    const double span_crank1_head_y = crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*coupler2_head_span_x;
    const double span_coupler2_head_y = coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*crank2_head_span_x;
    const double span_crank2_head_y = crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*coupler1_head_span_x;
    const double span_coupler1_head_y = coupler1_head_span_x*sin_theta_coupler1;
    const double cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 +
        sin_theta_coupler1*sin_theta_crank0;
    const double dot_crank0_coupler1 = cos_coupler1_less_crank0*inertia_crank0_coupler1;
    const double cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 +
        sin_theta_coupler2*sin_theta_crank1;
    const double dot_crank1_coupler2 = cos_coupler2_less_crank1*inertia_crank1_coupler2;

    /* Phi and Phi_dot */
    const double phi_B2_x = O1_x - O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;
    const double phi_dot_B2_x = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y +
        crank2_omega*span_crank2_head_y;
    const double phi_B2_y = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;
    const double phi_dot_B2_y = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x -
        crank2_omega*span_crank2_head_x;
    const double phi_B1_x = -O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;
    const double phi_dot_B1_x = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y +
        crank1_omega*span_crank1_head_y;
    const double phi_B1_y = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;
    const double phi_dot_B1_y = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x -
        crank1_omega*span_crank1_head_x;

    /* L D L^T of the KKT matrix */
    const double l_B2_x__crank2_theta_4 = inverse_mass_crank2_crank2*span_crank2_head_y;
    const double l_B2_y__crank2_theta_4 = -inverse_mass_crank2_crank2*span_crank2_head_x;
    const double l_coupler1_theta__crank0_theta_4 = dot_crank0_coupler1*inverse_mass_crank0_crank0;
    const double l_B1_x__crank0_theta_4 = -inverse_mass_crank0_crank0*span_crank0_head_y;
    const double l_B1_y__crank0_theta_4 = inverse_mass_crank0_crank0*span_crank0_head_x;
    const double inverse_pivot_coupler1_theta_4 = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta_4 +
        mass_coupler1_coupler1);
    const double w_B1_x__coupler1_theta_3 = -dot_crank0_coupler1*l_B1_x__crank0_theta_4 -
        span_coupler1_head_y;
    const double l_B1_x__coupler1_theta_4 = inverse_pivot_coupler1_theta_4*w_B1_x__coupler1_theta_3;
    const double w_B1_y__coupler1_theta_3 = -dot_crank0_coupler1*l_B1_y__crank0_theta_4 +
        span_coupler1_head_x;
    const double l_B1_y__coupler1_theta_4 = inverse_pivot_coupler1_theta_4*w_B1_y__coupler1_theta_3;
    const double l_crank1_theta__coupler2_theta_4 = dot_crank1_coupler2*inverse_mass_coupler2_coupler2;
    const double l_B2_x__coupler2_theta_4 = -inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const double l_B2_y__coupler2_theta_4 = inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const double inverse_pivot_crank1_theta_4 = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta_4 +
        mass_crank1_crank1);
    const double w_B2_x__crank1_theta_2 = -dot_crank1_coupler2*l_B2_x__coupler2_theta_4 - span_crank1_head_y;
    const double l_B2_x__crank1_theta_3 = inverse_pivot_crank1_theta_4*w_B2_x__crank1_theta_2;
    const double w_B2_y__crank1_theta_2 = -dot_crank1_coupler2*l_B2_y__coupler2_theta_4 + span_crank1_head_x;
    const double l_B2_y__crank1_theta_3 = inverse_pivot_crank1_theta_4*w_B2_y__crank1_theta_2;
    const double l_B1_x__crank1_theta_4 = inverse_pivot_crank1_theta_4*span_crank1_head_y;
    const double l_B1_y__crank1_theta_4 = -inverse_pivot_crank1_theta_4*span_crank1_head_x;
    const double scale_B2_x_4 = -l_B2_x__coupler2_theta_4*span_coupler2_head_y +
        l_B2_x__crank1_theta_3*w_B2_x__crank1_theta_2 + l_B2_x__crank2_theta_4*span_crank2_head_y;
    const double scale_B2_y_4 = l_B2_y__coupler2_theta_4*span_coupler2_head_x +
        l_B2_y__crank1_theta_3*w_B2_y__crank1_theta_2 - l_B2_y__crank2_theta_4*span_crank2_head_x;
    const double pivot_B2_x__B2_y_3 = -l_B2_y__coupler2_theta_4*span_coupler2_head_y +
        l_B2_y__crank1_theta_3*w_B2_x__crank1_theta_2 + l_B2_y__crank2_theta_4*span_crank2_head_y;
    const double determinant_B2_x__B2_y_3 = -(pivot_B2_x__B2_y_3 * pivot_B2_x__B2_y_3) +
        scale_B2_x_4*scale_B2_y_4;
    if (!(scale_B2_x_4 > 1e-10 * scale_B2_x_4)) return 1;
    if (!(determinant_B2_x__B2_y_3 > 1e-10 * scale_B2_y_4 * scale_B2_x_4)) return 2;
    const double size_B2_x_3 = scale_B2_x_4 + scale_B2_y_4;
    if (!(scale_B2_x_4 > 1e-10 * size_B2_x_3)) return 1;
    if (!(determinant_B2_x__B2_y_3 > 1e-10 * size_B2_x_3 * scale_B2_x_4)) return 2;
    const double inverse_B2_x__B2_y_3 = -1.0/determinant_B2_x__B2_y_3;
    const double inverse_pivot_B2_x_4 = inverse_B2_x__B2_y_3*scale_B2_y_4;
    const double inverse_pivot_B2_y_4 = inverse_B2_x__B2_y_3*scale_B2_x_4;
    const double inverse_cross_B2_x__B2_y_3 = -inverse_B2_x__B2_y_3*pivot_B2_x__B2_y_3;
    const double w_B1_x__B2_x_2 = -l_B1_x__crank1_theta_4*w_B2_x__crank1_theta_2;
    const double w_B1_x__B2_y_2 = -l_B1_x__crank1_theta_4*w_B2_y__crank1_theta_2;
    const double l_B1_x__B2_x_3 = inverse_cross_B2_x__B2_y_3*w_B1_x__B2_y_2 +
        inverse_pivot_B2_x_4*w_B1_x__B2_x_2;
    const double l_B1_x__B2_y_3 = inverse_cross_B2_x__B2_y_3*w_B1_x__B2_x_2 +
        inverse_pivot_B2_y_4*w_B1_x__B2_y_2;
    const double w_B1_y__B2_x_2 = -l_B1_y__crank1_theta_4*w_B2_x__crank1_theta_2;
    const double w_B1_y__B2_y_2 = -l_B1_y__crank1_theta_4*w_B2_y__crank1_theta_2;
    const double l_B1_y__B2_x_3 = inverse_cross_B2_x__B2_y_3*w_B1_y__B2_y_2 +
        inverse_pivot_B2_x_4*w_B1_y__B2_x_2;
    const double l_B1_y__B2_y_3 = inverse_cross_B2_x__B2_y_3*w_B1_y__B2_x_2 +
        inverse_pivot_B2_y_4*w_B1_y__B2_y_2;
    const double scale_B1_x_4 = l_B1_x__coupler1_theta_4*w_B1_x__coupler1_theta_3 -
        l_B1_x__crank0_theta_4*span_crank0_head_y + l_B1_x__crank1_theta_4*span_crank1_head_y;
    const double scale_B1_y_4 = l_B1_y__coupler1_theta_4*w_B1_y__coupler1_theta_3 +
        l_B1_y__crank0_theta_4*span_crank0_head_x - l_B1_y__crank1_theta_4*span_crank1_head_x;
    const double pivot_B1_x_3 = l_B1_x__B2_x_3*w_B1_x__B2_x_2 + l_B1_x__B2_y_3*w_B1_x__B2_y_2 + scale_B1_x_4;
    const double pivot_B1_y_3 = l_B1_y__B2_x_3*w_B1_y__B2_x_2 + l_B1_y__B2_y_3*w_B1_y__B2_y_2 + scale_B1_y_4;
    const double pivot_B1_x__B1_y_3 = l_B1_y__B2_x_3*w_B1_x__B2_x_2 + l_B1_y__B2_y_3*w_B1_x__B2_y_2 +
        l_B1_y__coupler1_theta_4*w_B1_x__coupler1_theta_3 - l_B1_y__crank0_theta_4*span_crank0_head_y +
        l_B1_y__crank1_theta_4*span_crank1_head_y;
    const double determinant_B1_x__B1_y_3 = pivot_B1_x_3*pivot_B1_y_3 - (pivot_B1_x__B1_y_3 *
        pivot_B1_x__B1_y_3);
    if (!(pivot_B1_x_3 > 1e-10 * scale_B1_x_4)) return 3;
    if (!(determinant_B1_x__B1_y_3 > 1e-10 * scale_B1_y_4 * pivot_B1_x_3)) return 4;
    const double size_B1_x_3 = scale_B1_x_4 + scale_B1_y_4;
    if (!(pivot_B1_x_3 > 1e-10 * size_B1_x_3)) return 3;
    if (!(determinant_B1_x__B1_y_3 > 1e-10 * size_B1_x_3 * pivot_B1_x_3)) return 4;
    const double inverse_B1_x__B1_y_3 = -1.0/determinant_B1_x__B1_y_3;
    const double inverse_pivot_B1_x_4 = inverse_B1_x__B1_y_3*pivot_B1_y_3;
    const double inverse_pivot_B1_y_4 = inverse_B1_x__B1_y_3*pivot_B1_x_3;
    const double inverse_cross_B1_x__B1_y_3 = -inverse_B1_x__B1_y_3*pivot_B1_x__B1_y_3;

    /* forward substitution */
    const double dq_z_B1_x = -l_B1_x__B2_x_3*phi_B2_x - l_B1_x__B2_y_3*phi_B2_y + phi_B1_x;
    const double dq_z_B1_y = -l_B1_y__B2_x_3*phi_B2_x - l_B1_y__B2_y_3*phi_B2_y + phi_B1_y;

    /* backward substitution */
    const double dq_lambda_B1_y = dq_z_B1_x*inverse_cross_B1_x__B1_y_3 + dq_z_B1_y*inverse_pivot_B1_y_4;
    const double dq_lambda_B1_x = dq_z_B1_x*inverse_pivot_B1_x_4 + dq_z_B1_y*inverse_cross_B1_x__B1_y_3;
    const double dq_lambda_B2_y = -dq_lambda_B1_x*l_B1_x__B2_y_3 - dq_lambda_B1_y*l_B1_y__B2_y_3 +
        inverse_cross_B2_x__B2_y_3*phi_B2_x + inverse_pivot_B2_y_4*phi_B2_y;
    const double dq_lambda_B2_x = -dq_lambda_B1_x*l_B1_x__B2_x_3 - dq_lambda_B1_y*l_B1_y__B2_x_3 +
        inverse_cross_B2_x__B2_y_3*phi_B2_y + inverse_pivot_B2_x_4*phi_B2_x;
    const double dq_acceleration_crank1_theta = -dq_lambda_B1_x*l_B1_x__crank1_theta_4 -
        dq_lambda_B1_y*l_B1_y__crank1_theta_4 - dq_lambda_B2_x*l_B2_x__crank1_theta_3 -
        dq_lambda_B2_y*l_B2_y__crank1_theta_3;
    const double dq_acceleration_coupler2_theta =
        -dq_acceleration_crank1_theta*l_crank1_theta__coupler2_theta_4 -
        dq_lambda_B2_x*l_B2_x__coupler2_theta_4 - dq_lambda_B2_y*l_B2_y__coupler2_theta_4;
    const double dq_acceleration_coupler1_theta = -dq_lambda_B1_x*l_B1_x__coupler1_theta_4 -
        dq_lambda_B1_y*l_B1_y__coupler1_theta_4;
    const double dq_acceleration_crank0_theta =
        -dq_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta_4 -
        dq_lambda_B1_x*l_B1_x__crank0_theta_4 - dq_lambda_B1_y*l_B1_y__crank0_theta_4;
    const double dq_acceleration_crank2_theta = -dq_lambda_B2_x*l_B2_x__crank2_theta_4 -
        dq_lambda_B2_y*l_B2_y__crank2_theta_4;

    /* forward substitution */
    const double dv_z_B1_x = -l_B1_x__B2_x_3*phi_dot_B2_x - l_B1_x__B2_y_3*phi_dot_B2_y + phi_dot_B1_x;
    const double dv_z_B1_y = -l_B1_y__B2_x_3*phi_dot_B2_x - l_B1_y__B2_y_3*phi_dot_B2_y + phi_dot_B1_y;

    /* backward substitution */
    const double dv_lambda_B1_y = dv_z_B1_x*inverse_cross_B1_x__B1_y_3 + dv_z_B1_y*inverse_pivot_B1_y_4;
    const double dv_lambda_B1_x = dv_z_B1_x*inverse_pivot_B1_x_4 + dv_z_B1_y*inverse_cross_B1_x__B1_y_3;
    const double dv_lambda_B2_y = -dv_lambda_B1_x*l_B1_x__B2_y_3 - dv_lambda_B1_y*l_B1_y__B2_y_3 +
        inverse_cross_B2_x__B2_y_3*phi_dot_B2_x + inverse_pivot_B2_y_4*phi_dot_B2_y;
    const double dv_lambda_B2_x = -dv_lambda_B1_x*l_B1_x__B2_x_3 - dv_lambda_B1_y*l_B1_y__B2_x_3 +
        inverse_cross_B2_x__B2_y_3*phi_dot_B2_y + inverse_pivot_B2_x_4*phi_dot_B2_x;
    const double dv_acceleration_crank1_theta = -dv_lambda_B1_x*l_B1_x__crank1_theta_4 -
        dv_lambda_B1_y*l_B1_y__crank1_theta_4 - dv_lambda_B2_x*l_B2_x__crank1_theta_3 -
        dv_lambda_B2_y*l_B2_y__crank1_theta_3;
    const double dv_acceleration_coupler2_theta =
        -dv_acceleration_crank1_theta*l_crank1_theta__coupler2_theta_4 -
        dv_lambda_B2_x*l_B2_x__coupler2_theta_4 - dv_lambda_B2_y*l_B2_y__coupler2_theta_4;
    const double dv_acceleration_coupler1_theta = -dv_lambda_B1_x*l_B1_x__coupler1_theta_4 -
        dv_lambda_B1_y*l_B1_y__coupler1_theta_4;
    const double dv_acceleration_crank0_theta =
        -dv_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta_4 -
        dv_lambda_B1_x*l_B1_x__crank0_theta_4 - dv_lambda_B1_y*l_B1_y__crank0_theta_4;
    const double dv_acceleration_crank2_theta = -dv_lambda_B2_x*l_B2_x__crank2_theta_4 -
        dv_lambda_B2_y*l_B2_y__crank2_theta_4;

    /* results */
    dq[0] = dq_acceleration_crank0_theta;
    dv[0] = dv_acceleration_crank0_theta;
    dq[1] = dq_acceleration_crank1_theta;
    dv[1] = dv_acceleration_crank1_theta;
    dq[2] = dq_acceleration_crank2_theta;
    dv[2] = dv_acceleration_crank2_theta;
    dq[3] = dq_acceleration_coupler1_theta;
    dv[3] = dv_acceleration_coupler1_theta;
    dq[4] = dq_acceleration_coupler2_theta;
    dv[4] = dv_acceleration_coupler2_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_B2_x));
    *worst = max_of(*worst, fabs(phi_B2_y));
    *worst = max_of(*worst, fabs(phi_B1_x));
    *worst = max_of(*worst, fabs(phi_B1_y));
    return 0;
}
