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
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* parameters */
    const double crank_length = p->crank_length;
    const double rod_com_span_x = p->rod_com_span_x;
    const double inertia_crank_rod = p->inertia_crank_rod;
    const double mass_rod_rod = p->mass_rod_rod;
    const double inverse_mass_crank_crank = p->inverse_mass_crank_crank;

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_x = cos_theta_crank*crank_length;
    const double span_crank_head_y = crank_length*sin_theta_crank;
    const double span_rod_com_x = cos_theta_rod*rod_com_span_x;
    const double span_rod_com_y = rod_com_span_x*sin_theta_rod;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double dot_crank_rod = cos_rod_less_crank*inertia_crank_rod;

    /* Phi and Phi_dot */
    const double phi_slider_offset = span_crank_head_y + span_rod_com_y;
    const double phi_dot_slider_offset = crank_omega*span_crank_head_x + rod_omega*span_rod_com_x;

    /* L D L^T of the KKT matrix */
    const double l_rod_theta__crank_theta_4 = dot_crank_rod*inverse_mass_crank_crank;
    const double l_slider_offset__crank_theta_4 = inverse_mass_crank_crank*span_crank_head_x;
    const double inverse_pivot_rod_theta_4 = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta_4 + mass_rod_rod);
    const double w_slider_offset__rod_theta_3 = -dot_crank_rod*l_slider_offset__crank_theta_4 +
        span_rod_com_x;
    const double l_slider_offset__rod_theta_4 = inverse_pivot_rod_theta_4*w_slider_offset__rod_theta_3;
    const double scale_slider_offset_4 = l_slider_offset__crank_theta_4*span_crank_head_x +
        l_slider_offset__rod_theta_4*w_slider_offset__rod_theta_3;
    if (!(scale_slider_offset_4 > 1e-10 * scale_slider_offset_4)) return 1;
    const double inverse_pivot_slider_offset_4 = 1.0/scale_slider_offset_4;

    /* backward substitution */
    const double dq_lambda_slider_offset = -inverse_pivot_slider_offset_4*phi_slider_offset;
    const double dq_acceleration_rod_theta = -dq_lambda_slider_offset*l_slider_offset__rod_theta_4;
    const double dq_acceleration_crank_theta = -dq_acceleration_rod_theta*l_rod_theta__crank_theta_4 -
        dq_lambda_slider_offset*l_slider_offset__crank_theta_4;

    /* backward substitution */
    const double dv_lambda_slider_offset = -inverse_pivot_slider_offset_4*phi_dot_slider_offset;
    const double dv_acceleration_rod_theta = -dv_lambda_slider_offset*l_slider_offset__rod_theta_4;
    const double dv_acceleration_crank_theta = -dv_acceleration_rod_theta*l_rod_theta__crank_theta_4 -
        dv_lambda_slider_offset*l_slider_offset__crank_theta_4;

    /* results */
    dq[0] = dq_acceleration_crank_theta;
    dv[0] = dv_acceleration_crank_theta;
    dq[1] = dq_acceleration_rod_theta;
    dv[1] = dv_acceleration_rod_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_slider_offset));
    return 0;
}
