/* (F along n, F along t, M_i, M_j) of a joint with play and their derivatives by (e, deltadot, de_t, omega_i, omega_j). */
typedef struct {
    double value[4], slope[4][5];
} PinSlopes;

/*
 * As a share of the clearance: nearer to the centre the derivatives are those at the centre. There a force along the
 * normal and the normal's own turning cancel, which leaves some DBL_EPSILON c/e of rounding.
 */
#define CENTRED 1e-8

/*
 * From n, t to ground axes. Where e moves by de = (along n, along t) = (x, y), n turns by y/e: F by F rotated, and
 * deltadot, de_t by (de_t, -deltadot) y/e.
 */
static inline void in_ground_axes(const PinSlopes *F, double n_x, double n_y, double deltadot, double de_t, double per_e,
    double dF[4][6])
{
    double by[4][6];
    for (int i = 0; i < 4; i++) {
        const double *slope = F->slope[i];
        by[i][0] = slope[0];
        by[i][1] = (slope[1] * de_t - slope[2] * deltadot) * per_e;
        by[i][2] = slope[1];
        by[i][3] = slope[2];
        dF[i][4] = slope[3];
        dF[i][5] = slope[4];
    }
    by[0][1] -= F->value[1] * per_e;
    by[1][1] += F->value[0] * per_e;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k += 2) {
            dF[i][k] = by[i][k] * n_x - by[i][k + 1] * n_y;
            dF[i][k + 1] = by[i][k] * n_y + by[i][k + 1] * n_x;
        }
    for (int k = 0; k < 6; k++) {
        const double along_n = dF[0][k], along_t = dF[1][k];
        dF[0][k] = along_n * n_x - along_t * n_y;
        dF[1][k] = along_n * n_y + along_t * n_x;
    }
}


/*
 * Joint A, dry: F along n and t, M_i, M_j, and their derivatives by e, deltadot, de_t,
 * omega_i, omega_j (forward differentiation of the same steps).
 */
static inline void dry_slopes_A(double e, double deltadot, double de_t, double omega_i, double omega_j, const
    Latch *latch, const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    /* parameters */
    const double dry_normal_exponent = p->dry_normal_exponent;
    const double dry_pin_K = p->dry_pin_K;
    const double dry_pin_hysteresis = p->dry_pin_hysteresis;
    const double dry_friction_mu = p->dry_friction_mu;
    const double dry_friction_v0 = p->dry_friction_v0;
    const double dry_pin_friction_slope = p->dry_pin_friction_slope;

    /* penetration, ratio of velocities, slip */
    const double delta = e - p->pin_clearance;
    const double par_depth = max_of(delta, 0.0);
    const double depth_by_e = delta > 0.0 ? 1.0 : 0.0;
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double ratio_by_deltadot = latch->closed ? 1.0 / latch->deltadot_minus : 0.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const double v_t_by_e = -0.5*omega_i - 0.5*omega_j;

    /* contact of joint A */
    const double side_0 = side_of(side, g, 0, dry_pin_hysteresis*ratio + 1.0);
    const double F_n = dry_pin_K*pow(par_depth, dry_normal_exponent)*(side_0 < 0.0 ? 0.0 :
        dry_pin_hysteresis*ratio + 1.0);
    const double F_n_by_par_depth = dry_normal_exponent*dry_pin_K*pow(par_depth, dry_normal_exponent -
        1.0)*(side_0 < 0.0 ? 0.0 : dry_pin_hysteresis*ratio + 1.0);
    const double F_n_by_ratio = dry_pin_K*pow(par_depth, dry_normal_exponent)*(side_0 < 0.0 ? 0.0 :
        dry_pin_hysteresis);
    const double F_n_by_e = F_n_by_par_depth*depth_by_e;
    const double F_n_by_deltadot = F_n_by_ratio*ratio_by_deltadot;
    const double side_1 = side_of(side, g, 1, -dry_pin_friction_slope*(-dry_friction_v0 - v_t) + 1.0);
    const double side_2 = side_of(side, g, 2, (side_1 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 -
        v_t)));
    const double side_3 = side_of(side, g, 3, -dry_pin_friction_slope*(-dry_friction_v0 + v_t) + 1.0);
    const double side_4 = side_of(side, g, 4, (side_3 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 +
        v_t)));
    const double F_t = -F_n*dry_friction_mu*(-(side_2 < 0.0 ? 0.0 : (side_1 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 - v_t))) + (side_4 < 0.0 ? 0.0 : (side_3 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 + v_t))));
    const double F_t_by_F_n = -dry_friction_mu*(-(side_2 < 0.0 ? 0.0 : (side_1 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 - v_t))) + (side_4 < 0.0 ? 0.0 : (side_3 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 + v_t))));
    const double F_t_by_v_t = -F_n*dry_friction_mu*(-(side_2 < 0.0 ? 0.0 : (side_1 < 0.0 ? 0.0 :
        -dry_pin_friction_slope)) + (side_4 < 0.0 ? 0.0 : (side_3 < 0.0 ? 0.0 : dry_pin_friction_slope)));
    const double F_t_by_e = F_n_by_e*F_t_by_F_n + F_t_by_v_t*v_t_by_e;
    const double F_t_by_deltadot = F_n_by_deltadot*F_t_by_F_n;
    const double F_t_by_omega_i = -F_t_by_v_t*a_i;
    const double F_t_by_omega_j = F_t_by_v_t*a_j;
    const double F_along_t_dry = F_t;
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_i_dry_by_e = -0.5*F_along_t_dry - F_t_by_e*a_i;
    const double M_i_dry_by_deltadot = -F_t_by_deltadot*a_i;
    const double M_i_dry_by_de_t = -F_t_by_v_t*a_i;
    const double M_i_dry_by_omega_i = -F_t_by_omega_i*a_i;
    const double M_i_dry_by_omega_j = -F_t_by_omega_j*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    const double M_j_dry_by_e = -0.5*F_along_t_dry + F_t_by_e*a_j;
    const double M_j_dry_by_deltadot = F_t_by_deltadot*a_j;
    const double M_j_dry_by_de_t = F_t_by_v_t*a_j;
    const double M_j_dry_by_omega_i = F_t_by_omega_i*a_j;
    const double M_j_dry_by_omega_j = F_t_by_omega_j*a_j;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e;
    out->slope[0][1] = -F_n_by_deltadot;
    out->slope[0][2] = 0.0;
    out->slope[0][3] = 0.0;
    out->slope[0][4] = 0.0;
    out->value[1] = F_along_t_dry;
    out->slope[1][0] = F_t_by_e;
    out->slope[1][1] = F_t_by_deltadot;
    out->slope[1][2] = F_t_by_v_t;
    out->slope[1][3] = F_t_by_omega_i;
    out->slope[1][4] = F_t_by_omega_j;
    out->value[2] = M_i_dry;
    out->slope[2][0] = M_i_dry_by_e;
    out->slope[2][1] = M_i_dry_by_deltadot;
    out->slope[2][2] = M_i_dry_by_de_t;
    out->slope[2][3] = M_i_dry_by_omega_i;
    out->slope[2][4] = M_i_dry_by_omega_j;
    out->value[3] = M_j_dry;
    out->slope[3][0] = M_j_dry_by_e;
    out->slope[3][1] = M_j_dry_by_deltadot;
    out->slope[3][2] = M_j_dry_by_de_t;
    out->slope[3][3] = M_j_dry_by_omega_i;
    out->slope[3][4] = M_j_dry_by_omega_j;
}

/*
 * Joint A: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_A(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_A(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, out);
}

static void tangent_A(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance) {
        const double n_x = e_x / e, n_y = e_y / e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_A(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, 1.0 / e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_A(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_A(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
    dF[0][1] = -F.slope[1][0];
    dF[1][1] = F.slope[0][0];
    dF[2][1] = F.slope[2][0];
    dF[3][1] = F.slope[3][0];
}

/*
 * Joint B, dry: F along n and t, M_i, M_j, and their derivatives by e, deltadot, de_t,
 * omega_i, omega_j (forward differentiation of the same steps).
 */
static inline void dry_slopes_B(double e, double deltadot, double de_t, double omega_i, double omega_j, const
    Latch *latch, const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    /* parameters */
    const double dry_normal_exponent = p->dry_normal_exponent;
    const double dry_pin_K = p->dry_pin_K;
    const double dry_pin_hysteresis = p->dry_pin_hysteresis;
    const double dry_friction_mu = p->dry_friction_mu;
    const double dry_friction_v0 = p->dry_friction_v0;
    const double dry_pin_friction_slope = p->dry_pin_friction_slope;

    /* penetration, ratio of velocities, slip */
    const double delta = e - p->pin_clearance;
    const double par_depth_2 = max_of(delta, 0.0);
    const double depth_by_e_2 = delta > 0.0 ? 1.0 : 0.0;
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double ratio_by_deltadot_2 = latch->closed ? 1.0 / latch->deltadot_minus : 0.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const double v_t_by_e_2 = -0.5*omega_i - 0.5*omega_j;

    /* contact of joint B */
    const double side_5 = side_of(side, g, 5, dry_pin_hysteresis*ratio + 1.0);
    const double F_n = dry_pin_K*pow(par_depth_2, dry_normal_exponent)*(side_5 < 0.0 ? 0.0 :
        dry_pin_hysteresis*ratio + 1.0);
    const double F_n_by_par_depth_2 = dry_normal_exponent*dry_pin_K*pow(par_depth_2, dry_normal_exponent -
        1.0)*(side_5 < 0.0 ? 0.0 : dry_pin_hysteresis*ratio + 1.0);
    const double F_n_by_ratio_2 = dry_pin_K*pow(par_depth_2, dry_normal_exponent)*(side_5 < 0.0 ? 0.0 :
        dry_pin_hysteresis);
    const double F_n_by_e_2 = F_n_by_par_depth_2*depth_by_e_2;
    const double F_n_by_deltadot_2 = F_n_by_ratio_2*ratio_by_deltadot_2;
    const double side_6 = side_of(side, g, 6, -dry_pin_friction_slope*(-dry_friction_v0 - v_t) + 1.0);
    const double side_7 = side_of(side, g, 7, (side_6 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 -
        v_t)));
    const double side_8 = side_of(side, g, 8, -dry_pin_friction_slope*(-dry_friction_v0 + v_t) + 1.0);
    const double side_9 = side_of(side, g, 9, (side_8 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 +
        v_t)));
    const double F_t = -F_n*dry_friction_mu*(-(side_7 < 0.0 ? 0.0 : (side_6 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 - v_t))) + (side_9 < 0.0 ? 0.0 : (side_8 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 + v_t))));
    const double F_t_by_F_n_2 = -dry_friction_mu*(-(side_7 < 0.0 ? 0.0 : (side_6 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 - v_t))) + (side_9 < 0.0 ? 0.0 : (side_8 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 + v_t))));
    const double F_t_by_v_t_2 = -F_n*dry_friction_mu*(-(side_7 < 0.0 ? 0.0 : (side_6 < 0.0 ? 0.0 :
        -dry_pin_friction_slope)) + (side_9 < 0.0 ? 0.0 : (side_8 < 0.0 ? 0.0 : dry_pin_friction_slope)));
    const double F_t_by_e_2 = F_n_by_e_2*F_t_by_F_n_2 + F_t_by_v_t_2*v_t_by_e_2;
    const double F_t_by_deltadot_2 = F_n_by_deltadot_2*F_t_by_F_n_2;
    const double F_t_by_omega_i_2 = -F_t_by_v_t_2*a_i;
    const double F_t_by_omega_j_2 = F_t_by_v_t_2*a_j;
    const double F_along_t_dry = F_t;
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_i_dry_by_e_2 = -0.5*F_along_t_dry - F_t_by_e_2*a_i;
    const double M_i_dry_by_deltadot_2 = -F_t_by_deltadot_2*a_i;
    const double M_i_dry_by_de_t_2 = -F_t_by_v_t_2*a_i;
    const double M_i_dry_by_omega_i_2 = -F_t_by_omega_i_2*a_i;
    const double M_i_dry_by_omega_j_2 = -F_t_by_omega_j_2*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    const double M_j_dry_by_e_2 = -0.5*F_along_t_dry + F_t_by_e_2*a_j;
    const double M_j_dry_by_deltadot_2 = F_t_by_deltadot_2*a_j;
    const double M_j_dry_by_de_t_2 = F_t_by_v_t_2*a_j;
    const double M_j_dry_by_omega_i_2 = F_t_by_omega_i_2*a_j;
    const double M_j_dry_by_omega_j_2 = F_t_by_omega_j_2*a_j;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e_2;
    out->slope[0][1] = -F_n_by_deltadot_2;
    out->slope[0][2] = 0.0;
    out->slope[0][3] = 0.0;
    out->slope[0][4] = 0.0;
    out->value[1] = F_along_t_dry;
    out->slope[1][0] = F_t_by_e_2;
    out->slope[1][1] = F_t_by_deltadot_2;
    out->slope[1][2] = F_t_by_v_t_2;
    out->slope[1][3] = F_t_by_omega_i_2;
    out->slope[1][4] = F_t_by_omega_j_2;
    out->value[2] = M_i_dry;
    out->slope[2][0] = M_i_dry_by_e_2;
    out->slope[2][1] = M_i_dry_by_deltadot_2;
    out->slope[2][2] = M_i_dry_by_de_t_2;
    out->slope[2][3] = M_i_dry_by_omega_i_2;
    out->slope[2][4] = M_i_dry_by_omega_j_2;
    out->value[3] = M_j_dry;
    out->slope[3][0] = M_j_dry_by_e_2;
    out->slope[3][1] = M_j_dry_by_deltadot_2;
    out->slope[3][2] = M_j_dry_by_de_t_2;
    out->slope[3][3] = M_j_dry_by_omega_i_2;
    out->slope[3][4] = M_j_dry_by_omega_j_2;
}

/*
 * Joint B: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_B(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_B(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, out);
}

static void tangent_B(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance) {
        const double n_x = e_x / e, n_y = e_y / e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_B(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, 1.0 / e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_B(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_B(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
    dF[0][1] = -F.slope[1][0];
    dF[1][1] = F.slope[0][0];
    dF[2][1] = F.slope[2][0];
    dF[3][1] = F.slope[3][0];
}
/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[131]; /* what linearize() found */
    double lu[260];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)t;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double g[N_SWITCHES + 1];

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
    const double L6_theta = q[14];
    const double L6_omega = v[14];
    const double L7_theta = q[17];
    const double L7_omega = v[17];
    const double L8_theta = q[20];
    const double L8_omega = v[20];
    const double acceleration_L1_theta_2 = a[2];
    const double acceleration_L2_theta_2 = a[5];
    const double acceleration_L3_theta_2 = a[8];
    const double acceleration_L4_theta_2 = a[11];
    const double acceleration_L6_theta_2 = a[14];
    const double acceleration_L7_theta_2 = a[17];
    const double acceleration_L8_theta_2 = a[20];
    const double multiplier_O1_x_2 = aside->lambda[0];
    const double multiplier_O1_y_2 = aside->lambda[1];
    const double multiplier_O4_x_2 = aside->lambda[2];
    const double multiplier_O4_y_2 = aside->lambda[3];
    const double multiplier_P2_x_2 = aside->lambda[4];
    const double multiplier_P2_y_2 = aside->lambda[5];
    const double multiplier_P3_x_2 = aside->lambda[6];
    const double multiplier_P3_y_2 = aside->lambda[7];
    const double multiplier_Q6_x_2 = aside->lambda[8];
    const double multiplier_Q6_y_2 = aside->lambda[9];
    const double multiplier_Q8_x_2 = aside->lambda[10];
    const double multiplier_Q8_y_2 = aside->lambda[11];
    const double multiplier_O6_x_2 = aside->lambda[12];
    const double multiplier_O6_y_2 = aside->lambda[13];
    const double multiplier_slider_x_2 = aside->lambda[14];
    const double multiplier_slider_y_2 = aside->lambda[15];
    const double multiplier_crank1_2 = aside->lambda[18];
    const double multiplier_crank4_2 = aside->lambda[19];
    const double A_Fx = aside->clearance[0].Fx;
    const double A_Fy = aside->clearance[0].Fy;
    const double A_moment_first = aside->clearance[0].moment_first;
    const double A_moment_second = aside->clearance[0].moment_second;
    const double B_Fx = aside->clearance[1].Fx;
    const double B_Fy = aside->clearance[1].Fy;
    const double B_moment_first = aside->clearance[1].moment_first;
    const double B_moment_second = aside->clearance[1].moment_second;

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
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

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
    const double crank1_rate = omega;
    const double crank1_acceleration = 0.0;
    const double crank4_rate = omega4;
    const double crank4_acceleration = 0.0;

    /* clearance joint A */
    const double e_A_x_2 = -L1_x + L2_x - arm_L1_head_x - arm_L2_head_x;
    const double e_A_y_2 = -L1_y + L2_y - arm_L1_head_y - arm_L2_head_y;
    const double edot_A_x_2 = L1_omega*arm_L1_head_y - L1_vx + L2_omega*arm_L2_head_y + L2_vx;
    const double edot_A_y_2 = -L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy;
    double slopes_A[4][6];
    tangent_A(e_A_x_2, e_A_y_2, edot_A_x_2, edot_A_y_2, L1_omega, L2_omega, &memory->latch[0], p, side, g, slopes_A);
    const double A_Fx_by_e_x = slopes_A[0][0];
    const double A_Fx_by_e_y = slopes_A[0][1];
    const double A_Fx_by_de_x = slopes_A[0][2];
    const double A_Fx_by_de_y = slopes_A[0][3];
    const double A_Fx_by_omega_i = slopes_A[0][4];
    const double A_Fx_by_omega_j = slopes_A[0][5];
    const double A_Fx_by_L1_theta = A_Fx_by_de_x*L1_omega*arm_L1_head_x + A_Fx_by_de_y*L1_omega*arm_L1_head_y
        + A_Fx_by_e_x*arm_L1_head_y - A_Fx_by_e_y*arm_L1_head_x;
    const double A_Fx_by_L2_theta = A_Fx_by_de_x*L2_omega*arm_L2_head_x + A_Fx_by_de_y*L2_omega*arm_L2_head_y
        + A_Fx_by_e_x*arm_L2_head_y - A_Fx_by_e_y*arm_L2_head_x;
    const double A_Fx_by_L1_omega = A_Fx_by_de_x*arm_L1_head_y - A_Fx_by_de_y*arm_L1_head_x + A_Fx_by_omega_i;
    const double A_Fx_by_L2_omega = A_Fx_by_de_x*arm_L2_head_y - A_Fx_by_de_y*arm_L2_head_x + A_Fx_by_omega_j;
    const double A_Fy_by_e_x = slopes_A[1][0];
    const double A_Fy_by_e_y = slopes_A[1][1];
    const double A_Fy_by_de_x = slopes_A[1][2];
    const double A_Fy_by_de_y = slopes_A[1][3];
    const double A_Fy_by_omega_i = slopes_A[1][4];
    const double A_Fy_by_omega_j = slopes_A[1][5];
    const double A_Fy_by_L1_theta = A_Fy_by_de_x*L1_omega*arm_L1_head_x + A_Fy_by_de_y*L1_omega*arm_L1_head_y
        + A_Fy_by_e_x*arm_L1_head_y - A_Fy_by_e_y*arm_L1_head_x;
    const double A_Fy_by_L2_theta = A_Fy_by_de_x*L2_omega*arm_L2_head_x + A_Fy_by_de_y*L2_omega*arm_L2_head_y
        + A_Fy_by_e_x*arm_L2_head_y - A_Fy_by_e_y*arm_L2_head_x;
    const double A_Fy_by_L1_omega = A_Fy_by_de_x*arm_L1_head_y - A_Fy_by_de_y*arm_L1_head_x + A_Fy_by_omega_i;
    const double A_Fy_by_L2_omega = A_Fy_by_de_x*arm_L2_head_y - A_Fy_by_de_y*arm_L2_head_x + A_Fy_by_omega_j;
    const double A_moment_first_by_e_x = slopes_A[2][0];
    const double A_moment_first_by_e_y = slopes_A[2][1];
    const double A_moment_first_by_de_x = slopes_A[2][2];
    const double A_moment_first_by_de_y = slopes_A[2][3];
    const double A_moment_first_by_omega_i = slopes_A[2][4];
    const double A_moment_first_by_omega_j = slopes_A[2][5];
    const double A_moment_first_by_L1_theta = A_moment_first_by_de_x*L1_omega*arm_L1_head_x +
        A_moment_first_by_de_y*L1_omega*arm_L1_head_y + A_moment_first_by_e_x*arm_L1_head_y -
        A_moment_first_by_e_y*arm_L1_head_x;
    const double A_moment_first_by_L2_theta = A_moment_first_by_de_x*L2_omega*arm_L2_head_x +
        A_moment_first_by_de_y*L2_omega*arm_L2_head_y + A_moment_first_by_e_x*arm_L2_head_y -
        A_moment_first_by_e_y*arm_L2_head_x;
    const double A_moment_first_by_L1_omega = A_moment_first_by_de_x*arm_L1_head_y -
        A_moment_first_by_de_y*arm_L1_head_x + A_moment_first_by_omega_i;
    const double A_moment_first_by_L2_omega = A_moment_first_by_de_x*arm_L2_head_y -
        A_moment_first_by_de_y*arm_L2_head_x + A_moment_first_by_omega_j;
    const double A_moment_second_by_e_x = slopes_A[3][0];
    const double A_moment_second_by_e_y = slopes_A[3][1];
    const double A_moment_second_by_de_x = slopes_A[3][2];
    const double A_moment_second_by_de_y = slopes_A[3][3];
    const double A_moment_second_by_omega_i = slopes_A[3][4];
    const double A_moment_second_by_omega_j = slopes_A[3][5];
    const double A_moment_second_by_L1_theta = A_moment_second_by_de_x*L1_omega*arm_L1_head_x +
        A_moment_second_by_de_y*L1_omega*arm_L1_head_y + A_moment_second_by_e_x*arm_L1_head_y -
        A_moment_second_by_e_y*arm_L1_head_x;
    const double A_moment_second_by_L2_theta = A_moment_second_by_de_x*L2_omega*arm_L2_head_x +
        A_moment_second_by_de_y*L2_omega*arm_L2_head_y + A_moment_second_by_e_x*arm_L2_head_y -
        A_moment_second_by_e_y*arm_L2_head_x;
    const double A_moment_second_by_L1_omega = A_moment_second_by_de_x*arm_L1_head_y -
        A_moment_second_by_de_y*arm_L1_head_x + A_moment_second_by_omega_i;
    const double A_moment_second_by_L2_omega = A_moment_second_by_de_x*arm_L2_head_y -
        A_moment_second_by_de_y*arm_L2_head_x + A_moment_second_by_omega_j;

    /* clearance joint B */
    const double e_B_x_2 = L3_x - L4_x - arm_L3_head_x - arm_L4_head_x;
    const double e_B_y_2 = L3_y - L4_y - arm_L3_head_y - arm_L4_head_y;
    const double edot_B_x_2 = L3_omega*arm_L3_head_y + L3_vx + L4_omega*arm_L4_head_y - L4_vx;
    const double edot_B_y_2 = -L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy;
    double slopes_B[4][6];
    tangent_B(e_B_x_2, e_B_y_2, edot_B_x_2, edot_B_y_2, L4_omega, L3_omega, &memory->latch[1], p, side, g, slopes_B);
    const double B_Fx_by_e_x = slopes_B[0][0];
    const double B_Fx_by_e_y = slopes_B[0][1];
    const double B_Fx_by_de_x = slopes_B[0][2];
    const double B_Fx_by_de_y = slopes_B[0][3];
    const double B_Fx_by_omega_i = slopes_B[0][4];
    const double B_Fx_by_omega_j = slopes_B[0][5];
    const double B_Fx_by_L3_theta = B_Fx_by_de_x*L3_omega*arm_L3_head_x + B_Fx_by_de_y*L3_omega*arm_L3_head_y
        + B_Fx_by_e_x*arm_L3_head_y - B_Fx_by_e_y*arm_L3_head_x;
    const double B_Fx_by_L4_theta = B_Fx_by_de_x*L4_omega*arm_L4_head_x + B_Fx_by_de_y*L4_omega*arm_L4_head_y
        + B_Fx_by_e_x*arm_L4_head_y - B_Fx_by_e_y*arm_L4_head_x;
    const double B_Fx_by_L3_omega = B_Fx_by_de_x*arm_L3_head_y - B_Fx_by_de_y*arm_L3_head_x + B_Fx_by_omega_j;
    const double B_Fx_by_L4_omega = B_Fx_by_de_x*arm_L4_head_y - B_Fx_by_de_y*arm_L4_head_x + B_Fx_by_omega_i;
    const double B_Fy_by_e_x = slopes_B[1][0];
    const double B_Fy_by_e_y = slopes_B[1][1];
    const double B_Fy_by_de_x = slopes_B[1][2];
    const double B_Fy_by_de_y = slopes_B[1][3];
    const double B_Fy_by_omega_i = slopes_B[1][4];
    const double B_Fy_by_omega_j = slopes_B[1][5];
    const double B_Fy_by_L3_theta = B_Fy_by_de_x*L3_omega*arm_L3_head_x + B_Fy_by_de_y*L3_omega*arm_L3_head_y
        + B_Fy_by_e_x*arm_L3_head_y - B_Fy_by_e_y*arm_L3_head_x;
    const double B_Fy_by_L4_theta = B_Fy_by_de_x*L4_omega*arm_L4_head_x + B_Fy_by_de_y*L4_omega*arm_L4_head_y
        + B_Fy_by_e_x*arm_L4_head_y - B_Fy_by_e_y*arm_L4_head_x;
    const double B_Fy_by_L3_omega = B_Fy_by_de_x*arm_L3_head_y - B_Fy_by_de_y*arm_L3_head_x + B_Fy_by_omega_j;
    const double B_Fy_by_L4_omega = B_Fy_by_de_x*arm_L4_head_y - B_Fy_by_de_y*arm_L4_head_x + B_Fy_by_omega_i;
    const double B_moment_first_by_e_x = slopes_B[2][0];
    const double B_moment_first_by_e_y = slopes_B[2][1];
    const double B_moment_first_by_de_x = slopes_B[2][2];
    const double B_moment_first_by_de_y = slopes_B[2][3];
    const double B_moment_first_by_omega_i = slopes_B[2][4];
    const double B_moment_first_by_omega_j = slopes_B[2][5];
    const double B_moment_first_by_L3_theta = B_moment_first_by_de_x*L3_omega*arm_L3_head_x +
        B_moment_first_by_de_y*L3_omega*arm_L3_head_y + B_moment_first_by_e_x*arm_L3_head_y -
        B_moment_first_by_e_y*arm_L3_head_x;
    const double B_moment_first_by_L4_theta = B_moment_first_by_de_x*L4_omega*arm_L4_head_x +
        B_moment_first_by_de_y*L4_omega*arm_L4_head_y + B_moment_first_by_e_x*arm_L4_head_y -
        B_moment_first_by_e_y*arm_L4_head_x;
    const double B_moment_first_by_L3_omega = B_moment_first_by_de_x*arm_L3_head_y -
        B_moment_first_by_de_y*arm_L3_head_x + B_moment_first_by_omega_j;
    const double B_moment_first_by_L4_omega = B_moment_first_by_de_x*arm_L4_head_y -
        B_moment_first_by_de_y*arm_L4_head_x + B_moment_first_by_omega_i;
    const double B_moment_second_by_e_x = slopes_B[3][0];
    const double B_moment_second_by_e_y = slopes_B[3][1];
    const double B_moment_second_by_de_x = slopes_B[3][2];
    const double B_moment_second_by_de_y = slopes_B[3][3];
    const double B_moment_second_by_omega_i = slopes_B[3][4];
    const double B_moment_second_by_omega_j = slopes_B[3][5];
    const double B_moment_second_by_L3_theta = B_moment_second_by_de_x*L3_omega*arm_L3_head_x +
        B_moment_second_by_de_y*L3_omega*arm_L3_head_y + B_moment_second_by_e_x*arm_L3_head_y -
        B_moment_second_by_e_y*arm_L3_head_x;
    const double B_moment_second_by_L4_theta = B_moment_second_by_de_x*L4_omega*arm_L4_head_x +
        B_moment_second_by_de_y*L4_omega*arm_L4_head_y + B_moment_second_by_e_x*arm_L4_head_y -
        B_moment_second_by_e_y*arm_L4_head_x;
    const double B_moment_second_by_L3_omega = B_moment_second_by_de_x*arm_L3_head_y -
        B_moment_second_by_de_y*arm_L3_head_x + B_moment_second_by_omega_j;
    const double B_moment_second_by_L4_omega = B_moment_second_by_de_x*arm_L4_head_y -
        B_moment_second_by_de_y*arm_L4_head_x + B_moment_second_by_omega_i;

    /* results */
    lin->value[0] = -arm_L1_head_y;
    lin->value[1] = arm_L1_head_x;
    lin->value[2] = -arm_L4_head_y;
    lin->value[3] = arm_L4_head_x;
    lin->value[4] = -arm_L2_head_y;
    lin->value[5] = -arm_L7_head_y;
    lin->value[6] = arm_L2_head_x;
    lin->value[7] = arm_L7_head_x;
    lin->value[8] = -arm_L3_head_y;
    lin->value[9] = arm_L3_head_x;
    lin->value[10] = arm_L6_head_y;
    lin->value[11] = -arm_L6_head_x;
    lin->value[12] = -arm_L8_head_y;
    lin->value[13] = arm_L8_head_x;
    lin->value[14] = (L1_omega * L1_omega)*arm_L1_head_y - L1_omega*arm_L1_head_x*two_alpha -
        acceleration_L1_theta_2*arm_L1_head_x;
    lin->value[15] = -(L1_omega * L1_omega)*arm_L1_head_x - L1_omega*arm_L1_head_y*two_alpha -
        acceleration_L1_theta_2*arm_L1_head_y;
    lin->value[16] = (L4_omega * L4_omega)*arm_L4_head_y - L4_omega*arm_L4_head_x*two_alpha -
        acceleration_L4_theta_2*arm_L4_head_x;
    lin->value[17] = -(L4_omega * L4_omega)*arm_L4_head_x - L4_omega*arm_L4_head_y*two_alpha -
        acceleration_L4_theta_2*arm_L4_head_y;
    lin->value[18] = (L2_omega * L2_omega)*arm_L2_head_y - L2_omega*arm_L2_head_x*two_alpha -
        acceleration_L2_theta_2*arm_L2_head_x;
    lin->value[19] = (L7_omega * L7_omega)*arm_L7_head_y - L7_omega*arm_L7_head_x*two_alpha -
        acceleration_L7_theta_2*arm_L7_head_x;
    lin->value[20] = -(L2_omega * L2_omega)*arm_L2_head_x - L2_omega*arm_L2_head_y*two_alpha -
        acceleration_L2_theta_2*arm_L2_head_y;
    lin->value[21] = -(L7_omega * L7_omega)*arm_L7_head_x - L7_omega*arm_L7_head_y*two_alpha -
        acceleration_L7_theta_2*arm_L7_head_y;
    lin->value[22] = (L3_omega * L3_omega)*arm_L3_head_y - L3_omega*arm_L3_head_x*two_alpha -
        acceleration_L3_theta_2*arm_L3_head_x;
    lin->value[23] = -(L3_omega * L3_omega)*arm_L3_head_x - L3_omega*arm_L3_head_y*two_alpha -
        acceleration_L3_theta_2*arm_L3_head_y;
    lin->value[24] = -(L6_omega * L6_omega)*arm_L6_head_y + L6_omega*arm_L6_head_x*two_alpha +
        acceleration_L6_theta_2*arm_L6_head_x;
    lin->value[25] = (L6_omega * L6_omega)*arm_L6_head_x + L6_omega*arm_L6_head_y*two_alpha +
        acceleration_L6_theta_2*arm_L6_head_y;
    lin->value[26] = (L8_omega * L8_omega)*arm_L8_head_y - L8_omega*arm_L8_head_x*two_alpha -
        acceleration_L8_theta_2*arm_L8_head_x;
    lin->value[27] = -(L8_omega * L8_omega)*arm_L8_head_x - L8_omega*arm_L8_head_y*two_alpha -
        acceleration_L8_theta_2*arm_L8_head_y;
    lin->value[28] = -A_Fx_by_e_x;
    lin->value[29] = A_Fx_by_L1_theta;
    lin->value[30] = A_Fx_by_L2_theta;
    lin->value[31] = -A_Fx_by_e_y;
    lin->value[32] = -A_Fy_by_e_x;
    lin->value[33] = A_Fy_by_L1_theta;
    lin->value[34] = A_Fy_by_L2_theta;
    lin->value[35] = -A_Fy_by_e_y;
    lin->value[36] = A_Fx_by_e_x*arm_L1_head_y - A_Fy_by_e_x*arm_L1_head_x + A_moment_first_by_e_x;
    lin->value[37] = -A_Fx_by_L1_theta*arm_L1_head_y + A_Fy_by_L1_theta*arm_L1_head_x -
        A_moment_first_by_L1_theta + arm_L1_head_x*(-A_Fx - multiplier_O1_x_2) - arm_L1_head_y*(A_Fy +
        multiplier_O1_y_2);
    lin->value[38] = -A_Fx_by_L2_theta*arm_L1_head_y + A_Fy_by_L2_theta*arm_L1_head_x -
        A_moment_first_by_L2_theta;
    lin->value[39] = A_Fx_by_e_y*arm_L1_head_y - A_Fy_by_e_y*arm_L1_head_x + A_moment_first_by_e_y;
    lin->value[40] = A_Fx_by_e_x*arm_L2_head_y - A_Fy_by_e_x*arm_L2_head_x + A_moment_second_by_e_x;
    lin->value[41] = -A_Fx_by_L1_theta*arm_L2_head_y + A_Fy_by_L1_theta*arm_L2_head_x -
        A_moment_second_by_L1_theta;
    lin->value[42] = -A_Fx_by_L2_theta*arm_L2_head_y + A_Fy_by_L2_theta*arm_L2_head_x -
        A_moment_second_by_L2_theta + arm_L2_head_x*(-A_Fx - multiplier_P2_x_2) - arm_L2_head_y*(A_Fy +
        multiplier_P2_y_2);
    lin->value[43] = A_Fx_by_e_y*arm_L2_head_y - A_Fy_by_e_y*arm_L2_head_x + A_moment_second_by_e_y;
    lin->value[44] = -B_Fx_by_e_x;
    lin->value[45] = -B_Fx_by_L3_theta;
    lin->value[46] = -B_Fx_by_L4_theta;
    lin->value[47] = -B_Fx_by_e_y;
    lin->value[48] = -B_Fy_by_e_x;
    lin->value[49] = -B_Fy_by_L3_theta;
    lin->value[50] = -B_Fy_by_L4_theta;
    lin->value[51] = -B_Fy_by_e_y;
    lin->value[52] = -B_Fx_by_e_x*arm_L3_head_y + B_Fy_by_e_x*arm_L3_head_x - B_moment_second_by_e_x;
    lin->value[53] = -B_Fx_by_L3_theta*arm_L3_head_y + B_Fy_by_L3_theta*arm_L3_head_x -
        B_moment_second_by_L3_theta + arm_L3_head_x*(-B_Fx - multiplier_P3_x_2) - arm_L3_head_y*(B_Fy +
        multiplier_P3_y_2);
    lin->value[54] = -B_Fx_by_L4_theta*arm_L3_head_y + B_Fy_by_L4_theta*arm_L3_head_x -
        B_moment_second_by_L4_theta;
    lin->value[55] = -B_Fx_by_e_y*arm_L3_head_y + B_Fy_by_e_y*arm_L3_head_x - B_moment_second_by_e_y;
    lin->value[56] = -B_Fx_by_e_x*arm_L4_head_y + B_Fy_by_e_x*arm_L4_head_x - B_moment_first_by_e_x;
    lin->value[57] = -B_Fx_by_L3_theta*arm_L4_head_y + B_Fy_by_L3_theta*arm_L4_head_x -
        B_moment_first_by_L3_theta;
    lin->value[58] = -B_Fx_by_L4_theta*arm_L4_head_y + B_Fy_by_L4_theta*arm_L4_head_x -
        B_moment_first_by_L4_theta + arm_L4_head_x*(-B_Fx - multiplier_O4_x_2) - arm_L4_head_y*(B_Fy +
        multiplier_O4_y_2);
    lin->value[59] = -B_Fx_by_e_y*arm_L4_head_y + B_Fy_by_e_y*arm_L4_head_x - B_moment_first_by_e_y;
    lin->value[60] = arm_L6_head_x*(-multiplier_O6_x_2 + multiplier_Q6_x_2) - arm_L6_head_y*(multiplier_O6_y_2
        - multiplier_Q6_y_2);
    lin->value[61] = arm_L7_head_x*(-multiplier_P2_x_2 - multiplier_P3_x_2 - multiplier_Q6_x_2 -
        multiplier_Q8_x_2) - arm_L7_head_y*(multiplier_P2_y_2 + multiplier_P3_y_2 + multiplier_Q6_y_2 +
        multiplier_Q8_y_2);
    lin->value[62] = arm_L8_head_x*(-multiplier_Q8_x_2 - multiplier_slider_x_2) -
        arm_L8_head_y*(multiplier_Q8_y_2 + multiplier_slider_y_2);
    lin->value[63] = -2.0*L1_omega*arm_L1_head_x;
    lin->value[64] = -2.0*L1_omega*arm_L1_head_y;
    lin->value[65] = -2.0*L4_omega*arm_L4_head_x;
    lin->value[66] = -2.0*L4_omega*arm_L4_head_y;
    lin->value[67] = -2.0*L2_omega*arm_L2_head_x;
    lin->value[68] = -2.0*L7_omega*arm_L7_head_x;
    lin->value[69] = -2.0*L2_omega*arm_L2_head_y;
    lin->value[70] = -2.0*L7_omega*arm_L7_head_y;
    lin->value[71] = -2.0*L3_omega*arm_L3_head_x;
    lin->value[72] = -2.0*L3_omega*arm_L3_head_y;
    lin->value[73] = 2.0*L6_omega*arm_L6_head_x;
    lin->value[74] = 2.0*L6_omega*arm_L6_head_y;
    lin->value[75] = -2.0*L8_omega*arm_L8_head_x;
    lin->value[76] = -2.0*L8_omega*arm_L8_head_y;
    lin->value[77] = A_Fx_by_L1_omega;
    lin->value[78] = -A_Fx_by_de_x;
    lin->value[79] = A_Fx_by_L2_omega;
    lin->value[80] = -A_Fx_by_de_y;
    lin->value[81] = A_Fy_by_L1_omega;
    lin->value[82] = -A_Fy_by_de_x;
    lin->value[83] = A_Fy_by_L2_omega;
    lin->value[84] = -A_Fy_by_de_y;
    lin->value[85] = -A_Fx_by_L1_omega*arm_L1_head_y + A_Fy_by_L1_omega*arm_L1_head_x -
        A_moment_first_by_L1_omega;
    lin->value[86] = A_Fx_by_de_x*arm_L1_head_y - A_Fy_by_de_x*arm_L1_head_x + A_moment_first_by_de_x;
    lin->value[87] = -A_Fx_by_L2_omega*arm_L1_head_y + A_Fy_by_L2_omega*arm_L1_head_x -
        A_moment_first_by_L2_omega;
    lin->value[88] = A_Fx_by_de_y*arm_L1_head_y - A_Fy_by_de_y*arm_L1_head_x + A_moment_first_by_de_y;
    lin->value[89] = -A_Fx_by_L1_omega*arm_L2_head_y + A_Fy_by_L1_omega*arm_L2_head_x -
        A_moment_second_by_L1_omega;
    lin->value[90] = A_Fx_by_de_x*arm_L2_head_y - A_Fy_by_de_x*arm_L2_head_x + A_moment_second_by_de_x;
    lin->value[91] = -A_Fx_by_L2_omega*arm_L2_head_y + A_Fy_by_L2_omega*arm_L2_head_x -
        A_moment_second_by_L2_omega;
    lin->value[92] = A_Fx_by_de_y*arm_L2_head_y - A_Fy_by_de_y*arm_L2_head_x + A_moment_second_by_de_y;
    lin->value[93] = -B_Fx_by_L3_omega;
    lin->value[94] = -B_Fx_by_de_x;
    lin->value[95] = -B_Fx_by_L4_omega;
    lin->value[96] = -B_Fx_by_de_y;
    lin->value[97] = -B_Fy_by_L3_omega;
    lin->value[98] = -B_Fy_by_de_x;
    lin->value[99] = -B_Fy_by_L4_omega;
    lin->value[100] = -B_Fy_by_de_y;
    lin->value[101] = -B_Fx_by_L3_omega*arm_L3_head_y + B_Fy_by_L3_omega*arm_L3_head_x -
        B_moment_second_by_L3_omega;
    lin->value[102] = -B_Fx_by_de_x*arm_L3_head_y + B_Fy_by_de_x*arm_L3_head_x - B_moment_second_by_de_x;
    lin->value[103] = -B_Fx_by_L4_omega*arm_L3_head_y + B_Fy_by_L4_omega*arm_L3_head_x -
        B_moment_second_by_L4_omega;
    lin->value[104] = -B_Fx_by_de_y*arm_L3_head_y + B_Fy_by_de_y*arm_L3_head_x - B_moment_second_by_de_y;
    lin->value[105] = -B_Fx_by_L3_omega*arm_L4_head_y + B_Fy_by_L3_omega*arm_L4_head_x -
        B_moment_first_by_L3_omega;
    lin->value[106] = -B_Fx_by_de_x*arm_L4_head_y + B_Fy_by_de_x*arm_L4_head_x - B_moment_first_by_de_x;
    lin->value[107] = -B_Fx_by_L4_omega*arm_L4_head_y + B_Fy_by_L4_omega*arm_L4_head_x -
        B_moment_first_by_L4_omega;
    lin->value[108] = -B_Fx_by_de_y*arm_L4_head_y + B_Fy_by_de_y*arm_L4_head_x - B_moment_first_by_de_y;
    lin->value[109] = -beta_squared*crank1_rate - crank1_acceleration*two_alpha;
    lin->value[110] = -beta_squared*crank4_rate - crank4_acceleration*two_alpha;
    lin->value[111] = -A_Fx_by_e_x*(L1_omega*arm_L1_head_y - L1_vx + L2_omega*arm_L2_head_y + L2_vx) -
        A_Fy_by_e_x*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) -
        A_moment_first_by_e_x*L1_omega - A_moment_second_by_e_x*L2_omega;
    lin->value[112] = A_Fx*L1_omega*arm_L1_head_x + A_Fx_by_L1_theta*(L1_omega*arm_L1_head_y - L1_vx +
        L2_omega*arm_L2_head_y + L2_vx) + A_Fy*L1_omega*arm_L1_head_y +
        A_Fy_by_L1_theta*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) +
        A_moment_first_by_L1_theta*L1_omega + A_moment_second_by_L1_theta*L2_omega;
    lin->value[113] = A_Fx*L2_omega*arm_L2_head_x + A_Fx_by_L2_theta*(L1_omega*arm_L1_head_y - L1_vx +
        L2_omega*arm_L2_head_y + L2_vx) + A_Fy*L2_omega*arm_L2_head_y +
        A_Fy_by_L2_theta*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) +
        A_moment_first_by_L2_theta*L1_omega + A_moment_second_by_L2_theta*L2_omega;
    lin->value[114] = -A_Fx_by_e_y*(L1_omega*arm_L1_head_y - L1_vx + L2_omega*arm_L2_head_y + L2_vx) -
        A_Fy_by_e_y*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) -
        A_moment_first_by_e_y*L1_omega - A_moment_second_by_e_y*L2_omega;
    lin->value[115] = B_Fx_by_e_x*(L3_omega*arm_L3_head_y + L3_vx + L4_omega*arm_L4_head_y - L4_vx) +
        B_Fy_by_e_x*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_e_x*L4_omega + B_moment_second_by_e_x*L3_omega;
    lin->value[116] = B_Fx*L3_omega*arm_L3_head_x + B_Fx_by_L3_theta*(L3_omega*arm_L3_head_y + L3_vx +
        L4_omega*arm_L4_head_y - L4_vx) + B_Fy*L3_omega*arm_L3_head_y +
        B_Fy_by_L3_theta*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_L3_theta*L4_omega + B_moment_second_by_L3_theta*L3_omega;
    lin->value[117] = B_Fx*L4_omega*arm_L4_head_x + B_Fx_by_L4_theta*(L3_omega*arm_L3_head_y + L3_vx +
        L4_omega*arm_L4_head_y - L4_vx) + B_Fy*L4_omega*arm_L4_head_y +
        B_Fy_by_L4_theta*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_L4_theta*L4_omega + B_moment_second_by_L4_theta*L3_omega;
    lin->value[118] = B_Fx_by_e_y*(L3_omega*arm_L3_head_y + L3_vx + L4_omega*arm_L4_head_y - L4_vx) +
        B_Fy_by_e_y*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_e_y*L4_omega + B_moment_second_by_e_y*L3_omega;
    lin->value[119] = A_Fx*arm_L1_head_y + A_Fx_by_L1_omega*(L1_omega*arm_L1_head_y - L1_vx +
        L2_omega*arm_L2_head_y + L2_vx) - A_Fy*arm_L1_head_x + A_Fy_by_L1_omega*(-L1_omega*arm_L1_head_x -
        L1_vy - L2_omega*arm_L2_head_x + L2_vy) + A_moment_first + A_moment_first_by_L1_omega*L1_omega +
        A_moment_second_by_L1_omega*L2_omega;
    lin->value[120] = -A_Fx - A_Fx_by_de_x*(L1_omega*arm_L1_head_y - L1_vx + L2_omega*arm_L2_head_y + L2_vx) -
        A_Fy_by_de_x*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) -
        A_moment_first_by_de_x*L1_omega - A_moment_second_by_de_x*L2_omega;
    lin->value[121] = A_Fx*arm_L2_head_y + A_Fx_by_L2_omega*(L1_omega*arm_L1_head_y - L1_vx +
        L2_omega*arm_L2_head_y + L2_vx) - A_Fy*arm_L2_head_x + A_Fy_by_L2_omega*(-L1_omega*arm_L1_head_x -
        L1_vy - L2_omega*arm_L2_head_x + L2_vy) + A_moment_first_by_L2_omega*L1_omega + A_moment_second +
        A_moment_second_by_L2_omega*L2_omega;
    lin->value[122] = -A_Fx_by_de_y*(L1_omega*arm_L1_head_y - L1_vx + L2_omega*arm_L2_head_y + L2_vx) - A_Fy -
        A_Fy_by_de_y*(-L1_omega*arm_L1_head_x - L1_vy - L2_omega*arm_L2_head_x + L2_vy) -
        A_moment_first_by_de_y*L1_omega - A_moment_second_by_de_y*L2_omega;
    lin->value[123] = B_Fx*arm_L3_head_y + B_Fx_by_L3_omega*(L3_omega*arm_L3_head_y + L3_vx +
        L4_omega*arm_L4_head_y - L4_vx) - B_Fy*arm_L3_head_x + B_Fy_by_L3_omega*(-L3_omega*arm_L3_head_x +
        L3_vy - L4_omega*arm_L4_head_x - L4_vy) + B_moment_first_by_L3_omega*L4_omega + B_moment_second +
        B_moment_second_by_L3_omega*L3_omega;
    lin->value[124] = B_Fx + B_Fx_by_de_x*(L3_omega*arm_L3_head_y + L3_vx + L4_omega*arm_L4_head_y - L4_vx) +
        B_Fy_by_de_x*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_de_x*L4_omega + B_moment_second_by_de_x*L3_omega;
    lin->value[125] = B_Fx*arm_L4_head_y + B_Fx_by_L4_omega*(L3_omega*arm_L3_head_y + L3_vx +
        L4_omega*arm_L4_head_y - L4_vx) - B_Fy*arm_L4_head_x + B_Fy_by_L4_omega*(-L3_omega*arm_L3_head_x +
        L3_vy - L4_omega*arm_L4_head_x - L4_vy) + B_moment_first + B_moment_first_by_L4_omega*L4_omega +
        B_moment_second_by_L4_omega*L3_omega;
    lin->value[126] = B_Fx_by_de_y*(L3_omega*arm_L3_head_y + L3_vx + L4_omega*arm_L4_head_y - L4_vx) + B_Fy +
        B_Fy_by_de_y*(-L3_omega*arm_L3_head_x + L3_vy - L4_omega*arm_L4_head_x - L4_vy) +
        B_moment_first_by_de_y*L4_omega + B_moment_second_by_de_y*L3_omega;
    lin->value[127] = -crank1_rate;
    lin->value[128] = -crank4_rate;
    lin->value[129] = -crank1_acceleration*multiplier_crank1_2 - crank4_acceleration*multiplier_crank4_2;
    lin->value[130] = -1.0;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static int newton_factor(double eta, Linear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O1_x_L1_theta = lin->value[0];
    const double phi_O1_y_L1_theta = lin->value[1];
    const double phi_O4_x_L4_theta = lin->value[2];
    const double phi_O4_y_L4_theta = lin->value[3];
    const double phi_P2_x_L2_theta = lin->value[4];
    const double phi_P2_x_L7_theta = lin->value[5];
    const double phi_P2_y_L2_theta = lin->value[6];
    const double phi_P2_y_L7_theta = lin->value[7];
    const double phi_P3_x_L3_theta = lin->value[8];
    const double phi_P3_y_L3_theta = lin->value[9];
    const double phi_Q6_x_L6_theta = lin->value[10];
    const double phi_Q6_y_L6_theta = lin->value[11];
    const double phi_Q8_x_L8_theta = lin->value[12];
    const double phi_Q8_y_L8_theta = lin->value[13];
    const double by_q_O1_x_L1_theta = lin->value[14];
    const double by_q_O1_y_L1_theta = lin->value[15];
    const double by_q_O4_x_L4_theta = lin->value[16];
    const double by_q_O4_y_L4_theta = lin->value[17];
    const double by_q_P2_x_L2_theta = lin->value[18];
    const double by_q_P2_x_L7_theta = lin->value[19];
    const double by_q_P2_y_L2_theta = lin->value[20];
    const double by_q_P2_y_L7_theta = lin->value[21];
    const double by_q_P3_x_L3_theta = lin->value[22];
    const double by_q_P3_y_L3_theta = lin->value[23];
    const double by_q_Q6_x_L6_theta = lin->value[24];
    const double by_q_Q6_y_L6_theta = lin->value[25];
    const double by_q_Q8_x_L8_theta = lin->value[26];
    const double by_q_Q8_y_L8_theta = lin->value[27];
    const double by_q_L1_x_L1_x = lin->value[28];
    const double by_q_L1_x_L1_theta = lin->value[29];
    const double by_q_L1_x_L2_theta = lin->value[30];
    const double by_q_L1_x_L1_y = lin->value[31];
    const double by_q_L1_y_L1_x = lin->value[32];
    const double by_q_L1_y_L1_theta = lin->value[33];
    const double by_q_L1_y_L2_theta = lin->value[34];
    const double by_q_L1_y_L1_y = lin->value[35];
    const double by_q_L1_theta_L1_x = lin->value[36];
    const double by_q_L1_theta_L1_theta = lin->value[37];
    const double by_q_L1_theta_L2_theta = lin->value[38];
    const double by_q_L1_theta_L1_y = lin->value[39];
    const double by_q_L2_theta_L1_x = lin->value[40];
    const double by_q_L2_theta_L1_theta = lin->value[41];
    const double by_q_L2_theta_L2_theta = lin->value[42];
    const double by_q_L2_theta_L1_y = lin->value[43];
    const double by_q_L3_x_L3_x = lin->value[44];
    const double by_q_L3_x_L3_theta = lin->value[45];
    const double by_q_L3_x_L4_theta = lin->value[46];
    const double by_q_L3_x_L3_y = lin->value[47];
    const double by_q_L3_y_L3_x = lin->value[48];
    const double by_q_L3_y_L3_theta = lin->value[49];
    const double by_q_L3_y_L4_theta = lin->value[50];
    const double by_q_L3_y_L3_y = lin->value[51];
    const double by_q_L3_theta_L3_x = lin->value[52];
    const double by_q_L3_theta_L3_theta = lin->value[53];
    const double by_q_L3_theta_L4_theta = lin->value[54];
    const double by_q_L3_theta_L3_y = lin->value[55];
    const double by_q_L4_theta_L3_x = lin->value[56];
    const double by_q_L4_theta_L3_theta = lin->value[57];
    const double by_q_L4_theta_L4_theta = lin->value[58];
    const double by_q_L4_theta_L3_y = lin->value[59];
    const double by_q_L6_theta_L6_theta = lin->value[60];
    const double by_q_L7_theta_L7_theta = lin->value[61];
    const double by_q_L8_theta_L8_theta = lin->value[62];
    const double by_v_O1_x_L1_theta = lin->value[63];
    const double by_v_O1_y_L1_theta = lin->value[64];
    const double by_v_O4_x_L4_theta = lin->value[65];
    const double by_v_O4_y_L4_theta = lin->value[66];
    const double by_v_P2_x_L2_theta = lin->value[67];
    const double by_v_P2_x_L7_theta = lin->value[68];
    const double by_v_P2_y_L2_theta = lin->value[69];
    const double by_v_P2_y_L7_theta = lin->value[70];
    const double by_v_P3_x_L3_theta = lin->value[71];
    const double by_v_P3_y_L3_theta = lin->value[72];
    const double by_v_Q6_x_L6_theta = lin->value[73];
    const double by_v_Q6_y_L6_theta = lin->value[74];
    const double by_v_Q8_x_L8_theta = lin->value[75];
    const double by_v_Q8_y_L8_theta = lin->value[76];
    const double by_v_L1_x_L1_theta = lin->value[77];
    const double by_v_L1_x_L1_x = lin->value[78];
    const double by_v_L1_x_L2_theta = lin->value[79];
    const double by_v_L1_x_L1_y = lin->value[80];
    const double by_v_L1_y_L1_theta = lin->value[81];
    const double by_v_L1_y_L1_x = lin->value[82];
    const double by_v_L1_y_L2_theta = lin->value[83];
    const double by_v_L1_y_L1_y = lin->value[84];
    const double by_v_L1_theta_L1_theta = lin->value[85];
    const double by_v_L1_theta_L1_x = lin->value[86];
    const double by_v_L1_theta_L2_theta = lin->value[87];
    const double by_v_L1_theta_L1_y = lin->value[88];
    const double by_v_L2_theta_L1_theta = lin->value[89];
    const double by_v_L2_theta_L1_x = lin->value[90];
    const double by_v_L2_theta_L2_theta = lin->value[91];
    const double by_v_L2_theta_L1_y = lin->value[92];
    const double by_v_L3_x_L3_theta = lin->value[93];
    const double by_v_L3_x_L3_x = lin->value[94];
    const double by_v_L3_x_L4_theta = lin->value[95];
    const double by_v_L3_x_L3_y = lin->value[96];
    const double by_v_L3_y_L3_theta = lin->value[97];
    const double by_v_L3_y_L3_x = lin->value[98];
    const double by_v_L3_y_L4_theta = lin->value[99];
    const double by_v_L3_y_L3_y = lin->value[100];
    const double by_v_L3_theta_L3_theta = lin->value[101];
    const double by_v_L3_theta_L3_x = lin->value[102];
    const double by_v_L3_theta_L4_theta = lin->value[103];
    const double by_v_L3_theta_L3_y = lin->value[104];
    const double by_v_L4_theta_L3_theta = lin->value[105];
    const double by_v_L4_theta_L3_x = lin->value[106];
    const double by_v_L4_theta_L4_theta = lin->value[107];
    const double by_v_L4_theta_L3_y = lin->value[108];

    /* parameters */
    const double L1_mass = p->L1_mass;
    const double L1_inertia = p->L1_inertia;
    const double L2_mass = p->L2_mass;
    const double L2_inertia = p->L2_inertia;
    const double L3_mass = p->L3_mass;
    const double L3_inertia = p->L3_inertia;
    const double L4_mass = p->L4_mass;
    const double L4_inertia = p->L4_inertia;
    const double L6_inertia = p->L6_inertia;
    const double L7_inertia = p->L7_inertia;
    const double L8_inertia = p->L8_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double inverse_S9_mass = p->inverse_S9_mass;
    const double inverse_S9_inertia = p->inverse_S9_inertia;
    const double inverse_L6_mass = p->inverse_L6_mass;
    const double inverse_L8_mass = p->inverse_L8_mass;
    const double inverse_L7_mass = p->inverse_L7_mass;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_L1_x__L1_x = L1_mass + eta*(by_q_L1_x_L1_x*eta + by_v_L1_x_L1_x);
    const double n_L1_x__L1_y = eta*(by_q_L1_x_L1_y*eta + by_v_L1_x_L1_y);
    const double n_L1_x__L1_theta = eta*(by_q_L1_x_L1_theta*eta + by_v_L1_x_L1_theta);
    const double n_L1_x__L2_x = eta*(-by_q_L1_x_L1_x*eta - by_v_L1_x_L1_x);
    const double n_L1_x__L2_y = eta*(-by_q_L1_x_L1_y*eta - by_v_L1_x_L1_y);
    const double n_L1_x__L2_theta = eta*(by_q_L1_x_L2_theta*eta + by_v_L1_x_L2_theta);
    const double n_L1_y__L1_x = eta*(by_q_L1_y_L1_x*eta + by_v_L1_y_L1_x);
    const double n_L1_y__L1_y = L1_mass + eta*(by_q_L1_y_L1_y*eta + by_v_L1_y_L1_y);
    const double n_L1_y__L1_theta = eta*(by_q_L1_y_L1_theta*eta + by_v_L1_y_L1_theta);
    const double n_L1_y__L2_x = eta*(-by_q_L1_y_L1_x*eta - by_v_L1_y_L1_x);
    const double n_L1_y__L2_y = eta*(-by_q_L1_y_L1_y*eta - by_v_L1_y_L1_y);
    const double n_L1_y__L2_theta = eta*(by_q_L1_y_L2_theta*eta + by_v_L1_y_L2_theta);
    const double n_L1_theta__L1_x = eta*(by_q_L1_theta_L1_x*eta + by_v_L1_theta_L1_x);
    const double n_L1_theta__L1_y = eta*(by_q_L1_theta_L1_y*eta + by_v_L1_theta_L1_y);
    const double n_L1_theta__L1_theta = L1_inertia + eta*(by_q_L1_theta_L1_theta*eta +
        by_v_L1_theta_L1_theta);
    const double n_L1_theta__L2_x = eta*(-by_q_L1_theta_L1_x*eta - by_v_L1_theta_L1_x);
    const double n_L1_theta__L2_y = eta*(-by_q_L1_theta_L1_y*eta - by_v_L1_theta_L1_y);
    const double n_L1_theta__L2_theta = eta*(by_q_L1_theta_L2_theta*eta + by_v_L1_theta_L2_theta);
    const double n_L2_x__L1_x = eta*(-by_q_L1_x_L1_x*eta - by_v_L1_x_L1_x);
    const double n_L2_x__L1_y = eta*(-by_q_L1_x_L1_y*eta - by_v_L1_x_L1_y);
    const double n_L2_x__L1_theta = eta*(-by_q_L1_x_L1_theta*eta - by_v_L1_x_L1_theta);
    const double n_L2_x__L2_x = L2_mass + eta*(by_q_L1_x_L1_x*eta + by_v_L1_x_L1_x);
    const double n_L2_x__L2_y = eta*(by_q_L1_x_L1_y*eta + by_v_L1_x_L1_y);
    const double n_L2_x__L2_theta = eta*(-by_q_L1_x_L2_theta*eta - by_v_L1_x_L2_theta);
    const double n_L2_y__L1_x = eta*(-by_q_L1_y_L1_x*eta - by_v_L1_y_L1_x);
    const double n_L2_y__L1_y = eta*(-by_q_L1_y_L1_y*eta - by_v_L1_y_L1_y);
    const double n_L2_y__L1_theta = eta*(-by_q_L1_y_L1_theta*eta - by_v_L1_y_L1_theta);
    const double n_L2_y__L2_x = eta*(by_q_L1_y_L1_x*eta + by_v_L1_y_L1_x);
    const double n_L2_y__L2_y = L2_mass + eta*(by_q_L1_y_L1_y*eta + by_v_L1_y_L1_y);
    const double n_L2_y__L2_theta = eta*(-by_q_L1_y_L2_theta*eta - by_v_L1_y_L2_theta);
    const double n_L2_theta__L1_x = eta*(by_q_L2_theta_L1_x*eta + by_v_L2_theta_L1_x);
    const double n_L2_theta__L1_y = eta*(by_q_L2_theta_L1_y*eta + by_v_L2_theta_L1_y);
    const double n_L2_theta__L1_theta = eta*(by_q_L2_theta_L1_theta*eta + by_v_L2_theta_L1_theta);
    const double n_L2_theta__L2_x = eta*(-by_q_L2_theta_L1_x*eta - by_v_L2_theta_L1_x);
    const double n_L2_theta__L2_y = eta*(-by_q_L2_theta_L1_y*eta - by_v_L2_theta_L1_y);
    const double n_L2_theta__L2_theta = L2_inertia + eta*(by_q_L2_theta_L2_theta*eta +
        by_v_L2_theta_L2_theta);
    const double n_L3_x__L3_x = L3_mass + eta*(by_q_L3_x_L3_x*eta + by_v_L3_x_L3_x);
    const double n_L3_x__L3_y = eta*(by_q_L3_x_L3_y*eta + by_v_L3_x_L3_y);
    const double n_L3_x__L3_theta = eta*(by_q_L3_x_L3_theta*eta + by_v_L3_x_L3_theta);
    const double n_L3_x__L4_x = eta*(-by_q_L3_x_L3_x*eta - by_v_L3_x_L3_x);
    const double n_L3_x__L4_y = eta*(-by_q_L3_x_L3_y*eta - by_v_L3_x_L3_y);
    const double n_L3_x__L4_theta = eta*(by_q_L3_x_L4_theta*eta + by_v_L3_x_L4_theta);
    const double n_L3_y__L3_x = eta*(by_q_L3_y_L3_x*eta + by_v_L3_y_L3_x);
    const double n_L3_y__L3_y = L3_mass + eta*(by_q_L3_y_L3_y*eta + by_v_L3_y_L3_y);
    const double n_L3_y__L3_theta = eta*(by_q_L3_y_L3_theta*eta + by_v_L3_y_L3_theta);
    const double n_L3_y__L4_x = eta*(-by_q_L3_y_L3_x*eta - by_v_L3_y_L3_x);
    const double n_L3_y__L4_y = eta*(-by_q_L3_y_L3_y*eta - by_v_L3_y_L3_y);
    const double n_L3_y__L4_theta = eta*(by_q_L3_y_L4_theta*eta + by_v_L3_y_L4_theta);
    const double n_L3_theta__L3_x = eta*(by_q_L3_theta_L3_x*eta + by_v_L3_theta_L3_x);
    const double n_L3_theta__L3_y = eta*(by_q_L3_theta_L3_y*eta + by_v_L3_theta_L3_y);
    const double n_L3_theta__L3_theta = L3_inertia + eta*(by_q_L3_theta_L3_theta*eta +
        by_v_L3_theta_L3_theta);
    const double n_L3_theta__L4_x = eta*(-by_q_L3_theta_L3_x*eta - by_v_L3_theta_L3_x);
    const double n_L3_theta__L4_y = eta*(-by_q_L3_theta_L3_y*eta - by_v_L3_theta_L3_y);
    const double n_L3_theta__L4_theta = eta*(by_q_L3_theta_L4_theta*eta + by_v_L3_theta_L4_theta);
    const double n_L4_x__L3_x = eta*(-by_q_L3_x_L3_x*eta - by_v_L3_x_L3_x);
    const double n_L4_x__L3_y = eta*(-by_q_L3_x_L3_y*eta - by_v_L3_x_L3_y);
    const double n_L4_x__L3_theta = eta*(-by_q_L3_x_L3_theta*eta - by_v_L3_x_L3_theta);
    const double n_L4_x__L4_x = L4_mass + eta*(by_q_L3_x_L3_x*eta + by_v_L3_x_L3_x);
    const double n_L4_x__L4_y = eta*(by_q_L3_x_L3_y*eta + by_v_L3_x_L3_y);
    const double n_L4_x__L4_theta = eta*(-by_q_L3_x_L4_theta*eta - by_v_L3_x_L4_theta);
    const double n_L4_y__L3_x = eta*(-by_q_L3_y_L3_x*eta - by_v_L3_y_L3_x);
    const double n_L4_y__L3_y = eta*(-by_q_L3_y_L3_y*eta - by_v_L3_y_L3_y);
    const double n_L4_y__L3_theta = eta*(-by_q_L3_y_L3_theta*eta - by_v_L3_y_L3_theta);
    const double n_L4_y__L4_x = eta*(by_q_L3_y_L3_x*eta + by_v_L3_y_L3_x);
    const double n_L4_y__L4_y = L4_mass + eta*(by_q_L3_y_L3_y*eta + by_v_L3_y_L3_y);
    const double n_L4_y__L4_theta = eta*(-by_q_L3_y_L4_theta*eta - by_v_L3_y_L4_theta);
    const double n_L4_theta__L3_x = eta*(by_q_L4_theta_L3_x*eta + by_v_L4_theta_L3_x);
    const double n_L4_theta__L3_y = eta*(by_q_L4_theta_L3_y*eta + by_v_L4_theta_L3_y);
    const double n_L4_theta__L3_theta = eta*(by_q_L4_theta_L3_theta*eta + by_v_L4_theta_L3_theta);
    const double n_L4_theta__L4_x = eta*(-by_q_L4_theta_L3_x*eta - by_v_L4_theta_L3_x);
    const double n_L4_theta__L4_y = eta*(-by_q_L4_theta_L3_y*eta - by_v_L4_theta_L3_y);
    const double n_L4_theta__L4_theta = L4_inertia + eta*(by_q_L4_theta_L4_theta*eta +
        by_v_L4_theta_L4_theta);
    const double n_L6_theta__L6_theta = L6_inertia + by_q_L6_theta_L6_theta*(eta * eta);
    const double n_L7_theta__L7_theta = L7_inertia + by_q_L7_theta_L7_theta*(eta * eta);
    const double n_L8_theta__L8_theta = L8_inertia + by_q_L8_theta_L8_theta*(eta * eta);
    const double n_O1_x__L1_theta = eta_row*(by_q_O1_x_L1_theta*eta + by_v_O1_x_L1_theta) + phi_O1_x_L1_theta;
    const double n_O1_y__L1_theta = eta_row*(by_q_O1_y_L1_theta*eta + by_v_O1_y_L1_theta) + phi_O1_y_L1_theta;
    const double n_O4_x__L4_theta = eta_row*(by_q_O4_x_L4_theta*eta + by_v_O4_x_L4_theta) + phi_O4_x_L4_theta;
    const double n_O4_y__L4_theta = eta_row*(by_q_O4_y_L4_theta*eta + by_v_O4_y_L4_theta) + phi_O4_y_L4_theta;
    const double n_P2_x__L2_theta = eta_row*(by_q_P2_x_L2_theta*eta + by_v_P2_x_L2_theta) + phi_P2_x_L2_theta;
    const double n_P2_x__L7_theta = eta_row*(by_q_P2_x_L7_theta*eta + by_v_P2_x_L7_theta) + phi_P2_x_L7_theta;
    const double n_P2_y__L2_theta = eta_row*(by_q_P2_y_L2_theta*eta + by_v_P2_y_L2_theta) + phi_P2_y_L2_theta;
    const double n_P2_y__L7_theta = eta_row*(by_q_P2_y_L7_theta*eta + by_v_P2_y_L7_theta) + phi_P2_y_L7_theta;
    const double n_P3_x__L3_theta = eta_row*(by_q_P3_x_L3_theta*eta + by_v_P3_x_L3_theta) + phi_P3_x_L3_theta;
    const double n_P3_x__L7_theta = eta_row*(by_q_P2_x_L7_theta*eta + by_v_P2_x_L7_theta) + phi_P2_x_L7_theta;
    const double n_P3_y__L3_theta = eta_row*(by_q_P3_y_L3_theta*eta + by_v_P3_y_L3_theta) + phi_P3_y_L3_theta;
    const double n_P3_y__L7_theta = eta_row*(by_q_P2_y_L7_theta*eta + by_v_P2_y_L7_theta) + phi_P2_y_L7_theta;
    const double n_Q6_x__L6_theta = eta_row*(by_q_Q6_x_L6_theta*eta + by_v_Q6_x_L6_theta) + phi_Q6_x_L6_theta;
    const double n_Q6_x__L7_theta = eta_row*(by_q_P2_x_L7_theta*eta + by_v_P2_x_L7_theta) + phi_P2_x_L7_theta;
    const double n_Q6_y__L6_theta = eta_row*(by_q_Q6_y_L6_theta*eta + by_v_Q6_y_L6_theta) + phi_Q6_y_L6_theta;
    const double n_Q6_y__L7_theta = eta_row*(by_q_P2_y_L7_theta*eta + by_v_P2_y_L7_theta) + phi_P2_y_L7_theta;
    const double n_Q8_x__L7_theta = eta_row*(by_q_P2_x_L7_theta*eta + by_v_P2_x_L7_theta) + phi_P2_x_L7_theta;
    const double n_Q8_x__L8_theta = eta_row*(by_q_Q8_x_L8_theta*eta + by_v_Q8_x_L8_theta) + phi_Q8_x_L8_theta;
    const double n_Q8_y__L7_theta = eta_row*(by_q_P2_y_L7_theta*eta + by_v_P2_y_L7_theta) + phi_P2_y_L7_theta;
    const double n_Q8_y__L8_theta = eta_row*(by_q_Q8_y_L8_theta*eta + by_v_Q8_y_L8_theta) + phi_Q8_y_L8_theta;
    const double n_O6_x__L6_theta = eta_row*(-by_q_Q6_x_L6_theta*eta - by_v_Q6_x_L6_theta) -
        phi_Q6_x_L6_theta;
    const double n_O6_y__L6_theta = eta_row*(-by_q_Q6_y_L6_theta*eta - by_v_Q6_y_L6_theta) -
        phi_Q6_y_L6_theta;
    const double n_slider_x__L8_theta = eta_row*(by_q_Q8_x_L8_theta*eta + by_v_Q8_x_L8_theta) +
        phi_Q8_x_L8_theta;
    const double n_slider_y__L8_theta = eta_row*(by_q_Q8_y_L8_theta*eta + by_v_Q8_y_L8_theta) +
        phi_Q8_y_L8_theta;

    /* L U */
    const double scale_guide_angle_2 = -inverse_S9_inertia;
    if (!(fabs(scale_guide_angle_2) > 1e-08 * fabs(scale_guide_angle_2)))
        return 42;
    const double inverse_pivot_guide_angle_2 = 1.0/scale_guide_angle_2;
    lin->lu[0] = inverse_pivot_guide_angle_2;
    const double scale_guide_offset_2 = -inverse_S9_mass;
    if (!(fabs(scale_guide_offset_2) > 1e-08 * fabs(scale_guide_offset_2)))
        return 41;
    const double inverse_pivot_guide_offset_2 = 1.0/scale_guide_offset_2;
    lin->lu[1] = inverse_pivot_guide_offset_2;
    const double l_slider_x__guide_offset_2 = -inverse_S9_mass*inverse_pivot_guide_offset_2;
    lin->lu[2] = l_slider_x__guide_offset_2;
    const double scale_L6_theta = n_L6_theta__L6_theta;
    if (!(fabs(scale_L6_theta) > 1e-13 * fabs(n_L6_theta__L6_theta)))
        return 15;
    const double inverse_pivot_L6_theta = 1.0/scale_L6_theta;
    lin->lu[3] = inverse_pivot_L6_theta;
    const double l_O6_x__L6_theta_2 = inverse_pivot_L6_theta*n_O6_x__L6_theta;
    lin->lu[4] = l_O6_x__L6_theta_2;
    const double l_O6_y__L6_theta_2 = inverse_pivot_L6_theta*n_O6_y__L6_theta;
    lin->lu[5] = l_O6_y__L6_theta_2;
    const double l_Q6_x__L6_theta_2 = inverse_pivot_L6_theta*n_Q6_x__L6_theta;
    lin->lu[6] = l_Q6_x__L6_theta_2;
    const double l_Q6_y__L6_theta_2 = inverse_pivot_L6_theta*n_Q6_y__L6_theta;
    lin->lu[7] = l_Q6_y__L6_theta_2;
    const double scale_O6_x_2 = -inverse_L6_mass + l_O6_x__L6_theta_2*phi_Q6_x_L6_theta;
    if (!(fabs(scale_O6_x_2) > 1e-08 * fabs(scale_O6_x_2)))
        return 37;
    const double inverse_pivot_O6_x_2 = 1.0/scale_O6_x_2;
    lin->lu[8] = inverse_pivot_O6_x_2;
    const double l_O6_y__O6_x_2 = inverse_pivot_O6_x_2*l_O6_y__L6_theta_2*phi_Q6_x_L6_theta;
    lin->lu[9] = l_O6_y__O6_x_2;
    const double u_O6_x__O6_y = l_O6_x__L6_theta_2*phi_Q6_y_L6_theta;
    lin->lu[10] = u_O6_x__O6_y;
    const double l_Q6_x__O6_x_2 = inverse_pivot_O6_x_2*(-inverse_L6_mass +
        l_Q6_x__L6_theta_2*phi_Q6_x_L6_theta);
    lin->lu[11] = l_Q6_x__O6_x_2;
    const double u_O6_x__Q6_x = -inverse_L6_mass - l_O6_x__L6_theta_2*phi_Q6_x_L6_theta;
    lin->lu[12] = u_O6_x__Q6_x;
    const double l_Q6_y__O6_x_2 = inverse_pivot_O6_x_2*l_Q6_y__L6_theta_2*phi_Q6_x_L6_theta;
    lin->lu[13] = l_Q6_y__O6_x_2;
    const double u_O6_x__Q6_y = -l_O6_x__L6_theta_2*phi_Q6_y_L6_theta;
    lin->lu[14] = u_O6_x__Q6_y;
    const double scale_O6_y_2 = -inverse_L6_mass + l_O6_y__L6_theta_2*phi_Q6_y_L6_theta;
    const double pivot_O6_y_2 = -l_O6_y__O6_x_2*u_O6_x__O6_y + scale_O6_y_2;
    if (!(fabs(pivot_O6_y_2) > 1e-08 * fabs(scale_O6_y_2)))
        return 38;
    const double inverse_pivot_O6_y_2 = 1.0/pivot_O6_y_2;
    lin->lu[15] = inverse_pivot_O6_y_2;
    const double l_Q6_x__O6_y_2 = inverse_pivot_O6_y_2*(l_Q6_x__L6_theta_2*phi_Q6_y_L6_theta -
        l_Q6_x__O6_x_2*u_O6_x__O6_y);
    lin->lu[16] = l_Q6_x__O6_y_2;
    const double u_O6_y__Q6_x = -l_O6_y__L6_theta_2*phi_Q6_x_L6_theta - l_O6_y__O6_x_2*u_O6_x__Q6_x;
    lin->lu[17] = u_O6_y__Q6_x;
    const double l_Q6_y__O6_y_2 = inverse_pivot_O6_y_2*(-inverse_L6_mass +
        l_Q6_y__L6_theta_2*phi_Q6_y_L6_theta - l_Q6_y__O6_x_2*u_O6_x__O6_y);
    lin->lu[18] = l_Q6_y__O6_y_2;
    const double u_O6_y__Q6_y = -inverse_L6_mass - l_O6_y__L6_theta_2*phi_Q6_y_L6_theta -
        l_O6_y__O6_x_2*u_O6_x__Q6_y;
    lin->lu[19] = u_O6_y__Q6_y;
    const double scale_L8_theta = n_L8_theta__L8_theta;
    if (!(fabs(scale_L8_theta) > 1e-13 * fabs(n_L8_theta__L8_theta)))
        return 21;
    const double inverse_pivot_L8_theta = 1.0/scale_L8_theta;
    lin->lu[20] = inverse_pivot_L8_theta;
    const double l_slider_x__L8_theta_2 = inverse_pivot_L8_theta*n_slider_x__L8_theta;
    lin->lu[21] = l_slider_x__L8_theta_2;
    const double l_slider_y__L8_theta_2 = inverse_pivot_L8_theta*n_slider_y__L8_theta;
    lin->lu[22] = l_slider_y__L8_theta_2;
    const double l_Q8_x__L8_theta_2 = inverse_pivot_L8_theta*n_Q8_x__L8_theta;
    lin->lu[23] = l_Q8_x__L8_theta_2;
    const double l_Q8_y__L8_theta_2 = inverse_pivot_L8_theta*n_Q8_y__L8_theta;
    lin->lu[24] = l_Q8_y__L8_theta_2;
    const double scale_slider_x_2 = -inverse_L8_mass - inverse_S9_mass -
        l_slider_x__L8_theta_2*phi_Q8_x_L8_theta;
    const double pivot_slider_x_2 = inverse_S9_mass*l_slider_x__guide_offset_2 + scale_slider_x_2;
    if (!(fabs(pivot_slider_x_2) > 1e-08 * fabs(scale_slider_x_2)))
        return 39;
    const double inverse_pivot_slider_x_2 = 1.0/pivot_slider_x_2;
    lin->lu[25] = inverse_pivot_slider_x_2;
    const double l_slider_y__slider_x_2 = -inverse_pivot_slider_x_2*l_slider_y__L8_theta_2*phi_Q8_x_L8_theta;
    lin->lu[26] = l_slider_y__slider_x_2;
    const double u_slider_x__slider_y = -l_slider_x__L8_theta_2*phi_Q8_y_L8_theta;
    lin->lu[27] = u_slider_x__slider_y;
    const double l_Q8_x__slider_x_2 = inverse_pivot_slider_x_2*(inverse_L8_mass -
        l_Q8_x__L8_theta_2*phi_Q8_x_L8_theta);
    lin->lu[28] = l_Q8_x__slider_x_2;
    const double u_slider_x__Q8_x = inverse_L8_mass - l_slider_x__L8_theta_2*phi_Q8_x_L8_theta;
    lin->lu[29] = u_slider_x__Q8_x;
    const double l_Q8_y__slider_x_2 = -inverse_pivot_slider_x_2*l_Q8_y__L8_theta_2*phi_Q8_x_L8_theta;
    lin->lu[30] = l_Q8_y__slider_x_2;
    const double u_slider_x__Q8_y = -l_slider_x__L8_theta_2*phi_Q8_y_L8_theta;
    lin->lu[31] = u_slider_x__Q8_y;
    const double scale_slider_y_2 = -inverse_L8_mass - inverse_S9_mass -
        l_slider_y__L8_theta_2*phi_Q8_y_L8_theta;
    const double pivot_slider_y_2 = -l_slider_y__slider_x_2*u_slider_x__slider_y + scale_slider_y_2;
    if (!(fabs(pivot_slider_y_2) > 1e-08 * fabs(scale_slider_y_2)))
        return 40;
    const double inverse_pivot_slider_y_2 = 1.0/pivot_slider_y_2;
    lin->lu[32] = inverse_pivot_slider_y_2;
    const double l_Q8_x__slider_y_2 = inverse_pivot_slider_y_2*(-l_Q8_x__L8_theta_2*phi_Q8_y_L8_theta -
        l_Q8_x__slider_x_2*u_slider_x__slider_y);
    lin->lu[33] = l_Q8_x__slider_y_2;
    const double u_slider_y__Q8_x = -l_slider_y__L8_theta_2*phi_Q8_x_L8_theta -
        l_slider_y__slider_x_2*u_slider_x__Q8_x;
    lin->lu[34] = u_slider_y__Q8_x;
    const double l_Q8_y__slider_y_2 = inverse_pivot_slider_y_2*(inverse_L8_mass -
        l_Q8_y__L8_theta_2*phi_Q8_y_L8_theta - l_Q8_y__slider_x_2*u_slider_x__slider_y);
    lin->lu[35] = l_Q8_y__slider_y_2;
    const double u_slider_y__Q8_y = inverse_L8_mass - l_slider_y__L8_theta_2*phi_Q8_y_L8_theta -
        l_slider_y__slider_x_2*u_slider_x__Q8_y;
    lin->lu[36] = u_slider_y__Q8_y;
    const double scale_L1_x = n_L1_x__L1_x;
    if (!(fabs(scale_L1_x) > 1e-13 * fabs(n_L1_x__L1_x)))
        return 1;
    const double inverse_pivot_L1_x = 1.0/scale_L1_x;
    lin->lu[37] = inverse_pivot_L1_x;
    const double l_L1_y__L1_x = inverse_pivot_L1_x*n_L1_y__L1_x;
    lin->lu[38] = l_L1_y__L1_x;
    lin->lu[39] = n_L1_x__L1_y;
    const double l_L1_theta__L1_x = inverse_pivot_L1_x*n_L1_theta__L1_x;
    lin->lu[40] = l_L1_theta__L1_x;
    lin->lu[41] = n_L1_x__L1_theta;
    const double l_L2_x__L1_x = inverse_pivot_L1_x*n_L2_x__L1_x;
    lin->lu[42] = l_L2_x__L1_x;
    lin->lu[43] = n_L1_x__L2_x;
    const double l_L2_y__L1_x = inverse_pivot_L1_x*n_L2_y__L1_x;
    lin->lu[44] = l_L2_y__L1_x;
    lin->lu[45] = n_L1_x__L2_y;
    const double l_L2_theta__L1_x = inverse_pivot_L1_x*n_L2_theta__L1_x;
    lin->lu[46] = l_L2_theta__L1_x;
    lin->lu[47] = n_L1_x__L2_theta;
    const double scale_L1_y = -l_L1_y__L1_x*n_L1_x__L1_y + n_L1_y__L1_y;
    if (!(fabs(scale_L1_y) > 1e-13 * fabs(n_L1_y__L1_y)))
        return 2;
    const double inverse_pivot_L1_y = 1.0/scale_L1_y;
    lin->lu[48] = inverse_pivot_L1_y;
    const double l_L1_theta__L1_y = inverse_pivot_L1_y*(-l_L1_theta__L1_x*n_L1_x__L1_y + n_L1_theta__L1_y);
    lin->lu[49] = l_L1_theta__L1_y;
    const double u_L1_y__L1_theta = -l_L1_y__L1_x*n_L1_x__L1_theta + n_L1_y__L1_theta;
    lin->lu[50] = u_L1_y__L1_theta;
    const double l_O1_x__L1_y = inverse_pivot_L1_x*inverse_pivot_L1_y*n_L1_x__L1_y;
    lin->lu[51] = l_O1_x__L1_y;
    const double l_L2_x__L1_y = inverse_pivot_L1_y*(-l_L2_x__L1_x*n_L1_x__L1_y + n_L2_x__L1_y);
    lin->lu[52] = l_L2_x__L1_y;
    const double u_L1_y__L2_x = -l_L1_y__L1_x*n_L1_x__L2_x + n_L1_y__L2_x;
    lin->lu[53] = u_L1_y__L2_x;
    const double l_L2_y__L1_y = inverse_pivot_L1_y*(-l_L2_y__L1_x*n_L1_x__L1_y + n_L2_y__L1_y);
    lin->lu[54] = l_L2_y__L1_y;
    const double u_L1_y__L2_y = -l_L1_y__L1_x*n_L1_x__L2_y + n_L1_y__L2_y;
    lin->lu[55] = u_L1_y__L2_y;
    const double l_L2_theta__L1_y = inverse_pivot_L1_y*(-l_L2_theta__L1_x*n_L1_x__L1_y + n_L2_theta__L1_y);
    lin->lu[56] = l_L2_theta__L1_y;
    const double u_L1_y__L2_theta = -l_L1_y__L1_x*n_L1_x__L2_theta + n_L1_y__L2_theta;
    lin->lu[57] = u_L1_y__L2_theta;
    const double scale_L1_theta = -l_L1_theta__L1_x*n_L1_x__L1_theta - l_L1_theta__L1_y*u_L1_y__L1_theta +
        n_L1_theta__L1_theta;
    if (!(fabs(scale_L1_theta) > 1e-13 * fabs(n_L1_theta__L1_theta)))
        return 3;
    const double inverse_pivot_L1_theta = 1.0/scale_L1_theta;
    lin->lu[58] = inverse_pivot_L1_theta;
    const double l_O1_x__L1_theta_2 = inverse_pivot_L1_theta*(inverse_pivot_L1_x*n_L1_x__L1_theta -
        l_O1_x__L1_y*u_L1_y__L1_theta + n_O1_x__L1_theta);
    lin->lu[59] = l_O1_x__L1_theta_2;
    const double u_L1_theta__O1_x = l_L1_theta__L1_x - l_L1_theta__L1_y*l_L1_y__L1_x + phi_O1_x_L1_theta;
    lin->lu[60] = u_L1_theta__O1_x;
    const double l_O1_y__L1_theta_2 = inverse_pivot_L1_theta*(inverse_pivot_L1_y*u_L1_y__L1_theta +
        n_O1_y__L1_theta);
    lin->lu[61] = l_O1_y__L1_theta_2;
    const double u_L1_theta__O1_y = l_L1_theta__L1_y + phi_O1_y_L1_theta;
    lin->lu[62] = u_L1_theta__O1_y;
    const double l_L2_x__L1_theta = inverse_pivot_L1_theta*(-l_L2_x__L1_x*n_L1_x__L1_theta -
        l_L2_x__L1_y*u_L1_y__L1_theta + n_L2_x__L1_theta);
    lin->lu[63] = l_L2_x__L1_theta;
    const double u_L1_theta__L2_x = -l_L1_theta__L1_x*n_L1_x__L2_x - l_L1_theta__L1_y*u_L1_y__L2_x +
        n_L1_theta__L2_x;
    lin->lu[64] = u_L1_theta__L2_x;
    const double l_L2_y__L1_theta = inverse_pivot_L1_theta*(-l_L2_y__L1_x*n_L1_x__L1_theta -
        l_L2_y__L1_y*u_L1_y__L1_theta + n_L2_y__L1_theta);
    lin->lu[65] = l_L2_y__L1_theta;
    const double u_L1_theta__L2_y = -l_L1_theta__L1_x*n_L1_x__L2_y - l_L1_theta__L1_y*u_L1_y__L2_y +
        n_L1_theta__L2_y;
    lin->lu[66] = u_L1_theta__L2_y;
    const double l_L2_theta__L1_theta = inverse_pivot_L1_theta*(-l_L2_theta__L1_x*n_L1_x__L1_theta -
        l_L2_theta__L1_y*u_L1_y__L1_theta + n_L2_theta__L1_theta);
    lin->lu[67] = l_L2_theta__L1_theta;
    const double u_L1_theta__L2_theta = -l_L1_theta__L1_x*n_L1_x__L2_theta - l_L1_theta__L1_y*u_L1_y__L2_theta
        + n_L1_theta__L2_theta;
    lin->lu[68] = u_L1_theta__L2_theta;
    const double scale_O1_x_2 = -inverse_pivot_L1_x - l_L1_y__L1_x*l_O1_x__L1_y -
        l_O1_x__L1_theta_2*u_L1_theta__O1_x;
    if (!(fabs(scale_O1_x_2) > 1e-08 * fabs(scale_O1_x_2)))
        return 25;
    const double inverse_pivot_O1_x_2 = 1.0/scale_O1_x_2;
    lin->lu[69] = inverse_pivot_O1_x_2;
    const double l_O1_y__O1_x_2 = inverse_pivot_O1_x_2*(inverse_pivot_L1_y*l_L1_y__L1_x -
        l_O1_y__L1_theta_2*u_L1_theta__O1_x);
    lin->lu[70] = l_O1_y__O1_x_2;
    const double u_O1_x__O1_y = -l_O1_x__L1_theta_2*u_L1_theta__O1_y + l_O1_x__L1_y;
    lin->lu[71] = u_O1_x__O1_y;
    const double l_crank1__O1_x_2 = -inverse_pivot_L1_theta*inverse_pivot_O1_x_2*u_L1_theta__O1_x;
    lin->lu[72] = l_crank1__O1_x_2;
    const double l_L2_x__O1_x = inverse_pivot_O1_x_2*(-l_L1_y__L1_x*l_L2_x__L1_y -
        l_L2_x__L1_theta*u_L1_theta__O1_x + l_L2_x__L1_x);
    lin->lu[73] = l_L2_x__O1_x;
    const double u_O1_x__L2_x = inverse_pivot_L1_x*n_L1_x__L2_x - l_O1_x__L1_theta_2*u_L1_theta__L2_x -
        l_O1_x__L1_y*u_L1_y__L2_x;
    lin->lu[74] = u_O1_x__L2_x;
    const double l_L2_y__O1_x = inverse_pivot_O1_x_2*(-l_L1_y__L1_x*l_L2_y__L1_y -
        l_L2_y__L1_theta*u_L1_theta__O1_x + l_L2_y__L1_x);
    lin->lu[75] = l_L2_y__O1_x;
    const double u_O1_x__L2_y = inverse_pivot_L1_x*n_L1_x__L2_y - l_O1_x__L1_theta_2*u_L1_theta__L2_y -
        l_O1_x__L1_y*u_L1_y__L2_y;
    lin->lu[76] = u_O1_x__L2_y;
    const double l_L2_theta__O1_x = inverse_pivot_O1_x_2*(-l_L1_y__L1_x*l_L2_theta__L1_y -
        l_L2_theta__L1_theta*u_L1_theta__O1_x + l_L2_theta__L1_x);
    lin->lu[77] = l_L2_theta__O1_x;
    const double u_O1_x__L2_theta = inverse_pivot_L1_x*n_L1_x__L2_theta -
        l_O1_x__L1_theta_2*u_L1_theta__L2_theta - l_O1_x__L1_y*u_L1_y__L2_theta;
    lin->lu[78] = u_O1_x__L2_theta;
    const double scale_O1_y_2 = -inverse_pivot_L1_y - l_O1_y__L1_theta_2*u_L1_theta__O1_y;
    const double pivot_O1_y_2 = -l_O1_y__O1_x_2*u_O1_x__O1_y + scale_O1_y_2;
    if (!(fabs(pivot_O1_y_2) > 1e-08 * fabs(scale_O1_y_2)))
        return 26;
    const double inverse_pivot_O1_y_2 = 1.0/pivot_O1_y_2;
    lin->lu[79] = inverse_pivot_O1_y_2;
    const double l_crank1__O1_y_2 = inverse_pivot_O1_y_2*(-inverse_pivot_L1_theta*u_L1_theta__O1_y -
        l_crank1__O1_x_2*u_O1_x__O1_y);
    lin->lu[80] = l_crank1__O1_y_2;
    const double u_O1_y__crank1 = l_O1_x__L1_theta_2*l_O1_y__O1_x_2 - l_O1_y__L1_theta_2;
    lin->lu[81] = u_O1_y__crank1;
    const double l_L2_x__O1_y = inverse_pivot_O1_y_2*(-l_L2_x__L1_theta*u_L1_theta__O1_y + l_L2_x__L1_y -
        l_L2_x__O1_x*u_O1_x__O1_y);
    lin->lu[82] = l_L2_x__O1_y;
    const double u_O1_y__L2_x = inverse_pivot_L1_y*u_L1_y__L2_x - l_O1_y__L1_theta_2*u_L1_theta__L2_x -
        l_O1_y__O1_x_2*u_O1_x__L2_x;
    lin->lu[83] = u_O1_y__L2_x;
    const double l_L2_y__O1_y = inverse_pivot_O1_y_2*(-l_L2_y__L1_theta*u_L1_theta__O1_y + l_L2_y__L1_y -
        l_L2_y__O1_x*u_O1_x__O1_y);
    lin->lu[84] = l_L2_y__O1_y;
    const double u_O1_y__L2_y = inverse_pivot_L1_y*u_L1_y__L2_y - l_O1_y__L1_theta_2*u_L1_theta__L2_y -
        l_O1_y__O1_x_2*u_O1_x__L2_y;
    lin->lu[85] = u_O1_y__L2_y;
    const double l_L2_theta__O1_y = inverse_pivot_O1_y_2*(-l_L2_theta__L1_theta*u_L1_theta__O1_y +
        l_L2_theta__L1_y - l_L2_theta__O1_x*u_O1_x__O1_y);
    lin->lu[86] = l_L2_theta__O1_y;
    const double u_O1_y__L2_theta = inverse_pivot_L1_y*u_L1_y__L2_theta -
        l_O1_y__L1_theta_2*u_L1_theta__L2_theta - l_O1_y__O1_x_2*u_O1_x__L2_theta;
    lin->lu[87] = u_O1_y__L2_theta;
    const double scale_crank1_2 = -inverse_pivot_L1_theta;
    const double pivot_crank1_2 = l_O1_x__L1_theta_2*l_crank1__O1_x_2 - l_crank1__O1_y_2*u_O1_y__crank1 +
        scale_crank1_2;
    if (!(fabs(pivot_crank1_2) > 1e-08 * fabs(scale_crank1_2)))
        return 43;
    const double inverse_pivot_crank1_2 = 1.0/pivot_crank1_2;
    lin->lu[88] = inverse_pivot_crank1_2;
    const double l_L2_x__crank1 = inverse_pivot_crank1_2*(-l_L2_x__L1_theta + l_L2_x__O1_x*l_O1_x__L1_theta_2
        - l_L2_x__O1_y*u_O1_y__crank1);
    lin->lu[89] = l_L2_x__crank1;
    const double u_crank1__L2_x = -inverse_pivot_L1_theta*u_L1_theta__L2_x - l_crank1__O1_x_2*u_O1_x__L2_x -
        l_crank1__O1_y_2*u_O1_y__L2_x;
    lin->lu[90] = u_crank1__L2_x;
    const double l_L2_y__crank1 = inverse_pivot_crank1_2*(-l_L2_y__L1_theta + l_L2_y__O1_x*l_O1_x__L1_theta_2
        - l_L2_y__O1_y*u_O1_y__crank1);
    lin->lu[91] = l_L2_y__crank1;
    const double u_crank1__L2_y = -inverse_pivot_L1_theta*u_L1_theta__L2_y - l_crank1__O1_x_2*u_O1_x__L2_y -
        l_crank1__O1_y_2*u_O1_y__L2_y;
    lin->lu[92] = u_crank1__L2_y;
    const double l_L2_theta__crank1 = inverse_pivot_crank1_2*(-l_L2_theta__L1_theta +
        l_L2_theta__O1_x*l_O1_x__L1_theta_2 - l_L2_theta__O1_y*u_O1_y__crank1);
    lin->lu[93] = l_L2_theta__crank1;
    const double u_crank1__L2_theta = -inverse_pivot_L1_theta*u_L1_theta__L2_theta -
        l_crank1__O1_x_2*u_O1_x__L2_theta - l_crank1__O1_y_2*u_O1_y__L2_theta;
    lin->lu[94] = u_crank1__L2_theta;
    const double scale_L2_x = -l_L2_x__L1_theta*u_L1_theta__L2_x - l_L2_x__L1_x*n_L1_x__L2_x -
        l_L2_x__L1_y*u_L1_y__L2_x - l_L2_x__O1_x*u_O1_x__L2_x - l_L2_x__O1_y*u_O1_y__L2_x -
        l_L2_x__crank1*u_crank1__L2_x + n_L2_x__L2_x;
    if (!(fabs(scale_L2_x) > 1e-13 * fabs(n_L2_x__L2_x)))
        return 4;
    const double inverse_pivot_L2_x = 1.0/scale_L2_x;
    lin->lu[95] = inverse_pivot_L2_x;
    const double l_L2_y__L2_x = inverse_pivot_L2_x*(-l_L2_y__L1_theta*u_L1_theta__L2_x -
        l_L2_y__L1_x*n_L1_x__L2_x - l_L2_y__L1_y*u_L1_y__L2_x - l_L2_y__O1_x*u_O1_x__L2_x -
        l_L2_y__O1_y*u_O1_y__L2_x - l_L2_y__crank1*u_crank1__L2_x + n_L2_y__L2_x);
    lin->lu[96] = l_L2_y__L2_x;
    const double u_L2_x__L2_y = -l_L2_x__L1_theta*u_L1_theta__L2_y - l_L2_x__L1_x*n_L1_x__L2_y -
        l_L2_x__L1_y*u_L1_y__L2_y - l_L2_x__O1_x*u_O1_x__L2_y - l_L2_x__O1_y*u_O1_y__L2_y -
        l_L2_x__crank1*u_crank1__L2_y + n_L2_x__L2_y;
    lin->lu[97] = u_L2_x__L2_y;
    const double l_L2_theta__L2_x = inverse_pivot_L2_x*(-l_L2_theta__L1_theta*u_L1_theta__L2_x -
        l_L2_theta__L1_x*n_L1_x__L2_x - l_L2_theta__L1_y*u_L1_y__L2_x - l_L2_theta__O1_x*u_O1_x__L2_x -
        l_L2_theta__O1_y*u_O1_y__L2_x - l_L2_theta__crank1*u_crank1__L2_x + n_L2_theta__L2_x);
    lin->lu[98] = l_L2_theta__L2_x;
    const double u_L2_x__L2_theta = -l_L2_x__L1_theta*u_L1_theta__L2_theta - l_L2_x__L1_x*n_L1_x__L2_theta -
        l_L2_x__L1_y*u_L1_y__L2_theta - l_L2_x__O1_x*u_O1_x__L2_theta - l_L2_x__O1_y*u_O1_y__L2_theta -
        l_L2_x__crank1*u_crank1__L2_theta + n_L2_x__L2_theta;
    lin->lu[99] = u_L2_x__L2_theta;
    const double scale_L2_y = -l_L2_y__L1_theta*u_L1_theta__L2_y - l_L2_y__L1_x*n_L1_x__L2_y -
        l_L2_y__L1_y*u_L1_y__L2_y - l_L2_y__L2_x*u_L2_x__L2_y - l_L2_y__O1_x*u_O1_x__L2_y -
        l_L2_y__O1_y*u_O1_y__L2_y - l_L2_y__crank1*u_crank1__L2_y + n_L2_y__L2_y;
    if (!(fabs(scale_L2_y) > 1e-13 * fabs(n_L2_y__L2_y)))
        return 5;
    const double inverse_pivot_L2_y = 1.0/scale_L2_y;
    lin->lu[100] = inverse_pivot_L2_y;
    const double l_L2_theta__L2_y = inverse_pivot_L2_y*(-l_L2_theta__L1_theta*u_L1_theta__L2_y -
        l_L2_theta__L1_x*n_L1_x__L2_y - l_L2_theta__L1_y*u_L1_y__L2_y - l_L2_theta__L2_x*u_L2_x__L2_y -
        l_L2_theta__O1_x*u_O1_x__L2_y - l_L2_theta__O1_y*u_O1_y__L2_y - l_L2_theta__crank1*u_crank1__L2_y +
        n_L2_theta__L2_y);
    lin->lu[101] = l_L2_theta__L2_y;
    const double u_L2_y__L2_theta = -l_L2_y__L1_theta*u_L1_theta__L2_theta - l_L2_y__L1_x*n_L1_x__L2_theta -
        l_L2_y__L1_y*u_L1_y__L2_theta - l_L2_y__L2_x*u_L2_x__L2_theta - l_L2_y__O1_x*u_O1_x__L2_theta -
        l_L2_y__O1_y*u_O1_y__L2_theta - l_L2_y__crank1*u_crank1__L2_theta + n_L2_y__L2_theta;
    lin->lu[102] = u_L2_y__L2_theta;
    const double l_P2_x__L2_y = -inverse_pivot_L2_x*inverse_pivot_L2_y*u_L2_x__L2_y;
    lin->lu[103] = l_P2_x__L2_y;
    const double scale_L2_theta = -l_L2_theta__L1_theta*u_L1_theta__L2_theta -
        l_L2_theta__L1_x*n_L1_x__L2_theta - l_L2_theta__L1_y*u_L1_y__L2_theta -
        l_L2_theta__L2_x*u_L2_x__L2_theta - l_L2_theta__L2_y*u_L2_y__L2_theta -
        l_L2_theta__O1_x*u_O1_x__L2_theta - l_L2_theta__O1_y*u_O1_y__L2_theta -
        l_L2_theta__crank1*u_crank1__L2_theta + n_L2_theta__L2_theta;
    if (!(fabs(scale_L2_theta) > 1e-13 * fabs(n_L2_theta__L2_theta)))
        return 6;
    const double inverse_pivot_L2_theta = 1.0/scale_L2_theta;
    lin->lu[104] = inverse_pivot_L2_theta;
    const double l_P2_x__L2_theta_2 = inverse_pivot_L2_theta*(-inverse_pivot_L2_x*u_L2_x__L2_theta -
        l_P2_x__L2_y*u_L2_y__L2_theta + n_P2_x__L2_theta);
    lin->lu[105] = l_P2_x__L2_theta_2;
    const double u_L2_theta__P2_x = -l_L2_theta__L2_x + l_L2_theta__L2_y*l_L2_y__L2_x + phi_P2_x_L2_theta;
    lin->lu[106] = u_L2_theta__P2_x;
    const double l_P2_y__L2_theta_2 = inverse_pivot_L2_theta*(-inverse_pivot_L2_y*u_L2_y__L2_theta +
        n_P2_y__L2_theta);
    lin->lu[107] = l_P2_y__L2_theta_2;
    const double u_L2_theta__P2_y = -l_L2_theta__L2_y + phi_P2_y_L2_theta;
    lin->lu[108] = u_L2_theta__P2_y;
    const double scale_L3_x = n_L3_x__L3_x;
    if (!(fabs(scale_L3_x) > 1e-13 * fabs(n_L3_x__L3_x)))
        return 7;
    const double inverse_pivot_L3_x = 1.0/scale_L3_x;
    lin->lu[109] = inverse_pivot_L3_x;
    const double l_L3_y__L3_x = inverse_pivot_L3_x*n_L3_y__L3_x;
    lin->lu[110] = l_L3_y__L3_x;
    lin->lu[111] = n_L3_x__L3_y;
    const double l_L3_theta__L3_x = inverse_pivot_L3_x*n_L3_theta__L3_x;
    lin->lu[112] = l_L3_theta__L3_x;
    lin->lu[113] = n_L3_x__L3_theta;
    const double l_L4_x__L3_x = inverse_pivot_L3_x*n_L4_x__L3_x;
    lin->lu[114] = l_L4_x__L3_x;
    lin->lu[115] = n_L3_x__L4_x;
    const double l_L4_y__L3_x = inverse_pivot_L3_x*n_L4_y__L3_x;
    lin->lu[116] = l_L4_y__L3_x;
    lin->lu[117] = n_L3_x__L4_y;
    const double l_L4_theta__L3_x = inverse_pivot_L3_x*n_L4_theta__L3_x;
    lin->lu[118] = l_L4_theta__L3_x;
    lin->lu[119] = n_L3_x__L4_theta;
    const double scale_L3_y = -l_L3_y__L3_x*n_L3_x__L3_y + n_L3_y__L3_y;
    if (!(fabs(scale_L3_y) > 1e-13 * fabs(n_L3_y__L3_y)))
        return 8;
    const double inverse_pivot_L3_y = 1.0/scale_L3_y;
    lin->lu[120] = inverse_pivot_L3_y;
    const double l_L3_theta__L3_y = inverse_pivot_L3_y*(-l_L3_theta__L3_x*n_L3_x__L3_y + n_L3_theta__L3_y);
    lin->lu[121] = l_L3_theta__L3_y;
    const double u_L3_y__L3_theta = -l_L3_y__L3_x*n_L3_x__L3_theta + n_L3_y__L3_theta;
    lin->lu[122] = u_L3_y__L3_theta;
    const double l_L4_x__L3_y = inverse_pivot_L3_y*(-l_L4_x__L3_x*n_L3_x__L3_y + n_L4_x__L3_y);
    lin->lu[123] = l_L4_x__L3_y;
    const double u_L3_y__L4_x = -l_L3_y__L3_x*n_L3_x__L4_x + n_L3_y__L4_x;
    lin->lu[124] = u_L3_y__L4_x;
    const double l_L4_y__L3_y = inverse_pivot_L3_y*(-l_L4_y__L3_x*n_L3_x__L3_y + n_L4_y__L3_y);
    lin->lu[125] = l_L4_y__L3_y;
    const double u_L3_y__L4_y = -l_L3_y__L3_x*n_L3_x__L4_y + n_L3_y__L4_y;
    lin->lu[126] = u_L3_y__L4_y;
    const double l_L4_theta__L3_y = inverse_pivot_L3_y*(-l_L4_theta__L3_x*n_L3_x__L3_y + n_L4_theta__L3_y);
    lin->lu[127] = l_L4_theta__L3_y;
    const double u_L3_y__L4_theta = -l_L3_y__L3_x*n_L3_x__L4_theta + n_L3_y__L4_theta;
    lin->lu[128] = u_L3_y__L4_theta;
    const double l_P3_x__L3_y = -inverse_pivot_L3_x*inverse_pivot_L3_y*n_L3_x__L3_y;
    lin->lu[129] = l_P3_x__L3_y;
    const double scale_L3_theta = -l_L3_theta__L3_x*n_L3_x__L3_theta - l_L3_theta__L3_y*u_L3_y__L3_theta +
        n_L3_theta__L3_theta;
    if (!(fabs(scale_L3_theta) > 1e-13 * fabs(n_L3_theta__L3_theta)))
        return 9;
    const double inverse_pivot_L3_theta = 1.0/scale_L3_theta;
    lin->lu[130] = inverse_pivot_L3_theta;
    const double l_L4_x__L3_theta = inverse_pivot_L3_theta*(-l_L4_x__L3_x*n_L3_x__L3_theta -
        l_L4_x__L3_y*u_L3_y__L3_theta + n_L4_x__L3_theta);
    lin->lu[131] = l_L4_x__L3_theta;
    const double u_L3_theta__L4_x = -l_L3_theta__L3_x*n_L3_x__L4_x - l_L3_theta__L3_y*u_L3_y__L4_x +
        n_L3_theta__L4_x;
    lin->lu[132] = u_L3_theta__L4_x;
    const double l_L4_y__L3_theta = inverse_pivot_L3_theta*(-l_L4_y__L3_x*n_L3_x__L3_theta -
        l_L4_y__L3_y*u_L3_y__L3_theta + n_L4_y__L3_theta);
    lin->lu[133] = l_L4_y__L3_theta;
    const double u_L3_theta__L4_y = -l_L3_theta__L3_x*n_L3_x__L4_y - l_L3_theta__L3_y*u_L3_y__L4_y +
        n_L3_theta__L4_y;
    lin->lu[134] = u_L3_theta__L4_y;
    const double l_L4_theta__L3_theta = inverse_pivot_L3_theta*(-l_L4_theta__L3_x*n_L3_x__L3_theta -
        l_L4_theta__L3_y*u_L3_y__L3_theta + n_L4_theta__L3_theta);
    lin->lu[135] = l_L4_theta__L3_theta;
    const double u_L3_theta__L4_theta = -l_L3_theta__L3_x*n_L3_x__L4_theta - l_L3_theta__L3_y*u_L3_y__L4_theta
        + n_L3_theta__L4_theta;
    lin->lu[136] = u_L3_theta__L4_theta;
    const double l_P3_x__L3_theta_2 = inverse_pivot_L3_theta*(-inverse_pivot_L3_x*n_L3_x__L3_theta -
        l_P3_x__L3_y*u_L3_y__L3_theta + n_P3_x__L3_theta);
    lin->lu[137] = l_P3_x__L3_theta_2;
    const double u_L3_theta__P3_x = -l_L3_theta__L3_x + l_L3_theta__L3_y*l_L3_y__L3_x + phi_P3_x_L3_theta;
    lin->lu[138] = u_L3_theta__P3_x;
    const double l_P3_y__L3_theta_2 = inverse_pivot_L3_theta*(-inverse_pivot_L3_y*u_L3_y__L3_theta +
        n_P3_y__L3_theta);
    lin->lu[139] = l_P3_y__L3_theta_2;
    const double u_L3_theta__P3_y = -l_L3_theta__L3_y + phi_P3_y_L3_theta;
    lin->lu[140] = u_L3_theta__P3_y;
    const double scale_L4_x = -l_L4_x__L3_theta*u_L3_theta__L4_x - l_L4_x__L3_x*n_L3_x__L4_x -
        l_L4_x__L3_y*u_L3_y__L4_x + n_L4_x__L4_x;
    if (!(fabs(scale_L4_x) > 1e-13 * fabs(n_L4_x__L4_x)))
        return 10;
    const double inverse_pivot_L4_x = 1.0/scale_L4_x;
    lin->lu[141] = inverse_pivot_L4_x;
    const double l_L4_y__L4_x = inverse_pivot_L4_x*(-l_L4_y__L3_theta*u_L3_theta__L4_x -
        l_L4_y__L3_x*n_L3_x__L4_x - l_L4_y__L3_y*u_L3_y__L4_x + n_L4_y__L4_x);
    lin->lu[142] = l_L4_y__L4_x;
    const double u_L4_x__L4_y = -l_L4_x__L3_theta*u_L3_theta__L4_y - l_L4_x__L3_x*n_L3_x__L4_y -
        l_L4_x__L3_y*u_L3_y__L4_y + n_L4_x__L4_y;
    lin->lu[143] = u_L4_x__L4_y;
    const double l_L4_theta__L4_x = inverse_pivot_L4_x*(-l_L4_theta__L3_theta*u_L3_theta__L4_x -
        l_L4_theta__L3_x*n_L3_x__L4_x - l_L4_theta__L3_y*u_L3_y__L4_x + n_L4_theta__L4_x);
    lin->lu[144] = l_L4_theta__L4_x;
    const double u_L4_x__L4_theta = -l_L4_x__L3_theta*u_L3_theta__L4_theta - l_L4_x__L3_x*n_L3_x__L4_theta -
        l_L4_x__L3_y*u_L3_y__L4_theta + n_L4_x__L4_theta;
    lin->lu[145] = u_L4_x__L4_theta;
    const double l_P3_x__L4_x = inverse_pivot_L4_x*(-inverse_pivot_L3_x*n_L3_x__L4_x -
        l_P3_x__L3_theta_2*u_L3_theta__L4_x - l_P3_x__L3_y*u_L3_y__L4_x);
    lin->lu[146] = l_P3_x__L4_x;
    const double u_L4_x__P3_x = l_L3_y__L3_x*l_L4_x__L3_y - l_L4_x__L3_theta*u_L3_theta__P3_x - l_L4_x__L3_x;
    lin->lu[147] = u_L4_x__P3_x;
    const double l_P3_y__L4_x = inverse_pivot_L4_x*(-inverse_pivot_L3_y*u_L3_y__L4_x -
        l_P3_y__L3_theta_2*u_L3_theta__L4_x);
    lin->lu[148] = l_P3_y__L4_x;
    const double u_L4_x__P3_y = -l_L4_x__L3_theta*u_L3_theta__P3_y - l_L4_x__L3_y;
    lin->lu[149] = u_L4_x__P3_y;
    const double scale_L4_y = -l_L4_y__L3_theta*u_L3_theta__L4_y - l_L4_y__L3_x*n_L3_x__L4_y -
        l_L4_y__L3_y*u_L3_y__L4_y - l_L4_y__L4_x*u_L4_x__L4_y + n_L4_y__L4_y;
    if (!(fabs(scale_L4_y) > 1e-13 * fabs(n_L4_y__L4_y)))
        return 11;
    const double inverse_pivot_L4_y = 1.0/scale_L4_y;
    lin->lu[150] = inverse_pivot_L4_y;
    const double l_L4_theta__L4_y = inverse_pivot_L4_y*(-l_L4_theta__L3_theta*u_L3_theta__L4_y -
        l_L4_theta__L3_x*n_L3_x__L4_y - l_L4_theta__L3_y*u_L3_y__L4_y - l_L4_theta__L4_x*u_L4_x__L4_y +
        n_L4_theta__L4_y);
    lin->lu[151] = l_L4_theta__L4_y;
    const double u_L4_y__L4_theta = -l_L4_y__L3_theta*u_L3_theta__L4_theta - l_L4_y__L3_x*n_L3_x__L4_theta -
        l_L4_y__L3_y*u_L3_y__L4_theta - l_L4_y__L4_x*u_L4_x__L4_theta + n_L4_y__L4_theta;
    lin->lu[152] = u_L4_y__L4_theta;
    const double l_O4_x__L4_y = inverse_pivot_L4_x*inverse_pivot_L4_y*u_L4_x__L4_y;
    lin->lu[153] = l_O4_x__L4_y;
    const double l_P3_x__L4_y = inverse_pivot_L4_y*(-inverse_pivot_L3_x*n_L3_x__L4_y -
        l_P3_x__L3_theta_2*u_L3_theta__L4_y - l_P3_x__L3_y*u_L3_y__L4_y - l_P3_x__L4_x*u_L4_x__L4_y);
    lin->lu[154] = l_P3_x__L4_y;
    const double u_L4_y__P3_x = l_L3_y__L3_x*l_L4_y__L3_y - l_L4_y__L3_theta*u_L3_theta__P3_x - l_L4_y__L3_x -
        l_L4_y__L4_x*u_L4_x__P3_x;
    lin->lu[155] = u_L4_y__P3_x;
    const double l_P3_y__L4_y = inverse_pivot_L4_y*(-inverse_pivot_L3_y*u_L3_y__L4_y -
        l_P3_y__L3_theta_2*u_L3_theta__L4_y - l_P3_y__L4_x*u_L4_x__L4_y);
    lin->lu[156] = l_P3_y__L4_y;
    const double u_L4_y__P3_y = -l_L4_y__L3_theta*u_L3_theta__P3_y - l_L4_y__L3_y - l_L4_y__L4_x*u_L4_x__P3_y;
    lin->lu[157] = u_L4_y__P3_y;
    const double scale_L4_theta = -l_L4_theta__L3_theta*u_L3_theta__L4_theta -
        l_L4_theta__L3_x*n_L3_x__L4_theta - l_L4_theta__L3_y*u_L3_y__L4_theta -
        l_L4_theta__L4_x*u_L4_x__L4_theta - l_L4_theta__L4_y*u_L4_y__L4_theta + n_L4_theta__L4_theta;
    if (!(fabs(scale_L4_theta) > 1e-13 * fabs(n_L4_theta__L4_theta)))
        return 12;
    const double inverse_pivot_L4_theta = 1.0/scale_L4_theta;
    lin->lu[158] = inverse_pivot_L4_theta;
    const double l_O4_x__L4_theta_2 = inverse_pivot_L4_theta*(inverse_pivot_L4_x*u_L4_x__L4_theta -
        l_O4_x__L4_y*u_L4_y__L4_theta + n_O4_x__L4_theta);
    lin->lu[159] = l_O4_x__L4_theta_2;
    const double u_L4_theta__O4_x = l_L4_theta__L4_x - l_L4_theta__L4_y*l_L4_y__L4_x + phi_O4_x_L4_theta;
    lin->lu[160] = u_L4_theta__O4_x;
    const double l_O4_y__L4_theta_2 = inverse_pivot_L4_theta*(inverse_pivot_L4_y*u_L4_y__L4_theta +
        n_O4_y__L4_theta);
    lin->lu[161] = l_O4_y__L4_theta_2;
    const double u_L4_theta__O4_y = l_L4_theta__L4_y + phi_O4_y_L4_theta;
    lin->lu[162] = u_L4_theta__O4_y;
    const double l_P3_x__L4_theta = inverse_pivot_L4_theta*(-inverse_pivot_L3_x*n_L3_x__L4_theta -
        l_P3_x__L3_theta_2*u_L3_theta__L4_theta - l_P3_x__L3_y*u_L3_y__L4_theta -
        l_P3_x__L4_x*u_L4_x__L4_theta - l_P3_x__L4_y*u_L4_y__L4_theta);
    lin->lu[163] = l_P3_x__L4_theta;
    const double u_L4_theta__P3_x = l_L3_y__L3_x*l_L4_theta__L3_y - l_L4_theta__L3_theta*u_L3_theta__P3_x -
        l_L4_theta__L3_x - l_L4_theta__L4_x*u_L4_x__P3_x - l_L4_theta__L4_y*u_L4_y__P3_x;
    lin->lu[164] = u_L4_theta__P3_x;
    const double l_P3_y__L4_theta = inverse_pivot_L4_theta*(-inverse_pivot_L3_y*u_L3_y__L4_theta -
        l_P3_y__L3_theta_2*u_L3_theta__L4_theta - l_P3_y__L4_x*u_L4_x__L4_theta -
        l_P3_y__L4_y*u_L4_y__L4_theta);
    lin->lu[165] = l_P3_y__L4_theta;
    const double u_L4_theta__P3_y = -l_L4_theta__L3_theta*u_L3_theta__P3_y - l_L4_theta__L3_y -
        l_L4_theta__L4_x*u_L4_x__P3_y - l_L4_theta__L4_y*u_L4_y__P3_y;
    lin->lu[166] = u_L4_theta__P3_y;
    const double scale_O4_x_2 = -inverse_pivot_L4_x - l_L4_y__L4_x*l_O4_x__L4_y -
        l_O4_x__L4_theta_2*u_L4_theta__O4_x;
    if (!(fabs(scale_O4_x_2) > 1e-08 * fabs(scale_O4_x_2)))
        return 27;
    const double inverse_pivot_O4_x_2 = 1.0/scale_O4_x_2;
    lin->lu[167] = inverse_pivot_O4_x_2;
    const double l_O4_y__O4_x_2 = inverse_pivot_O4_x_2*(inverse_pivot_L4_y*l_L4_y__L4_x -
        l_O4_y__L4_theta_2*u_L4_theta__O4_x);
    lin->lu[168] = l_O4_y__O4_x_2;
    const double u_O4_x__O4_y = -l_O4_x__L4_theta_2*u_L4_theta__O4_y + l_O4_x__L4_y;
    lin->lu[169] = u_O4_x__O4_y;
    const double l_crank4__O4_x_2 = -inverse_pivot_L4_theta*inverse_pivot_O4_x_2*u_L4_theta__O4_x;
    lin->lu[170] = l_crank4__O4_x_2;
    const double l_P3_x__O4_x = inverse_pivot_O4_x_2*(-l_L4_y__L4_x*l_P3_x__L4_y -
        l_P3_x__L4_theta*u_L4_theta__O4_x + l_P3_x__L4_x);
    lin->lu[171] = l_P3_x__O4_x;
    const double u_O4_x__P3_x = inverse_pivot_L4_x*u_L4_x__P3_x - l_O4_x__L4_theta_2*u_L4_theta__P3_x -
        l_O4_x__L4_y*u_L4_y__P3_x;
    lin->lu[172] = u_O4_x__P3_x;
    const double l_P3_y__O4_x = inverse_pivot_O4_x_2*(-l_L4_y__L4_x*l_P3_y__L4_y -
        l_P3_y__L4_theta*u_L4_theta__O4_x + l_P3_y__L4_x);
    lin->lu[173] = l_P3_y__O4_x;
    const double u_O4_x__P3_y = inverse_pivot_L4_x*u_L4_x__P3_y - l_O4_x__L4_theta_2*u_L4_theta__P3_y -
        l_O4_x__L4_y*u_L4_y__P3_y;
    lin->lu[174] = u_O4_x__P3_y;
    const double scale_O4_y_2 = -inverse_pivot_L4_y - l_O4_y__L4_theta_2*u_L4_theta__O4_y;
    const double pivot_O4_y_2 = -l_O4_y__O4_x_2*u_O4_x__O4_y + scale_O4_y_2;
    if (!(fabs(pivot_O4_y_2) > 1e-08 * fabs(scale_O4_y_2)))
        return 28;
    const double inverse_pivot_O4_y_2 = 1.0/pivot_O4_y_2;
    lin->lu[175] = inverse_pivot_O4_y_2;
    const double l_crank4__O4_y_2 = inverse_pivot_O4_y_2*(-inverse_pivot_L4_theta*u_L4_theta__O4_y -
        l_crank4__O4_x_2*u_O4_x__O4_y);
    lin->lu[176] = l_crank4__O4_y_2;
    const double u_O4_y__crank4 = l_O4_x__L4_theta_2*l_O4_y__O4_x_2 - l_O4_y__L4_theta_2;
    lin->lu[177] = u_O4_y__crank4;
    const double l_P3_x__O4_y = inverse_pivot_O4_y_2*(-l_P3_x__L4_theta*u_L4_theta__O4_y + l_P3_x__L4_y -
        l_P3_x__O4_x*u_O4_x__O4_y);
    lin->lu[178] = l_P3_x__O4_y;
    const double u_O4_y__P3_x = inverse_pivot_L4_y*u_L4_y__P3_x - l_O4_y__L4_theta_2*u_L4_theta__P3_x -
        l_O4_y__O4_x_2*u_O4_x__P3_x;
    lin->lu[179] = u_O4_y__P3_x;
    const double l_P3_y__O4_y = inverse_pivot_O4_y_2*(-l_P3_y__L4_theta*u_L4_theta__O4_y + l_P3_y__L4_y -
        l_P3_y__O4_x*u_O4_x__O4_y);
    lin->lu[180] = l_P3_y__O4_y;
    const double u_O4_y__P3_y = inverse_pivot_L4_y*u_L4_y__P3_y - l_O4_y__L4_theta_2*u_L4_theta__P3_y -
        l_O4_y__O4_x_2*u_O4_x__P3_y;
    lin->lu[181] = u_O4_y__P3_y;
    const double scale_crank4_2 = -inverse_pivot_L4_theta;
    const double pivot_crank4_2 = l_O4_x__L4_theta_2*l_crank4__O4_x_2 - l_crank4__O4_y_2*u_O4_y__crank4 +
        scale_crank4_2;
    if (!(fabs(pivot_crank4_2) > 1e-08 * fabs(scale_crank4_2)))
        return 44;
    const double inverse_pivot_crank4_2 = 1.0/pivot_crank4_2;
    lin->lu[182] = inverse_pivot_crank4_2;
    const double l_P3_x__crank4 = inverse_pivot_crank4_2*(l_O4_x__L4_theta_2*l_P3_x__O4_x - l_P3_x__L4_theta -
        l_P3_x__O4_y*u_O4_y__crank4);
    lin->lu[183] = l_P3_x__crank4;
    const double u_crank4__P3_x = -inverse_pivot_L4_theta*u_L4_theta__P3_x - l_crank4__O4_x_2*u_O4_x__P3_x -
        l_crank4__O4_y_2*u_O4_y__P3_x;
    lin->lu[184] = u_crank4__P3_x;
    const double l_P3_y__crank4 = inverse_pivot_crank4_2*(l_O4_x__L4_theta_2*l_P3_y__O4_x - l_P3_y__L4_theta -
        l_P3_y__O4_y*u_O4_y__crank4);
    lin->lu[185] = l_P3_y__crank4;
    const double u_crank4__P3_y = -inverse_pivot_L4_theta*u_L4_theta__P3_y - l_crank4__O4_x_2*u_O4_x__P3_y -
        l_crank4__O4_y_2*u_O4_y__P3_y;
    lin->lu[186] = u_crank4__P3_y;
    const double scale_L7_theta = n_L7_theta__L7_theta;
    if (!(fabs(scale_L7_theta) > 1e-13 * fabs(n_L7_theta__L7_theta)))
        return 18;
    const double inverse_pivot_L7_theta = 1.0/scale_L7_theta;
    lin->lu[187] = inverse_pivot_L7_theta;
    const double l_P2_x__L7_theta_2 = inverse_pivot_L7_theta*n_P2_x__L7_theta;
    lin->lu[188] = l_P2_x__L7_theta_2;
    const double l_P2_y__L7_theta_2 = inverse_pivot_L7_theta*n_P2_y__L7_theta;
    lin->lu[189] = l_P2_y__L7_theta_2;
    const double l_P3_x__L7_theta_2 = inverse_pivot_L7_theta*n_P3_x__L7_theta;
    lin->lu[190] = l_P3_x__L7_theta_2;
    const double l_P3_y__L7_theta_2 = inverse_pivot_L7_theta*n_P3_y__L7_theta;
    lin->lu[191] = l_P3_y__L7_theta_2;
    const double l_Q6_x__L7_theta_2 = inverse_pivot_L7_theta*n_Q6_x__L7_theta;
    lin->lu[192] = l_Q6_x__L7_theta_2;
    const double l_Q6_y__L7_theta_2 = inverse_pivot_L7_theta*n_Q6_y__L7_theta;
    lin->lu[193] = l_Q6_y__L7_theta_2;
    const double l_Q8_x__L7_theta_2 = inverse_pivot_L7_theta*n_Q8_x__L7_theta;
    lin->lu[194] = l_Q8_x__L7_theta_2;
    const double l_Q8_y__L7_theta_2 = inverse_pivot_L7_theta*n_Q8_y__L7_theta;
    lin->lu[195] = l_Q8_y__L7_theta_2;
    const double scale_P2_x_2 = -inverse_L7_mass - inverse_pivot_L2_x + l_L2_y__L2_x*l_P2_x__L2_y -
        l_P2_x__L2_theta_2*u_L2_theta__P2_x - l_P2_x__L7_theta_2*phi_P2_x_L7_theta;
    if (!(fabs(scale_P2_x_2) > 1e-08 * fabs(scale_P2_x_2)))
        return 29;
    const double inverse_pivot_P2_x_2 = 1.0/scale_P2_x_2;
    lin->lu[196] = inverse_pivot_P2_x_2;
    const double l_P2_y__P2_x_2 = inverse_pivot_P2_x_2*(inverse_pivot_L2_y*l_L2_y__L2_x -
        l_P2_y__L2_theta_2*u_L2_theta__P2_x - l_P2_y__L7_theta_2*phi_P2_x_L7_theta);
    lin->lu[197] = l_P2_y__P2_x_2;
    const double u_P2_x__P2_y = -l_P2_x__L2_theta_2*u_L2_theta__P2_y - l_P2_x__L2_y -
        l_P2_x__L7_theta_2*phi_P2_y_L7_theta;
    lin->lu[198] = u_P2_x__P2_y;
    const double l_P3_x__P2_x_2 = inverse_pivot_P2_x_2*(-inverse_L7_mass -
        l_P3_x__L7_theta_2*phi_P2_x_L7_theta);
    lin->lu[199] = l_P3_x__P2_x_2;
    const double u_P2_x__P3_x = -inverse_L7_mass - l_P2_x__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[200] = u_P2_x__P3_x;
    const double l_P3_y__P2_x_2 = -inverse_pivot_P2_x_2*l_P3_y__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[201] = l_P3_y__P2_x_2;
    const double u_P2_x__P3_y = -l_P2_x__L7_theta_2*phi_P2_y_L7_theta;
    lin->lu[202] = u_P2_x__P3_y;
    const double l_Q6_x__P2_x_2 = inverse_pivot_P2_x_2*(inverse_L7_mass -
        l_Q6_x__L7_theta_2*phi_P2_x_L7_theta);
    lin->lu[203] = l_Q6_x__P2_x_2;
    const double u_P2_x__Q6_x = inverse_L7_mass - l_P2_x__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[204] = u_P2_x__Q6_x;
    const double l_Q6_y__P2_x_2 = -inverse_pivot_P2_x_2*l_Q6_y__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[205] = l_Q6_y__P2_x_2;
    const double u_P2_x__Q6_y = -l_P2_x__L7_theta_2*phi_P2_y_L7_theta;
    lin->lu[206] = u_P2_x__Q6_y;
    const double l_Q8_x__P2_x_2 = inverse_pivot_P2_x_2*(inverse_L7_mass -
        l_Q8_x__L7_theta_2*phi_P2_x_L7_theta);
    lin->lu[207] = l_Q8_x__P2_x_2;
    const double u_P2_x__Q8_x = inverse_L7_mass - l_P2_x__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[208] = u_P2_x__Q8_x;
    const double l_Q8_y__P2_x_2 = -inverse_pivot_P2_x_2*l_Q8_y__L7_theta_2*phi_P2_x_L7_theta;
    lin->lu[209] = l_Q8_y__P2_x_2;
    const double u_P2_x__Q8_y = -l_P2_x__L7_theta_2*phi_P2_y_L7_theta;
    lin->lu[210] = u_P2_x__Q8_y;
    const double scale_P2_y_2 = -inverse_L7_mass - inverse_pivot_L2_y - l_P2_y__L2_theta_2*u_L2_theta__P2_y -
        l_P2_y__L7_theta_2*phi_P2_y_L7_theta;
    const double pivot_P2_y_2 = -l_P2_y__P2_x_2*u_P2_x__P2_y + scale_P2_y_2;
    if (!(fabs(pivot_P2_y_2) > 1e-08 * fabs(scale_P2_y_2)))
        return 30;
    const double inverse_pivot_P2_y_2 = 1.0/pivot_P2_y_2;
    lin->lu[211] = inverse_pivot_P2_y_2;
    const double l_P3_x__P2_y_2 = inverse_pivot_P2_y_2*(-l_P3_x__L7_theta_2*phi_P2_y_L7_theta -
        l_P3_x__P2_x_2*u_P2_x__P2_y);
    lin->lu[212] = l_P3_x__P2_y_2;
    const double u_P2_y__P3_x = -l_P2_y__L7_theta_2*phi_P2_x_L7_theta - l_P2_y__P2_x_2*u_P2_x__P3_x;
    lin->lu[213] = u_P2_y__P3_x;
    const double l_P3_y__P2_y_2 = inverse_pivot_P2_y_2*(-inverse_L7_mass -
        l_P3_y__L7_theta_2*phi_P2_y_L7_theta - l_P3_y__P2_x_2*u_P2_x__P2_y);
    lin->lu[214] = l_P3_y__P2_y_2;
    const double u_P2_y__P3_y = -inverse_L7_mass - l_P2_y__L7_theta_2*phi_P2_y_L7_theta -
        l_P2_y__P2_x_2*u_P2_x__P3_y;
    lin->lu[215] = u_P2_y__P3_y;
    const double l_Q6_x__P2_y_2 = inverse_pivot_P2_y_2*(-l_Q6_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q6_x__P2_x_2*u_P2_x__P2_y);
    lin->lu[216] = l_Q6_x__P2_y_2;
    const double u_P2_y__Q6_x = -l_P2_y__L7_theta_2*phi_P2_x_L7_theta - l_P2_y__P2_x_2*u_P2_x__Q6_x;
    lin->lu[217] = u_P2_y__Q6_x;
    const double l_Q6_y__P2_y_2 = inverse_pivot_P2_y_2*(inverse_L7_mass - l_Q6_y__L7_theta_2*phi_P2_y_L7_theta
        - l_Q6_y__P2_x_2*u_P2_x__P2_y);
    lin->lu[218] = l_Q6_y__P2_y_2;
    const double u_P2_y__Q6_y = inverse_L7_mass - l_P2_y__L7_theta_2*phi_P2_y_L7_theta -
        l_P2_y__P2_x_2*u_P2_x__Q6_y;
    lin->lu[219] = u_P2_y__Q6_y;
    const double l_Q8_x__P2_y_2 = inverse_pivot_P2_y_2*(-l_Q8_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q8_x__P2_x_2*u_P2_x__P2_y);
    lin->lu[220] = l_Q8_x__P2_y_2;
    const double u_P2_y__Q8_x = -l_P2_y__L7_theta_2*phi_P2_x_L7_theta - l_P2_y__P2_x_2*u_P2_x__Q8_x;
    lin->lu[221] = u_P2_y__Q8_x;
    const double l_Q8_y__P2_y_2 = inverse_pivot_P2_y_2*(inverse_L7_mass - l_Q8_y__L7_theta_2*phi_P2_y_L7_theta
        - l_Q8_y__P2_x_2*u_P2_x__P2_y);
    lin->lu[222] = l_Q8_y__P2_y_2;
    const double u_P2_y__Q8_y = inverse_L7_mass - l_P2_y__L7_theta_2*phi_P2_y_L7_theta -
        l_P2_y__P2_x_2*u_P2_x__Q8_y;
    lin->lu[223] = u_P2_y__Q8_y;
    const double scale_P3_x_2 = -inverse_L7_mass - inverse_pivot_L3_x + l_L3_y__L3_x*l_P3_x__L3_y -
        l_P3_x__L3_theta_2*u_L3_theta__P3_x - l_P3_x__L4_theta*u_L4_theta__P3_x - l_P3_x__L4_x*u_L4_x__P3_x -
        l_P3_x__L4_y*u_L4_y__P3_x - l_P3_x__L7_theta_2*phi_P2_x_L7_theta;
    const double pivot_P3_x_2 = -l_P3_x__O4_x*u_O4_x__P3_x - l_P3_x__O4_y*u_O4_y__P3_x -
        l_P3_x__P2_x_2*u_P2_x__P3_x - l_P3_x__P2_y_2*u_P2_y__P3_x - l_P3_x__crank4*u_crank4__P3_x +
        scale_P3_x_2;
    if (!(fabs(pivot_P3_x_2) > 1e-08 * fabs(scale_P3_x_2)))
        return 31;
    const double inverse_pivot_P3_x_2 = 1.0/pivot_P3_x_2;
    lin->lu[224] = inverse_pivot_P3_x_2;
    const double l_P3_y__P3_x_2 = inverse_pivot_P3_x_2*(inverse_pivot_L3_y*l_L3_y__L3_x -
        l_P3_y__L3_theta_2*u_L3_theta__P3_x - l_P3_y__L4_theta*u_L4_theta__P3_x - l_P3_y__L4_x*u_L4_x__P3_x -
        l_P3_y__L4_y*u_L4_y__P3_x - l_P3_y__L7_theta_2*phi_P2_x_L7_theta - l_P3_y__O4_x*u_O4_x__P3_x -
        l_P3_y__O4_y*u_O4_y__P3_x - l_P3_y__P2_x_2*u_P2_x__P3_x - l_P3_y__P2_y_2*u_P2_y__P3_x -
        l_P3_y__crank4*u_crank4__P3_x);
    lin->lu[225] = l_P3_y__P3_x_2;
    const double u_P3_x__P3_y = -l_P3_x__L3_theta_2*u_L3_theta__P3_y - l_P3_x__L3_y -
        l_P3_x__L4_theta*u_L4_theta__P3_y - l_P3_x__L4_x*u_L4_x__P3_y - l_P3_x__L4_y*u_L4_y__P3_y -
        l_P3_x__L7_theta_2*phi_P2_y_L7_theta - l_P3_x__O4_x*u_O4_x__P3_y - l_P3_x__O4_y*u_O4_y__P3_y -
        l_P3_x__P2_x_2*u_P2_x__P3_y - l_P3_x__P2_y_2*u_P2_y__P3_y - l_P3_x__crank4*u_crank4__P3_y;
    lin->lu[226] = u_P3_x__P3_y;
    const double l_Q6_x__P3_x_2 = inverse_pivot_P3_x_2*(inverse_L7_mass - l_Q6_x__L7_theta_2*phi_P2_x_L7_theta
        - l_Q6_x__P2_x_2*u_P2_x__P3_x - l_Q6_x__P2_y_2*u_P2_y__P3_x);
    lin->lu[227] = l_Q6_x__P3_x_2;
    const double u_P3_x__Q6_x = inverse_L7_mass - l_P3_x__L7_theta_2*phi_P2_x_L7_theta -
        l_P3_x__P2_x_2*u_P2_x__Q6_x - l_P3_x__P2_y_2*u_P2_y__Q6_x;
    lin->lu[228] = u_P3_x__Q6_x;
    const double l_Q6_y__P3_x_2 = inverse_pivot_P3_x_2*(-l_Q6_y__L7_theta_2*phi_P2_x_L7_theta -
        l_Q6_y__P2_x_2*u_P2_x__P3_x - l_Q6_y__P2_y_2*u_P2_y__P3_x);
    lin->lu[229] = l_Q6_y__P3_x_2;
    const double u_P3_x__Q6_y = -l_P3_x__L7_theta_2*phi_P2_y_L7_theta - l_P3_x__P2_x_2*u_P2_x__Q6_y -
        l_P3_x__P2_y_2*u_P2_y__Q6_y;
    lin->lu[230] = u_P3_x__Q6_y;
    const double l_Q8_x__P3_x_2 = inverse_pivot_P3_x_2*(inverse_L7_mass - l_Q8_x__L7_theta_2*phi_P2_x_L7_theta
        - l_Q8_x__P2_x_2*u_P2_x__P3_x - l_Q8_x__P2_y_2*u_P2_y__P3_x);
    lin->lu[231] = l_Q8_x__P3_x_2;
    const double u_P3_x__Q8_x = inverse_L7_mass - l_P3_x__L7_theta_2*phi_P2_x_L7_theta -
        l_P3_x__P2_x_2*u_P2_x__Q8_x - l_P3_x__P2_y_2*u_P2_y__Q8_x;
    lin->lu[232] = u_P3_x__Q8_x;
    const double l_Q8_y__P3_x_2 = inverse_pivot_P3_x_2*(-l_Q8_y__L7_theta_2*phi_P2_x_L7_theta -
        l_Q8_y__P2_x_2*u_P2_x__P3_x - l_Q8_y__P2_y_2*u_P2_y__P3_x);
    lin->lu[233] = l_Q8_y__P3_x_2;
    const double u_P3_x__Q8_y = -l_P3_x__L7_theta_2*phi_P2_y_L7_theta - l_P3_x__P2_x_2*u_P2_x__Q8_y -
        l_P3_x__P2_y_2*u_P2_y__Q8_y;
    lin->lu[234] = u_P3_x__Q8_y;
    const double scale_P3_y_2 = -inverse_L7_mass - inverse_pivot_L3_y - l_P3_y__L3_theta_2*u_L3_theta__P3_y -
        l_P3_y__L4_theta*u_L4_theta__P3_y - l_P3_y__L4_x*u_L4_x__P3_y - l_P3_y__L4_y*u_L4_y__P3_y -
        l_P3_y__L7_theta_2*phi_P2_y_L7_theta;
    const double pivot_P3_y_2 = -l_P3_y__O4_x*u_O4_x__P3_y - l_P3_y__O4_y*u_O4_y__P3_y -
        l_P3_y__P2_x_2*u_P2_x__P3_y - l_P3_y__P2_y_2*u_P2_y__P3_y - l_P3_y__P3_x_2*u_P3_x__P3_y -
        l_P3_y__crank4*u_crank4__P3_y + scale_P3_y_2;
    if (!(fabs(pivot_P3_y_2) > 1e-08 * fabs(scale_P3_y_2)))
        return 32;
    const double inverse_pivot_P3_y_2 = 1.0/pivot_P3_y_2;
    lin->lu[235] = inverse_pivot_P3_y_2;
    const double l_Q6_x__P3_y_2 = inverse_pivot_P3_y_2*(-l_Q6_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q6_x__P2_x_2*u_P2_x__P3_y - l_Q6_x__P2_y_2*u_P2_y__P3_y - l_Q6_x__P3_x_2*u_P3_x__P3_y);
    lin->lu[236] = l_Q6_x__P3_y_2;
    const double u_P3_y__Q6_x = -l_P3_y__L7_theta_2*phi_P2_x_L7_theta - l_P3_y__P2_x_2*u_P2_x__Q6_x -
        l_P3_y__P2_y_2*u_P2_y__Q6_x - l_P3_y__P3_x_2*u_P3_x__Q6_x;
    lin->lu[237] = u_P3_y__Q6_x;
    const double l_Q6_y__P3_y_2 = inverse_pivot_P3_y_2*(inverse_L7_mass - l_Q6_y__L7_theta_2*phi_P2_y_L7_theta
        - l_Q6_y__P2_x_2*u_P2_x__P3_y - l_Q6_y__P2_y_2*u_P2_y__P3_y - l_Q6_y__P3_x_2*u_P3_x__P3_y);
    lin->lu[238] = l_Q6_y__P3_y_2;
    const double u_P3_y__Q6_y = inverse_L7_mass - l_P3_y__L7_theta_2*phi_P2_y_L7_theta -
        l_P3_y__P2_x_2*u_P2_x__Q6_y - l_P3_y__P2_y_2*u_P2_y__Q6_y - l_P3_y__P3_x_2*u_P3_x__Q6_y;
    lin->lu[239] = u_P3_y__Q6_y;
    const double l_Q8_x__P3_y_2 = inverse_pivot_P3_y_2*(-l_Q8_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q8_x__P2_x_2*u_P2_x__P3_y - l_Q8_x__P2_y_2*u_P2_y__P3_y - l_Q8_x__P3_x_2*u_P3_x__P3_y);
    lin->lu[240] = l_Q8_x__P3_y_2;
    const double u_P3_y__Q8_x = -l_P3_y__L7_theta_2*phi_P2_x_L7_theta - l_P3_y__P2_x_2*u_P2_x__Q8_x -
        l_P3_y__P2_y_2*u_P2_y__Q8_x - l_P3_y__P3_x_2*u_P3_x__Q8_x;
    lin->lu[241] = u_P3_y__Q8_x;
    const double l_Q8_y__P3_y_2 = inverse_pivot_P3_y_2*(inverse_L7_mass - l_Q8_y__L7_theta_2*phi_P2_y_L7_theta
        - l_Q8_y__P2_x_2*u_P2_x__P3_y - l_Q8_y__P2_y_2*u_P2_y__P3_y - l_Q8_y__P3_x_2*u_P3_x__P3_y);
    lin->lu[242] = l_Q8_y__P3_y_2;
    const double u_P3_y__Q8_y = inverse_L7_mass - l_P3_y__L7_theta_2*phi_P2_y_L7_theta -
        l_P3_y__P2_x_2*u_P2_x__Q8_y - l_P3_y__P2_y_2*u_P2_y__Q8_y - l_P3_y__P3_x_2*u_P3_x__Q8_y;
    lin->lu[243] = u_P3_y__Q8_y;
    const double scale_Q6_x_2 = -inverse_L6_mass - inverse_L7_mass - l_Q6_x__L6_theta_2*phi_Q6_x_L6_theta -
        l_Q6_x__L7_theta_2*phi_P2_x_L7_theta;
    const double pivot_Q6_x_2 = -l_Q6_x__O6_x_2*u_O6_x__Q6_x - l_Q6_x__O6_y_2*u_O6_y__Q6_x -
        l_Q6_x__P2_x_2*u_P2_x__Q6_x - l_Q6_x__P2_y_2*u_P2_y__Q6_x - l_Q6_x__P3_x_2*u_P3_x__Q6_x -
        l_Q6_x__P3_y_2*u_P3_y__Q6_x + scale_Q6_x_2;
    if (!(fabs(pivot_Q6_x_2) > 1e-08 * fabs(scale_Q6_x_2)))
        return 33;
    const double inverse_pivot_Q6_x_2 = 1.0/pivot_Q6_x_2;
    lin->lu[244] = inverse_pivot_Q6_x_2;
    const double l_Q6_y__Q6_x_2 = inverse_pivot_Q6_x_2*(-l_Q6_y__L6_theta_2*phi_Q6_x_L6_theta -
        l_Q6_y__L7_theta_2*phi_P2_x_L7_theta - l_Q6_y__O6_x_2*u_O6_x__Q6_x - l_Q6_y__O6_y_2*u_O6_y__Q6_x -
        l_Q6_y__P2_x_2*u_P2_x__Q6_x - l_Q6_y__P2_y_2*u_P2_y__Q6_x - l_Q6_y__P3_x_2*u_P3_x__Q6_x -
        l_Q6_y__P3_y_2*u_P3_y__Q6_x);
    lin->lu[245] = l_Q6_y__Q6_x_2;
    const double u_Q6_x__Q6_y = -l_Q6_x__L6_theta_2*phi_Q6_y_L6_theta - l_Q6_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q6_x__O6_x_2*u_O6_x__Q6_y - l_Q6_x__O6_y_2*u_O6_y__Q6_y - l_Q6_x__P2_x_2*u_P2_x__Q6_y -
        l_Q6_x__P2_y_2*u_P2_y__Q6_y - l_Q6_x__P3_x_2*u_P3_x__Q6_y - l_Q6_x__P3_y_2*u_P3_y__Q6_y;
    lin->lu[246] = u_Q6_x__Q6_y;
    const double l_Q8_x__Q6_x_2 = inverse_pivot_Q6_x_2*(-inverse_L7_mass -
        l_Q8_x__L7_theta_2*phi_P2_x_L7_theta - l_Q8_x__P2_x_2*u_P2_x__Q6_x - l_Q8_x__P2_y_2*u_P2_y__Q6_x -
        l_Q8_x__P3_x_2*u_P3_x__Q6_x - l_Q8_x__P3_y_2*u_P3_y__Q6_x);
    lin->lu[247] = l_Q8_x__Q6_x_2;
    const double u_Q6_x__Q8_x = -inverse_L7_mass - l_Q6_x__L7_theta_2*phi_P2_x_L7_theta -
        l_Q6_x__P2_x_2*u_P2_x__Q8_x - l_Q6_x__P2_y_2*u_P2_y__Q8_x - l_Q6_x__P3_x_2*u_P3_x__Q8_x -
        l_Q6_x__P3_y_2*u_P3_y__Q8_x;
    lin->lu[248] = u_Q6_x__Q8_x;
    const double l_Q8_y__Q6_x_2 = inverse_pivot_Q6_x_2*(-l_Q8_y__L7_theta_2*phi_P2_x_L7_theta -
        l_Q8_y__P2_x_2*u_P2_x__Q6_x - l_Q8_y__P2_y_2*u_P2_y__Q6_x - l_Q8_y__P3_x_2*u_P3_x__Q6_x -
        l_Q8_y__P3_y_2*u_P3_y__Q6_x);
    lin->lu[249] = l_Q8_y__Q6_x_2;
    const double u_Q6_x__Q8_y = -l_Q6_x__L7_theta_2*phi_P2_y_L7_theta - l_Q6_x__P2_x_2*u_P2_x__Q8_y -
        l_Q6_x__P2_y_2*u_P2_y__Q8_y - l_Q6_x__P3_x_2*u_P3_x__Q8_y - l_Q6_x__P3_y_2*u_P3_y__Q8_y;
    lin->lu[250] = u_Q6_x__Q8_y;
    const double scale_Q6_y_2 = -inverse_L6_mass - inverse_L7_mass - l_Q6_y__L6_theta_2*phi_Q6_y_L6_theta -
        l_Q6_y__L7_theta_2*phi_P2_y_L7_theta;
    const double pivot_Q6_y_2 = -l_Q6_y__O6_x_2*u_O6_x__Q6_y - l_Q6_y__O6_y_2*u_O6_y__Q6_y -
        l_Q6_y__P2_x_2*u_P2_x__Q6_y - l_Q6_y__P2_y_2*u_P2_y__Q6_y - l_Q6_y__P3_x_2*u_P3_x__Q6_y -
        l_Q6_y__P3_y_2*u_P3_y__Q6_y - l_Q6_y__Q6_x_2*u_Q6_x__Q6_y + scale_Q6_y_2;
    if (!(fabs(pivot_Q6_y_2) > 1e-08 * fabs(scale_Q6_y_2)))
        return 34;
    const double inverse_pivot_Q6_y_2 = 1.0/pivot_Q6_y_2;
    lin->lu[251] = inverse_pivot_Q6_y_2;
    const double l_Q8_x__Q6_y_2 = inverse_pivot_Q6_y_2*(-l_Q8_x__L7_theta_2*phi_P2_y_L7_theta -
        l_Q8_x__P2_x_2*u_P2_x__Q6_y - l_Q8_x__P2_y_2*u_P2_y__Q6_y - l_Q8_x__P3_x_2*u_P3_x__Q6_y -
        l_Q8_x__P3_y_2*u_P3_y__Q6_y - l_Q8_x__Q6_x_2*u_Q6_x__Q6_y);
    lin->lu[252] = l_Q8_x__Q6_y_2;
    const double u_Q6_y__Q8_x = -l_Q6_y__L7_theta_2*phi_P2_x_L7_theta - l_Q6_y__P2_x_2*u_P2_x__Q8_x -
        l_Q6_y__P2_y_2*u_P2_y__Q8_x - l_Q6_y__P3_x_2*u_P3_x__Q8_x - l_Q6_y__P3_y_2*u_P3_y__Q8_x -
        l_Q6_y__Q6_x_2*u_Q6_x__Q8_x;
    lin->lu[253] = u_Q6_y__Q8_x;
    const double l_Q8_y__Q6_y_2 = inverse_pivot_Q6_y_2*(-inverse_L7_mass -
        l_Q8_y__L7_theta_2*phi_P2_y_L7_theta - l_Q8_y__P2_x_2*u_P2_x__Q6_y - l_Q8_y__P2_y_2*u_P2_y__Q6_y -
        l_Q8_y__P3_x_2*u_P3_x__Q6_y - l_Q8_y__P3_y_2*u_P3_y__Q6_y - l_Q8_y__Q6_x_2*u_Q6_x__Q6_y);
    lin->lu[254] = l_Q8_y__Q6_y_2;
    const double u_Q6_y__Q8_y = -inverse_L7_mass - l_Q6_y__L7_theta_2*phi_P2_y_L7_theta -
        l_Q6_y__P2_x_2*u_P2_x__Q8_y - l_Q6_y__P2_y_2*u_P2_y__Q8_y - l_Q6_y__P3_x_2*u_P3_x__Q8_y -
        l_Q6_y__P3_y_2*u_P3_y__Q8_y - l_Q6_y__Q6_x_2*u_Q6_x__Q8_y;
    lin->lu[255] = u_Q6_y__Q8_y;
    const double scale_Q8_x_2 = -inverse_L7_mass - inverse_L8_mass - l_Q8_x__L7_theta_2*phi_P2_x_L7_theta -
        l_Q8_x__L8_theta_2*phi_Q8_x_L8_theta;
    const double pivot_Q8_x_2 = -l_Q8_x__P2_x_2*u_P2_x__Q8_x - l_Q8_x__P2_y_2*u_P2_y__Q8_x -
        l_Q8_x__P3_x_2*u_P3_x__Q8_x - l_Q8_x__P3_y_2*u_P3_y__Q8_x - l_Q8_x__Q6_x_2*u_Q6_x__Q8_x -
        l_Q8_x__Q6_y_2*u_Q6_y__Q8_x - l_Q8_x__slider_x_2*u_slider_x__Q8_x -
        l_Q8_x__slider_y_2*u_slider_y__Q8_x + scale_Q8_x_2;
    if (!(fabs(pivot_Q8_x_2) > 1e-08 * fabs(scale_Q8_x_2)))
        return 35;
    const double inverse_pivot_Q8_x_2 = 1.0/pivot_Q8_x_2;
    lin->lu[256] = inverse_pivot_Q8_x_2;
    const double l_Q8_y__Q8_x_2 = inverse_pivot_Q8_x_2*(-l_Q8_y__L7_theta_2*phi_P2_x_L7_theta -
        l_Q8_y__L8_theta_2*phi_Q8_x_L8_theta - l_Q8_y__P2_x_2*u_P2_x__Q8_x - l_Q8_y__P2_y_2*u_P2_y__Q8_x -
        l_Q8_y__P3_x_2*u_P3_x__Q8_x - l_Q8_y__P3_y_2*u_P3_y__Q8_x - l_Q8_y__Q6_x_2*u_Q6_x__Q8_x -
        l_Q8_y__Q6_y_2*u_Q6_y__Q8_x - l_Q8_y__slider_x_2*u_slider_x__Q8_x -
        l_Q8_y__slider_y_2*u_slider_y__Q8_x);
    lin->lu[257] = l_Q8_y__Q8_x_2;
    const double u_Q8_x__Q8_y = -l_Q8_x__L7_theta_2*phi_P2_y_L7_theta - l_Q8_x__L8_theta_2*phi_Q8_y_L8_theta -
        l_Q8_x__P2_x_2*u_P2_x__Q8_y - l_Q8_x__P2_y_2*u_P2_y__Q8_y - l_Q8_x__P3_x_2*u_P3_x__Q8_y -
        l_Q8_x__P3_y_2*u_P3_y__Q8_y - l_Q8_x__Q6_x_2*u_Q6_x__Q8_y - l_Q8_x__Q6_y_2*u_Q6_y__Q8_y -
        l_Q8_x__slider_x_2*u_slider_x__Q8_y - l_Q8_x__slider_y_2*u_slider_y__Q8_y;
    lin->lu[258] = u_Q8_x__Q8_y;
    const double scale_Q8_y_2 = -inverse_L7_mass - inverse_L8_mass - l_Q8_y__L7_theta_2*phi_P2_y_L7_theta -
        l_Q8_y__L8_theta_2*phi_Q8_y_L8_theta;
    const double pivot_Q8_y_2 = -l_Q8_y__P2_x_2*u_P2_x__Q8_y - l_Q8_y__P2_y_2*u_P2_y__Q8_y -
        l_Q8_y__P3_x_2*u_P3_x__Q8_y - l_Q8_y__P3_y_2*u_P3_y__Q8_y - l_Q8_y__Q6_x_2*u_Q6_x__Q8_y -
        l_Q8_y__Q6_y_2*u_Q6_y__Q8_y - l_Q8_y__Q8_x_2*u_Q8_x__Q8_y - l_Q8_y__slider_x_2*u_slider_x__Q8_y -
        l_Q8_y__slider_y_2*u_slider_y__Q8_y + scale_Q8_y_2;
    if (!(fabs(pivot_Q8_y_2) > 1e-08 * fabs(scale_Q8_y_2)))
        return 36;
    const double inverse_pivot_Q8_y_2 = 1.0/pivot_Q8_y_2;
    lin->lu[259] = inverse_pivot_Q8_y_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_P2_x_L7_theta = lin->value[5];
    const double phi_P2_y_L7_theta = lin->value[7];
    const double phi_Q6_x_L6_theta = lin->value[10];
    const double phi_Q6_y_L6_theta = lin->value[11];
    const double phi_Q8_x_L8_theta = lin->value[12];
    const double phi_Q8_y_L8_theta = lin->value[13];
    const double inverse_pivot_guide_angle_2 = lin->lu[0];
    const double inverse_pivot_guide_offset_2 = lin->lu[1];
    const double l_slider_x__guide_offset_2 = lin->lu[2];
    const double inverse_pivot_L6_theta = lin->lu[3];
    const double l_O6_x__L6_theta_2 = lin->lu[4];
    const double l_O6_y__L6_theta_2 = lin->lu[5];
    const double l_Q6_x__L6_theta_2 = lin->lu[6];
    const double l_Q6_y__L6_theta_2 = lin->lu[7];
    const double inverse_pivot_O6_x_2 = lin->lu[8];
    const double l_O6_y__O6_x_2 = lin->lu[9];
    const double u_O6_x__O6_y = lin->lu[10];
    const double l_Q6_x__O6_x_2 = lin->lu[11];
    const double u_O6_x__Q6_x = lin->lu[12];
    const double l_Q6_y__O6_x_2 = lin->lu[13];
    const double u_O6_x__Q6_y = lin->lu[14];
    const double inverse_pivot_O6_y_2 = lin->lu[15];
    const double l_Q6_x__O6_y_2 = lin->lu[16];
    const double u_O6_y__Q6_x = lin->lu[17];
    const double l_Q6_y__O6_y_2 = lin->lu[18];
    const double u_O6_y__Q6_y = lin->lu[19];
    const double inverse_pivot_L8_theta = lin->lu[20];
    const double l_slider_x__L8_theta_2 = lin->lu[21];
    const double l_slider_y__L8_theta_2 = lin->lu[22];
    const double l_Q8_x__L8_theta_2 = lin->lu[23];
    const double l_Q8_y__L8_theta_2 = lin->lu[24];
    const double inverse_pivot_slider_x_2 = lin->lu[25];
    const double l_slider_y__slider_x_2 = lin->lu[26];
    const double u_slider_x__slider_y = lin->lu[27];
    const double l_Q8_x__slider_x_2 = lin->lu[28];
    const double u_slider_x__Q8_x = lin->lu[29];
    const double l_Q8_y__slider_x_2 = lin->lu[30];
    const double u_slider_x__Q8_y = lin->lu[31];
    const double inverse_pivot_slider_y_2 = lin->lu[32];
    const double l_Q8_x__slider_y_2 = lin->lu[33];
    const double u_slider_y__Q8_x = lin->lu[34];
    const double l_Q8_y__slider_y_2 = lin->lu[35];
    const double u_slider_y__Q8_y = lin->lu[36];
    const double inverse_pivot_L1_x = lin->lu[37];
    const double l_L1_y__L1_x = lin->lu[38];
    const double n_L1_x__L1_y = lin->lu[39];
    const double l_L1_theta__L1_x = lin->lu[40];
    const double n_L1_x__L1_theta = lin->lu[41];
    const double l_L2_x__L1_x = lin->lu[42];
    const double n_L1_x__L2_x = lin->lu[43];
    const double l_L2_y__L1_x = lin->lu[44];
    const double n_L1_x__L2_y = lin->lu[45];
    const double l_L2_theta__L1_x = lin->lu[46];
    const double n_L1_x__L2_theta = lin->lu[47];
    const double inverse_pivot_L1_y = lin->lu[48];
    const double l_L1_theta__L1_y = lin->lu[49];
    const double u_L1_y__L1_theta = lin->lu[50];
    const double l_O1_x__L1_y = lin->lu[51];
    const double l_L2_x__L1_y = lin->lu[52];
    const double u_L1_y__L2_x = lin->lu[53];
    const double l_L2_y__L1_y = lin->lu[54];
    const double u_L1_y__L2_y = lin->lu[55];
    const double l_L2_theta__L1_y = lin->lu[56];
    const double u_L1_y__L2_theta = lin->lu[57];
    const double inverse_pivot_L1_theta = lin->lu[58];
    const double l_O1_x__L1_theta_2 = lin->lu[59];
    const double u_L1_theta__O1_x = lin->lu[60];
    const double l_O1_y__L1_theta_2 = lin->lu[61];
    const double u_L1_theta__O1_y = lin->lu[62];
    const double l_L2_x__L1_theta = lin->lu[63];
    const double u_L1_theta__L2_x = lin->lu[64];
    const double l_L2_y__L1_theta = lin->lu[65];
    const double u_L1_theta__L2_y = lin->lu[66];
    const double l_L2_theta__L1_theta = lin->lu[67];
    const double u_L1_theta__L2_theta = lin->lu[68];
    const double inverse_pivot_O1_x_2 = lin->lu[69];
    const double l_O1_y__O1_x_2 = lin->lu[70];
    const double u_O1_x__O1_y = lin->lu[71];
    const double l_crank1__O1_x_2 = lin->lu[72];
    const double l_L2_x__O1_x = lin->lu[73];
    const double u_O1_x__L2_x = lin->lu[74];
    const double l_L2_y__O1_x = lin->lu[75];
    const double u_O1_x__L2_y = lin->lu[76];
    const double l_L2_theta__O1_x = lin->lu[77];
    const double u_O1_x__L2_theta = lin->lu[78];
    const double inverse_pivot_O1_y_2 = lin->lu[79];
    const double l_crank1__O1_y_2 = lin->lu[80];
    const double u_O1_y__crank1 = lin->lu[81];
    const double l_L2_x__O1_y = lin->lu[82];
    const double u_O1_y__L2_x = lin->lu[83];
    const double l_L2_y__O1_y = lin->lu[84];
    const double u_O1_y__L2_y = lin->lu[85];
    const double l_L2_theta__O1_y = lin->lu[86];
    const double u_O1_y__L2_theta = lin->lu[87];
    const double inverse_pivot_crank1_2 = lin->lu[88];
    const double l_L2_x__crank1 = lin->lu[89];
    const double u_crank1__L2_x = lin->lu[90];
    const double l_L2_y__crank1 = lin->lu[91];
    const double u_crank1__L2_y = lin->lu[92];
    const double l_L2_theta__crank1 = lin->lu[93];
    const double u_crank1__L2_theta = lin->lu[94];
    const double inverse_pivot_L2_x = lin->lu[95];
    const double l_L2_y__L2_x = lin->lu[96];
    const double u_L2_x__L2_y = lin->lu[97];
    const double l_L2_theta__L2_x = lin->lu[98];
    const double u_L2_x__L2_theta = lin->lu[99];
    const double inverse_pivot_L2_y = lin->lu[100];
    const double l_L2_theta__L2_y = lin->lu[101];
    const double u_L2_y__L2_theta = lin->lu[102];
    const double l_P2_x__L2_y = lin->lu[103];
    const double inverse_pivot_L2_theta = lin->lu[104];
    const double l_P2_x__L2_theta_2 = lin->lu[105];
    const double u_L2_theta__P2_x = lin->lu[106];
    const double l_P2_y__L2_theta_2 = lin->lu[107];
    const double u_L2_theta__P2_y = lin->lu[108];
    const double inverse_pivot_L3_x = lin->lu[109];
    const double l_L3_y__L3_x = lin->lu[110];
    const double n_L3_x__L3_y = lin->lu[111];
    const double l_L3_theta__L3_x = lin->lu[112];
    const double n_L3_x__L3_theta = lin->lu[113];
    const double l_L4_x__L3_x = lin->lu[114];
    const double n_L3_x__L4_x = lin->lu[115];
    const double l_L4_y__L3_x = lin->lu[116];
    const double n_L3_x__L4_y = lin->lu[117];
    const double l_L4_theta__L3_x = lin->lu[118];
    const double n_L3_x__L4_theta = lin->lu[119];
    const double inverse_pivot_L3_y = lin->lu[120];
    const double l_L3_theta__L3_y = lin->lu[121];
    const double u_L3_y__L3_theta = lin->lu[122];
    const double l_L4_x__L3_y = lin->lu[123];
    const double u_L3_y__L4_x = lin->lu[124];
    const double l_L4_y__L3_y = lin->lu[125];
    const double u_L3_y__L4_y = lin->lu[126];
    const double l_L4_theta__L3_y = lin->lu[127];
    const double u_L3_y__L4_theta = lin->lu[128];
    const double l_P3_x__L3_y = lin->lu[129];
    const double inverse_pivot_L3_theta = lin->lu[130];
    const double l_L4_x__L3_theta = lin->lu[131];
    const double u_L3_theta__L4_x = lin->lu[132];
    const double l_L4_y__L3_theta = lin->lu[133];
    const double u_L3_theta__L4_y = lin->lu[134];
    const double l_L4_theta__L3_theta = lin->lu[135];
    const double u_L3_theta__L4_theta = lin->lu[136];
    const double l_P3_x__L3_theta_2 = lin->lu[137];
    const double u_L3_theta__P3_x = lin->lu[138];
    const double l_P3_y__L3_theta_2 = lin->lu[139];
    const double u_L3_theta__P3_y = lin->lu[140];
    const double inverse_pivot_L4_x = lin->lu[141];
    const double l_L4_y__L4_x = lin->lu[142];
    const double u_L4_x__L4_y = lin->lu[143];
    const double l_L4_theta__L4_x = lin->lu[144];
    const double u_L4_x__L4_theta = lin->lu[145];
    const double l_P3_x__L4_x = lin->lu[146];
    const double u_L4_x__P3_x = lin->lu[147];
    const double l_P3_y__L4_x = lin->lu[148];
    const double u_L4_x__P3_y = lin->lu[149];
    const double inverse_pivot_L4_y = lin->lu[150];
    const double l_L4_theta__L4_y = lin->lu[151];
    const double u_L4_y__L4_theta = lin->lu[152];
    const double l_O4_x__L4_y = lin->lu[153];
    const double l_P3_x__L4_y = lin->lu[154];
    const double u_L4_y__P3_x = lin->lu[155];
    const double l_P3_y__L4_y = lin->lu[156];
    const double u_L4_y__P3_y = lin->lu[157];
    const double inverse_pivot_L4_theta = lin->lu[158];
    const double l_O4_x__L4_theta_2 = lin->lu[159];
    const double u_L4_theta__O4_x = lin->lu[160];
    const double l_O4_y__L4_theta_2 = lin->lu[161];
    const double u_L4_theta__O4_y = lin->lu[162];
    const double l_P3_x__L4_theta = lin->lu[163];
    const double u_L4_theta__P3_x = lin->lu[164];
    const double l_P3_y__L4_theta = lin->lu[165];
    const double u_L4_theta__P3_y = lin->lu[166];
    const double inverse_pivot_O4_x_2 = lin->lu[167];
    const double l_O4_y__O4_x_2 = lin->lu[168];
    const double u_O4_x__O4_y = lin->lu[169];
    const double l_crank4__O4_x_2 = lin->lu[170];
    const double l_P3_x__O4_x = lin->lu[171];
    const double u_O4_x__P3_x = lin->lu[172];
    const double l_P3_y__O4_x = lin->lu[173];
    const double u_O4_x__P3_y = lin->lu[174];
    const double inverse_pivot_O4_y_2 = lin->lu[175];
    const double l_crank4__O4_y_2 = lin->lu[176];
    const double u_O4_y__crank4 = lin->lu[177];
    const double l_P3_x__O4_y = lin->lu[178];
    const double u_O4_y__P3_x = lin->lu[179];
    const double l_P3_y__O4_y = lin->lu[180];
    const double u_O4_y__P3_y = lin->lu[181];
    const double inverse_pivot_crank4_2 = lin->lu[182];
    const double l_P3_x__crank4 = lin->lu[183];
    const double u_crank4__P3_x = lin->lu[184];
    const double l_P3_y__crank4 = lin->lu[185];
    const double u_crank4__P3_y = lin->lu[186];
    const double inverse_pivot_L7_theta = lin->lu[187];
    const double l_P2_x__L7_theta_2 = lin->lu[188];
    const double l_P2_y__L7_theta_2 = lin->lu[189];
    const double l_P3_x__L7_theta_2 = lin->lu[190];
    const double l_P3_y__L7_theta_2 = lin->lu[191];
    const double l_Q6_x__L7_theta_2 = lin->lu[192];
    const double l_Q6_y__L7_theta_2 = lin->lu[193];
    const double l_Q8_x__L7_theta_2 = lin->lu[194];
    const double l_Q8_y__L7_theta_2 = lin->lu[195];
    const double inverse_pivot_P2_x_2 = lin->lu[196];
    const double l_P2_y__P2_x_2 = lin->lu[197];
    const double u_P2_x__P2_y = lin->lu[198];
    const double l_P3_x__P2_x_2 = lin->lu[199];
    const double u_P2_x__P3_x = lin->lu[200];
    const double l_P3_y__P2_x_2 = lin->lu[201];
    const double u_P2_x__P3_y = lin->lu[202];
    const double l_Q6_x__P2_x_2 = lin->lu[203];
    const double u_P2_x__Q6_x = lin->lu[204];
    const double l_Q6_y__P2_x_2 = lin->lu[205];
    const double u_P2_x__Q6_y = lin->lu[206];
    const double l_Q8_x__P2_x_2 = lin->lu[207];
    const double u_P2_x__Q8_x = lin->lu[208];
    const double l_Q8_y__P2_x_2 = lin->lu[209];
    const double u_P2_x__Q8_y = lin->lu[210];
    const double inverse_pivot_P2_y_2 = lin->lu[211];
    const double l_P3_x__P2_y_2 = lin->lu[212];
    const double u_P2_y__P3_x = lin->lu[213];
    const double l_P3_y__P2_y_2 = lin->lu[214];
    const double u_P2_y__P3_y = lin->lu[215];
    const double l_Q6_x__P2_y_2 = lin->lu[216];
    const double u_P2_y__Q6_x = lin->lu[217];
    const double l_Q6_y__P2_y_2 = lin->lu[218];
    const double u_P2_y__Q6_y = lin->lu[219];
    const double l_Q8_x__P2_y_2 = lin->lu[220];
    const double u_P2_y__Q8_x = lin->lu[221];
    const double l_Q8_y__P2_y_2 = lin->lu[222];
    const double u_P2_y__Q8_y = lin->lu[223];
    const double inverse_pivot_P3_x_2 = lin->lu[224];
    const double l_P3_y__P3_x_2 = lin->lu[225];
    const double u_P3_x__P3_y = lin->lu[226];
    const double l_Q6_x__P3_x_2 = lin->lu[227];
    const double u_P3_x__Q6_x = lin->lu[228];
    const double l_Q6_y__P3_x_2 = lin->lu[229];
    const double u_P3_x__Q6_y = lin->lu[230];
    const double l_Q8_x__P3_x_2 = lin->lu[231];
    const double u_P3_x__Q8_x = lin->lu[232];
    const double l_Q8_y__P3_x_2 = lin->lu[233];
    const double u_P3_x__Q8_y = lin->lu[234];
    const double inverse_pivot_P3_y_2 = lin->lu[235];
    const double l_Q6_x__P3_y_2 = lin->lu[236];
    const double u_P3_y__Q6_x = lin->lu[237];
    const double l_Q6_y__P3_y_2 = lin->lu[238];
    const double u_P3_y__Q6_y = lin->lu[239];
    const double l_Q8_x__P3_y_2 = lin->lu[240];
    const double u_P3_y__Q8_x = lin->lu[241];
    const double l_Q8_y__P3_y_2 = lin->lu[242];
    const double u_P3_y__Q8_y = lin->lu[243];
    const double inverse_pivot_Q6_x_2 = lin->lu[244];
    const double l_Q6_y__Q6_x_2 = lin->lu[245];
    const double u_Q6_x__Q6_y = lin->lu[246];
    const double l_Q8_x__Q6_x_2 = lin->lu[247];
    const double u_Q6_x__Q8_x = lin->lu[248];
    const double l_Q8_y__Q6_x_2 = lin->lu[249];
    const double u_Q6_x__Q8_y = lin->lu[250];
    const double inverse_pivot_Q6_y_2 = lin->lu[251];
    const double l_Q8_x__Q6_y_2 = lin->lu[252];
    const double u_Q6_y__Q8_x = lin->lu[253];
    const double l_Q8_y__Q6_y_2 = lin->lu[254];
    const double u_Q6_y__Q8_y = lin->lu[255];
    const double inverse_pivot_Q8_x_2 = lin->lu[256];
    const double l_Q8_y__Q8_x_2 = lin->lu[257];
    const double u_Q8_x__Q8_y = lin->lu[258];
    const double inverse_pivot_Q8_y_2 = lin->lu[259];

    /* parameters */
    const double inverse_S9_mass = p->inverse_S9_mass;
    const double inverse_S9_inertia = p->inverse_S9_inertia;
    const double inverse_L6_mass = p->inverse_L6_mass;
    const double inverse_L8_mass = p->inverse_L8_mass;
    const double inverse_L7_mass = p->inverse_L7_mass;

    /* forward */
    const double b_S9_y = x[22];
    const double b_S9_theta = x[23];
    const double b_guide_angle = -b_S9_theta*inverse_S9_inertia + x[41];
    const double b_L6_x = x[12];
    const double b_L6_y = x[13];
    const double b_L8_x = x[18];
    const double b_L8_y = x[19];
    const double b_S9_x = x[21];
    const double b_guide_offset = b_S9_x*inverse_S9_mass + x[40];
    const double b_L6_theta = x[14];
    const double b_O6_x = -b_L6_theta*l_O6_x__L6_theta_2 + b_L6_x*inverse_L6_mass + x[36];
    const double b_O6_y = -b_L6_theta*l_O6_y__L6_theta_2 + b_L6_y*inverse_L6_mass - b_O6_x*l_O6_y__O6_x_2 +
        x[37];
    const double b_L7_x = x[15];
    const double b_L7_y = x[16];
    const double b_L8_theta = x[20];
    const double b_slider_x = -b_L8_theta*l_slider_x__L8_theta_2 - b_L8_x*inverse_L8_mass +
        b_S9_x*inverse_S9_mass - b_guide_offset*l_slider_x__guide_offset_2 + x[38];
    const double b_slider_y = -b_L8_theta*l_slider_y__L8_theta_2 - b_L8_y*inverse_L8_mass +
        b_S9_y*inverse_S9_mass - b_slider_x*l_slider_y__slider_x_2 + x[39];
    const double b_L1_x = x[0];
    const double b_L1_y = -b_L1_x*l_L1_y__L1_x + x[1];
    const double b_L1_theta = -b_L1_x*l_L1_theta__L1_x - b_L1_y*l_L1_theta__L1_y + x[2];
    const double b_O1_x = -b_L1_theta*l_O1_x__L1_theta_2 + b_L1_x*inverse_pivot_L1_x - b_L1_y*l_O1_x__L1_y +
        x[24];
    const double b_O1_y = -b_L1_theta*l_O1_y__L1_theta_2 + b_L1_y*inverse_pivot_L1_y - b_O1_x*l_O1_y__O1_x_2 +
        x[25];
    const double b_crank1 = -b_L1_theta*inverse_pivot_L1_theta - b_O1_x*l_crank1__O1_x_2 -
        b_O1_y*l_crank1__O1_y_2 + x[42];
    const double b_L2_x = -b_L1_theta*l_L2_x__L1_theta - b_L1_x*l_L2_x__L1_x - b_L1_y*l_L2_x__L1_y -
        b_O1_x*l_L2_x__O1_x - b_O1_y*l_L2_x__O1_y - b_crank1*l_L2_x__crank1 + x[3];
    const double b_L2_y = -b_L1_theta*l_L2_y__L1_theta - b_L1_x*l_L2_y__L1_x - b_L1_y*l_L2_y__L1_y -
        b_L2_x*l_L2_y__L2_x - b_O1_x*l_L2_y__O1_x - b_O1_y*l_L2_y__O1_y - b_crank1*l_L2_y__crank1 + x[4];
    const double b_L2_theta = -b_L1_theta*l_L2_theta__L1_theta - b_L1_x*l_L2_theta__L1_x -
        b_L1_y*l_L2_theta__L1_y - b_L2_x*l_L2_theta__L2_x - b_L2_y*l_L2_theta__L2_y - b_O1_x*l_L2_theta__O1_x
        - b_O1_y*l_L2_theta__O1_y - b_crank1*l_L2_theta__crank1 + x[5];
    const double b_L3_x = x[6];
    const double b_L3_y = -b_L3_x*l_L3_y__L3_x + x[7];
    const double b_L3_theta = -b_L3_x*l_L3_theta__L3_x - b_L3_y*l_L3_theta__L3_y + x[8];
    const double b_L4_x = -b_L3_theta*l_L4_x__L3_theta - b_L3_x*l_L4_x__L3_x - b_L3_y*l_L4_x__L3_y + x[9];
    const double b_L4_y = -b_L3_theta*l_L4_y__L3_theta - b_L3_x*l_L4_y__L3_x - b_L3_y*l_L4_y__L3_y -
        b_L4_x*l_L4_y__L4_x + x[10];
    const double b_L4_theta = -b_L3_theta*l_L4_theta__L3_theta - b_L3_x*l_L4_theta__L3_x -
        b_L3_y*l_L4_theta__L3_y - b_L4_x*l_L4_theta__L4_x - b_L4_y*l_L4_theta__L4_y + x[11];
    const double b_O4_x = -b_L4_theta*l_O4_x__L4_theta_2 + b_L4_x*inverse_pivot_L4_x - b_L4_y*l_O4_x__L4_y +
        x[26];
    const double b_O4_y = -b_L4_theta*l_O4_y__L4_theta_2 + b_L4_y*inverse_pivot_L4_y - b_O4_x*l_O4_y__O4_x_2 +
        x[27];
    const double b_crank4 = -b_L4_theta*inverse_pivot_L4_theta - b_O4_x*l_crank4__O4_x_2 -
        b_O4_y*l_crank4__O4_y_2 + x[43];
    const double b_L7_theta = x[17];
    const double b_P2_x = -b_L2_theta*l_P2_x__L2_theta_2 - b_L2_x*inverse_pivot_L2_x - b_L2_y*l_P2_x__L2_y -
        b_L7_theta*l_P2_x__L7_theta_2 + b_L7_x*inverse_L7_mass + x[28];
    const double b_P2_y = -b_L2_theta*l_P2_y__L2_theta_2 - b_L2_y*inverse_pivot_L2_y -
        b_L7_theta*l_P2_y__L7_theta_2 + b_L7_y*inverse_L7_mass - b_P2_x*l_P2_y__P2_x_2 + x[29];
    const double b_P3_x = -b_L3_theta*l_P3_x__L3_theta_2 - b_L3_x*inverse_pivot_L3_x - b_L3_y*l_P3_x__L3_y -
        b_L4_theta*l_P3_x__L4_theta - b_L4_x*l_P3_x__L4_x - b_L4_y*l_P3_x__L4_y -
        b_L7_theta*l_P3_x__L7_theta_2 + b_L7_x*inverse_L7_mass - b_O4_x*l_P3_x__O4_x - b_O4_y*l_P3_x__O4_y -
        b_P2_x*l_P3_x__P2_x_2 - b_P2_y*l_P3_x__P2_y_2 - b_crank4*l_P3_x__crank4 + x[30];
    const double b_P3_y = -b_L3_theta*l_P3_y__L3_theta_2 - b_L3_y*inverse_pivot_L3_y -
        b_L4_theta*l_P3_y__L4_theta - b_L4_x*l_P3_y__L4_x - b_L4_y*l_P3_y__L4_y -
        b_L7_theta*l_P3_y__L7_theta_2 + b_L7_y*inverse_L7_mass - b_O4_x*l_P3_y__O4_x - b_O4_y*l_P3_y__O4_y -
        b_P2_x*l_P3_y__P2_x_2 - b_P2_y*l_P3_y__P2_y_2 - b_P3_x*l_P3_y__P3_x_2 - b_crank4*l_P3_y__crank4 +
        x[31];
    const double b_Q6_x = -b_L6_theta*l_Q6_x__L6_theta_2 + b_L6_x*inverse_L6_mass -
        b_L7_theta*l_Q6_x__L7_theta_2 - b_L7_x*inverse_L7_mass - b_O6_x*l_Q6_x__O6_x_2 - b_O6_y*l_Q6_x__O6_y_2
        - b_P2_x*l_Q6_x__P2_x_2 - b_P2_y*l_Q6_x__P2_y_2 - b_P3_x*l_Q6_x__P3_x_2 - b_P3_y*l_Q6_x__P3_y_2 +
        x[32];
    const double b_Q6_y = -b_L6_theta*l_Q6_y__L6_theta_2 + b_L6_y*inverse_L6_mass -
        b_L7_theta*l_Q6_y__L7_theta_2 - b_L7_y*inverse_L7_mass - b_O6_x*l_Q6_y__O6_x_2 - b_O6_y*l_Q6_y__O6_y_2
        - b_P2_x*l_Q6_y__P2_x_2 - b_P2_y*l_Q6_y__P2_y_2 - b_P3_x*l_Q6_y__P3_x_2 - b_P3_y*l_Q6_y__P3_y_2 -
        b_Q6_x*l_Q6_y__Q6_x_2 + x[33];
    const double b_Q8_x = -b_L7_theta*l_Q8_x__L7_theta_2 - b_L7_x*inverse_L7_mass -
        b_L8_theta*l_Q8_x__L8_theta_2 + b_L8_x*inverse_L8_mass - b_P2_x*l_Q8_x__P2_x_2 - b_P2_y*l_Q8_x__P2_y_2
        - b_P3_x*l_Q8_x__P3_x_2 - b_P3_y*l_Q8_x__P3_y_2 - b_Q6_x*l_Q8_x__Q6_x_2 - b_Q6_y*l_Q8_x__Q6_y_2 -
        b_slider_x*l_Q8_x__slider_x_2 - b_slider_y*l_Q8_x__slider_y_2 + x[34];
    const double b_Q8_y = -b_L7_theta*l_Q8_y__L7_theta_2 - b_L7_y*inverse_L7_mass -
        b_L8_theta*l_Q8_y__L8_theta_2 + b_L8_y*inverse_L8_mass - b_P2_x*l_Q8_y__P2_x_2 - b_P2_y*l_Q8_y__P2_y_2
        - b_P3_x*l_Q8_y__P3_x_2 - b_P3_y*l_Q8_y__P3_y_2 - b_Q6_x*l_Q8_y__Q6_x_2 - b_Q6_y*l_Q8_y__Q6_y_2 -
        b_Q8_x*l_Q8_y__Q8_x_2 - b_slider_x*l_Q8_y__slider_x_2 - b_slider_y*l_Q8_y__slider_y_2 + x[35];

    /* backward */
    const double x_Q8_y = b_Q8_y*inverse_pivot_Q8_y_2;
    x[35] = x_Q8_y;
    const double x_Q8_x = inverse_pivot_Q8_x_2*(b_Q8_x - u_Q8_x__Q8_y*x_Q8_y);
    x[34] = x_Q8_x;
    const double x_Q6_y = inverse_pivot_Q6_y_2*(b_Q6_y - u_Q6_y__Q8_x*x_Q8_x - u_Q6_y__Q8_y*x_Q8_y);
    x[33] = x_Q6_y;
    const double x_Q6_x = inverse_pivot_Q6_x_2*(b_Q6_x - u_Q6_x__Q6_y*x_Q6_y - u_Q6_x__Q8_x*x_Q8_x -
        u_Q6_x__Q8_y*x_Q8_y);
    x[32] = x_Q6_x;
    const double x_P3_y = inverse_pivot_P3_y_2*(b_P3_y - u_P3_y__Q6_x*x_Q6_x - u_P3_y__Q6_y*x_Q6_y -
        u_P3_y__Q8_x*x_Q8_x - u_P3_y__Q8_y*x_Q8_y);
    x[31] = x_P3_y;
    const double x_P3_x = inverse_pivot_P3_x_2*(b_P3_x - u_P3_x__P3_y*x_P3_y - u_P3_x__Q6_x*x_Q6_x -
        u_P3_x__Q6_y*x_Q6_y - u_P3_x__Q8_x*x_Q8_x - u_P3_x__Q8_y*x_Q8_y);
    x[30] = x_P3_x;
    const double x_P2_y = inverse_pivot_P2_y_2*(b_P2_y - u_P2_y__P3_x*x_P3_x - u_P2_y__P3_y*x_P3_y -
        u_P2_y__Q6_x*x_Q6_x - u_P2_y__Q6_y*x_Q6_y - u_P2_y__Q8_x*x_Q8_x - u_P2_y__Q8_y*x_Q8_y);
    x[29] = x_P2_y;
    const double x_P2_x = inverse_pivot_P2_x_2*(b_P2_x - u_P2_x__P2_y*x_P2_y - u_P2_x__P3_x*x_P3_x -
        u_P2_x__P3_y*x_P3_y - u_P2_x__Q6_x*x_Q6_x - u_P2_x__Q6_y*x_Q6_y - u_P2_x__Q8_x*x_Q8_x -
        u_P2_x__Q8_y*x_Q8_y);
    x[28] = x_P2_x;
    const double x_L7_theta = inverse_pivot_L7_theta*(b_L7_theta - phi_P2_x_L7_theta*x_P2_x -
        phi_P2_x_L7_theta*x_P3_x - phi_P2_x_L7_theta*x_Q6_x - phi_P2_x_L7_theta*x_Q8_x -
        phi_P2_y_L7_theta*x_P2_y - phi_P2_y_L7_theta*x_P3_y - phi_P2_y_L7_theta*x_Q6_y -
        phi_P2_y_L7_theta*x_Q8_y);
    x[17] = x_L7_theta;
    const double x_crank4 = inverse_pivot_crank4_2*(b_crank4 - u_crank4__P3_x*x_P3_x - u_crank4__P3_y*x_P3_y);
    x[43] = x_crank4;
    const double x_O4_y = inverse_pivot_O4_y_2*(b_O4_y - u_O4_y__P3_x*x_P3_x - u_O4_y__P3_y*x_P3_y -
        u_O4_y__crank4*x_crank4);
    x[27] = x_O4_y;
    const double x_O4_x = inverse_pivot_O4_x_2*(b_O4_x + l_O4_x__L4_theta_2*x_crank4 - u_O4_x__O4_y*x_O4_y -
        u_O4_x__P3_x*x_P3_x - u_O4_x__P3_y*x_P3_y);
    x[26] = x_O4_x;
    const double x_L4_theta = inverse_pivot_L4_theta*(b_L4_theta - u_L4_theta__O4_x*x_O4_x -
        u_L4_theta__O4_y*x_O4_y - u_L4_theta__P3_x*x_P3_x - u_L4_theta__P3_y*x_P3_y - x_crank4);
    x[11] = x_L4_theta;
    const double x_L4_y = inverse_pivot_L4_y*(b_L4_y - l_L4_y__L4_x*x_O4_x - u_L4_y__L4_theta*x_L4_theta -
        u_L4_y__P3_x*x_P3_x - u_L4_y__P3_y*x_P3_y + x_O4_y);
    x[10] = x_L4_y;
    const double x_L4_x = inverse_pivot_L4_x*(b_L4_x - u_L4_x__L4_theta*x_L4_theta - u_L4_x__L4_y*x_L4_y -
        u_L4_x__P3_x*x_P3_x - u_L4_x__P3_y*x_P3_y + x_O4_x);
    x[9] = x_L4_x;
    const double x_L3_theta = inverse_pivot_L3_theta*(b_L3_theta - u_L3_theta__L4_theta*x_L4_theta -
        u_L3_theta__L4_x*x_L4_x - u_L3_theta__L4_y*x_L4_y - u_L3_theta__P3_x*x_P3_x -
        u_L3_theta__P3_y*x_P3_y);
    x[8] = x_L3_theta;
    const double x_L3_y = inverse_pivot_L3_y*(b_L3_y + l_L3_y__L3_x*x_P3_x - u_L3_y__L3_theta*x_L3_theta -
        u_L3_y__L4_theta*x_L4_theta - u_L3_y__L4_x*x_L4_x - u_L3_y__L4_y*x_L4_y - x_P3_y);
    x[7] = x_L3_y;
    const double x_L3_x = inverse_pivot_L3_x*(b_L3_x - n_L3_x__L3_theta*x_L3_theta - n_L3_x__L3_y*x_L3_y -
        n_L3_x__L4_theta*x_L4_theta - n_L3_x__L4_x*x_L4_x - n_L3_x__L4_y*x_L4_y - x_P3_x);
    x[6] = x_L3_x;
    const double x_L2_theta = inverse_pivot_L2_theta*(b_L2_theta - u_L2_theta__P2_x*x_P2_x -
        u_L2_theta__P2_y*x_P2_y);
    x[5] = x_L2_theta;
    const double x_L2_y = inverse_pivot_L2_y*(b_L2_y + l_L2_y__L2_x*x_P2_x - u_L2_y__L2_theta*x_L2_theta -
        x_P2_y);
    x[4] = x_L2_y;
    const double x_L2_x = inverse_pivot_L2_x*(b_L2_x - u_L2_x__L2_theta*x_L2_theta - u_L2_x__L2_y*x_L2_y -
        x_P2_x);
    x[3] = x_L2_x;
    const double x_crank1 = inverse_pivot_crank1_2*(b_crank1 - u_crank1__L2_theta*x_L2_theta -
        u_crank1__L2_x*x_L2_x - u_crank1__L2_y*x_L2_y);
    x[42] = x_crank1;
    const double x_O1_y = inverse_pivot_O1_y_2*(b_O1_y - u_O1_y__L2_theta*x_L2_theta - u_O1_y__L2_x*x_L2_x -
        u_O1_y__L2_y*x_L2_y - u_O1_y__crank1*x_crank1);
    x[25] = x_O1_y;
    const double x_O1_x = inverse_pivot_O1_x_2*(b_O1_x + l_O1_x__L1_theta_2*x_crank1 -
        u_O1_x__L2_theta*x_L2_theta - u_O1_x__L2_x*x_L2_x - u_O1_x__L2_y*x_L2_y - u_O1_x__O1_y*x_O1_y);
    x[24] = x_O1_x;
    const double x_L1_theta = inverse_pivot_L1_theta*(b_L1_theta - u_L1_theta__L2_theta*x_L2_theta -
        u_L1_theta__L2_x*x_L2_x - u_L1_theta__L2_y*x_L2_y - u_L1_theta__O1_x*x_O1_x - u_L1_theta__O1_y*x_O1_y
        - x_crank1);
    x[2] = x_L1_theta;
    const double x_L1_y = inverse_pivot_L1_y*(b_L1_y - l_L1_y__L1_x*x_O1_x - u_L1_y__L1_theta*x_L1_theta -
        u_L1_y__L2_theta*x_L2_theta - u_L1_y__L2_x*x_L2_x - u_L1_y__L2_y*x_L2_y + x_O1_y);
    x[1] = x_L1_y;
    const double x_L1_x = inverse_pivot_L1_x*(b_L1_x - n_L1_x__L1_theta*x_L1_theta - n_L1_x__L1_y*x_L1_y -
        n_L1_x__L2_theta*x_L2_theta - n_L1_x__L2_x*x_L2_x - n_L1_x__L2_y*x_L2_y + x_O1_x);
    x[0] = x_L1_x;
    const double x_slider_y = inverse_pivot_slider_y_2*(b_slider_y - u_slider_y__Q8_x*x_Q8_x -
        u_slider_y__Q8_y*x_Q8_y);
    x[39] = x_slider_y;
    const double x_slider_x = inverse_pivot_slider_x_2*(b_slider_x - u_slider_x__Q8_x*x_Q8_x -
        u_slider_x__Q8_y*x_Q8_y - u_slider_x__slider_y*x_slider_y);
    x[38] = x_slider_x;
    const double x_L8_theta = inverse_pivot_L8_theta*(b_L8_theta - phi_Q8_x_L8_theta*x_Q8_x -
        phi_Q8_x_L8_theta*x_slider_x - phi_Q8_y_L8_theta*x_Q8_y - phi_Q8_y_L8_theta*x_slider_y);
    x[20] = x_L8_theta;
    const double x_L7_y = inverse_L7_mass*(b_L7_y + x_P2_y + x_P3_y - x_Q6_y - x_Q8_y);
    x[16] = x_L7_y;
    const double x_L7_x = inverse_L7_mass*(b_L7_x + x_P2_x + x_P3_x - x_Q6_x - x_Q8_x);
    x[15] = x_L7_x;
    const double x_O6_y = inverse_pivot_O6_y_2*(b_O6_y - u_O6_y__Q6_x*x_Q6_x - u_O6_y__Q6_y*x_Q6_y);
    x[37] = x_O6_y;
    const double x_O6_x = inverse_pivot_O6_x_2*(b_O6_x - u_O6_x__O6_y*x_O6_y - u_O6_x__Q6_x*x_Q6_x -
        u_O6_x__Q6_y*x_Q6_y);
    x[36] = x_O6_x;
    const double x_L6_theta = inverse_pivot_L6_theta*(b_L6_theta + phi_Q6_x_L6_theta*x_O6_x -
        phi_Q6_x_L6_theta*x_Q6_x + phi_Q6_y_L6_theta*x_O6_y - phi_Q6_y_L6_theta*x_Q6_y);
    x[14] = x_L6_theta;
    const double x_guide_offset = inverse_pivot_guide_offset_2*(b_guide_offset + inverse_S9_mass*x_slider_x);
    x[40] = x_guide_offset;
    const double x_S9_x = inverse_S9_mass*(b_S9_x + x_guide_offset + x_slider_x);
    x[21] = x_S9_x;
    const double x_L8_y = inverse_L8_mass*(b_L8_y + x_Q8_y - x_slider_y);
    x[19] = x_L8_y;
    const double x_L8_x = inverse_L8_mass*(b_L8_x + x_Q8_x - x_slider_x);
    x[18] = x_L8_x;
    const double x_L6_y = inverse_L6_mass*(b_L6_y + x_O6_y + x_Q6_y);
    x[13] = x_L6_y;
    const double x_L6_x = inverse_L6_mass*(b_L6_x + x_O6_x + x_Q6_x);
    x[12] = x_L6_x;
    const double x_guide_angle = b_guide_angle*inverse_pivot_guide_angle_2;
    x[41] = x_guide_angle;
    const double x_S9_theta = inverse_S9_inertia*(b_S9_theta - x_guide_angle);
    x[23] = x_S9_theta;
    const double x_S9_y = inverse_S9_mass*(b_S9_y + x_slider_y);
    x[22] = x_S9_y;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O1_x_L1_theta = lin->value[0];
    const double phi_O1_y_L1_theta = lin->value[1];
    const double phi_O4_x_L4_theta = lin->value[2];
    const double phi_O4_y_L4_theta = lin->value[3];
    const double phi_P2_x_L2_theta = lin->value[4];
    const double phi_P2_x_L7_theta = lin->value[5];
    const double phi_P2_y_L2_theta = lin->value[6];
    const double phi_P2_y_L7_theta = lin->value[7];
    const double phi_P3_x_L3_theta = lin->value[8];
    const double phi_P3_y_L3_theta = lin->value[9];
    const double phi_Q6_x_L6_theta = lin->value[10];
    const double phi_Q6_y_L6_theta = lin->value[11];
    const double phi_Q8_x_L8_theta = lin->value[12];
    const double phi_Q8_y_L8_theta = lin->value[13];
    const double by_q_O1_x_L1_theta = lin->value[14];
    const double by_q_O1_y_L1_theta = lin->value[15];
    const double by_q_O4_x_L4_theta = lin->value[16];
    const double by_q_O4_y_L4_theta = lin->value[17];
    const double by_q_P2_x_L2_theta = lin->value[18];
    const double by_q_P2_x_L7_theta = lin->value[19];
    const double by_q_P2_y_L2_theta = lin->value[20];
    const double by_q_P2_y_L7_theta = lin->value[21];
    const double by_q_P3_x_L3_theta = lin->value[22];
    const double by_q_P3_y_L3_theta = lin->value[23];
    const double by_q_Q6_x_L6_theta = lin->value[24];
    const double by_q_Q6_y_L6_theta = lin->value[25];
    const double by_q_Q8_x_L8_theta = lin->value[26];
    const double by_q_Q8_y_L8_theta = lin->value[27];
    const double by_q_L1_x_L1_x = lin->value[28];
    const double by_q_L1_x_L1_theta = lin->value[29];
    const double by_q_L1_x_L2_theta = lin->value[30];
    const double by_q_L1_x_L1_y = lin->value[31];
    const double by_q_L1_y_L1_x = lin->value[32];
    const double by_q_L1_y_L1_theta = lin->value[33];
    const double by_q_L1_y_L2_theta = lin->value[34];
    const double by_q_L1_y_L1_y = lin->value[35];
    const double by_q_L1_theta_L1_x = lin->value[36];
    const double by_q_L1_theta_L1_theta = lin->value[37];
    const double by_q_L1_theta_L2_theta = lin->value[38];
    const double by_q_L1_theta_L1_y = lin->value[39];
    const double by_q_L2_theta_L1_x = lin->value[40];
    const double by_q_L2_theta_L1_theta = lin->value[41];
    const double by_q_L2_theta_L2_theta = lin->value[42];
    const double by_q_L2_theta_L1_y = lin->value[43];
    const double by_q_L3_x_L3_x = lin->value[44];
    const double by_q_L3_x_L3_theta = lin->value[45];
    const double by_q_L3_x_L4_theta = lin->value[46];
    const double by_q_L3_x_L3_y = lin->value[47];
    const double by_q_L3_y_L3_x = lin->value[48];
    const double by_q_L3_y_L3_theta = lin->value[49];
    const double by_q_L3_y_L4_theta = lin->value[50];
    const double by_q_L3_y_L3_y = lin->value[51];
    const double by_q_L3_theta_L3_x = lin->value[52];
    const double by_q_L3_theta_L3_theta = lin->value[53];
    const double by_q_L3_theta_L4_theta = lin->value[54];
    const double by_q_L3_theta_L3_y = lin->value[55];
    const double by_q_L4_theta_L3_x = lin->value[56];
    const double by_q_L4_theta_L3_theta = lin->value[57];
    const double by_q_L4_theta_L4_theta = lin->value[58];
    const double by_q_L4_theta_L3_y = lin->value[59];
    const double by_q_L6_theta_L6_theta = lin->value[60];
    const double by_q_L7_theta_L7_theta = lin->value[61];
    const double by_q_L8_theta_L8_theta = lin->value[62];
    const double by_t_crank1 = lin->value[109];
    const double by_t_crank4 = lin->value[110];
    const double power_q_2_L1_x = lin->value[111];
    const double power_q_2_L1_theta = lin->value[112];
    const double power_q_2_L2_theta = lin->value[113];
    const double power_q_2_L1_y = lin->value[114];
    const double power_q_2_L3_x = lin->value[115];
    const double power_q_2_L3_theta = lin->value[116];
    const double power_q_2_L4_theta = lin->value[117];
    const double power_q_2_L3_y = lin->value[118];
    const double power_v_2_L1_theta = lin->value[119];
    const double power_v_2_L1_x = lin->value[120];
    const double power_v_2_L2_theta = lin->value[121];
    const double power_v_2_L1_y = lin->value[122];
    const double power_v_2_L3_theta = lin->value[123];
    const double power_v_2_L3_x = lin->value[124];
    const double power_v_2_L4_theta = lin->value[125];
    const double power_v_2_L3_y = lin->value[126];
    const double power_0_crank1 = lin->value[127];
    const double power_0_crank4 = lin->value[128];
    const double power_t_0 = lin->value[129];

    /* parameters */
    const double L1_mass = p->L1_mass;
    const double L1_inertia = p->L1_inertia;
    const double L2_mass = p->L2_mass;
    const double L2_inertia = p->L2_inertia;
    const double L3_mass = p->L3_mass;
    const double L3_inertia = p->L3_inertia;
    const double L4_mass = p->L4_mass;
    const double L4_inertia = p->L4_inertia;
    const double L6_mass = p->L6_mass;
    const double L6_inertia = p->L6_inertia;
    const double L7_mass = p->L7_mass;
    const double L7_inertia = p->L7_inertia;
    const double L8_mass = p->L8_mass;
    const double L8_inertia = p->L8_inertia;
    const double S9_mass = p->S9_mass;
    const double S9_inertia = p->S9_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[44];
    const double shifted_L1_x = -beta_squared*eta*r[0] + r[24];
    const double shifted_L1_y = -beta_squared*eta*r[1] + r[25];
    const double shifted_L1_theta = -beta_squared*eta*r[2] + r[26];
    const double shifted_L2_x = -beta_squared*eta*r[3] + r[27];
    const double shifted_L2_y = -beta_squared*eta*r[4] + r[28];
    const double shifted_L2_theta = -beta_squared*eta*r[5] + r[29];
    const double shifted_L3_x = -beta_squared*eta*r[6] + r[30];
    const double shifted_L3_y = -beta_squared*eta*r[7] + r[31];
    const double shifted_L3_theta = -beta_squared*eta*r[8] + r[32];
    const double shifted_L4_x = -beta_squared*eta*r[9] + r[33];
    const double shifted_L4_y = -beta_squared*eta*r[10] + r[34];
    const double shifted_L4_theta = -beta_squared*eta*r[11] + r[35];
    const double shifted_L6_x = -beta_squared*eta*r[12] + r[36];
    const double shifted_L6_y = -beta_squared*eta*r[13] + r[37];
    const double shifted_L6_theta = -beta_squared*eta*r[14] + r[38];
    const double shifted_L7_x = -beta_squared*eta*r[15] + r[39];
    const double shifted_L7_y = -beta_squared*eta*r[16] + r[40];
    const double shifted_L7_theta = -beta_squared*eta*r[17] + r[41];
    const double shifted_L8_x = -beta_squared*eta*r[18] + r[42];
    const double shifted_L8_y = -beta_squared*eta*r[19] + r[43];
    const double shifted_L8_theta = -beta_squared*eta*r[20] + r[44];
    const double shifted_S9_x = -beta_squared*eta*r[21] + r[45];
    const double shifted_S9_y = -beta_squared*eta*r[22] + r[46];
    const double shifted_S9_theta = -beta_squared*eta*r[23] + r[47];
    x[0] = eta*(L1_mass*r[24] - by_q_L1_x_L1_theta*eta*r[2] - by_q_L1_x_L1_x*eta*r[0] +
        by_q_L1_x_L1_x*eta*r[3] - by_q_L1_x_L1_y*eta*r[1] + by_q_L1_x_L1_y*eta*r[4] -
        by_q_L1_x_L2_theta*eta*r[5]);
    x[1] = eta*(L1_mass*r[25] - by_q_L1_y_L1_theta*eta*r[2] - by_q_L1_y_L1_x*eta*r[0] +
        by_q_L1_y_L1_x*eta*r[3] - by_q_L1_y_L1_y*eta*r[1] + by_q_L1_y_L1_y*eta*r[4] -
        by_q_L1_y_L2_theta*eta*r[5]);
    x[2] = eta*(L1_inertia*r[26] - by_q_L1_theta_L1_theta*eta*r[2] - by_q_L1_theta_L1_x*eta*r[0] +
        by_q_L1_theta_L1_x*eta*r[3] - by_q_L1_theta_L1_y*eta*r[1] + by_q_L1_theta_L1_y*eta*r[4] -
        by_q_L1_theta_L2_theta*eta*r[5]);
    x[3] = eta*(L2_mass*r[27] + by_q_L1_x_L1_theta*eta*r[2] + by_q_L1_x_L1_x*eta*r[0] -
        by_q_L1_x_L1_x*eta*r[3] + by_q_L1_x_L1_y*eta*r[1] - by_q_L1_x_L1_y*eta*r[4] +
        by_q_L1_x_L2_theta*eta*r[5]);
    x[4] = eta*(L2_mass*r[28] + by_q_L1_y_L1_theta*eta*r[2] + by_q_L1_y_L1_x*eta*r[0] -
        by_q_L1_y_L1_x*eta*r[3] + by_q_L1_y_L1_y*eta*r[1] - by_q_L1_y_L1_y*eta*r[4] +
        by_q_L1_y_L2_theta*eta*r[5]);
    x[5] = eta*(L2_inertia*r[29] - by_q_L2_theta_L1_theta*eta*r[2] - by_q_L2_theta_L1_x*eta*r[0] +
        by_q_L2_theta_L1_x*eta*r[3] - by_q_L2_theta_L1_y*eta*r[1] + by_q_L2_theta_L1_y*eta*r[4] -
        by_q_L2_theta_L2_theta*eta*r[5]);
    x[6] = eta*(L3_mass*r[30] - by_q_L3_x_L3_theta*eta*r[8] - by_q_L3_x_L3_x*eta*r[6] +
        by_q_L3_x_L3_x*eta*r[9] + by_q_L3_x_L3_y*eta*r[10] - by_q_L3_x_L3_y*eta*r[7] -
        by_q_L3_x_L4_theta*eta*r[11]);
    x[7] = eta*(L3_mass*r[31] - by_q_L3_y_L3_theta*eta*r[8] - by_q_L3_y_L3_x*eta*r[6] +
        by_q_L3_y_L3_x*eta*r[9] + by_q_L3_y_L3_y*eta*r[10] - by_q_L3_y_L3_y*eta*r[7] -
        by_q_L3_y_L4_theta*eta*r[11]);
    x[8] = eta*(L3_inertia*r[32] - by_q_L3_theta_L3_theta*eta*r[8] - by_q_L3_theta_L3_x*eta*r[6] +
        by_q_L3_theta_L3_x*eta*r[9] + by_q_L3_theta_L3_y*eta*r[10] - by_q_L3_theta_L3_y*eta*r[7] -
        by_q_L3_theta_L4_theta*eta*r[11]);
    x[9] = eta*(L4_mass*r[33] + by_q_L3_x_L3_theta*eta*r[8] + by_q_L3_x_L3_x*eta*r[6] -
        by_q_L3_x_L3_x*eta*r[9] - by_q_L3_x_L3_y*eta*r[10] + by_q_L3_x_L3_y*eta*r[7] +
        by_q_L3_x_L4_theta*eta*r[11]);
    x[10] = eta*(L4_mass*r[34] + by_q_L3_y_L3_theta*eta*r[8] + by_q_L3_y_L3_x*eta*r[6] -
        by_q_L3_y_L3_x*eta*r[9] - by_q_L3_y_L3_y*eta*r[10] + by_q_L3_y_L3_y*eta*r[7] +
        by_q_L3_y_L4_theta*eta*r[11]);
    x[11] = eta*(L4_inertia*r[35] - by_q_L4_theta_L3_theta*eta*r[8] - by_q_L4_theta_L3_x*eta*r[6] +
        by_q_L4_theta_L3_x*eta*r[9] + by_q_L4_theta_L3_y*eta*r[10] - by_q_L4_theta_L3_y*eta*r[7] -
        by_q_L4_theta_L4_theta*eta*r[11]);
    x[12] = L6_mass*eta*r[36];
    x[13] = L6_mass*eta*r[37];
    x[14] = eta*(L6_inertia*r[38] - by_q_L6_theta_L6_theta*eta*r[14]);
    x[15] = L7_mass*eta*r[39];
    x[16] = L7_mass*eta*r[40];
    x[17] = eta*(L7_inertia*r[41] - by_q_L7_theta_L7_theta*eta*r[17]);
    x[18] = L8_mass*eta*r[42];
    x[19] = L8_mass*eta*r[43];
    x[20] = eta*(L8_inertia*r[44] - by_q_L8_theta_L8_theta*eta*r[20]);
    x[21] = S9_mass*eta*r[45];
    x[22] = S9_mass*eta*r[46];
    x[23] = S9_inertia*eta*r[47];
    x[24] = eta_row*(-by_q_O1_x_L1_theta*eta*r[2] + phi_O1_x_L1_theta*shifted_L1_theta - shifted_L1_x);
    x[25] = eta_row*(-by_q_O1_y_L1_theta*eta*r[2] + phi_O1_y_L1_theta*shifted_L1_theta - shifted_L1_y);
    x[26] = eta_row*(-by_q_O4_x_L4_theta*eta*r[11] + phi_O4_x_L4_theta*shifted_L4_theta - shifted_L4_x);
    x[27] = eta_row*(-by_q_O4_y_L4_theta*eta*r[11] + phi_O4_y_L4_theta*shifted_L4_theta - shifted_L4_y);
    x[28] = eta_row*(-by_q_P2_x_L2_theta*eta*r[5] - by_q_P2_x_L7_theta*eta*r[17] +
        phi_P2_x_L2_theta*shifted_L2_theta + phi_P2_x_L7_theta*shifted_L7_theta + shifted_L2_x -
        shifted_L7_x);
    x[29] = eta_row*(-by_q_P2_y_L2_theta*eta*r[5] - by_q_P2_y_L7_theta*eta*r[17] +
        phi_P2_y_L2_theta*shifted_L2_theta + phi_P2_y_L7_theta*shifted_L7_theta + shifted_L2_y -
        shifted_L7_y);
    x[30] = eta_row*(-by_q_P2_x_L7_theta*eta*r[17] - by_q_P3_x_L3_theta*eta*r[8] +
        phi_P2_x_L7_theta*shifted_L7_theta + phi_P3_x_L3_theta*shifted_L3_theta + shifted_L3_x -
        shifted_L7_x);
    x[31] = eta_row*(-by_q_P2_y_L7_theta*eta*r[17] - by_q_P3_y_L3_theta*eta*r[8] +
        phi_P2_y_L7_theta*shifted_L7_theta + phi_P3_y_L3_theta*shifted_L3_theta + shifted_L3_y -
        shifted_L7_y);
    x[32] = eta_row*(-by_q_P2_x_L7_theta*eta*r[17] - by_q_Q6_x_L6_theta*eta*r[14] +
        phi_P2_x_L7_theta*shifted_L7_theta + phi_Q6_x_L6_theta*shifted_L6_theta - shifted_L6_x +
        shifted_L7_x);
    x[33] = eta_row*(-by_q_P2_y_L7_theta*eta*r[17] - by_q_Q6_y_L6_theta*eta*r[14] +
        phi_P2_y_L7_theta*shifted_L7_theta + phi_Q6_y_L6_theta*shifted_L6_theta - shifted_L6_y +
        shifted_L7_y);
    x[34] = eta_row*(-by_q_P2_x_L7_theta*eta*r[17] - by_q_Q8_x_L8_theta*eta*r[20] +
        phi_P2_x_L7_theta*shifted_L7_theta + phi_Q8_x_L8_theta*shifted_L8_theta + shifted_L7_x -
        shifted_L8_x);
    x[35] = eta_row*(-by_q_P2_y_L7_theta*eta*r[17] - by_q_Q8_y_L8_theta*eta*r[20] +
        phi_P2_y_L7_theta*shifted_L7_theta + phi_Q8_y_L8_theta*shifted_L8_theta + shifted_L7_y -
        shifted_L8_y);
    x[36] = eta_row*(by_q_Q6_x_L6_theta*eta*r[14] - phi_Q6_x_L6_theta*shifted_L6_theta - shifted_L6_x);
    x[37] = eta_row*(by_q_Q6_y_L6_theta*eta*r[14] - phi_Q6_y_L6_theta*shifted_L6_theta - shifted_L6_y);
    x[38] = eta_row*(-by_q_Q8_x_L8_theta*eta*r[20] + phi_Q8_x_L8_theta*shifted_L8_theta + shifted_L8_x -
        shifted_S9_x);
    x[39] = eta_row*(-by_q_Q8_y_L8_theta*eta*r[20] + phi_Q8_y_L8_theta*shifted_L8_theta + shifted_L8_y -
        shifted_S9_y);
    x[40] = -eta_row*shifted_S9_x;
    x[41] = eta_row*shifted_S9_theta;
    x[42] = eta_row*(-by_t_crank1*s + shifted_L1_theta);
    x[43] = eta_row*(-by_t_crank4*s + shifted_L4_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[24] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[25] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[26] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[27] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[28] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[29] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[30] = x[6];
    u[7] = eta*(r[7] + x[7]);
    u[31] = x[7];
    u[8] = eta*(r[8] + x[8]);
    u[32] = x[8];
    u[9] = eta*(r[9] + x[9]);
    u[33] = x[9];
    u[10] = eta*(r[10] + x[10]);
    u[34] = x[10];
    u[11] = eta*(r[11] + x[11]);
    u[35] = x[11];
    u[12] = eta*(r[12] + x[12]);
    u[36] = x[12];
    u[13] = eta*(r[13] + x[13]);
    u[37] = x[13];
    u[14] = eta*(r[14] + x[14]);
    u[38] = x[14];
    u[15] = eta*(r[15] + x[15]);
    u[39] = x[15];
    u[16] = eta*(r[16] + x[16]);
    u[40] = x[16];
    u[17] = eta*(r[17] + x[17]);
    u[41] = x[17];
    u[18] = eta*(r[18] + x[18]);
    u[42] = x[18];
    u[19] = eta*(r[19] + x[19]);
    u[43] = x[19];
    u[20] = eta*(r[20] + x[20]);
    u[44] = x[20];
    u[21] = eta*(r[21] + x[21]);
    u[45] = x[21];
    u[22] = eta*(r[22] + x[22]);
    u[46] = x[22];
    u[23] = eta*(r[23] + x[23]);
    u[47] = x[23];
    u[48] = eta*(power_t_0*s + r[48]) + power_0_crank1*x[42] + power_0_crank4*x[43];
    u[49] = eta*r[49];
    u[50] = eta*(power_q_2_L1_theta*u[2] + power_q_2_L1_x*u[0] - power_q_2_L1_x*u[3] + power_q_2_L1_y*u[1] -
        power_q_2_L1_y*u[4] + power_q_2_L2_theta*u[5] + power_q_2_L3_theta*u[8] + power_q_2_L3_x*u[6] -
        power_q_2_L3_x*u[9] - power_q_2_L3_y*u[10] + power_q_2_L3_y*u[7] + power_q_2_L4_theta*u[11] +
        power_v_2_L1_theta*u[26] + power_v_2_L1_x*u[24] - power_v_2_L1_x*u[27] + power_v_2_L1_y*u[25] -
        power_v_2_L1_y*u[28] + power_v_2_L2_theta*u[29] + power_v_2_L3_theta*u[32] + power_v_2_L3_x*u[30] -
        power_v_2_L3_x*u[33] + power_v_2_L3_y*u[31] - power_v_2_L3_y*u[34] + power_v_2_L4_theta*u[35] +
        r[50]);
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {24, 0, 130, 1}, {24, 2, 0, 1}, {25, 1, 130, 1}, {25, 2, 1, 1}, {26, 9, 130, 1}, {26, 11, 2, 1}, {27, 10,
    130, 1}, {27, 11, 3, 1}, {28, 3, 130, -1}, {28, 5, 4, 1}, {28, 15, 130, 1}, {28, 17, 5, 1}, {29, 4, 130,
    -1}, {29, 5, 6, 1}, {29, 16, 130, 1}, {29, 17, 7, 1}, {30, 6, 130, -1}, {30, 8, 8, 1}, {30, 15, 130, 1},
    {30, 17, 5, 1}, {31, 7, 130, -1}, {31, 8, 9, 1}, {31, 16, 130, 1}, {31, 17, 7, 1}, {32, 15, 130, -1}, {32,
    17, 5, 1}, {32, 12, 130, 1}, {32, 14, 10, 1}, {33, 16, 130, -1}, {33, 17, 7, 1}, {33, 13, 130, 1}, {33,
    14, 11, 1}, {34, 15, 130, -1}, {34, 17, 5, 1}, {34, 18, 130, 1}, {34, 20, 12, 1}, {35, 16, 130, -1}, {35,
    17, 7, 1}, {35, 19, 130, 1}, {35, 20, 13, 1}, {36, 12, 130, 1}, {36, 14, 10, -1}, {37, 13, 130, 1}, {37,
    14, 11, -1}, {38, 18, 130, -1}, {38, 20, 12, 1}, {38, 21, 130, 1}, {39, 19, 130, -1}, {39, 20, 13, 1},
    {39, 22, 130, 1}, {40, 21, 130, 1}, {41, 23, 130, -1}, {42, 2, 130, -1}, {43, 11, 130, -1}
};
static const LinearEntry residual_entries[] = {
    {24, 2, 14, 1}, {25, 2, 15, 1}, {26, 11, 16, 1}, {27, 11, 17, 1}, {28, 5, 18, 1}, {28, 17, 19, 1}, {29, 5,
    20, 1}, {29, 17, 21, 1}, {30, 8, 22, 1}, {30, 17, 19, 1}, {31, 8, 23, 1}, {31, 17, 21, 1}, {32, 14, 24,
    1}, {32, 17, 19, 1}, {33, 14, 25, 1}, {33, 17, 21, 1}, {34, 17, 19, 1}, {34, 20, 26, 1}, {35, 17, 21, 1},
    {35, 20, 27, 1}, {36, 14, 24, -1}, {37, 14, 25, -1}, {38, 20, 26, 1}, {39, 20, 27, 1}, {0, 0, 28, 1}, {0,
    3, 28, -1}, {0, 2, 29, 1}, {0, 5, 30, 1}, {0, 1, 31, 1}, {0, 4, 31, -1}, {1, 0, 32, 1}, {1, 3, 32, -1},
    {1, 2, 33, 1}, {1, 5, 34, 1}, {1, 1, 35, 1}, {1, 4, 35, -1}, {2, 0, 36, 1}, {2, 3, 36, -1}, {2, 2, 37, 1},
    {2, 5, 38, 1}, {2, 1, 39, 1}, {2, 4, 39, -1}, {3, 0, 28, -1}, {3, 3, 28, 1}, {3, 2, 29, -1}, {3, 5, 30,
    -1}, {3, 1, 31, -1}, {3, 4, 31, 1}, {4, 0, 32, -1}, {4, 3, 32, 1}, {4, 2, 33, -1}, {4, 5, 34, -1}, {4, 1,
    35, -1}, {4, 4, 35, 1}, {5, 0, 40, 1}, {5, 3, 40, -1}, {5, 2, 41, 1}, {5, 5, 42, 1}, {5, 1, 43, 1}, {5, 4,
    43, -1}, {6, 6, 44, 1}, {6, 9, 44, -1}, {6, 8, 45, 1}, {6, 11, 46, 1}, {6, 7, 47, 1}, {6, 10, 47, -1}, {7,
    6, 48, 1}, {7, 9, 48, -1}, {7, 8, 49, 1}, {7, 11, 50, 1}, {7, 7, 51, 1}, {7, 10, 51, -1}, {8, 6, 52, 1},
    {8, 9, 52, -1}, {8, 8, 53, 1}, {8, 11, 54, 1}, {8, 7, 55, 1}, {8, 10, 55, -1}, {9, 6, 44, -1}, {9, 9, 44,
    1}, {9, 8, 45, -1}, {9, 11, 46, -1}, {9, 7, 47, -1}, {9, 10, 47, 1}, {10, 6, 48, -1}, {10, 9, 48, 1}, {10,
    8, 49, -1}, {10, 11, 50, -1}, {10, 7, 51, -1}, {10, 10, 51, 1}, {11, 6, 56, 1}, {11, 9, 56, -1}, {11, 8,
    57, 1}, {11, 11, 58, 1}, {11, 7, 59, 1}, {11, 10, 59, -1}, {14, 14, 60, 1}, {17, 17, 61, 1}, {20, 20, 62,
    1}, {24, 26, 63, 1}, {25, 26, 64, 1}, {26, 35, 65, 1}, {27, 35, 66, 1}, {28, 29, 67, 1}, {28, 41, 68, 1},
    {29, 29, 69, 1}, {29, 41, 70, 1}, {30, 32, 71, 1}, {30, 41, 68, 1}, {31, 32, 72, 1}, {31, 41, 70, 1}, {32,
    38, 73, 1}, {32, 41, 68, 1}, {33, 38, 74, 1}, {33, 41, 70, 1}, {34, 41, 68, 1}, {34, 44, 75, 1}, {35, 41,
    70, 1}, {35, 44, 76, 1}, {36, 38, 73, -1}, {37, 38, 74, -1}, {38, 44, 75, 1}, {39, 44, 76, 1}, {0, 26, 77,
    1}, {0, 24, 78, 1}, {0, 29, 79, 1}, {0, 27, 78, -1}, {0, 25, 80, 1}, {0, 28, 80, -1}, {1, 26, 81, 1}, {1,
    24, 82, 1}, {1, 29, 83, 1}, {1, 27, 82, -1}, {1, 25, 84, 1}, {1, 28, 84, -1}, {2, 26, 85, 1}, {2, 24, 86,
    1}, {2, 29, 87, 1}, {2, 27, 86, -1}, {2, 25, 88, 1}, {2, 28, 88, -1}, {3, 26, 77, -1}, {3, 24, 78, -1},
    {3, 29, 79, -1}, {3, 27, 78, 1}, {3, 25, 80, -1}, {3, 28, 80, 1}, {4, 26, 81, -1}, {4, 24, 82, -1}, {4,
    29, 83, -1}, {4, 27, 82, 1}, {4, 25, 84, -1}, {4, 28, 84, 1}, {5, 26, 89, 1}, {5, 24, 90, 1}, {5, 29, 91,
    1}, {5, 27, 90, -1}, {5, 25, 92, 1}, {5, 28, 92, -1}, {6, 32, 93, 1}, {6, 30, 94, 1}, {6, 35, 95, 1}, {6,
    33, 94, -1}, {6, 31, 96, 1}, {6, 34, 96, -1}, {7, 32, 97, 1}, {7, 30, 98, 1}, {7, 35, 99, 1}, {7, 33, 98,
    -1}, {7, 31, 100, 1}, {7, 34, 100, -1}, {8, 32, 101, 1}, {8, 30, 102, 1}, {8, 35, 103, 1}, {8, 33, 102,
    -1}, {8, 31, 104, 1}, {8, 34, 104, -1}, {9, 32, 93, -1}, {9, 30, 94, -1}, {9, 35, 95, -1}, {9, 33, 94, 1},
    {9, 31, 96, -1}, {9, 34, 96, 1}, {10, 32, 97, -1}, {10, 30, 98, -1}, {10, 35, 99, -1}, {10, 33, 98, 1},
    {10, 31, 100, -1}, {10, 34, 100, 1}, {11, 32, 105, 1}, {11, 30, 106, 1}, {11, 35, 107, 1}, {11, 33, 106,
    -1}, {11, 31, 108, 1}, {11, 34, 108, -1}
};
static const LinearEntry residual_t_entries[] = {
    {42, 0, 109, 1}, {43, 0, 110, 1}
};
static const LinearEntry power_entries[] = {
    {2, 0, 111, 1}, {2, 3, 111, -1}, {2, 2, 112, 1}, {2, 5, 113, 1}, {2, 1, 114, 1}, {2, 4, 114, -1}, {2, 6,
    115, 1}, {2, 9, 115, -1}, {2, 8, 116, 1}, {2, 11, 117, 1}, {2, 7, 118, 1}, {2, 10, 118, -1}, {2, 26, 119,
    1}, {2, 24, 120, 1}, {2, 29, 121, 1}, {2, 27, 120, -1}, {2, 25, 122, 1}, {2, 28, 122, -1}, {2, 32, 123,
    1}, {2, 30, 124, 1}, {2, 35, 125, 1}, {2, 33, 124, -1}, {2, 31, 126, 1}, {2, 34, 126, -1}
};
static const LinearEntry power_row_entries[] = {
    {0, 42, 127, 1}, {0, 43, 128, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 129, 1}
};
enum {
    N_PHI_Q = 54,
    N_RESIDUAL = 195,
    N_RESIDUAL_T = 2,
    N_POWER = 24,
    N_POWER_ROW = 2,
    N_POWER_T = 1,
    N_NODES = 44,
};
/*
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_Q - 1) or of R1_t, R2_t (2 N_Q); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_Q; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_Q; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_Q && (column >= N_Q || at->row < N_Q + N_ROWS)) {
            x[at->row] -= gain[column / N_Q] * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_Q; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_Q; k++) {
        out[k * stride] = column == N_Q + k ? 1.0 : 0.0;
        out[(N_Q + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_Q + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_Q + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_Q + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_Q; i++)
        out[(2 * N_Q + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now;
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = state_equation(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_Q, &now, p, dy + N_Q, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {((const Parameters *)p)->beta_squared, ((const Parameters *)p)->two_alpha};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_Q; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_Q ? J + column : f_t, column < 2 * N_Q ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_Q + w] = 0.0;
    return 0;
}

/* (1/eta - J) u = r + s f_t at a state. */
int gudgeon_newton(double t, const double *y, const double *memory, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear lin;
    const int status = linearized(t, y, memory, (const Parameters *)p, eta, &lin);
    if (status)
        return status;
    newton_solve(&lin, eta, s, r, u);
    return 0;
}
