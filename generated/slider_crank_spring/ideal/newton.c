/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];
    const double a_crank_theta = a[0];
    const double a_rod_theta = a[1];
    const double held_lambda_slider_offset = aside->lambda[0];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_crank_head_y = p->crank_length*sin_theta_crank;
    const double crank_head_vx = -crank_omega*span_crank_head_y;
    const double crank_head_vy = crank_omega*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const double span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const double span_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const double span_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const double crank_middle_vx = -crank_omega*span_crank_middle_y;
    const double crank_middle_vy = crank_omega*span_crank_middle_x;
    const double span_rod_middle_x = cos_theta_rod*p->rod_middle_span_x;
    const double span_rod_middle_y = p->rod_middle_span_x*sin_theta_rod;
    const double rod_middle_x = span_crank_head_x + span_rod_middle_x;
    const double rod_middle_vx = crank_head_vx - rod_omega*span_rod_middle_y;
    const double rod_middle_y = span_crank_head_y + span_rod_middle_y;
    const double rod_middle_vy = crank_head_vy + rod_omega*span_rod_middle_x;
    const double coil_span_x = rod_middle_x - span_crank_middle_x;
    const double coil_span_y = rod_middle_y - span_crank_middle_y;
    const double coil_span_rate_x = -crank_middle_vx + rod_middle_vx;
    const double coil_span_rate_y = -crank_middle_vy + rod_middle_vy;
    const double coil_length = sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const double coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const double coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);
    const double coil_pull = coil_force/coil_length;
    const double span_rod_tip_x = cos_theta_rod*p->rod_tip_span_x;
    const double span_rod_tip_y = p->rod_tip_span_x*sin_theta_rod;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* coordinates */
    const double coil_span_x_by_crank_theta = -span_crank_head_y + span_crank_middle_y;
    const double coil_span_y_by_crank_theta = span_crank_head_x - span_crank_middle_x;
    const double inverse_sum = 1.0/(coil_length + 1e-150);
    const double coil_length_by_crank_theta = coil_span_x*coil_span_x_by_crank_theta*inverse_sum
        + coil_span_y*coil_span_y_by_crank_theta*inverse_sum;
    const double coil_length_by_rod_theta = -coil_span_x*inverse_sum*span_rod_middle_y
        + coil_span_y*inverse_sum*span_rod_middle_x;
    const double crank_middle_vx_by_crank_theta = -crank_omega*span_crank_middle_x;
    const double rod_middle_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const double rod_middle_vx_by_rod_theta = -rod_omega*span_rod_middle_x;
    const double coil_span_rate_x_by_crank_theta = -crank_middle_vx_by_crank_theta + rod_middle_vx_by_crank_theta;
    const double coil_span_rate_x_by_crank_omega = -span_crank_head_y + span_crank_middle_y;
    const double crank_middle_vy_by_crank_theta = -crank_omega*span_crank_middle_y;
    const double rod_middle_vy_by_crank_theta = -crank_omega*span_crank_head_y;
    const double rod_middle_vy_by_rod_theta = -rod_omega*span_rod_middle_y;
    const double coil_span_rate_y_by_crank_theta = -crank_middle_vy_by_crank_theta + rod_middle_vy_by_crank_theta;
    const double coil_span_rate_y_by_crank_omega = span_crank_head_x - span_crank_middle_x;
    const double inverse_coil_length = 1.0/coil_length;
    const double coil_length_rate_by_crank_theta = -coil_length_by_crank_theta*(inverse_coil_length
        * inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)
        + coil_span_rate_x*coil_span_x_by_crank_theta*inverse_coil_length
        + coil_span_rate_x_by_crank_theta*coil_span_x*inverse_coil_length
        + coil_span_rate_y*coil_span_y_by_crank_theta*inverse_coil_length
        + coil_span_rate_y_by_crank_theta*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_theta = -coil_length_by_rod_theta*(inverse_coil_length
        * inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)
        - coil_span_rate_x*inverse_coil_length*span_rod_middle_y
        + coil_span_rate_y*inverse_coil_length*span_rod_middle_x
        + coil_span_x*inverse_coil_length*rod_middle_vx_by_rod_theta
        + coil_span_y*inverse_coil_length*rod_middle_vy_by_rod_theta;
    const double coil_length_rate_by_crank_omega = coil_span_rate_x_by_crank_omega*coil_span_x*inverse_coil_length
        + coil_span_rate_y_by_crank_omega*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_omega = -coil_span_x*inverse_coil_length*span_rod_middle_y
        + coil_span_y*inverse_coil_length*span_rod_middle_x;
    const double coil_force_by_crank_theta = p->coil_damping*coil_length_rate_by_crank_theta
        + coil_length_by_crank_theta*p->coil_stiffness;
    const double coil_force_by_rod_theta = p->coil_damping*coil_length_rate_by_rod_theta
        + coil_length_by_rod_theta*p->coil_stiffness;
    const double coil_force_by_crank_omega = p->coil_damping*coil_length_rate_by_crank_omega;
    const double coil_force_by_rod_omega = p->coil_damping*coil_length_rate_by_rod_omega;
    const double coil_pull_by_crank_theta = -coil_force*coil_length_by_crank_theta*(inverse_coil_length
        * inverse_coil_length) + coil_force_by_crank_theta*inverse_coil_length;
    const double coil_pull_by_rod_theta = -coil_force*coil_length_by_rod_theta*(inverse_coil_length
        * inverse_coil_length) + coil_force_by_rod_theta*inverse_coil_length;
    const double coil_pull_by_crank_omega = coil_force_by_crank_omega*inverse_coil_length;
    const double coil_pull_by_rod_omega = coil_force_by_rod_omega*inverse_coil_length;

    /* powers */
    const double rod_tip_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const double rod_tip_vx_by_rod_theta = -rod_omega*span_rod_tip_x;

    /* results */
    lin->value[0] = dot_crank_rod;
    lin->value[1] = span_crank_head_x;
    lin->value[2] = span_rod_com_x;
    lin->value[3] = -a_crank_theta*span_crank_head_y - (crank_omega * crank_omega)*span_crank_head_x
        - crank_omega*span_crank_head_y*p->two_alpha;
    lin->value[4] = -a_rod_theta*span_rod_com_y - (rod_omega * rod_omega)*span_rod_com_x
        - rod_omega*span_rod_com_y*p->two_alpha;
    lin->value[5] = a_rod_theta*cross_crank_rod + coil_pull*coil_span_x*span_crank_middle_x
        + coil_pull*coil_span_y*span_crank_middle_y + coil_pull_by_crank_theta*(-coil_span_x*span_crank_head_y
        + coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x)
        + coil_span_x_by_crank_theta*(-coil_pull*span_crank_head_y + coil_pull*span_crank_middle_y)
        + coil_span_y_by_crank_theta*(coil_pull*span_crank_head_x - coil_pull*span_crank_middle_x)
        + dot_crank_rod*(rod_omega * rod_omega) + span_crank_head_x*(-coil_pull*coil_span_x + p->push_value_x)
        - span_crank_head_y*(coil_pull*coil_span_y + held_lambda_slider_offset);
    lin->value[6] = -a_rod_theta*cross_crank_rod + coil_pull_by_rod_theta*(-coil_span_x*span_crank_head_y
        + coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x)
        - dot_crank_rod*(rod_omega * rod_omega) + span_rod_middle_x*(coil_pull*span_crank_head_x
        - coil_pull*span_crank_middle_x) - span_rod_middle_y*(-coil_pull*span_crank_head_y
        + coil_pull*span_crank_middle_y);
    lin->value[7] = a_crank_theta*cross_crank_rod - coil_pull*coil_span_x_by_crank_theta*span_rod_middle_y
        + coil_pull*coil_span_y_by_crank_theta*span_rod_middle_x
        + coil_pull_by_crank_theta*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x)
        - (crank_omega * crank_omega)*dot_crank_rod;
    lin->value[8] = -a_crank_theta*cross_crank_rod - coil_pull*coil_span_x*span_rod_middle_x
        - coil_pull*coil_span_y*span_rod_middle_y + coil_pull*(span_rod_middle_x * span_rod_middle_x)
        + coil_pull*(span_rod_middle_y * span_rod_middle_y) + coil_pull_by_rod_theta*(-coil_span_x*span_rod_middle_y
        + coil_span_y*span_rod_middle_x) + (crank_omega * crank_omega)*dot_crank_rod
        - held_lambda_slider_offset*span_rod_com_y + p->push_value_x*span_rod_tip_x;
    lin->value[9] = -2.0*crank_omega*span_crank_head_y;
    lin->value[10] = -2.0*rod_omega*span_rod_com_y;
    lin->value[11] = coil_pull_by_crank_omega*(-coil_span_x*span_crank_head_y + coil_span_x*span_crank_middle_y
        + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x);
    lin->value[12] = coil_pull_by_rod_omega*(-coil_span_x*span_crank_head_y + coil_span_x*span_crank_middle_y
        + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x) - 2.0*cross_crank_rod*rod_omega;
    lin->value[13] = coil_pull_by_crank_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x)
        + 2.0*crank_omega*cross_crank_rod;
    lin->value[14] = coil_pull_by_rod_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x);
    lin->value[15] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_crank_theta
        + p->push_value_x*rod_tip_vx_by_crank_theta;
    lin->value[16] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_rod_theta
        + p->push_value_x*rod_tip_vx_by_rod_theta;
    lin->value[17] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_crank_omega
        - p->push_value_x*span_crank_head_y;
    lin->value[18] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_rod_omega
        - p->push_value_x*span_rod_tip_y;
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
    const double mass_crank_theta_rod_theta = lin->value[0];
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double phi_slider_offset_rod_theta = lin->value[2];
    const double by_q_slider_offset_crank_theta = lin->value[3];
    const double by_q_slider_offset_rod_theta = lin->value[4];
    const double by_q_crank_theta_crank_theta = lin->value[5];
    const double by_q_crank_theta_rod_theta = lin->value[6];
    const double by_q_rod_theta_crank_theta = lin->value[7];
    const double by_q_rod_theta_rod_theta = lin->value[8];
    const double by_v_slider_offset_crank_theta = lin->value[9];
    const double by_v_slider_offset_rod_theta = lin->value[10];
    const double by_v_crank_theta_crank_theta = lin->value[11];
    const double by_v_crank_theta_rod_theta = lin->value[12];
    const double by_v_rod_theta_crank_theta = lin->value[13];
    const double by_v_rod_theta_rod_theta = lin->value[14];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_crank_theta__crank_theta = eta*(by_q_crank_theta_crank_theta*eta + by_v_crank_theta_crank_theta)
        + p->mass_crank_crank;
    const double n_crank_theta__rod_theta = eta*(by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta)
        + mass_crank_theta_rod_theta;
    const double n_rod_theta__crank_theta = eta*(by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta)
        + mass_crank_theta_rod_theta;
    const double n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta)
        + p->mass_rod_rod;
    const double n_slider_offset__crank_theta = eta_row*(by_q_slider_offset_crank_theta*eta
        + by_v_slider_offset_crank_theta) + phi_slider_offset_crank_theta;
    const double n_slider_offset__rod_theta = eta_row*(by_q_slider_offset_rod_theta*eta + by_v_slider_offset_rod_theta)
        + phi_slider_offset_rod_theta;

    /* L U */
    const double scale_crank_theta = n_crank_theta__crank_theta;
    if (!(fabs(scale_crank_theta) > SINGULAR * fabs(n_crank_theta__crank_theta)))
        return 1;
    const double inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[0] = inverse_pivot_crank_theta;
    const double l_rod_theta__crank_theta = inverse_pivot_crank_theta*n_rod_theta__crank_theta;
    lin->lu[1] = l_rod_theta__crank_theta;
    lin->lu[2] = n_crank_theta__rod_theta;
    const double l_slider_offset__crank_theta = inverse_pivot_crank_theta*n_slider_offset__crank_theta;
    lin->lu[3] = l_slider_offset__crank_theta;
    const double scale_rod_theta = -l_rod_theta__crank_theta*n_crank_theta__rod_theta + n_rod_theta__rod_theta;
    if (!(fabs(scale_rod_theta) > SINGULAR * fabs(n_rod_theta__rod_theta)))
        return 2;
    const double inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[4] = inverse_pivot_rod_theta;
    const double l_slider_offset__rod_theta = inverse_pivot_rod_theta
        *(-l_slider_offset__crank_theta*n_crank_theta__rod_theta + n_slider_offset__rod_theta);
    lin->lu[5] = l_slider_offset__rod_theta;
    const double u_rod_theta__slider_offset = -l_rod_theta__crank_theta*phi_slider_offset_crank_theta
        + phi_slider_offset_rod_theta;
    lin->lu[6] = u_rod_theta__slider_offset;
    const double scale_slider_offset = -l_slider_offset__crank_theta*phi_slider_offset_crank_theta
        - l_slider_offset__rod_theta*u_rod_theta__slider_offset;
    if (!(scale_slider_offset != 0.0 && isfinite(scale_slider_offset)))
        return 3;
    const double inverse_pivot_slider_offset = 1.0/scale_slider_offset;
    lin->lu[7] = inverse_pivot_slider_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double inverse_pivot_crank_theta = lin->lu[0];
    const double l_rod_theta__crank_theta = lin->lu[1];
    const double n_crank_theta__rod_theta = lin->lu[2];
    const double l_slider_offset__crank_theta = lin->lu[3];
    const double inverse_pivot_rod_theta = lin->lu[4];
    const double l_slider_offset__rod_theta = lin->lu[5];
    const double u_rod_theta__slider_offset = lin->lu[6];
    const double inverse_pivot_slider_offset = lin->lu[7];

    /* forward */
    const double b_crank_theta = x[0];
    const double b_rod_theta = -b_crank_theta*l_rod_theta__crank_theta + x[1];
    const double b_slider_offset = -b_crank_theta*l_slider_offset__crank_theta - b_rod_theta*l_slider_offset__rod_theta
        + x[2];

    /* backward */
    const double x_slider_offset = b_slider_offset*inverse_pivot_slider_offset;
    x[2] = x_slider_offset;
    const double x_rod_theta = inverse_pivot_rod_theta*(b_rod_theta - u_rod_theta__slider_offset*x_slider_offset);
    x[1] = x_rod_theta;
    const double x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta - n_crank_theta__rod_theta*x_rod_theta
        - phi_slider_offset_crank_theta*x_slider_offset);
    x[0] = x_crank_theta;
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
    const double mass_crank_theta_rod_theta = lin->value[0];
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double phi_slider_offset_rod_theta = lin->value[2];
    const double by_q_slider_offset_crank_theta = lin->value[3];
    const double by_q_slider_offset_rod_theta = lin->value[4];
    const double by_q_crank_theta_crank_theta = lin->value[5];
    const double by_q_crank_theta_rod_theta = lin->value[6];
    const double by_q_rod_theta_crank_theta = lin->value[7];
    const double by_q_rod_theta_rod_theta = lin->value[8];
    const double power_q_1_crank_theta = lin->value[15];
    const double power_q_1_rod_theta = lin->value[16];
    const double power_v_1_crank_theta = lin->value[17];
    const double power_v_1_rod_theta = lin->value[18];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[3];
    const double shifted_crank_theta = -p->beta_squared*eta*r[0] + r[2];
    const double shifted_rod_theta = -p->beta_squared*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta*eta*r[0] - by_q_crank_theta_rod_theta*eta*r[1] + p->mass_crank_crank*r[2]
        + mass_crank_theta_rod_theta*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta*eta*r[0] - by_q_rod_theta_rod_theta*eta*r[1]
        + mass_crank_theta_rod_theta*r[2] + p->mass_rod_rod*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta*eta*r[0] - by_q_slider_offset_rod_theta*eta*r[1]
        + phi_slider_offset_crank_theta*shifted_crank_theta + phi_slider_offset_rod_theta*shifted_rod_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta*u[0] + power_q_1_rod_theta*u[1] + power_v_1_crank_theta*u[2]
        + power_v_1_rod_theta*u[3] + r[5]);
    u[6] = eta*r[6];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {2, 0, 1, 1}, {2, 1, 2, 1}
};
static const LinearEntry residual_entries[] = {
    {2, 0, 3, 1}, {2, 1, 4, 1}, {0, 0, 5, 1}, {0, 1, 6, 1}, {1, 0, 7, 1}, {1, 1, 8, 1}, {2, 2, 9, 1},
    {2, 3, 10, 1}, {0, 2, 11, 1}, {0, 3, 12, 1}, {1, 2, 13, 1}, {1, 3, 14, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 0, 15, 1}, {1, 1, 16, 1}, {1, 2, 17, 1}, {1, 3, 18, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 2,
    N_RESIDUAL = 12,
    N_RESIDUAL_T = 0,
    N_POWER = 4,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 3,
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
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double span_crank_head_x = cos_theta_crank*p->crank_length;
    const double span_crank_head_y = p->crank_length*sin_theta_crank;
    const double span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const double span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;

    /* Phi and Phi_dot */
    const double phi_slider_offset = span_crank_head_y + span_rod_com_y;
    const double phi_dot_slider_offset = crank_omega*span_crank_head_x + rod_omega*span_rod_com_x;

    /* L D L^T of the KKT matrix */
    const double l_rod_theta__crank_theta = dot_crank_rod*p->inverse_mass_crank_crank;
    const double l_slider_offset__crank_theta = p->inverse_mass_crank_crank*span_crank_head_x;
    const double inverse_pivot_rod_theta = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta + p->mass_rod_rod);
    const double w_slider_offset__rod_theta = -dot_crank_rod*l_slider_offset__crank_theta + span_rod_com_x;
    const double l_slider_offset__rod_theta = inverse_pivot_rod_theta*w_slider_offset__rod_theta;
    const double scale_slider_offset = l_slider_offset__crank_theta*span_crank_head_x
        + l_slider_offset__rod_theta*w_slider_offset__rod_theta;
    if (!(scale_slider_offset > 0.0 && scale_slider_offset < INFINITY))
        return 1;
    const double inverse_pivot_slider_offset = 1.0/scale_slider_offset;

    /* backward substitution */
    const double dq_lambda_slider_offset = -inverse_pivot_slider_offset*phi_slider_offset;
    const double dq_acceleration_rod_theta = -dq_lambda_slider_offset*l_slider_offset__rod_theta;
    const double dq_acceleration_crank_theta = -dq_acceleration_rod_theta*l_rod_theta__crank_theta
        - dq_lambda_slider_offset*l_slider_offset__crank_theta;

    /* backward substitution */
    const double dv_lambda_slider_offset = -inverse_pivot_slider_offset*phi_dot_slider_offset;
    const double dv_acceleration_rod_theta = -dv_lambda_slider_offset*l_slider_offset__rod_theta;
    const double dv_acceleration_crank_theta = -dv_acceleration_rod_theta*l_rod_theta__crank_theta
        - dv_lambda_slider_offset*l_slider_offset__crank_theta;

    /* results */
    dq[0] = dq_acceleration_crank_theta;
    dv[0] = dv_acceleration_crank_theta;
    dq[1] = dq_acceleration_rod_theta;
    dv[1] = dv_acceleration_rod_theta;
    *worst = max_of(0.0, fabs(phi_slider_offset));
    return 0;
}
