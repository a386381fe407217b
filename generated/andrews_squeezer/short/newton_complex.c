/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_OF_theta__OF_theta = by_q_OF_theta_OF_theta*(eta * eta) + p->mass_OF_OF;
    const Complex n_OF_theta__FE_theta = eta*(by_q_OF_theta_FE_theta*eta + by_v_OF_theta_FE_theta)
        + mass_OF_theta_FE_theta;
    const Complex n_OF_theta__EG_theta = eta*(by_q_OF_theta_EG_theta*eta + by_v_OF_theta_EG_theta)
        + mass_OF_theta_EG_theta;
    const Complex n_BDE_theta__BDE_theta = by_q_BDE_theta_BDE_theta*(eta * eta) + p->mass_BDE_BDE;
    const Complex n_BDE_theta__HE_theta = eta*(by_q_BDE_theta_HE_theta*eta + by_v_BDE_theta_HE_theta)
        + mass_BDE_theta_HE_theta;
    const Complex n_AG_theta__AG_theta = by_q_AG_theta_AG_theta*(eta * eta) + p->mass_AG_AG;
    const Complex n_AH_theta__AH_theta = by_q_AH_theta_AH_theta*(eta * eta) + p->mass_AH_AH;
    const Complex n_FE_theta__OF_theta = eta*(by_q_FE_theta_OF_theta*eta + by_v_FE_theta_OF_theta)
        + mass_OF_theta_FE_theta;
    const Complex n_FE_theta__FE_theta = by_q_FE_theta_FE_theta*(eta * eta) + p->mass_FE_FE;
    const Complex n_FE_theta__EG_theta = eta*(by_q_FE_theta_EG_theta*eta + by_v_FE_theta_EG_theta)
        + mass_FE_theta_EG_theta;
    const Complex n_HE_theta__BDE_theta = eta*(by_q_HE_theta_BDE_theta*eta + by_v_HE_theta_BDE_theta)
        + mass_BDE_theta_HE_theta;
    const Complex n_HE_theta__HE_theta = by_q_HE_theta_HE_theta*(eta * eta) + p->mass_HE_HE;
    const Complex n_EG_theta__OF_theta = eta*(by_q_EG_theta_OF_theta*eta + by_v_EG_theta_OF_theta)
        + mass_OF_theta_EG_theta;
    const Complex n_EG_theta__FE_theta = eta*(by_q_EG_theta_FE_theta*eta + by_v_EG_theta_FE_theta)
        + mass_FE_theta_EG_theta;
    const Complex n_EG_theta__EG_theta = by_q_EG_theta_EG_theta*(eta * eta) + p->mass_EG_EG;
    const Complex n_G_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const Complex n_G_x__AG_theta = eta_row*(by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta) + phi_G_x_AG_theta;
    const Complex n_G_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const Complex n_G_x__EG_theta = eta_row*(by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta) + phi_G_x_EG_theta;
    const Complex n_G_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const Complex n_G_y__AG_theta = eta_row*(by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta) + phi_G_y_AG_theta;
    const Complex n_G_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;
    const Complex n_G_y__EG_theta = eta_row*(by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta) + phi_G_y_EG_theta;
    const Complex n_H_x__BDE_theta = eta_row*(by_q_H_x_BDE_theta*eta + by_v_H_x_BDE_theta) + phi_H_x_BDE_theta;
    const Complex n_H_x__AH_theta = eta_row*(by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta) + phi_H_x_AH_theta;
    const Complex n_H_x__HE_theta = eta_row*(by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta) + phi_H_x_HE_theta;
    const Complex n_H_y__BDE_theta = eta_row*(by_q_H_y_BDE_theta*eta + by_v_H_y_BDE_theta) + phi_H_y_BDE_theta;
    const Complex n_H_y__AH_theta = eta_row*(by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta) + phi_H_y_AH_theta;
    const Complex n_H_y__HE_theta = eta_row*(by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta) + phi_H_y_HE_theta;
    const Complex n_E3_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const Complex n_E3_x__BDE_theta = eta_row*(-by_q_H_x_BDE_theta*eta - by_v_H_x_BDE_theta) - phi_H_x_BDE_theta;
    const Complex n_E3_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const Complex n_E3_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const Complex n_E3_y__BDE_theta = eta_row*(-by_q_H_y_BDE_theta*eta - by_v_H_y_BDE_theta) - phi_H_y_BDE_theta;
    const Complex n_E3_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;

    /* L U */
    const Complex scale_AG_theta = n_AG_theta__AG_theta;
    if (!(complex_size(scale_AG_theta) > SINGULAR * complex_size(n_AG_theta__AG_theta)))
        return 3;
    const Complex inverse_pivot_AG_theta = 1.0/scale_AG_theta;
    lin->lu[0] = inverse_pivot_AG_theta;
    const Complex l_G_x__AG_theta = inverse_pivot_AG_theta*n_G_x__AG_theta;
    lin->lu[1] = l_G_x__AG_theta;
    const Complex l_G_y__AG_theta = inverse_pivot_AG_theta*n_G_y__AG_theta;
    lin->lu[2] = l_G_y__AG_theta;
    const Complex scale_AH_theta = n_AH_theta__AH_theta;
    if (!(complex_size(scale_AH_theta) > SINGULAR * complex_size(n_AH_theta__AH_theta)))
        return 4;
    const Complex inverse_pivot_AH_theta = 1.0/scale_AH_theta;
    lin->lu[3] = inverse_pivot_AH_theta;
    const Complex l_H_x__AH_theta = inverse_pivot_AH_theta*n_H_x__AH_theta;
    lin->lu[4] = l_H_x__AH_theta;
    const Complex l_H_y__AH_theta = inverse_pivot_AH_theta*n_H_y__AH_theta;
    lin->lu[5] = l_H_y__AH_theta;
    const Complex scale_HE_theta = n_HE_theta__HE_theta;
    if (!(complex_size(scale_HE_theta) > SINGULAR * complex_size(n_HE_theta__HE_theta)))
        return 6;
    const Complex inverse_pivot_HE_theta = 1.0/scale_HE_theta;
    lin->lu[6] = inverse_pivot_HE_theta;
    const Complex l_BDE_theta__HE_theta = inverse_pivot_HE_theta*n_BDE_theta__HE_theta;
    lin->lu[7] = l_BDE_theta__HE_theta;
    lin->lu[8] = n_HE_theta__BDE_theta;
    const Complex l_H_x__HE_theta = inverse_pivot_HE_theta*n_H_x__HE_theta;
    lin->lu[9] = l_H_x__HE_theta;
    const Complex l_H_y__HE_theta = inverse_pivot_HE_theta*n_H_y__HE_theta;
    lin->lu[10] = l_H_y__HE_theta;
    const Complex scale_BDE_theta = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta + n_BDE_theta__BDE_theta;
    if (!(complex_size(scale_BDE_theta) > SINGULAR * complex_size(n_BDE_theta__BDE_theta)))
        return 2;
    const Complex inverse_pivot_BDE_theta = 1.0/scale_BDE_theta;
    lin->lu[11] = inverse_pivot_BDE_theta;
    const Complex l_H_x__BDE_theta = inverse_pivot_BDE_theta*(-l_H_x__HE_theta*n_HE_theta__BDE_theta
        + n_H_x__BDE_theta);
    lin->lu[12] = l_H_x__BDE_theta;
    const Complex u_BDE_theta__H_x = -l_BDE_theta__HE_theta*phi_H_x_HE_theta + phi_H_x_BDE_theta;
    lin->lu[13] = u_BDE_theta__H_x;
    const Complex l_H_y__BDE_theta = inverse_pivot_BDE_theta*(-l_H_y__HE_theta*n_HE_theta__BDE_theta
        + n_H_y__BDE_theta);
    lin->lu[14] = l_H_y__BDE_theta;
    const Complex u_BDE_theta__H_y = -l_BDE_theta__HE_theta*phi_H_y_HE_theta + phi_H_y_BDE_theta;
    lin->lu[15] = u_BDE_theta__H_y;
    const Complex l_E3_x__BDE_theta = inverse_pivot_BDE_theta*n_E3_x__BDE_theta;
    lin->lu[16] = l_E3_x__BDE_theta;
    const Complex l_E3_y__BDE_theta = inverse_pivot_BDE_theta*n_E3_y__BDE_theta;
    lin->lu[17] = l_E3_y__BDE_theta;
    const Complex scale_H_x = -l_H_x__AH_theta*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x
        - l_H_x__HE_theta*phi_H_x_HE_theta;
    if (!(complex_size(scale_H_x) > 0.0 && complex_size(scale_H_x) <= DBL_MAX))
        return 10;
    const Complex inverse_pivot_H_x = 1.0/scale_H_x;
    lin->lu[18] = inverse_pivot_H_x;
    const Complex l_H_y__H_x = inverse_pivot_H_x*(-l_H_y__AH_theta*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x
        - l_H_y__HE_theta*phi_H_x_HE_theta);
    lin->lu[19] = l_H_y__H_x;
    const Complex u_H_x__H_y = -l_H_x__AH_theta*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y
        - l_H_x__HE_theta*phi_H_y_HE_theta;
    lin->lu[20] = u_H_x__H_y;
    const Complex l_E3_x__H_x = -inverse_pivot_H_x*l_E3_x__BDE_theta*u_BDE_theta__H_x;
    lin->lu[21] = l_E3_x__H_x;
    const Complex u_H_x__E3_x = l_H_x__BDE_theta*phi_H_x_BDE_theta;
    lin->lu[22] = u_H_x__E3_x;
    const Complex l_E3_y__H_x = -inverse_pivot_H_x*l_E3_y__BDE_theta*u_BDE_theta__H_x;
    lin->lu[23] = l_E3_y__H_x;
    const Complex u_H_x__E3_y = l_H_x__BDE_theta*phi_H_y_BDE_theta;
    lin->lu[24] = u_H_x__E3_y;
    const Complex scale_H_y = -l_H_y__AH_theta*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y
        - l_H_y__HE_theta*phi_H_y_HE_theta;
    const Complex pivot_H_y = -l_H_y__H_x*u_H_x__H_y + scale_H_y;
    if (!(complex_size(pivot_H_y) > SINGULAR * complex_size(scale_H_y)))
        return 11;
    const Complex inverse_pivot_H_y = 1.0/pivot_H_y;
    lin->lu[25] = inverse_pivot_H_y;
    const Complex l_E3_x__H_y = inverse_pivot_H_y*(-l_E3_x__BDE_theta*u_BDE_theta__H_y - l_E3_x__H_x*u_H_x__H_y);
    lin->lu[26] = l_E3_x__H_y;
    const Complex u_H_y__E3_x = l_H_y__BDE_theta*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x;
    lin->lu[27] = u_H_y__E3_x;
    const Complex l_E3_y__H_y = inverse_pivot_H_y*(-l_E3_y__BDE_theta*u_BDE_theta__H_y - l_E3_y__H_x*u_H_x__H_y);
    lin->lu[28] = l_E3_y__H_y;
    const Complex u_H_y__E3_y = l_H_y__BDE_theta*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y;
    lin->lu[29] = u_H_y__E3_y;
    const Complex scale_EG_theta = n_EG_theta__EG_theta;
    if (!(complex_size(scale_EG_theta) > SINGULAR * complex_size(n_EG_theta__EG_theta)))
        return 7;
    const Complex inverse_pivot_EG_theta = 1.0/scale_EG_theta;
    lin->lu[30] = inverse_pivot_EG_theta;
    const Complex l_OF_theta__EG_theta = inverse_pivot_EG_theta*n_OF_theta__EG_theta;
    lin->lu[31] = l_OF_theta__EG_theta;
    lin->lu[32] = n_EG_theta__OF_theta;
    const Complex l_FE_theta__EG_theta = inverse_pivot_EG_theta*n_FE_theta__EG_theta;
    lin->lu[33] = l_FE_theta__EG_theta;
    lin->lu[34] = n_EG_theta__FE_theta;
    const Complex l_G_x__EG_theta = inverse_pivot_EG_theta*n_G_x__EG_theta;
    lin->lu[35] = l_G_x__EG_theta;
    const Complex l_G_y__EG_theta = inverse_pivot_EG_theta*n_G_y__EG_theta;
    lin->lu[36] = l_G_y__EG_theta;
    const Complex scale_OF_theta = -l_OF_theta__EG_theta*n_EG_theta__OF_theta + n_OF_theta__OF_theta;
    if (!(complex_size(scale_OF_theta) > SINGULAR * complex_size(n_OF_theta__OF_theta)))
        return 1;
    const Complex inverse_pivot_OF_theta = 1.0/scale_OF_theta;
    lin->lu[37] = inverse_pivot_OF_theta;
    const Complex l_FE_theta__OF_theta = inverse_pivot_OF_theta*(-l_FE_theta__EG_theta*n_EG_theta__OF_theta
        + n_FE_theta__OF_theta);
    lin->lu[38] = l_FE_theta__OF_theta;
    const Complex u_OF_theta__FE_theta = -l_OF_theta__EG_theta*n_EG_theta__FE_theta + n_OF_theta__FE_theta;
    lin->lu[39] = u_OF_theta__FE_theta;
    const Complex l_G_x__OF_theta = inverse_pivot_OF_theta*(-l_G_x__EG_theta*n_EG_theta__OF_theta + n_G_x__OF_theta);
    lin->lu[40] = l_G_x__OF_theta;
    const Complex u_OF_theta__G_x = -l_OF_theta__EG_theta*phi_G_x_EG_theta + phi_G_x_OF_theta;
    lin->lu[41] = u_OF_theta__G_x;
    const Complex l_G_y__OF_theta = inverse_pivot_OF_theta*(-l_G_y__EG_theta*n_EG_theta__OF_theta + n_G_y__OF_theta);
    lin->lu[42] = l_G_y__OF_theta;
    const Complex u_OF_theta__G_y = -l_OF_theta__EG_theta*phi_G_y_EG_theta + phi_G_y_OF_theta;
    lin->lu[43] = u_OF_theta__G_y;
    const Complex l_E3_x__OF_theta = inverse_pivot_OF_theta*n_E3_x__OF_theta;
    lin->lu[44] = l_E3_x__OF_theta;
    const Complex l_E3_y__OF_theta = inverse_pivot_OF_theta*n_E3_y__OF_theta;
    lin->lu[45] = l_E3_y__OF_theta;
    const Complex scale_FE_theta = -l_FE_theta__EG_theta*n_EG_theta__FE_theta
        - l_FE_theta__OF_theta*u_OF_theta__FE_theta + n_FE_theta__FE_theta;
    if (!(complex_size(scale_FE_theta) > SINGULAR * complex_size(n_FE_theta__FE_theta)))
        return 5;
    const Complex inverse_pivot_FE_theta = 1.0/scale_FE_theta;
    lin->lu[46] = inverse_pivot_FE_theta;
    const Complex l_G_x__FE_theta = inverse_pivot_FE_theta*(-l_G_x__EG_theta*n_EG_theta__FE_theta
        - l_G_x__OF_theta*u_OF_theta__FE_theta + n_G_x__FE_theta);
    lin->lu[47] = l_G_x__FE_theta;
    const Complex u_FE_theta__G_x = -l_FE_theta__EG_theta*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x
        + phi_G_x_FE_theta;
    lin->lu[48] = u_FE_theta__G_x;
    const Complex l_G_y__FE_theta = inverse_pivot_FE_theta*(-l_G_y__EG_theta*n_EG_theta__FE_theta
        - l_G_y__OF_theta*u_OF_theta__FE_theta + n_G_y__FE_theta);
    lin->lu[49] = l_G_y__FE_theta;
    const Complex u_FE_theta__G_y = -l_FE_theta__EG_theta*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y
        + phi_G_y_FE_theta;
    lin->lu[50] = u_FE_theta__G_y;
    const Complex l_E3_x__FE_theta = inverse_pivot_FE_theta*(-l_E3_x__OF_theta*u_OF_theta__FE_theta + n_E3_x__FE_theta);
    lin->lu[51] = l_E3_x__FE_theta;
    const Complex u_FE_theta__E3_x = -l_FE_theta__OF_theta*phi_G_x_OF_theta + phi_G_x_FE_theta;
    lin->lu[52] = u_FE_theta__E3_x;
    const Complex l_E3_y__FE_theta = inverse_pivot_FE_theta*(-l_E3_y__OF_theta*u_OF_theta__FE_theta + n_E3_y__FE_theta);
    lin->lu[53] = l_E3_y__FE_theta;
    const Complex u_FE_theta__E3_y = -l_FE_theta__OF_theta*phi_G_y_OF_theta + phi_G_y_FE_theta;
    lin->lu[54] = u_FE_theta__E3_y;
    const Complex scale_G_x = -l_G_x__AG_theta*phi_G_x_AG_theta - l_G_x__EG_theta*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x - l_G_x__OF_theta*u_OF_theta__G_x;
    if (!(complex_size(scale_G_x) > 0.0 && complex_size(scale_G_x) <= DBL_MAX))
        return 8;
    const Complex inverse_pivot_G_x = 1.0/scale_G_x;
    lin->lu[55] = inverse_pivot_G_x;
    const Complex l_G_y__G_x = inverse_pivot_G_x*(-l_G_y__AG_theta*phi_G_x_AG_theta - l_G_y__EG_theta*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x - l_G_y__OF_theta*u_OF_theta__G_x);
    lin->lu[56] = l_G_y__G_x;
    const Complex u_G_x__G_y = -l_G_x__AG_theta*phi_G_y_AG_theta - l_G_x__EG_theta*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y - l_G_x__OF_theta*u_OF_theta__G_y;
    lin->lu[57] = u_G_x__G_y;
    const Complex l_E3_x__G_x = inverse_pivot_G_x*(-l_E3_x__FE_theta*u_FE_theta__G_x
        - l_E3_x__OF_theta*u_OF_theta__G_x);
    lin->lu[58] = l_E3_x__G_x;
    const Complex u_G_x__E3_x = -l_G_x__FE_theta*u_FE_theta__E3_x - l_G_x__OF_theta*phi_G_x_OF_theta;
    lin->lu[59] = u_G_x__E3_x;
    const Complex l_E3_y__G_x = inverse_pivot_G_x*(-l_E3_y__FE_theta*u_FE_theta__G_x
        - l_E3_y__OF_theta*u_OF_theta__G_x);
    lin->lu[60] = l_E3_y__G_x;
    const Complex u_G_x__E3_y = -l_G_x__FE_theta*u_FE_theta__E3_y - l_G_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[61] = u_G_x__E3_y;
    const Complex scale_G_y = -l_G_y__AG_theta*phi_G_y_AG_theta - l_G_y__EG_theta*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y - l_G_y__OF_theta*u_OF_theta__G_y;
    const Complex pivot_G_y = -l_G_y__G_x*u_G_x__G_y + scale_G_y;
    if (!(complex_size(pivot_G_y) > SINGULAR * complex_size(scale_G_y)))
        return 9;
    const Complex inverse_pivot_G_y = 1.0/pivot_G_y;
    lin->lu[62] = inverse_pivot_G_y;
    const Complex l_E3_x__G_y = inverse_pivot_G_y*(-l_E3_x__FE_theta*u_FE_theta__G_y - l_E3_x__G_x*u_G_x__G_y
        - l_E3_x__OF_theta*u_OF_theta__G_y);
    lin->lu[63] = l_E3_x__G_y;
    const Complex u_G_y__E3_x = -l_G_y__FE_theta*u_FE_theta__E3_x - l_G_y__G_x*u_G_x__E3_x
        - l_G_y__OF_theta*phi_G_x_OF_theta;
    lin->lu[64] = u_G_y__E3_x;
    const Complex l_E3_y__G_y = inverse_pivot_G_y*(-l_E3_y__FE_theta*u_FE_theta__G_y - l_E3_y__G_x*u_G_x__G_y
        - l_E3_y__OF_theta*u_OF_theta__G_y);
    lin->lu[65] = l_E3_y__G_y;
    const Complex u_G_y__E3_y = -l_G_y__FE_theta*u_FE_theta__E3_y - l_G_y__G_x*u_G_x__E3_y
        - l_G_y__OF_theta*phi_G_y_OF_theta;
    lin->lu[66] = u_G_y__E3_y;
    const Complex scale_E3_x = l_E3_x__BDE_theta*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x
        - l_E3_x__OF_theta*phi_G_x_OF_theta;
    const Complex pivot_E3_x = -l_E3_x__G_x*u_G_x__E3_x - l_E3_x__G_y*u_G_y__E3_x - l_E3_x__H_x*u_H_x__E3_x
        - l_E3_x__H_y*u_H_y__E3_x + scale_E3_x;
    if (!(complex_size(pivot_E3_x) > SINGULAR * complex_size(scale_E3_x)))
        return 12;
    const Complex inverse_pivot_E3_x = 1.0/pivot_E3_x;
    lin->lu[67] = inverse_pivot_E3_x;
    const Complex l_E3_y__E3_x = inverse_pivot_E3_x*(l_E3_y__BDE_theta*phi_H_x_BDE_theta
        - l_E3_y__FE_theta*u_FE_theta__E3_x - l_E3_y__G_x*u_G_x__E3_x - l_E3_y__G_y*u_G_y__E3_x
        - l_E3_y__H_x*u_H_x__E3_x - l_E3_y__H_y*u_H_y__E3_x - l_E3_y__OF_theta*phi_G_x_OF_theta);
    lin->lu[68] = l_E3_y__E3_x;
    const Complex u_E3_x__E3_y = l_E3_x__BDE_theta*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y
        - l_E3_x__G_x*u_G_x__E3_y - l_E3_x__G_y*u_G_y__E3_y - l_E3_x__H_x*u_H_x__E3_y - l_E3_x__H_y*u_H_y__E3_y
        - l_E3_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[69] = u_E3_x__E3_y;
    const Complex scale_E3_y = l_E3_y__BDE_theta*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y
        - l_E3_y__OF_theta*phi_G_y_OF_theta;
    const Complex pivot_E3_y = -l_E3_y__E3_x*u_E3_x__E3_y - l_E3_y__G_x*u_G_x__E3_y - l_E3_y__G_y*u_G_y__E3_y
        - l_E3_y__H_x*u_H_x__E3_y - l_E3_y__H_y*u_H_y__E3_y + scale_E3_y;
    if (!(complex_size(pivot_E3_y) > SINGULAR * complex_size(scale_E3_y)))
        return 13;
    const Complex inverse_pivot_E3_y = 1.0/pivot_E3_y;
    lin->lu[70] = inverse_pivot_E3_y;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
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
    const Complex inverse_pivot_AG_theta = lin->lu[0];
    const Complex l_G_x__AG_theta = lin->lu[1];
    const Complex l_G_y__AG_theta = lin->lu[2];
    const Complex inverse_pivot_AH_theta = lin->lu[3];
    const Complex l_H_x__AH_theta = lin->lu[4];
    const Complex l_H_y__AH_theta = lin->lu[5];
    const Complex inverse_pivot_HE_theta = lin->lu[6];
    const Complex l_BDE_theta__HE_theta = lin->lu[7];
    const Complex n_HE_theta__BDE_theta = lin->lu[8];
    const Complex l_H_x__HE_theta = lin->lu[9];
    const Complex l_H_y__HE_theta = lin->lu[10];
    const Complex inverse_pivot_BDE_theta = lin->lu[11];
    const Complex l_H_x__BDE_theta = lin->lu[12];
    const Complex u_BDE_theta__H_x = lin->lu[13];
    const Complex l_H_y__BDE_theta = lin->lu[14];
    const Complex u_BDE_theta__H_y = lin->lu[15];
    const Complex l_E3_x__BDE_theta = lin->lu[16];
    const Complex l_E3_y__BDE_theta = lin->lu[17];
    const Complex inverse_pivot_H_x = lin->lu[18];
    const Complex l_H_y__H_x = lin->lu[19];
    const Complex u_H_x__H_y = lin->lu[20];
    const Complex l_E3_x__H_x = lin->lu[21];
    const Complex u_H_x__E3_x = lin->lu[22];
    const Complex l_E3_y__H_x = lin->lu[23];
    const Complex u_H_x__E3_y = lin->lu[24];
    const Complex inverse_pivot_H_y = lin->lu[25];
    const Complex l_E3_x__H_y = lin->lu[26];
    const Complex u_H_y__E3_x = lin->lu[27];
    const Complex l_E3_y__H_y = lin->lu[28];
    const Complex u_H_y__E3_y = lin->lu[29];
    const Complex inverse_pivot_EG_theta = lin->lu[30];
    const Complex l_OF_theta__EG_theta = lin->lu[31];
    const Complex n_EG_theta__OF_theta = lin->lu[32];
    const Complex l_FE_theta__EG_theta = lin->lu[33];
    const Complex n_EG_theta__FE_theta = lin->lu[34];
    const Complex l_G_x__EG_theta = lin->lu[35];
    const Complex l_G_y__EG_theta = lin->lu[36];
    const Complex inverse_pivot_OF_theta = lin->lu[37];
    const Complex l_FE_theta__OF_theta = lin->lu[38];
    const Complex u_OF_theta__FE_theta = lin->lu[39];
    const Complex l_G_x__OF_theta = lin->lu[40];
    const Complex u_OF_theta__G_x = lin->lu[41];
    const Complex l_G_y__OF_theta = lin->lu[42];
    const Complex u_OF_theta__G_y = lin->lu[43];
    const Complex l_E3_x__OF_theta = lin->lu[44];
    const Complex l_E3_y__OF_theta = lin->lu[45];
    const Complex inverse_pivot_FE_theta = lin->lu[46];
    const Complex l_G_x__FE_theta = lin->lu[47];
    const Complex u_FE_theta__G_x = lin->lu[48];
    const Complex l_G_y__FE_theta = lin->lu[49];
    const Complex u_FE_theta__G_y = lin->lu[50];
    const Complex l_E3_x__FE_theta = lin->lu[51];
    const Complex u_FE_theta__E3_x = lin->lu[52];
    const Complex l_E3_y__FE_theta = lin->lu[53];
    const Complex u_FE_theta__E3_y = lin->lu[54];
    const Complex inverse_pivot_G_x = lin->lu[55];
    const Complex l_G_y__G_x = lin->lu[56];
    const Complex u_G_x__G_y = lin->lu[57];
    const Complex l_E3_x__G_x = lin->lu[58];
    const Complex u_G_x__E3_x = lin->lu[59];
    const Complex l_E3_y__G_x = lin->lu[60];
    const Complex u_G_x__E3_y = lin->lu[61];
    const Complex inverse_pivot_G_y = lin->lu[62];
    const Complex l_E3_x__G_y = lin->lu[63];
    const Complex u_G_y__E3_x = lin->lu[64];
    const Complex l_E3_y__G_y = lin->lu[65];
    const Complex u_G_y__E3_y = lin->lu[66];
    const Complex inverse_pivot_E3_x = lin->lu[67];
    const Complex l_E3_y__E3_x = lin->lu[68];
    const Complex u_E3_x__E3_y = lin->lu[69];
    const Complex inverse_pivot_E3_y = lin->lu[70];

    /* forward */
    const Complex b_AG_theta = x[2];
    const Complex b_AH_theta = x[3];
    const Complex b_HE_theta = x[5];
    const Complex b_BDE_theta = -b_HE_theta*l_BDE_theta__HE_theta + x[1];
    const Complex b_H_x = -b_AH_theta*l_H_x__AH_theta - b_BDE_theta*l_H_x__BDE_theta - b_HE_theta*l_H_x__HE_theta
        + x[9];
    const Complex b_H_y = -b_AH_theta*l_H_y__AH_theta - b_BDE_theta*l_H_y__BDE_theta - b_HE_theta*l_H_y__HE_theta
        - b_H_x*l_H_y__H_x + x[10];
    const Complex b_EG_theta = x[6];
    const Complex b_OF_theta = -b_EG_theta*l_OF_theta__EG_theta + x[0];
    const Complex b_FE_theta = -b_EG_theta*l_FE_theta__EG_theta - b_OF_theta*l_FE_theta__OF_theta + x[4];
    const Complex b_G_x = -b_AG_theta*l_G_x__AG_theta - b_EG_theta*l_G_x__EG_theta - b_FE_theta*l_G_x__FE_theta
        - b_OF_theta*l_G_x__OF_theta + x[7];
    const Complex b_G_y = -b_AG_theta*l_G_y__AG_theta - b_EG_theta*l_G_y__EG_theta - b_FE_theta*l_G_y__FE_theta
        - b_G_x*l_G_y__G_x - b_OF_theta*l_G_y__OF_theta + x[8];
    const Complex b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta - b_FE_theta*l_E3_x__FE_theta - b_G_x*l_E3_x__G_x
        - b_G_y*l_E3_x__G_y - b_H_x*l_E3_x__H_x - b_H_y*l_E3_x__H_y - b_OF_theta*l_E3_x__OF_theta + x[11];
    const Complex b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta - b_E3_x*l_E3_y__E3_x - b_FE_theta*l_E3_y__FE_theta
        - b_G_x*l_E3_y__G_x - b_G_y*l_E3_y__G_y - b_H_x*l_E3_y__H_x - b_H_y*l_E3_y__H_y - b_OF_theta*l_E3_y__OF_theta
        + x[12];

    /* backward */
    const Complex x_E3_y = b_E3_y*inverse_pivot_E3_y;
    x[12] = x_E3_y;
    const Complex x_E3_x = inverse_pivot_E3_x*(b_E3_x - u_E3_x__E3_y*x_E3_y);
    x[11] = x_E3_x;
    const Complex x_G_y = inverse_pivot_G_y*(b_G_y - u_G_y__E3_x*x_E3_x - u_G_y__E3_y*x_E3_y);
    x[8] = x_G_y;
    const Complex x_G_x = inverse_pivot_G_x*(b_G_x - u_G_x__E3_x*x_E3_x - u_G_x__E3_y*x_E3_y - u_G_x__G_y*x_G_y);
    x[7] = x_G_x;
    const Complex x_FE_theta = inverse_pivot_FE_theta*(b_FE_theta - u_FE_theta__E3_x*x_E3_x - u_FE_theta__E3_y*x_E3_y
        - u_FE_theta__G_x*x_G_x - u_FE_theta__G_y*x_G_y);
    x[4] = x_FE_theta;
    const Complex x_OF_theta = inverse_pivot_OF_theta*(b_OF_theta - phi_G_x_OF_theta*x_E3_x - phi_G_y_OF_theta*x_E3_y
        - u_OF_theta__FE_theta*x_FE_theta - u_OF_theta__G_x*x_G_x - u_OF_theta__G_y*x_G_y);
    x[0] = x_OF_theta;
    const Complex x_EG_theta = inverse_pivot_EG_theta*(b_EG_theta - n_EG_theta__FE_theta*x_FE_theta
        - n_EG_theta__OF_theta*x_OF_theta - phi_G_x_EG_theta*x_G_x - phi_G_y_EG_theta*x_G_y);
    x[6] = x_EG_theta;
    const Complex x_H_y = inverse_pivot_H_y*(b_H_y - u_H_y__E3_x*x_E3_x - u_H_y__E3_y*x_E3_y);
    x[10] = x_H_y;
    const Complex x_H_x = inverse_pivot_H_x*(b_H_x - u_H_x__E3_x*x_E3_x - u_H_x__E3_y*x_E3_y - u_H_x__H_y*x_H_y);
    x[9] = x_H_x;
    const Complex x_BDE_theta = inverse_pivot_BDE_theta*(b_BDE_theta + phi_H_x_BDE_theta*x_E3_x
        + phi_H_y_BDE_theta*x_E3_y - u_BDE_theta__H_x*x_H_x - u_BDE_theta__H_y*x_H_y);
    x[1] = x_BDE_theta;
    const Complex x_HE_theta = inverse_pivot_HE_theta*(b_HE_theta - n_HE_theta__BDE_theta*x_BDE_theta
        - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y);
    x[5] = x_HE_theta;
    const Complex x_AH_theta = inverse_pivot_AH_theta*(b_AH_theta - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y);
    x[3] = x_AH_theta;
    const Complex x_AG_theta = inverse_pivot_AG_theta*(b_AG_theta - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y);
    x[2] = x_AG_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[13];
    const Complex shifted_OF_theta = -p->beta_squared*eta*r[0] + r[7];
    const Complex shifted_BDE_theta = -p->beta_squared*eta*r[1] + r[8];
    const Complex shifted_AG_theta = -p->beta_squared*eta*r[2] + r[9];
    const Complex shifted_AH_theta = -p->beta_squared*eta*r[3] + r[10];
    const Complex shifted_FE_theta = -p->beta_squared*eta*r[4] + r[11];
    const Complex shifted_HE_theta = -p->beta_squared*eta*r[5] + r[12];
    const Complex shifted_EG_theta = -p->beta_squared*eta*r[6] + r[13];
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
    newton_substitute_complex(lin, x);

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
