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
    const double coupler_x = q[3];
    const double coupler_y = q[4];
    const double coupler_theta = q[5];
    const double coupler_vx = v[3];
    const double coupler_vy = v[4];
    const double coupler_omega = v[5];
    const double rocker_x = q[6];
    const double rocker_y = q[7];
    const double rocker_theta = q[8];
    const double rocker_vx = v[6];
    const double rocker_vy = v[7];
    const double rocker_omega = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_coupler = cos(coupler_theta);
    const double sin_theta_coupler = sin(coupler_theta);
    const double arm_coupler_head_x = cos_theta_coupler*p->coupler_head_s_x;
    const double arm_coupler_head_y = p->coupler_head_s_x*sin_theta_coupler;
    const double cos_theta_rocker = cos(rocker_theta);
    const double sin_theta_rocker = sin(rocker_theta);
    const double arm_rocker_head_x = cos_theta_rocker*p->rocker_head_s_x;
    const double arm_rocker_head_y = p->rocker_head_s_x*sin_theta_rocker;
    const double motor_value = p->omega*t + PI/2.0;
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_A0_x = arm_crank_head_x - crank_x;
    const double phi_dot_A0_x = -arm_crank_head_y*crank_omega - crank_vx;
    const double rhs_A0_x = arm_crank_head_x*(crank_omega * crank_omega) - p->beta_squared*phi_A0_x
        - phi_dot_A0_x*p->two_alpha;
    aside->phi[0] = phi_A0_x;
    aside->phi_dot[0] = phi_dot_A0_x;
    const double phi_A0_y = arm_crank_head_y - crank_y;
    const double phi_dot_A0_y = arm_crank_head_x*crank_omega - crank_vy;
    const double rhs_A0_y = arm_crank_head_y*(crank_omega * crank_omega) - p->beta_squared*phi_A0_y
        - phi_dot_A0_y*p->two_alpha;
    aside->phi[1] = phi_A0_y;
    aside->phi_dot[1] = phi_dot_A0_y;
    const double phi_A_x = arm_coupler_head_x + arm_crank_head_x - coupler_x + crank_x;
    const double phi_dot_A_x = -arm_coupler_head_y*coupler_omega - arm_crank_head_y*crank_omega - coupler_vx + crank_vx;
    const double rhs_A_x = arm_coupler_head_x*(coupler_omega * coupler_omega)
        + arm_crank_head_x*(crank_omega * crank_omega) - p->beta_squared*phi_A_x - phi_dot_A_x*p->two_alpha;
    aside->phi[2] = phi_A_x;
    aside->phi_dot[2] = phi_dot_A_x;
    const double phi_A_y = arm_coupler_head_y + arm_crank_head_y - coupler_y + crank_y;
    const double phi_dot_A_y = arm_coupler_head_x*coupler_omega + arm_crank_head_x*crank_omega - coupler_vy + crank_vy;
    const double rhs_A_y = arm_coupler_head_y*(coupler_omega * coupler_omega)
        + arm_crank_head_y*(crank_omega * crank_omega) - p->beta_squared*phi_A_y - phi_dot_A_y*p->two_alpha;
    aside->phi[3] = phi_A_y;
    aside->phi_dot[3] = phi_dot_A_y;
    const double phi_B_x = arm_coupler_head_x - arm_rocker_head_x + coupler_x - rocker_x;
    const double phi_dot_B_x = -arm_coupler_head_y*coupler_omega + arm_rocker_head_y*rocker_omega + coupler_vx
        - rocker_vx;
    const double rhs_B_x = arm_coupler_head_x*(coupler_omega * coupler_omega)
        - arm_rocker_head_x*(rocker_omega * rocker_omega) - p->beta_squared*phi_B_x - phi_dot_B_x*p->two_alpha;
    aside->phi[4] = phi_B_x;
    aside->phi_dot[4] = phi_dot_B_x;
    const double phi_B_y = arm_coupler_head_y - arm_rocker_head_y + coupler_y - rocker_y;
    const double phi_dot_B_y = arm_coupler_head_x*coupler_omega - arm_rocker_head_x*rocker_omega + coupler_vy
        - rocker_vy;
    const double rhs_B_y = arm_coupler_head_y*(coupler_omega * coupler_omega)
        - arm_rocker_head_y*(rocker_omega * rocker_omega) - p->beta_squared*phi_B_y - phi_dot_B_y*p->two_alpha;
    aside->phi[5] = phi_B_y;
    aside->phi_dot[5] = phi_dot_B_y;
    const double phi_B0_x = p->B0_x + arm_rocker_head_x - rocker_x;
    const double phi_dot_B0_x = -arm_rocker_head_y*rocker_omega - rocker_vx;
    const double rhs_B0_x = arm_rocker_head_x*(rocker_omega * rocker_omega) - p->beta_squared*phi_B0_x
        - phi_dot_B0_x*p->two_alpha;
    aside->phi[6] = phi_B0_x;
    aside->phi_dot[6] = phi_dot_B0_x;
    const double phi_B0_y = arm_rocker_head_y - rocker_y;
    const double phi_dot_B0_y = arm_rocker_head_x*rocker_omega - rocker_vy;
    const double rhs_B0_y = arm_rocker_head_y*(rocker_omega * rocker_omega) - p->beta_squared*phi_B0_y
        - phi_dot_B0_y*p->two_alpha;
    aside->phi[7] = phi_B0_y;
    aside->phi_dot[7] = phi_dot_B0_y;
    const double phi_motor = crank_theta - motor_value;
    const double phi_dot_motor = crank_omega - motor_rate;
    const double rhs_motor = -p->beta_squared*phi_motor + motor_acceleration - phi_dot_motor*p->two_alpha;
    aside->phi[8] = phi_motor;
    aside->phi_dot[8] = phi_dot_motor;

    /* L D L^T of the KKT matrix */
    const double l_B_x__coupler_theta = -arm_coupler_head_y*p->inverse_coupler_inertia;
    const double l_B_y__coupler_theta = arm_coupler_head_x*p->inverse_coupler_inertia;
    const double l_A_x__coupler_theta = -arm_coupler_head_y*p->inverse_coupler_inertia;
    const double l_A_y__coupler_theta = arm_coupler_head_x*p->inverse_coupler_inertia;
    const double l_B0_x__rocker_theta = -arm_rocker_head_y*p->inverse_rocker_inertia;
    const double l_B0_y__rocker_theta = arm_rocker_head_x*p->inverse_rocker_inertia;
    const double l_B_x__rocker_theta = arm_rocker_head_y*p->inverse_rocker_inertia;
    const double l_B_y__rocker_theta = -arm_rocker_head_x*p->inverse_rocker_inertia;
    const double scale_B0_x = -arm_rocker_head_y*l_B0_x__rocker_theta + p->inverse_rocker_mass;
    const double scale_B0_y = arm_rocker_head_x*l_B0_y__rocker_theta + p->inverse_rocker_mass;
    const double pivot_B0_x__B0_y = -arm_rocker_head_y*l_B0_y__rocker_theta;
    const double determinant_B0_x__B0_y = -(pivot_B0_x__B0_y * pivot_B0_x__B0_y) + scale_B0_x*scale_B0_y;
    if (!(scale_B0_x > 0.0 && scale_B0_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B0_x__B0_y > memory->least * scale_B0_y * scale_B0_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_B0_x__B0_y = -1.0/determinant_B0_x__B0_y;
    const double inverse_pivot_B0_x = inverse_B0_x__B0_y*scale_B0_y;
    const double inverse_pivot_B0_y = inverse_B0_x__B0_y*scale_B0_x;
    const double inverse_cross_B0_x__B0_y = -inverse_B0_x__B0_y*pivot_B0_x__B0_y;
    const double w_B_x__B0_x = arm_rocker_head_y*l_B_x__rocker_theta - p->inverse_rocker_mass;
    const double w_B_x__B0_y = -arm_rocker_head_x*l_B_x__rocker_theta;
    const double l_B_x__B0_x = inverse_cross_B0_x__B0_y*w_B_x__B0_y + inverse_pivot_B0_x*w_B_x__B0_x;
    const double l_B_x__B0_y = inverse_cross_B0_x__B0_y*w_B_x__B0_x + inverse_pivot_B0_y*w_B_x__B0_y;
    const double w_B_y__B0_x = arm_rocker_head_y*l_B_y__rocker_theta;
    const double w_B_y__B0_y = -arm_rocker_head_x*l_B_y__rocker_theta - p->inverse_rocker_mass;
    const double l_B_y__B0_x = inverse_cross_B0_x__B0_y*w_B_y__B0_y + inverse_pivot_B0_x*w_B_y__B0_x;
    const double l_B_y__B0_y = inverse_cross_B0_x__B0_y*w_B_y__B0_x + inverse_pivot_B0_y*w_B_y__B0_y;
    const double scale_B_x = -arm_coupler_head_y*l_B_x__coupler_theta + arm_rocker_head_y*l_B_x__rocker_theta
        + p->inverse_coupler_mass + p->inverse_rocker_mass;
    const double scale_B_y = arm_coupler_head_x*l_B_y__coupler_theta - arm_rocker_head_x*l_B_y__rocker_theta
        + p->inverse_coupler_mass + p->inverse_rocker_mass;
    const double pivot_B_x = l_B_x__B0_x*w_B_x__B0_x + l_B_x__B0_y*w_B_x__B0_y + scale_B_x;
    const double pivot_B_y = l_B_y__B0_x*w_B_y__B0_x + l_B_y__B0_y*w_B_y__B0_y + scale_B_y;
    const double pivot_B_x__B_y = -arm_coupler_head_y*l_B_y__coupler_theta + arm_rocker_head_y*l_B_y__rocker_theta
        + l_B_y__B0_x*w_B_x__B0_x + l_B_y__B0_y*w_B_x__B0_y;
    const double determinant_B_x__B_y = pivot_B_x*pivot_B_y - (pivot_B_x__B_y * pivot_B_x__B_y);
    if (!(pivot_B_x > memory->least * scale_B_x)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B_x__B_y > memory->least * scale_B_y * pivot_B_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_B_x__B_y = -1.0/determinant_B_x__B_y;
    const double inverse_pivot_B_x = inverse_B_x__B_y*pivot_B_y;
    const double inverse_pivot_B_y = inverse_B_x__B_y*pivot_B_x;
    const double inverse_cross_B_x__B_y = -inverse_B_x__B_y*pivot_B_x__B_y;
    const double w_A_x__B_x = arm_coupler_head_y*l_A_x__coupler_theta + p->inverse_coupler_mass;
    const double w_A_x__B_y = -arm_coupler_head_x*l_A_x__coupler_theta;
    const double l_A_x__B_x = inverse_cross_B_x__B_y*w_A_x__B_y + inverse_pivot_B_x*w_A_x__B_x;
    const double l_A_x__B_y = inverse_cross_B_x__B_y*w_A_x__B_x + inverse_pivot_B_y*w_A_x__B_y;
    const double w_A_y__B_x = arm_coupler_head_y*l_A_y__coupler_theta;
    const double w_A_y__B_y = -arm_coupler_head_x*l_A_y__coupler_theta + p->inverse_coupler_mass;
    const double l_A_y__B_x = inverse_cross_B_x__B_y*w_A_y__B_y + inverse_pivot_B_x*w_A_y__B_x;
    const double l_A_y__B_y = inverse_cross_B_x__B_y*w_A_y__B_x + inverse_pivot_B_y*w_A_y__B_y;
    const double l_A0_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_A0_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double l_A_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_A_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double scale_A0_x = -arm_crank_head_y*l_A0_x__crank_theta + p->inverse_crank_mass;
    const double scale_A0_y = arm_crank_head_x*l_A0_y__crank_theta + p->inverse_crank_mass;
    const double pivot_A0_x__A0_y = -arm_crank_head_y*l_A0_y__crank_theta;
    const double determinant_A0_x__A0_y = -(pivot_A0_x__A0_y * pivot_A0_x__A0_y) + scale_A0_x*scale_A0_y;
    if (!(scale_A0_x > 0.0 && scale_A0_x < INFINITY)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_A0_x__A0_y > memory->least * scale_A0_y * scale_A0_x)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_A0_x__A0_y = -1.0/determinant_A0_x__A0_y;
    const double inverse_pivot_A0_x = inverse_A0_x__A0_y*scale_A0_y;
    const double inverse_pivot_A0_y = inverse_A0_x__A0_y*scale_A0_x;
    const double inverse_cross_A0_x__A0_y = -inverse_A0_x__A0_y*pivot_A0_x__A0_y;
    const double w_motor__A0_x = arm_crank_head_y*p->inverse_crank_inertia;
    const double w_motor__A0_y = -arm_crank_head_x*p->inverse_crank_inertia;
    const double l_motor__A0_x = inverse_cross_A0_x__A0_y*w_motor__A0_y + inverse_pivot_A0_x*w_motor__A0_x;
    const double l_motor__A0_y = inverse_cross_A0_x__A0_y*w_motor__A0_x + inverse_pivot_A0_y*w_motor__A0_y;
    const double w_A_x__A0_x = arm_crank_head_y*l_A_x__crank_theta + p->inverse_crank_mass;
    const double w_A_x__A0_y = -arm_crank_head_x*l_A_x__crank_theta;
    const double l_A_x__A0_x = inverse_cross_A0_x__A0_y*w_A_x__A0_y + inverse_pivot_A0_x*w_A_x__A0_x;
    const double l_A_x__A0_y = inverse_cross_A0_x__A0_y*w_A_x__A0_x + inverse_pivot_A0_y*w_A_x__A0_y;
    const double w_A_y__A0_x = arm_crank_head_y*l_A_y__crank_theta;
    const double w_A_y__A0_y = -arm_crank_head_x*l_A_y__crank_theta + p->inverse_crank_mass;
    const double l_A_y__A0_x = inverse_cross_A0_x__A0_y*w_A_y__A0_y + inverse_pivot_A0_x*w_A_y__A0_x;
    const double l_A_y__A0_y = inverse_cross_A0_x__A0_y*w_A_y__A0_x + inverse_pivot_A0_y*w_A_y__A0_y;
    const double scale_motor = p->inverse_crank_inertia;
    const double scale_A_x = -arm_coupler_head_y*l_A_x__coupler_theta - arm_crank_head_y*l_A_x__crank_theta
        + p->inverse_coupler_mass + p->inverse_crank_mass;
    const double pivot_motor = l_motor__A0_x*w_motor__A0_x + l_motor__A0_y*w_motor__A0_y + scale_motor;
    const double pivot_A_x = l_A_x__A0_x*w_A_x__A0_x + l_A_x__A0_y*w_A_x__A0_y + l_A_x__B_x*w_A_x__B_x
        + l_A_x__B_y*w_A_x__B_y + scale_A_x;
    const double pivot_motor__A_x = l_A_x__A0_x*w_motor__A0_x + l_A_x__A0_y*w_motor__A0_y + l_A_x__crank_theta;
    const double determinant_motor__A_x = pivot_A_x*pivot_motor - (pivot_motor__A_x * pivot_motor__A_x);
    if (!(pivot_motor > memory->least * scale_motor)) {
        pivot = 7;
        goto dependent;
    }
    if (!(determinant_motor__A_x > memory->least * scale_A_x * pivot_motor)) {
        pivot = 8;
        goto dependent;
    }
    const double inverse_motor__A_x = -1.0/determinant_motor__A_x;
    const double inverse_pivot_motor = inverse_motor__A_x*pivot_A_x;
    const double inverse_pivot_A_x = inverse_motor__A_x*pivot_motor;
    const double inverse_cross_motor__A_x = -inverse_motor__A_x*pivot_motor__A_x;
    const double w_A_y__motor = -l_A_y__A0_x*w_motor__A0_x - l_A_y__A0_y*w_motor__A0_y - l_A_y__crank_theta;
    const double w_A_y__A_x = arm_coupler_head_y*l_A_y__coupler_theta + arm_crank_head_y*l_A_y__crank_theta
        - l_A_y__A0_x*w_A_x__A0_x - l_A_y__A0_y*w_A_x__A0_y - l_A_y__B_x*w_A_x__B_x - l_A_y__B_y*w_A_x__B_y;
    const double l_A_y__motor = inverse_cross_motor__A_x*w_A_y__A_x + inverse_pivot_motor*w_A_y__motor;
    const double l_A_y__A_x = inverse_cross_motor__A_x*w_A_y__motor + inverse_pivot_A_x*w_A_y__A_x;
    const double scale_A_y = arm_coupler_head_x*l_A_y__coupler_theta + arm_crank_head_x*l_A_y__crank_theta
        + p->inverse_coupler_mass + p->inverse_crank_mass;
    const double pivot_A_y = l_A_y__A0_x*w_A_y__A0_x + l_A_y__A0_y*w_A_y__A0_y + l_A_y__A_x*w_A_y__A_x
        + l_A_y__B_x*w_A_y__B_x + l_A_y__B_y*w_A_y__B_y + l_A_y__motor*w_A_y__motor + scale_A_y;
    if (!(pivot_A_y > memory->least * scale_A_y)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pivot_A_y = 1.0/pivot_A_y;

    /* forward substitution */
    const double z_B0_y = p->inverse_rocker_mass*p->weight_rocker_y + rhs_B0_y;
    const double z_B_x = -l_B_x__B0_x*rhs_B0_x - l_B_x__B0_y*z_B0_y + rhs_B_x;
    const double z_B_y = -p->inverse_coupler_mass*p->weight_coupler_y + p->inverse_rocker_mass*p->weight_rocker_y
        - l_B_y__B0_x*rhs_B0_x - l_B_y__B0_y*z_B0_y + rhs_B_y;
    const double z_A0_y = p->inverse_crank_mass*p->weight_crank_y + rhs_A0_y;
    const double z_motor = -l_motor__A0_x*rhs_A0_x - l_motor__A0_y*z_A0_y + rhs_motor;
    const double z_A_x = -l_A_x__A0_x*rhs_A0_x - l_A_x__A0_y*z_A0_y - l_A_x__B_x*z_B_x - l_A_x__B_y*z_B_y + rhs_A_x;
    const double z_A_y = p->inverse_coupler_mass*p->weight_coupler_y - p->inverse_crank_mass*p->weight_crank_y
        - l_A_y__A0_x*rhs_A0_x - l_A_y__A0_y*z_A0_y - l_A_y__A_x*z_A_x - l_A_y__B_x*z_B_x - l_A_y__B_y*z_B_y
        - l_A_y__motor*z_motor + rhs_A_y;

    /* backward substitution */
    const double lambda_A_y = -inverse_pivot_A_y*z_A_y;
    const double lambda_A_x = inverse_cross_motor__A_x*z_motor + inverse_pivot_A_x*z_A_x - l_A_y__A_x*lambda_A_y;
    const double lambda_motor = inverse_cross_motor__A_x*z_A_x + inverse_pivot_motor*z_motor - l_A_y__motor*lambda_A_y;
    const double lambda_A0_y = inverse_cross_A0_x__A0_y*rhs_A0_x + inverse_pivot_A0_y*z_A0_y - l_A_x__A0_y*lambda_A_x
        - l_A_y__A0_y*lambda_A_y - l_motor__A0_y*lambda_motor;
    const double lambda_A0_x = inverse_cross_A0_x__A0_y*z_A0_y + inverse_pivot_A0_x*rhs_A0_x - l_A_x__A0_x*lambda_A_x
        - l_A_y__A0_x*lambda_A_y - l_motor__A0_x*lambda_motor;
    const double acceleration_crank_theta = -p->inverse_crank_inertia*lambda_motor - l_A0_x__crank_theta*lambda_A0_x
        - l_A0_y__crank_theta*lambda_A0_y - l_A_x__crank_theta*lambda_A_x - l_A_y__crank_theta*lambda_A_y;
    const double lambda_B_y = inverse_cross_B_x__B_y*z_B_x + inverse_pivot_B_y*z_B_y - l_A_x__B_y*lambda_A_x
        - l_A_y__B_y*lambda_A_y;
    const double lambda_B_x = inverse_cross_B_x__B_y*z_B_y + inverse_pivot_B_x*z_B_x - l_A_x__B_x*lambda_A_x
        - l_A_y__B_x*lambda_A_y;
    const double lambda_B0_y = inverse_cross_B0_x__B0_y*rhs_B0_x + inverse_pivot_B0_y*z_B0_y - l_B_x__B0_y*lambda_B_x
        - l_B_y__B0_y*lambda_B_y;
    const double lambda_B0_x = inverse_cross_B0_x__B0_y*z_B0_y + inverse_pivot_B0_x*rhs_B0_x - l_B_x__B0_x*lambda_B_x
        - l_B_y__B0_x*lambda_B_y;
    const double acceleration_rocker_theta = -l_B0_x__rocker_theta*lambda_B0_x - l_B0_y__rocker_theta*lambda_B0_y
        - l_B_x__rocker_theta*lambda_B_x - l_B_y__rocker_theta*lambda_B_y;
    const double acceleration_coupler_theta = -l_A_x__coupler_theta*lambda_A_x - l_A_y__coupler_theta*lambda_A_y
        - l_B_x__coupler_theta*lambda_B_x - l_B_y__coupler_theta*lambda_B_y;
    const double acceleration_rocker_y = p->inverse_rocker_mass*lambda_B0_y + p->inverse_rocker_mass*lambda_B_y
        + p->inverse_rocker_mass*p->weight_rocker_y;
    const double acceleration_rocker_x = p->inverse_rocker_mass*lambda_B0_x + p->inverse_rocker_mass*lambda_B_x;
    const double acceleration_coupler_y = p->inverse_coupler_mass*lambda_A_y - p->inverse_coupler_mass*lambda_B_y
        + p->inverse_coupler_mass*p->weight_coupler_y;
    const double acceleration_coupler_x = p->inverse_coupler_mass*lambda_A_x - p->inverse_coupler_mass*lambda_B_x;
    const double acceleration_crank_y = p->inverse_crank_mass*lambda_A0_y - p->inverse_crank_mass*lambda_A_y
        + p->inverse_crank_mass*p->weight_crank_y;
    const double acceleration_crank_x = p->inverse_crank_mass*lambda_A0_x - p->inverse_crank_mass*lambda_A_x;

    /* results */
    a[0] = acceleration_crank_x;
    a[1] = acceleration_crank_y;
    a[2] = acceleration_crank_theta;
    a[3] = acceleration_coupler_x;
    a[4] = acceleration_coupler_y;
    a[5] = acceleration_coupler_theta;
    a[6] = acceleration_rocker_x;
    a[7] = acceleration_rocker_y;
    a[8] = acceleration_rocker_theta;
    aside->lambda[0] = lambda_A0_x;
    aside->lambda[1] = lambda_A0_y;
    aside->lambda[2] = lambda_A_x;
    aside->lambda[3] = lambda_A_y;
    aside->lambda[4] = lambda_B_x;
    aside->lambda[5] = lambda_B_y;
    aside->lambda[6] = lambda_B0_x;
    aside->lambda[7] = lambda_B0_y;
    aside->lambda[8] = lambda_motor;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_crank_y;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_coupler_y;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_rocker_y;
        force[8] = 0.0;
        rhs[0] = rhs_A0_x;
        rhs[1] = rhs_A0_y;
        rhs[2] = rhs_A_x;
        rhs[3] = rhs_A_y;
        rhs[4] = rhs_B_x;
        rhs[5] = rhs_B_y;
        rhs[6] = rhs_B0_x;
        rhs[7] = rhs_B0_y;
        rhs[8] = rhs_motor;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = -aside->lambda[8]*motor_rate;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
