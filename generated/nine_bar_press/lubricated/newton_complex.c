/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 * At complex eta: real and imaginary parts one behind the other.
 */
int newton_factor_complex(double eta, double eta_i, ComplexLinear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta_ = lin->value[0];
    const double mass_L6_theta_L2_theta_ = lin->value[1];
    const double mass_L7_theta_L2_theta_ = lin->value[2];
    const double mass_L6_theta_L3_theta_ = lin->value[3];
    const double mass_L7_theta_L3_theta_ = lin->value[4];
    const double mass_L6_theta_L8_theta_ = lin->value[5];
    const double phi_guide_offset_L6_theta_ = lin->value[6];
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double by_q_guide_offset_L6_theta_ = lin->value[8];
    const double by_q_guide_offset_L8_theta_ = lin->value[9];
    const double by_q_L6_theta_L6_theta_ = lin->value[10];
    const double by_q_L6_theta_L7_theta_ = lin->value[11];
    const double by_q_L6_theta_L2_theta_ = lin->value[12];
    const double by_q_L6_theta_L3_theta_ = lin->value[13];
    const double by_q_L6_theta_L8_theta_ = lin->value[14];
    const double by_q_L7_theta_L6_theta_ = lin->value[15];
    const double by_q_L7_theta_L7_theta_ = lin->value[16];
    const double by_q_L7_theta_L2_theta_ = lin->value[17];
    const double by_q_L7_theta_L3_theta_ = lin->value[18];
    const double by_q_L8_theta_L8_theta_ = lin->value[19];
    const double by_q_L8_theta_L6_theta_ = lin->value[20];
    const double by_q_L2_theta_L6_theta_ = lin->value[21];
    const double by_q_L2_theta_L7_theta_ = lin->value[22];
    const double by_q_L2_theta_L2_theta_ = lin->value[23];
    const double by_q_L3_theta_L6_theta_ = lin->value[24];
    const double by_q_L3_theta_L7_theta_ = lin->value[25];
    const double by_q_L3_theta_L3_theta_ = lin->value[26];
    const double by_v_guide_offset_L6_theta_ = lin->value[27];
    const double by_v_guide_offset_L8_theta_ = lin->value[28];
    const double by_v_L6_theta_L6_theta_ = lin->value[29];
    const double by_v_L6_theta_L7_theta_ = lin->value[30];
    const double by_v_L6_theta_L2_theta_ = lin->value[31];
    const double by_v_L6_theta_L3_theta_ = lin->value[32];
    const double by_v_L6_theta_L8_theta_ = lin->value[33];
    const double by_v_L7_theta_L6_theta_ = lin->value[34];
    const double by_v_L7_theta_L7_theta_ = lin->value[35];
    const double by_v_L7_theta_L2_theta_ = lin->value[36];
    const double by_v_L7_theta_L3_theta_ = lin->value[37];
    const double by_v_L8_theta_L6_theta_ = lin->value[38];
    const double by_v_L2_theta_L6_theta_ = lin->value[39];
    const double by_v_L2_theta_L7_theta_ = lin->value[40];
    const double by_v_L2_theta_L2_theta_ = lin->value[41];
    const double by_v_L3_theta_L6_theta_ = lin->value[42];
    const double by_v_L3_theta_L7_theta_ = lin->value[43];
    const double by_v_L3_theta_L3_theta_ = lin->value[44];

    /* eta/kappa */
    const double factor_1 = p->beta_squared_*eta + p->two_alpha_;
    const double factor_2 = p->beta_squared_*eta_i;
    const double divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const double divisor_2 = eta*factor_2 + eta_i*factor_1;
    const double divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const double factor_3 = divisor_1*divisor_3;
    const double factor_4 = -divisor_2*divisor_3;
    const double eta_row = eta*factor_3 - eta_i*factor_4;
    const double eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* matrix */
    const double factor_5 = by_q_L6_theta_L6_theta_*eta + by_v_L6_theta_L6_theta_;
    const double factor_6 = by_q_L6_theta_L6_theta_*eta_i;
    const double n_L6_theta_L6_theta_ = eta*factor_5 - eta_i*factor_6 + p->mass_L6_L6_;
    const double n_L6_theta_L6_theta__i = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = by_q_L6_theta_L7_theta_*eta + by_v_L6_theta_L7_theta_;
    const double factor_8 = by_q_L6_theta_L7_theta_*eta_i;
    const double n_L6_theta_L7_theta_ = eta*factor_7 - eta_i*factor_8 + mass_L6_theta_L7_theta_;
    const double n_L6_theta_L7_theta__i = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = by_q_L6_theta_L8_theta_*eta + by_v_L6_theta_L8_theta_;
    const double factor_10 = by_q_L6_theta_L8_theta_*eta_i;
    const double n_L6_theta_L8_theta_ = eta*factor_9 - eta_i*factor_10 + mass_L6_theta_L8_theta_;
    const double n_L6_theta_L8_theta__i = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = by_q_L6_theta_L2_theta_*eta + by_v_L6_theta_L2_theta_;
    const double factor_12 = by_q_L6_theta_L2_theta_*eta_i;
    const double n_L6_theta_L2_theta_ = eta*factor_11 - eta_i*factor_12 + mass_L6_theta_L2_theta_;
    const double n_L6_theta_L2_theta__i = eta*factor_12 + eta_i*factor_11;
    const double factor_13 = by_q_L6_theta_L3_theta_*eta + by_v_L6_theta_L3_theta_;
    const double factor_14 = by_q_L6_theta_L3_theta_*eta_i;
    const double n_L6_theta_L3_theta_ = eta*factor_13 - eta_i*factor_14 + mass_L6_theta_L3_theta_;
    const double n_L6_theta_L3_theta__i = eta*factor_14 + eta_i*factor_13;
    const double factor_15 = by_q_L7_theta_L6_theta_*eta + by_v_L7_theta_L6_theta_;
    const double factor_16 = by_q_L7_theta_L6_theta_*eta_i;
    const double n_L7_theta_L6_theta_ = eta*factor_15 - eta_i*factor_16 + mass_L6_theta_L7_theta_;
    const double n_L7_theta_L6_theta__i = eta*factor_16 + eta_i*factor_15;
    const double factor_17 = by_q_L7_theta_L7_theta_*eta + by_v_L7_theta_L7_theta_;
    const double factor_18 = by_q_L7_theta_L7_theta_*eta_i;
    const double n_L7_theta_L7_theta_ = eta*factor_17 - eta_i*factor_18 + p->mass_L7_L7_;
    const double n_L7_theta_L7_theta__i = eta*factor_18 + eta_i*factor_17;
    const double factor_19 = by_q_L7_theta_L2_theta_*eta + by_v_L7_theta_L2_theta_;
    const double factor_20 = by_q_L7_theta_L2_theta_*eta_i;
    const double n_L7_theta_L2_theta_ = eta*factor_19 - eta_i*factor_20 + mass_L7_theta_L2_theta_;
    const double n_L7_theta_L2_theta__i = eta*factor_20 + eta_i*factor_19;
    const double factor_21 = by_q_L7_theta_L3_theta_*eta + by_v_L7_theta_L3_theta_;
    const double factor_22 = by_q_L7_theta_L3_theta_*eta_i;
    const double n_L7_theta_L3_theta_ = eta*factor_21 - eta_i*factor_22 + mass_L7_theta_L3_theta_;
    const double n_L7_theta_L3_theta__i = eta*factor_22 + eta_i*factor_21;
    const double factor_23 = by_q_L8_theta_L6_theta_*eta + by_v_L8_theta_L6_theta_;
    const double factor_24 = by_q_L8_theta_L6_theta_*eta_i;
    const double n_L8_theta_L6_theta_ = eta*factor_23 - eta_i*factor_24 + mass_L6_theta_L8_theta_;
    const double n_L8_theta_L6_theta__i = eta*factor_24 + eta_i*factor_23;
    const double n_L8_theta_L8_theta_ = by_q_L8_theta_L8_theta_*((eta * eta) - (eta_i * eta_i)) + p->mass_L8_L8_;
    const double n_L8_theta_L8_theta__i = 2.0*by_q_L8_theta_L8_theta_*eta*eta_i;
    const double factor_25 = by_q_L2_theta_L6_theta_*eta + by_v_L2_theta_L6_theta_;
    const double factor_26 = by_q_L2_theta_L6_theta_*eta_i;
    const double n_L2_theta_L6_theta_ = eta*factor_25 - eta_i*factor_26 + mass_L6_theta_L2_theta_;
    const double n_L2_theta_L6_theta__i = eta*factor_26 + eta_i*factor_25;
    const double factor_27 = by_q_L2_theta_L7_theta_*eta + by_v_L2_theta_L7_theta_;
    const double factor_28 = by_q_L2_theta_L7_theta_*eta_i;
    const double n_L2_theta_L7_theta_ = eta*factor_27 - eta_i*factor_28 + mass_L7_theta_L2_theta_;
    const double n_L2_theta_L7_theta__i = eta*factor_28 + eta_i*factor_27;
    const double factor_29 = by_q_L2_theta_L2_theta_*eta + by_v_L2_theta_L2_theta_;
    const double factor_30 = by_q_L2_theta_L2_theta_*eta_i;
    const double n_L2_theta_L2_theta_ = eta*factor_29 - eta_i*factor_30 + p->mass_L2_L2_;
    const double n_L2_theta_L2_theta__i = eta*factor_30 + eta_i*factor_29;
    const double factor_31 = by_q_L3_theta_L6_theta_*eta + by_v_L3_theta_L6_theta_;
    const double factor_32 = by_q_L3_theta_L6_theta_*eta_i;
    const double n_L3_theta_L6_theta_ = eta*factor_31 - eta_i*factor_32 + mass_L6_theta_L3_theta_;
    const double n_L3_theta_L6_theta__i = eta*factor_32 + eta_i*factor_31;
    const double factor_33 = by_q_L3_theta_L7_theta_*eta + by_v_L3_theta_L7_theta_;
    const double factor_34 = by_q_L3_theta_L7_theta_*eta_i;
    const double n_L3_theta_L7_theta_ = eta*factor_33 - eta_i*factor_34 + mass_L7_theta_L3_theta_;
    const double n_L3_theta_L7_theta__i = eta*factor_34 + eta_i*factor_33;
    const double factor_35 = by_q_L3_theta_L3_theta_*eta + by_v_L3_theta_L3_theta_;
    const double factor_36 = by_q_L3_theta_L3_theta_*eta_i;
    const double n_L3_theta_L3_theta_ = eta*factor_35 - eta_i*factor_36 + p->mass_L3_L3_;
    const double n_L3_theta_L3_theta__i = eta*factor_36 + eta_i*factor_35;
    const double factor_37 = by_q_guide_offset_L6_theta_*eta + by_v_guide_offset_L6_theta_;
    const double factor_38 = by_q_guide_offset_L6_theta_*eta_i;
    const double n_guide_offset_L6_theta_ = eta_row*factor_37 - eta_row_i*factor_38 + phi_guide_offset_L6_theta_;
    const double n_guide_offset_L6_theta__i = eta_row*factor_38 + eta_row_i*factor_37;
    const double factor_39 = by_q_guide_offset_L8_theta_*eta + by_v_guide_offset_L8_theta_;
    const double factor_40 = by_q_guide_offset_L8_theta_*eta_i;
    const double n_guide_offset_L8_theta_ = eta_row*factor_39 - eta_row_i*factor_40 + phi_guide_offset_L8_theta_;
    const double n_guide_offset_L8_theta__i = eta_row*factor_40 + eta_row_i*factor_39;

    /* L U */
    const double scale_L8_theta_ = n_L8_theta_L8_theta_;
    const double scale_L8_theta__i = n_L8_theta_L8_theta__i;
    const double size_1 = fabs(scale_L8_theta_) + fabs(scale_L8_theta__i);
    const double size_2 = fabs(n_L8_theta_L8_theta_) + fabs(n_L8_theta_L8_theta__i);
    if (!(size_1 > SINGULAR * size_2))
        return 3;
    const double divisor_4 = 1.0/((scale_L8_theta_ * scale_L8_theta_) + (scale_L8_theta__i * scale_L8_theta__i));
    const double inverse_pivot_L8_theta_ = divisor_4*scale_L8_theta_;
    const double inverse_pivot_L8_theta__i = -divisor_4*scale_L8_theta__i;
    lin->lu[0] = inverse_pivot_L8_theta_;
    lin->lu[1] = inverse_pivot_L8_theta__i;
    const double l_L6_theta_L8_theta_ = inverse_pivot_L8_theta_*n_L6_theta_L8_theta_
        - inverse_pivot_L8_theta__i*n_L6_theta_L8_theta__i;
    const double l_L6_theta_L8_theta_3__i = inverse_pivot_L8_theta_*n_L6_theta_L8_theta__i
        + inverse_pivot_L8_theta__i*n_L6_theta_L8_theta_;
    lin->lu[2] = l_L6_theta_L8_theta_;
    lin->lu[3] = l_L6_theta_L8_theta_3__i;
    lin->lu[4] = n_L8_theta_L6_theta_;
    lin->lu[5] = n_L8_theta_L6_theta__i;
    const double l_guide_offset_L8_theta_ = inverse_pivot_L8_theta_*n_guide_offset_L8_theta_
        - inverse_pivot_L8_theta__i*n_guide_offset_L8_theta__i;
    const double l_guide_offset_L8_theta_3__i = inverse_pivot_L8_theta_*n_guide_offset_L8_theta__i
        + inverse_pivot_L8_theta__i*n_guide_offset_L8_theta_;
    lin->lu[6] = l_guide_offset_L8_theta_;
    lin->lu[7] = l_guide_offset_L8_theta_3__i;
    const double scale_L2_theta_ = n_L2_theta_L2_theta_;
    const double scale_L2_theta__i = n_L2_theta_L2_theta__i;
    const double size_3 = fabs(scale_L2_theta_) + fabs(scale_L2_theta__i);
    const double size_4 = fabs(n_L2_theta_L2_theta_) + fabs(n_L2_theta_L2_theta__i);
    if (!(size_3 > SINGULAR * size_4))
        return 4;
    const double divisor_5 = 1.0/((scale_L2_theta_ * scale_L2_theta_) + (scale_L2_theta__i * scale_L2_theta__i));
    const double inverse_pivot_L2_theta_ = divisor_5*scale_L2_theta_;
    const double inverse_pivot_L2_theta__i = -divisor_5*scale_L2_theta__i;
    lin->lu[8] = inverse_pivot_L2_theta_;
    lin->lu[9] = inverse_pivot_L2_theta__i;
    const double l_L7_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L7_theta_L2_theta_
        - inverse_pivot_L2_theta__i*n_L7_theta_L2_theta__i;
    const double l_L7_theta_L2_theta_3__i = inverse_pivot_L2_theta_*n_L7_theta_L2_theta__i
        + inverse_pivot_L2_theta__i*n_L7_theta_L2_theta_;
    lin->lu[10] = l_L7_theta_L2_theta_;
    lin->lu[11] = l_L7_theta_L2_theta_3__i;
    lin->lu[12] = n_L2_theta_L7_theta_;
    lin->lu[13] = n_L2_theta_L7_theta__i;
    const double l_L6_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L6_theta_L2_theta_
        - inverse_pivot_L2_theta__i*n_L6_theta_L2_theta__i;
    const double l_L6_theta_L2_theta_3__i = inverse_pivot_L2_theta_*n_L6_theta_L2_theta__i
        + inverse_pivot_L2_theta__i*n_L6_theta_L2_theta_;
    lin->lu[14] = l_L6_theta_L2_theta_;
    lin->lu[15] = l_L6_theta_L2_theta_3__i;
    lin->lu[16] = n_L2_theta_L6_theta_;
    lin->lu[17] = n_L2_theta_L6_theta__i;
    const double scale_L7_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L7_theta_
        + l_L7_theta_L2_theta_3__i*n_L2_theta_L7_theta__i + n_L7_theta_L7_theta_;
    const double scale_L7_theta__i = -l_L7_theta_L2_theta_*n_L2_theta_L7_theta__i
        - l_L7_theta_L2_theta_3__i*n_L2_theta_L7_theta_ + n_L7_theta_L7_theta__i;
    const double size_5 = fabs(scale_L7_theta_) + fabs(scale_L7_theta__i);
    const double size_6 = fabs(n_L7_theta_L7_theta_) + fabs(n_L7_theta_L7_theta__i);
    if (!(size_5 > SINGULAR * size_6))
        return 2;
    const double divisor_6 = 1.0/((scale_L7_theta_ * scale_L7_theta_) + (scale_L7_theta__i * scale_L7_theta__i));
    const double inverse_pivot_L7_theta_ = divisor_6*scale_L7_theta_;
    const double inverse_pivot_L7_theta_3__i = -divisor_6*scale_L7_theta__i;
    lin->lu[18] = inverse_pivot_L7_theta_;
    lin->lu[19] = inverse_pivot_L7_theta_3__i;
    const double l_L3_theta_L7_theta_ = inverse_pivot_L7_theta_*n_L3_theta_L7_theta_
        - inverse_pivot_L7_theta_3__i*n_L3_theta_L7_theta__i;
    const double l_L3_theta_L7_theta__i = inverse_pivot_L7_theta_*n_L3_theta_L7_theta__i
        + inverse_pivot_L7_theta_3__i*n_L3_theta_L7_theta_;
    lin->lu[20] = l_L3_theta_L7_theta_;
    lin->lu[21] = l_L3_theta_L7_theta__i;
    lin->lu[22] = n_L7_theta_L3_theta_;
    lin->lu[23] = n_L7_theta_L3_theta__i;
    const double factor_41 = -l_L6_theta_L2_theta_*n_L2_theta_L7_theta_
        + l_L6_theta_L2_theta_3__i*n_L2_theta_L7_theta__i + n_L6_theta_L7_theta_;
    const double factor_42 = -l_L6_theta_L2_theta_*n_L2_theta_L7_theta__i
        - l_L6_theta_L2_theta_3__i*n_L2_theta_L7_theta_ + n_L6_theta_L7_theta__i;
    const double l_L6_theta_L7_theta_ = factor_41*inverse_pivot_L7_theta_ - factor_42*inverse_pivot_L7_theta_3__i;
    const double l_L6_theta_L7_theta_3__i = factor_41*inverse_pivot_L7_theta_3__i + factor_42*inverse_pivot_L7_theta_;
    lin->lu[24] = l_L6_theta_L7_theta_;
    lin->lu[25] = l_L6_theta_L7_theta_3__i;
    const double u_L7_theta_L6_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L6_theta_
        + l_L7_theta_L2_theta_3__i*n_L2_theta_L6_theta__i + n_L7_theta_L6_theta_;
    const double u_L7_theta_L6_theta__i = -l_L7_theta_L2_theta_*n_L2_theta_L6_theta__i
        - l_L7_theta_L2_theta_3__i*n_L2_theta_L6_theta_ + n_L7_theta_L6_theta__i;
    lin->lu[26] = u_L7_theta_L6_theta_;
    lin->lu[27] = u_L7_theta_L6_theta__i;
    const double scale_L3_theta_ = -l_L3_theta_L7_theta_*n_L7_theta_L3_theta_
        + l_L3_theta_L7_theta__i*n_L7_theta_L3_theta__i + n_L3_theta_L3_theta_;
    const double scale_L3_theta__i = -l_L3_theta_L7_theta_*n_L7_theta_L3_theta__i
        - l_L3_theta_L7_theta__i*n_L7_theta_L3_theta_ + n_L3_theta_L3_theta__i;
    const double size_7 = fabs(scale_L3_theta_) + fabs(scale_L3_theta__i);
    const double size_8 = fabs(n_L3_theta_L3_theta_) + fabs(n_L3_theta_L3_theta__i);
    if (!(size_7 > SINGULAR * size_8))
        return 5;
    const double divisor_7 = 1.0/((scale_L3_theta_ * scale_L3_theta_) + (scale_L3_theta__i * scale_L3_theta__i));
    const double inverse_pivot_L3_theta_ = divisor_7*scale_L3_theta_;
    const double inverse_pivot_L3_theta_3__i = -divisor_7*scale_L3_theta__i;
    lin->lu[28] = inverse_pivot_L3_theta_;
    lin->lu[29] = inverse_pivot_L3_theta_3__i;
    const double factor_43 = -l_L6_theta_L7_theta_*n_L7_theta_L3_theta_
        + l_L6_theta_L7_theta_3__i*n_L7_theta_L3_theta__i + n_L6_theta_L3_theta_;
    const double factor_44 = -l_L6_theta_L7_theta_*n_L7_theta_L3_theta__i
        - l_L6_theta_L7_theta_3__i*n_L7_theta_L3_theta_ + n_L6_theta_L3_theta__i;
    const double l_L6_theta_L3_theta_ = factor_43*inverse_pivot_L3_theta_ - factor_44*inverse_pivot_L3_theta_3__i;
    const double l_L6_theta_L3_theta_3__i = factor_43*inverse_pivot_L3_theta_3__i + factor_44*inverse_pivot_L3_theta_;
    lin->lu[30] = l_L6_theta_L3_theta_;
    lin->lu[31] = l_L6_theta_L3_theta_3__i;
    const double u_L3_theta_L6_theta_ = -l_L3_theta_L7_theta_*u_L7_theta_L6_theta_
        + l_L3_theta_L7_theta__i*u_L7_theta_L6_theta__i + n_L3_theta_L6_theta_;
    const double u_L3_theta_L6_theta__i = -l_L3_theta_L7_theta_*u_L7_theta_L6_theta__i
        - l_L3_theta_L7_theta__i*u_L7_theta_L6_theta_ + n_L3_theta_L6_theta__i;
    lin->lu[32] = u_L3_theta_L6_theta_;
    lin->lu[33] = u_L3_theta_L6_theta__i;
    const double scale_L6_theta_ = -l_L6_theta_L2_theta_*n_L2_theta_L6_theta_
        + l_L6_theta_L2_theta_3__i*n_L2_theta_L6_theta__i - l_L6_theta_L3_theta_*u_L3_theta_L6_theta_
        + l_L6_theta_L3_theta_3__i*u_L3_theta_L6_theta__i - l_L6_theta_L7_theta_*u_L7_theta_L6_theta_
        + l_L6_theta_L7_theta_3__i*u_L7_theta_L6_theta__i - l_L6_theta_L8_theta_*n_L8_theta_L6_theta_
        + l_L6_theta_L8_theta_3__i*n_L8_theta_L6_theta__i + n_L6_theta_L6_theta_;
    const double scale_L6_theta__i = -l_L6_theta_L2_theta_*n_L2_theta_L6_theta__i
        - l_L6_theta_L2_theta_3__i*n_L2_theta_L6_theta_ - l_L6_theta_L3_theta_*u_L3_theta_L6_theta__i
        - l_L6_theta_L3_theta_3__i*u_L3_theta_L6_theta_ - l_L6_theta_L7_theta_*u_L7_theta_L6_theta__i
        - l_L6_theta_L7_theta_3__i*u_L7_theta_L6_theta_ - l_L6_theta_L8_theta_*n_L8_theta_L6_theta__i
        - l_L6_theta_L8_theta_3__i*n_L8_theta_L6_theta_ + n_L6_theta_L6_theta__i;
    const double size_9 = fabs(scale_L6_theta_) + fabs(scale_L6_theta__i);
    const double size_10 = fabs(n_L6_theta_L6_theta_) + fabs(n_L6_theta_L6_theta__i);
    if (!(size_9 > SINGULAR * size_10))
        return 1;
    const double divisor_8 = 1.0/((scale_L6_theta_ * scale_L6_theta_) + (scale_L6_theta__i * scale_L6_theta__i));
    const double inverse_pivot_L6_theta_ = divisor_8*scale_L6_theta_;
    const double inverse_pivot_L6_theta_3__i = -divisor_8*scale_L6_theta__i;
    lin->lu[34] = inverse_pivot_L6_theta_;
    lin->lu[35] = inverse_pivot_L6_theta_3__i;
    const double factor_45 = -l_guide_offset_L8_theta_*n_L8_theta_L6_theta_
        + l_guide_offset_L8_theta_3__i*n_L8_theta_L6_theta__i + n_guide_offset_L6_theta_;
    const double factor_46 = -l_guide_offset_L8_theta_*n_L8_theta_L6_theta__i
        - l_guide_offset_L8_theta_3__i*n_L8_theta_L6_theta_ + n_guide_offset_L6_theta__i;
    const double l_guide_offset_L6_theta_ = factor_45*inverse_pivot_L6_theta_ - factor_46*inverse_pivot_L6_theta_3__i;
    const double l_guide_offset_L6_theta_3__i = factor_45*inverse_pivot_L6_theta_3__i
        + factor_46*inverse_pivot_L6_theta_;
    lin->lu[36] = l_guide_offset_L6_theta_;
    lin->lu[37] = l_guide_offset_L6_theta_3__i;
    const double u_L6_theta_guide_offset_ = -l_L6_theta_L8_theta_*phi_guide_offset_L8_theta_
        + phi_guide_offset_L6_theta_;
    const double u_L6_theta_guide_offset__i = -l_L6_theta_L8_theta_3__i*phi_guide_offset_L8_theta_;
    lin->lu[38] = u_L6_theta_guide_offset_;
    lin->lu[39] = u_L6_theta_guide_offset__i;
    const double scale_guide_offset_ = -l_guide_offset_L6_theta_*u_L6_theta_guide_offset_
        + l_guide_offset_L6_theta_3__i*u_L6_theta_guide_offset__i - l_guide_offset_L8_theta_*phi_guide_offset_L8_theta_;
    const double scale_guide_offset_3__i = -l_guide_offset_L6_theta_*u_L6_theta_guide_offset__i
        - l_guide_offset_L6_theta_3__i*u_L6_theta_guide_offset_
        - l_guide_offset_L8_theta_3__i*phi_guide_offset_L8_theta_;
    const double size_11 = fabs(scale_guide_offset_) + fabs(scale_guide_offset_3__i);
    if (!(size_11 > 0.0 && size_11 < INFINITY))
        return 6;
    const double divisor_9 = 1.0/((scale_guide_offset_ * scale_guide_offset_)
        + (scale_guide_offset_3__i * scale_guide_offset_3__i));
    const double inverse_pivot_guide_offset_ = divisor_9*scale_guide_offset_;
    const double inverse_pivot_guide_offset_3__i = -divisor_9*scale_guide_offset_3__i;
    lin->lu[40] = inverse_pivot_guide_offset_;
    lin->lu[41] = inverse_pivot_guide_offset_3__i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double inverse_pivot_L8_theta_ = lin->lu[0];
    const double inverse_pivot_L8_theta__i = lin->lu[1];
    const double l_L6_theta_L8_theta_ = lin->lu[2];
    const double l_L6_theta_L8_theta_3__i = lin->lu[3];
    const double n_L8_theta_L6_theta_ = lin->lu[4];
    const double n_L8_theta_L6_theta__i = lin->lu[5];
    const double l_guide_offset_L8_theta_ = lin->lu[6];
    const double l_guide_offset_L8_theta_3__i = lin->lu[7];
    const double inverse_pivot_L2_theta_ = lin->lu[8];
    const double inverse_pivot_L2_theta__i = lin->lu[9];
    const double l_L7_theta_L2_theta_ = lin->lu[10];
    const double l_L7_theta_L2_theta_3__i = lin->lu[11];
    const double n_L2_theta_L7_theta_ = lin->lu[12];
    const double n_L2_theta_L7_theta__i = lin->lu[13];
    const double l_L6_theta_L2_theta_ = lin->lu[14];
    const double l_L6_theta_L2_theta_3__i = lin->lu[15];
    const double n_L2_theta_L6_theta_ = lin->lu[16];
    const double n_L2_theta_L6_theta__i = lin->lu[17];
    const double inverse_pivot_L7_theta_ = lin->lu[18];
    const double inverse_pivot_L7_theta_3__i = lin->lu[19];
    const double l_L3_theta_L7_theta_ = lin->lu[20];
    const double l_L3_theta_L7_theta__i = lin->lu[21];
    const double n_L7_theta_L3_theta_ = lin->lu[22];
    const double n_L7_theta_L3_theta__i = lin->lu[23];
    const double l_L6_theta_L7_theta_ = lin->lu[24];
    const double l_L6_theta_L7_theta_3__i = lin->lu[25];
    const double u_L7_theta_L6_theta_ = lin->lu[26];
    const double u_L7_theta_L6_theta__i = lin->lu[27];
    const double inverse_pivot_L3_theta_ = lin->lu[28];
    const double inverse_pivot_L3_theta_3__i = lin->lu[29];
    const double l_L6_theta_L3_theta_ = lin->lu[30];
    const double l_L6_theta_L3_theta_3__i = lin->lu[31];
    const double u_L3_theta_L6_theta_ = lin->lu[32];
    const double u_L3_theta_L6_theta__i = lin->lu[33];
    const double inverse_pivot_L6_theta_ = lin->lu[34];
    const double inverse_pivot_L6_theta_3__i = lin->lu[35];
    const double l_guide_offset_L6_theta_ = lin->lu[36];
    const double l_guide_offset_L6_theta_3__i = lin->lu[37];
    const double u_L6_theta_guide_offset_ = lin->lu[38];
    const double u_L6_theta_guide_offset__i = lin->lu[39];
    const double inverse_pivot_guide_offset_ = lin->lu[40];
    const double inverse_pivot_guide_offset_3__i = lin->lu[41];

    /* forward */
    const double b_L8_theta_ = x[4];
    const double b_L8_theta__i = x[5];
    const double b_L2_theta_ = x[6];
    const double b_L2_theta__i = x[7];
    const double b_L7_theta_ = -b_L2_theta_*l_L7_theta_L2_theta_ + b_L2_theta__i*l_L7_theta_L2_theta_3__i + x[2];
    const double b_L7_theta__i = -b_L2_theta_*l_L7_theta_L2_theta_3__i - b_L2_theta__i*l_L7_theta_L2_theta_ + x[3];
    const double b_L3_theta_ = -b_L7_theta_*l_L3_theta_L7_theta_ + b_L7_theta__i*l_L3_theta_L7_theta__i + x[8];
    const double b_L3_theta__i = -b_L7_theta_*l_L3_theta_L7_theta__i - b_L7_theta__i*l_L3_theta_L7_theta_ + x[9];
    const double b_L6_theta_ = -b_L2_theta_*l_L6_theta_L2_theta_ + b_L2_theta__i*l_L6_theta_L2_theta_3__i
        - b_L3_theta_*l_L6_theta_L3_theta_ + b_L3_theta__i*l_L6_theta_L3_theta_3__i - b_L7_theta_*l_L6_theta_L7_theta_
        + b_L7_theta__i*l_L6_theta_L7_theta_3__i - b_L8_theta_*l_L6_theta_L8_theta_
        + b_L8_theta__i*l_L6_theta_L8_theta_3__i + x[0];
    const double b_L6_theta__i = -b_L2_theta_*l_L6_theta_L2_theta_3__i - b_L2_theta__i*l_L6_theta_L2_theta_
        - b_L3_theta_*l_L6_theta_L3_theta_3__i - b_L3_theta__i*l_L6_theta_L3_theta_
        - b_L7_theta_*l_L6_theta_L7_theta_3__i - b_L7_theta__i*l_L6_theta_L7_theta_
        - b_L8_theta_*l_L6_theta_L8_theta_3__i - b_L8_theta__i*l_L6_theta_L8_theta_ + x[1];
    const double b_guide_offset_ = -b_L6_theta_*l_guide_offset_L6_theta_ + b_L6_theta__i*l_guide_offset_L6_theta_3__i
        - b_L8_theta_*l_guide_offset_L8_theta_ + b_L8_theta__i*l_guide_offset_L8_theta_3__i + x[10];
    const double b_guide_offset__i = -b_L6_theta_*l_guide_offset_L6_theta_3__i - b_L6_theta__i*l_guide_offset_L6_theta_
        - b_L8_theta_*l_guide_offset_L8_theta_3__i - b_L8_theta__i*l_guide_offset_L8_theta_ + x[11];

    /* backward */
    const double x_guide_offset_ = b_guide_offset_*inverse_pivot_guide_offset_
        - b_guide_offset__i*inverse_pivot_guide_offset_3__i;
    const double x_guide_offset__i = b_guide_offset_*inverse_pivot_guide_offset_3__i
        + b_guide_offset__i*inverse_pivot_guide_offset_;
    x[10] = x_guide_offset_;
    x[11] = x_guide_offset__i;
    const double factor_1 = b_L6_theta_ - u_L6_theta_guide_offset_*x_guide_offset_
        + u_L6_theta_guide_offset__i*x_guide_offset__i;
    const double factor_2 = b_L6_theta__i - u_L6_theta_guide_offset_*x_guide_offset__i
        - u_L6_theta_guide_offset__i*x_guide_offset_;
    const double x_L6_theta_ = factor_1*inverse_pivot_L6_theta_ - factor_2*inverse_pivot_L6_theta_3__i;
    const double x_L6_theta__i = factor_1*inverse_pivot_L6_theta_3__i + factor_2*inverse_pivot_L6_theta_;
    x[0] = x_L6_theta_;
    x[1] = x_L6_theta__i;
    const double factor_3 = b_L3_theta_ - u_L3_theta_L6_theta_*x_L6_theta_ + u_L3_theta_L6_theta__i*x_L6_theta__i;
    const double factor_4 = b_L3_theta__i - u_L3_theta_L6_theta_*x_L6_theta__i - u_L3_theta_L6_theta__i*x_L6_theta_;
    const double x_L3_theta_ = factor_3*inverse_pivot_L3_theta_ - factor_4*inverse_pivot_L3_theta_3__i;
    const double x_L3_theta__i = factor_3*inverse_pivot_L3_theta_3__i + factor_4*inverse_pivot_L3_theta_;
    x[8] = x_L3_theta_;
    x[9] = x_L3_theta__i;
    const double factor_5 = b_L7_theta_ - n_L7_theta_L3_theta_*x_L3_theta_ + n_L7_theta_L3_theta__i*x_L3_theta__i
        - u_L7_theta_L6_theta_*x_L6_theta_ + u_L7_theta_L6_theta__i*x_L6_theta__i;
    const double factor_6 = b_L7_theta__i - n_L7_theta_L3_theta_*x_L3_theta__i - n_L7_theta_L3_theta__i*x_L3_theta_
        - u_L7_theta_L6_theta_*x_L6_theta__i - u_L7_theta_L6_theta__i*x_L6_theta_;
    const double x_L7_theta_ = factor_5*inverse_pivot_L7_theta_ - factor_6*inverse_pivot_L7_theta_3__i;
    const double x_L7_theta__i = factor_5*inverse_pivot_L7_theta_3__i + factor_6*inverse_pivot_L7_theta_;
    x[2] = x_L7_theta_;
    x[3] = x_L7_theta__i;
    const double factor_7 = b_L2_theta_ - n_L2_theta_L6_theta_*x_L6_theta_ + n_L2_theta_L6_theta__i*x_L6_theta__i
        - n_L2_theta_L7_theta_*x_L7_theta_ + n_L2_theta_L7_theta__i*x_L7_theta__i;
    const double factor_8 = b_L2_theta__i - n_L2_theta_L6_theta_*x_L6_theta__i - n_L2_theta_L6_theta__i*x_L6_theta_
        - n_L2_theta_L7_theta_*x_L7_theta__i - n_L2_theta_L7_theta__i*x_L7_theta_;
    const double x_L2_theta_ = factor_7*inverse_pivot_L2_theta_ - factor_8*inverse_pivot_L2_theta__i;
    const double x_L2_theta__i = factor_7*inverse_pivot_L2_theta__i + factor_8*inverse_pivot_L2_theta_;
    x[6] = x_L2_theta_;
    x[7] = x_L2_theta__i;
    const double factor_9 = b_L8_theta_ - n_L8_theta_L6_theta_*x_L6_theta_ + n_L8_theta_L6_theta__i*x_L6_theta__i
        - phi_guide_offset_L8_theta_*x_guide_offset_;
    const double factor_10 = b_L8_theta__i - n_L8_theta_L6_theta_*x_L6_theta__i - n_L8_theta_L6_theta__i*x_L6_theta_
        - phi_guide_offset_L8_theta_*x_guide_offset__i;
    const double x_L8_theta_ = -factor_10*inverse_pivot_L8_theta__i + factor_9*inverse_pivot_L8_theta_;
    const double x_L8_theta__i = factor_10*inverse_pivot_L8_theta_ + factor_9*inverse_pivot_L8_theta__i;
    x[4] = x_L8_theta_;
    x[5] = x_L8_theta__i;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 * At complex eta: real and imaginary parts one behind the other.
 */
void newton_solve_complex(const ComplexLinear *lin, double eta, double eta_i, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta_ = lin->value[0];
    const double mass_L6_theta_L2_theta_ = lin->value[1];
    const double mass_L7_theta_L2_theta_ = lin->value[2];
    const double mass_L6_theta_L3_theta_ = lin->value[3];
    const double mass_L7_theta_L3_theta_ = lin->value[4];
    const double mass_L6_theta_L8_theta_ = lin->value[5];
    const double phi_guide_offset_L6_theta_ = lin->value[6];
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double by_q_guide_offset_L6_theta_ = lin->value[8];
    const double by_q_guide_offset_L8_theta_ = lin->value[9];
    const double by_q_L6_theta_L6_theta_ = lin->value[10];
    const double by_q_L6_theta_L7_theta_ = lin->value[11];
    const double by_q_L6_theta_L2_theta_ = lin->value[12];
    const double by_q_L6_theta_L3_theta_ = lin->value[13];
    const double by_q_L6_theta_L8_theta_ = lin->value[14];
    const double by_q_L7_theta_L6_theta_ = lin->value[15];
    const double by_q_L7_theta_L7_theta_ = lin->value[16];
    const double by_q_L7_theta_L2_theta_ = lin->value[17];
    const double by_q_L7_theta_L3_theta_ = lin->value[18];
    const double by_q_L8_theta_L8_theta_ = lin->value[19];
    const double by_q_L8_theta_L6_theta_ = lin->value[20];
    const double by_q_L2_theta_L6_theta_ = lin->value[21];
    const double by_q_L2_theta_L7_theta_ = lin->value[22];
    const double by_q_L2_theta_L2_theta_ = lin->value[23];
    const double by_q_L3_theta_L6_theta_ = lin->value[24];
    const double by_q_L3_theta_L7_theta_ = lin->value[25];
    const double by_q_L3_theta_L3_theta_ = lin->value[26];
    const double power_q_0_L6_theta_ = lin->value[49];
    const double power_q_0_L7_theta_ = lin->value[50];
    const double power_q_0_L2_theta_ = lin->value[51];
    const double power_q_0_L3_theta_ = lin->value[52];
    const double power_q_2_L6_theta_ = lin->value[53];
    const double power_q_2_L7_theta_ = lin->value[54];
    const double power_q_2_L2_theta_ = lin->value[55];
    const double power_q_2_L3_theta_ = lin->value[56];
    const double power_v_0_L6_theta_ = lin->value[57];
    const double power_v_0_L7_theta_ = lin->value[58];
    const double power_v_0_L2_theta_ = lin->value[59];
    const double power_v_0_L3_theta_ = lin->value[60];
    const double power_v_2_L6_theta_ = lin->value[61];
    const double power_v_2_L7_theta_ = lin->value[62];
    const double power_v_2_L2_theta_ = lin->value[63];
    const double power_v_2_L3_theta_ = lin->value[64];

    /* eta/kappa */
    const double factor_1 = p->beta_squared_*eta + p->two_alpha_;
    const double factor_2 = p->beta_squared_*eta_i;
    const double divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const double divisor_2 = eta*factor_2 + eta_i*factor_1;
    const double divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const double factor_3 = divisor_1*divisor_3;
    const double factor_4 = -divisor_2*divisor_3;
    const double eta_row = eta*factor_3 - eta_i*factor_4;
    const double eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* right-hand side */
    double x[12];
    const double shifted_L6_theta_ = -p->beta_squared_*(eta*r[0] - eta_i*r[1]) + r[10];
    const double shifted_L6_theta__i = -p->beta_squared_*(eta*r[1] + eta_i*r[0]) + r[11];
    const double shifted_L8_theta_ = -p->beta_squared_*(eta*r[4] - eta_i*r[5]) + r[14];
    const double shifted_L8_theta__i = -p->beta_squared_*(eta*r[5] + eta_i*r[4]) + r[15];
    const double factor_5 = -by_q_L6_theta_L2_theta_*(eta*r[6] - eta_i*r[7])
        - by_q_L6_theta_L3_theta_*(eta*r[8] - eta_i*r[9]) - by_q_L6_theta_L6_theta_*(eta*r[0] - eta_i*r[1])
        - by_q_L6_theta_L7_theta_*(eta*r[2] - eta_i*r[3]) - by_q_L6_theta_L8_theta_*(eta*r[4] - eta_i*r[5])
        + p->mass_L6_L6_*r[10] + mass_L6_theta_L2_theta_*r[16] + mass_L6_theta_L3_theta_*r[18]
        + mass_L6_theta_L7_theta_*r[12] + mass_L6_theta_L8_theta_*r[14];
    const double factor_6 = -by_q_L6_theta_L2_theta_*(eta*r[7] + eta_i*r[6])
        - by_q_L6_theta_L3_theta_*(eta*r[9] + eta_i*r[8]) - by_q_L6_theta_L6_theta_*(eta*r[1] + eta_i*r[0])
        - by_q_L6_theta_L7_theta_*(eta*r[3] + eta_i*r[2]) - by_q_L6_theta_L8_theta_*(eta*r[5] + eta_i*r[4])
        + p->mass_L6_L6_*r[11] + mass_L6_theta_L2_theta_*r[17] + mass_L6_theta_L3_theta_*r[19]
        + mass_L6_theta_L7_theta_*r[13] + mass_L6_theta_L8_theta_*r[15];
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = -by_q_L7_theta_L2_theta_*(eta*r[6] - eta_i*r[7])
        - by_q_L7_theta_L3_theta_*(eta*r[8] - eta_i*r[9]) - by_q_L7_theta_L6_theta_*(eta*r[0] - eta_i*r[1])
        - by_q_L7_theta_L7_theta_*(eta*r[2] - eta_i*r[3]) + mass_L6_theta_L7_theta_*r[10] + p->mass_L7_L7_*r[12]
        + mass_L7_theta_L2_theta_*r[16] + mass_L7_theta_L3_theta_*r[18];
    const double factor_8 = -by_q_L7_theta_L2_theta_*(eta*r[7] + eta_i*r[6])
        - by_q_L7_theta_L3_theta_*(eta*r[9] + eta_i*r[8]) - by_q_L7_theta_L6_theta_*(eta*r[1] + eta_i*r[0])
        - by_q_L7_theta_L7_theta_*(eta*r[3] + eta_i*r[2]) + mass_L6_theta_L7_theta_*r[11] + p->mass_L7_L7_*r[13]
        + mass_L7_theta_L2_theta_*r[17] + mass_L7_theta_L3_theta_*r[19];
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = -by_q_L8_theta_L6_theta_*(eta*r[0] - eta_i*r[1])
        - by_q_L8_theta_L8_theta_*(eta*r[4] - eta_i*r[5]) + mass_L6_theta_L8_theta_*r[10] + p->mass_L8_L8_*r[14];
    const double factor_10 = -by_q_L8_theta_L6_theta_*(eta*r[1] + eta_i*r[0])
        - by_q_L8_theta_L8_theta_*(eta*r[5] + eta_i*r[4]) + mass_L6_theta_L8_theta_*r[11] + p->mass_L8_L8_*r[15];
    x[4] = eta*factor_9 - eta_i*factor_10;
    x[5] = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = -by_q_L2_theta_L2_theta_*(eta*r[6] - eta_i*r[7])
        - by_q_L2_theta_L6_theta_*(eta*r[0] - eta_i*r[1]) - by_q_L2_theta_L7_theta_*(eta*r[2] - eta_i*r[3])
        + p->mass_L2_L2_*r[16] + mass_L6_theta_L2_theta_*r[10] + mass_L7_theta_L2_theta_*r[12];
    const double factor_12 = -by_q_L2_theta_L2_theta_*(eta*r[7] + eta_i*r[6])
        - by_q_L2_theta_L6_theta_*(eta*r[1] + eta_i*r[0]) - by_q_L2_theta_L7_theta_*(eta*r[3] + eta_i*r[2])
        + p->mass_L2_L2_*r[17] + mass_L6_theta_L2_theta_*r[11] + mass_L7_theta_L2_theta_*r[13];
    x[6] = eta*factor_11 - eta_i*factor_12;
    x[7] = eta*factor_12 + eta_i*factor_11;
    const double factor_13 = -by_q_L3_theta_L3_theta_*(eta*r[8] - eta_i*r[9])
        - by_q_L3_theta_L6_theta_*(eta*r[0] - eta_i*r[1]) - by_q_L3_theta_L7_theta_*(eta*r[2] - eta_i*r[3])
        + p->mass_L3_L3_*r[18] + mass_L6_theta_L3_theta_*r[10] + mass_L7_theta_L3_theta_*r[12];
    const double factor_14 = -by_q_L3_theta_L3_theta_*(eta*r[9] + eta_i*r[8])
        - by_q_L3_theta_L6_theta_*(eta*r[1] + eta_i*r[0]) - by_q_L3_theta_L7_theta_*(eta*r[3] + eta_i*r[2])
        + p->mass_L3_L3_*r[19] + mass_L6_theta_L3_theta_*r[11] + mass_L7_theta_L3_theta_*r[13];
    x[8] = eta*factor_13 - eta_i*factor_14;
    x[9] = eta*factor_14 + eta_i*factor_13;
    const double factor_15 = -by_q_guide_offset_L6_theta_*(eta*r[0] - eta_i*r[1])
        - by_q_guide_offset_L8_theta_*(eta*r[4] - eta_i*r[5]) + phi_guide_offset_L6_theta_*shifted_L6_theta_
        + phi_guide_offset_L8_theta_*shifted_L8_theta_;
    const double factor_16 = -by_q_guide_offset_L6_theta_*(eta*r[1] + eta_i*r[0])
        - by_q_guide_offset_L8_theta_*(eta*r[5] + eta_i*r[4]) + phi_guide_offset_L6_theta_*shifted_L6_theta__i
        + phi_guide_offset_L8_theta_*shifted_L8_theta__i;
    x[10] = eta_row*factor_15 - eta_row_i*factor_16;
    x[11] = eta_row*factor_16 + eta_row_i*factor_15;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_17 = r[0] + x[0];
    const double factor_18 = r[1] + x[1];
    u[0] = eta*factor_17 - eta_i*factor_18;
    u[1] = eta*factor_18 + eta_i*factor_17;
    u[10] = x[0];
    u[11] = x[1];
    const double factor_19 = r[2] + x[2];
    const double factor_20 = r[3] + x[3];
    u[2] = eta*factor_19 - eta_i*factor_20;
    u[3] = eta*factor_20 + eta_i*factor_19;
    u[12] = x[2];
    u[13] = x[3];
    const double factor_21 = r[4] + x[4];
    const double factor_22 = r[5] + x[5];
    u[4] = eta*factor_21 - eta_i*factor_22;
    u[5] = eta*factor_22 + eta_i*factor_21;
    u[14] = x[4];
    u[15] = x[5];
    const double factor_23 = r[6] + x[6];
    const double factor_24 = r[7] + x[7];
    u[6] = eta*factor_23 - eta_i*factor_24;
    u[7] = eta*factor_24 + eta_i*factor_23;
    u[16] = x[6];
    u[17] = x[7];
    const double factor_25 = r[8] + x[8];
    const double factor_26 = r[9] + x[9];
    u[8] = eta*factor_25 - eta_i*factor_26;
    u[9] = eta*factor_26 + eta_i*factor_25;
    u[18] = x[8];
    u[19] = x[9];
    const double factor_27 = power_q_0_L2_theta_*u[6] + power_q_0_L3_theta_*u[8] + power_q_0_L6_theta_*u[0]
        + power_q_0_L7_theta_*u[2] + power_v_0_L2_theta_*u[16] + power_v_0_L3_theta_*u[18] + power_v_0_L6_theta_*u[10]
        + power_v_0_L7_theta_*u[12] + r[20];
    const double factor_28 = power_q_0_L2_theta_*u[7] + power_q_0_L3_theta_*u[9] + power_q_0_L6_theta_*u[1]
        + power_q_0_L7_theta_*u[3] + power_v_0_L2_theta_*u[17] + power_v_0_L3_theta_*u[19] + power_v_0_L6_theta_*u[11]
        + power_v_0_L7_theta_*u[13] + r[21];
    u[20] = eta*factor_27 - eta_i*factor_28;
    u[21] = eta*factor_28 + eta_i*factor_27;
    u[22] = eta*r[22] - eta_i*r[23];
    u[23] = eta*r[23] + eta_i*r[22];
    const double factor_29 = power_q_2_L2_theta_*u[6] + power_q_2_L3_theta_*u[8] + power_q_2_L6_theta_*u[0]
        + power_q_2_L7_theta_*u[2] + power_v_2_L2_theta_*u[16] + power_v_2_L3_theta_*u[18] + power_v_2_L6_theta_*u[10]
        + power_v_2_L7_theta_*u[12] + r[24];
    const double factor_30 = power_q_2_L2_theta_*u[7] + power_q_2_L3_theta_*u[9] + power_q_2_L6_theta_*u[1]
        + power_q_2_L7_theta_*u[3] + power_v_2_L2_theta_*u[17] + power_v_2_L3_theta_*u[19] + power_v_2_L6_theta_*u[11]
        + power_v_2_L7_theta_*u[13] + r[25];
    u[24] = eta*factor_29 - eta_i*factor_30;
    u[25] = eta*factor_30 + eta_i*factor_29;
}
