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

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*p->crank_length;
    const double arm_crank_head_y = p->crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*p->rod_points_crankpin_x;
    const double arm_rod_crankpin_y = p->rod_points_crankpin_x*sin_theta_rod;
    const double arm_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const double arm_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const double arm_rod_middle_x = cos_theta_rod*p->rod_points_middle_x;
    const double arm_rod_middle_y = p->rod_points_middle_x*sin_theta_rod;
    const double coil_span_x = -arm_crank_middle_x + arm_rod_middle_x - crank_x + rod_x;
    const double coil_span_y = -arm_crank_middle_y + arm_rod_middle_y - crank_y + rod_y;
    const double coil_span_rate_x = arm_crank_middle_y*crank_omega - arm_rod_middle_y*rod_omega - crank_vx + rod_vx;
    const double coil_span_rate_y = -arm_crank_middle_x*crank_omega + arm_rod_middle_x*rod_omega - crank_vy + rod_vy;
    const double coil_length = sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const double coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const double coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);
    const double coil_pull = coil_force/coil_length;
    const double arm_rod_tip_y = p->rod_points_tip_x*sin_theta_rod;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O_x = -crank_x;
    const double phi_dot_O_x = -crank_vx;
    const double rhs_O_x = -p->beta_squared*phi_O_x - phi_dot_O_x*p->two_alpha;
    aside->phi[0] = phi_O_x;
    aside->phi_dot[0] = phi_dot_O_x;
    const double phi_O_y = -crank_y;
    const double phi_dot_O_y = -crank_vy;
    const double rhs_O_y = -p->beta_squared*phi_O_y - phi_dot_O_y*p->two_alpha;
    aside->phi[1] = phi_O_y;
    aside->phi_dot[1] = phi_dot_O_y;
    const double phi_pin_x = arm_crank_head_x - arm_rod_crankpin_x + crank_x - rod_x;
    const double phi_dot_pin_x = -arm_crank_head_y*crank_omega + arm_rod_crankpin_y*rod_omega + crank_vx - rod_vx;
    const double rhs_pin_x = arm_crank_head_x*(crank_omega * crank_omega) - arm_rod_crankpin_x*(rod_omega * rod_omega)
        - p->beta_squared*phi_pin_x - phi_dot_pin_x*p->two_alpha;
    aside->phi[2] = phi_pin_x;
    aside->phi_dot[2] = phi_dot_pin_x;
    const double phi_pin_y = arm_crank_head_y - arm_rod_crankpin_y + crank_y - rod_y;
    const double phi_dot_pin_y = arm_crank_head_x*crank_omega - arm_rod_crankpin_x*rod_omega + crank_vy - rod_vy;
    const double rhs_pin_y = arm_crank_head_y*(crank_omega * crank_omega) - arm_rod_crankpin_y*(rod_omega * rod_omega)
        - p->beta_squared*phi_pin_y - phi_dot_pin_y*p->two_alpha;
    aside->phi[3] = phi_pin_y;
    aside->phi_dot[3] = phi_dot_pin_y;
    const double phi_slider_offset = rod_y;
    const double phi_dot_slider_offset = rod_vy;
    const double rhs_slider_offset = -p->beta_squared*phi_slider_offset - phi_dot_slider_offset*p->two_alpha;
    aside->phi[4] = phi_slider_offset;
    aside->phi_dot[4] = phi_dot_slider_offset;

    /* L D L^T of the KKT matrix */
    const double scale_O_x = p->inverse_crank_mass;
    if (!(scale_O_x > 0.0 && scale_O_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_O_x = 1.0/scale_O_x;
    const double l_pin_x__O_x = -p->inverse_crank_mass*inverse_pivot_O_x;
    const double scale_O_y = p->inverse_crank_mass;
    if (!(scale_O_y > 0.0 && scale_O_y < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_pivot_O_y = 1.0/scale_O_y;
    const double l_pin_y__O_y = -p->inverse_crank_mass*inverse_pivot_O_y;
    const double l_pin_x__crank_theta = -arm_crank_head_y*p->inverse_crank_inertia;
    const double l_pin_y__crank_theta = arm_crank_head_x*p->inverse_crank_inertia;
    const double scale_slider_offset = p->inverse_rod_mass;
    if (!(scale_slider_offset > 0.0 && scale_slider_offset < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    const double inverse_pivot_slider_offset = 1.0/scale_slider_offset;
    const double l_pin_y__slider_offset = -inverse_pivot_slider_offset*p->inverse_rod_mass;
    const double l_pin_x__rod_theta = arm_rod_crankpin_y*p->inverse_rod_inertia;
    const double l_pin_y__rod_theta = -arm_rod_crankpin_x*p->inverse_rod_inertia;
    const double scale_pin_x = -arm_crank_head_y*l_pin_x__crank_theta + arm_rod_crankpin_y*l_pin_x__rod_theta
        + p->inverse_crank_mass + p->inverse_rod_mass;
    const double scale_pin_y = arm_crank_head_x*l_pin_y__crank_theta - arm_rod_crankpin_x*l_pin_y__rod_theta
        + p->inverse_crank_mass + p->inverse_rod_mass;
    const double pivot_pin_x = p->inverse_crank_mass*l_pin_x__O_x + scale_pin_x;
    const double pivot_pin_y = p->inverse_crank_mass*l_pin_y__O_y + p->inverse_rod_mass*l_pin_y__slider_offset
        + scale_pin_y;
    const double pivot_pin_x__pin_y = -arm_crank_head_y*l_pin_y__crank_theta + arm_rod_crankpin_y*l_pin_y__rod_theta;
    const double determinant_pin_x__pin_y = pivot_pin_x*pivot_pin_y - (pivot_pin_x__pin_y * pivot_pin_x__pin_y);
    if (!(pivot_pin_x > memory->least * scale_pin_x)) {
        pivot = 4;
        goto dependent;
    }
    if (!(determinant_pin_x__pin_y > memory->least * scale_pin_y * pivot_pin_x)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_pin_x__pin_y = -1.0/determinant_pin_x__pin_y;
    const double inverse_pivot_pin_x = inverse_pin_x__pin_y*pivot_pin_y;
    const double inverse_pivot_pin_y = inverse_pin_x__pin_y*pivot_pin_x;
    const double inverse_cross_pin_x__pin_y = -inverse_pin_x__pin_y*pivot_pin_x__pin_y;

    /* forward substitution */
    const double z_rod_x = -coil_pull*coil_span_x + p->push_value_x;
    const double z_crank_x = coil_pull*coil_span_x;
    const double z_O_x = p->inverse_crank_mass*z_crank_x + rhs_O_x;
    const double z_crank_y = coil_pull*coil_span_y;
    const double z_O_y = p->inverse_crank_mass*z_crank_y + rhs_O_y;
    const double z_crank_theta = arm_crank_middle_x*coil_pull*coil_span_y - arm_crank_middle_y*coil_pull*coil_span_x;
    const double z_rod_y = -coil_pull*coil_span_y;
    const double z_slider_offset = -p->inverse_rod_mass*z_rod_y + rhs_slider_offset;
    const double z_rod_theta = -arm_rod_middle_x*coil_pull*coil_span_y + arm_rod_middle_y*coil_pull*coil_span_x
        - arm_rod_tip_y*p->push_value_x;
    const double z_pin_x = -p->inverse_crank_mass*z_crank_x + p->inverse_rod_mass*z_rod_x - l_pin_x__O_x*z_O_x
        - l_pin_x__crank_theta*z_crank_theta - l_pin_x__rod_theta*z_rod_theta + rhs_pin_x;
    const double z_pin_y = -p->inverse_crank_mass*z_crank_y + p->inverse_rod_mass*z_rod_y - l_pin_y__O_y*z_O_y
        - l_pin_y__crank_theta*z_crank_theta - l_pin_y__rod_theta*z_rod_theta - l_pin_y__slider_offset*z_slider_offset
        + rhs_pin_y;

    /* backward substitution */
    const double lambda_pin_y = inverse_cross_pin_x__pin_y*z_pin_x + inverse_pivot_pin_y*z_pin_y;
    const double lambda_pin_x = inverse_cross_pin_x__pin_y*z_pin_y + inverse_pivot_pin_x*z_pin_x;
    const double acceleration_rod_theta = p->inverse_rod_inertia*z_rod_theta - l_pin_x__rod_theta*lambda_pin_x
        - l_pin_y__rod_theta*lambda_pin_y;
    const double lambda_slider_offset = -inverse_pivot_slider_offset*z_slider_offset
        - l_pin_y__slider_offset*lambda_pin_y;
    const double acceleration_rod_y = p->inverse_rod_mass*lambda_pin_y - p->inverse_rod_mass*lambda_slider_offset
        + p->inverse_rod_mass*z_rod_y;
    const double acceleration_crank_theta = p->inverse_crank_inertia*z_crank_theta - l_pin_x__crank_theta*lambda_pin_x
        - l_pin_y__crank_theta*lambda_pin_y;
    const double lambda_O_y = -inverse_pivot_O_y*z_O_y - l_pin_y__O_y*lambda_pin_y;
    const double acceleration_crank_y = p->inverse_crank_mass*lambda_O_y - p->inverse_crank_mass*lambda_pin_y
        + p->inverse_crank_mass*z_crank_y;
    const double lambda_O_x = -inverse_pivot_O_x*z_O_x - l_pin_x__O_x*lambda_pin_x;
    const double acceleration_crank_x = p->inverse_crank_mass*lambda_O_x - p->inverse_crank_mass*lambda_pin_x
        + p->inverse_crank_mass*z_crank_x;
    const double acceleration_rod_x = p->inverse_rod_mass*lambda_pin_x + p->inverse_rod_mass*z_rod_x;

    /* results */
    a[0] = acceleration_crank_x;
    a[1] = acceleration_crank_y;
    a[2] = acceleration_crank_theta;
    a[3] = acceleration_rod_x;
    a[4] = acceleration_rod_y;
    a[5] = acceleration_rod_theta;
    aside->lambda[0] = lambda_O_x;
    aside->lambda[1] = lambda_O_y;
    aside->lambda[2] = lambda_pin_x;
    aside->lambda[3] = lambda_pin_y;
    aside->lambda[4] = lambda_slider_offset;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = coil_pull*coil_span_x;
        force[1] = coil_pull*coil_span_y;
        force[2] = arm_crank_middle_x*coil_pull*coil_span_y - arm_crank_middle_y*coil_pull*coil_span_x;
        force[3] = -coil_pull*coil_span_x + p->push_value_x;
        force[4] = -coil_pull*coil_span_y;
        force[5] = -arm_rod_middle_x*coil_pull*coil_span_y + arm_rod_middle_y*coil_pull*coil_span_x
            - arm_rod_tip_y*p->push_value_x;
        rhs[0] = rhs_O_x;
        rhs[1] = rhs_O_y;
        rhs[2] = rhs_pin_x;
        rhs[3] = rhs_pin_y;
        rhs[4] = rhs_slider_offset;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = -p->coil_damping*(coil_length_rate * coil_length_rate)
        + p->push_value_x*(-arm_rod_tip_y*rod_omega + rod_vx);
    aside->power[2] = 0.0;
    return pivot;
}
