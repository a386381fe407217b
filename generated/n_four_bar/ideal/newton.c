/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[0];
    const double crank0_omega_ = v[0];
    const double crank1_theta_ = q[1];
    const double crank1_omega_ = v[1];
    const double crank2_theta_ = q[2];
    const double crank2_omega_ = v[2];
    const double coupler1_theta_ = q[3];
    const double coupler1_omega_ = v[3];
    const double coupler2_theta_ = q[4];
    const double coupler2_omega_ = v[4];
    const double a_crank0_theta_ = a[0];
    const double a_crank1_theta_ = a[1];
    const double a_crank2_theta_ = a[2];
    const double a_coupler1_theta_ = a[3];
    const double a_coupler2_theta_ = a[4];
    const double held_lambda_B2_x_ = aside->lambda[0];
    const double held_lambda_B2_y_ = aside->lambda[1];
    const double held_lambda_B1_x_ = aside->lambda[2];
    const double held_lambda_B1_y_ = aside->lambda[3];

    /* directions, arms, drives */
    const double cos_theta_crank0_ = cos(crank0_theta_);
    const double sin_theta_crank0_ = sin(crank0_theta_);
    const double cos_theta_crank1_ = cos(crank1_theta_);
    const double sin_theta_crank1_ = sin(crank1_theta_);
    const double cos_theta_crank2_ = cos(crank2_theta_);
    const double sin_theta_crank2_ = sin(crank2_theta_);
    const double cos_theta_coupler1_ = cos(coupler1_theta_);
    const double sin_theta_coupler1_ = sin(coupler1_theta_);
    const double cos_theta_coupler2_ = cos(coupler2_theta_);
    const double sin_theta_coupler2_ = sin(coupler2_theta_);
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const double cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const double sin_coupler1_less_crank0_ = -cos_theta_coupler1_*sin_theta_crank0_
        + cos_theta_crank0_*sin_theta_coupler1_;
    const double dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const double cross_crank0_coupler1_ = p->inertia_crank0_coupler1_*sin_coupler1_less_crank0_;
    const double cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const double sin_coupler2_less_crank1_ = -cos_theta_coupler2_*sin_theta_crank1_
        + cos_theta_crank1_*sin_theta_coupler2_;
    const double dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;
    const double cross_crank1_coupler2_ = p->inertia_crank1_coupler2_*sin_coupler2_less_crank1_;

    /* results */
    lin->value[0] = dot_crank0_coupler1_;
    lin->value[1] = dot_crank1_coupler2_;
    lin->value[2] = -span_crank1_head_y_;
    lin->value[3] = span_crank2_head_y_;
    lin->value[4] = -span_coupler2_head_y_;
    lin->value[5] = span_crank1_head_x_;
    lin->value[6] = -span_crank2_head_x_;
    lin->value[7] = span_coupler2_head_x_;
    lin->value[8] = -span_crank0_head_y_;
    lin->value[9] = -span_coupler1_head_y_;
    lin->value[10] = span_crank0_head_x_;
    lin->value[11] = span_coupler1_head_x_;
    lin->value[12] = -a_coupler2_theta_*span_coupler2_head_x_
        + (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_y_
        - coupler2_omega_*span_coupler2_head_x_*p->two_alpha_;
    lin->value[13] = -a_crank1_theta_*span_crank1_head_x_ + (crank1_omega_ * crank1_omega_)*span_crank1_head_y_
        - crank1_omega_*span_crank1_head_x_*p->two_alpha_;
    lin->value[14] = a_crank2_theta_*span_crank2_head_x_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_y_
        + crank2_omega_*span_crank2_head_x_*p->two_alpha_;
    lin->value[15] = -a_coupler2_theta_*span_coupler2_head_y_
        - (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_x_
        - coupler2_omega_*span_coupler2_head_y_*p->two_alpha_;
    lin->value[16] = -a_crank1_theta_*span_crank1_head_y_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_x_
        - crank1_omega_*span_crank1_head_y_*p->two_alpha_;
    lin->value[17] = a_crank2_theta_*span_crank2_head_y_ + (crank2_omega_ * crank2_omega_)*span_crank2_head_x_
        + crank2_omega_*span_crank2_head_y_*p->two_alpha_;
    lin->value[18] = -a_coupler1_theta_*span_coupler1_head_x_
        + (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_y_
        - coupler1_omega_*span_coupler1_head_x_*p->two_alpha_;
    lin->value[19] = -a_crank0_theta_*span_crank0_head_x_ + (crank0_omega_ * crank0_omega_)*span_crank0_head_y_
        - crank0_omega_*span_crank0_head_x_*p->two_alpha_;
    lin->value[20] = -a_coupler1_theta_*span_coupler1_head_y_
        - (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_x_
        - coupler1_omega_*span_coupler1_head_y_*p->two_alpha_;
    lin->value[21] = -a_crank0_theta_*span_crank0_head_y_ - (crank0_omega_ * crank0_omega_)*span_crank0_head_x_
        - crank0_omega_*span_crank0_head_y_*p->two_alpha_;
    lin->value[22] = a_coupler1_theta_*cross_crank0_coupler1_
        + (coupler1_omega_ * coupler1_omega_)*dot_crank0_coupler1_ - held_lambda_B1_x_*span_crank0_head_x_
        - held_lambda_B1_y_*span_crank0_head_y_ + sin_theta_crank0_*p->weight_crank0_across_;
    lin->value[23] = -a_coupler1_theta_*cross_crank0_coupler1_
        - (coupler1_omega_ * coupler1_omega_)*dot_crank0_coupler1_;
    lin->value[24] = a_coupler2_theta_*cross_crank1_coupler2_
        + (coupler2_omega_ * coupler2_omega_)*dot_crank1_coupler2_ + sin_theta_crank1_*p->weight_crank1_across_
        + span_crank1_head_x_*(held_lambda_B1_x_ - held_lambda_B2_x_)
        - span_crank1_head_y_*(-held_lambda_B1_y_ + held_lambda_B2_y_);
    lin->value[25] = -a_coupler2_theta_*cross_crank1_coupler2_
        - (coupler2_omega_ * coupler2_omega_)*dot_crank1_coupler2_;
    lin->value[26] = held_lambda_B2_x_*span_crank2_head_x_ + held_lambda_B2_y_*span_crank2_head_y_
        + sin_theta_crank2_*p->weight_crank2_across_;
    lin->value[27] = -a_crank0_theta_*cross_crank0_coupler1_ + (crank0_omega_ * crank0_omega_)*dot_crank0_coupler1_
        - held_lambda_B1_x_*span_coupler1_head_x_ - held_lambda_B1_y_*span_coupler1_head_y_
        + sin_theta_coupler1_*p->weight_coupler1_across_;
    lin->value[28] = a_crank0_theta_*cross_crank0_coupler1_ - (crank0_omega_ * crank0_omega_)*dot_crank0_coupler1_;
    lin->value[29] = -a_crank1_theta_*cross_crank1_coupler2_ + (crank1_omega_ * crank1_omega_)*dot_crank1_coupler2_
        - held_lambda_B2_x_*span_coupler2_head_x_ - held_lambda_B2_y_*span_coupler2_head_y_
        + sin_theta_coupler2_*p->weight_coupler2_across_;
    lin->value[30] = a_crank1_theta_*cross_crank1_coupler2_ - (crank1_omega_ * crank1_omega_)*dot_crank1_coupler2_;
    lin->value[31] = -2.0*coupler2_omega_*span_coupler2_head_x_;
    lin->value[32] = -2.0*crank1_omega_*span_crank1_head_x_;
    lin->value[33] = 2.0*crank2_omega_*span_crank2_head_x_;
    lin->value[34] = -2.0*coupler2_omega_*span_coupler2_head_y_;
    lin->value[35] = -2.0*crank1_omega_*span_crank1_head_y_;
    lin->value[36] = 2.0*crank2_omega_*span_crank2_head_y_;
    lin->value[37] = -2.0*coupler1_omega_*span_coupler1_head_x_;
    lin->value[38] = -2.0*crank0_omega_*span_crank0_head_x_;
    lin->value[39] = -2.0*coupler1_omega_*span_coupler1_head_y_;
    lin->value[40] = -2.0*crank0_omega_*span_crank0_head_y_;
    lin->value[41] = -2.0*coupler1_omega_*cross_crank0_coupler1_;
    lin->value[42] = -2.0*coupler2_omega_*cross_crank1_coupler2_;
    lin->value[43] = 2.0*crank0_omega_*cross_crank0_coupler1_;
    lin->value[44] = 2.0*crank1_omega_*cross_crank1_coupler2_;
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
    const double mass_crank0_theta_coupler1_theta_ = lin->value[0];
    const double mass_crank1_theta_coupler2_theta_ = lin->value[1];
    const double phi_B2_x_crank1_theta_ = lin->value[2];
    const double phi_B2_x_crank2_theta_ = lin->value[3];
    const double phi_B2_x_coupler2_theta_ = lin->value[4];
    const double phi_B2_y_crank1_theta_ = lin->value[5];
    const double phi_B2_y_crank2_theta_ = lin->value[6];
    const double phi_B2_y_coupler2_theta_ = lin->value[7];
    const double phi_B1_x_crank0_theta_ = lin->value[8];
    const double phi_B1_x_coupler1_theta_ = lin->value[9];
    const double phi_B1_y_crank0_theta_ = lin->value[10];
    const double phi_B1_y_coupler1_theta_ = lin->value[11];
    const double by_q_B2_x_coupler2_theta_ = lin->value[12];
    const double by_q_B2_x_crank1_theta_ = lin->value[13];
    const double by_q_B2_x_crank2_theta_ = lin->value[14];
    const double by_q_B2_y_coupler2_theta_ = lin->value[15];
    const double by_q_B2_y_crank1_theta_ = lin->value[16];
    const double by_q_B2_y_crank2_theta_ = lin->value[17];
    const double by_q_B1_x_coupler1_theta_ = lin->value[18];
    const double by_q_B1_x_crank0_theta_ = lin->value[19];
    const double by_q_B1_y_coupler1_theta_ = lin->value[20];
    const double by_q_B1_y_crank0_theta_ = lin->value[21];
    const double by_q_crank0_theta_crank0_theta_ = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta_ = lin->value[23];
    const double by_q_crank1_theta_crank1_theta_ = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta_ = lin->value[25];
    const double by_q_crank2_theta_crank2_theta_ = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta_ = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta_ = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta_ = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta_ = lin->value[30];
    const double by_v_B2_x_coupler2_theta_ = lin->value[31];
    const double by_v_B2_x_crank1_theta_ = lin->value[32];
    const double by_v_B2_x_crank2_theta_ = lin->value[33];
    const double by_v_B2_y_coupler2_theta_ = lin->value[34];
    const double by_v_B2_y_crank1_theta_ = lin->value[35];
    const double by_v_B2_y_crank2_theta_ = lin->value[36];
    const double by_v_B1_x_coupler1_theta_ = lin->value[37];
    const double by_v_B1_x_crank0_theta_ = lin->value[38];
    const double by_v_B1_y_coupler1_theta_ = lin->value[39];
    const double by_v_B1_y_crank0_theta_ = lin->value[40];
    const double by_v_crank0_theta_coupler1_theta_ = lin->value[41];
    const double by_v_crank1_theta_coupler2_theta_ = lin->value[42];
    const double by_v_coupler1_theta_crank0_theta_ = lin->value[43];
    const double by_v_coupler2_theta_crank1_theta_ = lin->value[44];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_crank0_theta_crank0_theta_ = by_q_crank0_theta_crank0_theta_*(eta * eta) + p->mass_crank0_crank0_;
    const double n_crank0_theta_coupler1_theta_ = eta*(by_q_crank0_theta_coupler1_theta_*eta
        + by_v_crank0_theta_coupler1_theta_) + mass_crank0_theta_coupler1_theta_;
    const double n_crank1_theta_crank1_theta_ = by_q_crank1_theta_crank1_theta_*(eta * eta) + p->mass_crank1_crank1_;
    const double n_crank1_theta_coupler2_theta_ = eta*(by_q_crank1_theta_coupler2_theta_*eta
        + by_v_crank1_theta_coupler2_theta_) + mass_crank1_theta_coupler2_theta_;
    const double n_crank2_theta_crank2_theta_ = by_q_crank2_theta_crank2_theta_*(eta * eta) + p->mass_crank2_crank2_;
    const double n_coupler1_theta_crank0_theta_ = eta*(by_q_coupler1_theta_crank0_theta_*eta
        + by_v_coupler1_theta_crank0_theta_) + mass_crank0_theta_coupler1_theta_;
    const double n_coupler1_theta_coupler1_theta_ = by_q_coupler1_theta_coupler1_theta_*(eta * eta)
        + p->mass_coupler1_coupler1_;
    const double n_coupler2_theta_crank1_theta_ = eta*(by_q_coupler2_theta_crank1_theta_*eta
        + by_v_coupler2_theta_crank1_theta_) + mass_crank1_theta_coupler2_theta_;
    const double n_coupler2_theta_coupler2_theta_ = by_q_coupler2_theta_coupler2_theta_*(eta * eta)
        + p->mass_coupler2_coupler2_;
    const double n_B2_x_crank1_theta_ = eta_row*(by_q_B2_x_crank1_theta_*eta + by_v_B2_x_crank1_theta_)
        + phi_B2_x_crank1_theta_;
    const double n_B2_x_crank2_theta_ = eta_row*(by_q_B2_x_crank2_theta_*eta + by_v_B2_x_crank2_theta_)
        + phi_B2_x_crank2_theta_;
    const double n_B2_x_coupler2_theta_ = eta_row*(by_q_B2_x_coupler2_theta_*eta + by_v_B2_x_coupler2_theta_)
        + phi_B2_x_coupler2_theta_;
    const double n_B2_y_crank1_theta_ = eta_row*(by_q_B2_y_crank1_theta_*eta + by_v_B2_y_crank1_theta_)
        + phi_B2_y_crank1_theta_;
    const double n_B2_y_crank2_theta_ = eta_row*(by_q_B2_y_crank2_theta_*eta + by_v_B2_y_crank2_theta_)
        + phi_B2_y_crank2_theta_;
    const double n_B2_y_coupler2_theta_ = eta_row*(by_q_B2_y_coupler2_theta_*eta + by_v_B2_y_coupler2_theta_)
        + phi_B2_y_coupler2_theta_;
    const double n_B1_x_crank0_theta_ = eta_row*(by_q_B1_x_crank0_theta_*eta + by_v_B1_x_crank0_theta_)
        + phi_B1_x_crank0_theta_;
    const double n_B1_x_crank1_theta_ = eta_row*(-by_q_B2_x_crank1_theta_*eta - by_v_B2_x_crank1_theta_)
        - phi_B2_x_crank1_theta_;
    const double n_B1_x_coupler1_theta_ = eta_row*(by_q_B1_x_coupler1_theta_*eta + by_v_B1_x_coupler1_theta_)
        + phi_B1_x_coupler1_theta_;
    const double n_B1_y_crank0_theta_ = eta_row*(by_q_B1_y_crank0_theta_*eta + by_v_B1_y_crank0_theta_)
        + phi_B1_y_crank0_theta_;
    const double n_B1_y_crank1_theta_ = eta_row*(-by_q_B2_y_crank1_theta_*eta - by_v_B2_y_crank1_theta_)
        - phi_B2_y_crank1_theta_;
    const double n_B1_y_coupler1_theta_ = eta_row*(by_q_B1_y_coupler1_theta_*eta + by_v_B1_y_coupler1_theta_)
        + phi_B1_y_coupler1_theta_;

    /* L U */
    const double scale_crank2_theta_ = n_crank2_theta_crank2_theta_;
    if (!(fabs(scale_crank2_theta_) > SINGULAR * fabs(n_crank2_theta_crank2_theta_)))
        return 3;
    const double inverse_pivot_crank2_theta_ = 1.0/scale_crank2_theta_;
    lin->lu[0] = inverse_pivot_crank2_theta_;
    const double l_B2_x_crank2_theta_ = inverse_pivot_crank2_theta_*n_B2_x_crank2_theta_;
    lin->lu[1] = l_B2_x_crank2_theta_;
    const double l_B2_y_crank2_theta_ = inverse_pivot_crank2_theta_*n_B2_y_crank2_theta_;
    lin->lu[2] = l_B2_y_crank2_theta_;
    const double scale_crank0_theta_ = n_crank0_theta_crank0_theta_;
    if (!(fabs(scale_crank0_theta_) > SINGULAR * fabs(n_crank0_theta_crank0_theta_)))
        return 1;
    const double inverse_pivot_crank0_theta_ = 1.0/scale_crank0_theta_;
    lin->lu[3] = inverse_pivot_crank0_theta_;
    const double l_coupler1_theta_crank0_theta_ = inverse_pivot_crank0_theta_*n_coupler1_theta_crank0_theta_;
    lin->lu[4] = l_coupler1_theta_crank0_theta_;
    lin->lu[5] = n_crank0_theta_coupler1_theta_;
    const double l_B1_x_crank0_theta_ = inverse_pivot_crank0_theta_*n_B1_x_crank0_theta_;
    lin->lu[6] = l_B1_x_crank0_theta_;
    const double l_B1_y_crank0_theta_ = inverse_pivot_crank0_theta_*n_B1_y_crank0_theta_;
    lin->lu[7] = l_B1_y_crank0_theta_;
    const double scale_coupler1_theta_ = -l_coupler1_theta_crank0_theta_*n_crank0_theta_coupler1_theta_
        + n_coupler1_theta_coupler1_theta_;
    if (!(fabs(scale_coupler1_theta_) > SINGULAR * fabs(n_coupler1_theta_coupler1_theta_)))
        return 4;
    const double inverse_pivot_coupler1_theta_ = 1.0/scale_coupler1_theta_;
    lin->lu[8] = inverse_pivot_coupler1_theta_;
    const double l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_
        *(-l_B1_x_crank0_theta_*n_crank0_theta_coupler1_theta_ + n_B1_x_coupler1_theta_);
    lin->lu[9] = l_B1_x_coupler1_theta_;
    const double u_coupler1_theta_B1_x_ = -l_coupler1_theta_crank0_theta_*phi_B1_x_crank0_theta_
        + phi_B1_x_coupler1_theta_;
    lin->lu[10] = u_coupler1_theta_B1_x_;
    const double l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_
        *(-l_B1_y_crank0_theta_*n_crank0_theta_coupler1_theta_ + n_B1_y_coupler1_theta_);
    lin->lu[11] = l_B1_y_coupler1_theta_;
    const double u_coupler1_theta_B1_y_ = -l_coupler1_theta_crank0_theta_*phi_B1_y_crank0_theta_
        + phi_B1_y_coupler1_theta_;
    lin->lu[12] = u_coupler1_theta_B1_y_;
    const double scale_coupler2_theta_ = n_coupler2_theta_coupler2_theta_;
    if (!(fabs(scale_coupler2_theta_) > SINGULAR * fabs(n_coupler2_theta_coupler2_theta_)))
        return 5;
    const double inverse_pivot_coupler2_theta_ = 1.0/scale_coupler2_theta_;
    lin->lu[13] = inverse_pivot_coupler2_theta_;
    const double l_crank1_theta_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_crank1_theta_coupler2_theta_;
    lin->lu[14] = l_crank1_theta_coupler2_theta_;
    lin->lu[15] = n_coupler2_theta_crank1_theta_;
    const double l_B2_x_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_B2_x_coupler2_theta_;
    lin->lu[16] = l_B2_x_coupler2_theta_;
    const double l_B2_y_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_B2_y_coupler2_theta_;
    lin->lu[17] = l_B2_y_coupler2_theta_;
    const double scale_crank1_theta_ = -l_crank1_theta_coupler2_theta_*n_coupler2_theta_crank1_theta_
        + n_crank1_theta_crank1_theta_;
    if (!(fabs(scale_crank1_theta_) > SINGULAR * fabs(n_crank1_theta_crank1_theta_)))
        return 2;
    const double inverse_pivot_crank1_theta_ = 1.0/scale_crank1_theta_;
    lin->lu[18] = inverse_pivot_crank1_theta_;
    const double l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_
        *(-l_B2_x_coupler2_theta_*n_coupler2_theta_crank1_theta_ + n_B2_x_crank1_theta_);
    lin->lu[19] = l_B2_x_crank1_theta_;
    const double u_crank1_theta_B2_x_ = -l_crank1_theta_coupler2_theta_*phi_B2_x_coupler2_theta_
        + phi_B2_x_crank1_theta_;
    lin->lu[20] = u_crank1_theta_B2_x_;
    const double l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_
        *(-l_B2_y_coupler2_theta_*n_coupler2_theta_crank1_theta_ + n_B2_y_crank1_theta_);
    lin->lu[21] = l_B2_y_crank1_theta_;
    const double u_crank1_theta_B2_y_ = -l_crank1_theta_coupler2_theta_*phi_B2_y_coupler2_theta_
        + phi_B2_y_crank1_theta_;
    lin->lu[22] = u_crank1_theta_B2_y_;
    const double l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*n_B1_x_crank1_theta_;
    lin->lu[23] = l_B1_x_crank1_theta_;
    const double l_B1_y_crank1_theta_ = inverse_pivot_crank1_theta_*n_B1_y_crank1_theta_;
    lin->lu[24] = l_B1_y_crank1_theta_;
    const double scale_B2_x_ = -l_B2_x_coupler2_theta_*phi_B2_x_coupler2_theta_
        - l_B2_x_crank1_theta_*u_crank1_theta_B2_x_ - l_B2_x_crank2_theta_*phi_B2_x_crank2_theta_;
    if (!(scale_B2_x_ != 0.0 && isfinite(scale_B2_x_)))
        return 6;
    const double inverse_pivot_B2_x_ = 1.0/scale_B2_x_;
    lin->lu[25] = inverse_pivot_B2_x_;
    const double l_B2_y_B2_x_ = inverse_pivot_B2_x_*(-l_B2_y_coupler2_theta_*phi_B2_x_coupler2_theta_
        - l_B2_y_crank1_theta_*u_crank1_theta_B2_x_ - l_B2_y_crank2_theta_*phi_B2_x_crank2_theta_);
    lin->lu[26] = l_B2_y_B2_x_;
    const double u_B2_x_B2_y_ = -l_B2_x_coupler2_theta_*phi_B2_y_coupler2_theta_
        - l_B2_x_crank1_theta_*u_crank1_theta_B2_y_ - l_B2_x_crank2_theta_*phi_B2_y_crank2_theta_;
    lin->lu[27] = u_B2_x_B2_y_;
    const double l_B1_x_B2_x_ = -inverse_pivot_B2_x_*l_B1_x_crank1_theta_*u_crank1_theta_B2_x_;
    lin->lu[28] = l_B1_x_B2_x_;
    const double u_B2_x_B1_x_ = l_B2_x_crank1_theta_*phi_B2_x_crank1_theta_;
    lin->lu[29] = u_B2_x_B1_x_;
    const double l_B1_y_B2_x_ = -inverse_pivot_B2_x_*l_B1_y_crank1_theta_*u_crank1_theta_B2_x_;
    lin->lu[30] = l_B1_y_B2_x_;
    const double u_B2_x_B1_y_ = l_B2_x_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[31] = u_B2_x_B1_y_;
    const double scale_B2_y_ = -l_B2_y_coupler2_theta_*phi_B2_y_coupler2_theta_
        - l_B2_y_crank1_theta_*u_crank1_theta_B2_y_ - l_B2_y_crank2_theta_*phi_B2_y_crank2_theta_;
    const double pivot_B2_y_ = -l_B2_y_B2_x_*u_B2_x_B2_y_ + scale_B2_y_;
    if (!(fabs(pivot_B2_y_) > SINGULAR * fabs(scale_B2_y_)))
        return 7;
    const double inverse_pivot_B2_y_ = 1.0/pivot_B2_y_;
    lin->lu[32] = inverse_pivot_B2_y_;
    const double l_B1_x_B2_y_ = inverse_pivot_B2_y_*(-l_B1_x_B2_x_*u_B2_x_B2_y_
        - l_B1_x_crank1_theta_*u_crank1_theta_B2_y_);
    lin->lu[33] = l_B1_x_B2_y_;
    const double u_B2_y_B1_x_ = -l_B2_y_B2_x_*u_B2_x_B1_x_ + l_B2_y_crank1_theta_*phi_B2_x_crank1_theta_;
    lin->lu[34] = u_B2_y_B1_x_;
    const double l_B1_y_B2_y_ = inverse_pivot_B2_y_*(-l_B1_y_B2_x_*u_B2_x_B2_y_
        - l_B1_y_crank1_theta_*u_crank1_theta_B2_y_);
    lin->lu[35] = l_B1_y_B2_y_;
    const double u_B2_y_B1_y_ = -l_B2_y_B2_x_*u_B2_x_B1_y_ + l_B2_y_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[36] = u_B2_y_B1_y_;
    const double scale_B1_x_ = -l_B1_x_coupler1_theta_*u_coupler1_theta_B1_x_
        - l_B1_x_crank0_theta_*phi_B1_x_crank0_theta_ + l_B1_x_crank1_theta_*phi_B2_x_crank1_theta_;
    const double pivot_B1_x_ = -l_B1_x_B2_x_*u_B2_x_B1_x_ - l_B1_x_B2_y_*u_B2_y_B1_x_ + scale_B1_x_;
    if (!(fabs(pivot_B1_x_) > SINGULAR * fabs(scale_B1_x_)))
        return 8;
    const double inverse_pivot_B1_x_ = 1.0/pivot_B1_x_;
    lin->lu[37] = inverse_pivot_B1_x_;
    const double l_B1_y_B1_x_ = inverse_pivot_B1_x_*(-l_B1_y_B2_x_*u_B2_x_B1_x_ - l_B1_y_B2_y_*u_B2_y_B1_x_
        - l_B1_y_coupler1_theta_*u_coupler1_theta_B1_x_ - l_B1_y_crank0_theta_*phi_B1_x_crank0_theta_
        + l_B1_y_crank1_theta_*phi_B2_x_crank1_theta_);
    lin->lu[38] = l_B1_y_B1_x_;
    const double u_B1_x_B1_y_ = -l_B1_x_B2_x_*u_B2_x_B1_y_ - l_B1_x_B2_y_*u_B2_y_B1_y_
        - l_B1_x_coupler1_theta_*u_coupler1_theta_B1_y_ - l_B1_x_crank0_theta_*phi_B1_y_crank0_theta_
        + l_B1_x_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[39] = u_B1_x_B1_y_;
    const double scale_B1_y_ = -l_B1_y_coupler1_theta_*u_coupler1_theta_B1_y_
        - l_B1_y_crank0_theta_*phi_B1_y_crank0_theta_ + l_B1_y_crank1_theta_*phi_B2_y_crank1_theta_;
    const double pivot_B1_y_ = -l_B1_y_B1_x_*u_B1_x_B1_y_ - l_B1_y_B2_x_*u_B2_x_B1_y_ - l_B1_y_B2_y_*u_B2_y_B1_y_
        + scale_B1_y_;
    if (!(fabs(pivot_B1_y_) > SINGULAR * fabs(scale_B1_y_)))
        return 9;
    const double inverse_pivot_B1_y_ = 1.0/pivot_B1_y_;
    lin->lu[40] = inverse_pivot_B1_y_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_B2_x_crank1_theta_ = lin->value[2];
    const double phi_B2_x_crank2_theta_ = lin->value[3];
    const double phi_B2_x_coupler2_theta_ = lin->value[4];
    const double phi_B2_y_crank1_theta_ = lin->value[5];
    const double phi_B2_y_crank2_theta_ = lin->value[6];
    const double phi_B2_y_coupler2_theta_ = lin->value[7];
    const double phi_B1_x_crank0_theta_ = lin->value[8];
    const double phi_B1_y_crank0_theta_ = lin->value[10];
    const double inverse_pivot_crank2_theta_ = lin->lu[0];
    const double l_B2_x_crank2_theta_ = lin->lu[1];
    const double l_B2_y_crank2_theta_ = lin->lu[2];
    const double inverse_pivot_crank0_theta_ = lin->lu[3];
    const double l_coupler1_theta_crank0_theta_ = lin->lu[4];
    const double n_crank0_theta_coupler1_theta_ = lin->lu[5];
    const double l_B1_x_crank0_theta_ = lin->lu[6];
    const double l_B1_y_crank0_theta_ = lin->lu[7];
    const double inverse_pivot_coupler1_theta_ = lin->lu[8];
    const double l_B1_x_coupler1_theta_ = lin->lu[9];
    const double u_coupler1_theta_B1_x_ = lin->lu[10];
    const double l_B1_y_coupler1_theta_ = lin->lu[11];
    const double u_coupler1_theta_B1_y_ = lin->lu[12];
    const double inverse_pivot_coupler2_theta_ = lin->lu[13];
    const double l_crank1_theta_coupler2_theta_ = lin->lu[14];
    const double n_coupler2_theta_crank1_theta_ = lin->lu[15];
    const double l_B2_x_coupler2_theta_ = lin->lu[16];
    const double l_B2_y_coupler2_theta_ = lin->lu[17];
    const double inverse_pivot_crank1_theta_ = lin->lu[18];
    const double l_B2_x_crank1_theta_ = lin->lu[19];
    const double u_crank1_theta_B2_x_ = lin->lu[20];
    const double l_B2_y_crank1_theta_ = lin->lu[21];
    const double u_crank1_theta_B2_y_ = lin->lu[22];
    const double l_B1_x_crank1_theta_ = lin->lu[23];
    const double l_B1_y_crank1_theta_ = lin->lu[24];
    const double inverse_pivot_B2_x_ = lin->lu[25];
    const double l_B2_y_B2_x_ = lin->lu[26];
    const double u_B2_x_B2_y_ = lin->lu[27];
    const double l_B1_x_B2_x_ = lin->lu[28];
    const double u_B2_x_B1_x_ = lin->lu[29];
    const double l_B1_y_B2_x_ = lin->lu[30];
    const double u_B2_x_B1_y_ = lin->lu[31];
    const double inverse_pivot_B2_y_ = lin->lu[32];
    const double l_B1_x_B2_y_ = lin->lu[33];
    const double u_B2_y_B1_x_ = lin->lu[34];
    const double l_B1_y_B2_y_ = lin->lu[35];
    const double u_B2_y_B1_y_ = lin->lu[36];
    const double inverse_pivot_B1_x_ = lin->lu[37];
    const double l_B1_y_B1_x_ = lin->lu[38];
    const double u_B1_x_B1_y_ = lin->lu[39];
    const double inverse_pivot_B1_y_ = lin->lu[40];

    /* forward */
    const double b_crank2_theta_ = x[2];
    const double b_crank0_theta_ = x[0];
    const double b_coupler1_theta_ = -b_crank0_theta_*l_coupler1_theta_crank0_theta_ + x[3];
    const double b_coupler2_theta_ = x[4];
    const double b_crank1_theta_ = -b_coupler2_theta_*l_crank1_theta_coupler2_theta_ + x[1];
    const double b_B2_x_ = -b_coupler2_theta_*l_B2_x_coupler2_theta_ - b_crank1_theta_*l_B2_x_crank1_theta_
        - b_crank2_theta_*l_B2_x_crank2_theta_ + x[5];
    const double b_B2_y_ = -b_B2_x_*l_B2_y_B2_x_ - b_coupler2_theta_*l_B2_y_coupler2_theta_
        - b_crank1_theta_*l_B2_y_crank1_theta_ - b_crank2_theta_*l_B2_y_crank2_theta_ + x[6];
    const double b_B1_x_ = -b_B2_x_*l_B1_x_B2_x_ - b_B2_y_*l_B1_x_B2_y_ - b_coupler1_theta_*l_B1_x_coupler1_theta_
        - b_crank0_theta_*l_B1_x_crank0_theta_ - b_crank1_theta_*l_B1_x_crank1_theta_ + x[7];
    const double b_B1_y_ = -b_B1_x_*l_B1_y_B1_x_ - b_B2_x_*l_B1_y_B2_x_ - b_B2_y_*l_B1_y_B2_y_
        - b_coupler1_theta_*l_B1_y_coupler1_theta_ - b_crank0_theta_*l_B1_y_crank0_theta_
        - b_crank1_theta_*l_B1_y_crank1_theta_ + x[8];

    /* backward */
    const double x_B1_y_ = b_B1_y_*inverse_pivot_B1_y_;
    x[8] = x_B1_y_;
    const double x_B1_x_ = inverse_pivot_B1_x_*(b_B1_x_ - u_B1_x_B1_y_*x_B1_y_);
    x[7] = x_B1_x_;
    const double x_B2_y_ = inverse_pivot_B2_y_*(b_B2_y_ - u_B2_y_B1_x_*x_B1_x_ - u_B2_y_B1_y_*x_B1_y_);
    x[6] = x_B2_y_;
    const double x_B2_x_ = inverse_pivot_B2_x_*(b_B2_x_ - u_B2_x_B1_x_*x_B1_x_ - u_B2_x_B1_y_*x_B1_y_
        - u_B2_x_B2_y_*x_B2_y_);
    x[5] = x_B2_x_;
    const double x_crank1_theta_ = inverse_pivot_crank1_theta_*(b_crank1_theta_ + phi_B2_x_crank1_theta_*x_B1_x_
        + phi_B2_y_crank1_theta_*x_B1_y_ - u_crank1_theta_B2_x_*x_B2_x_ - u_crank1_theta_B2_y_*x_B2_y_);
    x[1] = x_crank1_theta_;
    const double x_coupler2_theta_ = inverse_pivot_coupler2_theta_*(b_coupler2_theta_
        - n_coupler2_theta_crank1_theta_*x_crank1_theta_ - phi_B2_x_coupler2_theta_*x_B2_x_
        - phi_B2_y_coupler2_theta_*x_B2_y_);
    x[4] = x_coupler2_theta_;
    const double x_coupler1_theta_ = inverse_pivot_coupler1_theta_*(b_coupler1_theta_ - u_coupler1_theta_B1_x_*x_B1_x_
        - u_coupler1_theta_B1_y_*x_B1_y_);
    x[3] = x_coupler1_theta_;
    const double x_crank0_theta_ = inverse_pivot_crank0_theta_*(b_crank0_theta_
        - n_crank0_theta_coupler1_theta_*x_coupler1_theta_ - phi_B1_x_crank0_theta_*x_B1_x_
        - phi_B1_y_crank0_theta_*x_B1_y_);
    x[0] = x_crank0_theta_;
    const double x_crank2_theta_ = inverse_pivot_crank2_theta_*(b_crank2_theta_ - phi_B2_x_crank2_theta_*x_B2_x_
        - phi_B2_y_crank2_theta_*x_B2_y_);
    x[2] = x_crank2_theta_;
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
    const double mass_crank0_theta_coupler1_theta_ = lin->value[0];
    const double mass_crank1_theta_coupler2_theta_ = lin->value[1];
    const double phi_B2_x_crank1_theta_ = lin->value[2];
    const double phi_B2_x_crank2_theta_ = lin->value[3];
    const double phi_B2_x_coupler2_theta_ = lin->value[4];
    const double phi_B2_y_crank1_theta_ = lin->value[5];
    const double phi_B2_y_crank2_theta_ = lin->value[6];
    const double phi_B2_y_coupler2_theta_ = lin->value[7];
    const double phi_B1_x_crank0_theta_ = lin->value[8];
    const double phi_B1_x_coupler1_theta_ = lin->value[9];
    const double phi_B1_y_crank0_theta_ = lin->value[10];
    const double phi_B1_y_coupler1_theta_ = lin->value[11];
    const double by_q_B2_x_coupler2_theta_ = lin->value[12];
    const double by_q_B2_x_crank1_theta_ = lin->value[13];
    const double by_q_B2_x_crank2_theta_ = lin->value[14];
    const double by_q_B2_y_coupler2_theta_ = lin->value[15];
    const double by_q_B2_y_crank1_theta_ = lin->value[16];
    const double by_q_B2_y_crank2_theta_ = lin->value[17];
    const double by_q_B1_x_coupler1_theta_ = lin->value[18];
    const double by_q_B1_x_crank0_theta_ = lin->value[19];
    const double by_q_B1_y_coupler1_theta_ = lin->value[20];
    const double by_q_B1_y_crank0_theta_ = lin->value[21];
    const double by_q_crank0_theta_crank0_theta_ = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta_ = lin->value[23];
    const double by_q_crank1_theta_crank1_theta_ = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta_ = lin->value[25];
    const double by_q_crank2_theta_crank2_theta_ = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta_ = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta_ = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta_ = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta_ = lin->value[30];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[9];
    const double shifted_crank0_theta_ = -p->beta_squared_*eta*r[0] + r[5];
    const double shifted_crank1_theta_ = -p->beta_squared_*eta*r[1] + r[6];
    const double shifted_crank2_theta_ = -p->beta_squared_*eta*r[2] + r[7];
    const double shifted_coupler1_theta_ = -p->beta_squared_*eta*r[3] + r[8];
    const double shifted_coupler2_theta_ = -p->beta_squared_*eta*r[4] + r[9];
    x[0] = eta*(-by_q_crank0_theta_coupler1_theta_*eta*r[3] - by_q_crank0_theta_crank0_theta_*eta*r[0]
        + p->mass_crank0_crank0_*r[5] + mass_crank0_theta_coupler1_theta_*r[8]);
    x[1] = eta*(-by_q_crank1_theta_coupler2_theta_*eta*r[4] - by_q_crank1_theta_crank1_theta_*eta*r[1]
        + p->mass_crank1_crank1_*r[6] + mass_crank1_theta_coupler2_theta_*r[9]);
    x[2] = eta*(-by_q_crank2_theta_crank2_theta_*eta*r[2] + p->mass_crank2_crank2_*r[7]);
    x[3] = eta*(-by_q_coupler1_theta_coupler1_theta_*eta*r[3] - by_q_coupler1_theta_crank0_theta_*eta*r[0]
        + p->mass_coupler1_coupler1_*r[8] + mass_crank0_theta_coupler1_theta_*r[5]);
    x[4] = eta*(-by_q_coupler2_theta_coupler2_theta_*eta*r[4] - by_q_coupler2_theta_crank1_theta_*eta*r[1]
        + p->mass_coupler2_coupler2_*r[9] + mass_crank1_theta_coupler2_theta_*r[6]);
    x[5] = eta_row*(-by_q_B2_x_coupler2_theta_*eta*r[4] - by_q_B2_x_crank1_theta_*eta*r[1]
        - by_q_B2_x_crank2_theta_*eta*r[2] + phi_B2_x_coupler2_theta_*shifted_coupler2_theta_
        + phi_B2_x_crank1_theta_*shifted_crank1_theta_ + phi_B2_x_crank2_theta_*shifted_crank2_theta_);
    x[6] = eta_row*(-by_q_B2_y_coupler2_theta_*eta*r[4] - by_q_B2_y_crank1_theta_*eta*r[1]
        - by_q_B2_y_crank2_theta_*eta*r[2] + phi_B2_y_coupler2_theta_*shifted_coupler2_theta_
        + phi_B2_y_crank1_theta_*shifted_crank1_theta_ + phi_B2_y_crank2_theta_*shifted_crank2_theta_);
    x[7] = eta_row*(-by_q_B1_x_coupler1_theta_*eta*r[3] - by_q_B1_x_crank0_theta_*eta*r[0]
        + by_q_B2_x_crank1_theta_*eta*r[1] + phi_B1_x_coupler1_theta_*shifted_coupler1_theta_
        + phi_B1_x_crank0_theta_*shifted_crank0_theta_ - phi_B2_x_crank1_theta_*shifted_crank1_theta_);
    x[8] = eta_row*(-by_q_B1_y_coupler1_theta_*eta*r[3] - by_q_B1_y_crank0_theta_*eta*r[0]
        + by_q_B2_y_crank1_theta_*eta*r[1] + phi_B1_y_coupler1_theta_*shifted_coupler1_theta_
        + phi_B1_y_crank0_theta_*shifted_crank0_theta_ - phi_B2_y_crank1_theta_*shifted_crank1_theta_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[5] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[6] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[7] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[8] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[9] = x[4];
    u[10] = eta*r[10];
    u[11] = eta*r[11];
    u[12] = eta*r[12];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {5, 1, 2, 1}, {5, 2, 3, 1}, {5, 4, 4, 1}, {6, 1, 5, 1}, {6, 2, 6, 1}, {6, 4, 7, 1}, {7, 0, 8, 1},
    {7, 1, 2, -1}, {7, 3, 9, 1}, {8, 0, 10, 1}, {8, 1, 5, -1}, {8, 3, 11, 1}
};
static const LinearEntry residual_entries[] = {
    {5, 4, 12, 1}, {5, 1, 13, 1}, {5, 2, 14, 1}, {6, 4, 15, 1}, {6, 1, 16, 1}, {6, 2, 17, 1}, {7, 3, 18, 1},
    {7, 0, 19, 1}, {7, 1, 13, -1}, {8, 3, 20, 1}, {8, 0, 21, 1}, {8, 1, 16, -1}, {0, 0, 22, 1}, {0, 3, 23, 1},
    {1, 1, 24, 1}, {1, 4, 25, 1}, {2, 2, 26, 1}, {3, 3, 27, 1}, {3, 0, 28, 1}, {4, 4, 29, 1}, {4, 1, 30, 1},
    {5, 9, 31, 1}, {5, 6, 32, 1}, {5, 7, 33, 1}, {6, 9, 34, 1}, {6, 6, 35, 1}, {6, 7, 36, 1}, {7, 8, 37, 1},
    {7, 5, 38, 1}, {7, 6, 32, -1}, {8, 8, 39, 1}, {8, 5, 40, 1}, {8, 6, 35, -1}, {0, 8, 41, 1}, {1, 9, 42, 1},
    {3, 5, 43, 1}, {4, 6, 44, 1}
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
    N_PHI_Q = 12,
    N_RESIDUAL = 37,
    N_RESIDUAL_T = 0,
    N_POWER = 0,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 9,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta_ = q[0];
    const double crank0_omega_ = v[0];
    const double crank1_theta_ = q[1];
    const double crank1_omega_ = v[1];
    const double crank2_theta_ = q[2];
    const double crank2_omega_ = v[2];
    const double coupler1_theta_ = q[3];
    const double coupler1_omega_ = v[3];
    const double coupler2_theta_ = q[4];
    const double coupler2_omega_ = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta_, crank1_theta_, crank2_theta_, coupler1_theta_};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta_, coupler2_theta_, coupler2_theta_, coupler2_theta_};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0_ = cosines_0[0];
    const double sin_theta_crank0_ = sines_0[0];
    const double cos_theta_crank1_ = cosines_0[1];
    const double sin_theta_crank1_ = sines_0[1];
    const double cos_theta_crank2_ = cosines_0[2];
    const double sin_theta_crank2_ = sines_0[2];
    const double cos_theta_coupler1_ = cosines_0[3];
    const double sin_theta_coupler1_ = sines_0[3];
    const double cos_theta_coupler2_ = cosines_1[0];
    const double sin_theta_coupler2_ = sines_1[0];
    const double span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const double span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const double span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const double span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const double span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const double span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const double span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const double span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const double span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const double span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const double cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const double dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const double cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const double dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;

    /* Phi and Phi_dot */
    const double phi_B2_x_ = p->O1_x_ - p->O2_x_ + span_coupler2_head_x_ + span_crank1_head_x_ - span_crank2_head_x_;
    const double phi_dot_B2_x_ = -coupler2_omega_*span_coupler2_head_y_ - crank1_omega_*span_crank1_head_y_
        + crank2_omega_*span_crank2_head_y_;
    const double phi_B2_y_ = span_coupler2_head_y_ + span_crank1_head_y_ - span_crank2_head_y_;
    const double phi_dot_B2_y_ = coupler2_omega_*span_coupler2_head_x_ + crank1_omega_*span_crank1_head_x_
        - crank2_omega_*span_crank2_head_x_;
    const double phi_B1_x_ = -p->O1_x_ + span_coupler1_head_x_ + span_crank0_head_x_ - span_crank1_head_x_;
    const double phi_dot_B1_x_ = -coupler1_omega_*span_coupler1_head_y_ - crank0_omega_*span_crank0_head_y_
        + crank1_omega_*span_crank1_head_y_;
    const double phi_B1_y_ = span_coupler1_head_y_ + span_crank0_head_y_ - span_crank1_head_y_;
    const double phi_dot_B1_y_ = coupler1_omega_*span_coupler1_head_x_ + crank0_omega_*span_crank0_head_x_
        - crank1_omega_*span_crank1_head_x_;

    /* L D L^T of the KKT matrix */
    const double l_B2_x_crank2_theta_ = p->inverse_tree_metric_crank2_theta_*span_crank2_head_y_;
    const double l_B2_y_crank2_theta_ = -p->inverse_tree_metric_crank2_theta_*span_crank2_head_x_;
    const double l_coupler1_theta_crank0_theta_ = dot_crank0_coupler1_*p->inverse_tree_metric_crank0_theta_;
    const double l_B1_x_crank0_theta_ = -p->inverse_tree_metric_crank0_theta_*span_crank0_head_y_;
    const double l_B1_y_crank0_theta_ = p->inverse_tree_metric_crank0_theta_*span_crank0_head_x_;
    const double inverse_pivot_coupler1_theta_ = 1.0/(-dot_crank0_coupler1_*l_coupler1_theta_crank0_theta_
        + p->tree_metric_coupler1_theta_);
    const double w_B1_x_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_x_crank0_theta_ - span_coupler1_head_y_;
    const double l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const double w_B1_y_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_y_crank0_theta_ + span_coupler1_head_x_;
    const double l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const double l_crank1_theta_coupler2_theta_ = dot_crank1_coupler2_*p->inverse_tree_metric_coupler2_theta_;
    const double l_B2_x_coupler2_theta_ = -p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_y_;
    const double l_B2_y_coupler2_theta_ = p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_x_;
    const double inverse_pivot_crank1_theta_ = 1.0/(-dot_crank1_coupler2_*l_crank1_theta_coupler2_theta_
        + p->tree_metric_crank1_theta_);
    const double w_B2_x_crank1_theta_ = -dot_crank1_coupler2_*l_B2_x_coupler2_theta_ - span_crank1_head_y_;
    const double l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B2_y_crank1_theta_ = -dot_crank1_coupler2_*l_B2_y_coupler2_theta_ + span_crank1_head_x_;
    const double l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*span_crank1_head_y_;
    const double l_B1_y_crank1_theta_ = -inverse_pivot_crank1_theta_*span_crank1_head_x_;
    const double scale_B2_x_ = -l_B2_x_coupler2_theta_*span_coupler2_head_y_
        + l_B2_x_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_x_crank2_theta_*span_crank2_head_y_;
    const double scale_B2_y_ = l_B2_y_coupler2_theta_*span_coupler2_head_x_ + l_B2_y_crank1_theta_*w_B2_y_crank1_theta_
        - l_B2_y_crank2_theta_*span_crank2_head_x_;
    const double pivot_B2_x_B2_y_ = -l_B2_y_coupler2_theta_*span_coupler2_head_y_
        + l_B2_y_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_y_crank2_theta_*span_crank2_head_y_;
    const double determinant_B2_x_B2_y_ = -(pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_) + scale_B2_x_*scale_B2_y_;
    if (!(scale_B2_x_ > 0.0 && scale_B2_x_ < INFINITY))
        return 1;
    if (!(determinant_B2_x_B2_y_ > memory->least_size * scale_B2_y_ * scale_B2_x_))
        return 2;
    const double size_B2_x_ = scale_B2_x_ + scale_B2_y_;
    if (!(scale_B2_x_ > memory->least_size * size_B2_x_))
        return 1;
    if (!(determinant_B2_x_B2_y_ > memory->least_size * size_B2_x_ * scale_B2_x_))
        return 2;
    const double inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const double inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*scale_B2_y_;
    const double inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*scale_B2_x_;
    const double inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;
    const double w_B1_x_B2_x_ = -l_B1_x_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B1_x_B2_y_ = -l_B1_x_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_x_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_y_ + inverse_pivot_B2_x_*w_B1_x_B2_x_;
    const double l_B1_x_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_x_ + inverse_pivot_B2_y_*w_B1_x_B2_y_;
    const double w_B1_y_B2_x_ = -l_B1_y_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B1_y_B2_y_ = -l_B1_y_crank1_theta_*w_B2_y_crank1_theta_;
    const double l_B1_y_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_y_ + inverse_pivot_B2_x_*w_B1_y_B2_x_;
    const double l_B1_y_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_x_ + inverse_pivot_B2_y_*w_B1_y_B2_y_;
    const double scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_x_crank0_theta_*span_crank0_head_y_
        + l_B1_x_crank1_theta_*span_crank1_head_y_;
    const double scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_ + l_B1_y_crank0_theta_*span_crank0_head_x_
        - l_B1_y_crank1_theta_*span_crank1_head_x_;
    const double pivot_B1_x_ = l_B1_x_B2_x_*w_B1_x_B2_x_ + l_B1_x_B2_y_*w_B1_x_B2_y_ + scale_B1_x_;
    const double pivot_B1_y_ = l_B1_y_B2_x_*w_B1_y_B2_x_ + l_B1_y_B2_y_*w_B1_y_B2_y_ + scale_B1_y_;
    const double pivot_B1_x_B1_y_ = l_B1_y_B2_x_*w_B1_x_B2_x_ + l_B1_y_B2_y_*w_B1_x_B2_y_
        + l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_y_crank0_theta_*span_crank0_head_y_
        + l_B1_y_crank1_theta_*span_crank1_head_y_;
    const double determinant_B1_x_B1_y_ = pivot_B1_x_*pivot_B1_y_ - (pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_);
    if (!(pivot_B1_x_ > memory->least_size * scale_B1_x_))
        return 3;
    if (!(determinant_B1_x_B1_y_ > memory->least_size * scale_B1_y_ * pivot_B1_x_))
        return 4;
    const double size_B1_x_ = scale_B1_x_ + scale_B1_y_;
    if (!(pivot_B1_x_ > memory->least_size * size_B1_x_))
        return 3;
    if (!(determinant_B1_x_B1_y_ > memory->least_size * size_B1_x_ * pivot_B1_x_))
        return 4;
    const double inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const double inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*pivot_B1_y_;
    const double inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*pivot_B1_x_;
    const double inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;

    /* forward substitution */
    const double dq_z_B1_x_ = -l_B1_x_B2_x_*phi_B2_x_ - l_B1_x_B2_y_*phi_B2_y_ + phi_B1_x_;
    const double dq_z_B1_y_ = -l_B1_y_B2_x_*phi_B2_x_ - l_B1_y_B2_y_*phi_B2_y_ + phi_B1_y_;

    /* backward substitution */
    const double dq_lambda_B1_y_ = dq_z_B1_x_*inverse_cross_B1_x_B1_y_ + dq_z_B1_y_*inverse_pivot_B1_y_;
    const double dq_lambda_B1_x_ = dq_z_B1_x_*inverse_pivot_B1_x_ + dq_z_B1_y_*inverse_cross_B1_x_B1_y_;
    const double dq_lambda_B2_y_ = -dq_lambda_B1_x_*l_B1_x_B2_y_ - dq_lambda_B1_y_*l_B1_y_B2_y_
        + inverse_cross_B2_x_B2_y_*phi_B2_x_ + inverse_pivot_B2_y_*phi_B2_y_;
    const double dq_lambda_B2_x_ = -dq_lambda_B1_x_*l_B1_x_B2_x_ - dq_lambda_B1_y_*l_B1_y_B2_x_
        + inverse_cross_B2_x_B2_y_*phi_B2_y_ + inverse_pivot_B2_x_*phi_B2_x_;
    const double dq_acceleration_crank1_theta_ = -dq_lambda_B1_x_*l_B1_x_crank1_theta_
        - dq_lambda_B1_y_*l_B1_y_crank1_theta_ - dq_lambda_B2_x_*l_B2_x_crank1_theta_
        - dq_lambda_B2_y_*l_B2_y_crank1_theta_;
    const double dq_acceleration_coupler2_theta_ = -dq_acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        - dq_lambda_B2_x_*l_B2_x_coupler2_theta_ - dq_lambda_B2_y_*l_B2_y_coupler2_theta_;
    const double dq_acceleration_coupler1_theta_ = -dq_lambda_B1_x_*l_B1_x_coupler1_theta_
        - dq_lambda_B1_y_*l_B1_y_coupler1_theta_;
    const double dq_acceleration_crank0_theta_ = -dq_acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        - dq_lambda_B1_x_*l_B1_x_crank0_theta_ - dq_lambda_B1_y_*l_B1_y_crank0_theta_;
    const double dq_acceleration_crank2_theta_ = -dq_lambda_B2_x_*l_B2_x_crank2_theta_
        - dq_lambda_B2_y_*l_B2_y_crank2_theta_;

    /* forward substitution */
    const double dv_z_B1_x_ = -l_B1_x_B2_x_*phi_dot_B2_x_ - l_B1_x_B2_y_*phi_dot_B2_y_ + phi_dot_B1_x_;
    const double dv_z_B1_y_ = -l_B1_y_B2_x_*phi_dot_B2_x_ - l_B1_y_B2_y_*phi_dot_B2_y_ + phi_dot_B1_y_;

    /* backward substitution */
    const double dv_lambda_B1_y_ = dv_z_B1_x_*inverse_cross_B1_x_B1_y_ + dv_z_B1_y_*inverse_pivot_B1_y_;
    const double dv_lambda_B1_x_ = dv_z_B1_x_*inverse_pivot_B1_x_ + dv_z_B1_y_*inverse_cross_B1_x_B1_y_;
    const double dv_lambda_B2_y_ = -dv_lambda_B1_x_*l_B1_x_B2_y_ - dv_lambda_B1_y_*l_B1_y_B2_y_
        + inverse_cross_B2_x_B2_y_*phi_dot_B2_x_ + inverse_pivot_B2_y_*phi_dot_B2_y_;
    const double dv_lambda_B2_x_ = -dv_lambda_B1_x_*l_B1_x_B2_x_ - dv_lambda_B1_y_*l_B1_y_B2_x_
        + inverse_cross_B2_x_B2_y_*phi_dot_B2_y_ + inverse_pivot_B2_x_*phi_dot_B2_x_;
    const double dv_acceleration_crank1_theta_ = -dv_lambda_B1_x_*l_B1_x_crank1_theta_
        - dv_lambda_B1_y_*l_B1_y_crank1_theta_ - dv_lambda_B2_x_*l_B2_x_crank1_theta_
        - dv_lambda_B2_y_*l_B2_y_crank1_theta_;
    const double dv_acceleration_coupler2_theta_ = -dv_acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        - dv_lambda_B2_x_*l_B2_x_coupler2_theta_ - dv_lambda_B2_y_*l_B2_y_coupler2_theta_;
    const double dv_acceleration_coupler1_theta_ = -dv_lambda_B1_x_*l_B1_x_coupler1_theta_
        - dv_lambda_B1_y_*l_B1_y_coupler1_theta_;
    const double dv_acceleration_crank0_theta_ = -dv_acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        - dv_lambda_B1_x_*l_B1_x_crank0_theta_ - dv_lambda_B1_y_*l_B1_y_crank0_theta_;
    const double dv_acceleration_crank2_theta_ = -dv_lambda_B2_x_*l_B2_x_crank2_theta_
        - dv_lambda_B2_y_*l_B2_y_crank2_theta_;

    /* results */
    dq[0] = dq_acceleration_crank0_theta_;
    dv[0] = dv_acceleration_crank0_theta_;
    dq[1] = dq_acceleration_crank1_theta_;
    dv[1] = dv_acceleration_crank1_theta_;
    dq[2] = dq_acceleration_crank2_theta_;
    dv[2] = dv_acceleration_crank2_theta_;
    dq[3] = dq_acceleration_coupler1_theta_;
    dv[3] = dv_acceleration_coupler1_theta_;
    dq[4] = dq_acceleration_coupler2_theta_;
    dv[4] = dv_acceleration_coupler2_theta_;
    *worst = max_of(0.0, fabs(phi_B2_x_));
    *worst = max_of(*worst, fabs(phi_B2_y_));
    *worst = max_of(*worst, fabs(phi_B1_x_));
    *worst = max_of(*worst, fabs(phi_B1_y_));
    return 0;
}
