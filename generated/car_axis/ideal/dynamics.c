/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
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

    /* directions, arms, drives */
    const double cos_theta_road = cos(road_theta);
    const double sin_theta_road = sin(road_theta);
    const double arm_road_head_x = cos_theta_road*p->road_head_s_x;
    const double arm_road_head_y = p->road_head_s_x*sin_theta_road;
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double arm_axle_head_x = p->axle_head_s_x*cos_theta_axle;
    const double arm_axle_head_y = p->axle_head_s_x*sin_theta_axle;
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double bump_acceleration = -(p->omega * p->omega)*p->par_r*sin(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*sin(p->omega*t)*(cos(p->omega*t)
        * cos(p->omega*t))/((p->length * p->length * p->length)*pow(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length), 1.5));
    const double left_span_x = -arm_axle_head_x + axle_x;
    const double left_span_y = -arm_axle_head_y + axle_y;
    const double left_length = sqrt((left_span_x * left_span_x) + (left_span_y * left_span_y));
    const double left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const double left_pull = left_force/left_length;
    const double right_span_x = arm_axle_head_x - arm_road_head_x + axle_x - road_x;
    const double right_span_y = arm_axle_head_y - arm_road_head_y + axle_y - road_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = p->right_stiffness*(-p->right_free_length + right_length);
    const double right_pull = right_force/right_length;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_foot_x = arm_road_head_x - road_x;
    const double phi_dot_foot_x = -arm_road_head_y*road_omega - road_vx;
    const double rhs_foot_x = arm_road_head_x*(road_omega * road_omega) - p->beta_squared*phi_foot_x
        - phi_dot_foot_x*p->two_alpha;
    aside->phi[0] = phi_foot_x;
    aside->phi_dot[0] = phi_dot_foot_x;
    const double phi_foot_y = arm_road_head_y - road_y;
    const double phi_dot_foot_y = arm_road_head_x*road_omega - road_vy;
    const double rhs_foot_y = arm_road_head_y*(road_omega * road_omega) - p->beta_squared*phi_foot_y
        - phi_dot_foot_y*p->two_alpha;
    aside->phi[1] = phi_foot_y;
    aside->phi_dot[1] = phi_dot_foot_y;
    const double phi_slot_offset = arm_axle_head_x*cos_theta_road + arm_axle_head_y*sin_theta_road
        - arm_road_head_x*cos_theta_road - arm_road_head_y*sin_theta_road - axle_x*cos_theta_road
        - axle_y*sin_theta_road + cos_theta_road*road_x + road_y*sin_theta_road;
    const double phi_dot_slot_offset = axle_omega*(arm_axle_head_x*sin_theta_road - arm_axle_head_y*cos_theta_road)
        - axle_vx*cos_theta_road - axle_vy*sin_theta_road + cos_theta_road*road_vx
        + road_omega*(-arm_axle_head_x*sin_theta_road + arm_axle_head_y*cos_theta_road + axle_x*sin_theta_road
        - axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road) + road_vy*sin_theta_road;
    const double rhs_slot_offset = -axle_omega*(arm_axle_head_x*(-axle_omega*cos_theta_road
        + cos_theta_road*road_omega) - arm_axle_head_y*(axle_omega*sin_theta_road - road_omega*sin_theta_road))
        - axle_vx*road_omega*sin_theta_road + axle_vy*cos_theta_road*road_omega - p->beta_squared*phi_slot_offset
        - cos_theta_road*road_omega*road_vy - phi_dot_slot_offset*p->two_alpha + road_omega*road_vx*sin_theta_road
        - road_omega*(cos_theta_road*(arm_axle_head_x*axle_omega - axle_vy
        + road_omega*(-arm_axle_head_x + axle_x - road_x) + road_vy)
        - sin_theta_road*(-arm_axle_head_y*axle_omega - axle_vx + road_omega*(arm_axle_head_y - axle_y + road_y)
        + road_vx));
    aside->phi[2] = phi_slot_offset;
    aside->phi_dot[2] = phi_dot_slot_offset;
    const double phi_bump = -bump_value + road_theta;
    const double phi_dot_bump = -bump_rate + road_omega;
    const double rhs_bump = -p->beta_squared*phi_bump + bump_acceleration - phi_dot_bump*p->two_alpha;
    aside->phi[3] = phi_bump;
    aside->phi_dot[3] = phi_dot_bump;

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const double l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta = arm_axle_head_x*sin_theta_road - arm_axle_head_y*cos_theta_road;
    const double l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const double l_slot_offset__road_x = cos_theta_road*p->inverse_road_mass;
    const double l_slot_offset__road_y = p->inverse_road_mass*sin_theta_road;
    const double l_foot_x__road_theta = -arm_road_head_y*p->inverse_road_inertia;
    const double l_foot_y__road_theta = arm_road_head_x*p->inverse_road_inertia;
    const double w_slot_offset__road_theta = -arm_axle_head_x*sin_theta_road + arm_axle_head_y*cos_theta_road
        + axle_x*sin_theta_road - axle_y*cos_theta_road + cos_theta_road*road_y - road_x*sin_theta_road;
    const double l_slot_offset__road_theta = p->inverse_road_inertia*w_slot_offset__road_theta;
    const double scale_foot_x = -arm_road_head_y*l_foot_x__road_theta + p->inverse_road_mass;
    const double scale_foot_y = arm_road_head_x*l_foot_y__road_theta + p->inverse_road_mass;
    const double pivot_foot_x__foot_y = -arm_road_head_y*l_foot_y__road_theta;
    const double determinant_foot_x__foot_y = -(pivot_foot_x__foot_y * pivot_foot_x__foot_y)
        + scale_foot_x*scale_foot_y;
    if (!(scale_foot_x > 0.0 && scale_foot_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_foot_x__foot_y > memory->least * scale_foot_y * scale_foot_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_foot_x__foot_y = -1.0/determinant_foot_x__foot_y;
    const double inverse_pivot_foot_x = inverse_foot_x__foot_y*scale_foot_y;
    const double inverse_pivot_foot_y = inverse_foot_x__foot_y*scale_foot_x;
    const double inverse_cross_foot_x__foot_y = -inverse_foot_x__foot_y*pivot_foot_x__foot_y;
    const double w_slot_offset__foot_x = arm_road_head_y*l_slot_offset__road_theta + l_slot_offset__road_x;
    const double w_slot_offset__foot_y = -arm_road_head_x*l_slot_offset__road_theta + l_slot_offset__road_y;
    const double l_slot_offset__foot_x = inverse_cross_foot_x__foot_y*w_slot_offset__foot_y
        + inverse_pivot_foot_x*w_slot_offset__foot_x;
    const double l_slot_offset__foot_y = inverse_cross_foot_x__foot_y*w_slot_offset__foot_x
        + inverse_pivot_foot_y*w_slot_offset__foot_y;
    const double w_bump__foot_x = arm_road_head_y*p->inverse_road_inertia;
    const double w_bump__foot_y = -arm_road_head_x*p->inverse_road_inertia;
    const double l_bump__foot_x = inverse_cross_foot_x__foot_y*w_bump__foot_y + inverse_pivot_foot_x*w_bump__foot_x;
    const double l_bump__foot_y = inverse_cross_foot_x__foot_y*w_bump__foot_x + inverse_pivot_foot_y*w_bump__foot_y;
    const double scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x + cos_theta_road*l_slot_offset__road_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road
        + l_slot_offset__road_theta*w_slot_offset__road_theta + l_slot_offset__road_y*sin_theta_road;
    const double scale_bump = p->inverse_road_inertia;
    const double pivot_slot_offset = l_slot_offset__foot_x*w_slot_offset__foot_x
        + l_slot_offset__foot_y*w_slot_offset__foot_y + scale_slot_offset;
    const double pivot_bump = l_bump__foot_x*w_bump__foot_x + l_bump__foot_y*w_bump__foot_y + scale_bump;
    const double pivot_slot_offset__bump = p->inverse_road_inertia*w_slot_offset__road_theta
        + l_bump__foot_x*w_slot_offset__foot_x + l_bump__foot_y*w_slot_offset__foot_y;
    const double determinant_slot_offset__bump = pivot_bump*pivot_slot_offset
        - (pivot_slot_offset__bump * pivot_slot_offset__bump);
    if (!(pivot_slot_offset > memory->least * scale_slot_offset)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_slot_offset__bump > memory->least * scale_bump * pivot_slot_offset)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_slot_offset__bump = -1.0/determinant_slot_offset__bump;
    const double inverse_pivot_slot_offset = inverse_slot_offset__bump*pivot_bump;
    const double inverse_pivot_bump = inverse_slot_offset__bump*pivot_slot_offset;
    const double inverse_cross_slot_offset__bump = -inverse_slot_offset__bump*pivot_slot_offset__bump;

    /* forward substitution */
    const double z_axle_x = -left_pull*left_span_x - right_pull*right_span_x;
    const double z_axle_y = -left_pull*left_span_y - right_pull*right_span_y + p->weight_axle_y;
    const double z_axle_theta = arm_axle_head_x*left_pull*left_span_y - arm_axle_head_x*right_pull*right_span_y
        - arm_axle_head_y*left_pull*left_span_x + arm_axle_head_y*right_pull*right_span_x;
    const double z_road_x = right_pull*right_span_x;
    const double z_road_y = right_pull*right_span_y + p->weight_road_y;
    const double z_road_theta = arm_road_head_x*right_pull*right_span_y - arm_road_head_y*right_pull*right_span_x;
    const double z_foot_x = p->inverse_road_mass*z_road_x - l_foot_x__road_theta*z_road_theta + rhs_foot_x;
    const double z_foot_y = p->inverse_road_mass*z_road_y - l_foot_y__road_theta*z_road_theta + rhs_foot_y;
    const double z_slot_offset = -l_slot_offset__axle_theta*z_axle_theta - l_slot_offset__axle_x*z_axle_x
        - l_slot_offset__axle_y*z_axle_y - l_slot_offset__foot_x*z_foot_x - l_slot_offset__foot_y*z_foot_y
        - l_slot_offset__road_theta*z_road_theta - l_slot_offset__road_x*z_road_x - l_slot_offset__road_y*z_road_y
        + rhs_slot_offset;
    const double z_bump = -p->inverse_road_inertia*z_road_theta - l_bump__foot_x*z_foot_x - l_bump__foot_y*z_foot_y
        + rhs_bump;

    /* backward substitution */
    const double lambda_bump = inverse_cross_slot_offset__bump*z_slot_offset + inverse_pivot_bump*z_bump;
    const double lambda_slot_offset = inverse_cross_slot_offset__bump*z_bump + inverse_pivot_slot_offset*z_slot_offset;
    const double lambda_foot_y = inverse_cross_foot_x__foot_y*z_foot_x + inverse_pivot_foot_y*z_foot_y
        - l_bump__foot_y*lambda_bump - l_slot_offset__foot_y*lambda_slot_offset;
    const double lambda_foot_x = inverse_cross_foot_x__foot_y*z_foot_y + inverse_pivot_foot_x*z_foot_x
        - l_bump__foot_x*lambda_bump - l_slot_offset__foot_x*lambda_slot_offset;
    const double acceleration_road_theta = -p->inverse_road_inertia*lambda_bump + p->inverse_road_inertia*z_road_theta
        - l_foot_x__road_theta*lambda_foot_x - l_foot_y__road_theta*lambda_foot_y
        - l_slot_offset__road_theta*lambda_slot_offset;
    const double acceleration_road_y = p->inverse_road_mass*lambda_foot_y + p->inverse_road_mass*z_road_y
        - l_slot_offset__road_y*lambda_slot_offset;
    const double acceleration_road_x = p->inverse_road_mass*lambda_foot_x + p->inverse_road_mass*z_road_x
        - l_slot_offset__road_x*lambda_slot_offset;
    const double acceleration_axle_theta = p->inverse_axle_inertia*z_axle_theta
        - l_slot_offset__axle_theta*lambda_slot_offset;
    const double acceleration_axle_y = p->inverse_axle_mass*z_axle_y - l_slot_offset__axle_y*lambda_slot_offset;
    const double acceleration_axle_x = p->inverse_axle_mass*z_axle_x - l_slot_offset__axle_x*lambda_slot_offset;

    /* results */
    a[0] = acceleration_axle_x;
    a[1] = acceleration_axle_y;
    a[2] = acceleration_axle_theta;
    a[3] = acceleration_road_x;
    a[4] = acceleration_road_y;
    a[5] = acceleration_road_theta;
    aside->lambda[0] = lambda_foot_x;
    aside->lambda[1] = lambda_foot_y;
    aside->lambda[2] = lambda_slot_offset;
    aside->lambda[3] = lambda_bump;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = -left_pull*left_span_x - right_pull*right_span_x;
        force[1] = -left_pull*left_span_y - right_pull*right_span_y + p->weight_axle_y;
        force[2] = arm_axle_head_x*left_pull*left_span_y - arm_axle_head_x*right_pull*right_span_y
            - arm_axle_head_y*left_pull*left_span_x + arm_axle_head_y*right_pull*right_span_x;
        force[3] = right_pull*right_span_x;
        force[4] = right_pull*right_span_y + p->weight_road_y;
        force[5] = arm_road_head_x*right_pull*right_span_y - arm_road_head_y*right_pull*right_span_x;
        rhs[0] = rhs_foot_x;
        rhs[1] = rhs_foot_y;
        rhs[2] = rhs_slot_offset;
        rhs[3] = rhs_bump;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = -aside->lambda[3]*bump_rate;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
