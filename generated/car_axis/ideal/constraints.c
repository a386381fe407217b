/*
 * The diagonal of M (n).
 */
static void mass_matrix(const Parameters *p, double *m)
{
    /* parameters */
    const double axle_mass = p->axle_mass;
    const double axle_inertia = p->axle_inertia;
    const double road_mass = p->road_mass;
    const double road_inertia = p->road_inertia;

    /* M */
    m[0] = axle_mass;
    m[1] = axle_mass;
    m[2] = axle_inertia;
    m[3] = road_mass;
    m[4] = road_mass;
    m[5] = road_inertia;
}
/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
static void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];
    const double time = t;

    /* parameters */
    const double length = p->length;
    const double r = p->r;
    const double omega = p->omega;
    const double axle_origin_x = p->axle_origin_x;
    const double road_origin_x = p->road_origin_x;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_tail_x = cos_theta_road*road_origin_x;
    const double arm_road_tail_y = road_origin_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_tail_x = axle_origin_x*cos_theta_axle;
    const double arm_axle_tail_y = axle_origin_x*sin_theta_axle;
    const double bump_value = asin(r*sin(omega*time)/length);

    /* rows */
    phi[0] = -arm_road_tail_x - road_x;  /* foot.x */
    phi[1] = -arm_road_tail_y - road_y;  /* foot.y */
    phi[2] = -arm_axle_tail_x*cos_theta_road - arm_axle_tail_y*sin_theta_road + arm_road_tail_x*cos_theta_road
        + arm_road_tail_y*sin_theta_road - axle_x*cos_theta_road - axle_y*sin_theta_road +
        cos_theta_road*road_x + road_y*sin_theta_road;  /* slot.offset */
    phi[3] = -bump_value + road_theta;  /* bump */
}
/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
static void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];

    /* parameters */
    const double axle_origin_x = p->axle_origin_x;
    const double road_origin_x = p->road_origin_x;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_tail_x = cos_theta_road*road_origin_x;
    const double arm_road_tail_y = road_origin_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_tail_x = axle_origin_x*cos_theta_axle;
    const double arm_axle_tail_y = axle_origin_x*sin_theta_axle;

    /* non-zeros */
    phi_q[3] = -1.0;  /* d foot.x / d road_x */
    phi_q[5] = arm_road_tail_y;  /* d foot.x / d road_theta */
    phi_q[10] = -1.0;  /* d foot.y / d road_y */
    phi_q[11] = -arm_road_tail_x;  /* d foot.y / d road_theta */
    phi_q[12] = -cos_theta_road;  /* d slot.offset / d axle_x */
    phi_q[13] = -sin_theta_road;  /* d slot.offset / d axle_y */
    phi_q[14] = -arm_axle_tail_x*sin_theta_road + arm_axle_tail_y*cos_theta_road;  /* d slot.offset / d axle_theta */
    phi_q[15] = cos_theta_road;  /* d slot.offset / d road_x */
    phi_q[16] = sin_theta_road;  /* d slot.offset / d road_y */
    phi_q[17] = arm_axle_tail_x*sin_theta_road - arm_axle_tail_y*cos_theta_road + axle_x*sin_theta_road -
        axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road;  /* d slot.offset / d road_theta */
    phi_q[23] = 1.0;  /* d bump / d road_theta */
}
/*
 * nu = -Phi_t: Phi_q v = nu.
 */
static void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)q;
    /* coordinates, velocities, time */
    const double time = t;

    /* parameters */
    const double length = p->length;
    const double r = p->r;
    const double omega = p->omega;

    /* directions, arms, drives */
    const double bump_rate = omega*r*cos(omega*time)/(length*sqrt(1.0 - (r * r)*(sin(omega*time) *
        sin(omega*time))/(length * length)));

    /* rows */
    nu[0] = 0.0;  /* foot.x */
    nu[1] = 0.0;  /* foot.y */
    nu[2] = 0.0;  /* slot.offset */
    nu[3] = bump_rate;  /* bump */
}
/*
 * gamma: Phi_q a = gamma.
 */
static void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double
    *gamma_rows)
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
    const double time = t;

    /* parameters */
    const double length = p->length;
    const double r = p->r;
    const double omega = p->omega;
    const double axle_origin_x = p->axle_origin_x;
    const double road_origin_x = p->road_origin_x;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_tail_x = cos_theta_road*road_origin_x;
    const double arm_road_tail_y = road_origin_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_tail_x = axle_origin_x*cos_theta_axle;
    const double arm_axle_tail_y = axle_origin_x*sin_theta_axle;
    const double bump_acceleration = -(omega * omega)*r*sin(omega*time)/(length*sqrt(1.0 - (r *
        r)*(sin(omega*time) * sin(omega*time))/(length * length))) + (omega * omega)*(r * r *
        r)*sin(omega*time)*(cos(omega*time) * cos(omega*time))/((length * length * length)*pow(1.0 - (r *
        r)*(sin(omega*time) * sin(omega*time))/(length * length), 3.0/2.0));

    /* rows */
    gamma_rows[0] = -arm_road_tail_x*(road_omega * road_omega);  /* foot.x */
    gamma_rows[1] = -arm_road_tail_y*(road_omega * road_omega);  /* foot.y */
    gamma_rows[2] = -axle_omega*(arm_axle_tail_x*(axle_omega*cos_theta_road - cos_theta_road*road_omega) -
        arm_axle_tail_y*(-axle_omega*sin_theta_road + road_omega*sin_theta_road)) -
        axle_vx*road_omega*sin_theta_road + axle_vy*cos_theta_road*road_omega -
        cos_theta_road*road_omega*road_vy + road_omega*road_vx*sin_theta_road -
        road_omega*(cos_theta_road*(-arm_axle_tail_x*axle_omega - axle_vy + road_omega*(arm_axle_tail_x +
        axle_x - road_x) + road_vy) - sin_theta_road*(arm_axle_tail_y*axle_omega - axle_vx +
        road_omega*(-arm_axle_tail_y - axle_y + road_y) + road_vx));  /* slot.offset */
    gamma_rows[3] = bump_acceleration;  /* bump */
}
/*
 * Values of the start's guess, set and rates.
 */
static void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)guess;
    /* parameters */
    const double set_axle_y = p->set_axle_y;

    /* start */
    set[0] = set_axle_y;  /* start.set.axle.y */
    set[1] = 0.0;  /* start.set.axle.theta */
    rates[0] = 0.0;  /* start.rates.axle.vy */
    rates[1] = 0.0;  /* start.rates.axle.omega */
}
/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
static void outputs(const double t, const double *q, const double *v, const Parameters *p, const double
    *lambda, double *reactions, double *torques, double *series, double *energy)
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

    /* parameters */
    const double axle_mass = p->axle_mass;
    const double axle_inertia = p->axle_inertia;
    const double road_mass = p->road_mass;
    const double road_inertia = p->road_inertia;
    const double axle_origin_x = p->axle_origin_x;
    const double road_origin_x = p->road_origin_x;
    const double par_y = p->par_y;
    const double left_stiffness = p->left_stiffness;
    const double left_free_length = p->left_free_length;
    const double right_stiffness = p->right_stiffness;
    const double right_free_length = p->right_free_length;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_tail_x = cos_theta_road*road_origin_x;
    const double arm_road_tail_y = road_origin_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_tail_x = axle_origin_x*cos_theta_axle;
    const double arm_axle_tail_y = axle_origin_x*sin_theta_axle;
    const double left_span_x = arm_axle_tail_x + axle_x;
    const double left_span_y = arm_axle_tail_y + axle_y;
    const double left_length = sqrt((left_span_x * left_span_x) + (left_span_y * left_span_y));
    const double left_force = left_stiffness*(-left_free_length + left_length);
    const double right_span_x = -arm_axle_tail_x + arm_road_tail_x + axle_x - road_x;
    const double right_span_y = -arm_axle_tail_y + arm_road_tail_y + axle_y - road_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = right_stiffness*(-right_free_length + right_length);

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
    energy[0] = (1.0/2.0)*axle_inertia*(axle_omega * axle_omega) + (1.0/2.0)*axle_mass*(axle_vx * axle_vx) +
        (1.0/2.0)*axle_mass*(axle_vy * axle_vy) + (1.0/2.0)*road_inertia*(road_omega * road_omega) +
        (1.0/2.0)*road_mass*(road_vx * road_vx) + (1.0/2.0)*road_mass*(road_vy * road_vy);
    energy[1] = -axle_mass*axle_y*par_y + (1.0/2.0)*left_stiffness*((-left_free_length + left_length) *
        (-left_free_length + left_length)) - par_y*road_mass*road_y +
        (1.0/2.0)*right_stiffness*((-right_free_length + right_length) * (-right_free_length + right_length));
}
/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
static int project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];

    /* parameters */
    const double axle_origin_x = p->axle_origin_x;
    const double road_origin_x = p->road_origin_x;
    const double inverse_axle_mass = p->inverse_axle_mass;
    const double inverse_axle_inertia = p->inverse_axle_inertia;
    const double inverse_road_mass = p->inverse_road_mass;
    const double inverse_road_inertia = p->inverse_road_inertia;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_tail_x = cos_theta_road*road_origin_x;
    const double arm_road_tail_y = road_origin_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_tail_x = axle_origin_x*cos_theta_axle;
    const double arm_axle_tail_y = axle_origin_x*sin_theta_axle;

    /* right-hand side */
    const double r_foot_x = r[0];
    const double r_foot_y = r[1];
    const double r_slot_offset = r[2];
    const double r_bump = r[3];

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x_2 = -cos_theta_road*inverse_axle_mass;
    const double l_slot_offset__axle_y_2 = -inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta_2 = -arm_axle_tail_x*sin_theta_road +
        arm_axle_tail_y*cos_theta_road;
    const double l_slot_offset__axle_theta_2 = inverse_axle_inertia*w_slot_offset__axle_theta_2;
    const double l_slot_offset__road_x_2 = cos_theta_road*inverse_road_mass;
    const double l_slot_offset__road_y_2 = inverse_road_mass*sin_theta_road;
    const double l_foot_x__road_theta_2 = arm_road_tail_y*inverse_road_inertia;
    const double l_foot_y__road_theta_2 = -arm_road_tail_x*inverse_road_inertia;
    const double w_slot_offset__road_theta_2 = arm_axle_tail_x*sin_theta_road - arm_axle_tail_y*cos_theta_road
        + axle_x*sin_theta_road - axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road;
    const double l_slot_offset__road_theta_2 = inverse_road_inertia*w_slot_offset__road_theta_2;
    const double scale_foot_x_2 = arm_road_tail_y*l_foot_x__road_theta_2 + inverse_road_mass;
    if (!(scale_foot_x_2 > 1e-13 * scale_foot_x_2)) return 1;
    const double inverse_pivot_foot_x_2 = 1.0/scale_foot_x_2;
    const double w_foot_y__foot_x_2 = -arm_road_tail_y*l_foot_y__road_theta_2;
    const double l_foot_y__foot_x_2 = -inverse_pivot_foot_x_2*w_foot_y__foot_x_2;
    const double w_slot_offset__foot_x_2 = -arm_road_tail_y*l_slot_offset__road_theta_2 +
        l_slot_offset__road_x_2;
    const double l_slot_offset__foot_x_2 = -inverse_pivot_foot_x_2*w_slot_offset__foot_x_2;
    const double w_bump__foot_x_2 = -arm_road_tail_y*inverse_road_inertia;
    const double l_bump__foot_x_2 = -inverse_pivot_foot_x_2*w_bump__foot_x_2;
    const double scale_foot_y_2 = -arm_road_tail_x*l_foot_y__road_theta_2 + inverse_road_mass;
    const double pivot_foot_y_2 = l_foot_y__foot_x_2*w_foot_y__foot_x_2 + scale_foot_y_2;
    if (!(pivot_foot_y_2 > 1e-13 * scale_foot_y_2)) return 2;
    const double inverse_pivot_foot_y_2 = 1.0/pivot_foot_y_2;
    const double w_slot_offset__foot_y_2 = arm_road_tail_x*l_slot_offset__road_theta_2 -
        l_slot_offset__foot_x_2*w_foot_y__foot_x_2 + l_slot_offset__road_y_2;
    const double l_slot_offset__foot_y_2 = -inverse_pivot_foot_y_2*w_slot_offset__foot_y_2;
    const double w_bump__foot_y_2 = arm_road_tail_x*inverse_road_inertia -
        l_bump__foot_x_2*w_foot_y__foot_x_2;
    const double l_bump__foot_y_2 = -inverse_pivot_foot_y_2*w_bump__foot_y_2;
    const double scale_slot_offset_2 = -cos_theta_road*l_slot_offset__axle_x_2 +
        cos_theta_road*l_slot_offset__road_x_2 + l_slot_offset__axle_theta_2*w_slot_offset__axle_theta_2 -
        l_slot_offset__axle_y_2*sin_theta_road + l_slot_offset__road_theta_2*w_slot_offset__road_theta_2 +
        l_slot_offset__road_y_2*sin_theta_road;
    const double pivot_slot_offset_2 = l_slot_offset__foot_x_2*w_slot_offset__foot_x_2 +
        l_slot_offset__foot_y_2*w_slot_offset__foot_y_2 + scale_slot_offset_2;
    if (!(pivot_slot_offset_2 > 1e-13 * scale_slot_offset_2)) return 3;
    const double inverse_pivot_slot_offset_2 = 1.0/pivot_slot_offset_2;
    const double w_bump__slot_offset_2 = -inverse_road_inertia*w_slot_offset__road_theta_2 -
        l_bump__foot_x_2*w_slot_offset__foot_x_2 - l_bump__foot_y_2*w_slot_offset__foot_y_2;
    const double l_bump__slot_offset_2 = -inverse_pivot_slot_offset_2*w_bump__slot_offset_2;
    const double scale_bump_2 = inverse_road_inertia;
    const double pivot_bump_2 = l_bump__foot_x_2*w_bump__foot_x_2 + l_bump__foot_y_2*w_bump__foot_y_2 +
        l_bump__slot_offset_2*w_bump__slot_offset_2 + scale_bump_2;
    if (!(pivot_bump_2 > 1e-13 * scale_bump_2)) return 4;
    const double inverse_pivot_bump_2 = 1.0/pivot_bump_2;

    /* forward substitution */
    const double step_z_foot_y = -l_foot_y__foot_x_2*r_foot_x + r_foot_y;
    const double step_z_slot_offset = -l_slot_offset__foot_x_2*r_foot_x -
        l_slot_offset__foot_y_2*step_z_foot_y + r_slot_offset;
    const double step_z_bump = -l_bump__foot_x_2*r_foot_x - l_bump__foot_y_2*step_z_foot_y -
        l_bump__slot_offset_2*step_z_slot_offset + r_bump;

    /* backward substitution */
    const double step_lambda_bump = -inverse_pivot_bump_2*step_z_bump;
    const double step_lambda_slot_offset = -inverse_pivot_slot_offset_2*step_z_slot_offset -
        l_bump__slot_offset_2*step_lambda_bump;
    const double step_lambda_foot_y = -inverse_pivot_foot_y_2*step_z_foot_y -
        l_bump__foot_y_2*step_lambda_bump - l_slot_offset__foot_y_2*step_lambda_slot_offset;
    const double step_lambda_foot_x = -inverse_pivot_foot_x_2*r_foot_x - l_bump__foot_x_2*step_lambda_bump -
        l_foot_y__foot_x_2*step_lambda_foot_y - l_slot_offset__foot_x_2*step_lambda_slot_offset;
    const double step_acceleration_road_theta = -inverse_road_inertia*step_lambda_bump -
        l_foot_x__road_theta_2*step_lambda_foot_x - l_foot_y__road_theta_2*step_lambda_foot_y -
        l_slot_offset__road_theta_2*step_lambda_slot_offset;
    const double step_acceleration_road_y = inverse_road_mass*step_lambda_foot_y -
        l_slot_offset__road_y_2*step_lambda_slot_offset;
    const double step_acceleration_road_x = inverse_road_mass*step_lambda_foot_x -
        l_slot_offset__road_x_2*step_lambda_slot_offset;
    const double step_acceleration_axle_theta = -l_slot_offset__axle_theta_2*step_lambda_slot_offset;
    const double step_acceleration_axle_y = -l_slot_offset__axle_y_2*step_lambda_slot_offset;
    const double step_acceleration_axle_x = -l_slot_offset__axle_x_2*step_lambda_slot_offset;

    /* results */
    x[0] = step_acceleration_axle_x;
    x[1] = step_acceleration_axle_y;
    x[2] = step_acceleration_axle_theta;
    x[3] = step_acceleration_road_x;
    x[4] = step_acceleration_road_y;
    x[5] = step_acceleration_road_theta;
    return 0;
}

