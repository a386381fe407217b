/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double block_y = q[1];
    const double block_theta = q[2];
    const double block_vy = v[1];
    const double block_omega = v[2];

    /* parameters */
    const double inverse_block_mass = p->inverse_block_mass;
    const double inverse_block_inertia = p->inverse_block_inertia;

    /* Phi and Phi_dot */
    const double phi_guide_offset_2 = block_y;
    const double phi_dot_guide_offset_2 = block_vy;
    const double phi_guide_angle_2 = block_theta;
    const double phi_dot_guide_angle_2 = block_omega;

    /* L D L^T of the KKT matrix */
    const double scale_guide_offset_3 = inverse_block_mass;
    if (!(scale_guide_offset_3 > 1e-13 * scale_guide_offset_3)) return 1;
    const double inverse_pivot_guide_offset_3 = 1.0/scale_guide_offset_3;
    const double scale_guide_angle_3 = inverse_block_inertia;
    if (!(scale_guide_angle_3 > 1e-13 * scale_guide_angle_3)) return 2;
    const double inverse_pivot_guide_angle_3 = 1.0/scale_guide_angle_3;

    /* backward substitution */
    const double dq_lambda_guide_angle = -inverse_pivot_guide_angle_3*phi_guide_angle_2;
    const double dq_acceleration_block_theta = -dq_lambda_guide_angle*inverse_block_inertia;
    const double dq_lambda_guide_offset = -inverse_pivot_guide_offset_3*phi_guide_offset_2;
    const double dq_acceleration_block_y = -dq_lambda_guide_offset*inverse_block_mass;
    const double dq_acceleration_block_x = 0.0;

    /* backward substitution */
    const double dv_lambda_guide_angle = -inverse_pivot_guide_angle_3*phi_dot_guide_angle_2;
    const double dv_acceleration_block_theta = -dv_lambda_guide_angle*inverse_block_inertia;
    const double dv_lambda_guide_offset = -inverse_pivot_guide_offset_3*phi_dot_guide_offset_2;
    const double dv_acceleration_block_y = -dv_lambda_guide_offset*inverse_block_mass;
    const double dv_acceleration_block_x = 0.0;

    /* results */
    dq[0] = dq_acceleration_block_x;
    dv[0] = dv_acceleration_block_x;
    dq[1] = dq_acceleration_block_y;
    dv[1] = dv_acceleration_block_y;
    dq[2] = dq_acceleration_block_theta;
    dv[2] = dv_acceleration_block_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_guide_offset_2), *worst);
    *worst = fmax(fabs(phi_guide_angle_2), *worst);
    return 0;
}

