/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct {
    Lanes par_g;
    Lanes length;
    Lanes bob_mass;
    Lanes bob_inertia;
    Lanes alpha;
    Lanes beta;
    Lanes rod_length;
    Lanes gravity_y;
    Lanes set_bob_x;
    Lanes set_bob_theta;
    Lanes rates_bob_omega;
    Lanes rod_half_inverse_length;
    Lanes weight_bob_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_bob_inertia;
    Lanes inverse_bob_mass;
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
    (void)t, (void)rare;
    /* coordinates, velocities, time */
    const Lanes bob_x = q[0];
    const Lanes bob_y = q[1];

    /* rows */
    /* rod.length */
    out[0] = (bob_x * bob_x)*p->rod_half_inverse_length + (bob_y * bob_y)*p->rod_half_inverse_length
        - 0.5*p->rod_length;
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t, (void)rare;
    /* coordinates, velocities, time */
    const Lanes bob_x = q[0];
    const Lanes bob_x_rate = v[0];
    const Lanes bob_y = q[1];
    const Lanes bob_y_rate = v[1];

    /* rows */
    /* rod.length */
    out[0] = 2.0*bob_x*bob_x_rate*p->rod_half_inverse_length + 2.0*bob_y*bob_y_rate*p->rod_half_inverse_length;
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const Lanes bob_x = q[0];
    const Lanes bob_x_rate = v[0];
    const Lanes bob_y = q[1];
    const Lanes bob_y_rate = v[1];

    /* constraints: gamma */
    const Lanes rhs_rod_length = -2.0*(bob_x_rate * bob_x_rate)*p->rod_half_inverse_length
        - 2.0*(bob_y_rate * bob_y_rate)*p->rod_half_inverse_length;

    /* L D L^T of the KKT matrix */
    const Lanes w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const Lanes l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const Lanes w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const Lanes l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const Lanes scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    *rare |= ~((scale_rod_length > 0.0) & (scale_rod_length < INFINITY));
    const Lanes inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* forward substitution */
    const Lanes z_rod_length = -l_rod_length__bob_y*p->weight_bob_y + rhs_rod_length;

    /* backward substitution */
    const Lanes lambda_rod_length = -inverse_pivot_rod_length*z_rod_length;
    const Lanes acceleration_bob_y = p->inverse_bob_mass*p->weight_bob_y - l_rod_length__bob_y*lambda_rod_length;
    const Lanes acceleration_bob_x = -l_rod_length__bob_x*lambda_rod_length;
    const Lanes acceleration_bob_theta = all_of(0.0);

    /* results */
    a[0] = acceleration_bob_x;
    a[1] = acceleration_bob_y;
    a[2] = acceleration_bob_theta;
    aside->lambda[0] = lambda_rod_length;

    /* a pivot vanished: rows depend on each other here */
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
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const Lanes bob_x = q[0];
    const Lanes bob_x_rate = v[0];
    const Lanes bob_y = q[1];
    const Lanes bob_y_rate = v[1];

    /* Phi and Phi_dot */
    const Lanes phi_rod_length = (bob_x * bob_x)*p->rod_half_inverse_length
        + (bob_y * bob_y)*p->rod_half_inverse_length - 0.5*p->rod_length;
    const Lanes phi_dot_rod_length = 2.0*bob_x*bob_x_rate*p->rod_half_inverse_length
        + 2.0*bob_y*bob_y_rate*p->rod_half_inverse_length;

    /* L D L^T of the KKT matrix */
    const Lanes w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const Lanes l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const Lanes w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const Lanes l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const Lanes scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    *rare |= ~((scale_rod_length > 0.0) & (scale_rod_length < INFINITY));
    const Lanes inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* backward substitution */
    const Lanes dq_lambda_rod_length = -inverse_pivot_rod_length*phi_rod_length;
    const Lanes dq_acceleration_bob_y = -dq_lambda_rod_length*l_rod_length__bob_y;
    const Lanes dq_acceleration_bob_x = -dq_lambda_rod_length*l_rod_length__bob_x;
    const Lanes dq_acceleration_bob_theta = all_of(0.0);

    /* backward substitution */
    const Lanes dv_lambda_rod_length = -inverse_pivot_rod_length*phi_dot_rod_length;
    const Lanes dv_acceleration_bob_y = -dv_lambda_rod_length*l_rod_length__bob_y;
    const Lanes dv_acceleration_bob_x = -dv_lambda_rod_length*l_rod_length__bob_x;
    const Lanes dv_acceleration_bob_theta = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_bob_x;
    dv[0] = dv_acceleration_bob_x;
    dq[1] = dq_acceleration_bob_y;
    dv[1] = dv_acceleration_bob_y;
    dq[2] = dq_acceleration_bob_theta;
    dv[2] = dv_acceleration_bob_theta;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_rod_length));
}

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
