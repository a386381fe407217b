/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory, (void)aside;
    /* coordinates, velocities, time */
    const double rod_omega_ = v[1];
    const double arm_theta_ = q[0];
    const double arm_omega_ = v[0];
    const double cos_theta_crank_ = q[2];
    const double sin_theta_crank_ = q[3];
    const double cos_theta_rod_ = q[4];
    const double sin_theta_rod_ = q[5];
    const double rod_theta_second_ = v[2];
    const double rod_theta_third_ = v[3];
    const double a_arm_theta_ = a[0];

    /* directions, arms, drives */
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double cos_theta_arm_ = cos(arm_theta_);
    const double sin_theta_arm_ = sin(arm_theta_);
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;
    const double cos_arm_less_crank_ = cos_theta_arm_*cos_theta_crank_ + sin_theta_arm_*sin_theta_crank_;
    const double sin_arm_less_crank_ = -cos_theta_arm_*sin_theta_crank_ + cos_theta_crank_*sin_theta_arm_;
    const double dot_crank_arm_ = cos_arm_less_crank_*p->inertia_crank_arm_;
    const double cross_crank_arm_ = p->inertia_crank_arm_*sin_arm_less_crank_;
    const double cos_arm_less_rod_ = cos_theta_arm_*cos_theta_rod_ + sin_theta_arm_*sin_theta_rod_;
    const double sin_arm_less_rod_ = -cos_theta_arm_*sin_theta_rod_ + cos_theta_rod_*sin_theta_arm_;
    const double dot_rod_arm_ = cos_arm_less_rod_*p->inertia_rod_arm_;
    const double cross_rod_arm_ = p->inertia_rod_arm_*sin_arm_less_rod_;

    /* coordinates */
    const double cross_crank_arm_by_time_ = -dot_crank_arm_*motor_rate_;
    const double cross_rod_arm_by_time_ = -dot_rod_arm_*rod_omega_;
    const double dot_crank_arm_by_time_ = cross_crank_arm_*motor_rate_;
    const double dot_rod_arm_by_time_ = cross_rod_arm_*rod_omega_;

    /* powers */
    const double cos_theta_crank_by_time_ = -motor_rate_*sin_theta_crank_;
    const double cos_theta_rod_by_time_ = -rod_omega_*sin_theta_rod_;
    const double cross_crank_rod_by_time_ = -dot_crank_rod_*motor_rate_ + dot_crank_rod_*rod_omega_;
    const double dot_crank_rod_by_time_ = cross_crank_rod_*motor_rate_ - cross_crank_rod_*rod_omega_;

    /* results */
    lin->value[0] = -cross_crank_arm_*motor_acceleration_ - cross_rod_arm_*rod_theta_second_
        + dot_crank_arm_*(motor_rate_ * motor_rate_) + dot_rod_arm_*(rod_omega_ * rod_omega_)
        + sin_theta_arm_*p->weight_arm_across_;
    lin->value[1] = 2.0*cross_crank_arm_*motor_acceleration_*motor_rate_
        + cross_crank_arm_by_time_*(motor_rate_ * motor_rate_) + 2.0*cross_rod_arm_*rod_omega_*rod_theta_second_
        + cross_rod_arm_by_time_*(rod_omega_ * rod_omega_) + dot_crank_arm_by_time_*motor_acceleration_
        + dot_rod_arm_*rod_theta_third_ + dot_rod_arm_by_time_*rod_theta_second_;
    lin->value[2] = -a_arm_theta_*cross_crank_arm_*motor_rate_ - a_arm_theta_*cross_rod_arm_*rod_omega_
        - (arm_omega_ * arm_omega_)*dot_crank_arm_*motor_rate_ - (arm_omega_ * arm_omega_)*dot_rod_arm_*rod_omega_;
    lin->value[3] = -2.0*arm_omega_*cross_crank_arm_*motor_rate_ - 2.0*arm_omega_*cross_rod_arm_*rod_omega_;
    lin->value[4] = dot_crank_arm_*motor_rate_ + dot_rod_arm_*rod_omega_;
    lin->value[5] = a_arm_theta_*dot_crank_arm_by_time_*motor_rate_ + a_arm_theta_*dot_rod_arm_by_time_*rod_omega_
        - (arm_omega_ * arm_omega_)*cross_crank_arm_by_time_*motor_rate_
        - (arm_omega_ * arm_omega_)*cross_rod_arm_by_time_*rod_omega_
        - cos_theta_crank_by_time_*motor_rate_*p->weight_crank_across_
        - cos_theta_rod_by_time_*rod_omega_*p->weight_rod_across_
        + cross_crank_rod_by_time_*((motor_rate_ * motor_rate_)*rod_omega_ - motor_rate_*(rod_omega_ * rod_omega_))
        + dot_crank_rod_by_time_*(motor_acceleration_*rod_omega_ + motor_rate_*rod_theta_second_)
        + motor_acceleration_*(a_arm_theta_*dot_crank_arm_ - (arm_omega_ * arm_omega_)*cross_crank_arm_
        - cos_theta_crank_*p->weight_crank_across_ + 2.0*cross_crank_rod_*motor_rate_*rod_omega_
        - cross_crank_rod_*(rod_omega_ * rod_omega_) + dot_crank_rod_*rod_theta_second_
        + p->mass_motor_motor_*motor_acceleration_) + rod_theta_second_*(a_arm_theta_*dot_rod_arm_
        - (arm_omega_ * arm_omega_)*cross_rod_arm_ - cos_theta_rod_*p->weight_rod_across_
        + cross_crank_rod_*(motor_rate_ * motor_rate_) - 2.0*cross_crank_rod_*motor_rate_*rod_omega_
        + dot_crank_rod_*motor_acceleration_ + p->mass_rod_rod_*rod_theta_second_)
        + rod_theta_third_*(dot_crank_rod_*motor_rate_ + p->mass_rod_rod_*rod_omega_);
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
    const double by_q_arm_theta_arm_theta_ = lin->value[0];

    /* matrix */
    const double n_arm_theta_arm_theta_ = by_q_arm_theta_arm_theta_*(eta * eta) + p->mass_arm_arm_;

    /* L U */
    const double scale_arm_theta_ = n_arm_theta_arm_theta_;
    if (!(fabs(scale_arm_theta_) > SINGULAR * fabs(n_arm_theta_arm_theta_)))
        return 1;
    const double inverse_pivot_arm_theta_ = 1.0/scale_arm_theta_;
    lin->lu[0] = inverse_pivot_arm_theta_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_arm_theta_ = lin->lu[0];

    /* forward */
    const double b_arm_theta_ = x[0];

    /* backward */
    const double x_arm_theta_ = b_arm_theta_*inverse_pivot_arm_theta_;
    x[0] = x_arm_theta_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_arm_theta_arm_theta_ = lin->value[0];
    const double by_t_arm_theta_ = lin->value[1];
    const double power_q_0_arm_theta_ = lin->value[2];
    const double power_v_0_arm_theta_ = lin->value[3];
    const double power_0_arm_theta_ = lin->value[4];
    const double power_t_0_ = lin->value[5];

    /* right-hand side */
    double x[1];
    x[0] = eta*(-by_q_arm_theta_arm_theta_*eta*r[0] - by_t_arm_theta_*s + p->mass_arm_arm_*r[1]);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*(power_q_0_arm_theta_*u[0] + power_t_0_*s + power_v_0_arm_theta_*u[1] + r[2])
        + power_0_arm_theta_*(-eta*r[1] + x[0]);
    u[3] = eta*r[3];
    u[4] = eta*r[4];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 1, 1}
};
static const LinearEntry power_entries[] = {
    {0, 0, 2, 1}, {0, 1, 3, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 4, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 5, 1}
};
enum {
    N_PHI_Q = 0,
    N_RESIDUAL = 1,
    N_RESIDUAL_T = 1,
    N_POWER = 2,
    N_POWER_ROW = 1,
    N_POWER_T = 1,
    N_NODES = 1,
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
    const double dq_acceleration_arm_theta_ = 0.0;

    /* backward substitution */
    const double dv_acceleration_arm_theta_ = 0.0;

    /* results */
    dq[0] = dq_acceleration_arm_theta_;
    dv[0] = dv_acceleration_arm_theta_;
    *worst = 0.0;
    return 0;
}
