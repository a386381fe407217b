/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double time = t;
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];

    /* parameters */
    const double length = p->length;
    const double par_r = p->par_r;
    const double omega = p->omega;
    const double inverse_axle_mass = p->inverse_axle_mass;
    const double inverse_axle_inertia = p->inverse_axle_inertia;
    const double axle_tail_span_x = p->axle_tail_span_x;

    /* directions, arms, drives */
    const double bump_value = asin(par_r*sin(omega*time)/length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double bump_rate = omega*par_r*cos(omega*time)/(length*sqrt(1.0 - (par_r * par_r)*(sin(omega*time) *
        sin(omega*time))/(length * length)));
    const double span_axle_tail_x = axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = axle_tail_span_x*sin_theta_axle;

    /* Phi and Phi_dot */
    const double phi_slot_offset = -axle_x*cos_theta_road - axle_y*sin_theta_road -
        cos_theta_road*span_axle_tail_x - sin_theta_road*span_axle_tail_y;
    const double phi_dot_slot_offset = axle_omega*(cos_theta_road*span_axle_tail_y -
        sin_theta_road*span_axle_tail_x) - axle_x_rate*cos_theta_road - axle_y_rate*sin_theta_road +
        bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y) - bump_rate*sin_theta_road*(-axle_x -
        span_axle_tail_x);

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x_4 = -cos_theta_road*inverse_axle_mass;
    const double l_slot_offset__axle_y_4 = -inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta_3 = cos_theta_road*span_axle_tail_y -
        sin_theta_road*span_axle_tail_x;
    const double l_slot_offset__axle_theta_4 = inverse_axle_inertia*w_slot_offset__axle_theta_3;
    const double scale_slot_offset_4 = -cos_theta_road*l_slot_offset__axle_x_4 +
        l_slot_offset__axle_theta_4*w_slot_offset__axle_theta_3 - l_slot_offset__axle_y_4*sin_theta_road;
    if (!(scale_slot_offset_4 > 1e-10 * scale_slot_offset_4)) return 1;
    const double inverse_pivot_slot_offset_4 = 1.0/scale_slot_offset_4;

    /* backward substitution */
    const double dq_lambda_slot_offset = -inverse_pivot_slot_offset_4*phi_slot_offset;
    const double dq_acceleration_axle_theta = -dq_lambda_slot_offset*l_slot_offset__axle_theta_4;
    const double dq_acceleration_axle_y = -dq_lambda_slot_offset*l_slot_offset__axle_y_4;
    const double dq_acceleration_axle_x = -dq_lambda_slot_offset*l_slot_offset__axle_x_4;

    /* backward substitution */
    const double dv_lambda_slot_offset = -inverse_pivot_slot_offset_4*phi_dot_slot_offset;
    const double dv_acceleration_axle_theta = -dv_lambda_slot_offset*l_slot_offset__axle_theta_4;
    const double dv_acceleration_axle_y = -dv_lambda_slot_offset*l_slot_offset__axle_y_4;
    const double dv_acceleration_axle_x = -dv_lambda_slot_offset*l_slot_offset__axle_x_4;

    /* results */
    dq[0] = dq_acceleration_axle_x;
    dv[0] = dv_acceleration_axle_x;
    dq[1] = dq_acceleration_axle_y;
    dv[1] = dv_acceleration_axle_y;
    dq[2] = dq_acceleration_axle_theta;
    dv[2] = dv_acceleration_axle_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_slot_offset));
    return 0;
}
