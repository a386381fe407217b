/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->axle_mass_;
    m[1] = p->axle_mass_;
    m[2] = p->axle_inertia_;
    m[3] = p->road_mass_;
    m[4] = p->road_mass_;
    m[5] = p->road_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double road_x_ = q[3];
    const double road_y_ = q[4];
    const double road_theta_ = q[5];

    /* directions, arms, drives */
    const double cos_theta_road_ = cos(road_theta_);
    const double sin_theta_road_ = sin(road_theta_);
    const double arm_road_head_x_ = cos_theta_road_*p->road_head_s_x_;
    const double arm_road_head_y_ = p->road_head_s_x_*sin_theta_road_;
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double arm_axle_head_x_ = p->axle_head_s_x_*cos_theta_axle_;
    const double arm_axle_head_y_ = p->axle_head_s_x_*sin_theta_axle_;
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);

    /* rows */
    phi[0] = arm_road_head_x_ - road_x_;  /* foot.x, m */
    phi[1] = arm_road_head_y_ - road_y_;  /* foot.y, m */
    /* slot.offset, m */
    phi[2] = arm_axle_head_x_*cos_theta_road_ + arm_axle_head_y_*sin_theta_road_ - arm_road_head_x_*cos_theta_road_
        - arm_road_head_y_*sin_theta_road_ - axle_x_*cos_theta_road_ - axle_y_*sin_theta_road_
        + cos_theta_road_*road_x_ + road_y_*sin_theta_road_;
    phi[3] = -bump_value_ + road_theta_;  /* bump, rad */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double road_x_ = q[3];
    const double road_y_ = q[4];
    const double road_theta_ = q[5];

    /* directions, arms, drives */
    const double cos_theta_road_ = cos(road_theta_);
    const double sin_theta_road_ = sin(road_theta_);
    const double arm_road_head_x_ = cos_theta_road_*p->road_head_s_x_;
    const double arm_road_head_y_ = p->road_head_s_x_*sin_theta_road_;
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double arm_axle_head_x_ = p->axle_head_s_x_*cos_theta_axle_;
    const double arm_axle_head_y_ = p->axle_head_s_x_*sin_theta_axle_;

    /* non-zeros */
    phi_q[3] = -1.0;  /* d foot.x / d road_x_ */
    phi_q[5] = -arm_road_head_y_;  /* d foot.x / d road_theta_ */
    phi_q[10] = -1.0;  /* d foot.y / d road_y_ */
    phi_q[11] = arm_road_head_x_;  /* d foot.y / d road_theta_ */
    phi_q[12] = -cos_theta_road_;  /* d slot.offset / d axle_x_ */
    phi_q[13] = -sin_theta_road_;  /* d slot.offset / d axle_y_ */
    /* d slot.offset / d axle_theta_ */
    phi_q[14] = arm_axle_head_x_*sin_theta_road_ - arm_axle_head_y_*cos_theta_road_;
    phi_q[15] = cos_theta_road_;  /* d slot.offset / d road_x_ */
    phi_q[16] = sin_theta_road_;  /* d slot.offset / d road_y_ */
    /* d slot.offset / d road_theta_ */
    phi_q[17] = -arm_axle_head_x_*sin_theta_road_ + arm_axle_head_y_*cos_theta_road_ + axle_x_*sin_theta_road_
        - axle_y_*cos_theta_road_ + cos_theta_road_*road_y_ - road_x_*sin_theta_road_;
    phi_q[23] = 1.0;  /* d bump / d road_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)q;
    /* directions, arms, drives */
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));

    /* rows */
    nu[0] = 0.0;  /* foot.x, m/s */
    nu[1] = 0.0;  /* foot.y, m/s */
    nu[2] = 0.0;  /* slot.offset, m/s */
    nu[3] = bump_rate_;  /* bump, rad/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double axle_vx_ = v[0];
    const double axle_vy_ = v[1];
    const double axle_omega_ = v[2];
    const double road_x_ = q[3];
    const double road_y_ = q[4];
    const double road_theta_ = q[5];
    const double road_vx_ = v[3];
    const double road_vy_ = v[4];
    const double road_omega_ = v[5];

    /* directions, arms, drives */
    const double cos_theta_road_ = cos(road_theta_);
    const double sin_theta_road_ = sin(road_theta_);
    const double arm_road_head_x_ = cos_theta_road_*p->road_head_s_x_;
    const double arm_road_head_y_ = p->road_head_s_x_*sin_theta_road_;
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double arm_axle_head_x_ = p->axle_head_s_x_*cos_theta_axle_;
    const double arm_axle_head_y_ = p->axle_head_s_x_*sin_theta_axle_;
    const double bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*sin(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*sin(p->omega_*t)*(cos(p->omega_*t)
        * cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*pow(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_), 1.5));

    /* rows */
    gamma_rows[0] = arm_road_head_x_*(road_omega_ * road_omega_);  /* foot.x, m/s^2 */
    gamma_rows[1] = arm_road_head_y_*(road_omega_ * road_omega_);  /* foot.y, m/s^2 */
    /* slot.offset, m/s^2 */
    gamma_rows[2] = -axle_omega_*(arm_axle_head_x_*(-axle_omega_*cos_theta_road_ + cos_theta_road_*road_omega_)
        - arm_axle_head_y_*(axle_omega_*sin_theta_road_ - road_omega_*sin_theta_road_))
        - axle_vx_*road_omega_*sin_theta_road_ + axle_vy_*cos_theta_road_*road_omega_
        - cos_theta_road_*road_omega_*road_vy_ + road_omega_*road_vx_*sin_theta_road_
        - road_omega_*(cos_theta_road_*(arm_axle_head_x_*axle_omega_ - axle_vy_
        + road_omega_*(-arm_axle_head_x_ + axle_x_ - road_x_) + road_vy_)
        - sin_theta_road_*(-arm_axle_head_y_*axle_omega_ - axle_vx_
        + road_omega_*(arm_axle_head_y_ - axle_y_ + road_y_) + road_vx_));
    gamma_rows[3] = bump_acceleration_;  /* bump, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess;
    /* start */
    set[0] = p->set_axle_y_;  /* start.set.axle.y */
    set[1] = p->set_axle_theta_;  /* start.set.axle.theta */
    rates[0] = p->rates_axle_vy_;  /* start.rates.axle.vy */
    rates[1] = p->rates_axle_omega_;  /* start.rates.axle.omega */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double axle_vx_ = v[0];
    const double axle_vy_ = v[1];
    const double axle_omega_ = v[2];
    const double road_x_ = q[3];
    const double road_y_ = q[4];
    const double road_theta_ = q[5];
    const double road_vx_ = v[3];
    const double road_vy_ = v[4];
    const double road_omega_ = v[5];

    /* directions, arms, drives */
    const double cos_theta_road_ = cos(road_theta_);
    const double sin_theta_road_ = sin(road_theta_);
    const double arm_road_head_x_ = cos_theta_road_*p->road_head_s_x_;
    const double arm_road_head_y_ = p->road_head_s_x_*sin_theta_road_;
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double arm_axle_head_x_ = p->axle_head_s_x_*cos_theta_axle_;
    const double arm_axle_head_y_ = p->axle_head_s_x_*sin_theta_axle_;
    const double left_span_x_ = -arm_axle_head_x_ + axle_x_;
    const double left_span_y_ = -arm_axle_head_y_ + axle_y_;
    const double left_length_ = sqrt((left_span_x_ * left_span_x_) + (left_span_y_ * left_span_y_));
    const double left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const double right_span_x_ = arm_axle_head_x_ - arm_road_head_x_ + axle_x_ - road_x_;
    const double right_span_y_ = arm_axle_head_y_ - arm_road_head_y_ + axle_y_ - road_y_;
    const double right_length_ = sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const double right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);

    /* multipliers */
    const double multiplier_foot_x_ = lambda[0];
    const double multiplier_foot_y_ = lambda[1];
    const double multiplier_slot_offset_ = lambda[2];
    const double multiplier_bump_ = lambda[3];

    /* reactions */
    reactions[0] = multiplier_foot_x_;  /* foot.Fx */
    reactions[1] = multiplier_foot_y_;  /* foot.Fy */
    reactions[2] = 0.0;  /* foot.M */
    reactions[3] = -cos_theta_road_*multiplier_slot_offset_;  /* slot.Fx */
    reactions[4] = -multiplier_slot_offset_*sin_theta_road_;  /* slot.Fy */
    reactions[5] = 0.0;  /* slot.M */
    torques[0] = -multiplier_bump_;  /* bump */
    series[0] = left_force_;  /* left.F */
    series[1] = left_length_;  /* left.length */
    series[2] = right_force_;  /* right.F */
    series[3] = right_length_;  /* right.length */

    /* energy */
    energy[0] = 0.5*p->axle_inertia_*(axle_omega_ * axle_omega_) + 0.5*p->axle_mass_*(axle_vx_ * axle_vx_)
        + 0.5*p->axle_mass_*(axle_vy_ * axle_vy_) + 0.5*p->road_inertia_*(road_omega_ * road_omega_)
        + 0.5*p->road_mass_*(road_vx_ * road_vx_) + 0.5*p->road_mass_*(road_vy_ * road_vy_);
    energy[1] = -p->axle_mass_*axle_y_*p->gravity_y_ + 0.5*p->left_stiffness_*((-p->left_free_length_ + left_length_)
        * (-p->left_free_length_ + left_length_)) + 0.5*p->right_stiffness_*((-p->right_free_length_ + right_length_)
        * (-p->right_free_length_ + right_length_)) - p->road_mass_*road_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->axle_mass_, other->axle_mass_)
        && is_same_number(p->axle_inertia_, other->axle_inertia_)
        && is_same_number(p->road_mass_, other->road_mass_)
        && is_same_number(p->road_inertia_, other->road_inertia_)
        && is_same_number(p->length_, other->length_)
        && is_same_number(p->r_, other->r_)
        && is_same_number(p->omega_, other->omega_)
        && is_same_number(p->axle_head_s_x_, other->axle_head_s_x_)
        && is_same_number(p->road_head_s_x_, other->road_head_s_x_)
        && is_same_number(p->set_axle_y_, other->set_axle_y_)
        && is_same_number(p->set_axle_theta_, other->set_axle_theta_)
        && is_same_number(p->rates_axle_vy_, other->rates_axle_vy_)
        && is_same_number(p->rates_axle_omega_, other->rates_axle_omega_);
}
