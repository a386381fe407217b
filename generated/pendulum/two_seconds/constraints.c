/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->bob_mass;
    m[1] = p->bob_mass;
    m[2] = p->bob_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];

    /* rows */
    /* rod.length, m */
    phi[0] = (bob_x * bob_x)*p->rod_half_inverse_length + (bob_y * bob_y)*p->rod_half_inverse_length
        - 0.5*p->rod_length;
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];

    /* non-zeros */
    phi_q[0] = 2.0*bob_x*p->rod_half_inverse_length;  /* d rod.length / d bob_x */
    phi_q[1] = 2.0*bob_y*p->rod_half_inverse_length;  /* d rod.length / d bob_y */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* rod.length, m/s */
}

/*
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t, (void)q;
    /* coordinates, velocities, time */
    const double bob_vx = v[0];
    const double bob_vy = v[1];

    /* rows */
    /* rod.length, m/s^2 */
    gamma_rows[0] = -2.0*(bob_vx * bob_vx)*p->rod_half_inverse_length
        - 2.0*(bob_vy * bob_vy)*p->rod_half_inverse_length;
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess;
    /* start */
    set[0] = p->set_bob_x;  /* start.set.bob.x */
    set[1] = p->set_bob_theta;  /* start.set.bob.theta */
    rates[0] = p->rates_bob_omega;  /* start.rates.bob.omega */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques, (void)series;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];
    const double bob_vx = v[0];
    const double bob_vy = v[1];
    const double bob_omega = v[2];

    /* multipliers */
    const double multiplier_rod_length = lambda[0];

    /* reactions */
    reactions[0] = -2.0*bob_x*multiplier_rod_length*p->rod_half_inverse_length;  /* rod.Fx */
    reactions[1] = -2.0*bob_y*multiplier_rod_length*p->rod_half_inverse_length;  /* rod.Fy */
    reactions[2] = 0.0;  /* rod.M */

    /* energy */
    energy[0] = 0.5*p->bob_inertia*(bob_omega * bob_omega) + 0.5*p->bob_mass*(bob_vx * bob_vx)
        + 0.5*p->bob_mass*(bob_vy * bob_vy);
    energy[1] = -p->bob_mass*bob_y*p->gravity_y;
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->bob_mass, other->bob_mass)
        && same_number(p->bob_inertia, other->bob_inertia)
        && same_number(p->rod_length, other->rod_length)
        && same_number(p->rod_half_inverse_length, other->rod_half_inverse_length)
        && same_number(p->set_bob_x, other->set_bob_x)
        && same_number(p->set_bob_theta, other->set_bob_theta)
        && same_number(p->rates_bob_omega, other->rates_bob_omega);
}
