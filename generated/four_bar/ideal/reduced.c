/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     crank: on ground by A0; its angle is prescribed by motor
 *     rocker: on ground by B0; its angle is an unknown
 *     coupler: on crank by A; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = rocker.theta (rad); q[1] = coupler.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of B.x; rhs->lambda[1] of B.y
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
    const double rocker_theta_ = q[0];
    const double rocker_omega_ = v[0];
    const double coupler_theta_ = q[1];
    const double coupler_omega_ = v[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double motor_rate_ = p->omega_;
    const double span_crank_com_x_ = cos_theta_crank_*p->crank_head_s_x_;
    const double span_crank_com_y_ = p->crank_head_s_x_*sin_theta_crank_;
    const double crank_vx_ = -motor_rate_*span_crank_com_y_;
    const double crank_vy_ = motor_rate_*span_crank_com_x_;
    const double span_rocker_com_x_ = cos_theta_rocker_*p->rocker_head_s_x_;
    const double span_rocker_com_y_ = p->rocker_head_s_x_*sin_theta_rocker_;
    const double rocker_x_ = p->B0_x_ + span_rocker_com_x_;
    const double rocker_vx_ = -rocker_omega_*span_rocker_com_y_;
    const double rocker_vy_ = rocker_omega_*span_rocker_com_x_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const double crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const double span_coupler_com_x_ = cos_theta_coupler_*p->coupler_head_s_x_;
    const double span_coupler_com_y_ = p->coupler_head_s_x_*sin_theta_coupler_;
    const double coupler_x_ = span_coupler_com_x_ + span_crank_head_x_;
    const double coupler_vx_ = -coupler_omega_*span_coupler_com_y_ + crank_head_vx_;
    const double coupler_y_ = span_coupler_com_y_ + span_crank_head_y_;
    const double coupler_vy_ = coupler_omega_*span_coupler_com_x_ + crank_head_vy_;

    /* bodies */
    all_q[0] = span_crank_com_x_;
    all_v[0] = crank_vx_;
    all_q[1] = span_crank_com_y_;
    all_v[1] = crank_vy_;
    all_q[2] = motor_value_;
    all_v[2] = motor_rate_;
    all_q[3] = coupler_x_;
    all_v[3] = coupler_vx_;
    all_q[4] = coupler_y_;
    all_v[4] = coupler_vy_;
    all_q[5] = coupler_theta_;
    all_v[5] = coupler_omega_;
    all_q[6] = rocker_x_;
    all_v[6] = rocker_vx_;
    all_q[7] = span_rocker_com_y_;
    all_v[7] = rocker_vy_;
    all_q[8] = rocker_theta_;
    all_v[8] = rocker_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double coupler_theta_ = q[5];
    const double coupler_omega_ = v[5];
    const double rocker_theta_ = q[8];
    const double rocker_omega_ = v[8];

    /* tree coordinates */
    s[0] = rocker_theta_;  /* rocker */
    s_rate[0] = rocker_omega_;
    s[1] = coupler_theta_;  /* coupler */
    s_rate[1] = coupler_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
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
    const double rocker_theta_ = q[0];
    const double coupler_theta_ = q[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;

    /* rows */
    out[0] = -p->B0_x_ + span_coupler_head_x_ + span_crank_head_x_ - span_rocker_head_x_;  /* B.x */
    out[1] = span_coupler_head_y_ + span_crank_head_y_ - span_rocker_head_y_;  /* B.y */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double rocker_theta_ = q[0];
    const double rocker_omega_ = v[0];
    const double coupler_theta_ = q[1];
    const double coupler_omega_ = v[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double motor_rate_ = p->omega_;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;

    /* rows */
    /* B.x */
    out[0] = -coupler_omega_*span_coupler_head_y_ - motor_rate_*span_crank_head_y_ + rocker_omega_*span_rocker_head_y_;
    /* B.y */
    out[1] = coupler_omega_*span_coupler_head_x_ + motor_rate_*span_crank_head_x_ - rocker_omega_*span_rocker_head_x_;
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     rocker.theta; coupler.theta; lambda of B.x with lambda of B.y.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double rocker_theta_ = q[0];
    const double rocker_omega_ = v[0];
    const double coupler_theta_ = q[1];
    const double coupler_omega_ = v[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t + PI/2.0;
    const Four angles_0 = {motor_value_, rocker_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rocker_ = cosines_0[1];
    const double sin_theta_rocker_ = sines_0[1];
    const double cos_theta_coupler_ = cosines_0[2];
    const double sin_theta_coupler_ = sines_0[2];
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;
    const double cos_coupler_less_crank_ = cos_theta_coupler_*cos_theta_crank_ + sin_theta_coupler_*sin_theta_crank_;
    const double sin_coupler_less_crank_ = -cos_theta_coupler_*sin_theta_crank_ + cos_theta_crank_*sin_theta_coupler_;
    const double dot_crank_coupler_ = cos_coupler_less_crank_*p->inertia_crank_coupler_;
    const double cross_crank_coupler_ = p->inertia_crank_coupler_*sin_coupler_less_crank_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_B_x_ = (coupler_omega_ * coupler_omega_)*span_coupler_head_x_
        + motor_acceleration_*span_crank_head_y_ + (motor_rate_ * motor_rate_)*span_crank_head_x_
        - (rocker_omega_ * rocker_omega_)*span_rocker_head_x_;
    const double rhs_B_y_ = (coupler_omega_ * coupler_omega_)*span_coupler_head_y_
        - motor_acceleration_*span_crank_head_x_ + (motor_rate_ * motor_rate_)*span_crank_head_y_
        - (rocker_omega_ * rocker_omega_)*span_rocker_head_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_rocker_rocker_ > LIGHT_PIVOT * p->rocker_turning_)) {
        pivot = 3;
        goto dependent;
    }
    const double l_B_x_rocker_theta_ = p->inverse_mass_rocker_rocker_*span_rocker_head_y_;
    const double l_B_y_rocker_theta_ = -p->inverse_mass_rocker_rocker_*span_rocker_head_x_;
    if (!(p->mass_coupler_coupler_ > LIGHT_PIVOT * p->coupler_turning_)) {
        pivot = 4;
        goto dependent;
    }
    const double l_B_x_coupler_theta_ = -p->inverse_mass_coupler_coupler_*span_coupler_head_y_;
    const double l_B_y_coupler_theta_ = p->inverse_mass_coupler_coupler_*span_coupler_head_x_;
    const double scale_B_x_ = -l_B_x_coupler_theta_*span_coupler_head_y_ + l_B_x_rocker_theta_*span_rocker_head_y_;
    const double scale_B_y_ = l_B_y_coupler_theta_*span_coupler_head_x_ - l_B_y_rocker_theta_*span_rocker_head_x_;
    const double pivot_B_x_B_y_ = -l_B_y_coupler_theta_*span_coupler_head_y_ + l_B_y_rocker_theta_*span_rocker_head_y_;
    const double determinant_B_x_B_y_ = -(pivot_B_x_B_y_ * pivot_B_x_B_y_) + scale_B_x_*scale_B_y_;
    if (!(scale_B_x_ > 0.0 && scale_B_x_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B_x_B_y_ > discrete->min_pivot * scale_B_y_ * scale_B_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double size_B_x_ = scale_B_x_ + scale_B_y_;
    if (!(scale_B_x_ > discrete->min_pivot_size * size_B_x_)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B_x_B_y_ > discrete->min_pivot_size * size_B_x_ * scale_B_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_B_x_B_y_ = -1.0/determinant_B_x_B_y_;
    const double inverse_pivot_B_x_ = inverse_B_x_B_y_*scale_B_y_;
    const double inverse_pivot_B_y_ = inverse_B_x_B_y_*scale_B_x_;
    const double inverse_cross_B_x_B_y_ = -inverse_B_x_B_y_*pivot_B_x_B_y_;

    /* forward substitution */
    const double z_rocker_theta_ = cos_theta_rocker_*p->weight_rocker_across_;
    const double z_coupler_theta_ = cos_theta_coupler_*p->weight_coupler_across_
        - cross_crank_coupler_*(motor_rate_ * motor_rate_) - dot_crank_coupler_*motor_acceleration_;
    const double z_B_x_ = -l_B_x_coupler_theta_*z_coupler_theta_ - l_B_x_rocker_theta_*z_rocker_theta_ + rhs_B_x_;
    const double z_B_y_ = -l_B_y_coupler_theta_*z_coupler_theta_ - l_B_y_rocker_theta_*z_rocker_theta_ + rhs_B_y_;

    /* backward substitution */
    const double lambda_B_y_ = inverse_cross_B_x_B_y_*z_B_x_ + inverse_pivot_B_y_*z_B_y_;
    const double lambda_B_x_ = inverse_cross_B_x_B_y_*z_B_y_ + inverse_pivot_B_x_*z_B_x_;
    const double acceleration_coupler_theta_ = p->inverse_mass_coupler_coupler_*z_coupler_theta_
        - l_B_x_coupler_theta_*lambda_B_x_ - l_B_y_coupler_theta_*lambda_B_y_;
    const double acceleration_rocker_theta_ = p->inverse_mass_rocker_rocker_*z_rocker_theta_
        - l_B_x_rocker_theta_*lambda_B_x_ - l_B_y_rocker_theta_*lambda_B_y_;

    /* results */
    a[0] = acceleration_rocker_theta_;
    a[1] = acceleration_coupler_theta_;
    rhs->lambda[0] = lambda_B_x_;
    rhs->lambda[1] = lambda_B_y_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = -motor_rate_*rhs->lambda[0]*span_crank_head_y_ + motor_rate_*rhs->lambda[1]*span_crank_head_x_
        + motor_rate_*(a[1]*dot_crank_coupler_ - cos_theta_crank_*p->weight_crank_across_
        - (coupler_omega_ * coupler_omega_)*cross_crank_coupler_ + p->mass_motor_motor_*motor_acceleration_);
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
    const double rocker_theta_ = q[0];
    const double coupler_theta_ = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {rocker_theta_, coupler_theta_, coupler_theta_, coupler_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_rocker_ = cosines_0[0];
    const double sin_theta_rocker_ = sines_0[0];
    const double cos_theta_coupler_ = cosines_0[1];
    const double sin_theta_coupler_ = sines_0[1];
    const double span_coupler_head_x_ = cos_theta_coupler_*p->coupler_head_span_x_;
    const double span_coupler_head_y_ = p->coupler_head_span_x_*sin_theta_coupler_;
    const double span_rocker_head_x_ = cos_theta_rocker_*p->rocker_head_span_x_;
    const double span_rocker_head_y_ = p->rocker_head_span_x_*sin_theta_rocker_;

    /* right-hand side */
    const double r_B_x_ = r[0];
    const double r_B_y_ = r[1];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_B_x_rocker_theta_ = p->inverse_tree_metric_rocker_theta_*span_rocker_head_y_;
    const double l_B_y_rocker_theta_ = -p->inverse_tree_metric_rocker_theta_*span_rocker_head_x_;
    const double l_B_x_coupler_theta_ = -p->inverse_tree_metric_coupler_theta_*span_coupler_head_y_;
    const double l_B_y_coupler_theta_ = p->inverse_tree_metric_coupler_theta_*span_coupler_head_x_;
    const double scale_B_x_ = -l_B_x_coupler_theta_*span_coupler_head_y_ + l_B_x_rocker_theta_*span_rocker_head_y_;
    const double scale_B_y_ = l_B_y_coupler_theta_*span_coupler_head_x_ - l_B_y_rocker_theta_*span_rocker_head_x_;
    const double pivot_B_x_B_y_ = -l_B_y_coupler_theta_*span_coupler_head_y_ + l_B_y_rocker_theta_*span_rocker_head_y_;
    const double determinant_B_x_B_y_ = -(pivot_B_x_B_y_ * pivot_B_x_B_y_) + scale_B_x_*scale_B_y_;
    if (!(scale_B_x_ > 0.0 && scale_B_x_ < INFINITY))
        return 1;
    if (!(determinant_B_x_B_y_ > SINGULAR * scale_B_y_ * scale_B_x_))
        return 2;
    const double size_B_x_ = scale_B_x_ + scale_B_y_;
    if (!(scale_B_x_ > VANISHING * size_B_x_))
        return 1;
    if (!(determinant_B_x_B_y_ > VANISHING * size_B_x_ * scale_B_x_))
        return 2;
    const double inverse_B_x_B_y_ = -1.0/determinant_B_x_B_y_;
    const double inverse_pivot_B_x_ = inverse_B_x_B_y_*scale_B_y_;
    const double inverse_pivot_B_y_ = inverse_B_x_B_y_*scale_B_x_;
    const double inverse_cross_B_x_B_y_ = -inverse_B_x_B_y_*pivot_B_x_B_y_;

    /* backward substitution */
    const double step_lambda_B_y_ = inverse_cross_B_x_B_y_*r_B_x_ + inverse_pivot_B_y_*r_B_y_;
    const double step_lambda_B_x_ = inverse_cross_B_x_B_y_*r_B_y_ + inverse_pivot_B_x_*r_B_x_;
    const double step_acceleration_coupler_theta_ = -l_B_x_coupler_theta_*step_lambda_B_x_
        - l_B_y_coupler_theta_*step_lambda_B_y_;
    const double step_acceleration_rocker_theta_ = -l_B_x_rocker_theta_*step_lambda_B_x_
        - l_B_y_rocker_theta_*step_lambda_B_y_;

    /* results */
    x[0] = step_acceleration_rocker_theta_;
    x[1] = step_acceleration_coupler_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[4];
    closing[1] = + lambda[5];
}
