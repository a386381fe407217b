/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double axle_x_ = q[0];
    const double axle_x_rate_ = v[0];
    const double axle_y_ = q[1];
    const double axle_y_rate_ = v[1];
    const double axle_theta_ = q[2];
    const double axle_omega_ = v[2];
    const double a_axle_x_ = a[0];
    const double a_axle_y_ = a[1];
    const double a_axle_theta_ = a[2];
    const double held_lambda_slot_offset_ = aside->lambda[0];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*sin(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*sin(p->omega_*t)*(cos(p->omega_*t)
        * cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*pow(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_), 1.5));
    const double cos_theta_road_ = cos(bump_value_);
    const double sin_theta_road_ = sin(bump_value_);
    const double cos_theta_axle_ = cos(axle_theta_);
    const double sin_theta_axle_ = sin(axle_theta_);
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;
    const double axle_tail_x_ = axle_x_ + span_axle_tail_x_;
    const double axle_tail_y_ = axle_y_ + span_axle_tail_y_;
    const double left_length_ = sqrt((axle_tail_x_ * axle_tail_x_) + (axle_tail_y_ * axle_tail_y_));
    const double left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const double left_pull_ = left_force_/left_length_;
    const double span_road_head_x_ = cos_theta_road_*p->road_head_span_x_;
    const double span_road_head_y_ = p->road_head_span_x_*sin_theta_road_;
    const double axle_head_x_ = axle_x_ - span_axle_tail_x_;
    const double axle_head_y_ = axle_y_ - span_axle_tail_y_;
    const double right_span_x_ = axle_head_x_ - span_road_head_x_;
    const double right_span_y_ = axle_head_y_ - span_road_head_y_;
    const double right_length_ = sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const double right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);
    const double right_pull_ = right_force_/right_length_;

    /* constraints */
    const double inverse_length_ = 1.0/p->length_;
    const double bump_acceleration_by_time_ = 3.0*pow(inverse_length_,
        5.0)*(p->omega_ * p->omega_ * p->omega_)*pow(p->r_, 5.0)*(sin(p->omega_*t)
        * sin(p->omega_*t))*(cos(p->omega_*t) * cos(p->omega_*t)
        * cos(p->omega_*t))/pow(-(inverse_length_ * inverse_length_)*(p->r_ * p->r_)*(sin(p->omega_*t)
        * sin(p->omega_*t)) + 1.0, 2.5) - 3.0*(inverse_length_ * inverse_length_ * inverse_length_)*(p->omega_
        * p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*(sin(p->omega_*t)
        * sin(p->omega_*t))*cos(p->omega_*t)/pow(-(inverse_length_ * inverse_length_)*(p->r_ * p->r_)*(sin(p->omega_*t)
        * sin(p->omega_*t)) + 1.0, 1.5) + (inverse_length_ * inverse_length_ * inverse_length_)*(p->omega_ * p->omega_
        * p->omega_)*(p->r_ * p->r_ * p->r_)*(cos(p->omega_*t) * cos(p->omega_*t)
        * cos(p->omega_*t))/pow(-(inverse_length_ * inverse_length_)*(p->r_ * p->r_)*(sin(p->omega_*t)
        * sin(p->omega_*t)) + 1.0, 1.5) - inverse_length_*(p->omega_ * p->omega_
        * p->omega_)*p->r_*cos(p->omega_*t)/sqrt(-(inverse_length_ * inverse_length_)*(p->r_ * p->r_)*(sin(p->omega_*t)
        * sin(p->omega_*t)) + 1.0);
    const double cos_theta_road_by_time_ = -bump_rate_*sin_theta_road_;
    const double sin_theta_road_by_time_ = bump_rate_*cos_theta_road_;

    /* coordinates */
    const double inverse_sum_ = 1.0/(left_length_ + 1e-150);
    const double left_length_by_axle_x_ = axle_tail_x_*inverse_sum_;
    const double left_length_by_axle_theta_ = -axle_tail_x_*inverse_sum_*span_axle_tail_y_
        + axle_tail_y_*inverse_sum_*span_axle_tail_x_;
    const double left_length_by_axle_y_ = axle_tail_y_*inverse_sum_;
    const double left_force_by_axle_x_ = left_length_by_axle_x_*p->left_stiffness_;
    const double left_force_by_axle_theta_ = left_length_by_axle_theta_*p->left_stiffness_;
    const double left_force_by_axle_y_ = left_length_by_axle_y_*p->left_stiffness_;
    const double inverse_left_length_ = 1.0/left_length_;
    const double left_pull_by_axle_x_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_x_ + inverse_left_length_*left_force_by_axle_x_;
    const double left_pull_by_axle_theta_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_theta_ + inverse_left_length_*left_force_by_axle_theta_;
    const double left_pull_by_axle_y_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_y_ + inverse_left_length_*left_force_by_axle_y_;
    const double span_road_head_x_by_time_ = -bump_rate_*span_road_head_y_;
    const double span_road_head_y_by_time_ = bump_rate_*span_road_head_x_;
    const double inverse_sum_2_ = 1.0/(right_length_ + 1e-150);
    const double right_length_by_axle_x_ = inverse_sum_2_*right_span_x_;
    const double right_length_by_axle_theta_ = inverse_sum_2_*right_span_x_*span_axle_tail_y_
        - inverse_sum_2_*right_span_y_*span_axle_tail_x_;
    const double right_length_by_time_ = -inverse_sum_2_*right_span_x_*span_road_head_x_by_time_
        - inverse_sum_2_*right_span_y_*span_road_head_y_by_time_;
    const double right_length_by_axle_y_ = inverse_sum_2_*right_span_y_;
    const double right_force_by_axle_x_ = right_length_by_axle_x_*p->right_stiffness_;
    const double right_force_by_axle_theta_ = right_length_by_axle_theta_*p->right_stiffness_;
    const double right_force_by_time_ = right_length_by_time_*p->right_stiffness_;
    const double right_force_by_axle_y_ = right_length_by_axle_y_*p->right_stiffness_;
    const double inverse_right_length_ = 1.0/right_length_;
    const double right_pull_by_axle_x_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_x_ + inverse_right_length_*right_force_by_axle_x_;
    const double right_pull_by_axle_theta_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_theta_
        + inverse_right_length_*right_force_by_axle_theta_;
    const double right_pull_by_time_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_time_ + inverse_right_length_*right_force_by_time_;
    const double right_pull_by_axle_y_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_y_ + inverse_right_length_*right_force_by_axle_y_;

    /* results */
    lin->value[0] = -cos_theta_road_;
    lin->value[1] = -sin_theta_road_;
    lin->value[2] = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    lin->value[3] = bump_acceleration_*sin_theta_road_ + (bump_rate_ * bump_rate_)*cos_theta_road_
        + bump_rate_*sin_theta_road_*p->two_alpha_;
    lin->value[4] = -bump_acceleration_*cos_theta_road_ + (bump_rate_ * bump_rate_)*sin_theta_road_
        - bump_rate_*cos_theta_road_*p->two_alpha_;
    lin->value[5] = span_axle_tail_x_*(a_axle_theta_*cos_theta_road_ + (axle_omega_ * axle_omega_)*sin_theta_road_
        - 2.0*axle_omega_*bump_rate_*sin_theta_road_ - bump_acceleration_*cos_theta_road_
        + (bump_rate_ * bump_rate_)*sin_theta_road_) - span_axle_tail_y_*(-a_axle_theta_*sin_theta_road_
        + (axle_omega_ * axle_omega_)*cos_theta_road_ - 2.0*axle_omega_*bump_rate_*cos_theta_road_
        + bump_acceleration_*sin_theta_road_ + (bump_rate_ * bump_rate_)*cos_theta_road_)
        + p->two_alpha_*(span_axle_tail_x_*(axle_omega_*cos_theta_road_ - bump_rate_*cos_theta_road_)
        - span_axle_tail_y_*(-axle_omega_*sin_theta_road_ + bump_rate_*sin_theta_road_));
    lin->value[6] = axle_tail_x_*left_pull_by_axle_x_ + left_pull_ + right_pull_ + right_pull_by_axle_x_*right_span_x_;
    lin->value[7] = axle_tail_x_*left_pull_by_axle_theta_ - left_pull_*span_axle_tail_y_
        + right_pull_*span_axle_tail_y_ + right_pull_by_axle_theta_*right_span_x_;
    lin->value[8] = axle_tail_x_*left_pull_by_axle_y_ + right_pull_by_axle_y_*right_span_x_;
    lin->value[9] = axle_tail_y_*left_pull_by_axle_y_ + left_pull_ + right_pull_ + right_pull_by_axle_y_*right_span_y_;
    lin->value[10] = axle_tail_y_*left_pull_by_axle_theta_ + left_pull_*span_axle_tail_x_
        - right_pull_*span_axle_tail_x_ + right_pull_by_axle_theta_*right_span_y_;
    lin->value[11] = axle_tail_y_*left_pull_by_axle_x_ + right_pull_by_axle_x_*right_span_y_;
    lin->value[12] = -left_pull_*span_axle_tail_y_ + left_pull_by_axle_x_*(-axle_tail_x_*span_axle_tail_y_
        + axle_tail_y_*span_axle_tail_x_) + right_pull_*span_axle_tail_y_
        + right_pull_by_axle_x_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[13] = left_pull_*(span_axle_tail_x_ * span_axle_tail_x_)
        + left_pull_*(span_axle_tail_y_ * span_axle_tail_y_)
        + left_pull_by_axle_theta_*(-axle_tail_x_*span_axle_tail_y_ + axle_tail_y_*span_axle_tail_x_)
        + right_pull_*(span_axle_tail_x_ * span_axle_tail_x_) + right_pull_*(span_axle_tail_y_ * span_axle_tail_y_)
        + right_pull_by_axle_theta_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_)
        + span_axle_tail_x_*(-axle_tail_x_*left_pull_ + cos_theta_road_*held_lambda_slot_offset_
        + right_pull_*right_span_x_) - span_axle_tail_y_*(axle_tail_y_*left_pull_
        - held_lambda_slot_offset_*sin_theta_road_ - right_pull_*right_span_y_);
    lin->value[14] = left_pull_*span_axle_tail_x_ + left_pull_by_axle_y_*(-axle_tail_x_*span_axle_tail_y_
        + axle_tail_y_*span_axle_tail_x_) - right_pull_*span_axle_tail_x_
        + right_pull_by_axle_y_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[15] = axle_omega_*cos_theta_road_*span_axle_tail_x_ + axle_omega_*sin_theta_road_*span_axle_tail_y_
        + axle_omega_*(cos_theta_road_*span_axle_tail_x_ + sin_theta_road_*span_axle_tail_y_)
        - 2.0*bump_rate_*cos_theta_road_*span_axle_tail_x_ - 2.0*bump_rate_*sin_theta_road_*span_axle_tail_y_;
    lin->value[16] = 2.0*bump_rate_*sin_theta_road_;
    lin->value[17] = -2.0*bump_rate_*cos_theta_road_;
    lin->value[18] = p->beta_squared_*(cos_theta_road_by_time_*(-axle_x_ - span_axle_tail_x_)
        + sin_theta_road_by_time_*(-axle_y_ - span_axle_tail_y_))
        + bump_acceleration_*(-2.0*bump_rate_*cos_theta_road_*(-axle_x_ - span_axle_tail_x_)
        - 2.0*bump_rate_*sin_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + 2.0*cos_theta_road_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_)
        - 2.0*sin_theta_road_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_))
        + bump_acceleration_by_time_*(cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + cos_theta_road_by_time_*(a_axle_theta_*span_axle_tail_y_
        - a_axle_x_ + (axle_omega_ * axle_omega_)*span_axle_tail_x_ + bump_acceleration_*(-axle_y_ - span_axle_tail_y_)
        - (bump_rate_ * bump_rate_)*(-axle_x_ - span_axle_tail_x_)
        + 2.0*bump_rate_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_))
        + sin_theta_road_by_time_*(-a_axle_theta_*span_axle_tail_x_ - a_axle_y_
        + (axle_omega_ * axle_omega_)*span_axle_tail_y_ + bump_acceleration_*(axle_x_ + span_axle_tail_x_)
        - (bump_rate_ * bump_rate_)*(-axle_y_ - span_axle_tail_y_)
        - 2.0*bump_rate_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_))
        + p->two_alpha_*(bump_acceleration_*(cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + cos_theta_road_by_time_*(axle_omega_*span_axle_tail_y_
        - axle_x_rate_ + bump_rate_*(-axle_y_ - span_axle_tail_y_))
        + sin_theta_road_by_time_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_
        - bump_rate_*(-axle_x_ - span_axle_tail_x_)));
    lin->value[19] = -cos_theta_road_by_time_*held_lambda_slot_offset_ - right_pull_*span_road_head_x_by_time_
        + right_pull_by_time_*right_span_x_;
    lin->value[20] = -held_lambda_slot_offset_*sin_theta_road_by_time_ - right_pull_*span_road_head_y_by_time_
        + right_pull_by_time_*right_span_y_;
    lin->value[21] = cos_theta_road_by_time_*held_lambda_slot_offset_*span_axle_tail_y_
        - held_lambda_slot_offset_*sin_theta_road_by_time_*span_axle_tail_x_
        + right_pull_*span_axle_tail_x_*span_road_head_y_by_time_
        - right_pull_*span_axle_tail_y_*span_road_head_x_by_time_
        + right_pull_by_time_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[22] = bump_rate_*held_lambda_slot_offset_*sin_theta_road_ + bump_rate_*right_pull_*span_road_head_y_
        + bump_rate_*right_pull_by_axle_x_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[23] = -bump_rate_*cos_theta_road_*held_lambda_slot_offset_ - bump_rate_*right_pull_*span_road_head_x_
        + bump_rate_*right_pull_by_axle_y_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[24] = -bump_rate_*cos_theta_road_*held_lambda_slot_offset_*span_axle_tail_x_
        - bump_rate_*held_lambda_slot_offset_*sin_theta_road_*span_axle_tail_y_
        + bump_rate_*right_pull_*span_axle_tail_x_*span_road_head_x_
        + bump_rate_*right_pull_*span_axle_tail_y_*span_road_head_y_
        + bump_rate_*right_pull_by_axle_theta_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[25] = bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);
    lin->value[26] = bump_acceleration_*(bump_acceleration_*p->mass_bump_bump_ - cos_theta_road_*p->weight_road_across_
        - held_lambda_slot_offset_*(-cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + right_pull_*right_span_x_*span_road_head_y_
        - right_pull_*right_span_y_*span_road_head_x_) + bump_acceleration_by_time_*bump_rate_*p->mass_bump_bump_
        - bump_rate_*held_lambda_slot_offset_*sin_theta_road_by_time_*(-axle_x_ - span_axle_tail_x_)
        + bump_rate_*right_pull_*right_span_x_*span_road_head_y_by_time_
        - bump_rate_*right_pull_*right_span_y_*span_road_head_x_by_time_
        + bump_rate_*right_pull_*span_road_head_x_*span_road_head_y_by_time_
        - bump_rate_*right_pull_*span_road_head_x_by_time_*span_road_head_y_
        + bump_rate_*right_pull_by_time_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_)
        + cos_theta_road_by_time_*(bump_rate_*held_lambda_slot_offset_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*p->weight_road_across_);
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
    const double phi_slot_offset_axle_x_ = lin->value[0];
    const double phi_slot_offset_axle_y_ = lin->value[1];
    const double phi_slot_offset_axle_theta_ = lin->value[2];
    const double by_q_slot_offset_axle_x_ = lin->value[3];
    const double by_q_slot_offset_axle_y_ = lin->value[4];
    const double by_q_slot_offset_axle_theta_ = lin->value[5];
    const double by_q_axle_x_axle_x_ = lin->value[6];
    const double by_q_axle_x_axle_theta_ = lin->value[7];
    const double by_q_axle_x_axle_y_ = lin->value[8];
    const double by_q_axle_y_axle_y_ = lin->value[9];
    const double by_q_axle_y_axle_theta_ = lin->value[10];
    const double by_q_axle_y_axle_x_ = lin->value[11];
    const double by_q_axle_theta_axle_x_ = lin->value[12];
    const double by_q_axle_theta_axle_theta_ = lin->value[13];
    const double by_q_axle_theta_axle_y_ = lin->value[14];
    const double by_v_slot_offset_axle_theta_ = lin->value[15];
    const double by_v_slot_offset_axle_x_ = lin->value[16];
    const double by_v_slot_offset_axle_y_ = lin->value[17];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_axle_x_axle_x_ = p->axle_mass_ + by_q_axle_x_axle_x_*(eta * eta);
    const double n_axle_x_axle_y_ = by_q_axle_x_axle_y_*(eta * eta);
    const double n_axle_x_axle_theta_ = by_q_axle_x_axle_theta_*(eta * eta);
    const double n_axle_y_axle_x_ = by_q_axle_y_axle_x_*(eta * eta);
    const double n_axle_y_axle_y_ = p->axle_mass_ + by_q_axle_y_axle_y_*(eta * eta);
    const double n_axle_y_axle_theta_ = by_q_axle_y_axle_theta_*(eta * eta);
    const double n_axle_theta_axle_x_ = by_q_axle_theta_axle_x_*(eta * eta);
    const double n_axle_theta_axle_y_ = by_q_axle_theta_axle_y_*(eta * eta);
    const double n_axle_theta_axle_theta_ = p->axle_inertia_ + by_q_axle_theta_axle_theta_*(eta * eta);
    const double n_slot_offset_axle_x_ = eta_row*(by_q_slot_offset_axle_x_*eta + by_v_slot_offset_axle_x_)
        + phi_slot_offset_axle_x_;
    const double n_slot_offset_axle_y_ = eta_row*(by_q_slot_offset_axle_y_*eta + by_v_slot_offset_axle_y_)
        + phi_slot_offset_axle_y_;
    const double n_slot_offset_axle_theta_ = eta_row*(by_q_slot_offset_axle_theta_*eta + by_v_slot_offset_axle_theta_)
        + phi_slot_offset_axle_theta_;

    /* L U */
    const double scale_axle_x_ = n_axle_x_axle_x_;
    if (!(fabs(scale_axle_x_) > SINGULAR * fabs(n_axle_x_axle_x_)))
        return 1;
    const double inverse_pivot_axle_x_ = 1.0/scale_axle_x_;
    lin->lu[0] = inverse_pivot_axle_x_;
    const double l_axle_y_axle_x_ = inverse_pivot_axle_x_*n_axle_y_axle_x_;
    lin->lu[1] = l_axle_y_axle_x_;
    lin->lu[2] = n_axle_x_axle_y_;
    const double l_axle_theta_axle_x_ = inverse_pivot_axle_x_*n_axle_theta_axle_x_;
    lin->lu[3] = l_axle_theta_axle_x_;
    lin->lu[4] = n_axle_x_axle_theta_;
    const double l_slot_offset_axle_x_ = inverse_pivot_axle_x_*n_slot_offset_axle_x_;
    lin->lu[5] = l_slot_offset_axle_x_;
    const double scale_axle_y_ = -l_axle_y_axle_x_*n_axle_x_axle_y_ + n_axle_y_axle_y_;
    if (!(fabs(scale_axle_y_) > SINGULAR * fabs(n_axle_y_axle_y_)))
        return 2;
    const double inverse_pivot_axle_y_ = 1.0/scale_axle_y_;
    lin->lu[6] = inverse_pivot_axle_y_;
    const double l_axle_theta_axle_y_ = inverse_pivot_axle_y_*(-l_axle_theta_axle_x_*n_axle_x_axle_y_
        + n_axle_theta_axle_y_);
    lin->lu[7] = l_axle_theta_axle_y_;
    const double u_axle_y_axle_theta_ = -l_axle_y_axle_x_*n_axle_x_axle_theta_ + n_axle_y_axle_theta_;
    lin->lu[8] = u_axle_y_axle_theta_;
    const double l_slot_offset_axle_y_ = inverse_pivot_axle_y_*(-l_slot_offset_axle_x_*n_axle_x_axle_y_
        + n_slot_offset_axle_y_);
    lin->lu[9] = l_slot_offset_axle_y_;
    const double u_axle_y_slot_offset_ = -l_axle_y_axle_x_*phi_slot_offset_axle_x_ + phi_slot_offset_axle_y_;
    lin->lu[10] = u_axle_y_slot_offset_;
    const double scale_axle_theta_ = -l_axle_theta_axle_x_*n_axle_x_axle_theta_
        - l_axle_theta_axle_y_*u_axle_y_axle_theta_ + n_axle_theta_axle_theta_;
    if (!(fabs(scale_axle_theta_) > SINGULAR * fabs(n_axle_theta_axle_theta_)))
        return 3;
    const double inverse_pivot_axle_theta_ = 1.0/scale_axle_theta_;
    lin->lu[11] = inverse_pivot_axle_theta_;
    const double l_slot_offset_axle_theta_ = inverse_pivot_axle_theta_*(-l_slot_offset_axle_x_*n_axle_x_axle_theta_
        - l_slot_offset_axle_y_*u_axle_y_axle_theta_ + n_slot_offset_axle_theta_);
    lin->lu[12] = l_slot_offset_axle_theta_;
    const double u_axle_theta_slot_offset_ = -l_axle_theta_axle_x_*phi_slot_offset_axle_x_
        - l_axle_theta_axle_y_*u_axle_y_slot_offset_ + phi_slot_offset_axle_theta_;
    lin->lu[13] = u_axle_theta_slot_offset_;
    const double scale_slot_offset_ = -l_slot_offset_axle_theta_*u_axle_theta_slot_offset_
        - l_slot_offset_axle_x_*phi_slot_offset_axle_x_ - l_slot_offset_axle_y_*u_axle_y_slot_offset_;
    if (!(scale_slot_offset_ != 0.0 && isfinite(scale_slot_offset_)))
        return 4;
    const double inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;
    lin->lu[14] = inverse_pivot_slot_offset_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_slot_offset_axle_x_ = lin->value[0];
    const double inverse_pivot_axle_x_ = lin->lu[0];
    const double l_axle_y_axle_x_ = lin->lu[1];
    const double n_axle_x_axle_y_ = lin->lu[2];
    const double l_axle_theta_axle_x_ = lin->lu[3];
    const double n_axle_x_axle_theta_ = lin->lu[4];
    const double l_slot_offset_axle_x_ = lin->lu[5];
    const double inverse_pivot_axle_y_ = lin->lu[6];
    const double l_axle_theta_axle_y_ = lin->lu[7];
    const double u_axle_y_axle_theta_ = lin->lu[8];
    const double l_slot_offset_axle_y_ = lin->lu[9];
    const double u_axle_y_slot_offset_ = lin->lu[10];
    const double inverse_pivot_axle_theta_ = lin->lu[11];
    const double l_slot_offset_axle_theta_ = lin->lu[12];
    const double u_axle_theta_slot_offset_ = lin->lu[13];
    const double inverse_pivot_slot_offset_ = lin->lu[14];

    /* forward */
    const double b_axle_x_ = x[0];
    const double b_axle_y_ = -b_axle_x_*l_axle_y_axle_x_ + x[1];
    const double b_axle_theta_ = -b_axle_x_*l_axle_theta_axle_x_ - b_axle_y_*l_axle_theta_axle_y_ + x[2];
    const double b_slot_offset_ = -b_axle_theta_*l_slot_offset_axle_theta_ - b_axle_x_*l_slot_offset_axle_x_
        - b_axle_y_*l_slot_offset_axle_y_ + x[3];

    /* backward */
    const double x_slot_offset_ = b_slot_offset_*inverse_pivot_slot_offset_;
    x[3] = x_slot_offset_;
    const double x_axle_theta_ = inverse_pivot_axle_theta_*(b_axle_theta_ - u_axle_theta_slot_offset_*x_slot_offset_);
    x[2] = x_axle_theta_;
    const double x_axle_y_ = inverse_pivot_axle_y_*(b_axle_y_ - u_axle_y_axle_theta_*x_axle_theta_
        - u_axle_y_slot_offset_*x_slot_offset_);
    x[1] = x_axle_y_;
    const double x_axle_x_ = inverse_pivot_axle_x_*(b_axle_x_ - n_axle_x_axle_theta_*x_axle_theta_
        - n_axle_x_axle_y_*x_axle_y_ - phi_slot_offset_axle_x_*x_slot_offset_);
    x[0] = x_axle_x_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_slot_offset_axle_x_ = lin->value[0];
    const double phi_slot_offset_axle_y_ = lin->value[1];
    const double phi_slot_offset_axle_theta_ = lin->value[2];
    const double by_q_slot_offset_axle_x_ = lin->value[3];
    const double by_q_slot_offset_axle_y_ = lin->value[4];
    const double by_q_slot_offset_axle_theta_ = lin->value[5];
    const double by_q_axle_x_axle_x_ = lin->value[6];
    const double by_q_axle_x_axle_theta_ = lin->value[7];
    const double by_q_axle_x_axle_y_ = lin->value[8];
    const double by_q_axle_y_axle_y_ = lin->value[9];
    const double by_q_axle_y_axle_theta_ = lin->value[10];
    const double by_q_axle_y_axle_x_ = lin->value[11];
    const double by_q_axle_theta_axle_x_ = lin->value[12];
    const double by_q_axle_theta_axle_theta_ = lin->value[13];
    const double by_q_axle_theta_axle_y_ = lin->value[14];
    const double by_t_slot_offset_ = lin->value[18];
    const double by_t_axle_x_ = lin->value[19];
    const double by_t_axle_y_ = lin->value[20];
    const double by_t_axle_theta_ = lin->value[21];
    const double power_q_0_axle_x_ = lin->value[22];
    const double power_q_0_axle_y_ = lin->value[23];
    const double power_q_0_axle_theta_ = lin->value[24];
    const double power_0_slot_offset_ = lin->value[25];
    const double power_t_0_ = lin->value[26];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[4];
    const double shifted_axle_x_ = -p->beta_squared_*eta*r[0] + r[3];
    const double shifted_axle_y_ = -p->beta_squared_*eta*r[1] + r[4];
    const double shifted_axle_theta_ = -p->beta_squared_*eta*r[2] + r[5];
    x[0] = eta*(p->axle_mass_*r[3] - by_q_axle_x_axle_theta_*eta*r[2] - by_q_axle_x_axle_x_*eta*r[0]
        - by_q_axle_x_axle_y_*eta*r[1] - by_t_axle_x_*s);
    x[1] = eta*(p->axle_mass_*r[4] - by_q_axle_y_axle_theta_*eta*r[2] - by_q_axle_y_axle_x_*eta*r[0]
        - by_q_axle_y_axle_y_*eta*r[1] - by_t_axle_y_*s);
    x[2] = eta*(p->axle_inertia_*r[5] - by_q_axle_theta_axle_theta_*eta*r[2] - by_q_axle_theta_axle_x_*eta*r[0]
        - by_q_axle_theta_axle_y_*eta*r[1] - by_t_axle_theta_*s);
    x[3] = eta_row*(-by_q_slot_offset_axle_theta_*eta*r[2] - by_q_slot_offset_axle_x_*eta*r[0]
        - by_q_slot_offset_axle_y_*eta*r[1] - by_t_slot_offset_*s + phi_slot_offset_axle_theta_*shifted_axle_theta_
        + phi_slot_offset_axle_x_*shifted_axle_x_ + phi_slot_offset_axle_y_*shifted_axle_y_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*(power_q_0_axle_theta_*u[2] + power_q_0_axle_x_*u[0] + power_q_0_axle_y_*u[1] + power_t_0_*s + r[6])
        + power_0_slot_offset_*x[3];
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
    const double axle_x_ = q[0];
    const double axle_x_rate_ = v[0];
    const double axle_y_ = q[1];
    const double axle_y_rate_ = v[1];
    const double axle_theta_ = q[2];
    const double axle_omega_ = v[2];

    /* directions, arms, drives */
    const double bump_value_ = asin(p->r_*sin(p->omega_*t)/p->length_);
    const Four angles_0 = {bump_value_, axle_theta_, axle_theta_, axle_theta_};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_road_ = cosines_0[0];
    const double sin_theta_road_ = sines_0[0];
    const double cos_theta_axle_ = cosines_0[1];
    const double sin_theta_axle_ = sines_0[1];
    const double bump_rate_ = p->omega_*p->r_*cos(p->omega_*t)/(p->length_*sqrt(1.0
        - (p->r_ * p->r_)*(sin(p->omega_*t) * sin(p->omega_*t))/(p->length_ * p->length_)));
    const double span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const double span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* Phi and Phi_dot */
    const double phi_slot_offset_ = -axle_x_*cos_theta_road_ - axle_y_*sin_theta_road_
        - cos_theta_road_*span_axle_tail_x_ - sin_theta_road_*span_axle_tail_y_;
    const double phi_dot_slot_offset_ = axle_omega_*(cos_theta_road_*span_axle_tail_y_
        - sin_theta_road_*span_axle_tail_x_) - axle_x_rate_*cos_theta_road_ - axle_y_rate_*sin_theta_road_
        + bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);

    /* L D L^T of the KKT matrix */
    const double l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_tree_metric_axle_x_;
    const double l_slot_offset_axle_y_ = -p->inverse_tree_metric_axle_x_*sin_theta_road_;
    const double w_slot_offset_axle_theta_ = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    const double l_slot_offset_axle_theta_ = p->inverse_tree_metric_axle_theta_*w_slot_offset_axle_theta_;
    const double scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_
        + l_slot_offset_axle_theta_*w_slot_offset_axle_theta_ - l_slot_offset_axle_y_*sin_theta_road_;
    if (!(scale_slot_offset_ > 0.0 && scale_slot_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;

    /* backward substitution */
    const double dq_lambda_slot_offset_ = -inverse_pivot_slot_offset_*phi_slot_offset_;
    const double dq_acceleration_axle_theta_ = -dq_lambda_slot_offset_*l_slot_offset_axle_theta_;
    const double dq_acceleration_axle_y_ = -dq_lambda_slot_offset_*l_slot_offset_axle_y_;
    const double dq_acceleration_axle_x_ = -dq_lambda_slot_offset_*l_slot_offset_axle_x_;

    /* backward substitution */
    const double dv_lambda_slot_offset_ = -inverse_pivot_slot_offset_*phi_dot_slot_offset_;
    const double dv_acceleration_axle_theta_ = -dv_lambda_slot_offset_*l_slot_offset_axle_theta_;
    const double dv_acceleration_axle_y_ = -dv_lambda_slot_offset_*l_slot_offset_axle_y_;
    const double dv_acceleration_axle_x_ = -dv_lambda_slot_offset_*l_slot_offset_axle_x_;

    /* results */
    dq[0] = dq_acceleration_axle_x_;
    dv[0] = dv_acceleration_axle_x_;
    dq[1] = dq_acceleration_axle_y_;
    dv[1] = dv_acceleration_axle_y_;
    dq[2] = dq_acceleration_axle_theta_;
    dv[2] = dv_acceleration_axle_theta_;
    *worst = max_of(0.0, fabs(phi_slot_offset_));
    return 0;
}
