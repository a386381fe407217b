/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)q;
    (void)v;
    (void)memory;
    (void)p;
    /* backward substitution */
    const double dq_acceleration_ball_theta = 0.0;
    const double dq_acceleration_ball_y = 0.0;
    const double dq_acceleration_ball_x = 0.0;

    /* backward substitution */
    const double dv_acceleration_ball_theta = 0.0;
    const double dv_acceleration_ball_y = 0.0;
    const double dv_acceleration_ball_x = 0.0;

    /* results */
    dq[0] = dq_acceleration_ball_x;
    dv[0] = dv_acceleration_ball_x;
    dq[1] = dq_acceleration_ball_y;
    dv[1] = dv_acceleration_ball_y;
    dq[2] = dq_acceleration_ball_theta;
    dv[2] = dv_acceleration_ball_theta;
    *worst = 0.0;
    return 0;
}
