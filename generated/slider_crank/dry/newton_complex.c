/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
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
    const Complex n_cylinder_slide__cylinder_slide = eta*(by_q_cylinder_slide_cylinder_slide*eta
        + by_v_cylinder_slide_cylinder_slide) + p->slider_mass;
    const Complex n_cylinder_slide__rod_theta = eta*(by_q_cylinder_slide_rod_theta*eta + by_v_cylinder_slide_rod_theta);
    const Complex n_rod_theta__cylinder_slide = eta*(by_q_rod_theta_cylinder_slide*eta + by_v_rod_theta_cylinder_slide);
    const Complex n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta)
        + p->mass_rod_rod;

    /* L U */
    const Complex scale_cylinder_slide = n_cylinder_slide__cylinder_slide;
    if (!(complex_size(scale_cylinder_slide) > SINGULAR * complex_size(n_cylinder_slide__cylinder_slide)))
        return 1;
    const Complex inverse_pivot_cylinder_slide = 1.0/scale_cylinder_slide;
    lin->lu[0] = inverse_pivot_cylinder_slide;
    const Complex l_rod_theta__cylinder_slide = inverse_pivot_cylinder_slide*n_rod_theta__cylinder_slide;
    lin->lu[1] = l_rod_theta__cylinder_slide;
    lin->lu[2] = n_cylinder_slide__rod_theta;
    const Complex scale_rod_theta = -l_rod_theta__cylinder_slide*n_cylinder_slide__rod_theta + n_rod_theta__rod_theta;
    if (!(complex_size(scale_rod_theta) > SINGULAR * complex_size(n_rod_theta__rod_theta)))
        return 2;
    const Complex inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[3] = inverse_pivot_rod_theta;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const Complex inverse_pivot_cylinder_slide = lin->lu[0];
    const Complex l_rod_theta__cylinder_slide = lin->lu[1];
    const Complex n_cylinder_slide__rod_theta = lin->lu[2];
    const Complex inverse_pivot_rod_theta = lin->lu[3];

    /* forward */
    const Complex b_cylinder_slide = x[0];
    const Complex b_rod_theta = -b_cylinder_slide*l_rod_theta__cylinder_slide + x[1];

    /* backward */
    const Complex x_rod_theta = b_rod_theta*inverse_pivot_rod_theta;
    x[1] = x_rod_theta;
    const Complex x_cylinder_slide = inverse_pivot_cylinder_slide*(b_cylinder_slide
        - n_cylinder_slide__rod_theta*x_rod_theta);
    x[0] = x_cylinder_slide;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_cylinder_slide_cylinder_slide = lin->value[0];
    const double by_q_cylinder_slide_rod_theta = lin->value[1];
    const double by_q_rod_theta_rod_theta = lin->value[2];
    const double by_q_rod_theta_cylinder_slide = lin->value[3];
    const double by_t_cylinder_slide = lin->value[8];
    const double by_t_rod_theta = lin->value[9];
    const double power_q_0_rod_theta = lin->value[10];
    const double power_q_0_cylinder_slide = lin->value[11];
    const double power_q_2_rod_theta = lin->value[12];
    const double power_q_2_cylinder_slide = lin->value[13];
    const double power_v_0_rod_theta = lin->value[14];
    const double power_v_0_cylinder_slide = lin->value[15];
    const double power_v_2_cylinder_slide = lin->value[16];
    const double power_v_2_rod_theta = lin->value[17];
    const double power_0_rod_theta = lin->value[18];
    const double power_t_0 = lin->value[19];
    const double power_t_2 = lin->value[20];

    /* right-hand side */
    Complex x[2];
    x[0] = eta*(-by_q_cylinder_slide_cylinder_slide*eta*r[0] - by_q_cylinder_slide_rod_theta*eta*r[1]
        - by_t_cylinder_slide*s + r[2]*p->slider_mass);
    x[1] = eta*(-by_q_rod_theta_cylinder_slide*eta*r[0] - by_q_rod_theta_rod_theta*eta*r[1] - by_t_rod_theta*s
        + p->mass_rod_rod*r[3]);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*(power_q_0_cylinder_slide*u[0] + power_q_0_rod_theta*u[1] + power_t_0*s + power_v_0_cylinder_slide*u[2]
        + power_v_0_rod_theta*u[3] + r[4]) + power_0_rod_theta*(-eta*r[3] + x[1]);
    u[5] = eta*r[5];
    u[6] = eta*(power_q_2_cylinder_slide*u[0] + power_q_2_rod_theta*u[1] + power_t_2*s + power_v_2_cylinder_slide*u[2]
        + power_v_2_rod_theta*u[3] + r[6]);
}
