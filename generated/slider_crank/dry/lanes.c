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
    Lanes c;
    Lanes crank_mass;
    Lanes crank_inertia;
    Lanes rod_mass;
    Lanes rod_inertia;
    Lanes slider_mass;
    Lanes slider_inertia;
    Lanes crank_length;
    Lanes rod_length;
    Lanes alpha;
    Lanes beta;
    Lanes cylinder_axis_x;
    Lanes pin_radius;
    Lanes pin_clearance;
    Lanes pin_length;
    Lanes steel_E;
    Lanes steel_nu;
    Lanes dry_normal_restitution;
    Lanes dry_normal_exponent;
    Lanes dry_friction_mu;
    Lanes dry_friction_v0;
    Lanes dry_friction_v1;
    Lanes velocity_floor;
    Lanes guess_rod_theta;
    Lanes guess_slider_x;
    Lanes crank_head_s_x;
    Lanes rod_head_s_x;
    Lanes R_j_pin;
    Lanes dry_pin_K;
    Lanes dry_pin_hysteresis;
    Lanes dry_pin_friction_slope;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_slider_mass;
    Lanes inverse_rod_mass;
    Lanes inverse_slider_inertia;
    Lanes inverse_crank_mass;
    Lanes inverse_rod_inertia;
    Lanes inverse_crank_inertia;
    Lanes crank_head_span_x;
    Lanes rod_head_span_x;
    Lanes inertia_crank_crank;
    Lanes inertia_crank_rod;
    Lanes inertia_rod_rod;
    Lanes mass_motor_motor;
    Lanes mass_rod_rod;
    Lanes inverse_mass_rod_rod;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
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

/* Dry contact in joint wristpin, as in clearance.c. */
static inline LanePinForce dry_wristpin(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
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

/* Joint wristpin: what each lane does not have is passed over where no lane has it. */
static void clearance_wristpin(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
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
        LanePinForce dry = dry_wristpin(delta, deltadot, de_t, omega_i, omega_j, latch, p);
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
    /* coordinates, velocities, time */
    const Lanes cylinder_slide = q[0];
    const Lanes cylinder_slide_rate = v[0];
    const Lanes rod_theta = q[1];
    const Lanes rod_omega = v[1];

    /* directions, arms, drives */
    const Lanes motor_value = p->omega*t;
    Lanes sines_0, cosines_0;
    sines_and_cosines(motor_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank = cosines_0;
    const Lanes sin_theta_crank = sines_0;
    const Lanes cos_theta_rod = cosines_1;
    const Lanes sin_theta_rod = sines_1;
    const Lanes motor_rate = p->omega;
    const Lanes motor_acceleration = all_of(0.0);
    const Lanes slider_omega = all_of(0.0);
    const Lanes span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const Lanes span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const Lanes crank_head_vx = -motor_rate*span_crank_head_y;
    const Lanes crank_head_vy = motor_rate*span_crank_head_x;
    const Lanes span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const Lanes span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const Lanes rod_head_x = span_crank_head_x + span_rod_head_x;
    const Lanes rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const Lanes rod_head_y = span_crank_head_y + span_rod_head_y;
    const Lanes rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const Lanes cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const Lanes sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const Lanes dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const Lanes cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* clearance joint wristpin */
    const Lanes e_wristpin_x = cylinder_slide - rod_head_x;
    const Lanes e_wristpin_y = -rod_head_y;
    const Lanes edot_wristpin_x = cylinder_slide_rate - rod_head_vx;
    const Lanes edot_wristpin_y = -rod_head_vy;
    clearance_wristpin(e_wristpin_x, e_wristpin_y, edot_wristpin_x, edot_wristpin_y, rod_omega, slider_omega,
        &memory->latch[0], p, &aside->clearance[0]);
    const Lanes F_wristpin_x = aside->clearance[0].Fx;
    const Lanes F_wristpin_y = aside->clearance[0].Fy;
    const Lanes M_wristpin_first = aside->clearance[0].moment_first;
    const Lanes M_wristpin_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_wristpin_x*edot_wristpin_x + F_wristpin_y*edot_wristpin_y
        + M_wristpin_first*rod_omega + M_wristpin_second*slider_omega;

    /* forward substitution */
    const Lanes z_rod_theta = F_wristpin_x*span_rod_head_y - F_wristpin_y*span_rod_head_x + M_wristpin_first
        - cross_crank_rod*(motor_rate * motor_rate) - dot_crank_rod*motor_acceleration;

    /* backward substitution */
    const Lanes acceleration_rod_theta = p->inverse_mass_rod_rod*z_rod_theta;
    const Lanes acceleration_cylinder_slide = F_wristpin_x*p->inverse_slider_mass;

    /* results */
    a[0] = acceleration_cylinder_slide;
    a[1] = acceleration_rod_theta;
    aside->power[0] = motor_rate*(-F_wristpin_x*span_crank_head_y + F_wristpin_y*span_crank_head_x + a[1]*dot_crank_rod
        - cross_crank_rod*(rod_omega * rod_omega) + p->mass_motor_motor*motor_acceleration);
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
    const Lanes dq_acceleration_rod_theta = all_of(0.0);
    const Lanes dq_acceleration_cylinder_slide = all_of(0.0);

    /* backward substitution */
    const Lanes dv_acceleration_rod_theta = all_of(0.0);
    const Lanes dv_acceleration_cylinder_slide = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_cylinder_slide;
    dv[0] = dv_acceleration_cylinder_slide;
    dq[1] = dq_acceleration_rod_theta;
    dv[1] = dv_acceleration_rod_theta;
    *worst = all_of(0.0);
}

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
