/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)memory;
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
    const double time = t;

    /* parameters */
    const double omega = p->omega;
    const double omega4 = p->omega4;
    const double L1_head_x = p->L1_head_x;
    const double L2_head_x = p->L2_head_x;
    const double L3_head_x = p->L3_head_x;
    const double L4_head_x = p->L4_head_x;
    const double L6_head_x = p->L6_head_x;
    const double L7_head_x = p->L7_head_x;
    const double L8_head_x = p->L8_head_x;
    const double O4_y = p->O4_y;
    const double O6_x = p->O6_x;
    const double inverse_L1_mass = p->inverse_L1_mass;
    const double inverse_L2_mass = p->inverse_L2_mass;
    const double inverse_L3_mass = p->inverse_L3_mass;
    const double inverse_L4_mass = p->inverse_L4_mass;
    const double inverse_S9_mass = p->inverse_S9_mass;
    const double inverse_S9_inertia = p->inverse_S9_inertia;
    const double inverse_L2_inertia = p->inverse_L2_inertia;
    const double inverse_L3_inertia = p->inverse_L3_inertia;
    const double inverse_L6_mass = p->inverse_L6_mass;
    const double inverse_L8_mass = p->inverse_L8_mass;
    const double inverse_L1_inertia = p->inverse_L1_inertia;
    const double inverse_L4_inertia = p->inverse_L4_inertia;
    const double inverse_L6_inertia = p->inverse_L6_inertia;
    const double inverse_L7_mass = p->inverse_L7_mass;
    const double inverse_L8_inertia = p->inverse_L8_inertia;
    const double inverse_L7_inertia = p->inverse_L7_inertia;

    /* directions, arms, drives */
    const double cos_theta_L1 = cos(L1_theta);
    const double sin_theta_L1 = sin(L1_theta);
    const double arm_L1_head_x = L1_head_x*cos_theta_L1;
    const double arm_L1_head_y = L1_head_x*sin_theta_L1;
    const double cos_theta_L4 = cos(L4_theta);
    const double sin_theta_L4 = sin(L4_theta);
    const double arm_L4_head_x = L4_head_x*cos_theta_L4;
    const double arm_L4_head_y = L4_head_x*sin_theta_L4;
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double arm_L2_head_x = L2_head_x*cos_theta_L2;
    const double arm_L2_head_y = L2_head_x*sin_theta_L2;
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double arm_L3_head_x = L3_head_x*cos_theta_L3;
    const double arm_L3_head_y = L3_head_x*sin_theta_L3;
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double arm_L7_head_x = L7_head_x*cos_theta_L7;
    const double arm_L7_head_y = L7_head_x*sin_theta_L7;
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double arm_L6_head_x = L6_head_x*cos_theta_L6;
    const double arm_L6_head_y = L6_head_x*sin_theta_L6;
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double arm_L8_head_x = L8_head_x*cos_theta_L8;
    const double arm_L8_head_y = L8_head_x*sin_theta_L8;
    const double crank1_value = omega*time - 0.689754120388159;
    const double crank1_rate = omega;
    const double crank4_value = omega4*time + 3.4814082589530893;
    const double crank4_rate = omega4;

    /* Phi and Phi_dot */
    const double phi_O1_x_2 = -L1_x + arm_L1_head_x;
    const double phi_dot_O1_x_2 = -L1_omega*arm_L1_head_y - L1_vx;
    const double phi_O1_y_2 = -L1_y + arm_L1_head_y;
    const double phi_dot_O1_y_2 = L1_omega*arm_L1_head_x - L1_vy;
    const double phi_O4_x_2 = -L4_x + arm_L4_head_x;
    const double phi_dot_O4_x_2 = -L4_omega*arm_L4_head_y - L4_vx;
    const double phi_O4_y_2 = -L4_y + O4_y + arm_L4_head_y;
    const double phi_dot_O4_y_2 = L4_omega*arm_L4_head_x - L4_vy;
    const double phi_P2_x_2 = L2_x - L7_x + arm_L2_head_x + arm_L7_head_x;
    const double phi_dot_P2_x_2 = -L2_omega*arm_L2_head_y + L2_vx - L7_omega*arm_L7_head_y - L7_vx;
    const double phi_P2_y_2 = L2_y - L7_y + arm_L2_head_y + arm_L7_head_y;
    const double phi_dot_P2_y_2 = L2_omega*arm_L2_head_x + L2_vy + L7_omega*arm_L7_head_x - L7_vy;
    const double phi_P3_x_2 = L3_x - L7_x + arm_L3_head_x + arm_L7_head_x;
    const double phi_dot_P3_x_2 = -L3_omega*arm_L3_head_y + L3_vx - L7_omega*arm_L7_head_y - L7_vx;
    const double phi_P3_y_2 = L3_y - L7_y + arm_L3_head_y + arm_L7_head_y;
    const double phi_dot_P3_y_2 = L3_omega*arm_L3_head_x + L3_vy + L7_omega*arm_L7_head_x - L7_vy;
    const double phi_Q6_x_2 = -L6_x + L7_x - arm_L6_head_x + arm_L7_head_x;
    const double phi_dot_Q6_x_2 = L6_omega*arm_L6_head_y - L6_vx - L7_omega*arm_L7_head_y + L7_vx;
    const double phi_Q6_y_2 = -L6_y + L7_y - arm_L6_head_y + arm_L7_head_y;
    const double phi_dot_Q6_y_2 = -L6_omega*arm_L6_head_x - L6_vy + L7_omega*arm_L7_head_x + L7_vy;
    const double phi_Q8_x_2 = L7_x - L8_x + arm_L7_head_x + arm_L8_head_x;
    const double phi_dot_Q8_x_2 = -L7_omega*arm_L7_head_y + L7_vx - L8_omega*arm_L8_head_y - L8_vx;
    const double phi_Q8_y_2 = L7_y - L8_y + arm_L7_head_y + arm_L8_head_y;
    const double phi_dot_Q8_y_2 = L7_omega*arm_L7_head_x + L7_vy + L8_omega*arm_L8_head_x - L8_vy;
    const double phi_O6_x_2 = -L6_x + O6_x + arm_L6_head_x;
    const double phi_dot_O6_x_2 = -L6_omega*arm_L6_head_y - L6_vx;
    const double phi_O6_y_2 = -L6_y + arm_L6_head_y;
    const double phi_dot_O6_y_2 = L6_omega*arm_L6_head_x - L6_vy;
    const double phi_slider_x_2 = L8_x - S9_x + arm_L8_head_x;
    const double phi_dot_slider_x_2 = -L8_omega*arm_L8_head_y + L8_vx - S9_vx;
    const double phi_slider_y_2 = L8_y - S9_y + arm_L8_head_y;
    const double phi_dot_slider_y_2 = L8_omega*arm_L8_head_x + L8_vy - S9_vy;
    const double phi_guide_offset_2 = O6_x - S9_x;
    const double phi_dot_guide_offset_2 = -S9_vx;
    const double phi_guide_angle_2 = S9_theta - 0.5*3.141592653589793;
    const double phi_dot_guide_angle_2 = S9_omega;
    const double phi_crank1_2 = L1_theta - crank1_value;
    const double phi_dot_crank1_2 = L1_omega - crank1_rate;
    const double phi_crank4_2 = L4_theta - crank4_value;
    const double phi_dot_crank4_2 = L4_omega - crank4_rate;

    /* L D L^T of the KKT matrix */
    const double scale_guide_angle_3 = inverse_S9_inertia;
    if (!(scale_guide_angle_3 > 1e-13 * scale_guide_angle_3)) return 1;
    const double inverse_pivot_guide_angle_3 = 1.0/scale_guide_angle_3;
    const double l_P2_x__L2_theta_3 = -arm_L2_head_y*inverse_L2_inertia;
    const double l_P2_y__L2_theta_3 = arm_L2_head_x*inverse_L2_inertia;
    const double l_P3_x__L3_theta_3 = -arm_L3_head_y*inverse_L3_inertia;
    const double l_P3_y__L3_theta_3 = arm_L3_head_x*inverse_L3_inertia;
    const double scale_guide_offset_3 = inverse_S9_mass;
    if (!(scale_guide_offset_3 > 1e-13 * scale_guide_offset_3)) return 2;
    const double inverse_pivot_guide_offset_3 = 1.0/scale_guide_offset_3;
    const double l_slider_x__guide_offset_3 = inverse_S9_mass*inverse_pivot_guide_offset_3;
    const double l_O1_x__L1_theta_3 = -arm_L1_head_y*inverse_L1_inertia;
    const double l_O1_y__L1_theta_3 = arm_L1_head_x*inverse_L1_inertia;
    const double scale_O1_x_3 = -arm_L1_head_y*l_O1_x__L1_theta_3 + inverse_L1_mass;
    if (!(scale_O1_x_3 > 1e-13 * scale_O1_x_3)) return 3;
    const double inverse_pivot_O1_x_3 = 1.0/scale_O1_x_3;
    const double w_O1_y__O1_x_2 = arm_L1_head_y*l_O1_y__L1_theta_3;
    const double l_O1_y__O1_x_3 = -inverse_pivot_O1_x_3*w_O1_y__O1_x_2;
    const double w_crank1__O1_x_2 = arm_L1_head_y*inverse_L1_inertia;
    const double l_crank1__O1_x_3 = -inverse_pivot_O1_x_3*w_crank1__O1_x_2;
    const double scale_O1_y_3 = arm_L1_head_x*l_O1_y__L1_theta_3 + inverse_L1_mass;
    const double pivot_O1_y_3 = l_O1_y__O1_x_3*w_O1_y__O1_x_2 + scale_O1_y_3;
    if (!(pivot_O1_y_3 > 1e-13 * scale_O1_y_3)) return 4;
    const double inverse_pivot_O1_y_3 = 1.0/pivot_O1_y_3;
    const double w_crank1__O1_y_2 = -arm_L1_head_x*inverse_L1_inertia - l_crank1__O1_x_3*w_O1_y__O1_x_2;
    const double l_crank1__O1_y_3 = -inverse_pivot_O1_y_3*w_crank1__O1_y_2;
    const double scale_crank1_3 = inverse_L1_inertia;
    const double pivot_crank1_3 = l_crank1__O1_x_3*w_crank1__O1_x_2 + l_crank1__O1_y_3*w_crank1__O1_y_2 +
        scale_crank1_3;
    if (!(pivot_crank1_3 > 1e-13 * scale_crank1_3)) return 5;
    const double inverse_pivot_crank1_3 = 1.0/pivot_crank1_3;
    const double l_O4_x__L4_theta_3 = -arm_L4_head_y*inverse_L4_inertia;
    const double l_O4_y__L4_theta_3 = arm_L4_head_x*inverse_L4_inertia;
    const double scale_O4_x_3 = -arm_L4_head_y*l_O4_x__L4_theta_3 + inverse_L4_mass;
    if (!(scale_O4_x_3 > 1e-13 * scale_O4_x_3)) return 6;
    const double inverse_pivot_O4_x_3 = 1.0/scale_O4_x_3;
    const double w_O4_y__O4_x_2 = arm_L4_head_y*l_O4_y__L4_theta_3;
    const double l_O4_y__O4_x_3 = -inverse_pivot_O4_x_3*w_O4_y__O4_x_2;
    const double w_crank4__O4_x_2 = arm_L4_head_y*inverse_L4_inertia;
    const double l_crank4__O4_x_3 = -inverse_pivot_O4_x_3*w_crank4__O4_x_2;
    const double scale_O4_y_3 = arm_L4_head_x*l_O4_y__L4_theta_3 + inverse_L4_mass;
    const double pivot_O4_y_3 = l_O4_y__O4_x_3*w_O4_y__O4_x_2 + scale_O4_y_3;
    if (!(pivot_O4_y_3 > 1e-13 * scale_O4_y_3)) return 7;
    const double inverse_pivot_O4_y_3 = 1.0/pivot_O4_y_3;
    const double w_crank4__O4_y_2 = -arm_L4_head_x*inverse_L4_inertia - l_crank4__O4_x_3*w_O4_y__O4_x_2;
    const double l_crank4__O4_y_3 = -inverse_pivot_O4_y_3*w_crank4__O4_y_2;
    const double scale_crank4_3 = inverse_L4_inertia;
    const double pivot_crank4_3 = l_crank4__O4_x_3*w_crank4__O4_x_2 + l_crank4__O4_y_3*w_crank4__O4_y_2 +
        scale_crank4_3;
    if (!(pivot_crank4_3 > 1e-13 * scale_crank4_3)) return 8;
    const double inverse_pivot_crank4_3 = 1.0/pivot_crank4_3;
    const double l_O6_x__L6_theta_3 = -arm_L6_head_y*inverse_L6_inertia;
    const double l_O6_y__L6_theta_3 = arm_L6_head_x*inverse_L6_inertia;
    const double l_Q6_x__L6_theta_3 = arm_L6_head_y*inverse_L6_inertia;
    const double l_Q6_y__L6_theta_3 = -arm_L6_head_x*inverse_L6_inertia;
    const double scale_O6_x_3 = -arm_L6_head_y*l_O6_x__L6_theta_3 + inverse_L6_mass;
    if (!(scale_O6_x_3 > 1e-13 * scale_O6_x_3)) return 9;
    const double inverse_pivot_O6_x_3 = 1.0/scale_O6_x_3;
    const double w_O6_y__O6_x_2 = arm_L6_head_y*l_O6_y__L6_theta_3;
    const double l_O6_y__O6_x_3 = -inverse_pivot_O6_x_3*w_O6_y__O6_x_2;
    const double w_Q6_x__O6_x_2 = arm_L6_head_y*l_Q6_x__L6_theta_3 - inverse_L6_mass;
    const double l_Q6_x__O6_x_3 = -inverse_pivot_O6_x_3*w_Q6_x__O6_x_2;
    const double w_Q6_y__O6_x_2 = arm_L6_head_y*l_Q6_y__L6_theta_3;
    const double l_Q6_y__O6_x_3 = -inverse_pivot_O6_x_3*w_Q6_y__O6_x_2;
    const double scale_O6_y_3 = arm_L6_head_x*l_O6_y__L6_theta_3 + inverse_L6_mass;
    const double pivot_O6_y_3 = l_O6_y__O6_x_3*w_O6_y__O6_x_2 + scale_O6_y_3;
    if (!(pivot_O6_y_3 > 1e-13 * scale_O6_y_3)) return 10;
    const double inverse_pivot_O6_y_3 = 1.0/pivot_O6_y_3;
    const double w_Q6_x__O6_y_2 = -arm_L6_head_x*l_Q6_x__L6_theta_3 - l_Q6_x__O6_x_3*w_O6_y__O6_x_2;
    const double l_Q6_x__O6_y_3 = -inverse_pivot_O6_y_3*w_Q6_x__O6_y_2;
    const double w_Q6_y__O6_y_2 = -arm_L6_head_x*l_Q6_y__L6_theta_3 - inverse_L6_mass -
        l_Q6_y__O6_x_3*w_O6_y__O6_x_2;
    const double l_Q6_y__O6_y_3 = -inverse_pivot_O6_y_3*w_Q6_y__O6_y_2;
    const double l_slider_x__L8_theta_3 = -arm_L8_head_y*inverse_L8_inertia;
    const double l_slider_y__L8_theta_3 = arm_L8_head_x*inverse_L8_inertia;
    const double l_Q8_x__L8_theta_3 = -arm_L8_head_y*inverse_L8_inertia;
    const double l_Q8_y__L8_theta_3 = arm_L8_head_x*inverse_L8_inertia;
    const double scale_slider_x_3 = -arm_L8_head_y*l_slider_x__L8_theta_3 + inverse_L8_mass + inverse_S9_mass;
    const double pivot_slider_x_3 = -inverse_S9_mass*l_slider_x__guide_offset_3 + scale_slider_x_3;
    if (!(pivot_slider_x_3 > 1e-13 * scale_slider_x_3)) return 11;
    const double inverse_pivot_slider_x_3 = 1.0/pivot_slider_x_3;
    const double w_slider_y__slider_x_2 = arm_L8_head_y*l_slider_y__L8_theta_3;
    const double l_slider_y__slider_x_3 = -inverse_pivot_slider_x_3*w_slider_y__slider_x_2;
    const double w_Q8_x__slider_x_2 = arm_L8_head_y*l_Q8_x__L8_theta_3 + inverse_L8_mass;
    const double l_Q8_x__slider_x_3 = -inverse_pivot_slider_x_3*w_Q8_x__slider_x_2;
    const double w_Q8_y__slider_x_2 = arm_L8_head_y*l_Q8_y__L8_theta_3;
    const double l_Q8_y__slider_x_3 = -inverse_pivot_slider_x_3*w_Q8_y__slider_x_2;
    const double scale_slider_y_3 = arm_L8_head_x*l_slider_y__L8_theta_3 + inverse_L8_mass + inverse_S9_mass;
    const double pivot_slider_y_3 = l_slider_y__slider_x_3*w_slider_y__slider_x_2 + scale_slider_y_3;
    if (!(pivot_slider_y_3 > 1e-13 * scale_slider_y_3)) return 12;
    const double inverse_pivot_slider_y_3 = 1.0/pivot_slider_y_3;
    const double w_Q8_x__slider_y_2 = -arm_L8_head_x*l_Q8_x__L8_theta_3 -
        l_Q8_x__slider_x_3*w_slider_y__slider_x_2;
    const double l_Q8_x__slider_y_3 = -inverse_pivot_slider_y_3*w_Q8_x__slider_y_2;
    const double w_Q8_y__slider_y_2 = -arm_L8_head_x*l_Q8_y__L8_theta_3 + inverse_L8_mass -
        l_Q8_y__slider_x_3*w_slider_y__slider_x_2;
    const double l_Q8_y__slider_y_3 = -inverse_pivot_slider_y_3*w_Q8_y__slider_y_2;
    const double l_P2_x__L7_theta_3 = -arm_L7_head_y*inverse_L7_inertia;
    const double l_P2_y__L7_theta_3 = arm_L7_head_x*inverse_L7_inertia;
    const double l_P3_x__L7_theta_3 = -arm_L7_head_y*inverse_L7_inertia;
    const double l_P3_y__L7_theta_3 = arm_L7_head_x*inverse_L7_inertia;
    const double l_Q6_x__L7_theta_3 = -arm_L7_head_y*inverse_L7_inertia;
    const double l_Q6_y__L7_theta_3 = arm_L7_head_x*inverse_L7_inertia;
    const double l_Q8_x__L7_theta_3 = -arm_L7_head_y*inverse_L7_inertia;
    const double l_Q8_y__L7_theta_3 = arm_L7_head_x*inverse_L7_inertia;
    const double scale_P2_x_3 = -arm_L2_head_y*l_P2_x__L2_theta_3 - arm_L7_head_y*l_P2_x__L7_theta_3 +
        inverse_L2_mass + inverse_L7_mass;
    if (!(scale_P2_x_3 > 1e-13 * scale_P2_x_3)) return 13;
    const double inverse_pivot_P2_x_3 = 1.0/scale_P2_x_3;
    const double w_P2_y__P2_x_2 = arm_L2_head_y*l_P2_y__L2_theta_3 + arm_L7_head_y*l_P2_y__L7_theta_3;
    const double l_P2_y__P2_x_3 = -inverse_pivot_P2_x_3*w_P2_y__P2_x_2;
    const double w_P3_x__P2_x_2 = arm_L7_head_y*l_P3_x__L7_theta_3 - inverse_L7_mass;
    const double l_P3_x__P2_x_3 = -inverse_pivot_P2_x_3*w_P3_x__P2_x_2;
    const double w_P3_y__P2_x_2 = arm_L7_head_y*l_P3_y__L7_theta_3;
    const double l_P3_y__P2_x_3 = -inverse_pivot_P2_x_3*w_P3_y__P2_x_2;
    const double w_Q6_x__P2_x_2 = arm_L7_head_y*l_Q6_x__L7_theta_3 + inverse_L7_mass;
    const double l_Q6_x__P2_x_3 = -inverse_pivot_P2_x_3*w_Q6_x__P2_x_2;
    const double w_Q6_y__P2_x_2 = arm_L7_head_y*l_Q6_y__L7_theta_3;
    const double l_Q6_y__P2_x_3 = -inverse_pivot_P2_x_3*w_Q6_y__P2_x_2;
    const double w_Q8_x__P2_x_2 = arm_L7_head_y*l_Q8_x__L7_theta_3 + inverse_L7_mass;
    const double l_Q8_x__P2_x_3 = -inverse_pivot_P2_x_3*w_Q8_x__P2_x_2;
    const double w_Q8_y__P2_x_2 = arm_L7_head_y*l_Q8_y__L7_theta_3;
    const double l_Q8_y__P2_x_3 = -inverse_pivot_P2_x_3*w_Q8_y__P2_x_2;
    const double scale_P2_y_3 = arm_L2_head_x*l_P2_y__L2_theta_3 + arm_L7_head_x*l_P2_y__L7_theta_3 +
        inverse_L2_mass + inverse_L7_mass;
    const double pivot_P2_y_3 = l_P2_y__P2_x_3*w_P2_y__P2_x_2 + scale_P2_y_3;
    if (!(pivot_P2_y_3 > 1e-13 * scale_P2_y_3)) return 14;
    const double inverse_pivot_P2_y_3 = 1.0/pivot_P2_y_3;
    const double w_P3_x__P2_y_2 = -arm_L7_head_x*l_P3_x__L7_theta_3 - l_P3_x__P2_x_3*w_P2_y__P2_x_2;
    const double l_P3_x__P2_y_3 = -inverse_pivot_P2_y_3*w_P3_x__P2_y_2;
    const double w_P3_y__P2_y_2 = -arm_L7_head_x*l_P3_y__L7_theta_3 - inverse_L7_mass -
        l_P3_y__P2_x_3*w_P2_y__P2_x_2;
    const double l_P3_y__P2_y_3 = -inverse_pivot_P2_y_3*w_P3_y__P2_y_2;
    const double w_Q6_x__P2_y_2 = -arm_L7_head_x*l_Q6_x__L7_theta_3 - l_Q6_x__P2_x_3*w_P2_y__P2_x_2;
    const double l_Q6_x__P2_y_3 = -inverse_pivot_P2_y_3*w_Q6_x__P2_y_2;
    const double w_Q6_y__P2_y_2 = -arm_L7_head_x*l_Q6_y__L7_theta_3 + inverse_L7_mass -
        l_Q6_y__P2_x_3*w_P2_y__P2_x_2;
    const double l_Q6_y__P2_y_3 = -inverse_pivot_P2_y_3*w_Q6_y__P2_y_2;
    const double w_Q8_x__P2_y_2 = -arm_L7_head_x*l_Q8_x__L7_theta_3 - l_Q8_x__P2_x_3*w_P2_y__P2_x_2;
    const double l_Q8_x__P2_y_3 = -inverse_pivot_P2_y_3*w_Q8_x__P2_y_2;
    const double w_Q8_y__P2_y_2 = -arm_L7_head_x*l_Q8_y__L7_theta_3 + inverse_L7_mass -
        l_Q8_y__P2_x_3*w_P2_y__P2_x_2;
    const double l_Q8_y__P2_y_3 = -inverse_pivot_P2_y_3*w_Q8_y__P2_y_2;
    const double scale_P3_x_3 = -arm_L3_head_y*l_P3_x__L3_theta_3 - arm_L7_head_y*l_P3_x__L7_theta_3 +
        inverse_L3_mass + inverse_L7_mass;
    const double pivot_P3_x_3 = l_P3_x__P2_x_3*w_P3_x__P2_x_2 + l_P3_x__P2_y_3*w_P3_x__P2_y_2 + scale_P3_x_3;
    if (!(pivot_P3_x_3 > 1e-13 * scale_P3_x_3)) return 15;
    const double inverse_pivot_P3_x_3 = 1.0/pivot_P3_x_3;
    const double w_P3_y__P3_x_2 = arm_L3_head_y*l_P3_y__L3_theta_3 + arm_L7_head_y*l_P3_y__L7_theta_3 -
        l_P3_y__P2_x_3*w_P3_x__P2_x_2 - l_P3_y__P2_y_3*w_P3_x__P2_y_2;
    const double l_P3_y__P3_x_3 = -inverse_pivot_P3_x_3*w_P3_y__P3_x_2;
    const double w_Q6_x__P3_x_2 = arm_L7_head_y*l_Q6_x__L7_theta_3 + inverse_L7_mass -
        l_Q6_x__P2_x_3*w_P3_x__P2_x_2 - l_Q6_x__P2_y_3*w_P3_x__P2_y_2;
    const double l_Q6_x__P3_x_3 = -inverse_pivot_P3_x_3*w_Q6_x__P3_x_2;
    const double w_Q6_y__P3_x_2 = arm_L7_head_y*l_Q6_y__L7_theta_3 - l_Q6_y__P2_x_3*w_P3_x__P2_x_2 -
        l_Q6_y__P2_y_3*w_P3_x__P2_y_2;
    const double l_Q6_y__P3_x_3 = -inverse_pivot_P3_x_3*w_Q6_y__P3_x_2;
    const double w_Q8_x__P3_x_2 = arm_L7_head_y*l_Q8_x__L7_theta_3 + inverse_L7_mass -
        l_Q8_x__P2_x_3*w_P3_x__P2_x_2 - l_Q8_x__P2_y_3*w_P3_x__P2_y_2;
    const double l_Q8_x__P3_x_3 = -inverse_pivot_P3_x_3*w_Q8_x__P3_x_2;
    const double w_Q8_y__P3_x_2 = arm_L7_head_y*l_Q8_y__L7_theta_3 - l_Q8_y__P2_x_3*w_P3_x__P2_x_2 -
        l_Q8_y__P2_y_3*w_P3_x__P2_y_2;
    const double l_Q8_y__P3_x_3 = -inverse_pivot_P3_x_3*w_Q8_y__P3_x_2;
    const double scale_P3_y_3 = arm_L3_head_x*l_P3_y__L3_theta_3 + arm_L7_head_x*l_P3_y__L7_theta_3 +
        inverse_L3_mass + inverse_L7_mass;
    const double pivot_P3_y_3 = l_P3_y__P2_x_3*w_P3_y__P2_x_2 + l_P3_y__P2_y_3*w_P3_y__P2_y_2 +
        l_P3_y__P3_x_3*w_P3_y__P3_x_2 + scale_P3_y_3;
    if (!(pivot_P3_y_3 > 1e-13 * scale_P3_y_3)) return 16;
    const double inverse_pivot_P3_y_3 = 1.0/pivot_P3_y_3;
    const double w_Q6_x__P3_y_2 = -arm_L7_head_x*l_Q6_x__L7_theta_3 - l_Q6_x__P2_x_3*w_P3_y__P2_x_2 -
        l_Q6_x__P2_y_3*w_P3_y__P2_y_2 - l_Q6_x__P3_x_3*w_P3_y__P3_x_2;
    const double l_Q6_x__P3_y_3 = -inverse_pivot_P3_y_3*w_Q6_x__P3_y_2;
    const double w_Q6_y__P3_y_2 = -arm_L7_head_x*l_Q6_y__L7_theta_3 + inverse_L7_mass -
        l_Q6_y__P2_x_3*w_P3_y__P2_x_2 - l_Q6_y__P2_y_3*w_P3_y__P2_y_2 - l_Q6_y__P3_x_3*w_P3_y__P3_x_2;
    const double l_Q6_y__P3_y_3 = -inverse_pivot_P3_y_3*w_Q6_y__P3_y_2;
    const double w_Q8_x__P3_y_2 = -arm_L7_head_x*l_Q8_x__L7_theta_3 - l_Q8_x__P2_x_3*w_P3_y__P2_x_2 -
        l_Q8_x__P2_y_3*w_P3_y__P2_y_2 - l_Q8_x__P3_x_3*w_P3_y__P3_x_2;
    const double l_Q8_x__P3_y_3 = -inverse_pivot_P3_y_3*w_Q8_x__P3_y_2;
    const double w_Q8_y__P3_y_2 = -arm_L7_head_x*l_Q8_y__L7_theta_3 + inverse_L7_mass -
        l_Q8_y__P2_x_3*w_P3_y__P2_x_2 - l_Q8_y__P2_y_3*w_P3_y__P2_y_2 - l_Q8_y__P3_x_3*w_P3_y__P3_x_2;
    const double l_Q8_y__P3_y_3 = -inverse_pivot_P3_y_3*w_Q8_y__P3_y_2;
    const double scale_Q6_x_3 = arm_L6_head_y*l_Q6_x__L6_theta_3 - arm_L7_head_y*l_Q6_x__L7_theta_3 +
        inverse_L6_mass + inverse_L7_mass;
    const double pivot_Q6_x_3 = l_Q6_x__O6_x_3*w_Q6_x__O6_x_2 + l_Q6_x__O6_y_3*w_Q6_x__O6_y_2 +
        l_Q6_x__P2_x_3*w_Q6_x__P2_x_2 + l_Q6_x__P2_y_3*w_Q6_x__P2_y_2 + l_Q6_x__P3_x_3*w_Q6_x__P3_x_2 +
        l_Q6_x__P3_y_3*w_Q6_x__P3_y_2 + scale_Q6_x_3;
    if (!(pivot_Q6_x_3 > 1e-13 * scale_Q6_x_3)) return 17;
    const double inverse_pivot_Q6_x_3 = 1.0/pivot_Q6_x_3;
    const double w_Q6_y__Q6_x_2 = -arm_L6_head_y*l_Q6_y__L6_theta_3 + arm_L7_head_y*l_Q6_y__L7_theta_3 -
        l_Q6_y__O6_x_3*w_Q6_x__O6_x_2 - l_Q6_y__O6_y_3*w_Q6_x__O6_y_2 - l_Q6_y__P2_x_3*w_Q6_x__P2_x_2 -
        l_Q6_y__P2_y_3*w_Q6_x__P2_y_2 - l_Q6_y__P3_x_3*w_Q6_x__P3_x_2 - l_Q6_y__P3_y_3*w_Q6_x__P3_y_2;
    const double l_Q6_y__Q6_x_3 = -inverse_pivot_Q6_x_3*w_Q6_y__Q6_x_2;
    const double w_Q8_x__Q6_x_2 = arm_L7_head_y*l_Q8_x__L7_theta_3 - inverse_L7_mass -
        l_Q8_x__P2_x_3*w_Q6_x__P2_x_2 - l_Q8_x__P2_y_3*w_Q6_x__P2_y_2 - l_Q8_x__P3_x_3*w_Q6_x__P3_x_2 -
        l_Q8_x__P3_y_3*w_Q6_x__P3_y_2;
    const double l_Q8_x__Q6_x_3 = -inverse_pivot_Q6_x_3*w_Q8_x__Q6_x_2;
    const double w_Q8_y__Q6_x_2 = arm_L7_head_y*l_Q8_y__L7_theta_3 - l_Q8_y__P2_x_3*w_Q6_x__P2_x_2 -
        l_Q8_y__P2_y_3*w_Q6_x__P2_y_2 - l_Q8_y__P3_x_3*w_Q6_x__P3_x_2 - l_Q8_y__P3_y_3*w_Q6_x__P3_y_2;
    const double l_Q8_y__Q6_x_3 = -inverse_pivot_Q6_x_3*w_Q8_y__Q6_x_2;
    const double scale_Q6_y_3 = -arm_L6_head_x*l_Q6_y__L6_theta_3 + arm_L7_head_x*l_Q6_y__L7_theta_3 +
        inverse_L6_mass + inverse_L7_mass;
    const double pivot_Q6_y_3 = l_Q6_y__O6_x_3*w_Q6_y__O6_x_2 + l_Q6_y__O6_y_3*w_Q6_y__O6_y_2 +
        l_Q6_y__P2_x_3*w_Q6_y__P2_x_2 + l_Q6_y__P2_y_3*w_Q6_y__P2_y_2 + l_Q6_y__P3_x_3*w_Q6_y__P3_x_2 +
        l_Q6_y__P3_y_3*w_Q6_y__P3_y_2 + l_Q6_y__Q6_x_3*w_Q6_y__Q6_x_2 + scale_Q6_y_3;
    if (!(pivot_Q6_y_3 > 1e-13 * scale_Q6_y_3)) return 18;
    const double inverse_pivot_Q6_y_3 = 1.0/pivot_Q6_y_3;
    const double w_Q8_x__Q6_y_2 = -arm_L7_head_x*l_Q8_x__L7_theta_3 - l_Q8_x__P2_x_3*w_Q6_y__P2_x_2 -
        l_Q8_x__P2_y_3*w_Q6_y__P2_y_2 - l_Q8_x__P3_x_3*w_Q6_y__P3_x_2 - l_Q8_x__P3_y_3*w_Q6_y__P3_y_2 -
        l_Q8_x__Q6_x_3*w_Q6_y__Q6_x_2;
    const double l_Q8_x__Q6_y_3 = -inverse_pivot_Q6_y_3*w_Q8_x__Q6_y_2;
    const double w_Q8_y__Q6_y_2 = -arm_L7_head_x*l_Q8_y__L7_theta_3 - inverse_L7_mass -
        l_Q8_y__P2_x_3*w_Q6_y__P2_x_2 - l_Q8_y__P2_y_3*w_Q6_y__P2_y_2 - l_Q8_y__P3_x_3*w_Q6_y__P3_x_2 -
        l_Q8_y__P3_y_3*w_Q6_y__P3_y_2 - l_Q8_y__Q6_x_3*w_Q6_y__Q6_x_2;
    const double l_Q8_y__Q6_y_3 = -inverse_pivot_Q6_y_3*w_Q8_y__Q6_y_2;
    const double scale_Q8_x_3 = -arm_L7_head_y*l_Q8_x__L7_theta_3 - arm_L8_head_y*l_Q8_x__L8_theta_3 +
        inverse_L7_mass + inverse_L8_mass;
    const double pivot_Q8_x_3 = l_Q8_x__P2_x_3*w_Q8_x__P2_x_2 + l_Q8_x__P2_y_3*w_Q8_x__P2_y_2 +
        l_Q8_x__P3_x_3*w_Q8_x__P3_x_2 + l_Q8_x__P3_y_3*w_Q8_x__P3_y_2 + l_Q8_x__Q6_x_3*w_Q8_x__Q6_x_2 +
        l_Q8_x__Q6_y_3*w_Q8_x__Q6_y_2 + l_Q8_x__slider_x_3*w_Q8_x__slider_x_2 +
        l_Q8_x__slider_y_3*w_Q8_x__slider_y_2 + scale_Q8_x_3;
    if (!(pivot_Q8_x_3 > 1e-13 * scale_Q8_x_3)) return 19;
    const double inverse_pivot_Q8_x_3 = 1.0/pivot_Q8_x_3;
    const double w_Q8_y__Q8_x_2 = arm_L7_head_y*l_Q8_y__L7_theta_3 + arm_L8_head_y*l_Q8_y__L8_theta_3 -
        l_Q8_y__P2_x_3*w_Q8_x__P2_x_2 - l_Q8_y__P2_y_3*w_Q8_x__P2_y_2 - l_Q8_y__P3_x_3*w_Q8_x__P3_x_2 -
        l_Q8_y__P3_y_3*w_Q8_x__P3_y_2 - l_Q8_y__Q6_x_3*w_Q8_x__Q6_x_2 - l_Q8_y__Q6_y_3*w_Q8_x__Q6_y_2 -
        l_Q8_y__slider_x_3*w_Q8_x__slider_x_2 - l_Q8_y__slider_y_3*w_Q8_x__slider_y_2;
    const double l_Q8_y__Q8_x_3 = -inverse_pivot_Q8_x_3*w_Q8_y__Q8_x_2;
    const double scale_Q8_y_3 = arm_L7_head_x*l_Q8_y__L7_theta_3 + arm_L8_head_x*l_Q8_y__L8_theta_3 +
        inverse_L7_mass + inverse_L8_mass;
    const double pivot_Q8_y_3 = l_Q8_y__P2_x_3*w_Q8_y__P2_x_2 + l_Q8_y__P2_y_3*w_Q8_y__P2_y_2 +
        l_Q8_y__P3_x_3*w_Q8_y__P3_x_2 + l_Q8_y__P3_y_3*w_Q8_y__P3_y_2 + l_Q8_y__Q6_x_3*w_Q8_y__Q6_x_2 +
        l_Q8_y__Q6_y_3*w_Q8_y__Q6_y_2 + l_Q8_y__Q8_x_3*w_Q8_y__Q8_x_2 + l_Q8_y__slider_x_3*w_Q8_y__slider_x_2
        + l_Q8_y__slider_y_3*w_Q8_y__slider_y_2 + scale_Q8_y_3;
    if (!(pivot_Q8_y_3 > 1e-13 * scale_Q8_y_3)) return 20;
    const double inverse_pivot_Q8_y_3 = 1.0/pivot_Q8_y_3;

    /* forward substitution */
    const double dq_z_O1_y = -l_O1_y__O1_x_3*phi_O1_x_2 + phi_O1_y_2;
    const double dq_z_crank1 = -dq_z_O1_y*l_crank1__O1_y_3 - l_crank1__O1_x_3*phi_O1_x_2 + phi_crank1_2;
    const double dq_z_O4_y = -l_O4_y__O4_x_3*phi_O4_x_2 + phi_O4_y_2;
    const double dq_z_crank4 = -dq_z_O4_y*l_crank4__O4_y_3 - l_crank4__O4_x_3*phi_O4_x_2 + phi_crank4_2;
    const double dq_z_O6_y = -l_O6_y__O6_x_3*phi_O6_x_2 + phi_O6_y_2;
    const double dq_z_slider_x = -l_slider_x__guide_offset_3*phi_guide_offset_2 + phi_slider_x_2;
    const double dq_z_slider_y = -dq_z_slider_x*l_slider_y__slider_x_3 + phi_slider_y_2;
    const double dq_z_P2_y = -l_P2_y__P2_x_3*phi_P2_x_2 + phi_P2_y_2;
    const double dq_z_P3_x = -dq_z_P2_y*l_P3_x__P2_y_3 - l_P3_x__P2_x_3*phi_P2_x_2 + phi_P3_x_2;
    const double dq_z_P3_y = -dq_z_P2_y*l_P3_y__P2_y_3 - dq_z_P3_x*l_P3_y__P3_x_3 - l_P3_y__P2_x_3*phi_P2_x_2
        + phi_P3_y_2;
    const double dq_z_Q6_x = -dq_z_O6_y*l_Q6_x__O6_y_3 - dq_z_P2_y*l_Q6_x__P2_y_3 - dq_z_P3_x*l_Q6_x__P3_x_3 -
        dq_z_P3_y*l_Q6_x__P3_y_3 - l_Q6_x__O6_x_3*phi_O6_x_2 - l_Q6_x__P2_x_3*phi_P2_x_2 + phi_Q6_x_2;
    const double dq_z_Q6_y = -dq_z_O6_y*l_Q6_y__O6_y_3 - dq_z_P2_y*l_Q6_y__P2_y_3 - dq_z_P3_x*l_Q6_y__P3_x_3 -
        dq_z_P3_y*l_Q6_y__P3_y_3 - dq_z_Q6_x*l_Q6_y__Q6_x_3 - l_Q6_y__O6_x_3*phi_O6_x_2 -
        l_Q6_y__P2_x_3*phi_P2_x_2 + phi_Q6_y_2;
    const double dq_z_Q8_x = -dq_z_P2_y*l_Q8_x__P2_y_3 - dq_z_P3_x*l_Q8_x__P3_x_3 - dq_z_P3_y*l_Q8_x__P3_y_3 -
        dq_z_Q6_x*l_Q8_x__Q6_x_3 - dq_z_Q6_y*l_Q8_x__Q6_y_3 - dq_z_slider_x*l_Q8_x__slider_x_3 -
        dq_z_slider_y*l_Q8_x__slider_y_3 - l_Q8_x__P2_x_3*phi_P2_x_2 + phi_Q8_x_2;
    const double dq_z_Q8_y = -dq_z_P2_y*l_Q8_y__P2_y_3 - dq_z_P3_x*l_Q8_y__P3_x_3 - dq_z_P3_y*l_Q8_y__P3_y_3 -
        dq_z_Q6_x*l_Q8_y__Q6_x_3 - dq_z_Q6_y*l_Q8_y__Q6_y_3 - dq_z_Q8_x*l_Q8_y__Q8_x_3 -
        dq_z_slider_x*l_Q8_y__slider_x_3 - dq_z_slider_y*l_Q8_y__slider_y_3 - l_Q8_y__P2_x_3*phi_P2_x_2 +
        phi_Q8_y_2;

    /* backward substitution */
    const double dq_lambda_Q8_y = -dq_z_Q8_y*inverse_pivot_Q8_y_3;
    const double dq_lambda_Q8_x = -dq_lambda_Q8_y*l_Q8_y__Q8_x_3 - dq_z_Q8_x*inverse_pivot_Q8_x_3;
    const double dq_lambda_Q6_y = -dq_lambda_Q8_x*l_Q8_x__Q6_y_3 - dq_lambda_Q8_y*l_Q8_y__Q6_y_3 -
        dq_z_Q6_y*inverse_pivot_Q6_y_3;
    const double dq_lambda_Q6_x = -dq_lambda_Q6_y*l_Q6_y__Q6_x_3 - dq_lambda_Q8_x*l_Q8_x__Q6_x_3 -
        dq_lambda_Q8_y*l_Q8_y__Q6_x_3 - dq_z_Q6_x*inverse_pivot_Q6_x_3;
    const double dq_lambda_P3_y = -dq_lambda_Q6_x*l_Q6_x__P3_y_3 - dq_lambda_Q6_y*l_Q6_y__P3_y_3 -
        dq_lambda_Q8_x*l_Q8_x__P3_y_3 - dq_lambda_Q8_y*l_Q8_y__P3_y_3 - dq_z_P3_y*inverse_pivot_P3_y_3;
    const double dq_lambda_P3_x = -dq_lambda_P3_y*l_P3_y__P3_x_3 - dq_lambda_Q6_x*l_Q6_x__P3_x_3 -
        dq_lambda_Q6_y*l_Q6_y__P3_x_3 - dq_lambda_Q8_x*l_Q8_x__P3_x_3 - dq_lambda_Q8_y*l_Q8_y__P3_x_3 -
        dq_z_P3_x*inverse_pivot_P3_x_3;
    const double dq_lambda_P2_y = -dq_lambda_P3_x*l_P3_x__P2_y_3 - dq_lambda_P3_y*l_P3_y__P2_y_3 -
        dq_lambda_Q6_x*l_Q6_x__P2_y_3 - dq_lambda_Q6_y*l_Q6_y__P2_y_3 - dq_lambda_Q8_x*l_Q8_x__P2_y_3 -
        dq_lambda_Q8_y*l_Q8_y__P2_y_3 - dq_z_P2_y*inverse_pivot_P2_y_3;
    const double dq_lambda_P2_x = -dq_lambda_P2_y*l_P2_y__P2_x_3 - dq_lambda_P3_x*l_P3_x__P2_x_3 -
        dq_lambda_P3_y*l_P3_y__P2_x_3 - dq_lambda_Q6_x*l_Q6_x__P2_x_3 - dq_lambda_Q6_y*l_Q6_y__P2_x_3 -
        dq_lambda_Q8_x*l_Q8_x__P2_x_3 - dq_lambda_Q8_y*l_Q8_y__P2_x_3 - inverse_pivot_P2_x_3*phi_P2_x_2;
    const double dq_acceleration_L7_theta = -dq_lambda_P2_x*l_P2_x__L7_theta_3 -
        dq_lambda_P2_y*l_P2_y__L7_theta_3 - dq_lambda_P3_x*l_P3_x__L7_theta_3 -
        dq_lambda_P3_y*l_P3_y__L7_theta_3 - dq_lambda_Q6_x*l_Q6_x__L7_theta_3 -
        dq_lambda_Q6_y*l_Q6_y__L7_theta_3 - dq_lambda_Q8_x*l_Q8_x__L7_theta_3 -
        dq_lambda_Q8_y*l_Q8_y__L7_theta_3;
    const double dq_lambda_slider_y = -dq_lambda_Q8_x*l_Q8_x__slider_y_3 - dq_lambda_Q8_y*l_Q8_y__slider_y_3 -
        dq_z_slider_y*inverse_pivot_slider_y_3;
    const double dq_lambda_slider_x = -dq_lambda_Q8_x*l_Q8_x__slider_x_3 - dq_lambda_Q8_y*l_Q8_y__slider_x_3 -
        dq_lambda_slider_y*l_slider_y__slider_x_3 - dq_z_slider_x*inverse_pivot_slider_x_3;
    const double dq_acceleration_L8_theta = -dq_lambda_Q8_x*l_Q8_x__L8_theta_3 -
        dq_lambda_Q8_y*l_Q8_y__L8_theta_3 - dq_lambda_slider_x*l_slider_x__L8_theta_3 -
        dq_lambda_slider_y*l_slider_y__L8_theta_3;
    const double dq_acceleration_L7_y = dq_lambda_P2_y*inverse_L7_mass + dq_lambda_P3_y*inverse_L7_mass -
        dq_lambda_Q6_y*inverse_L7_mass - dq_lambda_Q8_y*inverse_L7_mass;
    const double dq_acceleration_L7_x = dq_lambda_P2_x*inverse_L7_mass + dq_lambda_P3_x*inverse_L7_mass -
        dq_lambda_Q6_x*inverse_L7_mass - dq_lambda_Q8_x*inverse_L7_mass;
    const double dq_lambda_O6_y = -dq_lambda_Q6_x*l_Q6_x__O6_y_3 - dq_lambda_Q6_y*l_Q6_y__O6_y_3 -
        dq_z_O6_y*inverse_pivot_O6_y_3;
    const double dq_lambda_O6_x = -dq_lambda_O6_y*l_O6_y__O6_x_3 - dq_lambda_Q6_x*l_Q6_x__O6_x_3 -
        dq_lambda_Q6_y*l_Q6_y__O6_x_3 - inverse_pivot_O6_x_3*phi_O6_x_2;
    const double dq_acceleration_L6_theta = -dq_lambda_O6_x*l_O6_x__L6_theta_3 -
        dq_lambda_O6_y*l_O6_y__L6_theta_3 - dq_lambda_Q6_x*l_Q6_x__L6_theta_3 -
        dq_lambda_Q6_y*l_Q6_y__L6_theta_3;
    const double dq_lambda_crank4 = -dq_z_crank4*inverse_pivot_crank4_3;
    const double dq_lambda_O4_y = -dq_lambda_crank4*l_crank4__O4_y_3 - dq_z_O4_y*inverse_pivot_O4_y_3;
    const double dq_lambda_O4_x = -dq_lambda_O4_y*l_O4_y__O4_x_3 - dq_lambda_crank4*l_crank4__O4_x_3 -
        inverse_pivot_O4_x_3*phi_O4_x_2;
    const double dq_acceleration_L4_theta = -dq_lambda_O4_x*l_O4_x__L4_theta_3 -
        dq_lambda_O4_y*l_O4_y__L4_theta_3 - dq_lambda_crank4*inverse_L4_inertia;
    const double dq_lambda_crank1 = -dq_z_crank1*inverse_pivot_crank1_3;
    const double dq_lambda_O1_y = -dq_lambda_crank1*l_crank1__O1_y_3 - dq_z_O1_y*inverse_pivot_O1_y_3;
    const double dq_lambda_O1_x = -dq_lambda_O1_y*l_O1_y__O1_x_3 - dq_lambda_crank1*l_crank1__O1_x_3 -
        inverse_pivot_O1_x_3*phi_O1_x_2;
    const double dq_acceleration_L1_theta = -dq_lambda_O1_x*l_O1_x__L1_theta_3 -
        dq_lambda_O1_y*l_O1_y__L1_theta_3 - dq_lambda_crank1*inverse_L1_inertia;
    const double dq_lambda_guide_offset = -dq_lambda_slider_x*l_slider_x__guide_offset_3 -
        inverse_pivot_guide_offset_3*phi_guide_offset_2;
    const double dq_acceleration_S9_x = dq_lambda_guide_offset*inverse_S9_mass +
        dq_lambda_slider_x*inverse_S9_mass;
    const double dq_acceleration_L8_y = dq_lambda_Q8_y*inverse_L8_mass - dq_lambda_slider_y*inverse_L8_mass;
    const double dq_acceleration_L8_x = dq_lambda_Q8_x*inverse_L8_mass - dq_lambda_slider_x*inverse_L8_mass;
    const double dq_acceleration_L6_y = dq_lambda_O6_y*inverse_L6_mass + dq_lambda_Q6_y*inverse_L6_mass;
    const double dq_acceleration_L6_x = dq_lambda_O6_x*inverse_L6_mass + dq_lambda_Q6_x*inverse_L6_mass;
    const double dq_acceleration_L3_theta = -dq_lambda_P3_x*l_P3_x__L3_theta_3 -
        dq_lambda_P3_y*l_P3_y__L3_theta_3;
    const double dq_acceleration_L2_theta = -dq_lambda_P2_x*l_P2_x__L2_theta_3 -
        dq_lambda_P2_y*l_P2_y__L2_theta_3;
    const double dq_lambda_guide_angle = -inverse_pivot_guide_angle_3*phi_guide_angle_2;
    const double dq_acceleration_S9_theta = -dq_lambda_guide_angle*inverse_S9_inertia;
    const double dq_acceleration_S9_y = dq_lambda_slider_y*inverse_S9_mass;
    const double dq_acceleration_L4_y = dq_lambda_O4_y*inverse_L4_mass;
    const double dq_acceleration_L4_x = dq_lambda_O4_x*inverse_L4_mass;
    const double dq_acceleration_L3_y = -dq_lambda_P3_y*inverse_L3_mass;
    const double dq_acceleration_L3_x = -dq_lambda_P3_x*inverse_L3_mass;
    const double dq_acceleration_L2_y = -dq_lambda_P2_y*inverse_L2_mass;
    const double dq_acceleration_L2_x = -dq_lambda_P2_x*inverse_L2_mass;
    const double dq_acceleration_L1_y = dq_lambda_O1_y*inverse_L1_mass;
    const double dq_acceleration_L1_x = dq_lambda_O1_x*inverse_L1_mass;

    /* forward substitution */
    const double dv_z_O1_y = -l_O1_y__O1_x_3*phi_dot_O1_x_2 + phi_dot_O1_y_2;
    const double dv_z_crank1 = -dv_z_O1_y*l_crank1__O1_y_3 - l_crank1__O1_x_3*phi_dot_O1_x_2 +
        phi_dot_crank1_2;
    const double dv_z_O4_y = -l_O4_y__O4_x_3*phi_dot_O4_x_2 + phi_dot_O4_y_2;
    const double dv_z_crank4 = -dv_z_O4_y*l_crank4__O4_y_3 - l_crank4__O4_x_3*phi_dot_O4_x_2 +
        phi_dot_crank4_2;
    const double dv_z_O6_y = -l_O6_y__O6_x_3*phi_dot_O6_x_2 + phi_dot_O6_y_2;
    const double dv_z_slider_x = -l_slider_x__guide_offset_3*phi_dot_guide_offset_2 + phi_dot_slider_x_2;
    const double dv_z_slider_y = -dv_z_slider_x*l_slider_y__slider_x_3 + phi_dot_slider_y_2;
    const double dv_z_P2_y = -l_P2_y__P2_x_3*phi_dot_P2_x_2 + phi_dot_P2_y_2;
    const double dv_z_P3_x = -dv_z_P2_y*l_P3_x__P2_y_3 - l_P3_x__P2_x_3*phi_dot_P2_x_2 + phi_dot_P3_x_2;
    const double dv_z_P3_y = -dv_z_P2_y*l_P3_y__P2_y_3 - dv_z_P3_x*l_P3_y__P3_x_3 -
        l_P3_y__P2_x_3*phi_dot_P2_x_2 + phi_dot_P3_y_2;
    const double dv_z_Q6_x = -dv_z_O6_y*l_Q6_x__O6_y_3 - dv_z_P2_y*l_Q6_x__P2_y_3 - dv_z_P3_x*l_Q6_x__P3_x_3 -
        dv_z_P3_y*l_Q6_x__P3_y_3 - l_Q6_x__O6_x_3*phi_dot_O6_x_2 - l_Q6_x__P2_x_3*phi_dot_P2_x_2 +
        phi_dot_Q6_x_2;
    const double dv_z_Q6_y = -dv_z_O6_y*l_Q6_y__O6_y_3 - dv_z_P2_y*l_Q6_y__P2_y_3 - dv_z_P3_x*l_Q6_y__P3_x_3 -
        dv_z_P3_y*l_Q6_y__P3_y_3 - dv_z_Q6_x*l_Q6_y__Q6_x_3 - l_Q6_y__O6_x_3*phi_dot_O6_x_2 -
        l_Q6_y__P2_x_3*phi_dot_P2_x_2 + phi_dot_Q6_y_2;
    const double dv_z_Q8_x = -dv_z_P2_y*l_Q8_x__P2_y_3 - dv_z_P3_x*l_Q8_x__P3_x_3 - dv_z_P3_y*l_Q8_x__P3_y_3 -
        dv_z_Q6_x*l_Q8_x__Q6_x_3 - dv_z_Q6_y*l_Q8_x__Q6_y_3 - dv_z_slider_x*l_Q8_x__slider_x_3 -
        dv_z_slider_y*l_Q8_x__slider_y_3 - l_Q8_x__P2_x_3*phi_dot_P2_x_2 + phi_dot_Q8_x_2;
    const double dv_z_Q8_y = -dv_z_P2_y*l_Q8_y__P2_y_3 - dv_z_P3_x*l_Q8_y__P3_x_3 - dv_z_P3_y*l_Q8_y__P3_y_3 -
        dv_z_Q6_x*l_Q8_y__Q6_x_3 - dv_z_Q6_y*l_Q8_y__Q6_y_3 - dv_z_Q8_x*l_Q8_y__Q8_x_3 -
        dv_z_slider_x*l_Q8_y__slider_x_3 - dv_z_slider_y*l_Q8_y__slider_y_3 - l_Q8_y__P2_x_3*phi_dot_P2_x_2 +
        phi_dot_Q8_y_2;

    /* backward substitution */
    const double dv_lambda_Q8_y = -dv_z_Q8_y*inverse_pivot_Q8_y_3;
    const double dv_lambda_Q8_x = -dv_lambda_Q8_y*l_Q8_y__Q8_x_3 - dv_z_Q8_x*inverse_pivot_Q8_x_3;
    const double dv_lambda_Q6_y = -dv_lambda_Q8_x*l_Q8_x__Q6_y_3 - dv_lambda_Q8_y*l_Q8_y__Q6_y_3 -
        dv_z_Q6_y*inverse_pivot_Q6_y_3;
    const double dv_lambda_Q6_x = -dv_lambda_Q6_y*l_Q6_y__Q6_x_3 - dv_lambda_Q8_x*l_Q8_x__Q6_x_3 -
        dv_lambda_Q8_y*l_Q8_y__Q6_x_3 - dv_z_Q6_x*inverse_pivot_Q6_x_3;
    const double dv_lambda_P3_y = -dv_lambda_Q6_x*l_Q6_x__P3_y_3 - dv_lambda_Q6_y*l_Q6_y__P3_y_3 -
        dv_lambda_Q8_x*l_Q8_x__P3_y_3 - dv_lambda_Q8_y*l_Q8_y__P3_y_3 - dv_z_P3_y*inverse_pivot_P3_y_3;
    const double dv_lambda_P3_x = -dv_lambda_P3_y*l_P3_y__P3_x_3 - dv_lambda_Q6_x*l_Q6_x__P3_x_3 -
        dv_lambda_Q6_y*l_Q6_y__P3_x_3 - dv_lambda_Q8_x*l_Q8_x__P3_x_3 - dv_lambda_Q8_y*l_Q8_y__P3_x_3 -
        dv_z_P3_x*inverse_pivot_P3_x_3;
    const double dv_lambda_P2_y = -dv_lambda_P3_x*l_P3_x__P2_y_3 - dv_lambda_P3_y*l_P3_y__P2_y_3 -
        dv_lambda_Q6_x*l_Q6_x__P2_y_3 - dv_lambda_Q6_y*l_Q6_y__P2_y_3 - dv_lambda_Q8_x*l_Q8_x__P2_y_3 -
        dv_lambda_Q8_y*l_Q8_y__P2_y_3 - dv_z_P2_y*inverse_pivot_P2_y_3;
    const double dv_lambda_P2_x = -dv_lambda_P2_y*l_P2_y__P2_x_3 - dv_lambda_P3_x*l_P3_x__P2_x_3 -
        dv_lambda_P3_y*l_P3_y__P2_x_3 - dv_lambda_Q6_x*l_Q6_x__P2_x_3 - dv_lambda_Q6_y*l_Q6_y__P2_x_3 -
        dv_lambda_Q8_x*l_Q8_x__P2_x_3 - dv_lambda_Q8_y*l_Q8_y__P2_x_3 - inverse_pivot_P2_x_3*phi_dot_P2_x_2;
    const double dv_acceleration_L7_theta = -dv_lambda_P2_x*l_P2_x__L7_theta_3 -
        dv_lambda_P2_y*l_P2_y__L7_theta_3 - dv_lambda_P3_x*l_P3_x__L7_theta_3 -
        dv_lambda_P3_y*l_P3_y__L7_theta_3 - dv_lambda_Q6_x*l_Q6_x__L7_theta_3 -
        dv_lambda_Q6_y*l_Q6_y__L7_theta_3 - dv_lambda_Q8_x*l_Q8_x__L7_theta_3 -
        dv_lambda_Q8_y*l_Q8_y__L7_theta_3;
    const double dv_lambda_slider_y = -dv_lambda_Q8_x*l_Q8_x__slider_y_3 - dv_lambda_Q8_y*l_Q8_y__slider_y_3 -
        dv_z_slider_y*inverse_pivot_slider_y_3;
    const double dv_lambda_slider_x = -dv_lambda_Q8_x*l_Q8_x__slider_x_3 - dv_lambda_Q8_y*l_Q8_y__slider_x_3 -
        dv_lambda_slider_y*l_slider_y__slider_x_3 - dv_z_slider_x*inverse_pivot_slider_x_3;
    const double dv_acceleration_L8_theta = -dv_lambda_Q8_x*l_Q8_x__L8_theta_3 -
        dv_lambda_Q8_y*l_Q8_y__L8_theta_3 - dv_lambda_slider_x*l_slider_x__L8_theta_3 -
        dv_lambda_slider_y*l_slider_y__L8_theta_3;
    const double dv_acceleration_L7_y = dv_lambda_P2_y*inverse_L7_mass + dv_lambda_P3_y*inverse_L7_mass -
        dv_lambda_Q6_y*inverse_L7_mass - dv_lambda_Q8_y*inverse_L7_mass;
    const double dv_acceleration_L7_x = dv_lambda_P2_x*inverse_L7_mass + dv_lambda_P3_x*inverse_L7_mass -
        dv_lambda_Q6_x*inverse_L7_mass - dv_lambda_Q8_x*inverse_L7_mass;
    const double dv_lambda_O6_y = -dv_lambda_Q6_x*l_Q6_x__O6_y_3 - dv_lambda_Q6_y*l_Q6_y__O6_y_3 -
        dv_z_O6_y*inverse_pivot_O6_y_3;
    const double dv_lambda_O6_x = -dv_lambda_O6_y*l_O6_y__O6_x_3 - dv_lambda_Q6_x*l_Q6_x__O6_x_3 -
        dv_lambda_Q6_y*l_Q6_y__O6_x_3 - inverse_pivot_O6_x_3*phi_dot_O6_x_2;
    const double dv_acceleration_L6_theta = -dv_lambda_O6_x*l_O6_x__L6_theta_3 -
        dv_lambda_O6_y*l_O6_y__L6_theta_3 - dv_lambda_Q6_x*l_Q6_x__L6_theta_3 -
        dv_lambda_Q6_y*l_Q6_y__L6_theta_3;
    const double dv_lambda_crank4 = -dv_z_crank4*inverse_pivot_crank4_3;
    const double dv_lambda_O4_y = -dv_lambda_crank4*l_crank4__O4_y_3 - dv_z_O4_y*inverse_pivot_O4_y_3;
    const double dv_lambda_O4_x = -dv_lambda_O4_y*l_O4_y__O4_x_3 - dv_lambda_crank4*l_crank4__O4_x_3 -
        inverse_pivot_O4_x_3*phi_dot_O4_x_2;
    const double dv_acceleration_L4_theta = -dv_lambda_O4_x*l_O4_x__L4_theta_3 -
        dv_lambda_O4_y*l_O4_y__L4_theta_3 - dv_lambda_crank4*inverse_L4_inertia;
    const double dv_lambda_crank1 = -dv_z_crank1*inverse_pivot_crank1_3;
    const double dv_lambda_O1_y = -dv_lambda_crank1*l_crank1__O1_y_3 - dv_z_O1_y*inverse_pivot_O1_y_3;
    const double dv_lambda_O1_x = -dv_lambda_O1_y*l_O1_y__O1_x_3 - dv_lambda_crank1*l_crank1__O1_x_3 -
        inverse_pivot_O1_x_3*phi_dot_O1_x_2;
    const double dv_acceleration_L1_theta = -dv_lambda_O1_x*l_O1_x__L1_theta_3 -
        dv_lambda_O1_y*l_O1_y__L1_theta_3 - dv_lambda_crank1*inverse_L1_inertia;
    const double dv_lambda_guide_offset = -dv_lambda_slider_x*l_slider_x__guide_offset_3 -
        inverse_pivot_guide_offset_3*phi_dot_guide_offset_2;
    const double dv_acceleration_S9_x = dv_lambda_guide_offset*inverse_S9_mass +
        dv_lambda_slider_x*inverse_S9_mass;
    const double dv_acceleration_L8_y = dv_lambda_Q8_y*inverse_L8_mass - dv_lambda_slider_y*inverse_L8_mass;
    const double dv_acceleration_L8_x = dv_lambda_Q8_x*inverse_L8_mass - dv_lambda_slider_x*inverse_L8_mass;
    const double dv_acceleration_L6_y = dv_lambda_O6_y*inverse_L6_mass + dv_lambda_Q6_y*inverse_L6_mass;
    const double dv_acceleration_L6_x = dv_lambda_O6_x*inverse_L6_mass + dv_lambda_Q6_x*inverse_L6_mass;
    const double dv_acceleration_L3_theta = -dv_lambda_P3_x*l_P3_x__L3_theta_3 -
        dv_lambda_P3_y*l_P3_y__L3_theta_3;
    const double dv_acceleration_L2_theta = -dv_lambda_P2_x*l_P2_x__L2_theta_3 -
        dv_lambda_P2_y*l_P2_y__L2_theta_3;
    const double dv_lambda_guide_angle = -inverse_pivot_guide_angle_3*phi_dot_guide_angle_2;
    const double dv_acceleration_S9_theta = -dv_lambda_guide_angle*inverse_S9_inertia;
    const double dv_acceleration_S9_y = dv_lambda_slider_y*inverse_S9_mass;
    const double dv_acceleration_L4_y = dv_lambda_O4_y*inverse_L4_mass;
    const double dv_acceleration_L4_x = dv_lambda_O4_x*inverse_L4_mass;
    const double dv_acceleration_L3_y = -dv_lambda_P3_y*inverse_L3_mass;
    const double dv_acceleration_L3_x = -dv_lambda_P3_x*inverse_L3_mass;
    const double dv_acceleration_L2_y = -dv_lambda_P2_y*inverse_L2_mass;
    const double dv_acceleration_L2_x = -dv_lambda_P2_x*inverse_L2_mass;
    const double dv_acceleration_L1_y = dv_lambda_O1_y*inverse_L1_mass;
    const double dv_acceleration_L1_x = dv_lambda_O1_x*inverse_L1_mass;

    /* results */
    dq[0] = dq_acceleration_L1_x;
    dv[0] = dv_acceleration_L1_x;
    dq[1] = dq_acceleration_L1_y;
    dv[1] = dv_acceleration_L1_y;
    dq[2] = dq_acceleration_L1_theta;
    dv[2] = dv_acceleration_L1_theta;
    dq[3] = dq_acceleration_L2_x;
    dv[3] = dv_acceleration_L2_x;
    dq[4] = dq_acceleration_L2_y;
    dv[4] = dv_acceleration_L2_y;
    dq[5] = dq_acceleration_L2_theta;
    dv[5] = dv_acceleration_L2_theta;
    dq[6] = dq_acceleration_L3_x;
    dv[6] = dv_acceleration_L3_x;
    dq[7] = dq_acceleration_L3_y;
    dv[7] = dv_acceleration_L3_y;
    dq[8] = dq_acceleration_L3_theta;
    dv[8] = dv_acceleration_L3_theta;
    dq[9] = dq_acceleration_L4_x;
    dv[9] = dv_acceleration_L4_x;
    dq[10] = dq_acceleration_L4_y;
    dv[10] = dv_acceleration_L4_y;
    dq[11] = dq_acceleration_L4_theta;
    dv[11] = dv_acceleration_L4_theta;
    dq[12] = dq_acceleration_L6_x;
    dv[12] = dv_acceleration_L6_x;
    dq[13] = dq_acceleration_L6_y;
    dv[13] = dv_acceleration_L6_y;
    dq[14] = dq_acceleration_L6_theta;
    dv[14] = dv_acceleration_L6_theta;
    dq[15] = dq_acceleration_L7_x;
    dv[15] = dv_acceleration_L7_x;
    dq[16] = dq_acceleration_L7_y;
    dv[16] = dv_acceleration_L7_y;
    dq[17] = dq_acceleration_L7_theta;
    dv[17] = dv_acceleration_L7_theta;
    dq[18] = dq_acceleration_L8_x;
    dv[18] = dv_acceleration_L8_x;
    dq[19] = dq_acceleration_L8_y;
    dv[19] = dv_acceleration_L8_y;
    dq[20] = dq_acceleration_L8_theta;
    dv[20] = dv_acceleration_L8_theta;
    dq[21] = dq_acceleration_S9_x;
    dv[21] = dv_acceleration_S9_x;
    dq[22] = dq_acceleration_S9_y;
    dv[22] = dv_acceleration_S9_y;
    dq[23] = dq_acceleration_S9_theta;
    dv[23] = dv_acceleration_S9_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_O1_x_2), *worst);
    *worst = fmax(fabs(phi_O1_y_2), *worst);
    *worst = fmax(fabs(phi_O4_x_2), *worst);
    *worst = fmax(fabs(phi_O4_y_2), *worst);
    *worst = fmax(fabs(phi_P2_x_2), *worst);
    *worst = fmax(fabs(phi_P2_y_2), *worst);
    *worst = fmax(fabs(phi_P3_x_2), *worst);
    *worst = fmax(fabs(phi_P3_y_2), *worst);
    *worst = fmax(fabs(phi_Q6_x_2), *worst);
    *worst = fmax(fabs(phi_Q6_y_2), *worst);
    *worst = fmax(fabs(phi_Q8_x_2), *worst);
    *worst = fmax(fabs(phi_Q8_y_2), *worst);
    *worst = fmax(fabs(phi_O6_x_2), *worst);
    *worst = fmax(fabs(phi_O6_y_2), *worst);
    *worst = fmax(fabs(phi_slider_x_2), *worst);
    *worst = fmax(fabs(phi_slider_y_2), *worst);
    *worst = fmax(fabs(phi_guide_offset_2), *worst);
    *worst = fmax(fabs(phi_guide_angle_2), *worst);
    *worst = fmax(fabs(phi_crank1_2), *worst);
    *worst = fmax(fabs(phi_crank4_2), *worst);
    return 0;
}

