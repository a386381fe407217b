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
    Lanes g_;
    Lanes length_;
    Lanes bob_mass_;
    Lanes bob_inertia_;
    Lanes alpha_;
    Lanes beta_;
    Lanes rod_length_;
    Lanes gravity_y_;
    Lanes set_bob_x_;
    Lanes set_bob_theta_;
    Lanes rates_bob_omega_;
    Lanes rod_half_inverse_length_;
    Lanes weight_bob_y_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes inverse_bob_mass_;
    Lanes inverse_bob_inertia_;
    Lanes tree_metric_bob_x_;
    Lanes inverse_tree_metric_bob_x_;
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
    const Lanes bob_x_ = q[0];
    const Lanes bob_y_ = q[1];

    /* rows */
    /* rod.length */
    out[0] = (bob_x_ * bob_x_)*p->rod_half_inverse_length_ + (bob_y_ * bob_y_)*p->rod_half_inverse_length_
        - 0.5*p->rod_length_;
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t, (void)rare;
    /* coordinates, velocities, time */
    const Lanes bob_x_ = q[0];
    const Lanes bob_x_rate_ = v[0];
    const Lanes bob_y_ = q[1];
    const Lanes bob_y_rate_ = v[1];

    /* rows */
    /* rod.length */
    out[0] = 2.0*bob_x_*bob_x_rate_*p->rod_half_inverse_length_ + 2.0*bob_y_*bob_y_rate_*p->rod_half_inverse_length_;
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
    const Lanes bob_x_ = q[0];
    const Lanes bob_x_rate_ = v[0];
    const Lanes bob_y_ = q[1];
    const Lanes bob_y_rate_ = v[1];

    /* constraints: gamma */
    const Lanes rhs_rod_length_ = -2.0*(bob_x_rate_ * bob_x_rate_)*p->rod_half_inverse_length_
        - 2.0*(bob_y_rate_ * bob_y_rate_)*p->rod_half_inverse_length_;

    /* L D L^T of the KKT matrix */
    const Lanes w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const Lanes l_rod_length_bob_x_ = p->inverse_bob_mass_*w_rod_length_bob_x_;
    const Lanes w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const Lanes l_rod_length_bob_y_ = p->inverse_bob_mass_*w_rod_length_bob_y_;
    const Lanes scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    *rare |= ~((scale_rod_length_ > 0.0) & (scale_rod_length_ < INFINITY));
    const Lanes inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* forward substitution */
    const Lanes z_rod_length_ = -l_rod_length_bob_y_*p->weight_bob_y_ + rhs_rod_length_;

    /* backward substitution */
    const Lanes lambda_rod_length_ = -inverse_pivot_rod_length_*z_rod_length_;
    const Lanes acceleration_bob_y_ = p->inverse_bob_mass_*p->weight_bob_y_ - l_rod_length_bob_y_*lambda_rod_length_;
    const Lanes acceleration_bob_x_ = -l_rod_length_bob_x_*lambda_rod_length_;
    const Lanes acceleration_bob_theta_ = all_of(0.0);

    /* results */
    a[0] = acceleration_bob_x_;
    a[1] = acceleration_bob_y_;
    a[2] = acceleration_bob_theta_;
    aside->lambda[0] = lambda_rod_length_;

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
    const Lanes bob_x_ = q[0];
    const Lanes bob_x_rate_ = v[0];
    const Lanes bob_y_ = q[1];
    const Lanes bob_y_rate_ = v[1];

    /* Phi and Phi_dot */
    const Lanes phi_rod_length_ = (bob_x_ * bob_x_)*p->rod_half_inverse_length_
        + (bob_y_ * bob_y_)*p->rod_half_inverse_length_ - 0.5*p->rod_length_;
    const Lanes phi_dot_rod_length_ = 2.0*bob_x_*bob_x_rate_*p->rod_half_inverse_length_
        + 2.0*bob_y_*bob_y_rate_*p->rod_half_inverse_length_;

    /* L D L^T of the KKT matrix */
    const Lanes w_rod_length_bob_x_ = 2.0*bob_x_*p->rod_half_inverse_length_;
    const Lanes l_rod_length_bob_x_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_x_;
    const Lanes w_rod_length_bob_y_ = 2.0*bob_y_*p->rod_half_inverse_length_;
    const Lanes l_rod_length_bob_y_ = p->inverse_tree_metric_bob_x_*w_rod_length_bob_y_;
    const Lanes scale_rod_length_ = l_rod_length_bob_x_*w_rod_length_bob_x_ + l_rod_length_bob_y_*w_rod_length_bob_y_;
    *rare |= ~((scale_rod_length_ > 0.0) & (scale_rod_length_ < INFINITY));
    const Lanes inverse_pivot_rod_length_ = 1.0/scale_rod_length_;

    /* backward substitution */
    const Lanes dq_lambda_rod_length_ = -inverse_pivot_rod_length_*phi_rod_length_;
    const Lanes dq_acceleration_bob_y_ = -dq_lambda_rod_length_*l_rod_length_bob_y_;
    const Lanes dq_acceleration_bob_x_ = -dq_lambda_rod_length_*l_rod_length_bob_x_;
    const Lanes dq_acceleration_bob_theta_ = all_of(0.0);

    /* backward substitution */
    const Lanes dv_lambda_rod_length_ = -inverse_pivot_rod_length_*phi_dot_rod_length_;
    const Lanes dv_acceleration_bob_y_ = -dv_lambda_rod_length_*l_rod_length_bob_y_;
    const Lanes dv_acceleration_bob_x_ = -dv_lambda_rod_length_*l_rod_length_bob_x_;
    const Lanes dv_acceleration_bob_theta_ = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_bob_x_;
    dv[0] = dv_acceleration_bob_x_;
    dq[1] = dq_acceleration_bob_y_;
    dv[1] = dv_acceleration_bob_y_;
    dq[2] = dq_acceleration_bob_theta_;
    dv[2] = dv_acceleration_bob_theta_;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_rod_length_));
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
    const Lanes bob_x_ = q[0];
    const Lanes bob_x_rate_ = v[0];
    const Lanes bob_y_ = q[1];
    const Lanes bob_y_rate_ = v[1];
    const Lanes a_bob_x_ = a[0];
    const Lanes a_bob_y_ = a[1];
    const Lanes held_lambda_rod_length_ = aside->lambda[0];

    /* results */
    lin->value[0] = 2.0*bob_x_*p->rod_half_inverse_length_;
    lin->value[1] = 2.0*bob_y_*p->rod_half_inverse_length_;
    lin->value[2] = 2.0*a_bob_x_*p->rod_half_inverse_length_
        + 2.0*bob_x_rate_*p->rod_half_inverse_length_*p->two_alpha_;
    lin->value[3] = 2.0*a_bob_y_*p->rod_half_inverse_length_
        + 2.0*bob_y_rate_*p->rod_half_inverse_length_*p->two_alpha_;
    lin->value[4] = 2.0*held_lambda_rod_length_*p->rod_half_inverse_length_;
    lin->value[5] = 4.0*bob_x_rate_*p->rod_half_inverse_length_;
    lin->value[6] = 4.0*bob_y_rate_*p->rod_half_inverse_length_;
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
    const Lanes phi_rod_length_bob_x_ = lin->value[0];
    const Lanes phi_rod_length_bob_y_ = lin->value[1];
    const Lanes by_q_rod_length_bob_x_ = lin->value[2];
    const Lanes by_q_rod_length_bob_y_ = lin->value[3];
    const Lanes by_q_bob_x_bob_x_ = lin->value[4];
    const Lanes by_v_rod_length_bob_x_ = lin->value[5];
    const Lanes by_v_rod_length_bob_y_ = lin->value[6];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_bob_x_bob_x_ = p->bob_mass_ + by_q_bob_x_bob_x_*(eta * eta);
    const Lanes n_bob_y_bob_y_ = p->bob_mass_ + by_q_bob_x_bob_x_*(eta * eta);
    const Lanes n_rod_length_bob_x_ = eta_row*(by_q_rod_length_bob_x_*eta + by_v_rod_length_bob_x_)
        + phi_rod_length_bob_x_;
    const Lanes n_rod_length_bob_y_ = eta_row*(by_q_rod_length_bob_y_*eta + by_v_rod_length_bob_y_)
        + phi_rod_length_bob_y_;

    /* L U */
    const Lanes scale_bob_x_ = n_bob_x_bob_x_;
    *rare |= ~(lanes_fabs(scale_bob_x_) > SINGULAR * lanes_fabs(n_bob_x_bob_x_));
    const Lanes inverse_pivot_bob_x_ = 1.0/scale_bob_x_;
    lin->lu[0] = inverse_pivot_bob_x_;
    const Lanes l_rod_length_bob_x_ = inverse_pivot_bob_x_*n_rod_length_bob_x_;
    lin->lu[1] = l_rod_length_bob_x_;
    const Lanes scale_bob_y_ = n_bob_y_bob_y_;
    *rare |= ~(lanes_fabs(scale_bob_y_) > SINGULAR * lanes_fabs(n_bob_y_bob_y_));
    const Lanes inverse_pivot_bob_y_ = 1.0/scale_bob_y_;
    lin->lu[2] = inverse_pivot_bob_y_;
    const Lanes l_rod_length_bob_y_ = inverse_pivot_bob_y_*n_rod_length_bob_y_;
    lin->lu[3] = l_rod_length_bob_y_;
    const Lanes scale_rod_length_ = -l_rod_length_bob_x_*phi_rod_length_bob_x_
        - l_rod_length_bob_y_*phi_rod_length_bob_y_;
    *rare |= ~((lanes_fabs(scale_rod_length_) > 0.0) & (lanes_fabs(scale_rod_length_) < INFINITY));
    const Lanes inverse_pivot_rod_length_ = 1.0/scale_rod_length_;
    lin->lu[4] = inverse_pivot_rod_length_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_rod_length_bob_x_ = lin->value[0];
    const Lanes phi_rod_length_bob_y_ = lin->value[1];
    const Lanes inverse_pivot_bob_x_ = lin->lu[0];
    const Lanes l_rod_length_bob_x_ = lin->lu[1];
    const Lanes inverse_pivot_bob_y_ = lin->lu[2];
    const Lanes l_rod_length_bob_y_ = lin->lu[3];
    const Lanes inverse_pivot_rod_length_ = lin->lu[4];

    /* forward */
    const Lanes b_bob_theta_ = x[2];
    const Lanes b_bob_x_ = x[0];
    const Lanes b_bob_y_ = x[1];
    const Lanes b_rod_length_ = -b_bob_x_*l_rod_length_bob_x_ - b_bob_y_*l_rod_length_bob_y_ + x[3];

    /* backward */
    const Lanes x_rod_length_ = b_rod_length_*inverse_pivot_rod_length_;
    x[3] = x_rod_length_;
    const Lanes x_bob_y_ = inverse_pivot_bob_y_*(b_bob_y_ - phi_rod_length_bob_y_*x_rod_length_);
    x[1] = x_bob_y_;
    const Lanes x_bob_x_ = inverse_pivot_bob_x_*(b_bob_x_ - phi_rod_length_bob_x_*x_rod_length_);
    x[0] = x_bob_x_;
    const Lanes x_bob_theta_ = b_bob_theta_*p->inverse_bob_inertia_;
    x[2] = x_bob_theta_;
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
    const Lanes phi_rod_length_bob_x_ = lin->value[0];
    const Lanes phi_rod_length_bob_y_ = lin->value[1];
    const Lanes by_q_rod_length_bob_x_ = lin->value[2];
    const Lanes by_q_rod_length_bob_y_ = lin->value[3];
    const Lanes by_q_bob_x_bob_x_ = lin->value[4];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[4];
    const Lanes shifted_bob_x_ = -p->beta_squared_*eta*r[0] + r[3];
    const Lanes shifted_bob_y_ = -p->beta_squared_*eta*r[1] + r[4];
    x[0] = eta*(p->bob_mass_*r[3] - by_q_bob_x_bob_x_*eta*r[0]);
    x[1] = eta*(p->bob_mass_*r[4] - by_q_bob_x_bob_x_*eta*r[1]);
    x[2] = p->bob_inertia_*eta*r[5];
    x[3] = eta_row*(-by_q_rod_length_bob_x_*eta*r[0] - by_q_rod_length_bob_y_*eta*r[1]
        + phi_rod_length_bob_x_*shifted_bob_x_ + phi_rod_length_bob_y_*shifted_bob_y_);
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
