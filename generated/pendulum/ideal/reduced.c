/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     bob: moves freely, x and y are unknowns; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = bob.x (m); q[1] = bob.y (m); q[2] = bob.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of rod.length
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
    const double bob_x_ = q[0];
    const double bob_x_rate_ = v[0];
    const double bob_y_ = q[1];
    const double bob_y_rate_ = v[1];
    const double bob_theta_ = q[2];
    const double bob_omega_ = v[2];

    /* bodies */
    all_q[0] = bob_x_;
    all_v[0] = bob_x_rate_;
    all_q[1] = bob_y_;
    all_v[1] = bob_y_rate_;
    all_q[2] = bob_theta_;
    all_v[2] = bob_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];
    const double bob_theta_ = q[2];
    const double bob_vx_ = v[0];
    const double bob_vy_ = v[1];
    const double bob_omega_ = v[2];

    /* tree coordinates */
    s[0] = bob_x_;  /* bob.x */
    s_rate[0] = bob_vx_;
    s[1] = bob_y_;  /* bob.y */
    s_rate[1] = bob_vy_;
    s[2] = bob_theta_;  /* bob */
    s_rate[2] = bob_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[0];  /* bob.x */
    a[1] = all_a[1];  /* bob.y */
    a[2] = all_a[2];  /* bob */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];

    /* rows */
    /* rod.length */
    out[0] = (bob_x_ * bob_x_)*p->rod_half_inverse_length_ + (bob_y_ * bob_y_)*p->rod_half_inverse_length_
        - 0.5*p->rod_length_;
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_x_rate_ = v[0];
    const double bob_y_ = q[1];
    const double bob_y_rate_ = v[1];

    /* rows */
    /* rod.length */
    out[0] = 2.0*bob_x_*bob_x_rate_*p->rod_half_inverse_length_ + 2.0*bob_y_*bob_y_rate_*p->rod_half_inverse_length_;
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     bob.theta; bob.x; bob.y; lambda of rod.length.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_x_rate_ = v[0];
    const double bob_y_ = q[1];
    const double bob_y_rate_ = v[1];

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_rod_length_ = -2.0*(bob_x_rate_ * bob_x_rate_)*p->rod_half_inverse_length_
        - 2.0*(bob_y_rate_ * bob_y_rate_)*p->rod_half_inverse_length_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_x_ = p->inverse_bob_mass_*w_rod_length_bob_x_;
    const double w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_y_ = p->inverse_bob_mass_*w_rod_length_bob_y_;
    const double scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    if (!(scale_rod_length_ > 0.0 && scale_rod_length_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* forward substitution */
    const double z_rod_length_ = -l_rod_length_bob_y_*p->weight_bob_y_ + rhs_rod_length_;

    /* backward substitution */
    const double lambda_rod_length_ = -inverse_pivot_rod_length_*z_rod_length_;
    const double acceleration_bob_y_ = p->inverse_bob_mass_*p->weight_bob_y_ - l_rod_length_bob_y_*lambda_rod_length_;
    const double acceleration_bob_x_ = -l_rod_length_bob_x_*lambda_rod_length_;
    const double acceleration_bob_theta_ = 0.0;

    /* results */
    a[0] = acceleration_bob_x_;
    a[1] = acceleration_bob_y_;
    a[2] = acceleration_bob_theta_;
    rhs->lambda[0] = lambda_rod_length_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = 0.0;
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
    const double bob_x_ = q[0];
    const double bob_y_ = q[1];

    /* right-hand side */
    const double r_rod_length_ = r[0];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_x_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_x_;
    const double w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_y_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_y_;
    const double scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    if (!(scale_rod_length_ > 0.0 && scale_rod_length_ < INFINITY))
        return 1;
    const double inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* backward substitution */
    const double step_lambda_rod_length_ = -inverse_pivot_rod_length_*r_rod_length_;
    const double step_acceleration_bob_y_ = -l_rod_length_bob_y_*step_lambda_rod_length_;
    const double step_acceleration_bob_x_ = -l_rod_length_bob_x_*step_lambda_rod_length_;
    const double step_acceleration_bob_theta_ = 0.0;

    /* results */
    x[0] = step_acceleration_bob_x_;
    x[1] = step_acceleration_bob_y_;
    x[2] = step_acceleration_bob_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[0];
}
