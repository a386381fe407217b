/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    /* coordinates, velocities, time */
    const double crank0_x = q[0];
    const double crank0_y = q[1];
    const double crank0_theta = q[2];
    const double crank0_vx = v[0];
    const double crank0_vy = v[1];
    const double crank0_omega = v[2];
    const double crank1_x = q[3];
    const double crank1_y = q[4];
    const double crank1_theta = q[5];
    const double crank1_vx = v[3];
    const double crank1_vy = v[4];
    const double crank1_omega = v[5];
    const double crank2_x = q[6];
    const double crank2_y = q[7];
    const double crank2_theta = q[8];
    const double crank2_vx = v[6];
    const double crank2_vy = v[7];
    const double crank2_omega = v[8];
    const double coupler1_x = q[9];
    const double coupler1_y = q[10];
    const double coupler1_theta = q[11];
    const double coupler1_vx = v[9];
    const double coupler1_vy = v[10];
    const double coupler1_omega = v[11];
    const double coupler2_x = q[12];
    const double coupler2_y = q[13];
    const double coupler2_theta = q[14];
    const double coupler2_vx = v[12];
    const double coupler2_vy = v[13];
    const double coupler2_omega = v[14];

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*p->crank0_head_s_x;
    const double arm_crank0_head_y = p->crank0_head_s_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*p->crank1_head_s_x;
    const double arm_crank1_head_y = p->crank1_head_s_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*p->crank2_head_s_x;
    const double arm_crank2_head_y = p->crank2_head_s_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_s_x;
    const double arm_coupler1_head_y = p->coupler1_head_s_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_s_x;
    const double arm_coupler2_head_y = p->coupler2_head_s_x*sin_theta_coupler2;

    /* status */
    int pivot = 0;

    /* constraints: Phi, Phi_dot = Phi_q v - nu, gamma */
    const double phi_O0_x = arm_crank0_head_x - crank0_x;
    const double phi_dot_O0_x = -arm_crank0_head_y*crank0_omega - crank0_vx;
    const double rhs_O0_x = arm_crank0_head_x*(crank0_omega * crank0_omega) - p->beta_squared*phi_O0_x
        - phi_dot_O0_x*p->two_alpha;
    aside->phi[0] = phi_O0_x;
    aside->phi_dot[0] = phi_dot_O0_x;
    const double phi_O0_y = arm_crank0_head_y - crank0_y;
    const double phi_dot_O0_y = arm_crank0_head_x*crank0_omega - crank0_vy;
    const double rhs_O0_y = arm_crank0_head_y*(crank0_omega * crank0_omega) - p->beta_squared*phi_O0_y
        - phi_dot_O0_y*p->two_alpha;
    aside->phi[1] = phi_O0_y;
    aside->phi_dot[1] = phi_dot_O0_y;
    const double phi_O1_x = p->O1_x + arm_crank1_head_x - crank1_x;
    const double phi_dot_O1_x = -arm_crank1_head_y*crank1_omega - crank1_vx;
    const double rhs_O1_x = arm_crank1_head_x*(crank1_omega * crank1_omega) - p->beta_squared*phi_O1_x
        - phi_dot_O1_x*p->two_alpha;
    aside->phi[2] = phi_O1_x;
    aside->phi_dot[2] = phi_dot_O1_x;
    const double phi_O1_y = arm_crank1_head_y - crank1_y;
    const double phi_dot_O1_y = arm_crank1_head_x*crank1_omega - crank1_vy;
    const double rhs_O1_y = arm_crank1_head_y*(crank1_omega * crank1_omega) - p->beta_squared*phi_O1_y
        - phi_dot_O1_y*p->two_alpha;
    aside->phi[3] = phi_O1_y;
    aside->phi_dot[3] = phi_dot_O1_y;
    const double phi_O2_x = p->O2_x + arm_crank2_head_x - crank2_x;
    const double phi_dot_O2_x = -arm_crank2_head_y*crank2_omega - crank2_vx;
    const double rhs_O2_x = arm_crank2_head_x*(crank2_omega * crank2_omega) - p->beta_squared*phi_O2_x
        - phi_dot_O2_x*p->two_alpha;
    aside->phi[4] = phi_O2_x;
    aside->phi_dot[4] = phi_dot_O2_x;
    const double phi_O2_y = arm_crank2_head_y - crank2_y;
    const double phi_dot_O2_y = arm_crank2_head_x*crank2_omega - crank2_vy;
    const double rhs_O2_y = arm_crank2_head_y*(crank2_omega * crank2_omega) - p->beta_squared*phi_O2_y
        - phi_dot_O2_y*p->two_alpha;
    aside->phi[5] = phi_O2_y;
    aside->phi_dot[5] = phi_dot_O2_y;
    const double phi_A0_x = arm_coupler1_head_x + arm_crank0_head_x - coupler1_x + crank0_x;
    const double phi_dot_A0_x = -arm_coupler1_head_y*coupler1_omega - arm_crank0_head_y*crank0_omega - coupler1_vx
        + crank0_vx;
    const double rhs_A0_x = arm_coupler1_head_x*(coupler1_omega * coupler1_omega)
        + arm_crank0_head_x*(crank0_omega * crank0_omega) - p->beta_squared*phi_A0_x - phi_dot_A0_x*p->two_alpha;
    aside->phi[6] = phi_A0_x;
    aside->phi_dot[6] = phi_dot_A0_x;
    const double phi_A0_y = arm_coupler1_head_y + arm_crank0_head_y - coupler1_y + crank0_y;
    const double phi_dot_A0_y = arm_coupler1_head_x*coupler1_omega + arm_crank0_head_x*crank0_omega - coupler1_vy
        + crank0_vy;
    const double rhs_A0_y = arm_coupler1_head_y*(coupler1_omega * coupler1_omega)
        + arm_crank0_head_y*(crank0_omega * crank0_omega) - p->beta_squared*phi_A0_y - phi_dot_A0_y*p->two_alpha;
    aside->phi[7] = phi_A0_y;
    aside->phi_dot[7] = phi_dot_A0_y;
    const double phi_B1_x = arm_coupler1_head_x - arm_crank1_head_x + coupler1_x - crank1_x;
    const double phi_dot_B1_x = -arm_coupler1_head_y*coupler1_omega + arm_crank1_head_y*crank1_omega + coupler1_vx
        - crank1_vx;
    const double rhs_B1_x = arm_coupler1_head_x*(coupler1_omega * coupler1_omega)
        - arm_crank1_head_x*(crank1_omega * crank1_omega) - p->beta_squared*phi_B1_x - phi_dot_B1_x*p->two_alpha;
    aside->phi[8] = phi_B1_x;
    aside->phi_dot[8] = phi_dot_B1_x;
    const double phi_B1_y = arm_coupler1_head_y - arm_crank1_head_y + coupler1_y - crank1_y;
    const double phi_dot_B1_y = arm_coupler1_head_x*coupler1_omega - arm_crank1_head_x*crank1_omega + coupler1_vy
        - crank1_vy;
    const double rhs_B1_y = arm_coupler1_head_y*(coupler1_omega * coupler1_omega)
        - arm_crank1_head_y*(crank1_omega * crank1_omega) - p->beta_squared*phi_B1_y - phi_dot_B1_y*p->two_alpha;
    aside->phi[9] = phi_B1_y;
    aside->phi_dot[9] = phi_dot_B1_y;
    const double phi_A1_x = arm_coupler2_head_x + arm_crank1_head_x - coupler2_x + crank1_x;
    const double phi_dot_A1_x = -arm_coupler2_head_y*coupler2_omega - arm_crank1_head_y*crank1_omega - coupler2_vx
        + crank1_vx;
    const double rhs_A1_x = arm_coupler2_head_x*(coupler2_omega * coupler2_omega)
        + arm_crank1_head_x*(crank1_omega * crank1_omega) - p->beta_squared*phi_A1_x - phi_dot_A1_x*p->two_alpha;
    aside->phi[10] = phi_A1_x;
    aside->phi_dot[10] = phi_dot_A1_x;
    const double phi_A1_y = arm_coupler2_head_y + arm_crank1_head_y - coupler2_y + crank1_y;
    const double phi_dot_A1_y = arm_coupler2_head_x*coupler2_omega + arm_crank1_head_x*crank1_omega - coupler2_vy
        + crank1_vy;
    const double rhs_A1_y = arm_coupler2_head_y*(coupler2_omega * coupler2_omega)
        + arm_crank1_head_y*(crank1_omega * crank1_omega) - p->beta_squared*phi_A1_y - phi_dot_A1_y*p->two_alpha;
    aside->phi[11] = phi_A1_y;
    aside->phi_dot[11] = phi_dot_A1_y;
    const double phi_B2_x = arm_coupler2_head_x - arm_crank2_head_x + coupler2_x - crank2_x;
    const double phi_dot_B2_x = -arm_coupler2_head_y*coupler2_omega + arm_crank2_head_y*crank2_omega + coupler2_vx
        - crank2_vx;
    const double rhs_B2_x = arm_coupler2_head_x*(coupler2_omega * coupler2_omega)
        - arm_crank2_head_x*(crank2_omega * crank2_omega) - p->beta_squared*phi_B2_x - phi_dot_B2_x*p->two_alpha;
    aside->phi[12] = phi_B2_x;
    aside->phi_dot[12] = phi_dot_B2_x;
    const double phi_B2_y = arm_coupler2_head_y - arm_crank2_head_y + coupler2_y - crank2_y;
    const double phi_dot_B2_y = arm_coupler2_head_x*coupler2_omega - arm_crank2_head_x*crank2_omega + coupler2_vy
        - crank2_vy;
    const double rhs_B2_y = arm_coupler2_head_y*(coupler2_omega * coupler2_omega)
        - arm_crank2_head_y*(crank2_omega * crank2_omega) - p->beta_squared*phi_B2_y - phi_dot_B2_y*p->two_alpha;
    aside->phi[13] = phi_B2_y;
    aside->phi_dot[13] = phi_dot_B2_y;

    /* L D L^T of the KKT matrix */
    const double l_O0_x__crank0_theta = -arm_crank0_head_y*p->inverse_crank0_inertia;
    const double l_O0_y__crank0_theta = arm_crank0_head_x*p->inverse_crank0_inertia;
    const double l_A0_x__crank0_theta = -arm_crank0_head_y*p->inverse_crank0_inertia;
    const double l_A0_y__crank0_theta = arm_crank0_head_x*p->inverse_crank0_inertia;
    const double scale_O0_x = -arm_crank0_head_y*l_O0_x__crank0_theta + p->inverse_crank0_mass;
    const double scale_O0_y = arm_crank0_head_x*l_O0_y__crank0_theta + p->inverse_crank0_mass;
    const double pivot_O0_x__O0_y = -arm_crank0_head_y*l_O0_y__crank0_theta;
    const double determinant_O0_x__O0_y = -(pivot_O0_x__O0_y * pivot_O0_x__O0_y) + scale_O0_x*scale_O0_y;
    if (!(scale_O0_x > 0.0 && scale_O0_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_O0_x__O0_y > memory->least * scale_O0_y * scale_O0_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_O0_x__O0_y = -1.0/determinant_O0_x__O0_y;
    const double inverse_pivot_O0_x = inverse_O0_x__O0_y*scale_O0_y;
    const double inverse_pivot_O0_y = inverse_O0_x__O0_y*scale_O0_x;
    const double inverse_cross_O0_x__O0_y = -inverse_O0_x__O0_y*pivot_O0_x__O0_y;
    const double w_A0_x__O0_x = arm_crank0_head_y*l_A0_x__crank0_theta + p->inverse_crank0_mass;
    const double w_A0_x__O0_y = -arm_crank0_head_x*l_A0_x__crank0_theta;
    const double l_A0_x__O0_x = inverse_cross_O0_x__O0_y*w_A0_x__O0_y + inverse_pivot_O0_x*w_A0_x__O0_x;
    const double l_A0_x__O0_y = inverse_cross_O0_x__O0_y*w_A0_x__O0_x + inverse_pivot_O0_y*w_A0_x__O0_y;
    const double w_A0_y__O0_x = arm_crank0_head_y*l_A0_y__crank0_theta;
    const double w_A0_y__O0_y = -arm_crank0_head_x*l_A0_y__crank0_theta + p->inverse_crank0_mass;
    const double l_A0_y__O0_x = inverse_cross_O0_x__O0_y*w_A0_y__O0_y + inverse_pivot_O0_x*w_A0_y__O0_x;
    const double l_A0_y__O0_y = inverse_cross_O0_x__O0_y*w_A0_y__O0_x + inverse_pivot_O0_y*w_A0_y__O0_y;
    const double l_O2_x__crank2_theta = -arm_crank2_head_y*p->inverse_crank2_inertia;
    const double l_O2_y__crank2_theta = arm_crank2_head_x*p->inverse_crank2_inertia;
    const double l_B2_x__crank2_theta = arm_crank2_head_y*p->inverse_crank2_inertia;
    const double l_B2_y__crank2_theta = -arm_crank2_head_x*p->inverse_crank2_inertia;
    const double scale_O2_x = -arm_crank2_head_y*l_O2_x__crank2_theta + p->inverse_crank2_mass;
    const double scale_O2_y = arm_crank2_head_x*l_O2_y__crank2_theta + p->inverse_crank2_mass;
    const double pivot_O2_x__O2_y = -arm_crank2_head_y*l_O2_y__crank2_theta;
    const double determinant_O2_x__O2_y = -(pivot_O2_x__O2_y * pivot_O2_x__O2_y) + scale_O2_x*scale_O2_y;
    if (!(scale_O2_x > 0.0 && scale_O2_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_O2_x__O2_y > memory->least * scale_O2_y * scale_O2_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_O2_x__O2_y = -1.0/determinant_O2_x__O2_y;
    const double inverse_pivot_O2_x = inverse_O2_x__O2_y*scale_O2_y;
    const double inverse_pivot_O2_y = inverse_O2_x__O2_y*scale_O2_x;
    const double inverse_cross_O2_x__O2_y = -inverse_O2_x__O2_y*pivot_O2_x__O2_y;
    const double w_B2_x__O2_x = arm_crank2_head_y*l_B2_x__crank2_theta - p->inverse_crank2_mass;
    const double w_B2_x__O2_y = -arm_crank2_head_x*l_B2_x__crank2_theta;
    const double l_B2_x__O2_x = inverse_cross_O2_x__O2_y*w_B2_x__O2_y + inverse_pivot_O2_x*w_B2_x__O2_x;
    const double l_B2_x__O2_y = inverse_cross_O2_x__O2_y*w_B2_x__O2_x + inverse_pivot_O2_y*w_B2_x__O2_y;
    const double w_B2_y__O2_x = arm_crank2_head_y*l_B2_y__crank2_theta;
    const double w_B2_y__O2_y = -arm_crank2_head_x*l_B2_y__crank2_theta - p->inverse_crank2_mass;
    const double l_B2_y__O2_x = inverse_cross_O2_x__O2_y*w_B2_y__O2_y + inverse_pivot_O2_x*w_B2_y__O2_x;
    const double l_B2_y__O2_y = inverse_cross_O2_x__O2_y*w_B2_y__O2_x + inverse_pivot_O2_y*w_B2_y__O2_y;
    const double l_A0_x__coupler1_theta = -arm_coupler1_head_y*p->inverse_coupler1_inertia;
    const double l_A0_y__coupler1_theta = arm_coupler1_head_x*p->inverse_coupler1_inertia;
    const double l_B1_x__coupler1_theta = -arm_coupler1_head_y*p->inverse_coupler1_inertia;
    const double l_B1_y__coupler1_theta = arm_coupler1_head_x*p->inverse_coupler1_inertia;
    const double scale_A0_x = -arm_coupler1_head_y*l_A0_x__coupler1_theta - arm_crank0_head_y*l_A0_x__crank0_theta
        + p->inverse_coupler1_mass + p->inverse_crank0_mass;
    const double scale_A0_y = arm_coupler1_head_x*l_A0_y__coupler1_theta + arm_crank0_head_x*l_A0_y__crank0_theta
        + p->inverse_coupler1_mass + p->inverse_crank0_mass;
    const double pivot_A0_x = l_A0_x__O0_x*w_A0_x__O0_x + l_A0_x__O0_y*w_A0_x__O0_y + scale_A0_x;
    const double pivot_A0_y = l_A0_y__O0_x*w_A0_y__O0_x + l_A0_y__O0_y*w_A0_y__O0_y + scale_A0_y;
    const double pivot_A0_x__A0_y = -arm_coupler1_head_y*l_A0_y__coupler1_theta
        - arm_crank0_head_y*l_A0_y__crank0_theta + l_A0_y__O0_x*w_A0_x__O0_x + l_A0_y__O0_y*w_A0_x__O0_y;
    const double determinant_A0_x__A0_y = pivot_A0_x*pivot_A0_y - (pivot_A0_x__A0_y * pivot_A0_x__A0_y);
    if (!(pivot_A0_x > memory->least * scale_A0_x)) {
        pivot = 5;
        goto dependent;
    }
    if (!(determinant_A0_x__A0_y > memory->least * scale_A0_y * pivot_A0_x)) {
        pivot = 6;
        goto dependent;
    }
    const double inverse_A0_x__A0_y = -1.0/determinant_A0_x__A0_y;
    const double inverse_pivot_A0_x = inverse_A0_x__A0_y*pivot_A0_y;
    const double inverse_pivot_A0_y = inverse_A0_x__A0_y*pivot_A0_x;
    const double inverse_cross_A0_x__A0_y = -inverse_A0_x__A0_y*pivot_A0_x__A0_y;
    const double w_B1_x__A0_x = arm_coupler1_head_y*l_B1_x__coupler1_theta + p->inverse_coupler1_mass;
    const double w_B1_x__A0_y = -arm_coupler1_head_x*l_B1_x__coupler1_theta;
    const double l_B1_x__A0_x = inverse_cross_A0_x__A0_y*w_B1_x__A0_y + inverse_pivot_A0_x*w_B1_x__A0_x;
    const double l_B1_x__A0_y = inverse_cross_A0_x__A0_y*w_B1_x__A0_x + inverse_pivot_A0_y*w_B1_x__A0_y;
    const double w_B1_y__A0_x = arm_coupler1_head_y*l_B1_y__coupler1_theta;
    const double w_B1_y__A0_y = -arm_coupler1_head_x*l_B1_y__coupler1_theta + p->inverse_coupler1_mass;
    const double l_B1_y__A0_x = inverse_cross_A0_x__A0_y*w_B1_y__A0_y + inverse_pivot_A0_x*w_B1_y__A0_x;
    const double l_B1_y__A0_y = inverse_cross_A0_x__A0_y*w_B1_y__A0_x + inverse_pivot_A0_y*w_B1_y__A0_y;
    const double l_B2_x__coupler2_theta = -arm_coupler2_head_y*p->inverse_coupler2_inertia;
    const double l_B2_y__coupler2_theta = arm_coupler2_head_x*p->inverse_coupler2_inertia;
    const double l_A1_x__coupler2_theta = -arm_coupler2_head_y*p->inverse_coupler2_inertia;
    const double l_A1_y__coupler2_theta = arm_coupler2_head_x*p->inverse_coupler2_inertia;
    const double scale_B2_x = -arm_coupler2_head_y*l_B2_x__coupler2_theta + arm_crank2_head_y*l_B2_x__crank2_theta
        + p->inverse_coupler2_mass + p->inverse_crank2_mass;
    const double scale_B2_y = arm_coupler2_head_x*l_B2_y__coupler2_theta - arm_crank2_head_x*l_B2_y__crank2_theta
        + p->inverse_coupler2_mass + p->inverse_crank2_mass;
    const double pivot_B2_x = l_B2_x__O2_x*w_B2_x__O2_x + l_B2_x__O2_y*w_B2_x__O2_y + scale_B2_x;
    const double pivot_B2_y = l_B2_y__O2_x*w_B2_y__O2_x + l_B2_y__O2_y*w_B2_y__O2_y + scale_B2_y;
    const double pivot_B2_x__B2_y = -arm_coupler2_head_y*l_B2_y__coupler2_theta
        + arm_crank2_head_y*l_B2_y__crank2_theta + l_B2_y__O2_x*w_B2_x__O2_x + l_B2_y__O2_y*w_B2_x__O2_y;
    const double determinant_B2_x__B2_y = pivot_B2_x*pivot_B2_y - (pivot_B2_x__B2_y * pivot_B2_x__B2_y);
    if (!(pivot_B2_x > memory->least * scale_B2_x)) {
        pivot = 7;
        goto dependent;
    }
    if (!(determinant_B2_x__B2_y > memory->least * scale_B2_y * pivot_B2_x)) {
        pivot = 8;
        goto dependent;
    }
    const double inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const double inverse_pivot_B2_x = inverse_B2_x__B2_y*pivot_B2_y;
    const double inverse_pivot_B2_y = inverse_B2_x__B2_y*pivot_B2_x;
    const double inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const double w_A1_x__B2_x = arm_coupler2_head_y*l_A1_x__coupler2_theta + p->inverse_coupler2_mass;
    const double w_A1_x__B2_y = -arm_coupler2_head_x*l_A1_x__coupler2_theta;
    const double l_A1_x__B2_x = inverse_cross_B2_x__B2_y*w_A1_x__B2_y + inverse_pivot_B2_x*w_A1_x__B2_x;
    const double l_A1_x__B2_y = inverse_cross_B2_x__B2_y*w_A1_x__B2_x + inverse_pivot_B2_y*w_A1_x__B2_y;
    const double w_A1_y__B2_x = arm_coupler2_head_y*l_A1_y__coupler2_theta;
    const double w_A1_y__B2_y = -arm_coupler2_head_x*l_A1_y__coupler2_theta + p->inverse_coupler2_mass;
    const double l_A1_y__B2_x = inverse_cross_B2_x__B2_y*w_A1_y__B2_y + inverse_pivot_B2_x*w_A1_y__B2_x;
    const double l_A1_y__B2_y = inverse_cross_B2_x__B2_y*w_A1_y__B2_x + inverse_pivot_B2_y*w_A1_y__B2_y;
    const double l_O1_x__crank1_theta = -arm_crank1_head_y*p->inverse_crank1_inertia;
    const double l_O1_y__crank1_theta = arm_crank1_head_x*p->inverse_crank1_inertia;
    const double l_B1_x__crank1_theta = arm_crank1_head_y*p->inverse_crank1_inertia;
    const double l_B1_y__crank1_theta = -arm_crank1_head_x*p->inverse_crank1_inertia;
    const double l_A1_x__crank1_theta = -arm_crank1_head_y*p->inverse_crank1_inertia;
    const double l_A1_y__crank1_theta = arm_crank1_head_x*p->inverse_crank1_inertia;
    const double scale_O1_x = -arm_crank1_head_y*l_O1_x__crank1_theta + p->inverse_crank1_mass;
    const double scale_O1_y = arm_crank1_head_x*l_O1_y__crank1_theta + p->inverse_crank1_mass;
    const double pivot_O1_x__O1_y = -arm_crank1_head_y*l_O1_y__crank1_theta;
    const double determinant_O1_x__O1_y = -(pivot_O1_x__O1_y * pivot_O1_x__O1_y) + scale_O1_x*scale_O1_y;
    if (!(scale_O1_x > 0.0 && scale_O1_x < INFINITY)) {
        pivot = 9;
        goto dependent;
    }
    if (!(determinant_O1_x__O1_y > memory->least * scale_O1_y * scale_O1_x)) {
        pivot = 10;
        goto dependent;
    }
    const double inverse_O1_x__O1_y = -1.0/determinant_O1_x__O1_y;
    const double inverse_pivot_O1_x = inverse_O1_x__O1_y*scale_O1_y;
    const double inverse_pivot_O1_y = inverse_O1_x__O1_y*scale_O1_x;
    const double inverse_cross_O1_x__O1_y = -inverse_O1_x__O1_y*pivot_O1_x__O1_y;
    const double w_B1_x__O1_x = arm_crank1_head_y*l_B1_x__crank1_theta - p->inverse_crank1_mass;
    const double w_B1_x__O1_y = -arm_crank1_head_x*l_B1_x__crank1_theta;
    const double l_B1_x__O1_x = inverse_cross_O1_x__O1_y*w_B1_x__O1_y + inverse_pivot_O1_x*w_B1_x__O1_x;
    const double l_B1_x__O1_y = inverse_cross_O1_x__O1_y*w_B1_x__O1_x + inverse_pivot_O1_y*w_B1_x__O1_y;
    const double w_B1_y__O1_x = arm_crank1_head_y*l_B1_y__crank1_theta;
    const double w_B1_y__O1_y = -arm_crank1_head_x*l_B1_y__crank1_theta - p->inverse_crank1_mass;
    const double l_B1_y__O1_x = inverse_cross_O1_x__O1_y*w_B1_y__O1_y + inverse_pivot_O1_x*w_B1_y__O1_x;
    const double l_B1_y__O1_y = inverse_cross_O1_x__O1_y*w_B1_y__O1_x + inverse_pivot_O1_y*w_B1_y__O1_y;
    const double w_A1_x__O1_x = arm_crank1_head_y*l_A1_x__crank1_theta + p->inverse_crank1_mass;
    const double w_A1_x__O1_y = -arm_crank1_head_x*l_A1_x__crank1_theta;
    const double l_A1_x__O1_x = inverse_cross_O1_x__O1_y*w_A1_x__O1_y + inverse_pivot_O1_x*w_A1_x__O1_x;
    const double l_A1_x__O1_y = inverse_cross_O1_x__O1_y*w_A1_x__O1_x + inverse_pivot_O1_y*w_A1_x__O1_y;
    const double w_A1_y__O1_x = arm_crank1_head_y*l_A1_y__crank1_theta;
    const double w_A1_y__O1_y = -arm_crank1_head_x*l_A1_y__crank1_theta + p->inverse_crank1_mass;
    const double l_A1_y__O1_x = inverse_cross_O1_x__O1_y*w_A1_y__O1_y + inverse_pivot_O1_x*w_A1_y__O1_x;
    const double l_A1_y__O1_y = inverse_cross_O1_x__O1_y*w_A1_y__O1_x + inverse_pivot_O1_y*w_A1_y__O1_y;
    const double scale_B1_x = -arm_coupler1_head_y*l_B1_x__coupler1_theta + arm_crank1_head_y*l_B1_x__crank1_theta
        + p->inverse_coupler1_mass + p->inverse_crank1_mass;
    const double scale_B1_y = arm_coupler1_head_x*l_B1_y__coupler1_theta - arm_crank1_head_x*l_B1_y__crank1_theta
        + p->inverse_coupler1_mass + p->inverse_crank1_mass;
    const double pivot_B1_x = l_B1_x__A0_x*w_B1_x__A0_x + l_B1_x__A0_y*w_B1_x__A0_y + l_B1_x__O1_x*w_B1_x__O1_x
        + l_B1_x__O1_y*w_B1_x__O1_y + scale_B1_x;
    const double pivot_B1_y = l_B1_y__A0_x*w_B1_y__A0_x + l_B1_y__A0_y*w_B1_y__A0_y + l_B1_y__O1_x*w_B1_y__O1_x
        + l_B1_y__O1_y*w_B1_y__O1_y + scale_B1_y;
    const double pivot_B1_x__B1_y = -arm_coupler1_head_y*l_B1_y__coupler1_theta
        + arm_crank1_head_y*l_B1_y__crank1_theta + l_B1_y__A0_x*w_B1_x__A0_x + l_B1_y__A0_y*w_B1_x__A0_y
        + l_B1_y__O1_x*w_B1_x__O1_x + l_B1_y__O1_y*w_B1_x__O1_y;
    const double determinant_B1_x__B1_y = pivot_B1_x*pivot_B1_y - (pivot_B1_x__B1_y * pivot_B1_x__B1_y);
    if (!(pivot_B1_x > memory->least * scale_B1_x)) {
        pivot = 11;
        goto dependent;
    }
    if (!(determinant_B1_x__B1_y > memory->least * scale_B1_y * pivot_B1_x)) {
        pivot = 12;
        goto dependent;
    }
    const double inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const double inverse_pivot_B1_x = inverse_B1_x__B1_y*pivot_B1_y;
    const double inverse_pivot_B1_y = inverse_B1_x__B1_y*pivot_B1_x;
    const double inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;
    const double w_A1_x__B1_x = -arm_crank1_head_y*l_A1_x__crank1_theta + p->inverse_crank1_mass
        - l_A1_x__O1_x*w_B1_x__O1_x - l_A1_x__O1_y*w_B1_x__O1_y;
    const double w_A1_x__B1_y = arm_crank1_head_x*l_A1_x__crank1_theta - l_A1_x__O1_x*w_B1_y__O1_x
        - l_A1_x__O1_y*w_B1_y__O1_y;
    const double l_A1_x__B1_x = inverse_cross_B1_x__B1_y*w_A1_x__B1_y + inverse_pivot_B1_x*w_A1_x__B1_x;
    const double l_A1_x__B1_y = inverse_cross_B1_x__B1_y*w_A1_x__B1_x + inverse_pivot_B1_y*w_A1_x__B1_y;
    const double w_A1_y__B1_x = -arm_crank1_head_y*l_A1_y__crank1_theta - l_A1_y__O1_x*w_B1_x__O1_x
        - l_A1_y__O1_y*w_B1_x__O1_y;
    const double w_A1_y__B1_y = arm_crank1_head_x*l_A1_y__crank1_theta + p->inverse_crank1_mass
        - l_A1_y__O1_x*w_B1_y__O1_x - l_A1_y__O1_y*w_B1_y__O1_y;
    const double l_A1_y__B1_x = inverse_cross_B1_x__B1_y*w_A1_y__B1_y + inverse_pivot_B1_x*w_A1_y__B1_x;
    const double l_A1_y__B1_y = inverse_cross_B1_x__B1_y*w_A1_y__B1_x + inverse_pivot_B1_y*w_A1_y__B1_y;
    const double scale_A1_x = -arm_coupler2_head_y*l_A1_x__coupler2_theta - arm_crank1_head_y*l_A1_x__crank1_theta
        + p->inverse_coupler2_mass + p->inverse_crank1_mass;
    const double scale_A1_y = arm_coupler2_head_x*l_A1_y__coupler2_theta + arm_crank1_head_x*l_A1_y__crank1_theta
        + p->inverse_coupler2_mass + p->inverse_crank1_mass;
    const double pivot_A1_x = l_A1_x__B1_x*w_A1_x__B1_x + l_A1_x__B1_y*w_A1_x__B1_y + l_A1_x__B2_x*w_A1_x__B2_x
        + l_A1_x__B2_y*w_A1_x__B2_y + l_A1_x__O1_x*w_A1_x__O1_x + l_A1_x__O1_y*w_A1_x__O1_y + scale_A1_x;
    const double pivot_A1_y = l_A1_y__B1_x*w_A1_y__B1_x + l_A1_y__B1_y*w_A1_y__B1_y + l_A1_y__B2_x*w_A1_y__B2_x
        + l_A1_y__B2_y*w_A1_y__B2_y + l_A1_y__O1_x*w_A1_y__O1_x + l_A1_y__O1_y*w_A1_y__O1_y + scale_A1_y;
    const double pivot_A1_x__A1_y = -arm_coupler2_head_y*l_A1_y__coupler2_theta
        - arm_crank1_head_y*l_A1_y__crank1_theta + l_A1_y__B1_x*w_A1_x__B1_x + l_A1_y__B1_y*w_A1_x__B1_y
        + l_A1_y__B2_x*w_A1_x__B2_x + l_A1_y__B2_y*w_A1_x__B2_y + l_A1_y__O1_x*w_A1_x__O1_x + l_A1_y__O1_y*w_A1_x__O1_y;
    const double determinant_A1_x__A1_y = pivot_A1_x*pivot_A1_y - (pivot_A1_x__A1_y * pivot_A1_x__A1_y);
    if (!(pivot_A1_x > memory->least * scale_A1_x)) {
        pivot = 13;
        goto dependent;
    }
    if (!(determinant_A1_x__A1_y > memory->least * scale_A1_y * pivot_A1_x)) {
        pivot = 14;
        goto dependent;
    }
    const double inverse_A1_x__A1_y = -1.0/determinant_A1_x__A1_y;
    const double inverse_pivot_A1_x = inverse_A1_x__A1_y*pivot_A1_y;
    const double inverse_pivot_A1_y = inverse_A1_x__A1_y*pivot_A1_x;
    const double inverse_cross_A1_x__A1_y = -inverse_A1_x__A1_y*pivot_A1_x__A1_y;

    /* forward substitution */
    const double z_O0_y = p->inverse_crank0_mass*p->weight_crank0_y + rhs_O0_y;
    const double z_O2_y = p->inverse_crank2_mass*p->weight_crank2_y + rhs_O2_y;
    const double z_A0_x = -l_A0_x__O0_x*rhs_O0_x - l_A0_x__O0_y*z_O0_y + rhs_A0_x;
    const double z_A0_y = p->inverse_coupler1_mass*p->weight_coupler1_y - p->inverse_crank0_mass*p->weight_crank0_y
        - l_A0_y__O0_x*rhs_O0_x - l_A0_y__O0_y*z_O0_y + rhs_A0_y;
    const double z_B2_x = -l_B2_x__O2_x*rhs_O2_x - l_B2_x__O2_y*z_O2_y + rhs_B2_x;
    const double z_B2_y = -p->inverse_coupler2_mass*p->weight_coupler2_y + p->inverse_crank2_mass*p->weight_crank2_y
        - l_B2_y__O2_x*rhs_O2_x - l_B2_y__O2_y*z_O2_y + rhs_B2_y;
    const double z_O1_y = p->inverse_crank1_mass*p->weight_crank1_y + rhs_O1_y;
    const double z_B1_x = -l_B1_x__A0_x*z_A0_x - l_B1_x__A0_y*z_A0_y - l_B1_x__O1_x*rhs_O1_x - l_B1_x__O1_y*z_O1_y
        + rhs_B1_x;
    const double z_B1_y = -p->inverse_coupler1_mass*p->weight_coupler1_y + p->inverse_crank1_mass*p->weight_crank1_y
        - l_B1_y__A0_x*z_A0_x - l_B1_y__A0_y*z_A0_y - l_B1_y__O1_x*rhs_O1_x - l_B1_y__O1_y*z_O1_y + rhs_B1_y;
    const double z_A1_x = -l_A1_x__B1_x*z_B1_x - l_A1_x__B1_y*z_B1_y - l_A1_x__B2_x*z_B2_x - l_A1_x__B2_y*z_B2_y
        - l_A1_x__O1_x*rhs_O1_x - l_A1_x__O1_y*z_O1_y + rhs_A1_x;
    const double z_A1_y = p->inverse_coupler2_mass*p->weight_coupler2_y - p->inverse_crank1_mass*p->weight_crank1_y
        - l_A1_y__B1_x*z_B1_x - l_A1_y__B1_y*z_B1_y - l_A1_y__B2_x*z_B2_x - l_A1_y__B2_y*z_B2_y - l_A1_y__O1_x*rhs_O1_x
        - l_A1_y__O1_y*z_O1_y + rhs_A1_y;

    /* backward substitution */
    const double lambda_A1_y = inverse_cross_A1_x__A1_y*z_A1_x + inverse_pivot_A1_y*z_A1_y;
    const double lambda_A1_x = inverse_cross_A1_x__A1_y*z_A1_y + inverse_pivot_A1_x*z_A1_x;
    const double lambda_B1_y = inverse_cross_B1_x__B1_y*z_B1_x + inverse_pivot_B1_y*z_B1_y - l_A1_x__B1_y*lambda_A1_x
        - l_A1_y__B1_y*lambda_A1_y;
    const double lambda_B1_x = inverse_cross_B1_x__B1_y*z_B1_y + inverse_pivot_B1_x*z_B1_x - l_A1_x__B1_x*lambda_A1_x
        - l_A1_y__B1_x*lambda_A1_y;
    const double lambda_O1_y = inverse_cross_O1_x__O1_y*rhs_O1_x + inverse_pivot_O1_y*z_O1_y - l_A1_x__O1_y*lambda_A1_x
        - l_A1_y__O1_y*lambda_A1_y - l_B1_x__O1_y*lambda_B1_x - l_B1_y__O1_y*lambda_B1_y;
    const double lambda_O1_x = inverse_cross_O1_x__O1_y*z_O1_y + inverse_pivot_O1_x*rhs_O1_x - l_A1_x__O1_x*lambda_A1_x
        - l_A1_y__O1_x*lambda_A1_y - l_B1_x__O1_x*lambda_B1_x - l_B1_y__O1_x*lambda_B1_y;
    const double acceleration_crank1_theta = -l_A1_x__crank1_theta*lambda_A1_x - l_A1_y__crank1_theta*lambda_A1_y
        - l_B1_x__crank1_theta*lambda_B1_x - l_B1_y__crank1_theta*lambda_B1_y - l_O1_x__crank1_theta*lambda_O1_x
        - l_O1_y__crank1_theta*lambda_O1_y;
    const double lambda_B2_y = inverse_cross_B2_x__B2_y*z_B2_x + inverse_pivot_B2_y*z_B2_y - l_A1_x__B2_y*lambda_A1_x
        - l_A1_y__B2_y*lambda_A1_y;
    const double lambda_B2_x = inverse_cross_B2_x__B2_y*z_B2_y + inverse_pivot_B2_x*z_B2_x - l_A1_x__B2_x*lambda_A1_x
        - l_A1_y__B2_x*lambda_A1_y;
    const double acceleration_coupler2_theta = -l_A1_x__coupler2_theta*lambda_A1_x - l_A1_y__coupler2_theta*lambda_A1_y
        - l_B2_x__coupler2_theta*lambda_B2_x - l_B2_y__coupler2_theta*lambda_B2_y;
    const double lambda_A0_y = inverse_cross_A0_x__A0_y*z_A0_x + inverse_pivot_A0_y*z_A0_y - l_B1_x__A0_y*lambda_B1_x
        - l_B1_y__A0_y*lambda_B1_y;
    const double lambda_A0_x = inverse_cross_A0_x__A0_y*z_A0_y + inverse_pivot_A0_x*z_A0_x - l_B1_x__A0_x*lambda_B1_x
        - l_B1_y__A0_x*lambda_B1_y;
    const double acceleration_coupler1_theta = -l_A0_x__coupler1_theta*lambda_A0_x - l_A0_y__coupler1_theta*lambda_A0_y
        - l_B1_x__coupler1_theta*lambda_B1_x - l_B1_y__coupler1_theta*lambda_B1_y;
    const double lambda_O2_y = inverse_cross_O2_x__O2_y*rhs_O2_x + inverse_pivot_O2_y*z_O2_y - l_B2_x__O2_y*lambda_B2_x
        - l_B2_y__O2_y*lambda_B2_y;
    const double lambda_O2_x = inverse_cross_O2_x__O2_y*z_O2_y + inverse_pivot_O2_x*rhs_O2_x - l_B2_x__O2_x*lambda_B2_x
        - l_B2_y__O2_x*lambda_B2_y;
    const double acceleration_crank2_theta = -l_B2_x__crank2_theta*lambda_B2_x - l_B2_y__crank2_theta*lambda_B2_y
        - l_O2_x__crank2_theta*lambda_O2_x - l_O2_y__crank2_theta*lambda_O2_y;
    const double lambda_O0_y = inverse_cross_O0_x__O0_y*rhs_O0_x + inverse_pivot_O0_y*z_O0_y - l_A0_x__O0_y*lambda_A0_x
        - l_A0_y__O0_y*lambda_A0_y;
    const double lambda_O0_x = inverse_cross_O0_x__O0_y*z_O0_y + inverse_pivot_O0_x*rhs_O0_x - l_A0_x__O0_x*lambda_A0_x
        - l_A0_y__O0_x*lambda_A0_y;
    const double acceleration_crank0_theta = -l_A0_x__crank0_theta*lambda_A0_x - l_A0_y__crank0_theta*lambda_A0_y
        - l_O0_x__crank0_theta*lambda_O0_x - l_O0_y__crank0_theta*lambda_O0_y;
    const double acceleration_crank1_y = -p->inverse_crank1_mass*lambda_A1_y + p->inverse_crank1_mass*lambda_B1_y
        + p->inverse_crank1_mass*lambda_O1_y + p->inverse_crank1_mass*p->weight_crank1_y;
    const double acceleration_crank1_x = -p->inverse_crank1_mass*lambda_A1_x + p->inverse_crank1_mass*lambda_B1_x
        + p->inverse_crank1_mass*lambda_O1_x;
    const double acceleration_coupler2_y = p->inverse_coupler2_mass*lambda_A1_y - p->inverse_coupler2_mass*lambda_B2_y
        + p->inverse_coupler2_mass*p->weight_coupler2_y;
    const double acceleration_coupler2_x = p->inverse_coupler2_mass*lambda_A1_x - p->inverse_coupler2_mass*lambda_B2_x;
    const double acceleration_coupler1_y = p->inverse_coupler1_mass*lambda_A0_y - p->inverse_coupler1_mass*lambda_B1_y
        + p->inverse_coupler1_mass*p->weight_coupler1_y;
    const double acceleration_coupler1_x = p->inverse_coupler1_mass*lambda_A0_x - p->inverse_coupler1_mass*lambda_B1_x;
    const double acceleration_crank2_y = p->inverse_crank2_mass*lambda_B2_y + p->inverse_crank2_mass*lambda_O2_y
        + p->inverse_crank2_mass*p->weight_crank2_y;
    const double acceleration_crank2_x = p->inverse_crank2_mass*lambda_B2_x + p->inverse_crank2_mass*lambda_O2_x;
    const double acceleration_crank0_y = -p->inverse_crank0_mass*lambda_A0_y + p->inverse_crank0_mass*lambda_O0_y
        + p->inverse_crank0_mass*p->weight_crank0_y;
    const double acceleration_crank0_x = -p->inverse_crank0_mass*lambda_A0_x + p->inverse_crank0_mass*lambda_O0_x;

    /* results */
    a[0] = acceleration_crank0_x;
    a[1] = acceleration_crank0_y;
    a[2] = acceleration_crank0_theta;
    a[3] = acceleration_crank1_x;
    a[4] = acceleration_crank1_y;
    a[5] = acceleration_crank1_theta;
    a[6] = acceleration_crank2_x;
    a[7] = acceleration_crank2_y;
    a[8] = acceleration_crank2_theta;
    a[9] = acceleration_coupler1_x;
    a[10] = acceleration_coupler1_y;
    a[11] = acceleration_coupler1_theta;
    a[12] = acceleration_coupler2_x;
    a[13] = acceleration_coupler2_y;
    a[14] = acceleration_coupler2_theta;
    aside->lambda[0] = lambda_O0_x;
    aside->lambda[1] = lambda_O0_y;
    aside->lambda[2] = lambda_O1_x;
    aside->lambda[3] = lambda_O1_y;
    aside->lambda[4] = lambda_O2_x;
    aside->lambda[5] = lambda_O2_y;
    aside->lambda[6] = lambda_A0_x;
    aside->lambda[7] = lambda_A0_y;
    aside->lambda[8] = lambda_B1_x;
    aside->lambda[9] = lambda_B1_y;
    aside->lambda[10] = lambda_A1_x;
    aside->lambda[11] = lambda_A1_y;
    aside->lambda[12] = lambda_B2_x;
    aside->lambda[13] = lambda_B2_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent: {
        double force[N_Q], rhs[N_ROWS];
        force[0] = 0.0;
        force[1] = p->weight_crank0_y;
        force[2] = 0.0;
        force[3] = 0.0;
        force[4] = p->weight_crank1_y;
        force[5] = 0.0;
        force[6] = 0.0;
        force[7] = p->weight_crank2_y;
        force[8] = 0.0;
        force[9] = 0.0;
        force[10] = p->weight_coupler1_y;
        force[11] = 0.0;
        force[12] = 0.0;
        force[13] = p->weight_coupler2_y;
        force[14] = 0.0;
        rhs[0] = rhs_O0_x;
        rhs[1] = rhs_O0_y;
        rhs[2] = rhs_O1_x;
        rhs[3] = rhs_O1_y;
        rhs[4] = rhs_O2_x;
        rhs[5] = rhs_O2_y;
        rhs[6] = rhs_A0_x;
        rhs[7] = rhs_A0_y;
        rhs[8] = rhs_B1_x;
        rhs[9] = rhs_B1_y;
        rhs[10] = rhs_A1_x;
        rhs[11] = rhs_A1_y;
        rhs[12] = rhs_B2_x;
        rhs[13] = rhs_B2_y;
        pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);
    }
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}
