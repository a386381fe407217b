/*
 * The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,
 * M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.
 *
 * Tree, parents first (body: how it is positioned; its angle):
 *     OF: on ground by O; its angle is an unknown
 *     BDE: on ground by B; its angle is an unknown
 *     AG: on ground by A5; its angle is an unknown
 *     AH: on ground by A7; its angle is an unknown
 *     FE: on OF by F; its angle is an unknown
 *     HE: on BDE by BDE.E=HE.E; its angle is an unknown
 *     EG: on FE by E4; its angle is an unknown
 * Unknowns, with rates in v and accelerations in a at the same index:
 *     q[0] = OF.theta (rad); q[1] = BDE.theta (rad); q[2] = AG.theta (rad); q[3] = AH.theta (rad);
 *     q[4] = FE.theta (rad); q[5] = HE.theta (rad); q[6] = EG.theta (rad)
 * Loop closures, with the storage of their multipliers:
 *     rhs->lambda[0] of G.x; rhs->lambda[1] of G.y; rhs->lambda[2] of H.x; rhs->lambda[3] of H.y;
 *     rhs->lambda[4] of E3.x; rhs->lambda[5] of E3.y
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
    const double OF_theta_ = q[0];
    const double OF_omega_ = v[0];
    const double BDE_theta_ = q[1];
    const double BDE_omega_ = v[1];
    const double AG_theta_ = q[2];
    const double AG_omega_ = v[2];
    const double AH_theta_ = q[3];
    const double AH_omega_ = v[3];
    const double FE_theta_ = q[4];
    const double FE_omega_ = v[4];
    const double HE_theta_ = q[5];
    const double HE_omega_ = v[5];
    const double EG_theta_ = q[6];
    const double EG_omega_ = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta_, BDE_theta_, AG_theta_, AH_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF_ = cosines_0[0];
    const double sin_theta_OF_ = sines_0[0];
    const double cos_theta_BDE_ = cosines_0[1];
    const double sin_theta_BDE_ = sines_0[1];
    const double cos_theta_AG_ = cosines_0[2];
    const double sin_theta_AG_ = sines_0[2];
    const double cos_theta_AH_ = cosines_0[3];
    const double sin_theta_AH_ = sines_0[3];
    const double cos_theta_FE_ = cosines_1[0];
    const double sin_theta_FE_ = sines_1[0];
    const double cos_theta_HE_ = cosines_1[1];
    const double sin_theta_HE_ = sines_1[1];
    const double cos_theta_EG_ = cosines_1[2];
    const double sin_theta_EG_ = sines_1[2];
    const double span_OF_com_x_ = p->OF_com_span_x_*cos_theta_OF_;
    const double span_OF_com_y_ = p->OF_com_span_x_*sin_theta_OF_;
    const double OF_vx_ = -OF_omega_*span_OF_com_y_;
    const double OF_vy_ = OF_omega_*span_OF_com_x_;
    const double span_BDE_com_x_ = p->BDE_com_span_x_*cos_theta_BDE_ - p->BDE_com_span_y_*sin_theta_BDE_;
    const double span_BDE_com_y_ = p->BDE_com_span_x_*sin_theta_BDE_ + p->BDE_com_span_y_*cos_theta_BDE_;
    const double BDE_x_ = p->B_x_ + span_BDE_com_x_;
    const double BDE_vx_ = -BDE_omega_*span_BDE_com_y_;
    const double BDE_y_ = p->B_y_ + span_BDE_com_y_;
    const double BDE_vy_ = BDE_omega_*span_BDE_com_x_;
    const double span_AG_com_x_ = p->AG_com_span_x_*cos_theta_AG_ - p->AG_com_span_y_*sin_theta_AG_;
    const double span_AG_com_y_ = p->AG_com_span_x_*sin_theta_AG_ + p->AG_com_span_y_*cos_theta_AG_;
    const double AG_x_ = p->A_x_ + span_AG_com_x_;
    const double AG_vx_ = -AG_omega_*span_AG_com_y_;
    const double AG_y_ = p->A_y_ + span_AG_com_y_;
    const double AG_vy_ = AG_omega_*span_AG_com_x_;
    const double span_AH_com_x_ = p->AH_com_span_x_*cos_theta_AH_ - p->AH_com_span_y_*sin_theta_AH_;
    const double span_AH_com_y_ = p->AH_com_span_x_*sin_theta_AH_ + p->AH_com_span_y_*cos_theta_AH_;
    const double AH_x_ = p->A_x_ + span_AH_com_x_;
    const double AH_vx_ = -AH_omega_*span_AH_com_y_;
    const double AH_y_ = p->A_y_ + span_AH_com_y_;
    const double AH_vy_ = AH_omega_*span_AH_com_x_;
    const double span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const double span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const double OF_F_vx_ = -OF_omega_*span_OF_F_y_;
    const double OF_F_vy_ = OF_omega_*span_OF_F_x_;
    const double span_FE_com_x_ = p->FE_com_span_x_*cos_theta_FE_;
    const double span_FE_com_y_ = p->FE_com_span_x_*sin_theta_FE_;
    const double FE_x_ = span_FE_com_x_ + span_OF_F_x_;
    const double FE_vx_ = -FE_omega_*span_FE_com_y_ + OF_F_vx_;
    const double FE_y_ = span_FE_com_y_ + span_OF_F_y_;
    const double FE_vy_ = FE_omega_*span_FE_com_x_ + OF_F_vy_;
    const double span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const double span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const double BDE_E_x_ = p->B_x_ + span_BDE_E_x_;
    const double BDE_E_vx_ = -BDE_omega_*span_BDE_E_y_;
    const double BDE_E_y_ = p->B_y_ + span_BDE_E_y_;
    const double BDE_E_vy_ = BDE_omega_*span_BDE_E_x_;
    const double span_HE_com_x_ = p->HE_com_span_x_*cos_theta_HE_;
    const double span_HE_com_y_ = p->HE_com_span_x_*sin_theta_HE_;
    const double HE_x_ = BDE_E_x_ + span_HE_com_x_;
    const double HE_vx_ = BDE_E_vx_ - HE_omega_*span_HE_com_y_;
    const double HE_y_ = BDE_E_y_ + span_HE_com_y_;
    const double HE_vy_ = BDE_E_vy_ + HE_omega_*span_HE_com_x_;
    const double span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const double span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const double FE_E_x_ = span_FE_E_x_ + span_OF_F_x_;
    const double FE_E_vx_ = -FE_omega_*span_FE_E_y_ + OF_F_vx_;
    const double FE_E_y_ = span_FE_E_y_ + span_OF_F_y_;
    const double FE_E_vy_ = FE_omega_*span_FE_E_x_ + OF_F_vy_;
    const double span_EG_com_x_ = -p->EG_com_span_y_*sin_theta_EG_;
    const double span_EG_com_y_ = p->EG_com_span_y_*cos_theta_EG_;
    const double EG_x_ = FE_E_x_ + span_EG_com_x_;
    const double EG_vx_ = -EG_omega_*span_EG_com_y_ + FE_E_vx_;
    const double EG_y_ = FE_E_y_ + span_EG_com_y_;
    const double EG_vy_ = EG_omega_*span_EG_com_x_ + FE_E_vy_;

    /* bodies */
    all_q[0] = span_OF_com_x_;
    all_v[0] = OF_vx_;
    all_q[1] = span_OF_com_y_;
    all_v[1] = OF_vy_;
    all_q[2] = OF_theta_;
    all_v[2] = OF_omega_;
    all_q[3] = FE_x_;
    all_v[3] = FE_vx_;
    all_q[4] = FE_y_;
    all_v[4] = FE_vy_;
    all_q[5] = FE_theta_;
    all_v[5] = FE_omega_;
    all_q[6] = BDE_x_;
    all_v[6] = BDE_vx_;
    all_q[7] = BDE_y_;
    all_v[7] = BDE_vy_;
    all_q[8] = BDE_theta_;
    all_v[8] = BDE_omega_;
    all_q[9] = EG_x_;
    all_v[9] = EG_vx_;
    all_q[10] = EG_y_;
    all_v[10] = EG_vy_;
    all_q[11] = EG_theta_;
    all_v[11] = EG_omega_;
    all_q[12] = AG_x_;
    all_v[12] = AG_vx_;
    all_q[13] = AG_y_;
    all_v[13] = AG_vy_;
    all_q[14] = AG_theta_;
    all_v[14] = AG_omega_;
    all_q[15] = HE_x_;
    all_v[15] = HE_vx_;
    all_q[16] = HE_y_;
    all_v[16] = HE_vy_;
    all_q[17] = HE_theta_;
    all_v[17] = HE_omega_;
    all_q[18] = AH_x_;
    all_v[18] = AH_vx_;
    all_q[19] = AH_y_;
    all_v[19] = AH_vy_;
    all_q[20] = AH_theta_;
    all_v[20] = AH_omega_;
}

/*
 * Tree coordinates s and their rates of an absolute state; its other coordinates are ignored.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double OF_theta_ = q[2];
    const double OF_omega_ = v[2];
    const double FE_theta_ = q[5];
    const double FE_omega_ = v[5];
    const double BDE_theta_ = q[8];
    const double BDE_omega_ = v[8];
    const double EG_theta_ = q[11];
    const double EG_omega_ = v[11];
    const double AG_theta_ = q[14];
    const double AG_omega_ = v[14];
    const double HE_theta_ = q[17];
    const double HE_omega_ = v[17];
    const double AH_theta_ = q[20];
    const double AH_omega_ = v[20];

    /* tree coordinates */
    s[0] = OF_theta_;  /* OF */
    s_rate[0] = OF_omega_;
    s[1] = BDE_theta_;  /* BDE */
    s_rate[1] = BDE_omega_;
    s[2] = AG_theta_;  /* AG */
    s_rate[2] = AG_omega_;
    s[3] = AH_theta_;  /* AH */
    s_rate[3] = AH_omega_;
    s[4] = FE_theta_;  /* FE */
    s_rate[4] = FE_omega_;
    s[5] = HE_theta_;  /* HE */
    s_rate[5] = HE_omega_;
    s[6] = EG_theta_;  /* EG */
    s_rate[6] = EG_omega_;
}

/*
 * Second rates a of the tree coordinates, from absolute accelerations all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[2];  /* OF */
    a[1] = all_a[8];  /* BDE */
    a[2] = all_a[14];  /* AG */
    a[3] = all_a[20];  /* AH */
    a[4] = all_a[5];  /* FE */
    a[5] = all_a[17];  /* HE */
    a[6] = all_a[11];  /* EG */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta_ = q[0];
    const double BDE_theta_ = q[1];
    const double AG_theta_ = q[2];
    const double AH_theta_ = q[3];
    const double FE_theta_ = q[4];
    const double HE_theta_ = q[5];
    const double EG_theta_ = q[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta_, BDE_theta_, AG_theta_, AH_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF_ = cosines_0[0];
    const double sin_theta_OF_ = sines_0[0];
    const double cos_theta_BDE_ = cosines_0[1];
    const double sin_theta_BDE_ = sines_0[1];
    const double cos_theta_AG_ = cosines_0[2];
    const double sin_theta_AG_ = sines_0[2];
    const double cos_theta_AH_ = cosines_0[3];
    const double sin_theta_AH_ = sines_0[3];
    const double cos_theta_FE_ = cosines_1[0];
    const double sin_theta_FE_ = sines_1[0];
    const double cos_theta_HE_ = cosines_1[1];
    const double sin_theta_HE_ = sines_1[1];
    const double cos_theta_EG_ = cosines_1[2];
    const double sin_theta_EG_ = sines_1[2];
    const double span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const double span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const double span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const double span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const double span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const double span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const double span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const double span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const double span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const double span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const double span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const double span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const double span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const double span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;

    /* rows */
    out[0] = -p->A_x_ - span_AG_G_x_ + span_EG_G_x_ + span_FE_E_x_ + span_OF_F_x_;  /* G.x */
    out[1] = -p->A_y_ - span_AG_G_y_ + span_EG_G_y_ + span_FE_E_y_ + span_OF_F_y_;  /* G.y */
    out[2] = -p->A_x_ + p->B_x_ - span_AH_H_x_ + span_BDE_E_x_ + span_HE_H_x_;  /* H.x */
    out[3] = -p->A_y_ + p->B_y_ - span_AH_H_y_ + span_BDE_E_y_ + span_HE_H_y_;  /* H.y */
    out[4] = -p->B_x_ - span_BDE_E_x_ + span_FE_E_x_ + span_OF_F_x_;  /* E3.x */
    out[5] = -p->B_y_ - span_BDE_E_y_ + span_FE_E_y_ + span_OF_F_y_;  /* E3.y */
}

/*
 * Rate Phi_q v - nu of the loop closures in tree coordinates.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta_ = q[0];
    const double OF_omega_ = v[0];
    const double BDE_theta_ = q[1];
    const double BDE_omega_ = v[1];
    const double AG_theta_ = q[2];
    const double AG_omega_ = v[2];
    const double AH_theta_ = q[3];
    const double AH_omega_ = v[3];
    const double FE_theta_ = q[4];
    const double FE_omega_ = v[4];
    const double HE_theta_ = q[5];
    const double HE_omega_ = v[5];
    const double EG_theta_ = q[6];
    const double EG_omega_ = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta_, BDE_theta_, AG_theta_, AH_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF_ = cosines_0[0];
    const double sin_theta_OF_ = sines_0[0];
    const double cos_theta_BDE_ = cosines_0[1];
    const double sin_theta_BDE_ = sines_0[1];
    const double cos_theta_AG_ = cosines_0[2];
    const double sin_theta_AG_ = sines_0[2];
    const double cos_theta_AH_ = cosines_0[3];
    const double sin_theta_AH_ = sines_0[3];
    const double cos_theta_FE_ = cosines_1[0];
    const double sin_theta_FE_ = sines_1[0];
    const double cos_theta_HE_ = cosines_1[1];
    const double sin_theta_HE_ = sines_1[1];
    const double cos_theta_EG_ = cosines_1[2];
    const double sin_theta_EG_ = sines_1[2];
    const double span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const double span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const double span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const double span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const double span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const double span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const double span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const double span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const double span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const double span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const double span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const double span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const double span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const double span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;

    /* rows */
    /* G.x */
    out[0] = AG_omega_*span_AG_G_y_ - EG_omega_*span_EG_G_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;
    /* G.y */
    out[1] = -AG_omega_*span_AG_G_x_ + EG_omega_*span_EG_G_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;
    out[2] = AH_omega_*span_AH_H_y_ - BDE_omega_*span_BDE_E_y_ - HE_omega_*span_HE_H_y_;  /* H.x */
    out[3] = -AH_omega_*span_AH_H_x_ + BDE_omega_*span_BDE_E_x_ + HE_omega_*span_HE_H_x_;  /* H.y */
    out[4] = BDE_omega_*span_BDE_E_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;  /* E3.x */
    out[5] = -BDE_omega_*span_BDE_E_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;  /* E3.y */
}

/*
 * Right-hand side: accelerations a of the tree coordinates q, and multipliers of the closures in `rhs`, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     AG.theta; AH.theta; HE.theta; lambda of H.x with lambda of H.y; BDE.theta; EG.theta;
 *     lambda of G.x with lambda of G.y; OF.theta with FE.theta; lambda of E3.x with lambda of E3.y.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double OF_theta_ = q[0];
    const double OF_omega_ = v[0];
    const double BDE_theta_ = q[1];
    const double BDE_omega_ = v[1];
    const double AG_theta_ = q[2];
    const double AG_omega_ = v[2];
    const double AH_theta_ = q[3];
    const double AH_omega_ = v[3];
    const double FE_theta_ = q[4];
    const double FE_omega_ = v[4];
    const double HE_theta_ = q[5];
    const double HE_omega_ = v[5];
    const double EG_theta_ = q[6];
    const double EG_omega_ = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta_, BDE_theta_, AG_theta_, AH_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF_ = cosines_0[0];
    const double sin_theta_OF_ = sines_0[0];
    const double cos_theta_BDE_ = cosines_0[1];
    const double sin_theta_BDE_ = sines_0[1];
    const double cos_theta_AG_ = cosines_0[2];
    const double sin_theta_AG_ = sines_0[2];
    const double cos_theta_AH_ = cosines_0[3];
    const double sin_theta_AH_ = sines_0[3];
    const double cos_theta_FE_ = cosines_1[0];
    const double sin_theta_FE_ = sines_1[0];
    const double cos_theta_HE_ = cosines_1[1];
    const double sin_theta_HE_ = sines_1[1];
    const double cos_theta_EG_ = cosines_1[2];
    const double sin_theta_EG_ = sines_1[2];
    const double span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const double span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const double span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const double span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const double span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const double span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const double span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const double span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const double span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const double span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const double span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const double span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const double span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const double span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;
    const double span_BDE_D_x_ = p->BDE_D_span_x_*cos_theta_BDE_ - p->BDE_D_span_y_*sin_theta_BDE_;
    const double span_BDE_D_y_ = p->BDE_D_span_x_*sin_theta_BDE_ + p->BDE_D_span_y_*cos_theta_BDE_;
    const double BDE_D_x_ = p->B_x_ + span_BDE_D_x_;
    const double BDE_D_y_ = p->B_y_ + span_BDE_D_y_;
    const double spring_span_x_ = BDE_D_x_ - p->C_x_;
    const double spring_span_y_ = BDE_D_y_ - p->C_y_;
    const double spring_length_ = sqrt((spring_span_x_ * spring_span_x_) + (spring_span_y_ * spring_span_y_));
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const double spring_pull_ = spring_force_/spring_length_;
    const double cos_FE_less_OF_ = cos_theta_FE_*cos_theta_OF_ + sin_theta_FE_*sin_theta_OF_;
    const double sin_FE_less_OF_ = -cos_theta_FE_*sin_theta_OF_ + cos_theta_OF_*sin_theta_FE_;
    const double dot_OF_FE_ = cos_FE_less_OF_*p->inertia_OF_FE_;
    const double cross_OF_FE_ = p->inertia_OF_FE_*sin_FE_less_OF_;
    const double cos_EG_less_OF_ = cos_theta_EG_*cos_theta_OF_ + sin_theta_EG_*sin_theta_OF_;
    const double sin_EG_less_OF_ = -cos_theta_EG_*sin_theta_OF_ + cos_theta_OF_*sin_theta_EG_;
    const double dot_OF_EG_ = -sin_EG_less_OF_*p->twist_OF_EG_;
    const double cross_OF_EG_ = cos_EG_less_OF_*p->twist_OF_EG_;
    const double cos_EG_less_FE_ = cos_theta_EG_*cos_theta_FE_ + sin_theta_EG_*sin_theta_FE_;
    const double sin_EG_less_FE_ = -cos_theta_EG_*sin_theta_FE_ + cos_theta_FE_*sin_theta_EG_;
    const double dot_FE_EG_ = -sin_EG_less_FE_*p->twist_FE_EG_;
    const double cross_FE_EG_ = cos_EG_less_FE_*p->twist_FE_EG_;
    const double cos_HE_less_BDE_ = cos_theta_BDE_*cos_theta_HE_ + sin_theta_BDE_*sin_theta_HE_;
    const double sin_HE_less_BDE_ = cos_theta_BDE_*sin_theta_HE_ - cos_theta_HE_*sin_theta_BDE_;
    const double dot_BDE_HE_ = cos_HE_less_BDE_*p->inertia_BDE_HE_ - sin_HE_less_BDE_*p->twist_BDE_HE_;
    const double cross_BDE_HE_ = cos_HE_less_BDE_*p->twist_BDE_HE_ + p->inertia_BDE_HE_*sin_HE_less_BDE_;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_G_x_ = -(AG_omega_ * AG_omega_)*span_AG_G_x_ + (EG_omega_ * EG_omega_)*span_EG_G_x_
        + (FE_omega_ * FE_omega_)*span_FE_E_x_ + (OF_omega_ * OF_omega_)*span_OF_F_x_;
    const double rhs_G_y_ = -(AG_omega_ * AG_omega_)*span_AG_G_y_ + (EG_omega_ * EG_omega_)*span_EG_G_y_
        + (FE_omega_ * FE_omega_)*span_FE_E_y_ + (OF_omega_ * OF_omega_)*span_OF_F_y_;
    const double rhs_H_x_ = -(AH_omega_ * AH_omega_)*span_AH_H_x_ + (BDE_omega_ * BDE_omega_)*span_BDE_E_x_
        + (HE_omega_ * HE_omega_)*span_HE_H_x_;
    const double rhs_H_y_ = -(AH_omega_ * AH_omega_)*span_AH_H_y_ + (BDE_omega_ * BDE_omega_)*span_BDE_E_y_
        + (HE_omega_ * HE_omega_)*span_HE_H_y_;
    const double rhs_E3_x_ = -(BDE_omega_ * BDE_omega_)*span_BDE_E_x_ + (FE_omega_ * FE_omega_)*span_FE_E_x_
        + (OF_omega_ * OF_omega_)*span_OF_F_x_;
    const double rhs_E3_y_ = -(BDE_omega_ * BDE_omega_)*span_BDE_E_y_ + (FE_omega_ * FE_omega_)*span_FE_E_y_
        + (OF_omega_ * OF_omega_)*span_OF_F_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    if (!(p->mass_AG_AG_ > LIGHT_PIVOT * p->AG_turning_)) {
        pivot = 7;
        goto dependent;
    }
    const double l_G_x_AG_theta_ = p->inverse_mass_AG_AG_*span_AG_G_y_;
    const double l_G_y_AG_theta_ = -p->inverse_mass_AG_AG_*span_AG_G_x_;
    if (!(p->mass_AH_AH_ > LIGHT_PIVOT * p->AH_turning_)) {
        pivot = 8;
        goto dependent;
    }
    const double l_H_x_AH_theta_ = p->inverse_mass_AH_AH_*span_AH_H_y_;
    const double l_H_y_AH_theta_ = -p->inverse_mass_AH_AH_*span_AH_H_x_;
    if (!(p->mass_HE_HE_ > LIGHT_PIVOT * p->HE_turning_)) {
        pivot = 9;
        goto dependent;
    }
    const double l_H_x_HE_theta_ = -p->inverse_mass_HE_HE_*span_HE_H_y_;
    const double l_H_y_HE_theta_ = p->inverse_mass_HE_HE_*span_HE_H_x_;
    const double l_BDE_theta_HE_theta_ = dot_BDE_HE_*p->inverse_mass_HE_HE_;
    const double scale_H_x_ = l_H_x_AH_theta_*span_AH_H_y_ - l_H_x_HE_theta_*span_HE_H_y_;
    const double scale_H_y_ = -l_H_y_AH_theta_*span_AH_H_x_ + l_H_y_HE_theta_*span_HE_H_x_;
    const double pivot_H_x_H_y_ = l_H_y_AH_theta_*span_AH_H_y_ - l_H_y_HE_theta_*span_HE_H_y_;
    const double determinant_H_x_H_y_ = -(pivot_H_x_H_y_ * pivot_H_x_H_y_) + scale_H_x_*scale_H_y_;
    if (!(scale_H_x_ > 0.0 && scale_H_x_ < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_H_x_H_y_ > EARLY * scale_H_y_ * scale_H_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double size_H_x_ = scale_H_x_ + scale_H_y_;
    if (!(scale_H_x_ > discrete->min_pivot_size * size_H_x_)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_H_x_H_y_ > discrete->min_pivot_size * size_H_x_ * scale_H_x_)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_H_x_H_y_ = -1.0/determinant_H_x_H_y_;
    const double inverse_pivot_H_x_ = inverse_H_x_H_y_*scale_H_y_;
    const double inverse_pivot_H_y_ = inverse_H_x_H_y_*scale_H_x_;
    const double inverse_cross_H_x_H_y_ = -inverse_H_x_H_y_*pivot_H_x_H_y_;
    const double w_BDE_theta_H_x_ = l_BDE_theta_HE_theta_*span_HE_H_y_ - span_BDE_E_y_;
    const double w_BDE_theta_H_y_ = -l_BDE_theta_HE_theta_*span_HE_H_x_ + span_BDE_E_x_;
    const double l_BDE_theta_H_x_ = inverse_cross_H_x_H_y_*w_BDE_theta_H_y_ + inverse_pivot_H_x_*w_BDE_theta_H_x_;
    const double l_BDE_theta_H_y_ = inverse_cross_H_x_H_y_*w_BDE_theta_H_x_ + inverse_pivot_H_y_*w_BDE_theta_H_y_;
    const double pivot_BDE_theta_ = -dot_BDE_HE_*l_BDE_theta_HE_theta_ - l_BDE_theta_H_x_*w_BDE_theta_H_x_
        - l_BDE_theta_H_y_*w_BDE_theta_H_y_ + p->mass_BDE_BDE_;
    if (!(pivot_BDE_theta_ > LIGHT_PIVOT * p->BDE_turning_)) {
        pivot = 10;
        goto dependent;
    }
    const double inverse_pivot_BDE_theta_ = 1.0/pivot_BDE_theta_;
    const double l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*span_BDE_E_y_;
    const double l_E3_y_BDE_theta_ = -inverse_pivot_BDE_theta_*span_BDE_E_x_;
    if (!(p->mass_EG_EG_ > LIGHT_PIVOT * p->EG_turning_)) {
        pivot = 11;
        goto dependent;
    }
    const double l_G_x_EG_theta_ = -p->inverse_mass_EG_EG_*span_EG_G_y_;
    const double l_G_y_EG_theta_ = p->inverse_mass_EG_EG_*span_EG_G_x_;
    const double l_OF_theta_EG_theta_ = dot_OF_EG_*p->inverse_mass_EG_EG_;
    const double l_FE_theta_EG_theta_ = dot_FE_EG_*p->inverse_mass_EG_EG_;
    const double scale_G_x_ = l_G_x_AG_theta_*span_AG_G_y_ - l_G_x_EG_theta_*span_EG_G_y_;
    const double scale_G_y_ = -l_G_y_AG_theta_*span_AG_G_x_ + l_G_y_EG_theta_*span_EG_G_x_;
    const double pivot_G_x_G_y_ = l_G_y_AG_theta_*span_AG_G_y_ - l_G_y_EG_theta_*span_EG_G_y_;
    const double determinant_G_x_G_y_ = -(pivot_G_x_G_y_ * pivot_G_x_G_y_) + scale_G_x_*scale_G_y_;
    if (!(scale_G_x_ > 0.0 && scale_G_x_ < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_G_x_G_y_ > EARLY * scale_G_y_ * scale_G_x_)) {
        pivot = 4;
        goto dependent;
    }
    const double size_G_x_ = scale_G_x_ + scale_G_y_;
    if (!(scale_G_x_ > discrete->min_pivot_size * size_G_x_)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_G_x_G_y_ > discrete->min_pivot_size * size_G_x_ * scale_G_x_)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_G_x_G_y_ = -1.0/determinant_G_x_G_y_;
    const double inverse_pivot_G_x_ = inverse_G_x_G_y_*scale_G_y_;
    const double inverse_pivot_G_y_ = inverse_G_x_G_y_*scale_G_x_;
    const double inverse_cross_G_x_G_y_ = -inverse_G_x_G_y_*pivot_G_x_G_y_;
    const double w_OF_theta_G_x_ = l_OF_theta_EG_theta_*span_EG_G_y_ - span_OF_F_y_;
    const double w_OF_theta_G_y_ = -l_OF_theta_EG_theta_*span_EG_G_x_ + span_OF_F_x_;
    const double l_OF_theta_G_x_ = inverse_cross_G_x_G_y_*w_OF_theta_G_y_ + inverse_pivot_G_x_*w_OF_theta_G_x_;
    const double l_OF_theta_G_y_ = inverse_cross_G_x_G_y_*w_OF_theta_G_x_ + inverse_pivot_G_y_*w_OF_theta_G_y_;
    const double w_FE_theta_G_x_ = l_FE_theta_EG_theta_*span_EG_G_y_ - span_FE_E_y_;
    const double w_FE_theta_G_y_ = -l_FE_theta_EG_theta_*span_EG_G_x_ + span_FE_E_x_;
    const double l_FE_theta_G_x_ = inverse_cross_G_x_G_y_*w_FE_theta_G_y_ + inverse_pivot_G_x_*w_FE_theta_G_x_;
    const double l_FE_theta_G_y_ = inverse_cross_G_x_G_y_*w_FE_theta_G_x_ + inverse_pivot_G_y_*w_FE_theta_G_y_;
    const double pivot_OF_theta_ = -dot_OF_EG_*l_OF_theta_EG_theta_ - l_OF_theta_G_x_*w_OF_theta_G_x_
        - l_OF_theta_G_y_*w_OF_theta_G_y_ + p->mass_OF_OF_;
    const double pivot_FE_theta_ = -dot_FE_EG_*l_FE_theta_EG_theta_ - l_FE_theta_G_x_*w_FE_theta_G_x_
        - l_FE_theta_G_y_*w_FE_theta_G_y_ + p->mass_FE_FE_;
    const double pivot_OF_theta_FE_theta_ = -dot_OF_EG_*l_FE_theta_EG_theta_ + dot_OF_FE_
        - l_FE_theta_G_x_*w_OF_theta_G_x_ - l_FE_theta_G_y_*w_OF_theta_G_y_;
    const double determinant_OF_theta_FE_theta_ = pivot_FE_theta_*pivot_OF_theta_
        - (pivot_OF_theta_FE_theta_ * pivot_OF_theta_FE_theta_);
    if (!(pivot_OF_theta_ > LIGHT_PIVOT * p->OF_turning_)) {
        pivot = 12;
        goto dependent;
    }
    if (!(determinant_OF_theta_FE_theta_ > LIGHT_PIVOT * p->FE_turning_ * pivot_OF_theta_)) {
        pivot = 13;
        goto dependent;
    }
    const double inverse_OF_theta_FE_theta_ = 1.0/determinant_OF_theta_FE_theta_;
    const double inverse_pivot_OF_theta_ = inverse_OF_theta_FE_theta_*pivot_FE_theta_;
    const double inverse_pivot_FE_theta_ = inverse_OF_theta_FE_theta_*pivot_OF_theta_;
    const double inverse_cross_OF_theta_FE_theta_ = -inverse_OF_theta_FE_theta_*pivot_OF_theta_FE_theta_;
    const double l_E3_x_OF_theta_ = -inverse_cross_OF_theta_FE_theta_*span_FE_E_y_
        - inverse_pivot_OF_theta_*span_OF_F_y_;
    const double l_E3_x_FE_theta_ = -inverse_cross_OF_theta_FE_theta_*span_OF_F_y_
        - inverse_pivot_FE_theta_*span_FE_E_y_;
    const double l_E3_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*span_FE_E_x_
        + inverse_pivot_OF_theta_*span_OF_F_x_;
    const double l_E3_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*span_OF_F_x_
        + inverse_pivot_FE_theta_*span_FE_E_x_;
    const double scale_E3_x_ = l_E3_x_BDE_theta_*span_BDE_E_y_ - l_E3_x_FE_theta_*span_FE_E_y_
        - l_E3_x_OF_theta_*span_OF_F_y_;
    const double scale_E3_y_ = -l_E3_y_BDE_theta_*span_BDE_E_x_ + l_E3_y_FE_theta_*span_FE_E_x_
        + l_E3_y_OF_theta_*span_OF_F_x_;
    const double pivot_E3_x_E3_y_ = l_E3_y_BDE_theta_*span_BDE_E_y_ - l_E3_y_FE_theta_*span_FE_E_y_
        - l_E3_y_OF_theta_*span_OF_F_y_;
    const double determinant_E3_x_E3_y_ = -(pivot_E3_x_E3_y_ * pivot_E3_x_E3_y_) + scale_E3_x_*scale_E3_y_;
    if (!(scale_E3_x_ > 0.0 && scale_E3_x_ < INFINITY)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_E3_x_E3_y_ > discrete->min_pivot * scale_E3_y_ * scale_E3_x_)) {
        pivot = 6;
        goto dependent;
    }
    const double size_E3_x_ = scale_E3_x_ + scale_E3_y_;
    if (!(scale_E3_x_ > discrete->min_pivot_size * size_E3_x_)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_E3_x_E3_y_ > discrete->min_pivot_size * size_E3_x_ * scale_E3_x_)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const double inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*scale_E3_y_;
    const double inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*scale_E3_x_;
    const double inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;

    /* forward substitution */
    const double z_HE_theta_ = -(BDE_omega_ * BDE_omega_)*cross_BDE_HE_;
    const double z_H_x_ = -l_H_x_HE_theta_*z_HE_theta_ + rhs_H_x_;
    const double z_H_y_ = -l_H_y_HE_theta_*z_HE_theta_ + rhs_H_y_;
    const double z_BDE_theta_ = (HE_omega_ * HE_omega_)*cross_BDE_HE_ - l_BDE_theta_HE_theta_*z_HE_theta_
        - l_BDE_theta_H_x_*z_H_x_ - l_BDE_theta_H_y_*z_H_y_ - span_BDE_D_x_*spring_pull_*spring_span_y_
        + span_BDE_D_y_*spring_pull_*spring_span_x_;
    const double z_EG_theta_ = -(FE_omega_ * FE_omega_)*cross_FE_EG_ - (OF_omega_ * OF_omega_)*cross_OF_EG_;
    const double z_G_x_ = -l_G_x_EG_theta_*z_EG_theta_ + rhs_G_x_;
    const double z_G_y_ = -l_G_y_EG_theta_*z_EG_theta_ + rhs_G_y_;
    const double z_OF_theta_ = (EG_omega_ * EG_omega_)*cross_OF_EG_ + (FE_omega_ * FE_omega_)*cross_OF_FE_
        - l_OF_theta_EG_theta_*z_EG_theta_ - l_OF_theta_G_x_*z_G_x_ - l_OF_theta_G_y_*z_G_y_ + p->motor_value_;
    const double z_FE_theta_ = (EG_omega_ * EG_omega_)*cross_FE_EG_ - (OF_omega_ * OF_omega_)*cross_OF_FE_
        - l_FE_theta_EG_theta_*z_EG_theta_ - l_FE_theta_G_x_*z_G_x_ - l_FE_theta_G_y_*z_G_y_;
    const double z_E3_x_ = -l_E3_x_BDE_theta_*z_BDE_theta_ - l_E3_x_FE_theta_*z_FE_theta_
        - l_E3_x_OF_theta_*z_OF_theta_ + rhs_E3_x_;
    const double z_E3_y_ = -l_E3_y_BDE_theta_*z_BDE_theta_ - l_E3_y_FE_theta_*z_FE_theta_
        - l_E3_y_OF_theta_*z_OF_theta_ + rhs_E3_y_;

    /* backward substitution */
    const double lambda_E3_y_ = inverse_cross_E3_x_E3_y_*z_E3_x_ + inverse_pivot_E3_y_*z_E3_y_;
    const double lambda_E3_x_ = inverse_cross_E3_x_E3_y_*z_E3_y_ + inverse_pivot_E3_x_*z_E3_x_;
    const double acceleration_FE_theta_ = inverse_cross_OF_theta_FE_theta_*z_OF_theta_
        + inverse_pivot_FE_theta_*z_FE_theta_ - l_E3_x_FE_theta_*lambda_E3_x_ - l_E3_y_FE_theta_*lambda_E3_y_;
    const double acceleration_OF_theta_ = inverse_cross_OF_theta_FE_theta_*z_FE_theta_
        + inverse_pivot_OF_theta_*z_OF_theta_ - l_E3_x_OF_theta_*lambda_E3_x_ - l_E3_y_OF_theta_*lambda_E3_y_;
    const double lambda_G_y_ = -acceleration_FE_theta_*l_FE_theta_G_y_ - acceleration_OF_theta_*l_OF_theta_G_y_
        + inverse_cross_G_x_G_y_*z_G_x_ + inverse_pivot_G_y_*z_G_y_;
    const double lambda_G_x_ = -acceleration_FE_theta_*l_FE_theta_G_x_ - acceleration_OF_theta_*l_OF_theta_G_x_
        + inverse_cross_G_x_G_y_*z_G_y_ + inverse_pivot_G_x_*z_G_x_;
    const double acceleration_EG_theta_ = -acceleration_FE_theta_*l_FE_theta_EG_theta_
        - acceleration_OF_theta_*l_OF_theta_EG_theta_ + p->inverse_mass_EG_EG_*z_EG_theta_
        - l_G_x_EG_theta_*lambda_G_x_ - l_G_y_EG_theta_*lambda_G_y_;
    const double acceleration_BDE_theta_ = inverse_pivot_BDE_theta_*z_BDE_theta_ - l_E3_x_BDE_theta_*lambda_E3_x_
        - l_E3_y_BDE_theta_*lambda_E3_y_;
    const double lambda_H_y_ = -acceleration_BDE_theta_*l_BDE_theta_H_y_ + inverse_cross_H_x_H_y_*z_H_x_
        + inverse_pivot_H_y_*z_H_y_;
    const double lambda_H_x_ = -acceleration_BDE_theta_*l_BDE_theta_H_x_ + inverse_cross_H_x_H_y_*z_H_y_
        + inverse_pivot_H_x_*z_H_x_;
    const double acceleration_HE_theta_ = -acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        + p->inverse_mass_HE_HE_*z_HE_theta_ - l_H_x_HE_theta_*lambda_H_x_ - l_H_y_HE_theta_*lambda_H_y_;
    const double acceleration_AH_theta_ = -l_H_x_AH_theta_*lambda_H_x_ - l_H_y_AH_theta_*lambda_H_y_;
    const double acceleration_AG_theta_ = -l_G_x_AG_theta_*lambda_G_x_ - l_G_y_AG_theta_*lambda_G_y_;

    /* results */
    a[0] = acceleration_OF_theta_;
    a[1] = acceleration_BDE_theta_;
    a[2] = acceleration_AG_theta_;
    a[3] = acceleration_AH_theta_;
    a[4] = acceleration_FE_theta_;
    a[5] = acceleration_HE_theta_;
    a[6] = acceleration_EG_theta_;
    rhs->lambda[0] = lambda_G_x_;
    rhs->lambda[1] = lambda_G_y_;
    rhs->lambda[2] = lambda_H_x_;
    rhs->lambda[3] = lambda_H_y_;
    rhs->lambda[4] = lambda_E3_x_;
    rhs->lambda[5] = lambda_E3_y_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent:
    pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = OF_omega_*p->motor_value_;
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
    const double OF_theta_ = q[0];
    const double BDE_theta_ = q[1];
    const double AG_theta_ = q[2];
    const double AH_theta_ = q[3];
    const double FE_theta_ = q[4];
    const double HE_theta_ = q[5];
    const double EG_theta_ = q[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta_, BDE_theta_, AG_theta_, AH_theta_};
    Four sines_0, cosines_0;
    compute_sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    compute_sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF_ = cosines_0[0];
    const double sin_theta_OF_ = sines_0[0];
    const double cos_theta_BDE_ = cosines_0[1];
    const double sin_theta_BDE_ = sines_0[1];
    const double cos_theta_AG_ = cosines_0[2];
    const double sin_theta_AG_ = sines_0[2];
    const double cos_theta_AH_ = cosines_0[3];
    const double sin_theta_AH_ = sines_0[3];
    const double cos_theta_FE_ = cosines_1[0];
    const double sin_theta_FE_ = sines_1[0];
    const double cos_theta_HE_ = cosines_1[1];
    const double sin_theta_HE_ = sines_1[1];
    const double cos_theta_EG_ = cosines_1[2];
    const double sin_theta_EG_ = sines_1[2];
    const double span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const double span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const double span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const double span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const double span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const double span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const double span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const double span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const double span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const double span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const double span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const double span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const double span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const double span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;
    const double cos_FE_less_OF_ = cos_theta_FE_*cos_theta_OF_ + sin_theta_FE_*sin_theta_OF_;
    const double dot_OF_FE_ = cos_FE_less_OF_*p->inertia_OF_FE_;
    const double sin_EG_less_OF_ = -cos_theta_EG_*sin_theta_OF_ + cos_theta_OF_*sin_theta_EG_;
    const double dot_OF_EG_ = -sin_EG_less_OF_*p->twist_OF_EG_;
    const double sin_EG_less_FE_ = -cos_theta_EG_*sin_theta_FE_ + cos_theta_FE_*sin_theta_EG_;
    const double dot_FE_EG_ = -sin_EG_less_FE_*p->twist_FE_EG_;
    const double cos_HE_less_BDE_ = cos_theta_BDE_*cos_theta_HE_ + sin_theta_BDE_*sin_theta_HE_;
    const double sin_HE_less_BDE_ = cos_theta_BDE_*sin_theta_HE_ - cos_theta_HE_*sin_theta_BDE_;
    const double dot_BDE_HE_ = cos_HE_less_BDE_*p->inertia_BDE_HE_ - sin_HE_less_BDE_*p->twist_BDE_HE_;

    /* right-hand side */
    const double r_G_x_ = r[0];
    const double r_G_y_ = r[1];
    const double r_H_x_ = r[2];
    const double r_H_y_ = r[3];
    const double r_E3_x_ = r[4];
    const double r_E3_y_ = r[5];

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_G_x_AG_theta_ = p->inverse_tree_metric_AG_theta_*span_AG_G_y_;
    const double l_G_y_AG_theta_ = -p->inverse_tree_metric_AG_theta_*span_AG_G_x_;
    const double l_H_x_AH_theta_ = p->inverse_tree_metric_AH_theta_*span_AH_H_y_;
    const double l_H_y_AH_theta_ = -p->inverse_tree_metric_AH_theta_*span_AH_H_x_;
    const double l_BDE_theta_HE_theta_ = dot_BDE_HE_*p->inverse_tree_metric_HE_theta_;
    const double l_H_x_HE_theta_ = -p->inverse_tree_metric_HE_theta_*span_HE_H_y_;
    const double l_H_y_HE_theta_ = p->inverse_tree_metric_HE_theta_*span_HE_H_x_;
    const double inverse_pivot_BDE_theta_ = 1.0/(-dot_BDE_HE_*l_BDE_theta_HE_theta_ + p->tree_metric_BDE_theta_);
    const double w_H_x_BDE_theta_ = -dot_BDE_HE_*l_H_x_HE_theta_ - span_BDE_E_y_;
    const double l_H_x_BDE_theta_ = inverse_pivot_BDE_theta_*w_H_x_BDE_theta_;
    const double w_H_y_BDE_theta_ = -dot_BDE_HE_*l_H_y_HE_theta_ + span_BDE_E_x_;
    const double l_H_y_BDE_theta_ = inverse_pivot_BDE_theta_*w_H_y_BDE_theta_;
    const double l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*span_BDE_E_y_;
    const double l_E3_y_BDE_theta_ = -inverse_pivot_BDE_theta_*span_BDE_E_x_;
    const double scale_H_x_ = l_H_x_AH_theta_*span_AH_H_y_ + l_H_x_BDE_theta_*w_H_x_BDE_theta_
        - l_H_x_HE_theta_*span_HE_H_y_;
    const double scale_H_y_ = -l_H_y_AH_theta_*span_AH_H_x_ + l_H_y_BDE_theta_*w_H_y_BDE_theta_
        + l_H_y_HE_theta_*span_HE_H_x_;
    const double pivot_H_x_H_y_ = l_H_y_AH_theta_*span_AH_H_y_ + l_H_y_BDE_theta_*w_H_x_BDE_theta_
        - l_H_y_HE_theta_*span_HE_H_y_;
    const double determinant_H_x_H_y_ = -(pivot_H_x_H_y_ * pivot_H_x_H_y_) + scale_H_x_*scale_H_y_;
    if (!(scale_H_x_ > 0.0 && scale_H_x_ < INFINITY))
        return 1;
    if (!(determinant_H_x_H_y_ > SINGULAR * scale_H_y_ * scale_H_x_))
        return 2;
    const double size_H_x_ = scale_H_x_ + scale_H_y_;
    if (!(scale_H_x_ > VANISHING * size_H_x_))
        return 1;
    if (!(determinant_H_x_H_y_ > VANISHING * size_H_x_ * scale_H_x_))
        return 2;
    const double inverse_H_x_H_y_ = -1.0/determinant_H_x_H_y_;
    const double inverse_pivot_H_x_ = inverse_H_x_H_y_*scale_H_y_;
    const double inverse_pivot_H_y_ = inverse_H_x_H_y_*scale_H_x_;
    const double inverse_cross_H_x_H_y_ = -inverse_H_x_H_y_*pivot_H_x_H_y_;
    const double w_E3_x_H_x_ = -l_E3_x_BDE_theta_*w_H_x_BDE_theta_;
    const double w_E3_x_H_y_ = -l_E3_x_BDE_theta_*w_H_y_BDE_theta_;
    const double l_E3_x_H_x_ = inverse_cross_H_x_H_y_*w_E3_x_H_y_ + inverse_pivot_H_x_*w_E3_x_H_x_;
    const double l_E3_x_H_y_ = inverse_cross_H_x_H_y_*w_E3_x_H_x_ + inverse_pivot_H_y_*w_E3_x_H_y_;
    const double w_E3_y_H_x_ = -l_E3_y_BDE_theta_*w_H_x_BDE_theta_;
    const double w_E3_y_H_y_ = -l_E3_y_BDE_theta_*w_H_y_BDE_theta_;
    const double l_E3_y_H_x_ = inverse_cross_H_x_H_y_*w_E3_y_H_y_ + inverse_pivot_H_x_*w_E3_y_H_x_;
    const double l_E3_y_H_y_ = inverse_cross_H_x_H_y_*w_E3_y_H_x_ + inverse_pivot_H_y_*w_E3_y_H_y_;
    const double l_OF_theta_EG_theta_ = dot_OF_EG_*p->inverse_tree_metric_EG_theta_;
    const double l_FE_theta_EG_theta_ = dot_FE_EG_*p->inverse_tree_metric_EG_theta_;
    const double l_G_x_EG_theta_ = -p->inverse_tree_metric_EG_theta_*span_EG_G_y_;
    const double l_G_y_EG_theta_ = p->inverse_tree_metric_EG_theta_*span_EG_G_x_;
    const double pivot_OF_theta_ = -dot_OF_EG_*l_OF_theta_EG_theta_ + p->tree_metric_OF_theta_;
    const double pivot_FE_theta_ = -dot_FE_EG_*l_FE_theta_EG_theta_ + p->tree_metric_FE_theta_;
    const double pivot_OF_theta_FE_theta_ = -dot_OF_EG_*l_FE_theta_EG_theta_ + dot_OF_FE_;
    const double determinant_OF_theta_FE_theta_ = pivot_FE_theta_*pivot_OF_theta_
        - (pivot_OF_theta_FE_theta_ * pivot_OF_theta_FE_theta_);
    const double inverse_OF_theta_FE_theta_ = 1.0/determinant_OF_theta_FE_theta_;
    const double inverse_pivot_OF_theta_ = inverse_OF_theta_FE_theta_*pivot_FE_theta_;
    const double inverse_pivot_FE_theta_ = inverse_OF_theta_FE_theta_*pivot_OF_theta_;
    const double inverse_cross_OF_theta_FE_theta_ = -inverse_OF_theta_FE_theta_*pivot_OF_theta_FE_theta_;
    const double w_G_x_OF_theta_ = -dot_OF_EG_*l_G_x_EG_theta_ - span_OF_F_y_;
    const double w_G_x_FE_theta_ = -dot_FE_EG_*l_G_x_EG_theta_ - span_FE_E_y_;
    const double l_G_x_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_x_FE_theta_
        + inverse_pivot_OF_theta_*w_G_x_OF_theta_;
    const double l_G_x_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_x_OF_theta_
        + inverse_pivot_FE_theta_*w_G_x_FE_theta_;
    const double w_G_y_OF_theta_ = -dot_OF_EG_*l_G_y_EG_theta_ + span_OF_F_x_;
    const double w_G_y_FE_theta_ = -dot_FE_EG_*l_G_y_EG_theta_ + span_FE_E_x_;
    const double l_G_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_y_FE_theta_
        + inverse_pivot_OF_theta_*w_G_y_OF_theta_;
    const double l_G_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_y_OF_theta_
        + inverse_pivot_FE_theta_*w_G_y_FE_theta_;
    const double l_E3_x_OF_theta_ = -inverse_cross_OF_theta_FE_theta_*span_FE_E_y_
        - inverse_pivot_OF_theta_*span_OF_F_y_;
    const double l_E3_x_FE_theta_ = -inverse_cross_OF_theta_FE_theta_*span_OF_F_y_
        - inverse_pivot_FE_theta_*span_FE_E_y_;
    const double l_E3_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*span_FE_E_x_
        + inverse_pivot_OF_theta_*span_OF_F_x_;
    const double l_E3_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*span_OF_F_x_
        + inverse_pivot_FE_theta_*span_FE_E_x_;
    const double scale_G_x_ = l_G_x_AG_theta_*span_AG_G_y_ - l_G_x_EG_theta_*span_EG_G_y_
        + l_G_x_FE_theta_*w_G_x_FE_theta_ + l_G_x_OF_theta_*w_G_x_OF_theta_;
    const double scale_G_y_ = -l_G_y_AG_theta_*span_AG_G_x_ + l_G_y_EG_theta_*span_EG_G_x_
        + l_G_y_FE_theta_*w_G_y_FE_theta_ + l_G_y_OF_theta_*w_G_y_OF_theta_;
    const double pivot_G_x_G_y_ = l_G_y_AG_theta_*span_AG_G_y_ - l_G_y_EG_theta_*span_EG_G_y_
        + l_G_y_FE_theta_*w_G_x_FE_theta_ + l_G_y_OF_theta_*w_G_x_OF_theta_;
    const double determinant_G_x_G_y_ = -(pivot_G_x_G_y_ * pivot_G_x_G_y_) + scale_G_x_*scale_G_y_;
    if (!(scale_G_x_ > 0.0 && scale_G_x_ < INFINITY))
        return 3;
    if (!(determinant_G_x_G_y_ > SINGULAR * scale_G_y_ * scale_G_x_))
        return 4;
    const double size_G_x_ = scale_G_x_ + scale_G_y_;
    if (!(scale_G_x_ > VANISHING * size_G_x_))
        return 3;
    if (!(determinant_G_x_G_y_ > VANISHING * size_G_x_ * scale_G_x_))
        return 4;
    const double inverse_G_x_G_y_ = -1.0/determinant_G_x_G_y_;
    const double inverse_pivot_G_x_ = inverse_G_x_G_y_*scale_G_y_;
    const double inverse_pivot_G_y_ = inverse_G_x_G_y_*scale_G_x_;
    const double inverse_cross_G_x_G_y_ = -inverse_G_x_G_y_*pivot_G_x_G_y_;
    const double w_E3_x_G_x_ = -l_E3_x_FE_theta_*w_G_x_FE_theta_ - l_E3_x_OF_theta_*w_G_x_OF_theta_;
    const double w_E3_x_G_y_ = -l_E3_x_FE_theta_*w_G_y_FE_theta_ - l_E3_x_OF_theta_*w_G_y_OF_theta_;
    const double l_E3_x_G_x_ = inverse_cross_G_x_G_y_*w_E3_x_G_y_ + inverse_pivot_G_x_*w_E3_x_G_x_;
    const double l_E3_x_G_y_ = inverse_cross_G_x_G_y_*w_E3_x_G_x_ + inverse_pivot_G_y_*w_E3_x_G_y_;
    const double w_E3_y_G_x_ = -l_E3_y_FE_theta_*w_G_x_FE_theta_ - l_E3_y_OF_theta_*w_G_x_OF_theta_;
    const double w_E3_y_G_y_ = -l_E3_y_FE_theta_*w_G_y_FE_theta_ - l_E3_y_OF_theta_*w_G_y_OF_theta_;
    const double l_E3_y_G_x_ = inverse_cross_G_x_G_y_*w_E3_y_G_y_ + inverse_pivot_G_x_*w_E3_y_G_x_;
    const double l_E3_y_G_y_ = inverse_cross_G_x_G_y_*w_E3_y_G_x_ + inverse_pivot_G_y_*w_E3_y_G_y_;
    const double scale_E3_x_ = l_E3_x_BDE_theta_*span_BDE_E_y_ - l_E3_x_FE_theta_*span_FE_E_y_
        - l_E3_x_OF_theta_*span_OF_F_y_;
    const double scale_E3_y_ = -l_E3_y_BDE_theta_*span_BDE_E_x_ + l_E3_y_FE_theta_*span_FE_E_x_
        + l_E3_y_OF_theta_*span_OF_F_x_;
    const double pivot_E3_x_ = l_E3_x_G_x_*w_E3_x_G_x_ + l_E3_x_G_y_*w_E3_x_G_y_ + l_E3_x_H_x_*w_E3_x_H_x_
        + l_E3_x_H_y_*w_E3_x_H_y_ + scale_E3_x_;
    const double pivot_E3_y_ = l_E3_y_G_x_*w_E3_y_G_x_ + l_E3_y_G_y_*w_E3_y_G_y_ + l_E3_y_H_x_*w_E3_y_H_x_
        + l_E3_y_H_y_*w_E3_y_H_y_ + scale_E3_y_;
    const double pivot_E3_x_E3_y_ = l_E3_y_BDE_theta_*span_BDE_E_y_ - l_E3_y_FE_theta_*span_FE_E_y_
        + l_E3_y_G_x_*w_E3_x_G_x_ + l_E3_y_G_y_*w_E3_x_G_y_ + l_E3_y_H_x_*w_E3_x_H_x_ + l_E3_y_H_y_*w_E3_x_H_y_
        - l_E3_y_OF_theta_*span_OF_F_y_;
    const double determinant_E3_x_E3_y_ = pivot_E3_x_*pivot_E3_y_ - (pivot_E3_x_E3_y_ * pivot_E3_x_E3_y_);
    if (!(pivot_E3_x_ > SINGULAR * scale_E3_x_))
        return 5;
    if (!(determinant_E3_x_E3_y_ > SINGULAR * scale_E3_y_ * pivot_E3_x_))
        return 6;
    const double size_E3_x_ = scale_E3_x_ + scale_E3_y_;
    if (!(pivot_E3_x_ > VANISHING * size_E3_x_))
        return 5;
    if (!(determinant_E3_x_E3_y_ > VANISHING * size_E3_x_ * pivot_E3_x_))
        return 6;
    const double inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const double inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*pivot_E3_y_;
    const double inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*pivot_E3_x_;
    const double inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;

    /* forward substitution */
    const double step_z_E3_x_ = -l_E3_x_G_x_*r_G_x_ - l_E3_x_G_y_*r_G_y_ - l_E3_x_H_x_*r_H_x_ - l_E3_x_H_y_*r_H_y_
        + r_E3_x_;
    const double step_z_E3_y_ = -l_E3_y_G_x_*r_G_x_ - l_E3_y_G_y_*r_G_y_ - l_E3_y_H_x_*r_H_x_ - l_E3_y_H_y_*r_H_y_
        + r_E3_y_;

    /* backward substitution */
    const double step_lambda_E3_y_ = inverse_cross_E3_x_E3_y_*step_z_E3_x_ + inverse_pivot_E3_y_*step_z_E3_y_;
    const double step_lambda_E3_x_ = inverse_cross_E3_x_E3_y_*step_z_E3_y_ + inverse_pivot_E3_x_*step_z_E3_x_;
    const double step_lambda_G_y_ = inverse_cross_G_x_G_y_*r_G_x_ + inverse_pivot_G_y_*r_G_y_
        - l_E3_x_G_y_*step_lambda_E3_x_ - l_E3_y_G_y_*step_lambda_E3_y_;
    const double step_lambda_G_x_ = inverse_cross_G_x_G_y_*r_G_y_ + inverse_pivot_G_x_*r_G_x_
        - l_E3_x_G_x_*step_lambda_E3_x_ - l_E3_y_G_x_*step_lambda_E3_y_;
    const double step_acceleration_FE_theta_ = -l_E3_x_FE_theta_*step_lambda_E3_x_ - l_E3_y_FE_theta_*step_lambda_E3_y_
        - l_G_x_FE_theta_*step_lambda_G_x_ - l_G_y_FE_theta_*step_lambda_G_y_;
    const double step_acceleration_OF_theta_ = -l_E3_x_OF_theta_*step_lambda_E3_x_ - l_E3_y_OF_theta_*step_lambda_E3_y_
        - l_G_x_OF_theta_*step_lambda_G_x_ - l_G_y_OF_theta_*step_lambda_G_y_;
    const double step_acceleration_EG_theta_ = -l_FE_theta_EG_theta_*step_acceleration_FE_theta_
        - l_G_x_EG_theta_*step_lambda_G_x_ - l_G_y_EG_theta_*step_lambda_G_y_
        - l_OF_theta_EG_theta_*step_acceleration_OF_theta_;
    const double step_lambda_H_y_ = inverse_cross_H_x_H_y_*r_H_x_ + inverse_pivot_H_y_*r_H_y_
        - l_E3_x_H_y_*step_lambda_E3_x_ - l_E3_y_H_y_*step_lambda_E3_y_;
    const double step_lambda_H_x_ = inverse_cross_H_x_H_y_*r_H_y_ + inverse_pivot_H_x_*r_H_x_
        - l_E3_x_H_x_*step_lambda_E3_x_ - l_E3_y_H_x_*step_lambda_E3_y_;
    const double step_acceleration_BDE_theta_ = -l_E3_x_BDE_theta_*step_lambda_E3_x_
        - l_E3_y_BDE_theta_*step_lambda_E3_y_ - l_H_x_BDE_theta_*step_lambda_H_x_ - l_H_y_BDE_theta_*step_lambda_H_y_;
    const double step_acceleration_HE_theta_ = -l_BDE_theta_HE_theta_*step_acceleration_BDE_theta_
        - l_H_x_HE_theta_*step_lambda_H_x_ - l_H_y_HE_theta_*step_lambda_H_y_;
    const double step_acceleration_AH_theta_ = -l_H_x_AH_theta_*step_lambda_H_x_ - l_H_y_AH_theta_*step_lambda_H_y_;
    const double step_acceleration_AG_theta_ = -l_G_x_AG_theta_*step_lambda_G_x_ - l_G_y_AG_theta_*step_lambda_G_y_;

    /* results */
    x[0] = step_acceleration_OF_theta_;
    x[1] = step_acceleration_BDE_theta_;
    x[2] = step_acceleration_AG_theta_;
    x[3] = step_acceleration_AH_theta_;
    x[4] = step_acceleration_FE_theta_;
    x[5] = step_acceleration_HE_theta_;
    x[6] = step_acceleration_EG_theta_;
    return 0;
}

/* Compute the multipliers of the loop closures from those of all constraint equations in absolute coordinates. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[16];
    closing[1] = + lambda[17];
    closing[2] = + lambda[18];
    closing[3] = + lambda[19];
    closing[4] = + lambda[10] + lambda[14];
    closing[5] = + lambda[11] + lambda[15];
}
