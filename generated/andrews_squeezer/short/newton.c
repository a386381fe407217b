/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[101]; /* what linearize() found */
    double lu[189];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double OF_theta = q[2];
    const double OF_omega = v[2];
    const double FE_theta = q[5];
    const double FE_omega = v[5];
    const double BDE_x = q[6];
    const double BDE_y = q[7];
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
    const double acceleration_OF_theta_2 = a[2];
    const double acceleration_FE_theta_2 = a[5];
    const double acceleration_BDE_theta_2 = a[8];
    const double acceleration_EG_theta_2 = a[11];
    const double acceleration_AG_theta_2 = a[14];
    const double acceleration_HE_theta_2 = a[17];
    const double acceleration_AH_theta_2 = a[20];
    const double multiplier_O_x_2 = aside->lambda[0];
    const double multiplier_O_y_2 = aside->lambda[1];
    const double multiplier_B_x_2 = aside->lambda[2];
    const double multiplier_B_y_2 = aside->lambda[3];
    const double multiplier_A5_x_2 = aside->lambda[4];
    const double multiplier_A5_y_2 = aside->lambda[5];
    const double multiplier_A7_x_2 = aside->lambda[6];
    const double multiplier_A7_y_2 = aside->lambda[7];
    const double multiplier_F_x_2 = aside->lambda[8];
    const double multiplier_F_y_2 = aside->lambda[9];
    const double multiplier_E3_x_2 = aside->lambda[10];
    const double multiplier_E3_y_2 = aside->lambda[11];
    const double multiplier_E4_x_2 = aside->lambda[12];
    const double multiplier_E4_y_2 = aside->lambda[13];
    const double multiplier_E6_x_2 = aside->lambda[14];
    const double multiplier_E6_y_2 = aside->lambda[15];
    const double multiplier_G_x_2 = aside->lambda[16];
    const double multiplier_G_y_2 = aside->lambda[17];
    const double multiplier_H_x_2 = aside->lambda[18];
    const double multiplier_H_y_2 = aside->lambda[19];

    /* parameters */
    const double OF_points_O_x = p->OF_points_O_x;
    const double OF_points_F_x = p->OF_points_F_x;
    const double FE_points_E_x = p->FE_points_E_x;
    const double FE_points_F_x = p->FE_points_F_x;
    const double BDE_points_B_x = p->BDE_points_B_x;
    const double BDE_points_B_y = p->BDE_points_B_y;
    const double BDE_points_E_x = p->BDE_points_E_x;
    const double BDE_points_E_y = p->BDE_points_E_y;
    const double BDE_points_D_x = p->BDE_points_D_x;
    const double BDE_points_D_y = p->BDE_points_D_y;
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
    const double C_x = p->C_x;
    const double C_y = p->C_y;
    const double spring_stiffness = p->spring_stiffness;
    const double spring_free_length = p->spring_free_length;
    const double motor_value = p->motor_value;
    const double two_alpha = p->two_alpha;

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
    const double arm_BDE_D_x = BDE_points_D_x*cos_theta_BDE - BDE_points_D_y*sin_theta_BDE;
    const double arm_BDE_D_y = BDE_points_D_x*sin_theta_BDE + BDE_points_D_y*cos_theta_BDE;
    const double spring_span_x = BDE_x - C_x + arm_BDE_D_x;
    const double spring_span_y = BDE_y - C_y + arm_BDE_D_y;
    const double spring_length = sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const double spring_force = spring_stiffness*(-spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* coordinates */
    const double inverse_denominator = 1.0/(spring_length + 1e-150);
    const double spring_length_by_BDE_x = inverse_denominator*spring_span_x;
    const double spring_length_by_BDE_theta = arm_BDE_D_x*inverse_denominator*spring_span_y -
        arm_BDE_D_y*inverse_denominator*spring_span_x;
    const double spring_length_by_BDE_y = inverse_denominator*spring_span_y;
    const double spring_force_by_BDE_x = spring_length_by_BDE_x*spring_stiffness;
    const double spring_force_by_BDE_theta = spring_length_by_BDE_theta*spring_stiffness;
    const double spring_force_by_BDE_y = spring_length_by_BDE_y*spring_stiffness;
    const double inverse_spring_length = 1.0/spring_length;
    const double spring_pull_by_BDE_x = -(inverse_spring_length *
        inverse_spring_length)*spring_force*spring_length_by_BDE_x +
        inverse_spring_length*spring_force_by_BDE_x;
    const double spring_pull_by_BDE_theta = -(inverse_spring_length *
        inverse_spring_length)*spring_force*spring_length_by_BDE_theta +
        inverse_spring_length*spring_force_by_BDE_theta;
    const double spring_pull_by_BDE_y = -(inverse_spring_length *
        inverse_spring_length)*spring_force*spring_length_by_BDE_y +
        inverse_spring_length*spring_force_by_BDE_y;

    /* results */
    lin->value[0] = arm_OF_O_y;
    lin->value[1] = -arm_OF_O_x;
    lin->value[2] = arm_BDE_B_y;
    lin->value[3] = -arm_BDE_B_x;
    lin->value[4] = arm_AG_A_y;
    lin->value[5] = -arm_AG_A_x;
    lin->value[6] = arm_AH_A_y;
    lin->value[7] = -arm_AH_A_x;
    lin->value[8] = -arm_OF_F_y;
    lin->value[9] = arm_FE_F_y;
    lin->value[10] = arm_OF_F_x;
    lin->value[11] = -arm_FE_F_x;
    lin->value[12] = -arm_FE_E_y;
    lin->value[13] = arm_BDE_E_y;
    lin->value[14] = arm_FE_E_x;
    lin->value[15] = -arm_BDE_E_x;
    lin->value[16] = arm_EG_E_y;
    lin->value[17] = -arm_EG_E_x;
    lin->value[18] = arm_HE_E_y;
    lin->value[19] = -arm_HE_E_x;
    lin->value[20] = -arm_EG_G_y;
    lin->value[21] = arm_AG_G_y;
    lin->value[22] = arm_EG_G_x;
    lin->value[23] = -arm_AG_G_x;
    lin->value[24] = -arm_HE_H_y;
    lin->value[25] = arm_AH_H_y;
    lin->value[26] = arm_HE_H_x;
    lin->value[27] = -arm_AH_H_x;
    lin->value[28] = -(OF_omega * OF_omega)*arm_OF_O_y + OF_omega*arm_OF_O_x*two_alpha +
        acceleration_OF_theta_2*arm_OF_O_x;
    lin->value[29] = (OF_omega * OF_omega)*arm_OF_O_x + OF_omega*arm_OF_O_y*two_alpha +
        acceleration_OF_theta_2*arm_OF_O_y;
    lin->value[30] = -(BDE_omega * BDE_omega)*arm_BDE_B_y + BDE_omega*arm_BDE_B_x*two_alpha +
        acceleration_BDE_theta_2*arm_BDE_B_x;
    lin->value[31] = (BDE_omega * BDE_omega)*arm_BDE_B_x + BDE_omega*arm_BDE_B_y*two_alpha +
        acceleration_BDE_theta_2*arm_BDE_B_y;
    lin->value[32] = -(AG_omega * AG_omega)*arm_AG_A_y + AG_omega*arm_AG_A_x*two_alpha +
        acceleration_AG_theta_2*arm_AG_A_x;
    lin->value[33] = (AG_omega * AG_omega)*arm_AG_A_x + AG_omega*arm_AG_A_y*two_alpha +
        acceleration_AG_theta_2*arm_AG_A_y;
    lin->value[34] = -(AH_omega * AH_omega)*arm_AH_A_y + AH_omega*arm_AH_A_x*two_alpha +
        acceleration_AH_theta_2*arm_AH_A_x;
    lin->value[35] = (AH_omega * AH_omega)*arm_AH_A_x + AH_omega*arm_AH_A_y*two_alpha +
        acceleration_AH_theta_2*arm_AH_A_y;
    lin->value[36] = -(FE_omega * FE_omega)*arm_FE_F_y + FE_omega*arm_FE_F_x*two_alpha +
        acceleration_FE_theta_2*arm_FE_F_x;
    lin->value[37] = (OF_omega * OF_omega)*arm_OF_F_y - OF_omega*arm_OF_F_x*two_alpha -
        acceleration_OF_theta_2*arm_OF_F_x;
    lin->value[38] = (FE_omega * FE_omega)*arm_FE_F_x + FE_omega*arm_FE_F_y*two_alpha +
        acceleration_FE_theta_2*arm_FE_F_y;
    lin->value[39] = -(OF_omega * OF_omega)*arm_OF_F_x - OF_omega*arm_OF_F_y*two_alpha -
        acceleration_OF_theta_2*arm_OF_F_y;
    lin->value[40] = -(BDE_omega * BDE_omega)*arm_BDE_E_y + BDE_omega*arm_BDE_E_x*two_alpha +
        acceleration_BDE_theta_2*arm_BDE_E_x;
    lin->value[41] = (FE_omega * FE_omega)*arm_FE_E_y - FE_omega*arm_FE_E_x*two_alpha -
        acceleration_FE_theta_2*arm_FE_E_x;
    lin->value[42] = (BDE_omega * BDE_omega)*arm_BDE_E_x + BDE_omega*arm_BDE_E_y*two_alpha +
        acceleration_BDE_theta_2*arm_BDE_E_y;
    lin->value[43] = -(FE_omega * FE_omega)*arm_FE_E_x - FE_omega*arm_FE_E_y*two_alpha -
        acceleration_FE_theta_2*arm_FE_E_y;
    lin->value[44] = -(EG_omega * EG_omega)*arm_EG_E_y + EG_omega*arm_EG_E_x*two_alpha +
        acceleration_EG_theta_2*arm_EG_E_x;
    lin->value[45] = (EG_omega * EG_omega)*arm_EG_E_x + EG_omega*arm_EG_E_y*two_alpha +
        acceleration_EG_theta_2*arm_EG_E_y;
    lin->value[46] = -(HE_omega * HE_omega)*arm_HE_E_y + HE_omega*arm_HE_E_x*two_alpha +
        acceleration_HE_theta_2*arm_HE_E_x;
    lin->value[47] = (HE_omega * HE_omega)*arm_HE_E_x + HE_omega*arm_HE_E_y*two_alpha +
        acceleration_HE_theta_2*arm_HE_E_y;
    lin->value[48] = -(AG_omega * AG_omega)*arm_AG_G_y + AG_omega*arm_AG_G_x*two_alpha +
        acceleration_AG_theta_2*arm_AG_G_x;
    lin->value[49] = (EG_omega * EG_omega)*arm_EG_G_y - EG_omega*arm_EG_G_x*two_alpha -
        acceleration_EG_theta_2*arm_EG_G_x;
    lin->value[50] = (AG_omega * AG_omega)*arm_AG_G_x + AG_omega*arm_AG_G_y*two_alpha +
        acceleration_AG_theta_2*arm_AG_G_y;
    lin->value[51] = -(EG_omega * EG_omega)*arm_EG_G_x - EG_omega*arm_EG_G_y*two_alpha -
        acceleration_EG_theta_2*arm_EG_G_y;
    lin->value[52] = -(AH_omega * AH_omega)*arm_AH_H_y + AH_omega*arm_AH_H_x*two_alpha +
        acceleration_AH_theta_2*arm_AH_H_x;
    lin->value[53] = (HE_omega * HE_omega)*arm_HE_H_y - HE_omega*arm_HE_H_x*two_alpha -
        acceleration_HE_theta_2*arm_HE_H_x;
    lin->value[54] = (AH_omega * AH_omega)*arm_AH_H_x + AH_omega*arm_AH_H_y*two_alpha +
        acceleration_AH_theta_2*arm_AH_H_y;
    lin->value[55] = -(HE_omega * HE_omega)*arm_HE_H_x - HE_omega*arm_HE_H_y*two_alpha -
        acceleration_HE_theta_2*arm_HE_H_y;
    lin->value[56] = -arm_OF_F_x*multiplier_F_x_2 - arm_OF_F_y*multiplier_F_y_2 + arm_OF_O_x*multiplier_O_x_2
        + arm_OF_O_y*multiplier_O_y_2;
    lin->value[57] = arm_FE_E_x*(-multiplier_E3_x_2 - multiplier_E4_x_2 - multiplier_E6_x_2) -
        arm_FE_E_y*(multiplier_E3_y_2 + multiplier_E4_y_2 + multiplier_E6_y_2) + arm_FE_F_x*multiplier_F_x_2 +
        arm_FE_F_y*multiplier_F_y_2;
    lin->value[58] = spring_pull + spring_pull_by_BDE_x*spring_span_x;
    lin->value[59] = -arm_BDE_D_y*spring_pull + spring_pull_by_BDE_theta*spring_span_x;
    lin->value[60] = spring_pull_by_BDE_y*spring_span_x;
    lin->value[61] = spring_pull_by_BDE_x*spring_span_y;
    lin->value[62] = arm_BDE_D_x*spring_pull + spring_pull_by_BDE_theta*spring_span_y;
    lin->value[63] = spring_pull + spring_pull_by_BDE_y*spring_span_y;
    lin->value[64] = arm_BDE_B_x*multiplier_B_x_2 + arm_BDE_B_y*multiplier_B_y_2 + (arm_BDE_D_x *
        arm_BDE_D_x)*spring_pull - arm_BDE_D_x*spring_pull*spring_span_x + (arm_BDE_D_y *
        arm_BDE_D_y)*spring_pull - arm_BDE_D_y*spring_pull*spring_span_y + arm_BDE_E_x*multiplier_E3_x_2 +
        arm_BDE_E_y*multiplier_E3_y_2 + spring_pull_by_BDE_theta*(arm_BDE_D_x*spring_span_y -
        arm_BDE_D_y*spring_span_x);
    lin->value[65] = -arm_BDE_D_y*spring_pull + spring_pull_by_BDE_x*(arm_BDE_D_x*spring_span_y -
        arm_BDE_D_y*spring_span_x);
    lin->value[66] = arm_BDE_D_x*spring_pull + spring_pull_by_BDE_y*(arm_BDE_D_x*spring_span_y -
        arm_BDE_D_y*spring_span_x);
    lin->value[67] = arm_EG_E_x*multiplier_E4_x_2 + arm_EG_E_y*multiplier_E4_y_2 - arm_EG_G_x*multiplier_G_x_2
        - arm_EG_G_y*multiplier_G_y_2;
    lin->value[68] = arm_AG_A_x*multiplier_A5_x_2 + arm_AG_A_y*multiplier_A5_y_2 + arm_AG_G_x*multiplier_G_x_2
        + arm_AG_G_y*multiplier_G_y_2;
    lin->value[69] = arm_HE_E_x*multiplier_E6_x_2 + arm_HE_E_y*multiplier_E6_y_2 - arm_HE_H_x*multiplier_H_x_2
        - arm_HE_H_y*multiplier_H_y_2;
    lin->value[70] = arm_AH_A_x*multiplier_A7_x_2 + arm_AH_A_y*multiplier_A7_y_2 + arm_AH_H_x*multiplier_H_x_2
        + arm_AH_H_y*multiplier_H_y_2;
    lin->value[71] = 2.0*OF_omega*arm_OF_O_x;
    lin->value[72] = 2.0*OF_omega*arm_OF_O_y;
    lin->value[73] = 2.0*BDE_omega*arm_BDE_B_x;
    lin->value[74] = 2.0*BDE_omega*arm_BDE_B_y;
    lin->value[75] = 2.0*AG_omega*arm_AG_A_x;
    lin->value[76] = 2.0*AG_omega*arm_AG_A_y;
    lin->value[77] = 2.0*AH_omega*arm_AH_A_x;
    lin->value[78] = 2.0*AH_omega*arm_AH_A_y;
    lin->value[79] = 2.0*FE_omega*arm_FE_F_x;
    lin->value[80] = -2.0*OF_omega*arm_OF_F_x;
    lin->value[81] = 2.0*FE_omega*arm_FE_F_y;
    lin->value[82] = -2.0*OF_omega*arm_OF_F_y;
    lin->value[83] = 2.0*BDE_omega*arm_BDE_E_x;
    lin->value[84] = -2.0*FE_omega*arm_FE_E_x;
    lin->value[85] = 2.0*BDE_omega*arm_BDE_E_y;
    lin->value[86] = -2.0*FE_omega*arm_FE_E_y;
    lin->value[87] = 2.0*EG_omega*arm_EG_E_x;
    lin->value[88] = 2.0*EG_omega*arm_EG_E_y;
    lin->value[89] = 2.0*HE_omega*arm_HE_E_x;
    lin->value[90] = 2.0*HE_omega*arm_HE_E_y;
    lin->value[91] = 2.0*AG_omega*arm_AG_G_x;
    lin->value[92] = -2.0*EG_omega*arm_EG_G_x;
    lin->value[93] = 2.0*AG_omega*arm_AG_G_y;
    lin->value[94] = -2.0*EG_omega*arm_EG_G_y;
    lin->value[95] = 2.0*AH_omega*arm_AH_H_x;
    lin->value[96] = -2.0*HE_omega*arm_HE_H_x;
    lin->value[97] = 2.0*AH_omega*arm_AH_H_y;
    lin->value[98] = -2.0*HE_omega*arm_HE_H_y;
    lin->value[99] = -1.0;
    lin->value[100] = motor_value;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static int newton_factor(double eta, Linear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O_x_OF_theta = lin->value[0];
    const double phi_O_y_OF_theta = lin->value[1];
    const double phi_B_x_BDE_theta = lin->value[2];
    const double phi_B_y_BDE_theta = lin->value[3];
    const double phi_A5_x_AG_theta = lin->value[4];
    const double phi_A5_y_AG_theta = lin->value[5];
    const double phi_A7_x_AH_theta = lin->value[6];
    const double phi_A7_y_AH_theta = lin->value[7];
    const double phi_F_x_OF_theta = lin->value[8];
    const double phi_F_x_FE_theta = lin->value[9];
    const double phi_F_y_OF_theta = lin->value[10];
    const double phi_F_y_FE_theta = lin->value[11];
    const double phi_E3_x_FE_theta = lin->value[12];
    const double phi_E3_x_BDE_theta = lin->value[13];
    const double phi_E3_y_FE_theta = lin->value[14];
    const double phi_E3_y_BDE_theta = lin->value[15];
    const double phi_E4_x_EG_theta = lin->value[16];
    const double phi_E4_y_EG_theta = lin->value[17];
    const double phi_E6_x_HE_theta = lin->value[18];
    const double phi_E6_y_HE_theta = lin->value[19];
    const double phi_G_x_EG_theta = lin->value[20];
    const double phi_G_x_AG_theta = lin->value[21];
    const double phi_G_y_EG_theta = lin->value[22];
    const double phi_G_y_AG_theta = lin->value[23];
    const double phi_H_x_HE_theta = lin->value[24];
    const double phi_H_x_AH_theta = lin->value[25];
    const double phi_H_y_HE_theta = lin->value[26];
    const double phi_H_y_AH_theta = lin->value[27];
    const double by_q_O_x_OF_theta = lin->value[28];
    const double by_q_O_y_OF_theta = lin->value[29];
    const double by_q_B_x_BDE_theta = lin->value[30];
    const double by_q_B_y_BDE_theta = lin->value[31];
    const double by_q_A5_x_AG_theta = lin->value[32];
    const double by_q_A5_y_AG_theta = lin->value[33];
    const double by_q_A7_x_AH_theta = lin->value[34];
    const double by_q_A7_y_AH_theta = lin->value[35];
    const double by_q_F_x_FE_theta = lin->value[36];
    const double by_q_F_x_OF_theta = lin->value[37];
    const double by_q_F_y_FE_theta = lin->value[38];
    const double by_q_F_y_OF_theta = lin->value[39];
    const double by_q_E3_x_BDE_theta = lin->value[40];
    const double by_q_E3_x_FE_theta = lin->value[41];
    const double by_q_E3_y_BDE_theta = lin->value[42];
    const double by_q_E3_y_FE_theta = lin->value[43];
    const double by_q_E4_x_EG_theta = lin->value[44];
    const double by_q_E4_y_EG_theta = lin->value[45];
    const double by_q_E6_x_HE_theta = lin->value[46];
    const double by_q_E6_y_HE_theta = lin->value[47];
    const double by_q_G_x_AG_theta = lin->value[48];
    const double by_q_G_x_EG_theta = lin->value[49];
    const double by_q_G_y_AG_theta = lin->value[50];
    const double by_q_G_y_EG_theta = lin->value[51];
    const double by_q_H_x_AH_theta = lin->value[52];
    const double by_q_H_x_HE_theta = lin->value[53];
    const double by_q_H_y_AH_theta = lin->value[54];
    const double by_q_H_y_HE_theta = lin->value[55];
    const double by_q_OF_theta_OF_theta = lin->value[56];
    const double by_q_FE_theta_FE_theta = lin->value[57];
    const double by_q_BDE_x_BDE_x = lin->value[58];
    const double by_q_BDE_x_BDE_theta = lin->value[59];
    const double by_q_BDE_x_BDE_y = lin->value[60];
    const double by_q_BDE_y_BDE_x = lin->value[61];
    const double by_q_BDE_y_BDE_theta = lin->value[62];
    const double by_q_BDE_y_BDE_y = lin->value[63];
    const double by_q_BDE_theta_BDE_theta = lin->value[64];
    const double by_q_BDE_theta_BDE_x = lin->value[65];
    const double by_q_BDE_theta_BDE_y = lin->value[66];
    const double by_q_EG_theta_EG_theta = lin->value[67];
    const double by_q_AG_theta_AG_theta = lin->value[68];
    const double by_q_HE_theta_HE_theta = lin->value[69];
    const double by_q_AH_theta_AH_theta = lin->value[70];
    const double by_v_O_x_OF_theta = lin->value[71];
    const double by_v_O_y_OF_theta = lin->value[72];
    const double by_v_B_x_BDE_theta = lin->value[73];
    const double by_v_B_y_BDE_theta = lin->value[74];
    const double by_v_A5_x_AG_theta = lin->value[75];
    const double by_v_A5_y_AG_theta = lin->value[76];
    const double by_v_A7_x_AH_theta = lin->value[77];
    const double by_v_A7_y_AH_theta = lin->value[78];
    const double by_v_F_x_FE_theta = lin->value[79];
    const double by_v_F_x_OF_theta = lin->value[80];
    const double by_v_F_y_FE_theta = lin->value[81];
    const double by_v_F_y_OF_theta = lin->value[82];
    const double by_v_E3_x_BDE_theta = lin->value[83];
    const double by_v_E3_x_FE_theta = lin->value[84];
    const double by_v_E3_y_BDE_theta = lin->value[85];
    const double by_v_E3_y_FE_theta = lin->value[86];
    const double by_v_E4_x_EG_theta = lin->value[87];
    const double by_v_E4_y_EG_theta = lin->value[88];
    const double by_v_E6_x_HE_theta = lin->value[89];
    const double by_v_E6_y_HE_theta = lin->value[90];
    const double by_v_G_x_AG_theta = lin->value[91];
    const double by_v_G_x_EG_theta = lin->value[92];
    const double by_v_G_y_AG_theta = lin->value[93];
    const double by_v_G_y_EG_theta = lin->value[94];
    const double by_v_H_x_AH_theta = lin->value[95];
    const double by_v_H_x_HE_theta = lin->value[96];
    const double by_v_H_y_AH_theta = lin->value[97];
    const double by_v_H_y_HE_theta = lin->value[98];

    /* parameters */
    const double OF_inertia = p->OF_inertia;
    const double FE_inertia = p->FE_inertia;
    const double BDE_mass = p->BDE_mass;
    const double BDE_inertia = p->BDE_inertia;
    const double EG_inertia = p->EG_inertia;
    const double AG_inertia = p->AG_inertia;
    const double HE_inertia = p->HE_inertia;
    const double AH_inertia = p->AH_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double inverse_OF_mass = p->inverse_OF_mass;
    const double inverse_EG_mass = p->inverse_EG_mass;
    const double inverse_AG_mass = p->inverse_AG_mass;
    const double inverse_HE_mass = p->inverse_HE_mass;
    const double inverse_AH_mass = p->inverse_AH_mass;
    const double inverse_FE_mass = p->inverse_FE_mass;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_OF_theta__OF_theta = OF_inertia + by_q_OF_theta_OF_theta*(eta * eta);
    const double n_FE_theta__FE_theta = FE_inertia + by_q_FE_theta_FE_theta*(eta * eta);
    const double n_BDE_x__BDE_x = BDE_mass + by_q_BDE_x_BDE_x*(eta * eta);
    const double n_BDE_x__BDE_y = by_q_BDE_x_BDE_y*(eta * eta);
    const double n_BDE_x__BDE_theta = by_q_BDE_x_BDE_theta*(eta * eta);
    const double n_BDE_y__BDE_x = by_q_BDE_y_BDE_x*(eta * eta);
    const double n_BDE_y__BDE_y = BDE_mass + by_q_BDE_y_BDE_y*(eta * eta);
    const double n_BDE_y__BDE_theta = by_q_BDE_y_BDE_theta*(eta * eta);
    const double n_BDE_theta__BDE_x = by_q_BDE_theta_BDE_x*(eta * eta);
    const double n_BDE_theta__BDE_y = by_q_BDE_theta_BDE_y*(eta * eta);
    const double n_BDE_theta__BDE_theta = BDE_inertia + by_q_BDE_theta_BDE_theta*(eta * eta);
    const double n_EG_theta__EG_theta = EG_inertia + by_q_EG_theta_EG_theta*(eta * eta);
    const double n_AG_theta__AG_theta = AG_inertia + by_q_AG_theta_AG_theta*(eta * eta);
    const double n_HE_theta__HE_theta = HE_inertia + by_q_HE_theta_HE_theta*(eta * eta);
    const double n_AH_theta__AH_theta = AH_inertia + by_q_AH_theta_AH_theta*(eta * eta);
    const double n_O_x__OF_theta = eta_row*(by_q_O_x_OF_theta*eta + by_v_O_x_OF_theta) + phi_O_x_OF_theta;
    const double n_O_y__OF_theta = eta_row*(by_q_O_y_OF_theta*eta + by_v_O_y_OF_theta) + phi_O_y_OF_theta;
    const double n_B_x__BDE_theta = eta_row*(by_q_B_x_BDE_theta*eta + by_v_B_x_BDE_theta) + phi_B_x_BDE_theta;
    const double n_B_y__BDE_theta = eta_row*(by_q_B_y_BDE_theta*eta + by_v_B_y_BDE_theta) + phi_B_y_BDE_theta;
    const double n_A5_x__AG_theta = eta_row*(by_q_A5_x_AG_theta*eta + by_v_A5_x_AG_theta) + phi_A5_x_AG_theta;
    const double n_A5_y__AG_theta = eta_row*(by_q_A5_y_AG_theta*eta + by_v_A5_y_AG_theta) + phi_A5_y_AG_theta;
    const double n_A7_x__AH_theta = eta_row*(by_q_A7_x_AH_theta*eta + by_v_A7_x_AH_theta) + phi_A7_x_AH_theta;
    const double n_A7_y__AH_theta = eta_row*(by_q_A7_y_AH_theta*eta + by_v_A7_y_AH_theta) + phi_A7_y_AH_theta;
    const double n_F_x__OF_theta = eta_row*(by_q_F_x_OF_theta*eta + by_v_F_x_OF_theta) + phi_F_x_OF_theta;
    const double n_F_x__FE_theta = eta_row*(by_q_F_x_FE_theta*eta + by_v_F_x_FE_theta) + phi_F_x_FE_theta;
    const double n_F_y__OF_theta = eta_row*(by_q_F_y_OF_theta*eta + by_v_F_y_OF_theta) + phi_F_y_OF_theta;
    const double n_F_y__FE_theta = eta_row*(by_q_F_y_FE_theta*eta + by_v_F_y_FE_theta) + phi_F_y_FE_theta;
    const double n_E3_x__FE_theta = eta_row*(by_q_E3_x_FE_theta*eta + by_v_E3_x_FE_theta) + phi_E3_x_FE_theta;
    const double n_E3_x__BDE_theta = eta_row*(by_q_E3_x_BDE_theta*eta + by_v_E3_x_BDE_theta) +
        phi_E3_x_BDE_theta;
    const double n_E3_y__FE_theta = eta_row*(by_q_E3_y_FE_theta*eta + by_v_E3_y_FE_theta) + phi_E3_y_FE_theta;
    const double n_E3_y__BDE_theta = eta_row*(by_q_E3_y_BDE_theta*eta + by_v_E3_y_BDE_theta) +
        phi_E3_y_BDE_theta;
    const double n_E4_x__FE_theta = eta_row*(by_q_E3_x_FE_theta*eta + by_v_E3_x_FE_theta) + phi_E3_x_FE_theta;
    const double n_E4_x__EG_theta = eta_row*(by_q_E4_x_EG_theta*eta + by_v_E4_x_EG_theta) + phi_E4_x_EG_theta;
    const double n_E4_y__FE_theta = eta_row*(by_q_E3_y_FE_theta*eta + by_v_E3_y_FE_theta) + phi_E3_y_FE_theta;
    const double n_E4_y__EG_theta = eta_row*(by_q_E4_y_EG_theta*eta + by_v_E4_y_EG_theta) + phi_E4_y_EG_theta;
    const double n_E6_x__FE_theta = eta_row*(by_q_E3_x_FE_theta*eta + by_v_E3_x_FE_theta) + phi_E3_x_FE_theta;
    const double n_E6_x__HE_theta = eta_row*(by_q_E6_x_HE_theta*eta + by_v_E6_x_HE_theta) + phi_E6_x_HE_theta;
    const double n_E6_y__FE_theta = eta_row*(by_q_E3_y_FE_theta*eta + by_v_E3_y_FE_theta) + phi_E3_y_FE_theta;
    const double n_E6_y__HE_theta = eta_row*(by_q_E6_y_HE_theta*eta + by_v_E6_y_HE_theta) + phi_E6_y_HE_theta;
    const double n_G_x__EG_theta = eta_row*(by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta) + phi_G_x_EG_theta;
    const double n_G_x__AG_theta = eta_row*(by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta) + phi_G_x_AG_theta;
    const double n_G_y__EG_theta = eta_row*(by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta) + phi_G_y_EG_theta;
    const double n_G_y__AG_theta = eta_row*(by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta) + phi_G_y_AG_theta;
    const double n_H_x__HE_theta = eta_row*(by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta) + phi_H_x_HE_theta;
    const double n_H_x__AH_theta = eta_row*(by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta) + phi_H_x_AH_theta;
    const double n_H_y__HE_theta = eta_row*(by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta) + phi_H_y_HE_theta;
    const double n_H_y__AH_theta = eta_row*(by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta) + phi_H_y_AH_theta;

    /* L U */
    const double scale_OF_theta = n_OF_theta__OF_theta;
    if (!(fabs(scale_OF_theta) > 1e-13 * fabs(n_OF_theta__OF_theta)))
        return 3;
    const double inverse_pivot_OF_theta = 1.0/scale_OF_theta;
    lin->lu[0] = inverse_pivot_OF_theta;
    const double l_O_x__OF_theta_2 = inverse_pivot_OF_theta*n_O_x__OF_theta;
    lin->lu[1] = l_O_x__OF_theta_2;
    const double l_O_y__OF_theta_2 = inverse_pivot_OF_theta*n_O_y__OF_theta;
    lin->lu[2] = l_O_y__OF_theta_2;
    const double l_F_x__OF_theta_2 = inverse_pivot_OF_theta*n_F_x__OF_theta;
    lin->lu[3] = l_F_x__OF_theta_2;
    const double l_F_y__OF_theta_2 = inverse_pivot_OF_theta*n_F_y__OF_theta;
    lin->lu[4] = l_F_y__OF_theta_2;
    const double scale_O_x_2 = -inverse_OF_mass - l_O_x__OF_theta_2*phi_O_x_OF_theta;
    if (!(fabs(scale_O_x_2) > 1e-08 * fabs(scale_O_x_2)))
        return 22;
    const double inverse_pivot_O_x_2 = 1.0/scale_O_x_2;
    lin->lu[5] = inverse_pivot_O_x_2;
    const double l_O_y__O_x_2 = -inverse_pivot_O_x_2*l_O_y__OF_theta_2*phi_O_x_OF_theta;
    lin->lu[6] = l_O_y__O_x_2;
    const double u_O_x__O_y = -l_O_x__OF_theta_2*phi_O_y_OF_theta;
    lin->lu[7] = u_O_x__O_y;
    const double l_F_x__O_x_2 = inverse_pivot_O_x_2*(inverse_OF_mass - l_F_x__OF_theta_2*phi_O_x_OF_theta);
    lin->lu[8] = l_F_x__O_x_2;
    const double u_O_x__F_x = inverse_OF_mass - l_O_x__OF_theta_2*phi_F_x_OF_theta;
    lin->lu[9] = u_O_x__F_x;
    const double l_F_y__O_x_2 = -inverse_pivot_O_x_2*l_F_y__OF_theta_2*phi_O_x_OF_theta;
    lin->lu[10] = l_F_y__O_x_2;
    const double u_O_x__F_y = -l_O_x__OF_theta_2*phi_F_y_OF_theta;
    lin->lu[11] = u_O_x__F_y;
    const double scale_O_y_2 = -inverse_OF_mass - l_O_y__OF_theta_2*phi_O_y_OF_theta;
    const double pivot_O_y_2 = -l_O_y__O_x_2*u_O_x__O_y + scale_O_y_2;
    if (!(fabs(pivot_O_y_2) > 1e-08 * fabs(scale_O_y_2)))
        return 23;
    const double inverse_pivot_O_y_2 = 1.0/pivot_O_y_2;
    lin->lu[12] = inverse_pivot_O_y_2;
    const double l_F_x__O_y_2 = inverse_pivot_O_y_2*(-l_F_x__OF_theta_2*phi_O_y_OF_theta -
        l_F_x__O_x_2*u_O_x__O_y);
    lin->lu[13] = l_F_x__O_y_2;
    const double u_O_y__F_x = -l_O_y__OF_theta_2*phi_F_x_OF_theta - l_O_y__O_x_2*u_O_x__F_x;
    lin->lu[14] = u_O_y__F_x;
    const double l_F_y__O_y_2 = inverse_pivot_O_y_2*(inverse_OF_mass - l_F_y__OF_theta_2*phi_O_y_OF_theta -
        l_F_y__O_x_2*u_O_x__O_y);
    lin->lu[15] = l_F_y__O_y_2;
    const double u_O_y__F_y = inverse_OF_mass - l_O_y__OF_theta_2*phi_F_y_OF_theta - l_O_y__O_x_2*u_O_x__F_y;
    lin->lu[16] = u_O_y__F_y;
    const double scale_BDE_x = n_BDE_x__BDE_x;
    if (!(fabs(scale_BDE_x) > 1e-13 * fabs(n_BDE_x__BDE_x)))
        return 7;
    const double inverse_pivot_BDE_x = 1.0/scale_BDE_x;
    lin->lu[17] = inverse_pivot_BDE_x;
    const double l_BDE_y__BDE_x = inverse_pivot_BDE_x*n_BDE_y__BDE_x;
    lin->lu[18] = l_BDE_y__BDE_x;
    lin->lu[19] = n_BDE_x__BDE_y;
    const double l_BDE_theta__BDE_x = inverse_pivot_BDE_x*n_BDE_theta__BDE_x;
    lin->lu[20] = l_BDE_theta__BDE_x;
    lin->lu[21] = n_BDE_x__BDE_theta;
    const double scale_EG_theta = n_EG_theta__EG_theta;
    if (!(fabs(scale_EG_theta) > 1e-13 * fabs(n_EG_theta__EG_theta)))
        return 12;
    const double inverse_pivot_EG_theta = 1.0/scale_EG_theta;
    lin->lu[22] = inverse_pivot_EG_theta;
    const double l_G_x__EG_theta_2 = inverse_pivot_EG_theta*n_G_x__EG_theta;
    lin->lu[23] = l_G_x__EG_theta_2;
    const double l_G_y__EG_theta_2 = inverse_pivot_EG_theta*n_G_y__EG_theta;
    lin->lu[24] = l_G_y__EG_theta_2;
    const double l_E4_x__EG_theta_2 = inverse_pivot_EG_theta*n_E4_x__EG_theta;
    lin->lu[25] = l_E4_x__EG_theta_2;
    const double l_E4_y__EG_theta_2 = inverse_pivot_EG_theta*n_E4_y__EG_theta;
    lin->lu[26] = l_E4_y__EG_theta_2;
    const double scale_AG_theta = n_AG_theta__AG_theta;
    if (!(fabs(scale_AG_theta) > 1e-13 * fabs(n_AG_theta__AG_theta)))
        return 15;
    const double inverse_pivot_AG_theta = 1.0/scale_AG_theta;
    lin->lu[27] = inverse_pivot_AG_theta;
    const double l_A5_x__AG_theta_2 = inverse_pivot_AG_theta*n_A5_x__AG_theta;
    lin->lu[28] = l_A5_x__AG_theta_2;
    const double l_A5_y__AG_theta_2 = inverse_pivot_AG_theta*n_A5_y__AG_theta;
    lin->lu[29] = l_A5_y__AG_theta_2;
    const double l_G_x__AG_theta_2 = inverse_pivot_AG_theta*n_G_x__AG_theta;
    lin->lu[30] = l_G_x__AG_theta_2;
    const double l_G_y__AG_theta_2 = inverse_pivot_AG_theta*n_G_y__AG_theta;
    lin->lu[31] = l_G_y__AG_theta_2;
    const double scale_A5_x_2 = -inverse_AG_mass - l_A5_x__AG_theta_2*phi_A5_x_AG_theta;
    if (!(fabs(scale_A5_x_2) > 1e-08 * fabs(scale_A5_x_2)))
        return 26;
    const double inverse_pivot_A5_x_2 = 1.0/scale_A5_x_2;
    lin->lu[32] = inverse_pivot_A5_x_2;
    const double l_A5_y__A5_x_2 = -inverse_pivot_A5_x_2*l_A5_y__AG_theta_2*phi_A5_x_AG_theta;
    lin->lu[33] = l_A5_y__A5_x_2;
    const double u_A5_x__A5_y = -l_A5_x__AG_theta_2*phi_A5_y_AG_theta;
    lin->lu[34] = u_A5_x__A5_y;
    const double l_G_x__A5_x_2 = inverse_pivot_A5_x_2*(-inverse_AG_mass -
        l_G_x__AG_theta_2*phi_A5_x_AG_theta);
    lin->lu[35] = l_G_x__A5_x_2;
    const double u_A5_x__G_x = -inverse_AG_mass - l_A5_x__AG_theta_2*phi_G_x_AG_theta;
    lin->lu[36] = u_A5_x__G_x;
    const double l_G_y__A5_x_2 = -inverse_pivot_A5_x_2*l_G_y__AG_theta_2*phi_A5_x_AG_theta;
    lin->lu[37] = l_G_y__A5_x_2;
    const double u_A5_x__G_y = -l_A5_x__AG_theta_2*phi_G_y_AG_theta;
    lin->lu[38] = u_A5_x__G_y;
    const double scale_A5_y_2 = -inverse_AG_mass - l_A5_y__AG_theta_2*phi_A5_y_AG_theta;
    const double pivot_A5_y_2 = -l_A5_y__A5_x_2*u_A5_x__A5_y + scale_A5_y_2;
    if (!(fabs(pivot_A5_y_2) > 1e-08 * fabs(scale_A5_y_2)))
        return 27;
    const double inverse_pivot_A5_y_2 = 1.0/pivot_A5_y_2;
    lin->lu[39] = inverse_pivot_A5_y_2;
    const double l_G_x__A5_y_2 = inverse_pivot_A5_y_2*(-l_G_x__A5_x_2*u_A5_x__A5_y -
        l_G_x__AG_theta_2*phi_A5_y_AG_theta);
    lin->lu[40] = l_G_x__A5_y_2;
    const double u_A5_y__G_x = -l_A5_y__A5_x_2*u_A5_x__G_x - l_A5_y__AG_theta_2*phi_G_x_AG_theta;
    lin->lu[41] = u_A5_y__G_x;
    const double l_G_y__A5_y_2 = inverse_pivot_A5_y_2*(-inverse_AG_mass - l_G_y__A5_x_2*u_A5_x__A5_y -
        l_G_y__AG_theta_2*phi_A5_y_AG_theta);
    lin->lu[42] = l_G_y__A5_y_2;
    const double u_A5_y__G_y = -inverse_AG_mass - l_A5_y__A5_x_2*u_A5_x__G_y -
        l_A5_y__AG_theta_2*phi_G_y_AG_theta;
    lin->lu[43] = u_A5_y__G_y;
    const double scale_G_x_2 = -inverse_AG_mass - inverse_EG_mass - l_G_x__AG_theta_2*phi_G_x_AG_theta -
        l_G_x__EG_theta_2*phi_G_x_EG_theta;
    const double pivot_G_x_2 = -l_G_x__A5_x_2*u_A5_x__G_x - l_G_x__A5_y_2*u_A5_y__G_x + scale_G_x_2;
    if (!(fabs(pivot_G_x_2) > 1e-08 * fabs(scale_G_x_2)))
        return 38;
    const double inverse_pivot_G_x_2 = 1.0/pivot_G_x_2;
    lin->lu[44] = inverse_pivot_G_x_2;
    const double l_G_y__G_x_2 = inverse_pivot_G_x_2*(-l_G_y__A5_x_2*u_A5_x__G_x - l_G_y__A5_y_2*u_A5_y__G_x -
        l_G_y__AG_theta_2*phi_G_x_AG_theta - l_G_y__EG_theta_2*phi_G_x_EG_theta);
    lin->lu[45] = l_G_y__G_x_2;
    const double u_G_x__G_y = -l_G_x__A5_x_2*u_A5_x__G_y - l_G_x__A5_y_2*u_A5_y__G_y -
        l_G_x__AG_theta_2*phi_G_y_AG_theta - l_G_x__EG_theta_2*phi_G_y_EG_theta;
    lin->lu[46] = u_G_x__G_y;
    const double l_E4_x__G_x_2 = inverse_pivot_G_x_2*(inverse_EG_mass - l_E4_x__EG_theta_2*phi_G_x_EG_theta);
    lin->lu[47] = l_E4_x__G_x_2;
    const double u_G_x__E4_x = inverse_EG_mass - l_G_x__EG_theta_2*phi_E4_x_EG_theta;
    lin->lu[48] = u_G_x__E4_x;
    const double l_E4_y__G_x_2 = -inverse_pivot_G_x_2*l_E4_y__EG_theta_2*phi_G_x_EG_theta;
    lin->lu[49] = l_E4_y__G_x_2;
    const double u_G_x__E4_y = -l_G_x__EG_theta_2*phi_E4_y_EG_theta;
    lin->lu[50] = u_G_x__E4_y;
    const double scale_G_y_2 = -inverse_AG_mass - inverse_EG_mass - l_G_y__AG_theta_2*phi_G_y_AG_theta -
        l_G_y__EG_theta_2*phi_G_y_EG_theta;
    const double pivot_G_y_2 = -l_G_y__A5_x_2*u_A5_x__G_y - l_G_y__A5_y_2*u_A5_y__G_y -
        l_G_y__G_x_2*u_G_x__G_y + scale_G_y_2;
    if (!(fabs(pivot_G_y_2) > 1e-08 * fabs(scale_G_y_2)))
        return 39;
    const double inverse_pivot_G_y_2 = 1.0/pivot_G_y_2;
    lin->lu[51] = inverse_pivot_G_y_2;
    const double l_E4_x__G_y_2 = inverse_pivot_G_y_2*(-l_E4_x__EG_theta_2*phi_G_y_EG_theta -
        l_E4_x__G_x_2*u_G_x__G_y);
    lin->lu[52] = l_E4_x__G_y_2;
    const double u_G_y__E4_x = -l_G_y__EG_theta_2*phi_E4_x_EG_theta - l_G_y__G_x_2*u_G_x__E4_x;
    lin->lu[53] = u_G_y__E4_x;
    const double l_E4_y__G_y_2 = inverse_pivot_G_y_2*(inverse_EG_mass - l_E4_y__EG_theta_2*phi_G_y_EG_theta -
        l_E4_y__G_x_2*u_G_x__G_y);
    lin->lu[54] = l_E4_y__G_y_2;
    const double u_G_y__E4_y = inverse_EG_mass - l_G_y__EG_theta_2*phi_E4_y_EG_theta -
        l_G_y__G_x_2*u_G_x__E4_y;
    lin->lu[55] = u_G_y__E4_y;
    const double scale_HE_theta = n_HE_theta__HE_theta;
    if (!(fabs(scale_HE_theta) > 1e-13 * fabs(n_HE_theta__HE_theta)))
        return 18;
    const double inverse_pivot_HE_theta = 1.0/scale_HE_theta;
    lin->lu[56] = inverse_pivot_HE_theta;
    const double l_H_x__HE_theta_2 = inverse_pivot_HE_theta*n_H_x__HE_theta;
    lin->lu[57] = l_H_x__HE_theta_2;
    const double l_H_y__HE_theta_2 = inverse_pivot_HE_theta*n_H_y__HE_theta;
    lin->lu[58] = l_H_y__HE_theta_2;
    const double l_E6_x__HE_theta_2 = inverse_pivot_HE_theta*n_E6_x__HE_theta;
    lin->lu[59] = l_E6_x__HE_theta_2;
    const double l_E6_y__HE_theta_2 = inverse_pivot_HE_theta*n_E6_y__HE_theta;
    lin->lu[60] = l_E6_y__HE_theta_2;
    const double scale_AH_theta = n_AH_theta__AH_theta;
    if (!(fabs(scale_AH_theta) > 1e-13 * fabs(n_AH_theta__AH_theta)))
        return 21;
    const double inverse_pivot_AH_theta = 1.0/scale_AH_theta;
    lin->lu[61] = inverse_pivot_AH_theta;
    const double l_A7_x__AH_theta_2 = inverse_pivot_AH_theta*n_A7_x__AH_theta;
    lin->lu[62] = l_A7_x__AH_theta_2;
    const double l_A7_y__AH_theta_2 = inverse_pivot_AH_theta*n_A7_y__AH_theta;
    lin->lu[63] = l_A7_y__AH_theta_2;
    const double l_H_x__AH_theta_2 = inverse_pivot_AH_theta*n_H_x__AH_theta;
    lin->lu[64] = l_H_x__AH_theta_2;
    const double l_H_y__AH_theta_2 = inverse_pivot_AH_theta*n_H_y__AH_theta;
    lin->lu[65] = l_H_y__AH_theta_2;
    const double scale_A7_x_2 = -inverse_AH_mass - l_A7_x__AH_theta_2*phi_A7_x_AH_theta;
    if (!(fabs(scale_A7_x_2) > 1e-08 * fabs(scale_A7_x_2)))
        return 28;
    const double inverse_pivot_A7_x_2 = 1.0/scale_A7_x_2;
    lin->lu[66] = inverse_pivot_A7_x_2;
    const double l_A7_y__A7_x_2 = -inverse_pivot_A7_x_2*l_A7_y__AH_theta_2*phi_A7_x_AH_theta;
    lin->lu[67] = l_A7_y__A7_x_2;
    const double u_A7_x__A7_y = -l_A7_x__AH_theta_2*phi_A7_y_AH_theta;
    lin->lu[68] = u_A7_x__A7_y;
    const double l_H_x__A7_x_2 = inverse_pivot_A7_x_2*(-inverse_AH_mass -
        l_H_x__AH_theta_2*phi_A7_x_AH_theta);
    lin->lu[69] = l_H_x__A7_x_2;
    const double u_A7_x__H_x = -inverse_AH_mass - l_A7_x__AH_theta_2*phi_H_x_AH_theta;
    lin->lu[70] = u_A7_x__H_x;
    const double l_H_y__A7_x_2 = -inverse_pivot_A7_x_2*l_H_y__AH_theta_2*phi_A7_x_AH_theta;
    lin->lu[71] = l_H_y__A7_x_2;
    const double u_A7_x__H_y = -l_A7_x__AH_theta_2*phi_H_y_AH_theta;
    lin->lu[72] = u_A7_x__H_y;
    const double scale_A7_y_2 = -inverse_AH_mass - l_A7_y__AH_theta_2*phi_A7_y_AH_theta;
    const double pivot_A7_y_2 = -l_A7_y__A7_x_2*u_A7_x__A7_y + scale_A7_y_2;
    if (!(fabs(pivot_A7_y_2) > 1e-08 * fabs(scale_A7_y_2)))
        return 29;
    const double inverse_pivot_A7_y_2 = 1.0/pivot_A7_y_2;
    lin->lu[73] = inverse_pivot_A7_y_2;
    const double l_H_x__A7_y_2 = inverse_pivot_A7_y_2*(-l_H_x__A7_x_2*u_A7_x__A7_y -
        l_H_x__AH_theta_2*phi_A7_y_AH_theta);
    lin->lu[74] = l_H_x__A7_y_2;
    const double u_A7_y__H_x = -l_A7_y__A7_x_2*u_A7_x__H_x - l_A7_y__AH_theta_2*phi_H_x_AH_theta;
    lin->lu[75] = u_A7_y__H_x;
    const double l_H_y__A7_y_2 = inverse_pivot_A7_y_2*(-inverse_AH_mass - l_H_y__A7_x_2*u_A7_x__A7_y -
        l_H_y__AH_theta_2*phi_A7_y_AH_theta);
    lin->lu[76] = l_H_y__A7_y_2;
    const double u_A7_y__H_y = -inverse_AH_mass - l_A7_y__A7_x_2*u_A7_x__H_y -
        l_A7_y__AH_theta_2*phi_H_y_AH_theta;
    lin->lu[77] = u_A7_y__H_y;
    const double scale_H_x_2 = -inverse_AH_mass - inverse_HE_mass - l_H_x__AH_theta_2*phi_H_x_AH_theta -
        l_H_x__HE_theta_2*phi_H_x_HE_theta;
    const double pivot_H_x_2 = -l_H_x__A7_x_2*u_A7_x__H_x - l_H_x__A7_y_2*u_A7_y__H_x + scale_H_x_2;
    if (!(fabs(pivot_H_x_2) > 1e-08 * fabs(scale_H_x_2)))
        return 40;
    const double inverse_pivot_H_x_2 = 1.0/pivot_H_x_2;
    lin->lu[78] = inverse_pivot_H_x_2;
    const double l_H_y__H_x_2 = inverse_pivot_H_x_2*(-l_H_y__A7_x_2*u_A7_x__H_x - l_H_y__A7_y_2*u_A7_y__H_x -
        l_H_y__AH_theta_2*phi_H_x_AH_theta - l_H_y__HE_theta_2*phi_H_x_HE_theta);
    lin->lu[79] = l_H_y__H_x_2;
    const double u_H_x__H_y = -l_H_x__A7_x_2*u_A7_x__H_y - l_H_x__A7_y_2*u_A7_y__H_y -
        l_H_x__AH_theta_2*phi_H_y_AH_theta - l_H_x__HE_theta_2*phi_H_y_HE_theta;
    lin->lu[80] = u_H_x__H_y;
    const double l_E6_x__H_x_2 = inverse_pivot_H_x_2*(inverse_HE_mass - l_E6_x__HE_theta_2*phi_H_x_HE_theta);
    lin->lu[81] = l_E6_x__H_x_2;
    const double u_H_x__E6_x = inverse_HE_mass - l_H_x__HE_theta_2*phi_E6_x_HE_theta;
    lin->lu[82] = u_H_x__E6_x;
    const double l_E6_y__H_x_2 = -inverse_pivot_H_x_2*l_E6_y__HE_theta_2*phi_H_x_HE_theta;
    lin->lu[83] = l_E6_y__H_x_2;
    const double u_H_x__E6_y = -l_H_x__HE_theta_2*phi_E6_y_HE_theta;
    lin->lu[84] = u_H_x__E6_y;
    const double scale_H_y_2 = -inverse_AH_mass - inverse_HE_mass - l_H_y__AH_theta_2*phi_H_y_AH_theta -
        l_H_y__HE_theta_2*phi_H_y_HE_theta;
    const double pivot_H_y_2 = -l_H_y__A7_x_2*u_A7_x__H_y - l_H_y__A7_y_2*u_A7_y__H_y -
        l_H_y__H_x_2*u_H_x__H_y + scale_H_y_2;
    if (!(fabs(pivot_H_y_2) > 1e-08 * fabs(scale_H_y_2)))
        return 41;
    const double inverse_pivot_H_y_2 = 1.0/pivot_H_y_2;
    lin->lu[85] = inverse_pivot_H_y_2;
    const double l_E6_x__H_y_2 = inverse_pivot_H_y_2*(-l_E6_x__HE_theta_2*phi_H_y_HE_theta -
        l_E6_x__H_x_2*u_H_x__H_y);
    lin->lu[86] = l_E6_x__H_y_2;
    const double u_H_y__E6_x = -l_H_y__HE_theta_2*phi_E6_x_HE_theta - l_H_y__H_x_2*u_H_x__E6_x;
    lin->lu[87] = u_H_y__E6_x;
    const double l_E6_y__H_y_2 = inverse_pivot_H_y_2*(inverse_HE_mass - l_E6_y__HE_theta_2*phi_H_y_HE_theta -
        l_E6_y__H_x_2*u_H_x__H_y);
    lin->lu[88] = l_E6_y__H_y_2;
    const double u_H_y__E6_y = inverse_HE_mass - l_H_y__HE_theta_2*phi_E6_y_HE_theta -
        l_H_y__H_x_2*u_H_x__E6_y;
    lin->lu[89] = u_H_y__E6_y;
    const double scale_BDE_y = -l_BDE_y__BDE_x*n_BDE_x__BDE_y + n_BDE_y__BDE_y;
    if (!(fabs(scale_BDE_y) > 1e-13 * fabs(n_BDE_y__BDE_y)))
        return 8;
    const double inverse_pivot_BDE_y = 1.0/scale_BDE_y;
    lin->lu[90] = inverse_pivot_BDE_y;
    const double l_BDE_theta__BDE_y = inverse_pivot_BDE_y*(-l_BDE_theta__BDE_x*n_BDE_x__BDE_y +
        n_BDE_theta__BDE_y);
    lin->lu[91] = l_BDE_theta__BDE_y;
    const double u_BDE_y__BDE_theta = -l_BDE_y__BDE_x*n_BDE_x__BDE_theta + n_BDE_y__BDE_theta;
    lin->lu[92] = u_BDE_y__BDE_theta;
    const double l_B_x__BDE_y = inverse_pivot_BDE_x*inverse_pivot_BDE_y*n_BDE_x__BDE_y;
    lin->lu[93] = l_B_x__BDE_y;
    const double l_E3_x__BDE_y = inverse_pivot_BDE_x*inverse_pivot_BDE_y*n_BDE_x__BDE_y;
    lin->lu[94] = l_E3_x__BDE_y;
    const double scale_BDE_theta = -l_BDE_theta__BDE_x*n_BDE_x__BDE_theta -
        l_BDE_theta__BDE_y*u_BDE_y__BDE_theta + n_BDE_theta__BDE_theta;
    if (!(fabs(scale_BDE_theta) > 1e-13 * fabs(n_BDE_theta__BDE_theta)))
        return 9;
    const double inverse_pivot_BDE_theta = 1.0/scale_BDE_theta;
    lin->lu[95] = inverse_pivot_BDE_theta;
    const double l_B_x__BDE_theta_2 = inverse_pivot_BDE_theta*(inverse_pivot_BDE_x*n_BDE_x__BDE_theta -
        l_B_x__BDE_y*u_BDE_y__BDE_theta + n_B_x__BDE_theta);
    lin->lu[96] = l_B_x__BDE_theta_2;
    const double u_BDE_theta__B_x = l_BDE_theta__BDE_x - l_BDE_theta__BDE_y*l_BDE_y__BDE_x +
        phi_B_x_BDE_theta;
    lin->lu[97] = u_BDE_theta__B_x;
    const double l_B_y__BDE_theta_2 = inverse_pivot_BDE_theta*(inverse_pivot_BDE_y*u_BDE_y__BDE_theta +
        n_B_y__BDE_theta);
    lin->lu[98] = l_B_y__BDE_theta_2;
    const double u_BDE_theta__B_y = l_BDE_theta__BDE_y + phi_B_y_BDE_theta;
    lin->lu[99] = u_BDE_theta__B_y;
    const double l_E3_x__BDE_theta_2 = inverse_pivot_BDE_theta*(inverse_pivot_BDE_x*n_BDE_x__BDE_theta -
        l_E3_x__BDE_y*u_BDE_y__BDE_theta + n_E3_x__BDE_theta);
    lin->lu[100] = l_E3_x__BDE_theta_2;
    const double u_BDE_theta__E3_x = l_BDE_theta__BDE_x - l_BDE_theta__BDE_y*l_BDE_y__BDE_x +
        phi_E3_x_BDE_theta;
    lin->lu[101] = u_BDE_theta__E3_x;
    const double l_E3_y__BDE_theta_2 = inverse_pivot_BDE_theta*(inverse_pivot_BDE_y*u_BDE_y__BDE_theta +
        n_E3_y__BDE_theta);
    lin->lu[102] = l_E3_y__BDE_theta_2;
    const double u_BDE_theta__E3_y = l_BDE_theta__BDE_y + phi_E3_y_BDE_theta;
    lin->lu[103] = u_BDE_theta__E3_y;
    const double scale_B_x_2 = -inverse_pivot_BDE_x - l_BDE_y__BDE_x*l_B_x__BDE_y -
        l_B_x__BDE_theta_2*u_BDE_theta__B_x;
    if (!(fabs(scale_B_x_2) > 1e-08 * fabs(scale_B_x_2)))
        return 24;
    const double inverse_pivot_B_x_2 = 1.0/scale_B_x_2;
    lin->lu[104] = inverse_pivot_B_x_2;
    const double l_B_y__B_x_2 = inverse_pivot_B_x_2*(inverse_pivot_BDE_y*l_BDE_y__BDE_x -
        l_B_y__BDE_theta_2*u_BDE_theta__B_x);
    lin->lu[105] = l_B_y__B_x_2;
    const double u_B_x__B_y = -l_B_x__BDE_theta_2*u_BDE_theta__B_y + l_B_x__BDE_y;
    lin->lu[106] = u_B_x__B_y;
    const double l_E3_x__B_x_2 = inverse_pivot_B_x_2*(-inverse_pivot_BDE_x - l_BDE_y__BDE_x*l_E3_x__BDE_y -
        l_E3_x__BDE_theta_2*u_BDE_theta__B_x);
    lin->lu[107] = l_E3_x__B_x_2;
    const double u_B_x__E3_x = -inverse_pivot_BDE_x - l_BDE_y__BDE_x*l_B_x__BDE_y -
        l_B_x__BDE_theta_2*u_BDE_theta__E3_x;
    lin->lu[108] = u_B_x__E3_x;
    const double l_E3_y__B_x_2 = inverse_pivot_B_x_2*(inverse_pivot_BDE_y*l_BDE_y__BDE_x -
        l_E3_y__BDE_theta_2*u_BDE_theta__B_x);
    lin->lu[109] = l_E3_y__B_x_2;
    const double u_B_x__E3_y = -l_B_x__BDE_theta_2*u_BDE_theta__E3_y + l_B_x__BDE_y;
    lin->lu[110] = u_B_x__E3_y;
    const double scale_B_y_2 = -inverse_pivot_BDE_y - l_B_y__BDE_theta_2*u_BDE_theta__B_y;
    const double pivot_B_y_2 = -l_B_y__B_x_2*u_B_x__B_y + scale_B_y_2;
    if (!(fabs(pivot_B_y_2) > 1e-08 * fabs(scale_B_y_2)))
        return 25;
    const double inverse_pivot_B_y_2 = 1.0/pivot_B_y_2;
    lin->lu[111] = inverse_pivot_B_y_2;
    const double l_E3_x__B_y_2 = inverse_pivot_B_y_2*(-l_E3_x__BDE_theta_2*u_BDE_theta__B_y + l_E3_x__BDE_y -
        l_E3_x__B_x_2*u_B_x__B_y);
    lin->lu[112] = l_E3_x__B_y_2;
    const double u_B_y__E3_x = inverse_pivot_BDE_y*l_BDE_y__BDE_x - l_B_y__BDE_theta_2*u_BDE_theta__E3_x -
        l_B_y__B_x_2*u_B_x__E3_x;
    lin->lu[113] = u_B_y__E3_x;
    const double l_E3_y__B_y_2 = inverse_pivot_B_y_2*(-inverse_pivot_BDE_y -
        l_E3_y__BDE_theta_2*u_BDE_theta__B_y - l_E3_y__B_x_2*u_B_x__B_y);
    lin->lu[114] = l_E3_y__B_y_2;
    const double u_B_y__E3_y = -inverse_pivot_BDE_y - l_B_y__BDE_theta_2*u_BDE_theta__E3_y -
        l_B_y__B_x_2*u_B_x__E3_y;
    lin->lu[115] = u_B_y__E3_y;
    const double scale_FE_theta = n_FE_theta__FE_theta;
    if (!(fabs(scale_FE_theta) > 1e-13 * fabs(n_FE_theta__FE_theta)))
        return 6;
    const double inverse_pivot_FE_theta = 1.0/scale_FE_theta;
    lin->lu[116] = inverse_pivot_FE_theta;
    const double l_F_x__FE_theta_2 = inverse_pivot_FE_theta*n_F_x__FE_theta;
    lin->lu[117] = l_F_x__FE_theta_2;
    const double l_F_y__FE_theta_2 = inverse_pivot_FE_theta*n_F_y__FE_theta;
    lin->lu[118] = l_F_y__FE_theta_2;
    const double l_E3_x__FE_theta_2 = inverse_pivot_FE_theta*n_E3_x__FE_theta;
    lin->lu[119] = l_E3_x__FE_theta_2;
    const double l_E3_y__FE_theta_2 = inverse_pivot_FE_theta*n_E3_y__FE_theta;
    lin->lu[120] = l_E3_y__FE_theta_2;
    const double l_E4_x__FE_theta_2 = inverse_pivot_FE_theta*n_E4_x__FE_theta;
    lin->lu[121] = l_E4_x__FE_theta_2;
    const double l_E4_y__FE_theta_2 = inverse_pivot_FE_theta*n_E4_y__FE_theta;
    lin->lu[122] = l_E4_y__FE_theta_2;
    const double l_E6_x__FE_theta_2 = inverse_pivot_FE_theta*n_E6_x__FE_theta;
    lin->lu[123] = l_E6_x__FE_theta_2;
    const double l_E6_y__FE_theta_2 = inverse_pivot_FE_theta*n_E6_y__FE_theta;
    lin->lu[124] = l_E6_y__FE_theta_2;
    const double scale_F_x_2 = -inverse_FE_mass - inverse_OF_mass - l_F_x__FE_theta_2*phi_F_x_FE_theta -
        l_F_x__OF_theta_2*phi_F_x_OF_theta;
    const double pivot_F_x_2 = -l_F_x__O_x_2*u_O_x__F_x - l_F_x__O_y_2*u_O_y__F_x + scale_F_x_2;
    if (!(fabs(pivot_F_x_2) > 1e-08 * fabs(scale_F_x_2)))
        return 30;
    const double inverse_pivot_F_x_2 = 1.0/pivot_F_x_2;
    lin->lu[125] = inverse_pivot_F_x_2;
    const double l_F_y__F_x_2 = inverse_pivot_F_x_2*(-l_F_y__FE_theta_2*phi_F_x_FE_theta -
        l_F_y__OF_theta_2*phi_F_x_OF_theta - l_F_y__O_x_2*u_O_x__F_x - l_F_y__O_y_2*u_O_y__F_x);
    lin->lu[126] = l_F_y__F_x_2;
    const double u_F_x__F_y = -l_F_x__FE_theta_2*phi_F_y_FE_theta - l_F_x__OF_theta_2*phi_F_y_OF_theta -
        l_F_x__O_x_2*u_O_x__F_y - l_F_x__O_y_2*u_O_y__F_y;
    lin->lu[127] = u_F_x__F_y;
    const double l_E3_x__F_x_2 = inverse_pivot_F_x_2*(inverse_FE_mass - l_E3_x__FE_theta_2*phi_F_x_FE_theta);
    lin->lu[128] = l_E3_x__F_x_2;
    const double u_F_x__E3_x = inverse_FE_mass - l_F_x__FE_theta_2*phi_E3_x_FE_theta;
    lin->lu[129] = u_F_x__E3_x;
    const double l_E3_y__F_x_2 = -inverse_pivot_F_x_2*l_E3_y__FE_theta_2*phi_F_x_FE_theta;
    lin->lu[130] = l_E3_y__F_x_2;
    const double u_F_x__E3_y = -l_F_x__FE_theta_2*phi_E3_y_FE_theta;
    lin->lu[131] = u_F_x__E3_y;
    const double l_E4_x__F_x_2 = inverse_pivot_F_x_2*(inverse_FE_mass - l_E4_x__FE_theta_2*phi_F_x_FE_theta);
    lin->lu[132] = l_E4_x__F_x_2;
    const double u_F_x__E4_x = inverse_FE_mass - l_F_x__FE_theta_2*phi_E3_x_FE_theta;
    lin->lu[133] = u_F_x__E4_x;
    const double l_E4_y__F_x_2 = -inverse_pivot_F_x_2*l_E4_y__FE_theta_2*phi_F_x_FE_theta;
    lin->lu[134] = l_E4_y__F_x_2;
    const double u_F_x__E4_y = -l_F_x__FE_theta_2*phi_E3_y_FE_theta;
    lin->lu[135] = u_F_x__E4_y;
    const double l_E6_x__F_x_2 = inverse_pivot_F_x_2*(inverse_FE_mass - l_E6_x__FE_theta_2*phi_F_x_FE_theta);
    lin->lu[136] = l_E6_x__F_x_2;
    const double u_F_x__E6_x = inverse_FE_mass - l_F_x__FE_theta_2*phi_E3_x_FE_theta;
    lin->lu[137] = u_F_x__E6_x;
    const double l_E6_y__F_x_2 = -inverse_pivot_F_x_2*l_E6_y__FE_theta_2*phi_F_x_FE_theta;
    lin->lu[138] = l_E6_y__F_x_2;
    const double u_F_x__E6_y = -l_F_x__FE_theta_2*phi_E3_y_FE_theta;
    lin->lu[139] = u_F_x__E6_y;
    const double scale_F_y_2 = -inverse_FE_mass - inverse_OF_mass - l_F_y__FE_theta_2*phi_F_y_FE_theta -
        l_F_y__OF_theta_2*phi_F_y_OF_theta;
    const double pivot_F_y_2 = -l_F_y__F_x_2*u_F_x__F_y - l_F_y__O_x_2*u_O_x__F_y - l_F_y__O_y_2*u_O_y__F_y +
        scale_F_y_2;
    if (!(fabs(pivot_F_y_2) > 1e-08 * fabs(scale_F_y_2)))
        return 31;
    const double inverse_pivot_F_y_2 = 1.0/pivot_F_y_2;
    lin->lu[140] = inverse_pivot_F_y_2;
    const double l_E3_x__F_y_2 = inverse_pivot_F_y_2*(-l_E3_x__FE_theta_2*phi_F_y_FE_theta -
        l_E3_x__F_x_2*u_F_x__F_y);
    lin->lu[141] = l_E3_x__F_y_2;
    const double u_F_y__E3_x = -l_F_y__FE_theta_2*phi_E3_x_FE_theta - l_F_y__F_x_2*u_F_x__E3_x;
    lin->lu[142] = u_F_y__E3_x;
    const double l_E3_y__F_y_2 = inverse_pivot_F_y_2*(inverse_FE_mass - l_E3_y__FE_theta_2*phi_F_y_FE_theta -
        l_E3_y__F_x_2*u_F_x__F_y);
    lin->lu[143] = l_E3_y__F_y_2;
    const double u_F_y__E3_y = inverse_FE_mass - l_F_y__FE_theta_2*phi_E3_y_FE_theta -
        l_F_y__F_x_2*u_F_x__E3_y;
    lin->lu[144] = u_F_y__E3_y;
    const double l_E4_x__F_y_2 = inverse_pivot_F_y_2*(-l_E4_x__FE_theta_2*phi_F_y_FE_theta -
        l_E4_x__F_x_2*u_F_x__F_y);
    lin->lu[145] = l_E4_x__F_y_2;
    const double u_F_y__E4_x = -l_F_y__FE_theta_2*phi_E3_x_FE_theta - l_F_y__F_x_2*u_F_x__E4_x;
    lin->lu[146] = u_F_y__E4_x;
    const double l_E4_y__F_y_2 = inverse_pivot_F_y_2*(inverse_FE_mass - l_E4_y__FE_theta_2*phi_F_y_FE_theta -
        l_E4_y__F_x_2*u_F_x__F_y);
    lin->lu[147] = l_E4_y__F_y_2;
    const double u_F_y__E4_y = inverse_FE_mass - l_F_y__FE_theta_2*phi_E3_y_FE_theta -
        l_F_y__F_x_2*u_F_x__E4_y;
    lin->lu[148] = u_F_y__E4_y;
    const double l_E6_x__F_y_2 = inverse_pivot_F_y_2*(-l_E6_x__FE_theta_2*phi_F_y_FE_theta -
        l_E6_x__F_x_2*u_F_x__F_y);
    lin->lu[149] = l_E6_x__F_y_2;
    const double u_F_y__E6_x = -l_F_y__FE_theta_2*phi_E3_x_FE_theta - l_F_y__F_x_2*u_F_x__E6_x;
    lin->lu[150] = u_F_y__E6_x;
    const double l_E6_y__F_y_2 = inverse_pivot_F_y_2*(inverse_FE_mass - l_E6_y__FE_theta_2*phi_F_y_FE_theta -
        l_E6_y__F_x_2*u_F_x__F_y);
    lin->lu[151] = l_E6_y__F_y_2;
    const double u_F_y__E6_y = inverse_FE_mass - l_F_y__FE_theta_2*phi_E3_y_FE_theta -
        l_F_y__F_x_2*u_F_x__E6_y;
    lin->lu[152] = u_F_y__E6_y;
    const double scale_E3_x_2 = -inverse_FE_mass - inverse_pivot_BDE_x - l_BDE_y__BDE_x*l_E3_x__BDE_y -
        l_E3_x__BDE_theta_2*u_BDE_theta__E3_x - l_E3_x__FE_theta_2*phi_E3_x_FE_theta;
    const double pivot_E3_x_2 = -l_E3_x__B_x_2*u_B_x__E3_x - l_E3_x__B_y_2*u_B_y__E3_x -
        l_E3_x__F_x_2*u_F_x__E3_x - l_E3_x__F_y_2*u_F_y__E3_x + scale_E3_x_2;
    if (!(fabs(pivot_E3_x_2) > 1e-08 * fabs(scale_E3_x_2)))
        return 32;
    const double inverse_pivot_E3_x_2 = 1.0/pivot_E3_x_2;
    lin->lu[153] = inverse_pivot_E3_x_2;
    const double l_E3_y__E3_x_2 = inverse_pivot_E3_x_2*(inverse_pivot_BDE_y*l_BDE_y__BDE_x -
        l_E3_y__BDE_theta_2*u_BDE_theta__E3_x - l_E3_y__B_x_2*u_B_x__E3_x - l_E3_y__B_y_2*u_B_y__E3_x -
        l_E3_y__FE_theta_2*phi_E3_x_FE_theta - l_E3_y__F_x_2*u_F_x__E3_x - l_E3_y__F_y_2*u_F_y__E3_x);
    lin->lu[154] = l_E3_y__E3_x_2;
    const double u_E3_x__E3_y = -l_E3_x__BDE_theta_2*u_BDE_theta__E3_y + l_E3_x__BDE_y -
        l_E3_x__B_x_2*u_B_x__E3_y - l_E3_x__B_y_2*u_B_y__E3_y - l_E3_x__FE_theta_2*phi_E3_y_FE_theta -
        l_E3_x__F_x_2*u_F_x__E3_y - l_E3_x__F_y_2*u_F_y__E3_y;
    lin->lu[155] = u_E3_x__E3_y;
    const double l_E4_x__E3_x_2 = inverse_pivot_E3_x_2*(-inverse_FE_mass -
        l_E4_x__FE_theta_2*phi_E3_x_FE_theta - l_E4_x__F_x_2*u_F_x__E3_x - l_E4_x__F_y_2*u_F_y__E3_x);
    lin->lu[156] = l_E4_x__E3_x_2;
    const double u_E3_x__E4_x = -inverse_FE_mass - l_E3_x__FE_theta_2*phi_E3_x_FE_theta -
        l_E3_x__F_x_2*u_F_x__E4_x - l_E3_x__F_y_2*u_F_y__E4_x;
    lin->lu[157] = u_E3_x__E4_x;
    const double l_E4_y__E3_x_2 = inverse_pivot_E3_x_2*(-l_E4_y__FE_theta_2*phi_E3_x_FE_theta -
        l_E4_y__F_x_2*u_F_x__E3_x - l_E4_y__F_y_2*u_F_y__E3_x);
    lin->lu[158] = l_E4_y__E3_x_2;
    const double u_E3_x__E4_y = -l_E3_x__FE_theta_2*phi_E3_y_FE_theta - l_E3_x__F_x_2*u_F_x__E4_y -
        l_E3_x__F_y_2*u_F_y__E4_y;
    lin->lu[159] = u_E3_x__E4_y;
    const double l_E6_x__E3_x_2 = inverse_pivot_E3_x_2*(-inverse_FE_mass -
        l_E6_x__FE_theta_2*phi_E3_x_FE_theta - l_E6_x__F_x_2*u_F_x__E3_x - l_E6_x__F_y_2*u_F_y__E3_x);
    lin->lu[160] = l_E6_x__E3_x_2;
    const double u_E3_x__E6_x = -inverse_FE_mass - l_E3_x__FE_theta_2*phi_E3_x_FE_theta -
        l_E3_x__F_x_2*u_F_x__E6_x - l_E3_x__F_y_2*u_F_y__E6_x;
    lin->lu[161] = u_E3_x__E6_x;
    const double l_E6_y__E3_x_2 = inverse_pivot_E3_x_2*(-l_E6_y__FE_theta_2*phi_E3_x_FE_theta -
        l_E6_y__F_x_2*u_F_x__E3_x - l_E6_y__F_y_2*u_F_y__E3_x);
    lin->lu[162] = l_E6_y__E3_x_2;
    const double u_E3_x__E6_y = -l_E3_x__FE_theta_2*phi_E3_y_FE_theta - l_E3_x__F_x_2*u_F_x__E6_y -
        l_E3_x__F_y_2*u_F_y__E6_y;
    lin->lu[163] = u_E3_x__E6_y;
    const double scale_E3_y_2 = -inverse_FE_mass - inverse_pivot_BDE_y - l_E3_y__BDE_theta_2*u_BDE_theta__E3_y
        - l_E3_y__FE_theta_2*phi_E3_y_FE_theta;
    const double pivot_E3_y_2 = -l_E3_y__B_x_2*u_B_x__E3_y - l_E3_y__B_y_2*u_B_y__E3_y -
        l_E3_y__E3_x_2*u_E3_x__E3_y - l_E3_y__F_x_2*u_F_x__E3_y - l_E3_y__F_y_2*u_F_y__E3_y + scale_E3_y_2;
    if (!(fabs(pivot_E3_y_2) > 1e-08 * fabs(scale_E3_y_2)))
        return 33;
    const double inverse_pivot_E3_y_2 = 1.0/pivot_E3_y_2;
    lin->lu[164] = inverse_pivot_E3_y_2;
    const double l_E4_x__E3_y_2 = inverse_pivot_E3_y_2*(-l_E4_x__E3_x_2*u_E3_x__E3_y -
        l_E4_x__FE_theta_2*phi_E3_y_FE_theta - l_E4_x__F_x_2*u_F_x__E3_y - l_E4_x__F_y_2*u_F_y__E3_y);
    lin->lu[165] = l_E4_x__E3_y_2;
    const double u_E3_y__E4_x = -l_E3_y__E3_x_2*u_E3_x__E4_x - l_E3_y__FE_theta_2*phi_E3_x_FE_theta -
        l_E3_y__F_x_2*u_F_x__E4_x - l_E3_y__F_y_2*u_F_y__E4_x;
    lin->lu[166] = u_E3_y__E4_x;
    const double l_E4_y__E3_y_2 = inverse_pivot_E3_y_2*(-inverse_FE_mass - l_E4_y__E3_x_2*u_E3_x__E3_y -
        l_E4_y__FE_theta_2*phi_E3_y_FE_theta - l_E4_y__F_x_2*u_F_x__E3_y - l_E4_y__F_y_2*u_F_y__E3_y);
    lin->lu[167] = l_E4_y__E3_y_2;
    const double u_E3_y__E4_y = -inverse_FE_mass - l_E3_y__E3_x_2*u_E3_x__E4_y -
        l_E3_y__FE_theta_2*phi_E3_y_FE_theta - l_E3_y__F_x_2*u_F_x__E4_y - l_E3_y__F_y_2*u_F_y__E4_y;
    lin->lu[168] = u_E3_y__E4_y;
    const double l_E6_x__E3_y_2 = inverse_pivot_E3_y_2*(-l_E6_x__E3_x_2*u_E3_x__E3_y -
        l_E6_x__FE_theta_2*phi_E3_y_FE_theta - l_E6_x__F_x_2*u_F_x__E3_y - l_E6_x__F_y_2*u_F_y__E3_y);
    lin->lu[169] = l_E6_x__E3_y_2;
    const double u_E3_y__E6_x = -l_E3_y__E3_x_2*u_E3_x__E6_x - l_E3_y__FE_theta_2*phi_E3_x_FE_theta -
        l_E3_y__F_x_2*u_F_x__E6_x - l_E3_y__F_y_2*u_F_y__E6_x;
    lin->lu[170] = u_E3_y__E6_x;
    const double l_E6_y__E3_y_2 = inverse_pivot_E3_y_2*(-inverse_FE_mass - l_E6_y__E3_x_2*u_E3_x__E3_y -
        l_E6_y__FE_theta_2*phi_E3_y_FE_theta - l_E6_y__F_x_2*u_F_x__E3_y - l_E6_y__F_y_2*u_F_y__E3_y);
    lin->lu[171] = l_E6_y__E3_y_2;
    const double u_E3_y__E6_y = -inverse_FE_mass - l_E3_y__E3_x_2*u_E3_x__E6_y -
        l_E3_y__FE_theta_2*phi_E3_y_FE_theta - l_E3_y__F_x_2*u_F_x__E6_y - l_E3_y__F_y_2*u_F_y__E6_y;
    lin->lu[172] = u_E3_y__E6_y;
    const double scale_E4_x_2 = -inverse_EG_mass - inverse_FE_mass - l_E4_x__EG_theta_2*phi_E4_x_EG_theta -
        l_E4_x__FE_theta_2*phi_E3_x_FE_theta;
    const double pivot_E4_x_2 = -l_E4_x__E3_x_2*u_E3_x__E4_x - l_E4_x__E3_y_2*u_E3_y__E4_x -
        l_E4_x__F_x_2*u_F_x__E4_x - l_E4_x__F_y_2*u_F_y__E4_x - l_E4_x__G_x_2*u_G_x__E4_x -
        l_E4_x__G_y_2*u_G_y__E4_x + scale_E4_x_2;
    if (!(fabs(pivot_E4_x_2) > 1e-08 * fabs(scale_E4_x_2)))
        return 34;
    const double inverse_pivot_E4_x_2 = 1.0/pivot_E4_x_2;
    lin->lu[173] = inverse_pivot_E4_x_2;
    const double l_E4_y__E4_x_2 = inverse_pivot_E4_x_2*(-l_E4_y__E3_x_2*u_E3_x__E4_x -
        l_E4_y__E3_y_2*u_E3_y__E4_x - l_E4_y__EG_theta_2*phi_E4_x_EG_theta -
        l_E4_y__FE_theta_2*phi_E3_x_FE_theta - l_E4_y__F_x_2*u_F_x__E4_x - l_E4_y__F_y_2*u_F_y__E4_x -
        l_E4_y__G_x_2*u_G_x__E4_x - l_E4_y__G_y_2*u_G_y__E4_x);
    lin->lu[174] = l_E4_y__E4_x_2;
    const double u_E4_x__E4_y = -l_E4_x__E3_x_2*u_E3_x__E4_y - l_E4_x__E3_y_2*u_E3_y__E4_y -
        l_E4_x__EG_theta_2*phi_E4_y_EG_theta - l_E4_x__FE_theta_2*phi_E3_y_FE_theta -
        l_E4_x__F_x_2*u_F_x__E4_y - l_E4_x__F_y_2*u_F_y__E4_y - l_E4_x__G_x_2*u_G_x__E4_y -
        l_E4_x__G_y_2*u_G_y__E4_y;
    lin->lu[175] = u_E4_x__E4_y;
    const double l_E6_x__E4_x_2 = inverse_pivot_E4_x_2*(-inverse_FE_mass - l_E6_x__E3_x_2*u_E3_x__E4_x -
        l_E6_x__E3_y_2*u_E3_y__E4_x - l_E6_x__FE_theta_2*phi_E3_x_FE_theta - l_E6_x__F_x_2*u_F_x__E4_x -
        l_E6_x__F_y_2*u_F_y__E4_x);
    lin->lu[176] = l_E6_x__E4_x_2;
    const double u_E4_x__E6_x = -inverse_FE_mass - l_E4_x__E3_x_2*u_E3_x__E6_x - l_E4_x__E3_y_2*u_E3_y__E6_x -
        l_E4_x__FE_theta_2*phi_E3_x_FE_theta - l_E4_x__F_x_2*u_F_x__E6_x - l_E4_x__F_y_2*u_F_y__E6_x;
    lin->lu[177] = u_E4_x__E6_x;
    const double l_E6_y__E4_x_2 = inverse_pivot_E4_x_2*(-l_E6_y__E3_x_2*u_E3_x__E4_x -
        l_E6_y__E3_y_2*u_E3_y__E4_x - l_E6_y__FE_theta_2*phi_E3_x_FE_theta - l_E6_y__F_x_2*u_F_x__E4_x -
        l_E6_y__F_y_2*u_F_y__E4_x);
    lin->lu[178] = l_E6_y__E4_x_2;
    const double u_E4_x__E6_y = -l_E4_x__E3_x_2*u_E3_x__E6_y - l_E4_x__E3_y_2*u_E3_y__E6_y -
        l_E4_x__FE_theta_2*phi_E3_y_FE_theta - l_E4_x__F_x_2*u_F_x__E6_y - l_E4_x__F_y_2*u_F_y__E6_y;
    lin->lu[179] = u_E4_x__E6_y;
    const double scale_E4_y_2 = -inverse_EG_mass - inverse_FE_mass - l_E4_y__EG_theta_2*phi_E4_y_EG_theta -
        l_E4_y__FE_theta_2*phi_E3_y_FE_theta;
    const double pivot_E4_y_2 = -l_E4_y__E3_x_2*u_E3_x__E4_y - l_E4_y__E3_y_2*u_E3_y__E4_y -
        l_E4_y__E4_x_2*u_E4_x__E4_y - l_E4_y__F_x_2*u_F_x__E4_y - l_E4_y__F_y_2*u_F_y__E4_y -
        l_E4_y__G_x_2*u_G_x__E4_y - l_E4_y__G_y_2*u_G_y__E4_y + scale_E4_y_2;
    if (!(fabs(pivot_E4_y_2) > 1e-08 * fabs(scale_E4_y_2)))
        return 35;
    const double inverse_pivot_E4_y_2 = 1.0/pivot_E4_y_2;
    lin->lu[180] = inverse_pivot_E4_y_2;
    const double l_E6_x__E4_y_2 = inverse_pivot_E4_y_2*(-l_E6_x__E3_x_2*u_E3_x__E4_y -
        l_E6_x__E3_y_2*u_E3_y__E4_y - l_E6_x__E4_x_2*u_E4_x__E4_y - l_E6_x__FE_theta_2*phi_E3_y_FE_theta -
        l_E6_x__F_x_2*u_F_x__E4_y - l_E6_x__F_y_2*u_F_y__E4_y);
    lin->lu[181] = l_E6_x__E4_y_2;
    const double u_E4_y__E6_x = -l_E4_y__E3_x_2*u_E3_x__E6_x - l_E4_y__E3_y_2*u_E3_y__E6_x -
        l_E4_y__E4_x_2*u_E4_x__E6_x - l_E4_y__FE_theta_2*phi_E3_x_FE_theta - l_E4_y__F_x_2*u_F_x__E6_x -
        l_E4_y__F_y_2*u_F_y__E6_x;
    lin->lu[182] = u_E4_y__E6_x;
    const double l_E6_y__E4_y_2 = inverse_pivot_E4_y_2*(-inverse_FE_mass - l_E6_y__E3_x_2*u_E3_x__E4_y -
        l_E6_y__E3_y_2*u_E3_y__E4_y - l_E6_y__E4_x_2*u_E4_x__E4_y - l_E6_y__FE_theta_2*phi_E3_y_FE_theta -
        l_E6_y__F_x_2*u_F_x__E4_y - l_E6_y__F_y_2*u_F_y__E4_y);
    lin->lu[183] = l_E6_y__E4_y_2;
    const double u_E4_y__E6_y = -inverse_FE_mass - l_E4_y__E3_x_2*u_E3_x__E6_y - l_E4_y__E3_y_2*u_E3_y__E6_y -
        l_E4_y__E4_x_2*u_E4_x__E6_y - l_E4_y__FE_theta_2*phi_E3_y_FE_theta - l_E4_y__F_x_2*u_F_x__E6_y -
        l_E4_y__F_y_2*u_F_y__E6_y;
    lin->lu[184] = u_E4_y__E6_y;
    const double scale_E6_x_2 = -inverse_FE_mass - inverse_HE_mass - l_E6_x__FE_theta_2*phi_E3_x_FE_theta -
        l_E6_x__HE_theta_2*phi_E6_x_HE_theta;
    const double pivot_E6_x_2 = -l_E6_x__E3_x_2*u_E3_x__E6_x - l_E6_x__E3_y_2*u_E3_y__E6_x -
        l_E6_x__E4_x_2*u_E4_x__E6_x - l_E6_x__E4_y_2*u_E4_y__E6_x - l_E6_x__F_x_2*u_F_x__E6_x -
        l_E6_x__F_y_2*u_F_y__E6_x - l_E6_x__H_x_2*u_H_x__E6_x - l_E6_x__H_y_2*u_H_y__E6_x + scale_E6_x_2;
    if (!(fabs(pivot_E6_x_2) > 1e-08 * fabs(scale_E6_x_2)))
        return 36;
    const double inverse_pivot_E6_x_2 = 1.0/pivot_E6_x_2;
    lin->lu[185] = inverse_pivot_E6_x_2;
    const double l_E6_y__E6_x_2 = inverse_pivot_E6_x_2*(-l_E6_y__E3_x_2*u_E3_x__E6_x -
        l_E6_y__E3_y_2*u_E3_y__E6_x - l_E6_y__E4_x_2*u_E4_x__E6_x - l_E6_y__E4_y_2*u_E4_y__E6_x -
        l_E6_y__FE_theta_2*phi_E3_x_FE_theta - l_E6_y__F_x_2*u_F_x__E6_x - l_E6_y__F_y_2*u_F_y__E6_x -
        l_E6_y__HE_theta_2*phi_E6_x_HE_theta - l_E6_y__H_x_2*u_H_x__E6_x - l_E6_y__H_y_2*u_H_y__E6_x);
    lin->lu[186] = l_E6_y__E6_x_2;
    const double u_E6_x__E6_y = -l_E6_x__E3_x_2*u_E3_x__E6_y - l_E6_x__E3_y_2*u_E3_y__E6_y -
        l_E6_x__E4_x_2*u_E4_x__E6_y - l_E6_x__E4_y_2*u_E4_y__E6_y - l_E6_x__FE_theta_2*phi_E3_y_FE_theta -
        l_E6_x__F_x_2*u_F_x__E6_y - l_E6_x__F_y_2*u_F_y__E6_y - l_E6_x__HE_theta_2*phi_E6_y_HE_theta -
        l_E6_x__H_x_2*u_H_x__E6_y - l_E6_x__H_y_2*u_H_y__E6_y;
    lin->lu[187] = u_E6_x__E6_y;
    const double scale_E6_y_2 = -inverse_FE_mass - inverse_HE_mass - l_E6_y__FE_theta_2*phi_E3_y_FE_theta -
        l_E6_y__HE_theta_2*phi_E6_y_HE_theta;
    const double pivot_E6_y_2 = -l_E6_y__E3_x_2*u_E3_x__E6_y - l_E6_y__E3_y_2*u_E3_y__E6_y -
        l_E6_y__E4_x_2*u_E4_x__E6_y - l_E6_y__E4_y_2*u_E4_y__E6_y - l_E6_y__E6_x_2*u_E6_x__E6_y -
        l_E6_y__F_x_2*u_F_x__E6_y - l_E6_y__F_y_2*u_F_y__E6_y - l_E6_y__H_x_2*u_H_x__E6_y -
        l_E6_y__H_y_2*u_H_y__E6_y + scale_E6_y_2;
    if (!(fabs(pivot_E6_y_2) > 1e-08 * fabs(scale_E6_y_2)))
        return 37;
    const double inverse_pivot_E6_y_2 = 1.0/pivot_E6_y_2;
    lin->lu[188] = inverse_pivot_E6_y_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O_x_OF_theta = lin->value[0];
    const double phi_O_y_OF_theta = lin->value[1];
    const double phi_A5_x_AG_theta = lin->value[4];
    const double phi_A5_y_AG_theta = lin->value[5];
    const double phi_A7_x_AH_theta = lin->value[6];
    const double phi_A7_y_AH_theta = lin->value[7];
    const double phi_F_x_OF_theta = lin->value[8];
    const double phi_F_x_FE_theta = lin->value[9];
    const double phi_F_y_OF_theta = lin->value[10];
    const double phi_F_y_FE_theta = lin->value[11];
    const double phi_E3_x_FE_theta = lin->value[12];
    const double phi_E3_y_FE_theta = lin->value[14];
    const double phi_E4_x_EG_theta = lin->value[16];
    const double phi_E4_y_EG_theta = lin->value[17];
    const double phi_E6_x_HE_theta = lin->value[18];
    const double phi_E6_y_HE_theta = lin->value[19];
    const double phi_G_x_EG_theta = lin->value[20];
    const double phi_G_x_AG_theta = lin->value[21];
    const double phi_G_y_EG_theta = lin->value[22];
    const double phi_G_y_AG_theta = lin->value[23];
    const double phi_H_x_HE_theta = lin->value[24];
    const double phi_H_x_AH_theta = lin->value[25];
    const double phi_H_y_HE_theta = lin->value[26];
    const double phi_H_y_AH_theta = lin->value[27];
    const double inverse_pivot_OF_theta = lin->lu[0];
    const double l_O_x__OF_theta_2 = lin->lu[1];
    const double l_O_y__OF_theta_2 = lin->lu[2];
    const double l_F_x__OF_theta_2 = lin->lu[3];
    const double l_F_y__OF_theta_2 = lin->lu[4];
    const double inverse_pivot_O_x_2 = lin->lu[5];
    const double l_O_y__O_x_2 = lin->lu[6];
    const double u_O_x__O_y = lin->lu[7];
    const double l_F_x__O_x_2 = lin->lu[8];
    const double u_O_x__F_x = lin->lu[9];
    const double l_F_y__O_x_2 = lin->lu[10];
    const double u_O_x__F_y = lin->lu[11];
    const double inverse_pivot_O_y_2 = lin->lu[12];
    const double l_F_x__O_y_2 = lin->lu[13];
    const double u_O_y__F_x = lin->lu[14];
    const double l_F_y__O_y_2 = lin->lu[15];
    const double u_O_y__F_y = lin->lu[16];
    const double inverse_pivot_BDE_x = lin->lu[17];
    const double l_BDE_y__BDE_x = lin->lu[18];
    const double n_BDE_x__BDE_y = lin->lu[19];
    const double l_BDE_theta__BDE_x = lin->lu[20];
    const double n_BDE_x__BDE_theta = lin->lu[21];
    const double inverse_pivot_EG_theta = lin->lu[22];
    const double l_G_x__EG_theta_2 = lin->lu[23];
    const double l_G_y__EG_theta_2 = lin->lu[24];
    const double l_E4_x__EG_theta_2 = lin->lu[25];
    const double l_E4_y__EG_theta_2 = lin->lu[26];
    const double inverse_pivot_AG_theta = lin->lu[27];
    const double l_A5_x__AG_theta_2 = lin->lu[28];
    const double l_A5_y__AG_theta_2 = lin->lu[29];
    const double l_G_x__AG_theta_2 = lin->lu[30];
    const double l_G_y__AG_theta_2 = lin->lu[31];
    const double inverse_pivot_A5_x_2 = lin->lu[32];
    const double l_A5_y__A5_x_2 = lin->lu[33];
    const double u_A5_x__A5_y = lin->lu[34];
    const double l_G_x__A5_x_2 = lin->lu[35];
    const double u_A5_x__G_x = lin->lu[36];
    const double l_G_y__A5_x_2 = lin->lu[37];
    const double u_A5_x__G_y = lin->lu[38];
    const double inverse_pivot_A5_y_2 = lin->lu[39];
    const double l_G_x__A5_y_2 = lin->lu[40];
    const double u_A5_y__G_x = lin->lu[41];
    const double l_G_y__A5_y_2 = lin->lu[42];
    const double u_A5_y__G_y = lin->lu[43];
    const double inverse_pivot_G_x_2 = lin->lu[44];
    const double l_G_y__G_x_2 = lin->lu[45];
    const double u_G_x__G_y = lin->lu[46];
    const double l_E4_x__G_x_2 = lin->lu[47];
    const double u_G_x__E4_x = lin->lu[48];
    const double l_E4_y__G_x_2 = lin->lu[49];
    const double u_G_x__E4_y = lin->lu[50];
    const double inverse_pivot_G_y_2 = lin->lu[51];
    const double l_E4_x__G_y_2 = lin->lu[52];
    const double u_G_y__E4_x = lin->lu[53];
    const double l_E4_y__G_y_2 = lin->lu[54];
    const double u_G_y__E4_y = lin->lu[55];
    const double inverse_pivot_HE_theta = lin->lu[56];
    const double l_H_x__HE_theta_2 = lin->lu[57];
    const double l_H_y__HE_theta_2 = lin->lu[58];
    const double l_E6_x__HE_theta_2 = lin->lu[59];
    const double l_E6_y__HE_theta_2 = lin->lu[60];
    const double inverse_pivot_AH_theta = lin->lu[61];
    const double l_A7_x__AH_theta_2 = lin->lu[62];
    const double l_A7_y__AH_theta_2 = lin->lu[63];
    const double l_H_x__AH_theta_2 = lin->lu[64];
    const double l_H_y__AH_theta_2 = lin->lu[65];
    const double inverse_pivot_A7_x_2 = lin->lu[66];
    const double l_A7_y__A7_x_2 = lin->lu[67];
    const double u_A7_x__A7_y = lin->lu[68];
    const double l_H_x__A7_x_2 = lin->lu[69];
    const double u_A7_x__H_x = lin->lu[70];
    const double l_H_y__A7_x_2 = lin->lu[71];
    const double u_A7_x__H_y = lin->lu[72];
    const double inverse_pivot_A7_y_2 = lin->lu[73];
    const double l_H_x__A7_y_2 = lin->lu[74];
    const double u_A7_y__H_x = lin->lu[75];
    const double l_H_y__A7_y_2 = lin->lu[76];
    const double u_A7_y__H_y = lin->lu[77];
    const double inverse_pivot_H_x_2 = lin->lu[78];
    const double l_H_y__H_x_2 = lin->lu[79];
    const double u_H_x__H_y = lin->lu[80];
    const double l_E6_x__H_x_2 = lin->lu[81];
    const double u_H_x__E6_x = lin->lu[82];
    const double l_E6_y__H_x_2 = lin->lu[83];
    const double u_H_x__E6_y = lin->lu[84];
    const double inverse_pivot_H_y_2 = lin->lu[85];
    const double l_E6_x__H_y_2 = lin->lu[86];
    const double u_H_y__E6_x = lin->lu[87];
    const double l_E6_y__H_y_2 = lin->lu[88];
    const double u_H_y__E6_y = lin->lu[89];
    const double inverse_pivot_BDE_y = lin->lu[90];
    const double l_BDE_theta__BDE_y = lin->lu[91];
    const double u_BDE_y__BDE_theta = lin->lu[92];
    const double l_B_x__BDE_y = lin->lu[93];
    const double l_E3_x__BDE_y = lin->lu[94];
    const double inverse_pivot_BDE_theta = lin->lu[95];
    const double l_B_x__BDE_theta_2 = lin->lu[96];
    const double u_BDE_theta__B_x = lin->lu[97];
    const double l_B_y__BDE_theta_2 = lin->lu[98];
    const double u_BDE_theta__B_y = lin->lu[99];
    const double l_E3_x__BDE_theta_2 = lin->lu[100];
    const double u_BDE_theta__E3_x = lin->lu[101];
    const double l_E3_y__BDE_theta_2 = lin->lu[102];
    const double u_BDE_theta__E3_y = lin->lu[103];
    const double inverse_pivot_B_x_2 = lin->lu[104];
    const double l_B_y__B_x_2 = lin->lu[105];
    const double u_B_x__B_y = lin->lu[106];
    const double l_E3_x__B_x_2 = lin->lu[107];
    const double u_B_x__E3_x = lin->lu[108];
    const double l_E3_y__B_x_2 = lin->lu[109];
    const double u_B_x__E3_y = lin->lu[110];
    const double inverse_pivot_B_y_2 = lin->lu[111];
    const double l_E3_x__B_y_2 = lin->lu[112];
    const double u_B_y__E3_x = lin->lu[113];
    const double l_E3_y__B_y_2 = lin->lu[114];
    const double u_B_y__E3_y = lin->lu[115];
    const double inverse_pivot_FE_theta = lin->lu[116];
    const double l_F_x__FE_theta_2 = lin->lu[117];
    const double l_F_y__FE_theta_2 = lin->lu[118];
    const double l_E3_x__FE_theta_2 = lin->lu[119];
    const double l_E3_y__FE_theta_2 = lin->lu[120];
    const double l_E4_x__FE_theta_2 = lin->lu[121];
    const double l_E4_y__FE_theta_2 = lin->lu[122];
    const double l_E6_x__FE_theta_2 = lin->lu[123];
    const double l_E6_y__FE_theta_2 = lin->lu[124];
    const double inverse_pivot_F_x_2 = lin->lu[125];
    const double l_F_y__F_x_2 = lin->lu[126];
    const double u_F_x__F_y = lin->lu[127];
    const double l_E3_x__F_x_2 = lin->lu[128];
    const double u_F_x__E3_x = lin->lu[129];
    const double l_E3_y__F_x_2 = lin->lu[130];
    const double u_F_x__E3_y = lin->lu[131];
    const double l_E4_x__F_x_2 = lin->lu[132];
    const double u_F_x__E4_x = lin->lu[133];
    const double l_E4_y__F_x_2 = lin->lu[134];
    const double u_F_x__E4_y = lin->lu[135];
    const double l_E6_x__F_x_2 = lin->lu[136];
    const double u_F_x__E6_x = lin->lu[137];
    const double l_E6_y__F_x_2 = lin->lu[138];
    const double u_F_x__E6_y = lin->lu[139];
    const double inverse_pivot_F_y_2 = lin->lu[140];
    const double l_E3_x__F_y_2 = lin->lu[141];
    const double u_F_y__E3_x = lin->lu[142];
    const double l_E3_y__F_y_2 = lin->lu[143];
    const double u_F_y__E3_y = lin->lu[144];
    const double l_E4_x__F_y_2 = lin->lu[145];
    const double u_F_y__E4_x = lin->lu[146];
    const double l_E4_y__F_y_2 = lin->lu[147];
    const double u_F_y__E4_y = lin->lu[148];
    const double l_E6_x__F_y_2 = lin->lu[149];
    const double u_F_y__E6_x = lin->lu[150];
    const double l_E6_y__F_y_2 = lin->lu[151];
    const double u_F_y__E6_y = lin->lu[152];
    const double inverse_pivot_E3_x_2 = lin->lu[153];
    const double l_E3_y__E3_x_2 = lin->lu[154];
    const double u_E3_x__E3_y = lin->lu[155];
    const double l_E4_x__E3_x_2 = lin->lu[156];
    const double u_E3_x__E4_x = lin->lu[157];
    const double l_E4_y__E3_x_2 = lin->lu[158];
    const double u_E3_x__E4_y = lin->lu[159];
    const double l_E6_x__E3_x_2 = lin->lu[160];
    const double u_E3_x__E6_x = lin->lu[161];
    const double l_E6_y__E3_x_2 = lin->lu[162];
    const double u_E3_x__E6_y = lin->lu[163];
    const double inverse_pivot_E3_y_2 = lin->lu[164];
    const double l_E4_x__E3_y_2 = lin->lu[165];
    const double u_E3_y__E4_x = lin->lu[166];
    const double l_E4_y__E3_y_2 = lin->lu[167];
    const double u_E3_y__E4_y = lin->lu[168];
    const double l_E6_x__E3_y_2 = lin->lu[169];
    const double u_E3_y__E6_x = lin->lu[170];
    const double l_E6_y__E3_y_2 = lin->lu[171];
    const double u_E3_y__E6_y = lin->lu[172];
    const double inverse_pivot_E4_x_2 = lin->lu[173];
    const double l_E4_y__E4_x_2 = lin->lu[174];
    const double u_E4_x__E4_y = lin->lu[175];
    const double l_E6_x__E4_x_2 = lin->lu[176];
    const double u_E4_x__E6_x = lin->lu[177];
    const double l_E6_y__E4_x_2 = lin->lu[178];
    const double u_E4_x__E6_y = lin->lu[179];
    const double inverse_pivot_E4_y_2 = lin->lu[180];
    const double l_E6_x__E4_y_2 = lin->lu[181];
    const double u_E4_y__E6_x = lin->lu[182];
    const double l_E6_y__E4_y_2 = lin->lu[183];
    const double u_E4_y__E6_y = lin->lu[184];
    const double inverse_pivot_E6_x_2 = lin->lu[185];
    const double l_E6_y__E6_x_2 = lin->lu[186];
    const double u_E6_x__E6_y = lin->lu[187];
    const double inverse_pivot_E6_y_2 = lin->lu[188];

    /* parameters */
    const double inverse_OF_mass = p->inverse_OF_mass;
    const double inverse_EG_mass = p->inverse_EG_mass;
    const double inverse_AG_mass = p->inverse_AG_mass;
    const double inverse_HE_mass = p->inverse_HE_mass;
    const double inverse_AH_mass = p->inverse_AH_mass;
    const double inverse_FE_mass = p->inverse_FE_mass;

    /* forward */
    const double b_OF_x = x[0];
    const double b_OF_y = x[1];
    const double b_EG_x = x[9];
    const double b_EG_y = x[10];
    const double b_AG_x = x[12];
    const double b_AG_y = x[13];
    const double b_HE_x = x[15];
    const double b_HE_y = x[16];
    const double b_AH_x = x[18];
    const double b_AH_y = x[19];
    const double b_OF_theta = x[2];
    const double b_O_x = -b_OF_theta*l_O_x__OF_theta_2 + b_OF_x*inverse_OF_mass + x[21];
    const double b_O_y = -b_OF_theta*l_O_y__OF_theta_2 + b_OF_y*inverse_OF_mass - b_O_x*l_O_y__O_x_2 + x[22];
    const double b_FE_x = x[3];
    const double b_FE_y = x[4];
    const double b_BDE_x = x[6];
    const double b_EG_theta = x[11];
    const double b_AG_theta = x[14];
    const double b_A5_x = -b_AG_theta*l_A5_x__AG_theta_2 + b_AG_x*inverse_AG_mass + x[25];
    const double b_A5_y = -b_A5_x*l_A5_y__A5_x_2 - b_AG_theta*l_A5_y__AG_theta_2 + b_AG_y*inverse_AG_mass +
        x[26];
    const double b_G_x = -b_A5_x*l_G_x__A5_x_2 - b_A5_y*l_G_x__A5_y_2 - b_AG_theta*l_G_x__AG_theta_2 +
        b_AG_x*inverse_AG_mass - b_EG_theta*l_G_x__EG_theta_2 - b_EG_x*inverse_EG_mass + x[37];
    const double b_G_y = -b_A5_x*l_G_y__A5_x_2 - b_A5_y*l_G_y__A5_y_2 - b_AG_theta*l_G_y__AG_theta_2 +
        b_AG_y*inverse_AG_mass - b_EG_theta*l_G_y__EG_theta_2 - b_EG_y*inverse_EG_mass - b_G_x*l_G_y__G_x_2 +
        x[38];
    const double b_HE_theta = x[17];
    const double b_AH_theta = x[20];
    const double b_A7_x = -b_AH_theta*l_A7_x__AH_theta_2 + b_AH_x*inverse_AH_mass + x[27];
    const double b_A7_y = -b_A7_x*l_A7_y__A7_x_2 - b_AH_theta*l_A7_y__AH_theta_2 + b_AH_y*inverse_AH_mass +
        x[28];
    const double b_H_x = -b_A7_x*l_H_x__A7_x_2 - b_A7_y*l_H_x__A7_y_2 - b_AH_theta*l_H_x__AH_theta_2 +
        b_AH_x*inverse_AH_mass - b_HE_theta*l_H_x__HE_theta_2 - b_HE_x*inverse_HE_mass + x[39];
    const double b_H_y = -b_A7_x*l_H_y__A7_x_2 - b_A7_y*l_H_y__A7_y_2 - b_AH_theta*l_H_y__AH_theta_2 +
        b_AH_y*inverse_AH_mass - b_HE_theta*l_H_y__HE_theta_2 - b_HE_y*inverse_HE_mass - b_H_x*l_H_y__H_x_2 +
        x[40];
    const double b_BDE_y = -b_BDE_x*l_BDE_y__BDE_x + x[7];
    const double b_BDE_theta = -b_BDE_x*l_BDE_theta__BDE_x - b_BDE_y*l_BDE_theta__BDE_y + x[8];
    const double b_B_x = -b_BDE_theta*l_B_x__BDE_theta_2 + b_BDE_x*inverse_pivot_BDE_x - b_BDE_y*l_B_x__BDE_y
        + x[23];
    const double b_B_y = -b_BDE_theta*l_B_y__BDE_theta_2 + b_BDE_y*inverse_pivot_BDE_y - b_B_x*l_B_y__B_x_2 +
        x[24];
    const double b_FE_theta = x[5];
    const double b_F_x = -b_FE_theta*l_F_x__FE_theta_2 + b_FE_x*inverse_FE_mass - b_OF_theta*l_F_x__OF_theta_2
        - b_OF_x*inverse_OF_mass - b_O_x*l_F_x__O_x_2 - b_O_y*l_F_x__O_y_2 + x[29];
    const double b_F_y = -b_FE_theta*l_F_y__FE_theta_2 + b_FE_y*inverse_FE_mass - b_F_x*l_F_y__F_x_2 -
        b_OF_theta*l_F_y__OF_theta_2 - b_OF_y*inverse_OF_mass - b_O_x*l_F_y__O_x_2 - b_O_y*l_F_y__O_y_2 +
        x[30];
    const double b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta_2 + b_BDE_x*inverse_pivot_BDE_x -
        b_BDE_y*l_E3_x__BDE_y - b_B_x*l_E3_x__B_x_2 - b_B_y*l_E3_x__B_y_2 - b_FE_theta*l_E3_x__FE_theta_2 -
        b_FE_x*inverse_FE_mass - b_F_x*l_E3_x__F_x_2 - b_F_y*l_E3_x__F_y_2 + x[31];
    const double b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta_2 + b_BDE_y*inverse_pivot_BDE_y - b_B_x*l_E3_y__B_x_2
        - b_B_y*l_E3_y__B_y_2 - b_E3_x*l_E3_y__E3_x_2 - b_FE_theta*l_E3_y__FE_theta_2 - b_FE_y*inverse_FE_mass
        - b_F_x*l_E3_y__F_x_2 - b_F_y*l_E3_y__F_y_2 + x[32];
    const double b_E4_x = -b_E3_x*l_E4_x__E3_x_2 - b_E3_y*l_E4_x__E3_y_2 - b_EG_theta*l_E4_x__EG_theta_2 +
        b_EG_x*inverse_EG_mass - b_FE_theta*l_E4_x__FE_theta_2 - b_FE_x*inverse_FE_mass - b_F_x*l_E4_x__F_x_2
        - b_F_y*l_E4_x__F_y_2 - b_G_x*l_E4_x__G_x_2 - b_G_y*l_E4_x__G_y_2 + x[33];
    const double b_E4_y = -b_E3_x*l_E4_y__E3_x_2 - b_E3_y*l_E4_y__E3_y_2 - b_E4_x*l_E4_y__E4_x_2 -
        b_EG_theta*l_E4_y__EG_theta_2 + b_EG_y*inverse_EG_mass - b_FE_theta*l_E4_y__FE_theta_2 -
        b_FE_y*inverse_FE_mass - b_F_x*l_E4_y__F_x_2 - b_F_y*l_E4_y__F_y_2 - b_G_x*l_E4_y__G_x_2 -
        b_G_y*l_E4_y__G_y_2 + x[34];
    const double b_E6_x = -b_E3_x*l_E6_x__E3_x_2 - b_E3_y*l_E6_x__E3_y_2 - b_E4_x*l_E6_x__E4_x_2 -
        b_E4_y*l_E6_x__E4_y_2 - b_FE_theta*l_E6_x__FE_theta_2 - b_FE_x*inverse_FE_mass - b_F_x*l_E6_x__F_x_2 -
        b_F_y*l_E6_x__F_y_2 - b_HE_theta*l_E6_x__HE_theta_2 + b_HE_x*inverse_HE_mass - b_H_x*l_E6_x__H_x_2 -
        b_H_y*l_E6_x__H_y_2 + x[35];
    const double b_E6_y = -b_E3_x*l_E6_y__E3_x_2 - b_E3_y*l_E6_y__E3_y_2 - b_E4_x*l_E6_y__E4_x_2 -
        b_E4_y*l_E6_y__E4_y_2 - b_E6_x*l_E6_y__E6_x_2 - b_FE_theta*l_E6_y__FE_theta_2 - b_FE_y*inverse_FE_mass
        - b_F_x*l_E6_y__F_x_2 - b_F_y*l_E6_y__F_y_2 - b_HE_theta*l_E6_y__HE_theta_2 + b_HE_y*inverse_HE_mass -
        b_H_x*l_E6_y__H_x_2 - b_H_y*l_E6_y__H_y_2 + x[36];

    /* backward */
    const double x_E6_y = b_E6_y*inverse_pivot_E6_y_2;
    x[36] = x_E6_y;
    const double x_E6_x = inverse_pivot_E6_x_2*(b_E6_x - u_E6_x__E6_y*x_E6_y);
    x[35] = x_E6_x;
    const double x_E4_y = inverse_pivot_E4_y_2*(b_E4_y - u_E4_y__E6_x*x_E6_x - u_E4_y__E6_y*x_E6_y);
    x[34] = x_E4_y;
    const double x_E4_x = inverse_pivot_E4_x_2*(b_E4_x - u_E4_x__E4_y*x_E4_y - u_E4_x__E6_x*x_E6_x -
        u_E4_x__E6_y*x_E6_y);
    x[33] = x_E4_x;
    const double x_E3_y = inverse_pivot_E3_y_2*(b_E3_y - u_E3_y__E4_x*x_E4_x - u_E3_y__E4_y*x_E4_y -
        u_E3_y__E6_x*x_E6_x - u_E3_y__E6_y*x_E6_y);
    x[32] = x_E3_y;
    const double x_E3_x = inverse_pivot_E3_x_2*(b_E3_x - u_E3_x__E3_y*x_E3_y - u_E3_x__E4_x*x_E4_x -
        u_E3_x__E4_y*x_E4_y - u_E3_x__E6_x*x_E6_x - u_E3_x__E6_y*x_E6_y);
    x[31] = x_E3_x;
    const double x_F_y = inverse_pivot_F_y_2*(b_F_y - u_F_y__E3_x*x_E3_x - u_F_y__E3_y*x_E3_y -
        u_F_y__E4_x*x_E4_x - u_F_y__E4_y*x_E4_y - u_F_y__E6_x*x_E6_x - u_F_y__E6_y*x_E6_y);
    x[30] = x_F_y;
    const double x_F_x = inverse_pivot_F_x_2*(b_F_x - u_F_x__E3_x*x_E3_x - u_F_x__E3_y*x_E3_y -
        u_F_x__E4_x*x_E4_x - u_F_x__E4_y*x_E4_y - u_F_x__E6_x*x_E6_x - u_F_x__E6_y*x_E6_y - u_F_x__F_y*x_F_y);
    x[29] = x_F_x;
    const double x_FE_theta = inverse_pivot_FE_theta*(b_FE_theta - phi_E3_x_FE_theta*x_E3_x -
        phi_E3_x_FE_theta*x_E4_x - phi_E3_x_FE_theta*x_E6_x - phi_E3_y_FE_theta*x_E3_y -
        phi_E3_y_FE_theta*x_E4_y - phi_E3_y_FE_theta*x_E6_y - phi_F_x_FE_theta*x_F_x -
        phi_F_y_FE_theta*x_F_y);
    x[5] = x_FE_theta;
    const double x_B_y = inverse_pivot_B_y_2*(b_B_y - u_B_y__E3_x*x_E3_x - u_B_y__E3_y*x_E3_y);
    x[24] = x_B_y;
    const double x_B_x = inverse_pivot_B_x_2*(b_B_x - u_B_x__B_y*x_B_y - u_B_x__E3_x*x_E3_x -
        u_B_x__E3_y*x_E3_y);
    x[23] = x_B_x;
    const double x_BDE_theta = inverse_pivot_BDE_theta*(b_BDE_theta - u_BDE_theta__B_x*x_B_x -
        u_BDE_theta__B_y*x_B_y - u_BDE_theta__E3_x*x_E3_x - u_BDE_theta__E3_y*x_E3_y);
    x[8] = x_BDE_theta;
    const double x_BDE_y = inverse_pivot_BDE_y*(b_BDE_y - l_BDE_y__BDE_x*x_B_x - l_BDE_y__BDE_x*x_E3_x -
        u_BDE_y__BDE_theta*x_BDE_theta + x_B_y + x_E3_y);
    x[7] = x_BDE_y;
    const double x_H_y = inverse_pivot_H_y_2*(b_H_y - u_H_y__E6_x*x_E6_x - u_H_y__E6_y*x_E6_y);
    x[40] = x_H_y;
    const double x_H_x = inverse_pivot_H_x_2*(b_H_x - u_H_x__E6_x*x_E6_x - u_H_x__E6_y*x_E6_y -
        u_H_x__H_y*x_H_y);
    x[39] = x_H_x;
    const double x_A7_y = inverse_pivot_A7_y_2*(b_A7_y - u_A7_y__H_x*x_H_x - u_A7_y__H_y*x_H_y);
    x[28] = x_A7_y;
    const double x_A7_x = inverse_pivot_A7_x_2*(b_A7_x - u_A7_x__A7_y*x_A7_y - u_A7_x__H_x*x_H_x -
        u_A7_x__H_y*x_H_y);
    x[27] = x_A7_x;
    const double x_AH_theta = inverse_pivot_AH_theta*(b_AH_theta - phi_A7_x_AH_theta*x_A7_x -
        phi_A7_y_AH_theta*x_A7_y - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y);
    x[20] = x_AH_theta;
    const double x_HE_theta = inverse_pivot_HE_theta*(b_HE_theta - phi_E6_x_HE_theta*x_E6_x -
        phi_E6_y_HE_theta*x_E6_y - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y);
    x[17] = x_HE_theta;
    const double x_G_y = inverse_pivot_G_y_2*(b_G_y - u_G_y__E4_x*x_E4_x - u_G_y__E4_y*x_E4_y);
    x[38] = x_G_y;
    const double x_G_x = inverse_pivot_G_x_2*(b_G_x - u_G_x__E4_x*x_E4_x - u_G_x__E4_y*x_E4_y -
        u_G_x__G_y*x_G_y);
    x[37] = x_G_x;
    const double x_A5_y = inverse_pivot_A5_y_2*(b_A5_y - u_A5_y__G_x*x_G_x - u_A5_y__G_y*x_G_y);
    x[26] = x_A5_y;
    const double x_A5_x = inverse_pivot_A5_x_2*(b_A5_x - u_A5_x__A5_y*x_A5_y - u_A5_x__G_x*x_G_x -
        u_A5_x__G_y*x_G_y);
    x[25] = x_A5_x;
    const double x_AG_theta = inverse_pivot_AG_theta*(b_AG_theta - phi_A5_x_AG_theta*x_A5_x -
        phi_A5_y_AG_theta*x_A5_y - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y);
    x[14] = x_AG_theta;
    const double x_EG_theta = inverse_pivot_EG_theta*(b_EG_theta - phi_E4_x_EG_theta*x_E4_x -
        phi_E4_y_EG_theta*x_E4_y - phi_G_x_EG_theta*x_G_x - phi_G_y_EG_theta*x_G_y);
    x[11] = x_EG_theta;
    const double x_BDE_x = inverse_pivot_BDE_x*(b_BDE_x - n_BDE_x__BDE_theta*x_BDE_theta -
        n_BDE_x__BDE_y*x_BDE_y + x_B_x + x_E3_x);
    x[6] = x_BDE_x;
    const double x_FE_y = inverse_FE_mass*(b_FE_y - x_E3_y - x_E4_y - x_E6_y + x_F_y);
    x[4] = x_FE_y;
    const double x_FE_x = inverse_FE_mass*(b_FE_x - x_E3_x - x_E4_x - x_E6_x + x_F_x);
    x[3] = x_FE_x;
    const double x_O_y = inverse_pivot_O_y_2*(b_O_y - u_O_y__F_x*x_F_x - u_O_y__F_y*x_F_y);
    x[22] = x_O_y;
    const double x_O_x = inverse_pivot_O_x_2*(b_O_x - u_O_x__F_x*x_F_x - u_O_x__F_y*x_F_y - u_O_x__O_y*x_O_y);
    x[21] = x_O_x;
    const double x_OF_theta = inverse_pivot_OF_theta*(b_OF_theta - phi_F_x_OF_theta*x_F_x -
        phi_F_y_OF_theta*x_F_y - phi_O_x_OF_theta*x_O_x - phi_O_y_OF_theta*x_O_y);
    x[2] = x_OF_theta;
    const double x_AH_y = inverse_AH_mass*(b_AH_y + x_A7_y + x_H_y);
    x[19] = x_AH_y;
    const double x_AH_x = inverse_AH_mass*(b_AH_x + x_A7_x + x_H_x);
    x[18] = x_AH_x;
    const double x_HE_y = inverse_HE_mass*(b_HE_y + x_E6_y - x_H_y);
    x[16] = x_HE_y;
    const double x_HE_x = inverse_HE_mass*(b_HE_x + x_E6_x - x_H_x);
    x[15] = x_HE_x;
    const double x_AG_y = inverse_AG_mass*(b_AG_y + x_A5_y + x_G_y);
    x[13] = x_AG_y;
    const double x_AG_x = inverse_AG_mass*(b_AG_x + x_A5_x + x_G_x);
    x[12] = x_AG_x;
    const double x_EG_y = inverse_EG_mass*(b_EG_y + x_E4_y - x_G_y);
    x[10] = x_EG_y;
    const double x_EG_x = inverse_EG_mass*(b_EG_x + x_E4_x - x_G_x);
    x[9] = x_EG_x;
    const double x_OF_y = inverse_OF_mass*(b_OF_y - x_F_y + x_O_y);
    x[1] = x_OF_y;
    const double x_OF_x = inverse_OF_mass*(b_OF_x - x_F_x + x_O_x);
    x[0] = x_OF_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O_x_OF_theta = lin->value[0];
    const double phi_O_y_OF_theta = lin->value[1];
    const double phi_B_x_BDE_theta = lin->value[2];
    const double phi_B_y_BDE_theta = lin->value[3];
    const double phi_A5_x_AG_theta = lin->value[4];
    const double phi_A5_y_AG_theta = lin->value[5];
    const double phi_A7_x_AH_theta = lin->value[6];
    const double phi_A7_y_AH_theta = lin->value[7];
    const double phi_F_x_OF_theta = lin->value[8];
    const double phi_F_x_FE_theta = lin->value[9];
    const double phi_F_y_OF_theta = lin->value[10];
    const double phi_F_y_FE_theta = lin->value[11];
    const double phi_E3_x_FE_theta = lin->value[12];
    const double phi_E3_x_BDE_theta = lin->value[13];
    const double phi_E3_y_FE_theta = lin->value[14];
    const double phi_E3_y_BDE_theta = lin->value[15];
    const double phi_E4_x_EG_theta = lin->value[16];
    const double phi_E4_y_EG_theta = lin->value[17];
    const double phi_E6_x_HE_theta = lin->value[18];
    const double phi_E6_y_HE_theta = lin->value[19];
    const double phi_G_x_EG_theta = lin->value[20];
    const double phi_G_x_AG_theta = lin->value[21];
    const double phi_G_y_EG_theta = lin->value[22];
    const double phi_G_y_AG_theta = lin->value[23];
    const double phi_H_x_HE_theta = lin->value[24];
    const double phi_H_x_AH_theta = lin->value[25];
    const double phi_H_y_HE_theta = lin->value[26];
    const double phi_H_y_AH_theta = lin->value[27];
    const double by_q_O_x_OF_theta = lin->value[28];
    const double by_q_O_y_OF_theta = lin->value[29];
    const double by_q_B_x_BDE_theta = lin->value[30];
    const double by_q_B_y_BDE_theta = lin->value[31];
    const double by_q_A5_x_AG_theta = lin->value[32];
    const double by_q_A5_y_AG_theta = lin->value[33];
    const double by_q_A7_x_AH_theta = lin->value[34];
    const double by_q_A7_y_AH_theta = lin->value[35];
    const double by_q_F_x_FE_theta = lin->value[36];
    const double by_q_F_x_OF_theta = lin->value[37];
    const double by_q_F_y_FE_theta = lin->value[38];
    const double by_q_F_y_OF_theta = lin->value[39];
    const double by_q_E3_x_BDE_theta = lin->value[40];
    const double by_q_E3_x_FE_theta = lin->value[41];
    const double by_q_E3_y_BDE_theta = lin->value[42];
    const double by_q_E3_y_FE_theta = lin->value[43];
    const double by_q_E4_x_EG_theta = lin->value[44];
    const double by_q_E4_y_EG_theta = lin->value[45];
    const double by_q_E6_x_HE_theta = lin->value[46];
    const double by_q_E6_y_HE_theta = lin->value[47];
    const double by_q_G_x_AG_theta = lin->value[48];
    const double by_q_G_x_EG_theta = lin->value[49];
    const double by_q_G_y_AG_theta = lin->value[50];
    const double by_q_G_y_EG_theta = lin->value[51];
    const double by_q_H_x_AH_theta = lin->value[52];
    const double by_q_H_x_HE_theta = lin->value[53];
    const double by_q_H_y_AH_theta = lin->value[54];
    const double by_q_H_y_HE_theta = lin->value[55];
    const double by_q_OF_theta_OF_theta = lin->value[56];
    const double by_q_FE_theta_FE_theta = lin->value[57];
    const double by_q_BDE_x_BDE_x = lin->value[58];
    const double by_q_BDE_x_BDE_theta = lin->value[59];
    const double by_q_BDE_x_BDE_y = lin->value[60];
    const double by_q_BDE_y_BDE_x = lin->value[61];
    const double by_q_BDE_y_BDE_theta = lin->value[62];
    const double by_q_BDE_y_BDE_y = lin->value[63];
    const double by_q_BDE_theta_BDE_theta = lin->value[64];
    const double by_q_BDE_theta_BDE_x = lin->value[65];
    const double by_q_BDE_theta_BDE_y = lin->value[66];
    const double by_q_EG_theta_EG_theta = lin->value[67];
    const double by_q_AG_theta_AG_theta = lin->value[68];
    const double by_q_HE_theta_HE_theta = lin->value[69];
    const double by_q_AH_theta_AH_theta = lin->value[70];

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
    const double motor_value = p->motor_value;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[41];
    const double shifted_OF_x = -beta_squared*eta*r[0] + r[21];
    const double shifted_OF_y = -beta_squared*eta*r[1] + r[22];
    const double shifted_OF_theta = -beta_squared*eta*r[2] + r[23];
    const double shifted_FE_x = -beta_squared*eta*r[3] + r[24];
    const double shifted_FE_y = -beta_squared*eta*r[4] + r[25];
    const double shifted_FE_theta = -beta_squared*eta*r[5] + r[26];
    const double shifted_BDE_x = -beta_squared*eta*r[6] + r[27];
    const double shifted_BDE_y = -beta_squared*eta*r[7] + r[28];
    const double shifted_BDE_theta = -beta_squared*eta*r[8] + r[29];
    const double shifted_EG_x = -beta_squared*eta*r[9] + r[30];
    const double shifted_EG_y = -beta_squared*eta*r[10] + r[31];
    const double shifted_EG_theta = -beta_squared*eta*r[11] + r[32];
    const double shifted_AG_x = -beta_squared*eta*r[12] + r[33];
    const double shifted_AG_y = -beta_squared*eta*r[13] + r[34];
    const double shifted_AG_theta = -beta_squared*eta*r[14] + r[35];
    const double shifted_HE_x = -beta_squared*eta*r[15] + r[36];
    const double shifted_HE_y = -beta_squared*eta*r[16] + r[37];
    const double shifted_HE_theta = -beta_squared*eta*r[17] + r[38];
    const double shifted_AH_x = -beta_squared*eta*r[18] + r[39];
    const double shifted_AH_y = -beta_squared*eta*r[19] + r[40];
    const double shifted_AH_theta = -beta_squared*eta*r[20] + r[41];
    x[0] = OF_mass*eta*r[21];
    x[1] = OF_mass*eta*r[22];
    x[2] = eta*(OF_inertia*r[23] - by_q_OF_theta_OF_theta*eta*r[2]);
    x[3] = FE_mass*eta*r[24];
    x[4] = FE_mass*eta*r[25];
    x[5] = eta*(FE_inertia*r[26] - by_q_FE_theta_FE_theta*eta*r[5]);
    x[6] = eta*(BDE_mass*r[27] - by_q_BDE_x_BDE_theta*eta*r[8] - by_q_BDE_x_BDE_x*eta*r[6] -
        by_q_BDE_x_BDE_y*eta*r[7]);
    x[7] = eta*(BDE_mass*r[28] - by_q_BDE_y_BDE_theta*eta*r[8] - by_q_BDE_y_BDE_x*eta*r[6] -
        by_q_BDE_y_BDE_y*eta*r[7]);
    x[8] = eta*(BDE_inertia*r[29] - by_q_BDE_theta_BDE_theta*eta*r[8] - by_q_BDE_theta_BDE_x*eta*r[6] -
        by_q_BDE_theta_BDE_y*eta*r[7]);
    x[9] = EG_mass*eta*r[30];
    x[10] = EG_mass*eta*r[31];
    x[11] = eta*(EG_inertia*r[32] - by_q_EG_theta_EG_theta*eta*r[11]);
    x[12] = AG_mass*eta*r[33];
    x[13] = AG_mass*eta*r[34];
    x[14] = eta*(AG_inertia*r[35] - by_q_AG_theta_AG_theta*eta*r[14]);
    x[15] = HE_mass*eta*r[36];
    x[16] = HE_mass*eta*r[37];
    x[17] = eta*(HE_inertia*r[38] - by_q_HE_theta_HE_theta*eta*r[17]);
    x[18] = AH_mass*eta*r[39];
    x[19] = AH_mass*eta*r[40];
    x[20] = eta*(AH_inertia*r[41] - by_q_AH_theta_AH_theta*eta*r[20]);
    x[21] = eta_row*(-by_q_O_x_OF_theta*eta*r[2] + phi_O_x_OF_theta*shifted_OF_theta - shifted_OF_x);
    x[22] = eta_row*(-by_q_O_y_OF_theta*eta*r[2] + phi_O_y_OF_theta*shifted_OF_theta - shifted_OF_y);
    x[23] = eta_row*(-by_q_B_x_BDE_theta*eta*r[8] + phi_B_x_BDE_theta*shifted_BDE_theta - shifted_BDE_x);
    x[24] = eta_row*(-by_q_B_y_BDE_theta*eta*r[8] + phi_B_y_BDE_theta*shifted_BDE_theta - shifted_BDE_y);
    x[25] = eta_row*(-by_q_A5_x_AG_theta*eta*r[14] + phi_A5_x_AG_theta*shifted_AG_theta - shifted_AG_x);
    x[26] = eta_row*(-by_q_A5_y_AG_theta*eta*r[14] + phi_A5_y_AG_theta*shifted_AG_theta - shifted_AG_y);
    x[27] = eta_row*(-by_q_A7_x_AH_theta*eta*r[20] + phi_A7_x_AH_theta*shifted_AH_theta - shifted_AH_x);
    x[28] = eta_row*(-by_q_A7_y_AH_theta*eta*r[20] + phi_A7_y_AH_theta*shifted_AH_theta - shifted_AH_y);
    x[29] = eta_row*(-by_q_F_x_FE_theta*eta*r[5] - by_q_F_x_OF_theta*eta*r[2] +
        phi_F_x_FE_theta*shifted_FE_theta + phi_F_x_OF_theta*shifted_OF_theta - shifted_FE_x + shifted_OF_x);
    x[30] = eta_row*(-by_q_F_y_FE_theta*eta*r[5] - by_q_F_y_OF_theta*eta*r[2] +
        phi_F_y_FE_theta*shifted_FE_theta + phi_F_y_OF_theta*shifted_OF_theta - shifted_FE_y + shifted_OF_y);
    x[31] = eta_row*(-by_q_E3_x_BDE_theta*eta*r[8] - by_q_E3_x_FE_theta*eta*r[5] +
        phi_E3_x_BDE_theta*shifted_BDE_theta + phi_E3_x_FE_theta*shifted_FE_theta - shifted_BDE_x +
        shifted_FE_x);
    x[32] = eta_row*(-by_q_E3_y_BDE_theta*eta*r[8] - by_q_E3_y_FE_theta*eta*r[5] +
        phi_E3_y_BDE_theta*shifted_BDE_theta + phi_E3_y_FE_theta*shifted_FE_theta - shifted_BDE_y +
        shifted_FE_y);
    x[33] = eta_row*(-by_q_E3_x_FE_theta*eta*r[5] - by_q_E4_x_EG_theta*eta*r[11] +
        phi_E3_x_FE_theta*shifted_FE_theta + phi_E4_x_EG_theta*shifted_EG_theta - shifted_EG_x +
        shifted_FE_x);
    x[34] = eta_row*(-by_q_E3_y_FE_theta*eta*r[5] - by_q_E4_y_EG_theta*eta*r[11] +
        phi_E3_y_FE_theta*shifted_FE_theta + phi_E4_y_EG_theta*shifted_EG_theta - shifted_EG_y +
        shifted_FE_y);
    x[35] = eta_row*(-by_q_E3_x_FE_theta*eta*r[5] - by_q_E6_x_HE_theta*eta*r[17] +
        phi_E3_x_FE_theta*shifted_FE_theta + phi_E6_x_HE_theta*shifted_HE_theta + shifted_FE_x -
        shifted_HE_x);
    x[36] = eta_row*(-by_q_E3_y_FE_theta*eta*r[5] - by_q_E6_y_HE_theta*eta*r[17] +
        phi_E3_y_FE_theta*shifted_FE_theta + phi_E6_y_HE_theta*shifted_HE_theta + shifted_FE_y -
        shifted_HE_y);
    x[37] = eta_row*(-by_q_G_x_AG_theta*eta*r[14] - by_q_G_x_EG_theta*eta*r[11] +
        phi_G_x_AG_theta*shifted_AG_theta + phi_G_x_EG_theta*shifted_EG_theta - shifted_AG_x + shifted_EG_x);
    x[38] = eta_row*(-by_q_G_y_AG_theta*eta*r[14] - by_q_G_y_EG_theta*eta*r[11] +
        phi_G_y_AG_theta*shifted_AG_theta + phi_G_y_EG_theta*shifted_EG_theta - shifted_AG_y + shifted_EG_y);
    x[39] = eta_row*(-by_q_H_x_AH_theta*eta*r[20] - by_q_H_x_HE_theta*eta*r[17] +
        phi_H_x_AH_theta*shifted_AH_theta + phi_H_x_HE_theta*shifted_HE_theta - shifted_AH_x + shifted_HE_x);
    x[40] = eta_row*(-by_q_H_y_AH_theta*eta*r[20] - by_q_H_y_HE_theta*eta*r[17] +
        phi_H_y_AH_theta*shifted_AH_theta + phi_H_y_HE_theta*shifted_HE_theta - shifted_AH_y + shifted_HE_y);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[21] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[22] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[23] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[24] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[25] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[26] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[27] = x[6];
    u[7] = eta*(r[7] + x[7]);
    u[28] = x[7];
    u[8] = eta*(r[8] + x[8]);
    u[29] = x[8];
    u[9] = eta*(r[9] + x[9]);
    u[30] = x[9];
    u[10] = eta*(r[10] + x[10]);
    u[31] = x[10];
    u[11] = eta*(r[11] + x[11]);
    u[32] = x[11];
    u[12] = eta*(r[12] + x[12]);
    u[33] = x[12];
    u[13] = eta*(r[13] + x[13]);
    u[34] = x[13];
    u[14] = eta*(r[14] + x[14]);
    u[35] = x[14];
    u[15] = eta*(r[15] + x[15]);
    u[36] = x[15];
    u[16] = eta*(r[16] + x[16]);
    u[37] = x[16];
    u[17] = eta*(r[17] + x[17]);
    u[38] = x[17];
    u[18] = eta*(r[18] + x[18]);
    u[39] = x[18];
    u[19] = eta*(r[19] + x[19]);
    u[40] = x[19];
    u[20] = eta*(r[20] + x[20]);
    u[41] = x[20];
    u[42] = eta*r[42];
    u[43] = eta*(motor_value*u[23] + r[43]);
    u[44] = eta*r[44];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {21, 0, 99, 1}, {21, 2, 0, 1}, {22, 1, 99, 1}, {22, 2, 1, 1}, {23, 6, 99, 1}, {23, 8, 2, 1}, {24, 7, 99,
    1}, {24, 8, 3, 1}, {25, 12, 99, 1}, {25, 14, 4, 1}, {26, 13, 99, 1}, {26, 14, 5, 1}, {27, 18, 99, 1}, {27,
    20, 6, 1}, {28, 19, 99, 1}, {28, 20, 7, 1}, {29, 0, 99, -1}, {29, 2, 8, 1}, {29, 3, 99, 1}, {29, 5, 9, 1},
    {30, 1, 99, -1}, {30, 2, 10, 1}, {30, 4, 99, 1}, {30, 5, 11, 1}, {31, 3, 99, -1}, {31, 5, 12, 1}, {31, 6,
    99, 1}, {31, 8, 13, 1}, {32, 4, 99, -1}, {32, 5, 14, 1}, {32, 7, 99, 1}, {32, 8, 15, 1}, {33, 3, 99, -1},
    {33, 5, 12, 1}, {33, 9, 99, 1}, {33, 11, 16, 1}, {34, 4, 99, -1}, {34, 5, 14, 1}, {34, 10, 99, 1}, {34,
    11, 17, 1}, {35, 3, 99, -1}, {35, 5, 12, 1}, {35, 15, 99, 1}, {35, 17, 18, 1}, {36, 4, 99, -1}, {36, 5,
    14, 1}, {36, 16, 99, 1}, {36, 17, 19, 1}, {37, 9, 99, -1}, {37, 11, 20, 1}, {37, 12, 99, 1}, {37, 14, 21,
    1}, {38, 10, 99, -1}, {38, 11, 22, 1}, {38, 13, 99, 1}, {38, 14, 23, 1}, {39, 15, 99, -1}, {39, 17, 24,
    1}, {39, 18, 99, 1}, {39, 20, 25, 1}, {40, 16, 99, -1}, {40, 17, 26, 1}, {40, 19, 99, 1}, {40, 20, 27, 1}
};
static const LinearEntry residual_entries[] = {
    {21, 2, 28, 1}, {22, 2, 29, 1}, {23, 8, 30, 1}, {24, 8, 31, 1}, {25, 14, 32, 1}, {26, 14, 33, 1}, {27, 20,
    34, 1}, {28, 20, 35, 1}, {29, 5, 36, 1}, {29, 2, 37, 1}, {30, 5, 38, 1}, {30, 2, 39, 1}, {31, 8, 40, 1},
    {31, 5, 41, 1}, {32, 8, 42, 1}, {32, 5, 43, 1}, {33, 11, 44, 1}, {33, 5, 41, 1}, {34, 11, 45, 1}, {34, 5,
    43, 1}, {35, 5, 41, 1}, {35, 17, 46, 1}, {36, 5, 43, 1}, {36, 17, 47, 1}, {37, 14, 48, 1}, {37, 11, 49,
    1}, {38, 14, 50, 1}, {38, 11, 51, 1}, {39, 20, 52, 1}, {39, 17, 53, 1}, {40, 20, 54, 1}, {40, 17, 55, 1},
    {2, 2, 56, 1}, {5, 5, 57, 1}, {6, 6, 58, 1}, {6, 8, 59, 1}, {6, 7, 60, 1}, {7, 6, 61, 1}, {7, 8, 62, 1},
    {7, 7, 63, 1}, {8, 8, 64, 1}, {8, 6, 65, 1}, {8, 7, 66, 1}, {11, 11, 67, 1}, {14, 14, 68, 1}, {17, 17, 69,
    1}, {20, 20, 70, 1}, {21, 23, 71, 1}, {22, 23, 72, 1}, {23, 29, 73, 1}, {24, 29, 74, 1}, {25, 35, 75, 1},
    {26, 35, 76, 1}, {27, 41, 77, 1}, {28, 41, 78, 1}, {29, 26, 79, 1}, {29, 23, 80, 1}, {30, 26, 81, 1}, {30,
    23, 82, 1}, {31, 29, 83, 1}, {31, 26, 84, 1}, {32, 29, 85, 1}, {32, 26, 86, 1}, {33, 32, 87, 1}, {33, 26,
    84, 1}, {34, 32, 88, 1}, {34, 26, 86, 1}, {35, 26, 84, 1}, {35, 38, 89, 1}, {36, 26, 86, 1}, {36, 38, 90,
    1}, {37, 35, 91, 1}, {37, 32, 92, 1}, {38, 35, 93, 1}, {38, 32, 94, 1}, {39, 41, 95, 1}, {39, 38, 96, 1},
    {40, 41, 97, 1}, {40, 38, 98, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 23, 100, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 64,
    N_RESIDUAL = 79,
    N_RESIDUAL_T = 0,
    N_POWER = 1,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 41,
};
/*
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_Q - 1) or of R1_t, R2_t (2 N_Q); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_Q; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_Q; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_Q && (column >= N_Q || at->row < N_Q + N_ROWS)) {
            x[at->row] -= gain[column / N_Q] * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_Q; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_Q; k++) {
        out[k * stride] = column == N_Q + k ? 1.0 : 0.0;
        out[(N_Q + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_Q + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_Q + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_Q + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_Q; i++)
        out[(2 * N_Q + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now;
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = state_equation(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_Q, &now, p, dy + N_Q, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {((const Parameters *)p)->beta_squared, ((const Parameters *)p)->two_alpha};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_Q; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_Q ? J + column : f_t, column < 2 * N_Q ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_Q + w] = 0.0;
    return 0;
}

/* (1/eta - J) u = r + s f_t at a state. */
int gudgeon_newton(double t, const double *y, const double *memory, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear lin;
    const int status = linearized(t, y, memory, (const Parameters *)p, eta, &lin);
    if (status)
        return status;
    newton_solve(&lin, eta, s, r, u);
    return 0;
}
