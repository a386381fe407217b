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
    const double mass_crank0_theta_coupler1_theta = lin->value[0];
    const double mass_crank1_theta_coupler2_theta = lin->value[1];
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_x_coupler1_theta = lin->value[9];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double phi_B1_y_coupler1_theta = lin->value[11];
    const double by_q_B2_x_coupler2_theta = lin->value[12];
    const double by_q_B2_x_crank1_theta = lin->value[13];
    const double by_q_B2_x_crank2_theta = lin->value[14];
    const double by_q_B2_y_coupler2_theta = lin->value[15];
    const double by_q_B2_y_crank1_theta = lin->value[16];
    const double by_q_B2_y_crank2_theta = lin->value[17];
    const double by_q_B1_x_coupler1_theta = lin->value[18];
    const double by_q_B1_x_crank0_theta = lin->value[19];
    const double by_q_B1_y_coupler1_theta = lin->value[20];
    const double by_q_B1_y_crank0_theta = lin->value[21];
    const double by_q_crank0_theta_crank0_theta = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta = lin->value[23];
    const double by_q_crank1_theta_crank1_theta = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta = lin->value[25];
    const double by_q_crank2_theta_crank2_theta = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta = lin->value[30];
    const double by_v_B2_x_coupler2_theta = lin->value[31];
    const double by_v_B2_x_crank1_theta = lin->value[32];
    const double by_v_B2_x_crank2_theta = lin->value[33];
    const double by_v_B2_y_coupler2_theta = lin->value[34];
    const double by_v_B2_y_crank1_theta = lin->value[35];
    const double by_v_B2_y_crank2_theta = lin->value[36];
    const double by_v_B1_x_coupler1_theta = lin->value[37];
    const double by_v_B1_x_crank0_theta = lin->value[38];
    const double by_v_B1_y_coupler1_theta = lin->value[39];
    const double by_v_B1_y_crank0_theta = lin->value[40];
    const double by_v_crank0_theta_coupler1_theta = lin->value[41];
    const double by_v_crank1_theta_coupler2_theta = lin->value[42];
    const double by_v_coupler1_theta_crank0_theta = lin->value[43];
    const double by_v_coupler2_theta_crank1_theta = lin->value[44];

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
    const double n_crank0_theta__crank0_theta = by_q_crank0_theta_crank0_theta*((eta * eta) - (eta_i * eta_i))
        + p->mass_crank0_crank0;
    const double n_crank0_theta__crank0_theta_i = 2.0*by_q_crank0_theta_crank0_theta*eta*eta_i;
    const double factor_5 = by_q_crank0_theta_coupler1_theta*eta + by_v_crank0_theta_coupler1_theta;
    const double factor_6 = by_q_crank0_theta_coupler1_theta*eta_i;
    const double n_crank0_theta__coupler1_theta = eta*factor_5 - eta_i*factor_6 + mass_crank0_theta_coupler1_theta;
    const double n_crank0_theta__coupler1_theta_i = eta*factor_6 + eta_i*factor_5;
    const double n_crank1_theta__crank1_theta = by_q_crank1_theta_crank1_theta*((eta * eta) - (eta_i * eta_i))
        + p->mass_crank1_crank1;
    const double n_crank1_theta__crank1_theta_i = 2.0*by_q_crank1_theta_crank1_theta*eta*eta_i;
    const double factor_7 = by_q_crank1_theta_coupler2_theta*eta + by_v_crank1_theta_coupler2_theta;
    const double factor_8 = by_q_crank1_theta_coupler2_theta*eta_i;
    const double n_crank1_theta__coupler2_theta = eta*factor_7 - eta_i*factor_8 + mass_crank1_theta_coupler2_theta;
    const double n_crank1_theta__coupler2_theta_i = eta*factor_8 + eta_i*factor_7;
    const double n_crank2_theta__crank2_theta = by_q_crank2_theta_crank2_theta*((eta * eta) - (eta_i * eta_i))
        + p->mass_crank2_crank2;
    const double n_crank2_theta__crank2_theta_i = 2.0*by_q_crank2_theta_crank2_theta*eta*eta_i;
    const double factor_9 = by_q_coupler1_theta_crank0_theta*eta + by_v_coupler1_theta_crank0_theta;
    const double factor_10 = by_q_coupler1_theta_crank0_theta*eta_i;
    const double n_coupler1_theta__crank0_theta = eta*factor_9 - eta_i*factor_10 + mass_crank0_theta_coupler1_theta;
    const double n_coupler1_theta__crank0_theta_i = eta*factor_10 + eta_i*factor_9;
    const double n_coupler1_theta__coupler1_theta = by_q_coupler1_theta_coupler1_theta*((eta * eta) - (eta_i * eta_i))
        + p->mass_coupler1_coupler1;
    const double n_coupler1_theta__coupler1_theta_i = 2.0*by_q_coupler1_theta_coupler1_theta*eta*eta_i;
    const double factor_11 = by_q_coupler2_theta_crank1_theta*eta + by_v_coupler2_theta_crank1_theta;
    const double factor_12 = by_q_coupler2_theta_crank1_theta*eta_i;
    const double n_coupler2_theta__crank1_theta = eta*factor_11 - eta_i*factor_12 + mass_crank1_theta_coupler2_theta;
    const double n_coupler2_theta__crank1_theta_i = eta*factor_12 + eta_i*factor_11;
    const double n_coupler2_theta__coupler2_theta = by_q_coupler2_theta_coupler2_theta*((eta * eta) - (eta_i * eta_i))
        + p->mass_coupler2_coupler2;
    const double n_coupler2_theta__coupler2_theta_i = 2.0*by_q_coupler2_theta_coupler2_theta*eta*eta_i;
    const double factor_13 = by_q_B2_x_crank1_theta*eta + by_v_B2_x_crank1_theta;
    const double factor_14 = by_q_B2_x_crank1_theta*eta_i;
    const double n_B2_x__crank1_theta = eta_row*factor_13 - eta_row_i*factor_14 + phi_B2_x_crank1_theta;
    const double n_B2_x__crank1_theta_i = eta_row*factor_14 + eta_row_i*factor_13;
    const double factor_15 = by_q_B2_x_crank2_theta*eta + by_v_B2_x_crank2_theta;
    const double factor_16 = by_q_B2_x_crank2_theta*eta_i;
    const double n_B2_x__crank2_theta = eta_row*factor_15 - eta_row_i*factor_16 + phi_B2_x_crank2_theta;
    const double n_B2_x__crank2_theta_i = eta_row*factor_16 + eta_row_i*factor_15;
    const double factor_17 = by_q_B2_x_coupler2_theta*eta + by_v_B2_x_coupler2_theta;
    const double factor_18 = by_q_B2_x_coupler2_theta*eta_i;
    const double n_B2_x__coupler2_theta = eta_row*factor_17 - eta_row_i*factor_18 + phi_B2_x_coupler2_theta;
    const double n_B2_x__coupler2_theta_i = eta_row*factor_18 + eta_row_i*factor_17;
    const double factor_19 = by_q_B2_y_crank1_theta*eta + by_v_B2_y_crank1_theta;
    const double factor_20 = by_q_B2_y_crank1_theta*eta_i;
    const double n_B2_y__crank1_theta = eta_row*factor_19 - eta_row_i*factor_20 + phi_B2_y_crank1_theta;
    const double n_B2_y__crank1_theta_i = eta_row*factor_20 + eta_row_i*factor_19;
    const double factor_21 = by_q_B2_y_crank2_theta*eta + by_v_B2_y_crank2_theta;
    const double factor_22 = by_q_B2_y_crank2_theta*eta_i;
    const double n_B2_y__crank2_theta = eta_row*factor_21 - eta_row_i*factor_22 + phi_B2_y_crank2_theta;
    const double n_B2_y__crank2_theta_i = eta_row*factor_22 + eta_row_i*factor_21;
    const double factor_23 = by_q_B2_y_coupler2_theta*eta + by_v_B2_y_coupler2_theta;
    const double factor_24 = by_q_B2_y_coupler2_theta*eta_i;
    const double n_B2_y__coupler2_theta = eta_row*factor_23 - eta_row_i*factor_24 + phi_B2_y_coupler2_theta;
    const double n_B2_y__coupler2_theta_i = eta_row*factor_24 + eta_row_i*factor_23;
    const double factor_25 = by_q_B1_x_crank0_theta*eta + by_v_B1_x_crank0_theta;
    const double factor_26 = by_q_B1_x_crank0_theta*eta_i;
    const double n_B1_x__crank0_theta = eta_row*factor_25 - eta_row_i*factor_26 + phi_B1_x_crank0_theta;
    const double n_B1_x__crank0_theta_i = eta_row*factor_26 + eta_row_i*factor_25;
    const double factor_27 = -by_q_B2_x_crank1_theta*eta - by_v_B2_x_crank1_theta;
    const double factor_28 = -by_q_B2_x_crank1_theta*eta_i;
    const double n_B1_x__crank1_theta = eta_row*factor_27 - eta_row_i*factor_28 - phi_B2_x_crank1_theta;
    const double n_B1_x__crank1_theta_i = eta_row*factor_28 + eta_row_i*factor_27;
    const double factor_29 = by_q_B1_x_coupler1_theta*eta + by_v_B1_x_coupler1_theta;
    const double factor_30 = by_q_B1_x_coupler1_theta*eta_i;
    const double n_B1_x__coupler1_theta = eta_row*factor_29 - eta_row_i*factor_30 + phi_B1_x_coupler1_theta;
    const double n_B1_x__coupler1_theta_i = eta_row*factor_30 + eta_row_i*factor_29;
    const double factor_31 = by_q_B1_y_crank0_theta*eta + by_v_B1_y_crank0_theta;
    const double factor_32 = by_q_B1_y_crank0_theta*eta_i;
    const double n_B1_y__crank0_theta = eta_row*factor_31 - eta_row_i*factor_32 + phi_B1_y_crank0_theta;
    const double n_B1_y__crank0_theta_i = eta_row*factor_32 + eta_row_i*factor_31;
    const double factor_33 = -by_q_B2_y_crank1_theta*eta - by_v_B2_y_crank1_theta;
    const double factor_34 = -by_q_B2_y_crank1_theta*eta_i;
    const double n_B1_y__crank1_theta = eta_row*factor_33 - eta_row_i*factor_34 - phi_B2_y_crank1_theta;
    const double n_B1_y__crank1_theta_i = eta_row*factor_34 + eta_row_i*factor_33;
    const double factor_35 = by_q_B1_y_coupler1_theta*eta + by_v_B1_y_coupler1_theta;
    const double factor_36 = by_q_B1_y_coupler1_theta*eta_i;
    const double n_B1_y__coupler1_theta = eta_row*factor_35 - eta_row_i*factor_36 + phi_B1_y_coupler1_theta;
    const double n_B1_y__coupler1_theta_i = eta_row*factor_36 + eta_row_i*factor_35;

    /* L U */
    const double scale_crank2_theta = n_crank2_theta__crank2_theta;
    const double scale_crank2_theta_i = n_crank2_theta__crank2_theta_i;
    const double size_1 = fabs(scale_crank2_theta) + fabs(scale_crank2_theta_i);
    const double size_2 = fabs(n_crank2_theta__crank2_theta) + fabs(n_crank2_theta__crank2_theta_i);
    if (!(size_1 > SINGULAR * size_2))
        return 3;
    const double divisor_4 = 1.0/((scale_crank2_theta * scale_crank2_theta)
        + (scale_crank2_theta_i * scale_crank2_theta_i));
    const double inverse_pivot_crank2_theta = divisor_4*scale_crank2_theta;
    const double inverse_pivot_crank2_theta_i = -divisor_4*scale_crank2_theta_i;
    lin->lu[0] = inverse_pivot_crank2_theta;
    lin->lu[1] = inverse_pivot_crank2_theta_i;
    const double l_B2_x__crank2_theta = inverse_pivot_crank2_theta*n_B2_x__crank2_theta
        - inverse_pivot_crank2_theta_i*n_B2_x__crank2_theta_i;
    const double l_B2_x__crank2_theta_3_i = inverse_pivot_crank2_theta*n_B2_x__crank2_theta_i
        + inverse_pivot_crank2_theta_i*n_B2_x__crank2_theta;
    lin->lu[2] = l_B2_x__crank2_theta;
    lin->lu[3] = l_B2_x__crank2_theta_3_i;
    const double l_B2_y__crank2_theta = inverse_pivot_crank2_theta*n_B2_y__crank2_theta
        - inverse_pivot_crank2_theta_i*n_B2_y__crank2_theta_i;
    const double l_B2_y__crank2_theta_3_i = inverse_pivot_crank2_theta*n_B2_y__crank2_theta_i
        + inverse_pivot_crank2_theta_i*n_B2_y__crank2_theta;
    lin->lu[4] = l_B2_y__crank2_theta;
    lin->lu[5] = l_B2_y__crank2_theta_3_i;
    const double scale_crank0_theta = n_crank0_theta__crank0_theta;
    const double scale_crank0_theta_i = n_crank0_theta__crank0_theta_i;
    const double size_3 = fabs(scale_crank0_theta) + fabs(scale_crank0_theta_i);
    const double size_4 = fabs(n_crank0_theta__crank0_theta) + fabs(n_crank0_theta__crank0_theta_i);
    if (!(size_3 > SINGULAR * size_4))
        return 1;
    const double divisor_5 = 1.0/((scale_crank0_theta * scale_crank0_theta)
        + (scale_crank0_theta_i * scale_crank0_theta_i));
    const double inverse_pivot_crank0_theta = divisor_5*scale_crank0_theta;
    const double inverse_pivot_crank0_theta_i = -divisor_5*scale_crank0_theta_i;
    lin->lu[6] = inverse_pivot_crank0_theta;
    lin->lu[7] = inverse_pivot_crank0_theta_i;
    const double l_coupler1_theta__crank0_theta = inverse_pivot_crank0_theta*n_coupler1_theta__crank0_theta
        - inverse_pivot_crank0_theta_i*n_coupler1_theta__crank0_theta_i;
    const double l_coupler1_theta__crank0_theta_3_i = inverse_pivot_crank0_theta*n_coupler1_theta__crank0_theta_i
        + inverse_pivot_crank0_theta_i*n_coupler1_theta__crank0_theta;
    lin->lu[8] = l_coupler1_theta__crank0_theta;
    lin->lu[9] = l_coupler1_theta__crank0_theta_3_i;
    lin->lu[10] = n_crank0_theta__coupler1_theta;
    lin->lu[11] = n_crank0_theta__coupler1_theta_i;
    const double l_B1_x__crank0_theta = inverse_pivot_crank0_theta*n_B1_x__crank0_theta
        - inverse_pivot_crank0_theta_i*n_B1_x__crank0_theta_i;
    const double l_B1_x__crank0_theta_3_i = inverse_pivot_crank0_theta*n_B1_x__crank0_theta_i
        + inverse_pivot_crank0_theta_i*n_B1_x__crank0_theta;
    lin->lu[12] = l_B1_x__crank0_theta;
    lin->lu[13] = l_B1_x__crank0_theta_3_i;
    const double l_B1_y__crank0_theta = inverse_pivot_crank0_theta*n_B1_y__crank0_theta
        - inverse_pivot_crank0_theta_i*n_B1_y__crank0_theta_i;
    const double l_B1_y__crank0_theta_3_i = inverse_pivot_crank0_theta*n_B1_y__crank0_theta_i
        + inverse_pivot_crank0_theta_i*n_B1_y__crank0_theta;
    lin->lu[14] = l_B1_y__crank0_theta;
    lin->lu[15] = l_B1_y__crank0_theta_3_i;
    const double scale_coupler1_theta = -l_coupler1_theta__crank0_theta*n_crank0_theta__coupler1_theta
        + l_coupler1_theta__crank0_theta_3_i*n_crank0_theta__coupler1_theta_i + n_coupler1_theta__coupler1_theta;
    const double scale_coupler1_theta_i = -l_coupler1_theta__crank0_theta*n_crank0_theta__coupler1_theta_i
        - l_coupler1_theta__crank0_theta_3_i*n_crank0_theta__coupler1_theta + n_coupler1_theta__coupler1_theta_i;
    const double size_5 = fabs(scale_coupler1_theta) + fabs(scale_coupler1_theta_i);
    const double size_6 = fabs(n_coupler1_theta__coupler1_theta) + fabs(n_coupler1_theta__coupler1_theta_i);
    if (!(size_5 > SINGULAR * size_6))
        return 4;
    const double divisor_6 = 1.0/((scale_coupler1_theta * scale_coupler1_theta)
        + (scale_coupler1_theta_i * scale_coupler1_theta_i));
    const double inverse_pivot_coupler1_theta = divisor_6*scale_coupler1_theta;
    const double inverse_pivot_coupler1_theta_3_i = -divisor_6*scale_coupler1_theta_i;
    lin->lu[16] = inverse_pivot_coupler1_theta;
    lin->lu[17] = inverse_pivot_coupler1_theta_3_i;
    const double factor_37 = -l_B1_x__crank0_theta*n_crank0_theta__coupler1_theta
        + l_B1_x__crank0_theta_3_i*n_crank0_theta__coupler1_theta_i + n_B1_x__coupler1_theta;
    const double factor_38 = -l_B1_x__crank0_theta*n_crank0_theta__coupler1_theta_i
        - l_B1_x__crank0_theta_3_i*n_crank0_theta__coupler1_theta + n_B1_x__coupler1_theta_i;
    const double l_B1_x__coupler1_theta = factor_37*inverse_pivot_coupler1_theta
        - factor_38*inverse_pivot_coupler1_theta_3_i;
    const double l_B1_x__coupler1_theta_3_i = factor_37*inverse_pivot_coupler1_theta_3_i
        + factor_38*inverse_pivot_coupler1_theta;
    lin->lu[18] = l_B1_x__coupler1_theta;
    lin->lu[19] = l_B1_x__coupler1_theta_3_i;
    const double u_coupler1_theta__B1_x = -l_coupler1_theta__crank0_theta*phi_B1_x_crank0_theta
        + phi_B1_x_coupler1_theta;
    const double u_coupler1_theta__B1_x_i = -l_coupler1_theta__crank0_theta_3_i*phi_B1_x_crank0_theta;
    lin->lu[20] = u_coupler1_theta__B1_x;
    lin->lu[21] = u_coupler1_theta__B1_x_i;
    const double factor_39 = -l_B1_y__crank0_theta*n_crank0_theta__coupler1_theta
        + l_B1_y__crank0_theta_3_i*n_crank0_theta__coupler1_theta_i + n_B1_y__coupler1_theta;
    const double factor_40 = -l_B1_y__crank0_theta*n_crank0_theta__coupler1_theta_i
        - l_B1_y__crank0_theta_3_i*n_crank0_theta__coupler1_theta + n_B1_y__coupler1_theta_i;
    const double l_B1_y__coupler1_theta = factor_39*inverse_pivot_coupler1_theta
        - factor_40*inverse_pivot_coupler1_theta_3_i;
    const double l_B1_y__coupler1_theta_3_i = factor_39*inverse_pivot_coupler1_theta_3_i
        + factor_40*inverse_pivot_coupler1_theta;
    lin->lu[22] = l_B1_y__coupler1_theta;
    lin->lu[23] = l_B1_y__coupler1_theta_3_i;
    const double u_coupler1_theta__B1_y = -l_coupler1_theta__crank0_theta*phi_B1_y_crank0_theta
        + phi_B1_y_coupler1_theta;
    const double u_coupler1_theta__B1_y_i = -l_coupler1_theta__crank0_theta_3_i*phi_B1_y_crank0_theta;
    lin->lu[24] = u_coupler1_theta__B1_y;
    lin->lu[25] = u_coupler1_theta__B1_y_i;
    const double scale_coupler2_theta = n_coupler2_theta__coupler2_theta;
    const double scale_coupler2_theta_i = n_coupler2_theta__coupler2_theta_i;
    const double size_7 = fabs(scale_coupler2_theta) + fabs(scale_coupler2_theta_i);
    const double size_8 = fabs(n_coupler2_theta__coupler2_theta) + fabs(n_coupler2_theta__coupler2_theta_i);
    if (!(size_7 > SINGULAR * size_8))
        return 5;
    const double divisor_7 = 1.0/((scale_coupler2_theta * scale_coupler2_theta)
        + (scale_coupler2_theta_i * scale_coupler2_theta_i));
    const double inverse_pivot_coupler2_theta = divisor_7*scale_coupler2_theta;
    const double inverse_pivot_coupler2_theta_i = -divisor_7*scale_coupler2_theta_i;
    lin->lu[26] = inverse_pivot_coupler2_theta;
    lin->lu[27] = inverse_pivot_coupler2_theta_i;
    const double l_crank1_theta__coupler2_theta = inverse_pivot_coupler2_theta*n_crank1_theta__coupler2_theta
        - inverse_pivot_coupler2_theta_i*n_crank1_theta__coupler2_theta_i;
    const double l_crank1_theta__coupler2_theta_3_i = inverse_pivot_coupler2_theta*n_crank1_theta__coupler2_theta_i
        + inverse_pivot_coupler2_theta_i*n_crank1_theta__coupler2_theta;
    lin->lu[28] = l_crank1_theta__coupler2_theta;
    lin->lu[29] = l_crank1_theta__coupler2_theta_3_i;
    lin->lu[30] = n_coupler2_theta__crank1_theta;
    lin->lu[31] = n_coupler2_theta__crank1_theta_i;
    const double l_B2_x__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta
        - inverse_pivot_coupler2_theta_i*n_B2_x__coupler2_theta_i;
    const double l_B2_x__coupler2_theta_3_i = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta_i
        + inverse_pivot_coupler2_theta_i*n_B2_x__coupler2_theta;
    lin->lu[32] = l_B2_x__coupler2_theta;
    lin->lu[33] = l_B2_x__coupler2_theta_3_i;
    const double l_B2_y__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta
        - inverse_pivot_coupler2_theta_i*n_B2_y__coupler2_theta_i;
    const double l_B2_y__coupler2_theta_3_i = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta_i
        + inverse_pivot_coupler2_theta_i*n_B2_y__coupler2_theta;
    lin->lu[34] = l_B2_y__coupler2_theta;
    lin->lu[35] = l_B2_y__coupler2_theta_3_i;
    const double scale_crank1_theta = -l_crank1_theta__coupler2_theta*n_coupler2_theta__crank1_theta
        + l_crank1_theta__coupler2_theta_3_i*n_coupler2_theta__crank1_theta_i + n_crank1_theta__crank1_theta;
    const double scale_crank1_theta_i = -l_crank1_theta__coupler2_theta*n_coupler2_theta__crank1_theta_i
        - l_crank1_theta__coupler2_theta_3_i*n_coupler2_theta__crank1_theta + n_crank1_theta__crank1_theta_i;
    const double size_9 = fabs(scale_crank1_theta) + fabs(scale_crank1_theta_i);
    const double size_10 = fabs(n_crank1_theta__crank1_theta) + fabs(n_crank1_theta__crank1_theta_i);
    if (!(size_9 > SINGULAR * size_10))
        return 2;
    const double divisor_8 = 1.0/((scale_crank1_theta * scale_crank1_theta)
        + (scale_crank1_theta_i * scale_crank1_theta_i));
    const double inverse_pivot_crank1_theta = divisor_8*scale_crank1_theta;
    const double inverse_pivot_crank1_theta_3_i = -divisor_8*scale_crank1_theta_i;
    lin->lu[36] = inverse_pivot_crank1_theta;
    lin->lu[37] = inverse_pivot_crank1_theta_3_i;
    const double factor_41 = -l_B2_x__coupler2_theta*n_coupler2_theta__crank1_theta
        + l_B2_x__coupler2_theta_3_i*n_coupler2_theta__crank1_theta_i + n_B2_x__crank1_theta;
    const double factor_42 = -l_B2_x__coupler2_theta*n_coupler2_theta__crank1_theta_i
        - l_B2_x__coupler2_theta_3_i*n_coupler2_theta__crank1_theta + n_B2_x__crank1_theta_i;
    const double l_B2_x__crank1_theta = factor_41*inverse_pivot_crank1_theta - factor_42*inverse_pivot_crank1_theta_3_i;
    const double l_B2_x__crank1_theta_2_i = factor_41*inverse_pivot_crank1_theta_3_i
        + factor_42*inverse_pivot_crank1_theta;
    lin->lu[38] = l_B2_x__crank1_theta;
    lin->lu[39] = l_B2_x__crank1_theta_2_i;
    const double u_crank1_theta__B2_x = -l_crank1_theta__coupler2_theta*phi_B2_x_coupler2_theta + phi_B2_x_crank1_theta;
    const double u_crank1_theta__B2_x_i = -l_crank1_theta__coupler2_theta_3_i*phi_B2_x_coupler2_theta;
    lin->lu[40] = u_crank1_theta__B2_x;
    lin->lu[41] = u_crank1_theta__B2_x_i;
    const double factor_43 = -l_B2_y__coupler2_theta*n_coupler2_theta__crank1_theta
        + l_B2_y__coupler2_theta_3_i*n_coupler2_theta__crank1_theta_i + n_B2_y__crank1_theta;
    const double factor_44 = -l_B2_y__coupler2_theta*n_coupler2_theta__crank1_theta_i
        - l_B2_y__coupler2_theta_3_i*n_coupler2_theta__crank1_theta + n_B2_y__crank1_theta_i;
    const double l_B2_y__crank1_theta = factor_43*inverse_pivot_crank1_theta - factor_44*inverse_pivot_crank1_theta_3_i;
    const double l_B2_y__crank1_theta_2_i = factor_43*inverse_pivot_crank1_theta_3_i
        + factor_44*inverse_pivot_crank1_theta;
    lin->lu[42] = l_B2_y__crank1_theta;
    lin->lu[43] = l_B2_y__crank1_theta_2_i;
    const double u_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*phi_B2_y_coupler2_theta + phi_B2_y_crank1_theta;
    const double u_crank1_theta__B2_y_i = -l_crank1_theta__coupler2_theta_3_i*phi_B2_y_coupler2_theta;
    lin->lu[44] = u_crank1_theta__B2_y;
    lin->lu[45] = u_crank1_theta__B2_y_i;
    const double l_B1_x__crank1_theta = inverse_pivot_crank1_theta*n_B1_x__crank1_theta
        - inverse_pivot_crank1_theta_3_i*n_B1_x__crank1_theta_i;
    const double l_B1_x__crank1_theta_3_i = inverse_pivot_crank1_theta*n_B1_x__crank1_theta_i
        + inverse_pivot_crank1_theta_3_i*n_B1_x__crank1_theta;
    lin->lu[46] = l_B1_x__crank1_theta;
    lin->lu[47] = l_B1_x__crank1_theta_3_i;
    const double l_B1_y__crank1_theta = inverse_pivot_crank1_theta*n_B1_y__crank1_theta
        - inverse_pivot_crank1_theta_3_i*n_B1_y__crank1_theta_i;
    const double l_B1_y__crank1_theta_3_i = inverse_pivot_crank1_theta*n_B1_y__crank1_theta_i
        + inverse_pivot_crank1_theta_3_i*n_B1_y__crank1_theta;
    lin->lu[48] = l_B1_y__crank1_theta;
    lin->lu[49] = l_B1_y__crank1_theta_3_i;
    const double scale_B2_x = -l_B2_x__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_x + l_B2_x__crank1_theta_2_i*u_crank1_theta__B2_x_i
        - l_B2_x__crank2_theta*phi_B2_x_crank2_theta;
    const double scale_B2_x_3_i = -l_B2_x__coupler2_theta_3_i*phi_B2_x_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_x_i - l_B2_x__crank1_theta_2_i*u_crank1_theta__B2_x
        - l_B2_x__crank2_theta_3_i*phi_B2_x_crank2_theta;
    const double size_11 = fabs(scale_B2_x) + fabs(scale_B2_x_3_i);
    if (!(size_11 > 0.0 && size_11 < INFINITY))
        return 6;
    const double divisor_9 = 1.0/((scale_B2_x * scale_B2_x) + (scale_B2_x_3_i * scale_B2_x_3_i));
    const double inverse_pivot_B2_x = divisor_9*scale_B2_x;
    const double inverse_pivot_B2_x_3_i = -divisor_9*scale_B2_x_3_i;
    lin->lu[50] = inverse_pivot_B2_x;
    lin->lu[51] = inverse_pivot_B2_x_3_i;
    const double factor_45 = -l_B2_y__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_x + l_B2_y__crank1_theta_2_i*u_crank1_theta__B2_x_i
        - l_B2_y__crank2_theta*phi_B2_x_crank2_theta;
    const double factor_46 = -l_B2_y__coupler2_theta_3_i*phi_B2_x_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_x_i - l_B2_y__crank1_theta_2_i*u_crank1_theta__B2_x
        - l_B2_y__crank2_theta_3_i*phi_B2_x_crank2_theta;
    const double l_B2_y__B2_x = factor_45*inverse_pivot_B2_x - factor_46*inverse_pivot_B2_x_3_i;
    const double l_B2_y__B2_x_i = factor_45*inverse_pivot_B2_x_3_i + factor_46*inverse_pivot_B2_x;
    lin->lu[52] = l_B2_y__B2_x;
    lin->lu[53] = l_B2_y__B2_x_i;
    const double u_B2_x__B2_y = -l_B2_x__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_y + l_B2_x__crank1_theta_2_i*u_crank1_theta__B2_y_i
        - l_B2_x__crank2_theta*phi_B2_y_crank2_theta;
    const double u_B2_x__B2_y_i = -l_B2_x__coupler2_theta_3_i*phi_B2_y_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_y_i - l_B2_x__crank1_theta_2_i*u_crank1_theta__B2_y
        - l_B2_x__crank2_theta_3_i*phi_B2_y_crank2_theta;
    lin->lu[54] = u_B2_x__B2_y;
    lin->lu[55] = u_B2_x__B2_y_i;
    const double factor_47 = inverse_pivot_B2_x*l_B1_x__crank1_theta - inverse_pivot_B2_x_3_i*l_B1_x__crank1_theta_3_i;
    const double factor_48 = inverse_pivot_B2_x*l_B1_x__crank1_theta_3_i + inverse_pivot_B2_x_3_i*l_B1_x__crank1_theta;
    const double l_B1_x__B2_x = -factor_47*u_crank1_theta__B2_x + factor_48*u_crank1_theta__B2_x_i;
    const double l_B1_x__B2_x_2_i = -factor_47*u_crank1_theta__B2_x_i - factor_48*u_crank1_theta__B2_x;
    lin->lu[56] = l_B1_x__B2_x;
    lin->lu[57] = l_B1_x__B2_x_2_i;
    const double u_B2_x__B1_x = l_B2_x__crank1_theta*phi_B2_x_crank1_theta;
    const double u_B2_x__B1_x_i = l_B2_x__crank1_theta_2_i*phi_B2_x_crank1_theta;
    lin->lu[58] = u_B2_x__B1_x;
    lin->lu[59] = u_B2_x__B1_x_i;
    const double factor_49 = inverse_pivot_B2_x*l_B1_y__crank1_theta - inverse_pivot_B2_x_3_i*l_B1_y__crank1_theta_3_i;
    const double factor_50 = inverse_pivot_B2_x*l_B1_y__crank1_theta_3_i + inverse_pivot_B2_x_3_i*l_B1_y__crank1_theta;
    const double l_B1_y__B2_x = -factor_49*u_crank1_theta__B2_x + factor_50*u_crank1_theta__B2_x_i;
    const double l_B1_y__B2_x_2_i = -factor_49*u_crank1_theta__B2_x_i - factor_50*u_crank1_theta__B2_x;
    lin->lu[60] = l_B1_y__B2_x;
    lin->lu[61] = l_B1_y__B2_x_2_i;
    const double u_B2_x__B1_y = l_B2_x__crank1_theta*phi_B2_y_crank1_theta;
    const double u_B2_x__B1_y_i = l_B2_x__crank1_theta_2_i*phi_B2_y_crank1_theta;
    lin->lu[62] = u_B2_x__B1_y;
    lin->lu[63] = u_B2_x__B1_y_i;
    const double scale_B2_y = -l_B2_y__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_y + l_B2_y__crank1_theta_2_i*u_crank1_theta__B2_y_i
        - l_B2_y__crank2_theta*phi_B2_y_crank2_theta;
    const double scale_B2_y_3_i = -l_B2_y__coupler2_theta_3_i*phi_B2_y_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_y_i - l_B2_y__crank1_theta_2_i*u_crank1_theta__B2_y
        - l_B2_y__crank2_theta_3_i*phi_B2_y_crank2_theta;
    const double pivot_B2_y = -l_B2_y__B2_x*u_B2_x__B2_y + l_B2_y__B2_x_i*u_B2_x__B2_y_i + scale_B2_y;
    const double pivot_B2_y_i = -l_B2_y__B2_x*u_B2_x__B2_y_i - l_B2_y__B2_x_i*u_B2_x__B2_y + scale_B2_y_3_i;
    const double size_12 = fabs(pivot_B2_y) + fabs(pivot_B2_y_i);
    const double size_13 = fabs(scale_B2_y) + fabs(scale_B2_y_3_i);
    if (!(size_12 > SINGULAR * size_13))
        return 7;
    const double divisor_10 = 1.0/((pivot_B2_y * pivot_B2_y) + (pivot_B2_y_i * pivot_B2_y_i));
    const double inverse_pivot_B2_y = divisor_10*pivot_B2_y;
    const double inverse_pivot_B2_y_3_i = -divisor_10*pivot_B2_y_i;
    lin->lu[64] = inverse_pivot_B2_y;
    lin->lu[65] = inverse_pivot_B2_y_3_i;
    const double factor_51 = -l_B1_x__B2_x*u_B2_x__B2_y + l_B1_x__B2_x_2_i*u_B2_x__B2_y_i
        - l_B1_x__crank1_theta*u_crank1_theta__B2_y + l_B1_x__crank1_theta_3_i*u_crank1_theta__B2_y_i;
    const double factor_52 = -l_B1_x__B2_x*u_B2_x__B2_y_i - l_B1_x__B2_x_2_i*u_B2_x__B2_y
        - l_B1_x__crank1_theta*u_crank1_theta__B2_y_i - l_B1_x__crank1_theta_3_i*u_crank1_theta__B2_y;
    const double l_B1_x__B2_y = factor_51*inverse_pivot_B2_y - factor_52*inverse_pivot_B2_y_3_i;
    const double l_B1_x__B2_y_2_i = factor_51*inverse_pivot_B2_y_3_i + factor_52*inverse_pivot_B2_y;
    lin->lu[66] = l_B1_x__B2_y;
    lin->lu[67] = l_B1_x__B2_y_2_i;
    const double u_B2_y__B1_x = -l_B2_y__B2_x*u_B2_x__B1_x + l_B2_y__B2_x_i*u_B2_x__B1_x_i
        + l_B2_y__crank1_theta*phi_B2_x_crank1_theta;
    const double u_B2_y__B1_x_i = -l_B2_y__B2_x*u_B2_x__B1_x_i - l_B2_y__B2_x_i*u_B2_x__B1_x
        + l_B2_y__crank1_theta_2_i*phi_B2_x_crank1_theta;
    lin->lu[68] = u_B2_y__B1_x;
    lin->lu[69] = u_B2_y__B1_x_i;
    const double factor_53 = -l_B1_y__B2_x*u_B2_x__B2_y + l_B1_y__B2_x_2_i*u_B2_x__B2_y_i
        - l_B1_y__crank1_theta*u_crank1_theta__B2_y + l_B1_y__crank1_theta_3_i*u_crank1_theta__B2_y_i;
    const double factor_54 = -l_B1_y__B2_x*u_B2_x__B2_y_i - l_B1_y__B2_x_2_i*u_B2_x__B2_y
        - l_B1_y__crank1_theta*u_crank1_theta__B2_y_i - l_B1_y__crank1_theta_3_i*u_crank1_theta__B2_y;
    const double l_B1_y__B2_y = factor_53*inverse_pivot_B2_y - factor_54*inverse_pivot_B2_y_3_i;
    const double l_B1_y__B2_y_2_i = factor_53*inverse_pivot_B2_y_3_i + factor_54*inverse_pivot_B2_y;
    lin->lu[70] = l_B1_y__B2_y;
    lin->lu[71] = l_B1_y__B2_y_2_i;
    const double u_B2_y__B1_y = -l_B2_y__B2_x*u_B2_x__B1_y + l_B2_y__B2_x_i*u_B2_x__B1_y_i
        + l_B2_y__crank1_theta*phi_B2_y_crank1_theta;
    const double u_B2_y__B1_y_i = -l_B2_y__B2_x*u_B2_x__B1_y_i - l_B2_y__B2_x_i*u_B2_x__B1_y
        + l_B2_y__crank1_theta_2_i*phi_B2_y_crank1_theta;
    lin->lu[72] = u_B2_y__B1_y;
    lin->lu[73] = u_B2_y__B1_y_i;
    const double scale_B1_x = -l_B1_x__coupler1_theta*u_coupler1_theta__B1_x
        + l_B1_x__coupler1_theta_3_i*u_coupler1_theta__B1_x_i - l_B1_x__crank0_theta*phi_B1_x_crank0_theta
        + l_B1_x__crank1_theta*phi_B2_x_crank1_theta;
    const double scale_B1_x_3_i = -l_B1_x__coupler1_theta*u_coupler1_theta__B1_x_i
        - l_B1_x__coupler1_theta_3_i*u_coupler1_theta__B1_x - l_B1_x__crank0_theta_3_i*phi_B1_x_crank0_theta
        + l_B1_x__crank1_theta_3_i*phi_B2_x_crank1_theta;
    const double pivot_B1_x = -l_B1_x__B2_x*u_B2_x__B1_x + l_B1_x__B2_x_2_i*u_B2_x__B1_x_i - l_B1_x__B2_y*u_B2_y__B1_x
        + l_B1_x__B2_y_2_i*u_B2_y__B1_x_i + scale_B1_x;
    const double pivot_B1_x_2_i = -l_B1_x__B2_x*u_B2_x__B1_x_i - l_B1_x__B2_x_2_i*u_B2_x__B1_x
        - l_B1_x__B2_y*u_B2_y__B1_x_i - l_B1_x__B2_y_2_i*u_B2_y__B1_x + scale_B1_x_3_i;
    const double size_14 = fabs(pivot_B1_x) + fabs(pivot_B1_x_2_i);
    const double size_15 = fabs(scale_B1_x) + fabs(scale_B1_x_3_i);
    if (!(size_14 > SINGULAR * size_15))
        return 8;
    const double divisor_11 = 1.0/((pivot_B1_x * pivot_B1_x) + (pivot_B1_x_2_i * pivot_B1_x_2_i));
    const double inverse_pivot_B1_x = divisor_11*pivot_B1_x;
    const double inverse_pivot_B1_x_3_i = -divisor_11*pivot_B1_x_2_i;
    lin->lu[74] = inverse_pivot_B1_x;
    lin->lu[75] = inverse_pivot_B1_x_3_i;
    const double factor_55 = -l_B1_y__B2_x*u_B2_x__B1_x + l_B1_y__B2_x_2_i*u_B2_x__B1_x_i - l_B1_y__B2_y*u_B2_y__B1_x
        + l_B1_y__B2_y_2_i*u_B2_y__B1_x_i - l_B1_y__coupler1_theta*u_coupler1_theta__B1_x
        + l_B1_y__coupler1_theta_3_i*u_coupler1_theta__B1_x_i - l_B1_y__crank0_theta*phi_B1_x_crank0_theta
        + l_B1_y__crank1_theta*phi_B2_x_crank1_theta;
    const double factor_56 = -l_B1_y__B2_x*u_B2_x__B1_x_i - l_B1_y__B2_x_2_i*u_B2_x__B1_x - l_B1_y__B2_y*u_B2_y__B1_x_i
        - l_B1_y__B2_y_2_i*u_B2_y__B1_x - l_B1_y__coupler1_theta*u_coupler1_theta__B1_x_i
        - l_B1_y__coupler1_theta_3_i*u_coupler1_theta__B1_x - l_B1_y__crank0_theta_3_i*phi_B1_x_crank0_theta
        + l_B1_y__crank1_theta_3_i*phi_B2_x_crank1_theta;
    const double l_B1_y__B1_x = factor_55*inverse_pivot_B1_x - factor_56*inverse_pivot_B1_x_3_i;
    const double l_B1_y__B1_x_i = factor_55*inverse_pivot_B1_x_3_i + factor_56*inverse_pivot_B1_x;
    lin->lu[76] = l_B1_y__B1_x;
    lin->lu[77] = l_B1_y__B1_x_i;
    const double u_B1_x__B1_y = -l_B1_x__B2_x*u_B2_x__B1_y + l_B1_x__B2_x_2_i*u_B2_x__B1_y_i
        - l_B1_x__B2_y*u_B2_y__B1_y + l_B1_x__B2_y_2_i*u_B2_y__B1_y_i - l_B1_x__coupler1_theta*u_coupler1_theta__B1_y
        + l_B1_x__coupler1_theta_3_i*u_coupler1_theta__B1_y_i - l_B1_x__crank0_theta*phi_B1_y_crank0_theta
        + l_B1_x__crank1_theta*phi_B2_y_crank1_theta;
    const double u_B1_x__B1_y_i = -l_B1_x__B2_x*u_B2_x__B1_y_i - l_B1_x__B2_x_2_i*u_B2_x__B1_y
        - l_B1_x__B2_y*u_B2_y__B1_y_i - l_B1_x__B2_y_2_i*u_B2_y__B1_y - l_B1_x__coupler1_theta*u_coupler1_theta__B1_y_i
        - l_B1_x__coupler1_theta_3_i*u_coupler1_theta__B1_y - l_B1_x__crank0_theta_3_i*phi_B1_y_crank0_theta
        + l_B1_x__crank1_theta_3_i*phi_B2_y_crank1_theta;
    lin->lu[78] = u_B1_x__B1_y;
    lin->lu[79] = u_B1_x__B1_y_i;
    const double scale_B1_y = -l_B1_y__coupler1_theta*u_coupler1_theta__B1_y
        + l_B1_y__coupler1_theta_3_i*u_coupler1_theta__B1_y_i - l_B1_y__crank0_theta*phi_B1_y_crank0_theta
        + l_B1_y__crank1_theta*phi_B2_y_crank1_theta;
    const double scale_B1_y_3_i = -l_B1_y__coupler1_theta*u_coupler1_theta__B1_y_i
        - l_B1_y__coupler1_theta_3_i*u_coupler1_theta__B1_y - l_B1_y__crank0_theta_3_i*phi_B1_y_crank0_theta
        + l_B1_y__crank1_theta_3_i*phi_B2_y_crank1_theta;
    const double pivot_B1_y = -l_B1_y__B1_x*u_B1_x__B1_y + l_B1_y__B1_x_i*u_B1_x__B1_y_i - l_B1_y__B2_x*u_B2_x__B1_y
        + l_B1_y__B2_x_2_i*u_B2_x__B1_y_i - l_B1_y__B2_y*u_B2_y__B1_y + l_B1_y__B2_y_2_i*u_B2_y__B1_y_i + scale_B1_y;
    const double pivot_B1_y_2_i = -l_B1_y__B1_x*u_B1_x__B1_y_i - l_B1_y__B1_x_i*u_B1_x__B1_y
        - l_B1_y__B2_x*u_B2_x__B1_y_i - l_B1_y__B2_x_2_i*u_B2_x__B1_y - l_B1_y__B2_y*u_B2_y__B1_y_i
        - l_B1_y__B2_y_2_i*u_B2_y__B1_y + scale_B1_y_3_i;
    const double size_16 = fabs(pivot_B1_y) + fabs(pivot_B1_y_2_i);
    const double size_17 = fabs(scale_B1_y) + fabs(scale_B1_y_3_i);
    if (!(size_16 > SINGULAR * size_17))
        return 9;
    const double divisor_12 = 1.0/((pivot_B1_y * pivot_B1_y) + (pivot_B1_y_2_i * pivot_B1_y_2_i));
    const double inverse_pivot_B1_y = divisor_12*pivot_B1_y;
    const double inverse_pivot_B1_y_3_i = -divisor_12*pivot_B1_y_2_i;
    lin->lu[80] = inverse_pivot_B1_y;
    lin->lu[81] = inverse_pivot_B1_y_3_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double inverse_pivot_crank2_theta = lin->lu[0];
    const double inverse_pivot_crank2_theta_i = lin->lu[1];
    const double l_B2_x__crank2_theta = lin->lu[2];
    const double l_B2_x__crank2_theta_3_i = lin->lu[3];
    const double l_B2_y__crank2_theta = lin->lu[4];
    const double l_B2_y__crank2_theta_3_i = lin->lu[5];
    const double inverse_pivot_crank0_theta = lin->lu[6];
    const double inverse_pivot_crank0_theta_i = lin->lu[7];
    const double l_coupler1_theta__crank0_theta = lin->lu[8];
    const double l_coupler1_theta__crank0_theta_3_i = lin->lu[9];
    const double n_crank0_theta__coupler1_theta = lin->lu[10];
    const double n_crank0_theta__coupler1_theta_i = lin->lu[11];
    const double l_B1_x__crank0_theta = lin->lu[12];
    const double l_B1_x__crank0_theta_3_i = lin->lu[13];
    const double l_B1_y__crank0_theta = lin->lu[14];
    const double l_B1_y__crank0_theta_3_i = lin->lu[15];
    const double inverse_pivot_coupler1_theta = lin->lu[16];
    const double inverse_pivot_coupler1_theta_3_i = lin->lu[17];
    const double l_B1_x__coupler1_theta = lin->lu[18];
    const double l_B1_x__coupler1_theta_3_i = lin->lu[19];
    const double u_coupler1_theta__B1_x = lin->lu[20];
    const double u_coupler1_theta__B1_x_i = lin->lu[21];
    const double l_B1_y__coupler1_theta = lin->lu[22];
    const double l_B1_y__coupler1_theta_3_i = lin->lu[23];
    const double u_coupler1_theta__B1_y = lin->lu[24];
    const double u_coupler1_theta__B1_y_i = lin->lu[25];
    const double inverse_pivot_coupler2_theta = lin->lu[26];
    const double inverse_pivot_coupler2_theta_i = lin->lu[27];
    const double l_crank1_theta__coupler2_theta = lin->lu[28];
    const double l_crank1_theta__coupler2_theta_3_i = lin->lu[29];
    const double n_coupler2_theta__crank1_theta = lin->lu[30];
    const double n_coupler2_theta__crank1_theta_i = lin->lu[31];
    const double l_B2_x__coupler2_theta = lin->lu[32];
    const double l_B2_x__coupler2_theta_3_i = lin->lu[33];
    const double l_B2_y__coupler2_theta = lin->lu[34];
    const double l_B2_y__coupler2_theta_3_i = lin->lu[35];
    const double inverse_pivot_crank1_theta = lin->lu[36];
    const double inverse_pivot_crank1_theta_3_i = lin->lu[37];
    const double l_B2_x__crank1_theta = lin->lu[38];
    const double l_B2_x__crank1_theta_2_i = lin->lu[39];
    const double u_crank1_theta__B2_x = lin->lu[40];
    const double u_crank1_theta__B2_x_i = lin->lu[41];
    const double l_B2_y__crank1_theta = lin->lu[42];
    const double l_B2_y__crank1_theta_2_i = lin->lu[43];
    const double u_crank1_theta__B2_y = lin->lu[44];
    const double u_crank1_theta__B2_y_i = lin->lu[45];
    const double l_B1_x__crank1_theta = lin->lu[46];
    const double l_B1_x__crank1_theta_3_i = lin->lu[47];
    const double l_B1_y__crank1_theta = lin->lu[48];
    const double l_B1_y__crank1_theta_3_i = lin->lu[49];
    const double inverse_pivot_B2_x = lin->lu[50];
    const double inverse_pivot_B2_x_3_i = lin->lu[51];
    const double l_B2_y__B2_x = lin->lu[52];
    const double l_B2_y__B2_x_i = lin->lu[53];
    const double u_B2_x__B2_y = lin->lu[54];
    const double u_B2_x__B2_y_i = lin->lu[55];
    const double l_B1_x__B2_x = lin->lu[56];
    const double l_B1_x__B2_x_2_i = lin->lu[57];
    const double u_B2_x__B1_x = lin->lu[58];
    const double u_B2_x__B1_x_i = lin->lu[59];
    const double l_B1_y__B2_x = lin->lu[60];
    const double l_B1_y__B2_x_2_i = lin->lu[61];
    const double u_B2_x__B1_y = lin->lu[62];
    const double u_B2_x__B1_y_i = lin->lu[63];
    const double inverse_pivot_B2_y = lin->lu[64];
    const double inverse_pivot_B2_y_3_i = lin->lu[65];
    const double l_B1_x__B2_y = lin->lu[66];
    const double l_B1_x__B2_y_2_i = lin->lu[67];
    const double u_B2_y__B1_x = lin->lu[68];
    const double u_B2_y__B1_x_i = lin->lu[69];
    const double l_B1_y__B2_y = lin->lu[70];
    const double l_B1_y__B2_y_2_i = lin->lu[71];
    const double u_B2_y__B1_y = lin->lu[72];
    const double u_B2_y__B1_y_i = lin->lu[73];
    const double inverse_pivot_B1_x = lin->lu[74];
    const double inverse_pivot_B1_x_3_i = lin->lu[75];
    const double l_B1_y__B1_x = lin->lu[76];
    const double l_B1_y__B1_x_i = lin->lu[77];
    const double u_B1_x__B1_y = lin->lu[78];
    const double u_B1_x__B1_y_i = lin->lu[79];
    const double inverse_pivot_B1_y = lin->lu[80];
    const double inverse_pivot_B1_y_3_i = lin->lu[81];

    /* forward */
    const double b_crank2_theta = x[4];
    const double b_crank2_theta_i = x[5];
    const double b_crank0_theta = x[0];
    const double b_crank0_theta_i = x[1];
    const double b_coupler1_theta = -b_crank0_theta*l_coupler1_theta__crank0_theta
        + b_crank0_theta_i*l_coupler1_theta__crank0_theta_3_i + x[6];
    const double b_coupler1_theta_i = -b_crank0_theta*l_coupler1_theta__crank0_theta_3_i
        - b_crank0_theta_i*l_coupler1_theta__crank0_theta + x[7];
    const double b_coupler2_theta = x[8];
    const double b_coupler2_theta_i = x[9];
    const double b_crank1_theta = -b_coupler2_theta*l_crank1_theta__coupler2_theta
        + b_coupler2_theta_i*l_crank1_theta__coupler2_theta_3_i + x[2];
    const double b_crank1_theta_i = -b_coupler2_theta*l_crank1_theta__coupler2_theta_3_i
        - b_coupler2_theta_i*l_crank1_theta__coupler2_theta + x[3];
    const double b_B2_x = -b_coupler2_theta*l_B2_x__coupler2_theta + b_coupler2_theta_i*l_B2_x__coupler2_theta_3_i
        - b_crank1_theta*l_B2_x__crank1_theta + b_crank1_theta_i*l_B2_x__crank1_theta_2_i
        - b_crank2_theta*l_B2_x__crank2_theta + b_crank2_theta_i*l_B2_x__crank2_theta_3_i + x[10];
    const double b_B2_x_i = -b_coupler2_theta*l_B2_x__coupler2_theta_3_i - b_coupler2_theta_i*l_B2_x__coupler2_theta
        - b_crank1_theta*l_B2_x__crank1_theta_2_i - b_crank1_theta_i*l_B2_x__crank1_theta
        - b_crank2_theta*l_B2_x__crank2_theta_3_i - b_crank2_theta_i*l_B2_x__crank2_theta + x[11];
    const double b_B2_y = -b_B2_x*l_B2_y__B2_x + b_B2_x_i*l_B2_y__B2_x_i - b_coupler2_theta*l_B2_y__coupler2_theta
        + b_coupler2_theta_i*l_B2_y__coupler2_theta_3_i - b_crank1_theta*l_B2_y__crank1_theta
        + b_crank1_theta_i*l_B2_y__crank1_theta_2_i - b_crank2_theta*l_B2_y__crank2_theta
        + b_crank2_theta_i*l_B2_y__crank2_theta_3_i + x[12];
    const double b_B2_y_i = -b_B2_x*l_B2_y__B2_x_i - b_B2_x_i*l_B2_y__B2_x
        - b_coupler2_theta*l_B2_y__coupler2_theta_3_i - b_coupler2_theta_i*l_B2_y__coupler2_theta
        - b_crank1_theta*l_B2_y__crank1_theta_2_i - b_crank1_theta_i*l_B2_y__crank1_theta
        - b_crank2_theta*l_B2_y__crank2_theta_3_i - b_crank2_theta_i*l_B2_y__crank2_theta + x[13];
    const double b_B1_x = -b_B2_x*l_B1_x__B2_x + b_B2_x_i*l_B1_x__B2_x_2_i - b_B2_y*l_B1_x__B2_y
        + b_B2_y_i*l_B1_x__B2_y_2_i - b_coupler1_theta*l_B1_x__coupler1_theta
        + b_coupler1_theta_i*l_B1_x__coupler1_theta_3_i - b_crank0_theta*l_B1_x__crank0_theta
        + b_crank0_theta_i*l_B1_x__crank0_theta_3_i - b_crank1_theta*l_B1_x__crank1_theta
        + b_crank1_theta_i*l_B1_x__crank1_theta_3_i + x[14];
    const double b_B1_x_i = -b_B2_x*l_B1_x__B2_x_2_i - b_B2_x_i*l_B1_x__B2_x - b_B2_y*l_B1_x__B2_y_2_i
        - b_B2_y_i*l_B1_x__B2_y - b_coupler1_theta*l_B1_x__coupler1_theta_3_i
        - b_coupler1_theta_i*l_B1_x__coupler1_theta - b_crank0_theta*l_B1_x__crank0_theta_3_i
        - b_crank0_theta_i*l_B1_x__crank0_theta - b_crank1_theta*l_B1_x__crank1_theta_3_i
        - b_crank1_theta_i*l_B1_x__crank1_theta + x[15];
    const double b_B1_y = -b_B1_x*l_B1_y__B1_x + b_B1_x_i*l_B1_y__B1_x_i - b_B2_x*l_B1_y__B2_x
        + b_B2_x_i*l_B1_y__B2_x_2_i - b_B2_y*l_B1_y__B2_y + b_B2_y_i*l_B1_y__B2_y_2_i
        - b_coupler1_theta*l_B1_y__coupler1_theta + b_coupler1_theta_i*l_B1_y__coupler1_theta_3_i
        - b_crank0_theta*l_B1_y__crank0_theta + b_crank0_theta_i*l_B1_y__crank0_theta_3_i
        - b_crank1_theta*l_B1_y__crank1_theta + b_crank1_theta_i*l_B1_y__crank1_theta_3_i + x[16];
    const double b_B1_y_i = -b_B1_x*l_B1_y__B1_x_i - b_B1_x_i*l_B1_y__B1_x - b_B2_x*l_B1_y__B2_x_2_i
        - b_B2_x_i*l_B1_y__B2_x - b_B2_y*l_B1_y__B2_y_2_i - b_B2_y_i*l_B1_y__B2_y
        - b_coupler1_theta*l_B1_y__coupler1_theta_3_i - b_coupler1_theta_i*l_B1_y__coupler1_theta
        - b_crank0_theta*l_B1_y__crank0_theta_3_i - b_crank0_theta_i*l_B1_y__crank0_theta
        - b_crank1_theta*l_B1_y__crank1_theta_3_i - b_crank1_theta_i*l_B1_y__crank1_theta + x[17];

    /* backward */
    const double x_B1_y = b_B1_y*inverse_pivot_B1_y - b_B1_y_i*inverse_pivot_B1_y_3_i;
    const double x_B1_y_i = b_B1_y*inverse_pivot_B1_y_3_i + b_B1_y_i*inverse_pivot_B1_y;
    x[16] = x_B1_y;
    x[17] = x_B1_y_i;
    const double factor_1 = b_B1_x - u_B1_x__B1_y*x_B1_y + u_B1_x__B1_y_i*x_B1_y_i;
    const double factor_2 = b_B1_x_i - u_B1_x__B1_y*x_B1_y_i - u_B1_x__B1_y_i*x_B1_y;
    const double x_B1_x = factor_1*inverse_pivot_B1_x - factor_2*inverse_pivot_B1_x_3_i;
    const double x_B1_x_i = factor_1*inverse_pivot_B1_x_3_i + factor_2*inverse_pivot_B1_x;
    x[14] = x_B1_x;
    x[15] = x_B1_x_i;
    const double factor_3 = b_B2_y - u_B2_y__B1_x*x_B1_x + u_B2_y__B1_x_i*x_B1_x_i - u_B2_y__B1_y*x_B1_y
        + u_B2_y__B1_y_i*x_B1_y_i;
    const double factor_4 = b_B2_y_i - u_B2_y__B1_x*x_B1_x_i - u_B2_y__B1_x_i*x_B1_x - u_B2_y__B1_y*x_B1_y_i
        - u_B2_y__B1_y_i*x_B1_y;
    const double x_B2_y = factor_3*inverse_pivot_B2_y - factor_4*inverse_pivot_B2_y_3_i;
    const double x_B2_y_i = factor_3*inverse_pivot_B2_y_3_i + factor_4*inverse_pivot_B2_y;
    x[12] = x_B2_y;
    x[13] = x_B2_y_i;
    const double factor_5 = b_B2_x - u_B2_x__B1_x*x_B1_x + u_B2_x__B1_x_i*x_B1_x_i - u_B2_x__B1_y*x_B1_y
        + u_B2_x__B1_y_i*x_B1_y_i - u_B2_x__B2_y*x_B2_y + u_B2_x__B2_y_i*x_B2_y_i;
    const double factor_6 = b_B2_x_i - u_B2_x__B1_x*x_B1_x_i - u_B2_x__B1_x_i*x_B1_x - u_B2_x__B1_y*x_B1_y_i
        - u_B2_x__B1_y_i*x_B1_y - u_B2_x__B2_y*x_B2_y_i - u_B2_x__B2_y_i*x_B2_y;
    const double x_B2_x = factor_5*inverse_pivot_B2_x - factor_6*inverse_pivot_B2_x_3_i;
    const double x_B2_x_i = factor_5*inverse_pivot_B2_x_3_i + factor_6*inverse_pivot_B2_x;
    x[10] = x_B2_x;
    x[11] = x_B2_x_i;
    const double factor_7 = b_crank1_theta + phi_B2_x_crank1_theta*x_B1_x + phi_B2_y_crank1_theta*x_B1_y
        - u_crank1_theta__B2_x*x_B2_x + u_crank1_theta__B2_x_i*x_B2_x_i - u_crank1_theta__B2_y*x_B2_y
        + u_crank1_theta__B2_y_i*x_B2_y_i;
    const double factor_8 = b_crank1_theta_i + phi_B2_x_crank1_theta*x_B1_x_i + phi_B2_y_crank1_theta*x_B1_y_i
        - u_crank1_theta__B2_x*x_B2_x_i - u_crank1_theta__B2_x_i*x_B2_x - u_crank1_theta__B2_y*x_B2_y_i
        - u_crank1_theta__B2_y_i*x_B2_y;
    const double x_crank1_theta = factor_7*inverse_pivot_crank1_theta - factor_8*inverse_pivot_crank1_theta_3_i;
    const double x_crank1_theta_i = factor_7*inverse_pivot_crank1_theta_3_i + factor_8*inverse_pivot_crank1_theta;
    x[2] = x_crank1_theta;
    x[3] = x_crank1_theta_i;
    const double factor_9 = b_coupler2_theta - n_coupler2_theta__crank1_theta*x_crank1_theta
        + n_coupler2_theta__crank1_theta_i*x_crank1_theta_i - phi_B2_x_coupler2_theta*x_B2_x
        - phi_B2_y_coupler2_theta*x_B2_y;
    const double factor_10 = b_coupler2_theta_i - n_coupler2_theta__crank1_theta*x_crank1_theta_i
        - n_coupler2_theta__crank1_theta_i*x_crank1_theta - phi_B2_x_coupler2_theta*x_B2_x_i
        - phi_B2_y_coupler2_theta*x_B2_y_i;
    const double x_coupler2_theta = -factor_10*inverse_pivot_coupler2_theta_i + factor_9*inverse_pivot_coupler2_theta;
    const double x_coupler2_theta_i = factor_10*inverse_pivot_coupler2_theta + factor_9*inverse_pivot_coupler2_theta_i;
    x[8] = x_coupler2_theta;
    x[9] = x_coupler2_theta_i;
    const double factor_11 = b_coupler1_theta - u_coupler1_theta__B1_x*x_B1_x + u_coupler1_theta__B1_x_i*x_B1_x_i
        - u_coupler1_theta__B1_y*x_B1_y + u_coupler1_theta__B1_y_i*x_B1_y_i;
    const double factor_12 = b_coupler1_theta_i - u_coupler1_theta__B1_x*x_B1_x_i - u_coupler1_theta__B1_x_i*x_B1_x
        - u_coupler1_theta__B1_y*x_B1_y_i - u_coupler1_theta__B1_y_i*x_B1_y;
    const double x_coupler1_theta = factor_11*inverse_pivot_coupler1_theta - factor_12*inverse_pivot_coupler1_theta_3_i;
    const double x_coupler1_theta_i = factor_11*inverse_pivot_coupler1_theta_3_i
        + factor_12*inverse_pivot_coupler1_theta;
    x[6] = x_coupler1_theta;
    x[7] = x_coupler1_theta_i;
    const double factor_13 = b_crank0_theta - n_crank0_theta__coupler1_theta*x_coupler1_theta
        + n_crank0_theta__coupler1_theta_i*x_coupler1_theta_i - phi_B1_x_crank0_theta*x_B1_x
        - phi_B1_y_crank0_theta*x_B1_y;
    const double factor_14 = b_crank0_theta_i - n_crank0_theta__coupler1_theta*x_coupler1_theta_i
        - n_crank0_theta__coupler1_theta_i*x_coupler1_theta - phi_B1_x_crank0_theta*x_B1_x_i
        - phi_B1_y_crank0_theta*x_B1_y_i;
    const double x_crank0_theta = factor_13*inverse_pivot_crank0_theta - factor_14*inverse_pivot_crank0_theta_i;
    const double x_crank0_theta_i = factor_13*inverse_pivot_crank0_theta_i + factor_14*inverse_pivot_crank0_theta;
    x[0] = x_crank0_theta;
    x[1] = x_crank0_theta_i;
    const double factor_15 = b_crank2_theta - phi_B2_x_crank2_theta*x_B2_x - phi_B2_y_crank2_theta*x_B2_y;
    const double factor_16 = b_crank2_theta_i - phi_B2_x_crank2_theta*x_B2_x_i - phi_B2_y_crank2_theta*x_B2_y_i;
    const double x_crank2_theta = factor_15*inverse_pivot_crank2_theta - factor_16*inverse_pivot_crank2_theta_i;
    const double x_crank2_theta_i = factor_15*inverse_pivot_crank2_theta_i + factor_16*inverse_pivot_crank2_theta;
    x[4] = x_crank2_theta;
    x[5] = x_crank2_theta_i;
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
    const double mass_crank0_theta_coupler1_theta = lin->value[0];
    const double mass_crank1_theta_coupler2_theta = lin->value[1];
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_x_coupler1_theta = lin->value[9];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double phi_B1_y_coupler1_theta = lin->value[11];
    const double by_q_B2_x_coupler2_theta = lin->value[12];
    const double by_q_B2_x_crank1_theta = lin->value[13];
    const double by_q_B2_x_crank2_theta = lin->value[14];
    const double by_q_B2_y_coupler2_theta = lin->value[15];
    const double by_q_B2_y_crank1_theta = lin->value[16];
    const double by_q_B2_y_crank2_theta = lin->value[17];
    const double by_q_B1_x_coupler1_theta = lin->value[18];
    const double by_q_B1_x_crank0_theta = lin->value[19];
    const double by_q_B1_y_coupler1_theta = lin->value[20];
    const double by_q_B1_y_crank0_theta = lin->value[21];
    const double by_q_crank0_theta_crank0_theta = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta = lin->value[23];
    const double by_q_crank1_theta_crank1_theta = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta = lin->value[25];
    const double by_q_crank2_theta_crank2_theta = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta = lin->value[30];

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
    double x[18];
    const double shifted_crank0_theta = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[10];
    const double shifted_crank0_theta_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[11];
    const double shifted_crank1_theta = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[12];
    const double shifted_crank1_theta_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[13];
    const double shifted_crank2_theta = -p->beta_squared*(eta*r[4] - eta_i*r[5]) + r[14];
    const double shifted_crank2_theta_i = -p->beta_squared*(eta*r[5] + eta_i*r[4]) + r[15];
    const double shifted_coupler1_theta = -p->beta_squared*(eta*r[6] - eta_i*r[7]) + r[16];
    const double shifted_coupler1_theta_i = -p->beta_squared*(eta*r[7] + eta_i*r[6]) + r[17];
    const double shifted_coupler2_theta = -p->beta_squared*(eta*r[8] - eta_i*r[9]) + r[18];
    const double shifted_coupler2_theta_i = -p->beta_squared*(eta*r[9] + eta_i*r[8]) + r[19];
    const double factor_5 = -by_q_crank0_theta_coupler1_theta*(eta*r[6] - eta_i*r[7])
        - by_q_crank0_theta_crank0_theta*(eta*r[0] - eta_i*r[1]) + p->mass_crank0_crank0*r[10]
        + mass_crank0_theta_coupler1_theta*r[16];
    const double factor_6 = -by_q_crank0_theta_coupler1_theta*(eta*r[7] + eta_i*r[6])
        - by_q_crank0_theta_crank0_theta*(eta*r[1] + eta_i*r[0]) + p->mass_crank0_crank0*r[11]
        + mass_crank0_theta_coupler1_theta*r[17];
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = -by_q_crank1_theta_coupler2_theta*(eta*r[8] - eta_i*r[9])
        - by_q_crank1_theta_crank1_theta*(eta*r[2] - eta_i*r[3]) + p->mass_crank1_crank1*r[12]
        + mass_crank1_theta_coupler2_theta*r[18];
    const double factor_8 = -by_q_crank1_theta_coupler2_theta*(eta*r[9] + eta_i*r[8])
        - by_q_crank1_theta_crank1_theta*(eta*r[3] + eta_i*r[2]) + p->mass_crank1_crank1*r[13]
        + mass_crank1_theta_coupler2_theta*r[19];
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = -by_q_crank2_theta_crank2_theta*(eta*r[4] - eta_i*r[5]) + p->mass_crank2_crank2*r[14];
    const double factor_10 = -by_q_crank2_theta_crank2_theta*(eta*r[5] + eta_i*r[4]) + p->mass_crank2_crank2*r[15];
    x[4] = eta*factor_9 - eta_i*factor_10;
    x[5] = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = -by_q_coupler1_theta_coupler1_theta*(eta*r[6] - eta_i*r[7])
        - by_q_coupler1_theta_crank0_theta*(eta*r[0] - eta_i*r[1]) + p->mass_coupler1_coupler1*r[16]
        + mass_crank0_theta_coupler1_theta*r[10];
    const double factor_12 = -by_q_coupler1_theta_coupler1_theta*(eta*r[7] + eta_i*r[6])
        - by_q_coupler1_theta_crank0_theta*(eta*r[1] + eta_i*r[0]) + p->mass_coupler1_coupler1*r[17]
        + mass_crank0_theta_coupler1_theta*r[11];
    x[6] = eta*factor_11 - eta_i*factor_12;
    x[7] = eta*factor_12 + eta_i*factor_11;
    const double factor_13 = -by_q_coupler2_theta_coupler2_theta*(eta*r[8] - eta_i*r[9])
        - by_q_coupler2_theta_crank1_theta*(eta*r[2] - eta_i*r[3]) + p->mass_coupler2_coupler2*r[18]
        + mass_crank1_theta_coupler2_theta*r[12];
    const double factor_14 = -by_q_coupler2_theta_coupler2_theta*(eta*r[9] + eta_i*r[8])
        - by_q_coupler2_theta_crank1_theta*(eta*r[3] + eta_i*r[2]) + p->mass_coupler2_coupler2*r[19]
        + mass_crank1_theta_coupler2_theta*r[13];
    x[8] = eta*factor_13 - eta_i*factor_14;
    x[9] = eta*factor_14 + eta_i*factor_13;
    const double factor_15 = -by_q_B2_x_coupler2_theta*(eta*r[8] - eta_i*r[9])
        - by_q_B2_x_crank1_theta*(eta*r[2] - eta_i*r[3]) - by_q_B2_x_crank2_theta*(eta*r[4] - eta_i*r[5])
        + phi_B2_x_coupler2_theta*shifted_coupler2_theta + phi_B2_x_crank1_theta*shifted_crank1_theta
        + phi_B2_x_crank2_theta*shifted_crank2_theta;
    const double factor_16 = -by_q_B2_x_coupler2_theta*(eta*r[9] + eta_i*r[8])
        - by_q_B2_x_crank1_theta*(eta*r[3] + eta_i*r[2]) - by_q_B2_x_crank2_theta*(eta*r[5] + eta_i*r[4])
        + phi_B2_x_coupler2_theta*shifted_coupler2_theta_i + phi_B2_x_crank1_theta*shifted_crank1_theta_i
        + phi_B2_x_crank2_theta*shifted_crank2_theta_i;
    x[10] = eta_row*factor_15 - eta_row_i*factor_16;
    x[11] = eta_row*factor_16 + eta_row_i*factor_15;
    const double factor_17 = -by_q_B2_y_coupler2_theta*(eta*r[8] - eta_i*r[9])
        - by_q_B2_y_crank1_theta*(eta*r[2] - eta_i*r[3]) - by_q_B2_y_crank2_theta*(eta*r[4] - eta_i*r[5])
        + phi_B2_y_coupler2_theta*shifted_coupler2_theta + phi_B2_y_crank1_theta*shifted_crank1_theta
        + phi_B2_y_crank2_theta*shifted_crank2_theta;
    const double factor_18 = -by_q_B2_y_coupler2_theta*(eta*r[9] + eta_i*r[8])
        - by_q_B2_y_crank1_theta*(eta*r[3] + eta_i*r[2]) - by_q_B2_y_crank2_theta*(eta*r[5] + eta_i*r[4])
        + phi_B2_y_coupler2_theta*shifted_coupler2_theta_i + phi_B2_y_crank1_theta*shifted_crank1_theta_i
        + phi_B2_y_crank2_theta*shifted_crank2_theta_i;
    x[12] = eta_row*factor_17 - eta_row_i*factor_18;
    x[13] = eta_row*factor_18 + eta_row_i*factor_17;
    const double factor_19 = -by_q_B1_x_coupler1_theta*(eta*r[6] - eta_i*r[7])
        - by_q_B1_x_crank0_theta*(eta*r[0] - eta_i*r[1]) + by_q_B2_x_crank1_theta*(eta*r[2] - eta_i*r[3])
        + phi_B1_x_coupler1_theta*shifted_coupler1_theta + phi_B1_x_crank0_theta*shifted_crank0_theta
        - phi_B2_x_crank1_theta*shifted_crank1_theta;
    const double factor_20 = -by_q_B1_x_coupler1_theta*(eta*r[7] + eta_i*r[6])
        - by_q_B1_x_crank0_theta*(eta*r[1] + eta_i*r[0]) + by_q_B2_x_crank1_theta*(eta*r[3] + eta_i*r[2])
        + phi_B1_x_coupler1_theta*shifted_coupler1_theta_i + phi_B1_x_crank0_theta*shifted_crank0_theta_i
        - phi_B2_x_crank1_theta*shifted_crank1_theta_i;
    x[14] = eta_row*factor_19 - eta_row_i*factor_20;
    x[15] = eta_row*factor_20 + eta_row_i*factor_19;
    const double factor_21 = -by_q_B1_y_coupler1_theta*(eta*r[6] - eta_i*r[7])
        - by_q_B1_y_crank0_theta*(eta*r[0] - eta_i*r[1]) + by_q_B2_y_crank1_theta*(eta*r[2] - eta_i*r[3])
        + phi_B1_y_coupler1_theta*shifted_coupler1_theta + phi_B1_y_crank0_theta*shifted_crank0_theta
        - phi_B2_y_crank1_theta*shifted_crank1_theta;
    const double factor_22 = -by_q_B1_y_coupler1_theta*(eta*r[7] + eta_i*r[6])
        - by_q_B1_y_crank0_theta*(eta*r[1] + eta_i*r[0]) + by_q_B2_y_crank1_theta*(eta*r[3] + eta_i*r[2])
        + phi_B1_y_coupler1_theta*shifted_coupler1_theta_i + phi_B1_y_crank0_theta*shifted_crank0_theta_i
        - phi_B2_y_crank1_theta*shifted_crank1_theta_i;
    x[16] = eta_row*factor_21 - eta_row_i*factor_22;
    x[17] = eta_row*factor_22 + eta_row_i*factor_21;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_23 = r[0] + x[0];
    const double factor_24 = r[1] + x[1];
    u[0] = eta*factor_23 - eta_i*factor_24;
    u[1] = eta*factor_24 + eta_i*factor_23;
    u[10] = x[0];
    u[11] = x[1];
    const double factor_25 = r[2] + x[2];
    const double factor_26 = r[3] + x[3];
    u[2] = eta*factor_25 - eta_i*factor_26;
    u[3] = eta*factor_26 + eta_i*factor_25;
    u[12] = x[2];
    u[13] = x[3];
    const double factor_27 = r[4] + x[4];
    const double factor_28 = r[5] + x[5];
    u[4] = eta*factor_27 - eta_i*factor_28;
    u[5] = eta*factor_28 + eta_i*factor_27;
    u[14] = x[4];
    u[15] = x[5];
    const double factor_29 = r[6] + x[6];
    const double factor_30 = r[7] + x[7];
    u[6] = eta*factor_29 - eta_i*factor_30;
    u[7] = eta*factor_30 + eta_i*factor_29;
    u[16] = x[6];
    u[17] = x[7];
    const double factor_31 = r[8] + x[8];
    const double factor_32 = r[9] + x[9];
    u[8] = eta*factor_31 - eta_i*factor_32;
    u[9] = eta*factor_32 + eta_i*factor_31;
    u[18] = x[8];
    u[19] = x[9];
    u[20] = eta*r[20] - eta_i*r[21];
    u[21] = eta*r[21] + eta_i*r[20];
    u[22] = eta*r[22] - eta_i*r[23];
    u[23] = eta*r[23] + eta_i*r[22];
    u[24] = eta*r[24] - eta_i*r[25];
    u[25] = eta*r[25] + eta_i*r[24];
}
