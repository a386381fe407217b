/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];
    const double a_bob_x = a[0];
    const double a_bob_y = a[1];
    const double held_lambda_rod_length = aside->lambda[0];

    /* results */
    lin->value[0] = 2.0*bob_x*p->rod_half_inverse_length;
    lin->value[1] = 2.0*bob_y*p->rod_half_inverse_length;
    lin->value[2] = 2.0*a_bob_x*p->rod_half_inverse_length + 2.0*bob_x_rate*p->rod_half_inverse_length*p->two_alpha;
    lin->value[3] = 2.0*a_bob_y*p->rod_half_inverse_length + 2.0*bob_y_rate*p->rod_half_inverse_length*p->two_alpha;
    lin->value[4] = 2.0*held_lambda_rod_length*p->rod_half_inverse_length;
    lin->value[5] = 4.0*bob_x_rate*p->rod_half_inverse_length;
    lin->value[6] = 4.0*bob_y_rate*p->rod_half_inverse_length;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor(double eta, Linear *lin)
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
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_bob_x__bob_x = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const double n_bob_y__bob_y = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const double n_rod_length__bob_x = eta_row*(by_q_rod_length_bob_x*eta + by_v_rod_length_bob_x)
        + phi_rod_length_bob_x;
    const double n_rod_length__bob_y = eta_row*(by_q_rod_length_bob_y*eta + by_v_rod_length_bob_y)
        + phi_rod_length_bob_y;

    /* L U */
    const double scale_bob_x = n_bob_x__bob_x;
    if (!(fabs(scale_bob_x) > SINGULAR * fabs(n_bob_x__bob_x)))
        return 1;
    const double inverse_pivot_bob_x = 1.0/scale_bob_x;
    lin->lu[0] = inverse_pivot_bob_x;
    const double l_rod_length__bob_x = inverse_pivot_bob_x*n_rod_length__bob_x;
    lin->lu[1] = l_rod_length__bob_x;
    const double scale_bob_y = n_bob_y__bob_y;
    if (!(fabs(scale_bob_y) > SINGULAR * fabs(n_bob_y__bob_y)))
        return 2;
    const double inverse_pivot_bob_y = 1.0/scale_bob_y;
    lin->lu[2] = inverse_pivot_bob_y;
    const double l_rod_length__bob_y = inverse_pivot_bob_y*n_rod_length__bob_y;
    lin->lu[3] = l_rod_length__bob_y;
    const double scale_rod_length = -l_rod_length__bob_x*phi_rod_length_bob_x
        - l_rod_length__bob_y*phi_rod_length_bob_y;
    if (!(scale_rod_length != 0.0 && isfinite(scale_rod_length)))
        return 4;
    const double inverse_pivot_rod_length = 1.0/scale_rod_length;
    lin->lu[4] = inverse_pivot_rod_length;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_rod_length_bob_x = lin->value[0];
    const double phi_rod_length_bob_y = lin->value[1];
    const double inverse_pivot_bob_x = lin->lu[0];
    const double l_rod_length__bob_x = lin->lu[1];
    const double inverse_pivot_bob_y = lin->lu[2];
    const double l_rod_length__bob_y = lin->lu[3];
    const double inverse_pivot_rod_length = lin->lu[4];

    /* forward */
    const double b_bob_theta = x[2];
    const double b_bob_x = x[0];
    const double b_bob_y = x[1];
    const double b_rod_length = -b_bob_x*l_rod_length__bob_x - b_bob_y*l_rod_length__bob_y + x[3];

    /* backward */
    const double x_rod_length = b_rod_length*inverse_pivot_rod_length;
    x[3] = x_rod_length;
    const double x_bob_y = inverse_pivot_bob_y*(b_bob_y - phi_rod_length_bob_y*x_rod_length);
    x[1] = x_bob_y;
    const double x_bob_x = inverse_pivot_bob_x*(b_bob_x - phi_rod_length_bob_x*x_rod_length);
    x[0] = x_bob_x;
    const double x_bob_theta = b_bob_theta*p->inverse_bob_inertia;
    x[2] = x_bob_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
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
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[4];
    const double shifted_bob_x = -p->beta_squared*eta*r[0] + r[3];
    const double shifted_bob_y = -p->beta_squared*eta*r[1] + r[4];
    x[0] = eta*(p->bob_mass*r[3] - by_q_bob_x_bob_x*eta*r[0]);
    x[1] = eta*(p->bob_mass*r[4] - by_q_bob_x_bob_x*eta*r[1]);
    x[2] = p->bob_inertia*eta*r[5];
    x[3] = eta_row*(-by_q_rod_length_bob_x*eta*r[0] - by_q_rod_length_bob_y*eta*r[1]
        + phi_rod_length_bob_x*shifted_bob_x + phi_rod_length_bob_y*shifted_bob_y);
    newton_substitute(lin, x);

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

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {3, 0, 0, 1}, {3, 1, 1, 1}
};
static const LinearEntry residual_entries[] = {
    {3, 0, 2, 1}, {3, 1, 3, 1}, {0, 0, 4, 1}, {1, 1, 4, 1}, {3, 3, 5, 1}, {3, 4, 6, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 2,
    N_RESIDUAL = 6,
    N_RESIDUAL_T = 0,
    N_POWER = 0,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 4,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];

    /* Phi and Phi_dot */
    const double phi_rod_length = (bob_x * bob_x)*p->rod_half_inverse_length
        + (bob_y * bob_y)*p->rod_half_inverse_length - 0.5*p->rod_length;
    const double phi_dot_rod_length = 2.0*bob_x*bob_x_rate*p->rod_half_inverse_length
        + 2.0*bob_y*bob_y_rate*p->rod_half_inverse_length;

    /* L D L^T of the KKT matrix */
    const double w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const double l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const double w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const double l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const double scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    if (!(scale_rod_length > 0.0 && scale_rod_length < INFINITY))
        return 1;
    const double inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* backward substitution */
    const double dq_lambda_rod_length = -inverse_pivot_rod_length*phi_rod_length;
    const double dq_acceleration_bob_y = -dq_lambda_rod_length*l_rod_length__bob_y;
    const double dq_acceleration_bob_x = -dq_lambda_rod_length*l_rod_length__bob_x;
    const double dq_acceleration_bob_theta = 0.0;

    /* backward substitution */
    const double dv_lambda_rod_length = -inverse_pivot_rod_length*phi_dot_rod_length;
    const double dv_acceleration_bob_y = -dv_lambda_rod_length*l_rod_length__bob_y;
    const double dv_acceleration_bob_x = -dv_lambda_rod_length*l_rod_length__bob_x;
    const double dv_acceleration_bob_theta = 0.0;

    /* results */
    dq[0] = dq_acceleration_bob_x;
    dv[0] = dv_acceleration_bob_x;
    dq[1] = dq_acceleration_bob_y;
    dv[1] = dv_acceleration_bob_y;
    dq[2] = dq_acceleration_bob_theta;
    dv[2] = dv_acceleration_bob_theta;
    *worst = max_of(0.0, fabs(phi_rod_length));
    return 0;
}
