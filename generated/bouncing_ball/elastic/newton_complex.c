/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex n_ball_x__ball_x = p->ball_mass + eta*(by_q_ball_x_ball_x*eta + by_v_ball_x_ball_x);
    const Complex n_ball_x__ball_y = eta*(by_q_ball_x_ball_y*eta + by_v_ball_x_ball_y);
    const Complex n_ball_x__ball_theta = by_v_ball_x_ball_theta*eta;
    const Complex n_ball_y__ball_x = eta*(by_q_ball_y_ball_x*eta + by_v_ball_y_ball_x);
    const Complex n_ball_y__ball_y = p->ball_mass + eta*(by_q_ball_y_ball_y*eta + by_v_ball_y_ball_y);
    const Complex n_ball_y__ball_theta = by_v_ball_y_ball_theta*eta;
    const Complex n_ball_theta__ball_x = eta*(by_q_ball_theta_ball_x*eta + by_v_ball_theta_ball_x);
    const Complex n_ball_theta__ball_y = eta*(by_q_ball_theta_ball_y*eta + by_v_ball_theta_ball_y);
    const Complex n_ball_theta__ball_theta = p->ball_inertia + by_v_ball_theta_ball_theta*eta;

    /* L U */
    const Complex scale_ball_x = n_ball_x__ball_x;
    if (!(complex_size(scale_ball_x) > SINGULAR * complex_size(n_ball_x__ball_x)))
        return 1;
    const Complex inverse_pivot_ball_x = 1.0/scale_ball_x;
    lin->lu[0] = inverse_pivot_ball_x;
    const Complex l_ball_y__ball_x = inverse_pivot_ball_x*n_ball_y__ball_x;
    lin->lu[1] = l_ball_y__ball_x;
    lin->lu[2] = n_ball_x__ball_y;
    const Complex l_ball_theta__ball_x = inverse_pivot_ball_x*n_ball_theta__ball_x;
    lin->lu[3] = l_ball_theta__ball_x;
    lin->lu[4] = n_ball_x__ball_theta;
    const Complex scale_ball_y = -l_ball_y__ball_x*n_ball_x__ball_y + n_ball_y__ball_y;
    if (!(complex_size(scale_ball_y) > SINGULAR * complex_size(n_ball_y__ball_y)))
        return 2;
    const Complex inverse_pivot_ball_y = 1.0/scale_ball_y;
    lin->lu[5] = inverse_pivot_ball_y;
    const Complex l_ball_theta__ball_y = inverse_pivot_ball_y*(-l_ball_theta__ball_x*n_ball_x__ball_y
        + n_ball_theta__ball_y);
    lin->lu[6] = l_ball_theta__ball_y;
    const Complex u_ball_y__ball_theta = -l_ball_y__ball_x*n_ball_x__ball_theta + n_ball_y__ball_theta;
    lin->lu[7] = u_ball_y__ball_theta;
    const Complex scale_ball_theta = -l_ball_theta__ball_x*n_ball_x__ball_theta
        - l_ball_theta__ball_y*u_ball_y__ball_theta + n_ball_theta__ball_theta;
    if (!(complex_size(scale_ball_theta) > SINGULAR * complex_size(n_ball_theta__ball_theta)))
        return 3;
    const Complex inverse_pivot_ball_theta = 1.0/scale_ball_theta;
    lin->lu[8] = inverse_pivot_ball_theta;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const Complex inverse_pivot_ball_x = lin->lu[0];
    const Complex l_ball_y__ball_x = lin->lu[1];
    const Complex n_ball_x__ball_y = lin->lu[2];
    const Complex l_ball_theta__ball_x = lin->lu[3];
    const Complex n_ball_x__ball_theta = lin->lu[4];
    const Complex inverse_pivot_ball_y = lin->lu[5];
    const Complex l_ball_theta__ball_y = lin->lu[6];
    const Complex u_ball_y__ball_theta = lin->lu[7];
    const Complex inverse_pivot_ball_theta = lin->lu[8];

    /* forward */
    const Complex b_ball_x = x[0];
    const Complex b_ball_y = -b_ball_x*l_ball_y__ball_x + x[1];
    const Complex b_ball_theta = -b_ball_x*l_ball_theta__ball_x - b_ball_y*l_ball_theta__ball_y + x[2];

    /* backward */
    const Complex x_ball_theta = b_ball_theta*inverse_pivot_ball_theta;
    x[2] = x_ball_theta;
    const Complex x_ball_y = inverse_pivot_ball_y*(b_ball_y - u_ball_y__ball_theta*x_ball_theta);
    x[1] = x_ball_y;
    const Complex x_ball_x = inverse_pivot_ball_x*(b_ball_x - n_ball_x__ball_theta*x_ball_theta
        - n_ball_x__ball_y*x_ball_y);
    x[0] = x_ball_x;
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
    Complex x[3];
    x[0] = eta*(p->ball_mass*r[3] - by_q_ball_x_ball_x*eta*r[0] - by_q_ball_x_ball_y*eta*r[1]);
    x[1] = eta*(p->ball_mass*r[4] - by_q_ball_y_ball_x*eta*r[0] - by_q_ball_y_ball_y*eta*r[1]);
    x[2] = eta*(p->ball_inertia*r[5] - by_q_ball_theta_ball_x*eta*r[0] - by_q_ball_theta_ball_y*eta*r[1]);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*r[6];
    u[7] = eta*r[7];
    u[8] = eta*(power_q_2_ball_x*u[0] + power_q_2_ball_y*u[1] + power_v_2_ball_theta*u[5] + power_v_2_ball_x*u[3]
        + power_v_2_ball_y*u[4] + r[8]);
}
