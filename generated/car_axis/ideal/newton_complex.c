/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor_complex(Complex eta, ComplexLinear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double by_v_slot_offset_axle_theta = lin->value[15];
    const double by_v_slot_offset_axle_x = lin->value[16];
    const double by_v_slot_offset_axle_y = lin->value[17];

    /* eta/kappa */
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Complex n_axle_x__axle_x = p->axle_mass + by_q_axle_x_axle_x*(eta * eta);
    const Complex n_axle_x__axle_y = by_q_axle_x_axle_y*(eta * eta);
    const Complex n_axle_x__axle_theta = by_q_axle_x_axle_theta*(eta * eta);
    const Complex n_axle_y__axle_x = by_q_axle_y_axle_x*(eta * eta);
    const Complex n_axle_y__axle_y = p->axle_mass + by_q_axle_y_axle_y*(eta * eta);
    const Complex n_axle_y__axle_theta = by_q_axle_y_axle_theta*(eta * eta);
    const Complex n_axle_theta__axle_x = by_q_axle_theta_axle_x*(eta * eta);
    const Complex n_axle_theta__axle_y = by_q_axle_theta_axle_y*(eta * eta);
    const Complex n_axle_theta__axle_theta = p->axle_inertia + by_q_axle_theta_axle_theta*(eta * eta);
    const Complex n_slot_offset__axle_x = eta_row*(by_q_slot_offset_axle_x*eta + by_v_slot_offset_axle_x)
        + phi_slot_offset_axle_x;
    const Complex n_slot_offset__axle_y = eta_row*(by_q_slot_offset_axle_y*eta + by_v_slot_offset_axle_y)
        + phi_slot_offset_axle_y;
    const Complex n_slot_offset__axle_theta = eta_row*(by_q_slot_offset_axle_theta*eta + by_v_slot_offset_axle_theta)
        + phi_slot_offset_axle_theta;

    /* L U */
    const Complex scale_axle_x = n_axle_x__axle_x;
    if (!(complex_size(scale_axle_x) > SINGULAR * complex_size(n_axle_x__axle_x)))
        return 1;
    const Complex inverse_pivot_axle_x = 1.0/scale_axle_x;
    lin->lu[0] = inverse_pivot_axle_x;
    const Complex l_axle_y__axle_x = inverse_pivot_axle_x*n_axle_y__axle_x;
    lin->lu[1] = l_axle_y__axle_x;
    lin->lu[2] = n_axle_x__axle_y;
    const Complex l_axle_theta__axle_x = inverse_pivot_axle_x*n_axle_theta__axle_x;
    lin->lu[3] = l_axle_theta__axle_x;
    lin->lu[4] = n_axle_x__axle_theta;
    const Complex l_slot_offset__axle_x = inverse_pivot_axle_x*n_slot_offset__axle_x;
    lin->lu[5] = l_slot_offset__axle_x;
    const Complex scale_axle_y = -l_axle_y__axle_x*n_axle_x__axle_y + n_axle_y__axle_y;
    if (!(complex_size(scale_axle_y) > SINGULAR * complex_size(n_axle_y__axle_y)))
        return 2;
    const Complex inverse_pivot_axle_y = 1.0/scale_axle_y;
    lin->lu[6] = inverse_pivot_axle_y;
    const Complex l_axle_theta__axle_y = inverse_pivot_axle_y*(-l_axle_theta__axle_x*n_axle_x__axle_y
        + n_axle_theta__axle_y);
    lin->lu[7] = l_axle_theta__axle_y;
    const Complex u_axle_y__axle_theta = -l_axle_y__axle_x*n_axle_x__axle_theta + n_axle_y__axle_theta;
    lin->lu[8] = u_axle_y__axle_theta;
    const Complex l_slot_offset__axle_y = inverse_pivot_axle_y*(-l_slot_offset__axle_x*n_axle_x__axle_y
        + n_slot_offset__axle_y);
    lin->lu[9] = l_slot_offset__axle_y;
    const Complex u_axle_y__slot_offset = -l_axle_y__axle_x*phi_slot_offset_axle_x + phi_slot_offset_axle_y;
    lin->lu[10] = u_axle_y__slot_offset;
    const Complex scale_axle_theta = -l_axle_theta__axle_x*n_axle_x__axle_theta
        - l_axle_theta__axle_y*u_axle_y__axle_theta + n_axle_theta__axle_theta;
    if (!(complex_size(scale_axle_theta) > SINGULAR * complex_size(n_axle_theta__axle_theta)))
        return 3;
    const Complex inverse_pivot_axle_theta = 1.0/scale_axle_theta;
    lin->lu[11] = inverse_pivot_axle_theta;
    const Complex l_slot_offset__axle_theta = inverse_pivot_axle_theta*(-l_slot_offset__axle_x*n_axle_x__axle_theta
        - l_slot_offset__axle_y*u_axle_y__axle_theta + n_slot_offset__axle_theta);
    lin->lu[12] = l_slot_offset__axle_theta;
    const Complex u_axle_theta__slot_offset = -l_axle_theta__axle_x*phi_slot_offset_axle_x
        - l_axle_theta__axle_y*u_axle_y__slot_offset + phi_slot_offset_axle_theta;
    lin->lu[13] = u_axle_theta__slot_offset;
    const Complex scale_slot_offset = -l_slot_offset__axle_theta*u_axle_theta__slot_offset
        - l_slot_offset__axle_x*phi_slot_offset_axle_x - l_slot_offset__axle_y*u_axle_y__slot_offset;
    if (!(complex_size(scale_slot_offset) > 0.0 && complex_size(scale_slot_offset) <= DBL_MAX))
        return 4;
    const Complex inverse_pivot_slot_offset = 1.0/scale_slot_offset;
    lin->lu[14] = inverse_pivot_slot_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute_complex(const ComplexLinear *lin, Complex *x)
{
    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const Complex inverse_pivot_axle_x = lin->lu[0];
    const Complex l_axle_y__axle_x = lin->lu[1];
    const Complex n_axle_x__axle_y = lin->lu[2];
    const Complex l_axle_theta__axle_x = lin->lu[3];
    const Complex n_axle_x__axle_theta = lin->lu[4];
    const Complex l_slot_offset__axle_x = lin->lu[5];
    const Complex inverse_pivot_axle_y = lin->lu[6];
    const Complex l_axle_theta__axle_y = lin->lu[7];
    const Complex u_axle_y__axle_theta = lin->lu[8];
    const Complex l_slot_offset__axle_y = lin->lu[9];
    const Complex u_axle_y__slot_offset = lin->lu[10];
    const Complex inverse_pivot_axle_theta = lin->lu[11];
    const Complex l_slot_offset__axle_theta = lin->lu[12];
    const Complex u_axle_theta__slot_offset = lin->lu[13];
    const Complex inverse_pivot_slot_offset = lin->lu[14];

    /* forward */
    const Complex b_axle_x = x[0];
    const Complex b_axle_y = -b_axle_x*l_axle_y__axle_x + x[1];
    const Complex b_axle_theta = -b_axle_x*l_axle_theta__axle_x - b_axle_y*l_axle_theta__axle_y + x[2];
    const Complex b_slot_offset = -b_axle_theta*l_slot_offset__axle_theta - b_axle_x*l_slot_offset__axle_x
        - b_axle_y*l_slot_offset__axle_y + x[3];

    /* backward */
    const Complex x_slot_offset = b_slot_offset*inverse_pivot_slot_offset;
    x[3] = x_slot_offset;
    const Complex x_axle_theta = inverse_pivot_axle_theta*(b_axle_theta - u_axle_theta__slot_offset*x_slot_offset);
    x[2] = x_axle_theta;
    const Complex x_axle_y = inverse_pivot_axle_y*(b_axle_y - u_axle_y__axle_theta*x_axle_theta
        - u_axle_y__slot_offset*x_slot_offset);
    x[1] = x_axle_y;
    const Complex x_axle_x = inverse_pivot_axle_x*(b_axle_x - n_axle_x__axle_theta*x_axle_theta
        - n_axle_x__axle_y*x_axle_y - phi_slot_offset_axle_x*x_slot_offset);
    x[0] = x_axle_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve_complex(const ComplexLinear *lin, Complex eta, Complex s, const Complex *r, Complex *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double by_t_slot_offset = lin->value[18];
    const double by_t_axle_x = lin->value[19];
    const double by_t_axle_y = lin->value[20];
    const double by_t_axle_theta = lin->value[21];
    const double power_q_0_axle_x = lin->value[22];
    const double power_q_0_axle_y = lin->value[23];
    const double power_q_0_axle_theta = lin->value[24];
    const double power_0_slot_offset = lin->value[25];
    const double power_t_0 = lin->value[26];

    /* eta/kappa */
    const Complex eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Complex x[4];
    const Complex shifted_axle_x = -p->beta_squared*eta*r[0] + r[3];
    const Complex shifted_axle_y = -p->beta_squared*eta*r[1] + r[4];
    const Complex shifted_axle_theta = -p->beta_squared*eta*r[2] + r[5];
    x[0] = eta*(p->axle_mass*r[3] - by_q_axle_x_axle_theta*eta*r[2] - by_q_axle_x_axle_x*eta*r[0]
        - by_q_axle_x_axle_y*eta*r[1] - by_t_axle_x*s);
    x[1] = eta*(p->axle_mass*r[4] - by_q_axle_y_axle_theta*eta*r[2] - by_q_axle_y_axle_x*eta*r[0]
        - by_q_axle_y_axle_y*eta*r[1] - by_t_axle_y*s);
    x[2] = eta*(p->axle_inertia*r[5] - by_q_axle_theta_axle_theta*eta*r[2] - by_q_axle_theta_axle_x*eta*r[0]
        - by_q_axle_theta_axle_y*eta*r[1] - by_t_axle_theta*s);
    x[3] = eta_row*(-by_q_slot_offset_axle_theta*eta*r[2] - by_q_slot_offset_axle_x*eta*r[0]
        - by_q_slot_offset_axle_y*eta*r[1] - by_t_slot_offset*s + phi_slot_offset_axle_theta*shifted_axle_theta
        + phi_slot_offset_axle_x*shifted_axle_x + phi_slot_offset_axle_y*shifted_axle_y);
    newton_substitute_complex(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*(power_q_0_axle_theta*u[2] + power_q_0_axle_x*u[0] + power_q_0_axle_y*u[1] + power_t_0*s + r[6])
        + power_0_slot_offset*x[3];
    u[7] = eta*r[7];
    u[8] = eta*r[8];
}
