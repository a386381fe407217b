/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta = lin->value[0];
    const double mass_L6_theta_L2_theta = lin->value[1];
    const double mass_L7_theta_L2_theta = lin->value[2];
    const double mass_L6_theta_L3_theta = lin->value[3];
    const double mass_L7_theta_L3_theta = lin->value[4];
    const double mass_L6_theta_L8_theta = lin->value[5];
    const double phi_guide_offset_L6_theta = lin->value[6];
    const double phi_guide_offset_L8_theta = lin->value[7];
    const double by_q_guide_offset_L6_theta = lin->value[8];
    const double by_q_guide_offset_L8_theta = lin->value[9];
    const double by_q_L6_theta_L6_theta = lin->value[10];
    const double by_q_L6_theta_L7_theta = lin->value[11];
    const double by_q_L6_theta_L2_theta = lin->value[12];
    const double by_q_L6_theta_L3_theta = lin->value[13];
    const double by_q_L6_theta_L8_theta = lin->value[14];
    const double by_q_L7_theta_L6_theta = lin->value[15];
    const double by_q_L7_theta_L7_theta = lin->value[16];
    const double by_q_L7_theta_L2_theta = lin->value[17];
    const double by_q_L7_theta_L3_theta = lin->value[18];
    const double by_q_L8_theta_L8_theta = lin->value[19];
    const double by_q_L8_theta_L6_theta = lin->value[20];
    const double by_q_L2_theta_L6_theta = lin->value[21];
    const double by_q_L2_theta_L7_theta = lin->value[22];
    const double by_q_L2_theta_L2_theta = lin->value[23];
    const double by_q_L3_theta_L6_theta = lin->value[24];
    const double by_q_L3_theta_L7_theta = lin->value[25];
    const double by_q_L3_theta_L3_theta = lin->value[26];
    const double by_v_guide_offset_L6_theta = lin->value[27];
    const double by_v_guide_offset_L8_theta = lin->value[28];
    const double by_v_L6_theta_L6_theta = lin->value[29];
    const double by_v_L6_theta_L7_theta = lin->value[30];
    const double by_v_L6_theta_L2_theta = lin->value[31];
    const double by_v_L6_theta_L3_theta = lin->value[32];
    const double by_v_L6_theta_L8_theta = lin->value[33];
    const double by_v_L7_theta_L6_theta = lin->value[34];
    const double by_v_L7_theta_L7_theta = lin->value[35];
    const double by_v_L7_theta_L2_theta = lin->value[36];
    const double by_v_L7_theta_L3_theta = lin->value[37];
    const double by_v_L8_theta_L6_theta = lin->value[38];
    const double by_v_L2_theta_L6_theta = lin->value[39];
    const double by_v_L2_theta_L7_theta = lin->value[40];
    const double by_v_L2_theta_L2_theta = lin->value[41];
    const double by_v_L3_theta_L6_theta = lin->value[42];
    const double by_v_L3_theta_L7_theta = lin->value[43];
    const double by_v_L3_theta_L3_theta = lin->value[44];

    /* eta/kappa */
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_L6_theta__L6_theta = eta*(by_q_L6_theta_L6_theta*eta + by_v_L6_theta_L6_theta) + p->mass_L6_L6;
    const Complex n_L6_theta__L7_theta = eta*(by_q_L6_theta_L7_theta*eta + by_v_L6_theta_L7_theta)
        + mass_L6_theta_L7_theta;
    const Complex n_L6_theta__L8_theta = eta*(by_q_L6_theta_L8_theta*eta + by_v_L6_theta_L8_theta)
        + mass_L6_theta_L8_theta;
    const Complex n_L6_theta__L2_theta = eta*(by_q_L6_theta_L2_theta*eta + by_v_L6_theta_L2_theta)
        + mass_L6_theta_L2_theta;
    const Complex n_L6_theta__L3_theta = eta*(by_q_L6_theta_L3_theta*eta + by_v_L6_theta_L3_theta)
        + mass_L6_theta_L3_theta;
    const Complex n_L7_theta__L6_theta = eta*(by_q_L7_theta_L6_theta*eta + by_v_L7_theta_L6_theta)
        + mass_L6_theta_L7_theta;
    const Complex n_L7_theta__L7_theta = eta*(by_q_L7_theta_L7_theta*eta + by_v_L7_theta_L7_theta) + p->mass_L7_L7;
    const Complex n_L7_theta__L2_theta = eta*(by_q_L7_theta_L2_theta*eta + by_v_L7_theta_L2_theta)
        + mass_L7_theta_L2_theta;
    const Complex n_L7_theta__L3_theta = eta*(by_q_L7_theta_L3_theta*eta + by_v_L7_theta_L3_theta)
        + mass_L7_theta_L3_theta;
    const Complex n_L8_theta__L6_theta = eta*(by_q_L8_theta_L6_theta*eta + by_v_L8_theta_L6_theta)
        + mass_L6_theta_L8_theta;
    const Complex n_L8_theta__L8_theta = by_q_L8_theta_L8_theta*(eta * eta) + p->mass_L8_L8;
    const Complex n_L2_theta__L6_theta = eta*(by_q_L2_theta_L6_theta*eta + by_v_L2_theta_L6_theta)
        + mass_L6_theta_L2_theta;
    const Complex n_L2_theta__L7_theta = eta*(by_q_L2_theta_L7_theta*eta + by_v_L2_theta_L7_theta)
        + mass_L7_theta_L2_theta;
    const Complex n_L2_theta__L2_theta = eta*(by_q_L2_theta_L2_theta*eta + by_v_L2_theta_L2_theta) + p->mass_L2_L2;
    const Complex n_L3_theta__L6_theta = eta*(by_q_L3_theta_L6_theta*eta + by_v_L3_theta_L6_theta)
        + mass_L6_theta_L3_theta;
    const Complex n_L3_theta__L7_theta = eta*(by_q_L3_theta_L7_theta*eta + by_v_L3_theta_L7_theta)
        + mass_L7_theta_L3_theta;
    const Complex n_L3_theta__L3_theta = eta*(by_q_L3_theta_L3_theta*eta + by_v_L3_theta_L3_theta) + p->mass_L3_L3;
    const Complex n_guide_offset__L6_theta = eta_row*(by_q_guide_offset_L6_theta*eta + by_v_guide_offset_L6_theta)
        + phi_guide_offset_L6_theta;
    const Complex n_guide_offset__L8_theta = eta_row*(by_q_guide_offset_L8_theta*eta + by_v_guide_offset_L8_theta)
        + phi_guide_offset_L8_theta;

    /* L U */
    const Complex scale_L8_theta = n_L8_theta__L8_theta;
    if (!(complex_size(scale_L8_theta) > SINGULAR * complex_size(n_L8_theta__L8_theta)))
        return 3;
    const Complex inverse_pivot_L8_theta = 1.0/scale_L8_theta;
    lin->lu[0] = inverse_pivot_L8_theta;
    const Complex l_L6_theta__L8_theta = inverse_pivot_L8_theta*n_L6_theta__L8_theta;
    lin->lu[1] = l_L6_theta__L8_theta;
    lin->lu[2] = n_L8_theta__L6_theta;
    const Complex l_guide_offset__L8_theta = inverse_pivot_L8_theta*n_guide_offset__L8_theta;
    lin->lu[3] = l_guide_offset__L8_theta;
    const Complex scale_L2_theta = n_L2_theta__L2_theta;
    if (!(complex_size(scale_L2_theta) > SINGULAR * complex_size(n_L2_theta__L2_theta)))
        return 4;
    const Complex inverse_pivot_L2_theta = 1.0/scale_L2_theta;
    lin->lu[4] = inverse_pivot_L2_theta;
    const Complex l_L7_theta__L2_theta = inverse_pivot_L2_theta*n_L7_theta__L2_theta;
    lin->lu[5] = l_L7_theta__L2_theta;
    lin->lu[6] = n_L2_theta__L7_theta;
    const Complex l_L6_theta__L2_theta = inverse_pivot_L2_theta*n_L6_theta__L2_theta;
    lin->lu[7] = l_L6_theta__L2_theta;
    lin->lu[8] = n_L2_theta__L6_theta;
    const Complex scale_L7_theta = -l_L7_theta__L2_theta*n_L2_theta__L7_theta + n_L7_theta__L7_theta;
    if (!(complex_size(scale_L7_theta) > SINGULAR * complex_size(n_L7_theta__L7_theta)))
        return 2;
    const Complex inverse_pivot_L7_theta = 1.0/scale_L7_theta;
    lin->lu[9] = inverse_pivot_L7_theta;
    const Complex l_L3_theta__L7_theta = inverse_pivot_L7_theta*n_L3_theta__L7_theta;
    lin->lu[10] = l_L3_theta__L7_theta;
    lin->lu[11] = n_L7_theta__L3_theta;
    const Complex l_L6_theta__L7_theta = inverse_pivot_L7_theta*(-l_L6_theta__L2_theta*n_L2_theta__L7_theta
        + n_L6_theta__L7_theta);
    lin->lu[12] = l_L6_theta__L7_theta;
    const Complex u_L7_theta__L6_theta = -l_L7_theta__L2_theta*n_L2_theta__L6_theta + n_L7_theta__L6_theta;
    lin->lu[13] = u_L7_theta__L6_theta;
    const Complex scale_L3_theta = -l_L3_theta__L7_theta*n_L7_theta__L3_theta + n_L3_theta__L3_theta;
    if (!(complex_size(scale_L3_theta) > SINGULAR * complex_size(n_L3_theta__L3_theta)))
        return 5;
    const Complex inverse_pivot_L3_theta = 1.0/scale_L3_theta;
    lin->lu[14] = inverse_pivot_L3_theta;
    const Complex l_L6_theta__L3_theta = inverse_pivot_L3_theta*(-l_L6_theta__L7_theta*n_L7_theta__L3_theta
        + n_L6_theta__L3_theta);
    lin->lu[15] = l_L6_theta__L3_theta;
    const Complex u_L3_theta__L6_theta = -l_L3_theta__L7_theta*u_L7_theta__L6_theta + n_L3_theta__L6_theta;
    lin->lu[16] = u_L3_theta__L6_theta;
    const Complex scale_L6_theta = -l_L6_theta__L2_theta*n_L2_theta__L6_theta
        - l_L6_theta__L3_theta*u_L3_theta__L6_theta - l_L6_theta__L7_theta*u_L7_theta__L6_theta
        - l_L6_theta__L8_theta*n_L8_theta__L6_theta + n_L6_theta__L6_theta;
    if (!(complex_size(scale_L6_theta) > SINGULAR * complex_size(n_L6_theta__L6_theta)))
        return 1;
    const Complex inverse_pivot_L6_theta = 1.0/scale_L6_theta;
    lin->lu[17] = inverse_pivot_L6_theta;
    const Complex l_guide_offset__L6_theta = inverse_pivot_L6_theta*(-l_guide_offset__L8_theta*n_L8_theta__L6_theta
        + n_guide_offset__L6_theta);
    lin->lu[18] = l_guide_offset__L6_theta;
    const Complex u_L6_theta__guide_offset = -l_L6_theta__L8_theta*phi_guide_offset_L8_theta
        + phi_guide_offset_L6_theta;
    lin->lu[19] = u_L6_theta__guide_offset;
    const Complex scale_guide_offset = -l_guide_offset__L6_theta*u_L6_theta__guide_offset
        - l_guide_offset__L8_theta*phi_guide_offset_L8_theta;
    if (!(complex_size(scale_guide_offset) > 0.0 && complex_size(scale_guide_offset) <= DBL_MAX))
        return 6;
    const Complex inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    lin->lu[20] = inverse_pivot_guide_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const double phi_guide_offset_L8_theta = lin->value[7];
    const Complex inverse_pivot_L8_theta = lin->lu[0];
    const Complex l_L6_theta__L8_theta = lin->lu[1];
    const Complex n_L8_theta__L6_theta = lin->lu[2];
    const Complex l_guide_offset__L8_theta = lin->lu[3];
    const Complex inverse_pivot_L2_theta = lin->lu[4];
    const Complex l_L7_theta__L2_theta = lin->lu[5];
    const Complex n_L2_theta__L7_theta = lin->lu[6];
    const Complex l_L6_theta__L2_theta = lin->lu[7];
    const Complex n_L2_theta__L6_theta = lin->lu[8];
    const Complex inverse_pivot_L7_theta = lin->lu[9];
    const Complex l_L3_theta__L7_theta = lin->lu[10];
    const Complex n_L7_theta__L3_theta = lin->lu[11];
    const Complex l_L6_theta__L7_theta = lin->lu[12];
    const Complex u_L7_theta__L6_theta = lin->lu[13];
    const Complex inverse_pivot_L3_theta = lin->lu[14];
    const Complex l_L6_theta__L3_theta = lin->lu[15];
    const Complex u_L3_theta__L6_theta = lin->lu[16];
    const Complex inverse_pivot_L6_theta = lin->lu[17];
    const Complex l_guide_offset__L6_theta = lin->lu[18];
    const Complex u_L6_theta__guide_offset = lin->lu[19];
    const Complex inverse_pivot_guide_offset = lin->lu[20];

    /* forward */
    const Complex b_L8_theta = x[2];
    const Complex b_L2_theta = x[3];
    const Complex b_L7_theta = -b_L2_theta*l_L7_theta__L2_theta + x[1];
    const Complex b_L3_theta = -b_L7_theta*l_L3_theta__L7_theta + x[4];
    const Complex b_L6_theta = -b_L2_theta*l_L6_theta__L2_theta - b_L3_theta*l_L6_theta__L3_theta
        - b_L7_theta*l_L6_theta__L7_theta - b_L8_theta*l_L6_theta__L8_theta + x[0];
    const Complex b_guide_offset = -b_L6_theta*l_guide_offset__L6_theta - b_L8_theta*l_guide_offset__L8_theta + x[5];

    /* backward */
    const Complex x_guide_offset = b_guide_offset*inverse_pivot_guide_offset;
    x[5] = x_guide_offset;
    const Complex x_L6_theta = inverse_pivot_L6_theta*(b_L6_theta - u_L6_theta__guide_offset*x_guide_offset);
    x[0] = x_L6_theta;
    const Complex x_L3_theta = inverse_pivot_L3_theta*(b_L3_theta - u_L3_theta__L6_theta*x_L6_theta);
    x[4] = x_L3_theta;
    const Complex x_L7_theta = inverse_pivot_L7_theta*(b_L7_theta - n_L7_theta__L3_theta*x_L3_theta
        - u_L7_theta__L6_theta*x_L6_theta);
    x[1] = x_L7_theta;
    const Complex x_L2_theta = inverse_pivot_L2_theta*(b_L2_theta - n_L2_theta__L6_theta*x_L6_theta
        - n_L2_theta__L7_theta*x_L7_theta);
    x[3] = x_L2_theta;
    const Complex x_L8_theta = inverse_pivot_L8_theta*(b_L8_theta - n_L8_theta__L6_theta*x_L6_theta
        - phi_guide_offset_L8_theta*x_guide_offset);
    x[2] = x_L8_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta = lin->value[0];
    const double mass_L6_theta_L2_theta = lin->value[1];
    const double mass_L7_theta_L2_theta = lin->value[2];
    const double mass_L6_theta_L3_theta = lin->value[3];
    const double mass_L7_theta_L3_theta = lin->value[4];
    const double mass_L6_theta_L8_theta = lin->value[5];
    const double phi_guide_offset_L6_theta = lin->value[6];
    const double phi_guide_offset_L8_theta = lin->value[7];
    const double by_q_guide_offset_L6_theta = lin->value[8];
    const double by_q_guide_offset_L8_theta = lin->value[9];
    const double by_q_L6_theta_L6_theta = lin->value[10];
    const double by_q_L6_theta_L7_theta = lin->value[11];
    const double by_q_L6_theta_L2_theta = lin->value[12];
    const double by_q_L6_theta_L3_theta = lin->value[13];
    const double by_q_L6_theta_L8_theta = lin->value[14];
    const double by_q_L7_theta_L6_theta = lin->value[15];
    const double by_q_L7_theta_L7_theta = lin->value[16];
    const double by_q_L7_theta_L2_theta = lin->value[17];
    const double by_q_L7_theta_L3_theta = lin->value[18];
    const double by_q_L8_theta_L8_theta = lin->value[19];
    const double by_q_L8_theta_L6_theta = lin->value[20];
    const double by_q_L2_theta_L6_theta = lin->value[21];
    const double by_q_L2_theta_L7_theta = lin->value[22];
    const double by_q_L2_theta_L2_theta = lin->value[23];
    const double by_q_L3_theta_L6_theta = lin->value[24];
    const double by_q_L3_theta_L7_theta = lin->value[25];
    const double by_q_L3_theta_L3_theta = lin->value[26];
    const double by_t_L6_theta = lin->value[45];
    const double by_t_L7_theta = lin->value[46];
    const double by_t_L2_theta = lin->value[47];
    const double by_t_L3_theta = lin->value[48];
    const double power_q_0_L6_theta = lin->value[49];
    const double power_q_0_L7_theta = lin->value[50];
    const double power_q_0_L2_theta = lin->value[51];
    const double power_q_0_L3_theta = lin->value[52];
    const double power_q_2_L6_theta = lin->value[53];
    const double power_q_2_L7_theta = lin->value[54];
    const double power_q_2_L2_theta = lin->value[55];
    const double power_q_2_L3_theta = lin->value[56];
    const double power_v_0_L6_theta = lin->value[57];
    const double power_v_0_L7_theta = lin->value[58];
    const double power_v_0_L2_theta = lin->value[59];
    const double power_v_0_L3_theta = lin->value[60];
    const double power_v_2_L6_theta = lin->value[61];
    const double power_v_2_L7_theta = lin->value[62];
    const double power_v_2_L2_theta = lin->value[63];
    const double power_v_2_L3_theta = lin->value[64];
    const double power_t_0 = lin->value[65];
    const double power_t_2 = lin->value[66];

    /* eta/kappa */
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[6];
    const Complex shifted_L6_theta = -p->beta_squared*eta*r[0] + r[5];
    const Complex shifted_L8_theta = -p->beta_squared*eta*r[2] + r[7];
    x[0] = eta*(-by_q_L6_theta_L2_theta*eta*r[3] - by_q_L6_theta_L3_theta*eta*r[4] - by_q_L6_theta_L6_theta*eta*r[0]
        - by_q_L6_theta_L7_theta*eta*r[1] - by_q_L6_theta_L8_theta*eta*r[2] - by_t_L6_theta*s + p->mass_L6_L6*r[5]
        + mass_L6_theta_L2_theta*r[8] + mass_L6_theta_L3_theta*r[9] + mass_L6_theta_L7_theta*r[6]
        + mass_L6_theta_L8_theta*r[7]);
    x[1] = eta*(-by_q_L7_theta_L2_theta*eta*r[3] - by_q_L7_theta_L3_theta*eta*r[4] - by_q_L7_theta_L6_theta*eta*r[0]
        - by_q_L7_theta_L7_theta*eta*r[1] - by_t_L7_theta*s + mass_L6_theta_L7_theta*r[5] + p->mass_L7_L7*r[6]
        + mass_L7_theta_L2_theta*r[8] + mass_L7_theta_L3_theta*r[9]);
    x[2] = eta*(-by_q_L8_theta_L6_theta*eta*r[0] - by_q_L8_theta_L8_theta*eta*r[2] + mass_L6_theta_L8_theta*r[5]
        + p->mass_L8_L8*r[7]);
    x[3] = eta*(-by_q_L2_theta_L2_theta*eta*r[3] - by_q_L2_theta_L6_theta*eta*r[0] - by_q_L2_theta_L7_theta*eta*r[1]
        - by_t_L2_theta*s + p->mass_L2_L2*r[8] + mass_L6_theta_L2_theta*r[5] + mass_L7_theta_L2_theta*r[6]);
    x[4] = eta*(-by_q_L3_theta_L3_theta*eta*r[4] - by_q_L3_theta_L6_theta*eta*r[0] - by_q_L3_theta_L7_theta*eta*r[1]
        - by_t_L3_theta*s + p->mass_L3_L3*r[9] + mass_L6_theta_L3_theta*r[5] + mass_L7_theta_L3_theta*r[6]);
    x[5] = eta_row*(-by_q_guide_offset_L6_theta*eta*r[0] - by_q_guide_offset_L8_theta*eta*r[2]
        + phi_guide_offset_L6_theta*shifted_L6_theta + phi_guide_offset_L8_theta*shifted_L8_theta);
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
    u[10] = eta*(power_q_0_L2_theta*u[3] + power_q_0_L3_theta*u[4] + power_q_0_L6_theta*u[0] + power_q_0_L7_theta*u[1]
        + power_t_0*s + power_v_0_L2_theta*u[8] + power_v_0_L3_theta*u[9] + power_v_0_L6_theta*u[5]
        + power_v_0_L7_theta*u[6] + r[10]);
    u[11] = eta*r[11];
    u[12] = eta*(power_q_2_L2_theta*u[3] + power_q_2_L3_theta*u[4] + power_q_2_L6_theta*u[0] + power_q_2_L7_theta*u[1]
        + power_t_2*s + power_v_2_L2_theta*u[8] + power_v_2_L3_theta*u[9] + power_v_2_L6_theta*u[5]
        + power_v_2_L7_theta*u[6] + r[12]);
}
