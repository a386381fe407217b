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
    m[6] = p->table_mass_;
    m[7] = p->table_mass_;
    m[8] = p->table_inertia_;
    m[9] = p->arm_mass_;
    m[10] = p->arm_mass_;
    m[11] = p->arm_inertia_;
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
    const double rod_x_ = q[3];
    const double rod_y_ = q[4];
    const double rod_theta_ = q[5];
    const double table_x_ = q[6];
    const double table_y_ = q[7];
    const double table_theta_ = q[8];
    const double arm_x_ = q[9];
    const double arm_y_ = q[10];
    const double arm_theta_ = q[11];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double cos_theta_table_ = cos(table_theta_);
    const double sin_theta_table_ = sin(table_theta_);
    const double arm_table_top_x_ = -sin_theta_table_*p->table_points_top_y_;
    const double arm_table_top_y_ = cos_theta_table_*p->table_points_top_y_;
    const double cos_theta_arm_ = cos(arm_theta_);
    const double sin_theta_arm_ = sin(arm_theta_);
    const double arm_arm_head_x_ = p->arm_head_s_x_*cos_theta_arm_;
    const double arm_arm_head_y_ = p->arm_head_s_x_*sin_theta_arm_;
    const double motor_value_ = p->omega_*t;

    /* rows */
    phi[0] = arm_crank_head_x_ - crank_x_;  /* shaft.x, m */
    phi[1] = arm_crank_head_y_ - crank_y_;  /* shaft.y, m */
    phi[2] = arm_crank_head_x_ + arm_rod_head_x_ + crank_x_ - rod_x_;  /* crankpin.x, m */
    phi[3] = arm_crank_head_y_ + arm_rod_head_y_ + crank_y_ - rod_y_;  /* crankpin.y, m */
    phi[4] = arm_rod_head_x_ + rod_x_ - table_x_;  /* pin.x, m */
    phi[5] = arm_rod_head_y_ + rod_y_ - table_y_;  /* pin.y, m */
    phi[6] = -table_x_;  /* guide.offset, m */
    phi[7] = table_theta_;  /* guide.angle, rad */
    phi[8] = arm_arm_head_x_ + arm_table_top_x_ - arm_x_ + table_x_;  /* pivot.x, m */
    phi[9] = arm_arm_head_y_ + arm_table_top_y_ - arm_y_ + table_y_;  /* pivot.y, m */
    phi[10] = crank_theta_ - motor_value_;  /* motor, rad */
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
    const double table_theta_ = q[8];
    const double arm_theta_ = q[11];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double cos_theta_table_ = cos(table_theta_);
    const double sin_theta_table_ = sin(table_theta_);
    const double arm_table_top_x_ = -sin_theta_table_*p->table_points_top_y_;
    const double arm_table_top_y_ = cos_theta_table_*p->table_points_top_y_;
    const double cos_theta_arm_ = cos(arm_theta_);
    const double sin_theta_arm_ = sin(arm_theta_);
    const double arm_arm_head_x_ = p->arm_head_s_x_*cos_theta_arm_;
    const double arm_arm_head_y_ = p->arm_head_s_x_*sin_theta_arm_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d shaft.x / d crank_x_ */
    phi_q[2] = -arm_crank_head_y_;  /* d shaft.x / d crank_theta_ */
    phi_q[13] = -1.0;  /* d shaft.y / d crank_y_ */
    phi_q[14] = arm_crank_head_x_;  /* d shaft.y / d crank_theta_ */
    phi_q[24] = 1.0;  /* d crankpin.x / d crank_x_ */
    phi_q[26] = -arm_crank_head_y_;  /* d crankpin.x / d crank_theta_ */
    phi_q[27] = -1.0;  /* d crankpin.x / d rod_x_ */
    phi_q[29] = -arm_rod_head_y_;  /* d crankpin.x / d rod_theta_ */
    phi_q[37] = 1.0;  /* d crankpin.y / d crank_y_ */
    phi_q[38] = arm_crank_head_x_;  /* d crankpin.y / d crank_theta_ */
    phi_q[40] = -1.0;  /* d crankpin.y / d rod_y_ */
    phi_q[41] = arm_rod_head_x_;  /* d crankpin.y / d rod_theta_ */
    phi_q[51] = 1.0;  /* d pin.x / d rod_x_ */
    phi_q[53] = -arm_rod_head_y_;  /* d pin.x / d rod_theta_ */
    phi_q[54] = -1.0;  /* d pin.x / d table_x_ */
    phi_q[64] = 1.0;  /* d pin.y / d rod_y_ */
    phi_q[65] = arm_rod_head_x_;  /* d pin.y / d rod_theta_ */
    phi_q[67] = -1.0;  /* d pin.y / d table_y_ */
    phi_q[78] = -1.0;  /* d guide.offset / d table_x_ */
    phi_q[92] = 1.0;  /* d guide.angle / d table_theta_ */
    phi_q[102] = 1.0;  /* d pivot.x / d table_x_ */
    phi_q[104] = -arm_table_top_y_;  /* d pivot.x / d table_theta_ */
    phi_q[105] = -1.0;  /* d pivot.x / d arm_x_ */
    phi_q[107] = -arm_arm_head_y_;  /* d pivot.x / d arm_theta_ */
    phi_q[115] = 1.0;  /* d pivot.y / d table_y_ */
    phi_q[116] = arm_table_top_x_;  /* d pivot.y / d table_theta_ */
    phi_q[118] = -1.0;  /* d pivot.y / d arm_y_ */
    phi_q[119] = arm_arm_head_x_;  /* d pivot.y / d arm_theta_ */
    phi_q[122] = 1.0;  /* d motor / d crank_theta_ */
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
    nu[10] = motor_rate_;  /* motor, rad/s */
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
    const double table_theta_ = q[8];
    const double table_omega_ = v[8];
    const double arm_theta_ = q[11];
    const double arm_omega_ = v[11];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double arm_crank_head_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double arm_crank_head_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double arm_rod_head_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double arm_rod_head_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double cos_theta_table_ = cos(table_theta_);
    const double sin_theta_table_ = sin(table_theta_);
    const double arm_table_top_x_ = -sin_theta_table_*p->table_points_top_y_;
    const double arm_table_top_y_ = cos_theta_table_*p->table_points_top_y_;
    const double cos_theta_arm_ = cos(arm_theta_);
    const double sin_theta_arm_ = sin(arm_theta_);
    const double arm_arm_head_x_ = p->arm_head_s_x_*cos_theta_arm_;
    const double arm_arm_head_y_ = p->arm_head_s_x_*sin_theta_arm_;
    const double motor_acceleration_ = 0.0;

    /* rows */
    gamma_rows[0] = arm_crank_head_x_*(crank_omega_ * crank_omega_);  /* shaft.x, m/s^2 */
    gamma_rows[1] = arm_crank_head_y_*(crank_omega_ * crank_omega_);  /* shaft.y, m/s^2 */
    /* crankpin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x_*(crank_omega_ * crank_omega_) + arm_rod_head_x_*(rod_omega_ * rod_omega_);
    /* crankpin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y_*(crank_omega_ * crank_omega_) + arm_rod_head_y_*(rod_omega_ * rod_omega_);
    gamma_rows[4] = arm_rod_head_x_*(rod_omega_ * rod_omega_);  /* pin.x, m/s^2 */
    gamma_rows[5] = arm_rod_head_y_*(rod_omega_ * rod_omega_);  /* pin.y, m/s^2 */
    gamma_rows[6] = 0.0;  /* guide.offset, m/s^2 */
    gamma_rows[7] = 0.0;  /* guide.angle, rad/s^2 */
    /* pivot.x, m/s^2 */
    gamma_rows[8] = arm_arm_head_x_*(arm_omega_ * arm_omega_) + arm_table_top_x_*(table_omega_ * table_omega_);
    /* pivot.y, m/s^2 */
    gamma_rows[9] = arm_arm_head_y_*(arm_omega_ * arm_omega_) + arm_table_top_y_*(table_omega_ * table_omega_);
    gamma_rows[10] = motor_acceleration_;  /* motor, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)rates;
    /* start */
    guess[0] = p->guess_rod_theta_;  /* start.guess.rod.theta */
    set[0] = p->set_arm_theta_;  /* start.set.arm.theta */
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
    const double rod_y_ = q[4];
    const double rod_vx_ = v[3];
    const double rod_vy_ = v[4];
    const double rod_omega_ = v[5];
    const double table_y_ = q[7];
    const double table_vx_ = v[6];
    const double table_vy_ = v[7];
    const double table_omega_ = v[8];
    const double arm_y_ = q[10];
    const double arm_vx_ = v[9];
    const double arm_vy_ = v[10];
    const double arm_omega_ = v[11];

    /* multipliers */
    const double multiplier_shaft_x_ = lambda[0];
    const double multiplier_shaft_y_ = lambda[1];
    const double multiplier_crankpin_x_ = lambda[2];
    const double multiplier_crankpin_y_ = lambda[3];
    const double multiplier_pin_x_ = lambda[4];
    const double multiplier_pin_y_ = lambda[5];
    const double multiplier_guide_offset_ = lambda[6];
    const double multiplier_guide_angle_ = lambda[7];
    const double multiplier_pivot_x_ = lambda[8];
    const double multiplier_pivot_y_ = lambda[9];
    const double multiplier_motor_ = lambda[10];

    /* reactions */
    reactions[0] = multiplier_shaft_x_;  /* shaft.Fx */
    reactions[1] = multiplier_shaft_y_;  /* shaft.Fy */
    reactions[2] = 0.0;  /* shaft.M */
    reactions[3] = multiplier_crankpin_x_;  /* crankpin.Fx */
    reactions[4] = multiplier_crankpin_y_;  /* crankpin.Fy */
    reactions[5] = 0.0;  /* crankpin.M */
    reactions[6] = multiplier_pin_x_;  /* pin.Fx */
    reactions[7] = multiplier_pin_y_;  /* pin.Fy */
    reactions[8] = 0.0;  /* pin.M */
    reactions[9] = multiplier_guide_offset_;  /* guide.Fx */
    reactions[10] = 0.0;  /* guide.Fy */
    reactions[11] = -multiplier_guide_angle_;  /* guide.M */
    reactions[12] = multiplier_pivot_x_;  /* pivot.Fx */
    reactions[13] = multiplier_pivot_y_;  /* pivot.Fy */
    reactions[14] = 0.0;  /* pivot.M */
    torques[0] = -multiplier_motor_;  /* motor */

    /* energy */
    energy[0] = 0.5*p->arm_inertia_*(arm_omega_ * arm_omega_) + 0.5*p->arm_mass_*(arm_vx_ * arm_vx_)
        + 0.5*p->arm_mass_*(arm_vy_ * arm_vy_) + 0.5*p->crank_inertia_*(crank_omega_ * crank_omega_)
        + 0.5*p->crank_mass_*(crank_vx_ * crank_vx_) + 0.5*p->crank_mass_*(crank_vy_ * crank_vy_)
        + 0.5*p->rod_inertia_*(rod_omega_ * rod_omega_) + 0.5*p->rod_mass_*(rod_vx_ * rod_vx_)
        + 0.5*p->rod_mass_*(rod_vy_ * rod_vy_) + 0.5*p->table_inertia_*(table_omega_ * table_omega_)
        + 0.5*p->table_mass_*(table_vx_ * table_vx_) + 0.5*p->table_mass_*(table_vy_ * table_vy_);
    energy[1] = -p->arm_mass_*arm_y_*p->gravity_y_ - p->crank_mass_*crank_y_*p->gravity_y_
        - p->rod_mass_*rod_y_*p->gravity_y_ - p->table_mass_*table_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->crank_mass_, other->crank_mass_)
        && is_same_number(p->crank_inertia_, other->crank_inertia_)
        && is_same_number(p->rod_mass_, other->rod_mass_)
        && is_same_number(p->rod_inertia_, other->rod_inertia_)
        && is_same_number(p->table_mass_, other->table_mass_)
        && is_same_number(p->table_inertia_, other->table_inertia_)
        && is_same_number(p->arm_mass_, other->arm_mass_)
        && is_same_number(p->arm_inertia_, other->arm_inertia_)
        && is_same_number(p->omega_, other->omega_)
        && is_same_number(p->crank_head_s_x_, other->crank_head_s_x_)
        && is_same_number(p->rod_head_s_x_, other->rod_head_s_x_)
        && is_same_number(p->table_points_top_y_, other->table_points_top_y_)
        && is_same_number(p->arm_head_s_x_, other->arm_head_s_x_)
        && is_same_number(p->guess_rod_theta_, other->guess_rod_theta_)
        && is_same_number(p->set_arm_theta_, other->set_arm_theta_);
}
