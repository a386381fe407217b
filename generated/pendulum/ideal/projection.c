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
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];

    /* parameters */
    const double rod_length = p->rod_length;
    const double rod_half_inverse_length = p->rod_half_inverse_length;
    const double inverse_bob_mass = p->inverse_bob_mass;

    /* Phi and Phi_dot */
    const double phi_rod_length = (bob_x * bob_x)*rod_half_inverse_length + (bob_y *
        bob_y)*rod_half_inverse_length - 0.5*rod_length;
    const double phi_dot_rod_length = 2.0*bob_x*bob_x_rate*rod_half_inverse_length +
        2.0*bob_y*bob_y_rate*rod_half_inverse_length;

    /* L D L^T of the KKT matrix */
    const double w_rod_length__bob_x_3 = 2.0*bob_x*rod_half_inverse_length;
    const double l_rod_length__bob_x_4 = inverse_bob_mass*w_rod_length__bob_x_3;
    const double w_rod_length__bob_y_3 = 2.0*bob_y*rod_half_inverse_length;
    const double l_rod_length__bob_y_4 = inverse_bob_mass*w_rod_length__bob_y_3;
    const double scale_rod_length_4 = l_rod_length__bob_x_4*w_rod_length__bob_x_3 +
        l_rod_length__bob_y_4*w_rod_length__bob_y_3;
    if (!(scale_rod_length_4 > 1e-10 * scale_rod_length_4)) return 1;
    const double inverse_pivot_rod_length_4 = 1.0/scale_rod_length_4;

    /* backward substitution */
    const double dq_lambda_rod_length = -inverse_pivot_rod_length_4*phi_rod_length;
    const double dq_acceleration_bob_y = -dq_lambda_rod_length*l_rod_length__bob_y_4;
    const double dq_acceleration_bob_x = -dq_lambda_rod_length*l_rod_length__bob_x_4;
    const double dq_acceleration_bob_theta = 0.0;

    /* backward substitution */
    const double dv_lambda_rod_length = -inverse_pivot_rod_length_4*phi_dot_rod_length;
    const double dv_acceleration_bob_y = -dv_lambda_rod_length*l_rod_length__bob_y_4;
    const double dv_acceleration_bob_x = -dv_lambda_rod_length*l_rod_length__bob_x_4;
    const double dv_acceleration_bob_theta = 0.0;

    /* results */
    dq[0] = dq_acceleration_bob_x;
    dv[0] = dv_acceleration_bob_x;
    dq[1] = dq_acceleration_bob_y;
    dv[1] = dv_acceleration_bob_y;
    dq[2] = dq_acceleration_bob_theta;
    dv[2] = dv_acceleration_bob_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_rod_length));
    return 0;
}
