/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     crank0: on ground by O0; its angle is an unknown
 *     crank1: on ground by O1; its angle is an unknown
 *     crank2: on ground by O2; its angle is an unknown
 *     coupler1: on crank0 by A0; its angle is an unknown
 *     coupler2: on crank1 by A1; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = crank0.theta (rad); q[1] = crank1.theta (rad); q[2] = crank2.theta (rad);
 *     q[3] = coupler1.theta (rad); q[4] = coupler2.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of B2.x; rhs->lambda[1] of B2.y; rhs->lambda[2] of B1.x; rhs->lambda[3] of B1.y
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
    const double crank0_theta_ = q[0];
    const double crank0_omega_ = v[0];
    const double crank1_theta_ = q[1];
    const double crank1_omega_ = v[1];
    const double crank2_theta_ = q[2];
    const double crank2_omega_ = v[2];
    const double coupler1_theta_ = q[3];
    const double coupler1_omega_ = v[3];
    const double coupler2_theta_ = q[4];
    const double coupler2_omega_ = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_com_x_ = cos_theta_crank0_*p->crank0_head_s_x_;
    const double span_crank0_com_y_ = p->crank0_head_s_x_*sin_theta_crank0_;
    const double crank0_vx_ = -crank0_omega_*span_crank0_com_y_;
    const double crank0_vy_ = crank0_omega_*span_crank0_com_x_;
    const double span_crank1_com_x_ = cos_theta_crank1_*p->crank1_head_s_x_;
    const double span_crank1_com_y_ = p->crank1_head_s_x_*sin_theta_crank1_;
    const double crank1_x_ = p->O1_x_ + span_crank1_com_x_;
    const double crank1_vx_ = -crank1_omega_*span_crank1_com_y_;
    const double crank1_vy_ = crank1_omega_*span_crank1_com_x_;
    const double span_crank2_com_x_ = cos_theta_crank2_*p->crank2_head_s_x_;
    const double span_crank2_com_y_ = p->crank2_head_s_x_*sin_theta_crank2_;
    const double crank2_x_ = p->O2_x_ + span_crank2_com_x_;
    const double crank2_vx_ = -crank2_omega_*span_crank2_com_y_;
    const double crank2_vy_ = crank2_omega_*span_crank2_com_x_;
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double crank0_head_vx_ = -crank0_omega_*span_crank0_head_y_;
    const double crank0_head_vy_ = crank0_omega_*span_crank0_head_x_;
    const double span_coupler1_com_x_ = cos_theta_coupler1_*p->coupler1_head_s_x_;
    const double span_coupler1_com_y_ = p->coupler1_head_s_x_*sin_theta_coupler1_;
    const double coupler1_x_ = span_coupler1_com_x_ + span_crank0_head_x_;
    const double coupler1_vx_ = -coupler1_omega_*span_coupler1_com_y_ + crank0_head_vx_;
    const double coupler1_y_ = span_coupler1_com_y_ + span_crank0_head_y_;
    const double coupler1_vy_ = coupler1_omega_*span_coupler1_com_x_ + crank0_head_vy_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double crank1_head_x_ = p->O1_x_ + span_crank1_head_x_;
    const double crank1_head_vx_ = -crank1_omega_*span_crank1_head_y_;
    const double crank1_head_vy_ = crank1_omega_*span_crank1_head_x_;
    const double span_coupler2_com_x_ = cos_theta_coupler2_*p->coupler2_head_s_x_;
    const double span_coupler2_com_y_ = p->coupler2_head_s_x_*sin_theta_coupler2_;
    const double coupler2_x_ = crank1_head_x_ + span_coupler2_com_x_;
    const double coupler2_vx_ = -coupler2_omega_*span_coupler2_com_y_ + crank1_head_vx_;
    const double coupler2_y_ = span_coupler2_com_y_ + span_crank1_head_y_;
    const double coupler2_vy_ = coupler2_omega_*span_coupler2_com_x_ + crank1_head_vy_;

    /* bodies */
    all_q[0] = span_crank0_com_x_;
    all_v[0] = crank0_vx_;
    all_q[1] = span_crank0_com_y_;
    all_v[1] = crank0_vy_;
    all_q[2] = crank0_theta_;
    all_v[2] = crank0_omega_;
    all_q[3] = crank1_x_;
    all_v[3] = crank1_vx_;
    all_q[4] = span_crank1_com_y_;
    all_v[4] = crank1_vy_;
    all_q[5] = crank1_theta_;
    all_v[5] = crank1_omega_;
    all_q[6] = crank2_x_;
    all_v[6] = crank2_vx_;
    all_q[7] = span_crank2_com_y_;
    all_v[7] = crank2_vy_;
    all_q[8] = crank2_theta_;
    all_v[8] = crank2_omega_;
    all_q[9] = coupler1_x_;
    all_v[9] = coupler1_vx_;
    all_q[10] = coupler1_y_;
    all_v[10] = coupler1_vy_;
    all_q[11] = coupler1_theta_;
    all_v[11] = coupler1_omega_;
    all_q[12] = coupler2_x_;
    all_v[12] = coupler2_vx_;
    all_q[13] = coupler2_y_;
    all_v[13] = coupler2_vy_;
    all_q[14] = coupler2_theta_;
    all_v[14] = coupler2_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[2];
    const double crank0_omega_ = v[2];
    const double crank1_theta_ = q[5];
    const double crank1_omega_ = v[5];
    const double crank2_theta_ = q[8];
    const double crank2_omega_ = v[8];
    const double coupler1_theta_ = q[11];
    const double coupler1_omega_ = v[11];
    const double coupler2_theta_ = q[14];
    const double coupler2_omega_ = v[14];

    /* tree coordinates */
    s[0] = crank0_theta_;  /* crank0 */
    s_rate[0] = crank0_omega_;
    s[1] = crank1_theta_;  /* crank1 */
    s_rate[1] = crank1_omega_;
    s[2] = crank2_theta_;  /* crank2 */
    s_rate[2] = crank2_omega_;
    s[3] = coupler1_theta_;  /* coupler1 */
    s_rate[3] = coupler1_omega_;
    s[4] = coupler2_theta_;  /* coupler2 */
    s_rate[4] = coupler2_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[2];  /* crank0 */
    a[1] = all_a[5];  /* crank1 */
    a[2] = all_a[8];  /* crank2 */
    a[3] = all_a[11];  /* coupler1 */
    a[4] = all_a[14];  /* coupler2 */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[0];
    const double crank1_theta_ = q[1];
    const double crank2_theta_ = q[2];
    const double coupler1_theta_ = q[3];
    const double coupler2_theta_ = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;

    /* rows */
    out[0] = p->O1_x_ - p->O2_x_ + span_coupler2_head_x_ + span_crank1_head_x_ - span_crank2_head_x_;  /* B2.x */
    out[1] = span_coupler2_head_y_ + span_crank1_head_y_ - span_crank2_head_y_;  /* B2.y */
    out[2] = -p->O1_x_ + span_coupler1_head_x_ + span_crank0_head_x_ - span_crank1_head_x_;  /* B1.x */
    out[3] = span_coupler1_head_y_ + span_crank0_head_y_ - span_crank1_head_y_;  /* B1.y */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[0];
    const double crank0_omega_ = v[0];
    const double crank1_theta_ = q[1];
    const double crank1_omega_ = v[1];
    const double crank2_theta_ = q[2];
    const double crank2_omega_ = v[2];
    const double coupler1_theta_ = q[3];
    const double coupler1_omega_ = v[3];
    const double coupler2_theta_ = q[4];
    const double coupler2_omega_ = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;

    /* rows */
    /* B2.x */
    out[0] = -coupler2_omega_*span_coupler2_head_y_ - crank1_omega_*span_crank1_head_y_
        + crank2_omega_*span_crank2_head_y_;
    /* B2.y */
    out[1] = coupler2_omega_*span_coupler2_head_x_ + crank1_omega_*span_crank1_head_x_
        - crank2_omega_*span_crank2_head_x_;
    /* B1.x */
    out[2] = -coupler1_omega_*span_coupler1_head_y_ - crank0_omega_*span_crank0_head_y_
        + crank1_omega_*span_crank1_head_y_;
    /* B1.y */
    out[3] = coupler1_omega_*span_coupler1_head_x_ + crank0_omega_*span_crank0_head_x_
        - crank1_omega_*span_crank1_head_x_;
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     crank2.theta; coupler2.theta; lambda of B2.x with lambda of B2.y; crank1.theta; crank0.theta;
 *     coupler1.theta; lambda of B1.x with lambda of B1.y.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[0];
    const double crank0_omega_ = v[0];
    const double crank1_theta_ = q[1];
    const double crank1_omega_ = v[1];
    const double crank2_theta_ = q[2];
    const double crank2_omega_ = v[2];
    const double coupler1_theta_ = q[3];
    const double coupler1_omega_ = v[3];
    const double coupler2_theta_ = q[4];
    const double coupler2_omega_ = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const double cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const double sin_coupler1_less_crank0_ = -cos_theta_coupler1_*sin_theta_crank0_
        + cos_theta_crank0_*sin_theta_coupler1_;
    const double dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const double cross_crank0_coupler1_ = p->inertia_crank0_coupler1_*sin_coupler1_less_crank0_;
    const double cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const double sin_coupler2_less_crank1_ = -cos_theta_coupler2_*sin_theta_crank1_
        + cos_theta_crank1_*sin_theta_coupler2_;
    const double dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;
    const double cross_crank1_coupler2_ = p->inertia_crank1_coupler2_*sin_coupler2_less_crank1_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_B2_x_ = (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_x_
        + (crank1_omega_ * crank1_omega_)*span_crank1_head_x_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_x_;
    const double rhs_B2_y_ = (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_y_
        + (crank1_omega_ * crank1_omega_)*span_crank1_head_y_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_y_;
    const double rhs_B1_x_ = (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_x_
        + (crank0_omega_ * crank0_omega_)*span_crank0_head_x_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_x_;
    const double rhs_B1_y_ = (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_y_
        + (crank0_omega_ * crank0_omega_)*span_crank0_head_y_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_crank2_crank2_ > LIGHT_PIVOT * p->crank2_turning_)) {
        pivot = 5;
        goto dependent;
    }
    const double l_B2_x_crank2_theta_ = p->inverse_mass_crank2_crank2_*span_crank2_head_y_;
    const double l_B2_y_crank2_theta_ = -p->inverse_mass_crank2_crank2_*span_crank2_head_x_;
    if (!(p->mass_coupler2_coupler2_ > LIGHT_PIVOT * p->coupler2_turning_)) {
        pivot = 6;
        goto dependent;
    }
    const double l_B2_x_coupler2_theta_ = -p->inverse_mass_coupler2_coupler2_*span_coupler2_head_y_;
    const double l_B2_y_coupler2_theta_ = p->inverse_mass_coupler2_coupler2_*span_coupler2_head_x_;
    const double l_crank1_theta_coupler2_theta_ = dot_crank1_coupler2_*p->inverse_mass_coupler2_coupler2_;
    const double scale_B2_x_ = -l_B2_x_coupler2_theta_*span_coupler2_head_y_ + l_B2_x_crank2_theta_*span_crank2_head_y_;
    const double scale_B2_y_ = l_B2_y_coupler2_theta_*span_coupler2_head_x_ - l_B2_y_crank2_theta_*span_crank2_head_x_;
    const double pivot_B2_x_B2_y_ = -l_B2_y_coupler2_theta_*span_coupler2_head_y_
        + l_B2_y_crank2_theta_*span_crank2_head_y_;
    const double determinant_B2_x_B2_y_ = -(pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_) + scale_B2_x_*scale_B2_y_;
    if (!(scale_B2_x_ > 0.0 && scale_B2_x_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B2_x_B2_y_ > EARLY * scale_B2_y_ * scale_B2_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double size_B2_x_ = scale_B2_x_ + scale_B2_y_;
    if (!(scale_B2_x_ > discrete->min_pivot_size * size_B2_x_)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B2_x_B2_y_ > discrete->min_pivot_size * size_B2_x_ * scale_B2_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const double inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*scale_B2_y_;
    const double inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*scale_B2_x_;
    const double inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;
    const double w_crank1_theta_B2_x_ = l_crank1_theta_coupler2_theta_*span_coupler2_head_y_ - span_crank1_head_y_;
    const double w_crank1_theta_B2_y_ = -l_crank1_theta_coupler2_theta_*span_coupler2_head_x_ + span_crank1_head_x_;
    const double l_crank1_theta_B2_x_ = inverse_cross_B2_x_B2_y_*w_crank1_theta_B2_y_
        + inverse_pivot_B2_x_*w_crank1_theta_B2_x_;
    const double l_crank1_theta_B2_y_ = inverse_cross_B2_x_B2_y_*w_crank1_theta_B2_x_
        + inverse_pivot_B2_y_*w_crank1_theta_B2_y_;
    const double pivot_crank1_theta_ = -dot_crank1_coupler2_*l_crank1_theta_coupler2_theta_
        - l_crank1_theta_B2_x_*w_crank1_theta_B2_x_ - l_crank1_theta_B2_y_*w_crank1_theta_B2_y_
        + p->mass_crank1_crank1_;
    if (!(pivot_crank1_theta_ > LIGHT_PIVOT * p->crank1_turning_)) {
        pivot = 7;
        goto dependent;
    }
    const double inverse_pivot_crank1_theta_ = 1.0/pivot_crank1_theta_;
    const double l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*span_crank1_head_y_;
    const double l_B1_y_crank1_theta_ = -inverse_pivot_crank1_theta_*span_crank1_head_x_;
    if (!(p->mass_crank0_crank0_ > LIGHT_PIVOT * p->crank0_turning_)) {
        pivot = 8;
        goto dependent;
    }
    const double l_coupler1_theta_crank0_theta_ = dot_crank0_coupler1_*p->inverse_mass_crank0_crank0_;
    const double l_B1_x_crank0_theta_ = -p->inverse_mass_crank0_crank0_*span_crank0_head_y_;
    const double l_B1_y_crank0_theta_ = p->inverse_mass_crank0_crank0_*span_crank0_head_x_;
    const double pivot_coupler1_theta_ = -dot_crank0_coupler1_*l_coupler1_theta_crank0_theta_
        + p->mass_coupler1_coupler1_;
    if (!(pivot_coupler1_theta_ > LIGHT_PIVOT * p->coupler1_turning_)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pivot_coupler1_theta_ = 1.0/pivot_coupler1_theta_;
    const double w_B1_x_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_x_crank0_theta_ - span_coupler1_head_y_;
    const double l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const double w_B1_y_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_y_crank0_theta_ + span_coupler1_head_x_;
    const double l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const double scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_x_crank0_theta_*span_crank0_head_y_
        + l_B1_x_crank1_theta_*span_crank1_head_y_;
    const double scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_ + l_B1_y_crank0_theta_*span_crank0_head_x_
        - l_B1_y_crank1_theta_*span_crank1_head_x_;
    const double pivot_B1_x_B1_y_ = l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_
        - l_B1_y_crank0_theta_*span_crank0_head_y_ + l_B1_y_crank1_theta_*span_crank1_head_y_;
    const double determinant_B1_x_B1_y_ = -(pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_) + scale_B1_x_*scale_B1_y_;
    if (!(scale_B1_x_ > 0.0 && scale_B1_x_ < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B1_x_B1_y_ > discrete->min_pivot * scale_B1_y_ * scale_B1_x_)) {
        pivot = 4;
        goto dependent;
    }
    const double size_B1_x_ = scale_B1_x_ + scale_B1_y_;
    if (!(scale_B1_x_ > discrete->min_pivot_size * size_B1_x_)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B1_x_B1_y_ > discrete->min_pivot_size * size_B1_x_ * scale_B1_x_)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const double inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*scale_B1_y_;
    const double inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*scale_B1_x_;
    const double inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;

    /* forward substitution */
    const double z_crank2_theta_ = cos_theta_crank2_*p->weight_crank2_across_;
    const double z_coupler2_theta_ = cos_theta_coupler2_*p->weight_coupler2_across_
        - (crank1_omega_ * crank1_omega_)*cross_crank1_coupler2_;
    const double z_B2_x_ = -l_B2_x_coupler2_theta_*z_coupler2_theta_ - l_B2_x_crank2_theta_*z_crank2_theta_ + rhs_B2_x_;
    const double z_B2_y_ = -l_B2_y_coupler2_theta_*z_coupler2_theta_ - l_B2_y_crank2_theta_*z_crank2_theta_ + rhs_B2_y_;
    const double z_crank1_theta_ = cos_theta_crank1_*p->weight_crank1_across_
        + (coupler2_omega_ * coupler2_omega_)*cross_crank1_coupler2_ - l_crank1_theta_B2_x_*z_B2_x_
        - l_crank1_theta_B2_y_*z_B2_y_ - l_crank1_theta_coupler2_theta_*z_coupler2_theta_;
    const double z_crank0_theta_ = cos_theta_crank0_*p->weight_crank0_across_
        + (coupler1_omega_ * coupler1_omega_)*cross_crank0_coupler1_;
    const double z_coupler1_theta_ = cos_theta_coupler1_*p->weight_coupler1_across_
        - (crank0_omega_ * crank0_omega_)*cross_crank0_coupler1_ - l_coupler1_theta_crank0_theta_*z_crank0_theta_;
    const double z_B1_x_ = -l_B1_x_coupler1_theta_*z_coupler1_theta_ - l_B1_x_crank0_theta_*z_crank0_theta_
        - l_B1_x_crank1_theta_*z_crank1_theta_ + rhs_B1_x_;
    const double z_B1_y_ = -l_B1_y_coupler1_theta_*z_coupler1_theta_ - l_B1_y_crank0_theta_*z_crank0_theta_
        - l_B1_y_crank1_theta_*z_crank1_theta_ + rhs_B1_y_;

    /* backward substitution */
    const double lambda_B1_y_ = inverse_cross_B1_x_B1_y_*z_B1_x_ + inverse_pivot_B1_y_*z_B1_y_;
    const double lambda_B1_x_ = inverse_cross_B1_x_B1_y_*z_B1_y_ + inverse_pivot_B1_x_*z_B1_x_;
    const double acceleration_coupler1_theta_ = inverse_pivot_coupler1_theta_*z_coupler1_theta_
        - l_B1_x_coupler1_theta_*lambda_B1_x_ - l_B1_y_coupler1_theta_*lambda_B1_y_;
    const double acceleration_crank0_theta_ = -acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        + p->inverse_mass_crank0_crank0_*z_crank0_theta_ - l_B1_x_crank0_theta_*lambda_B1_x_
        - l_B1_y_crank0_theta_*lambda_B1_y_;
    const double acceleration_crank1_theta_ = inverse_pivot_crank1_theta_*z_crank1_theta_
        - l_B1_x_crank1_theta_*lambda_B1_x_ - l_B1_y_crank1_theta_*lambda_B1_y_;
    const double lambda_B2_y_ = -acceleration_crank1_theta_*l_crank1_theta_B2_y_ + inverse_cross_B2_x_B2_y_*z_B2_x_
        + inverse_pivot_B2_y_*z_B2_y_;
    const double lambda_B2_x_ = -acceleration_crank1_theta_*l_crank1_theta_B2_x_ + inverse_cross_B2_x_B2_y_*z_B2_y_
        + inverse_pivot_B2_x_*z_B2_x_;
    const double acceleration_coupler2_theta_ = -acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        + p->inverse_mass_coupler2_coupler2_*z_coupler2_theta_ - l_B2_x_coupler2_theta_*lambda_B2_x_
        - l_B2_y_coupler2_theta_*lambda_B2_y_;
    const double acceleration_crank2_theta_ = p->inverse_mass_crank2_crank2_*z_crank2_theta_
        - l_B2_x_crank2_theta_*lambda_B2_x_ - l_B2_y_crank2_theta_*lambda_B2_y_;

    /* results */
    a[0] = acceleration_crank0_theta_;
    a[1] = acceleration_crank1_theta_;
    a[2] = acceleration_crank2_theta_;
    a[3] = acceleration_coupler1_theta_;
    a[4] = acceleration_coupler2_theta_;
    rhs->lambda[0] = lambda_B2_x_;
    rhs->lambda[1] = lambda_B2_y_;
    rhs->lambda[2] = lambda_B1_x_;
    rhs->lambda[3] = lambda_B1_y_;
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
    const double crank0_theta_ = q[0];
    const double crank1_theta_ = q[1];
    const double crank2_theta_ = q[2];
    const double coupler1_theta_ = q[3];
    const double coupler2_theta_ = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const double cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const double dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const double cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const double dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;

    /* right-hand side */
    const double r_B2_x_ = r[0];
    const double r_B2_y_ = r[1];
    const double r_B1_x_ = r[2];
    const double r_B1_y_ = r[3];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_B2_x_crank2_theta_ = p->inverse_tree_metric_crank2_theta_*span_crank2_head_y_;
    const double l_B2_y_crank2_theta_ = -p->inverse_tree_metric_crank2_theta_*span_crank2_head_x_;
    const double l_coupler1_theta_crank0_theta_ = dot_crank0_coupler1_*p->inverse_tree_metric_crank0_theta_;
    const double l_B1_x_crank0_theta_ = -p->inverse_tree_metric_crank0_theta_*span_crank0_head_y_;
    const double l_B1_y_crank0_theta_ = p->inverse_tree_metric_crank0_theta_*span_crank0_head_x_;
    const double inverse_pivot_coupler1_theta_ = 1.0/(-dot_crank0_coupler1_*l_coupler1_theta_crank0_theta_
        + p->tree_metric_coupler1_theta_);
    const double w_B1_x_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_x_crank0_theta_ - span_coupler1_head_y_;
    const double l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const double w_B1_y_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_y_crank0_theta_ + span_coupler1_head_x_;
    const double l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const double l_crank1_theta_coupler2_theta_ = dot_crank1_coupler2_*p->inverse_tree_metric_coupler2_theta_;
    const double l_B2_x_coupler2_theta_ = -p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_y_;
    const double l_B2_y_coupler2_theta_ = p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_x_;
    const double inverse_pivot_crank1_theta_ = 1.0/(-dot_crank1_coupler2_*l_crank1_theta_coupler2_theta_
        + p->tree_metric_crank1_theta_);
    const double w_B2_x_crank1_theta_ = -dot_crank1_coupler2_*l_B2_x_coupler2_theta_ - span_crank1_head_y_;
    const double l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B2_y_crank1_theta_ = -dot_crank1_coupler2_*l_B2_y_coupler2_theta_ + span_crank1_head_x_;
    const double l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*span_crank1_head_y_;
    const double l_B1_y_crank1_theta_ = -inverse_pivot_crank1_theta_*span_crank1_head_x_;
    const double scale_B2_x_ = -l_B2_x_coupler2_theta_*span_coupler2_head_y_
        + l_B2_x_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_x_crank2_theta_*span_crank2_head_y_;
    const double scale_B2_y_ = l_B2_y_coupler2_theta_*span_coupler2_head_x_ + l_B2_y_crank1_theta_*w_B2_y_crank1_theta_
        - l_B2_y_crank2_theta_*span_crank2_head_x_;
    const double pivot_B2_x_B2_y_ = -l_B2_y_coupler2_theta_*span_coupler2_head_y_
        + l_B2_y_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_y_crank2_theta_*span_crank2_head_y_;
    const double determinant_B2_x_B2_y_ = -(pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_) + scale_B2_x_*scale_B2_y_;
    if (!(scale_B2_x_ > 0.0 && scale_B2_x_ < INFINITY))
        return 1;
    if (!(determinant_B2_x_B2_y_ > SINGULAR * scale_B2_y_ * scale_B2_x_))
        return 2;
    const double size_B2_x_ = scale_B2_x_ + scale_B2_y_;
    if (!(scale_B2_x_ > VANISHING * size_B2_x_))
        return 1;
    if (!(determinant_B2_x_B2_y_ > VANISHING * size_B2_x_ * scale_B2_x_))
        return 2;
    const double inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const double inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*scale_B2_y_;
    const double inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*scale_B2_x_;
    const double inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;
    const double w_B1_x_B2_x_ = -l_B1_x_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B1_x_B2_y_ = -l_B1_x_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_x_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_y_ + inverse_pivot_B2_x_*w_B1_x_B2_x_;
    const double l_B1_x_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_x_ + inverse_pivot_B2_y_*w_B1_x_B2_y_;
    const double w_B1_y_B2_x_ = -l_B1_y_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B1_y_B2_y_ = -l_B1_y_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_y_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_y_ + inverse_pivot_B2_x_*w_B1_y_B2_x_;
    const double l_B1_y_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_x_ + inverse_pivot_B2_y_*w_B1_y_B2_y_;
    const double scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_x_crank0_theta_*span_crank0_head_y_
        + l_B1_x_crank1_theta_*span_crank1_head_y_;
    const double scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_ + l_B1_y_crank0_theta_*span_crank0_head_x_
        - l_B1_y_crank1_theta_*span_crank1_head_x_;
    const double pivot_B1_x_ = l_B1_x_B2_x_*w_B1_x_B2_x_ + l_B1_x_B2_y_*w_B1_x_B2_y_ + scale_B1_x_;
    const double pivot_B1_y_ = l_B1_y_B2_x_*w_B1_y_B2_x_ + l_B1_y_B2_y_*w_B1_y_B2_y_ + scale_B1_y_;
    const double pivot_B1_x_B1_y_ = l_B1_y_B2_x_*w_B1_x_B2_x_ + l_B1_y_B2_y_*w_B1_x_B2_y_
        + l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_y_crank0_theta_*span_crank0_head_y_
        + l_B1_y_crank1_theta_*span_crank1_head_y_;
    const double determinant_B1_x_B1_y_ = pivot_B1_x_*pivot_B1_y_ - (pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_);
    if (!(pivot_B1_x_ > SINGULAR * scale_B1_x_))
        return 3;
    if (!(determinant_B1_x_B1_y_ > SINGULAR * scale_B1_y_ * pivot_B1_x_))
        return 4;
    const double size_B1_x_ = scale_B1_x_ + scale_B1_y_;
    if (!(pivot_B1_x_ > VANISHING * size_B1_x_))
        return 3;
    if (!(determinant_B1_x_B1_y_ > VANISHING * size_B1_x_ * pivot_B1_x_))
        return 4;
    const double inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const double inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*pivot_B1_y_;
    const double inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*pivot_B1_x_;
    const double inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;

    /* forward substitution */
    const double step_z_B1_x_ = -l_B1_x_B2_x_*r_B2_x_ - l_B1_x_B2_y_*r_B2_y_ + r_B1_x_;
    const double step_z_B1_y_ = -l_B1_y_B2_x_*r_B2_x_ - l_B1_y_B2_y_*r_B2_y_ + r_B1_y_;

    /* backward substitution */
    const double step_lambda_B1_y_ = inverse_cross_B1_x_B1_y_*step_z_B1_x_ + inverse_pivot_B1_y_*step_z_B1_y_;
    const double step_lambda_B1_x_ = inverse_cross_B1_x_B1_y_*step_z_B1_y_ + inverse_pivot_B1_x_*step_z_B1_x_;
    const double step_lambda_B2_y_ = inverse_cross_B2_x_B2_y_*r_B2_x_ + inverse_pivot_B2_y_*r_B2_y_
        - l_B1_x_B2_y_*step_lambda_B1_x_ - l_B1_y_B2_y_*step_lambda_B1_y_;
    const double step_lambda_B2_x_ = inverse_cross_B2_x_B2_y_*r_B2_y_ + inverse_pivot_B2_x_*r_B2_x_
        - l_B1_x_B2_x_*step_lambda_B1_x_ - l_B1_y_B2_x_*step_lambda_B1_y_;
    const double step_acceleration_crank1_theta_ = -l_B1_x_crank1_theta_*step_lambda_B1_x_
        - l_B1_y_crank1_theta_*step_lambda_B1_y_ - l_B2_x_crank1_theta_*step_lambda_B2_x_
        - l_B2_y_crank1_theta_*step_lambda_B2_y_;
    const double step_acceleration_coupler2_theta_ = -l_B2_x_coupler2_theta_*step_lambda_B2_x_
        - l_B2_y_coupler2_theta_*step_lambda_B2_y_ - l_crank1_theta_coupler2_theta_*step_acceleration_crank1_theta_;
    const double step_acceleration_coupler1_theta_ = -l_B1_x_coupler1_theta_*step_lambda_B1_x_
        - l_B1_y_coupler1_theta_*step_lambda_B1_y_;
    const double step_acceleration_crank0_theta_ = -l_B1_x_crank0_theta_*step_lambda_B1_x_
        - l_B1_y_crank0_theta_*step_lambda_B1_y_ - l_coupler1_theta_crank0_theta_*step_acceleration_coupler1_theta_;
    const double step_acceleration_crank2_theta_ = -l_B2_x_crank2_theta_*step_lambda_B2_x_
        - l_B2_y_crank2_theta_*step_lambda_B2_y_;

    /* results */
    x[0] = step_acceleration_crank0_theta_;
    x[1] = step_acceleration_crank1_theta_;
    x[2] = step_acceleration_crank2_theta_;
    x[3] = step_acceleration_coupler1_theta_;
    x[4] = step_acceleration_coupler2_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[12];
    closing[1] = + lambda[13];
    closing[2] = + lambda[8];
    closing[3] = + lambda[9];
}
