/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];
    const double bob_vx = v[0];
    const double bob_vy = v[1];

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_rod_length = (bob_x * bob_x)*p->rod_half_inverse_length
        + (bob_y * bob_y)*p->rod_half_inverse_length - 0.5*p->rod_length;
    const double phi_dot_rod_length = 2.0*bob_vx*bob_x*p->rod_half_inverse_length
        + 2.0*bob_vy*bob_y*p->rod_half_inverse_length;
    const double rhs_rod_length = -p->beta_squared*phi_rod_length - 2.0*(bob_vx * bob_vx)*p->rod_half_inverse_length
        - 2.0*(bob_vy * bob_vy)*p->rod_half_inverse_length - phi_dot_rod_length*p->two_alpha;
    aside->phi[0] = phi_rod_length;
    aside->phi_dot[0] = phi_dot_rod_length;

    /* L D L^T of the KKT matrix */
    const double w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const double l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const double w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const double l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const double scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    if (!(scale_rod_length > 0.0 && scale_rod_length < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* forward substitution */
    const double z_rod_length = -l_rod_length__bob_y*p->weight_bob_y + rhs_rod_length;

    /* backward substitution */
    const double lambda_rod_length = -inverse_pivot_rod_length*z_rod_length;
    const double acceleration_bob_y = p->inverse_bob_mass*p->weight_bob_y - l_rod_length__bob_y*lambda_rod_length;
    const double acceleration_bob_x = -l_rod_length__bob_x*lambda_rod_length;
    const double acceleration_bob_theta = 0.0;

    /* results */
    a[0] = acceleration_bob_x;
    a[1] = acceleration_bob_y;
    a[2] = acceleration_bob_theta;
    aside->lambda[0] = lambda_rod_length;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_bob_y;
        force[2] = 0.0;
        rhs[0] = rhs_rod_length;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
