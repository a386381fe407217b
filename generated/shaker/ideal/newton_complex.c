/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_arm_theta_arm_theta = lin->value[0];

    /* matrix */
    const Complex n_arm_theta__arm_theta = by_q_arm_theta_arm_theta*(eta * eta) + p->mass_arm_arm;

    /* L U */
    const Complex scale_arm_theta = n_arm_theta__arm_theta;
    if (!(complex_size(scale_arm_theta) > SINGULAR * complex_size(n_arm_theta__arm_theta)))
        return 1;
    const Complex inverse_pivot_arm_theta = 1.0/scale_arm_theta;
    lin->lu[0] = inverse_pivot_arm_theta;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const Complex inverse_pivot_arm_theta = lin->lu[0];

    /* forward */
    const Complex b_arm_theta = x[0];

    /* backward */
    const Complex x_arm_theta = b_arm_theta*inverse_pivot_arm_theta;
    x[0] = x_arm_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_arm_theta_arm_theta = lin->value[0];
    const double by_t_arm_theta = lin->value[1];
    const double power_q_0_arm_theta = lin->value[2];
    const double power_v_0_arm_theta = lin->value[3];
    const double power_0_arm_theta = lin->value[4];
    const double power_t_0 = lin->value[5];

    /* right-hand side */
    Complex x[1];
    x[0] = eta*(-by_q_arm_theta_arm_theta*eta*r[0] - by_t_arm_theta*s + p->mass_arm_arm*r[1]);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*(power_q_0_arm_theta*u[0] + power_t_0*s + power_v_0_arm_theta*u[1] + r[2])
        + power_0_arm_theta*(-eta*r[1] + x[0]);
    u[3] = eta*r[3];
    u[4] = eta*r[4];
}
