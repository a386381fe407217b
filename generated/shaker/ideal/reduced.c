/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     crank: on ground by shaft; its angle is prescribed by motor
 *     rod: on crank by crankpin; its angle is dependent
 *     table: on rod by pin; its angle is constant
 *     arm: on table by pivot; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = arm.theta (rad); q[1] = rod.theta, dependent
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
    /* coordinates, velocities, time */
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];
    const double arm_theta_ = q[0];
    const double arm_omega_ = v[0];
    const double cos_theta_crank_ = q[2];
    const double sin_theta_crank_ = q[3];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];

    /* directions, arms, drives */
    const Four angles_0 = {arm_theta_, arm_theta_, arm_theta_, arm_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_arm_ = cosines_0[0];
    const double sin_theta_arm_ = sines_0[0];
    const double motor_value_ = p->omega_*t;
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
    const double table_theta_ = 0.0;
    const double table_omega_ = 0.0;
    const double table_top_y_ = rod_head_y_ + p->table_points_top_y_;
    const double span_arm_com_x_ = p->arm_head_s_x_*cos_theta_arm_;
    const double span_arm_com_y_ = p->arm_head_s_x_*sin_theta_arm_;
    const double arm_x_ = rod_head_x_ + span_arm_com_x_;
    const double arm_vx_ = -arm_omega_*span_arm_com_y_ + rod_head_vx_;
    const double arm_y_ = span_arm_com_y_ + table_top_y_;
    const double arm_vy_ = arm_omega_*span_arm_com_x_ + rod_head_vy_;

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
    all_q[8] = table_theta_;
    all_v[8] = table_omega_;
    all_q[9] = arm_x_;
    all_v[9] = arm_vx_;
    all_q[10] = arm_y_;
    all_v[10] = arm_vy_;
    all_q[11] = arm_theta_;
    all_v[11] = arm_omega_;
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
    const double arm_theta_ = q[11];
    const double arm_omega_ = v[11];

    /* tree coordinates */
    s[0] = arm_theta_;  /* arm */
    s_rate[0] = arm_omega_;
    s[1] = rod_theta_;  /* rod */
    s_rate[1] = rod_omega_;
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
 *     arm.theta.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    (void)t, (void)discrete;
    /* coordinates, velocities, time */
    const double rod_omega_ = v[1];
    const double arm_theta_ = q[0];
    const double arm_omega_ = v[0];
    const double cos_theta_crank_ = q[2];
    const double sin_theta_crank_ = q[3];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];
    const double rod_theta_second_ = v[2];

    /* directions, arms, drives */
    const Four angles_0 = {arm_theta_, arm_theta_, arm_theta_, arm_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_arm_ = cosines_0[0];
    const double sin_theta_arm_ = sines_0[0];
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;
    const double cos_arm_less_crank_ = cos_theta_arm_*cos_theta_crank_ + sin_theta_arm_*sin_theta_crank_;
    const double sin_arm_less_crank_ = -cos_theta_arm_*sin_theta_crank_ + cos_theta_crank_*sin_theta_arm_;
    const double dot_crank_arm_ = cos_arm_less_crank_*p->inertia_crank_arm_;
    const double cross_crank_arm_ = p->inertia_crank_arm_*sin_arm_less_crank_;
    const double cos_arm_less_rod_ = cos_theta_arm_*cos_theta_rod_ + sin_theta_arm_*sin_theta_rod_;
    const double sin_arm_less_rod_ = -cos_theta_arm_*sin_theta_rod_ + cos_theta_rod_*sin_theta_arm_;
    const double dot_rod_arm_ = cos_arm_less_rod_*p->inertia_rod_arm_;
    const double cross_rod_arm_ = p->inertia_rod_arm_*sin_arm_less_rod_;

    /* forward substitution */
    const double z_arm_theta_ = cos_theta_arm_*p->weight_arm_across_ - cross_crank_arm_*(motor_rate_ * motor_rate_)
        - cross_rod_arm_*(rod_omega_ * rod_omega_) - dot_crank_arm_*motor_acceleration_
        - dot_rod_arm_*rod_theta_second_;

    /* backward substitution */
    const double acceleration_arm_theta_ = p->inverse_mass_arm_arm_*z_arm_theta_;

    /* results */
    a[0] = acceleration_arm_theta_;
    rhs->power[0] = motor_rate_*(a[0]*dot_crank_arm_ - (arm_omega_ * arm_omega_)*cross_crank_arm_
        - cos_theta_crank_*p->weight_crank_across_ - cross_crank_rod_*(rod_omega_ * rod_omega_)
        + dot_crank_rod_*rod_theta_second_ + p->mass_motor_motor_*motor_acceleration_)
        + rod_omega_*(a[0]*dot_rod_arm_ - (arm_omega_ * arm_omega_)*cross_rod_arm_
        - cos_theta_rod_*p->weight_rod_across_ + cross_crank_rod_*(motor_rate_ * motor_rate_)
        + dot_crank_rod_*motor_acceleration_ + p->mass_rod_rod_*rod_theta_second_);
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return 0;
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
    const double step_acceleration_arm_theta_ = 0.0;

    /* results */
    x[0] = step_acceleration_arm_theta_;
    return 0;
}

/*
 * Cosines and sines of all angles in the closures of dependent loops, stored in q after coordinates.
 */
void evaluate_loop_directions(const double t, const double *q, const DiscreteState *discrete, const Parameters *p,
    double *out)
{
    (void)discrete;
    /* coordinates, velocities, time */
    const double rod_theta_ = q[1];

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;

    /* directions */
    const Four angles_0 = {motor_value_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    out[2] = cosines_0[0];  /* cos_theta_crank_ */
    out[3] = sines_0[0];  /* sin_theta_crank_ */
    out[4] = cosines_0[1];  /* cos_theta_rod_ */
    out[5] = sines_0[1];  /* sin_theta_rod_ */
}

/*
 * Newton's step of the dependent coordinates, Phi_c newton = Phi, and Chebyshev's step of order 3,
 * step = newton + bend, Phi_c bend = Phi_cc[newton, newton]/2. `row`: the number, from 1, of the row with
 * the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int compute_loop_step(const double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *step,
    double *bend, int *row)
{
    (void)t, (void)discrete;
    /* coordinates, velocities, time */
    const double cos_theta_crank_ = q[2];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];

    /* directions, arms, drives */
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;

    /* closures of the chains */
    const double phi_guide_offset_ = -span_crank_head_x_ - span_rod_head_x_;

    /* the largest */
    *row = 1;

    /* blocks of constraint equations that are solved one after the other */
    const double pivot_guide_offset_ = span_rod_head_y_;
    const double size_guide_offset_rod_theta_ = fabs(span_rod_head_x_) + fabs(span_rod_head_y_);
    if (!(fabs(pivot_guide_offset_) > SINGULAR_SQUARE * size_guide_offset_rod_theta_))
        return 1;
    const double inverse_guide_offset_ = 1.0/pivot_guide_offset_;

    /* Newton's step */
    const double newton_rod_theta_ = inverse_guide_offset_*phi_guide_offset_;

    /* correction by the curvature of the constraints */
    const double bend_rod_theta_ = 0.5*inverse_guide_offset_*(newton_rod_theta_ * newton_rod_theta_)*span_rod_head_x_;
    step[0] = bend_rod_theta_ + newton_rod_theta_;
    bend[0] = bend_rod_theta_;
    return 0;
}

/*
 * First and second rates of the dependent coordinates at positions that close their loops: Phi_c c' = nu,
 * Phi_c c'' = gamma. They are stored after those of the other coordinates in v.
 * Returns 0, or the number of a row that depends on others here.
 */
int compute_loop_rates(const double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *v)
{
    (void)t, (void)discrete;
    /* coordinates, velocities, time */
    const double cos_theta_crank_ = q[2];
    const double sin_theta_crank_ = q[3];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];

    /* directions, arms, drives */
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;

    /* blocks of constraint equations that are solved one after the other */
    const double pivot_guide_offset_ = span_rod_head_y_;
    const double size_guide_offset_rod_theta_ = fabs(span_rod_head_x_) + fabs(span_rod_head_y_);
    if (!(fabs(pivot_guide_offset_) > SINGULAR_SQUARE * size_guide_offset_rod_theta_))
        return 1;
    const double inverse_guide_offset_ = 1.0/pivot_guide_offset_;

    /* rates */
    const double rate_rod_theta_ = -inverse_guide_offset_*motor_rate_*span_crank_head_y_;
    const double rod_omega_ = rate_rod_theta_;

    /* second rates */
    const double second_rod_theta_ = inverse_guide_offset_*(-motor_acceleration_*span_crank_head_y_
        - (motor_rate_ * motor_rate_)*span_crank_head_x_ - (rod_omega_ * rod_omega_)*span_rod_head_x_);

    /* results */
    v[1] = rod_omega_;
    v[2] = second_rod_theta_;
    return 0;
}

/*
 * Third rates of the dependent coordinates: Phi_c c''' = d/dt (gamma - Phi_c c'') at the same c''.
 * Returns 0, or the number of a row that depends on others here.
 */
int compute_third_loop_rates(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *out)
{
    (void)t, (void)discrete;
    /* coordinates, velocities, time */
    const double rod_omega_ = v[1];
    const double cos_theta_crank_ = q[2];
    const double sin_theta_crank_ = q[3];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];
    const double rod_theta_second_ = v[2];

    /* directions, arms, drives */
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;

    /* blocks of constraint equations that are solved one after the other */
    const double pivot_guide_offset_ = span_rod_head_y_;
    const double size_guide_offset_rod_theta_ = fabs(span_rod_head_x_) + fabs(span_rod_head_y_);
    if (!(fabs(pivot_guide_offset_) > SINGULAR_SQUARE * size_guide_offset_rod_theta_))
        return 1;
    const double inverse_guide_offset_ = 1.0/pivot_guide_offset_;

    /* third rates */
    const double span_crank_head_x_by_time_ = -motor_rate_*span_crank_head_y_;
    const double span_crank_head_y_by_time_ = motor_rate_*span_crank_head_x_;
    const double span_rod_head_x_by_time_ = -rod_omega_*span_rod_head_y_;
    const double span_rod_head_y_by_time_ = rod_omega_*span_rod_head_x_;
    const double third_rod_theta_ = inverse_guide_offset_*(-2.0*motor_acceleration_*motor_rate_*span_crank_head_x_
        - motor_acceleration_*span_crank_head_y_by_time_ - (motor_rate_ * motor_rate_)*span_crank_head_x_by_time_
        - (rod_omega_ * rod_omega_)*span_rod_head_x_by_time_ - 2.0*rod_omega_*rod_theta_second_*span_rod_head_x_
        - rod_theta_second_*span_rod_head_y_by_time_);
    out[0] = third_rod_theta_;
    return 0;
}

/* Return the factor that makes a step of dependent coordinate k dimensionless: 1 for angles, 1/extent for slides. */
double get_loop_step_scale(const Parameters *p, int k)
{
    (void)p;
    switch (k) {
    case 0:
        return 1.0;
    default:
        return 1.0;
    }
}

/* Turn the cosines and sines stored in q by a step of the dependent coordinates. */
void turn_directions(double *q, const double *step, const Parameters *p)
{
    (void)p;
    rotate_back_by_small_angle(q + 4, step[0]);
}
