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
    m[6] = p->slider_mass_;
    m[7] = p->slider_mass_;
    m[8] = p->slider_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad. Rows marked 'open' or 'redundant' do not constrain the motion.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double crank_x_ = q[0];
    const double crank_y_ = q[1];
    const double crank_theta_ = q[2];
    const double rod_x_ = q[3];
    const double rod_y_ = q[4];
    const double rod_theta_ = q[5];
    const double slider_x_ = q[6];
    const double slider_y_ = q[7];
    const double slider_theta_ = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double motor_value_ = p->omega_*t;

    /* rows */
    phi[0] = arm_crank_head_x_ - crank_x_;  /* O.x, m */
    phi[1] = arm_crank_head_y_ - crank_y_;  /* O.y, m */
    phi[2] = arm_crank_head_x_ + arm_rod_head_x_ + crank_x_ - rod_x_;  /* crankpin.x, m */
    phi[3] = arm_crank_head_y_ + arm_rod_head_y_ + crank_y_ - rod_y_;  /* crankpin.y, m */
    phi[4] = arm_rod_head_x_ + rod_x_ - slider_x_;  /* wristpin.x, m; open, wristpin has play */
    phi[5] = arm_rod_head_y_ + rod_y_ - slider_y_;  /* wristpin.y, m; open, wristpin has play */
    phi[6] = slider_y_;  /* cylinder.offset, m */
    phi[7] = slider_theta_;  /* cylinder.angle, rad */
    phi[8] = crank_theta_ - motor_value_;  /* motor, rad */
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
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d crank_x_ */
    phi_q[2] = -arm_crank_head_y_;  /* d O.x / d crank_theta_ */
    phi_q[10] = -1.0;  /* d O.y / d crank_y_ */
    phi_q[11] = arm_crank_head_x_;  /* d O.y / d crank_theta_ */
    phi_q[18] = 1.0;  /* d crankpin.x / d crank_x_ */
    phi_q[20] = -arm_crank_head_y_;  /* d crankpin.x / d crank_theta_ */
    phi_q[21] = -1.0;  /* d crankpin.x / d rod_x_ */
    phi_q[23] = -arm_rod_head_y_;  /* d crankpin.x / d rod_theta_ */
    phi_q[28] = 1.0;  /* d crankpin.y / d crank_y_ */
    phi_q[29] = arm_crank_head_x_;  /* d crankpin.y / d crank_theta_ */
    phi_q[31] = -1.0;  /* d crankpin.y / d rod_y_ */
    phi_q[32] = arm_rod_head_x_;  /* d crankpin.y / d rod_theta_ */
    phi_q[39] = 1.0;  /* d wristpin.x / d rod_x_ */
    phi_q[41] = -arm_rod_head_y_;  /* d wristpin.x / d rod_theta_ */
    phi_q[42] = -1.0;  /* d wristpin.x / d slider_x_ */
    phi_q[49] = 1.0;  /* d wristpin.y / d rod_y_ */
    phi_q[50] = arm_rod_head_x_;  /* d wristpin.y / d rod_theta_ */
    phi_q[52] = -1.0;  /* d wristpin.y / d slider_y_ */
    phi_q[61] = 1.0;  /* d cylinder.offset / d slider_y_ */
    phi_q[71] = 1.0;  /* d cylinder.angle / d slider_theta_ */
    phi_q[74] = 1.0;  /* d motor / d crank_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q;
    /* directions, arms, drives */
    const double motor_rate_ = p->omega_;

    /* rows */
    nu[0] = 0.0;  /* O.x, m/s */
    nu[1] = 0.0;  /* O.y, m/s */
    nu[2] = 0.0;  /* crankpin.x, m/s */
    nu[3] = 0.0;  /* crankpin.y, m/s */
    nu[4] = 0.0;  /* wristpin.x, m/s; open, wristpin has play */
    nu[5] = 0.0;  /* wristpin.y, m/s; open, wristpin has play */
    nu[6] = 0.0;  /* cylinder.offset, m/s */
    nu[7] = 0.0;  /* cylinder.angle, rad/s */
    nu[8] = motor_rate_;  /* motor, rad/s */
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
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double motor_acceleration_ = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x_*(crank_omega_ * crank_omega_);  /* O.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y_*(crank_omega_ * crank_omega_);  /* O.y, m/s^2 */
    /* crankpin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x_*(crank_omega_ * crank_omega_) + arm_rod_head_x_*(rod_omega_ * rod_omega_);
    /* crankpin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y_*(crank_omega_ * crank_omega_) + arm_rod_head_y_*(rod_omega_ * rod_omega_);
    gamma_rows[4] = arm_rod_head_x_*(rod_omega_ * rod_omega_);  /* wristpin.x, m/s^2; open, wristpin has play */
    gamma_rows[5] = arm_rod_head_y_*(rod_omega_ * rod_omega_);  /* wristpin.y, m/s^2; open, wristpin has play */
    gamma_rows[6] = 0.0;  /* cylinder.offset, m/s^2 */
    gamma_rows[7] = 0.0;  /* cylinder.angle, rad/s^2 */
    gamma_rows[8] = motor_acceleration_;  /* motor, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_rod_theta_;  /* start.guess.rod.theta */
    guess[1] = p->guess_slider_x_;  /* start.guess.slider.x */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)q, (void)series;
    /* coordinates, velocities, time */
    const double crank_vx_ = v[0];
    const double crank_vy_ = v[1];
    const double crank_omega_ = v[2];
    const double rod_vx_ = v[3];
    const double rod_vy_ = v[4];
    const double rod_omega_ = v[5];
    const double slider_vx_ = v[6];
    const double slider_vy_ = v[7];
    const double slider_omega_ = v[8];

    /* multipliers */
    const double multiplier_O_x_ = lambda[0];
    const double multiplier_O_y_ = lambda[1];
    const double multiplier_crankpin_x_ = lambda[2];
    const double multiplier_crankpin_y_ = lambda[3];
    const double multiplier_cylinder_offset_ = lambda[4];
    const double multiplier_cylinder_angle_ = lambda[5];
    const double multiplier_motor_ = lambda[6];

    /* reactions */
    reactions[0] = multiplier_O_x_;  /* O.Fx */
    reactions[1] = multiplier_O_y_;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_crankpin_x_;  /* crankpin.Fx */
    reactions[4] = multiplier_crankpin_y_;  /* crankpin.Fy */
    reactions[5] = 0.0;  /* crankpin.M */
    reactions[6] = 0.0;  /* cylinder.Fx */
    reactions[7] = -multiplier_cylinder_offset_;  /* cylinder.Fy */
    reactions[8] = -multiplier_cylinder_angle_;  /* cylinder.M */
    torques[0] = -multiplier_motor_;  /* motor */

    /* energy */
    energy[0] = 0.5*p->crank_inertia_*(crank_omega_ * crank_omega_) + 0.5*p->crank_mass_*(crank_vx_ * crank_vx_)
        + 0.5*p->crank_mass_*(crank_vy_ * crank_vy_) + 0.5*p->rod_inertia_*(rod_omega_ * rod_omega_)
        + 0.5*p->rod_mass_*(rod_vx_ * rod_vx_) + 0.5*p->rod_mass_*(rod_vy_ * rod_vy_)
        + 0.5*p->slider_inertia_*(slider_omega_ * slider_omega_) + 0.5*p->slider_mass_*(slider_vx_ * slider_vx_)
        + 0.5*p->slider_mass_*(slider_vy_ * slider_vy_);
    energy[1] = 0.0;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->crank_mass_, other->crank_mass_)
        && is_same_number(p->crank_inertia_, other->crank_inertia_)
        && is_same_number(p->rod_mass_, other->rod_mass_)
        && is_same_number(p->rod_inertia_, other->rod_inertia_)
        && is_same_number(p->slider_mass_, other->slider_mass_)
        && is_same_number(p->slider_inertia_, other->slider_inertia_)
        && is_same_number(p->omega_, other->omega_)
        && is_same_number(p->crank_head_s_x_, other->crank_head_s_x_)
        && is_same_number(p->rod_head_s_x_, other->rod_head_s_x_)
        && is_same_number(p->guess_rod_theta_, other->guess_rod_theta_)
        && is_same_number(p->guess_slider_x_, other->guess_slider_x_);
}
