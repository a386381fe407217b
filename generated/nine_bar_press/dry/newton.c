/*
 * (F along n, F along t, M_i, M_j) of a joint with play and their derivatives by (e, deltadot, de_t, omega_i, omega_j).
 */
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
static inline void in_ground_axes(const PinSlopes *F, double n_x, double n_y, double deltadot, double de_t,
    double per_e, double dF[4][6])
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
    /* x and y apart: gcc 12 would fuse the pair's products and sums, which is not allowed */
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k += 2)
            dF[i][k] = by[i][k] * n_x - by[i][k + 1] * n_y;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k += 2)
            dF[i][k + 1] = by[i][k] * n_y + by[i][k + 1] * n_x;
    for (int k = 0; k < 6; k++) {
        const double along_n = dF[0][k], along_t = dF[1][k];
        dF[0][k] = along_n * n_x - along_t * n_y;
        dF[1][k] = along_n * n_y + along_t * n_x;
    }
}


/*
 * Dry: F along n and t, M_i, M_j, and their derivatives by e, deltadot, de_t, omega_i,
 * omega_j (forward differentiation of the same steps).
 */
static inline void dry_slopes_lankarani_nikravesh_modified_coulomb(double e, double deltadot, double de_t,
    double omega_i, double omega_j, const Latch *latch, double exponent, double mu, double v0, double R_i, double R_j,
    double c, double K, double hysteresis, double friction_slope, const double *side, double *g, int corner,
    PinSlopes *out)
{
    /* penetration, ratio of velocities, slip */
    const double delta = e - c;
    const double depth = max_of(delta, 0.0);
    const double depth_by_e = delta > 0.0 ? 1.0 : 0.0;
    const double ratio = latch->closed ? deltadot/latch->deltadot_minus : 1.0;
    const double ratio_by_deltadot = latch->closed ? 1.0/latch->deltadot_minus : 0.0;
    const double a_i = 0.5*delta + R_i;
    const double a_j = -0.5*delta + R_j;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const double v_t_by_e = -0.5*omega_i - 0.5*omega_j;

    /* contact */
    const double side_1 = side_of(side, g, corner, hysteresis*ratio + 1.0);
    const double power_depth = pow(depth, exponent - 1.0);
    double larger_1;
    if (side_1 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = hysteresis*ratio + 1.0;
    const double F_n = depth*K*power_depth*larger_1;
    const double F_n_by_depth = exponent*K*power_depth*larger_1;
    double branch_1;
    if (side_1 < 0.0)
        branch_1 = 0.0;
    else
        branch_1 = hysteresis;
    const double F_n_by_ratio = depth*K*power_depth*branch_1;
    const double F_n_by_e = F_n_by_depth*depth_by_e;
    const double F_n_by_deltadot = F_n_by_ratio*ratio_by_deltadot;
    const double side_2 = side_of(side, g, corner + 1, -friction_slope*(-v0 - v_t) + 1.0);
    double smaller_1;
    if (side_2 < 0.0)
        smaller_1 = 1.0;
    else
        smaller_1 = friction_slope*(-v0 - v_t);
    const double side_3 = side_of(side, g, corner + 2, smaller_1);
    const double side_4 = side_of(side, g, corner + 3, -friction_slope*(-v0 + v_t) + 1.0);
    double smaller_2;
    if (side_4 < 0.0)
        smaller_2 = 1.0;
    else
        smaller_2 = friction_slope*(-v0 + v_t);
    const double side_5 = side_of(side, g, corner + 4, smaller_2);
    double larger_2;
    if (side_3 < 0.0)
        larger_2 = 0.0;
    else
        larger_2 = smaller_1;
    double larger_3;
    if (side_5 < 0.0)
        larger_3 = 0.0;
    else
        larger_3 = smaller_2;
    const double F_t = -F_n*mu*(-larger_2 + larger_3);
    const double F_t_by_F_n = -mu*(-larger_2 + larger_3);
    double branch_2;
    if (side_2 < 0.0)
        branch_2 = 0.0;
    else
        branch_2 = -friction_slope;
    double branch_3;
    if (side_3 < 0.0)
        branch_3 = 0.0;
    else
        branch_3 = branch_2;
    double branch_4;
    if (side_4 < 0.0)
        branch_4 = 0.0;
    else
        branch_4 = friction_slope;
    double branch_5;
    if (side_5 < 0.0)
        branch_5 = 0.0;
    else
        branch_5 = branch_4;
    const double F_t_by_v_t = -F_n*mu*(-branch_3 + branch_5);
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
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent, p->dry_friction_mu, p->dry_friction_v0, p->pin_radius, p->R_j_pin,
            p->pin_clearance, p->dry_pin_K, p->dry_pin_hysteresis, p->dry_pin_friction_slope, side, g, 0, out);
}

static void tangent_A(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_A(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
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
 * Joint B: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_B(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent, p->dry_friction_mu, p->dry_friction_v0, p->pin_radius, p->R_j_pin,
            p->pin_clearance, p->dry_pin_K, p->dry_pin_hysteresis, p->dry_pin_friction_slope, side, g, 5, out);
}

static void tangent_B(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_B(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
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
/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
void linearize(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    const double *a, const Aside *aside, Linear *lin)
{
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L7_theta = q[1];
    const double L7_omega = v[1];
    const double L8_theta = q[2];
    const double L8_omega = v[2];
    const double L2_theta = q[3];
    const double L2_omega = v[3];
    const double L3_theta = q[4];
    const double L3_omega = v[4];
    const double a_L6_theta = a[0];
    const double a_L7_theta = a[1];
    const double a_L8_theta = a[2];
    const double a_L2_theta = a[3];
    const double a_L3_theta = a[4];
    const double held_lambda_guide_offset = aside->lambda[0];
    const double A_Fx = aside->clearance[0].Fx;
    const double A_Fy = aside->clearance[0].Fy;
    const double A_moment_first = aside->clearance[0].moment_first;
    const double A_moment_second = aside->clearance[0].moment_second;
    const double B_Fx = aside->clearance[1].Fx;
    const double B_Fy = aside->clearance[1].Fy;
    const double B_moment_first = aside->clearance[1].moment_first;
    const double B_moment_second = aside->clearance[1].moment_second;

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank1_rate = p->omega;
    const double crank1_acceleration = 0.0;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const double crank4_rate = p->omega4;
    const double crank4_acceleration = 0.0;
    const double cos_theta_L1 = cos(crank1_value);
    const double sin_theta_L1 = sin(crank1_value);
    const double cos_theta_L4 = cos(crank4_value);
    const double sin_theta_L4 = sin(crank4_value);
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double L6_head_x = p->O6_x + span_L6_head_x;
    const double L6_head_vx = -L6_omega*span_L6_head_y;
    const double L6_head_vy = L6_omega*span_L6_head_x;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;
    const double L7_tail_x = L6_head_x + span_L7_tail_x;
    const double L7_tail_vx = L6_head_vx - L7_omega*span_L7_tail_y;
    const double L7_tail_y = span_L6_head_y + span_L7_tail_y;
    const double L7_tail_vy = L6_head_vy + L7_omega*span_L7_tail_x;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double L1_head_vx = -crank1_rate*span_L1_head_y;
    const double L1_head_vy = crank1_rate*span_L1_head_x;
    const double span_L2_tail_x = p->L2_tail_span_x*cos_theta_L2;
    const double span_L2_tail_y = p->L2_tail_span_x*sin_theta_L2;
    const double L2_tail_x = L7_tail_x + span_L2_tail_x;
    const double L2_tail_vx = -L2_omega*span_L2_tail_y + L7_tail_vx;
    const double L2_tail_y = L7_tail_y + span_L2_tail_y;
    const double L2_tail_vy = L2_omega*span_L2_tail_x + L7_tail_vy;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double L4_head_vx = -crank4_rate*span_L4_head_y;
    const double L4_head_y = p->O4_y + span_L4_head_y;
    const double L4_head_vy = crank4_rate*span_L4_head_x;
    const double span_L3_tail_x = p->L3_tail_span_x*cos_theta_L3;
    const double span_L3_tail_y = p->L3_tail_span_x*sin_theta_L3;
    const double L3_tail_x = L7_tail_x + span_L3_tail_x;
    const double L3_tail_vx = -L3_omega*span_L3_tail_y + L7_tail_vx;
    const double L3_tail_y = L7_tail_y + span_L3_tail_y;
    const double L3_tail_vy = L3_omega*span_L3_tail_x + L7_tail_vy;
    const double cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const double sin_L7_less_L6 = cos_theta_L6*sin_theta_L7 - cos_theta_L7*sin_theta_L6;
    const double dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const double cross_L6_L7 = p->inertia_L6_L7*sin_L7_less_L6;
    const double cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const double sin_L2_less_L6 = -cos_theta_L2*sin_theta_L6 + cos_theta_L6*sin_theta_L2;
    const double dot_L6_L2 = cos_L2_less_L6*p->inertia_L6_L2;
    const double cross_L6_L2 = p->inertia_L6_L2*sin_L2_less_L6;
    const double cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const double sin_L2_less_L7 = -cos_theta_L2*sin_theta_L7 + cos_theta_L7*sin_theta_L2;
    const double dot_L7_L2 = cos_L2_less_L7*p->inertia_L7_L2;
    const double cross_L7_L2 = p->inertia_L7_L2*sin_L2_less_L7;
    const double cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const double sin_L3_less_L6 = -cos_theta_L3*sin_theta_L6 + cos_theta_L6*sin_theta_L3;
    const double dot_L6_L3 = cos_L3_less_L6*p->inertia_L6_L3;
    const double cross_L6_L3 = p->inertia_L6_L3*sin_L3_less_L6;
    const double cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const double sin_L3_less_L7 = -cos_theta_L3*sin_theta_L7 + cos_theta_L7*sin_theta_L3;
    const double dot_L7_L3 = cos_L3_less_L7*p->inertia_L7_L3;
    const double cross_L7_L3 = p->inertia_L7_L3*sin_L3_less_L7;
    const double cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const double sin_L8_less_L6 = cos_theta_L6*sin_theta_L8 - cos_theta_L8*sin_theta_L6;
    const double dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;
    const double cross_L6_L8 = p->inertia_L6_L8*sin_L8_less_L6;

    /* clearance joint A */
    const double e_A_x = L2_tail_x - span_L1_head_x;
    const double e_A_y = L2_tail_y - span_L1_head_y;
    const double edot_A_x = -L1_head_vx + L2_tail_vx;
    const double edot_A_y = -L1_head_vy + L2_tail_vy;
    double change_A[4][6];
    tangent_A(e_A_x, e_A_y, edot_A_x, edot_A_y, crank1_rate, L2_omega, &memory->latch[0], p, side, g, change_A);
    const double span_L1_head_x_by_time = -crank1_rate*span_L1_head_y;
    const double span_L1_head_y_by_time = crank1_rate*span_L1_head_x;
    const double L1_head_vx_by_time = -crank1_acceleration*span_L1_head_y - (crank1_rate * crank1_rate)*span_L1_head_x;
    const double L2_tail_vx_by_L6_theta = -L6_omega*span_L6_head_x;
    const double L2_tail_vx_by_L7_theta = -L7_omega*span_L7_tail_x;
    const double L2_tail_vx_by_L2_theta = -L2_omega*span_L2_tail_x;
    const double L1_head_vy_by_time = crank1_acceleration*span_L1_head_x - (crank1_rate * crank1_rate)*span_L1_head_y;
    const double L2_tail_vy_by_L6_theta = -L6_omega*span_L6_head_y;
    const double L2_tail_vy_by_L7_theta = -L7_omega*span_L7_tail_y;
    const double L2_tail_vy_by_L2_theta = -L2_omega*span_L2_tail_y;
    const double A_Fx_by_e_x = change_A[0][0];
    const double A_Fx_by_e_y = change_A[0][1];
    const double A_Fx_by_de_x = change_A[0][2];
    const double A_Fx_by_de_y = change_A[0][3];
    const double A_Fx_by_omega_i = change_A[0][4];
    const double A_Fx_by_omega_j = change_A[0][5];
    const double A_Fx_by_L6_theta = A_Fx_by_de_x*L2_tail_vx_by_L6_theta + A_Fx_by_de_y*L2_tail_vy_by_L6_theta
        - A_Fx_by_e_x*span_L6_head_y + A_Fx_by_e_y*span_L6_head_x;
    const double A_Fx_by_L7_theta = A_Fx_by_de_x*L2_tail_vx_by_L7_theta + A_Fx_by_de_y*L2_tail_vy_by_L7_theta
        - A_Fx_by_e_x*span_L7_tail_y + A_Fx_by_e_y*span_L7_tail_x;
    const double A_Fx_by_L2_theta = A_Fx_by_de_x*L2_tail_vx_by_L2_theta + A_Fx_by_de_y*L2_tail_vy_by_L2_theta
        - A_Fx_by_e_x*span_L2_tail_y + A_Fx_by_e_y*span_L2_tail_x;
    const double A_Fx_by_time = -A_Fx_by_de_x*L1_head_vx_by_time - A_Fx_by_de_y*L1_head_vy_by_time
        - A_Fx_by_e_x*span_L1_head_x_by_time - A_Fx_by_e_y*span_L1_head_y_by_time + A_Fx_by_omega_i*crank1_acceleration;
    const double A_Fx_by_L6_omega = -A_Fx_by_de_x*span_L6_head_y + A_Fx_by_de_y*span_L6_head_x;
    const double A_Fx_by_L7_omega = -A_Fx_by_de_x*span_L7_tail_y + A_Fx_by_de_y*span_L7_tail_x;
    const double A_Fx_by_L2_omega = -A_Fx_by_de_x*span_L2_tail_y + A_Fx_by_de_y*span_L2_tail_x + A_Fx_by_omega_j;
    const double A_Fy_by_e_x = change_A[1][0];
    const double A_Fy_by_e_y = change_A[1][1];
    const double A_Fy_by_de_x = change_A[1][2];
    const double A_Fy_by_de_y = change_A[1][3];
    const double A_Fy_by_omega_i = change_A[1][4];
    const double A_Fy_by_omega_j = change_A[1][5];
    const double A_Fy_by_L6_theta = A_Fy_by_de_x*L2_tail_vx_by_L6_theta + A_Fy_by_de_y*L2_tail_vy_by_L6_theta
        - A_Fy_by_e_x*span_L6_head_y + A_Fy_by_e_y*span_L6_head_x;
    const double A_Fy_by_L7_theta = A_Fy_by_de_x*L2_tail_vx_by_L7_theta + A_Fy_by_de_y*L2_tail_vy_by_L7_theta
        - A_Fy_by_e_x*span_L7_tail_y + A_Fy_by_e_y*span_L7_tail_x;
    const double A_Fy_by_L2_theta = A_Fy_by_de_x*L2_tail_vx_by_L2_theta + A_Fy_by_de_y*L2_tail_vy_by_L2_theta
        - A_Fy_by_e_x*span_L2_tail_y + A_Fy_by_e_y*span_L2_tail_x;
    const double A_Fy_by_time = -A_Fy_by_de_x*L1_head_vx_by_time - A_Fy_by_de_y*L1_head_vy_by_time
        - A_Fy_by_e_x*span_L1_head_x_by_time - A_Fy_by_e_y*span_L1_head_y_by_time + A_Fy_by_omega_i*crank1_acceleration;
    const double A_Fy_by_L6_omega = -A_Fy_by_de_x*span_L6_head_y + A_Fy_by_de_y*span_L6_head_x;
    const double A_Fy_by_L7_omega = -A_Fy_by_de_x*span_L7_tail_y + A_Fy_by_de_y*span_L7_tail_x;
    const double A_Fy_by_L2_omega = -A_Fy_by_de_x*span_L2_tail_y + A_Fy_by_de_y*span_L2_tail_x + A_Fy_by_omega_j;
    const double A_moment_first_by_e_x = change_A[2][0];
    const double A_moment_first_by_e_y = change_A[2][1];
    const double A_moment_first_by_de_x = change_A[2][2];
    const double A_moment_first_by_de_y = change_A[2][3];
    const double A_moment_first_by_omega_i = change_A[2][4];
    const double A_moment_first_by_omega_j = change_A[2][5];
    const double A_moment_first_by_L6_theta = A_moment_first_by_de_x*L2_tail_vx_by_L6_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L6_theta - A_moment_first_by_e_x*span_L6_head_y
        + A_moment_first_by_e_y*span_L6_head_x;
    const double A_moment_first_by_L7_theta = A_moment_first_by_de_x*L2_tail_vx_by_L7_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L7_theta - A_moment_first_by_e_x*span_L7_tail_y
        + A_moment_first_by_e_y*span_L7_tail_x;
    const double A_moment_first_by_L2_theta = A_moment_first_by_de_x*L2_tail_vx_by_L2_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L2_theta - A_moment_first_by_e_x*span_L2_tail_y
        + A_moment_first_by_e_y*span_L2_tail_x;
    const double A_moment_first_by_time = -A_moment_first_by_de_x*L1_head_vx_by_time
        - A_moment_first_by_de_y*L1_head_vy_by_time - A_moment_first_by_e_x*span_L1_head_x_by_time
        - A_moment_first_by_e_y*span_L1_head_y_by_time + A_moment_first_by_omega_i*crank1_acceleration;
    const double A_moment_first_by_L6_omega = -A_moment_first_by_de_x*span_L6_head_y
        + A_moment_first_by_de_y*span_L6_head_x;
    const double A_moment_first_by_L7_omega = -A_moment_first_by_de_x*span_L7_tail_y
        + A_moment_first_by_de_y*span_L7_tail_x;
    const double A_moment_first_by_L2_omega = -A_moment_first_by_de_x*span_L2_tail_y
        + A_moment_first_by_de_y*span_L2_tail_x + A_moment_first_by_omega_j;
    const double A_moment_second_by_e_x = change_A[3][0];
    const double A_moment_second_by_e_y = change_A[3][1];
    const double A_moment_second_by_de_x = change_A[3][2];
    const double A_moment_second_by_de_y = change_A[3][3];
    const double A_moment_second_by_omega_i = change_A[3][4];
    const double A_moment_second_by_omega_j = change_A[3][5];
    const double A_moment_second_by_L6_theta = A_moment_second_by_de_x*L2_tail_vx_by_L6_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L6_theta - A_moment_second_by_e_x*span_L6_head_y
        + A_moment_second_by_e_y*span_L6_head_x;
    const double A_moment_second_by_L7_theta = A_moment_second_by_de_x*L2_tail_vx_by_L7_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L7_theta - A_moment_second_by_e_x*span_L7_tail_y
        + A_moment_second_by_e_y*span_L7_tail_x;
    const double A_moment_second_by_L2_theta = A_moment_second_by_de_x*L2_tail_vx_by_L2_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L2_theta - A_moment_second_by_e_x*span_L2_tail_y
        + A_moment_second_by_e_y*span_L2_tail_x;
    const double A_moment_second_by_time = -A_moment_second_by_de_x*L1_head_vx_by_time
        - A_moment_second_by_de_y*L1_head_vy_by_time - A_moment_second_by_e_x*span_L1_head_x_by_time
        - A_moment_second_by_e_y*span_L1_head_y_by_time + A_moment_second_by_omega_i*crank1_acceleration;
    const double A_moment_second_by_L6_omega = -A_moment_second_by_de_x*span_L6_head_y
        + A_moment_second_by_de_y*span_L6_head_x;
    const double A_moment_second_by_L7_omega = -A_moment_second_by_de_x*span_L7_tail_y
        + A_moment_second_by_de_y*span_L7_tail_x;
    const double A_moment_second_by_L2_omega = -A_moment_second_by_de_x*span_L2_tail_y
        + A_moment_second_by_de_y*span_L2_tail_x + A_moment_second_by_omega_j;

    /* clearance joint B */
    const double e_B_x = L3_tail_x - span_L4_head_x;
    const double e_B_y = L3_tail_y - L4_head_y;
    const double edot_B_x = L3_tail_vx - L4_head_vx;
    const double edot_B_y = L3_tail_vy - L4_head_vy;
    double change_B[4][6];
    tangent_B(e_B_x, e_B_y, edot_B_x, edot_B_y, crank4_rate, L3_omega, &memory->latch[1], p, side, g, change_B);
    const double span_L4_head_x_by_time = -crank4_rate*span_L4_head_y;
    const double L4_head_y_by_time = crank4_rate*span_L4_head_x;
    const double L3_tail_vx_by_L6_theta = -L6_omega*span_L6_head_x;
    const double L3_tail_vx_by_L7_theta = -L7_omega*span_L7_tail_x;
    const double L3_tail_vx_by_L3_theta = -L3_omega*span_L3_tail_x;
    const double L4_head_vx_by_time = -crank4_acceleration*span_L4_head_y - (crank4_rate * crank4_rate)*span_L4_head_x;
    const double L3_tail_vy_by_L6_theta = -L6_omega*span_L6_head_y;
    const double L3_tail_vy_by_L7_theta = -L7_omega*span_L7_tail_y;
    const double L3_tail_vy_by_L3_theta = -L3_omega*span_L3_tail_y;
    const double L4_head_vy_by_time = crank4_acceleration*span_L4_head_x - (crank4_rate * crank4_rate)*span_L4_head_y;
    const double B_Fx_by_e_x = change_B[0][0];
    const double B_Fx_by_e_y = change_B[0][1];
    const double B_Fx_by_de_x = change_B[0][2];
    const double B_Fx_by_de_y = change_B[0][3];
    const double B_Fx_by_omega_i = change_B[0][4];
    const double B_Fx_by_omega_j = change_B[0][5];
    const double B_Fx_by_L6_theta = B_Fx_by_de_x*L3_tail_vx_by_L6_theta + B_Fx_by_de_y*L3_tail_vy_by_L6_theta
        - B_Fx_by_e_x*span_L6_head_y + B_Fx_by_e_y*span_L6_head_x;
    const double B_Fx_by_L7_theta = B_Fx_by_de_x*L3_tail_vx_by_L7_theta + B_Fx_by_de_y*L3_tail_vy_by_L7_theta
        - B_Fx_by_e_x*span_L7_tail_y + B_Fx_by_e_y*span_L7_tail_x;
    const double B_Fx_by_L3_theta = B_Fx_by_de_x*L3_tail_vx_by_L3_theta + B_Fx_by_de_y*L3_tail_vy_by_L3_theta
        - B_Fx_by_e_x*span_L3_tail_y + B_Fx_by_e_y*span_L3_tail_x;
    const double B_Fx_by_time = -B_Fx_by_de_x*L4_head_vx_by_time - B_Fx_by_de_y*L4_head_vy_by_time
        - B_Fx_by_e_x*span_L4_head_x_by_time - B_Fx_by_e_y*L4_head_y_by_time + B_Fx_by_omega_i*crank4_acceleration;
    const double B_Fx_by_L6_omega = -B_Fx_by_de_x*span_L6_head_y + B_Fx_by_de_y*span_L6_head_x;
    const double B_Fx_by_L7_omega = -B_Fx_by_de_x*span_L7_tail_y + B_Fx_by_de_y*span_L7_tail_x;
    const double B_Fx_by_L3_omega = -B_Fx_by_de_x*span_L3_tail_y + B_Fx_by_de_y*span_L3_tail_x + B_Fx_by_omega_j;
    const double B_Fy_by_e_x = change_B[1][0];
    const double B_Fy_by_e_y = change_B[1][1];
    const double B_Fy_by_de_x = change_B[1][2];
    const double B_Fy_by_de_y = change_B[1][3];
    const double B_Fy_by_omega_i = change_B[1][4];
    const double B_Fy_by_omega_j = change_B[1][5];
    const double B_Fy_by_L6_theta = B_Fy_by_de_x*L3_tail_vx_by_L6_theta + B_Fy_by_de_y*L3_tail_vy_by_L6_theta
        - B_Fy_by_e_x*span_L6_head_y + B_Fy_by_e_y*span_L6_head_x;
    const double B_Fy_by_L7_theta = B_Fy_by_de_x*L3_tail_vx_by_L7_theta + B_Fy_by_de_y*L3_tail_vy_by_L7_theta
        - B_Fy_by_e_x*span_L7_tail_y + B_Fy_by_e_y*span_L7_tail_x;
    const double B_Fy_by_L3_theta = B_Fy_by_de_x*L3_tail_vx_by_L3_theta + B_Fy_by_de_y*L3_tail_vy_by_L3_theta
        - B_Fy_by_e_x*span_L3_tail_y + B_Fy_by_e_y*span_L3_tail_x;
    const double B_Fy_by_time = -B_Fy_by_de_x*L4_head_vx_by_time - B_Fy_by_de_y*L4_head_vy_by_time
        - B_Fy_by_e_x*span_L4_head_x_by_time - B_Fy_by_e_y*L4_head_y_by_time + B_Fy_by_omega_i*crank4_acceleration;
    const double B_Fy_by_L6_omega = -B_Fy_by_de_x*span_L6_head_y + B_Fy_by_de_y*span_L6_head_x;
    const double B_Fy_by_L7_omega = -B_Fy_by_de_x*span_L7_tail_y + B_Fy_by_de_y*span_L7_tail_x;
    const double B_Fy_by_L3_omega = -B_Fy_by_de_x*span_L3_tail_y + B_Fy_by_de_y*span_L3_tail_x + B_Fy_by_omega_j;
    const double B_moment_first_by_e_x = change_B[2][0];
    const double B_moment_first_by_e_y = change_B[2][1];
    const double B_moment_first_by_de_x = change_B[2][2];
    const double B_moment_first_by_de_y = change_B[2][3];
    const double B_moment_first_by_omega_i = change_B[2][4];
    const double B_moment_first_by_omega_j = change_B[2][5];
    const double B_moment_first_by_L6_theta = B_moment_first_by_de_x*L3_tail_vx_by_L6_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L6_theta - B_moment_first_by_e_x*span_L6_head_y
        + B_moment_first_by_e_y*span_L6_head_x;
    const double B_moment_first_by_L7_theta = B_moment_first_by_de_x*L3_tail_vx_by_L7_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L7_theta - B_moment_first_by_e_x*span_L7_tail_y
        + B_moment_first_by_e_y*span_L7_tail_x;
    const double B_moment_first_by_L3_theta = B_moment_first_by_de_x*L3_tail_vx_by_L3_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L3_theta - B_moment_first_by_e_x*span_L3_tail_y
        + B_moment_first_by_e_y*span_L3_tail_x;
    const double B_moment_first_by_time = -B_moment_first_by_de_x*L4_head_vx_by_time
        - B_moment_first_by_de_y*L4_head_vy_by_time - B_moment_first_by_e_x*span_L4_head_x_by_time
        - B_moment_first_by_e_y*L4_head_y_by_time + B_moment_first_by_omega_i*crank4_acceleration;
    const double B_moment_first_by_L6_omega = -B_moment_first_by_de_x*span_L6_head_y
        + B_moment_first_by_de_y*span_L6_head_x;
    const double B_moment_first_by_L7_omega = -B_moment_first_by_de_x*span_L7_tail_y
        + B_moment_first_by_de_y*span_L7_tail_x;
    const double B_moment_first_by_L3_omega = -B_moment_first_by_de_x*span_L3_tail_y
        + B_moment_first_by_de_y*span_L3_tail_x + B_moment_first_by_omega_j;
    const double B_moment_second_by_e_x = change_B[3][0];
    const double B_moment_second_by_e_y = change_B[3][1];
    const double B_moment_second_by_de_x = change_B[3][2];
    const double B_moment_second_by_de_y = change_B[3][3];
    const double B_moment_second_by_omega_i = change_B[3][4];
    const double B_moment_second_by_omega_j = change_B[3][5];
    const double B_moment_second_by_L6_theta = B_moment_second_by_de_x*L3_tail_vx_by_L6_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L6_theta - B_moment_second_by_e_x*span_L6_head_y
        + B_moment_second_by_e_y*span_L6_head_x;
    const double B_moment_second_by_L7_theta = B_moment_second_by_de_x*L3_tail_vx_by_L7_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L7_theta - B_moment_second_by_e_x*span_L7_tail_y
        + B_moment_second_by_e_y*span_L7_tail_x;
    const double B_moment_second_by_L3_theta = B_moment_second_by_de_x*L3_tail_vx_by_L3_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L3_theta - B_moment_second_by_e_x*span_L3_tail_y
        + B_moment_second_by_e_y*span_L3_tail_x;
    const double B_moment_second_by_time = -B_moment_second_by_de_x*L4_head_vx_by_time
        - B_moment_second_by_de_y*L4_head_vy_by_time - B_moment_second_by_e_x*span_L4_head_x_by_time
        - B_moment_second_by_e_y*L4_head_y_by_time + B_moment_second_by_omega_i*crank4_acceleration;
    const double B_moment_second_by_L6_omega = -B_moment_second_by_de_x*span_L6_head_y
        + B_moment_second_by_de_y*span_L6_head_x;
    const double B_moment_second_by_L7_omega = -B_moment_second_by_de_x*span_L7_tail_y
        + B_moment_second_by_de_y*span_L7_tail_x;
    const double B_moment_second_by_L3_omega = -B_moment_second_by_de_x*span_L3_tail_y
        + B_moment_second_by_de_y*span_L3_tail_x + B_moment_second_by_omega_j;

    /* powers */
    const double cos_theta_L1_by_time = -crank1_rate*sin_theta_L1;
    const double cos_theta_L4_by_time = -crank4_rate*sin_theta_L4;
    const double span_L4_head_y_by_time = crank4_rate*span_L4_head_x;

    /* results */
    lin->value[0] = dot_L6_L7;
    lin->value[1] = dot_L6_L2;
    lin->value[2] = dot_L7_L2;
    lin->value[3] = dot_L6_L3;
    lin->value[4] = dot_L7_L3;
    lin->value[5] = dot_L6_L8;
    lin->value[6] = span_L6_head_y;
    lin->value[7] = span_L8_head_y;
    lin->value[8] = -(L6_omega * L6_omega)*span_L6_head_y + L6_omega*span_L6_head_x*p->two_alpha
        + a_L6_theta*span_L6_head_x;
    lin->value[9] = -(L8_omega * L8_omega)*span_L8_head_y + L8_omega*span_L8_head_x*p->two_alpha
        + a_L8_theta*span_L8_head_x;
    lin->value[10] = A_Fx_by_L6_theta*span_L6_head_y - A_Fy_by_L6_theta*span_L6_head_x
        + B_Fx_by_L6_theta*span_L6_head_y - B_Fy_by_L6_theta*span_L6_head_x + (L2_omega * L2_omega)*dot_L6_L2
        + (L3_omega * L3_omega)*dot_L6_L3 + (L7_omega * L7_omega)*dot_L6_L7 + (L8_omega * L8_omega)*dot_L6_L8
        + a_L2_theta*cross_L6_L2 + a_L3_theta*cross_L6_L3 + a_L7_theta*cross_L6_L7 + a_L8_theta*cross_L6_L8
        + sin_theta_L6*p->weight_L6__across + span_L6_head_x*(A_Fx + B_Fx + held_lambda_guide_offset)
        - span_L6_head_y*(-A_Fy - B_Fy);
    lin->value[11] = A_Fx_by_L7_theta*span_L6_head_y - A_Fy_by_L7_theta*span_L6_head_x
        + B_Fx_by_L7_theta*span_L6_head_y - B_Fy_by_L7_theta*span_L6_head_x - (L7_omega * L7_omega)*dot_L6_L7
        - a_L7_theta*cross_L6_L7;
    lin->value[12] = A_Fx_by_L2_theta*span_L6_head_y - A_Fy_by_L2_theta*span_L6_head_x
        - (L2_omega * L2_omega)*dot_L6_L2 - a_L2_theta*cross_L6_L2;
    lin->value[13] = B_Fx_by_L3_theta*span_L6_head_y - B_Fy_by_L3_theta*span_L6_head_x
        - (L3_omega * L3_omega)*dot_L6_L3 - a_L3_theta*cross_L6_L3;
    lin->value[14] = -(L8_omega * L8_omega)*dot_L6_L8 - a_L8_theta*cross_L6_L8;
    lin->value[15] = A_Fx_by_L6_theta*span_L7_tail_y - A_Fy_by_L6_theta*span_L7_tail_x
        + B_Fx_by_L6_theta*span_L7_tail_y - B_Fy_by_L6_theta*span_L7_tail_x - (L6_omega * L6_omega)*dot_L6_L7
        + a_L6_theta*cross_L6_L7;
    lin->value[16] = A_Fx_by_L7_theta*span_L7_tail_y - A_Fy_by_L7_theta*span_L7_tail_x
        + B_Fx_by_L7_theta*span_L7_tail_y - B_Fy_by_L7_theta*span_L7_tail_x + (L2_omega * L2_omega)*dot_L7_L2
        + (L3_omega * L3_omega)*dot_L7_L3 + (L6_omega * L6_omega)*dot_L6_L7 + a_L2_theta*cross_L7_L2
        + a_L3_theta*cross_L7_L3 - a_L6_theta*cross_L6_L7 + sin_theta_L7*p->weight_L7__across
        + span_L7_tail_x*(A_Fx + B_Fx) - span_L7_tail_y*(-A_Fy - B_Fy);
    lin->value[17] = A_Fx_by_L2_theta*span_L7_tail_y - A_Fy_by_L2_theta*span_L7_tail_x
        - (L2_omega * L2_omega)*dot_L7_L2 - a_L2_theta*cross_L7_L2;
    lin->value[18] = B_Fx_by_L3_theta*span_L7_tail_y - B_Fy_by_L3_theta*span_L7_tail_x
        - (L3_omega * L3_omega)*dot_L7_L3 - a_L3_theta*cross_L7_L3;
    lin->value[19] = (L6_omega * L6_omega)*dot_L6_L8 - a_L6_theta*cross_L6_L8 + held_lambda_guide_offset*span_L8_head_x
        + sin_theta_L8*p->weight_L8__across;
    lin->value[20] = -(L6_omega * L6_omega)*dot_L6_L8 + a_L6_theta*cross_L6_L8;
    lin->value[21] = A_Fx_by_L6_theta*span_L2_tail_y - A_Fy_by_L6_theta*span_L2_tail_x - A_moment_second_by_L6_theta
        - (L6_omega * L6_omega)*dot_L6_L2 + a_L6_theta*cross_L6_L2;
    lin->value[22] = A_Fx_by_L7_theta*span_L2_tail_y - A_Fy_by_L7_theta*span_L2_tail_x - A_moment_second_by_L7_theta
        - (L7_omega * L7_omega)*dot_L7_L2 + a_L7_theta*cross_L7_L2;
    lin->value[23] = A_Fx*span_L2_tail_x + A_Fx_by_L2_theta*span_L2_tail_y + A_Fy*span_L2_tail_y
        - A_Fy_by_L2_theta*span_L2_tail_x - A_moment_second_by_L2_theta + (L6_omega * L6_omega)*dot_L6_L2
        + (L7_omega * L7_omega)*dot_L7_L2 - a_L6_theta*cross_L6_L2 - a_L7_theta*cross_L7_L2
        + sin_theta_L2*p->weight_L2__across;
    lin->value[24] = B_Fx_by_L6_theta*span_L3_tail_y - B_Fy_by_L6_theta*span_L3_tail_x - B_moment_second_by_L6_theta
        - (L6_omega * L6_omega)*dot_L6_L3 + a_L6_theta*cross_L6_L3;
    lin->value[25] = B_Fx_by_L7_theta*span_L3_tail_y - B_Fy_by_L7_theta*span_L3_tail_x - B_moment_second_by_L7_theta
        - (L7_omega * L7_omega)*dot_L7_L3 + a_L7_theta*cross_L7_L3;
    lin->value[26] = B_Fx*span_L3_tail_x + B_Fx_by_L3_theta*span_L3_tail_y + B_Fy*span_L3_tail_y
        - B_Fy_by_L3_theta*span_L3_tail_x - B_moment_second_by_L3_theta + (L6_omega * L6_omega)*dot_L6_L3
        + (L7_omega * L7_omega)*dot_L7_L3 - a_L6_theta*cross_L6_L3 - a_L7_theta*cross_L7_L3
        + sin_theta_L3*p->weight_L3__across;
    lin->value[27] = 2.0*L6_omega*span_L6_head_x;
    lin->value[28] = 2.0*L8_omega*span_L8_head_x;
    lin->value[29] = A_Fx_by_L6_omega*span_L6_head_y - A_Fy_by_L6_omega*span_L6_head_x
        + B_Fx_by_L6_omega*span_L6_head_y - B_Fy_by_L6_omega*span_L6_head_x;
    lin->value[30] = A_Fx_by_L7_omega*span_L6_head_y - A_Fy_by_L7_omega*span_L6_head_x
        + B_Fx_by_L7_omega*span_L6_head_y - B_Fy_by_L7_omega*span_L6_head_x - 2.0*L7_omega*cross_L6_L7;
    lin->value[31] = A_Fx_by_L2_omega*span_L6_head_y - A_Fy_by_L2_omega*span_L6_head_x - 2.0*L2_omega*cross_L6_L2;
    lin->value[32] = B_Fx_by_L3_omega*span_L6_head_y - B_Fy_by_L3_omega*span_L6_head_x - 2.0*L3_omega*cross_L6_L3;
    lin->value[33] = -2.0*L8_omega*cross_L6_L8;
    lin->value[34] = A_Fx_by_L6_omega*span_L7_tail_y - A_Fy_by_L6_omega*span_L7_tail_x
        + B_Fx_by_L6_omega*span_L7_tail_y - B_Fy_by_L6_omega*span_L7_tail_x + 2.0*L6_omega*cross_L6_L7;
    lin->value[35] = A_Fx_by_L7_omega*span_L7_tail_y - A_Fy_by_L7_omega*span_L7_tail_x
        + B_Fx_by_L7_omega*span_L7_tail_y - B_Fy_by_L7_omega*span_L7_tail_x;
    lin->value[36] = A_Fx_by_L2_omega*span_L7_tail_y - A_Fy_by_L2_omega*span_L7_tail_x - 2.0*L2_omega*cross_L7_L2;
    lin->value[37] = B_Fx_by_L3_omega*span_L7_tail_y - B_Fy_by_L3_omega*span_L7_tail_x - 2.0*L3_omega*cross_L7_L3;
    lin->value[38] = 2.0*L6_omega*cross_L6_L8;
    lin->value[39] = A_Fx_by_L6_omega*span_L2_tail_y - A_Fy_by_L6_omega*span_L2_tail_x - A_moment_second_by_L6_omega
        + 2.0*L6_omega*cross_L6_L2;
    lin->value[40] = A_Fx_by_L7_omega*span_L2_tail_y - A_Fy_by_L7_omega*span_L2_tail_x - A_moment_second_by_L7_omega
        + 2.0*L7_omega*cross_L7_L2;
    lin->value[41] = A_Fx_by_L2_omega*span_L2_tail_y - A_Fy_by_L2_omega*span_L2_tail_x - A_moment_second_by_L2_omega;
    lin->value[42] = B_Fx_by_L6_omega*span_L3_tail_y - B_Fy_by_L6_omega*span_L3_tail_x - B_moment_second_by_L6_omega
        + 2.0*L6_omega*cross_L6_L3;
    lin->value[43] = B_Fx_by_L7_omega*span_L3_tail_y - B_Fy_by_L7_omega*span_L3_tail_x - B_moment_second_by_L7_omega
        + 2.0*L7_omega*cross_L7_L3;
    lin->value[44] = B_Fx_by_L3_omega*span_L3_tail_y - B_Fy_by_L3_omega*span_L3_tail_x - B_moment_second_by_L3_omega;
    lin->value[45] = A_Fx_by_time*span_L6_head_y - A_Fy_by_time*span_L6_head_x + B_Fx_by_time*span_L6_head_y
        - B_Fy_by_time*span_L6_head_x;
    lin->value[46] = A_Fx_by_time*span_L7_tail_y - A_Fy_by_time*span_L7_tail_x + B_Fx_by_time*span_L7_tail_y
        - B_Fy_by_time*span_L7_tail_x;
    lin->value[47] = A_Fx_by_time*span_L2_tail_y - A_Fy_by_time*span_L2_tail_x - A_moment_second_by_time;
    lin->value[48] = B_Fx_by_time*span_L3_tail_y - B_Fy_by_time*span_L3_tail_x - B_moment_second_by_time;
    lin->value[49] = -A_Fx_by_L6_theta*crank1_rate*span_L1_head_y + A_Fy_by_L6_theta*crank1_rate*span_L1_head_x
        - A_moment_first_by_L6_theta*crank1_rate - B_Fx_by_L6_theta*crank4_rate*span_L4_head_y
        + B_Fy_by_L6_theta*crank4_rate*span_L4_head_x - B_moment_first_by_L6_theta*crank4_rate;
    lin->value[50] = -A_Fx_by_L7_theta*crank1_rate*span_L1_head_y + A_Fy_by_L7_theta*crank1_rate*span_L1_head_x
        - A_moment_first_by_L7_theta*crank1_rate - B_Fx_by_L7_theta*crank4_rate*span_L4_head_y
        + B_Fy_by_L7_theta*crank4_rate*span_L4_head_x - B_moment_first_by_L7_theta*crank4_rate;
    lin->value[51] = -A_Fx_by_L2_theta*crank1_rate*span_L1_head_y + A_Fy_by_L2_theta*crank1_rate*span_L1_head_x
        - A_moment_first_by_L2_theta*crank1_rate;
    lin->value[52] = -B_Fx_by_L3_theta*crank4_rate*span_L4_head_y + B_Fy_by_L3_theta*crank4_rate*span_L4_head_x
        - B_moment_first_by_L3_theta*crank4_rate;
    lin->value[53] = A_Fx*L2_tail_vx_by_L6_theta + A_Fx_by_L6_theta*(-L1_head_vx + L2_tail_vx)
        + A_Fy*L2_tail_vy_by_L6_theta + A_Fy_by_L6_theta*(-L1_head_vy + L2_tail_vy)
        + A_moment_first_by_L6_theta*crank1_rate + A_moment_second_by_L6_theta*L2_omega + B_Fx*L3_tail_vx_by_L6_theta
        + B_Fx_by_L6_theta*(L3_tail_vx - L4_head_vx) + B_Fy*L3_tail_vy_by_L6_theta
        + B_Fy_by_L6_theta*(L3_tail_vy - L4_head_vy) + B_moment_first_by_L6_theta*crank4_rate
        + B_moment_second_by_L6_theta*L3_omega;
    lin->value[54] = A_Fx*L2_tail_vx_by_L7_theta + A_Fx_by_L7_theta*(-L1_head_vx + L2_tail_vx)
        + A_Fy*L2_tail_vy_by_L7_theta + A_Fy_by_L7_theta*(-L1_head_vy + L2_tail_vy)
        + A_moment_first_by_L7_theta*crank1_rate + A_moment_second_by_L7_theta*L2_omega + B_Fx*L3_tail_vx_by_L7_theta
        + B_Fx_by_L7_theta*(L3_tail_vx - L4_head_vx) + B_Fy*L3_tail_vy_by_L7_theta
        + B_Fy_by_L7_theta*(L3_tail_vy - L4_head_vy) + B_moment_first_by_L7_theta*crank4_rate
        + B_moment_second_by_L7_theta*L3_omega;
    lin->value[55] = A_Fx*L2_tail_vx_by_L2_theta + A_Fx_by_L2_theta*(-L1_head_vx + L2_tail_vx)
        + A_Fy*L2_tail_vy_by_L2_theta + A_Fy_by_L2_theta*(-L1_head_vy + L2_tail_vy)
        + A_moment_first_by_L2_theta*crank1_rate + A_moment_second_by_L2_theta*L2_omega;
    lin->value[56] = B_Fx*L3_tail_vx_by_L3_theta + B_Fx_by_L3_theta*(L3_tail_vx - L4_head_vx)
        + B_Fy*L3_tail_vy_by_L3_theta + B_Fy_by_L3_theta*(L3_tail_vy - L4_head_vy)
        + B_moment_first_by_L3_theta*crank4_rate + B_moment_second_by_L3_theta*L3_omega;
    lin->value[57] = -A_Fx_by_L6_omega*crank1_rate*span_L1_head_y + A_Fy_by_L6_omega*crank1_rate*span_L1_head_x
        - A_moment_first_by_L6_omega*crank1_rate - B_Fx_by_L6_omega*crank4_rate*span_L4_head_y
        + B_Fy_by_L6_omega*crank4_rate*span_L4_head_x - B_moment_first_by_L6_omega*crank4_rate;
    lin->value[58] = -A_Fx_by_L7_omega*crank1_rate*span_L1_head_y + A_Fy_by_L7_omega*crank1_rate*span_L1_head_x
        - A_moment_first_by_L7_omega*crank1_rate - B_Fx_by_L7_omega*crank4_rate*span_L4_head_y
        + B_Fy_by_L7_omega*crank4_rate*span_L4_head_x - B_moment_first_by_L7_omega*crank4_rate;
    lin->value[59] = -A_Fx_by_L2_omega*crank1_rate*span_L1_head_y + A_Fy_by_L2_omega*crank1_rate*span_L1_head_x
        - A_moment_first_by_L2_omega*crank1_rate;
    lin->value[60] = -B_Fx_by_L3_omega*crank4_rate*span_L4_head_y + B_Fy_by_L3_omega*crank4_rate*span_L4_head_x
        - B_moment_first_by_L3_omega*crank4_rate;
    lin->value[61] = -A_Fx*span_L6_head_y + A_Fx_by_L6_omega*(-L1_head_vx + L2_tail_vx) + A_Fy*span_L6_head_x
        + A_Fy_by_L6_omega*(-L1_head_vy + L2_tail_vy) + A_moment_first_by_L6_omega*crank1_rate
        + A_moment_second_by_L6_omega*L2_omega - B_Fx*span_L6_head_y + B_Fx_by_L6_omega*(L3_tail_vx - L4_head_vx)
        + B_Fy*span_L6_head_x + B_Fy_by_L6_omega*(L3_tail_vy - L4_head_vy) + B_moment_first_by_L6_omega*crank4_rate
        + B_moment_second_by_L6_omega*L3_omega;
    lin->value[62] = -A_Fx*span_L7_tail_y + A_Fx_by_L7_omega*(-L1_head_vx + L2_tail_vx) + A_Fy*span_L7_tail_x
        + A_Fy_by_L7_omega*(-L1_head_vy + L2_tail_vy) + A_moment_first_by_L7_omega*crank1_rate
        + A_moment_second_by_L7_omega*L2_omega - B_Fx*span_L7_tail_y + B_Fx_by_L7_omega*(L3_tail_vx - L4_head_vx)
        + B_Fy*span_L7_tail_x + B_Fy_by_L7_omega*(L3_tail_vy - L4_head_vy) + B_moment_first_by_L7_omega*crank4_rate
        + B_moment_second_by_L7_omega*L3_omega;
    lin->value[63] = -A_Fx*span_L2_tail_y + A_Fx_by_L2_omega*(-L1_head_vx + L2_tail_vx) + A_Fy*span_L2_tail_x
        + A_Fy_by_L2_omega*(-L1_head_vy + L2_tail_vy) + A_moment_first_by_L2_omega*crank1_rate + A_moment_second
        + A_moment_second_by_L2_omega*L2_omega;
    lin->value[64] = -B_Fx*span_L3_tail_y + B_Fx_by_L3_omega*(L3_tail_vx - L4_head_vx) + B_Fy*span_L3_tail_x
        + B_Fy_by_L3_omega*(L3_tail_vy - L4_head_vy) + B_moment_first_by_L3_omega*crank4_rate + B_moment_second
        + B_moment_second_by_L3_omega*L3_omega;
    lin->value[65] = -A_Fx*crank1_rate*span_L1_head_y_by_time - A_Fx_by_time*crank1_rate*span_L1_head_y
        + A_Fy*crank1_rate*span_L1_head_x_by_time + A_Fy_by_time*crank1_rate*span_L1_head_x
        - A_moment_first_by_time*crank1_rate - B_Fx*crank4_rate*span_L4_head_y_by_time
        - B_Fx_by_time*crank4_rate*span_L4_head_y + B_Fy*crank4_rate*span_L4_head_x_by_time
        + B_Fy_by_time*crank4_rate*span_L4_head_x - B_moment_first_by_time*crank4_rate
        - cos_theta_L1_by_time*crank1_rate*p->weight_L1__across - cos_theta_L4_by_time*crank4_rate*p->weight_L4__across
        + crank1_acceleration*(-A_Fx*span_L1_head_y + A_Fy*span_L1_head_x - A_moment_first
        - cos_theta_L1*p->weight_L1__across + crank1_acceleration*p->mass_crank1_crank1)
        + crank4_acceleration*(-B_Fx*span_L4_head_y + B_Fy*span_L4_head_x - B_moment_first
        - cos_theta_L4*p->weight_L4__across + crank4_acceleration*p->mass_crank4_crank4);
    lin->value[66] = -A_Fx*L1_head_vx_by_time + A_Fx_by_time*(-L1_head_vx + L2_tail_vx) - A_Fy*L1_head_vy_by_time
        + A_Fy_by_time*(-L1_head_vy + L2_tail_vy) + A_moment_first*crank1_acceleration
        + A_moment_first_by_time*crank1_rate + A_moment_second_by_time*L2_omega - B_Fx*L4_head_vx_by_time
        + B_Fx_by_time*(L3_tail_vx - L4_head_vx) - B_Fy*L4_head_vy_by_time + B_Fy_by_time*(L3_tail_vy - L4_head_vy)
        + B_moment_first*crank4_acceleration + B_moment_first_by_time*crank4_rate + B_moment_second_by_time*L3_omega;
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
    const double mass_L6_theta_L7_theta = lin->value[0];
    const double mass_L6_theta_L2_theta = lin->value[1];
    const double mass_L7_theta_L2_theta = lin->value[2];
    const double mass_L6_theta_L3_theta = lin->value[3];
    const double mass_L7_theta_L3_theta = lin->value[4];
    const double mass_L6_theta_L8_theta = lin->value[5];
    const double phi_guide_offset_L6_theta = lin->value[6];
    const double phi_guide_offset_L8_theta = lin->value[7];
    const double by_q_guide_offset_L6_theta = lin->value[8];
    const double by_q_guide_offset_L8_theta = lin->value[9];
    const double by_q_L6_theta_L6_theta = lin->value[10];
    const double by_q_L6_theta_L7_theta = lin->value[11];
    const double by_q_L6_theta_L2_theta = lin->value[12];
    const double by_q_L6_theta_L3_theta = lin->value[13];
    const double by_q_L6_theta_L8_theta = lin->value[14];
    const double by_q_L7_theta_L6_theta = lin->value[15];
    const double by_q_L7_theta_L7_theta = lin->value[16];
    const double by_q_L7_theta_L2_theta = lin->value[17];
    const double by_q_L7_theta_L3_theta = lin->value[18];
    const double by_q_L8_theta_L8_theta = lin->value[19];
    const double by_q_L8_theta_L6_theta = lin->value[20];
    const double by_q_L2_theta_L6_theta = lin->value[21];
    const double by_q_L2_theta_L7_theta = lin->value[22];
    const double by_q_L2_theta_L2_theta = lin->value[23];
    const double by_q_L3_theta_L6_theta = lin->value[24];
    const double by_q_L3_theta_L7_theta = lin->value[25];
    const double by_q_L3_theta_L3_theta = lin->value[26];
    const double by_v_guide_offset_L6_theta = lin->value[27];
    const double by_v_guide_offset_L8_theta = lin->value[28];
    const double by_v_L6_theta_L6_theta = lin->value[29];
    const double by_v_L6_theta_L7_theta = lin->value[30];
    const double by_v_L6_theta_L2_theta = lin->value[31];
    const double by_v_L6_theta_L3_theta = lin->value[32];
    const double by_v_L6_theta_L8_theta = lin->value[33];
    const double by_v_L7_theta_L6_theta = lin->value[34];
    const double by_v_L7_theta_L7_theta = lin->value[35];
    const double by_v_L7_theta_L2_theta = lin->value[36];
    const double by_v_L7_theta_L3_theta = lin->value[37];
    const double by_v_L8_theta_L6_theta = lin->value[38];
    const double by_v_L2_theta_L6_theta = lin->value[39];
    const double by_v_L2_theta_L7_theta = lin->value[40];
    const double by_v_L2_theta_L2_theta = lin->value[41];
    const double by_v_L3_theta_L6_theta = lin->value[42];
    const double by_v_L3_theta_L7_theta = lin->value[43];
    const double by_v_L3_theta_L3_theta = lin->value[44];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const double n_L6_theta__L6_theta = eta*(by_q_L6_theta_L6_theta*eta + by_v_L6_theta_L6_theta) + p->mass_L6_L6;
    const double n_L6_theta__L7_theta = eta*(by_q_L6_theta_L7_theta*eta + by_v_L6_theta_L7_theta)
        + mass_L6_theta_L7_theta;
    const double n_L6_theta__L8_theta = eta*(by_q_L6_theta_L8_theta*eta + by_v_L6_theta_L8_theta)
        + mass_L6_theta_L8_theta;
    const double n_L6_theta__L2_theta = eta*(by_q_L6_theta_L2_theta*eta + by_v_L6_theta_L2_theta)
        + mass_L6_theta_L2_theta;
    const double n_L6_theta__L3_theta = eta*(by_q_L6_theta_L3_theta*eta + by_v_L6_theta_L3_theta)
        + mass_L6_theta_L3_theta;
    const double n_L7_theta__L6_theta = eta*(by_q_L7_theta_L6_theta*eta + by_v_L7_theta_L6_theta)
        + mass_L6_theta_L7_theta;
    const double n_L7_theta__L7_theta = eta*(by_q_L7_theta_L7_theta*eta + by_v_L7_theta_L7_theta) + p->mass_L7_L7;
    const double n_L7_theta__L2_theta = eta*(by_q_L7_theta_L2_theta*eta + by_v_L7_theta_L2_theta)
        + mass_L7_theta_L2_theta;
    const double n_L7_theta__L3_theta = eta*(by_q_L7_theta_L3_theta*eta + by_v_L7_theta_L3_theta)
        + mass_L7_theta_L3_theta;
    const double n_L8_theta__L6_theta = eta*(by_q_L8_theta_L6_theta*eta + by_v_L8_theta_L6_theta)
        + mass_L6_theta_L8_theta;
    const double n_L8_theta__L8_theta = by_q_L8_theta_L8_theta*(eta * eta) + p->mass_L8_L8;
    const double n_L2_theta__L6_theta = eta*(by_q_L2_theta_L6_theta*eta + by_v_L2_theta_L6_theta)
        + mass_L6_theta_L2_theta;
    const double n_L2_theta__L7_theta = eta*(by_q_L2_theta_L7_theta*eta + by_v_L2_theta_L7_theta)
        + mass_L7_theta_L2_theta;
    const double n_L2_theta__L2_theta = eta*(by_q_L2_theta_L2_theta*eta + by_v_L2_theta_L2_theta) + p->mass_L2_L2;
    const double n_L3_theta__L6_theta = eta*(by_q_L3_theta_L6_theta*eta + by_v_L3_theta_L6_theta)
        + mass_L6_theta_L3_theta;
    const double n_L3_theta__L7_theta = eta*(by_q_L3_theta_L7_theta*eta + by_v_L3_theta_L7_theta)
        + mass_L7_theta_L3_theta;
    const double n_L3_theta__L3_theta = eta*(by_q_L3_theta_L3_theta*eta + by_v_L3_theta_L3_theta) + p->mass_L3_L3;
    const double n_guide_offset__L6_theta = eta_row*(by_q_guide_offset_L6_theta*eta + by_v_guide_offset_L6_theta)
        + phi_guide_offset_L6_theta;
    const double n_guide_offset__L8_theta = eta_row*(by_q_guide_offset_L8_theta*eta + by_v_guide_offset_L8_theta)
        + phi_guide_offset_L8_theta;

    /* L U */
    const double scale_L8_theta = n_L8_theta__L8_theta;
    if (!(fabs(scale_L8_theta) > SINGULAR * fabs(n_L8_theta__L8_theta)))
        return 3;
    const double inverse_pivot_L8_theta = 1.0/scale_L8_theta;
    lin->lu[0] = inverse_pivot_L8_theta;
    const double l_L6_theta__L8_theta = inverse_pivot_L8_theta*n_L6_theta__L8_theta;
    lin->lu[1] = l_L6_theta__L8_theta;
    lin->lu[2] = n_L8_theta__L6_theta;
    const double l_guide_offset__L8_theta = inverse_pivot_L8_theta*n_guide_offset__L8_theta;
    lin->lu[3] = l_guide_offset__L8_theta;
    const double scale_L2_theta = n_L2_theta__L2_theta;
    if (!(fabs(scale_L2_theta) > SINGULAR * fabs(n_L2_theta__L2_theta)))
        return 4;
    const double inverse_pivot_L2_theta = 1.0/scale_L2_theta;
    lin->lu[4] = inverse_pivot_L2_theta;
    const double l_L7_theta__L2_theta = inverse_pivot_L2_theta*n_L7_theta__L2_theta;
    lin->lu[5] = l_L7_theta__L2_theta;
    lin->lu[6] = n_L2_theta__L7_theta;
    const double l_L6_theta__L2_theta = inverse_pivot_L2_theta*n_L6_theta__L2_theta;
    lin->lu[7] = l_L6_theta__L2_theta;
    lin->lu[8] = n_L2_theta__L6_theta;
    const double scale_L7_theta = -l_L7_theta__L2_theta*n_L2_theta__L7_theta + n_L7_theta__L7_theta;
    if (!(fabs(scale_L7_theta) > SINGULAR * fabs(n_L7_theta__L7_theta)))
        return 2;
    const double inverse_pivot_L7_theta = 1.0/scale_L7_theta;
    lin->lu[9] = inverse_pivot_L7_theta;
    const double l_L3_theta__L7_theta = inverse_pivot_L7_theta*n_L3_theta__L7_theta;
    lin->lu[10] = l_L3_theta__L7_theta;
    lin->lu[11] = n_L7_theta__L3_theta;
    const double l_L6_theta__L7_theta = inverse_pivot_L7_theta*(-l_L6_theta__L2_theta*n_L2_theta__L7_theta
        + n_L6_theta__L7_theta);
    lin->lu[12] = l_L6_theta__L7_theta;
    const double u_L7_theta__L6_theta = -l_L7_theta__L2_theta*n_L2_theta__L6_theta + n_L7_theta__L6_theta;
    lin->lu[13] = u_L7_theta__L6_theta;
    const double scale_L3_theta = -l_L3_theta__L7_theta*n_L7_theta__L3_theta + n_L3_theta__L3_theta;
    if (!(fabs(scale_L3_theta) > SINGULAR * fabs(n_L3_theta__L3_theta)))
        return 5;
    const double inverse_pivot_L3_theta = 1.0/scale_L3_theta;
    lin->lu[14] = inverse_pivot_L3_theta;
    const double l_L6_theta__L3_theta = inverse_pivot_L3_theta*(-l_L6_theta__L7_theta*n_L7_theta__L3_theta
        + n_L6_theta__L3_theta);
    lin->lu[15] = l_L6_theta__L3_theta;
    const double u_L3_theta__L6_theta = -l_L3_theta__L7_theta*u_L7_theta__L6_theta + n_L3_theta__L6_theta;
    lin->lu[16] = u_L3_theta__L6_theta;
    const double scale_L6_theta = -l_L6_theta__L2_theta*n_L2_theta__L6_theta
        - l_L6_theta__L3_theta*u_L3_theta__L6_theta - l_L6_theta__L7_theta*u_L7_theta__L6_theta
        - l_L6_theta__L8_theta*n_L8_theta__L6_theta + n_L6_theta__L6_theta;
    if (!(fabs(scale_L6_theta) > SINGULAR * fabs(n_L6_theta__L6_theta)))
        return 1;
    const double inverse_pivot_L6_theta = 1.0/scale_L6_theta;
    lin->lu[17] = inverse_pivot_L6_theta;
    const double l_guide_offset__L6_theta = inverse_pivot_L6_theta*(-l_guide_offset__L8_theta*n_L8_theta__L6_theta
        + n_guide_offset__L6_theta);
    lin->lu[18] = l_guide_offset__L6_theta;
    const double u_L6_theta__guide_offset = -l_L6_theta__L8_theta*phi_guide_offset_L8_theta + phi_guide_offset_L6_theta;
    lin->lu[19] = u_L6_theta__guide_offset;
    const double scale_guide_offset = -l_guide_offset__L6_theta*u_L6_theta__guide_offset
        - l_guide_offset__L8_theta*phi_guide_offset_L8_theta;
    if (!(scale_guide_offset != 0.0 && isfinite(scale_guide_offset)))
        return 6;
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    lin->lu[20] = inverse_pivot_guide_offset;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_guide_offset_L8_theta = lin->value[7];
    const double inverse_pivot_L8_theta = lin->lu[0];
    const double l_L6_theta__L8_theta = lin->lu[1];
    const double n_L8_theta__L6_theta = lin->lu[2];
    const double l_guide_offset__L8_theta = lin->lu[3];
    const double inverse_pivot_L2_theta = lin->lu[4];
    const double l_L7_theta__L2_theta = lin->lu[5];
    const double n_L2_theta__L7_theta = lin->lu[6];
    const double l_L6_theta__L2_theta = lin->lu[7];
    const double n_L2_theta__L6_theta = lin->lu[8];
    const double inverse_pivot_L7_theta = lin->lu[9];
    const double l_L3_theta__L7_theta = lin->lu[10];
    const double n_L7_theta__L3_theta = lin->lu[11];
    const double l_L6_theta__L7_theta = lin->lu[12];
    const double u_L7_theta__L6_theta = lin->lu[13];
    const double inverse_pivot_L3_theta = lin->lu[14];
    const double l_L6_theta__L3_theta = lin->lu[15];
    const double u_L3_theta__L6_theta = lin->lu[16];
    const double inverse_pivot_L6_theta = lin->lu[17];
    const double l_guide_offset__L6_theta = lin->lu[18];
    const double u_L6_theta__guide_offset = lin->lu[19];
    const double inverse_pivot_guide_offset = lin->lu[20];

    /* forward */
    const double b_L8_theta = x[2];
    const double b_L2_theta = x[3];
    const double b_L7_theta = -b_L2_theta*l_L7_theta__L2_theta + x[1];
    const double b_L3_theta = -b_L7_theta*l_L3_theta__L7_theta + x[4];
    const double b_L6_theta = -b_L2_theta*l_L6_theta__L2_theta - b_L3_theta*l_L6_theta__L3_theta
        - b_L7_theta*l_L6_theta__L7_theta - b_L8_theta*l_L6_theta__L8_theta + x[0];
    const double b_guide_offset = -b_L6_theta*l_guide_offset__L6_theta - b_L8_theta*l_guide_offset__L8_theta + x[5];

    /* backward */
    const double x_guide_offset = b_guide_offset*inverse_pivot_guide_offset;
    x[5] = x_guide_offset;
    const double x_L6_theta = inverse_pivot_L6_theta*(b_L6_theta - u_L6_theta__guide_offset*x_guide_offset);
    x[0] = x_L6_theta;
    const double x_L3_theta = inverse_pivot_L3_theta*(b_L3_theta - u_L3_theta__L6_theta*x_L6_theta);
    x[4] = x_L3_theta;
    const double x_L7_theta = inverse_pivot_L7_theta*(b_L7_theta - n_L7_theta__L3_theta*x_L3_theta
        - u_L7_theta__L6_theta*x_L6_theta);
    x[1] = x_L7_theta;
    const double x_L2_theta = inverse_pivot_L2_theta*(b_L2_theta - n_L2_theta__L6_theta*x_L6_theta
        - n_L2_theta__L7_theta*x_L7_theta);
    x[3] = x_L2_theta;
    const double x_L8_theta = inverse_pivot_L8_theta*(b_L8_theta - n_L8_theta__L6_theta*x_L6_theta
        - phi_guide_offset_L8_theta*x_guide_offset);
    x[2] = x_L8_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta = lin->value[0];
    const double mass_L6_theta_L2_theta = lin->value[1];
    const double mass_L7_theta_L2_theta = lin->value[2];
    const double mass_L6_theta_L3_theta = lin->value[3];
    const double mass_L7_theta_L3_theta = lin->value[4];
    const double mass_L6_theta_L8_theta = lin->value[5];
    const double phi_guide_offset_L6_theta = lin->value[6];
    const double phi_guide_offset_L8_theta = lin->value[7];
    const double by_q_guide_offset_L6_theta = lin->value[8];
    const double by_q_guide_offset_L8_theta = lin->value[9];
    const double by_q_L6_theta_L6_theta = lin->value[10];
    const double by_q_L6_theta_L7_theta = lin->value[11];
    const double by_q_L6_theta_L2_theta = lin->value[12];
    const double by_q_L6_theta_L3_theta = lin->value[13];
    const double by_q_L6_theta_L8_theta = lin->value[14];
    const double by_q_L7_theta_L6_theta = lin->value[15];
    const double by_q_L7_theta_L7_theta = lin->value[16];
    const double by_q_L7_theta_L2_theta = lin->value[17];
    const double by_q_L7_theta_L3_theta = lin->value[18];
    const double by_q_L8_theta_L8_theta = lin->value[19];
    const double by_q_L8_theta_L6_theta = lin->value[20];
    const double by_q_L2_theta_L6_theta = lin->value[21];
    const double by_q_L2_theta_L7_theta = lin->value[22];
    const double by_q_L2_theta_L2_theta = lin->value[23];
    const double by_q_L3_theta_L6_theta = lin->value[24];
    const double by_q_L3_theta_L7_theta = lin->value[25];
    const double by_q_L3_theta_L3_theta = lin->value[26];
    const double by_t_L6_theta = lin->value[45];
    const double by_t_L7_theta = lin->value[46];
    const double by_t_L2_theta = lin->value[47];
    const double by_t_L3_theta = lin->value[48];
    const double power_q_0_L6_theta = lin->value[49];
    const double power_q_0_L7_theta = lin->value[50];
    const double power_q_0_L2_theta = lin->value[51];
    const double power_q_0_L3_theta = lin->value[52];
    const double power_q_2_L6_theta = lin->value[53];
    const double power_q_2_L7_theta = lin->value[54];
    const double power_q_2_L2_theta = lin->value[55];
    const double power_q_2_L3_theta = lin->value[56];
    const double power_v_0_L6_theta = lin->value[57];
    const double power_v_0_L7_theta = lin->value[58];
    const double power_v_0_L2_theta = lin->value[59];
    const double power_v_0_L3_theta = lin->value[60];
    const double power_v_2_L6_theta = lin->value[61];
    const double power_v_2_L7_theta = lin->value[62];
    const double power_v_2_L2_theta = lin->value[63];
    const double power_v_2_L3_theta = lin->value[64];
    const double power_t_0 = lin->value[65];
    const double power_t_2 = lin->value[66];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    double x[6];
    const double shifted_L6_theta = -p->beta_squared*eta*r[0] + r[5];
    const double shifted_L8_theta = -p->beta_squared*eta*r[2] + r[7];
    x[0] = eta*(-by_q_L6_theta_L2_theta*eta*r[3] - by_q_L6_theta_L3_theta*eta*r[4] - by_q_L6_theta_L6_theta*eta*r[0]
        - by_q_L6_theta_L7_theta*eta*r[1] - by_q_L6_theta_L8_theta*eta*r[2] - by_t_L6_theta*s + p->mass_L6_L6*r[5]
        + mass_L6_theta_L2_theta*r[8] + mass_L6_theta_L3_theta*r[9] + mass_L6_theta_L7_theta*r[6]
        + mass_L6_theta_L8_theta*r[7]);
    x[1] = eta*(-by_q_L7_theta_L2_theta*eta*r[3] - by_q_L7_theta_L3_theta*eta*r[4] - by_q_L7_theta_L6_theta*eta*r[0]
        - by_q_L7_theta_L7_theta*eta*r[1] - by_t_L7_theta*s + mass_L6_theta_L7_theta*r[5] + p->mass_L7_L7*r[6]
        + mass_L7_theta_L2_theta*r[8] + mass_L7_theta_L3_theta*r[9]);
    x[2] = eta*(-by_q_L8_theta_L6_theta*eta*r[0] - by_q_L8_theta_L8_theta*eta*r[2] + mass_L6_theta_L8_theta*r[5]
        + p->mass_L8_L8*r[7]);
    x[3] = eta*(-by_q_L2_theta_L2_theta*eta*r[3] - by_q_L2_theta_L6_theta*eta*r[0] - by_q_L2_theta_L7_theta*eta*r[1]
        - by_t_L2_theta*s + p->mass_L2_L2*r[8] + mass_L6_theta_L2_theta*r[5] + mass_L7_theta_L2_theta*r[6]);
    x[4] = eta*(-by_q_L3_theta_L3_theta*eta*r[4] - by_q_L3_theta_L6_theta*eta*r[0] - by_q_L3_theta_L7_theta*eta*r[1]
        - by_t_L3_theta*s + p->mass_L3_L3*r[9] + mass_L6_theta_L3_theta*r[5] + mass_L7_theta_L3_theta*r[6]);
    x[5] = eta_row*(-by_q_guide_offset_L6_theta*eta*r[0] - by_q_guide_offset_L8_theta*eta*r[2]
        + phi_guide_offset_L6_theta*shifted_L6_theta + phi_guide_offset_L8_theta*shifted_L8_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[5] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[6] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[7] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[8] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[9] = x[4];
    u[10] = eta*(power_q_0_L2_theta*u[3] + power_q_0_L3_theta*u[4] + power_q_0_L6_theta*u[0] + power_q_0_L7_theta*u[1]
        + power_t_0*s + power_v_0_L2_theta*u[8] + power_v_0_L3_theta*u[9] + power_v_0_L6_theta*u[5]
        + power_v_0_L7_theta*u[6] + r[10]);
    u[11] = eta*r[11];
    u[12] = eta*(power_q_2_L2_theta*u[3] + power_q_2_L3_theta*u[4] + power_q_2_L6_theta*u[0] + power_q_2_L7_theta*u[1]
        + power_t_2*s + power_v_2_L2_theta*u[8] + power_v_2_L3_theta*u[9] + power_v_2_L6_theta*u[5]
        + power_v_2_L7_theta*u[6] + r[12]);
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {5, 0, 6, 1}, {5, 2, 7, 1}
};
static const LinearEntry residual_entries[] = {
    {5, 0, 8, 1}, {5, 2, 9, 1}, {0, 0, 10, 1}, {0, 1, 11, 1}, {0, 3, 12, 1}, {0, 4, 13, 1}, {0, 2, 14, 1},
    {1, 0, 15, 1}, {1, 1, 16, 1}, {1, 3, 17, 1}, {1, 4, 18, 1}, {2, 2, 19, 1}, {2, 0, 20, 1}, {3, 0, 21, 1},
    {3, 1, 22, 1}, {3, 3, 23, 1}, {4, 0, 24, 1}, {4, 1, 25, 1}, {4, 4, 26, 1}, {5, 5, 27, 1}, {5, 7, 28, 1},
    {0, 5, 29, 1}, {0, 6, 30, 1}, {0, 8, 31, 1}, {0, 9, 32, 1}, {0, 7, 33, 1}, {1, 5, 34, 1}, {1, 6, 35, 1},
    {1, 8, 36, 1}, {1, 9, 37, 1}, {2, 5, 38, 1}, {3, 5, 39, 1}, {3, 6, 40, 1}, {3, 8, 41, 1}, {4, 5, 42, 1},
    {4, 6, 43, 1}, {4, 9, 44, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 45, 1}, {1, 0, 46, 1}, {3, 0, 47, 1}, {4, 0, 48, 1}
};
static const LinearEntry power_entries[] = {
    {0, 0, 49, 1}, {0, 1, 50, 1}, {0, 3, 51, 1}, {0, 4, 52, 1}, {2, 0, 53, 1}, {2, 1, 54, 1}, {2, 3, 55, 1},
    {2, 4, 56, 1}, {0, 5, 57, 1}, {0, 6, 58, 1}, {0, 8, 59, 1}, {0, 9, 60, 1}, {2, 5, 61, 1}, {2, 6, 62, 1},
    {2, 8, 63, 1}, {2, 9, 64, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 65, 1}, {2, 0, 66, 1}
};
enum {
    N_PHI_Q = 2,
    N_RESIDUAL = 37,
    N_RESIDUAL_T = 4,
    N_POWER = 16,
    N_POWER_ROW = 0,
    N_POWER_T = 2,
    N_NODES = 6,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L7_theta = q[1];
    const double L8_theta = q[2];
    const double L8_omega = v[2];
    const double L2_theta = q[3];
    const double L3_theta = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {L6_theta, L7_theta, L8_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L3_theta, L3_theta, L3_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L6 = cosines_0[0];
    const double sin_theta_L6 = sines_0[0];
    const double cos_theta_L7 = cosines_0[1];
    const double sin_theta_L7 = sines_0[1];
    const double cos_theta_L8 = cosines_0[2];
    const double sin_theta_L8 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const double dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const double cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const double dot_L6_L2 = cos_L2_less_L6*p->inertia_L6_L2;
    const double cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const double dot_L7_L2 = cos_L2_less_L7*p->inertia_L7_L2;
    const double cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const double dot_L6_L3 = cos_L3_less_L6*p->inertia_L6_L3;
    const double cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const double dot_L7_L3 = cos_L3_less_L7*p->inertia_L7_L3;
    const double cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const double dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;

    /* Phi and Phi_dot */
    const double phi_guide_offset = -span_L6_head_x - span_L8_head_x;
    const double phi_dot_guide_offset = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;

    /* L D L^T of the KKT matrix */
    const double l_L6_theta__L8_theta = dot_L6_L8*p->inverse_mass_L8_L8;
    const double l_guide_offset__L8_theta = p->inverse_mass_L8_L8*span_L8_head_y;
    const double l_L7_theta__L2_theta = dot_L7_L2*p->inverse_mass_L2_L2;
    const double l_L6_theta__L2_theta = dot_L6_L2*p->inverse_mass_L2_L2;
    const double pivot_L7_theta = -dot_L7_L2*l_L7_theta__L2_theta + p->mass_L7_L7;
    const double determinant_L7_theta__L3_theta = -(dot_L7_L3 * dot_L7_L3) + p->mass_L3_L3*pivot_L7_theta;
    const double inverse_L7_theta__L3_theta = 1.0/determinant_L7_theta__L3_theta;
    const double inverse_pivot_L7_theta = inverse_L7_theta__L3_theta*p->mass_L3_L3;
    const double inverse_pivot_L3_theta = inverse_L7_theta__L3_theta*pivot_L7_theta;
    const double inverse_cross_L7_theta__L3_theta = -dot_L7_L3*inverse_L7_theta__L3_theta;
    const double w_L6_theta__L7_theta = dot_L6_L7 - dot_L7_L2*l_L6_theta__L2_theta;
    const double l_L6_theta__L7_theta = dot_L6_L3*inverse_cross_L7_theta__L3_theta
        + inverse_pivot_L7_theta*w_L6_theta__L7_theta;
    const double l_L6_theta__L3_theta = dot_L6_L3*inverse_pivot_L3_theta
        + inverse_cross_L7_theta__L3_theta*w_L6_theta__L7_theta;
    const double inverse_pivot_L6_theta = 1.0/(-dot_L6_L2*l_L6_theta__L2_theta - dot_L6_L3*l_L6_theta__L3_theta
        - dot_L6_L8*l_L6_theta__L8_theta - l_L6_theta__L7_theta*w_L6_theta__L7_theta + p->mass_L6_L6);
    const double w_guide_offset__L6_theta = -dot_L6_L8*l_guide_offset__L8_theta + span_L6_head_y;
    const double l_guide_offset__L6_theta = inverse_pivot_L6_theta*w_guide_offset__L6_theta;
    const double scale_guide_offset = l_guide_offset__L6_theta*w_guide_offset__L6_theta
        + l_guide_offset__L8_theta*span_L8_head_y;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY))
        return 1;
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;

    /* backward substitution */
    const double dq_lambda_guide_offset = -inverse_pivot_guide_offset*phi_guide_offset;
    const double dq_acceleration_L6_theta = -dq_lambda_guide_offset*l_guide_offset__L6_theta;
    const double dq_acceleration_L3_theta = -dq_acceleration_L6_theta*l_L6_theta__L3_theta;
    const double dq_acceleration_L7_theta = -dq_acceleration_L6_theta*l_L6_theta__L7_theta;
    const double dq_acceleration_L2_theta = -dq_acceleration_L6_theta*l_L6_theta__L2_theta
        - dq_acceleration_L7_theta*l_L7_theta__L2_theta;
    const double dq_acceleration_L8_theta = -dq_acceleration_L6_theta*l_L6_theta__L8_theta
        - dq_lambda_guide_offset*l_guide_offset__L8_theta;

    /* backward substitution */
    const double dv_lambda_guide_offset = -inverse_pivot_guide_offset*phi_dot_guide_offset;
    const double dv_acceleration_L6_theta = -dv_lambda_guide_offset*l_guide_offset__L6_theta;
    const double dv_acceleration_L3_theta = -dv_acceleration_L6_theta*l_L6_theta__L3_theta;
    const double dv_acceleration_L7_theta = -dv_acceleration_L6_theta*l_L6_theta__L7_theta;
    const double dv_acceleration_L2_theta = -dv_acceleration_L6_theta*l_L6_theta__L2_theta
        - dv_acceleration_L7_theta*l_L7_theta__L2_theta;
    const double dv_acceleration_L8_theta = -dv_acceleration_L6_theta*l_L6_theta__L8_theta
        - dv_lambda_guide_offset*l_guide_offset__L8_theta;

    /* results */
    dq[0] = dq_acceleration_L6_theta;
    dv[0] = dv_acceleration_L6_theta;
    dq[1] = dq_acceleration_L7_theta;
    dv[1] = dv_acceleration_L7_theta;
    dq[2] = dq_acceleration_L8_theta;
    dv[2] = dv_acceleration_L8_theta;
    dq[3] = dq_acceleration_L2_theta;
    dv[3] = dv_acceleration_L2_theta;
    dq[4] = dq_acceleration_L3_theta;
    dv[4] = dv_acceleration_L3_theta;
    *worst = max_of(0.0, fabs(phi_guide_offset));
    return 0;
}
