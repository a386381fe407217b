/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double bob_x_ = q[0];
    const double bob_x_rate_ = v[0];
    const double bob_y_ = q[1];
    const double bob_y_rate_ = v[1];
    const double a_bob_x_ = a[0];
    const double a_bob_y_ = a[1];
    const double held_lambda_rod_length_ = aside->lambda[0];

    /* results */
    lin->value[0] = 2.0*bob_x_*p->rod_half_inverse_length_;
    lin->value[1] = 2.0*bob_y_*p->rod_half_inverse_length_;
    lin->value[2] = 2.0*a_bob_x_*p->rod_half_inverse_length_
        + 2.0*bob_x_rate_*p->rod_half_inverse_length_*p->two_alpha_;
    lin->value[3] = 2.0*a_bob_y_*p->rod_half_inverse_length_
        + 2.0*bob_y_rate_*p->rod_half_inverse_length_*p->two_alpha_;
    lin->value[4] = 2.0*held_lambda_rod_length_*p->rod_half_inverse_length_;
    lin->value[5] = 4.0*bob_x_rate_*p->rod_half_inverse_length_;
    lin->value[6] = 4.0*bob_y_rate_*p->rod_half_inverse_length_;
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
    const double phi_rod_length_bob_x_ = lin->value[0];
    const double phi_rod_length_bob_y_ = lin->value[1];
    const double by_q_rod_length_bob_x_ = lin->value[2];
    const double by_q_rod_length_bob_y_ = lin->value[3];
    const double by_q_bob_x_bob_x_ = lin->value[4];
    const double by_v_rod_length_bob_x_ = lin->value[5];
    const double by_v_rod_length_bob_y_ = lin->value[6];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_bob_x_bob_x_ = p->bob_mass_ + by_q_bob_x_bob_x_*(eta * eta);
    const double n_bob_y_bob_y_ = p->bob_mass_ + by_q_bob_x_bob_x_*(eta * eta);
    const double n_rod_length_bob_x_ = eta_row*(by_q_rod_length_bob_x_*eta + by_v_rod_length_bob_x_)
        + phi_rod_length_bob_x_;
    const double n_rod_length_bob_y_ = eta_row*(by_q_rod_length_bob_y_*eta + by_v_rod_length_bob_y_)
        + phi_rod_length_bob_y_;

    /* L U */
    const double scale_bob_x_ = n_bob_x_bob_x_;
    if (!(fabs(scale_bob_x_) > SINGULAR * fabs(n_bob_x_bob_x_)))
        return 1;
    const double inverse_pivot_bob_x_ = 1.0/scale_bob_x_;
    lin->lu[0] = inverse_pivot_bob_x_;
    const double l_rod_length_bob_x_ = inverse_pivot_bob_x_*n_rod_length_bob_x_;
    lin->lu[1] = l_rod_length_bob_x_;
    const double scale_bob_y_ = n_bob_y_bob_y_;
    if (!(fabs(scale_bob_y_) > SINGULAR * fabs(n_bob_y_bob_y_)))
        return 2;
    const double inverse_pivot_bob_y_ = 1.0/scale_bob_y_;
    lin->lu[2] = inverse_pivot_bob_y_;
    const double l_rod_length_bob_y_ = inverse_pivot_bob_y_*n_rod_length_bob_y_;
    lin->lu[3] = l_rod_length_bob_y_;
    const double scale_rod_length_ = -l_rod_length_bob_x_*phi_rod_length_bob_x_
        - l_rod_length_bob_y_*phi_rod_length_bob_y_;
    if (!(scale_rod_length_ != 0.0 && isfinite(scale_rod_length_)))
        return 4;
    const double inverse_pivot_rod_length_ = 1.0/scale_rod_length_;
    lin->lu[4] = inverse_pivot_rod_length_;
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
    const double phi_rod_length_bob_x_ = lin->value[0];
    const double phi_rod_length_bob_y_ = lin->value[1];
    const double inverse_pivot_bob_x_ = lin->lu[0];
    const double l_rod_length_bob_x_ = lin->lu[1];
    const double inverse_pivot_bob_y_ = lin->lu[2];
    const double l_rod_length_bob_y_ = lin->lu[3];
    const double inverse_pivot_rod_length_ = lin->lu[4];

    /* forward */
    const double b_bob_theta_ = x[2];
    const double b_bob_x_ = x[0];
    const double b_bob_y_ = x[1];
    const double b_rod_length_ = -b_bob_x_*l_rod_length_bob_x_ - b_bob_y_*l_rod_length_bob_y_ + x[3];

    /* backward */
    const double x_rod_length_ = b_rod_length_*inverse_pivot_rod_length_;
    x[3] = x_rod_length_;
    const double x_bob_y_ = inverse_pivot_bob_y_*(b_bob_y_ - phi_rod_length_bob_y_*x_rod_length_);
    x[1] = x_bob_y_;
    const double x_bob_x_ = inverse_pivot_bob_x_*(b_bob_x_ - phi_rod_length_bob_x_*x_rod_length_);
    x[0] = x_bob_x_;
    const double x_bob_theta_ = b_bob_theta_*p->inverse_bob_inertia_;
    x[2] = x_bob_theta_;
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
    const double phi_rod_length_bob_x_ = lin->value[0];
    const double phi_rod_length_bob_y_ = lin->value[1];
    const double by_q_rod_length_bob_x_ = lin->value[2];
    const double by_q_rod_length_bob_y_ = lin->value[3];
    const double by_q_bob_x_bob_x_ = lin->value[4];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[4];
    const double shifted_bob_x_ = -p->beta_squared_*eta*r[0] + r[3];
    const double shifted_bob_y_ = -p->beta_squared_*eta*r[1] + r[4];
    x[0] = eta*(p->bob_mass_*r[3] - by_q_bob_x_bob_x_*eta*r[0]);
    x[1] = eta*(p->bob_mass_*r[4] - by_q_bob_x_bob_x_*eta*r[1]);
    x[2] = p->bob_inertia_*eta*r[5];
    x[3] = eta_row*(-by_q_rod_length_bob_x_*eta*r[0] - by_q_rod_length_bob_y_*eta*r[1]
        + phi_rod_length_bob_x_*shifted_bob_x_ + phi_rod_length_bob_y_*shifted_bob_y_);
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
    const double bob_x_ = q[0];
    const double bob_x_rate_ = v[0];
    const double bob_y_ = q[1];
    const double bob_y_rate_ = v[1];

    /* Phi and Phi_dot */
    const double phi_rod_length_ = (bob_x_ * bob_x_)*p->rod_half_inverse_length_
        + (bob_y_ * bob_y_)*p->rod_half_inverse_length_ - 0.5*p->rod_length_;
    const double phi_dot_rod_length_ = 2.0*bob_x_*bob_x_rate_*p->rod_half_inverse_length_
        + 2.0*bob_y_*bob_y_rate_*p->rod_half_inverse_length_;

    /* L D L^T of the KKT matrix */
    const double w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_x_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_x_;
    const double w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const double l_rod_length_bob_y_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_y_;
    const double scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    if (!(scale_rod_length_ > 0.0 && scale_rod_length_ < INFINITY))
        return 1;
    const double inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* backward substitution */
    const double dq_lambda_rod_length_ = -inverse_pivot_rod_length_*phi_rod_length_;
    const double dq_acceleration_bob_y_ = -dq_lambda_rod_length_*l_rod_length_bob_y_;
    const double dq_acceleration_bob_x_ = -dq_lambda_rod_length_*l_rod_length_bob_x_;
    const double dq_acceleration_bob_theta_ = 0.0;

    /* backward substitution */
    const double dv_lambda_rod_length_ = -inverse_pivot_rod_length_*phi_dot_rod_length_;
    const double dv_acceleration_bob_y_ = -dv_lambda_rod_length_*l_rod_length_bob_y_;
    const double dv_acceleration_bob_x_ = -dv_lambda_rod_length_*l_rod_length_bob_x_;
    const double dv_acceleration_bob_theta_ = 0.0;

    /* results */
    dq[0] = dq_acceleration_bob_x_;
    dv[0] = dv_acceleration_bob_x_;
    dq[1] = dq_acceleration_bob_y_;
    dv[1] = dv_acceleration_bob_y_;
    dq[2] = dq_acceleration_bob_theta_;
    dv[2] = dv_acceleration_bob_theta_;
    *worst = max_of(0.0, fabs(phi_rod_length_));
    return 0;
}
