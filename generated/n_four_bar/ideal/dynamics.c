/*
 * Right-hand side: accelerations a (n) and multipliers in `rhs` at a state, from
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where dependent constraint equations contradict each other.
 * Unknowns in the order of elimination; 'with': two unknowns, one 2 x 2 pivot:
 *     coupler2.y with lambda of A1.y; coupler2.x with lambda of A1.x; coupler1.y with lambda of A0.y;
 *     coupler1.x with lambda of A0.x; crank2.y with lambda of O2.y; crank2.x with lambda of O2.x;
 *     crank1.y with lambda of O1.y; crank1.x with lambda of O1.x; crank0.y with lambda of O0.y;
 *     crank0.x with lambda of O0.x; crank2.theta; crank0.theta with coupler1.theta; coupler2.theta;
 *     crank1.theta; lambda of B1.x with lambda of B1.y; lambda of B2.x with lambda of B2.y.
 */
int dynamics(const double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    /* coordinates, velocities, time */
    const double crank0_x_ = q[0];
    const double crank0_y_ = q[1];
    const double crank0_theta_ = q[2];
    const double crank0_vx_ = v[0];
    const double crank0_vy_ = v[1];
    const double crank0_omega_ = v[2];
    const double crank1_x_ = q[3];
    const double crank1_y_ = q[4];
    const double crank1_theta_ = q[5];
    const double crank1_vx_ = v[3];
    const double crank1_vy_ = v[4];
    const double crank1_omega_ = v[5];
    const double crank2_x_ = q[6];
    const double crank2_y_ = q[7];
    const double crank2_theta_ = q[8];
    const double crank2_vx_ = v[6];
    const double crank2_vy_ = v[7];
    const double crank2_omega_ = v[8];
    const double coupler1_x_ = q[9];
    const double coupler1_y_ = q[10];
    const double coupler1_theta_ = q[11];
    const double coupler1_vx_ = v[9];
    const double coupler1_vy_ = v[10];
    const double coupler1_omega_ = v[11];
    const double coupler2_x_ = q[12];
    const double coupler2_y_ = q[13];
    const double coupler2_theta_ = q[14];
    const double coupler2_vx_ = v[12];
    const double coupler2_vy_ = v[13];
    const double coupler2_omega_ = v[14];

    /* directions, arms, drives */
    const double cos_theta_crank0_ = cos(crank0_theta_);
    const double sin_theta_crank0_ = sin(crank0_theta_);
    const double arm_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_s_x_;
    const double arm_crank0_head_y_ = p->crank0_head_s_x_*sin_theta_crank0_;
    const double cos_theta_crank1_ = cos(crank1_theta_);
    const double sin_theta_crank1_ = sin(crank1_theta_);
    const double arm_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_s_x_;
    const double arm_crank1_head_y_ = p->crank1_head_s_x_*sin_theta_crank1_;
    const double cos_theta_crank2_ = cos(crank2_theta_);
    const double sin_theta_crank2_ = sin(crank2_theta_);
    const double arm_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_s_x_;
    const double arm_crank2_head_y_ = p->crank2_head_s_x_*sin_theta_crank2_;
    const double cos_theta_coupler1_ = cos(coupler1_theta_);
    const double sin_theta_coupler1_ = sin(coupler1_theta_);
    const double arm_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_s_x_;
    const double arm_coupler1_head_y_ = p->coupler1_head_s_x_*sin_theta_coupler1_;
    const double cos_theta_coupler2_ = cos(coupler2_theta_);
    const double sin_theta_coupler2_ = sin(coupler2_theta_);
    const double arm_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_s_x_;
    const double arm_coupler2_head_y_ = p->coupler2_head_s_x_*sin_theta_coupler2_;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O0_x_ = arm_crank0_head_x_ - crank0_x_;
    const double phi_dot_O0_x_ = -arm_crank0_head_y_*crank0_omega_ - crank0_vx_;
    const double rhs_O0_x_ = arm_crank0_head_x_*(crank0_omega_ * crank0_omega_) - p->beta_squared_*phi_O0_x_
        - phi_dot_O0_x_*p->two_alpha_;
    rhs->phi[0] = phi_O0_x_;
    rhs->phi_dot[0] = phi_dot_O0_x_;
    const double phi_O0_y_ = arm_crank0_head_y_ - crank0_y_;
    const double phi_dot_O0_y_ = arm_crank0_head_x_*crank0_omega_ - crank0_vy_;
    const double rhs_O0_y_ = arm_crank0_head_y_*(crank0_omega_ * crank0_omega_) - p->beta_squared_*phi_O0_y_
        - phi_dot_O0_y_*p->two_alpha_;
    rhs->phi[1] = phi_O0_y_;
    rhs->phi_dot[1] = phi_dot_O0_y_;
    const double phi_O1_x_ = p->O1_x_ + arm_crank1_head_x_ - crank1_x_;
    const double phi_dot_O1_x_ = -arm_crank1_head_y_*crank1_omega_ - crank1_vx_;
    const double rhs_O1_x_ = arm_crank1_head_x_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_O1_x_
        - phi_dot_O1_x_*p->two_alpha_;
    rhs->phi[2] = phi_O1_x_;
    rhs->phi_dot[2] = phi_dot_O1_x_;
    const double phi_O1_y_ = arm_crank1_head_y_ - crank1_y_;
    const double phi_dot_O1_y_ = arm_crank1_head_x_*crank1_omega_ - crank1_vy_;
    const double rhs_O1_y_ = arm_crank1_head_y_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_O1_y_
        - phi_dot_O1_y_*p->two_alpha_;
    rhs->phi[3] = phi_O1_y_;
    rhs->phi_dot[3] = phi_dot_O1_y_;
    const double phi_O2_x_ = p->O2_x_ + arm_crank2_head_x_ - crank2_x_;
    const double phi_dot_O2_x_ = -arm_crank2_head_y_*crank2_omega_ - crank2_vx_;
    const double rhs_O2_x_ = arm_crank2_head_x_*(crank2_omega_ * crank2_omega_) - p->beta_squared_*phi_O2_x_
        - phi_dot_O2_x_*p->two_alpha_;
    rhs->phi[4] = phi_O2_x_;
    rhs->phi_dot[4] = phi_dot_O2_x_;
    const double phi_O2_y_ = arm_crank2_head_y_ - crank2_y_;
    const double phi_dot_O2_y_ = arm_crank2_head_x_*crank2_omega_ - crank2_vy_;
    const double rhs_O2_y_ = arm_crank2_head_y_*(crank2_omega_ * crank2_omega_) - p->beta_squared_*phi_O2_y_
        - phi_dot_O2_y_*p->two_alpha_;
    rhs->phi[5] = phi_O2_y_;
    rhs->phi_dot[5] = phi_dot_O2_y_;
    const double phi_A0_x_ = arm_coupler1_head_x_ + arm_crank0_head_x_ - coupler1_x_ + crank0_x_;
    const double phi_dot_A0_x_ = -arm_coupler1_head_y_*coupler1_omega_ - arm_crank0_head_y_*crank0_omega_
        - coupler1_vx_ + crank0_vx_;
    const double rhs_A0_x_ = arm_coupler1_head_x_*(coupler1_omega_ * coupler1_omega_)
        + arm_crank0_head_x_*(crank0_omega_ * crank0_omega_) - p->beta_squared_*phi_A0_x_ - phi_dot_A0_x_*p->two_alpha_;
    rhs->phi[6] = phi_A0_x_;
    rhs->phi_dot[6] = phi_dot_A0_x_;
    const double phi_A0_y_ = arm_coupler1_head_y_ + arm_crank0_head_y_ - coupler1_y_ + crank0_y_;
    const double phi_dot_A0_y_ = arm_coupler1_head_x_*coupler1_omega_ + arm_crank0_head_x_*crank0_omega_ - coupler1_vy_
        + crank0_vy_;
    const double rhs_A0_y_ = arm_coupler1_head_y_*(coupler1_omega_ * coupler1_omega_)
        + arm_crank0_head_y_*(crank0_omega_ * crank0_omega_) - p->beta_squared_*phi_A0_y_ - phi_dot_A0_y_*p->two_alpha_;
    rhs->phi[7] = phi_A0_y_;
    rhs->phi_dot[7] = phi_dot_A0_y_;
    const double phi_B1_x_ = arm_coupler1_head_x_ - arm_crank1_head_x_ + coupler1_x_ - crank1_x_;
    const double phi_dot_B1_x_ = -arm_coupler1_head_y_*coupler1_omega_ + arm_crank1_head_y_*crank1_omega_
        + coupler1_vx_ - crank1_vx_;
    const double rhs_B1_x_ = arm_coupler1_head_x_*(coupler1_omega_ * coupler1_omega_)
        - arm_crank1_head_x_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_B1_x_ - phi_dot_B1_x_*p->two_alpha_;
    rhs->phi[8] = phi_B1_x_;
    rhs->phi_dot[8] = phi_dot_B1_x_;
    const double phi_B1_y_ = arm_coupler1_head_y_ - arm_crank1_head_y_ + coupler1_y_ - crank1_y_;
    const double phi_dot_B1_y_ = arm_coupler1_head_x_*coupler1_omega_ - arm_crank1_head_x_*crank1_omega_ + coupler1_vy_
        - crank1_vy_;
    const double rhs_B1_y_ = arm_coupler1_head_y_*(coupler1_omega_ * coupler1_omega_)
        - arm_crank1_head_y_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_B1_y_ - phi_dot_B1_y_*p->two_alpha_;
    rhs->phi[9] = phi_B1_y_;
    rhs->phi_dot[9] = phi_dot_B1_y_;
    const double phi_A1_x_ = arm_coupler2_head_x_ + arm_crank1_head_x_ - coupler2_x_ + crank1_x_;
    const double phi_dot_A1_x_ = -arm_coupler2_head_y_*coupler2_omega_ - arm_crank1_head_y_*crank1_omega_
        - coupler2_vx_ + crank1_vx_;
    const double rhs_A1_x_ = arm_coupler2_head_x_*(coupler2_omega_ * coupler2_omega_)
        + arm_crank1_head_x_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_A1_x_ - phi_dot_A1_x_*p->two_alpha_;
    rhs->phi[10] = phi_A1_x_;
    rhs->phi_dot[10] = phi_dot_A1_x_;
    const double phi_A1_y_ = arm_coupler2_head_y_ + arm_crank1_head_y_ - coupler2_y_ + crank1_y_;
    const double phi_dot_A1_y_ = arm_coupler2_head_x_*coupler2_omega_ + arm_crank1_head_x_*crank1_omega_ - coupler2_vy_
        + crank1_vy_;
    const double rhs_A1_y_ = arm_coupler2_head_y_*(coupler2_omega_ * coupler2_omega_)
        + arm_crank1_head_y_*(crank1_omega_ * crank1_omega_) - p->beta_squared_*phi_A1_y_ - phi_dot_A1_y_*p->two_alpha_;
    rhs->phi[11] = phi_A1_y_;
    rhs->phi_dot[11] = phi_dot_A1_y_;
    const double phi_B2_x_ = arm_coupler2_head_x_ - arm_crank2_head_x_ + coupler2_x_ - crank2_x_;
    const double phi_dot_B2_x_ = -arm_coupler2_head_y_*coupler2_omega_ + arm_crank2_head_y_*crank2_omega_
        + coupler2_vx_ - crank2_vx_;
    const double rhs_B2_x_ = arm_coupler2_head_x_*(coupler2_omega_ * coupler2_omega_)
        - arm_crank2_head_x_*(crank2_omega_ * crank2_omega_) - p->beta_squared_*phi_B2_x_ - phi_dot_B2_x_*p->two_alpha_;
    rhs->phi[12] = phi_B2_x_;
    rhs->phi_dot[12] = phi_dot_B2_x_;
    const double phi_B2_y_ = arm_coupler2_head_y_ - arm_crank2_head_y_ + coupler2_y_ - crank2_y_;
    const double phi_dot_B2_y_ = arm_coupler2_head_x_*coupler2_omega_ - arm_crank2_head_x_*crank2_omega_ + coupler2_vy_
        - crank2_vy_;
    const double rhs_B2_y_ = arm_coupler2_head_y_*(coupler2_omega_ * coupler2_omega_)
        - arm_crank2_head_y_*(crank2_omega_ * crank2_omega_) - p->beta_squared_*phi_B2_y_ - phi_dot_B2_y_*p->two_alpha_;
    rhs->phi[13] = phi_B2_y_;
    rhs->phi_dot[13] = phi_dot_B2_y_;

    /* L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0] */
    const double l_coupler2_theta_A1_y_ = -arm_coupler2_head_x_*p->coupler2_mass_;
    const double l_crank1_theta_A1_y_ = -arm_crank1_head_x_*p->coupler2_mass_;
    const double l_coupler2_theta_A1_x_ = arm_coupler2_head_y_*p->coupler2_mass_;
    const double l_crank1_theta_A1_x_ = arm_crank1_head_y_*p->coupler2_mass_;
    const double l_crank0_theta_A0_y_ = -arm_crank0_head_x_*p->coupler1_mass_;
    const double l_coupler1_theta_A0_y_ = -arm_coupler1_head_x_*p->coupler1_mass_;
    const double l_crank0_theta_A0_x_ = arm_crank0_head_y_*p->coupler1_mass_;
    const double l_coupler1_theta_A0_x_ = arm_coupler1_head_y_*p->coupler1_mass_;
    const double l_crank2_theta_O2_y_ = -arm_crank2_head_x_*p->crank2_mass_;
    const double l_crank2_theta_O2_x_ = arm_crank2_head_y_*p->crank2_mass_;
    const double inertia_crank1_y_ = p->coupler2_mass_ + p->crank1_mass_;
    const double l_crank1_theta_O1_y_ = -arm_crank1_head_x_*inertia_crank1_y_ + l_crank1_theta_A1_y_;
    const double inertia_crank1_x_ = p->coupler2_mass_ + p->crank1_mass_;
    const double l_crank1_theta_O1_x_ = arm_crank1_head_y_*inertia_crank1_x_ + l_crank1_theta_A1_x_;
    const double inertia_crank0_y_ = p->coupler1_mass_ + p->crank0_mass_;
    const double l_crank0_theta_O0_y_ = -arm_crank0_head_x_*inertia_crank0_y_ + l_crank0_theta_A0_y_;
    const double inertia_crank0_x_ = p->coupler1_mass_ + p->crank0_mass_;
    const double l_crank0_theta_O0_x_ = arm_crank0_head_y_*inertia_crank0_x_ + l_crank0_theta_A0_x_;
    const double pivot_crank2_theta_ = -arm_crank2_head_x_*l_crank2_theta_O2_y_
        + arm_crank2_head_y_*l_crank2_theta_O2_x_ + p->crank2_inertia_;
    if (!(pivot_crank2_theta_ > LIGHT_PIVOT * p->crank2_turning_)) {
        pivot = 15;
        goto dependent;
    }
    const double inverse_pivot_crank2_theta_ = 1.0/pivot_crank2_theta_;
    const double w_B2_x_crank2_theta_ = 2.0*arm_crank2_head_y_;
    const double l_B2_x_crank2_theta_ = inverse_pivot_crank2_theta_*w_B2_x_crank2_theta_;
    const double w_B2_y_crank2_theta_ = -2.0*arm_crank2_head_x_;
    const double l_B2_y_crank2_theta_ = inverse_pivot_crank2_theta_*w_B2_y_crank2_theta_;
    const double pivot_crank0_theta_ = -2.0*arm_crank0_head_x_*l_crank0_theta_A0_y_
        - arm_crank0_head_x_*l_crank0_theta_O0_y_ + 2.0*arm_crank0_head_y_*l_crank0_theta_A0_x_
        + arm_crank0_head_y_*l_crank0_theta_O0_x_ + p->crank0_inertia_;
    const double pivot_coupler1_theta_ = -arm_coupler1_head_x_*l_coupler1_theta_A0_y_
        + arm_coupler1_head_y_*l_coupler1_theta_A0_x_ + p->coupler1_inertia_;
    const double pivot_crank0_theta_coupler1_theta_ = -2.0*arm_crank0_head_x_*l_coupler1_theta_A0_y_
        + 2.0*arm_crank0_head_y_*l_coupler1_theta_A0_x_;
    const double determinant_crank0_theta_coupler1_theta_ = pivot_coupler1_theta_*pivot_crank0_theta_
        - (pivot_crank0_theta_coupler1_theta_ * pivot_crank0_theta_coupler1_theta_);
    if (!(pivot_crank0_theta_ > LIGHT_PIVOT * p->crank0_turning_)) {
        pivot = 16;
        goto dependent;
    }
    if (!(determinant_crank0_theta_coupler1_theta_ > LIGHT_PIVOT * p->coupler1_turning_ * pivot_crank0_theta_)) {
        pivot = 17;
        goto dependent;
    }
    const double inverse_crank0_theta_coupler1_theta_ = 1.0/determinant_crank0_theta_coupler1_theta_;
    const double inverse_pivot_crank0_theta_ = inverse_crank0_theta_coupler1_theta_*pivot_coupler1_theta_;
    const double inverse_pivot_coupler1_theta_ = inverse_crank0_theta_coupler1_theta_*pivot_crank0_theta_;
    const double inverse_cross_crank0_theta_coupler1_theta_ =
        -inverse_crank0_theta_coupler1_theta_*pivot_crank0_theta_coupler1_theta_;
    const double w_B1_x_crank0_theta_ = -2.0*arm_crank0_head_y_;
    const double w_B1_x_coupler1_theta_ = -2.0*arm_coupler1_head_y_;
    const double l_B1_x_crank0_theta_ = inverse_cross_crank0_theta_coupler1_theta_*w_B1_x_coupler1_theta_
        + inverse_pivot_crank0_theta_*w_B1_x_crank0_theta_;
    const double l_B1_x_coupler1_theta_ = inverse_cross_crank0_theta_coupler1_theta_*w_B1_x_crank0_theta_
        + inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const double w_B1_y_crank0_theta_ = 2.0*arm_crank0_head_x_;
    const double w_B1_y_coupler1_theta_ = 2.0*arm_coupler1_head_x_;
    const double l_B1_y_crank0_theta_ = inverse_cross_crank0_theta_coupler1_theta_*w_B1_y_coupler1_theta_
        + inverse_pivot_crank0_theta_*w_B1_y_crank0_theta_;
    const double l_B1_y_coupler1_theta_ = inverse_cross_crank0_theta_coupler1_theta_*w_B1_y_crank0_theta_
        + inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const double pivot_coupler2_theta_ = -arm_coupler2_head_x_*l_coupler2_theta_A1_y_
        + arm_coupler2_head_y_*l_coupler2_theta_A1_x_ + p->coupler2_inertia_;
    if (!(pivot_coupler2_theta_ > LIGHT_PIVOT * p->coupler2_turning_)) {
        pivot = 18;
        goto dependent;
    }
    const double inverse_pivot_coupler2_theta_ = 1.0/pivot_coupler2_theta_;
    const double w_crank1_theta_coupler2_theta_ = -arm_coupler2_head_x_*l_crank1_theta_A1_y_
        + arm_coupler2_head_y_*l_crank1_theta_A1_x_ - arm_crank1_head_x_*l_coupler2_theta_A1_y_
        + arm_crank1_head_y_*l_coupler2_theta_A1_x_;
    const double l_crank1_theta_coupler2_theta_ = inverse_pivot_coupler2_theta_*w_crank1_theta_coupler2_theta_;
    const double w_B2_x_coupler2_theta_ = -2.0*arm_coupler2_head_y_;
    const double l_B2_x_coupler2_theta_ = inverse_pivot_coupler2_theta_*w_B2_x_coupler2_theta_;
    const double w_B2_y_coupler2_theta_ = 2.0*arm_coupler2_head_x_;
    const double l_B2_y_coupler2_theta_ = inverse_pivot_coupler2_theta_*w_B2_y_coupler2_theta_;
    const double pivot_crank1_theta_ = -2.0*arm_crank1_head_x_*l_crank1_theta_A1_y_
        - arm_crank1_head_x_*l_crank1_theta_O1_y_ + 2.0*arm_crank1_head_y_*l_crank1_theta_A1_x_
        + arm_crank1_head_y_*l_crank1_theta_O1_x_ + p->crank1_inertia_
        - l_crank1_theta_coupler2_theta_*w_crank1_theta_coupler2_theta_;
    if (!(pivot_crank1_theta_ > LIGHT_PIVOT * p->crank1_turning_)) {
        pivot = 19;
        goto dependent;
    }
    const double inverse_pivot_crank1_theta_ = 1.0/pivot_crank1_theta_;
    const double w_B1_x_crank1_theta_ = 2.0*arm_crank1_head_y_;
    const double l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*w_B1_x_crank1_theta_;
    const double w_B1_y_crank1_theta_ = -2.0*arm_crank1_head_x_;
    const double l_B1_y_crank1_theta_ = inverse_pivot_crank1_theta_*w_B1_y_crank1_theta_;
    const double w_B2_x_crank1_theta_ = -2.0*arm_crank1_head_y_ - l_B2_x_coupler2_theta_*w_crank1_theta_coupler2_theta_;
    const double l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_x_crank1_theta_;
    const double w_B2_y_crank1_theta_ = 2.0*arm_crank1_head_x_ - l_B2_y_coupler2_theta_*w_crank1_theta_coupler2_theta_;
    const double l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_y_crank1_theta_;
    const double scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_
        + l_B1_x_crank0_theta_*w_B1_x_crank0_theta_ + l_B1_x_crank1_theta_*w_B1_x_crank1_theta_;
    const double scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_
        + l_B1_y_crank0_theta_*w_B1_y_crank0_theta_ + l_B1_y_crank1_theta_*w_B1_y_crank1_theta_;
    const double size_B1_x_ = p->mobility_B1_x_ + scale_B1_x_;
    const double size_B1_y_ = p->mobility_B1_x_ + scale_B1_y_;
    const double pivot_B1_x_B1_y_ = l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_
        + l_B1_y_crank0_theta_*w_B1_x_crank0_theta_ + l_B1_y_crank1_theta_*w_B1_x_crank1_theta_;
    const double determinant_B1_x_B1_y_ = -(pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_) + scale_B1_x_*scale_B1_y_;
    if (!(scale_B1_x_ > discrete->min_pivot * size_B1_x_)) {
        pivot = 11;
        goto dependent;
    }
    if (!(determinant_B1_x_B1_y_ > discrete->min_pivot * size_B1_y_ * scale_B1_x_)) {
        pivot = 12;
        goto dependent;
    }
    const double inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const double inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*scale_B1_y_;
    const double inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*scale_B1_x_;
    const double inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;
    const double w_B2_x_B1_x_ = -l_B2_x_crank1_theta_*w_B1_x_crank1_theta_;
    const double w_B2_x_B1_y_ = -l_B2_x_crank1_theta_*w_B1_y_crank1_theta_;
    const double l_B2_x_B1_x_ = inverse_cross_B1_x_B1_y_*w_B2_x_B1_y_ + inverse_pivot_B1_x_*w_B2_x_B1_x_;
    const double l_B2_x_B1_y_ = inverse_cross_B1_x_B1_y_*w_B2_x_B1_x_ + inverse_pivot_B1_y_*w_B2_x_B1_y_;
    const double w_B2_y_B1_x_ = -l_B2_y_crank1_theta_*w_B1_x_crank1_theta_;
    const double w_B2_y_B1_y_ = -l_B2_y_crank1_theta_*w_B1_y_crank1_theta_;
    const double l_B2_y_B1_x_ = inverse_cross_B1_x_B1_y_*w_B2_y_B1_y_ + inverse_pivot_B1_x_*w_B2_y_B1_x_;
    const double l_B2_y_B1_y_ = inverse_cross_B1_x_B1_y_*w_B2_y_B1_x_ + inverse_pivot_B1_y_*w_B2_y_B1_y_;
    const double scale_B2_x_ = l_B2_x_coupler2_theta_*w_B2_x_coupler2_theta_
        + l_B2_x_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_x_crank2_theta_*w_B2_x_crank2_theta_;
    const double scale_B2_y_ = l_B2_y_coupler2_theta_*w_B2_y_coupler2_theta_
        + l_B2_y_crank1_theta_*w_B2_y_crank1_theta_ + l_B2_y_crank2_theta_*w_B2_y_crank2_theta_;
    const double size_B2_x_ = p->mobility_B2_x_ + scale_B2_x_;
    const double size_B2_y_ = p->mobility_B2_x_ + scale_B2_y_;
    const double pivot_B2_x_ = l_B2_x_B1_x_*w_B2_x_B1_x_ + l_B2_x_B1_y_*w_B2_x_B1_y_ + scale_B2_x_;
    const double pivot_B2_y_ = l_B2_y_B1_x_*w_B2_y_B1_x_ + l_B2_y_B1_y_*w_B2_y_B1_y_ + scale_B2_y_;
    const double pivot_B2_x_B2_y_ = l_B2_y_B1_x_*w_B2_x_B1_x_ + l_B2_y_B1_y_*w_B2_x_B1_y_
        + l_B2_y_coupler2_theta_*w_B2_x_coupler2_theta_ + l_B2_y_crank1_theta_*w_B2_x_crank1_theta_
        + l_B2_y_crank2_theta_*w_B2_x_crank2_theta_;
    const double determinant_B2_x_B2_y_ = pivot_B2_x_*pivot_B2_y_ - (pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_);
    if (!(pivot_B2_x_ > discrete->min_pivot * size_B2_x_)) {
        pivot = 13;
        goto dependent;
    }
    if (!(determinant_B2_x_B2_y_ > discrete->min_pivot * size_B2_y_ * pivot_B2_x_)) {
        pivot = 14;
        goto dependent;
    }
    const double inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const double inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*pivot_B2_y_;
    const double inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*pivot_B2_x_;
    const double inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;

    /* forward substitution */
    const double z_crank1_y_ = p->coupler2_mass_*rhs_A1_y_ + p->weight_coupler2_y_ + p->weight_crank1_y_;
    const double z_crank1_x_ = p->coupler2_mass_*rhs_A1_x_;
    const double z_crank0_y_ = p->coupler1_mass_*rhs_A0_y_ + p->weight_coupler1_y_ + p->weight_crank0_y_;
    const double z_crank0_x_ = p->coupler1_mass_*rhs_A0_x_;
    const double z_crank2_theta_ = arm_crank2_head_x_*p->weight_crank2_y_ - l_crank2_theta_O2_x_*rhs_O2_x_
        - l_crank2_theta_O2_y_*rhs_O2_y_;
    const double z_crank0_theta_ = arm_crank0_head_x_*p->weight_coupler1_y_ + arm_crank0_head_x_*z_crank0_y_
        - arm_crank0_head_y_*z_crank0_x_ - l_crank0_theta_A0_x_*rhs_A0_x_ - l_crank0_theta_A0_y_*rhs_A0_y_
        - l_crank0_theta_O0_x_*rhs_O0_x_ - l_crank0_theta_O0_y_*rhs_O0_y_;
    const double z_coupler1_theta_ = arm_coupler1_head_x_*p->weight_coupler1_y_ - l_coupler1_theta_A0_x_*rhs_A0_x_
        - l_coupler1_theta_A0_x_*rhs_O0_x_ - l_coupler1_theta_A0_y_*rhs_A0_y_ - l_coupler1_theta_A0_y_*rhs_O0_y_;
    const double z_coupler2_theta_ = arm_coupler2_head_x_*p->weight_coupler2_y_ - l_coupler2_theta_A1_x_*rhs_A1_x_
        - l_coupler2_theta_A1_x_*rhs_O1_x_ - l_coupler2_theta_A1_y_*rhs_A1_y_ - l_coupler2_theta_A1_y_*rhs_O1_y_;
    const double z_crank1_theta_ = arm_crank1_head_x_*p->weight_coupler2_y_ + arm_crank1_head_x_*z_crank1_y_
        - arm_crank1_head_y_*z_crank1_x_ - l_crank1_theta_A1_x_*rhs_A1_x_ - l_crank1_theta_A1_y_*rhs_A1_y_
        - l_crank1_theta_O1_x_*rhs_O1_x_ - l_crank1_theta_O1_y_*rhs_O1_y_
        - l_crank1_theta_coupler2_theta_*z_coupler2_theta_;
    const double z_B1_x_ = -l_B1_x_coupler1_theta_*z_coupler1_theta_ - l_B1_x_crank0_theta_*z_crank0_theta_
        - l_B1_x_crank1_theta_*z_crank1_theta_ + rhs_A0_x_ + rhs_B1_x_ + rhs_O0_x_ - rhs_O1_x_;
    const double z_B1_y_ = -l_B1_y_coupler1_theta_*z_coupler1_theta_ - l_B1_y_crank0_theta_*z_crank0_theta_
        - l_B1_y_crank1_theta_*z_crank1_theta_ + rhs_A0_y_ + rhs_B1_y_ + rhs_O0_y_ - rhs_O1_y_;
    const double z_B2_x_ = -l_B2_x_B1_x_*z_B1_x_ - l_B2_x_B1_y_*z_B1_y_ - l_B2_x_coupler2_theta_*z_coupler2_theta_
        - l_B2_x_crank1_theta_*z_crank1_theta_ - l_B2_x_crank2_theta_*z_crank2_theta_ + rhs_A1_x_ + rhs_B2_x_
        + rhs_O1_x_ - rhs_O2_x_;
    const double z_B2_y_ = -l_B2_y_B1_x_*z_B1_x_ - l_B2_y_B1_y_*z_B1_y_ - l_B2_y_coupler2_theta_*z_coupler2_theta_
        - l_B2_y_crank1_theta_*z_crank1_theta_ - l_B2_y_crank2_theta_*z_crank2_theta_ + rhs_A1_y_ + rhs_B2_y_
        + rhs_O1_y_ - rhs_O2_y_;

    /* backward substitution */
    const double lambda_B2_y_ = inverse_cross_B2_x_B2_y_*z_B2_x_ + inverse_pivot_B2_y_*z_B2_y_;
    const double lambda_B2_x_ = inverse_cross_B2_x_B2_y_*z_B2_y_ + inverse_pivot_B2_x_*z_B2_x_;
    const double lambda_B1_y_ = inverse_cross_B1_x_B1_y_*z_B1_x_ + inverse_pivot_B1_y_*z_B1_y_
        - l_B2_x_B1_y_*lambda_B2_x_ - l_B2_y_B1_y_*lambda_B2_y_;
    const double lambda_B1_x_ = inverse_cross_B1_x_B1_y_*z_B1_y_ + inverse_pivot_B1_x_*z_B1_x_
        - l_B2_x_B1_x_*lambda_B2_x_ - l_B2_y_B1_x_*lambda_B2_y_;
    const double acceleration_crank1_theta_ = inverse_pivot_crank1_theta_*z_crank1_theta_
        - l_B1_x_crank1_theta_*lambda_B1_x_ - l_B1_y_crank1_theta_*lambda_B1_y_ - l_B2_x_crank1_theta_*lambda_B2_x_
        - l_B2_y_crank1_theta_*lambda_B2_y_;
    const double acceleration_coupler2_theta_ = -acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        + inverse_pivot_coupler2_theta_*z_coupler2_theta_ - l_B2_x_coupler2_theta_*lambda_B2_x_
        - l_B2_y_coupler2_theta_*lambda_B2_y_;
    const double acceleration_coupler1_theta_ = inverse_cross_crank0_theta_coupler1_theta_*z_crank0_theta_
        + inverse_pivot_coupler1_theta_*z_coupler1_theta_ - l_B1_x_coupler1_theta_*lambda_B1_x_
        - l_B1_y_coupler1_theta_*lambda_B1_y_;
    const double acceleration_crank0_theta_ = inverse_cross_crank0_theta_coupler1_theta_*z_coupler1_theta_
        + inverse_pivot_crank0_theta_*z_crank0_theta_ - l_B1_x_crank0_theta_*lambda_B1_x_
        - l_B1_y_crank0_theta_*lambda_B1_y_;
    const double acceleration_crank2_theta_ = inverse_pivot_crank2_theta_*z_crank2_theta_
        - l_B2_x_crank2_theta_*lambda_B2_x_ - l_B2_y_crank2_theta_*lambda_B2_y_;
    const double lambda_O0_x_ = -acceleration_coupler1_theta_*l_coupler1_theta_A0_x_
        - acceleration_crank0_theta_*l_crank0_theta_O0_x_ - inertia_crank0_x_*rhs_O0_x_ + lambda_B1_x_ - z_crank0_x_;
    const double acceleration_crank0_x_ = -acceleration_crank0_theta_*arm_crank0_head_y_ - rhs_O0_x_;
    const double lambda_O0_y_ = -acceleration_coupler1_theta_*l_coupler1_theta_A0_y_
        - acceleration_crank0_theta_*l_crank0_theta_O0_y_ - inertia_crank0_y_*rhs_O0_y_ + lambda_B1_y_ - z_crank0_y_;
    const double acceleration_crank0_y_ = acceleration_crank0_theta_*arm_crank0_head_x_ - rhs_O0_y_;
    const double lambda_O1_x_ = -acceleration_coupler2_theta_*l_coupler2_theta_A1_x_
        - acceleration_crank1_theta_*l_crank1_theta_O1_x_ - inertia_crank1_x_*rhs_O1_x_ - lambda_B1_x_ + lambda_B2_x_
        - z_crank1_x_;
    const double acceleration_crank1_x_ = -acceleration_crank1_theta_*arm_crank1_head_y_ - rhs_O1_x_;
    const double lambda_O1_y_ = -acceleration_coupler2_theta_*l_coupler2_theta_A1_y_
        - acceleration_crank1_theta_*l_crank1_theta_O1_y_ - inertia_crank1_y_*rhs_O1_y_ - lambda_B1_y_ + lambda_B2_y_
        - z_crank1_y_;
    const double acceleration_crank1_y_ = acceleration_crank1_theta_*arm_crank1_head_x_ - rhs_O1_y_;
    const double lambda_O2_x_ = -acceleration_crank2_theta_*l_crank2_theta_O2_x_ - p->crank2_mass_*rhs_O2_x_
        - lambda_B2_x_;
    const double acceleration_crank2_x_ = -acceleration_crank2_theta_*arm_crank2_head_y_ - rhs_O2_x_;
    const double lambda_O2_y_ = -acceleration_crank2_theta_*l_crank2_theta_O2_y_ - p->crank2_mass_*rhs_O2_y_
        - lambda_B2_y_ - p->weight_crank2_y_;
    const double acceleration_crank2_y_ = acceleration_crank2_theta_*arm_crank2_head_x_ - rhs_O2_y_;
    const double lambda_A0_x_ = -acceleration_coupler1_theta_*l_coupler1_theta_A0_x_
        - acceleration_crank0_theta_*l_crank0_theta_A0_x_ + acceleration_crank0_x_*p->coupler1_mass_
        - p->coupler1_mass_*rhs_A0_x_ + lambda_B1_x_;
    const double acceleration_coupler1_x_ = -acceleration_coupler1_theta_*arm_coupler1_head_y_
        - acceleration_crank0_theta_*arm_crank0_head_y_ + acceleration_crank0_x_ - rhs_A0_x_;
    const double lambda_A0_y_ = -acceleration_coupler1_theta_*l_coupler1_theta_A0_y_
        - acceleration_crank0_theta_*l_crank0_theta_A0_y_ + acceleration_crank0_y_*p->coupler1_mass_
        - p->coupler1_mass_*rhs_A0_y_ + lambda_B1_y_ - p->weight_coupler1_y_;
    const double acceleration_coupler1_y_ = acceleration_coupler1_theta_*arm_coupler1_head_x_
        + acceleration_crank0_theta_*arm_crank0_head_x_ + acceleration_crank0_y_ - rhs_A0_y_;
    const double lambda_A1_x_ = -acceleration_coupler2_theta_*l_coupler2_theta_A1_x_
        - acceleration_crank1_theta_*l_crank1_theta_A1_x_ + acceleration_crank1_x_*p->coupler2_mass_
        - p->coupler2_mass_*rhs_A1_x_ + lambda_B2_x_;
    const double acceleration_coupler2_x_ = -acceleration_coupler2_theta_*arm_coupler2_head_y_
        - acceleration_crank1_theta_*arm_crank1_head_y_ + acceleration_crank1_x_ - rhs_A1_x_;
    const double lambda_A1_y_ = -acceleration_coupler2_theta_*l_coupler2_theta_A1_y_
        - acceleration_crank1_theta_*l_crank1_theta_A1_y_ + acceleration_crank1_y_*p->coupler2_mass_
        - p->coupler2_mass_*rhs_A1_y_ + lambda_B2_y_ - p->weight_coupler2_y_;
    const double acceleration_coupler2_y_ = acceleration_coupler2_theta_*arm_coupler2_head_x_
        + acceleration_crank1_theta_*arm_crank1_head_x_ + acceleration_crank1_y_ - rhs_A1_y_;

    /* results */
    a[0] = acceleration_crank0_x_;
    a[1] = acceleration_crank0_y_;
    a[2] = acceleration_crank0_theta_;
    a[3] = acceleration_crank1_x_;
    a[4] = acceleration_crank1_y_;
    a[5] = acceleration_crank1_theta_;
    a[6] = acceleration_crank2_x_;
    a[7] = acceleration_crank2_y_;
    a[8] = acceleration_crank2_theta_;
    a[9] = acceleration_coupler1_x_;
    a[10] = acceleration_coupler1_y_;
    a[11] = acceleration_coupler1_theta_;
    a[12] = acceleration_coupler2_x_;
    a[13] = acceleration_coupler2_y_;
    a[14] = acceleration_coupler2_theta_;
    rhs->lambda[0] = lambda_O0_x_;
    rhs->lambda[1] = lambda_O0_y_;
    rhs->lambda[2] = lambda_O1_x_;
    rhs->lambda[3] = lambda_O1_y_;
    rhs->lambda[4] = lambda_O2_x_;
    rhs->lambda[5] = lambda_O2_y_;
    rhs->lambda[6] = lambda_A0_x_;
    rhs->lambda[7] = lambda_A0_y_;
    rhs->lambda[8] = lambda_B1_x_;
    rhs->lambda[9] = lambda_B1_y_;
    rhs->lambda[10] = lambda_A1_x_;
    rhs->lambda[11] = lambda_A1_y_;
    rhs->lambda[12] = lambda_B2_x_;
    rhs->lambda[13] = lambda_B2_y_;
    goto powers;

    /* a pivot vanished: constraint equations depend on each other here */
    dependent: {
        double force[N_Q], gamma_stab[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_crank0_y_;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_crank1_y_;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_crank2_y_;
        force[8] = 0.0;
        force[9] = 0.0;
        force[10] = p->weight_coupler1_y_;
        force[11] = 0.0;
        force[12] = 0.0;
        force[13] = p->weight_coupler2_y_;
        force[14] = 0.0;
        gamma_stab[0] = rhs_O0_x_;
        gamma_stab[1] = rhs_O0_y_;
        gamma_stab[2] = rhs_O1_x_;
        gamma_stab[3] = rhs_O1_y_;
        gamma_stab[4] = rhs_O2_x_;
        gamma_stab[5] = rhs_O2_y_;
        gamma_stab[6] = rhs_A0_x_;
        gamma_stab[7] = rhs_A0_y_;
        gamma_stab[8] = rhs_B1_x_;
        gamma_stab[9] = rhs_B1_y_;
        gamma_stab[10] = rhs_A1_x_;
        gamma_stab[11] = rhs_A1_y_;
        gamma_stab[12] = rhs_B2_x_;
        gamma_stab[13] = rhs_B2_y_;
        pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);
    }
    powers:
    rhs->power[0] = 0.0;
    rhs->power[1] = 0.0;
    rhs->power[2] = 0.0;
    return pivot;
}
