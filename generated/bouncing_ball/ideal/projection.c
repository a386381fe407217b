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
    const double ball_x = q[0];
    const double ball_y = q[1];
    const double ball_vx = v[0];
    const double ball_vy = v[1];

    /* parameters */
    const double inverse_ball_mass = p->inverse_ball_mass;

    /* Phi and Phi_dot */
    const double phi_fall_x_2 = -ball_x;
    const double phi_dot_fall_x_2 = -ball_vx;
    const double phi_fall_y_2 = -ball_y;
    const double phi_dot_fall_y_2 = -ball_vy;

    /* L D L^T of the KKT matrix */
    const double scale_fall_x_3 = inverse_ball_mass;
    if (!(scale_fall_x_3 > 1e-13 * scale_fall_x_3)) return 1;
    const double inverse_pivot_fall_x_3 = 1.0/scale_fall_x_3;
    const double scale_fall_y_3 = inverse_ball_mass;
    if (!(scale_fall_y_3 > 1e-13 * scale_fall_y_3)) return 2;
    const double inverse_pivot_fall_y_3 = 1.0/scale_fall_y_3;

    /* backward substitution */
    const double dq_lambda_fall_y = -inverse_pivot_fall_y_3*phi_fall_y_2;
    const double dq_acceleration_ball_y = dq_lambda_fall_y*inverse_ball_mass;
    const double dq_lambda_fall_x = -inverse_pivot_fall_x_3*phi_fall_x_2;
    const double dq_acceleration_ball_x = dq_lambda_fall_x*inverse_ball_mass;
    const double dq_acceleration_ball_theta = 0.0;

    /* backward substitution */
    const double dv_lambda_fall_y = -inverse_pivot_fall_y_3*phi_dot_fall_y_2;
    const double dv_acceleration_ball_y = dv_lambda_fall_y*inverse_ball_mass;
    const double dv_lambda_fall_x = -inverse_pivot_fall_x_3*phi_dot_fall_x_2;
    const double dv_acceleration_ball_x = dv_lambda_fall_x*inverse_ball_mass;
    const double dv_acceleration_ball_theta = 0.0;

    /* results */
    dq[0] = dq_acceleration_ball_x;
    dv[0] = dv_acceleration_ball_x;
    dq[1] = dq_acceleration_ball_y;
    dv[1] = dv_acceleration_ball_y;
    dq[2] = dq_acceleration_ball_theta;
    dv[2] = dv_acceleration_ball_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_fall_x_2), *worst);
    *worst = fmax(fabs(phi_fall_y_2), *worst);
    return 0;
}

