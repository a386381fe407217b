/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double is_stick_rub_2 = lin->value[3];

    /* matrix */
    const Complex n_guide_slide__guide_slide = p->block_mass + by_q_guide_slide_guide_slide*(eta * eta);

    /* L U */
    const Complex scale_guide_slide = n_guide_slide__guide_slide;
    if (!(complex_size(scale_guide_slide) > SINGULAR * complex_size(n_guide_slide__guide_slide)))
        return 1;
    const Complex inverse_pivot_guide_slide = 1.0/scale_guide_slide;
    lin->lu[0] = inverse_pivot_guide_slide;
    const Complex scale_rub = -inverse_pivot_guide_slide;
    if (is_stick_rub_2 != 0.0 && !(complex_size(scale_rub) > 0.0 && complex_size(scale_rub) <= DBL_MAX))
        return 2;
    const Complex inverse_pivot_rub = is_stick_rub_2 != 0.0 ? 1.0/scale_rub : 0.0;
    lin->lu[1] = inverse_pivot_rub;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const Complex inverse_pivot_guide_slide = lin->lu[0];
    const Complex inverse_pivot_rub = lin->lu[1];

    /* forward */
    const Complex b_guide_slide = x[0];
    const Complex b_rub = -b_guide_slide*inverse_pivot_guide_slide + x[1];

    /* backward */
    const Complex x_rub = b_rub*inverse_pivot_rub;
    x[1] = x_rub;
    const Complex x_guide_slide = inverse_pivot_guide_slide*(b_guide_slide - x_rub);
    x[0] = x_guide_slide;
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
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double power_v_1_guide_slide = lin->value[1];
    const double power_1_rub = lin->value[2];

    /* eta/kappa */
    const Complex eta_stick = eta/(eta*p->two_alpha_stick + 1.0);

    /* right-hand side */
    Complex x[2];
    x[0] = eta*(p->block_mass*r[1] - by_q_guide_slide_guide_slide*eta*r[0]);
    x[1] = eta_stick*r[1];
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*r[2];
    u[3] = eta*(power_v_1_guide_slide*u[1] + r[3]) + power_1_rub*x[1];
    u[4] = eta*r[4];
}
