/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory, (void)aside;
    /* coordinates, velocities, time */
    const double rod_omega = v[1];
    const double arm_theta = q[0];
    const double arm_omega = v[0];
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];
    const double rod_theta_second = v[2];
    const double rod_theta_third = v[3];
    const double a_arm_theta = a[0];

    /* directions, arms, drives */
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double cos_theta_arm = cos(arm_theta);
    const double sin_theta_arm = sin(arm_theta);
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;
    const double cos_arm_less_crank = cos_theta_arm*cos_theta_crank + sin_theta_arm*sin_theta_crank;
    const double sin_arm_less_crank = -cos_theta_arm*sin_theta_crank + cos_theta_crank*sin_theta_arm;
    const double dot_crank_arm = cos_arm_less_crank*p->inertia_crank_arm;
    const double cross_crank_arm = p->inertia_crank_arm*sin_arm_less_crank;
    const double cos_arm_less_rod = cos_theta_arm*cos_theta_rod + sin_theta_arm*sin_theta_rod;
    const double sin_arm_less_rod = -cos_theta_arm*sin_theta_rod + cos_theta_rod*sin_theta_arm;
    const double dot_rod_arm = cos_arm_less_rod*p->inertia_rod_arm;
    const double cross_rod_arm = p->inertia_rod_arm*sin_arm_less_rod;

    /* coordinates */
    const double cross_crank_arm_by_time = -dot_crank_arm*motor_rate;
    const double cross_rod_arm_by_time = -dot_rod_arm*rod_omega;
    const double dot_crank_arm_by_time = cross_crank_arm*motor_rate;
    const double dot_rod_arm_by_time = cross_rod_arm*rod_omega;

    /* powers */
    const double cos_theta_crank_by_time = -motor_rate*sin_theta_crank;
    const double cos_theta_rod_by_time = -rod_omega*sin_theta_rod;
    const double cross_crank_rod_by_time = -dot_crank_rod*motor_rate + dot_crank_rod*rod_omega;
    const double dot_crank_rod_by_time = cross_crank_rod*motor_rate - cross_crank_rod*rod_omega;

    /* results */
    lin->value[0] = -cross_crank_arm*motor_acceleration - cross_rod_arm*rod_theta_second
        + dot_crank_arm*(motor_rate * motor_rate) + dot_rod_arm*(rod_omega * rod_omega)
        + sin_theta_arm*p->weight_arm__across;
    lin->value[1] = 2.0*cross_crank_arm*motor_acceleration*motor_rate
        + cross_crank_arm_by_time*(motor_rate * motor_rate) + 2.0*cross_rod_arm*rod_omega*rod_theta_second
        + cross_rod_arm_by_time*(rod_omega * rod_omega) + dot_crank_arm_by_time*motor_acceleration
        + dot_rod_arm*rod_theta_third + dot_rod_arm_by_time*rod_theta_second;
    lin->value[2] = -a_arm_theta*cross_crank_arm*motor_rate - a_arm_theta*cross_rod_arm*rod_omega
        - (arm_omega * arm_omega)*dot_crank_arm*motor_rate - (arm_omega * arm_omega)*dot_rod_arm*rod_omega;
    lin->value[3] = -2.0*arm_omega*cross_crank_arm*motor_rate - 2.0*arm_omega*cross_rod_arm*rod_omega;
    lin->value[4] = dot_crank_arm*motor_rate + dot_rod_arm*rod_omega;
    lin->value[5] = a_arm_theta*dot_crank_arm_by_time*motor_rate + a_arm_theta*dot_rod_arm_by_time*rod_omega
        - (arm_omega * arm_omega)*cross_crank_arm_by_time*motor_rate
        - (arm_omega * arm_omega)*cross_rod_arm_by_time*rod_omega
        - cos_theta_crank_by_time*motor_rate*p->weight_crank__across
        - cos_theta_rod_by_time*rod_omega*p->weight_rod__across
        + cross_crank_rod_by_time*((motor_rate * motor_rate)*rod_omega - motor_rate*(rod_omega * rod_omega))
        + dot_crank_rod_by_time*(motor_acceleration*rod_omega + motor_rate*rod_theta_second)
        + motor_acceleration*(a_arm_theta*dot_crank_arm - (arm_omega * arm_omega)*cross_crank_arm
        - cos_theta_crank*p->weight_crank__across + 2.0*cross_crank_rod*motor_rate*rod_omega
        - cross_crank_rod*(rod_omega * rod_omega) + dot_crank_rod*rod_theta_second
        + p->mass_motor_motor*motor_acceleration) + rod_theta_second*(a_arm_theta*dot_rod_arm
        - (arm_omega * arm_omega)*cross_rod_arm - cos_theta_rod*p->weight_rod__across
        + cross_crank_rod*(motor_rate * motor_rate) - 2.0*cross_crank_rod*motor_rate*rod_omega
        + dot_crank_rod*motor_acceleration + p->mass_rod_rod*rod_theta_second)
        + rod_theta_third*(dot_crank_rod*motor_rate + p->mass_rod_rod*rod_omega);
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
    const double by_q_arm_theta_arm_theta = lin->value[0];

    /* matrix */
    const double n_arm_theta__arm_theta = by_q_arm_theta_arm_theta*(eta * eta) + p->mass_arm_arm;

    /* L U */
    const double scale_arm_theta = n_arm_theta__arm_theta;
    if (!(fabs(scale_arm_theta) > SINGULAR * fabs(n_arm_theta__arm_theta)))
        return 1;
    const double inverse_pivot_arm_theta = 1.0/scale_arm_theta;
    lin->lu[0] = inverse_pivot_arm_theta;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_arm_theta = lin->lu[0];

    /* forward */
    const double b_arm_theta = x[0];

    /* backward */
    const double x_arm_theta = b_arm_theta*inverse_pivot_arm_theta;
    x[0] = x_arm_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_arm_theta_arm_theta = lin->value[0];
    const double by_t_arm_theta = lin->value[1];
    const double power_q_0_arm_theta = lin->value[2];
    const double power_v_0_arm_theta = lin->value[3];
    const double power_0_arm_theta = lin->value[4];
    const double power_t_0 = lin->value[5];

    /* right-hand side */
    double x[1];
    x[0] = eta*(-by_q_arm_theta_arm_theta*eta*r[0] - by_t_arm_theta*s + p->mass_arm_arm*r[1]);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*(power_q_0_arm_theta*u[0] + power_t_0*s + power_v_0_arm_theta*u[1] + r[2])
        + power_0_arm_theta*(-eta*r[1] + x[0]);
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
    const double dq_acceleration_arm_theta = 0.0;

    /* backward substitution */
    const double dv_acceleration_arm_theta = 0.0;

    /* results */
    dq[0] = dq_acceleration_arm_theta;
    dv[0] = dv_acceleration_arm_theta;
    *worst = 0.0;
    return 0;
}
