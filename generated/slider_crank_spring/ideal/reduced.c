/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     crank: on ground by O; its angle is an unknown
 *     rod: on crank by pin; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = crank.theta (rad); q[1] = rod.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of slider.offset
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
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[0];
    const double crank_omega_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double crank_x_ = 0.0;
    const double crank_y_ = 0.0;
    const double crank_vx_ = 0.0;
    const double crank_vy_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double crank_head_vx_ = -crank_omega_*span_crank_head_y_;
    const double crank_head_vy_ = crank_omega_*span_crank_head_x_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const double span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const double rod_x_ = span_crank_head_x_ + span_rod_com_x_;
    const double rod_vx_ = crank_head_vx_ - rod_omega_*span_rod_com_y_;
    const double rod_y_ = span_crank_head_y_ + span_rod_com_y_;
    const double rod_vy_ = crank_head_vy_ + rod_omega_*span_rod_com_x_;

    /* bodies */
    all_q[0] = crank_x_;
    all_v[0] = crank_vx_;
    all_q[1] = crank_y_;
    all_v[1] = crank_vy_;
    all_q[2] = crank_theta_;
    all_v[2] = crank_omega_;
    all_q[3] = rod_x_;
    all_v[3] = rod_vx_;
    all_q[4] = rod_y_;
    all_v[4] = rod_vy_;
    all_q[5] = rod_theta_;
    all_v[5] = rod_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[2];
    const double crank_omega_ = v[2];
    const double rod_theta_ = q[5];
    const double rod_omega_ = v[5];

    /* tree coordinates */
    s[0] = crank_theta_;  /* crank */
    s_rate[0] = crank_omega_;
    s[1] = rod_theta_;  /* rod */
    s_rate[1] = rod_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
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
    const double crank_theta_ = q[0];
    const double rod_theta_ = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double sin_theta_crank_ = sines_0[0];
    const double sin_theta_rod_ = sines_0[1];
    const double span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;

    /* rows */
    out[0] = span_crank_head_y_ + span_rod_com_y_;  /* slider.offset */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[0];
    const double crank_omega_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;

    /* rows */
    out[0] = crank_omega_*span_crank_head_x_ + rod_omega_*span_rod_com_x_;  /* slider.offset */
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     crank.theta; rod.theta; lambda of slider.offset.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double crank_theta_ = q[0];
    const double crank_omega_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double crank_head_vx_ = -crank_omega_*span_crank_head_y_;
    const double crank_head_vy_ = crank_omega_*span_crank_head_x_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const double span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const double span_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const double span_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const double crank_middle_vx_ = -crank_omega_*span_crank_middle_y_;
    const double crank_middle_vy_ = crank_omega_*span_crank_middle_x_;
    const double span_rod_middle_x_ = cos_theta_rod_*p->rod_middle_span_x_;
    const double span_rod_middle_y_ = p->rod_middle_span_x_*sin_theta_rod_;
    const double rod_middle_x_ = span_crank_head_x_ + span_rod_middle_x_;
    const double rod_middle_vx_ = crank_head_vx_ - rod_omega_*span_rod_middle_y_;
    const double rod_middle_y_ = span_crank_head_y_ + span_rod_middle_y_;
    const double rod_middle_vy_ = crank_head_vy_ + rod_omega_*span_rod_middle_x_;
    const double coil_span_x_ = rod_middle_x_ - span_crank_middle_x_;
    const double coil_span_y_ = rod_middle_y_ - span_crank_middle_y_;
    const double coil_span_rate_x_ = -crank_middle_vx_ + rod_middle_vx_;
    const double coil_span_rate_y_ = -crank_middle_vy_ + rod_middle_vy_;
    const double coil_length_ = sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const double coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const double coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);
    const double coil_pull_ = coil_force_/coil_length_;
    const double span_rod_tip_y_ = p->rod_tip_span_x_*sin_theta_rod_;
    const double rod_tip_vx_ = crank_head_vx_ - rod_omega_*span_rod_tip_y_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_slider_offset_ = (crank_omega_ * crank_omega_)*span_crank_head_y_
        + (rod_omega_ * rod_omega_)*span_rod_com_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_crank_crank_ > LIGHT_PIVOT * p->crank_turning_)) {
        pivot = 2;
        goto dependent;
    }
    const double l_rod_theta_crank_theta_ = dot_crank_rod_*p->inverse_mass_crank_crank_;
    const double l_slider_offset_crank_theta_ = p->inverse_mass_crank_crank_*span_crank_head_x_;
    const double pivot_rod_theta_ = -dot_crank_rod_*l_rod_theta_crank_theta_ + p->mass_rod_rod_;
    if (!(pivot_rod_theta_ > LIGHT_PIVOT * p->rod_turning_)) {
        pivot = 3;
        goto dependent;
    }
    const double inverse_pivot_rod_theta_ = 1.0/pivot_rod_theta_;
    const double w_slider_offset_rod_theta_ = -dot_crank_rod_*l_slider_offset_crank_theta_ + span_rod_com_x_;
    const double l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_*w_slider_offset_rod_theta_;
    const double scale_slider_offset_ = l_slider_offset_crank_theta_*span_crank_head_x_
        + l_slider_offset_rod_theta_*w_slider_offset_rod_theta_;
    if (!(scale_slider_offset_ > 0.0 && scale_slider_offset_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;

    /* forward substitution */
    const double z_crank_theta_ = -coil_pull_*coil_span_x_*span_crank_middle_y_
        - coil_pull_*coil_span_y_*span_crank_head_x_ + coil_pull_*coil_span_y_*span_crank_middle_x_
        + cross_crank_rod_*(rod_omega_ * rod_omega_) - span_crank_head_y_*(-coil_pull_*coil_span_x_ + p->push_value_x_);
    const double z_rod_theta_ = coil_pull_*coil_span_x_*span_rod_middle_y_ - coil_pull_*coil_span_y_*span_rod_middle_x_
        - (crank_omega_ * crank_omega_)*cross_crank_rod_ - l_rod_theta_crank_theta_*z_crank_theta_
        - p->push_value_x_*span_rod_tip_y_;
    const double z_slider_offset_ = -l_slider_offset_crank_theta_*z_crank_theta_
        - l_slider_offset_rod_theta_*z_rod_theta_ + rhs_slider_offset_;

    /* backward substitution */
    const double lambda_slider_offset_ = -inverse_pivot_slider_offset_*z_slider_offset_;
    const double acceleration_rod_theta_ = inverse_pivot_rod_theta_*z_rod_theta_
        - l_slider_offset_rod_theta_*lambda_slider_offset_;
    const double acceleration_crank_theta_ = -acceleration_rod_theta_*l_rod_theta_crank_theta_
        + p->inverse_mass_crank_crank_*z_crank_theta_ - l_slider_offset_crank_theta_*lambda_slider_offset_;

    /* results */
    a[0] = acceleration_crank_theta_;
    a[1] = acceleration_rod_theta_;
    rhs->lambda[0] = lambda_slider_offset_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = -p->coil_damping_*(coil_length_rate_ * coil_length_rate_) + p->push_value_x_*rod_tip_vx_;
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
    const double crank_theta_ = q[0];
    const double rod_theta_ = q[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;

    /* right-hand side */
    const double r_slider_offset_ = r[0];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_rod_theta_crank_theta_ = dot_crank_rod_*p->inverse_tree_metric_crank_theta_;
    const double l_slider_offset_crank_theta_ = p->inverse_tree_metric_crank_theta_*span_crank_head_x_;
    const double inverse_pivot_rod_theta_ = 1.0/(-dot_crank_rod_*l_rod_theta_crank_theta_ + p->tree_metric_rod_theta_);
    const double w_slider_offset_rod_theta_ = -dot_crank_rod_*l_slider_offset_crank_theta_ + span_rod_com_x_;
    const double l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_*w_slider_offset_rod_theta_;
    const double scale_slider_offset_ = l_slider_offset_crank_theta_*span_crank_head_x_
        + l_slider_offset_rod_theta_*w_slider_offset_rod_theta_;
    if (!(scale_slider_offset_ > 0.0 && scale_slider_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;

    /* backward substitution */
    const double step_lambda_slider_offset_ = -inverse_pivot_slider_offset_*r_slider_offset_;
    const double step_acceleration_rod_theta_ = -l_slider_offset_rod_theta_*step_lambda_slider_offset_;
    const double step_acceleration_crank_theta_ = -l_rod_theta_crank_theta_*step_acceleration_rod_theta_
        - l_slider_offset_crank_theta_*step_lambda_slider_offset_;

    /* results */
    x[0] = step_acceleration_crank_theta_;
    x[1] = step_acceleration_rod_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[4];
}
