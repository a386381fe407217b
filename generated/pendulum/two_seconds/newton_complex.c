/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_bob_x__bob_x = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const Complex n_bob_y__bob_y = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const Complex n_rod_length__bob_x = eta_row*(by_q_rod_length_bob_x*eta + by_v_rod_length_bob_x)
        + phi_rod_length_bob_x;
    const Complex n_rod_length__bob_y = eta_row*(by_q_rod_length_bob_y*eta + by_v_rod_length_bob_y)
        + phi_rod_length_bob_y;

    /* L U */
    const Complex scale_bob_x = n_bob_x__bob_x;
    if (!(complex_size(scale_bob_x) > SINGULAR * complex_size(n_bob_x__bob_x)))
        return 1;
    const Complex inverse_pivot_bob_x = 1.0/scale_bob_x;
    lin->lu[0] = inverse_pivot_bob_x;
    const Complex l_rod_length__bob_x = inverse_pivot_bob_x*n_rod_length__bob_x;
    lin->lu[1] = l_rod_length__bob_x;
    const Complex scale_bob_y = n_bob_y__bob_y;
    if (!(complex_size(scale_bob_y) > SINGULAR * complex_size(n_bob_y__bob_y)))
        return 2;
    const Complex inverse_pivot_bob_y = 1.0/scale_bob_y;
    lin->lu[2] = inverse_pivot_bob_y;
    const Complex l_rod_length__bob_y = inverse_pivot_bob_y*n_rod_length__bob_y;
    lin->lu[3] = l_rod_length__bob_y;
    const Complex scale_rod_length = -l_rod_length__bob_x*phi_rod_length_bob_x
        - l_rod_length__bob_y*phi_rod_length_bob_y;
    if (!(complex_size(scale_rod_length) > 0.0 && complex_size(scale_rod_length) <= DBL_MAX))
        return 4;
    const Complex inverse_pivot_rod_length = 1.0/scale_rod_length;
    lin->lu[4] = inverse_pivot_rod_length;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const Complex inverse_pivot_bob_x = lin->lu[0];
    const Complex l_rod_length__bob_x = lin->lu[1];
    const Complex inverse_pivot_bob_y = lin->lu[2];
    const Complex l_rod_length__bob_y = lin->lu[3];
    const Complex inverse_pivot_rod_length = lin->lu[4];

    /* forward */
    const Complex b_bob_theta = x[2];
    const Complex b_bob_x = x[0];
    const Complex b_bob_y = x[1];
    const Complex b_rod_length = -b_bob_x*l_rod_length__bob_x - b_bob_y*l_rod_length__bob_y + x[3];

    /* backward */
    const Complex x_rod_length = b_rod_length*inverse_pivot_rod_length;
    x[3] = x_rod_length;
    const Complex x_bob_y = inverse_pivot_bob_y*(b_bob_y - phi_rod_length_bob_y*x_rod_length);
    x[1] = x_bob_y;
    const Complex x_bob_x = inverse_pivot_bob_x*(b_bob_x - phi_rod_length_bob_x*x_rod_length);
    x[0] = x_bob_x;
    const Complex x_bob_theta = b_bob_theta*p->inverse_bob_inertia;
    x[2] = x_bob_theta;
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
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const double by_q_rod_length_bob_x = lin->value[2];
    const double by_q_rod_length_bob_y = lin->value[3];
    const double by_q_bob_x_bob_x = lin->value[4];

    /* eta/kappa */
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[4];
    const Complex shifted_bob_x = -p->beta_squared*eta*r[0] + r[3];
    const Complex shifted_bob_y = -p->beta_squared*eta*r[1] + r[4];
    x[0] = eta*(p->bob_mass*r[3] - by_q_bob_x_bob_x*eta*r[0]);
    x[1] = eta*(p->bob_mass*r[4] - by_q_bob_x_bob_x*eta*r[1]);
    x[2] = p->bob_inertia*eta*r[5];
    x[3] = eta_row*(-by_q_rod_length_bob_x*eta*r[0] - by_q_rod_length_bob_y*eta*r[1]
        + phi_rod_length_bob_x*shifted_bob_x + phi_rod_length_bob_y*shifted_bob_y);
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
    u[8] = eta*r[8];
}
