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
    const double mass_crank_theta_rod_theta = lin->value[0];
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double phi_slider_offset_rod_theta = lin->value[2];
    const double by_q_slider_offset_crank_theta = lin->value[3];
    const double by_q_slider_offset_rod_theta = lin->value[4];
    const double by_q_crank_theta_crank_theta = lin->value[5];
    const double by_q_crank_theta_rod_theta = lin->value[6];
    const double by_q_rod_theta_crank_theta = lin->value[7];
    const double by_q_rod_theta_rod_theta = lin->value[8];
    const double by_v_slider_offset_crank_theta = lin->value[9];
    const double by_v_slider_offset_rod_theta = lin->value[10];
    const double by_v_crank_theta_crank_theta = lin->value[11];
    const double by_v_crank_theta_rod_theta = lin->value[12];
    const double by_v_rod_theta_crank_theta = lin->value[13];
    const double by_v_rod_theta_rod_theta = lin->value[14];

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
    const double factor_5 = by_q_crank_theta_crank_theta*eta + by_v_crank_theta_crank_theta;
    const double factor_6 = by_q_crank_theta_crank_theta*eta_i;
    const double n_crank_theta__crank_theta = eta*factor_5 - eta_i*factor_6 + p->mass_crank_crank;
    const double n_crank_theta__crank_theta_i = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta;
    const double factor_8 = by_q_crank_theta_rod_theta*eta_i;
    const double n_crank_theta__rod_theta = eta*factor_7 - eta_i*factor_8 + mass_crank_theta_rod_theta;
    const double n_crank_theta__rod_theta_i = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta;
    const double factor_10 = by_q_rod_theta_crank_theta*eta_i;
    const double n_rod_theta__crank_theta = eta*factor_9 - eta_i*factor_10 + mass_crank_theta_rod_theta;
    const double n_rod_theta__crank_theta_i = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta;
    const double factor_12 = by_q_rod_theta_rod_theta*eta_i;
    const double n_rod_theta__rod_theta = eta*factor_11 - eta_i*factor_12 + p->mass_rod_rod;
    const double n_rod_theta__rod_theta_i = eta*factor_12 + eta_i*factor_11;
    const double factor_13 = by_q_slider_offset_crank_theta*eta + by_v_slider_offset_crank_theta;
    const double factor_14 = by_q_slider_offset_crank_theta*eta_i;
    const double n_slider_offset__crank_theta = eta_row*factor_13 - eta_row_i*factor_14 + phi_slider_offset_crank_theta;
    const double n_slider_offset__crank_theta_i = eta_row*factor_14 + eta_row_i*factor_13;
    const double factor_15 = by_q_slider_offset_rod_theta*eta + by_v_slider_offset_rod_theta;
    const double factor_16 = by_q_slider_offset_rod_theta*eta_i;
    const double n_slider_offset__rod_theta = eta_row*factor_15 - eta_row_i*factor_16 + phi_slider_offset_rod_theta;
    const double n_slider_offset__rod_theta_i = eta_row*factor_16 + eta_row_i*factor_15;

    /* L U */
    const double scale_crank_theta = n_crank_theta__crank_theta;
    const double scale_crank_theta_i = n_crank_theta__crank_theta_i;
    const double size_1 = fabs(scale_crank_theta) + fabs(scale_crank_theta_i);
    const double size_2 = fabs(n_crank_theta__crank_theta) + fabs(n_crank_theta__crank_theta_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_4 = 1.0/((scale_crank_theta * scale_crank_theta)
        + (scale_crank_theta_i * scale_crank_theta_i));
    const double inverse_pivot_crank_theta = divisor_4*scale_crank_theta;
    const double inverse_pivot_crank_theta_i = -divisor_4*scale_crank_theta_i;
    lin->lu[0] = inverse_pivot_crank_theta;
    lin->lu[1] = inverse_pivot_crank_theta_i;
    const double l_rod_theta__crank_theta = inverse_pivot_crank_theta*n_rod_theta__crank_theta
        - inverse_pivot_crank_theta_i*n_rod_theta__crank_theta_i;
    const double l_rod_theta__crank_theta_3_i = inverse_pivot_crank_theta*n_rod_theta__crank_theta_i
        + inverse_pivot_crank_theta_i*n_rod_theta__crank_theta;
    lin->lu[2] = l_rod_theta__crank_theta;
    lin->lu[3] = l_rod_theta__crank_theta_3_i;
    lin->lu[4] = n_crank_theta__rod_theta;
    lin->lu[5] = n_crank_theta__rod_theta_i;
    const double l_slider_offset__crank_theta = inverse_pivot_crank_theta*n_slider_offset__crank_theta
        - inverse_pivot_crank_theta_i*n_slider_offset__crank_theta_i;
    const double l_slider_offset__crank_theta_3_i = inverse_pivot_crank_theta*n_slider_offset__crank_theta_i
        + inverse_pivot_crank_theta_i*n_slider_offset__crank_theta;
    lin->lu[6] = l_slider_offset__crank_theta;
    lin->lu[7] = l_slider_offset__crank_theta_3_i;
    const double scale_rod_theta = -l_rod_theta__crank_theta*n_crank_theta__rod_theta
        + l_rod_theta__crank_theta_3_i*n_crank_theta__rod_theta_i + n_rod_theta__rod_theta;
    const double scale_rod_theta_i = -l_rod_theta__crank_theta*n_crank_theta__rod_theta_i
        - l_rod_theta__crank_theta_3_i*n_crank_theta__rod_theta + n_rod_theta__rod_theta_i;
    const double size_3 = fabs(scale_rod_theta) + fabs(scale_rod_theta_i);
    const double size_4 = fabs(n_rod_theta__rod_theta) + fabs(n_rod_theta__rod_theta_i);
    if (!(size_3 > SINGULAR * size_4))
        return 2;
    const double divisor_5 = 1.0/((scale_rod_theta * scale_rod_theta) + (scale_rod_theta_i * scale_rod_theta_i));
    const double inverse_pivot_rod_theta = divisor_5*scale_rod_theta;
    const double inverse_pivot_rod_theta_3_i = -divisor_5*scale_rod_theta_i;
    lin->lu[8] = inverse_pivot_rod_theta;
    lin->lu[9] = inverse_pivot_rod_theta_3_i;
    const double factor_17 = -l_slider_offset__crank_theta*n_crank_theta__rod_theta
        + l_slider_offset__crank_theta_3_i*n_crank_theta__rod_theta_i + n_slider_offset__rod_theta;
    const double factor_18 = -l_slider_offset__crank_theta*n_crank_theta__rod_theta_i
        - l_slider_offset__crank_theta_3_i*n_crank_theta__rod_theta + n_slider_offset__rod_theta_i;
    const double l_slider_offset__rod_theta = factor_17*inverse_pivot_rod_theta - factor_18*inverse_pivot_rod_theta_3_i;
    const double l_slider_offset__rod_theta_3_i = factor_17*inverse_pivot_rod_theta_3_i
        + factor_18*inverse_pivot_rod_theta;
    lin->lu[10] = l_slider_offset__rod_theta;
    lin->lu[11] = l_slider_offset__rod_theta_3_i;
    const double u_rod_theta__slider_offset = -l_rod_theta__crank_theta*phi_slider_offset_crank_theta
        + phi_slider_offset_rod_theta;
    const double u_rod_theta__slider_offset_i = -l_rod_theta__crank_theta_3_i*phi_slider_offset_crank_theta;
    lin->lu[12] = u_rod_theta__slider_offset;
    lin->lu[13] = u_rod_theta__slider_offset_i;
    const double scale_slider_offset = -l_slider_offset__crank_theta*phi_slider_offset_crank_theta
        - l_slider_offset__rod_theta*u_rod_theta__slider_offset
        + l_slider_offset__rod_theta_3_i*u_rod_theta__slider_offset_i;
    const double scale_slider_offset_3_i = -l_slider_offset__crank_theta_3_i*phi_slider_offset_crank_theta
        - l_slider_offset__rod_theta*u_rod_theta__slider_offset_i
        - l_slider_offset__rod_theta_3_i*u_rod_theta__slider_offset;
    const double size_5 = fabs(scale_slider_offset) + fabs(scale_slider_offset_3_i);
    if (!(size_5 > 0.0 && size_5 < INFINITY))
        return 3;
    const double divisor_6 = 1.0/((scale_slider_offset * scale_slider_offset)
        + (scale_slider_offset_3_i * scale_slider_offset_3_i));
    const double inverse_pivot_slider_offset = divisor_6*scale_slider_offset;
    const double inverse_pivot_slider_offset_3_i = -divisor_6*scale_slider_offset_3_i;
    lin->lu[14] = inverse_pivot_slider_offset;
    lin->lu[15] = inverse_pivot_slider_offset_3_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double inverse_pivot_crank_theta = lin->lu[0];
    const double inverse_pivot_crank_theta_i = lin->lu[1];
    const double l_rod_theta__crank_theta = lin->lu[2];
    const double l_rod_theta__crank_theta_3_i = lin->lu[3];
    const double n_crank_theta__rod_theta = lin->lu[4];
    const double n_crank_theta__rod_theta_i = lin->lu[5];
    const double l_slider_offset__crank_theta = lin->lu[6];
    const double l_slider_offset__crank_theta_3_i = lin->lu[7];
    const double inverse_pivot_rod_theta = lin->lu[8];
    const double inverse_pivot_rod_theta_3_i = lin->lu[9];
    const double l_slider_offset__rod_theta = lin->lu[10];
    const double l_slider_offset__rod_theta_3_i = lin->lu[11];
    const double u_rod_theta__slider_offset = lin->lu[12];
    const double u_rod_theta__slider_offset_i = lin->lu[13];
    const double inverse_pivot_slider_offset = lin->lu[14];
    const double inverse_pivot_slider_offset_3_i = lin->lu[15];

    /* forward */
    const double b_crank_theta = x[0];
    const double b_crank_theta_i = x[1];
    const double b_rod_theta = -b_crank_theta*l_rod_theta__crank_theta + b_crank_theta_i*l_rod_theta__crank_theta_3_i
        + x[2];
    const double b_rod_theta_i = -b_crank_theta*l_rod_theta__crank_theta_3_i - b_crank_theta_i*l_rod_theta__crank_theta
        + x[3];
    const double b_slider_offset = -b_crank_theta*l_slider_offset__crank_theta
        + b_crank_theta_i*l_slider_offset__crank_theta_3_i - b_rod_theta*l_slider_offset__rod_theta
        + b_rod_theta_i*l_slider_offset__rod_theta_3_i + x[4];
    const double b_slider_offset_i = -b_crank_theta*l_slider_offset__crank_theta_3_i
        - b_crank_theta_i*l_slider_offset__crank_theta - b_rod_theta*l_slider_offset__rod_theta_3_i
        - b_rod_theta_i*l_slider_offset__rod_theta + x[5];

    /* backward */
    const double x_slider_offset = b_slider_offset*inverse_pivot_slider_offset
        - b_slider_offset_i*inverse_pivot_slider_offset_3_i;
    const double x_slider_offset_i = b_slider_offset*inverse_pivot_slider_offset_3_i
        + b_slider_offset_i*inverse_pivot_slider_offset;
    x[4] = x_slider_offset;
    x[5] = x_slider_offset_i;
    const double factor_1 = b_rod_theta - u_rod_theta__slider_offset*x_slider_offset
        + u_rod_theta__slider_offset_i*x_slider_offset_i;
    const double factor_2 = b_rod_theta_i - u_rod_theta__slider_offset*x_slider_offset_i
        - u_rod_theta__slider_offset_i*x_slider_offset;
    const double x_rod_theta = factor_1*inverse_pivot_rod_theta - factor_2*inverse_pivot_rod_theta_3_i;
    const double x_rod_theta_i = factor_1*inverse_pivot_rod_theta_3_i + factor_2*inverse_pivot_rod_theta;
    x[2] = x_rod_theta;
    x[3] = x_rod_theta_i;
    const double factor_3 = b_crank_theta - n_crank_theta__rod_theta*x_rod_theta
        + n_crank_theta__rod_theta_i*x_rod_theta_i - phi_slider_offset_crank_theta*x_slider_offset;
    const double factor_4 = b_crank_theta_i - n_crank_theta__rod_theta*x_rod_theta_i
        - n_crank_theta__rod_theta_i*x_rod_theta - phi_slider_offset_crank_theta*x_slider_offset_i;
    const double x_crank_theta = factor_3*inverse_pivot_crank_theta - factor_4*inverse_pivot_crank_theta_i;
    const double x_crank_theta_i = factor_3*inverse_pivot_crank_theta_i + factor_4*inverse_pivot_crank_theta;
    x[0] = x_crank_theta;
    x[1] = x_crank_theta_i;
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
    const double mass_crank_theta_rod_theta = lin->value[0];
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double phi_slider_offset_rod_theta = lin->value[2];
    const double by_q_slider_offset_crank_theta = lin->value[3];
    const double by_q_slider_offset_rod_theta = lin->value[4];
    const double by_q_crank_theta_crank_theta = lin->value[5];
    const double by_q_crank_theta_rod_theta = lin->value[6];
    const double by_q_rod_theta_crank_theta = lin->value[7];
    const double by_q_rod_theta_rod_theta = lin->value[8];
    const double power_q_1_crank_theta = lin->value[15];
    const double power_q_1_rod_theta = lin->value[16];
    const double power_v_1_crank_theta = lin->value[17];
    const double power_v_1_rod_theta = lin->value[18];

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
    double x[6];
    const double shifted_crank_theta = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[4];
    const double shifted_crank_theta_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[5];
    const double shifted_rod_theta = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[6];
    const double shifted_rod_theta_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[7];
    const double factor_5 = -by_q_crank_theta_crank_theta*(eta*r[0] - eta_i*r[1])
        - by_q_crank_theta_rod_theta*(eta*r[2] - eta_i*r[3]) + p->mass_crank_crank*r[4]
        + mass_crank_theta_rod_theta*r[6];
    const double factor_6 = -by_q_crank_theta_crank_theta*(eta*r[1] + eta_i*r[0])
        - by_q_crank_theta_rod_theta*(eta*r[3] + eta_i*r[2]) + p->mass_crank_crank*r[5]
        + mass_crank_theta_rod_theta*r[7];
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = -by_q_rod_theta_crank_theta*(eta*r[0] - eta_i*r[1])
        - by_q_rod_theta_rod_theta*(eta*r[2] - eta_i*r[3]) + mass_crank_theta_rod_theta*r[4] + p->mass_rod_rod*r[6];
    const double factor_8 = -by_q_rod_theta_crank_theta*(eta*r[1] + eta_i*r[0])
        - by_q_rod_theta_rod_theta*(eta*r[3] + eta_i*r[2]) + mass_crank_theta_rod_theta*r[5] + p->mass_rod_rod*r[7];
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const double factor_9 = -by_q_slider_offset_crank_theta*(eta*r[0] - eta_i*r[1])
        - by_q_slider_offset_rod_theta*(eta*r[2] - eta_i*r[3]) + phi_slider_offset_crank_theta*shifted_crank_theta
        + phi_slider_offset_rod_theta*shifted_rod_theta;
    const double factor_10 = -by_q_slider_offset_crank_theta*(eta*r[1] + eta_i*r[0])
        - by_q_slider_offset_rod_theta*(eta*r[3] + eta_i*r[2]) + phi_slider_offset_crank_theta*shifted_crank_theta_i
        + phi_slider_offset_rod_theta*shifted_rod_theta_i;
    x[4] = eta_row*factor_9 - eta_row_i*factor_10;
    x[5] = eta_row*factor_10 + eta_row_i*factor_9;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_11 = r[0] + x[0];
    const double factor_12 = r[1] + x[1];
    u[0] = eta*factor_11 - eta_i*factor_12;
    u[1] = eta*factor_12 + eta_i*factor_11;
    u[4] = x[0];
    u[5] = x[1];
    const double factor_13 = r[2] + x[2];
    const double factor_14 = r[3] + x[3];
    u[2] = eta*factor_13 - eta_i*factor_14;
    u[3] = eta*factor_14 + eta_i*factor_13;
    u[6] = x[2];
    u[7] = x[3];
    u[8] = eta*r[8] - eta_i*r[9];
    u[9] = eta*r[9] + eta_i*r[8];
    const double factor_15 = power_q_1_crank_theta*u[0] + power_q_1_rod_theta*u[2] + power_v_1_crank_theta*u[4]
        + power_v_1_rod_theta*u[6] + r[10];
    const double factor_16 = power_q_1_crank_theta*u[1] + power_q_1_rod_theta*u[3] + power_v_1_crank_theta*u[5]
        + power_v_1_rod_theta*u[7] + r[11];
    u[10] = eta*factor_15 - eta_i*factor_16;
    u[11] = eta*factor_16 + eta_i*factor_15;
    u[12] = eta*r[12] - eta_i*r[13];
    u[13] = eta*r[13] + eta_i*r[12];
}
