/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double rod_theta = q[0];
    const double rod_omega = v[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_head_s_x;
    const double span_rod_com_y = p->rod_head_s_x*sin_theta_rod;
    const double rod_x = span_crank_head_x + span_rod_com_x;
    const double rod_vx = crank_head_vx - rod_omega*span_rod_com_y;
    const double rod_y = span_crank_head_y + span_rod_com_y;
    const double rod_vy = crank_head_vy + rod_omega*span_rod_com_x;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const double rod_head_x = span_crank_head_x + span_rod_head_x;
    const double rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const double rod_head_y = span_crank_head_y + span_rod_head_y;
    const double rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const double slider_theta = 0.0;
    const double slider_omega = 0.0;

    /* bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = rod_x;
    all_v[3] = rod_vx;
    all_q[4] = rod_y;
    all_v[4] = rod_vy;
    all_q[5] = rod_theta;
    all_v[5] = rod_omega;
    all_q[6] = rod_head_x;
    all_v[6] = rod_head_vx;
    all_q[7] = rod_head_y;
    all_v[7] = rod_head_vy;
    all_q[8] = slider_theta;
    all_v[8] = slider_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double rod_theta = q[5];
    const double rod_omega = v[5];

    /* tree coordinates */
    s[0] = rod_theta;  /* rod */
    s_rate[0] = rod_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[5];  /* rod */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rod_theta = q[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double sin_theta_crank = sines_0[0];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;

    /* rows */
    out[0] = span_crank_head_y + span_rod_head_y;  /* cylinder.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rod_theta = q[0];
    const double rod_omega = v[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double motor_rate = p->omega;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;

    /* rows */
    out[0] = motor_rate*span_crank_head_x + rod_omega*span_rod_head_x;  /* cylinder.offset */
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
    const double rod_theta = q[0];
    const double rod_omega = v[0];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_cylinder_offset = -motor_acceleration*span_crank_head_x
        + (motor_rate * motor_rate)*span_crank_head_y + (rod_omega * rod_omega)*span_rod_head_y;

    /* L D L^T of the KKT matrix */
    const double l_cylinder_offset__rod_theta = p->inverse_mass_rod_rod*span_rod_head_x;
    const double scale_cylinder_offset = l_cylinder_offset__rod_theta*span_rod_head_x;
    if (!(scale_cylinder_offset > 0.0 && scale_cylinder_offset < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_cylinder_offset = 1.0/scale_cylinder_offset;

    /* forward substitution */
    const double z_rod_theta = -cross_crank_rod*(motor_rate * motor_rate) - dot_crank_rod*motor_acceleration;
    const double z_cylinder_offset = -l_cylinder_offset__rod_theta*z_rod_theta + rhs_cylinder_offset;

    /* backward substitution */
    const double lambda_cylinder_offset = -inverse_pivot_cylinder_offset*z_cylinder_offset;
    const double acceleration_rod_theta = p->inverse_mass_rod_rod*z_rod_theta
        - l_cylinder_offset__rod_theta*lambda_cylinder_offset;

    /* results */
    a[0] = acceleration_rod_theta;
    aside->lambda[0] = lambda_cylinder_offset;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = aside->lambda[0]*motor_rate*span_crank_head_x
        + motor_rate*(a[0]*dot_crank_rod - cross_crank_rod*(rod_omega * rod_omega)
        + p->mass_motor_motor*motor_acceleration);
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
    const double rod_theta = q[0];

    /* directions, arms, drives */
    const Four angles_0 = {rod_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_rod = cosines_0[0];
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;

    /* right-hand side */
    const double r_cylinder_offset = r[0];

    /* L D L^T of the KKT matrix */
    const double l_cylinder_offset__rod_theta = p->inverse_mass_rod_rod*span_rod_head_x;
    const double scale_cylinder_offset = l_cylinder_offset__rod_theta*span_rod_head_x;
    if (!(scale_cylinder_offset > 0.0 && scale_cylinder_offset < INFINITY))
        return 1;
    const double inverse_pivot_cylinder_offset = 1.0/scale_cylinder_offset;

    /* backward substitution */
    const double step_lambda_cylinder_offset = -inverse_pivot_cylinder_offset*r_cylinder_offset;
    const double step_acceleration_rod_theta = -l_cylinder_offset__rod_theta*step_lambda_cylinder_offset;

    /* results */
    x[0] = step_acceleration_rod_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[6];
}
