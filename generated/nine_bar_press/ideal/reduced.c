/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     L1: on ground by O1; its angle is prescribed by crank1
 *     L4: on ground by O4; its angle is prescribed by crank4
 *     L6: on ground by O6; its angle is an unknown
 *     L2: on L1 by A; its angle is an unknown
 *     L3: on L4 by B; its angle is an unknown
 *     L7: on L6 by Q6; its angle is an unknown
 *     L8: on L6 by L6.head=L8.tail; its angle is an unknown
 *     S9: on L8 by slider; its angle is constant
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = L6.theta (rad); q[1] = L2.theta (rad); q[2] = L3.theta (rad); q[3] = L7.theta (rad);
 *     q[4] = L8.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of guide.offset; rhs->lambda[1] of L2.head=L3.head.x;
 *     rhs->lambda[2] of L2.head=L3.head.y; rhs->lambda[3] of P2.x; rhs->lambda[4] of P2.y
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
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L2_theta_ = q[1];
    const double L2_omega_ = v[1];
    const double L3_theta_ = q[2];
    const double L3_omega_ = v[2];
    const double L7_theta_ = q[3];
    const double L7_omega_ = v[3];
    const double L8_theta_ = q[4];
    const double L8_omega_ = v[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double cos_theta_L8_ = cosines_1[2];
    const double sin_theta_L8_ = sines_1[2];
    const double crank1_rate_ = p->omega_;
    const double crank4_rate_ = p->omega4_;
    const double span_L1_com_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double span_L1_com_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double L1_vx_ = -crank1_rate_*span_L1_com_y_;
    const double L1_vy_ = crank1_rate_*span_L1_com_x_;
    const double span_L4_com_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double span_L4_com_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double L4_vx_ = -crank4_rate_*span_L4_com_y_;
    const double L4_y_ = p->O4_y_ + span_L4_com_y_;
    const double L4_vy_ = crank4_rate_*span_L4_com_x_;
    const double span_L6_com_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double span_L6_com_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double L6_x_ = p->O6_x_ + span_L6_com_x_;
    const double L6_vx_ = -L6_omega_*span_L6_com_y_;
    const double L6_vy_ = L6_omega_*span_L6_com_x_;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double L1_head_vx_ = -crank1_rate_*span_L1_head_y_;
    const double L1_head_vy_ = crank1_rate_*span_L1_head_x_;
    const double span_L2_com_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double span_L2_com_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double L2_x_ = span_L1_head_x_ + span_L2_com_x_;
    const double L2_vx_ = L1_head_vx_ - L2_omega_*span_L2_com_y_;
    const double L2_y_ = span_L1_head_y_ + span_L2_com_y_;
    const double L2_vy_ = L1_head_vy_ + L2_omega_*span_L2_com_x_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double L4_head_vx_ = -crank4_rate_*span_L4_head_y_;
    const double L4_head_y_ = p->O4_y_ + span_L4_head_y_;
    const double L4_head_vy_ = crank4_rate_*span_L4_head_x_;
    const double span_L3_com_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double span_L3_com_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double L3_x_ = span_L3_com_x_ + span_L4_head_x_;
    const double L3_vx_ = -L3_omega_*span_L3_com_y_ + L4_head_vx_;
    const double L3_y_ = L4_head_y_ + span_L3_com_y_;
    const double L3_vy_ = L3_omega_*span_L3_com_x_ + L4_head_vy_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double L6_head_x_ = p->O6_x_ + span_L6_head_x_;
    const double L6_head_vx_ = -L6_omega_*span_L6_head_y_;
    const double L6_head_vy_ = L6_omega_*span_L6_head_x_;
    const double span_L7_com_x_ = p->L7_com_span_x_*cos_theta_L7_;
    const double span_L7_com_y_ = p->L7_com_span_x_*sin_theta_L7_;
    const double L7_x_ = L6_head_x_ + span_L7_com_x_;
    const double L7_vx_ = L6_head_vx_ - L7_omega_*span_L7_com_y_;
    const double L7_y_ = span_L6_head_y_ + span_L7_com_y_;
    const double L7_vy_ = L6_head_vy_ + L7_omega_*span_L7_com_x_;
    const double span_L8_com_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double span_L8_com_y_ = p->L8_head_s_x_*sin_theta_L8_;
    const double L8_x_ = L6_head_x_ + span_L8_com_x_;
    const double L8_vx_ = L6_head_vx_ - L8_omega_*span_L8_com_y_;
    const double L8_y_ = span_L6_head_y_ + span_L8_com_y_;
    const double L8_vy_ = L6_head_vy_ + L8_omega_*span_L8_com_x_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double L8_head_x_ = L6_head_x_ + span_L8_head_x_;
    const double L8_head_vx_ = L6_head_vx_ - L8_omega_*span_L8_head_y_;
    const double L8_head_y_ = span_L6_head_y_ + span_L8_head_y_;
    const double L8_head_vy_ = L6_head_vy_ + L8_omega_*span_L8_head_x_;
    const double S9_theta_ = PI/2.0;
    const double S9_omega_ = 0.0;

    /* bodies */
    all_q[0] = span_L1_com_x_;
    all_v[0] = L1_vx_;
    all_q[1] = span_L1_com_y_;
    all_v[1] = L1_vy_;
    all_q[2] = crank1_value_;
    all_v[2] = crank1_rate_;
    all_q[3] = L2_x_;
    all_v[3] = L2_vx_;
    all_q[4] = L2_y_;
    all_v[4] = L2_vy_;
    all_q[5] = L2_theta_;
    all_v[5] = L2_omega_;
    all_q[6] = L3_x_;
    all_v[6] = L3_vx_;
    all_q[7] = L3_y_;
    all_v[7] = L3_vy_;
    all_q[8] = L3_theta_;
    all_v[8] = L3_omega_;
    all_q[9] = span_L4_com_x_;
    all_v[9] = L4_vx_;
    all_q[10] = L4_y_;
    all_v[10] = L4_vy_;
    all_q[11] = crank4_value_;
    all_v[11] = crank4_rate_;
    all_q[12] = L6_x_;
    all_v[12] = L6_vx_;
    all_q[13] = span_L6_com_y_;
    all_v[13] = L6_vy_;
    all_q[14] = L6_theta_;
    all_v[14] = L6_omega_;
    all_q[15] = L7_x_;
    all_v[15] = L7_vx_;
    all_q[16] = L7_y_;
    all_v[16] = L7_vy_;
    all_q[17] = L7_theta_;
    all_v[17] = L7_omega_;
    all_q[18] = L8_x_;
    all_v[18] = L8_vx_;
    all_q[19] = L8_y_;
    all_v[19] = L8_vy_;
    all_q[20] = L8_theta_;
    all_v[20] = L8_omega_;
    all_q[21] = L8_head_x_;
    all_v[21] = L8_head_vx_;
    all_q[22] = L8_head_y_;
    all_v[22] = L8_head_vy_;
    all_q[23] = S9_theta_;
    all_v[23] = S9_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double L2_theta_ = q[5];
    const double L2_omega_ = v[5];
    const double L3_theta_ = q[8];
    const double L3_omega_ = v[8];
    const double L6_theta_ = q[14];
    const double L6_omega_ = v[14];
    const double L7_theta_ = q[17];
    const double L7_omega_ = v[17];
    const double L8_theta_ = q[20];
    const double L8_omega_ = v[20];

    /* tree coordinates */
    s[0] = L6_theta_;  /* L6 */
    s_rate[0] = L6_omega_;
    s[1] = L2_theta_;  /* L2 */
    s_rate[1] = L2_omega_;
    s[2] = L3_theta_;  /* L3 */
    s_rate[2] = L3_omega_;
    s[3] = L7_theta_;  /* L7 */
    s_rate[3] = L7_omega_;
    s[4] = L8_theta_;  /* L8 */
    s_rate[4] = L8_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[14];  /* L6 */
    a[1] = all_a[5];  /* L2 */
    a[2] = all_a[8];  /* L3 */
    a[3] = all_a[17];  /* L7 */
    a[4] = all_a[20];  /* L8 */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double L6_theta_ = q[0];
    const double L2_theta_ = q[1];
    const double L3_theta_ = q[2];
    const double L7_theta_ = q[3];
    const double L8_theta_ = q[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double cos_theta_L8_ = cosines_1[2];
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;

    /* rows */
    out[0] = -span_L6_head_x_ - span_L8_head_x_;  /* guide.offset */
    out[1] = span_L1_head_x_ + span_L2_head_x_ - span_L3_head_x_ - span_L4_head_x_;  /* L2.head=L3.head.x */
    out[2] = -p->O4_y_ + span_L1_head_y_ + span_L2_head_y_ - span_L3_head_y_ - span_L4_head_y_;  /* L2.head=L3.head.y */
    out[3] = -p->O6_x_ + span_L1_head_x_ + span_L2_head_x_ - span_L6_head_x_ - span_L7_tail_x_;  /* P2.x */
    out[4] = span_L1_head_y_ + span_L2_head_y_ - span_L6_head_y_ - span_L7_tail_y_;  /* P2.y */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L2_theta_ = q[1];
    const double L2_omega_ = v[1];
    const double L3_theta_ = q[2];
    const double L3_omega_ = v[2];
    const double L7_theta_ = q[3];
    const double L7_omega_ = v[3];
    const double L8_theta_ = q[4];
    const double L8_omega_ = v[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double sin_theta_L8_ = sines_1[2];
    const double crank1_rate_ = p->omega_;
    const double crank4_rate_ = p->omega4_;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;

    /* rows */
    out[0] = L6_omega_*span_L6_head_y_ + L8_omega_*span_L8_head_y_;  /* guide.offset */
    /* L2.head=L3.head.x */
    out[1] = -L2_omega_*span_L2_head_y_ + L3_omega_*span_L3_head_y_ - crank1_rate_*span_L1_head_y_
        + crank4_rate_*span_L4_head_y_;
    /* L2.head=L3.head.y */
    out[2] = L2_omega_*span_L2_head_x_ - L3_omega_*span_L3_head_x_ + crank1_rate_*span_L1_head_x_
        - crank4_rate_*span_L4_head_x_;
    /* P2.x */
    out[3] = -L2_omega_*span_L2_head_y_ + L6_omega_*span_L6_head_y_ + L7_omega_*span_L7_tail_y_
        - crank1_rate_*span_L1_head_y_;
    /* P2.y */
    out[4] = L2_omega_*span_L2_head_x_ - L6_omega_*span_L6_head_x_ - L7_omega_*span_L7_tail_x_
        + crank1_rate_*span_L1_head_x_;
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     L3.theta; L8.theta; L7.theta; L6.theta; lambda of guide.offset; L2.theta;
 *     lambda of L2.head=L3.head.x with lambda of L2.head=L3.head.y; lambda of P2.x with lambda of P2.y.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L2_theta_ = q[1];
    const double L2_omega_ = v[1];
    const double L3_theta_ = q[2];
    const double L3_omega_ = v[2];
    const double L7_theta_ = q[3];
    const double L7_omega_ = v[3];
    const double L8_theta_ = q[4];
    const double L8_omega_ = v[4];

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value_, crank4_value_, L6_theta_, L2_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L7_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1_ = cosines_0[0];
    const double sin_theta_L1_ = sines_0[0];
    const double cos_theta_L4_ = cosines_0[1];
    const double sin_theta_L4_ = sines_0[1];
    const double cos_theta_L6_ = cosines_0[2];
    const double sin_theta_L6_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double cos_theta_L7_ = cosines_1[1];
    const double sin_theta_L7_ = sines_1[1];
    const double cos_theta_L8_ = cosines_1[2];
    const double sin_theta_L8_ = sines_1[2];
    const double crank1_rate_ = p->omega_;
    const double crank1_acceleration_ = 0.0;
    const double crank4_rate_ = p->omega4_;
    const double crank4_acceleration_ = 0.0;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;
    const double cos_L2_less_L1_ = cos_theta_L1_*cos_theta_L2_ + sin_theta_L1_*sin_theta_L2_;
    const double sin_L2_less_L1_ = cos_theta_L1_*sin_theta_L2_ - cos_theta_L2_*sin_theta_L1_;
    const double dot_L1_L2_ = cos_L2_less_L1_*p->inertia_L1_L2_;
    const double cross_L1_L2_ = p->inertia_L1_L2_*sin_L2_less_L1_;
    const double cos_L3_less_L4_ = cos_theta_L3_*cos_theta_L4_ + sin_theta_L3_*sin_theta_L4_;
    const double sin_L3_less_L4_ = -cos_theta_L3_*sin_theta_L4_ + cos_theta_L4_*sin_theta_L3_;
    const double dot_L4_L3_ = cos_L3_less_L4_*p->inertia_L4_L3_;
    const double cross_L4_L3_ = p->inertia_L4_L3_*sin_L3_less_L4_;
    const double cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const double sin_L7_less_L6_ = cos_theta_L6_*sin_theta_L7_ - cos_theta_L7_*sin_theta_L6_;
    const double dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const double cross_L6_L7_ = p->inertia_L6_L7_*sin_L7_less_L6_;
    const double cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const double sin_L8_less_L6_ = cos_theta_L6_*sin_theta_L8_ - cos_theta_L8_*sin_theta_L6_;
    const double dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;
    const double cross_L6_L8_ = p->inertia_L6_L8_*sin_L8_less_L6_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_guide_offset_ = -(L6_omega_ * L6_omega_)*span_L6_head_x_ - (L8_omega_ * L8_omega_)*span_L8_head_x_;
    const double rhs_L2_head_L3_head_x_ = (L2_omega_ * L2_omega_)*span_L2_head_x_
        - (L3_omega_ * L3_omega_)*span_L3_head_x_ + crank1_acceleration_*span_L1_head_y_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_x_ - crank4_acceleration_*span_L4_head_y_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_x_;
    const double rhs_L2_head_L3_head_y_ = (L2_omega_ * L2_omega_)*span_L2_head_y_
        - (L3_omega_ * L3_omega_)*span_L3_head_y_ - crank1_acceleration_*span_L1_head_x_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_y_ + crank4_acceleration_*span_L4_head_x_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_y_;
    const double rhs_P2_x_ = (L2_omega_ * L2_omega_)*span_L2_head_x_ - (L6_omega_ * L6_omega_)*span_L6_head_x_
        - (L7_omega_ * L7_omega_)*span_L7_tail_x_ + crank1_acceleration_*span_L1_head_y_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_x_;
    const double rhs_P2_y_ = (L2_omega_ * L2_omega_)*span_L2_head_y_ - (L6_omega_ * L6_omega_)*span_L6_head_y_
        - (L7_omega_ * L7_omega_)*span_L7_tail_y_ - crank1_acceleration_*span_L1_head_x_
        + (crank1_rate_ * crank1_rate_)*span_L1_head_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_L3_L3_ > LIGHT_PIVOT * p->L3_turning_)) {
        pivot = 6;
        goto dependent;
    }
    const double l_L2_head_L3_head_x_L3_theta_ = p->inverse_mass_L3_L3_*span_L3_head_y_;
    const double l_L2_head_L3_head_y_L3_theta_ = -p->inverse_mass_L3_L3_*span_L3_head_x_;
    if (!(p->mass_L8_L8_ > LIGHT_PIVOT * p->L8_turning_)) {
        pivot = 7;
        goto dependent;
    }
    const double l_L6_theta_L8_theta_ = dot_L6_L8_*p->inverse_mass_L8_L8_;
    const double l_guide_offset_L8_theta_ = p->inverse_mass_L8_L8_*span_L8_head_y_;
    if (!(p->mass_L7_L7_ > LIGHT_PIVOT * p->L7_turning_)) {
        pivot = 8;
        goto dependent;
    }
    const double l_L6_theta_L7_theta_ = dot_L6_L7_*p->inverse_mass_L7_L7_;
    const double l_P2_x_L7_theta_ = p->inverse_mass_L7_L7_*span_L7_tail_y_;
    const double l_P2_y_L7_theta_ = -p->inverse_mass_L7_L7_*span_L7_tail_x_;
    const double pivot_L6_theta_ = -dot_L6_L7_*l_L6_theta_L7_theta_ - dot_L6_L8_*l_L6_theta_L8_theta_ + p->mass_L6_L6_;
    if (!(pivot_L6_theta_ > LIGHT_PIVOT * p->L6_turning_)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pivot_L6_theta_ = 1.0/pivot_L6_theta_;
    const double w_guide_offset_L6_theta_ = -dot_L6_L8_*l_guide_offset_L8_theta_ + span_L6_head_y_;
    const double l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const double w_P2_x_L6_theta_ = -dot_L6_L7_*l_P2_x_L7_theta_ + span_L6_head_y_;
    const double l_P2_x_L6_theta_ = inverse_pivot_L6_theta_*w_P2_x_L6_theta_;
    const double w_P2_y_L6_theta_ = -dot_L6_L7_*l_P2_y_L7_theta_ - span_L6_head_x_;
    const double l_P2_y_L6_theta_ = inverse_pivot_L6_theta_*w_P2_y_L6_theta_;
    const double scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L8_theta_*span_L8_head_y_;
    if (!(scale_guide_offset_ > 0.0 && scale_guide_offset_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;
    const double w_P2_x_guide_offset_ = -l_P2_x_L6_theta_*w_guide_offset_L6_theta_;
    const double l_P2_x_guide_offset_ = -inverse_pivot_guide_offset_*w_P2_x_guide_offset_;
    const double w_P2_y_guide_offset_ = -l_P2_y_L6_theta_*w_guide_offset_L6_theta_;
    const double l_P2_y_guide_offset_ = -inverse_pivot_guide_offset_*w_P2_y_guide_offset_;
    if (!(p->mass_L2_L2_ > LIGHT_PIVOT * p->L2_turning_)) {
        pivot = 10;
        goto dependent;
    }
    const double l_L2_head_L3_head_x_L2_theta_ = -p->inverse_mass_L2_L2_*span_L2_head_y_;
    const double l_L2_head_L3_head_y_L2_theta_ = p->inverse_mass_L2_L2_*span_L2_head_x_;
    const double l_P2_x_L2_theta_ = -p->inverse_mass_L2_L2_*span_L2_head_y_;
    const double l_P2_y_L2_theta_ = p->inverse_mass_L2_L2_*span_L2_head_x_;
    const double scale_L2_head_L3_head_x_ = -l_L2_head_L3_head_x_L2_theta_*span_L2_head_y_
        + l_L2_head_L3_head_x_L3_theta_*span_L3_head_y_;
    const double scale_L2_head_L3_head_y_ = l_L2_head_L3_head_y_L2_theta_*span_L2_head_x_
        - l_L2_head_L3_head_y_L3_theta_*span_L3_head_x_;
    const double pivot_L2_head_L3_head_x_L2_head_L3_head_y_ = -l_L2_head_L3_head_y_L2_theta_*span_L2_head_y_
        + l_L2_head_L3_head_y_L3_theta_*span_L3_head_y_;
    const double determinant_L2_head_L3_head_x_L2_head_L3_head_y_ =
        -(pivot_L2_head_L3_head_x_L2_head_L3_head_y_ * pivot_L2_head_L3_head_x_L2_head_L3_head_y_)
        + scale_L2_head_L3_head_x_*scale_L2_head_L3_head_y_;
    if (!(scale_L2_head_L3_head_x_ > 0.0 && scale_L2_head_L3_head_x_ < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    if (!(determinant_L2_head_L3_head_x_L2_head_L3_head_y_ > discrete->min_pivot * scale_L2_head_L3_head_y_
        * scale_L2_head_L3_head_x_)) {
        pivot = 3;
        goto dependent;
    }
    const double size_L2_head_L3_head_x_ = scale_L2_head_L3_head_x_ + scale_L2_head_L3_head_y_;
    if (!(scale_L2_head_L3_head_x_ > discrete->min_pivot_size * size_L2_head_L3_head_x_)) {
        pivot = 2;
        goto dependent;
    }
    if (!(determinant_L2_head_L3_head_x_L2_head_L3_head_y_ > discrete->min_pivot_size * size_L2_head_L3_head_x_
        * scale_L2_head_L3_head_x_)) {
        pivot = 3;
        goto dependent;
    }
    const double inverse_L2_head_L3_head_x_L2_head_L3_head_y_ = -1.0/determinant_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double inverse_pivot_L2_head_L3_head_x_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *scale_L2_head_L3_head_y_;
    const double inverse_pivot_L2_head_L3_head_y_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *scale_L2_head_L3_head_x_;
    const double inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_ =
        -inverse_L2_head_L3_head_x_L2_head_L3_head_y_*pivot_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double w_P2_x_L2_head_L3_head_x_ = l_P2_x_L2_theta_*span_L2_head_y_;
    const double w_P2_x_L2_head_L3_head_y_ = -l_P2_x_L2_theta_*span_L2_head_x_;
    const double l_P2_x_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_x_L2_head_L3_head_y_ + inverse_pivot_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_;
    const double l_P2_x_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_x_L2_head_L3_head_x_ + inverse_pivot_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_;
    const double w_P2_y_L2_head_L3_head_x_ = l_P2_y_L2_theta_*span_L2_head_y_;
    const double w_P2_y_L2_head_L3_head_y_ = -l_P2_y_L2_theta_*span_L2_head_x_;
    const double l_P2_y_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_y_L2_head_L3_head_y_ + inverse_pivot_L2_head_L3_head_x_*w_P2_y_L2_head_L3_head_x_;
    const double l_P2_y_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_y_L2_head_L3_head_x_ + inverse_pivot_L2_head_L3_head_y_*w_P2_y_L2_head_L3_head_y_;
    const double scale_P2_x_ = -l_P2_x_L2_theta_*span_L2_head_y_ + l_P2_x_L6_theta_*w_P2_x_L6_theta_
        + l_P2_x_L7_theta_*span_L7_tail_y_;
    const double scale_P2_y_ = l_P2_y_L2_theta_*span_L2_head_x_ + l_P2_y_L6_theta_*w_P2_y_L6_theta_
        - l_P2_y_L7_theta_*span_L7_tail_x_;
    const double pivot_P2_x_ = l_P2_x_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_
        + l_P2_x_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_ + l_P2_x_guide_offset_*w_P2_x_guide_offset_ + scale_P2_x_;
    const double pivot_P2_y_ = l_P2_y_L2_head_L3_head_x_*w_P2_y_L2_head_L3_head_x_
        + l_P2_y_L2_head_L3_head_y_*w_P2_y_L2_head_L3_head_y_ + l_P2_y_guide_offset_*w_P2_y_guide_offset_ + scale_P2_y_;
    const double pivot_P2_x_P2_y_ = l_P2_y_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_
        + l_P2_y_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_ - l_P2_y_L2_theta_*span_L2_head_y_
        + l_P2_y_L6_theta_*w_P2_x_L6_theta_ + l_P2_y_L7_theta_*span_L7_tail_y_
        + l_P2_y_guide_offset_*w_P2_x_guide_offset_;
    const double determinant_P2_x_P2_y_ = pivot_P2_x_*pivot_P2_y_ - (pivot_P2_x_P2_y_ * pivot_P2_x_P2_y_);
    if (!(pivot_P2_x_ > discrete->min_pivot * scale_P2_x_)) {
        pivot = 4;
        goto dependent;
    }
    if (!(determinant_P2_x_P2_y_ > discrete->min_pivot * scale_P2_y_ * pivot_P2_x_)) {
        pivot = 5;
        goto dependent;
    }
    const double size_P2_x_ = scale_P2_x_ + scale_P2_y_;
    if (!(pivot_P2_x_ > discrete->min_pivot_size * size_P2_x_)) {
        pivot = 4;
        goto dependent;
    }
    if (!(determinant_P2_x_P2_y_ > discrete->min_pivot_size * size_P2_x_ * pivot_P2_x_)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_P2_x_P2_y_ = -1.0/determinant_P2_x_P2_y_;
    const double inverse_pivot_P2_x_ = inverse_P2_x_P2_y_*pivot_P2_y_;
    const double inverse_pivot_P2_y_ = inverse_P2_x_P2_y_*pivot_P2_x_;
    const double inverse_cross_P2_x_P2_y_ = -inverse_P2_x_P2_y_*pivot_P2_x_P2_y_;

    /* forward substitution */
    const double z_L3_theta_ = cos_theta_L3_*p->weight_L3_across_ - crank4_acceleration_*dot_L4_L3_
        - (crank4_rate_ * crank4_rate_)*cross_L4_L3_;
    const double z_L8_theta_ = -(L6_omega_ * L6_omega_)*cross_L6_L8_ + cos_theta_L8_*p->weight_L8_across_;
    const double z_L7_theta_ = -(L6_omega_ * L6_omega_)*cross_L6_L7_ + cos_theta_L7_*p->weight_L7_across_;
    const double z_L6_theta_ = (L7_omega_ * L7_omega_)*cross_L6_L7_ + (L8_omega_ * L8_omega_)*cross_L6_L8_
        + cos_theta_L6_*p->weight_L6_across_ - l_L6_theta_L7_theta_*z_L7_theta_ - l_L6_theta_L8_theta_*z_L8_theta_;
    const double z_guide_offset_ = -l_guide_offset_L6_theta_*z_L6_theta_ - l_guide_offset_L8_theta_*z_L8_theta_
        + rhs_guide_offset_;
    const double z_L2_theta_ = cos_theta_L2_*p->weight_L2_across_ - crank1_acceleration_*dot_L1_L2_
        - (crank1_rate_ * crank1_rate_)*cross_L1_L2_;
    const double z_L2_head_L3_head_x_ = -l_L2_head_L3_head_x_L2_theta_*z_L2_theta_
        - l_L2_head_L3_head_x_L3_theta_*z_L3_theta_ + rhs_L2_head_L3_head_x_;
    const double z_L2_head_L3_head_y_ = -l_L2_head_L3_head_y_L2_theta_*z_L2_theta_
        - l_L2_head_L3_head_y_L3_theta_*z_L3_theta_ + rhs_L2_head_L3_head_y_;
    const double z_P2_x_ = -l_P2_x_L2_head_L3_head_x_*z_L2_head_L3_head_x_
        - l_P2_x_L2_head_L3_head_y_*z_L2_head_L3_head_y_ - l_P2_x_L2_theta_*z_L2_theta_ - l_P2_x_L6_theta_*z_L6_theta_
        - l_P2_x_L7_theta_*z_L7_theta_ - l_P2_x_guide_offset_*z_guide_offset_ + rhs_P2_x_;
    const double z_P2_y_ = -l_P2_y_L2_head_L3_head_x_*z_L2_head_L3_head_x_
        - l_P2_y_L2_head_L3_head_y_*z_L2_head_L3_head_y_ - l_P2_y_L2_theta_*z_L2_theta_ - l_P2_y_L6_theta_*z_L6_theta_
        - l_P2_y_L7_theta_*z_L7_theta_ - l_P2_y_guide_offset_*z_guide_offset_ + rhs_P2_y_;

    /* backward substitution */
    const double lambda_P2_y_ = inverse_cross_P2_x_P2_y_*z_P2_x_ + inverse_pivot_P2_y_*z_P2_y_;
    const double lambda_P2_x_ = inverse_cross_P2_x_P2_y_*z_P2_y_ + inverse_pivot_P2_x_*z_P2_x_;
    const double lambda_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_*z_L2_head_L3_head_x_
        + inverse_pivot_L2_head_L3_head_y_*z_L2_head_L3_head_y_ - l_P2_x_L2_head_L3_head_y_*lambda_P2_x_
        - l_P2_y_L2_head_L3_head_y_*lambda_P2_y_;
    const double lambda_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_*z_L2_head_L3_head_y_
        + inverse_pivot_L2_head_L3_head_x_*z_L2_head_L3_head_x_ - l_P2_x_L2_head_L3_head_x_*lambda_P2_x_
        - l_P2_y_L2_head_L3_head_x_*lambda_P2_y_;
    const double acceleration_L2_theta_ = p->inverse_mass_L2_L2_*z_L2_theta_
        - l_L2_head_L3_head_x_L2_theta_*lambda_L2_head_L3_head_x_
        - l_L2_head_L3_head_y_L2_theta_*lambda_L2_head_L3_head_y_ - l_P2_x_L2_theta_*lambda_P2_x_
        - l_P2_y_L2_theta_*lambda_P2_y_;
    const double lambda_guide_offset_ = -inverse_pivot_guide_offset_*z_guide_offset_
        - l_P2_x_guide_offset_*lambda_P2_x_ - l_P2_y_guide_offset_*lambda_P2_y_;
    const double acceleration_L6_theta_ = inverse_pivot_L6_theta_*z_L6_theta_ - l_P2_x_L6_theta_*lambda_P2_x_
        - l_P2_y_L6_theta_*lambda_P2_y_ - l_guide_offset_L6_theta_*lambda_guide_offset_;
    const double acceleration_L7_theta_ = -acceleration_L6_theta_*l_L6_theta_L7_theta_
        + p->inverse_mass_L7_L7_*z_L7_theta_ - l_P2_x_L7_theta_*lambda_P2_x_ - l_P2_y_L7_theta_*lambda_P2_y_;
    const double acceleration_L8_theta_ = -acceleration_L6_theta_*l_L6_theta_L8_theta_
        + p->inverse_mass_L8_L8_*z_L8_theta_ - l_guide_offset_L8_theta_*lambda_guide_offset_;
    const double acceleration_L3_theta_ = p->inverse_mass_L3_L3_*z_L3_theta_
        - l_L2_head_L3_head_x_L3_theta_*lambda_L2_head_L3_head_x_
        - l_L2_head_L3_head_y_L3_theta_*lambda_L2_head_L3_head_y_;

    /* results */
    a[0] = acceleration_L6_theta_;
    a[1] = acceleration_L2_theta_;
    a[2] = acceleration_L3_theta_;
    a[3] = acceleration_L7_theta_;
    a[4] = acceleration_L8_theta_;
    rhs->lambda[0] = lambda_guide_offset_;
    rhs->lambda[1] = lambda_L2_head_L3_head_x_;
    rhs->lambda[2] = lambda_L2_head_L3_head_y_;
    rhs->lambda[3] = lambda_P2_x_;
    rhs->lambda[4] = lambda_P2_y_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = -crank1_rate_*rhs->lambda[3]*span_L1_head_y_ + crank1_rate_*rhs->lambda[4]*span_L1_head_x_
        + crank1_rate_*(-(L2_omega_ * L2_omega_)*cross_L1_L2_ + a[1]*dot_L1_L2_ - cos_theta_L1_*p->weight_L1_across_
        + crank1_acceleration_*p->mass_crank1_crank1_) + crank4_rate_*(-(L3_omega_ * L3_omega_)*cross_L4_L3_
        + a[2]*dot_L4_L3_ - cos_theta_L4_*p->weight_L4_across_ + crank4_acceleration_*p->mass_crank4_crank4_)
        - rhs->lambda[1]*(crank1_rate_*span_L1_head_y_ - crank4_rate_*span_L4_head_y_)
        - rhs->lambda[2]*(-crank1_rate_*span_L1_head_x_ + crank4_rate_*span_L4_head_x_);
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
    const double L6_theta_ = q[0];
    const double L2_theta_ = q[1];
    const double L3_theta_ = q[2];
    const double L7_theta_ = q[3];
    const double L8_theta_ = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {L6_theta_, L2_theta_, L3_theta_, L7_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L8_theta_, L8_theta_, L8_theta_, L8_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L6_ = cosines_0[0];
    const double sin_theta_L6_ = sines_0[0];
    const double cos_theta_L2_ = cosines_0[1];
    const double sin_theta_L2_ = sines_0[1];
    const double cos_theta_L3_ = cosines_0[2];
    const double sin_theta_L3_ = sines_0[2];
    const double cos_theta_L7_ = cosines_0[3];
    const double sin_theta_L7_ = sines_0[3];
    const double cos_theta_L8_ = cosines_1[0];
    const double sin_theta_L8_ = sines_1[0];
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double span_L2_head_x_ = p->L2_head_span_x_*cos_theta_L2_;
    const double span_L2_head_y_ = p->L2_head_span_x_*sin_theta_L2_;
    const double span_L3_head_x_ = p->L3_head_span_x_*cos_theta_L3_;
    const double span_L3_head_y_ = p->L3_head_span_x_*sin_theta_L3_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;
    const double cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const double dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const double cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const double dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;

    /* right-hand side */
    const double r_guide_offset_ = r[0];
    const double r_L2_head_L3_head_x_ = r[1];
    const double r_L2_head_L3_head_y_ = r[2];
    const double r_P2_x_ = r[3];
    const double r_P2_y_ = r[4];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_L2_head_L3_head_x_L3_theta_ = p->inverse_tree_metric_L3_theta_*span_L3_head_y_;
    const double l_L2_head_L3_head_y_L3_theta_ = -p->inverse_tree_metric_L3_theta_*span_L3_head_x_;
    const double l_L6_theta_L8_theta_ = dot_L6_L8_*p->inverse_tree_metric_L8_theta_;
    const double l_guide_offset_L8_theta_ = p->inverse_tree_metric_L8_theta_*span_L8_head_y_;
    const double l_L6_theta_L7_theta_ = dot_L6_L7_*p->inverse_tree_metric_L7_theta_;
    const double l_P2_x_L7_theta_ = p->inverse_tree_metric_L7_theta_*span_L7_tail_y_;
    const double l_P2_y_L7_theta_ = -p->inverse_tree_metric_L7_theta_*span_L7_tail_x_;
    const double inverse_pivot_L6_theta_ = 1.0/(-dot_L6_L7_*l_L6_theta_L7_theta_ - dot_L6_L8_*l_L6_theta_L8_theta_
        + p->tree_metric_L6_theta_);
    const double w_guide_offset_L6_theta_ = -dot_L6_L8_*l_guide_offset_L8_theta_ + span_L6_head_y_;
    const double l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const double w_P2_x_L6_theta_ = -dot_L6_L7_*l_P2_x_L7_theta_ + span_L6_head_y_;
    const double l_P2_x_L6_theta_ = inverse_pivot_L6_theta_*w_P2_x_L6_theta_;
    const double w_P2_y_L6_theta_ = -dot_L6_L7_*l_P2_y_L7_theta_ - span_L6_head_x_;
    const double l_P2_y_L6_theta_ = inverse_pivot_L6_theta_*w_P2_y_L6_theta_;
    const double scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L8_theta_*span_L8_head_y_;
    if (!(scale_guide_offset_ > 0.0 && scale_guide_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;
    const double w_P2_x_guide_offset_ = -l_P2_x_L6_theta_*w_guide_offset_L6_theta_;
    const double l_P2_x_guide_offset_ = -inverse_pivot_guide_offset_*w_P2_x_guide_offset_;
    const double w_P2_y_guide_offset_ = -l_P2_y_L6_theta_*w_guide_offset_L6_theta_;
    const double l_P2_y_guide_offset_ = -inverse_pivot_guide_offset_*w_P2_y_guide_offset_;
    const double l_L2_head_L3_head_x_L2_theta_ = -p->inverse_tree_metric_L2_theta_*span_L2_head_y_;
    const double l_L2_head_L3_head_y_L2_theta_ = p->inverse_tree_metric_L2_theta_*span_L2_head_x_;
    const double l_P2_x_L2_theta_ = -p->inverse_tree_metric_L2_theta_*span_L2_head_y_;
    const double l_P2_y_L2_theta_ = p->inverse_tree_metric_L2_theta_*span_L2_head_x_;
    const double scale_L2_head_L3_head_x_ = -l_L2_head_L3_head_x_L2_theta_*span_L2_head_y_
        + l_L2_head_L3_head_x_L3_theta_*span_L3_head_y_;
    const double scale_L2_head_L3_head_y_ = l_L2_head_L3_head_y_L2_theta_*span_L2_head_x_
        - l_L2_head_L3_head_y_L3_theta_*span_L3_head_x_;
    const double pivot_L2_head_L3_head_x_L2_head_L3_head_y_ = -l_L2_head_L3_head_y_L2_theta_*span_L2_head_y_
        + l_L2_head_L3_head_y_L3_theta_*span_L3_head_y_;
    const double determinant_L2_head_L3_head_x_L2_head_L3_head_y_ =
        -(pivot_L2_head_L3_head_x_L2_head_L3_head_y_ * pivot_L2_head_L3_head_x_L2_head_L3_head_y_)
        + scale_L2_head_L3_head_x_*scale_L2_head_L3_head_y_;
    if (!(scale_L2_head_L3_head_x_ > 0.0 && scale_L2_head_L3_head_x_ < INFINITY))
        return 2;
    if (!(determinant_L2_head_L3_head_x_L2_head_L3_head_y_ > SINGULAR * scale_L2_head_L3_head_y_
        * scale_L2_head_L3_head_x_))
        return 3;
    const double size_L2_head_L3_head_x_ = scale_L2_head_L3_head_x_ + scale_L2_head_L3_head_y_;
    if (!(scale_L2_head_L3_head_x_ > VANISHING * size_L2_head_L3_head_x_))
        return 2;
    if (!(determinant_L2_head_L3_head_x_L2_head_L3_head_y_ > VANISHING * size_L2_head_L3_head_x_
        * scale_L2_head_L3_head_x_))
        return 3;
    const double inverse_L2_head_L3_head_x_L2_head_L3_head_y_ = -1.0/determinant_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double inverse_pivot_L2_head_L3_head_x_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *scale_L2_head_L3_head_y_;
    const double inverse_pivot_L2_head_L3_head_y_ = inverse_L2_head_L3_head_x_L2_head_L3_head_y_
        *scale_L2_head_L3_head_x_;
    const double inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_ =
        -inverse_L2_head_L3_head_x_L2_head_L3_head_y_*pivot_L2_head_L3_head_x_L2_head_L3_head_y_;
    const double w_P2_x_L2_head_L3_head_x_ = l_P2_x_L2_theta_*span_L2_head_y_;
    const double w_P2_x_L2_head_L3_head_y_ = -l_P2_x_L2_theta_*span_L2_head_x_;
    const double l_P2_x_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_x_L2_head_L3_head_y_ + inverse_pivot_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_;
    const double l_P2_x_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_x_L2_head_L3_head_x_ + inverse_pivot_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_;
    const double w_P2_y_L2_head_L3_head_x_ = l_P2_y_L2_theta_*span_L2_head_y_;
    const double w_P2_y_L2_head_L3_head_y_ = -l_P2_y_L2_theta_*span_L2_head_x_;
    const double l_P2_y_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_y_L2_head_L3_head_y_ + inverse_pivot_L2_head_L3_head_x_*w_P2_y_L2_head_L3_head_x_;
    const double l_P2_y_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *w_P2_y_L2_head_L3_head_x_ + inverse_pivot_L2_head_L3_head_y_*w_P2_y_L2_head_L3_head_y_;
    const double scale_P2_x_ = -l_P2_x_L2_theta_*span_L2_head_y_ + l_P2_x_L6_theta_*w_P2_x_L6_theta_
        + l_P2_x_L7_theta_*span_L7_tail_y_;
    const double scale_P2_y_ = l_P2_y_L2_theta_*span_L2_head_x_ + l_P2_y_L6_theta_*w_P2_y_L6_theta_
        - l_P2_y_L7_theta_*span_L7_tail_x_;
    const double pivot_P2_x_ = l_P2_x_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_
        + l_P2_x_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_ + l_P2_x_guide_offset_*w_P2_x_guide_offset_ + scale_P2_x_;
    const double pivot_P2_y_ = l_P2_y_L2_head_L3_head_x_*w_P2_y_L2_head_L3_head_x_
        + l_P2_y_L2_head_L3_head_y_*w_P2_y_L2_head_L3_head_y_ + l_P2_y_guide_offset_*w_P2_y_guide_offset_ + scale_P2_y_;
    const double pivot_P2_x_P2_y_ = l_P2_y_L2_head_L3_head_x_*w_P2_x_L2_head_L3_head_x_
        + l_P2_y_L2_head_L3_head_y_*w_P2_x_L2_head_L3_head_y_ - l_P2_y_L2_theta_*span_L2_head_y_
        + l_P2_y_L6_theta_*w_P2_x_L6_theta_ + l_P2_y_L7_theta_*span_L7_tail_y_
        + l_P2_y_guide_offset_*w_P2_x_guide_offset_;
    const double determinant_P2_x_P2_y_ = pivot_P2_x_*pivot_P2_y_ - (pivot_P2_x_P2_y_ * pivot_P2_x_P2_y_);
    if (!(pivot_P2_x_ > SINGULAR * scale_P2_x_))
        return 4;
    if (!(determinant_P2_x_P2_y_ > SINGULAR * scale_P2_y_ * pivot_P2_x_))
        return 5;
    const double size_P2_x_ = scale_P2_x_ + scale_P2_y_;
    if (!(pivot_P2_x_ > VANISHING * size_P2_x_))
        return 4;
    if (!(determinant_P2_x_P2_y_ > VANISHING * size_P2_x_ * pivot_P2_x_))
        return 5;
    const double inverse_P2_x_P2_y_ = -1.0/determinant_P2_x_P2_y_;
    const double inverse_pivot_P2_x_ = inverse_P2_x_P2_y_*pivot_P2_y_;
    const double inverse_pivot_P2_y_ = inverse_P2_x_P2_y_*pivot_P2_x_;
    const double inverse_cross_P2_x_P2_y_ = -inverse_P2_x_P2_y_*pivot_P2_x_P2_y_;

    /* forward substitution */
    const double step_z_P2_x_ = -l_P2_x_L2_head_L3_head_x_*r_L2_head_L3_head_x_
        - l_P2_x_L2_head_L3_head_y_*r_L2_head_L3_head_y_ - l_P2_x_guide_offset_*r_guide_offset_ + r_P2_x_;
    const double step_z_P2_y_ = -l_P2_y_L2_head_L3_head_x_*r_L2_head_L3_head_x_
        - l_P2_y_L2_head_L3_head_y_*r_L2_head_L3_head_y_ - l_P2_y_guide_offset_*r_guide_offset_ + r_P2_y_;

    /* backward substitution */
    const double step_lambda_P2_y_ = inverse_cross_P2_x_P2_y_*step_z_P2_x_ + inverse_pivot_P2_y_*step_z_P2_y_;
    const double step_lambda_P2_x_ = inverse_cross_P2_x_P2_y_*step_z_P2_y_ + inverse_pivot_P2_x_*step_z_P2_x_;
    const double step_lambda_L2_head_L3_head_y_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *r_L2_head_L3_head_x_ + inverse_pivot_L2_head_L3_head_y_*r_L2_head_L3_head_y_
        - l_P2_x_L2_head_L3_head_y_*step_lambda_P2_x_ - l_P2_y_L2_head_L3_head_y_*step_lambda_P2_y_;
    const double step_lambda_L2_head_L3_head_x_ = inverse_cross_L2_head_L3_head_x_L2_head_L3_head_y_
        *r_L2_head_L3_head_y_ + inverse_pivot_L2_head_L3_head_x_*r_L2_head_L3_head_x_
        - l_P2_x_L2_head_L3_head_x_*step_lambda_P2_x_ - l_P2_y_L2_head_L3_head_x_*step_lambda_P2_y_;
    const double step_acceleration_L2_theta_ = -l_L2_head_L3_head_x_L2_theta_*step_lambda_L2_head_L3_head_x_
        - l_L2_head_L3_head_y_L2_theta_*step_lambda_L2_head_L3_head_y_ - l_P2_x_L2_theta_*step_lambda_P2_x_
        - l_P2_y_L2_theta_*step_lambda_P2_y_;
    const double step_lambda_guide_offset_ = -inverse_pivot_guide_offset_*r_guide_offset_
        - l_P2_x_guide_offset_*step_lambda_P2_x_ - l_P2_y_guide_offset_*step_lambda_P2_y_;
    const double step_acceleration_L6_theta_ = -l_P2_x_L6_theta_*step_lambda_P2_x_ - l_P2_y_L6_theta_*step_lambda_P2_y_
        - l_guide_offset_L6_theta_*step_lambda_guide_offset_;
    const double step_acceleration_L7_theta_ = -l_L6_theta_L7_theta_*step_acceleration_L6_theta_
        - l_P2_x_L7_theta_*step_lambda_P2_x_ - l_P2_y_L7_theta_*step_lambda_P2_y_;
    const double step_acceleration_L8_theta_ = -l_L6_theta_L8_theta_*step_acceleration_L6_theta_
        - l_guide_offset_L8_theta_*step_lambda_guide_offset_;
    const double step_acceleration_L3_theta_ = -l_L2_head_L3_head_x_L3_theta_*step_lambda_L2_head_L3_head_x_
        - l_L2_head_L3_head_y_L3_theta_*step_lambda_L2_head_L3_head_y_;

    /* results */
    x[0] = step_acceleration_L6_theta_;
    x[1] = step_acceleration_L2_theta_;
    x[2] = step_acceleration_L3_theta_;
    x[3] = step_acceleration_L7_theta_;
    x[4] = step_acceleration_L8_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[20];
    closing[1] = - lambda[10];
    closing[2] = - lambda[11];
    closing[3] = + lambda[8] + lambda[10];
    closing[4] = + lambda[9] + lambda[11];
}
