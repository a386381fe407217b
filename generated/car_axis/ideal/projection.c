/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
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

    /* parameters */
    const double length = p->length;
    const double par_r = p->par_r;
    const double omega = p->omega;
    const double axle_head_x = p->axle_head_x;
    const double road_head_x = p->road_head_x;
    const double inverse_axle_mass = p->inverse_axle_mass;
    const double inverse_axle_inertia = p->inverse_axle_inertia;
    const double inverse_road_mass = p->inverse_road_mass;
    const double inverse_road_inertia = p->inverse_road_inertia;

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*road_head_x;
    const double arm_road_head_y = road_head_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = axle_head_x*cos_theta_axle;
    const double arm_axle_head_y = axle_head_x*sin_theta_axle;
    const double bump_value = asin(par_r*sin(omega*time)/length);
    const double bump_rate = omega*par_r*cos(omega*time)/(length*sqrt(1.0 - (par_r * par_r)*(sin(omega*time) *
        sin(omega*time))/(length * length)));

    /* Phi and Phi_dot */
    const double phi_foot_x_2 = arm_road_head_x - road_x;
    const double phi_dot_foot_x_2 = -arm_road_head_y*road_omega - road_vx;
    const double phi_foot_y_2 = arm_road_head_y - road_y;
    const double phi_dot_foot_y_2 = arm_road_head_x*road_omega - road_vy;
    const double phi_slot_offset_2 = arm_axle_head_x*cos_theta_road + arm_axle_head_y*sin_theta_road -
        arm_road_head_x*cos_theta_road - arm_road_head_y*sin_theta_road - axle_x*cos_theta_road -
        axle_y*sin_theta_road + cos_theta_road*road_x + road_y*sin_theta_road;
    const double phi_dot_slot_offset_2 = axle_omega*(arm_axle_head_x*sin_theta_road -
        arm_axle_head_y*cos_theta_road) - axle_vx*cos_theta_road - axle_vy*sin_theta_road +
        cos_theta_road*road_vx + road_omega*(-arm_axle_head_x*sin_theta_road + arm_axle_head_y*cos_theta_road
        + axle_x*sin_theta_road - axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road) +
        road_vy*sin_theta_road;
    const double phi_bump_2 = -bump_value + road_theta;
    const double phi_dot_bump_2 = -bump_rate + road_omega;

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x_3 = -cos_theta_road*inverse_axle_mass;
    const double l_slot_offset__axle_y_3 = -inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta_2 = arm_axle_head_x*sin_theta_road -
        arm_axle_head_y*cos_theta_road;
    const double l_slot_offset__axle_theta_3 = inverse_axle_inertia*w_slot_offset__axle_theta_2;
    const double l_slot_offset__road_x_3 = cos_theta_road*inverse_road_mass;
    const double l_slot_offset__road_y_3 = inverse_road_mass*sin_theta_road;
    const double l_foot_x__road_theta_3 = -arm_road_head_y*inverse_road_inertia;
    const double l_foot_y__road_theta_3 = arm_road_head_x*inverse_road_inertia;
    const double w_slot_offset__road_theta_2 = -arm_axle_head_x*sin_theta_road +
        arm_axle_head_y*cos_theta_road + axle_x*sin_theta_road - axle_y*cos_theta_road + cos_theta_road*road_y
        - road_x*sin_theta_road;
    const double l_slot_offset__road_theta_3 = inverse_road_inertia*w_slot_offset__road_theta_2;
    const double scale_foot_x_3 = -arm_road_head_y*l_foot_x__road_theta_3 + inverse_road_mass;
    if (!(scale_foot_x_3 > 1e-13 * scale_foot_x_3)) return 1;
    const double inverse_pivot_foot_x_3 = 1.0/scale_foot_x_3;
    const double w_foot_y__foot_x_2 = arm_road_head_y*l_foot_y__road_theta_3;
    const double l_foot_y__foot_x_3 = -inverse_pivot_foot_x_3*w_foot_y__foot_x_2;
    const double w_slot_offset__foot_x_2 = arm_road_head_y*l_slot_offset__road_theta_3 +
        l_slot_offset__road_x_3;
    const double l_slot_offset__foot_x_3 = -inverse_pivot_foot_x_3*w_slot_offset__foot_x_2;
    const double w_bump__foot_x_2 = arm_road_head_y*inverse_road_inertia;
    const double l_bump__foot_x_3 = -inverse_pivot_foot_x_3*w_bump__foot_x_2;
    const double scale_foot_y_3 = arm_road_head_x*l_foot_y__road_theta_3 + inverse_road_mass;
    const double pivot_foot_y_3 = l_foot_y__foot_x_3*w_foot_y__foot_x_2 + scale_foot_y_3;
    if (!(pivot_foot_y_3 > 1e-13 * scale_foot_y_3)) return 2;
    const double inverse_pivot_foot_y_3 = 1.0/pivot_foot_y_3;
    const double w_slot_offset__foot_y_2 = -arm_road_head_x*l_slot_offset__road_theta_3 -
        l_slot_offset__foot_x_3*w_foot_y__foot_x_2 + l_slot_offset__road_y_3;
    const double l_slot_offset__foot_y_3 = -inverse_pivot_foot_y_3*w_slot_offset__foot_y_2;
    const double w_bump__foot_y_2 = -arm_road_head_x*inverse_road_inertia -
        l_bump__foot_x_3*w_foot_y__foot_x_2;
    const double l_bump__foot_y_3 = -inverse_pivot_foot_y_3*w_bump__foot_y_2;
    const double scale_slot_offset_3 = -cos_theta_road*l_slot_offset__axle_x_3 +
        cos_theta_road*l_slot_offset__road_x_3 + l_slot_offset__axle_theta_3*w_slot_offset__axle_theta_2 -
        l_slot_offset__axle_y_3*sin_theta_road + l_slot_offset__road_theta_3*w_slot_offset__road_theta_2 +
        l_slot_offset__road_y_3*sin_theta_road;
    const double pivot_slot_offset_3 = l_slot_offset__foot_x_3*w_slot_offset__foot_x_2 +
        l_slot_offset__foot_y_3*w_slot_offset__foot_y_2 + scale_slot_offset_3;
    if (!(pivot_slot_offset_3 > 1e-13 * scale_slot_offset_3)) return 3;
    const double inverse_pivot_slot_offset_3 = 1.0/pivot_slot_offset_3;
    const double w_bump__slot_offset_2 = -inverse_road_inertia*w_slot_offset__road_theta_2 -
        l_bump__foot_x_3*w_slot_offset__foot_x_2 - l_bump__foot_y_3*w_slot_offset__foot_y_2;
    const double l_bump__slot_offset_3 = -inverse_pivot_slot_offset_3*w_bump__slot_offset_2;
    const double scale_bump_3 = inverse_road_inertia;
    const double pivot_bump_3 = l_bump__foot_x_3*w_bump__foot_x_2 + l_bump__foot_y_3*w_bump__foot_y_2 +
        l_bump__slot_offset_3*w_bump__slot_offset_2 + scale_bump_3;
    if (!(pivot_bump_3 > 1e-13 * scale_bump_3)) return 4;
    const double inverse_pivot_bump_3 = 1.0/pivot_bump_3;

    /* forward substitution */
    const double dq_z_foot_y = -l_foot_y__foot_x_3*phi_foot_x_2 + phi_foot_y_2;
    const double dq_z_slot_offset = -dq_z_foot_y*l_slot_offset__foot_y_3 -
        l_slot_offset__foot_x_3*phi_foot_x_2 + phi_slot_offset_2;
    const double dq_z_bump = -dq_z_foot_y*l_bump__foot_y_3 - dq_z_slot_offset*l_bump__slot_offset_3 -
        l_bump__foot_x_3*phi_foot_x_2 + phi_bump_2;

    /* backward substitution */
    const double dq_lambda_bump = -dq_z_bump*inverse_pivot_bump_3;
    const double dq_lambda_slot_offset = -dq_lambda_bump*l_bump__slot_offset_3 -
        dq_z_slot_offset*inverse_pivot_slot_offset_3;
    const double dq_lambda_foot_y = -dq_lambda_bump*l_bump__foot_y_3 -
        dq_lambda_slot_offset*l_slot_offset__foot_y_3 - dq_z_foot_y*inverse_pivot_foot_y_3;
    const double dq_lambda_foot_x = -dq_lambda_bump*l_bump__foot_x_3 - dq_lambda_foot_y*l_foot_y__foot_x_3 -
        dq_lambda_slot_offset*l_slot_offset__foot_x_3 - inverse_pivot_foot_x_3*phi_foot_x_2;
    const double dq_acceleration_road_theta = -dq_lambda_bump*inverse_road_inertia -
        dq_lambda_foot_x*l_foot_x__road_theta_3 - dq_lambda_foot_y*l_foot_y__road_theta_3 -
        dq_lambda_slot_offset*l_slot_offset__road_theta_3;
    const double dq_acceleration_road_y = dq_lambda_foot_y*inverse_road_mass -
        dq_lambda_slot_offset*l_slot_offset__road_y_3;
    const double dq_acceleration_road_x = dq_lambda_foot_x*inverse_road_mass -
        dq_lambda_slot_offset*l_slot_offset__road_x_3;
    const double dq_acceleration_axle_theta = -dq_lambda_slot_offset*l_slot_offset__axle_theta_3;
    const double dq_acceleration_axle_y = -dq_lambda_slot_offset*l_slot_offset__axle_y_3;
    const double dq_acceleration_axle_x = -dq_lambda_slot_offset*l_slot_offset__axle_x_3;

    /* forward substitution */
    const double dv_z_foot_y = -l_foot_y__foot_x_3*phi_dot_foot_x_2 + phi_dot_foot_y_2;
    const double dv_z_slot_offset = -dv_z_foot_y*l_slot_offset__foot_y_3 -
        l_slot_offset__foot_x_3*phi_dot_foot_x_2 + phi_dot_slot_offset_2;
    const double dv_z_bump = -dv_z_foot_y*l_bump__foot_y_3 - dv_z_slot_offset*l_bump__slot_offset_3 -
        l_bump__foot_x_3*phi_dot_foot_x_2 + phi_dot_bump_2;

    /* backward substitution */
    const double dv_lambda_bump = -dv_z_bump*inverse_pivot_bump_3;
    const double dv_lambda_slot_offset = -dv_lambda_bump*l_bump__slot_offset_3 -
        dv_z_slot_offset*inverse_pivot_slot_offset_3;
    const double dv_lambda_foot_y = -dv_lambda_bump*l_bump__foot_y_3 -
        dv_lambda_slot_offset*l_slot_offset__foot_y_3 - dv_z_foot_y*inverse_pivot_foot_y_3;
    const double dv_lambda_foot_x = -dv_lambda_bump*l_bump__foot_x_3 - dv_lambda_foot_y*l_foot_y__foot_x_3 -
        dv_lambda_slot_offset*l_slot_offset__foot_x_3 - inverse_pivot_foot_x_3*phi_dot_foot_x_2;
    const double dv_acceleration_road_theta = -dv_lambda_bump*inverse_road_inertia -
        dv_lambda_foot_x*l_foot_x__road_theta_3 - dv_lambda_foot_y*l_foot_y__road_theta_3 -
        dv_lambda_slot_offset*l_slot_offset__road_theta_3;
    const double dv_acceleration_road_y = dv_lambda_foot_y*inverse_road_mass -
        dv_lambda_slot_offset*l_slot_offset__road_y_3;
    const double dv_acceleration_road_x = dv_lambda_foot_x*inverse_road_mass -
        dv_lambda_slot_offset*l_slot_offset__road_x_3;
    const double dv_acceleration_axle_theta = -dv_lambda_slot_offset*l_slot_offset__axle_theta_3;
    const double dv_acceleration_axle_y = -dv_lambda_slot_offset*l_slot_offset__axle_y_3;
    const double dv_acceleration_axle_x = -dv_lambda_slot_offset*l_slot_offset__axle_x_3;

    /* results */
    dq[0] = dq_acceleration_axle_x;
    dv[0] = dv_acceleration_axle_x;
    dq[1] = dq_acceleration_axle_y;
    dv[1] = dv_acceleration_axle_y;
    dq[2] = dq_acceleration_axle_theta;
    dv[2] = dv_acceleration_axle_theta;
    dq[3] = dq_acceleration_road_x;
    dv[3] = dv_acceleration_road_x;
    dq[4] = dq_acceleration_road_y;
    dv[4] = dv_acceleration_road_y;
    dq[5] = dq_acceleration_road_theta;
    dv[5] = dv_acceleration_road_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_foot_x_2), *worst);
    *worst = fmax(fabs(phi_foot_y_2), *worst);
    *worst = fmax(fabs(phi_slot_offset_2), *worst);
    *worst = fmax(fabs(phi_bump_2), *worst);
    return 0;
}

