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
 * Joint wristpin: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_wristpin_(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->pin_clearance_;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent_, p->dry_friction_mu_, p->dry_friction_v0_, p->pin_radius_, p->R_j_pin_,
            p->pin_clearance_, p->dry_pin_K_, p->dry_pin_hysteresis_, p->dry_pin_friction_slope_, side, g, 0, out);
}

static void tangent_wristpin_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->pin_clearance_) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_wristpin_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_wristpin_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_wristpin_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    const double cylinder_slide_ = q[0];
    const double cylinder_slide_rate_ = v[0];
    const double rod_theta_ = q[1];
    const double rod_omega_ = v[1];
    const double a_rod_theta_ = a[1];
    const double wristpin_Fx_ = aside->clearance[0].Fx;
    const double wristpin_Fy_ = aside->clearance[0].Fy;
    const double wristpin_moment_first_ = aside->clearance[0].moment_first;

    /* directions, arms, drives */
    const double motor_value_ = p->omega_*t;
    const double motor_rate_ = p->omega_;
    const double motor_acceleration_ = 0.0;
    const double cos_theta_crank_ = cos(motor_value_);
    const double sin_theta_crank_ = sin(motor_value_);
    const double cos_theta_rod_ = cos(rod_theta_);
    const double sin_theta_rod_ = sin(rod_theta_);
    const double slider_omega_ = 0.0;
    const double span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const double span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const double crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const double crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const double span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const double span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const double rod_head_x_ = span_crank_head_x_ + span_rod_head_x_;
    const double rod_head_vx_ = crank_head_vx_ - rod_omega_*span_rod_head_y_;
    const double rod_head_y_ = span_crank_head_y_ + span_rod_head_y_;
    const double rod_head_vy_ = crank_head_vy_ + rod_omega_*span_rod_head_x_;
    const double cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const double sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const double dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const double cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* clearance joint wristpin */
    const double e_wristpin_x_ = cylinder_slide_ - rod_head_x_;
    const double e_wristpin_y_ = -rod_head_y_;
    const double edot_wristpin_x_ = cylinder_slide_rate_ - rod_head_vx_;
    const double edot_wristpin_y_ = -rod_head_vy_;
    double change_wristpin_[4][6];
    tangent_wristpin_(e_wristpin_x_, e_wristpin_y_, edot_wristpin_x_, edot_wristpin_y_, rod_omega_, slider_omega_,
        &memory->latch[0], p, side, g, change_wristpin_);
    const double rod_head_x_2_by_time_ = -motor_rate_*span_crank_head_y_;
    const double rod_head_y_by_time_ = motor_rate_*span_crank_head_x_;
    const double rod_head_vx_by_rod_theta_ = -rod_omega_*span_rod_head_x_;
    const double rod_head_vx_by_time_ = -motor_acceleration_*span_crank_head_y_
        - (motor_rate_ * motor_rate_)*span_crank_head_x_;
    const double rod_head_vy_by_rod_theta_ = -rod_omega_*span_rod_head_y_;
    const double rod_head_vy_by_time_ = motor_acceleration_*span_crank_head_x_
        - (motor_rate_ * motor_rate_)*span_crank_head_y_;
    const double wristpin_Fx_by_e_x_ = change_wristpin_[0][0];
    const double wristpin_Fx_by_e_y_ = change_wristpin_[0][1];
    const double wristpin_Fx_by_de_x_ = change_wristpin_[0][2];
    const double wristpin_Fx_by_de_y_ = change_wristpin_[0][3];
    const double wristpin_Fx_by_omega_i_ = change_wristpin_[0][4];
    const double wristpin_Fx_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_Fx_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_Fx_by_de_y_ - span_rod_head_x_*wristpin_Fx_by_e_y_
        + span_rod_head_y_*wristpin_Fx_by_e_x_;
    const double wristpin_Fx_by_time_ = -rod_head_vx_by_time_*wristpin_Fx_by_de_x_
        - rod_head_vy_by_time_*wristpin_Fx_by_de_y_ - rod_head_x_2_by_time_*wristpin_Fx_by_e_x_
        - rod_head_y_by_time_*wristpin_Fx_by_e_y_;
    const double wristpin_Fx_by_rod_omega_ = -span_rod_head_x_*wristpin_Fx_by_de_y_
        + span_rod_head_y_*wristpin_Fx_by_de_x_ + wristpin_Fx_by_omega_i_;
    const double wristpin_Fy_by_e_x_ = change_wristpin_[1][0];
    const double wristpin_Fy_by_e_y_ = change_wristpin_[1][1];
    const double wristpin_Fy_by_de_x_ = change_wristpin_[1][2];
    const double wristpin_Fy_by_de_y_ = change_wristpin_[1][3];
    const double wristpin_Fy_by_omega_i_ = change_wristpin_[1][4];
    const double wristpin_Fy_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_Fy_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_Fy_by_de_y_ - span_rod_head_x_*wristpin_Fy_by_e_y_
        + span_rod_head_y_*wristpin_Fy_by_e_x_;
    const double wristpin_Fy_by_time_ = -rod_head_vx_by_time_*wristpin_Fy_by_de_x_
        - rod_head_vy_by_time_*wristpin_Fy_by_de_y_ - rod_head_x_2_by_time_*wristpin_Fy_by_e_x_
        - rod_head_y_by_time_*wristpin_Fy_by_e_y_;
    const double wristpin_Fy_by_rod_omega_ = -span_rod_head_x_*wristpin_Fy_by_de_y_
        + span_rod_head_y_*wristpin_Fy_by_de_x_ + wristpin_Fy_by_omega_i_;
    const double wristpin_moment_first_by_e_x_ = change_wristpin_[2][0];
    const double wristpin_moment_first_by_e_y_ = change_wristpin_[2][1];
    const double wristpin_moment_first_by_de_x_ = change_wristpin_[2][2];
    const double wristpin_moment_first_by_de_y_ = change_wristpin_[2][3];
    const double wristpin_moment_first_by_omega_i_ = change_wristpin_[2][4];
    const double wristpin_moment_first_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_moment_first_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_moment_first_by_de_y_ - span_rod_head_x_*wristpin_moment_first_by_e_y_
        + span_rod_head_y_*wristpin_moment_first_by_e_x_;
    const double wristpin_moment_first_by_time_ = -rod_head_vx_by_time_*wristpin_moment_first_by_de_x_
        - rod_head_vy_by_time_*wristpin_moment_first_by_de_y_ - rod_head_x_2_by_time_*wristpin_moment_first_by_e_x_
        - rod_head_y_by_time_*wristpin_moment_first_by_e_y_;
    const double wristpin_moment_first_by_rod_omega_ = -span_rod_head_x_*wristpin_moment_first_by_de_y_
        + span_rod_head_y_*wristpin_moment_first_by_de_x_ + wristpin_moment_first_by_omega_i_;
    const double wristpin_moment_second_by_e_x_ = change_wristpin_[3][0];
    const double wristpin_moment_second_by_e_y_ = change_wristpin_[3][1];
    const double wristpin_moment_second_by_de_x_ = change_wristpin_[3][2];
    const double wristpin_moment_second_by_de_y_ = change_wristpin_[3][3];
    const double wristpin_moment_second_by_omega_i_ = change_wristpin_[3][4];
    const double wristpin_moment_second_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_moment_second_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_moment_second_by_de_y_ - span_rod_head_x_*wristpin_moment_second_by_e_y_
        + span_rod_head_y_*wristpin_moment_second_by_e_x_;
    const double wristpin_moment_second_by_time_ = -rod_head_vx_by_time_*wristpin_moment_second_by_de_x_
        - rod_head_vy_by_time_*wristpin_moment_second_by_de_y_ - rod_head_x_2_by_time_*wristpin_moment_second_by_e_x_
        - rod_head_y_by_time_*wristpin_moment_second_by_e_y_;
    const double wristpin_moment_second_by_rod_omega_ = -span_rod_head_x_*wristpin_moment_second_by_de_y_
        + span_rod_head_y_*wristpin_moment_second_by_de_x_ + wristpin_moment_second_by_omega_i_;

    /* coordinates */
    const double cross_crank_rod_by_time_ = -dot_crank_rod_*motor_rate_;
    const double dot_crank_rod_by_time_ = cross_crank_rod_*motor_rate_;

    /* powers */
    const double span_crank_head_x_by_time_ = -motor_rate_*span_crank_head_y_;
    const double span_crank_head_y_by_time_ = motor_rate_*span_crank_head_x_;

    /* results */
    lin->value[0] = -wristpin_Fx_by_e_x_;
    lin->value[1] = -wristpin_Fx_by_rod_theta_;
    lin->value[2] = -cross_crank_rod_*motor_acceleration_ + dot_crank_rod_*(motor_rate_ * motor_rate_)
        - span_rod_head_x_*wristpin_Fx_ + span_rod_head_x_*wristpin_Fy_by_rod_theta_
        - span_rod_head_y_*wristpin_Fx_by_rod_theta_ - span_rod_head_y_*wristpin_Fy_
        - wristpin_moment_first_by_rod_theta_;
    lin->value[3] = span_rod_head_x_*wristpin_Fy_by_e_x_ - span_rod_head_y_*wristpin_Fx_by_e_x_
        - wristpin_moment_first_by_e_x_;
    lin->value[4] = -wristpin_Fx_by_de_x_;
    lin->value[5] = -wristpin_Fx_by_rod_omega_;
    lin->value[6] = span_rod_head_x_*wristpin_Fy_by_de_x_ - span_rod_head_y_*wristpin_Fx_by_de_x_
        - wristpin_moment_first_by_de_x_;
    lin->value[7] = span_rod_head_x_*wristpin_Fy_by_rod_omega_ - span_rod_head_y_*wristpin_Fx_by_rod_omega_
        - wristpin_moment_first_by_rod_omega_;
    lin->value[8] = -wristpin_Fx_by_time_;
    lin->value[9] = 2.0*cross_crank_rod_*motor_acceleration_*motor_rate_
        + cross_crank_rod_by_time_*(motor_rate_ * motor_rate_) + dot_crank_rod_by_time_*motor_acceleration_
        + span_rod_head_x_*wristpin_Fy_by_time_ - span_rod_head_y_*wristpin_Fx_by_time_
        - wristpin_moment_first_by_time_;
    lin->value[10] = -a_rod_theta_*cross_crank_rod_*motor_rate_ - dot_crank_rod_*motor_rate_*(rod_omega_ * rod_omega_)
        + motor_rate_*span_crank_head_x_*wristpin_Fy_by_rod_theta_
        - motor_rate_*span_crank_head_y_*wristpin_Fx_by_rod_theta_;
    lin->value[11] = motor_rate_*span_crank_head_x_*wristpin_Fy_by_e_x_
        - motor_rate_*span_crank_head_y_*wristpin_Fx_by_e_x_;
    lin->value[12] = -rod_head_vx_by_rod_theta_*wristpin_Fx_ - rod_head_vy_*wristpin_Fy_by_rod_theta_
        - rod_head_vy_by_rod_theta_*wristpin_Fy_ + rod_omega_*wristpin_moment_first_by_rod_theta_
        + slider_omega_*wristpin_moment_second_by_rod_theta_
        + wristpin_Fx_by_rod_theta_*(cylinder_slide_rate_ - rod_head_vx_);
    lin->value[13] = -rod_head_vy_*wristpin_Fy_by_e_x_ + rod_omega_*wristpin_moment_first_by_e_x_
        + slider_omega_*wristpin_moment_second_by_e_x_ + wristpin_Fx_by_e_x_*(cylinder_slide_rate_ - rod_head_vx_);
    lin->value[14] = -2.0*cross_crank_rod_*motor_rate_*rod_omega_
        + motor_rate_*span_crank_head_x_*wristpin_Fy_by_rod_omega_
        - motor_rate_*span_crank_head_y_*wristpin_Fx_by_rod_omega_;
    lin->value[15] = motor_rate_*span_crank_head_x_*wristpin_Fy_by_de_x_
        - motor_rate_*span_crank_head_y_*wristpin_Fx_by_de_x_;
    lin->value[16] = -rod_head_vy_*wristpin_Fy_by_de_x_ + rod_omega_*wristpin_moment_first_by_de_x_
        + slider_omega_*wristpin_moment_second_by_de_x_ + wristpin_Fx_
        + wristpin_Fx_by_de_x_*(cylinder_slide_rate_ - rod_head_vx_);
    lin->value[17] = -rod_head_vy_*wristpin_Fy_by_rod_omega_ + rod_omega_*wristpin_moment_first_by_rod_omega_
        + slider_omega_*wristpin_moment_second_by_rod_omega_ - span_rod_head_x_*wristpin_Fy_
        + span_rod_head_y_*wristpin_Fx_ + wristpin_Fx_by_rod_omega_*(cylinder_slide_rate_ - rod_head_vx_)
        + wristpin_moment_first_;
    lin->value[18] = dot_crank_rod_*motor_rate_;
    lin->value[19] = a_rod_theta_*dot_crank_rod_by_time_*motor_rate_
        - cross_crank_rod_by_time_*motor_rate_*(rod_omega_ * rod_omega_)
        + motor_acceleration_*(a_rod_theta_*dot_crank_rod_ - cross_crank_rod_*(rod_omega_ * rod_omega_)
        + p->mass_motor_motor_*motor_acceleration_ + span_crank_head_x_*wristpin_Fy_ - span_crank_head_y_*wristpin_Fx_)
        + motor_rate_*span_crank_head_x_*wristpin_Fy_by_time_ + motor_rate_*span_crank_head_x_by_time_*wristpin_Fy_
        - motor_rate_*span_crank_head_y_*wristpin_Fx_by_time_ - motor_rate_*span_crank_head_y_by_time_*wristpin_Fx_;
    lin->value[20] = -rod_head_vx_by_time_*wristpin_Fx_ - rod_head_vy_*wristpin_Fy_by_time_
        - rod_head_vy_by_time_*wristpin_Fy_ + rod_omega_*wristpin_moment_first_by_time_
        + slider_omega_*wristpin_moment_second_by_time_ + wristpin_Fx_by_time_*(cylinder_slide_rate_ - rod_head_vx_);
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
    const double by_q_cylinder_slide_cylinder_slide_ = lin->value[0];
    const double by_q_cylinder_slide_rod_theta_ = lin->value[1];
    const double by_q_rod_theta_rod_theta_ = lin->value[2];
    const double by_q_rod_theta_cylinder_slide_ = lin->value[3];
    const double by_v_cylinder_slide_cylinder_slide_ = lin->value[4];
    const double by_v_cylinder_slide_rod_theta_ = lin->value[5];
    const double by_v_rod_theta_cylinder_slide_ = lin->value[6];
    const double by_v_rod_theta_rod_theta_ = lin->value[7];

    /* matrix */
    const double n_cylinder_slide_cylinder_slide_ = eta*(by_q_cylinder_slide_cylinder_slide_*eta
        + by_v_cylinder_slide_cylinder_slide_) + p->slider_mass_;
    const double n_cylinder_slide_rod_theta_ = eta*(by_q_cylinder_slide_rod_theta_*eta
        + by_v_cylinder_slide_rod_theta_);
    const double n_rod_theta_cylinder_slide_ = eta*(by_q_rod_theta_cylinder_slide_*eta
        + by_v_rod_theta_cylinder_slide_);
    const double n_rod_theta_rod_theta_ = eta*(by_q_rod_theta_rod_theta_*eta + by_v_rod_theta_rod_theta_)
        + p->mass_rod_rod_;

    /* L U */
    const double scale_cylinder_slide_ = n_cylinder_slide_cylinder_slide_;
    if (!(fabs(scale_cylinder_slide_) > SINGULAR * fabs(n_cylinder_slide_cylinder_slide_)))
        return 1;
    const double inverse_pivot_cylinder_slide_ = 1.0/scale_cylinder_slide_;
    lin->lu[0] = inverse_pivot_cylinder_slide_;
    const double l_rod_theta_cylinder_slide_ = inverse_pivot_cylinder_slide_*n_rod_theta_cylinder_slide_;
    lin->lu[1] = l_rod_theta_cylinder_slide_;
    lin->lu[2] = n_cylinder_slide_rod_theta_;
    const double scale_rod_theta_ = -l_rod_theta_cylinder_slide_*n_cylinder_slide_rod_theta_ + n_rod_theta_rod_theta_;
    if (!(fabs(scale_rod_theta_) > SINGULAR * fabs(n_rod_theta_rod_theta_)))
        return 2;
    const double inverse_pivot_rod_theta_ = 1.0/scale_rod_theta_;
    lin->lu[3] = inverse_pivot_rod_theta_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_cylinder_slide_ = lin->lu[0];
    const double l_rod_theta_cylinder_slide_ = lin->lu[1];
    const double n_cylinder_slide_rod_theta_ = lin->lu[2];
    const double inverse_pivot_rod_theta_ = lin->lu[3];

    /* forward */
    const double b_cylinder_slide_ = x[0];
    const double b_rod_theta_ = -b_cylinder_slide_*l_rod_theta_cylinder_slide_ + x[1];

    /* backward */
    const double x_rod_theta_ = b_rod_theta_*inverse_pivot_rod_theta_;
    x[1] = x_rod_theta_;
    const double x_cylinder_slide_ = inverse_pivot_cylinder_slide_*(b_cylinder_slide_
        - n_cylinder_slide_rod_theta_*x_rod_theta_);
    x[0] = x_cylinder_slide_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_cylinder_slide_cylinder_slide_ = lin->value[0];
    const double by_q_cylinder_slide_rod_theta_ = lin->value[1];
    const double by_q_rod_theta_rod_theta_ = lin->value[2];
    const double by_q_rod_theta_cylinder_slide_ = lin->value[3];
    const double by_t_cylinder_slide_ = lin->value[8];
    const double by_t_rod_theta_ = lin->value[9];
    const double power_q_0_rod_theta_ = lin->value[10];
    const double power_q_0_cylinder_slide_ = lin->value[11];
    const double power_q_2_rod_theta_ = lin->value[12];
    const double power_q_2_cylinder_slide_ = lin->value[13];
    const double power_v_0_rod_theta_ = lin->value[14];
    const double power_v_0_cylinder_slide_ = lin->value[15];
    const double power_v_2_cylinder_slide_ = lin->value[16];
    const double power_v_2_rod_theta_ = lin->value[17];
    const double power_0_rod_theta_ = lin->value[18];
    const double power_t_0_ = lin->value[19];
    const double power_t_2_ = lin->value[20];

    /* right-hand side */
    double x[2];
    x[0] = eta*(-by_q_cylinder_slide_cylinder_slide_*eta*r[0] - by_q_cylinder_slide_rod_theta_*eta*r[1]
        - by_t_cylinder_slide_*s + r[2]*p->slider_mass_);
    x[1] = eta*(-by_q_rod_theta_cylinder_slide_*eta*r[0] - by_q_rod_theta_rod_theta_*eta*r[1] - by_t_rod_theta_*s
        + p->mass_rod_rod_*r[3]);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*(power_q_0_cylinder_slide_*u[0] + power_q_0_rod_theta_*u[1] + power_t_0_*s
        + power_v_0_cylinder_slide_*u[2] + power_v_0_rod_theta_*u[3] + r[4]) + power_0_rod_theta_*(-eta*r[3] + x[1]);
    u[5] = eta*r[5];
    u[6] = eta*(power_q_2_cylinder_slide_*u[0] + power_q_2_rod_theta_*u[1] + power_t_2_*s
        + power_v_2_cylinder_slide_*u[2] + power_v_2_rod_theta_*u[3] + r[6]);
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 1}, {0, 1, 1, 1}, {1, 1, 2, 1}, {1, 0, 3, 1}, {0, 2, 4, 1}, {0, 3, 5, 1}, {1, 2, 6, 1},
    {1, 3, 7, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 8, 1}, {1, 0, 9, 1}
};
static const LinearEntry power_entries[] = {
    {0, 1, 10, 1}, {0, 0, 11, 1}, {2, 1, 12, 1}, {2, 0, 13, 1}, {0, 3, 14, 1}, {0, 2, 15, 1}, {2, 2, 16, 1},
    {2, 3, 17, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 1, 18, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 19, 1}, {2, 0, 20, 1}
};
enum {
    N_PHI_Q = 0,
    N_RESIDUAL = 8,
    N_RESIDUAL_T = 2,
    N_POWER = 8,
    N_POWER_ROW = 1,
    N_POWER_T = 2,
    N_NODES = 2,
};
/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
int closing_step(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *dq, double *dv, double *worst)
{
    (void)t, (void)q, (void)v, (void)memory, (void)p;
    /* backward substitution */
    const double dq_acceleration_rod_theta_ = 0.0;
    const double dq_acceleration_cylinder_slide_ = 0.0;

    /* backward substitution */
    const double dv_acceleration_rod_theta_ = 0.0;
    const double dv_acceleration_cylinder_slide_ = 0.0;

    /* results */
    dq[0] = dq_acceleration_cylinder_slide_;
    dv[0] = dv_acceleration_cylinder_slide_;
    dq[1] = dq_acceleration_rod_theta_;
    dv[1] = dv_acceleration_rod_theta_;
    *worst = 0.0;
    return 0;
}
