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
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double is_stick_rub_2 = lin->value[3];

    /* matrix */
    const double n_guide_slide__guide_slide = p->block_mass + by_q_guide_slide_guide_slide*((eta * eta)
        - (eta_i * eta_i));
    const double n_guide_slide__guide_slide_i = 2.0*by_q_guide_slide_guide_slide*eta*eta_i;

    /* L U */
    const double scale_guide_slide = n_guide_slide__guide_slide;
    const double scale_guide_slide_i = n_guide_slide__guide_slide_i;
    const double size_1 = fabs(scale_guide_slide) + fabs(scale_guide_slide_i);
    const double size_2 = fabs(n_guide_slide__guide_slide) + fabs(n_guide_slide__guide_slide_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_1 = 1.0/((scale_guide_slide * scale_guide_slide)
        + (scale_guide_slide_i * scale_guide_slide_i));
    const double inverse_pivot_guide_slide = divisor_1*scale_guide_slide;
    const double inverse_pivot_guide_slide_i = -divisor_1*scale_guide_slide_i;
    lin->lu[0] = inverse_pivot_guide_slide;
    lin->lu[1] = inverse_pivot_guide_slide_i;
    const double scale_rub = -inverse_pivot_guide_slide;
    const double scale_rub_2_i = -inverse_pivot_guide_slide_i;
    const double size_3 = fabs(scale_rub) + fabs(scale_rub_2_i);
    if (is_stick_rub_2 != 0.0 && !(size_3 > 0.0 && size_3 < INFINITY))
        return 2;
    const double divisor_2 = 1.0/((scale_rub * scale_rub) + (scale_rub_2_i * scale_rub_2_i));
    const double inverse_pivot_rub = is_stick_rub_2 != 0.0 ? divisor_2*scale_rub : 0.0;
    const double inverse_pivot_rub_2_i = is_stick_rub_2 != 0.0 ? -divisor_2*scale_rub_2_i : 0.0;
    lin->lu[2] = inverse_pivot_rub;
    lin->lu[3] = inverse_pivot_rub_2_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_guide_slide = lin->lu[0];
    const double inverse_pivot_guide_slide_i = lin->lu[1];
    const double inverse_pivot_rub = lin->lu[2];
    const double inverse_pivot_rub_2_i = lin->lu[3];

    /* forward */
    const double b_guide_slide = x[0];
    const double b_guide_slide_i = x[1];
    const double b_rub = -b_guide_slide*inverse_pivot_guide_slide + b_guide_slide_i*inverse_pivot_guide_slide_i + x[2];
    const double b_rub_i = -b_guide_slide*inverse_pivot_guide_slide_i - b_guide_slide_i*inverse_pivot_guide_slide
        + x[3];

    /* backward */
    const double x_rub = b_rub*inverse_pivot_rub - b_rub_i*inverse_pivot_rub_2_i;
    const double x_rub_i = b_rub*inverse_pivot_rub_2_i + b_rub_i*inverse_pivot_rub;
    x[2] = x_rub;
    x[3] = x_rub_i;
    const double factor_1 = b_guide_slide - x_rub;
    const double factor_2 = b_guide_slide_i - x_rub_i;
    const double x_guide_slide = factor_1*inverse_pivot_guide_slide - factor_2*inverse_pivot_guide_slide_i;
    const double x_guide_slide_i = factor_1*inverse_pivot_guide_slide_i + factor_2*inverse_pivot_guide_slide;
    x[0] = x_guide_slide;
    x[1] = x_guide_slide_i;
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
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double power_v_1_guide_slide = lin->value[1];
    const double power_1_rub = lin->value[2];

    /* eta/kappa */
    const double divisor_1 = eta*p->two_alpha_stick + 1.0;
    const double divisor_2 = eta_i*p->two_alpha_stick;
    const double divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const double factor_1 = divisor_1*divisor_3;
    const double factor_2 = -divisor_2*divisor_3;
    const double eta_stick = eta*factor_1 - eta_i*factor_2;
    const double eta_stick_i = eta*factor_2 + eta_i*factor_1;

    /* right-hand side */
    double x[4];
    const double factor_3 = p->block_mass*r[2] - by_q_guide_slide_guide_slide*(eta*r[0] - eta_i*r[1]);
    const double factor_4 = p->block_mass*r[3] - by_q_guide_slide_guide_slide*(eta*r[1] + eta_i*r[0]);
    x[0] = eta*factor_3 - eta_i*factor_4;
    x[1] = eta*factor_4 + eta_i*factor_3;
    x[2] = eta_stick*r[2] - eta_stick_i*r[3];
    x[3] = eta_stick*r[3] + eta_stick_i*r[2];
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_5 = r[0] + x[0];
    const double factor_6 = r[1] + x[1];
    u[0] = eta*factor_5 - eta_i*factor_6;
    u[1] = eta*factor_6 + eta_i*factor_5;
    u[2] = x[0];
    u[3] = x[1];
    u[4] = eta*r[4] - eta_i*r[5];
    u[5] = eta*r[5] + eta_i*r[4];
    const double factor_7 = power_v_1_guide_slide*u[2] + r[6];
    const double factor_8 = power_v_1_guide_slide*u[3] + r[7];
    u[6] = eta*factor_7 - eta_i*factor_8 + power_1_rub*x[2];
    u[7] = eta*factor_8 + eta_i*factor_7 + power_1_rub*x[3];
    u[8] = eta*r[8] - eta_i*r[9];
    u[9] = eta*r[9] + eta_i*r[8];
}
