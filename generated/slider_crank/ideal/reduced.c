/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     crank: on ground by O; its angle is prescribed by motor
 *     rod: on crank by crankpin; its angle is an unknown
 *     slider: on rod by wristpin; its angle is constant
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = rod.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of cylinder.offset
 *
 * expand: state of the tree to all_q, all_v of the bodies (x, y, theta each, as in constraints.c).
 * reduce_state: the opposite direction. closures, closure_rates: Phi and its rate.
 * reduced_dynamics: the right-hand side. reduced_project: the smallest change that satisfies the closures.
 */

/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double rod_theta_ = q[0];
    const double rod_omega_ = v[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double motor_rate_ = p->omega_;
    const double span_crank_com_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double span_crank_com_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double crank_vx_ = -motor_rate_*span_crank_com_y_;
    const double crank_vy_ = motor_rate_*span_crank_com_x_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const double crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_head_s_x_;
    const double span_rod_com_y_ = p->rod_head_s_x_*sin_theta_rod_;
    const double rod_x_ = span_crank_head_x_ + span_rod_com_x_;
    const double rod_vx_ = crank_head_vx_ - rod_omega_*span_rod_com_y_;
    const double rod_y_ = span_crank_head_y_ + span_rod_com_y_;
    const double rod_vy_ = crank_head_vy_ + rod_omega_*span_rod_com_x_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const double rod_head_x_ = span_crank_head_x_ + span_rod_head_x_;
    const double rod_head_vx_ = crank_head_vx_ - rod_omega_*span_rod_head_y_;
    const double rod_head_y_ = span_crank_head_y_ + span_rod_head_y_;
    const double rod_head_vy_ = crank_head_vy_ + rod_omega_*span_rod_head_x_;
    const double slider_theta_ = 0.0;
    const double slider_omega_ = 0.0;

    /* bodies */
    all_q[0] = span_crank_com_x_;
    all_v[0] = crank_vx_;
    all_q[1] = span_crank_com_y_;
    all_v[1] = crank_vy_;
    all_q[2] = motor_value_;
    all_v[2] = motor_rate_;
    all_q[3] = rod_x_;
    all_v[3] = rod_vx_;
    all_q[4] = rod_y_;
    all_v[4] = rod_vy_;
    all_q[5] = rod_theta_;
    all_v[5] = rod_omega_;
    all_q[6] = rod_head_x_;
    all_v[6] = rod_head_vx_;
    all_q[7] = rod_head_y_;
    all_v[7] = rod_head_vy_;
    all_q[8] = slider_theta_;
    all_v[8] = slider_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double rod_theta_ = q[5];
    const double rod_omega_ = v[5];

    /* tree coordinates */
    s[0] = rod_theta_;  /* rod */
    s_rate[0] = rod_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
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
    const double rod_theta_ = q[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double sin_theta_crank_ = sines_0[0];
    const double sin_theta_rod_ = sines_0[1];
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;

    /* rows */
    out[0] = span_crank_head_y_ + span_rod_head_y_;  /* cylinder.offset */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rod_theta_ = q[0];
    const double rod_omega_ = v[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double motor_rate_ = p->omega_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;

    /* rows */
    out[0] = motor_rate_*span_crank_head_x_ + rod_omega_*span_rod_head_x_;  /* cylinder.offset */
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     rod.theta; lambda of cylinder.offset.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double rod_theta_ = q[0];
    const double rod_omega_ = v[0];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_cylinder_offset_ = -motor_acceleration_*span_crank_head_x_
        + (motor_rate_ * motor_rate_)*span_crank_head_y_ + (rod_omega_ * rod_omega_)*span_rod_head_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_rod_rod_ > LIGHT_PIVOT * p->rod_turning_)) {
        pivot = 2;
        goto dependent;
    }
    const double l_cylinder_offset_rod_theta_ = p->inverse_mass_rod_rod_*span_rod_head_x_;
    const double scale_cylinder_offset_ = l_cylinder_offset_rod_theta_*span_rod_head_x_;
    if (!(scale_cylinder_offset_ > 0.0 && scale_cylinder_offset_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_cylinder_offset_ = 1.0/scale_cylinder_offset_;

    /* forward substitution */
    const double z_rod_theta_ = -cross_crank_rod_*(motor_rate_ * motor_rate_) - dot_crank_rod_*motor_acceleration_;
    const double z_cylinder_offset_ = -l_cylinder_offset_rod_theta_*z_rod_theta_ + rhs_cylinder_offset_;

    /* backward substitution */
    const double lambda_cylinder_offset_ = -inverse_pivot_cylinder_offset_*z_cylinder_offset_;
    const double acceleration_rod_theta_ = p->inverse_mass_rod_rod_*z_rod_theta_
        - l_cylinder_offset_rod_theta_*lambda_cylinder_offset_;

    /* results */
    a[0] = acceleration_rod_theta_;
    rhs->lambda[0] = lambda_cylinder_offset_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = motor_rate_*rhs->lambda[0]*span_crank_head_x_
        + motor_rate_*(a[0]*dot_crank_rod_ - cross_crank_rod_*(rod_omega_ * rod_omega_)
        + p->mass_motor_motor_*motor_acceleration_);
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}

/*
 * The smallest x (n) in the metric of M with Phi_q x = r, for Newton's step and velocities. r has all rows
 * of the closed linkage; those of open joints and redundant ones are ignored.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double rod_theta_ = q[0];

    /* directions, arms, drives */
    const Four angles_0 = {rod_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_rod_ = cosines_0[0];
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;

    /* right-hand side */
    const double r_cylinder_offset_ = r[0];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_cylinder_offset_rod_theta_ = p->inverse_tree_metric_rod_theta_*span_rod_head_x_;
    const double scale_cylinder_offset_ = l_cylinder_offset_rod_theta_*span_rod_head_x_;
    if (!(scale_cylinder_offset_ > 0.0 && scale_cylinder_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_cylinder_offset_ = 1.0/scale_cylinder_offset_;

    /* backward substitution */
    const double step_lambda_cylinder_offset_ = -inverse_pivot_cylinder_offset_*r_cylinder_offset_;
    const double step_acceleration_rod_theta_ = -l_cylinder_offset_rod_theta_*step_lambda_cylinder_offset_;

    /* results */
    x[0] = step_acceleration_rod_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[6];
}
