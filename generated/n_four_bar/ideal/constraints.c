/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->crank0_mass;
    m[1] = p->crank0_mass;
    m[2] = p->crank0_inertia;
    m[3] = p->crank1_mass;
    m[4] = p->crank1_mass;
    m[5] = p->crank1_inertia;
    m[6] = p->crank2_mass;
    m[7] = p->crank2_mass;
    m[8] = p->crank2_inertia;
    m[9] = p->coupler1_mass;
    m[10] = p->coupler1_mass;
    m[11] = p->coupler1_inertia;
    m[12] = p->coupler2_mass;
    m[13] = p->coupler2_mass;
    m[14] = p->coupler2_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_x = q[0];
    const double crank0_y = q[1];
    const double crank0_theta = q[2];
    const double crank1_x = q[3];
    const double crank1_y = q[4];
    const double crank1_theta = q[5];
    const double crank2_x = q[6];
    const double crank2_y = q[7];
    const double crank2_theta = q[8];
    const double coupler1_x = q[9];
    const double coupler1_y = q[10];
    const double coupler1_theta = q[11];
    const double coupler2_x = q[12];
    const double coupler2_y = q[13];
    const double coupler2_theta = q[14];

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*p->crank0_head_s_x;
    const double arm_crank0_head_y = p->crank0_head_s_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*p->crank1_head_s_x;
    const double arm_crank1_head_y = p->crank1_head_s_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*p->crank2_head_s_x;
    const double arm_crank2_head_y = p->crank2_head_s_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_s_x;
    const double arm_coupler1_head_y = p->coupler1_head_s_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_s_x;
    const double arm_coupler2_head_y = p->coupler2_head_s_x*sin_theta_coupler2;

    /* rows */
    phi[0] = arm_crank0_head_x - crank0_x;  /* O0.x, m */
    phi[1] = arm_crank0_head_y - crank0_y;  /* O0.y, m */
    phi[2] = p->O1_x + arm_crank1_head_x - crank1_x;  /* O1.x, m */
    phi[3] = arm_crank1_head_y - crank1_y;  /* O1.y, m */
    phi[4] = p->O2_x + arm_crank2_head_x - crank2_x;  /* O2.x, m */
    phi[5] = arm_crank2_head_y - crank2_y;  /* O2.y, m */
    phi[6] = arm_coupler1_head_x + arm_crank0_head_x - coupler1_x + crank0_x;  /* A0.x, m */
    phi[7] = arm_coupler1_head_y + arm_crank0_head_y - coupler1_y + crank0_y;  /* A0.y, m */
    phi[8] = arm_coupler1_head_x - arm_crank1_head_x + coupler1_x - crank1_x;  /* B1.x, m */
    phi[9] = arm_coupler1_head_y - arm_crank1_head_y + coupler1_y - crank1_y;  /* B1.y, m */
    phi[10] = arm_coupler2_head_x + arm_crank1_head_x - coupler2_x + crank1_x;  /* A1.x, m */
    phi[11] = arm_coupler2_head_y + arm_crank1_head_y - coupler2_y + crank1_y;  /* A1.y, m */
    phi[12] = arm_coupler2_head_x - arm_crank2_head_x + coupler2_x - crank2_x;  /* B2.x, m */
    phi[13] = arm_coupler2_head_y - arm_crank2_head_y + coupler2_y - crank2_y;  /* B2.y, m */
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[2];
    const double crank1_theta = q[5];
    const double crank2_theta = q[8];
    const double coupler1_theta = q[11];
    const double coupler2_theta = q[14];

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*p->crank0_head_s_x;
    const double arm_crank0_head_y = p->crank0_head_s_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*p->crank1_head_s_x;
    const double arm_crank1_head_y = p->crank1_head_s_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*p->crank2_head_s_x;
    const double arm_crank2_head_y = p->crank2_head_s_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_s_x;
    const double arm_coupler1_head_y = p->coupler1_head_s_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_s_x;
    const double arm_coupler2_head_y = p->coupler2_head_s_x*sin_theta_coupler2;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O0.x / d crank0_x */
    phi_q[2] = -arm_crank0_head_y;  /* d O0.x / d crank0_theta */
    phi_q[16] = -1.0;  /* d O0.y / d crank0_y */
    phi_q[17] = arm_crank0_head_x;  /* d O0.y / d crank0_theta */
    phi_q[33] = -1.0;  /* d O1.x / d crank1_x */
    phi_q[35] = -arm_crank1_head_y;  /* d O1.x / d crank1_theta */
    phi_q[49] = -1.0;  /* d O1.y / d crank1_y */
    phi_q[50] = arm_crank1_head_x;  /* d O1.y / d crank1_theta */
    phi_q[66] = -1.0;  /* d O2.x / d crank2_x */
    phi_q[68] = -arm_crank2_head_y;  /* d O2.x / d crank2_theta */
    phi_q[82] = -1.0;  /* d O2.y / d crank2_y */
    phi_q[83] = arm_crank2_head_x;  /* d O2.y / d crank2_theta */
    phi_q[90] = 1.0;  /* d A0.x / d crank0_x */
    phi_q[92] = -arm_crank0_head_y;  /* d A0.x / d crank0_theta */
    phi_q[99] = -1.0;  /* d A0.x / d coupler1_x */
    phi_q[101] = -arm_coupler1_head_y;  /* d A0.x / d coupler1_theta */
    phi_q[106] = 1.0;  /* d A0.y / d crank0_y */
    phi_q[107] = arm_crank0_head_x;  /* d A0.y / d crank0_theta */
    phi_q[115] = -1.0;  /* d A0.y / d coupler1_y */
    phi_q[116] = arm_coupler1_head_x;  /* d A0.y / d coupler1_theta */
    phi_q[129] = 1.0;  /* d B1.x / d coupler1_x */
    phi_q[131] = -arm_coupler1_head_y;  /* d B1.x / d coupler1_theta */
    phi_q[123] = -1.0;  /* d B1.x / d crank1_x */
    phi_q[125] = arm_crank1_head_y;  /* d B1.x / d crank1_theta */
    phi_q[145] = 1.0;  /* d B1.y / d coupler1_y */
    phi_q[146] = arm_coupler1_head_x;  /* d B1.y / d coupler1_theta */
    phi_q[139] = -1.0;  /* d B1.y / d crank1_y */
    phi_q[140] = -arm_crank1_head_x;  /* d B1.y / d crank1_theta */
    phi_q[153] = 1.0;  /* d A1.x / d crank1_x */
    phi_q[155] = -arm_crank1_head_y;  /* d A1.x / d crank1_theta */
    phi_q[162] = -1.0;  /* d A1.x / d coupler2_x */
    phi_q[164] = -arm_coupler2_head_y;  /* d A1.x / d coupler2_theta */
    phi_q[169] = 1.0;  /* d A1.y / d crank1_y */
    phi_q[170] = arm_crank1_head_x;  /* d A1.y / d crank1_theta */
    phi_q[178] = -1.0;  /* d A1.y / d coupler2_y */
    phi_q[179] = arm_coupler2_head_x;  /* d A1.y / d coupler2_theta */
    phi_q[192] = 1.0;  /* d B2.x / d coupler2_x */
    phi_q[194] = -arm_coupler2_head_y;  /* d B2.x / d coupler2_theta */
    phi_q[186] = -1.0;  /* d B2.x / d crank2_x */
    phi_q[188] = arm_crank2_head_y;  /* d B2.x / d crank2_theta */
    phi_q[208] = 1.0;  /* d B2.y / d coupler2_y */
    phi_q[209] = arm_coupler2_head_x;  /* d B2.y / d coupler2_theta */
    phi_q[202] = -1.0;  /* d B2.y / d crank2_y */
    phi_q[203] = -arm_crank2_head_x;  /* d B2.y / d crank2_theta */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
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
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[2];
    const double crank0_omega = v[2];
    const double crank1_theta = q[5];
    const double crank1_omega = v[5];
    const double crank2_theta = q[8];
    const double crank2_omega = v[8];
    const double coupler1_theta = q[11];
    const double coupler1_omega = v[11];
    const double coupler2_theta = q[14];
    const double coupler2_omega = v[14];

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*p->crank0_head_s_x;
    const double arm_crank0_head_y = p->crank0_head_s_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*p->crank1_head_s_x;
    const double arm_crank1_head_y = p->crank1_head_s_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*p->crank2_head_s_x;
    const double arm_crank2_head_y = p->crank2_head_s_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_s_x;
    const double arm_coupler1_head_y = p->coupler1_head_s_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_s_x;
    const double arm_coupler2_head_y = p->coupler2_head_s_x*sin_theta_coupler2;

    /* rows */
    gamma_rows[0] = arm_crank0_head_x*(crank0_omega * crank0_omega);  /* O0.x, m/s^2 */
    gamma_rows[1] = arm_crank0_head_y*(crank0_omega * crank0_omega);  /* O0.y, m/s^2 */
    gamma_rows[2] = arm_crank1_head_x*(crank1_omega * crank1_omega);  /* O1.x, m/s^2 */
    gamma_rows[3] = arm_crank1_head_y*(crank1_omega * crank1_omega);  /* O1.y, m/s^2 */
    gamma_rows[4] = arm_crank2_head_x*(crank2_omega * crank2_omega);  /* O2.x, m/s^2 */
    gamma_rows[5] = arm_crank2_head_y*(crank2_omega * crank2_omega);  /* O2.y, m/s^2 */
    /* A0.x, m/s^2 */
    gamma_rows[6] = arm_coupler1_head_x*(coupler1_omega * coupler1_omega)
        + arm_crank0_head_x*(crank0_omega * crank0_omega);
    /* A0.y, m/s^2 */
    gamma_rows[7] = arm_coupler1_head_y*(coupler1_omega * coupler1_omega)
        + arm_crank0_head_y*(crank0_omega * crank0_omega);
    /* B1.x, m/s^2 */
    gamma_rows[8] = arm_coupler1_head_x*(coupler1_omega * coupler1_omega)
        - arm_crank1_head_x*(crank1_omega * crank1_omega);
    /* B1.y, m/s^2 */
    gamma_rows[9] = arm_coupler1_head_y*(coupler1_omega * coupler1_omega)
        - arm_crank1_head_y*(crank1_omega * crank1_omega);
    /* A1.x, m/s^2 */
    gamma_rows[10] = arm_coupler2_head_x*(coupler2_omega * coupler2_omega)
        + arm_crank1_head_x*(crank1_omega * crank1_omega);
    /* A1.y, m/s^2 */
    gamma_rows[11] = arm_coupler2_head_y*(coupler2_omega * coupler2_omega)
        + arm_crank1_head_y*(crank1_omega * crank1_omega);
    /* B2.x, m/s^2 */
    gamma_rows[12] = arm_coupler2_head_x*(coupler2_omega * coupler2_omega)
        - arm_crank2_head_x*(crank2_omega * crank2_omega);
    /* B2.y, m/s^2 */
    gamma_rows[13] = arm_coupler2_head_y*(coupler2_omega * coupler2_omega)
        - arm_crank2_head_y*(crank2_omega * crank2_omega);
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    /* start */
    guess[0] = p->guess_crank1_theta;  /* start.guess.crank1.theta */
    guess[1] = p->guess_crank2_theta;  /* start.guess.crank2.theta */
    guess[2] = p->guess_coupler1_theta;  /* start.guess.coupler1.theta */
    guess[3] = p->guess_coupler2_theta;  /* start.guess.coupler2.theta */
    set[0] = p->set_crank0_theta;  /* start.set.crank0.theta */
    rates[0] = p->rates_crank0_omega;  /* start.rates.crank0.omega */
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
    const double crank0_y = q[1];
    const double crank0_vx = v[0];
    const double crank0_vy = v[1];
    const double crank0_omega = v[2];
    const double crank1_y = q[4];
    const double crank1_vx = v[3];
    const double crank1_vy = v[4];
    const double crank1_omega = v[5];
    const double crank2_y = q[7];
    const double crank2_vx = v[6];
    const double crank2_vy = v[7];
    const double crank2_omega = v[8];
    const double coupler1_y = q[10];
    const double coupler1_vx = v[9];
    const double coupler1_vy = v[10];
    const double coupler1_omega = v[11];
    const double coupler2_y = q[13];
    const double coupler2_vx = v[12];
    const double coupler2_vy = v[13];
    const double coupler2_omega = v[14];

    /* multipliers */
    const double multiplier_O0_x = lambda[0];
    const double multiplier_O0_y = lambda[1];
    const double multiplier_O1_x = lambda[2];
    const double multiplier_O1_y = lambda[3];
    const double multiplier_O2_x = lambda[4];
    const double multiplier_O2_y = lambda[5];
    const double multiplier_A0_x = lambda[6];
    const double multiplier_A0_y = lambda[7];
    const double multiplier_B1_x = lambda[8];
    const double multiplier_B1_y = lambda[9];
    const double multiplier_A1_x = lambda[10];
    const double multiplier_A1_y = lambda[11];
    const double multiplier_B2_x = lambda[12];
    const double multiplier_B2_y = lambda[13];

    /* reactions */
    reactions[0] = multiplier_O0_x;  /* O0.Fx */
    reactions[1] = multiplier_O0_y;  /* O0.Fy */
    reactions[2] = 0.0;  /* O0.M */
    reactions[3] = multiplier_O1_x;  /* O1.Fx */
    reactions[4] = multiplier_O1_y;  /* O1.Fy */
    reactions[5] = 0.0;  /* O1.M */
    reactions[6] = multiplier_O2_x;  /* O2.Fx */
    reactions[7] = multiplier_O2_y;  /* O2.Fy */
    reactions[8] = 0.0;  /* O2.M */
    reactions[9] = multiplier_A0_x;  /* A0.Fx */
    reactions[10] = multiplier_A0_y;  /* A0.Fy */
    reactions[11] = 0.0;  /* A0.M */
    reactions[12] = multiplier_B1_x;  /* B1.Fx */
    reactions[13] = multiplier_B1_y;  /* B1.Fy */
    reactions[14] = 0.0;  /* B1.M */
    reactions[15] = multiplier_A1_x;  /* A1.Fx */
    reactions[16] = multiplier_A1_y;  /* A1.Fy */
    reactions[17] = 0.0;  /* A1.M */
    reactions[18] = multiplier_B2_x;  /* B2.Fx */
    reactions[19] = multiplier_B2_y;  /* B2.Fy */
    reactions[20] = 0.0;  /* B2.M */

    /* energy */
    energy[0] = 0.5*p->coupler1_inertia*(coupler1_omega * coupler1_omega)
        + 0.5*p->coupler1_mass*(coupler1_vx * coupler1_vx) + 0.5*p->coupler1_mass*(coupler1_vy * coupler1_vy)
        + 0.5*p->coupler2_inertia*(coupler2_omega * coupler2_omega) + 0.5*p->coupler2_mass*(coupler2_vx * coupler2_vx)
        + 0.5*p->coupler2_mass*(coupler2_vy * coupler2_vy) + 0.5*p->crank0_inertia*(crank0_omega * crank0_omega)
        + 0.5*p->crank0_mass*(crank0_vx * crank0_vx) + 0.5*p->crank0_mass*(crank0_vy * crank0_vy)
        + 0.5*p->crank1_inertia*(crank1_omega * crank1_omega) + 0.5*p->crank1_mass*(crank1_vx * crank1_vx)
        + 0.5*p->crank1_mass*(crank1_vy * crank1_vy) + 0.5*p->crank2_inertia*(crank2_omega * crank2_omega)
        + 0.5*p->crank2_mass*(crank2_vx * crank2_vx) + 0.5*p->crank2_mass*(crank2_vy * crank2_vy);
    energy[1] = -p->coupler1_mass*coupler1_y*p->gravity_y - p->coupler2_mass*coupler2_y*p->gravity_y
        - p->crank0_mass*crank0_y*p->gravity_y - p->crank1_mass*crank1_y*p->gravity_y
        - p->crank2_mass*crank2_y*p->gravity_y;
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->crank0_mass, other->crank0_mass)
        && same_number(p->crank0_inertia, other->crank0_inertia)
        && same_number(p->crank1_mass, other->crank1_mass)
        && same_number(p->crank1_inertia, other->crank1_inertia)
        && same_number(p->crank2_mass, other->crank2_mass)
        && same_number(p->crank2_inertia, other->crank2_inertia)
        && same_number(p->coupler1_mass, other->coupler1_mass)
        && same_number(p->coupler1_inertia, other->coupler1_inertia)
        && same_number(p->coupler2_mass, other->coupler2_mass)
        && same_number(p->coupler2_inertia, other->coupler2_inertia)
        && same_number(p->crank0_head_s_x, other->crank0_head_s_x)
        && same_number(p->crank1_head_s_x, other->crank1_head_s_x)
        && same_number(p->crank2_head_s_x, other->crank2_head_s_x)
        && same_number(p->coupler1_head_s_x, other->coupler1_head_s_x)
        && same_number(p->coupler2_head_s_x, other->coupler2_head_s_x)
        && same_number(p->O1_x, other->O1_x)
        && same_number(p->O2_x, other->O2_x)
        && same_number(p->guess_crank1_theta, other->guess_crank1_theta)
        && same_number(p->guess_crank2_theta, other->guess_crank2_theta)
        && same_number(p->guess_coupler1_theta, other->guess_coupler1_theta)
        && same_number(p->guess_coupler2_theta, other->guess_coupler2_theta)
        && same_number(p->set_crank0_theta, other->set_crank0_theta)
        && same_number(p->rates_crank0_omega, other->rates_crank0_omega);
}
