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
    const double dq_acceleration_arm_theta = 0.0;

    /* backward substitution */
    const double dv_acceleration_arm_theta = 0.0;

    /* results */
    dq[0] = dq_acceleration_arm_theta;
    dv[0] = dv_acceleration_arm_theta;
    *worst = 0.0;
    return 0;
}
