/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
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
    const double slider_y = q[7];
    const double slider_theta = q[8];
    const double slider_vy = v[7];
    const double slider_omega = v[8];
    const double time = t;

    /* parameters */
    const double omega = p->omega;
    const double crank_head_x = p->crank_head_x;
    const double rod_head_x = p->rod_head_x;
    const double inverse_slider_mass = p->inverse_slider_mass;
    const double inverse_rod_mass = p->inverse_rod_mass;
    const double inverse_slider_inertia = p->inverse_slider_inertia;
    const double inverse_crank_mass = p->inverse_crank_mass;
    const double inverse_rod_inertia = p->inverse_rod_inertia;
    const double inverse_crank_inertia = p->inverse_crank_inertia;

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*crank_head_x;
    const double arm_crank_head_y = crank_head_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*rod_head_x;
    const double arm_rod_head_y = rod_head_x*sin_theta_rod;
    const double motor_value = omega*time;
    const double motor_rate = omega;

    /* Phi and Phi_dot */
    const double phi_O_x_2 = arm_crank_head_x - crank_x;
    const double phi_dot_O_x_2 = -arm_crank_head_y*crank_omega - crank_vx;
    const double phi_O_y_2 = arm_crank_head_y - crank_y;
    const double phi_dot_O_y_2 = arm_crank_head_x*crank_omega - crank_vy;
    const double phi_crankpin_x_2 = arm_crank_head_x + arm_rod_head_x + crank_x - rod_x;
    const double phi_dot_crankpin_x_2 = -arm_crank_head_y*crank_omega - arm_rod_head_y*rod_omega + crank_vx -
        rod_vx;
    const double phi_crankpin_y_2 = arm_crank_head_y + arm_rod_head_y + crank_y - rod_y;
    const double phi_dot_crankpin_y_2 = arm_crank_head_x*crank_omega + arm_rod_head_x*rod_omega + crank_vy -
        rod_vy;
    const double phi_cylinder_offset_2 = slider_y;
    const double phi_dot_cylinder_offset_2 = slider_vy;
    const double phi_cylinder_angle_2 = slider_theta;
    const double phi_dot_cylinder_angle_2 = slider_omega;
    const double phi_motor_2 = crank_theta - motor_value;
    const double phi_dot_motor_2 = crank_omega - motor_rate;

    /* L D L^T of the KKT matrix */
    const double scale_cylinder_offset_3 = inverse_slider_mass;
    if (!(scale_cylinder_offset_3 > 1e-13 * scale_cylinder_offset_3)) return 1;
    const double inverse_pivot_cylinder_offset_3 = 1.0/scale_cylinder_offset_3;
    const double scale_cylinder_angle_3 = inverse_slider_inertia;
    if (!(scale_cylinder_angle_3 > 1e-13 * scale_cylinder_angle_3)) return 2;
    const double inverse_pivot_cylinder_angle_3 = 1.0/scale_cylinder_angle_3;
    const double l_crankpin_x__rod_theta_3 = -arm_rod_head_y*inverse_rod_inertia;
    const double l_crankpin_y__rod_theta_3 = arm_rod_head_x*inverse_rod_inertia;
    const double l_O_x__crank_theta_3 = -arm_crank_head_y*inverse_crank_inertia;
    const double l_O_y__crank_theta_3 = arm_crank_head_x*inverse_crank_inertia;
    const double l_crankpin_x__crank_theta_3 = -arm_crank_head_y*inverse_crank_inertia;
    const double l_crankpin_y__crank_theta_3 = arm_crank_head_x*inverse_crank_inertia;
    const double scale_O_x_3 = -arm_crank_head_y*l_O_x__crank_theta_3 + inverse_crank_mass;
    if (!(scale_O_x_3 > 1e-13 * scale_O_x_3)) return 3;
    const double inverse_pivot_O_x_3 = 1.0/scale_O_x_3;
    const double w_O_y__O_x_2 = arm_crank_head_y*l_O_y__crank_theta_3;
    const double l_O_y__O_x_3 = -inverse_pivot_O_x_3*w_O_y__O_x_2;
    const double w_crankpin_x__O_x_2 = arm_crank_head_y*l_crankpin_x__crank_theta_3 + inverse_crank_mass;
    const double l_crankpin_x__O_x_3 = -inverse_pivot_O_x_3*w_crankpin_x__O_x_2;
    const double w_crankpin_y__O_x_2 = arm_crank_head_y*l_crankpin_y__crank_theta_3;
    const double l_crankpin_y__O_x_3 = -inverse_pivot_O_x_3*w_crankpin_y__O_x_2;
    const double w_motor__O_x_2 = arm_crank_head_y*inverse_crank_inertia;
    const double l_motor__O_x_3 = -inverse_pivot_O_x_3*w_motor__O_x_2;
    const double scale_O_y_3 = arm_crank_head_x*l_O_y__crank_theta_3 + inverse_crank_mass;
    const double pivot_O_y_3 = l_O_y__O_x_3*w_O_y__O_x_2 + scale_O_y_3;
    if (!(pivot_O_y_3 > 1e-13 * scale_O_y_3)) return 4;
    const double inverse_pivot_O_y_3 = 1.0/pivot_O_y_3;
    const double w_crankpin_x__O_y_2 = -arm_crank_head_x*l_crankpin_x__crank_theta_3 -
        l_crankpin_x__O_x_3*w_O_y__O_x_2;
    const double l_crankpin_x__O_y_3 = -inverse_pivot_O_y_3*w_crankpin_x__O_y_2;
    const double w_crankpin_y__O_y_2 = -arm_crank_head_x*l_crankpin_y__crank_theta_3 + inverse_crank_mass -
        l_crankpin_y__O_x_3*w_O_y__O_x_2;
    const double l_crankpin_y__O_y_3 = -inverse_pivot_O_y_3*w_crankpin_y__O_y_2;
    const double w_motor__O_y_2 = -arm_crank_head_x*inverse_crank_inertia - l_motor__O_x_3*w_O_y__O_x_2;
    const double l_motor__O_y_3 = -inverse_pivot_O_y_3*w_motor__O_y_2;
    const double scale_crankpin_x_3 = -arm_crank_head_y*l_crankpin_x__crank_theta_3 -
        arm_rod_head_y*l_crankpin_x__rod_theta_3 + inverse_crank_mass + inverse_rod_mass;
    const double pivot_crankpin_x_3 = l_crankpin_x__O_x_3*w_crankpin_x__O_x_2 +
        l_crankpin_x__O_y_3*w_crankpin_x__O_y_2 + scale_crankpin_x_3;
    if (!(pivot_crankpin_x_3 > 1e-13 * scale_crankpin_x_3)) return 5;
    const double inverse_pivot_crankpin_x_3 = 1.0/pivot_crankpin_x_3;
    const double w_crankpin_y__crankpin_x_2 = arm_crank_head_y*l_crankpin_y__crank_theta_3 +
        arm_rod_head_y*l_crankpin_y__rod_theta_3 - l_crankpin_y__O_x_3*w_crankpin_x__O_x_2 -
        l_crankpin_y__O_y_3*w_crankpin_x__O_y_2;
    const double l_crankpin_y__crankpin_x_3 = -inverse_pivot_crankpin_x_3*w_crankpin_y__crankpin_x_2;
    const double w_motor__crankpin_x_2 = arm_crank_head_y*inverse_crank_inertia -
        l_motor__O_x_3*w_crankpin_x__O_x_2 - l_motor__O_y_3*w_crankpin_x__O_y_2;
    const double l_motor__crankpin_x_2 = -inverse_pivot_crankpin_x_3*w_motor__crankpin_x_2;
    const double scale_crankpin_y_3 = arm_crank_head_x*l_crankpin_y__crank_theta_3 +
        arm_rod_head_x*l_crankpin_y__rod_theta_3 + inverse_crank_mass + inverse_rod_mass;
    const double pivot_crankpin_y_3 = l_crankpin_y__O_x_3*w_crankpin_y__O_x_2 +
        l_crankpin_y__O_y_3*w_crankpin_y__O_y_2 + l_crankpin_y__crankpin_x_3*w_crankpin_y__crankpin_x_2 +
        scale_crankpin_y_3;
    if (!(pivot_crankpin_y_3 > 1e-13 * scale_crankpin_y_3)) return 6;
    const double inverse_pivot_crankpin_y_3 = 1.0/pivot_crankpin_y_3;
    const double w_motor__crankpin_y_2 = -arm_crank_head_x*inverse_crank_inertia -
        l_motor__O_x_3*w_crankpin_y__O_x_2 - l_motor__O_y_3*w_crankpin_y__O_y_2 -
        l_motor__crankpin_x_2*w_crankpin_y__crankpin_x_2;
    const double l_motor__crankpin_y_2 = -inverse_pivot_crankpin_y_3*w_motor__crankpin_y_2;
    const double scale_motor_3 = inverse_crank_inertia;
    const double pivot_motor_3 = l_motor__O_x_3*w_motor__O_x_2 + l_motor__O_y_3*w_motor__O_y_2 +
        l_motor__crankpin_x_2*w_motor__crankpin_x_2 + l_motor__crankpin_y_2*w_motor__crankpin_y_2 +
        scale_motor_3;
    if (!(pivot_motor_3 > 1e-13 * scale_motor_3)) return 7;
    const double inverse_pivot_motor_3 = 1.0/pivot_motor_3;

    /* forward substitution */
    const double dq_z_O_y = -l_O_y__O_x_3*phi_O_x_2 + phi_O_y_2;
    const double dq_z_crankpin_x = -dq_z_O_y*l_crankpin_x__O_y_3 - l_crankpin_x__O_x_3*phi_O_x_2 +
        phi_crankpin_x_2;
    const double dq_z_crankpin_y = -dq_z_O_y*l_crankpin_y__O_y_3 - dq_z_crankpin_x*l_crankpin_y__crankpin_x_3
        - l_crankpin_y__O_x_3*phi_O_x_2 + phi_crankpin_y_2;
    const double dq_z_motor = -dq_z_O_y*l_motor__O_y_3 - dq_z_crankpin_x*l_motor__crankpin_x_2 -
        dq_z_crankpin_y*l_motor__crankpin_y_2 - l_motor__O_x_3*phi_O_x_2 + phi_motor_2;

    /* backward substitution */
    const double dq_lambda_motor = -dq_z_motor*inverse_pivot_motor_3;
    const double dq_lambda_crankpin_y = -dq_lambda_motor*l_motor__crankpin_y_2 -
        dq_z_crankpin_y*inverse_pivot_crankpin_y_3;
    const double dq_lambda_crankpin_x = -dq_lambda_crankpin_y*l_crankpin_y__crankpin_x_3 -
        dq_lambda_motor*l_motor__crankpin_x_2 - dq_z_crankpin_x*inverse_pivot_crankpin_x_3;
    const double dq_lambda_O_y = -dq_lambda_crankpin_x*l_crankpin_x__O_y_3 -
        dq_lambda_crankpin_y*l_crankpin_y__O_y_3 - dq_lambda_motor*l_motor__O_y_3 -
        dq_z_O_y*inverse_pivot_O_y_3;
    const double dq_lambda_O_x = -dq_lambda_O_y*l_O_y__O_x_3 - dq_lambda_crankpin_x*l_crankpin_x__O_x_3 -
        dq_lambda_crankpin_y*l_crankpin_y__O_x_3 - dq_lambda_motor*l_motor__O_x_3 -
        inverse_pivot_O_x_3*phi_O_x_2;
    const double dq_acceleration_crank_theta = -dq_lambda_O_x*l_O_x__crank_theta_3 -
        dq_lambda_O_y*l_O_y__crank_theta_3 - dq_lambda_crankpin_x*l_crankpin_x__crank_theta_3 -
        dq_lambda_crankpin_y*l_crankpin_y__crank_theta_3 - dq_lambda_motor*inverse_crank_inertia;
    const double dq_acceleration_rod_theta = -dq_lambda_crankpin_x*l_crankpin_x__rod_theta_3 -
        dq_lambda_crankpin_y*l_crankpin_y__rod_theta_3;
    const double dq_acceleration_crank_y = dq_lambda_O_y*inverse_crank_mass -
        dq_lambda_crankpin_y*inverse_crank_mass;
    const double dq_acceleration_crank_x = dq_lambda_O_x*inverse_crank_mass -
        dq_lambda_crankpin_x*inverse_crank_mass;
    const double dq_lambda_cylinder_angle = -inverse_pivot_cylinder_angle_3*phi_cylinder_angle_2;
    const double dq_acceleration_slider_theta = -dq_lambda_cylinder_angle*inverse_slider_inertia;
    const double dq_lambda_cylinder_offset = -inverse_pivot_cylinder_offset_3*phi_cylinder_offset_2;
    const double dq_acceleration_slider_y = -dq_lambda_cylinder_offset*inverse_slider_mass;
    const double dq_acceleration_rod_y = dq_lambda_crankpin_y*inverse_rod_mass;
    const double dq_acceleration_rod_x = dq_lambda_crankpin_x*inverse_rod_mass;
    const double dq_acceleration_slider_x = 0.0;

    /* forward substitution */
    const double dv_z_O_y = -l_O_y__O_x_3*phi_dot_O_x_2 + phi_dot_O_y_2;
    const double dv_z_crankpin_x = -dv_z_O_y*l_crankpin_x__O_y_3 - l_crankpin_x__O_x_3*phi_dot_O_x_2 +
        phi_dot_crankpin_x_2;
    const double dv_z_crankpin_y = -dv_z_O_y*l_crankpin_y__O_y_3 - dv_z_crankpin_x*l_crankpin_y__crankpin_x_3
        - l_crankpin_y__O_x_3*phi_dot_O_x_2 + phi_dot_crankpin_y_2;
    const double dv_z_motor = -dv_z_O_y*l_motor__O_y_3 - dv_z_crankpin_x*l_motor__crankpin_x_2 -
        dv_z_crankpin_y*l_motor__crankpin_y_2 - l_motor__O_x_3*phi_dot_O_x_2 + phi_dot_motor_2;

    /* backward substitution */
    const double dv_lambda_motor = -dv_z_motor*inverse_pivot_motor_3;
    const double dv_lambda_crankpin_y = -dv_lambda_motor*l_motor__crankpin_y_2 -
        dv_z_crankpin_y*inverse_pivot_crankpin_y_3;
    const double dv_lambda_crankpin_x = -dv_lambda_crankpin_y*l_crankpin_y__crankpin_x_3 -
        dv_lambda_motor*l_motor__crankpin_x_2 - dv_z_crankpin_x*inverse_pivot_crankpin_x_3;
    const double dv_lambda_O_y = -dv_lambda_crankpin_x*l_crankpin_x__O_y_3 -
        dv_lambda_crankpin_y*l_crankpin_y__O_y_3 - dv_lambda_motor*l_motor__O_y_3 -
        dv_z_O_y*inverse_pivot_O_y_3;
    const double dv_lambda_O_x = -dv_lambda_O_y*l_O_y__O_x_3 - dv_lambda_crankpin_x*l_crankpin_x__O_x_3 -
        dv_lambda_crankpin_y*l_crankpin_y__O_x_3 - dv_lambda_motor*l_motor__O_x_3 -
        inverse_pivot_O_x_3*phi_dot_O_x_2;
    const double dv_acceleration_crank_theta = -dv_lambda_O_x*l_O_x__crank_theta_3 -
        dv_lambda_O_y*l_O_y__crank_theta_3 - dv_lambda_crankpin_x*l_crankpin_x__crank_theta_3 -
        dv_lambda_crankpin_y*l_crankpin_y__crank_theta_3 - dv_lambda_motor*inverse_crank_inertia;
    const double dv_acceleration_rod_theta = -dv_lambda_crankpin_x*l_crankpin_x__rod_theta_3 -
        dv_lambda_crankpin_y*l_crankpin_y__rod_theta_3;
    const double dv_acceleration_crank_y = dv_lambda_O_y*inverse_crank_mass -
        dv_lambda_crankpin_y*inverse_crank_mass;
    const double dv_acceleration_crank_x = dv_lambda_O_x*inverse_crank_mass -
        dv_lambda_crankpin_x*inverse_crank_mass;
    const double dv_lambda_cylinder_angle = -inverse_pivot_cylinder_angle_3*phi_dot_cylinder_angle_2;
    const double dv_acceleration_slider_theta = -dv_lambda_cylinder_angle*inverse_slider_inertia;
    const double dv_lambda_cylinder_offset = -inverse_pivot_cylinder_offset_3*phi_dot_cylinder_offset_2;
    const double dv_acceleration_slider_y = -dv_lambda_cylinder_offset*inverse_slider_mass;
    const double dv_acceleration_rod_y = dv_lambda_crankpin_y*inverse_rod_mass;
    const double dv_acceleration_rod_x = dv_lambda_crankpin_x*inverse_rod_mass;
    const double dv_acceleration_slider_x = 0.0;

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
    dq[6] = dq_acceleration_slider_x;
    dv[6] = dv_acceleration_slider_x;
    dq[7] = dq_acceleration_slider_y;
    dv[7] = dv_acceleration_slider_y;
    dq[8] = dq_acceleration_slider_theta;
    dv[8] = dv_acceleration_slider_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_O_x_2), *worst);
    *worst = fmax(fabs(phi_O_y_2), *worst);
    *worst = fmax(fabs(phi_crankpin_x_2), *worst);
    *worst = fmax(fabs(phi_crankpin_y_2), *worst);
    *worst = fmax(fabs(phi_cylinder_offset_2), *worst);
    *worst = fmax(fabs(phi_cylinder_angle_2), *worst);
    *worst = fmax(fabs(phi_motor_2), *worst);
    return 0;
}

