/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->ball_mass_;
    m[1] = p->ball_mass_;
    m[2] = p->ball_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double ball_x_ = q[0];
    const double ball_y_ = q[1];

    /* rows */
    phi[0] = -ball_x_;  /* fall.x, m */
    phi[1] = -ball_y_;  /* fall.y, m */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t, (void)q, (void)p;
    /* non-zeros */
    phi_q[0] = -1.0;  /* d fall.x / d ball_x_ */
    phi_q[4] = -1.0;  /* d fall.y / d ball_y_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* fall.x, m/s */
    nu[1] = 0.0;  /* fall.y, m/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t, (void)q, (void)v, (void)p;
    /* rows */
    gamma_rows[0] = 0.0;  /* fall.x, m/s^2 */
    gamma_rows[1] = 0.0;  /* fall.y, m/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)p, (void)guess, (void)set, (void)rates;
    /* this scene has none */
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
    const double ball_y_ = q[1];
    const double ball_vx_ = v[0];
    const double ball_vy_ = v[1];
    const double ball_omega_ = v[2];

    /* multipliers */
    const double multiplier_fall_x_ = lambda[0];
    const double multiplier_fall_y_ = lambda[1];

    /* reactions */
    reactions[0] = multiplier_fall_x_;  /* fall.Fx */
    reactions[1] = multiplier_fall_y_;  /* fall.Fy */
    reactions[2] = 0.0;  /* fall.M */

    /* energy */
    energy[0] = 0.5*p->ball_inertia_*(ball_omega_ * ball_omega_) + 0.5*p->ball_mass_*(ball_vx_ * ball_vx_)
        + 0.5*p->ball_mass_*(ball_vy_ * ball_vy_);
    energy[1] = -p->ball_mass_*ball_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->ball_mass_, other->ball_mass_)
        && is_same_number(p->ball_inertia_, other->ball_inertia_);
}
