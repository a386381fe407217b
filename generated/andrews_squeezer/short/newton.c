/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
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
    const double a_OF_theta_ = a[0];
    const double a_BDE_theta_ = a[1];
    const double a_AG_theta_ = a[2];
    const double a_AH_theta_ = a[3];
    const double a_FE_theta_ = a[4];
    const double a_HE_theta_ = a[5];
    const double a_EG_theta_ = a[6];
    const double held_lambda_G_x_ = aside->lambda[0];
    const double held_lambda_G_y_ = aside->lambda[1];
    const double held_lambda_H_x_ = aside->lambda[2];
    const double held_lambda_H_y_ = aside->lambda[3];
    const double held_lambda_E3_x_ = aside->lambda[4];
    const double held_lambda_E3_y_ = aside->lambda[5];

    /* directions, arms, drives */
    const double cos_theta_OF_ = cos(OF_theta_);
    const double sin_theta_OF_ = sin(OF_theta_);
    const double cos_theta_BDE_ = cos(BDE_theta_);
    const double sin_theta_BDE_ = sin(BDE_theta_);
    const double cos_theta_AG_ = cos(AG_theta_);
    const double sin_theta_AG_ = sin(AG_theta_);
    const double cos_theta_AH_ = cos(AH_theta_);
    const double sin_theta_AH_ = sin(AH_theta_);
    const double cos_theta_FE_ = cos(FE_theta_);
    const double sin_theta_FE_ = sin(FE_theta_);
    const double cos_theta_HE_ = cos(HE_theta_);
    const double sin_theta_HE_ = sin(HE_theta_);
    const double cos_theta_EG_ = cos(EG_theta_);
    const double sin_theta_EG_ = sin(EG_theta_);
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

    /* coordinates */
    const double inverse_sum_ = 1.0/(spring_length_ + 1e-150);
    const double spring_length_by_BDE_theta_ = inverse_sum_*span_BDE_D_x_*spring_span_y_
        - inverse_sum_*span_BDE_D_y_*spring_span_x_;
    const double spring_force_by_BDE_theta_ = spring_length_by_BDE_theta_*p->spring_stiffness_;
    const double inverse_spring_length_ = 1.0/spring_length_;
    const double spring_pull_by_BDE_theta_ = -(inverse_spring_length_
        * inverse_spring_length_)*spring_force_*spring_length_by_BDE_theta_
        + inverse_spring_length_*spring_force_by_BDE_theta_;

    /* results */
    lin->value[0] = dot_OF_FE_;
    lin->value[1] = dot_OF_EG_;
    lin->value[2] = dot_FE_EG_;
    lin->value[3] = dot_BDE_HE_;
    lin->value[4] = -span_OF_F_y_;
    lin->value[5] = span_AG_G_y_;
    lin->value[6] = -span_FE_E_y_;
    lin->value[7] = -span_EG_G_y_;
    lin->value[8] = span_OF_F_x_;
    lin->value[9] = -span_AG_G_x_;
    lin->value[10] = span_FE_E_x_;
    lin->value[11] = span_EG_G_x_;
    lin->value[12] = -span_BDE_E_y_;
    lin->value[13] = span_AH_H_y_;
    lin->value[14] = -span_HE_H_y_;
    lin->value[15] = span_BDE_E_x_;
    lin->value[16] = -span_AH_H_x_;
    lin->value[17] = span_HE_H_x_;
    lin->value[18] = -(AG_omega_ * AG_omega_)*span_AG_G_y_ + AG_omega_*span_AG_G_x_*p->two_alpha_
        + a_AG_theta_*span_AG_G_x_;
    lin->value[19] = (EG_omega_ * EG_omega_)*span_EG_G_y_ - EG_omega_*span_EG_G_x_*p->two_alpha_
        - a_EG_theta_*span_EG_G_x_;
    lin->value[20] = (FE_omega_ * FE_omega_)*span_FE_E_y_ - FE_omega_*span_FE_E_x_*p->two_alpha_
        - a_FE_theta_*span_FE_E_x_;
    lin->value[21] = (OF_omega_ * OF_omega_)*span_OF_F_y_ - OF_omega_*span_OF_F_x_*p->two_alpha_
        - a_OF_theta_*span_OF_F_x_;
    lin->value[22] = (AG_omega_ * AG_omega_)*span_AG_G_x_ + AG_omega_*span_AG_G_y_*p->two_alpha_
        + a_AG_theta_*span_AG_G_y_;
    lin->value[23] = -(EG_omega_ * EG_omega_)*span_EG_G_x_ - EG_omega_*span_EG_G_y_*p->two_alpha_
        - a_EG_theta_*span_EG_G_y_;
    lin->value[24] = -(FE_omega_ * FE_omega_)*span_FE_E_x_ - FE_omega_*span_FE_E_y_*p->two_alpha_
        - a_FE_theta_*span_FE_E_y_;
    lin->value[25] = -(OF_omega_ * OF_omega_)*span_OF_F_x_ - OF_omega_*span_OF_F_y_*p->two_alpha_
        - a_OF_theta_*span_OF_F_y_;
    lin->value[26] = -(AH_omega_ * AH_omega_)*span_AH_H_y_ + AH_omega_*span_AH_H_x_*p->two_alpha_
        + a_AH_theta_*span_AH_H_x_;
    lin->value[27] = (BDE_omega_ * BDE_omega_)*span_BDE_E_y_ - BDE_omega_*span_BDE_E_x_*p->two_alpha_
        - a_BDE_theta_*span_BDE_E_x_;
    lin->value[28] = (HE_omega_ * HE_omega_)*span_HE_H_y_ - HE_omega_*span_HE_H_x_*p->two_alpha_
        - a_HE_theta_*span_HE_H_x_;
    lin->value[29] = (AH_omega_ * AH_omega_)*span_AH_H_x_ + AH_omega_*span_AH_H_y_*p->two_alpha_
        + a_AH_theta_*span_AH_H_y_;
    lin->value[30] = -(BDE_omega_ * BDE_omega_)*span_BDE_E_x_ - BDE_omega_*span_BDE_E_y_*p->two_alpha_
        - a_BDE_theta_*span_BDE_E_y_;
    lin->value[31] = -(HE_omega_ * HE_omega_)*span_HE_H_x_ - HE_omega_*span_HE_H_y_*p->two_alpha_
        - a_HE_theta_*span_HE_H_y_;
    lin->value[32] = (EG_omega_ * EG_omega_)*dot_OF_EG_ + (FE_omega_ * FE_omega_)*dot_OF_FE_ + a_EG_theta_*cross_OF_EG_
        + a_FE_theta_*cross_OF_FE_ + span_OF_F_x_*(-held_lambda_E3_x_ - held_lambda_G_x_)
        - span_OF_F_y_*(held_lambda_E3_y_ + held_lambda_G_y_);
    lin->value[33] = -(EG_omega_ * EG_omega_)*dot_OF_EG_ - a_EG_theta_*cross_OF_EG_;
    lin->value[34] = -(FE_omega_ * FE_omega_)*dot_OF_FE_ - a_FE_theta_*cross_OF_FE_;
    lin->value[35] = (HE_omega_ * HE_omega_)*dot_BDE_HE_ + a_HE_theta_*cross_BDE_HE_
        + (span_BDE_D_x_ * span_BDE_D_x_)*spring_pull_ - span_BDE_D_x_*spring_pull_*spring_span_x_
        + (span_BDE_D_y_ * span_BDE_D_y_)*spring_pull_ - span_BDE_D_y_*spring_pull_*spring_span_y_
        + span_BDE_E_x_*(held_lambda_E3_x_ - held_lambda_H_x_) - span_BDE_E_y_*(-held_lambda_E3_y_ + held_lambda_H_y_)
        + spring_pull_by_BDE_theta_*(span_BDE_D_x_*spring_span_y_ - span_BDE_D_y_*spring_span_x_);
    lin->value[36] = -(HE_omega_ * HE_omega_)*dot_BDE_HE_ - a_HE_theta_*cross_BDE_HE_;
    lin->value[37] = held_lambda_G_x_*span_AG_G_x_ + held_lambda_G_y_*span_AG_G_y_;
    lin->value[38] = held_lambda_H_x_*span_AH_H_x_ + held_lambda_H_y_*span_AH_H_y_;
    lin->value[39] = (EG_omega_ * EG_omega_)*dot_FE_EG_ + (OF_omega_ * OF_omega_)*dot_OF_FE_ + a_EG_theta_*cross_FE_EG_
        - a_OF_theta_*cross_OF_FE_ + span_FE_E_x_*(-held_lambda_E3_x_ - held_lambda_G_x_)
        - span_FE_E_y_*(held_lambda_E3_y_ + held_lambda_G_y_);
    lin->value[40] = -(EG_omega_ * EG_omega_)*dot_FE_EG_ - a_EG_theta_*cross_FE_EG_;
    lin->value[41] = -(OF_omega_ * OF_omega_)*dot_OF_FE_ + a_OF_theta_*cross_OF_FE_;
    lin->value[42] = -(BDE_omega_ * BDE_omega_)*dot_BDE_HE_ + a_BDE_theta_*cross_BDE_HE_;
    lin->value[43] = (BDE_omega_ * BDE_omega_)*dot_BDE_HE_ - a_BDE_theta_*cross_BDE_HE_ - held_lambda_H_x_*span_HE_H_x_
        - held_lambda_H_y_*span_HE_H_y_;
    lin->value[44] = -(FE_omega_ * FE_omega_)*dot_FE_EG_ + a_FE_theta_*cross_FE_EG_;
    lin->value[45] = (FE_omega_ * FE_omega_)*dot_FE_EG_ + (OF_omega_ * OF_omega_)*dot_OF_EG_ - a_FE_theta_*cross_FE_EG_
        - a_OF_theta_*cross_OF_EG_ - held_lambda_G_x_*span_EG_G_x_ - held_lambda_G_y_*span_EG_G_y_;
    lin->value[46] = -(OF_omega_ * OF_omega_)*dot_OF_EG_ + a_OF_theta_*cross_OF_EG_;
    lin->value[47] = 2.0*AG_omega_*span_AG_G_x_;
    lin->value[48] = -2.0*EG_omega_*span_EG_G_x_;
    lin->value[49] = -2.0*FE_omega_*span_FE_E_x_;
    lin->value[50] = -2.0*OF_omega_*span_OF_F_x_;
    lin->value[51] = 2.0*AG_omega_*span_AG_G_y_;
    lin->value[52] = -2.0*EG_omega_*span_EG_G_y_;
    lin->value[53] = -2.0*FE_omega_*span_FE_E_y_;
    lin->value[54] = -2.0*OF_omega_*span_OF_F_y_;
    lin->value[55] = 2.0*AH_omega_*span_AH_H_x_;
    lin->value[56] = -2.0*BDE_omega_*span_BDE_E_x_;
    lin->value[57] = -2.0*HE_omega_*span_HE_H_x_;
    lin->value[58] = 2.0*AH_omega_*span_AH_H_y_;
    lin->value[59] = -2.0*BDE_omega_*span_BDE_E_y_;
    lin->value[60] = -2.0*HE_omega_*span_HE_H_y_;
    lin->value[61] = -2.0*EG_omega_*cross_OF_EG_;
    lin->value[62] = -2.0*FE_omega_*cross_OF_FE_;
    lin->value[63] = -2.0*HE_omega_*cross_BDE_HE_;
    lin->value[64] = -2.0*EG_omega_*cross_FE_EG_;
    lin->value[65] = 2.0*OF_omega_*cross_OF_FE_;
    lin->value[66] = 2.0*BDE_omega_*cross_BDE_HE_;
    lin->value[67] = 2.0*FE_omega_*cross_FE_EG_;
    lin->value[68] = 2.0*OF_omega_*cross_OF_EG_;
    lin->value[69] = p->motor_value_;
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
    const double mass_OF_theta_FE_theta_ = lin->value[0];
    const double mass_OF_theta_EG_theta_ = lin->value[1];
    const double mass_FE_theta_EG_theta_ = lin->value[2];
    const double mass_BDE_theta_HE_theta_ = lin->value[3];
    const double phi_G_x_OF_theta_ = lin->value[4];
    const double phi_G_x_AG_theta_ = lin->value[5];
    const double phi_G_x_FE_theta_ = lin->value[6];
    const double phi_G_x_EG_theta_ = lin->value[7];
    const double phi_G_y_OF_theta_ = lin->value[8];
    const double phi_G_y_AG_theta_ = lin->value[9];
    const double phi_G_y_FE_theta_ = lin->value[10];
    const double phi_G_y_EG_theta_ = lin->value[11];
    const double phi_H_x_BDE_theta_ = lin->value[12];
    const double phi_H_x_AH_theta_ = lin->value[13];
    const double phi_H_x_HE_theta_ = lin->value[14];
    const double phi_H_y_BDE_theta_ = lin->value[15];
    const double phi_H_y_AH_theta_ = lin->value[16];
    const double phi_H_y_HE_theta_ = lin->value[17];
    const double by_q_G_x_AG_theta_ = lin->value[18];
    const double by_q_G_x_EG_theta_ = lin->value[19];
    const double by_q_G_x_FE_theta_ = lin->value[20];
    const double by_q_G_x_OF_theta_ = lin->value[21];
    const double by_q_G_y_AG_theta_ = lin->value[22];
    const double by_q_G_y_EG_theta_ = lin->value[23];
    const double by_q_G_y_FE_theta_ = lin->value[24];
    const double by_q_G_y_OF_theta_ = lin->value[25];
    const double by_q_H_x_AH_theta_ = lin->value[26];
    const double by_q_H_x_BDE_theta_ = lin->value[27];
    const double by_q_H_x_HE_theta_ = lin->value[28];
    const double by_q_H_y_AH_theta_ = lin->value[29];
    const double by_q_H_y_BDE_theta_ = lin->value[30];
    const double by_q_H_y_HE_theta_ = lin->value[31];
    const double by_q_OF_theta_OF_theta_ = lin->value[32];
    const double by_q_OF_theta_EG_theta_ = lin->value[33];
    const double by_q_OF_theta_FE_theta_ = lin->value[34];
    const double by_q_BDE_theta_BDE_theta_ = lin->value[35];
    const double by_q_BDE_theta_HE_theta_ = lin->value[36];
    const double by_q_AG_theta_AG_theta_ = lin->value[37];
    const double by_q_AH_theta_AH_theta_ = lin->value[38];
    const double by_q_FE_theta_FE_theta_ = lin->value[39];
    const double by_q_FE_theta_EG_theta_ = lin->value[40];
    const double by_q_FE_theta_OF_theta_ = lin->value[41];
    const double by_q_HE_theta_BDE_theta_ = lin->value[42];
    const double by_q_HE_theta_HE_theta_ = lin->value[43];
    const double by_q_EG_theta_FE_theta_ = lin->value[44];
    const double by_q_EG_theta_EG_theta_ = lin->value[45];
    const double by_q_EG_theta_OF_theta_ = lin->value[46];
    const double by_v_G_x_AG_theta_ = lin->value[47];
    const double by_v_G_x_EG_theta_ = lin->value[48];
    const double by_v_G_x_FE_theta_ = lin->value[49];
    const double by_v_G_x_OF_theta_ = lin->value[50];
    const double by_v_G_y_AG_theta_ = lin->value[51];
    const double by_v_G_y_EG_theta_ = lin->value[52];
    const double by_v_G_y_FE_theta_ = lin->value[53];
    const double by_v_G_y_OF_theta_ = lin->value[54];
    const double by_v_H_x_AH_theta_ = lin->value[55];
    const double by_v_H_x_BDE_theta_ = lin->value[56];
    const double by_v_H_x_HE_theta_ = lin->value[57];
    const double by_v_H_y_AH_theta_ = lin->value[58];
    const double by_v_H_y_BDE_theta_ = lin->value[59];
    const double by_v_H_y_HE_theta_ = lin->value[60];
    const double by_v_OF_theta_EG_theta_ = lin->value[61];
    const double by_v_OF_theta_FE_theta_ = lin->value[62];
    const double by_v_BDE_theta_HE_theta_ = lin->value[63];
    const double by_v_FE_theta_EG_theta_ = lin->value[64];
    const double by_v_FE_theta_OF_theta_ = lin->value[65];
    const double by_v_HE_theta_BDE_theta_ = lin->value[66];
    const double by_v_EG_theta_FE_theta_ = lin->value[67];
    const double by_v_EG_theta_OF_theta_ = lin->value[68];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_OF_theta_OF_theta_ = by_q_OF_theta_OF_theta_*(eta * eta) + p->mass_OF_OF_;
    const double n_OF_theta_FE_theta_ = eta*(by_q_OF_theta_FE_theta_*eta + by_v_OF_theta_FE_theta_)
        + mass_OF_theta_FE_theta_;
    const double n_OF_theta_EG_theta_ = eta*(by_q_OF_theta_EG_theta_*eta + by_v_OF_theta_EG_theta_)
        + mass_OF_theta_EG_theta_;
    const double n_BDE_theta_BDE_theta_ = by_q_BDE_theta_BDE_theta_*(eta * eta) + p->mass_BDE_BDE_;
    const double n_BDE_theta_HE_theta_ = eta*(by_q_BDE_theta_HE_theta_*eta + by_v_BDE_theta_HE_theta_)
        + mass_BDE_theta_HE_theta_;
    const double n_AG_theta_AG_theta_ = by_q_AG_theta_AG_theta_*(eta * eta) + p->mass_AG_AG_;
    const double n_AH_theta_AH_theta_ = by_q_AH_theta_AH_theta_*(eta * eta) + p->mass_AH_AH_;
    const double n_FE_theta_OF_theta_ = eta*(by_q_FE_theta_OF_theta_*eta + by_v_FE_theta_OF_theta_)
        + mass_OF_theta_FE_theta_;
    const double n_FE_theta_FE_theta_ = by_q_FE_theta_FE_theta_*(eta * eta) + p->mass_FE_FE_;
    const double n_FE_theta_EG_theta_ = eta*(by_q_FE_theta_EG_theta_*eta + by_v_FE_theta_EG_theta_)
        + mass_FE_theta_EG_theta_;
    const double n_HE_theta_BDE_theta_ = eta*(by_q_HE_theta_BDE_theta_*eta + by_v_HE_theta_BDE_theta_)
        + mass_BDE_theta_HE_theta_;
    const double n_HE_theta_HE_theta_ = by_q_HE_theta_HE_theta_*(eta * eta) + p->mass_HE_HE_;
    const double n_EG_theta_OF_theta_ = eta*(by_q_EG_theta_OF_theta_*eta + by_v_EG_theta_OF_theta_)
        + mass_OF_theta_EG_theta_;
    const double n_EG_theta_FE_theta_ = eta*(by_q_EG_theta_FE_theta_*eta + by_v_EG_theta_FE_theta_)
        + mass_FE_theta_EG_theta_;
    const double n_EG_theta_EG_theta_ = by_q_EG_theta_EG_theta_*(eta * eta) + p->mass_EG_EG_;
    const double n_G_x_OF_theta_ = eta_row*(by_q_G_x_OF_theta_*eta + by_v_G_x_OF_theta_) + phi_G_x_OF_theta_;
    const double n_G_x_AG_theta_ = eta_row*(by_q_G_x_AG_theta_*eta + by_v_G_x_AG_theta_) + phi_G_x_AG_theta_;
    const double n_G_x_FE_theta_ = eta_row*(by_q_G_x_FE_theta_*eta + by_v_G_x_FE_theta_) + phi_G_x_FE_theta_;
    const double n_G_x_EG_theta_ = eta_row*(by_q_G_x_EG_theta_*eta + by_v_G_x_EG_theta_) + phi_G_x_EG_theta_;
    const double n_G_y_OF_theta_ = eta_row*(by_q_G_y_OF_theta_*eta + by_v_G_y_OF_theta_) + phi_G_y_OF_theta_;
    const double n_G_y_AG_theta_ = eta_row*(by_q_G_y_AG_theta_*eta + by_v_G_y_AG_theta_) + phi_G_y_AG_theta_;
    const double n_G_y_FE_theta_ = eta_row*(by_q_G_y_FE_theta_*eta + by_v_G_y_FE_theta_) + phi_G_y_FE_theta_;
    const double n_G_y_EG_theta_ = eta_row*(by_q_G_y_EG_theta_*eta + by_v_G_y_EG_theta_) + phi_G_y_EG_theta_;
    const double n_H_x_BDE_theta_ = eta_row*(by_q_H_x_BDE_theta_*eta + by_v_H_x_BDE_theta_) + phi_H_x_BDE_theta_;
    const double n_H_x_AH_theta_ = eta_row*(by_q_H_x_AH_theta_*eta + by_v_H_x_AH_theta_) + phi_H_x_AH_theta_;
    const double n_H_x_HE_theta_ = eta_row*(by_q_H_x_HE_theta_*eta + by_v_H_x_HE_theta_) + phi_H_x_HE_theta_;
    const double n_H_y_BDE_theta_ = eta_row*(by_q_H_y_BDE_theta_*eta + by_v_H_y_BDE_theta_) + phi_H_y_BDE_theta_;
    const double n_H_y_AH_theta_ = eta_row*(by_q_H_y_AH_theta_*eta + by_v_H_y_AH_theta_) + phi_H_y_AH_theta_;
    const double n_H_y_HE_theta_ = eta_row*(by_q_H_y_HE_theta_*eta + by_v_H_y_HE_theta_) + phi_H_y_HE_theta_;
    const double n_E3_x_OF_theta_ = eta_row*(by_q_G_x_OF_theta_*eta + by_v_G_x_OF_theta_) + phi_G_x_OF_theta_;
    const double n_E3_x_BDE_theta_ = eta_row*(-by_q_H_x_BDE_theta_*eta - by_v_H_x_BDE_theta_) - phi_H_x_BDE_theta_;
    const double n_E3_x_FE_theta_ = eta_row*(by_q_G_x_FE_theta_*eta + by_v_G_x_FE_theta_) + phi_G_x_FE_theta_;
    const double n_E3_y_OF_theta_ = eta_row*(by_q_G_y_OF_theta_*eta + by_v_G_y_OF_theta_) + phi_G_y_OF_theta_;
    const double n_E3_y_BDE_theta_ = eta_row*(-by_q_H_y_BDE_theta_*eta - by_v_H_y_BDE_theta_) - phi_H_y_BDE_theta_;
    const double n_E3_y_FE_theta_ = eta_row*(by_q_G_y_FE_theta_*eta + by_v_G_y_FE_theta_) + phi_G_y_FE_theta_;

    /* L U */
    const double scale_AG_theta_ = n_AG_theta_AG_theta_;
    if (!(fabs(scale_AG_theta_) > SINGULAR * fabs(n_AG_theta_AG_theta_)))
        return 3;
    const double inverse_pivot_AG_theta_ = 1.0/scale_AG_theta_;
    lin->lu[0] = inverse_pivot_AG_theta_;
    const double l_G_x_AG_theta_ = inverse_pivot_AG_theta_*n_G_x_AG_theta_;
    lin->lu[1] = l_G_x_AG_theta_;
    const double l_G_y_AG_theta_ = inverse_pivot_AG_theta_*n_G_y_AG_theta_;
    lin->lu[2] = l_G_y_AG_theta_;
    const double scale_AH_theta_ = n_AH_theta_AH_theta_;
    if (!(fabs(scale_AH_theta_) > SINGULAR * fabs(n_AH_theta_AH_theta_)))
        return 4;
    const double inverse_pivot_AH_theta_ = 1.0/scale_AH_theta_;
    lin->lu[3] = inverse_pivot_AH_theta_;
    const double l_H_x_AH_theta_ = inverse_pivot_AH_theta_*n_H_x_AH_theta_;
    lin->lu[4] = l_H_x_AH_theta_;
    const double l_H_y_AH_theta_ = inverse_pivot_AH_theta_*n_H_y_AH_theta_;
    lin->lu[5] = l_H_y_AH_theta_;
    const double scale_HE_theta_ = n_HE_theta_HE_theta_;
    if (!(fabs(scale_HE_theta_) > SINGULAR * fabs(n_HE_theta_HE_theta_)))
        return 6;
    const double inverse_pivot_HE_theta_ = 1.0/scale_HE_theta_;
    lin->lu[6] = inverse_pivot_HE_theta_;
    const double l_BDE_theta_HE_theta_ = inverse_pivot_HE_theta_*n_BDE_theta_HE_theta_;
    lin->lu[7] = l_BDE_theta_HE_theta_;
    lin->lu[8] = n_HE_theta_BDE_theta_;
    const double l_H_x_HE_theta_ = inverse_pivot_HE_theta_*n_H_x_HE_theta_;
    lin->lu[9] = l_H_x_HE_theta_;
    const double l_H_y_HE_theta_ = inverse_pivot_HE_theta_*n_H_y_HE_theta_;
    lin->lu[10] = l_H_y_HE_theta_;
    const double scale_BDE_theta_ = -l_BDE_theta_HE_theta_*n_HE_theta_BDE_theta_ + n_BDE_theta_BDE_theta_;
    if (!(fabs(scale_BDE_theta_) > SINGULAR * fabs(n_BDE_theta_BDE_theta_)))
        return 2;
    const double inverse_pivot_BDE_theta_ = 1.0/scale_BDE_theta_;
    lin->lu[11] = inverse_pivot_BDE_theta_;
    const double l_H_x_BDE_theta_ = inverse_pivot_BDE_theta_*(-l_H_x_HE_theta_*n_HE_theta_BDE_theta_
        + n_H_x_BDE_theta_);
    lin->lu[12] = l_H_x_BDE_theta_;
    const double u_BDE_theta_H_x_ = -l_BDE_theta_HE_theta_*phi_H_x_HE_theta_ + phi_H_x_BDE_theta_;
    lin->lu[13] = u_BDE_theta_H_x_;
    const double l_H_y_BDE_theta_ = inverse_pivot_BDE_theta_*(-l_H_y_HE_theta_*n_HE_theta_BDE_theta_
        + n_H_y_BDE_theta_);
    lin->lu[14] = l_H_y_BDE_theta_;
    const double u_BDE_theta_H_y_ = -l_BDE_theta_HE_theta_*phi_H_y_HE_theta_ + phi_H_y_BDE_theta_;
    lin->lu[15] = u_BDE_theta_H_y_;
    const double l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*n_E3_x_BDE_theta_;
    lin->lu[16] = l_E3_x_BDE_theta_;
    const double l_E3_y_BDE_theta_ = inverse_pivot_BDE_theta_*n_E3_y_BDE_theta_;
    lin->lu[17] = l_E3_y_BDE_theta_;
    const double scale_H_x_ = -l_H_x_AH_theta_*phi_H_x_AH_theta_ - l_H_x_BDE_theta_*u_BDE_theta_H_x_
        - l_H_x_HE_theta_*phi_H_x_HE_theta_;
    if (!(scale_H_x_ != 0.0 && isfinite(scale_H_x_)))
        return 10;
    const double inverse_pivot_H_x_ = 1.0/scale_H_x_;
    lin->lu[18] = inverse_pivot_H_x_;
    const double l_H_y_H_x_ = inverse_pivot_H_x_*(-l_H_y_AH_theta_*phi_H_x_AH_theta_
        - l_H_y_BDE_theta_*u_BDE_theta_H_x_ - l_H_y_HE_theta_*phi_H_x_HE_theta_);
    lin->lu[19] = l_H_y_H_x_;
    const double u_H_x_H_y_ = -l_H_x_AH_theta_*phi_H_y_AH_theta_ - l_H_x_BDE_theta_*u_BDE_theta_H_y_
        - l_H_x_HE_theta_*phi_H_y_HE_theta_;
    lin->lu[20] = u_H_x_H_y_;
    const double l_E3_x_H_x_ = -inverse_pivot_H_x_*l_E3_x_BDE_theta_*u_BDE_theta_H_x_;
    lin->lu[21] = l_E3_x_H_x_;
    const double u_H_x_E3_x_ = l_H_x_BDE_theta_*phi_H_x_BDE_theta_;
    lin->lu[22] = u_H_x_E3_x_;
    const double l_E3_y_H_x_ = -inverse_pivot_H_x_*l_E3_y_BDE_theta_*u_BDE_theta_H_x_;
    lin->lu[23] = l_E3_y_H_x_;
    const double u_H_x_E3_y_ = l_H_x_BDE_theta_*phi_H_y_BDE_theta_;
    lin->lu[24] = u_H_x_E3_y_;
    const double scale_H_y_ = -l_H_y_AH_theta_*phi_H_y_AH_theta_ - l_H_y_BDE_theta_*u_BDE_theta_H_y_
        - l_H_y_HE_theta_*phi_H_y_HE_theta_;
    const double pivot_H_y_ = -l_H_y_H_x_*u_H_x_H_y_ + scale_H_y_;
    if (!(fabs(pivot_H_y_) > SINGULAR * fabs(scale_H_y_)))
        return 11;
    const double inverse_pivot_H_y_ = 1.0/pivot_H_y_;
    lin->lu[25] = inverse_pivot_H_y_;
    const double l_E3_x_H_y_ = inverse_pivot_H_y_*(-l_E3_x_BDE_theta_*u_BDE_theta_H_y_ - l_E3_x_H_x_*u_H_x_H_y_);
    lin->lu[26] = l_E3_x_H_y_;
    const double u_H_y_E3_x_ = l_H_y_BDE_theta_*phi_H_x_BDE_theta_ - l_H_y_H_x_*u_H_x_E3_x_;
    lin->lu[27] = u_H_y_E3_x_;
    const double l_E3_y_H_y_ = inverse_pivot_H_y_*(-l_E3_y_BDE_theta_*u_BDE_theta_H_y_ - l_E3_y_H_x_*u_H_x_H_y_);
    lin->lu[28] = l_E3_y_H_y_;
    const double u_H_y_E3_y_ = l_H_y_BDE_theta_*phi_H_y_BDE_theta_ - l_H_y_H_x_*u_H_x_E3_y_;
    lin->lu[29] = u_H_y_E3_y_;
    const double scale_EG_theta_ = n_EG_theta_EG_theta_;
    if (!(fabs(scale_EG_theta_) > SINGULAR * fabs(n_EG_theta_EG_theta_)))
        return 7;
    const double inverse_pivot_EG_theta_ = 1.0/scale_EG_theta_;
    lin->lu[30] = inverse_pivot_EG_theta_;
    const double l_OF_theta_EG_theta_ = inverse_pivot_EG_theta_*n_OF_theta_EG_theta_;
    lin->lu[31] = l_OF_theta_EG_theta_;
    lin->lu[32] = n_EG_theta_OF_theta_;
    const double l_FE_theta_EG_theta_ = inverse_pivot_EG_theta_*n_FE_theta_EG_theta_;
    lin->lu[33] = l_FE_theta_EG_theta_;
    lin->lu[34] = n_EG_theta_FE_theta_;
    const double l_G_x_EG_theta_ = inverse_pivot_EG_theta_*n_G_x_EG_theta_;
    lin->lu[35] = l_G_x_EG_theta_;
    const double l_G_y_EG_theta_ = inverse_pivot_EG_theta_*n_G_y_EG_theta_;
    lin->lu[36] = l_G_y_EG_theta_;
    const double scale_OF_theta_ = -l_OF_theta_EG_theta_*n_EG_theta_OF_theta_ + n_OF_theta_OF_theta_;
    if (!(fabs(scale_OF_theta_) > SINGULAR * fabs(n_OF_theta_OF_theta_)))
        return 1;
    const double inverse_pivot_OF_theta_ = 1.0/scale_OF_theta_;
    lin->lu[37] = inverse_pivot_OF_theta_;
    const double l_FE_theta_OF_theta_ = inverse_pivot_OF_theta_*(-l_FE_theta_EG_theta_*n_EG_theta_OF_theta_
        + n_FE_theta_OF_theta_);
    lin->lu[38] = l_FE_theta_OF_theta_;
    const double u_OF_theta_FE_theta_ = -l_OF_theta_EG_theta_*n_EG_theta_FE_theta_ + n_OF_theta_FE_theta_;
    lin->lu[39] = u_OF_theta_FE_theta_;
    const double l_G_x_OF_theta_ = inverse_pivot_OF_theta_*(-l_G_x_EG_theta_*n_EG_theta_OF_theta_ + n_G_x_OF_theta_);
    lin->lu[40] = l_G_x_OF_theta_;
    const double u_OF_theta_G_x_ = -l_OF_theta_EG_theta_*phi_G_x_EG_theta_ + phi_G_x_OF_theta_;
    lin->lu[41] = u_OF_theta_G_x_;
    const double l_G_y_OF_theta_ = inverse_pivot_OF_theta_*(-l_G_y_EG_theta_*n_EG_theta_OF_theta_ + n_G_y_OF_theta_);
    lin->lu[42] = l_G_y_OF_theta_;
    const double u_OF_theta_G_y_ = -l_OF_theta_EG_theta_*phi_G_y_EG_theta_ + phi_G_y_OF_theta_;
    lin->lu[43] = u_OF_theta_G_y_;
    const double l_E3_x_OF_theta_ = inverse_pivot_OF_theta_*n_E3_x_OF_theta_;
    lin->lu[44] = l_E3_x_OF_theta_;
    const double l_E3_y_OF_theta_ = inverse_pivot_OF_theta_*n_E3_y_OF_theta_;
    lin->lu[45] = l_E3_y_OF_theta_;
    const double scale_FE_theta_ = -l_FE_theta_EG_theta_*n_EG_theta_FE_theta_
        - l_FE_theta_OF_theta_*u_OF_theta_FE_theta_ + n_FE_theta_FE_theta_;
    if (!(fabs(scale_FE_theta_) > SINGULAR * fabs(n_FE_theta_FE_theta_)))
        return 5;
    const double inverse_pivot_FE_theta_ = 1.0/scale_FE_theta_;
    lin->lu[46] = inverse_pivot_FE_theta_;
    const double l_G_x_FE_theta_ = inverse_pivot_FE_theta_*(-l_G_x_EG_theta_*n_EG_theta_FE_theta_
        - l_G_x_OF_theta_*u_OF_theta_FE_theta_ + n_G_x_FE_theta_);
    lin->lu[47] = l_G_x_FE_theta_;
    const double u_FE_theta_G_x_ = -l_FE_theta_EG_theta_*phi_G_x_EG_theta_ - l_FE_theta_OF_theta_*u_OF_theta_G_x_
        + phi_G_x_FE_theta_;
    lin->lu[48] = u_FE_theta_G_x_;
    const double l_G_y_FE_theta_ = inverse_pivot_FE_theta_*(-l_G_y_EG_theta_*n_EG_theta_FE_theta_
        - l_G_y_OF_theta_*u_OF_theta_FE_theta_ + n_G_y_FE_theta_);
    lin->lu[49] = l_G_y_FE_theta_;
    const double u_FE_theta_G_y_ = -l_FE_theta_EG_theta_*phi_G_y_EG_theta_ - l_FE_theta_OF_theta_*u_OF_theta_G_y_
        + phi_G_y_FE_theta_;
    lin->lu[50] = u_FE_theta_G_y_;
    const double l_E3_x_FE_theta_ = inverse_pivot_FE_theta_*(-l_E3_x_OF_theta_*u_OF_theta_FE_theta_ + n_E3_x_FE_theta_);
    lin->lu[51] = l_E3_x_FE_theta_;
    const double u_FE_theta_E3_x_ = -l_FE_theta_OF_theta_*phi_G_x_OF_theta_ + phi_G_x_FE_theta_;
    lin->lu[52] = u_FE_theta_E3_x_;
    const double l_E3_y_FE_theta_ = inverse_pivot_FE_theta_*(-l_E3_y_OF_theta_*u_OF_theta_FE_theta_ + n_E3_y_FE_theta_);
    lin->lu[53] = l_E3_y_FE_theta_;
    const double u_FE_theta_E3_y_ = -l_FE_theta_OF_theta_*phi_G_y_OF_theta_ + phi_G_y_FE_theta_;
    lin->lu[54] = u_FE_theta_E3_y_;
    const double scale_G_x_ = -l_G_x_AG_theta_*phi_G_x_AG_theta_ - l_G_x_EG_theta_*phi_G_x_EG_theta_
        - l_G_x_FE_theta_*u_FE_theta_G_x_ - l_G_x_OF_theta_*u_OF_theta_G_x_;
    if (!(scale_G_x_ != 0.0 && isfinite(scale_G_x_)))
        return 8;
    const double inverse_pivot_G_x_ = 1.0/scale_G_x_;
    lin->lu[55] = inverse_pivot_G_x_;
    const double l_G_y_G_x_ = inverse_pivot_G_x_*(-l_G_y_AG_theta_*phi_G_x_AG_theta_
        - l_G_y_EG_theta_*phi_G_x_EG_theta_ - l_G_y_FE_theta_*u_FE_theta_G_x_ - l_G_y_OF_theta_*u_OF_theta_G_x_);
    lin->lu[56] = l_G_y_G_x_;
    const double u_G_x_G_y_ = -l_G_x_AG_theta_*phi_G_y_AG_theta_ - l_G_x_EG_theta_*phi_G_y_EG_theta_
        - l_G_x_FE_theta_*u_FE_theta_G_y_ - l_G_x_OF_theta_*u_OF_theta_G_y_;
    lin->lu[57] = u_G_x_G_y_;
    const double l_E3_x_G_x_ = inverse_pivot_G_x_*(-l_E3_x_FE_theta_*u_FE_theta_G_x_
        - l_E3_x_OF_theta_*u_OF_theta_G_x_);
    lin->lu[58] = l_E3_x_G_x_;
    const double u_G_x_E3_x_ = -l_G_x_FE_theta_*u_FE_theta_E3_x_ - l_G_x_OF_theta_*phi_G_x_OF_theta_;
    lin->lu[59] = u_G_x_E3_x_;
    const double l_E3_y_G_x_ = inverse_pivot_G_x_*(-l_E3_y_FE_theta_*u_FE_theta_G_x_
        - l_E3_y_OF_theta_*u_OF_theta_G_x_);
    lin->lu[60] = l_E3_y_G_x_;
    const double u_G_x_E3_y_ = -l_G_x_FE_theta_*u_FE_theta_E3_y_ - l_G_x_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[61] = u_G_x_E3_y_;
    const double scale_G_y_ = -l_G_y_AG_theta_*phi_G_y_AG_theta_ - l_G_y_EG_theta_*phi_G_y_EG_theta_
        - l_G_y_FE_theta_*u_FE_theta_G_y_ - l_G_y_OF_theta_*u_OF_theta_G_y_;
    const double pivot_G_y_ = -l_G_y_G_x_*u_G_x_G_y_ + scale_G_y_;
    if (!(fabs(pivot_G_y_) > SINGULAR * fabs(scale_G_y_)))
        return 9;
    const double inverse_pivot_G_y_ = 1.0/pivot_G_y_;
    lin->lu[62] = inverse_pivot_G_y_;
    const double l_E3_x_G_y_ = inverse_pivot_G_y_*(-l_E3_x_FE_theta_*u_FE_theta_G_y_ - l_E3_x_G_x_*u_G_x_G_y_
        - l_E3_x_OF_theta_*u_OF_theta_G_y_);
    lin->lu[63] = l_E3_x_G_y_;
    const double u_G_y_E3_x_ = -l_G_y_FE_theta_*u_FE_theta_E3_x_ - l_G_y_G_x_*u_G_x_E3_x_
        - l_G_y_OF_theta_*phi_G_x_OF_theta_;
    lin->lu[64] = u_G_y_E3_x_;
    const double l_E3_y_G_y_ = inverse_pivot_G_y_*(-l_E3_y_FE_theta_*u_FE_theta_G_y_ - l_E3_y_G_x_*u_G_x_G_y_
        - l_E3_y_OF_theta_*u_OF_theta_G_y_);
    lin->lu[65] = l_E3_y_G_y_;
    const double u_G_y_E3_y_ = -l_G_y_FE_theta_*u_FE_theta_E3_y_ - l_G_y_G_x_*u_G_x_E3_y_
        - l_G_y_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[66] = u_G_y_E3_y_;
    const double scale_E3_x_ = l_E3_x_BDE_theta_*phi_H_x_BDE_theta_ - l_E3_x_FE_theta_*u_FE_theta_E3_x_
        - l_E3_x_OF_theta_*phi_G_x_OF_theta_;
    const double pivot_E3_x_ = -l_E3_x_G_x_*u_G_x_E3_x_ - l_E3_x_G_y_*u_G_y_E3_x_ - l_E3_x_H_x_*u_H_x_E3_x_
        - l_E3_x_H_y_*u_H_y_E3_x_ + scale_E3_x_;
    if (!(fabs(pivot_E3_x_) > SINGULAR * fabs(scale_E3_x_)))
        return 12;
    const double inverse_pivot_E3_x_ = 1.0/pivot_E3_x_;
    lin->lu[67] = inverse_pivot_E3_x_;
    const double l_E3_y_E3_x_ = inverse_pivot_E3_x_*(l_E3_y_BDE_theta_*phi_H_x_BDE_theta_
        - l_E3_y_FE_theta_*u_FE_theta_E3_x_ - l_E3_y_G_x_*u_G_x_E3_x_ - l_E3_y_G_y_*u_G_y_E3_x_
        - l_E3_y_H_x_*u_H_x_E3_x_ - l_E3_y_H_y_*u_H_y_E3_x_ - l_E3_y_OF_theta_*phi_G_x_OF_theta_);
    lin->lu[68] = l_E3_y_E3_x_;
    const double u_E3_x_E3_y_ = l_E3_x_BDE_theta_*phi_H_y_BDE_theta_ - l_E3_x_FE_theta_*u_FE_theta_E3_y_
        - l_E3_x_G_x_*u_G_x_E3_y_ - l_E3_x_G_y_*u_G_y_E3_y_ - l_E3_x_H_x_*u_H_x_E3_y_ - l_E3_x_H_y_*u_H_y_E3_y_
        - l_E3_x_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[69] = u_E3_x_E3_y_;
    const double scale_E3_y_ = l_E3_y_BDE_theta_*phi_H_y_BDE_theta_ - l_E3_y_FE_theta_*u_FE_theta_E3_y_
        - l_E3_y_OF_theta_*phi_G_y_OF_theta_;
    const double pivot_E3_y_ = -l_E3_y_E3_x_*u_E3_x_E3_y_ - l_E3_y_G_x_*u_G_x_E3_y_ - l_E3_y_G_y_*u_G_y_E3_y_
        - l_E3_y_H_x_*u_H_x_E3_y_ - l_E3_y_H_y_*u_H_y_E3_y_ + scale_E3_y_;
    if (!(fabs(pivot_E3_y_) > SINGULAR * fabs(scale_E3_y_)))
        return 13;
    const double inverse_pivot_E3_y_ = 1.0/pivot_E3_y_;
    lin->lu[70] = inverse_pivot_E3_y_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_G_x_OF_theta_ = lin->value[4];
    const double phi_G_x_AG_theta_ = lin->value[5];
    const double phi_G_x_EG_theta_ = lin->value[7];
    const double phi_G_y_OF_theta_ = lin->value[8];
    const double phi_G_y_AG_theta_ = lin->value[9];
    const double phi_G_y_EG_theta_ = lin->value[11];
    const double phi_H_x_BDE_theta_ = lin->value[12];
    const double phi_H_x_AH_theta_ = lin->value[13];
    const double phi_H_x_HE_theta_ = lin->value[14];
    const double phi_H_y_BDE_theta_ = lin->value[15];
    const double phi_H_y_AH_theta_ = lin->value[16];
    const double phi_H_y_HE_theta_ = lin->value[17];
    const double inverse_pivot_AG_theta_ = lin->lu[0];
    const double l_G_x_AG_theta_ = lin->lu[1];
    const double l_G_y_AG_theta_ = lin->lu[2];
    const double inverse_pivot_AH_theta_ = lin->lu[3];
    const double l_H_x_AH_theta_ = lin->lu[4];
    const double l_H_y_AH_theta_ = lin->lu[5];
    const double inverse_pivot_HE_theta_ = lin->lu[6];
    const double l_BDE_theta_HE_theta_ = lin->lu[7];
    const double n_HE_theta_BDE_theta_ = lin->lu[8];
    const double l_H_x_HE_theta_ = lin->lu[9];
    const double l_H_y_HE_theta_ = lin->lu[10];
    const double inverse_pivot_BDE_theta_ = lin->lu[11];
    const double l_H_x_BDE_theta_ = lin->lu[12];
    const double u_BDE_theta_H_x_ = lin->lu[13];
    const double l_H_y_BDE_theta_ = lin->lu[14];
    const double u_BDE_theta_H_y_ = lin->lu[15];
    const double l_E3_x_BDE_theta_ = lin->lu[16];
    const double l_E3_y_BDE_theta_ = lin->lu[17];
    const double inverse_pivot_H_x_ = lin->lu[18];
    const double l_H_y_H_x_ = lin->lu[19];
    const double u_H_x_H_y_ = lin->lu[20];
    const double l_E3_x_H_x_ = lin->lu[21];
    const double u_H_x_E3_x_ = lin->lu[22];
    const double l_E3_y_H_x_ = lin->lu[23];
    const double u_H_x_E3_y_ = lin->lu[24];
    const double inverse_pivot_H_y_ = lin->lu[25];
    const double l_E3_x_H_y_ = lin->lu[26];
    const double u_H_y_E3_x_ = lin->lu[27];
    const double l_E3_y_H_y_ = lin->lu[28];
    const double u_H_y_E3_y_ = lin->lu[29];
    const double inverse_pivot_EG_theta_ = lin->lu[30];
    const double l_OF_theta_EG_theta_ = lin->lu[31];
    const double n_EG_theta_OF_theta_ = lin->lu[32];
    const double l_FE_theta_EG_theta_ = lin->lu[33];
    const double n_EG_theta_FE_theta_ = lin->lu[34];
    const double l_G_x_EG_theta_ = lin->lu[35];
    const double l_G_y_EG_theta_ = lin->lu[36];
    const double inverse_pivot_OF_theta_ = lin->lu[37];
    const double l_FE_theta_OF_theta_ = lin->lu[38];
    const double u_OF_theta_FE_theta_ = lin->lu[39];
    const double l_G_x_OF_theta_ = lin->lu[40];
    const double u_OF_theta_G_x_ = lin->lu[41];
    const double l_G_y_OF_theta_ = lin->lu[42];
    const double u_OF_theta_G_y_ = lin->lu[43];
    const double l_E3_x_OF_theta_ = lin->lu[44];
    const double l_E3_y_OF_theta_ = lin->lu[45];
    const double inverse_pivot_FE_theta_ = lin->lu[46];
    const double l_G_x_FE_theta_ = lin->lu[47];
    const double u_FE_theta_G_x_ = lin->lu[48];
    const double l_G_y_FE_theta_ = lin->lu[49];
    const double u_FE_theta_G_y_ = lin->lu[50];
    const double l_E3_x_FE_theta_ = lin->lu[51];
    const double u_FE_theta_E3_x_ = lin->lu[52];
    const double l_E3_y_FE_theta_ = lin->lu[53];
    const double u_FE_theta_E3_y_ = lin->lu[54];
    const double inverse_pivot_G_x_ = lin->lu[55];
    const double l_G_y_G_x_ = lin->lu[56];
    const double u_G_x_G_y_ = lin->lu[57];
    const double l_E3_x_G_x_ = lin->lu[58];
    const double u_G_x_E3_x_ = lin->lu[59];
    const double l_E3_y_G_x_ = lin->lu[60];
    const double u_G_x_E3_y_ = lin->lu[61];
    const double inverse_pivot_G_y_ = lin->lu[62];
    const double l_E3_x_G_y_ = lin->lu[63];
    const double u_G_y_E3_x_ = lin->lu[64];
    const double l_E3_y_G_y_ = lin->lu[65];
    const double u_G_y_E3_y_ = lin->lu[66];
    const double inverse_pivot_E3_x_ = lin->lu[67];
    const double l_E3_y_E3_x_ = lin->lu[68];
    const double u_E3_x_E3_y_ = lin->lu[69];
    const double inverse_pivot_E3_y_ = lin->lu[70];

    /* forward */
    const double b_AG_theta_ = x[2];
    const double b_AH_theta_ = x[3];
    const double b_HE_theta_ = x[5];
    const double b_BDE_theta_ = -b_HE_theta_*l_BDE_theta_HE_theta_ + x[1];
    const double b_H_x_ = -b_AH_theta_*l_H_x_AH_theta_ - b_BDE_theta_*l_H_x_BDE_theta_ - b_HE_theta_*l_H_x_HE_theta_
        + x[9];
    const double b_H_y_ = -b_AH_theta_*l_H_y_AH_theta_ - b_BDE_theta_*l_H_y_BDE_theta_ - b_HE_theta_*l_H_y_HE_theta_
        - b_H_x_*l_H_y_H_x_ + x[10];
    const double b_EG_theta_ = x[6];
    const double b_OF_theta_ = -b_EG_theta_*l_OF_theta_EG_theta_ + x[0];
    const double b_FE_theta_ = -b_EG_theta_*l_FE_theta_EG_theta_ - b_OF_theta_*l_FE_theta_OF_theta_ + x[4];
    const double b_G_x_ = -b_AG_theta_*l_G_x_AG_theta_ - b_EG_theta_*l_G_x_EG_theta_ - b_FE_theta_*l_G_x_FE_theta_
        - b_OF_theta_*l_G_x_OF_theta_ + x[7];
    const double b_G_y_ = -b_AG_theta_*l_G_y_AG_theta_ - b_EG_theta_*l_G_y_EG_theta_ - b_FE_theta_*l_G_y_FE_theta_
        - b_G_x_*l_G_y_G_x_ - b_OF_theta_*l_G_y_OF_theta_ + x[8];
    const double b_E3_x_ = -b_BDE_theta_*l_E3_x_BDE_theta_ - b_FE_theta_*l_E3_x_FE_theta_ - b_G_x_*l_E3_x_G_x_
        - b_G_y_*l_E3_x_G_y_ - b_H_x_*l_E3_x_H_x_ - b_H_y_*l_E3_x_H_y_ - b_OF_theta_*l_E3_x_OF_theta_ + x[11];
    const double b_E3_y_ = -b_BDE_theta_*l_E3_y_BDE_theta_ - b_E3_x_*l_E3_y_E3_x_ - b_FE_theta_*l_E3_y_FE_theta_
        - b_G_x_*l_E3_y_G_x_ - b_G_y_*l_E3_y_G_y_ - b_H_x_*l_E3_y_H_x_ - b_H_y_*l_E3_y_H_y_
        - b_OF_theta_*l_E3_y_OF_theta_ + x[12];

    /* backward */
    const double x_E3_y_ = b_E3_y_*inverse_pivot_E3_y_;
    x[12] = x_E3_y_;
    const double x_E3_x_ = inverse_pivot_E3_x_*(b_E3_x_ - u_E3_x_E3_y_*x_E3_y_);
    x[11] = x_E3_x_;
    const double x_G_y_ = inverse_pivot_G_y_*(b_G_y_ - u_G_y_E3_x_*x_E3_x_ - u_G_y_E3_y_*x_E3_y_);
    x[8] = x_G_y_;
    const double x_G_x_ = inverse_pivot_G_x_*(b_G_x_ - u_G_x_E3_x_*x_E3_x_ - u_G_x_E3_y_*x_E3_y_ - u_G_x_G_y_*x_G_y_);
    x[7] = x_G_x_;
    const double x_FE_theta_ = inverse_pivot_FE_theta_*(b_FE_theta_ - u_FE_theta_E3_x_*x_E3_x_
        - u_FE_theta_E3_y_*x_E3_y_ - u_FE_theta_G_x_*x_G_x_ - u_FE_theta_G_y_*x_G_y_);
    x[4] = x_FE_theta_;
    const double x_OF_theta_ = inverse_pivot_OF_theta_*(b_OF_theta_ - phi_G_x_OF_theta_*x_E3_x_
        - phi_G_y_OF_theta_*x_E3_y_ - u_OF_theta_FE_theta_*x_FE_theta_ - u_OF_theta_G_x_*x_G_x_
        - u_OF_theta_G_y_*x_G_y_);
    x[0] = x_OF_theta_;
    const double x_EG_theta_ = inverse_pivot_EG_theta_*(b_EG_theta_ - n_EG_theta_FE_theta_*x_FE_theta_
        - n_EG_theta_OF_theta_*x_OF_theta_ - phi_G_x_EG_theta_*x_G_x_ - phi_G_y_EG_theta_*x_G_y_);
    x[6] = x_EG_theta_;
    const double x_H_y_ = inverse_pivot_H_y_*(b_H_y_ - u_H_y_E3_x_*x_E3_x_ - u_H_y_E3_y_*x_E3_y_);
    x[10] = x_H_y_;
    const double x_H_x_ = inverse_pivot_H_x_*(b_H_x_ - u_H_x_E3_x_*x_E3_x_ - u_H_x_E3_y_*x_E3_y_ - u_H_x_H_y_*x_H_y_);
    x[9] = x_H_x_;
    const double x_BDE_theta_ = inverse_pivot_BDE_theta_*(b_BDE_theta_ + phi_H_x_BDE_theta_*x_E3_x_
        + phi_H_y_BDE_theta_*x_E3_y_ - u_BDE_theta_H_x_*x_H_x_ - u_BDE_theta_H_y_*x_H_y_);
    x[1] = x_BDE_theta_;
    const double x_HE_theta_ = inverse_pivot_HE_theta_*(b_HE_theta_ - n_HE_theta_BDE_theta_*x_BDE_theta_
        - phi_H_x_HE_theta_*x_H_x_ - phi_H_y_HE_theta_*x_H_y_);
    x[5] = x_HE_theta_;
    const double x_AH_theta_ = inverse_pivot_AH_theta_*(b_AH_theta_ - phi_H_x_AH_theta_*x_H_x_
        - phi_H_y_AH_theta_*x_H_y_);
    x[3] = x_AH_theta_;
    const double x_AG_theta_ = inverse_pivot_AG_theta_*(b_AG_theta_ - phi_G_x_AG_theta_*x_G_x_
        - phi_G_y_AG_theta_*x_G_y_);
    x[2] = x_AG_theta_;
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
    const double mass_OF_theta_FE_theta_ = lin->value[0];
    const double mass_OF_theta_EG_theta_ = lin->value[1];
    const double mass_FE_theta_EG_theta_ = lin->value[2];
    const double mass_BDE_theta_HE_theta_ = lin->value[3];
    const double phi_G_x_OF_theta_ = lin->value[4];
    const double phi_G_x_AG_theta_ = lin->value[5];
    const double phi_G_x_FE_theta_ = lin->value[6];
    const double phi_G_x_EG_theta_ = lin->value[7];
    const double phi_G_y_OF_theta_ = lin->value[8];
    const double phi_G_y_AG_theta_ = lin->value[9];
    const double phi_G_y_FE_theta_ = lin->value[10];
    const double phi_G_y_EG_theta_ = lin->value[11];
    const double phi_H_x_BDE_theta_ = lin->value[12];
    const double phi_H_x_AH_theta_ = lin->value[13];
    const double phi_H_x_HE_theta_ = lin->value[14];
    const double phi_H_y_BDE_theta_ = lin->value[15];
    const double phi_H_y_AH_theta_ = lin->value[16];
    const double phi_H_y_HE_theta_ = lin->value[17];
    const double by_q_G_x_AG_theta_ = lin->value[18];
    const double by_q_G_x_EG_theta_ = lin->value[19];
    const double by_q_G_x_FE_theta_ = lin->value[20];
    const double by_q_G_x_OF_theta_ = lin->value[21];
    const double by_q_G_y_AG_theta_ = lin->value[22];
    const double by_q_G_y_EG_theta_ = lin->value[23];
    const double by_q_G_y_FE_theta_ = lin->value[24];
    const double by_q_G_y_OF_theta_ = lin->value[25];
    const double by_q_H_x_AH_theta_ = lin->value[26];
    const double by_q_H_x_BDE_theta_ = lin->value[27];
    const double by_q_H_x_HE_theta_ = lin->value[28];
    const double by_q_H_y_AH_theta_ = lin->value[29];
    const double by_q_H_y_BDE_theta_ = lin->value[30];
    const double by_q_H_y_HE_theta_ = lin->value[31];
    const double by_q_OF_theta_OF_theta_ = lin->value[32];
    const double by_q_OF_theta_EG_theta_ = lin->value[33];
    const double by_q_OF_theta_FE_theta_ = lin->value[34];
    const double by_q_BDE_theta_BDE_theta_ = lin->value[35];
    const double by_q_BDE_theta_HE_theta_ = lin->value[36];
    const double by_q_AG_theta_AG_theta_ = lin->value[37];
    const double by_q_AH_theta_AH_theta_ = lin->value[38];
    const double by_q_FE_theta_FE_theta_ = lin->value[39];
    const double by_q_FE_theta_EG_theta_ = lin->value[40];
    const double by_q_FE_theta_OF_theta_ = lin->value[41];
    const double by_q_HE_theta_BDE_theta_ = lin->value[42];
    const double by_q_HE_theta_HE_theta_ = lin->value[43];
    const double by_q_EG_theta_FE_theta_ = lin->value[44];
    const double by_q_EG_theta_EG_theta_ = lin->value[45];
    const double by_q_EG_theta_OF_theta_ = lin->value[46];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[13];
    const double shifted_OF_theta_ = -p->beta_squared_*eta*r[0] + r[7];
    const double shifted_BDE_theta_ = -p->beta_squared_*eta*r[1] + r[8];
    const double shifted_AG_theta_ = -p->beta_squared_*eta*r[2] + r[9];
    const double shifted_AH_theta_ = -p->beta_squared_*eta*r[3] + r[10];
    const double shifted_FE_theta_ = -p->beta_squared_*eta*r[4] + r[11];
    const double shifted_HE_theta_ = -p->beta_squared_*eta*r[5] + r[12];
    const double shifted_EG_theta_ = -p->beta_squared_*eta*r[6] + r[13];
    x[0] = eta*(-by_q_OF_theta_EG_theta_*eta*r[6] - by_q_OF_theta_FE_theta_*eta*r[4] - by_q_OF_theta_OF_theta_*eta*r[0]
        + p->mass_OF_OF_*r[7] + mass_OF_theta_EG_theta_*r[13] + mass_OF_theta_FE_theta_*r[11]);
    x[1] = eta*(-by_q_BDE_theta_BDE_theta_*eta*r[1] - by_q_BDE_theta_HE_theta_*eta*r[5] + p->mass_BDE_BDE_*r[8]
        + mass_BDE_theta_HE_theta_*r[12]);
    x[2] = eta*(-by_q_AG_theta_AG_theta_*eta*r[2] + p->mass_AG_AG_*r[9]);
    x[3] = eta*(-by_q_AH_theta_AH_theta_*eta*r[3] + p->mass_AH_AH_*r[10]);
    x[4] = eta*(-by_q_FE_theta_EG_theta_*eta*r[6] - by_q_FE_theta_FE_theta_*eta*r[4] - by_q_FE_theta_OF_theta_*eta*r[0]
        + p->mass_FE_FE_*r[11] + mass_FE_theta_EG_theta_*r[13] + mass_OF_theta_FE_theta_*r[7]);
    x[5] = eta*(-by_q_HE_theta_BDE_theta_*eta*r[1] - by_q_HE_theta_HE_theta_*eta*r[5] + mass_BDE_theta_HE_theta_*r[8]
        + p->mass_HE_HE_*r[12]);
    x[6] = eta*(-by_q_EG_theta_EG_theta_*eta*r[6] - by_q_EG_theta_FE_theta_*eta*r[4] - by_q_EG_theta_OF_theta_*eta*r[0]
        + p->mass_EG_EG_*r[13] + mass_FE_theta_EG_theta_*r[11] + mass_OF_theta_EG_theta_*r[7]);
    x[7] = eta_row*(-by_q_G_x_AG_theta_*eta*r[2] - by_q_G_x_EG_theta_*eta*r[6] - by_q_G_x_FE_theta_*eta*r[4]
        - by_q_G_x_OF_theta_*eta*r[0] + phi_G_x_AG_theta_*shifted_AG_theta_ + phi_G_x_EG_theta_*shifted_EG_theta_
        + phi_G_x_FE_theta_*shifted_FE_theta_ + phi_G_x_OF_theta_*shifted_OF_theta_);
    x[8] = eta_row*(-by_q_G_y_AG_theta_*eta*r[2] - by_q_G_y_EG_theta_*eta*r[6] - by_q_G_y_FE_theta_*eta*r[4]
        - by_q_G_y_OF_theta_*eta*r[0] + phi_G_y_AG_theta_*shifted_AG_theta_ + phi_G_y_EG_theta_*shifted_EG_theta_
        + phi_G_y_FE_theta_*shifted_FE_theta_ + phi_G_y_OF_theta_*shifted_OF_theta_);
    x[9] = eta_row*(-by_q_H_x_AH_theta_*eta*r[3] - by_q_H_x_BDE_theta_*eta*r[1] - by_q_H_x_HE_theta_*eta*r[5]
        + phi_H_x_AH_theta_*shifted_AH_theta_ + phi_H_x_BDE_theta_*shifted_BDE_theta_
        + phi_H_x_HE_theta_*shifted_HE_theta_);
    x[10] = eta_row*(-by_q_H_y_AH_theta_*eta*r[3] - by_q_H_y_BDE_theta_*eta*r[1] - by_q_H_y_HE_theta_*eta*r[5]
        + phi_H_y_AH_theta_*shifted_AH_theta_ + phi_H_y_BDE_theta_*shifted_BDE_theta_
        + phi_H_y_HE_theta_*shifted_HE_theta_);
    x[11] = eta_row*(-by_q_G_x_FE_theta_*eta*r[4] - by_q_G_x_OF_theta_*eta*r[0] + by_q_H_x_BDE_theta_*eta*r[1]
        + phi_G_x_FE_theta_*shifted_FE_theta_ + phi_G_x_OF_theta_*shifted_OF_theta_
        - phi_H_x_BDE_theta_*shifted_BDE_theta_);
    x[12] = eta_row*(-by_q_G_y_FE_theta_*eta*r[4] - by_q_G_y_OF_theta_*eta*r[0] + by_q_H_y_BDE_theta_*eta*r[1]
        + phi_G_y_FE_theta_*shifted_FE_theta_ + phi_G_y_OF_theta_*shifted_OF_theta_
        - phi_H_y_BDE_theta_*shifted_BDE_theta_);
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
    u[15] = eta*(p->motor_value_*u[7] + r[15]);
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
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta_, HE_theta_, EG_theta_, EG_theta_};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
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

    /* Phi and Phi_dot */
    const double phi_G_x_ = -p->A_x_ - span_AG_G_x_ + span_EG_G_x_ + span_FE_E_x_ + span_OF_F_x_;
    const double phi_dot_G_x_ = AG_omega_*span_AG_G_y_ - EG_omega_*span_EG_G_y_ - FE_omega_*span_FE_E_y_
        - OF_omega_*span_OF_F_y_;
    const double phi_G_y_ = -p->A_y_ - span_AG_G_y_ + span_EG_G_y_ + span_FE_E_y_ + span_OF_F_y_;
    const double phi_dot_G_y_ = -AG_omega_*span_AG_G_x_ + EG_omega_*span_EG_G_x_ + FE_omega_*span_FE_E_x_
        + OF_omega_*span_OF_F_x_;
    const double phi_H_x_ = -p->A_x_ + p->B_x_ - span_AH_H_x_ + span_BDE_E_x_ + span_HE_H_x_;
    const double phi_dot_H_x_ = AH_omega_*span_AH_H_y_ - BDE_omega_*span_BDE_E_y_ - HE_omega_*span_HE_H_y_;
    const double phi_H_y_ = -p->A_y_ + p->B_y_ - span_AH_H_y_ + span_BDE_E_y_ + span_HE_H_y_;
    const double phi_dot_H_y_ = -AH_omega_*span_AH_H_x_ + BDE_omega_*span_BDE_E_x_ + HE_omega_*span_HE_H_x_;
    const double phi_E3_x_ = -p->B_x_ - span_BDE_E_x_ + span_FE_E_x_ + span_OF_F_x_;
    const double phi_dot_E3_x_ = BDE_omega_*span_BDE_E_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;
    const double phi_E3_y_ = -p->B_y_ - span_BDE_E_y_ + span_FE_E_y_ + span_OF_F_y_;
    const double phi_dot_E3_y_ = -BDE_omega_*span_BDE_E_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;

    /* L D L^T of the KKT matrix */
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
    if (!(determinant_H_x_H_y_ > memory->least_size * scale_H_y_ * scale_H_x_))
        return 2;
    const double size_H_x_ = scale_H_x_ + scale_H_y_;
    if (!(scale_H_x_ > memory->least_size * size_H_x_))
        return 1;
    if (!(determinant_H_x_H_y_ > memory->least_size * size_H_x_ * scale_H_x_))
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
    if (!(determinant_G_x_G_y_ > memory->least_size * scale_G_y_ * scale_G_x_))
        return 4;
    const double size_G_x_ = scale_G_x_ + scale_G_y_;
    if (!(scale_G_x_ > memory->least_size * size_G_x_))
        return 3;
    if (!(determinant_G_x_G_y_ > memory->least_size * size_G_x_ * scale_G_x_))
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
    if (!(pivot_E3_x_ > memory->least_size * scale_E3_x_))
        return 5;
    if (!(determinant_E3_x_E3_y_ > memory->least_size * scale_E3_y_ * pivot_E3_x_))
        return 6;
    const double size_E3_x_ = scale_E3_x_ + scale_E3_y_;
    if (!(pivot_E3_x_ > memory->least_size * size_E3_x_))
        return 5;
    if (!(determinant_E3_x_E3_y_ > memory->least_size * size_E3_x_ * pivot_E3_x_))
        return 6;
    const double inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const double inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*pivot_E3_y_;
    const double inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*pivot_E3_x_;
    const double inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;

    /* forward substitution */
    const double dq_z_E3_x_ = -l_E3_x_G_x_*phi_G_x_ - l_E3_x_G_y_*phi_G_y_ - l_E3_x_H_x_*phi_H_x_
        - l_E3_x_H_y_*phi_H_y_ + phi_E3_x_;
    const double dq_z_E3_y_ = -l_E3_y_G_x_*phi_G_x_ - l_E3_y_G_y_*phi_G_y_ - l_E3_y_H_x_*phi_H_x_
        - l_E3_y_H_y_*phi_H_y_ + phi_E3_y_;

    /* backward substitution */
    const double dq_lambda_E3_y_ = dq_z_E3_x_*inverse_cross_E3_x_E3_y_ + dq_z_E3_y_*inverse_pivot_E3_y_;
    const double dq_lambda_E3_x_ = dq_z_E3_x_*inverse_pivot_E3_x_ + dq_z_E3_y_*inverse_cross_E3_x_E3_y_;
    const double dq_lambda_G_y_ = -dq_lambda_E3_x_*l_E3_x_G_y_ - dq_lambda_E3_y_*l_E3_y_G_y_
        + inverse_cross_G_x_G_y_*phi_G_x_ + inverse_pivot_G_y_*phi_G_y_;
    const double dq_lambda_G_x_ = -dq_lambda_E3_x_*l_E3_x_G_x_ - dq_lambda_E3_y_*l_E3_y_G_x_
        + inverse_cross_G_x_G_y_*phi_G_y_ + inverse_pivot_G_x_*phi_G_x_;
    const double dq_acceleration_FE_theta_ = -dq_lambda_E3_x_*l_E3_x_FE_theta_ - dq_lambda_E3_y_*l_E3_y_FE_theta_
        - dq_lambda_G_x_*l_G_x_FE_theta_ - dq_lambda_G_y_*l_G_y_FE_theta_;
    const double dq_acceleration_OF_theta_ = -dq_lambda_E3_x_*l_E3_x_OF_theta_ - dq_lambda_E3_y_*l_E3_y_OF_theta_
        - dq_lambda_G_x_*l_G_x_OF_theta_ - dq_lambda_G_y_*l_G_y_OF_theta_;
    const double dq_acceleration_EG_theta_ = -dq_acceleration_FE_theta_*l_FE_theta_EG_theta_
        - dq_acceleration_OF_theta_*l_OF_theta_EG_theta_ - dq_lambda_G_x_*l_G_x_EG_theta_
        - dq_lambda_G_y_*l_G_y_EG_theta_;
    const double dq_lambda_H_y_ = -dq_lambda_E3_x_*l_E3_x_H_y_ - dq_lambda_E3_y_*l_E3_y_H_y_
        + inverse_cross_H_x_H_y_*phi_H_x_ + inverse_pivot_H_y_*phi_H_y_;
    const double dq_lambda_H_x_ = -dq_lambda_E3_x_*l_E3_x_H_x_ - dq_lambda_E3_y_*l_E3_y_H_x_
        + inverse_cross_H_x_H_y_*phi_H_y_ + inverse_pivot_H_x_*phi_H_x_;
    const double dq_acceleration_BDE_theta_ = -dq_lambda_E3_x_*l_E3_x_BDE_theta_ - dq_lambda_E3_y_*l_E3_y_BDE_theta_
        - dq_lambda_H_x_*l_H_x_BDE_theta_ - dq_lambda_H_y_*l_H_y_BDE_theta_;
    const double dq_acceleration_HE_theta_ = -dq_acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        - dq_lambda_H_x_*l_H_x_HE_theta_ - dq_lambda_H_y_*l_H_y_HE_theta_;
    const double dq_acceleration_AH_theta_ = -dq_lambda_H_x_*l_H_x_AH_theta_ - dq_lambda_H_y_*l_H_y_AH_theta_;
    const double dq_acceleration_AG_theta_ = -dq_lambda_G_x_*l_G_x_AG_theta_ - dq_lambda_G_y_*l_G_y_AG_theta_;

    /* forward substitution */
    const double dv_z_E3_x_ = -l_E3_x_G_x_*phi_dot_G_x_ - l_E3_x_G_y_*phi_dot_G_y_ - l_E3_x_H_x_*phi_dot_H_x_
        - l_E3_x_H_y_*phi_dot_H_y_ + phi_dot_E3_x_;
    const double dv_z_E3_y_ = -l_E3_y_G_x_*phi_dot_G_x_ - l_E3_y_G_y_*phi_dot_G_y_ - l_E3_y_H_x_*phi_dot_H_x_
        - l_E3_y_H_y_*phi_dot_H_y_ + phi_dot_E3_y_;

    /* backward substitution */
    const double dv_lambda_E3_y_ = dv_z_E3_x_*inverse_cross_E3_x_E3_y_ + dv_z_E3_y_*inverse_pivot_E3_y_;
    const double dv_lambda_E3_x_ = dv_z_E3_x_*inverse_pivot_E3_x_ + dv_z_E3_y_*inverse_cross_E3_x_E3_y_;
    const double dv_lambda_G_y_ = -dv_lambda_E3_x_*l_E3_x_G_y_ - dv_lambda_E3_y_*l_E3_y_G_y_
        + inverse_cross_G_x_G_y_*phi_dot_G_x_ + inverse_pivot_G_y_*phi_dot_G_y_;
    const double dv_lambda_G_x_ = -dv_lambda_E3_x_*l_E3_x_G_x_ - dv_lambda_E3_y_*l_E3_y_G_x_
        + inverse_cross_G_x_G_y_*phi_dot_G_y_ + inverse_pivot_G_x_*phi_dot_G_x_;
    const double dv_acceleration_FE_theta_ = -dv_lambda_E3_x_*l_E3_x_FE_theta_ - dv_lambda_E3_y_*l_E3_y_FE_theta_
        - dv_lambda_G_x_*l_G_x_FE_theta_ - dv_lambda_G_y_*l_G_y_FE_theta_;
    const double dv_acceleration_OF_theta_ = -dv_lambda_E3_x_*l_E3_x_OF_theta_ - dv_lambda_E3_y_*l_E3_y_OF_theta_
        - dv_lambda_G_x_*l_G_x_OF_theta_ - dv_lambda_G_y_*l_G_y_OF_theta_;
    const double dv_acceleration_EG_theta_ = -dv_acceleration_FE_theta_*l_FE_theta_EG_theta_
        - dv_acceleration_OF_theta_*l_OF_theta_EG_theta_ - dv_lambda_G_x_*l_G_x_EG_theta_
        - dv_lambda_G_y_*l_G_y_EG_theta_;
    const double dv_lambda_H_y_ = -dv_lambda_E3_x_*l_E3_x_H_y_ - dv_lambda_E3_y_*l_E3_y_H_y_
        + inverse_cross_H_x_H_y_*phi_dot_H_x_ + inverse_pivot_H_y_*phi_dot_H_y_;
    const double dv_lambda_H_x_ = -dv_lambda_E3_x_*l_E3_x_H_x_ - dv_lambda_E3_y_*l_E3_y_H_x_
        + inverse_cross_H_x_H_y_*phi_dot_H_y_ + inverse_pivot_H_x_*phi_dot_H_x_;
    const double dv_acceleration_BDE_theta_ = -dv_lambda_E3_x_*l_E3_x_BDE_theta_ - dv_lambda_E3_y_*l_E3_y_BDE_theta_
        - dv_lambda_H_x_*l_H_x_BDE_theta_ - dv_lambda_H_y_*l_H_y_BDE_theta_;
    const double dv_acceleration_HE_theta_ = -dv_acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        - dv_lambda_H_x_*l_H_x_HE_theta_ - dv_lambda_H_y_*l_H_y_HE_theta_;
    const double dv_acceleration_AH_theta_ = -dv_lambda_H_x_*l_H_x_AH_theta_ - dv_lambda_H_y_*l_H_y_AH_theta_;
    const double dv_acceleration_AG_theta_ = -dv_lambda_G_x_*l_G_x_AG_theta_ - dv_lambda_G_y_*l_G_y_AG_theta_;

    /* results */
    dq[0] = dq_acceleration_OF_theta_;
    dv[0] = dv_acceleration_OF_theta_;
    dq[1] = dq_acceleration_BDE_theta_;
    dv[1] = dv_acceleration_BDE_theta_;
    dq[2] = dq_acceleration_AG_theta_;
    dv[2] = dv_acceleration_AG_theta_;
    dq[3] = dq_acceleration_AH_theta_;
    dv[3] = dv_acceleration_AH_theta_;
    dq[4] = dq_acceleration_FE_theta_;
    dv[4] = dv_acceleration_FE_theta_;
    dq[5] = dq_acceleration_HE_theta_;
    dv[5] = dv_acceleration_HE_theta_;
    dq[6] = dq_acceleration_EG_theta_;
    dv[6] = dv_acceleration_EG_theta_;
    *worst = max_of(0.0, fabs(phi_G_x_));
    *worst = max_of(*worst, fabs(phi_G_y_));
    *worst = max_of(*worst, fabs(phi_H_x_));
    *worst = max_of(*worst, fabs(phi_H_y_));
    *worst = max_of(*worst, fabs(phi_E3_x_));
    *worst = max_of(*worst, fabs(phi_E3_y_));
    return 0;
}
