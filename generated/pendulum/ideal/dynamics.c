/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     bob.x; bob.y; lambda of rod.length; bob.theta.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];
    const double bob_vx_ = v[0];
    const double bob_vy_ = v[1];

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_rod_length_ = (bob_x_ * bob_x_)*p->rod_half_inverse_length_
        + (bob_y_ * bob_y_)*p->rod_half_inverse_length_ - 0.5*p->rod_length_;
    const double phi_dot_rod_length_ = 2.0*bob_vx_*bob_x_*p->rod_half_inverse_length_
        + 2.0*bob_vy_*bob_y_*p->rod_half_inverse_length_;
    const double rhs_rod_length_ = -p->beta_squared_*phi_rod_length_
        - 2.0*(bob_vx_ * bob_vx_)*p->rod_half_inverse_length_ - 2.0*(bob_vy_ * bob_vy_)*p->rod_half_inverse_length_
        - phi_dot_rod_length_*p->two_alpha_;
    rhs->phi[0] = phi_rod_length_;
    rhs->phi_dot[0] = phi_dot_rod_length_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_x_ = p->inverse_bob_mass_*w_rod_length_bob_x_;
    const double w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_y_ = p->inverse_bob_mass_*w_rod_length_bob_y_;
    const double scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    if (!(scale_rod_length_ > 0.0 && scale_rod_length_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* forward substitution */
    const double z_rod_length_ = -l_rod_length_bob_y_*p->weight_bob_y_ + rhs_rod_length_;

    /* backward substitution */
    const double acceleration_bob_theta_ = 0.0;
    const double lambda_rod_length_ = -inverse_pivot_rod_length_*z_rod_length_;
    const double acceleration_bob_y_ = p->inverse_bob_mass_*p->weight_bob_y_ - l_rod_length_bob_y_*lambda_rod_length_;
    const double acceleration_bob_x_ = -l_rod_length_bob_x_*lambda_rod_length_;

    /* results */
    a[0] = acceleration_bob_x_;
    a[1] = acceleration_bob_y_;
    a[2] = acceleration_bob_theta_;
    rhs->lambda[0] = lambda_rod_length_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_bob_y_;
        force[2] = 0.0;
        gamma_stab[0] = rhs_rod_length_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
