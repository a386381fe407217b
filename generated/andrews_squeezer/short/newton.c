/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
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
    const double a_OF_theta = a[0];
    const double a_BDE_theta = a[1];
    const double a_AG_theta = a[2];
    const double a_AH_theta = a[3];
    const double a_FE_theta = a[4];
    const double a_HE_theta = a[5];
    const double a_EG_theta = a[6];
    const double held_lambda_G_x = aside->lambda[0];
    const double held_lambda_G_y = aside->lambda[1];
    const double held_lambda_H_x = aside->lambda[2];
    const double held_lambda_H_y = aside->lambda[3];
    const double held_lambda_E3_x = aside->lambda[4];
    const double held_lambda_E3_y = aside->lambda[5];

    /* directions, arms, drives */
    const double cos_theta_OF = cos(OF_theta);
    const double sin_theta_OF = sin(OF_theta);
    const double cos_theta_BDE = cos(BDE_theta);
    const double sin_theta_BDE = sin(BDE_theta);
    const double cos_theta_AG = cos(AG_theta);
    const double sin_theta_AG = sin(AG_theta);
    const double cos_theta_AH = cos(AH_theta);
    const double sin_theta_AH = sin(AH_theta);
    const double cos_theta_FE = cos(FE_theta);
    const double sin_theta_FE = sin(FE_theta);
    const double cos_theta_HE = cos(HE_theta);
    const double sin_theta_HE = sin(HE_theta);
    const double cos_theta_EG = cos(EG_theta);
    const double sin_theta_EG = sin(EG_theta);
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

    /* coordinates */
    const double inverse_sum = 1.0/(spring_length + 1e-150);
    const double spring_length_by_BDE_theta = inverse_sum*span_BDE_D_x*spring_span_y
        - inverse_sum*span_BDE_D_y*spring_span_x;
    const double spring_force_by_BDE_theta = spring_length_by_BDE_theta*p->spring_stiffness;
    const double inverse_spring_length = 1.0/spring_length;
    const double spring_pull_by_BDE_theta = -(inverse_spring_length
        * inverse_spring_length)*spring_force*spring_length_by_BDE_theta
        + inverse_spring_length*spring_force_by_BDE_theta;

    /* results */
    lin->value[0] = dot_OF_FE;
    lin->value[1] = dot_OF_EG;
    lin->value[2] = dot_FE_EG;
    lin->value[3] = dot_BDE_HE;
    lin->value[4] = -span_OF_F_y;
    lin->value[5] = span_AG_G_y;
    lin->value[6] = -span_FE_E_y;
    lin->value[7] = -span_EG_G_y;
    lin->value[8] = span_OF_F_x;
    lin->value[9] = -span_AG_G_x;
    lin->value[10] = span_FE_E_x;
    lin->value[11] = span_EG_G_x;
    lin->value[12] = -span_BDE_E_y;
    lin->value[13] = span_AH_H_y;
    lin->value[14] = -span_HE_H_y;
    lin->value[15] = span_BDE_E_x;
    lin->value[16] = -span_AH_H_x;
    lin->value[17] = span_HE_H_x;
    lin->value[18] = -(AG_omega * AG_omega)*span_AG_G_y + AG_omega*span_AG_G_x*p->two_alpha + a_AG_theta*span_AG_G_x;
    lin->value[19] = (EG_omega * EG_omega)*span_EG_G_y - EG_omega*span_EG_G_x*p->two_alpha - a_EG_theta*span_EG_G_x;
    lin->value[20] = (FE_omega * FE_omega)*span_FE_E_y - FE_omega*span_FE_E_x*p->two_alpha - a_FE_theta*span_FE_E_x;
    lin->value[21] = (OF_omega * OF_omega)*span_OF_F_y - OF_omega*span_OF_F_x*p->two_alpha - a_OF_theta*span_OF_F_x;
    lin->value[22] = (AG_omega * AG_omega)*span_AG_G_x + AG_omega*span_AG_G_y*p->two_alpha + a_AG_theta*span_AG_G_y;
    lin->value[23] = -(EG_omega * EG_omega)*span_EG_G_x - EG_omega*span_EG_G_y*p->two_alpha - a_EG_theta*span_EG_G_y;
    lin->value[24] = -(FE_omega * FE_omega)*span_FE_E_x - FE_omega*span_FE_E_y*p->two_alpha - a_FE_theta*span_FE_E_y;
    lin->value[25] = -(OF_omega * OF_omega)*span_OF_F_x - OF_omega*span_OF_F_y*p->two_alpha - a_OF_theta*span_OF_F_y;
    lin->value[26] = -(AH_omega * AH_omega)*span_AH_H_y + AH_omega*span_AH_H_x*p->two_alpha + a_AH_theta*span_AH_H_x;
    lin->value[27] = (BDE_omega * BDE_omega)*span_BDE_E_y - BDE_omega*span_BDE_E_x*p->two_alpha
        - a_BDE_theta*span_BDE_E_x;
    lin->value[28] = (HE_omega * HE_omega)*span_HE_H_y - HE_omega*span_HE_H_x*p->two_alpha - a_HE_theta*span_HE_H_x;
    lin->value[29] = (AH_omega * AH_omega)*span_AH_H_x + AH_omega*span_AH_H_y*p->two_alpha + a_AH_theta*span_AH_H_y;
    lin->value[30] = -(BDE_omega * BDE_omega)*span_BDE_E_x - BDE_omega*span_BDE_E_y*p->two_alpha
        - a_BDE_theta*span_BDE_E_y;
    lin->value[31] = -(HE_omega * HE_omega)*span_HE_H_x - HE_omega*span_HE_H_y*p->two_alpha - a_HE_theta*span_HE_H_y;
    lin->value[32] = (EG_omega * EG_omega)*dot_OF_EG + (FE_omega * FE_omega)*dot_OF_FE + a_EG_theta*cross_OF_EG
        + a_FE_theta*cross_OF_FE + span_OF_F_x*(-held_lambda_E3_x - held_lambda_G_x)
        - span_OF_F_y*(held_lambda_E3_y + held_lambda_G_y);
    lin->value[33] = -(EG_omega * EG_omega)*dot_OF_EG - a_EG_theta*cross_OF_EG;
    lin->value[34] = -(FE_omega * FE_omega)*dot_OF_FE - a_FE_theta*cross_OF_FE;
    lin->value[35] = (HE_omega * HE_omega)*dot_BDE_HE + a_HE_theta*cross_BDE_HE
        + (span_BDE_D_x * span_BDE_D_x)*spring_pull - span_BDE_D_x*spring_pull*spring_span_x
        + (span_BDE_D_y * span_BDE_D_y)*spring_pull - span_BDE_D_y*spring_pull*spring_span_y
        + span_BDE_E_x*(held_lambda_E3_x - held_lambda_H_x) - span_BDE_E_y*(-held_lambda_E3_y + held_lambda_H_y)
        + spring_pull_by_BDE_theta*(span_BDE_D_x*spring_span_y - span_BDE_D_y*spring_span_x);
    lin->value[36] = -(HE_omega * HE_omega)*dot_BDE_HE - a_HE_theta*cross_BDE_HE;
    lin->value[37] = held_lambda_G_x*span_AG_G_x + held_lambda_G_y*span_AG_G_y;
    lin->value[38] = held_lambda_H_x*span_AH_H_x + held_lambda_H_y*span_AH_H_y;
    lin->value[39] = (EG_omega * EG_omega)*dot_FE_EG + (OF_omega * OF_omega)*dot_OF_FE + a_EG_theta*cross_FE_EG
        - a_OF_theta*cross_OF_FE + span_FE_E_x*(-held_lambda_E3_x - held_lambda_G_x)
        - span_FE_E_y*(held_lambda_E3_y + held_lambda_G_y);
    lin->value[40] = -(EG_omega * EG_omega)*dot_FE_EG - a_EG_theta*cross_FE_EG;
    lin->value[41] = -(OF_omega * OF_omega)*dot_OF_FE + a_OF_theta*cross_OF_FE;
    lin->value[42] = -(BDE_omega * BDE_omega)*dot_BDE_HE + a_BDE_theta*cross_BDE_HE;
    lin->value[43] = (BDE_omega * BDE_omega)*dot_BDE_HE - a_BDE_theta*cross_BDE_HE - held_lambda_H_x*span_HE_H_x
        - held_lambda_H_y*span_HE_H_y;
    lin->value[44] = -(FE_omega * FE_omega)*dot_FE_EG + a_FE_theta*cross_FE_EG;
    lin->value[45] = (FE_omega * FE_omega)*dot_FE_EG + (OF_omega * OF_omega)*dot_OF_EG - a_FE_theta*cross_FE_EG
        - a_OF_theta*cross_OF_EG - held_lambda_G_x*span_EG_G_x - held_lambda_G_y*span_EG_G_y;
    lin->value[46] = -(OF_omega * OF_omega)*dot_OF_EG + a_OF_theta*cross_OF_EG;
    lin->value[47] = 2.0*AG_omega*span_AG_G_x;
    lin->value[48] = -2.0*EG_omega*span_EG_G_x;
    lin->value[49] = -2.0*FE_omega*span_FE_E_x;
    lin->value[50] = -2.0*OF_omega*span_OF_F_x;
    lin->value[51] = 2.0*AG_omega*span_AG_G_y;
    lin->value[52] = -2.0*EG_omega*span_EG_G_y;
    lin->value[53] = -2.0*FE_omega*span_FE_E_y;
    lin->value[54] = -2.0*OF_omega*span_OF_F_y;
    lin->value[55] = 2.0*AH_omega*span_AH_H_x;
    lin->value[56] = -2.0*BDE_omega*span_BDE_E_x;
    lin->value[57] = -2.0*HE_omega*span_HE_H_x;
    lin->value[58] = 2.0*AH_omega*span_AH_H_y;
    lin->value[59] = -2.0*BDE_omega*span_BDE_E_y;
    lin->value[60] = -2.0*HE_omega*span_HE_H_y;
    lin->value[61] = -2.0*EG_omega*cross_OF_EG;
    lin->value[62] = -2.0*FE_omega*cross_OF_FE;
    lin->value[63] = -2.0*HE_omega*cross_BDE_HE;
    lin->value[64] = -2.0*EG_omega*cross_FE_EG;
    lin->value[65] = 2.0*OF_omega*cross_OF_FE;
    lin->value[66] = 2.0*BDE_omega*cross_BDE_HE;
    lin->value[67] = 2.0*FE_omega*cross_FE_EG;
    lin->value[68] = 2.0*OF_omega*cross_OF_EG;
    lin->value[69] = p->motor_value;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor(double eta, Linear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_OF_theta_FE_theta = lin->value[0];
    const double mass_OF_theta_EG_theta = lin->value[1];
    const double mass_FE_theta_EG_theta = lin->value[2];
    const double mass_BDE_theta_HE_theta = lin->value[3];
    const double phi_G_x_OF_theta = lin->value[4];
    const double phi_G_x_AG_theta = lin->value[5];
    const double phi_G_x_FE_theta = lin->value[6];
    const double phi_G_x_EG_theta = lin->value[7];
    const double phi_G_y_OF_theta = lin->value[8];
    const double phi_G_y_AG_theta = lin->value[9];
    const double phi_G_y_FE_theta = lin->value[10];
    const double phi_G_y_EG_theta = lin->value[11];
    const double phi_H_x_BDE_theta = lin->value[12];
    const double phi_H_x_AH_theta = lin->value[13];
    const double phi_H_x_HE_theta = lin->value[14];
    const double phi_H_y_BDE_theta = lin->value[15];
    const double phi_H_y_AH_theta = lin->value[16];
    const double phi_H_y_HE_theta = lin->value[17];
    const double by_q_G_x_AG_theta = lin->value[18];
    const double by_q_G_x_EG_theta = lin->value[19];
    const double by_q_G_x_FE_theta = lin->value[20];
    const double by_q_G_x_OF_theta = lin->value[21];
    const double by_q_G_y_AG_theta = lin->value[22];
    const double by_q_G_y_EG_theta = lin->value[23];
    const double by_q_G_y_FE_theta = lin->value[24];
    const double by_q_G_y_OF_theta = lin->value[25];
    const double by_q_H_x_AH_theta = lin->value[26];
    const double by_q_H_x_BDE_theta = lin->value[27];
    const double by_q_H_x_HE_theta = lin->value[28];
    const double by_q_H_y_AH_theta = lin->value[29];
    const double by_q_H_y_BDE_theta = lin->value[30];
    const double by_q_H_y_HE_theta = lin->value[31];
    const double by_q_OF_theta_OF_theta = lin->value[32];
    const double by_q_OF_theta_EG_theta = lin->value[33];
    const double by_q_OF_theta_FE_theta = lin->value[34];
    const double by_q_BDE_theta_BDE_theta = lin->value[35];
    const double by_q_BDE_theta_HE_theta = lin->value[36];
    const double by_q_AG_theta_AG_theta = lin->value[37];
    const double by_q_AH_theta_AH_theta = lin->value[38];
    const double by_q_FE_theta_FE_theta = lin->value[39];
    const double by_q_FE_theta_EG_theta = lin->value[40];
    const double by_q_FE_theta_OF_theta = lin->value[41];
    const double by_q_HE_theta_BDE_theta = lin->value[42];
    const double by_q_HE_theta_HE_theta = lin->value[43];
    const double by_q_EG_theta_FE_theta = lin->value[44];
    const double by_q_EG_theta_EG_theta = lin->value[45];
    const double by_q_EG_theta_OF_theta = lin->value[46];
    const double by_v_G_x_AG_theta = lin->value[47];
    const double by_v_G_x_EG_theta = lin->value[48];
    const double by_v_G_x_FE_theta = lin->value[49];
    const double by_v_G_x_OF_theta = lin->value[50];
    const double by_v_G_y_AG_theta = lin->value[51];
    const double by_v_G_y_EG_theta = lin->value[52];
    const double by_v_G_y_FE_theta = lin->value[53];
    const double by_v_G_y_OF_theta = lin->value[54];
    const double by_v_H_x_AH_theta = lin->value[55];
    const double by_v_H_x_BDE_theta = lin->value[56];
    const double by_v_H_x_HE_theta = lin->value[57];
    const double by_v_H_y_AH_theta = lin->value[58];
    const double by_v_H_y_BDE_theta = lin->value[59];
    const double by_v_H_y_HE_theta = lin->value[60];
    const double by_v_OF_theta_EG_theta = lin->value[61];
    const double by_v_OF_theta_FE_theta = lin->value[62];
    const double by_v_BDE_theta_HE_theta = lin->value[63];
    const double by_v_FE_theta_EG_theta = lin->value[64];
    const double by_v_FE_theta_OF_theta = lin->value[65];
    const double by_v_HE_theta_BDE_theta = lin->value[66];
    const double by_v_EG_theta_FE_theta = lin->value[67];
    const double by_v_EG_theta_OF_theta = lin->value[68];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_OF_theta__OF_theta = by_q_OF_theta_OF_theta*(eta * eta) + p->mass_OF_OF;
    const double n_OF_theta__FE_theta = eta*(by_q_OF_theta_FE_theta*eta + by_v_OF_theta_FE_theta)
        + mass_OF_theta_FE_theta;
    const double n_OF_theta__EG_theta = eta*(by_q_OF_theta_EG_theta*eta + by_v_OF_theta_EG_theta)
        + mass_OF_theta_EG_theta;
    const double n_BDE_theta__BDE_theta = by_q_BDE_theta_BDE_theta*(eta * eta) + p->mass_BDE_BDE;
    const double n_BDE_theta__HE_theta = eta*(by_q_BDE_theta_HE_theta*eta + by_v_BDE_theta_HE_theta)
        + mass_BDE_theta_HE_theta;
    const double n_AG_theta__AG_theta = by_q_AG_theta_AG_theta*(eta * eta) + p->mass_AG_AG;
    const double n_AH_theta__AH_theta = by_q_AH_theta_AH_theta*(eta * eta) + p->mass_AH_AH;
    const double n_FE_theta__OF_theta = eta*(by_q_FE_theta_OF_theta*eta + by_v_FE_theta_OF_theta)
        + mass_OF_theta_FE_theta;
    const double n_FE_theta__FE_theta = by_q_FE_theta_FE_theta*(eta * eta) + p->mass_FE_FE;
    const double n_FE_theta__EG_theta = eta*(by_q_FE_theta_EG_theta*eta + by_v_FE_theta_EG_theta)
        + mass_FE_theta_EG_theta;
    const double n_HE_theta__BDE_theta = eta*(by_q_HE_theta_BDE_theta*eta + by_v_HE_theta_BDE_theta)
        + mass_BDE_theta_HE_theta;
    const double n_HE_theta__HE_theta = by_q_HE_theta_HE_theta*(eta * eta) + p->mass_HE_HE;
    const double n_EG_theta__OF_theta = eta*(by_q_EG_theta_OF_theta*eta + by_v_EG_theta_OF_theta)
        + mass_OF_theta_EG_theta;
    const double n_EG_theta__FE_theta = eta*(by_q_EG_theta_FE_theta*eta + by_v_EG_theta_FE_theta)
        + mass_FE_theta_EG_theta;
    const double n_EG_theta__EG_theta = by_q_EG_theta_EG_theta*(eta * eta) + p->mass_EG_EG;
    const double n_G_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const double n_G_x__AG_theta = eta_row*(by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta) + phi_G_x_AG_theta;
    const double n_G_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const double n_G_x__EG_theta = eta_row*(by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta) + phi_G_x_EG_theta;
    const double n_G_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const double n_G_y__AG_theta = eta_row*(by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta) + phi_G_y_AG_theta;
    const double n_G_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;
    const double n_G_y__EG_theta = eta_row*(by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta) + phi_G_y_EG_theta;
    const double n_H_x__BDE_theta = eta_row*(by_q_H_x_BDE_theta*eta + by_v_H_x_BDE_theta) + phi_H_x_BDE_theta;
    const double n_H_x__AH_theta = eta_row*(by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta) + phi_H_x_AH_theta;
    const double n_H_x__HE_theta = eta_row*(by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta) + phi_H_x_HE_theta;
    const double n_H_y__BDE_theta = eta_row*(by_q_H_y_BDE_theta*eta + by_v_H_y_BDE_theta) + phi_H_y_BDE_theta;
    const double n_H_y__AH_theta = eta_row*(by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta) + phi_H_y_AH_theta;
    const double n_H_y__HE_theta = eta_row*(by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta) + phi_H_y_HE_theta;
    const double n_E3_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const double n_E3_x__BDE_theta = eta_row*(-by_q_H_x_BDE_theta*eta - by_v_H_x_BDE_theta) - phi_H_x_BDE_theta;
    const double n_E3_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const double n_E3_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const double n_E3_y__BDE_theta = eta_row*(-by_q_H_y_BDE_theta*eta - by_v_H_y_BDE_theta) - phi_H_y_BDE_theta;
    const double n_E3_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;

    /* L U */
    const double scale_AG_theta = n_AG_theta__AG_theta;
    if (!(fabs(scale_AG_theta) > SINGULAR * fabs(n_AG_theta__AG_theta)))
        return 3;
    const double inverse_pivot_AG_theta = 1.0/scale_AG_theta;
    lin->lu[0] = inverse_pivot_AG_theta;
    const double l_G_x__AG_theta = inverse_pivot_AG_theta*n_G_x__AG_theta;
    lin->lu[1] = l_G_x__AG_theta;
    const double l_G_y__AG_theta = inverse_pivot_AG_theta*n_G_y__AG_theta;
    lin->lu[2] = l_G_y__AG_theta;
    const double scale_AH_theta = n_AH_theta__AH_theta;
    if (!(fabs(scale_AH_theta) > SINGULAR * fabs(n_AH_theta__AH_theta)))
        return 4;
    const double inverse_pivot_AH_theta = 1.0/scale_AH_theta;
    lin->lu[3] = inverse_pivot_AH_theta;
    const double l_H_x__AH_theta = inverse_pivot_AH_theta*n_H_x__AH_theta;
    lin->lu[4] = l_H_x__AH_theta;
    const double l_H_y__AH_theta = inverse_pivot_AH_theta*n_H_y__AH_theta;
    lin->lu[5] = l_H_y__AH_theta;
    const double scale_HE_theta = n_HE_theta__HE_theta;
    if (!(fabs(scale_HE_theta) > SINGULAR * fabs(n_HE_theta__HE_theta)))
        return 6;
    const double inverse_pivot_HE_theta = 1.0/scale_HE_theta;
    lin->lu[6] = inverse_pivot_HE_theta;
    const double l_BDE_theta__HE_theta = inverse_pivot_HE_theta*n_BDE_theta__HE_theta;
    lin->lu[7] = l_BDE_theta__HE_theta;
    lin->lu[8] = n_HE_theta__BDE_theta;
    const double l_H_x__HE_theta = inverse_pivot_HE_theta*n_H_x__HE_theta;
    lin->lu[9] = l_H_x__HE_theta;
    const double l_H_y__HE_theta = inverse_pivot_HE_theta*n_H_y__HE_theta;
    lin->lu[10] = l_H_y__HE_theta;
    const double scale_BDE_theta = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta + n_BDE_theta__BDE_theta;
    if (!(fabs(scale_BDE_theta) > SINGULAR * fabs(n_BDE_theta__BDE_theta)))
        return 2;
    const double inverse_pivot_BDE_theta = 1.0/scale_BDE_theta;
    lin->lu[11] = inverse_pivot_BDE_theta;
    const double l_H_x__BDE_theta = inverse_pivot_BDE_theta*(-l_H_x__HE_theta*n_HE_theta__BDE_theta + n_H_x__BDE_theta);
    lin->lu[12] = l_H_x__BDE_theta;
    const double u_BDE_theta__H_x = -l_BDE_theta__HE_theta*phi_H_x_HE_theta + phi_H_x_BDE_theta;
    lin->lu[13] = u_BDE_theta__H_x;
    const double l_H_y__BDE_theta = inverse_pivot_BDE_theta*(-l_H_y__HE_theta*n_HE_theta__BDE_theta + n_H_y__BDE_theta);
    lin->lu[14] = l_H_y__BDE_theta;
    const double u_BDE_theta__H_y = -l_BDE_theta__HE_theta*phi_H_y_HE_theta + phi_H_y_BDE_theta;
    lin->lu[15] = u_BDE_theta__H_y;
    const double l_E3_x__BDE_theta = inverse_pivot_BDE_theta*n_E3_x__BDE_theta;
    lin->lu[16] = l_E3_x__BDE_theta;
    const double l_E3_y__BDE_theta = inverse_pivot_BDE_theta*n_E3_y__BDE_theta;
    lin->lu[17] = l_E3_y__BDE_theta;
    const double scale_H_x = -l_H_x__AH_theta*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x
        - l_H_x__HE_theta*phi_H_x_HE_theta;
    if (!(scale_H_x != 0.0 && isfinite(scale_H_x)))
        return 10;
    const double inverse_pivot_H_x = 1.0/scale_H_x;
    lin->lu[18] = inverse_pivot_H_x;
    const double l_H_y__H_x = inverse_pivot_H_x*(-l_H_y__AH_theta*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x
        - l_H_y__HE_theta*phi_H_x_HE_theta);
    lin->lu[19] = l_H_y__H_x;
    const double u_H_x__H_y = -l_H_x__AH_theta*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y
        - l_H_x__HE_theta*phi_H_y_HE_theta;
    lin->lu[20] = u_H_x__H_y;
    const double l_E3_x__H_x = -inverse_pivot_H_x*l_E3_x__BDE_theta*u_BDE_theta__H_x;
    lin->lu[21] = l_E3_x__H_x;
    const double u_H_x__E3_x = l_H_x__BDE_theta*phi_H_x_BDE_theta;
    lin->lu[22] = u_H_x__E3_x;
    const double l_E3_y__H_x = -inverse_pivot_H_x*l_E3_y__BDE_theta*u_BDE_theta__H_x;
    lin->lu[23] = l_E3_y__H_x;
    const double u_H_x__E3_y = l_H_x__BDE_theta*phi_H_y_BDE_theta;
    lin->lu[24] = u_H_x__E3_y;
    const double scale_H_y = -l_H_y__AH_theta*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y
        - l_H_y__HE_theta*phi_H_y_HE_theta;
    const double pivot_H_y = -l_H_y__H_x*u_H_x__H_y + scale_H_y;
    if (!(fabs(pivot_H_y) > SINGULAR * fabs(scale_H_y)))
        return 11;
    const double inverse_pivot_H_y = 1.0/pivot_H_y;
    lin->lu[25] = inverse_pivot_H_y;
    const double l_E3_x__H_y = inverse_pivot_H_y*(-l_E3_x__BDE_theta*u_BDE_theta__H_y - l_E3_x__H_x*u_H_x__H_y);
    lin->lu[26] = l_E3_x__H_y;
    const double u_H_y__E3_x = l_H_y__BDE_theta*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x;
    lin->lu[27] = u_H_y__E3_x;
    const double l_E3_y__H_y = inverse_pivot_H_y*(-l_E3_y__BDE_theta*u_BDE_theta__H_y - l_E3_y__H_x*u_H_x__H_y);
    lin->lu[28] = l_E3_y__H_y;
    const double u_H_y__E3_y = l_H_y__BDE_theta*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y;
    lin->lu[29] = u_H_y__E3_y;
    const double scale_EG_theta = n_EG_theta__EG_theta;
    if (!(fabs(scale_EG_theta) > SINGULAR * fabs(n_EG_theta__EG_theta)))
        return 7;
    const double inverse_pivot_EG_theta = 1.0/scale_EG_theta;
    lin->lu[30] = inverse_pivot_EG_theta;
    const double l_OF_theta__EG_theta = inverse_pivot_EG_theta*n_OF_theta__EG_theta;
    lin->lu[31] = l_OF_theta__EG_theta;
    lin->lu[32] = n_EG_theta__OF_theta;
    const double l_FE_theta__EG_theta = inverse_pivot_EG_theta*n_FE_theta__EG_theta;
    lin->lu[33] = l_FE_theta__EG_theta;
    lin->lu[34] = n_EG_theta__FE_theta;
    const double l_G_x__EG_theta = inverse_pivot_EG_theta*n_G_x__EG_theta;
    lin->lu[35] = l_G_x__EG_theta;
    const double l_G_y__EG_theta = inverse_pivot_EG_theta*n_G_y__EG_theta;
    lin->lu[36] = l_G_y__EG_theta;
    const double scale_OF_theta = -l_OF_theta__EG_theta*n_EG_theta__OF_theta + n_OF_theta__OF_theta;
    if (!(fabs(scale_OF_theta) > SINGULAR * fabs(n_OF_theta__OF_theta)))
        return 1;
    const double inverse_pivot_OF_theta = 1.0/scale_OF_theta;
    lin->lu[37] = inverse_pivot_OF_theta;
    const double l_FE_theta__OF_theta = inverse_pivot_OF_theta*(-l_FE_theta__EG_theta*n_EG_theta__OF_theta
        + n_FE_theta__OF_theta);
    lin->lu[38] = l_FE_theta__OF_theta;
    const double u_OF_theta__FE_theta = -l_OF_theta__EG_theta*n_EG_theta__FE_theta + n_OF_theta__FE_theta;
    lin->lu[39] = u_OF_theta__FE_theta;
    const double l_G_x__OF_theta = inverse_pivot_OF_theta*(-l_G_x__EG_theta*n_EG_theta__OF_theta + n_G_x__OF_theta);
    lin->lu[40] = l_G_x__OF_theta;
    const double u_OF_theta__G_x = -l_OF_theta__EG_theta*phi_G_x_EG_theta + phi_G_x_OF_theta;
    lin->lu[41] = u_OF_theta__G_x;
    const double l_G_y__OF_theta = inverse_pivot_OF_theta*(-l_G_y__EG_theta*n_EG_theta__OF_theta + n_G_y__OF_theta);
    lin->lu[42] = l_G_y__OF_theta;
    const double u_OF_theta__G_y = -l_OF_theta__EG_theta*phi_G_y_EG_theta + phi_G_y_OF_theta;
    lin->lu[43] = u_OF_theta__G_y;
    const double l_E3_x__OF_theta = inverse_pivot_OF_theta*n_E3_x__OF_theta;
    lin->lu[44] = l_E3_x__OF_theta;
    const double l_E3_y__OF_theta = inverse_pivot_OF_theta*n_E3_y__OF_theta;
    lin->lu[45] = l_E3_y__OF_theta;
    const double scale_FE_theta = -l_FE_theta__EG_theta*n_EG_theta__FE_theta
        - l_FE_theta__OF_theta*u_OF_theta__FE_theta + n_FE_theta__FE_theta;
    if (!(fabs(scale_FE_theta) > SINGULAR * fabs(n_FE_theta__FE_theta)))
        return 5;
    const double inverse_pivot_FE_theta = 1.0/scale_FE_theta;
    lin->lu[46] = inverse_pivot_FE_theta;
    const double l_G_x__FE_theta = inverse_pivot_FE_theta*(-l_G_x__EG_theta*n_EG_theta__FE_theta
        - l_G_x__OF_theta*u_OF_theta__FE_theta + n_G_x__FE_theta);
    lin->lu[47] = l_G_x__FE_theta;
    const double u_FE_theta__G_x = -l_FE_theta__EG_theta*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x
        + phi_G_x_FE_theta;
    lin->lu[48] = u_FE_theta__G_x;
    const double l_G_y__FE_theta = inverse_pivot_FE_theta*(-l_G_y__EG_theta*n_EG_theta__FE_theta
        - l_G_y__OF_theta*u_OF_theta__FE_theta + n_G_y__FE_theta);
    lin->lu[49] = l_G_y__FE_theta;
    const double u_FE_theta__G_y = -l_FE_theta__EG_theta*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y
        + phi_G_y_FE_theta;
    lin->lu[50] = u_FE_theta__G_y;
    const double l_E3_x__FE_theta = inverse_pivot_FE_theta*(-l_E3_x__OF_theta*u_OF_theta__FE_theta + n_E3_x__FE_theta);
    lin->lu[51] = l_E3_x__FE_theta;
    const double u_FE_theta__E3_x = -l_FE_theta__OF_theta*phi_G_x_OF_theta + phi_G_x_FE_theta;
    lin->lu[52] = u_FE_theta__E3_x;
    const double l_E3_y__FE_theta = inverse_pivot_FE_theta*(-l_E3_y__OF_theta*u_OF_theta__FE_theta + n_E3_y__FE_theta);
    lin->lu[53] = l_E3_y__FE_theta;
    const double u_FE_theta__E3_y = -l_FE_theta__OF_theta*phi_G_y_OF_theta + phi_G_y_FE_theta;
    lin->lu[54] = u_FE_theta__E3_y;
    const double scale_G_x = -l_G_x__AG_theta*phi_G_x_AG_theta - l_G_x__EG_theta*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x - l_G_x__OF_theta*u_OF_theta__G_x;
    if (!(scale_G_x != 0.0 && isfinite(scale_G_x)))
        return 8;
    const double inverse_pivot_G_x = 1.0/scale_G_x;
    lin->lu[55] = inverse_pivot_G_x;
    const double l_G_y__G_x = inverse_pivot_G_x*(-l_G_y__AG_theta*phi_G_x_AG_theta - l_G_y__EG_theta*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x - l_G_y__OF_theta*u_OF_theta__G_x);
    lin->lu[56] = l_G_y__G_x;
    const double u_G_x__G_y = -l_G_x__AG_theta*phi_G_y_AG_theta - l_G_x__EG_theta*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y - l_G_x__OF_theta*u_OF_theta__G_y;
    lin->lu[57] = u_G_x__G_y;
    const double l_E3_x__G_x = inverse_pivot_G_x*(-l_E3_x__FE_theta*u_FE_theta__G_x - l_E3_x__OF_theta*u_OF_theta__G_x);
    lin->lu[58] = l_E3_x__G_x;
    const double u_G_x__E3_x = -l_G_x__FE_theta*u_FE_theta__E3_x - l_G_x__OF_theta*phi_G_x_OF_theta;
    lin->lu[59] = u_G_x__E3_x;
    const double l_E3_y__G_x = inverse_pivot_G_x*(-l_E3_y__FE_theta*u_FE_theta__G_x - l_E3_y__OF_theta*u_OF_theta__G_x);
    lin->lu[60] = l_E3_y__G_x;
    const double u_G_x__E3_y = -l_G_x__FE_theta*u_FE_theta__E3_y - l_G_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[61] = u_G_x__E3_y;
    const double scale_G_y = -l_G_y__AG_theta*phi_G_y_AG_theta - l_G_y__EG_theta*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y - l_G_y__OF_theta*u_OF_theta__G_y;
    const double pivot_G_y = -l_G_y__G_x*u_G_x__G_y + scale_G_y;
    if (!(fabs(pivot_G_y) > SINGULAR * fabs(scale_G_y)))
        return 9;
    const double inverse_pivot_G_y = 1.0/pivot_G_y;
    lin->lu[62] = inverse_pivot_G_y;
    const double l_E3_x__G_y = inverse_pivot_G_y*(-l_E3_x__FE_theta*u_FE_theta__G_y - l_E3_x__G_x*u_G_x__G_y
        - l_E3_x__OF_theta*u_OF_theta__G_y);
    lin->lu[63] = l_E3_x__G_y;
    const double u_G_y__E3_x = -l_G_y__FE_theta*u_FE_theta__E3_x - l_G_y__G_x*u_G_x__E3_x
        - l_G_y__OF_theta*phi_G_x_OF_theta;
    lin->lu[64] = u_G_y__E3_x;
    const double l_E3_y__G_y = inverse_pivot_G_y*(-l_E3_y__FE_theta*u_FE_theta__G_y - l_E3_y__G_x*u_G_x__G_y
        - l_E3_y__OF_theta*u_OF_theta__G_y);
    lin->lu[65] = l_E3_y__G_y;
    const double u_G_y__E3_y = -l_G_y__FE_theta*u_FE_theta__E3_y - l_G_y__G_x*u_G_x__E3_y
        - l_G_y__OF_theta*phi_G_y_OF_theta;
    lin->lu[66] = u_G_y__E3_y;
    const double scale_E3_x = l_E3_x__BDE_theta*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x
        - l_E3_x__OF_theta*phi_G_x_OF_theta;
    const double pivot_E3_x = -l_E3_x__G_x*u_G_x__E3_x - l_E3_x__G_y*u_G_y__E3_x - l_E3_x__H_x*u_H_x__E3_x
        - l_E3_x__H_y*u_H_y__E3_x + scale_E3_x;
    if (!(fabs(pivot_E3_x) > SINGULAR * fabs(scale_E3_x)))
        return 12;
    const double inverse_pivot_E3_x = 1.0/pivot_E3_x;
    lin->lu[67] = inverse_pivot_E3_x;
    const double l_E3_y__E3_x = inverse_pivot_E3_x*(l_E3_y__BDE_theta*phi_H_x_BDE_theta
        - l_E3_y__FE_theta*u_FE_theta__E3_x - l_E3_y__G_x*u_G_x__E3_x - l_E3_y__G_y*u_G_y__E3_x
        - l_E3_y__H_x*u_H_x__E3_x - l_E3_y__H_y*u_H_y__E3_x - l_E3_y__OF_theta*phi_G_x_OF_theta);
    lin->lu[68] = l_E3_y__E3_x;
    const double u_E3_x__E3_y = l_E3_x__BDE_theta*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y
        - l_E3_x__G_x*u_G_x__E3_y - l_E3_x__G_y*u_G_y__E3_y - l_E3_x__H_x*u_H_x__E3_y - l_E3_x__H_y*u_H_y__E3_y
        - l_E3_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[69] = u_E3_x__E3_y;
    const double scale_E3_y = l_E3_y__BDE_theta*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y
        - l_E3_y__OF_theta*phi_G_y_OF_theta;
    const double pivot_E3_y = -l_E3_y__E3_x*u_E3_x__E3_y - l_E3_y__G_x*u_G_x__E3_y - l_E3_y__G_y*u_G_y__E3_y
        - l_E3_y__H_x*u_H_x__E3_y - l_E3_y__H_y*u_H_y__E3_y + scale_E3_y;
    if (!(fabs(pivot_E3_y) > SINGULAR * fabs(scale_E3_y)))
        return 13;
    const double inverse_pivot_E3_y = 1.0/pivot_E3_y;
    lin->lu[70] = inverse_pivot_E3_y;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_G_x_OF_theta = lin->value[4];
    const double phi_G_x_AG_theta = lin->value[5];
    const double phi_G_x_EG_theta = lin->value[7];
    const double phi_G_y_OF_theta = lin->value[8];
    const double phi_G_y_AG_theta = lin->value[9];
    const double phi_G_y_EG_theta = lin->value[11];
    const double phi_H_x_BDE_theta = lin->value[12];
    const double phi_H_x_AH_theta = lin->value[13];
    const double phi_H_x_HE_theta = lin->value[14];
    const double phi_H_y_BDE_theta = lin->value[15];
    const double phi_H_y_AH_theta = lin->value[16];
    const double phi_H_y_HE_theta = lin->value[17];
    const double inverse_pivot_AG_theta = lin->lu[0];
    const double l_G_x__AG_theta = lin->lu[1];
    const double l_G_y__AG_theta = lin->lu[2];
    const double inverse_pivot_AH_theta = lin->lu[3];
    const double l_H_x__AH_theta = lin->lu[4];
    const double l_H_y__AH_theta = lin->lu[5];
    const double inverse_pivot_HE_theta = lin->lu[6];
    const double l_BDE_theta__HE_theta = lin->lu[7];
    const double n_HE_theta__BDE_theta = lin->lu[8];
    const double l_H_x__HE_theta = lin->lu[9];
    const double l_H_y__HE_theta = lin->lu[10];
    const double inverse_pivot_BDE_theta = lin->lu[11];
    const double l_H_x__BDE_theta = lin->lu[12];
    const double u_BDE_theta__H_x = lin->lu[13];
    const double l_H_y__BDE_theta = lin->lu[14];
    const double u_BDE_theta__H_y = lin->lu[15];
    const double l_E3_x__BDE_theta = lin->lu[16];
    const double l_E3_y__BDE_theta = lin->lu[17];
    const double inverse_pivot_H_x = lin->lu[18];
    const double l_H_y__H_x = lin->lu[19];
    const double u_H_x__H_y = lin->lu[20];
    const double l_E3_x__H_x = lin->lu[21];
    const double u_H_x__E3_x = lin->lu[22];
    const double l_E3_y__H_x = lin->lu[23];
    const double u_H_x__E3_y = lin->lu[24];
    const double inverse_pivot_H_y = lin->lu[25];
    const double l_E3_x__H_y = lin->lu[26];
    const double u_H_y__E3_x = lin->lu[27];
    const double l_E3_y__H_y = lin->lu[28];
    const double u_H_y__E3_y = lin->lu[29];
    const double inverse_pivot_EG_theta = lin->lu[30];
    const double l_OF_theta__EG_theta = lin->lu[31];
    const double n_EG_theta__OF_theta = lin->lu[32];
    const double l_FE_theta__EG_theta = lin->lu[33];
    const double n_EG_theta__FE_theta = lin->lu[34];
    const double l_G_x__EG_theta = lin->lu[35];
    const double l_G_y__EG_theta = lin->lu[36];
    const double inverse_pivot_OF_theta = lin->lu[37];
    const double l_FE_theta__OF_theta = lin->lu[38];
    const double u_OF_theta__FE_theta = lin->lu[39];
    const double l_G_x__OF_theta = lin->lu[40];
    const double u_OF_theta__G_x = lin->lu[41];
    const double l_G_y__OF_theta = lin->lu[42];
    const double u_OF_theta__G_y = lin->lu[43];
    const double l_E3_x__OF_theta = lin->lu[44];
    const double l_E3_y__OF_theta = lin->lu[45];
    const double inverse_pivot_FE_theta = lin->lu[46];
    const double l_G_x__FE_theta = lin->lu[47];
    const double u_FE_theta__G_x = lin->lu[48];
    const double l_G_y__FE_theta = lin->lu[49];
    const double u_FE_theta__G_y = lin->lu[50];
    const double l_E3_x__FE_theta = lin->lu[51];
    const double u_FE_theta__E3_x = lin->lu[52];
    const double l_E3_y__FE_theta = lin->lu[53];
    const double u_FE_theta__E3_y = lin->lu[54];
    const double inverse_pivot_G_x = lin->lu[55];
    const double l_G_y__G_x = lin->lu[56];
    const double u_G_x__G_y = lin->lu[57];
    const double l_E3_x__G_x = lin->lu[58];
    const double u_G_x__E3_x = lin->lu[59];
    const double l_E3_y__G_x = lin->lu[60];
    const double u_G_x__E3_y = lin->lu[61];
    const double inverse_pivot_G_y = lin->lu[62];
    const double l_E3_x__G_y = lin->lu[63];
    const double u_G_y__E3_x = lin->lu[64];
    const double l_E3_y__G_y = lin->lu[65];
    const double u_G_y__E3_y = lin->lu[66];
    const double inverse_pivot_E3_x = lin->lu[67];
    const double l_E3_y__E3_x = lin->lu[68];
    const double u_E3_x__E3_y = lin->lu[69];
    const double inverse_pivot_E3_y = lin->lu[70];

    /* forward */
    const double b_AG_theta = x[2];
    const double b_AH_theta = x[3];
    const double b_HE_theta = x[5];
    const double b_BDE_theta = -b_HE_theta*l_BDE_theta__HE_theta + x[1];
    const double b_H_x = -b_AH_theta*l_H_x__AH_theta - b_BDE_theta*l_H_x__BDE_theta - b_HE_theta*l_H_x__HE_theta + x[9];
    const double b_H_y = -b_AH_theta*l_H_y__AH_theta - b_BDE_theta*l_H_y__BDE_theta - b_HE_theta*l_H_y__HE_theta
        - b_H_x*l_H_y__H_x + x[10];
    const double b_EG_theta = x[6];
    const double b_OF_theta = -b_EG_theta*l_OF_theta__EG_theta + x[0];
    const double b_FE_theta = -b_EG_theta*l_FE_theta__EG_theta - b_OF_theta*l_FE_theta__OF_theta + x[4];
    const double b_G_x = -b_AG_theta*l_G_x__AG_theta - b_EG_theta*l_G_x__EG_theta - b_FE_theta*l_G_x__FE_theta
        - b_OF_theta*l_G_x__OF_theta + x[7];
    const double b_G_y = -b_AG_theta*l_G_y__AG_theta - b_EG_theta*l_G_y__EG_theta - b_FE_theta*l_G_y__FE_theta
        - b_G_x*l_G_y__G_x - b_OF_theta*l_G_y__OF_theta + x[8];
    const double b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta - b_FE_theta*l_E3_x__FE_theta - b_G_x*l_E3_x__G_x
        - b_G_y*l_E3_x__G_y - b_H_x*l_E3_x__H_x - b_H_y*l_E3_x__H_y - b_OF_theta*l_E3_x__OF_theta + x[11];
    const double b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta - b_E3_x*l_E3_y__E3_x - b_FE_theta*l_E3_y__FE_theta
        - b_G_x*l_E3_y__G_x - b_G_y*l_E3_y__G_y - b_H_x*l_E3_y__H_x - b_H_y*l_E3_y__H_y - b_OF_theta*l_E3_y__OF_theta
        + x[12];

    /* backward */
    const double x_E3_y = b_E3_y*inverse_pivot_E3_y;
    x[12] = x_E3_y;
    const double x_E3_x = inverse_pivot_E3_x*(b_E3_x - u_E3_x__E3_y*x_E3_y);
    x[11] = x_E3_x;
    const double x_G_y = inverse_pivot_G_y*(b_G_y - u_G_y__E3_x*x_E3_x - u_G_y__E3_y*x_E3_y);
    x[8] = x_G_y;
    const double x_G_x = inverse_pivot_G_x*(b_G_x - u_G_x__E3_x*x_E3_x - u_G_x__E3_y*x_E3_y - u_G_x__G_y*x_G_y);
    x[7] = x_G_x;
    const double x_FE_theta = inverse_pivot_FE_theta*(b_FE_theta - u_FE_theta__E3_x*x_E3_x - u_FE_theta__E3_y*x_E3_y
        - u_FE_theta__G_x*x_G_x - u_FE_theta__G_y*x_G_y);
    x[4] = x_FE_theta;
    const double x_OF_theta = inverse_pivot_OF_theta*(b_OF_theta - phi_G_x_OF_theta*x_E3_x - phi_G_y_OF_theta*x_E3_y
        - u_OF_theta__FE_theta*x_FE_theta - u_OF_theta__G_x*x_G_x - u_OF_theta__G_y*x_G_y);
    x[0] = x_OF_theta;
    const double x_EG_theta = inverse_pivot_EG_theta*(b_EG_theta - n_EG_theta__FE_theta*x_FE_theta
        - n_EG_theta__OF_theta*x_OF_theta - phi_G_x_EG_theta*x_G_x - phi_G_y_EG_theta*x_G_y);
    x[6] = x_EG_theta;
    const double x_H_y = inverse_pivot_H_y*(b_H_y - u_H_y__E3_x*x_E3_x - u_H_y__E3_y*x_E3_y);
    x[10] = x_H_y;
    const double x_H_x = inverse_pivot_H_x*(b_H_x - u_H_x__E3_x*x_E3_x - u_H_x__E3_y*x_E3_y - u_H_x__H_y*x_H_y);
    x[9] = x_H_x;
    const double x_BDE_theta = inverse_pivot_BDE_theta*(b_BDE_theta + phi_H_x_BDE_theta*x_E3_x
        + phi_H_y_BDE_theta*x_E3_y - u_BDE_theta__H_x*x_H_x - u_BDE_theta__H_y*x_H_y);
    x[1] = x_BDE_theta;
    const double x_HE_theta = inverse_pivot_HE_theta*(b_HE_theta - n_HE_theta__BDE_theta*x_BDE_theta
        - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y);
    x[5] = x_HE_theta;
    const double x_AH_theta = inverse_pivot_AH_theta*(b_AH_theta - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y);
    x[3] = x_AH_theta;
    const double x_AG_theta = inverse_pivot_AG_theta*(b_AG_theta - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y);
    x[2] = x_AG_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_OF_theta_FE_theta = lin->value[0];
    const double mass_OF_theta_EG_theta = lin->value[1];
    const double mass_FE_theta_EG_theta = lin->value[2];
    const double mass_BDE_theta_HE_theta = lin->value[3];
    const double phi_G_x_OF_theta = lin->value[4];
    const double phi_G_x_AG_theta = lin->value[5];
    const double phi_G_x_FE_theta = lin->value[6];
    const double phi_G_x_EG_theta = lin->value[7];
    const double phi_G_y_OF_theta = lin->value[8];
    const double phi_G_y_AG_theta = lin->value[9];
    const double phi_G_y_FE_theta = lin->value[10];
    const double phi_G_y_EG_theta = lin->value[11];
    const double phi_H_x_BDE_theta = lin->value[12];
    const double phi_H_x_AH_theta = lin->value[13];
    const double phi_H_x_HE_theta = lin->value[14];
    const double phi_H_y_BDE_theta = lin->value[15];
    const double phi_H_y_AH_theta = lin->value[16];
    const double phi_H_y_HE_theta = lin->value[17];
    const double by_q_G_x_AG_theta = lin->value[18];
    const double by_q_G_x_EG_theta = lin->value[19];
    const double by_q_G_x_FE_theta = lin->value[20];
    const double by_q_G_x_OF_theta = lin->value[21];
    const double by_q_G_y_AG_theta = lin->value[22];
    const double by_q_G_y_EG_theta = lin->value[23];
    const double by_q_G_y_FE_theta = lin->value[24];
    const double by_q_G_y_OF_theta = lin->value[25];
    const double by_q_H_x_AH_theta = lin->value[26];
    const double by_q_H_x_BDE_theta = lin->value[27];
    const double by_q_H_x_HE_theta = lin->value[28];
    const double by_q_H_y_AH_theta = lin->value[29];
    const double by_q_H_y_BDE_theta = lin->value[30];
    const double by_q_H_y_HE_theta = lin->value[31];
    const double by_q_OF_theta_OF_theta = lin->value[32];
    const double by_q_OF_theta_EG_theta = lin->value[33];
    const double by_q_OF_theta_FE_theta = lin->value[34];
    const double by_q_BDE_theta_BDE_theta = lin->value[35];
    const double by_q_BDE_theta_HE_theta = lin->value[36];
    const double by_q_AG_theta_AG_theta = lin->value[37];
    const double by_q_AH_theta_AH_theta = lin->value[38];
    const double by_q_FE_theta_FE_theta = lin->value[39];
    const double by_q_FE_theta_EG_theta = lin->value[40];
    const double by_q_FE_theta_OF_theta = lin->value[41];
    const double by_q_HE_theta_BDE_theta = lin->value[42];
    const double by_q_HE_theta_HE_theta = lin->value[43];
    const double by_q_EG_theta_FE_theta = lin->value[44];
    const double by_q_EG_theta_EG_theta = lin->value[45];
    const double by_q_EG_theta_OF_theta = lin->value[46];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[13];
    const double shifted_OF_theta = -p->beta_squared*eta*r[0] + r[7];
    const double shifted_BDE_theta = -p->beta_squared*eta*r[1] + r[8];
    const double shifted_AG_theta = -p->beta_squared*eta*r[2] + r[9];
    const double shifted_AH_theta = -p->beta_squared*eta*r[3] + r[10];
    const double shifted_FE_theta = -p->beta_squared*eta*r[4] + r[11];
    const double shifted_HE_theta = -p->beta_squared*eta*r[5] + r[12];
    const double shifted_EG_theta = -p->beta_squared*eta*r[6] + r[13];
    x[0] = eta*(-by_q_OF_theta_EG_theta*eta*r[6] - by_q_OF_theta_FE_theta*eta*r[4] - by_q_OF_theta_OF_theta*eta*r[0]
        + p->mass_OF_OF*r[7] + mass_OF_theta_EG_theta*r[13] + mass_OF_theta_FE_theta*r[11]);
    x[1] = eta*(-by_q_BDE_theta_BDE_theta*eta*r[1] - by_q_BDE_theta_HE_theta*eta*r[5] + p->mass_BDE_BDE*r[8]
        + mass_BDE_theta_HE_theta*r[12]);
    x[2] = eta*(-by_q_AG_theta_AG_theta*eta*r[2] + p->mass_AG_AG*r[9]);
    x[3] = eta*(-by_q_AH_theta_AH_theta*eta*r[3] + p->mass_AH_AH*r[10]);
    x[4] = eta*(-by_q_FE_theta_EG_theta*eta*r[6] - by_q_FE_theta_FE_theta*eta*r[4] - by_q_FE_theta_OF_theta*eta*r[0]
        + p->mass_FE_FE*r[11] + mass_FE_theta_EG_theta*r[13] + mass_OF_theta_FE_theta*r[7]);
    x[5] = eta*(-by_q_HE_theta_BDE_theta*eta*r[1] - by_q_HE_theta_HE_theta*eta*r[5] + mass_BDE_theta_HE_theta*r[8]
        + p->mass_HE_HE*r[12]);
    x[6] = eta*(-by_q_EG_theta_EG_theta*eta*r[6] - by_q_EG_theta_FE_theta*eta*r[4] - by_q_EG_theta_OF_theta*eta*r[0]
        + p->mass_EG_EG*r[13] + mass_FE_theta_EG_theta*r[11] + mass_OF_theta_EG_theta*r[7]);
    x[7] = eta_row*(-by_q_G_x_AG_theta*eta*r[2] - by_q_G_x_EG_theta*eta*r[6] - by_q_G_x_FE_theta*eta*r[4]
        - by_q_G_x_OF_theta*eta*r[0] + phi_G_x_AG_theta*shifted_AG_theta + phi_G_x_EG_theta*shifted_EG_theta
        + phi_G_x_FE_theta*shifted_FE_theta + phi_G_x_OF_theta*shifted_OF_theta);
    x[8] = eta_row*(-by_q_G_y_AG_theta*eta*r[2] - by_q_G_y_EG_theta*eta*r[6] - by_q_G_y_FE_theta*eta*r[4]
        - by_q_G_y_OF_theta*eta*r[0] + phi_G_y_AG_theta*shifted_AG_theta + phi_G_y_EG_theta*shifted_EG_theta
        + phi_G_y_FE_theta*shifted_FE_theta + phi_G_y_OF_theta*shifted_OF_theta);
    x[9] = eta_row*(-by_q_H_x_AH_theta*eta*r[3] - by_q_H_x_BDE_theta*eta*r[1] - by_q_H_x_HE_theta*eta*r[5]
        + phi_H_x_AH_theta*shifted_AH_theta + phi_H_x_BDE_theta*shifted_BDE_theta + phi_H_x_HE_theta*shifted_HE_theta);
    x[10] = eta_row*(-by_q_H_y_AH_theta*eta*r[3] - by_q_H_y_BDE_theta*eta*r[1] - by_q_H_y_HE_theta*eta*r[5]
        + phi_H_y_AH_theta*shifted_AH_theta + phi_H_y_BDE_theta*shifted_BDE_theta + phi_H_y_HE_theta*shifted_HE_theta);
    x[11] = eta_row*(-by_q_G_x_FE_theta*eta*r[4] - by_q_G_x_OF_theta*eta*r[0] + by_q_H_x_BDE_theta*eta*r[1]
        + phi_G_x_FE_theta*shifted_FE_theta + phi_G_x_OF_theta*shifted_OF_theta - phi_H_x_BDE_theta*shifted_BDE_theta);
    x[12] = eta_row*(-by_q_G_y_FE_theta*eta*r[4] - by_q_G_y_OF_theta*eta*r[0] + by_q_H_y_BDE_theta*eta*r[1]
        + phi_G_y_FE_theta*shifted_FE_theta + phi_G_y_OF_theta*shifted_OF_theta - phi_H_y_BDE_theta*shifted_BDE_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[7] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[8] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[9] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[10] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[11] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[12] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[13] = x[6];
    u[14] = eta*r[14];
    u[15] = eta*(p->motor_value*u[7] + r[15]);
    u[16] = eta*r[16];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {7, 0, 4, 1}, {7, 2, 5, 1}, {7, 4, 6, 1}, {7, 6, 7, 1}, {8, 0, 8, 1}, {8, 2, 9, 1}, {8, 4, 10, 1},
    {8, 6, 11, 1}, {9, 1, 12, 1}, {9, 3, 13, 1}, {9, 5, 14, 1}, {10, 1, 15, 1}, {10, 3, 16, 1},
    {10, 5, 17, 1}, {11, 0, 4, 1}, {11, 1, 12, -1}, {11, 4, 6, 1}, {12, 0, 8, 1}, {12, 1, 15, -1},
    {12, 4, 10, 1}
};
static const LinearEntry residual_entries[] = {
    {7, 2, 18, 1}, {7, 6, 19, 1}, {7, 4, 20, 1}, {7, 0, 21, 1}, {8, 2, 22, 1}, {8, 6, 23, 1}, {8, 4, 24, 1},
    {8, 0, 25, 1}, {9, 3, 26, 1}, {9, 1, 27, 1}, {9, 5, 28, 1}, {10, 3, 29, 1}, {10, 1, 30, 1},
    {10, 5, 31, 1}, {11, 1, 27, -1}, {11, 4, 20, 1}, {11, 0, 21, 1}, {12, 1, 30, -1}, {12, 4, 24, 1},
    {12, 0, 25, 1}, {0, 0, 32, 1}, {0, 6, 33, 1}, {0, 4, 34, 1}, {1, 1, 35, 1}, {1, 5, 36, 1}, {2, 2, 37, 1},
    {3, 3, 38, 1}, {4, 4, 39, 1}, {4, 6, 40, 1}, {4, 0, 41, 1}, {5, 1, 42, 1}, {5, 5, 43, 1}, {6, 4, 44, 1},
    {6, 6, 45, 1}, {6, 0, 46, 1}, {7, 9, 47, 1}, {7, 13, 48, 1}, {7, 11, 49, 1}, {7, 7, 50, 1}, {8, 9, 51, 1},
    {8, 13, 52, 1}, {8, 11, 53, 1}, {8, 7, 54, 1}, {9, 10, 55, 1}, {9, 8, 56, 1}, {9, 12, 57, 1},
    {10, 10, 58, 1}, {10, 8, 59, 1}, {10, 12, 60, 1}, {11, 8, 56, -1}, {11, 11, 49, 1}, {11, 7, 50, 1},
    {12, 8, 59, -1}, {12, 11, 53, 1}, {12, 7, 54, 1}, {0, 13, 61, 1}, {0, 11, 62, 1}, {1, 12, 63, 1},
    {4, 13, 64, 1}, {4, 7, 65, 1}, {5, 8, 66, 1}, {6, 11, 67, 1}, {6, 7, 68, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 7, 69, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 20,
    N_RESIDUAL = 63,
    N_RESIDUAL_T = 0,
    N_POWER = 1,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 13,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
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
    const double cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const double dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const double sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const double dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const double sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const double dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const double cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const double sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const double dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;

    /* Phi and Phi_dot */
    const double phi_G_x = -p->A_x - span_AG_G_x + span_EG_G_x + span_FE_E_x + span_OF_F_x;
    const double phi_dot_G_x = AG_omega*span_AG_G_y - EG_omega*span_EG_G_y - FE_omega*span_FE_E_y
        - OF_omega*span_OF_F_y;
    const double phi_G_y = -p->A_y - span_AG_G_y + span_EG_G_y + span_FE_E_y + span_OF_F_y;
    const double phi_dot_G_y = -AG_omega*span_AG_G_x + EG_omega*span_EG_G_x + FE_omega*span_FE_E_x
        + OF_omega*span_OF_F_x;
    const double phi_H_x = -p->A_x + p->B_x - span_AH_H_x + span_BDE_E_x + span_HE_H_x;
    const double phi_dot_H_x = AH_omega*span_AH_H_y - BDE_omega*span_BDE_E_y - HE_omega*span_HE_H_y;
    const double phi_H_y = -p->A_y + p->B_y - span_AH_H_y + span_BDE_E_y + span_HE_H_y;
    const double phi_dot_H_y = -AH_omega*span_AH_H_x + BDE_omega*span_BDE_E_x + HE_omega*span_HE_H_x;
    const double phi_E3_x = -p->B_x - span_BDE_E_x + span_FE_E_x + span_OF_F_x;
    const double phi_dot_E3_x = BDE_omega*span_BDE_E_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;
    const double phi_E3_y = -p->B_y - span_BDE_E_y + span_FE_E_y + span_OF_F_y;
    const double phi_dot_E3_y = -BDE_omega*span_BDE_E_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;

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
    if (!(determinant_H_x__H_y > memory->least_size * scale_H_y * scale_H_x))
        return 2;
    const double size_H_x = scale_H_x + scale_H_y;
    if (!(scale_H_x > memory->least_size * size_H_x))
        return 1;
    if (!(determinant_H_x__H_y > memory->least_size * size_H_x * scale_H_x))
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
    if (!(determinant_G_x__G_y > memory->least_size * scale_G_y * scale_G_x))
        return 4;
    const double size_G_x = scale_G_x + scale_G_y;
    if (!(scale_G_x > memory->least_size * size_G_x))
        return 3;
    if (!(determinant_G_x__G_y > memory->least_size * size_G_x * scale_G_x))
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
    if (!(pivot_E3_x > memory->least_size * scale_E3_x))
        return 5;
    if (!(determinant_E3_x__E3_y > memory->least_size * scale_E3_y * pivot_E3_x))
        return 6;
    const double size_E3_x = scale_E3_x + scale_E3_y;
    if (!(pivot_E3_x > memory->least_size * size_E3_x))
        return 5;
    if (!(determinant_E3_x__E3_y > memory->least_size * size_E3_x * pivot_E3_x))
        return 6;
    const double inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const double inverse_pivot_E3_x = inverse_E3_x__E3_y*pivot_E3_y;
    const double inverse_pivot_E3_y = inverse_E3_x__E3_y*pivot_E3_x;
    const double inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;

    /* forward substitution */
    const double dq_z_E3_x = -l_E3_x__G_x*phi_G_x - l_E3_x__G_y*phi_G_y - l_E3_x__H_x*phi_H_x - l_E3_x__H_y*phi_H_y
        + phi_E3_x;
    const double dq_z_E3_y = -l_E3_y__G_x*phi_G_x - l_E3_y__G_y*phi_G_y - l_E3_y__H_x*phi_H_x - l_E3_y__H_y*phi_H_y
        + phi_E3_y;

    /* backward substitution */
    const double dq_lambda_E3_y = dq_z_E3_x*inverse_cross_E3_x__E3_y + dq_z_E3_y*inverse_pivot_E3_y;
    const double dq_lambda_E3_x = dq_z_E3_x*inverse_pivot_E3_x + dq_z_E3_y*inverse_cross_E3_x__E3_y;
    const double dq_lambda_G_y = -dq_lambda_E3_x*l_E3_x__G_y - dq_lambda_E3_y*l_E3_y__G_y
        + inverse_cross_G_x__G_y*phi_G_x + inverse_pivot_G_y*phi_G_y;
    const double dq_lambda_G_x = -dq_lambda_E3_x*l_E3_x__G_x - dq_lambda_E3_y*l_E3_y__G_x
        + inverse_cross_G_x__G_y*phi_G_y + inverse_pivot_G_x*phi_G_x;
    const double dq_acceleration_FE_theta = -dq_lambda_E3_x*l_E3_x__FE_theta - dq_lambda_E3_y*l_E3_y__FE_theta
        - dq_lambda_G_x*l_G_x__FE_theta - dq_lambda_G_y*l_G_y__FE_theta;
    const double dq_acceleration_OF_theta = -dq_lambda_E3_x*l_E3_x__OF_theta - dq_lambda_E3_y*l_E3_y__OF_theta
        - dq_lambda_G_x*l_G_x__OF_theta - dq_lambda_G_y*l_G_y__OF_theta;
    const double dq_acceleration_EG_theta = -dq_acceleration_FE_theta*l_FE_theta__EG_theta
        - dq_acceleration_OF_theta*l_OF_theta__EG_theta - dq_lambda_G_x*l_G_x__EG_theta - dq_lambda_G_y*l_G_y__EG_theta;
    const double dq_lambda_H_y = -dq_lambda_E3_x*l_E3_x__H_y - dq_lambda_E3_y*l_E3_y__H_y
        + inverse_cross_H_x__H_y*phi_H_x + inverse_pivot_H_y*phi_H_y;
    const double dq_lambda_H_x = -dq_lambda_E3_x*l_E3_x__H_x - dq_lambda_E3_y*l_E3_y__H_x
        + inverse_cross_H_x__H_y*phi_H_y + inverse_pivot_H_x*phi_H_x;
    const double dq_acceleration_BDE_theta = -dq_lambda_E3_x*l_E3_x__BDE_theta - dq_lambda_E3_y*l_E3_y__BDE_theta
        - dq_lambda_H_x*l_H_x__BDE_theta - dq_lambda_H_y*l_H_y__BDE_theta;
    const double dq_acceleration_HE_theta = -dq_acceleration_BDE_theta*l_BDE_theta__HE_theta
        - dq_lambda_H_x*l_H_x__HE_theta - dq_lambda_H_y*l_H_y__HE_theta;
    const double dq_acceleration_AH_theta = -dq_lambda_H_x*l_H_x__AH_theta - dq_lambda_H_y*l_H_y__AH_theta;
    const double dq_acceleration_AG_theta = -dq_lambda_G_x*l_G_x__AG_theta - dq_lambda_G_y*l_G_y__AG_theta;

    /* forward substitution */
    const double dv_z_E3_x = -l_E3_x__G_x*phi_dot_G_x - l_E3_x__G_y*phi_dot_G_y - l_E3_x__H_x*phi_dot_H_x
        - l_E3_x__H_y*phi_dot_H_y + phi_dot_E3_x;
    const double dv_z_E3_y = -l_E3_y__G_x*phi_dot_G_x - l_E3_y__G_y*phi_dot_G_y - l_E3_y__H_x*phi_dot_H_x
        - l_E3_y__H_y*phi_dot_H_y + phi_dot_E3_y;

    /* backward substitution */
    const double dv_lambda_E3_y = dv_z_E3_x*inverse_cross_E3_x__E3_y + dv_z_E3_y*inverse_pivot_E3_y;
    const double dv_lambda_E3_x = dv_z_E3_x*inverse_pivot_E3_x + dv_z_E3_y*inverse_cross_E3_x__E3_y;
    const double dv_lambda_G_y = -dv_lambda_E3_x*l_E3_x__G_y - dv_lambda_E3_y*l_E3_y__G_y
        + inverse_cross_G_x__G_y*phi_dot_G_x + inverse_pivot_G_y*phi_dot_G_y;
    const double dv_lambda_G_x = -dv_lambda_E3_x*l_E3_x__G_x - dv_lambda_E3_y*l_E3_y__G_x
        + inverse_cross_G_x__G_y*phi_dot_G_y + inverse_pivot_G_x*phi_dot_G_x;
    const double dv_acceleration_FE_theta = -dv_lambda_E3_x*l_E3_x__FE_theta - dv_lambda_E3_y*l_E3_y__FE_theta
        - dv_lambda_G_x*l_G_x__FE_theta - dv_lambda_G_y*l_G_y__FE_theta;
    const double dv_acceleration_OF_theta = -dv_lambda_E3_x*l_E3_x__OF_theta - dv_lambda_E3_y*l_E3_y__OF_theta
        - dv_lambda_G_x*l_G_x__OF_theta - dv_lambda_G_y*l_G_y__OF_theta;
    const double dv_acceleration_EG_theta = -dv_acceleration_FE_theta*l_FE_theta__EG_theta
        - dv_acceleration_OF_theta*l_OF_theta__EG_theta - dv_lambda_G_x*l_G_x__EG_theta - dv_lambda_G_y*l_G_y__EG_theta;
    const double dv_lambda_H_y = -dv_lambda_E3_x*l_E3_x__H_y - dv_lambda_E3_y*l_E3_y__H_y
        + inverse_cross_H_x__H_y*phi_dot_H_x + inverse_pivot_H_y*phi_dot_H_y;
    const double dv_lambda_H_x = -dv_lambda_E3_x*l_E3_x__H_x - dv_lambda_E3_y*l_E3_y__H_x
        + inverse_cross_H_x__H_y*phi_dot_H_y + inverse_pivot_H_x*phi_dot_H_x;
    const double dv_acceleration_BDE_theta = -dv_lambda_E3_x*l_E3_x__BDE_theta - dv_lambda_E3_y*l_E3_y__BDE_theta
        - dv_lambda_H_x*l_H_x__BDE_theta - dv_lambda_H_y*l_H_y__BDE_theta;
    const double dv_acceleration_HE_theta = -dv_acceleration_BDE_theta*l_BDE_theta__HE_theta
        - dv_lambda_H_x*l_H_x__HE_theta - dv_lambda_H_y*l_H_y__HE_theta;
    const double dv_acceleration_AH_theta = -dv_lambda_H_x*l_H_x__AH_theta - dv_lambda_H_y*l_H_y__AH_theta;
    const double dv_acceleration_AG_theta = -dv_lambda_G_x*l_G_x__AG_theta - dv_lambda_G_y*l_G_y__AG_theta;

    /* results */
    dq[0] = dq_acceleration_OF_theta;
    dv[0] = dv_acceleration_OF_theta;
    dq[1] = dq_acceleration_BDE_theta;
    dv[1] = dv_acceleration_BDE_theta;
    dq[2] = dq_acceleration_AG_theta;
    dv[2] = dv_acceleration_AG_theta;
    dq[3] = dq_acceleration_AH_theta;
    dv[3] = dv_acceleration_AH_theta;
    dq[4] = dq_acceleration_FE_theta;
    dv[4] = dv_acceleration_FE_theta;
    dq[5] = dq_acceleration_HE_theta;
    dv[5] = dv_acceleration_HE_theta;
    dq[6] = dq_acceleration_EG_theta;
    dv[6] = dv_acceleration_EG_theta;
    *worst = max_of(0.0, fabs(phi_G_x));
    *worst = max_of(*worst, fabs(phi_G_y));
    *worst = max_of(*worst, fabs(phi_H_x));
    *worst = max_of(*worst, fabs(phi_H_y));
    *worst = max_of(*worst, fabs(phi_E3_x));
    *worst = max_of(*worst, fabs(phi_E3_y));
    return 0;
}
