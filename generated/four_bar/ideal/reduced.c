/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double rocker_omega = v[0];
    const double coupler_theta = q[1];
    const double coupler_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double motor_rate = p->omega;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double span_rocker_com_x = cos_theta_rocker*p->rocker_head_s_x;
    const double span_rocker_com_y = p->rocker_head_s_x*sin_theta_rocker;
    const double rocker_x = p->B0_x + span_rocker_com_x;
    const double rocker_vx = -rocker_omega*span_rocker_com_y;
    const double rocker_vy = rocker_omega*span_rocker_com_x;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_coupler_com_x = cos_theta_coupler*p->coupler_head_s_x;
    const double span_coupler_com_y = p->coupler_head_s_x*sin_theta_coupler;
    const double coupler_x = span_coupler_com_x + span_crank_head_x;
    const double coupler_vx = -coupler_omega*span_coupler_com_y + crank_head_vx;
    const double coupler_y = span_coupler_com_y + span_crank_head_y;
    const double coupler_vy = coupler_omega*span_coupler_com_x + crank_head_vy;

    /* bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = coupler_x;
    all_v[3] = coupler_vx;
    all_q[4] = coupler_y;
    all_v[4] = coupler_vy;
    all_q[5] = coupler_theta;
    all_v[5] = coupler_omega;
    all_q[6] = rocker_x;
    all_v[6] = rocker_vx;
    all_q[7] = span_rocker_com_y;
    all_v[7] = rocker_vy;
    all_q[8] = rocker_theta;
    all_v[8] = rocker_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double coupler_theta = q[5];
    const double coupler_omega = v[5];
    const double rocker_theta = q[8];
    const double rocker_omega = v[8];

    /* tree coordinates */
    s[0] = rocker_theta;  /* rocker */
    s_rate[0] = rocker_omega;
    s[1] = coupler_theta;  /* coupler */
    s_rate[1] = coupler_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[8];  /* rocker */
    a[1] = all_a[5];  /* coupler */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double coupler_theta = q[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;

    /* rows */
    out[0] = -p->B0_x + span_coupler_head_x + span_crank_head_x - span_rocker_head_x;  /* B.x */
    out[1] = span_coupler_head_y + span_crank_head_y - span_rocker_head_y;  /* B.y */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double rocker_omega = v[0];
    const double coupler_theta = q[1];
    const double coupler_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double motor_rate = p->omega;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;

    /* rows */
    /* B.x */
    out[0] = -coupler_omega*span_coupler_head_y - motor_rate*span_crank_head_y + rocker_omega*span_rocker_head_y;
    /* B.y */
    out[1] = coupler_omega*span_coupler_head_x + motor_rate*span_crank_head_x - rocker_omega*span_rocker_head_x;
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
    const double rocker_theta = q[0];
    const double rocker_omega = v[0];
    const double coupler_theta = q[1];
    const double coupler_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t + PI/2.0;
    const Four angles_0 = {motor_value, rocker_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rocker = cosines_0[1];
    const double sin_theta_rocker = sines_0[1];
    const double cos_theta_coupler = cosines_0[2];
    const double sin_theta_coupler = sines_0[2];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;
    const double cos_coupler_less_crank = cos_theta_coupler*cos_theta_crank + sin_theta_coupler*sin_theta_crank;
    const double sin_coupler_less_crank = -cos_theta_coupler*sin_theta_crank + cos_theta_crank*sin_theta_coupler;
    const double dot_crank_coupler = cos_coupler_less_crank*p->inertia_crank_coupler;
    const double cross_crank_coupler = p->inertia_crank_coupler*sin_coupler_less_crank;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_B_x = (coupler_omega * coupler_omega)*span_coupler_head_x + motor_acceleration*span_crank_head_y
        + (motor_rate * motor_rate)*span_crank_head_x - (rocker_omega * rocker_omega)*span_rocker_head_x;
    const double rhs_B_y = (coupler_omega * coupler_omega)*span_coupler_head_y - motor_acceleration*span_crank_head_x
        + (motor_rate * motor_rate)*span_crank_head_y - (rocker_omega * rocker_omega)*span_rocker_head_y;

    /* L D L^T of the KKT matrix */
    const double l_B_x__rocker_theta = p->inverse_mass_rocker_rocker*span_rocker_head_y;
    const double l_B_y__rocker_theta = -p->inverse_mass_rocker_rocker*span_rocker_head_x;
    const double l_B_x__coupler_theta = -p->inverse_mass_coupler_coupler*span_coupler_head_y;
    const double l_B_y__coupler_theta = p->inverse_mass_coupler_coupler*span_coupler_head_x;
    const double scale_B_x = -l_B_x__coupler_theta*span_coupler_head_y + l_B_x__rocker_theta*span_rocker_head_y;
    const double scale_B_y = l_B_y__coupler_theta*span_coupler_head_x - l_B_y__rocker_theta*span_rocker_head_x;
    const double pivot_B_x__B_y = -l_B_y__coupler_theta*span_coupler_head_y + l_B_y__rocker_theta*span_rocker_head_y;
    const double determinant_B_x__B_y = -(pivot_B_x__B_y * pivot_B_x__B_y) + scale_B_x*scale_B_y;
    if (!(scale_B_x > 0.0 && scale_B_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B_x__B_y > memory->least * scale_B_y * scale_B_x)) {
        pivot = 2;
        goto dependent;
    }
    const double size_B_x = scale_B_x + scale_B_y;
    if (!(scale_B_x > memory->least_size * size_B_x)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B_x__B_y > memory->least_size * size_B_x * scale_B_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_B_x__B_y = -1.0/determinant_B_x__B_y;
    const double inverse_pivot_B_x = inverse_B_x__B_y*scale_B_y;
    const double inverse_pivot_B_y = inverse_B_x__B_y*scale_B_x;
    const double inverse_cross_B_x__B_y = -inverse_B_x__B_y*pivot_B_x__B_y;

    /* forward substitution */
    const double z_rocker_theta = cos_theta_rocker*p->weight_rocker__across;
    const double z_coupler_theta = cos_theta_coupler*p->weight_coupler__across
        - cross_crank_coupler*(motor_rate * motor_rate) - dot_crank_coupler*motor_acceleration;
    const double z_B_x = -l_B_x__coupler_theta*z_coupler_theta - l_B_x__rocker_theta*z_rocker_theta + rhs_B_x;
    const double z_B_y = -l_B_y__coupler_theta*z_coupler_theta - l_B_y__rocker_theta*z_rocker_theta + rhs_B_y;

    /* backward substitution */
    const double lambda_B_y = inverse_cross_B_x__B_y*z_B_x + inverse_pivot_B_y*z_B_y;
    const double lambda_B_x = inverse_cross_B_x__B_y*z_B_y + inverse_pivot_B_x*z_B_x;
    const double acceleration_coupler_theta = p->inverse_mass_coupler_coupler*z_coupler_theta
        - l_B_x__coupler_theta*lambda_B_x - l_B_y__coupler_theta*lambda_B_y;
    const double acceleration_rocker_theta = p->inverse_mass_rocker_rocker*z_rocker_theta
        - l_B_x__rocker_theta*lambda_B_x - l_B_y__rocker_theta*lambda_B_y;

    /* results */
    a[0] = acceleration_rocker_theta;
    a[1] = acceleration_coupler_theta;
    aside->lambda[0] = lambda_B_x;
    aside->lambda[1] = lambda_B_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = -aside->lambda[0]*motor_rate*span_crank_head_y + aside->lambda[1]*motor_rate*span_crank_head_x
        + motor_rate*(a[1]*dot_crank_coupler - cos_theta_crank*p->weight_crank__across
        - (coupler_omega * coupler_omega)*cross_crank_coupler + p->mass_motor_motor*motor_acceleration);
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
    (void)t;
    /* coordinates, velocities, time */
    const double rocker_theta = q[0];
    const double coupler_theta = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {rocker_theta, coupler_theta, coupler_theta, coupler_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_rocker = cosines_0[0];
    const double sin_theta_rocker = sines_0[0];
    const double cos_theta_coupler = cosines_0[1];
    const double sin_theta_coupler = sines_0[1];
    const double span_coupler_head_x = cos_theta_coupler*p->coupler_head_span_x;
    const double span_coupler_head_y = p->coupler_head_span_x*sin_theta_coupler;
    const double span_rocker_head_x = cos_theta_rocker*p->rocker_head_span_x;
    const double span_rocker_head_y = p->rocker_head_span_x*sin_theta_rocker;

    /* right-hand side */
    const double r_B_x = r[0];
    const double r_B_y = r[1];

    /* L D L^T of the KKT matrix */
    const double l_B_x__rocker_theta = p->inverse_mass_rocker_rocker*span_rocker_head_y;
    const double l_B_y__rocker_theta = -p->inverse_mass_rocker_rocker*span_rocker_head_x;
    const double l_B_x__coupler_theta = -p->inverse_mass_coupler_coupler*span_coupler_head_y;
    const double l_B_y__coupler_theta = p->inverse_mass_coupler_coupler*span_coupler_head_x;
    const double scale_B_x = -l_B_x__coupler_theta*span_coupler_head_y + l_B_x__rocker_theta*span_rocker_head_y;
    const double scale_B_y = l_B_y__coupler_theta*span_coupler_head_x - l_B_y__rocker_theta*span_rocker_head_x;
    const double pivot_B_x__B_y = -l_B_y__coupler_theta*span_coupler_head_y + l_B_y__rocker_theta*span_rocker_head_y;
    const double determinant_B_x__B_y = -(pivot_B_x__B_y * pivot_B_x__B_y) + scale_B_x*scale_B_y;
    if (!(scale_B_x > 0.0 && scale_B_x < INFINITY))
        return 1;
    if (!(determinant_B_x__B_y > SINGULAR * scale_B_y * scale_B_x))
        return 2;
    const double size_B_x = scale_B_x + scale_B_y;
    if (!(scale_B_x > VANISHING * size_B_x))
        return 1;
    if (!(determinant_B_x__B_y > VANISHING * size_B_x * scale_B_x))
        return 2;
    const double inverse_B_x__B_y = -1.0/determinant_B_x__B_y;
    const double inverse_pivot_B_x = inverse_B_x__B_y*scale_B_y;
    const double inverse_pivot_B_y = inverse_B_x__B_y*scale_B_x;
    const double inverse_cross_B_x__B_y = -inverse_B_x__B_y*pivot_B_x__B_y;

    /* backward substitution */
    const double step_lambda_B_y = inverse_cross_B_x__B_y*r_B_x + inverse_pivot_B_y*r_B_y;
    const double step_lambda_B_x = inverse_cross_B_x__B_y*r_B_y + inverse_pivot_B_x*r_B_x;
    const double step_acceleration_coupler_theta = -l_B_x__coupler_theta*step_lambda_B_x
        - l_B_y__coupler_theta*step_lambda_B_y;
    const double step_acceleration_rocker_theta = -l_B_x__rocker_theta*step_lambda_B_x
        - l_B_y__rocker_theta*step_lambda_B_y;

    /* results */
    x[0] = step_acceleration_rocker_theta;
    x[1] = step_acceleration_coupler_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[4];
    closing[1] = + lambda[5];
}
