/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
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
    const double table_x = q[6];
    const double table_y = q[7];
    const double table_theta = q[8];
    const double table_vx = v[6];
    const double table_vy = v[7];
    const double table_omega = v[8];
    const double arm_x = q[9];
    const double arm_y = q[10];
    const double arm_theta = q[11];
    const double arm_vx = v[9];
    const double arm_vy = v[10];
    const double arm_omega = v[11];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double cos_theta_table = cos(table_theta);
    const double sin_theta_table = sin(table_theta);
    const double arm_table_top_x = -sin_theta_table*p->table_points_top_y;
    const double arm_table_top_y = cos_theta_table*p->table_points_top_y;
    const double cos_theta_arm = cos(arm_theta);
    const double sin_theta_arm = sin(arm_theta);
    const double arm_arm_head_x = p->arm_head_s_x*cos_theta_arm;
    const double arm_arm_head_y = p->arm_head_s_x*sin_theta_arm;
    const double motor_value = p->omega*t;
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_shaft_x = arm_crank_head_x - crank_x;
    const double phi_dot_shaft_x = -arm_crank_head_y*crank_omega - crank_vx;
    const double rhs_shaft_x = arm_crank_head_x*(crank_omega * crank_omega) - p->beta_squared*phi_shaft_x
        - phi_dot_shaft_x*p->two_alpha;
    aside->phi[0] = phi_shaft_x;
    aside->phi_dot[0] = phi_dot_shaft_x;
    const double phi_shaft_y = arm_crank_head_y - crank_y;
    const double phi_dot_shaft_y = arm_crank_head_x*crank_omega - crank_vy;
    const double rhs_shaft_y = arm_crank_head_y*(crank_omega * crank_omega) - p->beta_squared*phi_shaft_y
        - phi_dot_shaft_y*p->two_alpha;
    aside->phi[1] = phi_shaft_y;
    aside->phi_dot[1] = phi_dot_shaft_y;
    const double phi_crankpin_x = arm_crank_head_x + arm_rod_head_x + crank_x - rod_x;
    const double phi_dot_crankpin_x = -arm_crank_head_y*crank_omega - arm_rod_head_y*rod_omega + crank_vx - rod_vx;
    const double rhs_crankpin_x = arm_crank_head_x*(crank_omega * crank_omega) + arm_rod_head_x*(rod_omega * rod_omega)
        - p->beta_squared*phi_crankpin_x - phi_dot_crankpin_x*p->two_alpha;
    aside->phi[2] = phi_crankpin_x;
    aside->phi_dot[2] = phi_dot_crankpin_x;
    const double phi_crankpin_y = arm_crank_head_y + arm_rod_head_y + crank_y - rod_y;
    const double phi_dot_crankpin_y = arm_crank_head_x*crank_omega + arm_rod_head_x*rod_omega + crank_vy - rod_vy;
    const double rhs_crankpin_y = arm_crank_head_y*(crank_omega * crank_omega) + arm_rod_head_y*(rod_omega * rod_omega)
        - p->beta_squared*phi_crankpin_y - phi_dot_crankpin_y*p->two_alpha;
    aside->phi[3] = phi_crankpin_y;
    aside->phi_dot[3] = phi_dot_crankpin_y;
    const double phi_pin_x = arm_rod_head_x + rod_x - table_x;
    const double phi_dot_pin_x = -arm_rod_head_y*rod_omega + rod_vx - table_vx;
    const double rhs_pin_x = arm_rod_head_x*(rod_omega * rod_omega) - p->beta_squared*phi_pin_x
        - phi_dot_pin_x*p->two_alpha;
    aside->phi[4] = phi_pin_x;
    aside->phi_dot[4] = phi_dot_pin_x;
    const double phi_pin_y = arm_rod_head_y + rod_y - table_y;
    const double phi_dot_pin_y = arm_rod_head_x*rod_omega + rod_vy - table_vy;
    const double rhs_pin_y = arm_rod_head_y*(rod_omega * rod_omega) - p->beta_squared*phi_pin_y
        - phi_dot_pin_y*p->two_alpha;
    aside->phi[5] = phi_pin_y;
    aside->phi_dot[5] = phi_dot_pin_y;
    const double phi_guide_offset = -table_x;
    const double phi_dot_guide_offset = -table_vx;
    const double rhs_guide_offset = -p->beta_squared*phi_guide_offset - phi_dot_guide_offset*p->two_alpha;
    aside->phi[6] = phi_guide_offset;
    aside->phi_dot[6] = phi_dot_guide_offset;
    const double phi_guide_angle = table_theta;
    const double phi_dot_guide_angle = table_omega;
    const double rhs_guide_angle = -p->beta_squared*phi_guide_angle - phi_dot_guide_angle*p->two_alpha;
    aside->phi[7] = phi_guide_angle;
    aside->phi_dot[7] = phi_dot_guide_angle;
    const double phi_pivot_x = arm_arm_head_x + arm_table_top_x - arm_x + table_x;
    const double phi_dot_pivot_x = -arm_arm_head_y*arm_omega - arm_table_top_y*table_omega - arm_vx + table_vx;
    const double rhs_pivot_x = arm_arm_head_x*(arm_omega * arm_omega) + arm_table_top_x*(table_omega * table_omega)
        - p->beta_squared*phi_pivot_x - phi_dot_pivot_x*p->two_alpha;
    aside->phi[8] = phi_pivot_x;
    aside->phi_dot[8] = phi_dot_pivot_x;
    const double phi_pivot_y = arm_arm_head_y + arm_table_top_y - arm_y + table_y;
    const double phi_dot_pivot_y = arm_arm_head_x*arm_omega + arm_table_top_x*table_omega - arm_vy + table_vy;
    const double rhs_pivot_y = arm_arm_head_y*(arm_omega * arm_omega) + arm_table_top_y*(table_omega * table_omega)
        - p->beta_squared*phi_pivot_y - phi_dot_pivot_y*p->two_alpha;
    aside->phi[9] = phi_pivot_y;
    aside->phi_dot[9] = phi_dot_pivot_y;
    const double phi_motor = crank_theta - motor_value;
    const double phi_dot_motor = crank_omega - motor_rate;
    const double rhs_motor = -p->beta_squared*phi_motor + motor_acceleration - phi_dot_motor*p->two_alpha;
    aside->phi[10] = phi_motor;
    aside->phi_dot[10] = phi_dot_motor;

    /* L D L^T of the KKT matrix */
    const double l_pivot_x__arm_theta = -arm_arm_head_y*p->inverse_arm_inertia;
    const double l_pivot_y__arm_theta = arm_arm_head_x*p->inverse_arm_inertia;
    const double l_pivot_x__table_theta = -arm_table_top_y*p->inverse_table_inertia;
    const double l_pivot_y__table_theta = arm_table_top_x*p->inverse_table_inertia;
    const double scale_guide_angle = p->inverse_table_inertia;
    if (!(scale_guide_angle > 0.0 && scale_guide_angle < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_guide_angle = 1.0/scale_guide_angle;
    const double l_pivot_x__guide_angle = inverse_pivot_guide_angle*l_pivot_x__table_theta;
    const double l_pivot_y__guide_angle = inverse_pivot_guide_angle*l_pivot_y__table_theta;
    const double scale_guide_offset = p->inverse_table_mass;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    const double l_pivot_x__guide_offset = -inverse_pivot_guide_offset*p->inverse_table_mass;
    const double l_pin_x__guide_offset = inverse_pivot_guide_offset*p->inverse_table_mass;
    const double l_pin_y__rod_theta = arm_rod_head_x*p->inverse_rod_inertia;
    const double l_pin_x__rod_theta = -arm_rod_head_y*p->inverse_rod_inertia;
    const double l_crankpin_x__rod_theta = -arm_rod_head_y*p->inverse_rod_inertia;
    const double l_crankpin_y__rod_theta = arm_rod_head_x*p->inverse_rod_inertia;
    const double scale_pin_y = arm_rod_head_x*l_pin_y__rod_theta + p->inverse_rod_mass + p->inverse_table_mass;
    if (!(scale_pin_y > 0.0 && scale_pin_y < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    const double inverse_pivot_pin_y = 1.0/scale_pin_y;
    const double w_pin_x__pin_y = -arm_rod_head_x*l_pin_x__rod_theta;
    const double l_pin_x__pin_y = -inverse_pivot_pin_y*w_pin_x__pin_y;
    const double w_crankpin_x__pin_y = -arm_rod_head_x*l_crankpin_x__rod_theta;
    const double l_crankpin_x__pin_y = -inverse_pivot_pin_y*w_crankpin_x__pin_y;
    const double w_crankpin_y__pin_y = -arm_rod_head_x*l_crankpin_y__rod_theta + p->inverse_rod_mass;
    const double l_crankpin_y__pin_y = -inverse_pivot_pin_y*w_crankpin_y__pin_y;
    const double l_pivot_y__pin_y = -inverse_pivot_pin_y*p->inverse_table_mass;
    const double l_shaft_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_shaft_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double l_crankpin_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_crankpin_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double scale_shaft_x = -arm_crank_head_y*l_shaft_x__crank_theta + p->inverse_crank_mass;
    if (!(scale_shaft_x > 0.0 && scale_shaft_x < INFINITY)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_pivot_shaft_x = 1.0/scale_shaft_x;
    const double w_shaft_y__shaft_x = arm_crank_head_y*l_shaft_y__crank_theta;
    const double l_shaft_y__shaft_x = -inverse_pivot_shaft_x*w_shaft_y__shaft_x;
    const double w_motor__shaft_x = arm_crank_head_y*p->inverse_crank_inertia;
    const double l_motor__shaft_x = -inverse_pivot_shaft_x*w_motor__shaft_x;
    const double w_crankpin_x__shaft_x = arm_crank_head_y*l_crankpin_x__crank_theta + p->inverse_crank_mass;
    const double l_crankpin_x__shaft_x = -inverse_pivot_shaft_x*w_crankpin_x__shaft_x;
    const double w_crankpin_y__shaft_x = arm_crank_head_y*l_crankpin_y__crank_theta;
    const double l_crankpin_y__shaft_x = -inverse_pivot_shaft_x*w_crankpin_y__shaft_x;
    const double scale_pivot_x = -arm_arm_head_y*l_pivot_x__arm_theta - arm_table_top_y*l_pivot_x__table_theta
        + p->inverse_arm_mass + p->inverse_table_mass;
    const double pivot_pivot_x = p->inverse_table_mass*l_pivot_x__guide_offset
        - l_pivot_x__guide_angle*l_pivot_x__table_theta + scale_pivot_x;
    if (!(pivot_pivot_x > memory->least * scale_pivot_x)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_pivot_pivot_x = 1.0/pivot_pivot_x;
    const double w_pin_x__pivot_x = -p->inverse_table_mass*l_pin_x__guide_offset + p->inverse_table_mass;
    const double l_pin_x__pivot_x = -inverse_pivot_pivot_x*w_pin_x__pivot_x;
    const double w_pivot_y__pivot_x = arm_arm_head_y*l_pivot_y__arm_theta + arm_table_top_y*l_pivot_y__table_theta
        + l_pivot_x__table_theta*l_pivot_y__guide_angle;
    const double l_pivot_y__pivot_x = -inverse_pivot_pivot_x*w_pivot_y__pivot_x;
    const double scale_shaft_y = arm_crank_head_x*l_shaft_y__crank_theta + p->inverse_crank_mass;
    const double scale_motor = p->inverse_crank_inertia;
    const double pivot_shaft_y = l_shaft_y__shaft_x*w_shaft_y__shaft_x + scale_shaft_y;
    const double pivot_motor = l_motor__shaft_x*w_motor__shaft_x + scale_motor;
    const double pivot_shaft_y__motor = arm_crank_head_x*p->inverse_crank_inertia + l_motor__shaft_x*w_shaft_y__shaft_x;
    const double determinant_shaft_y__motor = pivot_motor*pivot_shaft_y - (pivot_shaft_y__motor * pivot_shaft_y__motor);
    if (!(pivot_shaft_y > memory->least * scale_shaft_y)) {
        pivot = 6;
        goto dependent;
    }
    if (!(determinant_shaft_y__motor > memory->least * scale_motor * pivot_shaft_y)) {
        pivot = 7;
        goto dependent;
    }
    const double inverse_shaft_y__motor = -1.0/determinant_shaft_y__motor;
    const double inverse_pivot_shaft_y = inverse_shaft_y__motor*pivot_motor;
    const double inverse_pivot_motor = inverse_shaft_y__motor*pivot_shaft_y;
    const double inverse_cross_shaft_y__motor = -inverse_shaft_y__motor*pivot_shaft_y__motor;
    const double w_crankpin_x__shaft_y = -arm_crank_head_x*l_crankpin_x__crank_theta
        - l_crankpin_x__shaft_x*w_shaft_y__shaft_x;
    const double w_crankpin_x__motor = -l_crankpin_x__crank_theta - l_crankpin_x__shaft_x*w_motor__shaft_x;
    const double l_crankpin_x__shaft_y = inverse_cross_shaft_y__motor*w_crankpin_x__motor
        + inverse_pivot_shaft_y*w_crankpin_x__shaft_y;
    const double l_crankpin_x__motor = inverse_cross_shaft_y__motor*w_crankpin_x__shaft_y
        + inverse_pivot_motor*w_crankpin_x__motor;
    const double w_crankpin_y__shaft_y = -arm_crank_head_x*l_crankpin_y__crank_theta + p->inverse_crank_mass
        - l_crankpin_y__shaft_x*w_shaft_y__shaft_x;
    const double w_crankpin_y__motor = -l_crankpin_y__crank_theta - l_crankpin_y__shaft_x*w_motor__shaft_x;
    const double l_crankpin_y__shaft_y = inverse_cross_shaft_y__motor*w_crankpin_y__motor
        + inverse_pivot_shaft_y*w_crankpin_y__shaft_y;
    const double l_crankpin_y__motor = inverse_cross_shaft_y__motor*w_crankpin_y__shaft_y
        + inverse_pivot_motor*w_crankpin_y__motor;
    const double scale_pin_x = -arm_rod_head_y*l_pin_x__rod_theta + p->inverse_rod_mass + p->inverse_table_mass;
    const double scale_crankpin_x = -arm_crank_head_y*l_crankpin_x__crank_theta
        - arm_rod_head_y*l_crankpin_x__rod_theta + p->inverse_crank_mass + p->inverse_rod_mass;
    const double pivot_pin_x = -p->inverse_table_mass*l_pin_x__guide_offset + l_pin_x__pin_y*w_pin_x__pin_y
        + l_pin_x__pivot_x*w_pin_x__pivot_x + scale_pin_x;
    const double pivot_crankpin_x = l_crankpin_x__motor*w_crankpin_x__motor + l_crankpin_x__pin_y*w_crankpin_x__pin_y
        + l_crankpin_x__shaft_x*w_crankpin_x__shaft_x + l_crankpin_x__shaft_y*w_crankpin_x__shaft_y + scale_crankpin_x;
    const double pivot_pin_x__crankpin_x = -arm_rod_head_y*l_crankpin_x__rod_theta - p->inverse_rod_mass
        + l_crankpin_x__pin_y*w_pin_x__pin_y;
    const double determinant_pin_x__crankpin_x = pivot_crankpin_x*pivot_pin_x
        - (pivot_pin_x__crankpin_x * pivot_pin_x__crankpin_x);
    if (!(pivot_pin_x > memory->least * scale_pin_x)) {
        pivot = 8;
        goto dependent;
    }
    if (!(determinant_pin_x__crankpin_x > memory->least * scale_crankpin_x * pivot_pin_x)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pin_x__crankpin_x = -1.0/determinant_pin_x__crankpin_x;
    const double inverse_pivot_pin_x = inverse_pin_x__crankpin_x*pivot_crankpin_x;
    const double inverse_pivot_crankpin_x = inverse_pin_x__crankpin_x*pivot_pin_x;
    const double inverse_cross_pin_x__crankpin_x = -inverse_pin_x__crankpin_x*pivot_pin_x__crankpin_x;
    const double w_crankpin_y__pin_x = arm_rod_head_y*l_crankpin_y__rod_theta - l_crankpin_y__pin_y*w_pin_x__pin_y;
    const double w_crankpin_y__crankpin_x = arm_crank_head_y*l_crankpin_y__crank_theta
        + arm_rod_head_y*l_crankpin_y__rod_theta - l_crankpin_y__motor*w_crankpin_x__motor
        - l_crankpin_y__pin_y*w_crankpin_x__pin_y - l_crankpin_y__shaft_x*w_crankpin_x__shaft_x
        - l_crankpin_y__shaft_y*w_crankpin_x__shaft_y;
    const double l_crankpin_y__pin_x = inverse_cross_pin_x__crankpin_x*w_crankpin_y__crankpin_x
        + inverse_pivot_pin_x*w_crankpin_y__pin_x;
    const double l_crankpin_y__crankpin_x = inverse_cross_pin_x__crankpin_x*w_crankpin_y__pin_x
        + inverse_pivot_crankpin_x*w_crankpin_y__crankpin_x;
    const double w_pivot_y__pin_x = -l_pivot_y__pin_y*w_pin_x__pin_y - l_pivot_y__pivot_x*w_pin_x__pivot_x;
    const double w_pivot_y__crankpin_x = -l_pivot_y__pin_y*w_crankpin_x__pin_y;
    const double l_pivot_y__pin_x = inverse_cross_pin_x__crankpin_x*w_pivot_y__crankpin_x
        + inverse_pivot_pin_x*w_pivot_y__pin_x;
    const double l_pivot_y__crankpin_x = inverse_cross_pin_x__crankpin_x*w_pivot_y__pin_x
        + inverse_pivot_crankpin_x*w_pivot_y__crankpin_x;
    const double scale_crankpin_y = arm_crank_head_x*l_crankpin_y__crank_theta + arm_rod_head_x*l_crankpin_y__rod_theta
        + p->inverse_crank_mass + p->inverse_rod_mass;
    const double scale_pivot_y = arm_arm_head_x*l_pivot_y__arm_theta + arm_table_top_x*l_pivot_y__table_theta
        + p->inverse_arm_mass + p->inverse_table_mass;
    const double pivot_crankpin_y = l_crankpin_y__crankpin_x*w_crankpin_y__crankpin_x
        + l_crankpin_y__motor*w_crankpin_y__motor + l_crankpin_y__pin_x*w_crankpin_y__pin_x
        + l_crankpin_y__pin_y*w_crankpin_y__pin_y + l_crankpin_y__shaft_x*w_crankpin_y__shaft_x
        + l_crankpin_y__shaft_y*w_crankpin_y__shaft_y + scale_crankpin_y;
    const double pivot_pivot_y = p->inverse_table_mass*l_pivot_y__pin_y + l_pivot_y__crankpin_x*w_pivot_y__crankpin_x
        - l_pivot_y__guide_angle*l_pivot_y__table_theta + l_pivot_y__pin_x*w_pivot_y__pin_x
        + l_pivot_y__pivot_x*w_pivot_y__pivot_x + scale_pivot_y;
    const double pivot_crankpin_y__pivot_y = l_pivot_y__crankpin_x*w_crankpin_y__crankpin_x
        + l_pivot_y__pin_x*w_crankpin_y__pin_x + l_pivot_y__pin_y*w_crankpin_y__pin_y;
    const double determinant_crankpin_y__pivot_y = pivot_crankpin_y*pivot_pivot_y
        - (pivot_crankpin_y__pivot_y * pivot_crankpin_y__pivot_y);
    if (!(pivot_crankpin_y > memory->least * scale_crankpin_y)) {
        pivot = 10;
        goto dependent;
    }
    if (!(determinant_crankpin_y__pivot_y > memory->least * scale_pivot_y * pivot_crankpin_y)) {
        pivot = 11;
        goto dependent;
    }
    const double inverse_crankpin_y__pivot_y = -1.0/determinant_crankpin_y__pivot_y;
    const double inverse_pivot_crankpin_y = inverse_crankpin_y__pivot_y*pivot_pivot_y;
    const double inverse_pivot_pivot_y = inverse_crankpin_y__pivot_y*pivot_crankpin_y;
    const double inverse_cross_crankpin_y__pivot_y = -inverse_crankpin_y__pivot_y*pivot_crankpin_y__pivot_y;

    /* forward substitution */
    const double z_pin_y = -p->inverse_rod_mass*p->weight_rod_y + p->inverse_table_mass*p->weight_table_y + rhs_pin_y;
    const double z_pivot_x = -l_pivot_x__guide_angle*rhs_guide_angle - l_pivot_x__guide_offset*rhs_guide_offset
        + rhs_pivot_x;
    const double z_shaft_y = p->inverse_crank_mass*p->weight_crank_y - l_shaft_y__shaft_x*rhs_shaft_x + rhs_shaft_y;
    const double z_motor = -l_motor__shaft_x*rhs_shaft_x + rhs_motor;
    const double z_pin_x = -l_pin_x__guide_offset*rhs_guide_offset - l_pin_x__pin_y*z_pin_y
        - l_pin_x__pivot_x*z_pivot_x + rhs_pin_x;
    const double z_crankpin_x = -l_crankpin_x__motor*z_motor - l_crankpin_x__pin_y*z_pin_y
        - l_crankpin_x__shaft_x*rhs_shaft_x - l_crankpin_x__shaft_y*z_shaft_y + rhs_crankpin_x;
    const double z_crankpin_y = -p->inverse_crank_mass*p->weight_crank_y + p->inverse_rod_mass*p->weight_rod_y
        - l_crankpin_y__crankpin_x*z_crankpin_x - l_crankpin_y__motor*z_motor - l_crankpin_y__pin_x*z_pin_x
        - l_crankpin_y__pin_y*z_pin_y - l_crankpin_y__shaft_x*rhs_shaft_x - l_crankpin_y__shaft_y*z_shaft_y
        + rhs_crankpin_y;
    const double z_pivot_y = p->inverse_arm_mass*p->weight_arm_y - p->inverse_table_mass*p->weight_table_y
        - l_pivot_y__crankpin_x*z_crankpin_x - l_pivot_y__guide_angle*rhs_guide_angle - l_pivot_y__pin_x*z_pin_x
        - l_pivot_y__pin_y*z_pin_y - l_pivot_y__pivot_x*z_pivot_x + rhs_pivot_y;

    /* backward substitution */
    const double lambda_pivot_y = inverse_cross_crankpin_y__pivot_y*z_crankpin_y + inverse_pivot_pivot_y*z_pivot_y;
    const double lambda_crankpin_y = inverse_cross_crankpin_y__pivot_y*z_pivot_y
        + inverse_pivot_crankpin_y*z_crankpin_y;
    const double lambda_crankpin_x = inverse_cross_pin_x__crankpin_x*z_pin_x + inverse_pivot_crankpin_x*z_crankpin_x
        - l_crankpin_y__crankpin_x*lambda_crankpin_y - l_pivot_y__crankpin_x*lambda_pivot_y;
    const double lambda_pin_x = inverse_cross_pin_x__crankpin_x*z_crankpin_x + inverse_pivot_pin_x*z_pin_x
        - l_crankpin_y__pin_x*lambda_crankpin_y - l_pivot_y__pin_x*lambda_pivot_y;
    const double lambda_motor = inverse_cross_shaft_y__motor*z_shaft_y + inverse_pivot_motor*z_motor
        - l_crankpin_x__motor*lambda_crankpin_x - l_crankpin_y__motor*lambda_crankpin_y;
    const double lambda_shaft_y = inverse_cross_shaft_y__motor*z_motor + inverse_pivot_shaft_y*z_shaft_y
        - l_crankpin_x__shaft_y*lambda_crankpin_x - l_crankpin_y__shaft_y*lambda_crankpin_y;
    const double lambda_pivot_x = -inverse_pivot_pivot_x*z_pivot_x - l_pin_x__pivot_x*lambda_pin_x
        - l_pivot_y__pivot_x*lambda_pivot_y;
    const double lambda_shaft_x = -inverse_pivot_shaft_x*rhs_shaft_x - l_crankpin_x__shaft_x*lambda_crankpin_x
        - l_crankpin_y__shaft_x*lambda_crankpin_y - l_motor__shaft_x*lambda_motor - l_shaft_y__shaft_x*lambda_shaft_y;
    const double acceleration_crank_theta = -p->inverse_crank_inertia*lambda_motor
        - l_crankpin_x__crank_theta*lambda_crankpin_x - l_crankpin_y__crank_theta*lambda_crankpin_y
        - l_shaft_x__crank_theta*lambda_shaft_x - l_shaft_y__crank_theta*lambda_shaft_y;
    const double lambda_pin_y = -inverse_pivot_pin_y*z_pin_y - l_crankpin_x__pin_y*lambda_crankpin_x
        - l_crankpin_y__pin_y*lambda_crankpin_y - l_pin_x__pin_y*lambda_pin_x - l_pivot_y__pin_y*lambda_pivot_y;
    const double acceleration_rod_theta = -l_crankpin_x__rod_theta*lambda_crankpin_x
        - l_crankpin_y__rod_theta*lambda_crankpin_y - l_pin_x__rod_theta*lambda_pin_x - l_pin_y__rod_theta*lambda_pin_y;
    const double lambda_guide_offset = -inverse_pivot_guide_offset*rhs_guide_offset
        - l_pin_x__guide_offset*lambda_pin_x - l_pivot_x__guide_offset*lambda_pivot_x;
    const double acceleration_table_x = p->inverse_table_mass*lambda_guide_offset + p->inverse_table_mass*lambda_pin_x
        - p->inverse_table_mass*lambda_pivot_x;
    const double lambda_guide_angle = -inverse_pivot_guide_angle*rhs_guide_angle
        - l_pivot_x__guide_angle*lambda_pivot_x - l_pivot_y__guide_angle*lambda_pivot_y;
    const double acceleration_table_theta = -p->inverse_table_inertia*lambda_guide_angle
        - l_pivot_x__table_theta*lambda_pivot_x - l_pivot_y__table_theta*lambda_pivot_y;
    const double acceleration_arm_theta = -l_pivot_x__arm_theta*lambda_pivot_x - l_pivot_y__arm_theta*lambda_pivot_y;
    const double acceleration_table_y = p->inverse_table_mass*lambda_pin_y - p->inverse_table_mass*lambda_pivot_y
        + p->inverse_table_mass*p->weight_table_y;
    const double acceleration_rod_y = p->inverse_rod_mass*lambda_crankpin_y - p->inverse_rod_mass*lambda_pin_y
        + p->inverse_rod_mass*p->weight_rod_y;
    const double acceleration_rod_x = p->inverse_rod_mass*lambda_crankpin_x - p->inverse_rod_mass*lambda_pin_x;
    const double acceleration_crank_y = -p->inverse_crank_mass*lambda_crankpin_y + p->inverse_crank_mass*lambda_shaft_y
        + p->inverse_crank_mass*p->weight_crank_y;
    const double acceleration_crank_x = -p->inverse_crank_mass*lambda_crankpin_x + p->inverse_crank_mass*lambda_shaft_x;
    const double acceleration_arm_y = p->inverse_arm_mass*lambda_pivot_y + p->inverse_arm_mass*p->weight_arm_y;
    const double acceleration_arm_x = p->inverse_arm_mass*lambda_pivot_x;

    /* results */
    a[0] = acceleration_crank_x;
    a[1] = acceleration_crank_y;
    a[2] = acceleration_crank_theta;
    a[3] = acceleration_rod_x;
    a[4] = acceleration_rod_y;
    a[5] = acceleration_rod_theta;
    a[6] = acceleration_table_x;
    a[7] = acceleration_table_y;
    a[8] = acceleration_table_theta;
    a[9] = acceleration_arm_x;
    a[10] = acceleration_arm_y;
    a[11] = acceleration_arm_theta;
    aside->lambda[0] = lambda_shaft_x;
    aside->lambda[1] = lambda_shaft_y;
    aside->lambda[2] = lambda_crankpin_x;
    aside->lambda[3] = lambda_crankpin_y;
    aside->lambda[4] = lambda_pin_x;
    aside->lambda[5] = lambda_pin_y;
    aside->lambda[6] = lambda_guide_offset;
    aside->lambda[7] = lambda_guide_angle;
    aside->lambda[8] = lambda_pivot_x;
    aside->lambda[9] = lambda_pivot_y;
    aside->lambda[10] = lambda_motor;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_crank_y;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_rod_y;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_table_y;
        force[8] = 0.0;
        force[9] = 0.0;
        force[10] = p->weight_arm_y;
        force[11] = 0.0;
        rhs[0] = rhs_shaft_x;
        rhs[1] = rhs_shaft_y;
        rhs[2] = rhs_crankpin_x;
        rhs[3] = rhs_crankpin_y;
        rhs[4] = rhs_pin_x;
        rhs[5] = rhs_pin_y;
        rhs[6] = rhs_guide_offset;
        rhs[7] = rhs_guide_angle;
        rhs[8] = rhs_pivot_x;
        rhs[9] = rhs_pivot_y;
        rhs[10] = rhs_motor;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = -aside->lambda[10]*motor_rate;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
