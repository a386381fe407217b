/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank_mass;
    m[1] = p->crank_mass;
    m[2] = p->crank_inertia;
    m[3] = p->rod_mass;
    m[4] = p->rod_mass;
    m[5] = p->rod_inertia;
    m[6] = p->slider_mass;
    m[7] = p->slider_mass;
    m[8] = p->slider_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double crank_x = q[0];
    const double crank_y = q[1];
    const double crank_theta = q[2];
    const double rod_x = q[3];
    const double rod_y = q[4];
    const double rod_theta = q[5];
    const double slider_x = q[6];
    const double slider_y = q[7];
    const double slider_theta = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double motor_value = p->omega*t;

    /* rows */
    phi[0] = arm_crank_head_x - crank_x;  /* O.x, m */
    phi[1] = arm_crank_head_y - crank_y;  /* O.y, m */
    phi[2] = arm_crank_head_x + arm_rod_head_x + crank_x - rod_x;  /* crankpin.x, m */
    phi[3] = arm_crank_head_y + arm_rod_head_y + crank_y - rod_y;  /* crankpin.y, m */
    phi[4] = arm_rod_head_x + rod_x - slider_x;  /* wristpin.x, m */
    phi[5] = arm_rod_head_y + rod_y - slider_y;  /* wristpin.y, m */
    phi[6] = slider_y;  /* cylinder.offset, m */
    phi[7] = slider_theta;  /* cylinder.angle, rad */
    phi[8] = crank_theta - motor_value;  /* motor, rad */
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta = q[2];
    const double rod_theta = q[5];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d crank_x */
    phi_q[2] = -arm_crank_head_y;  /* d O.x / d crank_theta */
    phi_q[10] = -1.0;  /* d O.y / d crank_y */
    phi_q[11] = arm_crank_head_x;  /* d O.y / d crank_theta */
    phi_q[18] = 1.0;  /* d crankpin.x / d crank_x */
    phi_q[20] = -arm_crank_head_y;  /* d crankpin.x / d crank_theta */
    phi_q[21] = -1.0;  /* d crankpin.x / d rod_x */
    phi_q[23] = -arm_rod_head_y;  /* d crankpin.x / d rod_theta */
    phi_q[28] = 1.0;  /* d crankpin.y / d crank_y */
    phi_q[29] = arm_crank_head_x;  /* d crankpin.y / d crank_theta */
    phi_q[31] = -1.0;  /* d crankpin.y / d rod_y */
    phi_q[32] = arm_rod_head_x;  /* d crankpin.y / d rod_theta */
    phi_q[39] = 1.0;  /* d wristpin.x / d rod_x */
    phi_q[41] = -arm_rod_head_y;  /* d wristpin.x / d rod_theta */
    phi_q[42] = -1.0;  /* d wristpin.x / d slider_x */
    phi_q[49] = 1.0;  /* d wristpin.y / d rod_y */
    phi_q[50] = arm_rod_head_x;  /* d wristpin.y / d rod_theta */
    phi_q[52] = -1.0;  /* d wristpin.y / d slider_y */
    phi_q[61] = 1.0;  /* d cylinder.offset / d slider_y */
    phi_q[71] = 1.0;  /* d cylinder.angle / d slider_theta */
    phi_q[74] = 1.0;  /* d motor / d crank_theta */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q;
    /* directions, arms, drives */
    const double motor_rate = p->omega;

    /* rows */
    nu[0] = 0.0;  /* O.x, m/s */
    nu[1] = 0.0;  /* O.y, m/s */
    nu[2] = 0.0;  /* crankpin.x, m/s */
    nu[3] = 0.0;  /* crankpin.y, m/s */
    nu[4] = 0.0;  /* wristpin.x, m/s */
    nu[5] = 0.0;  /* wristpin.y, m/s */
    nu[6] = 0.0;  /* cylinder.offset, m/s */
    nu[7] = 0.0;  /* cylinder.angle, rad/s */
    nu[8] = motor_rate;  /* motor, rad/s */
}

/*
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta = q[2];
    const double crank_omega = v[2];
    const double rod_theta = q[5];
    const double rod_omega = v[5];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double motor_acceleration = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x*(crank_omega * crank_omega);  /* O.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y*(crank_omega * crank_omega);  /* O.y, m/s^2 */
    /* crankpin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x*(crank_omega * crank_omega) + arm_rod_head_x*(rod_omega * rod_omega);
    /* crankpin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y*(crank_omega * crank_omega) + arm_rod_head_y*(rod_omega * rod_omega);
    gamma_rows[4] = arm_rod_head_x*(rod_omega * rod_omega);  /* wristpin.x, m/s^2 */
    gamma_rows[5] = arm_rod_head_y*(rod_omega * rod_omega);  /* wristpin.y, m/s^2 */
    gamma_rows[6] = 0.0;  /* cylinder.offset, m/s^2 */
    gamma_rows[7] = 0.0;  /* cylinder.angle, rad/s^2 */
    gamma_rows[8] = motor_acceleration;  /* motor, rad/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_rod_theta;  /* start.guess.rod.theta */
    guess[1] = p->guess_slider_x;  /* start.guess.slider.x */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)q, (void)series;
    /* coordinates, velocities, time */
    const double crank_vx = v[0];
    const double crank_vy = v[1];
    const double crank_omega = v[2];
    const double rod_vx = v[3];
    const double rod_vy = v[4];
    const double rod_omega = v[5];
    const double slider_vx = v[6];
    const double slider_vy = v[7];
    const double slider_omega = v[8];

    /* multipliers */
    const double multiplier_O_x = lambda[0];
    const double multiplier_O_y = lambda[1];
    const double multiplier_crankpin_x = lambda[2];
    const double multiplier_crankpin_y = lambda[3];
    const double multiplier_cylinder_offset = lambda[4];
    const double multiplier_cylinder_angle = lambda[5];
    const double multiplier_motor = lambda[6];

    /* reactions */
    reactions[0] = multiplier_O_x;  /* O.Fx */
    reactions[1] = multiplier_O_y;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_crankpin_x;  /* crankpin.Fx */
    reactions[4] = multiplier_crankpin_y;  /* crankpin.Fy */
    reactions[5] = 0.0;  /* crankpin.M */
    reactions[6] = 0.0;  /* cylinder.Fx */
    reactions[7] = -multiplier_cylinder_offset;  /* cylinder.Fy */
    reactions[8] = -multiplier_cylinder_angle;  /* cylinder.M */
    torques[0] = -multiplier_motor;  /* motor */

    /* energy */
    energy[0] = 0.5*p->crank_inertia*(crank_omega * crank_omega) + 0.5*p->crank_mass*(crank_vx * crank_vx)
        + 0.5*p->crank_mass*(crank_vy * crank_vy) + 0.5*p->rod_inertia*(rod_omega * rod_omega)
        + 0.5*p->rod_mass*(rod_vx * rod_vx) + 0.5*p->rod_mass*(rod_vy * rod_vy)
        + 0.5*p->slider_inertia*(slider_omega * slider_omega) + 0.5*p->slider_mass*(slider_vx * slider_vx)
        + 0.5*p->slider_mass*(slider_vy * slider_vy);
    energy[1] = 0.0;
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->crank_mass, other->crank_mass)
        && same_number(p->crank_inertia, other->crank_inertia)
        && same_number(p->rod_mass, other->rod_mass)
        && same_number(p->rod_inertia, other->rod_inertia)
        && same_number(p->slider_mass, other->slider_mass)
        && same_number(p->slider_inertia, other->slider_inertia)
        && same_number(p->omega, other->omega)
        && same_number(p->crank_head_s_x, other->crank_head_s_x)
        && same_number(p->rod_head_s_x, other->rod_head_s_x)
        && same_number(p->guess_rod_theta, other->guess_rod_theta)
        && same_number(p->guess_slider_x, other->guess_slider_x);
}
