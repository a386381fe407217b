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
static inline void dry_slopes_hertz(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, double stiffness, double exponent, double R_i, double R_j, double c, double hysteresis,
    const double *side, double *g, int corner, PinSlopes *out)
{
    (void)de_t, (void)omega_i, (void)omega_j;
    /* penetration, ratio of velocities, slip */
    const double delta = e - c;
    const double depth = max_of(delta, 0.0);
    const double depth_by_e_ = delta > 0.0 ? 1.0 : 0.0;
    const double ratio = latch->closed ? deltadot/latch->deltadot_minus : 1.0;
    const double ratio_by_deltadot_ = latch->closed ? 1.0/latch->deltadot_minus : 0.0;
    const double a_i = 0.5*delta + R_i;
    const double a_j = -0.5*delta + R_j;

    /* contact */
    const double side_1 = side_of(side, g, corner, hysteresis*ratio + 1.0);
    const double power_depth_ = pow(depth, exponent - 1.0);
    double larger_1;
    if (side_1 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = hysteresis*ratio + 1.0;
    const double F_n = stiffness*depth*power_depth_*larger_1;
    const double F_n_by_depth_ = exponent*stiffness*power_depth_*larger_1;
    double branch_1;
    if (side_1 < 0.0)
        branch_1 = 0.0;
    else
        branch_1 = hysteresis;
    const double F_n_by_ratio_ = stiffness*depth*power_depth_*branch_1;
    const double F_n_by_e_ = F_n_by_depth_*depth_by_e_;
    const double F_n_by_deltadot_ = F_n_by_ratio_*ratio_by_deltadot_;
    const double F_along_t_dry = 0.0;
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_i_dry_by_e_ = -0.5*F_along_t_dry;
    const double M_j_dry = F_along_t_dry*a_j;
    const double M_j_dry_by_e_ = -0.5*F_along_t_dry;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e_;
    out->slope[0][1] = -F_n_by_deltadot_;
    out->slope[0][2] = 0.0;
    out->slope[0][3] = 0.0;
    out->slope[0][4] = 0.0;
    out->value[1] = F_along_t_dry;
    out->slope[1][0] = 0.0;
    out->slope[1][1] = 0.0;
    out->slope[1][2] = 0.0;
    out->slope[1][3] = 0.0;
    out->slope[1][4] = 0.0;
    out->value[2] = M_i_dry;
    out->slope[2][0] = M_i_dry_by_e_;
    out->slope[2][1] = 0.0;
    out->slope[2][2] = 0.0;
    out->slope[2][3] = 0.0;
    out->slope[2][4] = 0.0;
    out->value[3] = M_j_dry;
    out->slope[3][0] = M_j_dry_by_e_;
    out->slope[3][1] = 0.0;
    out->slope[3][2] = 0.0;
    out->slope[3][3] = 0.0;
    out->slope[3][4] = 0.0;
}

/*
 * Joint fall: the derivatives of (F_x, F_y, M_i, M_j) by (e_x, e_y, de_x, de_y, omega_i, omega_j), on the same
 * side of every corner as the force itself.
 */
static void slopes_fall_(double e, double deltadot, double de_t, double omega_i, double omega_j, const Latch *latch,
    const Parameters *p, const double *side, double *g, PinSlopes *out)
{
    const double delta = e - p->floor_clearance_;
    *out = (PinSlopes){0};
    if (side ? latch->closed : delta > 0.0)
        dry_slopes_hertz(e, deltadot, de_t, omega_i, omega_j, latch, p->damped_normal_stiffness_,
            p->damped_normal_exponent_, p->floor_radius_, p->R_j_floor_, p->floor_clearance_,
            p->damped_floor_hysteresis_, side, g, 0, out);
}

static void tangent_fall_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, double dF[4][6])
{
    PinSlopes F;
    const double e = sqrt(e_x * e_x + e_y * e_y);
    if (e > CENTRED * p->floor_clearance_) {
        const double inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y = e_y * inverse_e;
        const double deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
        slopes_fall_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
        in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
        return;
    }
    /* at the centre each axis in turn is the normal */
    slopes_fall_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, 1.0, 0.0, de_x, de_y, 0.0, dF);
    slopes_fall_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    (void)t, (void)a;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const double ball_x_ = q[0];
    const double ball_x_rate_ = v[0];
    const double ball_y_ = q[1];
    const double ball_y_rate_ = v[1];
    const double ball_omega_ = v[2];
    const double fall_Fx_ = aside->clearance[0].Fx;
    const double fall_Fy_ = aside->clearance[0].Fy;
    const double fall_moment_second_ = aside->clearance[0].moment_second;

    /* clearance joint fall */
    const double e_fall_x_ = ball_x_;
    const double e_fall_y_ = ball_y_;
    const double edot_fall_x_ = ball_x_rate_;
    const double edot_fall_y_ = ball_y_rate_;
    double change_fall_[4][6];
    tangent_fall_(e_fall_x_, e_fall_y_, edot_fall_x_, edot_fall_y_, 0, ball_omega_, &memory->latch[0], p, side, g,
        change_fall_);
    const double fall_Fx_by_e_x_ = change_fall_[0][0];
    const double fall_Fx_by_e_y_ = change_fall_[0][1];
    const double fall_Fx_by_de_x_ = change_fall_[0][2];
    const double fall_Fx_by_de_y_ = change_fall_[0][3];
    const double fall_Fx_by_omega_j_ = change_fall_[0][5];
    const double fall_Fy_by_e_x_ = change_fall_[1][0];
    const double fall_Fy_by_e_y_ = change_fall_[1][1];
    const double fall_Fy_by_de_x_ = change_fall_[1][2];
    const double fall_Fy_by_de_y_ = change_fall_[1][3];
    const double fall_Fy_by_omega_j_ = change_fall_[1][5];
    const double fall_moment_second_by_e_x_ = change_fall_[3][0];
    const double fall_moment_second_by_e_y_ = change_fall_[3][1];
    const double fall_moment_second_by_de_x_ = change_fall_[3][2];
    const double fall_moment_second_by_de_y_ = change_fall_[3][3];
    const double fall_moment_second_by_omega_j_ = change_fall_[3][5];

    /* results */
    lin->value[0] = -fall_Fx_by_e_x_;
    lin->value[1] = -fall_Fx_by_e_y_;
    lin->value[2] = -fall_Fy_by_e_x_;
    lin->value[3] = -fall_Fy_by_e_y_;
    lin->value[4] = -fall_moment_second_by_e_x_;
    lin->value[5] = -fall_moment_second_by_e_y_;
    lin->value[6] = -fall_Fx_by_de_x_;
    lin->value[7] = -fall_Fx_by_de_y_;
    lin->value[8] = -fall_Fx_by_omega_j_;
    lin->value[9] = -fall_Fy_by_de_x_;
    lin->value[10] = -fall_Fy_by_de_y_;
    lin->value[11] = -fall_Fy_by_omega_j_;
    lin->value[12] = -fall_moment_second_by_de_x_;
    lin->value[13] = -fall_moment_second_by_de_y_;
    lin->value[14] = -fall_moment_second_by_omega_j_;
    lin->value[15] = ball_omega_*fall_moment_second_by_e_x_ + ball_x_rate_*fall_Fx_by_e_x_
        + ball_y_rate_*fall_Fy_by_e_x_;
    lin->value[16] = ball_omega_*fall_moment_second_by_e_y_ + ball_x_rate_*fall_Fx_by_e_y_
        + ball_y_rate_*fall_Fy_by_e_y_;
    lin->value[17] = ball_omega_*fall_moment_second_by_omega_j_ + ball_x_rate_*fall_Fx_by_omega_j_
        + ball_y_rate_*fall_Fy_by_omega_j_ + fall_moment_second_;
    lin->value[18] = ball_omega_*fall_moment_second_by_de_x_ + ball_x_rate_*fall_Fx_by_de_x_
        + ball_y_rate_*fall_Fy_by_de_x_ + fall_Fx_;
    lin->value[19] = ball_omega_*fall_moment_second_by_de_y_ + ball_x_rate_*fall_Fx_by_de_y_
        + ball_y_rate_*fall_Fy_by_de_y_ + fall_Fy_;
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
    const double by_q_ball_x_ball_x_ = lin->value[0];
    const double by_q_ball_x_ball_y_ = lin->value[1];
    const double by_q_ball_y_ball_x_ = lin->value[2];
    const double by_q_ball_y_ball_y_ = lin->value[3];
    const double by_q_ball_theta_ball_x_ = lin->value[4];
    const double by_q_ball_theta_ball_y_ = lin->value[5];
    const double by_v_ball_x_ball_x_ = lin->value[6];
    const double by_v_ball_x_ball_y_ = lin->value[7];
    const double by_v_ball_x_ball_theta_ = lin->value[8];
    const double by_v_ball_y_ball_x_ = lin->value[9];
    const double by_v_ball_y_ball_y_ = lin->value[10];
    const double by_v_ball_y_ball_theta_ = lin->value[11];
    const double by_v_ball_theta_ball_x_ = lin->value[12];
    const double by_v_ball_theta_ball_y_ = lin->value[13];
    const double by_v_ball_theta_ball_theta_ = lin->value[14];

    /* matrix */
    const double n_ball_x_ball_x_ = p->ball_mass_ + eta*(by_q_ball_x_ball_x_*eta + by_v_ball_x_ball_x_);
    const double n_ball_x_ball_y_ = eta*(by_q_ball_x_ball_y_*eta + by_v_ball_x_ball_y_);
    const double n_ball_x_ball_theta_ = by_v_ball_x_ball_theta_*eta;
    const double n_ball_y_ball_x_ = eta*(by_q_ball_y_ball_x_*eta + by_v_ball_y_ball_x_);
    const double n_ball_y_ball_y_ = p->ball_mass_ + eta*(by_q_ball_y_ball_y_*eta + by_v_ball_y_ball_y_);
    const double n_ball_y_ball_theta_ = by_v_ball_y_ball_theta_*eta;
    const double n_ball_theta_ball_x_ = eta*(by_q_ball_theta_ball_x_*eta + by_v_ball_theta_ball_x_);
    const double n_ball_theta_ball_y_ = eta*(by_q_ball_theta_ball_y_*eta + by_v_ball_theta_ball_y_);
    const double n_ball_theta_ball_theta_ = p->ball_inertia_ + by_v_ball_theta_ball_theta_*eta;

    /* L U */
    const double scale_ball_x_ = n_ball_x_ball_x_;
    if (!(fabs(scale_ball_x_) > SINGULAR * fabs(n_ball_x_ball_x_)))
        return 1;
    const double inverse_pivot_ball_x_ = 1.0/scale_ball_x_;
    lin->lu[0] = inverse_pivot_ball_x_;
    const double l_ball_y_ball_x_ = inverse_pivot_ball_x_*n_ball_y_ball_x_;
    lin->lu[1] = l_ball_y_ball_x_;
    lin->lu[2] = n_ball_x_ball_y_;
    const double l_ball_theta_ball_x_ = inverse_pivot_ball_x_*n_ball_theta_ball_x_;
    lin->lu[3] = l_ball_theta_ball_x_;
    lin->lu[4] = n_ball_x_ball_theta_;
    const double scale_ball_y_ = -l_ball_y_ball_x_*n_ball_x_ball_y_ + n_ball_y_ball_y_;
    if (!(fabs(scale_ball_y_) > SINGULAR * fabs(n_ball_y_ball_y_)))
        return 2;
    const double inverse_pivot_ball_y_ = 1.0/scale_ball_y_;
    lin->lu[5] = inverse_pivot_ball_y_;
    const double l_ball_theta_ball_y_ = inverse_pivot_ball_y_*(-l_ball_theta_ball_x_*n_ball_x_ball_y_
        + n_ball_theta_ball_y_);
    lin->lu[6] = l_ball_theta_ball_y_;
    const double u_ball_y_ball_theta_ = -l_ball_y_ball_x_*n_ball_x_ball_theta_ + n_ball_y_ball_theta_;
    lin->lu[7] = u_ball_y_ball_theta_;
    const double scale_ball_theta_ = -l_ball_theta_ball_x_*n_ball_x_ball_theta_
        - l_ball_theta_ball_y_*u_ball_y_ball_theta_ + n_ball_theta_ball_theta_;
    if (!(fabs(scale_ball_theta_) > SINGULAR * fabs(n_ball_theta_ball_theta_)))
        return 3;
    const double inverse_pivot_ball_theta_ = 1.0/scale_ball_theta_;
    lin->lu[8] = inverse_pivot_ball_theta_;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_ball_x_ = lin->lu[0];
    const double l_ball_y_ball_x_ = lin->lu[1];
    const double n_ball_x_ball_y_ = lin->lu[2];
    const double l_ball_theta_ball_x_ = lin->lu[3];
    const double n_ball_x_ball_theta_ = lin->lu[4];
    const double inverse_pivot_ball_y_ = lin->lu[5];
    const double l_ball_theta_ball_y_ = lin->lu[6];
    const double u_ball_y_ball_theta_ = lin->lu[7];
    const double inverse_pivot_ball_theta_ = lin->lu[8];

    /* forward */
    const double b_ball_x_ = x[0];
    const double b_ball_y_ = -b_ball_x_*l_ball_y_ball_x_ + x[1];
    const double b_ball_theta_ = -b_ball_x_*l_ball_theta_ball_x_ - b_ball_y_*l_ball_theta_ball_y_ + x[2];

    /* backward */
    const double x_ball_theta_ = b_ball_theta_*inverse_pivot_ball_theta_;
    x[2] = x_ball_theta_;
    const double x_ball_y_ = inverse_pivot_ball_y_*(b_ball_y_ - u_ball_y_ball_theta_*x_ball_theta_);
    x[1] = x_ball_y_;
    const double x_ball_x_ = inverse_pivot_ball_x_*(b_ball_x_ - n_ball_x_ball_theta_*x_ball_theta_
        - n_ball_x_ball_y_*x_ball_y_);
    x[0] = x_ball_x_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_ball_x_ball_x_ = lin->value[0];
    const double by_q_ball_x_ball_y_ = lin->value[1];
    const double by_q_ball_y_ball_x_ = lin->value[2];
    const double by_q_ball_y_ball_y_ = lin->value[3];
    const double by_q_ball_theta_ball_x_ = lin->value[4];
    const double by_q_ball_theta_ball_y_ = lin->value[5];
    const double power_q_2_ball_x_ = lin->value[15];
    const double power_q_2_ball_y_ = lin->value[16];
    const double power_v_2_ball_theta_ = lin->value[17];
    const double power_v_2_ball_x_ = lin->value[18];
    const double power_v_2_ball_y_ = lin->value[19];

    /* right-hand side */
    double x[3];
    x[0] = eta*(p->ball_mass_*r[3] - by_q_ball_x_ball_x_*eta*r[0] - by_q_ball_x_ball_y_*eta*r[1]);
    x[1] = eta*(p->ball_mass_*r[4] - by_q_ball_y_ball_x_*eta*r[0] - by_q_ball_y_ball_y_*eta*r[1]);
    x[2] = eta*(p->ball_inertia_*r[5] - by_q_ball_theta_ball_x_*eta*r[0] - by_q_ball_theta_ball_y_*eta*r[1]);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*r[6];
    u[7] = eta*r[7];
    u[8] = eta*(power_q_2_ball_x_*u[0] + power_q_2_ball_y_*u[1] + power_v_2_ball_theta_*u[5] + power_v_2_ball_x_*u[3]
        + power_v_2_ball_y_*u[4] + r[8]);
}

/* Where parts of the linearization are in `value`. */
static const LinearEntry phi_q_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 1}, {0, 1, 1, 1}, {1, 0, 2, 1}, {1, 1, 3, 1}, {2, 0, 4, 1}, {2, 1, 5, 1}, {0, 3, 6, 1},
    {0, 4, 7, 1}, {0, 5, 8, 1}, {1, 3, 9, 1}, {1, 4, 10, 1}, {1, 5, 11, 1}, {2, 3, 12, 1}, {2, 4, 13, 1},
    {2, 5, 14, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {2, 0, 15, 1}, {2, 1, 16, 1}, {2, 5, 17, 1}, {2, 3, 18, 1}, {2, 4, 19, 1}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 0,
    N_RESIDUAL = 15,
    N_RESIDUAL_T = 0,
    N_POWER = 5,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 3,
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
    const double dq_acceleration_ball_theta_ = 0.0;
    const double dq_acceleration_ball_y_ = 0.0;
    const double dq_acceleration_ball_x_ = 0.0;

    /* backward substitution */
    const double dv_acceleration_ball_theta_ = 0.0;
    const double dv_acceleration_ball_y_ = 0.0;
    const double dv_acceleration_ball_x_ = 0.0;

    /* results */
    dq[0] = dq_acceleration_ball_x_;
    dv[0] = dv_acceleration_ball_x_;
    dq[1] = dq_acceleration_ball_y_;
    dv[1] = dv_acceleration_ball_y_;
    dq[2] = dq_acceleration_ball_theta_;
    dv[2] = dv_acceleration_ball_theta_;
    *worst = 0.0;
    return 0;
}
