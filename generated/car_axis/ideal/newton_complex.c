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
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double by_v_slot_offset_axle_theta = lin->value[15];
    const double by_v_slot_offset_axle_x = lin->value[16];
    const double by_v_slot_offset_axle_y = lin->value[17];

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
    const double n_axle_x__axle_x = p->axle_mass + by_q_axle_x_axle_x*((eta * eta) - (eta_i * eta_i));
    const double n_axle_x__axle_x_i = 2.0*by_q_axle_x_axle_x*eta*eta_i;
    const double n_axle_x__axle_y = by_q_axle_x_axle_y*((eta * eta) - (eta_i * eta_i));
    const double n_axle_x__axle_y_i = 2.0*by_q_axle_x_axle_y*eta*eta_i;
    const double n_axle_x__axle_theta = by_q_axle_x_axle_theta*((eta * eta) - (eta_i * eta_i));
    const double n_axle_x__axle_theta_i = 2.0*by_q_axle_x_axle_theta*eta*eta_i;
    const double n_axle_y__axle_x = by_q_axle_y_axle_x*((eta * eta) - (eta_i * eta_i));
    const double n_axle_y__axle_x_i = 2.0*by_q_axle_y_axle_x*eta*eta_i;
    const double n_axle_y__axle_y = p->axle_mass + by_q_axle_y_axle_y*((eta * eta) - (eta_i * eta_i));
    const double n_axle_y__axle_y_i = 2.0*by_q_axle_y_axle_y*eta*eta_i;
    const double n_axle_y__axle_theta = by_q_axle_y_axle_theta*((eta * eta) - (eta_i * eta_i));
    const double n_axle_y__axle_theta_i = 2.0*by_q_axle_y_axle_theta*eta*eta_i;
    const double n_axle_theta__axle_x = by_q_axle_theta_axle_x*((eta * eta) - (eta_i * eta_i));
    const double n_axle_theta__axle_x_i = 2.0*by_q_axle_theta_axle_x*eta*eta_i;
    const double n_axle_theta__axle_y = by_q_axle_theta_axle_y*((eta * eta) - (eta_i * eta_i));
    const double n_axle_theta__axle_y_i = 2.0*by_q_axle_theta_axle_y*eta*eta_i;
    const double n_axle_theta__axle_theta = p->axle_inertia + by_q_axle_theta_axle_theta*((eta * eta)
        - (eta_i * eta_i));
    const double n_axle_theta__axle_theta_i = 2.0*by_q_axle_theta_axle_theta*eta*eta_i;
    const double factor_5 = by_q_slot_offset_axle_x*eta + by_v_slot_offset_axle_x;
    const double factor_6 = by_q_slot_offset_axle_x*eta_i;
    const double n_slot_offset__axle_x = eta_row*factor_5 - eta_row_i*factor_6 + phi_slot_offset_axle_x;
    const double n_slot_offset__axle_x_i = eta_row*factor_6 + eta_row_i*factor_5;
    const double factor_7 = by_q_slot_offset_axle_y*eta + by_v_slot_offset_axle_y;
    const double factor_8 = by_q_slot_offset_axle_y*eta_i;
    const double n_slot_offset__axle_y = eta_row*factor_7 - eta_row_i*factor_8 + phi_slot_offset_axle_y;
    const double n_slot_offset__axle_y_i = eta_row*factor_8 + eta_row_i*factor_7;
    const double factor_9 = by_q_slot_offset_axle_theta*eta + by_v_slot_offset_axle_theta;
    const double factor_10 = by_q_slot_offset_axle_theta*eta_i;
    const double n_slot_offset__axle_theta = eta_row*factor_9 - eta_row_i*factor_10 + phi_slot_offset_axle_theta;
    const double n_slot_offset__axle_theta_i = eta_row*factor_10 + eta_row_i*factor_9;

    /* L U */
    const double scale_axle_x = n_axle_x__axle_x;
    const double scale_axle_x_i = n_axle_x__axle_x_i;
    const double size_1 = fabs(scale_axle_x) + fabs(scale_axle_x_i);
    const double size_2 = fabs(n_axle_x__axle_x) + fabs(n_axle_x__axle_x_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_4 = 1.0/((scale_axle_x * scale_axle_x) + (scale_axle_x_i * scale_axle_x_i));
    const double inverse_pivot_axle_x = divisor_4*scale_axle_x;
    const double inverse_pivot_axle_x_i = -divisor_4*scale_axle_x_i;
    lin->lu[0] = inverse_pivot_axle_x;
    lin->lu[1] = inverse_pivot_axle_x_i;
    const double l_axle_y__axle_x = inverse_pivot_axle_x*n_axle_y__axle_x - inverse_pivot_axle_x_i*n_axle_y__axle_x_i;
    const double l_axle_y__axle_x_i = inverse_pivot_axle_x*n_axle_y__axle_x_i + inverse_pivot_axle_x_i*n_axle_y__axle_x;
    lin->lu[2] = l_axle_y__axle_x;
    lin->lu[3] = l_axle_y__axle_x_i;
    lin->lu[4] = n_axle_x__axle_y;
    lin->lu[5] = n_axle_x__axle_y_i;
    const double l_axle_theta__axle_x = inverse_pivot_axle_x*n_axle_theta__axle_x
        - inverse_pivot_axle_x_i*n_axle_theta__axle_x_i;
    const double l_axle_theta__axle_x_i = inverse_pivot_axle_x*n_axle_theta__axle_x_i
        + inverse_pivot_axle_x_i*n_axle_theta__axle_x;
    lin->lu[6] = l_axle_theta__axle_x;
    lin->lu[7] = l_axle_theta__axle_x_i;
    lin->lu[8] = n_axle_x__axle_theta;
    lin->lu[9] = n_axle_x__axle_theta_i;
    const double l_slot_offset__axle_x = inverse_pivot_axle_x*n_slot_offset__axle_x
        - inverse_pivot_axle_x_i*n_slot_offset__axle_x_i;
    const double l_slot_offset__axle_x_3_i = inverse_pivot_axle_x*n_slot_offset__axle_x_i
        + inverse_pivot_axle_x_i*n_slot_offset__axle_x;
    lin->lu[10] = l_slot_offset__axle_x;
    lin->lu[11] = l_slot_offset__axle_x_3_i;
    const double scale_axle_y = -l_axle_y__axle_x*n_axle_x__axle_y + l_axle_y__axle_x_i*n_axle_x__axle_y_i
        + n_axle_y__axle_y;
    const double scale_axle_y_i = -l_axle_y__axle_x*n_axle_x__axle_y_i - l_axle_y__axle_x_i*n_axle_x__axle_y
        + n_axle_y__axle_y_i;
    const double size_3 = fabs(scale_axle_y) + fabs(scale_axle_y_i);
    const double size_4 = fabs(n_axle_y__axle_y) + fabs(n_axle_y__axle_y_i);
    if (!(size_3 > SINGULAR * size_4))
        return 2;
    const double divisor_5 = 1.0/((scale_axle_y * scale_axle_y) + (scale_axle_y_i * scale_axle_y_i));
    const double inverse_pivot_axle_y = divisor_5*scale_axle_y;
    const double inverse_pivot_axle_y_i = -divisor_5*scale_axle_y_i;
    lin->lu[12] = inverse_pivot_axle_y;
    lin->lu[13] = inverse_pivot_axle_y_i;
    const double factor_11 = -l_axle_theta__axle_x*n_axle_x__axle_y + l_axle_theta__axle_x_i*n_axle_x__axle_y_i
        + n_axle_theta__axle_y;
    const double factor_12 = -l_axle_theta__axle_x*n_axle_x__axle_y_i - l_axle_theta__axle_x_i*n_axle_x__axle_y
        + n_axle_theta__axle_y_i;
    const double l_axle_theta__axle_y = factor_11*inverse_pivot_axle_y - factor_12*inverse_pivot_axle_y_i;
    const double l_axle_theta__axle_y_i = factor_11*inverse_pivot_axle_y_i + factor_12*inverse_pivot_axle_y;
    lin->lu[14] = l_axle_theta__axle_y;
    lin->lu[15] = l_axle_theta__axle_y_i;
    const double u_axle_y__axle_theta = -l_axle_y__axle_x*n_axle_x__axle_theta
        + l_axle_y__axle_x_i*n_axle_x__axle_theta_i + n_axle_y__axle_theta;
    const double u_axle_y__axle_theta_i = -l_axle_y__axle_x*n_axle_x__axle_theta_i
        - l_axle_y__axle_x_i*n_axle_x__axle_theta + n_axle_y__axle_theta_i;
    lin->lu[16] = u_axle_y__axle_theta;
    lin->lu[17] = u_axle_y__axle_theta_i;
    const double factor_13 = -l_slot_offset__axle_x*n_axle_x__axle_y + l_slot_offset__axle_x_3_i*n_axle_x__axle_y_i
        + n_slot_offset__axle_y;
    const double factor_14 = -l_slot_offset__axle_x*n_axle_x__axle_y_i - l_slot_offset__axle_x_3_i*n_axle_x__axle_y
        + n_slot_offset__axle_y_i;
    const double l_slot_offset__axle_y = factor_13*inverse_pivot_axle_y - factor_14*inverse_pivot_axle_y_i;
    const double l_slot_offset__axle_y_3_i = factor_13*inverse_pivot_axle_y_i + factor_14*inverse_pivot_axle_y;
    lin->lu[18] = l_slot_offset__axle_y;
    lin->lu[19] = l_slot_offset__axle_y_3_i;
    const double u_axle_y__slot_offset = -l_axle_y__axle_x*phi_slot_offset_axle_x + phi_slot_offset_axle_y;
    const double u_axle_y__slot_offset_i = -l_axle_y__axle_x_i*phi_slot_offset_axle_x;
    lin->lu[20] = u_axle_y__slot_offset;
    lin->lu[21] = u_axle_y__slot_offset_i;
    const double scale_axle_theta = -l_axle_theta__axle_x*n_axle_x__axle_theta
        + l_axle_theta__axle_x_i*n_axle_x__axle_theta_i - l_axle_theta__axle_y*u_axle_y__axle_theta
        + l_axle_theta__axle_y_i*u_axle_y__axle_theta_i + n_axle_theta__axle_theta;
    const double scale_axle_theta_i = -l_axle_theta__axle_x*n_axle_x__axle_theta_i
        - l_axle_theta__axle_x_i*n_axle_x__axle_theta - l_axle_theta__axle_y*u_axle_y__axle_theta_i
        - l_axle_theta__axle_y_i*u_axle_y__axle_theta + n_axle_theta__axle_theta_i;
    const double size_5 = fabs(scale_axle_theta) + fabs(scale_axle_theta_i);
    const double size_6 = fabs(n_axle_theta__axle_theta) + fabs(n_axle_theta__axle_theta_i);
    if (!(size_5 > SINGULAR * size_6))
        return 3;
    const double divisor_6 = 1.0/((scale_axle_theta * scale_axle_theta) + (scale_axle_theta_i * scale_axle_theta_i));
    const double inverse_pivot_axle_theta = divisor_6*scale_axle_theta;
    const double inverse_pivot_axle_theta_i = -divisor_6*scale_axle_theta_i;
    lin->lu[22] = inverse_pivot_axle_theta;
    lin->lu[23] = inverse_pivot_axle_theta_i;
    const double factor_15 = -l_slot_offset__axle_x*n_axle_x__axle_theta
        + l_slot_offset__axle_x_3_i*n_axle_x__axle_theta_i - l_slot_offset__axle_y*u_axle_y__axle_theta
        + l_slot_offset__axle_y_3_i*u_axle_y__axle_theta_i + n_slot_offset__axle_theta;
    const double factor_16 = -l_slot_offset__axle_x*n_axle_x__axle_theta_i
        - l_slot_offset__axle_x_3_i*n_axle_x__axle_theta - l_slot_offset__axle_y*u_axle_y__axle_theta_i
        - l_slot_offset__axle_y_3_i*u_axle_y__axle_theta + n_slot_offset__axle_theta_i;
    const double l_slot_offset__axle_theta = factor_15*inverse_pivot_axle_theta - factor_16*inverse_pivot_axle_theta_i;
    const double l_slot_offset__axle_theta_3_i = factor_15*inverse_pivot_axle_theta_i
        + factor_16*inverse_pivot_axle_theta;
    lin->lu[24] = l_slot_offset__axle_theta;
    lin->lu[25] = l_slot_offset__axle_theta_3_i;
    const double u_axle_theta__slot_offset = -l_axle_theta__axle_x*phi_slot_offset_axle_x
        - l_axle_theta__axle_y*u_axle_y__slot_offset + l_axle_theta__axle_y_i*u_axle_y__slot_offset_i
        + phi_slot_offset_axle_theta;
    const double u_axle_theta__slot_offset_i = -l_axle_theta__axle_x_i*phi_slot_offset_axle_x
        - l_axle_theta__axle_y*u_axle_y__slot_offset_i - l_axle_theta__axle_y_i*u_axle_y__slot_offset;
    lin->lu[26] = u_axle_theta__slot_offset;
    lin->lu[27] = u_axle_theta__slot_offset_i;
    const double scale_slot_offset = -l_slot_offset__axle_theta*u_axle_theta__slot_offset
        + l_slot_offset__axle_theta_3_i*u_axle_theta__slot_offset_i - l_slot_offset__axle_x*phi_slot_offset_axle_x
        - l_slot_offset__axle_y*u_axle_y__slot_offset + l_slot_offset__axle_y_3_i*u_axle_y__slot_offset_i;
    const double scale_slot_offset_3_i = -l_slot_offset__axle_theta*u_axle_theta__slot_offset_i
        - l_slot_offset__axle_theta_3_i*u_axle_theta__slot_offset - l_slot_offset__axle_x_3_i*phi_slot_offset_axle_x
        - l_slot_offset__axle_y*u_axle_y__slot_offset_i - l_slot_offset__axle_y_3_i*u_axle_y__slot_offset;
    const double size_7 = fabs(scale_slot_offset) + fabs(scale_slot_offset_3_i);
    if (!(size_7 > 0.0 && size_7 < INFINITY))
        return 4;
    const double divisor_7 = 1.0/((scale_slot_offset * scale_slot_offset)
        + (scale_slot_offset_3_i * scale_slot_offset_3_i));
    const double inverse_pivot_slot_offset = divisor_7*scale_slot_offset;
    const double inverse_pivot_slot_offset_3_i = -divisor_7*scale_slot_offset_3_i;
    lin->lu[28] = inverse_pivot_slot_offset;
    lin->lu[29] = inverse_pivot_slot_offset_3_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double inverse_pivot_axle_x = lin->lu[0];
    const double inverse_pivot_axle_x_i = lin->lu[1];
    const double l_axle_y__axle_x = lin->lu[2];
    const double l_axle_y__axle_x_i = lin->lu[3];
    const double n_axle_x__axle_y = lin->lu[4];
    const double n_axle_x__axle_y_i = lin->lu[5];
    const double l_axle_theta__axle_x = lin->lu[6];
    const double l_axle_theta__axle_x_i = lin->lu[7];
    const double n_axle_x__axle_theta = lin->lu[8];
    const double n_axle_x__axle_theta_i = lin->lu[9];
    const double l_slot_offset__axle_x = lin->lu[10];
    const double l_slot_offset__axle_x_3_i = lin->lu[11];
    const double inverse_pivot_axle_y = lin->lu[12];
    const double inverse_pivot_axle_y_i = lin->lu[13];
    const double l_axle_theta__axle_y = lin->lu[14];
    const double l_axle_theta__axle_y_i = lin->lu[15];
    const double u_axle_y__axle_theta = lin->lu[16];
    const double u_axle_y__axle_theta_i = lin->lu[17];
    const double l_slot_offset__axle_y = lin->lu[18];
    const double l_slot_offset__axle_y_3_i = lin->lu[19];
    const double u_axle_y__slot_offset = lin->lu[20];
    const double u_axle_y__slot_offset_i = lin->lu[21];
    const double inverse_pivot_axle_theta = lin->lu[22];
    const double inverse_pivot_axle_theta_i = lin->lu[23];
    const double l_slot_offset__axle_theta = lin->lu[24];
    const double l_slot_offset__axle_theta_3_i = lin->lu[25];
    const double u_axle_theta__slot_offset = lin->lu[26];
    const double u_axle_theta__slot_offset_i = lin->lu[27];
    const double inverse_pivot_slot_offset = lin->lu[28];
    const double inverse_pivot_slot_offset_3_i = lin->lu[29];

    /* forward */
    const double b_axle_x = x[0];
    const double b_axle_x_i = x[1];
    const double b_axle_y = -b_axle_x*l_axle_y__axle_x + b_axle_x_i*l_axle_y__axle_x_i + x[2];
    const double b_axle_y_i = -b_axle_x*l_axle_y__axle_x_i - b_axle_x_i*l_axle_y__axle_x + x[3];
    const double b_axle_theta = -b_axle_x*l_axle_theta__axle_x + b_axle_x_i*l_axle_theta__axle_x_i
        - b_axle_y*l_axle_theta__axle_y + b_axle_y_i*l_axle_theta__axle_y_i + x[4];
    const double b_axle_theta_i = -b_axle_x*l_axle_theta__axle_x_i - b_axle_x_i*l_axle_theta__axle_x
        - b_axle_y*l_axle_theta__axle_y_i - b_axle_y_i*l_axle_theta__axle_y + x[5];
    const double b_slot_offset = -b_axle_theta*l_slot_offset__axle_theta + b_axle_theta_i*l_slot_offset__axle_theta_3_i
        - b_axle_x*l_slot_offset__axle_x + b_axle_x_i*l_slot_offset__axle_x_3_i - b_axle_y*l_slot_offset__axle_y
        + b_axle_y_i*l_slot_offset__axle_y_3_i + x[6];
    const double b_slot_offset_i = -b_axle_theta*l_slot_offset__axle_theta_3_i
        - b_axle_theta_i*l_slot_offset__axle_theta - b_axle_x*l_slot_offset__axle_x_3_i
        - b_axle_x_i*l_slot_offset__axle_x - b_axle_y*l_slot_offset__axle_y_3_i - b_axle_y_i*l_slot_offset__axle_y
        + x[7];

    /* backward */
    const double x_slot_offset = b_slot_offset*inverse_pivot_slot_offset
        - b_slot_offset_i*inverse_pivot_slot_offset_3_i;
    const double x_slot_offset_i = b_slot_offset*inverse_pivot_slot_offset_3_i
        + b_slot_offset_i*inverse_pivot_slot_offset;
    x[6] = x_slot_offset;
    x[7] = x_slot_offset_i;
    const double factor_1 = b_axle_theta - u_axle_theta__slot_offset*x_slot_offset
        + u_axle_theta__slot_offset_i*x_slot_offset_i;
    const double factor_2 = b_axle_theta_i - u_axle_theta__slot_offset*x_slot_offset_i
        - u_axle_theta__slot_offset_i*x_slot_offset;
    const double x_axle_theta = factor_1*inverse_pivot_axle_theta - factor_2*inverse_pivot_axle_theta_i;
    const double x_axle_theta_i = factor_1*inverse_pivot_axle_theta_i + factor_2*inverse_pivot_axle_theta;
    x[4] = x_axle_theta;
    x[5] = x_axle_theta_i;
    const double factor_3 = b_axle_y - u_axle_y__axle_theta*x_axle_theta + u_axle_y__axle_theta_i*x_axle_theta_i
        - u_axle_y__slot_offset*x_slot_offset + u_axle_y__slot_offset_i*x_slot_offset_i;
    const double factor_4 = b_axle_y_i - u_axle_y__axle_theta*x_axle_theta_i - u_axle_y__axle_theta_i*x_axle_theta
        - u_axle_y__slot_offset*x_slot_offset_i - u_axle_y__slot_offset_i*x_slot_offset;
    const double x_axle_y = factor_3*inverse_pivot_axle_y - factor_4*inverse_pivot_axle_y_i;
    const double x_axle_y_i = factor_3*inverse_pivot_axle_y_i + factor_4*inverse_pivot_axle_y;
    x[2] = x_axle_y;
    x[3] = x_axle_y_i;
    const double factor_5 = b_axle_x - n_axle_x__axle_theta*x_axle_theta + n_axle_x__axle_theta_i*x_axle_theta_i
        - n_axle_x__axle_y*x_axle_y + n_axle_x__axle_y_i*x_axle_y_i - phi_slot_offset_axle_x*x_slot_offset;
    const double factor_6 = b_axle_x_i - n_axle_x__axle_theta*x_axle_theta_i - n_axle_x__axle_theta_i*x_axle_theta
        - n_axle_x__axle_y*x_axle_y_i - n_axle_x__axle_y_i*x_axle_y - phi_slot_offset_axle_x*x_slot_offset_i;
    const double x_axle_x = factor_5*inverse_pivot_axle_x - factor_6*inverse_pivot_axle_x_i;
    const double x_axle_x_i = factor_5*inverse_pivot_axle_x_i + factor_6*inverse_pivot_axle_x;
    x[0] = x_axle_x;
    x[1] = x_axle_x_i;
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
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double power_q_0_axle_x = lin->value[22];
    const double power_q_0_axle_y = lin->value[23];
    const double power_q_0_axle_theta = lin->value[24];
    const double power_0_slot_offset = lin->value[25];

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
    double x[8];
    const double shifted_axle_x = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[6];
    const double shifted_axle_x_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[7];
    const double shifted_axle_y = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[8];
    const double shifted_axle_y_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[9];
    const double shifted_axle_theta = -p->beta_squared*(eta*r[4] - eta_i*r[5]) + r[10];
    const double shifted_axle_theta_i = -p->beta_squared*(eta*r[5] + eta_i*r[4]) + r[11];
    const double factor_5 = p->axle_mass*r[6] - by_q_axle_x_axle_theta*(eta*r[4] - eta_i*r[5])
        - by_q_axle_x_axle_x*(eta*r[0] - eta_i*r[1]) - by_q_axle_x_axle_y*(eta*r[2] - eta_i*r[3]);
    const double factor_6 = p->axle_mass*r[7] - by_q_axle_x_axle_theta*(eta*r[5] + eta_i*r[4])
        - by_q_axle_x_axle_x*(eta*r[1] + eta_i*r[0]) - by_q_axle_x_axle_y*(eta*r[3] + eta_i*r[2]);
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = p->axle_mass*r[8] - by_q_axle_y_axle_theta*(eta*r[4] - eta_i*r[5])
        - by_q_axle_y_axle_x*(eta*r[0] - eta_i*r[1]) - by_q_axle_y_axle_y*(eta*r[2] - eta_i*r[3]);
    const double factor_8 = p->axle_mass*r[9] - by_q_axle_y_axle_theta*(eta*r[5] + eta_i*r[4])
        - by_q_axle_y_axle_x*(eta*r[1] + eta_i*r[0]) - by_q_axle_y_axle_y*(eta*r[3] + eta_i*r[2]);
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = p->axle_inertia*r[10] - by_q_axle_theta_axle_theta*(eta*r[4] - eta_i*r[5])
        - by_q_axle_theta_axle_x*(eta*r[0] - eta_i*r[1]) - by_q_axle_theta_axle_y*(eta*r[2] - eta_i*r[3]);
    const double factor_10 = p->axle_inertia*r[11] - by_q_axle_theta_axle_theta*(eta*r[5] + eta_i*r[4])
        - by_q_axle_theta_axle_x*(eta*r[1] + eta_i*r[0]) - by_q_axle_theta_axle_y*(eta*r[3] + eta_i*r[2]);
    x[4] = eta*factor_9 - eta_i*factor_10;
    x[5] = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = -by_q_slot_offset_axle_theta*(eta*r[4] - eta_i*r[5])
        - by_q_slot_offset_axle_x*(eta*r[0] - eta_i*r[1]) - by_q_slot_offset_axle_y*(eta*r[2] - eta_i*r[3])
        + phi_slot_offset_axle_theta*shifted_axle_theta + phi_slot_offset_axle_x*shifted_axle_x
        + phi_slot_offset_axle_y*shifted_axle_y;
    const double factor_12 = -by_q_slot_offset_axle_theta*(eta*r[5] + eta_i*r[4])
        - by_q_slot_offset_axle_x*(eta*r[1] + eta_i*r[0]) - by_q_slot_offset_axle_y*(eta*r[3] + eta_i*r[2])
        + phi_slot_offset_axle_theta*shifted_axle_theta_i + phi_slot_offset_axle_x*shifted_axle_x_i
        + phi_slot_offset_axle_y*shifted_axle_y_i;
    x[6] = eta_row*factor_11 - eta_row_i*factor_12;
    x[7] = eta_row*factor_12 + eta_row_i*factor_11;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_13 = r[0] + x[0];
    const double factor_14 = r[1] + x[1];
    u[0] = eta*factor_13 - eta_i*factor_14;
    u[1] = eta*factor_14 + eta_i*factor_13;
    u[6] = x[0];
    u[7] = x[1];
    const double factor_15 = r[2] + x[2];
    const double factor_16 = r[3] + x[3];
    u[2] = eta*factor_15 - eta_i*factor_16;
    u[3] = eta*factor_16 + eta_i*factor_15;
    u[8] = x[2];
    u[9] = x[3];
    const double factor_17 = r[4] + x[4];
    const double factor_18 = r[5] + x[5];
    u[4] = eta*factor_17 - eta_i*factor_18;
    u[5] = eta*factor_18 + eta_i*factor_17;
    u[10] = x[4];
    u[11] = x[5];
    const double factor_19 = power_q_0_axle_theta*u[4] + power_q_0_axle_x*u[0] + power_q_0_axle_y*u[2] + r[12];
    const double factor_20 = power_q_0_axle_theta*u[5] + power_q_0_axle_x*u[1] + power_q_0_axle_y*u[3] + r[13];
    u[12] = eta*factor_19 - eta_i*factor_20 + power_0_slot_offset*x[6];
    u[13] = eta*factor_20 + eta_i*factor_19 + power_0_slot_offset*x[7];
    u[14] = eta*r[14] - eta_i*r[15];
    u[15] = eta*r[15] + eta_i*r[14];
    u[16] = eta*r[16] - eta_i*r[17];
    u[17] = eta*r[17] + eta_i*r[16];
}
