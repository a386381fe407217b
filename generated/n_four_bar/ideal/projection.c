/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot; `worst` is the
 * largest |Phi|. To be subtracted. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)memory;
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

    /* parameters */
    const double crank0_head_x = p->crank0_head_x;
    const double crank1_head_x = p->crank1_head_x;
    const double crank2_head_x = p->crank2_head_x;
    const double coupler1_head_x = p->coupler1_head_x;
    const double coupler2_head_x = p->coupler2_head_x;
    const double O1_x = p->O1_x;
    const double O2_x = p->O2_x;
    const double inverse_crank0_mass = p->inverse_crank0_mass;
    const double inverse_crank2_mass = p->inverse_crank2_mass;
    const double inverse_coupler1_mass = p->inverse_coupler1_mass;
    const double inverse_coupler2_mass = p->inverse_coupler2_mass;
    const double inverse_crank1_mass = p->inverse_crank1_mass;
    const double inverse_crank0_inertia = p->inverse_crank0_inertia;
    const double inverse_crank2_inertia = p->inverse_crank2_inertia;
    const double inverse_coupler1_inertia = p->inverse_coupler1_inertia;
    const double inverse_coupler2_inertia = p->inverse_coupler2_inertia;
    const double inverse_crank1_inertia = p->inverse_crank1_inertia;

    /* directions, arms, drives */
    const double cos_theta_crank0 = cos(crank0_theta);
    const double sin_theta_crank0 = sin(crank0_theta);
    const double arm_crank0_head_x = cos_theta_crank0*crank0_head_x;
    const double arm_crank0_head_y = crank0_head_x*sin_theta_crank0;
    const double cos_theta_crank1 = cos(crank1_theta);
    const double sin_theta_crank1 = sin(crank1_theta);
    const double arm_crank1_head_x = cos_theta_crank1*crank1_head_x;
    const double arm_crank1_head_y = crank1_head_x*sin_theta_crank1;
    const double cos_theta_crank2 = cos(crank2_theta);
    const double sin_theta_crank2 = sin(crank2_theta);
    const double arm_crank2_head_x = cos_theta_crank2*crank2_head_x;
    const double arm_crank2_head_y = crank2_head_x*sin_theta_crank2;
    const double cos_theta_coupler1 = cos(coupler1_theta);
    const double sin_theta_coupler1 = sin(coupler1_theta);
    const double arm_coupler1_head_x = cos_theta_coupler1*coupler1_head_x;
    const double arm_coupler1_head_y = coupler1_head_x*sin_theta_coupler1;
    const double cos_theta_coupler2 = cos(coupler2_theta);
    const double sin_theta_coupler2 = sin(coupler2_theta);
    const double arm_coupler2_head_x = cos_theta_coupler2*coupler2_head_x;
    const double arm_coupler2_head_y = coupler2_head_x*sin_theta_coupler2;

    /* Phi and Phi_dot */
    const double phi_O0_x_2 = arm_crank0_head_x - crank0_x;
    const double phi_dot_O0_x_2 = -arm_crank0_head_y*crank0_omega - crank0_vx;
    const double phi_O0_y_2 = arm_crank0_head_y - crank0_y;
    const double phi_dot_O0_y_2 = arm_crank0_head_x*crank0_omega - crank0_vy;
    const double phi_O1_x_2 = O1_x + arm_crank1_head_x - crank1_x;
    const double phi_dot_O1_x_2 = -arm_crank1_head_y*crank1_omega - crank1_vx;
    const double phi_O1_y_2 = arm_crank1_head_y - crank1_y;
    const double phi_dot_O1_y_2 = arm_crank1_head_x*crank1_omega - crank1_vy;
    const double phi_O2_x_2 = O2_x + arm_crank2_head_x - crank2_x;
    const double phi_dot_O2_x_2 = -arm_crank2_head_y*crank2_omega - crank2_vx;
    const double phi_O2_y_2 = arm_crank2_head_y - crank2_y;
    const double phi_dot_O2_y_2 = arm_crank2_head_x*crank2_omega - crank2_vy;
    const double phi_A0_x_2 = arm_coupler1_head_x + arm_crank0_head_x - coupler1_x + crank0_x;
    const double phi_dot_A0_x_2 = -arm_coupler1_head_y*coupler1_omega - arm_crank0_head_y*crank0_omega -
        coupler1_vx + crank0_vx;
    const double phi_A0_y_2 = arm_coupler1_head_y + arm_crank0_head_y - coupler1_y + crank0_y;
    const double phi_dot_A0_y_2 = arm_coupler1_head_x*coupler1_omega + arm_crank0_head_x*crank0_omega -
        coupler1_vy + crank0_vy;
    const double phi_B1_x_2 = arm_coupler1_head_x - arm_crank1_head_x + coupler1_x - crank1_x;
    const double phi_dot_B1_x_2 = -arm_coupler1_head_y*coupler1_omega + arm_crank1_head_y*crank1_omega +
        coupler1_vx - crank1_vx;
    const double phi_B1_y_2 = arm_coupler1_head_y - arm_crank1_head_y + coupler1_y - crank1_y;
    const double phi_dot_B1_y_2 = arm_coupler1_head_x*coupler1_omega - arm_crank1_head_x*crank1_omega +
        coupler1_vy - crank1_vy;
    const double phi_A1_x_2 = arm_coupler2_head_x + arm_crank1_head_x - coupler2_x + crank1_x;
    const double phi_dot_A1_x_2 = -arm_coupler2_head_y*coupler2_omega - arm_crank1_head_y*crank1_omega -
        coupler2_vx + crank1_vx;
    const double phi_A1_y_2 = arm_coupler2_head_y + arm_crank1_head_y - coupler2_y + crank1_y;
    const double phi_dot_A1_y_2 = arm_coupler2_head_x*coupler2_omega + arm_crank1_head_x*crank1_omega -
        coupler2_vy + crank1_vy;
    const double phi_B2_x_2 = arm_coupler2_head_x - arm_crank2_head_x + coupler2_x - crank2_x;
    const double phi_dot_B2_x_2 = -arm_coupler2_head_y*coupler2_omega + arm_crank2_head_y*crank2_omega +
        coupler2_vx - crank2_vx;
    const double phi_B2_y_2 = arm_coupler2_head_y - arm_crank2_head_y + coupler2_y - crank2_y;
    const double phi_dot_B2_y_2 = arm_coupler2_head_x*coupler2_omega - arm_crank2_head_x*crank2_omega +
        coupler2_vy - crank2_vy;

    /* L D L^T of the KKT matrix */
    const double l_O0_x__crank0_theta_3 = -arm_crank0_head_y*inverse_crank0_inertia;
    const double l_O0_y__crank0_theta_3 = arm_crank0_head_x*inverse_crank0_inertia;
    const double l_A0_x__crank0_theta_3 = -arm_crank0_head_y*inverse_crank0_inertia;
    const double l_A0_y__crank0_theta_3 = arm_crank0_head_x*inverse_crank0_inertia;
    const double scale_O0_x_3 = -arm_crank0_head_y*l_O0_x__crank0_theta_3 + inverse_crank0_mass;
    if (!(scale_O0_x_3 > 1e-13 * scale_O0_x_3)) return 1;
    const double inverse_pivot_O0_x_3 = 1.0/scale_O0_x_3;
    const double w_O0_y__O0_x_2 = arm_crank0_head_y*l_O0_y__crank0_theta_3;
    const double l_O0_y__O0_x_3 = -inverse_pivot_O0_x_3*w_O0_y__O0_x_2;
    const double w_A0_x__O0_x_2 = arm_crank0_head_y*l_A0_x__crank0_theta_3 + inverse_crank0_mass;
    const double l_A0_x__O0_x_3 = -inverse_pivot_O0_x_3*w_A0_x__O0_x_2;
    const double w_A0_y__O0_x_2 = arm_crank0_head_y*l_A0_y__crank0_theta_3;
    const double l_A0_y__O0_x_3 = -inverse_pivot_O0_x_3*w_A0_y__O0_x_2;
    const double scale_O0_y_3 = arm_crank0_head_x*l_O0_y__crank0_theta_3 + inverse_crank0_mass;
    const double pivot_O0_y_3 = l_O0_y__O0_x_3*w_O0_y__O0_x_2 + scale_O0_y_3;
    if (!(pivot_O0_y_3 > 1e-13 * scale_O0_y_3)) return 2;
    const double inverse_pivot_O0_y_3 = 1.0/pivot_O0_y_3;
    const double w_A0_x__O0_y_2 = -arm_crank0_head_x*l_A0_x__crank0_theta_3 - l_A0_x__O0_x_3*w_O0_y__O0_x_2;
    const double l_A0_x__O0_y_3 = -inverse_pivot_O0_y_3*w_A0_x__O0_y_2;
    const double w_A0_y__O0_y_2 = -arm_crank0_head_x*l_A0_y__crank0_theta_3 + inverse_crank0_mass -
        l_A0_y__O0_x_3*w_O0_y__O0_x_2;
    const double l_A0_y__O0_y_3 = -inverse_pivot_O0_y_3*w_A0_y__O0_y_2;
    const double l_O2_x__crank2_theta_3 = -arm_crank2_head_y*inverse_crank2_inertia;
    const double l_O2_y__crank2_theta_3 = arm_crank2_head_x*inverse_crank2_inertia;
    const double l_B2_x__crank2_theta_3 = arm_crank2_head_y*inverse_crank2_inertia;
    const double l_B2_y__crank2_theta_3 = -arm_crank2_head_x*inverse_crank2_inertia;
    const double scale_O2_x_3 = -arm_crank2_head_y*l_O2_x__crank2_theta_3 + inverse_crank2_mass;
    if (!(scale_O2_x_3 > 1e-13 * scale_O2_x_3)) return 3;
    const double inverse_pivot_O2_x_3 = 1.0/scale_O2_x_3;
    const double w_O2_y__O2_x_2 = arm_crank2_head_y*l_O2_y__crank2_theta_3;
    const double l_O2_y__O2_x_3 = -inverse_pivot_O2_x_3*w_O2_y__O2_x_2;
    const double w_B2_x__O2_x_2 = arm_crank2_head_y*l_B2_x__crank2_theta_3 - inverse_crank2_mass;
    const double l_B2_x__O2_x_3 = -inverse_pivot_O2_x_3*w_B2_x__O2_x_2;
    const double w_B2_y__O2_x_2 = arm_crank2_head_y*l_B2_y__crank2_theta_3;
    const double l_B2_y__O2_x_3 = -inverse_pivot_O2_x_3*w_B2_y__O2_x_2;
    const double scale_O2_y_3 = arm_crank2_head_x*l_O2_y__crank2_theta_3 + inverse_crank2_mass;
    const double pivot_O2_y_3 = l_O2_y__O2_x_3*w_O2_y__O2_x_2 + scale_O2_y_3;
    if (!(pivot_O2_y_3 > 1e-13 * scale_O2_y_3)) return 4;
    const double inverse_pivot_O2_y_3 = 1.0/pivot_O2_y_3;
    const double w_B2_x__O2_y_2 = -arm_crank2_head_x*l_B2_x__crank2_theta_3 - l_B2_x__O2_x_3*w_O2_y__O2_x_2;
    const double l_B2_x__O2_y_3 = -inverse_pivot_O2_y_3*w_B2_x__O2_y_2;
    const double w_B2_y__O2_y_2 = -arm_crank2_head_x*l_B2_y__crank2_theta_3 - inverse_crank2_mass -
        l_B2_y__O2_x_3*w_O2_y__O2_x_2;
    const double l_B2_y__O2_y_3 = -inverse_pivot_O2_y_3*w_B2_y__O2_y_2;
    const double l_A0_x__coupler1_theta_3 = -arm_coupler1_head_y*inverse_coupler1_inertia;
    const double l_A0_y__coupler1_theta_3 = arm_coupler1_head_x*inverse_coupler1_inertia;
    const double l_B1_x__coupler1_theta_3 = -arm_coupler1_head_y*inverse_coupler1_inertia;
    const double l_B1_y__coupler1_theta_3 = arm_coupler1_head_x*inverse_coupler1_inertia;
    const double scale_A0_x_3 = -arm_coupler1_head_y*l_A0_x__coupler1_theta_3 -
        arm_crank0_head_y*l_A0_x__crank0_theta_3 + inverse_coupler1_mass + inverse_crank0_mass;
    const double pivot_A0_x_3 = l_A0_x__O0_x_3*w_A0_x__O0_x_2 + l_A0_x__O0_y_3*w_A0_x__O0_y_2 + scale_A0_x_3;
    if (!(pivot_A0_x_3 > 1e-13 * scale_A0_x_3)) return 5;
    const double inverse_pivot_A0_x_3 = 1.0/pivot_A0_x_3;
    const double w_A0_y__A0_x_2 = arm_coupler1_head_y*l_A0_y__coupler1_theta_3 +
        arm_crank0_head_y*l_A0_y__crank0_theta_3 - l_A0_y__O0_x_3*w_A0_x__O0_x_2 -
        l_A0_y__O0_y_3*w_A0_x__O0_y_2;
    const double l_A0_y__A0_x_3 = -inverse_pivot_A0_x_3*w_A0_y__A0_x_2;
    const double w_B1_x__A0_x_2 = arm_coupler1_head_y*l_B1_x__coupler1_theta_3 + inverse_coupler1_mass;
    const double l_B1_x__A0_x_3 = -inverse_pivot_A0_x_3*w_B1_x__A0_x_2;
    const double w_B1_y__A0_x_2 = arm_coupler1_head_y*l_B1_y__coupler1_theta_3;
    const double l_B1_y__A0_x_3 = -inverse_pivot_A0_x_3*w_B1_y__A0_x_2;
    const double scale_A0_y_3 = arm_coupler1_head_x*l_A0_y__coupler1_theta_3 +
        arm_crank0_head_x*l_A0_y__crank0_theta_3 + inverse_coupler1_mass + inverse_crank0_mass;
    const double pivot_A0_y_3 = l_A0_y__A0_x_3*w_A0_y__A0_x_2 + l_A0_y__O0_x_3*w_A0_y__O0_x_2 +
        l_A0_y__O0_y_3*w_A0_y__O0_y_2 + scale_A0_y_3;
    if (!(pivot_A0_y_3 > 1e-13 * scale_A0_y_3)) return 6;
    const double inverse_pivot_A0_y_3 = 1.0/pivot_A0_y_3;
    const double w_B1_x__A0_y_2 = -arm_coupler1_head_x*l_B1_x__coupler1_theta_3 -
        l_B1_x__A0_x_3*w_A0_y__A0_x_2;
    const double l_B1_x__A0_y_3 = -inverse_pivot_A0_y_3*w_B1_x__A0_y_2;
    const double w_B1_y__A0_y_2 = -arm_coupler1_head_x*l_B1_y__coupler1_theta_3 + inverse_coupler1_mass -
        l_B1_y__A0_x_3*w_A0_y__A0_x_2;
    const double l_B1_y__A0_y_3 = -inverse_pivot_A0_y_3*w_B1_y__A0_y_2;
    const double l_B2_x__coupler2_theta_3 = -arm_coupler2_head_y*inverse_coupler2_inertia;
    const double l_B2_y__coupler2_theta_3 = arm_coupler2_head_x*inverse_coupler2_inertia;
    const double l_A1_x__coupler2_theta_3 = -arm_coupler2_head_y*inverse_coupler2_inertia;
    const double l_A1_y__coupler2_theta_3 = arm_coupler2_head_x*inverse_coupler2_inertia;
    const double scale_B2_x_3 = -arm_coupler2_head_y*l_B2_x__coupler2_theta_3 +
        arm_crank2_head_y*l_B2_x__crank2_theta_3 + inverse_coupler2_mass + inverse_crank2_mass;
    const double pivot_B2_x_3 = l_B2_x__O2_x_3*w_B2_x__O2_x_2 + l_B2_x__O2_y_3*w_B2_x__O2_y_2 + scale_B2_x_3;
    if (!(pivot_B2_x_3 > 1e-13 * scale_B2_x_3)) return 7;
    const double inverse_pivot_B2_x_3 = 1.0/pivot_B2_x_3;
    const double w_B2_y__B2_x_2 = arm_coupler2_head_y*l_B2_y__coupler2_theta_3 -
        arm_crank2_head_y*l_B2_y__crank2_theta_3 - l_B2_y__O2_x_3*w_B2_x__O2_x_2 -
        l_B2_y__O2_y_3*w_B2_x__O2_y_2;
    const double l_B2_y__B2_x_3 = -inverse_pivot_B2_x_3*w_B2_y__B2_x_2;
    const double w_A1_x__B2_x_2 = arm_coupler2_head_y*l_A1_x__coupler2_theta_3 + inverse_coupler2_mass;
    const double l_A1_x__B2_x_3 = -inverse_pivot_B2_x_3*w_A1_x__B2_x_2;
    const double w_A1_y__B2_x_2 = arm_coupler2_head_y*l_A1_y__coupler2_theta_3;
    const double l_A1_y__B2_x_3 = -inverse_pivot_B2_x_3*w_A1_y__B2_x_2;
    const double scale_B2_y_3 = arm_coupler2_head_x*l_B2_y__coupler2_theta_3 -
        arm_crank2_head_x*l_B2_y__crank2_theta_3 + inverse_coupler2_mass + inverse_crank2_mass;
    const double pivot_B2_y_3 = l_B2_y__B2_x_3*w_B2_y__B2_x_2 + l_B2_y__O2_x_3*w_B2_y__O2_x_2 +
        l_B2_y__O2_y_3*w_B2_y__O2_y_2 + scale_B2_y_3;
    if (!(pivot_B2_y_3 > 1e-13 * scale_B2_y_3)) return 8;
    const double inverse_pivot_B2_y_3 = 1.0/pivot_B2_y_3;
    const double w_A1_x__B2_y_2 = -arm_coupler2_head_x*l_A1_x__coupler2_theta_3 -
        l_A1_x__B2_x_3*w_B2_y__B2_x_2;
    const double l_A1_x__B2_y_3 = -inverse_pivot_B2_y_3*w_A1_x__B2_y_2;
    const double w_A1_y__B2_y_2 = -arm_coupler2_head_x*l_A1_y__coupler2_theta_3 + inverse_coupler2_mass -
        l_A1_y__B2_x_3*w_B2_y__B2_x_2;
    const double l_A1_y__B2_y_3 = -inverse_pivot_B2_y_3*w_A1_y__B2_y_2;
    const double l_O1_x__crank1_theta_3 = -arm_crank1_head_y*inverse_crank1_inertia;
    const double l_O1_y__crank1_theta_3 = arm_crank1_head_x*inverse_crank1_inertia;
    const double l_B1_x__crank1_theta_3 = arm_crank1_head_y*inverse_crank1_inertia;
    const double l_B1_y__crank1_theta_3 = -arm_crank1_head_x*inverse_crank1_inertia;
    const double l_A1_x__crank1_theta_3 = -arm_crank1_head_y*inverse_crank1_inertia;
    const double l_A1_y__crank1_theta_3 = arm_crank1_head_x*inverse_crank1_inertia;
    const double scale_O1_x_3 = -arm_crank1_head_y*l_O1_x__crank1_theta_3 + inverse_crank1_mass;
    if (!(scale_O1_x_3 > 1e-13 * scale_O1_x_3)) return 9;
    const double inverse_pivot_O1_x_3 = 1.0/scale_O1_x_3;
    const double w_O1_y__O1_x_2 = arm_crank1_head_y*l_O1_y__crank1_theta_3;
    const double l_O1_y__O1_x_3 = -inverse_pivot_O1_x_3*w_O1_y__O1_x_2;
    const double w_B1_x__O1_x_2 = arm_crank1_head_y*l_B1_x__crank1_theta_3 - inverse_crank1_mass;
    const double l_B1_x__O1_x_3 = -inverse_pivot_O1_x_3*w_B1_x__O1_x_2;
    const double w_B1_y__O1_x_2 = arm_crank1_head_y*l_B1_y__crank1_theta_3;
    const double l_B1_y__O1_x_3 = -inverse_pivot_O1_x_3*w_B1_y__O1_x_2;
    const double w_A1_x__O1_x_2 = arm_crank1_head_y*l_A1_x__crank1_theta_3 + inverse_crank1_mass;
    const double l_A1_x__O1_x_3 = -inverse_pivot_O1_x_3*w_A1_x__O1_x_2;
    const double w_A1_y__O1_x_2 = arm_crank1_head_y*l_A1_y__crank1_theta_3;
    const double l_A1_y__O1_x_3 = -inverse_pivot_O1_x_3*w_A1_y__O1_x_2;
    const double scale_O1_y_3 = arm_crank1_head_x*l_O1_y__crank1_theta_3 + inverse_crank1_mass;
    const double pivot_O1_y_3 = l_O1_y__O1_x_3*w_O1_y__O1_x_2 + scale_O1_y_3;
    if (!(pivot_O1_y_3 > 1e-13 * scale_O1_y_3)) return 10;
    const double inverse_pivot_O1_y_3 = 1.0/pivot_O1_y_3;
    const double w_B1_x__O1_y_2 = -arm_crank1_head_x*l_B1_x__crank1_theta_3 - l_B1_x__O1_x_3*w_O1_y__O1_x_2;
    const double l_B1_x__O1_y_3 = -inverse_pivot_O1_y_3*w_B1_x__O1_y_2;
    const double w_B1_y__O1_y_2 = -arm_crank1_head_x*l_B1_y__crank1_theta_3 - inverse_crank1_mass -
        l_B1_y__O1_x_3*w_O1_y__O1_x_2;
    const double l_B1_y__O1_y_3 = -inverse_pivot_O1_y_3*w_B1_y__O1_y_2;
    const double w_A1_x__O1_y_2 = -arm_crank1_head_x*l_A1_x__crank1_theta_3 - l_A1_x__O1_x_3*w_O1_y__O1_x_2;
    const double l_A1_x__O1_y_3 = -inverse_pivot_O1_y_3*w_A1_x__O1_y_2;
    const double w_A1_y__O1_y_2 = -arm_crank1_head_x*l_A1_y__crank1_theta_3 + inverse_crank1_mass -
        l_A1_y__O1_x_3*w_O1_y__O1_x_2;
    const double l_A1_y__O1_y_3 = -inverse_pivot_O1_y_3*w_A1_y__O1_y_2;
    const double scale_B1_x_3 = -arm_coupler1_head_y*l_B1_x__coupler1_theta_3 +
        arm_crank1_head_y*l_B1_x__crank1_theta_3 + inverse_coupler1_mass + inverse_crank1_mass;
    const double pivot_B1_x_3 = l_B1_x__A0_x_3*w_B1_x__A0_x_2 + l_B1_x__A0_y_3*w_B1_x__A0_y_2 +
        l_B1_x__O1_x_3*w_B1_x__O1_x_2 + l_B1_x__O1_y_3*w_B1_x__O1_y_2 + scale_B1_x_3;
    if (!(pivot_B1_x_3 > 1e-13 * scale_B1_x_3)) return 11;
    const double inverse_pivot_B1_x_3 = 1.0/pivot_B1_x_3;
    const double w_B1_y__B1_x_2 = arm_coupler1_head_y*l_B1_y__coupler1_theta_3 -
        arm_crank1_head_y*l_B1_y__crank1_theta_3 - l_B1_y__A0_x_3*w_B1_x__A0_x_2 -
        l_B1_y__A0_y_3*w_B1_x__A0_y_2 - l_B1_y__O1_x_3*w_B1_x__O1_x_2 - l_B1_y__O1_y_3*w_B1_x__O1_y_2;
    const double l_B1_y__B1_x_3 = -inverse_pivot_B1_x_3*w_B1_y__B1_x_2;
    const double w_A1_x__B1_x_2 = -arm_crank1_head_y*l_A1_x__crank1_theta_3 + inverse_crank1_mass -
        l_A1_x__O1_x_3*w_B1_x__O1_x_2 - l_A1_x__O1_y_3*w_B1_x__O1_y_2;
    const double l_A1_x__B1_x_3 = -inverse_pivot_B1_x_3*w_A1_x__B1_x_2;
    const double w_A1_y__B1_x_2 = -arm_crank1_head_y*l_A1_y__crank1_theta_3 - l_A1_y__O1_x_3*w_B1_x__O1_x_2 -
        l_A1_y__O1_y_3*w_B1_x__O1_y_2;
    const double l_A1_y__B1_x_3 = -inverse_pivot_B1_x_3*w_A1_y__B1_x_2;
    const double scale_B1_y_3 = arm_coupler1_head_x*l_B1_y__coupler1_theta_3 -
        arm_crank1_head_x*l_B1_y__crank1_theta_3 + inverse_coupler1_mass + inverse_crank1_mass;
    const double pivot_B1_y_3 = l_B1_y__A0_x_3*w_B1_y__A0_x_2 + l_B1_y__A0_y_3*w_B1_y__A0_y_2 +
        l_B1_y__B1_x_3*w_B1_y__B1_x_2 + l_B1_y__O1_x_3*w_B1_y__O1_x_2 + l_B1_y__O1_y_3*w_B1_y__O1_y_2 +
        scale_B1_y_3;
    if (!(pivot_B1_y_3 > 1e-13 * scale_B1_y_3)) return 12;
    const double inverse_pivot_B1_y_3 = 1.0/pivot_B1_y_3;
    const double w_A1_x__B1_y_2 = arm_crank1_head_x*l_A1_x__crank1_theta_3 - l_A1_x__B1_x_3*w_B1_y__B1_x_2 -
        l_A1_x__O1_x_3*w_B1_y__O1_x_2 - l_A1_x__O1_y_3*w_B1_y__O1_y_2;
    const double l_A1_x__B1_y_3 = -inverse_pivot_B1_y_3*w_A1_x__B1_y_2;
    const double w_A1_y__B1_y_2 = arm_crank1_head_x*l_A1_y__crank1_theta_3 + inverse_crank1_mass -
        l_A1_y__B1_x_3*w_B1_y__B1_x_2 - l_A1_y__O1_x_3*w_B1_y__O1_x_2 - l_A1_y__O1_y_3*w_B1_y__O1_y_2;
    const double l_A1_y__B1_y_3 = -inverse_pivot_B1_y_3*w_A1_y__B1_y_2;
    const double scale_A1_x_3 = -arm_coupler2_head_y*l_A1_x__coupler2_theta_3 -
        arm_crank1_head_y*l_A1_x__crank1_theta_3 + inverse_coupler2_mass + inverse_crank1_mass;
    const double pivot_A1_x_3 = l_A1_x__B1_x_3*w_A1_x__B1_x_2 + l_A1_x__B1_y_3*w_A1_x__B1_y_2 +
        l_A1_x__B2_x_3*w_A1_x__B2_x_2 + l_A1_x__B2_y_3*w_A1_x__B2_y_2 + l_A1_x__O1_x_3*w_A1_x__O1_x_2 +
        l_A1_x__O1_y_3*w_A1_x__O1_y_2 + scale_A1_x_3;
    if (!(pivot_A1_x_3 > 1e-13 * scale_A1_x_3)) return 13;
    const double inverse_pivot_A1_x_3 = 1.0/pivot_A1_x_3;
    const double w_A1_y__A1_x_2 = arm_coupler2_head_y*l_A1_y__coupler2_theta_3 +
        arm_crank1_head_y*l_A1_y__crank1_theta_3 - l_A1_y__B1_x_3*w_A1_x__B1_x_2 -
        l_A1_y__B1_y_3*w_A1_x__B1_y_2 - l_A1_y__B2_x_3*w_A1_x__B2_x_2 - l_A1_y__B2_y_3*w_A1_x__B2_y_2 -
        l_A1_y__O1_x_3*w_A1_x__O1_x_2 - l_A1_y__O1_y_3*w_A1_x__O1_y_2;
    const double l_A1_y__A1_x_3 = -inverse_pivot_A1_x_3*w_A1_y__A1_x_2;
    const double scale_A1_y_3 = arm_coupler2_head_x*l_A1_y__coupler2_theta_3 +
        arm_crank1_head_x*l_A1_y__crank1_theta_3 + inverse_coupler2_mass + inverse_crank1_mass;
    const double pivot_A1_y_3 = l_A1_y__A1_x_3*w_A1_y__A1_x_2 + l_A1_y__B1_x_3*w_A1_y__B1_x_2 +
        l_A1_y__B1_y_3*w_A1_y__B1_y_2 + l_A1_y__B2_x_3*w_A1_y__B2_x_2 + l_A1_y__B2_y_3*w_A1_y__B2_y_2 +
        l_A1_y__O1_x_3*w_A1_y__O1_x_2 + l_A1_y__O1_y_3*w_A1_y__O1_y_2 + scale_A1_y_3;
    if (!(pivot_A1_y_3 > 1e-13 * scale_A1_y_3)) return 14;
    const double inverse_pivot_A1_y_3 = 1.0/pivot_A1_y_3;

    /* forward substitution */
    const double dq_z_O0_y = -l_O0_y__O0_x_3*phi_O0_x_2 + phi_O0_y_2;
    const double dq_z_O2_y = -l_O2_y__O2_x_3*phi_O2_x_2 + phi_O2_y_2;
    const double dq_z_A0_x = -dq_z_O0_y*l_A0_x__O0_y_3 - l_A0_x__O0_x_3*phi_O0_x_2 + phi_A0_x_2;
    const double dq_z_A0_y = -dq_z_A0_x*l_A0_y__A0_x_3 - dq_z_O0_y*l_A0_y__O0_y_3 - l_A0_y__O0_x_3*phi_O0_x_2
        + phi_A0_y_2;
    const double dq_z_B2_x = -dq_z_O2_y*l_B2_x__O2_y_3 - l_B2_x__O2_x_3*phi_O2_x_2 + phi_B2_x_2;
    const double dq_z_B2_y = -dq_z_B2_x*l_B2_y__B2_x_3 - dq_z_O2_y*l_B2_y__O2_y_3 - l_B2_y__O2_x_3*phi_O2_x_2
        + phi_B2_y_2;
    const double dq_z_O1_y = -l_O1_y__O1_x_3*phi_O1_x_2 + phi_O1_y_2;
    const double dq_z_B1_x = -dq_z_A0_x*l_B1_x__A0_x_3 - dq_z_A0_y*l_B1_x__A0_y_3 - dq_z_O1_y*l_B1_x__O1_y_3 -
        l_B1_x__O1_x_3*phi_O1_x_2 + phi_B1_x_2;
    const double dq_z_B1_y = -dq_z_A0_x*l_B1_y__A0_x_3 - dq_z_A0_y*l_B1_y__A0_y_3 - dq_z_B1_x*l_B1_y__B1_x_3 -
        dq_z_O1_y*l_B1_y__O1_y_3 - l_B1_y__O1_x_3*phi_O1_x_2 + phi_B1_y_2;
    const double dq_z_A1_x = -dq_z_B1_x*l_A1_x__B1_x_3 - dq_z_B1_y*l_A1_x__B1_y_3 - dq_z_B2_x*l_A1_x__B2_x_3 -
        dq_z_B2_y*l_A1_x__B2_y_3 - dq_z_O1_y*l_A1_x__O1_y_3 - l_A1_x__O1_x_3*phi_O1_x_2 + phi_A1_x_2;
    const double dq_z_A1_y = -dq_z_A1_x*l_A1_y__A1_x_3 - dq_z_B1_x*l_A1_y__B1_x_3 - dq_z_B1_y*l_A1_y__B1_y_3 -
        dq_z_B2_x*l_A1_y__B2_x_3 - dq_z_B2_y*l_A1_y__B2_y_3 - dq_z_O1_y*l_A1_y__O1_y_3 -
        l_A1_y__O1_x_3*phi_O1_x_2 + phi_A1_y_2;

    /* backward substitution */
    const double dq_lambda_A1_y = -dq_z_A1_y*inverse_pivot_A1_y_3;
    const double dq_lambda_A1_x = -dq_lambda_A1_y*l_A1_y__A1_x_3 - dq_z_A1_x*inverse_pivot_A1_x_3;
    const double dq_lambda_B1_y = -dq_lambda_A1_x*l_A1_x__B1_y_3 - dq_lambda_A1_y*l_A1_y__B1_y_3 -
        dq_z_B1_y*inverse_pivot_B1_y_3;
    const double dq_lambda_B1_x = -dq_lambda_A1_x*l_A1_x__B1_x_3 - dq_lambda_A1_y*l_A1_y__B1_x_3 -
        dq_lambda_B1_y*l_B1_y__B1_x_3 - dq_z_B1_x*inverse_pivot_B1_x_3;
    const double dq_lambda_O1_y = -dq_lambda_A1_x*l_A1_x__O1_y_3 - dq_lambda_A1_y*l_A1_y__O1_y_3 -
        dq_lambda_B1_x*l_B1_x__O1_y_3 - dq_lambda_B1_y*l_B1_y__O1_y_3 - dq_z_O1_y*inverse_pivot_O1_y_3;
    const double dq_lambda_O1_x = -dq_lambda_A1_x*l_A1_x__O1_x_3 - dq_lambda_A1_y*l_A1_y__O1_x_3 -
        dq_lambda_B1_x*l_B1_x__O1_x_3 - dq_lambda_B1_y*l_B1_y__O1_x_3 - dq_lambda_O1_y*l_O1_y__O1_x_3 -
        inverse_pivot_O1_x_3*phi_O1_x_2;
    const double dq_acceleration_crank1_theta = -dq_lambda_A1_x*l_A1_x__crank1_theta_3 -
        dq_lambda_A1_y*l_A1_y__crank1_theta_3 - dq_lambda_B1_x*l_B1_x__crank1_theta_3 -
        dq_lambda_B1_y*l_B1_y__crank1_theta_3 - dq_lambda_O1_x*l_O1_x__crank1_theta_3 -
        dq_lambda_O1_y*l_O1_y__crank1_theta_3;
    const double dq_lambda_B2_y = -dq_lambda_A1_x*l_A1_x__B2_y_3 - dq_lambda_A1_y*l_A1_y__B2_y_3 -
        dq_z_B2_y*inverse_pivot_B2_y_3;
    const double dq_lambda_B2_x = -dq_lambda_A1_x*l_A1_x__B2_x_3 - dq_lambda_A1_y*l_A1_y__B2_x_3 -
        dq_lambda_B2_y*l_B2_y__B2_x_3 - dq_z_B2_x*inverse_pivot_B2_x_3;
    const double dq_acceleration_coupler2_theta = -dq_lambda_A1_x*l_A1_x__coupler2_theta_3 -
        dq_lambda_A1_y*l_A1_y__coupler2_theta_3 - dq_lambda_B2_x*l_B2_x__coupler2_theta_3 -
        dq_lambda_B2_y*l_B2_y__coupler2_theta_3;
    const double dq_lambda_A0_y = -dq_lambda_B1_x*l_B1_x__A0_y_3 - dq_lambda_B1_y*l_B1_y__A0_y_3 -
        dq_z_A0_y*inverse_pivot_A0_y_3;
    const double dq_lambda_A0_x = -dq_lambda_A0_y*l_A0_y__A0_x_3 - dq_lambda_B1_x*l_B1_x__A0_x_3 -
        dq_lambda_B1_y*l_B1_y__A0_x_3 - dq_z_A0_x*inverse_pivot_A0_x_3;
    const double dq_acceleration_coupler1_theta = -dq_lambda_A0_x*l_A0_x__coupler1_theta_3 -
        dq_lambda_A0_y*l_A0_y__coupler1_theta_3 - dq_lambda_B1_x*l_B1_x__coupler1_theta_3 -
        dq_lambda_B1_y*l_B1_y__coupler1_theta_3;
    const double dq_lambda_O2_y = -dq_lambda_B2_x*l_B2_x__O2_y_3 - dq_lambda_B2_y*l_B2_y__O2_y_3 -
        dq_z_O2_y*inverse_pivot_O2_y_3;
    const double dq_lambda_O2_x = -dq_lambda_B2_x*l_B2_x__O2_x_3 - dq_lambda_B2_y*l_B2_y__O2_x_3 -
        dq_lambda_O2_y*l_O2_y__O2_x_3 - inverse_pivot_O2_x_3*phi_O2_x_2;
    const double dq_acceleration_crank2_theta = -dq_lambda_B2_x*l_B2_x__crank2_theta_3 -
        dq_lambda_B2_y*l_B2_y__crank2_theta_3 - dq_lambda_O2_x*l_O2_x__crank2_theta_3 -
        dq_lambda_O2_y*l_O2_y__crank2_theta_3;
    const double dq_lambda_O0_y = -dq_lambda_A0_x*l_A0_x__O0_y_3 - dq_lambda_A0_y*l_A0_y__O0_y_3 -
        dq_z_O0_y*inverse_pivot_O0_y_3;
    const double dq_lambda_O0_x = -dq_lambda_A0_x*l_A0_x__O0_x_3 - dq_lambda_A0_y*l_A0_y__O0_x_3 -
        dq_lambda_O0_y*l_O0_y__O0_x_3 - inverse_pivot_O0_x_3*phi_O0_x_2;
    const double dq_acceleration_crank0_theta = -dq_lambda_A0_x*l_A0_x__crank0_theta_3 -
        dq_lambda_A0_y*l_A0_y__crank0_theta_3 - dq_lambda_O0_x*l_O0_x__crank0_theta_3 -
        dq_lambda_O0_y*l_O0_y__crank0_theta_3;
    const double dq_acceleration_crank1_y = -dq_lambda_A1_y*inverse_crank1_mass +
        dq_lambda_B1_y*inverse_crank1_mass + dq_lambda_O1_y*inverse_crank1_mass;
    const double dq_acceleration_crank1_x = -dq_lambda_A1_x*inverse_crank1_mass +
        dq_lambda_B1_x*inverse_crank1_mass + dq_lambda_O1_x*inverse_crank1_mass;
    const double dq_acceleration_coupler2_y = dq_lambda_A1_y*inverse_coupler2_mass -
        dq_lambda_B2_y*inverse_coupler2_mass;
    const double dq_acceleration_coupler2_x = dq_lambda_A1_x*inverse_coupler2_mass -
        dq_lambda_B2_x*inverse_coupler2_mass;
    const double dq_acceleration_coupler1_y = dq_lambda_A0_y*inverse_coupler1_mass -
        dq_lambda_B1_y*inverse_coupler1_mass;
    const double dq_acceleration_coupler1_x = dq_lambda_A0_x*inverse_coupler1_mass -
        dq_lambda_B1_x*inverse_coupler1_mass;
    const double dq_acceleration_crank2_y = dq_lambda_B2_y*inverse_crank2_mass +
        dq_lambda_O2_y*inverse_crank2_mass;
    const double dq_acceleration_crank2_x = dq_lambda_B2_x*inverse_crank2_mass +
        dq_lambda_O2_x*inverse_crank2_mass;
    const double dq_acceleration_crank0_y = -dq_lambda_A0_y*inverse_crank0_mass +
        dq_lambda_O0_y*inverse_crank0_mass;
    const double dq_acceleration_crank0_x = -dq_lambda_A0_x*inverse_crank0_mass +
        dq_lambda_O0_x*inverse_crank0_mass;

    /* forward substitution */
    const double dv_z_O0_y = -l_O0_y__O0_x_3*phi_dot_O0_x_2 + phi_dot_O0_y_2;
    const double dv_z_O2_y = -l_O2_y__O2_x_3*phi_dot_O2_x_2 + phi_dot_O2_y_2;
    const double dv_z_A0_x = -dv_z_O0_y*l_A0_x__O0_y_3 - l_A0_x__O0_x_3*phi_dot_O0_x_2 + phi_dot_A0_x_2;
    const double dv_z_A0_y = -dv_z_A0_x*l_A0_y__A0_x_3 - dv_z_O0_y*l_A0_y__O0_y_3 -
        l_A0_y__O0_x_3*phi_dot_O0_x_2 + phi_dot_A0_y_2;
    const double dv_z_B2_x = -dv_z_O2_y*l_B2_x__O2_y_3 - l_B2_x__O2_x_3*phi_dot_O2_x_2 + phi_dot_B2_x_2;
    const double dv_z_B2_y = -dv_z_B2_x*l_B2_y__B2_x_3 - dv_z_O2_y*l_B2_y__O2_y_3 -
        l_B2_y__O2_x_3*phi_dot_O2_x_2 + phi_dot_B2_y_2;
    const double dv_z_O1_y = -l_O1_y__O1_x_3*phi_dot_O1_x_2 + phi_dot_O1_y_2;
    const double dv_z_B1_x = -dv_z_A0_x*l_B1_x__A0_x_3 - dv_z_A0_y*l_B1_x__A0_y_3 - dv_z_O1_y*l_B1_x__O1_y_3 -
        l_B1_x__O1_x_3*phi_dot_O1_x_2 + phi_dot_B1_x_2;
    const double dv_z_B1_y = -dv_z_A0_x*l_B1_y__A0_x_3 - dv_z_A0_y*l_B1_y__A0_y_3 - dv_z_B1_x*l_B1_y__B1_x_3 -
        dv_z_O1_y*l_B1_y__O1_y_3 - l_B1_y__O1_x_3*phi_dot_O1_x_2 + phi_dot_B1_y_2;
    const double dv_z_A1_x = -dv_z_B1_x*l_A1_x__B1_x_3 - dv_z_B1_y*l_A1_x__B1_y_3 - dv_z_B2_x*l_A1_x__B2_x_3 -
        dv_z_B2_y*l_A1_x__B2_y_3 - dv_z_O1_y*l_A1_x__O1_y_3 - l_A1_x__O1_x_3*phi_dot_O1_x_2 + phi_dot_A1_x_2;
    const double dv_z_A1_y = -dv_z_A1_x*l_A1_y__A1_x_3 - dv_z_B1_x*l_A1_y__B1_x_3 - dv_z_B1_y*l_A1_y__B1_y_3 -
        dv_z_B2_x*l_A1_y__B2_x_3 - dv_z_B2_y*l_A1_y__B2_y_3 - dv_z_O1_y*l_A1_y__O1_y_3 -
        l_A1_y__O1_x_3*phi_dot_O1_x_2 + phi_dot_A1_y_2;

    /* backward substitution */
    const double dv_lambda_A1_y = -dv_z_A1_y*inverse_pivot_A1_y_3;
    const double dv_lambda_A1_x = -dv_lambda_A1_y*l_A1_y__A1_x_3 - dv_z_A1_x*inverse_pivot_A1_x_3;
    const double dv_lambda_B1_y = -dv_lambda_A1_x*l_A1_x__B1_y_3 - dv_lambda_A1_y*l_A1_y__B1_y_3 -
        dv_z_B1_y*inverse_pivot_B1_y_3;
    const double dv_lambda_B1_x = -dv_lambda_A1_x*l_A1_x__B1_x_3 - dv_lambda_A1_y*l_A1_y__B1_x_3 -
        dv_lambda_B1_y*l_B1_y__B1_x_3 - dv_z_B1_x*inverse_pivot_B1_x_3;
    const double dv_lambda_O1_y = -dv_lambda_A1_x*l_A1_x__O1_y_3 - dv_lambda_A1_y*l_A1_y__O1_y_3 -
        dv_lambda_B1_x*l_B1_x__O1_y_3 - dv_lambda_B1_y*l_B1_y__O1_y_3 - dv_z_O1_y*inverse_pivot_O1_y_3;
    const double dv_lambda_O1_x = -dv_lambda_A1_x*l_A1_x__O1_x_3 - dv_lambda_A1_y*l_A1_y__O1_x_3 -
        dv_lambda_B1_x*l_B1_x__O1_x_3 - dv_lambda_B1_y*l_B1_y__O1_x_3 - dv_lambda_O1_y*l_O1_y__O1_x_3 -
        inverse_pivot_O1_x_3*phi_dot_O1_x_2;
    const double dv_acceleration_crank1_theta = -dv_lambda_A1_x*l_A1_x__crank1_theta_3 -
        dv_lambda_A1_y*l_A1_y__crank1_theta_3 - dv_lambda_B1_x*l_B1_x__crank1_theta_3 -
        dv_lambda_B1_y*l_B1_y__crank1_theta_3 - dv_lambda_O1_x*l_O1_x__crank1_theta_3 -
        dv_lambda_O1_y*l_O1_y__crank1_theta_3;
    const double dv_lambda_B2_y = -dv_lambda_A1_x*l_A1_x__B2_y_3 - dv_lambda_A1_y*l_A1_y__B2_y_3 -
        dv_z_B2_y*inverse_pivot_B2_y_3;
    const double dv_lambda_B2_x = -dv_lambda_A1_x*l_A1_x__B2_x_3 - dv_lambda_A1_y*l_A1_y__B2_x_3 -
        dv_lambda_B2_y*l_B2_y__B2_x_3 - dv_z_B2_x*inverse_pivot_B2_x_3;
    const double dv_acceleration_coupler2_theta = -dv_lambda_A1_x*l_A1_x__coupler2_theta_3 -
        dv_lambda_A1_y*l_A1_y__coupler2_theta_3 - dv_lambda_B2_x*l_B2_x__coupler2_theta_3 -
        dv_lambda_B2_y*l_B2_y__coupler2_theta_3;
    const double dv_lambda_A0_y = -dv_lambda_B1_x*l_B1_x__A0_y_3 - dv_lambda_B1_y*l_B1_y__A0_y_3 -
        dv_z_A0_y*inverse_pivot_A0_y_3;
    const double dv_lambda_A0_x = -dv_lambda_A0_y*l_A0_y__A0_x_3 - dv_lambda_B1_x*l_B1_x__A0_x_3 -
        dv_lambda_B1_y*l_B1_y__A0_x_3 - dv_z_A0_x*inverse_pivot_A0_x_3;
    const double dv_acceleration_coupler1_theta = -dv_lambda_A0_x*l_A0_x__coupler1_theta_3 -
        dv_lambda_A0_y*l_A0_y__coupler1_theta_3 - dv_lambda_B1_x*l_B1_x__coupler1_theta_3 -
        dv_lambda_B1_y*l_B1_y__coupler1_theta_3;
    const double dv_lambda_O2_y = -dv_lambda_B2_x*l_B2_x__O2_y_3 - dv_lambda_B2_y*l_B2_y__O2_y_3 -
        dv_z_O2_y*inverse_pivot_O2_y_3;
    const double dv_lambda_O2_x = -dv_lambda_B2_x*l_B2_x__O2_x_3 - dv_lambda_B2_y*l_B2_y__O2_x_3 -
        dv_lambda_O2_y*l_O2_y__O2_x_3 - inverse_pivot_O2_x_3*phi_dot_O2_x_2;
    const double dv_acceleration_crank2_theta = -dv_lambda_B2_x*l_B2_x__crank2_theta_3 -
        dv_lambda_B2_y*l_B2_y__crank2_theta_3 - dv_lambda_O2_x*l_O2_x__crank2_theta_3 -
        dv_lambda_O2_y*l_O2_y__crank2_theta_3;
    const double dv_lambda_O0_y = -dv_lambda_A0_x*l_A0_x__O0_y_3 - dv_lambda_A0_y*l_A0_y__O0_y_3 -
        dv_z_O0_y*inverse_pivot_O0_y_3;
    const double dv_lambda_O0_x = -dv_lambda_A0_x*l_A0_x__O0_x_3 - dv_lambda_A0_y*l_A0_y__O0_x_3 -
        dv_lambda_O0_y*l_O0_y__O0_x_3 - inverse_pivot_O0_x_3*phi_dot_O0_x_2;
    const double dv_acceleration_crank0_theta = -dv_lambda_A0_x*l_A0_x__crank0_theta_3 -
        dv_lambda_A0_y*l_A0_y__crank0_theta_3 - dv_lambda_O0_x*l_O0_x__crank0_theta_3 -
        dv_lambda_O0_y*l_O0_y__crank0_theta_3;
    const double dv_acceleration_crank1_y = -dv_lambda_A1_y*inverse_crank1_mass +
        dv_lambda_B1_y*inverse_crank1_mass + dv_lambda_O1_y*inverse_crank1_mass;
    const double dv_acceleration_crank1_x = -dv_lambda_A1_x*inverse_crank1_mass +
        dv_lambda_B1_x*inverse_crank1_mass + dv_lambda_O1_x*inverse_crank1_mass;
    const double dv_acceleration_coupler2_y = dv_lambda_A1_y*inverse_coupler2_mass -
        dv_lambda_B2_y*inverse_coupler2_mass;
    const double dv_acceleration_coupler2_x = dv_lambda_A1_x*inverse_coupler2_mass -
        dv_lambda_B2_x*inverse_coupler2_mass;
    const double dv_acceleration_coupler1_y = dv_lambda_A0_y*inverse_coupler1_mass -
        dv_lambda_B1_y*inverse_coupler1_mass;
    const double dv_acceleration_coupler1_x = dv_lambda_A0_x*inverse_coupler1_mass -
        dv_lambda_B1_x*inverse_coupler1_mass;
    const double dv_acceleration_crank2_y = dv_lambda_B2_y*inverse_crank2_mass +
        dv_lambda_O2_y*inverse_crank2_mass;
    const double dv_acceleration_crank2_x = dv_lambda_B2_x*inverse_crank2_mass +
        dv_lambda_O2_x*inverse_crank2_mass;
    const double dv_acceleration_crank0_y = -dv_lambda_A0_y*inverse_crank0_mass +
        dv_lambda_O0_y*inverse_crank0_mass;
    const double dv_acceleration_crank0_x = -dv_lambda_A0_x*inverse_crank0_mass +
        dv_lambda_O0_x*inverse_crank0_mass;

    /* results */
    dq[0] = dq_acceleration_crank0_x;
    dv[0] = dv_acceleration_crank0_x;
    dq[1] = dq_acceleration_crank0_y;
    dv[1] = dv_acceleration_crank0_y;
    dq[2] = dq_acceleration_crank0_theta;
    dv[2] = dv_acceleration_crank0_theta;
    dq[3] = dq_acceleration_crank1_x;
    dv[3] = dv_acceleration_crank1_x;
    dq[4] = dq_acceleration_crank1_y;
    dv[4] = dv_acceleration_crank1_y;
    dq[5] = dq_acceleration_crank1_theta;
    dv[5] = dv_acceleration_crank1_theta;
    dq[6] = dq_acceleration_crank2_x;
    dv[6] = dv_acceleration_crank2_x;
    dq[7] = dq_acceleration_crank2_y;
    dv[7] = dv_acceleration_crank2_y;
    dq[8] = dq_acceleration_crank2_theta;
    dv[8] = dv_acceleration_crank2_theta;
    dq[9] = dq_acceleration_coupler1_x;
    dv[9] = dv_acceleration_coupler1_x;
    dq[10] = dq_acceleration_coupler1_y;
    dv[10] = dv_acceleration_coupler1_y;
    dq[11] = dq_acceleration_coupler1_theta;
    dv[11] = dv_acceleration_coupler1_theta;
    dq[12] = dq_acceleration_coupler2_x;
    dv[12] = dv_acceleration_coupler2_x;
    dq[13] = dq_acceleration_coupler2_y;
    dv[13] = dv_acceleration_coupler2_y;
    dq[14] = dq_acceleration_coupler2_theta;
    dv[14] = dv_acceleration_coupler2_theta;
    *worst = 0.0;
    *worst = fmax(fabs(phi_O0_x_2), *worst);
    *worst = fmax(fabs(phi_O0_y_2), *worst);
    *worst = fmax(fabs(phi_O1_x_2), *worst);
    *worst = fmax(fabs(phi_O1_y_2), *worst);
    *worst = fmax(fabs(phi_O2_x_2), *worst);
    *worst = fmax(fabs(phi_O2_y_2), *worst);
    *worst = fmax(fabs(phi_A0_x_2), *worst);
    *worst = fmax(fabs(phi_A0_y_2), *worst);
    *worst = fmax(fabs(phi_B1_x_2), *worst);
    *worst = fmax(fabs(phi_B1_y_2), *worst);
    *worst = fmax(fabs(phi_A1_x_2), *worst);
    *worst = fmax(fabs(phi_A1_y_2), *worst);
    *worst = fmax(fabs(phi_B2_x_2), *worst);
    *worst = fmax(fabs(phi_B2_y_2), *worst);
    return 0;
}

