/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* coordinates, velocities, time */
    const double OF_x = q[0];
    const double OF_y = q[1];
    const double OF_theta = q[2];
    const double OF_vx = v[0];
    const double OF_vy = v[1];
    const double OF_omega = v[2];
    const double FE_x = q[3];
    const double FE_y = q[4];
    const double FE_theta = q[5];
    const double FE_vx = v[3];
    const double FE_vy = v[4];
    const double FE_omega = v[5];
    const double BDE_x = q[6];
    const double BDE_y = q[7];
    const double BDE_theta = q[8];
    const double BDE_vx = v[6];
    const double BDE_vy = v[7];
    const double BDE_omega = v[8];
    const double EG_x = q[9];
    const double EG_y = q[10];
    const double EG_theta = q[11];
    const double EG_vx = v[9];
    const double EG_vy = v[10];
    const double EG_omega = v[11];
    const double AG_x = q[12];
    const double AG_y = q[13];
    const double AG_theta = q[14];
    const double AG_vx = v[12];
    const double AG_vy = v[13];
    const double AG_omega = v[14];
    const double HE_x = q[15];
    const double HE_y = q[16];
    const double HE_theta = q[17];
    const double HE_vx = v[15];
    const double HE_vy = v[16];
    const double HE_omega = v[17];
    const double AH_x = q[18];
    const double AH_y = q[19];
    const double AH_theta = q[20];
    const double AH_vx = v[18];
    const double AH_vy = v[19];
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
    const double arm_BDE_D_x = p->BDE_points_D_x*cos_theta_BDE - p->BDE_points_D_y*sin_theta_BDE;
    const double arm_BDE_D_y = p->BDE_points_D_x*sin_theta_BDE + p->BDE_points_D_y*cos_theta_BDE;
    const double spring_span_x = BDE_x - p->C_x + arm_BDE_D_x;
    const double spring_span_y = BDE_y - p->C_y + arm_BDE_D_y;
    const double spring_length = sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const double spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x = -OF_x - arm_OF_O_x;
    const double phi_dot_O_x = OF_omega*arm_OF_O_y - OF_vx;
    const double rhs_O_x = -(OF_omega * OF_omega)*arm_OF_O_x - p->beta_squared*phi_O_x - phi_dot_O_x*p->two_alpha;
    aside->phi[0] = phi_O_x;
    aside->phi_dot[0] = phi_dot_O_x;
    const double phi_O_y = -OF_y - arm_OF_O_y;
    const double phi_dot_O_y = -OF_omega*arm_OF_O_x - OF_vy;
    const double rhs_O_y = -(OF_omega * OF_omega)*arm_OF_O_y - p->beta_squared*phi_O_y - phi_dot_O_y*p->two_alpha;
    aside->phi[1] = phi_O_y;
    aside->phi_dot[1] = phi_dot_O_y;
    const double phi_B_x = -BDE_x + p->B_x - arm_BDE_B_x;
    const double phi_dot_B_x = BDE_omega*arm_BDE_B_y - BDE_vx;
    const double rhs_B_x = -(BDE_omega * BDE_omega)*arm_BDE_B_x - p->beta_squared*phi_B_x - phi_dot_B_x*p->two_alpha;
    aside->phi[2] = phi_B_x;
    aside->phi_dot[2] = phi_dot_B_x;
    const double phi_B_y = -BDE_y + p->B_y - arm_BDE_B_y;
    const double phi_dot_B_y = -BDE_omega*arm_BDE_B_x - BDE_vy;
    const double rhs_B_y = -(BDE_omega * BDE_omega)*arm_BDE_B_y - p->beta_squared*phi_B_y - phi_dot_B_y*p->two_alpha;
    aside->phi[3] = phi_B_y;
    aside->phi_dot[3] = phi_dot_B_y;
    const double phi_A5_x = -AG_x + p->A_x - arm_AG_A_x;
    const double phi_dot_A5_x = AG_omega*arm_AG_A_y - AG_vx;
    const double rhs_A5_x = -(AG_omega * AG_omega)*arm_AG_A_x - p->beta_squared*phi_A5_x - phi_dot_A5_x*p->two_alpha;
    aside->phi[4] = phi_A5_x;
    aside->phi_dot[4] = phi_dot_A5_x;
    const double phi_A5_y = -AG_y + p->A_y - arm_AG_A_y;
    const double phi_dot_A5_y = -AG_omega*arm_AG_A_x - AG_vy;
    const double rhs_A5_y = -(AG_omega * AG_omega)*arm_AG_A_y - p->beta_squared*phi_A5_y - phi_dot_A5_y*p->two_alpha;
    aside->phi[5] = phi_A5_y;
    aside->phi_dot[5] = phi_dot_A5_y;
    const double phi_A7_x = -AH_x + p->A_x - arm_AH_A_x;
    const double phi_dot_A7_x = AH_omega*arm_AH_A_y - AH_vx;
    const double rhs_A7_x = -(AH_omega * AH_omega)*arm_AH_A_x - p->beta_squared*phi_A7_x - phi_dot_A7_x*p->two_alpha;
    aside->phi[6] = phi_A7_x;
    aside->phi_dot[6] = phi_dot_A7_x;
    const double phi_A7_y = -AH_y + p->A_y - arm_AH_A_y;
    const double phi_dot_A7_y = -AH_omega*arm_AH_A_x - AH_vy;
    const double rhs_A7_y = -(AH_omega * AH_omega)*arm_AH_A_y - p->beta_squared*phi_A7_y - phi_dot_A7_y*p->two_alpha;
    aside->phi[7] = phi_A7_y;
    aside->phi_dot[7] = phi_dot_A7_y;
    const double phi_F_x = -FE_x + OF_x - arm_FE_F_x + arm_OF_F_x;
    const double phi_dot_F_x = FE_omega*arm_FE_F_y - FE_vx - OF_omega*arm_OF_F_y + OF_vx;
    const double rhs_F_x = -(FE_omega * FE_omega)*arm_FE_F_x + (OF_omega * OF_omega)*arm_OF_F_x
        - p->beta_squared*phi_F_x - phi_dot_F_x*p->two_alpha;
    aside->phi[8] = phi_F_x;
    aside->phi_dot[8] = phi_dot_F_x;
    const double phi_F_y = -FE_y + OF_y - arm_FE_F_y + arm_OF_F_y;
    const double phi_dot_F_y = -FE_omega*arm_FE_F_x - FE_vy + OF_omega*arm_OF_F_x + OF_vy;
    const double rhs_F_y = -(FE_omega * FE_omega)*arm_FE_F_y + (OF_omega * OF_omega)*arm_OF_F_y
        - p->beta_squared*phi_F_y - phi_dot_F_y*p->two_alpha;
    aside->phi[9] = phi_F_y;
    aside->phi_dot[9] = phi_dot_F_y;
    const double phi_E3_x = -BDE_x + FE_x - arm_BDE_E_x + arm_FE_E_x;
    const double phi_dot_E3_x = BDE_omega*arm_BDE_E_y - BDE_vx - FE_omega*arm_FE_E_y + FE_vx;
    const double rhs_E3_x = -(BDE_omega * BDE_omega)*arm_BDE_E_x + (FE_omega * FE_omega)*arm_FE_E_x
        - p->beta_squared*phi_E3_x - phi_dot_E3_x*p->two_alpha;
    aside->phi[10] = phi_E3_x;
    aside->phi_dot[10] = phi_dot_E3_x;
    const double phi_E3_y = -BDE_y + FE_y - arm_BDE_E_y + arm_FE_E_y;
    const double phi_dot_E3_y = -BDE_omega*arm_BDE_E_x - BDE_vy + FE_omega*arm_FE_E_x + FE_vy;
    const double rhs_E3_y = -(BDE_omega * BDE_omega)*arm_BDE_E_y + (FE_omega * FE_omega)*arm_FE_E_y
        - p->beta_squared*phi_E3_y - phi_dot_E3_y*p->two_alpha;
    aside->phi[11] = phi_E3_y;
    aside->phi_dot[11] = phi_dot_E3_y;
    const double phi_E4_x = -EG_x + FE_x - arm_EG_E_x + arm_FE_E_x;
    const double phi_dot_E4_x = EG_omega*arm_EG_E_y - EG_vx - FE_omega*arm_FE_E_y + FE_vx;
    const double rhs_E4_x = -(EG_omega * EG_omega)*arm_EG_E_x + (FE_omega * FE_omega)*arm_FE_E_x
        - p->beta_squared*phi_E4_x - phi_dot_E4_x*p->two_alpha;
    aside->phi[12] = phi_E4_x;
    aside->phi_dot[12] = phi_dot_E4_x;
    const double phi_E4_y = -EG_y + FE_y - arm_EG_E_y + arm_FE_E_y;
    const double phi_dot_E4_y = -EG_omega*arm_EG_E_x - EG_vy + FE_omega*arm_FE_E_x + FE_vy;
    const double rhs_E4_y = -(EG_omega * EG_omega)*arm_EG_E_y + (FE_omega * FE_omega)*arm_FE_E_y
        - p->beta_squared*phi_E4_y - phi_dot_E4_y*p->two_alpha;
    aside->phi[13] = phi_E4_y;
    aside->phi_dot[13] = phi_dot_E4_y;
    const double phi_E6_x = FE_x - HE_x + arm_FE_E_x - arm_HE_E_x;
    const double phi_dot_E6_x = -FE_omega*arm_FE_E_y + FE_vx + HE_omega*arm_HE_E_y - HE_vx;
    const double rhs_E6_x = (FE_omega * FE_omega)*arm_FE_E_x - (HE_omega * HE_omega)*arm_HE_E_x
        - p->beta_squared*phi_E6_x - phi_dot_E6_x*p->two_alpha;
    aside->phi[14] = phi_E6_x;
    aside->phi_dot[14] = phi_dot_E6_x;
    const double phi_E6_y = FE_y - HE_y + arm_FE_E_y - arm_HE_E_y;
    const double phi_dot_E6_y = FE_omega*arm_FE_E_x + FE_vy - HE_omega*arm_HE_E_x - HE_vy;
    const double rhs_E6_y = (FE_omega * FE_omega)*arm_FE_E_y - (HE_omega * HE_omega)*arm_HE_E_y
        - p->beta_squared*phi_E6_y - phi_dot_E6_y*p->two_alpha;
    aside->phi[15] = phi_E6_y;
    aside->phi_dot[15] = phi_dot_E6_y;
    const double phi_G_x = -AG_x + EG_x - arm_AG_G_x + arm_EG_G_x;
    const double phi_dot_G_x = AG_omega*arm_AG_G_y - AG_vx - EG_omega*arm_EG_G_y + EG_vx;
    const double rhs_G_x = -(AG_omega * AG_omega)*arm_AG_G_x + (EG_omega * EG_omega)*arm_EG_G_x
        - p->beta_squared*phi_G_x - phi_dot_G_x*p->two_alpha;
    aside->phi[16] = phi_G_x;
    aside->phi_dot[16] = phi_dot_G_x;
    const double phi_G_y = -AG_y + EG_y - arm_AG_G_y + arm_EG_G_y;
    const double phi_dot_G_y = -AG_omega*arm_AG_G_x - AG_vy + EG_omega*arm_EG_G_x + EG_vy;
    const double rhs_G_y = -(AG_omega * AG_omega)*arm_AG_G_y + (EG_omega * EG_omega)*arm_EG_G_y
        - p->beta_squared*phi_G_y - phi_dot_G_y*p->two_alpha;
    aside->phi[17] = phi_G_y;
    aside->phi_dot[17] = phi_dot_G_y;
    const double phi_H_x = -AH_x + HE_x - arm_AH_H_x + arm_HE_H_x;
    const double phi_dot_H_x = AH_omega*arm_AH_H_y - AH_vx - HE_omega*arm_HE_H_y + HE_vx;
    const double rhs_H_x = -(AH_omega * AH_omega)*arm_AH_H_x + (HE_omega * HE_omega)*arm_HE_H_x
        - p->beta_squared*phi_H_x - phi_dot_H_x*p->two_alpha;
    aside->phi[18] = phi_H_x;
    aside->phi_dot[18] = phi_dot_H_x;
    const double phi_H_y = -AH_y + HE_y - arm_AH_H_y + arm_HE_H_y;
    const double phi_dot_H_y = -AH_omega*arm_AH_H_x - AH_vy + HE_omega*arm_HE_H_x + HE_vy;
    const double rhs_H_y = -(AH_omega * AH_omega)*arm_AH_H_y + (HE_omega * HE_omega)*arm_HE_H_y
        - p->beta_squared*phi_H_y - phi_dot_H_y*p->two_alpha;
    aside->phi[19] = phi_H_y;
    aside->phi_dot[19] = phi_dot_H_y;

    /* L D L^T of the KKT matrix */
    const double l_O_x__OF_theta = arm_OF_O_y*p->inverse_OF_inertia;
    const double l_O_y__OF_theta = -arm_OF_O_x*p->inverse_OF_inertia;
    const double l_F_x__OF_theta = -arm_OF_F_y*p->inverse_OF_inertia;
    const double l_F_y__OF_theta = arm_OF_F_x*p->inverse_OF_inertia;
    const double scale_O_x = arm_OF_O_y*l_O_x__OF_theta + p->inverse_OF_mass;
    const double scale_O_y = -arm_OF_O_x*l_O_y__OF_theta + p->inverse_OF_mass;
    const double pivot_O_x__O_y = arm_OF_O_y*l_O_y__OF_theta;
    const double determinant_O_x__O_y = -(pivot_O_x__O_y * pivot_O_x__O_y) + scale_O_x*scale_O_y;
    if (!(scale_O_x > 0.0 && scale_O_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_O_x__O_y > memory->least * scale_O_y * scale_O_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_O_x__O_y = -1.0/determinant_O_x__O_y;
    const double inverse_pivot_O_x = inverse_O_x__O_y*scale_O_y;
    const double inverse_pivot_O_y = inverse_O_x__O_y*scale_O_x;
    const double inverse_cross_O_x__O_y = -inverse_O_x__O_y*pivot_O_x__O_y;
    const double w_F_x__O_x = -arm_OF_O_y*l_F_x__OF_theta + p->inverse_OF_mass;
    const double w_F_x__O_y = arm_OF_O_x*l_F_x__OF_theta;
    const double l_F_x__O_x = inverse_cross_O_x__O_y*w_F_x__O_y + inverse_pivot_O_x*w_F_x__O_x;
    const double l_F_x__O_y = inverse_cross_O_x__O_y*w_F_x__O_x + inverse_pivot_O_y*w_F_x__O_y;
    const double w_F_y__O_x = -arm_OF_O_y*l_F_y__OF_theta;
    const double w_F_y__O_y = arm_OF_O_x*l_F_y__OF_theta + p->inverse_OF_mass;
    const double l_F_y__O_x = inverse_cross_O_x__O_y*w_F_y__O_y + inverse_pivot_O_x*w_F_y__O_x;
    const double l_F_y__O_y = inverse_cross_O_x__O_y*w_F_y__O_x + inverse_pivot_O_y*w_F_y__O_y;
    const double l_B_x__BDE_theta = arm_BDE_B_y*p->inverse_BDE_inertia;
    const double l_B_y__BDE_theta = -arm_BDE_B_x*p->inverse_BDE_inertia;
    const double l_E3_x__BDE_theta = arm_BDE_E_y*p->inverse_BDE_inertia;
    const double l_E3_y__BDE_theta = -arm_BDE_E_x*p->inverse_BDE_inertia;
    const double scale_B_x = arm_BDE_B_y*l_B_x__BDE_theta + p->inverse_BDE_mass;
    const double scale_B_y = -arm_BDE_B_x*l_B_y__BDE_theta + p->inverse_BDE_mass;
    const double pivot_B_x__B_y = arm_BDE_B_y*l_B_y__BDE_theta;
    const double determinant_B_x__B_y = -(pivot_B_x__B_y * pivot_B_x__B_y) + scale_B_x*scale_B_y;
    if (!(scale_B_x > 0.0 && scale_B_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B_x__B_y > memory->least * scale_B_y * scale_B_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_B_x__B_y = -1.0/determinant_B_x__B_y;
    const double inverse_pivot_B_x = inverse_B_x__B_y*scale_B_y;
    const double inverse_pivot_B_y = inverse_B_x__B_y*scale_B_x;
    const double inverse_cross_B_x__B_y = -inverse_B_x__B_y*pivot_B_x__B_y;
    const double w_E3_x__B_x = -arm_BDE_B_y*l_E3_x__BDE_theta - p->inverse_BDE_mass;
    const double w_E3_x__B_y = arm_BDE_B_x*l_E3_x__BDE_theta;
    const double l_E3_x__B_x = inverse_cross_B_x__B_y*w_E3_x__B_y + inverse_pivot_B_x*w_E3_x__B_x;
    const double l_E3_x__B_y = inverse_cross_B_x__B_y*w_E3_x__B_x + inverse_pivot_B_y*w_E3_x__B_y;
    const double w_E3_y__B_x = -arm_BDE_B_y*l_E3_y__BDE_theta;
    const double w_E3_y__B_y = arm_BDE_B_x*l_E3_y__BDE_theta - p->inverse_BDE_mass;
    const double l_E3_y__B_x = inverse_cross_B_x__B_y*w_E3_y__B_y + inverse_pivot_B_x*w_E3_y__B_x;
    const double l_E3_y__B_y = inverse_cross_B_x__B_y*w_E3_y__B_x + inverse_pivot_B_y*w_E3_y__B_y;
    const double l_G_x__EG_theta = -arm_EG_G_y*p->inverse_EG_inertia;
    const double l_G_y__EG_theta = arm_EG_G_x*p->inverse_EG_inertia;
    const double l_E4_x__EG_theta = arm_EG_E_y*p->inverse_EG_inertia;
    const double l_E4_y__EG_theta = -arm_EG_E_x*p->inverse_EG_inertia;
    const double l_A5_x__AG_theta = arm_AG_A_y*p->inverse_AG_inertia;
    const double l_A5_y__AG_theta = -arm_AG_A_x*p->inverse_AG_inertia;
    const double l_G_x__AG_theta = arm_AG_G_y*p->inverse_AG_inertia;
    const double l_G_y__AG_theta = -arm_AG_G_x*p->inverse_AG_inertia;
    const double scale_A5_x = arm_AG_A_y*l_A5_x__AG_theta + p->inverse_AG_mass;
    const double scale_A5_y = -arm_AG_A_x*l_A5_y__AG_theta + p->inverse_AG_mass;
    const double pivot_A5_x__A5_y = arm_AG_A_y*l_A5_y__AG_theta;
    const double determinant_A5_x__A5_y = -(pivot_A5_x__A5_y * pivot_A5_x__A5_y) + scale_A5_x*scale_A5_y;
    if (!(scale_A5_x > 0.0 && scale_A5_x < INFINITY)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_A5_x__A5_y > memory->least * scale_A5_y * scale_A5_x)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_A5_x__A5_y = -1.0/determinant_A5_x__A5_y;
    const double inverse_pivot_A5_x = inverse_A5_x__A5_y*scale_A5_y;
    const double inverse_pivot_A5_y = inverse_A5_x__A5_y*scale_A5_x;
    const double inverse_cross_A5_x__A5_y = -inverse_A5_x__A5_y*pivot_A5_x__A5_y;
    const double w_G_x__A5_x = -arm_AG_A_y*l_G_x__AG_theta - p->inverse_AG_mass;
    const double w_G_x__A5_y = arm_AG_A_x*l_G_x__AG_theta;
    const double l_G_x__A5_x = inverse_cross_A5_x__A5_y*w_G_x__A5_y + inverse_pivot_A5_x*w_G_x__A5_x;
    const double l_G_x__A5_y = inverse_cross_A5_x__A5_y*w_G_x__A5_x + inverse_pivot_A5_y*w_G_x__A5_y;
    const double w_G_y__A5_x = -arm_AG_A_y*l_G_y__AG_theta;
    const double w_G_y__A5_y = arm_AG_A_x*l_G_y__AG_theta - p->inverse_AG_mass;
    const double l_G_y__A5_x = inverse_cross_A5_x__A5_y*w_G_y__A5_y + inverse_pivot_A5_x*w_G_y__A5_x;
    const double l_G_y__A5_y = inverse_cross_A5_x__A5_y*w_G_y__A5_x + inverse_pivot_A5_y*w_G_y__A5_y;
    const double scale_G_x = arm_AG_G_y*l_G_x__AG_theta - arm_EG_G_y*l_G_x__EG_theta + p->inverse_AG_mass
        + p->inverse_EG_mass;
    const double scale_G_y = -arm_AG_G_x*l_G_y__AG_theta + arm_EG_G_x*l_G_y__EG_theta + p->inverse_AG_mass
        + p->inverse_EG_mass;
    const double pivot_G_x = l_G_x__A5_x*w_G_x__A5_x + l_G_x__A5_y*w_G_x__A5_y + scale_G_x;
    const double pivot_G_y = l_G_y__A5_x*w_G_y__A5_x + l_G_y__A5_y*w_G_y__A5_y + scale_G_y;
    const double pivot_G_x__G_y = arm_AG_G_y*l_G_y__AG_theta - arm_EG_G_y*l_G_y__EG_theta + l_G_y__A5_x*w_G_x__A5_x
        + l_G_y__A5_y*w_G_x__A5_y;
    const double determinant_G_x__G_y = pivot_G_x*pivot_G_y - (pivot_G_x__G_y * pivot_G_x__G_y);
    if (!(pivot_G_x > memory->least * scale_G_x)) {
        pivot = 7;
        goto dependent;
    }
    if (!(determinant_G_x__G_y > memory->least * scale_G_y * pivot_G_x)) {
        pivot = 8;
        goto dependent;
    }
    const double inverse_G_x__G_y = -1.0/determinant_G_x__G_y;
    const double inverse_pivot_G_x = inverse_G_x__G_y*pivot_G_y;
    const double inverse_pivot_G_y = inverse_G_x__G_y*pivot_G_x;
    const double inverse_cross_G_x__G_y = -inverse_G_x__G_y*pivot_G_x__G_y;
    const double w_E4_x__G_x = arm_EG_G_y*l_E4_x__EG_theta + p->inverse_EG_mass;
    const double w_E4_x__G_y = -arm_EG_G_x*l_E4_x__EG_theta;
    const double l_E4_x__G_x = inverse_cross_G_x__G_y*w_E4_x__G_y + inverse_pivot_G_x*w_E4_x__G_x;
    const double l_E4_x__G_y = inverse_cross_G_x__G_y*w_E4_x__G_x + inverse_pivot_G_y*w_E4_x__G_y;
    const double w_E4_y__G_x = arm_EG_G_y*l_E4_y__EG_theta;
    const double w_E4_y__G_y = -arm_EG_G_x*l_E4_y__EG_theta + p->inverse_EG_mass;
    const double l_E4_y__G_x = inverse_cross_G_x__G_y*w_E4_y__G_y + inverse_pivot_G_x*w_E4_y__G_x;
    const double l_E4_y__G_y = inverse_cross_G_x__G_y*w_E4_y__G_x + inverse_pivot_G_y*w_E4_y__G_y;
    const double l_H_x__HE_theta = -arm_HE_H_y*p->inverse_HE_inertia;
    const double l_H_y__HE_theta = arm_HE_H_x*p->inverse_HE_inertia;
    const double l_E6_x__HE_theta = arm_HE_E_y*p->inverse_HE_inertia;
    const double l_E6_y__HE_theta = -arm_HE_E_x*p->inverse_HE_inertia;
    const double l_A7_x__AH_theta = arm_AH_A_y*p->inverse_AH_inertia;
    const double l_A7_y__AH_theta = -arm_AH_A_x*p->inverse_AH_inertia;
    const double l_H_x__AH_theta = arm_AH_H_y*p->inverse_AH_inertia;
    const double l_H_y__AH_theta = -arm_AH_H_x*p->inverse_AH_inertia;
    const double scale_A7_x = arm_AH_A_y*l_A7_x__AH_theta + p->inverse_AH_mass;
    const double scale_A7_y = -arm_AH_A_x*l_A7_y__AH_theta + p->inverse_AH_mass;
    const double pivot_A7_x__A7_y = arm_AH_A_y*l_A7_y__AH_theta;
    const double determinant_A7_x__A7_y = -(pivot_A7_x__A7_y * pivot_A7_x__A7_y) + scale_A7_x*scale_A7_y;
    if (!(scale_A7_x > 0.0 && scale_A7_x < INFINITY)) {
        pivot = 9;
        goto dependent;
    }
    if (!(determinant_A7_x__A7_y > memory->least * scale_A7_y * scale_A7_x)) {
        pivot = 10;
        goto dependent;
    }
    const double inverse_A7_x__A7_y = -1.0/determinant_A7_x__A7_y;
    const double inverse_pivot_A7_x = inverse_A7_x__A7_y*scale_A7_y;
    const double inverse_pivot_A7_y = inverse_A7_x__A7_y*scale_A7_x;
    const double inverse_cross_A7_x__A7_y = -inverse_A7_x__A7_y*pivot_A7_x__A7_y;
    const double w_H_x__A7_x = -arm_AH_A_y*l_H_x__AH_theta - p->inverse_AH_mass;
    const double w_H_x__A7_y = arm_AH_A_x*l_H_x__AH_theta;
    const double l_H_x__A7_x = inverse_cross_A7_x__A7_y*w_H_x__A7_y + inverse_pivot_A7_x*w_H_x__A7_x;
    const double l_H_x__A7_y = inverse_cross_A7_x__A7_y*w_H_x__A7_x + inverse_pivot_A7_y*w_H_x__A7_y;
    const double w_H_y__A7_x = -arm_AH_A_y*l_H_y__AH_theta;
    const double w_H_y__A7_y = arm_AH_A_x*l_H_y__AH_theta - p->inverse_AH_mass;
    const double l_H_y__A7_x = inverse_cross_A7_x__A7_y*w_H_y__A7_y + inverse_pivot_A7_x*w_H_y__A7_x;
    const double l_H_y__A7_y = inverse_cross_A7_x__A7_y*w_H_y__A7_x + inverse_pivot_A7_y*w_H_y__A7_y;
    const double scale_H_x = arm_AH_H_y*l_H_x__AH_theta - arm_HE_H_y*l_H_x__HE_theta + p->inverse_AH_mass
        + p->inverse_HE_mass;
    const double scale_H_y = -arm_AH_H_x*l_H_y__AH_theta + arm_HE_H_x*l_H_y__HE_theta + p->inverse_AH_mass
        + p->inverse_HE_mass;
    const double pivot_H_x = l_H_x__A7_x*w_H_x__A7_x + l_H_x__A7_y*w_H_x__A7_y + scale_H_x;
    const double pivot_H_y = l_H_y__A7_x*w_H_y__A7_x + l_H_y__A7_y*w_H_y__A7_y + scale_H_y;
    const double pivot_H_x__H_y = arm_AH_H_y*l_H_y__AH_theta - arm_HE_H_y*l_H_y__HE_theta + l_H_y__A7_x*w_H_x__A7_x
        + l_H_y__A7_y*w_H_x__A7_y;
    const double determinant_H_x__H_y = pivot_H_x*pivot_H_y - (pivot_H_x__H_y * pivot_H_x__H_y);
    if (!(pivot_H_x > memory->least * scale_H_x)) {
        pivot = 11;
        goto dependent;
    }
    if (!(determinant_H_x__H_y > memory->least * scale_H_y * pivot_H_x)) {
        pivot = 12;
        goto dependent;
    }
    const double inverse_H_x__H_y = -1.0/determinant_H_x__H_y;
    const double inverse_pivot_H_x = inverse_H_x__H_y*pivot_H_y;
    const double inverse_pivot_H_y = inverse_H_x__H_y*pivot_H_x;
    const double inverse_cross_H_x__H_y = -inverse_H_x__H_y*pivot_H_x__H_y;
    const double w_E6_x__H_x = arm_HE_H_y*l_E6_x__HE_theta + p->inverse_HE_mass;
    const double w_E6_x__H_y = -arm_HE_H_x*l_E6_x__HE_theta;
    const double l_E6_x__H_x = inverse_cross_H_x__H_y*w_E6_x__H_y + inverse_pivot_H_x*w_E6_x__H_x;
    const double l_E6_x__H_y = inverse_cross_H_x__H_y*w_E6_x__H_x + inverse_pivot_H_y*w_E6_x__H_y;
    const double w_E6_y__H_x = arm_HE_H_y*l_E6_y__HE_theta;
    const double w_E6_y__H_y = -arm_HE_H_x*l_E6_y__HE_theta + p->inverse_HE_mass;
    const double l_E6_y__H_x = inverse_cross_H_x__H_y*w_E6_y__H_y + inverse_pivot_H_x*w_E6_y__H_x;
    const double l_E6_y__H_y = inverse_cross_H_x__H_y*w_E6_y__H_x + inverse_pivot_H_y*w_E6_y__H_y;
    const double l_F_x__FE_theta = arm_FE_F_y*p->inverse_FE_inertia;
    const double l_F_y__FE_theta = -arm_FE_F_x*p->inverse_FE_inertia;
    const double l_E3_x__FE_theta = -arm_FE_E_y*p->inverse_FE_inertia;
    const double l_E3_y__FE_theta = arm_FE_E_x*p->inverse_FE_inertia;
    const double l_E4_x__FE_theta = -arm_FE_E_y*p->inverse_FE_inertia;
    const double l_E4_y__FE_theta = arm_FE_E_x*p->inverse_FE_inertia;
    const double l_E6_x__FE_theta = -arm_FE_E_y*p->inverse_FE_inertia;
    const double l_E6_y__FE_theta = arm_FE_E_x*p->inverse_FE_inertia;
    const double scale_F_x = arm_FE_F_y*l_F_x__FE_theta - arm_OF_F_y*l_F_x__OF_theta + p->inverse_FE_mass
        + p->inverse_OF_mass;
    const double scale_F_y = -arm_FE_F_x*l_F_y__FE_theta + arm_OF_F_x*l_F_y__OF_theta + p->inverse_FE_mass
        + p->inverse_OF_mass;
    const double pivot_F_x = l_F_x__O_x*w_F_x__O_x + l_F_x__O_y*w_F_x__O_y + scale_F_x;
    const double pivot_F_y = l_F_y__O_x*w_F_y__O_x + l_F_y__O_y*w_F_y__O_y + scale_F_y;
    const double pivot_F_x__F_y = arm_FE_F_y*l_F_y__FE_theta - arm_OF_F_y*l_F_y__OF_theta + l_F_y__O_x*w_F_x__O_x
        + l_F_y__O_y*w_F_x__O_y;
    const double determinant_F_x__F_y = pivot_F_x*pivot_F_y - (pivot_F_x__F_y * pivot_F_x__F_y);
    if (!(pivot_F_x > memory->least * scale_F_x)) {
        pivot = 13;
        goto dependent;
    }
    if (!(determinant_F_x__F_y > memory->least * scale_F_y * pivot_F_x)) {
        pivot = 14;
        goto dependent;
    }
    const double inverse_F_x__F_y = -1.0/determinant_F_x__F_y;
    const double inverse_pivot_F_x = inverse_F_x__F_y*pivot_F_y;
    const double inverse_pivot_F_y = inverse_F_x__F_y*pivot_F_x;
    const double inverse_cross_F_x__F_y = -inverse_F_x__F_y*pivot_F_x__F_y;
    const double w_E3_x__F_x = -arm_FE_F_y*l_E3_x__FE_theta + p->inverse_FE_mass;
    const double w_E3_x__F_y = arm_FE_F_x*l_E3_x__FE_theta;
    const double l_E3_x__F_x = inverse_cross_F_x__F_y*w_E3_x__F_y + inverse_pivot_F_x*w_E3_x__F_x;
    const double l_E3_x__F_y = inverse_cross_F_x__F_y*w_E3_x__F_x + inverse_pivot_F_y*w_E3_x__F_y;
    const double w_E3_y__F_x = -arm_FE_F_y*l_E3_y__FE_theta;
    const double w_E3_y__F_y = arm_FE_F_x*l_E3_y__FE_theta + p->inverse_FE_mass;
    const double l_E3_y__F_x = inverse_cross_F_x__F_y*w_E3_y__F_y + inverse_pivot_F_x*w_E3_y__F_x;
    const double l_E3_y__F_y = inverse_cross_F_x__F_y*w_E3_y__F_x + inverse_pivot_F_y*w_E3_y__F_y;
    const double w_E4_x__F_x = -arm_FE_F_y*l_E4_x__FE_theta + p->inverse_FE_mass;
    const double w_E4_x__F_y = arm_FE_F_x*l_E4_x__FE_theta;
    const double l_E4_x__F_x = inverse_cross_F_x__F_y*w_E4_x__F_y + inverse_pivot_F_x*w_E4_x__F_x;
    const double l_E4_x__F_y = inverse_cross_F_x__F_y*w_E4_x__F_x + inverse_pivot_F_y*w_E4_x__F_y;
    const double w_E4_y__F_x = -arm_FE_F_y*l_E4_y__FE_theta;
    const double w_E4_y__F_y = arm_FE_F_x*l_E4_y__FE_theta + p->inverse_FE_mass;
    const double l_E4_y__F_x = inverse_cross_F_x__F_y*w_E4_y__F_y + inverse_pivot_F_x*w_E4_y__F_x;
    const double l_E4_y__F_y = inverse_cross_F_x__F_y*w_E4_y__F_x + inverse_pivot_F_y*w_E4_y__F_y;
    const double w_E6_x__F_x = -arm_FE_F_y*l_E6_x__FE_theta + p->inverse_FE_mass;
    const double w_E6_x__F_y = arm_FE_F_x*l_E6_x__FE_theta;
    const double l_E6_x__F_x = inverse_cross_F_x__F_y*w_E6_x__F_y + inverse_pivot_F_x*w_E6_x__F_x;
    const double l_E6_x__F_y = inverse_cross_F_x__F_y*w_E6_x__F_x + inverse_pivot_F_y*w_E6_x__F_y;
    const double w_E6_y__F_x = -arm_FE_F_y*l_E6_y__FE_theta;
    const double w_E6_y__F_y = arm_FE_F_x*l_E6_y__FE_theta + p->inverse_FE_mass;
    const double l_E6_y__F_x = inverse_cross_F_x__F_y*w_E6_y__F_y + inverse_pivot_F_x*w_E6_y__F_x;
    const double l_E6_y__F_y = inverse_cross_F_x__F_y*w_E6_y__F_x + inverse_pivot_F_y*w_E6_y__F_y;
    const double scale_E3_x = arm_BDE_E_y*l_E3_x__BDE_theta - arm_FE_E_y*l_E3_x__FE_theta + p->inverse_BDE_mass
        + p->inverse_FE_mass;
    const double scale_E3_y = -arm_BDE_E_x*l_E3_y__BDE_theta + arm_FE_E_x*l_E3_y__FE_theta + p->inverse_BDE_mass
        + p->inverse_FE_mass;
    const double pivot_E3_x = l_E3_x__B_x*w_E3_x__B_x + l_E3_x__B_y*w_E3_x__B_y + l_E3_x__F_x*w_E3_x__F_x
        + l_E3_x__F_y*w_E3_x__F_y + scale_E3_x;
    const double pivot_E3_y = l_E3_y__B_x*w_E3_y__B_x + l_E3_y__B_y*w_E3_y__B_y + l_E3_y__F_x*w_E3_y__F_x
        + l_E3_y__F_y*w_E3_y__F_y + scale_E3_y;
    const double pivot_E3_x__E3_y = arm_BDE_E_y*l_E3_y__BDE_theta - arm_FE_E_y*l_E3_y__FE_theta
        + l_E3_y__B_x*w_E3_x__B_x + l_E3_y__B_y*w_E3_x__B_y + l_E3_y__F_x*w_E3_x__F_x + l_E3_y__F_y*w_E3_x__F_y;
    const double determinant_E3_x__E3_y = pivot_E3_x*pivot_E3_y - (pivot_E3_x__E3_y * pivot_E3_x__E3_y);
    if (!(pivot_E3_x > memory->least * scale_E3_x)) {
        pivot = 15;
        goto dependent;
    }
    if (!(determinant_E3_x__E3_y > memory->least * scale_E3_y * pivot_E3_x)) {
        pivot = 16;
        goto dependent;
    }
    const double inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const double inverse_pivot_E3_x = inverse_E3_x__E3_y*pivot_E3_y;
    const double inverse_pivot_E3_y = inverse_E3_x__E3_y*pivot_E3_x;
    const double inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;
    const double w_E4_x__E3_x = arm_FE_E_y*l_E4_x__FE_theta - p->inverse_FE_mass - l_E4_x__F_x*w_E3_x__F_x
        - l_E4_x__F_y*w_E3_x__F_y;
    const double w_E4_x__E3_y = -arm_FE_E_x*l_E4_x__FE_theta - l_E4_x__F_x*w_E3_y__F_x - l_E4_x__F_y*w_E3_y__F_y;
    const double l_E4_x__E3_x = inverse_cross_E3_x__E3_y*w_E4_x__E3_y + inverse_pivot_E3_x*w_E4_x__E3_x;
    const double l_E4_x__E3_y = inverse_cross_E3_x__E3_y*w_E4_x__E3_x + inverse_pivot_E3_y*w_E4_x__E3_y;
    const double w_E4_y__E3_x = arm_FE_E_y*l_E4_y__FE_theta - l_E4_y__F_x*w_E3_x__F_x - l_E4_y__F_y*w_E3_x__F_y;
    const double w_E4_y__E3_y = -arm_FE_E_x*l_E4_y__FE_theta - p->inverse_FE_mass - l_E4_y__F_x*w_E3_y__F_x
        - l_E4_y__F_y*w_E3_y__F_y;
    const double l_E4_y__E3_x = inverse_cross_E3_x__E3_y*w_E4_y__E3_y + inverse_pivot_E3_x*w_E4_y__E3_x;
    const double l_E4_y__E3_y = inverse_cross_E3_x__E3_y*w_E4_y__E3_x + inverse_pivot_E3_y*w_E4_y__E3_y;
    const double w_E6_x__E3_x = arm_FE_E_y*l_E6_x__FE_theta - p->inverse_FE_mass - l_E6_x__F_x*w_E3_x__F_x
        - l_E6_x__F_y*w_E3_x__F_y;
    const double w_E6_x__E3_y = -arm_FE_E_x*l_E6_x__FE_theta - l_E6_x__F_x*w_E3_y__F_x - l_E6_x__F_y*w_E3_y__F_y;
    const double l_E6_x__E3_x = inverse_cross_E3_x__E3_y*w_E6_x__E3_y + inverse_pivot_E3_x*w_E6_x__E3_x;
    const double l_E6_x__E3_y = inverse_cross_E3_x__E3_y*w_E6_x__E3_x + inverse_pivot_E3_y*w_E6_x__E3_y;
    const double w_E6_y__E3_x = arm_FE_E_y*l_E6_y__FE_theta - l_E6_y__F_x*w_E3_x__F_x - l_E6_y__F_y*w_E3_x__F_y;
    const double w_E6_y__E3_y = -arm_FE_E_x*l_E6_y__FE_theta - p->inverse_FE_mass - l_E6_y__F_x*w_E3_y__F_x
        - l_E6_y__F_y*w_E3_y__F_y;
    const double l_E6_y__E3_x = inverse_cross_E3_x__E3_y*w_E6_y__E3_y + inverse_pivot_E3_x*w_E6_y__E3_x;
    const double l_E6_y__E3_y = inverse_cross_E3_x__E3_y*w_E6_y__E3_x + inverse_pivot_E3_y*w_E6_y__E3_y;
    const double scale_E4_x = arm_EG_E_y*l_E4_x__EG_theta - arm_FE_E_y*l_E4_x__FE_theta + p->inverse_EG_mass
        + p->inverse_FE_mass;
    const double scale_E4_y = -arm_EG_E_x*l_E4_y__EG_theta + arm_FE_E_x*l_E4_y__FE_theta + p->inverse_EG_mass
        + p->inverse_FE_mass;
    const double pivot_E4_x = l_E4_x__E3_x*w_E4_x__E3_x + l_E4_x__E3_y*w_E4_x__E3_y + l_E4_x__F_x*w_E4_x__F_x
        + l_E4_x__F_y*w_E4_x__F_y + l_E4_x__G_x*w_E4_x__G_x + l_E4_x__G_y*w_E4_x__G_y + scale_E4_x;
    const double pivot_E4_y = l_E4_y__E3_x*w_E4_y__E3_x + l_E4_y__E3_y*w_E4_y__E3_y + l_E4_y__F_x*w_E4_y__F_x
        + l_E4_y__F_y*w_E4_y__F_y + l_E4_y__G_x*w_E4_y__G_x + l_E4_y__G_y*w_E4_y__G_y + scale_E4_y;
    const double pivot_E4_x__E4_y = arm_EG_E_y*l_E4_y__EG_theta - arm_FE_E_y*l_E4_y__FE_theta
        + l_E4_y__E3_x*w_E4_x__E3_x + l_E4_y__E3_y*w_E4_x__E3_y + l_E4_y__F_x*w_E4_x__F_x + l_E4_y__F_y*w_E4_x__F_y
        + l_E4_y__G_x*w_E4_x__G_x + l_E4_y__G_y*w_E4_x__G_y;
    const double determinant_E4_x__E4_y = pivot_E4_x*pivot_E4_y - (pivot_E4_x__E4_y * pivot_E4_x__E4_y);
    if (!(pivot_E4_x > memory->least * scale_E4_x)) {
        pivot = 17;
        goto dependent;
    }
    if (!(determinant_E4_x__E4_y > memory->least * scale_E4_y * pivot_E4_x)) {
        pivot = 18;
        goto dependent;
    }
    const double inverse_E4_x__E4_y = -1.0/determinant_E4_x__E4_y;
    const double inverse_pivot_E4_x = inverse_E4_x__E4_y*pivot_E4_y;
    const double inverse_pivot_E4_y = inverse_E4_x__E4_y*pivot_E4_x;
    const double inverse_cross_E4_x__E4_y = -inverse_E4_x__E4_y*pivot_E4_x__E4_y;
    const double w_E6_x__E4_x = arm_FE_E_y*l_E6_x__FE_theta - p->inverse_FE_mass - l_E6_x__E3_x*w_E4_x__E3_x
        - l_E6_x__E3_y*w_E4_x__E3_y - l_E6_x__F_x*w_E4_x__F_x - l_E6_x__F_y*w_E4_x__F_y;
    const double w_E6_x__E4_y = -arm_FE_E_x*l_E6_x__FE_theta - l_E6_x__E3_x*w_E4_y__E3_x - l_E6_x__E3_y*w_E4_y__E3_y
        - l_E6_x__F_x*w_E4_y__F_x - l_E6_x__F_y*w_E4_y__F_y;
    const double l_E6_x__E4_x = inverse_cross_E4_x__E4_y*w_E6_x__E4_y + inverse_pivot_E4_x*w_E6_x__E4_x;
    const double l_E6_x__E4_y = inverse_cross_E4_x__E4_y*w_E6_x__E4_x + inverse_pivot_E4_y*w_E6_x__E4_y;
    const double w_E6_y__E4_x = arm_FE_E_y*l_E6_y__FE_theta - l_E6_y__E3_x*w_E4_x__E3_x - l_E6_y__E3_y*w_E4_x__E3_y
        - l_E6_y__F_x*w_E4_x__F_x - l_E6_y__F_y*w_E4_x__F_y;
    const double w_E6_y__E4_y = -arm_FE_E_x*l_E6_y__FE_theta - p->inverse_FE_mass - l_E6_y__E3_x*w_E4_y__E3_x
        - l_E6_y__E3_y*w_E4_y__E3_y - l_E6_y__F_x*w_E4_y__F_x - l_E6_y__F_y*w_E4_y__F_y;
    const double l_E6_y__E4_x = inverse_cross_E4_x__E4_y*w_E6_y__E4_y + inverse_pivot_E4_x*w_E6_y__E4_x;
    const double l_E6_y__E4_y = inverse_cross_E4_x__E4_y*w_E6_y__E4_x + inverse_pivot_E4_y*w_E6_y__E4_y;
    const double scale_E6_x = -arm_FE_E_y*l_E6_x__FE_theta + arm_HE_E_y*l_E6_x__HE_theta + p->inverse_FE_mass
        + p->inverse_HE_mass;
    const double scale_E6_y = arm_FE_E_x*l_E6_y__FE_theta - arm_HE_E_x*l_E6_y__HE_theta + p->inverse_FE_mass
        + p->inverse_HE_mass;
    const double pivot_E6_x = l_E6_x__E3_x*w_E6_x__E3_x + l_E6_x__E3_y*w_E6_x__E3_y + l_E6_x__E4_x*w_E6_x__E4_x
        + l_E6_x__E4_y*w_E6_x__E4_y + l_E6_x__F_x*w_E6_x__F_x + l_E6_x__F_y*w_E6_x__F_y + l_E6_x__H_x*w_E6_x__H_x
        + l_E6_x__H_y*w_E6_x__H_y + scale_E6_x;
    const double pivot_E6_y = l_E6_y__E3_x*w_E6_y__E3_x + l_E6_y__E3_y*w_E6_y__E3_y + l_E6_y__E4_x*w_E6_y__E4_x
        + l_E6_y__E4_y*w_E6_y__E4_y + l_E6_y__F_x*w_E6_y__F_x + l_E6_y__F_y*w_E6_y__F_y + l_E6_y__H_x*w_E6_y__H_x
        + l_E6_y__H_y*w_E6_y__H_y + scale_E6_y;
    const double pivot_E6_x__E6_y = -arm_FE_E_y*l_E6_y__FE_theta + arm_HE_E_y*l_E6_y__HE_theta
        + l_E6_y__E3_x*w_E6_x__E3_x + l_E6_y__E3_y*w_E6_x__E3_y + l_E6_y__E4_x*w_E6_x__E4_x + l_E6_y__E4_y*w_E6_x__E4_y
        + l_E6_y__F_x*w_E6_x__F_x + l_E6_y__F_y*w_E6_x__F_y + l_E6_y__H_x*w_E6_x__H_x + l_E6_y__H_y*w_E6_x__H_y;
    const double determinant_E6_x__E6_y = pivot_E6_x*pivot_E6_y - (pivot_E6_x__E6_y * pivot_E6_x__E6_y);
    if (!(pivot_E6_x > memory->least * scale_E6_x)) {
        pivot = 19;
        goto dependent;
    }
    if (!(determinant_E6_x__E6_y > memory->least * scale_E6_y * pivot_E6_x)) {
        pivot = 20;
        goto dependent;
    }
    const double inverse_E6_x__E6_y = -1.0/determinant_E6_x__E6_y;
    const double inverse_pivot_E6_x = inverse_E6_x__E6_y*pivot_E6_y;
    const double inverse_pivot_E6_y = inverse_E6_x__E6_y*pivot_E6_x;
    const double inverse_cross_E6_x__E6_y = -inverse_E6_x__E6_y*pivot_E6_x__E6_y;

    /* forward substitution */
    const double z_BDE_x = -spring_pull*spring_span_x;
    const double z_BDE_y = -spring_pull*spring_span_y;
    const double z_O_x = -l_O_x__OF_theta*p->motor_value + rhs_O_x;
    const double z_O_y = -l_O_y__OF_theta*p->motor_value + rhs_O_y;
    const double z_BDE_theta = -arm_BDE_D_x*spring_pull*spring_span_y + arm_BDE_D_y*spring_pull*spring_span_x;
    const double z_B_x = p->inverse_BDE_mass*z_BDE_x - l_B_x__BDE_theta*z_BDE_theta + rhs_B_x;
    const double z_B_y = p->inverse_BDE_mass*z_BDE_y - l_B_y__BDE_theta*z_BDE_theta + rhs_B_y;
    const double z_G_x = -l_G_x__A5_x*rhs_A5_x - l_G_x__A5_y*rhs_A5_y + rhs_G_x;
    const double z_G_y = -l_G_y__A5_x*rhs_A5_x - l_G_y__A5_y*rhs_A5_y + rhs_G_y;
    const double z_H_x = -l_H_x__A7_x*rhs_A7_x - l_H_x__A7_y*rhs_A7_y + rhs_H_x;
    const double z_H_y = -l_H_y__A7_x*rhs_A7_x - l_H_y__A7_y*rhs_A7_y + rhs_H_y;
    const double z_F_x = -l_F_x__OF_theta*p->motor_value - l_F_x__O_x*z_O_x - l_F_x__O_y*z_O_y + rhs_F_x;
    const double z_F_y = -l_F_y__OF_theta*p->motor_value - l_F_y__O_x*z_O_x - l_F_y__O_y*z_O_y + rhs_F_y;
    const double z_E3_x = p->inverse_BDE_mass*z_BDE_x - l_E3_x__BDE_theta*z_BDE_theta - l_E3_x__B_x*z_B_x
        - l_E3_x__B_y*z_B_y - l_E3_x__F_x*z_F_x - l_E3_x__F_y*z_F_y + rhs_E3_x;
    const double z_E3_y = p->inverse_BDE_mass*z_BDE_y - l_E3_y__BDE_theta*z_BDE_theta - l_E3_y__B_x*z_B_x
        - l_E3_y__B_y*z_B_y - l_E3_y__F_x*z_F_x - l_E3_y__F_y*z_F_y + rhs_E3_y;
    const double z_E4_x = -l_E4_x__E3_x*z_E3_x - l_E4_x__E3_y*z_E3_y - l_E4_x__F_x*z_F_x - l_E4_x__F_y*z_F_y
        - l_E4_x__G_x*z_G_x - l_E4_x__G_y*z_G_y + rhs_E4_x;
    const double z_E4_y = -l_E4_y__E3_x*z_E3_x - l_E4_y__E3_y*z_E3_y - l_E4_y__F_x*z_F_x - l_E4_y__F_y*z_F_y
        - l_E4_y__G_x*z_G_x - l_E4_y__G_y*z_G_y + rhs_E4_y;
    const double z_E6_x = -l_E6_x__E3_x*z_E3_x - l_E6_x__E3_y*z_E3_y - l_E6_x__E4_x*z_E4_x - l_E6_x__E4_y*z_E4_y
        - l_E6_x__F_x*z_F_x - l_E6_x__F_y*z_F_y - l_E6_x__H_x*z_H_x - l_E6_x__H_y*z_H_y + rhs_E6_x;
    const double z_E6_y = -l_E6_y__E3_x*z_E3_x - l_E6_y__E3_y*z_E3_y - l_E6_y__E4_x*z_E4_x - l_E6_y__E4_y*z_E4_y
        - l_E6_y__F_x*z_F_x - l_E6_y__F_y*z_F_y - l_E6_y__H_x*z_H_x - l_E6_y__H_y*z_H_y + rhs_E6_y;

    /* backward substitution */
    const double lambda_E6_y = inverse_cross_E6_x__E6_y*z_E6_x + inverse_pivot_E6_y*z_E6_y;
    const double lambda_E6_x = inverse_cross_E6_x__E6_y*z_E6_y + inverse_pivot_E6_x*z_E6_x;
    const double lambda_E4_y = inverse_cross_E4_x__E4_y*z_E4_x + inverse_pivot_E4_y*z_E4_y - l_E6_x__E4_y*lambda_E6_x
        - l_E6_y__E4_y*lambda_E6_y;
    const double lambda_E4_x = inverse_cross_E4_x__E4_y*z_E4_y + inverse_pivot_E4_x*z_E4_x - l_E6_x__E4_x*lambda_E6_x
        - l_E6_y__E4_x*lambda_E6_y;
    const double lambda_E3_y = inverse_cross_E3_x__E3_y*z_E3_x + inverse_pivot_E3_y*z_E3_y - l_E4_x__E3_y*lambda_E4_x
        - l_E4_y__E3_y*lambda_E4_y - l_E6_x__E3_y*lambda_E6_x - l_E6_y__E3_y*lambda_E6_y;
    const double lambda_E3_x = inverse_cross_E3_x__E3_y*z_E3_y + inverse_pivot_E3_x*z_E3_x - l_E4_x__E3_x*lambda_E4_x
        - l_E4_y__E3_x*lambda_E4_y - l_E6_x__E3_x*lambda_E6_x - l_E6_y__E3_x*lambda_E6_y;
    const double lambda_F_y = inverse_cross_F_x__F_y*z_F_x + inverse_pivot_F_y*z_F_y - l_E3_x__F_y*lambda_E3_x
        - l_E3_y__F_y*lambda_E3_y - l_E4_x__F_y*lambda_E4_x - l_E4_y__F_y*lambda_E4_y - l_E6_x__F_y*lambda_E6_x
        - l_E6_y__F_y*lambda_E6_y;
    const double lambda_F_x = inverse_cross_F_x__F_y*z_F_y + inverse_pivot_F_x*z_F_x - l_E3_x__F_x*lambda_E3_x
        - l_E3_y__F_x*lambda_E3_y - l_E4_x__F_x*lambda_E4_x - l_E4_y__F_x*lambda_E4_y - l_E6_x__F_x*lambda_E6_x
        - l_E6_y__F_x*lambda_E6_y;
    const double acceleration_FE_theta = -l_E3_x__FE_theta*lambda_E3_x - l_E3_y__FE_theta*lambda_E3_y
        - l_E4_x__FE_theta*lambda_E4_x - l_E4_y__FE_theta*lambda_E4_y - l_E6_x__FE_theta*lambda_E6_x
        - l_E6_y__FE_theta*lambda_E6_y - l_F_x__FE_theta*lambda_F_x - l_F_y__FE_theta*lambda_F_y;
    const double lambda_H_y = inverse_cross_H_x__H_y*z_H_x + inverse_pivot_H_y*z_H_y - l_E6_x__H_y*lambda_E6_x
        - l_E6_y__H_y*lambda_E6_y;
    const double lambda_H_x = inverse_cross_H_x__H_y*z_H_y + inverse_pivot_H_x*z_H_x - l_E6_x__H_x*lambda_E6_x
        - l_E6_y__H_x*lambda_E6_y;
    const double lambda_A7_y = inverse_cross_A7_x__A7_y*rhs_A7_x + inverse_pivot_A7_y*rhs_A7_y - l_H_x__A7_y*lambda_H_x
        - l_H_y__A7_y*lambda_H_y;
    const double lambda_A7_x = inverse_cross_A7_x__A7_y*rhs_A7_y + inverse_pivot_A7_x*rhs_A7_x - l_H_x__A7_x*lambda_H_x
        - l_H_y__A7_x*lambda_H_y;
    const double acceleration_AH_theta = -l_A7_x__AH_theta*lambda_A7_x - l_A7_y__AH_theta*lambda_A7_y
        - l_H_x__AH_theta*lambda_H_x - l_H_y__AH_theta*lambda_H_y;
    const double acceleration_HE_theta = -l_E6_x__HE_theta*lambda_E6_x - l_E6_y__HE_theta*lambda_E6_y
        - l_H_x__HE_theta*lambda_H_x - l_H_y__HE_theta*lambda_H_y;
    const double lambda_G_y = inverse_cross_G_x__G_y*z_G_x + inverse_pivot_G_y*z_G_y - l_E4_x__G_y*lambda_E4_x
        - l_E4_y__G_y*lambda_E4_y;
    const double lambda_G_x = inverse_cross_G_x__G_y*z_G_y + inverse_pivot_G_x*z_G_x - l_E4_x__G_x*lambda_E4_x
        - l_E4_y__G_x*lambda_E4_y;
    const double lambda_A5_y = inverse_cross_A5_x__A5_y*rhs_A5_x + inverse_pivot_A5_y*rhs_A5_y - l_G_x__A5_y*lambda_G_x
        - l_G_y__A5_y*lambda_G_y;
    const double lambda_A5_x = inverse_cross_A5_x__A5_y*rhs_A5_y + inverse_pivot_A5_x*rhs_A5_x - l_G_x__A5_x*lambda_G_x
        - l_G_y__A5_x*lambda_G_y;
    const double acceleration_AG_theta = -l_A5_x__AG_theta*lambda_A5_x - l_A5_y__AG_theta*lambda_A5_y
        - l_G_x__AG_theta*lambda_G_x - l_G_y__AG_theta*lambda_G_y;
    const double acceleration_EG_theta = -l_E4_x__EG_theta*lambda_E4_x - l_E4_y__EG_theta*lambda_E4_y
        - l_G_x__EG_theta*lambda_G_x - l_G_y__EG_theta*lambda_G_y;
    const double lambda_B_y = inverse_cross_B_x__B_y*z_B_x + inverse_pivot_B_y*z_B_y - l_E3_x__B_y*lambda_E3_x
        - l_E3_y__B_y*lambda_E3_y;
    const double lambda_B_x = inverse_cross_B_x__B_y*z_B_y + inverse_pivot_B_x*z_B_x - l_E3_x__B_x*lambda_E3_x
        - l_E3_y__B_x*lambda_E3_y;
    const double acceleration_BDE_theta = p->inverse_BDE_inertia*z_BDE_theta - l_B_x__BDE_theta*lambda_B_x
        - l_B_y__BDE_theta*lambda_B_y - l_E3_x__BDE_theta*lambda_E3_x - l_E3_y__BDE_theta*lambda_E3_y;
    const double acceleration_FE_y = -p->inverse_FE_mass*lambda_E3_y - p->inverse_FE_mass*lambda_E4_y
        - p->inverse_FE_mass*lambda_E6_y + p->inverse_FE_mass*lambda_F_y;
    const double acceleration_FE_x = -p->inverse_FE_mass*lambda_E3_x - p->inverse_FE_mass*lambda_E4_x
        - p->inverse_FE_mass*lambda_E6_x + p->inverse_FE_mass*lambda_F_x;
    const double lambda_O_y = inverse_cross_O_x__O_y*z_O_x + inverse_pivot_O_y*z_O_y - l_F_x__O_y*lambda_F_x
        - l_F_y__O_y*lambda_F_y;
    const double lambda_O_x = inverse_cross_O_x__O_y*z_O_y + inverse_pivot_O_x*z_O_x - l_F_x__O_x*lambda_F_x
        - l_F_y__O_x*lambda_F_y;
    const double acceleration_OF_theta = p->inverse_OF_inertia*p->motor_value - l_F_x__OF_theta*lambda_F_x
        - l_F_y__OF_theta*lambda_F_y - l_O_x__OF_theta*lambda_O_x - l_O_y__OF_theta*lambda_O_y;
    const double acceleration_AH_y = p->inverse_AH_mass*lambda_A7_y + p->inverse_AH_mass*lambda_H_y;
    const double acceleration_AH_x = p->inverse_AH_mass*lambda_A7_x + p->inverse_AH_mass*lambda_H_x;
    const double acceleration_HE_y = p->inverse_HE_mass*lambda_E6_y - p->inverse_HE_mass*lambda_H_y;
    const double acceleration_HE_x = p->inverse_HE_mass*lambda_E6_x - p->inverse_HE_mass*lambda_H_x;
    const double acceleration_AG_y = p->inverse_AG_mass*lambda_A5_y + p->inverse_AG_mass*lambda_G_y;
    const double acceleration_AG_x = p->inverse_AG_mass*lambda_A5_x + p->inverse_AG_mass*lambda_G_x;
    const double acceleration_EG_y = p->inverse_EG_mass*lambda_E4_y - p->inverse_EG_mass*lambda_G_y;
    const double acceleration_EG_x = p->inverse_EG_mass*lambda_E4_x - p->inverse_EG_mass*lambda_G_x;
    const double acceleration_BDE_y = p->inverse_BDE_mass*lambda_B_y + p->inverse_BDE_mass*lambda_E3_y
        + p->inverse_BDE_mass*z_BDE_y;
    const double acceleration_BDE_x = p->inverse_BDE_mass*lambda_B_x + p->inverse_BDE_mass*lambda_E3_x
        + p->inverse_BDE_mass*z_BDE_x;
    const double acceleration_OF_y = -p->inverse_OF_mass*lambda_F_y + p->inverse_OF_mass*lambda_O_y;
    const double acceleration_OF_x = -p->inverse_OF_mass*lambda_F_x + p->inverse_OF_mass*lambda_O_x;

    /* results */
    a[0] = acceleration_OF_x;
    a[1] = acceleration_OF_y;
    a[2] = acceleration_OF_theta;
    a[3] = acceleration_FE_x;
    a[4] = acceleration_FE_y;
    a[5] = acceleration_FE_theta;
    a[6] = acceleration_BDE_x;
    a[7] = acceleration_BDE_y;
    a[8] = acceleration_BDE_theta;
    a[9] = acceleration_EG_x;
    a[10] = acceleration_EG_y;
    a[11] = acceleration_EG_theta;
    a[12] = acceleration_AG_x;
    a[13] = acceleration_AG_y;
    a[14] = acceleration_AG_theta;
    a[15] = acceleration_HE_x;
    a[16] = acceleration_HE_y;
    a[17] = acceleration_HE_theta;
    a[18] = acceleration_AH_x;
    a[19] = acceleration_AH_y;
    a[20] = acceleration_AH_theta;
    aside->lambda[0] = lambda_O_x;
    aside->lambda[1] = lambda_O_y;
    aside->lambda[2] = lambda_B_x;
    aside->lambda[3] = lambda_B_y;
    aside->lambda[4] = lambda_A5_x;
    aside->lambda[5] = lambda_A5_y;
    aside->lambda[6] = lambda_A7_x;
    aside->lambda[7] = lambda_A7_y;
    aside->lambda[8] = lambda_F_x;
    aside->lambda[9] = lambda_F_y;
    aside->lambda[10] = lambda_E3_x;
    aside->lambda[11] = lambda_E3_y;
    aside->lambda[12] = lambda_E4_x;
    aside->lambda[13] = lambda_E4_y;
    aside->lambda[14] = lambda_E6_x;
    aside->lambda[15] = lambda_E6_y;
    aside->lambda[16] = lambda_G_x;
    aside->lambda[17] = lambda_G_y;
    aside->lambda[18] = lambda_H_x;
    aside->lambda[19] = lambda_H_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = 0.0;
        force[2] = p->motor_value;
        force[3] = 0.0;
        force[4] = 0.0;
        force[5] = 0.0;
        force[6] = -spring_pull*spring_span_x;
        force[7] = -spring_pull*spring_span_y;
        force[8] = -arm_BDE_D_x*spring_pull*spring_span_y + arm_BDE_D_y*spring_pull*spring_span_x;
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
        rhs[0] = rhs_O_x;
        rhs[1] = rhs_O_y;
        rhs[2] = rhs_B_x;
        rhs[3] = rhs_B_y;
        rhs[4] = rhs_A5_x;
        rhs[5] = rhs_A5_y;
        rhs[6] = rhs_A7_x;
        rhs[7] = rhs_A7_y;
        rhs[8] = rhs_F_x;
        rhs[9] = rhs_F_y;
        rhs[10] = rhs_E3_x;
        rhs[11] = rhs_E3_y;
        rhs[12] = rhs_E4_x;
        rhs[13] = rhs_E4_y;
        rhs[14] = rhs_E6_x;
        rhs[15] = rhs_E6_y;
        rhs[16] = rhs_G_x;
        rhs[17] = rhs_G_y;
        rhs[18] = rhs_H_x;
        rhs[19] = rhs_H_y;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = OF_omega*p->motor_value;
    aside->power[2] = 0.0;
    return pivot;
}
