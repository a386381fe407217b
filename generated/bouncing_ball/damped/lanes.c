/*
 * The functions that methods need, for several runs side by side (engine/batch/lanes.h): the same operations with
 * vectors for numbers. A library of its own, compiled when a batch first asks for it: as it is for rk4, with HELD for
 * methods that choose their step.
 */
#ifndef HELD
#define HELD 0
#endif
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct LaneParameters {
    Lanes height_;
    Lanes ball_mass_;
    Lanes ball_inertia_;
    Lanes alpha_;
    Lanes beta_;
    Lanes floor_radius_;
    Lanes floor_clearance_;
    Lanes floor_length_;
    Lanes steel_E_;
    Lanes steel_nu_;
    Lanes damped_normal_stiffness_;
    Lanes damped_normal_exponent_;
    Lanes damped_normal_restitution_;
    Lanes velocity_floor_;
    Lanes gravity_y_;
    Lanes R_j_floor_;
    Lanes damped_floor_hysteresis_;
    Lanes weight_ball_y_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes inverse_ball_mass_;
    Lanes inverse_ball_inertia_;
    Lanes tree_metric_ball_x_;
    Lanes inverse_tree_metric_ball_x_;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->floor_radius_;
    default:
        return all_of(0.0);
    }
}

/*
 * Hertz contact with a choice of hysteresis damping.
 * Source: H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 * Valid: a point or a line contact whose stiffness is known or that of spheres; small penetrations; driven apart fast
 * it would pull, and is 0 there unless it pulls.
 * Options: dissipation: hunt_crossley, pulls: False.
 * stiffness: force at unit penetration, N/m^n; exponent: exponent of the penetration; hysteresis: hysteresis
 * damping factor a.
 */
static inline void hertz(Lanes delta, Lanes ratio, Lanes stiffness, Lanes exponent, Lanes hysteresis, const Lanes *side,
    Lanes *g, int corner, Lanes *F_n_out)
{
    const Lanes side_1 = lanes_side_of(side, g, corner, hysteresis*ratio + 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    *F_n_out = stiffness*lanes_pow(delta, exponent)*larger_1;
}

/* Dry contact in joint fall, as in clearance.c. */
static inline LanePinForce dry_fall_(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g)
{
    (void)side, (void)g;
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->floor_radius_;
    const Lanes a_j = -0.5*delta + p->R_j_floor_;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    hertz(lanes_max_of(delta, all_of(0.0)), ratio, p->damped_normal_stiffness_, p->damped_normal_exponent_,
        p->damped_floor_hysteresis_, side, g, 0, &F_n);
    const Lanes F_along_t_dry = all_of(0.0); /* no friction */
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint fall: what each lane does not have is passed over where no lane has it. */
static void clearance_fall_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->floor_clearance_;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    silence(g, 0, 1); /* what does not act does not switch */
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = is_touching(latch, delta);
    if (any_of(touching)) {
        Lanes film_g[N_SWITCHES];
        set_aside(g, film_g, 0, 1);
        LanePinForce dry = dry_fall_(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
        F.v_t = pick(touching, dry.v_t, F.v_t);
        put_together(g, film_g, 0, 1, touching, (LaneBits){0});
    }
    *out = (LaneClearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t, .e = e,
        .deltadot = deltadot, .delta = delta, .moment_first = F.M_i, .moment_second = F.M_j};
#if HELD
    out->ex = e_x, out->ey = e_y, out->v_t = F.v_t;
#endif
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
static void closures(const Lanes t, const Lanes *q, const LaneParameters *p, Lanes *out, LaneBits *rare)
{
    (void)t, (void)q, (void)p, (void)out, (void)rare;
    /* this scene has none */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t, (void)q, (void)v, (void)p, (void)out, (void)rare;
    /* this scene has none */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)t, (void)rare;
    /* corners: the sides that are held, if any */
    const Lanes *const side = held_sides(memory);
    Lanes *const g = told_sides(aside);

    /* coordinates, velocities, time */
    const Lanes ball_x_ = q[0];
    const Lanes ball_x_rate_ = v[0];
    const Lanes ball_y_ = q[1];
    const Lanes ball_y_rate_ = v[1];
    const Lanes ball_omega_ = v[2];

    /* clearance joint fall */
    const Lanes e_fall_x_ = ball_x_;
    const Lanes e_fall_y_ = ball_y_;
    const Lanes edot_fall_x_ = ball_x_rate_;
    const Lanes edot_fall_y_ = ball_y_rate_;
    clearance_fall_(e_fall_x_, e_fall_y_, edot_fall_x_, edot_fall_y_, all_of(0.0), ball_omega_, &memory->latch[0], p,
        side, g, &aside->clearance[0]);
    const Lanes F_fall_x_ = aside->clearance[0].Fx;
    const Lanes F_fall_y_ = aside->clearance[0].Fy;
    const Lanes M_fall_second_ = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_fall_x_*edot_fall_x_ + F_fall_y_*edot_fall_y_ + M_fall_second_*ball_omega_;

    /* forward substitution */
    const Lanes z_ball_y_ = F_fall_y_ + p->weight_ball_y_;

    /* backward substitution */
    const Lanes acceleration_ball_theta_ = M_fall_second_*p->inverse_ball_inertia_;
    const Lanes acceleration_ball_y_ = p->inverse_ball_mass_*z_ball_y_;
    const Lanes acceleration_ball_x_ = F_fall_x_*p->inverse_ball_mass_;

    /* results */
    a[0] = acceleration_ball_x_;
    a[1] = acceleration_ball_y_;
    a[2] = acceleration_ball_theta_;
    aside->power[0] = all_of(0.0);
    aside->power[1] = all_of(0.0);
    aside->power[2] = aside->clearance[0].power;
}

/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
{
    (void)t, (void)q, (void)v, (void)memory, (void)p, (void)rare;
    /* backward substitution */
    const Lanes dq_acceleration_ball_theta_ = all_of(0.0);
    const Lanes dq_acceleration_ball_y_ = all_of(0.0);
    const Lanes dq_acceleration_ball_x_ = all_of(0.0);

    /* backward substitution */
    const Lanes dv_acceleration_ball_theta_ = all_of(0.0);
    const Lanes dv_acceleration_ball_y_ = all_of(0.0);
    const Lanes dv_acceleration_ball_x_ = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_ball_x_;
    dv[0] = dv_acceleration_ball_x_;
    dq[1] = dq_acceleration_ball_y_;
    dv[1] = dv_acceleration_ball_y_;
    dq[2] = dq_acceleration_ball_theta_;
    dv[2] = dv_acceleration_ball_theta_;
    *worst = all_of(0.0);
}

#if !HELD
#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
#else
/*
 * (F along n, F along t, M_i, M_j) of a joint with play and their derivatives by (e, deltadot, de_t, omega_i, omega_j).
 */
typedef struct {
    Lanes value[4], slope[4][5];
} LaneSlopes;

/*
 * As a share of the clearance: nearer to the centre the derivatives are those at the centre. There a force along the
 * normal and the normal's own turning cancel, which leaves some DBL_EPSILON c/e of rounding.
 */
#define CENTRED 1e-8

/*
 * From n, t to ground axes. Where e moves by de = (along n, along t) = (x, y), n turns by y/e: F by F rotated, and
 * deltadot, de_t by (de_t, -deltadot) y/e.
 */
static inline void in_ground_axes(const LaneSlopes *F, Lanes n_x, Lanes n_y, Lanes deltadot, Lanes de_t,
    Lanes per_e, Lanes dF[4][6])
{
    Lanes by[4][6];
    for (int i = 0; i < 4; i++) {
        const Lanes *slope = F->slope[i];
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
        const Lanes along_n = dF[0][k], along_t = dF[1][k];
        dF[0][k] = along_n * n_x - along_t * n_y;
        dF[1][k] = along_n * n_y + along_t * n_x;
    }
}


/* Those of b where the mask is set. */
static inline void pick_slopes(LaneSlopes *a, LaneBits mask, const LaneSlopes *b)
{
    for (int i = 0; i < 4; i++) {
        a->value[i] = pick(mask, b->value[i], a->value[i]);
        for (int k = 0; k < 5; k++)
            a->slope[i][k] = pick(mask, b->slope[i][k], a->slope[i][k]);
    }
}

/*
 * Dry: F along n and t, M_i, M_j, and their derivatives by e, deltadot, de_t, omega_i,
 * omega_j (forward differentiation of the same steps).
 */
static inline void dry_slopes_hertz(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, Lanes stiffness, Lanes exponent, Lanes R_i, Lanes R_j, Lanes c, Lanes hysteresis,
    const Lanes *side, Lanes *g, int corner, LaneSlopes *out)
{
    (void)de_t, (void)omega_i, (void)omega_j;
    /* penetration, ratio of velocities, slip */
    const Lanes delta = e - c;
    const Lanes depth = lanes_max_of(delta, all_of(0.0));
    const Lanes depth_by_e_ = pick(delta > 0.0, all_of(1.0), all_of(0.0));
    const Lanes ratio = pick(latch->closed > 0.0, deltadot/latch->deltadot_minus, all_of(1.0));
    const Lanes ratio_by_deltadot_ = pick(latch->closed > 0.0, 1.0/latch->deltadot_minus, all_of(0.0));
    const Lanes a_i = 0.5*delta + R_i;
    const Lanes a_j = -0.5*delta + R_j;

    /* contact */
    const Lanes side_1 = lanes_side_of(side, g, corner, hysteresis*ratio + 1.0);
    const Lanes power_depth_ = lanes_pow(depth, exponent - 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    const Lanes F_n = stiffness*depth*power_depth_*larger_1;
    const Lanes F_n_by_depth_ = exponent*stiffness*power_depth_*larger_1;
    const Lanes branch_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis);
    const Lanes F_n_by_ratio_ = stiffness*depth*power_depth_*branch_1;
    const Lanes F_n_by_e_ = F_n_by_depth_*depth_by_e_;
    const Lanes F_n_by_deltadot_ = F_n_by_ratio_*ratio_by_deltadot_;
    const Lanes F_along_t_dry = all_of(0.0);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_i_dry_by_e_ = -0.5*F_along_t_dry;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    const Lanes M_j_dry_by_e_ = -0.5*F_along_t_dry;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e_;
    out->slope[0][1] = -F_n_by_deltadot_;
    out->slope[0][2] = all_of(0.0);
    out->slope[0][3] = all_of(0.0);
    out->slope[0][4] = all_of(0.0);
    out->value[1] = F_along_t_dry;
    out->slope[1][0] = all_of(0.0);
    out->slope[1][1] = all_of(0.0);
    out->slope[1][2] = all_of(0.0);
    out->slope[1][3] = all_of(0.0);
    out->slope[1][4] = all_of(0.0);
    out->value[2] = M_i_dry;
    out->slope[2][0] = M_i_dry_by_e_;
    out->slope[2][1] = all_of(0.0);
    out->slope[2][2] = all_of(0.0);
    out->slope[2][3] = all_of(0.0);
    out->slope[2][4] = all_of(0.0);
    out->value[3] = M_j_dry;
    out->slope[3][0] = M_j_dry_by_e_;
    out->slope[3][1] = all_of(0.0);
    out->slope[3][2] = all_of(0.0);
    out->slope[3][3] = all_of(0.0);
    out->slope[3][4] = all_of(0.0);
}

/* Joint fall, as in newton.c: what acts in no lane is passed over. */
static void slopes_fall_(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
    const LaneParameters *p, const Lanes *side, Lanes *g, LaneSlopes *out)
{
    (void)p, (void)side, (void)g;
    *out = (LaneSlopes){0};
    const LaneBits touching = is_closed(latch);
    if (any_of(touching)) {
        LaneSlopes dry;
        dry_slopes_hertz(e, deltadot, de_t, omega_i, omega_j, latch, p->damped_normal_stiffness_,
            p->damped_normal_exponent_, p->floor_radius_, p->R_j_floor_, p->floor_clearance_,
            p->damped_floor_hysteresis_, side, g, 0, &dry);
        pick_slopes(out, touching, &dry);
    }
}

static void tangent_fall_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->floor_clearance_);
    slopes_fall_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_fall_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_fall_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
    there[0][1] = -F.slope[1][0];
    there[1][1] = F.slope[0][0];
    there[2][1] = F.slope[2][0];
    there[3][1] = F.slope[3][0];
    for (int i = 4; i < 4; i++)
        there[i][1] = F.slope[i][0];
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 6; k++)
            dF[i][k] = pick(centred, there[i][k], dF[i][k]);
}

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory, const LaneParameters *p,
    const Lanes *a, const LaneAside *aside, LaneLinear *lin, LaneBits *rare)
{
    (void)t, (void)a, (void)rare;
    /* corners: the sides that are held, if any */
    const Lanes *const side = held_sides(memory);
    Lanes g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const Lanes ball_x_ = q[0];
    const Lanes ball_x_rate_ = v[0];
    const Lanes ball_y_ = q[1];
    const Lanes ball_y_rate_ = v[1];
    const Lanes ball_omega_ = v[2];
    const Lanes fall_Fx_ = aside->clearance[0].Fx;
    const Lanes fall_Fy_ = aside->clearance[0].Fy;
    const Lanes fall_moment_second_ = aside->clearance[0].moment_second;

    /* clearance joint fall */
    const Lanes e_fall_x_ = ball_x_;
    const Lanes e_fall_y_ = ball_y_;
    const Lanes edot_fall_x_ = ball_x_rate_;
    const Lanes edot_fall_y_ = ball_y_rate_;
    Lanes change_fall_[4][6];
    tangent_fall_(e_fall_x_, e_fall_y_, edot_fall_x_, edot_fall_y_, all_of(0.0), ball_omega_, &memory->latch[0], p,
        side, g, change_fall_);
    const Lanes fall_Fx_by_e_x_ = change_fall_[0][0];
    const Lanes fall_Fx_by_e_y_ = change_fall_[0][1];
    const Lanes fall_Fx_by_de_x_ = change_fall_[0][2];
    const Lanes fall_Fx_by_de_y_ = change_fall_[0][3];
    const Lanes fall_Fx_by_omega_j_ = change_fall_[0][5];
    const Lanes fall_Fy_by_e_x_ = change_fall_[1][0];
    const Lanes fall_Fy_by_e_y_ = change_fall_[1][1];
    const Lanes fall_Fy_by_de_x_ = change_fall_[1][2];
    const Lanes fall_Fy_by_de_y_ = change_fall_[1][3];
    const Lanes fall_Fy_by_omega_j_ = change_fall_[1][5];
    const Lanes fall_moment_second_by_e_x_ = change_fall_[3][0];
    const Lanes fall_moment_second_by_e_y_ = change_fall_[3][1];
    const Lanes fall_moment_second_by_de_x_ = change_fall_[3][2];
    const Lanes fall_moment_second_by_de_y_ = change_fall_[3][3];
    const Lanes fall_moment_second_by_omega_j_ = change_fall_[3][5];

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
static void newton_factor(Lanes eta, LaneLinear *lin, LaneBits *rare)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes by_q_ball_x_ball_x_ = lin->value[0];
    const Lanes by_q_ball_x_ball_y_ = lin->value[1];
    const Lanes by_q_ball_y_ball_x_ = lin->value[2];
    const Lanes by_q_ball_y_ball_y_ = lin->value[3];
    const Lanes by_q_ball_theta_ball_x_ = lin->value[4];
    const Lanes by_q_ball_theta_ball_y_ = lin->value[5];
    const Lanes by_v_ball_x_ball_x_ = lin->value[6];
    const Lanes by_v_ball_x_ball_y_ = lin->value[7];
    const Lanes by_v_ball_x_ball_theta_ = lin->value[8];
    const Lanes by_v_ball_y_ball_x_ = lin->value[9];
    const Lanes by_v_ball_y_ball_y_ = lin->value[10];
    const Lanes by_v_ball_y_ball_theta_ = lin->value[11];
    const Lanes by_v_ball_theta_ball_x_ = lin->value[12];
    const Lanes by_v_ball_theta_ball_y_ = lin->value[13];
    const Lanes by_v_ball_theta_ball_theta_ = lin->value[14];

    /* matrix */
    const Lanes n_ball_x_ball_x_ = p->ball_mass_ + eta*(by_q_ball_x_ball_x_*eta + by_v_ball_x_ball_x_);
    const Lanes n_ball_x_ball_y_ = eta*(by_q_ball_x_ball_y_*eta + by_v_ball_x_ball_y_);
    const Lanes n_ball_x_ball_theta_ = by_v_ball_x_ball_theta_*eta;
    const Lanes n_ball_y_ball_x_ = eta*(by_q_ball_y_ball_x_*eta + by_v_ball_y_ball_x_);
    const Lanes n_ball_y_ball_y_ = p->ball_mass_ + eta*(by_q_ball_y_ball_y_*eta + by_v_ball_y_ball_y_);
    const Lanes n_ball_y_ball_theta_ = by_v_ball_y_ball_theta_*eta;
    const Lanes n_ball_theta_ball_x_ = eta*(by_q_ball_theta_ball_x_*eta + by_v_ball_theta_ball_x_);
    const Lanes n_ball_theta_ball_y_ = eta*(by_q_ball_theta_ball_y_*eta + by_v_ball_theta_ball_y_);
    const Lanes n_ball_theta_ball_theta_ = p->ball_inertia_ + by_v_ball_theta_ball_theta_*eta;

    /* L U */
    const Lanes scale_ball_x_ = n_ball_x_ball_x_;
    *rare |= ~(lanes_fabs(scale_ball_x_) > SINGULAR * lanes_fabs(n_ball_x_ball_x_));
    const Lanes inverse_pivot_ball_x_ = 1.0/scale_ball_x_;
    lin->lu[0] = inverse_pivot_ball_x_;
    const Lanes l_ball_y_ball_x_ = inverse_pivot_ball_x_*n_ball_y_ball_x_;
    lin->lu[1] = l_ball_y_ball_x_;
    lin->lu[2] = n_ball_x_ball_y_;
    const Lanes l_ball_theta_ball_x_ = inverse_pivot_ball_x_*n_ball_theta_ball_x_;
    lin->lu[3] = l_ball_theta_ball_x_;
    lin->lu[4] = n_ball_x_ball_theta_;
    const Lanes scale_ball_y_ = -l_ball_y_ball_x_*n_ball_x_ball_y_ + n_ball_y_ball_y_;
    *rare |= ~(lanes_fabs(scale_ball_y_) > SINGULAR * lanes_fabs(n_ball_y_ball_y_));
    const Lanes inverse_pivot_ball_y_ = 1.0/scale_ball_y_;
    lin->lu[5] = inverse_pivot_ball_y_;
    const Lanes l_ball_theta_ball_y_ = inverse_pivot_ball_y_*(-l_ball_theta_ball_x_*n_ball_x_ball_y_
        + n_ball_theta_ball_y_);
    lin->lu[6] = l_ball_theta_ball_y_;
    const Lanes u_ball_y_ball_theta_ = -l_ball_y_ball_x_*n_ball_x_ball_theta_ + n_ball_y_ball_theta_;
    lin->lu[7] = u_ball_y_ball_theta_;
    const Lanes scale_ball_theta_ = -l_ball_theta_ball_x_*n_ball_x_ball_theta_
        - l_ball_theta_ball_y_*u_ball_y_ball_theta_ + n_ball_theta_ball_theta_;
    *rare |= ~(lanes_fabs(scale_ball_theta_) > SINGULAR * lanes_fabs(n_ball_theta_ball_theta_));
    const Lanes inverse_pivot_ball_theta_ = 1.0/scale_ball_theta_;
    lin->lu[8] = inverse_pivot_ball_theta_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes inverse_pivot_ball_x_ = lin->lu[0];
    const Lanes l_ball_y_ball_x_ = lin->lu[1];
    const Lanes n_ball_x_ball_y_ = lin->lu[2];
    const Lanes l_ball_theta_ball_x_ = lin->lu[3];
    const Lanes n_ball_x_ball_theta_ = lin->lu[4];
    const Lanes inverse_pivot_ball_y_ = lin->lu[5];
    const Lanes l_ball_theta_ball_y_ = lin->lu[6];
    const Lanes u_ball_y_ball_theta_ = lin->lu[7];
    const Lanes inverse_pivot_ball_theta_ = lin->lu[8];

    /* forward */
    const Lanes b_ball_x_ = x[0];
    const Lanes b_ball_y_ = -b_ball_x_*l_ball_y_ball_x_ + x[1];
    const Lanes b_ball_theta_ = -b_ball_x_*l_ball_theta_ball_x_ - b_ball_y_*l_ball_theta_ball_y_ + x[2];

    /* backward */
    const Lanes x_ball_theta_ = b_ball_theta_*inverse_pivot_ball_theta_;
    x[2] = x_ball_theta_;
    const Lanes x_ball_y_ = inverse_pivot_ball_y_*(b_ball_y_ - u_ball_y_ball_theta_*x_ball_theta_);
    x[1] = x_ball_y_;
    const Lanes x_ball_x_ = inverse_pivot_ball_x_*(b_ball_x_ - n_ball_x_ball_theta_*x_ball_theta_
        - n_ball_x_ball_y_*x_ball_y_);
    x[0] = x_ball_x_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    (void)s;
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes by_q_ball_x_ball_x_ = lin->value[0];
    const Lanes by_q_ball_x_ball_y_ = lin->value[1];
    const Lanes by_q_ball_y_ball_x_ = lin->value[2];
    const Lanes by_q_ball_y_ball_y_ = lin->value[3];
    const Lanes by_q_ball_theta_ball_x_ = lin->value[4];
    const Lanes by_q_ball_theta_ball_y_ = lin->value[5];
    const Lanes power_q_2_ball_x_ = lin->value[15];
    const Lanes power_q_2_ball_y_ = lin->value[16];
    const Lanes power_v_2_ball_theta_ = lin->value[17];
    const Lanes power_v_2_ball_x_ = lin->value[18];
    const Lanes power_v_2_ball_y_ = lin->value[19];

    /* right-hand side */
    Lanes x[3];
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

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
