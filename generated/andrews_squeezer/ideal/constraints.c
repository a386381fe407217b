/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->OF_mass_;
    m[1] = p->OF_mass_;
    m[2] = p->OF_inertia_;
    m[3] = p->FE_mass_;
    m[4] = p->FE_mass_;
    m[5] = p->FE_inertia_;
    m[6] = p->BDE_mass_;
    m[7] = p->BDE_mass_;
    m[8] = p->BDE_inertia_;
    m[9] = p->EG_mass_;
    m[10] = p->EG_mass_;
    m[11] = p->EG_inertia_;
    m[12] = p->AG_mass_;
    m[13] = p->AG_mass_;
    m[14] = p->AG_inertia_;
    m[15] = p->HE_mass_;
    m[16] = p->HE_mass_;
    m[17] = p->HE_inertia_;
    m[18] = p->AH_mass_;
    m[19] = p->AH_mass_;
    m[20] = p->AH_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_x_ = q[0];
    const double OF_y_ = q[1];
    const double OF_theta_ = q[2];
    const double FE_x_ = q[3];
    const double FE_y_ = q[4];
    const double FE_theta_ = q[5];
    const double BDE_x_ = q[6];
    const double BDE_y_ = q[7];
    const double BDE_theta_ = q[8];
    const double EG_x_ = q[9];
    const double EG_y_ = q[10];
    const double EG_theta_ = q[11];
    const double AG_x_ = q[12];
    const double AG_y_ = q[13];
    const double AG_theta_ = q[14];
    const double HE_x_ = q[15];
    const double HE_y_ = q[16];
    const double HE_theta_ = q[17];
    const double AH_x_ = q[18];
    const double AH_y_ = q[19];
    const double AH_theta_ = q[20];

    /* directions, arms, drives */
    const double cos_theta_OF_ = cos(OF_theta_);
    const double sin_theta_OF_ = sin(OF_theta_);
    const double arm_OF_O_x_ = p->OF_points_O_x_*cos_theta_OF_;
    const double arm_OF_O_y_ = p->OF_points_O_x_*sin_theta_OF_;
    const double cos_theta_BDE_ = cos(BDE_theta_);
    const double sin_theta_BDE_ = sin(BDE_theta_);
    const double arm_BDE_B_x_ = p->BDE_points_B_x_*cos_theta_BDE_ - p->BDE_points_B_y_*sin_theta_BDE_;
    const double arm_BDE_B_y_ = p->BDE_points_B_x_*sin_theta_BDE_ + p->BDE_points_B_y_*cos_theta_BDE_;
    const double cos_theta_AG_ = cos(AG_theta_);
    const double sin_theta_AG_ = sin(AG_theta_);
    const double arm_AG_A_x_ = p->AG_points_A_x_*cos_theta_AG_ - p->AG_points_A_y_*sin_theta_AG_;
    const double arm_AG_A_y_ = p->AG_points_A_x_*sin_theta_AG_ + p->AG_points_A_y_*cos_theta_AG_;
    const double cos_theta_AH_ = cos(AH_theta_);
    const double sin_theta_AH_ = sin(AH_theta_);
    const double arm_AH_A_x_ = p->AH_points_A_x_*cos_theta_AH_ - p->AH_points_A_y_*sin_theta_AH_;
    const double arm_AH_A_y_ = p->AH_points_A_x_*sin_theta_AH_ + p->AH_points_A_y_*cos_theta_AH_;
    const double arm_OF_F_x_ = p->OF_points_F_x_*cos_theta_OF_;
    const double arm_OF_F_y_ = p->OF_points_F_x_*sin_theta_OF_;
    const double cos_theta_FE_ = cos(FE_theta_);
    const double sin_theta_FE_ = sin(FE_theta_);
    const double arm_FE_F_x_ = p->FE_points_F_x_*cos_theta_FE_;
    const double arm_FE_F_y_ = p->FE_points_F_x_*sin_theta_FE_;
    const double arm_FE_E_x_ = p->FE_points_E_x_*cos_theta_FE_;
    const double arm_FE_E_y_ = p->FE_points_E_x_*sin_theta_FE_;
    const double arm_BDE_E_x_ = p->BDE_points_E_x_*cos_theta_BDE_ - p->BDE_points_E_y_*sin_theta_BDE_;
    const double arm_BDE_E_y_ = p->BDE_points_E_x_*sin_theta_BDE_ + p->BDE_points_E_y_*cos_theta_BDE_;
    const double cos_theta_EG_ = cos(EG_theta_);
    const double sin_theta_EG_ = sin(EG_theta_);
    const double arm_EG_E_x_ = -p->EG_points_E_y_*sin_theta_EG_;
    const double arm_EG_E_y_ = p->EG_points_E_y_*cos_theta_EG_;
    const double cos_theta_HE_ = cos(HE_theta_);
    const double sin_theta_HE_ = sin(HE_theta_);
    const double arm_HE_E_x_ = p->HE_points_E_x_*cos_theta_HE_;
    const double arm_HE_E_y_ = p->HE_points_E_x_*sin_theta_HE_;
    const double arm_EG_G_x_ = -p->EG_points_G_y_*sin_theta_EG_;
    const double arm_EG_G_y_ = p->EG_points_G_y_*cos_theta_EG_;
    const double arm_AG_G_x_ = p->AG_points_G_x_*cos_theta_AG_ - p->AG_points_G_y_*sin_theta_AG_;
    const double arm_AG_G_y_ = p->AG_points_G_x_*sin_theta_AG_ + p->AG_points_G_y_*cos_theta_AG_;
    const double arm_HE_H_x_ = p->HE_points_H_x_*cos_theta_HE_;
    const double arm_HE_H_y_ = p->HE_points_H_x_*sin_theta_HE_;
    const double arm_AH_H_x_ = p->AH_points_H_x_*cos_theta_AH_ - p->AH_points_H_y_*sin_theta_AH_;
    const double arm_AH_H_y_ = p->AH_points_H_x_*sin_theta_AH_ + p->AH_points_H_y_*cos_theta_AH_;

    /* rows */
    phi[0] = -OF_x_ - arm_OF_O_x_;  /* O.x, m */
    phi[1] = -OF_y_ - arm_OF_O_y_;  /* O.y, m */
    phi[2] = -BDE_x_ + p->B_x_ - arm_BDE_B_x_;  /* B.x, m */
    phi[3] = -BDE_y_ + p->B_y_ - arm_BDE_B_y_;  /* B.y, m */
    phi[4] = -AG_x_ + p->A_x_ - arm_AG_A_x_;  /* A5.x, m */
    phi[5] = -AG_y_ + p->A_y_ - arm_AG_A_y_;  /* A5.y, m */
    phi[6] = -AH_x_ + p->A_x_ - arm_AH_A_x_;  /* A7.x, m */
    phi[7] = -AH_y_ + p->A_y_ - arm_AH_A_y_;  /* A7.y, m */
    phi[8] = -FE_x_ + OF_x_ - arm_FE_F_x_ + arm_OF_F_x_;  /* F.x, m */
    phi[9] = -FE_y_ + OF_y_ - arm_FE_F_y_ + arm_OF_F_y_;  /* F.y, m */
    phi[10] = -BDE_x_ + FE_x_ - arm_BDE_E_x_ + arm_FE_E_x_;  /* E3.x, m */
    phi[11] = -BDE_y_ + FE_y_ - arm_BDE_E_y_ + arm_FE_E_y_;  /* E3.y, m */
    phi[12] = -EG_x_ + FE_x_ - arm_EG_E_x_ + arm_FE_E_x_;  /* E4.x, m */
    phi[13] = -EG_y_ + FE_y_ - arm_EG_E_y_ + arm_FE_E_y_;  /* E4.y, m */
    phi[14] = FE_x_ - HE_x_ + arm_FE_E_x_ - arm_HE_E_x_;  /* E6.x, m */
    phi[15] = FE_y_ - HE_y_ + arm_FE_E_y_ - arm_HE_E_y_;  /* E6.y, m */
    phi[16] = -AG_x_ + EG_x_ - arm_AG_G_x_ + arm_EG_G_x_;  /* G.x, m */
    phi[17] = -AG_y_ + EG_y_ - arm_AG_G_y_ + arm_EG_G_y_;  /* G.y, m */
    phi[18] = -AH_x_ + HE_x_ - arm_AH_H_x_ + arm_HE_H_x_;  /* H.x, m */
    phi[19] = -AH_y_ + HE_y_ - arm_AH_H_y_ + arm_HE_H_y_;  /* H.y, m */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double OF_theta_ = q[2];
    const double FE_theta_ = q[5];
    const double BDE_theta_ = q[8];
    const double EG_theta_ = q[11];
    const double AG_theta_ = q[14];
    const double HE_theta_ = q[17];
    const double AH_theta_ = q[20];

    /* directions, arms, drives */
    const double cos_theta_OF_ = cos(OF_theta_);
    const double sin_theta_OF_ = sin(OF_theta_);
    const double arm_OF_O_x_ = p->OF_points_O_x_*cos_theta_OF_;
    const double arm_OF_O_y_ = p->OF_points_O_x_*sin_theta_OF_;
    const double cos_theta_BDE_ = cos(BDE_theta_);
    const double sin_theta_BDE_ = sin(BDE_theta_);
    const double arm_BDE_B_x_ = p->BDE_points_B_x_*cos_theta_BDE_ - p->BDE_points_B_y_*sin_theta_BDE_;
    const double arm_BDE_B_y_ = p->BDE_points_B_x_*sin_theta_BDE_ + p->BDE_points_B_y_*cos_theta_BDE_;
    const double cos_theta_AG_ = cos(AG_theta_);
    const double sin_theta_AG_ = sin(AG_theta_);
    const double arm_AG_A_x_ = p->AG_points_A_x_*cos_theta_AG_ - p->AG_points_A_y_*sin_theta_AG_;
    const double arm_AG_A_y_ = p->AG_points_A_x_*sin_theta_AG_ + p->AG_points_A_y_*cos_theta_AG_;
    const double cos_theta_AH_ = cos(AH_theta_);
    const double sin_theta_AH_ = sin(AH_theta_);
    const double arm_AH_A_x_ = p->AH_points_A_x_*cos_theta_AH_ - p->AH_points_A_y_*sin_theta_AH_;
    const double arm_AH_A_y_ = p->AH_points_A_x_*sin_theta_AH_ + p->AH_points_A_y_*cos_theta_AH_;
    const double arm_OF_F_x_ = p->OF_points_F_x_*cos_theta_OF_;
    const double arm_OF_F_y_ = p->OF_points_F_x_*sin_theta_OF_;
    const double cos_theta_FE_ = cos(FE_theta_);
    const double sin_theta_FE_ = sin(FE_theta_);
    const double arm_FE_F_x_ = p->FE_points_F_x_*cos_theta_FE_;
    const double arm_FE_F_y_ = p->FE_points_F_x_*sin_theta_FE_;
    const double arm_FE_E_x_ = p->FE_points_E_x_*cos_theta_FE_;
    const double arm_FE_E_y_ = p->FE_points_E_x_*sin_theta_FE_;
    const double arm_BDE_E_x_ = p->BDE_points_E_x_*cos_theta_BDE_ - p->BDE_points_E_y_*sin_theta_BDE_;
    const double arm_BDE_E_y_ = p->BDE_points_E_x_*sin_theta_BDE_ + p->BDE_points_E_y_*cos_theta_BDE_;
    const double cos_theta_EG_ = cos(EG_theta_);
    const double sin_theta_EG_ = sin(EG_theta_);
    const double arm_EG_E_x_ = -p->EG_points_E_y_*sin_theta_EG_;
    const double arm_EG_E_y_ = p->EG_points_E_y_*cos_theta_EG_;
    const double cos_theta_HE_ = cos(HE_theta_);
    const double sin_theta_HE_ = sin(HE_theta_);
    const double arm_HE_E_x_ = p->HE_points_E_x_*cos_theta_HE_;
    const double arm_HE_E_y_ = p->HE_points_E_x_*sin_theta_HE_;
    const double arm_EG_G_x_ = -p->EG_points_G_y_*sin_theta_EG_;
    const double arm_EG_G_y_ = p->EG_points_G_y_*cos_theta_EG_;
    const double arm_AG_G_x_ = p->AG_points_G_x_*cos_theta_AG_ - p->AG_points_G_y_*sin_theta_AG_;
    const double arm_AG_G_y_ = p->AG_points_G_x_*sin_theta_AG_ + p->AG_points_G_y_*cos_theta_AG_;
    const double arm_HE_H_x_ = p->HE_points_H_x_*cos_theta_HE_;
    const double arm_HE_H_y_ = p->HE_points_H_x_*sin_theta_HE_;
    const double arm_AH_H_x_ = p->AH_points_H_x_*cos_theta_AH_ - p->AH_points_H_y_*sin_theta_AH_;
    const double arm_AH_H_y_ = p->AH_points_H_x_*sin_theta_AH_ + p->AH_points_H_y_*cos_theta_AH_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O.x / d OF_x_ */
    phi_q[2] = arm_OF_O_y_;  /* d O.x / d OF_theta_ */
    phi_q[22] = -1.0;  /* d O.y / d OF_y_ */
    phi_q[23] = -arm_OF_O_x_;  /* d O.y / d OF_theta_ */
    phi_q[48] = -1.0;  /* d B.x / d BDE_x_ */
    phi_q[50] = arm_BDE_B_y_;  /* d B.x / d BDE_theta_ */
    phi_q[70] = -1.0;  /* d B.y / d BDE_y_ */
    phi_q[71] = -arm_BDE_B_x_;  /* d B.y / d BDE_theta_ */
    phi_q[96] = -1.0;  /* d A5.x / d AG_x_ */
    phi_q[98] = arm_AG_A_y_;  /* d A5.x / d AG_theta_ */
    phi_q[118] = -1.0;  /* d A5.y / d AG_y_ */
    phi_q[119] = -arm_AG_A_x_;  /* d A5.y / d AG_theta_ */
    phi_q[144] = -1.0;  /* d A7.x / d AH_x_ */
    phi_q[146] = arm_AH_A_y_;  /* d A7.x / d AH_theta_ */
    phi_q[166] = -1.0;  /* d A7.y / d AH_y_ */
    phi_q[167] = -arm_AH_A_x_;  /* d A7.y / d AH_theta_ */
    phi_q[168] = 1.0;  /* d F.x / d OF_x_ */
    phi_q[170] = -arm_OF_F_y_;  /* d F.x / d OF_theta_ */
    phi_q[171] = -1.0;  /* d F.x / d FE_x_ */
    phi_q[173] = arm_FE_F_y_;  /* d F.x / d FE_theta_ */
    phi_q[190] = 1.0;  /* d F.y / d OF_y_ */
    phi_q[191] = arm_OF_F_x_;  /* d F.y / d OF_theta_ */
    phi_q[193] = -1.0;  /* d F.y / d FE_y_ */
    phi_q[194] = -arm_FE_F_x_;  /* d F.y / d FE_theta_ */
    phi_q[213] = 1.0;  /* d E3.x / d FE_x_ */
    phi_q[215] = -arm_FE_E_y_;  /* d E3.x / d FE_theta_ */
    phi_q[216] = -1.0;  /* d E3.x / d BDE_x_ */
    phi_q[218] = arm_BDE_E_y_;  /* d E3.x / d BDE_theta_ */
    phi_q[235] = 1.0;  /* d E3.y / d FE_y_ */
    phi_q[236] = arm_FE_E_x_;  /* d E3.y / d FE_theta_ */
    phi_q[238] = -1.0;  /* d E3.y / d BDE_y_ */
    phi_q[239] = -arm_BDE_E_x_;  /* d E3.y / d BDE_theta_ */
    phi_q[255] = 1.0;  /* d E4.x / d FE_x_ */
    phi_q[257] = -arm_FE_E_y_;  /* d E4.x / d FE_theta_ */
    phi_q[261] = -1.0;  /* d E4.x / d EG_x_ */
    phi_q[263] = arm_EG_E_y_;  /* d E4.x / d EG_theta_ */
    phi_q[277] = 1.0;  /* d E4.y / d FE_y_ */
    phi_q[278] = arm_FE_E_x_;  /* d E4.y / d FE_theta_ */
    phi_q[283] = -1.0;  /* d E4.y / d EG_y_ */
    phi_q[284] = -arm_EG_E_x_;  /* d E4.y / d EG_theta_ */
    phi_q[297] = 1.0;  /* d E6.x / d FE_x_ */
    phi_q[299] = -arm_FE_E_y_;  /* d E6.x / d FE_theta_ */
    phi_q[309] = -1.0;  /* d E6.x / d HE_x_ */
    phi_q[311] = arm_HE_E_y_;  /* d E6.x / d HE_theta_ */
    phi_q[319] = 1.0;  /* d E6.y / d FE_y_ */
    phi_q[320] = arm_FE_E_x_;  /* d E6.y / d FE_theta_ */
    phi_q[331] = -1.0;  /* d E6.y / d HE_y_ */
    phi_q[332] = -arm_HE_E_x_;  /* d E6.y / d HE_theta_ */
    phi_q[345] = 1.0;  /* d G.x / d EG_x_ */
    phi_q[347] = -arm_EG_G_y_;  /* d G.x / d EG_theta_ */
    phi_q[348] = -1.0;  /* d G.x / d AG_x_ */
    phi_q[350] = arm_AG_G_y_;  /* d G.x / d AG_theta_ */
    phi_q[367] = 1.0;  /* d G.y / d EG_y_ */
    phi_q[368] = arm_EG_G_x_;  /* d G.y / d EG_theta_ */
    phi_q[370] = -1.0;  /* d G.y / d AG_y_ */
    phi_q[371] = -arm_AG_G_x_;  /* d G.y / d AG_theta_ */
    phi_q[393] = 1.0;  /* d H.x / d HE_x_ */
    phi_q[395] = -arm_HE_H_y_;  /* d H.x / d HE_theta_ */
    phi_q[396] = -1.0;  /* d H.x / d AH_x_ */
    phi_q[398] = arm_AH_H_y_;  /* d H.x / d AH_theta_ */
    phi_q[415] = 1.0;  /* d H.y / d HE_y_ */
    phi_q[416] = arm_HE_H_x_;  /* d H.y / d HE_theta_ */
    phi_q[418] = -1.0;  /* d H.y / d AH_y_ */
    phi_q[419] = -arm_AH_H_x_;  /* d H.y / d AH_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
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
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
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

    /* directions, arms, drives */
    const double cos_theta_OF_ = cos(OF_theta_);
    const double sin_theta_OF_ = sin(OF_theta_);
    const double arm_OF_O_x_ = p->OF_points_O_x_*cos_theta_OF_;
    const double arm_OF_O_y_ = p->OF_points_O_x_*sin_theta_OF_;
    const double cos_theta_BDE_ = cos(BDE_theta_);
    const double sin_theta_BDE_ = sin(BDE_theta_);
    const double arm_BDE_B_x_ = p->BDE_points_B_x_*cos_theta_BDE_ - p->BDE_points_B_y_*sin_theta_BDE_;
    const double arm_BDE_B_y_ = p->BDE_points_B_x_*sin_theta_BDE_ + p->BDE_points_B_y_*cos_theta_BDE_;
    const double cos_theta_AG_ = cos(AG_theta_);
    const double sin_theta_AG_ = sin(AG_theta_);
    const double arm_AG_A_x_ = p->AG_points_A_x_*cos_theta_AG_ - p->AG_points_A_y_*sin_theta_AG_;
    const double arm_AG_A_y_ = p->AG_points_A_x_*sin_theta_AG_ + p->AG_points_A_y_*cos_theta_AG_;
    const double cos_theta_AH_ = cos(AH_theta_);
    const double sin_theta_AH_ = sin(AH_theta_);
    const double arm_AH_A_x_ = p->AH_points_A_x_*cos_theta_AH_ - p->AH_points_A_y_*sin_theta_AH_;
    const double arm_AH_A_y_ = p->AH_points_A_x_*sin_theta_AH_ + p->AH_points_A_y_*cos_theta_AH_;
    const double arm_OF_F_x_ = p->OF_points_F_x_*cos_theta_OF_;
    const double arm_OF_F_y_ = p->OF_points_F_x_*sin_theta_OF_;
    const double cos_theta_FE_ = cos(FE_theta_);
    const double sin_theta_FE_ = sin(FE_theta_);
    const double arm_FE_F_x_ = p->FE_points_F_x_*cos_theta_FE_;
    const double arm_FE_F_y_ = p->FE_points_F_x_*sin_theta_FE_;
    const double arm_FE_E_x_ = p->FE_points_E_x_*cos_theta_FE_;
    const double arm_FE_E_y_ = p->FE_points_E_x_*sin_theta_FE_;
    const double arm_BDE_E_x_ = p->BDE_points_E_x_*cos_theta_BDE_ - p->BDE_points_E_y_*sin_theta_BDE_;
    const double arm_BDE_E_y_ = p->BDE_points_E_x_*sin_theta_BDE_ + p->BDE_points_E_y_*cos_theta_BDE_;
    const double cos_theta_EG_ = cos(EG_theta_);
    const double sin_theta_EG_ = sin(EG_theta_);
    const double arm_EG_E_x_ = -p->EG_points_E_y_*sin_theta_EG_;
    const double arm_EG_E_y_ = p->EG_points_E_y_*cos_theta_EG_;
    const double cos_theta_HE_ = cos(HE_theta_);
    const double sin_theta_HE_ = sin(HE_theta_);
    const double arm_HE_E_x_ = p->HE_points_E_x_*cos_theta_HE_;
    const double arm_HE_E_y_ = p->HE_points_E_x_*sin_theta_HE_;
    const double arm_EG_G_x_ = -p->EG_points_G_y_*sin_theta_EG_;
    const double arm_EG_G_y_ = p->EG_points_G_y_*cos_theta_EG_;
    const double arm_AG_G_x_ = p->AG_points_G_x_*cos_theta_AG_ - p->AG_points_G_y_*sin_theta_AG_;
    const double arm_AG_G_y_ = p->AG_points_G_x_*sin_theta_AG_ + p->AG_points_G_y_*cos_theta_AG_;
    const double arm_HE_H_x_ = p->HE_points_H_x_*cos_theta_HE_;
    const double arm_HE_H_y_ = p->HE_points_H_x_*sin_theta_HE_;
    const double arm_AH_H_x_ = p->AH_points_H_x_*cos_theta_AH_ - p->AH_points_H_y_*sin_theta_AH_;
    const double arm_AH_H_y_ = p->AH_points_H_x_*sin_theta_AH_ + p->AH_points_H_y_*cos_theta_AH_;

    /* rows */
    gamma_rows[0] = -(OF_omega_ * OF_omega_)*arm_OF_O_x_;  /* O.x, m/s^2 */
    gamma_rows[1] = -(OF_omega_ * OF_omega_)*arm_OF_O_y_;  /* O.y, m/s^2 */
    gamma_rows[2] = -(BDE_omega_ * BDE_omega_)*arm_BDE_B_x_;  /* B.x, m/s^2 */
    gamma_rows[3] = -(BDE_omega_ * BDE_omega_)*arm_BDE_B_y_;  /* B.y, m/s^2 */
    gamma_rows[4] = -(AG_omega_ * AG_omega_)*arm_AG_A_x_;  /* A5.x, m/s^2 */
    gamma_rows[5] = -(AG_omega_ * AG_omega_)*arm_AG_A_y_;  /* A5.y, m/s^2 */
    gamma_rows[6] = -(AH_omega_ * AH_omega_)*arm_AH_A_x_;  /* A7.x, m/s^2 */
    gamma_rows[7] = -(AH_omega_ * AH_omega_)*arm_AH_A_y_;  /* A7.y, m/s^2 */
    gamma_rows[8] = -(FE_omega_ * FE_omega_)*arm_FE_F_x_ + (OF_omega_ * OF_omega_)*arm_OF_F_x_;  /* F.x, m/s^2 */
    gamma_rows[9] = -(FE_omega_ * FE_omega_)*arm_FE_F_y_ + (OF_omega_ * OF_omega_)*arm_OF_F_y_;  /* F.y, m/s^2 */
    gamma_rows[10] = -(BDE_omega_ * BDE_omega_)*arm_BDE_E_x_ + (FE_omega_ * FE_omega_)*arm_FE_E_x_;  /* E3.x, m/s^2 */
    gamma_rows[11] = -(BDE_omega_ * BDE_omega_)*arm_BDE_E_y_ + (FE_omega_ * FE_omega_)*arm_FE_E_y_;  /* E3.y, m/s^2 */
    gamma_rows[12] = -(EG_omega_ * EG_omega_)*arm_EG_E_x_ + (FE_omega_ * FE_omega_)*arm_FE_E_x_;  /* E4.x, m/s^2 */
    gamma_rows[13] = -(EG_omega_ * EG_omega_)*arm_EG_E_y_ + (FE_omega_ * FE_omega_)*arm_FE_E_y_;  /* E4.y, m/s^2 */
    gamma_rows[14] = (FE_omega_ * FE_omega_)*arm_FE_E_x_ - (HE_omega_ * HE_omega_)*arm_HE_E_x_;  /* E6.x, m/s^2 */
    gamma_rows[15] = (FE_omega_ * FE_omega_)*arm_FE_E_y_ - (HE_omega_ * HE_omega_)*arm_HE_E_y_;  /* E6.y, m/s^2 */
    gamma_rows[16] = -(AG_omega_ * AG_omega_)*arm_AG_G_x_ + (EG_omega_ * EG_omega_)*arm_EG_G_x_;  /* G.x, m/s^2 */
    gamma_rows[17] = -(AG_omega_ * AG_omega_)*arm_AG_G_y_ + (EG_omega_ * EG_omega_)*arm_EG_G_y_;  /* G.y, m/s^2 */
    gamma_rows[18] = -(AH_omega_ * AH_omega_)*arm_AH_H_x_ + (HE_omega_ * HE_omega_)*arm_HE_H_x_;  /* H.x, m/s^2 */
    gamma_rows[19] = -(AH_omega_ * AH_omega_)*arm_AH_H_y_ + (HE_omega_ * HE_omega_)*arm_HE_H_y_;  /* H.y, m/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)rates;
    /* start */
    guess[0] = p->guess_FE_theta_;  /* start.guess.FE.theta */
    guess[1] = p->guess_BDE_theta_;  /* start.guess.BDE.theta */
    guess[2] = p->guess_EG_theta_;  /* start.guess.EG.theta */
    guess[3] = p->guess_AG_theta_;  /* start.guess.AG.theta */
    guess[4] = p->guess_HE_theta_;  /* start.guess.HE.theta */
    guess[5] = p->guess_AH_theta_;  /* start.guess.AH.theta */
    set[0] = p->set_OF_theta_;  /* start.set.OF.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)torques;
    /* coordinates, velocities, time */
    const double OF_vx_ = v[0];
    const double OF_vy_ = v[1];
    const double OF_omega_ = v[2];
    const double FE_vx_ = v[3];
    const double FE_vy_ = v[4];
    const double FE_omega_ = v[5];
    const double BDE_x_ = q[6];
    const double BDE_y_ = q[7];
    const double BDE_theta_ = q[8];
    const double BDE_vx_ = v[6];
    const double BDE_vy_ = v[7];
    const double BDE_omega_ = v[8];
    const double EG_vx_ = v[9];
    const double EG_vy_ = v[10];
    const double EG_omega_ = v[11];
    const double AG_vx_ = v[12];
    const double AG_vy_ = v[13];
    const double AG_omega_ = v[14];
    const double HE_vx_ = v[15];
    const double HE_vy_ = v[16];
    const double HE_omega_ = v[17];
    const double AH_vx_ = v[18];
    const double AH_vy_ = v[19];
    const double AH_omega_ = v[20];

    /* directions, arms, drives */
    const double cos_theta_BDE_ = cos(BDE_theta_);
    const double sin_theta_BDE_ = sin(BDE_theta_);
    const double arm_BDE_D_x_ = p->BDE_points_D_x_*cos_theta_BDE_ - p->BDE_points_D_y_*sin_theta_BDE_;
    const double arm_BDE_D_y_ = p->BDE_points_D_x_*sin_theta_BDE_ + p->BDE_points_D_y_*cos_theta_BDE_;
    const double spring_span_x_ = BDE_x_ - p->C_x_ + arm_BDE_D_x_;
    const double spring_span_y_ = BDE_y_ - p->C_y_ + arm_BDE_D_y_;
    const double spring_length_ = sqrt((spring_span_x_ * spring_span_x_) + (spring_span_y_ * spring_span_y_));
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);

    /* multipliers */
    const double multiplier_O_x_ = lambda[0];
    const double multiplier_O_y_ = lambda[1];
    const double multiplier_B_x_ = lambda[2];
    const double multiplier_B_y_ = lambda[3];
    const double multiplier_A5_x_ = lambda[4];
    const double multiplier_A5_y_ = lambda[5];
    const double multiplier_A7_x_ = lambda[6];
    const double multiplier_A7_y_ = lambda[7];
    const double multiplier_F_x_ = lambda[8];
    const double multiplier_F_y_ = lambda[9];
    const double multiplier_E3_x_ = lambda[10];
    const double multiplier_E3_y_ = lambda[11];
    const double multiplier_E4_x_ = lambda[12];
    const double multiplier_E4_y_ = lambda[13];
    const double multiplier_E6_x_ = lambda[14];
    const double multiplier_E6_y_ = lambda[15];
    const double multiplier_G_x_ = lambda[16];
    const double multiplier_G_y_ = lambda[17];
    const double multiplier_H_x_ = lambda[18];
    const double multiplier_H_y_ = lambda[19];

    /* reactions */
    reactions[0] = multiplier_O_x_;  /* O.Fx */
    reactions[1] = multiplier_O_y_;  /* O.Fy */
    reactions[2] = 0.0;  /* O.M */
    reactions[3] = multiplier_B_x_;  /* B.Fx */
    reactions[4] = multiplier_B_y_;  /* B.Fy */
    reactions[5] = 0.0;  /* B.M */
    reactions[6] = multiplier_A5_x_;  /* A5.Fx */
    reactions[7] = multiplier_A5_y_;  /* A5.Fy */
    reactions[8] = 0.0;  /* A5.M */
    reactions[9] = multiplier_A7_x_;  /* A7.Fx */
    reactions[10] = multiplier_A7_y_;  /* A7.Fy */
    reactions[11] = 0.0;  /* A7.M */
    reactions[12] = multiplier_F_x_;  /* F.Fx */
    reactions[13] = multiplier_F_y_;  /* F.Fy */
    reactions[14] = 0.0;  /* F.M */
    reactions[15] = multiplier_E3_x_;  /* E3.Fx */
    reactions[16] = multiplier_E3_y_;  /* E3.Fy */
    reactions[17] = 0.0;  /* E3.M */
    reactions[18] = multiplier_E4_x_;  /* E4.Fx */
    reactions[19] = multiplier_E4_y_;  /* E4.Fy */
    reactions[20] = 0.0;  /* E4.M */
    reactions[21] = multiplier_E6_x_;  /* E6.Fx */
    reactions[22] = multiplier_E6_y_;  /* E6.Fy */
    reactions[23] = 0.0;  /* E6.M */
    reactions[24] = multiplier_G_x_;  /* G.Fx */
    reactions[25] = multiplier_G_y_;  /* G.Fy */
    reactions[26] = 0.0;  /* G.M */
    reactions[27] = multiplier_H_x_;  /* H.Fx */
    reactions[28] = multiplier_H_y_;  /* H.Fy */
    reactions[29] = 0.0;  /* H.M */
    series[0] = spring_force_;  /* spring.F */
    series[1] = spring_length_;  /* spring.length */
    series[2] = p->motor_value_;  /* motor.M */

    /* energy */
    energy[0] = 0.5*p->AG_inertia_*(AG_omega_ * AG_omega_) + 0.5*p->AG_mass_*(AG_vx_ * AG_vx_)
        + 0.5*p->AG_mass_*(AG_vy_ * AG_vy_) + 0.5*p->AH_inertia_*(AH_omega_ * AH_omega_)
        + 0.5*p->AH_mass_*(AH_vx_ * AH_vx_) + 0.5*p->AH_mass_*(AH_vy_ * AH_vy_)
        + 0.5*p->BDE_inertia_*(BDE_omega_ * BDE_omega_) + 0.5*p->BDE_mass_*(BDE_vx_ * BDE_vx_)
        + 0.5*p->BDE_mass_*(BDE_vy_ * BDE_vy_) + 0.5*p->EG_inertia_*(EG_omega_ * EG_omega_)
        + 0.5*p->EG_mass_*(EG_vx_ * EG_vx_) + 0.5*p->EG_mass_*(EG_vy_ * EG_vy_)
        + 0.5*p->FE_inertia_*(FE_omega_ * FE_omega_) + 0.5*p->FE_mass_*(FE_vx_ * FE_vx_)
        + 0.5*p->FE_mass_*(FE_vy_ * FE_vy_) + 0.5*p->HE_inertia_*(HE_omega_ * HE_omega_)
        + 0.5*p->HE_mass_*(HE_vx_ * HE_vx_) + 0.5*p->HE_mass_*(HE_vy_ * HE_vy_)
        + 0.5*p->OF_inertia_*(OF_omega_ * OF_omega_) + 0.5*p->OF_mass_*(OF_vx_ * OF_vx_)
        + 0.5*p->OF_mass_*(OF_vy_ * OF_vy_);
    energy[1] = 0.5*p->spring_stiffness_*((-p->spring_free_length_ + spring_length_)
        * (-p->spring_free_length_ + spring_length_));
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->OF_mass_, other->OF_mass_)
        && is_same_number(p->OF_inertia_, other->OF_inertia_)
        && is_same_number(p->FE_mass_, other->FE_mass_)
        && is_same_number(p->FE_inertia_, other->FE_inertia_)
        && is_same_number(p->BDE_mass_, other->BDE_mass_)
        && is_same_number(p->BDE_inertia_, other->BDE_inertia_)
        && is_same_number(p->EG_mass_, other->EG_mass_)
        && is_same_number(p->EG_inertia_, other->EG_inertia_)
        && is_same_number(p->AG_mass_, other->AG_mass_)
        && is_same_number(p->AG_inertia_, other->AG_inertia_)
        && is_same_number(p->HE_mass_, other->HE_mass_)
        && is_same_number(p->HE_inertia_, other->HE_inertia_)
        && is_same_number(p->AH_mass_, other->AH_mass_)
        && is_same_number(p->AH_inertia_, other->AH_inertia_)
        && is_same_number(p->OF_points_O_x_, other->OF_points_O_x_)
        && is_same_number(p->OF_points_F_x_, other->OF_points_F_x_)
        && is_same_number(p->FE_points_E_x_, other->FE_points_E_x_)
        && is_same_number(p->FE_points_F_x_, other->FE_points_F_x_)
        && is_same_number(p->BDE_points_B_x_, other->BDE_points_B_x_)
        && is_same_number(p->BDE_points_B_y_, other->BDE_points_B_y_)
        && is_same_number(p->BDE_points_E_x_, other->BDE_points_E_x_)
        && is_same_number(p->BDE_points_E_y_, other->BDE_points_E_y_)
        && is_same_number(p->EG_points_G_y_, other->EG_points_G_y_)
        && is_same_number(p->EG_points_E_y_, other->EG_points_E_y_)
        && is_same_number(p->AG_points_A_x_, other->AG_points_A_x_)
        && is_same_number(p->AG_points_A_y_, other->AG_points_A_y_)
        && is_same_number(p->AG_points_G_x_, other->AG_points_G_x_)
        && is_same_number(p->AG_points_G_y_, other->AG_points_G_y_)
        && is_same_number(p->HE_points_H_x_, other->HE_points_H_x_)
        && is_same_number(p->HE_points_E_x_, other->HE_points_E_x_)
        && is_same_number(p->AH_points_A_x_, other->AH_points_A_x_)
        && is_same_number(p->AH_points_A_y_, other->AH_points_A_y_)
        && is_same_number(p->AH_points_H_x_, other->AH_points_H_x_)
        && is_same_number(p->AH_points_H_y_, other->AH_points_H_y_)
        && is_same_number(p->B_x_, other->B_x_)
        && is_same_number(p->B_y_, other->B_y_)
        && is_same_number(p->A_x_, other->A_x_)
        && is_same_number(p->A_y_, other->A_y_)
        && is_same_number(p->guess_FE_theta_, other->guess_FE_theta_)
        && is_same_number(p->guess_BDE_theta_, other->guess_BDE_theta_)
        && is_same_number(p->guess_EG_theta_, other->guess_EG_theta_)
        && is_same_number(p->guess_AG_theta_, other->guess_AG_theta_)
        && is_same_number(p->guess_HE_theta_, other->guess_HE_theta_)
        && is_same_number(p->guess_AH_theta_, other->guess_AH_theta_)
        && is_same_number(p->set_OF_theta_, other->set_OF_theta_);
}
