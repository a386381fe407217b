/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank0_mass_;
    m[1] = p->crank0_mass_;
    m[2] = p->crank0_inertia_;
    m[3] = p->crank1_mass_;
    m[4] = p->crank1_mass_;
    m[5] = p->crank1_inertia_;
    m[6] = p->crank2_mass_;
    m[7] = p->crank2_mass_;
    m[8] = p->crank2_inertia_;
    m[9] = p->coupler1_mass_;
    m[10] = p->coupler1_mass_;
    m[11] = p->coupler1_inertia_;
    m[12] = p->coupler2_mass_;
    m[13] = p->coupler2_mass_;
    m[14] = p->coupler2_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_x_ = q[0];
    const double crank0_y_ = q[1];
    const double crank0_theta_ = q[2];
    const double crank1_x_ = q[3];
    const double crank1_y_ = q[4];
    const double crank1_theta_ = q[5];
    const double crank2_x_ = q[6];
    const double crank2_y_ = q[7];
    const double crank2_theta_ = q[8];
    const double coupler1_x_ = q[9];
    const double coupler1_y_ = q[10];
    const double coupler1_theta_ = q[11];
    const double coupler2_x_ = q[12];
    const double coupler2_y_ = q[13];
    const double coupler2_theta_ = q[14];

    /* directions, arms, drives */
    const double cos_theta_crank0_ = cos(crank0_theta_);
    const double sin_theta_crank0_ = sin(crank0_theta_);
    const double arm_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_s_x_;
    const double arm_crank0_head_y_ = p->crank0_head_s_x_*sin_theta_crank0_;
    const double cos_theta_crank1_ = cos(crank1_theta_);
    const double sin_theta_crank1_ = sin(crank1_theta_);
    const double arm_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_s_x_;
    const double arm_crank1_head_y_ = p->crank1_head_s_x_*sin_theta_crank1_;
    const double cos_theta_crank2_ = cos(crank2_theta_);
    const double sin_theta_crank2_ = sin(crank2_theta_);
    const double arm_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_s_x_;
    const double arm_crank2_head_y_ = p->crank2_head_s_x_*sin_theta_crank2_;
    const double cos_theta_coupler1_ = cos(coupler1_theta_);
    const double sin_theta_coupler1_ = sin(coupler1_theta_);
    const double arm_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_s_x_;
    const double arm_coupler1_head_y_ = p->coupler1_head_s_x_*sin_theta_coupler1_;
    const double cos_theta_coupler2_ = cos(coupler2_theta_);
    const double sin_theta_coupler2_ = sin(coupler2_theta_);
    const double arm_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_s_x_;
    const double arm_coupler2_head_y_ = p->coupler2_head_s_x_*sin_theta_coupler2_;

    /* rows */
    phi[0] = arm_crank0_head_x_ - crank0_x_;  /* O0.x, m */
    phi[1] = arm_crank0_head_y_ - crank0_y_;  /* O0.y, m */
    phi[2] = p->O1_x_ + arm_crank1_head_x_ - crank1_x_;  /* O1.x, m */
    phi[3] = arm_crank1_head_y_ - crank1_y_;  /* O1.y, m */
    phi[4] = p->O2_x_ + arm_crank2_head_x_ - crank2_x_;  /* O2.x, m */
    phi[5] = arm_crank2_head_y_ - crank2_y_;  /* O2.y, m */
    phi[6] = arm_coupler1_head_x_ + arm_crank0_head_x_ - coupler1_x_ + crank0_x_;  /* A0.x, m */
    phi[7] = arm_coupler1_head_y_ + arm_crank0_head_y_ - coupler1_y_ + crank0_y_;  /* A0.y, m */
    phi[8] = arm_coupler1_head_x_ - arm_crank1_head_x_ + coupler1_x_ - crank1_x_;  /* B1.x, m */
    phi[9] = arm_coupler1_head_y_ - arm_crank1_head_y_ + coupler1_y_ - crank1_y_;  /* B1.y, m */
    phi[10] = arm_coupler2_head_x_ + arm_crank1_head_x_ - coupler2_x_ + crank1_x_;  /* A1.x, m */
    phi[11] = arm_coupler2_head_y_ + arm_crank1_head_y_ - coupler2_y_ + crank1_y_;  /* A1.y, m */
    phi[12] = arm_coupler2_head_x_ - arm_crank2_head_x_ + coupler2_x_ - crank2_x_;  /* B2.x, m */
    phi[13] = arm_coupler2_head_y_ - arm_crank2_head_y_ + coupler2_y_ - crank2_y_;  /* B2.y, m */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[2];
    const double crank1_theta_ = q[5];
    const double crank2_theta_ = q[8];
    const double coupler1_theta_ = q[11];
    const double coupler2_theta_ = q[14];

    /* directions, arms, drives */
    const double cos_theta_crank0_ = cos(crank0_theta_);
    const double sin_theta_crank0_ = sin(crank0_theta_);
    const double arm_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_s_x_;
    const double arm_crank0_head_y_ = p->crank0_head_s_x_*sin_theta_crank0_;
    const double cos_theta_crank1_ = cos(crank1_theta_);
    const double sin_theta_crank1_ = sin(crank1_theta_);
    const double arm_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_s_x_;
    const double arm_crank1_head_y_ = p->crank1_head_s_x_*sin_theta_crank1_;
    const double cos_theta_crank2_ = cos(crank2_theta_);
    const double sin_theta_crank2_ = sin(crank2_theta_);
    const double arm_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_s_x_;
    const double arm_crank2_head_y_ = p->crank2_head_s_x_*sin_theta_crank2_;
    const double cos_theta_coupler1_ = cos(coupler1_theta_);
    const double sin_theta_coupler1_ = sin(coupler1_theta_);
    const double arm_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_s_x_;
    const double arm_coupler1_head_y_ = p->coupler1_head_s_x_*sin_theta_coupler1_;
    const double cos_theta_coupler2_ = cos(coupler2_theta_);
    const double sin_theta_coupler2_ = sin(coupler2_theta_);
    const double arm_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_s_x_;
    const double arm_coupler2_head_y_ = p->coupler2_head_s_x_*sin_theta_coupler2_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O0.x / d crank0_x_ */
    phi_q[2] = -arm_crank0_head_y_;  /* d O0.x / d crank0_theta_ */
    phi_q[16] = -1.0;  /* d O0.y / d crank0_y_ */
    phi_q[17] = arm_crank0_head_x_;  /* d O0.y / d crank0_theta_ */
    phi_q[33] = -1.0;  /* d O1.x / d crank1_x_ */
    phi_q[35] = -arm_crank1_head_y_;  /* d O1.x / d crank1_theta_ */
    phi_q[49] = -1.0;  /* d O1.y / d crank1_y_ */
    phi_q[50] = arm_crank1_head_x_;  /* d O1.y / d crank1_theta_ */
    phi_q[66] = -1.0;  /* d O2.x / d crank2_x_ */
    phi_q[68] = -arm_crank2_head_y_;  /* d O2.x / d crank2_theta_ */
    phi_q[82] = -1.0;  /* d O2.y / d crank2_y_ */
    phi_q[83] = arm_crank2_head_x_;  /* d O2.y / d crank2_theta_ */
    phi_q[90] = 1.0;  /* d A0.x / d crank0_x_ */
    phi_q[92] = -arm_crank0_head_y_;  /* d A0.x / d crank0_theta_ */
    phi_q[99] = -1.0;  /* d A0.x / d coupler1_x_ */
    phi_q[101] = -arm_coupler1_head_y_;  /* d A0.x / d coupler1_theta_ */
    phi_q[106] = 1.0;  /* d A0.y / d crank0_y_ */
    phi_q[107] = arm_crank0_head_x_;  /* d A0.y / d crank0_theta_ */
    phi_q[115] = -1.0;  /* d A0.y / d coupler1_y_ */
    phi_q[116] = arm_coupler1_head_x_;  /* d A0.y / d coupler1_theta_ */
    phi_q[129] = 1.0;  /* d B1.x / d coupler1_x_ */
    phi_q[131] = -arm_coupler1_head_y_;  /* d B1.x / d coupler1_theta_ */
    phi_q[123] = -1.0;  /* d B1.x / d crank1_x_ */
    phi_q[125] = arm_crank1_head_y_;  /* d B1.x / d crank1_theta_ */
    phi_q[145] = 1.0;  /* d B1.y / d coupler1_y_ */
    phi_q[146] = arm_coupler1_head_x_;  /* d B1.y / d coupler1_theta_ */
    phi_q[139] = -1.0;  /* d B1.y / d crank1_y_ */
    phi_q[140] = -arm_crank1_head_x_;  /* d B1.y / d crank1_theta_ */
    phi_q[153] = 1.0;  /* d A1.x / d crank1_x_ */
    phi_q[155] = -arm_crank1_head_y_;  /* d A1.x / d crank1_theta_ */
    phi_q[162] = -1.0;  /* d A1.x / d coupler2_x_ */
    phi_q[164] = -arm_coupler2_head_y_;  /* d A1.x / d coupler2_theta_ */
    phi_q[169] = 1.0;  /* d A1.y / d crank1_y_ */
    phi_q[170] = arm_crank1_head_x_;  /* d A1.y / d crank1_theta_ */
    phi_q[178] = -1.0;  /* d A1.y / d coupler2_y_ */
    phi_q[179] = arm_coupler2_head_x_;  /* d A1.y / d coupler2_theta_ */
    phi_q[192] = 1.0;  /* d B2.x / d coupler2_x_ */
    phi_q[194] = -arm_coupler2_head_y_;  /* d B2.x / d coupler2_theta_ */
    phi_q[186] = -1.0;  /* d B2.x / d crank2_x_ */
    phi_q[188] = arm_crank2_head_y_;  /* d B2.x / d crank2_theta_ */
    phi_q[208] = 1.0;  /* d B2.y / d coupler2_y_ */
    phi_q[209] = arm_coupler2_head_x_;  /* d B2.y / d coupler2_theta_ */
    phi_q[202] = -1.0;  /* d B2.y / d crank2_y_ */
    phi_q[203] = -arm_crank2_head_x_;  /* d B2.y / d crank2_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* O0.x, m/s */
    nu[1] = 0.0;  /* O0.y, m/s */
    nu[2] = 0.0;  /* O1.x, m/s */
    nu[3] = 0.0;  /* O1.y, m/s */
    nu[4] = 0.0;  /* O2.x, m/s */
    nu[5] = 0.0;  /* O2.y, m/s */
    nu[6] = 0.0;  /* A0.x, m/s */
    nu[7] = 0.0;  /* A0.y, m/s */
    nu[8] = 0.0;  /* B1.x, m/s */
    nu[9] = 0.0;  /* B1.y, m/s */
    nu[10] = 0.0;  /* A1.x, m/s */
    nu[11] = 0.0;  /* A1.y, m/s */
    nu[12] = 0.0;  /* B2.x, m/s */
    nu[13] = 0.0;  /* B2.y, m/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[2];
    const double crank0_omega_ = v[2];
    const double crank1_theta_ = q[5];
    const double crank1_omega_ = v[5];
    const double crank2_theta_ = q[8];
    const double crank2_omega_ = v[8];
    const double coupler1_theta_ = q[11];
    const double coupler1_omega_ = v[11];
    const double coupler2_theta_ = q[14];
    const double coupler2_omega_ = v[14];

    /* directions, arms, drives */
    const double cos_theta_crank0_ = cos(crank0_theta_);
    const double sin_theta_crank0_ = sin(crank0_theta_);
    const double arm_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_s_x_;
    const double arm_crank0_head_y_ = p->crank0_head_s_x_*sin_theta_crank0_;
    const double cos_theta_crank1_ = cos(crank1_theta_);
    const double sin_theta_crank1_ = sin(crank1_theta_);
    const double arm_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_s_x_;
    const double arm_crank1_head_y_ = p->crank1_head_s_x_*sin_theta_crank1_;
    const double cos_theta_crank2_ = cos(crank2_theta_);
    const double sin_theta_crank2_ = sin(crank2_theta_);
    const double arm_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_s_x_;
    const double arm_crank2_head_y_ = p->crank2_head_s_x_*sin_theta_crank2_;
    const double cos_theta_coupler1_ = cos(coupler1_theta_);
    const double sin_theta_coupler1_ = sin(coupler1_theta_);
    const double arm_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_s_x_;
    const double arm_coupler1_head_y_ = p->coupler1_head_s_x_*sin_theta_coupler1_;
    const double cos_theta_coupler2_ = cos(coupler2_theta_);
    const double sin_theta_coupler2_ = sin(coupler2_theta_);
    const double arm_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_s_x_;
    const double arm_coupler2_head_y_ = p->coupler2_head_s_x_*sin_theta_coupler2_;

    /* rows */
    gamma_rows[0] = arm_crank0_head_x_*(crank0_omega_ * crank0_omega_);  /* O0.x, m/s^2 */
    gamma_rows[1] = arm_crank0_head_y_*(crank0_omega_ * crank0_omega_);  /* O0.y, m/s^2 */
    gamma_rows[2] = arm_crank1_head_x_*(crank1_omega_ * crank1_omega_);  /* O1.x, m/s^2 */
    gamma_rows[3] = arm_crank1_head_y_*(crank1_omega_ * crank1_omega_);  /* O1.y, m/s^2 */
    gamma_rows[4] = arm_crank2_head_x_*(crank2_omega_ * crank2_omega_);  /* O2.x, m/s^2 */
    gamma_rows[5] = arm_crank2_head_y_*(crank2_omega_ * crank2_omega_);  /* O2.y, m/s^2 */
    /* A0.x, m/s^2 */
    gamma_rows[6] = arm_coupler1_head_x_*(coupler1_omega_ * coupler1_omega_)
        + arm_crank0_head_x_*(crank0_omega_ * crank0_omega_);
    /* A0.y, m/s^2 */
    gamma_rows[7] = arm_coupler1_head_y_*(coupler1_omega_ * coupler1_omega_)
        + arm_crank0_head_y_*(crank0_omega_ * crank0_omega_);
    /* B1.x, m/s^2 */
    gamma_rows[8] = arm_coupler1_head_x_*(coupler1_omega_ * coupler1_omega_)
        - arm_crank1_head_x_*(crank1_omega_ * crank1_omega_);
    /* B1.y, m/s^2 */
    gamma_rows[9] = arm_coupler1_head_y_*(coupler1_omega_ * coupler1_omega_)
        - arm_crank1_head_y_*(crank1_omega_ * crank1_omega_);
    /* A1.x, m/s^2 */
    gamma_rows[10] = arm_coupler2_head_x_*(coupler2_omega_ * coupler2_omega_)
        + arm_crank1_head_x_*(crank1_omega_ * crank1_omega_);
    /* A1.y, m/s^2 */
    gamma_rows[11] = arm_coupler2_head_y_*(coupler2_omega_ * coupler2_omega_)
        + arm_crank1_head_y_*(crank1_omega_ * crank1_omega_);
    /* B2.x, m/s^2 */
    gamma_rows[12] = arm_coupler2_head_x_*(coupler2_omega_ * coupler2_omega_)
        - arm_crank2_head_x_*(crank2_omega_ * crank2_omega_);
    /* B2.y, m/s^2 */
    gamma_rows[13] = arm_coupler2_head_y_*(coupler2_omega_ * coupler2_omega_)
        - arm_crank2_head_y_*(crank2_omega_ * crank2_omega_);
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    /* start */
    guess[0] = p->guess_crank1_theta_;  /* start.guess.crank1.theta */
    guess[1] = p->guess_crank2_theta_;  /* start.guess.crank2.theta */
    guess[2] = p->guess_coupler1_theta_;  /* start.guess.coupler1.theta */
    guess[3] = p->guess_coupler2_theta_;  /* start.guess.coupler2.theta */
    set[0] = p->set_crank0_theta_;  /* start.set.crank0.theta */
    rates[0] = p->rates_crank0_omega_;  /* start.rates.crank0.omega */
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
    const double crank0_y_ = q[1];
    const double crank0_vx_ = v[0];
    const double crank0_vy_ = v[1];
    const double crank0_omega_ = v[2];
    const double crank1_y_ = q[4];
    const double crank1_vx_ = v[3];
    const double crank1_vy_ = v[4];
    const double crank1_omega_ = v[5];
    const double crank2_y_ = q[7];
    const double crank2_vx_ = v[6];
    const double crank2_vy_ = v[7];
    const double crank2_omega_ = v[8];
    const double coupler1_y_ = q[10];
    const double coupler1_vx_ = v[9];
    const double coupler1_vy_ = v[10];
    const double coupler1_omega_ = v[11];
    const double coupler2_y_ = q[13];
    const double coupler2_vx_ = v[12];
    const double coupler2_vy_ = v[13];
    const double coupler2_omega_ = v[14];

    /* multipliers */
    const double multiplier_O0_x_ = lambda[0];
    const double multiplier_O0_y_ = lambda[1];
    const double multiplier_O1_x_ = lambda[2];
    const double multiplier_O1_y_ = lambda[3];
    const double multiplier_O2_x_ = lambda[4];
    const double multiplier_O2_y_ = lambda[5];
    const double multiplier_A0_x_ = lambda[6];
    const double multiplier_A0_y_ = lambda[7];
    const double multiplier_B1_x_ = lambda[8];
    const double multiplier_B1_y_ = lambda[9];
    const double multiplier_A1_x_ = lambda[10];
    const double multiplier_A1_y_ = lambda[11];
    const double multiplier_B2_x_ = lambda[12];
    const double multiplier_B2_y_ = lambda[13];

    /* reactions */
    reactions[0] = multiplier_O0_x_;  /* O0.Fx */
    reactions[1] = multiplier_O0_y_;  /* O0.Fy */
    reactions[2] = 0.0;  /* O0.M */
    reactions[3] = multiplier_O1_x_;  /* O1.Fx */
    reactions[4] = multiplier_O1_y_;  /* O1.Fy */
    reactions[5] = 0.0;  /* O1.M */
    reactions[6] = multiplier_O2_x_;  /* O2.Fx */
    reactions[7] = multiplier_O2_y_;  /* O2.Fy */
    reactions[8] = 0.0;  /* O2.M */
    reactions[9] = multiplier_A0_x_;  /* A0.Fx */
    reactions[10] = multiplier_A0_y_;  /* A0.Fy */
    reactions[11] = 0.0;  /* A0.M */
    reactions[12] = multiplier_B1_x_;  /* B1.Fx */
    reactions[13] = multiplier_B1_y_;  /* B1.Fy */
    reactions[14] = 0.0;  /* B1.M */
    reactions[15] = multiplier_A1_x_;  /* A1.Fx */
    reactions[16] = multiplier_A1_y_;  /* A1.Fy */
    reactions[17] = 0.0;  /* A1.M */
    reactions[18] = multiplier_B2_x_;  /* B2.Fx */
    reactions[19] = multiplier_B2_y_;  /* B2.Fy */
    reactions[20] = 0.0;  /* B2.M */

    /* energy */
    energy[0] = 0.5*p->coupler1_inertia_*(coupler1_omega_ * coupler1_omega_)
        + 0.5*p->coupler1_mass_*(coupler1_vx_ * coupler1_vx_) + 0.5*p->coupler1_mass_*(coupler1_vy_ * coupler1_vy_)
        + 0.5*p->coupler2_inertia_*(coupler2_omega_ * coupler2_omega_)
        + 0.5*p->coupler2_mass_*(coupler2_vx_ * coupler2_vx_) + 0.5*p->coupler2_mass_*(coupler2_vy_ * coupler2_vy_)
        + 0.5*p->crank0_inertia_*(crank0_omega_ * crank0_omega_) + 0.5*p->crank0_mass_*(crank0_vx_ * crank0_vx_)
        + 0.5*p->crank0_mass_*(crank0_vy_ * crank0_vy_) + 0.5*p->crank1_inertia_*(crank1_omega_ * crank1_omega_)
        + 0.5*p->crank1_mass_*(crank1_vx_ * crank1_vx_) + 0.5*p->crank1_mass_*(crank1_vy_ * crank1_vy_)
        + 0.5*p->crank2_inertia_*(crank2_omega_ * crank2_omega_) + 0.5*p->crank2_mass_*(crank2_vx_ * crank2_vx_)
        + 0.5*p->crank2_mass_*(crank2_vy_ * crank2_vy_);
    energy[1] = -p->coupler1_mass_*coupler1_y_*p->gravity_y_ - p->coupler2_mass_*coupler2_y_*p->gravity_y_
        - p->crank0_mass_*crank0_y_*p->gravity_y_ - p->crank1_mass_*crank1_y_*p->gravity_y_
        - p->crank2_mass_*crank2_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->crank0_mass_, other->crank0_mass_)
        && is_same_number(p->crank0_inertia_, other->crank0_inertia_)
        && is_same_number(p->crank1_mass_, other->crank1_mass_)
        && is_same_number(p->crank1_inertia_, other->crank1_inertia_)
        && is_same_number(p->crank2_mass_, other->crank2_mass_)
        && is_same_number(p->crank2_inertia_, other->crank2_inertia_)
        && is_same_number(p->coupler1_mass_, other->coupler1_mass_)
        && is_same_number(p->coupler1_inertia_, other->coupler1_inertia_)
        && is_same_number(p->coupler2_mass_, other->coupler2_mass_)
        && is_same_number(p->coupler2_inertia_, other->coupler2_inertia_)
        && is_same_number(p->crank0_head_s_x_, other->crank0_head_s_x_)
        && is_same_number(p->crank1_head_s_x_, other->crank1_head_s_x_)
        && is_same_number(p->crank2_head_s_x_, other->crank2_head_s_x_)
        && is_same_number(p->coupler1_head_s_x_, other->coupler1_head_s_x_)
        && is_same_number(p->coupler2_head_s_x_, other->coupler2_head_s_x_)
        && is_same_number(p->O1_x_, other->O1_x_)
        && is_same_number(p->O2_x_, other->O2_x_)
        && is_same_number(p->guess_crank1_theta_, other->guess_crank1_theta_)
        && is_same_number(p->guess_crank2_theta_, other->guess_crank2_theta_)
        && is_same_number(p->guess_coupler1_theta_, other->guess_coupler1_theta_)
        && is_same_number(p->guess_coupler2_theta_, other->guess_coupler2_theta_)
        && is_same_number(p->set_crank0_theta_, other->set_crank0_theta_)
        && is_same_number(p->rates_crank0_omega_, other->rates_crank0_omega_);
}
