/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double *const g = aside->g;

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
    const double slider_x = q[6];
    const double slider_y = q[7];
    const double slider_theta = q[8];
    const double slider_vx = v[6];
    const double slider_vy = v[7];
    const double slider_omega = v[8];

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_head_s_x;
    const double arm_crank_head_y = p->crank_head_s_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*p->rod_head_s_x;
    const double arm_rod_head_y = p->rod_head_s_x*sin_theta_rod;
    const double motor_value = p->omega*t;
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;

    /* status */
    int pivot = 0;

    /* clearance joint wristpin */
    const double e_wristpin_x = -arm_rod_head_x - rod_x + slider_x;
    const double e_wristpin_y = -arm_rod_head_y - rod_y + slider_y;
    const double edot_wristpin_x = arm_rod_head_y*rod_omega - rod_vx + slider_vx;
    const double edot_wristpin_y = -arm_rod_head_x*rod_omega - rod_vy + slider_vy;
    clearance_wristpin(e_wristpin_x, e_wristpin_y, edot_wristpin_x, edot_wristpin_y, rod_omega, slider_omega,
        &memory->latch[0], p, side, g, &aside->clearance[0]);
    const double F_wristpin_x = aside->clearance[0].Fx;
    const double F_wristpin_y = aside->clearance[0].Fy;
    const double M_wristpin_first = aside->clearance[0].moment_first;
    const double M_wristpin_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_wristpin_x*edot_wristpin_x + F_wristpin_y*edot_wristpin_y
        + M_wristpin_first*rod_omega + M_wristpin_second*slider_omega;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x = arm_crank_head_x - crank_x;
    const double phi_dot_O_x = -arm_crank_head_y*crank_omega - crank_vx;
    const double rhs_O_x = arm_crank_head_x*(crank_omega * crank_omega) - p->beta_squared*phi_O_x
        - phi_dot_O_x*p->two_alpha;
    aside->phi[0] = phi_O_x;
    aside->phi_dot[0] = phi_dot_O_x;
    const double phi_O_y = arm_crank_head_y - crank_y;
    const double phi_dot_O_y = arm_crank_head_x*crank_omega - crank_vy;
    const double rhs_O_y = arm_crank_head_y*(crank_omega * crank_omega) - p->beta_squared*phi_O_y
        - phi_dot_O_y*p->two_alpha;
    aside->phi[1] = phi_O_y;
    aside->phi_dot[1] = phi_dot_O_y;
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
    const double phi_cylinder_offset = slider_y;
    const double phi_dot_cylinder_offset = slider_vy;
    const double rhs_cylinder_offset = -p->beta_squared*phi_cylinder_offset - phi_dot_cylinder_offset*p->two_alpha;
    aside->phi[4] = phi_cylinder_offset;
    aside->phi_dot[4] = phi_dot_cylinder_offset;
    const double phi_cylinder_angle = slider_theta;
    const double phi_dot_cylinder_angle = slider_omega;
    const double rhs_cylinder_angle = -p->beta_squared*phi_cylinder_angle - phi_dot_cylinder_angle*p->two_alpha;
    aside->phi[5] = phi_cylinder_angle;
    aside->phi_dot[5] = phi_dot_cylinder_angle;
    const double phi_motor = crank_theta - motor_value;
    const double phi_dot_motor = crank_omega - motor_rate;
    const double rhs_motor = -p->beta_squared*phi_motor + motor_acceleration - phi_dot_motor*p->two_alpha;
    aside->phi[6] = phi_motor;
    aside->phi_dot[6] = phi_dot_motor;

    /* L D L^T of the KKT matrix */
    const double scale_cylinder_offset = p->inverse_slider_mass;
    if (!(scale_cylinder_offset > 0.0 && scale_cylinder_offset < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_cylinder_offset = 1.0/scale_cylinder_offset;
    const double scale_cylinder_angle = p->inverse_slider_inertia;
    if (!(scale_cylinder_angle > 0.0 && scale_cylinder_angle < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_pivot_cylinder_angle = 1.0/scale_cylinder_angle;
    const double l_crankpin_x__rod_theta = -arm_rod_head_y*p->inverse_rod_inertia;
    const double l_crankpin_y__rod_theta = arm_rod_head_x*p->inverse_rod_inertia;
    const double l_O_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_O_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double l_crankpin_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_crankpin_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double scale_O_x = -arm_crank_head_y*l_O_x__crank_theta + p->inverse_crank_mass;
    const double scale_O_y = arm_crank_head_x*l_O_y__crank_theta + p->inverse_crank_mass;
    const double pivot_O_x__O_y = -arm_crank_head_y*l_O_y__crank_theta;
    const double determinant_O_x__O_y = -(pivot_O_x__O_y * pivot_O_x__O_y) + scale_O_x*scale_O_y;
    if (!(scale_O_x > 0.0 && scale_O_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_O_x__O_y > memory->least * scale_O_y * scale_O_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_O_x__O_y = -1.0/determinant_O_x__O_y;
    const double inverse_pivot_O_x = inverse_O_x__O_y*scale_O_y;
    const double inverse_pivot_O_y = inverse_O_x__O_y*scale_O_x;
    const double inverse_cross_O_x__O_y = -inverse_O_x__O_y*pivot_O_x__O_y;
    const double w_crankpin_x__O_x = arm_crank_head_y*l_crankpin_x__crank_theta + p->inverse_crank_mass;
    const double w_crankpin_x__O_y = -arm_crank_head_x*l_crankpin_x__crank_theta;
    const double l_crankpin_x__O_x = inverse_cross_O_x__O_y*w_crankpin_x__O_y + inverse_pivot_O_x*w_crankpin_x__O_x;
    const double l_crankpin_x__O_y = inverse_cross_O_x__O_y*w_crankpin_x__O_x + inverse_pivot_O_y*w_crankpin_x__O_y;
    const double w_crankpin_y__O_x = arm_crank_head_y*l_crankpin_y__crank_theta;
    const double w_crankpin_y__O_y = -arm_crank_head_x*l_crankpin_y__crank_theta + p->inverse_crank_mass;
    const double l_crankpin_y__O_x = inverse_cross_O_x__O_y*w_crankpin_y__O_y + inverse_pivot_O_x*w_crankpin_y__O_x;
    const double l_crankpin_y__O_y = inverse_cross_O_x__O_y*w_crankpin_y__O_x + inverse_pivot_O_y*w_crankpin_y__O_y;
    const double w_motor__O_x = arm_crank_head_y*p->inverse_crank_inertia;
    const double w_motor__O_y = -arm_crank_head_x*p->inverse_crank_inertia;
    const double l_motor__O_x = inverse_cross_O_x__O_y*w_motor__O_y + inverse_pivot_O_x*w_motor__O_x;
    const double l_motor__O_y = inverse_cross_O_x__O_y*w_motor__O_x + inverse_pivot_O_y*w_motor__O_y;
    const double scale_crankpin_x = -arm_crank_head_y*l_crankpin_x__crank_theta
        - arm_rod_head_y*l_crankpin_x__rod_theta + p->inverse_crank_mass + p->inverse_rod_mass;
    const double scale_crankpin_y = arm_crank_head_x*l_crankpin_y__crank_theta + arm_rod_head_x*l_crankpin_y__rod_theta
        + p->inverse_crank_mass + p->inverse_rod_mass;
    const double pivot_crankpin_x = l_crankpin_x__O_x*w_crankpin_x__O_x + l_crankpin_x__O_y*w_crankpin_x__O_y
        + scale_crankpin_x;
    const double pivot_crankpin_y = l_crankpin_y__O_x*w_crankpin_y__O_x + l_crankpin_y__O_y*w_crankpin_y__O_y
        + scale_crankpin_y;
    const double pivot_crankpin_x__crankpin_y = -arm_crank_head_y*l_crankpin_y__crank_theta
        - arm_rod_head_y*l_crankpin_y__rod_theta + l_crankpin_y__O_x*w_crankpin_x__O_x
        + l_crankpin_y__O_y*w_crankpin_x__O_y;
    const double determinant_crankpin_x__crankpin_y = pivot_crankpin_x*pivot_crankpin_y
        - (pivot_crankpin_x__crankpin_y * pivot_crankpin_x__crankpin_y);
    if (!(pivot_crankpin_x > memory->least * scale_crankpin_x)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_crankpin_x__crankpin_y > memory->least * scale_crankpin_y * pivot_crankpin_x)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_crankpin_x__crankpin_y = -1.0/determinant_crankpin_x__crankpin_y;
    const double inverse_pivot_crankpin_x = inverse_crankpin_x__crankpin_y*pivot_crankpin_y;
    const double inverse_pivot_crankpin_y = inverse_crankpin_x__crankpin_y*pivot_crankpin_x;
    const double inverse_cross_crankpin_x__crankpin_y = -inverse_crankpin_x__crankpin_y*pivot_crankpin_x__crankpin_y;
    const double w_motor__crankpin_x = arm_crank_head_y*p->inverse_crank_inertia - l_motor__O_x*w_crankpin_x__O_x
        - l_motor__O_y*w_crankpin_x__O_y;
    const double w_motor__crankpin_y = -arm_crank_head_x*p->inverse_crank_inertia - l_motor__O_x*w_crankpin_y__O_x
        - l_motor__O_y*w_crankpin_y__O_y;
    const double l_motor__crankpin_x = inverse_cross_crankpin_x__crankpin_y*w_motor__crankpin_y
        + inverse_pivot_crankpin_x*w_motor__crankpin_x;
    const double l_motor__crankpin_y = inverse_cross_crankpin_x__crankpin_y*w_motor__crankpin_x
        + inverse_pivot_crankpin_y*w_motor__crankpin_y;
    const double scale_motor = p->inverse_crank_inertia;
    const double pivot_motor = l_motor__O_x*w_motor__O_x + l_motor__O_y*w_motor__O_y
        + l_motor__crankpin_x*w_motor__crankpin_x + l_motor__crankpin_y*w_motor__crankpin_y + scale_motor;
    if (!(pivot_motor > memory->least * scale_motor)) {
        pivot = 7;
        goto dependent;
    }
    const double inverse_pivot_motor = 1.0/pivot_motor;

    /* forward substitution */
    const double z_cylinder_offset = -F_wristpin_y*p->inverse_slider_mass + rhs_cylinder_offset;
    const double z_cylinder_angle = -M_wristpin_second*p->inverse_slider_inertia + rhs_cylinder_angle;
    const double z_rod_theta = F_wristpin_x*arm_rod_head_y - F_wristpin_y*arm_rod_head_x + M_wristpin_first;
    const double z_crankpin_x = -F_wristpin_x*p->inverse_rod_mass - l_crankpin_x__O_x*rhs_O_x
        - l_crankpin_x__O_y*rhs_O_y - l_crankpin_x__rod_theta*z_rod_theta + rhs_crankpin_x;
    const double z_crankpin_y = -F_wristpin_y*p->inverse_rod_mass - l_crankpin_y__O_x*rhs_O_x
        - l_crankpin_y__O_y*rhs_O_y - l_crankpin_y__rod_theta*z_rod_theta + rhs_crankpin_y;
    const double z_motor = -l_motor__O_x*rhs_O_x - l_motor__O_y*rhs_O_y - l_motor__crankpin_x*z_crankpin_x
        - l_motor__crankpin_y*z_crankpin_y + rhs_motor;

    /* backward substitution */
    const double lambda_motor = -inverse_pivot_motor*z_motor;
    const double lambda_crankpin_y = inverse_cross_crankpin_x__crankpin_y*z_crankpin_x
        + inverse_pivot_crankpin_y*z_crankpin_y - l_motor__crankpin_y*lambda_motor;
    const double lambda_crankpin_x = inverse_cross_crankpin_x__crankpin_y*z_crankpin_y
        + inverse_pivot_crankpin_x*z_crankpin_x - l_motor__crankpin_x*lambda_motor;
    const double lambda_O_y = inverse_cross_O_x__O_y*rhs_O_x + inverse_pivot_O_y*rhs_O_y
        - l_crankpin_x__O_y*lambda_crankpin_x - l_crankpin_y__O_y*lambda_crankpin_y - l_motor__O_y*lambda_motor;
    const double lambda_O_x = inverse_cross_O_x__O_y*rhs_O_y + inverse_pivot_O_x*rhs_O_x
        - l_crankpin_x__O_x*lambda_crankpin_x - l_crankpin_y__O_x*lambda_crankpin_y - l_motor__O_x*lambda_motor;
    const double acceleration_crank_theta = -p->inverse_crank_inertia*lambda_motor - l_O_x__crank_theta*lambda_O_x
        - l_O_y__crank_theta*lambda_O_y - l_crankpin_x__crank_theta*lambda_crankpin_x
        - l_crankpin_y__crank_theta*lambda_crankpin_y;
    const double acceleration_rod_theta = p->inverse_rod_inertia*z_rod_theta
        - l_crankpin_x__rod_theta*lambda_crankpin_x - l_crankpin_y__rod_theta*lambda_crankpin_y;
    const double acceleration_crank_y = p->inverse_crank_mass*lambda_O_y - p->inverse_crank_mass*lambda_crankpin_y;
    const double acceleration_crank_x = p->inverse_crank_mass*lambda_O_x - p->inverse_crank_mass*lambda_crankpin_x;
    const double lambda_cylinder_angle = -inverse_pivot_cylinder_angle*z_cylinder_angle;
    const double acceleration_slider_theta = M_wristpin_second*p->inverse_slider_inertia
        - p->inverse_slider_inertia*lambda_cylinder_angle;
    const double lambda_cylinder_offset = -inverse_pivot_cylinder_offset*z_cylinder_offset;
    const double acceleration_slider_y = F_wristpin_y*p->inverse_slider_mass
        - p->inverse_slider_mass*lambda_cylinder_offset;
    const double acceleration_rod_y = -F_wristpin_y*p->inverse_rod_mass + p->inverse_rod_mass*lambda_crankpin_y;
    const double acceleration_rod_x = -F_wristpin_x*p->inverse_rod_mass + p->inverse_rod_mass*lambda_crankpin_x;
    const double acceleration_slider_x = F_wristpin_x*p->inverse_slider_mass;

    /* results */
    a[0] = acceleration_crank_x;
    a[1] = acceleration_crank_y;
    a[2] = acceleration_crank_theta;
    a[3] = acceleration_rod_x;
    a[4] = acceleration_rod_y;
    a[5] = acceleration_rod_theta;
    a[6] = acceleration_slider_x;
    a[7] = acceleration_slider_y;
    a[8] = acceleration_slider_theta;
    aside->lambda[0] = lambda_O_x;
    aside->lambda[1] = lambda_O_y;
    aside->lambda[2] = lambda_crankpin_x;
    aside->lambda[3] = lambda_crankpin_y;
    aside->lambda[4] = lambda_cylinder_offset;
    aside->lambda[5] = lambda_cylinder_angle;
    aside->lambda[6] = lambda_motor;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = 0.0;
        force[2] = 0.0;
        force[3] = -F_wristpin_x;
        force[4] = -F_wristpin_y;
        force[5] = F_wristpin_x*arm_rod_head_y - F_wristpin_y*arm_rod_head_x + M_wristpin_first;
        force[6] = F_wristpin_x;
        force[7] = F_wristpin_y;
        force[8] = M_wristpin_second;
        rhs[0] = rhs_O_x;
        rhs[1] = rhs_O_y;
        rhs[2] = rhs_crankpin_x;
        rhs[3] = rhs_crankpin_y;
        rhs[4] = rhs_cylinder_offset;
        rhs[5] = rhs_cylinder_angle;
        rhs[6] = rhs_motor;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = -aside->lambda[6]*motor_rate;
    aside->power[1] = 0.0;
    aside->power[2] = aside->clearance[0].power;
    return pivot;
}
