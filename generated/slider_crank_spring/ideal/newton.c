/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double crank_theta_ = q[0];
    const double crank_omega_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];
    const double a_crank_theta_ = a[0];
    const double a_rod_theta_ = a[1];
    const double held_lambda_slider_offset_ = aside->lambda[0];

    /* directions, arms, drives */
    const double cos_theta_crank_ = cos(crank_theta_);
    const double sin_theta_crank_ = sin(crank_theta_);
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double crank_head_vx_ = -crank_omega_*span_crank_head_y_;
    const double crank_head_vy_ = crank_omega_*span_crank_head_x_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const double span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const double span_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const double span_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const double crank_middle_vx_ = -crank_omega_*span_crank_middle_y_;
    const double crank_middle_vy_ = crank_omega_*span_crank_middle_x_;
    const double span_rod_middle_x_ = cos_theta_rod_*p->rod_middle_span_x_;
    const double span_rod_middle_y_ = p->rod_middle_span_x_*sin_theta_rod_;
    const double rod_middle_x_ = span_crank_head_x_ + span_rod_middle_x_;
    const double rod_middle_vx_ = crank_head_vx_ - rod_omega_*span_rod_middle_y_;
    const double rod_middle_y_ = span_crank_head_y_ + span_rod_middle_y_;
    const double rod_middle_vy_ = crank_head_vy_ + rod_omega_*span_rod_middle_x_;
    const double coil_span_x_ = rod_middle_x_ - span_crank_middle_x_;
    const double coil_span_y_ = rod_middle_y_ - span_crank_middle_y_;
    const double coil_span_rate_x_ = -crank_middle_vx_ + rod_middle_vx_;
    const double coil_span_rate_y_ = -crank_middle_vy_ + rod_middle_vy_;
    const double coil_length_ = sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const double coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const double coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);
    const double coil_pull_ = coil_force_/coil_length_;
    const double span_rod_tip_x_ = cos_theta_rod_*p->rod_tip_span_x_;
    const double span_rod_tip_y_ = p->rod_tip_span_x_*sin_theta_rod_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* coordinates */
    const double coil_span_x_by_crank_theta_ = -span_crank_head_y_ + span_crank_middle_y_;
    const double coil_span_y_by_crank_theta_ = span_crank_head_x_ - span_crank_middle_x_;
    const double inverse_sum_ = 1.0/(coil_length_ + 1e-150);
    const double coil_length_by_crank_theta_ = coil_span_x_*coil_span_x_by_crank_theta_*inverse_sum_
        + coil_span_y_*coil_span_y_by_crank_theta_*inverse_sum_;
    const double coil_length_by_rod_theta_ = -coil_span_x_*inverse_sum_*span_rod_middle_y_
        + coil_span_y_*inverse_sum_*span_rod_middle_x_;
    const double crank_middle_vx_by_crank_theta_ = -crank_omega_*span_crank_middle_x_;
    const double rod_middle_vx_by_crank_theta_ = -crank_omega_*span_crank_head_x_;
    const double rod_middle_vx_by_rod_theta_ = -rod_omega_*span_rod_middle_x_;
    const double coil_span_rate_x_by_crank_theta_ = -crank_middle_vx_by_crank_theta_ + rod_middle_vx_by_crank_theta_;
    const double coil_span_rate_x_by_crank_omega_ = -span_crank_head_y_ + span_crank_middle_y_;
    const double crank_middle_vy_by_crank_theta_ = -crank_omega_*span_crank_middle_y_;
    const double rod_middle_vy_by_crank_theta_ = -crank_omega_*span_crank_head_y_;
    const double rod_middle_vy_by_rod_theta_ = -rod_omega_*span_rod_middle_y_;
    const double coil_span_rate_y_by_crank_theta_ = -crank_middle_vy_by_crank_theta_ + rod_middle_vy_by_crank_theta_;
    const double coil_span_rate_y_by_crank_omega_ = span_crank_head_x_ - span_crank_middle_x_;
    const double inverse_coil_length_ = 1.0/coil_length_;
    const double coil_length_rate_by_crank_theta_ = -coil_length_by_crank_theta_*(inverse_coil_length_
        * inverse_coil_length_)*(coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)
        + coil_span_rate_x_*coil_span_x_by_crank_theta_*inverse_coil_length_
        + coil_span_rate_x_by_crank_theta_*coil_span_x_*inverse_coil_length_
        + coil_span_rate_y_*coil_span_y_by_crank_theta_*inverse_coil_length_
        + coil_span_rate_y_by_crank_theta_*coil_span_y_*inverse_coil_length_;
    const double coil_length_rate_by_rod_theta_ = -coil_length_by_rod_theta_*(inverse_coil_length_
        * inverse_coil_length_)*(coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)
        - coil_span_rate_x_*inverse_coil_length_*span_rod_middle_y_
        + coil_span_rate_y_*inverse_coil_length_*span_rod_middle_x_
        + coil_span_x_*inverse_coil_length_*rod_middle_vx_by_rod_theta_
        + coil_span_y_*inverse_coil_length_*rod_middle_vy_by_rod_theta_;
    const double coil_length_rate_by_crank_omega_ = coil_span_rate_x_by_crank_omega_*coil_span_x_*inverse_coil_length_
        + coil_span_rate_y_by_crank_omega_*coil_span_y_*inverse_coil_length_;
    const double coil_length_rate_by_rod_omega_ = -coil_span_x_*inverse_coil_length_*span_rod_middle_y_
        + coil_span_y_*inverse_coil_length_*span_rod_middle_x_;
    const double coil_force_by_crank_theta_ = p->coil_damping_*coil_length_rate_by_crank_theta_
        + coil_length_by_crank_theta_*p->coil_stiffness_;
    const double coil_force_by_rod_theta_ = p->coil_damping_*coil_length_rate_by_rod_theta_
        + coil_length_by_rod_theta_*p->coil_stiffness_;
    const double coil_force_by_crank_omega_ = p->coil_damping_*coil_length_rate_by_crank_omega_;
    const double coil_force_by_rod_omega_ = p->coil_damping_*coil_length_rate_by_rod_omega_;
    const double coil_pull_by_crank_theta_ = -coil_force_*coil_length_by_crank_theta_*(inverse_coil_length_
        * inverse_coil_length_) + coil_force_by_crank_theta_*inverse_coil_length_;
    const double coil_pull_by_rod_theta_ = -coil_force_*coil_length_by_rod_theta_*(inverse_coil_length_
        * inverse_coil_length_) + coil_force_by_rod_theta_*inverse_coil_length_;
    const double coil_pull_by_crank_omega_ = coil_force_by_crank_omega_*inverse_coil_length_;
    const double coil_pull_by_rod_omega_ = coil_force_by_rod_omega_*inverse_coil_length_;

    /* powers */
    const double rod_tip_vx_by_crank_theta_ = -crank_omega_*span_crank_head_x_;
    const double rod_tip_vx_by_rod_theta_ = -rod_omega_*span_rod_tip_x_;

    /* results */
    lin->value[0] = dot_crank_rod_;
    lin->value[1] = span_crank_head_x_;
    lin->value[2] = span_rod_com_x_;
    lin->value[3] = -a_crank_theta_*span_crank_head_y_ - (crank_omega_ * crank_omega_)*span_crank_head_x_
        - crank_omega_*span_crank_head_y_*p->two_alpha_;
    lin->value[4] = -a_rod_theta_*span_rod_com_y_ - (rod_omega_ * rod_omega_)*span_rod_com_x_
        - rod_omega_*span_rod_com_y_*p->two_alpha_;
    lin->value[5] = a_rod_theta_*cross_crank_rod_ + coil_pull_*coil_span_x_*span_crank_middle_x_
        + coil_pull_*coil_span_y_*span_crank_middle_y_ + coil_pull_by_crank_theta_*(-coil_span_x_*span_crank_head_y_
        + coil_span_x_*span_crank_middle_y_ + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_)
        + coil_span_x_by_crank_theta_*(-coil_pull_*span_crank_head_y_ + coil_pull_*span_crank_middle_y_)
        + coil_span_y_by_crank_theta_*(coil_pull_*span_crank_head_x_ - coil_pull_*span_crank_middle_x_)
        + dot_crank_rod_*(rod_omega_ * rod_omega_) + span_crank_head_x_*(-coil_pull_*coil_span_x_ + p->push_value_x_)
        - span_crank_head_y_*(coil_pull_*coil_span_y_ + held_lambda_slider_offset_);
    lin->value[6] = -a_rod_theta_*cross_crank_rod_ + coil_pull_by_rod_theta_*(-coil_span_x_*span_crank_head_y_
        + coil_span_x_*span_crank_middle_y_ + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_)
        - dot_crank_rod_*(rod_omega_ * rod_omega_) + span_rod_middle_x_*(coil_pull_*span_crank_head_x_
        - coil_pull_*span_crank_middle_x_) - span_rod_middle_y_*(-coil_pull_*span_crank_head_y_
        + coil_pull_*span_crank_middle_y_);
    lin->value[7] = a_crank_theta_*cross_crank_rod_ - coil_pull_*coil_span_x_by_crank_theta_*span_rod_middle_y_
        + coil_pull_*coil_span_y_by_crank_theta_*span_rod_middle_x_
        + coil_pull_by_crank_theta_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        - (crank_omega_ * crank_omega_)*dot_crank_rod_;
    lin->value[8] = -a_crank_theta_*cross_crank_rod_ - coil_pull_*coil_span_x_*span_rod_middle_x_
        - coil_pull_*coil_span_y_*span_rod_middle_y_ + coil_pull_*(span_rod_middle_x_ * span_rod_middle_x_)
        + coil_pull_*(span_rod_middle_y_ * span_rod_middle_y_)
        + coil_pull_by_rod_theta_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        + (crank_omega_ * crank_omega_)*dot_crank_rod_ - held_lambda_slider_offset_*span_rod_com_y_
        + p->push_value_x_*span_rod_tip_x_;
    lin->value[9] = -2.0*crank_omega_*span_crank_head_y_;
    lin->value[10] = -2.0*rod_omega_*span_rod_com_y_;
    lin->value[11] = coil_pull_by_crank_omega_*(-coil_span_x_*span_crank_head_y_ + coil_span_x_*span_crank_middle_y_
        + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_);
    lin->value[12] = coil_pull_by_rod_omega_*(-coil_span_x_*span_crank_head_y_ + coil_span_x_*span_crank_middle_y_
        + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_) - 2.0*cross_crank_rod_*rod_omega_;
    lin->value[13] = coil_pull_by_crank_omega_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        + 2.0*crank_omega_*cross_crank_rod_;
    lin->value[14] = coil_pull_by_rod_omega_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_);
    lin->value[15] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_crank_theta_
        + p->push_value_x_*rod_tip_vx_by_crank_theta_;
    lin->value[16] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_rod_theta_
        + p->push_value_x_*rod_tip_vx_by_rod_theta_;
    lin->value[17] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_crank_omega_
        - p->push_value_x_*span_crank_head_y_;
    lin->value[18] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_rod_omega_
        - p->push_value_x_*span_rod_tip_y_;
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
    const double mass_crank_theta_rod_theta_ = lin->value[0];
    const double phi_slider_offset_crank_theta_ = lin->value[1];
    const double phi_slider_offset_rod_theta_ = lin->value[2];
    const double by_q_slider_offset_crank_theta_ = lin->value[3];
    const double by_q_slider_offset_rod_theta_ = lin->value[4];
    const double by_q_crank_theta_crank_theta_ = lin->value[5];
    const double by_q_crank_theta_rod_theta_ = lin->value[6];
    const double by_q_rod_theta_crank_theta_ = lin->value[7];
    const double by_q_rod_theta_rod_theta_ = lin->value[8];
    const double by_v_slider_offset_crank_theta_ = lin->value[9];
    const double by_v_slider_offset_rod_theta_ = lin->value[10];
    const double by_v_crank_theta_crank_theta_ = lin->value[11];
    const double by_v_crank_theta_rod_theta_ = lin->value[12];
    const double by_v_rod_theta_crank_theta_ = lin->value[13];
    const double by_v_rod_theta_rod_theta_ = lin->value[14];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_crank_theta_crank_theta_ = eta*(by_q_crank_theta_crank_theta_*eta + by_v_crank_theta_crank_theta_)
        + p->mass_crank_crank_;
    const double n_crank_theta_rod_theta_ = eta*(by_q_crank_theta_rod_theta_*eta + by_v_crank_theta_rod_theta_)
        + mass_crank_theta_rod_theta_;
    const double n_rod_theta_crank_theta_ = eta*(by_q_rod_theta_crank_theta_*eta + by_v_rod_theta_crank_theta_)
        + mass_crank_theta_rod_theta_;
    const double n_rod_theta_rod_theta_ = eta*(by_q_rod_theta_rod_theta_*eta + by_v_rod_theta_rod_theta_)
        + p->mass_rod_rod_;
    const double n_slider_offset_crank_theta_ = eta_row*(by_q_slider_offset_crank_theta_*eta
        + by_v_slider_offset_crank_theta_) + phi_slider_offset_crank_theta_;
    const double n_slider_offset_rod_theta_ = eta_row*(by_q_slider_offset_rod_theta_*eta
        + by_v_slider_offset_rod_theta_) + phi_slider_offset_rod_theta_;

    /* L U */
    const double scale_crank_theta_ = n_crank_theta_crank_theta_;
    if (!(fabs(scale_crank_theta_) > SINGULAR * fabs(n_crank_theta_crank_theta_)))
        return 1;
    const double inverse_pivot_crank_theta_ = 1.0/scale_crank_theta_;
    lin->lu[0] = inverse_pivot_crank_theta_;
    const double l_rod_theta_crank_theta_ = inverse_pivot_crank_theta_*n_rod_theta_crank_theta_;
    lin->lu[1] = l_rod_theta_crank_theta_;
    lin->lu[2] = n_crank_theta_rod_theta_;
    const double l_slider_offset_crank_theta_ = inverse_pivot_crank_theta_*n_slider_offset_crank_theta_;
    lin->lu[3] = l_slider_offset_crank_theta_;
    const double scale_rod_theta_ = -l_rod_theta_crank_theta_*n_crank_theta_rod_theta_ + n_rod_theta_rod_theta_;
    if (!(fabs(scale_rod_theta_) > SINGULAR * fabs(n_rod_theta_rod_theta_)))
        return 2;
    const double inverse_pivot_rod_theta_ = 1.0/scale_rod_theta_;
    lin->lu[4] = inverse_pivot_rod_theta_;
    const double l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_
        *(-l_slider_offset_crank_theta_*n_crank_theta_rod_theta_ + n_slider_offset_rod_theta_);
    lin->lu[5] = l_slider_offset_rod_theta_;
    const double u_rod_theta_slider_offset_ = -l_rod_theta_crank_theta_*phi_slider_offset_crank_theta_
        + phi_slider_offset_rod_theta_;
    lin->lu[6] = u_rod_theta_slider_offset_;
    const double scale_slider_offset_ = -l_slider_offset_crank_theta_*phi_slider_offset_crank_theta_
        - l_slider_offset_rod_theta_*u_rod_theta_slider_offset_;
    if (!(scale_slider_offset_ != 0.0 && isfinite(scale_slider_offset_)))
        return 3;
    const double inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;
    lin->lu[7] = inverse_pivot_slider_offset_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slider_offset_crank_theta_ = lin->value[1];
    const double inverse_pivot_crank_theta_ = lin->lu[0];
    const double l_rod_theta_crank_theta_ = lin->lu[1];
    const double n_crank_theta_rod_theta_ = lin->lu[2];
    const double l_slider_offset_crank_theta_ = lin->lu[3];
    const double inverse_pivot_rod_theta_ = lin->lu[4];
    const double l_slider_offset_rod_theta_ = lin->lu[5];
    const double u_rod_theta_slider_offset_ = lin->lu[6];
    const double inverse_pivot_slider_offset_ = lin->lu[7];

    /* forward */
    const double b_crank_theta_ = x[0];
    const double b_rod_theta_ = -b_crank_theta_*l_rod_theta_crank_theta_ + x[1];
    const double b_slider_offset_ = -b_crank_theta_*l_slider_offset_crank_theta_
        - b_rod_theta_*l_slider_offset_rod_theta_ + x[2];

    /* backward */
    const double x_slider_offset_ = b_slider_offset_*inverse_pivot_slider_offset_;
    x[2] = x_slider_offset_;
    const double x_rod_theta_ = inverse_pivot_rod_theta_*(b_rod_theta_ - u_rod_theta_slider_offset_*x_slider_offset_);
    x[1] = x_rod_theta_;
    const double x_crank_theta_ = inverse_pivot_crank_theta_*(b_crank_theta_ - n_crank_theta_rod_theta_*x_rod_theta_
        - phi_slider_offset_crank_theta_*x_slider_offset_);
    x[0] = x_crank_theta_;
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
    const double mass_crank_theta_rod_theta_ = lin->value[0];
    const double phi_slider_offset_crank_theta_ = lin->value[1];
    const double phi_slider_offset_rod_theta_ = lin->value[2];
    const double by_q_slider_offset_crank_theta_ = lin->value[3];
    const double by_q_slider_offset_rod_theta_ = lin->value[4];
    const double by_q_crank_theta_crank_theta_ = lin->value[5];
    const double by_q_crank_theta_rod_theta_ = lin->value[6];
    const double by_q_rod_theta_crank_theta_ = lin->value[7];
    const double by_q_rod_theta_rod_theta_ = lin->value[8];
    const double power_q_1_crank_theta_ = lin->value[15];
    const double power_q_1_rod_theta_ = lin->value[16];
    const double power_v_1_crank_theta_ = lin->value[17];
    const double power_v_1_rod_theta_ = lin->value[18];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[3];
    const double shifted_crank_theta_ = -p->beta_squared_*eta*r[0] + r[2];
    const double shifted_rod_theta_ = -p->beta_squared_*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta_*eta*r[0] - by_q_crank_theta_rod_theta_*eta*r[1]
        + p->mass_crank_crank_*r[2] + mass_crank_theta_rod_theta_*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta_*eta*r[0] - by_q_rod_theta_rod_theta_*eta*r[1]
        + mass_crank_theta_rod_theta_*r[2] + p->mass_rod_rod_*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta_*eta*r[0] - by_q_slider_offset_rod_theta_*eta*r[1]
        + phi_slider_offset_crank_theta_*shifted_crank_theta_ + phi_slider_offset_rod_theta_*shifted_rod_theta_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta_*u[0] + power_q_1_rod_theta_*u[1] + power_v_1_crank_theta_*u[2]
        + power_v_1_rod_theta_*u[3] + r[5]);
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
    const double crank_theta_ = q[0];
    const double crank_omega_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];

    /* directions, arms, drives */
    const Four angles_0 = {crank_theta_, rod_theta_, rod_theta_, rod_theta_};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank_ = cosines_0[0];
    const double sin_theta_crank_ = sines_0[0];
    const double cos_theta_rod_ = cosines_0[1];
    const double sin_theta_rod_ = sines_0[1];
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const double span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const double span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const double span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;

    /* Phi and Phi_dot */
    const double phi_slider_offset_ = span_crank_head_y_ + span_rod_com_y_;
    const double phi_dot_slider_offset_ = crank_omega_*span_crank_head_x_ + rod_omega_*span_rod_com_x_;

    /* L D L^T of the KKT matrix */
    const double l_rod_theta_crank_theta_ = dot_crank_rod_*p->inverse_tree_metric_crank_theta_;
    const double l_slider_offset_crank_theta_ = p->inverse_tree_metric_crank_theta_*span_crank_head_x_;
    const double inverse_pivot_rod_theta_ = 1.0/(-dot_crank_rod_*l_rod_theta_crank_theta_ + p->tree_metric_rod_theta_);
    const double w_slider_offset_rod_theta_ = -dot_crank_rod_*l_slider_offset_crank_theta_ + span_rod_com_x_;
    const double l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_*w_slider_offset_rod_theta_;
    const double scale_slider_offset_ = l_slider_offset_crank_theta_*span_crank_head_x_
        + l_slider_offset_rod_theta_*w_slider_offset_rod_theta_;
    if (!(scale_slider_offset_ > 0.0 && scale_slider_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;

    /* backward substitution */
    const double dq_lambda_slider_offset_ = -inverse_pivot_slider_offset_*phi_slider_offset_;
    const double dq_acceleration_rod_theta_ = -dq_lambda_slider_offset_*l_slider_offset_rod_theta_;
    const double dq_acceleration_crank_theta_ = -dq_acceleration_rod_theta_*l_rod_theta_crank_theta_
        - dq_lambda_slider_offset_*l_slider_offset_crank_theta_;

    /* backward substitution */
    const double dv_lambda_slider_offset_ = -inverse_pivot_slider_offset_*phi_dot_slider_offset_;
    const double dv_acceleration_rod_theta_ = -dv_lambda_slider_offset_*l_slider_offset_rod_theta_;
    const double dv_acceleration_crank_theta_ = -dv_acceleration_rod_theta_*l_rod_theta_crank_theta_
        - dv_lambda_slider_offset_*l_slider_offset_crank_theta_;

    /* results */
    dq[0] = dq_acceleration_crank_theta_;
    dv[0] = dv_acceleration_crank_theta_;
    dq[1] = dq_acceleration_rod_theta_;
    dv[1] = dv_acceleration_rod_theta_;
    *worst = max_of(0.0, fabs(phi_slider_offset_));
    return 0;
}
