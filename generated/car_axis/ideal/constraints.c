/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->axle_mass;
    m[1] = p->axle_mass;
    m[2] = p->axle_inertia;
    m[3] = p->road_mass;
    m[4] = p->road_mass;
    m[5] = p->road_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*p->road_head_s_x;
    const double arm_road_head_y = p->road_head_s_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = p->axle_head_s_x*cos_theta_axle;
    const double arm_axle_head_y = p->axle_head_s_x*sin_theta_axle;
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);

    /* rows */
    phi[0] = arm_road_head_x - road_x;  /* foot.x, m */
    phi[1] = arm_road_head_y - road_y;  /* foot.y, m */
    /* slot.offset, m */
    phi[2] = arm_axle_head_x*cos_theta_road + arm_axle_head_y*sin_theta_road - arm_road_head_x*cos_theta_road
        - arm_road_head_y*sin_theta_road - axle_x*cos_theta_road - axle_y*sin_theta_road + cos_theta_road*road_x
        + road_y*sin_theta_road;
    phi[3] = -bump_value + road_theta;  /* bump, rad */
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*p->road_head_s_x;
    const double arm_road_head_y = p->road_head_s_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = p->axle_head_s_x*cos_theta_axle;
    const double arm_axle_head_y = p->axle_head_s_x*sin_theta_axle;

    /* non-zeros */
    phi_q[3] = -1.0;  /* d foot.x / d road_x */
    phi_q[5] = -arm_road_head_y;  /* d foot.x / d road_theta */
    phi_q[10] = -1.0;  /* d foot.y / d road_y */
    phi_q[11] = arm_road_head_x;  /* d foot.y / d road_theta */
    phi_q[12] = -cos_theta_road;  /* d slot.offset / d axle_x */
    phi_q[13] = -sin_theta_road;  /* d slot.offset / d axle_y */
    phi_q[14] = arm_axle_head_x*sin_theta_road - arm_axle_head_y*cos_theta_road;  /* d slot.offset / d axle_theta */
    phi_q[15] = cos_theta_road;  /* d slot.offset / d road_x */
    phi_q[16] = sin_theta_road;  /* d slot.offset / d road_y */
    /* d slot.offset / d road_theta */
    phi_q[17] = -arm_axle_head_x*sin_theta_road + arm_axle_head_y*cos_theta_road + axle_x*sin_theta_road
        - axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road;
    phi_q[23] = 1.0;  /* d bump / d road_theta */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)q;
    /* directions, arms, drives */
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));

    /* rows */
    nu[0] = 0.0;  /* foot.x, m/s */
    nu[1] = 0.0;  /* foot.y, m/s */
    nu[2] = 0.0;  /* slot.offset, m/s */
    nu[3] = bump_rate;  /* bump, rad/s */
}

/*
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double axle_vx = v[0];
    const double axle_vy = v[1];
    const double axle_omega = v[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];
    const double road_vx = v[3];
    const double road_vy = v[4];
    const double road_omega = v[5];

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*p->road_head_s_x;
    const double arm_road_head_y = p->road_head_s_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = p->axle_head_s_x*cos_theta_axle;
    const double arm_axle_head_y = p->axle_head_s_x*sin_theta_axle;
    const double bump_acceleration = -(p->omega * p->omega)*p->par_r*sin(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*sin(p->omega*t)*(cos(p->omega*t)
        * cos(p->omega*t))/((p->length * p->length * p->length)*pow(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length), 1.5));

    /* rows */
    gamma_rows[0] = arm_road_head_x*(road_omega * road_omega);  /* foot.x, m/s^2 */
    gamma_rows[1] = arm_road_head_y*(road_omega * road_omega);  /* foot.y, m/s^2 */
    /* slot.offset, m/s^2 */
    gamma_rows[2] = -axle_omega*(arm_axle_head_x*(-axle_omega*cos_theta_road + cos_theta_road*road_omega)
        - arm_axle_head_y*(axle_omega*sin_theta_road - road_omega*sin_theta_road)) - axle_vx*road_omega*sin_theta_road
        + axle_vy*cos_theta_road*road_omega - cos_theta_road*road_omega*road_vy + road_omega*road_vx*sin_theta_road
        - road_omega*(cos_theta_road*(arm_axle_head_x*axle_omega - axle_vy
        + road_omega*(-arm_axle_head_x + axle_x - road_x) + road_vy)
        - sin_theta_road*(-arm_axle_head_y*axle_omega - axle_vx + road_omega*(arm_axle_head_y - axle_y + road_y)
        + road_vx));
    gamma_rows[3] = bump_acceleration;  /* bump, rad/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess;
    /* start */
    set[0] = p->set_axle_y;  /* start.set.axle.y */
    set[1] = p->set_axle_theta;  /* start.set.axle.theta */
    rates[0] = p->rates_axle_vy;  /* start.rates.axle.vy */
    rates[1] = p->rates_axle_omega;  /* start.rates.axle.omega */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double axle_vx = v[0];
    const double axle_vy = v[1];
    const double axle_omega = v[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];
    const double road_vx = v[3];
    const double road_vy = v[4];
    const double road_omega = v[5];

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*p->road_head_s_x;
    const double arm_road_head_y = p->road_head_s_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = p->axle_head_s_x*cos_theta_axle;
    const double arm_axle_head_y = p->axle_head_s_x*sin_theta_axle;
    const double left_span_x = -arm_axle_head_x + axle_x;
    const double left_span_y = -arm_axle_head_y + axle_y;
    const double left_length = sqrt((left_span_x * left_span_x) + (left_span_y * left_span_y));
    const double left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const double right_span_x = arm_axle_head_x - arm_road_head_x + axle_x - road_x;
    const double right_span_y = arm_axle_head_y - arm_road_head_y + axle_y - road_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = p->right_stiffness*(-p->right_free_length + right_length);

    /* multipliers */
    const double multiplier_foot_x = lambda[0];
    const double multiplier_foot_y = lambda[1];
    const double multiplier_slot_offset = lambda[2];
    const double multiplier_bump = lambda[3];

    /* reactions */
    reactions[0] = multiplier_foot_x;  /* foot.Fx */
    reactions[1] = multiplier_foot_y;  /* foot.Fy */
    reactions[2] = 0.0;  /* foot.M */
    reactions[3] = -cos_theta_road*multiplier_slot_offset;  /* slot.Fx */
    reactions[4] = -multiplier_slot_offset*sin_theta_road;  /* slot.Fy */
    reactions[5] = 0.0;  /* slot.M */
    torques[0] = -multiplier_bump;  /* bump */
    series[0] = left_force;  /* left.F */
    series[1] = left_length;  /* left.length */
    series[2] = right_force;  /* right.F */
    series[3] = right_length;  /* right.length */

    /* energy */
    energy[0] = 0.5*p->axle_inertia*(axle_omega * axle_omega) + 0.5*p->axle_mass*(axle_vx * axle_vx)
        + 0.5*p->axle_mass*(axle_vy * axle_vy) + 0.5*p->road_inertia*(road_omega * road_omega)
        + 0.5*p->road_mass*(road_vx * road_vx) + 0.5*p->road_mass*(road_vy * road_vy);
    energy[1] = -p->axle_mass*axle_y*p->gravity_y + 0.5*p->left_stiffness*((-p->left_free_length + left_length)
        * (-p->left_free_length + left_length)) - p->gravity_y*p->road_mass*road_y
        + 0.5*p->right_stiffness*((-p->right_free_length + right_length) * (-p->right_free_length + right_length));
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->axle_mass, other->axle_mass)
        && same_number(p->axle_inertia, other->axle_inertia)
        && same_number(p->road_mass, other->road_mass)
        && same_number(p->road_inertia, other->road_inertia)
        && same_number(p->length, other->length)
        && same_number(p->par_r, other->par_r)
        && same_number(p->omega, other->omega)
        && same_number(p->axle_head_s_x, other->axle_head_s_x)
        && same_number(p->road_head_s_x, other->road_head_s_x)
        && same_number(p->set_axle_y, other->set_axle_y)
        && same_number(p->set_axle_theta, other->set_axle_theta)
        && same_number(p->rates_axle_vy, other->rates_axle_vy)
        && same_number(p->rates_axle_omega, other->rates_axle_omega);
}
