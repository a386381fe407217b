/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* coordinates, velocities, time */
    const double L1_x = q[0];
    const double L1_y = q[1];
    const double L1_theta = q[2];
    const double L1_vx = v[0];
    const double L1_vy = v[1];
    const double L1_omega = v[2];
    const double L2_x = q[3];
    const double L2_y = q[4];
    const double L2_theta = q[5];
    const double L2_vx = v[3];
    const double L2_vy = v[4];
    const double L2_omega = v[5];
    const double L3_x = q[6];
    const double L3_y = q[7];
    const double L3_theta = q[8];
    const double L3_vx = v[6];
    const double L3_vy = v[7];
    const double L3_omega = v[8];
    const double L4_x = q[9];
    const double L4_y = q[10];
    const double L4_theta = q[11];
    const double L4_vx = v[9];
    const double L4_vy = v[10];
    const double L4_omega = v[11];
    const double L6_x = q[12];
    const double L6_y = q[13];
    const double L6_theta = q[14];
    const double L6_vx = v[12];
    const double L6_vy = v[13];
    const double L6_omega = v[14];
    const double L7_x = q[15];
    const double L7_y = q[16];
    const double L7_theta = q[17];
    const double L7_vx = v[15];
    const double L7_vy = v[16];
    const double L7_omega = v[17];
    const double L8_x = q[18];
    const double L8_y = q[19];
    const double L8_theta = q[20];
    const double L8_vx = v[18];
    const double L8_vy = v[19];
    const double L8_omega = v[20];
    const double S9_x = q[21];
    const double S9_y = q[22];
    const double S9_theta = q[23];
    const double S9_vx = v[21];
    const double S9_vy = v[22];
    const double S9_omega = v[23];

    /* directions, arms, drives */
    const double cos_theta_L1 = cos(L1_theta);
    const double sin_theta_L1 = sin(L1_theta);
    const double arm_L1_head_x = p->L1_head_s_x*cos_theta_L1;
    const double arm_L1_head_y = p->L1_head_s_x*sin_theta_L1;
    const double cos_theta_L4 = cos(L4_theta);
    const double sin_theta_L4 = sin(L4_theta);
    const double arm_L4_head_x = p->L4_head_s_x*cos_theta_L4;
    const double arm_L4_head_y = p->L4_head_s_x*sin_theta_L4;
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double arm_L2_head_x = p->L2_head_s_x*cos_theta_L2;
    const double arm_L2_head_y = p->L2_head_s_x*sin_theta_L2;
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double arm_L3_head_x = p->L3_head_s_x*cos_theta_L3;
    const double arm_L3_head_y = p->L3_head_s_x*sin_theta_L3;
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double arm_L7_head_x = p->L7_head_s_x*cos_theta_L7;
    const double arm_L7_head_y = p->L7_head_s_x*sin_theta_L7;
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double arm_L6_head_x = p->L6_head_s_x*cos_theta_L6;
    const double arm_L6_head_y = p->L6_head_s_x*sin_theta_L6;
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double arm_L8_head_x = p->L8_head_s_x*cos_theta_L8;
    const double arm_L8_head_y = p->L8_head_s_x*sin_theta_L8;
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank1_rate = p->omega;
    const double crank1_acceleration = 0.0;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const double crank4_rate = p->omega4;
    const double crank4_acceleration = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O1_x = -L1_x + arm_L1_head_x;
    const double phi_dot_O1_x = -L1_omega*arm_L1_head_y - L1_vx;
    const double rhs_O1_x = (L1_omega * L1_omega)*arm_L1_head_x - p->beta_squared*phi_O1_x - phi_dot_O1_x*p->two_alpha;
    aside->phi[0] = phi_O1_x;
    aside->phi_dot[0] = phi_dot_O1_x;
    const double phi_O1_y = -L1_y + arm_L1_head_y;
    const double phi_dot_O1_y = L1_omega*arm_L1_head_x - L1_vy;
    const double rhs_O1_y = (L1_omega * L1_omega)*arm_L1_head_y - p->beta_squared*phi_O1_y - phi_dot_O1_y*p->two_alpha;
    aside->phi[1] = phi_O1_y;
    aside->phi_dot[1] = phi_dot_O1_y;
    const double phi_O4_x = -L4_x + arm_L4_head_x;
    const double phi_dot_O4_x = -L4_omega*arm_L4_head_y - L4_vx;
    const double rhs_O4_x = (L4_omega * L4_omega)*arm_L4_head_x - p->beta_squared*phi_O4_x - phi_dot_O4_x*p->two_alpha;
    aside->phi[2] = phi_O4_x;
    aside->phi_dot[2] = phi_dot_O4_x;
    const double phi_O4_y = -L4_y + p->O4_y + arm_L4_head_y;
    const double phi_dot_O4_y = L4_omega*arm_L4_head_x - L4_vy;
    const double rhs_O4_y = (L4_omega * L4_omega)*arm_L4_head_y - p->beta_squared*phi_O4_y - phi_dot_O4_y*p->two_alpha;
    aside->phi[3] = phi_O4_y;
    aside->phi_dot[3] = phi_dot_O4_y;
    const double phi_A_x = L1_x - L2_x + arm_L1_head_x + arm_L2_head_x;
    const double phi_dot_A_x = -L1_omega*arm_L1_head_y + L1_vx - L2_omega*arm_L2_head_y - L2_vx;
    const double rhs_A_x = (L1_omega * L1_omega)*arm_L1_head_x + (L2_omega * L2_omega)*arm_L2_head_x
        - p->beta_squared*phi_A_x - phi_dot_A_x*p->two_alpha;
    aside->phi[4] = phi_A_x;
    aside->phi_dot[4] = phi_dot_A_x;
    const double phi_A_y = L1_y - L2_y + arm_L1_head_y + arm_L2_head_y;
    const double phi_dot_A_y = L1_omega*arm_L1_head_x + L1_vy + L2_omega*arm_L2_head_x - L2_vy;
    const double rhs_A_y = (L1_omega * L1_omega)*arm_L1_head_y + (L2_omega * L2_omega)*arm_L2_head_y
        - p->beta_squared*phi_A_y - phi_dot_A_y*p->two_alpha;
    aside->phi[5] = phi_A_y;
    aside->phi_dot[5] = phi_dot_A_y;
    const double phi_B_x = -L3_x + L4_x + arm_L3_head_x + arm_L4_head_x;
    const double phi_dot_B_x = -L3_omega*arm_L3_head_y - L3_vx - L4_omega*arm_L4_head_y + L4_vx;
    const double rhs_B_x = (L3_omega * L3_omega)*arm_L3_head_x + (L4_omega * L4_omega)*arm_L4_head_x
        - p->beta_squared*phi_B_x - phi_dot_B_x*p->two_alpha;
    aside->phi[6] = phi_B_x;
    aside->phi_dot[6] = phi_dot_B_x;
    const double phi_B_y = -L3_y + L4_y + arm_L3_head_y + arm_L4_head_y;
    const double phi_dot_B_y = L3_omega*arm_L3_head_x - L3_vy + L4_omega*arm_L4_head_x + L4_vy;
    const double rhs_B_y = (L3_omega * L3_omega)*arm_L3_head_y + (L4_omega * L4_omega)*arm_L4_head_y
        - p->beta_squared*phi_B_y - phi_dot_B_y*p->two_alpha;
    aside->phi[7] = phi_B_y;
    aside->phi_dot[7] = phi_dot_B_y;
    const double phi_P2_x = L2_x - L7_x + arm_L2_head_x + arm_L7_head_x;
    const double phi_dot_P2_x = -L2_omega*arm_L2_head_y + L2_vx - L7_omega*arm_L7_head_y - L7_vx;
    const double rhs_P2_x = (L2_omega * L2_omega)*arm_L2_head_x + (L7_omega * L7_omega)*arm_L7_head_x
        - p->beta_squared*phi_P2_x - phi_dot_P2_x*p->two_alpha;
    aside->phi[8] = phi_P2_x;
    aside->phi_dot[8] = phi_dot_P2_x;
    const double phi_P2_y = L2_y - L7_y + arm_L2_head_y + arm_L7_head_y;
    const double phi_dot_P2_y = L2_omega*arm_L2_head_x + L2_vy + L7_omega*arm_L7_head_x - L7_vy;
    const double rhs_P2_y = (L2_omega * L2_omega)*arm_L2_head_y + (L7_omega * L7_omega)*arm_L7_head_y
        - p->beta_squared*phi_P2_y - phi_dot_P2_y*p->two_alpha;
    aside->phi[9] = phi_P2_y;
    aside->phi_dot[9] = phi_dot_P2_y;
    const double phi_P3_x = L3_x - L7_x + arm_L3_head_x + arm_L7_head_x;
    const double phi_dot_P3_x = -L3_omega*arm_L3_head_y + L3_vx - L7_omega*arm_L7_head_y - L7_vx;
    const double rhs_P3_x = (L3_omega * L3_omega)*arm_L3_head_x + (L7_omega * L7_omega)*arm_L7_head_x
        - p->beta_squared*phi_P3_x - phi_dot_P3_x*p->two_alpha;
    aside->phi[10] = phi_P3_x;
    aside->phi_dot[10] = phi_dot_P3_x;
    const double phi_P3_y = L3_y - L7_y + arm_L3_head_y + arm_L7_head_y;
    const double phi_dot_P3_y = L3_omega*arm_L3_head_x + L3_vy + L7_omega*arm_L7_head_x - L7_vy;
    const double rhs_P3_y = (L3_omega * L3_omega)*arm_L3_head_y + (L7_omega * L7_omega)*arm_L7_head_y
        - p->beta_squared*phi_P3_y - phi_dot_P3_y*p->two_alpha;
    aside->phi[11] = phi_P3_y;
    aside->phi_dot[11] = phi_dot_P3_y;
    const double phi_Q6_x = -L6_x + L7_x - arm_L6_head_x + arm_L7_head_x;
    const double phi_dot_Q6_x = L6_omega*arm_L6_head_y - L6_vx - L7_omega*arm_L7_head_y + L7_vx;
    const double rhs_Q6_x = -(L6_omega * L6_omega)*arm_L6_head_x + (L7_omega * L7_omega)*arm_L7_head_x
        - p->beta_squared*phi_Q6_x - phi_dot_Q6_x*p->two_alpha;
    aside->phi[12] = phi_Q6_x;
    aside->phi_dot[12] = phi_dot_Q6_x;
    const double phi_Q6_y = -L6_y + L7_y - arm_L6_head_y + arm_L7_head_y;
    const double phi_dot_Q6_y = -L6_omega*arm_L6_head_x - L6_vy + L7_omega*arm_L7_head_x + L7_vy;
    const double rhs_Q6_y = -(L6_omega * L6_omega)*arm_L6_head_y + (L7_omega * L7_omega)*arm_L7_head_y
        - p->beta_squared*phi_Q6_y - phi_dot_Q6_y*p->two_alpha;
    aside->phi[13] = phi_Q6_y;
    aside->phi_dot[13] = phi_dot_Q6_y;
    const double phi_Q8_x = L7_x - L8_x + arm_L7_head_x + arm_L8_head_x;
    const double phi_dot_Q8_x = -L7_omega*arm_L7_head_y + L7_vx - L8_omega*arm_L8_head_y - L8_vx;
    const double rhs_Q8_x = (L7_omega * L7_omega)*arm_L7_head_x + (L8_omega * L8_omega)*arm_L8_head_x
        - p->beta_squared*phi_Q8_x - phi_dot_Q8_x*p->two_alpha;
    aside->phi[14] = phi_Q8_x;
    aside->phi_dot[14] = phi_dot_Q8_x;
    const double phi_Q8_y = L7_y - L8_y + arm_L7_head_y + arm_L8_head_y;
    const double phi_dot_Q8_y = L7_omega*arm_L7_head_x + L7_vy + L8_omega*arm_L8_head_x - L8_vy;
    const double rhs_Q8_y = (L7_omega * L7_omega)*arm_L7_head_y + (L8_omega * L8_omega)*arm_L8_head_y
        - p->beta_squared*phi_Q8_y - phi_dot_Q8_y*p->two_alpha;
    aside->phi[15] = phi_Q8_y;
    aside->phi_dot[15] = phi_dot_Q8_y;
    const double phi_O6_x = -L6_x + p->O6_x + arm_L6_head_x;
    const double phi_dot_O6_x = -L6_omega*arm_L6_head_y - L6_vx;
    const double rhs_O6_x = (L6_omega * L6_omega)*arm_L6_head_x - p->beta_squared*phi_O6_x - phi_dot_O6_x*p->two_alpha;
    aside->phi[16] = phi_O6_x;
    aside->phi_dot[16] = phi_dot_O6_x;
    const double phi_O6_y = -L6_y + arm_L6_head_y;
    const double phi_dot_O6_y = L6_omega*arm_L6_head_x - L6_vy;
    const double rhs_O6_y = (L6_omega * L6_omega)*arm_L6_head_y - p->beta_squared*phi_O6_y - phi_dot_O6_y*p->two_alpha;
    aside->phi[17] = phi_O6_y;
    aside->phi_dot[17] = phi_dot_O6_y;
    const double phi_slider_x = L8_x - S9_x + arm_L8_head_x;
    const double phi_dot_slider_x = -L8_omega*arm_L8_head_y + L8_vx - S9_vx;
    const double rhs_slider_x = (L8_omega * L8_omega)*arm_L8_head_x - p->beta_squared*phi_slider_x
        - phi_dot_slider_x*p->two_alpha;
    aside->phi[18] = phi_slider_x;
    aside->phi_dot[18] = phi_dot_slider_x;
    const double phi_slider_y = L8_y - S9_y + arm_L8_head_y;
    const double phi_dot_slider_y = L8_omega*arm_L8_head_x + L8_vy - S9_vy;
    const double rhs_slider_y = (L8_omega * L8_omega)*arm_L8_head_y - p->beta_squared*phi_slider_y
        - phi_dot_slider_y*p->two_alpha;
    aside->phi[19] = phi_slider_y;
    aside->phi_dot[19] = phi_dot_slider_y;
    const double phi_guide_offset = p->O6_x - S9_x;
    const double phi_dot_guide_offset = -S9_vx;
    const double rhs_guide_offset = -p->beta_squared*phi_guide_offset - phi_dot_guide_offset*p->two_alpha;
    aside->phi[20] = phi_guide_offset;
    aside->phi_dot[20] = phi_dot_guide_offset;
    const double phi_guide_angle = S9_theta - PI/2.0;
    const double phi_dot_guide_angle = S9_omega;
    const double rhs_guide_angle = -p->beta_squared*phi_guide_angle - phi_dot_guide_angle*p->two_alpha;
    aside->phi[21] = phi_guide_angle;
    aside->phi_dot[21] = phi_dot_guide_angle;
    const double phi_crank1 = L1_theta - crank1_value;
    const double phi_dot_crank1 = L1_omega - crank1_rate;
    const double rhs_crank1 = -p->beta_squared*phi_crank1 + crank1_acceleration - phi_dot_crank1*p->two_alpha;
    aside->phi[22] = phi_crank1;
    aside->phi_dot[22] = phi_dot_crank1;
    const double phi_crank4 = L4_theta - crank4_value;
    const double phi_dot_crank4 = L4_omega - crank4_rate;
    const double rhs_crank4 = -p->beta_squared*phi_crank4 + crank4_acceleration - phi_dot_crank4*p->two_alpha;
    aside->phi[23] = phi_crank4;
    aside->phi_dot[23] = phi_dot_crank4;

    /* L D L^T of the KKT matrix */
    const double scale_guide_angle = p->inverse_S9_inertia;
    if (!(scale_guide_angle > 0.0 && scale_guide_angle < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_guide_angle = 1.0/scale_guide_angle;
    const double scale_guide_offset = p->inverse_S9_mass;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    const double l_slider_x__guide_offset = p->inverse_S9_mass*inverse_pivot_guide_offset;
    const double l_A_x__L2_theta = -arm_L2_head_y*p->inverse_L2_inertia;
    const double l_A_y__L2_theta = arm_L2_head_x*p->inverse_L2_inertia;
    const double l_P2_x__L2_theta = -arm_L2_head_y*p->inverse_L2_inertia;
    const double l_P2_y__L2_theta = arm_L2_head_x*p->inverse_L2_inertia;
    const double l_B_x__L3_theta = -arm_L3_head_y*p->inverse_L3_inertia;
    const double l_B_y__L3_theta = arm_L3_head_x*p->inverse_L3_inertia;
    const double l_P3_x__L3_theta = -arm_L3_head_y*p->inverse_L3_inertia;
    const double l_P3_y__L3_theta = arm_L3_head_x*p->inverse_L3_inertia;
    const double l_O6_x__L6_theta = -arm_L6_head_y*p->inverse_L6_inertia;
    const double l_O6_y__L6_theta = arm_L6_head_x*p->inverse_L6_inertia;
    const double l_Q6_x__L6_theta = arm_L6_head_y*p->inverse_L6_inertia;
    const double l_Q6_y__L6_theta = -arm_L6_head_x*p->inverse_L6_inertia;
    const double scale_O6_x = -arm_L6_head_y*l_O6_x__L6_theta + p->inverse_L6_mass;
    const double scale_O6_y = arm_L6_head_x*l_O6_y__L6_theta + p->inverse_L6_mass;
    const double pivot_O6_x__O6_y = -arm_L6_head_y*l_O6_y__L6_theta;
    const double determinant_O6_x__O6_y = -(pivot_O6_x__O6_y * pivot_O6_x__O6_y) + scale_O6_x*scale_O6_y;
    if (!(scale_O6_x > 0.0 && scale_O6_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_O6_x__O6_y > memory->least * scale_O6_y * scale_O6_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_O6_x__O6_y = -1.0/determinant_O6_x__O6_y;
    const double inverse_pivot_O6_x = inverse_O6_x__O6_y*scale_O6_y;
    const double inverse_pivot_O6_y = inverse_O6_x__O6_y*scale_O6_x;
    const double inverse_cross_O6_x__O6_y = -inverse_O6_x__O6_y*pivot_O6_x__O6_y;
    const double w_Q6_x__O6_x = arm_L6_head_y*l_Q6_x__L6_theta - p->inverse_L6_mass;
    const double w_Q6_x__O6_y = -arm_L6_head_x*l_Q6_x__L6_theta;
    const double l_Q6_x__O6_x = inverse_cross_O6_x__O6_y*w_Q6_x__O6_y + inverse_pivot_O6_x*w_Q6_x__O6_x;
    const double l_Q6_x__O6_y = inverse_cross_O6_x__O6_y*w_Q6_x__O6_x + inverse_pivot_O6_y*w_Q6_x__O6_y;
    const double w_Q6_y__O6_x = arm_L6_head_y*l_Q6_y__L6_theta;
    const double w_Q6_y__O6_y = -arm_L6_head_x*l_Q6_y__L6_theta - p->inverse_L6_mass;
    const double l_Q6_y__O6_x = inverse_cross_O6_x__O6_y*w_Q6_y__O6_y + inverse_pivot_O6_x*w_Q6_y__O6_x;
    const double l_Q6_y__O6_y = inverse_cross_O6_x__O6_y*w_Q6_y__O6_x + inverse_pivot_O6_y*w_Q6_y__O6_y;
    const double l_slider_y__L8_theta = arm_L8_head_x*p->inverse_L8_inertia;
    const double l_slider_x__L8_theta = -arm_L8_head_y*p->inverse_L8_inertia;
    const double l_Q8_x__L8_theta = -arm_L8_head_y*p->inverse_L8_inertia;
    const double l_Q8_y__L8_theta = arm_L8_head_x*p->inverse_L8_inertia;
    const double scale_slider_y = arm_L8_head_x*l_slider_y__L8_theta + p->inverse_L8_mass + p->inverse_S9_mass;
    const double scale_slider_x = -arm_L8_head_y*l_slider_x__L8_theta + p->inverse_L8_mass + p->inverse_S9_mass;
    const double pivot_slider_x = -p->inverse_S9_mass*l_slider_x__guide_offset + scale_slider_x;
    const double pivot_slider_y__slider_x = arm_L8_head_x*l_slider_x__L8_theta;
    const double determinant_slider_y__slider_x = pivot_slider_x*scale_slider_y
        - (pivot_slider_y__slider_x * pivot_slider_y__slider_x);
    if (!(scale_slider_y > 0.0 && scale_slider_y < INFINITY)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_slider_y__slider_x > memory->least * scale_slider_x * scale_slider_y)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_slider_y__slider_x = -1.0/determinant_slider_y__slider_x;
    const double inverse_pivot_slider_y = inverse_slider_y__slider_x*pivot_slider_x;
    const double inverse_pivot_slider_x = inverse_slider_y__slider_x*scale_slider_y;
    const double inverse_cross_slider_y__slider_x = -inverse_slider_y__slider_x*pivot_slider_y__slider_x;
    const double w_Q8_x__slider_y = -arm_L8_head_x*l_Q8_x__L8_theta;
    const double w_Q8_x__slider_x = arm_L8_head_y*l_Q8_x__L8_theta + p->inverse_L8_mass;
    const double l_Q8_x__slider_y = inverse_cross_slider_y__slider_x*w_Q8_x__slider_x
        + inverse_pivot_slider_y*w_Q8_x__slider_y;
    const double l_Q8_x__slider_x = inverse_cross_slider_y__slider_x*w_Q8_x__slider_y
        + inverse_pivot_slider_x*w_Q8_x__slider_x;
    const double w_Q8_y__slider_y = -arm_L8_head_x*l_Q8_y__L8_theta + p->inverse_L8_mass;
    const double w_Q8_y__slider_x = arm_L8_head_y*l_Q8_y__L8_theta;
    const double l_Q8_y__slider_y = inverse_cross_slider_y__slider_x*w_Q8_y__slider_x
        + inverse_pivot_slider_y*w_Q8_y__slider_y;
    const double l_Q8_y__slider_x = inverse_cross_slider_y__slider_x*w_Q8_y__slider_y
        + inverse_pivot_slider_x*w_Q8_y__slider_x;
    const double l_O1_x__L1_theta = -arm_L1_head_y*p->inverse_L1_inertia;
    const double l_O1_y__L1_theta = arm_L1_head_x*p->inverse_L1_inertia;
    const double l_A_x__L1_theta = -arm_L1_head_y*p->inverse_L1_inertia;
    const double l_A_y__L1_theta = arm_L1_head_x*p->inverse_L1_inertia;
    const double scale_O1_x = -arm_L1_head_y*l_O1_x__L1_theta + p->inverse_L1_mass;
    const double scale_O1_y = arm_L1_head_x*l_O1_y__L1_theta + p->inverse_L1_mass;
    const double pivot_O1_x__O1_y = -arm_L1_head_y*l_O1_y__L1_theta;
    const double determinant_O1_x__O1_y = -(pivot_O1_x__O1_y * pivot_O1_x__O1_y) + scale_O1_x*scale_O1_y;
    if (!(scale_O1_x > 0.0 && scale_O1_x < INFINITY)) {
        pivot = 7;
        goto dependent;
    }
    if (!(determinant_O1_x__O1_y > memory->least * scale_O1_y * scale_O1_x)) {
        pivot = 8;
        goto dependent;
    }
    const double inverse_O1_x__O1_y = -1.0/determinant_O1_x__O1_y;
    const double inverse_pivot_O1_x = inverse_O1_x__O1_y*scale_O1_y;
    const double inverse_pivot_O1_y = inverse_O1_x__O1_y*scale_O1_x;
    const double inverse_cross_O1_x__O1_y = -inverse_O1_x__O1_y*pivot_O1_x__O1_y;
    const double w_crank1__O1_x = arm_L1_head_y*p->inverse_L1_inertia;
    const double w_crank1__O1_y = -arm_L1_head_x*p->inverse_L1_inertia;
    const double l_crank1__O1_x = inverse_cross_O1_x__O1_y*w_crank1__O1_y + inverse_pivot_O1_x*w_crank1__O1_x;
    const double l_crank1__O1_y = inverse_cross_O1_x__O1_y*w_crank1__O1_x + inverse_pivot_O1_y*w_crank1__O1_y;
    const double w_A_x__O1_x = arm_L1_head_y*l_A_x__L1_theta + p->inverse_L1_mass;
    const double w_A_x__O1_y = -arm_L1_head_x*l_A_x__L1_theta;
    const double l_A_x__O1_x = inverse_cross_O1_x__O1_y*w_A_x__O1_y + inverse_pivot_O1_x*w_A_x__O1_x;
    const double l_A_x__O1_y = inverse_cross_O1_x__O1_y*w_A_x__O1_x + inverse_pivot_O1_y*w_A_x__O1_y;
    const double w_A_y__O1_x = arm_L1_head_y*l_A_y__L1_theta;
    const double w_A_y__O1_y = -arm_L1_head_x*l_A_y__L1_theta + p->inverse_L1_mass;
    const double l_A_y__O1_x = inverse_cross_O1_x__O1_y*w_A_y__O1_y + inverse_pivot_O1_x*w_A_y__O1_x;
    const double l_A_y__O1_y = inverse_cross_O1_x__O1_y*w_A_y__O1_x + inverse_pivot_O1_y*w_A_y__O1_y;
    const double scale_crank1 = p->inverse_L1_inertia;
    const double pivot_crank1 = l_crank1__O1_x*w_crank1__O1_x + l_crank1__O1_y*w_crank1__O1_y + scale_crank1;
    if (!(pivot_crank1 > memory->least * scale_crank1)) {
        pivot = 9;
        goto dependent;
    }
    const double inverse_pivot_crank1 = 1.0/pivot_crank1;
    const double w_A_x__crank1 = -l_A_x__L1_theta - l_A_x__O1_x*w_crank1__O1_x - l_A_x__O1_y*w_crank1__O1_y;
    const double l_A_x__crank1 = -inverse_pivot_crank1*w_A_x__crank1;
    const double w_A_y__crank1 = -l_A_y__L1_theta - l_A_y__O1_x*w_crank1__O1_x - l_A_y__O1_y*w_crank1__O1_y;
    const double l_A_y__crank1 = -inverse_pivot_crank1*w_A_y__crank1;
    const double scale_A_x = -arm_L1_head_y*l_A_x__L1_theta - arm_L2_head_y*l_A_x__L2_theta + p->inverse_L1_mass
        + p->inverse_L2_mass;
    const double scale_A_y = arm_L1_head_x*l_A_y__L1_theta + arm_L2_head_x*l_A_y__L2_theta + p->inverse_L1_mass
        + p->inverse_L2_mass;
    const double pivot_A_x = l_A_x__O1_x*w_A_x__O1_x + l_A_x__O1_y*w_A_x__O1_y + l_A_x__crank1*w_A_x__crank1
        + scale_A_x;
    const double pivot_A_y = l_A_y__O1_x*w_A_y__O1_x + l_A_y__O1_y*w_A_y__O1_y + l_A_y__crank1*w_A_y__crank1
        + scale_A_y;
    const double pivot_A_x__A_y = -arm_L1_head_y*l_A_y__L1_theta - arm_L2_head_y*l_A_y__L2_theta
        + l_A_y__O1_x*w_A_x__O1_x + l_A_y__O1_y*w_A_x__O1_y + l_A_y__crank1*w_A_x__crank1;
    const double determinant_A_x__A_y = pivot_A_x*pivot_A_y - (pivot_A_x__A_y * pivot_A_x__A_y);
    if (!(pivot_A_x > memory->least * scale_A_x)) {
        pivot = 10;
        goto dependent;
    }
    if (!(determinant_A_x__A_y > memory->least * scale_A_y * pivot_A_x)) {
        pivot = 11;
        goto dependent;
    }
    const double inverse_A_x__A_y = -1.0/determinant_A_x__A_y;
    const double inverse_pivot_A_x = inverse_A_x__A_y*pivot_A_y;
    const double inverse_pivot_A_y = inverse_A_x__A_y*pivot_A_x;
    const double inverse_cross_A_x__A_y = -inverse_A_x__A_y*pivot_A_x__A_y;
    const double w_P2_x__A_x = arm_L2_head_y*l_P2_x__L2_theta + p->inverse_L2_mass;
    const double w_P2_x__A_y = -arm_L2_head_x*l_P2_x__L2_theta;
    const double l_P2_x__A_x = inverse_cross_A_x__A_y*w_P2_x__A_y + inverse_pivot_A_x*w_P2_x__A_x;
    const double l_P2_x__A_y = inverse_cross_A_x__A_y*w_P2_x__A_x + inverse_pivot_A_y*w_P2_x__A_y;
    const double w_P2_y__A_x = arm_L2_head_y*l_P2_y__L2_theta;
    const double w_P2_y__A_y = -arm_L2_head_x*l_P2_y__L2_theta + p->inverse_L2_mass;
    const double l_P2_y__A_x = inverse_cross_A_x__A_y*w_P2_y__A_y + inverse_pivot_A_x*w_P2_y__A_x;
    const double l_P2_y__A_y = inverse_cross_A_x__A_y*w_P2_y__A_x + inverse_pivot_A_y*w_P2_y__A_y;
    const double l_O4_x__L4_theta = -arm_L4_head_y*p->inverse_L4_inertia;
    const double l_O4_y__L4_theta = arm_L4_head_x*p->inverse_L4_inertia;
    const double l_B_x__L4_theta = -arm_L4_head_y*p->inverse_L4_inertia;
    const double l_B_y__L4_theta = arm_L4_head_x*p->inverse_L4_inertia;
    const double scale_O4_x = -arm_L4_head_y*l_O4_x__L4_theta + p->inverse_L4_mass;
    const double scale_O4_y = arm_L4_head_x*l_O4_y__L4_theta + p->inverse_L4_mass;
    const double pivot_O4_x__O4_y = -arm_L4_head_y*l_O4_y__L4_theta;
    const double determinant_O4_x__O4_y = -(pivot_O4_x__O4_y * pivot_O4_x__O4_y) + scale_O4_x*scale_O4_y;
    if (!(scale_O4_x > 0.0 && scale_O4_x < INFINITY)) {
        pivot = 12;
        goto dependent;
    }
    if (!(determinant_O4_x__O4_y > memory->least * scale_O4_y * scale_O4_x)) {
        pivot = 13;
        goto dependent;
    }
    const double inverse_O4_x__O4_y = -1.0/determinant_O4_x__O4_y;
    const double inverse_pivot_O4_x = inverse_O4_x__O4_y*scale_O4_y;
    const double inverse_pivot_O4_y = inverse_O4_x__O4_y*scale_O4_x;
    const double inverse_cross_O4_x__O4_y = -inverse_O4_x__O4_y*pivot_O4_x__O4_y;
    const double w_crank4__O4_x = arm_L4_head_y*p->inverse_L4_inertia;
    const double w_crank4__O4_y = -arm_L4_head_x*p->inverse_L4_inertia;
    const double l_crank4__O4_x = inverse_cross_O4_x__O4_y*w_crank4__O4_y + inverse_pivot_O4_x*w_crank4__O4_x;
    const double l_crank4__O4_y = inverse_cross_O4_x__O4_y*w_crank4__O4_x + inverse_pivot_O4_y*w_crank4__O4_y;
    const double w_B_x__O4_x = arm_L4_head_y*l_B_x__L4_theta + p->inverse_L4_mass;
    const double w_B_x__O4_y = -arm_L4_head_x*l_B_x__L4_theta;
    const double l_B_x__O4_x = inverse_cross_O4_x__O4_y*w_B_x__O4_y + inverse_pivot_O4_x*w_B_x__O4_x;
    const double l_B_x__O4_y = inverse_cross_O4_x__O4_y*w_B_x__O4_x + inverse_pivot_O4_y*w_B_x__O4_y;
    const double w_B_y__O4_x = arm_L4_head_y*l_B_y__L4_theta;
    const double w_B_y__O4_y = -arm_L4_head_x*l_B_y__L4_theta + p->inverse_L4_mass;
    const double l_B_y__O4_x = inverse_cross_O4_x__O4_y*w_B_y__O4_y + inverse_pivot_O4_x*w_B_y__O4_x;
    const double l_B_y__O4_y = inverse_cross_O4_x__O4_y*w_B_y__O4_x + inverse_pivot_O4_y*w_B_y__O4_y;
    const double scale_crank4 = p->inverse_L4_inertia;
    const double pivot_crank4 = l_crank4__O4_x*w_crank4__O4_x + l_crank4__O4_y*w_crank4__O4_y + scale_crank4;
    if (!(pivot_crank4 > memory->least * scale_crank4)) {
        pivot = 14;
        goto dependent;
    }
    const double inverse_pivot_crank4 = 1.0/pivot_crank4;
    const double w_B_x__crank4 = -l_B_x__L4_theta - l_B_x__O4_x*w_crank4__O4_x - l_B_x__O4_y*w_crank4__O4_y;
    const double l_B_x__crank4 = -inverse_pivot_crank4*w_B_x__crank4;
    const double w_B_y__crank4 = -l_B_y__L4_theta - l_B_y__O4_x*w_crank4__O4_x - l_B_y__O4_y*w_crank4__O4_y;
    const double l_B_y__crank4 = -inverse_pivot_crank4*w_B_y__crank4;
    const double scale_B_x = -arm_L3_head_y*l_B_x__L3_theta - arm_L4_head_y*l_B_x__L4_theta + p->inverse_L3_mass
        + p->inverse_L4_mass;
    const double scale_B_y = arm_L3_head_x*l_B_y__L3_theta + arm_L4_head_x*l_B_y__L4_theta + p->inverse_L3_mass
        + p->inverse_L4_mass;
    const double pivot_B_x = l_B_x__O4_x*w_B_x__O4_x + l_B_x__O4_y*w_B_x__O4_y + l_B_x__crank4*w_B_x__crank4
        + scale_B_x;
    const double pivot_B_y = l_B_y__O4_x*w_B_y__O4_x + l_B_y__O4_y*w_B_y__O4_y + l_B_y__crank4*w_B_y__crank4
        + scale_B_y;
    const double pivot_B_x__B_y = -arm_L3_head_y*l_B_y__L3_theta - arm_L4_head_y*l_B_y__L4_theta
        + l_B_y__O4_x*w_B_x__O4_x + l_B_y__O4_y*w_B_x__O4_y + l_B_y__crank4*w_B_x__crank4;
    const double determinant_B_x__B_y = pivot_B_x*pivot_B_y - (pivot_B_x__B_y * pivot_B_x__B_y);
    if (!(pivot_B_x > memory->least * scale_B_x)) {
        pivot = 15;
        goto dependent;
    }
    if (!(determinant_B_x__B_y > memory->least * scale_B_y * pivot_B_x)) {
        pivot = 16;
        goto dependent;
    }
    const double inverse_B_x__B_y = -1.0/determinant_B_x__B_y;
    const double inverse_pivot_B_x = inverse_B_x__B_y*pivot_B_y;
    const double inverse_pivot_B_y = inverse_B_x__B_y*pivot_B_x;
    const double inverse_cross_B_x__B_y = -inverse_B_x__B_y*pivot_B_x__B_y;
    const double w_P3_x__B_x = arm_L3_head_y*l_P3_x__L3_theta + p->inverse_L3_mass;
    const double w_P3_x__B_y = -arm_L3_head_x*l_P3_x__L3_theta;
    const double l_P3_x__B_x = inverse_cross_B_x__B_y*w_P3_x__B_y + inverse_pivot_B_x*w_P3_x__B_x;
    const double l_P3_x__B_y = inverse_cross_B_x__B_y*w_P3_x__B_x + inverse_pivot_B_y*w_P3_x__B_y;
    const double w_P3_y__B_x = arm_L3_head_y*l_P3_y__L3_theta;
    const double w_P3_y__B_y = -arm_L3_head_x*l_P3_y__L3_theta + p->inverse_L3_mass;
    const double l_P3_y__B_x = inverse_cross_B_x__B_y*w_P3_y__B_y + inverse_pivot_B_x*w_P3_y__B_x;
    const double l_P3_y__B_y = inverse_cross_B_x__B_y*w_P3_y__B_x + inverse_pivot_B_y*w_P3_y__B_y;
    const double l_Q6_x__L7_theta = -arm_L7_head_y*p->inverse_L7_inertia;
    const double l_Q6_y__L7_theta = arm_L7_head_x*p->inverse_L7_inertia;
    const double l_Q8_x__L7_theta = -arm_L7_head_y*p->inverse_L7_inertia;
    const double l_P2_x__L7_theta = -arm_L7_head_y*p->inverse_L7_inertia;
    const double l_P2_y__L7_theta = arm_L7_head_x*p->inverse_L7_inertia;
    const double l_P3_x__L7_theta = -arm_L7_head_y*p->inverse_L7_inertia;
    const double l_P3_y__L7_theta = arm_L7_head_x*p->inverse_L7_inertia;
    const double l_Q8_y__L7_theta = arm_L7_head_x*p->inverse_L7_inertia;
    const double scale_Q6_x = arm_L6_head_y*l_Q6_x__L6_theta - arm_L7_head_y*l_Q6_x__L7_theta + p->inverse_L6_mass
        + p->inverse_L7_mass;
    const double scale_Q6_y = -arm_L6_head_x*l_Q6_y__L6_theta + arm_L7_head_x*l_Q6_y__L7_theta + p->inverse_L6_mass
        + p->inverse_L7_mass;
    const double pivot_Q6_x = l_Q6_x__O6_x*w_Q6_x__O6_x + l_Q6_x__O6_y*w_Q6_x__O6_y + scale_Q6_x;
    const double pivot_Q6_y = l_Q6_y__O6_x*w_Q6_y__O6_x + l_Q6_y__O6_y*w_Q6_y__O6_y + scale_Q6_y;
    const double pivot_Q6_x__Q6_y = arm_L6_head_y*l_Q6_y__L6_theta - arm_L7_head_y*l_Q6_y__L7_theta
        + l_Q6_y__O6_x*w_Q6_x__O6_x + l_Q6_y__O6_y*w_Q6_x__O6_y;
    const double determinant_Q6_x__Q6_y = pivot_Q6_x*pivot_Q6_y - (pivot_Q6_x__Q6_y * pivot_Q6_x__Q6_y);
    if (!(pivot_Q6_x > memory->least * scale_Q6_x)) {
        pivot = 17;
        goto dependent;
    }
    if (!(determinant_Q6_x__Q6_y > memory->least * scale_Q6_y * pivot_Q6_x)) {
        pivot = 18;
        goto dependent;
    }
    const double inverse_Q6_x__Q6_y = -1.0/determinant_Q6_x__Q6_y;
    const double inverse_pivot_Q6_x = inverse_Q6_x__Q6_y*pivot_Q6_y;
    const double inverse_pivot_Q6_y = inverse_Q6_x__Q6_y*pivot_Q6_x;
    const double inverse_cross_Q6_x__Q6_y = -inverse_Q6_x__Q6_y*pivot_Q6_x__Q6_y;
    const double w_Q8_x__Q6_x = arm_L7_head_y*l_Q8_x__L7_theta - p->inverse_L7_mass;
    const double w_Q8_x__Q6_y = -arm_L7_head_x*l_Q8_x__L7_theta;
    const double l_Q8_x__Q6_x = inverse_cross_Q6_x__Q6_y*w_Q8_x__Q6_y + inverse_pivot_Q6_x*w_Q8_x__Q6_x;
    const double l_Q8_x__Q6_y = inverse_cross_Q6_x__Q6_y*w_Q8_x__Q6_x + inverse_pivot_Q6_y*w_Q8_x__Q6_y;
    const double w_P2_x__Q6_x = arm_L7_head_y*l_P2_x__L7_theta + p->inverse_L7_mass;
    const double w_P2_x__Q6_y = -arm_L7_head_x*l_P2_x__L7_theta;
    const double l_P2_x__Q6_x = inverse_cross_Q6_x__Q6_y*w_P2_x__Q6_y + inverse_pivot_Q6_x*w_P2_x__Q6_x;
    const double l_P2_x__Q6_y = inverse_cross_Q6_x__Q6_y*w_P2_x__Q6_x + inverse_pivot_Q6_y*w_P2_x__Q6_y;
    const double w_P2_y__Q6_x = arm_L7_head_y*l_P2_y__L7_theta;
    const double w_P2_y__Q6_y = -arm_L7_head_x*l_P2_y__L7_theta + p->inverse_L7_mass;
    const double l_P2_y__Q6_x = inverse_cross_Q6_x__Q6_y*w_P2_y__Q6_y + inverse_pivot_Q6_x*w_P2_y__Q6_x;
    const double l_P2_y__Q6_y = inverse_cross_Q6_x__Q6_y*w_P2_y__Q6_x + inverse_pivot_Q6_y*w_P2_y__Q6_y;
    const double w_P3_x__Q6_x = arm_L7_head_y*l_P3_x__L7_theta + p->inverse_L7_mass;
    const double w_P3_x__Q6_y = -arm_L7_head_x*l_P3_x__L7_theta;
    const double l_P3_x__Q6_x = inverse_cross_Q6_x__Q6_y*w_P3_x__Q6_y + inverse_pivot_Q6_x*w_P3_x__Q6_x;
    const double l_P3_x__Q6_y = inverse_cross_Q6_x__Q6_y*w_P3_x__Q6_x + inverse_pivot_Q6_y*w_P3_x__Q6_y;
    const double w_P3_y__Q6_x = arm_L7_head_y*l_P3_y__L7_theta;
    const double w_P3_y__Q6_y = -arm_L7_head_x*l_P3_y__L7_theta + p->inverse_L7_mass;
    const double l_P3_y__Q6_x = inverse_cross_Q6_x__Q6_y*w_P3_y__Q6_y + inverse_pivot_Q6_x*w_P3_y__Q6_x;
    const double l_P3_y__Q6_y = inverse_cross_Q6_x__Q6_y*w_P3_y__Q6_x + inverse_pivot_Q6_y*w_P3_y__Q6_y;
    const double w_Q8_y__Q6_x = arm_L7_head_y*l_Q8_y__L7_theta;
    const double w_Q8_y__Q6_y = -arm_L7_head_x*l_Q8_y__L7_theta - p->inverse_L7_mass;
    const double l_Q8_y__Q6_x = inverse_cross_Q6_x__Q6_y*w_Q8_y__Q6_y + inverse_pivot_Q6_x*w_Q8_y__Q6_x;
    const double l_Q8_y__Q6_y = inverse_cross_Q6_x__Q6_y*w_Q8_y__Q6_x + inverse_pivot_Q6_y*w_Q8_y__Q6_y;
    const double scale_Q8_x = -arm_L7_head_y*l_Q8_x__L7_theta - arm_L8_head_y*l_Q8_x__L8_theta + p->inverse_L7_mass
        + p->inverse_L8_mass;
    const double scale_P2_x = -arm_L2_head_y*l_P2_x__L2_theta - arm_L7_head_y*l_P2_x__L7_theta + p->inverse_L2_mass
        + p->inverse_L7_mass;
    const double pivot_Q8_x = l_Q8_x__Q6_x*w_Q8_x__Q6_x + l_Q8_x__Q6_y*w_Q8_x__Q6_y + l_Q8_x__slider_x*w_Q8_x__slider_x
        + l_Q8_x__slider_y*w_Q8_x__slider_y + scale_Q8_x;
    const double pivot_P2_x = l_P2_x__A_x*w_P2_x__A_x + l_P2_x__A_y*w_P2_x__A_y + l_P2_x__Q6_x*w_P2_x__Q6_x
        + l_P2_x__Q6_y*w_P2_x__Q6_y + scale_P2_x;
    const double pivot_Q8_x__P2_x = -arm_L7_head_y*l_P2_x__L7_theta - p->inverse_L7_mass + l_P2_x__Q6_x*w_Q8_x__Q6_x
        + l_P2_x__Q6_y*w_Q8_x__Q6_y;
    const double determinant_Q8_x__P2_x = pivot_P2_x*pivot_Q8_x - (pivot_Q8_x__P2_x * pivot_Q8_x__P2_x);
    if (!(pivot_Q8_x > memory->least * scale_Q8_x)) {
        pivot = 19;
        goto dependent;
    }
    if (!(determinant_Q8_x__P2_x > memory->least * scale_P2_x * pivot_Q8_x)) {
        pivot = 20;
        goto dependent;
    }
    const double inverse_Q8_x__P2_x = -1.0/determinant_Q8_x__P2_x;
    const double inverse_pivot_Q8_x = inverse_Q8_x__P2_x*pivot_P2_x;
    const double inverse_pivot_P2_x = inverse_Q8_x__P2_x*pivot_Q8_x;
    const double inverse_cross_Q8_x__P2_x = -inverse_Q8_x__P2_x*pivot_Q8_x__P2_x;
    const double w_P2_y__Q8_x = arm_L7_head_y*l_P2_y__L7_theta - l_P2_y__Q6_x*w_Q8_x__Q6_x - l_P2_y__Q6_y*w_Q8_x__Q6_y;
    const double w_P2_y__P2_x = arm_L2_head_y*l_P2_y__L2_theta + arm_L7_head_y*l_P2_y__L7_theta
        - l_P2_y__A_x*w_P2_x__A_x - l_P2_y__A_y*w_P2_x__A_y - l_P2_y__Q6_x*w_P2_x__Q6_x - l_P2_y__Q6_y*w_P2_x__Q6_y;
    const double l_P2_y__Q8_x = inverse_cross_Q8_x__P2_x*w_P2_y__P2_x + inverse_pivot_Q8_x*w_P2_y__Q8_x;
    const double l_P2_y__P2_x = inverse_cross_Q8_x__P2_x*w_P2_y__Q8_x + inverse_pivot_P2_x*w_P2_y__P2_x;
    const double w_P3_x__Q8_x = arm_L7_head_y*l_P3_x__L7_theta + p->inverse_L7_mass - l_P3_x__Q6_x*w_Q8_x__Q6_x
        - l_P3_x__Q6_y*w_Q8_x__Q6_y;
    const double w_P3_x__P2_x = arm_L7_head_y*l_P3_x__L7_theta - p->inverse_L7_mass - l_P3_x__Q6_x*w_P2_x__Q6_x
        - l_P3_x__Q6_y*w_P2_x__Q6_y;
    const double l_P3_x__Q8_x = inverse_cross_Q8_x__P2_x*w_P3_x__P2_x + inverse_pivot_Q8_x*w_P3_x__Q8_x;
    const double l_P3_x__P2_x = inverse_cross_Q8_x__P2_x*w_P3_x__Q8_x + inverse_pivot_P2_x*w_P3_x__P2_x;
    const double w_P3_y__Q8_x = arm_L7_head_y*l_P3_y__L7_theta - l_P3_y__Q6_x*w_Q8_x__Q6_x - l_P3_y__Q6_y*w_Q8_x__Q6_y;
    const double w_P3_y__P2_x = arm_L7_head_y*l_P3_y__L7_theta - l_P3_y__Q6_x*w_P2_x__Q6_x - l_P3_y__Q6_y*w_P2_x__Q6_y;
    const double l_P3_y__Q8_x = inverse_cross_Q8_x__P2_x*w_P3_y__P2_x + inverse_pivot_Q8_x*w_P3_y__Q8_x;
    const double l_P3_y__P2_x = inverse_cross_Q8_x__P2_x*w_P3_y__Q8_x + inverse_pivot_P2_x*w_P3_y__P2_x;
    const double w_Q8_y__Q8_x = arm_L7_head_y*l_Q8_y__L7_theta + arm_L8_head_y*l_Q8_y__L8_theta
        - l_Q8_y__Q6_x*w_Q8_x__Q6_x - l_Q8_y__Q6_y*w_Q8_x__Q6_y - l_Q8_y__slider_x*w_Q8_x__slider_x
        - l_Q8_y__slider_y*w_Q8_x__slider_y;
    const double w_Q8_y__P2_x = arm_L7_head_y*l_Q8_y__L7_theta - l_Q8_y__Q6_x*w_P2_x__Q6_x - l_Q8_y__Q6_y*w_P2_x__Q6_y;
    const double l_Q8_y__Q8_x = inverse_cross_Q8_x__P2_x*w_Q8_y__P2_x + inverse_pivot_Q8_x*w_Q8_y__Q8_x;
    const double l_Q8_y__P2_x = inverse_cross_Q8_x__P2_x*w_Q8_y__Q8_x + inverse_pivot_P2_x*w_Q8_y__P2_x;
    const double scale_P2_y = arm_L2_head_x*l_P2_y__L2_theta + arm_L7_head_x*l_P2_y__L7_theta + p->inverse_L2_mass
        + p->inverse_L7_mass;
    const double scale_P3_x = -arm_L3_head_y*l_P3_x__L3_theta - arm_L7_head_y*l_P3_x__L7_theta + p->inverse_L3_mass
        + p->inverse_L7_mass;
    const double pivot_P2_y = l_P2_y__A_x*w_P2_y__A_x + l_P2_y__A_y*w_P2_y__A_y + l_P2_y__P2_x*w_P2_y__P2_x
        + l_P2_y__Q6_x*w_P2_y__Q6_x + l_P2_y__Q6_y*w_P2_y__Q6_y + l_P2_y__Q8_x*w_P2_y__Q8_x + scale_P2_y;
    const double pivot_P3_x = l_P3_x__B_x*w_P3_x__B_x + l_P3_x__B_y*w_P3_x__B_y + l_P3_x__P2_x*w_P3_x__P2_x
        + l_P3_x__Q6_x*w_P3_x__Q6_x + l_P3_x__Q6_y*w_P3_x__Q6_y + l_P3_x__Q8_x*w_P3_x__Q8_x + scale_P3_x;
    const double pivot_P2_y__P3_x = arm_L7_head_x*l_P3_x__L7_theta + l_P3_x__P2_x*w_P2_y__P2_x
        + l_P3_x__Q6_x*w_P2_y__Q6_x + l_P3_x__Q6_y*w_P2_y__Q6_y + l_P3_x__Q8_x*w_P2_y__Q8_x;
    const double determinant_P2_y__P3_x = pivot_P2_y*pivot_P3_x - (pivot_P2_y__P3_x * pivot_P2_y__P3_x);
    if (!(pivot_P2_y > memory->least * scale_P2_y)) {
        pivot = 21;
        goto dependent;
    }
    if (!(determinant_P2_y__P3_x > memory->least * scale_P3_x * pivot_P2_y)) {
        pivot = 22;
        goto dependent;
    }
    const double inverse_P2_y__P3_x = -1.0/determinant_P2_y__P3_x;
    const double inverse_pivot_P2_y = inverse_P2_y__P3_x*pivot_P3_x;
    const double inverse_pivot_P3_x = inverse_P2_y__P3_x*pivot_P2_y;
    const double inverse_cross_P2_y__P3_x = -inverse_P2_y__P3_x*pivot_P2_y__P3_x;
    const double w_P3_y__P2_y = -arm_L7_head_x*l_P3_y__L7_theta - p->inverse_L7_mass - l_P3_y__P2_x*w_P2_y__P2_x
        - l_P3_y__Q6_x*w_P2_y__Q6_x - l_P3_y__Q6_y*w_P2_y__Q6_y - l_P3_y__Q8_x*w_P2_y__Q8_x;
    const double w_P3_y__P3_x = arm_L3_head_y*l_P3_y__L3_theta + arm_L7_head_y*l_P3_y__L7_theta
        - l_P3_y__B_x*w_P3_x__B_x - l_P3_y__B_y*w_P3_x__B_y - l_P3_y__P2_x*w_P3_x__P2_x - l_P3_y__Q6_x*w_P3_x__Q6_x
        - l_P3_y__Q6_y*w_P3_x__Q6_y - l_P3_y__Q8_x*w_P3_x__Q8_x;
    const double l_P3_y__P2_y = inverse_cross_P2_y__P3_x*w_P3_y__P3_x + inverse_pivot_P2_y*w_P3_y__P2_y;
    const double l_P3_y__P3_x = inverse_cross_P2_y__P3_x*w_P3_y__P2_y + inverse_pivot_P3_x*w_P3_y__P3_x;
    const double w_Q8_y__P2_y = -arm_L7_head_x*l_Q8_y__L7_theta + p->inverse_L7_mass - l_Q8_y__P2_x*w_P2_y__P2_x
        - l_Q8_y__Q6_x*w_P2_y__Q6_x - l_Q8_y__Q6_y*w_P2_y__Q6_y - l_Q8_y__Q8_x*w_P2_y__Q8_x;
    const double w_Q8_y__P3_x = arm_L7_head_y*l_Q8_y__L7_theta - l_Q8_y__P2_x*w_P3_x__P2_x - l_Q8_y__Q6_x*w_P3_x__Q6_x
        - l_Q8_y__Q6_y*w_P3_x__Q6_y - l_Q8_y__Q8_x*w_P3_x__Q8_x;
    const double l_Q8_y__P2_y = inverse_cross_P2_y__P3_x*w_Q8_y__P3_x + inverse_pivot_P2_y*w_Q8_y__P2_y;
    const double l_Q8_y__P3_x = inverse_cross_P2_y__P3_x*w_Q8_y__P2_y + inverse_pivot_P3_x*w_Q8_y__P3_x;
    const double scale_P3_y = arm_L3_head_x*l_P3_y__L3_theta + arm_L7_head_x*l_P3_y__L7_theta + p->inverse_L3_mass
        + p->inverse_L7_mass;
    const double scale_Q8_y = arm_L7_head_x*l_Q8_y__L7_theta + arm_L8_head_x*l_Q8_y__L8_theta + p->inverse_L7_mass
        + p->inverse_L8_mass;
    const double pivot_P3_y = l_P3_y__B_x*w_P3_y__B_x + l_P3_y__B_y*w_P3_y__B_y + l_P3_y__P2_x*w_P3_y__P2_x
        + l_P3_y__P2_y*w_P3_y__P2_y + l_P3_y__P3_x*w_P3_y__P3_x + l_P3_y__Q6_x*w_P3_y__Q6_x + l_P3_y__Q6_y*w_P3_y__Q6_y
        + l_P3_y__Q8_x*w_P3_y__Q8_x + scale_P3_y;
    const double pivot_Q8_y = l_Q8_y__P2_x*w_Q8_y__P2_x + l_Q8_y__P2_y*w_Q8_y__P2_y + l_Q8_y__P3_x*w_Q8_y__P3_x
        + l_Q8_y__Q6_x*w_Q8_y__Q6_x + l_Q8_y__Q6_y*w_Q8_y__Q6_y + l_Q8_y__Q8_x*w_Q8_y__Q8_x
        + l_Q8_y__slider_x*w_Q8_y__slider_x + l_Q8_y__slider_y*w_Q8_y__slider_y + scale_Q8_y;
    const double pivot_P3_y__Q8_y = arm_L7_head_x*l_Q8_y__L7_theta - p->inverse_L7_mass + l_Q8_y__P2_x*w_P3_y__P2_x
        + l_Q8_y__P2_y*w_P3_y__P2_y + l_Q8_y__P3_x*w_P3_y__P3_x + l_Q8_y__Q6_x*w_P3_y__Q6_x + l_Q8_y__Q6_y*w_P3_y__Q6_y
        + l_Q8_y__Q8_x*w_P3_y__Q8_x;
    const double determinant_P3_y__Q8_y = pivot_P3_y*pivot_Q8_y - (pivot_P3_y__Q8_y * pivot_P3_y__Q8_y);
    if (!(pivot_P3_y > memory->least * scale_P3_y)) {
        pivot = 23;
        goto dependent;
    }
    if (!(determinant_P3_y__Q8_y > memory->least * scale_Q8_y * pivot_P3_y)) {
        pivot = 24;
        goto dependent;
    }
    const double inverse_P3_y__Q8_y = -1.0/determinant_P3_y__Q8_y;
    const double inverse_pivot_P3_y = inverse_P3_y__Q8_y*pivot_Q8_y;
    const double inverse_pivot_Q8_y = inverse_P3_y__Q8_y*pivot_P3_y;
    const double inverse_cross_P3_y__Q8_y = -inverse_P3_y__Q8_y*pivot_P3_y__Q8_y;

    /* forward substitution */
    const double z_O6_y = p->inverse_L6_mass*p->weight_L6_y + rhs_O6_y;
    const double z_slider_y = -p->inverse_L8_mass*p->weight_L8_y + p->inverse_S9_mass*p->weight_S9_y + rhs_slider_y;
    const double z_slider_x = -l_slider_x__guide_offset*rhs_guide_offset + rhs_slider_x;
    const double z_O1_y = p->inverse_L1_mass*p->weight_L1_y + rhs_O1_y;
    const double z_crank1 = -l_crank1__O1_x*rhs_O1_x - l_crank1__O1_y*z_O1_y + rhs_crank1;
    const double z_A_x = -l_A_x__O1_x*rhs_O1_x - l_A_x__O1_y*z_O1_y - l_A_x__crank1*z_crank1 + rhs_A_x;
    const double z_A_y = -p->inverse_L1_mass*p->weight_L1_y + p->inverse_L2_mass*p->weight_L2_y - l_A_y__O1_x*rhs_O1_x
        - l_A_y__O1_y*z_O1_y - l_A_y__crank1*z_crank1 + rhs_A_y;
    const double z_O4_y = p->inverse_L4_mass*p->weight_L4_y + rhs_O4_y;
    const double z_crank4 = -l_crank4__O4_x*rhs_O4_x - l_crank4__O4_y*z_O4_y + rhs_crank4;
    const double z_B_x = -l_B_x__O4_x*rhs_O4_x - l_B_x__O4_y*z_O4_y - l_B_x__crank4*z_crank4 + rhs_B_x;
    const double z_B_y = p->inverse_L3_mass*p->weight_L3_y - p->inverse_L4_mass*p->weight_L4_y - l_B_y__O4_x*rhs_O4_x
        - l_B_y__O4_y*z_O4_y - l_B_y__crank4*z_crank4 + rhs_B_y;
    const double z_Q6_x = -l_Q6_x__O6_x*rhs_O6_x - l_Q6_x__O6_y*z_O6_y + rhs_Q6_x;
    const double z_Q6_y = p->inverse_L6_mass*p->weight_L6_y - p->inverse_L7_mass*p->weight_L7_y - l_Q6_y__O6_x*rhs_O6_x
        - l_Q6_y__O6_y*z_O6_y + rhs_Q6_y;
    const double z_Q8_x = -l_Q8_x__Q6_x*z_Q6_x - l_Q8_x__Q6_y*z_Q6_y - l_Q8_x__slider_x*z_slider_x
        - l_Q8_x__slider_y*z_slider_y + rhs_Q8_x;
    const double z_P2_x = -l_P2_x__A_x*z_A_x - l_P2_x__A_y*z_A_y - l_P2_x__Q6_x*z_Q6_x - l_P2_x__Q6_y*z_Q6_y + rhs_P2_x;
    const double z_P2_y = -p->inverse_L2_mass*p->weight_L2_y + p->inverse_L7_mass*p->weight_L7_y - l_P2_y__A_x*z_A_x
        - l_P2_y__A_y*z_A_y - l_P2_y__P2_x*z_P2_x - l_P2_y__Q6_x*z_Q6_x - l_P2_y__Q6_y*z_Q6_y - l_P2_y__Q8_x*z_Q8_x
        + rhs_P2_y;
    const double z_P3_x = -l_P3_x__B_x*z_B_x - l_P3_x__B_y*z_B_y - l_P3_x__P2_x*z_P2_x - l_P3_x__Q6_x*z_Q6_x
        - l_P3_x__Q6_y*z_Q6_y - l_P3_x__Q8_x*z_Q8_x + rhs_P3_x;
    const double z_P3_y = -p->inverse_L3_mass*p->weight_L3_y + p->inverse_L7_mass*p->weight_L7_y - l_P3_y__B_x*z_B_x
        - l_P3_y__B_y*z_B_y - l_P3_y__P2_x*z_P2_x - l_P3_y__P2_y*z_P2_y - l_P3_y__P3_x*z_P3_x - l_P3_y__Q6_x*z_Q6_x
        - l_P3_y__Q6_y*z_Q6_y - l_P3_y__Q8_x*z_Q8_x + rhs_P3_y;
    const double z_Q8_y = -p->inverse_L7_mass*p->weight_L7_y + p->inverse_L8_mass*p->weight_L8_y - l_Q8_y__P2_x*z_P2_x
        - l_Q8_y__P2_y*z_P2_y - l_Q8_y__P3_x*z_P3_x - l_Q8_y__Q6_x*z_Q6_x - l_Q8_y__Q6_y*z_Q6_y - l_Q8_y__Q8_x*z_Q8_x
        - l_Q8_y__slider_x*z_slider_x - l_Q8_y__slider_y*z_slider_y + rhs_Q8_y;

    /* backward substitution */
    const double lambda_Q8_y = inverse_cross_P3_y__Q8_y*z_P3_y + inverse_pivot_Q8_y*z_Q8_y;
    const double lambda_P3_y = inverse_cross_P3_y__Q8_y*z_Q8_y + inverse_pivot_P3_y*z_P3_y;
    const double lambda_P3_x = inverse_cross_P2_y__P3_x*z_P2_y + inverse_pivot_P3_x*z_P3_x - l_P3_y__P3_x*lambda_P3_y
        - l_Q8_y__P3_x*lambda_Q8_y;
    const double lambda_P2_y = inverse_cross_P2_y__P3_x*z_P3_x + inverse_pivot_P2_y*z_P2_y - l_P3_y__P2_y*lambda_P3_y
        - l_Q8_y__P2_y*lambda_Q8_y;
    const double lambda_P2_x = inverse_cross_Q8_x__P2_x*z_Q8_x + inverse_pivot_P2_x*z_P2_x - l_P2_y__P2_x*lambda_P2_y
        - l_P3_x__P2_x*lambda_P3_x - l_P3_y__P2_x*lambda_P3_y - l_Q8_y__P2_x*lambda_Q8_y;
    const double lambda_Q8_x = inverse_cross_Q8_x__P2_x*z_P2_x + inverse_pivot_Q8_x*z_Q8_x - l_P2_y__Q8_x*lambda_P2_y
        - l_P3_x__Q8_x*lambda_P3_x - l_P3_y__Q8_x*lambda_P3_y - l_Q8_y__Q8_x*lambda_Q8_y;
    const double lambda_Q6_y = inverse_cross_Q6_x__Q6_y*z_Q6_x + inverse_pivot_Q6_y*z_Q6_y - l_P2_x__Q6_y*lambda_P2_x
        - l_P2_y__Q6_y*lambda_P2_y - l_P3_x__Q6_y*lambda_P3_x - l_P3_y__Q6_y*lambda_P3_y - l_Q8_x__Q6_y*lambda_Q8_x
        - l_Q8_y__Q6_y*lambda_Q8_y;
    const double lambda_Q6_x = inverse_cross_Q6_x__Q6_y*z_Q6_y + inverse_pivot_Q6_x*z_Q6_x - l_P2_x__Q6_x*lambda_P2_x
        - l_P2_y__Q6_x*lambda_P2_y - l_P3_x__Q6_x*lambda_P3_x - l_P3_y__Q6_x*lambda_P3_y - l_Q8_x__Q6_x*lambda_Q8_x
        - l_Q8_y__Q6_x*lambda_Q8_y;
    const double acceleration_L7_theta = -l_P2_x__L7_theta*lambda_P2_x - l_P2_y__L7_theta*lambda_P2_y
        - l_P3_x__L7_theta*lambda_P3_x - l_P3_y__L7_theta*lambda_P3_y - l_Q6_x__L7_theta*lambda_Q6_x
        - l_Q6_y__L7_theta*lambda_Q6_y - l_Q8_x__L7_theta*lambda_Q8_x - l_Q8_y__L7_theta*lambda_Q8_y;
    const double lambda_B_y = inverse_cross_B_x__B_y*z_B_x + inverse_pivot_B_y*z_B_y - l_P3_x__B_y*lambda_P3_x
        - l_P3_y__B_y*lambda_P3_y;
    const double lambda_B_x = inverse_cross_B_x__B_y*z_B_y + inverse_pivot_B_x*z_B_x - l_P3_x__B_x*lambda_P3_x
        - l_P3_y__B_x*lambda_P3_y;
    const double lambda_crank4 = -inverse_pivot_crank4*z_crank4 - l_B_x__crank4*lambda_B_x - l_B_y__crank4*lambda_B_y;
    const double lambda_O4_y = inverse_cross_O4_x__O4_y*rhs_O4_x + inverse_pivot_O4_y*z_O4_y - l_B_x__O4_y*lambda_B_x
        - l_B_y__O4_y*lambda_B_y - l_crank4__O4_y*lambda_crank4;
    const double lambda_O4_x = inverse_cross_O4_x__O4_y*z_O4_y + inverse_pivot_O4_x*rhs_O4_x - l_B_x__O4_x*lambda_B_x
        - l_B_y__O4_x*lambda_B_y - l_crank4__O4_x*lambda_crank4;
    const double acceleration_L4_theta = -p->inverse_L4_inertia*lambda_crank4 - l_B_x__L4_theta*lambda_B_x
        - l_B_y__L4_theta*lambda_B_y - l_O4_x__L4_theta*lambda_O4_x - l_O4_y__L4_theta*lambda_O4_y;
    const double lambda_A_y = inverse_cross_A_x__A_y*z_A_x + inverse_pivot_A_y*z_A_y - l_P2_x__A_y*lambda_P2_x
        - l_P2_y__A_y*lambda_P2_y;
    const double lambda_A_x = inverse_cross_A_x__A_y*z_A_y + inverse_pivot_A_x*z_A_x - l_P2_x__A_x*lambda_P2_x
        - l_P2_y__A_x*lambda_P2_y;
    const double lambda_crank1 = -inverse_pivot_crank1*z_crank1 - l_A_x__crank1*lambda_A_x - l_A_y__crank1*lambda_A_y;
    const double lambda_O1_y = inverse_cross_O1_x__O1_y*rhs_O1_x + inverse_pivot_O1_y*z_O1_y - l_A_x__O1_y*lambda_A_x
        - l_A_y__O1_y*lambda_A_y - l_crank1__O1_y*lambda_crank1;
    const double lambda_O1_x = inverse_cross_O1_x__O1_y*z_O1_y + inverse_pivot_O1_x*rhs_O1_x - l_A_x__O1_x*lambda_A_x
        - l_A_y__O1_x*lambda_A_y - l_crank1__O1_x*lambda_crank1;
    const double acceleration_L1_theta = -p->inverse_L1_inertia*lambda_crank1 - l_A_x__L1_theta*lambda_A_x
        - l_A_y__L1_theta*lambda_A_y - l_O1_x__L1_theta*lambda_O1_x - l_O1_y__L1_theta*lambda_O1_y;
    const double acceleration_L7_y = p->inverse_L7_mass*lambda_P2_y + p->inverse_L7_mass*lambda_P3_y
        - p->inverse_L7_mass*lambda_Q6_y - p->inverse_L7_mass*lambda_Q8_y + p->inverse_L7_mass*p->weight_L7_y;
    const double acceleration_L7_x = p->inverse_L7_mass*lambda_P2_x + p->inverse_L7_mass*lambda_P3_x
        - p->inverse_L7_mass*lambda_Q6_x - p->inverse_L7_mass*lambda_Q8_x;
    const double lambda_slider_x = inverse_cross_slider_y__slider_x*z_slider_y + inverse_pivot_slider_x*z_slider_x
        - l_Q8_x__slider_x*lambda_Q8_x - l_Q8_y__slider_x*lambda_Q8_y;
    const double lambda_slider_y = inverse_cross_slider_y__slider_x*z_slider_x + inverse_pivot_slider_y*z_slider_y
        - l_Q8_x__slider_y*lambda_Q8_x - l_Q8_y__slider_y*lambda_Q8_y;
    const double acceleration_L8_theta = -l_Q8_x__L8_theta*lambda_Q8_x - l_Q8_y__L8_theta*lambda_Q8_y
        - l_slider_x__L8_theta*lambda_slider_x - l_slider_y__L8_theta*lambda_slider_y;
    const double lambda_O6_y = inverse_cross_O6_x__O6_y*rhs_O6_x + inverse_pivot_O6_y*z_O6_y - l_Q6_x__O6_y*lambda_Q6_x
        - l_Q6_y__O6_y*lambda_Q6_y;
    const double lambda_O6_x = inverse_cross_O6_x__O6_y*z_O6_y + inverse_pivot_O6_x*rhs_O6_x - l_Q6_x__O6_x*lambda_Q6_x
        - l_Q6_y__O6_x*lambda_Q6_y;
    const double acceleration_L6_theta = -l_O6_x__L6_theta*lambda_O6_x - l_O6_y__L6_theta*lambda_O6_y
        - l_Q6_x__L6_theta*lambda_Q6_x - l_Q6_y__L6_theta*lambda_Q6_y;
    const double acceleration_L3_theta = -l_B_x__L3_theta*lambda_B_x - l_B_y__L3_theta*lambda_B_y
        - l_P3_x__L3_theta*lambda_P3_x - l_P3_y__L3_theta*lambda_P3_y;
    const double acceleration_L2_theta = -l_A_x__L2_theta*lambda_A_x - l_A_y__L2_theta*lambda_A_y
        - l_P2_x__L2_theta*lambda_P2_x - l_P2_y__L2_theta*lambda_P2_y;
    const double lambda_guide_offset = -inverse_pivot_guide_offset*rhs_guide_offset
        - l_slider_x__guide_offset*lambda_slider_x;
    const double acceleration_S9_x = p->inverse_S9_mass*lambda_guide_offset + p->inverse_S9_mass*lambda_slider_x;
    const double acceleration_L8_y = p->inverse_L8_mass*lambda_Q8_y - p->inverse_L8_mass*lambda_slider_y
        + p->inverse_L8_mass*p->weight_L8_y;
    const double acceleration_L8_x = p->inverse_L8_mass*lambda_Q8_x - p->inverse_L8_mass*lambda_slider_x;
    const double acceleration_L6_y = p->inverse_L6_mass*lambda_O6_y + p->inverse_L6_mass*lambda_Q6_y
        + p->inverse_L6_mass*p->weight_L6_y;
    const double acceleration_L6_x = p->inverse_L6_mass*lambda_O6_x + p->inverse_L6_mass*lambda_Q6_x;
    const double acceleration_L4_y = -p->inverse_L4_mass*lambda_B_y + p->inverse_L4_mass*lambda_O4_y
        + p->inverse_L4_mass*p->weight_L4_y;
    const double acceleration_L4_x = -p->inverse_L4_mass*lambda_B_x + p->inverse_L4_mass*lambda_O4_x;
    const double acceleration_L3_y = p->inverse_L3_mass*lambda_B_y - p->inverse_L3_mass*lambda_P3_y
        + p->inverse_L3_mass*p->weight_L3_y;
    const double acceleration_L3_x = p->inverse_L3_mass*lambda_B_x - p->inverse_L3_mass*lambda_P3_x;
    const double acceleration_L2_y = p->inverse_L2_mass*lambda_A_y - p->inverse_L2_mass*lambda_P2_y
        + p->inverse_L2_mass*p->weight_L2_y;
    const double acceleration_L2_x = p->inverse_L2_mass*lambda_A_x - p->inverse_L2_mass*lambda_P2_x;
    const double acceleration_L1_y = -p->inverse_L1_mass*lambda_A_y + p->inverse_L1_mass*lambda_O1_y
        + p->inverse_L1_mass*p->weight_L1_y;
    const double acceleration_L1_x = -p->inverse_L1_mass*lambda_A_x + p->inverse_L1_mass*lambda_O1_x;
    const double lambda_guide_angle = -inverse_pivot_guide_angle*rhs_guide_angle;
    const double acceleration_S9_theta = -p->inverse_S9_inertia*lambda_guide_angle;
    const double acceleration_S9_y = p->inverse_S9_mass*lambda_slider_y + p->inverse_S9_mass*p->weight_S9_y;

    /* results */
    a[0] = acceleration_L1_x;
    a[1] = acceleration_L1_y;
    a[2] = acceleration_L1_theta;
    a[3] = acceleration_L2_x;
    a[4] = acceleration_L2_y;
    a[5] = acceleration_L2_theta;
    a[6] = acceleration_L3_x;
    a[7] = acceleration_L3_y;
    a[8] = acceleration_L3_theta;
    a[9] = acceleration_L4_x;
    a[10] = acceleration_L4_y;
    a[11] = acceleration_L4_theta;
    a[12] = acceleration_L6_x;
    a[13] = acceleration_L6_y;
    a[14] = acceleration_L6_theta;
    a[15] = acceleration_L7_x;
    a[16] = acceleration_L7_y;
    a[17] = acceleration_L7_theta;
    a[18] = acceleration_L8_x;
    a[19] = acceleration_L8_y;
    a[20] = acceleration_L8_theta;
    a[21] = acceleration_S9_x;
    a[22] = acceleration_S9_y;
    a[23] = acceleration_S9_theta;
    aside->lambda[0] = lambda_O1_x;
    aside->lambda[1] = lambda_O1_y;
    aside->lambda[2] = lambda_O4_x;
    aside->lambda[3] = lambda_O4_y;
    aside->lambda[4] = lambda_A_x;
    aside->lambda[5] = lambda_A_y;
    aside->lambda[6] = lambda_B_x;
    aside->lambda[7] = lambda_B_y;
    aside->lambda[8] = lambda_P2_x;
    aside->lambda[9] = lambda_P2_y;
    aside->lambda[10] = lambda_P3_x;
    aside->lambda[11] = lambda_P3_y;
    aside->lambda[12] = lambda_Q6_x;
    aside->lambda[13] = lambda_Q6_y;
    aside->lambda[14] = lambda_Q8_x;
    aside->lambda[15] = lambda_Q8_y;
    aside->lambda[16] = lambda_O6_x;
    aside->lambda[17] = lambda_O6_y;
    aside->lambda[18] = lambda_slider_x;
    aside->lambda[19] = lambda_slider_y;
    aside->lambda[20] = lambda_guide_offset;
    aside->lambda[21] = lambda_guide_angle;
    aside->lambda[22] = lambda_crank1;
    aside->lambda[23] = lambda_crank4;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_L1_y;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_L2_y;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_L3_y;
        force[8] = 0.0;
        force[9] = 0.0;
        force[10] = p->weight_L4_y;
        force[11] = 0.0;
        force[12] = 0.0;
        force[13] = p->weight_L6_y;
        force[14] = 0.0;
        force[15] = 0.0;
        force[16] = p->weight_L7_y;
        force[17] = 0.0;
        force[18] = 0.0;
        force[19] = p->weight_L8_y;
        force[20] = 0.0;
        force[21] = 0.0;
        force[22] = p->weight_S9_y;
        force[23] = 0.0;
        rhs[0] = rhs_O1_x;
        rhs[1] = rhs_O1_y;
        rhs[2] = rhs_O4_x;
        rhs[3] = rhs_O4_y;
        rhs[4] = rhs_A_x;
        rhs[5] = rhs_A_y;
        rhs[6] = rhs_B_x;
        rhs[7] = rhs_B_y;
        rhs[8] = rhs_P2_x;
        rhs[9] = rhs_P2_y;
        rhs[10] = rhs_P3_x;
        rhs[11] = rhs_P3_y;
        rhs[12] = rhs_Q6_x;
        rhs[13] = rhs_Q6_y;
        rhs[14] = rhs_Q8_x;
        rhs[15] = rhs_Q8_y;
        rhs[16] = rhs_O6_x;
        rhs[17] = rhs_O6_y;
        rhs[18] = rhs_slider_x;
        rhs[19] = rhs_slider_y;
        rhs[20] = rhs_guide_offset;
        rhs[21] = rhs_guide_angle;
        rhs[22] = rhs_crank1;
        rhs[23] = rhs_crank4;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = -aside->lambda[22]*crank1_rate - aside->lambda[23]*crank4_rate;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
