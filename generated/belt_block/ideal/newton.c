/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)a;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const double guide_slide_ = q[0];
    const double guide_slide_rate_ = v[0];

    /* directions, arms, drives */
    const double spring_span_x_ = guide_slide_ - p->wall_x_;
    const double side_0 = side_of(side, g, 0, spring_span_x_);
    const double spring_length_ = side_0*spring_span_x_;
    const double spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const double spring_pull_ = spring_force_/spring_length_;

    /* friction: slip, or stick as a row */
    const double mode_rub_ = memory->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub_ = mode_rub_ == 0.0 ? 1.0 : 0.0;
    const double sign_rub_ = fabs(mode_rub_) > 1.0 ? 0.0 : mode_rub_;
    const double held_force_rub_ = stick_rub_ != 0.0 ? aside->friction[0].force : 0.0;

    /* coordinates */
    const double spring_force_by_guide_slide_ = side_0*p->spring_stiffness_;
    const double inverse_spring_length_ = 1.0/spring_length_;
    const double spring_pull_by_guide_slide_ = -(inverse_spring_length_ * inverse_spring_length_)*side_0*spring_force_
        + inverse_spring_length_*spring_force_by_guide_slide_;

    /* results */
    lin->value[0] = spring_pull_ + spring_pull_by_guide_slide_*spring_span_x_;
    lin->value[1] = held_force_rub_ - p->rub_kinetic_*sign_rub_;
    lin->value[2] = -guide_slide_rate_*stick_rub_;
    lin->value[3] = stick_rub_;
    lin->value[4] = 1.0;
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
    const double by_q_guide_slide_guide_slide_ = lin->value[0];
    const double is_stick_rub_2_ = lin->value[3];

    /* matrix */
    const double n_guide_slide_guide_slide_ = p->block_mass_ + by_q_guide_slide_guide_slide_*(eta * eta);

    /* L U */
    const double scale_guide_slide_ = n_guide_slide_guide_slide_;
    if (!(fabs(scale_guide_slide_) > SINGULAR * fabs(n_guide_slide_guide_slide_)))
        return 1;
    const double inverse_pivot_guide_slide_ = 1.0/scale_guide_slide_;
    lin->lu[0] = inverse_pivot_guide_slide_;
    const double scale_rub_ = -inverse_pivot_guide_slide_;
    if (is_stick_rub_2_ != 0.0 && !(scale_rub_ != 0.0 && isfinite(scale_rub_)))
        return 2;
    const double inverse_pivot_rub_ = is_stick_rub_2_ != 0.0 ? 1.0/scale_rub_ : 0.0;
    lin->lu[1] = inverse_pivot_rub_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_guide_slide_ = lin->lu[0];
    const double inverse_pivot_rub_ = lin->lu[1];

    /* forward */
    const double b_guide_slide_ = x[0];
    const double b_rub_ = -b_guide_slide_*inverse_pivot_guide_slide_ + x[1];

    /* backward */
    const double x_rub_ = b_rub_*inverse_pivot_rub_;
    x[1] = x_rub_;
    const double x_guide_slide_ = inverse_pivot_guide_slide_*(b_guide_slide_ - x_rub_);
    x[0] = x_guide_slide_;
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
    const double by_q_guide_slide_guide_slide_ = lin->value[0];
    const double power_v_1_guide_slide_ = lin->value[1];
    const double power_1_rub_ = lin->value[2];

    /* eta/kappa */
    const double eta_stick = eta/(eta*p->two_alpha_stick_ + 1.0);

    /* right-hand side */
    double x[2];
    x[0] = eta*(p->block_mass_*r[1] - by_q_guide_slide_guide_slide_*eta*r[0]);
    x[1] = eta_stick*r[1];
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*r[2];
    u[3] = eta*(power_v_1_guide_slide_*u[1] + r[3]) + power_1_rub_*x[1];
    u[4] = eta*r[4];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {1, 0, 4, 1}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 1, 1, 1}
};
static const LinearEntry power_row_entries[] = {
    {1, 1, 2, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 1,
    N_RESIDUAL = 1,
    N_RESIDUAL_T = 0,
    N_POWER = 1,
    N_POWER_ROW = 1,
    N_POWER_T = 0,
    N_NODES = 2,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)t, (void)q, (void)v, (void)memory, (void)p;
    /* backward substitution */
    const double dq_acceleration_guide_slide_ = 0.0;

    /* backward substitution */
    const double dv_acceleration_guide_slide_ = 0.0;

    /* results */
    dq[0] = dq_acceleration_guide_slide_;
    dv[0] = dv_acceleration_guide_slide_;
    *worst = 0.0;
    return 0;
}
