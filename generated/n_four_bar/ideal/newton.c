/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[36]; /* what linearize() found */
    double lu[111];    /* L, U and inverse pivots */
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
    const double crank0_theta = q[2];
    const double crank0_omega = v[2];
    const double crank1_theta = q[5];
    const double crank1_omega = v[5];
    const double crank2_theta = q[8];
    const double crank2_omega = v[8];
    const double coupler1_theta = q[11];
    const double coupler1_omega = v[11];
    const double coupler2_theta = q[14];
    const double coupler2_omega = v[14];
    const double acceleration_crank0_theta_2 = a[2];
    const double acceleration_crank1_theta_2 = a[5];
    const double acceleration_crank2_theta_2 = a[8];
    const double acceleration_coupler1_theta_2 = a[11];
    const double acceleration_coupler2_theta_2 = a[14];
    const double multiplier_O0_x_2 = aside->lambda[0];
    const double multiplier_O0_y_2 = aside->lambda[1];
    const double multiplier_O1_x_2 = aside->lambda[2];
    const double multiplier_O1_y_2 = aside->lambda[3];
    const double multiplier_O2_x_2 = aside->lambda[4];
    const double multiplier_O2_y_2 = aside->lambda[5];
    const double multiplier_A0_x_2 = aside->lambda[6];
    const double multiplier_A0_y_2 = aside->lambda[7];
    const double multiplier_B1_x_2 = aside->lambda[8];
    const double multiplier_B1_y_2 = aside->lambda[9];
    const double multiplier_A1_x_2 = aside->lambda[10];
    const double multiplier_A1_y_2 = aside->lambda[11];
    const double multiplier_B2_x_2 = aside->lambda[12];
    const double multiplier_B2_y_2 = aside->lambda[13];

    /* parameters */
    const double crank0_head_x = p->crank0_head_x;
    const double crank1_head_x = p->crank1_head_x;
    const double crank2_head_x = p->crank2_head_x;
    const double coupler1_head_x = p->coupler1_head_x;
    const double coupler2_head_x = p->coupler2_head_x;
    const double two_alpha = p->two_alpha;

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*crank0_head_x;
    const double arm_crank0_head_y = crank0_head_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*crank1_head_x;
    const double arm_crank1_head_y = crank1_head_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*crank2_head_x;
    const double arm_crank2_head_y = crank2_head_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*coupler1_head_x;
    const double arm_coupler1_head_y = coupler1_head_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*coupler2_head_x;
    const double arm_coupler2_head_y = coupler2_head_x*sin_theta_coupler2;

    /* results */
    lin->value[0] = -arm_crank0_head_y;
    lin->value[1] = arm_crank0_head_x;
    lin->value[2] = -arm_crank1_head_y;
    lin->value[3] = arm_crank1_head_x;
    lin->value[4] = -arm_crank2_head_y;
    lin->value[5] = arm_crank2_head_x;
    lin->value[6] = -arm_coupler1_head_y;
    lin->value[7] = arm_coupler1_head_x;
    lin->value[8] = -arm_coupler2_head_y;
    lin->value[9] = arm_coupler2_head_x;
    lin->value[10] = -acceleration_crank0_theta_2*arm_crank0_head_x - arm_crank0_head_x*crank0_omega*two_alpha
        + arm_crank0_head_y*(crank0_omega * crank0_omega);
    lin->value[11] = -acceleration_crank0_theta_2*arm_crank0_head_y - arm_crank0_head_x*(crank0_omega *
        crank0_omega) - arm_crank0_head_y*crank0_omega*two_alpha;
    lin->value[12] = -acceleration_crank1_theta_2*arm_crank1_head_x - arm_crank1_head_x*crank1_omega*two_alpha
        + arm_crank1_head_y*(crank1_omega * crank1_omega);
    lin->value[13] = -acceleration_crank1_theta_2*arm_crank1_head_y - arm_crank1_head_x*(crank1_omega *
        crank1_omega) - arm_crank1_head_y*crank1_omega*two_alpha;
    lin->value[14] = -acceleration_crank2_theta_2*arm_crank2_head_x - arm_crank2_head_x*crank2_omega*two_alpha
        + arm_crank2_head_y*(crank2_omega * crank2_omega);
    lin->value[15] = -acceleration_crank2_theta_2*arm_crank2_head_y - arm_crank2_head_x*(crank2_omega *
        crank2_omega) - arm_crank2_head_y*crank2_omega*two_alpha;
    lin->value[16] = -acceleration_coupler1_theta_2*arm_coupler1_head_x -
        arm_coupler1_head_x*coupler1_omega*two_alpha + arm_coupler1_head_y*(coupler1_omega * coupler1_omega);
    lin->value[17] = -acceleration_coupler1_theta_2*arm_coupler1_head_y - arm_coupler1_head_x*(coupler1_omega
        * coupler1_omega) - arm_coupler1_head_y*coupler1_omega*two_alpha;
    lin->value[18] = -acceleration_coupler2_theta_2*arm_coupler2_head_x -
        arm_coupler2_head_x*coupler2_omega*two_alpha + arm_coupler2_head_y*(coupler2_omega * coupler2_omega);
    lin->value[19] = -acceleration_coupler2_theta_2*arm_coupler2_head_y - arm_coupler2_head_x*(coupler2_omega
        * coupler2_omega) - arm_coupler2_head_y*coupler2_omega*two_alpha;
    lin->value[20] = arm_crank0_head_x*(-multiplier_A0_x_2 - multiplier_O0_x_2) -
        arm_crank0_head_y*(multiplier_A0_y_2 + multiplier_O0_y_2);
    lin->value[21] = arm_crank1_head_x*(-multiplier_A1_x_2 + multiplier_B1_x_2 - multiplier_O1_x_2) -
        arm_crank1_head_y*(multiplier_A1_y_2 - multiplier_B1_y_2 + multiplier_O1_y_2);
    lin->value[22] = arm_crank2_head_x*(multiplier_B2_x_2 - multiplier_O2_x_2) -
        arm_crank2_head_y*(-multiplier_B2_y_2 + multiplier_O2_y_2);
    lin->value[23] = arm_coupler1_head_x*(-multiplier_A0_x_2 - multiplier_B1_x_2) -
        arm_coupler1_head_y*(multiplier_A0_y_2 + multiplier_B1_y_2);
    lin->value[24] = arm_coupler2_head_x*(-multiplier_A1_x_2 - multiplier_B2_x_2) -
        arm_coupler2_head_y*(multiplier_A1_y_2 + multiplier_B2_y_2);
    lin->value[25] = -2.0*arm_crank0_head_x*crank0_omega;
    lin->value[26] = -2.0*arm_crank0_head_y*crank0_omega;
    lin->value[27] = -2.0*arm_crank1_head_x*crank1_omega;
    lin->value[28] = -2.0*arm_crank1_head_y*crank1_omega;
    lin->value[29] = -2.0*arm_crank2_head_x*crank2_omega;
    lin->value[30] = -2.0*arm_crank2_head_y*crank2_omega;
    lin->value[31] = -2.0*arm_coupler1_head_x*coupler1_omega;
    lin->value[32] = -2.0*arm_coupler1_head_y*coupler1_omega;
    lin->value[33] = -2.0*arm_coupler2_head_x*coupler2_omega;
    lin->value[34] = -2.0*arm_coupler2_head_y*coupler2_omega;
    lin->value[35] = -1.0;
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
    const double phi_O0_x_crank0_theta = lin->value[0];
    const double phi_O0_y_crank0_theta = lin->value[1];
    const double phi_O1_x_crank1_theta = lin->value[2];
    const double phi_O1_y_crank1_theta = lin->value[3];
    const double phi_O2_x_crank2_theta = lin->value[4];
    const double phi_O2_y_crank2_theta = lin->value[5];
    const double phi_A0_x_coupler1_theta = lin->value[6];
    const double phi_A0_y_coupler1_theta = lin->value[7];
    const double phi_A1_x_coupler2_theta = lin->value[8];
    const double phi_A1_y_coupler2_theta = lin->value[9];
    const double by_q_O0_x_crank0_theta = lin->value[10];
    const double by_q_O0_y_crank0_theta = lin->value[11];
    const double by_q_O1_x_crank1_theta = lin->value[12];
    const double by_q_O1_y_crank1_theta = lin->value[13];
    const double by_q_O2_x_crank2_theta = lin->value[14];
    const double by_q_O2_y_crank2_theta = lin->value[15];
    const double by_q_A0_x_coupler1_theta = lin->value[16];
    const double by_q_A0_y_coupler1_theta = lin->value[17];
    const double by_q_A1_x_coupler2_theta = lin->value[18];
    const double by_q_A1_y_coupler2_theta = lin->value[19];
    const double by_q_crank0_theta_crank0_theta = lin->value[20];
    const double by_q_crank1_theta_crank1_theta = lin->value[21];
    const double by_q_crank2_theta_crank2_theta = lin->value[22];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[23];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[24];
    const double by_v_O0_x_crank0_theta = lin->value[25];
    const double by_v_O0_y_crank0_theta = lin->value[26];
    const double by_v_O1_x_crank1_theta = lin->value[27];
    const double by_v_O1_y_crank1_theta = lin->value[28];
    const double by_v_O2_x_crank2_theta = lin->value[29];
    const double by_v_O2_y_crank2_theta = lin->value[30];
    const double by_v_A0_x_coupler1_theta = lin->value[31];
    const double by_v_A0_y_coupler1_theta = lin->value[32];
    const double by_v_A1_x_coupler2_theta = lin->value[33];
    const double by_v_A1_y_coupler2_theta = lin->value[34];

    /* parameters */
    const double crank0_inertia = p->crank0_inertia;
    const double crank1_inertia = p->crank1_inertia;
    const double crank2_inertia = p->crank2_inertia;
    const double coupler1_inertia = p->coupler1_inertia;
    const double coupler2_inertia = p->coupler2_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double inverse_crank0_mass = p->inverse_crank0_mass;
    const double inverse_crank2_mass = p->inverse_crank2_mass;
    const double inverse_coupler1_mass = p->inverse_coupler1_mass;
    const double inverse_coupler2_mass = p->inverse_coupler2_mass;
    const double inverse_crank1_mass = p->inverse_crank1_mass;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_crank0_theta__crank0_theta = by_q_crank0_theta_crank0_theta*(eta * eta) + crank0_inertia;
    const double n_crank1_theta__crank1_theta = by_q_crank1_theta_crank1_theta*(eta * eta) + crank1_inertia;
    const double n_crank2_theta__crank2_theta = by_q_crank2_theta_crank2_theta*(eta * eta) + crank2_inertia;
    const double n_coupler1_theta__coupler1_theta = by_q_coupler1_theta_coupler1_theta*(eta * eta) +
        coupler1_inertia;
    const double n_coupler2_theta__coupler2_theta = by_q_coupler2_theta_coupler2_theta*(eta * eta) +
        coupler2_inertia;
    const double n_O0_x__crank0_theta = eta_row*(by_q_O0_x_crank0_theta*eta + by_v_O0_x_crank0_theta) +
        phi_O0_x_crank0_theta;
    const double n_O0_y__crank0_theta = eta_row*(by_q_O0_y_crank0_theta*eta + by_v_O0_y_crank0_theta) +
        phi_O0_y_crank0_theta;
    const double n_O1_x__crank1_theta = eta_row*(by_q_O1_x_crank1_theta*eta + by_v_O1_x_crank1_theta) +
        phi_O1_x_crank1_theta;
    const double n_O1_y__crank1_theta = eta_row*(by_q_O1_y_crank1_theta*eta + by_v_O1_y_crank1_theta) +
        phi_O1_y_crank1_theta;
    const double n_O2_x__crank2_theta = eta_row*(by_q_O2_x_crank2_theta*eta + by_v_O2_x_crank2_theta) +
        phi_O2_x_crank2_theta;
    const double n_O2_y__crank2_theta = eta_row*(by_q_O2_y_crank2_theta*eta + by_v_O2_y_crank2_theta) +
        phi_O2_y_crank2_theta;
    const double n_A0_x__crank0_theta = eta_row*(by_q_O0_x_crank0_theta*eta + by_v_O0_x_crank0_theta) +
        phi_O0_x_crank0_theta;
    const double n_A0_x__coupler1_theta = eta_row*(by_q_A0_x_coupler1_theta*eta + by_v_A0_x_coupler1_theta) +
        phi_A0_x_coupler1_theta;
    const double n_A0_y__crank0_theta = eta_row*(by_q_O0_y_crank0_theta*eta + by_v_O0_y_crank0_theta) +
        phi_O0_y_crank0_theta;
    const double n_A0_y__coupler1_theta = eta_row*(by_q_A0_y_coupler1_theta*eta + by_v_A0_y_coupler1_theta) +
        phi_A0_y_coupler1_theta;
    const double n_B1_x__crank1_theta = eta_row*(-by_q_O1_x_crank1_theta*eta - by_v_O1_x_crank1_theta) -
        phi_O1_x_crank1_theta;
    const double n_B1_x__coupler1_theta = eta_row*(by_q_A0_x_coupler1_theta*eta + by_v_A0_x_coupler1_theta) +
        phi_A0_x_coupler1_theta;
    const double n_B1_y__crank1_theta = eta_row*(-by_q_O1_y_crank1_theta*eta - by_v_O1_y_crank1_theta) -
        phi_O1_y_crank1_theta;
    const double n_B1_y__coupler1_theta = eta_row*(by_q_A0_y_coupler1_theta*eta + by_v_A0_y_coupler1_theta) +
        phi_A0_y_coupler1_theta;
    const double n_A1_x__crank1_theta = eta_row*(by_q_O1_x_crank1_theta*eta + by_v_O1_x_crank1_theta) +
        phi_O1_x_crank1_theta;
    const double n_A1_x__coupler2_theta = eta_row*(by_q_A1_x_coupler2_theta*eta + by_v_A1_x_coupler2_theta) +
        phi_A1_x_coupler2_theta;
    const double n_A1_y__crank1_theta = eta_row*(by_q_O1_y_crank1_theta*eta + by_v_O1_y_crank1_theta) +
        phi_O1_y_crank1_theta;
    const double n_A1_y__coupler2_theta = eta_row*(by_q_A1_y_coupler2_theta*eta + by_v_A1_y_coupler2_theta) +
        phi_A1_y_coupler2_theta;
    const double n_B2_x__crank2_theta = eta_row*(-by_q_O2_x_crank2_theta*eta - by_v_O2_x_crank2_theta) -
        phi_O2_x_crank2_theta;
    const double n_B2_x__coupler2_theta = eta_row*(by_q_A1_x_coupler2_theta*eta + by_v_A1_x_coupler2_theta) +
        phi_A1_x_coupler2_theta;
    const double n_B2_y__crank2_theta = eta_row*(-by_q_O2_y_crank2_theta*eta - by_v_O2_y_crank2_theta) -
        phi_O2_y_crank2_theta;
    const double n_B2_y__coupler2_theta = eta_row*(by_q_A1_y_coupler2_theta*eta + by_v_A1_y_coupler2_theta) +
        phi_A1_y_coupler2_theta;

    /* L U */
    const double scale_crank0_theta = n_crank0_theta__crank0_theta;
    if (!(fabs(scale_crank0_theta) > 1e-13 * fabs(n_crank0_theta__crank0_theta)))
        return 3;
    const double inverse_pivot_crank0_theta = 1.0/scale_crank0_theta;
    lin->lu[0] = inverse_pivot_crank0_theta;
    const double l_O0_x__crank0_theta_2 = inverse_pivot_crank0_theta*n_O0_x__crank0_theta;
    lin->lu[1] = l_O0_x__crank0_theta_2;
    const double l_O0_y__crank0_theta_2 = inverse_pivot_crank0_theta*n_O0_y__crank0_theta;
    lin->lu[2] = l_O0_y__crank0_theta_2;
    const double l_A0_x__crank0_theta_2 = inverse_pivot_crank0_theta*n_A0_x__crank0_theta;
    lin->lu[3] = l_A0_x__crank0_theta_2;
    const double l_A0_y__crank0_theta_2 = inverse_pivot_crank0_theta*n_A0_y__crank0_theta;
    lin->lu[4] = l_A0_y__crank0_theta_2;
    const double scale_O0_x_2 = -inverse_crank0_mass - l_O0_x__crank0_theta_2*phi_O0_x_crank0_theta;
    if (!(fabs(scale_O0_x_2) > 1e-08 * fabs(scale_O0_x_2)))
        return 16;
    const double inverse_pivot_O0_x_2 = 1.0/scale_O0_x_2;
    lin->lu[5] = inverse_pivot_O0_x_2;
    const double l_O0_y__O0_x_2 = -inverse_pivot_O0_x_2*l_O0_y__crank0_theta_2*phi_O0_x_crank0_theta;
    lin->lu[6] = l_O0_y__O0_x_2;
    const double u_O0_x__O0_y = -l_O0_x__crank0_theta_2*phi_O0_y_crank0_theta;
    lin->lu[7] = u_O0_x__O0_y;
    const double l_A0_x__O0_x_2 = inverse_pivot_O0_x_2*(inverse_crank0_mass -
        l_A0_x__crank0_theta_2*phi_O0_x_crank0_theta);
    lin->lu[8] = l_A0_x__O0_x_2;
    const double u_O0_x__A0_x = inverse_crank0_mass - l_O0_x__crank0_theta_2*phi_O0_x_crank0_theta;
    lin->lu[9] = u_O0_x__A0_x;
    const double l_A0_y__O0_x_2 = -inverse_pivot_O0_x_2*l_A0_y__crank0_theta_2*phi_O0_x_crank0_theta;
    lin->lu[10] = l_A0_y__O0_x_2;
    const double u_O0_x__A0_y = -l_O0_x__crank0_theta_2*phi_O0_y_crank0_theta;
    lin->lu[11] = u_O0_x__A0_y;
    const double scale_O0_y_2 = -inverse_crank0_mass - l_O0_y__crank0_theta_2*phi_O0_y_crank0_theta;
    const double pivot_O0_y_2 = -l_O0_y__O0_x_2*u_O0_x__O0_y + scale_O0_y_2;
    if (!(fabs(pivot_O0_y_2) > 1e-08 * fabs(scale_O0_y_2)))
        return 17;
    const double inverse_pivot_O0_y_2 = 1.0/pivot_O0_y_2;
    lin->lu[12] = inverse_pivot_O0_y_2;
    const double l_A0_x__O0_y_2 = inverse_pivot_O0_y_2*(-l_A0_x__O0_x_2*u_O0_x__O0_y -
        l_A0_x__crank0_theta_2*phi_O0_y_crank0_theta);
    lin->lu[13] = l_A0_x__O0_y_2;
    const double u_O0_y__A0_x = -l_O0_y__O0_x_2*u_O0_x__A0_x - l_O0_y__crank0_theta_2*phi_O0_x_crank0_theta;
    lin->lu[14] = u_O0_y__A0_x;
    const double l_A0_y__O0_y_2 = inverse_pivot_O0_y_2*(inverse_crank0_mass - l_A0_y__O0_x_2*u_O0_x__O0_y -
        l_A0_y__crank0_theta_2*phi_O0_y_crank0_theta);
    lin->lu[15] = l_A0_y__O0_y_2;
    const double u_O0_y__A0_y = inverse_crank0_mass - l_O0_y__O0_x_2*u_O0_x__A0_y -
        l_O0_y__crank0_theta_2*phi_O0_y_crank0_theta;
    lin->lu[16] = u_O0_y__A0_y;
    const double scale_crank2_theta = n_crank2_theta__crank2_theta;
    if (!(fabs(scale_crank2_theta) > 1e-13 * fabs(n_crank2_theta__crank2_theta)))
        return 9;
    const double inverse_pivot_crank2_theta = 1.0/scale_crank2_theta;
    lin->lu[17] = inverse_pivot_crank2_theta;
    const double l_O2_x__crank2_theta_2 = inverse_pivot_crank2_theta*n_O2_x__crank2_theta;
    lin->lu[18] = l_O2_x__crank2_theta_2;
    const double l_O2_y__crank2_theta_2 = inverse_pivot_crank2_theta*n_O2_y__crank2_theta;
    lin->lu[19] = l_O2_y__crank2_theta_2;
    const double l_B2_x__crank2_theta_2 = inverse_pivot_crank2_theta*n_B2_x__crank2_theta;
    lin->lu[20] = l_B2_x__crank2_theta_2;
    const double l_B2_y__crank2_theta_2 = inverse_pivot_crank2_theta*n_B2_y__crank2_theta;
    lin->lu[21] = l_B2_y__crank2_theta_2;
    const double scale_O2_x_2 = -inverse_crank2_mass - l_O2_x__crank2_theta_2*phi_O2_x_crank2_theta;
    if (!(fabs(scale_O2_x_2) > 1e-08 * fabs(scale_O2_x_2)))
        return 20;
    const double inverse_pivot_O2_x_2 = 1.0/scale_O2_x_2;
    lin->lu[22] = inverse_pivot_O2_x_2;
    const double l_O2_y__O2_x_2 = -inverse_pivot_O2_x_2*l_O2_y__crank2_theta_2*phi_O2_x_crank2_theta;
    lin->lu[23] = l_O2_y__O2_x_2;
    const double u_O2_x__O2_y = -l_O2_x__crank2_theta_2*phi_O2_y_crank2_theta;
    lin->lu[24] = u_O2_x__O2_y;
    const double l_B2_x__O2_x_2 = inverse_pivot_O2_x_2*(-inverse_crank2_mass -
        l_B2_x__crank2_theta_2*phi_O2_x_crank2_theta);
    lin->lu[25] = l_B2_x__O2_x_2;
    const double u_O2_x__B2_x = -inverse_crank2_mass + l_O2_x__crank2_theta_2*phi_O2_x_crank2_theta;
    lin->lu[26] = u_O2_x__B2_x;
    const double l_B2_y__O2_x_2 = -inverse_pivot_O2_x_2*l_B2_y__crank2_theta_2*phi_O2_x_crank2_theta;
    lin->lu[27] = l_B2_y__O2_x_2;
    const double u_O2_x__B2_y = l_O2_x__crank2_theta_2*phi_O2_y_crank2_theta;
    lin->lu[28] = u_O2_x__B2_y;
    const double scale_O2_y_2 = -inverse_crank2_mass - l_O2_y__crank2_theta_2*phi_O2_y_crank2_theta;
    const double pivot_O2_y_2 = -l_O2_y__O2_x_2*u_O2_x__O2_y + scale_O2_y_2;
    if (!(fabs(pivot_O2_y_2) > 1e-08 * fabs(scale_O2_y_2)))
        return 21;
    const double inverse_pivot_O2_y_2 = 1.0/pivot_O2_y_2;
    lin->lu[29] = inverse_pivot_O2_y_2;
    const double l_B2_x__O2_y_2 = inverse_pivot_O2_y_2*(-l_B2_x__O2_x_2*u_O2_x__O2_y -
        l_B2_x__crank2_theta_2*phi_O2_y_crank2_theta);
    lin->lu[30] = l_B2_x__O2_y_2;
    const double u_O2_y__B2_x = -l_O2_y__O2_x_2*u_O2_x__B2_x + l_O2_y__crank2_theta_2*phi_O2_x_crank2_theta;
    lin->lu[31] = u_O2_y__B2_x;
    const double l_B2_y__O2_y_2 = inverse_pivot_O2_y_2*(-inverse_crank2_mass - l_B2_y__O2_x_2*u_O2_x__O2_y -
        l_B2_y__crank2_theta_2*phi_O2_y_crank2_theta);
    lin->lu[32] = l_B2_y__O2_y_2;
    const double u_O2_y__B2_y = -inverse_crank2_mass - l_O2_y__O2_x_2*u_O2_x__B2_y +
        l_O2_y__crank2_theta_2*phi_O2_y_crank2_theta;
    lin->lu[33] = u_O2_y__B2_y;
    const double scale_coupler1_theta = n_coupler1_theta__coupler1_theta;
    if (!(fabs(scale_coupler1_theta) > 1e-13 * fabs(n_coupler1_theta__coupler1_theta)))
        return 12;
    const double inverse_pivot_coupler1_theta = 1.0/scale_coupler1_theta;
    lin->lu[34] = inverse_pivot_coupler1_theta;
    const double l_A0_x__coupler1_theta_2 = inverse_pivot_coupler1_theta*n_A0_x__coupler1_theta;
    lin->lu[35] = l_A0_x__coupler1_theta_2;
    const double l_A0_y__coupler1_theta_2 = inverse_pivot_coupler1_theta*n_A0_y__coupler1_theta;
    lin->lu[36] = l_A0_y__coupler1_theta_2;
    const double l_B1_x__coupler1_theta_2 = inverse_pivot_coupler1_theta*n_B1_x__coupler1_theta;
    lin->lu[37] = l_B1_x__coupler1_theta_2;
    const double l_B1_y__coupler1_theta_2 = inverse_pivot_coupler1_theta*n_B1_y__coupler1_theta;
    lin->lu[38] = l_B1_y__coupler1_theta_2;
    const double scale_A0_x_2 = -inverse_coupler1_mass - inverse_crank0_mass -
        l_A0_x__coupler1_theta_2*phi_A0_x_coupler1_theta - l_A0_x__crank0_theta_2*phi_O0_x_crank0_theta;
    const double pivot_A0_x_2 = -l_A0_x__O0_x_2*u_O0_x__A0_x - l_A0_x__O0_y_2*u_O0_y__A0_x + scale_A0_x_2;
    if (!(fabs(pivot_A0_x_2) > 1e-08 * fabs(scale_A0_x_2)))
        return 22;
    const double inverse_pivot_A0_x_2 = 1.0/pivot_A0_x_2;
    lin->lu[39] = inverse_pivot_A0_x_2;
    const double l_A0_y__A0_x_2 = inverse_pivot_A0_x_2*(-l_A0_y__O0_x_2*u_O0_x__A0_x -
        l_A0_y__O0_y_2*u_O0_y__A0_x - l_A0_y__coupler1_theta_2*phi_A0_x_coupler1_theta -
        l_A0_y__crank0_theta_2*phi_O0_x_crank0_theta);
    lin->lu[40] = l_A0_y__A0_x_2;
    const double u_A0_x__A0_y = -l_A0_x__O0_x_2*u_O0_x__A0_y - l_A0_x__O0_y_2*u_O0_y__A0_y -
        l_A0_x__coupler1_theta_2*phi_A0_y_coupler1_theta - l_A0_x__crank0_theta_2*phi_O0_y_crank0_theta;
    lin->lu[41] = u_A0_x__A0_y;
    const double l_B1_x__A0_x_2 = inverse_pivot_A0_x_2*(inverse_coupler1_mass -
        l_B1_x__coupler1_theta_2*phi_A0_x_coupler1_theta);
    lin->lu[42] = l_B1_x__A0_x_2;
    const double u_A0_x__B1_x = inverse_coupler1_mass - l_A0_x__coupler1_theta_2*phi_A0_x_coupler1_theta;
    lin->lu[43] = u_A0_x__B1_x;
    const double l_B1_y__A0_x_2 = -inverse_pivot_A0_x_2*l_B1_y__coupler1_theta_2*phi_A0_x_coupler1_theta;
    lin->lu[44] = l_B1_y__A0_x_2;
    const double u_A0_x__B1_y = -l_A0_x__coupler1_theta_2*phi_A0_y_coupler1_theta;
    lin->lu[45] = u_A0_x__B1_y;
    const double scale_A0_y_2 = -inverse_coupler1_mass - inverse_crank0_mass -
        l_A0_y__coupler1_theta_2*phi_A0_y_coupler1_theta - l_A0_y__crank0_theta_2*phi_O0_y_crank0_theta;
    const double pivot_A0_y_2 = -l_A0_y__A0_x_2*u_A0_x__A0_y - l_A0_y__O0_x_2*u_O0_x__A0_y -
        l_A0_y__O0_y_2*u_O0_y__A0_y + scale_A0_y_2;
    if (!(fabs(pivot_A0_y_2) > 1e-08 * fabs(scale_A0_y_2)))
        return 23;
    const double inverse_pivot_A0_y_2 = 1.0/pivot_A0_y_2;
    lin->lu[46] = inverse_pivot_A0_y_2;
    const double l_B1_x__A0_y_2 = inverse_pivot_A0_y_2*(-l_B1_x__A0_x_2*u_A0_x__A0_y -
        l_B1_x__coupler1_theta_2*phi_A0_y_coupler1_theta);
    lin->lu[47] = l_B1_x__A0_y_2;
    const double u_A0_y__B1_x = -l_A0_y__A0_x_2*u_A0_x__B1_x -
        l_A0_y__coupler1_theta_2*phi_A0_x_coupler1_theta;
    lin->lu[48] = u_A0_y__B1_x;
    const double l_B1_y__A0_y_2 = inverse_pivot_A0_y_2*(inverse_coupler1_mass - l_B1_y__A0_x_2*u_A0_x__A0_y -
        l_B1_y__coupler1_theta_2*phi_A0_y_coupler1_theta);
    lin->lu[49] = l_B1_y__A0_y_2;
    const double u_A0_y__B1_y = inverse_coupler1_mass - l_A0_y__A0_x_2*u_A0_x__B1_y -
        l_A0_y__coupler1_theta_2*phi_A0_y_coupler1_theta;
    lin->lu[50] = u_A0_y__B1_y;
    const double scale_coupler2_theta = n_coupler2_theta__coupler2_theta;
    if (!(fabs(scale_coupler2_theta) > 1e-13 * fabs(n_coupler2_theta__coupler2_theta)))
        return 15;
    const double inverse_pivot_coupler2_theta = 1.0/scale_coupler2_theta;
    lin->lu[51] = inverse_pivot_coupler2_theta;
    const double l_B2_x__coupler2_theta_2 = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta;
    lin->lu[52] = l_B2_x__coupler2_theta_2;
    const double l_B2_y__coupler2_theta_2 = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta;
    lin->lu[53] = l_B2_y__coupler2_theta_2;
    const double l_A1_x__coupler2_theta_2 = inverse_pivot_coupler2_theta*n_A1_x__coupler2_theta;
    lin->lu[54] = l_A1_x__coupler2_theta_2;
    const double l_A1_y__coupler2_theta_2 = inverse_pivot_coupler2_theta*n_A1_y__coupler2_theta;
    lin->lu[55] = l_A1_y__coupler2_theta_2;
    const double scale_B2_x_2 = -inverse_coupler2_mass - inverse_crank2_mass -
        l_B2_x__coupler2_theta_2*phi_A1_x_coupler2_theta + l_B2_x__crank2_theta_2*phi_O2_x_crank2_theta;
    const double pivot_B2_x_2 = -l_B2_x__O2_x_2*u_O2_x__B2_x - l_B2_x__O2_y_2*u_O2_y__B2_x + scale_B2_x_2;
    if (!(fabs(pivot_B2_x_2) > 1e-08 * fabs(scale_B2_x_2)))
        return 28;
    const double inverse_pivot_B2_x_2 = 1.0/pivot_B2_x_2;
    lin->lu[56] = inverse_pivot_B2_x_2;
    const double l_B2_y__B2_x_2 = inverse_pivot_B2_x_2*(-l_B2_y__O2_x_2*u_O2_x__B2_x -
        l_B2_y__O2_y_2*u_O2_y__B2_x - l_B2_y__coupler2_theta_2*phi_A1_x_coupler2_theta +
        l_B2_y__crank2_theta_2*phi_O2_x_crank2_theta);
    lin->lu[57] = l_B2_y__B2_x_2;
    const double u_B2_x__B2_y = -l_B2_x__O2_x_2*u_O2_x__B2_y - l_B2_x__O2_y_2*u_O2_y__B2_y -
        l_B2_x__coupler2_theta_2*phi_A1_y_coupler2_theta + l_B2_x__crank2_theta_2*phi_O2_y_crank2_theta;
    lin->lu[58] = u_B2_x__B2_y;
    const double l_A1_x__B2_x_2 = inverse_pivot_B2_x_2*(inverse_coupler2_mass -
        l_A1_x__coupler2_theta_2*phi_A1_x_coupler2_theta);
    lin->lu[59] = l_A1_x__B2_x_2;
    const double u_B2_x__A1_x = inverse_coupler2_mass - l_B2_x__coupler2_theta_2*phi_A1_x_coupler2_theta;
    lin->lu[60] = u_B2_x__A1_x;
    const double l_A1_y__B2_x_2 = -inverse_pivot_B2_x_2*l_A1_y__coupler2_theta_2*phi_A1_x_coupler2_theta;
    lin->lu[61] = l_A1_y__B2_x_2;
    const double u_B2_x__A1_y = -l_B2_x__coupler2_theta_2*phi_A1_y_coupler2_theta;
    lin->lu[62] = u_B2_x__A1_y;
    const double scale_B2_y_2 = -inverse_coupler2_mass - inverse_crank2_mass -
        l_B2_y__coupler2_theta_2*phi_A1_y_coupler2_theta + l_B2_y__crank2_theta_2*phi_O2_y_crank2_theta;
    const double pivot_B2_y_2 = -l_B2_y__B2_x_2*u_B2_x__B2_y - l_B2_y__O2_x_2*u_O2_x__B2_y -
        l_B2_y__O2_y_2*u_O2_y__B2_y + scale_B2_y_2;
    if (!(fabs(pivot_B2_y_2) > 1e-08 * fabs(scale_B2_y_2)))
        return 29;
    const double inverse_pivot_B2_y_2 = 1.0/pivot_B2_y_2;
    lin->lu[63] = inverse_pivot_B2_y_2;
    const double l_A1_x__B2_y_2 = inverse_pivot_B2_y_2*(-l_A1_x__B2_x_2*u_B2_x__B2_y -
        l_A1_x__coupler2_theta_2*phi_A1_y_coupler2_theta);
    lin->lu[64] = l_A1_x__B2_y_2;
    const double u_B2_y__A1_x = -l_B2_y__B2_x_2*u_B2_x__A1_x -
        l_B2_y__coupler2_theta_2*phi_A1_x_coupler2_theta;
    lin->lu[65] = u_B2_y__A1_x;
    const double l_A1_y__B2_y_2 = inverse_pivot_B2_y_2*(inverse_coupler2_mass - l_A1_y__B2_x_2*u_B2_x__B2_y -
        l_A1_y__coupler2_theta_2*phi_A1_y_coupler2_theta);
    lin->lu[66] = l_A1_y__B2_y_2;
    const double u_B2_y__A1_y = inverse_coupler2_mass - l_B2_y__B2_x_2*u_B2_x__A1_y -
        l_B2_y__coupler2_theta_2*phi_A1_y_coupler2_theta;
    lin->lu[67] = u_B2_y__A1_y;
    const double scale_crank1_theta = n_crank1_theta__crank1_theta;
    if (!(fabs(scale_crank1_theta) > 1e-13 * fabs(n_crank1_theta__crank1_theta)))
        return 6;
    const double inverse_pivot_crank1_theta = 1.0/scale_crank1_theta;
    lin->lu[68] = inverse_pivot_crank1_theta;
    const double l_O1_x__crank1_theta_2 = inverse_pivot_crank1_theta*n_O1_x__crank1_theta;
    lin->lu[69] = l_O1_x__crank1_theta_2;
    const double l_O1_y__crank1_theta_2 = inverse_pivot_crank1_theta*n_O1_y__crank1_theta;
    lin->lu[70] = l_O1_y__crank1_theta_2;
    const double l_B1_x__crank1_theta_2 = inverse_pivot_crank1_theta*n_B1_x__crank1_theta;
    lin->lu[71] = l_B1_x__crank1_theta_2;
    const double l_B1_y__crank1_theta_2 = inverse_pivot_crank1_theta*n_B1_y__crank1_theta;
    lin->lu[72] = l_B1_y__crank1_theta_2;
    const double l_A1_x__crank1_theta_2 = inverse_pivot_crank1_theta*n_A1_x__crank1_theta;
    lin->lu[73] = l_A1_x__crank1_theta_2;
    const double l_A1_y__crank1_theta_2 = inverse_pivot_crank1_theta*n_A1_y__crank1_theta;
    lin->lu[74] = l_A1_y__crank1_theta_2;
    const double scale_O1_x_2 = -inverse_crank1_mass - l_O1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    if (!(fabs(scale_O1_x_2) > 1e-08 * fabs(scale_O1_x_2)))
        return 18;
    const double inverse_pivot_O1_x_2 = 1.0/scale_O1_x_2;
    lin->lu[75] = inverse_pivot_O1_x_2;
    const double l_O1_y__O1_x_2 = -inverse_pivot_O1_x_2*l_O1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[76] = l_O1_y__O1_x_2;
    const double u_O1_x__O1_y = -l_O1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[77] = u_O1_x__O1_y;
    const double l_B1_x__O1_x_2 = inverse_pivot_O1_x_2*(-inverse_crank1_mass -
        l_B1_x__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[78] = l_B1_x__O1_x_2;
    const double u_O1_x__B1_x = -inverse_crank1_mass + l_O1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[79] = u_O1_x__B1_x;
    const double l_B1_y__O1_x_2 = -inverse_pivot_O1_x_2*l_B1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[80] = l_B1_y__O1_x_2;
    const double u_O1_x__B1_y = l_O1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[81] = u_O1_x__B1_y;
    const double l_A1_x__O1_x_2 = inverse_pivot_O1_x_2*(inverse_crank1_mass -
        l_A1_x__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[82] = l_A1_x__O1_x_2;
    const double u_O1_x__A1_x = inverse_crank1_mass - l_O1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[83] = u_O1_x__A1_x;
    const double l_A1_y__O1_x_2 = -inverse_pivot_O1_x_2*l_A1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[84] = l_A1_y__O1_x_2;
    const double u_O1_x__A1_y = -l_O1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[85] = u_O1_x__A1_y;
    const double scale_O1_y_2 = -inverse_crank1_mass - l_O1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    const double pivot_O1_y_2 = -l_O1_y__O1_x_2*u_O1_x__O1_y + scale_O1_y_2;
    if (!(fabs(pivot_O1_y_2) > 1e-08 * fabs(scale_O1_y_2)))
        return 19;
    const double inverse_pivot_O1_y_2 = 1.0/pivot_O1_y_2;
    lin->lu[86] = inverse_pivot_O1_y_2;
    const double l_B1_x__O1_y_2 = inverse_pivot_O1_y_2*(-l_B1_x__O1_x_2*u_O1_x__O1_y -
        l_B1_x__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[87] = l_B1_x__O1_y_2;
    const double u_O1_y__B1_x = -l_O1_y__O1_x_2*u_O1_x__B1_x + l_O1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[88] = u_O1_y__B1_x;
    const double l_B1_y__O1_y_2 = inverse_pivot_O1_y_2*(-inverse_crank1_mass - l_B1_y__O1_x_2*u_O1_x__O1_y -
        l_B1_y__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[89] = l_B1_y__O1_y_2;
    const double u_O1_y__B1_y = -inverse_crank1_mass - l_O1_y__O1_x_2*u_O1_x__B1_y +
        l_O1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[90] = u_O1_y__B1_y;
    const double l_A1_x__O1_y_2 = inverse_pivot_O1_y_2*(-l_A1_x__O1_x_2*u_O1_x__O1_y -
        l_A1_x__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[91] = l_A1_x__O1_y_2;
    const double u_O1_y__A1_x = -l_O1_y__O1_x_2*u_O1_x__A1_x - l_O1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[92] = u_O1_y__A1_x;
    const double l_A1_y__O1_y_2 = inverse_pivot_O1_y_2*(inverse_crank1_mass - l_A1_y__O1_x_2*u_O1_x__O1_y -
        l_A1_y__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[93] = l_A1_y__O1_y_2;
    const double u_O1_y__A1_y = inverse_crank1_mass - l_O1_y__O1_x_2*u_O1_x__A1_y -
        l_O1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[94] = u_O1_y__A1_y;
    const double scale_B1_x_2 = -inverse_coupler1_mass - inverse_crank1_mass -
        l_B1_x__coupler1_theta_2*phi_A0_x_coupler1_theta + l_B1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    const double pivot_B1_x_2 = -l_B1_x__A0_x_2*u_A0_x__B1_x - l_B1_x__A0_y_2*u_A0_y__B1_x -
        l_B1_x__O1_x_2*u_O1_x__B1_x - l_B1_x__O1_y_2*u_O1_y__B1_x + scale_B1_x_2;
    if (!(fabs(pivot_B1_x_2) > 1e-08 * fabs(scale_B1_x_2)))
        return 24;
    const double inverse_pivot_B1_x_2 = 1.0/pivot_B1_x_2;
    lin->lu[95] = inverse_pivot_B1_x_2;
    const double l_B1_y__B1_x_2 = inverse_pivot_B1_x_2*(-l_B1_y__A0_x_2*u_A0_x__B1_x -
        l_B1_y__A0_y_2*u_A0_y__B1_x - l_B1_y__O1_x_2*u_O1_x__B1_x - l_B1_y__O1_y_2*u_O1_y__B1_x -
        l_B1_y__coupler1_theta_2*phi_A0_x_coupler1_theta + l_B1_y__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[96] = l_B1_y__B1_x_2;
    const double u_B1_x__B1_y = -l_B1_x__A0_x_2*u_A0_x__B1_y - l_B1_x__A0_y_2*u_A0_y__B1_y -
        l_B1_x__O1_x_2*u_O1_x__B1_y - l_B1_x__O1_y_2*u_O1_y__B1_y -
        l_B1_x__coupler1_theta_2*phi_A0_y_coupler1_theta + l_B1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[97] = u_B1_x__B1_y;
    const double l_A1_x__B1_x_2 = inverse_pivot_B1_x_2*(inverse_crank1_mass - l_A1_x__O1_x_2*u_O1_x__B1_x -
        l_A1_x__O1_y_2*u_O1_y__B1_x + l_A1_x__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[98] = l_A1_x__B1_x_2;
    const double u_B1_x__A1_x = inverse_crank1_mass - l_B1_x__O1_x_2*u_O1_x__A1_x -
        l_B1_x__O1_y_2*u_O1_y__A1_x - l_B1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[99] = u_B1_x__A1_x;
    const double l_A1_y__B1_x_2 = inverse_pivot_B1_x_2*(-l_A1_y__O1_x_2*u_O1_x__B1_x -
        l_A1_y__O1_y_2*u_O1_y__B1_x + l_A1_y__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[100] = l_A1_y__B1_x_2;
    const double u_B1_x__A1_y = -l_B1_x__O1_x_2*u_O1_x__A1_y - l_B1_x__O1_y_2*u_O1_y__A1_y -
        l_B1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[101] = u_B1_x__A1_y;
    const double scale_B1_y_2 = -inverse_coupler1_mass - inverse_crank1_mass -
        l_B1_y__coupler1_theta_2*phi_A0_y_coupler1_theta + l_B1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    const double pivot_B1_y_2 = -l_B1_y__A0_x_2*u_A0_x__B1_y - l_B1_y__A0_y_2*u_A0_y__B1_y -
        l_B1_y__B1_x_2*u_B1_x__B1_y - l_B1_y__O1_x_2*u_O1_x__B1_y - l_B1_y__O1_y_2*u_O1_y__B1_y +
        scale_B1_y_2;
    if (!(fabs(pivot_B1_y_2) > 1e-08 * fabs(scale_B1_y_2)))
        return 25;
    const double inverse_pivot_B1_y_2 = 1.0/pivot_B1_y_2;
    lin->lu[102] = inverse_pivot_B1_y_2;
    const double l_A1_x__B1_y_2 = inverse_pivot_B1_y_2*(-l_A1_x__B1_x_2*u_B1_x__B1_y -
        l_A1_x__O1_x_2*u_O1_x__B1_y - l_A1_x__O1_y_2*u_O1_y__B1_y +
        l_A1_x__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[103] = l_A1_x__B1_y_2;
    const double u_B1_y__A1_x = -l_B1_y__B1_x_2*u_B1_x__A1_x - l_B1_y__O1_x_2*u_O1_x__A1_x -
        l_B1_y__O1_y_2*u_O1_y__A1_x - l_B1_y__crank1_theta_2*phi_O1_x_crank1_theta;
    lin->lu[104] = u_B1_y__A1_x;
    const double l_A1_y__B1_y_2 = inverse_pivot_B1_y_2*(inverse_crank1_mass - l_A1_y__B1_x_2*u_B1_x__B1_y -
        l_A1_y__O1_x_2*u_O1_x__B1_y - l_A1_y__O1_y_2*u_O1_y__B1_y +
        l_A1_y__crank1_theta_2*phi_O1_y_crank1_theta);
    lin->lu[105] = l_A1_y__B1_y_2;
    const double u_B1_y__A1_y = inverse_crank1_mass - l_B1_y__B1_x_2*u_B1_x__A1_y -
        l_B1_y__O1_x_2*u_O1_x__A1_y - l_B1_y__O1_y_2*u_O1_y__A1_y -
        l_B1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[106] = u_B1_y__A1_y;
    const double scale_A1_x_2 = -inverse_coupler2_mass - inverse_crank1_mass -
        l_A1_x__coupler2_theta_2*phi_A1_x_coupler2_theta - l_A1_x__crank1_theta_2*phi_O1_x_crank1_theta;
    const double pivot_A1_x_2 = -l_A1_x__B1_x_2*u_B1_x__A1_x - l_A1_x__B1_y_2*u_B1_y__A1_x -
        l_A1_x__B2_x_2*u_B2_x__A1_x - l_A1_x__B2_y_2*u_B2_y__A1_x - l_A1_x__O1_x_2*u_O1_x__A1_x -
        l_A1_x__O1_y_2*u_O1_y__A1_x + scale_A1_x_2;
    if (!(fabs(pivot_A1_x_2) > 1e-08 * fabs(scale_A1_x_2)))
        return 26;
    const double inverse_pivot_A1_x_2 = 1.0/pivot_A1_x_2;
    lin->lu[107] = inverse_pivot_A1_x_2;
    const double l_A1_y__A1_x_2 = inverse_pivot_A1_x_2*(-l_A1_y__B1_x_2*u_B1_x__A1_x -
        l_A1_y__B1_y_2*u_B1_y__A1_x - l_A1_y__B2_x_2*u_B2_x__A1_x - l_A1_y__B2_y_2*u_B2_y__A1_x -
        l_A1_y__O1_x_2*u_O1_x__A1_x - l_A1_y__O1_y_2*u_O1_y__A1_x -
        l_A1_y__coupler2_theta_2*phi_A1_x_coupler2_theta - l_A1_y__crank1_theta_2*phi_O1_x_crank1_theta);
    lin->lu[108] = l_A1_y__A1_x_2;
    const double u_A1_x__A1_y = -l_A1_x__B1_x_2*u_B1_x__A1_y - l_A1_x__B1_y_2*u_B1_y__A1_y -
        l_A1_x__B2_x_2*u_B2_x__A1_y - l_A1_x__B2_y_2*u_B2_y__A1_y - l_A1_x__O1_x_2*u_O1_x__A1_y -
        l_A1_x__O1_y_2*u_O1_y__A1_y - l_A1_x__coupler2_theta_2*phi_A1_y_coupler2_theta -
        l_A1_x__crank1_theta_2*phi_O1_y_crank1_theta;
    lin->lu[109] = u_A1_x__A1_y;
    const double scale_A1_y_2 = -inverse_coupler2_mass - inverse_crank1_mass -
        l_A1_y__coupler2_theta_2*phi_A1_y_coupler2_theta - l_A1_y__crank1_theta_2*phi_O1_y_crank1_theta;
    const double pivot_A1_y_2 = -l_A1_y__A1_x_2*u_A1_x__A1_y - l_A1_y__B1_x_2*u_B1_x__A1_y -
        l_A1_y__B1_y_2*u_B1_y__A1_y - l_A1_y__B2_x_2*u_B2_x__A1_y - l_A1_y__B2_y_2*u_B2_y__A1_y -
        l_A1_y__O1_x_2*u_O1_x__A1_y - l_A1_y__O1_y_2*u_O1_y__A1_y + scale_A1_y_2;
    if (!(fabs(pivot_A1_y_2) > 1e-08 * fabs(scale_A1_y_2)))
        return 27;
    const double inverse_pivot_A1_y_2 = 1.0/pivot_A1_y_2;
    lin->lu[110] = inverse_pivot_A1_y_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O0_x_crank0_theta = lin->value[0];
    const double phi_O0_y_crank0_theta = lin->value[1];
    const double phi_O1_x_crank1_theta = lin->value[2];
    const double phi_O1_y_crank1_theta = lin->value[3];
    const double phi_O2_x_crank2_theta = lin->value[4];
    const double phi_O2_y_crank2_theta = lin->value[5];
    const double phi_A0_x_coupler1_theta = lin->value[6];
    const double phi_A0_y_coupler1_theta = lin->value[7];
    const double phi_A1_x_coupler2_theta = lin->value[8];
    const double phi_A1_y_coupler2_theta = lin->value[9];
    const double inverse_pivot_crank0_theta = lin->lu[0];
    const double l_O0_x__crank0_theta_2 = lin->lu[1];
    const double l_O0_y__crank0_theta_2 = lin->lu[2];
    const double l_A0_x__crank0_theta_2 = lin->lu[3];
    const double l_A0_y__crank0_theta_2 = lin->lu[4];
    const double inverse_pivot_O0_x_2 = lin->lu[5];
    const double l_O0_y__O0_x_2 = lin->lu[6];
    const double u_O0_x__O0_y = lin->lu[7];
    const double l_A0_x__O0_x_2 = lin->lu[8];
    const double u_O0_x__A0_x = lin->lu[9];
    const double l_A0_y__O0_x_2 = lin->lu[10];
    const double u_O0_x__A0_y = lin->lu[11];
    const double inverse_pivot_O0_y_2 = lin->lu[12];
    const double l_A0_x__O0_y_2 = lin->lu[13];
    const double u_O0_y__A0_x = lin->lu[14];
    const double l_A0_y__O0_y_2 = lin->lu[15];
    const double u_O0_y__A0_y = lin->lu[16];
    const double inverse_pivot_crank2_theta = lin->lu[17];
    const double l_O2_x__crank2_theta_2 = lin->lu[18];
    const double l_O2_y__crank2_theta_2 = lin->lu[19];
    const double l_B2_x__crank2_theta_2 = lin->lu[20];
    const double l_B2_y__crank2_theta_2 = lin->lu[21];
    const double inverse_pivot_O2_x_2 = lin->lu[22];
    const double l_O2_y__O2_x_2 = lin->lu[23];
    const double u_O2_x__O2_y = lin->lu[24];
    const double l_B2_x__O2_x_2 = lin->lu[25];
    const double u_O2_x__B2_x = lin->lu[26];
    const double l_B2_y__O2_x_2 = lin->lu[27];
    const double u_O2_x__B2_y = lin->lu[28];
    const double inverse_pivot_O2_y_2 = lin->lu[29];
    const double l_B2_x__O2_y_2 = lin->lu[30];
    const double u_O2_y__B2_x = lin->lu[31];
    const double l_B2_y__O2_y_2 = lin->lu[32];
    const double u_O2_y__B2_y = lin->lu[33];
    const double inverse_pivot_coupler1_theta = lin->lu[34];
    const double l_A0_x__coupler1_theta_2 = lin->lu[35];
    const double l_A0_y__coupler1_theta_2 = lin->lu[36];
    const double l_B1_x__coupler1_theta_2 = lin->lu[37];
    const double l_B1_y__coupler1_theta_2 = lin->lu[38];
    const double inverse_pivot_A0_x_2 = lin->lu[39];
    const double l_A0_y__A0_x_2 = lin->lu[40];
    const double u_A0_x__A0_y = lin->lu[41];
    const double l_B1_x__A0_x_2 = lin->lu[42];
    const double u_A0_x__B1_x = lin->lu[43];
    const double l_B1_y__A0_x_2 = lin->lu[44];
    const double u_A0_x__B1_y = lin->lu[45];
    const double inverse_pivot_A0_y_2 = lin->lu[46];
    const double l_B1_x__A0_y_2 = lin->lu[47];
    const double u_A0_y__B1_x = lin->lu[48];
    const double l_B1_y__A0_y_2 = lin->lu[49];
    const double u_A0_y__B1_y = lin->lu[50];
    const double inverse_pivot_coupler2_theta = lin->lu[51];
    const double l_B2_x__coupler2_theta_2 = lin->lu[52];
    const double l_B2_y__coupler2_theta_2 = lin->lu[53];
    const double l_A1_x__coupler2_theta_2 = lin->lu[54];
    const double l_A1_y__coupler2_theta_2 = lin->lu[55];
    const double inverse_pivot_B2_x_2 = lin->lu[56];
    const double l_B2_y__B2_x_2 = lin->lu[57];
    const double u_B2_x__B2_y = lin->lu[58];
    const double l_A1_x__B2_x_2 = lin->lu[59];
    const double u_B2_x__A1_x = lin->lu[60];
    const double l_A1_y__B2_x_2 = lin->lu[61];
    const double u_B2_x__A1_y = lin->lu[62];
    const double inverse_pivot_B2_y_2 = lin->lu[63];
    const double l_A1_x__B2_y_2 = lin->lu[64];
    const double u_B2_y__A1_x = lin->lu[65];
    const double l_A1_y__B2_y_2 = lin->lu[66];
    const double u_B2_y__A1_y = lin->lu[67];
    const double inverse_pivot_crank1_theta = lin->lu[68];
    const double l_O1_x__crank1_theta_2 = lin->lu[69];
    const double l_O1_y__crank1_theta_2 = lin->lu[70];
    const double l_B1_x__crank1_theta_2 = lin->lu[71];
    const double l_B1_y__crank1_theta_2 = lin->lu[72];
    const double l_A1_x__crank1_theta_2 = lin->lu[73];
    const double l_A1_y__crank1_theta_2 = lin->lu[74];
    const double inverse_pivot_O1_x_2 = lin->lu[75];
    const double l_O1_y__O1_x_2 = lin->lu[76];
    const double u_O1_x__O1_y = lin->lu[77];
    const double l_B1_x__O1_x_2 = lin->lu[78];
    const double u_O1_x__B1_x = lin->lu[79];
    const double l_B1_y__O1_x_2 = lin->lu[80];
    const double u_O1_x__B1_y = lin->lu[81];
    const double l_A1_x__O1_x_2 = lin->lu[82];
    const double u_O1_x__A1_x = lin->lu[83];
    const double l_A1_y__O1_x_2 = lin->lu[84];
    const double u_O1_x__A1_y = lin->lu[85];
    const double inverse_pivot_O1_y_2 = lin->lu[86];
    const double l_B1_x__O1_y_2 = lin->lu[87];
    const double u_O1_y__B1_x = lin->lu[88];
    const double l_B1_y__O1_y_2 = lin->lu[89];
    const double u_O1_y__B1_y = lin->lu[90];
    const double l_A1_x__O1_y_2 = lin->lu[91];
    const double u_O1_y__A1_x = lin->lu[92];
    const double l_A1_y__O1_y_2 = lin->lu[93];
    const double u_O1_y__A1_y = lin->lu[94];
    const double inverse_pivot_B1_x_2 = lin->lu[95];
    const double l_B1_y__B1_x_2 = lin->lu[96];
    const double u_B1_x__B1_y = lin->lu[97];
    const double l_A1_x__B1_x_2 = lin->lu[98];
    const double u_B1_x__A1_x = lin->lu[99];
    const double l_A1_y__B1_x_2 = lin->lu[100];
    const double u_B1_x__A1_y = lin->lu[101];
    const double inverse_pivot_B1_y_2 = lin->lu[102];
    const double l_A1_x__B1_y_2 = lin->lu[103];
    const double u_B1_y__A1_x = lin->lu[104];
    const double l_A1_y__B1_y_2 = lin->lu[105];
    const double u_B1_y__A1_y = lin->lu[106];
    const double inverse_pivot_A1_x_2 = lin->lu[107];
    const double l_A1_y__A1_x_2 = lin->lu[108];
    const double u_A1_x__A1_y = lin->lu[109];
    const double inverse_pivot_A1_y_2 = lin->lu[110];

    /* parameters */
    const double inverse_crank0_mass = p->inverse_crank0_mass;
    const double inverse_crank2_mass = p->inverse_crank2_mass;
    const double inverse_coupler1_mass = p->inverse_coupler1_mass;
    const double inverse_coupler2_mass = p->inverse_coupler2_mass;
    const double inverse_crank1_mass = p->inverse_crank1_mass;

    /* forward */
    const double b_crank0_x = x[0];
    const double b_crank0_y = x[1];
    const double b_crank2_x = x[6];
    const double b_crank2_y = x[7];
    const double b_coupler1_x = x[9];
    const double b_coupler1_y = x[10];
    const double b_coupler2_x = x[12];
    const double b_coupler2_y = x[13];
    const double b_crank1_x = x[3];
    const double b_crank1_y = x[4];
    const double b_crank0_theta = x[2];
    const double b_O0_x = -b_crank0_theta*l_O0_x__crank0_theta_2 + b_crank0_x*inverse_crank0_mass + x[15];
    const double b_O0_y = -b_O0_x*l_O0_y__O0_x_2 - b_crank0_theta*l_O0_y__crank0_theta_2 +
        b_crank0_y*inverse_crank0_mass + x[16];
    const double b_crank2_theta = x[8];
    const double b_O2_x = -b_crank2_theta*l_O2_x__crank2_theta_2 + b_crank2_x*inverse_crank2_mass + x[19];
    const double b_O2_y = -b_O2_x*l_O2_y__O2_x_2 - b_crank2_theta*l_O2_y__crank2_theta_2 +
        b_crank2_y*inverse_crank2_mass + x[20];
    const double b_coupler1_theta = x[11];
    const double b_A0_x = -b_O0_x*l_A0_x__O0_x_2 - b_O0_y*l_A0_x__O0_y_2 -
        b_coupler1_theta*l_A0_x__coupler1_theta_2 + b_coupler1_x*inverse_coupler1_mass -
        b_crank0_theta*l_A0_x__crank0_theta_2 - b_crank0_x*inverse_crank0_mass + x[21];
    const double b_A0_y = -b_A0_x*l_A0_y__A0_x_2 - b_O0_x*l_A0_y__O0_x_2 - b_O0_y*l_A0_y__O0_y_2 -
        b_coupler1_theta*l_A0_y__coupler1_theta_2 + b_coupler1_y*inverse_coupler1_mass -
        b_crank0_theta*l_A0_y__crank0_theta_2 - b_crank0_y*inverse_crank0_mass + x[22];
    const double b_coupler2_theta = x[14];
    const double b_B2_x = -b_O2_x*l_B2_x__O2_x_2 - b_O2_y*l_B2_x__O2_y_2 -
        b_coupler2_theta*l_B2_x__coupler2_theta_2 - b_coupler2_x*inverse_coupler2_mass -
        b_crank2_theta*l_B2_x__crank2_theta_2 + b_crank2_x*inverse_crank2_mass + x[27];
    const double b_B2_y = -b_B2_x*l_B2_y__B2_x_2 - b_O2_x*l_B2_y__O2_x_2 - b_O2_y*l_B2_y__O2_y_2 -
        b_coupler2_theta*l_B2_y__coupler2_theta_2 - b_coupler2_y*inverse_coupler2_mass -
        b_crank2_theta*l_B2_y__crank2_theta_2 + b_crank2_y*inverse_crank2_mass + x[28];
    const double b_crank1_theta = x[5];
    const double b_O1_x = -b_crank1_theta*l_O1_x__crank1_theta_2 + b_crank1_x*inverse_crank1_mass + x[17];
    const double b_O1_y = -b_O1_x*l_O1_y__O1_x_2 - b_crank1_theta*l_O1_y__crank1_theta_2 +
        b_crank1_y*inverse_crank1_mass + x[18];
    const double b_B1_x = -b_A0_x*l_B1_x__A0_x_2 - b_A0_y*l_B1_x__A0_y_2 - b_O1_x*l_B1_x__O1_x_2 -
        b_O1_y*l_B1_x__O1_y_2 - b_coupler1_theta*l_B1_x__coupler1_theta_2 - b_coupler1_x*inverse_coupler1_mass
        - b_crank1_theta*l_B1_x__crank1_theta_2 + b_crank1_x*inverse_crank1_mass + x[23];
    const double b_B1_y = -b_A0_x*l_B1_y__A0_x_2 - b_A0_y*l_B1_y__A0_y_2 - b_B1_x*l_B1_y__B1_x_2 -
        b_O1_x*l_B1_y__O1_x_2 - b_O1_y*l_B1_y__O1_y_2 - b_coupler1_theta*l_B1_y__coupler1_theta_2 -
        b_coupler1_y*inverse_coupler1_mass - b_crank1_theta*l_B1_y__crank1_theta_2 +
        b_crank1_y*inverse_crank1_mass + x[24];
    const double b_A1_x = -b_B1_x*l_A1_x__B1_x_2 - b_B1_y*l_A1_x__B1_y_2 - b_B2_x*l_A1_x__B2_x_2 -
        b_B2_y*l_A1_x__B2_y_2 - b_O1_x*l_A1_x__O1_x_2 - b_O1_y*l_A1_x__O1_y_2 -
        b_coupler2_theta*l_A1_x__coupler2_theta_2 + b_coupler2_x*inverse_coupler2_mass -
        b_crank1_theta*l_A1_x__crank1_theta_2 - b_crank1_x*inverse_crank1_mass + x[25];
    const double b_A1_y = -b_A1_x*l_A1_y__A1_x_2 - b_B1_x*l_A1_y__B1_x_2 - b_B1_y*l_A1_y__B1_y_2 -
        b_B2_x*l_A1_y__B2_x_2 - b_B2_y*l_A1_y__B2_y_2 - b_O1_x*l_A1_y__O1_x_2 - b_O1_y*l_A1_y__O1_y_2 -
        b_coupler2_theta*l_A1_y__coupler2_theta_2 + b_coupler2_y*inverse_coupler2_mass -
        b_crank1_theta*l_A1_y__crank1_theta_2 - b_crank1_y*inverse_crank1_mass + x[26];

    /* backward */
    const double x_A1_y = b_A1_y*inverse_pivot_A1_y_2;
    x[26] = x_A1_y;
    const double x_A1_x = inverse_pivot_A1_x_2*(b_A1_x - u_A1_x__A1_y*x_A1_y);
    x[25] = x_A1_x;
    const double x_B1_y = inverse_pivot_B1_y_2*(b_B1_y - u_B1_y__A1_x*x_A1_x - u_B1_y__A1_y*x_A1_y);
    x[24] = x_B1_y;
    const double x_B1_x = inverse_pivot_B1_x_2*(b_B1_x - u_B1_x__A1_x*x_A1_x - u_B1_x__A1_y*x_A1_y -
        u_B1_x__B1_y*x_B1_y);
    x[23] = x_B1_x;
    const double x_O1_y = inverse_pivot_O1_y_2*(b_O1_y - u_O1_y__A1_x*x_A1_x - u_O1_y__A1_y*x_A1_y -
        u_O1_y__B1_x*x_B1_x - u_O1_y__B1_y*x_B1_y);
    x[18] = x_O1_y;
    const double x_O1_x = inverse_pivot_O1_x_2*(b_O1_x - u_O1_x__A1_x*x_A1_x - u_O1_x__A1_y*x_A1_y -
        u_O1_x__B1_x*x_B1_x - u_O1_x__B1_y*x_B1_y - u_O1_x__O1_y*x_O1_y);
    x[17] = x_O1_x;
    const double x_crank1_theta = inverse_pivot_crank1_theta*(b_crank1_theta - phi_O1_x_crank1_theta*x_A1_x +
        phi_O1_x_crank1_theta*x_B1_x - phi_O1_x_crank1_theta*x_O1_x - phi_O1_y_crank1_theta*x_A1_y +
        phi_O1_y_crank1_theta*x_B1_y - phi_O1_y_crank1_theta*x_O1_y);
    x[5] = x_crank1_theta;
    const double x_B2_y = inverse_pivot_B2_y_2*(b_B2_y - u_B2_y__A1_x*x_A1_x - u_B2_y__A1_y*x_A1_y);
    x[28] = x_B2_y;
    const double x_B2_x = inverse_pivot_B2_x_2*(b_B2_x - u_B2_x__A1_x*x_A1_x - u_B2_x__A1_y*x_A1_y -
        u_B2_x__B2_y*x_B2_y);
    x[27] = x_B2_x;
    const double x_coupler2_theta = inverse_pivot_coupler2_theta*(b_coupler2_theta -
        phi_A1_x_coupler2_theta*x_A1_x - phi_A1_x_coupler2_theta*x_B2_x - phi_A1_y_coupler2_theta*x_A1_y -
        phi_A1_y_coupler2_theta*x_B2_y);
    x[14] = x_coupler2_theta;
    const double x_A0_y = inverse_pivot_A0_y_2*(b_A0_y - u_A0_y__B1_x*x_B1_x - u_A0_y__B1_y*x_B1_y);
    x[22] = x_A0_y;
    const double x_A0_x = inverse_pivot_A0_x_2*(b_A0_x - u_A0_x__A0_y*x_A0_y - u_A0_x__B1_x*x_B1_x -
        u_A0_x__B1_y*x_B1_y);
    x[21] = x_A0_x;
    const double x_coupler1_theta = inverse_pivot_coupler1_theta*(b_coupler1_theta -
        phi_A0_x_coupler1_theta*x_A0_x - phi_A0_x_coupler1_theta*x_B1_x - phi_A0_y_coupler1_theta*x_A0_y -
        phi_A0_y_coupler1_theta*x_B1_y);
    x[11] = x_coupler1_theta;
    const double x_O2_y = inverse_pivot_O2_y_2*(b_O2_y - u_O2_y__B2_x*x_B2_x - u_O2_y__B2_y*x_B2_y);
    x[20] = x_O2_y;
    const double x_O2_x = inverse_pivot_O2_x_2*(b_O2_x - u_O2_x__B2_x*x_B2_x - u_O2_x__B2_y*x_B2_y -
        u_O2_x__O2_y*x_O2_y);
    x[19] = x_O2_x;
    const double x_crank2_theta = inverse_pivot_crank2_theta*(b_crank2_theta + phi_O2_x_crank2_theta*x_B2_x -
        phi_O2_x_crank2_theta*x_O2_x + phi_O2_y_crank2_theta*x_B2_y - phi_O2_y_crank2_theta*x_O2_y);
    x[8] = x_crank2_theta;
    const double x_O0_y = inverse_pivot_O0_y_2*(b_O0_y - u_O0_y__A0_x*x_A0_x - u_O0_y__A0_y*x_A0_y);
    x[16] = x_O0_y;
    const double x_O0_x = inverse_pivot_O0_x_2*(b_O0_x - u_O0_x__A0_x*x_A0_x - u_O0_x__A0_y*x_A0_y -
        u_O0_x__O0_y*x_O0_y);
    x[15] = x_O0_x;
    const double x_crank0_theta = inverse_pivot_crank0_theta*(b_crank0_theta - phi_O0_x_crank0_theta*x_A0_x -
        phi_O0_x_crank0_theta*x_O0_x - phi_O0_y_crank0_theta*x_A0_y - phi_O0_y_crank0_theta*x_O0_y);
    x[2] = x_crank0_theta;
    const double x_crank1_y = inverse_crank1_mass*(b_crank1_y - x_A1_y + x_B1_y + x_O1_y);
    x[4] = x_crank1_y;
    const double x_crank1_x = inverse_crank1_mass*(b_crank1_x - x_A1_x + x_B1_x + x_O1_x);
    x[3] = x_crank1_x;
    const double x_coupler2_y = inverse_coupler2_mass*(b_coupler2_y + x_A1_y - x_B2_y);
    x[13] = x_coupler2_y;
    const double x_coupler2_x = inverse_coupler2_mass*(b_coupler2_x + x_A1_x - x_B2_x);
    x[12] = x_coupler2_x;
    const double x_coupler1_y = inverse_coupler1_mass*(b_coupler1_y + x_A0_y - x_B1_y);
    x[10] = x_coupler1_y;
    const double x_coupler1_x = inverse_coupler1_mass*(b_coupler1_x + x_A0_x - x_B1_x);
    x[9] = x_coupler1_x;
    const double x_crank2_y = inverse_crank2_mass*(b_crank2_y + x_B2_y + x_O2_y);
    x[7] = x_crank2_y;
    const double x_crank2_x = inverse_crank2_mass*(b_crank2_x + x_B2_x + x_O2_x);
    x[6] = x_crank2_x;
    const double x_crank0_y = inverse_crank0_mass*(b_crank0_y - x_A0_y + x_O0_y);
    x[1] = x_crank0_y;
    const double x_crank0_x = inverse_crank0_mass*(b_crank0_x - x_A0_x + x_O0_x);
    x[0] = x_crank0_x;
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
    const double phi_O0_x_crank0_theta = lin->value[0];
    const double phi_O0_y_crank0_theta = lin->value[1];
    const double phi_O1_x_crank1_theta = lin->value[2];
    const double phi_O1_y_crank1_theta = lin->value[3];
    const double phi_O2_x_crank2_theta = lin->value[4];
    const double phi_O2_y_crank2_theta = lin->value[5];
    const double phi_A0_x_coupler1_theta = lin->value[6];
    const double phi_A0_y_coupler1_theta = lin->value[7];
    const double phi_A1_x_coupler2_theta = lin->value[8];
    const double phi_A1_y_coupler2_theta = lin->value[9];
    const double by_q_O0_x_crank0_theta = lin->value[10];
    const double by_q_O0_y_crank0_theta = lin->value[11];
    const double by_q_O1_x_crank1_theta = lin->value[12];
    const double by_q_O1_y_crank1_theta = lin->value[13];
    const double by_q_O2_x_crank2_theta = lin->value[14];
    const double by_q_O2_y_crank2_theta = lin->value[15];
    const double by_q_A0_x_coupler1_theta = lin->value[16];
    const double by_q_A0_y_coupler1_theta = lin->value[17];
    const double by_q_A1_x_coupler2_theta = lin->value[18];
    const double by_q_A1_y_coupler2_theta = lin->value[19];
    const double by_q_crank0_theta_crank0_theta = lin->value[20];
    const double by_q_crank1_theta_crank1_theta = lin->value[21];
    const double by_q_crank2_theta_crank2_theta = lin->value[22];
    const double by_q_coupler1_theta_coupler1_theta = lin->value[23];
    const double by_q_coupler2_theta_coupler2_theta = lin->value[24];

    /* parameters */
    const double crank0_mass = p->crank0_mass;
    const double crank0_inertia = p->crank0_inertia;
    const double crank1_mass = p->crank1_mass;
    const double crank1_inertia = p->crank1_inertia;
    const double crank2_mass = p->crank2_mass;
    const double crank2_inertia = p->crank2_inertia;
    const double coupler1_mass = p->coupler1_mass;
    const double coupler1_inertia = p->coupler1_inertia;
    const double coupler2_mass = p->coupler2_mass;
    const double coupler2_inertia = p->coupler2_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[29];
    const double shifted_crank0_x = -beta_squared*eta*r[0] + r[15];
    const double shifted_crank0_y = -beta_squared*eta*r[1] + r[16];
    const double shifted_crank0_theta = -beta_squared*eta*r[2] + r[17];
    const double shifted_crank1_x = -beta_squared*eta*r[3] + r[18];
    const double shifted_crank1_y = -beta_squared*eta*r[4] + r[19];
    const double shifted_crank1_theta = -beta_squared*eta*r[5] + r[20];
    const double shifted_crank2_x = -beta_squared*eta*r[6] + r[21];
    const double shifted_crank2_y = -beta_squared*eta*r[7] + r[22];
    const double shifted_crank2_theta = -beta_squared*eta*r[8] + r[23];
    const double shifted_coupler1_x = -beta_squared*eta*r[9] + r[24];
    const double shifted_coupler1_y = -beta_squared*eta*r[10] + r[25];
    const double shifted_coupler1_theta = -beta_squared*eta*r[11] + r[26];
    const double shifted_coupler2_x = -beta_squared*eta*r[12] + r[27];
    const double shifted_coupler2_y = -beta_squared*eta*r[13] + r[28];
    const double shifted_coupler2_theta = -beta_squared*eta*r[14] + r[29];
    x[0] = crank0_mass*eta*r[15];
    x[1] = crank0_mass*eta*r[16];
    x[2] = eta*(-by_q_crank0_theta_crank0_theta*eta*r[2] + crank0_inertia*r[17]);
    x[3] = crank1_mass*eta*r[18];
    x[4] = crank1_mass*eta*r[19];
    x[5] = eta*(-by_q_crank1_theta_crank1_theta*eta*r[5] + crank1_inertia*r[20]);
    x[6] = crank2_mass*eta*r[21];
    x[7] = crank2_mass*eta*r[22];
    x[8] = eta*(-by_q_crank2_theta_crank2_theta*eta*r[8] + crank2_inertia*r[23]);
    x[9] = coupler1_mass*eta*r[24];
    x[10] = coupler1_mass*eta*r[25];
    x[11] = eta*(-by_q_coupler1_theta_coupler1_theta*eta*r[11] + coupler1_inertia*r[26]);
    x[12] = coupler2_mass*eta*r[27];
    x[13] = coupler2_mass*eta*r[28];
    x[14] = eta*(-by_q_coupler2_theta_coupler2_theta*eta*r[14] + coupler2_inertia*r[29]);
    x[15] = eta_row*(-by_q_O0_x_crank0_theta*eta*r[2] + phi_O0_x_crank0_theta*shifted_crank0_theta -
        shifted_crank0_x);
    x[16] = eta_row*(-by_q_O0_y_crank0_theta*eta*r[2] + phi_O0_y_crank0_theta*shifted_crank0_theta -
        shifted_crank0_y);
    x[17] = eta_row*(-by_q_O1_x_crank1_theta*eta*r[5] + phi_O1_x_crank1_theta*shifted_crank1_theta -
        shifted_crank1_x);
    x[18] = eta_row*(-by_q_O1_y_crank1_theta*eta*r[5] + phi_O1_y_crank1_theta*shifted_crank1_theta -
        shifted_crank1_y);
    x[19] = eta_row*(-by_q_O2_x_crank2_theta*eta*r[8] + phi_O2_x_crank2_theta*shifted_crank2_theta -
        shifted_crank2_x);
    x[20] = eta_row*(-by_q_O2_y_crank2_theta*eta*r[8] + phi_O2_y_crank2_theta*shifted_crank2_theta -
        shifted_crank2_y);
    x[21] = eta_row*(-by_q_A0_x_coupler1_theta*eta*r[11] - by_q_O0_x_crank0_theta*eta*r[2] +
        phi_A0_x_coupler1_theta*shifted_coupler1_theta + phi_O0_x_crank0_theta*shifted_crank0_theta -
        shifted_coupler1_x + shifted_crank0_x);
    x[22] = eta_row*(-by_q_A0_y_coupler1_theta*eta*r[11] - by_q_O0_y_crank0_theta*eta*r[2] +
        phi_A0_y_coupler1_theta*shifted_coupler1_theta + phi_O0_y_crank0_theta*shifted_crank0_theta -
        shifted_coupler1_y + shifted_crank0_y);
    x[23] = eta_row*(-by_q_A0_x_coupler1_theta*eta*r[11] + by_q_O1_x_crank1_theta*eta*r[5] +
        phi_A0_x_coupler1_theta*shifted_coupler1_theta - phi_O1_x_crank1_theta*shifted_crank1_theta +
        shifted_coupler1_x - shifted_crank1_x);
    x[24] = eta_row*(-by_q_A0_y_coupler1_theta*eta*r[11] + by_q_O1_y_crank1_theta*eta*r[5] +
        phi_A0_y_coupler1_theta*shifted_coupler1_theta - phi_O1_y_crank1_theta*shifted_crank1_theta +
        shifted_coupler1_y - shifted_crank1_y);
    x[25] = eta_row*(-by_q_A1_x_coupler2_theta*eta*r[14] - by_q_O1_x_crank1_theta*eta*r[5] +
        phi_A1_x_coupler2_theta*shifted_coupler2_theta + phi_O1_x_crank1_theta*shifted_crank1_theta -
        shifted_coupler2_x + shifted_crank1_x);
    x[26] = eta_row*(-by_q_A1_y_coupler2_theta*eta*r[14] - by_q_O1_y_crank1_theta*eta*r[5] +
        phi_A1_y_coupler2_theta*shifted_coupler2_theta + phi_O1_y_crank1_theta*shifted_crank1_theta -
        shifted_coupler2_y + shifted_crank1_y);
    x[27] = eta_row*(-by_q_A1_x_coupler2_theta*eta*r[14] + by_q_O2_x_crank2_theta*eta*r[8] +
        phi_A1_x_coupler2_theta*shifted_coupler2_theta - phi_O2_x_crank2_theta*shifted_crank2_theta +
        shifted_coupler2_x - shifted_crank2_x);
    x[28] = eta_row*(-by_q_A1_y_coupler2_theta*eta*r[14] + by_q_O2_y_crank2_theta*eta*r[8] +
        phi_A1_y_coupler2_theta*shifted_coupler2_theta - phi_O2_y_crank2_theta*shifted_crank2_theta +
        shifted_coupler2_y - shifted_crank2_y);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[15] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[16] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[17] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[18] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[19] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[20] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[21] = x[6];
    u[7] = eta*(r[7] + x[7]);
    u[22] = x[7];
    u[8] = eta*(r[8] + x[8]);
    u[23] = x[8];
    u[9] = eta*(r[9] + x[9]);
    u[24] = x[9];
    u[10] = eta*(r[10] + x[10]);
    u[25] = x[10];
    u[11] = eta*(r[11] + x[11]);
    u[26] = x[11];
    u[12] = eta*(r[12] + x[12]);
    u[27] = x[12];
    u[13] = eta*(r[13] + x[13]);
    u[28] = x[13];
    u[14] = eta*(r[14] + x[14]);
    u[29] = x[14];
    u[30] = eta*r[30];
    u[31] = eta*r[31];
    u[32] = eta*r[32];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {15, 0, 35, 1}, {15, 2, 0, 1}, {16, 1, 35, 1}, {16, 2, 1, 1}, {17, 3, 35, 1}, {17, 5, 2, 1}, {18, 4, 35,
    1}, {18, 5, 3, 1}, {19, 6, 35, 1}, {19, 8, 4, 1}, {20, 7, 35, 1}, {20, 8, 5, 1}, {21, 0, 35, -1}, {21, 2,
    0, 1}, {21, 9, 35, 1}, {21, 11, 6, 1}, {22, 1, 35, -1}, {22, 2, 1, 1}, {22, 10, 35, 1}, {22, 11, 7, 1},
    {23, 9, 35, -1}, {23, 11, 6, 1}, {23, 3, 35, 1}, {23, 5, 2, -1}, {24, 10, 35, -1}, {24, 11, 7, 1}, {24, 4,
    35, 1}, {24, 5, 3, -1}, {25, 3, 35, -1}, {25, 5, 2, 1}, {25, 12, 35, 1}, {25, 14, 8, 1}, {26, 4, 35, -1},
    {26, 5, 3, 1}, {26, 13, 35, 1}, {26, 14, 9, 1}, {27, 12, 35, -1}, {27, 14, 8, 1}, {27, 6, 35, 1}, {27, 8,
    4, -1}, {28, 13, 35, -1}, {28, 14, 9, 1}, {28, 7, 35, 1}, {28, 8, 5, -1}
};
static const LinearEntry residual_entries[] = {
    {15, 2, 10, 1}, {16, 2, 11, 1}, {17, 5, 12, 1}, {18, 5, 13, 1}, {19, 8, 14, 1}, {20, 8, 15, 1}, {21, 11,
    16, 1}, {21, 2, 10, 1}, {22, 11, 17, 1}, {22, 2, 11, 1}, {23, 11, 16, 1}, {23, 5, 12, -1}, {24, 11, 17,
    1}, {24, 5, 13, -1}, {25, 14, 18, 1}, {25, 5, 12, 1}, {26, 14, 19, 1}, {26, 5, 13, 1}, {27, 14, 18, 1},
    {27, 8, 14, -1}, {28, 14, 19, 1}, {28, 8, 15, -1}, {2, 2, 20, 1}, {5, 5, 21, 1}, {8, 8, 22, 1}, {11, 11,
    23, 1}, {14, 14, 24, 1}, {15, 17, 25, 1}, {16, 17, 26, 1}, {17, 20, 27, 1}, {18, 20, 28, 1}, {19, 23, 29,
    1}, {20, 23, 30, 1}, {21, 26, 31, 1}, {21, 17, 25, 1}, {22, 26, 32, 1}, {22, 17, 26, 1}, {23, 26, 31, 1},
    {23, 20, 27, -1}, {24, 26, 32, 1}, {24, 20, 28, -1}, {25, 29, 33, 1}, {25, 20, 27, 1}, {26, 29, 34, 1},
    {26, 20, 28, 1}, {27, 29, 33, 1}, {27, 23, 29, -1}, {28, 29, 34, 1}, {28, 23, 30, -1}
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
    N_PHI_Q = 44,
    N_RESIDUAL = 49,
    N_RESIDUAL_T = 0,
    N_POWER = 0,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 29,
};
/*
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_Q - 1) or of R1_t, R2_t (2 N_Q); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_Q; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_Q; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_Q && (column >= N_Q || at->row < N_Q + N_ROWS)) {
            x[at->row] -= gain[column / N_Q] * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_Q; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_Q; k++) {
        out[k * stride] = column == N_Q + k ? 1.0 : 0.0;
        out[(N_Q + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_Q + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_Q + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_Q + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_Q; i++)
        out[(2 * N_Q + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now;
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = state_equation(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_Q, &now, p, dy + N_Q, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {((const Parameters *)p)->beta_squared, ((const Parameters *)p)->two_alpha};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_Q; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_Q ? J + column : f_t, column < 2 * N_Q ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_Q + w] = 0.0;
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
