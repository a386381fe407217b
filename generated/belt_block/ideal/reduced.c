/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     block: on ground by guide, displaced by guide.slide; its angle is constant
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = guide.slide (m)
 * Loop closures, with the storage of their multipliers:
 *     none
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
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double guide_slide_ = q[0];
    const double guide_slide_rate_ = v[0];

    /* directions, arms, drives */
    const double block_y_ = 0.0;
    const double block_vy_ = 0.0;
    const double block_theta_ = 0.0;
    const double block_omega_ = 0.0;

    /* bodies */
    all_q[0] = guide_slide_;
    all_v[0] = guide_slide_rate_;
    all_q[1] = block_y_;
    all_v[1] = block_vy_;
    all_q[2] = block_theta_;
    all_v[2] = block_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double block_x_ = q[0];
    const double block_vx_ = v[0];

    /* tree coordinates */
    s[0] = block_x_;  /* guide.slide */
    s_rate[0] = block_vx_;
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)v, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     guide.slide; lambda of rub.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    (void)t;
    /* branches of switching functions that are held, if any */
    const double *const branch = discrete->is_frozen ? discrete->branch : NULL;
    double *const g = rhs->g;

    /* coordinates, velocities, time */
    const double guide_slide_ = q[0];
    const double guide_slide_rate_ = v[0];

    /* directions, arms, drives */
    const double spring_span_x_ = guide_slide_ - p->wall_x_;
    const double side_0 = branch_of(branch, g, 0, spring_span_x_);
    const double spring_length_ = side_0*spring_span_x_;
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const double spring_pull_ = spring_force_/spring_length_;

    /* friction: slip, or stick as a constraint equation */
    const double slip_rub_ = guide_slide_rate_ - p->rub_speed_;
    const double mode_rub_ = discrete->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub_ = mode_rub_ == 0.0 ? 1.0 : 0.0;
    const double sign_rub_ = fabs(mode_rub_) > 1.0 ? 0.0 : mode_rub_;
    const double kinetic_rub_ = -p->rub_kinetic_*sign_rub_;
    const double rhs_rub_ = -slip_rub_*p->two_alpha_stick_;
    rhs->friction[0].v = slip_rub_;
    rhs->friction[0].static_limit = p->rub_static_;
    rhs->friction[0].speed = p->rub_speed_;
    rhs->friction[0].force = kinetic_rub_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double scale_rub_ = p->inverse_block_mass_;
    if (stick_rub_ != 0.0 && !(scale_rub_ > 0.0 && scale_rub_ < INFINITY))
        return 1;
    const double inverse_pivot_rub_ = stick_rub_ != 0.0 ? 1.0/scale_rub_ : 0.0;

    /* forward substitution */
    const double z_guide_slide_ = kinetic_rub_ - spring_pull_*spring_span_x_;
    const double z_rub_ = -p->inverse_block_mass_*z_guide_slide_ + rhs_rub_;

    /* backward substitution */
    const double lambda_rub_ = -inverse_pivot_rub_*z_rub_;
    const double acceleration_guide_slide_ = -p->inverse_block_mass_*lambda_rub_
        + p->inverse_block_mass_*z_guide_slide_;

    /* results */
    a[0] = acceleration_guide_slide_;
    rhs->friction[0].rate = acceleration_guide_slide_;
    if (stick_rub_ != 0.0)
        rhs->friction[0].force = -lambda_rub_;  /* stick of rub */
    rhs->power[0] = 0.0;
    rhs->power[1] = rhs->friction[0].force*(rhs->friction[0].speed + rhs->friction[0].v);
    rhs->power[2] = 0.0;
    return 0;
}

/*
 * Event functions: the scene's own switching functions in rhs->g, the user's events in rhs->event.
 */
void monitored_functions(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, RhsOutputs *rhs)
{
    (void)t, (void)v, (void)discrete;
    /* coordinates, velocities, time */
    const double guide_slide_ = q[0];

    /* directions, arms, drives */
    const double spring_span_x_ = guide_slide_ - p->wall_x_;
    rhs->g[0] = spring_span_x_;
}

/*
 * The smallest x (n) in the metric of M with Phi_q x = r, for Newton's step and velocities. r has all rows
 * of the closed linkage; those of open joints and redundant ones are ignored.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t, (void)q, (void)r, (void)p;
    /* backward substitution */
    const double step_acceleration_guide_slide_ = 0.0;

    /* results */
    x[0] = step_acceleration_guide_slide_;
    return 0;
}
