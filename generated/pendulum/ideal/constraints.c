/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->bob_mass_;
    m[1] = p->bob_mass_;
    m[2] = p->bob_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];

    /* rows */
    /* rod.length, m */
    phi[0] = (bob_x_ * bob_x_)*p->rod_half_inverse_length_ + (bob_y_ * bob_y_)*p->rod_half_inverse_length_
        - 0.5*p->rod_length_;
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];

    /* non-zeros */
    phi_q[0] = 2.0*bob_x_*p->rod_half_inverse_length_;  /* d rod.length / d bob_x_ */
    phi_q[1] = 2.0*bob_y_*p->rod_half_inverse_length_;  /* d rod.length / d bob_y_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* rod.length, m/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t, (void)q;
    /* coordinates, velocities, time */
    const double bob_vx_ = v[0];
    const double bob_vy_ = v[1];

    /* rows */
    /* rod.length, m/s^2 */
    gamma_rows[0] = -2.0*(bob_vx_ * bob_vx_)*p->rod_half_inverse_length_
        - 2.0*(bob_vy_ * bob_vy_)*p->rod_half_inverse_length_;
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess;
    /* start */
    set[0] = p->set_bob_x_;  /* start.set.bob.x */
    set[1] = p->set_bob_theta_;  /* start.set.bob.theta */
    rates[0] = p->rates_bob_omega_;  /* start.rates.bob.omega */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques, (void)series;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];
    const double bob_vx_ = v[0];
    const double bob_vy_ = v[1];
    const double bob_omega_ = v[2];

    /* multipliers */
    const double multiplier_rod_length_ = lambda[0];

    /* reactions */
    reactions[0] = -2.0*bob_x_*multiplier_rod_length_*p->rod_half_inverse_length_;  /* rod.Fx */
    reactions[1] = -2.0*bob_y_*multiplier_rod_length_*p->rod_half_inverse_length_;  /* rod.Fy */
    reactions[2] = 0.0;  /* rod.M */

    /* energy */
    energy[0] = 0.5*p->bob_inertia_*(bob_omega_ * bob_omega_) + 0.5*p->bob_mass_*(bob_vx_ * bob_vx_)
        + 0.5*p->bob_mass_*(bob_vy_ * bob_vy_);
    energy[1] = -p->bob_mass_*bob_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->bob_mass_, other->bob_mass_)
        && is_same_number(p->bob_inertia_, other->bob_inertia_)
        && is_same_number(p->rod_length_, other->rod_length_)
        && is_same_number(p->rod_half_inverse_length_, other->rod_half_inverse_length_)
        && is_same_number(p->set_bob_x_, other->set_bob_x_)
        && is_same_number(p->set_bob_theta_, other->set_bob_theta_)
        && is_same_number(p->rates_bob_omega_, other->rates_bob_omega_);
}
