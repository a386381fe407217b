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
    Lanes gravity_y;
    Lanes weight_ball_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_ball_inertia;
    Lanes inverse_ball_mass;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    default:
        return all_of(0.0);
    }
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
    (void)t, (void)q, (void)v, (void)memory, (void)p, (void)rare;
    /* backward substitution */
    const Lanes acceleration_ball_theta = all_of(0.0);

    /* results */
    a[0] = acceleration_ball_theta;
    aside->power[0] = all_of(0.0);
    aside->power[1] = all_of(0.0);
    aside->power[2] = all_of(0.0);
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

    /* backward substitution */
    const Lanes dv_acceleration_ball_theta = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_ball_theta;
    dv[0] = dv_acceleration_ball_theta;
    *worst = all_of(0.0);
}

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
