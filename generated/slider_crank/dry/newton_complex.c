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
    const double by_q_cylinder_slide_cylinder_slide = lin->value[0];
    const double by_q_cylinder_slide_rod_theta = lin->value[1];
    const double by_q_rod_theta_rod_theta = lin->value[2];
    const double by_q_rod_theta_cylinder_slide = lin->value[3];
    const double by_v_cylinder_slide_cylinder_slide = lin->value[4];
    const double by_v_cylinder_slide_rod_theta = lin->value[5];
    const double by_v_rod_theta_cylinder_slide = lin->value[6];
    const double by_v_rod_theta_rod_theta = lin->value[7];

    /* matrix */
    const double factor_1 = by_q_cylinder_slide_cylinder_slide*eta + by_v_cylinder_slide_cylinder_slide;
    const double factor_2 = by_q_cylinder_slide_cylinder_slide*eta_i;
    const double n_cylinder_slide__cylinder_slide = eta*factor_1 - eta_i*factor_2 + p->slider_mass;
    const double n_cylinder_slide__cylinder_slide_i = eta*factor_2 + eta_i*factor_1;
    const double factor_3 = by_q_cylinder_slide_rod_theta*eta + by_v_cylinder_slide_rod_theta;
    const double factor_4 = by_q_cylinder_slide_rod_theta*eta_i;
    const double n_cylinder_slide__rod_theta = eta*factor_3 - eta_i*factor_4;
    const double n_cylinder_slide__rod_theta_i = eta*factor_4 + eta_i*factor_3;
    const double factor_5 = by_q_rod_theta_cylinder_slide*eta + by_v_rod_theta_cylinder_slide;
    const double factor_6 = by_q_rod_theta_cylinder_slide*eta_i;
    const double n_rod_theta__cylinder_slide = eta*factor_5 - eta_i*factor_6;
    const double n_rod_theta__cylinder_slide_i = eta*factor_6 + eta_i*factor_5;
    const double factor_7 = by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta;
    const double factor_8 = by_q_rod_theta_rod_theta*eta_i;
    const double n_rod_theta__rod_theta = eta*factor_7 - eta_i*factor_8 + p->mass_rod_rod;
    const double n_rod_theta__rod_theta_i = eta*factor_8 + eta_i*factor_7;

    /* L U */
    const double scale_cylinder_slide = n_cylinder_slide__cylinder_slide;
    const double scale_cylinder_slide_i = n_cylinder_slide__cylinder_slide_i;
    const double size_1 = fabs(scale_cylinder_slide) + fabs(scale_cylinder_slide_i);
    const double size_2 = fabs(n_cylinder_slide__cylinder_slide) + fabs(n_cylinder_slide__cylinder_slide_i);
    if (!(size_1 > SINGULAR * size_2))
        return 1;
    const double divisor_1 = 1.0/((scale_cylinder_slide * scale_cylinder_slide)
        + (scale_cylinder_slide_i * scale_cylinder_slide_i));
    const double inverse_pivot_cylinder_slide = divisor_1*scale_cylinder_slide;
    const double inverse_pivot_cylinder_slide_i = -divisor_1*scale_cylinder_slide_i;
    lin->lu[0] = inverse_pivot_cylinder_slide;
    lin->lu[1] = inverse_pivot_cylinder_slide_i;
    const double l_rod_theta__cylinder_slide = inverse_pivot_cylinder_slide*n_rod_theta__cylinder_slide
        - inverse_pivot_cylinder_slide_i*n_rod_theta__cylinder_slide_i;
    const double l_rod_theta__cylinder_slide_i = inverse_pivot_cylinder_slide*n_rod_theta__cylinder_slide_i
        + inverse_pivot_cylinder_slide_i*n_rod_theta__cylinder_slide;
    lin->lu[2] = l_rod_theta__cylinder_slide;
    lin->lu[3] = l_rod_theta__cylinder_slide_i;
    lin->lu[4] = n_cylinder_slide__rod_theta;
    lin->lu[5] = n_cylinder_slide__rod_theta_i;
    const double scale_rod_theta = -l_rod_theta__cylinder_slide*n_cylinder_slide__rod_theta
        + l_rod_theta__cylinder_slide_i*n_cylinder_slide__rod_theta_i + n_rod_theta__rod_theta;
    const double scale_rod_theta_i = -l_rod_theta__cylinder_slide*n_cylinder_slide__rod_theta_i
        - l_rod_theta__cylinder_slide_i*n_cylinder_slide__rod_theta + n_rod_theta__rod_theta_i;
    const double size_3 = fabs(scale_rod_theta) + fabs(scale_rod_theta_i);
    const double size_4 = fabs(n_rod_theta__rod_theta) + fabs(n_rod_theta__rod_theta_i);
    if (!(size_3 > SINGULAR * size_4))
        return 2;
    const double divisor_2 = 1.0/((scale_rod_theta * scale_rod_theta) + (scale_rod_theta_i * scale_rod_theta_i));
    const double inverse_pivot_rod_theta = divisor_2*scale_rod_theta;
    const double inverse_pivot_rod_theta_i = -divisor_2*scale_rod_theta_i;
    lin->lu[6] = inverse_pivot_rod_theta;
    lin->lu[7] = inverse_pivot_rod_theta_i;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const ComplexLinear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_cylinder_slide = lin->lu[0];
    const double inverse_pivot_cylinder_slide_i = lin->lu[1];
    const double l_rod_theta__cylinder_slide = lin->lu[2];
    const double l_rod_theta__cylinder_slide_i = lin->lu[3];
    const double n_cylinder_slide__rod_theta = lin->lu[4];
    const double n_cylinder_slide__rod_theta_i = lin->lu[5];
    const double inverse_pivot_rod_theta = lin->lu[6];
    const double inverse_pivot_rod_theta_i = lin->lu[7];

    /* forward */
    const double b_cylinder_slide = x[0];
    const double b_cylinder_slide_i = x[1];
    const double b_rod_theta = -b_cylinder_slide*l_rod_theta__cylinder_slide
        + b_cylinder_slide_i*l_rod_theta__cylinder_slide_i + x[2];
    const double b_rod_theta_i = -b_cylinder_slide*l_rod_theta__cylinder_slide_i
        - b_cylinder_slide_i*l_rod_theta__cylinder_slide + x[3];

    /* backward */
    const double x_rod_theta = b_rod_theta*inverse_pivot_rod_theta - b_rod_theta_i*inverse_pivot_rod_theta_i;
    const double x_rod_theta_i = b_rod_theta*inverse_pivot_rod_theta_i + b_rod_theta_i*inverse_pivot_rod_theta;
    x[2] = x_rod_theta;
    x[3] = x_rod_theta_i;
    const double factor_1 = b_cylinder_slide - n_cylinder_slide__rod_theta*x_rod_theta
        + n_cylinder_slide__rod_theta_i*x_rod_theta_i;
    const double factor_2 = b_cylinder_slide_i - n_cylinder_slide__rod_theta*x_rod_theta_i
        - n_cylinder_slide__rod_theta_i*x_rod_theta;
    const double x_cylinder_slide = factor_1*inverse_pivot_cylinder_slide - factor_2*inverse_pivot_cylinder_slide_i;
    const double x_cylinder_slide_i = factor_1*inverse_pivot_cylinder_slide_i + factor_2*inverse_pivot_cylinder_slide;
    x[0] = x_cylinder_slide;
    x[1] = x_cylinder_slide_i;
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
    const double by_q_cylinder_slide_cylinder_slide = lin->value[0];
    const double by_q_cylinder_slide_rod_theta = lin->value[1];
    const double by_q_rod_theta_rod_theta = lin->value[2];
    const double by_q_rod_theta_cylinder_slide = lin->value[3];
    const double power_q_0_rod_theta = lin->value[10];
    const double power_q_0_cylinder_slide = lin->value[11];
    const double power_q_2_rod_theta = lin->value[12];
    const double power_q_2_cylinder_slide = lin->value[13];
    const double power_v_0_rod_theta = lin->value[14];
    const double power_v_0_cylinder_slide = lin->value[15];
    const double power_v_2_cylinder_slide = lin->value[16];
    const double power_v_2_rod_theta = lin->value[17];
    const double power_0_rod_theta = lin->value[18];

    /* right-hand side */
    double x[4];
    const double factor_1 = -by_q_cylinder_slide_cylinder_slide*(eta*r[0] - eta_i*r[1])
        - by_q_cylinder_slide_rod_theta*(eta*r[2] - eta_i*r[3]) + r[4]*p->slider_mass;
    const double factor_2 = -by_q_cylinder_slide_cylinder_slide*(eta*r[1] + eta_i*r[0])
        - by_q_cylinder_slide_rod_theta*(eta*r[3] + eta_i*r[2]) + r[5]*p->slider_mass;
    x[0] = eta*factor_1 - eta_i*factor_2;
    x[1] = eta*factor_2 + eta_i*factor_1;
    const double factor_3 = -by_q_rod_theta_cylinder_slide*(eta*r[0] - eta_i*r[1])
        - by_q_rod_theta_rod_theta*(eta*r[2] - eta_i*r[3]) + p->mass_rod_rod*r[6];
    const double factor_4 = -by_q_rod_theta_cylinder_slide*(eta*r[1] + eta_i*r[0])
        - by_q_rod_theta_rod_theta*(eta*r[3] + eta_i*r[2]) + p->mass_rod_rod*r[7];
    x[2] = eta*factor_3 - eta_i*factor_4;
    x[3] = eta*factor_4 + eta_i*factor_3;
    newton_substitute_complex(lin, x);

    /* solution */
    const double factor_5 = r[0] + x[0];
    const double factor_6 = r[1] + x[1];
    u[0] = eta*factor_5 - eta_i*factor_6;
    u[1] = eta*factor_6 + eta_i*factor_5;
    u[4] = x[0];
    u[5] = x[1];
    const double factor_7 = r[2] + x[2];
    const double factor_8 = r[3] + x[3];
    u[2] = eta*factor_7 - eta_i*factor_8;
    u[3] = eta*factor_8 + eta_i*factor_7;
    u[6] = x[2];
    u[7] = x[3];
    const double factor_9 = power_q_0_cylinder_slide*u[0] + power_q_0_rod_theta*u[2] + power_v_0_cylinder_slide*u[4]
        + power_v_0_rod_theta*u[6] + r[8];
    const double factor_10 = power_q_0_cylinder_slide*u[1] + power_q_0_rod_theta*u[3] + power_v_0_cylinder_slide*u[5]
        + power_v_0_rod_theta*u[7] + r[9];
    u[8] = eta*factor_9 - eta_i*factor_10 + power_0_rod_theta*(-eta*r[6] + eta_i*r[7] + x[2]);
    u[9] = eta*factor_10 + eta_i*factor_9 + power_0_rod_theta*(-eta*r[7] - eta_i*r[6] + x[3]);
    u[10] = eta*r[10] - eta_i*r[11];
    u[11] = eta*r[11] + eta_i*r[10];
    const double factor_11 = power_q_2_cylinder_slide*u[0] + power_q_2_rod_theta*u[2] + power_v_2_cylinder_slide*u[4]
        + power_v_2_rod_theta*u[6] + r[12];
    const double factor_12 = power_q_2_cylinder_slide*u[1] + power_q_2_rod_theta*u[3] + power_v_2_cylinder_slide*u[5]
        + power_v_2_rod_theta*u[7] + r[13];
    u[12] = eta*factor_11 - eta_i*factor_12;
    u[13] = eta*factor_12 + eta_i*factor_11;
}
