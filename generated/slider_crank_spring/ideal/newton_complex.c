/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_crank_theta__crank_theta = eta*(by_q_crank_theta_crank_theta*eta + by_v_crank_theta_crank_theta)
        + p->mass_crank_crank;
    const Complex n_crank_theta__rod_theta = eta*(by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta)
        + mass_crank_theta_rod_theta;
    const Complex n_rod_theta__crank_theta = eta*(by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta)
        + mass_crank_theta_rod_theta;
    const Complex n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta)
        + p->mass_rod_rod;
    const Complex n_slider_offset__crank_theta = eta_row*(by_q_slider_offset_crank_theta*eta
        + by_v_slider_offset_crank_theta) + phi_slider_offset_crank_theta;
    const Complex n_slider_offset__rod_theta = eta_row*(by_q_slider_offset_rod_theta*eta
        + by_v_slider_offset_rod_theta) + phi_slider_offset_rod_theta;

    /* L U */
    const Complex scale_crank_theta = n_crank_theta__crank_theta;
    if (!(complex_size(scale_crank_theta) > SINGULAR * complex_size(n_crank_theta__crank_theta)))
        return 1;
    const Complex inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[0] = inverse_pivot_crank_theta;
    const Complex l_rod_theta__crank_theta = inverse_pivot_crank_theta*n_rod_theta__crank_theta;
    lin->lu[1] = l_rod_theta__crank_theta;
    lin->lu[2] = n_crank_theta__rod_theta;
    const Complex l_slider_offset__crank_theta = inverse_pivot_crank_theta*n_slider_offset__crank_theta;
    lin->lu[3] = l_slider_offset__crank_theta;
    const Complex scale_rod_theta = -l_rod_theta__crank_theta*n_crank_theta__rod_theta + n_rod_theta__rod_theta;
    if (!(complex_size(scale_rod_theta) > SINGULAR * complex_size(n_rod_theta__rod_theta)))
        return 2;
    const Complex inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[4] = inverse_pivot_rod_theta;
    const Complex l_slider_offset__rod_theta = inverse_pivot_rod_theta
        *(-l_slider_offset__crank_theta*n_crank_theta__rod_theta + n_slider_offset__rod_theta);
    lin->lu[5] = l_slider_offset__rod_theta;
    const Complex u_rod_theta__slider_offset = -l_rod_theta__crank_theta*phi_slider_offset_crank_theta
        + phi_slider_offset_rod_theta;
    lin->lu[6] = u_rod_theta__slider_offset;
    const Complex scale_slider_offset = -l_slider_offset__crank_theta*phi_slider_offset_crank_theta
        - l_slider_offset__rod_theta*u_rod_theta__slider_offset;
    if (!(complex_size(scale_slider_offset) > 0.0 && complex_size(scale_slider_offset) <= DBL_MAX))
        return 3;
    const Complex inverse_pivot_slider_offset = 1.0/scale_slider_offset;
    lin->lu[7] = inverse_pivot_slider_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const double phi_slider_offset_crank_theta = lin->value[1];
    const Complex inverse_pivot_crank_theta = lin->lu[0];
    const Complex l_rod_theta__crank_theta = lin->lu[1];
    const Complex n_crank_theta__rod_theta = lin->lu[2];
    const Complex l_slider_offset__crank_theta = lin->lu[3];
    const Complex inverse_pivot_rod_theta = lin->lu[4];
    const Complex l_slider_offset__rod_theta = lin->lu[5];
    const Complex u_rod_theta__slider_offset = lin->lu[6];
    const Complex inverse_pivot_slider_offset = lin->lu[7];

    /* forward */
    const Complex b_crank_theta = x[0];
    const Complex b_rod_theta = -b_crank_theta*l_rod_theta__crank_theta + x[1];
    const Complex b_slider_offset = -b_crank_theta*l_slider_offset__crank_theta
        - b_rod_theta*l_slider_offset__rod_theta + x[2];

    /* backward */
    const Complex x_slider_offset = b_slider_offset*inverse_pivot_slider_offset;
    x[2] = x_slider_offset;
    const Complex x_rod_theta = inverse_pivot_rod_theta*(b_rod_theta - u_rod_theta__slider_offset*x_slider_offset);
    x[1] = x_rod_theta;
    const Complex x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta - n_crank_theta__rod_theta*x_rod_theta
        - phi_slider_offset_crank_theta*x_slider_offset);
    x[0] = x_crank_theta;
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[3];
    const Complex shifted_crank_theta = -p->beta_squared*eta*r[0] + r[2];
    const Complex shifted_rod_theta = -p->beta_squared*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta*eta*r[0] - by_q_crank_theta_rod_theta*eta*r[1] + p->mass_crank_crank*r[2]
        + mass_crank_theta_rod_theta*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta*eta*r[0] - by_q_rod_theta_rod_theta*eta*r[1]
        + mass_crank_theta_rod_theta*r[2] + p->mass_rod_rod*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta*eta*r[0] - by_q_slider_offset_rod_theta*eta*r[1]
        + phi_slider_offset_crank_theta*shifted_crank_theta + phi_slider_offset_rod_theta*shifted_rod_theta);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta*u[0] + power_q_1_rod_theta*u[1] + power_v_1_crank_theta*u[2]
        + power_v_1_rod_theta*u[3] + r[5]);
    u[6] = eta*r[6];
}
