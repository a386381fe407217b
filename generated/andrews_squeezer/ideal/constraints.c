/*
 * The diagonal of M (n).
 */
static void mass_matrix(const Parameters *p, double *m)
{
    /* parameters */
    const double OF_mass = p->OF_mass;
    const double OF_inertia = p->OF_inertia;
    const double FE_mass = p->FE_mass;
    const double FE_inertia = p->FE_inertia;
    const double BDE_mass = p->BDE_mass;
    const double BDE_inertia = p->BDE_inertia;
    const double EG_mass = p->EG_mass;
    const double EG_inertia = p->EG_inertia;
    const double AG_mass = p->AG_mass;
    const double AG_inertia = p->AG_inertia;
    const double HE_mass = p->HE_mass;
    const double HE_inertia = p->HE_inertia;
    const double AH_mass = p->AH_mass;
    const double AH_inertia = p->AH_inertia;

    /* M */
    m[0] = OF_mass;
    m[1] = OF_mass;
    m[2] = OF_inertia;
    m[3] = FE_mass;
    m[4] = FE_mass;
    m[5] = FE_inertia;
    m[6] = BDE_mass;
    m[7] = BDE_mass;
    m[8] = BDE_inertia;
    m[9] = EG_mass;
    m[10] = EG_mass;
    m[11] = EG_inertia;
    m[12] = AG_mass;
    m[13] = AG_mass;
    m[14] = AG_inertia;
    m[15] = HE_mass;
    m[16] = HE_mass;
    m[17] = HE_inertia;
    m[18] = AH_mass;
    m[19] = AH_mass;
    m[20] = AH_inertia;
}
/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
static void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_x = q[0];
    const double OF_y = q[1];
    const double OF_theta = q[2];
    const double FE_x = q[3];
    const double FE_y = q[4];
    const double FE_theta = q[5];
    const double BDE_x = q[6];
    const double BDE_y = q[7];
    const double BDE_theta = q[8];
    const double EG_x = q[9];
    const double EG_y = q[10];
    const double EG_theta = q[11];
    const double AG_x = q[12];
    const double AG_y = q[13];
    const double AG_theta = q[14];
    const double HE_x = q[15];
    const double HE_y = q[16];
    const double HE_theta = q[17];
    const double AH_x = q[18];
    const double AH_y = q[19];
    const double AH_theta = q[20];

    /* parameters */
    const double OF_points_O_x = p->OF_points_O_x;
    const double OF_points_F_x = p->OF_points_F_x;
    const double FE_points_E_x = p->FE_points_E_x;
    const double FE_points_F_x = p->FE_points_F_x;
    const double BDE_points_B_x = p->BDE_points_B_x;
    const double BDE_points_B_y = p->BDE_points_B_y;
    const double BDE_points_E_x = p->BDE_points_E_x;
    const double BDE_points_E_y = p->BDE_points_E_y;
    const double EG_points_G_y = p->EG_points_G_y;
    const double EG_points_E_y = p->EG_points_E_y;
    const double AG_points_A_x = p->AG_points_A_x;
    const double AG_points_A_y = p->AG_points_A_y;
    const double AG_points_G_x = p->AG_points_G_x;
    const double AG_points_G_y = p->AG_points_G_y;
    const double HE_points_H_x = p->HE_points_H_x;
    const double HE_points_E_x = p->HE_points_E_x;
    const double AH_points_A_x = p->AH_points_A_x;
    const double AH_points_A_y = p->AH_points_A_y;
    const double AH_points_H_x = p->AH_points_H_x;
    const double AH_points_H_y = p->AH_points_H_y;
    const double B_x = p->B_x;
    const double B_y = p->B_y;
    const double A_x = p->A_x;
    const double A_y = p->A_y;

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = BDE_points_B_x*cos_theta_BDE - BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = BDE_points_B_x*sin_theta_BDE + BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = AG_points_A_x*cos_theta_AG - AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = AG_points_A_x*sin_theta_AG + AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = AH_points_A_x*cos_theta_AH - AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = AH_points_A_x*sin_theta_AH + AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = BDE_points_E_x*cos_theta_BDE - BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = BDE_points_E_x*sin_theta_BDE + BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = AG_points_G_x*cos_theta_AG - AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = AG_points_G_x*sin_theta_AG + AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = AH_points_H_x*cos_theta_AH - AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = AH_points_H_x*sin_theta_AH + AH_points_H_y*cos_theta_AH;

    /* rows */
    phi[0] = -OF_x - arm_OF_O_x;  /* O.x */
    phi[1] = -OF_y - arm_OF_O_y;  /* O.y */
    phi[2] = -BDE_x + B_x - arm_BDE_B_x;  /* B.x */
    phi[3] = -BDE_y + B_y - arm_BDE_B_y;  /* B.y */
    phi[4] = -AG_x + A_x - arm_AG_A_x;  /* A5.x */
    phi[5] = -AG_y + A_y - arm_AG_A_y;  /* A5.y */
    phi[6] = -AH_x + A_x - arm_AH_A_x;  /* A7.x */
    phi[7] = -AH_y + A_y - arm_AH_A_y;  /* A7.y */
    phi[8] = -FE_x + OF_x - arm_FE_F_x + arm_OF_F_x;  /* F.x */
    phi[9] = -FE_y + OF_y - arm_FE_F_y + arm_OF_F_y;  /* F.y */
    phi[10] = -BDE_x + FE_x - arm_BDE_E_x + arm_FE_E_x;  /* E3.x */
    phi[11] = -BDE_y + FE_y - arm_BDE_E_y + arm_FE_E_y;  /* E3.y */
    phi[12] = -EG_x + FE_x - arm_EG_E_x + arm_FE_E_x;  /* E4.x */
    phi[13] = -EG_y + FE_y - arm_EG_E_y + arm_FE_E_y;  /* E4.y */
    phi[14] = FE_x - HE_x + arm_FE_E_x - arm_HE_E_x;  /* E6.x */
    phi[15] = FE_y - HE_y + arm_FE_E_y - arm_HE_E_y;  /* E6.y */
    phi[16] = -AG_x + EG_x - arm_AG_G_x + arm_EG_G_x;  /* G.x */
    phi[17] = -AG_y + EG_y - arm_AG_G_y + arm_EG_G_y;  /* G.y */
    phi[18] = -AH_x + HE_x - arm_AH_H_x + arm_HE_H_x;  /* H.x */
    phi[19] = -AH_y + HE_y - arm_AH_H_y + arm_HE_H_y;  /* H.y */
}
/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
static void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta = q[2];
    const double FE_theta = q[5];
    const double BDE_theta = q[8];
    const double EG_theta = q[11];
    const double AG_theta = q[14];
    const double HE_theta = q[17];
    const double AH_theta = q[20];

    /* parameters */
    const double OF_points_O_x = p->OF_points_O_x;
    const double OF_points_F_x = p->OF_points_F_x;
    const double FE_points_E_x = p->FE_points_E_x;
    const double FE_points_F_x = p->FE_points_F_x;
    const double BDE_points_B_x = p->BDE_points_B_x;
    const double BDE_points_B_y = p->BDE_points_B_y;
    const double BDE_points_E_x = p->BDE_points_E_x;
    const double BDE_points_E_y = p->BDE_points_E_y;
    const double EG_points_G_y = p->EG_points_G_y;
    const double EG_points_E_y = p->EG_points_E_y;
    const double AG_points_A_x = p->AG_points_A_x;
    const double AG_points_A_y = p->AG_points_A_y;
    const double AG_points_G_x = p->AG_points_G_x;
    const double AG_points_G_y = p->AG_points_G_y;
    const double HE_points_H_x = p->HE_points_H_x;
    const double HE_points_E_x = p->HE_points_E_x;
    const double AH_points_A_x = p->AH_points_A_x;
    const double AH_points_A_y = p->AH_points_A_y;
    const double AH_points_H_x = p->AH_points_H_x;
    const double AH_points_H_y = p->AH_points_H_y;

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = BDE_points_B_x*cos_theta_BDE - BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = BDE_points_B_x*sin_theta_BDE + BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = AG_points_A_x*cos_theta_AG - AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = AG_points_A_x*sin_theta_AG + AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = AH_points_A_x*cos_theta_AH - AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = AH_points_A_x*sin_theta_AH + AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = BDE_points_E_x*cos_theta_BDE - BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = BDE_points_E_x*sin_theta_BDE + BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = AG_points_G_x*cos_theta_AG - AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = AG_points_G_x*sin_theta_AG + AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = AH_points_H_x*cos_theta_AH - AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = AH_points_H_x*sin_theta_AH + AH_points_H_y*cos_theta_AH;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d OF_x */
    phi_q[2] = arm_OF_O_y;  /* d O.x / d OF_theta */
    phi_q[22] = -1.0;  /* d O.y / d OF_y */
    phi_q[23] = -arm_OF_O_x;  /* d O.y / d OF_theta */
    phi_q[48] = -1.0;  /* d B.x / d BDE_x */
    phi_q[50] = arm_BDE_B_y;  /* d B.x / d BDE_theta */
    phi_q[70] = -1.0;  /* d B.y / d BDE_y */
    phi_q[71] = -arm_BDE_B_x;  /* d B.y / d BDE_theta */
    phi_q[96] = -1.0;  /* d A5.x / d AG_x */
    phi_q[98] = arm_AG_A_y;  /* d A5.x / d AG_theta */
    phi_q[118] = -1.0;  /* d A5.y / d AG_y */
    phi_q[119] = -arm_AG_A_x;  /* d A5.y / d AG_theta */
    phi_q[144] = -1.0;  /* d A7.x / d AH_x */
    phi_q[146] = arm_AH_A_y;  /* d A7.x / d AH_theta */
    phi_q[166] = -1.0;  /* d A7.y / d AH_y */
    phi_q[167] = -arm_AH_A_x;  /* d A7.y / d AH_theta */
    phi_q[168] = 1.0;  /* d F.x / d OF_x */
    phi_q[170] = -arm_OF_F_y;  /* d F.x / d OF_theta */
    phi_q[171] = -1.0;  /* d F.x / d FE_x */
    phi_q[173] = arm_FE_F_y;  /* d F.x / d FE_theta */
    phi_q[190] = 1.0;  /* d F.y / d OF_y */
    phi_q[191] = arm_OF_F_x;  /* d F.y / d OF_theta */
    phi_q[193] = -1.0;  /* d F.y / d FE_y */
    phi_q[194] = -arm_FE_F_x;  /* d F.y / d FE_theta */
    phi_q[213] = 1.0;  /* d E3.x / d FE_x */
    phi_q[215] = -arm_FE_E_y;  /* d E3.x / d FE_theta */
    phi_q[216] = -1.0;  /* d E3.x / d BDE_x */
    phi_q[218] = arm_BDE_E_y;  /* d E3.x / d BDE_theta */
    phi_q[235] = 1.0;  /* d E3.y / d FE_y */
    phi_q[236] = arm_FE_E_x;  /* d E3.y / d FE_theta */
    phi_q[238] = -1.0;  /* d E3.y / d BDE_y */
    phi_q[239] = -arm_BDE_E_x;  /* d E3.y / d BDE_theta */
    phi_q[255] = 1.0;  /* d E4.x / d FE_x */
    phi_q[257] = -arm_FE_E_y;  /* d E4.x / d FE_theta */
    phi_q[261] = -1.0;  /* d E4.x / d EG_x */
    phi_q[263] = arm_EG_E_y;  /* d E4.x / d EG_theta */
    phi_q[277] = 1.0;  /* d E4.y / d FE_y */
    phi_q[278] = arm_FE_E_x;  /* d E4.y / d FE_theta */
    phi_q[283] = -1.0;  /* d E4.y / d EG_y */
    phi_q[284] = -arm_EG_E_x;  /* d E4.y / d EG_theta */
    phi_q[297] = 1.0;  /* d E6.x / d FE_x */
    phi_q[299] = -arm_FE_E_y;  /* d E6.x / d FE_theta */
    phi_q[309] = -1.0;  /* d E6.x / d HE_x */
    phi_q[311] = arm_HE_E_y;  /* d E6.x / d HE_theta */
    phi_q[319] = 1.0;  /* d E6.y / d FE_y */
    phi_q[320] = arm_FE_E_x;  /* d E6.y / d FE_theta */
    phi_q[331] = -1.0;  /* d E6.y / d HE_y */
    phi_q[332] = -arm_HE_E_x;  /* d E6.y / d HE_theta */
    phi_q[345] = 1.0;  /* d G.x / d EG_x */
    phi_q[347] = -arm_EG_G_y;  /* d G.x / d EG_theta */
    phi_q[348] = -1.0;  /* d G.x / d AG_x */
    phi_q[350] = arm_AG_G_y;  /* d G.x / d AG_theta */
    phi_q[367] = 1.0;  /* d G.y / d EG_y */
    phi_q[368] = arm_EG_G_x;  /* d G.y / d EG_theta */
    phi_q[370] = -1.0;  /* d G.y / d AG_y */
    phi_q[371] = -arm_AG_G_x;  /* d G.y / d AG_theta */
    phi_q[393] = 1.0;  /* d H.x / d HE_x */
    phi_q[395] = -arm_HE_H_y;  /* d H.x / d HE_theta */
    phi_q[396] = -1.0;  /* d H.x / d AH_x */
    phi_q[398] = arm_AH_H_y;  /* d H.x / d AH_theta */
    phi_q[415] = 1.0;  /* d H.y / d HE_y */
    phi_q[416] = arm_HE_H_x;  /* d H.y / d HE_theta */
    phi_q[418] = -1.0;  /* d H.y / d AH_y */
    phi_q[419] = -arm_AH_H_x;  /* d H.y / d AH_theta */
}
/*
 * nu = -Phi_t: Phi_q v = nu.
 */
static void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t;
    (void)q;
    (void)p;
    /* rows */
    nu[0] = 0.0;  /* O.x */
    nu[1] = 0.0;  /* O.y */
    nu[2] = 0.0;  /* B.x */
    nu[3] = 0.0;  /* B.y */
    nu[4] = 0.0;  /* A5.x */
    nu[5] = 0.0;  /* A5.y */
    nu[6] = 0.0;  /* A7.x */
    nu[7] = 0.0;  /* A7.y */
    nu[8] = 0.0;  /* F.x */
    nu[9] = 0.0;  /* F.y */
    nu[10] = 0.0;  /* E3.x */
    nu[11] = 0.0;  /* E3.y */
    nu[12] = 0.0;  /* E4.x */
    nu[13] = 0.0;  /* E4.y */
    nu[14] = 0.0;  /* E6.x */
    nu[15] = 0.0;  /* E6.y */
    nu[16] = 0.0;  /* G.x */
    nu[17] = 0.0;  /* G.y */
    nu[18] = 0.0;  /* H.x */
    nu[19] = 0.0;  /* H.y */
}
/*
 * gamma: Phi_q a = gamma.
 */
static void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double
    *gamma_rows)
{
    (void)t;
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

    /* parameters */
    const double OF_points_O_x = p->OF_points_O_x;
    const double OF_points_F_x = p->OF_points_F_x;
    const double FE_points_E_x = p->FE_points_E_x;
    const double FE_points_F_x = p->FE_points_F_x;
    const double BDE_points_B_x = p->BDE_points_B_x;
    const double BDE_points_B_y = p->BDE_points_B_y;
    const double BDE_points_E_x = p->BDE_points_E_x;
    const double BDE_points_E_y = p->BDE_points_E_y;
    const double EG_points_G_y = p->EG_points_G_y;
    const double EG_points_E_y = p->EG_points_E_y;
    const double AG_points_A_x = p->AG_points_A_x;
    const double AG_points_A_y = p->AG_points_A_y;
    const double AG_points_G_x = p->AG_points_G_x;
    const double AG_points_G_y = p->AG_points_G_y;
    const double HE_points_H_x = p->HE_points_H_x;
    const double HE_points_E_x = p->HE_points_E_x;
    const double AH_points_A_x = p->AH_points_A_x;
    const double AH_points_A_y = p->AH_points_A_y;
    const double AH_points_H_x = p->AH_points_H_x;
    const double AH_points_H_y = p->AH_points_H_y;

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = BDE_points_B_x*cos_theta_BDE - BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = BDE_points_B_x*sin_theta_BDE + BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = AG_points_A_x*cos_theta_AG - AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = AG_points_A_x*sin_theta_AG + AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = AH_points_A_x*cos_theta_AH - AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = AH_points_A_x*sin_theta_AH + AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = BDE_points_E_x*cos_theta_BDE - BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = BDE_points_E_x*sin_theta_BDE + BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = AG_points_G_x*cos_theta_AG - AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = AG_points_G_x*sin_theta_AG + AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = AH_points_H_x*cos_theta_AH - AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = AH_points_H_x*sin_theta_AH + AH_points_H_y*cos_theta_AH;

    /* rows */
    gamma_rows[0] = -(OF_omega * OF_omega)*arm_OF_O_x;  /* O.x */
    gamma_rows[1] = -(OF_omega * OF_omega)*arm_OF_O_y;  /* O.y */
    gamma_rows[2] = -(BDE_omega * BDE_omega)*arm_BDE_B_x;  /* B.x */
    gamma_rows[3] = -(BDE_omega * BDE_omega)*arm_BDE_B_y;  /* B.y */
    gamma_rows[4] = -(AG_omega * AG_omega)*arm_AG_A_x;  /* A5.x */
    gamma_rows[5] = -(AG_omega * AG_omega)*arm_AG_A_y;  /* A5.y */
    gamma_rows[6] = -(AH_omega * AH_omega)*arm_AH_A_x;  /* A7.x */
    gamma_rows[7] = -(AH_omega * AH_omega)*arm_AH_A_y;  /* A7.y */
    gamma_rows[8] = -(FE_omega * FE_omega)*arm_FE_F_x + (OF_omega * OF_omega)*arm_OF_F_x;  /* F.x */
    gamma_rows[9] = -(FE_omega * FE_omega)*arm_FE_F_y + (OF_omega * OF_omega)*arm_OF_F_y;  /* F.y */
    gamma_rows[10] = -(BDE_omega * BDE_omega)*arm_BDE_E_x + (FE_omega * FE_omega)*arm_FE_E_x;  /* E3.x */
    gamma_rows[11] = -(BDE_omega * BDE_omega)*arm_BDE_E_y + (FE_omega * FE_omega)*arm_FE_E_y;  /* E3.y */
    gamma_rows[12] = -(EG_omega * EG_omega)*arm_EG_E_x + (FE_omega * FE_omega)*arm_FE_E_x;  /* E4.x */
    gamma_rows[13] = -(EG_omega * EG_omega)*arm_EG_E_y + (FE_omega * FE_omega)*arm_FE_E_y;  /* E4.y */
    gamma_rows[14] = (FE_omega * FE_omega)*arm_FE_E_x - (HE_omega * HE_omega)*arm_HE_E_x;  /* E6.x */
    gamma_rows[15] = (FE_omega * FE_omega)*arm_FE_E_y - (HE_omega * HE_omega)*arm_HE_E_y;  /* E6.y */
    gamma_rows[16] = -(AG_omega * AG_omega)*arm_AG_G_x + (EG_omega * EG_omega)*arm_EG_G_x;  /* G.x */
    gamma_rows[17] = -(AG_omega * AG_omega)*arm_AG_G_y + (EG_omega * EG_omega)*arm_EG_G_y;  /* G.y */
    gamma_rows[18] = -(AH_omega * AH_omega)*arm_AH_H_x + (HE_omega * HE_omega)*arm_HE_H_x;  /* H.x */
    gamma_rows[19] = -(AH_omega * AH_omega)*arm_AH_H_y + (HE_omega * HE_omega)*arm_HE_H_y;  /* H.y */
}
/*
 * Values of the start's guess, set and rates.
 */
static void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)rates;
    /* parameters */
    const double guess_FE_theta = p->guess_FE_theta;
    const double guess_BDE_theta = p->guess_BDE_theta;
    const double guess_EG_theta = p->guess_EG_theta;
    const double guess_AG_theta = p->guess_AG_theta;
    const double guess_HE_theta = p->guess_HE_theta;
    const double guess_AH_theta = p->guess_AH_theta;
    const double set_OF_theta = p->set_OF_theta;

    /* start */
    guess[0] = guess_FE_theta;  /* start.guess.FE.theta */
    guess[1] = guess_BDE_theta;  /* start.guess.BDE.theta */
    guess[2] = guess_EG_theta;  /* start.guess.EG.theta */
    guess[3] = guess_AG_theta;  /* start.guess.AG.theta */
    guess[4] = guess_HE_theta;  /* start.guess.HE.theta */
    guess[5] = guess_AH_theta;  /* start.guess.AH.theta */
    set[0] = set_OF_theta;  /* start.set.OF.theta */
}
/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
static void outputs(const double t, const double *q, const double *v, const Parameters *p, const double
    *lambda, double *reactions, double *torques, double *series, double *energy)
{
    (void)t;
    (void)torques;
    /* coordinates, velocities, time */
    const double OF_vx = v[0];
    const double OF_vy = v[1];
    const double OF_omega = v[2];
    const double FE_vx = v[3];
    const double FE_vy = v[4];
    const double FE_omega = v[5];
    const double BDE_x = q[6];
    const double BDE_y = q[7];
    const double BDE_theta = q[8];
    const double BDE_vx = v[6];
    const double BDE_vy = v[7];
    const double BDE_omega = v[8];
    const double EG_vx = v[9];
    const double EG_vy = v[10];
    const double EG_omega = v[11];
    const double AG_vx = v[12];
    const double AG_vy = v[13];
    const double AG_omega = v[14];
    const double HE_vx = v[15];
    const double HE_vy = v[16];
    const double HE_omega = v[17];
    const double AH_vx = v[18];
    const double AH_vy = v[19];
    const double AH_omega = v[20];

    /* parameters */
    const double OF_mass = p->OF_mass;
    const double OF_inertia = p->OF_inertia;
    const double FE_mass = p->FE_mass;
    const double FE_inertia = p->FE_inertia;
    const double BDE_mass = p->BDE_mass;
    const double BDE_inertia = p->BDE_inertia;
    const double EG_mass = p->EG_mass;
    const double EG_inertia = p->EG_inertia;
    const double AG_mass = p->AG_mass;
    const double AG_inertia = p->AG_inertia;
    const double HE_mass = p->HE_mass;
    const double HE_inertia = p->HE_inertia;
    const double AH_mass = p->AH_mass;
    const double AH_inertia = p->AH_inertia;
    const double BDE_points_D_x = p->BDE_points_D_x;
    const double BDE_points_D_y = p->BDE_points_D_y;
    const double C_x = p->C_x;
    const double C_y = p->C_y;
    const double spring_stiffness = p->spring_stiffness;
    const double spring_free_length = p->spring_free_length;
    const double motor_value = p->motor_value;

    /* directions, arms, drives */
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_D_x = BDE_points_D_x*cos_theta_BDE - BDE_points_D_y*sin_theta_BDE;
    const double arm_BDE_D_y = BDE_points_D_x*sin_theta_BDE + BDE_points_D_y*cos_theta_BDE;
    const double spring_span_x = BDE_x - C_x + arm_BDE_D_x;
    const double spring_span_y = BDE_y - C_y + arm_BDE_D_y;
    const double spring_length = sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const double spring_force = spring_stiffness*(-spring_free_length + spring_length);

    /* multipliers */
    const double multiplier_O_x = lambda[0];
    const double multiplier_O_y = lambda[1];
    const double multiplier_B_x = lambda[2];
    const double multiplier_B_y = lambda[3];
    const double multiplier_A5_x = lambda[4];
    const double multiplier_A5_y = lambda[5];
    const double multiplier_A7_x = lambda[6];
    const double multiplier_A7_y = lambda[7];
    const double multiplier_F_x = lambda[8];
    const double multiplier_F_y = lambda[9];
    const double multiplier_E3_x = lambda[10];
    const double multiplier_E3_y = lambda[11];
    const double multiplier_E4_x = lambda[12];
    const double multiplier_E4_y = lambda[13];
    const double multiplier_E6_x = lambda[14];
    const double multiplier_E6_y = lambda[15];
    const double multiplier_G_x = lambda[16];
    const double multiplier_G_y = lambda[17];
    const double multiplier_H_x = lambda[18];
    const double multiplier_H_y = lambda[19];

    /* reactions */
    reactions[0] = multiplier_O_x;  /* O.Fx */
    reactions[1] = multiplier_O_y;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_B_x;  /* B.Fx */
    reactions[4] = multiplier_B_y;  /* B.Fy */
    reactions[5] = 0.0;  /* B.M */
    reactions[6] = multiplier_A5_x;  /* A5.Fx */
    reactions[7] = multiplier_A5_y;  /* A5.Fy */
    reactions[8] = 0.0;  /* A5.M */
    reactions[9] = multiplier_A7_x;  /* A7.Fx */
    reactions[10] = multiplier_A7_y;  /* A7.Fy */
    reactions[11] = 0.0;  /* A7.M */
    reactions[12] = multiplier_F_x;  /* F.Fx */
    reactions[13] = multiplier_F_y;  /* F.Fy */
    reactions[14] = 0.0;  /* F.M */
    reactions[15] = multiplier_E3_x;  /* E3.Fx */
    reactions[16] = multiplier_E3_y;  /* E3.Fy */
    reactions[17] = 0.0;  /* E3.M */
    reactions[18] = multiplier_E4_x;  /* E4.Fx */
    reactions[19] = multiplier_E4_y;  /* E4.Fy */
    reactions[20] = 0.0;  /* E4.M */
    reactions[21] = multiplier_E6_x;  /* E6.Fx */
    reactions[22] = multiplier_E6_y;  /* E6.Fy */
    reactions[23] = 0.0;  /* E6.M */
    reactions[24] = multiplier_G_x;  /* G.Fx */
    reactions[25] = multiplier_G_y;  /* G.Fy */
    reactions[26] = 0.0;  /* G.M */
    reactions[27] = multiplier_H_x;  /* H.Fx */
    reactions[28] = multiplier_H_y;  /* H.Fy */
    reactions[29] = 0.0;  /* H.M */
    series[0] = spring_force;  /* spring.F */
    series[1] = spring_length;  /* spring.length */
    series[2] = motor_value;  /* motor.M */

    /* energy */
    energy[0] = (1.0/2.0)*AG_inertia*(AG_omega * AG_omega) + (1.0/2.0)*AG_mass*(AG_vx * AG_vx) +
        (1.0/2.0)*AG_mass*(AG_vy * AG_vy) + (1.0/2.0)*AH_inertia*(AH_omega * AH_omega) +
        (1.0/2.0)*AH_mass*(AH_vx * AH_vx) + (1.0/2.0)*AH_mass*(AH_vy * AH_vy) +
        (1.0/2.0)*BDE_inertia*(BDE_omega * BDE_omega) + (1.0/2.0)*BDE_mass*(BDE_vx * BDE_vx) +
        (1.0/2.0)*BDE_mass*(BDE_vy * BDE_vy) + (1.0/2.0)*EG_inertia*(EG_omega * EG_omega) +
        (1.0/2.0)*EG_mass*(EG_vx * EG_vx) + (1.0/2.0)*EG_mass*(EG_vy * EG_vy) + (1.0/2.0)*FE_inertia*(FE_omega
        * FE_omega) + (1.0/2.0)*FE_mass*(FE_vx * FE_vx) + (1.0/2.0)*FE_mass*(FE_vy * FE_vy) +
        (1.0/2.0)*HE_inertia*(HE_omega * HE_omega) + (1.0/2.0)*HE_mass*(HE_vx * HE_vx) +
        (1.0/2.0)*HE_mass*(HE_vy * HE_vy) + (1.0/2.0)*OF_inertia*(OF_omega * OF_omega) +
        (1.0/2.0)*OF_mass*(OF_vx * OF_vx) + (1.0/2.0)*OF_mass*(OF_vy * OF_vy);
    energy[1] = (1.0/2.0)*spring_stiffness*((-spring_free_length + spring_length) * (-spring_free_length +
        spring_length));
}
/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
static int project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta = q[2];
    const double FE_theta = q[5];
    const double BDE_theta = q[8];
    const double EG_theta = q[11];
    const double AG_theta = q[14];
    const double HE_theta = q[17];
    const double AH_theta = q[20];

    /* parameters */
    const double OF_points_O_x = p->OF_points_O_x;
    const double OF_points_F_x = p->OF_points_F_x;
    const double FE_points_E_x = p->FE_points_E_x;
    const double FE_points_F_x = p->FE_points_F_x;
    const double BDE_points_B_x = p->BDE_points_B_x;
    const double BDE_points_B_y = p->BDE_points_B_y;
    const double BDE_points_E_x = p->BDE_points_E_x;
    const double BDE_points_E_y = p->BDE_points_E_y;
    const double EG_points_G_y = p->EG_points_G_y;
    const double EG_points_E_y = p->EG_points_E_y;
    const double AG_points_A_x = p->AG_points_A_x;
    const double AG_points_A_y = p->AG_points_A_y;
    const double AG_points_G_x = p->AG_points_G_x;
    const double AG_points_G_y = p->AG_points_G_y;
    const double HE_points_H_x = p->HE_points_H_x;
    const double HE_points_E_x = p->HE_points_E_x;
    const double AH_points_A_x = p->AH_points_A_x;
    const double AH_points_A_y = p->AH_points_A_y;
    const double AH_points_H_x = p->AH_points_H_x;
    const double AH_points_H_y = p->AH_points_H_y;
    const double inverse_OF_mass = p->inverse_OF_mass;
    const double inverse_OF_inertia = p->inverse_OF_inertia;
    const double inverse_FE_mass = p->inverse_FE_mass;
    const double inverse_FE_inertia = p->inverse_FE_inertia;
    const double inverse_BDE_mass = p->inverse_BDE_mass;
    const double inverse_BDE_inertia = p->inverse_BDE_inertia;
    const double inverse_EG_mass = p->inverse_EG_mass;
    const double inverse_EG_inertia = p->inverse_EG_inertia;
    const double inverse_AG_mass = p->inverse_AG_mass;
    const double inverse_AG_inertia = p->inverse_AG_inertia;
    const double inverse_HE_mass = p->inverse_HE_mass;
    const double inverse_HE_inertia = p->inverse_HE_inertia;
    const double inverse_AH_mass = p->inverse_AH_mass;
    const double inverse_AH_inertia = p->inverse_AH_inertia;

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = BDE_points_B_x*cos_theta_BDE - BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = BDE_points_B_x*sin_theta_BDE + BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = AG_points_A_x*cos_theta_AG - AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = AG_points_A_x*sin_theta_AG + AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = AH_points_A_x*cos_theta_AH - AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = AH_points_A_x*sin_theta_AH + AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = BDE_points_E_x*cos_theta_BDE - BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = BDE_points_E_x*sin_theta_BDE + BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = AG_points_G_x*cos_theta_AG - AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = AG_points_G_x*sin_theta_AG + AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = AH_points_H_x*cos_theta_AH - AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = AH_points_H_x*sin_theta_AH + AH_points_H_y*cos_theta_AH;

    /* right-hand side */
    const double r_O_x = r[0];
    const double r_O_y = r[1];
    const double r_B_x = r[2];
    const double r_B_y = r[3];
    const double r_A5_x = r[4];
    const double r_A5_y = r[5];
    const double r_A7_x = r[6];
    const double r_A7_y = r[7];
    const double r_F_x = r[8];
    const double r_F_y = r[9];
    const double r_E3_x = r[10];
    const double r_E3_y = r[11];
    const double r_E4_x = r[12];
    const double r_E4_y = r[13];
    const double r_E6_x = r[14];
    const double r_E6_y = r[15];
    const double r_G_x = r[16];
    const double r_G_y = r[17];
    const double r_H_x = r[18];
    const double r_H_y = r[19];

    /* L D L^T of the KKT matrix */
    const double l_O_x__OF_theta_2 = arm_OF_O_y*inverse_OF_inertia;
    const double l_O_y__OF_theta_2 = -arm_OF_O_x*inverse_OF_inertia;
    const double l_F_x__OF_theta_2 = -arm_OF_F_y*inverse_OF_inertia;
    const double l_F_y__OF_theta_2 = arm_OF_F_x*inverse_OF_inertia;
    const double scale_O_x_2 = arm_OF_O_y*l_O_x__OF_theta_2 + inverse_OF_mass;
    if (!(scale_O_x_2 > 1e-13 * scale_O_x_2)) return 1;
    const double inverse_pivot_O_x_2 = 1.0/scale_O_x_2;
    const double w_O_y__O_x_2 = -arm_OF_O_y*l_O_y__OF_theta_2;
    const double l_O_y__O_x_2 = -inverse_pivot_O_x_2*w_O_y__O_x_2;
    const double w_F_x__O_x_2 = -arm_OF_O_y*l_F_x__OF_theta_2 + inverse_OF_mass;
    const double l_F_x__O_x_2 = -inverse_pivot_O_x_2*w_F_x__O_x_2;
    const double w_F_y__O_x_2 = -arm_OF_O_y*l_F_y__OF_theta_2;
    const double l_F_y__O_x_2 = -inverse_pivot_O_x_2*w_F_y__O_x_2;
    const double scale_O_y_2 = -arm_OF_O_x*l_O_y__OF_theta_2 + inverse_OF_mass;
    const double pivot_O_y_2 = l_O_y__O_x_2*w_O_y__O_x_2 + scale_O_y_2;
    if (!(pivot_O_y_2 > 1e-13 * scale_O_y_2)) return 2;
    const double inverse_pivot_O_y_2 = 1.0/pivot_O_y_2;
    const double w_F_x__O_y_2 = arm_OF_O_x*l_F_x__OF_theta_2 - l_F_x__O_x_2*w_O_y__O_x_2;
    const double l_F_x__O_y_2 = -inverse_pivot_O_y_2*w_F_x__O_y_2;
    const double w_F_y__O_y_2 = arm_OF_O_x*l_F_y__OF_theta_2 + inverse_OF_mass - l_F_y__O_x_2*w_O_y__O_x_2;
    const double l_F_y__O_y_2 = -inverse_pivot_O_y_2*w_F_y__O_y_2;
    const double l_B_x__BDE_theta_2 = arm_BDE_B_y*inverse_BDE_inertia;
    const double l_B_y__BDE_theta_2 = -arm_BDE_B_x*inverse_BDE_inertia;
    const double l_E3_x__BDE_theta_2 = arm_BDE_E_y*inverse_BDE_inertia;
    const double l_E3_y__BDE_theta_2 = -arm_BDE_E_x*inverse_BDE_inertia;
    const double scale_B_x_2 = arm_BDE_B_y*l_B_x__BDE_theta_2 + inverse_BDE_mass;
    if (!(scale_B_x_2 > 1e-13 * scale_B_x_2)) return 3;
    const double inverse_pivot_B_x_2 = 1.0/scale_B_x_2;
    const double w_B_y__B_x_2 = -arm_BDE_B_y*l_B_y__BDE_theta_2;
    const double l_B_y__B_x_2 = -inverse_pivot_B_x_2*w_B_y__B_x_2;
    const double w_E3_x__B_x_2 = -arm_BDE_B_y*l_E3_x__BDE_theta_2 - inverse_BDE_mass;
    const double l_E3_x__B_x_2 = -inverse_pivot_B_x_2*w_E3_x__B_x_2;
    const double w_E3_y__B_x_2 = -arm_BDE_B_y*l_E3_y__BDE_theta_2;
    const double l_E3_y__B_x_2 = -inverse_pivot_B_x_2*w_E3_y__B_x_2;
    const double scale_B_y_2 = -arm_BDE_B_x*l_B_y__BDE_theta_2 + inverse_BDE_mass;
    const double pivot_B_y_2 = l_B_y__B_x_2*w_B_y__B_x_2 + scale_B_y_2;
    if (!(pivot_B_y_2 > 1e-13 * scale_B_y_2)) return 4;
    const double inverse_pivot_B_y_2 = 1.0/pivot_B_y_2;
    const double w_E3_x__B_y_2 = arm_BDE_B_x*l_E3_x__BDE_theta_2 - l_E3_x__B_x_2*w_B_y__B_x_2;
    const double l_E3_x__B_y_2 = -inverse_pivot_B_y_2*w_E3_x__B_y_2;
    const double w_E3_y__B_y_2 = arm_BDE_B_x*l_E3_y__BDE_theta_2 - inverse_BDE_mass -
        l_E3_y__B_x_2*w_B_y__B_x_2;
    const double l_E3_y__B_y_2 = -inverse_pivot_B_y_2*w_E3_y__B_y_2;
    const double l_G_x__EG_theta_2 = -arm_EG_G_y*inverse_EG_inertia;
    const double l_G_y__EG_theta_2 = arm_EG_G_x*inverse_EG_inertia;
    const double l_E4_x__EG_theta_2 = arm_EG_E_y*inverse_EG_inertia;
    const double l_E4_y__EG_theta_2 = -arm_EG_E_x*inverse_EG_inertia;
    const double l_A5_x__AG_theta_2 = arm_AG_A_y*inverse_AG_inertia;
    const double l_A5_y__AG_theta_2 = -arm_AG_A_x*inverse_AG_inertia;
    const double l_G_x__AG_theta_2 = arm_AG_G_y*inverse_AG_inertia;
    const double l_G_y__AG_theta_2 = -arm_AG_G_x*inverse_AG_inertia;
    const double scale_A5_x_2 = arm_AG_A_y*l_A5_x__AG_theta_2 + inverse_AG_mass;
    if (!(scale_A5_x_2 > 1e-13 * scale_A5_x_2)) return 5;
    const double inverse_pivot_A5_x_2 = 1.0/scale_A5_x_2;
    const double w_A5_y__A5_x_2 = -arm_AG_A_y*l_A5_y__AG_theta_2;
    const double l_A5_y__A5_x_2 = -inverse_pivot_A5_x_2*w_A5_y__A5_x_2;
    const double w_G_x__A5_x_2 = -arm_AG_A_y*l_G_x__AG_theta_2 - inverse_AG_mass;
    const double l_G_x__A5_x_2 = -inverse_pivot_A5_x_2*w_G_x__A5_x_2;
    const double w_G_y__A5_x_2 = -arm_AG_A_y*l_G_y__AG_theta_2;
    const double l_G_y__A5_x_2 = -inverse_pivot_A5_x_2*w_G_y__A5_x_2;
    const double scale_A5_y_2 = -arm_AG_A_x*l_A5_y__AG_theta_2 + inverse_AG_mass;
    const double pivot_A5_y_2 = l_A5_y__A5_x_2*w_A5_y__A5_x_2 + scale_A5_y_2;
    if (!(pivot_A5_y_2 > 1e-13 * scale_A5_y_2)) return 6;
    const double inverse_pivot_A5_y_2 = 1.0/pivot_A5_y_2;
    const double w_G_x__A5_y_2 = arm_AG_A_x*l_G_x__AG_theta_2 - l_G_x__A5_x_2*w_A5_y__A5_x_2;
    const double l_G_x__A5_y_2 = -inverse_pivot_A5_y_2*w_G_x__A5_y_2;
    const double w_G_y__A5_y_2 = arm_AG_A_x*l_G_y__AG_theta_2 - inverse_AG_mass -
        l_G_y__A5_x_2*w_A5_y__A5_x_2;
    const double l_G_y__A5_y_2 = -inverse_pivot_A5_y_2*w_G_y__A5_y_2;
    const double scale_G_x_2 = arm_AG_G_y*l_G_x__AG_theta_2 - arm_EG_G_y*l_G_x__EG_theta_2 + inverse_AG_mass +
        inverse_EG_mass;
    const double pivot_G_x_2 = l_G_x__A5_x_2*w_G_x__A5_x_2 + l_G_x__A5_y_2*w_G_x__A5_y_2 + scale_G_x_2;
    if (!(pivot_G_x_2 > 1e-13 * scale_G_x_2)) return 7;
    const double inverse_pivot_G_x_2 = 1.0/pivot_G_x_2;
    const double w_G_y__G_x_2 = -arm_AG_G_y*l_G_y__AG_theta_2 + arm_EG_G_y*l_G_y__EG_theta_2 -
        l_G_y__A5_x_2*w_G_x__A5_x_2 - l_G_y__A5_y_2*w_G_x__A5_y_2;
    const double l_G_y__G_x_2 = -inverse_pivot_G_x_2*w_G_y__G_x_2;
    const double w_E4_x__G_x_2 = arm_EG_G_y*l_E4_x__EG_theta_2 + inverse_EG_mass;
    const double l_E4_x__G_x_2 = -inverse_pivot_G_x_2*w_E4_x__G_x_2;
    const double w_E4_y__G_x_2 = arm_EG_G_y*l_E4_y__EG_theta_2;
    const double l_E4_y__G_x_2 = -inverse_pivot_G_x_2*w_E4_y__G_x_2;
    const double scale_G_y_2 = -arm_AG_G_x*l_G_y__AG_theta_2 + arm_EG_G_x*l_G_y__EG_theta_2 + inverse_AG_mass
        + inverse_EG_mass;
    const double pivot_G_y_2 = l_G_y__A5_x_2*w_G_y__A5_x_2 + l_G_y__A5_y_2*w_G_y__A5_y_2 +
        l_G_y__G_x_2*w_G_y__G_x_2 + scale_G_y_2;
    if (!(pivot_G_y_2 > 1e-13 * scale_G_y_2)) return 8;
    const double inverse_pivot_G_y_2 = 1.0/pivot_G_y_2;
    const double w_E4_x__G_y_2 = -arm_EG_G_x*l_E4_x__EG_theta_2 - l_E4_x__G_x_2*w_G_y__G_x_2;
    const double l_E4_x__G_y_2 = -inverse_pivot_G_y_2*w_E4_x__G_y_2;
    const double w_E4_y__G_y_2 = -arm_EG_G_x*l_E4_y__EG_theta_2 + inverse_EG_mass -
        l_E4_y__G_x_2*w_G_y__G_x_2;
    const double l_E4_y__G_y_2 = -inverse_pivot_G_y_2*w_E4_y__G_y_2;
    const double l_H_x__HE_theta_2 = -arm_HE_H_y*inverse_HE_inertia;
    const double l_H_y__HE_theta_2 = arm_HE_H_x*inverse_HE_inertia;
    const double l_E6_x__HE_theta_2 = arm_HE_E_y*inverse_HE_inertia;
    const double l_E6_y__HE_theta_2 = -arm_HE_E_x*inverse_HE_inertia;
    const double l_A7_x__AH_theta_2 = arm_AH_A_y*inverse_AH_inertia;
    const double l_A7_y__AH_theta_2 = -arm_AH_A_x*inverse_AH_inertia;
    const double l_H_x__AH_theta_2 = arm_AH_H_y*inverse_AH_inertia;
    const double l_H_y__AH_theta_2 = -arm_AH_H_x*inverse_AH_inertia;
    const double scale_A7_x_2 = arm_AH_A_y*l_A7_x__AH_theta_2 + inverse_AH_mass;
    if (!(scale_A7_x_2 > 1e-13 * scale_A7_x_2)) return 9;
    const double inverse_pivot_A7_x_2 = 1.0/scale_A7_x_2;
    const double w_A7_y__A7_x_2 = -arm_AH_A_y*l_A7_y__AH_theta_2;
    const double l_A7_y__A7_x_2 = -inverse_pivot_A7_x_2*w_A7_y__A7_x_2;
    const double w_H_x__A7_x_2 = -arm_AH_A_y*l_H_x__AH_theta_2 - inverse_AH_mass;
    const double l_H_x__A7_x_2 = -inverse_pivot_A7_x_2*w_H_x__A7_x_2;
    const double w_H_y__A7_x_2 = -arm_AH_A_y*l_H_y__AH_theta_2;
    const double l_H_y__A7_x_2 = -inverse_pivot_A7_x_2*w_H_y__A7_x_2;
    const double scale_A7_y_2 = -arm_AH_A_x*l_A7_y__AH_theta_2 + inverse_AH_mass;
    const double pivot_A7_y_2 = l_A7_y__A7_x_2*w_A7_y__A7_x_2 + scale_A7_y_2;
    if (!(pivot_A7_y_2 > 1e-13 * scale_A7_y_2)) return 10;
    const double inverse_pivot_A7_y_2 = 1.0/pivot_A7_y_2;
    const double w_H_x__A7_y_2 = arm_AH_A_x*l_H_x__AH_theta_2 - l_H_x__A7_x_2*w_A7_y__A7_x_2;
    const double l_H_x__A7_y_2 = -inverse_pivot_A7_y_2*w_H_x__A7_y_2;
    const double w_H_y__A7_y_2 = arm_AH_A_x*l_H_y__AH_theta_2 - inverse_AH_mass -
        l_H_y__A7_x_2*w_A7_y__A7_x_2;
    const double l_H_y__A7_y_2 = -inverse_pivot_A7_y_2*w_H_y__A7_y_2;
    const double scale_H_x_2 = arm_AH_H_y*l_H_x__AH_theta_2 - arm_HE_H_y*l_H_x__HE_theta_2 + inverse_AH_mass +
        inverse_HE_mass;
    const double pivot_H_x_2 = l_H_x__A7_x_2*w_H_x__A7_x_2 + l_H_x__A7_y_2*w_H_x__A7_y_2 + scale_H_x_2;
    if (!(pivot_H_x_2 > 1e-13 * scale_H_x_2)) return 11;
    const double inverse_pivot_H_x_2 = 1.0/pivot_H_x_2;
    const double w_H_y__H_x_2 = -arm_AH_H_y*l_H_y__AH_theta_2 + arm_HE_H_y*l_H_y__HE_theta_2 -
        l_H_y__A7_x_2*w_H_x__A7_x_2 - l_H_y__A7_y_2*w_H_x__A7_y_2;
    const double l_H_y__H_x_2 = -inverse_pivot_H_x_2*w_H_y__H_x_2;
    const double w_E6_x__H_x_2 = arm_HE_H_y*l_E6_x__HE_theta_2 + inverse_HE_mass;
    const double l_E6_x__H_x_2 = -inverse_pivot_H_x_2*w_E6_x__H_x_2;
    const double w_E6_y__H_x_2 = arm_HE_H_y*l_E6_y__HE_theta_2;
    const double l_E6_y__H_x_2 = -inverse_pivot_H_x_2*w_E6_y__H_x_2;
    const double scale_H_y_2 = -arm_AH_H_x*l_H_y__AH_theta_2 + arm_HE_H_x*l_H_y__HE_theta_2 + inverse_AH_mass
        + inverse_HE_mass;
    const double pivot_H_y_2 = l_H_y__A7_x_2*w_H_y__A7_x_2 + l_H_y__A7_y_2*w_H_y__A7_y_2 +
        l_H_y__H_x_2*w_H_y__H_x_2 + scale_H_y_2;
    if (!(pivot_H_y_2 > 1e-13 * scale_H_y_2)) return 12;
    const double inverse_pivot_H_y_2 = 1.0/pivot_H_y_2;
    const double w_E6_x__H_y_2 = -arm_HE_H_x*l_E6_x__HE_theta_2 - l_E6_x__H_x_2*w_H_y__H_x_2;
    const double l_E6_x__H_y_2 = -inverse_pivot_H_y_2*w_E6_x__H_y_2;
    const double w_E6_y__H_y_2 = -arm_HE_H_x*l_E6_y__HE_theta_2 + inverse_HE_mass -
        l_E6_y__H_x_2*w_H_y__H_x_2;
    const double l_E6_y__H_y_2 = -inverse_pivot_H_y_2*w_E6_y__H_y_2;
    const double l_F_x__FE_theta_2 = arm_FE_F_y*inverse_FE_inertia;
    const double l_F_y__FE_theta_2 = -arm_FE_F_x*inverse_FE_inertia;
    const double l_E3_x__FE_theta_2 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E3_y__FE_theta_2 = arm_FE_E_x*inverse_FE_inertia;
    const double l_E4_x__FE_theta_2 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E4_y__FE_theta_2 = arm_FE_E_x*inverse_FE_inertia;
    const double l_E6_x__FE_theta_2 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E6_y__FE_theta_2 = arm_FE_E_x*inverse_FE_inertia;
    const double scale_F_x_2 = arm_FE_F_y*l_F_x__FE_theta_2 - arm_OF_F_y*l_F_x__OF_theta_2 + inverse_FE_mass +
        inverse_OF_mass;
    const double pivot_F_x_2 = l_F_x__O_x_2*w_F_x__O_x_2 + l_F_x__O_y_2*w_F_x__O_y_2 + scale_F_x_2;
    if (!(pivot_F_x_2 > 1e-13 * scale_F_x_2)) return 13;
    const double inverse_pivot_F_x_2 = 1.0/pivot_F_x_2;
    const double w_F_y__F_x_2 = -arm_FE_F_y*l_F_y__FE_theta_2 + arm_OF_F_y*l_F_y__OF_theta_2 -
        l_F_y__O_x_2*w_F_x__O_x_2 - l_F_y__O_y_2*w_F_x__O_y_2;
    const double l_F_y__F_x_2 = -inverse_pivot_F_x_2*w_F_y__F_x_2;
    const double w_E3_x__F_x_2 = -arm_FE_F_y*l_E3_x__FE_theta_2 + inverse_FE_mass;
    const double l_E3_x__F_x_2 = -inverse_pivot_F_x_2*w_E3_x__F_x_2;
    const double w_E3_y__F_x_2 = -arm_FE_F_y*l_E3_y__FE_theta_2;
    const double l_E3_y__F_x_2 = -inverse_pivot_F_x_2*w_E3_y__F_x_2;
    const double w_E4_x__F_x_2 = -arm_FE_F_y*l_E4_x__FE_theta_2 + inverse_FE_mass;
    const double l_E4_x__F_x_2 = -inverse_pivot_F_x_2*w_E4_x__F_x_2;
    const double w_E4_y__F_x_2 = -arm_FE_F_y*l_E4_y__FE_theta_2;
    const double l_E4_y__F_x_2 = -inverse_pivot_F_x_2*w_E4_y__F_x_2;
    const double w_E6_x__F_x_2 = -arm_FE_F_y*l_E6_x__FE_theta_2 + inverse_FE_mass;
    const double l_E6_x__F_x_2 = -inverse_pivot_F_x_2*w_E6_x__F_x_2;
    const double w_E6_y__F_x_2 = -arm_FE_F_y*l_E6_y__FE_theta_2;
    const double l_E6_y__F_x_2 = -inverse_pivot_F_x_2*w_E6_y__F_x_2;
    const double scale_F_y_2 = -arm_FE_F_x*l_F_y__FE_theta_2 + arm_OF_F_x*l_F_y__OF_theta_2 + inverse_FE_mass
        + inverse_OF_mass;
    const double pivot_F_y_2 = l_F_y__F_x_2*w_F_y__F_x_2 + l_F_y__O_x_2*w_F_y__O_x_2 +
        l_F_y__O_y_2*w_F_y__O_y_2 + scale_F_y_2;
    if (!(pivot_F_y_2 > 1e-13 * scale_F_y_2)) return 14;
    const double inverse_pivot_F_y_2 = 1.0/pivot_F_y_2;
    const double w_E3_x__F_y_2 = arm_FE_F_x*l_E3_x__FE_theta_2 - l_E3_x__F_x_2*w_F_y__F_x_2;
    const double l_E3_x__F_y_2 = -inverse_pivot_F_y_2*w_E3_x__F_y_2;
    const double w_E3_y__F_y_2 = arm_FE_F_x*l_E3_y__FE_theta_2 + inverse_FE_mass - l_E3_y__F_x_2*w_F_y__F_x_2;
    const double l_E3_y__F_y_2 = -inverse_pivot_F_y_2*w_E3_y__F_y_2;
    const double w_E4_x__F_y_2 = arm_FE_F_x*l_E4_x__FE_theta_2 - l_E4_x__F_x_2*w_F_y__F_x_2;
    const double l_E4_x__F_y_2 = -inverse_pivot_F_y_2*w_E4_x__F_y_2;
    const double w_E4_y__F_y_2 = arm_FE_F_x*l_E4_y__FE_theta_2 + inverse_FE_mass - l_E4_y__F_x_2*w_F_y__F_x_2;
    const double l_E4_y__F_y_2 = -inverse_pivot_F_y_2*w_E4_y__F_y_2;
    const double w_E6_x__F_y_2 = arm_FE_F_x*l_E6_x__FE_theta_2 - l_E6_x__F_x_2*w_F_y__F_x_2;
    const double l_E6_x__F_y_2 = -inverse_pivot_F_y_2*w_E6_x__F_y_2;
    const double w_E6_y__F_y_2 = arm_FE_F_x*l_E6_y__FE_theta_2 + inverse_FE_mass - l_E6_y__F_x_2*w_F_y__F_x_2;
    const double l_E6_y__F_y_2 = -inverse_pivot_F_y_2*w_E6_y__F_y_2;
    const double scale_E3_x_2 = arm_BDE_E_y*l_E3_x__BDE_theta_2 - arm_FE_E_y*l_E3_x__FE_theta_2 +
        inverse_BDE_mass + inverse_FE_mass;
    const double pivot_E3_x_2 = l_E3_x__B_x_2*w_E3_x__B_x_2 + l_E3_x__B_y_2*w_E3_x__B_y_2 +
        l_E3_x__F_x_2*w_E3_x__F_x_2 + l_E3_x__F_y_2*w_E3_x__F_y_2 + scale_E3_x_2;
    if (!(pivot_E3_x_2 > 1e-13 * scale_E3_x_2)) return 15;
    const double inverse_pivot_E3_x_2 = 1.0/pivot_E3_x_2;
    const double w_E3_y__E3_x_2 = -arm_BDE_E_y*l_E3_y__BDE_theta_2 + arm_FE_E_y*l_E3_y__FE_theta_2 -
        l_E3_y__B_x_2*w_E3_x__B_x_2 - l_E3_y__B_y_2*w_E3_x__B_y_2 - l_E3_y__F_x_2*w_E3_x__F_x_2 -
        l_E3_y__F_y_2*w_E3_x__F_y_2;
    const double l_E3_y__E3_x_2 = -inverse_pivot_E3_x_2*w_E3_y__E3_x_2;
    const double w_E4_x__E3_x_2 = arm_FE_E_y*l_E4_x__FE_theta_2 - inverse_FE_mass -
        l_E4_x__F_x_2*w_E3_x__F_x_2 - l_E4_x__F_y_2*w_E3_x__F_y_2;
    const double l_E4_x__E3_x_2 = -inverse_pivot_E3_x_2*w_E4_x__E3_x_2;
    const double w_E4_y__E3_x_2 = arm_FE_E_y*l_E4_y__FE_theta_2 - l_E4_y__F_x_2*w_E3_x__F_x_2 -
        l_E4_y__F_y_2*w_E3_x__F_y_2;
    const double l_E4_y__E3_x_2 = -inverse_pivot_E3_x_2*w_E4_y__E3_x_2;
    const double w_E6_x__E3_x_2 = arm_FE_E_y*l_E6_x__FE_theta_2 - inverse_FE_mass -
        l_E6_x__F_x_2*w_E3_x__F_x_2 - l_E6_x__F_y_2*w_E3_x__F_y_2;
    const double l_E6_x__E3_x_2 = -inverse_pivot_E3_x_2*w_E6_x__E3_x_2;
    const double w_E6_y__E3_x_2 = arm_FE_E_y*l_E6_y__FE_theta_2 - l_E6_y__F_x_2*w_E3_x__F_x_2 -
        l_E6_y__F_y_2*w_E3_x__F_y_2;
    const double l_E6_y__E3_x_2 = -inverse_pivot_E3_x_2*w_E6_y__E3_x_2;
    const double scale_E3_y_2 = -arm_BDE_E_x*l_E3_y__BDE_theta_2 + arm_FE_E_x*l_E3_y__FE_theta_2 +
        inverse_BDE_mass + inverse_FE_mass;
    const double pivot_E3_y_2 = l_E3_y__B_x_2*w_E3_y__B_x_2 + l_E3_y__B_y_2*w_E3_y__B_y_2 +
        l_E3_y__E3_x_2*w_E3_y__E3_x_2 + l_E3_y__F_x_2*w_E3_y__F_x_2 + l_E3_y__F_y_2*w_E3_y__F_y_2 +
        scale_E3_y_2;
    if (!(pivot_E3_y_2 > 1e-13 * scale_E3_y_2)) return 16;
    const double inverse_pivot_E3_y_2 = 1.0/pivot_E3_y_2;
    const double w_E4_x__E3_y_2 = -arm_FE_E_x*l_E4_x__FE_theta_2 - l_E4_x__E3_x_2*w_E3_y__E3_x_2 -
        l_E4_x__F_x_2*w_E3_y__F_x_2 - l_E4_x__F_y_2*w_E3_y__F_y_2;
    const double l_E4_x__E3_y_2 = -inverse_pivot_E3_y_2*w_E4_x__E3_y_2;
    const double w_E4_y__E3_y_2 = -arm_FE_E_x*l_E4_y__FE_theta_2 - inverse_FE_mass -
        l_E4_y__E3_x_2*w_E3_y__E3_x_2 - l_E4_y__F_x_2*w_E3_y__F_x_2 - l_E4_y__F_y_2*w_E3_y__F_y_2;
    const double l_E4_y__E3_y_2 = -inverse_pivot_E3_y_2*w_E4_y__E3_y_2;
    const double w_E6_x__E3_y_2 = -arm_FE_E_x*l_E6_x__FE_theta_2 - l_E6_x__E3_x_2*w_E3_y__E3_x_2 -
        l_E6_x__F_x_2*w_E3_y__F_x_2 - l_E6_x__F_y_2*w_E3_y__F_y_2;
    const double l_E6_x__E3_y_2 = -inverse_pivot_E3_y_2*w_E6_x__E3_y_2;
    const double w_E6_y__E3_y_2 = -arm_FE_E_x*l_E6_y__FE_theta_2 - inverse_FE_mass -
        l_E6_y__E3_x_2*w_E3_y__E3_x_2 - l_E6_y__F_x_2*w_E3_y__F_x_2 - l_E6_y__F_y_2*w_E3_y__F_y_2;
    const double l_E6_y__E3_y_2 = -inverse_pivot_E3_y_2*w_E6_y__E3_y_2;
    const double scale_E4_x_2 = arm_EG_E_y*l_E4_x__EG_theta_2 - arm_FE_E_y*l_E4_x__FE_theta_2 +
        inverse_EG_mass + inverse_FE_mass;
    const double pivot_E4_x_2 = l_E4_x__E3_x_2*w_E4_x__E3_x_2 + l_E4_x__E3_y_2*w_E4_x__E3_y_2 +
        l_E4_x__F_x_2*w_E4_x__F_x_2 + l_E4_x__F_y_2*w_E4_x__F_y_2 + l_E4_x__G_x_2*w_E4_x__G_x_2 +
        l_E4_x__G_y_2*w_E4_x__G_y_2 + scale_E4_x_2;
    if (!(pivot_E4_x_2 > 1e-13 * scale_E4_x_2)) return 17;
    const double inverse_pivot_E4_x_2 = 1.0/pivot_E4_x_2;
    const double w_E4_y__E4_x_2 = -arm_EG_E_y*l_E4_y__EG_theta_2 + arm_FE_E_y*l_E4_y__FE_theta_2 -
        l_E4_y__E3_x_2*w_E4_x__E3_x_2 - l_E4_y__E3_y_2*w_E4_x__E3_y_2 - l_E4_y__F_x_2*w_E4_x__F_x_2 -
        l_E4_y__F_y_2*w_E4_x__F_y_2 - l_E4_y__G_x_2*w_E4_x__G_x_2 - l_E4_y__G_y_2*w_E4_x__G_y_2;
    const double l_E4_y__E4_x_2 = -inverse_pivot_E4_x_2*w_E4_y__E4_x_2;
    const double w_E6_x__E4_x_2 = arm_FE_E_y*l_E6_x__FE_theta_2 - inverse_FE_mass -
        l_E6_x__E3_x_2*w_E4_x__E3_x_2 - l_E6_x__E3_y_2*w_E4_x__E3_y_2 - l_E6_x__F_x_2*w_E4_x__F_x_2 -
        l_E6_x__F_y_2*w_E4_x__F_y_2;
    const double l_E6_x__E4_x_2 = -inverse_pivot_E4_x_2*w_E6_x__E4_x_2;
    const double w_E6_y__E4_x_2 = arm_FE_E_y*l_E6_y__FE_theta_2 - l_E6_y__E3_x_2*w_E4_x__E3_x_2 -
        l_E6_y__E3_y_2*w_E4_x__E3_y_2 - l_E6_y__F_x_2*w_E4_x__F_x_2 - l_E6_y__F_y_2*w_E4_x__F_y_2;
    const double l_E6_y__E4_x_2 = -inverse_pivot_E4_x_2*w_E6_y__E4_x_2;
    const double scale_E4_y_2 = -arm_EG_E_x*l_E4_y__EG_theta_2 + arm_FE_E_x*l_E4_y__FE_theta_2 +
        inverse_EG_mass + inverse_FE_mass;
    const double pivot_E4_y_2 = l_E4_y__E3_x_2*w_E4_y__E3_x_2 + l_E4_y__E3_y_2*w_E4_y__E3_y_2 +
        l_E4_y__E4_x_2*w_E4_y__E4_x_2 + l_E4_y__F_x_2*w_E4_y__F_x_2 + l_E4_y__F_y_2*w_E4_y__F_y_2 +
        l_E4_y__G_x_2*w_E4_y__G_x_2 + l_E4_y__G_y_2*w_E4_y__G_y_2 + scale_E4_y_2;
    if (!(pivot_E4_y_2 > 1e-13 * scale_E4_y_2)) return 18;
    const double inverse_pivot_E4_y_2 = 1.0/pivot_E4_y_2;
    const double w_E6_x__E4_y_2 = -arm_FE_E_x*l_E6_x__FE_theta_2 - l_E6_x__E3_x_2*w_E4_y__E3_x_2 -
        l_E6_x__E3_y_2*w_E4_y__E3_y_2 - l_E6_x__E4_x_2*w_E4_y__E4_x_2 - l_E6_x__F_x_2*w_E4_y__F_x_2 -
        l_E6_x__F_y_2*w_E4_y__F_y_2;
    const double l_E6_x__E4_y_2 = -inverse_pivot_E4_y_2*w_E6_x__E4_y_2;
    const double w_E6_y__E4_y_2 = -arm_FE_E_x*l_E6_y__FE_theta_2 - inverse_FE_mass -
        l_E6_y__E3_x_2*w_E4_y__E3_x_2 - l_E6_y__E3_y_2*w_E4_y__E3_y_2 - l_E6_y__E4_x_2*w_E4_y__E4_x_2 -
        l_E6_y__F_x_2*w_E4_y__F_x_2 - l_E6_y__F_y_2*w_E4_y__F_y_2;
    const double l_E6_y__E4_y_2 = -inverse_pivot_E4_y_2*w_E6_y__E4_y_2;
    const double scale_E6_x_2 = -arm_FE_E_y*l_E6_x__FE_theta_2 + arm_HE_E_y*l_E6_x__HE_theta_2 +
        inverse_FE_mass + inverse_HE_mass;
    const double pivot_E6_x_2 = l_E6_x__E3_x_2*w_E6_x__E3_x_2 + l_E6_x__E3_y_2*w_E6_x__E3_y_2 +
        l_E6_x__E4_x_2*w_E6_x__E4_x_2 + l_E6_x__E4_y_2*w_E6_x__E4_y_2 + l_E6_x__F_x_2*w_E6_x__F_x_2 +
        l_E6_x__F_y_2*w_E6_x__F_y_2 + l_E6_x__H_x_2*w_E6_x__H_x_2 + l_E6_x__H_y_2*w_E6_x__H_y_2 +
        scale_E6_x_2;
    if (!(pivot_E6_x_2 > 1e-13 * scale_E6_x_2)) return 19;
    const double inverse_pivot_E6_x_2 = 1.0/pivot_E6_x_2;
    const double w_E6_y__E6_x_2 = arm_FE_E_y*l_E6_y__FE_theta_2 - arm_HE_E_y*l_E6_y__HE_theta_2 -
        l_E6_y__E3_x_2*w_E6_x__E3_x_2 - l_E6_y__E3_y_2*w_E6_x__E3_y_2 - l_E6_y__E4_x_2*w_E6_x__E4_x_2 -
        l_E6_y__E4_y_2*w_E6_x__E4_y_2 - l_E6_y__F_x_2*w_E6_x__F_x_2 - l_E6_y__F_y_2*w_E6_x__F_y_2 -
        l_E6_y__H_x_2*w_E6_x__H_x_2 - l_E6_y__H_y_2*w_E6_x__H_y_2;
    const double l_E6_y__E6_x_2 = -inverse_pivot_E6_x_2*w_E6_y__E6_x_2;
    const double scale_E6_y_2 = arm_FE_E_x*l_E6_y__FE_theta_2 - arm_HE_E_x*l_E6_y__HE_theta_2 +
        inverse_FE_mass + inverse_HE_mass;
    const double pivot_E6_y_2 = l_E6_y__E3_x_2*w_E6_y__E3_x_2 + l_E6_y__E3_y_2*w_E6_y__E3_y_2 +
        l_E6_y__E4_x_2*w_E6_y__E4_x_2 + l_E6_y__E4_y_2*w_E6_y__E4_y_2 + l_E6_y__E6_x_2*w_E6_y__E6_x_2 +
        l_E6_y__F_x_2*w_E6_y__F_x_2 + l_E6_y__F_y_2*w_E6_y__F_y_2 + l_E6_y__H_x_2*w_E6_y__H_x_2 +
        l_E6_y__H_y_2*w_E6_y__H_y_2 + scale_E6_y_2;
    if (!(pivot_E6_y_2 > 1e-13 * scale_E6_y_2)) return 20;
    const double inverse_pivot_E6_y_2 = 1.0/pivot_E6_y_2;

    /* forward substitution */
    const double step_z_O_y = -l_O_y__O_x_2*r_O_x + r_O_y;
    const double step_z_B_y = -l_B_y__B_x_2*r_B_x + r_B_y;
    const double step_z_A5_y = -l_A5_y__A5_x_2*r_A5_x + r_A5_y;
    const double step_z_G_x = -l_G_x__A5_x_2*r_A5_x - l_G_x__A5_y_2*step_z_A5_y + r_G_x;
    const double step_z_G_y = -l_G_y__A5_x_2*r_A5_x - l_G_y__A5_y_2*step_z_A5_y - l_G_y__G_x_2*step_z_G_x +
        r_G_y;
    const double step_z_A7_y = -l_A7_y__A7_x_2*r_A7_x + r_A7_y;
    const double step_z_H_x = -l_H_x__A7_x_2*r_A7_x - l_H_x__A7_y_2*step_z_A7_y + r_H_x;
    const double step_z_H_y = -l_H_y__A7_x_2*r_A7_x - l_H_y__A7_y_2*step_z_A7_y - l_H_y__H_x_2*step_z_H_x +
        r_H_y;
    const double step_z_F_x = -l_F_x__O_x_2*r_O_x - l_F_x__O_y_2*step_z_O_y + r_F_x;
    const double step_z_F_y = -l_F_y__F_x_2*step_z_F_x - l_F_y__O_x_2*r_O_x - l_F_y__O_y_2*step_z_O_y + r_F_y;
    const double step_z_E3_x = -l_E3_x__B_x_2*r_B_x - l_E3_x__B_y_2*step_z_B_y - l_E3_x__F_x_2*step_z_F_x -
        l_E3_x__F_y_2*step_z_F_y + r_E3_x;
    const double step_z_E3_y = -l_E3_y__B_x_2*r_B_x - l_E3_y__B_y_2*step_z_B_y - l_E3_y__E3_x_2*step_z_E3_x -
        l_E3_y__F_x_2*step_z_F_x - l_E3_y__F_y_2*step_z_F_y + r_E3_y;
    const double step_z_E4_x = -l_E4_x__E3_x_2*step_z_E3_x - l_E4_x__E3_y_2*step_z_E3_y -
        l_E4_x__F_x_2*step_z_F_x - l_E4_x__F_y_2*step_z_F_y - l_E4_x__G_x_2*step_z_G_x -
        l_E4_x__G_y_2*step_z_G_y + r_E4_x;
    const double step_z_E4_y = -l_E4_y__E3_x_2*step_z_E3_x - l_E4_y__E3_y_2*step_z_E3_y -
        l_E4_y__E4_x_2*step_z_E4_x - l_E4_y__F_x_2*step_z_F_x - l_E4_y__F_y_2*step_z_F_y -
        l_E4_y__G_x_2*step_z_G_x - l_E4_y__G_y_2*step_z_G_y + r_E4_y;
    const double step_z_E6_x = -l_E6_x__E3_x_2*step_z_E3_x - l_E6_x__E3_y_2*step_z_E3_y -
        l_E6_x__E4_x_2*step_z_E4_x - l_E6_x__E4_y_2*step_z_E4_y - l_E6_x__F_x_2*step_z_F_x -
        l_E6_x__F_y_2*step_z_F_y - l_E6_x__H_x_2*step_z_H_x - l_E6_x__H_y_2*step_z_H_y + r_E6_x;
    const double step_z_E6_y = -l_E6_y__E3_x_2*step_z_E3_x - l_E6_y__E3_y_2*step_z_E3_y -
        l_E6_y__E4_x_2*step_z_E4_x - l_E6_y__E4_y_2*step_z_E4_y - l_E6_y__E6_x_2*step_z_E6_x -
        l_E6_y__F_x_2*step_z_F_x - l_E6_y__F_y_2*step_z_F_y - l_E6_y__H_x_2*step_z_H_x -
        l_E6_y__H_y_2*step_z_H_y + r_E6_y;

    /* backward substitution */
    const double step_lambda_E6_y = -inverse_pivot_E6_y_2*step_z_E6_y;
    const double step_lambda_E6_x = -inverse_pivot_E6_x_2*step_z_E6_x - l_E6_y__E6_x_2*step_lambda_E6_y;
    const double step_lambda_E4_y = -inverse_pivot_E4_y_2*step_z_E4_y - l_E6_x__E4_y_2*step_lambda_E6_x -
        l_E6_y__E4_y_2*step_lambda_E6_y;
    const double step_lambda_E4_x = -inverse_pivot_E4_x_2*step_z_E4_x - l_E4_y__E4_x_2*step_lambda_E4_y -
        l_E6_x__E4_x_2*step_lambda_E6_x - l_E6_y__E4_x_2*step_lambda_E6_y;
    const double step_lambda_E3_y = -inverse_pivot_E3_y_2*step_z_E3_y - l_E4_x__E3_y_2*step_lambda_E4_x -
        l_E4_y__E3_y_2*step_lambda_E4_y - l_E6_x__E3_y_2*step_lambda_E6_x - l_E6_y__E3_y_2*step_lambda_E6_y;
    const double step_lambda_E3_x = -inverse_pivot_E3_x_2*step_z_E3_x - l_E3_y__E3_x_2*step_lambda_E3_y -
        l_E4_x__E3_x_2*step_lambda_E4_x - l_E4_y__E3_x_2*step_lambda_E4_y - l_E6_x__E3_x_2*step_lambda_E6_x -
        l_E6_y__E3_x_2*step_lambda_E6_y;
    const double step_lambda_F_y = -inverse_pivot_F_y_2*step_z_F_y - l_E3_x__F_y_2*step_lambda_E3_x -
        l_E3_y__F_y_2*step_lambda_E3_y - l_E4_x__F_y_2*step_lambda_E4_x - l_E4_y__F_y_2*step_lambda_E4_y -
        l_E6_x__F_y_2*step_lambda_E6_x - l_E6_y__F_y_2*step_lambda_E6_y;
    const double step_lambda_F_x = -inverse_pivot_F_x_2*step_z_F_x - l_E3_x__F_x_2*step_lambda_E3_x -
        l_E3_y__F_x_2*step_lambda_E3_y - l_E4_x__F_x_2*step_lambda_E4_x - l_E4_y__F_x_2*step_lambda_E4_y -
        l_E6_x__F_x_2*step_lambda_E6_x - l_E6_y__F_x_2*step_lambda_E6_y - l_F_y__F_x_2*step_lambda_F_y;
    const double step_acceleration_FE_theta = -l_E3_x__FE_theta_2*step_lambda_E3_x -
        l_E3_y__FE_theta_2*step_lambda_E3_y - l_E4_x__FE_theta_2*step_lambda_E4_x -
        l_E4_y__FE_theta_2*step_lambda_E4_y - l_E6_x__FE_theta_2*step_lambda_E6_x -
        l_E6_y__FE_theta_2*step_lambda_E6_y - l_F_x__FE_theta_2*step_lambda_F_x -
        l_F_y__FE_theta_2*step_lambda_F_y;
    const double step_lambda_H_y = -inverse_pivot_H_y_2*step_z_H_y - l_E6_x__H_y_2*step_lambda_E6_x -
        l_E6_y__H_y_2*step_lambda_E6_y;
    const double step_lambda_H_x = -inverse_pivot_H_x_2*step_z_H_x - l_E6_x__H_x_2*step_lambda_E6_x -
        l_E6_y__H_x_2*step_lambda_E6_y - l_H_y__H_x_2*step_lambda_H_y;
    const double step_lambda_A7_y = -inverse_pivot_A7_y_2*step_z_A7_y - l_H_x__A7_y_2*step_lambda_H_x -
        l_H_y__A7_y_2*step_lambda_H_y;
    const double step_lambda_A7_x = -inverse_pivot_A7_x_2*r_A7_x - l_A7_y__A7_x_2*step_lambda_A7_y -
        l_H_x__A7_x_2*step_lambda_H_x - l_H_y__A7_x_2*step_lambda_H_y;
    const double step_acceleration_AH_theta = -l_A7_x__AH_theta_2*step_lambda_A7_x -
        l_A7_y__AH_theta_2*step_lambda_A7_y - l_H_x__AH_theta_2*step_lambda_H_x -
        l_H_y__AH_theta_2*step_lambda_H_y;
    const double step_acceleration_HE_theta = -l_E6_x__HE_theta_2*step_lambda_E6_x -
        l_E6_y__HE_theta_2*step_lambda_E6_y - l_H_x__HE_theta_2*step_lambda_H_x -
        l_H_y__HE_theta_2*step_lambda_H_y;
    const double step_lambda_G_y = -inverse_pivot_G_y_2*step_z_G_y - l_E4_x__G_y_2*step_lambda_E4_x -
        l_E4_y__G_y_2*step_lambda_E4_y;
    const double step_lambda_G_x = -inverse_pivot_G_x_2*step_z_G_x - l_E4_x__G_x_2*step_lambda_E4_x -
        l_E4_y__G_x_2*step_lambda_E4_y - l_G_y__G_x_2*step_lambda_G_y;
    const double step_lambda_A5_y = -inverse_pivot_A5_y_2*step_z_A5_y - l_G_x__A5_y_2*step_lambda_G_x -
        l_G_y__A5_y_2*step_lambda_G_y;
    const double step_lambda_A5_x = -inverse_pivot_A5_x_2*r_A5_x - l_A5_y__A5_x_2*step_lambda_A5_y -
        l_G_x__A5_x_2*step_lambda_G_x - l_G_y__A5_x_2*step_lambda_G_y;
    const double step_acceleration_AG_theta = -l_A5_x__AG_theta_2*step_lambda_A5_x -
        l_A5_y__AG_theta_2*step_lambda_A5_y - l_G_x__AG_theta_2*step_lambda_G_x -
        l_G_y__AG_theta_2*step_lambda_G_y;
    const double step_acceleration_EG_theta = -l_E4_x__EG_theta_2*step_lambda_E4_x -
        l_E4_y__EG_theta_2*step_lambda_E4_y - l_G_x__EG_theta_2*step_lambda_G_x -
        l_G_y__EG_theta_2*step_lambda_G_y;
    const double step_lambda_B_y = -inverse_pivot_B_y_2*step_z_B_y - l_E3_x__B_y_2*step_lambda_E3_x -
        l_E3_y__B_y_2*step_lambda_E3_y;
    const double step_lambda_B_x = -inverse_pivot_B_x_2*r_B_x - l_B_y__B_x_2*step_lambda_B_y -
        l_E3_x__B_x_2*step_lambda_E3_x - l_E3_y__B_x_2*step_lambda_E3_y;
    const double step_acceleration_BDE_theta = -l_B_x__BDE_theta_2*step_lambda_B_x -
        l_B_y__BDE_theta_2*step_lambda_B_y - l_E3_x__BDE_theta_2*step_lambda_E3_x -
        l_E3_y__BDE_theta_2*step_lambda_E3_y;
    const double step_acceleration_FE_y = -inverse_FE_mass*step_lambda_E3_y - inverse_FE_mass*step_lambda_E4_y
        - inverse_FE_mass*step_lambda_E6_y + inverse_FE_mass*step_lambda_F_y;
    const double step_acceleration_FE_x = -inverse_FE_mass*step_lambda_E3_x - inverse_FE_mass*step_lambda_E4_x
        - inverse_FE_mass*step_lambda_E6_x + inverse_FE_mass*step_lambda_F_x;
    const double step_lambda_O_y = -inverse_pivot_O_y_2*step_z_O_y - l_F_x__O_y_2*step_lambda_F_x -
        l_F_y__O_y_2*step_lambda_F_y;
    const double step_lambda_O_x = -inverse_pivot_O_x_2*r_O_x - l_F_x__O_x_2*step_lambda_F_x -
        l_F_y__O_x_2*step_lambda_F_y - l_O_y__O_x_2*step_lambda_O_y;
    const double step_acceleration_OF_theta = -l_F_x__OF_theta_2*step_lambda_F_x -
        l_F_y__OF_theta_2*step_lambda_F_y - l_O_x__OF_theta_2*step_lambda_O_x -
        l_O_y__OF_theta_2*step_lambda_O_y;
    const double step_acceleration_AH_y = inverse_AH_mass*step_lambda_A7_y + inverse_AH_mass*step_lambda_H_y;
    const double step_acceleration_AH_x = inverse_AH_mass*step_lambda_A7_x + inverse_AH_mass*step_lambda_H_x;
    const double step_acceleration_HE_y = inverse_HE_mass*step_lambda_E6_y - inverse_HE_mass*step_lambda_H_y;
    const double step_acceleration_HE_x = inverse_HE_mass*step_lambda_E6_x - inverse_HE_mass*step_lambda_H_x;
    const double step_acceleration_AG_y = inverse_AG_mass*step_lambda_A5_y + inverse_AG_mass*step_lambda_G_y;
    const double step_acceleration_AG_x = inverse_AG_mass*step_lambda_A5_x + inverse_AG_mass*step_lambda_G_x;
    const double step_acceleration_EG_y = inverse_EG_mass*step_lambda_E4_y - inverse_EG_mass*step_lambda_G_y;
    const double step_acceleration_EG_x = inverse_EG_mass*step_lambda_E4_x - inverse_EG_mass*step_lambda_G_x;
    const double step_acceleration_BDE_y = inverse_BDE_mass*step_lambda_B_y +
        inverse_BDE_mass*step_lambda_E3_y;
    const double step_acceleration_BDE_x = inverse_BDE_mass*step_lambda_B_x +
        inverse_BDE_mass*step_lambda_E3_x;
    const double step_acceleration_OF_y = -inverse_OF_mass*step_lambda_F_y + inverse_OF_mass*step_lambda_O_y;
    const double step_acceleration_OF_x = -inverse_OF_mass*step_lambda_F_x + inverse_OF_mass*step_lambda_O_x;

    /* results */
    x[0] = step_acceleration_OF_x;
    x[1] = step_acceleration_OF_y;
    x[2] = step_acceleration_OF_theta;
    x[3] = step_acceleration_FE_x;
    x[4] = step_acceleration_FE_y;
    x[5] = step_acceleration_FE_theta;
    x[6] = step_acceleration_BDE_x;
    x[7] = step_acceleration_BDE_y;
    x[8] = step_acceleration_BDE_theta;
    x[9] = step_acceleration_EG_x;
    x[10] = step_acceleration_EG_y;
    x[11] = step_acceleration_EG_theta;
    x[12] = step_acceleration_AG_x;
    x[13] = step_acceleration_AG_y;
    x[14] = step_acceleration_AG_theta;
    x[15] = step_acceleration_HE_x;
    x[16] = step_acceleration_HE_y;
    x[17] = step_acceleration_HE_theta;
    x[18] = step_acceleration_AH_x;
    x[19] = step_acceleration_AH_y;
    x[20] = step_acceleration_AH_theta;
    return 0;
}

