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
    const double by_q_arm_theta_arm_theta = lin->value[0];

    /* matrix */
    const double n_arm_theta__arm_theta = by_q_arm_theta_arm_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_arm_arm;
    const double n_arm_theta__arm_theta_i = 2.0*by_q_arm_theta_arm_theta*eta*eta_i;

    /* L U */
    const double scale_arm_theta = n_arm_theta__arm_theta;
    const double scale_arm_theta_i = n_arm_theta__arm_theta_i;
    const double size_1 = fabs(scale_arm_theta) + fabs(scale_arm_theta_i);
    const double size_2 = fabs(n_arm_theta__arm_theta) + fabs(n_arm_theta__arm_theta_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_1 = 1.0/((scale_arm_theta * scale_arm_theta) + (scale_arm_theta_i * scale_arm_theta_i));
    const double inverse_pivot_arm_theta = divisor_1*scale_arm_theta;
    const double inverse_pivot_arm_theta_i = -divisor_1*scale_arm_theta_i;
    lin->lu[0] = inverse_pivot_arm_theta;
    lin->lu[1] = inverse_pivot_arm_theta_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_arm_theta = lin->lu[0];
    const double inverse_pivot_arm_theta_i = lin->lu[1];

    /* forward */
    const double b_arm_theta = x[0];
    const double b_arm_theta_i = x[1];

    /* backward */
    const double x_arm_theta = b_arm_theta*inverse_pivot_arm_theta - b_arm_theta_i*inverse_pivot_arm_theta_i;
    const double x_arm_theta_i = b_arm_theta*inverse_pivot_arm_theta_i + b_arm_theta_i*inverse_pivot_arm_theta;
    x[0] = x_arm_theta;
    x[1] = x_arm_theta_i;
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
    const double by_q_arm_theta_arm_theta = lin->value[0];
    const double power_q_0_arm_theta = lin->value[2];
    const double power_v_0_arm_theta = lin->value[3];
    const double power_0_arm_theta = lin->value[4];

    /* right-hand side */
    double x[2];
    const double factor_1 = -by_q_arm_theta_arm_theta*(eta*r[0] - eta_i*r[1]) + p->mass_arm_arm*r[2];
    const double factor_2 = -by_q_arm_theta_arm_theta*(eta*r[1] + eta_i*r[0]) + p->mass_arm_arm*r[3];
    x[0] = eta*factor_1 - eta_i*factor_2;
    x[1] = eta*factor_2 + eta_i*factor_1;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_3 = r[0] + x[0];
    const double factor_4 = r[1] + x[1];
    u[0] = eta*factor_3 - eta_i*factor_4;
    u[1] = eta*factor_4 + eta_i*factor_3;
    u[2] = x[0];
    u[3] = x[1];
    const double factor_5 = power_q_0_arm_theta*u[0] + power_v_0_arm_theta*u[2] + r[4];
    const double factor_6 = power_q_0_arm_theta*u[1] + power_v_0_arm_theta*u[3] + r[5];
    u[4] = eta*factor_5 - eta_i*factor_6 + power_0_arm_theta*(-eta*r[2] + eta_i*r[3] + x[0]);
    u[5] = eta*factor_6 + eta_i*factor_5 + power_0_arm_theta*(-eta*r[3] - eta_i*r[2] + x[1]);
    u[6] = eta*r[6] - eta_i*r[7];
    u[7] = eta*r[7] + eta_i*r[6];
    u[8] = eta*r[8] - eta_i*r[9];
    u[9] = eta*r[9] + eta_i*r[8];
}
