/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[19]; /* what linearize() found */
    double lu[8];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double crank_theta = q[0];
    const double crank_omega = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];
    const double a_crank_theta = a[0];
    const double a_rod_theta = a[1];
    const double held_lambda_slider_offset = aside->lambda[0];

    /* parameters */
    const double crank_length = p->crank_length;
    const double crank_points_middle_x = p->crank_points_middle_x;
    const double coil_stiffness = p->coil_stiffness;
    const double coil_free_length = p->coil_free_length;
    const double coil_damping = p->coil_damping;
    const double push_value_x = p->push_value_x;
    const double two_alpha = p->two_alpha;
    const double rod_com_span_x = p->rod_com_span_x;
    const double rod_middle_span_x = p->rod_middle_span_x;
    const double rod_tip_span_x = p->rod_tip_span_x;
    const double inertia_crank_rod = p->inertia_crank_rod;

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double span_crank_head_x = cos_theta_crank*crank_length;
    const double span_crank_head_y = crank_length*sin_theta_crank;
    const double crank_head_vx = -crank_omega*span_crank_head_y;
    const double crank_head_vy = crank_omega*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*rod_com_span_x;
    const double span_rod_com_y = rod_com_span_x*sin_theta_rod;
    const double span_crank_middle_x = cos_theta_crank*crank_points_middle_x;
    const double span_crank_middle_y = crank_points_middle_x*sin_theta_crank;
    const double crank_middle_vx = -crank_omega*span_crank_middle_y;
    const double crank_middle_vy = crank_omega*span_crank_middle_x;
    const double span_rod_middle_x = cos_theta_rod*rod_middle_span_x;
    const double span_rod_middle_y = rod_middle_span_x*sin_theta_rod;
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
    const double coil_force = coil_damping*coil_length_rate + coil_stiffness*(-coil_free_length +
        coil_length);
    const double coil_pull = coil_force/coil_length;
    const double span_rod_tip_x = cos_theta_rod*rod_tip_span_x;
    const double span_rod_tip_y = rod_tip_span_x*sin_theta_rod;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*inertia_crank_rod;
    const double cross_crank_rod = inertia_crank_rod*sin_rod_less_crank;

    /* coordinates */
    const double coil_span_x_by_crank_theta = -span_crank_head_y + span_crank_middle_y;
    const double coil_span_y_by_crank_theta = span_crank_head_x - span_crank_middle_x;
    const double inverse_sum = 1.0/(coil_length + 1e-150);
    const double coil_length_by_crank_theta = coil_span_x*coil_span_x_by_crank_theta*inverse_sum +
        coil_span_y*coil_span_y_by_crank_theta*inverse_sum;
    const double coil_length_by_rod_theta = -coil_span_x*inverse_sum*span_rod_middle_y +
        coil_span_y*inverse_sum*span_rod_middle_x;
    const double crank_middle_vx_by_crank_theta = -crank_omega*span_crank_middle_x;
    const double rod_middle_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const double rod_middle_vx_by_rod_theta = -rod_omega*span_rod_middle_x;
    const double coil_span_rate_x_by_crank_theta = -crank_middle_vx_by_crank_theta +
        rod_middle_vx_by_crank_theta;
    const double coil_span_rate_x_by_crank_omega = -span_crank_head_y + span_crank_middle_y;
    const double crank_middle_vy_by_crank_theta = -crank_omega*span_crank_middle_y;
    const double rod_middle_vy_by_crank_theta = -crank_omega*span_crank_head_y;
    const double rod_middle_vy_by_rod_theta = -rod_omega*span_rod_middle_y;
    const double coil_span_rate_y_by_crank_theta = -crank_middle_vy_by_crank_theta +
        rod_middle_vy_by_crank_theta;
    const double coil_span_rate_y_by_crank_omega = span_crank_head_x - span_crank_middle_x;
    const double inverse_coil_length = 1.0/coil_length;
    const double coil_length_rate_by_crank_theta = -coil_length_by_crank_theta*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) +
        coil_span_rate_x*coil_span_x_by_crank_theta*inverse_coil_length +
        coil_span_rate_x_by_crank_theta*coil_span_x*inverse_coil_length +
        coil_span_rate_y*coil_span_y_by_crank_theta*inverse_coil_length +
        coil_span_rate_y_by_crank_theta*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_theta = -coil_length_by_rod_theta*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) -
        coil_span_rate_x*inverse_coil_length*span_rod_middle_y +
        coil_span_rate_y*inverse_coil_length*span_rod_middle_x +
        coil_span_x*inverse_coil_length*rod_middle_vx_by_rod_theta +
        coil_span_y*inverse_coil_length*rod_middle_vy_by_rod_theta;
    const double coil_length_rate_by_crank_omega =
        coil_span_rate_x_by_crank_omega*coil_span_x*inverse_coil_length +
        coil_span_rate_y_by_crank_omega*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_omega = -coil_span_x*inverse_coil_length*span_rod_middle_y +
        coil_span_y*inverse_coil_length*span_rod_middle_x;
    const double coil_force_by_crank_theta = coil_damping*coil_length_rate_by_crank_theta +
        coil_length_by_crank_theta*coil_stiffness;
    const double coil_force_by_rod_theta = coil_damping*coil_length_rate_by_rod_theta +
        coil_length_by_rod_theta*coil_stiffness;
    const double coil_force_by_crank_omega = coil_damping*coil_length_rate_by_crank_omega;
    const double coil_force_by_rod_omega = coil_damping*coil_length_rate_by_rod_omega;
    const double coil_pull_by_crank_theta = -coil_force*coil_length_by_crank_theta*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_crank_theta*inverse_coil_length;
    const double coil_pull_by_rod_theta = -coil_force*coil_length_by_rod_theta*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_rod_theta*inverse_coil_length;
    const double coil_pull_by_crank_omega = coil_force_by_crank_omega*inverse_coil_length;
    const double coil_pull_by_rod_omega = coil_force_by_rod_omega*inverse_coil_length;

    /* powers */
    const double rod_tip_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const double rod_tip_vx_by_rod_theta = -rod_omega*span_rod_tip_x;

    /* results */
    lin->value[0] = dot_crank_rod;
    lin->value[1] = span_crank_head_x;
    lin->value[2] = span_rod_com_x;
    lin->value[3] = -a_crank_theta*span_crank_head_y - (crank_omega * crank_omega)*span_crank_head_x -
        crank_omega*span_crank_head_y*two_alpha;
    lin->value[4] = -a_rod_theta*span_rod_com_y - (rod_omega * rod_omega)*span_rod_com_x -
        rod_omega*span_rod_com_y*two_alpha;
    lin->value[5] = a_rod_theta*cross_crank_rod + coil_pull*coil_span_x*span_crank_middle_x +
        coil_pull*coil_span_y*span_crank_middle_y + coil_pull_by_crank_theta*(-coil_span_x*span_crank_head_y +
        coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x) +
        coil_span_x_by_crank_theta*(-coil_pull*span_crank_head_y + coil_pull*span_crank_middle_y) +
        coil_span_y_by_crank_theta*(coil_pull*span_crank_head_x - coil_pull*span_crank_middle_x) +
        dot_crank_rod*(rod_omega * rod_omega) + span_crank_head_x*(-coil_pull*coil_span_x + push_value_x) -
        span_crank_head_y*(coil_pull*coil_span_y + held_lambda_slider_offset);
    lin->value[6] = -a_rod_theta*cross_crank_rod + coil_pull_by_rod_theta*(-coil_span_x*span_crank_head_y +
        coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x) -
        dot_crank_rod*(rod_omega * rod_omega) + span_rod_middle_x*(coil_pull*span_crank_head_x -
        coil_pull*span_crank_middle_x) - span_rod_middle_y*(-coil_pull*span_crank_head_y +
        coil_pull*span_crank_middle_y);
    lin->value[7] = a_crank_theta*cross_crank_rod - coil_pull*coil_span_x_by_crank_theta*span_rod_middle_y +
        coil_pull*coil_span_y_by_crank_theta*span_rod_middle_x +
        coil_pull_by_crank_theta*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x) -
        (crank_omega * crank_omega)*dot_crank_rod;
    lin->value[8] = -a_crank_theta*cross_crank_rod - coil_pull*coil_span_x*span_rod_middle_x -
        coil_pull*coil_span_y*span_rod_middle_y + coil_pull*(span_rod_middle_x * span_rod_middle_x) +
        coil_pull*(span_rod_middle_y * span_rod_middle_y) +
        coil_pull_by_rod_theta*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x) + (crank_omega
        * crank_omega)*dot_crank_rod - held_lambda_slider_offset*span_rod_com_y + push_value_x*span_rod_tip_x;
    lin->value[9] = -2.0*crank_omega*span_crank_head_y;
    lin->value[10] = -2.0*rod_omega*span_rod_com_y;
    lin->value[11] = coil_pull_by_crank_omega*(-coil_span_x*span_crank_head_y +
        coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x);
    lin->value[12] = coil_pull_by_rod_omega*(-coil_span_x*span_crank_head_y + coil_span_x*span_crank_middle_y
        + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x) - 2.0*cross_crank_rod*rod_omega;
    lin->value[13] = coil_pull_by_crank_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x)
        + 2.0*crank_omega*cross_crank_rod;
    lin->value[14] = coil_pull_by_rod_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x);
    lin->value[15] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_theta +
        push_value_x*rod_tip_vx_by_crank_theta;
    lin->value[16] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_theta +
        push_value_x*rod_tip_vx_by_rod_theta;
    lin->value[17] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_omega -
        push_value_x*span_crank_head_y;
    lin->value[18] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_omega -
        push_value_x*span_rod_tip_y;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static int newton_factor(double eta, Linear *lin)
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

    /* parameters */
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double mass_crank_crank = p->mass_crank_crank;
    const double mass_rod_rod = p->mass_rod_rod;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_crank_theta__crank_theta = eta*(by_q_crank_theta_crank_theta*eta +
        by_v_crank_theta_crank_theta) + mass_crank_crank;
    const double n_crank_theta__rod_theta = eta*(by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta)
        + mass_crank_theta_rod_theta;
    const double n_rod_theta__crank_theta = eta*(by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta)
        + mass_crank_theta_rod_theta;
    const double n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta) +
        mass_rod_rod;
    const double n_slider_offset__crank_theta = eta_row*(by_q_slider_offset_crank_theta*eta +
        by_v_slider_offset_crank_theta) + phi_slider_offset_crank_theta;
    const double n_slider_offset__rod_theta = eta_row*(by_q_slider_offset_rod_theta*eta +
        by_v_slider_offset_rod_theta) + phi_slider_offset_rod_theta;

    /* L U */
    const double scale_crank_theta = n_crank_theta__crank_theta;
    if (!(fabs(scale_crank_theta) > 1e-13 * fabs(n_crank_theta__crank_theta))) return 1;
    const double inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[0] = inverse_pivot_crank_theta;
    const double l_rod_theta__crank_theta_3 = inverse_pivot_crank_theta*n_rod_theta__crank_theta;
    lin->lu[1] = l_rod_theta__crank_theta_3;
    lin->lu[2] = n_crank_theta__rod_theta;
    const double l_slider_offset__crank_theta_3 = inverse_pivot_crank_theta*n_slider_offset__crank_theta;
    lin->lu[3] = l_slider_offset__crank_theta_3;
    const double scale_rod_theta = -l_rod_theta__crank_theta_3*n_crank_theta__rod_theta +
        n_rod_theta__rod_theta;
    if (!(fabs(scale_rod_theta) > 1e-13 * fabs(n_rod_theta__rod_theta))) return 2;
    const double inverse_pivot_rod_theta_3 = 1.0/scale_rod_theta;
    lin->lu[4] = inverse_pivot_rod_theta_3;
    const double l_slider_offset__rod_theta_3 =
        inverse_pivot_rod_theta_3*(-l_slider_offset__crank_theta_3*n_crank_theta__rod_theta +
        n_slider_offset__rod_theta);
    lin->lu[5] = l_slider_offset__rod_theta_3;
    const double u_rod_theta__slider_offset = -l_rod_theta__crank_theta_3*phi_slider_offset_crank_theta +
        phi_slider_offset_rod_theta;
    lin->lu[6] = u_rod_theta__slider_offset;
    const double scale_slider_offset_3 = -l_slider_offset__crank_theta_3*phi_slider_offset_crank_theta -
        l_slider_offset__rod_theta_3*u_rod_theta__slider_offset;
    if (!(fabs(scale_slider_offset_3) > 1e-13 * fabs(scale_slider_offset_3))) return 3;
    const double inverse_pivot_slider_offset_3 = 1.0/scale_slider_offset_3;
    lin->lu[7] = inverse_pivot_slider_offset_3;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slider_offset_crank_theta = lin->value[1];
    const double inverse_pivot_crank_theta = lin->lu[0];
    const double l_rod_theta__crank_theta_3 = lin->lu[1];
    const double n_crank_theta__rod_theta = lin->lu[2];
    const double l_slider_offset__crank_theta_3 = lin->lu[3];
    const double inverse_pivot_rod_theta_3 = lin->lu[4];
    const double l_slider_offset__rod_theta_3 = lin->lu[5];
    const double u_rod_theta__slider_offset = lin->lu[6];
    const double inverse_pivot_slider_offset_3 = lin->lu[7];

    /* forward */
    const double b_crank_theta = x[0];
    const double b_rod_theta = -b_crank_theta*l_rod_theta__crank_theta_3 + x[1];
    const double b_slider_offset = -b_crank_theta*l_slider_offset__crank_theta_3 -
        b_rod_theta*l_slider_offset__rod_theta_3 + x[2];

    /* backward */
    const double x_slider_offset = b_slider_offset*inverse_pivot_slider_offset_3;
    x[2] = x_slider_offset;
    const double x_rod_theta = inverse_pivot_rod_theta_3*(b_rod_theta -
        u_rod_theta__slider_offset*x_slider_offset);
    x[1] = x_rod_theta;
    const double x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta -
        n_crank_theta__rod_theta*x_rod_theta - phi_slider_offset_crank_theta*x_slider_offset);
    x[0] = x_crank_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
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

    /* parameters */
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double mass_crank_crank = p->mass_crank_crank;
    const double mass_rod_rod = p->mass_rod_rod;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[3];
    const double shifted_crank_theta = -beta_squared*eta*r[0] + r[2];
    const double shifted_rod_theta = -beta_squared*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta*eta*r[0] - by_q_crank_theta_rod_theta*eta*r[1] +
        mass_crank_crank*r[2] + mass_crank_theta_rod_theta*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta*eta*r[0] - by_q_rod_theta_rod_theta*eta*r[1] +
        mass_crank_theta_rod_theta*r[2] + mass_rod_rod*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta*eta*r[0] - by_q_slider_offset_rod_theta*eta*r[1] +
        phi_slider_offset_crank_theta*shifted_crank_theta + phi_slider_offset_rod_theta*shifted_rod_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta*u[0] + power_q_1_rod_theta*u[1] + power_v_1_crank_theta*u[2] +
        power_v_1_rod_theta*u[3] + r[5]);
    u[6] = eta*r[6];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {2, 0, 1, 1}, {2, 1, 2, 1}
};
static const LinearEntry residual_entries[] = {
    {2, 0, 3, 1}, {2, 1, 4, 1}, {0, 0, 5, 1}, {0, 1, 6, 1}, {1, 0, 7, 1}, {1, 1, 8, 1}, {2, 2, 9, 1}, {2, 3,
    10, 1}, {0, 2, 11, 1}, {0, 3, 12, 1}, {1, 2, 13, 1}, {1, 3, 14, 1}
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
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_X - 1) or of R1_t, R2_t (2 N_X); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double stick, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_X; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_X; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_X && (column >= N_X || at->row < N_X + N_LOOPS)) {
            x[at->row] -= (at->row < N_X + N_LOOPS ? gain[column / N_X] : stick) * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_X; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_X; k++) {
        out[k * stride] = column == N_X + k ? 1.0 : 0.0;
        out[(N_X + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_X + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_X + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_X + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_X; i++)
        out[(2 * N_X + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now = {0};
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = motion(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_X, &now, p, dy + N_X, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_tree_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {0.0, 0.0};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_X; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, 0.0, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_X ? J + column : f_t, column < 2 * N_X ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_X + w] = 0.0;
    return 0;
}

/* (1/eta - J) u = r + s f_t at a state. */
int gudgeon_newton(double t, const double *y, const double *memory, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear lin;
    const int status = linearized(t, y, memory, (const Parameters *)p, eta, &lin);
    if (status)
        return status;
    newton_solve(&lin, eta, s, r, u);
    return 0;
}
