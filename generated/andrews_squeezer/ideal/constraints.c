/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->OF_mass;
    m[1] = p->OF_mass;
    m[2] = p->OF_inertia;
    m[3] = p->FE_mass;
    m[4] = p->FE_mass;
    m[5] = p->FE_inertia;
    m[6] = p->BDE_mass;
    m[7] = p->BDE_mass;
    m[8] = p->BDE_inertia;
    m[9] = p->EG_mass;
    m[10] = p->EG_mass;
    m[11] = p->EG_inertia;
    m[12] = p->AG_mass;
    m[13] = p->AG_mass;
    m[14] = p->AG_inertia;
    m[15] = p->HE_mass;
    m[16] = p->HE_mass;
    m[17] = p->HE_inertia;
    m[18] = p->AH_mass;
    m[19] = p->AH_mass;
    m[20] = p->AH_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
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

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = p->OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = p->OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = p->BDE_points_B_x*cos_theta_BDE - p->BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = p->BDE_points_B_x*sin_theta_BDE + p->BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = p->AG_points_A_x*cos_theta_AG - p->AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = p->AG_points_A_x*sin_theta_AG + p->AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = p->AH_points_A_x*cos_theta_AH - p->AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = p->AH_points_A_x*sin_theta_AH + p->AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = p->OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = p->OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = p->FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = p->FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = p->FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = p->FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = p->BDE_points_E_x*cos_theta_BDE - p->BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = p->BDE_points_E_x*sin_theta_BDE + p->BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -p->EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = p->EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = p->HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = p->HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -p->EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = p->EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = p->AG_points_G_x*cos_theta_AG - p->AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = p->AG_points_G_x*sin_theta_AG + p->AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = p->HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = p->HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = p->AH_points_H_x*cos_theta_AH - p->AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = p->AH_points_H_x*sin_theta_AH + p->AH_points_H_y*cos_theta_AH;

    /* rows */
    phi[0] = -OF_x - arm_OF_O_x;  /* O.x, m */
    phi[1] = -OF_y - arm_OF_O_y;  /* O.y, m */
    phi[2] = -BDE_x + p->B_x - arm_BDE_B_x;  /* B.x, m */
    phi[3] = -BDE_y + p->B_y - arm_BDE_B_y;  /* B.y, m */
    phi[4] = -AG_x + p->A_x - arm_AG_A_x;  /* A5.x, m */
    phi[5] = -AG_y + p->A_y - arm_AG_A_y;  /* A5.y, m */
    phi[6] = -AH_x + p->A_x - arm_AH_A_x;  /* A7.x, m */
    phi[7] = -AH_y + p->A_y - arm_AH_A_y;  /* A7.y, m */
    phi[8] = -FE_x + OF_x - arm_FE_F_x + arm_OF_F_x;  /* F.x, m */
    phi[9] = -FE_y + OF_y - arm_FE_F_y + arm_OF_F_y;  /* F.y, m */
    phi[10] = -BDE_x + FE_x - arm_BDE_E_x + arm_FE_E_x;  /* E3.x, m */
    phi[11] = -BDE_y + FE_y - arm_BDE_E_y + arm_FE_E_y;  /* E3.y, m */
    phi[12] = -EG_x + FE_x - arm_EG_E_x + arm_FE_E_x;  /* E4.x, m */
    phi[13] = -EG_y + FE_y - arm_EG_E_y + arm_FE_E_y;  /* E4.y, m */
    phi[14] = FE_x - HE_x + arm_FE_E_x - arm_HE_E_x;  /* E6.x, m */
    phi[15] = FE_y - HE_y + arm_FE_E_y - arm_HE_E_y;  /* E6.y, m */
    phi[16] = -AG_x + EG_x - arm_AG_G_x + arm_EG_G_x;  /* G.x, m */
    phi[17] = -AG_y + EG_y - arm_AG_G_y + arm_EG_G_y;  /* G.y, m */
    phi[18] = -AH_x + HE_x - arm_AH_H_x + arm_HE_H_x;  /* H.x, m */
    phi[19] = -AH_y + HE_y - arm_AH_H_y + arm_HE_H_y;  /* H.y, m */
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
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

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = p->OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = p->OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = p->BDE_points_B_x*cos_theta_BDE - p->BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = p->BDE_points_B_x*sin_theta_BDE + p->BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = p->AG_points_A_x*cos_theta_AG - p->AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = p->AG_points_A_x*sin_theta_AG + p->AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = p->AH_points_A_x*cos_theta_AH - p->AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = p->AH_points_A_x*sin_theta_AH + p->AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = p->OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = p->OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = p->FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = p->FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = p->FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = p->FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = p->BDE_points_E_x*cos_theta_BDE - p->BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = p->BDE_points_E_x*sin_theta_BDE + p->BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -p->EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = p->EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = p->HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = p->HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -p->EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = p->EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = p->AG_points_G_x*cos_theta_AG - p->AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = p->AG_points_G_x*sin_theta_AG + p->AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = p->HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = p->HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = p->AH_points_H_x*cos_theta_AH - p->AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = p->AH_points_H_x*sin_theta_AH + p->AH_points_H_y*cos_theta_AH;

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
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q, (void)p;
    /* rows */
    nu[0] = 0.0;  /* O.x, m/s */
    nu[1] = 0.0;  /* O.y, m/s */
    nu[2] = 0.0;  /* B.x, m/s */
    nu[3] = 0.0;  /* B.y, m/s */
    nu[4] = 0.0;  /* A5.x, m/s */
    nu[5] = 0.0;  /* A5.y, m/s */
    nu[6] = 0.0;  /* A7.x, m/s */
    nu[7] = 0.0;  /* A7.y, m/s */
    nu[8] = 0.0;  /* F.x, m/s */
    nu[9] = 0.0;  /* F.y, m/s */
    nu[10] = 0.0;  /* E3.x, m/s */
    nu[11] = 0.0;  /* E3.y, m/s */
    nu[12] = 0.0;  /* E4.x, m/s */
    nu[13] = 0.0;  /* E4.y, m/s */
    nu[14] = 0.0;  /* E6.x, m/s */
    nu[15] = 0.0;  /* E6.y, m/s */
    nu[16] = 0.0;  /* G.x, m/s */
    nu[17] = 0.0;  /* G.y, m/s */
    nu[18] = 0.0;  /* H.x, m/s */
    nu[19] = 0.0;  /* H.y, m/s */
}

/*
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
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

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double arm_OF_O_x = p->OF_points_O_x*cos_theta_OF;
    const double arm_OF_O_y = p->OF_points_O_x*sin_theta_OF;
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_B_x = p->BDE_points_B_x*cos_theta_BDE - p->BDE_points_B_y*sin_theta_BDE;
    const double arm_BDE_B_y = p->BDE_points_B_x*sin_theta_BDE + p->BDE_points_B_y*cos_theta_BDE;
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double arm_AG_A_x = p->AG_points_A_x*cos_theta_AG - p->AG_points_A_y*sin_theta_AG;
    const double arm_AG_A_y = p->AG_points_A_x*sin_theta_AG + p->AG_points_A_y*cos_theta_AG;
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double arm_AH_A_x = p->AH_points_A_x*cos_theta_AH - p->AH_points_A_y*sin_theta_AH;
    const double arm_AH_A_y = p->AH_points_A_x*sin_theta_AH + p->AH_points_A_y*cos_theta_AH;
    const double arm_OF_F_x = p->OF_points_F_x*cos_theta_OF;
    const double arm_OF_F_y = p->OF_points_F_x*sin_theta_OF;
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double arm_FE_F_x = p->FE_points_F_x*cos_theta_FE;
    const double arm_FE_F_y = p->FE_points_F_x*sin_theta_FE;
    const double arm_FE_E_x = p->FE_points_E_x*cos_theta_FE;
    const double arm_FE_E_y = p->FE_points_E_x*sin_theta_FE;
    const double arm_BDE_E_x = p->BDE_points_E_x*cos_theta_BDE - p->BDE_points_E_y*sin_theta_BDE;
    const double arm_BDE_E_y = p->BDE_points_E_x*sin_theta_BDE + p->BDE_points_E_y*cos_theta_BDE;
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
    const double arm_EG_E_x = -p->EG_points_E_y*sin_theta_EG;
    const double arm_EG_E_y = p->EG_points_E_y*cos_theta_EG;
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double arm_HE_E_x = p->HE_points_E_x*cos_theta_HE;
    const double arm_HE_E_y = p->HE_points_E_x*sin_theta_HE;
    const double arm_EG_G_x = -p->EG_points_G_y*sin_theta_EG;
    const double arm_EG_G_y = p->EG_points_G_y*cos_theta_EG;
    const double arm_AG_G_x = p->AG_points_G_x*cos_theta_AG - p->AG_points_G_y*sin_theta_AG;
    const double arm_AG_G_y = p->AG_points_G_x*sin_theta_AG + p->AG_points_G_y*cos_theta_AG;
    const double arm_HE_H_x = p->HE_points_H_x*cos_theta_HE;
    const double arm_HE_H_y = p->HE_points_H_x*sin_theta_HE;
    const double arm_AH_H_x = p->AH_points_H_x*cos_theta_AH - p->AH_points_H_y*sin_theta_AH;
    const double arm_AH_H_y = p->AH_points_H_x*sin_theta_AH + p->AH_points_H_y*cos_theta_AH;

    /* rows */
    gamma_rows[0] = -(OF_omega * OF_omega)*arm_OF_O_x;  /* O.x, m/s^2 */
    gamma_rows[1] = -(OF_omega * OF_omega)*arm_OF_O_y;  /* O.y, m/s^2 */
    gamma_rows[2] = -(BDE_omega * BDE_omega)*arm_BDE_B_x;  /* B.x, m/s^2 */
    gamma_rows[3] = -(BDE_omega * BDE_omega)*arm_BDE_B_y;  /* B.y, m/s^2 */
    gamma_rows[4] = -(AG_omega * AG_omega)*arm_AG_A_x;  /* A5.x, m/s^2 */
    gamma_rows[5] = -(AG_omega * AG_omega)*arm_AG_A_y;  /* A5.y, m/s^2 */
    gamma_rows[6] = -(AH_omega * AH_omega)*arm_AH_A_x;  /* A7.x, m/s^2 */
    gamma_rows[7] = -(AH_omega * AH_omega)*arm_AH_A_y;  /* A7.y, m/s^2 */
    gamma_rows[8] = -(FE_omega * FE_omega)*arm_FE_F_x + (OF_omega * OF_omega)*arm_OF_F_x;  /* F.x, m/s^2 */
    gamma_rows[9] = -(FE_omega * FE_omega)*arm_FE_F_y + (OF_omega * OF_omega)*arm_OF_F_y;  /* F.y, m/s^2 */
    gamma_rows[10] = -(BDE_omega * BDE_omega)*arm_BDE_E_x + (FE_omega * FE_omega)*arm_FE_E_x;  /* E3.x, m/s^2 */
    gamma_rows[11] = -(BDE_omega * BDE_omega)*arm_BDE_E_y + (FE_omega * FE_omega)*arm_FE_E_y;  /* E3.y, m/s^2 */
    gamma_rows[12] = -(EG_omega * EG_omega)*arm_EG_E_x + (FE_omega * FE_omega)*arm_FE_E_x;  /* E4.x, m/s^2 */
    gamma_rows[13] = -(EG_omega * EG_omega)*arm_EG_E_y + (FE_omega * FE_omega)*arm_FE_E_y;  /* E4.y, m/s^2 */
    gamma_rows[14] = (FE_omega * FE_omega)*arm_FE_E_x - (HE_omega * HE_omega)*arm_HE_E_x;  /* E6.x, m/s^2 */
    gamma_rows[15] = (FE_omega * FE_omega)*arm_FE_E_y - (HE_omega * HE_omega)*arm_HE_E_y;  /* E6.y, m/s^2 */
    gamma_rows[16] = -(AG_omega * AG_omega)*arm_AG_G_x + (EG_omega * EG_omega)*arm_EG_G_x;  /* G.x, m/s^2 */
    gamma_rows[17] = -(AG_omega * AG_omega)*arm_AG_G_y + (EG_omega * EG_omega)*arm_EG_G_y;  /* G.y, m/s^2 */
    gamma_rows[18] = -(AH_omega * AH_omega)*arm_AH_H_x + (HE_omega * HE_omega)*arm_HE_H_x;  /* H.x, m/s^2 */
    gamma_rows[19] = -(AH_omega * AH_omega)*arm_AH_H_y + (HE_omega * HE_omega)*arm_HE_H_y;  /* H.y, m/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)rates;
    /* start */
    guess[0] = p->guess_FE_theta;  /* start.guess.FE.theta */
    guess[1] = p->guess_BDE_theta;  /* start.guess.BDE.theta */
    guess[2] = p->guess_EG_theta;  /* start.guess.EG.theta */
    guess[3] = p->guess_AG_theta;  /* start.guess.AG.theta */
    guess[4] = p->guess_HE_theta;  /* start.guess.HE.theta */
    guess[5] = p->guess_AH_theta;  /* start.guess.AH.theta */
    set[0] = p->set_OF_theta;  /* start.set.OF.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques;
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

    /* directions, arms, drives */
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double arm_BDE_D_x = p->BDE_points_D_x*cos_theta_BDE - p->BDE_points_D_y*sin_theta_BDE;
    const double arm_BDE_D_y = p->BDE_points_D_x*sin_theta_BDE + p->BDE_points_D_y*cos_theta_BDE;
    const double spring_span_x = BDE_x - p->C_x + arm_BDE_D_x;
    const double spring_span_y = BDE_y - p->C_y + arm_BDE_D_y;
    const double spring_length = sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const double spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);

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
    series[2] = p->motor_value;  /* motor.M */

    /* energy */
    energy[0] = 0.5*p->AG_inertia*(AG_omega * AG_omega) + 0.5*p->AG_mass*(AG_vx * AG_vx)
        + 0.5*p->AG_mass*(AG_vy * AG_vy) + 0.5*p->AH_inertia*(AH_omega * AH_omega) + 0.5*p->AH_mass*(AH_vx * AH_vx)
        + 0.5*p->AH_mass*(AH_vy * AH_vy) + 0.5*p->BDE_inertia*(BDE_omega * BDE_omega)
        + 0.5*p->BDE_mass*(BDE_vx * BDE_vx) + 0.5*p->BDE_mass*(BDE_vy * BDE_vy)
        + 0.5*p->EG_inertia*(EG_omega * EG_omega) + 0.5*p->EG_mass*(EG_vx * EG_vx) + 0.5*p->EG_mass*(EG_vy * EG_vy)
        + 0.5*p->FE_inertia*(FE_omega * FE_omega) + 0.5*p->FE_mass*(FE_vx * FE_vx) + 0.5*p->FE_mass*(FE_vy * FE_vy)
        + 0.5*p->HE_inertia*(HE_omega * HE_omega) + 0.5*p->HE_mass*(HE_vx * HE_vx) + 0.5*p->HE_mass*(HE_vy * HE_vy)
        + 0.5*p->OF_inertia*(OF_omega * OF_omega) + 0.5*p->OF_mass*(OF_vx * OF_vx) + 0.5*p->OF_mass*(OF_vy * OF_vy);
    energy[1] = 0.5*p->spring_stiffness*((-p->spring_free_length + spring_length)
        * (-p->spring_free_length + spring_length));
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->OF_mass, other->OF_mass)
        && same_number(p->OF_inertia, other->OF_inertia)
        && same_number(p->FE_mass, other->FE_mass)
        && same_number(p->FE_inertia, other->FE_inertia)
        && same_number(p->BDE_mass, other->BDE_mass)
        && same_number(p->BDE_inertia, other->BDE_inertia)
        && same_number(p->EG_mass, other->EG_mass)
        && same_number(p->EG_inertia, other->EG_inertia)
        && same_number(p->AG_mass, other->AG_mass)
        && same_number(p->AG_inertia, other->AG_inertia)
        && same_number(p->HE_mass, other->HE_mass)
        && same_number(p->HE_inertia, other->HE_inertia)
        && same_number(p->AH_mass, other->AH_mass)
        && same_number(p->AH_inertia, other->AH_inertia)
        && same_number(p->OF_points_O_x, other->OF_points_O_x)
        && same_number(p->OF_points_F_x, other->OF_points_F_x)
        && same_number(p->FE_points_E_x, other->FE_points_E_x)
        && same_number(p->FE_points_F_x, other->FE_points_F_x)
        && same_number(p->BDE_points_B_x, other->BDE_points_B_x)
        && same_number(p->BDE_points_B_y, other->BDE_points_B_y)
        && same_number(p->BDE_points_E_x, other->BDE_points_E_x)
        && same_number(p->BDE_points_E_y, other->BDE_points_E_y)
        && same_number(p->EG_points_G_y, other->EG_points_G_y)
        && same_number(p->EG_points_E_y, other->EG_points_E_y)
        && same_number(p->AG_points_A_x, other->AG_points_A_x)
        && same_number(p->AG_points_A_y, other->AG_points_A_y)
        && same_number(p->AG_points_G_x, other->AG_points_G_x)
        && same_number(p->AG_points_G_y, other->AG_points_G_y)
        && same_number(p->HE_points_H_x, other->HE_points_H_x)
        && same_number(p->HE_points_E_x, other->HE_points_E_x)
        && same_number(p->AH_points_A_x, other->AH_points_A_x)
        && same_number(p->AH_points_A_y, other->AH_points_A_y)
        && same_number(p->AH_points_H_x, other->AH_points_H_x)
        && same_number(p->AH_points_H_y, other->AH_points_H_y)
        && same_number(p->B_x, other->B_x)
        && same_number(p->B_y, other->B_y)
        && same_number(p->A_x, other->A_x)
        && same_number(p->A_y, other->A_y)
        && same_number(p->guess_FE_theta, other->guess_FE_theta)
        && same_number(p->guess_BDE_theta, other->guess_BDE_theta)
        && same_number(p->guess_EG_theta, other->guess_EG_theta)
        && same_number(p->guess_AG_theta, other->guess_AG_theta)
        && same_number(p->guess_HE_theta, other->guess_HE_theta)
        && same_number(p->guess_AH_theta, other->guess_AH_theta)
        && same_number(p->set_OF_theta, other->set_OF_theta);
}
