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
    const double by_q_ball_x_ball_x = lin->value[0];
    const double by_q_ball_x_ball_y = lin->value[1];
    const double by_q_ball_y_ball_x = lin->value[2];
    const double by_q_ball_y_ball_y = lin->value[3];
    const double by_q_ball_theta_ball_x = lin->value[4];
    const double by_q_ball_theta_ball_y = lin->value[5];
    const double by_v_ball_x_ball_x = lin->value[6];
    const double by_v_ball_x_ball_y = lin->value[7];
    const double by_v_ball_x_ball_theta = lin->value[8];
    const double by_v_ball_y_ball_x = lin->value[9];
    const double by_v_ball_y_ball_y = lin->value[10];
    const double by_v_ball_y_ball_theta = lin->value[11];
    const double by_v_ball_theta_ball_x = lin->value[12];
    const double by_v_ball_theta_ball_y = lin->value[13];
    const double by_v_ball_theta_ball_theta = lin->value[14];

    /* matrix */
    const double factor_1 = by_q_ball_x_ball_x*eta + by_v_ball_x_ball_x;
    const double factor_2 = by_q_ball_x_ball_x*eta_i;
    const double n_ball_x__ball_x = p->ball_mass + eta*factor_1 - eta_i*factor_2;
    const double n_ball_x__ball_x_i = eta*factor_2 + eta_i*factor_1;
    const double factor_3 = by_q_ball_x_ball_y*eta + by_v_ball_x_ball_y;
    const double factor_4 = by_q_ball_x_ball_y*eta_i;
    const double n_ball_x__ball_y = eta*factor_3 - eta_i*factor_4;
    const double n_ball_x__ball_y_i = eta*factor_4 + eta_i*factor_3;
    const double n_ball_x__ball_theta = by_v_ball_x_ball_theta*eta;
    const double n_ball_x__ball_theta_i = by_v_ball_x_ball_theta*eta_i;
    const double factor_5 = by_q_ball_y_ball_x*eta + by_v_ball_y_ball_x;
    const double factor_6 = by_q_ball_y_ball_x*eta_i;
    const double n_ball_y__ball_x = eta*factor_5 - eta_i*factor_6;
    const double n_ball_y__ball_x_i = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = by_q_ball_y_ball_y*eta + by_v_ball_y_ball_y;
    const double factor_8 = by_q_ball_y_ball_y*eta_i;
    const double n_ball_y__ball_y = p->ball_mass + eta*factor_7 - eta_i*factor_8;
    const double n_ball_y__ball_y_i = eta*factor_8 + eta_i*factor_7;
    const double n_ball_y__ball_theta = by_v_ball_y_ball_theta*eta;
    const double n_ball_y__ball_theta_i = by_v_ball_y_ball_theta*eta_i;
    const double factor_9 = by_q_ball_theta_ball_x*eta + by_v_ball_theta_ball_x;
    const double factor_10 = by_q_ball_theta_ball_x*eta_i;
    const double n_ball_theta__ball_x = eta*factor_9 - eta_i*factor_10;
    const double n_ball_theta__ball_x_i = eta*factor_10 + eta_i*factor_9;
    const double factor_11 = by_q_ball_theta_ball_y*eta + by_v_ball_theta_ball_y;
    const double factor_12 = by_q_ball_theta_ball_y*eta_i;
    const double n_ball_theta__ball_y = eta*factor_11 - eta_i*factor_12;
    const double n_ball_theta__ball_y_i = eta*factor_12 + eta_i*factor_11;
    const double n_ball_theta__ball_theta = p->ball_inertia + by_v_ball_theta_ball_theta*eta;
    const double n_ball_theta__ball_theta_i = by_v_ball_theta_ball_theta*eta_i;

    /* L U */
    const double scale_ball_x = n_ball_x__ball_x;
    const double scale_ball_x_i = n_ball_x__ball_x_i;
    const double size_1 = fabs(scale_ball_x) + fabs(scale_ball_x_i);
    const double size_2 = fabs(n_ball_x__ball_x) + fabs(n_ball_x__ball_x_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_1 = 1.0/((scale_ball_x * scale_ball_x) + (scale_ball_x_i * scale_ball_x_i));
    const double inverse_pivot_ball_x = divisor_1*scale_ball_x;
    const double inverse_pivot_ball_x_i = -divisor_1*scale_ball_x_i;
    lin->lu[0] = inverse_pivot_ball_x;
    lin->lu[1] = inverse_pivot_ball_x_i;
    const double l_ball_y__ball_x = inverse_pivot_ball_x*n_ball_y__ball_x - inverse_pivot_ball_x_i*n_ball_y__ball_x_i;
    const double l_ball_y__ball_x_i = inverse_pivot_ball_x*n_ball_y__ball_x_i + inverse_pivot_ball_x_i*n_ball_y__ball_x;
    lin->lu[2] = l_ball_y__ball_x;
    lin->lu[3] = l_ball_y__ball_x_i;
    lin->lu[4] = n_ball_x__ball_y;
    lin->lu[5] = n_ball_x__ball_y_i;
    const double l_ball_theta__ball_x = inverse_pivot_ball_x*n_ball_theta__ball_x
        - inverse_pivot_ball_x_i*n_ball_theta__ball_x_i;
    const double l_ball_theta__ball_x_i = inverse_pivot_ball_x*n_ball_theta__ball_x_i
        + inverse_pivot_ball_x_i*n_ball_theta__ball_x;
    lin->lu[6] = l_ball_theta__ball_x;
    lin->lu[7] = l_ball_theta__ball_x_i;
    lin->lu[8] = n_ball_x__ball_theta;
    lin->lu[9] = n_ball_x__ball_theta_i;
    const double scale_ball_y = -l_ball_y__ball_x*n_ball_x__ball_y + l_ball_y__ball_x_i*n_ball_x__ball_y_i
        + n_ball_y__ball_y;
    const double scale_ball_y_i = -l_ball_y__ball_x*n_ball_x__ball_y_i - l_ball_y__ball_x_i*n_ball_x__ball_y
        + n_ball_y__ball_y_i;
    const double size_3 = fabs(scale_ball_y) + fabs(scale_ball_y_i);
    const double size_4 = fabs(n_ball_y__ball_y) + fabs(n_ball_y__ball_y_i);
    if (!(size_3 > SINGULAR * size_4))
        return 2;
    const double divisor_2 = 1.0/((scale_ball_y * scale_ball_y) + (scale_ball_y_i * scale_ball_y_i));
    const double inverse_pivot_ball_y = divisor_2*scale_ball_y;
    const double inverse_pivot_ball_y_i = -divisor_2*scale_ball_y_i;
    lin->lu[10] = inverse_pivot_ball_y;
    lin->lu[11] = inverse_pivot_ball_y_i;
    const double factor_13 = -l_ball_theta__ball_x*n_ball_x__ball_y + l_ball_theta__ball_x_i*n_ball_x__ball_y_i
        + n_ball_theta__ball_y;
    const double factor_14 = -l_ball_theta__ball_x*n_ball_x__ball_y_i - l_ball_theta__ball_x_i*n_ball_x__ball_y
        + n_ball_theta__ball_y_i;
    const double l_ball_theta__ball_y = factor_13*inverse_pivot_ball_y - factor_14*inverse_pivot_ball_y_i;
    const double l_ball_theta__ball_y_i = factor_13*inverse_pivot_ball_y_i + factor_14*inverse_pivot_ball_y;
    lin->lu[12] = l_ball_theta__ball_y;
    lin->lu[13] = l_ball_theta__ball_y_i;
    const double u_ball_y__ball_theta = -l_ball_y__ball_x*n_ball_x__ball_theta
        + l_ball_y__ball_x_i*n_ball_x__ball_theta_i + n_ball_y__ball_theta;
    const double u_ball_y__ball_theta_i = -l_ball_y__ball_x*n_ball_x__ball_theta_i
        - l_ball_y__ball_x_i*n_ball_x__ball_theta + n_ball_y__ball_theta_i;
    lin->lu[14] = u_ball_y__ball_theta;
    lin->lu[15] = u_ball_y__ball_theta_i;
    const double scale_ball_theta = -l_ball_theta__ball_x*n_ball_x__ball_theta
        + l_ball_theta__ball_x_i*n_ball_x__ball_theta_i - l_ball_theta__ball_y*u_ball_y__ball_theta
        + l_ball_theta__ball_y_i*u_ball_y__ball_theta_i + n_ball_theta__ball_theta;
    const double scale_ball_theta_i = -l_ball_theta__ball_x*n_ball_x__ball_theta_i
        - l_ball_theta__ball_x_i*n_ball_x__ball_theta - l_ball_theta__ball_y*u_ball_y__ball_theta_i
        - l_ball_theta__ball_y_i*u_ball_y__ball_theta + n_ball_theta__ball_theta_i;
    const double size_5 = fabs(scale_ball_theta) + fabs(scale_ball_theta_i);
    const double size_6 = fabs(n_ball_theta__ball_theta) + fabs(n_ball_theta__ball_theta_i);
    if (!(size_5 > SINGULAR * size_6))
        return 3;
    const double divisor_3 = 1.0/((scale_ball_theta * scale_ball_theta) + (scale_ball_theta_i * scale_ball_theta_i));
    const double inverse_pivot_ball_theta = divisor_3*scale_ball_theta;
    const double inverse_pivot_ball_theta_i = -divisor_3*scale_ball_theta_i;
    lin->lu[16] = inverse_pivot_ball_theta;
    lin->lu[17] = inverse_pivot_ball_theta_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_ball_x = lin->lu[0];
    const double inverse_pivot_ball_x_i = lin->lu[1];
    const double l_ball_y__ball_x = lin->lu[2];
    const double l_ball_y__ball_x_i = lin->lu[3];
    const double n_ball_x__ball_y = lin->lu[4];
    const double n_ball_x__ball_y_i = lin->lu[5];
    const double l_ball_theta__ball_x = lin->lu[6];
    const double l_ball_theta__ball_x_i = lin->lu[7];
    const double n_ball_x__ball_theta = lin->lu[8];
    const double n_ball_x__ball_theta_i = lin->lu[9];
    const double inverse_pivot_ball_y = lin->lu[10];
    const double inverse_pivot_ball_y_i = lin->lu[11];
    const double l_ball_theta__ball_y = lin->lu[12];
    const double l_ball_theta__ball_y_i = lin->lu[13];
    const double u_ball_y__ball_theta = lin->lu[14];
    const double u_ball_y__ball_theta_i = lin->lu[15];
    const double inverse_pivot_ball_theta = lin->lu[16];
    const double inverse_pivot_ball_theta_i = lin->lu[17];

    /* forward */
    const double b_ball_x = x[0];
    const double b_ball_x_i = x[1];
    const double b_ball_y = -b_ball_x*l_ball_y__ball_x + b_ball_x_i*l_ball_y__ball_x_i + x[2];
    const double b_ball_y_i = -b_ball_x*l_ball_y__ball_x_i - b_ball_x_i*l_ball_y__ball_x + x[3];
    const double b_ball_theta = -b_ball_x*l_ball_theta__ball_x + b_ball_x_i*l_ball_theta__ball_x_i
        - b_ball_y*l_ball_theta__ball_y + b_ball_y_i*l_ball_theta__ball_y_i + x[4];
    const double b_ball_theta_i = -b_ball_x*l_ball_theta__ball_x_i - b_ball_x_i*l_ball_theta__ball_x
        - b_ball_y*l_ball_theta__ball_y_i - b_ball_y_i*l_ball_theta__ball_y + x[5];

    /* backward */
    const double x_ball_theta = b_ball_theta*inverse_pivot_ball_theta - b_ball_theta_i*inverse_pivot_ball_theta_i;
    const double x_ball_theta_i = b_ball_theta*inverse_pivot_ball_theta_i + b_ball_theta_i*inverse_pivot_ball_theta;
    x[4] = x_ball_theta;
    x[5] = x_ball_theta_i;
    const double factor_1 = b_ball_y - u_ball_y__ball_theta*x_ball_theta + u_ball_y__ball_theta_i*x_ball_theta_i;
    const double factor_2 = b_ball_y_i - u_ball_y__ball_theta*x_ball_theta_i - u_ball_y__ball_theta_i*x_ball_theta;
    const double x_ball_y = factor_1*inverse_pivot_ball_y - factor_2*inverse_pivot_ball_y_i;
    const double x_ball_y_i = factor_1*inverse_pivot_ball_y_i + factor_2*inverse_pivot_ball_y;
    x[2] = x_ball_y;
    x[3] = x_ball_y_i;
    const double factor_3 = b_ball_x - n_ball_x__ball_theta*x_ball_theta + n_ball_x__ball_theta_i*x_ball_theta_i
        - n_ball_x__ball_y*x_ball_y + n_ball_x__ball_y_i*x_ball_y_i;
    const double factor_4 = b_ball_x_i - n_ball_x__ball_theta*x_ball_theta_i - n_ball_x__ball_theta_i*x_ball_theta
        - n_ball_x__ball_y*x_ball_y_i - n_ball_x__ball_y_i*x_ball_y;
    const double x_ball_x = factor_3*inverse_pivot_ball_x - factor_4*inverse_pivot_ball_x_i;
    const double x_ball_x_i = factor_3*inverse_pivot_ball_x_i + factor_4*inverse_pivot_ball_x;
    x[0] = x_ball_x;
    x[1] = x_ball_x_i;
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
    const double by_q_ball_x_ball_x = lin->value[0];
    const double by_q_ball_x_ball_y = lin->value[1];
    const double by_q_ball_y_ball_x = lin->value[2];
    const double by_q_ball_y_ball_y = lin->value[3];
    const double by_q_ball_theta_ball_x = lin->value[4];
    const double by_q_ball_theta_ball_y = lin->value[5];
    const double power_q_2_ball_x = lin->value[15];
    const double power_q_2_ball_y = lin->value[16];
    const double power_v_2_ball_theta = lin->value[17];
    const double power_v_2_ball_x = lin->value[18];
    const double power_v_2_ball_y = lin->value[19];

    /* right-hand side */
    double x[6];
    const double factor_1 = p->ball_mass*r[6] - by_q_ball_x_ball_x*(eta*r[0] - eta_i*r[1])
        - by_q_ball_x_ball_y*(eta*r[2] - eta_i*r[3]);
    const double factor_2 = p->ball_mass*r[7] - by_q_ball_x_ball_x*(eta*r[1] + eta_i*r[0])
        - by_q_ball_x_ball_y*(eta*r[3] + eta_i*r[2]);
    x[0] = eta*factor_1 - eta_i*factor_2;
    x[1] = eta*factor_2 + eta_i*factor_1;
    const double factor_3 = p->ball_mass*r[8] - by_q_ball_y_ball_x*(eta*r[0] - eta_i*r[1])
        - by_q_ball_y_ball_y*(eta*r[2] - eta_i*r[3]);
    const double factor_4 = p->ball_mass*r[9] - by_q_ball_y_ball_x*(eta*r[1] + eta_i*r[0])
        - by_q_ball_y_ball_y*(eta*r[3] + eta_i*r[2]);
    x[2] = eta*factor_3 - eta_i*factor_4;
    x[3] = eta*factor_4 + eta_i*factor_3;
    const double factor_5 = p->ball_inertia*r[10] - by_q_ball_theta_ball_x*(eta*r[0] - eta_i*r[1])
        - by_q_ball_theta_ball_y*(eta*r[2] - eta_i*r[3]);
    const double factor_6 = p->ball_inertia*r[11] - by_q_ball_theta_ball_x*(eta*r[1] + eta_i*r[0])
        - by_q_ball_theta_ball_y*(eta*r[3] + eta_i*r[2]);
    x[4] = eta*factor_5 - eta_i*factor_6;
    x[5] = eta*factor_6 + eta_i*factor_5;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_7 = r[0] + x[0];
    const double factor_8 = r[1] + x[1];
    u[0] = eta*factor_7 - eta_i*factor_8;
    u[1] = eta*factor_8 + eta_i*factor_7;
    u[6] = x[0];
    u[7] = x[1];
    const double factor_9 = r[2] + x[2];
    const double factor_10 = r[3] + x[3];
    u[2] = eta*factor_9 - eta_i*factor_10;
    u[3] = eta*factor_10 + eta_i*factor_9;
    u[8] = x[2];
    u[9] = x[3];
    const double factor_11 = r[4] + x[4];
    const double factor_12 = r[5] + x[5];
    u[4] = eta*factor_11 - eta_i*factor_12;
    u[5] = eta*factor_12 + eta_i*factor_11;
    u[10] = x[4];
    u[11] = x[5];
    u[12] = eta*r[12] - eta_i*r[13];
    u[13] = eta*r[13] + eta_i*r[12];
    u[14] = eta*r[14] - eta_i*r[15];
    u[15] = eta*r[15] + eta_i*r[14];
    const double factor_13 = power_q_2_ball_x*u[0] + power_q_2_ball_y*u[2] + power_v_2_ball_theta*u[10]
        + power_v_2_ball_x*u[6] + power_v_2_ball_y*u[8] + r[16];
    const double factor_14 = power_q_2_ball_x*u[1] + power_q_2_ball_y*u[3] + power_v_2_ball_theta*u[11]
        + power_v_2_ball_x*u[7] + power_v_2_ball_y*u[9] + r[17];
    u[16] = eta*factor_13 - eta_i*factor_14;
    u[17] = eta*factor_14 + eta_i*factor_13;
}
