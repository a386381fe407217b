/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
{
    (void)eta, (void)lin;
    /* L U */
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* forward */
    const Complex b_ball_theta = x[0];

    /* backward */
    const Complex x_ball_theta = b_ball_theta*p->inverse_ball_inertia;
    x[0] = x_ball_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* right-hand side */
    Complex x[1];
    x[0] = p->ball_inertia*eta*r[1];
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*r[2];
    u[3] = eta*r[3];
    u[4] = eta*r[4];
}
