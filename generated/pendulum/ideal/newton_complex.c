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
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const double by_q_rod_length_bob_x = lin->value[2];
    const double by_q_rod_length_bob_y = lin->value[3];
    const double by_q_bob_x_bob_x = lin->value[4];
    const double by_v_rod_length_bob_x = lin->value[5];
    const double by_v_rod_length_bob_y = lin->value[6];

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
    const double n_bob_x__bob_x = p->bob_mass + by_q_bob_x_bob_x*((eta * eta) - (eta_i * eta_i));
    const double n_bob_x__bob_x_i = 2.0*by_q_bob_x_bob_x*eta*eta_i;
    const double n_bob_y__bob_y = p->bob_mass + by_q_bob_x_bob_x*((eta * eta) - (eta_i * eta_i));
    const double n_bob_y__bob_y_i = 2.0*by_q_bob_x_bob_x*eta*eta_i;
    const double factor_5 = by_q_rod_length_bob_x*eta + by_v_rod_length_bob_x;
    const double factor_6 = by_q_rod_length_bob_x*eta_i;
    const double n_rod_length__bob_x = eta_row*factor_5 - eta_row_i*factor_6 + phi_rod_length_bob_x;
    const double n_rod_length__bob_x_i = eta_row*factor_6 + eta_row_i*factor_5;
    const double factor_7 = by_q_rod_length_bob_y*eta + by_v_rod_length_bob_y;
    const double factor_8 = by_q_rod_length_bob_y*eta_i;
    const double n_rod_length__bob_y = eta_row*factor_7 - eta_row_i*factor_8 + phi_rod_length_bob_y;
    const double n_rod_length__bob_y_i = eta_row*factor_8 + eta_row_i*factor_7;

    /* L U */
    const double scale_bob_x = n_bob_x__bob_x;
    const double scale_bob_x_i = n_bob_x__bob_x_i;
    const double size_1 = fabs(scale_bob_x) + fabs(scale_bob_x_i);
    const double size_2 = fabs(n_bob_x__bob_x) + fabs(n_bob_x__bob_x_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_4 = 1.0/((scale_bob_x * scale_bob_x) + (scale_bob_x_i * scale_bob_x_i));
    const double inverse_pivot_bob_x = divisor_4*scale_bob_x;
    const double inverse_pivot_bob_x_i = -divisor_4*scale_bob_x_i;
    lin->lu[0] = inverse_pivot_bob_x;
    lin->lu[1] = inverse_pivot_bob_x_i;
    const double l_rod_length__bob_x = inverse_pivot_bob_x*n_rod_length__bob_x
        - inverse_pivot_bob_x_i*n_rod_length__bob_x_i;
    const double l_rod_length__bob_x_3_i = inverse_pivot_bob_x*n_rod_length__bob_x_i
        + inverse_pivot_bob_x_i*n_rod_length__bob_x;
    lin->lu[2] = l_rod_length__bob_x;
    lin->lu[3] = l_rod_length__bob_x_3_i;
    const double scale_bob_y = n_bob_y__bob_y;
    const double scale_bob_y_i = n_bob_y__bob_y_i;
    const double size_3 = fabs(scale_bob_y) + fabs(scale_bob_y_i);
    const double size_4 = fabs(n_bob_y__bob_y) + fabs(n_bob_y__bob_y_i);
    if (!(size_3 > SINGULAR * size_4))
        return 2;
    const double divisor_5 = 1.0/((scale_bob_y * scale_bob_y) + (scale_bob_y_i * scale_bob_y_i));
    const double inverse_pivot_bob_y = divisor_5*scale_bob_y;
    const double inverse_pivot_bob_y_i = -divisor_5*scale_bob_y_i;
    lin->lu[4] = inverse_pivot_bob_y;
    lin->lu[5] = inverse_pivot_bob_y_i;
    const double l_rod_length__bob_y = inverse_pivot_bob_y*n_rod_length__bob_y
        - inverse_pivot_bob_y_i*n_rod_length__bob_y_i;
    const double l_rod_length__bob_y_3_i = inverse_pivot_bob_y*n_rod_length__bob_y_i
        + inverse_pivot_bob_y_i*n_rod_length__bob_y;
    lin->lu[6] = l_rod_length__bob_y;
    lin->lu[7] = l_rod_length__bob_y_3_i;
    const double scale_rod_length = -l_rod_length__bob_x*phi_rod_length_bob_x
        - l_rod_length__bob_y*phi_rod_length_bob_y;
    const double scale_rod_length_3_i = -l_rod_length__bob_x_3_i*phi_rod_length_bob_x
        - l_rod_length__bob_y_3_i*phi_rod_length_bob_y;
    const double size_5 = fabs(scale_rod_length) + fabs(scale_rod_length_3_i);
    if (!(size_5 > 0.0 && size_5 < INFINITY))
        return 4;
    const double divisor_6 = 1.0/((scale_rod_length * scale_rod_length)
        + (scale_rod_length_3_i * scale_rod_length_3_i));
    const double inverse_pivot_rod_length = divisor_6*scale_rod_length;
    const double inverse_pivot_rod_length_3_i = -divisor_6*scale_rod_length_3_i;
    lin->lu[8] = inverse_pivot_rod_length;
    lin->lu[9] = inverse_pivot_rod_length_3_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const double inverse_pivot_bob_x = lin->lu[0];
    const double inverse_pivot_bob_x_i = lin->lu[1];
    const double l_rod_length__bob_x = lin->lu[2];
    const double l_rod_length__bob_x_3_i = lin->lu[3];
    const double inverse_pivot_bob_y = lin->lu[4];
    const double inverse_pivot_bob_y_i = lin->lu[5];
    const double l_rod_length__bob_y = lin->lu[6];
    const double l_rod_length__bob_y_3_i = lin->lu[7];
    const double inverse_pivot_rod_length = lin->lu[8];
    const double inverse_pivot_rod_length_3_i = lin->lu[9];

    /* forward */
    const double b_bob_theta = x[4];
    const double b_bob_theta_i = x[5];
    const double b_bob_x = x[0];
    const double b_bob_x_i = x[1];
    const double b_bob_y = x[2];
    const double b_bob_y_i = x[3];
    const double b_rod_length = -b_bob_x*l_rod_length__bob_x + b_bob_x_i*l_rod_length__bob_x_3_i
        - b_bob_y*l_rod_length__bob_y + b_bob_y_i*l_rod_length__bob_y_3_i + x[6];
    const double b_rod_length_i = -b_bob_x*l_rod_length__bob_x_3_i - b_bob_x_i*l_rod_length__bob_x
        - b_bob_y*l_rod_length__bob_y_3_i - b_bob_y_i*l_rod_length__bob_y + x[7];

    /* backward */
    const double x_rod_length = b_rod_length*inverse_pivot_rod_length - b_rod_length_i*inverse_pivot_rod_length_3_i;
    const double x_rod_length_i = b_rod_length*inverse_pivot_rod_length_3_i + b_rod_length_i*inverse_pivot_rod_length;
    x[6] = x_rod_length;
    x[7] = x_rod_length_i;
    const double factor_1 = b_bob_y - phi_rod_length_bob_y*x_rod_length;
    const double factor_2 = b_bob_y_i - phi_rod_length_bob_y*x_rod_length_i;
    const double x_bob_y = factor_1*inverse_pivot_bob_y - factor_2*inverse_pivot_bob_y_i;
    const double x_bob_y_i = factor_1*inverse_pivot_bob_y_i + factor_2*inverse_pivot_bob_y;
    x[2] = x_bob_y;
    x[3] = x_bob_y_i;
    const double factor_3 = b_bob_x - phi_rod_length_bob_x*x_rod_length;
    const double factor_4 = b_bob_x_i - phi_rod_length_bob_x*x_rod_length_i;
    const double x_bob_x = factor_3*inverse_pivot_bob_x - factor_4*inverse_pivot_bob_x_i;
    const double x_bob_x_i = factor_3*inverse_pivot_bob_x_i + factor_4*inverse_pivot_bob_x;
    x[0] = x_bob_x;
    x[1] = x_bob_x_i;
    const double x_bob_theta = b_bob_theta*p->inverse_bob_inertia;
    const double x_bob_theta_i = b_bob_theta_i*p->inverse_bob_inertia;
    x[4] = x_bob_theta;
    x[5] = x_bob_theta_i;
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
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const double by_q_rod_length_bob_x = lin->value[2];
    const double by_q_rod_length_bob_y = lin->value[3];
    const double by_q_bob_x_bob_x = lin->value[4];

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
    const double shifted_bob_x = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[6];
    const double shifted_bob_x_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[7];
    const double shifted_bob_y = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[8];
    const double shifted_bob_y_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[9];
    const double factor_5 = p->bob_mass*r[6] - by_q_bob_x_bob_x*(eta*r[0] - eta_i*r[1]);
    const double factor_6 = p->bob_mass*r[7] - by_q_bob_x_bob_x*(eta*r[1] + eta_i*r[0]);
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = p->bob_mass*r[8] - by_q_bob_x_bob_x*(eta*r[2] - eta_i*r[3]);
    const double factor_8 = p->bob_mass*r[9] - by_q_bob_x_bob_x*(eta*r[3] + eta_i*r[2]);
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    x[4] = p->bob_inertia*(eta*r[10] - eta_i*r[11]);
    x[5] = p->bob_inertia*(eta*r[11] + eta_i*r[10]);
    const double factor_9 = -by_q_rod_length_bob_x*(eta*r[0] - eta_i*r[1])
        - by_q_rod_length_bob_y*(eta*r[2] - eta_i*r[3]) + phi_rod_length_bob_x*shifted_bob_x
        + phi_rod_length_bob_y*shifted_bob_y;
    const double factor_10 = -by_q_rod_length_bob_x*(eta*r[1] + eta_i*r[0])
        - by_q_rod_length_bob_y*(eta*r[3] + eta_i*r[2]) + phi_rod_length_bob_x*shifted_bob_x_i
        + phi_rod_length_bob_y*shifted_bob_y_i;
    x[6] = eta_row*factor_9 - eta_row_i*factor_10;
    x[7] = eta_row*factor_10 + eta_row_i*factor_9;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_11 = r[0] + x[0];
    const double factor_12 = r[1] + x[1];
    u[0] = eta*factor_11 - eta_i*factor_12;
    u[1] = eta*factor_12 + eta_i*factor_11;
    u[6] = x[0];
    u[7] = x[1];
    const double factor_13 = r[2] + x[2];
    const double factor_14 = r[3] + x[3];
    u[2] = eta*factor_13 - eta_i*factor_14;
    u[3] = eta*factor_14 + eta_i*factor_13;
    u[8] = x[2];
    u[9] = x[3];
    const double factor_15 = r[4] + x[4];
    const double factor_16 = r[5] + x[5];
    u[4] = eta*factor_15 - eta_i*factor_16;
    u[5] = eta*factor_16 + eta_i*factor_15;
    u[10] = x[4];
    u[11] = x[5];
    u[12] = eta*r[12] - eta_i*r[13];
    u[13] = eta*r[13] + eta_i*r[12];
    u[14] = eta*r[14] - eta_i*r[15];
    u[15] = eta*r[15] + eta_i*r[14];
    u[16] = eta*r[16] - eta_i*r[17];
    u[17] = eta*r[17] + eta_i*r[16];
}
