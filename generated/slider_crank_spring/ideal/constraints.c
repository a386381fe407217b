/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank_mass_;
    m[1] = p->crank_mass_;
    m[2] = p->crank_inertia_;
    m[3] = p->rod_mass_;
    m[4] = p->rod_mass_;
    m[5] = p->rod_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_x_ = q[0];
    const double crank_y_ = q[1];
    const double crank_theta_ = q[2];
    const double rod_x_ = q[3];
    const double rod_y_ = q[4];
    const double rod_theta_ = q[5];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double arm_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_crankpin_x_ = cos_theta_rod_*p->rod_points_crankpin_x_;
    const double arm_rod_crankpin_y_ = p->rod_points_crankpin_x_*sin_theta_rod_;

    /* rows */
    phi[0] = -crank_x_;  /* O.x, m */
    phi[1] = -crank_y_;  /* O.y, m */
    phi[2] = arm_crank_head_x_ - arm_rod_crankpin_x_ + crank_x_ - rod_x_;  /* pin.x, m */
    phi[3] = arm_crank_head_y_ - arm_rod_crankpin_y_ + crank_y_ - rod_y_;  /* pin.y, m */
    phi[4] = rod_y_;  /* slider.offset, m */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[2];
    const double rod_theta_ = q[5];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double arm_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_crankpin_x_ = cos_theta_rod_*p->rod_points_crankpin_x_;
    const double arm_rod_crankpin_y_ = p->rod_points_crankpin_x_*sin_theta_rod_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d crank_x_ */
    phi_q[7] = -1.0;  /* d O.y / d crank_y_ */
    phi_q[12] = 1.0;  /* d pin.x / d crank_x_ */
    phi_q[14] = -arm_crank_head_y_;  /* d pin.x / d crank_theta_ */
    phi_q[15] = -1.0;  /* d pin.x / d rod_x_ */
    phi_q[17] = arm_rod_crankpin_y_;  /* d pin.x / d rod_theta_ */
    phi_q[19] = 1.0;  /* d pin.y / d crank_y_ */
    phi_q[20] = arm_crank_head_x_;  /* d pin.y / d crank_theta_ */
    phi_q[22] = -1.0;  /* d pin.y / d rod_y_ */
    phi_q[23] = -arm_rod_crankpin_x_;  /* d pin.y / d rod_theta_ */
    phi_q[28] = 1.0;  /* d slider.offset / d rod_y_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* O.x, m/s */
    nu[1] = 0.0;  /* O.y, m/s */
    nu[2] = 0.0;  /* pin.x, m/s */
    nu[3] = 0.0;  /* pin.y, m/s */
    nu[4] = 0.0;  /* slider.offset, m/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[2];
    const double crank_omega_ = v[2];
    const double rod_theta_ = q[5];
    const double rod_omega_ = v[5];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double arm_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_crankpin_x_ = cos_theta_rod_*p->rod_points_crankpin_x_;
    const double arm_rod_crankpin_y_ = p->rod_points_crankpin_x_*sin_theta_rod_;

    /* rows */
    gamma_rows[0] = 0.0;  /* O.x, m/s^2 */
    gamma_rows[1] = 0.0;  /* O.y, m/s^2 */
    /* pin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x_*(crank_omega_ * crank_omega_) - arm_rod_crankpin_x_*(rod_omega_ * rod_omega_);
    /* pin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y_*(crank_omega_ * crank_omega_) - arm_rod_crankpin_y_*(rod_omega_ * rod_omega_);
    gamma_rows[4] = 0.0;  /* slider.offset, m/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    /* start */
    guess[0] = p->guess_rod_theta_;  /* start.guess.rod.theta */
    guess[1] = p->guess_rod_x_;  /* start.guess.rod.x */
    set[0] = p->set_crank_theta_;  /* start.set.crank.theta */
    rates[0] = p->rates_crank_omega_;  /* start.rates.crank.omega */
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
    const double crank_x_ = q[0];
    const double crank_y_ = q[1];
    const double crank_theta_ = q[2];
    const double crank_vx_ = v[0];
    const double crank_vy_ = v[1];
    const double crank_omega_ = v[2];
    const double rod_x_ = q[3];
    const double rod_y_ = q[4];
    const double rod_theta_ = q[5];
    const double rod_vx_ = v[3];
    const double rod_vy_ = v[4];
    const double rod_omega_ = v[5];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const double arm_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const double arm_rod_middle_x_ = cos_theta_rod_*p->rod_points_middle_x_;
    const double arm_rod_middle_y_ = p->rod_points_middle_x_*sin_theta_rod_;
    const double coil_span_x_ = -arm_crank_middle_x_ + arm_rod_middle_x_ - crank_x_ + rod_x_;
    const double coil_span_y_ = -arm_crank_middle_y_ + arm_rod_middle_y_ - crank_y_ + rod_y_;
    const double coil_span_rate_x_ = arm_crank_middle_y_*crank_omega_ - arm_rod_middle_y_*rod_omega_ - crank_vx_
        + rod_vx_;
    const double coil_span_rate_y_ = -arm_crank_middle_x_*crank_omega_ + arm_rod_middle_x_*rod_omega_ - crank_vy_
        + rod_vy_;
    const double coil_length_ = sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const double coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const double coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);

    /* multipliers */
    const double multiplier_O_x_ = lambda[0];
    const double multiplier_O_y_ = lambda[1];
    const double multiplier_pin_x_ = lambda[2];
    const double multiplier_pin_y_ = lambda[3];
    const double multiplier_slider_offset_ = lambda[4];

    /* reactions */
    reactions[0] = multiplier_O_x_;  /* O.Fx */
    reactions[1] = multiplier_O_y_;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_pin_x_;  /* pin.Fx */
    reactions[4] = multiplier_pin_y_;  /* pin.Fy */
    reactions[5] = 0.0;  /* pin.M */
    reactions[6] = 0.0;  /* slider.Fx */
    reactions[7] = multiplier_slider_offset_;  /* slider.Fy */
    reactions[8] = 0.0;  /* slider.M */
    series[0] = coil_force_;  /* coil.F */
    series[1] = coil_length_;  /* coil.length */
    series[2] = p->push_value_x_;  /* push.Fx */
    series[3] = 0.0;  /* push.Fy */
    series[4] = fabs(p->push_value_x_);  /* push.F */

    /* energy */
    energy[0] = 0.5*p->crank_inertia_*(crank_omega_ * crank_omega_) + 0.5*p->crank_mass_*(crank_vx_ * crank_vx_)
        + 0.5*p->crank_mass_*(crank_vy_ * crank_vy_) + 0.5*p->rod_inertia_*(rod_omega_ * rod_omega_)
        + 0.5*p->rod_mass_*(rod_vx_ * rod_vx_) + 0.5*p->rod_mass_*(rod_vy_ * rod_vy_);
    energy[1] = 0.5*p->coil_stiffness_*((-p->coil_free_length_ + coil_length_)
        * (-p->coil_free_length_ + coil_length_));
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->crank_mass_, other->crank_mass_)
        && is_same_number(p->crank_inertia_, other->crank_inertia_)
        && is_same_number(p->rod_mass_, other->rod_mass_)
        && is_same_number(p->rod_inertia_, other->rod_inertia_)
        && is_same_number(p->crank_length_, other->crank_length_)
        && is_same_number(p->rod_points_crankpin_x_, other->rod_points_crankpin_x_)
        && is_same_number(p->guess_rod_theta_, other->guess_rod_theta_)
        && is_same_number(p->guess_rod_x_, other->guess_rod_x_)
        && is_same_number(p->set_crank_theta_, other->set_crank_theta_)
        && is_same_number(p->rates_crank_omega_, other->rates_crank_omega_);
}
