/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct {
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
    Lanes *F_n_out)
{
    const Lanes side_1 = lanes_sign_of(hysteresis*ratio + 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    *F_n_out = lanes_pow(delta, exponent)*K*larger_1;
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 * mu: coefficient of friction; v0: slip below which there is no friction; friction_slope: 1/(v1 - v0).
 */
static inline void modified_coulomb(Lanes F_n, Lanes v_t, Lanes mu, Lanes v0, Lanes friction_slope, Lanes *F_t_out)
{
    const Lanes side_1 = lanes_sign_of(-friction_slope*(-v0 - v_t) + 1.0);
    const Lanes smaller_1 = pick(side_1 < 0.0, all_of(1.0), friction_slope*(-v0 - v_t));
    const Lanes side_2 = lanes_sign_of(smaller_1);
    const Lanes side_3 = lanes_sign_of(-friction_slope*(-v0 + v_t) + 1.0);
    const Lanes smaller_2 = pick(side_3 < 0.0, all_of(1.0), friction_slope*(-v0 + v_t));
    const Lanes side_4 = lanes_sign_of(smaller_2);
    const Lanes larger_1 = pick(side_2 < 0.0, all_of(0.0), smaller_1);
    const Lanes larger_2 = pick(side_4 < 0.0, all_of(0.0), smaller_2);
    *F_t_out = -F_n*mu*(-larger_1 + larger_2);
}

/* Dry contact in joint A, as in clearance.c. */
static inline LanePinForce dry_A(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p)
{
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius;
    const Lanes a_j = -0.5*delta + p->R_j_pin;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent, p->dry_pin_K,
        p->dry_pin_hysteresis, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu, p->dry_friction_v0, p->dry_pin_friction_slope, &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry};
}

/* Joint A: what each lane does not have is passed over where no lane has it. */
static void clearance_A(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = delta > 0.0;
    if (any_of(touching)) {
        LanePinForce dry = dry_A(delta, deltadot, de_t, omega_i, omega_j, latch, p);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
    }
    *out = (LaneClearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t, .e = e,
        .deltadot = deltadot, .delta = delta, .moment_first = F.M_i, .moment_second = F.M_j};
}

/* Dry contact in joint B, as in clearance.c. */
static inline LanePinForce dry_B(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p)
{
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->pin_radius;
    const Lanes a_j = -0.5*delta + p->R_j_pin;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    lankarani_nikravesh(lanes_max_of(delta, all_of(0.0)), ratio, p->dry_normal_exponent, p->dry_pin_K,
        p->dry_pin_hysteresis, &F_n);
    Lanes F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu, p->dry_friction_v0, p->dry_pin_friction_slope, &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry};
}

/* Joint B: what each lane does not have is passed over where no lane has it. */
static void clearance_B(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->pin_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = delta > 0.0;
    if (any_of(touching)) {
        LanePinForce dry = dry_B(delta, deltadot, de_t, omega_i, omega_j, latch, p);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
    }
    *out = (LaneClearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t, .e = e,
        .deltadot = deltadot, .delta = delta, .moment_first = F.M_i, .moment_second = F.M_j};
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
    clearance_A(e_A_x, e_A_y, edot_A_x, edot_A_y, crank1_rate, L2_omega, &memory->latch[0], p, &aside->clearance[0]);
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
    clearance_B(e_B_x, e_B_y, edot_B_x, edot_B_y, crank4_rate, L3_omega, &memory->latch[1], p, &aside->clearance[1]);
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

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
