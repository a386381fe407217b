/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank_mass;
    m[1] = p->crank_mass;
    m[2] = p->crank_inertia;
    m[3] = p->coupler_mass;
    m[4] = p->coupler_mass;
    m[5] = p->coupler_inertia;
    m[6] = p->rocker_mass;
    m[7] = p->rocker_mass;
    m[8] = p->rocker_inertia;
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
    const double coupler_x = q[3];
    const double coupler_y = q[4];
    const double coupler_theta = q[5];
    const double rocker_x = q[6];
    const double rocker_y = q[7];
    const double rocker_theta = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_coupler = cos(coupler_theta);
    const double sin_theta_coupler = sin(coupler_theta);
    const double arm_coupler_head_x = cos_theta_coupler*p->coupler_head_s_x;
    const double arm_coupler_head_y = p->coupler_head_s_x*sin_theta_coupler;
    const double cos_theta_rocker = cos(rocker_theta);
    const double sin_theta_rocker = sin(rocker_theta);
    const double arm_rocker_head_x = cos_theta_rocker*p->rocker_head_s_x;
    const double arm_rocker_head_y = p->rocker_head_s_x*sin_theta_rocker;
    const double motor_value = p->omega*t + PI/2.0;

    /* rows */
    phi[0] = arm_crank_head_x - crank_x;  /* A0.x, m */
    phi[1] = arm_crank_head_y - crank_y;  /* A0.y, m */
    phi[2] = arm_coupler_head_x + arm_crank_head_x - coupler_x + crank_x;  /* A.x, m */
    phi[3] = arm_coupler_head_y + arm_crank_head_y - coupler_y + crank_y;  /* A.y, m */
    phi[4] = arm_coupler_head_x - arm_rocker_head_x + coupler_x - rocker_x;  /* B.x, m */
    phi[5] = arm_coupler_head_y - arm_rocker_head_y + coupler_y - rocker_y;  /* B.y, m */
    phi[6] = p->B0_x + arm_rocker_head_x - rocker_x;  /* B0.x, m */
    phi[7] = arm_rocker_head_y - rocker_y;  /* B0.y, m */
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
    const double coupler_theta = q[5];
    const double rocker_theta = q[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_coupler = cos(coupler_theta);
    const double sin_theta_coupler = sin(coupler_theta);
    const double arm_coupler_head_x = cos_theta_coupler*p->coupler_head_s_x;
    const double arm_coupler_head_y = p->coupler_head_s_x*sin_theta_coupler;
    const double cos_theta_rocker = cos(rocker_theta);
    const double sin_theta_rocker = sin(rocker_theta);
    const double arm_rocker_head_x = cos_theta_rocker*p->rocker_head_s_x;
    const double arm_rocker_head_y = p->rocker_head_s_x*sin_theta_rocker;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d A0.x / d crank_x */
    phi_q[2] = -arm_crank_head_y;  /* d A0.x / d crank_theta */
    phi_q[10] = -1.0;  /* d A0.y / d crank_y */
    phi_q[11] = arm_crank_head_x;  /* d A0.y / d crank_theta */
    phi_q[18] = 1.0;  /* d A.x / d crank_x */
    phi_q[20] = -arm_crank_head_y;  /* d A.x / d crank_theta */
    phi_q[21] = -1.0;  /* d A.x / d coupler_x */
    phi_q[23] = -arm_coupler_head_y;  /* d A.x / d coupler_theta */
    phi_q[28] = 1.0;  /* d A.y / d crank_y */
    phi_q[29] = arm_crank_head_x;  /* d A.y / d crank_theta */
    phi_q[31] = -1.0;  /* d A.y / d coupler_y */
    phi_q[32] = arm_coupler_head_x;  /* d A.y / d coupler_theta */
    phi_q[39] = 1.0;  /* d B.x / d coupler_x */
    phi_q[41] = -arm_coupler_head_y;  /* d B.x / d coupler_theta */
    phi_q[42] = -1.0;  /* d B.x / d rocker_x */
    phi_q[44] = arm_rocker_head_y;  /* d B.x / d rocker_theta */
    phi_q[49] = 1.0;  /* d B.y / d coupler_y */
    phi_q[50] = arm_coupler_head_x;  /* d B.y / d coupler_theta */
    phi_q[52] = -1.0;  /* d B.y / d rocker_y */
    phi_q[53] = -arm_rocker_head_x;  /* d B.y / d rocker_theta */
    phi_q[60] = -1.0;  /* d B0.x / d rocker_x */
    phi_q[62] = -arm_rocker_head_y;  /* d B0.x / d rocker_theta */
    phi_q[70] = -1.0;  /* d B0.y / d rocker_y */
    phi_q[71] = arm_rocker_head_x;  /* d B0.y / d rocker_theta */
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
    nu[0] = 0.0;  /* A0.x, m/s */
    nu[1] = 0.0;  /* A0.y, m/s */
    nu[2] = 0.0;  /* A.x, m/s */
    nu[3] = 0.0;  /* A.y, m/s */
    nu[4] = 0.0;  /* B.x, m/s */
    nu[5] = 0.0;  /* B.y, m/s */
    nu[6] = 0.0;  /* B0.x, m/s */
    nu[7] = 0.0;  /* B0.y, m/s */
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
    const double coupler_theta = q[5];
    const double coupler_omega = v[5];
    const double rocker_theta = q[8];
    const double rocker_omega = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_coupler = cos(coupler_theta);
    const double sin_theta_coupler = sin(coupler_theta);
    const double arm_coupler_head_x = cos_theta_coupler*p->coupler_head_s_x;
    const double arm_coupler_head_y = p->coupler_head_s_x*sin_theta_coupler;
    const double cos_theta_rocker = cos(rocker_theta);
    const double sin_theta_rocker = sin(rocker_theta);
    const double arm_rocker_head_x = cos_theta_rocker*p->rocker_head_s_x;
    const double arm_rocker_head_y = p->rocker_head_s_x*sin_theta_rocker;
    const double motor_acceleration = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x*(crank_omega * crank_omega);  /* A0.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y*(crank_omega * crank_omega);  /* A0.y, m/s^2 */
    /* A.x, m/s^2 */
    gamma_rows[2] = arm_coupler_head_x*(coupler_omega * coupler_omega) + arm_crank_head_x*(crank_omega * crank_omega);
    /* A.y, m/s^2 */
    gamma_rows[3] = arm_coupler_head_y*(coupler_omega * coupler_omega) + arm_crank_head_y*(crank_omega * crank_omega);
    /* B.x, m/s^2 */
    gamma_rows[4] = arm_coupler_head_x*(coupler_omega * coupler_omega)
        - arm_rocker_head_x*(rocker_omega * rocker_omega);
    /* B.y, m/s^2 */
    gamma_rows[5] = arm_coupler_head_y*(coupler_omega * coupler_omega)
        - arm_rocker_head_y*(rocker_omega * rocker_omega);
    gamma_rows[6] = arm_rocker_head_x*(rocker_omega * rocker_omega);  /* B0.x, m/s^2 */
    gamma_rows[7] = arm_rocker_head_y*(rocker_omega * rocker_omega);  /* B0.y, m/s^2 */
    gamma_rows[8] = motor_acceleration;  /* motor, rad/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_coupler_theta;  /* start.guess.coupler.theta */
    guess[1] = p->guess_rocker_theta;  /* start.guess.rocker.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)series;
    /* coordinates, velocities, time */
    const double crank_y = q[1];
    const double crank_vx = v[0];
    const double crank_vy = v[1];
    const double crank_omega = v[2];
    const double coupler_y = q[4];
    const double coupler_vx = v[3];
    const double coupler_vy = v[4];
    const double coupler_omega = v[5];
    const double rocker_y = q[7];
    const double rocker_vx = v[6];
    const double rocker_vy = v[7];
    const double rocker_omega = v[8];

    /* multipliers */
    const double multiplier_A0_x = lambda[0];
    const double multiplier_A0_y = lambda[1];
    const double multiplier_A_x = lambda[2];
    const double multiplier_A_y = lambda[3];
    const double multiplier_B_x = lambda[4];
    const double multiplier_B_y = lambda[5];
    const double multiplier_B0_x = lambda[6];
    const double multiplier_B0_y = lambda[7];
    const double multiplier_motor = lambda[8];

    /* reactions */
    reactions[0] = multiplier_A0_x;  /* A0.Fx */
    reactions[1] = multiplier_A0_y;  /* A0.Fy */
    reactions[2] = 0.0;  /* A0.M */
    reactions[3] = multiplier_A_x;  /* A.Fx */
    reactions[4] = multiplier_A_y;  /* A.Fy */
    reactions[5] = 0.0;  /* A.M */
    reactions[6] = multiplier_B_x;  /* B.Fx */
    reactions[7] = multiplier_B_y;  /* B.Fy */
    reactions[8] = 0.0;  /* B.M */
    reactions[9] = multiplier_B0_x;  /* B0.Fx */
    reactions[10] = multiplier_B0_y;  /* B0.Fy */
    reactions[11] = 0.0;  /* B0.M */
    torques[0] = -multiplier_motor;  /* motor */

    /* energy */
    energy[0] = 0.5*p->coupler_inertia*(coupler_omega * coupler_omega) + 0.5*p->coupler_mass*(coupler_vx * coupler_vx)
        + 0.5*p->coupler_mass*(coupler_vy * coupler_vy) + 0.5*p->crank_inertia*(crank_omega * crank_omega)
        + 0.5*p->crank_mass*(crank_vx * crank_vx) + 0.5*p->crank_mass*(crank_vy * crank_vy)
        + 0.5*p->rocker_inertia*(rocker_omega * rocker_omega) + 0.5*p->rocker_mass*(rocker_vx * rocker_vx)
        + 0.5*p->rocker_mass*(rocker_vy * rocker_vy);
    energy[1] = -p->coupler_mass*coupler_y*p->gravity_y - p->crank_mass*crank_y*p->gravity_y
        - p->gravity_y*p->rocker_mass*rocker_y;
}
