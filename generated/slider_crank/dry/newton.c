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
 * Joint wristpin, dry: F along n and t, M_i, M_j, and their derivatives by e, deltadot, de_t,
 * omega_i, omega_j (forward differentiation of the same steps).
 */
static inline void dry_slopes_wristpin(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, PinSlopes *out)
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

    /* contact of joint wristpin */
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
 * Joint wristpin: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_wristpin(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_wristpin(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, out);
}

static void tangent_wristpin(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance) {
        const double n_x = e_x / e, n_y = e_y / e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_wristpin(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, 1.0 / e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_wristpin(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_wristpin(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
    dF[0][1] = -F.slope[1][0];
    dF[1][1] = F.slope[0][0];
    dF[2][1] = F.slope[2][0];
    dF[3][1] = F.slope[3][0];
}
/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[52]; /* what linearize() found */
    double lu[82];    /* L, U and inverse pivots */
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
    const double crank_theta = q[2];
    const double crank_omega = v[2];
    const double rod_x = q[3];
    const double rod_y = q[4];
    const double rod_theta = q[5];
    const double rod_vx = v[3];
    const double rod_vy = v[4];
    const double rod_omega = v[5];
    const double slider_x = q[6];
    const double slider_y = q[7];
    const double slider_vx = v[6];
    const double slider_vy = v[7];
    const double slider_omega = v[8];
    const double acceleration_crank_theta_2 = a[2];
    const double acceleration_rod_theta_2 = a[5];
    const double multiplier_O_x_2 = aside->lambda[0];
    const double multiplier_O_y_2 = aside->lambda[1];
    const double multiplier_crankpin_x_2 = aside->lambda[2];
    const double multiplier_crankpin_y_2 = aside->lambda[3];
    const double multiplier_motor_2 = aside->lambda[6];
    const double wristpin_Fx = aside->clearance[0].Fx;
    const double wristpin_Fy = aside->clearance[0].Fy;
    const double wristpin_moment_first = aside->clearance[0].moment_first;
    const double wristpin_moment_second = aside->clearance[0].moment_second;

    /* parameters */
    const double omega = p->omega;
    const double crank_head_x = p->crank_head_x;
    const double rod_head_x = p->rod_head_x;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* directions, arms, drives */
    const double cos_theta_crank = cos(crank_theta);
    const double sin_theta_crank = sin(crank_theta);
    const double arm_crank_head_x = cos_theta_crank*crank_head_x;
    const double arm_crank_head_y = crank_head_x*sin_theta_crank;
    const double cos_theta_rod = cos(rod_theta);
    const double sin_theta_rod = sin(rod_theta);
    const double arm_rod_head_x = cos_theta_rod*rod_head_x;
    const double arm_rod_head_y = rod_head_x*sin_theta_rod;
    const double motor_rate = omega;
    const double motor_acceleration = 0.0;

    /* clearance joint wristpin */
    const double e_wristpin_x_2 = -arm_rod_head_x - rod_x + slider_x;
    const double e_wristpin_y_2 = -arm_rod_head_y - rod_y + slider_y;
    const double edot_wristpin_x_2 = arm_rod_head_y*rod_omega - rod_vx + slider_vx;
    const double edot_wristpin_y_2 = -arm_rod_head_x*rod_omega - rod_vy + slider_vy;
    double slopes_wristpin[4][6];
    tangent_wristpin(e_wristpin_x_2, e_wristpin_y_2, edot_wristpin_x_2, edot_wristpin_y_2, rod_omega, slider_omega, &memory->latch[0], p, side, g, slopes_wristpin);
    const double wristpin_Fx_by_e_x = slopes_wristpin[0][0];
    const double wristpin_Fx_by_e_y = slopes_wristpin[0][1];
    const double wristpin_Fx_by_de_x = slopes_wristpin[0][2];
    const double wristpin_Fx_by_de_y = slopes_wristpin[0][3];
    const double wristpin_Fx_by_omega_i = slopes_wristpin[0][4];
    const double wristpin_Fx_by_omega_j = slopes_wristpin[0][5];
    const double wristpin_Fx_by_rod_theta = arm_rod_head_x*rod_omega*wristpin_Fx_by_de_x -
        arm_rod_head_x*wristpin_Fx_by_e_y + arm_rod_head_y*rod_omega*wristpin_Fx_by_de_y +
        arm_rod_head_y*wristpin_Fx_by_e_x;
    const double wristpin_Fx_by_rod_omega = -arm_rod_head_x*wristpin_Fx_by_de_y +
        arm_rod_head_y*wristpin_Fx_by_de_x + wristpin_Fx_by_omega_i;
    const double wristpin_Fy_by_e_x = slopes_wristpin[1][0];
    const double wristpin_Fy_by_e_y = slopes_wristpin[1][1];
    const double wristpin_Fy_by_de_x = slopes_wristpin[1][2];
    const double wristpin_Fy_by_de_y = slopes_wristpin[1][3];
    const double wristpin_Fy_by_omega_i = slopes_wristpin[1][4];
    const double wristpin_Fy_by_omega_j = slopes_wristpin[1][5];
    const double wristpin_Fy_by_rod_theta = arm_rod_head_x*rod_omega*wristpin_Fy_by_de_x -
        arm_rod_head_x*wristpin_Fy_by_e_y + arm_rod_head_y*rod_omega*wristpin_Fy_by_de_y +
        arm_rod_head_y*wristpin_Fy_by_e_x;
    const double wristpin_Fy_by_rod_omega = -arm_rod_head_x*wristpin_Fy_by_de_y +
        arm_rod_head_y*wristpin_Fy_by_de_x + wristpin_Fy_by_omega_i;
    const double wristpin_moment_first_by_e_x = slopes_wristpin[2][0];
    const double wristpin_moment_first_by_e_y = slopes_wristpin[2][1];
    const double wristpin_moment_first_by_de_x = slopes_wristpin[2][2];
    const double wristpin_moment_first_by_de_y = slopes_wristpin[2][3];
    const double wristpin_moment_first_by_omega_i = slopes_wristpin[2][4];
    const double wristpin_moment_first_by_omega_j = slopes_wristpin[2][5];
    const double wristpin_moment_first_by_rod_theta = arm_rod_head_x*rod_omega*wristpin_moment_first_by_de_x -
        arm_rod_head_x*wristpin_moment_first_by_e_y + arm_rod_head_y*rod_omega*wristpin_moment_first_by_de_y +
        arm_rod_head_y*wristpin_moment_first_by_e_x;
    const double wristpin_moment_first_by_rod_omega = -arm_rod_head_x*wristpin_moment_first_by_de_y +
        arm_rod_head_y*wristpin_moment_first_by_de_x + wristpin_moment_first_by_omega_i;
    const double wristpin_moment_second_by_e_x = slopes_wristpin[3][0];
    const double wristpin_moment_second_by_e_y = slopes_wristpin[3][1];
    const double wristpin_moment_second_by_de_x = slopes_wristpin[3][2];
    const double wristpin_moment_second_by_de_y = slopes_wristpin[3][3];
    const double wristpin_moment_second_by_omega_i = slopes_wristpin[3][4];
    const double wristpin_moment_second_by_omega_j = slopes_wristpin[3][5];
    const double wristpin_moment_second_by_rod_theta = arm_rod_head_x*rod_omega*wristpin_moment_second_by_de_x
        - arm_rod_head_x*wristpin_moment_second_by_e_y +
        arm_rod_head_y*rod_omega*wristpin_moment_second_by_de_y +
        arm_rod_head_y*wristpin_moment_second_by_e_x;
    const double wristpin_moment_second_by_rod_omega = -arm_rod_head_x*wristpin_moment_second_by_de_y +
        arm_rod_head_y*wristpin_moment_second_by_de_x + wristpin_moment_second_by_omega_i;

    /* results */
    lin->value[0] = -arm_crank_head_y;
    lin->value[1] = arm_crank_head_x;
    lin->value[2] = -arm_rod_head_y;
    lin->value[3] = arm_rod_head_x;
    lin->value[4] = -acceleration_crank_theta_2*arm_crank_head_x - arm_crank_head_x*crank_omega*two_alpha +
        arm_crank_head_y*(crank_omega * crank_omega);
    lin->value[5] = -acceleration_crank_theta_2*arm_crank_head_y - arm_crank_head_x*(crank_omega *
        crank_omega) - arm_crank_head_y*crank_omega*two_alpha;
    lin->value[6] = -acceleration_rod_theta_2*arm_rod_head_x - arm_rod_head_x*rod_omega*two_alpha +
        arm_rod_head_y*(rod_omega * rod_omega);
    lin->value[7] = -acceleration_rod_theta_2*arm_rod_head_y - arm_rod_head_x*(rod_omega * rod_omega) -
        arm_rod_head_y*rod_omega*two_alpha;
    lin->value[8] = arm_crank_head_x*(-multiplier_O_x_2 - multiplier_crankpin_x_2) -
        arm_crank_head_y*(multiplier_O_y_2 + multiplier_crankpin_y_2);
    lin->value[9] = wristpin_Fx_by_rod_theta;
    lin->value[10] = -wristpin_Fx_by_e_x;
    lin->value[11] = -wristpin_Fx_by_e_y;
    lin->value[12] = wristpin_Fy_by_rod_theta;
    lin->value[13] = -wristpin_Fy_by_e_x;
    lin->value[14] = -wristpin_Fy_by_e_y;
    lin->value[15] = arm_rod_head_x*wristpin_Fy_by_rod_theta + arm_rod_head_x*(-multiplier_crankpin_x_2 -
        wristpin_Fx) - arm_rod_head_y*wristpin_Fx_by_rod_theta - arm_rod_head_y*(multiplier_crankpin_y_2 +
        wristpin_Fy) - wristpin_moment_first_by_rod_theta;
    lin->value[16] = -arm_rod_head_x*wristpin_Fy_by_e_x + arm_rod_head_y*wristpin_Fx_by_e_x +
        wristpin_moment_first_by_e_x;
    lin->value[17] = -arm_rod_head_x*wristpin_Fy_by_e_y + arm_rod_head_y*wristpin_Fx_by_e_y +
        wristpin_moment_first_by_e_y;
    lin->value[18] = -wristpin_moment_second_by_rod_theta;
    lin->value[19] = wristpin_moment_second_by_e_x;
    lin->value[20] = wristpin_moment_second_by_e_y;
    lin->value[21] = -2.0*arm_crank_head_x*crank_omega;
    lin->value[22] = -2.0*arm_crank_head_y*crank_omega;
    lin->value[23] = -2.0*arm_rod_head_x*rod_omega;
    lin->value[24] = -2.0*arm_rod_head_y*rod_omega;
    lin->value[25] = wristpin_Fx_by_rod_omega;
    lin->value[26] = -wristpin_Fx_by_de_x;
    lin->value[27] = -wristpin_Fx_by_de_y;
    lin->value[28] = wristpin_Fx_by_omega_j;
    lin->value[29] = wristpin_Fy_by_rod_omega;
    lin->value[30] = -wristpin_Fy_by_de_x;
    lin->value[31] = -wristpin_Fy_by_de_y;
    lin->value[32] = wristpin_Fy_by_omega_j;
    lin->value[33] = arm_rod_head_x*wristpin_Fy_by_rod_omega - arm_rod_head_y*wristpin_Fx_by_rod_omega -
        wristpin_moment_first_by_rod_omega;
    lin->value[34] = -arm_rod_head_x*wristpin_Fy_by_de_x + arm_rod_head_y*wristpin_Fx_by_de_x +
        wristpin_moment_first_by_de_x;
    lin->value[35] = -arm_rod_head_x*wristpin_Fy_by_de_y + arm_rod_head_y*wristpin_Fx_by_de_y +
        wristpin_moment_first_by_de_y;
    lin->value[36] = arm_rod_head_x*wristpin_Fy_by_omega_j - arm_rod_head_y*wristpin_Fx_by_omega_j -
        wristpin_moment_first_by_omega_j;
    lin->value[37] = -wristpin_moment_second_by_rod_omega;
    lin->value[38] = wristpin_moment_second_by_de_x;
    lin->value[39] = wristpin_moment_second_by_de_y;
    lin->value[40] = -wristpin_moment_second_by_omega_j;
    lin->value[41] = -beta_squared*motor_rate - motor_acceleration*two_alpha;
    lin->value[42] = arm_rod_head_x*rod_omega*wristpin_Fx + arm_rod_head_y*rod_omega*wristpin_Fy +
        rod_omega*wristpin_moment_first_by_rod_theta + slider_omega*wristpin_moment_second_by_rod_theta +
        wristpin_Fx_by_rod_theta*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) +
        wristpin_Fy_by_rod_theta*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy);
    lin->value[43] = -rod_omega*wristpin_moment_first_by_e_x - slider_omega*wristpin_moment_second_by_e_x -
        wristpin_Fx_by_e_x*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) -
        wristpin_Fy_by_e_x*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy);
    lin->value[44] = -rod_omega*wristpin_moment_first_by_e_y - slider_omega*wristpin_moment_second_by_e_y -
        wristpin_Fx_by_e_y*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) -
        wristpin_Fy_by_e_y*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy);
    lin->value[45] = -arm_rod_head_x*wristpin_Fy + arm_rod_head_y*wristpin_Fx +
        rod_omega*wristpin_moment_first_by_rod_omega + slider_omega*wristpin_moment_second_by_rod_omega +
        wristpin_Fx_by_rod_omega*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) +
        wristpin_Fy_by_rod_omega*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy) + wristpin_moment_first;
    lin->value[46] = -rod_omega*wristpin_moment_first_by_de_x - slider_omega*wristpin_moment_second_by_de_x -
        wristpin_Fx - wristpin_Fx_by_de_x*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) -
        wristpin_Fy_by_de_x*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy);
    lin->value[47] = -rod_omega*wristpin_moment_first_by_de_y - slider_omega*wristpin_moment_second_by_de_y -
        wristpin_Fx_by_de_y*(arm_rod_head_y*rod_omega - rod_vx + slider_vx) - wristpin_Fy -
        wristpin_Fy_by_de_y*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy);
    lin->value[48] = rod_omega*wristpin_moment_first_by_omega_j +
        slider_omega*wristpin_moment_second_by_omega_j + wristpin_Fx_by_omega_j*(arm_rod_head_y*rod_omega -
        rod_vx + slider_vx) + wristpin_Fy_by_omega_j*(-arm_rod_head_x*rod_omega - rod_vy + slider_vy) +
        wristpin_moment_second;
    lin->value[49] = -motor_rate;
    lin->value[50] = -motor_acceleration*multiplier_motor_2;
    lin->value[51] = -1.0;
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
    const double phi_O_x_crank_theta = lin->value[0];
    const double phi_O_y_crank_theta = lin->value[1];
    const double phi_crankpin_x_rod_theta = lin->value[2];
    const double phi_crankpin_y_rod_theta = lin->value[3];
    const double by_q_O_x_crank_theta = lin->value[4];
    const double by_q_O_y_crank_theta = lin->value[5];
    const double by_q_crankpin_x_rod_theta = lin->value[6];
    const double by_q_crankpin_y_rod_theta = lin->value[7];
    const double by_q_crank_theta_crank_theta = lin->value[8];
    const double by_q_rod_x_rod_theta = lin->value[9];
    const double by_q_rod_x_rod_x = lin->value[10];
    const double by_q_rod_x_rod_y = lin->value[11];
    const double by_q_rod_y_rod_theta = lin->value[12];
    const double by_q_rod_y_rod_x = lin->value[13];
    const double by_q_rod_y_rod_y = lin->value[14];
    const double by_q_rod_theta_rod_theta = lin->value[15];
    const double by_q_rod_theta_rod_x = lin->value[16];
    const double by_q_rod_theta_rod_y = lin->value[17];
    const double by_q_slider_theta_rod_theta = lin->value[18];
    const double by_q_slider_theta_rod_x = lin->value[19];
    const double by_q_slider_theta_rod_y = lin->value[20];
    const double by_v_O_x_crank_theta = lin->value[21];
    const double by_v_O_y_crank_theta = lin->value[22];
    const double by_v_crankpin_x_rod_theta = lin->value[23];
    const double by_v_crankpin_y_rod_theta = lin->value[24];
    const double by_v_rod_x_rod_theta = lin->value[25];
    const double by_v_rod_x_rod_x = lin->value[26];
    const double by_v_rod_x_rod_y = lin->value[27];
    const double by_v_rod_x_slider_theta = lin->value[28];
    const double by_v_rod_y_rod_theta = lin->value[29];
    const double by_v_rod_y_rod_x = lin->value[30];
    const double by_v_rod_y_rod_y = lin->value[31];
    const double by_v_rod_y_slider_theta = lin->value[32];
    const double by_v_rod_theta_rod_theta = lin->value[33];
    const double by_v_rod_theta_rod_x = lin->value[34];
    const double by_v_rod_theta_rod_y = lin->value[35];
    const double by_v_rod_theta_slider_theta = lin->value[36];
    const double by_v_slider_theta_rod_theta = lin->value[37];
    const double by_v_slider_theta_rod_x = lin->value[38];
    const double by_v_slider_theta_rod_y = lin->value[39];
    const double by_v_slider_theta_slider_theta = lin->value[40];

    /* parameters */
    const double crank_inertia = p->crank_inertia;
    const double rod_mass = p->rod_mass;
    const double rod_inertia = p->rod_inertia;
    const double slider_mass = p->slider_mass;
    const double slider_inertia = p->slider_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;
    const double inverse_crank_mass = p->inverse_crank_mass;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* matrix */
    const double n_crank_theta__crank_theta = by_q_crank_theta_crank_theta*(eta * eta) + crank_inertia;
    const double n_rod_x__rod_x = eta*(by_q_rod_x_rod_x*eta + by_v_rod_x_rod_x) + rod_mass;
    const double n_rod_x__rod_y = eta*(by_q_rod_x_rod_y*eta + by_v_rod_x_rod_y);
    const double n_rod_x__rod_theta = eta*(by_q_rod_x_rod_theta*eta + by_v_rod_x_rod_theta);
    const double n_rod_x__slider_x = eta*(-by_q_rod_x_rod_x*eta - by_v_rod_x_rod_x);
    const double n_rod_x__slider_y = eta*(-by_q_rod_x_rod_y*eta - by_v_rod_x_rod_y);
    const double n_rod_x__slider_theta = by_v_rod_x_slider_theta*eta;
    const double n_rod_y__rod_x = eta*(by_q_rod_y_rod_x*eta + by_v_rod_y_rod_x);
    const double n_rod_y__rod_y = eta*(by_q_rod_y_rod_y*eta + by_v_rod_y_rod_y) + rod_mass;
    const double n_rod_y__rod_theta = eta*(by_q_rod_y_rod_theta*eta + by_v_rod_y_rod_theta);
    const double n_rod_y__slider_x = eta*(-by_q_rod_y_rod_x*eta - by_v_rod_y_rod_x);
    const double n_rod_y__slider_y = eta*(-by_q_rod_y_rod_y*eta - by_v_rod_y_rod_y);
    const double n_rod_y__slider_theta = by_v_rod_y_slider_theta*eta;
    const double n_rod_theta__rod_x = eta*(by_q_rod_theta_rod_x*eta + by_v_rod_theta_rod_x);
    const double n_rod_theta__rod_y = eta*(by_q_rod_theta_rod_y*eta + by_v_rod_theta_rod_y);
    const double n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta) +
        rod_inertia;
    const double n_rod_theta__slider_x = eta*(-by_q_rod_theta_rod_x*eta - by_v_rod_theta_rod_x);
    const double n_rod_theta__slider_y = eta*(-by_q_rod_theta_rod_y*eta - by_v_rod_theta_rod_y);
    const double n_rod_theta__slider_theta = by_v_rod_theta_slider_theta*eta;
    const double n_slider_x__rod_x = eta*(-by_q_rod_x_rod_x*eta - by_v_rod_x_rod_x);
    const double n_slider_x__rod_y = eta*(-by_q_rod_x_rod_y*eta - by_v_rod_x_rod_y);
    const double n_slider_x__rod_theta = eta*(-by_q_rod_x_rod_theta*eta - by_v_rod_x_rod_theta);
    const double n_slider_x__slider_x = eta*(by_q_rod_x_rod_x*eta + by_v_rod_x_rod_x) + slider_mass;
    const double n_slider_x__slider_y = eta*(by_q_rod_x_rod_y*eta + by_v_rod_x_rod_y);
    const double n_slider_x__slider_theta = -by_v_rod_x_slider_theta*eta;
    const double n_slider_y__rod_x = eta*(-by_q_rod_y_rod_x*eta - by_v_rod_y_rod_x);
    const double n_slider_y__rod_y = eta*(-by_q_rod_y_rod_y*eta - by_v_rod_y_rod_y);
    const double n_slider_y__rod_theta = eta*(-by_q_rod_y_rod_theta*eta - by_v_rod_y_rod_theta);
    const double n_slider_y__slider_x = eta*(by_q_rod_y_rod_x*eta + by_v_rod_y_rod_x);
    const double n_slider_y__slider_y = eta*(by_q_rod_y_rod_y*eta + by_v_rod_y_rod_y) + slider_mass;
    const double n_slider_y__slider_theta = -by_v_rod_y_slider_theta*eta;
    const double n_slider_theta__rod_x = eta*(by_q_slider_theta_rod_x*eta + by_v_slider_theta_rod_x);
    const double n_slider_theta__rod_y = eta*(by_q_slider_theta_rod_y*eta + by_v_slider_theta_rod_y);
    const double n_slider_theta__rod_theta = eta*(by_q_slider_theta_rod_theta*eta +
        by_v_slider_theta_rod_theta);
    const double n_slider_theta__slider_x = eta*(-by_q_slider_theta_rod_x*eta - by_v_slider_theta_rod_x);
    const double n_slider_theta__slider_y = eta*(-by_q_slider_theta_rod_y*eta - by_v_slider_theta_rod_y);
    const double n_slider_theta__slider_theta = by_v_slider_theta_slider_theta*eta + slider_inertia;
    const double n_O_x__crank_theta = eta_row*(by_q_O_x_crank_theta*eta + by_v_O_x_crank_theta) +
        phi_O_x_crank_theta;
    const double n_O_y__crank_theta = eta_row*(by_q_O_y_crank_theta*eta + by_v_O_y_crank_theta) +
        phi_O_y_crank_theta;
    const double n_crankpin_x__crank_theta = eta_row*(by_q_O_x_crank_theta*eta + by_v_O_x_crank_theta) +
        phi_O_x_crank_theta;
    const double n_crankpin_x__rod_theta = eta_row*(by_q_crankpin_x_rod_theta*eta + by_v_crankpin_x_rod_theta)
        + phi_crankpin_x_rod_theta;
    const double n_crankpin_y__crank_theta = eta_row*(by_q_O_y_crank_theta*eta + by_v_O_y_crank_theta) +
        phi_O_y_crank_theta;
    const double n_crankpin_y__rod_theta = eta_row*(by_q_crankpin_y_rod_theta*eta + by_v_crankpin_y_rod_theta)
        + phi_crankpin_y_rod_theta;

    /* L U */
    const double scale_crank_theta = n_crank_theta__crank_theta;
    if (!(fabs(scale_crank_theta) > 1e-13 * fabs(n_crank_theta__crank_theta)))
        return 3;
    const double inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[0] = inverse_pivot_crank_theta;
    const double l_O_x__crank_theta_2 = inverse_pivot_crank_theta*n_O_x__crank_theta;
    lin->lu[1] = l_O_x__crank_theta_2;
    const double l_O_y__crank_theta_2 = inverse_pivot_crank_theta*n_O_y__crank_theta;
    lin->lu[2] = l_O_y__crank_theta_2;
    const double l_crankpin_x__crank_theta_2 = inverse_pivot_crank_theta*n_crankpin_x__crank_theta;
    lin->lu[3] = l_crankpin_x__crank_theta_2;
    const double l_crankpin_y__crank_theta_2 = inverse_pivot_crank_theta*n_crankpin_y__crank_theta;
    lin->lu[4] = l_crankpin_y__crank_theta_2;
    const double scale_O_x_2 = -inverse_crank_mass - l_O_x__crank_theta_2*phi_O_x_crank_theta;
    if (!(fabs(scale_O_x_2) > 1e-08 * fabs(scale_O_x_2)))
        return 10;
    const double inverse_pivot_O_x_2 = 1.0/scale_O_x_2;
    lin->lu[5] = inverse_pivot_O_x_2;
    const double l_O_y__O_x_2 = -inverse_pivot_O_x_2*l_O_y__crank_theta_2*phi_O_x_crank_theta;
    lin->lu[6] = l_O_y__O_x_2;
    const double u_O_x__O_y = -l_O_x__crank_theta_2*phi_O_y_crank_theta;
    lin->lu[7] = u_O_x__O_y;
    const double l_motor__O_x_2 = -inverse_pivot_O_x_2*inverse_pivot_crank_theta*phi_O_x_crank_theta;
    lin->lu[8] = l_motor__O_x_2;
    const double l_crankpin_x__O_x_2 = inverse_pivot_O_x_2*(inverse_crank_mass -
        l_crankpin_x__crank_theta_2*phi_O_x_crank_theta);
    lin->lu[9] = l_crankpin_x__O_x_2;
    const double u_O_x__crankpin_x = inverse_crank_mass - l_O_x__crank_theta_2*phi_O_x_crank_theta;
    lin->lu[10] = u_O_x__crankpin_x;
    const double l_crankpin_y__O_x_2 = -inverse_pivot_O_x_2*l_crankpin_y__crank_theta_2*phi_O_x_crank_theta;
    lin->lu[11] = l_crankpin_y__O_x_2;
    const double u_O_x__crankpin_y = -l_O_x__crank_theta_2*phi_O_y_crank_theta;
    lin->lu[12] = u_O_x__crankpin_y;
    const double scale_O_y_2 = -inverse_crank_mass - l_O_y__crank_theta_2*phi_O_y_crank_theta;
    const double pivot_O_y_2 = -l_O_y__O_x_2*u_O_x__O_y + scale_O_y_2;
    if (!(fabs(pivot_O_y_2) > 1e-08 * fabs(scale_O_y_2)))
        return 11;
    const double inverse_pivot_O_y_2 = 1.0/pivot_O_y_2;
    lin->lu[13] = inverse_pivot_O_y_2;
    const double l_motor__O_y_2 = inverse_pivot_O_y_2*(-inverse_pivot_crank_theta*phi_O_y_crank_theta -
        l_motor__O_x_2*u_O_x__O_y);
    lin->lu[14] = l_motor__O_y_2;
    const double u_O_y__motor = l_O_x__crank_theta_2*l_O_y__O_x_2 - l_O_y__crank_theta_2;
    lin->lu[15] = u_O_y__motor;
    const double l_crankpin_x__O_y_2 = inverse_pivot_O_y_2*(-l_crankpin_x__O_x_2*u_O_x__O_y -
        l_crankpin_x__crank_theta_2*phi_O_y_crank_theta);
    lin->lu[16] = l_crankpin_x__O_y_2;
    const double u_O_y__crankpin_x = -l_O_y__O_x_2*u_O_x__crankpin_x -
        l_O_y__crank_theta_2*phi_O_x_crank_theta;
    lin->lu[17] = u_O_y__crankpin_x;
    const double l_crankpin_y__O_y_2 = inverse_pivot_O_y_2*(inverse_crank_mass -
        l_crankpin_y__O_x_2*u_O_x__O_y - l_crankpin_y__crank_theta_2*phi_O_y_crank_theta);
    lin->lu[18] = l_crankpin_y__O_y_2;
    const double u_O_y__crankpin_y = inverse_crank_mass - l_O_y__O_x_2*u_O_x__crankpin_y -
        l_O_y__crank_theta_2*phi_O_y_crank_theta;
    lin->lu[19] = u_O_y__crankpin_y;
    const double scale_motor_2 = -inverse_pivot_crank_theta;
    const double pivot_motor_2 = l_O_x__crank_theta_2*l_motor__O_x_2 - l_motor__O_y_2*u_O_y__motor +
        scale_motor_2;
    if (!(fabs(pivot_motor_2) > 1e-08 * fabs(scale_motor_2)))
        return 16;
    const double inverse_pivot_motor_2 = 1.0/pivot_motor_2;
    lin->lu[20] = inverse_pivot_motor_2;
    const double l_crankpin_x__motor = inverse_pivot_motor_2*(l_O_x__crank_theta_2*l_crankpin_x__O_x_2 -
        l_crankpin_x__O_y_2*u_O_y__motor - l_crankpin_x__crank_theta_2);
    lin->lu[21] = l_crankpin_x__motor;
    const double u_motor__crankpin_x = -inverse_pivot_crank_theta*phi_O_x_crank_theta -
        l_motor__O_x_2*u_O_x__crankpin_x - l_motor__O_y_2*u_O_y__crankpin_x;
    lin->lu[22] = u_motor__crankpin_x;
    const double l_crankpin_y__motor = inverse_pivot_motor_2*(l_O_x__crank_theta_2*l_crankpin_y__O_x_2 -
        l_crankpin_y__O_y_2*u_O_y__motor - l_crankpin_y__crank_theta_2);
    lin->lu[23] = l_crankpin_y__motor;
    const double u_motor__crankpin_y = -inverse_pivot_crank_theta*phi_O_y_crank_theta -
        l_motor__O_x_2*u_O_x__crankpin_y - l_motor__O_y_2*u_O_y__crankpin_y;
    lin->lu[24] = u_motor__crankpin_y;
    const double scale_slider_x = n_slider_x__slider_x;
    if (!(fabs(scale_slider_x) > 1e-13 * fabs(n_slider_x__slider_x)))
        return 7;
    const double inverse_pivot_slider_x = 1.0/scale_slider_x;
    lin->lu[25] = inverse_pivot_slider_x;
    const double l_rod_x__slider_x = inverse_pivot_slider_x*n_rod_x__slider_x;
    lin->lu[26] = l_rod_x__slider_x;
    lin->lu[27] = n_slider_x__rod_x;
    const double l_rod_y__slider_x = inverse_pivot_slider_x*n_rod_y__slider_x;
    lin->lu[28] = l_rod_y__slider_x;
    lin->lu[29] = n_slider_x__rod_y;
    const double l_rod_theta__slider_x = inverse_pivot_slider_x*n_rod_theta__slider_x;
    lin->lu[30] = l_rod_theta__slider_x;
    lin->lu[31] = n_slider_x__rod_theta;
    const double l_slider_y__slider_x = inverse_pivot_slider_x*n_slider_y__slider_x;
    lin->lu[32] = l_slider_y__slider_x;
    lin->lu[33] = n_slider_x__slider_y;
    const double l_slider_theta__slider_x = inverse_pivot_slider_x*n_slider_theta__slider_x;
    lin->lu[34] = l_slider_theta__slider_x;
    lin->lu[35] = n_slider_x__slider_theta;
    const double scale_rod_x = -l_rod_x__slider_x*n_slider_x__rod_x + n_rod_x__rod_x;
    if (!(fabs(scale_rod_x) > 1e-13 * fabs(n_rod_x__rod_x)))
        return 4;
    const double inverse_pivot_rod_x = 1.0/scale_rod_x;
    lin->lu[36] = inverse_pivot_rod_x;
    const double l_rod_y__rod_x = inverse_pivot_rod_x*(-l_rod_y__slider_x*n_slider_x__rod_x + n_rod_y__rod_x);
    lin->lu[37] = l_rod_y__rod_x;
    const double u_rod_x__rod_y = -l_rod_x__slider_x*n_slider_x__rod_y + n_rod_x__rod_y;
    lin->lu[38] = u_rod_x__rod_y;
    const double l_rod_theta__rod_x = inverse_pivot_rod_x*(-l_rod_theta__slider_x*n_slider_x__rod_x +
        n_rod_theta__rod_x);
    lin->lu[39] = l_rod_theta__rod_x;
    const double u_rod_x__rod_theta = -l_rod_x__slider_x*n_slider_x__rod_theta + n_rod_x__rod_theta;
    lin->lu[40] = u_rod_x__rod_theta;
    const double l_slider_y__rod_x = inverse_pivot_rod_x*(-l_slider_y__slider_x*n_slider_x__rod_x +
        n_slider_y__rod_x);
    lin->lu[41] = l_slider_y__rod_x;
    const double u_rod_x__slider_y = -l_rod_x__slider_x*n_slider_x__slider_y + n_rod_x__slider_y;
    lin->lu[42] = u_rod_x__slider_y;
    const double l_slider_theta__rod_x = inverse_pivot_rod_x*(-l_slider_theta__slider_x*n_slider_x__rod_x +
        n_slider_theta__rod_x);
    lin->lu[43] = l_slider_theta__rod_x;
    const double u_rod_x__slider_theta = -l_rod_x__slider_x*n_slider_x__slider_theta + n_rod_x__slider_theta;
    lin->lu[44] = u_rod_x__slider_theta;
    const double scale_rod_y = -l_rod_y__rod_x*u_rod_x__rod_y - l_rod_y__slider_x*n_slider_x__rod_y +
        n_rod_y__rod_y;
    if (!(fabs(scale_rod_y) > 1e-13 * fabs(n_rod_y__rod_y)))
        return 5;
    const double inverse_pivot_rod_y = 1.0/scale_rod_y;
    lin->lu[45] = inverse_pivot_rod_y;
    const double l_rod_theta__rod_y = inverse_pivot_rod_y*(-l_rod_theta__rod_x*u_rod_x__rod_y -
        l_rod_theta__slider_x*n_slider_x__rod_y + n_rod_theta__rod_y);
    lin->lu[46] = l_rod_theta__rod_y;
    const double u_rod_y__rod_theta = -l_rod_y__rod_x*u_rod_x__rod_theta -
        l_rod_y__slider_x*n_slider_x__rod_theta + n_rod_y__rod_theta;
    lin->lu[47] = u_rod_y__rod_theta;
    const double l_crankpin_x__rod_y = inverse_pivot_rod_x*inverse_pivot_rod_y*u_rod_x__rod_y;
    lin->lu[48] = l_crankpin_x__rod_y;
    const double l_slider_y__rod_y = inverse_pivot_rod_y*(-l_slider_y__rod_x*u_rod_x__rod_y -
        l_slider_y__slider_x*n_slider_x__rod_y + n_slider_y__rod_y);
    lin->lu[49] = l_slider_y__rod_y;
    const double u_rod_y__slider_y = -l_rod_y__rod_x*u_rod_x__slider_y -
        l_rod_y__slider_x*n_slider_x__slider_y + n_rod_y__slider_y;
    lin->lu[50] = u_rod_y__slider_y;
    const double l_slider_theta__rod_y = inverse_pivot_rod_y*(-l_slider_theta__rod_x*u_rod_x__rod_y -
        l_slider_theta__slider_x*n_slider_x__rod_y + n_slider_theta__rod_y);
    lin->lu[51] = l_slider_theta__rod_y;
    const double u_rod_y__slider_theta = -l_rod_y__rod_x*u_rod_x__slider_theta -
        l_rod_y__slider_x*n_slider_x__slider_theta + n_rod_y__slider_theta;
    lin->lu[52] = u_rod_y__slider_theta;
    const double scale_rod_theta = -l_rod_theta__rod_x*u_rod_x__rod_theta -
        l_rod_theta__rod_y*u_rod_y__rod_theta - l_rod_theta__slider_x*n_slider_x__rod_theta +
        n_rod_theta__rod_theta;
    if (!(fabs(scale_rod_theta) > 1e-13 * fabs(n_rod_theta__rod_theta)))
        return 6;
    const double inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[53] = inverse_pivot_rod_theta;
    const double l_crankpin_x__rod_theta_2 = inverse_pivot_rod_theta*(inverse_pivot_rod_x*u_rod_x__rod_theta -
        l_crankpin_x__rod_y*u_rod_y__rod_theta + n_crankpin_x__rod_theta);
    lin->lu[54] = l_crankpin_x__rod_theta_2;
    const double u_rod_theta__crankpin_x = l_rod_theta__rod_x - l_rod_theta__rod_y*l_rod_y__rod_x +
        phi_crankpin_x_rod_theta;
    lin->lu[55] = u_rod_theta__crankpin_x;
    const double l_crankpin_y__rod_theta_2 = inverse_pivot_rod_theta*(inverse_pivot_rod_y*u_rod_y__rod_theta +
        n_crankpin_y__rod_theta);
    lin->lu[56] = l_crankpin_y__rod_theta_2;
    const double u_rod_theta__crankpin_y = l_rod_theta__rod_y + phi_crankpin_y_rod_theta;
    lin->lu[57] = u_rod_theta__crankpin_y;
    const double l_slider_y__rod_theta = inverse_pivot_rod_theta*(-l_slider_y__rod_x*u_rod_x__rod_theta -
        l_slider_y__rod_y*u_rod_y__rod_theta - l_slider_y__slider_x*n_slider_x__rod_theta +
        n_slider_y__rod_theta);
    lin->lu[58] = l_slider_y__rod_theta;
    const double u_rod_theta__slider_y = -l_rod_theta__rod_x*u_rod_x__slider_y -
        l_rod_theta__rod_y*u_rod_y__slider_y - l_rod_theta__slider_x*n_slider_x__slider_y +
        n_rod_theta__slider_y;
    lin->lu[59] = u_rod_theta__slider_y;
    const double l_slider_theta__rod_theta =
        inverse_pivot_rod_theta*(-l_slider_theta__rod_x*u_rod_x__rod_theta -
        l_slider_theta__rod_y*u_rod_y__rod_theta - l_slider_theta__slider_x*n_slider_x__rod_theta +
        n_slider_theta__rod_theta);
    lin->lu[60] = l_slider_theta__rod_theta;
    const double u_rod_theta__slider_theta = -l_rod_theta__rod_x*u_rod_x__slider_theta -
        l_rod_theta__rod_y*u_rod_y__slider_theta - l_rod_theta__slider_x*n_slider_x__slider_theta +
        n_rod_theta__slider_theta;
    lin->lu[61] = u_rod_theta__slider_theta;
    const double scale_crankpin_x_2 = -inverse_crank_mass - inverse_pivot_rod_x -
        l_crankpin_x__crank_theta_2*phi_O_x_crank_theta - l_crankpin_x__rod_theta_2*u_rod_theta__crankpin_x -
        l_crankpin_x__rod_y*l_rod_y__rod_x;
    const double pivot_crankpin_x_2 = -l_crankpin_x__O_x_2*u_O_x__crankpin_x -
        l_crankpin_x__O_y_2*u_O_y__crankpin_x - l_crankpin_x__motor*u_motor__crankpin_x + scale_crankpin_x_2;
    if (!(fabs(pivot_crankpin_x_2) > 1e-08 * fabs(scale_crankpin_x_2)))
        return 12;
    const double inverse_pivot_crankpin_x_2 = 1.0/pivot_crankpin_x_2;
    lin->lu[62] = inverse_pivot_crankpin_x_2;
    const double l_crankpin_y__crankpin_x_2 = inverse_pivot_crankpin_x_2*(inverse_pivot_rod_y*l_rod_y__rod_x -
        l_crankpin_y__O_x_2*u_O_x__crankpin_x - l_crankpin_y__O_y_2*u_O_y__crankpin_x -
        l_crankpin_y__crank_theta_2*phi_O_x_crank_theta - l_crankpin_y__motor*u_motor__crankpin_x -
        l_crankpin_y__rod_theta_2*u_rod_theta__crankpin_x);
    lin->lu[63] = l_crankpin_y__crankpin_x_2;
    const double u_crankpin_x__crankpin_y = -l_crankpin_x__O_x_2*u_O_x__crankpin_y -
        l_crankpin_x__O_y_2*u_O_y__crankpin_y - l_crankpin_x__crank_theta_2*phi_O_y_crank_theta -
        l_crankpin_x__motor*u_motor__crankpin_y - l_crankpin_x__rod_theta_2*u_rod_theta__crankpin_y +
        l_crankpin_x__rod_y;
    lin->lu[64] = u_crankpin_x__crankpin_y;
    const double l_slider_y__crankpin_x = inverse_pivot_crankpin_x_2*(-l_rod_y__rod_x*l_slider_y__rod_y -
        l_slider_y__rod_theta*u_rod_theta__crankpin_x + l_slider_y__rod_x);
    lin->lu[65] = l_slider_y__crankpin_x;
    const double u_crankpin_x__slider_y = inverse_pivot_rod_x*u_rod_x__slider_y -
        l_crankpin_x__rod_theta_2*u_rod_theta__slider_y - l_crankpin_x__rod_y*u_rod_y__slider_y;
    lin->lu[66] = u_crankpin_x__slider_y;
    const double l_slider_theta__crankpin_x =
        inverse_pivot_crankpin_x_2*(-l_rod_y__rod_x*l_slider_theta__rod_y -
        l_slider_theta__rod_theta*u_rod_theta__crankpin_x + l_slider_theta__rod_x);
    lin->lu[67] = l_slider_theta__crankpin_x;
    const double u_crankpin_x__slider_theta = inverse_pivot_rod_x*u_rod_x__slider_theta -
        l_crankpin_x__rod_theta_2*u_rod_theta__slider_theta - l_crankpin_x__rod_y*u_rod_y__slider_theta;
    lin->lu[68] = u_crankpin_x__slider_theta;
    const double scale_crankpin_y_2 = -inverse_crank_mass - inverse_pivot_rod_y -
        l_crankpin_y__crank_theta_2*phi_O_y_crank_theta - l_crankpin_y__rod_theta_2*u_rod_theta__crankpin_y;
    const double pivot_crankpin_y_2 = -l_crankpin_y__O_x_2*u_O_x__crankpin_y -
        l_crankpin_y__O_y_2*u_O_y__crankpin_y - l_crankpin_y__crankpin_x_2*u_crankpin_x__crankpin_y -
        l_crankpin_y__motor*u_motor__crankpin_y + scale_crankpin_y_2;
    if (!(fabs(pivot_crankpin_y_2) > 1e-08 * fabs(scale_crankpin_y_2)))
        return 13;
    const double inverse_pivot_crankpin_y_2 = 1.0/pivot_crankpin_y_2;
    lin->lu[69] = inverse_pivot_crankpin_y_2;
    const double l_slider_y__crankpin_y =
        inverse_pivot_crankpin_y_2*(-l_slider_y__crankpin_x*u_crankpin_x__crankpin_y -
        l_slider_y__rod_theta*u_rod_theta__crankpin_y + l_slider_y__rod_y);
    lin->lu[70] = l_slider_y__crankpin_y;
    const double u_crankpin_y__slider_y = inverse_pivot_rod_y*u_rod_y__slider_y -
        l_crankpin_y__crankpin_x_2*u_crankpin_x__slider_y - l_crankpin_y__rod_theta_2*u_rod_theta__slider_y;
    lin->lu[71] = u_crankpin_y__slider_y;
    const double l_slider_theta__crankpin_y =
        inverse_pivot_crankpin_y_2*(-l_slider_theta__crankpin_x*u_crankpin_x__crankpin_y -
        l_slider_theta__rod_theta*u_rod_theta__crankpin_y + l_slider_theta__rod_y);
    lin->lu[72] = l_slider_theta__crankpin_y;
    const double u_crankpin_y__slider_theta = inverse_pivot_rod_y*u_rod_y__slider_theta -
        l_crankpin_y__crankpin_x_2*u_crankpin_x__slider_theta -
        l_crankpin_y__rod_theta_2*u_rod_theta__slider_theta;
    lin->lu[73] = u_crankpin_y__slider_theta;
    const double scale_slider_y = -l_slider_y__crankpin_x*u_crankpin_x__slider_y -
        l_slider_y__crankpin_y*u_crankpin_y__slider_y - l_slider_y__rod_theta*u_rod_theta__slider_y -
        l_slider_y__rod_x*u_rod_x__slider_y - l_slider_y__rod_y*u_rod_y__slider_y -
        l_slider_y__slider_x*n_slider_x__slider_y + n_slider_y__slider_y;
    if (!(fabs(scale_slider_y) > 1e-13 * fabs(n_slider_y__slider_y)))
        return 8;
    const double inverse_pivot_slider_y = 1.0/scale_slider_y;
    lin->lu[74] = inverse_pivot_slider_y;
    const double l_slider_theta__slider_y =
        inverse_pivot_slider_y*(-l_slider_theta__crankpin_x*u_crankpin_x__slider_y -
        l_slider_theta__crankpin_y*u_crankpin_y__slider_y - l_slider_theta__rod_theta*u_rod_theta__slider_y -
        l_slider_theta__rod_x*u_rod_x__slider_y - l_slider_theta__rod_y*u_rod_y__slider_y -
        l_slider_theta__slider_x*n_slider_x__slider_y + n_slider_theta__slider_y);
    lin->lu[75] = l_slider_theta__slider_y;
    const double u_slider_y__slider_theta = -l_slider_y__crankpin_x*u_crankpin_x__slider_theta -
        l_slider_y__crankpin_y*u_crankpin_y__slider_theta - l_slider_y__rod_theta*u_rod_theta__slider_theta -
        l_slider_y__rod_x*u_rod_x__slider_theta - l_slider_y__rod_y*u_rod_y__slider_theta -
        l_slider_y__slider_x*n_slider_x__slider_theta + n_slider_y__slider_theta;
    lin->lu[76] = u_slider_y__slider_theta;
    const double scale_cylinder_offset_2 = -inverse_pivot_slider_y;
    if (!(fabs(scale_cylinder_offset_2) > 1e-08 * fabs(scale_cylinder_offset_2)))
        return 14;
    const double inverse_pivot_cylinder_offset_2 = 1.0/scale_cylinder_offset_2;
    lin->lu[77] = inverse_pivot_cylinder_offset_2;
    const double l_slider_theta__cylinder_offset = -inverse_pivot_cylinder_offset_2*l_slider_theta__slider_y;
    lin->lu[78] = l_slider_theta__cylinder_offset;
    const double u_cylinder_offset__slider_theta = -inverse_pivot_slider_y*u_slider_y__slider_theta;
    lin->lu[79] = u_cylinder_offset__slider_theta;
    const double scale_slider_theta = -l_slider_theta__crankpin_x*u_crankpin_x__slider_theta -
        l_slider_theta__crankpin_y*u_crankpin_y__slider_theta -
        l_slider_theta__cylinder_offset*u_cylinder_offset__slider_theta -
        l_slider_theta__rod_theta*u_rod_theta__slider_theta - l_slider_theta__rod_x*u_rod_x__slider_theta -
        l_slider_theta__rod_y*u_rod_y__slider_theta - l_slider_theta__slider_x*n_slider_x__slider_theta -
        l_slider_theta__slider_y*u_slider_y__slider_theta + n_slider_theta__slider_theta;
    if (!(fabs(scale_slider_theta) > 1e-13 * fabs(n_slider_theta__slider_theta)))
        return 9;
    const double inverse_pivot_slider_theta = 1.0/scale_slider_theta;
    lin->lu[80] = inverse_pivot_slider_theta;
    const double scale_cylinder_angle_2 = -inverse_pivot_slider_theta;
    if (!(fabs(scale_cylinder_angle_2) > 1e-08 * fabs(scale_cylinder_angle_2)))
        return 15;
    const double inverse_pivot_cylinder_angle_2 = 1.0/scale_cylinder_angle_2;
    lin->lu[81] = inverse_pivot_cylinder_angle_2;
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
    const double phi_O_x_crank_theta = lin->value[0];
    const double phi_O_y_crank_theta = lin->value[1];
    const double inverse_pivot_crank_theta = lin->lu[0];
    const double l_O_x__crank_theta_2 = lin->lu[1];
    const double l_O_y__crank_theta_2 = lin->lu[2];
    const double l_crankpin_x__crank_theta_2 = lin->lu[3];
    const double l_crankpin_y__crank_theta_2 = lin->lu[4];
    const double inverse_pivot_O_x_2 = lin->lu[5];
    const double l_O_y__O_x_2 = lin->lu[6];
    const double u_O_x__O_y = lin->lu[7];
    const double l_motor__O_x_2 = lin->lu[8];
    const double l_crankpin_x__O_x_2 = lin->lu[9];
    const double u_O_x__crankpin_x = lin->lu[10];
    const double l_crankpin_y__O_x_2 = lin->lu[11];
    const double u_O_x__crankpin_y = lin->lu[12];
    const double inverse_pivot_O_y_2 = lin->lu[13];
    const double l_motor__O_y_2 = lin->lu[14];
    const double u_O_y__motor = lin->lu[15];
    const double l_crankpin_x__O_y_2 = lin->lu[16];
    const double u_O_y__crankpin_x = lin->lu[17];
    const double l_crankpin_y__O_y_2 = lin->lu[18];
    const double u_O_y__crankpin_y = lin->lu[19];
    const double inverse_pivot_motor_2 = lin->lu[20];
    const double l_crankpin_x__motor = lin->lu[21];
    const double u_motor__crankpin_x = lin->lu[22];
    const double l_crankpin_y__motor = lin->lu[23];
    const double u_motor__crankpin_y = lin->lu[24];
    const double inverse_pivot_slider_x = lin->lu[25];
    const double l_rod_x__slider_x = lin->lu[26];
    const double n_slider_x__rod_x = lin->lu[27];
    const double l_rod_y__slider_x = lin->lu[28];
    const double n_slider_x__rod_y = lin->lu[29];
    const double l_rod_theta__slider_x = lin->lu[30];
    const double n_slider_x__rod_theta = lin->lu[31];
    const double l_slider_y__slider_x = lin->lu[32];
    const double n_slider_x__slider_y = lin->lu[33];
    const double l_slider_theta__slider_x = lin->lu[34];
    const double n_slider_x__slider_theta = lin->lu[35];
    const double inverse_pivot_rod_x = lin->lu[36];
    const double l_rod_y__rod_x = lin->lu[37];
    const double u_rod_x__rod_y = lin->lu[38];
    const double l_rod_theta__rod_x = lin->lu[39];
    const double u_rod_x__rod_theta = lin->lu[40];
    const double l_slider_y__rod_x = lin->lu[41];
    const double u_rod_x__slider_y = lin->lu[42];
    const double l_slider_theta__rod_x = lin->lu[43];
    const double u_rod_x__slider_theta = lin->lu[44];
    const double inverse_pivot_rod_y = lin->lu[45];
    const double l_rod_theta__rod_y = lin->lu[46];
    const double u_rod_y__rod_theta = lin->lu[47];
    const double l_crankpin_x__rod_y = lin->lu[48];
    const double l_slider_y__rod_y = lin->lu[49];
    const double u_rod_y__slider_y = lin->lu[50];
    const double l_slider_theta__rod_y = lin->lu[51];
    const double u_rod_y__slider_theta = lin->lu[52];
    const double inverse_pivot_rod_theta = lin->lu[53];
    const double l_crankpin_x__rod_theta_2 = lin->lu[54];
    const double u_rod_theta__crankpin_x = lin->lu[55];
    const double l_crankpin_y__rod_theta_2 = lin->lu[56];
    const double u_rod_theta__crankpin_y = lin->lu[57];
    const double l_slider_y__rod_theta = lin->lu[58];
    const double u_rod_theta__slider_y = lin->lu[59];
    const double l_slider_theta__rod_theta = lin->lu[60];
    const double u_rod_theta__slider_theta = lin->lu[61];
    const double inverse_pivot_crankpin_x_2 = lin->lu[62];
    const double l_crankpin_y__crankpin_x_2 = lin->lu[63];
    const double u_crankpin_x__crankpin_y = lin->lu[64];
    const double l_slider_y__crankpin_x = lin->lu[65];
    const double u_crankpin_x__slider_y = lin->lu[66];
    const double l_slider_theta__crankpin_x = lin->lu[67];
    const double u_crankpin_x__slider_theta = lin->lu[68];
    const double inverse_pivot_crankpin_y_2 = lin->lu[69];
    const double l_slider_y__crankpin_y = lin->lu[70];
    const double u_crankpin_y__slider_y = lin->lu[71];
    const double l_slider_theta__crankpin_y = lin->lu[72];
    const double u_crankpin_y__slider_theta = lin->lu[73];
    const double inverse_pivot_slider_y = lin->lu[74];
    const double l_slider_theta__slider_y = lin->lu[75];
    const double u_slider_y__slider_theta = lin->lu[76];
    const double inverse_pivot_cylinder_offset_2 = lin->lu[77];
    const double l_slider_theta__cylinder_offset = lin->lu[78];
    const double u_cylinder_offset__slider_theta = lin->lu[79];
    const double inverse_pivot_slider_theta = lin->lu[80];
    const double inverse_pivot_cylinder_angle_2 = lin->lu[81];

    /* parameters */
    const double inverse_crank_mass = p->inverse_crank_mass;

    /* forward */
    const double b_crank_x = x[0];
    const double b_crank_y = x[1];
    const double b_crank_theta = x[2];
    const double b_O_x = -b_crank_theta*l_O_x__crank_theta_2 + b_crank_x*inverse_crank_mass + x[9];
    const double b_O_y = -b_O_x*l_O_y__O_x_2 - b_crank_theta*l_O_y__crank_theta_2 +
        b_crank_y*inverse_crank_mass + x[10];
    const double b_motor = -b_O_x*l_motor__O_x_2 - b_O_y*l_motor__O_y_2 -
        b_crank_theta*inverse_pivot_crank_theta + x[15];
    const double b_slider_x = x[6];
    const double b_rod_x = -b_slider_x*l_rod_x__slider_x + x[3];
    const double b_rod_y = -b_rod_x*l_rod_y__rod_x - b_slider_x*l_rod_y__slider_x + x[4];
    const double b_rod_theta = -b_rod_x*l_rod_theta__rod_x - b_rod_y*l_rod_theta__rod_y -
        b_slider_x*l_rod_theta__slider_x + x[5];
    const double b_crankpin_x = -b_O_x*l_crankpin_x__O_x_2 - b_O_y*l_crankpin_x__O_y_2 -
        b_crank_theta*l_crankpin_x__crank_theta_2 - b_crank_x*inverse_crank_mass - b_motor*l_crankpin_x__motor
        - b_rod_theta*l_crankpin_x__rod_theta_2 + b_rod_x*inverse_pivot_rod_x - b_rod_y*l_crankpin_x__rod_y +
        x[11];
    const double b_crankpin_y = -b_O_x*l_crankpin_y__O_x_2 - b_O_y*l_crankpin_y__O_y_2 -
        b_crank_theta*l_crankpin_y__crank_theta_2 - b_crank_y*inverse_crank_mass -
        b_crankpin_x*l_crankpin_y__crankpin_x_2 - b_motor*l_crankpin_y__motor -
        b_rod_theta*l_crankpin_y__rod_theta_2 + b_rod_y*inverse_pivot_rod_y + x[12];
    const double b_slider_y = -b_crankpin_x*l_slider_y__crankpin_x - b_crankpin_y*l_slider_y__crankpin_y -
        b_rod_theta*l_slider_y__rod_theta - b_rod_x*l_slider_y__rod_x - b_rod_y*l_slider_y__rod_y -
        b_slider_x*l_slider_y__slider_x + x[7];
    const double b_cylinder_offset = -b_slider_y*inverse_pivot_slider_y + x[13];
    const double b_slider_theta = -b_crankpin_x*l_slider_theta__crankpin_x -
        b_crankpin_y*l_slider_theta__crankpin_y - b_cylinder_offset*l_slider_theta__cylinder_offset -
        b_rod_theta*l_slider_theta__rod_theta - b_rod_x*l_slider_theta__rod_x - b_rod_y*l_slider_theta__rod_y
        - b_slider_x*l_slider_theta__slider_x - b_slider_y*l_slider_theta__slider_y + x[8];
    const double b_cylinder_angle = -b_slider_theta*inverse_pivot_slider_theta + x[14];

    /* backward */
    const double x_cylinder_angle = b_cylinder_angle*inverse_pivot_cylinder_angle_2;
    x[14] = x_cylinder_angle;
    const double x_slider_theta = inverse_pivot_slider_theta*(b_slider_theta - x_cylinder_angle);
    x[8] = x_slider_theta;
    const double x_cylinder_offset = inverse_pivot_cylinder_offset_2*(b_cylinder_offset -
        u_cylinder_offset__slider_theta*x_slider_theta);
    x[13] = x_cylinder_offset;
    const double x_slider_y = inverse_pivot_slider_y*(b_slider_y - u_slider_y__slider_theta*x_slider_theta -
        x_cylinder_offset);
    x[7] = x_slider_y;
    const double x_crankpin_y = inverse_pivot_crankpin_y_2*(b_crankpin_y -
        u_crankpin_y__slider_theta*x_slider_theta - u_crankpin_y__slider_y*x_slider_y);
    x[12] = x_crankpin_y;
    const double x_crankpin_x = inverse_pivot_crankpin_x_2*(b_crankpin_x -
        u_crankpin_x__crankpin_y*x_crankpin_y - u_crankpin_x__slider_theta*x_slider_theta -
        u_crankpin_x__slider_y*x_slider_y);
    x[11] = x_crankpin_x;
    const double x_rod_theta = inverse_pivot_rod_theta*(b_rod_theta - u_rod_theta__crankpin_x*x_crankpin_x -
        u_rod_theta__crankpin_y*x_crankpin_y - u_rod_theta__slider_theta*x_slider_theta -
        u_rod_theta__slider_y*x_slider_y);
    x[5] = x_rod_theta;
    const double x_rod_y = inverse_pivot_rod_y*(b_rod_y - l_rod_y__rod_x*x_crankpin_x -
        u_rod_y__rod_theta*x_rod_theta - u_rod_y__slider_theta*x_slider_theta - u_rod_y__slider_y*x_slider_y +
        x_crankpin_y);
    x[4] = x_rod_y;
    const double x_rod_x = inverse_pivot_rod_x*(b_rod_x - u_rod_x__rod_theta*x_rod_theta -
        u_rod_x__rod_y*x_rod_y - u_rod_x__slider_theta*x_slider_theta - u_rod_x__slider_y*x_slider_y +
        x_crankpin_x);
    x[3] = x_rod_x;
    const double x_slider_x = inverse_pivot_slider_x*(b_slider_x - n_slider_x__rod_theta*x_rod_theta -
        n_slider_x__rod_x*x_rod_x - n_slider_x__rod_y*x_rod_y - n_slider_x__slider_theta*x_slider_theta -
        n_slider_x__slider_y*x_slider_y);
    x[6] = x_slider_x;
    const double x_motor = inverse_pivot_motor_2*(b_motor - u_motor__crankpin_x*x_crankpin_x -
        u_motor__crankpin_y*x_crankpin_y);
    x[15] = x_motor;
    const double x_O_y = inverse_pivot_O_y_2*(b_O_y - u_O_y__crankpin_x*x_crankpin_x -
        u_O_y__crankpin_y*x_crankpin_y - u_O_y__motor*x_motor);
    x[10] = x_O_y;
    const double x_O_x = inverse_pivot_O_x_2*(b_O_x + l_O_x__crank_theta_2*x_motor - u_O_x__O_y*x_O_y -
        u_O_x__crankpin_x*x_crankpin_x - u_O_x__crankpin_y*x_crankpin_y);
    x[9] = x_O_x;
    const double x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta - phi_O_x_crank_theta*x_O_x -
        phi_O_x_crank_theta*x_crankpin_x - phi_O_y_crank_theta*x_O_y - phi_O_y_crank_theta*x_crankpin_y -
        x_motor);
    x[2] = x_crank_theta;
    const double x_crank_y = inverse_crank_mass*(b_crank_y + x_O_y - x_crankpin_y);
    x[1] = x_crank_y;
    const double x_crank_x = inverse_crank_mass*(b_crank_x + x_O_x - x_crankpin_x);
    x[0] = x_crank_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double phi_O_x_crank_theta = lin->value[0];
    const double phi_O_y_crank_theta = lin->value[1];
    const double phi_crankpin_x_rod_theta = lin->value[2];
    const double phi_crankpin_y_rod_theta = lin->value[3];
    const double by_q_O_x_crank_theta = lin->value[4];
    const double by_q_O_y_crank_theta = lin->value[5];
    const double by_q_crankpin_x_rod_theta = lin->value[6];
    const double by_q_crankpin_y_rod_theta = lin->value[7];
    const double by_q_crank_theta_crank_theta = lin->value[8];
    const double by_q_rod_x_rod_theta = lin->value[9];
    const double by_q_rod_x_rod_x = lin->value[10];
    const double by_q_rod_x_rod_y = lin->value[11];
    const double by_q_rod_y_rod_theta = lin->value[12];
    const double by_q_rod_y_rod_x = lin->value[13];
    const double by_q_rod_y_rod_y = lin->value[14];
    const double by_q_rod_theta_rod_theta = lin->value[15];
    const double by_q_rod_theta_rod_x = lin->value[16];
    const double by_q_rod_theta_rod_y = lin->value[17];
    const double by_q_slider_theta_rod_theta = lin->value[18];
    const double by_q_slider_theta_rod_x = lin->value[19];
    const double by_q_slider_theta_rod_y = lin->value[20];
    const double by_t_motor = lin->value[41];
    const double power_q_2_rod_theta = lin->value[42];
    const double power_q_2_rod_x = lin->value[43];
    const double power_q_2_rod_y = lin->value[44];
    const double power_v_2_rod_theta = lin->value[45];
    const double power_v_2_rod_x = lin->value[46];
    const double power_v_2_rod_y = lin->value[47];
    const double power_v_2_slider_theta = lin->value[48];
    const double power_0_motor = lin->value[49];
    const double power_t_0 = lin->value[50];

    /* parameters */
    const double crank_mass = p->crank_mass;
    const double crank_inertia = p->crank_inertia;
    const double rod_mass = p->rod_mass;
    const double rod_inertia = p->rod_inertia;
    const double slider_mass = p->slider_mass;
    const double slider_inertia = p->slider_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[16];
    const double shifted_crank_x = -beta_squared*eta*r[0] + r[9];
    const double shifted_crank_y = -beta_squared*eta*r[1] + r[10];
    const double shifted_crank_theta = -beta_squared*eta*r[2] + r[11];
    const double shifted_rod_x = -beta_squared*eta*r[3] + r[12];
    const double shifted_rod_y = -beta_squared*eta*r[4] + r[13];
    const double shifted_rod_theta = -beta_squared*eta*r[5] + r[14];
    const double shifted_slider_y = -beta_squared*eta*r[7] + r[16];
    const double shifted_slider_theta = -beta_squared*eta*r[8] + r[17];
    x[0] = crank_mass*eta*r[9];
    x[1] = crank_mass*eta*r[10];
    x[2] = eta*(-by_q_crank_theta_crank_theta*eta*r[2] + crank_inertia*r[11]);
    x[3] = eta*(-by_q_rod_x_rod_theta*eta*r[5] - by_q_rod_x_rod_x*eta*r[3] + by_q_rod_x_rod_x*eta*r[6] -
        by_q_rod_x_rod_y*eta*r[4] + by_q_rod_x_rod_y*eta*r[7] + r[12]*rod_mass);
    x[4] = eta*(-by_q_rod_y_rod_theta*eta*r[5] - by_q_rod_y_rod_x*eta*r[3] + by_q_rod_y_rod_x*eta*r[6] -
        by_q_rod_y_rod_y*eta*r[4] + by_q_rod_y_rod_y*eta*r[7] + r[13]*rod_mass);
    x[5] = eta*(-by_q_rod_theta_rod_theta*eta*r[5] - by_q_rod_theta_rod_x*eta*r[3] +
        by_q_rod_theta_rod_x*eta*r[6] - by_q_rod_theta_rod_y*eta*r[4] + by_q_rod_theta_rod_y*eta*r[7] +
        r[14]*rod_inertia);
    x[6] = eta*(by_q_rod_x_rod_theta*eta*r[5] + by_q_rod_x_rod_x*eta*r[3] - by_q_rod_x_rod_x*eta*r[6] +
        by_q_rod_x_rod_y*eta*r[4] - by_q_rod_x_rod_y*eta*r[7] + r[15]*slider_mass);
    x[7] = eta*(by_q_rod_y_rod_theta*eta*r[5] + by_q_rod_y_rod_x*eta*r[3] - by_q_rod_y_rod_x*eta*r[6] +
        by_q_rod_y_rod_y*eta*r[4] - by_q_rod_y_rod_y*eta*r[7] + r[16]*slider_mass);
    x[8] = eta*(-by_q_slider_theta_rod_theta*eta*r[5] - by_q_slider_theta_rod_x*eta*r[3] +
        by_q_slider_theta_rod_x*eta*r[6] - by_q_slider_theta_rod_y*eta*r[4] + by_q_slider_theta_rod_y*eta*r[7]
        + r[17]*slider_inertia);
    x[9] = eta_row*(-by_q_O_x_crank_theta*eta*r[2] + phi_O_x_crank_theta*shifted_crank_theta -
        shifted_crank_x);
    x[10] = eta_row*(-by_q_O_y_crank_theta*eta*r[2] + phi_O_y_crank_theta*shifted_crank_theta -
        shifted_crank_y);
    x[11] = eta_row*(-by_q_O_x_crank_theta*eta*r[2] - by_q_crankpin_x_rod_theta*eta*r[5] +
        phi_O_x_crank_theta*shifted_crank_theta + phi_crankpin_x_rod_theta*shifted_rod_theta + shifted_crank_x
        - shifted_rod_x);
    x[12] = eta_row*(-by_q_O_y_crank_theta*eta*r[2] - by_q_crankpin_y_rod_theta*eta*r[5] +
        phi_O_y_crank_theta*shifted_crank_theta + phi_crankpin_y_rod_theta*shifted_rod_theta + shifted_crank_y
        - shifted_rod_y);
    x[13] = eta_row*shifted_slider_y;
    x[14] = eta_row*shifted_slider_theta;
    x[15] = eta_row*(-by_t_motor*s + shifted_crank_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[9] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[10] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[11] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[12] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[13] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[14] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[15] = x[6];
    u[7] = eta*(r[7] + x[7]);
    u[16] = x[7];
    u[8] = eta*(r[8] + x[8]);
    u[17] = x[8];
    u[18] = eta*(power_t_0*s + r[18]) + power_0_motor*x[15];
    u[19] = eta*r[19];
    u[20] = eta*(power_q_2_rod_theta*u[5] + power_q_2_rod_x*u[3] - power_q_2_rod_x*u[6] + power_q_2_rod_y*u[4]
        - power_q_2_rod_y*u[7] + power_v_2_rod_theta*u[14] + power_v_2_rod_x*u[12] - power_v_2_rod_x*u[15] +
        power_v_2_rod_y*u[13] - power_v_2_rod_y*u[16] + power_v_2_slider_theta*u[17] + r[20]);
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {9, 0, 51, 1}, {9, 2, 0, 1}, {10, 1, 51, 1}, {10, 2, 1, 1}, {11, 0, 51, -1}, {11, 2, 0, 1}, {11, 3, 51,
    1}, {11, 5, 2, 1}, {12, 1, 51, -1}, {12, 2, 1, 1}, {12, 4, 51, 1}, {12, 5, 3, 1}, {13, 7, 51, -1}, {14, 8,
    51, -1}, {15, 2, 51, -1}
};
static const LinearEntry residual_entries[] = {
    {9, 2, 4, 1}, {10, 2, 5, 1}, {11, 2, 4, 1}, {11, 5, 6, 1}, {12, 2, 5, 1}, {12, 5, 7, 1}, {2, 2, 8, 1}, {3,
    5, 9, 1}, {3, 3, 10, 1}, {3, 6, 10, -1}, {3, 4, 11, 1}, {3, 7, 11, -1}, {4, 5, 12, 1}, {4, 3, 13, 1}, {4,
    6, 13, -1}, {4, 4, 14, 1}, {4, 7, 14, -1}, {5, 5, 15, 1}, {5, 3, 16, 1}, {5, 6, 16, -1}, {5, 4, 17, 1},
    {5, 7, 17, -1}, {6, 5, 9, -1}, {6, 3, 10, -1}, {6, 6, 10, 1}, {6, 4, 11, -1}, {6, 7, 11, 1}, {7, 5, 12,
    -1}, {7, 3, 13, -1}, {7, 6, 13, 1}, {7, 4, 14, -1}, {7, 7, 14, 1}, {8, 5, 18, 1}, {8, 3, 19, 1}, {8, 6,
    19, -1}, {8, 4, 20, 1}, {8, 7, 20, -1}, {9, 11, 21, 1}, {10, 11, 22, 1}, {11, 11, 21, 1}, {11, 14, 23, 1},
    {12, 11, 22, 1}, {12, 14, 24, 1}, {3, 14, 25, 1}, {3, 12, 26, 1}, {3, 15, 26, -1}, {3, 13, 27, 1}, {3, 16,
    27, -1}, {3, 17, 28, 1}, {4, 14, 29, 1}, {4, 12, 30, 1}, {4, 15, 30, -1}, {4, 13, 31, 1}, {4, 16, 31, -1},
    {4, 17, 32, 1}, {5, 14, 33, 1}, {5, 12, 34, 1}, {5, 15, 34, -1}, {5, 13, 35, 1}, {5, 16, 35, -1}, {5, 17,
    36, 1}, {6, 14, 25, -1}, {6, 12, 26, -1}, {6, 15, 26, 1}, {6, 13, 27, -1}, {6, 16, 27, 1}, {6, 17, 28,
    -1}, {7, 14, 29, -1}, {7, 12, 30, -1}, {7, 15, 30, 1}, {7, 13, 31, -1}, {7, 16, 31, 1}, {7, 17, 32, -1},
    {8, 14, 37, 1}, {8, 12, 38, 1}, {8, 15, 38, -1}, {8, 13, 39, 1}, {8, 16, 39, -1}, {8, 17, 40, 1}
};
static const LinearEntry residual_t_entries[] = {
    {15, 0, 41, 1}
};
static const LinearEntry power_entries[] = {
    {2, 5, 42, 1}, {2, 3, 43, 1}, {2, 6, 43, -1}, {2, 4, 44, 1}, {2, 7, 44, -1}, {2, 14, 45, 1}, {2, 12, 46,
    1}, {2, 13, 47, 1}, {2, 17, 48, 1}, {2, 15, 46, -1}, {2, 16, 47, -1}
};
static const LinearEntry power_row_entries[] = {
    {0, 15, 49, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 50, 1}
};
enum {
    N_PHI_Q = 15,
    N_RESIDUAL = 79,
    N_RESIDUAL_T = 1,
    N_POWER = 11,
    N_POWER_ROW = 1,
    N_POWER_T = 1,
    N_NODES = 16,
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
