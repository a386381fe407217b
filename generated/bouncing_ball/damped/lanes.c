/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct {
    Lanes height;
    Lanes ball_mass;
    Lanes ball_inertia;
    Lanes alpha;
    Lanes beta;
    Lanes floor_radius;
    Lanes floor_clearance;
    Lanes floor_length;
    Lanes steel_E;
    Lanes steel_nu;
    Lanes damped_normal_stiffness;
    Lanes damped_normal_exponent;
    Lanes damped_normal_restitution;
    Lanes velocity_floor;
    Lanes gravity_y;
    Lanes R_j_floor;
    Lanes damped_floor_hysteresis;
    Lanes weight_ball_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_ball_mass;
    Lanes inverse_ball_inertia;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->floor_radius;
    default:
        return all_of(0.0);
    }
}

/*
 * Hertz contact with a choice of hysteresis damping.
 * Source: H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 * Valid: a point or a line contact whose stiffness is known or that of spheres; small penetrations.
 * Options: dissipation: hunt_crossley.
 * stiffness: force at unit penetration, N/m^n; exponent: exponent of the penetration; hysteresis: hysteresis
 * damping factor a.
 */
static inline void hertz(Lanes delta, Lanes ratio, Lanes stiffness, Lanes exponent, Lanes hysteresis, Lanes *F_n_out)
{
    const Lanes side_1 = lanes_sign_of(hysteresis*ratio + 1.0);
    const Lanes larger_1 = pick(side_1 < 0.0, all_of(0.0), hysteresis*ratio + 1.0);
    *F_n_out = stiffness*lanes_pow(delta, exponent)*larger_1;
}

/* Dry contact in joint fall, as in clearance.c. */
static inline LanePinForce dry_fall(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p)
{
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = 0.5*delta + p->floor_radius;
    const Lanes a_j = -0.5*delta + p->R_j_floor;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n;
    hertz(lanes_max_of(delta, all_of(0.0)), ratio, p->damped_normal_stiffness, p->damped_normal_exponent,
        p->damped_floor_hysteresis, &F_n);
    const Lanes F_along_t_dry = all_of(0.0); /* no friction */
    (void)v_t;
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry};
}

/* Joint fall: what each lane does not have is passed over where no lane has it. */
static void clearance_fall(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->floor_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = delta > 0.0;
    if (any_of(touching)) {
        LanePinForce dry = dry_fall(delta, deltadot, de_t, omega_i, omega_j, latch, p);
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
    (void)t, (void)rare;
    /* coordinates, velocities, time */
    const Lanes ball_x = q[0];
    const Lanes ball_x_rate = v[0];
    const Lanes ball_y = q[1];
    const Lanes ball_y_rate = v[1];
    const Lanes ball_omega = v[2];

    /* clearance joint fall */
    const Lanes e_fall_x = ball_x;
    const Lanes e_fall_y = ball_y;
    const Lanes edot_fall_x = ball_x_rate;
    const Lanes edot_fall_y = ball_y_rate;
    clearance_fall(e_fall_x, e_fall_y, edot_fall_x, edot_fall_y, all_of(0.0), ball_omega, &memory->latch[0], p,
        &aside->clearance[0]);
    const Lanes F_fall_x = aside->clearance[0].Fx;
    const Lanes F_fall_y = aside->clearance[0].Fy;
    const Lanes M_fall_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_fall_x*edot_fall_x + F_fall_y*edot_fall_y + M_fall_second*ball_omega;

    /* forward substitution */
    const Lanes z_ball_y = F_fall_y + p->weight_ball_y;

    /* backward substitution */
    const Lanes acceleration_ball_theta = M_fall_second*p->inverse_ball_inertia;
    const Lanes acceleration_ball_y = p->inverse_ball_mass*z_ball_y;
    const Lanes acceleration_ball_x = F_fall_x*p->inverse_ball_mass;

    /* results */
    a[0] = acceleration_ball_x;
    a[1] = acceleration_ball_y;
    a[2] = acceleration_ball_theta;
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
    const Lanes dq_acceleration_ball_theta = all_of(0.0);
    const Lanes dq_acceleration_ball_y = all_of(0.0);
    const Lanes dq_acceleration_ball_x = all_of(0.0);

    /* backward substitution */
    const Lanes dv_acceleration_ball_theta = all_of(0.0);
    const Lanes dv_acceleration_ball_y = all_of(0.0);
    const Lanes dv_acceleration_ball_x = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_ball_x;
    dv[0] = dv_acceleration_ball_x;
    dq[1] = dq_acceleration_ball_y;
    dv[1] = dv_acceleration_ball_y;
    dq[2] = dq_acceleration_ball_theta;
    dv[2] = dv_acceleration_ball_theta;
    *worst = all_of(0.0);
}

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
