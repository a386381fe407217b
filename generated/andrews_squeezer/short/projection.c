/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)memory;
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
    const double inverse_OF_mass = p->inverse_OF_mass;
    const double inverse_BDE_mass = p->inverse_BDE_mass;
    const double inverse_EG_mass = p->inverse_EG_mass;
    const double inverse_AG_mass = p->inverse_AG_mass;
    const double inverse_HE_mass = p->inverse_HE_mass;
    const double inverse_AH_mass = p->inverse_AH_mass;
    const double inverse_OF_inertia = p->inverse_OF_inertia;
    const double inverse_FE_mass = p->inverse_FE_mass;
    const double inverse_BDE_inertia = p->inverse_BDE_inertia;
    const double inverse_EG_inertia = p->inverse_EG_inertia;
    const double inverse_AG_inertia = p->inverse_AG_inertia;
    const double inverse_HE_inertia = p->inverse_HE_inertia;
    const double inverse_AH_inertia = p->inverse_AH_inertia;
    const double inverse_FE_inertia = p->inverse_FE_inertia;

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

    /* Phi and Phi_dot */
    const double phi_O_x_2 = -OF_x - arm_OF_O_x;
    const double phi_dot_O_x_2 = OF_omega*arm_OF_O_y - OF_vx;
    const double phi_O_y_2 = -OF_y - arm_OF_O_y;
    const double phi_dot_O_y_2 = -OF_omega*arm_OF_O_x - OF_vy;
    const double phi_B_x_2 = -BDE_x + B_x - arm_BDE_B_x;
    const double phi_dot_B_x_2 = BDE_omega*arm_BDE_B_y - BDE_vx;
    const double phi_B_y_2 = -BDE_y + B_y - arm_BDE_B_y;
    const double phi_dot_B_y_2 = -BDE_omega*arm_BDE_B_x - BDE_vy;
    const double phi_A5_x_2 = -AG_x + A_x - arm_AG_A_x;
    const double phi_dot_A5_x_2 = AG_omega*arm_AG_A_y - AG_vx;
    const double phi_A5_y_2 = -AG_y + A_y - arm_AG_A_y;
    const double phi_dot_A5_y_2 = -AG_omega*arm_AG_A_x - AG_vy;
    const double phi_A7_x_2 = -AH_x + A_x - arm_AH_A_x;
    const double phi_dot_A7_x_2 = AH_omega*arm_AH_A_y - AH_vx;
    const double phi_A7_y_2 = -AH_y + A_y - arm_AH_A_y;
    const double phi_dot_A7_y_2 = -AH_omega*arm_AH_A_x - AH_vy;
    const double phi_F_x_2 = -FE_x + OF_x - arm_FE_F_x + arm_OF_F_x;
    const double phi_dot_F_x_2 = FE_omega*arm_FE_F_y - FE_vx - OF_omega*arm_OF_F_y + OF_vx;
    const double phi_F_y_2 = -FE_y + OF_y - arm_FE_F_y + arm_OF_F_y;
    const double phi_dot_F_y_2 = -FE_omega*arm_FE_F_x - FE_vy + OF_omega*arm_OF_F_x + OF_vy;
    const double phi_E3_x_2 = -BDE_x + FE_x - arm_BDE_E_x + arm_FE_E_x;
    const double phi_dot_E3_x_2 = BDE_omega*arm_BDE_E_y - BDE_vx - FE_omega*arm_FE_E_y + FE_vx;
    const double phi_E3_y_2 = -BDE_y + FE_y - arm_BDE_E_y + arm_FE_E_y;
    const double phi_dot_E3_y_2 = -BDE_omega*arm_BDE_E_x - BDE_vy + FE_omega*arm_FE_E_x + FE_vy;
    const double phi_E4_x_2 = -EG_x + FE_x - arm_EG_E_x + arm_FE_E_x;
    const double phi_dot_E4_x_2 = EG_omega*arm_EG_E_y - EG_vx - FE_omega*arm_FE_E_y + FE_vx;
    const double phi_E4_y_2 = -EG_y + FE_y - arm_EG_E_y + arm_FE_E_y;
    const double phi_dot_E4_y_2 = -EG_omega*arm_EG_E_x - EG_vy + FE_omega*arm_FE_E_x + FE_vy;
    const double phi_E6_x_2 = FE_x - HE_x + arm_FE_E_x - arm_HE_E_x;
    const double phi_dot_E6_x_2 = -FE_omega*arm_FE_E_y + FE_vx + HE_omega*arm_HE_E_y - HE_vx;
    const double phi_E6_y_2 = FE_y - HE_y + arm_FE_E_y - arm_HE_E_y;
    const double phi_dot_E6_y_2 = FE_omega*arm_FE_E_x + FE_vy - HE_omega*arm_HE_E_x - HE_vy;
    const double phi_G_x_2 = -AG_x + EG_x - arm_AG_G_x + arm_EG_G_x;
    const double phi_dot_G_x_2 = AG_omega*arm_AG_G_y - AG_vx - EG_omega*arm_EG_G_y + EG_vx;
    const double phi_G_y_2 = -AG_y + EG_y - arm_AG_G_y + arm_EG_G_y;
    const double phi_dot_G_y_2 = -AG_omega*arm_AG_G_x - AG_vy + EG_omega*arm_EG_G_x + EG_vy;
    const double phi_H_x_2 = -AH_x + HE_x - arm_AH_H_x + arm_HE_H_x;
    const double phi_dot_H_x_2 = AH_omega*arm_AH_H_y - AH_vx - HE_omega*arm_HE_H_y + HE_vx;
    const double phi_H_y_2 = -AH_y + HE_y - arm_AH_H_y + arm_HE_H_y;
    const double phi_dot_H_y_2 = -AH_omega*arm_AH_H_x - AH_vy + HE_omega*arm_HE_H_x + HE_vy;

    /* L D L^T of the KKT matrix */
    const double l_O_x__OF_theta_3 = arm_OF_O_y*inverse_OF_inertia;
    const double l_O_y__OF_theta_3 = -arm_OF_O_x*inverse_OF_inertia;
    const double l_F_x__OF_theta_3 = -arm_OF_F_y*inverse_OF_inertia;
    const double l_F_y__OF_theta_3 = arm_OF_F_x*inverse_OF_inertia;
    const double scale_O_x_3 = arm_OF_O_y*l_O_x__OF_theta_3 + inverse_OF_mass;
    if (!(scale_O_x_3 > 1e-13 * scale_O_x_3)) return 1;
    const double inverse_pivot_O_x_3 = 1.0/scale_O_x_3;
    const double w_O_y__O_x_2 = -arm_OF_O_y*l_O_y__OF_theta_3;
    const double l_O_y__O_x_3 = -inverse_pivot_O_x_3*w_O_y__O_x_2;
    const double w_F_x__O_x_2 = -arm_OF_O_y*l_F_x__OF_theta_3 + inverse_OF_mass;
    const double l_F_x__O_x_3 = -inverse_pivot_O_x_3*w_F_x__O_x_2;
    const double w_F_y__O_x_2 = -arm_OF_O_y*l_F_y__OF_theta_3;
    const double l_F_y__O_x_3 = -inverse_pivot_O_x_3*w_F_y__O_x_2;
    const double scale_O_y_3 = -arm_OF_O_x*l_O_y__OF_theta_3 + inverse_OF_mass;
    const double pivot_O_y_3 = l_O_y__O_x_3*w_O_y__O_x_2 + scale_O_y_3;
    if (!(pivot_O_y_3 > 1e-13 * scale_O_y_3)) return 2;
    const double inverse_pivot_O_y_3 = 1.0/pivot_O_y_3;
    const double w_F_x__O_y_2 = arm_OF_O_x*l_F_x__OF_theta_3 - l_F_x__O_x_3*w_O_y__O_x_2;
    const double l_F_x__O_y_3 = -inverse_pivot_O_y_3*w_F_x__O_y_2;
    const double w_F_y__O_y_2 = arm_OF_O_x*l_F_y__OF_theta_3 + inverse_OF_mass - l_F_y__O_x_3*w_O_y__O_x_2;
    const double l_F_y__O_y_3 = -inverse_pivot_O_y_3*w_F_y__O_y_2;
    const double l_B_x__BDE_theta_3 = arm_BDE_B_y*inverse_BDE_inertia;
    const double l_B_y__BDE_theta_3 = -arm_BDE_B_x*inverse_BDE_inertia;
    const double l_E3_x__BDE_theta_3 = arm_BDE_E_y*inverse_BDE_inertia;
    const double l_E3_y__BDE_theta_3 = -arm_BDE_E_x*inverse_BDE_inertia;
    const double scale_B_x_3 = arm_BDE_B_y*l_B_x__BDE_theta_3 + inverse_BDE_mass;
    if (!(scale_B_x_3 > 1e-13 * scale_B_x_3)) return 3;
    const double inverse_pivot_B_x_3 = 1.0/scale_B_x_3;
    const double w_B_y__B_x_2 = -arm_BDE_B_y*l_B_y__BDE_theta_3;
    const double l_B_y__B_x_3 = -inverse_pivot_B_x_3*w_B_y__B_x_2;
    const double w_E3_x__B_x_2 = -arm_BDE_B_y*l_E3_x__BDE_theta_3 - inverse_BDE_mass;
    const double l_E3_x__B_x_3 = -inverse_pivot_B_x_3*w_E3_x__B_x_2;
    const double w_E3_y__B_x_2 = -arm_BDE_B_y*l_E3_y__BDE_theta_3;
    const double l_E3_y__B_x_3 = -inverse_pivot_B_x_3*w_E3_y__B_x_2;
    const double scale_B_y_3 = -arm_BDE_B_x*l_B_y__BDE_theta_3 + inverse_BDE_mass;
    const double pivot_B_y_3 = l_B_y__B_x_3*w_B_y__B_x_2 + scale_B_y_3;
    if (!(pivot_B_y_3 > 1e-13 * scale_B_y_3)) return 4;
    const double inverse_pivot_B_y_3 = 1.0/pivot_B_y_3;
    const double w_E3_x__B_y_2 = arm_BDE_B_x*l_E3_x__BDE_theta_3 - l_E3_x__B_x_3*w_B_y__B_x_2;
    const double l_E3_x__B_y_3 = -inverse_pivot_B_y_3*w_E3_x__B_y_2;
    const double w_E3_y__B_y_2 = arm_BDE_B_x*l_E3_y__BDE_theta_3 - inverse_BDE_mass -
        l_E3_y__B_x_3*w_B_y__B_x_2;
    const double l_E3_y__B_y_3 = -inverse_pivot_B_y_3*w_E3_y__B_y_2;
    const double l_G_x__EG_theta_3 = -arm_EG_G_y*inverse_EG_inertia;
    const double l_G_y__EG_theta_3 = arm_EG_G_x*inverse_EG_inertia;
    const double l_E4_x__EG_theta_3 = arm_EG_E_y*inverse_EG_inertia;
    const double l_E4_y__EG_theta_3 = -arm_EG_E_x*inverse_EG_inertia;
    const double l_A5_x__AG_theta_3 = arm_AG_A_y*inverse_AG_inertia;
    const double l_A5_y__AG_theta_3 = -arm_AG_A_x*inverse_AG_inertia;
    const double l_G_x__AG_theta_3 = arm_AG_G_y*inverse_AG_inertia;
    const double l_G_y__AG_theta_3 = -arm_AG_G_x*inverse_AG_inertia;
    const double scale_A5_x_3 = arm_AG_A_y*l_A5_x__AG_theta_3 + inverse_AG_mass;
    if (!(scale_A5_x_3 > 1e-13 * scale_A5_x_3)) return 5;
    const double inverse_pivot_A5_x_3 = 1.0/scale_A5_x_3;
    const double w_A5_y__A5_x_2 = -arm_AG_A_y*l_A5_y__AG_theta_3;
    const double l_A5_y__A5_x_3 = -inverse_pivot_A5_x_3*w_A5_y__A5_x_2;
    const double w_G_x__A5_x_2 = -arm_AG_A_y*l_G_x__AG_theta_3 - inverse_AG_mass;
    const double l_G_x__A5_x_3 = -inverse_pivot_A5_x_3*w_G_x__A5_x_2;
    const double w_G_y__A5_x_2 = -arm_AG_A_y*l_G_y__AG_theta_3;
    const double l_G_y__A5_x_3 = -inverse_pivot_A5_x_3*w_G_y__A5_x_2;
    const double scale_A5_y_3 = -arm_AG_A_x*l_A5_y__AG_theta_3 + inverse_AG_mass;
    const double pivot_A5_y_3 = l_A5_y__A5_x_3*w_A5_y__A5_x_2 + scale_A5_y_3;
    if (!(pivot_A5_y_3 > 1e-13 * scale_A5_y_3)) return 6;
    const double inverse_pivot_A5_y_3 = 1.0/pivot_A5_y_3;
    const double w_G_x__A5_y_2 = arm_AG_A_x*l_G_x__AG_theta_3 - l_G_x__A5_x_3*w_A5_y__A5_x_2;
    const double l_G_x__A5_y_3 = -inverse_pivot_A5_y_3*w_G_x__A5_y_2;
    const double w_G_y__A5_y_2 = arm_AG_A_x*l_G_y__AG_theta_3 - inverse_AG_mass -
        l_G_y__A5_x_3*w_A5_y__A5_x_2;
    const double l_G_y__A5_y_3 = -inverse_pivot_A5_y_3*w_G_y__A5_y_2;
    const double scale_G_x_3 = arm_AG_G_y*l_G_x__AG_theta_3 - arm_EG_G_y*l_G_x__EG_theta_3 + inverse_AG_mass +
        inverse_EG_mass;
    const double pivot_G_x_3 = l_G_x__A5_x_3*w_G_x__A5_x_2 + l_G_x__A5_y_3*w_G_x__A5_y_2 + scale_G_x_3;
    if (!(pivot_G_x_3 > 1e-13 * scale_G_x_3)) return 7;
    const double inverse_pivot_G_x_3 = 1.0/pivot_G_x_3;
    const double w_G_y__G_x_2 = -arm_AG_G_y*l_G_y__AG_theta_3 + arm_EG_G_y*l_G_y__EG_theta_3 -
        l_G_y__A5_x_3*w_G_x__A5_x_2 - l_G_y__A5_y_3*w_G_x__A5_y_2;
    const double l_G_y__G_x_3 = -inverse_pivot_G_x_3*w_G_y__G_x_2;
    const double w_E4_x__G_x_2 = arm_EG_G_y*l_E4_x__EG_theta_3 + inverse_EG_mass;
    const double l_E4_x__G_x_3 = -inverse_pivot_G_x_3*w_E4_x__G_x_2;
    const double w_E4_y__G_x_2 = arm_EG_G_y*l_E4_y__EG_theta_3;
    const double l_E4_y__G_x_3 = -inverse_pivot_G_x_3*w_E4_y__G_x_2;
    const double scale_G_y_3 = -arm_AG_G_x*l_G_y__AG_theta_3 + arm_EG_G_x*l_G_y__EG_theta_3 + inverse_AG_mass
        + inverse_EG_mass;
    const double pivot_G_y_3 = l_G_y__A5_x_3*w_G_y__A5_x_2 + l_G_y__A5_y_3*w_G_y__A5_y_2 +
        l_G_y__G_x_3*w_G_y__G_x_2 + scale_G_y_3;
    if (!(pivot_G_y_3 > 1e-13 * scale_G_y_3)) return 8;
    const double inverse_pivot_G_y_3 = 1.0/pivot_G_y_3;
    const double w_E4_x__G_y_2 = -arm_EG_G_x*l_E4_x__EG_theta_3 - l_E4_x__G_x_3*w_G_y__G_x_2;
    const double l_E4_x__G_y_3 = -inverse_pivot_G_y_3*w_E4_x__G_y_2;
    const double w_E4_y__G_y_2 = -arm_EG_G_x*l_E4_y__EG_theta_3 + inverse_EG_mass -
        l_E4_y__G_x_3*w_G_y__G_x_2;
    const double l_E4_y__G_y_3 = -inverse_pivot_G_y_3*w_E4_y__G_y_2;
    const double l_H_x__HE_theta_3 = -arm_HE_H_y*inverse_HE_inertia;
    const double l_H_y__HE_theta_3 = arm_HE_H_x*inverse_HE_inertia;
    const double l_E6_x__HE_theta_3 = arm_HE_E_y*inverse_HE_inertia;
    const double l_E6_y__HE_theta_3 = -arm_HE_E_x*inverse_HE_inertia;
    const double l_A7_x__AH_theta_3 = arm_AH_A_y*inverse_AH_inertia;
    const double l_A7_y__AH_theta_3 = -arm_AH_A_x*inverse_AH_inertia;
    const double l_H_x__AH_theta_3 = arm_AH_H_y*inverse_AH_inertia;
    const double l_H_y__AH_theta_3 = -arm_AH_H_x*inverse_AH_inertia;
    const double scale_A7_x_3 = arm_AH_A_y*l_A7_x__AH_theta_3 + inverse_AH_mass;
    if (!(scale_A7_x_3 > 1e-13 * scale_A7_x_3)) return 9;
    const double inverse_pivot_A7_x_3 = 1.0/scale_A7_x_3;
    const double w_A7_y__A7_x_2 = -arm_AH_A_y*l_A7_y__AH_theta_3;
    const double l_A7_y__A7_x_3 = -inverse_pivot_A7_x_3*w_A7_y__A7_x_2;
    const double w_H_x__A7_x_2 = -arm_AH_A_y*l_H_x__AH_theta_3 - inverse_AH_mass;
    const double l_H_x__A7_x_3 = -inverse_pivot_A7_x_3*w_H_x__A7_x_2;
    const double w_H_y__A7_x_2 = -arm_AH_A_y*l_H_y__AH_theta_3;
    const double l_H_y__A7_x_3 = -inverse_pivot_A7_x_3*w_H_y__A7_x_2;
    const double scale_A7_y_3 = -arm_AH_A_x*l_A7_y__AH_theta_3 + inverse_AH_mass;
    const double pivot_A7_y_3 = l_A7_y__A7_x_3*w_A7_y__A7_x_2 + scale_A7_y_3;
    if (!(pivot_A7_y_3 > 1e-13 * scale_A7_y_3)) return 10;
    const double inverse_pivot_A7_y_3 = 1.0/pivot_A7_y_3;
    const double w_H_x__A7_y_2 = arm_AH_A_x*l_H_x__AH_theta_3 - l_H_x__A7_x_3*w_A7_y__A7_x_2;
    const double l_H_x__A7_y_3 = -inverse_pivot_A7_y_3*w_H_x__A7_y_2;
    const double w_H_y__A7_y_2 = arm_AH_A_x*l_H_y__AH_theta_3 - inverse_AH_mass -
        l_H_y__A7_x_3*w_A7_y__A7_x_2;
    const double l_H_y__A7_y_3 = -inverse_pivot_A7_y_3*w_H_y__A7_y_2;
    const double scale_H_x_3 = arm_AH_H_y*l_H_x__AH_theta_3 - arm_HE_H_y*l_H_x__HE_theta_3 + inverse_AH_mass +
        inverse_HE_mass;
    const double pivot_H_x_3 = l_H_x__A7_x_3*w_H_x__A7_x_2 + l_H_x__A7_y_3*w_H_x__A7_y_2 + scale_H_x_3;
    if (!(pivot_H_x_3 > 1e-13 * scale_H_x_3)) return 11;
    const double inverse_pivot_H_x_3 = 1.0/pivot_H_x_3;
    const double w_H_y__H_x_2 = -arm_AH_H_y*l_H_y__AH_theta_3 + arm_HE_H_y*l_H_y__HE_theta_3 -
        l_H_y__A7_x_3*w_H_x__A7_x_2 - l_H_y__A7_y_3*w_H_x__A7_y_2;
    const double l_H_y__H_x_3 = -inverse_pivot_H_x_3*w_H_y__H_x_2;
    const double w_E6_x__H_x_2 = arm_HE_H_y*l_E6_x__HE_theta_3 + inverse_HE_mass;
    const double l_E6_x__H_x_3 = -inverse_pivot_H_x_3*w_E6_x__H_x_2;
    const double w_E6_y__H_x_2 = arm_HE_H_y*l_E6_y__HE_theta_3;
    const double l_E6_y__H_x_3 = -inverse_pivot_H_x_3*w_E6_y__H_x_2;
    const double scale_H_y_3 = -arm_AH_H_x*l_H_y__AH_theta_3 + arm_HE_H_x*l_H_y__HE_theta_3 + inverse_AH_mass
        + inverse_HE_mass;
    const double pivot_H_y_3 = l_H_y__A7_x_3*w_H_y__A7_x_2 + l_H_y__A7_y_3*w_H_y__A7_y_2 +
        l_H_y__H_x_3*w_H_y__H_x_2 + scale_H_y_3;
    if (!(pivot_H_y_3 > 1e-13 * scale_H_y_3)) return 12;
    const double inverse_pivot_H_y_3 = 1.0/pivot_H_y_3;
    const double w_E6_x__H_y_2 = -arm_HE_H_x*l_E6_x__HE_theta_3 - l_E6_x__H_x_3*w_H_y__H_x_2;
    const double l_E6_x__H_y_3 = -inverse_pivot_H_y_3*w_E6_x__H_y_2;
    const double w_E6_y__H_y_2 = -arm_HE_H_x*l_E6_y__HE_theta_3 + inverse_HE_mass -
        l_E6_y__H_x_3*w_H_y__H_x_2;
    const double l_E6_y__H_y_3 = -inverse_pivot_H_y_3*w_E6_y__H_y_2;
    const double l_F_x__FE_theta_3 = arm_FE_F_y*inverse_FE_inertia;
    const double l_F_y__FE_theta_3 = -arm_FE_F_x*inverse_FE_inertia;
    const double l_E3_x__FE_theta_3 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E3_y__FE_theta_3 = arm_FE_E_x*inverse_FE_inertia;
    const double l_E4_x__FE_theta_3 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E4_y__FE_theta_3 = arm_FE_E_x*inverse_FE_inertia;
    const double l_E6_x__FE_theta_3 = -arm_FE_E_y*inverse_FE_inertia;
    const double l_E6_y__FE_theta_3 = arm_FE_E_x*inverse_FE_inertia;
    const double scale_F_x_3 = arm_FE_F_y*l_F_x__FE_theta_3 - arm_OF_F_y*l_F_x__OF_theta_3 + inverse_FE_mass +
        inverse_OF_mass;
    const double pivot_F_x_3 = l_F_x__O_x_3*w_F_x__O_x_2 + l_F_x__O_y_3*w_F_x__O_y_2 + scale_F_x_3;
    if (!(pivot_F_x_3 > 1e-13 * scale_F_x_3)) return 13;
    const double inverse_pivot_F_x_3 = 1.0/pivot_F_x_3;
    const double w_F_y__F_x_2 = -arm_FE_F_y*l_F_y__FE_theta_3 + arm_OF_F_y*l_F_y__OF_theta_3 -
        l_F_y__O_x_3*w_F_x__O_x_2 - l_F_y__O_y_3*w_F_x__O_y_2;
    const double l_F_y__F_x_3 = -inverse_pivot_F_x_3*w_F_y__F_x_2;
    const double w_E3_x__F_x_2 = -arm_FE_F_y*l_E3_x__FE_theta_3 + inverse_FE_mass;
    const double l_E3_x__F_x_3 = -inverse_pivot_F_x_3*w_E3_x__F_x_2;
    const double w_E3_y__F_x_2 = -arm_FE_F_y*l_E3_y__FE_theta_3;
    const double l_E3_y__F_x_3 = -inverse_pivot_F_x_3*w_E3_y__F_x_2;
    const double w_E4_x__F_x_2 = -arm_FE_F_y*l_E4_x__FE_theta_3 + inverse_FE_mass;
    const double l_E4_x__F_x_3 = -inverse_pivot_F_x_3*w_E4_x__F_x_2;
    const double w_E4_y__F_x_2 = -arm_FE_F_y*l_E4_y__FE_theta_3;
    const double l_E4_y__F_x_3 = -inverse_pivot_F_x_3*w_E4_y__F_x_2;
    const double w_E6_x__F_x_2 = -arm_FE_F_y*l_E6_x__FE_theta_3 + inverse_FE_mass;
    const double l_E6_x__F_x_3 = -inverse_pivot_F_x_3*w_E6_x__F_x_2;
    const double w_E6_y__F_x_2 = -arm_FE_F_y*l_E6_y__FE_theta_3;
    const double l_E6_y__F_x_3 = -inverse_pivot_F_x_3*w_E6_y__F_x_2;
    const double scale_F_y_3 = -arm_FE_F_x*l_F_y__FE_theta_3 + arm_OF_F_x*l_F_y__OF_theta_3 + inverse_FE_mass
        + inverse_OF_mass;
    const double pivot_F_y_3 = l_F_y__F_x_3*w_F_y__F_x_2 + l_F_y__O_x_3*w_F_y__O_x_2 +
        l_F_y__O_y_3*w_F_y__O_y_2 + scale_F_y_3;
    if (!(pivot_F_y_3 > 1e-13 * scale_F_y_3)) return 14;
    const double inverse_pivot_F_y_3 = 1.0/pivot_F_y_3;
    const double w_E3_x__F_y_2 = arm_FE_F_x*l_E3_x__FE_theta_3 - l_E3_x__F_x_3*w_F_y__F_x_2;
    const double l_E3_x__F_y_3 = -inverse_pivot_F_y_3*w_E3_x__F_y_2;
    const double w_E3_y__F_y_2 = arm_FE_F_x*l_E3_y__FE_theta_3 + inverse_FE_mass - l_E3_y__F_x_3*w_F_y__F_x_2;
    const double l_E3_y__F_y_3 = -inverse_pivot_F_y_3*w_E3_y__F_y_2;
    const double w_E4_x__F_y_2 = arm_FE_F_x*l_E4_x__FE_theta_3 - l_E4_x__F_x_3*w_F_y__F_x_2;
    const double l_E4_x__F_y_3 = -inverse_pivot_F_y_3*w_E4_x__F_y_2;
    const double w_E4_y__F_y_2 = arm_FE_F_x*l_E4_y__FE_theta_3 + inverse_FE_mass - l_E4_y__F_x_3*w_F_y__F_x_2;
    const double l_E4_y__F_y_3 = -inverse_pivot_F_y_3*w_E4_y__F_y_2;
    const double w_E6_x__F_y_2 = arm_FE_F_x*l_E6_x__FE_theta_3 - l_E6_x__F_x_3*w_F_y__F_x_2;
    const double l_E6_x__F_y_3 = -inverse_pivot_F_y_3*w_E6_x__F_y_2;
    const double w_E6_y__F_y_2 = arm_FE_F_x*l_E6_y__FE_theta_3 + inverse_FE_mass - l_E6_y__F_x_3*w_F_y__F_x_2;
    const double l_E6_y__F_y_3 = -inverse_pivot_F_y_3*w_E6_y__F_y_2;
    const double scale_E3_x_3 = arm_BDE_E_y*l_E3_x__BDE_theta_3 - arm_FE_E_y*l_E3_x__FE_theta_3 +
        inverse_BDE_mass + inverse_FE_mass;
    const double pivot_E3_x_3 = l_E3_x__B_x_3*w_E3_x__B_x_2 + l_E3_x__B_y_3*w_E3_x__B_y_2 +
        l_E3_x__F_x_3*w_E3_x__F_x_2 + l_E3_x__F_y_3*w_E3_x__F_y_2 + scale_E3_x_3;
    if (!(pivot_E3_x_3 > 1e-13 * scale_E3_x_3)) return 15;
    const double inverse_pivot_E3_x_3 = 1.0/pivot_E3_x_3;
    const double w_E3_y__E3_x_2 = -arm_BDE_E_y*l_E3_y__BDE_theta_3 + arm_FE_E_y*l_E3_y__FE_theta_3 -
        l_E3_y__B_x_3*w_E3_x__B_x_2 - l_E3_y__B_y_3*w_E3_x__B_y_2 - l_E3_y__F_x_3*w_E3_x__F_x_2 -
        l_E3_y__F_y_3*w_E3_x__F_y_2;
    const double l_E3_y__E3_x_3 = -inverse_pivot_E3_x_3*w_E3_y__E3_x_2;
    const double w_E4_x__E3_x_2 = arm_FE_E_y*l_E4_x__FE_theta_3 - inverse_FE_mass -
        l_E4_x__F_x_3*w_E3_x__F_x_2 - l_E4_x__F_y_3*w_E3_x__F_y_2;
    const double l_E4_x__E3_x_3 = -inverse_pivot_E3_x_3*w_E4_x__E3_x_2;
    const double w_E4_y__E3_x_2 = arm_FE_E_y*l_E4_y__FE_theta_3 - l_E4_y__F_x_3*w_E3_x__F_x_2 -
        l_E4_y__F_y_3*w_E3_x__F_y_2;
    const double l_E4_y__E3_x_3 = -inverse_pivot_E3_x_3*w_E4_y__E3_x_2;
    const double w_E6_x__E3_x_2 = arm_FE_E_y*l_E6_x__FE_theta_3 - inverse_FE_mass -
        l_E6_x__F_x_3*w_E3_x__F_x_2 - l_E6_x__F_y_3*w_E3_x__F_y_2;
    const double l_E6_x__E3_x_3 = -inverse_pivot_E3_x_3*w_E6_x__E3_x_2;
    const double w_E6_y__E3_x_2 = arm_FE_E_y*l_E6_y__FE_theta_3 - l_E6_y__F_x_3*w_E3_x__F_x_2 -
        l_E6_y__F_y_3*w_E3_x__F_y_2;
    const double l_E6_y__E3_x_3 = -inverse_pivot_E3_x_3*w_E6_y__E3_x_2;
    const double scale_E3_y_3 = -arm_BDE_E_x*l_E3_y__BDE_theta_3 + arm_FE_E_x*l_E3_y__FE_theta_3 +
        inverse_BDE_mass + inverse_FE_mass;
    const double pivot_E3_y_3 = l_E3_y__B_x_3*w_E3_y__B_x_2 + l_E3_y__B_y_3*w_E3_y__B_y_2 +
        l_E3_y__E3_x_3*w_E3_y__E3_x_2 + l_E3_y__F_x_3*w_E3_y__F_x_2 + l_E3_y__F_y_3*w_E3_y__F_y_2 +
        scale_E3_y_3;
    if (!(pivot_E3_y_3 > 1e-13 * scale_E3_y_3)) return 16;
    const double inverse_pivot_E3_y_3 = 1.0/pivot_E3_y_3;
    const double w_E4_x__E3_y_2 = -arm_FE_E_x*l_E4_x__FE_theta_3 - l_E4_x__E3_x_3*w_E3_y__E3_x_2 -
        l_E4_x__F_x_3*w_E3_y__F_x_2 - l_E4_x__F_y_3*w_E3_y__F_y_2;
    const double l_E4_x__E3_y_3 = -inverse_pivot_E3_y_3*w_E4_x__E3_y_2;
    const double w_E4_y__E3_y_2 = -arm_FE_E_x*l_E4_y__FE_theta_3 - inverse_FE_mass -
        l_E4_y__E3_x_3*w_E3_y__E3_x_2 - l_E4_y__F_x_3*w_E3_y__F_x_2 - l_E4_y__F_y_3*w_E3_y__F_y_2;
    const double l_E4_y__E3_y_3 = -inverse_pivot_E3_y_3*w_E4_y__E3_y_2;
    const double w_E6_x__E3_y_2 = -arm_FE_E_x*l_E6_x__FE_theta_3 - l_E6_x__E3_x_3*w_E3_y__E3_x_2 -
        l_E6_x__F_x_3*w_E3_y__F_x_2 - l_E6_x__F_y_3*w_E3_y__F_y_2;
    const double l_E6_x__E3_y_3 = -inverse_pivot_E3_y_3*w_E6_x__E3_y_2;
    const double w_E6_y__E3_y_2 = -arm_FE_E_x*l_E6_y__FE_theta_3 - inverse_FE_mass -
        l_E6_y__E3_x_3*w_E3_y__E3_x_2 - l_E6_y__F_x_3*w_E3_y__F_x_2 - l_E6_y__F_y_3*w_E3_y__F_y_2;
    const double l_E6_y__E3_y_3 = -inverse_pivot_E3_y_3*w_E6_y__E3_y_2;
    const double scale_E4_x_3 = arm_EG_E_y*l_E4_x__EG_theta_3 - arm_FE_E_y*l_E4_x__FE_theta_3 +
        inverse_EG_mass + inverse_FE_mass;
    const double pivot_E4_x_3 = l_E4_x__E3_x_3*w_E4_x__E3_x_2 + l_E4_x__E3_y_3*w_E4_x__E3_y_2 +
        l_E4_x__F_x_3*w_E4_x__F_x_2 + l_E4_x__F_y_3*w_E4_x__F_y_2 + l_E4_x__G_x_3*w_E4_x__G_x_2 +
        l_E4_x__G_y_3*w_E4_x__G_y_2 + scale_E4_x_3;
    if (!(pivot_E4_x_3 > 1e-13 * scale_E4_x_3)) return 17;
    const double inverse_pivot_E4_x_3 = 1.0/pivot_E4_x_3;
    const double w_E4_y__E4_x_2 = -arm_EG_E_y*l_E4_y__EG_theta_3 + arm_FE_E_y*l_E4_y__FE_theta_3 -
        l_E4_y__E3_x_3*w_E4_x__E3_x_2 - l_E4_y__E3_y_3*w_E4_x__E3_y_2 - l_E4_y__F_x_3*w_E4_x__F_x_2 -
        l_E4_y__F_y_3*w_E4_x__F_y_2 - l_E4_y__G_x_3*w_E4_x__G_x_2 - l_E4_y__G_y_3*w_E4_x__G_y_2;
    const double l_E4_y__E4_x_3 = -inverse_pivot_E4_x_3*w_E4_y__E4_x_2;
    const double w_E6_x__E4_x_2 = arm_FE_E_y*l_E6_x__FE_theta_3 - inverse_FE_mass -
        l_E6_x__E3_x_3*w_E4_x__E3_x_2 - l_E6_x__E3_y_3*w_E4_x__E3_y_2 - l_E6_x__F_x_3*w_E4_x__F_x_2 -
        l_E6_x__F_y_3*w_E4_x__F_y_2;
    const double l_E6_x__E4_x_3 = -inverse_pivot_E4_x_3*w_E6_x__E4_x_2;
    const double w_E6_y__E4_x_2 = arm_FE_E_y*l_E6_y__FE_theta_3 - l_E6_y__E3_x_3*w_E4_x__E3_x_2 -
        l_E6_y__E3_y_3*w_E4_x__E3_y_2 - l_E6_y__F_x_3*w_E4_x__F_x_2 - l_E6_y__F_y_3*w_E4_x__F_y_2;
    const double l_E6_y__E4_x_3 = -inverse_pivot_E4_x_3*w_E6_y__E4_x_2;
    const double scale_E4_y_3 = -arm_EG_E_x*l_E4_y__EG_theta_3 + arm_FE_E_x*l_E4_y__FE_theta_3 +
        inverse_EG_mass + inverse_FE_mass;
    const double pivot_E4_y_3 = l_E4_y__E3_x_3*w_E4_y__E3_x_2 + l_E4_y__E3_y_3*w_E4_y__E3_y_2 +
        l_E4_y__E4_x_3*w_E4_y__E4_x_2 + l_E4_y__F_x_3*w_E4_y__F_x_2 + l_E4_y__F_y_3*w_E4_y__F_y_2 +
        l_E4_y__G_x_3*w_E4_y__G_x_2 + l_E4_y__G_y_3*w_E4_y__G_y_2 + scale_E4_y_3;
    if (!(pivot_E4_y_3 > 1e-13 * scale_E4_y_3)) return 18;
    const double inverse_pivot_E4_y_3 = 1.0/pivot_E4_y_3;
    const double w_E6_x__E4_y_2 = -arm_FE_E_x*l_E6_x__FE_theta_3 - l_E6_x__E3_x_3*w_E4_y__E3_x_2 -
        l_E6_x__E3_y_3*w_E4_y__E3_y_2 - l_E6_x__E4_x_3*w_E4_y__E4_x_2 - l_E6_x__F_x_3*w_E4_y__F_x_2 -
        l_E6_x__F_y_3*w_E4_y__F_y_2;
    const double l_E6_x__E4_y_3 = -inverse_pivot_E4_y_3*w_E6_x__E4_y_2;
    const double w_E6_y__E4_y_2 = -arm_FE_E_x*l_E6_y__FE_theta_3 - inverse_FE_mass -
        l_E6_y__E3_x_3*w_E4_y__E3_x_2 - l_E6_y__E3_y_3*w_E4_y__E3_y_2 - l_E6_y__E4_x_3*w_E4_y__E4_x_2 -
        l_E6_y__F_x_3*w_E4_y__F_x_2 - l_E6_y__F_y_3*w_E4_y__F_y_2;
    const double l_E6_y__E4_y_3 = -inverse_pivot_E4_y_3*w_E6_y__E4_y_2;
    const double scale_E6_x_3 = -arm_FE_E_y*l_E6_x__FE_theta_3 + arm_HE_E_y*l_E6_x__HE_theta_3 +
        inverse_FE_mass + inverse_HE_mass;
    const double pivot_E6_x_3 = l_E6_x__E3_x_3*w_E6_x__E3_x_2 + l_E6_x__E3_y_3*w_E6_x__E3_y_2 +
        l_E6_x__E4_x_3*w_E6_x__E4_x_2 + l_E6_x__E4_y_3*w_E6_x__E4_y_2 + l_E6_x__F_x_3*w_E6_x__F_x_2 +
        l_E6_x__F_y_3*w_E6_x__F_y_2 + l_E6_x__H_x_3*w_E6_x__H_x_2 + l_E6_x__H_y_3*w_E6_x__H_y_2 +
        scale_E6_x_3;
    if (!(pivot_E6_x_3 > 1e-13 * scale_E6_x_3)) return 19;
    const double inverse_pivot_E6_x_3 = 1.0/pivot_E6_x_3;
    const double w_E6_y__E6_x_2 = arm_FE_E_y*l_E6_y__FE_theta_3 - arm_HE_E_y*l_E6_y__HE_theta_3 -
        l_E6_y__E3_x_3*w_E6_x__E3_x_2 - l_E6_y__E3_y_3*w_E6_x__E3_y_2 - l_E6_y__E4_x_3*w_E6_x__E4_x_2 -
        l_E6_y__E4_y_3*w_E6_x__E4_y_2 - l_E6_y__F_x_3*w_E6_x__F_x_2 - l_E6_y__F_y_3*w_E6_x__F_y_2 -
        l_E6_y__H_x_3*w_E6_x__H_x_2 - l_E6_y__H_y_3*w_E6_x__H_y_2;
    const double l_E6_y__E6_x_3 = -inverse_pivot_E6_x_3*w_E6_y__E6_x_2;
    const double scale_E6_y_3 = arm_FE_E_x*l_E6_y__FE_theta_3 - arm_HE_E_x*l_E6_y__HE_theta_3 +
        inverse_FE_mass + inverse_HE_mass;
    const double pivot_E6_y_3 = l_E6_y__E3_x_3*w_E6_y__E3_x_2 + l_E6_y__E3_y_3*w_E6_y__E3_y_2 +
        l_E6_y__E4_x_3*w_E6_y__E4_x_2 + l_E6_y__E4_y_3*w_E6_y__E4_y_2 + l_E6_y__E6_x_3*w_E6_y__E6_x_2 +
        l_E6_y__F_x_3*w_E6_y__F_x_2 + l_E6_y__F_y_3*w_E6_y__F_y_2 + l_E6_y__H_x_3*w_E6_y__H_x_2 +
        l_E6_y__H_y_3*w_E6_y__H_y_2 + scale_E6_y_3;
    if (!(pivot_E6_y_3 > 1e-13 * scale_E6_y_3)) return 20;
    const double inverse_pivot_E6_y_3 = 1.0/pivot_E6_y_3;

    /* forward substitution */
    const double dq_z_O_y = -l_O_y__O_x_3*phi_O_x_2 + phi_O_y_2;
    const double dq_z_B_y = -l_B_y__B_x_3*phi_B_x_2 + phi_B_y_2;
    const double dq_z_A5_y = -l_A5_y__A5_x_3*phi_A5_x_2 + phi_A5_y_2;
    const double dq_z_G_x = -dq_z_A5_y*l_G_x__A5_y_3 - l_G_x__A5_x_3*phi_A5_x_2 + phi_G_x_2;
    const double dq_z_G_y = -dq_z_A5_y*l_G_y__A5_y_3 - dq_z_G_x*l_G_y__G_x_3 - l_G_y__A5_x_3*phi_A5_x_2 +
        phi_G_y_2;
    const double dq_z_A7_y = -l_A7_y__A7_x_3*phi_A7_x_2 + phi_A7_y_2;
    const double dq_z_H_x = -dq_z_A7_y*l_H_x__A7_y_3 - l_H_x__A7_x_3*phi_A7_x_2 + phi_H_x_2;
    const double dq_z_H_y = -dq_z_A7_y*l_H_y__A7_y_3 - dq_z_H_x*l_H_y__H_x_3 - l_H_y__A7_x_3*phi_A7_x_2 +
        phi_H_y_2;
    const double dq_z_F_x = -dq_z_O_y*l_F_x__O_y_3 - l_F_x__O_x_3*phi_O_x_2 + phi_F_x_2;
    const double dq_z_F_y = -dq_z_F_x*l_F_y__F_x_3 - dq_z_O_y*l_F_y__O_y_3 - l_F_y__O_x_3*phi_O_x_2 +
        phi_F_y_2;
    const double dq_z_E3_x = -dq_z_B_y*l_E3_x__B_y_3 - dq_z_F_x*l_E3_x__F_x_3 - dq_z_F_y*l_E3_x__F_y_3 -
        l_E3_x__B_x_3*phi_B_x_2 + phi_E3_x_2;
    const double dq_z_E3_y = -dq_z_B_y*l_E3_y__B_y_3 - dq_z_E3_x*l_E3_y__E3_x_3 - dq_z_F_x*l_E3_y__F_x_3 -
        dq_z_F_y*l_E3_y__F_y_3 - l_E3_y__B_x_3*phi_B_x_2 + phi_E3_y_2;
    const double dq_z_E4_x = -dq_z_E3_x*l_E4_x__E3_x_3 - dq_z_E3_y*l_E4_x__E3_y_3 - dq_z_F_x*l_E4_x__F_x_3 -
        dq_z_F_y*l_E4_x__F_y_3 - dq_z_G_x*l_E4_x__G_x_3 - dq_z_G_y*l_E4_x__G_y_3 + phi_E4_x_2;
    const double dq_z_E4_y = -dq_z_E3_x*l_E4_y__E3_x_3 - dq_z_E3_y*l_E4_y__E3_y_3 - dq_z_E4_x*l_E4_y__E4_x_3 -
        dq_z_F_x*l_E4_y__F_x_3 - dq_z_F_y*l_E4_y__F_y_3 - dq_z_G_x*l_E4_y__G_x_3 - dq_z_G_y*l_E4_y__G_y_3 +
        phi_E4_y_2;
    const double dq_z_E6_x = -dq_z_E3_x*l_E6_x__E3_x_3 - dq_z_E3_y*l_E6_x__E3_y_3 - dq_z_E4_x*l_E6_x__E4_x_3 -
        dq_z_E4_y*l_E6_x__E4_y_3 - dq_z_F_x*l_E6_x__F_x_3 - dq_z_F_y*l_E6_x__F_y_3 - dq_z_H_x*l_E6_x__H_x_3 -
        dq_z_H_y*l_E6_x__H_y_3 + phi_E6_x_2;
    const double dq_z_E6_y = -dq_z_E3_x*l_E6_y__E3_x_3 - dq_z_E3_y*l_E6_y__E3_y_3 - dq_z_E4_x*l_E6_y__E4_x_3 -
        dq_z_E4_y*l_E6_y__E4_y_3 - dq_z_E6_x*l_E6_y__E6_x_3 - dq_z_F_x*l_E6_y__F_x_3 - dq_z_F_y*l_E6_y__F_y_3
        - dq_z_H_x*l_E6_y__H_x_3 - dq_z_H_y*l_E6_y__H_y_3 + phi_E6_y_2;

    /* backward substitution */
    const double dq_lambda_E6_y = -dq_z_E6_y*inverse_pivot_E6_y_3;
    const double dq_lambda_E6_x = -dq_lambda_E6_y*l_E6_y__E6_x_3 - dq_z_E6_x*inverse_pivot_E6_x_3;
    const double dq_lambda_E4_y = -dq_lambda_E6_x*l_E6_x__E4_y_3 - dq_lambda_E6_y*l_E6_y__E4_y_3 -
        dq_z_E4_y*inverse_pivot_E4_y_3;
    const double dq_lambda_E4_x = -dq_lambda_E4_y*l_E4_y__E4_x_3 - dq_lambda_E6_x*l_E6_x__E4_x_3 -
        dq_lambda_E6_y*l_E6_y__E4_x_3 - dq_z_E4_x*inverse_pivot_E4_x_3;
    const double dq_lambda_E3_y = -dq_lambda_E4_x*l_E4_x__E3_y_3 - dq_lambda_E4_y*l_E4_y__E3_y_3 -
        dq_lambda_E6_x*l_E6_x__E3_y_3 - dq_lambda_E6_y*l_E6_y__E3_y_3 - dq_z_E3_y*inverse_pivot_E3_y_3;
    const double dq_lambda_E3_x = -dq_lambda_E3_y*l_E3_y__E3_x_3 - dq_lambda_E4_x*l_E4_x__E3_x_3 -
        dq_lambda_E4_y*l_E4_y__E3_x_3 - dq_lambda_E6_x*l_E6_x__E3_x_3 - dq_lambda_E6_y*l_E6_y__E3_x_3 -
        dq_z_E3_x*inverse_pivot_E3_x_3;
    const double dq_lambda_F_y = -dq_lambda_E3_x*l_E3_x__F_y_3 - dq_lambda_E3_y*l_E3_y__F_y_3 -
        dq_lambda_E4_x*l_E4_x__F_y_3 - dq_lambda_E4_y*l_E4_y__F_y_3 - dq_lambda_E6_x*l_E6_x__F_y_3 -
        dq_lambda_E6_y*l_E6_y__F_y_3 - dq_z_F_y*inverse_pivot_F_y_3;
    const double dq_lambda_F_x = -dq_lambda_E3_x*l_E3_x__F_x_3 - dq_lambda_E3_y*l_E3_y__F_x_3 -
        dq_lambda_E4_x*l_E4_x__F_x_3 - dq_lambda_E4_y*l_E4_y__F_x_3 - dq_lambda_E6_x*l_E6_x__F_x_3 -
        dq_lambda_E6_y*l_E6_y__F_x_3 - dq_lambda_F_y*l_F_y__F_x_3 - dq_z_F_x*inverse_pivot_F_x_3;
    const double dq_acceleration_FE_theta = -dq_lambda_E3_x*l_E3_x__FE_theta_3 -
        dq_lambda_E3_y*l_E3_y__FE_theta_3 - dq_lambda_E4_x*l_E4_x__FE_theta_3 -
        dq_lambda_E4_y*l_E4_y__FE_theta_3 - dq_lambda_E6_x*l_E6_x__FE_theta_3 -
        dq_lambda_E6_y*l_E6_y__FE_theta_3 - dq_lambda_F_x*l_F_x__FE_theta_3 - dq_lambda_F_y*l_F_y__FE_theta_3;
    const double dq_lambda_H_y = -dq_lambda_E6_x*l_E6_x__H_y_3 - dq_lambda_E6_y*l_E6_y__H_y_3 -
        dq_z_H_y*inverse_pivot_H_y_3;
    const double dq_lambda_H_x = -dq_lambda_E6_x*l_E6_x__H_x_3 - dq_lambda_E6_y*l_E6_y__H_x_3 -
        dq_lambda_H_y*l_H_y__H_x_3 - dq_z_H_x*inverse_pivot_H_x_3;
    const double dq_lambda_A7_y = -dq_lambda_H_x*l_H_x__A7_y_3 - dq_lambda_H_y*l_H_y__A7_y_3 -
        dq_z_A7_y*inverse_pivot_A7_y_3;
    const double dq_lambda_A7_x = -dq_lambda_A7_y*l_A7_y__A7_x_3 - dq_lambda_H_x*l_H_x__A7_x_3 -
        dq_lambda_H_y*l_H_y__A7_x_3 - inverse_pivot_A7_x_3*phi_A7_x_2;
    const double dq_acceleration_AH_theta = -dq_lambda_A7_x*l_A7_x__AH_theta_3 -
        dq_lambda_A7_y*l_A7_y__AH_theta_3 - dq_lambda_H_x*l_H_x__AH_theta_3 - dq_lambda_H_y*l_H_y__AH_theta_3;
    const double dq_acceleration_HE_theta = -dq_lambda_E6_x*l_E6_x__HE_theta_3 -
        dq_lambda_E6_y*l_E6_y__HE_theta_3 - dq_lambda_H_x*l_H_x__HE_theta_3 - dq_lambda_H_y*l_H_y__HE_theta_3;
    const double dq_lambda_G_y = -dq_lambda_E4_x*l_E4_x__G_y_3 - dq_lambda_E4_y*l_E4_y__G_y_3 -
        dq_z_G_y*inverse_pivot_G_y_3;
    const double dq_lambda_G_x = -dq_lambda_E4_x*l_E4_x__G_x_3 - dq_lambda_E4_y*l_E4_y__G_x_3 -
        dq_lambda_G_y*l_G_y__G_x_3 - dq_z_G_x*inverse_pivot_G_x_3;
    const double dq_lambda_A5_y = -dq_lambda_G_x*l_G_x__A5_y_3 - dq_lambda_G_y*l_G_y__A5_y_3 -
        dq_z_A5_y*inverse_pivot_A5_y_3;
    const double dq_lambda_A5_x = -dq_lambda_A5_y*l_A5_y__A5_x_3 - dq_lambda_G_x*l_G_x__A5_x_3 -
        dq_lambda_G_y*l_G_y__A5_x_3 - inverse_pivot_A5_x_3*phi_A5_x_2;
    const double dq_acceleration_AG_theta = -dq_lambda_A5_x*l_A5_x__AG_theta_3 -
        dq_lambda_A5_y*l_A5_y__AG_theta_3 - dq_lambda_G_x*l_G_x__AG_theta_3 - dq_lambda_G_y*l_G_y__AG_theta_3;
    const double dq_acceleration_EG_theta = -dq_lambda_E4_x*l_E4_x__EG_theta_3 -
        dq_lambda_E4_y*l_E4_y__EG_theta_3 - dq_lambda_G_x*l_G_x__EG_theta_3 - dq_lambda_G_y*l_G_y__EG_theta_3;
    const double dq_lambda_B_y = -dq_lambda_E3_x*l_E3_x__B_y_3 - dq_lambda_E3_y*l_E3_y__B_y_3 -
        dq_z_B_y*inverse_pivot_B_y_3;
    const double dq_lambda_B_x = -dq_lambda_B_y*l_B_y__B_x_3 - dq_lambda_E3_x*l_E3_x__B_x_3 -
        dq_lambda_E3_y*l_E3_y__B_x_3 - inverse_pivot_B_x_3*phi_B_x_2;
    const double dq_acceleration_BDE_theta = -dq_lambda_B_x*l_B_x__BDE_theta_3 -
        dq_lambda_B_y*l_B_y__BDE_theta_3 - dq_lambda_E3_x*l_E3_x__BDE_theta_3 -
        dq_lambda_E3_y*l_E3_y__BDE_theta_3;
    const double dq_acceleration_FE_y = -dq_lambda_E3_y*inverse_FE_mass - dq_lambda_E4_y*inverse_FE_mass -
        dq_lambda_E6_y*inverse_FE_mass + dq_lambda_F_y*inverse_FE_mass;
    const double dq_acceleration_FE_x = -dq_lambda_E3_x*inverse_FE_mass - dq_lambda_E4_x*inverse_FE_mass -
        dq_lambda_E6_x*inverse_FE_mass + dq_lambda_F_x*inverse_FE_mass;
    const double dq_lambda_O_y = -dq_lambda_F_x*l_F_x__O_y_3 - dq_lambda_F_y*l_F_y__O_y_3 -
        dq_z_O_y*inverse_pivot_O_y_3;
    const double dq_lambda_O_x = -dq_lambda_F_x*l_F_x__O_x_3 - dq_lambda_F_y*l_F_y__O_x_3 -
        dq_lambda_O_y*l_O_y__O_x_3 - inverse_pivot_O_x_3*phi_O_x_2;
    const double dq_acceleration_OF_theta = -dq_lambda_F_x*l_F_x__OF_theta_3 - dq_lambda_F_y*l_F_y__OF_theta_3
        - dq_lambda_O_x*l_O_x__OF_theta_3 - dq_lambda_O_y*l_O_y__OF_theta_3;
    const double dq_acceleration_AH_y = dq_lambda_A7_y*inverse_AH_mass + dq_lambda_H_y*inverse_AH_mass;
    const double dq_acceleration_AH_x = dq_lambda_A7_x*inverse_AH_mass + dq_lambda_H_x*inverse_AH_mass;
    const double dq_acceleration_HE_y = dq_lambda_E6_y*inverse_HE_mass - dq_lambda_H_y*inverse_HE_mass;
    const double dq_acceleration_HE_x = dq_lambda_E6_x*inverse_HE_mass - dq_lambda_H_x*inverse_HE_mass;
    const double dq_acceleration_AG_y = dq_lambda_A5_y*inverse_AG_mass + dq_lambda_G_y*inverse_AG_mass;
    const double dq_acceleration_AG_x = dq_lambda_A5_x*inverse_AG_mass + dq_lambda_G_x*inverse_AG_mass;
    const double dq_acceleration_EG_y = dq_lambda_E4_y*inverse_EG_mass - dq_lambda_G_y*inverse_EG_mass;
    const double dq_acceleration_EG_x = dq_lambda_E4_x*inverse_EG_mass - dq_lambda_G_x*inverse_EG_mass;
    const double dq_acceleration_BDE_y = dq_lambda_B_y*inverse_BDE_mass + dq_lambda_E3_y*inverse_BDE_mass;
    const double dq_acceleration_BDE_x = dq_lambda_B_x*inverse_BDE_mass + dq_lambda_E3_x*inverse_BDE_mass;
    const double dq_acceleration_OF_y = -dq_lambda_F_y*inverse_OF_mass + dq_lambda_O_y*inverse_OF_mass;
    const double dq_acceleration_OF_x = -dq_lambda_F_x*inverse_OF_mass + dq_lambda_O_x*inverse_OF_mass;

    /* forward substitution */
    const double dv_z_O_y = -l_O_y__O_x_3*phi_dot_O_x_2 + phi_dot_O_y_2;
    const double dv_z_B_y = -l_B_y__B_x_3*phi_dot_B_x_2 + phi_dot_B_y_2;
    const double dv_z_A5_y = -l_A5_y__A5_x_3*phi_dot_A5_x_2 + phi_dot_A5_y_2;
    const double dv_z_G_x = -dv_z_A5_y*l_G_x__A5_y_3 - l_G_x__A5_x_3*phi_dot_A5_x_2 + phi_dot_G_x_2;
    const double dv_z_G_y = -dv_z_A5_y*l_G_y__A5_y_3 - dv_z_G_x*l_G_y__G_x_3 - l_G_y__A5_x_3*phi_dot_A5_x_2 +
        phi_dot_G_y_2;
    const double dv_z_A7_y = -l_A7_y__A7_x_3*phi_dot_A7_x_2 + phi_dot_A7_y_2;
    const double dv_z_H_x = -dv_z_A7_y*l_H_x__A7_y_3 - l_H_x__A7_x_3*phi_dot_A7_x_2 + phi_dot_H_x_2;
    const double dv_z_H_y = -dv_z_A7_y*l_H_y__A7_y_3 - dv_z_H_x*l_H_y__H_x_3 - l_H_y__A7_x_3*phi_dot_A7_x_2 +
        phi_dot_H_y_2;
    const double dv_z_F_x = -dv_z_O_y*l_F_x__O_y_3 - l_F_x__O_x_3*phi_dot_O_x_2 + phi_dot_F_x_2;
    const double dv_z_F_y = -dv_z_F_x*l_F_y__F_x_3 - dv_z_O_y*l_F_y__O_y_3 - l_F_y__O_x_3*phi_dot_O_x_2 +
        phi_dot_F_y_2;
    const double dv_z_E3_x = -dv_z_B_y*l_E3_x__B_y_3 - dv_z_F_x*l_E3_x__F_x_3 - dv_z_F_y*l_E3_x__F_y_3 -
        l_E3_x__B_x_3*phi_dot_B_x_2 + phi_dot_E3_x_2;
    const double dv_z_E3_y = -dv_z_B_y*l_E3_y__B_y_3 - dv_z_E3_x*l_E3_y__E3_x_3 - dv_z_F_x*l_E3_y__F_x_3 -
        dv_z_F_y*l_E3_y__F_y_3 - l_E3_y__B_x_3*phi_dot_B_x_2 + phi_dot_E3_y_2;
    const double dv_z_E4_x = -dv_z_E3_x*l_E4_x__E3_x_3 - dv_z_E3_y*l_E4_x__E3_y_3 - dv_z_F_x*l_E4_x__F_x_3 -
        dv_z_F_y*l_E4_x__F_y_3 - dv_z_G_x*l_E4_x__G_x_3 - dv_z_G_y*l_E4_x__G_y_3 + phi_dot_E4_x_2;
    const double dv_z_E4_y = -dv_z_E3_x*l_E4_y__E3_x_3 - dv_z_E3_y*l_E4_y__E3_y_3 - dv_z_E4_x*l_E4_y__E4_x_3 -
        dv_z_F_x*l_E4_y__F_x_3 - dv_z_F_y*l_E4_y__F_y_3 - dv_z_G_x*l_E4_y__G_x_3 - dv_z_G_y*l_E4_y__G_y_3 +
        phi_dot_E4_y_2;
    const double dv_z_E6_x = -dv_z_E3_x*l_E6_x__E3_x_3 - dv_z_E3_y*l_E6_x__E3_y_3 - dv_z_E4_x*l_E6_x__E4_x_3 -
        dv_z_E4_y*l_E6_x__E4_y_3 - dv_z_F_x*l_E6_x__F_x_3 - dv_z_F_y*l_E6_x__F_y_3 - dv_z_H_x*l_E6_x__H_x_3 -
        dv_z_H_y*l_E6_x__H_y_3 + phi_dot_E6_x_2;
    const double dv_z_E6_y = -dv_z_E3_x*l_E6_y__E3_x_3 - dv_z_E3_y*l_E6_y__E3_y_3 - dv_z_E4_x*l_E6_y__E4_x_3 -
        dv_z_E4_y*l_E6_y__E4_y_3 - dv_z_E6_x*l_E6_y__E6_x_3 - dv_z_F_x*l_E6_y__F_x_3 - dv_z_F_y*l_E6_y__F_y_3
        - dv_z_H_x*l_E6_y__H_x_3 - dv_z_H_y*l_E6_y__H_y_3 + phi_dot_E6_y_2;

    /* backward substitution */
    const double dv_lambda_E6_y = -dv_z_E6_y*inverse_pivot_E6_y_3;
    const double dv_lambda_E6_x = -dv_lambda_E6_y*l_E6_y__E6_x_3 - dv_z_E6_x*inverse_pivot_E6_x_3;
    const double dv_lambda_E4_y = -dv_lambda_E6_x*l_E6_x__E4_y_3 - dv_lambda_E6_y*l_E6_y__E4_y_3 -
        dv_z_E4_y*inverse_pivot_E4_y_3;
    const double dv_lambda_E4_x = -dv_lambda_E4_y*l_E4_y__E4_x_3 - dv_lambda_E6_x*l_E6_x__E4_x_3 -
        dv_lambda_E6_y*l_E6_y__E4_x_3 - dv_z_E4_x*inverse_pivot_E4_x_3;
    const double dv_lambda_E3_y = -dv_lambda_E4_x*l_E4_x__E3_y_3 - dv_lambda_E4_y*l_E4_y__E3_y_3 -
        dv_lambda_E6_x*l_E6_x__E3_y_3 - dv_lambda_E6_y*l_E6_y__E3_y_3 - dv_z_E3_y*inverse_pivot_E3_y_3;
    const double dv_lambda_E3_x = -dv_lambda_E3_y*l_E3_y__E3_x_3 - dv_lambda_E4_x*l_E4_x__E3_x_3 -
        dv_lambda_E4_y*l_E4_y__E3_x_3 - dv_lambda_E6_x*l_E6_x__E3_x_3 - dv_lambda_E6_y*l_E6_y__E3_x_3 -
        dv_z_E3_x*inverse_pivot_E3_x_3;
    const double dv_lambda_F_y = -dv_lambda_E3_x*l_E3_x__F_y_3 - dv_lambda_E3_y*l_E3_y__F_y_3 -
        dv_lambda_E4_x*l_E4_x__F_y_3 - dv_lambda_E4_y*l_E4_y__F_y_3 - dv_lambda_E6_x*l_E6_x__F_y_3 -
        dv_lambda_E6_y*l_E6_y__F_y_3 - dv_z_F_y*inverse_pivot_F_y_3;
    const double dv_lambda_F_x = -dv_lambda_E3_x*l_E3_x__F_x_3 - dv_lambda_E3_y*l_E3_y__F_x_3 -
        dv_lambda_E4_x*l_E4_x__F_x_3 - dv_lambda_E4_y*l_E4_y__F_x_3 - dv_lambda_E6_x*l_E6_x__F_x_3 -
        dv_lambda_E6_y*l_E6_y__F_x_3 - dv_lambda_F_y*l_F_y__F_x_3 - dv_z_F_x*inverse_pivot_F_x_3;
    const double dv_acceleration_FE_theta = -dv_lambda_E3_x*l_E3_x__FE_theta_3 -
        dv_lambda_E3_y*l_E3_y__FE_theta_3 - dv_lambda_E4_x*l_E4_x__FE_theta_3 -
        dv_lambda_E4_y*l_E4_y__FE_theta_3 - dv_lambda_E6_x*l_E6_x__FE_theta_3 -
        dv_lambda_E6_y*l_E6_y__FE_theta_3 - dv_lambda_F_x*l_F_x__FE_theta_3 - dv_lambda_F_y*l_F_y__FE_theta_3;
    const double dv_lambda_H_y = -dv_lambda_E6_x*l_E6_x__H_y_3 - dv_lambda_E6_y*l_E6_y__H_y_3 -
        dv_z_H_y*inverse_pivot_H_y_3;
    const double dv_lambda_H_x = -dv_lambda_E6_x*l_E6_x__H_x_3 - dv_lambda_E6_y*l_E6_y__H_x_3 -
        dv_lambda_H_y*l_H_y__H_x_3 - dv_z_H_x*inverse_pivot_H_x_3;
    const double dv_lambda_A7_y = -dv_lambda_H_x*l_H_x__A7_y_3 - dv_lambda_H_y*l_H_y__A7_y_3 -
        dv_z_A7_y*inverse_pivot_A7_y_3;
    const double dv_lambda_A7_x = -dv_lambda_A7_y*l_A7_y__A7_x_3 - dv_lambda_H_x*l_H_x__A7_x_3 -
        dv_lambda_H_y*l_H_y__A7_x_3 - inverse_pivot_A7_x_3*phi_dot_A7_x_2;
    const double dv_acceleration_AH_theta = -dv_lambda_A7_x*l_A7_x__AH_theta_3 -
        dv_lambda_A7_y*l_A7_y__AH_theta_3 - dv_lambda_H_x*l_H_x__AH_theta_3 - dv_lambda_H_y*l_H_y__AH_theta_3;
    const double dv_acceleration_HE_theta = -dv_lambda_E6_x*l_E6_x__HE_theta_3 -
        dv_lambda_E6_y*l_E6_y__HE_theta_3 - dv_lambda_H_x*l_H_x__HE_theta_3 - dv_lambda_H_y*l_H_y__HE_theta_3;
    const double dv_lambda_G_y = -dv_lambda_E4_x*l_E4_x__G_y_3 - dv_lambda_E4_y*l_E4_y__G_y_3 -
        dv_z_G_y*inverse_pivot_G_y_3;
    const double dv_lambda_G_x = -dv_lambda_E4_x*l_E4_x__G_x_3 - dv_lambda_E4_y*l_E4_y__G_x_3 -
        dv_lambda_G_y*l_G_y__G_x_3 - dv_z_G_x*inverse_pivot_G_x_3;
    const double dv_lambda_A5_y = -dv_lambda_G_x*l_G_x__A5_y_3 - dv_lambda_G_y*l_G_y__A5_y_3 -
        dv_z_A5_y*inverse_pivot_A5_y_3;
    const double dv_lambda_A5_x = -dv_lambda_A5_y*l_A5_y__A5_x_3 - dv_lambda_G_x*l_G_x__A5_x_3 -
        dv_lambda_G_y*l_G_y__A5_x_3 - inverse_pivot_A5_x_3*phi_dot_A5_x_2;
    const double dv_acceleration_AG_theta = -dv_lambda_A5_x*l_A5_x__AG_theta_3 -
        dv_lambda_A5_y*l_A5_y__AG_theta_3 - dv_lambda_G_x*l_G_x__AG_theta_3 - dv_lambda_G_y*l_G_y__AG_theta_3;
    const double dv_acceleration_EG_theta = -dv_lambda_E4_x*l_E4_x__EG_theta_3 -
        dv_lambda_E4_y*l_E4_y__EG_theta_3 - dv_lambda_G_x*l_G_x__EG_theta_3 - dv_lambda_G_y*l_G_y__EG_theta_3;
    const double dv_lambda_B_y = -dv_lambda_E3_x*l_E3_x__B_y_3 - dv_lambda_E3_y*l_E3_y__B_y_3 -
        dv_z_B_y*inverse_pivot_B_y_3;
    const double dv_lambda_B_x = -dv_lambda_B_y*l_B_y__B_x_3 - dv_lambda_E3_x*l_E3_x__B_x_3 -
        dv_lambda_E3_y*l_E3_y__B_x_3 - inverse_pivot_B_x_3*phi_dot_B_x_2;
    const double dv_acceleration_BDE_theta = -dv_lambda_B_x*l_B_x__BDE_theta_3 -
        dv_lambda_B_y*l_B_y__BDE_theta_3 - dv_lambda_E3_x*l_E3_x__BDE_theta_3 -
        dv_lambda_E3_y*l_E3_y__BDE_theta_3;
    const double dv_acceleration_FE_y = -dv_lambda_E3_y*inverse_FE_mass - dv_lambda_E4_y*inverse_FE_mass -
        dv_lambda_E6_y*inverse_FE_mass + dv_lambda_F_y*inverse_FE_mass;
    const double dv_acceleration_FE_x = -dv_lambda_E3_x*inverse_FE_mass - dv_lambda_E4_x*inverse_FE_mass -
        dv_lambda_E6_x*inverse_FE_mass + dv_lambda_F_x*inverse_FE_mass;
    const double dv_lambda_O_y = -dv_lambda_F_x*l_F_x__O_y_3 - dv_lambda_F_y*l_F_y__O_y_3 -
        dv_z_O_y*inverse_pivot_O_y_3;
    const double dv_lambda_O_x = -dv_lambda_F_x*l_F_x__O_x_3 - dv_lambda_F_y*l_F_y__O_x_3 -
        dv_lambda_O_y*l_O_y__O_x_3 - inverse_pivot_O_x_3*phi_dot_O_x_2;
    const double dv_acceleration_OF_theta = -dv_lambda_F_x*l_F_x__OF_theta_3 - dv_lambda_F_y*l_F_y__OF_theta_3
        - dv_lambda_O_x*l_O_x__OF_theta_3 - dv_lambda_O_y*l_O_y__OF_theta_3;
    const double dv_acceleration_AH_y = dv_lambda_A7_y*inverse_AH_mass + dv_lambda_H_y*inverse_AH_mass;
    const double dv_acceleration_AH_x = dv_lambda_A7_x*inverse_AH_mass + dv_lambda_H_x*inverse_AH_mass;
    const double dv_acceleration_HE_y = dv_lambda_E6_y*inverse_HE_mass - dv_lambda_H_y*inverse_HE_mass;
    const double dv_acceleration_HE_x = dv_lambda_E6_x*inverse_HE_mass - dv_lambda_H_x*inverse_HE_mass;
    const double dv_acceleration_AG_y = dv_lambda_A5_y*inverse_AG_mass + dv_lambda_G_y*inverse_AG_mass;
    const double dv_acceleration_AG_x = dv_lambda_A5_x*inverse_AG_mass + dv_lambda_G_x*inverse_AG_mass;
    const double dv_acceleration_EG_y = dv_lambda_E4_y*inverse_EG_mass - dv_lambda_G_y*inverse_EG_mass;
    const double dv_acceleration_EG_x = dv_lambda_E4_x*inverse_EG_mass - dv_lambda_G_x*inverse_EG_mass;
    const double dv_acceleration_BDE_y = dv_lambda_B_y*inverse_BDE_mass + dv_lambda_E3_y*inverse_BDE_mass;
    const double dv_acceleration_BDE_x = dv_lambda_B_x*inverse_BDE_mass + dv_lambda_E3_x*inverse_BDE_mass;
    const double dv_acceleration_OF_y = -dv_lambda_F_y*inverse_OF_mass + dv_lambda_O_y*inverse_OF_mass;
    const double dv_acceleration_OF_x = -dv_lambda_F_x*inverse_OF_mass + dv_lambda_O_x*inverse_OF_mass;

    /* results */
    dq[0] = dq_acceleration_OF_x;
    dv[0] = dv_acceleration_OF_x;
    dq[1] = dq_acceleration_OF_y;
    dv[1] = dv_acceleration_OF_y;
    dq[2] = dq_acceleration_OF_theta;
    dv[2] = dv_acceleration_OF_theta;
    dq[3] = dq_acceleration_FE_x;
    dv[3] = dv_acceleration_FE_x;
    dq[4] = dq_acceleration_FE_y;
    dv[4] = dv_acceleration_FE_y;
    dq[5] = dq_acceleration_FE_theta;
    dv[5] = dv_acceleration_FE_theta;
    dq[6] = dq_acceleration_BDE_x;
    dv[6] = dv_acceleration_BDE_x;
    dq[7] = dq_acceleration_BDE_y;
    dv[7] = dv_acceleration_BDE_y;
    dq[8] = dq_acceleration_BDE_theta;
    dv[8] = dv_acceleration_BDE_theta;
    dq[9] = dq_acceleration_EG_x;
    dv[9] = dv_acceleration_EG_x;
    dq[10] = dq_acceleration_EG_y;
    dv[10] = dv_acceleration_EG_y;
    dq[11] = dq_acceleration_EG_theta;
    dv[11] = dv_acceleration_EG_theta;
    dq[12] = dq_acceleration_AG_x;
    dv[12] = dv_acceleration_AG_x;
    dq[13] = dq_acceleration_AG_y;
    dv[13] = dv_acceleration_AG_y;
    dq[14] = dq_acceleration_AG_theta;
    dv[14] = dv_acceleration_AG_theta;
    dq[15] = dq_acceleration_HE_x;
    dv[15] = dv_acceleration_HE_x;
    dq[16] = dq_acceleration_HE_y;
    dv[16] = dv_acceleration_HE_y;
    dq[17] = dq_acceleration_HE_theta;
    dv[17] = dv_acceleration_HE_theta;
    dq[18] = dq_acceleration_AH_x;
    dv[18] = dv_acceleration_AH_x;
    dq[19] = dq_acceleration_AH_y;
    dv[19] = dv_acceleration_AH_y;
    dq[20] = dq_acceleration_AH_theta;
    dv[20] = dv_acceleration_AH_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_O_x_2), *worst);
    *worst = fmax(fabs(phi_O_y_2), *worst);
    *worst = fmax(fabs(phi_B_x_2), *worst);
    *worst = fmax(fabs(phi_B_y_2), *worst);
    *worst = fmax(fabs(phi_A5_x_2), *worst);
    *worst = fmax(fabs(phi_A5_y_2), *worst);
    *worst = fmax(fabs(phi_A7_x_2), *worst);
    *worst = fmax(fabs(phi_A7_y_2), *worst);
    *worst = fmax(fabs(phi_F_x_2), *worst);
    *worst = fmax(fabs(phi_F_y_2), *worst);
    *worst = fmax(fabs(phi_E3_x_2), *worst);
    *worst = fmax(fabs(phi_E3_y_2), *worst);
    *worst = fmax(fabs(phi_E4_x_2), *worst);
    *worst = fmax(fabs(phi_E4_y_2), *worst);
    *worst = fmax(fabs(phi_E6_x_2), *worst);
    *worst = fmax(fabs(phi_E6_y_2), *worst);
    *worst = fmax(fabs(phi_G_x_2), *worst);
    *worst = fmax(fabs(phi_G_y_2), *worst);
    *worst = fmax(fabs(phi_H_x_2), *worst);
    *worst = fmax(fabs(phi_H_y_2), *worst);
    return 0;
}

