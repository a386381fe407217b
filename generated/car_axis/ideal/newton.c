/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];
    const double a_axle_x = a[0];
    const double a_axle_y = a[1];
    const double a_axle_theta = a[2];
    const double held_lambda_slot_offset = aside->lambda[0];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double bump_acceleration = -(p->omega * p->omega)*p->par_r*sin(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*sin(p->omega*t)*(cos(p->omega*t)
        * cos(p->omega*t))/((p->length * p->length * p->length)*pow(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length), 1.5));
    const double cos_theta_road = cos(bump_value);
    const double sin_theta_road = sin(bump_value);
    const double cos_theta_axle = cos(axle_theta);
    const double sin_theta_axle = sin(axle_theta);
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;
    const double axle_tail_x = axle_x + span_axle_tail_x;
    const double axle_tail_y = axle_y + span_axle_tail_y;
    const double left_length = sqrt((axle_tail_x * axle_tail_x) + (axle_tail_y * axle_tail_y));
    const double left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const double left_pull = left_force/left_length;
    const double span_road_head_x = cos_theta_road*p->road_head_span_x;
    const double span_road_head_y = p->road_head_span_x*sin_theta_road;
    const double axle_head_x = axle_x - span_axle_tail_x;
    const double axle_head_y = axle_y - span_axle_tail_y;
    const double right_span_x = axle_head_x - span_road_head_x;
    const double right_span_y = axle_head_y - span_road_head_y;
    const double right_length = sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const double right_force = p->right_stiffness*(-p->right_free_length + right_length);
    const double right_pull = right_force/right_length;

    /* constraints */
    const double inverse_length = 1.0/p->length;
    const double bump_acceleration_by_time = 3.0*pow(inverse_length,
        5.0)*(p->omega * p->omega * p->omega)*pow(p->par_r, 5.0)*(sin(p->omega*t) * sin(p->omega*t))*(cos(p->omega*t)
        * cos(p->omega*t) * cos(p->omega*t))/pow(-(inverse_length * inverse_length)*(p->par_r
        * p->par_r)*(sin(p->omega*t) * sin(p->omega*t)) + 1.0, 2.5)
        - 3.0*(inverse_length * inverse_length * inverse_length)*(p->omega * p->omega * p->omega)*(p->par_r * p->par_r
        * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))*cos(p->omega*t)/pow(-(inverse_length
        * inverse_length)*(p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t)) + 1.0, 1.5)
        + (inverse_length * inverse_length * inverse_length)*(p->omega * p->omega * p->omega)*(p->par_r * p->par_r
        * p->par_r)*(cos(p->omega*t) * cos(p->omega*t) * cos(p->omega*t))/pow(-(inverse_length
        * inverse_length)*(p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t)) + 1.0, 1.5)
        - inverse_length*(p->omega * p->omega * p->omega)*p->par_r*cos(p->omega*t)/sqrt(-(inverse_length
        * inverse_length)*(p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t)) + 1.0);
    const double cos_theta_road_by_time = -bump_rate*sin_theta_road;
    const double sin_theta_road_by_time = bump_rate*cos_theta_road;

    /* coordinates */
    const double inverse_sum = 1.0/(left_length + 1e-150);
    const double left_length_by_axle_x = axle_tail_x*inverse_sum;
    const double left_length_by_axle_theta = -axle_tail_x*inverse_sum*span_axle_tail_y
        + axle_tail_y*inverse_sum*span_axle_tail_x;
    const double left_length_by_axle_y = axle_tail_y*inverse_sum;
    const double left_force_by_axle_x = left_length_by_axle_x*p->left_stiffness;
    const double left_force_by_axle_theta = left_length_by_axle_theta*p->left_stiffness;
    const double left_force_by_axle_y = left_length_by_axle_y*p->left_stiffness;
    const double inverse_left_length = 1.0/left_length;
    const double left_pull_by_axle_x = -(inverse_left_length * inverse_left_length)*left_force*left_length_by_axle_x
        + inverse_left_length*left_force_by_axle_x;
    const double left_pull_by_axle_theta = -(inverse_left_length
        * inverse_left_length)*left_force*left_length_by_axle_theta + inverse_left_length*left_force_by_axle_theta;
    const double left_pull_by_axle_y = -(inverse_left_length * inverse_left_length)*left_force*left_length_by_axle_y
        + inverse_left_length*left_force_by_axle_y;
    const double span_road_head_x_by_time = -bump_rate*span_road_head_y;
    const double span_road_head_y_by_time = bump_rate*span_road_head_x;
    const double inverse_sum_2 = 1.0/(right_length + 1e-150);
    const double right_length_by_axle_x = inverse_sum_2*right_span_x;
    const double right_length_by_axle_theta = inverse_sum_2*right_span_x*span_axle_tail_y
        - inverse_sum_2*right_span_y*span_axle_tail_x;
    const double right_length_by_time = -inverse_sum_2*right_span_x*span_road_head_x_by_time
        - inverse_sum_2*right_span_y*span_road_head_y_by_time;
    const double right_length_by_axle_y = inverse_sum_2*right_span_y;
    const double right_force_by_axle_x = right_length_by_axle_x*p->right_stiffness;
    const double right_force_by_axle_theta = right_length_by_axle_theta*p->right_stiffness;
    const double right_force_by_time = right_length_by_time*p->right_stiffness;
    const double right_force_by_axle_y = right_length_by_axle_y*p->right_stiffness;
    const double inverse_right_length = 1.0/right_length;
    const double right_pull_by_axle_x = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_x + inverse_right_length*right_force_by_axle_x;
    const double right_pull_by_axle_theta = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_theta + inverse_right_length*right_force_by_axle_theta;
    const double right_pull_by_time = -(inverse_right_length * inverse_right_length)*right_force*right_length_by_time
        + inverse_right_length*right_force_by_time;
    const double right_pull_by_axle_y = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_y + inverse_right_length*right_force_by_axle_y;

    /* results */
    lin->value[0] = -cos_theta_road;
    lin->value[1] = -sin_theta_road;
    lin->value[2] = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    lin->value[3] = bump_acceleration*sin_theta_road + (bump_rate * bump_rate)*cos_theta_road
        + bump_rate*sin_theta_road*p->two_alpha;
    lin->value[4] = -bump_acceleration*cos_theta_road + (bump_rate * bump_rate)*sin_theta_road
        - bump_rate*cos_theta_road*p->two_alpha;
    lin->value[5] = span_axle_tail_x*(a_axle_theta*cos_theta_road + (axle_omega * axle_omega)*sin_theta_road
        - 2.0*axle_omega*bump_rate*sin_theta_road - bump_acceleration*cos_theta_road
        + (bump_rate * bump_rate)*sin_theta_road) - span_axle_tail_y*(-a_axle_theta*sin_theta_road
        + (axle_omega * axle_omega)*cos_theta_road - 2.0*axle_omega*bump_rate*cos_theta_road
        + bump_acceleration*sin_theta_road + (bump_rate * bump_rate)*cos_theta_road)
        + p->two_alpha*(span_axle_tail_x*(axle_omega*cos_theta_road - bump_rate*cos_theta_road)
        - span_axle_tail_y*(-axle_omega*sin_theta_road + bump_rate*sin_theta_road));
    lin->value[6] = axle_tail_x*left_pull_by_axle_x + left_pull + right_pull + right_pull_by_axle_x*right_span_x;
    lin->value[7] = axle_tail_x*left_pull_by_axle_theta - left_pull*span_axle_tail_y + right_pull*span_axle_tail_y
        + right_pull_by_axle_theta*right_span_x;
    lin->value[8] = axle_tail_x*left_pull_by_axle_y + right_pull_by_axle_y*right_span_x;
    lin->value[9] = axle_tail_y*left_pull_by_axle_y + left_pull + right_pull + right_pull_by_axle_y*right_span_y;
    lin->value[10] = axle_tail_y*left_pull_by_axle_theta + left_pull*span_axle_tail_x - right_pull*span_axle_tail_x
        + right_pull_by_axle_theta*right_span_y;
    lin->value[11] = axle_tail_y*left_pull_by_axle_x + right_pull_by_axle_x*right_span_y;
    lin->value[12] = -left_pull*span_axle_tail_y + left_pull_by_axle_x*(-axle_tail_x*span_axle_tail_y
        + axle_tail_y*span_axle_tail_x) + right_pull*span_axle_tail_y
        + right_pull_by_axle_x*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[13] = left_pull*(span_axle_tail_x * span_axle_tail_x) + left_pull*(span_axle_tail_y * span_axle_tail_y)
        + left_pull_by_axle_theta*(-axle_tail_x*span_axle_tail_y + axle_tail_y*span_axle_tail_x)
        + right_pull*(span_axle_tail_x * span_axle_tail_x) + right_pull*(span_axle_tail_y * span_axle_tail_y)
        + right_pull_by_axle_theta*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x)
        + span_axle_tail_x*(-axle_tail_x*left_pull + cos_theta_road*held_lambda_slot_offset + right_pull*right_span_x)
        - span_axle_tail_y*(axle_tail_y*left_pull - held_lambda_slot_offset*sin_theta_road - right_pull*right_span_y);
    lin->value[14] = left_pull*span_axle_tail_x + left_pull_by_axle_y*(-axle_tail_x*span_axle_tail_y
        + axle_tail_y*span_axle_tail_x) - right_pull*span_axle_tail_x
        + right_pull_by_axle_y*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[15] = axle_omega*cos_theta_road*span_axle_tail_x + axle_omega*sin_theta_road*span_axle_tail_y
        + axle_omega*(cos_theta_road*span_axle_tail_x + sin_theta_road*span_axle_tail_y)
        - 2.0*bump_rate*cos_theta_road*span_axle_tail_x - 2.0*bump_rate*sin_theta_road*span_axle_tail_y;
    lin->value[16] = 2.0*bump_rate*sin_theta_road;
    lin->value[17] = -2.0*bump_rate*cos_theta_road;
    lin->value[18] = p->beta_squared*(cos_theta_road_by_time*(-axle_x - span_axle_tail_x)
        + sin_theta_road_by_time*(-axle_y - span_axle_tail_y))
        + bump_acceleration*(-2.0*bump_rate*cos_theta_road*(-axle_x - span_axle_tail_x)
        - 2.0*bump_rate*sin_theta_road*(-axle_y - span_axle_tail_y)
        + 2.0*cos_theta_road*(-axle_omega*span_axle_tail_x - axle_y_rate)
        - 2.0*sin_theta_road*(axle_omega*span_axle_tail_y - axle_x_rate))
        + bump_acceleration_by_time*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + cos_theta_road_by_time*(a_axle_theta*span_axle_tail_y
        - a_axle_x + (axle_omega * axle_omega)*span_axle_tail_x + bump_acceleration*(-axle_y - span_axle_tail_y)
        - (bump_rate * bump_rate)*(-axle_x - span_axle_tail_x)
        + 2.0*bump_rate*(-axle_omega*span_axle_tail_x - axle_y_rate))
        + sin_theta_road_by_time*(-a_axle_theta*span_axle_tail_x - a_axle_y
        + (axle_omega * axle_omega)*span_axle_tail_y + bump_acceleration*(axle_x + span_axle_tail_x)
        - (bump_rate * bump_rate)*(-axle_y - span_axle_tail_y)
        - 2.0*bump_rate*(axle_omega*span_axle_tail_y - axle_x_rate))
        + p->two_alpha*(bump_acceleration*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + cos_theta_road_by_time*(axle_omega*span_axle_tail_y
        - axle_x_rate + bump_rate*(-axle_y - span_axle_tail_y))
        + sin_theta_road_by_time*(-axle_omega*span_axle_tail_x - axle_y_rate - bump_rate*(-axle_x - span_axle_tail_x)));
    lin->value[19] = -cos_theta_road_by_time*held_lambda_slot_offset - right_pull*span_road_head_x_by_time
        + right_pull_by_time*right_span_x;
    lin->value[20] = -held_lambda_slot_offset*sin_theta_road_by_time - right_pull*span_road_head_y_by_time
        + right_pull_by_time*right_span_y;
    lin->value[21] = cos_theta_road_by_time*held_lambda_slot_offset*span_axle_tail_y
        - held_lambda_slot_offset*sin_theta_road_by_time*span_axle_tail_x
        + right_pull*span_axle_tail_x*span_road_head_y_by_time - right_pull*span_axle_tail_y*span_road_head_x_by_time
        + right_pull_by_time*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[22] = bump_rate*held_lambda_slot_offset*sin_theta_road + bump_rate*right_pull*span_road_head_y
        + bump_rate*right_pull_by_axle_x*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[23] = -bump_rate*cos_theta_road*held_lambda_slot_offset - bump_rate*right_pull*span_road_head_x
        + bump_rate*right_pull_by_axle_y*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[24] = -bump_rate*cos_theta_road*held_lambda_slot_offset*span_axle_tail_x
        - bump_rate*held_lambda_slot_offset*sin_theta_road*span_axle_tail_y
        + bump_rate*right_pull*span_axle_tail_x*span_road_head_x
        + bump_rate*right_pull*span_axle_tail_y*span_road_head_y
        + bump_rate*right_pull_by_axle_theta*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[25] = bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y)
        - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);
    lin->value[26] = bump_acceleration*(bump_acceleration*p->mass_bump_bump - cos_theta_road*p->weight_road__across
        - held_lambda_slot_offset*(-cos_theta_road*(-axle_y - span_axle_tail_y)
        + sin_theta_road*(-axle_x - span_axle_tail_x)) + right_pull*right_span_x*span_road_head_y
        - right_pull*right_span_y*span_road_head_x) + bump_acceleration_by_time*bump_rate*p->mass_bump_bump
        - bump_rate*held_lambda_slot_offset*sin_theta_road_by_time*(-axle_x - span_axle_tail_x)
        + bump_rate*right_pull*right_span_x*span_road_head_y_by_time
        - bump_rate*right_pull*right_span_y*span_road_head_x_by_time
        + bump_rate*right_pull*span_road_head_x*span_road_head_y_by_time
        - bump_rate*right_pull*span_road_head_x_by_time*span_road_head_y
        + bump_rate*right_pull_by_time*(right_span_x*span_road_head_y - right_span_y*span_road_head_x)
        + cos_theta_road_by_time*(bump_rate*held_lambda_slot_offset*(-axle_y - span_axle_tail_y)
        - bump_rate*p->weight_road__across);
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
int newton_factor(double eta, Linear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double by_v_slot_offset_axle_theta = lin->value[15];
    const double by_v_slot_offset_axle_x = lin->value[16];
    const double by_v_slot_offset_axle_y = lin->value[17];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_axle_x__axle_x = p->axle_mass + by_q_axle_x_axle_x*(eta * eta);
    const double n_axle_x__axle_y = by_q_axle_x_axle_y*(eta * eta);
    const double n_axle_x__axle_theta = by_q_axle_x_axle_theta*(eta * eta);
    const double n_axle_y__axle_x = by_q_axle_y_axle_x*(eta * eta);
    const double n_axle_y__axle_y = p->axle_mass + by_q_axle_y_axle_y*(eta * eta);
    const double n_axle_y__axle_theta = by_q_axle_y_axle_theta*(eta * eta);
    const double n_axle_theta__axle_x = by_q_axle_theta_axle_x*(eta * eta);
    const double n_axle_theta__axle_y = by_q_axle_theta_axle_y*(eta * eta);
    const double n_axle_theta__axle_theta = p->axle_inertia + by_q_axle_theta_axle_theta*(eta * eta);
    const double n_slot_offset__axle_x = eta_row*(by_q_slot_offset_axle_x*eta + by_v_slot_offset_axle_x)
        + phi_slot_offset_axle_x;
    const double n_slot_offset__axle_y = eta_row*(by_q_slot_offset_axle_y*eta + by_v_slot_offset_axle_y)
        + phi_slot_offset_axle_y;
    const double n_slot_offset__axle_theta = eta_row*(by_q_slot_offset_axle_theta*eta + by_v_slot_offset_axle_theta)
        + phi_slot_offset_axle_theta;

    /* L U */
    const double scale_axle_x = n_axle_x__axle_x;
    if (!(fabs(scale_axle_x) > SINGULAR * fabs(n_axle_x__axle_x)))
        return 1;
    const double inverse_pivot_axle_x = 1.0/scale_axle_x;
    lin->lu[0] = inverse_pivot_axle_x;
    const double l_axle_y__axle_x = inverse_pivot_axle_x*n_axle_y__axle_x;
    lin->lu[1] = l_axle_y__axle_x;
    lin->lu[2] = n_axle_x__axle_y;
    const double l_axle_theta__axle_x = inverse_pivot_axle_x*n_axle_theta__axle_x;
    lin->lu[3] = l_axle_theta__axle_x;
    lin->lu[4] = n_axle_x__axle_theta;
    const double l_slot_offset__axle_x = inverse_pivot_axle_x*n_slot_offset__axle_x;
    lin->lu[5] = l_slot_offset__axle_x;
    const double scale_axle_y = -l_axle_y__axle_x*n_axle_x__axle_y + n_axle_y__axle_y;
    if (!(fabs(scale_axle_y) > SINGULAR * fabs(n_axle_y__axle_y)))
        return 2;
    const double inverse_pivot_axle_y = 1.0/scale_axle_y;
    lin->lu[6] = inverse_pivot_axle_y;
    const double l_axle_theta__axle_y = inverse_pivot_axle_y*(-l_axle_theta__axle_x*n_axle_x__axle_y
        + n_axle_theta__axle_y);
    lin->lu[7] = l_axle_theta__axle_y;
    const double u_axle_y__axle_theta = -l_axle_y__axle_x*n_axle_x__axle_theta + n_axle_y__axle_theta;
    lin->lu[8] = u_axle_y__axle_theta;
    const double l_slot_offset__axle_y = inverse_pivot_axle_y*(-l_slot_offset__axle_x*n_axle_x__axle_y
        + n_slot_offset__axle_y);
    lin->lu[9] = l_slot_offset__axle_y;
    const double u_axle_y__slot_offset = -l_axle_y__axle_x*phi_slot_offset_axle_x + phi_slot_offset_axle_y;
    lin->lu[10] = u_axle_y__slot_offset;
    const double scale_axle_theta = -l_axle_theta__axle_x*n_axle_x__axle_theta
        - l_axle_theta__axle_y*u_axle_y__axle_theta + n_axle_theta__axle_theta;
    if (!(fabs(scale_axle_theta) > SINGULAR * fabs(n_axle_theta__axle_theta)))
        return 3;
    const double inverse_pivot_axle_theta = 1.0/scale_axle_theta;
    lin->lu[11] = inverse_pivot_axle_theta;
    const double l_slot_offset__axle_theta = inverse_pivot_axle_theta*(-l_slot_offset__axle_x*n_axle_x__axle_theta
        - l_slot_offset__axle_y*u_axle_y__axle_theta + n_slot_offset__axle_theta);
    lin->lu[12] = l_slot_offset__axle_theta;
    const double u_axle_theta__slot_offset = -l_axle_theta__axle_x*phi_slot_offset_axle_x
        - l_axle_theta__axle_y*u_axle_y__slot_offset + phi_slot_offset_axle_theta;
    lin->lu[13] = u_axle_theta__slot_offset;
    const double scale_slot_offset = -l_slot_offset__axle_theta*u_axle_theta__slot_offset
        - l_slot_offset__axle_x*phi_slot_offset_axle_x - l_slot_offset__axle_y*u_axle_y__slot_offset;
    if (!(scale_slot_offset != 0.0 && isfinite(scale_slot_offset)))
        return 4;
    const double inverse_pivot_slot_offset = 1.0/scale_slot_offset;
    lin->lu[14] = inverse_pivot_slot_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double inverse_pivot_axle_x = lin->lu[0];
    const double l_axle_y__axle_x = lin->lu[1];
    const double n_axle_x__axle_y = lin->lu[2];
    const double l_axle_theta__axle_x = lin->lu[3];
    const double n_axle_x__axle_theta = lin->lu[4];
    const double l_slot_offset__axle_x = lin->lu[5];
    const double inverse_pivot_axle_y = lin->lu[6];
    const double l_axle_theta__axle_y = lin->lu[7];
    const double u_axle_y__axle_theta = lin->lu[8];
    const double l_slot_offset__axle_y = lin->lu[9];
    const double u_axle_y__slot_offset = lin->lu[10];
    const double inverse_pivot_axle_theta = lin->lu[11];
    const double l_slot_offset__axle_theta = lin->lu[12];
    const double u_axle_theta__slot_offset = lin->lu[13];
    const double inverse_pivot_slot_offset = lin->lu[14];

    /* forward */
    const double b_axle_x = x[0];
    const double b_axle_y = -b_axle_x*l_axle_y__axle_x + x[1];
    const double b_axle_theta = -b_axle_x*l_axle_theta__axle_x - b_axle_y*l_axle_theta__axle_y + x[2];
    const double b_slot_offset = -b_axle_theta*l_slot_offset__axle_theta - b_axle_x*l_slot_offset__axle_x
        - b_axle_y*l_slot_offset__axle_y + x[3];

    /* backward */
    const double x_slot_offset = b_slot_offset*inverse_pivot_slot_offset;
    x[3] = x_slot_offset;
    const double x_axle_theta = inverse_pivot_axle_theta*(b_axle_theta - u_axle_theta__slot_offset*x_slot_offset);
    x[2] = x_axle_theta;
    const double x_axle_y = inverse_pivot_axle_y*(b_axle_y - u_axle_y__axle_theta*x_axle_theta
        - u_axle_y__slot_offset*x_slot_offset);
    x[1] = x_axle_y;
    const double x_axle_x = inverse_pivot_axle_x*(b_axle_x - n_axle_x__axle_theta*x_axle_theta
        - n_axle_x__axle_y*x_axle_y - phi_slot_offset_axle_x*x_slot_offset);
    x[0] = x_axle_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_slot_offset_axle_x = lin->value[0];
    const double phi_slot_offset_axle_y = lin->value[1];
    const double phi_slot_offset_axle_theta = lin->value[2];
    const double by_q_slot_offset_axle_x = lin->value[3];
    const double by_q_slot_offset_axle_y = lin->value[4];
    const double by_q_slot_offset_axle_theta = lin->value[5];
    const double by_q_axle_x_axle_x = lin->value[6];
    const double by_q_axle_x_axle_theta = lin->value[7];
    const double by_q_axle_x_axle_y = lin->value[8];
    const double by_q_axle_y_axle_y = lin->value[9];
    const double by_q_axle_y_axle_theta = lin->value[10];
    const double by_q_axle_y_axle_x = lin->value[11];
    const double by_q_axle_theta_axle_x = lin->value[12];
    const double by_q_axle_theta_axle_theta = lin->value[13];
    const double by_q_axle_theta_axle_y = lin->value[14];
    const double by_t_slot_offset = lin->value[18];
    const double by_t_axle_x = lin->value[19];
    const double by_t_axle_y = lin->value[20];
    const double by_t_axle_theta = lin->value[21];
    const double power_q_0_axle_x = lin->value[22];
    const double power_q_0_axle_y = lin->value[23];
    const double power_q_0_axle_theta = lin->value[24];
    const double power_0_slot_offset = lin->value[25];
    const double power_t_0 = lin->value[26];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[4];
    const double shifted_axle_x = -p->beta_squared*eta*r[0] + r[3];
    const double shifted_axle_y = -p->beta_squared*eta*r[1] + r[4];
    const double shifted_axle_theta = -p->beta_squared*eta*r[2] + r[5];
    x[0] = eta*(p->axle_mass*r[3] - by_q_axle_x_axle_theta*eta*r[2] - by_q_axle_x_axle_x*eta*r[0]
        - by_q_axle_x_axle_y*eta*r[1] - by_t_axle_x*s);
    x[1] = eta*(p->axle_mass*r[4] - by_q_axle_y_axle_theta*eta*r[2] - by_q_axle_y_axle_x*eta*r[0]
        - by_q_axle_y_axle_y*eta*r[1] - by_t_axle_y*s);
    x[2] = eta*(p->axle_inertia*r[5] - by_q_axle_theta_axle_theta*eta*r[2] - by_q_axle_theta_axle_x*eta*r[0]
        - by_q_axle_theta_axle_y*eta*r[1] - by_t_axle_theta*s);
    x[3] = eta_row*(-by_q_slot_offset_axle_theta*eta*r[2] - by_q_slot_offset_axle_x*eta*r[0]
        - by_q_slot_offset_axle_y*eta*r[1] - by_t_slot_offset*s + phi_slot_offset_axle_theta*shifted_axle_theta
        + phi_slot_offset_axle_x*shifted_axle_x + phi_slot_offset_axle_y*shifted_axle_y);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*(power_q_0_axle_theta*u[2] + power_q_0_axle_x*u[0] + power_q_0_axle_y*u[1] + power_t_0*s + r[6])
        + power_0_slot_offset*x[3];
    u[7] = eta*r[7];
    u[8] = eta*r[8];
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {3, 0, 0, 1}, {3, 1, 1, 1}, {3, 2, 2, 1}
};
static const LinearEntry residual_entries[] = {
    {3, 0, 3, 1}, {3, 1, 4, 1}, {3, 2, 5, 1}, {0, 0, 6, 1}, {0, 2, 7, 1}, {0, 1, 8, 1}, {1, 1, 9, 1},
    {1, 2, 10, 1}, {1, 0, 11, 1}, {2, 0, 12, 1}, {2, 2, 13, 1}, {2, 1, 14, 1}, {3, 5, 15, 1}, {3, 3, 16, 1},
    {3, 4, 17, 1}
};
static const LinearEntry residual_t_entries[] = {
    {3, 0, 18, 1}, {0, 0, 19, 1}, {1, 0, 20, 1}, {2, 0, 21, 1}
};
static const LinearEntry power_entries[] = {
    {0, 0, 22, 1}, {0, 1, 23, 1}, {0, 2, 24, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 3, 25, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 26, 1}
};
enum {
    N_PHI_Q = 3,
    N_RESIDUAL = 15,
    N_RESIDUAL_T = 4,
    N_POWER = 3,
    N_POWER_ROW = 1,
    N_POWER_T = 1,
    N_NODES = 4,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double axle_x = q[0];
    const double axle_x_rate = v[0];
    const double axle_y = q[1];
    const double axle_y_rate = v[1];
    const double axle_theta = q[2];
    const double axle_omega = v[2];

    /* directions, arms, drives */
    const double bump_value = asin(p->par_r*sin(p->omega*t)/p->length);
    const Four angles_0 = {bump_value, axle_theta, axle_theta, axle_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road = cosines_0[0];
    const double sin_theta_road = sines_0[0];
    const double cos_theta_axle = cosines_0[1];
    const double sin_theta_axle = sines_0[1];
    const double bump_rate = p->omega*p->par_r*cos(p->omega*t)/(p->length*sqrt(1.0
        - (p->par_r * p->par_r)*(sin(p->omega*t) * sin(p->omega*t))/(p->length * p->length)));
    const double span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const double span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* Phi and Phi_dot */
    const double phi_slot_offset = -axle_x*cos_theta_road - axle_y*sin_theta_road - cos_theta_road*span_axle_tail_x
        - sin_theta_road*span_axle_tail_y;
    const double phi_dot_slot_offset = axle_omega*(cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x)
        - axle_x_rate*cos_theta_road - axle_y_rate*sin_theta_road
        + bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y) - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);

    /* L D L^T of the KKT matrix */
    const double l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const double l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const double w_slot_offset__axle_theta = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    const double l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const double scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road;
    if (!(scale_slot_offset > 0.0 && scale_slot_offset < INFINITY))
        return 1;
    const double inverse_pivot_slot_offset = 1.0/scale_slot_offset;

    /* backward substitution */
    const double dq_lambda_slot_offset = -inverse_pivot_slot_offset*phi_slot_offset;
    const double dq_acceleration_axle_theta = -dq_lambda_slot_offset*l_slot_offset__axle_theta;
    const double dq_acceleration_axle_y = -dq_lambda_slot_offset*l_slot_offset__axle_y;
    const double dq_acceleration_axle_x = -dq_lambda_slot_offset*l_slot_offset__axle_x;

    /* backward substitution */
    const double dv_lambda_slot_offset = -inverse_pivot_slot_offset*phi_dot_slot_offset;
    const double dv_acceleration_axle_theta = -dv_lambda_slot_offset*l_slot_offset__axle_theta;
    const double dv_acceleration_axle_y = -dv_lambda_slot_offset*l_slot_offset__axle_y;
    const double dv_acceleration_axle_x = -dv_lambda_slot_offset*l_slot_offset__axle_x;

    /* results */
    dq[0] = dq_acceleration_axle_x;
    dv[0] = dv_acceleration_axle_x;
    dq[1] = dq_acceleration_axle_y;
    dv[1] = dv_acceleration_axle_y;
    dq[2] = dq_acceleration_axle_theta;
    dv[2] = dv_acceleration_axle_theta;
    *worst = max_of(0.0, fabs(phi_slot_offset));
    return 0;
}
