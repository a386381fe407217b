/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     S9.y with lambda of slider.y; S9.x with lambda of slider.x; L8.y with lambda of Q8.y;
 *     L8.x with lambda of Q8.x; L7.y with lambda of Q6.y; L7.x with lambda of Q6.x; L3.y with lambda of B.y;
 *     L3.x with lambda of B.x; L2.y with lambda of A.y; L2.x with lambda of A.x;
 *     L4.theta with lambda of crank4; L1.theta with lambda of crank1; S9.theta with lambda of guide.angle;
 *     L6.y with lambda of O6.y; L6.x with lambda of O6.x; L4.y with lambda of O4.y; L4.x with lambda of O4.x;
 *     L1.y with lambda of O1.y; L1.x with lambda of O1.x; L2.theta; L3.theta; L8.theta;
 *     L6.theta with L7.theta; lambda of P2.x with lambda of P2.y; lambda of P3.x with lambda of P3.y;
 *     lambda of guide.offset.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double L1_x_ = q[0];
    const double L1_y_ = q[1];
    const double L1_theta_ = q[2];
    const double L1_vx_ = v[0];
    const double L1_vy_ = v[1];
    const double L1_omega_ = v[2];
    const double L2_x_ = q[3];
    const double L2_y_ = q[4];
    const double L2_theta_ = q[5];
    const double L2_vx_ = v[3];
    const double L2_vy_ = v[4];
    const double L2_omega_ = v[5];
    const double L3_x_ = q[6];
    const double L3_y_ = q[7];
    const double L3_theta_ = q[8];
    const double L3_vx_ = v[6];
    const double L3_vy_ = v[7];
    const double L3_omega_ = v[8];
    const double L4_x_ = q[9];
    const double L4_y_ = q[10];
    const double L4_theta_ = q[11];
    const double L4_vx_ = v[9];
    const double L4_vy_ = v[10];
    const double L4_omega_ = v[11];
    const double L6_x_ = q[12];
    const double L6_y_ = q[13];
    const double L6_theta_ = q[14];
    const double L6_vx_ = v[12];
    const double L6_vy_ = v[13];
    const double L6_omega_ = v[14];
    const double L7_x_ = q[15];
    const double L7_y_ = q[16];
    const double L7_theta_ = q[17];
    const double L7_vx_ = v[15];
    const double L7_vy_ = v[16];
    const double L7_omega_ = v[17];
    const double L8_x_ = q[18];
    const double L8_y_ = q[19];
    const double L8_theta_ = q[20];
    const double L8_vx_ = v[18];
    const double L8_vy_ = v[19];
    const double L8_omega_ = v[20];
    const double S9_x_ = q[21];
    const double S9_y_ = q[22];
    const double S9_theta_ = q[23];
    const double S9_vx_ = v[21];
    const double S9_vy_ = v[22];
    const double S9_omega_ = v[23];

    /* directions, arms, drives */
    const double cos_theta_L1_ = cos(L1_theta_);
    const double sin_theta_L1_ = sin(L1_theta_);
    const double arm_L1_head_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double arm_L1_head_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double cos_theta_L4_ = cos(L4_theta_);
    const double sin_theta_L4_ = sin(L4_theta_);
    const double arm_L4_head_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double arm_L4_head_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double cos_theta_L2_ = cos(L2_theta_);
    const double sin_theta_L2_ = sin(L2_theta_);
    const double arm_L2_head_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double arm_L2_head_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double cos_theta_L3_ = cos(L3_theta_);
    const double sin_theta_L3_ = sin(L3_theta_);
    const double arm_L3_head_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double arm_L3_head_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double cos_theta_L7_ = cos(L7_theta_);
    const double sin_theta_L7_ = sin(L7_theta_);
    const double arm_L7_head_x_ = p->L7_head_s_x_*cos_theta_L7_;
    const double arm_L7_head_y_ = p->L7_head_s_x_*sin_theta_L7_;
    const double cos_theta_L6_ = cos(L6_theta_);
    const double sin_theta_L6_ = sin(L6_theta_);
    const double arm_L6_head_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double arm_L6_head_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double cos_theta_L8_ = cos(L8_theta_);
    const double sin_theta_L8_ = sin(L8_theta_);
    const double arm_L8_head_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double arm_L8_head_y_ = p->L8_head_s_x_*sin_theta_L8_;
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank1_rate_ = p->omega_;
    const double crank1_acceleration_ = 0.0;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const double crank4_rate_ = p->omega4_;
    const double crank4_acceleration_ = 0.0;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O1_x_ = -L1_x_ + arm_L1_head_x_;
    const double phi_dot_O1_x_ = -L1_omega_*arm_L1_head_y_ - L1_vx_;
    const double rhs_O1_x_ = (L1_omega_ * L1_omega_)*arm_L1_head_x_ - p->beta_squared_*phi_O1_x_
        - phi_dot_O1_x_*p->two_alpha_;
    rhs->phi[0] = phi_O1_x_;
    rhs->phi_dot[0] = phi_dot_O1_x_;
    const double phi_O1_y_ = -L1_y_ + arm_L1_head_y_;
    const double phi_dot_O1_y_ = L1_omega_*arm_L1_head_x_ - L1_vy_;
    const double rhs_O1_y_ = (L1_omega_ * L1_omega_)*arm_L1_head_y_ - p->beta_squared_*phi_O1_y_
        - phi_dot_O1_y_*p->two_alpha_;
    rhs->phi[1] = phi_O1_y_;
    rhs->phi_dot[1] = phi_dot_O1_y_;
    const double phi_O4_x_ = -L4_x_ + arm_L4_head_x_;
    const double phi_dot_O4_x_ = -L4_omega_*arm_L4_head_y_ - L4_vx_;
    const double rhs_O4_x_ = (L4_omega_ * L4_omega_)*arm_L4_head_x_ - p->beta_squared_*phi_O4_x_
        - phi_dot_O4_x_*p->two_alpha_;
    rhs->phi[2] = phi_O4_x_;
    rhs->phi_dot[2] = phi_dot_O4_x_;
    const double phi_O4_y_ = -L4_y_ + p->O4_y_ + arm_L4_head_y_;
    const double phi_dot_O4_y_ = L4_omega_*arm_L4_head_x_ - L4_vy_;
    const double rhs_O4_y_ = (L4_omega_ * L4_omega_)*arm_L4_head_y_ - p->beta_squared_*phi_O4_y_
        - phi_dot_O4_y_*p->two_alpha_;
    rhs->phi[3] = phi_O4_y_;
    rhs->phi_dot[3] = phi_dot_O4_y_;
    const double phi_A_x_ = L1_x_ - L2_x_ + arm_L1_head_x_ + arm_L2_head_x_;
    const double phi_dot_A_x_ = -L1_omega_*arm_L1_head_y_ + L1_vx_ - L2_omega_*arm_L2_head_y_ - L2_vx_;
    const double rhs_A_x_ = (L1_omega_ * L1_omega_)*arm_L1_head_x_ + (L2_omega_ * L2_omega_)*arm_L2_head_x_
        - p->beta_squared_*phi_A_x_ - phi_dot_A_x_*p->two_alpha_;
    rhs->phi[4] = phi_A_x_;
    rhs->phi_dot[4] = phi_dot_A_x_;
    const double phi_A_y_ = L1_y_ - L2_y_ + arm_L1_head_y_ + arm_L2_head_y_;
    const double phi_dot_A_y_ = L1_omega_*arm_L1_head_x_ + L1_vy_ + L2_omega_*arm_L2_head_x_ - L2_vy_;
    const double rhs_A_y_ = (L1_omega_ * L1_omega_)*arm_L1_head_y_ + (L2_omega_ * L2_omega_)*arm_L2_head_y_
        - p->beta_squared_*phi_A_y_ - phi_dot_A_y_*p->two_alpha_;
    rhs->phi[5] = phi_A_y_;
    rhs->phi_dot[5] = phi_dot_A_y_;
    const double phi_B_x_ = -L3_x_ + L4_x_ + arm_L3_head_x_ + arm_L4_head_x_;
    const double phi_dot_B_x_ = -L3_omega_*arm_L3_head_y_ - L3_vx_ - L4_omega_*arm_L4_head_y_ + L4_vx_;
    const double rhs_B_x_ = (L3_omega_ * L3_omega_)*arm_L3_head_x_ + (L4_omega_ * L4_omega_)*arm_L4_head_x_
        - p->beta_squared_*phi_B_x_ - phi_dot_B_x_*p->two_alpha_;
    rhs->phi[6] = phi_B_x_;
    rhs->phi_dot[6] = phi_dot_B_x_;
    const double phi_B_y_ = -L3_y_ + L4_y_ + arm_L3_head_y_ + arm_L4_head_y_;
    const double phi_dot_B_y_ = L3_omega_*arm_L3_head_x_ - L3_vy_ + L4_omega_*arm_L4_head_x_ + L4_vy_;
    const double rhs_B_y_ = (L3_omega_ * L3_omega_)*arm_L3_head_y_ + (L4_omega_ * L4_omega_)*arm_L4_head_y_
        - p->beta_squared_*phi_B_y_ - phi_dot_B_y_*p->two_alpha_;
    rhs->phi[7] = phi_B_y_;
    rhs->phi_dot[7] = phi_dot_B_y_;
    const double phi_P2_x_ = L2_x_ - L7_x_ + arm_L2_head_x_ + arm_L7_head_x_;
    const double phi_dot_P2_x_ = -L2_omega_*arm_L2_head_y_ + L2_vx_ - L7_omega_*arm_L7_head_y_ - L7_vx_;
    const double rhs_P2_x_ = (L2_omega_ * L2_omega_)*arm_L2_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_
        - p->beta_squared_*phi_P2_x_ - phi_dot_P2_x_*p->two_alpha_;
    rhs->phi[8] = phi_P2_x_;
    rhs->phi_dot[8] = phi_dot_P2_x_;
    const double phi_P2_y_ = L2_y_ - L7_y_ + arm_L2_head_y_ + arm_L7_head_y_;
    const double phi_dot_P2_y_ = L2_omega_*arm_L2_head_x_ + L2_vy_ + L7_omega_*arm_L7_head_x_ - L7_vy_;
    const double rhs_P2_y_ = (L2_omega_ * L2_omega_)*arm_L2_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_
        - p->beta_squared_*phi_P2_y_ - phi_dot_P2_y_*p->two_alpha_;
    rhs->phi[9] = phi_P2_y_;
    rhs->phi_dot[9] = phi_dot_P2_y_;
    const double phi_P3_x_ = L3_x_ - L7_x_ + arm_L3_head_x_ + arm_L7_head_x_;
    const double phi_dot_P3_x_ = -L3_omega_*arm_L3_head_y_ + L3_vx_ - L7_omega_*arm_L7_head_y_ - L7_vx_;
    const double rhs_P3_x_ = (L3_omega_ * L3_omega_)*arm_L3_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_
        - p->beta_squared_*phi_P3_x_ - phi_dot_P3_x_*p->two_alpha_;
    rhs->phi[10] = phi_P3_x_;
    rhs->phi_dot[10] = phi_dot_P3_x_;
    const double phi_P3_y_ = L3_y_ - L7_y_ + arm_L3_head_y_ + arm_L7_head_y_;
    const double phi_dot_P3_y_ = L3_omega_*arm_L3_head_x_ + L3_vy_ + L7_omega_*arm_L7_head_x_ - L7_vy_;
    const double rhs_P3_y_ = (L3_omega_ * L3_omega_)*arm_L3_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_
        - p->beta_squared_*phi_P3_y_ - phi_dot_P3_y_*p->two_alpha_;
    rhs->phi[11] = phi_P3_y_;
    rhs->phi_dot[11] = phi_dot_P3_y_;
    const double phi_Q6_x_ = -L6_x_ + L7_x_ - arm_L6_head_x_ + arm_L7_head_x_;
    const double phi_dot_Q6_x_ = L6_omega_*arm_L6_head_y_ - L6_vx_ - L7_omega_*arm_L7_head_y_ + L7_vx_;
    const double rhs_Q6_x_ = -(L6_omega_ * L6_omega_)*arm_L6_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_
        - p->beta_squared_*phi_Q6_x_ - phi_dot_Q6_x_*p->two_alpha_;
    rhs->phi[12] = phi_Q6_x_;
    rhs->phi_dot[12] = phi_dot_Q6_x_;
    const double phi_Q6_y_ = -L6_y_ + L7_y_ - arm_L6_head_y_ + arm_L7_head_y_;
    const double phi_dot_Q6_y_ = -L6_omega_*arm_L6_head_x_ - L6_vy_ + L7_omega_*arm_L7_head_x_ + L7_vy_;
    const double rhs_Q6_y_ = -(L6_omega_ * L6_omega_)*arm_L6_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_
        - p->beta_squared_*phi_Q6_y_ - phi_dot_Q6_y_*p->two_alpha_;
    rhs->phi[13] = phi_Q6_y_;
    rhs->phi_dot[13] = phi_dot_Q6_y_;
    const double phi_Q8_x_ = L7_x_ - L8_x_ + arm_L7_head_x_ + arm_L8_head_x_;
    const double phi_dot_Q8_x_ = -L7_omega_*arm_L7_head_y_ + L7_vx_ - L8_omega_*arm_L8_head_y_ - L8_vx_;
    const double rhs_Q8_x_ = (L7_omega_ * L7_omega_)*arm_L7_head_x_ + (L8_omega_ * L8_omega_)*arm_L8_head_x_
        - p->beta_squared_*phi_Q8_x_ - phi_dot_Q8_x_*p->two_alpha_;
    rhs->phi[14] = phi_Q8_x_;
    rhs->phi_dot[14] = phi_dot_Q8_x_;
    const double phi_Q8_y_ = L7_y_ - L8_y_ + arm_L7_head_y_ + arm_L8_head_y_;
    const double phi_dot_Q8_y_ = L7_omega_*arm_L7_head_x_ + L7_vy_ + L8_omega_*arm_L8_head_x_ - L8_vy_;
    const double rhs_Q8_y_ = (L7_omega_ * L7_omega_)*arm_L7_head_y_ + (L8_omega_ * L8_omega_)*arm_L8_head_y_
        - p->beta_squared_*phi_Q8_y_ - phi_dot_Q8_y_*p->two_alpha_;
    rhs->phi[15] = phi_Q8_y_;
    rhs->phi_dot[15] = phi_dot_Q8_y_;
    const double phi_O6_x_ = -L6_x_ + p->O6_x_ + arm_L6_head_x_;
    const double phi_dot_O6_x_ = -L6_omega_*arm_L6_head_y_ - L6_vx_;
    const double rhs_O6_x_ = (L6_omega_ * L6_omega_)*arm_L6_head_x_ - p->beta_squared_*phi_O6_x_
        - phi_dot_O6_x_*p->two_alpha_;
    rhs->phi[16] = phi_O6_x_;
    rhs->phi_dot[16] = phi_dot_O6_x_;
    const double phi_O6_y_ = -L6_y_ + arm_L6_head_y_;
    const double phi_dot_O6_y_ = L6_omega_*arm_L6_head_x_ - L6_vy_;
    const double rhs_O6_y_ = (L6_omega_ * L6_omega_)*arm_L6_head_y_ - p->beta_squared_*phi_O6_y_
        - phi_dot_O6_y_*p->two_alpha_;
    rhs->phi[17] = phi_O6_y_;
    rhs->phi_dot[17] = phi_dot_O6_y_;
    const double phi_slider_x_ = L8_x_ - S9_x_ + arm_L8_head_x_;
    const double phi_dot_slider_x_ = -L8_omega_*arm_L8_head_y_ + L8_vx_ - S9_vx_;
    const double rhs_slider_x_ = (L8_omega_ * L8_omega_)*arm_L8_head_x_ - p->beta_squared_*phi_slider_x_
        - phi_dot_slider_x_*p->two_alpha_;
    rhs->phi[18] = phi_slider_x_;
    rhs->phi_dot[18] = phi_dot_slider_x_;
    const double phi_slider_y_ = L8_y_ - S9_y_ + arm_L8_head_y_;
    const double phi_dot_slider_y_ = L8_omega_*arm_L8_head_x_ + L8_vy_ - S9_vy_;
    const double rhs_slider_y_ = (L8_omega_ * L8_omega_)*arm_L8_head_y_ - p->beta_squared_*phi_slider_y_
        - phi_dot_slider_y_*p->two_alpha_;
    rhs->phi[19] = phi_slider_y_;
    rhs->phi_dot[19] = phi_dot_slider_y_;
    const double phi_guide_offset_ = p->O6_x_ - S9_x_;
    const double phi_dot_guide_offset_ = -S9_vx_;
    const double rhs_guide_offset_ = -p->beta_squared_*phi_guide_offset_ - phi_dot_guide_offset_*p->two_alpha_;
    rhs->phi[20] = phi_guide_offset_;
    rhs->phi_dot[20] = phi_dot_guide_offset_;
    const double phi_guide_angle_ = S9_theta_ - PI/2.0;
    const double phi_dot_guide_angle_ = S9_omega_;
    const double rhs_guide_angle_ = -p->beta_squared_*phi_guide_angle_ - phi_dot_guide_angle_*p->two_alpha_;
    rhs->phi[21] = phi_guide_angle_;
    rhs->phi_dot[21] = phi_dot_guide_angle_;
    const double phi_crank1_ = L1_theta_ - crank1_value_;
    const double phi_dot_crank1_ = L1_omega_ - crank1_rate_;
    const double rhs_crank1_ = -p->beta_squared_*phi_crank1_ + crank1_acceleration_ - phi_dot_crank1_*p->two_alpha_;
    rhs->phi[22] = phi_crank1_;
    rhs->phi_dot[22] = phi_dot_crank1_;
    const double phi_crank4_ = L4_theta_ - crank4_value_;
    const double phi_dot_crank4_ = L4_omega_ - crank4_rate_;
    const double rhs_crank4_ = -p->beta_squared_*phi_crank4_ + crank4_acceleration_ - phi_dot_crank4_*p->two_alpha_;
    rhs->phi[23] = phi_crank4_;
    rhs->phi_dot[23] = phi_dot_crank4_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_L8_theta_slider_y_ = -p->S9_mass_*arm_L8_head_x_;
    const double l_L8_theta_slider_x_ = p->S9_mass_*arm_L8_head_y_;
    const double inertia_L8_y_ = p->L8_mass_ + p->S9_mass_;
    const double l_L8_theta_Q8_y_ = -arm_L8_head_x_*inertia_L8_y_ + l_L8_theta_slider_y_;
    const double l_L7_theta_Q8_y_ = -arm_L7_head_x_*inertia_L8_y_;
    const double inertia_L8_x_ = p->L8_mass_ + p->S9_mass_;
    const double l_L8_theta_Q8_x_ = arm_L8_head_y_*inertia_L8_x_ + l_L8_theta_slider_x_;
    const double l_L7_theta_Q8_x_ = arm_L7_head_y_*inertia_L8_x_;
    const double inertia_L7_y_ = p->L7_mass_ + inertia_L8_y_;
    const double l_L6_theta_Q6_y_ = arm_L6_head_x_*inertia_L7_y_;
    const double l_L7_theta_Q6_y_ = -arm_L7_head_x_*inertia_L7_y_ - l_L7_theta_Q8_y_;
    const double inertia_L7_x_ = p->L7_mass_ + inertia_L8_x_;
    const double l_L6_theta_Q6_x_ = -arm_L6_head_y_*inertia_L7_x_;
    const double l_L7_theta_Q6_x_ = arm_L7_head_y_*inertia_L7_x_ - l_L7_theta_Q8_x_;
    const double l_L4_theta_B_y_ = -p->L3_mass_*arm_L4_head_x_;
    const double l_L3_theta_B_y_ = -p->L3_mass_*arm_L3_head_x_;
    const double l_L4_theta_B_x_ = p->L3_mass_*arm_L4_head_y_;
    const double l_L3_theta_B_x_ = p->L3_mass_*arm_L3_head_y_;
    const double l_L1_theta_A_y_ = -p->L2_mass_*arm_L1_head_x_;
    const double l_L2_theta_A_y_ = -p->L2_mass_*arm_L2_head_x_;
    const double l_L1_theta_A_x_ = p->L2_mass_*arm_L1_head_y_;
    const double l_L2_theta_A_x_ = p->L2_mass_*arm_L2_head_y_;
    const double inertia_L4_theta_ = p->L4_inertia_ - arm_L4_head_x_*l_L4_theta_B_y_ + arm_L4_head_y_*l_L4_theta_B_x_;
    const double w_L4_y_L4_theta_ = p->L3_mass_*arm_L4_head_x_;
    const double w_L4_x_L4_theta_ = -p->L3_mass_*arm_L4_head_y_;
    const double w_L3_theta_L4_theta_ = -arm_L4_head_x_*l_L3_theta_B_y_ + arm_L4_head_y_*l_L3_theta_B_x_;
    const double inertia_L1_theta_ = p->L1_inertia_ - arm_L1_head_x_*l_L1_theta_A_y_ + arm_L1_head_y_*l_L1_theta_A_x_;
    const double w_L1_y_L1_theta_ = p->L2_mass_*arm_L1_head_x_;
    const double w_L1_x_L1_theta_ = -p->L2_mass_*arm_L1_head_y_;
    const double w_L2_theta_L1_theta_ = -arm_L1_head_x_*l_L2_theta_A_y_ + arm_L1_head_y_*l_L2_theta_A_x_;
    const double inertia_L6_y_ = p->L6_mass_ + inertia_L7_y_;
    const double l_L6_theta_O6_y_ = -arm_L6_head_x_*inertia_L6_y_ - l_L6_theta_Q6_y_;
    const double inertia_L6_x_ = p->L6_mass_ + inertia_L7_x_;
    const double l_L6_theta_O6_x_ = arm_L6_head_y_*inertia_L6_x_ - l_L6_theta_Q6_x_;
    const double inertia_L4_y_ = p->L3_mass_ + p->L4_mass_;
    const double inertia_L4_x_ = p->L3_mass_ + p->L4_mass_;
    const double inertia_L1_y_ = p->L1_mass_ + p->L2_mass_;
    const double inertia_L1_x_ = p->L1_mass_ + p->L2_mass_;
    const double pivot_L2_theta_ = p->L2_inertia_ - arm_L2_head_x_*l_L2_theta_A_y_ + arm_L2_head_y_*l_L2_theta_A_x_;
    if (!(pivot_L2_theta_ > LIGHT_PIVOT * p->L2_turning_)) {
        pivot = 25;
        goto dependent;
    }
    const double inverse_pivot_L2_theta_ = 1.0/pivot_L2_theta_;
    const double w_P2_x_L2_theta_ = -2.0*arm_L2_head_y_;
    const double l_P2_x_L2_theta_ = inverse_pivot_L2_theta_*w_P2_x_L2_theta_;
    const double w_P2_y_L2_theta_ = 2.0*arm_L2_head_x_;
    const double l_P2_y_L2_theta_ = inverse_pivot_L2_theta_*w_P2_y_L2_theta_;
    const double pivot_L3_theta_ = p->L3_inertia_ - arm_L3_head_x_*l_L3_theta_B_y_ + arm_L3_head_y_*l_L3_theta_B_x_;
    if (!(pivot_L3_theta_ > LIGHT_PIVOT * p->L3_turning_)) {
        pivot = 26;
        goto dependent;
    }
    const double inverse_pivot_L3_theta_ = 1.0/pivot_L3_theta_;
    const double w_P3_x_L3_theta_ = -2.0*arm_L3_head_y_;
    const double l_P3_x_L3_theta_ = inverse_pivot_L3_theta_*w_P3_x_L3_theta_;
    const double w_P3_y_L3_theta_ = 2.0*arm_L3_head_x_;
    const double l_P3_y_L3_theta_ = inverse_pivot_L3_theta_*w_P3_y_L3_theta_;
    const double pivot_L8_theta_ = p->L8_inertia_ - arm_L8_head_x_*l_L8_theta_Q8_y_
        - 2.0*arm_L8_head_x_*l_L8_theta_slider_y_ + arm_L8_head_y_*l_L8_theta_Q8_x_
        + 2.0*arm_L8_head_y_*l_L8_theta_slider_x_;
    if (!(pivot_L8_theta_ > LIGHT_PIVOT * p->L8_turning_)) {
        pivot = 27;
        goto dependent;
    }
    const double inverse_pivot_L8_theta_ = 1.0/pivot_L8_theta_;
    const double w_L6_theta_L8_theta_ = -2.0*arm_L6_head_x_*l_L8_theta_Q8_y_ + 2.0*arm_L6_head_y_*l_L8_theta_Q8_x_;
    const double l_L6_theta_L8_theta_ = inverse_pivot_L8_theta_*w_L6_theta_L8_theta_;
    const double w_L7_theta_L8_theta_ = arm_L7_head_x_*l_L8_theta_Q8_y_ - arm_L7_head_x_*l_L8_theta_slider_y_
        - arm_L7_head_y_*l_L8_theta_Q8_x_ + arm_L7_head_y_*l_L8_theta_slider_x_ - arm_L8_head_x_*l_L7_theta_Q8_y_
        + arm_L8_head_y_*l_L7_theta_Q8_x_;
    const double l_L7_theta_L8_theta_ = inverse_pivot_L8_theta_*w_L7_theta_L8_theta_;
    const double w_guide_offset_L8_theta_ = 2.0*arm_L8_head_y_;
    const double l_guide_offset_L8_theta_ = inverse_pivot_L8_theta_*w_guide_offset_L8_theta_;
    const double pivot_L6_theta_ = p->L6_inertia_ - arm_L6_head_x_*l_L6_theta_O6_y_
        + 2.0*arm_L6_head_x_*l_L6_theta_Q6_y_ + arm_L6_head_y_*l_L6_theta_O6_x_ - 2.0*arm_L6_head_y_*l_L6_theta_Q6_x_
        - l_L6_theta_L8_theta_*w_L6_theta_L8_theta_;
    const double pivot_L7_theta_ = p->L7_inertia_ - arm_L7_head_x_*l_L7_theta_Q6_y_ + arm_L7_head_y_*l_L7_theta_Q6_x_
        - l_L7_theta_L8_theta_*w_L7_theta_L8_theta_;
    const double pivot_L6_theta_L7_theta_ = 2.0*arm_L6_head_x_*l_L7_theta_Q6_y_ - 2.0*arm_L6_head_y_*l_L7_theta_Q6_x_
        - l_L7_theta_L8_theta_*w_L6_theta_L8_theta_;
    const double determinant_L6_theta_L7_theta_ = pivot_L6_theta_*pivot_L7_theta_
        - (pivot_L6_theta_L7_theta_ * pivot_L6_theta_L7_theta_);
    if (!(pivot_L6_theta_ > LIGHT_PIVOT * p->L6_turning_)) {
        pivot = 28;
        goto dependent;
    }
    if (!(determinant_L6_theta_L7_theta_ > LIGHT_PIVOT * p->L7_turning_ * pivot_L6_theta_)) {
        pivot = 29;
        goto dependent;
    }
    const double inverse_L6_theta_L7_theta_ = 1.0/determinant_L6_theta_L7_theta_;
    const double inverse_pivot_L6_theta_ = inverse_L6_theta_L7_theta_*pivot_L7_theta_;
    const double inverse_pivot_L7_theta_ = inverse_L6_theta_L7_theta_*pivot_L6_theta_;
    const double inverse_cross_L6_theta_L7_theta_ = -inverse_L6_theta_L7_theta_*pivot_L6_theta_L7_theta_;
    const double w_P2_x_L6_theta_ = 2.0*arm_L6_head_y_;
    const double w_P2_x_L7_theta_ = -2.0*arm_L7_head_y_;
    const double l_P2_x_L6_theta_ = inverse_cross_L6_theta_L7_theta_*w_P2_x_L7_theta_
        + inverse_pivot_L6_theta_*w_P2_x_L6_theta_;
    const double l_P2_x_L7_theta_ = inverse_cross_L6_theta_L7_theta_*w_P2_x_L6_theta_
        + inverse_pivot_L7_theta_*w_P2_x_L7_theta_;
    const double w_P2_y_L6_theta_ = -2.0*arm_L6_head_x_;
    const double w_P2_y_L7_theta_ = 2.0*arm_L7_head_x_;
    const double l_P2_y_L6_theta_ = inverse_cross_L6_theta_L7_theta_*w_P2_y_L7_theta_
        + inverse_pivot_L6_theta_*w_P2_y_L6_theta_;
    const double l_P2_y_L7_theta_ = inverse_cross_L6_theta_L7_theta_*w_P2_y_L6_theta_
        + inverse_pivot_L7_theta_*w_P2_y_L7_theta_;
    const double w_P3_x_L6_theta_ = 2.0*arm_L6_head_y_;
    const double w_P3_x_L7_theta_ = -2.0*arm_L7_head_y_;
    const double l_P3_x_L6_theta_ = inverse_cross_L6_theta_L7_theta_*w_P3_x_L7_theta_
        + inverse_pivot_L6_theta_*w_P3_x_L6_theta_;
    const double l_P3_x_L7_theta_ = inverse_cross_L6_theta_L7_theta_*w_P3_x_L6_theta_
        + inverse_pivot_L7_theta_*w_P3_x_L7_theta_;
    const double w_P3_y_L6_theta_ = -2.0*arm_L6_head_x_;
    const double w_P3_y_L7_theta_ = 2.0*arm_L7_head_x_;
    const double l_P3_y_L6_theta_ = inverse_cross_L6_theta_L7_theta_*w_P3_y_L7_theta_
        + inverse_pivot_L6_theta_*w_P3_y_L6_theta_;
    const double l_P3_y_L7_theta_ = inverse_cross_L6_theta_L7_theta_*w_P3_y_L6_theta_
        + inverse_pivot_L7_theta_*w_P3_y_L7_theta_;
    const double w_guide_offset_L6_theta_ = 2.0*arm_L6_head_y_ - l_guide_offset_L8_theta_*w_L6_theta_L8_theta_;
    const double w_guide_offset_L7_theta_ = -l_guide_offset_L8_theta_*w_L7_theta_L8_theta_;
    const double l_guide_offset_L6_theta_ = inverse_cross_L6_theta_L7_theta_*w_guide_offset_L7_theta_
        + inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const double l_guide_offset_L7_theta_ = inverse_cross_L6_theta_L7_theta_*w_guide_offset_L6_theta_
        + inverse_pivot_L7_theta_*w_guide_offset_L7_theta_;
    const double scale_P2_x_ = l_P2_x_L2_theta_*w_P2_x_L2_theta_ + l_P2_x_L6_theta_*w_P2_x_L6_theta_
        + l_P2_x_L7_theta_*w_P2_x_L7_theta_;
    const double scale_P2_y_ = l_P2_y_L2_theta_*w_P2_y_L2_theta_ + l_P2_y_L6_theta_*w_P2_y_L6_theta_
        + l_P2_y_L7_theta_*w_P2_y_L7_theta_;
    const double size_P2_x_ = p->mobility_P2_x_ + scale_P2_x_;
    const double size_P2_y_ = p->mobility_P2_x_ + scale_P2_y_;
    const double pivot_P2_x_P2_y_ = l_P2_y_L2_theta_*w_P2_x_L2_theta_ + l_P2_y_L6_theta_*w_P2_x_L6_theta_
        + l_P2_y_L7_theta_*w_P2_x_L7_theta_;
    const double determinant_P2_x_P2_y_ = -(pivot_P2_x_P2_y_ * pivot_P2_x_P2_y_) + scale_P2_x_*scale_P2_y_;
    if (!(scale_P2_x_ > discrete->min_pivot * size_P2_x_)) {
        pivot = 20;
        goto dependent;
    }
    if (!(determinant_P2_x_P2_y_ > discrete->min_pivot * size_P2_y_ * scale_P2_x_)) {
        pivot = 21;
        goto dependent;
    }
    const double inverse_P2_x_P2_y_ = -1.0/determinant_P2_x_P2_y_;
    const double inverse_pivot_P2_x_ = inverse_P2_x_P2_y_*scale_P2_y_;
    const double inverse_pivot_P2_y_ = inverse_P2_x_P2_y_*scale_P2_x_;
    const double inverse_cross_P2_x_P2_y_ = -inverse_P2_x_P2_y_*pivot_P2_x_P2_y_;
    const double w_P3_x_P2_x_ = -l_P3_x_L6_theta_*w_P2_x_L6_theta_ - l_P3_x_L7_theta_*w_P2_x_L7_theta_;
    const double w_P3_x_P2_y_ = -l_P3_x_L6_theta_*w_P2_y_L6_theta_ - l_P3_x_L7_theta_*w_P2_y_L7_theta_;
    const double l_P3_x_P2_x_ = inverse_cross_P2_x_P2_y_*w_P3_x_P2_y_ + inverse_pivot_P2_x_*w_P3_x_P2_x_;
    const double l_P3_x_P2_y_ = inverse_cross_P2_x_P2_y_*w_P3_x_P2_x_ + inverse_pivot_P2_y_*w_P3_x_P2_y_;
    const double w_P3_y_P2_x_ = -l_P3_y_L6_theta_*w_P2_x_L6_theta_ - l_P3_y_L7_theta_*w_P2_x_L7_theta_;
    const double w_P3_y_P2_y_ = -l_P3_y_L6_theta_*w_P2_y_L6_theta_ - l_P3_y_L7_theta_*w_P2_y_L7_theta_;
    const double l_P3_y_P2_x_ = inverse_cross_P2_x_P2_y_*w_P3_y_P2_y_ + inverse_pivot_P2_x_*w_P3_y_P2_x_;
    const double l_P3_y_P2_y_ = inverse_cross_P2_x_P2_y_*w_P3_y_P2_x_ + inverse_pivot_P2_y_*w_P3_y_P2_y_;
    const double w_guide_offset_P2_x_ = -l_guide_offset_L6_theta_*w_P2_x_L6_theta_
        - l_guide_offset_L7_theta_*w_P2_x_L7_theta_;
    const double w_guide_offset_P2_y_ = -l_guide_offset_L6_theta_*w_P2_y_L6_theta_
        - l_guide_offset_L7_theta_*w_P2_y_L7_theta_;
    const double l_guide_offset_P2_x_ = inverse_cross_P2_x_P2_y_*w_guide_offset_P2_y_
        + inverse_pivot_P2_x_*w_guide_offset_P2_x_;
    const double l_guide_offset_P2_y_ = inverse_cross_P2_x_P2_y_*w_guide_offset_P2_x_
        + inverse_pivot_P2_y_*w_guide_offset_P2_y_;
    const double scale_P3_x_ = l_P3_x_L3_theta_*w_P3_x_L3_theta_ + l_P3_x_L6_theta_*w_P3_x_L6_theta_
        + l_P3_x_L7_theta_*w_P3_x_L7_theta_;
    const double scale_P3_y_ = l_P3_y_L3_theta_*w_P3_y_L3_theta_ + l_P3_y_L6_theta_*w_P3_y_L6_theta_
        + l_P3_y_L7_theta_*w_P3_y_L7_theta_;
    const double size_P3_x_ = p->mobility_P3_x_ + scale_P3_x_;
    const double size_P3_y_ = p->mobility_P3_x_ + scale_P3_y_;
    const double pivot_P3_x_ = l_P3_x_P2_x_*w_P3_x_P2_x_ + l_P3_x_P2_y_*w_P3_x_P2_y_ + scale_P3_x_;
    const double pivot_P3_y_ = l_P3_y_P2_x_*w_P3_y_P2_x_ + l_P3_y_P2_y_*w_P3_y_P2_y_ + scale_P3_y_;
    const double pivot_P3_x_P3_y_ = l_P3_y_L3_theta_*w_P3_x_L3_theta_ + l_P3_y_L6_theta_*w_P3_x_L6_theta_
        + l_P3_y_L7_theta_*w_P3_x_L7_theta_ + l_P3_y_P2_x_*w_P3_x_P2_x_ + l_P3_y_P2_y_*w_P3_x_P2_y_;
    const double determinant_P3_x_P3_y_ = pivot_P3_x_*pivot_P3_y_ - (pivot_P3_x_P3_y_ * pivot_P3_x_P3_y_);
    if (!(pivot_P3_x_ > discrete->min_pivot * size_P3_x_)) {
        pivot = 22;
        goto dependent;
    }
    if (!(determinant_P3_x_P3_y_ > discrete->min_pivot * size_P3_y_ * pivot_P3_x_)) {
        pivot = 23;
        goto dependent;
    }
    const double inverse_P3_x_P3_y_ = -1.0/determinant_P3_x_P3_y_;
    const double inverse_pivot_P3_x_ = inverse_P3_x_P3_y_*pivot_P3_y_;
    const double inverse_pivot_P3_y_ = inverse_P3_x_P3_y_*pivot_P3_x_;
    const double inverse_cross_P3_x_P3_y_ = -inverse_P3_x_P3_y_*pivot_P3_x_P3_y_;
    const double w_guide_offset_P3_x_ = -l_guide_offset_L6_theta_*w_P3_x_L6_theta_
        - l_guide_offset_L7_theta_*w_P3_x_L7_theta_ - l_guide_offset_P2_x_*w_P3_x_P2_x_
        - l_guide_offset_P2_y_*w_P3_x_P2_y_;
    const double w_guide_offset_P3_y_ = -l_guide_offset_L6_theta_*w_P3_y_L6_theta_
        - l_guide_offset_L7_theta_*w_P3_y_L7_theta_ - l_guide_offset_P2_x_*w_P3_y_P2_x_
        - l_guide_offset_P2_y_*w_P3_y_P2_y_;
    const double l_guide_offset_P3_x_ = inverse_cross_P3_x_P3_y_*w_guide_offset_P3_y_
        + inverse_pivot_P3_x_*w_guide_offset_P3_x_;
    const double l_guide_offset_P3_y_ = inverse_cross_P3_x_P3_y_*w_guide_offset_P3_x_
        + inverse_pivot_P3_y_*w_guide_offset_P3_y_;
    const double scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L7_theta_*w_guide_offset_L7_theta_ + l_guide_offset_L8_theta_*w_guide_offset_L8_theta_;
    const double pivot_guide_offset_ = l_guide_offset_P2_x_*w_guide_offset_P2_x_
        + l_guide_offset_P2_y_*w_guide_offset_P2_y_ + l_guide_offset_P3_x_*w_guide_offset_P3_x_
        + l_guide_offset_P3_y_*w_guide_offset_P3_y_ + scale_guide_offset_;
    const double size_guide_offset_ = p->mobility_guide_offset_ + scale_guide_offset_;
    if (!(pivot_guide_offset_ > discrete->min_pivot * size_guide_offset_)) {
        pivot = 24;
        goto dependent;
    }
    const double inverse_pivot_guide_offset_ = 1.0/pivot_guide_offset_;

    /* forward substitution */
    const double z_L8_y_ = p->S9_mass_*rhs_slider_y_ + p->weight_L8_y_ + p->weight_S9_y_;
    const double z_L8_x_ = p->S9_mass_*rhs_slider_x_;
    const double z_L7_y_ = inertia_L8_y_*rhs_Q8_y_ + p->weight_L7_y_ + z_L8_y_;
    const double z_L7_x_ = inertia_L8_x_*rhs_Q8_x_ + z_L8_x_;
    const double z_L4_theta_ = arm_L4_head_x_*p->weight_L3_y_ - l_L4_theta_B_x_*rhs_B_x_ - l_L4_theta_B_y_*rhs_B_y_;
    const double z_L1_theta_ = arm_L1_head_x_*p->weight_L2_y_ - l_L1_theta_A_x_*rhs_A_x_ - l_L1_theta_A_y_*rhs_A_y_;
    const double z_L6_y_ = -inertia_L7_y_*rhs_Q6_y_ + p->weight_L6_y_ + z_L7_y_;
    const double z_L6_x_ = -inertia_L7_x_*rhs_Q6_x_ + z_L7_x_;
    const double z_L4_y_ = p->L3_mass_*rhs_B_y_ - rhs_crank4_*w_L4_y_L4_theta_ + p->weight_L3_y_ + p->weight_L4_y_;
    const double z_O4_y_ = -arm_L4_head_x_*rhs_crank4_ + rhs_O4_y_;
    const double z_L4_x_ = p->L3_mass_*rhs_B_x_ - rhs_crank4_*w_L4_x_L4_theta_;
    const double z_O4_x_ = arm_L4_head_y_*rhs_crank4_ + rhs_O4_x_;
    const double z_L1_y_ = p->L2_mass_*rhs_A_y_ - rhs_crank1_*w_L1_y_L1_theta_ + p->weight_L1_y_ + p->weight_L2_y_;
    const double z_O1_y_ = -arm_L1_head_x_*rhs_crank1_ + rhs_O1_y_;
    const double z_L1_x_ = p->L2_mass_*rhs_A_x_ - rhs_crank1_*w_L1_x_L1_theta_;
    const double z_O1_x_ = arm_L1_head_y_*rhs_crank1_ + rhs_O1_x_;
    const double z_L2_theta_ = arm_L2_head_x_*p->weight_L2_y_ - l_L2_theta_A_x_*rhs_A_x_ - l_L2_theta_A_x_*z_O1_x_
        - l_L2_theta_A_y_*rhs_A_y_ - l_L2_theta_A_y_*z_O1_y_ - rhs_crank1_*w_L2_theta_L1_theta_;
    const double z_L3_theta_ = arm_L3_head_x_*p->weight_L3_y_ - l_L3_theta_B_x_*rhs_B_x_ - l_L3_theta_B_x_*z_O4_x_
        - l_L3_theta_B_y_*rhs_B_y_ - l_L3_theta_B_y_*z_O4_y_ - rhs_crank4_*w_L3_theta_L4_theta_;
    const double z_L8_theta_ = arm_L8_head_x_*p->weight_S9_y_ + arm_L8_head_x_*z_L8_y_ - arm_L8_head_y_*z_L8_x_
        - l_L8_theta_Q8_x_*rhs_O6_x_ + l_L8_theta_Q8_x_*rhs_Q6_x_ - l_L8_theta_Q8_x_*rhs_Q8_x_
        - l_L8_theta_Q8_y_*rhs_O6_y_ + l_L8_theta_Q8_y_*rhs_Q6_y_ - l_L8_theta_Q8_y_*rhs_Q8_y_
        - l_L8_theta_slider_x_*rhs_slider_x_ - l_L8_theta_slider_y_*rhs_slider_y_;
    const double z_L6_theta_ = arm_L6_head_x_*z_L6_y_ + arm_L6_head_x_*z_L7_y_ - arm_L6_head_y_*z_L6_x_
        - arm_L6_head_y_*z_L7_x_ - l_L6_theta_L8_theta_*z_L8_theta_ - l_L6_theta_O6_x_*rhs_O6_x_
        - l_L6_theta_O6_y_*rhs_O6_y_ - l_L6_theta_Q6_x_*rhs_Q6_x_ - l_L6_theta_Q6_y_*rhs_Q6_y_;
    const double z_L7_theta_ = -arm_L7_head_x_*z_L7_y_ + arm_L7_head_x_*z_L8_y_ + arm_L7_head_y_*z_L7_x_
        - arm_L7_head_y_*z_L8_x_ - l_L7_theta_L8_theta_*z_L8_theta_ + l_L7_theta_Q6_x_*rhs_O6_x_
        - l_L7_theta_Q6_x_*rhs_Q6_x_ + l_L7_theta_Q6_y_*rhs_O6_y_ - l_L7_theta_Q6_y_*rhs_Q6_y_
        - l_L7_theta_Q8_x_*rhs_Q8_x_ - l_L7_theta_Q8_y_*rhs_Q8_y_;
    const double z_P2_x_ = arm_L1_head_y_*rhs_crank1_ - l_P2_x_L2_theta_*z_L2_theta_ - l_P2_x_L6_theta_*z_L6_theta_
        - l_P2_x_L7_theta_*z_L7_theta_ + rhs_A_x_ - rhs_O6_x_ + rhs_P2_x_ + rhs_Q6_x_ + z_O1_x_;
    const double z_P2_y_ = -arm_L1_head_x_*rhs_crank1_ - l_P2_y_L2_theta_*z_L2_theta_ - l_P2_y_L6_theta_*z_L6_theta_
        - l_P2_y_L7_theta_*z_L7_theta_ + rhs_A_y_ - rhs_O6_y_ + rhs_P2_y_ + rhs_Q6_y_ + z_O1_y_;
    const double z_P3_x_ = arm_L4_head_y_*rhs_crank4_ - l_P3_x_L3_theta_*z_L3_theta_ - l_P3_x_L6_theta_*z_L6_theta_
        - l_P3_x_L7_theta_*z_L7_theta_ - l_P3_x_P2_x_*z_P2_x_ - l_P3_x_P2_y_*z_P2_y_ + rhs_B_x_ - rhs_O6_x_ + rhs_P3_x_
        + rhs_Q6_x_ + z_O4_x_;
    const double z_P3_y_ = -arm_L4_head_x_*rhs_crank4_ - l_P3_y_L3_theta_*z_L3_theta_ - l_P3_y_L6_theta_*z_L6_theta_
        - l_P3_y_L7_theta_*z_L7_theta_ - l_P3_y_P2_x_*z_P2_x_ - l_P3_y_P2_y_*z_P2_y_ + rhs_B_y_ - rhs_O6_y_ + rhs_P3_y_
        + rhs_Q6_y_ + z_O4_y_;
    const double z_guide_offset_ = -l_guide_offset_L6_theta_*z_L6_theta_ - l_guide_offset_L7_theta_*z_L7_theta_
        - l_guide_offset_L8_theta_*z_L8_theta_ - l_guide_offset_P2_x_*z_P2_x_ - l_guide_offset_P2_y_*z_P2_y_
        - l_guide_offset_P3_x_*z_P3_x_ - l_guide_offset_P3_y_*z_P3_y_ - rhs_O6_x_ + rhs_Q6_x_ - rhs_Q8_x_
        + rhs_guide_offset_ - rhs_slider_x_;

    /* backward substitution */
    const double lambda_guide_offset_ = -inverse_pivot_guide_offset_*z_guide_offset_;
    const double lambda_P3_y_ = inverse_cross_P3_x_P3_y_*z_P3_x_ + inverse_pivot_P3_y_*z_P3_y_
        - l_guide_offset_P3_y_*lambda_guide_offset_;
    const double lambda_P3_x_ = inverse_cross_P3_x_P3_y_*z_P3_y_ + inverse_pivot_P3_x_*z_P3_x_
        - l_guide_offset_P3_x_*lambda_guide_offset_;
    const double lambda_P2_y_ = inverse_cross_P2_x_P2_y_*z_P2_x_ + inverse_pivot_P2_y_*z_P2_y_
        - l_P3_x_P2_y_*lambda_P3_x_ - l_P3_y_P2_y_*lambda_P3_y_ - l_guide_offset_P2_y_*lambda_guide_offset_;
    const double lambda_P2_x_ = inverse_cross_P2_x_P2_y_*z_P2_y_ + inverse_pivot_P2_x_*z_P2_x_
        - l_P3_x_P2_x_*lambda_P3_x_ - l_P3_y_P2_x_*lambda_P3_y_ - l_guide_offset_P2_x_*lambda_guide_offset_;
    const double acceleration_L7_theta_ = inverse_cross_L6_theta_L7_theta_*z_L6_theta_
        + inverse_pivot_L7_theta_*z_L7_theta_ - l_P2_x_L7_theta_*lambda_P2_x_ - l_P2_y_L7_theta_*lambda_P2_y_
        - l_P3_x_L7_theta_*lambda_P3_x_ - l_P3_y_L7_theta_*lambda_P3_y_ - l_guide_offset_L7_theta_*lambda_guide_offset_;
    const double acceleration_L6_theta_ = inverse_cross_L6_theta_L7_theta_*z_L7_theta_
        + inverse_pivot_L6_theta_*z_L6_theta_ - l_P2_x_L6_theta_*lambda_P2_x_ - l_P2_y_L6_theta_*lambda_P2_y_
        - l_P3_x_L6_theta_*lambda_P3_x_ - l_P3_y_L6_theta_*lambda_P3_y_ - l_guide_offset_L6_theta_*lambda_guide_offset_;
    const double acceleration_L8_theta_ = -acceleration_L6_theta_*l_L6_theta_L8_theta_
        - acceleration_L7_theta_*l_L7_theta_L8_theta_ + inverse_pivot_L8_theta_*z_L8_theta_
        - l_guide_offset_L8_theta_*lambda_guide_offset_;
    const double acceleration_L3_theta_ = inverse_pivot_L3_theta_*z_L3_theta_ - l_P3_x_L3_theta_*lambda_P3_x_
        - l_P3_y_L3_theta_*lambda_P3_y_;
    const double acceleration_L2_theta_ = inverse_pivot_L2_theta_*z_L2_theta_ - l_P2_x_L2_theta_*lambda_P2_x_
        - l_P2_y_L2_theta_*lambda_P2_y_;
    const double lambda_O1_x_ = -acceleration_L2_theta_*l_L2_theta_A_x_ - inertia_L1_x_*z_O1_x_ + lambda_P2_x_
        - z_L1_x_;
    const double acceleration_L1_x_ = -z_O1_x_;
    const double lambda_O1_y_ = -acceleration_L2_theta_*l_L2_theta_A_y_ - inertia_L1_y_*z_O1_y_ + lambda_P2_y_
        - z_L1_y_;
    const double acceleration_L1_y_ = -z_O1_y_;
    const double lambda_O4_x_ = -acceleration_L3_theta_*l_L3_theta_B_x_ - inertia_L4_x_*z_O4_x_ + lambda_P3_x_
        - z_L4_x_;
    const double acceleration_L4_x_ = -z_O4_x_;
    const double lambda_O4_y_ = -acceleration_L3_theta_*l_L3_theta_B_y_ - inertia_L4_y_*z_O4_y_ + lambda_P3_y_
        - z_L4_y_;
    const double acceleration_L4_y_ = -z_O4_y_;
    const double lambda_O6_x_ = -acceleration_L6_theta_*l_L6_theta_O6_x_ + acceleration_L7_theta_*l_L7_theta_Q6_x_
        - acceleration_L8_theta_*l_L8_theta_Q8_x_ - inertia_L6_x_*rhs_O6_x_ - lambda_P2_x_ - lambda_P3_x_
        - lambda_guide_offset_ - z_L6_x_;
    const double acceleration_L6_x_ = -acceleration_L6_theta_*arm_L6_head_y_ - rhs_O6_x_;
    const double lambda_O6_y_ = -acceleration_L6_theta_*l_L6_theta_O6_y_ + acceleration_L7_theta_*l_L7_theta_Q6_y_
        - acceleration_L8_theta_*l_L8_theta_Q8_y_ - inertia_L6_y_*rhs_O6_y_ - lambda_P2_y_ - lambda_P3_y_ - z_L6_y_;
    const double acceleration_L6_y_ = acceleration_L6_theta_*arm_L6_head_x_ - rhs_O6_y_;
    const double lambda_guide_angle_ = -p->S9_inertia_*rhs_guide_angle_;
    const double acceleration_S9_theta_ = rhs_guide_angle_;
    const double lambda_crank1_ = -acceleration_L1_x_*w_L1_x_L1_theta_ - acceleration_L1_y_*w_L1_y_L1_theta_
        - acceleration_L2_theta_*w_L2_theta_L1_theta_ - arm_L1_head_x_*lambda_O1_y_ - arm_L1_head_x_*lambda_P2_y_
        + arm_L1_head_y_*lambda_O1_x_ + arm_L1_head_y_*lambda_P2_x_ - inertia_L1_theta_*rhs_crank1_ + z_L1_theta_;
    const double acceleration_L1_theta_ = rhs_crank1_;
    const double lambda_crank4_ = -acceleration_L3_theta_*w_L3_theta_L4_theta_ - acceleration_L4_x_*w_L4_x_L4_theta_
        - acceleration_L4_y_*w_L4_y_L4_theta_ - arm_L4_head_x_*lambda_O4_y_ - arm_L4_head_x_*lambda_P3_y_
        + arm_L4_head_y_*lambda_O4_x_ + arm_L4_head_y_*lambda_P3_x_ - inertia_L4_theta_*rhs_crank4_ + z_L4_theta_;
    const double acceleration_L4_theta_ = rhs_crank4_;
    const double lambda_A_x_ = p->L2_mass_*acceleration_L1_x_ - p->L2_mass_*rhs_A_x_
        - acceleration_L1_theta_*l_L1_theta_A_x_ - acceleration_L2_theta_*l_L2_theta_A_x_ + lambda_P2_x_;
    const double acceleration_L2_x_ = -acceleration_L1_theta_*arm_L1_head_y_ + acceleration_L1_x_
        - acceleration_L2_theta_*arm_L2_head_y_ - rhs_A_x_;
    const double lambda_A_y_ = p->L2_mass_*acceleration_L1_y_ - p->L2_mass_*rhs_A_y_
        - acceleration_L1_theta_*l_L1_theta_A_y_ - acceleration_L2_theta_*l_L2_theta_A_y_ + lambda_P2_y_
        - p->weight_L2_y_;
    const double acceleration_L2_y_ = acceleration_L1_theta_*arm_L1_head_x_ + acceleration_L1_y_
        + acceleration_L2_theta_*arm_L2_head_x_ - rhs_A_y_;
    const double lambda_B_x_ = p->L3_mass_*acceleration_L4_x_ - p->L3_mass_*rhs_B_x_
        - acceleration_L3_theta_*l_L3_theta_B_x_ - acceleration_L4_theta_*l_L4_theta_B_x_ + lambda_P3_x_;
    const double acceleration_L3_x_ = -acceleration_L3_theta_*arm_L3_head_y_ - acceleration_L4_theta_*arm_L4_head_y_
        + acceleration_L4_x_ - rhs_B_x_;
    const double lambda_B_y_ = p->L3_mass_*acceleration_L4_y_ - p->L3_mass_*rhs_B_y_
        - acceleration_L3_theta_*l_L3_theta_B_y_ - acceleration_L4_theta_*l_L4_theta_B_y_ + lambda_P3_y_
        - p->weight_L3_y_;
    const double acceleration_L3_y_ = acceleration_L3_theta_*arm_L3_head_x_ + acceleration_L4_theta_*arm_L4_head_x_
        + acceleration_L4_y_ - rhs_B_y_;
    const double lambda_Q6_x_ = -acceleration_L6_theta_*l_L6_theta_Q6_x_ - acceleration_L6_x_*inertia_L7_x_
        - acceleration_L7_theta_*l_L7_theta_Q6_x_ + acceleration_L8_theta_*l_L8_theta_Q8_x_ - inertia_L7_x_*rhs_Q6_x_
        + lambda_P2_x_ + lambda_P3_x_ + lambda_guide_offset_ + z_L7_x_;
    const double acceleration_L7_x_ = -acceleration_L6_theta_*arm_L6_head_y_ + acceleration_L6_x_
        + acceleration_L7_theta_*arm_L7_head_y_ + rhs_Q6_x_;
    const double lambda_Q6_y_ = -acceleration_L6_theta_*l_L6_theta_Q6_y_ - acceleration_L6_y_*inertia_L7_y_
        - acceleration_L7_theta_*l_L7_theta_Q6_y_ + acceleration_L8_theta_*l_L8_theta_Q8_y_ - inertia_L7_y_*rhs_Q6_y_
        + lambda_P2_y_ + lambda_P3_y_ + z_L7_y_;
    const double acceleration_L7_y_ = acceleration_L6_theta_*arm_L6_head_x_ + acceleration_L6_y_
        - acceleration_L7_theta_*arm_L7_head_x_ + rhs_Q6_y_;
    const double lambda_Q8_x_ = -acceleration_L7_theta_*l_L7_theta_Q8_x_ + acceleration_L7_x_*inertia_L8_x_
        - acceleration_L8_theta_*l_L8_theta_Q8_x_ - inertia_L8_x_*rhs_Q8_x_ - lambda_guide_offset_ - z_L8_x_;
    const double acceleration_L8_x_ = -acceleration_L7_theta_*arm_L7_head_y_ + acceleration_L7_x_
        - acceleration_L8_theta_*arm_L8_head_y_ - rhs_Q8_x_;
    const double lambda_Q8_y_ = -acceleration_L7_theta_*l_L7_theta_Q8_y_ + acceleration_L7_y_*inertia_L8_y_
        - acceleration_L8_theta_*l_L8_theta_Q8_y_ - inertia_L8_y_*rhs_Q8_y_ - z_L8_y_;
    const double acceleration_L8_y_ = acceleration_L7_theta_*arm_L7_head_x_ + acceleration_L7_y_
        + acceleration_L8_theta_*arm_L8_head_x_ - rhs_Q8_y_;
    const double lambda_slider_x_ = p->S9_mass_*acceleration_L8_x_ - p->S9_mass_*rhs_slider_x_
        - acceleration_L8_theta_*l_L8_theta_slider_x_ - lambda_guide_offset_;
    const double acceleration_S9_x_ = -acceleration_L8_theta_*arm_L8_head_y_ + acceleration_L8_x_ - rhs_slider_x_;
    const double lambda_slider_y_ = p->S9_mass_*acceleration_L8_y_ - p->S9_mass_*rhs_slider_y_
        - acceleration_L8_theta_*l_L8_theta_slider_y_ - p->weight_S9_y_;
    const double acceleration_S9_y_ = acceleration_L8_theta_*arm_L8_head_x_ + acceleration_L8_y_ - rhs_slider_y_;

    /* results */
    a[0] = acceleration_L1_x_;
    a[1] = acceleration_L1_y_;
    a[2] = acceleration_L1_theta_;
    a[3] = acceleration_L2_x_;
    a[4] = acceleration_L2_y_;
    a[5] = acceleration_L2_theta_;
    a[6] = acceleration_L3_x_;
    a[7] = acceleration_L3_y_;
    a[8] = acceleration_L3_theta_;
    a[9] = acceleration_L4_x_;
    a[10] = acceleration_L4_y_;
    a[11] = acceleration_L4_theta_;
    a[12] = acceleration_L6_x_;
    a[13] = acceleration_L6_y_;
    a[14] = acceleration_L6_theta_;
    a[15] = acceleration_L7_x_;
    a[16] = acceleration_L7_y_;
    a[17] = acceleration_L7_theta_;
    a[18] = acceleration_L8_x_;
    a[19] = acceleration_L8_y_;
    a[20] = acceleration_L8_theta_;
    a[21] = acceleration_S9_x_;
    a[22] = acceleration_S9_y_;
    a[23] = acceleration_S9_theta_;
    rhs->lambda[0] = lambda_O1_x_;
    rhs->lambda[1] = lambda_O1_y_;
    rhs->lambda[2] = lambda_O4_x_;
    rhs->lambda[3] = lambda_O4_y_;
    rhs->lambda[4] = lambda_A_x_;
    rhs->lambda[5] = lambda_A_y_;
    rhs->lambda[6] = lambda_B_x_;
    rhs->lambda[7] = lambda_B_y_;
    rhs->lambda[8] = lambda_P2_x_;
    rhs->lambda[9] = lambda_P2_y_;
    rhs->lambda[10] = lambda_P3_x_;
    rhs->lambda[11] = lambda_P3_y_;
    rhs->lambda[12] = lambda_Q6_x_;
    rhs->lambda[13] = lambda_Q6_y_;
    rhs->lambda[14] = lambda_Q8_x_;
    rhs->lambda[15] = lambda_Q8_y_;
    rhs->lambda[16] = lambda_O6_x_;
    rhs->lambda[17] = lambda_O6_y_;
    rhs->lambda[18] = lambda_slider_x_;
    rhs->lambda[19] = lambda_slider_y_;
    rhs->lambda[20] = lambda_guide_offset_;
    rhs->lambda[21] = lambda_guide_angle_;
    rhs->lambda[22] = lambda_crank1_;
    rhs->lambda[23] = lambda_crank4_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_L1_y_;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_L2_y_;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_L3_y_;
        force[8] = 0.0;
        force[9] = 0.0;
        force[10] = p->weight_L4_y_;
        force[11] = 0.0;
        force[12] = 0.0;
        force[13] = p->weight_L6_y_;
        force[14] = 0.0;
        force[15] = 0.0;
        force[16] = p->weight_L7_y_;
        force[17] = 0.0;
        force[18] = 0.0;
        force[19] = p->weight_L8_y_;
        force[20] = 0.0;
        force[21] = 0.0;
        force[22] = p->weight_S9_y_;
        force[23] = 0.0;
        gamma_stab[0] = rhs_O1_x_;
        gamma_stab[1] = rhs_O1_y_;
        gamma_stab[2] = rhs_O4_x_;
        gamma_stab[3] = rhs_O4_y_;
        gamma_stab[4] = rhs_A_x_;
        gamma_stab[5] = rhs_A_y_;
        gamma_stab[6] = rhs_B_x_;
        gamma_stab[7] = rhs_B_y_;
        gamma_stab[8] = rhs_P2_x_;
        gamma_stab[9] = rhs_P2_y_;
        gamma_stab[10] = rhs_P3_x_;
        gamma_stab[11] = rhs_P3_y_;
        gamma_stab[12] = rhs_Q6_x_;
        gamma_stab[13] = rhs_Q6_y_;
        gamma_stab[14] = rhs_Q8_x_;
        gamma_stab[15] = rhs_Q8_y_;
        gamma_stab[16] = rhs_O6_x_;
        gamma_stab[17] = rhs_O6_y_;
        gamma_stab[18] = rhs_slider_x_;
        gamma_stab[19] = rhs_slider_y_;
        gamma_stab[20] = rhs_guide_offset_;
        gamma_stab[21] = rhs_guide_angle_;
        gamma_stab[22] = rhs_crank1_;
        gamma_stab[23] = rhs_crank4_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = -crank1_rate_*rhs->lambda[22] - crank4_rate_*rhs->lambda[23];
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
