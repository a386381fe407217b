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
    const double depth_by_e_ = delta > 0.0 ? 1.0 : 0.0;
    const double ratio = latch->closed ? deltadot/latch->deltadot_minus : 1.0;
    const double ratio_by_deltadot_ = latch->closed ? 1.0/latch->deltadot_minus : 0.0;
    const double a_i = 0.5*delta + R_i;
    const double a_j = -0.5*delta + R_j;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const double v_t_by_e_ = -0.5*omega_i - 0.5*omega_j;

    /* contact */
    const double side_1 = side_of(side, g, corner, hysteresis*ratio + 1.0);
    const double power_depth_ = pow(depth, exponent - 1.0);
    double larger_1;
    if (side_1 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = hysteresis*ratio + 1.0;
    const double F_n = depth*K*power_depth_*larger_1;
    const double F_n_by_depth_ = exponent*K*power_depth_*larger_1;
    double branch_1;
    if (side_1 < 0.0)
        branch_1 = 0.0;
    else
        branch_1 = hysteresis;
    const double F_n_by_ratio_ = depth*K*power_depth_*branch_1;
    const double F_n_by_e_ = F_n_by_depth_*depth_by_e_;
    const double F_n_by_deltadot_ = F_n_by_ratio_*ratio_by_deltadot_;
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
    const double F_t_by_F_n_ = -mu*(-larger_2 + larger_3);
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
    const double F_t_by_v_t_ = -F_n*mu*(-branch_3 + branch_5);
    const double F_t_by_e_ = F_n_by_e_*F_t_by_F_n_ + F_t_by_v_t_*v_t_by_e_;
    const double F_t_by_deltadot_ = F_n_by_deltadot_*F_t_by_F_n_;
    const double F_t_by_omega_i_ = -F_t_by_v_t_*a_i;
    const double F_t_by_omega_j_ = F_t_by_v_t_*a_j;
    const double F_along_t_dry = F_t;
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_i_dry_by_e_ = -0.5*F_along_t_dry - F_t_by_e_*a_i;
    const double M_i_dry_by_deltadot_ = -F_t_by_deltadot_*a_i;
    const double M_i_dry_by_de_t_ = -F_t_by_v_t_*a_i;
    const double M_i_dry_by_omega_i_ = -F_t_by_omega_i_*a_i;
    const double M_i_dry_by_omega_j_ = -F_t_by_omega_j_*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    const double M_j_dry_by_e_ = -0.5*F_along_t_dry + F_t_by_e_*a_j;
    const double M_j_dry_by_deltadot_ = F_t_by_deltadot_*a_j;
    const double M_j_dry_by_de_t_ = F_t_by_v_t_*a_j;
    const double M_j_dry_by_omega_i_ = F_t_by_omega_i_*a_j;
    const double M_j_dry_by_omega_j_ = F_t_by_omega_j_*a_j;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e_;
    out->slope[0][1] = -F_n_by_deltadot_;
    out->slope[0][2] = 0.0;
    out->slope[0][3] = 0.0;
    out->slope[0][4] = 0.0;
    out->value[1] = F_along_t_dry;
    out->slope[1][0] = F_t_by_e_;
    out->slope[1][1] = F_t_by_deltadot_;
    out->slope[1][2] = F_t_by_v_t_;
    out->slope[1][3] = F_t_by_omega_i_;
    out->slope[1][4] = F_t_by_omega_j_;
    out->value[2] = M_i_dry;
    out->slope[2][0] = M_i_dry_by_e_;
    out->slope[2][1] = M_i_dry_by_deltadot_;
    out->slope[2][2] = M_i_dry_by_de_t_;
    out->slope[2][3] = M_i_dry_by_omega_i_;
    out->slope[2][4] = M_i_dry_by_omega_j_;
    out->value[3] = M_j_dry;
    out->slope[3][0] = M_j_dry_by_e_;
    out->slope[3][1] = M_j_dry_by_deltadot_;
    out->slope[3][2] = M_j_dry_by_de_t_;
    out->slope[3][3] = M_j_dry_by_omega_i_;
    out->slope[3][4] = M_j_dry_by_omega_j_;
}

/*
 * Joint A: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_A_(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance_;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent_, p->dry_friction_mu_, p->dry_friction_v0_, p->pin_radius_, p->R_j_pin_,
            p->pin_clearance_, p->dry_pin_K_, p->dry_pin_hysteresis_, p->dry_pin_friction_slope_, side, g, 0, out);
}

static void tangent_A_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance_) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_A_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_A_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_A_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
    dF[0][1] = -F.slope[1][0];
    dF[1][1] = F.slope[0][0];
    dF[2][1] = F.slope[2][0];
    dF[3][1] = F.slope[3][0];
}

/*
 * Joint B: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_B_(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance_;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent_, p->dry_friction_mu_, p->dry_friction_v0_, p->pin_radius_, p->R_j_pin_,
            p->pin_clearance_, p->dry_pin_K_, p->dry_pin_hysteresis_, p->dry_pin_friction_slope_, side, g, 5, out);
}

static void tangent_B_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance_) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_B_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_B_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_B_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L7_theta_ = q[1];
    const double L7_omega_ = v[1];
    const double L8_theta_ = q[2];
    const double L8_omega_ = v[2];
    const double L2_theta_ = q[3];
    const double L2_omega_ = v[3];
    const double L3_theta_ = q[4];
    const double L3_omega_ = v[4];
    const double a_L6_theta_ = a[0];
    const double a_L7_theta_ = a[1];
    const double a_L8_theta_ = a[2];
    const double a_L2_theta_ = a[3];
    const double a_L3_theta_ = a[4];
    const double held_lambda_guide_offset_ = aside->lambda[0];
    const double A_Fx_ = aside->clearance[0].Fx;
    const double A_Fy_ = aside->clearance[0].Fy;
    const double A_moment_first_ = aside->clearance[0].moment_first;
    const double A_moment_second_ = aside->clearance[0].moment_second;
    const double B_Fx_ = aside->clearance[1].Fx;
    const double B_Fy_ = aside->clearance[1].Fy;
    const double B_moment_first_ = aside->clearance[1].moment_first;
    const double B_moment_second_ = aside->clearance[1].moment_second;

    /* directions, arms, drives */
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank1_rate_ = p->omega_;
    const double crank1_acceleration_ = 0.0;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const double crank4_rate_ = p->omega4_;
    const double crank4_acceleration_ = 0.0;
    const double cos_theta_L1_ = cos(crank1_value_);
    const double sin_theta_L1_ = sin(crank1_value_);
    const double cos_theta_L4_ = cos(crank4_value_);
    const double sin_theta_L4_ = sin(crank4_value_);
    const double cos_theta_L6_ = cos(L6_theta_);
    const double sin_theta_L6_ = sin(L6_theta_);
    const double cos_theta_L7_ = cos(L7_theta_);
    const double sin_theta_L7_ = sin(L7_theta_);
    const double cos_theta_L8_ = cos(L8_theta_);
    const double sin_theta_L8_ = sin(L8_theta_);
    const double cos_theta_L2_ = cos(L2_theta_);
    const double sin_theta_L2_ = sin(L2_theta_);
    const double cos_theta_L3_ = cos(L3_theta_);
    const double sin_theta_L3_ = sin(L3_theta_);
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double L6_head_x_ = p->O6_x_ + span_L6_head_x_;
    const double L6_head_vx_ = -L6_omega_*span_L6_head_y_;
    const double L6_head_vy_ = L6_omega_*span_L6_head_x_;
    const double span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const double span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;
    const double L7_tail_x_ = L6_head_x_ + span_L7_tail_x_;
    const double L7_tail_vx_ = L6_head_vx_ - L7_omega_*span_L7_tail_y_;
    const double L7_tail_y_ = span_L6_head_y_ + span_L7_tail_y_;
    const double L7_tail_vy_ = L6_head_vy_ + L7_omega_*span_L7_tail_x_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const double span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const double L1_head_vx_ = -crank1_rate_*span_L1_head_y_;
    const double L1_head_vy_ = crank1_rate_*span_L1_head_x_;
    const double span_L2_tail_x_ = p->L2_tail_span_x_*cos_theta_L2_;
    const double span_L2_tail_y_ = p->L2_tail_span_x_*sin_theta_L2_;
    const double L2_tail_x_ = L7_tail_x_ + span_L2_tail_x_;
    const double L2_tail_vx_ = -L2_omega_*span_L2_tail_y_ + L7_tail_vx_;
    const double L2_tail_y_ = L7_tail_y_ + span_L2_tail_y_;
    const double L2_tail_vy_ = L2_omega_*span_L2_tail_x_ + L7_tail_vy_;
    const double span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const double span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const double L4_head_vx_ = -crank4_rate_*span_L4_head_y_;
    const double L4_head_y_ = p->O4_y_ + span_L4_head_y_;
    const double L4_head_vy_ = crank4_rate_*span_L4_head_x_;
    const double span_L3_tail_x_ = p->L3_tail_span_x_*cos_theta_L3_;
    const double span_L3_tail_y_ = p->L3_tail_span_x_*sin_theta_L3_;
    const double L3_tail_x_ = L7_tail_x_ + span_L3_tail_x_;
    const double L3_tail_vx_ = -L3_omega_*span_L3_tail_y_ + L7_tail_vx_;
    const double L3_tail_y_ = L7_tail_y_ + span_L3_tail_y_;
    const double L3_tail_vy_ = L3_omega_*span_L3_tail_x_ + L7_tail_vy_;
    const double cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const double sin_L7_less_L6_ = cos_theta_L6_*sin_theta_L7_ - cos_theta_L7_*sin_theta_L6_;
    const double dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const double cross_L6_L7_ = p->inertia_L6_L7_*sin_L7_less_L6_;
    const double cos_L2_less_L6_ = cos_theta_L2_*cos_theta_L6_ + sin_theta_L2_*sin_theta_L6_;
    const double sin_L2_less_L6_ = -cos_theta_L2_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L2_;
    const double dot_L6_L2_ = cos_L2_less_L6_*p->inertia_L6_L2_;
    const double cross_L6_L2_ = p->inertia_L6_L2_*sin_L2_less_L6_;
    const double cos_L2_less_L7_ = cos_theta_L2_*cos_theta_L7_ + sin_theta_L2_*sin_theta_L7_;
    const double sin_L2_less_L7_ = -cos_theta_L2_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L2_;
    const double dot_L7_L2_ = cos_L2_less_L7_*p->inertia_L7_L2_;
    const double cross_L7_L2_ = p->inertia_L7_L2_*sin_L2_less_L7_;
    const double cos_L3_less_L6_ = cos_theta_L3_*cos_theta_L6_ + sin_theta_L3_*sin_theta_L6_;
    const double sin_L3_less_L6_ = -cos_theta_L3_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L3_;
    const double dot_L6_L3_ = cos_L3_less_L6_*p->inertia_L6_L3_;
    const double cross_L6_L3_ = p->inertia_L6_L3_*sin_L3_less_L6_;
    const double cos_L3_less_L7_ = cos_theta_L3_*cos_theta_L7_ + sin_theta_L3_*sin_theta_L7_;
    const double sin_L3_less_L7_ = -cos_theta_L3_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L3_;
    const double dot_L7_L3_ = cos_L3_less_L7_*p->inertia_L7_L3_;
    const double cross_L7_L3_ = p->inertia_L7_L3_*sin_L3_less_L7_;
    const double cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const double sin_L8_less_L6_ = cos_theta_L6_*sin_theta_L8_ - cos_theta_L8_*sin_theta_L6_;
    const double dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;
    const double cross_L6_L8_ = p->inertia_L6_L8_*sin_L8_less_L6_;

    /* clearance joint A */
    const double e_A_x_ = L2_tail_x_ - span_L1_head_x_;
    const double e_A_y_ = L2_tail_y_ - span_L1_head_y_;
    const double edot_A_x_ = -L1_head_vx_ + L2_tail_vx_;
    const double edot_A_y_ = -L1_head_vy_ + L2_tail_vy_;
    double change_A_[4][6];
    tangent_A_(e_A_x_, e_A_y_, edot_A_x_, edot_A_y_, crank1_rate_, L2_omega_, &memory->latch[0], p, side, g, change_A_);
    const double span_L1_head_x_by_time_ = -crank1_rate_*span_L1_head_y_;
    const double span_L1_head_y_by_time_ = crank1_rate_*span_L1_head_x_;
    const double L1_head_vx_by_time_ = -crank1_acceleration_*span_L1_head_y_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_x_;
    const double L2_tail_vx_by_L6_theta_ = -L6_omega_*span_L6_head_x_;
    const double L2_tail_vx_by_L7_theta_ = -L7_omega_*span_L7_tail_x_;
    const double L2_tail_vx_by_L2_theta_ = -L2_omega_*span_L2_tail_x_;
    const double L1_head_vy_by_time_ = crank1_acceleration_*span_L1_head_x_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_y_;
    const double L2_tail_vy_by_L6_theta_ = -L6_omega_*span_L6_head_y_;
    const double L2_tail_vy_by_L7_theta_ = -L7_omega_*span_L7_tail_y_;
    const double L2_tail_vy_by_L2_theta_ = -L2_omega_*span_L2_tail_y_;
    const double A_Fx_by_e_x_ = change_A_[0][0];
    const double A_Fx_by_e_y_ = change_A_[0][1];
    const double A_Fx_by_de_x_ = change_A_[0][2];
    const double A_Fx_by_de_y_ = change_A_[0][3];
    const double A_Fx_by_omega_i_ = change_A_[0][4];
    const double A_Fx_by_omega_j_ = change_A_[0][5];
    const double A_Fx_by_L6_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L6_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L6_theta_
        - A_Fx_by_e_x_*span_L6_head_y_ + A_Fx_by_e_y_*span_L6_head_x_;
    const double A_Fx_by_L7_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L7_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L7_theta_
        - A_Fx_by_e_x_*span_L7_tail_y_ + A_Fx_by_e_y_*span_L7_tail_x_;
    const double A_Fx_by_L2_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L2_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L2_theta_
        - A_Fx_by_e_x_*span_L2_tail_y_ + A_Fx_by_e_y_*span_L2_tail_x_;
    const double A_Fx_by_time_ = -A_Fx_by_de_x_*L1_head_vx_by_time_ - A_Fx_by_de_y_*L1_head_vy_by_time_
        - A_Fx_by_e_x_*span_L1_head_x_by_time_ - A_Fx_by_e_y_*span_L1_head_y_by_time_
        + A_Fx_by_omega_i_*crank1_acceleration_;
    const double A_Fx_by_L6_omega_ = -A_Fx_by_de_x_*span_L6_head_y_ + A_Fx_by_de_y_*span_L6_head_x_;
    const double A_Fx_by_L7_omega_ = -A_Fx_by_de_x_*span_L7_tail_y_ + A_Fx_by_de_y_*span_L7_tail_x_;
    const double A_Fx_by_L2_omega_ = -A_Fx_by_de_x_*span_L2_tail_y_ + A_Fx_by_de_y_*span_L2_tail_x_ + A_Fx_by_omega_j_;
    const double A_Fy_by_e_x_ = change_A_[1][0];
    const double A_Fy_by_e_y_ = change_A_[1][1];
    const double A_Fy_by_de_x_ = change_A_[1][2];
    const double A_Fy_by_de_y_ = change_A_[1][3];
    const double A_Fy_by_omega_i_ = change_A_[1][4];
    const double A_Fy_by_omega_j_ = change_A_[1][5];
    const double A_Fy_by_L6_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L6_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L6_theta_
        - A_Fy_by_e_x_*span_L6_head_y_ + A_Fy_by_e_y_*span_L6_head_x_;
    const double A_Fy_by_L7_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L7_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L7_theta_
        - A_Fy_by_e_x_*span_L7_tail_y_ + A_Fy_by_e_y_*span_L7_tail_x_;
    const double A_Fy_by_L2_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L2_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L2_theta_
        - A_Fy_by_e_x_*span_L2_tail_y_ + A_Fy_by_e_y_*span_L2_tail_x_;
    const double A_Fy_by_time_ = -A_Fy_by_de_x_*L1_head_vx_by_time_ - A_Fy_by_de_y_*L1_head_vy_by_time_
        - A_Fy_by_e_x_*span_L1_head_x_by_time_ - A_Fy_by_e_y_*span_L1_head_y_by_time_
        + A_Fy_by_omega_i_*crank1_acceleration_;
    const double A_Fy_by_L6_omega_ = -A_Fy_by_de_x_*span_L6_head_y_ + A_Fy_by_de_y_*span_L6_head_x_;
    const double A_Fy_by_L7_omega_ = -A_Fy_by_de_x_*span_L7_tail_y_ + A_Fy_by_de_y_*span_L7_tail_x_;
    const double A_Fy_by_L2_omega_ = -A_Fy_by_de_x_*span_L2_tail_y_ + A_Fy_by_de_y_*span_L2_tail_x_ + A_Fy_by_omega_j_;
    const double A_moment_first_by_e_x_ = change_A_[2][0];
    const double A_moment_first_by_e_y_ = change_A_[2][1];
    const double A_moment_first_by_de_x_ = change_A_[2][2];
    const double A_moment_first_by_de_y_ = change_A_[2][3];
    const double A_moment_first_by_omega_i_ = change_A_[2][4];
    const double A_moment_first_by_omega_j_ = change_A_[2][5];
    const double A_moment_first_by_L6_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L6_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L6_theta_ - A_moment_first_by_e_x_*span_L6_head_y_
        + A_moment_first_by_e_y_*span_L6_head_x_;
    const double A_moment_first_by_L7_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L7_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L7_theta_ - A_moment_first_by_e_x_*span_L7_tail_y_
        + A_moment_first_by_e_y_*span_L7_tail_x_;
    const double A_moment_first_by_L2_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L2_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L2_theta_ - A_moment_first_by_e_x_*span_L2_tail_y_
        + A_moment_first_by_e_y_*span_L2_tail_x_;
    const double A_moment_first_by_time_ = -A_moment_first_by_de_x_*L1_head_vx_by_time_
        - A_moment_first_by_de_y_*L1_head_vy_by_time_ - A_moment_first_by_e_x_*span_L1_head_x_by_time_
        - A_moment_first_by_e_y_*span_L1_head_y_by_time_ + A_moment_first_by_omega_i_*crank1_acceleration_;
    const double A_moment_first_by_L6_omega_ = -A_moment_first_by_de_x_*span_L6_head_y_
        + A_moment_first_by_de_y_*span_L6_head_x_;
    const double A_moment_first_by_L7_omega_ = -A_moment_first_by_de_x_*span_L7_tail_y_
        + A_moment_first_by_de_y_*span_L7_tail_x_;
    const double A_moment_first_by_L2_omega_ = -A_moment_first_by_de_x_*span_L2_tail_y_
        + A_moment_first_by_de_y_*span_L2_tail_x_ + A_moment_first_by_omega_j_;
    const double A_moment_second_by_e_x_ = change_A_[3][0];
    const double A_moment_second_by_e_y_ = change_A_[3][1];
    const double A_moment_second_by_de_x_ = change_A_[3][2];
    const double A_moment_second_by_de_y_ = change_A_[3][3];
    const double A_moment_second_by_omega_i_ = change_A_[3][4];
    const double A_moment_second_by_omega_j_ = change_A_[3][5];
    const double A_moment_second_by_L6_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L6_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L6_theta_ - A_moment_second_by_e_x_*span_L6_head_y_
        + A_moment_second_by_e_y_*span_L6_head_x_;
    const double A_moment_second_by_L7_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L7_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L7_theta_ - A_moment_second_by_e_x_*span_L7_tail_y_
        + A_moment_second_by_e_y_*span_L7_tail_x_;
    const double A_moment_second_by_L2_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L2_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L2_theta_ - A_moment_second_by_e_x_*span_L2_tail_y_
        + A_moment_second_by_e_y_*span_L2_tail_x_;
    const double A_moment_second_by_time_ = -A_moment_second_by_de_x_*L1_head_vx_by_time_
        - A_moment_second_by_de_y_*L1_head_vy_by_time_ - A_moment_second_by_e_x_*span_L1_head_x_by_time_
        - A_moment_second_by_e_y_*span_L1_head_y_by_time_ + A_moment_second_by_omega_i_*crank1_acceleration_;
    const double A_moment_second_by_L6_omega_ = -A_moment_second_by_de_x_*span_L6_head_y_
        + A_moment_second_by_de_y_*span_L6_head_x_;
    const double A_moment_second_by_L7_omega_ = -A_moment_second_by_de_x_*span_L7_tail_y_
        + A_moment_second_by_de_y_*span_L7_tail_x_;
    const double A_moment_second_by_L2_omega_ = -A_moment_second_by_de_x_*span_L2_tail_y_
        + A_moment_second_by_de_y_*span_L2_tail_x_ + A_moment_second_by_omega_j_;

    /* clearance joint B */
    const double e_B_x_ = L3_tail_x_ - span_L4_head_x_;
    const double e_B_y_ = L3_tail_y_ - L4_head_y_;
    const double edot_B_x_ = L3_tail_vx_ - L4_head_vx_;
    const double edot_B_y_ = L3_tail_vy_ - L4_head_vy_;
    double change_B_[4][6];
    tangent_B_(e_B_x_, e_B_y_, edot_B_x_, edot_B_y_, crank4_rate_, L3_omega_, &memory->latch[1], p, side, g, change_B_);
    const double span_L4_head_x_by_time_ = -crank4_rate_*span_L4_head_y_;
    const double L4_head_y_by_time_ = crank4_rate_*span_L4_head_x_;
    const double L3_tail_vx_by_L6_theta_ = -L6_omega_*span_L6_head_x_;
    const double L3_tail_vx_by_L7_theta_ = -L7_omega_*span_L7_tail_x_;
    const double L3_tail_vx_by_L3_theta_ = -L3_omega_*span_L3_tail_x_;
    const double L4_head_vx_by_time_ = -crank4_acceleration_*span_L4_head_y_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_x_;
    const double L3_tail_vy_by_L6_theta_ = -L6_omega_*span_L6_head_y_;
    const double L3_tail_vy_by_L7_theta_ = -L7_omega_*span_L7_tail_y_;
    const double L3_tail_vy_by_L3_theta_ = -L3_omega_*span_L3_tail_y_;
    const double L4_head_vy_by_time_ = crank4_acceleration_*span_L4_head_x_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_y_;
    const double B_Fx_by_e_x_ = change_B_[0][0];
    const double B_Fx_by_e_y_ = change_B_[0][1];
    const double B_Fx_by_de_x_ = change_B_[0][2];
    const double B_Fx_by_de_y_ = change_B_[0][3];
    const double B_Fx_by_omega_i_ = change_B_[0][4];
    const double B_Fx_by_omega_j_ = change_B_[0][5];
    const double B_Fx_by_L6_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L6_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L6_theta_
        - B_Fx_by_e_x_*span_L6_head_y_ + B_Fx_by_e_y_*span_L6_head_x_;
    const double B_Fx_by_L7_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L7_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L7_theta_
        - B_Fx_by_e_x_*span_L7_tail_y_ + B_Fx_by_e_y_*span_L7_tail_x_;
    const double B_Fx_by_L3_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L3_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L3_theta_
        - B_Fx_by_e_x_*span_L3_tail_y_ + B_Fx_by_e_y_*span_L3_tail_x_;
    const double B_Fx_by_time_ = -B_Fx_by_de_x_*L4_head_vx_by_time_ - B_Fx_by_de_y_*L4_head_vy_by_time_
        - B_Fx_by_e_x_*span_L4_head_x_by_time_ - B_Fx_by_e_y_*L4_head_y_by_time_
        + B_Fx_by_omega_i_*crank4_acceleration_;
    const double B_Fx_by_L6_omega_ = -B_Fx_by_de_x_*span_L6_head_y_ + B_Fx_by_de_y_*span_L6_head_x_;
    const double B_Fx_by_L7_omega_ = -B_Fx_by_de_x_*span_L7_tail_y_ + B_Fx_by_de_y_*span_L7_tail_x_;
    const double B_Fx_by_L3_omega_ = -B_Fx_by_de_x_*span_L3_tail_y_ + B_Fx_by_de_y_*span_L3_tail_x_ + B_Fx_by_omega_j_;
    const double B_Fy_by_e_x_ = change_B_[1][0];
    const double B_Fy_by_e_y_ = change_B_[1][1];
    const double B_Fy_by_de_x_ = change_B_[1][2];
    const double B_Fy_by_de_y_ = change_B_[1][3];
    const double B_Fy_by_omega_i_ = change_B_[1][4];
    const double B_Fy_by_omega_j_ = change_B_[1][5];
    const double B_Fy_by_L6_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L6_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L6_theta_
        - B_Fy_by_e_x_*span_L6_head_y_ + B_Fy_by_e_y_*span_L6_head_x_;
    const double B_Fy_by_L7_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L7_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L7_theta_
        - B_Fy_by_e_x_*span_L7_tail_y_ + B_Fy_by_e_y_*span_L7_tail_x_;
    const double B_Fy_by_L3_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L3_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L3_theta_
        - B_Fy_by_e_x_*span_L3_tail_y_ + B_Fy_by_e_y_*span_L3_tail_x_;
    const double B_Fy_by_time_ = -B_Fy_by_de_x_*L4_head_vx_by_time_ - B_Fy_by_de_y_*L4_head_vy_by_time_
        - B_Fy_by_e_x_*span_L4_head_x_by_time_ - B_Fy_by_e_y_*L4_head_y_by_time_
        + B_Fy_by_omega_i_*crank4_acceleration_;
    const double B_Fy_by_L6_omega_ = -B_Fy_by_de_x_*span_L6_head_y_ + B_Fy_by_de_y_*span_L6_head_x_;
    const double B_Fy_by_L7_omega_ = -B_Fy_by_de_x_*span_L7_tail_y_ + B_Fy_by_de_y_*span_L7_tail_x_;
    const double B_Fy_by_L3_omega_ = -B_Fy_by_de_x_*span_L3_tail_y_ + B_Fy_by_de_y_*span_L3_tail_x_ + B_Fy_by_omega_j_;
    const double B_moment_first_by_e_x_ = change_B_[2][0];
    const double B_moment_first_by_e_y_ = change_B_[2][1];
    const double B_moment_first_by_de_x_ = change_B_[2][2];
    const double B_moment_first_by_de_y_ = change_B_[2][3];
    const double B_moment_first_by_omega_i_ = change_B_[2][4];
    const double B_moment_first_by_omega_j_ = change_B_[2][5];
    const double B_moment_first_by_L6_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L6_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L6_theta_ - B_moment_first_by_e_x_*span_L6_head_y_
        + B_moment_first_by_e_y_*span_L6_head_x_;
    const double B_moment_first_by_L7_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L7_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L7_theta_ - B_moment_first_by_e_x_*span_L7_tail_y_
        + B_moment_first_by_e_y_*span_L7_tail_x_;
    const double B_moment_first_by_L3_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L3_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L3_theta_ - B_moment_first_by_e_x_*span_L3_tail_y_
        + B_moment_first_by_e_y_*span_L3_tail_x_;
    const double B_moment_first_by_time_ = -B_moment_first_by_de_x_*L4_head_vx_by_time_
        - B_moment_first_by_de_y_*L4_head_vy_by_time_ - B_moment_first_by_e_x_*span_L4_head_x_by_time_
        - B_moment_first_by_e_y_*L4_head_y_by_time_ + B_moment_first_by_omega_i_*crank4_acceleration_;
    const double B_moment_first_by_L6_omega_ = -B_moment_first_by_de_x_*span_L6_head_y_
        + B_moment_first_by_de_y_*span_L6_head_x_;
    const double B_moment_first_by_L7_omega_ = -B_moment_first_by_de_x_*span_L7_tail_y_
        + B_moment_first_by_de_y_*span_L7_tail_x_;
    const double B_moment_first_by_L3_omega_ = -B_moment_first_by_de_x_*span_L3_tail_y_
        + B_moment_first_by_de_y_*span_L3_tail_x_ + B_moment_first_by_omega_j_;
    const double B_moment_second_by_e_x_ = change_B_[3][0];
    const double B_moment_second_by_e_y_ = change_B_[3][1];
    const double B_moment_second_by_de_x_ = change_B_[3][2];
    const double B_moment_second_by_de_y_ = change_B_[3][3];
    const double B_moment_second_by_omega_i_ = change_B_[3][4];
    const double B_moment_second_by_omega_j_ = change_B_[3][5];
    const double B_moment_second_by_L6_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L6_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L6_theta_ - B_moment_second_by_e_x_*span_L6_head_y_
        + B_moment_second_by_e_y_*span_L6_head_x_;
    const double B_moment_second_by_L7_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L7_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L7_theta_ - B_moment_second_by_e_x_*span_L7_tail_y_
        + B_moment_second_by_e_y_*span_L7_tail_x_;
    const double B_moment_second_by_L3_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L3_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L3_theta_ - B_moment_second_by_e_x_*span_L3_tail_y_
        + B_moment_second_by_e_y_*span_L3_tail_x_;
    const double B_moment_second_by_time_ = -B_moment_second_by_de_x_*L4_head_vx_by_time_
        - B_moment_second_by_de_y_*L4_head_vy_by_time_ - B_moment_second_by_e_x_*span_L4_head_x_by_time_
        - B_moment_second_by_e_y_*L4_head_y_by_time_ + B_moment_second_by_omega_i_*crank4_acceleration_;
    const double B_moment_second_by_L6_omega_ = -B_moment_second_by_de_x_*span_L6_head_y_
        + B_moment_second_by_de_y_*span_L6_head_x_;
    const double B_moment_second_by_L7_omega_ = -B_moment_second_by_de_x_*span_L7_tail_y_
        + B_moment_second_by_de_y_*span_L7_tail_x_;
    const double B_moment_second_by_L3_omega_ = -B_moment_second_by_de_x_*span_L3_tail_y_
        + B_moment_second_by_de_y_*span_L3_tail_x_ + B_moment_second_by_omega_j_;

    /* powers */
    const double cos_theta_L1_by_time_ = -crank1_rate_*sin_theta_L1_;
    const double cos_theta_L4_by_time_ = -crank4_rate_*sin_theta_L4_;
    const double span_L4_head_y_by_time_ = crank4_rate_*span_L4_head_x_;

    /* results */
    lin->value[0] = dot_L6_L7_;
    lin->value[1] = dot_L6_L2_;
    lin->value[2] = dot_L7_L2_;
    lin->value[3] = dot_L6_L3_;
    lin->value[4] = dot_L7_L3_;
    lin->value[5] = dot_L6_L8_;
    lin->value[6] = span_L6_head_y_;
    lin->value[7] = span_L8_head_y_;
    lin->value[8] = -(L6_omega_ * L6_omega_)*span_L6_head_y_ + L6_omega_*span_L6_head_x_*p->two_alpha_
        + a_L6_theta_*span_L6_head_x_;
    lin->value[9] = -(L8_omega_ * L8_omega_)*span_L8_head_y_ + L8_omega_*span_L8_head_x_*p->two_alpha_
        + a_L8_theta_*span_L8_head_x_;
    lin->value[10] = A_Fx_by_L6_theta_*span_L6_head_y_ - A_Fy_by_L6_theta_*span_L6_head_x_
        + B_Fx_by_L6_theta_*span_L6_head_y_ - B_Fy_by_L6_theta_*span_L6_head_x_ + (L2_omega_ * L2_omega_)*dot_L6_L2_
        + (L3_omega_ * L3_omega_)*dot_L6_L3_ + (L7_omega_ * L7_omega_)*dot_L6_L7_ + (L8_omega_ * L8_omega_)*dot_L6_L8_
        + a_L2_theta_*cross_L6_L2_ + a_L3_theta_*cross_L6_L3_ + a_L7_theta_*cross_L6_L7_ + a_L8_theta_*cross_L6_L8_
        + sin_theta_L6_*p->weight_L6_across_ + span_L6_head_x_*(A_Fx_ + B_Fx_ + held_lambda_guide_offset_)
        - span_L6_head_y_*(-A_Fy_ - B_Fy_);
    lin->value[11] = A_Fx_by_L7_theta_*span_L6_head_y_ - A_Fy_by_L7_theta_*span_L6_head_x_
        + B_Fx_by_L7_theta_*span_L6_head_y_ - B_Fy_by_L7_theta_*span_L6_head_x_ - (L7_omega_ * L7_omega_)*dot_L6_L7_
        - a_L7_theta_*cross_L6_L7_;
    lin->value[12] = A_Fx_by_L2_theta_*span_L6_head_y_ - A_Fy_by_L2_theta_*span_L6_head_x_
        - (L2_omega_ * L2_omega_)*dot_L6_L2_ - a_L2_theta_*cross_L6_L2_;
    lin->value[13] = B_Fx_by_L3_theta_*span_L6_head_y_ - B_Fy_by_L3_theta_*span_L6_head_x_
        - (L3_omega_ * L3_omega_)*dot_L6_L3_ - a_L3_theta_*cross_L6_L3_;
    lin->value[14] = -(L8_omega_ * L8_omega_)*dot_L6_L8_ - a_L8_theta_*cross_L6_L8_;
    lin->value[15] = A_Fx_by_L6_theta_*span_L7_tail_y_ - A_Fy_by_L6_theta_*span_L7_tail_x_
        + B_Fx_by_L6_theta_*span_L7_tail_y_ - B_Fy_by_L6_theta_*span_L7_tail_x_ - (L6_omega_ * L6_omega_)*dot_L6_L7_
        + a_L6_theta_*cross_L6_L7_;
    lin->value[16] = A_Fx_by_L7_theta_*span_L7_tail_y_ - A_Fy_by_L7_theta_*span_L7_tail_x_
        + B_Fx_by_L7_theta_*span_L7_tail_y_ - B_Fy_by_L7_theta_*span_L7_tail_x_ + (L2_omega_ * L2_omega_)*dot_L7_L2_
        + (L3_omega_ * L3_omega_)*dot_L7_L3_ + (L6_omega_ * L6_omega_)*dot_L6_L7_ + a_L2_theta_*cross_L7_L2_
        + a_L3_theta_*cross_L7_L3_ - a_L6_theta_*cross_L6_L7_ + sin_theta_L7_*p->weight_L7_across_
        + span_L7_tail_x_*(A_Fx_ + B_Fx_) - span_L7_tail_y_*(-A_Fy_ - B_Fy_);
    lin->value[17] = A_Fx_by_L2_theta_*span_L7_tail_y_ - A_Fy_by_L2_theta_*span_L7_tail_x_
        - (L2_omega_ * L2_omega_)*dot_L7_L2_ - a_L2_theta_*cross_L7_L2_;
    lin->value[18] = B_Fx_by_L3_theta_*span_L7_tail_y_ - B_Fy_by_L3_theta_*span_L7_tail_x_
        - (L3_omega_ * L3_omega_)*dot_L7_L3_ - a_L3_theta_*cross_L7_L3_;
    lin->value[19] = (L6_omega_ * L6_omega_)*dot_L6_L8_ - a_L6_theta_*cross_L6_L8_
        + held_lambda_guide_offset_*span_L8_head_x_ + sin_theta_L8_*p->weight_L8_across_;
    lin->value[20] = -(L6_omega_ * L6_omega_)*dot_L6_L8_ + a_L6_theta_*cross_L6_L8_;
    lin->value[21] = A_Fx_by_L6_theta_*span_L2_tail_y_ - A_Fy_by_L6_theta_*span_L2_tail_x_
        - A_moment_second_by_L6_theta_ - (L6_omega_ * L6_omega_)*dot_L6_L2_ + a_L6_theta_*cross_L6_L2_;
    lin->value[22] = A_Fx_by_L7_theta_*span_L2_tail_y_ - A_Fy_by_L7_theta_*span_L2_tail_x_
        - A_moment_second_by_L7_theta_ - (L7_omega_ * L7_omega_)*dot_L7_L2_ + a_L7_theta_*cross_L7_L2_;
    lin->value[23] = A_Fx_*span_L2_tail_x_ + A_Fx_by_L2_theta_*span_L2_tail_y_ + A_Fy_*span_L2_tail_y_
        - A_Fy_by_L2_theta_*span_L2_tail_x_ - A_moment_second_by_L2_theta_ + (L6_omega_ * L6_omega_)*dot_L6_L2_
        + (L7_omega_ * L7_omega_)*dot_L7_L2_ - a_L6_theta_*cross_L6_L2_ - a_L7_theta_*cross_L7_L2_
        + sin_theta_L2_*p->weight_L2_across_;
    lin->value[24] = B_Fx_by_L6_theta_*span_L3_tail_y_ - B_Fy_by_L6_theta_*span_L3_tail_x_
        - B_moment_second_by_L6_theta_ - (L6_omega_ * L6_omega_)*dot_L6_L3_ + a_L6_theta_*cross_L6_L3_;
    lin->value[25] = B_Fx_by_L7_theta_*span_L3_tail_y_ - B_Fy_by_L7_theta_*span_L3_tail_x_
        - B_moment_second_by_L7_theta_ - (L7_omega_ * L7_omega_)*dot_L7_L3_ + a_L7_theta_*cross_L7_L3_;
    lin->value[26] = B_Fx_*span_L3_tail_x_ + B_Fx_by_L3_theta_*span_L3_tail_y_ + B_Fy_*span_L3_tail_y_
        - B_Fy_by_L3_theta_*span_L3_tail_x_ - B_moment_second_by_L3_theta_ + (L6_omega_ * L6_omega_)*dot_L6_L3_
        + (L7_omega_ * L7_omega_)*dot_L7_L3_ - a_L6_theta_*cross_L6_L3_ - a_L7_theta_*cross_L7_L3_
        + sin_theta_L3_*p->weight_L3_across_;
    lin->value[27] = 2.0*L6_omega_*span_L6_head_x_;
    lin->value[28] = 2.0*L8_omega_*span_L8_head_x_;
    lin->value[29] = A_Fx_by_L6_omega_*span_L6_head_y_ - A_Fy_by_L6_omega_*span_L6_head_x_
        + B_Fx_by_L6_omega_*span_L6_head_y_ - B_Fy_by_L6_omega_*span_L6_head_x_;
    lin->value[30] = A_Fx_by_L7_omega_*span_L6_head_y_ - A_Fy_by_L7_omega_*span_L6_head_x_
        + B_Fx_by_L7_omega_*span_L6_head_y_ - B_Fy_by_L7_omega_*span_L6_head_x_ - 2.0*L7_omega_*cross_L6_L7_;
    lin->value[31] = A_Fx_by_L2_omega_*span_L6_head_y_ - A_Fy_by_L2_omega_*span_L6_head_x_ - 2.0*L2_omega_*cross_L6_L2_;
    lin->value[32] = B_Fx_by_L3_omega_*span_L6_head_y_ - B_Fy_by_L3_omega_*span_L6_head_x_ - 2.0*L3_omega_*cross_L6_L3_;
    lin->value[33] = -2.0*L8_omega_*cross_L6_L8_;
    lin->value[34] = A_Fx_by_L6_omega_*span_L7_tail_y_ - A_Fy_by_L6_omega_*span_L7_tail_x_
        + B_Fx_by_L6_omega_*span_L7_tail_y_ - B_Fy_by_L6_omega_*span_L7_tail_x_ + 2.0*L6_omega_*cross_L6_L7_;
    lin->value[35] = A_Fx_by_L7_omega_*span_L7_tail_y_ - A_Fy_by_L7_omega_*span_L7_tail_x_
        + B_Fx_by_L7_omega_*span_L7_tail_y_ - B_Fy_by_L7_omega_*span_L7_tail_x_;
    lin->value[36] = A_Fx_by_L2_omega_*span_L7_tail_y_ - A_Fy_by_L2_omega_*span_L7_tail_x_ - 2.0*L2_omega_*cross_L7_L2_;
    lin->value[37] = B_Fx_by_L3_omega_*span_L7_tail_y_ - B_Fy_by_L3_omega_*span_L7_tail_x_ - 2.0*L3_omega_*cross_L7_L3_;
    lin->value[38] = 2.0*L6_omega_*cross_L6_L8_;
    lin->value[39] = A_Fx_by_L6_omega_*span_L2_tail_y_ - A_Fy_by_L6_omega_*span_L2_tail_x_
        - A_moment_second_by_L6_omega_ + 2.0*L6_omega_*cross_L6_L2_;
    lin->value[40] = A_Fx_by_L7_omega_*span_L2_tail_y_ - A_Fy_by_L7_omega_*span_L2_tail_x_
        - A_moment_second_by_L7_omega_ + 2.0*L7_omega_*cross_L7_L2_;
    lin->value[41] = A_Fx_by_L2_omega_*span_L2_tail_y_ - A_Fy_by_L2_omega_*span_L2_tail_x_
        - A_moment_second_by_L2_omega_;
    lin->value[42] = B_Fx_by_L6_omega_*span_L3_tail_y_ - B_Fy_by_L6_omega_*span_L3_tail_x_
        - B_moment_second_by_L6_omega_ + 2.0*L6_omega_*cross_L6_L3_;
    lin->value[43] = B_Fx_by_L7_omega_*span_L3_tail_y_ - B_Fy_by_L7_omega_*span_L3_tail_x_
        - B_moment_second_by_L7_omega_ + 2.0*L7_omega_*cross_L7_L3_;
    lin->value[44] = B_Fx_by_L3_omega_*span_L3_tail_y_ - B_Fy_by_L3_omega_*span_L3_tail_x_
        - B_moment_second_by_L3_omega_;
    lin->value[45] = A_Fx_by_time_*span_L6_head_y_ - A_Fy_by_time_*span_L6_head_x_ + B_Fx_by_time_*span_L6_head_y_
        - B_Fy_by_time_*span_L6_head_x_;
    lin->value[46] = A_Fx_by_time_*span_L7_tail_y_ - A_Fy_by_time_*span_L7_tail_x_ + B_Fx_by_time_*span_L7_tail_y_
        - B_Fy_by_time_*span_L7_tail_x_;
    lin->value[47] = A_Fx_by_time_*span_L2_tail_y_ - A_Fy_by_time_*span_L2_tail_x_ - A_moment_second_by_time_;
    lin->value[48] = B_Fx_by_time_*span_L3_tail_y_ - B_Fy_by_time_*span_L3_tail_x_ - B_moment_second_by_time_;
    lin->value[49] = -A_Fx_by_L6_theta_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L6_theta_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L6_theta_*crank1_rate_ - B_Fx_by_L6_theta_*crank4_rate_*span_L4_head_y_
        + B_Fy_by_L6_theta_*crank4_rate_*span_L4_head_x_ - B_moment_first_by_L6_theta_*crank4_rate_;
    lin->value[50] = -A_Fx_by_L7_theta_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L7_theta_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L7_theta_*crank1_rate_ - B_Fx_by_L7_theta_*crank4_rate_*span_L4_head_y_
        + B_Fy_by_L7_theta_*crank4_rate_*span_L4_head_x_ - B_moment_first_by_L7_theta_*crank4_rate_;
    lin->value[51] = -A_Fx_by_L2_theta_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L2_theta_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L2_theta_*crank1_rate_;
    lin->value[52] = -B_Fx_by_L3_theta_*crank4_rate_*span_L4_head_y_ + B_Fy_by_L3_theta_*crank4_rate_*span_L4_head_x_
        - B_moment_first_by_L3_theta_*crank4_rate_;
    lin->value[53] = A_Fx_*L2_tail_vx_by_L6_theta_ + A_Fx_by_L6_theta_*(-L1_head_vx_ + L2_tail_vx_)
        + A_Fy_*L2_tail_vy_by_L6_theta_ + A_Fy_by_L6_theta_*(-L1_head_vy_ + L2_tail_vy_)
        + A_moment_first_by_L6_theta_*crank1_rate_ + A_moment_second_by_L6_theta_*L2_omega_
        + B_Fx_*L3_tail_vx_by_L6_theta_ + B_Fx_by_L6_theta_*(L3_tail_vx_ - L4_head_vx_) + B_Fy_*L3_tail_vy_by_L6_theta_
        + B_Fy_by_L6_theta_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_by_L6_theta_*crank4_rate_
        + B_moment_second_by_L6_theta_*L3_omega_;
    lin->value[54] = A_Fx_*L2_tail_vx_by_L7_theta_ + A_Fx_by_L7_theta_*(-L1_head_vx_ + L2_tail_vx_)
        + A_Fy_*L2_tail_vy_by_L7_theta_ + A_Fy_by_L7_theta_*(-L1_head_vy_ + L2_tail_vy_)
        + A_moment_first_by_L7_theta_*crank1_rate_ + A_moment_second_by_L7_theta_*L2_omega_
        + B_Fx_*L3_tail_vx_by_L7_theta_ + B_Fx_by_L7_theta_*(L3_tail_vx_ - L4_head_vx_) + B_Fy_*L3_tail_vy_by_L7_theta_
        + B_Fy_by_L7_theta_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_by_L7_theta_*crank4_rate_
        + B_moment_second_by_L7_theta_*L3_omega_;
    lin->value[55] = A_Fx_*L2_tail_vx_by_L2_theta_ + A_Fx_by_L2_theta_*(-L1_head_vx_ + L2_tail_vx_)
        + A_Fy_*L2_tail_vy_by_L2_theta_ + A_Fy_by_L2_theta_*(-L1_head_vy_ + L2_tail_vy_)
        + A_moment_first_by_L2_theta_*crank1_rate_ + A_moment_second_by_L2_theta_*L2_omega_;
    lin->value[56] = B_Fx_*L3_tail_vx_by_L3_theta_ + B_Fx_by_L3_theta_*(L3_tail_vx_ - L4_head_vx_)
        + B_Fy_*L3_tail_vy_by_L3_theta_ + B_Fy_by_L3_theta_*(L3_tail_vy_ - L4_head_vy_)
        + B_moment_first_by_L3_theta_*crank4_rate_ + B_moment_second_by_L3_theta_*L3_omega_;
    lin->value[57] = -A_Fx_by_L6_omega_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L6_omega_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L6_omega_*crank1_rate_ - B_Fx_by_L6_omega_*crank4_rate_*span_L4_head_y_
        + B_Fy_by_L6_omega_*crank4_rate_*span_L4_head_x_ - B_moment_first_by_L6_omega_*crank4_rate_;
    lin->value[58] = -A_Fx_by_L7_omega_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L7_omega_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L7_omega_*crank1_rate_ - B_Fx_by_L7_omega_*crank4_rate_*span_L4_head_y_
        + B_Fy_by_L7_omega_*crank4_rate_*span_L4_head_x_ - B_moment_first_by_L7_omega_*crank4_rate_;
    lin->value[59] = -A_Fx_by_L2_omega_*crank1_rate_*span_L1_head_y_ + A_Fy_by_L2_omega_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_L2_omega_*crank1_rate_;
    lin->value[60] = -B_Fx_by_L3_omega_*crank4_rate_*span_L4_head_y_ + B_Fy_by_L3_omega_*crank4_rate_*span_L4_head_x_
        - B_moment_first_by_L3_omega_*crank4_rate_;
    lin->value[61] = -A_Fx_*span_L6_head_y_ + A_Fx_by_L6_omega_*(-L1_head_vx_ + L2_tail_vx_) + A_Fy_*span_L6_head_x_
        + A_Fy_by_L6_omega_*(-L1_head_vy_ + L2_tail_vy_) + A_moment_first_by_L6_omega_*crank1_rate_
        + A_moment_second_by_L6_omega_*L2_omega_ - B_Fx_*span_L6_head_y_
        + B_Fx_by_L6_omega_*(L3_tail_vx_ - L4_head_vx_) + B_Fy_*span_L6_head_x_
        + B_Fy_by_L6_omega_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_by_L6_omega_*crank4_rate_
        + B_moment_second_by_L6_omega_*L3_omega_;
    lin->value[62] = -A_Fx_*span_L7_tail_y_ + A_Fx_by_L7_omega_*(-L1_head_vx_ + L2_tail_vx_) + A_Fy_*span_L7_tail_x_
        + A_Fy_by_L7_omega_*(-L1_head_vy_ + L2_tail_vy_) + A_moment_first_by_L7_omega_*crank1_rate_
        + A_moment_second_by_L7_omega_*L2_omega_ - B_Fx_*span_L7_tail_y_
        + B_Fx_by_L7_omega_*(L3_tail_vx_ - L4_head_vx_) + B_Fy_*span_L7_tail_x_
        + B_Fy_by_L7_omega_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_by_L7_omega_*crank4_rate_
        + B_moment_second_by_L7_omega_*L3_omega_;
    lin->value[63] = -A_Fx_*span_L2_tail_y_ + A_Fx_by_L2_omega_*(-L1_head_vx_ + L2_tail_vx_) + A_Fy_*span_L2_tail_x_
        + A_Fy_by_L2_omega_*(-L1_head_vy_ + L2_tail_vy_) + A_moment_first_by_L2_omega_*crank1_rate_ + A_moment_second_
        + A_moment_second_by_L2_omega_*L2_omega_;
    lin->value[64] = -B_Fx_*span_L3_tail_y_ + B_Fx_by_L3_omega_*(L3_tail_vx_ - L4_head_vx_) + B_Fy_*span_L3_tail_x_
        + B_Fy_by_L3_omega_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_by_L3_omega_*crank4_rate_ + B_moment_second_
        + B_moment_second_by_L3_omega_*L3_omega_;
    lin->value[65] = -A_Fx_*crank1_rate_*span_L1_head_y_by_time_ - A_Fx_by_time_*crank1_rate_*span_L1_head_y_
        + A_Fy_*crank1_rate_*span_L1_head_x_by_time_ + A_Fy_by_time_*crank1_rate_*span_L1_head_x_
        - A_moment_first_by_time_*crank1_rate_ - B_Fx_*crank4_rate_*span_L4_head_y_by_time_
        - B_Fx_by_time_*crank4_rate_*span_L4_head_y_ + B_Fy_*crank4_rate_*span_L4_head_x_by_time_
        + B_Fy_by_time_*crank4_rate_*span_L4_head_x_ - B_moment_first_by_time_*crank4_rate_
        - cos_theta_L1_by_time_*crank1_rate_*p->weight_L1_across_
        - cos_theta_L4_by_time_*crank4_rate_*p->weight_L4_across_
        + crank1_acceleration_*(-A_Fx_*span_L1_head_y_ + A_Fy_*span_L1_head_x_ - A_moment_first_
        - cos_theta_L1_*p->weight_L1_across_ + crank1_acceleration_*p->mass_crank1_crank1_)
        + crank4_acceleration_*(-B_Fx_*span_L4_head_y_ + B_Fy_*span_L4_head_x_ - B_moment_first_
        - cos_theta_L4_*p->weight_L4_across_ + crank4_acceleration_*p->mass_crank4_crank4_);
    lin->value[66] = -A_Fx_*L1_head_vx_by_time_ + A_Fx_by_time_*(-L1_head_vx_ + L2_tail_vx_)
        - A_Fy_*L1_head_vy_by_time_ + A_Fy_by_time_*(-L1_head_vy_ + L2_tail_vy_) + A_moment_first_*crank1_acceleration_
        + A_moment_first_by_time_*crank1_rate_ + A_moment_second_by_time_*L2_omega_ - B_Fx_*L4_head_vx_by_time_
        + B_Fx_by_time_*(L3_tail_vx_ - L4_head_vx_) - B_Fy_*L4_head_vy_by_time_
        + B_Fy_by_time_*(L3_tail_vy_ - L4_head_vy_) + B_moment_first_*crank4_acceleration_
        + B_moment_first_by_time_*crank4_rate_ + B_moment_second_by_time_*L3_omega_;
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
    const double mass_L6_theta_L7_theta_ = lin->value[0];
    const double mass_L6_theta_L2_theta_ = lin->value[1];
    const double mass_L7_theta_L2_theta_ = lin->value[2];
    const double mass_L6_theta_L3_theta_ = lin->value[3];
    const double mass_L7_theta_L3_theta_ = lin->value[4];
    const double mass_L6_theta_L8_theta_ = lin->value[5];
    const double phi_guide_offset_L6_theta_ = lin->value[6];
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double by_q_guide_offset_L6_theta_ = lin->value[8];
    const double by_q_guide_offset_L8_theta_ = lin->value[9];
    const double by_q_L6_theta_L6_theta_ = lin->value[10];
    const double by_q_L6_theta_L7_theta_ = lin->value[11];
    const double by_q_L6_theta_L2_theta_ = lin->value[12];
    const double by_q_L6_theta_L3_theta_ = lin->value[13];
    const double by_q_L6_theta_L8_theta_ = lin->value[14];
    const double by_q_L7_theta_L6_theta_ = lin->value[15];
    const double by_q_L7_theta_L7_theta_ = lin->value[16];
    const double by_q_L7_theta_L2_theta_ = lin->value[17];
    const double by_q_L7_theta_L3_theta_ = lin->value[18];
    const double by_q_L8_theta_L8_theta_ = lin->value[19];
    const double by_q_L8_theta_L6_theta_ = lin->value[20];
    const double by_q_L2_theta_L6_theta_ = lin->value[21];
    const double by_q_L2_theta_L7_theta_ = lin->value[22];
    const double by_q_L2_theta_L2_theta_ = lin->value[23];
    const double by_q_L3_theta_L6_theta_ = lin->value[24];
    const double by_q_L3_theta_L7_theta_ = lin->value[25];
    const double by_q_L3_theta_L3_theta_ = lin->value[26];
    const double by_v_guide_offset_L6_theta_ = lin->value[27];
    const double by_v_guide_offset_L8_theta_ = lin->value[28];
    const double by_v_L6_theta_L6_theta_ = lin->value[29];
    const double by_v_L6_theta_L7_theta_ = lin->value[30];
    const double by_v_L6_theta_L2_theta_ = lin->value[31];
    const double by_v_L6_theta_L3_theta_ = lin->value[32];
    const double by_v_L6_theta_L8_theta_ = lin->value[33];
    const double by_v_L7_theta_L6_theta_ = lin->value[34];
    const double by_v_L7_theta_L7_theta_ = lin->value[35];
    const double by_v_L7_theta_L2_theta_ = lin->value[36];
    const double by_v_L7_theta_L3_theta_ = lin->value[37];
    const double by_v_L8_theta_L6_theta_ = lin->value[38];
    const double by_v_L2_theta_L6_theta_ = lin->value[39];
    const double by_v_L2_theta_L7_theta_ = lin->value[40];
    const double by_v_L2_theta_L2_theta_ = lin->value[41];
    const double by_v_L3_theta_L6_theta_ = lin->value[42];
    const double by_v_L3_theta_L7_theta_ = lin->value[43];
    const double by_v_L3_theta_L3_theta_ = lin->value[44];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const double n_L6_theta_L6_theta_ = eta*(by_q_L6_theta_L6_theta_*eta + by_v_L6_theta_L6_theta_) + p->mass_L6_L6_;
    const double n_L6_theta_L7_theta_ = eta*(by_q_L6_theta_L7_theta_*eta + by_v_L6_theta_L7_theta_)
        + mass_L6_theta_L7_theta_;
    const double n_L6_theta_L8_theta_ = eta*(by_q_L6_theta_L8_theta_*eta + by_v_L6_theta_L8_theta_)
        + mass_L6_theta_L8_theta_;
    const double n_L6_theta_L2_theta_ = eta*(by_q_L6_theta_L2_theta_*eta + by_v_L6_theta_L2_theta_)
        + mass_L6_theta_L2_theta_;
    const double n_L6_theta_L3_theta_ = eta*(by_q_L6_theta_L3_theta_*eta + by_v_L6_theta_L3_theta_)
        + mass_L6_theta_L3_theta_;
    const double n_L7_theta_L6_theta_ = eta*(by_q_L7_theta_L6_theta_*eta + by_v_L7_theta_L6_theta_)
        + mass_L6_theta_L7_theta_;
    const double n_L7_theta_L7_theta_ = eta*(by_q_L7_theta_L7_theta_*eta + by_v_L7_theta_L7_theta_) + p->mass_L7_L7_;
    const double n_L7_theta_L2_theta_ = eta*(by_q_L7_theta_L2_theta_*eta + by_v_L7_theta_L2_theta_)
        + mass_L7_theta_L2_theta_;
    const double n_L7_theta_L3_theta_ = eta*(by_q_L7_theta_L3_theta_*eta + by_v_L7_theta_L3_theta_)
        + mass_L7_theta_L3_theta_;
    const double n_L8_theta_L6_theta_ = eta*(by_q_L8_theta_L6_theta_*eta + by_v_L8_theta_L6_theta_)
        + mass_L6_theta_L8_theta_;
    const double n_L8_theta_L8_theta_ = by_q_L8_theta_L8_theta_*(eta * eta) + p->mass_L8_L8_;
    const double n_L2_theta_L6_theta_ = eta*(by_q_L2_theta_L6_theta_*eta + by_v_L2_theta_L6_theta_)
        + mass_L6_theta_L2_theta_;
    const double n_L2_theta_L7_theta_ = eta*(by_q_L2_theta_L7_theta_*eta + by_v_L2_theta_L7_theta_)
        + mass_L7_theta_L2_theta_;
    const double n_L2_theta_L2_theta_ = eta*(by_q_L2_theta_L2_theta_*eta + by_v_L2_theta_L2_theta_) + p->mass_L2_L2_;
    const double n_L3_theta_L6_theta_ = eta*(by_q_L3_theta_L6_theta_*eta + by_v_L3_theta_L6_theta_)
        + mass_L6_theta_L3_theta_;
    const double n_L3_theta_L7_theta_ = eta*(by_q_L3_theta_L7_theta_*eta + by_v_L3_theta_L7_theta_)
        + mass_L7_theta_L3_theta_;
    const double n_L3_theta_L3_theta_ = eta*(by_q_L3_theta_L3_theta_*eta + by_v_L3_theta_L3_theta_) + p->mass_L3_L3_;
    const double n_guide_offset_L6_theta_ = eta_row*(by_q_guide_offset_L6_theta_*eta + by_v_guide_offset_L6_theta_)
        + phi_guide_offset_L6_theta_;
    const double n_guide_offset_L8_theta_ = eta_row*(by_q_guide_offset_L8_theta_*eta + by_v_guide_offset_L8_theta_)
        + phi_guide_offset_L8_theta_;

    /* L U */
    const double scale_L8_theta_ = n_L8_theta_L8_theta_;
    if (!(fabs(scale_L8_theta_) > SINGULAR * fabs(n_L8_theta_L8_theta_)))
        return 3;
    const double inverse_pivot_L8_theta_ = 1.0/scale_L8_theta_;
    lin->lu[0] = inverse_pivot_L8_theta_;
    const double l_L6_theta_L8_theta_ = inverse_pivot_L8_theta_*n_L6_theta_L8_theta_;
    lin->lu[1] = l_L6_theta_L8_theta_;
    lin->lu[2] = n_L8_theta_L6_theta_;
    const double l_guide_offset_L8_theta_ = inverse_pivot_L8_theta_*n_guide_offset_L8_theta_;
    lin->lu[3] = l_guide_offset_L8_theta_;
    const double scale_L2_theta_ = n_L2_theta_L2_theta_;
    if (!(fabs(scale_L2_theta_) > SINGULAR * fabs(n_L2_theta_L2_theta_)))
        return 4;
    const double inverse_pivot_L2_theta_ = 1.0/scale_L2_theta_;
    lin->lu[4] = inverse_pivot_L2_theta_;
    const double l_L7_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L7_theta_L2_theta_;
    lin->lu[5] = l_L7_theta_L2_theta_;
    lin->lu[6] = n_L2_theta_L7_theta_;
    const double l_L6_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L6_theta_L2_theta_;
    lin->lu[7] = l_L6_theta_L2_theta_;
    lin->lu[8] = n_L2_theta_L6_theta_;
    const double scale_L7_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L7_theta_ + n_L7_theta_L7_theta_;
    if (!(fabs(scale_L7_theta_) > SINGULAR * fabs(n_L7_theta_L7_theta_)))
        return 2;
    const double inverse_pivot_L7_theta_ = 1.0/scale_L7_theta_;
    lin->lu[9] = inverse_pivot_L7_theta_;
    const double l_L3_theta_L7_theta_ = inverse_pivot_L7_theta_*n_L3_theta_L7_theta_;
    lin->lu[10] = l_L3_theta_L7_theta_;
    lin->lu[11] = n_L7_theta_L3_theta_;
    const double l_L6_theta_L7_theta_ = inverse_pivot_L7_theta_*(-l_L6_theta_L2_theta_*n_L2_theta_L7_theta_
        + n_L6_theta_L7_theta_);
    lin->lu[12] = l_L6_theta_L7_theta_;
    const double u_L7_theta_L6_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L6_theta_ + n_L7_theta_L6_theta_;
    lin->lu[13] = u_L7_theta_L6_theta_;
    const double scale_L3_theta_ = -l_L3_theta_L7_theta_*n_L7_theta_L3_theta_ + n_L3_theta_L3_theta_;
    if (!(fabs(scale_L3_theta_) > SINGULAR * fabs(n_L3_theta_L3_theta_)))
        return 5;
    const double inverse_pivot_L3_theta_ = 1.0/scale_L3_theta_;
    lin->lu[14] = inverse_pivot_L3_theta_;
    const double l_L6_theta_L3_theta_ = inverse_pivot_L3_theta_*(-l_L6_theta_L7_theta_*n_L7_theta_L3_theta_
        + n_L6_theta_L3_theta_);
    lin->lu[15] = l_L6_theta_L3_theta_;
    const double u_L3_theta_L6_theta_ = -l_L3_theta_L7_theta_*u_L7_theta_L6_theta_ + n_L3_theta_L6_theta_;
    lin->lu[16] = u_L3_theta_L6_theta_;
    const double scale_L6_theta_ = -l_L6_theta_L2_theta_*n_L2_theta_L6_theta_
        - l_L6_theta_L3_theta_*u_L3_theta_L6_theta_ - l_L6_theta_L7_theta_*u_L7_theta_L6_theta_
        - l_L6_theta_L8_theta_*n_L8_theta_L6_theta_ + n_L6_theta_L6_theta_;
    if (!(fabs(scale_L6_theta_) > SINGULAR * fabs(n_L6_theta_L6_theta_)))
        return 1;
    const double inverse_pivot_L6_theta_ = 1.0/scale_L6_theta_;
    lin->lu[17] = inverse_pivot_L6_theta_;
    const double l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*(-l_guide_offset_L8_theta_*n_L8_theta_L6_theta_
        + n_guide_offset_L6_theta_);
    lin->lu[18] = l_guide_offset_L6_theta_;
    const double u_L6_theta_guide_offset_ = -l_L6_theta_L8_theta_*phi_guide_offset_L8_theta_
        + phi_guide_offset_L6_theta_;
    lin->lu[19] = u_L6_theta_guide_offset_;
    const double scale_guide_offset_ = -l_guide_offset_L6_theta_*u_L6_theta_guide_offset_
        - l_guide_offset_L8_theta_*phi_guide_offset_L8_theta_;
    if (!(scale_guide_offset_ != 0.0 && isfinite(scale_guide_offset_)))
        return 6;
    const double inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;
    lin->lu[20] = inverse_pivot_guide_offset_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double inverse_pivot_L8_theta_ = lin->lu[0];
    const double l_L6_theta_L8_theta_ = lin->lu[1];
    const double n_L8_theta_L6_theta_ = lin->lu[2];
    const double l_guide_offset_L8_theta_ = lin->lu[3];
    const double inverse_pivot_L2_theta_ = lin->lu[4];
    const double l_L7_theta_L2_theta_ = lin->lu[5];
    const double n_L2_theta_L7_theta_ = lin->lu[6];
    const double l_L6_theta_L2_theta_ = lin->lu[7];
    const double n_L2_theta_L6_theta_ = lin->lu[8];
    const double inverse_pivot_L7_theta_ = lin->lu[9];
    const double l_L3_theta_L7_theta_ = lin->lu[10];
    const double n_L7_theta_L3_theta_ = lin->lu[11];
    const double l_L6_theta_L7_theta_ = lin->lu[12];
    const double u_L7_theta_L6_theta_ = lin->lu[13];
    const double inverse_pivot_L3_theta_ = lin->lu[14];
    const double l_L6_theta_L3_theta_ = lin->lu[15];
    const double u_L3_theta_L6_theta_ = lin->lu[16];
    const double inverse_pivot_L6_theta_ = lin->lu[17];
    const double l_guide_offset_L6_theta_ = lin->lu[18];
    const double u_L6_theta_guide_offset_ = lin->lu[19];
    const double inverse_pivot_guide_offset_ = lin->lu[20];

    /* forward */
    const double b_L8_theta_ = x[2];
    const double b_L2_theta_ = x[3];
    const double b_L7_theta_ = -b_L2_theta_*l_L7_theta_L2_theta_ + x[1];
    const double b_L3_theta_ = -b_L7_theta_*l_L3_theta_L7_theta_ + x[4];
    const double b_L6_theta_ = -b_L2_theta_*l_L6_theta_L2_theta_ - b_L3_theta_*l_L6_theta_L3_theta_
        - b_L7_theta_*l_L6_theta_L7_theta_ - b_L8_theta_*l_L6_theta_L8_theta_ + x[0];
    const double b_guide_offset_ = -b_L6_theta_*l_guide_offset_L6_theta_ - b_L8_theta_*l_guide_offset_L8_theta_ + x[5];

    /* backward */
    const double x_guide_offset_ = b_guide_offset_*inverse_pivot_guide_offset_;
    x[5] = x_guide_offset_;
    const double x_L6_theta_ = inverse_pivot_L6_theta_*(b_L6_theta_ - u_L6_theta_guide_offset_*x_guide_offset_);
    x[0] = x_L6_theta_;
    const double x_L3_theta_ = inverse_pivot_L3_theta_*(b_L3_theta_ - u_L3_theta_L6_theta_*x_L6_theta_);
    x[4] = x_L3_theta_;
    const double x_L7_theta_ = inverse_pivot_L7_theta_*(b_L7_theta_ - n_L7_theta_L3_theta_*x_L3_theta_
        - u_L7_theta_L6_theta_*x_L6_theta_);
    x[1] = x_L7_theta_;
    const double x_L2_theta_ = inverse_pivot_L2_theta_*(b_L2_theta_ - n_L2_theta_L6_theta_*x_L6_theta_
        - n_L2_theta_L7_theta_*x_L7_theta_);
    x[3] = x_L2_theta_;
    const double x_L8_theta_ = inverse_pivot_L8_theta_*(b_L8_theta_ - n_L8_theta_L6_theta_*x_L6_theta_
        - phi_guide_offset_L8_theta_*x_guide_offset_);
    x[2] = x_L8_theta_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double mass_L6_theta_L7_theta_ = lin->value[0];
    const double mass_L6_theta_L2_theta_ = lin->value[1];
    const double mass_L7_theta_L2_theta_ = lin->value[2];
    const double mass_L6_theta_L3_theta_ = lin->value[3];
    const double mass_L7_theta_L3_theta_ = lin->value[4];
    const double mass_L6_theta_L8_theta_ = lin->value[5];
    const double phi_guide_offset_L6_theta_ = lin->value[6];
    const double phi_guide_offset_L8_theta_ = lin->value[7];
    const double by_q_guide_offset_L6_theta_ = lin->value[8];
    const double by_q_guide_offset_L8_theta_ = lin->value[9];
    const double by_q_L6_theta_L6_theta_ = lin->value[10];
    const double by_q_L6_theta_L7_theta_ = lin->value[11];
    const double by_q_L6_theta_L2_theta_ = lin->value[12];
    const double by_q_L6_theta_L3_theta_ = lin->value[13];
    const double by_q_L6_theta_L8_theta_ = lin->value[14];
    const double by_q_L7_theta_L6_theta_ = lin->value[15];
    const double by_q_L7_theta_L7_theta_ = lin->value[16];
    const double by_q_L7_theta_L2_theta_ = lin->value[17];
    const double by_q_L7_theta_L3_theta_ = lin->value[18];
    const double by_q_L8_theta_L8_theta_ = lin->value[19];
    const double by_q_L8_theta_L6_theta_ = lin->value[20];
    const double by_q_L2_theta_L6_theta_ = lin->value[21];
    const double by_q_L2_theta_L7_theta_ = lin->value[22];
    const double by_q_L2_theta_L2_theta_ = lin->value[23];
    const double by_q_L3_theta_L6_theta_ = lin->value[24];
    const double by_q_L3_theta_L7_theta_ = lin->value[25];
    const double by_q_L3_theta_L3_theta_ = lin->value[26];
    const double by_t_L6_theta_ = lin->value[45];
    const double by_t_L7_theta_ = lin->value[46];
    const double by_t_L2_theta_ = lin->value[47];
    const double by_t_L3_theta_ = lin->value[48];
    const double power_q_0_L6_theta_ = lin->value[49];
    const double power_q_0_L7_theta_ = lin->value[50];
    const double power_q_0_L2_theta_ = lin->value[51];
    const double power_q_0_L3_theta_ = lin->value[52];
    const double power_q_2_L6_theta_ = lin->value[53];
    const double power_q_2_L7_theta_ = lin->value[54];
    const double power_q_2_L2_theta_ = lin->value[55];
    const double power_q_2_L3_theta_ = lin->value[56];
    const double power_v_0_L6_theta_ = lin->value[57];
    const double power_v_0_L7_theta_ = lin->value[58];
    const double power_v_0_L2_theta_ = lin->value[59];
    const double power_v_0_L3_theta_ = lin->value[60];
    const double power_v_2_L6_theta_ = lin->value[61];
    const double power_v_2_L7_theta_ = lin->value[62];
    const double power_v_2_L2_theta_ = lin->value[63];
    const double power_v_2_L3_theta_ = lin->value[64];
    const double power_t_0_ = lin->value[65];
    const double power_t_2_ = lin->value[66];

    /* eta/kappa */
    const double eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    double x[6];
    const double shifted_L6_theta_ = -p->beta_squared_*eta*r[0] + r[5];
    const double shifted_L8_theta_ = -p->beta_squared_*eta*r[2] + r[7];
    x[0] = eta*(-by_q_L6_theta_L2_theta_*eta*r[3] - by_q_L6_theta_L3_theta_*eta*r[4] - by_q_L6_theta_L6_theta_*eta*r[0]
        - by_q_L6_theta_L7_theta_*eta*r[1] - by_q_L6_theta_L8_theta_*eta*r[2] - by_t_L6_theta_*s + p->mass_L6_L6_*r[5]
        + mass_L6_theta_L2_theta_*r[8] + mass_L6_theta_L3_theta_*r[9] + mass_L6_theta_L7_theta_*r[6]
        + mass_L6_theta_L8_theta_*r[7]);
    x[1] = eta*(-by_q_L7_theta_L2_theta_*eta*r[3] - by_q_L7_theta_L3_theta_*eta*r[4] - by_q_L7_theta_L6_theta_*eta*r[0]
        - by_q_L7_theta_L7_theta_*eta*r[1] - by_t_L7_theta_*s + mass_L6_theta_L7_theta_*r[5] + p->mass_L7_L7_*r[6]
        + mass_L7_theta_L2_theta_*r[8] + mass_L7_theta_L3_theta_*r[9]);
    x[2] = eta*(-by_q_L8_theta_L6_theta_*eta*r[0] - by_q_L8_theta_L8_theta_*eta*r[2] + mass_L6_theta_L8_theta_*r[5]
        + p->mass_L8_L8_*r[7]);
    x[3] = eta*(-by_q_L2_theta_L2_theta_*eta*r[3] - by_q_L2_theta_L6_theta_*eta*r[0] - by_q_L2_theta_L7_theta_*eta*r[1]
        - by_t_L2_theta_*s + p->mass_L2_L2_*r[8] + mass_L6_theta_L2_theta_*r[5] + mass_L7_theta_L2_theta_*r[6]);
    x[4] = eta*(-by_q_L3_theta_L3_theta_*eta*r[4] - by_q_L3_theta_L6_theta_*eta*r[0] - by_q_L3_theta_L7_theta_*eta*r[1]
        - by_t_L3_theta_*s + p->mass_L3_L3_*r[9] + mass_L6_theta_L3_theta_*r[5] + mass_L7_theta_L3_theta_*r[6]);
    x[5] = eta_row*(-by_q_guide_offset_L6_theta_*eta*r[0] - by_q_guide_offset_L8_theta_*eta*r[2]
        + phi_guide_offset_L6_theta_*shifted_L6_theta_ + phi_guide_offset_L8_theta_*shifted_L8_theta_);
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
    u[10] = eta*(power_q_0_L2_theta_*u[3] + power_q_0_L3_theta_*u[4] + power_q_0_L6_theta_*u[0]
        + power_q_0_L7_theta_*u[1] + power_t_0_*s + power_v_0_L2_theta_*u[8] + power_v_0_L3_theta_*u[9]
        + power_v_0_L6_theta_*u[5] + power_v_0_L7_theta_*u[6] + r[10]);
    u[11] = eta*r[11];
    u[12] = eta*(power_q_2_L2_theta_*u[3] + power_q_2_L3_theta_*u[4] + power_q_2_L6_theta_*u[0]
        + power_q_2_L7_theta_*u[1] + power_t_2_*s + power_v_2_L2_theta_*u[8] + power_v_2_L3_theta_*u[9]
        + power_v_2_L6_theta_*u[5] + power_v_2_L7_theta_*u[6] + r[12]);
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
    const double L6_theta_ = q[0];
    const double L6_omega_ = v[0];
    const double L7_theta_ = q[1];
    const double L8_theta_ = q[2];
    const double L8_omega_ = v[2];
    const double L2_theta_ = q[3];
    const double L3_theta_ = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {L6_theta_, L7_theta_, L8_theta_, L2_theta_};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta_, L3_theta_, L3_theta_, L3_theta_};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L6_ = cosines_0[0];
    const double sin_theta_L6_ = sines_0[0];
    const double cos_theta_L7_ = cosines_0[1];
    const double sin_theta_L7_ = sines_0[1];
    const double cos_theta_L8_ = cosines_0[2];
    const double sin_theta_L8_ = sines_0[2];
    const double cos_theta_L2_ = cosines_0[3];
    const double sin_theta_L2_ = sines_0[3];
    const double cos_theta_L3_ = cosines_1[0];
    const double sin_theta_L3_ = sines_1[0];
    const double span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const double span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const double span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const double span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const double cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const double dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const double cos_L2_less_L6_ = cos_theta_L2_*cos_theta_L6_ + sin_theta_L2_*sin_theta_L6_;
    const double dot_L6_L2_ = cos_L2_less_L6_*p->inertia_L6_L2_;
    const double cos_L2_less_L7_ = cos_theta_L2_*cos_theta_L7_ + sin_theta_L2_*sin_theta_L7_;
    const double dot_L7_L2_ = cos_L2_less_L7_*p->inertia_L7_L2_;
    const double cos_L3_less_L6_ = cos_theta_L3_*cos_theta_L6_ + sin_theta_L3_*sin_theta_L6_;
    const double dot_L6_L3_ = cos_L3_less_L6_*p->inertia_L6_L3_;
    const double cos_L3_less_L7_ = cos_theta_L3_*cos_theta_L7_ + sin_theta_L3_*sin_theta_L7_;
    const double dot_L7_L3_ = cos_L3_less_L7_*p->inertia_L7_L3_;
    const double cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const double dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;

    /* Phi and Phi_dot */
    const double phi_guide_offset_ = -span_L6_head_x_ - span_L8_head_x_;
    const double phi_dot_guide_offset_ = L6_omega_*span_L6_head_y_ + L8_omega_*span_L8_head_y_;

    /* L D L^T of the KKT matrix */
    const double l_L6_theta_L8_theta_ = dot_L6_L8_*p->inverse_tree_metric_L8_theta_;
    const double l_guide_offset_L8_theta_ = p->inverse_tree_metric_L8_theta_*span_L8_head_y_;
    const double l_L7_theta_L2_theta_ = dot_L7_L2_*p->inverse_tree_metric_L2_theta_;
    const double l_L6_theta_L2_theta_ = dot_L6_L2_*p->inverse_tree_metric_L2_theta_;
    const double pivot_L7_theta_ = -dot_L7_L2_*l_L7_theta_L2_theta_ + p->tree_metric_L7_theta_;
    const double determinant_L7_theta_L3_theta_ = -(dot_L7_L3_ * dot_L7_L3_) + pivot_L7_theta_*p->tree_metric_L3_theta_;
    const double inverse_L7_theta_L3_theta_ = 1.0/determinant_L7_theta_L3_theta_;
    const double inverse_pivot_L7_theta_ = inverse_L7_theta_L3_theta_*p->tree_metric_L3_theta_;
    const double inverse_pivot_L3_theta_ = inverse_L7_theta_L3_theta_*pivot_L7_theta_;
    const double inverse_cross_L7_theta_L3_theta_ = -dot_L7_L3_*inverse_L7_theta_L3_theta_;
    const double w_L6_theta_L7_theta_ = dot_L6_L7_ - dot_L7_L2_*l_L6_theta_L2_theta_;
    const double l_L6_theta_L7_theta_ = dot_L6_L3_*inverse_cross_L7_theta_L3_theta_
        + inverse_pivot_L7_theta_*w_L6_theta_L7_theta_;
    const double l_L6_theta_L3_theta_ = dot_L6_L3_*inverse_pivot_L3_theta_
        + inverse_cross_L7_theta_L3_theta_*w_L6_theta_L7_theta_;
    const double inverse_pivot_L6_theta_ = 1.0/(-dot_L6_L2_*l_L6_theta_L2_theta_ - dot_L6_L3_*l_L6_theta_L3_theta_
        - dot_L6_L8_*l_L6_theta_L8_theta_ - l_L6_theta_L7_theta_*w_L6_theta_L7_theta_ + p->tree_metric_L6_theta_);
    const double w_guide_offset_L6_theta_ = -dot_L6_L8_*l_guide_offset_L8_theta_ + span_L6_head_y_;
    const double l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const double scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L8_theta_*span_L8_head_y_;
    if (!(scale_guide_offset_ > 0.0 && scale_guide_offset_ < INFINITY))
        return 1;
    const double inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;

    /* backward substitution */
    const double dq_lambda_guide_offset_ = -inverse_pivot_guide_offset_*phi_guide_offset_;
    const double dq_acceleration_L6_theta_ = -dq_lambda_guide_offset_*l_guide_offset_L6_theta_;
    const double dq_acceleration_L3_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L3_theta_;
    const double dq_acceleration_L7_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L7_theta_;
    const double dq_acceleration_L2_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L2_theta_
        - dq_acceleration_L7_theta_*l_L7_theta_L2_theta_;
    const double dq_acceleration_L8_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L8_theta_
        - dq_lambda_guide_offset_*l_guide_offset_L8_theta_;

    /* backward substitution */
    const double dv_lambda_guide_offset_ = -inverse_pivot_guide_offset_*phi_dot_guide_offset_;
    const double dv_acceleration_L6_theta_ = -dv_lambda_guide_offset_*l_guide_offset_L6_theta_;
    const double dv_acceleration_L3_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L3_theta_;
    const double dv_acceleration_L7_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L7_theta_;
    const double dv_acceleration_L2_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L2_theta_
        - dv_acceleration_L7_theta_*l_L7_theta_L2_theta_;
    const double dv_acceleration_L8_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L8_theta_
        - dv_lambda_guide_offset_*l_guide_offset_L8_theta_;

    /* results */
    dq[0] = dq_acceleration_L6_theta_;
    dv[0] = dv_acceleration_L6_theta_;
    dq[1] = dq_acceleration_L7_theta_;
    dv[1] = dv_acceleration_L7_theta_;
    dq[2] = dq_acceleration_L8_theta_;
    dv[2] = dv_acceleration_L8_theta_;
    dq[3] = dq_acceleration_L2_theta_;
    dv[3] = dv_acceleration_L2_theta_;
    dq[4] = dq_acceleration_L3_theta_;
    dv[4] = dv_acceleration_L3_theta_;
    *worst = max_of(0.0, fabs(phi_guide_offset_));
    return 0;
}
