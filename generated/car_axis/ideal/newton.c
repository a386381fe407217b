/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[52]; /* what linearize() found */
    double lu[67];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_y = q[1];
    const double axle_theta = q[2];
    const double axle_vx = v[0];
    const double axle_vy = v[1];
    const double axle_omega = v[2];
    const double road_x = q[3];
    const double road_y = q[4];
    const double road_theta = q[5];
    const double road_vx = v[3];
    const double road_vy = v[4];
    const double road_omega = v[5];
    const double time = t;
    const double acceleration_axle_x_2 = a[0];
    const double acceleration_axle_y_2 = a[1];
    const double acceleration_axle_theta_2 = a[2];
    const double acceleration_road_x_2 = a[3];
    const double acceleration_road_y_2 = a[4];
    const double acceleration_road_theta_2 = a[5];
    const double multiplier_foot_x_2 = aside->lambda[0];
    const double multiplier_foot_y_2 = aside->lambda[1];
    const double multiplier_slot_offset_2 = aside->lambda[2];
    const double multiplier_bump_2 = aside->lambda[3];

    /* parameters */
    const double length = p->length;
    const double par_r = p->par_r;
    const double omega = p->omega;
    const double axle_head_x = p->axle_head_x;
    const double road_head_x = p->road_head_x;
    const double left_stiffness = p->left_stiffness;
    const double left_free_length = p->left_free_length;
    const double right_stiffness = p->right_stiffness;
    const double right_free_length = p->right_free_length;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*road_head_x;
    const double arm_road_head_y = road_head_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = axle_head_x*cos_theta_axle;
    const double arm_axle_head_y = axle_head_x*sin_theta_axle;
    const double bump_rate = omega*par_r*cos(omega*time)/(length*sqrt(1.0 - (par_r * par_r)*(sin(omega*time) *
        sin(omega*time))/(length * length)));
    const double bump_acceleration = -(omega * omega)*par_r*sin(omega*time)/(length*sqrt(1.0 - (par_r *
        par_r)*(sin(omega*time) * sin(omega*time))/(length * length))) + (omega * omega)*(par_r * par_r *
        par_r)*sin(omega*time)*(cos(omega*time) * cos(omega*time))/((length * length * length)*pow(1.0 -
        (par_r * par_r)*(sin(omega*time) * sin(omega*time))/(length * length), 1.5));
    const double left_span_x = -arm_axle_head_x + axle_x;
    const double left_span_y = -arm_axle_head_y + axle_y;
    const double left_length = sqrt((left_span_x * left_span_x) + (left_span_y * left_span_y));
    const double left_force = left_stiffness*(-left_free_length + left_length);
    const double left_pull = left_force/left_length;
    const double right_span_x = arm_axle_head_x - arm_road_head_x + axle_x - road_x;
    const double right_span_y = arm_axle_head_y - arm_road_head_y + axle_y - road_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = right_stiffness*(-right_free_length + right_length);
    const double right_pull = right_force/right_length;

    /* constraints */
    const double inverse_length = 1.0/length;
    const double bump_acceleration_by_time = 3.0*pow(inverse_length, 5.0)*(omega * omega * omega)*pow(par_r,
        5.0)*(sin(omega*time) * sin(omega*time))*(cos(omega*time) * cos(omega*time) *
        cos(omega*time))/pow(-(inverse_length * inverse_length)*(par_r * par_r)*(sin(omega*time) *
        sin(omega*time)) + 1.0, 2.5) - 3.0*(inverse_length * inverse_length * inverse_length)*(omega * omega *
        omega)*(par_r * par_r * par_r)*(sin(omega*time) *
        sin(omega*time))*cos(omega*time)/pow(-(inverse_length * inverse_length)*(par_r *
        par_r)*(sin(omega*time) * sin(omega*time)) + 1.0, 1.5) + (inverse_length * inverse_length *
        inverse_length)*(omega * omega * omega)*(par_r * par_r * par_r)*(cos(omega*time) * cos(omega*time) *
        cos(omega*time))/pow(-(inverse_length * inverse_length)*(par_r * par_r)*(sin(omega*time) *
        sin(omega*time)) + 1.0, 1.5) - inverse_length*(omega * omega *
        omega)*par_r*cos(omega*time)/sqrt(-(inverse_length * inverse_length)*(par_r * par_r)*(sin(omega*time)
        * sin(omega*time)) + 1.0);

    /* coordinates */
    const double inverse_denominator = 1.0/(left_length + 1e-150);
    const double left_length_by_axle_theta = -arm_axle_head_x*inverse_denominator*left_span_y +
        arm_axle_head_y*inverse_denominator*left_span_x;
    const double left_length_by_axle_x = inverse_denominator*left_span_x;
    const double left_length_by_axle_y = inverse_denominator*left_span_y;
    const double left_force_by_axle_theta = left_length_by_axle_theta*left_stiffness;
    const double left_force_by_axle_x = left_length_by_axle_x*left_stiffness;
    const double left_force_by_axle_y = left_length_by_axle_y*left_stiffness;
    const double inverse_left_length = 1.0/left_length;
    const double left_pull_by_axle_theta = -(inverse_left_length *
        inverse_left_length)*left_force*left_length_by_axle_theta +
        inverse_left_length*left_force_by_axle_theta;
    const double left_pull_by_axle_x = -(inverse_left_length *
        inverse_left_length)*left_force*left_length_by_axle_x + inverse_left_length*left_force_by_axle_x;
    const double left_pull_by_axle_y = -(inverse_left_length *
        inverse_left_length)*left_force*left_length_by_axle_y + inverse_left_length*left_force_by_axle_y;
    const double inverse_denominator_2 = 1.0/(right_length + 1e-150);
    const double right_length_by_axle_theta = arm_axle_head_x*inverse_denominator_2*right_span_y -
        arm_axle_head_y*inverse_denominator_2*right_span_x;
    const double right_length_by_road_theta = -arm_road_head_x*inverse_denominator_2*right_span_y +
        arm_road_head_y*inverse_denominator_2*right_span_x;
    const double right_length_by_axle_x = inverse_denominator_2*right_span_x;
    const double right_length_by_road_x = -inverse_denominator_2*right_span_x;
    const double right_length_by_axle_y = inverse_denominator_2*right_span_y;
    const double right_length_by_road_y = -inverse_denominator_2*right_span_y;
    const double right_force_by_axle_theta = right_length_by_axle_theta*right_stiffness;
    const double right_force_by_road_theta = right_length_by_road_theta*right_stiffness;
    const double right_force_by_axle_x = right_length_by_axle_x*right_stiffness;
    const double right_force_by_road_x = right_length_by_road_x*right_stiffness;
    const double right_force_by_axle_y = right_length_by_axle_y*right_stiffness;
    const double right_force_by_road_y = right_length_by_road_y*right_stiffness;
    const double inverse_right_length = 1.0/right_length;
    const double right_pull_by_axle_theta = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_axle_theta +
        inverse_right_length*right_force_by_axle_theta;
    const double right_pull_by_road_theta = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_road_theta +
        inverse_right_length*right_force_by_road_theta;
    const double right_pull_by_axle_x = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_axle_x + inverse_right_length*right_force_by_axle_x;
    const double right_pull_by_road_x = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_road_x + inverse_right_length*right_force_by_road_x;
    const double right_pull_by_axle_y = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_axle_y + inverse_right_length*right_force_by_axle_y;
    const double right_pull_by_road_y = -(inverse_right_length *
        inverse_right_length)*right_force*right_length_by_road_y + inverse_right_length*right_force_by_road_y;

    /* results */
    lin->value[0] = -arm_road_head_y;
    lin->value[1] = arm_road_head_x;
    lin->value[2] = -cos_theta_road;
    lin->value[3] = -sin_theta_road;
    lin->value[4] = arm_axle_head_x*sin_theta_road - arm_axle_head_y*cos_theta_road;
    lin->value[5] = -arm_axle_head_x*sin_theta_road + arm_axle_head_y*cos_theta_road + axle_x*sin_theta_road -
        axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road;
    lin->value[6] = -acceleration_road_theta_2*arm_road_head_x - arm_road_head_x*road_omega*two_alpha +
        arm_road_head_y*(road_omega * road_omega);
    lin->value[7] = -acceleration_road_theta_2*arm_road_head_y - arm_road_head_x*(road_omega * road_omega) -
        arm_road_head_y*road_omega*two_alpha;
    lin->value[8] = arm_axle_head_x*(-acceleration_axle_theta_2*cos_theta_road +
        acceleration_road_theta_2*cos_theta_road + axle_omega*(-axle_omega*sin_theta_road +
        road_omega*sin_theta_road) - road_omega*sin_theta_road*(-axle_omega + road_omega)) -
        arm_axle_head_y*(acceleration_axle_theta_2*sin_theta_road - acceleration_road_theta_2*sin_theta_road +
        axle_omega*(-axle_omega*cos_theta_road + cos_theta_road*road_omega) +
        cos_theta_road*road_omega*(axle_omega - road_omega)) +
        two_alpha*(arm_axle_head_x*(-axle_omega*cos_theta_road + cos_theta_road*road_omega) -
        arm_axle_head_y*(axle_omega*sin_theta_road - road_omega*sin_theta_road));
    lin->value[9] = acceleration_road_theta_2*sin_theta_road + cos_theta_road*(road_omega * road_omega) +
        road_omega*sin_theta_road*two_alpha;
    lin->value[10] = -acceleration_road_theta_2*cos_theta_road - cos_theta_road*road_omega*two_alpha +
        (road_omega * road_omega)*sin_theta_road;
    lin->value[11] = cos_theta_road*(acceleration_axle_theta_2*arm_axle_head_x - acceleration_axle_y_2 +
        acceleration_road_theta_2*(-arm_axle_head_x + axle_x - road_x) + acceleration_road_y_2 -
        arm_axle_head_y*axle_omega*(axle_omega - road_omega) + axle_vx*road_omega - road_omega*road_vx +
        road_omega*(arm_axle_head_y*axle_omega + axle_vx - road_omega*(arm_axle_head_y - axle_y + road_y) -
        road_vx)) - sin_theta_road*(-acceleration_axle_theta_2*arm_axle_head_y - acceleration_axle_x_2 +
        acceleration_road_theta_2*(arm_axle_head_y - axle_y + road_y) + acceleration_road_x_2 +
        arm_axle_head_x*axle_omega*(-axle_omega + road_omega) - axle_vy*road_omega + road_omega*road_vy +
        road_omega*(arm_axle_head_x*axle_omega - axle_vy + road_omega*(-arm_axle_head_x + axle_x - road_x) +
        road_vy)) + two_alpha*(cos_theta_road*(arm_axle_head_x*axle_omega - axle_vy +
        road_omega*(-arm_axle_head_x + axle_x - road_x) + road_vy) -
        sin_theta_road*(-arm_axle_head_y*axle_omega - axle_vx + road_omega*(arm_axle_head_y - axle_y + road_y)
        + road_vx));
    lin->value[12] = arm_road_head_y*right_pull + multiplier_slot_offset_2*sin_theta_road +
        right_pull_by_road_theta*right_span_x;
    lin->value[13] = arm_axle_head_y*left_pull - arm_axle_head_y*right_pull +
        left_pull_by_axle_theta*left_span_x + right_pull_by_axle_theta*right_span_x;
    lin->value[14] = left_pull + left_pull_by_axle_x*left_span_x + right_pull +
        right_pull_by_axle_x*right_span_x;
    lin->value[15] = left_pull_by_axle_y*left_span_x + right_pull_by_axle_y*right_span_x;
    lin->value[16] = -right_pull + right_pull_by_road_x*right_span_x;
    lin->value[17] = right_pull_by_road_y*right_span_x;
    lin->value[18] = -arm_axle_head_x*left_pull + arm_axle_head_x*right_pull +
        left_pull_by_axle_theta*left_span_y + right_pull_by_axle_theta*right_span_y;
    lin->value[19] = left_pull_by_axle_x*left_span_y + right_pull_by_axle_x*right_span_y;
    lin->value[20] = left_pull + left_pull_by_axle_y*left_span_y + right_pull +
        right_pull_by_axle_y*right_span_y;
    lin->value[21] = -arm_road_head_x*right_pull - cos_theta_road*multiplier_slot_offset_2 +
        right_pull_by_road_theta*right_span_y;
    lin->value[22] = right_pull_by_road_x*right_span_y;
    lin->value[23] = -right_pull + right_pull_by_road_y*right_span_y;
    lin->value[24] = (arm_axle_head_x * arm_axle_head_x)*left_pull + (arm_axle_head_x *
        arm_axle_head_x)*right_pull + arm_axle_head_x*(-cos_theta_road*multiplier_slot_offset_2 +
        left_pull*left_span_x - right_pull*right_span_x) + (arm_axle_head_y * arm_axle_head_y)*left_pull +
        (arm_axle_head_y * arm_axle_head_y)*right_pull - arm_axle_head_y*(-left_pull*left_span_y +
        multiplier_slot_offset_2*sin_theta_road + right_pull*right_span_y) +
        left_pull_by_axle_theta*(-arm_axle_head_x*left_span_y + arm_axle_head_y*left_span_x) +
        right_pull_by_axle_theta*(arm_axle_head_x*right_span_y - arm_axle_head_y*right_span_x);
    lin->value[25] = -arm_axle_head_x*arm_road_head_x*right_pull +
        arm_axle_head_x*cos_theta_road*multiplier_slot_offset_2 - arm_axle_head_y*arm_road_head_y*right_pull +
        arm_axle_head_y*multiplier_slot_offset_2*sin_theta_road +
        right_pull_by_road_theta*(arm_axle_head_x*right_span_y - arm_axle_head_y*right_span_x);
    lin->value[26] = arm_axle_head_y*left_pull - arm_axle_head_y*right_pull +
        left_pull_by_axle_x*(-arm_axle_head_x*left_span_y + arm_axle_head_y*left_span_x) +
        right_pull_by_axle_x*(arm_axle_head_x*right_span_y - arm_axle_head_y*right_span_x);
    lin->value[27] = -arm_axle_head_x*left_pull + arm_axle_head_x*right_pull +
        left_pull_by_axle_y*(-arm_axle_head_x*left_span_y + arm_axle_head_y*left_span_x) +
        right_pull_by_axle_y*(arm_axle_head_x*right_span_y - arm_axle_head_y*right_span_x);
    lin->value[28] = arm_axle_head_y*right_pull + right_pull_by_road_x*(arm_axle_head_x*right_span_y -
        arm_axle_head_y*right_span_x);
    lin->value[29] = -arm_axle_head_x*right_pull + right_pull_by_road_y*(arm_axle_head_x*right_span_y -
        arm_axle_head_y*right_span_x);
    lin->value[30] = arm_axle_head_y*right_pull - right_pull_by_axle_theta*right_span_x;
    lin->value[31] = -right_pull - right_pull_by_axle_x*right_span_x;
    lin->value[32] = -right_pull_by_axle_y*right_span_x;
    lin->value[33] = -arm_axle_head_x*right_pull - right_pull_by_axle_theta*right_span_y;
    lin->value[34] = -right_pull_by_axle_x*right_span_y;
    lin->value[35] = -right_pull - right_pull_by_axle_y*right_span_y;
    lin->value[36] = -arm_axle_head_x*arm_road_head_x*right_pull +
        arm_axle_head_x*cos_theta_road*multiplier_slot_offset_2 - arm_axle_head_y*arm_road_head_y*right_pull +
        arm_axle_head_y*multiplier_slot_offset_2*sin_theta_road +
        right_pull_by_axle_theta*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[37] = (arm_road_head_x * arm_road_head_x)*right_pull + arm_road_head_x*(-multiplier_foot_x_2 +
        right_pull*right_span_x) + (arm_road_head_y * arm_road_head_y)*right_pull -
        arm_road_head_y*(multiplier_foot_y_2 - right_pull*right_span_y) +
        cos_theta_road*multiplier_slot_offset_2*(-arm_axle_head_x + axle_x - road_x) -
        multiplier_slot_offset_2*sin_theta_road*(arm_axle_head_y - axle_y + road_y) +
        right_pull_by_road_theta*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[38] = arm_road_head_y*right_pull + multiplier_slot_offset_2*sin_theta_road +
        right_pull_by_axle_x*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[39] = -arm_road_head_x*right_pull - cos_theta_road*multiplier_slot_offset_2 +
        right_pull_by_axle_y*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[40] = -arm_road_head_y*right_pull - multiplier_slot_offset_2*sin_theta_road +
        right_pull_by_road_x*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[41] = arm_road_head_x*right_pull + cos_theta_road*multiplier_slot_offset_2 +
        right_pull_by_road_y*(-arm_road_head_x*right_span_y + arm_road_head_y*right_span_x);
    lin->value[42] = -2.0*arm_road_head_x*road_omega;
    lin->value[43] = -2.0*arm_road_head_y*road_omega;
    lin->value[44] = arm_axle_head_x*(-axle_omega*cos_theta_road + cos_theta_road*road_omega) -
        arm_axle_head_y*(axle_omega*sin_theta_road - road_omega*sin_theta_road) +
        axle_omega*(-arm_axle_head_x*cos_theta_road - arm_axle_head_y*sin_theta_road) +
        road_omega*(arm_axle_head_x*cos_theta_road + arm_axle_head_y*sin_theta_road);
    lin->value[45] = 2.0*road_omega*sin_theta_road;
    lin->value[46] = -2.0*cos_theta_road*road_omega;
    lin->value[47] = axle_omega*(arm_axle_head_x*cos_theta_road + arm_axle_head_y*sin_theta_road) +
        axle_vx*sin_theta_road - axle_vy*cos_theta_road + cos_theta_road*road_vy +
        cos_theta_road*(arm_axle_head_x*axle_omega - axle_vy + road_omega*(-arm_axle_head_x + axle_x - road_x)
        + road_vy) + road_omega*(cos_theta_road*(-arm_axle_head_x + axle_x - road_x) -
        sin_theta_road*(arm_axle_head_y - axle_y + road_y)) - road_vx*sin_theta_road -
        sin_theta_road*(-arm_axle_head_y*axle_omega - axle_vx + road_omega*(arm_axle_head_y - axle_y + road_y)
        + road_vx);
    lin->value[48] = -beta_squared*bump_rate - bump_acceleration*two_alpha - bump_acceleration_by_time;
    lin->value[49] = -bump_rate;
    lin->value[50] = -bump_acceleration*multiplier_bump_2;
    lin->value[51] = -1.0;
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
    const double phi_foot_x_road_theta = lin->value[0];
    const double phi_foot_y_road_theta = lin->value[1];
    const double phi_slot_offset_axle_x = lin->value[2];
    const double phi_slot_offset_axle_y = lin->value[3];
    const double phi_slot_offset_axle_theta = lin->value[4];
    const double phi_slot_offset_road_theta = lin->value[5];
    const double by_q_foot_x_road_theta = lin->value[6];
    const double by_q_foot_y_road_theta = lin->value[7];
    const double by_q_slot_offset_axle_theta = lin->value[8];
    const double by_q_slot_offset_axle_x = lin->value[9];
    const double by_q_slot_offset_axle_y = lin->value[10];
    const double by_q_slot_offset_road_theta = lin->value[11];
    const double by_q_axle_x_road_theta = lin->value[12];
    const double by_q_axle_x_axle_theta = lin->value[13];
    const double by_q_axle_x_axle_x = lin->value[14];
    const double by_q_axle_x_axle_y = lin->value[15];
    const double by_q_axle_x_road_x = lin->value[16];
    const double by_q_axle_x_road_y = lin->value[17];
    const double by_q_axle_y_axle_theta = lin->value[18];
    const double by_q_axle_y_axle_x = lin->value[19];
    const double by_q_axle_y_axle_y = lin->value[20];
    const double by_q_axle_y_road_theta = lin->value[21];
    const double by_q_axle_y_road_x = lin->value[22];
    const double by_q_axle_y_road_y = lin->value[23];
    const double by_q_axle_theta_axle_theta = lin->value[24];
    const double by_q_axle_theta_road_theta = lin->value[25];
    const double by_q_axle_theta_axle_x = lin->value[26];
    const double by_q_axle_theta_axle_y = lin->value[27];
    const double by_q_axle_theta_road_x = lin->value[28];
    const double by_q_axle_theta_road_y = lin->value[29];
    const double by_q_road_x_axle_theta = lin->value[30];
    const double by_q_road_x_axle_x = lin->value[31];
    const double by_q_road_x_axle_y = lin->value[32];
    const double by_q_road_y_axle_theta = lin->value[33];
    const double by_q_road_y_axle_x = lin->value[34];
    const double by_q_road_y_axle_y = lin->value[35];
    const double by_q_road_theta_axle_theta = lin->value[36];
    const double by_q_road_theta_road_theta = lin->value[37];
    const double by_q_road_theta_axle_x = lin->value[38];
    const double by_q_road_theta_axle_y = lin->value[39];
    const double by_q_road_theta_road_x = lin->value[40];
    const double by_q_road_theta_road_y = lin->value[41];
    const double by_v_foot_x_road_theta = lin->value[42];
    const double by_v_foot_y_road_theta = lin->value[43];
    const double by_v_slot_offset_axle_theta = lin->value[44];
    const double by_v_slot_offset_axle_x = lin->value[45];
    const double by_v_slot_offset_axle_y = lin->value[46];
    const double by_v_slot_offset_road_theta = lin->value[47];

    /* parameters */
    const double axle_mass = p->axle_mass;
    const double axle_inertia = p->axle_inertia;
    const double road_mass = p->road_mass;
    const double road_inertia = p->road_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_axle_x__axle_x = axle_mass + by_q_axle_x_axle_x*(eta * eta);
    const double n_axle_x__axle_y = by_q_axle_x_axle_y*(eta * eta);
    const double n_axle_x__axle_theta = by_q_axle_x_axle_theta*(eta * eta);
    const double n_axle_x__road_x = by_q_axle_x_road_x*(eta * eta);
    const double n_axle_x__road_y = by_q_axle_x_road_y*(eta * eta);
    const double n_axle_x__road_theta = by_q_axle_x_road_theta*(eta * eta);
    const double n_axle_y__axle_x = by_q_axle_y_axle_x*(eta * eta);
    const double n_axle_y__axle_y = axle_mass + by_q_axle_y_axle_y*(eta * eta);
    const double n_axle_y__axle_theta = by_q_axle_y_axle_theta*(eta * eta);
    const double n_axle_y__road_x = by_q_axle_y_road_x*(eta * eta);
    const double n_axle_y__road_y = by_q_axle_y_road_y*(eta * eta);
    const double n_axle_y__road_theta = by_q_axle_y_road_theta*(eta * eta);
    const double n_axle_theta__axle_x = by_q_axle_theta_axle_x*(eta * eta);
    const double n_axle_theta__axle_y = by_q_axle_theta_axle_y*(eta * eta);
    const double n_axle_theta__axle_theta = axle_inertia + by_q_axle_theta_axle_theta*(eta * eta);
    const double n_axle_theta__road_x = by_q_axle_theta_road_x*(eta * eta);
    const double n_axle_theta__road_y = by_q_axle_theta_road_y*(eta * eta);
    const double n_axle_theta__road_theta = by_q_axle_theta_road_theta*(eta * eta);
    const double n_road_x__axle_x = by_q_road_x_axle_x*(eta * eta);
    const double n_road_x__axle_y = by_q_road_x_axle_y*(eta * eta);
    const double n_road_x__axle_theta = by_q_road_x_axle_theta*(eta * eta);
    const double n_road_x__road_x = -by_q_axle_x_road_x*(eta * eta) + road_mass;
    const double n_road_x__road_y = -by_q_axle_x_road_y*(eta * eta);
    const double n_road_x__road_theta = -by_q_axle_x_road_theta*(eta * eta);
    const double n_road_y__axle_x = by_q_road_y_axle_x*(eta * eta);
    const double n_road_y__axle_y = by_q_road_y_axle_y*(eta * eta);
    const double n_road_y__axle_theta = by_q_road_y_axle_theta*(eta * eta);
    const double n_road_y__road_x = -by_q_axle_y_road_x*(eta * eta);
    const double n_road_y__road_y = -by_q_axle_y_road_y*(eta * eta) + road_mass;
    const double n_road_y__road_theta = -by_q_axle_y_road_theta*(eta * eta);
    const double n_road_theta__axle_x = by_q_road_theta_axle_x*(eta * eta);
    const double n_road_theta__axle_y = by_q_road_theta_axle_y*(eta * eta);
    const double n_road_theta__axle_theta = by_q_road_theta_axle_theta*(eta * eta);
    const double n_road_theta__road_x = by_q_road_theta_road_x*(eta * eta);
    const double n_road_theta__road_y = by_q_road_theta_road_y*(eta * eta);
    const double n_road_theta__road_theta = by_q_road_theta_road_theta*(eta * eta) + road_inertia;
    const double n_foot_x__road_theta = eta_row*(by_q_foot_x_road_theta*eta + by_v_foot_x_road_theta) +
        phi_foot_x_road_theta;
    const double n_foot_y__road_theta = eta_row*(by_q_foot_y_road_theta*eta + by_v_foot_y_road_theta) +
        phi_foot_y_road_theta;
    const double n_slot_offset__axle_x = eta_row*(by_q_slot_offset_axle_x*eta + by_v_slot_offset_axle_x) +
        phi_slot_offset_axle_x;
    const double n_slot_offset__axle_y = eta_row*(by_q_slot_offset_axle_y*eta + by_v_slot_offset_axle_y) +
        phi_slot_offset_axle_y;
    const double n_slot_offset__axle_theta = eta_row*(by_q_slot_offset_axle_theta*eta +
        by_v_slot_offset_axle_theta) + phi_slot_offset_axle_theta;
    const double n_slot_offset__road_x = eta_row*(-by_q_slot_offset_axle_x*eta - by_v_slot_offset_axle_x) -
        phi_slot_offset_axle_x;
    const double n_slot_offset__road_y = eta_row*(-by_q_slot_offset_axle_y*eta - by_v_slot_offset_axle_y) -
        phi_slot_offset_axle_y;
    const double n_slot_offset__road_theta = eta_row*(by_q_slot_offset_road_theta*eta +
        by_v_slot_offset_road_theta) + phi_slot_offset_road_theta;

    /* L U */
    const double scale_axle_x = n_axle_x__axle_x;
    if (!(fabs(scale_axle_x) > 1e-13 * fabs(n_axle_x__axle_x)))
        return 1;
    const double inverse_pivot_axle_x = 1.0/scale_axle_x;
    lin->lu[0] = inverse_pivot_axle_x;
    const double l_axle_y__axle_x = inverse_pivot_axle_x*n_axle_y__axle_x;
    lin->lu[1] = l_axle_y__axle_x;
    lin->lu[2] = n_axle_x__axle_y;
    const double l_axle_theta__axle_x = inverse_pivot_axle_x*n_axle_theta__axle_x;
    lin->lu[3] = l_axle_theta__axle_x;
    lin->lu[4] = n_axle_x__axle_theta;
    const double l_road_x__axle_x = inverse_pivot_axle_x*n_road_x__axle_x;
    lin->lu[5] = l_road_x__axle_x;
    lin->lu[6] = n_axle_x__road_x;
    const double l_road_y__axle_x = inverse_pivot_axle_x*n_road_y__axle_x;
    lin->lu[7] = l_road_y__axle_x;
    lin->lu[8] = n_axle_x__road_y;
    const double l_road_theta__axle_x = inverse_pivot_axle_x*n_road_theta__axle_x;
    lin->lu[9] = l_road_theta__axle_x;
    lin->lu[10] = n_axle_x__road_theta;
    const double l_slot_offset__axle_x_2 = inverse_pivot_axle_x*n_slot_offset__axle_x;
    lin->lu[11] = l_slot_offset__axle_x_2;
    const double scale_axle_y = -l_axle_y__axle_x*n_axle_x__axle_y + n_axle_y__axle_y;
    if (!(fabs(scale_axle_y) > 1e-13 * fabs(n_axle_y__axle_y)))
        return 2;
    const double inverse_pivot_axle_y = 1.0/scale_axle_y;
    lin->lu[12] = inverse_pivot_axle_y;
    const double l_axle_theta__axle_y = inverse_pivot_axle_y*(-l_axle_theta__axle_x*n_axle_x__axle_y +
        n_axle_theta__axle_y);
    lin->lu[13] = l_axle_theta__axle_y;
    const double u_axle_y__axle_theta = -l_axle_y__axle_x*n_axle_x__axle_theta + n_axle_y__axle_theta;
    lin->lu[14] = u_axle_y__axle_theta;
    const double l_road_x__axle_y = inverse_pivot_axle_y*(-l_road_x__axle_x*n_axle_x__axle_y +
        n_road_x__axle_y);
    lin->lu[15] = l_road_x__axle_y;
    const double u_axle_y__road_x = -l_axle_y__axle_x*n_axle_x__road_x + n_axle_y__road_x;
    lin->lu[16] = u_axle_y__road_x;
    const double l_road_y__axle_y = inverse_pivot_axle_y*(-l_road_y__axle_x*n_axle_x__axle_y +
        n_road_y__axle_y);
    lin->lu[17] = l_road_y__axle_y;
    const double u_axle_y__road_y = -l_axle_y__axle_x*n_axle_x__road_y + n_axle_y__road_y;
    lin->lu[18] = u_axle_y__road_y;
    const double l_road_theta__axle_y = inverse_pivot_axle_y*(-l_road_theta__axle_x*n_axle_x__axle_y +
        n_road_theta__axle_y);
    lin->lu[19] = l_road_theta__axle_y;
    const double u_axle_y__road_theta = -l_axle_y__axle_x*n_axle_x__road_theta + n_axle_y__road_theta;
    lin->lu[20] = u_axle_y__road_theta;
    const double l_slot_offset__axle_y_2 = inverse_pivot_axle_y*(-l_slot_offset__axle_x_2*n_axle_x__axle_y +
        n_slot_offset__axle_y);
    lin->lu[21] = l_slot_offset__axle_y_2;
    const double u_axle_y__slot_offset = -l_axle_y__axle_x*phi_slot_offset_axle_x + phi_slot_offset_axle_y;
    lin->lu[22] = u_axle_y__slot_offset;
    const double scale_axle_theta = -l_axle_theta__axle_x*n_axle_x__axle_theta -
        l_axle_theta__axle_y*u_axle_y__axle_theta + n_axle_theta__axle_theta;
    if (!(fabs(scale_axle_theta) > 1e-13 * fabs(n_axle_theta__axle_theta)))
        return 3;
    const double inverse_pivot_axle_theta = 1.0/scale_axle_theta;
    lin->lu[23] = inverse_pivot_axle_theta;
    const double l_road_x__axle_theta = inverse_pivot_axle_theta*(-l_road_x__axle_x*n_axle_x__axle_theta -
        l_road_x__axle_y*u_axle_y__axle_theta + n_road_x__axle_theta);
    lin->lu[24] = l_road_x__axle_theta;
    const double u_axle_theta__road_x = -l_axle_theta__axle_x*n_axle_x__road_x -
        l_axle_theta__axle_y*u_axle_y__road_x + n_axle_theta__road_x;
    lin->lu[25] = u_axle_theta__road_x;
    const double l_road_y__axle_theta = inverse_pivot_axle_theta*(-l_road_y__axle_x*n_axle_x__axle_theta -
        l_road_y__axle_y*u_axle_y__axle_theta + n_road_y__axle_theta);
    lin->lu[26] = l_road_y__axle_theta;
    const double u_axle_theta__road_y = -l_axle_theta__axle_x*n_axle_x__road_y -
        l_axle_theta__axle_y*u_axle_y__road_y + n_axle_theta__road_y;
    lin->lu[27] = u_axle_theta__road_y;
    const double l_road_theta__axle_theta =
        inverse_pivot_axle_theta*(-l_road_theta__axle_x*n_axle_x__axle_theta -
        l_road_theta__axle_y*u_axle_y__axle_theta + n_road_theta__axle_theta);
    lin->lu[28] = l_road_theta__axle_theta;
    const double u_axle_theta__road_theta = -l_axle_theta__axle_x*n_axle_x__road_theta -
        l_axle_theta__axle_y*u_axle_y__road_theta + n_axle_theta__road_theta;
    lin->lu[29] = u_axle_theta__road_theta;
    const double l_slot_offset__axle_theta_2 =
        inverse_pivot_axle_theta*(-l_slot_offset__axle_x_2*n_axle_x__axle_theta -
        l_slot_offset__axle_y_2*u_axle_y__axle_theta + n_slot_offset__axle_theta);
    lin->lu[30] = l_slot_offset__axle_theta_2;
    const double u_axle_theta__slot_offset = -l_axle_theta__axle_x*phi_slot_offset_axle_x -
        l_axle_theta__axle_y*u_axle_y__slot_offset + phi_slot_offset_axle_theta;
    lin->lu[31] = u_axle_theta__slot_offset;
    const double scale_road_x = -l_road_x__axle_theta*u_axle_theta__road_x - l_road_x__axle_x*n_axle_x__road_x
        - l_road_x__axle_y*u_axle_y__road_x + n_road_x__road_x;
    if (!(fabs(scale_road_x) > 1e-13 * fabs(n_road_x__road_x)))
        return 4;
    const double inverse_pivot_road_x = 1.0/scale_road_x;
    lin->lu[32] = inverse_pivot_road_x;
    const double l_road_y__road_x = inverse_pivot_road_x*(-l_road_y__axle_theta*u_axle_theta__road_x -
        l_road_y__axle_x*n_axle_x__road_x - l_road_y__axle_y*u_axle_y__road_x + n_road_y__road_x);
    lin->lu[33] = l_road_y__road_x;
    const double u_road_x__road_y = -l_road_x__axle_theta*u_axle_theta__road_y -
        l_road_x__axle_x*n_axle_x__road_y - l_road_x__axle_y*u_axle_y__road_y + n_road_x__road_y;
    lin->lu[34] = u_road_x__road_y;
    const double l_road_theta__road_x = inverse_pivot_road_x*(-l_road_theta__axle_theta*u_axle_theta__road_x -
        l_road_theta__axle_x*n_axle_x__road_x - l_road_theta__axle_y*u_axle_y__road_x + n_road_theta__road_x);
    lin->lu[35] = l_road_theta__road_x;
    const double u_road_x__road_theta = -l_road_x__axle_theta*u_axle_theta__road_theta -
        l_road_x__axle_x*n_axle_x__road_theta - l_road_x__axle_y*u_axle_y__road_theta + n_road_x__road_theta;
    lin->lu[36] = u_road_x__road_theta;
    const double l_slot_offset__road_x_2 =
        inverse_pivot_road_x*(-l_slot_offset__axle_theta_2*u_axle_theta__road_x -
        l_slot_offset__axle_x_2*n_axle_x__road_x - l_slot_offset__axle_y_2*u_axle_y__road_x +
        n_slot_offset__road_x);
    lin->lu[37] = l_slot_offset__road_x_2;
    const double u_road_x__slot_offset = -l_road_x__axle_theta*u_axle_theta__slot_offset -
        l_road_x__axle_x*phi_slot_offset_axle_x - l_road_x__axle_y*u_axle_y__slot_offset -
        phi_slot_offset_axle_x;
    lin->lu[38] = u_road_x__slot_offset;
    const double scale_road_y = -l_road_y__axle_theta*u_axle_theta__road_y - l_road_y__axle_x*n_axle_x__road_y
        - l_road_y__axle_y*u_axle_y__road_y - l_road_y__road_x*u_road_x__road_y + n_road_y__road_y;
    if (!(fabs(scale_road_y) > 1e-13 * fabs(n_road_y__road_y)))
        return 5;
    const double inverse_pivot_road_y = 1.0/scale_road_y;
    lin->lu[39] = inverse_pivot_road_y;
    const double l_road_theta__road_y = inverse_pivot_road_y*(-l_road_theta__axle_theta*u_axle_theta__road_y -
        l_road_theta__axle_x*n_axle_x__road_y - l_road_theta__axle_y*u_axle_y__road_y -
        l_road_theta__road_x*u_road_x__road_y + n_road_theta__road_y);
    lin->lu[40] = l_road_theta__road_y;
    const double u_road_y__road_theta = -l_road_y__axle_theta*u_axle_theta__road_theta -
        l_road_y__axle_x*n_axle_x__road_theta - l_road_y__axle_y*u_axle_y__road_theta -
        l_road_y__road_x*u_road_x__road_theta + n_road_y__road_theta;
    lin->lu[41] = u_road_y__road_theta;
    const double l_foot_x__road_y = inverse_pivot_road_x*inverse_pivot_road_y*u_road_x__road_y;
    lin->lu[42] = l_foot_x__road_y;
    const double l_slot_offset__road_y_2 =
        inverse_pivot_road_y*(-l_slot_offset__axle_theta_2*u_axle_theta__road_y -
        l_slot_offset__axle_x_2*n_axle_x__road_y - l_slot_offset__axle_y_2*u_axle_y__road_y -
        l_slot_offset__road_x_2*u_road_x__road_y + n_slot_offset__road_y);
    lin->lu[43] = l_slot_offset__road_y_2;
    const double u_road_y__slot_offset = -l_road_y__axle_theta*u_axle_theta__slot_offset -
        l_road_y__axle_x*phi_slot_offset_axle_x - l_road_y__axle_y*u_axle_y__slot_offset -
        l_road_y__road_x*u_road_x__slot_offset - phi_slot_offset_axle_y;
    lin->lu[44] = u_road_y__slot_offset;
    const double scale_road_theta = -l_road_theta__axle_theta*u_axle_theta__road_theta -
        l_road_theta__axle_x*n_axle_x__road_theta - l_road_theta__axle_y*u_axle_y__road_theta -
        l_road_theta__road_x*u_road_x__road_theta - l_road_theta__road_y*u_road_y__road_theta +
        n_road_theta__road_theta;
    if (!(fabs(scale_road_theta) > 1e-13 * fabs(n_road_theta__road_theta)))
        return 6;
    const double inverse_pivot_road_theta = 1.0/scale_road_theta;
    lin->lu[45] = inverse_pivot_road_theta;
    const double l_foot_x__road_theta_2 = inverse_pivot_road_theta*(inverse_pivot_road_x*u_road_x__road_theta
        - l_foot_x__road_y*u_road_y__road_theta + n_foot_x__road_theta);
    lin->lu[46] = l_foot_x__road_theta_2;
    const double u_road_theta__foot_x = l_road_theta__road_x - l_road_theta__road_y*l_road_y__road_x +
        phi_foot_x_road_theta;
    lin->lu[47] = u_road_theta__foot_x;
    const double l_foot_y__road_theta_2 = inverse_pivot_road_theta*(inverse_pivot_road_y*u_road_y__road_theta
        + n_foot_y__road_theta);
    lin->lu[48] = l_foot_y__road_theta_2;
    const double u_road_theta__foot_y = l_road_theta__road_y + phi_foot_y_road_theta;
    lin->lu[49] = u_road_theta__foot_y;
    const double l_slot_offset__road_theta_2 =
        inverse_pivot_road_theta*(-l_slot_offset__axle_theta_2*u_axle_theta__road_theta -
        l_slot_offset__axle_x_2*n_axle_x__road_theta - l_slot_offset__axle_y_2*u_axle_y__road_theta -
        l_slot_offset__road_x_2*u_road_x__road_theta - l_slot_offset__road_y_2*u_road_y__road_theta +
        n_slot_offset__road_theta);
    lin->lu[50] = l_slot_offset__road_theta_2;
    const double u_road_theta__slot_offset = -l_road_theta__axle_theta*u_axle_theta__slot_offset -
        l_road_theta__axle_x*phi_slot_offset_axle_x - l_road_theta__axle_y*u_axle_y__slot_offset -
        l_road_theta__road_x*u_road_x__slot_offset - l_road_theta__road_y*u_road_y__slot_offset +
        phi_slot_offset_road_theta;
    lin->lu[51] = u_road_theta__slot_offset;
    const double scale_foot_x_2 = -inverse_pivot_road_x - l_foot_x__road_theta_2*u_road_theta__foot_x -
        l_foot_x__road_y*l_road_y__road_x;
    if (!(fabs(scale_foot_x_2) > 1e-08 * fabs(scale_foot_x_2)))
        return 7;
    const double inverse_pivot_foot_x_2 = 1.0/scale_foot_x_2;
    lin->lu[52] = inverse_pivot_foot_x_2;
    const double l_foot_y__foot_x_2 = inverse_pivot_foot_x_2*(inverse_pivot_road_y*l_road_y__road_x -
        l_foot_y__road_theta_2*u_road_theta__foot_x);
    lin->lu[53] = l_foot_y__foot_x_2;
    const double u_foot_x__foot_y = -l_foot_x__road_theta_2*u_road_theta__foot_y + l_foot_x__road_y;
    lin->lu[54] = u_foot_x__foot_y;
    const double l_slot_offset__foot_x_2 = inverse_pivot_foot_x_2*(-l_road_y__road_x*l_slot_offset__road_y_2 -
        l_slot_offset__road_theta_2*u_road_theta__foot_x + l_slot_offset__road_x_2);
    lin->lu[55] = l_slot_offset__foot_x_2;
    const double u_foot_x__slot_offset = inverse_pivot_road_x*u_road_x__slot_offset -
        l_foot_x__road_theta_2*u_road_theta__slot_offset - l_foot_x__road_y*u_road_y__slot_offset;
    lin->lu[56] = u_foot_x__slot_offset;
    const double l_bump__foot_x_2 = -inverse_pivot_foot_x_2*inverse_pivot_road_theta*u_road_theta__foot_x;
    lin->lu[57] = l_bump__foot_x_2;
    const double scale_foot_y_2 = -inverse_pivot_road_y - l_foot_y__road_theta_2*u_road_theta__foot_y;
    const double pivot_foot_y_2 = -l_foot_y__foot_x_2*u_foot_x__foot_y + scale_foot_y_2;
    if (!(fabs(pivot_foot_y_2) > 1e-08 * fabs(scale_foot_y_2)))
        return 8;
    const double inverse_pivot_foot_y_2 = 1.0/pivot_foot_y_2;
    lin->lu[58] = inverse_pivot_foot_y_2;
    const double l_slot_offset__foot_y_2 = inverse_pivot_foot_y_2*(-l_slot_offset__foot_x_2*u_foot_x__foot_y -
        l_slot_offset__road_theta_2*u_road_theta__foot_y + l_slot_offset__road_y_2);
    lin->lu[59] = l_slot_offset__foot_y_2;
    const double u_foot_y__slot_offset = inverse_pivot_road_y*u_road_y__slot_offset -
        l_foot_y__foot_x_2*u_foot_x__slot_offset - l_foot_y__road_theta_2*u_road_theta__slot_offset;
    lin->lu[60] = u_foot_y__slot_offset;
    const double l_bump__foot_y_2 = inverse_pivot_foot_y_2*(-inverse_pivot_road_theta*u_road_theta__foot_y -
        l_bump__foot_x_2*u_foot_x__foot_y);
    lin->lu[61] = l_bump__foot_y_2;
    const double u_foot_y__bump = l_foot_x__road_theta_2*l_foot_y__foot_x_2 - l_foot_y__road_theta_2;
    lin->lu[62] = u_foot_y__bump;
    const double scale_slot_offset_2 = -l_slot_offset__axle_theta_2*u_axle_theta__slot_offset -
        l_slot_offset__axle_x_2*phi_slot_offset_axle_x - l_slot_offset__axle_y_2*u_axle_y__slot_offset -
        l_slot_offset__road_theta_2*u_road_theta__slot_offset - l_slot_offset__road_x_2*u_road_x__slot_offset
        - l_slot_offset__road_y_2*u_road_y__slot_offset;
    const double pivot_slot_offset_2 = -l_slot_offset__foot_x_2*u_foot_x__slot_offset -
        l_slot_offset__foot_y_2*u_foot_y__slot_offset + scale_slot_offset_2;
    if (!(fabs(pivot_slot_offset_2) > 1e-08 * fabs(scale_slot_offset_2)))
        return 9;
    const double inverse_pivot_slot_offset_2 = 1.0/pivot_slot_offset_2;
    lin->lu[63] = inverse_pivot_slot_offset_2;
    const double l_bump__slot_offset_2 =
        inverse_pivot_slot_offset_2*(-inverse_pivot_road_theta*u_road_theta__slot_offset -
        l_bump__foot_x_2*u_foot_x__slot_offset - l_bump__foot_y_2*u_foot_y__slot_offset);
    lin->lu[64] = l_bump__slot_offset_2;
    const double u_slot_offset__bump = l_foot_x__road_theta_2*l_slot_offset__foot_x_2 -
        l_slot_offset__foot_y_2*u_foot_y__bump - l_slot_offset__road_theta_2;
    lin->lu[65] = u_slot_offset__bump;
    const double scale_bump_2 = -inverse_pivot_road_theta;
    const double pivot_bump_2 = l_bump__foot_x_2*l_foot_x__road_theta_2 - l_bump__foot_y_2*u_foot_y__bump -
        l_bump__slot_offset_2*u_slot_offset__bump + scale_bump_2;
    if (!(fabs(pivot_bump_2) > 1e-08 * fabs(scale_bump_2)))
        return 10;
    const double inverse_pivot_bump_2 = 1.0/pivot_bump_2;
    lin->lu[66] = inverse_pivot_bump_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[2];
    const double inverse_pivot_axle_x = lin->lu[0];
    const double l_axle_y__axle_x = lin->lu[1];
    const double n_axle_x__axle_y = lin->lu[2];
    const double l_axle_theta__axle_x = lin->lu[3];
    const double n_axle_x__axle_theta = lin->lu[4];
    const double l_road_x__axle_x = lin->lu[5];
    const double n_axle_x__road_x = lin->lu[6];
    const double l_road_y__axle_x = lin->lu[7];
    const double n_axle_x__road_y = lin->lu[8];
    const double l_road_theta__axle_x = lin->lu[9];
    const double n_axle_x__road_theta = lin->lu[10];
    const double l_slot_offset__axle_x_2 = lin->lu[11];
    const double inverse_pivot_axle_y = lin->lu[12];
    const double l_axle_theta__axle_y = lin->lu[13];
    const double u_axle_y__axle_theta = lin->lu[14];
    const double l_road_x__axle_y = lin->lu[15];
    const double u_axle_y__road_x = lin->lu[16];
    const double l_road_y__axle_y = lin->lu[17];
    const double u_axle_y__road_y = lin->lu[18];
    const double l_road_theta__axle_y = lin->lu[19];
    const double u_axle_y__road_theta = lin->lu[20];
    const double l_slot_offset__axle_y_2 = lin->lu[21];
    const double u_axle_y__slot_offset = lin->lu[22];
    const double inverse_pivot_axle_theta = lin->lu[23];
    const double l_road_x__axle_theta = lin->lu[24];
    const double u_axle_theta__road_x = lin->lu[25];
    const double l_road_y__axle_theta = lin->lu[26];
    const double u_axle_theta__road_y = lin->lu[27];
    const double l_road_theta__axle_theta = lin->lu[28];
    const double u_axle_theta__road_theta = lin->lu[29];
    const double l_slot_offset__axle_theta_2 = lin->lu[30];
    const double u_axle_theta__slot_offset = lin->lu[31];
    const double inverse_pivot_road_x = lin->lu[32];
    const double l_road_y__road_x = lin->lu[33];
    const double u_road_x__road_y = lin->lu[34];
    const double l_road_theta__road_x = lin->lu[35];
    const double u_road_x__road_theta = lin->lu[36];
    const double l_slot_offset__road_x_2 = lin->lu[37];
    const double u_road_x__slot_offset = lin->lu[38];
    const double inverse_pivot_road_y = lin->lu[39];
    const double l_road_theta__road_y = lin->lu[40];
    const double u_road_y__road_theta = lin->lu[41];
    const double l_foot_x__road_y = lin->lu[42];
    const double l_slot_offset__road_y_2 = lin->lu[43];
    const double u_road_y__slot_offset = lin->lu[44];
    const double inverse_pivot_road_theta = lin->lu[45];
    const double l_foot_x__road_theta_2 = lin->lu[46];
    const double u_road_theta__foot_x = lin->lu[47];
    const double l_foot_y__road_theta_2 = lin->lu[48];
    const double u_road_theta__foot_y = lin->lu[49];
    const double l_slot_offset__road_theta_2 = lin->lu[50];
    const double u_road_theta__slot_offset = lin->lu[51];
    const double inverse_pivot_foot_x_2 = lin->lu[52];
    const double l_foot_y__foot_x_2 = lin->lu[53];
    const double u_foot_x__foot_y = lin->lu[54];
    const double l_slot_offset__foot_x_2 = lin->lu[55];
    const double u_foot_x__slot_offset = lin->lu[56];
    const double l_bump__foot_x_2 = lin->lu[57];
    const double inverse_pivot_foot_y_2 = lin->lu[58];
    const double l_slot_offset__foot_y_2 = lin->lu[59];
    const double u_foot_y__slot_offset = lin->lu[60];
    const double l_bump__foot_y_2 = lin->lu[61];
    const double u_foot_y__bump = lin->lu[62];
    const double inverse_pivot_slot_offset_2 = lin->lu[63];
    const double l_bump__slot_offset_2 = lin->lu[64];
    const double u_slot_offset__bump = lin->lu[65];
    const double inverse_pivot_bump_2 = lin->lu[66];

    /* forward */
    const double b_axle_x = x[0];
    const double b_axle_y = -b_axle_x*l_axle_y__axle_x + x[1];
    const double b_axle_theta = -b_axle_x*l_axle_theta__axle_x - b_axle_y*l_axle_theta__axle_y + x[2];
    const double b_road_x = -b_axle_theta*l_road_x__axle_theta - b_axle_x*l_road_x__axle_x -
        b_axle_y*l_road_x__axle_y + x[3];
    const double b_road_y = -b_axle_theta*l_road_y__axle_theta - b_axle_x*l_road_y__axle_x -
        b_axle_y*l_road_y__axle_y - b_road_x*l_road_y__road_x + x[4];
    const double b_road_theta = -b_axle_theta*l_road_theta__axle_theta - b_axle_x*l_road_theta__axle_x -
        b_axle_y*l_road_theta__axle_y - b_road_x*l_road_theta__road_x - b_road_y*l_road_theta__road_y + x[5];
    const double b_foot_x = -b_road_theta*l_foot_x__road_theta_2 + b_road_x*inverse_pivot_road_x -
        b_road_y*l_foot_x__road_y + x[6];
    const double b_foot_y = -b_foot_x*l_foot_y__foot_x_2 - b_road_theta*l_foot_y__road_theta_2 +
        b_road_y*inverse_pivot_road_y + x[7];
    const double b_slot_offset = -b_axle_theta*l_slot_offset__axle_theta_2 - b_axle_x*l_slot_offset__axle_x_2
        - b_axle_y*l_slot_offset__axle_y_2 - b_foot_x*l_slot_offset__foot_x_2 -
        b_foot_y*l_slot_offset__foot_y_2 - b_road_theta*l_slot_offset__road_theta_2 -
        b_road_x*l_slot_offset__road_x_2 - b_road_y*l_slot_offset__road_y_2 + x[8];
    const double b_bump = -b_foot_x*l_bump__foot_x_2 - b_foot_y*l_bump__foot_y_2 -
        b_road_theta*inverse_pivot_road_theta - b_slot_offset*l_bump__slot_offset_2 + x[9];

    /* backward */
    const double x_bump = b_bump*inverse_pivot_bump_2;
    x[9] = x_bump;
    const double x_slot_offset = inverse_pivot_slot_offset_2*(b_slot_offset - u_slot_offset__bump*x_bump);
    x[8] = x_slot_offset;
    const double x_foot_y = inverse_pivot_foot_y_2*(b_foot_y - u_foot_y__bump*x_bump -
        u_foot_y__slot_offset*x_slot_offset);
    x[7] = x_foot_y;
    const double x_foot_x = inverse_pivot_foot_x_2*(b_foot_x + l_foot_x__road_theta_2*x_bump -
        u_foot_x__foot_y*x_foot_y - u_foot_x__slot_offset*x_slot_offset);
    x[6] = x_foot_x;
    const double x_road_theta = inverse_pivot_road_theta*(b_road_theta - u_road_theta__foot_x*x_foot_x -
        u_road_theta__foot_y*x_foot_y - u_road_theta__slot_offset*x_slot_offset - x_bump);
    x[5] = x_road_theta;
    const double x_road_y = inverse_pivot_road_y*(b_road_y - l_road_y__road_x*x_foot_x -
        u_road_y__road_theta*x_road_theta - u_road_y__slot_offset*x_slot_offset + x_foot_y);
    x[4] = x_road_y;
    const double x_road_x = inverse_pivot_road_x*(b_road_x - u_road_x__road_theta*x_road_theta -
        u_road_x__road_y*x_road_y - u_road_x__slot_offset*x_slot_offset + x_foot_x);
    x[3] = x_road_x;
    const double x_axle_theta = inverse_pivot_axle_theta*(b_axle_theta - u_axle_theta__road_theta*x_road_theta
        - u_axle_theta__road_x*x_road_x - u_axle_theta__road_y*x_road_y -
        u_axle_theta__slot_offset*x_slot_offset);
    x[2] = x_axle_theta;
    const double x_axle_y = inverse_pivot_axle_y*(b_axle_y - u_axle_y__axle_theta*x_axle_theta -
        u_axle_y__road_theta*x_road_theta - u_axle_y__road_x*x_road_x - u_axle_y__road_y*x_road_y -
        u_axle_y__slot_offset*x_slot_offset);
    x[1] = x_axle_y;
    const double x_axle_x = inverse_pivot_axle_x*(b_axle_x - n_axle_x__axle_theta*x_axle_theta -
        n_axle_x__axle_y*x_axle_y - n_axle_x__road_theta*x_road_theta - n_axle_x__road_x*x_road_x -
        n_axle_x__road_y*x_road_y - phi_slot_offset_axle_x*x_slot_offset);
    x[0] = x_axle_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_foot_x_road_theta = lin->value[0];
    const double phi_foot_y_road_theta = lin->value[1];
    const double phi_slot_offset_axle_x = lin->value[2];
    const double phi_slot_offset_axle_y = lin->value[3];
    const double phi_slot_offset_axle_theta = lin->value[4];
    const double phi_slot_offset_road_theta = lin->value[5];
    const double by_q_foot_x_road_theta = lin->value[6];
    const double by_q_foot_y_road_theta = lin->value[7];
    const double by_q_slot_offset_axle_theta = lin->value[8];
    const double by_q_slot_offset_axle_x = lin->value[9];
    const double by_q_slot_offset_axle_y = lin->value[10];
    const double by_q_slot_offset_road_theta = lin->value[11];
    const double by_q_axle_x_road_theta = lin->value[12];
    const double by_q_axle_x_axle_theta = lin->value[13];
    const double by_q_axle_x_axle_x = lin->value[14];
    const double by_q_axle_x_axle_y = lin->value[15];
    const double by_q_axle_x_road_x = lin->value[16];
    const double by_q_axle_x_road_y = lin->value[17];
    const double by_q_axle_y_axle_theta = lin->value[18];
    const double by_q_axle_y_axle_x = lin->value[19];
    const double by_q_axle_y_axle_y = lin->value[20];
    const double by_q_axle_y_road_theta = lin->value[21];
    const double by_q_axle_y_road_x = lin->value[22];
    const double by_q_axle_y_road_y = lin->value[23];
    const double by_q_axle_theta_axle_theta = lin->value[24];
    const double by_q_axle_theta_road_theta = lin->value[25];
    const double by_q_axle_theta_axle_x = lin->value[26];
    const double by_q_axle_theta_axle_y = lin->value[27];
    const double by_q_axle_theta_road_x = lin->value[28];
    const double by_q_axle_theta_road_y = lin->value[29];
    const double by_q_road_x_axle_theta = lin->value[30];
    const double by_q_road_x_axle_x = lin->value[31];
    const double by_q_road_x_axle_y = lin->value[32];
    const double by_q_road_y_axle_theta = lin->value[33];
    const double by_q_road_y_axle_x = lin->value[34];
    const double by_q_road_y_axle_y = lin->value[35];
    const double by_q_road_theta_axle_theta = lin->value[36];
    const double by_q_road_theta_road_theta = lin->value[37];
    const double by_q_road_theta_axle_x = lin->value[38];
    const double by_q_road_theta_axle_y = lin->value[39];
    const double by_q_road_theta_road_x = lin->value[40];
    const double by_q_road_theta_road_y = lin->value[41];
    const double by_t_bump = lin->value[48];
    const double power_0_bump = lin->value[49];
    const double power_t_0 = lin->value[50];

    /* parameters */
    const double axle_mass = p->axle_mass;
    const double axle_inertia = p->axle_inertia;
    const double road_mass = p->road_mass;
    const double road_inertia = p->road_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[10];
    const double shifted_axle_x = -beta_squared*eta*r[0] + r[6];
    const double shifted_axle_y = -beta_squared*eta*r[1] + r[7];
    const double shifted_axle_theta = -beta_squared*eta*r[2] + r[8];
    const double shifted_road_x = -beta_squared*eta*r[3] + r[9];
    const double shifted_road_y = -beta_squared*eta*r[4] + r[10];
    const double shifted_road_theta = -beta_squared*eta*r[5] + r[11];
    x[0] = eta*(axle_mass*r[6] - by_q_axle_x_axle_theta*eta*r[2] - by_q_axle_x_axle_x*eta*r[0] -
        by_q_axle_x_axle_y*eta*r[1] - by_q_axle_x_road_theta*eta*r[5] - by_q_axle_x_road_x*eta*r[3] -
        by_q_axle_x_road_y*eta*r[4]);
    x[1] = eta*(axle_mass*r[7] - by_q_axle_y_axle_theta*eta*r[2] - by_q_axle_y_axle_x*eta*r[0] -
        by_q_axle_y_axle_y*eta*r[1] - by_q_axle_y_road_theta*eta*r[5] - by_q_axle_y_road_x*eta*r[3] -
        by_q_axle_y_road_y*eta*r[4]);
    x[2] = eta*(axle_inertia*r[8] - by_q_axle_theta_axle_theta*eta*r[2] - by_q_axle_theta_axle_x*eta*r[0] -
        by_q_axle_theta_axle_y*eta*r[1] - by_q_axle_theta_road_theta*eta*r[5] -
        by_q_axle_theta_road_x*eta*r[3] - by_q_axle_theta_road_y*eta*r[4]);
    x[3] = eta*(by_q_axle_x_road_theta*eta*r[5] + by_q_axle_x_road_x*eta*r[3] + by_q_axle_x_road_y*eta*r[4] -
        by_q_road_x_axle_theta*eta*r[2] - by_q_road_x_axle_x*eta*r[0] - by_q_road_x_axle_y*eta*r[1] +
        r[9]*road_mass);
    x[4] = eta*(by_q_axle_y_road_theta*eta*r[5] + by_q_axle_y_road_x*eta*r[3] + by_q_axle_y_road_y*eta*r[4] -
        by_q_road_y_axle_theta*eta*r[2] - by_q_road_y_axle_x*eta*r[0] - by_q_road_y_axle_y*eta*r[1] +
        r[10]*road_mass);
    x[5] = eta*(-by_q_road_theta_axle_theta*eta*r[2] - by_q_road_theta_axle_x*eta*r[0] -
        by_q_road_theta_axle_y*eta*r[1] - by_q_road_theta_road_theta*eta*r[5] -
        by_q_road_theta_road_x*eta*r[3] - by_q_road_theta_road_y*eta*r[4] + r[11]*road_inertia);
    x[6] = eta_row*(-by_q_foot_x_road_theta*eta*r[5] + phi_foot_x_road_theta*shifted_road_theta -
        shifted_road_x);
    x[7] = eta_row*(-by_q_foot_y_road_theta*eta*r[5] + phi_foot_y_road_theta*shifted_road_theta -
        shifted_road_y);
    x[8] = eta_row*(-by_q_slot_offset_axle_theta*eta*r[2] - by_q_slot_offset_axle_x*eta*r[0] +
        by_q_slot_offset_axle_x*eta*r[3] - by_q_slot_offset_axle_y*eta*r[1] + by_q_slot_offset_axle_y*eta*r[4]
        - by_q_slot_offset_road_theta*eta*r[5] + phi_slot_offset_axle_theta*shifted_axle_theta +
        phi_slot_offset_axle_x*shifted_axle_x - phi_slot_offset_axle_x*shifted_road_x +
        phi_slot_offset_axle_y*shifted_axle_y - phi_slot_offset_axle_y*shifted_road_y +
        phi_slot_offset_road_theta*shifted_road_theta);
    x[9] = eta_row*(-by_t_bump*s + shifted_road_theta);
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
    u[12] = eta*(power_t_0*s + r[12]) + power_0_bump*x[9];
    u[13] = eta*r[13];
    u[14] = eta*r[14];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {6, 3, 51, 1}, {6, 5, 0, 1}, {7, 4, 51, 1}, {7, 5, 1, 1}, {8, 0, 2, 1}, {8, 1, 3, 1}, {8, 2, 4, 1}, {8, 3,
    2, -1}, {8, 4, 3, -1}, {8, 5, 5, 1}, {9, 5, 51, -1}
};
static const LinearEntry residual_entries[] = {
    {6, 5, 6, 1}, {7, 5, 7, 1}, {8, 2, 8, 1}, {8, 0, 9, 1}, {8, 1, 10, 1}, {8, 5, 11, 1}, {8, 3, 9, -1}, {8,
    4, 10, -1}, {0, 5, 12, 1}, {0, 2, 13, 1}, {0, 0, 14, 1}, {0, 1, 15, 1}, {0, 3, 16, 1}, {0, 4, 17, 1}, {1,
    2, 18, 1}, {1, 0, 19, 1}, {1, 1, 20, 1}, {1, 5, 21, 1}, {1, 3, 22, 1}, {1, 4, 23, 1}, {2, 2, 24, 1}, {2,
    5, 25, 1}, {2, 0, 26, 1}, {2, 1, 27, 1}, {2, 3, 28, 1}, {2, 4, 29, 1}, {3, 5, 12, -1}, {3, 2, 30, 1}, {3,
    0, 31, 1}, {3, 3, 16, -1}, {3, 1, 32, 1}, {3, 4, 17, -1}, {4, 2, 33, 1}, {4, 5, 21, -1}, {4, 0, 34, 1},
    {4, 3, 22, -1}, {4, 1, 35, 1}, {4, 4, 23, -1}, {5, 2, 36, 1}, {5, 5, 37, 1}, {5, 0, 38, 1}, {5, 1, 39, 1},
    {5, 3, 40, 1}, {5, 4, 41, 1}, {6, 11, 42, 1}, {7, 11, 43, 1}, {8, 8, 44, 1}, {8, 6, 45, 1}, {8, 7, 46, 1},
    {8, 11, 47, 1}, {8, 9, 45, -1}, {8, 10, 46, -1}
};
static const LinearEntry residual_t_entries[] = {
    {9, 0, 48, 1}
};
static const LinearEntry power_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_row_entries[] = {
    {0, 9, 49, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 50, 1}
};
enum {
    N_PHI_Q = 11,
    N_RESIDUAL = 52,
    N_RESIDUAL_T = 1,
    N_POWER = 0,
    N_POWER_ROW = 1,
    N_POWER_T = 1,
    N_NODES = 10,
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
