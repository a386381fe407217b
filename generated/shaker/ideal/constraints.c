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
    m[6] = p->table_mass;
    m[7] = p->table_mass;
    m[8] = p->table_inertia;
    m[9] = p->arm_mass;
    m[10] = p->arm_mass;
    m[11] = p->arm_inertia;
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
    const double table_x = q[6];
    const double table_y = q[7];
    const double table_theta = q[8];
    const double arm_x = q[9];
    const double arm_y = q[10];
    const double arm_theta = q[11];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double cos_theta_table = cos(table_theta);
    const double sin_theta_table = sin(table_theta);
    const double arm_table_top_x = -sin_theta_table*p->table_points_top_y;
    const double arm_table_top_y = cos_theta_table*p->table_points_top_y;
    const double cos_theta_arm = cos(arm_theta);
    const double sin_theta_arm = sin(arm_theta);
    const double arm_arm_head_x = p->arm_head_s_x*cos_theta_arm;
    const double arm_arm_head_y = p->arm_head_s_x*sin_theta_arm;
    const double motor_value = p->omega*t;

    /* rows */
    phi[0] = arm_crank_head_x - crank_x;  /* shaft.x, m */
    phi[1] = arm_crank_head_y - crank_y;  /* shaft.y, m */
    phi[2] = arm_crank_head_x + arm_rod_head_x + crank_x - rod_x;  /* crankpin.x, m */
    phi[3] = arm_crank_head_y + arm_rod_head_y + crank_y - rod_y;  /* crankpin.y, m */
    phi[4] = arm_rod_head_x + rod_x - table_x;  /* pin.x, m */
    phi[5] = arm_rod_head_y + rod_y - table_y;  /* pin.y, m */
    phi[6] = -table_x;  /* guide.offset, m */
    phi[7] = table_theta;  /* guide.angle, rad */
    phi[8] = arm_arm_head_x + arm_table_top_x - arm_x + table_x;  /* pivot.x, m */
    phi[9] = arm_arm_head_y + arm_table_top_y - arm_y + table_y;  /* pivot.y, m */
    phi[10] = crank_theta - motor_value;  /* motor, rad */
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
    const double table_theta = q[8];
    const double arm_theta = q[11];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double cos_theta_table = cos(table_theta);
    const double sin_theta_table = sin(table_theta);
    const double arm_table_top_x = -sin_theta_table*p->table_points_top_y;
    const double arm_table_top_y = cos_theta_table*p->table_points_top_y;
    const double cos_theta_arm = cos(arm_theta);
    const double sin_theta_arm = sin(arm_theta);
    const double arm_arm_head_x = p->arm_head_s_x*cos_theta_arm;
    const double arm_arm_head_y = p->arm_head_s_x*sin_theta_arm;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d shaft.x / d crank_x */
    phi_q[2] = -arm_crank_head_y;  /* d shaft.x / d crank_theta */
    phi_q[13] = -1.0;  /* d shaft.y / d crank_y */
    phi_q[14] = arm_crank_head_x;  /* d shaft.y / d crank_theta */
    phi_q[24] = 1.0;  /* d crankpin.x / d crank_x */
    phi_q[26] = -arm_crank_head_y;  /* d crankpin.x / d crank_theta */
    phi_q[27] = -1.0;  /* d crankpin.x / d rod_x */
    phi_q[29] = -arm_rod_head_y;  /* d crankpin.x / d rod_theta */
    phi_q[37] = 1.0;  /* d crankpin.y / d crank_y */
    phi_q[38] = arm_crank_head_x;  /* d crankpin.y / d crank_theta */
    phi_q[40] = -1.0;  /* d crankpin.y / d rod_y */
    phi_q[41] = arm_rod_head_x;  /* d crankpin.y / d rod_theta */
    phi_q[51] = 1.0;  /* d pin.x / d rod_x */
    phi_q[53] = -arm_rod_head_y;  /* d pin.x / d rod_theta */
    phi_q[54] = -1.0;  /* d pin.x / d table_x */
    phi_q[64] = 1.0;  /* d pin.y / d rod_y */
    phi_q[65] = arm_rod_head_x;  /* d pin.y / d rod_theta */
    phi_q[67] = -1.0;  /* d pin.y / d table_y */
    phi_q[78] = -1.0;  /* d guide.offset / d table_x */
    phi_q[92] = 1.0;  /* d guide.angle / d table_theta */
    phi_q[102] = 1.0;  /* d pivot.x / d table_x */
    phi_q[104] = -arm_table_top_y;  /* d pivot.x / d table_theta */
    phi_q[105] = -1.0;  /* d pivot.x / d arm_x */
    phi_q[107] = -arm_arm_head_y;  /* d pivot.x / d arm_theta */
    phi_q[115] = 1.0;  /* d pivot.y / d table_y */
    phi_q[116] = arm_table_top_x;  /* d pivot.y / d table_theta */
    phi_q[118] = -1.0;  /* d pivot.y / d arm_y */
    phi_q[119] = arm_arm_head_x;  /* d pivot.y / d arm_theta */
    phi_q[122] = 1.0;  /* d motor / d crank_theta */
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
    nu[0] = 0.0;  /* shaft.x, m/s */
    nu[1] = 0.0;  /* shaft.y, m/s */
    nu[2] = 0.0;  /* crankpin.x, m/s */
    nu[3] = 0.0;  /* crankpin.y, m/s */
    nu[4] = 0.0;  /* pin.x, m/s */
    nu[5] = 0.0;  /* pin.y, m/s */
    nu[6] = 0.0;  /* guide.offset, m/s */
    nu[7] = 0.0;  /* guide.angle, rad/s */
    nu[8] = 0.0;  /* pivot.x, m/s */
    nu[9] = 0.0;  /* pivot.y, m/s */
    nu[10] = motor_rate;  /* motor, rad/s */
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
    const double table_theta = q[8];
    const double table_omega = v[8];
    const double arm_theta = q[11];
    const double arm_omega = v[11];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double cos_theta_table = cos(table_theta);
    const double sin_theta_table = sin(table_theta);
    const double arm_table_top_x = -sin_theta_table*p->table_points_top_y;
    const double arm_table_top_y = cos_theta_table*p->table_points_top_y;
    const double cos_theta_arm = cos(arm_theta);
    const double sin_theta_arm = sin(arm_theta);
    const double arm_arm_head_x = p->arm_head_s_x*cos_theta_arm;
    const double arm_arm_head_y = p->arm_head_s_x*sin_theta_arm;
    const double motor_acceleration = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x*(crank_omega * crank_omega);  /* shaft.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y*(crank_omega * crank_omega);  /* shaft.y, m/s^2 */
    /* crankpin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x*(crank_omega * crank_omega) + arm_rod_head_x*(rod_omega * rod_omega);
    /* crankpin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y*(crank_omega * crank_omega) + arm_rod_head_y*(rod_omega * rod_omega);
    gamma_rows[4] = arm_rod_head_x*(rod_omega * rod_omega);  /* pin.x, m/s^2 */
    gamma_rows[5] = arm_rod_head_y*(rod_omega * rod_omega);  /* pin.y, m/s^2 */
    gamma_rows[6] = 0.0;  /* guide.offset, m/s^2 */
    gamma_rows[7] = 0.0;  /* guide.angle, rad/s^2 */
    /* pivot.x, m/s^2 */
    gamma_rows[8] = arm_arm_head_x*(arm_omega * arm_omega) + arm_table_top_x*(table_omega * table_omega);
    /* pivot.y, m/s^2 */
    gamma_rows[9] = arm_arm_head_y*(arm_omega * arm_omega) + arm_table_top_y*(table_omega * table_omega);
    gamma_rows[10] = motor_acceleration;  /* motor, rad/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)rates;
    /* start */
    guess[0] = p->guess_rod_theta;  /* start.guess.rod.theta */
    set[0] = p->set_arm_theta;  /* start.set.arm.theta */
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
    const double rod_y = q[4];
    const double rod_vx = v[3];
    const double rod_vy = v[4];
    const double rod_omega = v[5];
    const double table_y = q[7];
    const double table_vx = v[6];
    const double table_vy = v[7];
    const double table_omega = v[8];
    const double arm_y = q[10];
    const double arm_vx = v[9];
    const double arm_vy = v[10];
    const double arm_omega = v[11];

    /* multipliers */
    const double multiplier_shaft_x = lambda[0];
    const double multiplier_shaft_y = lambda[1];
    const double multiplier_crankpin_x = lambda[2];
    const double multiplier_crankpin_y = lambda[3];
    const double multiplier_pin_x = lambda[4];
    const double multiplier_pin_y = lambda[5];
    const double multiplier_guide_offset = lambda[6];
    const double multiplier_guide_angle = lambda[7];
    const double multiplier_pivot_x = lambda[8];
    const double multiplier_pivot_y = lambda[9];
    const double multiplier_motor = lambda[10];

    /* reactions */
    reactions[0] = multiplier_shaft_x;  /* shaft.Fx */
    reactions[1] = multiplier_shaft_y;  /* shaft.Fy */
    reactions[2] = 0.0;  /* shaft.M */
    reactions[3] = multiplier_crankpin_x;  /* crankpin.Fx */
    reactions[4] = multiplier_crankpin_y;  /* crankpin.Fy */
    reactions[5] = 0.0;  /* crankpin.M */
    reactions[6] = multiplier_pin_x;  /* pin.Fx */
    reactions[7] = multiplier_pin_y;  /* pin.Fy */
    reactions[8] = 0.0;  /* pin.M */
    reactions[9] = multiplier_guide_offset;  /* guide.Fx */
    reactions[10] = 0.0;  /* guide.Fy */
    reactions[11] = -multiplier_guide_angle;  /* guide.M */
    reactions[12] = multiplier_pivot_x;  /* pivot.Fx */
    reactions[13] = multiplier_pivot_y;  /* pivot.Fy */
    reactions[14] = 0.0;  /* pivot.M */
    torques[0] = -multiplier_motor;  /* motor */

    /* energy */
    energy[0] = 0.5*p->arm_inertia*(arm_omega * arm_omega) + 0.5*p->arm_mass*(arm_vx * arm_vx)
        + 0.5*p->arm_mass*(arm_vy * arm_vy) + 0.5*p->crank_inertia*(crank_omega * crank_omega)
        + 0.5*p->crank_mass*(crank_vx * crank_vx) + 0.5*p->crank_mass*(crank_vy * crank_vy)
        + 0.5*p->rod_inertia*(rod_omega * rod_omega) + 0.5*p->rod_mass*(rod_vx * rod_vx)
        + 0.5*p->rod_mass*(rod_vy * rod_vy) + 0.5*p->table_inertia*(table_omega * table_omega)
        + 0.5*p->table_mass*(table_vx * table_vx) + 0.5*p->table_mass*(table_vy * table_vy);
    energy[1] = -p->arm_mass*arm_y*p->gravity_y - p->crank_mass*crank_y*p->gravity_y - p->gravity_y*p->rod_mass*rod_y
        - p->gravity_y*p->table_mass*table_y;
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->crank_mass, other->crank_mass)
        && same_number(p->crank_inertia, other->crank_inertia)
        && same_number(p->rod_mass, other->rod_mass)
        && same_number(p->rod_inertia, other->rod_inertia)
        && same_number(p->table_mass, other->table_mass)
        && same_number(p->table_inertia, other->table_inertia)
        && same_number(p->arm_mass, other->arm_mass)
        && same_number(p->arm_inertia, other->arm_inertia)
        && same_number(p->omega, other->omega)
        && same_number(p->crank_head_s_x, other->crank_head_s_x)
        && same_number(p->rod_head_s_x, other->rod_head_s_x)
        && same_number(p->table_points_top_y, other->table_points_top_y)
        && same_number(p->arm_head_s_x, other->arm_head_s_x)
        && same_number(p->guess_rod_theta, other->guess_rod_theta)
        && same_number(p->set_arm_theta, other->set_arm_theta);
}
