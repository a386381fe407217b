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

#if !HELD
#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
#else
/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory, const LaneParameters *p,
    const Lanes *a, const LaneAside *aside, LaneLinear *lin, LaneBits *rare)
{
    (void)t, (void)memory, (void)rare;
    /* coordinates, velocities, time */
    const Lanes bob_x = q[0];
    const Lanes bob_x_rate = v[0];
    const Lanes bob_y = q[1];
    const Lanes bob_y_rate = v[1];
    const Lanes a_bob_x = a[0];
    const Lanes a_bob_y = a[1];
    const Lanes held_lambda_rod_length = aside->lambda[0];

    /* results */
    lin->value[0] = 2.0*bob_x*p->rod_half_inverse_length;
    lin->value[1] = 2.0*bob_y*p->rod_half_inverse_length;
    lin->value[2] = 2.0*a_bob_x*p->rod_half_inverse_length + 2.0*bob_x_rate*p->rod_half_inverse_length*p->two_alpha;
    lin->value[3] = 2.0*a_bob_y*p->rod_half_inverse_length + 2.0*bob_y_rate*p->rod_half_inverse_length*p->two_alpha;
    lin->value[4] = 2.0*held_lambda_rod_length*p->rod_half_inverse_length;
    lin->value[5] = 4.0*bob_x_rate*p->rod_half_inverse_length;
    lin->value[6] = 4.0*bob_y_rate*p->rod_half_inverse_length;
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
    const Lanes phi_rod_length_bob_x = lin->value[0];
    const Lanes phi_rod_length_bob_y = lin->value[1];
    const Lanes by_q_rod_length_bob_x = lin->value[2];
    const Lanes by_q_rod_length_bob_y = lin->value[3];
    const Lanes by_q_bob_x_bob_x = lin->value[4];
    const Lanes by_v_rod_length_bob_x = lin->value[5];
    const Lanes by_v_rod_length_bob_y = lin->value[6];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_bob_x__bob_x = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const Lanes n_bob_y__bob_y = p->bob_mass + by_q_bob_x_bob_x*(eta * eta);
    const Lanes n_rod_length__bob_x = eta_row*(by_q_rod_length_bob_x*eta + by_v_rod_length_bob_x)
        + phi_rod_length_bob_x;
    const Lanes n_rod_length__bob_y = eta_row*(by_q_rod_length_bob_y*eta + by_v_rod_length_bob_y)
        + phi_rod_length_bob_y;

    /* L U */
    const Lanes scale_bob_x = n_bob_x__bob_x;
    *rare |= ~(lanes_fabs(scale_bob_x) > SINGULAR * lanes_fabs(n_bob_x__bob_x));
    const Lanes inverse_pivot_bob_x = 1.0/scale_bob_x;
    lin->lu[0] = inverse_pivot_bob_x;
    const Lanes l_rod_length__bob_x = inverse_pivot_bob_x*n_rod_length__bob_x;
    lin->lu[1] = l_rod_length__bob_x;
    const Lanes scale_bob_y = n_bob_y__bob_y;
    *rare |= ~(lanes_fabs(scale_bob_y) > SINGULAR * lanes_fabs(n_bob_y__bob_y));
    const Lanes inverse_pivot_bob_y = 1.0/scale_bob_y;
    lin->lu[2] = inverse_pivot_bob_y;
    const Lanes l_rod_length__bob_y = inverse_pivot_bob_y*n_rod_length__bob_y;
    lin->lu[3] = l_rod_length__bob_y;
    const Lanes scale_rod_length = -l_rod_length__bob_x*phi_rod_length_bob_x - l_rod_length__bob_y*phi_rod_length_bob_y;
    *rare |= ~((lanes_fabs(scale_rod_length) > 0.0) & (lanes_fabs(scale_rod_length) < INFINITY));
    const Lanes inverse_pivot_rod_length = 1.0/scale_rod_length;
    lin->lu[4] = inverse_pivot_rod_length;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_rod_length_bob_x = lin->value[0];
    const Lanes phi_rod_length_bob_y = lin->value[1];
    const Lanes inverse_pivot_bob_x = lin->lu[0];
    const Lanes l_rod_length__bob_x = lin->lu[1];
    const Lanes inverse_pivot_bob_y = lin->lu[2];
    const Lanes l_rod_length__bob_y = lin->lu[3];
    const Lanes inverse_pivot_rod_length = lin->lu[4];

    /* forward */
    const Lanes b_bob_theta = x[2];
    const Lanes b_bob_x = x[0];
    const Lanes b_bob_y = x[1];
    const Lanes b_rod_length = -b_bob_x*l_rod_length__bob_x - b_bob_y*l_rod_length__bob_y + x[3];

    /* backward */
    const Lanes x_rod_length = b_rod_length*inverse_pivot_rod_length;
    x[3] = x_rod_length;
    const Lanes x_bob_y = inverse_pivot_bob_y*(b_bob_y - phi_rod_length_bob_y*x_rod_length);
    x[1] = x_bob_y;
    const Lanes x_bob_x = inverse_pivot_bob_x*(b_bob_x - phi_rod_length_bob_x*x_rod_length);
    x[0] = x_bob_x;
    const Lanes x_bob_theta = b_bob_theta*p->inverse_bob_inertia;
    x[2] = x_bob_theta;
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
    const Lanes phi_rod_length_bob_x = lin->value[0];
    const Lanes phi_rod_length_bob_y = lin->value[1];
    const Lanes by_q_rod_length_bob_x = lin->value[2];
    const Lanes by_q_rod_length_bob_y = lin->value[3];
    const Lanes by_q_bob_x_bob_x = lin->value[4];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[4];
    const Lanes shifted_bob_x = -p->beta_squared*eta*r[0] + r[3];
    const Lanes shifted_bob_y = -p->beta_squared*eta*r[1] + r[4];
    x[0] = eta*(p->bob_mass*r[3] - by_q_bob_x_bob_x*eta*r[0]);
    x[1] = eta*(p->bob_mass*r[4] - by_q_bob_x_bob_x*eta*r[1]);
    x[2] = p->bob_inertia*eta*r[5];
    x[3] = eta_row*(-by_q_rod_length_bob_x*eta*r[0] - by_q_rod_length_bob_y*eta*r[1]
        + phi_rod_length_bob_x*shifted_bob_x + phi_rod_length_bob_y*shifted_bob_y);
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
    u[8] = eta*r[8];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
