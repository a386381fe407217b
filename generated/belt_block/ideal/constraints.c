/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->block_mass_;
    m[1] = p->block_mass_;
    m[2] = p->block_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double block_y_ = q[1];
    const double block_theta_ = q[2];

    /* rows */
    phi[0] = block_y_;  /* guide.offset, m */
    phi[1] = block_theta_;  /* guide.angle, rad */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t, (void)q, (void)p;
    /* non-zeros */
    phi_q[1] = 1.0;  /* d guide.offset / d block_y_ */
    phi_q[5] = 1.0;  /* d guide.angle / d block_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* guide.offset, m/s */
    nu[1] = 0.0;  /* guide.angle, rad/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t, (void)q, (void)v, (void)p;
    /* rows */
    gamma_rows[0] = 0.0;  /* guide.offset, m/s^2 */
    gamma_rows[1] = 0.0;  /* guide.angle, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess, (void)rates;
    /* start */
    set[0] = p->set_block_x_;  /* start.set.block.x */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques;
    /* coordinates, velocities, time */
    const double block_x_ = q[0];
    const double block_y_ = q[1];
    const double block_vx_ = v[0];
    const double block_vy_ = v[1];
    const double block_omega_ = v[2];

    /* directions, arms, drives */
    const double spring_span_x_ = block_x_ - p->wall_x_;
    const double spring_length_ = sqrt((block_y_ * block_y_) + (spring_span_x_ * spring_span_x_));
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);

    /* multipliers */
    const double multiplier_guide_offset_ = lambda[0];
    const double multiplier_guide_angle_ = lambda[1];

    /* reactions */
    reactions[0] = 0.0;  /* guide.Fx */
    reactions[1] = -multiplier_guide_offset_;  /* guide.Fy */
    reactions[2] = -multiplier_guide_angle_;  /* guide.M */
    series[0] = spring_force_;  /* spring.F */
    series[1] = spring_length_;  /* spring.length */

    /* energy */
    energy[0] = 0.5*p->block_inertia_*(block_omega_ * block_omega_) + 0.5*p->block_mass_*(block_vx_ * block_vx_)
        + 0.5*p->block_mass_*(block_vy_ * block_vy_);
    energy[1] = 0.5*p->spring_stiffness_*((-p->spring_free_length_ + spring_length_)
        * (-p->spring_free_length_ + spring_length_));
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->block_mass_, other->block_mass_)
        && is_same_number(p->block_inertia_, other->block_inertia_)
        && is_same_number(p->set_block_x_, other->set_block_x_);
}
