/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, bump_value, bump_value, bump_value};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double span_road_com_x = cos_theta_road*p->road_head_s_x;
    const double span_road_com_y = p->road_head_s_x*sin_theta_road;
    const double road_vx = -bump_rate*span_road_com_y;
    const double road_vy = bump_rate*span_road_com_x;

    /* bodies */
    all_q[0] = axle_x;
    all_v[0] = axle_x_rate;
    all_q[1] = axle_y;
    all_v[1] = axle_y_rate;
    all_q[2] = axle_theta;
    all_v[2] = axle_omega;
    all_q[3] = span_road_com_x;
    all_v[3] = road_vx;
    all_q[4] = span_road_com_y;
    all_v[4] = road_vy;
    all_q[5] = bump_value;
    all_v[5] = bump_rate;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double axle_vx = v[0];
    const double axle_vy = v[1];
    const double axle_omega = v[2];

    /* tree coordinates */
    s[0] = axle_x;  /* axle.x */
    s_rate[0] = axle_vx;
    s[1] = axle_y;  /* axle.y */
    s_rate[1] = axle_vy;
    s[2] = axle_theta;  /* axle */
    s_rate[2] = axle_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[0];  /* axle.x */
    a[1] = all_a[1];  /* axle.y */
    a[2] = all_a[2];  /* axle */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* rows */
    /* slot.offset */
    out[0] = -axle_x*cos_theta_road - axle_y*sin_theta_road - cos_theta_road*span_axle_tail_x
        - sin_theta_road*span_axle_tail_y;
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* rows */
    /* slot.offset */
    out[0] = axle_omega*(cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x)
        - axle_x_rate*cos_theta_road - axle_y_rate*sin_theta_road
        + bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y) - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double bump_acceleration = -(p->omega * p->omega)*p->par_r*sin(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*sin(p->omega*t)*(cos(p->omega*t)
        * cos(p->omega*t))/((p->length * p->length * p->length)*pow(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length), 1.5));
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;
    const double axle_tail_x = axle_x + span_axle_tail_x;
    const double axle_tail_y = axle_y + span_axle_tail_y;
    const double left_length = sqrt((axle_tail_x * axle_tail_x) + (axle_tail_y * axle_tail_y));
    const double left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const double left_pull = left_force/left_length;
    const double span_road_head_x = cos_theta_road*p->road_head_span_x;
    const double span_road_head_y = p->road_head_span_x*sin_theta_road;
    const double axle_head_x = axle_x - span_axle_tail_x;
    const double axle_head_y = axle_y - span_axle_tail_y;
    const double right_span_x = axle_head_x - span_road_head_x;
    const double right_span_y = axle_head_y - span_road_head_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = p->right_stiffness*(-p->right_free_length + right_length);
    const double right_pull = right_force/right_length;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_slot_offset = -axle_omega*(axle_omega*cos_theta_road*span_axle_tail_x
        + axle_omega*sin_theta_road*span_axle_tail_y) - bump_acceleration*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + (bump_rate * bump_rate)*cos_theta_road*(-axle_x
        - span_axle_tail_x) + (bump_rate * bump_rate)*sin_theta_road*(-axle_y - span_axle_tail_y)
        - 2.0*bump_rate*cos_theta_road*(-axle_omega*span_axle_tail_x - axle_y_rate)
        + 2.0*bump_rate*sin_theta_road*(axle_omega*span_axle_tail_y - axle_x_rate);

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const double l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    const double l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const double scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road;
    if (!(scale_slot_offset > 0.0 && scale_slot_offset < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_slot_offset = 1.0/scale_slot_offset;

    /* forward substitution */
    const double z_axle_x = -axle_tail_x*left_pull - right_pull*right_span_x;
    const double z_axle_y = -axle_tail_y*left_pull - right_pull*right_span_y + p->weight_axle_y;
    const double z_axle_theta = span_axle_tail_x*(-axle_tail_y*left_pull + right_pull*right_span_y)
        - span_axle_tail_y*(-axle_tail_x*left_pull + right_pull*right_span_x);
    const double z_slot_offset = -l_slot_offset__axle_theta*z_axle_theta - l_slot_offset__axle_x*z_axle_x
        - l_slot_offset__axle_y*z_axle_y + rhs_slot_offset;

    /* backward substitution */
    const double lambda_slot_offset = -inverse_pivot_slot_offset*z_slot_offset;
    const double acceleration_axle_theta = p->inverse_axle_inertia*z_axle_theta
        - l_slot_offset__axle_theta*lambda_slot_offset;
    const double acceleration_axle_y = p->inverse_axle_mass*z_axle_y - l_slot_offset__axle_y*lambda_slot_offset;
    const double acceleration_axle_x = p->inverse_axle_mass*z_axle_x - l_slot_offset__axle_x*lambda_slot_offset;

    /* results */
    a[0] = acceleration_axle_x;
    a[1] = acceleration_axle_y;
    a[2] = acceleration_axle_theta;
    aside->lambda[0] = lambda_slot_offset;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = -aside->lambda[0]*(-bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y)
        + bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x))
        + bump_rate*(bump_acceleration*p->mass_bump_bump - cos_theta_road*p->weight_road__across
        + right_pull*right_span_x*span_road_head_y - right_pull*right_span_y*span_road_head_x);
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    /* coordinates, velocities, time */
    const double axle_theta = q[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* right-hand side */
    const double r_slot_offset = r[0];

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const double l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    const double l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const double scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road;
    if (!(scale_slot_offset > 0.0 && scale_slot_offset < INFINITY))
        return 1;
    const double inverse_pivot_slot_offset = 1.0/scale_slot_offset;

    /* backward substitution */
    const double step_lambda_slot_offset = -inverse_pivot_slot_offset*r_slot_offset;
    const double step_acceleration_axle_theta = -l_slot_offset__axle_theta*step_lambda_slot_offset;
    const double step_acceleration_axle_y = -l_slot_offset__axle_y*step_lambda_slot_offset;
    const double step_acceleration_axle_x = -l_slot_offset__axle_x*step_lambda_slot_offset;

    /* results */
    x[0] = step_acceleration_axle_x;
    x[1] = step_acceleration_axle_y;
    x[2] = step_acceleration_axle_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[2];
}
