/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_crank0_theta__crank0_theta = by_q_crank0_theta_crank0_theta*(eta * eta) + p->mass_crank0_crank0;
    const Complex n_crank0_theta__coupler1_theta = eta*(by_q_crank0_theta_coupler1_theta*eta
        + by_v_crank0_theta_coupler1_theta) + mass_crank0_theta_coupler1_theta;
    const Complex n_crank1_theta__crank1_theta = by_q_crank1_theta_crank1_theta*(eta * eta) + p->mass_crank1_crank1;
    const Complex n_crank1_theta__coupler2_theta = eta*(by_q_crank1_theta_coupler2_theta*eta
        + by_v_crank1_theta_coupler2_theta) + mass_crank1_theta_coupler2_theta;
    const Complex n_crank2_theta__crank2_theta = by_q_crank2_theta_crank2_theta*(eta * eta) + p->mass_crank2_crank2;
    const Complex n_coupler1_theta__crank0_theta = eta*(by_q_coupler1_theta_crank0_theta*eta
        + by_v_coupler1_theta_crank0_theta) + mass_crank0_theta_coupler1_theta;
    const Complex n_coupler1_theta__coupler1_theta = by_q_coupler1_theta_coupler1_theta*(eta * eta)
        + p->mass_coupler1_coupler1;
    const Complex n_coupler2_theta__crank1_theta = eta*(by_q_coupler2_theta_crank1_theta*eta
        + by_v_coupler2_theta_crank1_theta) + mass_crank1_theta_coupler2_theta;
    const Complex n_coupler2_theta__coupler2_theta = by_q_coupler2_theta_coupler2_theta*(eta * eta)
        + p->mass_coupler2_coupler2;
    const Complex n_B2_x__crank1_theta = eta_row*(by_q_B2_x_crank1_theta*eta + by_v_B2_x_crank1_theta)
        + phi_B2_x_crank1_theta;
    const Complex n_B2_x__crank2_theta = eta_row*(by_q_B2_x_crank2_theta*eta + by_v_B2_x_crank2_theta)
        + phi_B2_x_crank2_theta;
    const Complex n_B2_x__coupler2_theta = eta_row*(by_q_B2_x_coupler2_theta*eta + by_v_B2_x_coupler2_theta)
        + phi_B2_x_coupler2_theta;
    const Complex n_B2_y__crank1_theta = eta_row*(by_q_B2_y_crank1_theta*eta + by_v_B2_y_crank1_theta)
        + phi_B2_y_crank1_theta;
    const Complex n_B2_y__crank2_theta = eta_row*(by_q_B2_y_crank2_theta*eta + by_v_B2_y_crank2_theta)
        + phi_B2_y_crank2_theta;
    const Complex n_B2_y__coupler2_theta = eta_row*(by_q_B2_y_coupler2_theta*eta + by_v_B2_y_coupler2_theta)
        + phi_B2_y_coupler2_theta;
    const Complex n_B1_x__crank0_theta = eta_row*(by_q_B1_x_crank0_theta*eta + by_v_B1_x_crank0_theta)
        + phi_B1_x_crank0_theta;
    const Complex n_B1_x__crank1_theta = eta_row*(-by_q_B2_x_crank1_theta*eta - by_v_B2_x_crank1_theta)
        - phi_B2_x_crank1_theta;
    const Complex n_B1_x__coupler1_theta = eta_row*(by_q_B1_x_coupler1_theta*eta + by_v_B1_x_coupler1_theta)
        + phi_B1_x_coupler1_theta;
    const Complex n_B1_y__crank0_theta = eta_row*(by_q_B1_y_crank0_theta*eta + by_v_B1_y_crank0_theta)
        + phi_B1_y_crank0_theta;
    const Complex n_B1_y__crank1_theta = eta_row*(-by_q_B2_y_crank1_theta*eta - by_v_B2_y_crank1_theta)
        - phi_B2_y_crank1_theta;
    const Complex n_B1_y__coupler1_theta = eta_row*(by_q_B1_y_coupler1_theta*eta + by_v_B1_y_coupler1_theta)
        + phi_B1_y_coupler1_theta;

    /* L U */
    const Complex scale_crank2_theta = n_crank2_theta__crank2_theta;
    if (!(complex_size(scale_crank2_theta) > SINGULAR * complex_size(n_crank2_theta__crank2_theta)))
        return 3;
    const Complex inverse_pivot_crank2_theta = 1.0/scale_crank2_theta;
    lin->lu[0] = inverse_pivot_crank2_theta;
    const Complex l_B2_x__crank2_theta = inverse_pivot_crank2_theta*n_B2_x__crank2_theta;
    lin->lu[1] = l_B2_x__crank2_theta;
    const Complex l_B2_y__crank2_theta = inverse_pivot_crank2_theta*n_B2_y__crank2_theta;
    lin->lu[2] = l_B2_y__crank2_theta;
    const Complex scale_crank0_theta = n_crank0_theta__crank0_theta;
    if (!(complex_size(scale_crank0_theta) > SINGULAR * complex_size(n_crank0_theta__crank0_theta)))
        return 1;
    const Complex inverse_pivot_crank0_theta = 1.0/scale_crank0_theta;
    lin->lu[3] = inverse_pivot_crank0_theta;
    const Complex l_coupler1_theta__crank0_theta = inverse_pivot_crank0_theta*n_coupler1_theta__crank0_theta;
    lin->lu[4] = l_coupler1_theta__crank0_theta;
    lin->lu[5] = n_crank0_theta__coupler1_theta;
    const Complex l_B1_x__crank0_theta = inverse_pivot_crank0_theta*n_B1_x__crank0_theta;
    lin->lu[6] = l_B1_x__crank0_theta;
    const Complex l_B1_y__crank0_theta = inverse_pivot_crank0_theta*n_B1_y__crank0_theta;
    lin->lu[7] = l_B1_y__crank0_theta;
    const Complex scale_coupler1_theta = -l_coupler1_theta__crank0_theta*n_crank0_theta__coupler1_theta
        + n_coupler1_theta__coupler1_theta;
    if (!(complex_size(scale_coupler1_theta) > SINGULAR * complex_size(n_coupler1_theta__coupler1_theta)))
        return 4;
    const Complex inverse_pivot_coupler1_theta = 1.0/scale_coupler1_theta;
    lin->lu[8] = inverse_pivot_coupler1_theta;
    const Complex l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_x__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_x__coupler1_theta);
    lin->lu[9] = l_B1_x__coupler1_theta;
    const Complex u_coupler1_theta__B1_x = -l_coupler1_theta__crank0_theta*phi_B1_x_crank0_theta
        + phi_B1_x_coupler1_theta;
    lin->lu[10] = u_coupler1_theta__B1_x;
    const Complex l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_y__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_y__coupler1_theta);
    lin->lu[11] = l_B1_y__coupler1_theta;
    const Complex u_coupler1_theta__B1_y = -l_coupler1_theta__crank0_theta*phi_B1_y_crank0_theta
        + phi_B1_y_coupler1_theta;
    lin->lu[12] = u_coupler1_theta__B1_y;
    const Complex scale_coupler2_theta = n_coupler2_theta__coupler2_theta;
    if (!(complex_size(scale_coupler2_theta) > SINGULAR * complex_size(n_coupler2_theta__coupler2_theta)))
        return 5;
    const Complex inverse_pivot_coupler2_theta = 1.0/scale_coupler2_theta;
    lin->lu[13] = inverse_pivot_coupler2_theta;
    const Complex l_crank1_theta__coupler2_theta = inverse_pivot_coupler2_theta*n_crank1_theta__coupler2_theta;
    lin->lu[14] = l_crank1_theta__coupler2_theta;
    lin->lu[15] = n_coupler2_theta__crank1_theta;
    const Complex l_B2_x__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta;
    lin->lu[16] = l_B2_x__coupler2_theta;
    const Complex l_B2_y__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta;
    lin->lu[17] = l_B2_y__coupler2_theta;
    const Complex scale_crank1_theta = -l_crank1_theta__coupler2_theta*n_coupler2_theta__crank1_theta
        + n_crank1_theta__crank1_theta;
    if (!(complex_size(scale_crank1_theta) > SINGULAR * complex_size(n_crank1_theta__crank1_theta)))
        return 2;
    const Complex inverse_pivot_crank1_theta = 1.0/scale_crank1_theta;
    lin->lu[18] = inverse_pivot_crank1_theta;
    const Complex l_B2_x__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_x__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_x__crank1_theta);
    lin->lu[19] = l_B2_x__crank1_theta;
    const Complex u_crank1_theta__B2_x = -l_crank1_theta__coupler2_theta*phi_B2_x_coupler2_theta
        + phi_B2_x_crank1_theta;
    lin->lu[20] = u_crank1_theta__B2_x;
    const Complex l_B2_y__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_y__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_y__crank1_theta);
    lin->lu[21] = l_B2_y__crank1_theta;
    const Complex u_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*phi_B2_y_coupler2_theta
        + phi_B2_y_crank1_theta;
    lin->lu[22] = u_crank1_theta__B2_y;
    const Complex l_B1_x__crank1_theta = inverse_pivot_crank1_theta*n_B1_x__crank1_theta;
    lin->lu[23] = l_B1_x__crank1_theta;
    const Complex l_B1_y__crank1_theta = inverse_pivot_crank1_theta*n_B1_y__crank1_theta;
    lin->lu[24] = l_B1_y__crank1_theta;
    const Complex scale_B2_x = -l_B2_x__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_x - l_B2_x__crank2_theta*phi_B2_x_crank2_theta;
    if (!(complex_size(scale_B2_x) > 0.0 && complex_size(scale_B2_x) <= DBL_MAX))
        return 6;
    const Complex inverse_pivot_B2_x = 1.0/scale_B2_x;
    lin->lu[25] = inverse_pivot_B2_x;
    const Complex l_B2_y__B2_x = inverse_pivot_B2_x*(-l_B2_y__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_x - l_B2_y__crank2_theta*phi_B2_x_crank2_theta);
    lin->lu[26] = l_B2_y__B2_x;
    const Complex u_B2_x__B2_y = -l_B2_x__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_y - l_B2_x__crank2_theta*phi_B2_y_crank2_theta;
    lin->lu[27] = u_B2_x__B2_y;
    const Complex l_B1_x__B2_x = -inverse_pivot_B2_x*l_B1_x__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[28] = l_B1_x__B2_x;
    const Complex u_B2_x__B1_x = l_B2_x__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[29] = u_B2_x__B1_x;
    const Complex l_B1_y__B2_x = -inverse_pivot_B2_x*l_B1_y__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[30] = l_B1_y__B2_x;
    const Complex u_B2_x__B1_y = l_B2_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[31] = u_B2_x__B1_y;
    const Complex scale_B2_y = -l_B2_y__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_y - l_B2_y__crank2_theta*phi_B2_y_crank2_theta;
    const Complex pivot_B2_y = -l_B2_y__B2_x*u_B2_x__B2_y + scale_B2_y;
    if (!(complex_size(pivot_B2_y) > SINGULAR * complex_size(scale_B2_y)))
        return 7;
    const Complex inverse_pivot_B2_y = 1.0/pivot_B2_y;
    lin->lu[32] = inverse_pivot_B2_y;
    const Complex l_B1_x__B2_y = inverse_pivot_B2_y*(-l_B1_x__B2_x*u_B2_x__B2_y
        - l_B1_x__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[33] = l_B1_x__B2_y;
    const Complex u_B2_y__B1_x = -l_B2_y__B2_x*u_B2_x__B1_x + l_B2_y__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[34] = u_B2_y__B1_x;
    const Complex l_B1_y__B2_y = inverse_pivot_B2_y*(-l_B1_y__B2_x*u_B2_x__B2_y
        - l_B1_y__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[35] = l_B1_y__B2_y;
    const Complex u_B2_y__B1_y = -l_B2_y__B2_x*u_B2_x__B1_y + l_B2_y__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[36] = u_B2_y__B1_y;
    const Complex scale_B1_x = -l_B1_x__coupler1_theta*u_coupler1_theta__B1_x
        - l_B1_x__crank0_theta*phi_B1_x_crank0_theta + l_B1_x__crank1_theta*phi_B2_x_crank1_theta;
    const Complex pivot_B1_x = -l_B1_x__B2_x*u_B2_x__B1_x - l_B1_x__B2_y*u_B2_y__B1_x + scale_B1_x;
    if (!(complex_size(pivot_B1_x) > SINGULAR * complex_size(scale_B1_x)))
        return 8;
    const Complex inverse_pivot_B1_x = 1.0/pivot_B1_x;
    lin->lu[37] = inverse_pivot_B1_x;
    const Complex l_B1_y__B1_x = inverse_pivot_B1_x*(-l_B1_y__B2_x*u_B2_x__B1_x - l_B1_y__B2_y*u_B2_y__B1_x
        - l_B1_y__coupler1_theta*u_coupler1_theta__B1_x - l_B1_y__crank0_theta*phi_B1_x_crank0_theta
        + l_B1_y__crank1_theta*phi_B2_x_crank1_theta);
    lin->lu[38] = l_B1_y__B1_x;
    const Complex u_B1_x__B1_y = -l_B1_x__B2_x*u_B2_x__B1_y - l_B1_x__B2_y*u_B2_y__B1_y
        - l_B1_x__coupler1_theta*u_coupler1_theta__B1_y - l_B1_x__crank0_theta*phi_B1_y_crank0_theta
        + l_B1_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[39] = u_B1_x__B1_y;
    const Complex scale_B1_y = -l_B1_y__coupler1_theta*u_coupler1_theta__B1_y
        - l_B1_y__crank0_theta*phi_B1_y_crank0_theta + l_B1_y__crank1_theta*phi_B2_y_crank1_theta;
    const Complex pivot_B1_y = -l_B1_y__B1_x*u_B1_x__B1_y - l_B1_y__B2_x*u_B2_x__B1_y - l_B1_y__B2_y*u_B2_y__B1_y
        + scale_B1_y;
    if (!(complex_size(pivot_B1_y) > SINGULAR * complex_size(scale_B1_y)))
        return 9;
    const Complex inverse_pivot_B1_y = 1.0/pivot_B1_y;
    lin->lu[40] = inverse_pivot_B1_y;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
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
    const Complex inverse_pivot_crank2_theta = lin->lu[0];
    const Complex l_B2_x__crank2_theta = lin->lu[1];
    const Complex l_B2_y__crank2_theta = lin->lu[2];
    const Complex inverse_pivot_crank0_theta = lin->lu[3];
    const Complex l_coupler1_theta__crank0_theta = lin->lu[4];
    const Complex n_crank0_theta__coupler1_theta = lin->lu[5];
    const Complex l_B1_x__crank0_theta = lin->lu[6];
    const Complex l_B1_y__crank0_theta = lin->lu[7];
    const Complex inverse_pivot_coupler1_theta = lin->lu[8];
    const Complex l_B1_x__coupler1_theta = lin->lu[9];
    const Complex u_coupler1_theta__B1_x = lin->lu[10];
    const Complex l_B1_y__coupler1_theta = lin->lu[11];
    const Complex u_coupler1_theta__B1_y = lin->lu[12];
    const Complex inverse_pivot_coupler2_theta = lin->lu[13];
    const Complex l_crank1_theta__coupler2_theta = lin->lu[14];
    const Complex n_coupler2_theta__crank1_theta = lin->lu[15];
    const Complex l_B2_x__coupler2_theta = lin->lu[16];
    const Complex l_B2_y__coupler2_theta = lin->lu[17];
    const Complex inverse_pivot_crank1_theta = lin->lu[18];
    const Complex l_B2_x__crank1_theta = lin->lu[19];
    const Complex u_crank1_theta__B2_x = lin->lu[20];
    const Complex l_B2_y__crank1_theta = lin->lu[21];
    const Complex u_crank1_theta__B2_y = lin->lu[22];
    const Complex l_B1_x__crank1_theta = lin->lu[23];
    const Complex l_B1_y__crank1_theta = lin->lu[24];
    const Complex inverse_pivot_B2_x = lin->lu[25];
    const Complex l_B2_y__B2_x = lin->lu[26];
    const Complex u_B2_x__B2_y = lin->lu[27];
    const Complex l_B1_x__B2_x = lin->lu[28];
    const Complex u_B2_x__B1_x = lin->lu[29];
    const Complex l_B1_y__B2_x = lin->lu[30];
    const Complex u_B2_x__B1_y = lin->lu[31];
    const Complex inverse_pivot_B2_y = lin->lu[32];
    const Complex l_B1_x__B2_y = lin->lu[33];
    const Complex u_B2_y__B1_x = lin->lu[34];
    const Complex l_B1_y__B2_y = lin->lu[35];
    const Complex u_B2_y__B1_y = lin->lu[36];
    const Complex inverse_pivot_B1_x = lin->lu[37];
    const Complex l_B1_y__B1_x = lin->lu[38];
    const Complex u_B1_x__B1_y = lin->lu[39];
    const Complex inverse_pivot_B1_y = lin->lu[40];

    /* forward */
    const Complex b_crank2_theta = x[2];
    const Complex b_crank0_theta = x[0];
    const Complex b_coupler1_theta = -b_crank0_theta*l_coupler1_theta__crank0_theta + x[3];
    const Complex b_coupler2_theta = x[4];
    const Complex b_crank1_theta = -b_coupler2_theta*l_crank1_theta__coupler2_theta + x[1];
    const Complex b_B2_x = -b_coupler2_theta*l_B2_x__coupler2_theta - b_crank1_theta*l_B2_x__crank1_theta
        - b_crank2_theta*l_B2_x__crank2_theta + x[5];
    const Complex b_B2_y = -b_B2_x*l_B2_y__B2_x - b_coupler2_theta*l_B2_y__coupler2_theta
        - b_crank1_theta*l_B2_y__crank1_theta - b_crank2_theta*l_B2_y__crank2_theta + x[6];
    const Complex b_B1_x = -b_B2_x*l_B1_x__B2_x - b_B2_y*l_B1_x__B2_y - b_coupler1_theta*l_B1_x__coupler1_theta
        - b_crank0_theta*l_B1_x__crank0_theta - b_crank1_theta*l_B1_x__crank1_theta + x[7];
    const Complex b_B1_y = -b_B1_x*l_B1_y__B1_x - b_B2_x*l_B1_y__B2_x - b_B2_y*l_B1_y__B2_y
        - b_coupler1_theta*l_B1_y__coupler1_theta - b_crank0_theta*l_B1_y__crank0_theta
        - b_crank1_theta*l_B1_y__crank1_theta + x[8];

    /* backward */
    const Complex x_B1_y = b_B1_y*inverse_pivot_B1_y;
    x[8] = x_B1_y;
    const Complex x_B1_x = inverse_pivot_B1_x*(b_B1_x - u_B1_x__B1_y*x_B1_y);
    x[7] = x_B1_x;
    const Complex x_B2_y = inverse_pivot_B2_y*(b_B2_y - u_B2_y__B1_x*x_B1_x - u_B2_y__B1_y*x_B1_y);
    x[6] = x_B2_y;
    const Complex x_B2_x = inverse_pivot_B2_x*(b_B2_x - u_B2_x__B1_x*x_B1_x - u_B2_x__B1_y*x_B1_y
        - u_B2_x__B2_y*x_B2_y);
    x[5] = x_B2_x;
    const Complex x_crank1_theta = inverse_pivot_crank1_theta*(b_crank1_theta + phi_B2_x_crank1_theta*x_B1_x
        + phi_B2_y_crank1_theta*x_B1_y - u_crank1_theta__B2_x*x_B2_x - u_crank1_theta__B2_y*x_B2_y);
    x[1] = x_crank1_theta;
    const Complex x_coupler2_theta = inverse_pivot_coupler2_theta*(b_coupler2_theta
        - n_coupler2_theta__crank1_theta*x_crank1_theta - phi_B2_x_coupler2_theta*x_B2_x
        - phi_B2_y_coupler2_theta*x_B2_y);
    x[4] = x_coupler2_theta;
    const Complex x_coupler1_theta = inverse_pivot_coupler1_theta*(b_coupler1_theta - u_coupler1_theta__B1_x*x_B1_x
        - u_coupler1_theta__B1_y*x_B1_y);
    x[3] = x_coupler1_theta;
    const Complex x_crank0_theta = inverse_pivot_crank0_theta*(b_crank0_theta
        - n_crank0_theta__coupler1_theta*x_coupler1_theta - phi_B1_x_crank0_theta*x_B1_x
        - phi_B1_y_crank0_theta*x_B1_y);
    x[0] = x_crank0_theta;
    const Complex x_crank2_theta = inverse_pivot_crank2_theta*(b_crank2_theta - phi_B2_x_crank2_theta*x_B2_x
        - phi_B2_y_crank2_theta*x_B2_y);
    x[2] = x_crank2_theta;
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[9];
    const Complex shifted_crank0_theta = -p->beta_squared*eta*r[0] + r[5];
    const Complex shifted_crank1_theta = -p->beta_squared*eta*r[1] + r[6];
    const Complex shifted_crank2_theta = -p->beta_squared*eta*r[2] + r[7];
    const Complex shifted_coupler1_theta = -p->beta_squared*eta*r[3] + r[8];
    const Complex shifted_coupler2_theta = -p->beta_squared*eta*r[4] + r[9];
    x[0] = eta*(-by_q_crank0_theta_coupler1_theta*eta*r[3] - by_q_crank0_theta_crank0_theta*eta*r[0]
        + p->mass_crank0_crank0*r[5] + mass_crank0_theta_coupler1_theta*r[8]);
    x[1] = eta*(-by_q_crank1_theta_coupler2_theta*eta*r[4] - by_q_crank1_theta_crank1_theta*eta*r[1]
        + p->mass_crank1_crank1*r[6] + mass_crank1_theta_coupler2_theta*r[9]);
    x[2] = eta*(-by_q_crank2_theta_crank2_theta*eta*r[2] + p->mass_crank2_crank2*r[7]);
    x[3] = eta*(-by_q_coupler1_theta_coupler1_theta*eta*r[3] - by_q_coupler1_theta_crank0_theta*eta*r[0]
        + p->mass_coupler1_coupler1*r[8] + mass_crank0_theta_coupler1_theta*r[5]);
    x[4] = eta*(-by_q_coupler2_theta_coupler2_theta*eta*r[4] - by_q_coupler2_theta_crank1_theta*eta*r[1]
        + p->mass_coupler2_coupler2*r[9] + mass_crank1_theta_coupler2_theta*r[6]);
    x[5] = eta_row*(-by_q_B2_x_coupler2_theta*eta*r[4] - by_q_B2_x_crank1_theta*eta*r[1]
        - by_q_B2_x_crank2_theta*eta*r[2] + phi_B2_x_coupler2_theta*shifted_coupler2_theta
        + phi_B2_x_crank1_theta*shifted_crank1_theta + phi_B2_x_crank2_theta*shifted_crank2_theta);
    x[6] = eta_row*(-by_q_B2_y_coupler2_theta*eta*r[4] - by_q_B2_y_crank1_theta*eta*r[1]
        - by_q_B2_y_crank2_theta*eta*r[2] + phi_B2_y_coupler2_theta*shifted_coupler2_theta
        + phi_B2_y_crank1_theta*shifted_crank1_theta + phi_B2_y_crank2_theta*shifted_crank2_theta);
    x[7] = eta_row*(-by_q_B1_x_coupler1_theta*eta*r[3] - by_q_B1_x_crank0_theta*eta*r[0]
        + by_q_B2_x_crank1_theta*eta*r[1] + phi_B1_x_coupler1_theta*shifted_coupler1_theta
        + phi_B1_x_crank0_theta*shifted_crank0_theta - phi_B2_x_crank1_theta*shifted_crank1_theta);
    x[8] = eta_row*(-by_q_B1_y_coupler1_theta*eta*r[3] - by_q_B1_y_crank0_theta*eta*r[0]
        + by_q_B2_y_crank1_theta*eta*r[1] + phi_B1_y_coupler1_theta*shifted_coupler1_theta
        + phi_B1_y_crank0_theta*shifted_crank0_theta - phi_B2_y_crank1_theta*shifted_crank1_theta);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[5] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[6] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[7] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[8] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[9] = x[4];
    u[10] = eta*r[10];
    u[11] = eta*r[11];
    u[12] = eta*r[12];
}
