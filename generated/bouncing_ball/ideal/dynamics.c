/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* coordinates, velocities, time */
    const double ball_x = q[0];
    const double ball_y = q[1];
    const double ball_vx = v[0];
    const double ball_vy = v[1];

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_fall_x = -ball_x;
    const double phi_dot_fall_x = -ball_vx;
    const double rhs_fall_x = -p->beta_squared*phi_fall_x - phi_dot_fall_x*p->two_alpha;
    aside->phi[0] = phi_fall_x;
    aside->phi_dot[0] = phi_dot_fall_x;
    const double phi_fall_y = -ball_y;
    const double phi_dot_fall_y = -ball_vy;
    const double rhs_fall_y = -p->beta_squared*phi_fall_y - phi_dot_fall_y*p->two_alpha;
    aside->phi[1] = phi_fall_y;
    aside->phi_dot[1] = phi_dot_fall_y;

    /* L D L^T of the KKT matrix */
    const double scale_fall_x = p->inverse_ball_mass;
    if (!(scale_fall_x > 0.0 && scale_fall_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_fall_x = 1.0/scale_fall_x;
    const double scale_fall_y = p->inverse_ball_mass;
    if (!(scale_fall_y > 0.0 && scale_fall_y < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_pivot_fall_y = 1.0/scale_fall_y;

    /* forward substitution */
    const double z_fall_y = p->inverse_ball_mass*p->weight_ball_y + rhs_fall_y;

    /* backward substitution */
    const double lambda_fall_y = -inverse_pivot_fall_y*z_fall_y;
    const double acceleration_ball_y = p->inverse_ball_mass*lambda_fall_y + p->inverse_ball_mass*p->weight_ball_y;
    const double lambda_fall_x = -inverse_pivot_fall_x*rhs_fall_x;
    const double acceleration_ball_x = p->inverse_ball_mass*lambda_fall_x;
    const double acceleration_ball_theta = 0.0;

    /* results */
    a[0] = acceleration_ball_x;
    a[1] = acceleration_ball_y;
    a[2] = acceleration_ball_theta;
    aside->lambda[0] = lambda_fall_x;
    aside->lambda[1] = lambda_fall_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_ball_y;
        force[2] = 0.0;
        rhs[0] = rhs_fall_x;
        rhs[1] = rhs_fall_y;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
