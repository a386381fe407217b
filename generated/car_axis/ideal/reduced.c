/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     road: on ground by foot; its angle is prescribed by bump
 *     axle: moves freely, x and y are unknowns; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = axle.x (m); q[1] = axle.y (m); q[2] = axle.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of slot.offset
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
    const double axle_x_ = q[0];
    const double axle_x_rate_ = v[0];
    const double axle_y_ = q[1];
    const double axle_y_rate_ = v[1];
    const double axle_theta_ = q[2];
    const double axle_omega_ = v[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, bump_value_, bump_value_, bump_value_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double span_road_com_x_ = cos_theta_road_*p->road_head_s_x_;
    const double span_road_com_y_ = p->road_head_s_x_*sin_theta_road_;
    const double road_vx_ = -bump_rate_*span_road_com_y_;
    const double road_vy_ = bump_rate_*span_road_com_x_;

    /* bodies */
    all_q[0] = axle_x_;
    all_v[0] = axle_x_rate_;
    all_q[1] = axle_y_;
    all_v[1] = axle_y_rate_;
    all_q[2] = axle_theta_;
    all_v[2] = axle_omega_;
    all_q[3] = span_road_com_x_;
    all_v[3] = road_vx_;
    all_q[4] = span_road_com_y_;
    all_v[4] = road_vy_;
    all_q[5] = bump_value_;
    all_v[5] = bump_rate_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];
    const double axle_vx_ = v[0];
    const double axle_vy_ = v[1];
    const double axle_omega_ = v[2];

    /* tree coordinates */
    s[0] = axle_x_;  /* axle.x */
    s_rate[0] = axle_vx_;
    s[1] = axle_y_;  /* axle.y */
    s_rate[1] = axle_vy_;
    s[2] = axle_theta_;  /* axle */
    s_rate[2] = axle_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
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
    const double axle_x_ = q[0];
    const double axle_y_ = q[1];
    const double axle_theta_ = q[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, axle_theta_, axle_theta_, axle_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double cos_theta_axle_ = cosines_0[1];
    const double sin_theta_axle_ = sines_0[1];
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* rows */
    /* slot.offset */
    out[0] = -axle_x_*cos_theta_road_ - axle_y_*sin_theta_road_ - cos_theta_road_*span_axle_tail_x_
        - sin_theta_road_*span_axle_tail_y_;
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_x_rate_ = v[0];
    const double axle_y_ = q[1];
    const double axle_y_rate_ = v[1];
    const double axle_theta_ = q[2];
    const double axle_omega_ = v[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, axle_theta_, axle_theta_, axle_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double cos_theta_axle_ = cosines_0[1];
    const double sin_theta_axle_ = sines_0[1];
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* rows */
    /* slot.offset */
    out[0] = axle_omega_*(cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_)
        - axle_x_rate_*cos_theta_road_ - axle_y_rate_*sin_theta_road_
        + bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     axle.x; axle.y; axle.theta; lambda of slot.offset.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_x_rate_ = v[0];
    const double axle_y_ = q[1];
    const double axle_y_rate_ = v[1];
    const double axle_theta_ = q[2];
    const double axle_omega_ = v[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, axle_theta_, axle_theta_, axle_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double cos_theta_axle_ = cosines_0[1];
    const double sin_theta_axle_ = sines_0[1];
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*sin(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*sin(p->omega_*t)*(cos(p->omega_*t)
        * cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*pow(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_), 1.5));
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;
    const double axle_tail_x_ = axle_x_ + span_axle_tail_x_;
    const double axle_tail_y_ = axle_y_ + span_axle_tail_y_;
    const double left_length_ = sqrt((axle_tail_x_ * axle_tail_x_) + (axle_tail_y_ * axle_tail_y_));
    const double left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const double left_pull_ = left_force_/left_length_;
    const double span_road_head_x_ = cos_theta_road_*p->road_head_span_x_;
    const double span_road_head_y_ = p->road_head_span_x_*sin_theta_road_;
    const double axle_head_x_ = axle_x_ - span_axle_tail_x_;
    const double axle_head_y_ = axle_y_ - span_axle_tail_y_;
    const double right_span_x_ = axle_head_x_ - span_road_head_x_;
    const double right_span_y_ = axle_head_y_ - span_road_head_y_;
    const double right_length_ = sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const double right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);
    const double right_pull_ = right_force_/right_length_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_slot_offset_ = -axle_omega_*(axle_omega_*cos_theta_road_*span_axle_tail_x_
        + axle_omega_*sin_theta_road_*span_axle_tail_y_) - bump_acceleration_*(cos_theta_road_*(-axle_y_
        - span_axle_tail_y_) - sin_theta_road_*(-axle_x_ - span_axle_tail_x_))
        + (bump_rate_ * bump_rate_)*cos_theta_road_*(-axle_x_ - span_axle_tail_x_)
        + (bump_rate_ * bump_rate_)*sin_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - 2.0*bump_rate_*cos_theta_road_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_)
        + 2.0*bump_rate_*sin_theta_road_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_);

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_axle_mass_;
    const double l_slot_offset_axle_y_ = -p->inverse_axle_mass_*sin_theta_road_;
    if (!(p->axle_inertia_ > LIGHT_PIVOT * p->axle_turning_)) {
        pivot = 2;
        goto dependent;
    }
    const double w_slot_offset_axle_theta_ = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    const double l_slot_offset_axle_theta_ = p->inverse_axle_inertia_*w_slot_offset_axle_theta_;
    const double scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_
        + l_slot_offset_axle_theta_*w_slot_offset_axle_theta_ - l_slot_offset_axle_y_*sin_theta_road_;
    if (!(scale_slot_offset_ > 0.0 && scale_slot_offset_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;

    /* forward substitution */
    const double z_axle_x_ = -axle_tail_x_*left_pull_ - right_pull_*right_span_x_;
    const double z_axle_y_ = -axle_tail_y_*left_pull_ - right_pull_*right_span_y_ + p->weight_axle_y_;
    const double z_axle_theta_ = span_axle_tail_x_*(-axle_tail_y_*left_pull_ + right_pull_*right_span_y_)
        - span_axle_tail_y_*(-axle_tail_x_*left_pull_ + right_pull_*right_span_x_);
    const double z_slot_offset_ = -l_slot_offset_axle_theta_*z_axle_theta_ - l_slot_offset_axle_x_*z_axle_x_
        - l_slot_offset_axle_y_*z_axle_y_ + rhs_slot_offset_;

    /* backward substitution */
    const double lambda_slot_offset_ = -inverse_pivot_slot_offset_*z_slot_offset_;
    const double acceleration_axle_theta_ = p->inverse_axle_inertia_*z_axle_theta_
        - l_slot_offset_axle_theta_*lambda_slot_offset_;
    const double acceleration_axle_y_ = p->inverse_axle_mass_*z_axle_y_ - l_slot_offset_axle_y_*lambda_slot_offset_;
    const double acceleration_axle_x_ = p->inverse_axle_mass_*z_axle_x_ - l_slot_offset_axle_x_*lambda_slot_offset_;

    /* results */
    a[0] = acceleration_axle_x_;
    a[1] = acceleration_axle_y_;
    a[2] = acceleration_axle_theta_;
    rhs->lambda[0] = lambda_slot_offset_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = bump_rate_*(bump_acceleration_*p->mass_bump_bump_ - cos_theta_road_*p->weight_road_across_
        + right_pull_*right_span_x_*span_road_head_y_ - right_pull_*right_span_y_*span_road_head_x_)
        - rhs->lambda[0]*(-bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_));
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
    /* coordinates, velocities, time */
    const double axle_theta_ = q[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, axle_theta_, axle_theta_, axle_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double cos_theta_axle_ = cosines_0[1];
    const double sin_theta_axle_ = sines_0[1];
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* right-hand side */
    const double r_slot_offset_ = r[0];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_tree_metric_axle_x_;
    const double l_slot_offset_axle_y_ = -p->inverse_tree_metric_axle_x_*sin_theta_road_;
    const double w_slot_offset_axle_theta_ = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    const double l_slot_offset_axle_theta_ = p->inverse_tree_metric_axle_theta_*w_slot_offset_axle_theta_;
    const double scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_
        + l_slot_offset_axle_theta_*w_slot_offset_axle_theta_ - l_slot_offset_axle_y_*sin_theta_road_;
    if (!(scale_slot_offset_ > 0.0 && scale_slot_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;

    /* backward substitution */
    const double step_lambda_slot_offset_ = -inverse_pivot_slot_offset_*r_slot_offset_;
    const double step_acceleration_axle_theta_ = -l_slot_offset_axle_theta_*step_lambda_slot_offset_;
    const double step_acceleration_axle_y_ = -l_slot_offset_axle_y_*step_lambda_slot_offset_;
    const double step_acceleration_axle_x_ = -l_slot_offset_axle_x_*step_lambda_slot_offset_;

    /* results */
    x[0] = step_acceleration_axle_x_;
    x[1] = step_acceleration_axle_y_;
    x[2] = step_acceleration_axle_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[2];
}
