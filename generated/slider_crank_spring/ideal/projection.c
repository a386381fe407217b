/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
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

    /* parameters */
    const double crank_length = p->crank_length;
    const double rod_points_crankpin_x = p->rod_points_crankpin_x;
    const double inverse_rod_mass = p->inverse_rod_mass;
    const double inverse_crank_mass = p->inverse_crank_mass;
    const double inverse_crank_inertia = p->inverse_crank_inertia;
    const double inverse_rod_inertia = p->inverse_rod_inertia;

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*crank_length;
    const double arm_crank_head_y = crank_length*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_crankpin_x = cos_theta_rod*rod_points_crankpin_x;
    const double arm_rod_crankpin_y = rod_points_crankpin_x*sin_theta_rod;

    /* Phi and Phi_dot */
    const double phi_O_x_2 = -crank_x;
    const double phi_dot_O_x_2 = -crank_vx;
    const double phi_O_y_2 = -crank_y;
    const double phi_dot_O_y_2 = -crank_vy;
    const double phi_pin_x_2 = arm_crank_head_x - arm_rod_crankpin_x + crank_x - rod_x;
    const double phi_dot_pin_x_2 = -arm_crank_head_y*crank_omega + arm_rod_crankpin_y*rod_omega + crank_vx -
        rod_vx;
    const double phi_pin_y_2 = arm_crank_head_y - arm_rod_crankpin_y + crank_y - rod_y;
    const double phi_dot_pin_y_2 = arm_crank_head_x*crank_omega - arm_rod_crankpin_x*rod_omega + crank_vy -
        rod_vy;
    const double phi_slider_offset_2 = rod_y;
    const double phi_dot_slider_offset_2 = rod_vy;

    /* L D L^T of the KKT matrix */
    const double scale_O_x_3 = inverse_crank_mass;
    if (!(scale_O_x_3 > 1e-13 * scale_O_x_3)) return 1;
    const double inverse_pivot_O_x_3 = 1.0/scale_O_x_3;
    const double l_pin_x__O_x_3 = -inverse_crank_mass*inverse_pivot_O_x_3;
    const double scale_O_y_3 = inverse_crank_mass;
    if (!(scale_O_y_3 > 1e-13 * scale_O_y_3)) return 2;
    const double inverse_pivot_O_y_3 = 1.0/scale_O_y_3;
    const double l_pin_y__O_y_3 = -inverse_crank_mass*inverse_pivot_O_y_3;
    const double l_pin_x__crank_theta_3 = -arm_crank_head_y*inverse_crank_inertia;
    const double l_pin_y__crank_theta_3 = arm_crank_head_x*inverse_crank_inertia;
    const double scale_slider_offset_3 = inverse_rod_mass;
    if (!(scale_slider_offset_3 > 1e-13 * scale_slider_offset_3)) return 3;
    const double inverse_pivot_slider_offset_3 = 1.0/scale_slider_offset_3;
    const double l_pin_y__slider_offset_2 = -inverse_pivot_slider_offset_3*inverse_rod_mass;
    const double l_pin_x__rod_theta_3 = arm_rod_crankpin_y*inverse_rod_inertia;
    const double l_pin_y__rod_theta_3 = -arm_rod_crankpin_x*inverse_rod_inertia;
    const double scale_pin_x_3 = -arm_crank_head_y*l_pin_x__crank_theta_3 +
        arm_rod_crankpin_y*l_pin_x__rod_theta_3 + inverse_crank_mass + inverse_rod_mass;
    const double pivot_pin_x_3 = inverse_crank_mass*l_pin_x__O_x_3 + scale_pin_x_3;
    if (!(pivot_pin_x_3 > 1e-13 * scale_pin_x_3)) return 4;
    const double inverse_pivot_pin_x_3 = 1.0/pivot_pin_x_3;
    const double w_pin_y__pin_x_2 = arm_crank_head_y*l_pin_y__crank_theta_3 -
        arm_rod_crankpin_y*l_pin_y__rod_theta_3;
    const double l_pin_y__pin_x_3 = -inverse_pivot_pin_x_3*w_pin_y__pin_x_2;
    const double scale_pin_y_3 = arm_crank_head_x*l_pin_y__crank_theta_3 -
        arm_rod_crankpin_x*l_pin_y__rod_theta_3 + inverse_crank_mass + inverse_rod_mass;
    const double pivot_pin_y_3 = inverse_crank_mass*l_pin_y__O_y_3 + inverse_rod_mass*l_pin_y__slider_offset_2
        + l_pin_y__pin_x_3*w_pin_y__pin_x_2 + scale_pin_y_3;
    if (!(pivot_pin_y_3 > 1e-13 * scale_pin_y_3)) return 5;
    const double inverse_pivot_pin_y_3 = 1.0/pivot_pin_y_3;

    /* forward substitution */
    const double dq_z_pin_x = -l_pin_x__O_x_3*phi_O_x_2 + phi_pin_x_2;
    const double dq_z_pin_y = -dq_z_pin_x*l_pin_y__pin_x_3 - l_pin_y__O_y_3*phi_O_y_2 -
        l_pin_y__slider_offset_2*phi_slider_offset_2 + phi_pin_y_2;

    /* backward substitution */
    const double dq_lambda_pin_y = -dq_z_pin_y*inverse_pivot_pin_y_3;
    const double dq_lambda_pin_x = -dq_lambda_pin_y*l_pin_y__pin_x_3 - dq_z_pin_x*inverse_pivot_pin_x_3;
    const double dq_acceleration_rod_theta = -dq_lambda_pin_x*l_pin_x__rod_theta_3 -
        dq_lambda_pin_y*l_pin_y__rod_theta_3;
    const double dq_lambda_slider_offset = -dq_lambda_pin_y*l_pin_y__slider_offset_2 -
        inverse_pivot_slider_offset_3*phi_slider_offset_2;
    const double dq_acceleration_rod_y = dq_lambda_pin_y*inverse_rod_mass -
        dq_lambda_slider_offset*inverse_rod_mass;
    const double dq_acceleration_crank_theta = -dq_lambda_pin_x*l_pin_x__crank_theta_3 -
        dq_lambda_pin_y*l_pin_y__crank_theta_3;
    const double dq_lambda_O_y = -dq_lambda_pin_y*l_pin_y__O_y_3 - inverse_pivot_O_y_3*phi_O_y_2;
    const double dq_acceleration_crank_y = dq_lambda_O_y*inverse_crank_mass -
        dq_lambda_pin_y*inverse_crank_mass;
    const double dq_lambda_O_x = -dq_lambda_pin_x*l_pin_x__O_x_3 - inverse_pivot_O_x_3*phi_O_x_2;
    const double dq_acceleration_crank_x = dq_lambda_O_x*inverse_crank_mass -
        dq_lambda_pin_x*inverse_crank_mass;
    const double dq_acceleration_rod_x = dq_lambda_pin_x*inverse_rod_mass;

    /* forward substitution */
    const double dv_z_pin_x = -l_pin_x__O_x_3*phi_dot_O_x_2 + phi_dot_pin_x_2;
    const double dv_z_pin_y = -dv_z_pin_x*l_pin_y__pin_x_3 - l_pin_y__O_y_3*phi_dot_O_y_2 -
        l_pin_y__slider_offset_2*phi_dot_slider_offset_2 + phi_dot_pin_y_2;

    /* backward substitution */
    const double dv_lambda_pin_y = -dv_z_pin_y*inverse_pivot_pin_y_3;
    const double dv_lambda_pin_x = -dv_lambda_pin_y*l_pin_y__pin_x_3 - dv_z_pin_x*inverse_pivot_pin_x_3;
    const double dv_acceleration_rod_theta = -dv_lambda_pin_x*l_pin_x__rod_theta_3 -
        dv_lambda_pin_y*l_pin_y__rod_theta_3;
    const double dv_lambda_slider_offset = -dv_lambda_pin_y*l_pin_y__slider_offset_2 -
        inverse_pivot_slider_offset_3*phi_dot_slider_offset_2;
    const double dv_acceleration_rod_y = dv_lambda_pin_y*inverse_rod_mass -
        dv_lambda_slider_offset*inverse_rod_mass;
    const double dv_acceleration_crank_theta = -dv_lambda_pin_x*l_pin_x__crank_theta_3 -
        dv_lambda_pin_y*l_pin_y__crank_theta_3;
    const double dv_lambda_O_y = -dv_lambda_pin_y*l_pin_y__O_y_3 - inverse_pivot_O_y_3*phi_dot_O_y_2;
    const double dv_acceleration_crank_y = dv_lambda_O_y*inverse_crank_mass -
        dv_lambda_pin_y*inverse_crank_mass;
    const double dv_lambda_O_x = -dv_lambda_pin_x*l_pin_x__O_x_3 - inverse_pivot_O_x_3*phi_dot_O_x_2;
    const double dv_acceleration_crank_x = dv_lambda_O_x*inverse_crank_mass -
        dv_lambda_pin_x*inverse_crank_mass;
    const double dv_acceleration_rod_x = dv_lambda_pin_x*inverse_rod_mass;

    /* results */
    dq[0] = dq_acceleration_crank_x;
    dv[0] = dv_acceleration_crank_x;
    dq[1] = dq_acceleration_crank_y;
    dv[1] = dv_acceleration_crank_y;
    dq[2] = dq_acceleration_crank_theta;
    dv[2] = dv_acceleration_crank_theta;
    dq[3] = dq_acceleration_rod_x;
    dv[3] = dv_acceleration_rod_x;
    dq[4] = dq_acceleration_rod_y;
    dv[4] = dv_acceleration_rod_y;
    dq[5] = dq_acceleration_rod_theta;
    dv[5] = dv_acceleration_rod_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_O_x_2), *worst);
    *worst = fmax(fabs(phi_O_y_2), *worst);
    *worst = fmax(fabs(phi_pin_x_2), *worst);
    *worst = fmax(fabs(phi_pin_y_2), *worst);
    *worst = fmax(fabs(phi_slider_offset_2), *worst);
    return 0;
}

