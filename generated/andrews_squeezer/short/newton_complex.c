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
    const double factor_1 = p->beta_squared*eta + p->two_alpha;
    const double factor_2 = p->beta_squared*eta_i;
    const double divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const double divisor_2 = eta*factor_2 + eta_i*factor_1;
    const double divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const double factor_3 = divisor_1*divisor_3;
    const double factor_4 = -divisor_2*divisor_3;
    const double eta_row = eta*factor_3 - eta_i*factor_4;
    const double eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* matrix */
    const double n_OF_theta__OF_theta = by_q_OF_theta_OF_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_OF_OF;
    const double n_OF_theta__OF_theta_i = 2.0*by_q_OF_theta_OF_theta*eta*eta_i;
    const double factor_5 = by_q_OF_theta_FE_theta*eta + by_v_OF_theta_FE_theta;
    const double factor_6 = by_q_OF_theta_FE_theta*eta_i;
    const double n_OF_theta__FE_theta = eta*factor_5 - eta_i*factor_6 + mass_OF_theta_FE_theta;
    const double n_OF_theta__FE_theta_i = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = by_q_OF_theta_EG_theta*eta + by_v_OF_theta_EG_theta;
    const double factor_8 = by_q_OF_theta_EG_theta*eta_i;
    const double n_OF_theta__EG_theta = eta*factor_7 - eta_i*factor_8 + mass_OF_theta_EG_theta;
    const double n_OF_theta__EG_theta_i = eta*factor_8 + eta_i*factor_7;
    const double n_BDE_theta__BDE_theta = by_q_BDE_theta_BDE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_BDE_BDE;
    const double n_BDE_theta__BDE_theta_i = 2.0*by_q_BDE_theta_BDE_theta*eta*eta_i;
    const double factor_9 = by_q_BDE_theta_HE_theta*eta + by_v_BDE_theta_HE_theta;
    const double factor_10 = by_q_BDE_theta_HE_theta*eta_i;
    const double n_BDE_theta__HE_theta = eta*factor_9 - eta_i*factor_10 + mass_BDE_theta_HE_theta;
    const double n_BDE_theta__HE_theta_i = eta*factor_10 + eta_i*factor_9;
    const double n_AG_theta__AG_theta = by_q_AG_theta_AG_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_AG_AG;
    const double n_AG_theta__AG_theta_i = 2.0*by_q_AG_theta_AG_theta*eta*eta_i;
    const double n_AH_theta__AH_theta = by_q_AH_theta_AH_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_AH_AH;
    const double n_AH_theta__AH_theta_i = 2.0*by_q_AH_theta_AH_theta*eta*eta_i;
    const double factor_11 = by_q_FE_theta_OF_theta*eta + by_v_FE_theta_OF_theta;
    const double factor_12 = by_q_FE_theta_OF_theta*eta_i;
    const double n_FE_theta__OF_theta = eta*factor_11 - eta_i*factor_12 + mass_OF_theta_FE_theta;
    const double n_FE_theta__OF_theta_i = eta*factor_12 + eta_i*factor_11;
    const double n_FE_theta__FE_theta = by_q_FE_theta_FE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_FE_FE;
    const double n_FE_theta__FE_theta_i = 2.0*by_q_FE_theta_FE_theta*eta*eta_i;
    const double factor_13 = by_q_FE_theta_EG_theta*eta + by_v_FE_theta_EG_theta;
    const double factor_14 = by_q_FE_theta_EG_theta*eta_i;
    const double n_FE_theta__EG_theta = eta*factor_13 - eta_i*factor_14 + mass_FE_theta_EG_theta;
    const double n_FE_theta__EG_theta_i = eta*factor_14 + eta_i*factor_13;
    const double factor_15 = by_q_HE_theta_BDE_theta*eta + by_v_HE_theta_BDE_theta;
    const double factor_16 = by_q_HE_theta_BDE_theta*eta_i;
    const double n_HE_theta__BDE_theta = eta*factor_15 - eta_i*factor_16 + mass_BDE_theta_HE_theta;
    const double n_HE_theta__BDE_theta_i = eta*factor_16 + eta_i*factor_15;
    const double n_HE_theta__HE_theta = by_q_HE_theta_HE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_HE_HE;
    const double n_HE_theta__HE_theta_i = 2.0*by_q_HE_theta_HE_theta*eta*eta_i;
    const double factor_17 = by_q_EG_theta_OF_theta*eta + by_v_EG_theta_OF_theta;
    const double factor_18 = by_q_EG_theta_OF_theta*eta_i;
    const double n_EG_theta__OF_theta = eta*factor_17 - eta_i*factor_18 + mass_OF_theta_EG_theta;
    const double n_EG_theta__OF_theta_i = eta*factor_18 + eta_i*factor_17;
    const double factor_19 = by_q_EG_theta_FE_theta*eta + by_v_EG_theta_FE_theta;
    const double factor_20 = by_q_EG_theta_FE_theta*eta_i;
    const double n_EG_theta__FE_theta = eta*factor_19 - eta_i*factor_20 + mass_FE_theta_EG_theta;
    const double n_EG_theta__FE_theta_i = eta*factor_20 + eta_i*factor_19;
    const double n_EG_theta__EG_theta = by_q_EG_theta_EG_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_EG_EG;
    const double n_EG_theta__EG_theta_i = 2.0*by_q_EG_theta_EG_theta*eta*eta_i;
    const double factor_21 = by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta;
    const double factor_22 = by_q_G_x_OF_theta*eta_i;
    const double n_G_x__OF_theta = eta_row*factor_21 - eta_row_i*factor_22 + phi_G_x_OF_theta;
    const double n_G_x__OF_theta_i = eta_row*factor_22 + eta_row_i*factor_21;
    const double factor_23 = by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta;
    const double factor_24 = by_q_G_x_AG_theta*eta_i;
    const double n_G_x__AG_theta = eta_row*factor_23 - eta_row_i*factor_24 + phi_G_x_AG_theta;
    const double n_G_x__AG_theta_i = eta_row*factor_24 + eta_row_i*factor_23;
    const double factor_25 = by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta;
    const double factor_26 = by_q_G_x_FE_theta*eta_i;
    const double n_G_x__FE_theta = eta_row*factor_25 - eta_row_i*factor_26 + phi_G_x_FE_theta;
    const double n_G_x__FE_theta_i = eta_row*factor_26 + eta_row_i*factor_25;
    const double factor_27 = by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta;
    const double factor_28 = by_q_G_x_EG_theta*eta_i;
    const double n_G_x__EG_theta = eta_row*factor_27 - eta_row_i*factor_28 + phi_G_x_EG_theta;
    const double n_G_x__EG_theta_i = eta_row*factor_28 + eta_row_i*factor_27;
    const double factor_29 = by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta;
    const double factor_30 = by_q_G_y_OF_theta*eta_i;
    const double n_G_y__OF_theta = eta_row*factor_29 - eta_row_i*factor_30 + phi_G_y_OF_theta;
    const double n_G_y__OF_theta_i = eta_row*factor_30 + eta_row_i*factor_29;
    const double factor_31 = by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta;
    const double factor_32 = by_q_G_y_AG_theta*eta_i;
    const double n_G_y__AG_theta = eta_row*factor_31 - eta_row_i*factor_32 + phi_G_y_AG_theta;
    const double n_G_y__AG_theta_i = eta_row*factor_32 + eta_row_i*factor_31;
    const double factor_33 = by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta;
    const double factor_34 = by_q_G_y_FE_theta*eta_i;
    const double n_G_y__FE_theta = eta_row*factor_33 - eta_row_i*factor_34 + phi_G_y_FE_theta;
    const double n_G_y__FE_theta_i = eta_row*factor_34 + eta_row_i*factor_33;
    const double factor_35 = by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta;
    const double factor_36 = by_q_G_y_EG_theta*eta_i;
    const double n_G_y__EG_theta = eta_row*factor_35 - eta_row_i*factor_36 + phi_G_y_EG_theta;
    const double n_G_y__EG_theta_i = eta_row*factor_36 + eta_row_i*factor_35;
    const double factor_37 = by_q_H_x_BDE_theta*eta + by_v_H_x_BDE_theta;
    const double factor_38 = by_q_H_x_BDE_theta*eta_i;
    const double n_H_x__BDE_theta = eta_row*factor_37 - eta_row_i*factor_38 + phi_H_x_BDE_theta;
    const double n_H_x__BDE_theta_i = eta_row*factor_38 + eta_row_i*factor_37;
    const double factor_39 = by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta;
    const double factor_40 = by_q_H_x_AH_theta*eta_i;
    const double n_H_x__AH_theta = eta_row*factor_39 - eta_row_i*factor_40 + phi_H_x_AH_theta;
    const double n_H_x__AH_theta_i = eta_row*factor_40 + eta_row_i*factor_39;
    const double factor_41 = by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta;
    const double factor_42 = by_q_H_x_HE_theta*eta_i;
    const double n_H_x__HE_theta = eta_row*factor_41 - eta_row_i*factor_42 + phi_H_x_HE_theta;
    const double n_H_x__HE_theta_i = eta_row*factor_42 + eta_row_i*factor_41;
    const double factor_43 = by_q_H_y_BDE_theta*eta + by_v_H_y_BDE_theta;
    const double factor_44 = by_q_H_y_BDE_theta*eta_i;
    const double n_H_y__BDE_theta = eta_row*factor_43 - eta_row_i*factor_44 + phi_H_y_BDE_theta;
    const double n_H_y__BDE_theta_i = eta_row*factor_44 + eta_row_i*factor_43;
    const double factor_45 = by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta;
    const double factor_46 = by_q_H_y_AH_theta*eta_i;
    const double n_H_y__AH_theta = eta_row*factor_45 - eta_row_i*factor_46 + phi_H_y_AH_theta;
    const double n_H_y__AH_theta_i = eta_row*factor_46 + eta_row_i*factor_45;
    const double factor_47 = by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta;
    const double factor_48 = by_q_H_y_HE_theta*eta_i;
    const double n_H_y__HE_theta = eta_row*factor_47 - eta_row_i*factor_48 + phi_H_y_HE_theta;
    const double n_H_y__HE_theta_i = eta_row*factor_48 + eta_row_i*factor_47;
    const double factor_49 = by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta;
    const double factor_50 = by_q_G_x_OF_theta*eta_i;
    const double n_E3_x__OF_theta = eta_row*factor_49 - eta_row_i*factor_50 + phi_G_x_OF_theta;
    const double n_E3_x__OF_theta_i = eta_row*factor_50 + eta_row_i*factor_49;
    const double factor_51 = -by_q_H_x_BDE_theta*eta - by_v_H_x_BDE_theta;
    const double factor_52 = -by_q_H_x_BDE_theta*eta_i;
    const double n_E3_x__BDE_theta = eta_row*factor_51 - eta_row_i*factor_52 - phi_H_x_BDE_theta;
    const double n_E3_x__BDE_theta_i = eta_row*factor_52 + eta_row_i*factor_51;
    const double factor_53 = by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta;
    const double factor_54 = by_q_G_x_FE_theta*eta_i;
    const double n_E3_x__FE_theta = eta_row*factor_53 - eta_row_i*factor_54 + phi_G_x_FE_theta;
    const double n_E3_x__FE_theta_i = eta_row*factor_54 + eta_row_i*factor_53;
    const double factor_55 = by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta;
    const double factor_56 = by_q_G_y_OF_theta*eta_i;
    const double n_E3_y__OF_theta = eta_row*factor_55 - eta_row_i*factor_56 + phi_G_y_OF_theta;
    const double n_E3_y__OF_theta_i = eta_row*factor_56 + eta_row_i*factor_55;
    const double factor_57 = -by_q_H_y_BDE_theta*eta - by_v_H_y_BDE_theta;
    const double factor_58 = -by_q_H_y_BDE_theta*eta_i;
    const double n_E3_y__BDE_theta = eta_row*factor_57 - eta_row_i*factor_58 - phi_H_y_BDE_theta;
    const double n_E3_y__BDE_theta_i = eta_row*factor_58 + eta_row_i*factor_57;
    const double factor_59 = by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta;
    const double factor_60 = by_q_G_y_FE_theta*eta_i;
    const double n_E3_y__FE_theta = eta_row*factor_59 - eta_row_i*factor_60 + phi_G_y_FE_theta;
    const double n_E3_y__FE_theta_i = eta_row*factor_60 + eta_row_i*factor_59;

    /* L U */
    const double scale_AG_theta = n_AG_theta__AG_theta;
    const double scale_AG_theta_i = n_AG_theta__AG_theta_i;
    const double size_1 = fabs(scale_AG_theta) + fabs(scale_AG_theta_i);
    const double size_2 = fabs(n_AG_theta__AG_theta) + fabs(n_AG_theta__AG_theta_i);
    if (!(size_1 > SINGULAR * size_2))
        return 3;
    const double divisor_4 = 1.0/((scale_AG_theta * scale_AG_theta) + (scale_AG_theta_i * scale_AG_theta_i));
    const double inverse_pivot_AG_theta = divisor_4*scale_AG_theta;
    const double inverse_pivot_AG_theta_i = -divisor_4*scale_AG_theta_i;
    lin->lu[0] = inverse_pivot_AG_theta;
    lin->lu[1] = inverse_pivot_AG_theta_i;
    const double l_G_x__AG_theta = inverse_pivot_AG_theta*n_G_x__AG_theta - inverse_pivot_AG_theta_i*n_G_x__AG_theta_i;
    const double l_G_x__AG_theta_3_i = inverse_pivot_AG_theta*n_G_x__AG_theta_i
        + inverse_pivot_AG_theta_i*n_G_x__AG_theta;
    lin->lu[2] = l_G_x__AG_theta;
    lin->lu[3] = l_G_x__AG_theta_3_i;
    const double l_G_y__AG_theta = inverse_pivot_AG_theta*n_G_y__AG_theta - inverse_pivot_AG_theta_i*n_G_y__AG_theta_i;
    const double l_G_y__AG_theta_3_i = inverse_pivot_AG_theta*n_G_y__AG_theta_i
        + inverse_pivot_AG_theta_i*n_G_y__AG_theta;
    lin->lu[4] = l_G_y__AG_theta;
    lin->lu[5] = l_G_y__AG_theta_3_i;
    const double scale_AH_theta = n_AH_theta__AH_theta;
    const double scale_AH_theta_i = n_AH_theta__AH_theta_i;
    const double size_3 = fabs(scale_AH_theta) + fabs(scale_AH_theta_i);
    const double size_4 = fabs(n_AH_theta__AH_theta) + fabs(n_AH_theta__AH_theta_i);
    if (!(size_3 > SINGULAR * size_4))
        return 4;
    const double divisor_5 = 1.0/((scale_AH_theta * scale_AH_theta) + (scale_AH_theta_i * scale_AH_theta_i));
    const double inverse_pivot_AH_theta = divisor_5*scale_AH_theta;
    const double inverse_pivot_AH_theta_i = -divisor_5*scale_AH_theta_i;
    lin->lu[6] = inverse_pivot_AH_theta;
    lin->lu[7] = inverse_pivot_AH_theta_i;
    const double l_H_x__AH_theta = inverse_pivot_AH_theta*n_H_x__AH_theta - inverse_pivot_AH_theta_i*n_H_x__AH_theta_i;
    const double l_H_x__AH_theta_3_i = inverse_pivot_AH_theta*n_H_x__AH_theta_i
        + inverse_pivot_AH_theta_i*n_H_x__AH_theta;
    lin->lu[8] = l_H_x__AH_theta;
    lin->lu[9] = l_H_x__AH_theta_3_i;
    const double l_H_y__AH_theta = inverse_pivot_AH_theta*n_H_y__AH_theta - inverse_pivot_AH_theta_i*n_H_y__AH_theta_i;
    const double l_H_y__AH_theta_3_i = inverse_pivot_AH_theta*n_H_y__AH_theta_i
        + inverse_pivot_AH_theta_i*n_H_y__AH_theta;
    lin->lu[10] = l_H_y__AH_theta;
    lin->lu[11] = l_H_y__AH_theta_3_i;
    const double scale_HE_theta = n_HE_theta__HE_theta;
    const double scale_HE_theta_i = n_HE_theta__HE_theta_i;
    const double size_5 = fabs(scale_HE_theta) + fabs(scale_HE_theta_i);
    const double size_6 = fabs(n_HE_theta__HE_theta) + fabs(n_HE_theta__HE_theta_i);
    if (!(size_5 > SINGULAR * size_6))
        return 6;
    const double divisor_6 = 1.0/((scale_HE_theta * scale_HE_theta) + (scale_HE_theta_i * scale_HE_theta_i));
    const double inverse_pivot_HE_theta = divisor_6*scale_HE_theta;
    const double inverse_pivot_HE_theta_i = -divisor_6*scale_HE_theta_i;
    lin->lu[12] = inverse_pivot_HE_theta;
    lin->lu[13] = inverse_pivot_HE_theta_i;
    const double l_BDE_theta__HE_theta = inverse_pivot_HE_theta*n_BDE_theta__HE_theta
        - inverse_pivot_HE_theta_i*n_BDE_theta__HE_theta_i;
    const double l_BDE_theta__HE_theta_3_i = inverse_pivot_HE_theta*n_BDE_theta__HE_theta_i
        + inverse_pivot_HE_theta_i*n_BDE_theta__HE_theta;
    lin->lu[14] = l_BDE_theta__HE_theta;
    lin->lu[15] = l_BDE_theta__HE_theta_3_i;
    lin->lu[16] = n_HE_theta__BDE_theta;
    lin->lu[17] = n_HE_theta__BDE_theta_i;
    const double l_H_x__HE_theta = inverse_pivot_HE_theta*n_H_x__HE_theta - inverse_pivot_HE_theta_i*n_H_x__HE_theta_i;
    const double l_H_x__HE_theta_3_i = inverse_pivot_HE_theta*n_H_x__HE_theta_i
        + inverse_pivot_HE_theta_i*n_H_x__HE_theta;
    lin->lu[18] = l_H_x__HE_theta;
    lin->lu[19] = l_H_x__HE_theta_3_i;
    const double l_H_y__HE_theta = inverse_pivot_HE_theta*n_H_y__HE_theta - inverse_pivot_HE_theta_i*n_H_y__HE_theta_i;
    const double l_H_y__HE_theta_3_i = inverse_pivot_HE_theta*n_H_y__HE_theta_i
        + inverse_pivot_HE_theta_i*n_H_y__HE_theta;
    lin->lu[20] = l_H_y__HE_theta;
    lin->lu[21] = l_H_y__HE_theta_3_i;
    const double scale_BDE_theta = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta
        + l_BDE_theta__HE_theta_3_i*n_HE_theta__BDE_theta_i + n_BDE_theta__BDE_theta;
    const double scale_BDE_theta_i = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta_i
        - l_BDE_theta__HE_theta_3_i*n_HE_theta__BDE_theta + n_BDE_theta__BDE_theta_i;
    const double size_7 = fabs(scale_BDE_theta) + fabs(scale_BDE_theta_i);
    const double size_8 = fabs(n_BDE_theta__BDE_theta) + fabs(n_BDE_theta__BDE_theta_i);
    if (!(size_7 > SINGULAR * size_8))
        return 2;
    const double divisor_7 = 1.0/((scale_BDE_theta * scale_BDE_theta) + (scale_BDE_theta_i * scale_BDE_theta_i));
    const double inverse_pivot_BDE_theta = divisor_7*scale_BDE_theta;
    const double inverse_pivot_BDE_theta_3_i = -divisor_7*scale_BDE_theta_i;
    lin->lu[22] = inverse_pivot_BDE_theta;
    lin->lu[23] = inverse_pivot_BDE_theta_3_i;
    const double factor_61 = -l_H_x__HE_theta*n_HE_theta__BDE_theta + l_H_x__HE_theta_3_i*n_HE_theta__BDE_theta_i
        + n_H_x__BDE_theta;
    const double factor_62 = -l_H_x__HE_theta*n_HE_theta__BDE_theta_i - l_H_x__HE_theta_3_i*n_HE_theta__BDE_theta
        + n_H_x__BDE_theta_i;
    const double l_H_x__BDE_theta = factor_61*inverse_pivot_BDE_theta - factor_62*inverse_pivot_BDE_theta_3_i;
    const double l_H_x__BDE_theta_2_i = factor_61*inverse_pivot_BDE_theta_3_i + factor_62*inverse_pivot_BDE_theta;
    lin->lu[24] = l_H_x__BDE_theta;
    lin->lu[25] = l_H_x__BDE_theta_2_i;
    const double u_BDE_theta__H_x = -l_BDE_theta__HE_theta*phi_H_x_HE_theta + phi_H_x_BDE_theta;
    const double u_BDE_theta__H_x_i = -l_BDE_theta__HE_theta_3_i*phi_H_x_HE_theta;
    lin->lu[26] = u_BDE_theta__H_x;
    lin->lu[27] = u_BDE_theta__H_x_i;
    const double factor_63 = -l_H_y__HE_theta*n_HE_theta__BDE_theta + l_H_y__HE_theta_3_i*n_HE_theta__BDE_theta_i
        + n_H_y__BDE_theta;
    const double factor_64 = -l_H_y__HE_theta*n_HE_theta__BDE_theta_i - l_H_y__HE_theta_3_i*n_HE_theta__BDE_theta
        + n_H_y__BDE_theta_i;
    const double l_H_y__BDE_theta = factor_63*inverse_pivot_BDE_theta - factor_64*inverse_pivot_BDE_theta_3_i;
    const double l_H_y__BDE_theta_2_i = factor_63*inverse_pivot_BDE_theta_3_i + factor_64*inverse_pivot_BDE_theta;
    lin->lu[28] = l_H_y__BDE_theta;
    lin->lu[29] = l_H_y__BDE_theta_2_i;
    const double u_BDE_theta__H_y = -l_BDE_theta__HE_theta*phi_H_y_HE_theta + phi_H_y_BDE_theta;
    const double u_BDE_theta__H_y_i = -l_BDE_theta__HE_theta_3_i*phi_H_y_HE_theta;
    lin->lu[30] = u_BDE_theta__H_y;
    lin->lu[31] = u_BDE_theta__H_y_i;
    const double l_E3_x__BDE_theta = inverse_pivot_BDE_theta*n_E3_x__BDE_theta
        - inverse_pivot_BDE_theta_3_i*n_E3_x__BDE_theta_i;
    const double l_E3_x__BDE_theta_3_i = inverse_pivot_BDE_theta*n_E3_x__BDE_theta_i
        + inverse_pivot_BDE_theta_3_i*n_E3_x__BDE_theta;
    lin->lu[32] = l_E3_x__BDE_theta;
    lin->lu[33] = l_E3_x__BDE_theta_3_i;
    const double l_E3_y__BDE_theta = inverse_pivot_BDE_theta*n_E3_y__BDE_theta
        - inverse_pivot_BDE_theta_3_i*n_E3_y__BDE_theta_i;
    const double l_E3_y__BDE_theta_3_i = inverse_pivot_BDE_theta*n_E3_y__BDE_theta_i
        + inverse_pivot_BDE_theta_3_i*n_E3_y__BDE_theta;
    lin->lu[34] = l_E3_y__BDE_theta;
    lin->lu[35] = l_E3_y__BDE_theta_3_i;
    const double scale_H_x = -l_H_x__AH_theta*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x
        + l_H_x__BDE_theta_2_i*u_BDE_theta__H_x_i - l_H_x__HE_theta*phi_H_x_HE_theta;
    const double scale_H_x_3_i = -l_H_x__AH_theta_3_i*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x_i
        - l_H_x__BDE_theta_2_i*u_BDE_theta__H_x - l_H_x__HE_theta_3_i*phi_H_x_HE_theta;
    const double size_9 = fabs(scale_H_x) + fabs(scale_H_x_3_i);
    if (!(size_9 > 0.0 && size_9 < INFINITY))
        return 10;
    const double divisor_8 = 1.0/((scale_H_x * scale_H_x) + (scale_H_x_3_i * scale_H_x_3_i));
    const double inverse_pivot_H_x = divisor_8*scale_H_x;
    const double inverse_pivot_H_x_3_i = -divisor_8*scale_H_x_3_i;
    lin->lu[36] = inverse_pivot_H_x;
    lin->lu[37] = inverse_pivot_H_x_3_i;
    const double factor_65 = -l_H_y__AH_theta*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x
        + l_H_y__BDE_theta_2_i*u_BDE_theta__H_x_i - l_H_y__HE_theta*phi_H_x_HE_theta;
    const double factor_66 = -l_H_y__AH_theta_3_i*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x_i
        - l_H_y__BDE_theta_2_i*u_BDE_theta__H_x - l_H_y__HE_theta_3_i*phi_H_x_HE_theta;
    const double l_H_y__H_x = factor_65*inverse_pivot_H_x - factor_66*inverse_pivot_H_x_3_i;
    const double l_H_y__H_x_i = factor_65*inverse_pivot_H_x_3_i + factor_66*inverse_pivot_H_x;
    lin->lu[38] = l_H_y__H_x;
    lin->lu[39] = l_H_y__H_x_i;
    const double u_H_x__H_y = -l_H_x__AH_theta*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y
        + l_H_x__BDE_theta_2_i*u_BDE_theta__H_y_i - l_H_x__HE_theta*phi_H_y_HE_theta;
    const double u_H_x__H_y_i = -l_H_x__AH_theta_3_i*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y_i
        - l_H_x__BDE_theta_2_i*u_BDE_theta__H_y - l_H_x__HE_theta_3_i*phi_H_y_HE_theta;
    lin->lu[40] = u_H_x__H_y;
    lin->lu[41] = u_H_x__H_y_i;
    const double factor_67 = inverse_pivot_H_x*l_E3_x__BDE_theta - inverse_pivot_H_x_3_i*l_E3_x__BDE_theta_3_i;
    const double factor_68 = inverse_pivot_H_x*l_E3_x__BDE_theta_3_i + inverse_pivot_H_x_3_i*l_E3_x__BDE_theta;
    const double l_E3_x__H_x = -factor_67*u_BDE_theta__H_x + factor_68*u_BDE_theta__H_x_i;
    const double l_E3_x__H_x_2_i = -factor_67*u_BDE_theta__H_x_i - factor_68*u_BDE_theta__H_x;
    lin->lu[42] = l_E3_x__H_x;
    lin->lu[43] = l_E3_x__H_x_2_i;
    const double u_H_x__E3_x = l_H_x__BDE_theta*phi_H_x_BDE_theta;
    const double u_H_x__E3_x_i = l_H_x__BDE_theta_2_i*phi_H_x_BDE_theta;
    lin->lu[44] = u_H_x__E3_x;
    lin->lu[45] = u_H_x__E3_x_i;
    const double factor_69 = inverse_pivot_H_x*l_E3_y__BDE_theta - inverse_pivot_H_x_3_i*l_E3_y__BDE_theta_3_i;
    const double factor_70 = inverse_pivot_H_x*l_E3_y__BDE_theta_3_i + inverse_pivot_H_x_3_i*l_E3_y__BDE_theta;
    const double l_E3_y__H_x = -factor_69*u_BDE_theta__H_x + factor_70*u_BDE_theta__H_x_i;
    const double l_E3_y__H_x_2_i = -factor_69*u_BDE_theta__H_x_i - factor_70*u_BDE_theta__H_x;
    lin->lu[46] = l_E3_y__H_x;
    lin->lu[47] = l_E3_y__H_x_2_i;
    const double u_H_x__E3_y = l_H_x__BDE_theta*phi_H_y_BDE_theta;
    const double u_H_x__E3_y_i = l_H_x__BDE_theta_2_i*phi_H_y_BDE_theta;
    lin->lu[48] = u_H_x__E3_y;
    lin->lu[49] = u_H_x__E3_y_i;
    const double scale_H_y = -l_H_y__AH_theta*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y
        + l_H_y__BDE_theta_2_i*u_BDE_theta__H_y_i - l_H_y__HE_theta*phi_H_y_HE_theta;
    const double scale_H_y_3_i = -l_H_y__AH_theta_3_i*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y_i
        - l_H_y__BDE_theta_2_i*u_BDE_theta__H_y - l_H_y__HE_theta_3_i*phi_H_y_HE_theta;
    const double pivot_H_y = -l_H_y__H_x*u_H_x__H_y + l_H_y__H_x_i*u_H_x__H_y_i + scale_H_y;
    const double pivot_H_y_i = -l_H_y__H_x*u_H_x__H_y_i - l_H_y__H_x_i*u_H_x__H_y + scale_H_y_3_i;
    const double size_10 = fabs(pivot_H_y) + fabs(pivot_H_y_i);
    const double size_11 = fabs(scale_H_y) + fabs(scale_H_y_3_i);
    if (!(size_10 > SINGULAR * size_11))
        return 11;
    const double divisor_9 = 1.0/((pivot_H_y * pivot_H_y) + (pivot_H_y_i * pivot_H_y_i));
    const double inverse_pivot_H_y = divisor_9*pivot_H_y;
    const double inverse_pivot_H_y_3_i = -divisor_9*pivot_H_y_i;
    lin->lu[50] = inverse_pivot_H_y;
    lin->lu[51] = inverse_pivot_H_y_3_i;
    const double factor_71 = -l_E3_x__BDE_theta*u_BDE_theta__H_y + l_E3_x__BDE_theta_3_i*u_BDE_theta__H_y_i
        - l_E3_x__H_x*u_H_x__H_y + l_E3_x__H_x_2_i*u_H_x__H_y_i;
    const double factor_72 = -l_E3_x__BDE_theta*u_BDE_theta__H_y_i - l_E3_x__BDE_theta_3_i*u_BDE_theta__H_y
        - l_E3_x__H_x*u_H_x__H_y_i - l_E3_x__H_x_2_i*u_H_x__H_y;
    const double l_E3_x__H_y = factor_71*inverse_pivot_H_y - factor_72*inverse_pivot_H_y_3_i;
    const double l_E3_x__H_y_2_i = factor_71*inverse_pivot_H_y_3_i + factor_72*inverse_pivot_H_y;
    lin->lu[52] = l_E3_x__H_y;
    lin->lu[53] = l_E3_x__H_y_2_i;
    const double u_H_y__E3_x = l_H_y__BDE_theta*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x + l_H_y__H_x_i*u_H_x__E3_x_i;
    const double u_H_y__E3_x_i = l_H_y__BDE_theta_2_i*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x_i
        - l_H_y__H_x_i*u_H_x__E3_x;
    lin->lu[54] = u_H_y__E3_x;
    lin->lu[55] = u_H_y__E3_x_i;
    const double factor_73 = -l_E3_y__BDE_theta*u_BDE_theta__H_y + l_E3_y__BDE_theta_3_i*u_BDE_theta__H_y_i
        - l_E3_y__H_x*u_H_x__H_y + l_E3_y__H_x_2_i*u_H_x__H_y_i;
    const double factor_74 = -l_E3_y__BDE_theta*u_BDE_theta__H_y_i - l_E3_y__BDE_theta_3_i*u_BDE_theta__H_y
        - l_E3_y__H_x*u_H_x__H_y_i - l_E3_y__H_x_2_i*u_H_x__H_y;
    const double l_E3_y__H_y = factor_73*inverse_pivot_H_y - factor_74*inverse_pivot_H_y_3_i;
    const double l_E3_y__H_y_2_i = factor_73*inverse_pivot_H_y_3_i + factor_74*inverse_pivot_H_y;
    lin->lu[56] = l_E3_y__H_y;
    lin->lu[57] = l_E3_y__H_y_2_i;
    const double u_H_y__E3_y = l_H_y__BDE_theta*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y + l_H_y__H_x_i*u_H_x__E3_y_i;
    const double u_H_y__E3_y_i = l_H_y__BDE_theta_2_i*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y_i
        - l_H_y__H_x_i*u_H_x__E3_y;
    lin->lu[58] = u_H_y__E3_y;
    lin->lu[59] = u_H_y__E3_y_i;
    const double scale_EG_theta = n_EG_theta__EG_theta;
    const double scale_EG_theta_i = n_EG_theta__EG_theta_i;
    const double size_12 = fabs(scale_EG_theta) + fabs(scale_EG_theta_i);
    const double size_13 = fabs(n_EG_theta__EG_theta) + fabs(n_EG_theta__EG_theta_i);
    if (!(size_12 > SINGULAR * size_13))
        return 7;
    const double divisor_10 = 1.0/((scale_EG_theta * scale_EG_theta) + (scale_EG_theta_i * scale_EG_theta_i));
    const double inverse_pivot_EG_theta = divisor_10*scale_EG_theta;
    const double inverse_pivot_EG_theta_i = -divisor_10*scale_EG_theta_i;
    lin->lu[60] = inverse_pivot_EG_theta;
    lin->lu[61] = inverse_pivot_EG_theta_i;
    const double l_OF_theta__EG_theta = inverse_pivot_EG_theta*n_OF_theta__EG_theta
        - inverse_pivot_EG_theta_i*n_OF_theta__EG_theta_i;
    const double l_OF_theta__EG_theta_3_i = inverse_pivot_EG_theta*n_OF_theta__EG_theta_i
        + inverse_pivot_EG_theta_i*n_OF_theta__EG_theta;
    lin->lu[62] = l_OF_theta__EG_theta;
    lin->lu[63] = l_OF_theta__EG_theta_3_i;
    lin->lu[64] = n_EG_theta__OF_theta;
    lin->lu[65] = n_EG_theta__OF_theta_i;
    const double l_FE_theta__EG_theta = inverse_pivot_EG_theta*n_FE_theta__EG_theta
        - inverse_pivot_EG_theta_i*n_FE_theta__EG_theta_i;
    const double l_FE_theta__EG_theta_3_i = inverse_pivot_EG_theta*n_FE_theta__EG_theta_i
        + inverse_pivot_EG_theta_i*n_FE_theta__EG_theta;
    lin->lu[66] = l_FE_theta__EG_theta;
    lin->lu[67] = l_FE_theta__EG_theta_3_i;
    lin->lu[68] = n_EG_theta__FE_theta;
    lin->lu[69] = n_EG_theta__FE_theta_i;
    const double l_G_x__EG_theta = inverse_pivot_EG_theta*n_G_x__EG_theta - inverse_pivot_EG_theta_i*n_G_x__EG_theta_i;
    const double l_G_x__EG_theta_3_i = inverse_pivot_EG_theta*n_G_x__EG_theta_i
        + inverse_pivot_EG_theta_i*n_G_x__EG_theta;
    lin->lu[70] = l_G_x__EG_theta;
    lin->lu[71] = l_G_x__EG_theta_3_i;
    const double l_G_y__EG_theta = inverse_pivot_EG_theta*n_G_y__EG_theta - inverse_pivot_EG_theta_i*n_G_y__EG_theta_i;
    const double l_G_y__EG_theta_3_i = inverse_pivot_EG_theta*n_G_y__EG_theta_i
        + inverse_pivot_EG_theta_i*n_G_y__EG_theta;
    lin->lu[72] = l_G_y__EG_theta;
    lin->lu[73] = l_G_y__EG_theta_3_i;
    const double scale_OF_theta = -l_OF_theta__EG_theta*n_EG_theta__OF_theta
        + l_OF_theta__EG_theta_3_i*n_EG_theta__OF_theta_i + n_OF_theta__OF_theta;
    const double scale_OF_theta_i = -l_OF_theta__EG_theta*n_EG_theta__OF_theta_i
        - l_OF_theta__EG_theta_3_i*n_EG_theta__OF_theta + n_OF_theta__OF_theta_i;
    const double size_14 = fabs(scale_OF_theta) + fabs(scale_OF_theta_i);
    const double size_15 = fabs(n_OF_theta__OF_theta) + fabs(n_OF_theta__OF_theta_i);
    if (!(size_14 > SINGULAR * size_15))
        return 1;
    const double divisor_11 = 1.0/((scale_OF_theta * scale_OF_theta) + (scale_OF_theta_i * scale_OF_theta_i));
    const double inverse_pivot_OF_theta = divisor_11*scale_OF_theta;
    const double inverse_pivot_OF_theta_3_i = -divisor_11*scale_OF_theta_i;
    lin->lu[74] = inverse_pivot_OF_theta;
    lin->lu[75] = inverse_pivot_OF_theta_3_i;
    const double factor_75 = -l_FE_theta__EG_theta*n_EG_theta__OF_theta
        + l_FE_theta__EG_theta_3_i*n_EG_theta__OF_theta_i + n_FE_theta__OF_theta;
    const double factor_76 = -l_FE_theta__EG_theta*n_EG_theta__OF_theta_i
        - l_FE_theta__EG_theta_3_i*n_EG_theta__OF_theta + n_FE_theta__OF_theta_i;
    const double l_FE_theta__OF_theta = factor_75*inverse_pivot_OF_theta - factor_76*inverse_pivot_OF_theta_3_i;
    const double l_FE_theta__OF_theta_i = factor_75*inverse_pivot_OF_theta_3_i + factor_76*inverse_pivot_OF_theta;
    lin->lu[76] = l_FE_theta__OF_theta;
    lin->lu[77] = l_FE_theta__OF_theta_i;
    const double u_OF_theta__FE_theta = -l_OF_theta__EG_theta*n_EG_theta__FE_theta
        + l_OF_theta__EG_theta_3_i*n_EG_theta__FE_theta_i + n_OF_theta__FE_theta;
    const double u_OF_theta__FE_theta_i = -l_OF_theta__EG_theta*n_EG_theta__FE_theta_i
        - l_OF_theta__EG_theta_3_i*n_EG_theta__FE_theta + n_OF_theta__FE_theta_i;
    lin->lu[78] = u_OF_theta__FE_theta;
    lin->lu[79] = u_OF_theta__FE_theta_i;
    const double factor_77 = -l_G_x__EG_theta*n_EG_theta__OF_theta + l_G_x__EG_theta_3_i*n_EG_theta__OF_theta_i
        + n_G_x__OF_theta;
    const double factor_78 = -l_G_x__EG_theta*n_EG_theta__OF_theta_i - l_G_x__EG_theta_3_i*n_EG_theta__OF_theta
        + n_G_x__OF_theta_i;
    const double l_G_x__OF_theta = factor_77*inverse_pivot_OF_theta - factor_78*inverse_pivot_OF_theta_3_i;
    const double l_G_x__OF_theta_2_i = factor_77*inverse_pivot_OF_theta_3_i + factor_78*inverse_pivot_OF_theta;
    lin->lu[80] = l_G_x__OF_theta;
    lin->lu[81] = l_G_x__OF_theta_2_i;
    const double u_OF_theta__G_x = -l_OF_theta__EG_theta*phi_G_x_EG_theta + phi_G_x_OF_theta;
    const double u_OF_theta__G_x_i = -l_OF_theta__EG_theta_3_i*phi_G_x_EG_theta;
    lin->lu[82] = u_OF_theta__G_x;
    lin->lu[83] = u_OF_theta__G_x_i;
    const double factor_79 = -l_G_y__EG_theta*n_EG_theta__OF_theta + l_G_y__EG_theta_3_i*n_EG_theta__OF_theta_i
        + n_G_y__OF_theta;
    const double factor_80 = -l_G_y__EG_theta*n_EG_theta__OF_theta_i - l_G_y__EG_theta_3_i*n_EG_theta__OF_theta
        + n_G_y__OF_theta_i;
    const double l_G_y__OF_theta = factor_79*inverse_pivot_OF_theta - factor_80*inverse_pivot_OF_theta_3_i;
    const double l_G_y__OF_theta_2_i = factor_79*inverse_pivot_OF_theta_3_i + factor_80*inverse_pivot_OF_theta;
    lin->lu[84] = l_G_y__OF_theta;
    lin->lu[85] = l_G_y__OF_theta_2_i;
    const double u_OF_theta__G_y = -l_OF_theta__EG_theta*phi_G_y_EG_theta + phi_G_y_OF_theta;
    const double u_OF_theta__G_y_i = -l_OF_theta__EG_theta_3_i*phi_G_y_EG_theta;
    lin->lu[86] = u_OF_theta__G_y;
    lin->lu[87] = u_OF_theta__G_y_i;
    const double l_E3_x__OF_theta = inverse_pivot_OF_theta*n_E3_x__OF_theta
        - inverse_pivot_OF_theta_3_i*n_E3_x__OF_theta_i;
    const double l_E3_x__OF_theta_3_i = inverse_pivot_OF_theta*n_E3_x__OF_theta_i
        + inverse_pivot_OF_theta_3_i*n_E3_x__OF_theta;
    lin->lu[88] = l_E3_x__OF_theta;
    lin->lu[89] = l_E3_x__OF_theta_3_i;
    const double l_E3_y__OF_theta = inverse_pivot_OF_theta*n_E3_y__OF_theta
        - inverse_pivot_OF_theta_3_i*n_E3_y__OF_theta_i;
    const double l_E3_y__OF_theta_3_i = inverse_pivot_OF_theta*n_E3_y__OF_theta_i
        + inverse_pivot_OF_theta_3_i*n_E3_y__OF_theta;
    lin->lu[90] = l_E3_y__OF_theta;
    lin->lu[91] = l_E3_y__OF_theta_3_i;
    const double scale_FE_theta = -l_FE_theta__EG_theta*n_EG_theta__FE_theta
        + l_FE_theta__EG_theta_3_i*n_EG_theta__FE_theta_i - l_FE_theta__OF_theta*u_OF_theta__FE_theta
        + l_FE_theta__OF_theta_i*u_OF_theta__FE_theta_i + n_FE_theta__FE_theta;
    const double scale_FE_theta_i = -l_FE_theta__EG_theta*n_EG_theta__FE_theta_i
        - l_FE_theta__EG_theta_3_i*n_EG_theta__FE_theta - l_FE_theta__OF_theta*u_OF_theta__FE_theta_i
        - l_FE_theta__OF_theta_i*u_OF_theta__FE_theta + n_FE_theta__FE_theta_i;
    const double size_16 = fabs(scale_FE_theta) + fabs(scale_FE_theta_i);
    const double size_17 = fabs(n_FE_theta__FE_theta) + fabs(n_FE_theta__FE_theta_i);
    if (!(size_16 > SINGULAR * size_17))
        return 5;
    const double divisor_12 = 1.0/((scale_FE_theta * scale_FE_theta) + (scale_FE_theta_i * scale_FE_theta_i));
    const double inverse_pivot_FE_theta = divisor_12*scale_FE_theta;
    const double inverse_pivot_FE_theta_3_i = -divisor_12*scale_FE_theta_i;
    lin->lu[92] = inverse_pivot_FE_theta;
    lin->lu[93] = inverse_pivot_FE_theta_3_i;
    const double factor_81 = -l_G_x__EG_theta*n_EG_theta__FE_theta + l_G_x__EG_theta_3_i*n_EG_theta__FE_theta_i
        - l_G_x__OF_theta*u_OF_theta__FE_theta + l_G_x__OF_theta_2_i*u_OF_theta__FE_theta_i + n_G_x__FE_theta;
    const double factor_82 = -l_G_x__EG_theta*n_EG_theta__FE_theta_i - l_G_x__EG_theta_3_i*n_EG_theta__FE_theta
        - l_G_x__OF_theta*u_OF_theta__FE_theta_i - l_G_x__OF_theta_2_i*u_OF_theta__FE_theta + n_G_x__FE_theta_i;
    const double l_G_x__FE_theta = factor_81*inverse_pivot_FE_theta - factor_82*inverse_pivot_FE_theta_3_i;
    const double l_G_x__FE_theta_2_i = factor_81*inverse_pivot_FE_theta_3_i + factor_82*inverse_pivot_FE_theta;
    lin->lu[94] = l_G_x__FE_theta;
    lin->lu[95] = l_G_x__FE_theta_2_i;
    const double u_FE_theta__G_x = -l_FE_theta__EG_theta*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x
        + l_FE_theta__OF_theta_i*u_OF_theta__G_x_i + phi_G_x_FE_theta;
    const double u_FE_theta__G_x_i = -l_FE_theta__EG_theta_3_i*phi_G_x_EG_theta
        - l_FE_theta__OF_theta*u_OF_theta__G_x_i - l_FE_theta__OF_theta_i*u_OF_theta__G_x;
    lin->lu[96] = u_FE_theta__G_x;
    lin->lu[97] = u_FE_theta__G_x_i;
    const double factor_83 = -l_G_y__EG_theta*n_EG_theta__FE_theta + l_G_y__EG_theta_3_i*n_EG_theta__FE_theta_i
        - l_G_y__OF_theta*u_OF_theta__FE_theta + l_G_y__OF_theta_2_i*u_OF_theta__FE_theta_i + n_G_y__FE_theta;
    const double factor_84 = -l_G_y__EG_theta*n_EG_theta__FE_theta_i - l_G_y__EG_theta_3_i*n_EG_theta__FE_theta
        - l_G_y__OF_theta*u_OF_theta__FE_theta_i - l_G_y__OF_theta_2_i*u_OF_theta__FE_theta + n_G_y__FE_theta_i;
    const double l_G_y__FE_theta = factor_83*inverse_pivot_FE_theta - factor_84*inverse_pivot_FE_theta_3_i;
    const double l_G_y__FE_theta_2_i = factor_83*inverse_pivot_FE_theta_3_i + factor_84*inverse_pivot_FE_theta;
    lin->lu[98] = l_G_y__FE_theta;
    lin->lu[99] = l_G_y__FE_theta_2_i;
    const double u_FE_theta__G_y = -l_FE_theta__EG_theta*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y
        + l_FE_theta__OF_theta_i*u_OF_theta__G_y_i + phi_G_y_FE_theta;
    const double u_FE_theta__G_y_i = -l_FE_theta__EG_theta_3_i*phi_G_y_EG_theta
        - l_FE_theta__OF_theta*u_OF_theta__G_y_i - l_FE_theta__OF_theta_i*u_OF_theta__G_y;
    lin->lu[100] = u_FE_theta__G_y;
    lin->lu[101] = u_FE_theta__G_y_i;
    const double factor_85 = -l_E3_x__OF_theta*u_OF_theta__FE_theta + l_E3_x__OF_theta_3_i*u_OF_theta__FE_theta_i
        + n_E3_x__FE_theta;
    const double factor_86 = -l_E3_x__OF_theta*u_OF_theta__FE_theta_i - l_E3_x__OF_theta_3_i*u_OF_theta__FE_theta
        + n_E3_x__FE_theta_i;
    const double l_E3_x__FE_theta = factor_85*inverse_pivot_FE_theta - factor_86*inverse_pivot_FE_theta_3_i;
    const double l_E3_x__FE_theta_3_i = factor_85*inverse_pivot_FE_theta_3_i + factor_86*inverse_pivot_FE_theta;
    lin->lu[102] = l_E3_x__FE_theta;
    lin->lu[103] = l_E3_x__FE_theta_3_i;
    const double u_FE_theta__E3_x = -l_FE_theta__OF_theta*phi_G_x_OF_theta + phi_G_x_FE_theta;
    const double u_FE_theta__E3_x_i = -l_FE_theta__OF_theta_i*phi_G_x_OF_theta;
    lin->lu[104] = u_FE_theta__E3_x;
    lin->lu[105] = u_FE_theta__E3_x_i;
    const double factor_87 = -l_E3_y__OF_theta*u_OF_theta__FE_theta + l_E3_y__OF_theta_3_i*u_OF_theta__FE_theta_i
        + n_E3_y__FE_theta;
    const double factor_88 = -l_E3_y__OF_theta*u_OF_theta__FE_theta_i - l_E3_y__OF_theta_3_i*u_OF_theta__FE_theta
        + n_E3_y__FE_theta_i;
    const double l_E3_y__FE_theta = factor_87*inverse_pivot_FE_theta - factor_88*inverse_pivot_FE_theta_3_i;
    const double l_E3_y__FE_theta_3_i = factor_87*inverse_pivot_FE_theta_3_i + factor_88*inverse_pivot_FE_theta;
    lin->lu[106] = l_E3_y__FE_theta;
    lin->lu[107] = l_E3_y__FE_theta_3_i;
    const double u_FE_theta__E3_y = -l_FE_theta__OF_theta*phi_G_y_OF_theta + phi_G_y_FE_theta;
    const double u_FE_theta__E3_y_i = -l_FE_theta__OF_theta_i*phi_G_y_OF_theta;
    lin->lu[108] = u_FE_theta__E3_y;
    lin->lu[109] = u_FE_theta__E3_y_i;
    const double scale_G_x = -l_G_x__AG_theta*phi_G_x_AG_theta - l_G_x__EG_theta*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x + l_G_x__FE_theta_2_i*u_FE_theta__G_x_i - l_G_x__OF_theta*u_OF_theta__G_x
        + l_G_x__OF_theta_2_i*u_OF_theta__G_x_i;
    const double scale_G_x_3_i = -l_G_x__AG_theta_3_i*phi_G_x_AG_theta - l_G_x__EG_theta_3_i*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x_i - l_G_x__FE_theta_2_i*u_FE_theta__G_x - l_G_x__OF_theta*u_OF_theta__G_x_i
        - l_G_x__OF_theta_2_i*u_OF_theta__G_x;
    const double size_18 = fabs(scale_G_x) + fabs(scale_G_x_3_i);
    if (!(size_18 > 0.0 && size_18 < INFINITY))
        return 8;
    const double divisor_13 = 1.0/((scale_G_x * scale_G_x) + (scale_G_x_3_i * scale_G_x_3_i));
    const double inverse_pivot_G_x = divisor_13*scale_G_x;
    const double inverse_pivot_G_x_3_i = -divisor_13*scale_G_x_3_i;
    lin->lu[110] = inverse_pivot_G_x;
    lin->lu[111] = inverse_pivot_G_x_3_i;
    const double factor_89 = -l_G_y__AG_theta*phi_G_x_AG_theta - l_G_y__EG_theta*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x + l_G_y__FE_theta_2_i*u_FE_theta__G_x_i - l_G_y__OF_theta*u_OF_theta__G_x
        + l_G_y__OF_theta_2_i*u_OF_theta__G_x_i;
    const double factor_90 = -l_G_y__AG_theta_3_i*phi_G_x_AG_theta - l_G_y__EG_theta_3_i*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x_i - l_G_y__FE_theta_2_i*u_FE_theta__G_x - l_G_y__OF_theta*u_OF_theta__G_x_i
        - l_G_y__OF_theta_2_i*u_OF_theta__G_x;
    const double l_G_y__G_x = factor_89*inverse_pivot_G_x - factor_90*inverse_pivot_G_x_3_i;
    const double l_G_y__G_x_i = factor_89*inverse_pivot_G_x_3_i + factor_90*inverse_pivot_G_x;
    lin->lu[112] = l_G_y__G_x;
    lin->lu[113] = l_G_y__G_x_i;
    const double u_G_x__G_y = -l_G_x__AG_theta*phi_G_y_AG_theta - l_G_x__EG_theta*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y + l_G_x__FE_theta_2_i*u_FE_theta__G_y_i - l_G_x__OF_theta*u_OF_theta__G_y
        + l_G_x__OF_theta_2_i*u_OF_theta__G_y_i;
    const double u_G_x__G_y_i = -l_G_x__AG_theta_3_i*phi_G_y_AG_theta - l_G_x__EG_theta_3_i*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y_i - l_G_x__FE_theta_2_i*u_FE_theta__G_y - l_G_x__OF_theta*u_OF_theta__G_y_i
        - l_G_x__OF_theta_2_i*u_OF_theta__G_y;
    lin->lu[114] = u_G_x__G_y;
    lin->lu[115] = u_G_x__G_y_i;
    const double factor_91 = -l_E3_x__FE_theta*u_FE_theta__G_x + l_E3_x__FE_theta_3_i*u_FE_theta__G_x_i
        - l_E3_x__OF_theta*u_OF_theta__G_x + l_E3_x__OF_theta_3_i*u_OF_theta__G_x_i;
    const double factor_92 = -l_E3_x__FE_theta*u_FE_theta__G_x_i - l_E3_x__FE_theta_3_i*u_FE_theta__G_x
        - l_E3_x__OF_theta*u_OF_theta__G_x_i - l_E3_x__OF_theta_3_i*u_OF_theta__G_x;
    const double l_E3_x__G_x = factor_91*inverse_pivot_G_x - factor_92*inverse_pivot_G_x_3_i;
    const double l_E3_x__G_x_2_i = factor_91*inverse_pivot_G_x_3_i + factor_92*inverse_pivot_G_x;
    lin->lu[116] = l_E3_x__G_x;
    lin->lu[117] = l_E3_x__G_x_2_i;
    const double u_G_x__E3_x = -l_G_x__FE_theta*u_FE_theta__E3_x + l_G_x__FE_theta_2_i*u_FE_theta__E3_x_i
        - l_G_x__OF_theta*phi_G_x_OF_theta;
    const double u_G_x__E3_x_i = -l_G_x__FE_theta*u_FE_theta__E3_x_i - l_G_x__FE_theta_2_i*u_FE_theta__E3_x
        - l_G_x__OF_theta_2_i*phi_G_x_OF_theta;
    lin->lu[118] = u_G_x__E3_x;
    lin->lu[119] = u_G_x__E3_x_i;
    const double factor_93 = -l_E3_y__FE_theta*u_FE_theta__G_x + l_E3_y__FE_theta_3_i*u_FE_theta__G_x_i
        - l_E3_y__OF_theta*u_OF_theta__G_x + l_E3_y__OF_theta_3_i*u_OF_theta__G_x_i;
    const double factor_94 = -l_E3_y__FE_theta*u_FE_theta__G_x_i - l_E3_y__FE_theta_3_i*u_FE_theta__G_x
        - l_E3_y__OF_theta*u_OF_theta__G_x_i - l_E3_y__OF_theta_3_i*u_OF_theta__G_x;
    const double l_E3_y__G_x = factor_93*inverse_pivot_G_x - factor_94*inverse_pivot_G_x_3_i;
    const double l_E3_y__G_x_2_i = factor_93*inverse_pivot_G_x_3_i + factor_94*inverse_pivot_G_x;
    lin->lu[120] = l_E3_y__G_x;
    lin->lu[121] = l_E3_y__G_x_2_i;
    const double u_G_x__E3_y = -l_G_x__FE_theta*u_FE_theta__E3_y + l_G_x__FE_theta_2_i*u_FE_theta__E3_y_i
        - l_G_x__OF_theta*phi_G_y_OF_theta;
    const double u_G_x__E3_y_i = -l_G_x__FE_theta*u_FE_theta__E3_y_i - l_G_x__FE_theta_2_i*u_FE_theta__E3_y
        - l_G_x__OF_theta_2_i*phi_G_y_OF_theta;
    lin->lu[122] = u_G_x__E3_y;
    lin->lu[123] = u_G_x__E3_y_i;
    const double scale_G_y = -l_G_y__AG_theta*phi_G_y_AG_theta - l_G_y__EG_theta*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y + l_G_y__FE_theta_2_i*u_FE_theta__G_y_i - l_G_y__OF_theta*u_OF_theta__G_y
        + l_G_y__OF_theta_2_i*u_OF_theta__G_y_i;
    const double scale_G_y_3_i = -l_G_y__AG_theta_3_i*phi_G_y_AG_theta - l_G_y__EG_theta_3_i*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y_i - l_G_y__FE_theta_2_i*u_FE_theta__G_y - l_G_y__OF_theta*u_OF_theta__G_y_i
        - l_G_y__OF_theta_2_i*u_OF_theta__G_y;
    const double pivot_G_y = -l_G_y__G_x*u_G_x__G_y + l_G_y__G_x_i*u_G_x__G_y_i + scale_G_y;
    const double pivot_G_y_i = -l_G_y__G_x*u_G_x__G_y_i - l_G_y__G_x_i*u_G_x__G_y + scale_G_y_3_i;
    const double size_19 = fabs(pivot_G_y) + fabs(pivot_G_y_i);
    const double size_20 = fabs(scale_G_y) + fabs(scale_G_y_3_i);
    if (!(size_19 > SINGULAR * size_20))
        return 9;
    const double divisor_14 = 1.0/((pivot_G_y * pivot_G_y) + (pivot_G_y_i * pivot_G_y_i));
    const double inverse_pivot_G_y = divisor_14*pivot_G_y;
    const double inverse_pivot_G_y_3_i = -divisor_14*pivot_G_y_i;
    lin->lu[124] = inverse_pivot_G_y;
    lin->lu[125] = inverse_pivot_G_y_3_i;
    const double factor_95 = -l_E3_x__FE_theta*u_FE_theta__G_y + l_E3_x__FE_theta_3_i*u_FE_theta__G_y_i
        - l_E3_x__G_x*u_G_x__G_y + l_E3_x__G_x_2_i*u_G_x__G_y_i - l_E3_x__OF_theta*u_OF_theta__G_y
        + l_E3_x__OF_theta_3_i*u_OF_theta__G_y_i;
    const double factor_96 = -l_E3_x__FE_theta*u_FE_theta__G_y_i - l_E3_x__FE_theta_3_i*u_FE_theta__G_y
        - l_E3_x__G_x*u_G_x__G_y_i - l_E3_x__G_x_2_i*u_G_x__G_y - l_E3_x__OF_theta*u_OF_theta__G_y_i
        - l_E3_x__OF_theta_3_i*u_OF_theta__G_y;
    const double l_E3_x__G_y = factor_95*inverse_pivot_G_y - factor_96*inverse_pivot_G_y_3_i;
    const double l_E3_x__G_y_2_i = factor_95*inverse_pivot_G_y_3_i + factor_96*inverse_pivot_G_y;
    lin->lu[126] = l_E3_x__G_y;
    lin->lu[127] = l_E3_x__G_y_2_i;
    const double u_G_y__E3_x = -l_G_y__FE_theta*u_FE_theta__E3_x + l_G_y__FE_theta_2_i*u_FE_theta__E3_x_i
        - l_G_y__G_x*u_G_x__E3_x + l_G_y__G_x_i*u_G_x__E3_x_i - l_G_y__OF_theta*phi_G_x_OF_theta;
    const double u_G_y__E3_x_i = -l_G_y__FE_theta*u_FE_theta__E3_x_i - l_G_y__FE_theta_2_i*u_FE_theta__E3_x
        - l_G_y__G_x*u_G_x__E3_x_i - l_G_y__G_x_i*u_G_x__E3_x - l_G_y__OF_theta_2_i*phi_G_x_OF_theta;
    lin->lu[128] = u_G_y__E3_x;
    lin->lu[129] = u_G_y__E3_x_i;
    const double factor_97 = -l_E3_y__FE_theta*u_FE_theta__G_y + l_E3_y__FE_theta_3_i*u_FE_theta__G_y_i
        - l_E3_y__G_x*u_G_x__G_y + l_E3_y__G_x_2_i*u_G_x__G_y_i - l_E3_y__OF_theta*u_OF_theta__G_y
        + l_E3_y__OF_theta_3_i*u_OF_theta__G_y_i;
    const double factor_98 = -l_E3_y__FE_theta*u_FE_theta__G_y_i - l_E3_y__FE_theta_3_i*u_FE_theta__G_y
        - l_E3_y__G_x*u_G_x__G_y_i - l_E3_y__G_x_2_i*u_G_x__G_y - l_E3_y__OF_theta*u_OF_theta__G_y_i
        - l_E3_y__OF_theta_3_i*u_OF_theta__G_y;
    const double l_E3_y__G_y = factor_97*inverse_pivot_G_y - factor_98*inverse_pivot_G_y_3_i;
    const double l_E3_y__G_y_2_i = factor_97*inverse_pivot_G_y_3_i + factor_98*inverse_pivot_G_y;
    lin->lu[130] = l_E3_y__G_y;
    lin->lu[131] = l_E3_y__G_y_2_i;
    const double u_G_y__E3_y = -l_G_y__FE_theta*u_FE_theta__E3_y + l_G_y__FE_theta_2_i*u_FE_theta__E3_y_i
        - l_G_y__G_x*u_G_x__E3_y + l_G_y__G_x_i*u_G_x__E3_y_i - l_G_y__OF_theta*phi_G_y_OF_theta;
    const double u_G_y__E3_y_i = -l_G_y__FE_theta*u_FE_theta__E3_y_i - l_G_y__FE_theta_2_i*u_FE_theta__E3_y
        - l_G_y__G_x*u_G_x__E3_y_i - l_G_y__G_x_i*u_G_x__E3_y - l_G_y__OF_theta_2_i*phi_G_y_OF_theta;
    lin->lu[132] = u_G_y__E3_y;
    lin->lu[133] = u_G_y__E3_y_i;
    const double scale_E3_x = l_E3_x__BDE_theta*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x
        + l_E3_x__FE_theta_3_i*u_FE_theta__E3_x_i - l_E3_x__OF_theta*phi_G_x_OF_theta;
    const double scale_E3_x_3_i = l_E3_x__BDE_theta_3_i*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x_i
        - l_E3_x__FE_theta_3_i*u_FE_theta__E3_x - l_E3_x__OF_theta_3_i*phi_G_x_OF_theta;
    const double pivot_E3_x = -l_E3_x__G_x*u_G_x__E3_x + l_E3_x__G_x_2_i*u_G_x__E3_x_i - l_E3_x__G_y*u_G_y__E3_x
        + l_E3_x__G_y_2_i*u_G_y__E3_x_i - l_E3_x__H_x*u_H_x__E3_x + l_E3_x__H_x_2_i*u_H_x__E3_x_i
        - l_E3_x__H_y*u_H_y__E3_x + l_E3_x__H_y_2_i*u_H_y__E3_x_i + scale_E3_x;
    const double pivot_E3_x_2_i = -l_E3_x__G_x*u_G_x__E3_x_i - l_E3_x__G_x_2_i*u_G_x__E3_x - l_E3_x__G_y*u_G_y__E3_x_i
        - l_E3_x__G_y_2_i*u_G_y__E3_x - l_E3_x__H_x*u_H_x__E3_x_i - l_E3_x__H_x_2_i*u_H_x__E3_x
        - l_E3_x__H_y*u_H_y__E3_x_i - l_E3_x__H_y_2_i*u_H_y__E3_x + scale_E3_x_3_i;
    const double size_21 = fabs(pivot_E3_x) + fabs(pivot_E3_x_2_i);
    const double size_22 = fabs(scale_E3_x) + fabs(scale_E3_x_3_i);
    if (!(size_21 > SINGULAR * size_22))
        return 12;
    const double divisor_15 = 1.0/((pivot_E3_x * pivot_E3_x) + (pivot_E3_x_2_i * pivot_E3_x_2_i));
    const double inverse_pivot_E3_x = divisor_15*pivot_E3_x;
    const double inverse_pivot_E3_x_3_i = -divisor_15*pivot_E3_x_2_i;
    lin->lu[134] = inverse_pivot_E3_x;
    lin->lu[135] = inverse_pivot_E3_x_3_i;
    const double factor_99 = l_E3_y__BDE_theta*phi_H_x_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_x
        + l_E3_y__FE_theta_3_i*u_FE_theta__E3_x_i - l_E3_y__G_x*u_G_x__E3_x + l_E3_y__G_x_2_i*u_G_x__E3_x_i
        - l_E3_y__G_y*u_G_y__E3_x + l_E3_y__G_y_2_i*u_G_y__E3_x_i - l_E3_y__H_x*u_H_x__E3_x
        + l_E3_y__H_x_2_i*u_H_x__E3_x_i - l_E3_y__H_y*u_H_y__E3_x + l_E3_y__H_y_2_i*u_H_y__E3_x_i
        - l_E3_y__OF_theta*phi_G_x_OF_theta;
    const double factor_100 = l_E3_y__BDE_theta_3_i*phi_H_x_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_x_i
        - l_E3_y__FE_theta_3_i*u_FE_theta__E3_x - l_E3_y__G_x*u_G_x__E3_x_i - l_E3_y__G_x_2_i*u_G_x__E3_x
        - l_E3_y__G_y*u_G_y__E3_x_i - l_E3_y__G_y_2_i*u_G_y__E3_x - l_E3_y__H_x*u_H_x__E3_x_i
        - l_E3_y__H_x_2_i*u_H_x__E3_x - l_E3_y__H_y*u_H_y__E3_x_i - l_E3_y__H_y_2_i*u_H_y__E3_x
        - l_E3_y__OF_theta_3_i*phi_G_x_OF_theta;
    const double l_E3_y__E3_x = -factor_100*inverse_pivot_E3_x_3_i + factor_99*inverse_pivot_E3_x;
    const double l_E3_y__E3_x_i = factor_100*inverse_pivot_E3_x + factor_99*inverse_pivot_E3_x_3_i;
    lin->lu[136] = l_E3_y__E3_x;
    lin->lu[137] = l_E3_y__E3_x_i;
    const double u_E3_x__E3_y = l_E3_x__BDE_theta*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y
        + l_E3_x__FE_theta_3_i*u_FE_theta__E3_y_i - l_E3_x__G_x*u_G_x__E3_y + l_E3_x__G_x_2_i*u_G_x__E3_y_i
        - l_E3_x__G_y*u_G_y__E3_y + l_E3_x__G_y_2_i*u_G_y__E3_y_i - l_E3_x__H_x*u_H_x__E3_y
        + l_E3_x__H_x_2_i*u_H_x__E3_y_i - l_E3_x__H_y*u_H_y__E3_y + l_E3_x__H_y_2_i*u_H_y__E3_y_i
        - l_E3_x__OF_theta*phi_G_y_OF_theta;
    const double u_E3_x__E3_y_i = l_E3_x__BDE_theta_3_i*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y_i
        - l_E3_x__FE_theta_3_i*u_FE_theta__E3_y - l_E3_x__G_x*u_G_x__E3_y_i - l_E3_x__G_x_2_i*u_G_x__E3_y
        - l_E3_x__G_y*u_G_y__E3_y_i - l_E3_x__G_y_2_i*u_G_y__E3_y - l_E3_x__H_x*u_H_x__E3_y_i
        - l_E3_x__H_x_2_i*u_H_x__E3_y - l_E3_x__H_y*u_H_y__E3_y_i - l_E3_x__H_y_2_i*u_H_y__E3_y
        - l_E3_x__OF_theta_3_i*phi_G_y_OF_theta;
    lin->lu[138] = u_E3_x__E3_y;
    lin->lu[139] = u_E3_x__E3_y_i;
    const double scale_E3_y = l_E3_y__BDE_theta*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y
        + l_E3_y__FE_theta_3_i*u_FE_theta__E3_y_i - l_E3_y__OF_theta*phi_G_y_OF_theta;
    const double scale_E3_y_3_i = l_E3_y__BDE_theta_3_i*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y_i
        - l_E3_y__FE_theta_3_i*u_FE_theta__E3_y - l_E3_y__OF_theta_3_i*phi_G_y_OF_theta;
    const double pivot_E3_y = -l_E3_y__E3_x*u_E3_x__E3_y + l_E3_y__E3_x_i*u_E3_x__E3_y_i - l_E3_y__G_x*u_G_x__E3_y
        + l_E3_y__G_x_2_i*u_G_x__E3_y_i - l_E3_y__G_y*u_G_y__E3_y + l_E3_y__G_y_2_i*u_G_y__E3_y_i
        - l_E3_y__H_x*u_H_x__E3_y + l_E3_y__H_x_2_i*u_H_x__E3_y_i - l_E3_y__H_y*u_H_y__E3_y
        + l_E3_y__H_y_2_i*u_H_y__E3_y_i + scale_E3_y;
    const double pivot_E3_y_2_i = -l_E3_y__E3_x*u_E3_x__E3_y_i - l_E3_y__E3_x_i*u_E3_x__E3_y
        - l_E3_y__G_x*u_G_x__E3_y_i - l_E3_y__G_x_2_i*u_G_x__E3_y - l_E3_y__G_y*u_G_y__E3_y_i
        - l_E3_y__G_y_2_i*u_G_y__E3_y - l_E3_y__H_x*u_H_x__E3_y_i - l_E3_y__H_x_2_i*u_H_x__E3_y
        - l_E3_y__H_y*u_H_y__E3_y_i - l_E3_y__H_y_2_i*u_H_y__E3_y + scale_E3_y_3_i;
    const double size_23 = fabs(pivot_E3_y) + fabs(pivot_E3_y_2_i);
    const double size_24 = fabs(scale_E3_y) + fabs(scale_E3_y_3_i);
    if (!(size_23 > SINGULAR * size_24))
        return 13;
    const double divisor_16 = 1.0/((pivot_E3_y * pivot_E3_y) + (pivot_E3_y_2_i * pivot_E3_y_2_i));
    const double inverse_pivot_E3_y = divisor_16*pivot_E3_y;
    const double inverse_pivot_E3_y_3_i = -divisor_16*pivot_E3_y_2_i;
    lin->lu[140] = inverse_pivot_E3_y;
    lin->lu[141] = inverse_pivot_E3_y_3_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
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
    const double inverse_pivot_AG_theta_i = lin->lu[1];
    const double l_G_x__AG_theta = lin->lu[2];
    const double l_G_x__AG_theta_3_i = lin->lu[3];
    const double l_G_y__AG_theta = lin->lu[4];
    const double l_G_y__AG_theta_3_i = lin->lu[5];
    const double inverse_pivot_AH_theta = lin->lu[6];
    const double inverse_pivot_AH_theta_i = lin->lu[7];
    const double l_H_x__AH_theta = lin->lu[8];
    const double l_H_x__AH_theta_3_i = lin->lu[9];
    const double l_H_y__AH_theta = lin->lu[10];
    const double l_H_y__AH_theta_3_i = lin->lu[11];
    const double inverse_pivot_HE_theta = lin->lu[12];
    const double inverse_pivot_HE_theta_i = lin->lu[13];
    const double l_BDE_theta__HE_theta = lin->lu[14];
    const double l_BDE_theta__HE_theta_3_i = lin->lu[15];
    const double n_HE_theta__BDE_theta = lin->lu[16];
    const double n_HE_theta__BDE_theta_i = lin->lu[17];
    const double l_H_x__HE_theta = lin->lu[18];
    const double l_H_x__HE_theta_3_i = lin->lu[19];
    const double l_H_y__HE_theta = lin->lu[20];
    const double l_H_y__HE_theta_3_i = lin->lu[21];
    const double inverse_pivot_BDE_theta = lin->lu[22];
    const double inverse_pivot_BDE_theta_3_i = lin->lu[23];
    const double l_H_x__BDE_theta = lin->lu[24];
    const double l_H_x__BDE_theta_2_i = lin->lu[25];
    const double u_BDE_theta__H_x = lin->lu[26];
    const double u_BDE_theta__H_x_i = lin->lu[27];
    const double l_H_y__BDE_theta = lin->lu[28];
    const double l_H_y__BDE_theta_2_i = lin->lu[29];
    const double u_BDE_theta__H_y = lin->lu[30];
    const double u_BDE_theta__H_y_i = lin->lu[31];
    const double l_E3_x__BDE_theta = lin->lu[32];
    const double l_E3_x__BDE_theta_3_i = lin->lu[33];
    const double l_E3_y__BDE_theta = lin->lu[34];
    const double l_E3_y__BDE_theta_3_i = lin->lu[35];
    const double inverse_pivot_H_x = lin->lu[36];
    const double inverse_pivot_H_x_3_i = lin->lu[37];
    const double l_H_y__H_x = lin->lu[38];
    const double l_H_y__H_x_i = lin->lu[39];
    const double u_H_x__H_y = lin->lu[40];
    const double u_H_x__H_y_i = lin->lu[41];
    const double l_E3_x__H_x = lin->lu[42];
    const double l_E3_x__H_x_2_i = lin->lu[43];
    const double u_H_x__E3_x = lin->lu[44];
    const double u_H_x__E3_x_i = lin->lu[45];
    const double l_E3_y__H_x = lin->lu[46];
    const double l_E3_y__H_x_2_i = lin->lu[47];
    const double u_H_x__E3_y = lin->lu[48];
    const double u_H_x__E3_y_i = lin->lu[49];
    const double inverse_pivot_H_y = lin->lu[50];
    const double inverse_pivot_H_y_3_i = lin->lu[51];
    const double l_E3_x__H_y = lin->lu[52];
    const double l_E3_x__H_y_2_i = lin->lu[53];
    const double u_H_y__E3_x = lin->lu[54];
    const double u_H_y__E3_x_i = lin->lu[55];
    const double l_E3_y__H_y = lin->lu[56];
    const double l_E3_y__H_y_2_i = lin->lu[57];
    const double u_H_y__E3_y = lin->lu[58];
    const double u_H_y__E3_y_i = lin->lu[59];
    const double inverse_pivot_EG_theta = lin->lu[60];
    const double inverse_pivot_EG_theta_i = lin->lu[61];
    const double l_OF_theta__EG_theta = lin->lu[62];
    const double l_OF_theta__EG_theta_3_i = lin->lu[63];
    const double n_EG_theta__OF_theta = lin->lu[64];
    const double n_EG_theta__OF_theta_i = lin->lu[65];
    const double l_FE_theta__EG_theta = lin->lu[66];
    const double l_FE_theta__EG_theta_3_i = lin->lu[67];
    const double n_EG_theta__FE_theta = lin->lu[68];
    const double n_EG_theta__FE_theta_i = lin->lu[69];
    const double l_G_x__EG_theta = lin->lu[70];
    const double l_G_x__EG_theta_3_i = lin->lu[71];
    const double l_G_y__EG_theta = lin->lu[72];
    const double l_G_y__EG_theta_3_i = lin->lu[73];
    const double inverse_pivot_OF_theta = lin->lu[74];
    const double inverse_pivot_OF_theta_3_i = lin->lu[75];
    const double l_FE_theta__OF_theta = lin->lu[76];
    const double l_FE_theta__OF_theta_i = lin->lu[77];
    const double u_OF_theta__FE_theta = lin->lu[78];
    const double u_OF_theta__FE_theta_i = lin->lu[79];
    const double l_G_x__OF_theta = lin->lu[80];
    const double l_G_x__OF_theta_2_i = lin->lu[81];
    const double u_OF_theta__G_x = lin->lu[82];
    const double u_OF_theta__G_x_i = lin->lu[83];
    const double l_G_y__OF_theta = lin->lu[84];
    const double l_G_y__OF_theta_2_i = lin->lu[85];
    const double u_OF_theta__G_y = lin->lu[86];
    const double u_OF_theta__G_y_i = lin->lu[87];
    const double l_E3_x__OF_theta = lin->lu[88];
    const double l_E3_x__OF_theta_3_i = lin->lu[89];
    const double l_E3_y__OF_theta = lin->lu[90];
    const double l_E3_y__OF_theta_3_i = lin->lu[91];
    const double inverse_pivot_FE_theta = lin->lu[92];
    const double inverse_pivot_FE_theta_3_i = lin->lu[93];
    const double l_G_x__FE_theta = lin->lu[94];
    const double l_G_x__FE_theta_2_i = lin->lu[95];
    const double u_FE_theta__G_x = lin->lu[96];
    const double u_FE_theta__G_x_i = lin->lu[97];
    const double l_G_y__FE_theta = lin->lu[98];
    const double l_G_y__FE_theta_2_i = lin->lu[99];
    const double u_FE_theta__G_y = lin->lu[100];
    const double u_FE_theta__G_y_i = lin->lu[101];
    const double l_E3_x__FE_theta = lin->lu[102];
    const double l_E3_x__FE_theta_3_i = lin->lu[103];
    const double u_FE_theta__E3_x = lin->lu[104];
    const double u_FE_theta__E3_x_i = lin->lu[105];
    const double l_E3_y__FE_theta = lin->lu[106];
    const double l_E3_y__FE_theta_3_i = lin->lu[107];
    const double u_FE_theta__E3_y = lin->lu[108];
    const double u_FE_theta__E3_y_i = lin->lu[109];
    const double inverse_pivot_G_x = lin->lu[110];
    const double inverse_pivot_G_x_3_i = lin->lu[111];
    const double l_G_y__G_x = lin->lu[112];
    const double l_G_y__G_x_i = lin->lu[113];
    const double u_G_x__G_y = lin->lu[114];
    const double u_G_x__G_y_i = lin->lu[115];
    const double l_E3_x__G_x = lin->lu[116];
    const double l_E3_x__G_x_2_i = lin->lu[117];
    const double u_G_x__E3_x = lin->lu[118];
    const double u_G_x__E3_x_i = lin->lu[119];
    const double l_E3_y__G_x = lin->lu[120];
    const double l_E3_y__G_x_2_i = lin->lu[121];
    const double u_G_x__E3_y = lin->lu[122];
    const double u_G_x__E3_y_i = lin->lu[123];
    const double inverse_pivot_G_y = lin->lu[124];
    const double inverse_pivot_G_y_3_i = lin->lu[125];
    const double l_E3_x__G_y = lin->lu[126];
    const double l_E3_x__G_y_2_i = lin->lu[127];
    const double u_G_y__E3_x = lin->lu[128];
    const double u_G_y__E3_x_i = lin->lu[129];
    const double l_E3_y__G_y = lin->lu[130];
    const double l_E3_y__G_y_2_i = lin->lu[131];
    const double u_G_y__E3_y = lin->lu[132];
    const double u_G_y__E3_y_i = lin->lu[133];
    const double inverse_pivot_E3_x = lin->lu[134];
    const double inverse_pivot_E3_x_3_i = lin->lu[135];
    const double l_E3_y__E3_x = lin->lu[136];
    const double l_E3_y__E3_x_i = lin->lu[137];
    const double u_E3_x__E3_y = lin->lu[138];
    const double u_E3_x__E3_y_i = lin->lu[139];
    const double inverse_pivot_E3_y = lin->lu[140];
    const double inverse_pivot_E3_y_3_i = lin->lu[141];

    /* forward */
    const double b_AG_theta = x[4];
    const double b_AG_theta_i = x[5];
    const double b_AH_theta = x[6];
    const double b_AH_theta_i = x[7];
    const double b_HE_theta = x[10];
    const double b_HE_theta_i = x[11];
    const double b_BDE_theta = -b_HE_theta*l_BDE_theta__HE_theta + b_HE_theta_i*l_BDE_theta__HE_theta_3_i + x[2];
    const double b_BDE_theta_i = -b_HE_theta*l_BDE_theta__HE_theta_3_i - b_HE_theta_i*l_BDE_theta__HE_theta + x[3];
    const double b_H_x = -b_AH_theta*l_H_x__AH_theta + b_AH_theta_i*l_H_x__AH_theta_3_i - b_BDE_theta*l_H_x__BDE_theta
        + b_BDE_theta_i*l_H_x__BDE_theta_2_i - b_HE_theta*l_H_x__HE_theta + b_HE_theta_i*l_H_x__HE_theta_3_i + x[18];
    const double b_H_x_i = -b_AH_theta*l_H_x__AH_theta_3_i - b_AH_theta_i*l_H_x__AH_theta
        - b_BDE_theta*l_H_x__BDE_theta_2_i - b_BDE_theta_i*l_H_x__BDE_theta - b_HE_theta*l_H_x__HE_theta_3_i
        - b_HE_theta_i*l_H_x__HE_theta + x[19];
    const double b_H_y = -b_AH_theta*l_H_y__AH_theta + b_AH_theta_i*l_H_y__AH_theta_3_i - b_BDE_theta*l_H_y__BDE_theta
        + b_BDE_theta_i*l_H_y__BDE_theta_2_i - b_HE_theta*l_H_y__HE_theta + b_HE_theta_i*l_H_y__HE_theta_3_i
        - b_H_x*l_H_y__H_x + b_H_x_i*l_H_y__H_x_i + x[20];
    const double b_H_y_i = -b_AH_theta*l_H_y__AH_theta_3_i - b_AH_theta_i*l_H_y__AH_theta
        - b_BDE_theta*l_H_y__BDE_theta_2_i - b_BDE_theta_i*l_H_y__BDE_theta - b_HE_theta*l_H_y__HE_theta_3_i
        - b_HE_theta_i*l_H_y__HE_theta - b_H_x*l_H_y__H_x_i - b_H_x_i*l_H_y__H_x + x[21];
    const double b_EG_theta = x[12];
    const double b_EG_theta_i = x[13];
    const double b_OF_theta = -b_EG_theta*l_OF_theta__EG_theta + b_EG_theta_i*l_OF_theta__EG_theta_3_i + x[0];
    const double b_OF_theta_i = -b_EG_theta*l_OF_theta__EG_theta_3_i - b_EG_theta_i*l_OF_theta__EG_theta + x[1];
    const double b_FE_theta = -b_EG_theta*l_FE_theta__EG_theta + b_EG_theta_i*l_FE_theta__EG_theta_3_i
        - b_OF_theta*l_FE_theta__OF_theta + b_OF_theta_i*l_FE_theta__OF_theta_i + x[8];
    const double b_FE_theta_i = -b_EG_theta*l_FE_theta__EG_theta_3_i - b_EG_theta_i*l_FE_theta__EG_theta
        - b_OF_theta*l_FE_theta__OF_theta_i - b_OF_theta_i*l_FE_theta__OF_theta + x[9];
    const double b_G_x = -b_AG_theta*l_G_x__AG_theta + b_AG_theta_i*l_G_x__AG_theta_3_i - b_EG_theta*l_G_x__EG_theta
        + b_EG_theta_i*l_G_x__EG_theta_3_i - b_FE_theta*l_G_x__FE_theta + b_FE_theta_i*l_G_x__FE_theta_2_i
        - b_OF_theta*l_G_x__OF_theta + b_OF_theta_i*l_G_x__OF_theta_2_i + x[14];
    const double b_G_x_i = -b_AG_theta*l_G_x__AG_theta_3_i - b_AG_theta_i*l_G_x__AG_theta
        - b_EG_theta*l_G_x__EG_theta_3_i - b_EG_theta_i*l_G_x__EG_theta - b_FE_theta*l_G_x__FE_theta_2_i
        - b_FE_theta_i*l_G_x__FE_theta - b_OF_theta*l_G_x__OF_theta_2_i - b_OF_theta_i*l_G_x__OF_theta + x[15];
    const double b_G_y = -b_AG_theta*l_G_y__AG_theta + b_AG_theta_i*l_G_y__AG_theta_3_i - b_EG_theta*l_G_y__EG_theta
        + b_EG_theta_i*l_G_y__EG_theta_3_i - b_FE_theta*l_G_y__FE_theta + b_FE_theta_i*l_G_y__FE_theta_2_i
        - b_G_x*l_G_y__G_x + b_G_x_i*l_G_y__G_x_i - b_OF_theta*l_G_y__OF_theta + b_OF_theta_i*l_G_y__OF_theta_2_i
        + x[16];
    const double b_G_y_i = -b_AG_theta*l_G_y__AG_theta_3_i - b_AG_theta_i*l_G_y__AG_theta
        - b_EG_theta*l_G_y__EG_theta_3_i - b_EG_theta_i*l_G_y__EG_theta - b_FE_theta*l_G_y__FE_theta_2_i
        - b_FE_theta_i*l_G_y__FE_theta - b_G_x*l_G_y__G_x_i - b_G_x_i*l_G_y__G_x - b_OF_theta*l_G_y__OF_theta_2_i
        - b_OF_theta_i*l_G_y__OF_theta + x[17];
    const double b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta + b_BDE_theta_i*l_E3_x__BDE_theta_3_i
        - b_FE_theta*l_E3_x__FE_theta + b_FE_theta_i*l_E3_x__FE_theta_3_i - b_G_x*l_E3_x__G_x + b_G_x_i*l_E3_x__G_x_2_i
        - b_G_y*l_E3_x__G_y + b_G_y_i*l_E3_x__G_y_2_i - b_H_x*l_E3_x__H_x + b_H_x_i*l_E3_x__H_x_2_i - b_H_y*l_E3_x__H_y
        + b_H_y_i*l_E3_x__H_y_2_i - b_OF_theta*l_E3_x__OF_theta + b_OF_theta_i*l_E3_x__OF_theta_3_i + x[22];
    const double b_E3_x_i = -b_BDE_theta*l_E3_x__BDE_theta_3_i - b_BDE_theta_i*l_E3_x__BDE_theta
        - b_FE_theta*l_E3_x__FE_theta_3_i - b_FE_theta_i*l_E3_x__FE_theta - b_G_x*l_E3_x__G_x_2_i - b_G_x_i*l_E3_x__G_x
        - b_G_y*l_E3_x__G_y_2_i - b_G_y_i*l_E3_x__G_y - b_H_x*l_E3_x__H_x_2_i - b_H_x_i*l_E3_x__H_x
        - b_H_y*l_E3_x__H_y_2_i - b_H_y_i*l_E3_x__H_y - b_OF_theta*l_E3_x__OF_theta_3_i - b_OF_theta_i*l_E3_x__OF_theta
        + x[23];
    const double b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta + b_BDE_theta_i*l_E3_y__BDE_theta_3_i - b_E3_x*l_E3_y__E3_x
        + b_E3_x_i*l_E3_y__E3_x_i - b_FE_theta*l_E3_y__FE_theta + b_FE_theta_i*l_E3_y__FE_theta_3_i - b_G_x*l_E3_y__G_x
        + b_G_x_i*l_E3_y__G_x_2_i - b_G_y*l_E3_y__G_y + b_G_y_i*l_E3_y__G_y_2_i - b_H_x*l_E3_y__H_x
        + b_H_x_i*l_E3_y__H_x_2_i - b_H_y*l_E3_y__H_y + b_H_y_i*l_E3_y__H_y_2_i - b_OF_theta*l_E3_y__OF_theta
        + b_OF_theta_i*l_E3_y__OF_theta_3_i + x[24];
    const double b_E3_y_i = -b_BDE_theta*l_E3_y__BDE_theta_3_i - b_BDE_theta_i*l_E3_y__BDE_theta
        - b_E3_x*l_E3_y__E3_x_i - b_E3_x_i*l_E3_y__E3_x - b_FE_theta*l_E3_y__FE_theta_3_i
        - b_FE_theta_i*l_E3_y__FE_theta - b_G_x*l_E3_y__G_x_2_i - b_G_x_i*l_E3_y__G_x - b_G_y*l_E3_y__G_y_2_i
        - b_G_y_i*l_E3_y__G_y - b_H_x*l_E3_y__H_x_2_i - b_H_x_i*l_E3_y__H_x - b_H_y*l_E3_y__H_y_2_i
        - b_H_y_i*l_E3_y__H_y - b_OF_theta*l_E3_y__OF_theta_3_i - b_OF_theta_i*l_E3_y__OF_theta + x[25];

    /* backward */
    const double x_E3_y = b_E3_y*inverse_pivot_E3_y - b_E3_y_i*inverse_pivot_E3_y_3_i;
    const double x_E3_y_i = b_E3_y*inverse_pivot_E3_y_3_i + b_E3_y_i*inverse_pivot_E3_y;
    x[24] = x_E3_y;
    x[25] = x_E3_y_i;
    const double factor_1 = b_E3_x - u_E3_x__E3_y*x_E3_y + u_E3_x__E3_y_i*x_E3_y_i;
    const double factor_2 = b_E3_x_i - u_E3_x__E3_y*x_E3_y_i - u_E3_x__E3_y_i*x_E3_y;
    const double x_E3_x = factor_1*inverse_pivot_E3_x - factor_2*inverse_pivot_E3_x_3_i;
    const double x_E3_x_i = factor_1*inverse_pivot_E3_x_3_i + factor_2*inverse_pivot_E3_x;
    x[22] = x_E3_x;
    x[23] = x_E3_x_i;
    const double factor_3 = b_G_y - u_G_y__E3_x*x_E3_x + u_G_y__E3_x_i*x_E3_x_i - u_G_y__E3_y*x_E3_y
        + u_G_y__E3_y_i*x_E3_y_i;
    const double factor_4 = b_G_y_i - u_G_y__E3_x*x_E3_x_i - u_G_y__E3_x_i*x_E3_x - u_G_y__E3_y*x_E3_y_i
        - u_G_y__E3_y_i*x_E3_y;
    const double x_G_y = factor_3*inverse_pivot_G_y - factor_4*inverse_pivot_G_y_3_i;
    const double x_G_y_i = factor_3*inverse_pivot_G_y_3_i + factor_4*inverse_pivot_G_y;
    x[16] = x_G_y;
    x[17] = x_G_y_i;
    const double factor_5 = b_G_x - u_G_x__E3_x*x_E3_x + u_G_x__E3_x_i*x_E3_x_i - u_G_x__E3_y*x_E3_y
        + u_G_x__E3_y_i*x_E3_y_i - u_G_x__G_y*x_G_y + u_G_x__G_y_i*x_G_y_i;
    const double factor_6 = b_G_x_i - u_G_x__E3_x*x_E3_x_i - u_G_x__E3_x_i*x_E3_x - u_G_x__E3_y*x_E3_y_i
        - u_G_x__E3_y_i*x_E3_y - u_G_x__G_y*x_G_y_i - u_G_x__G_y_i*x_G_y;
    const double x_G_x = factor_5*inverse_pivot_G_x - factor_6*inverse_pivot_G_x_3_i;
    const double x_G_x_i = factor_5*inverse_pivot_G_x_3_i + factor_6*inverse_pivot_G_x;
    x[14] = x_G_x;
    x[15] = x_G_x_i;
    const double factor_7 = b_FE_theta - u_FE_theta__E3_x*x_E3_x + u_FE_theta__E3_x_i*x_E3_x_i
        - u_FE_theta__E3_y*x_E3_y + u_FE_theta__E3_y_i*x_E3_y_i - u_FE_theta__G_x*x_G_x + u_FE_theta__G_x_i*x_G_x_i
        - u_FE_theta__G_y*x_G_y + u_FE_theta__G_y_i*x_G_y_i;
    const double factor_8 = b_FE_theta_i - u_FE_theta__E3_x*x_E3_x_i - u_FE_theta__E3_x_i*x_E3_x
        - u_FE_theta__E3_y*x_E3_y_i - u_FE_theta__E3_y_i*x_E3_y - u_FE_theta__G_x*x_G_x_i - u_FE_theta__G_x_i*x_G_x
        - u_FE_theta__G_y*x_G_y_i - u_FE_theta__G_y_i*x_G_y;
    const double x_FE_theta = factor_7*inverse_pivot_FE_theta - factor_8*inverse_pivot_FE_theta_3_i;
    const double x_FE_theta_i = factor_7*inverse_pivot_FE_theta_3_i + factor_8*inverse_pivot_FE_theta;
    x[8] = x_FE_theta;
    x[9] = x_FE_theta_i;
    const double factor_9 = b_OF_theta - phi_G_x_OF_theta*x_E3_x - phi_G_y_OF_theta*x_E3_y
        - u_OF_theta__FE_theta*x_FE_theta + u_OF_theta__FE_theta_i*x_FE_theta_i - u_OF_theta__G_x*x_G_x
        + u_OF_theta__G_x_i*x_G_x_i - u_OF_theta__G_y*x_G_y + u_OF_theta__G_y_i*x_G_y_i;
    const double factor_10 = b_OF_theta_i - phi_G_x_OF_theta*x_E3_x_i - phi_G_y_OF_theta*x_E3_y_i
        - u_OF_theta__FE_theta*x_FE_theta_i - u_OF_theta__FE_theta_i*x_FE_theta - u_OF_theta__G_x*x_G_x_i
        - u_OF_theta__G_x_i*x_G_x - u_OF_theta__G_y*x_G_y_i - u_OF_theta__G_y_i*x_G_y;
    const double x_OF_theta = -factor_10*inverse_pivot_OF_theta_3_i + factor_9*inverse_pivot_OF_theta;
    const double x_OF_theta_i = factor_10*inverse_pivot_OF_theta + factor_9*inverse_pivot_OF_theta_3_i;
    x[0] = x_OF_theta;
    x[1] = x_OF_theta_i;
    const double factor_11 = b_EG_theta - n_EG_theta__FE_theta*x_FE_theta + n_EG_theta__FE_theta_i*x_FE_theta_i
        - n_EG_theta__OF_theta*x_OF_theta + n_EG_theta__OF_theta_i*x_OF_theta_i - phi_G_x_EG_theta*x_G_x
        - phi_G_y_EG_theta*x_G_y;
    const double factor_12 = b_EG_theta_i - n_EG_theta__FE_theta*x_FE_theta_i - n_EG_theta__FE_theta_i*x_FE_theta
        - n_EG_theta__OF_theta*x_OF_theta_i - n_EG_theta__OF_theta_i*x_OF_theta - phi_G_x_EG_theta*x_G_x_i
        - phi_G_y_EG_theta*x_G_y_i;
    const double x_EG_theta = factor_11*inverse_pivot_EG_theta - factor_12*inverse_pivot_EG_theta_i;
    const double x_EG_theta_i = factor_11*inverse_pivot_EG_theta_i + factor_12*inverse_pivot_EG_theta;
    x[12] = x_EG_theta;
    x[13] = x_EG_theta_i;
    const double factor_13 = b_H_y - u_H_y__E3_x*x_E3_x + u_H_y__E3_x_i*x_E3_x_i - u_H_y__E3_y*x_E3_y
        + u_H_y__E3_y_i*x_E3_y_i;
    const double factor_14 = b_H_y_i - u_H_y__E3_x*x_E3_x_i - u_H_y__E3_x_i*x_E3_x - u_H_y__E3_y*x_E3_y_i
        - u_H_y__E3_y_i*x_E3_y;
    const double x_H_y = factor_13*inverse_pivot_H_y - factor_14*inverse_pivot_H_y_3_i;
    const double x_H_y_i = factor_13*inverse_pivot_H_y_3_i + factor_14*inverse_pivot_H_y;
    x[20] = x_H_y;
    x[21] = x_H_y_i;
    const double factor_15 = b_H_x - u_H_x__E3_x*x_E3_x + u_H_x__E3_x_i*x_E3_x_i - u_H_x__E3_y*x_E3_y
        + u_H_x__E3_y_i*x_E3_y_i - u_H_x__H_y*x_H_y + u_H_x__H_y_i*x_H_y_i;
    const double factor_16 = b_H_x_i - u_H_x__E3_x*x_E3_x_i - u_H_x__E3_x_i*x_E3_x - u_H_x__E3_y*x_E3_y_i
        - u_H_x__E3_y_i*x_E3_y - u_H_x__H_y*x_H_y_i - u_H_x__H_y_i*x_H_y;
    const double x_H_x = factor_15*inverse_pivot_H_x - factor_16*inverse_pivot_H_x_3_i;
    const double x_H_x_i = factor_15*inverse_pivot_H_x_3_i + factor_16*inverse_pivot_H_x;
    x[18] = x_H_x;
    x[19] = x_H_x_i;
    const double factor_17 = b_BDE_theta + phi_H_x_BDE_theta*x_E3_x + phi_H_y_BDE_theta*x_E3_y - u_BDE_theta__H_x*x_H_x
        + u_BDE_theta__H_x_i*x_H_x_i - u_BDE_theta__H_y*x_H_y + u_BDE_theta__H_y_i*x_H_y_i;
    const double factor_18 = b_BDE_theta_i + phi_H_x_BDE_theta*x_E3_x_i + phi_H_y_BDE_theta*x_E3_y_i
        - u_BDE_theta__H_x*x_H_x_i - u_BDE_theta__H_x_i*x_H_x - u_BDE_theta__H_y*x_H_y_i - u_BDE_theta__H_y_i*x_H_y;
    const double x_BDE_theta = factor_17*inverse_pivot_BDE_theta - factor_18*inverse_pivot_BDE_theta_3_i;
    const double x_BDE_theta_i = factor_17*inverse_pivot_BDE_theta_3_i + factor_18*inverse_pivot_BDE_theta;
    x[2] = x_BDE_theta;
    x[3] = x_BDE_theta_i;
    const double factor_19 = b_HE_theta - n_HE_theta__BDE_theta*x_BDE_theta + n_HE_theta__BDE_theta_i*x_BDE_theta_i
        - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y;
    const double factor_20 = b_HE_theta_i - n_HE_theta__BDE_theta*x_BDE_theta_i - n_HE_theta__BDE_theta_i*x_BDE_theta
        - phi_H_x_HE_theta*x_H_x_i - phi_H_y_HE_theta*x_H_y_i;
    const double x_HE_theta = factor_19*inverse_pivot_HE_theta - factor_20*inverse_pivot_HE_theta_i;
    const double x_HE_theta_i = factor_19*inverse_pivot_HE_theta_i + factor_20*inverse_pivot_HE_theta;
    x[10] = x_HE_theta;
    x[11] = x_HE_theta_i;
    const double factor_21 = b_AH_theta - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y;
    const double factor_22 = b_AH_theta_i - phi_H_x_AH_theta*x_H_x_i - phi_H_y_AH_theta*x_H_y_i;
    const double x_AH_theta = factor_21*inverse_pivot_AH_theta - factor_22*inverse_pivot_AH_theta_i;
    const double x_AH_theta_i = factor_21*inverse_pivot_AH_theta_i + factor_22*inverse_pivot_AH_theta;
    x[6] = x_AH_theta;
    x[7] = x_AH_theta_i;
    const double factor_23 = b_AG_theta - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y;
    const double factor_24 = b_AG_theta_i - phi_G_x_AG_theta*x_G_x_i - phi_G_y_AG_theta*x_G_y_i;
    const double x_AG_theta = factor_23*inverse_pivot_AG_theta - factor_24*inverse_pivot_AG_theta_i;
    const double x_AG_theta_i = factor_23*inverse_pivot_AG_theta_i + factor_24*inverse_pivot_AG_theta;
    x[4] = x_AG_theta;
    x[5] = x_AG_theta_i;
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
    const double factor_1 = p->beta_squared*eta + p->two_alpha;
    const double factor_2 = p->beta_squared*eta_i;
    const double divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const double divisor_2 = eta*factor_2 + eta_i*factor_1;
    const double divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const double factor_3 = divisor_1*divisor_3;
    const double factor_4 = -divisor_2*divisor_3;
    const double eta_row = eta*factor_3 - eta_i*factor_4;
    const double eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* right-hand side */
    double x[26];
    const double shifted_OF_theta = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[14];
    const double shifted_OF_theta_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[15];
    const double shifted_BDE_theta = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[16];
    const double shifted_BDE_theta_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[17];
    const double shifted_AG_theta = -p->beta_squared*(eta*r[4] - eta_i*r[5]) + r[18];
    const double shifted_AG_theta_i = -p->beta_squared*(eta*r[5] + eta_i*r[4]) + r[19];
    const double shifted_AH_theta = -p->beta_squared*(eta*r[6] - eta_i*r[7]) + r[20];
    const double shifted_AH_theta_i = -p->beta_squared*(eta*r[7] + eta_i*r[6]) + r[21];
    const double shifted_FE_theta = -p->beta_squared*(eta*r[8] - eta_i*r[9]) + r[22];
    const double shifted_FE_theta_i = -p->beta_squared*(eta*r[9] + eta_i*r[8]) + r[23];
    const double shifted_HE_theta = -p->beta_squared*(eta*r[10] - eta_i*r[11]) + r[24];
    const double shifted_HE_theta_i = -p->beta_squared*(eta*r[11] + eta_i*r[10]) + r[25];
    const double shifted_EG_theta = -p->beta_squared*(eta*r[12] - eta_i*r[13]) + r[26];
    const double shifted_EG_theta_i = -p->beta_squared*(eta*r[13] + eta_i*r[12]) + r[27];
    const double factor_5 = -by_q_OF_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_OF_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_OF_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_OF_OF*r[14] + mass_OF_theta_EG_theta*r[26] + mass_OF_theta_FE_theta*r[22];
    const double factor_6 = -by_q_OF_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_OF_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_OF_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_OF_OF*r[15] + mass_OF_theta_EG_theta*r[27] + mass_OF_theta_FE_theta*r[23];
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = -by_q_BDE_theta_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_BDE_theta_HE_theta*(eta*r[10] - eta_i*r[11]) + p->mass_BDE_BDE*r[16] + mass_BDE_theta_HE_theta*r[24];
    const double factor_8 = -by_q_BDE_theta_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_BDE_theta_HE_theta*(eta*r[11] + eta_i*r[10]) + p->mass_BDE_BDE*r[17] + mass_BDE_theta_HE_theta*r[25];
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = -by_q_AG_theta_AG_theta*(eta*r[4] - eta_i*r[5]) + p->mass_AG_AG*r[18];
    const double factor_10 = -by_q_AG_theta_AG_theta*(eta*r[5] + eta_i*r[4]) + p->mass_AG_AG*r[19];
    x[4] = eta*factor_9 - eta_i*factor_10;
    x[5] = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = -by_q_AH_theta_AH_theta*(eta*r[6] - eta_i*r[7]) + p->mass_AH_AH*r[20];
    const double factor_12 = -by_q_AH_theta_AH_theta*(eta*r[7] + eta_i*r[6]) + p->mass_AH_AH*r[21];
    x[6] = eta*factor_11 - eta_i*factor_12;
    x[7] = eta*factor_12 + eta_i*factor_11;
    const double factor_13 = -by_q_FE_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_FE_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_FE_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_FE_FE*r[22] + mass_FE_theta_EG_theta*r[26] + mass_OF_theta_FE_theta*r[14];
    const double factor_14 = -by_q_FE_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_FE_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_FE_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_FE_FE*r[23] + mass_FE_theta_EG_theta*r[27] + mass_OF_theta_FE_theta*r[15];
    x[8] = eta*factor_13 - eta_i*factor_14;
    x[9] = eta*factor_14 + eta_i*factor_13;
    const double factor_15 = -by_q_HE_theta_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_HE_theta_HE_theta*(eta*r[10] - eta_i*r[11]) + mass_BDE_theta_HE_theta*r[16] + p->mass_HE_HE*r[24];
    const double factor_16 = -by_q_HE_theta_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_HE_theta_HE_theta*(eta*r[11] + eta_i*r[10]) + mass_BDE_theta_HE_theta*r[17] + p->mass_HE_HE*r[25];
    x[10] = eta*factor_15 - eta_i*factor_16;
    x[11] = eta*factor_16 + eta_i*factor_15;
    const double factor_17 = -by_q_EG_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_EG_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_EG_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_EG_EG*r[26] + mass_FE_theta_EG_theta*r[22] + mass_OF_theta_EG_theta*r[14];
    const double factor_18 = -by_q_EG_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_EG_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_EG_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_EG_EG*r[27] + mass_FE_theta_EG_theta*r[23] + mass_OF_theta_EG_theta*r[15];
    x[12] = eta*factor_17 - eta_i*factor_18;
    x[13] = eta*factor_18 + eta_i*factor_17;
    const double factor_19 = -by_q_G_x_AG_theta*(eta*r[4] - eta_i*r[5]) - by_q_G_x_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_G_x_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_x_OF_theta*(eta*r[0] - eta_i*r[1])
        + phi_G_x_AG_theta*shifted_AG_theta + phi_G_x_EG_theta*shifted_EG_theta + phi_G_x_FE_theta*shifted_FE_theta
        + phi_G_x_OF_theta*shifted_OF_theta;
    const double factor_20 = -by_q_G_x_AG_theta*(eta*r[5] + eta_i*r[4]) - by_q_G_x_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_G_x_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_x_OF_theta*(eta*r[1] + eta_i*r[0])
        + phi_G_x_AG_theta*shifted_AG_theta_i + phi_G_x_EG_theta*shifted_EG_theta_i
        + phi_G_x_FE_theta*shifted_FE_theta_i + phi_G_x_OF_theta*shifted_OF_theta_i;
    x[14] = eta_row*factor_19 - eta_row_i*factor_20;
    x[15] = eta_row*factor_20 + eta_row_i*factor_19;
    const double factor_21 = -by_q_G_y_AG_theta*(eta*r[4] - eta_i*r[5]) - by_q_G_y_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_G_y_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_y_OF_theta*(eta*r[0] - eta_i*r[1])
        + phi_G_y_AG_theta*shifted_AG_theta + phi_G_y_EG_theta*shifted_EG_theta + phi_G_y_FE_theta*shifted_FE_theta
        + phi_G_y_OF_theta*shifted_OF_theta;
    const double factor_22 = -by_q_G_y_AG_theta*(eta*r[5] + eta_i*r[4]) - by_q_G_y_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_G_y_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_y_OF_theta*(eta*r[1] + eta_i*r[0])
        + phi_G_y_AG_theta*shifted_AG_theta_i + phi_G_y_EG_theta*shifted_EG_theta_i
        + phi_G_y_FE_theta*shifted_FE_theta_i + phi_G_y_OF_theta*shifted_OF_theta_i;
    x[16] = eta_row*factor_21 - eta_row_i*factor_22;
    x[17] = eta_row*factor_22 + eta_row_i*factor_21;
    const double factor_23 = -by_q_H_x_AH_theta*(eta*r[6] - eta_i*r[7]) - by_q_H_x_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_H_x_HE_theta*(eta*r[10] - eta_i*r[11]) + phi_H_x_AH_theta*shifted_AH_theta
        + phi_H_x_BDE_theta*shifted_BDE_theta + phi_H_x_HE_theta*shifted_HE_theta;
    const double factor_24 = -by_q_H_x_AH_theta*(eta*r[7] + eta_i*r[6]) - by_q_H_x_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_H_x_HE_theta*(eta*r[11] + eta_i*r[10]) + phi_H_x_AH_theta*shifted_AH_theta_i
        + phi_H_x_BDE_theta*shifted_BDE_theta_i + phi_H_x_HE_theta*shifted_HE_theta_i;
    x[18] = eta_row*factor_23 - eta_row_i*factor_24;
    x[19] = eta_row*factor_24 + eta_row_i*factor_23;
    const double factor_25 = -by_q_H_y_AH_theta*(eta*r[6] - eta_i*r[7]) - by_q_H_y_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_H_y_HE_theta*(eta*r[10] - eta_i*r[11]) + phi_H_y_AH_theta*shifted_AH_theta
        + phi_H_y_BDE_theta*shifted_BDE_theta + phi_H_y_HE_theta*shifted_HE_theta;
    const double factor_26 = -by_q_H_y_AH_theta*(eta*r[7] + eta_i*r[6]) - by_q_H_y_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_H_y_HE_theta*(eta*r[11] + eta_i*r[10]) + phi_H_y_AH_theta*shifted_AH_theta_i
        + phi_H_y_BDE_theta*shifted_BDE_theta_i + phi_H_y_HE_theta*shifted_HE_theta_i;
    x[20] = eta_row*factor_25 - eta_row_i*factor_26;
    x[21] = eta_row*factor_26 + eta_row_i*factor_25;
    const double factor_27 = -by_q_G_x_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_x_OF_theta*(eta*r[0] - eta_i*r[1])
        + by_q_H_x_BDE_theta*(eta*r[2] - eta_i*r[3]) + phi_G_x_FE_theta*shifted_FE_theta
        + phi_G_x_OF_theta*shifted_OF_theta - phi_H_x_BDE_theta*shifted_BDE_theta;
    const double factor_28 = -by_q_G_x_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_x_OF_theta*(eta*r[1] + eta_i*r[0])
        + by_q_H_x_BDE_theta*(eta*r[3] + eta_i*r[2]) + phi_G_x_FE_theta*shifted_FE_theta_i
        + phi_G_x_OF_theta*shifted_OF_theta_i - phi_H_x_BDE_theta*shifted_BDE_theta_i;
    x[22] = eta_row*factor_27 - eta_row_i*factor_28;
    x[23] = eta_row*factor_28 + eta_row_i*factor_27;
    const double factor_29 = -by_q_G_y_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_y_OF_theta*(eta*r[0] - eta_i*r[1])
        + by_q_H_y_BDE_theta*(eta*r[2] - eta_i*r[3]) + phi_G_y_FE_theta*shifted_FE_theta
        + phi_G_y_OF_theta*shifted_OF_theta - phi_H_y_BDE_theta*shifted_BDE_theta;
    const double factor_30 = -by_q_G_y_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_y_OF_theta*(eta*r[1] + eta_i*r[0])
        + by_q_H_y_BDE_theta*(eta*r[3] + eta_i*r[2]) + phi_G_y_FE_theta*shifted_FE_theta_i
        + phi_G_y_OF_theta*shifted_OF_theta_i - phi_H_y_BDE_theta*shifted_BDE_theta_i;
    x[24] = eta_row*factor_29 - eta_row_i*factor_30;
    x[25] = eta_row*factor_30 + eta_row_i*factor_29;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_31 = r[0] + x[0];
    const double factor_32 = r[1] + x[1];
    u[0] = eta*factor_31 - eta_i*factor_32;
    u[1] = eta*factor_32 + eta_i*factor_31;
    u[14] = x[0];
    u[15] = x[1];
    const double factor_33 = r[2] + x[2];
    const double factor_34 = r[3] + x[3];
    u[2] = eta*factor_33 - eta_i*factor_34;
    u[3] = eta*factor_34 + eta_i*factor_33;
    u[16] = x[2];
    u[17] = x[3];
    const double factor_35 = r[4] + x[4];
    const double factor_36 = r[5] + x[5];
    u[4] = eta*factor_35 - eta_i*factor_36;
    u[5] = eta*factor_36 + eta_i*factor_35;
    u[18] = x[4];
    u[19] = x[5];
    const double factor_37 = r[6] + x[6];
    const double factor_38 = r[7] + x[7];
    u[6] = eta*factor_37 - eta_i*factor_38;
    u[7] = eta*factor_38 + eta_i*factor_37;
    u[20] = x[6];
    u[21] = x[7];
    const double factor_39 = r[8] + x[8];
    const double factor_40 = r[9] + x[9];
    u[8] = eta*factor_39 - eta_i*factor_40;
    u[9] = eta*factor_40 + eta_i*factor_39;
    u[22] = x[8];
    u[23] = x[9];
    const double factor_41 = r[10] + x[10];
    const double factor_42 = r[11] + x[11];
    u[10] = eta*factor_41 - eta_i*factor_42;
    u[11] = eta*factor_42 + eta_i*factor_41;
    u[24] = x[10];
    u[25] = x[11];
    const double factor_43 = r[12] + x[12];
    const double factor_44 = r[13] + x[13];
    u[12] = eta*factor_43 - eta_i*factor_44;
    u[13] = eta*factor_44 + eta_i*factor_43;
    u[26] = x[12];
    u[27] = x[13];
    u[28] = eta*r[28] - eta_i*r[29];
    u[29] = eta*r[29] + eta_i*r[28];
    const double factor_45 = p->motor_value*u[14] + r[30];
    const double factor_46 = p->motor_value*u[15] + r[31];
    u[30] = eta*factor_45 - eta_i*factor_46;
    u[31] = eta*factor_46 + eta_i*factor_45;
    u[32] = eta*r[32] - eta_i*r[33];
    u[33] = eta*r[33] + eta_i*r[32];
}
