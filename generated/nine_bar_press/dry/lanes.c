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
    Lanes omega4_;
    Lanes l5_;
    Lanes c_;
    Lanes L1_mass_;
    Lanes L1_inertia_;
    Lanes L2_mass_;
    Lanes L2_inertia_;
    Lanes L3_mass_;
    Lanes L3_inertia_;
    Lanes L4_mass_;
    Lanes L4_inertia_;
    Lanes L6_mass_;
    Lanes L6_inertia_;
    Lanes L7_mass_;
    Lanes L7_inertia_;
    Lanes L8_mass_;
    Lanes L8_inertia_;
    Lanes S9_mass_;
    Lanes S9_inertia_;
    Lanes L1_length_;
    Lanes L2_length_;
    Lanes L3_length_;
    Lanes L4_length_;
    Lanes L6_length_;
    Lanes L7_length_;
    Lanes L8_length_;
    Lanes alpha_;
    Lanes beta_;
    Lanes O4_y_;
    Lanes O6_x_;
    Lanes guide_axis_y_;
    Lanes pin_radius_;
    Lanes pin_clearance_;
    Lanes pin_length_;
    Lanes aluminium_E_;
    Lanes pin_bearing_material_E_;
    Lanes aluminium_nu_;
    Lanes pin_bearing_material_nu_;
    Lanes pin_journal_material_E_;
    Lanes pin_journal_material_nu_;
    Lanes dry_normal_restitution_;
    Lanes dry_normal_exponent_;
    Lanes dry_friction_mu_;
    Lanes dry_friction_v0_;
    Lanes dry_friction_v1_;
    Lanes velocity_floor_;
    Lanes gravity_y_;
    Lanes steel_45_E_;
    Lanes steel_45_nu_;
    Lanes pin_bearing_material_;
    Lanes pin_journal_material_;
    Lanes guess_L2_theta_;
    Lanes guess_L3_theta_;
    Lanes guess_L6_theta_;
    Lanes guess_L7_theta_;
    Lanes guess_L8_theta_;
    Lanes L1_head_s_x_;
    Lanes L2_head_s_x_;
    Lanes L3_head_s_x_;
    Lanes L4_head_s_x_;
    Lanes L6_head_s_x_;
    Lanes L7_head_s_x_;
    Lanes L8_head_s_x_;
    Lanes R_j_pin_;
    Lanes dry_pin_K_;
    Lanes dry_pin_hysteresis_;
    Lanes dry_pin_friction_slope_;
    Lanes weight_L1_y_;
    Lanes weight_L2_y_;
    Lanes weight_L3_y_;
    Lanes weight_L4_y_;
    Lanes weight_L6_y_;
    Lanes weight_L7_y_;
    Lanes weight_L8_y_;
    Lanes weight_S9_y_;
    Lanes L2_turning_;
    Lanes L3_turning_;
    Lanes L6_turning_;
    Lanes L7_turning_;
    Lanes L8_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes mobility_guide_offset_;
    Lanes L6_head_span_x_;
    Lanes L7_com_span_x_;
    Lanes L7_tail_span_x_;
    Lanes L2_com_span_x_;
    Lanes L3_com_span_x_;
    Lanes L8_head_span_x_;
    Lanes L1_head_span_x_;
    Lanes L2_tail_span_x_;
    Lanes L4_head_span_x_;
    Lanes L3_tail_span_x_;
    Lanes inertia_L1_L1_;
    Lanes inertia_L6_L6_;
    Lanes inertia_L6_L7_;
    Lanes inertia_L6_L2_;
    Lanes inertia_L7_L7_;
    Lanes inertia_L7_L2_;
    Lanes inertia_L2_L2_;
    Lanes inertia_L6_L3_;
    Lanes inertia_L7_L3_;
    Lanes inertia_L3_L3_;
    Lanes inertia_L4_L4_;
    Lanes inertia_L6_L8_;
    Lanes inertia_L8_L8_;
    Lanes mass_crank1_crank1_;
    Lanes mass_L6_L6_;
    Lanes mass_L7_L7_;
    Lanes mass_L2_L2_;
    Lanes mass_L3_L3_;
    Lanes mass_crank4_crank4_;
    Lanes mass_L8_L8_;
    Lanes weight_L1_across_;
    Lanes weight_L6_across_;
    Lanes weight_L7_across_;
    Lanes weight_L2_across_;
    Lanes weight_L3_across_;
    Lanes weight_L4_across_;
    Lanes weight_L8_across_;
    Lanes inverse_mass_L8_L8_;
    Lanes inverse_mass_L2_L2_;
    Lanes tree_metric_L6_theta_;
    Lanes tree_metric_L7_theta_;
    Lanes tree_metric_L8_theta_;
    Lanes tree_metric_L2_theta_;
    Lanes tree_metric_L3_theta_;
    Lanes inverse_tree_metric_L8_theta_;
    Lanes inverse_tree_metric_L2_theta_;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius_;
    case 1:
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

/* Dry contact in joint A, as in clearance.c. */
static inline LanePinForce dry_A_(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
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

/* Joint A: what each lane does not have is passed over where no lane has it. */
static void clearance_A_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
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
        LanePinForce dry = dry_A_(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
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

/* Dry contact in joint B, as in clearance.c. */
static inline LanePinForce dry_B_(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g)
{
    (void)side, (void)g;
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius_;
    const Lanes a_j = -0.5*delta + p->R_j_pin_;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent_, p->dry_pin_K_,
        p->dry_pin_hysteresis_, side, g, 5, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu_, p->dry_friction_v0_, p->dry_pin_friction_slope_, side, g, 6,
        &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint B: what each lane does not have is passed over where no lane has it. */
static void clearance_B_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance_;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    silence(g, 5, 10); /* what does not act does not switch */
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = is_touching(latch, delta);
    if (any_of(touching)) {
        Lanes film_g[N_SWITCHES];
        set_aside(g, film_g, 5, 10);
        LanePinForce dry = dry_B_(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
        F.v_t = pick(touching, dry.v_t, F.v_t);
        put_together(g, film_g, 5, 10, touching, (LaneBits){0});
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
    (void)t;
    /* coordinates, velocities, time */
    const Lanes L6_theta_ = q[0];
    const Lanes L8_theta_ = q[2];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L8_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_L6_ = cosines_0;
    const Lanes cos_theta_L8_ = cosines_1;
    const Lanes span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const Lanes span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;

    /* rows */
    out[0] = -span_L6_head_x_ - span_L8_head_x_;  /* guide.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes L6_theta_ = q[0];
    const Lanes L6_omega_ = v[0];
    const Lanes L8_theta_ = q[2];
    const Lanes L8_omega_ = v[2];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L8_theta_, &sines_1, &cosines_1, rare);
    const Lanes sin_theta_L6_ = sines_0;
    const Lanes sin_theta_L8_ = sines_1;
    const Lanes span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const Lanes span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;

    /* rows */
    out[0] = L6_omega_*span_L6_head_y_ + L8_omega_*span_L8_head_y_;  /* guide.offset */
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
    const Lanes L6_theta_ = q[0];
    const Lanes L6_omega_ = v[0];
    const Lanes L7_theta_ = q[1];
    const Lanes L7_omega_ = v[1];
    const Lanes L8_theta_ = q[2];
    const Lanes L8_omega_ = v[2];
    const Lanes L2_theta_ = q[3];
    const Lanes L2_omega_ = v[3];
    const Lanes L3_theta_ = q[4];
    const Lanes L3_omega_ = v[4];

    /* directions, arms, drives */
    const Lanes crank1_value_ = p->omega_*t - 0.689754120388159;
    const Lanes crank4_value_ = p->omega4_*t + 3.4814082589530893;
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank1_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank4_value_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(L6_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(L7_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(L8_theta_, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(L2_theta_, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(L3_theta_, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_L1_ = cosines_0;
    const Lanes sin_theta_L1_ = sines_0;
    const Lanes cos_theta_L4_ = cosines_1;
    const Lanes sin_theta_L4_ = sines_1;
    const Lanes cos_theta_L6_ = cosines_2;
    const Lanes sin_theta_L6_ = sines_2;
    const Lanes cos_theta_L7_ = cosines_3;
    const Lanes sin_theta_L7_ = sines_3;
    const Lanes cos_theta_L8_ = cosines_4;
    const Lanes sin_theta_L8_ = sines_4;
    const Lanes cos_theta_L2_ = cosines_5;
    const Lanes sin_theta_L2_ = sines_5;
    const Lanes cos_theta_L3_ = cosines_6;
    const Lanes sin_theta_L3_ = sines_6;
    const Lanes crank1_rate_ = p->omega_;
    const Lanes crank1_acceleration_ = all_of(0.0);
    const Lanes crank4_rate_ = p->omega4_;
    const Lanes crank4_acceleration_ = all_of(0.0);
    const Lanes span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const Lanes span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const Lanes L6_head_x_ = p->O6_x_ + span_L6_head_x_;
    const Lanes L6_head_vx_ = -L6_omega_*span_L6_head_y_;
    const Lanes L6_head_vy_ = L6_omega_*span_L6_head_x_;
    const Lanes span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const Lanes span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;
    const Lanes L7_tail_x_ = L6_head_x_ + span_L7_tail_x_;
    const Lanes L7_tail_vx_ = L6_head_vx_ - L7_omega_*span_L7_tail_y_;
    const Lanes L7_tail_y_ = span_L6_head_y_ + span_L7_tail_y_;
    const Lanes L7_tail_vy_ = L6_head_vy_ + L7_omega_*span_L7_tail_x_;
    const Lanes span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const Lanes span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const Lanes span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const Lanes span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const Lanes L1_head_vx_ = -crank1_rate_*span_L1_head_y_;
    const Lanes L1_head_vy_ = crank1_rate_*span_L1_head_x_;
    const Lanes span_L2_tail_x_ = p->L2_tail_span_x_*cos_theta_L2_;
    const Lanes span_L2_tail_y_ = p->L2_tail_span_x_*sin_theta_L2_;
    const Lanes L2_tail_x_ = L7_tail_x_ + span_L2_tail_x_;
    const Lanes L2_tail_vx_ = -L2_omega_*span_L2_tail_y_ + L7_tail_vx_;
    const Lanes L2_tail_y_ = L7_tail_y_ + span_L2_tail_y_;
    const Lanes L2_tail_vy_ = L2_omega_*span_L2_tail_x_ + L7_tail_vy_;
    const Lanes span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const Lanes span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const Lanes L4_head_vx_ = -crank4_rate_*span_L4_head_y_;
    const Lanes L4_head_y_ = p->O4_y_ + span_L4_head_y_;
    const Lanes L4_head_vy_ = crank4_rate_*span_L4_head_x_;
    const Lanes span_L3_tail_x_ = p->L3_tail_span_x_*cos_theta_L3_;
    const Lanes span_L3_tail_y_ = p->L3_tail_span_x_*sin_theta_L3_;
    const Lanes L3_tail_x_ = L7_tail_x_ + span_L3_tail_x_;
    const Lanes L3_tail_vx_ = -L3_omega_*span_L3_tail_y_ + L7_tail_vx_;
    const Lanes L3_tail_y_ = L7_tail_y_ + span_L3_tail_y_;
    const Lanes L3_tail_vy_ = L3_omega_*span_L3_tail_x_ + L7_tail_vy_;
    const Lanes cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const Lanes sin_L7_less_L6_ = cos_theta_L6_*sin_theta_L7_ - cos_theta_L7_*sin_theta_L6_;
    const Lanes dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const Lanes cross_L6_L7_ = p->inertia_L6_L7_*sin_L7_less_L6_;
    const Lanes cos_L2_less_L6_ = cos_theta_L2_*cos_theta_L6_ + sin_theta_L2_*sin_theta_L6_;
    const Lanes sin_L2_less_L6_ = -cos_theta_L2_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L2_;
    const Lanes dot_L6_L2_ = cos_L2_less_L6_*p->inertia_L6_L2_;
    const Lanes cross_L6_L2_ = p->inertia_L6_L2_*sin_L2_less_L6_;
    const Lanes cos_L2_less_L7_ = cos_theta_L2_*cos_theta_L7_ + sin_theta_L2_*sin_theta_L7_;
    const Lanes sin_L2_less_L7_ = -cos_theta_L2_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L2_;
    const Lanes dot_L7_L2_ = cos_L2_less_L7_*p->inertia_L7_L2_;
    const Lanes cross_L7_L2_ = p->inertia_L7_L2_*sin_L2_less_L7_;
    const Lanes cos_L3_less_L6_ = cos_theta_L3_*cos_theta_L6_ + sin_theta_L3_*sin_theta_L6_;
    const Lanes sin_L3_less_L6_ = -cos_theta_L3_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L3_;
    const Lanes dot_L6_L3_ = cos_L3_less_L6_*p->inertia_L6_L3_;
    const Lanes cross_L6_L3_ = p->inertia_L6_L3_*sin_L3_less_L6_;
    const Lanes cos_L3_less_L7_ = cos_theta_L3_*cos_theta_L7_ + sin_theta_L3_*sin_theta_L7_;
    const Lanes sin_L3_less_L7_ = -cos_theta_L3_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L3_;
    const Lanes dot_L7_L3_ = cos_L3_less_L7_*p->inertia_L7_L3_;
    const Lanes cross_L7_L3_ = p->inertia_L7_L3_*sin_L3_less_L7_;
    const Lanes cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const Lanes sin_L8_less_L6_ = cos_theta_L6_*sin_theta_L8_ - cos_theta_L8_*sin_theta_L6_;
    const Lanes dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;
    const Lanes cross_L6_L8_ = p->inertia_L6_L8_*sin_L8_less_L6_;

    /* clearance joint A */
    const Lanes e_A_x_ = L2_tail_x_ - span_L1_head_x_;
    const Lanes e_A_y_ = L2_tail_y_ - span_L1_head_y_;
    const Lanes edot_A_x_ = -L1_head_vx_ + L2_tail_vx_;
    const Lanes edot_A_y_ = -L1_head_vy_ + L2_tail_vy_;
    clearance_A_(e_A_x_, e_A_y_, edot_A_x_, edot_A_y_, crank1_rate_, L2_omega_, &memory->latch[0], p, side, g,
        &aside->clearance[0]);
    const Lanes F_A_x_ = aside->clearance[0].Fx;
    const Lanes F_A_y_ = aside->clearance[0].Fy;
    const Lanes M_A_first_ = aside->clearance[0].moment_first;
    const Lanes M_A_second_ = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_A_x_*edot_A_x_ + F_A_y_*edot_A_y_ + L2_omega_*M_A_second_ + M_A_first_*crank1_rate_;

    /* clearance joint B */
    const Lanes e_B_x_ = L3_tail_x_ - span_L4_head_x_;
    const Lanes e_B_y_ = L3_tail_y_ - L4_head_y_;
    const Lanes edot_B_x_ = L3_tail_vx_ - L4_head_vx_;
    const Lanes edot_B_y_ = L3_tail_vy_ - L4_head_vy_;
    clearance_B_(e_B_x_, e_B_y_, edot_B_x_, edot_B_y_, crank4_rate_, L3_omega_, &memory->latch[1], p, side, g,
        &aside->clearance[1]);
    const Lanes F_B_x_ = aside->clearance[1].Fx;
    const Lanes F_B_y_ = aside->clearance[1].Fy;
    const Lanes M_B_first_ = aside->clearance[1].moment_first;
    const Lanes M_B_second_ = aside->clearance[1].moment_second;
    aside->clearance[1].power = F_B_x_*edot_B_x_ + F_B_y_*edot_B_y_ + L3_omega_*M_B_second_ + M_B_first_*crank4_rate_;

    /* constraints: gamma */
    const Lanes rhs_guide_offset_ = -(L6_omega_ * L6_omega_)*span_L6_head_x_ - (L8_omega_ * L8_omega_)*span_L8_head_x_;

    /* L D L^T of the KKT matrix */
    *rare |= ~(p->mass_L8_L8_ > LIGHT_PIVOT * p->L8_turning_);
    const Lanes l_L6_theta_L8_theta_ = dot_L6_L8_*p->inverse_mass_L8_L8_;
    const Lanes l_guide_offset_L8_theta_ = p->inverse_mass_L8_L8_*span_L8_head_y_;
    *rare |= ~(p->mass_L2_L2_ > LIGHT_PIVOT * p->L2_turning_);
    const Lanes l_L7_theta_L2_theta_ = dot_L7_L2_*p->inverse_mass_L2_L2_;
    const Lanes l_L6_theta_L2_theta_ = dot_L6_L2_*p->inverse_mass_L2_L2_;
    const Lanes pivot_L7_theta_ = -dot_L7_L2_*l_L7_theta_L2_theta_ + p->mass_L7_L7_;
    const Lanes determinant_L7_theta_L3_theta_ = -(dot_L7_L3_ * dot_L7_L3_) + p->mass_L3_L3_*pivot_L7_theta_;
    *rare |= ~(pivot_L7_theta_ > LIGHT_PIVOT * p->L7_turning_);
    *rare |= ~(determinant_L7_theta_L3_theta_ > LIGHT_PIVOT * p->L3_turning_ * pivot_L7_theta_);
    const Lanes inverse_L7_theta_L3_theta_ = 1.0/determinant_L7_theta_L3_theta_;
    const Lanes inverse_pivot_L7_theta_ = inverse_L7_theta_L3_theta_*p->mass_L3_L3_;
    const Lanes inverse_pivot_L3_theta_ = inverse_L7_theta_L3_theta_*pivot_L7_theta_;
    const Lanes inverse_cross_L7_theta_L3_theta_ = -dot_L7_L3_*inverse_L7_theta_L3_theta_;
    const Lanes w_L6_theta_L7_theta_ = dot_L6_L7_ - dot_L7_L2_*l_L6_theta_L2_theta_;
    const Lanes l_L6_theta_L7_theta_ = dot_L6_L3_*inverse_cross_L7_theta_L3_theta_
        + inverse_pivot_L7_theta_*w_L6_theta_L7_theta_;
    const Lanes l_L6_theta_L3_theta_ = dot_L6_L3_*inverse_pivot_L3_theta_
        + inverse_cross_L7_theta_L3_theta_*w_L6_theta_L7_theta_;
    const Lanes pivot_L6_theta_ = -dot_L6_L2_*l_L6_theta_L2_theta_ - dot_L6_L3_*l_L6_theta_L3_theta_
        - dot_L6_L8_*l_L6_theta_L8_theta_ - l_L6_theta_L7_theta_*w_L6_theta_L7_theta_ + p->mass_L6_L6_;
    *rare |= ~(pivot_L6_theta_ > LIGHT_PIVOT * p->L6_turning_);
    const Lanes inverse_pivot_L6_theta_ = 1.0/pivot_L6_theta_;
    const Lanes w_guide_offset_L6_theta_ = -dot_L6_L8_*l_guide_offset_L8_theta_ + span_L6_head_y_;
    const Lanes l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const Lanes scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L8_theta_*span_L8_head_y_;
    *rare |= ~((scale_guide_offset_ > 0.0) & (scale_guide_offset_ < INFINITY));
    const Lanes inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;

    /* forward substitution */
    const Lanes z_L8_theta_ = -(L6_omega_ * L6_omega_)*cross_L6_L8_ + cos_theta_L8_*p->weight_L8_across_;
    const Lanes z_L2_theta_ = -F_A_x_*span_L2_tail_y_ + F_A_y_*span_L2_tail_x_ - (L6_omega_ * L6_omega_)*cross_L6_L2_
        - (L7_omega_ * L7_omega_)*cross_L7_L2_ + M_A_second_ + cos_theta_L2_*p->weight_L2_across_;
    const Lanes z_L7_theta_ = (L2_omega_ * L2_omega_)*cross_L7_L2_ + (L3_omega_ * L3_omega_)*cross_L7_L3_
        - (L6_omega_ * L6_omega_)*cross_L6_L7_ + cos_theta_L7_*p->weight_L7_across_ - l_L7_theta_L2_theta_*z_L2_theta_
        + span_L7_tail_x_*(F_A_y_ + F_B_y_) - span_L7_tail_y_*(F_A_x_ + F_B_x_);
    const Lanes z_L3_theta_ = -F_B_x_*span_L3_tail_y_ + F_B_y_*span_L3_tail_x_ - (L6_omega_ * L6_omega_)*cross_L6_L3_
        - (L7_omega_ * L7_omega_)*cross_L7_L3_ + M_B_second_ + cos_theta_L3_*p->weight_L3_across_;
    const Lanes z_L6_theta_ = (L2_omega_ * L2_omega_)*cross_L6_L2_ + (L3_omega_ * L3_omega_)*cross_L6_L3_
        + (L7_omega_ * L7_omega_)*cross_L6_L7_ + (L8_omega_ * L8_omega_)*cross_L6_L8_
        + cos_theta_L6_*p->weight_L6_across_ - l_L6_theta_L2_theta_*z_L2_theta_ - l_L6_theta_L3_theta_*z_L3_theta_
        - l_L6_theta_L7_theta_*z_L7_theta_ - l_L6_theta_L8_theta_*z_L8_theta_ + span_L6_head_x_*(F_A_y_ + F_B_y_)
        - span_L6_head_y_*(F_A_x_ + F_B_x_);
    const Lanes z_guide_offset_ = -l_guide_offset_L6_theta_*z_L6_theta_ - l_guide_offset_L8_theta_*z_L8_theta_
        + rhs_guide_offset_;

    /* backward substitution */
    const Lanes lambda_guide_offset_ = -inverse_pivot_guide_offset_*z_guide_offset_;
    const Lanes acceleration_L6_theta_ = inverse_pivot_L6_theta_*z_L6_theta_
        - l_guide_offset_L6_theta_*lambda_guide_offset_;
    const Lanes acceleration_L3_theta_ = -acceleration_L6_theta_*l_L6_theta_L3_theta_
        + inverse_cross_L7_theta_L3_theta_*z_L7_theta_ + inverse_pivot_L3_theta_*z_L3_theta_;
    const Lanes acceleration_L7_theta_ = -acceleration_L6_theta_*l_L6_theta_L7_theta_
        + inverse_cross_L7_theta_L3_theta_*z_L3_theta_ + inverse_pivot_L7_theta_*z_L7_theta_;
    const Lanes acceleration_L2_theta_ = -acceleration_L6_theta_*l_L6_theta_L2_theta_
        - acceleration_L7_theta_*l_L7_theta_L2_theta_ + p->inverse_mass_L2_L2_*z_L2_theta_;
    const Lanes acceleration_L8_theta_ = -acceleration_L6_theta_*l_L6_theta_L8_theta_
        + p->inverse_mass_L8_L8_*z_L8_theta_ - l_guide_offset_L8_theta_*lambda_guide_offset_;

    /* results */
    a[0] = acceleration_L6_theta_;
    a[1] = acceleration_L7_theta_;
    a[2] = acceleration_L8_theta_;
    a[3] = acceleration_L2_theta_;
    a[4] = acceleration_L3_theta_;
    aside->lambda[0] = lambda_guide_offset_;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = crank1_rate_*(-F_A_x_*span_L1_head_y_ + F_A_y_*span_L1_head_x_ - M_A_first_
        - cos_theta_L1_*p->weight_L1_across_ + crank1_acceleration_*p->mass_crank1_crank1_)
        + crank4_rate_*(-F_B_x_*span_L4_head_y_ + F_B_y_*span_L4_head_x_ - M_B_first_
        - cos_theta_L4_*p->weight_L4_across_ + crank4_acceleration_*p->mass_crank4_crank4_);
    aside->power[1] = all_of(0.0);
    aside->power[2] = aside->clearance[0].power + aside->clearance[1].power;
}

/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const Lanes L6_theta_ = q[0];
    const Lanes L6_omega_ = v[0];
    const Lanes L7_theta_ = q[1];
    const Lanes L8_theta_ = q[2];
    const Lanes L8_omega_ = v[2];
    const Lanes L2_theta_ = q[3];
    const Lanes L3_theta_ = q[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L7_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(L8_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(L2_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(L3_theta_, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_L6_ = cosines_0;
    const Lanes sin_theta_L6_ = sines_0;
    const Lanes cos_theta_L7_ = cosines_1;
    const Lanes sin_theta_L7_ = sines_1;
    const Lanes cos_theta_L8_ = cosines_2;
    const Lanes sin_theta_L8_ = sines_2;
    const Lanes cos_theta_L2_ = cosines_3;
    const Lanes sin_theta_L2_ = sines_3;
    const Lanes cos_theta_L3_ = cosines_4;
    const Lanes sin_theta_L3_ = sines_4;
    const Lanes span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const Lanes span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const Lanes span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const Lanes span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const Lanes cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const Lanes dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const Lanes cos_L2_less_L6_ = cos_theta_L2_*cos_theta_L6_ + sin_theta_L2_*sin_theta_L6_;
    const Lanes dot_L6_L2_ = cos_L2_less_L6_*p->inertia_L6_L2_;
    const Lanes cos_L2_less_L7_ = cos_theta_L2_*cos_theta_L7_ + sin_theta_L2_*sin_theta_L7_;
    const Lanes dot_L7_L2_ = cos_L2_less_L7_*p->inertia_L7_L2_;
    const Lanes cos_L3_less_L6_ = cos_theta_L3_*cos_theta_L6_ + sin_theta_L3_*sin_theta_L6_;
    const Lanes dot_L6_L3_ = cos_L3_less_L6_*p->inertia_L6_L3_;
    const Lanes cos_L3_less_L7_ = cos_theta_L3_*cos_theta_L7_ + sin_theta_L3_*sin_theta_L7_;
    const Lanes dot_L7_L3_ = cos_L3_less_L7_*p->inertia_L7_L3_;
    const Lanes cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const Lanes dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;

    /* Phi and Phi_dot */
    const Lanes phi_guide_offset_ = -span_L6_head_x_ - span_L8_head_x_;
    const Lanes phi_dot_guide_offset_ = L6_omega_*span_L6_head_y_ + L8_omega_*span_L8_head_y_;

    /* L D L^T of the KKT matrix */
    const Lanes l_L6_theta_L8_theta_ = dot_L6_L8_*p->inverse_tree_metric_L8_theta_;
    const Lanes l_guide_offset_L8_theta_ = p->inverse_tree_metric_L8_theta_*span_L8_head_y_;
    const Lanes l_L7_theta_L2_theta_ = dot_L7_L2_*p->inverse_tree_metric_L2_theta_;
    const Lanes l_L6_theta_L2_theta_ = dot_L6_L2_*p->inverse_tree_metric_L2_theta_;
    const Lanes pivot_L7_theta_ = -dot_L7_L2_*l_L7_theta_L2_theta_ + p->tree_metric_L7_theta_;
    const Lanes determinant_L7_theta_L3_theta_ = -(dot_L7_L3_ * dot_L7_L3_) + pivot_L7_theta_*p->tree_metric_L3_theta_;
    const Lanes inverse_L7_theta_L3_theta_ = 1.0/determinant_L7_theta_L3_theta_;
    const Lanes inverse_pivot_L7_theta_ = inverse_L7_theta_L3_theta_*p->tree_metric_L3_theta_;
    const Lanes inverse_pivot_L3_theta_ = inverse_L7_theta_L3_theta_*pivot_L7_theta_;
    const Lanes inverse_cross_L7_theta_L3_theta_ = -dot_L7_L3_*inverse_L7_theta_L3_theta_;
    const Lanes w_L6_theta_L7_theta_ = dot_L6_L7_ - dot_L7_L2_*l_L6_theta_L2_theta_;
    const Lanes l_L6_theta_L7_theta_ = dot_L6_L3_*inverse_cross_L7_theta_L3_theta_
        + inverse_pivot_L7_theta_*w_L6_theta_L7_theta_;
    const Lanes l_L6_theta_L3_theta_ = dot_L6_L3_*inverse_pivot_L3_theta_
        + inverse_cross_L7_theta_L3_theta_*w_L6_theta_L7_theta_;
    const Lanes inverse_pivot_L6_theta_ = 1.0/(-dot_L6_L2_*l_L6_theta_L2_theta_ - dot_L6_L3_*l_L6_theta_L3_theta_
        - dot_L6_L8_*l_L6_theta_L8_theta_ - l_L6_theta_L7_theta_*w_L6_theta_L7_theta_ + p->tree_metric_L6_theta_);
    const Lanes w_guide_offset_L6_theta_ = -dot_L6_L8_*l_guide_offset_L8_theta_ + span_L6_head_y_;
    const Lanes l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*w_guide_offset_L6_theta_;
    const Lanes scale_guide_offset_ = l_guide_offset_L6_theta_*w_guide_offset_L6_theta_
        + l_guide_offset_L8_theta_*span_L8_head_y_;
    *rare |= ~((scale_guide_offset_ > 0.0) & (scale_guide_offset_ < INFINITY));
    const Lanes inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;

    /* backward substitution */
    const Lanes dq_lambda_guide_offset_ = -inverse_pivot_guide_offset_*phi_guide_offset_;
    const Lanes dq_acceleration_L6_theta_ = -dq_lambda_guide_offset_*l_guide_offset_L6_theta_;
    const Lanes dq_acceleration_L3_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L3_theta_;
    const Lanes dq_acceleration_L7_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L7_theta_;
    const Lanes dq_acceleration_L2_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L2_theta_
        - dq_acceleration_L7_theta_*l_L7_theta_L2_theta_;
    const Lanes dq_acceleration_L8_theta_ = -dq_acceleration_L6_theta_*l_L6_theta_L8_theta_
        - dq_lambda_guide_offset_*l_guide_offset_L8_theta_;

    /* backward substitution */
    const Lanes dv_lambda_guide_offset_ = -inverse_pivot_guide_offset_*phi_dot_guide_offset_;
    const Lanes dv_acceleration_L6_theta_ = -dv_lambda_guide_offset_*l_guide_offset_L6_theta_;
    const Lanes dv_acceleration_L3_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L3_theta_;
    const Lanes dv_acceleration_L7_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L7_theta_;
    const Lanes dv_acceleration_L2_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L2_theta_
        - dv_acceleration_L7_theta_*l_L7_theta_L2_theta_;
    const Lanes dv_acceleration_L8_theta_ = -dv_acceleration_L6_theta_*l_L6_theta_L8_theta_
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
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_guide_offset_));
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

/* Joint A, as in newton.c: what acts in no lane is passed over. */
static void slopes_A_(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
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

static void tangent_A_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->pin_clearance_);
    slopes_A_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_A_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_A_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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

/* Joint B, as in newton.c: what acts in no lane is passed over. */
static void slopes_B_(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
    const LaneParameters *p, const Lanes *side, Lanes *g, LaneSlopes *out)
{
    (void)p, (void)side, (void)g;
    *out = (LaneSlopes){0};
    const LaneBits touching = is_closed(latch);
    if (any_of(touching)) {
        LaneSlopes dry;
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent_, p->dry_friction_mu_, p->dry_friction_v0_, p->pin_radius_, p->R_j_pin_,
            p->pin_clearance_, p->dry_pin_K_, p->dry_pin_hysteresis_, p->dry_pin_friction_slope_, side, g, 5, &dry);
        pick_slopes(out, touching, &dry);
    }
}

static void tangent_B_(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->pin_clearance_);
    slopes_B_(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_B_(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_B_(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    const Lanes L6_theta_ = q[0];
    const Lanes L6_omega_ = v[0];
    const Lanes L7_theta_ = q[1];
    const Lanes L7_omega_ = v[1];
    const Lanes L8_theta_ = q[2];
    const Lanes L8_omega_ = v[2];
    const Lanes L2_theta_ = q[3];
    const Lanes L2_omega_ = v[3];
    const Lanes L3_theta_ = q[4];
    const Lanes L3_omega_ = v[4];
    const Lanes a_L6_theta_ = a[0];
    const Lanes a_L7_theta_ = a[1];
    const Lanes a_L8_theta_ = a[2];
    const Lanes a_L2_theta_ = a[3];
    const Lanes a_L3_theta_ = a[4];
    const Lanes held_lambda_guide_offset_ = aside->lambda[0];
    const Lanes A_Fx_ = aside->clearance[0].Fx;
    const Lanes A_Fy_ = aside->clearance[0].Fy;
    const Lanes A_moment_first_ = aside->clearance[0].moment_first;
    const Lanes A_moment_second_ = aside->clearance[0].moment_second;
    const Lanes B_Fx_ = aside->clearance[1].Fx;
    const Lanes B_Fy_ = aside->clearance[1].Fy;
    const Lanes B_moment_first_ = aside->clearance[1].moment_first;
    const Lanes B_moment_second_ = aside->clearance[1].moment_second;

    /* directions, arms, drives */
    const Lanes crank1_value_ = p->omega_*t - 0.689754120388159;
    const Lanes crank1_rate_ = p->omega_;
    const Lanes crank1_acceleration_ = all_of(0.0);
    const Lanes crank4_value_ = p->omega4_*t + 3.4814082589530893;
    const Lanes crank4_rate_ = p->omega4_;
    const Lanes crank4_acceleration_ = all_of(0.0);
    const Lanes cos_theta_L1_ = lanes_cos(crank1_value_);
    const Lanes sin_theta_L1_ = lanes_sin(crank1_value_);
    const Lanes cos_theta_L4_ = lanes_cos(crank4_value_);
    const Lanes sin_theta_L4_ = lanes_sin(crank4_value_);
    const Lanes cos_theta_L6_ = lanes_cos(L6_theta_);
    const Lanes sin_theta_L6_ = lanes_sin(L6_theta_);
    const Lanes cos_theta_L7_ = lanes_cos(L7_theta_);
    const Lanes sin_theta_L7_ = lanes_sin(L7_theta_);
    const Lanes cos_theta_L8_ = lanes_cos(L8_theta_);
    const Lanes sin_theta_L8_ = lanes_sin(L8_theta_);
    const Lanes cos_theta_L2_ = lanes_cos(L2_theta_);
    const Lanes sin_theta_L2_ = lanes_sin(L2_theta_);
    const Lanes cos_theta_L3_ = lanes_cos(L3_theta_);
    const Lanes sin_theta_L3_ = lanes_sin(L3_theta_);
    const Lanes span_L6_head_x_ = p->L6_head_span_x_*cos_theta_L6_;
    const Lanes span_L6_head_y_ = p->L6_head_span_x_*sin_theta_L6_;
    const Lanes L6_head_x_ = p->O6_x_ + span_L6_head_x_;
    const Lanes L6_head_vx_ = -L6_omega_*span_L6_head_y_;
    const Lanes L6_head_vy_ = L6_omega_*span_L6_head_x_;
    const Lanes span_L7_tail_x_ = p->L7_tail_span_x_*cos_theta_L7_;
    const Lanes span_L7_tail_y_ = p->L7_tail_span_x_*sin_theta_L7_;
    const Lanes L7_tail_x_ = L6_head_x_ + span_L7_tail_x_;
    const Lanes L7_tail_vx_ = L6_head_vx_ - L7_omega_*span_L7_tail_y_;
    const Lanes L7_tail_y_ = span_L6_head_y_ + span_L7_tail_y_;
    const Lanes L7_tail_vy_ = L6_head_vy_ + L7_omega_*span_L7_tail_x_;
    const Lanes span_L8_head_x_ = p->L8_head_span_x_*cos_theta_L8_;
    const Lanes span_L8_head_y_ = p->L8_head_span_x_*sin_theta_L8_;
    const Lanes span_L1_head_x_ = p->L1_head_span_x_*cos_theta_L1_;
    const Lanes span_L1_head_y_ = p->L1_head_span_x_*sin_theta_L1_;
    const Lanes L1_head_vx_ = -crank1_rate_*span_L1_head_y_;
    const Lanes L1_head_vy_ = crank1_rate_*span_L1_head_x_;
    const Lanes span_L2_tail_x_ = p->L2_tail_span_x_*cos_theta_L2_;
    const Lanes span_L2_tail_y_ = p->L2_tail_span_x_*sin_theta_L2_;
    const Lanes L2_tail_x_ = L7_tail_x_ + span_L2_tail_x_;
    const Lanes L2_tail_vx_ = -L2_omega_*span_L2_tail_y_ + L7_tail_vx_;
    const Lanes L2_tail_y_ = L7_tail_y_ + span_L2_tail_y_;
    const Lanes L2_tail_vy_ = L2_omega_*span_L2_tail_x_ + L7_tail_vy_;
    const Lanes span_L4_head_x_ = p->L4_head_span_x_*cos_theta_L4_;
    const Lanes span_L4_head_y_ = p->L4_head_span_x_*sin_theta_L4_;
    const Lanes L4_head_vx_ = -crank4_rate_*span_L4_head_y_;
    const Lanes L4_head_y_ = p->O4_y_ + span_L4_head_y_;
    const Lanes L4_head_vy_ = crank4_rate_*span_L4_head_x_;
    const Lanes span_L3_tail_x_ = p->L3_tail_span_x_*cos_theta_L3_;
    const Lanes span_L3_tail_y_ = p->L3_tail_span_x_*sin_theta_L3_;
    const Lanes L3_tail_x_ = L7_tail_x_ + span_L3_tail_x_;
    const Lanes L3_tail_vx_ = -L3_omega_*span_L3_tail_y_ + L7_tail_vx_;
    const Lanes L3_tail_y_ = L7_tail_y_ + span_L3_tail_y_;
    const Lanes L3_tail_vy_ = L3_omega_*span_L3_tail_x_ + L7_tail_vy_;
    const Lanes cos_L7_less_L6_ = cos_theta_L6_*cos_theta_L7_ + sin_theta_L6_*sin_theta_L7_;
    const Lanes sin_L7_less_L6_ = cos_theta_L6_*sin_theta_L7_ - cos_theta_L7_*sin_theta_L6_;
    const Lanes dot_L6_L7_ = cos_L7_less_L6_*p->inertia_L6_L7_;
    const Lanes cross_L6_L7_ = p->inertia_L6_L7_*sin_L7_less_L6_;
    const Lanes cos_L2_less_L6_ = cos_theta_L2_*cos_theta_L6_ + sin_theta_L2_*sin_theta_L6_;
    const Lanes sin_L2_less_L6_ = -cos_theta_L2_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L2_;
    const Lanes dot_L6_L2_ = cos_L2_less_L6_*p->inertia_L6_L2_;
    const Lanes cross_L6_L2_ = p->inertia_L6_L2_*sin_L2_less_L6_;
    const Lanes cos_L2_less_L7_ = cos_theta_L2_*cos_theta_L7_ + sin_theta_L2_*sin_theta_L7_;
    const Lanes sin_L2_less_L7_ = -cos_theta_L2_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L2_;
    const Lanes dot_L7_L2_ = cos_L2_less_L7_*p->inertia_L7_L2_;
    const Lanes cross_L7_L2_ = p->inertia_L7_L2_*sin_L2_less_L7_;
    const Lanes cos_L3_less_L6_ = cos_theta_L3_*cos_theta_L6_ + sin_theta_L3_*sin_theta_L6_;
    const Lanes sin_L3_less_L6_ = -cos_theta_L3_*sin_theta_L6_ + cos_theta_L6_*sin_theta_L3_;
    const Lanes dot_L6_L3_ = cos_L3_less_L6_*p->inertia_L6_L3_;
    const Lanes cross_L6_L3_ = p->inertia_L6_L3_*sin_L3_less_L6_;
    const Lanes cos_L3_less_L7_ = cos_theta_L3_*cos_theta_L7_ + sin_theta_L3_*sin_theta_L7_;
    const Lanes sin_L3_less_L7_ = -cos_theta_L3_*sin_theta_L7_ + cos_theta_L7_*sin_theta_L3_;
    const Lanes dot_L7_L3_ = cos_L3_less_L7_*p->inertia_L7_L3_;
    const Lanes cross_L7_L3_ = p->inertia_L7_L3_*sin_L3_less_L7_;
    const Lanes cos_L8_less_L6_ = cos_theta_L6_*cos_theta_L8_ + sin_theta_L6_*sin_theta_L8_;
    const Lanes sin_L8_less_L6_ = cos_theta_L6_*sin_theta_L8_ - cos_theta_L8_*sin_theta_L6_;
    const Lanes dot_L6_L8_ = cos_L8_less_L6_*p->inertia_L6_L8_;
    const Lanes cross_L6_L8_ = p->inertia_L6_L8_*sin_L8_less_L6_;

    /* clearance joint A */
    const Lanes e_A_x_ = L2_tail_x_ - span_L1_head_x_;
    const Lanes e_A_y_ = L2_tail_y_ - span_L1_head_y_;
    const Lanes edot_A_x_ = -L1_head_vx_ + L2_tail_vx_;
    const Lanes edot_A_y_ = -L1_head_vy_ + L2_tail_vy_;
    Lanes change_A_[4][6];
    tangent_A_(e_A_x_, e_A_y_, edot_A_x_, edot_A_y_, crank1_rate_, L2_omega_, &memory->latch[0], p, side, g, change_A_);
    const Lanes span_L1_head_x_by_time_ = -crank1_rate_*span_L1_head_y_;
    const Lanes span_L1_head_y_by_time_ = crank1_rate_*span_L1_head_x_;
    const Lanes L1_head_vx_by_time_ = -crank1_acceleration_*span_L1_head_y_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_x_;
    const Lanes L2_tail_vx_by_L6_theta_ = -L6_omega_*span_L6_head_x_;
    const Lanes L2_tail_vx_by_L7_theta_ = -L7_omega_*span_L7_tail_x_;
    const Lanes L2_tail_vx_by_L2_theta_ = -L2_omega_*span_L2_tail_x_;
    const Lanes L1_head_vy_by_time_ = crank1_acceleration_*span_L1_head_x_
        - (crank1_rate_ * crank1_rate_)*span_L1_head_y_;
    const Lanes L2_tail_vy_by_L6_theta_ = -L6_omega_*span_L6_head_y_;
    const Lanes L2_tail_vy_by_L7_theta_ = -L7_omega_*span_L7_tail_y_;
    const Lanes L2_tail_vy_by_L2_theta_ = -L2_omega_*span_L2_tail_y_;
    const Lanes A_Fx_by_e_x_ = change_A_[0][0];
    const Lanes A_Fx_by_e_y_ = change_A_[0][1];
    const Lanes A_Fx_by_de_x_ = change_A_[0][2];
    const Lanes A_Fx_by_de_y_ = change_A_[0][3];
    const Lanes A_Fx_by_omega_i_ = change_A_[0][4];
    const Lanes A_Fx_by_omega_j_ = change_A_[0][5];
    const Lanes A_Fx_by_L6_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L6_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L6_theta_
        - A_Fx_by_e_x_*span_L6_head_y_ + A_Fx_by_e_y_*span_L6_head_x_;
    const Lanes A_Fx_by_L7_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L7_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L7_theta_
        - A_Fx_by_e_x_*span_L7_tail_y_ + A_Fx_by_e_y_*span_L7_tail_x_;
    const Lanes A_Fx_by_L2_theta_ = A_Fx_by_de_x_*L2_tail_vx_by_L2_theta_ + A_Fx_by_de_y_*L2_tail_vy_by_L2_theta_
        - A_Fx_by_e_x_*span_L2_tail_y_ + A_Fx_by_e_y_*span_L2_tail_x_;
    const Lanes A_Fx_by_time_ = -A_Fx_by_de_x_*L1_head_vx_by_time_ - A_Fx_by_de_y_*L1_head_vy_by_time_
        - A_Fx_by_e_x_*span_L1_head_x_by_time_ - A_Fx_by_e_y_*span_L1_head_y_by_time_
        + A_Fx_by_omega_i_*crank1_acceleration_;
    const Lanes A_Fx_by_L6_omega_ = -A_Fx_by_de_x_*span_L6_head_y_ + A_Fx_by_de_y_*span_L6_head_x_;
    const Lanes A_Fx_by_L7_omega_ = -A_Fx_by_de_x_*span_L7_tail_y_ + A_Fx_by_de_y_*span_L7_tail_x_;
    const Lanes A_Fx_by_L2_omega_ = -A_Fx_by_de_x_*span_L2_tail_y_ + A_Fx_by_de_y_*span_L2_tail_x_ + A_Fx_by_omega_j_;
    const Lanes A_Fy_by_e_x_ = change_A_[1][0];
    const Lanes A_Fy_by_e_y_ = change_A_[1][1];
    const Lanes A_Fy_by_de_x_ = change_A_[1][2];
    const Lanes A_Fy_by_de_y_ = change_A_[1][3];
    const Lanes A_Fy_by_omega_i_ = change_A_[1][4];
    const Lanes A_Fy_by_omega_j_ = change_A_[1][5];
    const Lanes A_Fy_by_L6_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L6_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L6_theta_
        - A_Fy_by_e_x_*span_L6_head_y_ + A_Fy_by_e_y_*span_L6_head_x_;
    const Lanes A_Fy_by_L7_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L7_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L7_theta_
        - A_Fy_by_e_x_*span_L7_tail_y_ + A_Fy_by_e_y_*span_L7_tail_x_;
    const Lanes A_Fy_by_L2_theta_ = A_Fy_by_de_x_*L2_tail_vx_by_L2_theta_ + A_Fy_by_de_y_*L2_tail_vy_by_L2_theta_
        - A_Fy_by_e_x_*span_L2_tail_y_ + A_Fy_by_e_y_*span_L2_tail_x_;
    const Lanes A_Fy_by_time_ = -A_Fy_by_de_x_*L1_head_vx_by_time_ - A_Fy_by_de_y_*L1_head_vy_by_time_
        - A_Fy_by_e_x_*span_L1_head_x_by_time_ - A_Fy_by_e_y_*span_L1_head_y_by_time_
        + A_Fy_by_omega_i_*crank1_acceleration_;
    const Lanes A_Fy_by_L6_omega_ = -A_Fy_by_de_x_*span_L6_head_y_ + A_Fy_by_de_y_*span_L6_head_x_;
    const Lanes A_Fy_by_L7_omega_ = -A_Fy_by_de_x_*span_L7_tail_y_ + A_Fy_by_de_y_*span_L7_tail_x_;
    const Lanes A_Fy_by_L2_omega_ = -A_Fy_by_de_x_*span_L2_tail_y_ + A_Fy_by_de_y_*span_L2_tail_x_ + A_Fy_by_omega_j_;
    const Lanes A_moment_first_by_e_x_ = change_A_[2][0];
    const Lanes A_moment_first_by_e_y_ = change_A_[2][1];
    const Lanes A_moment_first_by_de_x_ = change_A_[2][2];
    const Lanes A_moment_first_by_de_y_ = change_A_[2][3];
    const Lanes A_moment_first_by_omega_i_ = change_A_[2][4];
    const Lanes A_moment_first_by_omega_j_ = change_A_[2][5];
    const Lanes A_moment_first_by_L6_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L6_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L6_theta_ - A_moment_first_by_e_x_*span_L6_head_y_
        + A_moment_first_by_e_y_*span_L6_head_x_;
    const Lanes A_moment_first_by_L7_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L7_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L7_theta_ - A_moment_first_by_e_x_*span_L7_tail_y_
        + A_moment_first_by_e_y_*span_L7_tail_x_;
    const Lanes A_moment_first_by_L2_theta_ = A_moment_first_by_de_x_*L2_tail_vx_by_L2_theta_
        + A_moment_first_by_de_y_*L2_tail_vy_by_L2_theta_ - A_moment_first_by_e_x_*span_L2_tail_y_
        + A_moment_first_by_e_y_*span_L2_tail_x_;
    const Lanes A_moment_first_by_time_ = -A_moment_first_by_de_x_*L1_head_vx_by_time_
        - A_moment_first_by_de_y_*L1_head_vy_by_time_ - A_moment_first_by_e_x_*span_L1_head_x_by_time_
        - A_moment_first_by_e_y_*span_L1_head_y_by_time_ + A_moment_first_by_omega_i_*crank1_acceleration_;
    const Lanes A_moment_first_by_L6_omega_ = -A_moment_first_by_de_x_*span_L6_head_y_
        + A_moment_first_by_de_y_*span_L6_head_x_;
    const Lanes A_moment_first_by_L7_omega_ = -A_moment_first_by_de_x_*span_L7_tail_y_
        + A_moment_first_by_de_y_*span_L7_tail_x_;
    const Lanes A_moment_first_by_L2_omega_ = -A_moment_first_by_de_x_*span_L2_tail_y_
        + A_moment_first_by_de_y_*span_L2_tail_x_ + A_moment_first_by_omega_j_;
    const Lanes A_moment_second_by_e_x_ = change_A_[3][0];
    const Lanes A_moment_second_by_e_y_ = change_A_[3][1];
    const Lanes A_moment_second_by_de_x_ = change_A_[3][2];
    const Lanes A_moment_second_by_de_y_ = change_A_[3][3];
    const Lanes A_moment_second_by_omega_i_ = change_A_[3][4];
    const Lanes A_moment_second_by_omega_j_ = change_A_[3][5];
    const Lanes A_moment_second_by_L6_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L6_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L6_theta_ - A_moment_second_by_e_x_*span_L6_head_y_
        + A_moment_second_by_e_y_*span_L6_head_x_;
    const Lanes A_moment_second_by_L7_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L7_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L7_theta_ - A_moment_second_by_e_x_*span_L7_tail_y_
        + A_moment_second_by_e_y_*span_L7_tail_x_;
    const Lanes A_moment_second_by_L2_theta_ = A_moment_second_by_de_x_*L2_tail_vx_by_L2_theta_
        + A_moment_second_by_de_y_*L2_tail_vy_by_L2_theta_ - A_moment_second_by_e_x_*span_L2_tail_y_
        + A_moment_second_by_e_y_*span_L2_tail_x_;
    const Lanes A_moment_second_by_time_ = -A_moment_second_by_de_x_*L1_head_vx_by_time_
        - A_moment_second_by_de_y_*L1_head_vy_by_time_ - A_moment_second_by_e_x_*span_L1_head_x_by_time_
        - A_moment_second_by_e_y_*span_L1_head_y_by_time_ + A_moment_second_by_omega_i_*crank1_acceleration_;
    const Lanes A_moment_second_by_L6_omega_ = -A_moment_second_by_de_x_*span_L6_head_y_
        + A_moment_second_by_de_y_*span_L6_head_x_;
    const Lanes A_moment_second_by_L7_omega_ = -A_moment_second_by_de_x_*span_L7_tail_y_
        + A_moment_second_by_de_y_*span_L7_tail_x_;
    const Lanes A_moment_second_by_L2_omega_ = -A_moment_second_by_de_x_*span_L2_tail_y_
        + A_moment_second_by_de_y_*span_L2_tail_x_ + A_moment_second_by_omega_j_;

    /* clearance joint B */
    const Lanes e_B_x_ = L3_tail_x_ - span_L4_head_x_;
    const Lanes e_B_y_ = L3_tail_y_ - L4_head_y_;
    const Lanes edot_B_x_ = L3_tail_vx_ - L4_head_vx_;
    const Lanes edot_B_y_ = L3_tail_vy_ - L4_head_vy_;
    Lanes change_B_[4][6];
    tangent_B_(e_B_x_, e_B_y_, edot_B_x_, edot_B_y_, crank4_rate_, L3_omega_, &memory->latch[1], p, side, g, change_B_);
    const Lanes span_L4_head_x_by_time_ = -crank4_rate_*span_L4_head_y_;
    const Lanes L4_head_y_by_time_ = crank4_rate_*span_L4_head_x_;
    const Lanes L3_tail_vx_by_L6_theta_ = -L6_omega_*span_L6_head_x_;
    const Lanes L3_tail_vx_by_L7_theta_ = -L7_omega_*span_L7_tail_x_;
    const Lanes L3_tail_vx_by_L3_theta_ = -L3_omega_*span_L3_tail_x_;
    const Lanes L4_head_vx_by_time_ = -crank4_acceleration_*span_L4_head_y_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_x_;
    const Lanes L3_tail_vy_by_L6_theta_ = -L6_omega_*span_L6_head_y_;
    const Lanes L3_tail_vy_by_L7_theta_ = -L7_omega_*span_L7_tail_y_;
    const Lanes L3_tail_vy_by_L3_theta_ = -L3_omega_*span_L3_tail_y_;
    const Lanes L4_head_vy_by_time_ = crank4_acceleration_*span_L4_head_x_
        - (crank4_rate_ * crank4_rate_)*span_L4_head_y_;
    const Lanes B_Fx_by_e_x_ = change_B_[0][0];
    const Lanes B_Fx_by_e_y_ = change_B_[0][1];
    const Lanes B_Fx_by_de_x_ = change_B_[0][2];
    const Lanes B_Fx_by_de_y_ = change_B_[0][3];
    const Lanes B_Fx_by_omega_i_ = change_B_[0][4];
    const Lanes B_Fx_by_omega_j_ = change_B_[0][5];
    const Lanes B_Fx_by_L6_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L6_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L6_theta_
        - B_Fx_by_e_x_*span_L6_head_y_ + B_Fx_by_e_y_*span_L6_head_x_;
    const Lanes B_Fx_by_L7_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L7_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L7_theta_
        - B_Fx_by_e_x_*span_L7_tail_y_ + B_Fx_by_e_y_*span_L7_tail_x_;
    const Lanes B_Fx_by_L3_theta_ = B_Fx_by_de_x_*L3_tail_vx_by_L3_theta_ + B_Fx_by_de_y_*L3_tail_vy_by_L3_theta_
        - B_Fx_by_e_x_*span_L3_tail_y_ + B_Fx_by_e_y_*span_L3_tail_x_;
    const Lanes B_Fx_by_time_ = -B_Fx_by_de_x_*L4_head_vx_by_time_ - B_Fx_by_de_y_*L4_head_vy_by_time_
        - B_Fx_by_e_x_*span_L4_head_x_by_time_ - B_Fx_by_e_y_*L4_head_y_by_time_
        + B_Fx_by_omega_i_*crank4_acceleration_;
    const Lanes B_Fx_by_L6_omega_ = -B_Fx_by_de_x_*span_L6_head_y_ + B_Fx_by_de_y_*span_L6_head_x_;
    const Lanes B_Fx_by_L7_omega_ = -B_Fx_by_de_x_*span_L7_tail_y_ + B_Fx_by_de_y_*span_L7_tail_x_;
    const Lanes B_Fx_by_L3_omega_ = -B_Fx_by_de_x_*span_L3_tail_y_ + B_Fx_by_de_y_*span_L3_tail_x_ + B_Fx_by_omega_j_;
    const Lanes B_Fy_by_e_x_ = change_B_[1][0];
    const Lanes B_Fy_by_e_y_ = change_B_[1][1];
    const Lanes B_Fy_by_de_x_ = change_B_[1][2];
    const Lanes B_Fy_by_de_y_ = change_B_[1][3];
    const Lanes B_Fy_by_omega_i_ = change_B_[1][4];
    const Lanes B_Fy_by_omega_j_ = change_B_[1][5];
    const Lanes B_Fy_by_L6_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L6_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L6_theta_
        - B_Fy_by_e_x_*span_L6_head_y_ + B_Fy_by_e_y_*span_L6_head_x_;
    const Lanes B_Fy_by_L7_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L7_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L7_theta_
        - B_Fy_by_e_x_*span_L7_tail_y_ + B_Fy_by_e_y_*span_L7_tail_x_;
    const Lanes B_Fy_by_L3_theta_ = B_Fy_by_de_x_*L3_tail_vx_by_L3_theta_ + B_Fy_by_de_y_*L3_tail_vy_by_L3_theta_
        - B_Fy_by_e_x_*span_L3_tail_y_ + B_Fy_by_e_y_*span_L3_tail_x_;
    const Lanes B_Fy_by_time_ = -B_Fy_by_de_x_*L4_head_vx_by_time_ - B_Fy_by_de_y_*L4_head_vy_by_time_
        - B_Fy_by_e_x_*span_L4_head_x_by_time_ - B_Fy_by_e_y_*L4_head_y_by_time_
        + B_Fy_by_omega_i_*crank4_acceleration_;
    const Lanes B_Fy_by_L6_omega_ = -B_Fy_by_de_x_*span_L6_head_y_ + B_Fy_by_de_y_*span_L6_head_x_;
    const Lanes B_Fy_by_L7_omega_ = -B_Fy_by_de_x_*span_L7_tail_y_ + B_Fy_by_de_y_*span_L7_tail_x_;
    const Lanes B_Fy_by_L3_omega_ = -B_Fy_by_de_x_*span_L3_tail_y_ + B_Fy_by_de_y_*span_L3_tail_x_ + B_Fy_by_omega_j_;
    const Lanes B_moment_first_by_e_x_ = change_B_[2][0];
    const Lanes B_moment_first_by_e_y_ = change_B_[2][1];
    const Lanes B_moment_first_by_de_x_ = change_B_[2][2];
    const Lanes B_moment_first_by_de_y_ = change_B_[2][3];
    const Lanes B_moment_first_by_omega_i_ = change_B_[2][4];
    const Lanes B_moment_first_by_omega_j_ = change_B_[2][5];
    const Lanes B_moment_first_by_L6_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L6_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L6_theta_ - B_moment_first_by_e_x_*span_L6_head_y_
        + B_moment_first_by_e_y_*span_L6_head_x_;
    const Lanes B_moment_first_by_L7_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L7_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L7_theta_ - B_moment_first_by_e_x_*span_L7_tail_y_
        + B_moment_first_by_e_y_*span_L7_tail_x_;
    const Lanes B_moment_first_by_L3_theta_ = B_moment_first_by_de_x_*L3_tail_vx_by_L3_theta_
        + B_moment_first_by_de_y_*L3_tail_vy_by_L3_theta_ - B_moment_first_by_e_x_*span_L3_tail_y_
        + B_moment_first_by_e_y_*span_L3_tail_x_;
    const Lanes B_moment_first_by_time_ = -B_moment_first_by_de_x_*L4_head_vx_by_time_
        - B_moment_first_by_de_y_*L4_head_vy_by_time_ - B_moment_first_by_e_x_*span_L4_head_x_by_time_
        - B_moment_first_by_e_y_*L4_head_y_by_time_ + B_moment_first_by_omega_i_*crank4_acceleration_;
    const Lanes B_moment_first_by_L6_omega_ = -B_moment_first_by_de_x_*span_L6_head_y_
        + B_moment_first_by_de_y_*span_L6_head_x_;
    const Lanes B_moment_first_by_L7_omega_ = -B_moment_first_by_de_x_*span_L7_tail_y_
        + B_moment_first_by_de_y_*span_L7_tail_x_;
    const Lanes B_moment_first_by_L3_omega_ = -B_moment_first_by_de_x_*span_L3_tail_y_
        + B_moment_first_by_de_y_*span_L3_tail_x_ + B_moment_first_by_omega_j_;
    const Lanes B_moment_second_by_e_x_ = change_B_[3][0];
    const Lanes B_moment_second_by_e_y_ = change_B_[3][1];
    const Lanes B_moment_second_by_de_x_ = change_B_[3][2];
    const Lanes B_moment_second_by_de_y_ = change_B_[3][3];
    const Lanes B_moment_second_by_omega_i_ = change_B_[3][4];
    const Lanes B_moment_second_by_omega_j_ = change_B_[3][5];
    const Lanes B_moment_second_by_L6_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L6_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L6_theta_ - B_moment_second_by_e_x_*span_L6_head_y_
        + B_moment_second_by_e_y_*span_L6_head_x_;
    const Lanes B_moment_second_by_L7_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L7_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L7_theta_ - B_moment_second_by_e_x_*span_L7_tail_y_
        + B_moment_second_by_e_y_*span_L7_tail_x_;
    const Lanes B_moment_second_by_L3_theta_ = B_moment_second_by_de_x_*L3_tail_vx_by_L3_theta_
        + B_moment_second_by_de_y_*L3_tail_vy_by_L3_theta_ - B_moment_second_by_e_x_*span_L3_tail_y_
        + B_moment_second_by_e_y_*span_L3_tail_x_;
    const Lanes B_moment_second_by_time_ = -B_moment_second_by_de_x_*L4_head_vx_by_time_
        - B_moment_second_by_de_y_*L4_head_vy_by_time_ - B_moment_second_by_e_x_*span_L4_head_x_by_time_
        - B_moment_second_by_e_y_*L4_head_y_by_time_ + B_moment_second_by_omega_i_*crank4_acceleration_;
    const Lanes B_moment_second_by_L6_omega_ = -B_moment_second_by_de_x_*span_L6_head_y_
        + B_moment_second_by_de_y_*span_L6_head_x_;
    const Lanes B_moment_second_by_L7_omega_ = -B_moment_second_by_de_x_*span_L7_tail_y_
        + B_moment_second_by_de_y_*span_L7_tail_x_;
    const Lanes B_moment_second_by_L3_omega_ = -B_moment_second_by_de_x_*span_L3_tail_y_
        + B_moment_second_by_de_y_*span_L3_tail_x_ + B_moment_second_by_omega_j_;

    /* powers */
    const Lanes cos_theta_L1_by_time_ = -crank1_rate_*sin_theta_L1_;
    const Lanes cos_theta_L4_by_time_ = -crank4_rate_*sin_theta_L4_;
    const Lanes span_L4_head_y_by_time_ = crank4_rate_*span_L4_head_x_;

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
static void newton_factor(Lanes eta, LaneLinear *lin, LaneBits *rare)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_L6_theta_L7_theta_ = lin->value[0];
    const Lanes mass_L6_theta_L2_theta_ = lin->value[1];
    const Lanes mass_L7_theta_L2_theta_ = lin->value[2];
    const Lanes mass_L6_theta_L3_theta_ = lin->value[3];
    const Lanes mass_L7_theta_L3_theta_ = lin->value[4];
    const Lanes mass_L6_theta_L8_theta_ = lin->value[5];
    const Lanes phi_guide_offset_L6_theta_ = lin->value[6];
    const Lanes phi_guide_offset_L8_theta_ = lin->value[7];
    const Lanes by_q_guide_offset_L6_theta_ = lin->value[8];
    const Lanes by_q_guide_offset_L8_theta_ = lin->value[9];
    const Lanes by_q_L6_theta_L6_theta_ = lin->value[10];
    const Lanes by_q_L6_theta_L7_theta_ = lin->value[11];
    const Lanes by_q_L6_theta_L2_theta_ = lin->value[12];
    const Lanes by_q_L6_theta_L3_theta_ = lin->value[13];
    const Lanes by_q_L6_theta_L8_theta_ = lin->value[14];
    const Lanes by_q_L7_theta_L6_theta_ = lin->value[15];
    const Lanes by_q_L7_theta_L7_theta_ = lin->value[16];
    const Lanes by_q_L7_theta_L2_theta_ = lin->value[17];
    const Lanes by_q_L7_theta_L3_theta_ = lin->value[18];
    const Lanes by_q_L8_theta_L8_theta_ = lin->value[19];
    const Lanes by_q_L8_theta_L6_theta_ = lin->value[20];
    const Lanes by_q_L2_theta_L6_theta_ = lin->value[21];
    const Lanes by_q_L2_theta_L7_theta_ = lin->value[22];
    const Lanes by_q_L2_theta_L2_theta_ = lin->value[23];
    const Lanes by_q_L3_theta_L6_theta_ = lin->value[24];
    const Lanes by_q_L3_theta_L7_theta_ = lin->value[25];
    const Lanes by_q_L3_theta_L3_theta_ = lin->value[26];
    const Lanes by_v_guide_offset_L6_theta_ = lin->value[27];
    const Lanes by_v_guide_offset_L8_theta_ = lin->value[28];
    const Lanes by_v_L6_theta_L6_theta_ = lin->value[29];
    const Lanes by_v_L6_theta_L7_theta_ = lin->value[30];
    const Lanes by_v_L6_theta_L2_theta_ = lin->value[31];
    const Lanes by_v_L6_theta_L3_theta_ = lin->value[32];
    const Lanes by_v_L6_theta_L8_theta_ = lin->value[33];
    const Lanes by_v_L7_theta_L6_theta_ = lin->value[34];
    const Lanes by_v_L7_theta_L7_theta_ = lin->value[35];
    const Lanes by_v_L7_theta_L2_theta_ = lin->value[36];
    const Lanes by_v_L7_theta_L3_theta_ = lin->value[37];
    const Lanes by_v_L8_theta_L6_theta_ = lin->value[38];
    const Lanes by_v_L2_theta_L6_theta_ = lin->value[39];
    const Lanes by_v_L2_theta_L7_theta_ = lin->value[40];
    const Lanes by_v_L2_theta_L2_theta_ = lin->value[41];
    const Lanes by_v_L3_theta_L6_theta_ = lin->value[42];
    const Lanes by_v_L3_theta_L7_theta_ = lin->value[43];
    const Lanes by_v_L3_theta_L3_theta_ = lin->value[44];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_L6_theta_L6_theta_ = eta*(by_q_L6_theta_L6_theta_*eta + by_v_L6_theta_L6_theta_) + p->mass_L6_L6_;
    const Lanes n_L6_theta_L7_theta_ = eta*(by_q_L6_theta_L7_theta_*eta + by_v_L6_theta_L7_theta_)
        + mass_L6_theta_L7_theta_;
    const Lanes n_L6_theta_L8_theta_ = eta*(by_q_L6_theta_L8_theta_*eta + by_v_L6_theta_L8_theta_)
        + mass_L6_theta_L8_theta_;
    const Lanes n_L6_theta_L2_theta_ = eta*(by_q_L6_theta_L2_theta_*eta + by_v_L6_theta_L2_theta_)
        + mass_L6_theta_L2_theta_;
    const Lanes n_L6_theta_L3_theta_ = eta*(by_q_L6_theta_L3_theta_*eta + by_v_L6_theta_L3_theta_)
        + mass_L6_theta_L3_theta_;
    const Lanes n_L7_theta_L6_theta_ = eta*(by_q_L7_theta_L6_theta_*eta + by_v_L7_theta_L6_theta_)
        + mass_L6_theta_L7_theta_;
    const Lanes n_L7_theta_L7_theta_ = eta*(by_q_L7_theta_L7_theta_*eta + by_v_L7_theta_L7_theta_) + p->mass_L7_L7_;
    const Lanes n_L7_theta_L2_theta_ = eta*(by_q_L7_theta_L2_theta_*eta + by_v_L7_theta_L2_theta_)
        + mass_L7_theta_L2_theta_;
    const Lanes n_L7_theta_L3_theta_ = eta*(by_q_L7_theta_L3_theta_*eta + by_v_L7_theta_L3_theta_)
        + mass_L7_theta_L3_theta_;
    const Lanes n_L8_theta_L6_theta_ = eta*(by_q_L8_theta_L6_theta_*eta + by_v_L8_theta_L6_theta_)
        + mass_L6_theta_L8_theta_;
    const Lanes n_L8_theta_L8_theta_ = by_q_L8_theta_L8_theta_*(eta * eta) + p->mass_L8_L8_;
    const Lanes n_L2_theta_L6_theta_ = eta*(by_q_L2_theta_L6_theta_*eta + by_v_L2_theta_L6_theta_)
        + mass_L6_theta_L2_theta_;
    const Lanes n_L2_theta_L7_theta_ = eta*(by_q_L2_theta_L7_theta_*eta + by_v_L2_theta_L7_theta_)
        + mass_L7_theta_L2_theta_;
    const Lanes n_L2_theta_L2_theta_ = eta*(by_q_L2_theta_L2_theta_*eta + by_v_L2_theta_L2_theta_) + p->mass_L2_L2_;
    const Lanes n_L3_theta_L6_theta_ = eta*(by_q_L3_theta_L6_theta_*eta + by_v_L3_theta_L6_theta_)
        + mass_L6_theta_L3_theta_;
    const Lanes n_L3_theta_L7_theta_ = eta*(by_q_L3_theta_L7_theta_*eta + by_v_L3_theta_L7_theta_)
        + mass_L7_theta_L3_theta_;
    const Lanes n_L3_theta_L3_theta_ = eta*(by_q_L3_theta_L3_theta_*eta + by_v_L3_theta_L3_theta_) + p->mass_L3_L3_;
    const Lanes n_guide_offset_L6_theta_ = eta_row*(by_q_guide_offset_L6_theta_*eta + by_v_guide_offset_L6_theta_)
        + phi_guide_offset_L6_theta_;
    const Lanes n_guide_offset_L8_theta_ = eta_row*(by_q_guide_offset_L8_theta_*eta + by_v_guide_offset_L8_theta_)
        + phi_guide_offset_L8_theta_;

    /* L U */
    const Lanes scale_L8_theta_ = n_L8_theta_L8_theta_;
    *rare |= ~(lanes_fabs(scale_L8_theta_) > SINGULAR * lanes_fabs(n_L8_theta_L8_theta_));
    const Lanes inverse_pivot_L8_theta_ = 1.0/scale_L8_theta_;
    lin->lu[0] = inverse_pivot_L8_theta_;
    const Lanes l_L6_theta_L8_theta_ = inverse_pivot_L8_theta_*n_L6_theta_L8_theta_;
    lin->lu[1] = l_L6_theta_L8_theta_;
    lin->lu[2] = n_L8_theta_L6_theta_;
    const Lanes l_guide_offset_L8_theta_ = inverse_pivot_L8_theta_*n_guide_offset_L8_theta_;
    lin->lu[3] = l_guide_offset_L8_theta_;
    const Lanes scale_L2_theta_ = n_L2_theta_L2_theta_;
    *rare |= ~(lanes_fabs(scale_L2_theta_) > SINGULAR * lanes_fabs(n_L2_theta_L2_theta_));
    const Lanes inverse_pivot_L2_theta_ = 1.0/scale_L2_theta_;
    lin->lu[4] = inverse_pivot_L2_theta_;
    const Lanes l_L7_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L7_theta_L2_theta_;
    lin->lu[5] = l_L7_theta_L2_theta_;
    lin->lu[6] = n_L2_theta_L7_theta_;
    const Lanes l_L6_theta_L2_theta_ = inverse_pivot_L2_theta_*n_L6_theta_L2_theta_;
    lin->lu[7] = l_L6_theta_L2_theta_;
    lin->lu[8] = n_L2_theta_L6_theta_;
    const Lanes scale_L7_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L7_theta_ + n_L7_theta_L7_theta_;
    *rare |= ~(lanes_fabs(scale_L7_theta_) > SINGULAR * lanes_fabs(n_L7_theta_L7_theta_));
    const Lanes inverse_pivot_L7_theta_ = 1.0/scale_L7_theta_;
    lin->lu[9] = inverse_pivot_L7_theta_;
    const Lanes l_L3_theta_L7_theta_ = inverse_pivot_L7_theta_*n_L3_theta_L7_theta_;
    lin->lu[10] = l_L3_theta_L7_theta_;
    lin->lu[11] = n_L7_theta_L3_theta_;
    const Lanes l_L6_theta_L7_theta_ = inverse_pivot_L7_theta_*(-l_L6_theta_L2_theta_*n_L2_theta_L7_theta_
        + n_L6_theta_L7_theta_);
    lin->lu[12] = l_L6_theta_L7_theta_;
    const Lanes u_L7_theta_L6_theta_ = -l_L7_theta_L2_theta_*n_L2_theta_L6_theta_ + n_L7_theta_L6_theta_;
    lin->lu[13] = u_L7_theta_L6_theta_;
    const Lanes scale_L3_theta_ = -l_L3_theta_L7_theta_*n_L7_theta_L3_theta_ + n_L3_theta_L3_theta_;
    *rare |= ~(lanes_fabs(scale_L3_theta_) > SINGULAR * lanes_fabs(n_L3_theta_L3_theta_));
    const Lanes inverse_pivot_L3_theta_ = 1.0/scale_L3_theta_;
    lin->lu[14] = inverse_pivot_L3_theta_;
    const Lanes l_L6_theta_L3_theta_ = inverse_pivot_L3_theta_*(-l_L6_theta_L7_theta_*n_L7_theta_L3_theta_
        + n_L6_theta_L3_theta_);
    lin->lu[15] = l_L6_theta_L3_theta_;
    const Lanes u_L3_theta_L6_theta_ = -l_L3_theta_L7_theta_*u_L7_theta_L6_theta_ + n_L3_theta_L6_theta_;
    lin->lu[16] = u_L3_theta_L6_theta_;
    const Lanes scale_L6_theta_ = -l_L6_theta_L2_theta_*n_L2_theta_L6_theta_
        - l_L6_theta_L3_theta_*u_L3_theta_L6_theta_ - l_L6_theta_L7_theta_*u_L7_theta_L6_theta_
        - l_L6_theta_L8_theta_*n_L8_theta_L6_theta_ + n_L6_theta_L6_theta_;
    *rare |= ~(lanes_fabs(scale_L6_theta_) > SINGULAR * lanes_fabs(n_L6_theta_L6_theta_));
    const Lanes inverse_pivot_L6_theta_ = 1.0/scale_L6_theta_;
    lin->lu[17] = inverse_pivot_L6_theta_;
    const Lanes l_guide_offset_L6_theta_ = inverse_pivot_L6_theta_*(-l_guide_offset_L8_theta_*n_L8_theta_L6_theta_
        + n_guide_offset_L6_theta_);
    lin->lu[18] = l_guide_offset_L6_theta_;
    const Lanes u_L6_theta_guide_offset_ = -l_L6_theta_L8_theta_*phi_guide_offset_L8_theta_
        + phi_guide_offset_L6_theta_;
    lin->lu[19] = u_L6_theta_guide_offset_;
    const Lanes scale_guide_offset_ = -l_guide_offset_L6_theta_*u_L6_theta_guide_offset_
        - l_guide_offset_L8_theta_*phi_guide_offset_L8_theta_;
    *rare |= ~((lanes_fabs(scale_guide_offset_) > 0.0) & (lanes_fabs(scale_guide_offset_) < INFINITY));
    const Lanes inverse_pivot_guide_offset_ = 1.0/scale_guide_offset_;
    lin->lu[20] = inverse_pivot_guide_offset_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_guide_offset_L8_theta_ = lin->value[7];
    const Lanes inverse_pivot_L8_theta_ = lin->lu[0];
    const Lanes l_L6_theta_L8_theta_ = lin->lu[1];
    const Lanes n_L8_theta_L6_theta_ = lin->lu[2];
    const Lanes l_guide_offset_L8_theta_ = lin->lu[3];
    const Lanes inverse_pivot_L2_theta_ = lin->lu[4];
    const Lanes l_L7_theta_L2_theta_ = lin->lu[5];
    const Lanes n_L2_theta_L7_theta_ = lin->lu[6];
    const Lanes l_L6_theta_L2_theta_ = lin->lu[7];
    const Lanes n_L2_theta_L6_theta_ = lin->lu[8];
    const Lanes inverse_pivot_L7_theta_ = lin->lu[9];
    const Lanes l_L3_theta_L7_theta_ = lin->lu[10];
    const Lanes n_L7_theta_L3_theta_ = lin->lu[11];
    const Lanes l_L6_theta_L7_theta_ = lin->lu[12];
    const Lanes u_L7_theta_L6_theta_ = lin->lu[13];
    const Lanes inverse_pivot_L3_theta_ = lin->lu[14];
    const Lanes l_L6_theta_L3_theta_ = lin->lu[15];
    const Lanes u_L3_theta_L6_theta_ = lin->lu[16];
    const Lanes inverse_pivot_L6_theta_ = lin->lu[17];
    const Lanes l_guide_offset_L6_theta_ = lin->lu[18];
    const Lanes u_L6_theta_guide_offset_ = lin->lu[19];
    const Lanes inverse_pivot_guide_offset_ = lin->lu[20];

    /* forward */
    const Lanes b_L8_theta_ = x[2];
    const Lanes b_L2_theta_ = x[3];
    const Lanes b_L7_theta_ = -b_L2_theta_*l_L7_theta_L2_theta_ + x[1];
    const Lanes b_L3_theta_ = -b_L7_theta_*l_L3_theta_L7_theta_ + x[4];
    const Lanes b_L6_theta_ = -b_L2_theta_*l_L6_theta_L2_theta_ - b_L3_theta_*l_L6_theta_L3_theta_
        - b_L7_theta_*l_L6_theta_L7_theta_ - b_L8_theta_*l_L6_theta_L8_theta_ + x[0];
    const Lanes b_guide_offset_ = -b_L6_theta_*l_guide_offset_L6_theta_ - b_L8_theta_*l_guide_offset_L8_theta_ + x[5];

    /* backward */
    const Lanes x_guide_offset_ = b_guide_offset_*inverse_pivot_guide_offset_;
    x[5] = x_guide_offset_;
    const Lanes x_L6_theta_ = inverse_pivot_L6_theta_*(b_L6_theta_ - u_L6_theta_guide_offset_*x_guide_offset_);
    x[0] = x_L6_theta_;
    const Lanes x_L3_theta_ = inverse_pivot_L3_theta_*(b_L3_theta_ - u_L3_theta_L6_theta_*x_L6_theta_);
    x[4] = x_L3_theta_;
    const Lanes x_L7_theta_ = inverse_pivot_L7_theta_*(b_L7_theta_ - n_L7_theta_L3_theta_*x_L3_theta_
        - u_L7_theta_L6_theta_*x_L6_theta_);
    x[1] = x_L7_theta_;
    const Lanes x_L2_theta_ = inverse_pivot_L2_theta_*(b_L2_theta_ - n_L2_theta_L6_theta_*x_L6_theta_
        - n_L2_theta_L7_theta_*x_L7_theta_);
    x[3] = x_L2_theta_;
    const Lanes x_L8_theta_ = inverse_pivot_L8_theta_*(b_L8_theta_ - n_L8_theta_L6_theta_*x_L6_theta_
        - phi_guide_offset_L8_theta_*x_guide_offset_);
    x[2] = x_L8_theta_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_L6_theta_L7_theta_ = lin->value[0];
    const Lanes mass_L6_theta_L2_theta_ = lin->value[1];
    const Lanes mass_L7_theta_L2_theta_ = lin->value[2];
    const Lanes mass_L6_theta_L3_theta_ = lin->value[3];
    const Lanes mass_L7_theta_L3_theta_ = lin->value[4];
    const Lanes mass_L6_theta_L8_theta_ = lin->value[5];
    const Lanes phi_guide_offset_L6_theta_ = lin->value[6];
    const Lanes phi_guide_offset_L8_theta_ = lin->value[7];
    const Lanes by_q_guide_offset_L6_theta_ = lin->value[8];
    const Lanes by_q_guide_offset_L8_theta_ = lin->value[9];
    const Lanes by_q_L6_theta_L6_theta_ = lin->value[10];
    const Lanes by_q_L6_theta_L7_theta_ = lin->value[11];
    const Lanes by_q_L6_theta_L2_theta_ = lin->value[12];
    const Lanes by_q_L6_theta_L3_theta_ = lin->value[13];
    const Lanes by_q_L6_theta_L8_theta_ = lin->value[14];
    const Lanes by_q_L7_theta_L6_theta_ = lin->value[15];
    const Lanes by_q_L7_theta_L7_theta_ = lin->value[16];
    const Lanes by_q_L7_theta_L2_theta_ = lin->value[17];
    const Lanes by_q_L7_theta_L3_theta_ = lin->value[18];
    const Lanes by_q_L8_theta_L8_theta_ = lin->value[19];
    const Lanes by_q_L8_theta_L6_theta_ = lin->value[20];
    const Lanes by_q_L2_theta_L6_theta_ = lin->value[21];
    const Lanes by_q_L2_theta_L7_theta_ = lin->value[22];
    const Lanes by_q_L2_theta_L2_theta_ = lin->value[23];
    const Lanes by_q_L3_theta_L6_theta_ = lin->value[24];
    const Lanes by_q_L3_theta_L7_theta_ = lin->value[25];
    const Lanes by_q_L3_theta_L3_theta_ = lin->value[26];
    const Lanes by_t_L6_theta_ = lin->value[45];
    const Lanes by_t_L7_theta_ = lin->value[46];
    const Lanes by_t_L2_theta_ = lin->value[47];
    const Lanes by_t_L3_theta_ = lin->value[48];
    const Lanes power_q_0_L6_theta_ = lin->value[49];
    const Lanes power_q_0_L7_theta_ = lin->value[50];
    const Lanes power_q_0_L2_theta_ = lin->value[51];
    const Lanes power_q_0_L3_theta_ = lin->value[52];
    const Lanes power_q_2_L6_theta_ = lin->value[53];
    const Lanes power_q_2_L7_theta_ = lin->value[54];
    const Lanes power_q_2_L2_theta_ = lin->value[55];
    const Lanes power_q_2_L3_theta_ = lin->value[56];
    const Lanes power_v_0_L6_theta_ = lin->value[57];
    const Lanes power_v_0_L7_theta_ = lin->value[58];
    const Lanes power_v_0_L2_theta_ = lin->value[59];
    const Lanes power_v_0_L3_theta_ = lin->value[60];
    const Lanes power_v_2_L6_theta_ = lin->value[61];
    const Lanes power_v_2_L7_theta_ = lin->value[62];
    const Lanes power_v_2_L2_theta_ = lin->value[63];
    const Lanes power_v_2_L3_theta_ = lin->value[64];
    const Lanes power_t_0_ = lin->value[65];
    const Lanes power_t_2_ = lin->value[66];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[6];
    const Lanes shifted_L6_theta_ = -p->beta_squared_*eta*r[0] + r[5];
    const Lanes shifted_L8_theta_ = -p->beta_squared_*eta*r[2] + r[7];
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

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
