/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank_mass_;
    m[1] = p->crank_mass_;
    m[2] = p->crank_inertia_;
    m[3] = p->coupler_mass_;
    m[4] = p->coupler_mass_;
    m[5] = p->coupler_inertia_;
    m[6] = p->rocker_mass_;
    m[7] = p->rocker_mass_;
    m[8] = p->rocker_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double crank_x_ = q[0];
    const double crank_y_ = q[1];
    const double crank_theta_ = q[2];
    const double coupler_x_ = q[3];
    const double coupler_y_ = q[4];
    const double coupler_theta_ = q[5];
    const double rocker_x_ = q[6];
    const double rocker_y_ = q[7];
    const double rocker_theta_ = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_coupler_ = cos(coupler_theta_);
    const double sin_theta_coupler_ = sin(coupler_theta_);
    const double arm_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double arm_coupler_head_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double cos_theta_rocker_ = cos(rocker_theta_);
    const double sin_theta_rocker_ = sin(rocker_theta_);
    const double arm_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double arm_rocker_head_y_ = p->rocker_head_s_x_*sin_theta_rocker_;
    const double motor_value_ = p->omega_*t + PI/2.0;

    /* rows */
    phi[0] = arm_crank_head_x_ - crank_x_;  /* A0.x, m */
    phi[1] = arm_crank_head_y_ - crank_y_;  /* A0.y, m */
    phi[2] = arm_coupler_head_x_ + arm_crank_head_x_ - coupler_x_ + crank_x_;  /* A.x, m */
    phi[3] = arm_coupler_head_y_ + arm_crank_head_y_ - coupler_y_ + crank_y_;  /* A.y, m */
    phi[4] = arm_coupler_head_x_ - arm_rocker_head_x_ + coupler_x_ - rocker_x_;  /* B.x, m */
    phi[5] = arm_coupler_head_y_ - arm_rocker_head_y_ + coupler_y_ - rocker_y_;  /* B.y, m */
    phi[6] = p->B0_x_ + arm_rocker_head_x_ - rocker_x_;  /* B0.x, m */
    phi[7] = arm_rocker_head_y_ - rocker_y_;  /* B0.y, m */
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
    const double coupler_theta_ = q[5];
    const double rocker_theta_ = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_coupler_ = cos(coupler_theta_);
    const double sin_theta_coupler_ = sin(coupler_theta_);
    const double arm_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double arm_coupler_head_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double cos_theta_rocker_ = cos(rocker_theta_);
    const double sin_theta_rocker_ = sin(rocker_theta_);
    const double arm_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double arm_rocker_head_y_ = p->rocker_head_s_x_*sin_theta_rocker_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d A0.x / d crank_x_ */
    phi_q[2] = -arm_crank_head_y_;  /* d A0.x / d crank_theta_ */
    phi_q[10] = -1.0;  /* d A0.y / d crank_y_ */
    phi_q[11] = arm_crank_head_x_;  /* d A0.y / d crank_theta_ */
    phi_q[18] = 1.0;  /* d A.x / d crank_x_ */
    phi_q[20] = -arm_crank_head_y_;  /* d A.x / d crank_theta_ */
    phi_q[21] = -1.0;  /* d A.x / d coupler_x_ */
    phi_q[23] = -arm_coupler_head_y_;  /* d A.x / d coupler_theta_ */
    phi_q[28] = 1.0;  /* d A.y / d crank_y_ */
    phi_q[29] = arm_crank_head_x_;  /* d A.y / d crank_theta_ */
    phi_q[31] = -1.0;  /* d A.y / d coupler_y_ */
    phi_q[32] = arm_coupler_head_x_;  /* d A.y / d coupler_theta_ */
    phi_q[39] = 1.0;  /* d B.x / d coupler_x_ */
    phi_q[41] = -arm_coupler_head_y_;  /* d B.x / d coupler_theta_ */
    phi_q[42] = -1.0;  /* d B.x / d rocker_x_ */
    phi_q[44] = arm_rocker_head_y_;  /* d B.x / d rocker_theta_ */
    phi_q[49] = 1.0;  /* d B.y / d coupler_y_ */
    phi_q[50] = arm_coupler_head_x_;  /* d B.y / d coupler_theta_ */
    phi_q[52] = -1.0;  /* d B.y / d rocker_y_ */
    phi_q[53] = -arm_rocker_head_x_;  /* d B.y / d rocker_theta_ */
    phi_q[60] = -1.0;  /* d B0.x / d rocker_x_ */
    phi_q[62] = -arm_rocker_head_y_;  /* d B0.x / d rocker_theta_ */
    phi_q[70] = -1.0;  /* d B0.y / d rocker_y_ */
    phi_q[71] = arm_rocker_head_x_;  /* d B0.y / d rocker_theta_ */
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
    nu[0] = 0.0;  /* A0.x, m/s */
    nu[1] = 0.0;  /* A0.y, m/s */
    nu[2] = 0.0;  /* A.x, m/s */
    nu[3] = 0.0;  /* A.y, m/s */
    nu[4] = 0.0;  /* B.x, m/s */
    nu[5] = 0.0;  /* B.y, m/s */
    nu[6] = 0.0;  /* B0.x, m/s */
    nu[7] = 0.0;  /* B0.y, m/s */
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
    const double coupler_theta_ = q[5];
    const double coupler_omega_ = v[5];
    const double rocker_theta_ = q[8];
    const double rocker_omega_ = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_coupler_ = cos(coupler_theta_);
    const double sin_theta_coupler_ = sin(coupler_theta_);
    const double arm_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double arm_coupler_head_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double cos_theta_rocker_ = cos(rocker_theta_);
    const double sin_theta_rocker_ = sin(rocker_theta_);
    const double arm_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double arm_rocker_head_y_ = p->rocker_head_s_x_*sin_theta_rocker_;
    const double motor_acceleration_ = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x_*(crank_omega_ * crank_omega_);  /* A0.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y_*(crank_omega_ * crank_omega_);  /* A0.y, m/s^2 */
    /* A.x, m/s^2 */
    gamma_rows[2] = arm_coupler_head_x_*(coupler_omega_ * coupler_omega_)
        + arm_crank_head_x_*(crank_omega_ * crank_omega_);
    /* A.y, m/s^2 */
    gamma_rows[3] = arm_coupler_head_y_*(coupler_omega_ * coupler_omega_)
        + arm_crank_head_y_*(crank_omega_ * crank_omega_);
    /* B.x, m/s^2 */
    gamma_rows[4] = arm_coupler_head_x_*(coupler_omega_ * coupler_omega_)
        - arm_rocker_head_x_*(rocker_omega_ * rocker_omega_);
    /* B.y, m/s^2 */
    gamma_rows[5] = arm_coupler_head_y_*(coupler_omega_ * coupler_omega_)
        - arm_rocker_head_y_*(rocker_omega_ * rocker_omega_);
    gamma_rows[6] = arm_rocker_head_x_*(rocker_omega_ * rocker_omega_);  /* B0.x, m/s^2 */
    gamma_rows[7] = arm_rocker_head_y_*(rocker_omega_ * rocker_omega_);  /* B0.y, m/s^2 */
    gamma_rows[8] = motor_acceleration_;  /* motor, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_coupler_theta_;  /* start.guess.coupler.theta */
    guess[1] = p->guess_rocker_theta_;  /* start.guess.rocker.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)series;
    /* coordinates, velocities, time */
    const double crank_y_ = q[1];
    const double crank_vx_ = v[0];
    const double crank_vy_ = v[1];
    const double crank_omega_ = v[2];
    const double coupler_y_ = q[4];
    const double coupler_vx_ = v[3];
    const double coupler_vy_ = v[4];
    const double coupler_omega_ = v[5];
    const double rocker_y_ = q[7];
    const double rocker_vx_ = v[6];
    const double rocker_vy_ = v[7];
    const double rocker_omega_ = v[8];

    /* multipliers */
    const double multiplier_A0_x_ = lambda[0];
    const double multiplier_A0_y_ = lambda[1];
    const double multiplier_A_x_ = lambda[2];
    const double multiplier_A_y_ = lambda[3];
    const double multiplier_B_x_ = lambda[4];
    const double multiplier_B_y_ = lambda[5];
    const double multiplier_B0_x_ = lambda[6];
    const double multiplier_B0_y_ = lambda[7];
    const double multiplier_motor_ = lambda[8];

    /* reactions */
    reactions[0] = multiplier_A0_x_;  /* A0.Fx */
    reactions[1] = multiplier_A0_y_;  /* A0.Fy */
    reactions[2] = 0.0;  /* A0.M */
    reactions[3] = multiplier_A_x_;  /* A.Fx */
    reactions[4] = multiplier_A_y_;  /* A.Fy */
    reactions[5] = 0.0;  /* A.M */
    reactions[6] = multiplier_B_x_;  /* B.Fx */
    reactions[7] = multiplier_B_y_;  /* B.Fy */
    reactions[8] = 0.0;  /* B.M */
    reactions[9] = multiplier_B0_x_;  /* B0.Fx */
    reactions[10] = multiplier_B0_y_;  /* B0.Fy */
    reactions[11] = 0.0;  /* B0.M */
    torques[0] = -multiplier_motor_;  /* motor */

    /* energy */
    energy[0] = 0.5*p->coupler_inertia_*(coupler_omega_ * coupler_omega_)
        + 0.5*p->coupler_mass_*(coupler_vx_ * coupler_vx_) + 0.5*p->coupler_mass_*(coupler_vy_ * coupler_vy_)
        + 0.5*p->crank_inertia_*(crank_omega_ * crank_omega_) + 0.5*p->crank_mass_*(crank_vx_ * crank_vx_)
        + 0.5*p->crank_mass_*(crank_vy_ * crank_vy_) + 0.5*p->rocker_inertia_*(rocker_omega_ * rocker_omega_)
        + 0.5*p->rocker_mass_*(rocker_vx_ * rocker_vx_) + 0.5*p->rocker_mass_*(rocker_vy_ * rocker_vy_);
    energy[1] = -p->coupler_mass_*coupler_y_*p->gravity_y_ - p->crank_mass_*crank_y_*p->gravity_y_
        - p->rocker_mass_*rocker_y_*p->gravity_y_;
}
