/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    (void)t;
    /* coordinates, velocities, time */
    const double block_x = q[0];
    const double block_y = q[1];
    const double block_theta = q[2];
    const double block_vx = v[0];
    const double block_vy = v[1];
    const double block_omega = v[2];

    /* directions, arms, drives */
    const double spring_span_x = block_x - p->wall_x;
    const double spring_length = sqrt((block_y * block_y) + (spring_span_x * spring_span_x));
    const double spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* friction: slip, or stick as a row */
    const double slip_rub = block_vx - p->rub_speed;
    const double mode_rub = memory->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub = mode_rub == 0.0 ? 1.0 : 0.0;
    const double sign_rub = fabs(mode_rub) > 1.0 ? 0.0 : mode_rub;
    const double kinetic_rub = -p->rub_kinetic*sign_rub;
    const double rhs_rub = -slip_rub*p->two_alpha_stick;
    aside->friction[0].v = slip_rub;
    aside->friction[0].static_limit = p->rub_static;
    aside->friction[0].speed = p->rub_speed;
    aside->friction[0].force = kinetic_rub;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_guide_offset = block_y;
    const double phi_dot_guide_offset = block_vy;
    const double rhs_guide_offset = -p->beta_squared*phi_guide_offset - phi_dot_guide_offset*p->two_alpha;
    aside->phi[0] = phi_guide_offset;
    aside->phi_dot[0] = phi_dot_guide_offset;
    const double phi_guide_angle = block_theta;
    const double phi_dot_guide_angle = block_omega;
    const double rhs_guide_angle = -p->beta_squared*phi_guide_angle - phi_dot_guide_angle*p->two_alpha;
    aside->phi[1] = phi_guide_angle;
    aside->phi_dot[1] = phi_dot_guide_angle;

    /* L D L^T of the KKT matrix */
    const double scale_guide_offset = p->inverse_block_mass;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY))
        return 1;
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    const double scale_guide_angle = p->inverse_block_inertia;
    if (!(scale_guide_angle > 0.0 && scale_guide_angle < INFINITY))
        return 2;
    const double inverse_pivot_guide_angle = 1.0/scale_guide_angle;
    const double scale_rub = p->inverse_block_mass;
    if (stick_rub != 0.0 && !(scale_rub > 0.0 && scale_rub < INFINITY))
        return 3;
    const double inverse_pivot_rub = stick_rub != 0.0 ? 1.0/scale_rub : 0.0;

    /* forward substitution */
    const double z_block_x = kinetic_rub - spring_pull*spring_span_x;
    const double z_block_y = -block_y*spring_pull;
    const double z_guide_offset = -p->inverse_block_mass*z_block_y + rhs_guide_offset;
    const double z_rub = -p->inverse_block_mass*z_block_x + rhs_rub;

    /* backward substitution */
    const double lambda_rub = -inverse_pivot_rub*z_rub;
    const double lambda_guide_angle = -inverse_pivot_guide_angle*rhs_guide_angle;
    const double acceleration_block_theta = -p->inverse_block_inertia*lambda_guide_angle;
    const double lambda_guide_offset = -inverse_pivot_guide_offset*z_guide_offset;
    const double acceleration_block_y = -p->inverse_block_mass*lambda_guide_offset + p->inverse_block_mass*z_block_y;
    const double acceleration_block_x = -p->inverse_block_mass*lambda_rub + p->inverse_block_mass*z_block_x;

    /* results */
    a[0] = acceleration_block_x;
    a[1] = acceleration_block_y;
    a[2] = acceleration_block_theta;
    aside->lambda[0] = lambda_guide_offset;
    aside->lambda[1] = lambda_guide_angle;
    aside->friction[0].rate = acceleration_block_x;
    if (stick_rub != 0.0)
        aside->friction[0].force = -lambda_rub;  /* stick of rub */
    aside->power[0] = 0.0;
    aside->power[1] = aside->friction[0].force*(aside->friction[0].speed + aside->friction[0].v);
    aside->power[2] = 0.0;
    return 0;
}
