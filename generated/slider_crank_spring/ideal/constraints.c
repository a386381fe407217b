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
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_x = q[0];
    const double crank_y = q[1];
    const double crank_theta = q[2];
    const double rod_x = q[3];
    const double rod_y = q[4];
    const double rod_theta = q[5];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_length;
    const double arm_crank_head_y = p->crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*p->rod_points_crankpin_x;
    const double arm_rod_crankpin_y = p->rod_points_crankpin_x*sin_theta_rod;

    /* rows */
    phi[0] = -crank_x;  /* O.x, m */
    phi[1] = -crank_y;  /* O.y, m */
    phi[2] = arm_crank_head_x - arm_rod_crankpin_x + crank_x - rod_x;  /* pin.x, m */
    phi[3] = arm_crank_head_y - arm_rod_crankpin_y + crank_y - rod_y;  /* pin.y, m */
    phi[4] = rod_y;  /* slider.offset, m */
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
    const double arm_crank_head_x = cos_theta_crank*p->crank_length;
    const double arm_crank_head_y = p->crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*p->rod_points_crankpin_x;
    const double arm_rod_crankpin_y = p->rod_points_crankpin_x*sin_theta_rod;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d crank_x */
    phi_q[7] = -1.0;  /* d O.y / d crank_y */
    phi_q[12] = 1.0;  /* d pin.x / d crank_x */
    phi_q[14] = -arm_crank_head_y;  /* d pin.x / d crank_theta */
    phi_q[15] = -1.0;  /* d pin.x / d rod_x */
    phi_q[17] = arm_rod_crankpin_y;  /* d pin.x / d rod_theta */
    phi_q[19] = 1.0;  /* d pin.y / d crank_y */
    phi_q[20] = arm_crank_head_x;  /* d pin.y / d crank_theta */
    phi_q[22] = -1.0;  /* d pin.y / d rod_y */
    phi_q[23] = -arm_rod_crankpin_x;  /* d pin.y / d rod_theta */
    phi_q[28] = 1.0;  /* d slider.offset / d rod_y */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
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
    const double arm_crank_head_x = cos_theta_crank*p->crank_length;
    const double arm_crank_head_y = p->crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*p->rod_points_crankpin_x;
    const double arm_rod_crankpin_y = p->rod_points_crankpin_x*sin_theta_rod;

    /* rows */
    gamma_rows[0] = 0.0;  /* O.x, m/s^2 */
    gamma_rows[1] = 0.0;  /* O.y, m/s^2 */
    /* pin.x, m/s^2 */
    gamma_rows[2] = arm_crank_head_x*(crank_omega * crank_omega) - arm_rod_crankpin_x*(rod_omega * rod_omega);
    /* pin.y, m/s^2 */
    gamma_rows[3] = arm_crank_head_y*(crank_omega * crank_omega) - arm_rod_crankpin_y*(rod_omega * rod_omega);
    gamma_rows[4] = 0.0;  /* slider.offset, m/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    /* start */
    guess[0] = p->guess_rod_theta;  /* start.guess.rod.theta */
    guess[1] = p->guess_rod_x;  /* start.guess.rod.x */
    set[0] = p->set_crank_theta;  /* start.set.crank.theta */
    rates[0] = p->rates_crank_omega;  /* start.rates.crank.omega */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques;
    /* coordinates, velocities, time */
    const double crank_x = q[0];
    const double crank_y = q[1];
    const double crank_theta = q[2];
    const double crank_vx = v[0];
    const double crank_vy = v[1];
    const double crank_omega = v[2];
    const double rod_x = q[3];
    const double rod_y = q[4];
    const double rod_theta = q[5];
    const double rod_vx = v[3];
    const double rod_vy = v[4];
    const double rod_omega = v[5];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const double arm_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const double arm_rod_middle_x = cos_theta_rod*p->rod_points_middle_x;
    const double arm_rod_middle_y = p->rod_points_middle_x*sin_theta_rod;
    const double coil_span_x = -arm_crank_middle_x + arm_rod_middle_x - crank_x + rod_x;
    const double coil_span_y = -arm_crank_middle_y + arm_rod_middle_y - crank_y + rod_y;
    const double coil_span_rate_x = arm_crank_middle_y*crank_omega - arm_rod_middle_y*rod_omega - crank_vx + rod_vx;
    const double coil_span_rate_y = -arm_crank_middle_x*crank_omega + arm_rod_middle_x*rod_omega - crank_vy + rod_vy;
    const double coil_length = sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const double coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const double coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);

    /* multipliers */
    const double multiplier_O_x = lambda[0];
    const double multiplier_O_y = lambda[1];
    const double multiplier_pin_x = lambda[2];
    const double multiplier_pin_y = lambda[3];
    const double multiplier_slider_offset = lambda[4];

    /* reactions */
    reactions[0] = multiplier_O_x;  /* O.Fx */
    reactions[1] = multiplier_O_y;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_pin_x;  /* pin.Fx */
    reactions[4] = multiplier_pin_y;  /* pin.Fy */
    reactions[5] = 0.0;  /* pin.M */
    reactions[6] = 0.0;  /* slider.Fx */
    reactions[7] = multiplier_slider_offset;  /* slider.Fy */
    reactions[8] = 0.0;  /* slider.M */
    series[0] = coil_force;  /* coil.F */
    series[1] = coil_length;  /* coil.length */
    series[2] = p->push_value_x;  /* push.Fx */
    series[3] = 0.0;  /* push.Fy */
    series[4] = fabs(p->push_value_x);  /* push.F */

    /* energy */
    energy[0] = 0.5*p->crank_inertia*(crank_omega * crank_omega) + 0.5*p->crank_mass*(crank_vx * crank_vx)
        + 0.5*p->crank_mass*(crank_vy * crank_vy) + 0.5*p->rod_inertia*(rod_omega * rod_omega)
        + 0.5*p->rod_mass*(rod_vx * rod_vx) + 0.5*p->rod_mass*(rod_vy * rod_vy);
    energy[1] = 0.5*p->coil_stiffness*((-p->coil_free_length + coil_length) * (-p->coil_free_length + coil_length));
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->crank_mass, other->crank_mass)
        && same_number(p->crank_inertia, other->crank_inertia)
        && same_number(p->rod_mass, other->rod_mass)
        && same_number(p->rod_inertia, other->rod_inertia)
        && same_number(p->crank_length, other->crank_length)
        && same_number(p->rod_points_crankpin_x, other->rod_points_crankpin_x)
        && same_number(p->guess_rod_theta, other->guess_rod_theta)
        && same_number(p->guess_rod_x, other->guess_rod_x)
        && same_number(p->set_crank_theta, other->set_crank_theta)
        && same_number(p->rates_crank_omega, other->rates_crank_omega);
}
