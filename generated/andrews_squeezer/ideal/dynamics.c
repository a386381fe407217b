/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     HE.y with lambda of H.y; HE.x with lambda of H.x; EG.y with lambda of G.y; EG.x with lambda of G.x;
 *     FE.y with lambda of F.y; FE.x with lambda of F.x; AH.y with lambda of A7.y; AH.x with lambda of A7.x;
 *     AG.y with lambda of A5.y; AG.x with lambda of A5.x; BDE.y with lambda of B.y; BDE.x with lambda of B.x;
 *     OF.y with lambda of O.y; OF.x with lambda of O.x; BDE.theta; EG.theta with AG.theta;
 *     HE.theta with AH.theta; OF.theta with FE.theta; lambda of E3.x with lambda of E3.y;
 *     lambda of E4.x with lambda of E4.y; lambda of E6.x with lambda of E6.y.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double OF_x_ = q[0];
    const double OF_y_ = q[1];
    const double OF_theta_ = q[2];
    const double OF_vx_ = v[0];
    const double OF_vy_ = v[1];
    const double OF_omega_ = v[2];
    const double FE_x_ = q[3];
    const double FE_y_ = q[4];
    const double FE_theta_ = q[5];
    const double FE_vx_ = v[3];
    const double FE_vy_ = v[4];
    const double FE_omega_ = v[5];
    const double BDE_x_ = q[6];
    const double BDE_y_ = q[7];
    const double BDE_theta_ = q[8];
    const double BDE_vx_ = v[6];
    const double BDE_vy_ = v[7];
    const double BDE_omega_ = v[8];
    const double EG_x_ = q[9];
    const double EG_y_ = q[10];
    const double EG_theta_ = q[11];
    const double EG_vx_ = v[9];
    const double EG_vy_ = v[10];
    const double EG_omega_ = v[11];
    const double AG_x_ = q[12];
    const double AG_y_ = q[13];
    const double AG_theta_ = q[14];
    const double AG_vx_ = v[12];
    const double AG_vy_ = v[13];
    const double AG_omega_ = v[14];
    const double HE_x_ = q[15];
    const double HE_y_ = q[16];
    const double HE_theta_ = q[17];
    const double HE_vx_ = v[15];
    const double HE_vy_ = v[16];
    const double HE_omega_ = v[17];
    const double AH_x_ = q[18];
    const double AH_y_ = q[19];
    const double AH_theta_ = q[20];
    const double AH_vx_ = v[18];
    const double AH_vy_ = v[19];
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
    const double arm_BDE_D_x_ = p->BDE_points_D_x_*cos_theta_BDE_ - p->BDE_points_D_y_*sin_theta_BDE_;
    const double arm_BDE_D_y_ = p->BDE_points_D_x_*sin_theta_BDE_ + p->BDE_points_D_y_*cos_theta_BDE_;
    const double spring_span_x_ = BDE_x_ - p->C_x_ + arm_BDE_D_x_;
    const double spring_span_y_ = BDE_y_ - p->C_y_ + arm_BDE_D_y_;
    const double spring_length_ = sqrt((spring_span_x_ * spring_span_x_) + (spring_span_y_ * spring_span_y_));
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const double spring_pull_ = spring_force_/spring_length_;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x_ = -OF_x_ - arm_OF_O_x_;
    const double phi_dot_O_x_ = OF_omega_*arm_OF_O_y_ - OF_vx_;
    const double rhs_O_x_ = -(OF_omega_ * OF_omega_)*arm_OF_O_x_ - p->beta_squared_*phi_O_x_
        - phi_dot_O_x_*p->two_alpha_;
    rhs->phi[0] = phi_O_x_;
    rhs->phi_dot[0] = phi_dot_O_x_;
    const double phi_O_y_ = -OF_y_ - arm_OF_O_y_;
    const double phi_dot_O_y_ = -OF_omega_*arm_OF_O_x_ - OF_vy_;
    const double rhs_O_y_ = -(OF_omega_ * OF_omega_)*arm_OF_O_y_ - p->beta_squared_*phi_O_y_
        - phi_dot_O_y_*p->two_alpha_;
    rhs->phi[1] = phi_O_y_;
    rhs->phi_dot[1] = phi_dot_O_y_;
    const double phi_B_x_ = -BDE_x_ + p->B_x_ - arm_BDE_B_x_;
    const double phi_dot_B_x_ = BDE_omega_*arm_BDE_B_y_ - BDE_vx_;
    const double rhs_B_x_ = -(BDE_omega_ * BDE_omega_)*arm_BDE_B_x_ - p->beta_squared_*phi_B_x_
        - phi_dot_B_x_*p->two_alpha_;
    rhs->phi[2] = phi_B_x_;
    rhs->phi_dot[2] = phi_dot_B_x_;
    const double phi_B_y_ = -BDE_y_ + p->B_y_ - arm_BDE_B_y_;
    const double phi_dot_B_y_ = -BDE_omega_*arm_BDE_B_x_ - BDE_vy_;
    const double rhs_B_y_ = -(BDE_omega_ * BDE_omega_)*arm_BDE_B_y_ - p->beta_squared_*phi_B_y_
        - phi_dot_B_y_*p->two_alpha_;
    rhs->phi[3] = phi_B_y_;
    rhs->phi_dot[3] = phi_dot_B_y_;
    const double phi_A5_x_ = -AG_x_ + p->A_x_ - arm_AG_A_x_;
    const double phi_dot_A5_x_ = AG_omega_*arm_AG_A_y_ - AG_vx_;
    const double rhs_A5_x_ = -(AG_omega_ * AG_omega_)*arm_AG_A_x_ - p->beta_squared_*phi_A5_x_
        - phi_dot_A5_x_*p->two_alpha_;
    rhs->phi[4] = phi_A5_x_;
    rhs->phi_dot[4] = phi_dot_A5_x_;
    const double phi_A5_y_ = -AG_y_ + p->A_y_ - arm_AG_A_y_;
    const double phi_dot_A5_y_ = -AG_omega_*arm_AG_A_x_ - AG_vy_;
    const double rhs_A5_y_ = -(AG_omega_ * AG_omega_)*arm_AG_A_y_ - p->beta_squared_*phi_A5_y_
        - phi_dot_A5_y_*p->two_alpha_;
    rhs->phi[5] = phi_A5_y_;
    rhs->phi_dot[5] = phi_dot_A5_y_;
    const double phi_A7_x_ = -AH_x_ + p->A_x_ - arm_AH_A_x_;
    const double phi_dot_A7_x_ = AH_omega_*arm_AH_A_y_ - AH_vx_;
    const double rhs_A7_x_ = -(AH_omega_ * AH_omega_)*arm_AH_A_x_ - p->beta_squared_*phi_A7_x_
        - phi_dot_A7_x_*p->two_alpha_;
    rhs->phi[6] = phi_A7_x_;
    rhs->phi_dot[6] = phi_dot_A7_x_;
    const double phi_A7_y_ = -AH_y_ + p->A_y_ - arm_AH_A_y_;
    const double phi_dot_A7_y_ = -AH_omega_*arm_AH_A_x_ - AH_vy_;
    const double rhs_A7_y_ = -(AH_omega_ * AH_omega_)*arm_AH_A_y_ - p->beta_squared_*phi_A7_y_
        - phi_dot_A7_y_*p->two_alpha_;
    rhs->phi[7] = phi_A7_y_;
    rhs->phi_dot[7] = phi_dot_A7_y_;
    const double phi_F_x_ = -FE_x_ + OF_x_ - arm_FE_F_x_ + arm_OF_F_x_;
    const double phi_dot_F_x_ = FE_omega_*arm_FE_F_y_ - FE_vx_ - OF_omega_*arm_OF_F_y_ + OF_vx_;
    const double rhs_F_x_ = -(FE_omega_ * FE_omega_)*arm_FE_F_x_ + (OF_omega_ * OF_omega_)*arm_OF_F_x_
        - p->beta_squared_*phi_F_x_ - phi_dot_F_x_*p->two_alpha_;
    rhs->phi[8] = phi_F_x_;
    rhs->phi_dot[8] = phi_dot_F_x_;
    const double phi_F_y_ = -FE_y_ + OF_y_ - arm_FE_F_y_ + arm_OF_F_y_;
    const double phi_dot_F_y_ = -FE_omega_*arm_FE_F_x_ - FE_vy_ + OF_omega_*arm_OF_F_x_ + OF_vy_;
    const double rhs_F_y_ = -(FE_omega_ * FE_omega_)*arm_FE_F_y_ + (OF_omega_ * OF_omega_)*arm_OF_F_y_
        - p->beta_squared_*phi_F_y_ - phi_dot_F_y_*p->two_alpha_;
    rhs->phi[9] = phi_F_y_;
    rhs->phi_dot[9] = phi_dot_F_y_;
    const double phi_E3_x_ = -BDE_x_ + FE_x_ - arm_BDE_E_x_ + arm_FE_E_x_;
    const double phi_dot_E3_x_ = BDE_omega_*arm_BDE_E_y_ - BDE_vx_ - FE_omega_*arm_FE_E_y_ + FE_vx_;
    const double rhs_E3_x_ = -(BDE_omega_ * BDE_omega_)*arm_BDE_E_x_ + (FE_omega_ * FE_omega_)*arm_FE_E_x_
        - p->beta_squared_*phi_E3_x_ - phi_dot_E3_x_*p->two_alpha_;
    rhs->phi[10] = phi_E3_x_;
    rhs->phi_dot[10] = phi_dot_E3_x_;
    const double phi_E3_y_ = -BDE_y_ + FE_y_ - arm_BDE_E_y_ + arm_FE_E_y_;
    const double phi_dot_E3_y_ = -BDE_omega_*arm_BDE_E_x_ - BDE_vy_ + FE_omega_*arm_FE_E_x_ + FE_vy_;
    const double rhs_E3_y_ = -(BDE_omega_ * BDE_omega_)*arm_BDE_E_y_ + (FE_omega_ * FE_omega_)*arm_FE_E_y_
        - p->beta_squared_*phi_E3_y_ - phi_dot_E3_y_*p->two_alpha_;
    rhs->phi[11] = phi_E3_y_;
    rhs->phi_dot[11] = phi_dot_E3_y_;
    const double phi_E4_x_ = -EG_x_ + FE_x_ - arm_EG_E_x_ + arm_FE_E_x_;
    const double phi_dot_E4_x_ = EG_omega_*arm_EG_E_y_ - EG_vx_ - FE_omega_*arm_FE_E_y_ + FE_vx_;
    const double rhs_E4_x_ = -(EG_omega_ * EG_omega_)*arm_EG_E_x_ + (FE_omega_ * FE_omega_)*arm_FE_E_x_
        - p->beta_squared_*phi_E4_x_ - phi_dot_E4_x_*p->two_alpha_;
    rhs->phi[12] = phi_E4_x_;
    rhs->phi_dot[12] = phi_dot_E4_x_;
    const double phi_E4_y_ = -EG_y_ + FE_y_ - arm_EG_E_y_ + arm_FE_E_y_;
    const double phi_dot_E4_y_ = -EG_omega_*arm_EG_E_x_ - EG_vy_ + FE_omega_*arm_FE_E_x_ + FE_vy_;
    const double rhs_E4_y_ = -(EG_omega_ * EG_omega_)*arm_EG_E_y_ + (FE_omega_ * FE_omega_)*arm_FE_E_y_
        - p->beta_squared_*phi_E4_y_ - phi_dot_E4_y_*p->two_alpha_;
    rhs->phi[13] = phi_E4_y_;
    rhs->phi_dot[13] = phi_dot_E4_y_;
    const double phi_E6_x_ = FE_x_ - HE_x_ + arm_FE_E_x_ - arm_HE_E_x_;
    const double phi_dot_E6_x_ = -FE_omega_*arm_FE_E_y_ + FE_vx_ + HE_omega_*arm_HE_E_y_ - HE_vx_;
    const double rhs_E6_x_ = (FE_omega_ * FE_omega_)*arm_FE_E_x_ - (HE_omega_ * HE_omega_)*arm_HE_E_x_
        - p->beta_squared_*phi_E6_x_ - phi_dot_E6_x_*p->two_alpha_;
    rhs->phi[14] = phi_E6_x_;
    rhs->phi_dot[14] = phi_dot_E6_x_;
    const double phi_E6_y_ = FE_y_ - HE_y_ + arm_FE_E_y_ - arm_HE_E_y_;
    const double phi_dot_E6_y_ = FE_omega_*arm_FE_E_x_ + FE_vy_ - HE_omega_*arm_HE_E_x_ - HE_vy_;
    const double rhs_E6_y_ = (FE_omega_ * FE_omega_)*arm_FE_E_y_ - (HE_omega_ * HE_omega_)*arm_HE_E_y_
        - p->beta_squared_*phi_E6_y_ - phi_dot_E6_y_*p->two_alpha_;
    rhs->phi[15] = phi_E6_y_;
    rhs->phi_dot[15] = phi_dot_E6_y_;
    const double phi_G_x_ = -AG_x_ + EG_x_ - arm_AG_G_x_ + arm_EG_G_x_;
    const double phi_dot_G_x_ = AG_omega_*arm_AG_G_y_ - AG_vx_ - EG_omega_*arm_EG_G_y_ + EG_vx_;
    const double rhs_G_x_ = -(AG_omega_ * AG_omega_)*arm_AG_G_x_ + (EG_omega_ * EG_omega_)*arm_EG_G_x_
        - p->beta_squared_*phi_G_x_ - phi_dot_G_x_*p->two_alpha_;
    rhs->phi[16] = phi_G_x_;
    rhs->phi_dot[16] = phi_dot_G_x_;
    const double phi_G_y_ = -AG_y_ + EG_y_ - arm_AG_G_y_ + arm_EG_G_y_;
    const double phi_dot_G_y_ = -AG_omega_*arm_AG_G_x_ - AG_vy_ + EG_omega_*arm_EG_G_x_ + EG_vy_;
    const double rhs_G_y_ = -(AG_omega_ * AG_omega_)*arm_AG_G_y_ + (EG_omega_ * EG_omega_)*arm_EG_G_y_
        - p->beta_squared_*phi_G_y_ - phi_dot_G_y_*p->two_alpha_;
    rhs->phi[17] = phi_G_y_;
    rhs->phi_dot[17] = phi_dot_G_y_;
    const double phi_H_x_ = -AH_x_ + HE_x_ - arm_AH_H_x_ + arm_HE_H_x_;
    const double phi_dot_H_x_ = AH_omega_*arm_AH_H_y_ - AH_vx_ - HE_omega_*arm_HE_H_y_ + HE_vx_;
    const double rhs_H_x_ = -(AH_omega_ * AH_omega_)*arm_AH_H_x_ + (HE_omega_ * HE_omega_)*arm_HE_H_x_
        - p->beta_squared_*phi_H_x_ - phi_dot_H_x_*p->two_alpha_;
    rhs->phi[18] = phi_H_x_;
    rhs->phi_dot[18] = phi_dot_H_x_;
    const double phi_H_y_ = -AH_y_ + HE_y_ - arm_AH_H_y_ + arm_HE_H_y_;
    const double phi_dot_H_y_ = -AH_omega_*arm_AH_H_x_ - AH_vy_ + HE_omega_*arm_HE_H_x_ + HE_vy_;
    const double rhs_H_y_ = -(AH_omega_ * AH_omega_)*arm_AH_H_y_ + (HE_omega_ * HE_omega_)*arm_HE_H_y_
        - p->beta_squared_*phi_H_y_ - phi_dot_H_y_*p->two_alpha_;
    rhs->phi[19] = phi_H_y_;
    rhs->phi_dot[19] = phi_dot_H_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_HE_theta_H_y_ = -p->HE_mass_*arm_HE_H_x_;
    const double l_AH_theta_H_y_ = p->HE_mass_*arm_AH_H_x_;
    const double l_HE_theta_H_x_ = p->HE_mass_*arm_HE_H_y_;
    const double l_AH_theta_H_x_ = -p->HE_mass_*arm_AH_H_y_;
    const double l_EG_theta_G_y_ = -p->EG_mass_*arm_EG_G_x_;
    const double l_AG_theta_G_y_ = p->EG_mass_*arm_AG_G_x_;
    const double l_EG_theta_G_x_ = p->EG_mass_*arm_EG_G_y_;
    const double l_AG_theta_G_x_ = -p->EG_mass_*arm_AG_G_y_;
    const double l_OF_theta_F_y_ = -p->FE_mass_*arm_OF_F_x_;
    const double l_FE_theta_F_y_ = p->FE_mass_*arm_FE_F_x_;
    const double l_OF_theta_F_x_ = p->FE_mass_*arm_OF_F_y_;
    const double l_FE_theta_F_x_ = -p->FE_mass_*arm_FE_F_y_;
    const double inertia_AH_y_ = p->AH_mass_ + p->HE_mass_;
    const double l_AH_theta_A7_y_ = arm_AH_A_x_*inertia_AH_y_ - l_AH_theta_H_y_;
    const double inertia_AH_x_ = p->AH_mass_ + p->HE_mass_;
    const double l_AH_theta_A7_x_ = -arm_AH_A_y_*inertia_AH_x_ - l_AH_theta_H_x_;
    const double inertia_AG_y_ = p->AG_mass_ + p->EG_mass_;
    const double l_AG_theta_A5_y_ = arm_AG_A_x_*inertia_AG_y_ - l_AG_theta_G_y_;
    const double inertia_AG_x_ = p->AG_mass_ + p->EG_mass_;
    const double l_AG_theta_A5_x_ = -arm_AG_A_y_*inertia_AG_x_ - l_AG_theta_G_x_;
    const double l_BDE_theta_B_y_ = p->BDE_mass_*arm_BDE_B_x_;
    const double l_BDE_theta_B_x_ = -p->BDE_mass_*arm_BDE_B_y_;
    const double inertia_OF_y_ = p->FE_mass_ + p->OF_mass_;
    const double l_OF_theta_O_y_ = arm_OF_O_x_*inertia_OF_y_ + l_OF_theta_F_y_;
    const double inertia_OF_x_ = p->FE_mass_ + p->OF_mass_;
    const double l_OF_theta_O_x_ = -arm_OF_O_y_*inertia_OF_x_ + l_OF_theta_F_x_;
    const double pivot_BDE_theta_ = p->BDE_inertia_ + arm_BDE_B_x_*l_BDE_theta_B_y_ - arm_BDE_B_y_*l_BDE_theta_B_x_;
    if (!(pivot_BDE_theta_ > LIGHT_PIVOT * p->BDE_turning_)) {
        pivot = 21;
        goto dependent;
    }
    const double inverse_pivot_BDE_theta_ = 1.0/pivot_BDE_theta_;
    const double w_E3_x_BDE_theta_ = -arm_BDE_B_y_ + arm_BDE_E_y_;
    const double l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*w_E3_x_BDE_theta_;
    const double w_E3_y_BDE_theta_ = arm_BDE_B_x_ - arm_BDE_E_x_;
    const double l_E3_y_BDE_theta_ = inverse_pivot_BDE_theta_*w_E3_y_BDE_theta_;
    const double pivot_EG_theta_ = p->EG_inertia_ - arm_EG_G_x_*l_EG_theta_G_y_ + arm_EG_G_y_*l_EG_theta_G_x_;
    const double pivot_AG_theta_ = p->AG_inertia_ + arm_AG_A_x_*l_AG_theta_A5_y_ - arm_AG_A_x_*l_AG_theta_G_y_
        - arm_AG_A_y_*l_AG_theta_A5_x_ + arm_AG_A_y_*l_AG_theta_G_x_ + arm_AG_G_x_*l_AG_theta_G_y_
        - arm_AG_G_y_*l_AG_theta_G_x_;
    const double pivot_EG_theta_AG_theta_ = -arm_AG_A_x_*l_EG_theta_G_y_ + arm_AG_A_y_*l_EG_theta_G_x_
        - arm_EG_G_x_*l_AG_theta_G_y_ + arm_EG_G_y_*l_AG_theta_G_x_;
    const double determinant_EG_theta_AG_theta_ = pivot_AG_theta_*pivot_EG_theta_
        - (pivot_EG_theta_AG_theta_ * pivot_EG_theta_AG_theta_);
    if (!(pivot_EG_theta_ > LIGHT_PIVOT * p->EG_turning_)) {
        pivot = 22;
        goto dependent;
    }
    if (!(determinant_EG_theta_AG_theta_ > LIGHT_PIVOT * p->AG_turning_ * pivot_EG_theta_)) {
        pivot = 23;
        goto dependent;
    }
    const double inverse_EG_theta_AG_theta_ = 1.0/determinant_EG_theta_AG_theta_;
    const double inverse_pivot_EG_theta_ = inverse_EG_theta_AG_theta_*pivot_AG_theta_;
    const double inverse_pivot_AG_theta_ = inverse_EG_theta_AG_theta_*pivot_EG_theta_;
    const double inverse_cross_EG_theta_AG_theta_ = -inverse_EG_theta_AG_theta_*pivot_EG_theta_AG_theta_;
    const double w_E4_x_EG_theta_ = arm_EG_E_y_ - arm_EG_G_y_;
    const double w_E4_x_AG_theta_ = -arm_AG_A_y_ + arm_AG_G_y_;
    const double l_E4_x_EG_theta_ = inverse_cross_EG_theta_AG_theta_*w_E4_x_AG_theta_
        + inverse_pivot_EG_theta_*w_E4_x_EG_theta_;
    const double l_E4_x_AG_theta_ = inverse_cross_EG_theta_AG_theta_*w_E4_x_EG_theta_
        + inverse_pivot_AG_theta_*w_E4_x_AG_theta_;
    const double w_E4_y_EG_theta_ = -arm_EG_E_x_ + arm_EG_G_x_;
    const double w_E4_y_AG_theta_ = arm_AG_A_x_ - arm_AG_G_x_;
    const double l_E4_y_EG_theta_ = inverse_cross_EG_theta_AG_theta_*w_E4_y_AG_theta_
        + inverse_pivot_EG_theta_*w_E4_y_EG_theta_;
    const double l_E4_y_AG_theta_ = inverse_cross_EG_theta_AG_theta_*w_E4_y_EG_theta_
        + inverse_pivot_AG_theta_*w_E4_y_AG_theta_;
    const double pivot_HE_theta_ = p->HE_inertia_ - arm_HE_H_x_*l_HE_theta_H_y_ + arm_HE_H_y_*l_HE_theta_H_x_;
    const double pivot_AH_theta_ = p->AH_inertia_ + arm_AH_A_x_*l_AH_theta_A7_y_ - arm_AH_A_x_*l_AH_theta_H_y_
        - arm_AH_A_y_*l_AH_theta_A7_x_ + arm_AH_A_y_*l_AH_theta_H_x_ + arm_AH_H_x_*l_AH_theta_H_y_
        - arm_AH_H_y_*l_AH_theta_H_x_;
    const double pivot_HE_theta_AH_theta_ = -arm_AH_A_x_*l_HE_theta_H_y_ + arm_AH_A_y_*l_HE_theta_H_x_
        - arm_HE_H_x_*l_AH_theta_H_y_ + arm_HE_H_y_*l_AH_theta_H_x_;
    const double determinant_HE_theta_AH_theta_ = pivot_AH_theta_*pivot_HE_theta_
        - (pivot_HE_theta_AH_theta_ * pivot_HE_theta_AH_theta_);
    if (!(pivot_HE_theta_ > LIGHT_PIVOT * p->HE_turning_)) {
        pivot = 24;
        goto dependent;
    }
    if (!(determinant_HE_theta_AH_theta_ > LIGHT_PIVOT * p->AH_turning_ * pivot_HE_theta_)) {
        pivot = 25;
        goto dependent;
    }
    const double inverse_HE_theta_AH_theta_ = 1.0/determinant_HE_theta_AH_theta_;
    const double inverse_pivot_HE_theta_ = inverse_HE_theta_AH_theta_*pivot_AH_theta_;
    const double inverse_pivot_AH_theta_ = inverse_HE_theta_AH_theta_*pivot_HE_theta_;
    const double inverse_cross_HE_theta_AH_theta_ = -inverse_HE_theta_AH_theta_*pivot_HE_theta_AH_theta_;
    const double w_E6_x_HE_theta_ = arm_HE_E_y_ - arm_HE_H_y_;
    const double w_E6_x_AH_theta_ = -arm_AH_A_y_ + arm_AH_H_y_;
    const double l_E6_x_HE_theta_ = inverse_cross_HE_theta_AH_theta_*w_E6_x_AH_theta_
        + inverse_pivot_HE_theta_*w_E6_x_HE_theta_;
    const double l_E6_x_AH_theta_ = inverse_cross_HE_theta_AH_theta_*w_E6_x_HE_theta_
        + inverse_pivot_AH_theta_*w_E6_x_AH_theta_;
    const double w_E6_y_HE_theta_ = -arm_HE_E_x_ + arm_HE_H_x_;
    const double w_E6_y_AH_theta_ = arm_AH_A_x_ - arm_AH_H_x_;
    const double l_E6_y_HE_theta_ = inverse_cross_HE_theta_AH_theta_*w_E6_y_AH_theta_
        + inverse_pivot_HE_theta_*w_E6_y_HE_theta_;
    const double l_E6_y_AH_theta_ = inverse_cross_HE_theta_AH_theta_*w_E6_y_HE_theta_
        + inverse_pivot_AH_theta_*w_E6_y_AH_theta_;
    const double pivot_OF_theta_ = p->OF_inertia_ - arm_OF_F_x_*l_OF_theta_F_y_ + arm_OF_F_y_*l_OF_theta_F_x_
        + arm_OF_O_x_*l_OF_theta_F_y_ + arm_OF_O_x_*l_OF_theta_O_y_ - arm_OF_O_y_*l_OF_theta_F_x_
        - arm_OF_O_y_*l_OF_theta_O_x_;
    const double pivot_FE_theta_ = p->FE_inertia_ + arm_FE_F_x_*l_FE_theta_F_y_ - arm_FE_F_y_*l_FE_theta_F_x_;
    const double pivot_OF_theta_FE_theta_ = -arm_OF_F_x_*l_FE_theta_F_y_ + arm_OF_F_y_*l_FE_theta_F_x_
        + arm_OF_O_x_*l_FE_theta_F_y_ - arm_OF_O_y_*l_FE_theta_F_x_;
    const double determinant_OF_theta_FE_theta_ = pivot_FE_theta_*pivot_OF_theta_
        - (pivot_OF_theta_FE_theta_ * pivot_OF_theta_FE_theta_);
    if (!(pivot_OF_theta_ > LIGHT_PIVOT * p->OF_turning_)) {
        pivot = 26;
        goto dependent;
    }
    if (!(determinant_OF_theta_FE_theta_ > LIGHT_PIVOT * p->FE_turning_ * pivot_OF_theta_)) {
        pivot = 27;
        goto dependent;
    }
    const double inverse_OF_theta_FE_theta_ = 1.0/determinant_OF_theta_FE_theta_;
    const double inverse_pivot_OF_theta_ = inverse_OF_theta_FE_theta_*pivot_FE_theta_;
    const double inverse_pivot_FE_theta_ = inverse_OF_theta_FE_theta_*pivot_OF_theta_;
    const double inverse_cross_OF_theta_FE_theta_ = -inverse_OF_theta_FE_theta_*pivot_OF_theta_FE_theta_;
    const double w_E3_x_OF_theta_ = -arm_OF_F_y_ + arm_OF_O_y_;
    const double w_E3_x_FE_theta_ = -arm_FE_E_y_ + arm_FE_F_y_;
    const double l_E3_x_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E3_x_FE_theta_
        + inverse_pivot_OF_theta_*w_E3_x_OF_theta_;
    const double l_E3_x_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E3_x_OF_theta_
        + inverse_pivot_FE_theta_*w_E3_x_FE_theta_;
    const double w_E3_y_OF_theta_ = arm_OF_F_x_ - arm_OF_O_x_;
    const double w_E3_y_FE_theta_ = arm_FE_E_x_ - arm_FE_F_x_;
    const double l_E3_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E3_y_FE_theta_
        + inverse_pivot_OF_theta_*w_E3_y_OF_theta_;
    const double l_E3_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E3_y_OF_theta_
        + inverse_pivot_FE_theta_*w_E3_y_FE_theta_;
    const double w_E4_x_OF_theta_ = -arm_OF_F_y_ + arm_OF_O_y_;
    const double w_E4_x_FE_theta_ = -arm_FE_E_y_ + arm_FE_F_y_;
    const double l_E4_x_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E4_x_FE_theta_
        + inverse_pivot_OF_theta_*w_E4_x_OF_theta_;
    const double l_E4_x_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E4_x_OF_theta_
        + inverse_pivot_FE_theta_*w_E4_x_FE_theta_;
    const double w_E4_y_OF_theta_ = arm_OF_F_x_ - arm_OF_O_x_;
    const double w_E4_y_FE_theta_ = arm_FE_E_x_ - arm_FE_F_x_;
    const double l_E4_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E4_y_FE_theta_
        + inverse_pivot_OF_theta_*w_E4_y_OF_theta_;
    const double l_E4_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E4_y_OF_theta_
        + inverse_pivot_FE_theta_*w_E4_y_FE_theta_;
    const double w_E6_x_OF_theta_ = -arm_OF_F_y_ + arm_OF_O_y_;
    const double w_E6_x_FE_theta_ = -arm_FE_E_y_ + arm_FE_F_y_;
    const double l_E6_x_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E6_x_FE_theta_
        + inverse_pivot_OF_theta_*w_E6_x_OF_theta_;
    const double l_E6_x_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E6_x_OF_theta_
        + inverse_pivot_FE_theta_*w_E6_x_FE_theta_;
    const double w_E6_y_OF_theta_ = arm_OF_F_x_ - arm_OF_O_x_;
    const double w_E6_y_FE_theta_ = arm_FE_E_x_ - arm_FE_F_x_;
    const double l_E6_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_E6_y_FE_theta_
        + inverse_pivot_OF_theta_*w_E6_y_OF_theta_;
    const double l_E6_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_E6_y_OF_theta_
        + inverse_pivot_FE_theta_*w_E6_y_FE_theta_;
    const double scale_E3_x_ = l_E3_x_BDE_theta_*w_E3_x_BDE_theta_ + l_E3_x_FE_theta_*w_E3_x_FE_theta_
        + l_E3_x_OF_theta_*w_E3_x_OF_theta_;
    const double scale_E3_y_ = l_E3_y_BDE_theta_*w_E3_y_BDE_theta_ + l_E3_y_FE_theta_*w_E3_y_FE_theta_
        + l_E3_y_OF_theta_*w_E3_y_OF_theta_;
    const double size_E3_x_ = p->mobility_E3_x_ + scale_E3_x_;
    const double size_E3_y_ = p->mobility_E3_x_ + scale_E3_y_;
    const double pivot_E3_x_E3_y_ = l_E3_y_BDE_theta_*w_E3_x_BDE_theta_ + l_E3_y_FE_theta_*w_E3_x_FE_theta_
        + l_E3_y_OF_theta_*w_E3_x_OF_theta_;
    const double determinant_E3_x_E3_y_ = -(pivot_E3_x_E3_y_ * pivot_E3_x_E3_y_) + scale_E3_x_*scale_E3_y_;
    if (!(scale_E3_x_ > discrete->min_pivot * size_E3_x_)) {
        pivot = 15;
        goto dependent;
    }
    if (!(determinant_E3_x_E3_y_ > discrete->min_pivot * size_E3_y_ * scale_E3_x_)) {
        pivot = 16;
        goto dependent;
    }
    const double inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const double inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*scale_E3_y_;
    const double inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*scale_E3_x_;
    const double inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;
    const double w_E4_x_E3_x_ = -l_E4_x_FE_theta_*w_E3_x_FE_theta_ - l_E4_x_OF_theta_*w_E3_x_OF_theta_;
    const double w_E4_x_E3_y_ = -l_E4_x_FE_theta_*w_E3_y_FE_theta_ - l_E4_x_OF_theta_*w_E3_y_OF_theta_;
    const double l_E4_x_E3_x_ = inverse_cross_E3_x_E3_y_*w_E4_x_E3_y_ + inverse_pivot_E3_x_*w_E4_x_E3_x_;
    const double l_E4_x_E3_y_ = inverse_cross_E3_x_E3_y_*w_E4_x_E3_x_ + inverse_pivot_E3_y_*w_E4_x_E3_y_;
    const double w_E4_y_E3_x_ = -l_E4_y_FE_theta_*w_E3_x_FE_theta_ - l_E4_y_OF_theta_*w_E3_x_OF_theta_;
    const double w_E4_y_E3_y_ = -l_E4_y_FE_theta_*w_E3_y_FE_theta_ - l_E4_y_OF_theta_*w_E3_y_OF_theta_;
    const double l_E4_y_E3_x_ = inverse_cross_E3_x_E3_y_*w_E4_y_E3_y_ + inverse_pivot_E3_x_*w_E4_y_E3_x_;
    const double l_E4_y_E3_y_ = inverse_cross_E3_x_E3_y_*w_E4_y_E3_x_ + inverse_pivot_E3_y_*w_E4_y_E3_y_;
    const double w_E6_x_E3_x_ = -l_E6_x_FE_theta_*w_E3_x_FE_theta_ - l_E6_x_OF_theta_*w_E3_x_OF_theta_;
    const double w_E6_x_E3_y_ = -l_E6_x_FE_theta_*w_E3_y_FE_theta_ - l_E6_x_OF_theta_*w_E3_y_OF_theta_;
    const double l_E6_x_E3_x_ = inverse_cross_E3_x_E3_y_*w_E6_x_E3_y_ + inverse_pivot_E3_x_*w_E6_x_E3_x_;
    const double l_E6_x_E3_y_ = inverse_cross_E3_x_E3_y_*w_E6_x_E3_x_ + inverse_pivot_E3_y_*w_E6_x_E3_y_;
    const double w_E6_y_E3_x_ = -l_E6_y_FE_theta_*w_E3_x_FE_theta_ - l_E6_y_OF_theta_*w_E3_x_OF_theta_;
    const double w_E6_y_E3_y_ = -l_E6_y_FE_theta_*w_E3_y_FE_theta_ - l_E6_y_OF_theta_*w_E3_y_OF_theta_;
    const double l_E6_y_E3_x_ = inverse_cross_E3_x_E3_y_*w_E6_y_E3_y_ + inverse_pivot_E3_x_*w_E6_y_E3_x_;
    const double l_E6_y_E3_y_ = inverse_cross_E3_x_E3_y_*w_E6_y_E3_x_ + inverse_pivot_E3_y_*w_E6_y_E3_y_;
    const double scale_E4_x_ = l_E4_x_AG_theta_*w_E4_x_AG_theta_ + l_E4_x_EG_theta_*w_E4_x_EG_theta_
        + l_E4_x_FE_theta_*w_E4_x_FE_theta_ + l_E4_x_OF_theta_*w_E4_x_OF_theta_;
    const double scale_E4_y_ = l_E4_y_AG_theta_*w_E4_y_AG_theta_ + l_E4_y_EG_theta_*w_E4_y_EG_theta_
        + l_E4_y_FE_theta_*w_E4_y_FE_theta_ + l_E4_y_OF_theta_*w_E4_y_OF_theta_;
    const double size_E4_x_ = p->mobility_E4_x_ + scale_E4_x_;
    const double size_E4_y_ = p->mobility_E4_x_ + scale_E4_y_;
    const double pivot_E4_x_ = l_E4_x_E3_x_*w_E4_x_E3_x_ + l_E4_x_E3_y_*w_E4_x_E3_y_ + scale_E4_x_;
    const double pivot_E4_y_ = l_E4_y_E3_x_*w_E4_y_E3_x_ + l_E4_y_E3_y_*w_E4_y_E3_y_ + scale_E4_y_;
    const double pivot_E4_x_E4_y_ = l_E4_y_AG_theta_*w_E4_x_AG_theta_ + l_E4_y_E3_x_*w_E4_x_E3_x_
        + l_E4_y_E3_y_*w_E4_x_E3_y_ + l_E4_y_EG_theta_*w_E4_x_EG_theta_ + l_E4_y_FE_theta_*w_E4_x_FE_theta_
        + l_E4_y_OF_theta_*w_E4_x_OF_theta_;
    const double determinant_E4_x_E4_y_ = pivot_E4_x_*pivot_E4_y_ - (pivot_E4_x_E4_y_ * pivot_E4_x_E4_y_);
    if (!(pivot_E4_x_ > discrete->min_pivot * size_E4_x_)) {
        pivot = 17;
        goto dependent;
    }
    if (!(determinant_E4_x_E4_y_ > discrete->min_pivot * size_E4_y_ * pivot_E4_x_)) {
        pivot = 18;
        goto dependent;
    }
    const double inverse_E4_x_E4_y_ = -1.0/determinant_E4_x_E4_y_;
    const double inverse_pivot_E4_x_ = inverse_E4_x_E4_y_*pivot_E4_y_;
    const double inverse_pivot_E4_y_ = inverse_E4_x_E4_y_*pivot_E4_x_;
    const double inverse_cross_E4_x_E4_y_ = -inverse_E4_x_E4_y_*pivot_E4_x_E4_y_;
    const double w_E6_x_E4_x_ = -l_E6_x_E3_x_*w_E4_x_E3_x_ - l_E6_x_E3_y_*w_E4_x_E3_y_
        - l_E6_x_FE_theta_*w_E4_x_FE_theta_ - l_E6_x_OF_theta_*w_E4_x_OF_theta_;
    const double w_E6_x_E4_y_ = -l_E6_x_E3_x_*w_E4_y_E3_x_ - l_E6_x_E3_y_*w_E4_y_E3_y_
        - l_E6_x_FE_theta_*w_E4_y_FE_theta_ - l_E6_x_OF_theta_*w_E4_y_OF_theta_;
    const double l_E6_x_E4_x_ = inverse_cross_E4_x_E4_y_*w_E6_x_E4_y_ + inverse_pivot_E4_x_*w_E6_x_E4_x_;
    const double l_E6_x_E4_y_ = inverse_cross_E4_x_E4_y_*w_E6_x_E4_x_ + inverse_pivot_E4_y_*w_E6_x_E4_y_;
    const double w_E6_y_E4_x_ = -l_E6_y_E3_x_*w_E4_x_E3_x_ - l_E6_y_E3_y_*w_E4_x_E3_y_
        - l_E6_y_FE_theta_*w_E4_x_FE_theta_ - l_E6_y_OF_theta_*w_E4_x_OF_theta_;
    const double w_E6_y_E4_y_ = -l_E6_y_E3_x_*w_E4_y_E3_x_ - l_E6_y_E3_y_*w_E4_y_E3_y_
        - l_E6_y_FE_theta_*w_E4_y_FE_theta_ - l_E6_y_OF_theta_*w_E4_y_OF_theta_;
    const double l_E6_y_E4_x_ = inverse_cross_E4_x_E4_y_*w_E6_y_E4_y_ + inverse_pivot_E4_x_*w_E6_y_E4_x_;
    const double l_E6_y_E4_y_ = inverse_cross_E4_x_E4_y_*w_E6_y_E4_x_ + inverse_pivot_E4_y_*w_E6_y_E4_y_;
    const double scale_E6_x_ = l_E6_x_AH_theta_*w_E6_x_AH_theta_ + l_E6_x_FE_theta_*w_E6_x_FE_theta_
        + l_E6_x_HE_theta_*w_E6_x_HE_theta_ + l_E6_x_OF_theta_*w_E6_x_OF_theta_;
    const double scale_E6_y_ = l_E6_y_AH_theta_*w_E6_y_AH_theta_ + l_E6_y_FE_theta_*w_E6_y_FE_theta_
        + l_E6_y_HE_theta_*w_E6_y_HE_theta_ + l_E6_y_OF_theta_*w_E6_y_OF_theta_;
    const double size_E6_x_ = p->mobility_E6_x_ + scale_E6_x_;
    const double size_E6_y_ = p->mobility_E6_x_ + scale_E6_y_;
    const double pivot_E6_x_ = l_E6_x_E3_x_*w_E6_x_E3_x_ + l_E6_x_E3_y_*w_E6_x_E3_y_ + l_E6_x_E4_x_*w_E6_x_E4_x_
        + l_E6_x_E4_y_*w_E6_x_E4_y_ + scale_E6_x_;
    const double pivot_E6_y_ = l_E6_y_E3_x_*w_E6_y_E3_x_ + l_E6_y_E3_y_*w_E6_y_E3_y_ + l_E6_y_E4_x_*w_E6_y_E4_x_
        + l_E6_y_E4_y_*w_E6_y_E4_y_ + scale_E6_y_;
    const double pivot_E6_x_E6_y_ = l_E6_y_AH_theta_*w_E6_x_AH_theta_ + l_E6_y_E3_x_*w_E6_x_E3_x_
        + l_E6_y_E3_y_*w_E6_x_E3_y_ + l_E6_y_E4_x_*w_E6_x_E4_x_ + l_E6_y_E4_y_*w_E6_x_E4_y_
        + l_E6_y_FE_theta_*w_E6_x_FE_theta_ + l_E6_y_HE_theta_*w_E6_x_HE_theta_ + l_E6_y_OF_theta_*w_E6_x_OF_theta_;
    const double determinant_E6_x_E6_y_ = pivot_E6_x_*pivot_E6_y_ - (pivot_E6_x_E6_y_ * pivot_E6_x_E6_y_);
    if (!(pivot_E6_x_ > discrete->min_pivot * size_E6_x_)) {
        pivot = 19;
        goto dependent;
    }
    if (!(determinant_E6_x_E6_y_ > discrete->min_pivot * size_E6_y_ * pivot_E6_x_)) {
        pivot = 20;
        goto dependent;
    }
    const double inverse_E6_x_E6_y_ = -1.0/determinant_E6_x_E6_y_;
    const double inverse_pivot_E6_x_ = inverse_E6_x_E6_y_*pivot_E6_y_;
    const double inverse_pivot_E6_y_ = inverse_E6_x_E6_y_*pivot_E6_x_;
    const double inverse_cross_E6_x_E6_y_ = -inverse_E6_x_E6_y_*pivot_E6_x_E6_y_;

    /* forward substitution */
    const double z_AH_y_ = -p->HE_mass_*rhs_H_y_;
    const double z_AH_x_ = -p->HE_mass_*rhs_H_x_;
    const double z_AG_y_ = -p->EG_mass_*rhs_G_y_;
    const double z_AG_x_ = -p->EG_mass_*rhs_G_x_;
    const double z_BDE_y_ = -spring_pull_*spring_span_y_;
    const double z_BDE_x_ = -spring_pull_*spring_span_x_;
    const double z_OF_y_ = p->FE_mass_*rhs_F_y_;
    const double z_OF_x_ = p->FE_mass_*rhs_F_x_;
    const double z_BDE_theta_ = -arm_BDE_B_x_*z_BDE_y_ + arm_BDE_B_y_*z_BDE_x_
        - arm_BDE_D_x_*spring_pull_*spring_span_y_ + arm_BDE_D_y_*spring_pull_*spring_span_x_
        - l_BDE_theta_B_x_*rhs_B_x_ - l_BDE_theta_B_y_*rhs_B_y_;
    const double z_EG_theta_ = l_EG_theta_G_x_*rhs_A5_x_ - l_EG_theta_G_x_*rhs_G_x_ + l_EG_theta_G_y_*rhs_A5_y_
        - l_EG_theta_G_y_*rhs_G_y_;
    const double z_AG_theta_ = -arm_AG_A_x_*z_AG_y_ + arm_AG_A_y_*z_AG_x_ - l_AG_theta_A5_x_*rhs_A5_x_
        - l_AG_theta_A5_y_*rhs_A5_y_ - l_AG_theta_G_x_*rhs_G_x_ - l_AG_theta_G_y_*rhs_G_y_;
    const double z_HE_theta_ = l_HE_theta_H_x_*rhs_A7_x_ - l_HE_theta_H_x_*rhs_H_x_ + l_HE_theta_H_y_*rhs_A7_y_
        - l_HE_theta_H_y_*rhs_H_y_;
    const double z_AH_theta_ = -arm_AH_A_x_*z_AH_y_ + arm_AH_A_y_*z_AH_x_ - l_AH_theta_A7_x_*rhs_A7_x_
        - l_AH_theta_A7_y_*rhs_A7_y_ - l_AH_theta_H_x_*rhs_H_x_ - l_AH_theta_H_y_*rhs_H_y_;
    const double z_OF_theta_ = -arm_OF_O_x_*z_OF_y_ + arm_OF_O_y_*z_OF_x_ - l_OF_theta_F_x_*rhs_F_x_
        - l_OF_theta_F_y_*rhs_F_y_ - l_OF_theta_O_x_*rhs_O_x_ - l_OF_theta_O_y_*rhs_O_y_ + p->motor_value_;
    const double z_FE_theta_ = -l_FE_theta_F_x_*rhs_F_x_ - l_FE_theta_F_x_*rhs_O_x_ - l_FE_theta_F_y_*rhs_F_y_
        - l_FE_theta_F_y_*rhs_O_y_;
    const double z_E3_x_ = -l_E3_x_BDE_theta_*z_BDE_theta_ - l_E3_x_FE_theta_*z_FE_theta_
        - l_E3_x_OF_theta_*z_OF_theta_ - rhs_B_x_ + rhs_E3_x_ + rhs_F_x_ + rhs_O_x_;
    const double z_E3_y_ = -l_E3_y_BDE_theta_*z_BDE_theta_ - l_E3_y_FE_theta_*z_FE_theta_
        - l_E3_y_OF_theta_*z_OF_theta_ - rhs_B_y_ + rhs_E3_y_ + rhs_F_y_ + rhs_O_y_;
    const double z_E4_x_ = -l_E4_x_AG_theta_*z_AG_theta_ - l_E4_x_E3_x_*z_E3_x_ - l_E4_x_E3_y_*z_E3_y_
        - l_E4_x_EG_theta_*z_EG_theta_ - l_E4_x_FE_theta_*z_FE_theta_ - l_E4_x_OF_theta_*z_OF_theta_ - rhs_A5_x_
        + rhs_E4_x_ + rhs_F_x_ + rhs_G_x_ + rhs_O_x_;
    const double z_E4_y_ = -l_E4_y_AG_theta_*z_AG_theta_ - l_E4_y_E3_x_*z_E3_x_ - l_E4_y_E3_y_*z_E3_y_
        - l_E4_y_EG_theta_*z_EG_theta_ - l_E4_y_FE_theta_*z_FE_theta_ - l_E4_y_OF_theta_*z_OF_theta_ - rhs_A5_y_
        + rhs_E4_y_ + rhs_F_y_ + rhs_G_y_ + rhs_O_y_;
    const double z_E6_x_ = -l_E6_x_AH_theta_*z_AH_theta_ - l_E6_x_E3_x_*z_E3_x_ - l_E6_x_E3_y_*z_E3_y_
        - l_E6_x_E4_x_*z_E4_x_ - l_E6_x_E4_y_*z_E4_y_ - l_E6_x_FE_theta_*z_FE_theta_ - l_E6_x_HE_theta_*z_HE_theta_
        - l_E6_x_OF_theta_*z_OF_theta_ - rhs_A7_x_ + rhs_E6_x_ + rhs_F_x_ + rhs_H_x_ + rhs_O_x_;
    const double z_E6_y_ = -l_E6_y_AH_theta_*z_AH_theta_ - l_E6_y_E3_x_*z_E3_x_ - l_E6_y_E3_y_*z_E3_y_
        - l_E6_y_E4_x_*z_E4_x_ - l_E6_y_E4_y_*z_E4_y_ - l_E6_y_FE_theta_*z_FE_theta_ - l_E6_y_HE_theta_*z_HE_theta_
        - l_E6_y_OF_theta_*z_OF_theta_ - rhs_A7_y_ + rhs_E6_y_ + rhs_F_y_ + rhs_H_y_ + rhs_O_y_;

    /* backward substitution */
    const double lambda_E6_y_ = inverse_cross_E6_x_E6_y_*z_E6_x_ + inverse_pivot_E6_y_*z_E6_y_;
    const double lambda_E6_x_ = inverse_cross_E6_x_E6_y_*z_E6_y_ + inverse_pivot_E6_x_*z_E6_x_;
    const double lambda_E4_y_ = inverse_cross_E4_x_E4_y_*z_E4_x_ + inverse_pivot_E4_y_*z_E4_y_
        - l_E6_x_E4_y_*lambda_E6_x_ - l_E6_y_E4_y_*lambda_E6_y_;
    const double lambda_E4_x_ = inverse_cross_E4_x_E4_y_*z_E4_y_ + inverse_pivot_E4_x_*z_E4_x_
        - l_E6_x_E4_x_*lambda_E6_x_ - l_E6_y_E4_x_*lambda_E6_y_;
    const double lambda_E3_y_ = inverse_cross_E3_x_E3_y_*z_E3_x_ + inverse_pivot_E3_y_*z_E3_y_
        - l_E4_x_E3_y_*lambda_E4_x_ - l_E4_y_E3_y_*lambda_E4_y_ - l_E6_x_E3_y_*lambda_E6_x_ - l_E6_y_E3_y_*lambda_E6_y_;
    const double lambda_E3_x_ = inverse_cross_E3_x_E3_y_*z_E3_y_ + inverse_pivot_E3_x_*z_E3_x_
        - l_E4_x_E3_x_*lambda_E4_x_ - l_E4_y_E3_x_*lambda_E4_y_ - l_E6_x_E3_x_*lambda_E6_x_ - l_E6_y_E3_x_*lambda_E6_y_;
    const double acceleration_FE_theta_ = inverse_cross_OF_theta_FE_theta_*z_OF_theta_
        + inverse_pivot_FE_theta_*z_FE_theta_ - l_E3_x_FE_theta_*lambda_E3_x_ - l_E3_y_FE_theta_*lambda_E3_y_
        - l_E4_x_FE_theta_*lambda_E4_x_ - l_E4_y_FE_theta_*lambda_E4_y_ - l_E6_x_FE_theta_*lambda_E6_x_
        - l_E6_y_FE_theta_*lambda_E6_y_;
    const double acceleration_OF_theta_ = inverse_cross_OF_theta_FE_theta_*z_FE_theta_
        + inverse_pivot_OF_theta_*z_OF_theta_ - l_E3_x_OF_theta_*lambda_E3_x_ - l_E3_y_OF_theta_*lambda_E3_y_
        - l_E4_x_OF_theta_*lambda_E4_x_ - l_E4_y_OF_theta_*lambda_E4_y_ - l_E6_x_OF_theta_*lambda_E6_x_
        - l_E6_y_OF_theta_*lambda_E6_y_;
    const double acceleration_AH_theta_ = inverse_cross_HE_theta_AH_theta_*z_HE_theta_
        + inverse_pivot_AH_theta_*z_AH_theta_ - l_E6_x_AH_theta_*lambda_E6_x_ - l_E6_y_AH_theta_*lambda_E6_y_;
    const double acceleration_HE_theta_ = inverse_cross_HE_theta_AH_theta_*z_AH_theta_
        + inverse_pivot_HE_theta_*z_HE_theta_ - l_E6_x_HE_theta_*lambda_E6_x_ - l_E6_y_HE_theta_*lambda_E6_y_;
    const double acceleration_AG_theta_ = inverse_cross_EG_theta_AG_theta_*z_EG_theta_
        + inverse_pivot_AG_theta_*z_AG_theta_ - l_E4_x_AG_theta_*lambda_E4_x_ - l_E4_y_AG_theta_*lambda_E4_y_;
    const double acceleration_EG_theta_ = inverse_cross_EG_theta_AG_theta_*z_AG_theta_
        + inverse_pivot_EG_theta_*z_EG_theta_ - l_E4_x_EG_theta_*lambda_E4_x_ - l_E4_y_EG_theta_*lambda_E4_y_;
    const double acceleration_BDE_theta_ = inverse_pivot_BDE_theta_*z_BDE_theta_ - l_E3_x_BDE_theta_*lambda_E3_x_
        - l_E3_y_BDE_theta_*lambda_E3_y_;
    const double lambda_O_x_ = -acceleration_FE_theta_*l_FE_theta_F_x_ - acceleration_OF_theta_*l_OF_theta_O_x_
        - inertia_OF_x_*rhs_O_x_ + lambda_E3_x_ + lambda_E4_x_ + lambda_E6_x_ - z_OF_x_;
    const double acceleration_OF_x_ = acceleration_OF_theta_*arm_OF_O_y_ - rhs_O_x_;
    const double lambda_O_y_ = -acceleration_FE_theta_*l_FE_theta_F_y_ - acceleration_OF_theta_*l_OF_theta_O_y_
        - inertia_OF_y_*rhs_O_y_ + lambda_E3_y_ + lambda_E4_y_ + lambda_E6_y_ - z_OF_y_;
    const double acceleration_OF_y_ = -acceleration_OF_theta_*arm_OF_O_x_ - rhs_O_y_;
    const double lambda_B_x_ = -p->BDE_mass_*rhs_B_x_ - acceleration_BDE_theta_*l_BDE_theta_B_x_ - lambda_E3_x_
        - z_BDE_x_;
    const double acceleration_BDE_x_ = acceleration_BDE_theta_*arm_BDE_B_y_ - rhs_B_x_;
    const double lambda_B_y_ = -p->BDE_mass_*rhs_B_y_ - acceleration_BDE_theta_*l_BDE_theta_B_y_ - lambda_E3_y_
        - z_BDE_y_;
    const double acceleration_BDE_y_ = -acceleration_BDE_theta_*arm_BDE_B_x_ - rhs_B_y_;
    const double lambda_A5_x_ = -acceleration_AG_theta_*l_AG_theta_A5_x_ + acceleration_EG_theta_*l_EG_theta_G_x_
        - inertia_AG_x_*rhs_A5_x_ - lambda_E4_x_ - z_AG_x_;
    const double acceleration_AG_x_ = acceleration_AG_theta_*arm_AG_A_y_ - rhs_A5_x_;
    const double lambda_A5_y_ = -acceleration_AG_theta_*l_AG_theta_A5_y_ + acceleration_EG_theta_*l_EG_theta_G_y_
        - inertia_AG_y_*rhs_A5_y_ - lambda_E4_y_ - z_AG_y_;
    const double acceleration_AG_y_ = -acceleration_AG_theta_*arm_AG_A_x_ - rhs_A5_y_;
    const double lambda_A7_x_ = -acceleration_AH_theta_*l_AH_theta_A7_x_ + acceleration_HE_theta_*l_HE_theta_H_x_
        - inertia_AH_x_*rhs_A7_x_ - lambda_E6_x_ - z_AH_x_;
    const double acceleration_AH_x_ = acceleration_AH_theta_*arm_AH_A_y_ - rhs_A7_x_;
    const double lambda_A7_y_ = -acceleration_AH_theta_*l_AH_theta_A7_y_ + acceleration_HE_theta_*l_HE_theta_H_y_
        - inertia_AH_y_*rhs_A7_y_ - lambda_E6_y_ - z_AH_y_;
    const double acceleration_AH_y_ = -acceleration_AH_theta_*arm_AH_A_x_ - rhs_A7_y_;
    const double lambda_F_x_ = p->FE_mass_*acceleration_OF_x_ - p->FE_mass_*rhs_F_x_
        - acceleration_FE_theta_*l_FE_theta_F_x_ - acceleration_OF_theta_*l_OF_theta_F_x_ + lambda_E3_x_ + lambda_E4_x_
        + lambda_E6_x_;
    const double acceleration_FE_x_ = acceleration_FE_theta_*arm_FE_F_y_ - acceleration_OF_theta_*arm_OF_F_y_
        + acceleration_OF_x_ - rhs_F_x_;
    const double lambda_F_y_ = p->FE_mass_*acceleration_OF_y_ - p->FE_mass_*rhs_F_y_
        - acceleration_FE_theta_*l_FE_theta_F_y_ - acceleration_OF_theta_*l_OF_theta_F_y_ + lambda_E3_y_ + lambda_E4_y_
        + lambda_E6_y_;
    const double acceleration_FE_y_ = -acceleration_FE_theta_*arm_FE_F_x_ + acceleration_OF_theta_*arm_OF_F_x_
        + acceleration_OF_y_ - rhs_F_y_;
    const double lambda_G_x_ = -p->EG_mass_*acceleration_AG_x_ - p->EG_mass_*rhs_G_x_
        - acceleration_AG_theta_*l_AG_theta_G_x_ - acceleration_EG_theta_*l_EG_theta_G_x_ + lambda_E4_x_;
    const double acceleration_EG_x_ = -acceleration_AG_theta_*arm_AG_G_y_ + acceleration_AG_x_
        + acceleration_EG_theta_*arm_EG_G_y_ + rhs_G_x_;
    const double lambda_G_y_ = -p->EG_mass_*acceleration_AG_y_ - p->EG_mass_*rhs_G_y_
        - acceleration_AG_theta_*l_AG_theta_G_y_ - acceleration_EG_theta_*l_EG_theta_G_y_ + lambda_E4_y_;
    const double acceleration_EG_y_ = acceleration_AG_theta_*arm_AG_G_x_ + acceleration_AG_y_
        - acceleration_EG_theta_*arm_EG_G_x_ + rhs_G_y_;
    const double lambda_H_x_ = -p->HE_mass_*acceleration_AH_x_ - p->HE_mass_*rhs_H_x_
        - acceleration_AH_theta_*l_AH_theta_H_x_ - acceleration_HE_theta_*l_HE_theta_H_x_ + lambda_E6_x_;
    const double acceleration_HE_x_ = -acceleration_AH_theta_*arm_AH_H_y_ + acceleration_AH_x_
        + acceleration_HE_theta_*arm_HE_H_y_ + rhs_H_x_;
    const double lambda_H_y_ = -p->HE_mass_*acceleration_AH_y_ - p->HE_mass_*rhs_H_y_
        - acceleration_AH_theta_*l_AH_theta_H_y_ - acceleration_HE_theta_*l_HE_theta_H_y_ + lambda_E6_y_;
    const double acceleration_HE_y_ = acceleration_AH_theta_*arm_AH_H_x_ + acceleration_AH_y_
        - acceleration_HE_theta_*arm_HE_H_x_ + rhs_H_y_;

    /* results */
    a[0] = acceleration_OF_x_;
    a[1] = acceleration_OF_y_;
    a[2] = acceleration_OF_theta_;
    a[3] = acceleration_FE_x_;
    a[4] = acceleration_FE_y_;
    a[5] = acceleration_FE_theta_;
    a[6] = acceleration_BDE_x_;
    a[7] = acceleration_BDE_y_;
    a[8] = acceleration_BDE_theta_;
    a[9] = acceleration_EG_x_;
    a[10] = acceleration_EG_y_;
    a[11] = acceleration_EG_theta_;
    a[12] = acceleration_AG_x_;
    a[13] = acceleration_AG_y_;
    a[14] = acceleration_AG_theta_;
    a[15] = acceleration_HE_x_;
    a[16] = acceleration_HE_y_;
    a[17] = acceleration_HE_theta_;
    a[18] = acceleration_AH_x_;
    a[19] = acceleration_AH_y_;
    a[20] = acceleration_AH_theta_;
    rhs->lambda[0] = lambda_O_x_;
    rhs->lambda[1] = lambda_O_y_;
    rhs->lambda[2] = lambda_B_x_;
    rhs->lambda[3] = lambda_B_y_;
    rhs->lambda[4] = lambda_A5_x_;
    rhs->lambda[5] = lambda_A5_y_;
    rhs->lambda[6] = lambda_A7_x_;
    rhs->lambda[7] = lambda_A7_y_;
    rhs->lambda[8] = lambda_F_x_;
    rhs->lambda[9] = lambda_F_y_;
    rhs->lambda[10] = lambda_E3_x_;
    rhs->lambda[11] = lambda_E3_y_;
    rhs->lambda[12] = lambda_E4_x_;
    rhs->lambda[13] = lambda_E4_y_;
    rhs->lambda[14] = lambda_E6_x_;
    rhs->lambda[15] = lambda_E6_y_;
    rhs->lambda[16] = lambda_G_x_;
    rhs->lambda[17] = lambda_G_y_;
    rhs->lambda[18] = lambda_H_x_;
    rhs->lambda[19] = lambda_H_y_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = 0.0;
        force[2] = p->motor_value_;
        force[3] = 0.0;
        force[4] = 0.0;
        force[5] = 0.0;
        force[6] = -spring_pull_*spring_span_x_;
        force[7] = -spring_pull_*spring_span_y_;
        force[8] = -arm_BDE_D_x_*spring_pull_*spring_span_y_ + arm_BDE_D_y_*spring_pull_*spring_span_x_;
        force[9] = 0.0;
        force[10] = 0.0;
        force[11] = 0.0;
        force[12] = 0.0;
        force[13] = 0.0;
        force[14] = 0.0;
        force[15] = 0.0;
        force[16] = 0.0;
        force[17] = 0.0;
        force[18] = 0.0;
        force[19] = 0.0;
        force[20] = 0.0;
        gamma_stab[0] = rhs_O_x_;
        gamma_stab[1] = rhs_O_y_;
        gamma_stab[2] = rhs_B_x_;
        gamma_stab[3] = rhs_B_y_;
        gamma_stab[4] = rhs_A5_x_;
        gamma_stab[5] = rhs_A5_y_;
        gamma_stab[6] = rhs_A7_x_;
        gamma_stab[7] = rhs_A7_y_;
        gamma_stab[8] = rhs_F_x_;
        gamma_stab[9] = rhs_F_y_;
        gamma_stab[10] = rhs_E3_x_;
        gamma_stab[11] = rhs_E3_y_;
        gamma_stab[12] = rhs_E4_x_;
        gamma_stab[13] = rhs_E4_y_;
        gamma_stab[14] = rhs_E6_x_;
        gamma_stab[15] = rhs_E6_y_;
        gamma_stab[16] = rhs_G_x_;
        gamma_stab[17] = rhs_G_y_;
        gamma_stab[18] = rhs_H_x_;
        gamma_stab[19] = rhs_H_y_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = OF_omega_*p->motor_value_;
    rhs->power[2] = 0.0;
    return pivot;
}
