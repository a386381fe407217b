/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[73]; /* what linearize() found */
    double lu[75];    /* L, U and inverse pivots */
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
    const double crank_x = q[0];
    const double crank_y = q[1];
    const double crank_theta = q[2];
    const double crank_vx = v[0];
    const double crank_vy = v[1];
    const double crank_omega = v[2];
    const double rod_x = q[3];
    const double rod_y = q[4];
    const double rod_theta = q[5];
    const double rod_vx = v[3];
    const double rod_vy = v[4];
    const double rod_omega = v[5];
    const double acceleration_crank_theta_2 = a[2];
    const double acceleration_rod_theta_2 = a[5];
    const double multiplier_pin_x_2 = aside->lambda[2];
    const double multiplier_pin_y_2 = aside->lambda[3];

    /* parameters */
    const double crank_length = p->crank_length;
    const double crank_points_middle_x = p->crank_points_middle_x;
    const double rod_points_crankpin_x = p->rod_points_crankpin_x;
    const double rod_points_middle_x = p->rod_points_middle_x;
    const double rod_points_tip_x = p->rod_points_tip_x;
    const double coil_stiffness = p->coil_stiffness;
    const double coil_free_length = p->coil_free_length;
    const double coil_damping = p->coil_damping;
    const double push_value_x = p->push_value_x;
    const double two_alpha = p->two_alpha;

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*crank_length;
    const double arm_crank_head_y = crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*rod_points_crankpin_x;
    const double arm_rod_crankpin_y = rod_points_crankpin_x*sin_theta_rod;
    const double arm_crank_middle_x = cos_theta_crank*crank_points_middle_x;
    const double arm_crank_middle_y = crank_points_middle_x*sin_theta_crank;
    const double arm_rod_middle_x = cos_theta_rod*rod_points_middle_x;
    const double arm_rod_middle_y = rod_points_middle_x*sin_theta_rod;
    const double coil_span_x = -arm_crank_middle_x + arm_rod_middle_x - crank_x + rod_x;
    const double coil_span_y = -arm_crank_middle_y + arm_rod_middle_y - crank_y + rod_y;
    const double coil_span_rate_x = arm_crank_middle_y*crank_omega - arm_rod_middle_y*rod_omega - crank_vx +
        rod_vx;
    const double coil_span_rate_y = -arm_crank_middle_x*crank_omega + arm_rod_middle_x*rod_omega - crank_vy +
        rod_vy;
    const double coil_length = sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const double coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const double coil_force = coil_damping*coil_length_rate + coil_stiffness*(-coil_free_length +
        coil_length);
    const double coil_pull = coil_force/coil_length;
    const double arm_rod_tip_x = cos_theta_rod*rod_points_tip_x;
    const double arm_rod_tip_y = rod_points_tip_x*sin_theta_rod;

    /* coordinates */
    const double inverse_denominator = 1.0/(coil_length + 1e-150);
    const double coil_length_by_crank_theta = -arm_crank_middle_x*coil_span_y*inverse_denominator +
        arm_crank_middle_y*coil_span_x*inverse_denominator;
    const double coil_length_by_rod_theta = arm_rod_middle_x*coil_span_y*inverse_denominator -
        arm_rod_middle_y*coil_span_x*inverse_denominator;
    const double coil_length_by_crank_x = -coil_span_x*inverse_denominator;
    const double coil_length_by_rod_x = coil_span_x*inverse_denominator;
    const double coil_length_by_crank_y = -coil_span_y*inverse_denominator;
    const double coil_length_by_rod_y = coil_span_y*inverse_denominator;
    const double coil_span_rate_x_by_crank_theta = arm_crank_middle_x*crank_omega;
    const double coil_span_rate_x_by_rod_theta = -arm_rod_middle_x*rod_omega;
    const double coil_span_rate_y_by_crank_theta = arm_crank_middle_y*crank_omega;
    const double coil_span_rate_y_by_rod_theta = -arm_rod_middle_y*rod_omega;
    const double inverse_coil_length = 1.0/coil_length;
    const double coil_length_rate_by_crank_theta = -arm_crank_middle_x*coil_span_rate_y*inverse_coil_length +
        arm_crank_middle_y*coil_span_rate_x*inverse_coil_length -
        coil_length_by_crank_theta*(inverse_coil_length * inverse_coil_length)*(coil_span_rate_x*coil_span_x +
        coil_span_rate_y*coil_span_y) + coil_span_rate_x_by_crank_theta*coil_span_x*inverse_coil_length +
        coil_span_rate_y_by_crank_theta*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_theta = arm_rod_middle_x*coil_span_rate_y*inverse_coil_length -
        arm_rod_middle_y*coil_span_rate_x*inverse_coil_length - coil_length_by_rod_theta*(inverse_coil_length
        * inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) +
        coil_span_rate_x_by_rod_theta*coil_span_x*inverse_coil_length +
        coil_span_rate_y_by_rod_theta*coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_crank_x = -coil_length_by_crank_x*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) -
        coil_span_rate_x*inverse_coil_length;
    const double coil_length_rate_by_rod_x = -coil_length_by_rod_x*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) +
        coil_span_rate_x*inverse_coil_length;
    const double coil_length_rate_by_crank_y = -coil_length_by_crank_y*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) -
        coil_span_rate_y*inverse_coil_length;
    const double coil_length_rate_by_rod_y = -coil_length_by_rod_y*(inverse_coil_length *
        inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y) +
        coil_span_rate_y*inverse_coil_length;
    const double coil_length_rate_by_crank_omega = -arm_crank_middle_x*coil_span_y*inverse_coil_length +
        arm_crank_middle_y*coil_span_x*inverse_coil_length;
    const double coil_length_rate_by_crank_vx = -coil_span_x*inverse_coil_length;
    const double coil_length_rate_by_rod_omega = arm_rod_middle_x*coil_span_y*inverse_coil_length -
        arm_rod_middle_y*coil_span_x*inverse_coil_length;
    const double coil_length_rate_by_rod_vx = coil_span_x*inverse_coil_length;
    const double coil_length_rate_by_crank_vy = -coil_span_y*inverse_coil_length;
    const double coil_length_rate_by_rod_vy = coil_span_y*inverse_coil_length;
    const double coil_force_by_crank_theta = coil_damping*coil_length_rate_by_crank_theta +
        coil_length_by_crank_theta*coil_stiffness;
    const double coil_force_by_rod_theta = coil_damping*coil_length_rate_by_rod_theta +
        coil_length_by_rod_theta*coil_stiffness;
    const double coil_force_by_crank_x = coil_damping*coil_length_rate_by_crank_x +
        coil_length_by_crank_x*coil_stiffness;
    const double coil_force_by_rod_x = coil_damping*coil_length_rate_by_rod_x +
        coil_length_by_rod_x*coil_stiffness;
    const double coil_force_by_crank_y = coil_damping*coil_length_rate_by_crank_y +
        coil_length_by_crank_y*coil_stiffness;
    const double coil_force_by_rod_y = coil_damping*coil_length_rate_by_rod_y +
        coil_length_by_rod_y*coil_stiffness;
    const double coil_force_by_crank_omega = coil_damping*coil_length_rate_by_crank_omega;
    const double coil_force_by_crank_vx = coil_damping*coil_length_rate_by_crank_vx;
    const double coil_force_by_rod_omega = coil_damping*coil_length_rate_by_rod_omega;
    const double coil_force_by_rod_vx = coil_damping*coil_length_rate_by_rod_vx;
    const double coil_force_by_crank_vy = coil_damping*coil_length_rate_by_crank_vy;
    const double coil_force_by_rod_vy = coil_damping*coil_length_rate_by_rod_vy;
    const double coil_pull_by_crank_theta = -coil_force*coil_length_by_crank_theta*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_crank_theta*inverse_coil_length;
    const double coil_pull_by_rod_theta = -coil_force*coil_length_by_rod_theta*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_rod_theta*inverse_coil_length;
    const double coil_pull_by_crank_x = -coil_force*coil_length_by_crank_x*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_crank_x*inverse_coil_length;
    const double coil_pull_by_rod_x = -coil_force*coil_length_by_rod_x*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_rod_x*inverse_coil_length;
    const double coil_pull_by_crank_y = -coil_force*coil_length_by_crank_y*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_crank_y*inverse_coil_length;
    const double coil_pull_by_rod_y = -coil_force*coil_length_by_rod_y*(inverse_coil_length *
        inverse_coil_length) + coil_force_by_rod_y*inverse_coil_length;
    const double coil_pull_by_crank_omega = coil_force_by_crank_omega*inverse_coil_length;
    const double coil_pull_by_crank_vx = coil_force_by_crank_vx*inverse_coil_length;
    const double coil_pull_by_rod_omega = coil_force_by_rod_omega*inverse_coil_length;
    const double coil_pull_by_rod_vx = coil_force_by_rod_vx*inverse_coil_length;
    const double coil_pull_by_crank_vy = coil_force_by_crank_vy*inverse_coil_length;
    const double coil_pull_by_rod_vy = coil_force_by_rod_vy*inverse_coil_length;

    /* results */
    lin->value[0] = -arm_crank_head_y;
    lin->value[1] = arm_rod_crankpin_y;
    lin->value[2] = arm_crank_head_x;
    lin->value[3] = -arm_rod_crankpin_x;
    lin->value[4] = -acceleration_crank_theta_2*arm_crank_head_x - arm_crank_head_x*crank_omega*two_alpha +
        arm_crank_head_y*(crank_omega * crank_omega);
    lin->value[5] = acceleration_rod_theta_2*arm_rod_crankpin_x + arm_rod_crankpin_x*rod_omega*two_alpha -
        arm_rod_crankpin_y*(rod_omega * rod_omega);
    lin->value[6] = -acceleration_crank_theta_2*arm_crank_head_y - arm_crank_head_x*(crank_omega *
        crank_omega) - arm_crank_head_y*crank_omega*two_alpha;
    lin->value[7] = acceleration_rod_theta_2*arm_rod_crankpin_y + arm_rod_crankpin_x*(rod_omega * rod_omega) +
        arm_rod_crankpin_y*rod_omega*two_alpha;
    lin->value[8] = -arm_crank_middle_y*coil_pull - coil_pull_by_crank_theta*coil_span_x;
    lin->value[9] = arm_rod_middle_y*coil_pull - coil_pull_by_rod_theta*coil_span_x;
    lin->value[10] = coil_pull - coil_pull_by_crank_x*coil_span_x;
    lin->value[11] = -coil_pull - coil_pull_by_rod_x*coil_span_x;
    lin->value[12] = -coil_pull_by_crank_y*coil_span_x;
    lin->value[13] = -coil_pull_by_rod_y*coil_span_x;
    lin->value[14] = arm_crank_middle_x*coil_pull - coil_pull_by_crank_theta*coil_span_y;
    lin->value[15] = -arm_rod_middle_x*coil_pull - coil_pull_by_rod_theta*coil_span_y;
    lin->value[16] = -coil_pull_by_crank_x*coil_span_y;
    lin->value[17] = -coil_pull_by_rod_x*coil_span_y;
    lin->value[18] = coil_pull - coil_pull_by_crank_y*coil_span_y;
    lin->value[19] = -coil_pull - coil_pull_by_rod_y*coil_span_y;
    lin->value[20] = -arm_crank_head_x*multiplier_pin_x_2 - arm_crank_head_y*multiplier_pin_y_2 +
        (arm_crank_middle_x * arm_crank_middle_x)*coil_pull + arm_crank_middle_x*coil_pull*coil_span_x +
        (arm_crank_middle_y * arm_crank_middle_y)*coil_pull + arm_crank_middle_y*coil_pull*coil_span_y +
        coil_pull_by_crank_theta*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[21] = -arm_crank_middle_x*arm_rod_middle_x*coil_pull -
        arm_crank_middle_y*arm_rod_middle_y*coil_pull +
        coil_pull_by_rod_theta*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[22] = -arm_crank_middle_y*coil_pull + coil_pull_by_crank_x*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[23] = arm_crank_middle_y*coil_pull + coil_pull_by_rod_x*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[24] = arm_crank_middle_x*coil_pull + coil_pull_by_crank_y*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[25] = -arm_crank_middle_x*coil_pull + coil_pull_by_rod_y*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[26] = arm_rod_crankpin_x*multiplier_pin_x_2 + arm_rod_crankpin_y*multiplier_pin_y_2 +
        (arm_rod_middle_x * arm_rod_middle_x)*coil_pull - arm_rod_middle_x*coil_pull*coil_span_x +
        (arm_rod_middle_y * arm_rod_middle_y)*coil_pull - arm_rod_middle_y*coil_pull*coil_span_y +
        arm_rod_tip_x*push_value_x + coil_pull_by_rod_theta*(arm_rod_middle_x*coil_span_y -
        arm_rod_middle_y*coil_span_x);
    lin->value[27] = -arm_crank_middle_x*arm_rod_middle_x*coil_pull -
        arm_crank_middle_y*arm_rod_middle_y*coil_pull + coil_pull_by_crank_theta*(arm_rod_middle_x*coil_span_y
        - arm_rod_middle_y*coil_span_x);
    lin->value[28] = arm_rod_middle_y*coil_pull + coil_pull_by_crank_x*(arm_rod_middle_x*coil_span_y -
        arm_rod_middle_y*coil_span_x);
    lin->value[29] = -arm_rod_middle_y*coil_pull + coil_pull_by_rod_x*(arm_rod_middle_x*coil_span_y -
        arm_rod_middle_y*coil_span_x);
    lin->value[30] = -arm_rod_middle_x*coil_pull + coil_pull_by_crank_y*(arm_rod_middle_x*coil_span_y -
        arm_rod_middle_y*coil_span_x);
    lin->value[31] = arm_rod_middle_x*coil_pull + coil_pull_by_rod_y*(arm_rod_middle_x*coil_span_y -
        arm_rod_middle_y*coil_span_x);
    lin->value[32] = -2.0*arm_crank_head_x*crank_omega;
    lin->value[33] = 2.0*arm_rod_crankpin_x*rod_omega;
    lin->value[34] = -2.0*arm_crank_head_y*crank_omega;
    lin->value[35] = 2.0*arm_rod_crankpin_y*rod_omega;
    lin->value[36] = -coil_pull_by_crank_omega*coil_span_x;
    lin->value[37] = -coil_pull_by_crank_vx*coil_span_x;
    lin->value[38] = -coil_pull_by_rod_omega*coil_span_x;
    lin->value[39] = -coil_pull_by_rod_vx*coil_span_x;
    lin->value[40] = -coil_pull_by_crank_vy*coil_span_x;
    lin->value[41] = -coil_pull_by_rod_vy*coil_span_x;
    lin->value[42] = -coil_pull_by_crank_omega*coil_span_y;
    lin->value[43] = -coil_pull_by_crank_vx*coil_span_y;
    lin->value[44] = -coil_pull_by_rod_omega*coil_span_y;
    lin->value[45] = -coil_pull_by_rod_vx*coil_span_y;
    lin->value[46] = -coil_pull_by_crank_vy*coil_span_y;
    lin->value[47] = -coil_pull_by_rod_vy*coil_span_y;
    lin->value[48] = coil_pull_by_crank_omega*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[49] = coil_pull_by_crank_vx*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[50] = coil_pull_by_rod_omega*(-arm_crank_middle_x*coil_span_y +
        arm_crank_middle_y*coil_span_x);
    lin->value[51] = coil_pull_by_rod_vx*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[52] = coil_pull_by_crank_vy*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[53] = coil_pull_by_rod_vy*(-arm_crank_middle_x*coil_span_y + arm_crank_middle_y*coil_span_x);
    lin->value[54] = coil_pull_by_crank_omega*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[55] = coil_pull_by_crank_vx*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[56] = coil_pull_by_rod_omega*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[57] = coil_pull_by_rod_vx*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[58] = coil_pull_by_crank_vy*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[59] = coil_pull_by_rod_vy*(arm_rod_middle_x*coil_span_y - arm_rod_middle_y*coil_span_x);
    lin->value[60] = -arm_rod_tip_x*push_value_x*rod_omega -
        2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_theta;
    lin->value[61] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_theta;
    lin->value[62] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_x;
    lin->value[63] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_x;
    lin->value[64] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_y;
    lin->value[65] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_y;
    lin->value[66] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_omega;
    lin->value[67] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_vx;
    lin->value[68] = -arm_rod_tip_y*push_value_x -
        2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_omega;
    lin->value[69] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_vx + push_value_x;
    lin->value[70] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_crank_vy;
    lin->value[71] = -2.0*coil_damping*coil_length_rate*coil_length_rate_by_rod_vy;
    lin->value[72] = -1.0;
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
    const double phi_pin_x_crank_theta = lin->value[0];
    const double phi_pin_x_rod_theta = lin->value[1];
    const double phi_pin_y_crank_theta = lin->value[2];
    const double phi_pin_y_rod_theta = lin->value[3];
    const double by_q_pin_x_crank_theta = lin->value[4];
    const double by_q_pin_x_rod_theta = lin->value[5];
    const double by_q_pin_y_crank_theta = lin->value[6];
    const double by_q_pin_y_rod_theta = lin->value[7];
    const double by_q_crank_x_crank_theta = lin->value[8];
    const double by_q_crank_x_rod_theta = lin->value[9];
    const double by_q_crank_x_crank_x = lin->value[10];
    const double by_q_crank_x_rod_x = lin->value[11];
    const double by_q_crank_x_crank_y = lin->value[12];
    const double by_q_crank_x_rod_y = lin->value[13];
    const double by_q_crank_y_crank_theta = lin->value[14];
    const double by_q_crank_y_rod_theta = lin->value[15];
    const double by_q_crank_y_crank_x = lin->value[16];
    const double by_q_crank_y_rod_x = lin->value[17];
    const double by_q_crank_y_crank_y = lin->value[18];
    const double by_q_crank_y_rod_y = lin->value[19];
    const double by_q_crank_theta_crank_theta = lin->value[20];
    const double by_q_crank_theta_rod_theta = lin->value[21];
    const double by_q_crank_theta_crank_x = lin->value[22];
    const double by_q_crank_theta_rod_x = lin->value[23];
    const double by_q_crank_theta_crank_y = lin->value[24];
    const double by_q_crank_theta_rod_y = lin->value[25];
    const double by_q_rod_theta_rod_theta = lin->value[26];
    const double by_q_rod_theta_crank_theta = lin->value[27];
    const double by_q_rod_theta_crank_x = lin->value[28];
    const double by_q_rod_theta_rod_x = lin->value[29];
    const double by_q_rod_theta_crank_y = lin->value[30];
    const double by_q_rod_theta_rod_y = lin->value[31];
    const double by_v_pin_x_crank_theta = lin->value[32];
    const double by_v_pin_x_rod_theta = lin->value[33];
    const double by_v_pin_y_crank_theta = lin->value[34];
    const double by_v_pin_y_rod_theta = lin->value[35];
    const double by_v_crank_x_crank_theta = lin->value[36];
    const double by_v_crank_x_crank_x = lin->value[37];
    const double by_v_crank_x_rod_theta = lin->value[38];
    const double by_v_crank_x_rod_x = lin->value[39];
    const double by_v_crank_x_crank_y = lin->value[40];
    const double by_v_crank_x_rod_y = lin->value[41];
    const double by_v_crank_y_crank_theta = lin->value[42];
    const double by_v_crank_y_crank_x = lin->value[43];
    const double by_v_crank_y_rod_theta = lin->value[44];
    const double by_v_crank_y_rod_x = lin->value[45];
    const double by_v_crank_y_crank_y = lin->value[46];
    const double by_v_crank_y_rod_y = lin->value[47];
    const double by_v_crank_theta_crank_theta = lin->value[48];
    const double by_v_crank_theta_crank_x = lin->value[49];
    const double by_v_crank_theta_rod_theta = lin->value[50];
    const double by_v_crank_theta_rod_x = lin->value[51];
    const double by_v_crank_theta_crank_y = lin->value[52];
    const double by_v_crank_theta_rod_y = lin->value[53];
    const double by_v_rod_theta_crank_theta = lin->value[54];
    const double by_v_rod_theta_crank_x = lin->value[55];
    const double by_v_rod_theta_rod_theta = lin->value[56];
    const double by_v_rod_theta_rod_x = lin->value[57];
    const double by_v_rod_theta_crank_y = lin->value[58];
    const double by_v_rod_theta_rod_y = lin->value[59];

    /* parameters */
    const double crank_mass = p->crank_mass;
    const double crank_inertia = p->crank_inertia;
    const double rod_mass = p->rod_mass;
    const double rod_inertia = p->rod_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_crank_x__crank_x = crank_mass + eta*(by_q_crank_x_crank_x*eta + by_v_crank_x_crank_x);
    const double n_crank_x__crank_y = eta*(by_q_crank_x_crank_y*eta + by_v_crank_x_crank_y);
    const double n_crank_x__crank_theta = eta*(by_q_crank_x_crank_theta*eta + by_v_crank_x_crank_theta);
    const double n_crank_x__rod_x = eta*(by_q_crank_x_rod_x*eta + by_v_crank_x_rod_x);
    const double n_crank_x__rod_y = eta*(by_q_crank_x_rod_y*eta + by_v_crank_x_rod_y);
    const double n_crank_x__rod_theta = eta*(by_q_crank_x_rod_theta*eta + by_v_crank_x_rod_theta);
    const double n_crank_y__crank_x = eta*(by_q_crank_y_crank_x*eta + by_v_crank_y_crank_x);
    const double n_crank_y__crank_y = crank_mass + eta*(by_q_crank_y_crank_y*eta + by_v_crank_y_crank_y);
    const double n_crank_y__crank_theta = eta*(by_q_crank_y_crank_theta*eta + by_v_crank_y_crank_theta);
    const double n_crank_y__rod_x = eta*(by_q_crank_y_rod_x*eta + by_v_crank_y_rod_x);
    const double n_crank_y__rod_y = eta*(by_q_crank_y_rod_y*eta + by_v_crank_y_rod_y);
    const double n_crank_y__rod_theta = eta*(by_q_crank_y_rod_theta*eta + by_v_crank_y_rod_theta);
    const double n_crank_theta__crank_x = eta*(by_q_crank_theta_crank_x*eta + by_v_crank_theta_crank_x);
    const double n_crank_theta__crank_y = eta*(by_q_crank_theta_crank_y*eta + by_v_crank_theta_crank_y);
    const double n_crank_theta__crank_theta = crank_inertia + eta*(by_q_crank_theta_crank_theta*eta +
        by_v_crank_theta_crank_theta);
    const double n_crank_theta__rod_x = eta*(by_q_crank_theta_rod_x*eta + by_v_crank_theta_rod_x);
    const double n_crank_theta__rod_y = eta*(by_q_crank_theta_rod_y*eta + by_v_crank_theta_rod_y);
    const double n_crank_theta__rod_theta = eta*(by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta);
    const double n_rod_x__crank_x = eta*(-by_q_crank_x_crank_x*eta - by_v_crank_x_crank_x);
    const double n_rod_x__crank_y = eta*(-by_q_crank_x_crank_y*eta - by_v_crank_x_crank_y);
    const double n_rod_x__crank_theta = eta*(-by_q_crank_x_crank_theta*eta - by_v_crank_x_crank_theta);
    const double n_rod_x__rod_x = eta*(-by_q_crank_x_rod_x*eta - by_v_crank_x_rod_x) + rod_mass;
    const double n_rod_x__rod_y = eta*(-by_q_crank_x_rod_y*eta - by_v_crank_x_rod_y);
    const double n_rod_x__rod_theta = eta*(-by_q_crank_x_rod_theta*eta - by_v_crank_x_rod_theta);
    const double n_rod_y__crank_x = eta*(-by_q_crank_y_crank_x*eta - by_v_crank_y_crank_x);
    const double n_rod_y__crank_y = eta*(-by_q_crank_y_crank_y*eta - by_v_crank_y_crank_y);
    const double n_rod_y__crank_theta = eta*(-by_q_crank_y_crank_theta*eta - by_v_crank_y_crank_theta);
    const double n_rod_y__rod_x = eta*(-by_q_crank_y_rod_x*eta - by_v_crank_y_rod_x);
    const double n_rod_y__rod_y = eta*(-by_q_crank_y_rod_y*eta - by_v_crank_y_rod_y) + rod_mass;
    const double n_rod_y__rod_theta = eta*(-by_q_crank_y_rod_theta*eta - by_v_crank_y_rod_theta);
    const double n_rod_theta__crank_x = eta*(by_q_rod_theta_crank_x*eta + by_v_rod_theta_crank_x);
    const double n_rod_theta__crank_y = eta*(by_q_rod_theta_crank_y*eta + by_v_rod_theta_crank_y);
    const double n_rod_theta__crank_theta = eta*(by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta);
    const double n_rod_theta__rod_x = eta*(by_q_rod_theta_rod_x*eta + by_v_rod_theta_rod_x);
    const double n_rod_theta__rod_y = eta*(by_q_rod_theta_rod_y*eta + by_v_rod_theta_rod_y);
    const double n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta) +
        rod_inertia;
    const double n_pin_x__crank_theta = eta_row*(by_q_pin_x_crank_theta*eta + by_v_pin_x_crank_theta) +
        phi_pin_x_crank_theta;
    const double n_pin_x__rod_theta = eta_row*(by_q_pin_x_rod_theta*eta + by_v_pin_x_rod_theta) +
        phi_pin_x_rod_theta;
    const double n_pin_y__crank_theta = eta_row*(by_q_pin_y_crank_theta*eta + by_v_pin_y_crank_theta) +
        phi_pin_y_crank_theta;
    const double n_pin_y__rod_theta = eta_row*(by_q_pin_y_rod_theta*eta + by_v_pin_y_rod_theta) +
        phi_pin_y_rod_theta;

    /* L U */
    const double scale_rod_x = n_rod_x__rod_x;
    if (!(fabs(scale_rod_x) > 1e-13 * fabs(n_rod_x__rod_x)))
        return 4;
    const double inverse_pivot_rod_x = 1.0/scale_rod_x;
    lin->lu[0] = inverse_pivot_rod_x;
    const double l_crank_x__rod_x = inverse_pivot_rod_x*n_crank_x__rod_x;
    lin->lu[1] = l_crank_x__rod_x;
    lin->lu[2] = n_rod_x__crank_x;
    const double l_crank_theta__rod_x = inverse_pivot_rod_x*n_crank_theta__rod_x;
    lin->lu[3] = l_crank_theta__rod_x;
    lin->lu[4] = n_rod_x__crank_theta;
    const double l_rod_theta__rod_x = inverse_pivot_rod_x*n_rod_theta__rod_x;
    lin->lu[5] = l_rod_theta__rod_x;
    lin->lu[6] = n_rod_x__rod_theta;
    const double l_crank_y__rod_x = inverse_pivot_rod_x*n_crank_y__rod_x;
    lin->lu[7] = l_crank_y__rod_x;
    lin->lu[8] = n_rod_x__crank_y;
    const double l_rod_y__rod_x = inverse_pivot_rod_x*n_rod_y__rod_x;
    lin->lu[9] = l_rod_y__rod_x;
    lin->lu[10] = n_rod_x__rod_y;
    const double scale_crank_x = -l_crank_x__rod_x*n_rod_x__crank_x + n_crank_x__crank_x;
    if (!(fabs(scale_crank_x) > 1e-13 * fabs(n_crank_x__crank_x)))
        return 1;
    const double inverse_pivot_crank_x = 1.0/scale_crank_x;
    lin->lu[11] = inverse_pivot_crank_x;
    const double l_crank_theta__crank_x = inverse_pivot_crank_x*(-l_crank_theta__rod_x*n_rod_x__crank_x +
        n_crank_theta__crank_x);
    lin->lu[12] = l_crank_theta__crank_x;
    const double u_crank_x__crank_theta = -l_crank_x__rod_x*n_rod_x__crank_theta + n_crank_x__crank_theta;
    lin->lu[13] = u_crank_x__crank_theta;
    const double l_rod_theta__crank_x = inverse_pivot_crank_x*(-l_rod_theta__rod_x*n_rod_x__crank_x +
        n_rod_theta__crank_x);
    lin->lu[14] = l_rod_theta__crank_x;
    const double u_crank_x__rod_theta = -l_crank_x__rod_x*n_rod_x__rod_theta + n_crank_x__rod_theta;
    lin->lu[15] = u_crank_x__rod_theta;
    const double l_pin_x__crank_x = inverse_pivot_crank_x*(inverse_pivot_rod_x*n_rod_x__crank_x + 1.0);
    lin->lu[16] = l_pin_x__crank_x;
    const double u_crank_x__pin_x = l_crank_x__rod_x + 1.0;
    lin->lu[17] = u_crank_x__pin_x;
    const double l_crank_y__crank_x = inverse_pivot_crank_x*(-l_crank_y__rod_x*n_rod_x__crank_x +
        n_crank_y__crank_x);
    lin->lu[18] = l_crank_y__crank_x;
    const double u_crank_x__crank_y = -l_crank_x__rod_x*n_rod_x__crank_y + n_crank_x__crank_y;
    lin->lu[19] = u_crank_x__crank_y;
    const double l_rod_y__crank_x = inverse_pivot_crank_x*(-l_rod_y__rod_x*n_rod_x__crank_x +
        n_rod_y__crank_x);
    lin->lu[20] = l_rod_y__crank_x;
    const double u_crank_x__rod_y = -l_crank_x__rod_x*n_rod_x__rod_y + n_crank_x__rod_y;
    lin->lu[21] = u_crank_x__rod_y;
    const double scale_O_x_2 = -inverse_pivot_crank_x;
    if (!(fabs(scale_O_x_2) > 1e-08 * fabs(scale_O_x_2)))
        return 7;
    const double inverse_pivot_O_x_2 = 1.0/scale_O_x_2;
    lin->lu[22] = inverse_pivot_O_x_2;
    const double l_crank_theta__O_x = inverse_pivot_O_x_2*l_crank_theta__crank_x;
    lin->lu[23] = l_crank_theta__O_x;
    const double u_O_x__crank_theta = inverse_pivot_crank_x*u_crank_x__crank_theta;
    lin->lu[24] = u_O_x__crank_theta;
    const double l_rod_theta__O_x = inverse_pivot_O_x_2*l_rod_theta__crank_x;
    lin->lu[25] = l_rod_theta__O_x;
    const double u_O_x__rod_theta = inverse_pivot_crank_x*u_crank_x__rod_theta;
    lin->lu[26] = u_O_x__rod_theta;
    const double l_pin_x__O_x_2 = inverse_pivot_O_x_2*l_pin_x__crank_x;
    lin->lu[27] = l_pin_x__O_x_2;
    const double u_O_x__pin_x = inverse_pivot_crank_x*u_crank_x__pin_x;
    lin->lu[28] = u_O_x__pin_x;
    const double l_crank_y__O_x = inverse_pivot_O_x_2*l_crank_y__crank_x;
    lin->lu[29] = l_crank_y__O_x;
    const double u_O_x__crank_y = inverse_pivot_crank_x*u_crank_x__crank_y;
    lin->lu[30] = u_O_x__crank_y;
    const double l_rod_y__O_x = inverse_pivot_O_x_2*l_rod_y__crank_x;
    lin->lu[31] = l_rod_y__O_x;
    const double u_O_x__rod_y = inverse_pivot_crank_x*u_crank_x__rod_y;
    lin->lu[32] = u_O_x__rod_y;
    const double scale_crank_theta = -l_crank_theta__O_x*u_O_x__crank_theta -
        l_crank_theta__crank_x*u_crank_x__crank_theta - l_crank_theta__rod_x*n_rod_x__crank_theta +
        n_crank_theta__crank_theta;
    if (!(fabs(scale_crank_theta) > 1e-13 * fabs(n_crank_theta__crank_theta)))
        return 3;
    const double inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[33] = inverse_pivot_crank_theta;
    const double l_rod_theta__crank_theta = inverse_pivot_crank_theta*(-l_rod_theta__O_x*u_O_x__crank_theta -
        l_rod_theta__crank_x*u_crank_x__crank_theta - l_rod_theta__rod_x*n_rod_x__crank_theta +
        n_rod_theta__crank_theta);
    lin->lu[34] = l_rod_theta__crank_theta;
    const double u_crank_theta__rod_theta = -l_crank_theta__O_x*u_O_x__rod_theta -
        l_crank_theta__crank_x*u_crank_x__rod_theta - l_crank_theta__rod_x*n_rod_x__rod_theta +
        n_crank_theta__rod_theta;
    lin->lu[35] = u_crank_theta__rod_theta;
    const double l_pin_x__crank_theta_2 = inverse_pivot_crank_theta*(inverse_pivot_rod_x*n_rod_x__crank_theta
        - l_pin_x__O_x_2*u_O_x__crank_theta - l_pin_x__crank_x*u_crank_x__crank_theta + n_pin_x__crank_theta);
    lin->lu[36] = l_pin_x__crank_theta_2;
    const double u_crank_theta__pin_x = -l_crank_theta__O_x*u_O_x__pin_x -
        l_crank_theta__crank_x*u_crank_x__pin_x + l_crank_theta__rod_x + phi_pin_x_crank_theta;
    lin->lu[37] = u_crank_theta__pin_x;
    const double l_crank_y__crank_theta = inverse_pivot_crank_theta*(-l_crank_y__O_x*u_O_x__crank_theta -
        l_crank_y__crank_x*u_crank_x__crank_theta - l_crank_y__rod_x*n_rod_x__crank_theta +
        n_crank_y__crank_theta);
    lin->lu[38] = l_crank_y__crank_theta;
    const double u_crank_theta__crank_y = -l_crank_theta__O_x*u_O_x__crank_y -
        l_crank_theta__crank_x*u_crank_x__crank_y - l_crank_theta__rod_x*n_rod_x__crank_y +
        n_crank_theta__crank_y;
    lin->lu[39] = u_crank_theta__crank_y;
    const double l_rod_y__crank_theta = inverse_pivot_crank_theta*(-l_rod_y__O_x*u_O_x__crank_theta -
        l_rod_y__crank_x*u_crank_x__crank_theta - l_rod_y__rod_x*n_rod_x__crank_theta + n_rod_y__crank_theta);
    lin->lu[40] = l_rod_y__crank_theta;
    const double u_crank_theta__rod_y = -l_crank_theta__O_x*u_O_x__rod_y -
        l_crank_theta__crank_x*u_crank_x__rod_y - l_crank_theta__rod_x*n_rod_x__rod_y + n_crank_theta__rod_y;
    lin->lu[41] = u_crank_theta__rod_y;
    const double l_pin_y__crank_theta_2 = inverse_pivot_crank_theta*n_pin_y__crank_theta;
    lin->lu[42] = l_pin_y__crank_theta_2;
    const double scale_rod_theta = -l_rod_theta__O_x*u_O_x__rod_theta -
        l_rod_theta__crank_theta*u_crank_theta__rod_theta - l_rod_theta__crank_x*u_crank_x__rod_theta -
        l_rod_theta__rod_x*n_rod_x__rod_theta + n_rod_theta__rod_theta;
    if (!(fabs(scale_rod_theta) > 1e-13 * fabs(n_rod_theta__rod_theta)))
        return 6;
    const double inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[43] = inverse_pivot_rod_theta;
    const double l_pin_x__rod_theta_2 = inverse_pivot_rod_theta*(inverse_pivot_rod_x*n_rod_x__rod_theta -
        l_pin_x__O_x_2*u_O_x__rod_theta - l_pin_x__crank_theta_2*u_crank_theta__rod_theta -
        l_pin_x__crank_x*u_crank_x__rod_theta + n_pin_x__rod_theta);
    lin->lu[44] = l_pin_x__rod_theta_2;
    const double u_rod_theta__pin_x = -l_rod_theta__O_x*u_O_x__pin_x -
        l_rod_theta__crank_theta*u_crank_theta__pin_x - l_rod_theta__crank_x*u_crank_x__pin_x +
        l_rod_theta__rod_x + phi_pin_x_rod_theta;
    lin->lu[45] = u_rod_theta__pin_x;
    const double l_crank_y__rod_theta = inverse_pivot_rod_theta*(-l_crank_y__O_x*u_O_x__rod_theta -
        l_crank_y__crank_theta*u_crank_theta__rod_theta - l_crank_y__crank_x*u_crank_x__rod_theta -
        l_crank_y__rod_x*n_rod_x__rod_theta + n_crank_y__rod_theta);
    lin->lu[46] = l_crank_y__rod_theta;
    const double u_rod_theta__crank_y = -l_rod_theta__O_x*u_O_x__crank_y -
        l_rod_theta__crank_theta*u_crank_theta__crank_y - l_rod_theta__crank_x*u_crank_x__crank_y -
        l_rod_theta__rod_x*n_rod_x__crank_y + n_rod_theta__crank_y;
    lin->lu[47] = u_rod_theta__crank_y;
    const double l_rod_y__rod_theta = inverse_pivot_rod_theta*(-l_rod_y__O_x*u_O_x__rod_theta -
        l_rod_y__crank_theta*u_crank_theta__rod_theta - l_rod_y__crank_x*u_crank_x__rod_theta -
        l_rod_y__rod_x*n_rod_x__rod_theta + n_rod_y__rod_theta);
    lin->lu[48] = l_rod_y__rod_theta;
    const double u_rod_theta__rod_y = -l_rod_theta__O_x*u_O_x__rod_y -
        l_rod_theta__crank_theta*u_crank_theta__rod_y - l_rod_theta__crank_x*u_crank_x__rod_y -
        l_rod_theta__rod_x*n_rod_x__rod_y + n_rod_theta__rod_y;
    lin->lu[49] = u_rod_theta__rod_y;
    const double l_pin_y__rod_theta_2 =
        inverse_pivot_rod_theta*(-l_pin_y__crank_theta_2*u_crank_theta__rod_theta + n_pin_y__rod_theta);
    lin->lu[50] = l_pin_y__rod_theta_2;
    const double u_rod_theta__pin_y = -l_rod_theta__crank_theta*phi_pin_y_crank_theta + phi_pin_y_rod_theta;
    lin->lu[51] = u_rod_theta__pin_y;
    const double scale_pin_x_2 = -inverse_pivot_rod_x - l_pin_x__crank_theta_2*u_crank_theta__pin_x -
        l_pin_x__crank_x*u_crank_x__pin_x - l_pin_x__rod_theta_2*u_rod_theta__pin_x;
    const double pivot_pin_x_2 = -l_pin_x__O_x_2*u_O_x__pin_x + scale_pin_x_2;
    if (!(fabs(pivot_pin_x_2) > 1e-08 * fabs(scale_pin_x_2)))
        return 9;
    const double inverse_pivot_pin_x_2 = 1.0/pivot_pin_x_2;
    lin->lu[52] = inverse_pivot_pin_x_2;
    const double l_crank_y__pin_x = inverse_pivot_pin_x_2*(-l_crank_y__O_x*u_O_x__pin_x -
        l_crank_y__crank_theta*u_crank_theta__pin_x - l_crank_y__crank_x*u_crank_x__pin_x -
        l_crank_y__rod_theta*u_rod_theta__pin_x + l_crank_y__rod_x);
    lin->lu[53] = l_crank_y__pin_x;
    const double u_pin_x__crank_y = inverse_pivot_rod_x*n_rod_x__crank_y - l_pin_x__O_x_2*u_O_x__crank_y -
        l_pin_x__crank_theta_2*u_crank_theta__crank_y - l_pin_x__crank_x*u_crank_x__crank_y -
        l_pin_x__rod_theta_2*u_rod_theta__crank_y;
    lin->lu[54] = u_pin_x__crank_y;
    const double l_rod_y__pin_x = inverse_pivot_pin_x_2*(-l_rod_y__O_x*u_O_x__pin_x -
        l_rod_y__crank_theta*u_crank_theta__pin_x - l_rod_y__crank_x*u_crank_x__pin_x -
        l_rod_y__rod_theta*u_rod_theta__pin_x + l_rod_y__rod_x);
    lin->lu[55] = l_rod_y__pin_x;
    const double u_pin_x__rod_y = inverse_pivot_rod_x*n_rod_x__rod_y - l_pin_x__O_x_2*u_O_x__rod_y -
        l_pin_x__crank_theta_2*u_crank_theta__rod_y - l_pin_x__crank_x*u_crank_x__rod_y -
        l_pin_x__rod_theta_2*u_rod_theta__rod_y;
    lin->lu[56] = u_pin_x__rod_y;
    const double l_pin_y__pin_x_2 = inverse_pivot_pin_x_2*(-l_pin_y__crank_theta_2*u_crank_theta__pin_x -
        l_pin_y__rod_theta_2*u_rod_theta__pin_x);
    lin->lu[57] = l_pin_y__pin_x_2;
    const double u_pin_x__pin_y = -l_pin_x__crank_theta_2*phi_pin_y_crank_theta -
        l_pin_x__rod_theta_2*u_rod_theta__pin_y;
    lin->lu[58] = u_pin_x__pin_y;
    const double scale_crank_y = -l_crank_y__O_x*u_O_x__crank_y -
        l_crank_y__crank_theta*u_crank_theta__crank_y - l_crank_y__crank_x*u_crank_x__crank_y -
        l_crank_y__pin_x*u_pin_x__crank_y - l_crank_y__rod_theta*u_rod_theta__crank_y -
        l_crank_y__rod_x*n_rod_x__crank_y + n_crank_y__crank_y;
    if (!(fabs(scale_crank_y) > 1e-13 * fabs(n_crank_y__crank_y)))
        return 2;
    const double inverse_pivot_crank_y = 1.0/scale_crank_y;
    lin->lu[59] = inverse_pivot_crank_y;
    const double l_rod_y__crank_y = inverse_pivot_crank_y*(-l_rod_y__O_x*u_O_x__crank_y -
        l_rod_y__crank_theta*u_crank_theta__crank_y - l_rod_y__crank_x*u_crank_x__crank_y -
        l_rod_y__pin_x*u_pin_x__crank_y - l_rod_y__rod_theta*u_rod_theta__crank_y -
        l_rod_y__rod_x*n_rod_x__crank_y + n_rod_y__crank_y);
    lin->lu[60] = l_rod_y__crank_y;
    const double u_crank_y__rod_y = -l_crank_y__O_x*u_O_x__rod_y - l_crank_y__crank_theta*u_crank_theta__rod_y
        - l_crank_y__crank_x*u_crank_x__rod_y - l_crank_y__pin_x*u_pin_x__rod_y -
        l_crank_y__rod_theta*u_rod_theta__rod_y - l_crank_y__rod_x*n_rod_x__rod_y + n_crank_y__rod_y;
    lin->lu[61] = u_crank_y__rod_y;
    const double l_pin_y__crank_y = inverse_pivot_crank_y*(-l_pin_y__crank_theta_2*u_crank_theta__crank_y -
        l_pin_y__pin_x_2*u_pin_x__crank_y - l_pin_y__rod_theta_2*u_rod_theta__crank_y + 1.0);
    lin->lu[62] = l_pin_y__crank_y;
    const double u_crank_y__pin_y = -l_crank_y__crank_theta*phi_pin_y_crank_theta -
        l_crank_y__pin_x*u_pin_x__pin_y - l_crank_y__rod_theta*u_rod_theta__pin_y + 1.0;
    lin->lu[63] = u_crank_y__pin_y;
    const double scale_O_y_2 = -inverse_pivot_crank_y;
    if (!(fabs(scale_O_y_2) > 1e-08 * fabs(scale_O_y_2)))
        return 8;
    const double inverse_pivot_O_y_2 = 1.0/scale_O_y_2;
    lin->lu[64] = inverse_pivot_O_y_2;
    const double l_rod_y__O_y = inverse_pivot_O_y_2*l_rod_y__crank_y;
    lin->lu[65] = l_rod_y__O_y;
    const double u_O_y__rod_y = inverse_pivot_crank_y*u_crank_y__rod_y;
    lin->lu[66] = u_O_y__rod_y;
    const double l_pin_y__O_y_2 = inverse_pivot_O_y_2*l_pin_y__crank_y;
    lin->lu[67] = l_pin_y__O_y_2;
    const double u_O_y__pin_y = inverse_pivot_crank_y*u_crank_y__pin_y;
    lin->lu[68] = u_O_y__pin_y;
    const double scale_rod_y = -l_rod_y__O_x*u_O_x__rod_y - l_rod_y__O_y*u_O_y__rod_y -
        l_rod_y__crank_theta*u_crank_theta__rod_y - l_rod_y__crank_x*u_crank_x__rod_y -
        l_rod_y__crank_y*u_crank_y__rod_y - l_rod_y__pin_x*u_pin_x__rod_y -
        l_rod_y__rod_theta*u_rod_theta__rod_y - l_rod_y__rod_x*n_rod_x__rod_y + n_rod_y__rod_y;
    if (!(fabs(scale_rod_y) > 1e-13 * fabs(n_rod_y__rod_y)))
        return 5;
    const double inverse_pivot_rod_y = 1.0/scale_rod_y;
    lin->lu[69] = inverse_pivot_rod_y;
    const double l_pin_y__rod_y = inverse_pivot_rod_y*(-l_pin_y__O_y_2*u_O_y__rod_y -
        l_pin_y__crank_theta_2*u_crank_theta__rod_y - l_pin_y__crank_y*u_crank_y__rod_y -
        l_pin_y__pin_x_2*u_pin_x__rod_y - l_pin_y__rod_theta_2*u_rod_theta__rod_y - 1.0);
    lin->lu[70] = l_pin_y__rod_y;
    const double u_rod_y__pin_y = -l_rod_y__O_y*u_O_y__pin_y - l_rod_y__crank_theta*phi_pin_y_crank_theta -
        l_rod_y__crank_y*u_crank_y__pin_y - l_rod_y__pin_x*u_pin_x__pin_y -
        l_rod_y__rod_theta*u_rod_theta__pin_y - 1.0;
    lin->lu[71] = u_rod_y__pin_y;
    const double scale_pin_y_2 = -l_pin_y__crank_theta_2*phi_pin_y_crank_theta -
        l_pin_y__crank_y*u_crank_y__pin_y - l_pin_y__rod_theta_2*u_rod_theta__pin_y -
        l_pin_y__rod_y*u_rod_y__pin_y;
    const double pivot_pin_y_2 = -l_pin_y__O_y_2*u_O_y__pin_y - l_pin_y__pin_x_2*u_pin_x__pin_y +
        scale_pin_y_2;
    if (!(fabs(pivot_pin_y_2) > 1e-08 * fabs(scale_pin_y_2)))
        return 10;
    const double inverse_pivot_pin_y_2 = 1.0/pivot_pin_y_2;
    lin->lu[72] = inverse_pivot_pin_y_2;
    const double l_slider_offset__pin_y = -inverse_pivot_pin_y_2*inverse_pivot_rod_y*u_rod_y__pin_y;
    lin->lu[73] = l_slider_offset__pin_y;
    const double scale_slider_offset_2 = -inverse_pivot_rod_y;
    const double pivot_slider_offset = l_pin_y__rod_y*l_slider_offset__pin_y + scale_slider_offset_2;
    if (!(fabs(pivot_slider_offset) > 1e-08 * fabs(scale_slider_offset_2)))
        return 11;
    const double inverse_pivot_slider_offset_2 = 1.0/pivot_slider_offset;
    lin->lu[74] = inverse_pivot_slider_offset_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_pin_y_crank_theta = lin->value[2];
    const double inverse_pivot_rod_x = lin->lu[0];
    const double l_crank_x__rod_x = lin->lu[1];
    const double n_rod_x__crank_x = lin->lu[2];
    const double l_crank_theta__rod_x = lin->lu[3];
    const double n_rod_x__crank_theta = lin->lu[4];
    const double l_rod_theta__rod_x = lin->lu[5];
    const double n_rod_x__rod_theta = lin->lu[6];
    const double l_crank_y__rod_x = lin->lu[7];
    const double n_rod_x__crank_y = lin->lu[8];
    const double l_rod_y__rod_x = lin->lu[9];
    const double n_rod_x__rod_y = lin->lu[10];
    const double inverse_pivot_crank_x = lin->lu[11];
    const double l_crank_theta__crank_x = lin->lu[12];
    const double u_crank_x__crank_theta = lin->lu[13];
    const double l_rod_theta__crank_x = lin->lu[14];
    const double u_crank_x__rod_theta = lin->lu[15];
    const double l_pin_x__crank_x = lin->lu[16];
    const double u_crank_x__pin_x = lin->lu[17];
    const double l_crank_y__crank_x = lin->lu[18];
    const double u_crank_x__crank_y = lin->lu[19];
    const double l_rod_y__crank_x = lin->lu[20];
    const double u_crank_x__rod_y = lin->lu[21];
    const double inverse_pivot_O_x_2 = lin->lu[22];
    const double l_crank_theta__O_x = lin->lu[23];
    const double u_O_x__crank_theta = lin->lu[24];
    const double l_rod_theta__O_x = lin->lu[25];
    const double u_O_x__rod_theta = lin->lu[26];
    const double l_pin_x__O_x_2 = lin->lu[27];
    const double u_O_x__pin_x = lin->lu[28];
    const double l_crank_y__O_x = lin->lu[29];
    const double u_O_x__crank_y = lin->lu[30];
    const double l_rod_y__O_x = lin->lu[31];
    const double u_O_x__rod_y = lin->lu[32];
    const double inverse_pivot_crank_theta = lin->lu[33];
    const double l_rod_theta__crank_theta = lin->lu[34];
    const double u_crank_theta__rod_theta = lin->lu[35];
    const double l_pin_x__crank_theta_2 = lin->lu[36];
    const double u_crank_theta__pin_x = lin->lu[37];
    const double l_crank_y__crank_theta = lin->lu[38];
    const double u_crank_theta__crank_y = lin->lu[39];
    const double l_rod_y__crank_theta = lin->lu[40];
    const double u_crank_theta__rod_y = lin->lu[41];
    const double l_pin_y__crank_theta_2 = lin->lu[42];
    const double inverse_pivot_rod_theta = lin->lu[43];
    const double l_pin_x__rod_theta_2 = lin->lu[44];
    const double u_rod_theta__pin_x = lin->lu[45];
    const double l_crank_y__rod_theta = lin->lu[46];
    const double u_rod_theta__crank_y = lin->lu[47];
    const double l_rod_y__rod_theta = lin->lu[48];
    const double u_rod_theta__rod_y = lin->lu[49];
    const double l_pin_y__rod_theta_2 = lin->lu[50];
    const double u_rod_theta__pin_y = lin->lu[51];
    const double inverse_pivot_pin_x_2 = lin->lu[52];
    const double l_crank_y__pin_x = lin->lu[53];
    const double u_pin_x__crank_y = lin->lu[54];
    const double l_rod_y__pin_x = lin->lu[55];
    const double u_pin_x__rod_y = lin->lu[56];
    const double l_pin_y__pin_x_2 = lin->lu[57];
    const double u_pin_x__pin_y = lin->lu[58];
    const double inverse_pivot_crank_y = lin->lu[59];
    const double l_rod_y__crank_y = lin->lu[60];
    const double u_crank_y__rod_y = lin->lu[61];
    const double l_pin_y__crank_y = lin->lu[62];
    const double u_crank_y__pin_y = lin->lu[63];
    const double inverse_pivot_O_y_2 = lin->lu[64];
    const double l_rod_y__O_y = lin->lu[65];
    const double u_O_y__rod_y = lin->lu[66];
    const double l_pin_y__O_y_2 = lin->lu[67];
    const double u_O_y__pin_y = lin->lu[68];
    const double inverse_pivot_rod_y = lin->lu[69];
    const double l_pin_y__rod_y = lin->lu[70];
    const double u_rod_y__pin_y = lin->lu[71];
    const double inverse_pivot_pin_y_2 = lin->lu[72];
    const double l_slider_offset__pin_y = lin->lu[73];
    const double inverse_pivot_slider_offset_2 = lin->lu[74];

    /* forward */
    const double b_rod_x = x[3];
    const double b_crank_x = -b_rod_x*l_crank_x__rod_x + x[0];
    const double b_O_x = b_crank_x*inverse_pivot_crank_x + x[6];
    const double b_crank_theta = -b_O_x*l_crank_theta__O_x - b_crank_x*l_crank_theta__crank_x -
        b_rod_x*l_crank_theta__rod_x + x[2];
    const double b_rod_theta = -b_O_x*l_rod_theta__O_x - b_crank_theta*l_rod_theta__crank_theta -
        b_crank_x*l_rod_theta__crank_x - b_rod_x*l_rod_theta__rod_x + x[5];
    const double b_pin_x = -b_O_x*l_pin_x__O_x_2 - b_crank_theta*l_pin_x__crank_theta_2 -
        b_crank_x*l_pin_x__crank_x - b_rod_theta*l_pin_x__rod_theta_2 + b_rod_x*inverse_pivot_rod_x + x[8];
    const double b_crank_y = -b_O_x*l_crank_y__O_x - b_crank_theta*l_crank_y__crank_theta -
        b_crank_x*l_crank_y__crank_x - b_pin_x*l_crank_y__pin_x - b_rod_theta*l_crank_y__rod_theta -
        b_rod_x*l_crank_y__rod_x + x[1];
    const double b_O_y = b_crank_y*inverse_pivot_crank_y + x[7];
    const double b_rod_y = -b_O_x*l_rod_y__O_x - b_O_y*l_rod_y__O_y - b_crank_theta*l_rod_y__crank_theta -
        b_crank_x*l_rod_y__crank_x - b_crank_y*l_rod_y__crank_y - b_pin_x*l_rod_y__pin_x -
        b_rod_theta*l_rod_y__rod_theta - b_rod_x*l_rod_y__rod_x + x[4];
    const double b_pin_y = -b_O_y*l_pin_y__O_y_2 - b_crank_theta*l_pin_y__crank_theta_2 -
        b_crank_y*l_pin_y__crank_y - b_pin_x*l_pin_y__pin_x_2 - b_rod_theta*l_pin_y__rod_theta_2 -
        b_rod_y*l_pin_y__rod_y + x[9];
    const double b_slider_offset = -b_pin_y*l_slider_offset__pin_y - b_rod_y*inverse_pivot_rod_y + x[10];

    /* backward */
    const double x_slider_offset = b_slider_offset*inverse_pivot_slider_offset_2;
    x[10] = x_slider_offset;
    const double x_pin_y = inverse_pivot_pin_y_2*(b_pin_y + l_pin_y__rod_y*x_slider_offset);
    x[9] = x_pin_y;
    const double x_rod_y = inverse_pivot_rod_y*(b_rod_y - u_rod_y__pin_y*x_pin_y - x_slider_offset);
    x[4] = x_rod_y;
    const double x_O_y = inverse_pivot_O_y_2*(b_O_y - u_O_y__pin_y*x_pin_y - u_O_y__rod_y*x_rod_y);
    x[7] = x_O_y;
    const double x_crank_y = inverse_pivot_crank_y*(b_crank_y - u_crank_y__pin_y*x_pin_y -
        u_crank_y__rod_y*x_rod_y + x_O_y);
    x[1] = x_crank_y;
    const double x_pin_x = inverse_pivot_pin_x_2*(b_pin_x - u_pin_x__crank_y*x_crank_y -
        u_pin_x__pin_y*x_pin_y - u_pin_x__rod_y*x_rod_y);
    x[8] = x_pin_x;
    const double x_rod_theta = inverse_pivot_rod_theta*(b_rod_theta - u_rod_theta__crank_y*x_crank_y -
        u_rod_theta__pin_x*x_pin_x - u_rod_theta__pin_y*x_pin_y - u_rod_theta__rod_y*x_rod_y);
    x[5] = x_rod_theta;
    const double x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta - phi_pin_y_crank_theta*x_pin_y -
        u_crank_theta__crank_y*x_crank_y - u_crank_theta__pin_x*x_pin_x - u_crank_theta__rod_theta*x_rod_theta
        - u_crank_theta__rod_y*x_rod_y);
    x[2] = x_crank_theta;
    const double x_O_x = inverse_pivot_O_x_2*(b_O_x - u_O_x__crank_theta*x_crank_theta -
        u_O_x__crank_y*x_crank_y - u_O_x__pin_x*x_pin_x - u_O_x__rod_theta*x_rod_theta -
        u_O_x__rod_y*x_rod_y);
    x[6] = x_O_x;
    const double x_crank_x = inverse_pivot_crank_x*(b_crank_x - u_crank_x__crank_theta*x_crank_theta -
        u_crank_x__crank_y*x_crank_y - u_crank_x__pin_x*x_pin_x - u_crank_x__rod_theta*x_rod_theta -
        u_crank_x__rod_y*x_rod_y + x_O_x);
    x[0] = x_crank_x;
    const double x_rod_x = inverse_pivot_rod_x*(b_rod_x - n_rod_x__crank_theta*x_crank_theta -
        n_rod_x__crank_x*x_crank_x - n_rod_x__crank_y*x_crank_y - n_rod_x__rod_theta*x_rod_theta -
        n_rod_x__rod_y*x_rod_y + x_pin_x);
    x[3] = x_rod_x;
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
    const double phi_pin_x_crank_theta = lin->value[0];
    const double phi_pin_x_rod_theta = lin->value[1];
    const double phi_pin_y_crank_theta = lin->value[2];
    const double phi_pin_y_rod_theta = lin->value[3];
    const double by_q_pin_x_crank_theta = lin->value[4];
    const double by_q_pin_x_rod_theta = lin->value[5];
    const double by_q_pin_y_crank_theta = lin->value[6];
    const double by_q_pin_y_rod_theta = lin->value[7];
    const double by_q_crank_x_crank_theta = lin->value[8];
    const double by_q_crank_x_rod_theta = lin->value[9];
    const double by_q_crank_x_crank_x = lin->value[10];
    const double by_q_crank_x_rod_x = lin->value[11];
    const double by_q_crank_x_crank_y = lin->value[12];
    const double by_q_crank_x_rod_y = lin->value[13];
    const double by_q_crank_y_crank_theta = lin->value[14];
    const double by_q_crank_y_rod_theta = lin->value[15];
    const double by_q_crank_y_crank_x = lin->value[16];
    const double by_q_crank_y_rod_x = lin->value[17];
    const double by_q_crank_y_crank_y = lin->value[18];
    const double by_q_crank_y_rod_y = lin->value[19];
    const double by_q_crank_theta_crank_theta = lin->value[20];
    const double by_q_crank_theta_rod_theta = lin->value[21];
    const double by_q_crank_theta_crank_x = lin->value[22];
    const double by_q_crank_theta_rod_x = lin->value[23];
    const double by_q_crank_theta_crank_y = lin->value[24];
    const double by_q_crank_theta_rod_y = lin->value[25];
    const double by_q_rod_theta_rod_theta = lin->value[26];
    const double by_q_rod_theta_crank_theta = lin->value[27];
    const double by_q_rod_theta_crank_x = lin->value[28];
    const double by_q_rod_theta_rod_x = lin->value[29];
    const double by_q_rod_theta_crank_y = lin->value[30];
    const double by_q_rod_theta_rod_y = lin->value[31];
    const double power_q_1_rod_theta = lin->value[60];
    const double power_q_1_crank_theta = lin->value[61];
    const double power_q_1_crank_x = lin->value[62];
    const double power_q_1_rod_x = lin->value[63];
    const double power_q_1_crank_y = lin->value[64];
    const double power_q_1_rod_y = lin->value[65];
    const double power_v_1_crank_theta = lin->value[66];
    const double power_v_1_crank_x = lin->value[67];
    const double power_v_1_rod_theta = lin->value[68];
    const double power_v_1_rod_x = lin->value[69];
    const double power_v_1_crank_y = lin->value[70];
    const double power_v_1_rod_y = lin->value[71];

    /* parameters */
    const double crank_mass = p->crank_mass;
    const double crank_inertia = p->crank_inertia;
    const double rod_mass = p->rod_mass;
    const double rod_inertia = p->rod_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[11];
    const double shifted_crank_x = -beta_squared*eta*r[0] + r[6];
    const double shifted_crank_y = -beta_squared*eta*r[1] + r[7];
    const double shifted_crank_theta = -beta_squared*eta*r[2] + r[8];
    const double shifted_rod_x = -beta_squared*eta*r[3] + r[9];
    const double shifted_rod_y = -beta_squared*eta*r[4] + r[10];
    const double shifted_rod_theta = -beta_squared*eta*r[5] + r[11];
    x[0] = eta*(-by_q_crank_x_crank_theta*eta*r[2] - by_q_crank_x_crank_x*eta*r[0] -
        by_q_crank_x_crank_y*eta*r[1] - by_q_crank_x_rod_theta*eta*r[5] - by_q_crank_x_rod_x*eta*r[3] -
        by_q_crank_x_rod_y*eta*r[4] + crank_mass*r[6]);
    x[1] = eta*(-by_q_crank_y_crank_theta*eta*r[2] - by_q_crank_y_crank_x*eta*r[0] -
        by_q_crank_y_crank_y*eta*r[1] - by_q_crank_y_rod_theta*eta*r[5] - by_q_crank_y_rod_x*eta*r[3] -
        by_q_crank_y_rod_y*eta*r[4] + crank_mass*r[7]);
    x[2] = eta*(-by_q_crank_theta_crank_theta*eta*r[2] - by_q_crank_theta_crank_x*eta*r[0] -
        by_q_crank_theta_crank_y*eta*r[1] - by_q_crank_theta_rod_theta*eta*r[5] -
        by_q_crank_theta_rod_x*eta*r[3] - by_q_crank_theta_rod_y*eta*r[4] + crank_inertia*r[8]);
    x[3] = eta*(by_q_crank_x_crank_theta*eta*r[2] + by_q_crank_x_crank_x*eta*r[0] +
        by_q_crank_x_crank_y*eta*r[1] + by_q_crank_x_rod_theta*eta*r[5] + by_q_crank_x_rod_x*eta*r[3] +
        by_q_crank_x_rod_y*eta*r[4] + r[9]*rod_mass);
    x[4] = eta*(by_q_crank_y_crank_theta*eta*r[2] + by_q_crank_y_crank_x*eta*r[0] +
        by_q_crank_y_crank_y*eta*r[1] + by_q_crank_y_rod_theta*eta*r[5] + by_q_crank_y_rod_x*eta*r[3] +
        by_q_crank_y_rod_y*eta*r[4] + r[10]*rod_mass);
    x[5] = eta*(-by_q_rod_theta_crank_theta*eta*r[2] - by_q_rod_theta_crank_x*eta*r[0] -
        by_q_rod_theta_crank_y*eta*r[1] - by_q_rod_theta_rod_theta*eta*r[5] - by_q_rod_theta_rod_x*eta*r[3] -
        by_q_rod_theta_rod_y*eta*r[4] + r[11]*rod_inertia);
    x[6] = -eta_row*shifted_crank_x;
    x[7] = -eta_row*shifted_crank_y;
    x[8] = eta_row*(-by_q_pin_x_crank_theta*eta*r[2] - by_q_pin_x_rod_theta*eta*r[5] +
        phi_pin_x_crank_theta*shifted_crank_theta + phi_pin_x_rod_theta*shifted_rod_theta + shifted_crank_x -
        shifted_rod_x);
    x[9] = eta_row*(-by_q_pin_y_crank_theta*eta*r[2] - by_q_pin_y_rod_theta*eta*r[5] +
        phi_pin_y_crank_theta*shifted_crank_theta + phi_pin_y_rod_theta*shifted_rod_theta + shifted_crank_y -
        shifted_rod_y);
    x[10] = eta_row*shifted_rod_y;
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[6] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[7] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[8] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[9] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[10] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[11] = x[5];
    u[12] = eta*r[12];
    u[13] = eta*(power_q_1_crank_theta*u[2] + power_q_1_crank_x*u[0] + power_q_1_crank_y*u[1] +
        power_q_1_rod_theta*u[5] + power_q_1_rod_x*u[3] + power_q_1_rod_y*u[4] + power_v_1_crank_theta*u[8] +
        power_v_1_crank_x*u[6] + power_v_1_crank_y*u[7] + power_v_1_rod_theta*u[11] + power_v_1_rod_x*u[9] +
        power_v_1_rod_y*u[10] + r[13]);
    u[14] = eta*r[14];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {6, 0, 72, 1}, {7, 1, 72, 1}, {8, 0, 72, -1}, {8, 2, 0, 1}, {8, 3, 72, 1}, {8, 5, 1, 1}, {9, 1, 72, -1},
    {9, 2, 2, 1}, {9, 4, 72, 1}, {9, 5, 3, 1}, {10, 4, 72, -1}
};
static const LinearEntry residual_entries[] = {
    {8, 2, 4, 1}, {8, 5, 5, 1}, {9, 2, 6, 1}, {9, 5, 7, 1}, {0, 2, 8, 1}, {0, 5, 9, 1}, {0, 0, 10, 1}, {0, 3,
    11, 1}, {0, 1, 12, 1}, {0, 4, 13, 1}, {1, 2, 14, 1}, {1, 5, 15, 1}, {1, 0, 16, 1}, {1, 3, 17, 1}, {1, 1,
    18, 1}, {1, 4, 19, 1}, {2, 2, 20, 1}, {2, 5, 21, 1}, {2, 0, 22, 1}, {2, 3, 23, 1}, {2, 1, 24, 1}, {2, 4,
    25, 1}, {3, 2, 8, -1}, {3, 5, 9, -1}, {3, 0, 10, -1}, {3, 3, 11, -1}, {3, 1, 12, -1}, {3, 4, 13, -1}, {4,
    2, 14, -1}, {4, 5, 15, -1}, {4, 0, 16, -1}, {4, 3, 17, -1}, {4, 1, 18, -1}, {4, 4, 19, -1}, {5, 5, 26, 1},
    {5, 2, 27, 1}, {5, 0, 28, 1}, {5, 3, 29, 1}, {5, 1, 30, 1}, {5, 4, 31, 1}, {8, 8, 32, 1}, {8, 11, 33, 1},
    {9, 8, 34, 1}, {9, 11, 35, 1}, {0, 8, 36, 1}, {0, 6, 37, 1}, {0, 11, 38, 1}, {0, 9, 39, 1}, {0, 7, 40, 1},
    {0, 10, 41, 1}, {1, 8, 42, 1}, {1, 6, 43, 1}, {1, 11, 44, 1}, {1, 9, 45, 1}, {1, 7, 46, 1}, {1, 10, 47,
    1}, {2, 8, 48, 1}, {2, 6, 49, 1}, {2, 11, 50, 1}, {2, 9, 51, 1}, {2, 7, 52, 1}, {2, 10, 53, 1}, {3, 8, 36,
    -1}, {3, 6, 37, -1}, {3, 11, 38, -1}, {3, 9, 39, -1}, {3, 7, 40, -1}, {3, 10, 41, -1}, {4, 8, 42, -1}, {4,
    6, 43, -1}, {4, 11, 44, -1}, {4, 9, 45, -1}, {4, 7, 46, -1}, {4, 10, 47, -1}, {5, 8, 54, 1}, {5, 6, 55,
    1}, {5, 11, 56, 1}, {5, 9, 57, 1}, {5, 7, 58, 1}, {5, 10, 59, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 5, 60, 1}, {1, 2, 61, 1}, {1, 0, 62, 1}, {1, 3, 63, 1}, {1, 1, 64, 1}, {1, 4, 65, 1}, {1, 8, 66, 1},
    {1, 6, 67, 1}, {1, 11, 68, 1}, {1, 9, 69, 1}, {1, 7, 70, 1}, {1, 10, 71, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 11,
    N_RESIDUAL = 80,
    N_RESIDUAL_T = 0,
    N_POWER = 12,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 11,
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
