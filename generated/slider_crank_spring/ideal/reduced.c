/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double crank_x = 0.0;
    const double crank_y = 0.0;
    const double crank_vx = 0.0;
    const double crank_vy = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_crank_head_y = p->crank_length*sin_theta_crank;
    const double crank_head_vx = -crank_omega*span_crank_head_y;
    const double crank_head_vy = crank_omega*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const double span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const double rod_x = span_crank_head_x + span_rod_com_x;
    const double rod_vx = crank_head_vx - rod_omega*span_rod_com_y;
    const double rod_y = span_crank_head_y + span_rod_com_y;
    const double rod_vy = crank_head_vy + rod_omega*span_rod_com_x;

    /* bodies */
    all_q[0] = crank_x;
    all_v[0] = crank_vx;
    all_q[1] = crank_y;
    all_v[1] = crank_vy;
    all_q[2] = crank_theta;
    all_v[2] = crank_omega;
    all_q[3] = rod_x;
    all_v[3] = rod_vx;
    all_q[4] = rod_y;
    all_v[4] = rod_vy;
    all_q[5] = rod_theta;
    all_v[5] = rod_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double crank_theta = q[2];
    const double crank_omega = v[2];
    const double rod_theta = q[5];
    const double rod_omega = v[5];

    /* tree coordinates */
    s[0] = crank_theta;  /* crank */
    s_rate[0] = crank_omega;
    s[1] = rod_theta;  /* rod */
    s_rate[1] = rod_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[2];  /* crank */
    a[1] = all_a[5];  /* rod */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta = q[0];
    const double rod_theta = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double sin_theta_crank = sines_0[0];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_y = p->crank_length*sin_theta_crank;
    const double span_rod_com_y = p->rod_com_span_x*sin_theta_rod;

    /* rows */
    out[0] = span_crank_head_y + span_rod_com_y;  /* slider.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;

    /* rows */
    out[0] = crank_omega*span_crank_head_x + rod_omega*span_rod_com_x;  /* slider.offset */
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
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_crank_head_y = p->crank_length*sin_theta_crank;
    const double crank_head_vx = -crank_omega*span_crank_head_y;
    const double crank_head_vy = crank_omega*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const double span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const double span_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const double span_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const double crank_middle_vx = -crank_omega*span_crank_middle_y;
    const double crank_middle_vy = crank_omega*span_crank_middle_x;
    const double span_rod_middle_x = cos_theta_rod*p->rod_middle_span_x;
    const double span_rod_middle_y = p->rod_middle_span_x*sin_theta_rod;
    const double rod_middle_x = span_crank_head_x + span_rod_middle_x;
    const double rod_middle_vx = crank_head_vx - rod_omega*span_rod_middle_y;
    const double rod_middle_y = span_crank_head_y + span_rod_middle_y;
    const double rod_middle_vy = crank_head_vy + rod_omega*span_rod_middle_x;
    const double coil_span_x = rod_middle_x - span_crank_middle_x;
    const double coil_span_y = rod_middle_y - span_crank_middle_y;
    const double coil_span_rate_x = -crank_middle_vx + rod_middle_vx;
    const double coil_span_rate_y = -crank_middle_vy + rod_middle_vy;
    const double coil_length = sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const double coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const double coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);
    const double coil_pull = coil_force/coil_length;
    const double span_rod_tip_y = p->rod_tip_span_x*sin_theta_rod;
    const double rod_tip_vx = crank_head_vx - rod_omega*span_rod_tip_y;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_slider_offset = (crank_omega * crank_omega)*span_crank_head_y
        + (rod_omega * rod_omega)*span_rod_com_y;

    /* L D L^T of the KKT matrix */
    const double l_rod_theta__crank_theta = dot_crank_rod*p->inverse_mass_crank_crank;
    const double l_slider_offset__crank_theta = p->inverse_mass_crank_crank*span_crank_head_x;
    const double inverse_pivot_rod_theta = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta + p->mass_rod_rod);
    const double w_slider_offset__rod_theta = -dot_crank_rod*l_slider_offset__crank_theta + span_rod_com_x;
    const double l_slider_offset__rod_theta = inverse_pivot_rod_theta*w_slider_offset__rod_theta;
    const double scale_slider_offset = l_slider_offset__crank_theta*span_crank_head_x
        + l_slider_offset__rod_theta*w_slider_offset__rod_theta;
    if (!(scale_slider_offset > 0.0 && scale_slider_offset < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_slider_offset = 1.0/scale_slider_offset;

    /* forward substitution */
    const double z_crank_theta = -coil_pull*coil_span_x*span_crank_middle_y - coil_pull*coil_span_y*span_crank_head_x
        + coil_pull*coil_span_y*span_crank_middle_x + cross_crank_rod*(rod_omega * rod_omega)
        - span_crank_head_y*(-coil_pull*coil_span_x + p->push_value_x);
    const double z_rod_theta = coil_pull*coil_span_x*span_rod_middle_y - coil_pull*coil_span_y*span_rod_middle_x
        - (crank_omega * crank_omega)*cross_crank_rod - l_rod_theta__crank_theta*z_crank_theta
        - p->push_value_x*span_rod_tip_y;
    const double z_slider_offset = -l_slider_offset__crank_theta*z_crank_theta - l_slider_offset__rod_theta*z_rod_theta
        + rhs_slider_offset;

    /* backward substitution */
    const double lambda_slider_offset = -inverse_pivot_slider_offset*z_slider_offset;
    const double acceleration_rod_theta = inverse_pivot_rod_theta*z_rod_theta
        - l_slider_offset__rod_theta*lambda_slider_offset;
    const double acceleration_crank_theta = -acceleration_rod_theta*l_rod_theta__crank_theta
        + p->inverse_mass_crank_crank*z_crank_theta - l_slider_offset__crank_theta*lambda_slider_offset;

    /* results */
    a[0] = acceleration_crank_theta;
    a[1] = acceleration_rod_theta;
    aside->lambda[0] = lambda_slider_offset;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = -p->coil_damping*(coil_length_rate * coil_length_rate) + p->push_value_x*rod_tip_vx;
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
    const double crank_theta = q[0];
    const double rod_theta = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;

    /* right-hand side */
    const double r_slider_offset = r[0];

    /* L D L^T of the KKT matrix */
    const double l_rod_theta__crank_theta = dot_crank_rod*p->inverse_mass_crank_crank;
    const double l_slider_offset__crank_theta = p->inverse_mass_crank_crank*span_crank_head_x;
    const double inverse_pivot_rod_theta = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta + p->mass_rod_rod);
    const double w_slider_offset__rod_theta = -dot_crank_rod*l_slider_offset__crank_theta + span_rod_com_x;
    const double l_slider_offset__rod_theta = inverse_pivot_rod_theta*w_slider_offset__rod_theta;
    const double scale_slider_offset = l_slider_offset__crank_theta*span_crank_head_x
        + l_slider_offset__rod_theta*w_slider_offset__rod_theta;
    if (!(scale_slider_offset > 0.0 && scale_slider_offset < INFINITY))
        return 1;
    const double inverse_pivot_slider_offset = 1.0/scale_slider_offset;

    /* backward substitution */
    const double step_lambda_slider_offset = -inverse_pivot_slider_offset*r_slider_offset;
    const double step_acceleration_rod_theta = -l_slider_offset__rod_theta*step_lambda_slider_offset;
    const double step_acceleration_crank_theta = -l_rod_theta__crank_theta*step_acceleration_rod_theta
        - l_slider_offset__crank_theta*step_lambda_slider_offset;

    /* results */
    x[0] = step_acceleration_crank_theta;
    x[1] = step_acceleration_rod_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[4];
}
