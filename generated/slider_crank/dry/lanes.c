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
    Lanes omega_;
    Lanes c_;
    Lanes crank_mass_;
    Lanes crank_inertia_;
    Lanes rod_mass_;
    Lanes rod_inertia_;
    Lanes slider_mass_;
    Lanes slider_inertia_;
    Lanes crank_length_;
    Lanes rod_length_;
    Lanes alpha_;
    Lanes beta_;
    Lanes cylinder_axis_x_;
    Lanes pin_radius_;
    Lanes pin_clearance_;
    Lanes pin_length_;
    Lanes steel_E_;
    Lanes steel_nu_;
    Lanes dry_normal_restitution_;
    Lanes dry_normal_exponent_;
    Lanes dry_friction_mu_;
    Lanes dry_friction_v0_;
    Lanes dry_friction_v1_;
    Lanes velocity_floor_;
    Lanes guess_rod_theta_;
    Lanes guess_slider_x_;
    Lanes crank_head_s_x_;
    Lanes rod_head_s_x_;
    Lanes R_j_pin_;
    Lanes dry_pin_K_;
    Lanes dry_pin_hysteresis_;
    Lanes dry_pin_friction_slope_;
    Lanes rod_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes inverse_slider_mass_;
    Lanes crank_head_span_x_;
    Lanes rod_head_span_x_;
    Lanes inertia_crank_crank_;
    Lanes inertia_crank_rod_;
    Lanes inertia_rod_rod_;
    Lanes mass_motor_motor_;
    Lanes mass_rod_rod_;
    Lanes inverse_mass_rod_rod_;
    Lanes tree_metric_cylinder_slide_;
    Lanes tree_metric_rod_theta_;
    Lanes inverse_tree_metric_cylinder_slide_;
    Lanes inverse_tree_metric_rod_theta_;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius_;
    default:
        return all_of(0.0);
    }
}

/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 * exponent: exponent of the penetration; K: contact stiffness; hysteresis: hysteresis damping factor a.
 */
static inline void lankarani_nikravesh(Lanes delta, Lanes ratio, Lanes exponent, Lanes K, Lanes hysteresis,
    const Lanes *side, Lanes *g, int corner, Lanes *F_n_out)
{
    const Lanes side_1 = lanes_side_of(side, g, corner, hysteresis*ratio + 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    *F_n_out = lanes_pow(delta, exponent)*K*larger_1;
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 * mu: coefficient of friction; v0: slip below which there is no friction; friction_slope: 1/(v1 - v0).
 */
static inline void modified_coulomb(Lanes F_n, Lanes v_t, Lanes mu, Lanes v0, Lanes friction_slope, const Lanes *side,
    Lanes *g, int corner, Lanes *F_t_out)
{
    const Lanes side_1 = lanes_side_of(side, g, corner, -friction_slope*(-v0 - v_t) + 1.0);
    const Lanes smaller_1 = pick(side_1 < 0.0, all_of(1.0), friction_slope*(-v0 - v_t));
    const Lanes side_2 = lanes_side_of(side, g, corner + 1, smaller_1);
    const Lanes side_3 = lanes_side_of(side, g, corner + 2, -friction_slope*(-v0 + v_t) + 1.0);
    const Lanes smaller_2 = pick(side_3 < 0.0, all_of(1.0), friction_slope*(-v0 + v_t));
    const Lanes side_4 = lanes_side_of(side, g, corner + 3, smaller_2);
    const Lanes larger_1 = pick(side_2 < 0.0, all_of(0.0), smaller_1);
    const Lanes larger_2 = pick(side_4 < 0.0, all_of(0.0), smaller_2);
    *F_t_out = -F_n*mu*(-larger_1 + larger_2);
}

/* Dry contact in joint wristpin, as in clearance.c. */
static inline LanePinForce dry_wristpin_(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g)
{
    (void)side, (void)g;
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius_;
    const Lanes a_j = -0.5*delta + p->R_j_pin_;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent_, p->dry_pin_K_,
        p->dry_pin_hysteresis_, side, g, 0, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu_, p->dry_friction_v0_, p->dry_pin_friction_slope_, side, g, 1,
        &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint wristpin: what each lane does not have is passed over where no lane has it. */
static void clearance_wristpin_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance_;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    silence(g, 0, 5); /* what does not act does not switch */
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = is_touching(latch, delta);
    if (any_of(touching)) {
        Lanes film_g[N_SWITCHES];
        set_aside(g, film_g, 0, 5);
        LanePinForce dry = dry_wristpin_(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
        F.v_t = pick(touching, dry.v_t, F.v_t);
        put_together(g, film_g, 0, 5, touching, (LaneBits){0});
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
    /* corners: the sides that are held, if any */
    const Lanes *const side = held_sides(memory);
    Lanes *const g = told_sides(aside);

    /* coordinates, velocities, time */
    const Lanes cylinder_slide_ = q[0];
    const Lanes cylinder_slide_rate_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];

    /* directions, arms, drives */
    const Lanes motor_value_ = p->omega_*t;
    Lanes sines_0, cosines_0;
    sines_and_cosines(motor_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank_ = cosines_0;
    const Lanes sin_theta_crank_ = sines_0;
    const Lanes cos_theta_rod_ = cosines_1;
    const Lanes sin_theta_rod_ = sines_1;
    const Lanes motor_rate_ = p->omega_;
    const Lanes motor_acceleration_ = all_of(0.0);
    const Lanes slider_omega_ = all_of(0.0);
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const Lanes span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const Lanes crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const Lanes crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const Lanes span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const Lanes span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const Lanes rod_head_x_ = span_crank_head_x_ + span_rod_head_x_;
    const Lanes rod_head_vx_ = crank_head_vx_ - rod_omega_*span_rod_head_y_;
    const Lanes rod_head_y_ = span_crank_head_y_ + span_rod_head_y_;
    const Lanes rod_head_vy_ = crank_head_vy_ + rod_omega_*span_rod_head_x_;
    const Lanes cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const Lanes sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const Lanes dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const Lanes cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* clearance joint wristpin */
    const Lanes e_wristpin_x_ = cylinder_slide_ - rod_head_x_;
    const Lanes e_wristpin_y_ = -rod_head_y_;
    const Lanes edot_wristpin_x_ = cylinder_slide_rate_ - rod_head_vx_;
    const Lanes edot_wristpin_y_ = -rod_head_vy_;
    clearance_wristpin_(e_wristpin_x_, e_wristpin_y_, edot_wristpin_x_, edot_wristpin_y_, rod_omega_, slider_omega_,
        &memory->latch[0], p, side, g, &aside->clearance[0]);
    const Lanes F_wristpin_x_ = aside->clearance[0].Fx;
    const Lanes F_wristpin_y_ = aside->clearance[0].Fy;
    const Lanes M_wristpin_first_ = aside->clearance[0].moment_first;
    const Lanes M_wristpin_second_ = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_wristpin_x_*edot_wristpin_x_ + F_wristpin_y_*edot_wristpin_y_
        + M_wristpin_first_*rod_omega_ + M_wristpin_second_*slider_omega_;

    /* forward substitution */
    const Lanes z_rod_theta_ = F_wristpin_x_*span_rod_head_y_ - F_wristpin_y_*span_rod_head_x_ + M_wristpin_first_
        - cross_crank_rod_*(motor_rate_ * motor_rate_) - dot_crank_rod_*motor_acceleration_;

    /* backward substitution */
    const Lanes acceleration_rod_theta_ = p->inverse_mass_rod_rod_*z_rod_theta_;
    const Lanes acceleration_cylinder_slide_ = F_wristpin_x_*p->inverse_slider_mass_;

    /* results */
    a[0] = acceleration_cylinder_slide_;
    a[1] = acceleration_rod_theta_;
    aside->power[0] = motor_rate_*(-F_wristpin_x_*span_crank_head_y_ + F_wristpin_y_*span_crank_head_x_
        + a[1]*dot_crank_rod_ - cross_crank_rod_*(rod_omega_ * rod_omega_) + p->mass_motor_motor_*motor_acceleration_);
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
    const Lanes dq_acceleration_rod_theta_ = all_of(0.0);
    const Lanes dq_acceleration_cylinder_slide_ = all_of(0.0);

    /* backward substitution */
    const Lanes dv_acceleration_rod_theta_ = all_of(0.0);
    const Lanes dv_acceleration_cylinder_slide_ = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_cylinder_slide_;
    dv[0] = dv_acceleration_cylinder_slide_;
    dq[1] = dq_acceleration_rod_theta_;
    dv[1] = dv_acceleration_rod_theta_;
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
static inline void dry_slopes_lankarani_nikravesh_modified_coulomb(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i,
    Lanes omega_j, const LaneLatch *latch, Lanes exponent, Lanes mu, Lanes v0, Lanes R_i, Lanes R_j, Lanes c, Lanes K,
    Lanes hysteresis, Lanes friction_slope, const Lanes *side, Lanes *g, int corner, LaneSlopes *out)
{
    /* penetration, ratio of velocities, slip */
    const Lanes delta = e - c;
    const Lanes depth = lanes_max_of(delta, all_of(0.0));
    const Lanes depth_by_e_ = pick(delta > 0.0, all_of(1.0), all_of(0.0));
    const Lanes ratio = pick(latch->closed > 0.0, deltadot/latch->deltadot_minus, all_of(1.0));
    const Lanes ratio_by_deltadot_ = pick(latch->closed > 0.0, 1.0/latch->deltadot_minus, all_of(0.0));
    const Lanes a_i = 0.5*delta + R_i;
    const Lanes a_j = -0.5*delta + R_j;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const Lanes v_t_by_e_ = -0.5*omega_i - 0.5*omega_j;

    /* contact */
    const Lanes side_1 = lanes_side_of(side, g, corner, hysteresis*ratio + 1.0);
    const Lanes power_depth_ = lanes_pow(depth, exponent - 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    const Lanes F_n = depth*K*power_depth_*larger_1;
    const Lanes F_n_by_depth_ = exponent*K*power_depth_*larger_1;
    const Lanes branch_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis);
    const Lanes F_n_by_ratio_ = depth*K*power_depth_*branch_1;
    const Lanes F_n_by_e_ = F_n_by_depth_*depth_by_e_;
    const Lanes F_n_by_deltadot_ = F_n_by_ratio_*ratio_by_deltadot_;
    const Lanes side_2 = lanes_side_of(side, g, corner + 1, -friction_slope*(-v0 - v_t) + 1.0);
    const Lanes smaller_1 = pick(side_2 < 0.0, all_of(1.0), friction_slope*(-v0 - v_t));
    const Lanes side_3 = lanes_side_of(side, g, corner + 2, smaller_1);
    const Lanes side_4 = lanes_side_of(side, g, corner + 3, -friction_slope*(-v0 + v_t) + 1.0);
    const Lanes smaller_2 = pick(side_4 < 0.0, all_of(1.0), friction_slope*(-v0 + v_t));
    const Lanes side_5 = lanes_side_of(side, g, corner + 4, smaller_2);
    const Lanes larger_2 = pick(side_3 < 0.0, all_of(0.0), smaller_1);
    const Lanes larger_3 = pick(side_5 < 0.0, all_of(0.0), smaller_2);
    const Lanes F_t = -F_n*mu*(-larger_2 + larger_3);
    const Lanes F_t_by_F_n_ = -mu*(-larger_2 + larger_3);
    const Lanes branch_2 = pick(side_2 < 0.0, all_of(0.0), -friction_slope);
    const Lanes branch_3 = pick(side_3 < 0.0, all_of(0.0), branch_2);
    const Lanes branch_4 = pick(side_4 < 0.0, all_of(0.0), friction_slope);
    const Lanes branch_5 = pick(side_5 < 0.0, all_of(0.0), branch_4);
    const Lanes F_t_by_v_t_ = -F_n*mu*(-branch_3 + branch_5);
    const Lanes F_t_by_e_ = F_n_by_e_*F_t_by_F_n_ + F_t_by_v_t_*v_t_by_e_;
    const Lanes F_t_by_deltadot_ = F_n_by_deltadot_*F_t_by_F_n_;
    const Lanes F_t_by_omega_i_ = -F_t_by_v_t_*a_i;
    const Lanes F_t_by_omega_j_ = F_t_by_v_t_*a_j;
    const Lanes F_along_t_dry = F_t;
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_i_dry_by_e_ = -0.5*F_along_t_dry - F_t_by_e_*a_i;
    const Lanes M_i_dry_by_deltadot_ = -F_t_by_deltadot_*a_i;
    const Lanes M_i_dry_by_de_t_ = -F_t_by_v_t_*a_i;
    const Lanes M_i_dry_by_omega_i_ = -F_t_by_omega_i_*a_i;
    const Lanes M_i_dry_by_omega_j_ = -F_t_by_omega_j_*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    const Lanes M_j_dry_by_e_ = -0.5*F_along_t_dry + F_t_by_e_*a_j;
    const Lanes M_j_dry_by_deltadot_ = F_t_by_deltadot_*a_j;
    const Lanes M_j_dry_by_de_t_ = F_t_by_v_t_*a_j;
    const Lanes M_j_dry_by_omega_i_ = F_t_by_omega_i_*a_j;
    const Lanes M_j_dry_by_omega_j_ = F_t_by_omega_j_*a_j;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e_;
    out->slope[0][1] = -F_n_by_deltadot_;
    out->slope[0][2] = all_of(0.0);
    out->slope[0][3] = all_of(0.0);
    out->slope[0][4] = all_of(0.0);
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

/* Joint wristpin, as in newton.c: what acts in no lane is passed over. */
static void slopes_wristpin_(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
    const LaneParameters *p, const Lanes *side, Lanes *g, LaneSlopes *out)
{
    (void)p, (void)side, (void)g;
    *out = (LaneSlopes){0};
    const LaneBits touching = is_closed(latch);
    if (any_of(touching)) {
        LaneSlopes dry;
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent_, p->dry_friction_mu_, p->dry_friction_v0_, p->pin_radius_, p->R_j_pin_,
            p->pin_clearance_, p->dry_pin_K_, p->dry_pin_hysteresis_, p->dry_pin_friction_slope_, side, g, 0, &dry);
        pick_slopes(out, touching, &dry);
    }
}

static void tangent_wristpin_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->pin_clearance_);
    slopes_wristpin_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_wristpin_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_wristpin_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    (void)rare;
    /* corners: the sides that are held, if any */
    const Lanes *const side = held_sides(memory);
    Lanes g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const Lanes cylinder_slide_ = q[0];
    const Lanes cylinder_slide_rate_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];
    const Lanes a_rod_theta_ = a[1];
    const Lanes wristpin_Fx_ = aside->clearance[0].Fx;
    const Lanes wristpin_Fy_ = aside->clearance[0].Fy;
    const Lanes wristpin_moment_first_ = aside->clearance[0].moment_first;

    /* directions, arms, drives */
    const Lanes motor_value_ = p->omega_*t;
    const Lanes motor_rate_ = p->omega_;
    const Lanes motor_acceleration_ = all_of(0.0);
    const Lanes cos_theta_crank_ = lanes_cos(motor_value_);
    const Lanes sin_theta_crank_ = lanes_sin(motor_value_);
    const Lanes cos_theta_rod_ = lanes_cos(rod_theta_);
    const Lanes sin_theta_rod_ = lanes_sin(rod_theta_);
    const Lanes slider_omega_ = all_of(0.0);
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_head_span_x_;
    const Lanes span_crank_head_y_ = p->crank_head_span_x_*sin_theta_crank_;
    const Lanes crank_head_vx_ = -motor_rate_*span_crank_head_y_;
    const Lanes crank_head_vy_ = motor_rate_*span_crank_head_x_;
    const Lanes span_rod_head_x_ = cos_theta_rod_*p->rod_head_span_x_;
    const Lanes span_rod_head_y_ = p->rod_head_span_x_*sin_theta_rod_;
    const Lanes rod_head_x_ = span_crank_head_x_ + span_rod_head_x_;
    const Lanes rod_head_vx_ = crank_head_vx_ - rod_omega_*span_rod_head_y_;
    const Lanes rod_head_y_ = span_crank_head_y_ + span_rod_head_y_;
    const Lanes rod_head_vy_ = crank_head_vy_ + rod_omega_*span_rod_head_x_;
    const Lanes cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const Lanes sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const Lanes dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const Lanes cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* clearance joint wristpin */
    const Lanes e_wristpin_x_ = cylinder_slide_ - rod_head_x_;
    const Lanes e_wristpin_y_ = -rod_head_y_;
    const Lanes edot_wristpin_x_ = cylinder_slide_rate_ - rod_head_vx_;
    const Lanes edot_wristpin_y_ = -rod_head_vy_;
    Lanes change_wristpin_[4][6];
    tangent_wristpin_(e_wristpin_x_, e_wristpin_y_, edot_wristpin_x_, edot_wristpin_y_, rod_omega_, slider_omega_,
        &memory->latch[0], p, side, g, change_wristpin_);
    const Lanes rod_head_x_2_by_time_ = -motor_rate_*span_crank_head_y_;
    const Lanes rod_head_y_by_time_ = motor_rate_*span_crank_head_x_;
    const Lanes rod_head_vx_by_rod_theta_ = -rod_omega_*span_rod_head_x_;
    const Lanes rod_head_vx_by_time_ = -motor_acceleration_*span_crank_head_y_
        - (motor_rate_ * motor_rate_)*span_crank_head_x_;
    const Lanes rod_head_vy_by_rod_theta_ = -rod_omega_*span_rod_head_y_;
    const Lanes rod_head_vy_by_time_ = motor_acceleration_*span_crank_head_x_
        - (motor_rate_ * motor_rate_)*span_crank_head_y_;
    const Lanes wristpin_Fx_by_e_x_ = change_wristpin_[0][0];
    const Lanes wristpin_Fx_by_e_y_ = change_wristpin_[0][1];
    const Lanes wristpin_Fx_by_de_x_ = change_wristpin_[0][2];
    const Lanes wristpin_Fx_by_de_y_ = change_wristpin_[0][3];
    const Lanes wristpin_Fx_by_omega_i_ = change_wristpin_[0][4];
    const Lanes wristpin_Fx_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_Fx_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_Fx_by_de_y_ - span_rod_head_x_*wristpin_Fx_by_e_y_
        + span_rod_head_y_*wristpin_Fx_by_e_x_;
    const Lanes wristpin_Fx_by_time_ = -rod_head_vx_by_time_*wristpin_Fx_by_de_x_
        - rod_head_vy_by_time_*wristpin_Fx_by_de_y_ - rod_head_x_2_by_time_*wristpin_Fx_by_e_x_
        - rod_head_y_by_time_*wristpin_Fx_by_e_y_;
    const Lanes wristpin_Fx_by_rod_omega_ = -span_rod_head_x_*wristpin_Fx_by_de_y_
        + span_rod_head_y_*wristpin_Fx_by_de_x_ + wristpin_Fx_by_omega_i_;
    const Lanes wristpin_Fy_by_e_x_ = change_wristpin_[1][0];
    const Lanes wristpin_Fy_by_e_y_ = change_wristpin_[1][1];
    const Lanes wristpin_Fy_by_de_x_ = change_wristpin_[1][2];
    const Lanes wristpin_Fy_by_de_y_ = change_wristpin_[1][3];
    const Lanes wristpin_Fy_by_omega_i_ = change_wristpin_[1][4];
    const Lanes wristpin_Fy_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_Fy_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_Fy_by_de_y_ - span_rod_head_x_*wristpin_Fy_by_e_y_
        + span_rod_head_y_*wristpin_Fy_by_e_x_;
    const Lanes wristpin_Fy_by_time_ = -rod_head_vx_by_time_*wristpin_Fy_by_de_x_
        - rod_head_vy_by_time_*wristpin_Fy_by_de_y_ - rod_head_x_2_by_time_*wristpin_Fy_by_e_x_
        - rod_head_y_by_time_*wristpin_Fy_by_e_y_;
    const Lanes wristpin_Fy_by_rod_omega_ = -span_rod_head_x_*wristpin_Fy_by_de_y_
        + span_rod_head_y_*wristpin_Fy_by_de_x_ + wristpin_Fy_by_omega_i_;
    const Lanes wristpin_moment_first_by_e_x_ = change_wristpin_[2][0];
    const Lanes wristpin_moment_first_by_e_y_ = change_wristpin_[2][1];
    const Lanes wristpin_moment_first_by_de_x_ = change_wristpin_[2][2];
    const Lanes wristpin_moment_first_by_de_y_ = change_wristpin_[2][3];
    const Lanes wristpin_moment_first_by_omega_i_ = change_wristpin_[2][4];
    const Lanes wristpin_moment_first_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_moment_first_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_moment_first_by_de_y_ - span_rod_head_x_*wristpin_moment_first_by_e_y_
        + span_rod_head_y_*wristpin_moment_first_by_e_x_;
    const Lanes wristpin_moment_first_by_time_ = -rod_head_vx_by_time_*wristpin_moment_first_by_de_x_
        - rod_head_vy_by_time_*wristpin_moment_first_by_de_y_ - rod_head_x_2_by_time_*wristpin_moment_first_by_e_x_
        - rod_head_y_by_time_*wristpin_moment_first_by_e_y_;
    const Lanes wristpin_moment_first_by_rod_omega_ = -span_rod_head_x_*wristpin_moment_first_by_de_y_
        + span_rod_head_y_*wristpin_moment_first_by_de_x_ + wristpin_moment_first_by_omega_i_;
    const Lanes wristpin_moment_second_by_e_x_ = change_wristpin_[3][0];
    const Lanes wristpin_moment_second_by_e_y_ = change_wristpin_[3][1];
    const Lanes wristpin_moment_second_by_de_x_ = change_wristpin_[3][2];
    const Lanes wristpin_moment_second_by_de_y_ = change_wristpin_[3][3];
    const Lanes wristpin_moment_second_by_omega_i_ = change_wristpin_[3][4];
    const Lanes wristpin_moment_second_by_rod_theta_ = -rod_head_vx_by_rod_theta_*wristpin_moment_second_by_de_x_
        - rod_head_vy_by_rod_theta_*wristpin_moment_second_by_de_y_ - span_rod_head_x_*wristpin_moment_second_by_e_y_
        + span_rod_head_y_*wristpin_moment_second_by_e_x_;
    const Lanes wristpin_moment_second_by_time_ = -rod_head_vx_by_time_*wristpin_moment_second_by_de_x_
        - rod_head_vy_by_time_*wristpin_moment_second_by_de_y_ - rod_head_x_2_by_time_*wristpin_moment_second_by_e_x_
        - rod_head_y_by_time_*wristpin_moment_second_by_e_y_;
    const Lanes wristpin_moment_second_by_rod_omega_ = -span_rod_head_x_*wristpin_moment_second_by_de_y_
        + span_rod_head_y_*wristpin_moment_second_by_de_x_ + wristpin_moment_second_by_omega_i_;

    /* coordinates */
    const Lanes cross_crank_rod_by_time_ = -dot_crank_rod_*motor_rate_;
    const Lanes dot_crank_rod_by_time_ = cross_crank_rod_*motor_rate_;

    /* powers */
    const Lanes span_crank_head_x_by_time_ = -motor_rate_*span_crank_head_y_;
    const Lanes span_crank_head_y_by_time_ = motor_rate_*span_crank_head_x_;

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
static void newton_factor(Lanes eta, LaneLinear *lin, LaneBits *rare)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes by_q_cylinder_slide_cylinder_slide_ = lin->value[0];
    const Lanes by_q_cylinder_slide_rod_theta_ = lin->value[1];
    const Lanes by_q_rod_theta_rod_theta_ = lin->value[2];
    const Lanes by_q_rod_theta_cylinder_slide_ = lin->value[3];
    const Lanes by_v_cylinder_slide_cylinder_slide_ = lin->value[4];
    const Lanes by_v_cylinder_slide_rod_theta_ = lin->value[5];
    const Lanes by_v_rod_theta_cylinder_slide_ = lin->value[6];
    const Lanes by_v_rod_theta_rod_theta_ = lin->value[7];

    /* matrix */
    const Lanes n_cylinder_slide_cylinder_slide_ = eta*(by_q_cylinder_slide_cylinder_slide_*eta
        + by_v_cylinder_slide_cylinder_slide_) + p->slider_mass_;
    const Lanes n_cylinder_slide_rod_theta_ = eta*(by_q_cylinder_slide_rod_theta_*eta + by_v_cylinder_slide_rod_theta_);
    const Lanes n_rod_theta_cylinder_slide_ = eta*(by_q_rod_theta_cylinder_slide_*eta + by_v_rod_theta_cylinder_slide_);
    const Lanes n_rod_theta_rod_theta_ = eta*(by_q_rod_theta_rod_theta_*eta + by_v_rod_theta_rod_theta_)
        + p->mass_rod_rod_;

    /* L U */
    const Lanes scale_cylinder_slide_ = n_cylinder_slide_cylinder_slide_;
    *rare |= ~(lanes_fabs(scale_cylinder_slide_) > SINGULAR * lanes_fabs(n_cylinder_slide_cylinder_slide_));
    const Lanes inverse_pivot_cylinder_slide_ = 1.0/scale_cylinder_slide_;
    lin->lu[0] = inverse_pivot_cylinder_slide_;
    const Lanes l_rod_theta_cylinder_slide_ = inverse_pivot_cylinder_slide_*n_rod_theta_cylinder_slide_;
    lin->lu[1] = l_rod_theta_cylinder_slide_;
    lin->lu[2] = n_cylinder_slide_rod_theta_;
    const Lanes scale_rod_theta_ = -l_rod_theta_cylinder_slide_*n_cylinder_slide_rod_theta_ + n_rod_theta_rod_theta_;
    *rare |= ~(lanes_fabs(scale_rod_theta_) > SINGULAR * lanes_fabs(n_rod_theta_rod_theta_));
    const Lanes inverse_pivot_rod_theta_ = 1.0/scale_rod_theta_;
    lin->lu[3] = inverse_pivot_rod_theta_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes inverse_pivot_cylinder_slide_ = lin->lu[0];
    const Lanes l_rod_theta_cylinder_slide_ = lin->lu[1];
    const Lanes n_cylinder_slide_rod_theta_ = lin->lu[2];
    const Lanes inverse_pivot_rod_theta_ = lin->lu[3];

    /* forward */
    const Lanes b_cylinder_slide_ = x[0];
    const Lanes b_rod_theta_ = -b_cylinder_slide_*l_rod_theta_cylinder_slide_ + x[1];

    /* backward */
    const Lanes x_rod_theta_ = b_rod_theta_*inverse_pivot_rod_theta_;
    x[1] = x_rod_theta_;
    const Lanes x_cylinder_slide_ = inverse_pivot_cylinder_slide_*(b_cylinder_slide_
        - n_cylinder_slide_rod_theta_*x_rod_theta_);
    x[0] = x_cylinder_slide_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes by_q_cylinder_slide_cylinder_slide_ = lin->value[0];
    const Lanes by_q_cylinder_slide_rod_theta_ = lin->value[1];
    const Lanes by_q_rod_theta_rod_theta_ = lin->value[2];
    const Lanes by_q_rod_theta_cylinder_slide_ = lin->value[3];
    const Lanes by_t_cylinder_slide_ = lin->value[8];
    const Lanes by_t_rod_theta_ = lin->value[9];
    const Lanes power_q_0_rod_theta_ = lin->value[10];
    const Lanes power_q_0_cylinder_slide_ = lin->value[11];
    const Lanes power_q_2_rod_theta_ = lin->value[12];
    const Lanes power_q_2_cylinder_slide_ = lin->value[13];
    const Lanes power_v_0_rod_theta_ = lin->value[14];
    const Lanes power_v_0_cylinder_slide_ = lin->value[15];
    const Lanes power_v_2_cylinder_slide_ = lin->value[16];
    const Lanes power_v_2_rod_theta_ = lin->value[17];
    const Lanes power_0_rod_theta_ = lin->value[18];
    const Lanes power_t_0_ = lin->value[19];
    const Lanes power_t_2_ = lin->value[20];

    /* right-hand side */
    Lanes x[2];
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

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
