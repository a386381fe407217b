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

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_factor_complex(Lanes eta, Lanes eta_i, LaneComplexLinear *lin, LaneBits *rare)
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
    const Lanes factor_1 = p->beta_squared*eta + p->two_alpha;
    const Lanes factor_2 = p->beta_squared*eta_i;
    const Lanes divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const Lanes divisor_2 = eta*factor_2 + eta_i*factor_1;
    const Lanes divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const Lanes factor_3 = divisor_1*divisor_3;
    const Lanes factor_4 = -divisor_2*divisor_3;
    const Lanes eta_row = eta*factor_3 - eta_i*factor_4;
    const Lanes eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* matrix */
    const Lanes n_bob_x__bob_x = p->bob_mass + by_q_bob_x_bob_x*((eta * eta) - (eta_i * eta_i));
    const Lanes n_bob_x__bob_x_i = 2.0*by_q_bob_x_bob_x*eta*eta_i;
    const Lanes n_bob_y__bob_y = p->bob_mass + by_q_bob_x_bob_x*((eta * eta) - (eta_i * eta_i));
    const Lanes n_bob_y__bob_y_i = 2.0*by_q_bob_x_bob_x*eta*eta_i;
    const Lanes factor_5 = by_q_rod_length_bob_x*eta + by_v_rod_length_bob_x;
    const Lanes factor_6 = by_q_rod_length_bob_x*eta_i;
    const Lanes n_rod_length__bob_x = eta_row*factor_5 - eta_row_i*factor_6 + phi_rod_length_bob_x;
    const Lanes n_rod_length__bob_x_i = eta_row*factor_6 + eta_row_i*factor_5;
    const Lanes factor_7 = by_q_rod_length_bob_y*eta + by_v_rod_length_bob_y;
    const Lanes factor_8 = by_q_rod_length_bob_y*eta_i;
    const Lanes n_rod_length__bob_y = eta_row*factor_7 - eta_row_i*factor_8 + phi_rod_length_bob_y;
    const Lanes n_rod_length__bob_y_i = eta_row*factor_8 + eta_row_i*factor_7;

    /* L U */
    const Lanes scale_bob_x = n_bob_x__bob_x;
    const Lanes scale_bob_x_i = n_bob_x__bob_x_i;
    const Lanes size_1 = lanes_fabs(scale_bob_x) + lanes_fabs(scale_bob_x_i);
    const Lanes size_2 = lanes_fabs(n_bob_x__bob_x) + lanes_fabs(n_bob_x__bob_x_i);
    *rare |= ~(size_1 > SINGULAR * size_2);
    const Lanes divisor_4 = 1.0/((scale_bob_x * scale_bob_x) + (scale_bob_x_i * scale_bob_x_i));
    const Lanes inverse_pivot_bob_x = divisor_4*scale_bob_x;
    const Lanes inverse_pivot_bob_x_i = -divisor_4*scale_bob_x_i;
    lin->lu[0] = inverse_pivot_bob_x;
    lin->lu[1] = inverse_pivot_bob_x_i;
    const Lanes l_rod_length__bob_x = inverse_pivot_bob_x*n_rod_length__bob_x
        - inverse_pivot_bob_x_i*n_rod_length__bob_x_i;
    const Lanes l_rod_length__bob_x_3_i = inverse_pivot_bob_x*n_rod_length__bob_x_i
        + inverse_pivot_bob_x_i*n_rod_length__bob_x;
    lin->lu[2] = l_rod_length__bob_x;
    lin->lu[3] = l_rod_length__bob_x_3_i;
    const Lanes scale_bob_y = n_bob_y__bob_y;
    const Lanes scale_bob_y_i = n_bob_y__bob_y_i;
    const Lanes size_3 = lanes_fabs(scale_bob_y) + lanes_fabs(scale_bob_y_i);
    const Lanes size_4 = lanes_fabs(n_bob_y__bob_y) + lanes_fabs(n_bob_y__bob_y_i);
    *rare |= ~(size_3 > SINGULAR * size_4);
    const Lanes divisor_5 = 1.0/((scale_bob_y * scale_bob_y) + (scale_bob_y_i * scale_bob_y_i));
    const Lanes inverse_pivot_bob_y = divisor_5*scale_bob_y;
    const Lanes inverse_pivot_bob_y_i = -divisor_5*scale_bob_y_i;
    lin->lu[4] = inverse_pivot_bob_y;
    lin->lu[5] = inverse_pivot_bob_y_i;
    const Lanes l_rod_length__bob_y = inverse_pivot_bob_y*n_rod_length__bob_y
        - inverse_pivot_bob_y_i*n_rod_length__bob_y_i;
    const Lanes l_rod_length__bob_y_3_i = inverse_pivot_bob_y*n_rod_length__bob_y_i
        + inverse_pivot_bob_y_i*n_rod_length__bob_y;
    lin->lu[6] = l_rod_length__bob_y;
    lin->lu[7] = l_rod_length__bob_y_3_i;
    const Lanes scale_rod_length = -l_rod_length__bob_x*phi_rod_length_bob_x - l_rod_length__bob_y*phi_rod_length_bob_y;
    const Lanes scale_rod_length_3_i = -l_rod_length__bob_x_3_i*phi_rod_length_bob_x
        - l_rod_length__bob_y_3_i*phi_rod_length_bob_y;
    const Lanes size_5 = lanes_fabs(scale_rod_length) + lanes_fabs(scale_rod_length_3_i);
    *rare |= ~((size_5 > 0.0) & (size_5 < INFINITY));
    const Lanes divisor_6 = 1.0/((scale_rod_length * scale_rod_length) + (scale_rod_length_3_i * scale_rod_length_3_i));
    const Lanes inverse_pivot_rod_length = divisor_6*scale_rod_length;
    const Lanes inverse_pivot_rod_length_3_i = -divisor_6*scale_rod_length_3_i;
    lin->lu[8] = inverse_pivot_rod_length;
    lin->lu[9] = inverse_pivot_rod_length_3_i;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const LaneComplexLinear *lin, Lanes *x)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_rod_length_bob_x = lin->value[0];
    const Lanes phi_rod_length_bob_y = lin->value[1];
    const Lanes inverse_pivot_bob_x = lin->lu[0];
    const Lanes inverse_pivot_bob_x_i = lin->lu[1];
    const Lanes l_rod_length__bob_x = lin->lu[2];
    const Lanes l_rod_length__bob_x_3_i = lin->lu[3];
    const Lanes inverse_pivot_bob_y = lin->lu[4];
    const Lanes inverse_pivot_bob_y_i = lin->lu[5];
    const Lanes l_rod_length__bob_y = lin->lu[6];
    const Lanes l_rod_length__bob_y_3_i = lin->lu[7];
    const Lanes inverse_pivot_rod_length = lin->lu[8];
    const Lanes inverse_pivot_rod_length_3_i = lin->lu[9];

    /* forward */
    const Lanes b_bob_theta = x[4];
    const Lanes b_bob_theta_i = x[5];
    const Lanes b_bob_x = x[0];
    const Lanes b_bob_x_i = x[1];
    const Lanes b_bob_y = x[2];
    const Lanes b_bob_y_i = x[3];
    const Lanes b_rod_length = -b_bob_x*l_rod_length__bob_x + b_bob_x_i*l_rod_length__bob_x_3_i
        - b_bob_y*l_rod_length__bob_y + b_bob_y_i*l_rod_length__bob_y_3_i + x[6];
    const Lanes b_rod_length_i = -b_bob_x*l_rod_length__bob_x_3_i - b_bob_x_i*l_rod_length__bob_x
        - b_bob_y*l_rod_length__bob_y_3_i - b_bob_y_i*l_rod_length__bob_y + x[7];

    /* backward */
    const Lanes x_rod_length = b_rod_length*inverse_pivot_rod_length - b_rod_length_i*inverse_pivot_rod_length_3_i;
    const Lanes x_rod_length_i = b_rod_length*inverse_pivot_rod_length_3_i + b_rod_length_i*inverse_pivot_rod_length;
    x[6] = x_rod_length;
    x[7] = x_rod_length_i;
    const Lanes factor_1 = b_bob_y - phi_rod_length_bob_y*x_rod_length;
    const Lanes factor_2 = b_bob_y_i - phi_rod_length_bob_y*x_rod_length_i;
    const Lanes x_bob_y = factor_1*inverse_pivot_bob_y - factor_2*inverse_pivot_bob_y_i;
    const Lanes x_bob_y_i = factor_1*inverse_pivot_bob_y_i + factor_2*inverse_pivot_bob_y;
    x[2] = x_bob_y;
    x[3] = x_bob_y_i;
    const Lanes factor_3 = b_bob_x - phi_rod_length_bob_x*x_rod_length;
    const Lanes factor_4 = b_bob_x_i - phi_rod_length_bob_x*x_rod_length_i;
    const Lanes x_bob_x = factor_3*inverse_pivot_bob_x - factor_4*inverse_pivot_bob_x_i;
    const Lanes x_bob_x_i = factor_3*inverse_pivot_bob_x_i + factor_4*inverse_pivot_bob_x;
    x[0] = x_bob_x;
    x[1] = x_bob_x_i;
    const Lanes x_bob_theta = b_bob_theta*p->inverse_bob_inertia;
    const Lanes x_bob_theta_i = b_bob_theta_i*p->inverse_bob_inertia;
    x[4] = x_bob_theta;
    x[5] = x_bob_theta_i;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_solve_complex(const LaneComplexLinear *lin, Lanes eta, Lanes eta_i, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_rod_length_bob_x = lin->value[0];
    const Lanes phi_rod_length_bob_y = lin->value[1];
    const Lanes by_q_rod_length_bob_x = lin->value[2];
    const Lanes by_q_rod_length_bob_y = lin->value[3];
    const Lanes by_q_bob_x_bob_x = lin->value[4];

    /* eta/kappa */
    const Lanes factor_1 = p->beta_squared*eta + p->two_alpha;
    const Lanes factor_2 = p->beta_squared*eta_i;
    const Lanes divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const Lanes divisor_2 = eta*factor_2 + eta_i*factor_1;
    const Lanes divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const Lanes factor_3 = divisor_1*divisor_3;
    const Lanes factor_4 = -divisor_2*divisor_3;
    const Lanes eta_row = eta*factor_3 - eta_i*factor_4;
    const Lanes eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* right-hand side */
    Lanes x[8];
    const Lanes shifted_bob_x = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[6];
    const Lanes shifted_bob_x_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[7];
    const Lanes shifted_bob_y = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[8];
    const Lanes shifted_bob_y_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[9];
    const Lanes factor_5 = p->bob_mass*r[6] - by_q_bob_x_bob_x*(eta*r[0] - eta_i*r[1]);
    const Lanes factor_6 = p->bob_mass*r[7] - by_q_bob_x_bob_x*(eta*r[1] + eta_i*r[0]);
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const Lanes factor_7 = p->bob_mass*r[8] - by_q_bob_x_bob_x*(eta*r[2] - eta_i*r[3]);
    const Lanes factor_8 = p->bob_mass*r[9] - by_q_bob_x_bob_x*(eta*r[3] + eta_i*r[2]);
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    x[4] = p->bob_inertia*(eta*r[10] - eta_i*r[11]);
    x[5] = p->bob_inertia*(eta*r[11] + eta_i*r[10]);
    const Lanes factor_9 = -by_q_rod_length_bob_x*(eta*r[0] - eta_i*r[1])
        - by_q_rod_length_bob_y*(eta*r[2] - eta_i*r[3]) + phi_rod_length_bob_x*shifted_bob_x
        + phi_rod_length_bob_y*shifted_bob_y;
    const Lanes factor_10 = -by_q_rod_length_bob_x*(eta*r[1] + eta_i*r[0])
        - by_q_rod_length_bob_y*(eta*r[3] + eta_i*r[2]) + phi_rod_length_bob_x*shifted_bob_x_i
        + phi_rod_length_bob_y*shifted_bob_y_i;
    x[6] = eta_row*factor_9 - eta_row_i*factor_10;
    x[7] = eta_row*factor_10 + eta_row_i*factor_9;
    newton_substitute_complex(lin, x);

    /* solution */
    const Lanes factor_11 = r[0] + x[0];
    const Lanes factor_12 = r[1] + x[1];
    u[0] = eta*factor_11 - eta_i*factor_12;
    u[1] = eta*factor_12 + eta_i*factor_11;
    u[6] = x[0];
    u[7] = x[1];
    const Lanes factor_13 = r[2] + x[2];
    const Lanes factor_14 = r[3] + x[3];
    u[2] = eta*factor_13 - eta_i*factor_14;
    u[3] = eta*factor_14 + eta_i*factor_13;
    u[8] = x[2];
    u[9] = x[3];
    const Lanes factor_15 = r[4] + x[4];
    const Lanes factor_16 = r[5] + x[5];
    u[4] = eta*factor_15 - eta_i*factor_16;
    u[5] = eta*factor_16 + eta_i*factor_15;
    u[10] = x[4];
    u[11] = x[5];
    u[12] = eta*r[12] - eta_i*r[13];
    u[13] = eta*r[13] + eta_i*r[12];
    u[14] = eta*r[14] - eta_i*r[15];
    u[15] = eta*r[15] + eta_i*r[14];
    u[16] = eta*r[16] - eta_i*r[17];
    u[17] = eta*r[17] + eta_i*r[16];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
