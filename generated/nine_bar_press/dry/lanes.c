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
    Lanes omega;
    Lanes omega4;
    Lanes l5;
    Lanes c;
    Lanes L1_mass;
    Lanes L1_inertia;
    Lanes L2_mass;
    Lanes L2_inertia;
    Lanes L3_mass;
    Lanes L3_inertia;
    Lanes L4_mass;
    Lanes L4_inertia;
    Lanes L6_mass;
    Lanes L6_inertia;
    Lanes L7_mass;
    Lanes L7_inertia;
    Lanes L8_mass;
    Lanes L8_inertia;
    Lanes S9_mass;
    Lanes S9_inertia;
    Lanes L1_length;
    Lanes L2_length;
    Lanes L3_length;
    Lanes L4_length;
    Lanes L6_length;
    Lanes L7_length;
    Lanes L8_length;
    Lanes alpha;
    Lanes beta;
    Lanes O4_y;
    Lanes O6_x;
    Lanes guide_axis_y;
    Lanes pin_radius;
    Lanes pin_clearance;
    Lanes pin_length;
    Lanes aluminium_E;
    Lanes pin_bearing_material_E;
    Lanes aluminium_nu;
    Lanes pin_bearing_material_nu;
    Lanes pin_journal_material_E;
    Lanes pin_journal_material_nu;
    Lanes dry_normal_restitution;
    Lanes dry_normal_exponent;
    Lanes dry_friction_mu;
    Lanes dry_friction_v0;
    Lanes dry_friction_v1;
    Lanes velocity_floor;
    Lanes gravity_y;
    Lanes steel_45_E;
    Lanes steel_45_nu;
    Lanes pin_bearing_material;
    Lanes pin_journal_material;
    Lanes guess_L2_theta;
    Lanes guess_L3_theta;
    Lanes guess_L6_theta;
    Lanes guess_L7_theta;
    Lanes guess_L8_theta;
    Lanes L1_head_s_x;
    Lanes L2_head_s_x;
    Lanes L3_head_s_x;
    Lanes L4_head_s_x;
    Lanes L6_head_s_x;
    Lanes L7_head_s_x;
    Lanes L8_head_s_x;
    Lanes R_j_pin;
    Lanes dry_pin_K;
    Lanes dry_pin_hysteresis;
    Lanes dry_pin_friction_slope;
    Lanes weight_L1_y;
    Lanes weight_L2_y;
    Lanes weight_L3_y;
    Lanes weight_L4_y;
    Lanes weight_L6_y;
    Lanes weight_L7_y;
    Lanes weight_L8_y;
    Lanes weight_S9_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_L1_mass;
    Lanes inverse_L2_mass;
    Lanes inverse_L3_mass;
    Lanes inverse_L4_mass;
    Lanes inverse_S9_mass;
    Lanes inverse_S9_inertia;
    Lanes inverse_L2_inertia;
    Lanes inverse_L3_inertia;
    Lanes inverse_L6_mass;
    Lanes inverse_L8_mass;
    Lanes inverse_L1_inertia;
    Lanes inverse_L4_inertia;
    Lanes inverse_L6_inertia;
    Lanes inverse_L7_mass;
    Lanes inverse_L8_inertia;
    Lanes inverse_L7_inertia;
    Lanes L6_head_span_x;
    Lanes L7_com_span_x;
    Lanes L7_tail_span_x;
    Lanes L2_com_span_x;
    Lanes L3_com_span_x;
    Lanes L8_head_span_x;
    Lanes L1_head_span_x;
    Lanes L2_tail_span_x;
    Lanes L4_head_span_x;
    Lanes L3_tail_span_x;
    Lanes inertia_L1_L1;
    Lanes inertia_L6_L6;
    Lanes inertia_L6_L7;
    Lanes inertia_L6_L2;
    Lanes inertia_L7_L7;
    Lanes inertia_L7_L2;
    Lanes inertia_L2_L2;
    Lanes inertia_L6_L3;
    Lanes inertia_L7_L3;
    Lanes inertia_L3_L3;
    Lanes inertia_L4_L4;
    Lanes inertia_L6_L8;
    Lanes inertia_L8_L8;
    Lanes mass_crank1_crank1;
    Lanes mass_L6_L6;
    Lanes mass_L7_L7;
    Lanes mass_L2_L2;
    Lanes mass_L3_L3;
    Lanes mass_crank4_crank4;
    Lanes mass_L8_L8;
    Lanes weight_L1__across;
    Lanes weight_L6__across;
    Lanes weight_L7__across;
    Lanes weight_L2__across;
    Lanes weight_L3__across;
    Lanes weight_L4__across;
    Lanes weight_L8__across;
    Lanes inverse_mass_L8_L8;
    Lanes inverse_mass_L2_L2;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius;
    case 1:
        return (1.0/10.0)*p->pin_radius;
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
static inline LanePinForce dry_A(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g)
{
    (void)side, (void)g;
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius;
    const Lanes a_j = -0.5*delta + p->R_j_pin;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent, p->dry_pin_K,
        p->dry_pin_hysteresis, side, g, 0, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu, p->dry_friction_v0, p->dry_pin_friction_slope, side, g, 1,
        &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint A: what each lane does not have is passed over where no lane has it. */
static void clearance_A(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    silence(g, 0, 5); /* what does not act does not switch */
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = is_touching(latch, delta);
    if (any_of(touching)) {
        Lanes film_g[N_SWITCHES];
        set_aside(g, film_g, 0, 5);
        LanePinForce dry = dry_A(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
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
static inline LanePinForce dry_B(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g)
{
    (void)side, (void)g;
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius;
    const Lanes a_j = -0.5*delta + p->R_j_pin;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent, p->dry_pin_K,
        p->dry_pin_hysteresis, side, g, 5, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu, p->dry_friction_v0, p->dry_pin_friction_slope, side, g, 6,
        &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint B: what each lane does not have is passed over where no lane has it. */
static void clearance_B(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    silence(g, 5, 10); /* what does not act does not switch */
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = is_touching(latch, delta);
    if (any_of(touching)) {
        Lanes film_g[N_SWITCHES];
        set_aside(g, film_g, 5, 10);
        LanePinForce dry = dry_B(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
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
    const Lanes L6_theta = q[0];
    const Lanes L8_theta = q[2];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L8_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_L6 = cosines_0;
    const Lanes cos_theta_L8 = cosines_1;
    const Lanes span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const Lanes span_L8_head_x = p->L8_head_span_x*cos_theta_L8;

    /* rows */
    out[0] = -span_L6_head_x - span_L8_head_x;  /* guide.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes L6_theta = q[0];
    const Lanes L6_omega = v[0];
    const Lanes L8_theta = q[2];
    const Lanes L8_omega = v[2];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L8_theta, &sines_1, &cosines_1, rare);
    const Lanes sin_theta_L6 = sines_0;
    const Lanes sin_theta_L8 = sines_1;
    const Lanes span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const Lanes span_L8_head_y = p->L8_head_span_x*sin_theta_L8;

    /* rows */
    out[0] = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;  /* guide.offset */
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
    const Lanes L6_theta = q[0];
    const Lanes L6_omega = v[0];
    const Lanes L7_theta = q[1];
    const Lanes L7_omega = v[1];
    const Lanes L8_theta = q[2];
    const Lanes L8_omega = v[2];
    const Lanes L2_theta = q[3];
    const Lanes L2_omega = v[3];
    const Lanes L3_theta = q[4];
    const Lanes L3_omega = v[4];

    /* directions, arms, drives */
    const Lanes crank1_value = p->omega*t - 0.689754120388159;
    const Lanes crank4_value = p->omega4*t + 3.4814082589530893;
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank1_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank4_value, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(L6_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(L7_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(L8_theta, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(L2_theta, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(L3_theta, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_L1 = cosines_0;
    const Lanes sin_theta_L1 = sines_0;
    const Lanes cos_theta_L4 = cosines_1;
    const Lanes sin_theta_L4 = sines_1;
    const Lanes cos_theta_L6 = cosines_2;
    const Lanes sin_theta_L6 = sines_2;
    const Lanes cos_theta_L7 = cosines_3;
    const Lanes sin_theta_L7 = sines_3;
    const Lanes cos_theta_L8 = cosines_4;
    const Lanes sin_theta_L8 = sines_4;
    const Lanes cos_theta_L2 = cosines_5;
    const Lanes sin_theta_L2 = sines_5;
    const Lanes cos_theta_L3 = cosines_6;
    const Lanes sin_theta_L3 = sines_6;
    const Lanes crank1_rate = p->omega;
    const Lanes crank1_acceleration = all_of(0.0);
    const Lanes crank4_rate = p->omega4;
    const Lanes crank4_acceleration = all_of(0.0);
    const Lanes span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const Lanes span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const Lanes L6_head_x = p->O6_x + span_L6_head_x;
    const Lanes L6_head_vx = -L6_omega*span_L6_head_y;
    const Lanes L6_head_vy = L6_omega*span_L6_head_x;
    const Lanes span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const Lanes span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;
    const Lanes L7_tail_x = L6_head_x + span_L7_tail_x;
    const Lanes L7_tail_vx = L6_head_vx - L7_omega*span_L7_tail_y;
    const Lanes L7_tail_y = span_L6_head_y + span_L7_tail_y;
    const Lanes L7_tail_vy = L6_head_vy + L7_omega*span_L7_tail_x;
    const Lanes span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const Lanes span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const Lanes span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const Lanes span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const Lanes L1_head_vx = -crank1_rate*span_L1_head_y;
    const Lanes L1_head_vy = crank1_rate*span_L1_head_x;
    const Lanes span_L2_tail_x = p->L2_tail_span_x*cos_theta_L2;
    const Lanes span_L2_tail_y = p->L2_tail_span_x*sin_theta_L2;
    const Lanes L2_tail_x = L7_tail_x + span_L2_tail_x;
    const Lanes L2_tail_vx = -L2_omega*span_L2_tail_y + L7_tail_vx;
    const Lanes L2_tail_y = L7_tail_y + span_L2_tail_y;
    const Lanes L2_tail_vy = L2_omega*span_L2_tail_x + L7_tail_vy;
    const Lanes span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const Lanes span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const Lanes L4_head_vx = -crank4_rate*span_L4_head_y;
    const Lanes L4_head_y = p->O4_y + span_L4_head_y;
    const Lanes L4_head_vy = crank4_rate*span_L4_head_x;
    const Lanes span_L3_tail_x = p->L3_tail_span_x*cos_theta_L3;
    const Lanes span_L3_tail_y = p->L3_tail_span_x*sin_theta_L3;
    const Lanes L3_tail_x = L7_tail_x + span_L3_tail_x;
    const Lanes L3_tail_vx = -L3_omega*span_L3_tail_y + L7_tail_vx;
    const Lanes L3_tail_y = L7_tail_y + span_L3_tail_y;
    const Lanes L3_tail_vy = L3_omega*span_L3_tail_x + L7_tail_vy;
    const Lanes cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const Lanes sin_L7_less_L6 = cos_theta_L6*sin_theta_L7 - cos_theta_L7*sin_theta_L6;
    const Lanes dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const Lanes cross_L6_L7 = p->inertia_L6_L7*sin_L7_less_L6;
    const Lanes cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const Lanes sin_L2_less_L6 = -cos_theta_L2*sin_theta_L6 + cos_theta_L6*sin_theta_L2;
    const Lanes dot_L6_L2 = cos_L2_less_L6*p->inertia_L6_L2;
    const Lanes cross_L6_L2 = p->inertia_L6_L2*sin_L2_less_L6;
    const Lanes cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const Lanes sin_L2_less_L7 = -cos_theta_L2*sin_theta_L7 + cos_theta_L7*sin_theta_L2;
    const Lanes dot_L7_L2 = cos_L2_less_L7*p->inertia_L7_L2;
    const Lanes cross_L7_L2 = p->inertia_L7_L2*sin_L2_less_L7;
    const Lanes cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const Lanes sin_L3_less_L6 = -cos_theta_L3*sin_theta_L6 + cos_theta_L6*sin_theta_L3;
    const Lanes dot_L6_L3 = cos_L3_less_L6*p->inertia_L6_L3;
    const Lanes cross_L6_L3 = p->inertia_L6_L3*sin_L3_less_L6;
    const Lanes cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const Lanes sin_L3_less_L7 = -cos_theta_L3*sin_theta_L7 + cos_theta_L7*sin_theta_L3;
    const Lanes dot_L7_L3 = cos_L3_less_L7*p->inertia_L7_L3;
    const Lanes cross_L7_L3 = p->inertia_L7_L3*sin_L3_less_L7;
    const Lanes cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const Lanes sin_L8_less_L6 = cos_theta_L6*sin_theta_L8 - cos_theta_L8*sin_theta_L6;
    const Lanes dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;
    const Lanes cross_L6_L8 = p->inertia_L6_L8*sin_L8_less_L6;

    /* clearance joint A */
    const Lanes e_A_x = L2_tail_x - span_L1_head_x;
    const Lanes e_A_y = L2_tail_y - span_L1_head_y;
    const Lanes edot_A_x = -L1_head_vx + L2_tail_vx;
    const Lanes edot_A_y = -L1_head_vy + L2_tail_vy;
    clearance_A(e_A_x, e_A_y, edot_A_x, edot_A_y, crank1_rate, L2_omega, &memory->latch[0], p, side, g,
        &aside->clearance[0]);
    const Lanes F_A_x = aside->clearance[0].Fx;
    const Lanes F_A_y = aside->clearance[0].Fy;
    const Lanes M_A_first = aside->clearance[0].moment_first;
    const Lanes M_A_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_A_x*edot_A_x + F_A_y*edot_A_y + L2_omega*M_A_second + M_A_first*crank1_rate;

    /* clearance joint B */
    const Lanes e_B_x = L3_tail_x - span_L4_head_x;
    const Lanes e_B_y = L3_tail_y - L4_head_y;
    const Lanes edot_B_x = L3_tail_vx - L4_head_vx;
    const Lanes edot_B_y = L3_tail_vy - L4_head_vy;
    clearance_B(e_B_x, e_B_y, edot_B_x, edot_B_y, crank4_rate, L3_omega, &memory->latch[1], p, side, g,
        &aside->clearance[1]);
    const Lanes F_B_x = aside->clearance[1].Fx;
    const Lanes F_B_y = aside->clearance[1].Fy;
    const Lanes M_B_first = aside->clearance[1].moment_first;
    const Lanes M_B_second = aside->clearance[1].moment_second;
    aside->clearance[1].power = F_B_x*edot_B_x + F_B_y*edot_B_y + L3_omega*M_B_second + M_B_first*crank4_rate;

    /* constraints: gamma */
    const Lanes rhs_guide_offset = -(L6_omega * L6_omega)*span_L6_head_x - (L8_omega * L8_omega)*span_L8_head_x;

    /* L D L^T of the KKT matrix */
    const Lanes l_L6_theta__L8_theta = dot_L6_L8*p->inverse_mass_L8_L8;
    const Lanes l_guide_offset__L8_theta = p->inverse_mass_L8_L8*span_L8_head_y;
    const Lanes l_L7_theta__L2_theta = dot_L7_L2*p->inverse_mass_L2_L2;
    const Lanes l_L6_theta__L2_theta = dot_L6_L2*p->inverse_mass_L2_L2;
    const Lanes pivot_L7_theta = -dot_L7_L2*l_L7_theta__L2_theta + p->mass_L7_L7;
    const Lanes determinant_L7_theta__L3_theta = -(dot_L7_L3 * dot_L7_L3) + p->mass_L3_L3*pivot_L7_theta;
    const Lanes inverse_L7_theta__L3_theta = 1.0/determinant_L7_theta__L3_theta;
    const Lanes inverse_pivot_L7_theta = inverse_L7_theta__L3_theta*p->mass_L3_L3;
    const Lanes inverse_pivot_L3_theta = inverse_L7_theta__L3_theta*pivot_L7_theta;
    const Lanes inverse_cross_L7_theta__L3_theta = -dot_L7_L3*inverse_L7_theta__L3_theta;
    const Lanes w_L6_theta__L7_theta = dot_L6_L7 - dot_L7_L2*l_L6_theta__L2_theta;
    const Lanes l_L6_theta__L7_theta = dot_L6_L3*inverse_cross_L7_theta__L3_theta
        + inverse_pivot_L7_theta*w_L6_theta__L7_theta;
    const Lanes l_L6_theta__L3_theta = dot_L6_L3*inverse_pivot_L3_theta
        + inverse_cross_L7_theta__L3_theta*w_L6_theta__L7_theta;
    const Lanes inverse_pivot_L6_theta = 1.0/(-dot_L6_L2*l_L6_theta__L2_theta - dot_L6_L3*l_L6_theta__L3_theta
        - dot_L6_L8*l_L6_theta__L8_theta - l_L6_theta__L7_theta*w_L6_theta__L7_theta + p->mass_L6_L6);
    const Lanes w_guide_offset__L6_theta = -dot_L6_L8*l_guide_offset__L8_theta + span_L6_head_y;
    const Lanes l_guide_offset__L6_theta = inverse_pivot_L6_theta*w_guide_offset__L6_theta;
    const Lanes scale_guide_offset = l_guide_offset__L6_theta*w_guide_offset__L6_theta
        + l_guide_offset__L8_theta*span_L8_head_y;
    *rare |= ~((scale_guide_offset > 0.0) & (scale_guide_offset < INFINITY));
    const Lanes inverse_pivot_guide_offset = 1.0/scale_guide_offset;

    /* forward substitution */
    const Lanes z_L8_theta = -(L6_omega * L6_omega)*cross_L6_L8 + cos_theta_L8*p->weight_L8__across;
    const Lanes z_L2_theta = -F_A_x*span_L2_tail_y + F_A_y*span_L2_tail_x - (L6_omega * L6_omega)*cross_L6_L2
        - (L7_omega * L7_omega)*cross_L7_L2 + M_A_second + cos_theta_L2*p->weight_L2__across;
    const Lanes z_L7_theta = (L2_omega * L2_omega)*cross_L7_L2 + (L3_omega * L3_omega)*cross_L7_L3
        - (L6_omega * L6_omega)*cross_L6_L7 + cos_theta_L7*p->weight_L7__across - l_L7_theta__L2_theta*z_L2_theta
        + span_L7_tail_x*(F_A_y + F_B_y) - span_L7_tail_y*(F_A_x + F_B_x);
    const Lanes z_L3_theta = -F_B_x*span_L3_tail_y + F_B_y*span_L3_tail_x - (L6_omega * L6_omega)*cross_L6_L3
        - (L7_omega * L7_omega)*cross_L7_L3 + M_B_second + cos_theta_L3*p->weight_L3__across;
    const Lanes z_L6_theta = (L2_omega * L2_omega)*cross_L6_L2 + (L3_omega * L3_omega)*cross_L6_L3
        + (L7_omega * L7_omega)*cross_L6_L7 + (L8_omega * L8_omega)*cross_L6_L8 + cos_theta_L6*p->weight_L6__across
        - l_L6_theta__L2_theta*z_L2_theta - l_L6_theta__L3_theta*z_L3_theta - l_L6_theta__L7_theta*z_L7_theta
        - l_L6_theta__L8_theta*z_L8_theta + span_L6_head_x*(F_A_y + F_B_y) - span_L6_head_y*(F_A_x + F_B_x);
    const Lanes z_guide_offset = -l_guide_offset__L6_theta*z_L6_theta - l_guide_offset__L8_theta*z_L8_theta
        + rhs_guide_offset;

    /* backward substitution */
    const Lanes lambda_guide_offset = -inverse_pivot_guide_offset*z_guide_offset;
    const Lanes acceleration_L6_theta = inverse_pivot_L6_theta*z_L6_theta
        - l_guide_offset__L6_theta*lambda_guide_offset;
    const Lanes acceleration_L3_theta = -acceleration_L6_theta*l_L6_theta__L3_theta
        + inverse_cross_L7_theta__L3_theta*z_L7_theta + inverse_pivot_L3_theta*z_L3_theta;
    const Lanes acceleration_L7_theta = -acceleration_L6_theta*l_L6_theta__L7_theta
        + inverse_cross_L7_theta__L3_theta*z_L3_theta + inverse_pivot_L7_theta*z_L7_theta;
    const Lanes acceleration_L2_theta = -acceleration_L6_theta*l_L6_theta__L2_theta
        - acceleration_L7_theta*l_L7_theta__L2_theta + p->inverse_mass_L2_L2*z_L2_theta;
    const Lanes acceleration_L8_theta = -acceleration_L6_theta*l_L6_theta__L8_theta + p->inverse_mass_L8_L8*z_L8_theta
        - l_guide_offset__L8_theta*lambda_guide_offset;

    /* results */
    a[0] = acceleration_L6_theta;
    a[1] = acceleration_L7_theta;
    a[2] = acceleration_L8_theta;
    a[3] = acceleration_L2_theta;
    a[4] = acceleration_L3_theta;
    aside->lambda[0] = lambda_guide_offset;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = crank1_rate*(-F_A_x*span_L1_head_y + F_A_y*span_L1_head_x - M_A_first
        - cos_theta_L1*p->weight_L1__across + crank1_acceleration*p->mass_crank1_crank1)
        + crank4_rate*(-F_B_x*span_L4_head_y + F_B_y*span_L4_head_x - M_B_first - cos_theta_L4*p->weight_L4__across
        + crank4_acceleration*p->mass_crank4_crank4);
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
    const Lanes L6_theta = q[0];
    const Lanes L6_omega = v[0];
    const Lanes L7_theta = q[1];
    const Lanes L8_theta = q[2];
    const Lanes L8_omega = v[2];
    const Lanes L2_theta = q[3];
    const Lanes L3_theta = q[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(L6_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(L7_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(L8_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(L2_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(L3_theta, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_L6 = cosines_0;
    const Lanes sin_theta_L6 = sines_0;
    const Lanes cos_theta_L7 = cosines_1;
    const Lanes sin_theta_L7 = sines_1;
    const Lanes cos_theta_L8 = cosines_2;
    const Lanes sin_theta_L8 = sines_2;
    const Lanes cos_theta_L2 = cosines_3;
    const Lanes sin_theta_L2 = sines_3;
    const Lanes cos_theta_L3 = cosines_4;
    const Lanes sin_theta_L3 = sines_4;
    const Lanes span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const Lanes span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const Lanes span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const Lanes span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const Lanes cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const Lanes dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const Lanes cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const Lanes dot_L6_L2 = cos_L2_less_L6*p->inertia_L6_L2;
    const Lanes cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const Lanes dot_L7_L2 = cos_L2_less_L7*p->inertia_L7_L2;
    const Lanes cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const Lanes dot_L6_L3 = cos_L3_less_L6*p->inertia_L6_L3;
    const Lanes cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const Lanes dot_L7_L3 = cos_L3_less_L7*p->inertia_L7_L3;
    const Lanes cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const Lanes dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;

    /* Phi and Phi_dot */
    const Lanes phi_guide_offset = -span_L6_head_x - span_L8_head_x;
    const Lanes phi_dot_guide_offset = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;

    /* L D L^T of the KKT matrix */
    const Lanes l_L6_theta__L8_theta = dot_L6_L8*p->inverse_mass_L8_L8;
    const Lanes l_guide_offset__L8_theta = p->inverse_mass_L8_L8*span_L8_head_y;
    const Lanes l_L7_theta__L2_theta = dot_L7_L2*p->inverse_mass_L2_L2;
    const Lanes l_L6_theta__L2_theta = dot_L6_L2*p->inverse_mass_L2_L2;
    const Lanes pivot_L7_theta = -dot_L7_L2*l_L7_theta__L2_theta + p->mass_L7_L7;
    const Lanes determinant_L7_theta__L3_theta = -(dot_L7_L3 * dot_L7_L3) + p->mass_L3_L3*pivot_L7_theta;
    const Lanes inverse_L7_theta__L3_theta = 1.0/determinant_L7_theta__L3_theta;
    const Lanes inverse_pivot_L7_theta = inverse_L7_theta__L3_theta*p->mass_L3_L3;
    const Lanes inverse_pivot_L3_theta = inverse_L7_theta__L3_theta*pivot_L7_theta;
    const Lanes inverse_cross_L7_theta__L3_theta = -dot_L7_L3*inverse_L7_theta__L3_theta;
    const Lanes w_L6_theta__L7_theta = dot_L6_L7 - dot_L7_L2*l_L6_theta__L2_theta;
    const Lanes l_L6_theta__L7_theta = dot_L6_L3*inverse_cross_L7_theta__L3_theta
        + inverse_pivot_L7_theta*w_L6_theta__L7_theta;
    const Lanes l_L6_theta__L3_theta = dot_L6_L3*inverse_pivot_L3_theta
        + inverse_cross_L7_theta__L3_theta*w_L6_theta__L7_theta;
    const Lanes inverse_pivot_L6_theta = 1.0/(-dot_L6_L2*l_L6_theta__L2_theta - dot_L6_L3*l_L6_theta__L3_theta
        - dot_L6_L8*l_L6_theta__L8_theta - l_L6_theta__L7_theta*w_L6_theta__L7_theta + p->mass_L6_L6);
    const Lanes w_guide_offset__L6_theta = -dot_L6_L8*l_guide_offset__L8_theta + span_L6_head_y;
    const Lanes l_guide_offset__L6_theta = inverse_pivot_L6_theta*w_guide_offset__L6_theta;
    const Lanes scale_guide_offset = l_guide_offset__L6_theta*w_guide_offset__L6_theta
        + l_guide_offset__L8_theta*span_L8_head_y;
    *rare |= ~((scale_guide_offset > 0.0) & (scale_guide_offset < INFINITY));
    const Lanes inverse_pivot_guide_offset = 1.0/scale_guide_offset;

    /* backward substitution */
    const Lanes dq_lambda_guide_offset = -inverse_pivot_guide_offset*phi_guide_offset;
    const Lanes dq_acceleration_L6_theta = -dq_lambda_guide_offset*l_guide_offset__L6_theta;
    const Lanes dq_acceleration_L3_theta = -dq_acceleration_L6_theta*l_L6_theta__L3_theta;
    const Lanes dq_acceleration_L7_theta = -dq_acceleration_L6_theta*l_L6_theta__L7_theta;
    const Lanes dq_acceleration_L2_theta = -dq_acceleration_L6_theta*l_L6_theta__L2_theta
        - dq_acceleration_L7_theta*l_L7_theta__L2_theta;
    const Lanes dq_acceleration_L8_theta = -dq_acceleration_L6_theta*l_L6_theta__L8_theta
        - dq_lambda_guide_offset*l_guide_offset__L8_theta;

    /* backward substitution */
    const Lanes dv_lambda_guide_offset = -inverse_pivot_guide_offset*phi_dot_guide_offset;
    const Lanes dv_acceleration_L6_theta = -dv_lambda_guide_offset*l_guide_offset__L6_theta;
    const Lanes dv_acceleration_L3_theta = -dv_acceleration_L6_theta*l_L6_theta__L3_theta;
    const Lanes dv_acceleration_L7_theta = -dv_acceleration_L6_theta*l_L6_theta__L7_theta;
    const Lanes dv_acceleration_L2_theta = -dv_acceleration_L6_theta*l_L6_theta__L2_theta
        - dv_acceleration_L7_theta*l_L7_theta__L2_theta;
    const Lanes dv_acceleration_L8_theta = -dv_acceleration_L6_theta*l_L6_theta__L8_theta
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
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_guide_offset));
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
    const Lanes depth_by_e = pick(delta > 0.0, all_of(1.0), all_of(0.0));
    const Lanes ratio = pick(latch->closed > 0.0, deltadot/latch->deltadot_minus, all_of(1.0));
    const Lanes ratio_by_deltadot = pick(latch->closed > 0.0, 1.0/latch->deltadot_minus, all_of(0.0));
    const Lanes a_i = 0.5*delta + R_i;
    const Lanes a_j = -0.5*delta + R_j;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    const Lanes v_t_by_e = -0.5*omega_i - 0.5*omega_j;

    /* contact */
    const Lanes side_1 = lanes_side_of(side, g, corner, hysteresis*ratio + 1.0);
    const Lanes power_depth = lanes_pow(depth, exponent - 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    const Lanes F_n = depth*K*power_depth*larger_1;
    const Lanes F_n_by_depth = exponent*K*power_depth*larger_1;
    const Lanes branch_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis);
    const Lanes F_n_by_ratio = depth*K*power_depth*branch_1;
    const Lanes F_n_by_e = F_n_by_depth*depth_by_e;
    const Lanes F_n_by_deltadot = F_n_by_ratio*ratio_by_deltadot;
    const Lanes side_2 = lanes_side_of(side, g, corner + 1, -friction_slope*(-v0 - v_t) + 1.0);
    const Lanes smaller_1 = pick(side_2 < 0.0, all_of(1.0), friction_slope*(-v0 - v_t));
    const Lanes side_3 = lanes_side_of(side, g, corner + 2, smaller_1);
    const Lanes side_4 = lanes_side_of(side, g, corner + 3, -friction_slope*(-v0 + v_t) + 1.0);
    const Lanes smaller_2 = pick(side_4 < 0.0, all_of(1.0), friction_slope*(-v0 + v_t));
    const Lanes side_5 = lanes_side_of(side, g, corner + 4, smaller_2);
    const Lanes larger_2 = pick(side_3 < 0.0, all_of(0.0), smaller_1);
    const Lanes larger_3 = pick(side_5 < 0.0, all_of(0.0), smaller_2);
    const Lanes F_t = -F_n*mu*(-larger_2 + larger_3);
    const Lanes F_t_by_F_n = -mu*(-larger_2 + larger_3);
    const Lanes branch_2 = pick(side_2 < 0.0, all_of(0.0), -friction_slope);
    const Lanes branch_3 = pick(side_3 < 0.0, all_of(0.0), branch_2);
    const Lanes branch_4 = pick(side_4 < 0.0, all_of(0.0), friction_slope);
    const Lanes branch_5 = pick(side_5 < 0.0, all_of(0.0), branch_4);
    const Lanes F_t_by_v_t = -F_n*mu*(-branch_3 + branch_5);
    const Lanes F_t_by_e = F_n_by_e*F_t_by_F_n + F_t_by_v_t*v_t_by_e;
    const Lanes F_t_by_deltadot = F_n_by_deltadot*F_t_by_F_n;
    const Lanes F_t_by_omega_i = -F_t_by_v_t*a_i;
    const Lanes F_t_by_omega_j = F_t_by_v_t*a_j;
    const Lanes F_along_t_dry = F_t;
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_i_dry_by_e = -0.5*F_along_t_dry - F_t_by_e*a_i;
    const Lanes M_i_dry_by_deltadot = -F_t_by_deltadot*a_i;
    const Lanes M_i_dry_by_de_t = -F_t_by_v_t*a_i;
    const Lanes M_i_dry_by_omega_i = -F_t_by_omega_i*a_i;
    const Lanes M_i_dry_by_omega_j = -F_t_by_omega_j*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    const Lanes M_j_dry_by_e = -0.5*F_along_t_dry + F_t_by_e*a_j;
    const Lanes M_j_dry_by_deltadot = F_t_by_deltadot*a_j;
    const Lanes M_j_dry_by_de_t = F_t_by_v_t*a_j;
    const Lanes M_j_dry_by_omega_i = F_t_by_omega_i*a_j;
    const Lanes M_j_dry_by_omega_j = F_t_by_omega_j*a_j;

    /* results */
    out->value[0] = -F_n;
    out->slope[0][0] = -F_n_by_e;
    out->slope[0][1] = -F_n_by_deltadot;
    out->slope[0][2] = all_of(0.0);
    out->slope[0][3] = all_of(0.0);
    out->slope[0][4] = all_of(0.0);
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

/* Joint A, as in newton.c: what acts in no lane is passed over. */
static void slopes_A(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
    const LaneParameters *p, const Lanes *side, Lanes *g, LaneSlopes *out)
{
    (void)p, (void)side, (void)g;
    *out = (LaneSlopes){0};
    const LaneBits touching = is_closed(latch);
    if (any_of(touching)) {
        LaneSlopes dry;
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent, p->dry_friction_mu, p->dry_friction_v0, p->pin_radius, p->R_j_pin,
            p->pin_clearance, p->dry_pin_K, p->dry_pin_hysteresis, p->dry_pin_friction_slope, side, g, 0, &dry);
        pick_slopes(out, touching, &dry);
    }
}

static void tangent_A(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->pin_clearance);
    slopes_A(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_A(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_A(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
static void slopes_B(Lanes e, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j, const LaneLatch *latch,
    const LaneParameters *p, const Lanes *side, Lanes *g, LaneSlopes *out)
{
    (void)p, (void)side, (void)g;
    *out = (LaneSlopes){0};
    const LaneBits touching = is_closed(latch);
    if (any_of(touching)) {
        LaneSlopes dry;
        dry_slopes_lankarani_nikravesh_modified_coulomb(e, deltadot, de_t, omega_i, omega_j, latch,
            p->dry_normal_exponent, p->dry_friction_mu, p->dry_friction_v0, p->pin_radius, p->R_j_pin,
            p->pin_clearance, p->dry_pin_K, p->dry_pin_hysteresis, p->dry_pin_friction_slope, side, g, 5, &dry);
        pick_slopes(out, touching, &dry);
    }
}

static void tangent_B(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, const Lanes *side, Lanes *g, Lanes dF[4][6])
{
    LaneSlopes F;
    const Lanes e = lanes_sqrt(e_x * e_x + e_y * e_y), inverse_e = 1.0 / e, n_x = e_x * inverse_e, n_y =
        e_y * inverse_e;
    const Lanes deltadot = de_x * n_x + de_y * n_y, de_t = de_y * n_x - de_x * n_y;
    const LaneBits centred = ~(e > CENTRED * p->pin_clearance);
    slopes_B(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, n_x, n_y, deltadot, de_t, inverse_e, dF);
    if (!any_of(centred))
        return;
    /* at the centre each axis in turn is the normal */
    Lanes there[4][6];
    slopes_B(e, de_x, de_y, omega_i, omega_j, latch, p, side, g, &F);
    in_ground_axes(&F, all_of(1.0), all_of(0.0), de_x, de_y, all_of(0.0), there);
    slopes_B(e, de_y, -de_x, omega_i, omega_j, latch, p, side, g, &F);
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
    const Lanes L6_theta = q[0];
    const Lanes L6_omega = v[0];
    const Lanes L7_theta = q[1];
    const Lanes L7_omega = v[1];
    const Lanes L8_theta = q[2];
    const Lanes L8_omega = v[2];
    const Lanes L2_theta = q[3];
    const Lanes L2_omega = v[3];
    const Lanes L3_theta = q[4];
    const Lanes L3_omega = v[4];
    const Lanes a_L6_theta = a[0];
    const Lanes a_L7_theta = a[1];
    const Lanes a_L8_theta = a[2];
    const Lanes a_L2_theta = a[3];
    const Lanes a_L3_theta = a[4];
    const Lanes held_lambda_guide_offset = aside->lambda[0];
    const Lanes A_Fx = aside->clearance[0].Fx;
    const Lanes A_Fy = aside->clearance[0].Fy;
    const Lanes A_moment_first = aside->clearance[0].moment_first;
    const Lanes A_moment_second = aside->clearance[0].moment_second;
    const Lanes B_Fx = aside->clearance[1].Fx;
    const Lanes B_Fy = aside->clearance[1].Fy;
    const Lanes B_moment_first = aside->clearance[1].moment_first;
    const Lanes B_moment_second = aside->clearance[1].moment_second;

    /* directions, arms, drives */
    const Lanes crank1_value = p->omega*t - 0.689754120388159;
    const Lanes crank1_rate = p->omega;
    const Lanes crank1_acceleration = all_of(0.0);
    const Lanes crank4_value = p->omega4*t + 3.4814082589530893;
    const Lanes crank4_rate = p->omega4;
    const Lanes crank4_acceleration = all_of(0.0);
    const Lanes cos_theta_L1 = lanes_cos(crank1_value);
    const Lanes sin_theta_L1 = lanes_sin(crank1_value);
    const Lanes cos_theta_L4 = lanes_cos(crank4_value);
    const Lanes sin_theta_L4 = lanes_sin(crank4_value);
    const Lanes cos_theta_L6 = lanes_cos(L6_theta);
    const Lanes sin_theta_L6 = lanes_sin(L6_theta);
    const Lanes cos_theta_L7 = lanes_cos(L7_theta);
    const Lanes sin_theta_L7 = lanes_sin(L7_theta);
    const Lanes cos_theta_L8 = lanes_cos(L8_theta);
    const Lanes sin_theta_L8 = lanes_sin(L8_theta);
    const Lanes cos_theta_L2 = lanes_cos(L2_theta);
    const Lanes sin_theta_L2 = lanes_sin(L2_theta);
    const Lanes cos_theta_L3 = lanes_cos(L3_theta);
    const Lanes sin_theta_L3 = lanes_sin(L3_theta);
    const Lanes span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const Lanes span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const Lanes L6_head_x = p->O6_x + span_L6_head_x;
    const Lanes L6_head_vx = -L6_omega*span_L6_head_y;
    const Lanes L6_head_vy = L6_omega*span_L6_head_x;
    const Lanes span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const Lanes span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;
    const Lanes L7_tail_x = L6_head_x + span_L7_tail_x;
    const Lanes L7_tail_vx = L6_head_vx - L7_omega*span_L7_tail_y;
    const Lanes L7_tail_y = span_L6_head_y + span_L7_tail_y;
    const Lanes L7_tail_vy = L6_head_vy + L7_omega*span_L7_tail_x;
    const Lanes span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const Lanes span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const Lanes span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const Lanes span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const Lanes L1_head_vx = -crank1_rate*span_L1_head_y;
    const Lanes L1_head_vy = crank1_rate*span_L1_head_x;
    const Lanes span_L2_tail_x = p->L2_tail_span_x*cos_theta_L2;
    const Lanes span_L2_tail_y = p->L2_tail_span_x*sin_theta_L2;
    const Lanes L2_tail_x = L7_tail_x + span_L2_tail_x;
    const Lanes L2_tail_vx = -L2_omega*span_L2_tail_y + L7_tail_vx;
    const Lanes L2_tail_y = L7_tail_y + span_L2_tail_y;
    const Lanes L2_tail_vy = L2_omega*span_L2_tail_x + L7_tail_vy;
    const Lanes span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const Lanes span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const Lanes L4_head_vx = -crank4_rate*span_L4_head_y;
    const Lanes L4_head_y = p->O4_y + span_L4_head_y;
    const Lanes L4_head_vy = crank4_rate*span_L4_head_x;
    const Lanes span_L3_tail_x = p->L3_tail_span_x*cos_theta_L3;
    const Lanes span_L3_tail_y = p->L3_tail_span_x*sin_theta_L3;
    const Lanes L3_tail_x = L7_tail_x + span_L3_tail_x;
    const Lanes L3_tail_vx = -L3_omega*span_L3_tail_y + L7_tail_vx;
    const Lanes L3_tail_y = L7_tail_y + span_L3_tail_y;
    const Lanes L3_tail_vy = L3_omega*span_L3_tail_x + L7_tail_vy;
    const Lanes cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const Lanes sin_L7_less_L6 = cos_theta_L6*sin_theta_L7 - cos_theta_L7*sin_theta_L6;
    const Lanes dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const Lanes cross_L6_L7 = p->inertia_L6_L7*sin_L7_less_L6;
    const Lanes cos_L2_less_L6 = cos_theta_L2*cos_theta_L6 + sin_theta_L2*sin_theta_L6;
    const Lanes sin_L2_less_L6 = -cos_theta_L2*sin_theta_L6 + cos_theta_L6*sin_theta_L2;
    const Lanes dot_L6_L2 = cos_L2_less_L6*p->inertia_L6_L2;
    const Lanes cross_L6_L2 = p->inertia_L6_L2*sin_L2_less_L6;
    const Lanes cos_L2_less_L7 = cos_theta_L2*cos_theta_L7 + sin_theta_L2*sin_theta_L7;
    const Lanes sin_L2_less_L7 = -cos_theta_L2*sin_theta_L7 + cos_theta_L7*sin_theta_L2;
    const Lanes dot_L7_L2 = cos_L2_less_L7*p->inertia_L7_L2;
    const Lanes cross_L7_L2 = p->inertia_L7_L2*sin_L2_less_L7;
    const Lanes cos_L3_less_L6 = cos_theta_L3*cos_theta_L6 + sin_theta_L3*sin_theta_L6;
    const Lanes sin_L3_less_L6 = -cos_theta_L3*sin_theta_L6 + cos_theta_L6*sin_theta_L3;
    const Lanes dot_L6_L3 = cos_L3_less_L6*p->inertia_L6_L3;
    const Lanes cross_L6_L3 = p->inertia_L6_L3*sin_L3_less_L6;
    const Lanes cos_L3_less_L7 = cos_theta_L3*cos_theta_L7 + sin_theta_L3*sin_theta_L7;
    const Lanes sin_L3_less_L7 = -cos_theta_L3*sin_theta_L7 + cos_theta_L7*sin_theta_L3;
    const Lanes dot_L7_L3 = cos_L3_less_L7*p->inertia_L7_L3;
    const Lanes cross_L7_L3 = p->inertia_L7_L3*sin_L3_less_L7;
    const Lanes cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const Lanes sin_L8_less_L6 = cos_theta_L6*sin_theta_L8 - cos_theta_L8*sin_theta_L6;
    const Lanes dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;
    const Lanes cross_L6_L8 = p->inertia_L6_L8*sin_L8_less_L6;

    /* clearance joint A */
    const Lanes e_A_x = L2_tail_x - span_L1_head_x;
    const Lanes e_A_y = L2_tail_y - span_L1_head_y;
    const Lanes edot_A_x = -L1_head_vx + L2_tail_vx;
    const Lanes edot_A_y = -L1_head_vy + L2_tail_vy;
    Lanes change_A[4][6];
    tangent_A(e_A_x, e_A_y, edot_A_x, edot_A_y, crank1_rate, L2_omega, &memory->latch[0], p, side, g, change_A);
    const Lanes span_L1_head_x_by_time = -crank1_rate*span_L1_head_y;
    const Lanes span_L1_head_y_by_time = crank1_rate*span_L1_head_x;
    const Lanes L1_head_vx_by_time = -crank1_acceleration*span_L1_head_y - (crank1_rate * crank1_rate)*span_L1_head_x;
    const Lanes L2_tail_vx_by_L6_theta = -L6_omega*span_L6_head_x;
    const Lanes L2_tail_vx_by_L7_theta = -L7_omega*span_L7_tail_x;
    const Lanes L2_tail_vx_by_L2_theta = -L2_omega*span_L2_tail_x;
    const Lanes L1_head_vy_by_time = crank1_acceleration*span_L1_head_x - (crank1_rate * crank1_rate)*span_L1_head_y;
    const Lanes L2_tail_vy_by_L6_theta = -L6_omega*span_L6_head_y;
    const Lanes L2_tail_vy_by_L7_theta = -L7_omega*span_L7_tail_y;
    const Lanes L2_tail_vy_by_L2_theta = -L2_omega*span_L2_tail_y;
    const Lanes A_Fx_by_e_x = change_A[0][0];
    const Lanes A_Fx_by_e_y = change_A[0][1];
    const Lanes A_Fx_by_de_x = change_A[0][2];
    const Lanes A_Fx_by_de_y = change_A[0][3];
    const Lanes A_Fx_by_omega_i = change_A[0][4];
    const Lanes A_Fx_by_omega_j = change_A[0][5];
    const Lanes A_Fx_by_L6_theta = A_Fx_by_de_x*L2_tail_vx_by_L6_theta + A_Fx_by_de_y*L2_tail_vy_by_L6_theta
        - A_Fx_by_e_x*span_L6_head_y + A_Fx_by_e_y*span_L6_head_x;
    const Lanes A_Fx_by_L7_theta = A_Fx_by_de_x*L2_tail_vx_by_L7_theta + A_Fx_by_de_y*L2_tail_vy_by_L7_theta
        - A_Fx_by_e_x*span_L7_tail_y + A_Fx_by_e_y*span_L7_tail_x;
    const Lanes A_Fx_by_L2_theta = A_Fx_by_de_x*L2_tail_vx_by_L2_theta + A_Fx_by_de_y*L2_tail_vy_by_L2_theta
        - A_Fx_by_e_x*span_L2_tail_y + A_Fx_by_e_y*span_L2_tail_x;
    const Lanes A_Fx_by_time = -A_Fx_by_de_x*L1_head_vx_by_time - A_Fx_by_de_y*L1_head_vy_by_time
        - A_Fx_by_e_x*span_L1_head_x_by_time - A_Fx_by_e_y*span_L1_head_y_by_time + A_Fx_by_omega_i*crank1_acceleration;
    const Lanes A_Fx_by_L6_omega = -A_Fx_by_de_x*span_L6_head_y + A_Fx_by_de_y*span_L6_head_x;
    const Lanes A_Fx_by_L7_omega = -A_Fx_by_de_x*span_L7_tail_y + A_Fx_by_de_y*span_L7_tail_x;
    const Lanes A_Fx_by_L2_omega = -A_Fx_by_de_x*span_L2_tail_y + A_Fx_by_de_y*span_L2_tail_x + A_Fx_by_omega_j;
    const Lanes A_Fy_by_e_x = change_A[1][0];
    const Lanes A_Fy_by_e_y = change_A[1][1];
    const Lanes A_Fy_by_de_x = change_A[1][2];
    const Lanes A_Fy_by_de_y = change_A[1][3];
    const Lanes A_Fy_by_omega_i = change_A[1][4];
    const Lanes A_Fy_by_omega_j = change_A[1][5];
    const Lanes A_Fy_by_L6_theta = A_Fy_by_de_x*L2_tail_vx_by_L6_theta + A_Fy_by_de_y*L2_tail_vy_by_L6_theta
        - A_Fy_by_e_x*span_L6_head_y + A_Fy_by_e_y*span_L6_head_x;
    const Lanes A_Fy_by_L7_theta = A_Fy_by_de_x*L2_tail_vx_by_L7_theta + A_Fy_by_de_y*L2_tail_vy_by_L7_theta
        - A_Fy_by_e_x*span_L7_tail_y + A_Fy_by_e_y*span_L7_tail_x;
    const Lanes A_Fy_by_L2_theta = A_Fy_by_de_x*L2_tail_vx_by_L2_theta + A_Fy_by_de_y*L2_tail_vy_by_L2_theta
        - A_Fy_by_e_x*span_L2_tail_y + A_Fy_by_e_y*span_L2_tail_x;
    const Lanes A_Fy_by_time = -A_Fy_by_de_x*L1_head_vx_by_time - A_Fy_by_de_y*L1_head_vy_by_time
        - A_Fy_by_e_x*span_L1_head_x_by_time - A_Fy_by_e_y*span_L1_head_y_by_time + A_Fy_by_omega_i*crank1_acceleration;
    const Lanes A_Fy_by_L6_omega = -A_Fy_by_de_x*span_L6_head_y + A_Fy_by_de_y*span_L6_head_x;
    const Lanes A_Fy_by_L7_omega = -A_Fy_by_de_x*span_L7_tail_y + A_Fy_by_de_y*span_L7_tail_x;
    const Lanes A_Fy_by_L2_omega = -A_Fy_by_de_x*span_L2_tail_y + A_Fy_by_de_y*span_L2_tail_x + A_Fy_by_omega_j;
    const Lanes A_moment_first_by_e_x = change_A[2][0];
    const Lanes A_moment_first_by_e_y = change_A[2][1];
    const Lanes A_moment_first_by_de_x = change_A[2][2];
    const Lanes A_moment_first_by_de_y = change_A[2][3];
    const Lanes A_moment_first_by_omega_i = change_A[2][4];
    const Lanes A_moment_first_by_omega_j = change_A[2][5];
    const Lanes A_moment_first_by_L6_theta = A_moment_first_by_de_x*L2_tail_vx_by_L6_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L6_theta - A_moment_first_by_e_x*span_L6_head_y
        + A_moment_first_by_e_y*span_L6_head_x;
    const Lanes A_moment_first_by_L7_theta = A_moment_first_by_de_x*L2_tail_vx_by_L7_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L7_theta - A_moment_first_by_e_x*span_L7_tail_y
        + A_moment_first_by_e_y*span_L7_tail_x;
    const Lanes A_moment_first_by_L2_theta = A_moment_first_by_de_x*L2_tail_vx_by_L2_theta
        + A_moment_first_by_de_y*L2_tail_vy_by_L2_theta - A_moment_first_by_e_x*span_L2_tail_y
        + A_moment_first_by_e_y*span_L2_tail_x;
    const Lanes A_moment_first_by_time = -A_moment_first_by_de_x*L1_head_vx_by_time
        - A_moment_first_by_de_y*L1_head_vy_by_time - A_moment_first_by_e_x*span_L1_head_x_by_time
        - A_moment_first_by_e_y*span_L1_head_y_by_time + A_moment_first_by_omega_i*crank1_acceleration;
    const Lanes A_moment_first_by_L6_omega = -A_moment_first_by_de_x*span_L6_head_y
        + A_moment_first_by_de_y*span_L6_head_x;
    const Lanes A_moment_first_by_L7_omega = -A_moment_first_by_de_x*span_L7_tail_y
        + A_moment_first_by_de_y*span_L7_tail_x;
    const Lanes A_moment_first_by_L2_omega = -A_moment_first_by_de_x*span_L2_tail_y
        + A_moment_first_by_de_y*span_L2_tail_x + A_moment_first_by_omega_j;
    const Lanes A_moment_second_by_e_x = change_A[3][0];
    const Lanes A_moment_second_by_e_y = change_A[3][1];
    const Lanes A_moment_second_by_de_x = change_A[3][2];
    const Lanes A_moment_second_by_de_y = change_A[3][3];
    const Lanes A_moment_second_by_omega_i = change_A[3][4];
    const Lanes A_moment_second_by_omega_j = change_A[3][5];
    const Lanes A_moment_second_by_L6_theta = A_moment_second_by_de_x*L2_tail_vx_by_L6_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L6_theta - A_moment_second_by_e_x*span_L6_head_y
        + A_moment_second_by_e_y*span_L6_head_x;
    const Lanes A_moment_second_by_L7_theta = A_moment_second_by_de_x*L2_tail_vx_by_L7_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L7_theta - A_moment_second_by_e_x*span_L7_tail_y
        + A_moment_second_by_e_y*span_L7_tail_x;
    const Lanes A_moment_second_by_L2_theta = A_moment_second_by_de_x*L2_tail_vx_by_L2_theta
        + A_moment_second_by_de_y*L2_tail_vy_by_L2_theta - A_moment_second_by_e_x*span_L2_tail_y
        + A_moment_second_by_e_y*span_L2_tail_x;
    const Lanes A_moment_second_by_time = -A_moment_second_by_de_x*L1_head_vx_by_time
        - A_moment_second_by_de_y*L1_head_vy_by_time - A_moment_second_by_e_x*span_L1_head_x_by_time
        - A_moment_second_by_e_y*span_L1_head_y_by_time + A_moment_second_by_omega_i*crank1_acceleration;
    const Lanes A_moment_second_by_L6_omega = -A_moment_second_by_de_x*span_L6_head_y
        + A_moment_second_by_de_y*span_L6_head_x;
    const Lanes A_moment_second_by_L7_omega = -A_moment_second_by_de_x*span_L7_tail_y
        + A_moment_second_by_de_y*span_L7_tail_x;
    const Lanes A_moment_second_by_L2_omega = -A_moment_second_by_de_x*span_L2_tail_y
        + A_moment_second_by_de_y*span_L2_tail_x + A_moment_second_by_omega_j;

    /* clearance joint B */
    const Lanes e_B_x = L3_tail_x - span_L4_head_x;
    const Lanes e_B_y = L3_tail_y - L4_head_y;
    const Lanes edot_B_x = L3_tail_vx - L4_head_vx;
    const Lanes edot_B_y = L3_tail_vy - L4_head_vy;
    Lanes change_B[4][6];
    tangent_B(e_B_x, e_B_y, edot_B_x, edot_B_y, crank4_rate, L3_omega, &memory->latch[1], p, side, g, change_B);
    const Lanes span_L4_head_x_by_time = -crank4_rate*span_L4_head_y;
    const Lanes L4_head_y_by_time = crank4_rate*span_L4_head_x;
    const Lanes L3_tail_vx_by_L6_theta = -L6_omega*span_L6_head_x;
    const Lanes L3_tail_vx_by_L7_theta = -L7_omega*span_L7_tail_x;
    const Lanes L3_tail_vx_by_L3_theta = -L3_omega*span_L3_tail_x;
    const Lanes L4_head_vx_by_time = -crank4_acceleration*span_L4_head_y - (crank4_rate * crank4_rate)*span_L4_head_x;
    const Lanes L3_tail_vy_by_L6_theta = -L6_omega*span_L6_head_y;
    const Lanes L3_tail_vy_by_L7_theta = -L7_omega*span_L7_tail_y;
    const Lanes L3_tail_vy_by_L3_theta = -L3_omega*span_L3_tail_y;
    const Lanes L4_head_vy_by_time = crank4_acceleration*span_L4_head_x - (crank4_rate * crank4_rate)*span_L4_head_y;
    const Lanes B_Fx_by_e_x = change_B[0][0];
    const Lanes B_Fx_by_e_y = change_B[0][1];
    const Lanes B_Fx_by_de_x = change_B[0][2];
    const Lanes B_Fx_by_de_y = change_B[0][3];
    const Lanes B_Fx_by_omega_i = change_B[0][4];
    const Lanes B_Fx_by_omega_j = change_B[0][5];
    const Lanes B_Fx_by_L6_theta = B_Fx_by_de_x*L3_tail_vx_by_L6_theta + B_Fx_by_de_y*L3_tail_vy_by_L6_theta
        - B_Fx_by_e_x*span_L6_head_y + B_Fx_by_e_y*span_L6_head_x;
    const Lanes B_Fx_by_L7_theta = B_Fx_by_de_x*L3_tail_vx_by_L7_theta + B_Fx_by_de_y*L3_tail_vy_by_L7_theta
        - B_Fx_by_e_x*span_L7_tail_y + B_Fx_by_e_y*span_L7_tail_x;
    const Lanes B_Fx_by_L3_theta = B_Fx_by_de_x*L3_tail_vx_by_L3_theta + B_Fx_by_de_y*L3_tail_vy_by_L3_theta
        - B_Fx_by_e_x*span_L3_tail_y + B_Fx_by_e_y*span_L3_tail_x;
    const Lanes B_Fx_by_time = -B_Fx_by_de_x*L4_head_vx_by_time - B_Fx_by_de_y*L4_head_vy_by_time
        - B_Fx_by_e_x*span_L4_head_x_by_time - B_Fx_by_e_y*L4_head_y_by_time + B_Fx_by_omega_i*crank4_acceleration;
    const Lanes B_Fx_by_L6_omega = -B_Fx_by_de_x*span_L6_head_y + B_Fx_by_de_y*span_L6_head_x;
    const Lanes B_Fx_by_L7_omega = -B_Fx_by_de_x*span_L7_tail_y + B_Fx_by_de_y*span_L7_tail_x;
    const Lanes B_Fx_by_L3_omega = -B_Fx_by_de_x*span_L3_tail_y + B_Fx_by_de_y*span_L3_tail_x + B_Fx_by_omega_j;
    const Lanes B_Fy_by_e_x = change_B[1][0];
    const Lanes B_Fy_by_e_y = change_B[1][1];
    const Lanes B_Fy_by_de_x = change_B[1][2];
    const Lanes B_Fy_by_de_y = change_B[1][3];
    const Lanes B_Fy_by_omega_i = change_B[1][4];
    const Lanes B_Fy_by_omega_j = change_B[1][5];
    const Lanes B_Fy_by_L6_theta = B_Fy_by_de_x*L3_tail_vx_by_L6_theta + B_Fy_by_de_y*L3_tail_vy_by_L6_theta
        - B_Fy_by_e_x*span_L6_head_y + B_Fy_by_e_y*span_L6_head_x;
    const Lanes B_Fy_by_L7_theta = B_Fy_by_de_x*L3_tail_vx_by_L7_theta + B_Fy_by_de_y*L3_tail_vy_by_L7_theta
        - B_Fy_by_e_x*span_L7_tail_y + B_Fy_by_e_y*span_L7_tail_x;
    const Lanes B_Fy_by_L3_theta = B_Fy_by_de_x*L3_tail_vx_by_L3_theta + B_Fy_by_de_y*L3_tail_vy_by_L3_theta
        - B_Fy_by_e_x*span_L3_tail_y + B_Fy_by_e_y*span_L3_tail_x;
    const Lanes B_Fy_by_time = -B_Fy_by_de_x*L4_head_vx_by_time - B_Fy_by_de_y*L4_head_vy_by_time
        - B_Fy_by_e_x*span_L4_head_x_by_time - B_Fy_by_e_y*L4_head_y_by_time + B_Fy_by_omega_i*crank4_acceleration;
    const Lanes B_Fy_by_L6_omega = -B_Fy_by_de_x*span_L6_head_y + B_Fy_by_de_y*span_L6_head_x;
    const Lanes B_Fy_by_L7_omega = -B_Fy_by_de_x*span_L7_tail_y + B_Fy_by_de_y*span_L7_tail_x;
    const Lanes B_Fy_by_L3_omega = -B_Fy_by_de_x*span_L3_tail_y + B_Fy_by_de_y*span_L3_tail_x + B_Fy_by_omega_j;
    const Lanes B_moment_first_by_e_x = change_B[2][0];
    const Lanes B_moment_first_by_e_y = change_B[2][1];
    const Lanes B_moment_first_by_de_x = change_B[2][2];
    const Lanes B_moment_first_by_de_y = change_B[2][3];
    const Lanes B_moment_first_by_omega_i = change_B[2][4];
    const Lanes B_moment_first_by_omega_j = change_B[2][5];
    const Lanes B_moment_first_by_L6_theta = B_moment_first_by_de_x*L3_tail_vx_by_L6_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L6_theta - B_moment_first_by_e_x*span_L6_head_y
        + B_moment_first_by_e_y*span_L6_head_x;
    const Lanes B_moment_first_by_L7_theta = B_moment_first_by_de_x*L3_tail_vx_by_L7_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L7_theta - B_moment_first_by_e_x*span_L7_tail_y
        + B_moment_first_by_e_y*span_L7_tail_x;
    const Lanes B_moment_first_by_L3_theta = B_moment_first_by_de_x*L3_tail_vx_by_L3_theta
        + B_moment_first_by_de_y*L3_tail_vy_by_L3_theta - B_moment_first_by_e_x*span_L3_tail_y
        + B_moment_first_by_e_y*span_L3_tail_x;
    const Lanes B_moment_first_by_time = -B_moment_first_by_de_x*L4_head_vx_by_time
        - B_moment_first_by_de_y*L4_head_vy_by_time - B_moment_first_by_e_x*span_L4_head_x_by_time
        - B_moment_first_by_e_y*L4_head_y_by_time + B_moment_first_by_omega_i*crank4_acceleration;
    const Lanes B_moment_first_by_L6_omega = -B_moment_first_by_de_x*span_L6_head_y
        + B_moment_first_by_de_y*span_L6_head_x;
    const Lanes B_moment_first_by_L7_omega = -B_moment_first_by_de_x*span_L7_tail_y
        + B_moment_first_by_de_y*span_L7_tail_x;
    const Lanes B_moment_first_by_L3_omega = -B_moment_first_by_de_x*span_L3_tail_y
        + B_moment_first_by_de_y*span_L3_tail_x + B_moment_first_by_omega_j;
    const Lanes B_moment_second_by_e_x = change_B[3][0];
    const Lanes B_moment_second_by_e_y = change_B[3][1];
    const Lanes B_moment_second_by_de_x = change_B[3][2];
    const Lanes B_moment_second_by_de_y = change_B[3][3];
    const Lanes B_moment_second_by_omega_i = change_B[3][4];
    const Lanes B_moment_second_by_omega_j = change_B[3][5];
    const Lanes B_moment_second_by_L6_theta = B_moment_second_by_de_x*L3_tail_vx_by_L6_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L6_theta - B_moment_second_by_e_x*span_L6_head_y
        + B_moment_second_by_e_y*span_L6_head_x;
    const Lanes B_moment_second_by_L7_theta = B_moment_second_by_de_x*L3_tail_vx_by_L7_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L7_theta - B_moment_second_by_e_x*span_L7_tail_y
        + B_moment_second_by_e_y*span_L7_tail_x;
    const Lanes B_moment_second_by_L3_theta = B_moment_second_by_de_x*L3_tail_vx_by_L3_theta
        + B_moment_second_by_de_y*L3_tail_vy_by_L3_theta - B_moment_second_by_e_x*span_L3_tail_y
        + B_moment_second_by_e_y*span_L3_tail_x;
    const Lanes B_moment_second_by_time = -B_moment_second_by_de_x*L4_head_vx_by_time
        - B_moment_second_by_de_y*L4_head_vy_by_time - B_moment_second_by_e_x*span_L4_head_x_by_time
        - B_moment_second_by_e_y*L4_head_y_by_time + B_moment_second_by_omega_i*crank4_acceleration;
    const Lanes B_moment_second_by_L6_omega = -B_moment_second_by_de_x*span_L6_head_y
        + B_moment_second_by_de_y*span_L6_head_x;
    const Lanes B_moment_second_by_L7_omega = -B_moment_second_by_de_x*span_L7_tail_y
        + B_moment_second_by_de_y*span_L7_tail_x;
    const Lanes B_moment_second_by_L3_omega = -B_moment_second_by_de_x*span_L3_tail_y
        + B_moment_second_by_de_y*span_L3_tail_x + B_moment_second_by_omega_j;

    /* powers */
    const Lanes cos_theta_L1_by_time = -crank1_rate*sin_theta_L1;
    const Lanes cos_theta_L4_by_time = -crank4_rate*sin_theta_L4;
    const Lanes span_L4_head_y_by_time = crank4_rate*span_L4_head_x;

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
static void newton_factor(Lanes eta, LaneLinear *lin, LaneBits *rare)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_L6_theta_L7_theta = lin->value[0];
    const Lanes mass_L6_theta_L2_theta = lin->value[1];
    const Lanes mass_L7_theta_L2_theta = lin->value[2];
    const Lanes mass_L6_theta_L3_theta = lin->value[3];
    const Lanes mass_L7_theta_L3_theta = lin->value[4];
    const Lanes mass_L6_theta_L8_theta = lin->value[5];
    const Lanes phi_guide_offset_L6_theta = lin->value[6];
    const Lanes phi_guide_offset_L8_theta = lin->value[7];
    const Lanes by_q_guide_offset_L6_theta = lin->value[8];
    const Lanes by_q_guide_offset_L8_theta = lin->value[9];
    const Lanes by_q_L6_theta_L6_theta = lin->value[10];
    const Lanes by_q_L6_theta_L7_theta = lin->value[11];
    const Lanes by_q_L6_theta_L2_theta = lin->value[12];
    const Lanes by_q_L6_theta_L3_theta = lin->value[13];
    const Lanes by_q_L6_theta_L8_theta = lin->value[14];
    const Lanes by_q_L7_theta_L6_theta = lin->value[15];
    const Lanes by_q_L7_theta_L7_theta = lin->value[16];
    const Lanes by_q_L7_theta_L2_theta = lin->value[17];
    const Lanes by_q_L7_theta_L3_theta = lin->value[18];
    const Lanes by_q_L8_theta_L8_theta = lin->value[19];
    const Lanes by_q_L8_theta_L6_theta = lin->value[20];
    const Lanes by_q_L2_theta_L6_theta = lin->value[21];
    const Lanes by_q_L2_theta_L7_theta = lin->value[22];
    const Lanes by_q_L2_theta_L2_theta = lin->value[23];
    const Lanes by_q_L3_theta_L6_theta = lin->value[24];
    const Lanes by_q_L3_theta_L7_theta = lin->value[25];
    const Lanes by_q_L3_theta_L3_theta = lin->value[26];
    const Lanes by_v_guide_offset_L6_theta = lin->value[27];
    const Lanes by_v_guide_offset_L8_theta = lin->value[28];
    const Lanes by_v_L6_theta_L6_theta = lin->value[29];
    const Lanes by_v_L6_theta_L7_theta = lin->value[30];
    const Lanes by_v_L6_theta_L2_theta = lin->value[31];
    const Lanes by_v_L6_theta_L3_theta = lin->value[32];
    const Lanes by_v_L6_theta_L8_theta = lin->value[33];
    const Lanes by_v_L7_theta_L6_theta = lin->value[34];
    const Lanes by_v_L7_theta_L7_theta = lin->value[35];
    const Lanes by_v_L7_theta_L2_theta = lin->value[36];
    const Lanes by_v_L7_theta_L3_theta = lin->value[37];
    const Lanes by_v_L8_theta_L6_theta = lin->value[38];
    const Lanes by_v_L2_theta_L6_theta = lin->value[39];
    const Lanes by_v_L2_theta_L7_theta = lin->value[40];
    const Lanes by_v_L2_theta_L2_theta = lin->value[41];
    const Lanes by_v_L3_theta_L6_theta = lin->value[42];
    const Lanes by_v_L3_theta_L7_theta = lin->value[43];
    const Lanes by_v_L3_theta_L3_theta = lin->value[44];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_L6_theta__L6_theta = eta*(by_q_L6_theta_L6_theta*eta + by_v_L6_theta_L6_theta) + p->mass_L6_L6;
    const Lanes n_L6_theta__L7_theta = eta*(by_q_L6_theta_L7_theta*eta + by_v_L6_theta_L7_theta)
        + mass_L6_theta_L7_theta;
    const Lanes n_L6_theta__L8_theta = eta*(by_q_L6_theta_L8_theta*eta + by_v_L6_theta_L8_theta)
        + mass_L6_theta_L8_theta;
    const Lanes n_L6_theta__L2_theta = eta*(by_q_L6_theta_L2_theta*eta + by_v_L6_theta_L2_theta)
        + mass_L6_theta_L2_theta;
    const Lanes n_L6_theta__L3_theta = eta*(by_q_L6_theta_L3_theta*eta + by_v_L6_theta_L3_theta)
        + mass_L6_theta_L3_theta;
    const Lanes n_L7_theta__L6_theta = eta*(by_q_L7_theta_L6_theta*eta + by_v_L7_theta_L6_theta)
        + mass_L6_theta_L7_theta;
    const Lanes n_L7_theta__L7_theta = eta*(by_q_L7_theta_L7_theta*eta + by_v_L7_theta_L7_theta) + p->mass_L7_L7;
    const Lanes n_L7_theta__L2_theta = eta*(by_q_L7_theta_L2_theta*eta + by_v_L7_theta_L2_theta)
        + mass_L7_theta_L2_theta;
    const Lanes n_L7_theta__L3_theta = eta*(by_q_L7_theta_L3_theta*eta + by_v_L7_theta_L3_theta)
        + mass_L7_theta_L3_theta;
    const Lanes n_L8_theta__L6_theta = eta*(by_q_L8_theta_L6_theta*eta + by_v_L8_theta_L6_theta)
        + mass_L6_theta_L8_theta;
    const Lanes n_L8_theta__L8_theta = by_q_L8_theta_L8_theta*(eta * eta) + p->mass_L8_L8;
    const Lanes n_L2_theta__L6_theta = eta*(by_q_L2_theta_L6_theta*eta + by_v_L2_theta_L6_theta)
        + mass_L6_theta_L2_theta;
    const Lanes n_L2_theta__L7_theta = eta*(by_q_L2_theta_L7_theta*eta + by_v_L2_theta_L7_theta)
        + mass_L7_theta_L2_theta;
    const Lanes n_L2_theta__L2_theta = eta*(by_q_L2_theta_L2_theta*eta + by_v_L2_theta_L2_theta) + p->mass_L2_L2;
    const Lanes n_L3_theta__L6_theta = eta*(by_q_L3_theta_L6_theta*eta + by_v_L3_theta_L6_theta)
        + mass_L6_theta_L3_theta;
    const Lanes n_L3_theta__L7_theta = eta*(by_q_L3_theta_L7_theta*eta + by_v_L3_theta_L7_theta)
        + mass_L7_theta_L3_theta;
    const Lanes n_L3_theta__L3_theta = eta*(by_q_L3_theta_L3_theta*eta + by_v_L3_theta_L3_theta) + p->mass_L3_L3;
    const Lanes n_guide_offset__L6_theta = eta_row*(by_q_guide_offset_L6_theta*eta + by_v_guide_offset_L6_theta)
        + phi_guide_offset_L6_theta;
    const Lanes n_guide_offset__L8_theta = eta_row*(by_q_guide_offset_L8_theta*eta + by_v_guide_offset_L8_theta)
        + phi_guide_offset_L8_theta;

    /* L U */
    const Lanes scale_L8_theta = n_L8_theta__L8_theta;
    *rare |= ~(lanes_fabs(scale_L8_theta) > SINGULAR * lanes_fabs(n_L8_theta__L8_theta));
    const Lanes inverse_pivot_L8_theta = 1.0/scale_L8_theta;
    lin->lu[0] = inverse_pivot_L8_theta;
    const Lanes l_L6_theta__L8_theta = inverse_pivot_L8_theta*n_L6_theta__L8_theta;
    lin->lu[1] = l_L6_theta__L8_theta;
    lin->lu[2] = n_L8_theta__L6_theta;
    const Lanes l_guide_offset__L8_theta = inverse_pivot_L8_theta*n_guide_offset__L8_theta;
    lin->lu[3] = l_guide_offset__L8_theta;
    const Lanes scale_L2_theta = n_L2_theta__L2_theta;
    *rare |= ~(lanes_fabs(scale_L2_theta) > SINGULAR * lanes_fabs(n_L2_theta__L2_theta));
    const Lanes inverse_pivot_L2_theta = 1.0/scale_L2_theta;
    lin->lu[4] = inverse_pivot_L2_theta;
    const Lanes l_L7_theta__L2_theta = inverse_pivot_L2_theta*n_L7_theta__L2_theta;
    lin->lu[5] = l_L7_theta__L2_theta;
    lin->lu[6] = n_L2_theta__L7_theta;
    const Lanes l_L6_theta__L2_theta = inverse_pivot_L2_theta*n_L6_theta__L2_theta;
    lin->lu[7] = l_L6_theta__L2_theta;
    lin->lu[8] = n_L2_theta__L6_theta;
    const Lanes scale_L7_theta = -l_L7_theta__L2_theta*n_L2_theta__L7_theta + n_L7_theta__L7_theta;
    *rare |= ~(lanes_fabs(scale_L7_theta) > SINGULAR * lanes_fabs(n_L7_theta__L7_theta));
    const Lanes inverse_pivot_L7_theta = 1.0/scale_L7_theta;
    lin->lu[9] = inverse_pivot_L7_theta;
    const Lanes l_L3_theta__L7_theta = inverse_pivot_L7_theta*n_L3_theta__L7_theta;
    lin->lu[10] = l_L3_theta__L7_theta;
    lin->lu[11] = n_L7_theta__L3_theta;
    const Lanes l_L6_theta__L7_theta = inverse_pivot_L7_theta*(-l_L6_theta__L2_theta*n_L2_theta__L7_theta
        + n_L6_theta__L7_theta);
    lin->lu[12] = l_L6_theta__L7_theta;
    const Lanes u_L7_theta__L6_theta = -l_L7_theta__L2_theta*n_L2_theta__L6_theta + n_L7_theta__L6_theta;
    lin->lu[13] = u_L7_theta__L6_theta;
    const Lanes scale_L3_theta = -l_L3_theta__L7_theta*n_L7_theta__L3_theta + n_L3_theta__L3_theta;
    *rare |= ~(lanes_fabs(scale_L3_theta) > SINGULAR * lanes_fabs(n_L3_theta__L3_theta));
    const Lanes inverse_pivot_L3_theta = 1.0/scale_L3_theta;
    lin->lu[14] = inverse_pivot_L3_theta;
    const Lanes l_L6_theta__L3_theta = inverse_pivot_L3_theta*(-l_L6_theta__L7_theta*n_L7_theta__L3_theta
        + n_L6_theta__L3_theta);
    lin->lu[15] = l_L6_theta__L3_theta;
    const Lanes u_L3_theta__L6_theta = -l_L3_theta__L7_theta*u_L7_theta__L6_theta + n_L3_theta__L6_theta;
    lin->lu[16] = u_L3_theta__L6_theta;
    const Lanes scale_L6_theta = -l_L6_theta__L2_theta*n_L2_theta__L6_theta - l_L6_theta__L3_theta*u_L3_theta__L6_theta
        - l_L6_theta__L7_theta*u_L7_theta__L6_theta - l_L6_theta__L8_theta*n_L8_theta__L6_theta + n_L6_theta__L6_theta;
    *rare |= ~(lanes_fabs(scale_L6_theta) > SINGULAR * lanes_fabs(n_L6_theta__L6_theta));
    const Lanes inverse_pivot_L6_theta = 1.0/scale_L6_theta;
    lin->lu[17] = inverse_pivot_L6_theta;
    const Lanes l_guide_offset__L6_theta = inverse_pivot_L6_theta*(-l_guide_offset__L8_theta*n_L8_theta__L6_theta
        + n_guide_offset__L6_theta);
    lin->lu[18] = l_guide_offset__L6_theta;
    const Lanes u_L6_theta__guide_offset = -l_L6_theta__L8_theta*phi_guide_offset_L8_theta + phi_guide_offset_L6_theta;
    lin->lu[19] = u_L6_theta__guide_offset;
    const Lanes scale_guide_offset = -l_guide_offset__L6_theta*u_L6_theta__guide_offset
        - l_guide_offset__L8_theta*phi_guide_offset_L8_theta;
    *rare |= ~((lanes_fabs(scale_guide_offset) > 0.0) & (lanes_fabs(scale_guide_offset) < INFINITY));
    const Lanes inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    lin->lu[20] = inverse_pivot_guide_offset;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_guide_offset_L8_theta = lin->value[7];
    const Lanes inverse_pivot_L8_theta = lin->lu[0];
    const Lanes l_L6_theta__L8_theta = lin->lu[1];
    const Lanes n_L8_theta__L6_theta = lin->lu[2];
    const Lanes l_guide_offset__L8_theta = lin->lu[3];
    const Lanes inverse_pivot_L2_theta = lin->lu[4];
    const Lanes l_L7_theta__L2_theta = lin->lu[5];
    const Lanes n_L2_theta__L7_theta = lin->lu[6];
    const Lanes l_L6_theta__L2_theta = lin->lu[7];
    const Lanes n_L2_theta__L6_theta = lin->lu[8];
    const Lanes inverse_pivot_L7_theta = lin->lu[9];
    const Lanes l_L3_theta__L7_theta = lin->lu[10];
    const Lanes n_L7_theta__L3_theta = lin->lu[11];
    const Lanes l_L6_theta__L7_theta = lin->lu[12];
    const Lanes u_L7_theta__L6_theta = lin->lu[13];
    const Lanes inverse_pivot_L3_theta = lin->lu[14];
    const Lanes l_L6_theta__L3_theta = lin->lu[15];
    const Lanes u_L3_theta__L6_theta = lin->lu[16];
    const Lanes inverse_pivot_L6_theta = lin->lu[17];
    const Lanes l_guide_offset__L6_theta = lin->lu[18];
    const Lanes u_L6_theta__guide_offset = lin->lu[19];
    const Lanes inverse_pivot_guide_offset = lin->lu[20];

    /* forward */
    const Lanes b_L8_theta = x[2];
    const Lanes b_L2_theta = x[3];
    const Lanes b_L7_theta = -b_L2_theta*l_L7_theta__L2_theta + x[1];
    const Lanes b_L3_theta = -b_L7_theta*l_L3_theta__L7_theta + x[4];
    const Lanes b_L6_theta = -b_L2_theta*l_L6_theta__L2_theta - b_L3_theta*l_L6_theta__L3_theta
        - b_L7_theta*l_L6_theta__L7_theta - b_L8_theta*l_L6_theta__L8_theta + x[0];
    const Lanes b_guide_offset = -b_L6_theta*l_guide_offset__L6_theta - b_L8_theta*l_guide_offset__L8_theta + x[5];

    /* backward */
    const Lanes x_guide_offset = b_guide_offset*inverse_pivot_guide_offset;
    x[5] = x_guide_offset;
    const Lanes x_L6_theta = inverse_pivot_L6_theta*(b_L6_theta - u_L6_theta__guide_offset*x_guide_offset);
    x[0] = x_L6_theta;
    const Lanes x_L3_theta = inverse_pivot_L3_theta*(b_L3_theta - u_L3_theta__L6_theta*x_L6_theta);
    x[4] = x_L3_theta;
    const Lanes x_L7_theta = inverse_pivot_L7_theta*(b_L7_theta - n_L7_theta__L3_theta*x_L3_theta
        - u_L7_theta__L6_theta*x_L6_theta);
    x[1] = x_L7_theta;
    const Lanes x_L2_theta = inverse_pivot_L2_theta*(b_L2_theta - n_L2_theta__L6_theta*x_L6_theta
        - n_L2_theta__L7_theta*x_L7_theta);
    x[3] = x_L2_theta;
    const Lanes x_L8_theta = inverse_pivot_L8_theta*(b_L8_theta - n_L8_theta__L6_theta*x_L6_theta
        - phi_guide_offset_L8_theta*x_guide_offset);
    x[2] = x_L8_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_L6_theta_L7_theta = lin->value[0];
    const Lanes mass_L6_theta_L2_theta = lin->value[1];
    const Lanes mass_L7_theta_L2_theta = lin->value[2];
    const Lanes mass_L6_theta_L3_theta = lin->value[3];
    const Lanes mass_L7_theta_L3_theta = lin->value[4];
    const Lanes mass_L6_theta_L8_theta = lin->value[5];
    const Lanes phi_guide_offset_L6_theta = lin->value[6];
    const Lanes phi_guide_offset_L8_theta = lin->value[7];
    const Lanes by_q_guide_offset_L6_theta = lin->value[8];
    const Lanes by_q_guide_offset_L8_theta = lin->value[9];
    const Lanes by_q_L6_theta_L6_theta = lin->value[10];
    const Lanes by_q_L6_theta_L7_theta = lin->value[11];
    const Lanes by_q_L6_theta_L2_theta = lin->value[12];
    const Lanes by_q_L6_theta_L3_theta = lin->value[13];
    const Lanes by_q_L6_theta_L8_theta = lin->value[14];
    const Lanes by_q_L7_theta_L6_theta = lin->value[15];
    const Lanes by_q_L7_theta_L7_theta = lin->value[16];
    const Lanes by_q_L7_theta_L2_theta = lin->value[17];
    const Lanes by_q_L7_theta_L3_theta = lin->value[18];
    const Lanes by_q_L8_theta_L8_theta = lin->value[19];
    const Lanes by_q_L8_theta_L6_theta = lin->value[20];
    const Lanes by_q_L2_theta_L6_theta = lin->value[21];
    const Lanes by_q_L2_theta_L7_theta = lin->value[22];
    const Lanes by_q_L2_theta_L2_theta = lin->value[23];
    const Lanes by_q_L3_theta_L6_theta = lin->value[24];
    const Lanes by_q_L3_theta_L7_theta = lin->value[25];
    const Lanes by_q_L3_theta_L3_theta = lin->value[26];
    const Lanes by_t_L6_theta = lin->value[45];
    const Lanes by_t_L7_theta = lin->value[46];
    const Lanes by_t_L2_theta = lin->value[47];
    const Lanes by_t_L3_theta = lin->value[48];
    const Lanes power_q_0_L6_theta = lin->value[49];
    const Lanes power_q_0_L7_theta = lin->value[50];
    const Lanes power_q_0_L2_theta = lin->value[51];
    const Lanes power_q_0_L3_theta = lin->value[52];
    const Lanes power_q_2_L6_theta = lin->value[53];
    const Lanes power_q_2_L7_theta = lin->value[54];
    const Lanes power_q_2_L2_theta = lin->value[55];
    const Lanes power_q_2_L3_theta = lin->value[56];
    const Lanes power_v_0_L6_theta = lin->value[57];
    const Lanes power_v_0_L7_theta = lin->value[58];
    const Lanes power_v_0_L2_theta = lin->value[59];
    const Lanes power_v_0_L3_theta = lin->value[60];
    const Lanes power_v_2_L6_theta = lin->value[61];
    const Lanes power_v_2_L7_theta = lin->value[62];
    const Lanes power_v_2_L2_theta = lin->value[63];
    const Lanes power_v_2_L3_theta = lin->value[64];
    const Lanes power_t_0 = lin->value[65];
    const Lanes power_t_2 = lin->value[66];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[6];
    const Lanes shifted_L6_theta = -p->beta_squared*eta*r[0] + r[5];
    const Lanes shifted_L8_theta = -p->beta_squared*eta*r[2] + r[7];
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

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
