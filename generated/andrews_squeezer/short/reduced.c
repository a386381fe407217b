/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta = q[0];
    const double OF_omega = v[0];
    const double BDE_theta = q[1];
    const double BDE_omega = v[1];
    const double AG_theta = q[2];
    const double AG_omega = v[2];
    const double AH_theta = q[3];
    const double AH_omega = v[3];
    const double FE_theta = q[4];
    const double FE_omega = v[4];
    const double HE_theta = q[5];
    const double HE_omega = v[5];
    const double EG_theta = q[6];
    const double EG_omega = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_com_x = p->OF_com_span_x*cos_theta_OF;
    const double span_OF_com_y = p->OF_com_span_x*sin_theta_OF;
    const double OF_vx = -OF_omega*span_OF_com_y;
    const double OF_vy = OF_omega*span_OF_com_x;
    const double span_BDE_com_x = p->BDE_com_span_x*cos_theta_BDE - p->BDE_com_span_y*sin_theta_BDE;
    const double span_BDE_com_y = p->BDE_com_span_x*sin_theta_BDE + p->BDE_com_span_y*cos_theta_BDE;
    const double BDE_x = p->B_x + span_BDE_com_x;
    const double BDE_vx = -BDE_omega*span_BDE_com_y;
    const double BDE_y = p->B_y + span_BDE_com_y;
    const double BDE_vy = BDE_omega*span_BDE_com_x;
    const double span_AG_com_x = p->AG_com_span_x*cos_theta_AG - p->AG_com_span_y*sin_theta_AG;
    const double span_AG_com_y = p->AG_com_span_x*sin_theta_AG + p->AG_com_span_y*cos_theta_AG;
    const double AG_x = p->A_x + span_AG_com_x;
    const double AG_vx = -AG_omega*span_AG_com_y;
    const double AG_y = p->A_y + span_AG_com_y;
    const double AG_vy = AG_omega*span_AG_com_x;
    const double span_AH_com_x = p->AH_com_span_x*cos_theta_AH - p->AH_com_span_y*sin_theta_AH;
    const double span_AH_com_y = p->AH_com_span_x*sin_theta_AH + p->AH_com_span_y*cos_theta_AH;
    const double AH_x = p->A_x + span_AH_com_x;
    const double AH_vx = -AH_omega*span_AH_com_y;
    const double AH_y = p->A_y + span_AH_com_y;
    const double AH_vy = AH_omega*span_AH_com_x;
    const double span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const double OF_F_vx = -OF_omega*span_OF_F_y;
    const double OF_F_vy = OF_omega*span_OF_F_x;
    const double span_FE_com_x = p->FE_com_span_x*cos_theta_FE;
    const double span_FE_com_y = p->FE_com_span_x*sin_theta_FE;
    const double FE_x = span_FE_com_x + span_OF_F_x;
    const double FE_vx = -FE_omega*span_FE_com_y + OF_F_vx;
    const double FE_y = span_FE_com_y + span_OF_F_y;
    const double FE_vy = FE_omega*span_FE_com_x + OF_F_vy;
    const double span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const double BDE_E_x = p->B_x + span_BDE_E_x;
    const double BDE_E_vx = -BDE_omega*span_BDE_E_y;
    const double BDE_E_y = p->B_y + span_BDE_E_y;
    const double BDE_E_vy = BDE_omega*span_BDE_E_x;
    const double span_HE_com_x = p->HE_com_span_x*cos_theta_HE;
    const double span_HE_com_y = p->HE_com_span_x*sin_theta_HE;
    const double HE_x = BDE_E_x + span_HE_com_x;
    const double HE_vx = BDE_E_vx - HE_omega*span_HE_com_y;
    const double HE_y = BDE_E_y + span_HE_com_y;
    const double HE_vy = BDE_E_vy + HE_omega*span_HE_com_x;
    const double span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const double FE_E_x = span_FE_E_x + span_OF_F_x;
    const double FE_E_vx = -FE_omega*span_FE_E_y + OF_F_vx;
    const double FE_E_y = span_FE_E_y + span_OF_F_y;
    const double FE_E_vy = FE_omega*span_FE_E_x + OF_F_vy;
    const double span_EG_com_x = -p->EG_com_span_y*sin_theta_EG;
    const double span_EG_com_y = p->EG_com_span_y*cos_theta_EG;
    const double EG_x = FE_E_x + span_EG_com_x;
    const double EG_vx = -EG_omega*span_EG_com_y + FE_E_vx;
    const double EG_y = FE_E_y + span_EG_com_y;
    const double EG_vy = EG_omega*span_EG_com_x + FE_E_vy;

    /* bodies */
    all_q[0] = span_OF_com_x;
    all_v[0] = OF_vx;
    all_q[1] = span_OF_com_y;
    all_v[1] = OF_vy;
    all_q[2] = OF_theta;
    all_v[2] = OF_omega;
    all_q[3] = FE_x;
    all_v[3] = FE_vx;
    all_q[4] = FE_y;
    all_v[4] = FE_vy;
    all_q[5] = FE_theta;
    all_v[5] = FE_omega;
    all_q[6] = BDE_x;
    all_v[6] = BDE_vx;
    all_q[7] = BDE_y;
    all_v[7] = BDE_vy;
    all_q[8] = BDE_theta;
    all_v[8] = BDE_omega;
    all_q[9] = EG_x;
    all_v[9] = EG_vx;
    all_q[10] = EG_y;
    all_v[10] = EG_vy;
    all_q[11] = EG_theta;
    all_v[11] = EG_omega;
    all_q[12] = AG_x;
    all_v[12] = AG_vx;
    all_q[13] = AG_y;
    all_v[13] = AG_vy;
    all_q[14] = AG_theta;
    all_v[14] = AG_omega;
    all_q[15] = HE_x;
    all_v[15] = HE_vx;
    all_q[16] = HE_y;
    all_v[16] = HE_vy;
    all_q[17] = HE_theta;
    all_v[17] = HE_omega;
    all_q[18] = AH_x;
    all_v[18] = AH_vx;
    all_q[19] = AH_y;
    all_v[19] = AH_vy;
    all_q[20] = AH_theta;
    all_v[20] = AH_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double OF_theta = q[2];
    const double OF_omega = v[2];
    const double FE_theta = q[5];
    const double FE_omega = v[5];
    const double BDE_theta = q[8];
    const double BDE_omega = v[8];
    const double EG_theta = q[11];
    const double EG_omega = v[11];
    const double AG_theta = q[14];
    const double AG_omega = v[14];
    const double HE_theta = q[17];
    const double HE_omega = v[17];
    const double AH_theta = q[20];
    const double AH_omega = v[20];

    /* tree coordinates */
    s[0] = OF_theta;  /* OF */
    s_rate[0] = OF_omega;
    s[1] = BDE_theta;  /* BDE */
    s_rate[1] = BDE_omega;
    s[2] = AG_theta;  /* AG */
    s_rate[2] = AG_omega;
    s[3] = AH_theta;  /* AH */
    s_rate[3] = AH_omega;
    s[4] = FE_theta;  /* FE */
    s_rate[4] = FE_omega;
    s[5] = HE_theta;  /* HE */
    s_rate[5] = HE_omega;
    s[6] = EG_theta;  /* EG */
    s_rate[6] = EG_omega;
}

/*
 * Their second rates a, from absolute all_a.
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
    const double OF_theta = q[0];
    const double BDE_theta = q[1];
    const double AG_theta = q[2];
    const double AH_theta = q[3];
    const double FE_theta = q[4];
    const double HE_theta = q[5];
    const double EG_theta = q[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const double span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const double span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const double span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const double span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const double span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const double span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const double span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const double span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const double span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const double span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;

    /* rows */
    out[0] = -p->A_x - span_AG_G_x + span_EG_G_x + span_FE_E_x + span_OF_F_x;  /* G.x */
    out[1] = -p->A_y - span_AG_G_y + span_EG_G_y + span_FE_E_y + span_OF_F_y;  /* G.y */
    out[2] = -p->A_x + p->B_x - span_AH_H_x + span_BDE_E_x + span_HE_H_x;  /* H.x */
    out[3] = -p->A_y + p->B_y - span_AH_H_y + span_BDE_E_y + span_HE_H_y;  /* H.y */
    out[4] = -p->B_x - span_BDE_E_x + span_FE_E_x + span_OF_F_x;  /* E3.x */
    out[5] = -p->B_y - span_BDE_E_y + span_FE_E_y + span_OF_F_y;  /* E3.y */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta = q[0];
    const double OF_omega = v[0];
    const double BDE_theta = q[1];
    const double BDE_omega = v[1];
    const double AG_theta = q[2];
    const double AG_omega = v[2];
    const double AH_theta = q[3];
    const double AH_omega = v[3];
    const double FE_theta = q[4];
    const double FE_omega = v[4];
    const double HE_theta = q[5];
    const double HE_omega = v[5];
    const double EG_theta = q[6];
    const double EG_omega = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const double span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const double span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const double span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const double span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const double span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const double span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const double span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const double span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const double span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const double span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;

    /* rows */
    out[0] = AG_omega*span_AG_G_y - EG_omega*span_EG_G_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;  /* G.x */
    out[1] = -AG_omega*span_AG_G_x + EG_omega*span_EG_G_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;  /* G.y */
    out[2] = AH_omega*span_AH_H_y - BDE_omega*span_BDE_E_y - HE_omega*span_HE_H_y;  /* H.x */
    out[3] = -AH_omega*span_AH_H_x + BDE_omega*span_BDE_E_x + HE_omega*span_HE_H_x;  /* H.y */
    out[4] = BDE_omega*span_BDE_E_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;  /* E3.x */
    out[5] = -BDE_omega*span_BDE_E_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;  /* E3.y */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    /* coordinates, velocities, time */
    const double OF_theta = q[0];
    const double OF_omega = v[0];
    const double BDE_theta = q[1];
    const double BDE_omega = v[1];
    const double AG_theta = q[2];
    const double AG_omega = v[2];
    const double AH_theta = q[3];
    const double AH_omega = v[3];
    const double FE_theta = q[4];
    const double FE_omega = v[4];
    const double HE_theta = q[5];
    const double HE_omega = v[5];
    const double EG_theta = q[6];
    const double EG_omega = v[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const double span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const double span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const double span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const double span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const double span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const double span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const double span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const double span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const double span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const double span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;
    const double span_BDE_D_x = p->BDE_D_span_x*cos_theta_BDE - p->BDE_D_span_y*sin_theta_BDE;
    const double span_BDE_D_y = p->BDE_D_span_x*sin_theta_BDE + p->BDE_D_span_y*cos_theta_BDE;
    const double BDE_D_x = p->B_x + span_BDE_D_x;
    const double BDE_D_y = p->B_y + span_BDE_D_y;
    const double spring_span_x = BDE_D_x - p->C_x;
    const double spring_span_y = BDE_D_y - p->C_y;
    const double spring_length = sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const double spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;
    const double cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const double sin_FE_less_OF = -cos_theta_FE*sin_theta_OF + cos_theta_OF*sin_theta_FE;
    const double dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const double cross_OF_FE = p->inertia_OF_FE*sin_FE_less_OF;
    const double cos_EG_less_OF = cos_theta_EG*cos_theta_OF + sin_theta_EG*sin_theta_OF;
    const double sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const double dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const double cross_OF_EG = cos_EG_less_OF*p->twist_OF_EG;
    const double cos_EG_less_FE = cos_theta_EG*cos_theta_FE + sin_theta_EG*sin_theta_FE;
    const double sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const double dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const double cross_FE_EG = cos_EG_less_FE*p->twist_FE_EG;
    const double cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const double sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const double dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;
    const double cross_BDE_HE = cos_HE_less_BDE*p->twist_BDE_HE + p->inertia_BDE_HE*sin_HE_less_BDE;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_G_x = -(AG_omega * AG_omega)*span_AG_G_x + (EG_omega * EG_omega)*span_EG_G_x
        + (FE_omega * FE_omega)*span_FE_E_x + (OF_omega * OF_omega)*span_OF_F_x;
    const double rhs_G_y = -(AG_omega * AG_omega)*span_AG_G_y + (EG_omega * EG_omega)*span_EG_G_y
        + (FE_omega * FE_omega)*span_FE_E_y + (OF_omega * OF_omega)*span_OF_F_y;
    const double rhs_H_x = -(AH_omega * AH_omega)*span_AH_H_x + (BDE_omega * BDE_omega)*span_BDE_E_x
        + (HE_omega * HE_omega)*span_HE_H_x;
    const double rhs_H_y = -(AH_omega * AH_omega)*span_AH_H_y + (BDE_omega * BDE_omega)*span_BDE_E_y
        + (HE_omega * HE_omega)*span_HE_H_y;
    const double rhs_E3_x = -(BDE_omega * BDE_omega)*span_BDE_E_x + (FE_omega * FE_omega)*span_FE_E_x
        + (OF_omega * OF_omega)*span_OF_F_x;
    const double rhs_E3_y = -(BDE_omega * BDE_omega)*span_BDE_E_y + (FE_omega * FE_omega)*span_FE_E_y
        + (OF_omega * OF_omega)*span_OF_F_y;

    /* L D L^T of the KKT matrix */
    const double l_G_x__AG_theta = p->inverse_mass_AG_AG*span_AG_G_y;
    const double l_G_y__AG_theta = -p->inverse_mass_AG_AG*span_AG_G_x;
    const double l_H_x__AH_theta = p->inverse_mass_AH_AH*span_AH_H_y;
    const double l_H_y__AH_theta = -p->inverse_mass_AH_AH*span_AH_H_x;
    const double l_H_x__HE_theta = -p->inverse_mass_HE_HE*span_HE_H_y;
    const double l_H_y__HE_theta = p->inverse_mass_HE_HE*span_HE_H_x;
    const double l_BDE_theta__HE_theta = dot_BDE_HE*p->inverse_mass_HE_HE;
    const double scale_H_x = l_H_x__AH_theta*span_AH_H_y - l_H_x__HE_theta*span_HE_H_y;
    const double scale_H_y = -l_H_y__AH_theta*span_AH_H_x + l_H_y__HE_theta*span_HE_H_x;
    const double pivot_H_x__H_y = l_H_y__AH_theta*span_AH_H_y - l_H_y__HE_theta*span_HE_H_y;
    const double determinant_H_x__H_y = -(pivot_H_x__H_y * pivot_H_x__H_y) + scale_H_x*scale_H_y;
    if (!(scale_H_x > 0.0 && scale_H_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_H_x__H_y > EARLY * scale_H_y * scale_H_x)) {
        pivot = 2;
        goto dependent;
    }
    const double size_H_x = scale_H_x + scale_H_y;
    if (!(scale_H_x > memory->least_size * size_H_x)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_H_x__H_y > memory->least_size * size_H_x * scale_H_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_H_x__H_y = -1.0/determinant_H_x__H_y;
    const double inverse_pivot_H_x = inverse_H_x__H_y*scale_H_y;
    const double inverse_pivot_H_y = inverse_H_x__H_y*scale_H_x;
    const double inverse_cross_H_x__H_y = -inverse_H_x__H_y*pivot_H_x__H_y;
    const double w_BDE_theta__H_x = l_BDE_theta__HE_theta*span_HE_H_y - span_BDE_E_y;
    const double w_BDE_theta__H_y = -l_BDE_theta__HE_theta*span_HE_H_x + span_BDE_E_x;
    const double l_BDE_theta__H_x = inverse_cross_H_x__H_y*w_BDE_theta__H_y + inverse_pivot_H_x*w_BDE_theta__H_x;
    const double l_BDE_theta__H_y = inverse_cross_H_x__H_y*w_BDE_theta__H_x + inverse_pivot_H_y*w_BDE_theta__H_y;
    const double inverse_pivot_BDE_theta = 1.0/(-dot_BDE_HE*l_BDE_theta__HE_theta - l_BDE_theta__H_x*w_BDE_theta__H_x
        - l_BDE_theta__H_y*w_BDE_theta__H_y + p->mass_BDE_BDE);
    const double l_E3_x__BDE_theta = inverse_pivot_BDE_theta*span_BDE_E_y;
    const double l_E3_y__BDE_theta = -inverse_pivot_BDE_theta*span_BDE_E_x;
    const double l_G_x__EG_theta = -p->inverse_mass_EG_EG*span_EG_G_y;
    const double l_G_y__EG_theta = p->inverse_mass_EG_EG*span_EG_G_x;
    const double l_OF_theta__EG_theta = dot_OF_EG*p->inverse_mass_EG_EG;
    const double l_FE_theta__EG_theta = dot_FE_EG*p->inverse_mass_EG_EG;
    const double scale_G_x = l_G_x__AG_theta*span_AG_G_y - l_G_x__EG_theta*span_EG_G_y;
    const double scale_G_y = -l_G_y__AG_theta*span_AG_G_x + l_G_y__EG_theta*span_EG_G_x;
    const double pivot_G_x__G_y = l_G_y__AG_theta*span_AG_G_y - l_G_y__EG_theta*span_EG_G_y;
    const double determinant_G_x__G_y = -(pivot_G_x__G_y * pivot_G_x__G_y) + scale_G_x*scale_G_y;
    if (!(scale_G_x > 0.0 && scale_G_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_G_x__G_y > EARLY * scale_G_y * scale_G_x)) {
        pivot = 4;
        goto dependent;
    }
    const double size_G_x = scale_G_x + scale_G_y;
    if (!(scale_G_x > memory->least_size * size_G_x)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_G_x__G_y > memory->least_size * size_G_x * scale_G_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_G_x__G_y = -1.0/determinant_G_x__G_y;
    const double inverse_pivot_G_x = inverse_G_x__G_y*scale_G_y;
    const double inverse_pivot_G_y = inverse_G_x__G_y*scale_G_x;
    const double inverse_cross_G_x__G_y = -inverse_G_x__G_y*pivot_G_x__G_y;
    const double w_OF_theta__G_x = l_OF_theta__EG_theta*span_EG_G_y - span_OF_F_y;
    const double w_OF_theta__G_y = -l_OF_theta__EG_theta*span_EG_G_x + span_OF_F_x;
    const double l_OF_theta__G_x = inverse_cross_G_x__G_y*w_OF_theta__G_y + inverse_pivot_G_x*w_OF_theta__G_x;
    const double l_OF_theta__G_y = inverse_cross_G_x__G_y*w_OF_theta__G_x + inverse_pivot_G_y*w_OF_theta__G_y;
    const double w_FE_theta__G_x = l_FE_theta__EG_theta*span_EG_G_y - span_FE_E_y;
    const double w_FE_theta__G_y = -l_FE_theta__EG_theta*span_EG_G_x + span_FE_E_x;
    const double l_FE_theta__G_x = inverse_cross_G_x__G_y*w_FE_theta__G_y + inverse_pivot_G_x*w_FE_theta__G_x;
    const double l_FE_theta__G_y = inverse_cross_G_x__G_y*w_FE_theta__G_x + inverse_pivot_G_y*w_FE_theta__G_y;
    const double pivot_OF_theta = -dot_OF_EG*l_OF_theta__EG_theta - l_OF_theta__G_x*w_OF_theta__G_x
        - l_OF_theta__G_y*w_OF_theta__G_y + p->mass_OF_OF;
    const double pivot_FE_theta = -dot_FE_EG*l_FE_theta__EG_theta - l_FE_theta__G_x*w_FE_theta__G_x
        - l_FE_theta__G_y*w_FE_theta__G_y + p->mass_FE_FE;
    const double pivot_OF_theta__FE_theta = -dot_OF_EG*l_FE_theta__EG_theta + dot_OF_FE
        - l_FE_theta__G_x*w_OF_theta__G_x - l_FE_theta__G_y*w_OF_theta__G_y;
    const double determinant_OF_theta__FE_theta = pivot_FE_theta*pivot_OF_theta
        - (pivot_OF_theta__FE_theta * pivot_OF_theta__FE_theta);
    const double inverse_OF_theta__FE_theta = 1.0/determinant_OF_theta__FE_theta;
    const double inverse_pivot_OF_theta = inverse_OF_theta__FE_theta*pivot_FE_theta;
    const double inverse_pivot_FE_theta = inverse_OF_theta__FE_theta*pivot_OF_theta;
    const double inverse_cross_OF_theta__FE_theta = -inverse_OF_theta__FE_theta*pivot_OF_theta__FE_theta;
    const double l_E3_x__OF_theta = -inverse_cross_OF_theta__FE_theta*span_FE_E_y - inverse_pivot_OF_theta*span_OF_F_y;
    const double l_E3_x__FE_theta = -inverse_cross_OF_theta__FE_theta*span_OF_F_y - inverse_pivot_FE_theta*span_FE_E_y;
    const double l_E3_y__OF_theta = inverse_cross_OF_theta__FE_theta*span_FE_E_x + inverse_pivot_OF_theta*span_OF_F_x;
    const double l_E3_y__FE_theta = inverse_cross_OF_theta__FE_theta*span_OF_F_x + inverse_pivot_FE_theta*span_FE_E_x;
    const double scale_E3_x = l_E3_x__BDE_theta*span_BDE_E_y - l_E3_x__FE_theta*span_FE_E_y
        - l_E3_x__OF_theta*span_OF_F_y;
    const double scale_E3_y = -l_E3_y__BDE_theta*span_BDE_E_x + l_E3_y__FE_theta*span_FE_E_x
        + l_E3_y__OF_theta*span_OF_F_x;
    const double pivot_E3_x__E3_y = l_E3_y__BDE_theta*span_BDE_E_y - l_E3_y__FE_theta*span_FE_E_y
        - l_E3_y__OF_theta*span_OF_F_y;
    const double determinant_E3_x__E3_y = -(pivot_E3_x__E3_y * pivot_E3_x__E3_y) + scale_E3_x*scale_E3_y;
    if (!(scale_E3_x > 0.0 && scale_E3_x < INFINITY)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_E3_x__E3_y > memory->least * scale_E3_y * scale_E3_x)) {
        pivot = 6;
        goto dependent;
    }
    const double size_E3_x = scale_E3_x + scale_E3_y;
    if (!(scale_E3_x > memory->least_size * size_E3_x)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_E3_x__E3_y > memory->least_size * size_E3_x * scale_E3_x)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const double inverse_pivot_E3_x = inverse_E3_x__E3_y*scale_E3_y;
    const double inverse_pivot_E3_y = inverse_E3_x__E3_y*scale_E3_x;
    const double inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;

    /* forward substitution */
    const double z_HE_theta = -(BDE_omega * BDE_omega)*cross_BDE_HE;
    const double z_H_x = -l_H_x__HE_theta*z_HE_theta + rhs_H_x;
    const double z_H_y = -l_H_y__HE_theta*z_HE_theta + rhs_H_y;
    const double z_BDE_theta = (HE_omega * HE_omega)*cross_BDE_HE - l_BDE_theta__HE_theta*z_HE_theta
        - l_BDE_theta__H_x*z_H_x - l_BDE_theta__H_y*z_H_y - span_BDE_D_x*spring_pull*spring_span_y
        + span_BDE_D_y*spring_pull*spring_span_x;
    const double z_EG_theta = -(FE_omega * FE_omega)*cross_FE_EG - (OF_omega * OF_omega)*cross_OF_EG;
    const double z_G_x = -l_G_x__EG_theta*z_EG_theta + rhs_G_x;
    const double z_G_y = -l_G_y__EG_theta*z_EG_theta + rhs_G_y;
    const double z_OF_theta = (EG_omega * EG_omega)*cross_OF_EG + (FE_omega * FE_omega)*cross_OF_FE
        - l_OF_theta__EG_theta*z_EG_theta - l_OF_theta__G_x*z_G_x - l_OF_theta__G_y*z_G_y + p->motor_value;
    const double z_FE_theta = (EG_omega * EG_omega)*cross_FE_EG - (OF_omega * OF_omega)*cross_OF_FE
        - l_FE_theta__EG_theta*z_EG_theta - l_FE_theta__G_x*z_G_x - l_FE_theta__G_y*z_G_y;
    const double z_E3_x = -l_E3_x__BDE_theta*z_BDE_theta - l_E3_x__FE_theta*z_FE_theta - l_E3_x__OF_theta*z_OF_theta
        + rhs_E3_x;
    const double z_E3_y = -l_E3_y__BDE_theta*z_BDE_theta - l_E3_y__FE_theta*z_FE_theta - l_E3_y__OF_theta*z_OF_theta
        + rhs_E3_y;

    /* backward substitution */
    const double lambda_E3_y = inverse_cross_E3_x__E3_y*z_E3_x + inverse_pivot_E3_y*z_E3_y;
    const double lambda_E3_x = inverse_cross_E3_x__E3_y*z_E3_y + inverse_pivot_E3_x*z_E3_x;
    const double acceleration_FE_theta = inverse_cross_OF_theta__FE_theta*z_OF_theta
        + inverse_pivot_FE_theta*z_FE_theta - l_E3_x__FE_theta*lambda_E3_x - l_E3_y__FE_theta*lambda_E3_y;
    const double acceleration_OF_theta = inverse_cross_OF_theta__FE_theta*z_FE_theta
        + inverse_pivot_OF_theta*z_OF_theta - l_E3_x__OF_theta*lambda_E3_x - l_E3_y__OF_theta*lambda_E3_y;
    const double lambda_G_y = -acceleration_FE_theta*l_FE_theta__G_y - acceleration_OF_theta*l_OF_theta__G_y
        + inverse_cross_G_x__G_y*z_G_x + inverse_pivot_G_y*z_G_y;
    const double lambda_G_x = -acceleration_FE_theta*l_FE_theta__G_x - acceleration_OF_theta*l_OF_theta__G_x
        + inverse_cross_G_x__G_y*z_G_y + inverse_pivot_G_x*z_G_x;
    const double acceleration_EG_theta = -acceleration_FE_theta*l_FE_theta__EG_theta
        - acceleration_OF_theta*l_OF_theta__EG_theta + p->inverse_mass_EG_EG*z_EG_theta - l_G_x__EG_theta*lambda_G_x
        - l_G_y__EG_theta*lambda_G_y;
    const double acceleration_BDE_theta = inverse_pivot_BDE_theta*z_BDE_theta - l_E3_x__BDE_theta*lambda_E3_x
        - l_E3_y__BDE_theta*lambda_E3_y;
    const double lambda_H_y = -acceleration_BDE_theta*l_BDE_theta__H_y + inverse_cross_H_x__H_y*z_H_x
        + inverse_pivot_H_y*z_H_y;
    const double lambda_H_x = -acceleration_BDE_theta*l_BDE_theta__H_x + inverse_cross_H_x__H_y*z_H_y
        + inverse_pivot_H_x*z_H_x;
    const double acceleration_HE_theta = -acceleration_BDE_theta*l_BDE_theta__HE_theta
        + p->inverse_mass_HE_HE*z_HE_theta - l_H_x__HE_theta*lambda_H_x - l_H_y__HE_theta*lambda_H_y;
    const double acceleration_AH_theta = -l_H_x__AH_theta*lambda_H_x - l_H_y__AH_theta*lambda_H_y;
    const double acceleration_AG_theta = -l_G_x__AG_theta*lambda_G_x - l_G_y__AG_theta*lambda_G_y;

    /* results */
    a[0] = acceleration_OF_theta;
    a[1] = acceleration_BDE_theta;
    a[2] = acceleration_AG_theta;
    a[3] = acceleration_AH_theta;
    a[4] = acceleration_FE_theta;
    a[5] = acceleration_HE_theta;
    a[6] = acceleration_EG_theta;
    aside->lambda[0] = lambda_G_x;
    aside->lambda[1] = lambda_G_y;
    aside->lambda[2] = lambda_H_x;
    aside->lambda[3] = lambda_H_y;
    aside->lambda[4] = lambda_E3_x;
    aside->lambda[5] = lambda_E3_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = OF_omega*p->motor_value;
    aside->power[2] = 0.0;
    return pivot;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta = q[0];
    const double BDE_theta = q[1];
    const double AG_theta = q[2];
    const double AH_theta = q[3];
    const double FE_theta = q[4];
    const double HE_theta = q[5];
    const double EG_theta = q[6];

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const double span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const double span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const double span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const double span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const double span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const double span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const double span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const double span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const double span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const double span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;
    const double cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const double dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const double sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const double dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const double sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const double dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const double cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const double sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const double dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;

    /* right-hand side */
    const double r_G_x = r[0];
    const double r_G_y = r[1];
    const double r_H_x = r[2];
    const double r_H_y = r[3];
    const double r_E3_x = r[4];
    const double r_E3_y = r[5];

    /* L D L^T of the KKT matrix */
    const double l_G_x__AG_theta = p->inverse_mass_AG_AG*span_AG_G_y;
    const double l_G_y__AG_theta = -p->inverse_mass_AG_AG*span_AG_G_x;
    const double l_H_x__AH_theta = p->inverse_mass_AH_AH*span_AH_H_y;
    const double l_H_y__AH_theta = -p->inverse_mass_AH_AH*span_AH_H_x;
    const double l_BDE_theta__HE_theta = dot_BDE_HE*p->inverse_mass_HE_HE;
    const double l_H_x__HE_theta = -p->inverse_mass_HE_HE*span_HE_H_y;
    const double l_H_y__HE_theta = p->inverse_mass_HE_HE*span_HE_H_x;
    const double inverse_pivot_BDE_theta = 1.0/(-dot_BDE_HE*l_BDE_theta__HE_theta + p->mass_BDE_BDE);
    const double w_H_x__BDE_theta = -dot_BDE_HE*l_H_x__HE_theta - span_BDE_E_y;
    const double l_H_x__BDE_theta = inverse_pivot_BDE_theta*w_H_x__BDE_theta;
    const double w_H_y__BDE_theta = -dot_BDE_HE*l_H_y__HE_theta + span_BDE_E_x;
    const double l_H_y__BDE_theta = inverse_pivot_BDE_theta*w_H_y__BDE_theta;
    const double l_E3_x__BDE_theta = inverse_pivot_BDE_theta*span_BDE_E_y;
    const double l_E3_y__BDE_theta = -inverse_pivot_BDE_theta*span_BDE_E_x;
    const double scale_H_x = l_H_x__AH_theta*span_AH_H_y + l_H_x__BDE_theta*w_H_x__BDE_theta
        - l_H_x__HE_theta*span_HE_H_y;
    const double scale_H_y = -l_H_y__AH_theta*span_AH_H_x + l_H_y__BDE_theta*w_H_y__BDE_theta
        + l_H_y__HE_theta*span_HE_H_x;
    const double pivot_H_x__H_y = l_H_y__AH_theta*span_AH_H_y + l_H_y__BDE_theta*w_H_x__BDE_theta
        - l_H_y__HE_theta*span_HE_H_y;
    const double determinant_H_x__H_y = -(pivot_H_x__H_y * pivot_H_x__H_y) + scale_H_x*scale_H_y;
    if (!(scale_H_x > 0.0 && scale_H_x < INFINITY))
        return 1;
    if (!(determinant_H_x__H_y > SINGULAR * scale_H_y * scale_H_x))
        return 2;
    const double size_H_x = scale_H_x + scale_H_y;
    if (!(scale_H_x > VANISHING * size_H_x))
        return 1;
    if (!(determinant_H_x__H_y > VANISHING * size_H_x * scale_H_x))
        return 2;
    const double inverse_H_x__H_y = -1.0/determinant_H_x__H_y;
    const double inverse_pivot_H_x = inverse_H_x__H_y*scale_H_y;
    const double inverse_pivot_H_y = inverse_H_x__H_y*scale_H_x;
    const double inverse_cross_H_x__H_y = -inverse_H_x__H_y*pivot_H_x__H_y;
    const double w_E3_x__H_x = -l_E3_x__BDE_theta*w_H_x__BDE_theta;
    const double w_E3_x__H_y = -l_E3_x__BDE_theta*w_H_y__BDE_theta;
    const double l_E3_x__H_x = inverse_cross_H_x__H_y*w_E3_x__H_y + inverse_pivot_H_x*w_E3_x__H_x;
    const double l_E3_x__H_y = inverse_cross_H_x__H_y*w_E3_x__H_x + inverse_pivot_H_y*w_E3_x__H_y;
    const double w_E3_y__H_x = -l_E3_y__BDE_theta*w_H_x__BDE_theta;
    const double w_E3_y__H_y = -l_E3_y__BDE_theta*w_H_y__BDE_theta;
    const double l_E3_y__H_x = inverse_cross_H_x__H_y*w_E3_y__H_y + inverse_pivot_H_x*w_E3_y__H_x;
    const double l_E3_y__H_y = inverse_cross_H_x__H_y*w_E3_y__H_x + inverse_pivot_H_y*w_E3_y__H_y;
    const double l_OF_theta__EG_theta = dot_OF_EG*p->inverse_mass_EG_EG;
    const double l_FE_theta__EG_theta = dot_FE_EG*p->inverse_mass_EG_EG;
    const double l_G_x__EG_theta = -p->inverse_mass_EG_EG*span_EG_G_y;
    const double l_G_y__EG_theta = p->inverse_mass_EG_EG*span_EG_G_x;
    const double pivot_OF_theta = -dot_OF_EG*l_OF_theta__EG_theta + p->mass_OF_OF;
    const double pivot_FE_theta = -dot_FE_EG*l_FE_theta__EG_theta + p->mass_FE_FE;
    const double pivot_OF_theta__FE_theta = -dot_OF_EG*l_FE_theta__EG_theta + dot_OF_FE;
    const double determinant_OF_theta__FE_theta = pivot_FE_theta*pivot_OF_theta
        - (pivot_OF_theta__FE_theta * pivot_OF_theta__FE_theta);
    const double inverse_OF_theta__FE_theta = 1.0/determinant_OF_theta__FE_theta;
    const double inverse_pivot_OF_theta = inverse_OF_theta__FE_theta*pivot_FE_theta;
    const double inverse_pivot_FE_theta = inverse_OF_theta__FE_theta*pivot_OF_theta;
    const double inverse_cross_OF_theta__FE_theta = -inverse_OF_theta__FE_theta*pivot_OF_theta__FE_theta;
    const double w_G_x__OF_theta = -dot_OF_EG*l_G_x__EG_theta - span_OF_F_y;
    const double w_G_x__FE_theta = -dot_FE_EG*l_G_x__EG_theta - span_FE_E_y;
    const double l_G_x__OF_theta = inverse_cross_OF_theta__FE_theta*w_G_x__FE_theta
        + inverse_pivot_OF_theta*w_G_x__OF_theta;
    const double l_G_x__FE_theta = inverse_cross_OF_theta__FE_theta*w_G_x__OF_theta
        + inverse_pivot_FE_theta*w_G_x__FE_theta;
    const double w_G_y__OF_theta = -dot_OF_EG*l_G_y__EG_theta + span_OF_F_x;
    const double w_G_y__FE_theta = -dot_FE_EG*l_G_y__EG_theta + span_FE_E_x;
    const double l_G_y__OF_theta = inverse_cross_OF_theta__FE_theta*w_G_y__FE_theta
        + inverse_pivot_OF_theta*w_G_y__OF_theta;
    const double l_G_y__FE_theta = inverse_cross_OF_theta__FE_theta*w_G_y__OF_theta
        + inverse_pivot_FE_theta*w_G_y__FE_theta;
    const double l_E3_x__OF_theta = -inverse_cross_OF_theta__FE_theta*span_FE_E_y - inverse_pivot_OF_theta*span_OF_F_y;
    const double l_E3_x__FE_theta = -inverse_cross_OF_theta__FE_theta*span_OF_F_y - inverse_pivot_FE_theta*span_FE_E_y;
    const double l_E3_y__OF_theta = inverse_cross_OF_theta__FE_theta*span_FE_E_x + inverse_pivot_OF_theta*span_OF_F_x;
    const double l_E3_y__FE_theta = inverse_cross_OF_theta__FE_theta*span_OF_F_x + inverse_pivot_FE_theta*span_FE_E_x;
    const double scale_G_x = l_G_x__AG_theta*span_AG_G_y - l_G_x__EG_theta*span_EG_G_y
        + l_G_x__FE_theta*w_G_x__FE_theta + l_G_x__OF_theta*w_G_x__OF_theta;
    const double scale_G_y = -l_G_y__AG_theta*span_AG_G_x + l_G_y__EG_theta*span_EG_G_x
        + l_G_y__FE_theta*w_G_y__FE_theta + l_G_y__OF_theta*w_G_y__OF_theta;
    const double pivot_G_x__G_y = l_G_y__AG_theta*span_AG_G_y - l_G_y__EG_theta*span_EG_G_y
        + l_G_y__FE_theta*w_G_x__FE_theta + l_G_y__OF_theta*w_G_x__OF_theta;
    const double determinant_G_x__G_y = -(pivot_G_x__G_y * pivot_G_x__G_y) + scale_G_x*scale_G_y;
    if (!(scale_G_x > 0.0 && scale_G_x < INFINITY))
        return 3;
    if (!(determinant_G_x__G_y > SINGULAR * scale_G_y * scale_G_x))
        return 4;
    const double size_G_x = scale_G_x + scale_G_y;
    if (!(scale_G_x > VANISHING * size_G_x))
        return 3;
    if (!(determinant_G_x__G_y > VANISHING * size_G_x * scale_G_x))
        return 4;
    const double inverse_G_x__G_y = -1.0/determinant_G_x__G_y;
    const double inverse_pivot_G_x = inverse_G_x__G_y*scale_G_y;
    const double inverse_pivot_G_y = inverse_G_x__G_y*scale_G_x;
    const double inverse_cross_G_x__G_y = -inverse_G_x__G_y*pivot_G_x__G_y;
    const double w_E3_x__G_x = -l_E3_x__FE_theta*w_G_x__FE_theta - l_E3_x__OF_theta*w_G_x__OF_theta;
    const double w_E3_x__G_y = -l_E3_x__FE_theta*w_G_y__FE_theta - l_E3_x__OF_theta*w_G_y__OF_theta;
    const double l_E3_x__G_x = inverse_cross_G_x__G_y*w_E3_x__G_y + inverse_pivot_G_x*w_E3_x__G_x;
    const double l_E3_x__G_y = inverse_cross_G_x__G_y*w_E3_x__G_x + inverse_pivot_G_y*w_E3_x__G_y;
    const double w_E3_y__G_x = -l_E3_y__FE_theta*w_G_x__FE_theta - l_E3_y__OF_theta*w_G_x__OF_theta;
    const double w_E3_y__G_y = -l_E3_y__FE_theta*w_G_y__FE_theta - l_E3_y__OF_theta*w_G_y__OF_theta;
    const double l_E3_y__G_x = inverse_cross_G_x__G_y*w_E3_y__G_y + inverse_pivot_G_x*w_E3_y__G_x;
    const double l_E3_y__G_y = inverse_cross_G_x__G_y*w_E3_y__G_x + inverse_pivot_G_y*w_E3_y__G_y;
    const double scale_E3_x = l_E3_x__BDE_theta*span_BDE_E_y - l_E3_x__FE_theta*span_FE_E_y
        - l_E3_x__OF_theta*span_OF_F_y;
    const double scale_E3_y = -l_E3_y__BDE_theta*span_BDE_E_x + l_E3_y__FE_theta*span_FE_E_x
        + l_E3_y__OF_theta*span_OF_F_x;
    const double pivot_E3_x = l_E3_x__G_x*w_E3_x__G_x + l_E3_x__G_y*w_E3_x__G_y + l_E3_x__H_x*w_E3_x__H_x
        + l_E3_x__H_y*w_E3_x__H_y + scale_E3_x;
    const double pivot_E3_y = l_E3_y__G_x*w_E3_y__G_x + l_E3_y__G_y*w_E3_y__G_y + l_E3_y__H_x*w_E3_y__H_x
        + l_E3_y__H_y*w_E3_y__H_y + scale_E3_y;
    const double pivot_E3_x__E3_y = l_E3_y__BDE_theta*span_BDE_E_y - l_E3_y__FE_theta*span_FE_E_y
        + l_E3_y__G_x*w_E3_x__G_x + l_E3_y__G_y*w_E3_x__G_y + l_E3_y__H_x*w_E3_x__H_x + l_E3_y__H_y*w_E3_x__H_y
        - l_E3_y__OF_theta*span_OF_F_y;
    const double determinant_E3_x__E3_y = pivot_E3_x*pivot_E3_y - (pivot_E3_x__E3_y * pivot_E3_x__E3_y);
    if (!(pivot_E3_x > SINGULAR * scale_E3_x))
        return 5;
    if (!(determinant_E3_x__E3_y > SINGULAR * scale_E3_y * pivot_E3_x))
        return 6;
    const double size_E3_x = scale_E3_x + scale_E3_y;
    if (!(pivot_E3_x > VANISHING * size_E3_x))
        return 5;
    if (!(determinant_E3_x__E3_y > VANISHING * size_E3_x * pivot_E3_x))
        return 6;
    const double inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const double inverse_pivot_E3_x = inverse_E3_x__E3_y*pivot_E3_y;
    const double inverse_pivot_E3_y = inverse_E3_x__E3_y*pivot_E3_x;
    const double inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;

    /* forward substitution */
    const double step_z_E3_x = -l_E3_x__G_x*r_G_x - l_E3_x__G_y*r_G_y - l_E3_x__H_x*r_H_x - l_E3_x__H_y*r_H_y + r_E3_x;
    const double step_z_E3_y = -l_E3_y__G_x*r_G_x - l_E3_y__G_y*r_G_y - l_E3_y__H_x*r_H_x - l_E3_y__H_y*r_H_y + r_E3_y;

    /* backward substitution */
    const double step_lambda_E3_y = inverse_cross_E3_x__E3_y*step_z_E3_x + inverse_pivot_E3_y*step_z_E3_y;
    const double step_lambda_E3_x = inverse_cross_E3_x__E3_y*step_z_E3_y + inverse_pivot_E3_x*step_z_E3_x;
    const double step_lambda_G_y = inverse_cross_G_x__G_y*r_G_x + inverse_pivot_G_y*r_G_y
        - l_E3_x__G_y*step_lambda_E3_x - l_E3_y__G_y*step_lambda_E3_y;
    const double step_lambda_G_x = inverse_cross_G_x__G_y*r_G_y + inverse_pivot_G_x*r_G_x
        - l_E3_x__G_x*step_lambda_E3_x - l_E3_y__G_x*step_lambda_E3_y;
    const double step_acceleration_FE_theta = -l_E3_x__FE_theta*step_lambda_E3_x - l_E3_y__FE_theta*step_lambda_E3_y
        - l_G_x__FE_theta*step_lambda_G_x - l_G_y__FE_theta*step_lambda_G_y;
    const double step_acceleration_OF_theta = -l_E3_x__OF_theta*step_lambda_E3_x - l_E3_y__OF_theta*step_lambda_E3_y
        - l_G_x__OF_theta*step_lambda_G_x - l_G_y__OF_theta*step_lambda_G_y;
    const double step_acceleration_EG_theta = -l_FE_theta__EG_theta*step_acceleration_FE_theta
        - l_G_x__EG_theta*step_lambda_G_x - l_G_y__EG_theta*step_lambda_G_y
        - l_OF_theta__EG_theta*step_acceleration_OF_theta;
    const double step_lambda_H_y = inverse_cross_H_x__H_y*r_H_x + inverse_pivot_H_y*r_H_y
        - l_E3_x__H_y*step_lambda_E3_x - l_E3_y__H_y*step_lambda_E3_y;
    const double step_lambda_H_x = inverse_cross_H_x__H_y*r_H_y + inverse_pivot_H_x*r_H_x
        - l_E3_x__H_x*step_lambda_E3_x - l_E3_y__H_x*step_lambda_E3_y;
    const double step_acceleration_BDE_theta = -l_E3_x__BDE_theta*step_lambda_E3_x - l_E3_y__BDE_theta*step_lambda_E3_y
        - l_H_x__BDE_theta*step_lambda_H_x - l_H_y__BDE_theta*step_lambda_H_y;
    const double step_acceleration_HE_theta = -l_BDE_theta__HE_theta*step_acceleration_BDE_theta
        - l_H_x__HE_theta*step_lambda_H_x - l_H_y__HE_theta*step_lambda_H_y;
    const double step_acceleration_AH_theta = -l_H_x__AH_theta*step_lambda_H_x - l_H_y__AH_theta*step_lambda_H_y;
    const double step_acceleration_AG_theta = -l_G_x__AG_theta*step_lambda_G_x - l_G_y__AG_theta*step_lambda_G_y;

    /* results */
    x[0] = step_acceleration_OF_theta;
    x[1] = step_acceleration_BDE_theta;
    x[2] = step_acceleration_AG_theta;
    x[3] = step_acceleration_AH_theta;
    x[4] = step_acceleration_FE_theta;
    x[5] = step_acceleration_HE_theta;
    x[6] = step_acceleration_EG_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
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
