/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 * At complex eta: real and imaginary parts one behind the other.
 */
int newton_factor_complex(double eta, double eta_i, ComplexLinear *lin)
{
    (void)eta, (void)eta_i, (void)lin;
    /* L U */
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

    /* forward */
    const double b_ball_theta = x[0];
    const double b_ball_theta_i = x[1];

    /* backward */
    const double x_ball_theta = b_ball_theta*p->inverse_ball_inertia;
    const double x_ball_theta_i = b_ball_theta_i*p->inverse_ball_inertia;
    x[0] = x_ball_theta;
    x[1] = x_ball_theta_i;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 * At complex eta: real and imaginary parts one behind the other.
 */
void newton_solve_complex(const ComplexLinear *lin, double eta, double eta_i, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* right-hand side */
    double x[2];
    x[0] = p->ball_inertia*(eta*r[2] - eta_i*r[3]);
    x[1] = p->ball_inertia*(eta*r[3] + eta_i*r[2]);
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_1 = r[0] + x[0];
    const double factor_2 = r[1] + x[1];
    u[0] = eta*factor_1 - eta_i*factor_2;
    u[1] = eta*factor_2 + eta_i*factor_1;
    u[2] = x[0];
    u[3] = x[1];
    u[4] = eta*r[4] - eta_i*r[5];
    u[5] = eta*r[5] + eta_i*r[4];
    u[6] = eta*r[6] - eta_i*r[7];
    u[7] = eta*r[7] + eta_i*r[6];
    u[8] = eta*r[8] - eta_i*r[9];
    u[9] = eta*r[9] + eta_i*r[8];
}
