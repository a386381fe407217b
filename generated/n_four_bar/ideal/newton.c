/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];
    const double a_crank0_theta = a[0];
    const double a_crank1_theta = a[1];
    const double a_crank2_theta = a[2];
    const double a_coupler1_theta = a[3];
    const double a_coupler2_theta = a[4];
    const double held_lambda_B2_x = aside->lambda[0];
    const double held_lambda_B2_y = aside->lambda[1];
    const double held_lambda_B1_x = aside->lambda[2];
    const double held_lambda_B1_y = aside->lambda[3];

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const double cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const double sin_coupler1_less_crank0 = -cos_theta_coupler1*sin_theta_crank0 + cos_theta_crank0*sin_theta_coupler1;
    const double dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const double cross_crank0_coupler1 = p->inertia_crank0_coupler1*sin_coupler1_less_crank0;
    const double cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const double sin_coupler2_less_crank1 = -cos_theta_coupler2*sin_theta_crank1 + cos_theta_crank1*sin_theta_coupler2;
    const double dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;
    const double cross_crank1_coupler2 = p->inertia_crank1_coupler2*sin_coupler2_less_crank1;

    /* results */
    lin->value[0] = dot_crank0_coupler1;
    lin->value[1] = dot_crank1_coupler2;
    lin->value[2] = -span_crank1_head_y;
    lin->value[3] = span_crank2_head_y;
    lin->value[4] = -span_coupler2_head_y;
    lin->value[5] = span_crank1_head_x;
    lin->value[6] = -span_crank2_head_x;
    lin->value[7] = span_coupler2_head_x;
    lin->value[8] = -span_crank0_head_y;
    lin->value[9] = -span_coupler1_head_y;
    lin->value[10] = span_crank0_head_x;
    lin->value[11] = span_coupler1_head_x;
    lin->value[12] = -a_coupler2_theta*span_coupler2_head_x + (coupler2_omega * coupler2_omega)*span_coupler2_head_y
        - coupler2_omega*span_coupler2_head_x*p->two_alpha;
    lin->value[13] = -a_crank1_theta*span_crank1_head_x + (crank1_omega * crank1_omega)*span_crank1_head_y
        - crank1_omega*span_crank1_head_x*p->two_alpha;
    lin->value[14] = a_crank2_theta*span_crank2_head_x - (crank2_omega * crank2_omega)*span_crank2_head_y
        + crank2_omega*span_crank2_head_x*p->two_alpha;
    lin->value[15] = -a_coupler2_theta*span_coupler2_head_y - (coupler2_omega * coupler2_omega)*span_coupler2_head_x
        - coupler2_omega*span_coupler2_head_y*p->two_alpha;
    lin->value[16] = -a_crank1_theta*span_crank1_head_y - (crank1_omega * crank1_omega)*span_crank1_head_x
        - crank1_omega*span_crank1_head_y*p->two_alpha;
    lin->value[17] = a_crank2_theta*span_crank2_head_y + (crank2_omega * crank2_omega)*span_crank2_head_x
        + crank2_omega*span_crank2_head_y*p->two_alpha;
    lin->value[18] = -a_coupler1_theta*span_coupler1_head_x + (coupler1_omega * coupler1_omega)*span_coupler1_head_y
        - coupler1_omega*span_coupler1_head_x*p->two_alpha;
    lin->value[19] = -a_crank0_theta*span_crank0_head_x + (crank0_omega * crank0_omega)*span_crank0_head_y
        - crank0_omega*span_crank0_head_x*p->two_alpha;
    lin->value[20] = -a_coupler1_theta*span_coupler1_head_y - (coupler1_omega * coupler1_omega)*span_coupler1_head_x
        - coupler1_omega*span_coupler1_head_y*p->two_alpha;
    lin->value[21] = -a_crank0_theta*span_crank0_head_y - (crank0_omega * crank0_omega)*span_crank0_head_x
        - crank0_omega*span_crank0_head_y*p->two_alpha;
    lin->value[22] = a_coupler1_theta*cross_crank0_coupler1 + (coupler1_omega * coupler1_omega)*dot_crank0_coupler1
        - held_lambda_B1_x*span_crank0_head_x - held_lambda_B1_y*span_crank0_head_y
        + sin_theta_crank0*p->weight_crank0__across;
    lin->value[23] = -a_coupler1_theta*cross_crank0_coupler1 - (coupler1_omega * coupler1_omega)*dot_crank0_coupler1;
    lin->value[24] = a_coupler2_theta*cross_crank1_coupler2 + (coupler2_omega * coupler2_omega)*dot_crank1_coupler2
        + sin_theta_crank1*p->weight_crank1__across + span_crank1_head_x*(held_lambda_B1_x - held_lambda_B2_x)
        - span_crank1_head_y*(-held_lambda_B1_y + held_lambda_B2_y);
    lin->value[25] = -a_coupler2_theta*cross_crank1_coupler2 - (coupler2_omega * coupler2_omega)*dot_crank1_coupler2;
    lin->value[26] = held_lambda_B2_x*span_crank2_head_x + held_lambda_B2_y*span_crank2_head_y
        + sin_theta_crank2*p->weight_crank2__across;
    lin->value[27] = -a_crank0_theta*cross_crank0_coupler1 + (crank0_omega * crank0_omega)*dot_crank0_coupler1
        - held_lambda_B1_x*span_coupler1_head_x - held_lambda_B1_y*span_coupler1_head_y
        + sin_theta_coupler1*p->weight_coupler1__across;
    lin->value[28] = a_crank0_theta*cross_crank0_coupler1 - (crank0_omega * crank0_omega)*dot_crank0_coupler1;
    lin->value[29] = -a_crank1_theta*cross_crank1_coupler2 + (crank1_omega * crank1_omega)*dot_crank1_coupler2
        - held_lambda_B2_x*span_coupler2_head_x - held_lambda_B2_y*span_coupler2_head_y
        + sin_theta_coupler2*p->weight_coupler2__across;
    lin->value[30] = a_crank1_theta*cross_crank1_coupler2 - (crank1_omega * crank1_omega)*dot_crank1_coupler2;
    lin->value[31] = -2.0*coupler2_omega*span_coupler2_head_x;
    lin->value[32] = -2.0*crank1_omega*span_crank1_head_x;
    lin->value[33] = 2.0*crank2_omega*span_crank2_head_x;
    lin->value[34] = -2.0*coupler2_omega*span_coupler2_head_y;
    lin->value[35] = -2.0*crank1_omega*span_crank1_head_y;
    lin->value[36] = 2.0*crank2_omega*span_crank2_head_y;
    lin->value[37] = -2.0*coupler1_omega*span_coupler1_head_x;
    lin->value[38] = -2.0*crank0_omega*span_crank0_head_x;
    lin->value[39] = -2.0*coupler1_omega*span_coupler1_head_y;
    lin->value[40] = -2.0*crank0_omega*span_crank0_head_y;
    lin->value[41] = -2.0*coupler1_omega*cross_crank0_coupler1;
    lin->value[42] = -2.0*coupler2_omega*cross_crank1_coupler2;
    lin->value[43] = 2.0*crank0_omega*cross_crank0_coupler1;
    lin->value[44] = 2.0*crank1_omega*cross_crank1_coupler2;
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
    const double mass_crank0_theta_coupler1_theta = lin->value[0];
    const double mass_crank1_theta_coupler2_theta = lin->value[1];
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_x_coupler1_theta = lin->value[9];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double phi_B1_y_coupler1_theta = lin->value[11];
    const double by_q_B2_x_coupler2_theta = lin->value[12];
    const double by_q_B2_x_crank1_theta = lin->value[13];
    const double by_q_B2_x_crank2_theta = lin->value[14];
    const double by_q_B2_y_coupler2_theta = lin->value[15];
    const double by_q_B2_y_crank1_theta = lin->value[16];
    const double by_q_B2_y_crank2_theta = lin->value[17];
    const double by_q_B1_x_coupler1_theta = lin->value[18];
    const double by_q_B1_x_crank0_theta = lin->value[19];
    const double by_q_B1_y_coupler1_theta = lin->value[20];
    const double by_q_B1_y_crank0_theta = lin->value[21];
    const double by_q_crank0_theta_crank0_theta = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta = lin->value[23];
    const double by_q_crank1_theta_crank1_theta = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta = lin->value[25];
    const double by_q_crank2_theta_crank2_theta = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta = lin->value[30];
    const double by_v_B2_x_coupler2_theta = lin->value[31];
    const double by_v_B2_x_crank1_theta = lin->value[32];
    const double by_v_B2_x_crank2_theta = lin->value[33];
    const double by_v_B2_y_coupler2_theta = lin->value[34];
    const double by_v_B2_y_crank1_theta = lin->value[35];
    const double by_v_B2_y_crank2_theta = lin->value[36];
    const double by_v_B1_x_coupler1_theta = lin->value[37];
    const double by_v_B1_x_crank0_theta = lin->value[38];
    const double by_v_B1_y_coupler1_theta = lin->value[39];
    const double by_v_B1_y_crank0_theta = lin->value[40];
    const double by_v_crank0_theta_coupler1_theta = lin->value[41];
    const double by_v_crank1_theta_coupler2_theta = lin->value[42];
    const double by_v_coupler1_theta_crank0_theta = lin->value[43];
    const double by_v_coupler2_theta_crank1_theta = lin->value[44];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_crank0_theta__crank0_theta = by_q_crank0_theta_crank0_theta*(eta * eta) + p->mass_crank0_crank0;
    const double n_crank0_theta__coupler1_theta = eta*(by_q_crank0_theta_coupler1_theta*eta
        + by_v_crank0_theta_coupler1_theta) + mass_crank0_theta_coupler1_theta;
    const double n_crank1_theta__crank1_theta = by_q_crank1_theta_crank1_theta*(eta * eta) + p->mass_crank1_crank1;
    const double n_crank1_theta__coupler2_theta = eta*(by_q_crank1_theta_coupler2_theta*eta
        + by_v_crank1_theta_coupler2_theta) + mass_crank1_theta_coupler2_theta;
    const double n_crank2_theta__crank2_theta = by_q_crank2_theta_crank2_theta*(eta * eta) + p->mass_crank2_crank2;
    const double n_coupler1_theta__crank0_theta = eta*(by_q_coupler1_theta_crank0_theta*eta
        + by_v_coupler1_theta_crank0_theta) + mass_crank0_theta_coupler1_theta;
    const double n_coupler1_theta__coupler1_theta = by_q_coupler1_theta_coupler1_theta*(eta * eta)
        + p->mass_coupler1_coupler1;
    const double n_coupler2_theta__crank1_theta = eta*(by_q_coupler2_theta_crank1_theta*eta
        + by_v_coupler2_theta_crank1_theta) + mass_crank1_theta_coupler2_theta;
    const double n_coupler2_theta__coupler2_theta = by_q_coupler2_theta_coupler2_theta*(eta * eta)
        + p->mass_coupler2_coupler2;
    const double n_B2_x__crank1_theta = eta_row*(by_q_B2_x_crank1_theta*eta + by_v_B2_x_crank1_theta)
        + phi_B2_x_crank1_theta;
    const double n_B2_x__crank2_theta = eta_row*(by_q_B2_x_crank2_theta*eta + by_v_B2_x_crank2_theta)
        + phi_B2_x_crank2_theta;
    const double n_B2_x__coupler2_theta = eta_row*(by_q_B2_x_coupler2_theta*eta + by_v_B2_x_coupler2_theta)
        + phi_B2_x_coupler2_theta;
    const double n_B2_y__crank1_theta = eta_row*(by_q_B2_y_crank1_theta*eta + by_v_B2_y_crank1_theta)
        + phi_B2_y_crank1_theta;
    const double n_B2_y__crank2_theta = eta_row*(by_q_B2_y_crank2_theta*eta + by_v_B2_y_crank2_theta)
        + phi_B2_y_crank2_theta;
    const double n_B2_y__coupler2_theta = eta_row*(by_q_B2_y_coupler2_theta*eta + by_v_B2_y_coupler2_theta)
        + phi_B2_y_coupler2_theta;
    const double n_B1_x__crank0_theta = eta_row*(by_q_B1_x_crank0_theta*eta + by_v_B1_x_crank0_theta)
        + phi_B1_x_crank0_theta;
    const double n_B1_x__crank1_theta = eta_row*(-by_q_B2_x_crank1_theta*eta - by_v_B2_x_crank1_theta)
        - phi_B2_x_crank1_theta;
    const double n_B1_x__coupler1_theta = eta_row*(by_q_B1_x_coupler1_theta*eta + by_v_B1_x_coupler1_theta)
        + phi_B1_x_coupler1_theta;
    const double n_B1_y__crank0_theta = eta_row*(by_q_B1_y_crank0_theta*eta + by_v_B1_y_crank0_theta)
        + phi_B1_y_crank0_theta;
    const double n_B1_y__crank1_theta = eta_row*(-by_q_B2_y_crank1_theta*eta - by_v_B2_y_crank1_theta)
        - phi_B2_y_crank1_theta;
    const double n_B1_y__coupler1_theta = eta_row*(by_q_B1_y_coupler1_theta*eta + by_v_B1_y_coupler1_theta)
        + phi_B1_y_coupler1_theta;

    /* L U */
    const double scale_crank2_theta = n_crank2_theta__crank2_theta;
    if (!(fabs(scale_crank2_theta) > SINGULAR * fabs(n_crank2_theta__crank2_theta)))
        return 3;
    const double inverse_pivot_crank2_theta = 1.0/scale_crank2_theta;
    lin->lu[0] = inverse_pivot_crank2_theta;
    const double l_B2_x__crank2_theta = inverse_pivot_crank2_theta*n_B2_x__crank2_theta;
    lin->lu[1] = l_B2_x__crank2_theta;
    const double l_B2_y__crank2_theta = inverse_pivot_crank2_theta*n_B2_y__crank2_theta;
    lin->lu[2] = l_B2_y__crank2_theta;
    const double scale_crank0_theta = n_crank0_theta__crank0_theta;
    if (!(fabs(scale_crank0_theta) > SINGULAR * fabs(n_crank0_theta__crank0_theta)))
        return 1;
    const double inverse_pivot_crank0_theta = 1.0/scale_crank0_theta;
    lin->lu[3] = inverse_pivot_crank0_theta;
    const double l_coupler1_theta__crank0_theta = inverse_pivot_crank0_theta*n_coupler1_theta__crank0_theta;
    lin->lu[4] = l_coupler1_theta__crank0_theta;
    lin->lu[5] = n_crank0_theta__coupler1_theta;
    const double l_B1_x__crank0_theta = inverse_pivot_crank0_theta*n_B1_x__crank0_theta;
    lin->lu[6] = l_B1_x__crank0_theta;
    const double l_B1_y__crank0_theta = inverse_pivot_crank0_theta*n_B1_y__crank0_theta;
    lin->lu[7] = l_B1_y__crank0_theta;
    const double scale_coupler1_theta = -l_coupler1_theta__crank0_theta*n_crank0_theta__coupler1_theta
        + n_coupler1_theta__coupler1_theta;
    if (!(fabs(scale_coupler1_theta) > SINGULAR * fabs(n_coupler1_theta__coupler1_theta)))
        return 4;
    const double inverse_pivot_coupler1_theta = 1.0/scale_coupler1_theta;
    lin->lu[8] = inverse_pivot_coupler1_theta;
    const double l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_x__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_x__coupler1_theta);
    lin->lu[9] = l_B1_x__coupler1_theta;
    const double u_coupler1_theta__B1_x = -l_coupler1_theta__crank0_theta*phi_B1_x_crank0_theta
        + phi_B1_x_coupler1_theta;
    lin->lu[10] = u_coupler1_theta__B1_x;
    const double l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_y__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_y__coupler1_theta);
    lin->lu[11] = l_B1_y__coupler1_theta;
    const double u_coupler1_theta__B1_y = -l_coupler1_theta__crank0_theta*phi_B1_y_crank0_theta
        + phi_B1_y_coupler1_theta;
    lin->lu[12] = u_coupler1_theta__B1_y;
    const double scale_coupler2_theta = n_coupler2_theta__coupler2_theta;
    if (!(fabs(scale_coupler2_theta) > SINGULAR * fabs(n_coupler2_theta__coupler2_theta)))
        return 5;
    const double inverse_pivot_coupler2_theta = 1.0/scale_coupler2_theta;
    lin->lu[13] = inverse_pivot_coupler2_theta;
    const double l_crank1_theta__coupler2_theta = inverse_pivot_coupler2_theta*n_crank1_theta__coupler2_theta;
    lin->lu[14] = l_crank1_theta__coupler2_theta;
    lin->lu[15] = n_coupler2_theta__crank1_theta;
    const double l_B2_x__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta;
    lin->lu[16] = l_B2_x__coupler2_theta;
    const double l_B2_y__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta;
    lin->lu[17] = l_B2_y__coupler2_theta;
    const double scale_crank1_theta = -l_crank1_theta__coupler2_theta*n_coupler2_theta__crank1_theta
        + n_crank1_theta__crank1_theta;
    if (!(fabs(scale_crank1_theta) > SINGULAR * fabs(n_crank1_theta__crank1_theta)))
        return 2;
    const double inverse_pivot_crank1_theta = 1.0/scale_crank1_theta;
    lin->lu[18] = inverse_pivot_crank1_theta;
    const double l_B2_x__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_x__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_x__crank1_theta);
    lin->lu[19] = l_B2_x__crank1_theta;
    const double u_crank1_theta__B2_x = -l_crank1_theta__coupler2_theta*phi_B2_x_coupler2_theta + phi_B2_x_crank1_theta;
    lin->lu[20] = u_crank1_theta__B2_x;
    const double l_B2_y__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_y__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_y__crank1_theta);
    lin->lu[21] = l_B2_y__crank1_theta;
    const double u_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*phi_B2_y_coupler2_theta + phi_B2_y_crank1_theta;
    lin->lu[22] = u_crank1_theta__B2_y;
    const double l_B1_x__crank1_theta = inverse_pivot_crank1_theta*n_B1_x__crank1_theta;
    lin->lu[23] = l_B1_x__crank1_theta;
    const double l_B1_y__crank1_theta = inverse_pivot_crank1_theta*n_B1_y__crank1_theta;
    lin->lu[24] = l_B1_y__crank1_theta;
    const double scale_B2_x = -l_B2_x__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_x - l_B2_x__crank2_theta*phi_B2_x_crank2_theta;
    if (!(scale_B2_x != 0.0 && isfinite(scale_B2_x)))
        return 6;
    const double inverse_pivot_B2_x = 1.0/scale_B2_x;
    lin->lu[25] = inverse_pivot_B2_x;
    const double l_B2_y__B2_x = inverse_pivot_B2_x*(-l_B2_y__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_x - l_B2_y__crank2_theta*phi_B2_x_crank2_theta);
    lin->lu[26] = l_B2_y__B2_x;
    const double u_B2_x__B2_y = -l_B2_x__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_y - l_B2_x__crank2_theta*phi_B2_y_crank2_theta;
    lin->lu[27] = u_B2_x__B2_y;
    const double l_B1_x__B2_x = -inverse_pivot_B2_x*l_B1_x__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[28] = l_B1_x__B2_x;
    const double u_B2_x__B1_x = l_B2_x__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[29] = u_B2_x__B1_x;
    const double l_B1_y__B2_x = -inverse_pivot_B2_x*l_B1_y__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[30] = l_B1_y__B2_x;
    const double u_B2_x__B1_y = l_B2_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[31] = u_B2_x__B1_y;
    const double scale_B2_y = -l_B2_y__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_y - l_B2_y__crank2_theta*phi_B2_y_crank2_theta;
    const double pivot_B2_y = -l_B2_y__B2_x*u_B2_x__B2_y + scale_B2_y;
    if (!(fabs(pivot_B2_y) > SINGULAR * fabs(scale_B2_y)))
        return 7;
    const double inverse_pivot_B2_y = 1.0/pivot_B2_y;
    lin->lu[32] = inverse_pivot_B2_y;
    const double l_B1_x__B2_y = inverse_pivot_B2_y*(-l_B1_x__B2_x*u_B2_x__B2_y
        - l_B1_x__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[33] = l_B1_x__B2_y;
    const double u_B2_y__B1_x = -l_B2_y__B2_x*u_B2_x__B1_x + l_B2_y__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[34] = u_B2_y__B1_x;
    const double l_B1_y__B2_y = inverse_pivot_B2_y*(-l_B1_y__B2_x*u_B2_x__B2_y
        - l_B1_y__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[35] = l_B1_y__B2_y;
    const double u_B2_y__B1_y = -l_B2_y__B2_x*u_B2_x__B1_y + l_B2_y__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[36] = u_B2_y__B1_y;
    const double scale_B1_x = -l_B1_x__coupler1_theta*u_coupler1_theta__B1_x
        - l_B1_x__crank0_theta*phi_B1_x_crank0_theta + l_B1_x__crank1_theta*phi_B2_x_crank1_theta;
    const double pivot_B1_x = -l_B1_x__B2_x*u_B2_x__B1_x - l_B1_x__B2_y*u_B2_y__B1_x + scale_B1_x;
    if (!(fabs(pivot_B1_x) > SINGULAR * fabs(scale_B1_x)))
        return 8;
    const double inverse_pivot_B1_x = 1.0/pivot_B1_x;
    lin->lu[37] = inverse_pivot_B1_x;
    const double l_B1_y__B1_x = inverse_pivot_B1_x*(-l_B1_y__B2_x*u_B2_x__B1_x - l_B1_y__B2_y*u_B2_y__B1_x
        - l_B1_y__coupler1_theta*u_coupler1_theta__B1_x - l_B1_y__crank0_theta*phi_B1_x_crank0_theta
        + l_B1_y__crank1_theta*phi_B2_x_crank1_theta);
    lin->lu[38] = l_B1_y__B1_x;
    const double u_B1_x__B1_y = -l_B1_x__B2_x*u_B2_x__B1_y - l_B1_x__B2_y*u_B2_y__B1_y
        - l_B1_x__coupler1_theta*u_coupler1_theta__B1_y - l_B1_x__crank0_theta*phi_B1_y_crank0_theta
        + l_B1_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[39] = u_B1_x__B1_y;
    const double scale_B1_y = -l_B1_y__coupler1_theta*u_coupler1_theta__B1_y
        - l_B1_y__crank0_theta*phi_B1_y_crank0_theta + l_B1_y__crank1_theta*phi_B2_y_crank1_theta;
    const double pivot_B1_y = -l_B1_y__B1_x*u_B1_x__B1_y - l_B1_y__B2_x*u_B2_x__B1_y - l_B1_y__B2_y*u_B2_y__B1_y
        + scale_B1_y;
    if (!(fabs(pivot_B1_y) > SINGULAR * fabs(scale_B1_y)))
        return 9;
    const double inverse_pivot_B1_y = 1.0/pivot_B1_y;
    lin->lu[40] = inverse_pivot_B1_y;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double inverse_pivot_crank2_theta = lin->lu[0];
    const double l_B2_x__crank2_theta = lin->lu[1];
    const double l_B2_y__crank2_theta = lin->lu[2];
    const double inverse_pivot_crank0_theta = lin->lu[3];
    const double l_coupler1_theta__crank0_theta = lin->lu[4];
    const double n_crank0_theta__coupler1_theta = lin->lu[5];
    const double l_B1_x__crank0_theta = lin->lu[6];
    const double l_B1_y__crank0_theta = lin->lu[7];
    const double inverse_pivot_coupler1_theta = lin->lu[8];
    const double l_B1_x__coupler1_theta = lin->lu[9];
    const double u_coupler1_theta__B1_x = lin->lu[10];
    const double l_B1_y__coupler1_theta = lin->lu[11];
    const double u_coupler1_theta__B1_y = lin->lu[12];
    const double inverse_pivot_coupler2_theta = lin->lu[13];
    const double l_crank1_theta__coupler2_theta = lin->lu[14];
    const double n_coupler2_theta__crank1_theta = lin->lu[15];
    const double l_B2_x__coupler2_theta = lin->lu[16];
    const double l_B2_y__coupler2_theta = lin->lu[17];
    const double inverse_pivot_crank1_theta = lin->lu[18];
    const double l_B2_x__crank1_theta = lin->lu[19];
    const double u_crank1_theta__B2_x = lin->lu[20];
    const double l_B2_y__crank1_theta = lin->lu[21];
    const double u_crank1_theta__B2_y = lin->lu[22];
    const double l_B1_x__crank1_theta = lin->lu[23];
    const double l_B1_y__crank1_theta = lin->lu[24];
    const double inverse_pivot_B2_x = lin->lu[25];
    const double l_B2_y__B2_x = lin->lu[26];
    const double u_B2_x__B2_y = lin->lu[27];
    const double l_B1_x__B2_x = lin->lu[28];
    const double u_B2_x__B1_x = lin->lu[29];
    const double l_B1_y__B2_x = lin->lu[30];
    const double u_B2_x__B1_y = lin->lu[31];
    const double inverse_pivot_B2_y = lin->lu[32];
    const double l_B1_x__B2_y = lin->lu[33];
    const double u_B2_y__B1_x = lin->lu[34];
    const double l_B1_y__B2_y = lin->lu[35];
    const double u_B2_y__B1_y = lin->lu[36];
    const double inverse_pivot_B1_x = lin->lu[37];
    const double l_B1_y__B1_x = lin->lu[38];
    const double u_B1_x__B1_y = lin->lu[39];
    const double inverse_pivot_B1_y = lin->lu[40];

    /* forward */
    const double b_crank2_theta = x[2];
    const double b_crank0_theta = x[0];
    const double b_coupler1_theta = -b_crank0_theta*l_coupler1_theta__crank0_theta + x[3];
    const double b_coupler2_theta = x[4];
    const double b_crank1_theta = -b_coupler2_theta*l_crank1_theta__coupler2_theta + x[1];
    const double b_B2_x = -b_coupler2_theta*l_B2_x__coupler2_theta - b_crank1_theta*l_B2_x__crank1_theta
        - b_crank2_theta*l_B2_x__crank2_theta + x[5];
    const double b_B2_y = -b_B2_x*l_B2_y__B2_x - b_coupler2_theta*l_B2_y__coupler2_theta
        - b_crank1_theta*l_B2_y__crank1_theta - b_crank2_theta*l_B2_y__crank2_theta + x[6];
    const double b_B1_x = -b_B2_x*l_B1_x__B2_x - b_B2_y*l_B1_x__B2_y - b_coupler1_theta*l_B1_x__coupler1_theta
        - b_crank0_theta*l_B1_x__crank0_theta - b_crank1_theta*l_B1_x__crank1_theta + x[7];
    const double b_B1_y = -b_B1_x*l_B1_y__B1_x - b_B2_x*l_B1_y__B2_x - b_B2_y*l_B1_y__B2_y
        - b_coupler1_theta*l_B1_y__coupler1_theta - b_crank0_theta*l_B1_y__crank0_theta
        - b_crank1_theta*l_B1_y__crank1_theta + x[8];

    /* backward */
    const double x_B1_y = b_B1_y*inverse_pivot_B1_y;
    x[8] = x_B1_y;
    const double x_B1_x = inverse_pivot_B1_x*(b_B1_x - u_B1_x__B1_y*x_B1_y);
    x[7] = x_B1_x;
    const double x_B2_y = inverse_pivot_B2_y*(b_B2_y - u_B2_y__B1_x*x_B1_x - u_B2_y__B1_y*x_B1_y);
    x[6] = x_B2_y;
    const double x_B2_x = inverse_pivot_B2_x*(b_B2_x - u_B2_x__B1_x*x_B1_x - u_B2_x__B1_y*x_B1_y - u_B2_x__B2_y*x_B2_y);
    x[5] = x_B2_x;
    const double x_crank1_theta = inverse_pivot_crank1_theta*(b_crank1_theta + phi_B2_x_crank1_theta*x_B1_x
        + phi_B2_y_crank1_theta*x_B1_y - u_crank1_theta__B2_x*x_B2_x - u_crank1_theta__B2_y*x_B2_y);
    x[1] = x_crank1_theta;
    const double x_coupler2_theta = inverse_pivot_coupler2_theta*(b_coupler2_theta
        - n_coupler2_theta__crank1_theta*x_crank1_theta - phi_B2_x_coupler2_theta*x_B2_x
        - phi_B2_y_coupler2_theta*x_B2_y);
    x[4] = x_coupler2_theta;
    const double x_coupler1_theta = inverse_pivot_coupler1_theta*(b_coupler1_theta - u_coupler1_theta__B1_x*x_B1_x
        - u_coupler1_theta__B1_y*x_B1_y);
    x[3] = x_coupler1_theta;
    const double x_crank0_theta = inverse_pivot_crank0_theta*(b_crank0_theta
        - n_crank0_theta__coupler1_theta*x_coupler1_theta - phi_B1_x_crank0_theta*x_B1_x
        - phi_B1_y_crank0_theta*x_B1_y);
    x[0] = x_crank0_theta;
    const double x_crank2_theta = inverse_pivot_crank2_theta*(b_crank2_theta - phi_B2_x_crank2_theta*x_B2_x
        - phi_B2_y_crank2_theta*x_B2_y);
    x[2] = x_crank2_theta;
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
    const double mass_crank0_theta_coupler1_theta = lin->value[0];
    const double mass_crank1_theta_coupler2_theta = lin->value[1];
    const double phi_B2_x_crank1_theta = lin->value[2];
    const double phi_B2_x_crank2_theta = lin->value[3];
    const double phi_B2_x_coupler2_theta = lin->value[4];
    const double phi_B2_y_crank1_theta = lin->value[5];
    const double phi_B2_y_crank2_theta = lin->value[6];
    const double phi_B2_y_coupler2_theta = lin->value[7];
    const double phi_B1_x_crank0_theta = lin->value[8];
    const double phi_B1_x_coupler1_theta = lin->value[9];
    const double phi_B1_y_crank0_theta = lin->value[10];
    const double phi_B1_y_coupler1_theta = lin->value[11];
    const double by_q_B2_x_coupler2_theta = lin->value[12];
    const double by_q_B2_x_crank1_theta = lin->value[13];
    const double by_q_B2_x_crank2_theta = lin->value[14];
    const double by_q_B2_y_coupler2_theta = lin->value[15];
    const double by_q_B2_y_crank1_theta = lin->value[16];
    const double by_q_B2_y_crank2_theta = lin->value[17];
    const double by_q_B1_x_coupler1_theta = lin->value[18];
    const double by_q_B1_x_crank0_theta = lin->value[19];
    const double by_q_B1_y_coupler1_theta = lin->value[20];
    const double by_q_B1_y_crank0_theta = lin->value[21];
    const double by_q_crank0_theta_crank0_theta = lin->value[22];
    const double by_q_crank0_theta_coupler1_theta = lin->value[23];
    const double by_q_crank1_theta_crank1_theta = lin->value[24];
    const double by_q_crank1_theta_coupler2_theta = lin->value[25];
    const double by_q_crank2_theta_crank2_theta = lin->value[26];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const double by_q_coupler1_theta_crank0_theta = lin->value[28];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const double by_q_coupler2_theta_crank1_theta = lin->value[30];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[9];
    const double shifted_crank0_theta = -p->beta_squared*eta*r[0] + r[5];
    const double shifted_crank1_theta = -p->beta_squared*eta*r[1] + r[6];
    const double shifted_crank2_theta = -p->beta_squared*eta*r[2] + r[7];
    const double shifted_coupler1_theta = -p->beta_squared*eta*r[3] + r[8];
    const double shifted_coupler2_theta = -p->beta_squared*eta*r[4] + r[9];
    x[0] = eta*(-by_q_crank0_theta_coupler1_theta*eta*r[3] - by_q_crank0_theta_crank0_theta*eta*r[0]
        + p->mass_crank0_crank0*r[5] + mass_crank0_theta_coupler1_theta*r[8]);
    x[1] = eta*(-by_q_crank1_theta_coupler2_theta*eta*r[4] - by_q_crank1_theta_crank1_theta*eta*r[1]
        + p->mass_crank1_crank1*r[6] + mass_crank1_theta_coupler2_theta*r[9]);
    x[2] = eta*(-by_q_crank2_theta_crank2_theta*eta*r[2] + p->mass_crank2_crank2*r[7]);
    x[3] = eta*(-by_q_coupler1_theta_coupler1_theta*eta*r[3] - by_q_coupler1_theta_crank0_theta*eta*r[0]
        + p->mass_coupler1_coupler1*r[8] + mass_crank0_theta_coupler1_theta*r[5]);
    x[4] = eta*(-by_q_coupler2_theta_coupler2_theta*eta*r[4] - by_q_coupler2_theta_crank1_theta*eta*r[1]
        + p->mass_coupler2_coupler2*r[9] + mass_crank1_theta_coupler2_theta*r[6]);
    x[5] = eta_row*(-by_q_B2_x_coupler2_theta*eta*r[4] - by_q_B2_x_crank1_theta*eta*r[1]
        - by_q_B2_x_crank2_theta*eta*r[2] + phi_B2_x_coupler2_theta*shifted_coupler2_theta
        + phi_B2_x_crank1_theta*shifted_crank1_theta + phi_B2_x_crank2_theta*shifted_crank2_theta);
    x[6] = eta_row*(-by_q_B2_y_coupler2_theta*eta*r[4] - by_q_B2_y_crank1_theta*eta*r[1]
        - by_q_B2_y_crank2_theta*eta*r[2] + phi_B2_y_coupler2_theta*shifted_coupler2_theta
        + phi_B2_y_crank1_theta*shifted_crank1_theta + phi_B2_y_crank2_theta*shifted_crank2_theta);
    x[7] = eta_row*(-by_q_B1_x_coupler1_theta*eta*r[3] - by_q_B1_x_crank0_theta*eta*r[0]
        + by_q_B2_x_crank1_theta*eta*r[1] + phi_B1_x_coupler1_theta*shifted_coupler1_theta
        + phi_B1_x_crank0_theta*shifted_crank0_theta - phi_B2_x_crank1_theta*shifted_crank1_theta);
    x[8] = eta_row*(-by_q_B1_y_coupler1_theta*eta*r[3] - by_q_B1_y_crank0_theta*eta*r[0]
        + by_q_B2_y_crank1_theta*eta*r[1] + phi_B1_y_coupler1_theta*shifted_coupler1_theta
        + phi_B1_y_crank0_theta*shifted_crank0_theta - phi_B2_y_crank1_theta*shifted_crank1_theta);
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
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const double cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const double dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const double cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const double dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;

    /* Phi and Phi_dot */
    const double phi_B2_x = p->O1_x - p->O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;
    const double phi_dot_B2_x = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y
        + crank2_omega*span_crank2_head_y;
    const double phi_B2_y = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;
    const double phi_dot_B2_y = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x
        - crank2_omega*span_crank2_head_x;
    const double phi_B1_x = -p->O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;
    const double phi_dot_B1_x = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y
        + crank1_omega*span_crank1_head_y;
    const double phi_B1_y = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;
    const double phi_dot_B1_y = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x
        - crank1_omega*span_crank1_head_x;

    /* L D L^T of the KKT matrix */
    const double l_B2_x__crank2_theta = p->inverse_mass_crank2_crank2*span_crank2_head_y;
    const double l_B2_y__crank2_theta = -p->inverse_mass_crank2_crank2*span_crank2_head_x;
    const double l_coupler1_theta__crank0_theta = dot_crank0_coupler1*p->inverse_mass_crank0_crank0;
    const double l_B1_x__crank0_theta = -p->inverse_mass_crank0_crank0*span_crank0_head_y;
    const double l_B1_y__crank0_theta = p->inverse_mass_crank0_crank0*span_crank0_head_x;
    const double inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta
        + p->mass_coupler1_coupler1);
    const double w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const double l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const double w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const double l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const double l_crank1_theta__coupler2_theta = dot_crank1_coupler2*p->inverse_mass_coupler2_coupler2;
    const double l_B2_x__coupler2_theta = -p->inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const double l_B2_y__coupler2_theta = p->inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const double inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta
        + p->mass_crank1_crank1);
    const double w_B2_x__crank1_theta = -dot_crank1_coupler2*l_B2_x__coupler2_theta - span_crank1_head_y;
    const double l_B2_x__crank1_theta = inverse_pivot_crank1_theta*w_B2_x__crank1_theta;
    const double w_B2_y__crank1_theta = -dot_crank1_coupler2*l_B2_y__coupler2_theta + span_crank1_head_x;
    const double l_B2_y__crank1_theta = inverse_pivot_crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const double l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const double scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y + l_B2_x__crank1_theta*w_B2_x__crank1_theta
        + l_B2_x__crank2_theta*span_crank2_head_y;
    const double scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x + l_B2_y__crank1_theta*w_B2_y__crank1_theta
        - l_B2_y__crank2_theta*span_crank2_head_x;
    const double pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y
        + l_B2_y__crank1_theta*w_B2_x__crank1_theta + l_B2_y__crank2_theta*span_crank2_head_y;
    const double determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    if (!(scale_B2_x > 0.0 && scale_B2_x < INFINITY))
        return 1;
    if (!(determinant_B2_x__B2_y > memory->least_size * scale_B2_y * scale_B2_x))
        return 2;
    const double size_B2_x = scale_B2_x + scale_B2_y;
    if (!(scale_B2_x > memory->least_size * size_B2_x))
        return 1;
    if (!(determinant_B2_x__B2_y > memory->least_size * size_B2_x * scale_B2_x))
        return 2;
    const double inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const double inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const double inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const double inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const double w_B1_x__B2_x = -l_B1_x__crank1_theta*w_B2_x__crank1_theta;
    const double w_B1_x__B2_y = -l_B1_x__crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_x__B2_x = inverse_cross_B2_x__B2_y*w_B1_x__B2_y + inverse_pivot_B2_x*w_B1_x__B2_x;
    const double l_B1_x__B2_y = inverse_cross_B2_x__B2_y*w_B1_x__B2_x + inverse_pivot_B2_y*w_B1_x__B2_y;
    const double w_B1_y__B2_x = -l_B1_y__crank1_theta*w_B2_x__crank1_theta;
    const double w_B1_y__B2_y = -l_B1_y__crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_y__B2_x = inverse_cross_B2_x__B2_y*w_B1_y__B2_y + inverse_pivot_B2_x*w_B1_y__B2_x;
    const double l_B1_y__B2_y = inverse_cross_B2_x__B2_y*w_B1_y__B2_x + inverse_pivot_B2_y*w_B1_y__B2_y;
    const double scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta - l_B1_x__crank0_theta*span_crank0_head_y
        + l_B1_x__crank1_theta*span_crank1_head_y;
    const double scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta + l_B1_y__crank0_theta*span_crank0_head_x
        - l_B1_y__crank1_theta*span_crank1_head_x;
    const double pivot_B1_x = l_B1_x__B2_x*w_B1_x__B2_x + l_B1_x__B2_y*w_B1_x__B2_y + scale_B1_x;
    const double pivot_B1_y = l_B1_y__B2_x*w_B1_y__B2_x + l_B1_y__B2_y*w_B1_y__B2_y + scale_B1_y;
    const double pivot_B1_x__B1_y = l_B1_y__B2_x*w_B1_x__B2_x + l_B1_y__B2_y*w_B1_x__B2_y
        + l_B1_y__coupler1_theta*w_B1_x__coupler1_theta - l_B1_y__crank0_theta*span_crank0_head_y
        + l_B1_y__crank1_theta*span_crank1_head_y;
    const double determinant_B1_x__B1_y = pivot_B1_x*pivot_B1_y - (pivot_B1_x__B1_y * pivot_B1_x__B1_y);
    if (!(pivot_B1_x > memory->least_size * scale_B1_x))
        return 3;
    if (!(determinant_B1_x__B1_y > memory->least_size * scale_B1_y * pivot_B1_x))
        return 4;
    const double size_B1_x = scale_B1_x + scale_B1_y;
    if (!(pivot_B1_x > memory->least_size * size_B1_x))
        return 3;
    if (!(determinant_B1_x__B1_y > memory->least_size * size_B1_x * pivot_B1_x))
        return 4;
    const double inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const double inverse_pivot_B1_x = inverse_B1_x__B1_y*pivot_B1_y;
    const double inverse_pivot_B1_y = inverse_B1_x__B1_y*pivot_B1_x;
    const double inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const double dq_z_B1_x = -l_B1_x__B2_x*phi_B2_x - l_B1_x__B2_y*phi_B2_y + phi_B1_x;
    const double dq_z_B1_y = -l_B1_y__B2_x*phi_B2_x - l_B1_y__B2_y*phi_B2_y + phi_B1_y;

    /* backward substitution */
    const double dq_lambda_B1_y = dq_z_B1_x*inverse_cross_B1_x__B1_y + dq_z_B1_y*inverse_pivot_B1_y;
    const double dq_lambda_B1_x = dq_z_B1_x*inverse_pivot_B1_x + dq_z_B1_y*inverse_cross_B1_x__B1_y;
    const double dq_lambda_B2_y = -dq_lambda_B1_x*l_B1_x__B2_y - dq_lambda_B1_y*l_B1_y__B2_y
        + inverse_cross_B2_x__B2_y*phi_B2_x + inverse_pivot_B2_y*phi_B2_y;
    const double dq_lambda_B2_x = -dq_lambda_B1_x*l_B1_x__B2_x - dq_lambda_B1_y*l_B1_y__B2_x
        + inverse_cross_B2_x__B2_y*phi_B2_y + inverse_pivot_B2_x*phi_B2_x;
    const double dq_acceleration_crank1_theta = -dq_lambda_B1_x*l_B1_x__crank1_theta
        - dq_lambda_B1_y*l_B1_y__crank1_theta - dq_lambda_B2_x*l_B2_x__crank1_theta
        - dq_lambda_B2_y*l_B2_y__crank1_theta;
    const double dq_acceleration_coupler2_theta = -dq_acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        - dq_lambda_B2_x*l_B2_x__coupler2_theta - dq_lambda_B2_y*l_B2_y__coupler2_theta;
    const double dq_acceleration_coupler1_theta = -dq_lambda_B1_x*l_B1_x__coupler1_theta
        - dq_lambda_B1_y*l_B1_y__coupler1_theta;
    const double dq_acceleration_crank0_theta = -dq_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        - dq_lambda_B1_x*l_B1_x__crank0_theta - dq_lambda_B1_y*l_B1_y__crank0_theta;
    const double dq_acceleration_crank2_theta = -dq_lambda_B2_x*l_B2_x__crank2_theta
        - dq_lambda_B2_y*l_B2_y__crank2_theta;

    /* forward substitution */
    const double dv_z_B1_x = -l_B1_x__B2_x*phi_dot_B2_x - l_B1_x__B2_y*phi_dot_B2_y + phi_dot_B1_x;
    const double dv_z_B1_y = -l_B1_y__B2_x*phi_dot_B2_x - l_B1_y__B2_y*phi_dot_B2_y + phi_dot_B1_y;

    /* backward substitution */
    const double dv_lambda_B1_y = dv_z_B1_x*inverse_cross_B1_x__B1_y + dv_z_B1_y*inverse_pivot_B1_y;
    const double dv_lambda_B1_x = dv_z_B1_x*inverse_pivot_B1_x + dv_z_B1_y*inverse_cross_B1_x__B1_y;
    const double dv_lambda_B2_y = -dv_lambda_B1_x*l_B1_x__B2_y - dv_lambda_B1_y*l_B1_y__B2_y
        + inverse_cross_B2_x__B2_y*phi_dot_B2_x + inverse_pivot_B2_y*phi_dot_B2_y;
    const double dv_lambda_B2_x = -dv_lambda_B1_x*l_B1_x__B2_x - dv_lambda_B1_y*l_B1_y__B2_x
        + inverse_cross_B2_x__B2_y*phi_dot_B2_y + inverse_pivot_B2_x*phi_dot_B2_x;
    const double dv_acceleration_crank1_theta = -dv_lambda_B1_x*l_B1_x__crank1_theta
        - dv_lambda_B1_y*l_B1_y__crank1_theta - dv_lambda_B2_x*l_B2_x__crank1_theta
        - dv_lambda_B2_y*l_B2_y__crank1_theta;
    const double dv_acceleration_coupler2_theta = -dv_acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        - dv_lambda_B2_x*l_B2_x__coupler2_theta - dv_lambda_B2_y*l_B2_y__coupler2_theta;
    const double dv_acceleration_coupler1_theta = -dv_lambda_B1_x*l_B1_x__coupler1_theta
        - dv_lambda_B1_y*l_B1_y__coupler1_theta;
    const double dv_acceleration_crank0_theta = -dv_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        - dv_lambda_B1_x*l_B1_x__crank0_theta - dv_lambda_B1_y*l_B1_y__crank0_theta;
    const double dv_acceleration_crank2_theta = -dv_lambda_B2_x*l_B2_x__crank2_theta
        - dv_lambda_B2_y*l_B2_y__crank2_theta;

    /* results */
    dq[0] = dq_acceleration_crank0_theta;
    dv[0] = dv_acceleration_crank0_theta;
    dq[1] = dq_acceleration_crank1_theta;
    dv[1] = dv_acceleration_crank1_theta;
    dq[2] = dq_acceleration_crank2_theta;
    dv[2] = dv_acceleration_crank2_theta;
    dq[3] = dq_acceleration_coupler1_theta;
    dv[3] = dv_acceleration_coupler1_theta;
    dq[4] = dq_acceleration_coupler2_theta;
    dv[4] = dv_acceleration_coupler2_theta;
    *worst = max_of(0.0, fabs(phi_B2_x));
    *worst = max_of(*worst, fabs(phi_B2_y));
    *worst = max_of(*worst, fabs(phi_B1_x));
    *worst = max_of(*worst, fabs(phi_B1_y));
    return 0;
}
