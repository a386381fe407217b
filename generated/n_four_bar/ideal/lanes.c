/*
 * The runs of a batch by rk4 with one step for all, several side by side (lanes.h). Steps on which nothing happens
 * but motion are made here; one on which in any lane a contact begins or ends, a watched expression crosses zero,
 * a pivot vanishes or a number ceases to be finite is made by the single runs themselves (rk4.c, many.c), each
 * for its own. A library of its own, compiled when it is first asked for.
 */
#include "model.h"
#include "batch.h"
#include "lanes.h"
#include <time.h>

enum { LANE_JOINTS = 1, LANE_EVENTS = 1, EVENTS_FULL = -3 };

typedef struct {
    Lanes length;
    Lanes mass;
    Lanes inertia;
    Lanes crank0_mass;
    Lanes crank0_inertia;
    Lanes crank1_mass;
    Lanes crank1_inertia;
    Lanes crank2_mass;
    Lanes crank2_inertia;
    Lanes coupler1_mass;
    Lanes coupler1_inertia;
    Lanes coupler2_mass;
    Lanes coupler2_inertia;
    Lanes crank0_length;
    Lanes crank1_length;
    Lanes crank2_length;
    Lanes coupler1_length;
    Lanes coupler2_length;
    Lanes alpha;
    Lanes beta;
    Lanes O1_x;
    Lanes O2_x;
    Lanes par_y;
    Lanes guess_crank1_theta;
    Lanes guess_crank2_theta;
    Lanes set_crank0_theta;
    Lanes rates_crank0_omega;
    Lanes crank0_head_x;
    Lanes crank1_head_x;
    Lanes crank2_head_x;
    Lanes coupler1_head_x;
    Lanes coupler2_head_x;
    Lanes weight_crank0_y;
    Lanes weight_crank1_y;
    Lanes weight_crank2_y;
    Lanes weight_coupler1_y;
    Lanes weight_coupler2_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_crank0_mass;
    Lanes inverse_crank2_mass;
    Lanes inverse_coupler1_mass;
    Lanes inverse_coupler2_mass;
    Lanes inverse_crank1_mass;
    Lanes inverse_crank0_inertia;
    Lanes inverse_crank2_inertia;
    Lanes inverse_coupler1_inertia;
    Lanes inverse_coupler2_inertia;
    Lanes inverse_crank1_inertia;
    Lanes crank0_head_span_x;
    Lanes crank1_head_span_x;
    Lanes coupler2_head_span_x;
    Lanes crank2_head_span_x;
    Lanes coupler1_head_span_x;
    Lanes inertia_crank0_crank0;
    Lanes inertia_crank1_crank1;
    Lanes inertia_crank2_crank2;
    Lanes inertia_crank0_coupler1;
    Lanes inertia_coupler1_coupler1;
    Lanes inertia_crank1_coupler2;
    Lanes inertia_coupler2_coupler2;
    Lanes mass_crank0_crank0;
    Lanes mass_crank1_crank1;
    Lanes mass_crank2_crank2;
    Lanes mass_coupler1_coupler1;
    Lanes mass_coupler2_coupler2;
    Lanes weight_crank0__across;
    Lanes weight_crank1__across;
    Lanes weight_crank2__across;
    Lanes weight_coupler1__across;
    Lanes weight_coupler2__across;
    Lanes inverse_mass_crank2_crank2;
    Lanes inverse_mass_coupler2_coupler2;
    Lanes inverse_mass_crank0_crank0;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

typedef struct {
    Lanes t, steps, evaluations, y[N_Y], dy[N_Y];
    Lanes phi_max, phi_dot_max, ratio_min, ratio_max, ratio_outside;
    struct LaneLatch {
        Lanes closed, deltadot_minus, compressing; /* 0 or 1, m/s, 0 or 1 */
        Lanes e, delta, deltadot, F_peak, t_peak, e_max;
        Lanes F_open, t_open;                      /* peak of the contact that goes on */
    } latch[1];
    Lanes event_side[1];
} LaneRun;

typedef struct {
    Lanes Fx, Fy, F_n, F_t, e, deltadot, delta, moment_first, moment_second, power;
} LaneClearance;

typedef struct {
    Lanes lambda[N_LOOPS + 1], power[N_WORK], event[LANE_EVENTS];
    LaneClearance clearance[LANE_JOINTS];
} LaneAside;

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
static void closures(const Lanes t, const Lanes *q, const LaneParameters *p, Lanes *out, LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank0_theta = q[0];
    const Lanes crank1_theta = q[1];
    const Lanes crank2_theta = q[2];
    const Lanes coupler1_theta = q[3];
    const Lanes coupler2_theta = q[4];

    /* parameters */
    const Lanes O1_x = p->O1_x;
    const Lanes O2_x = p->O2_x;
    const Lanes crank0_head_span_x = p->crank0_head_span_x;
    const Lanes crank1_head_span_x = p->crank1_head_span_x;
    const Lanes coupler2_head_span_x = p->coupler2_head_span_x;
    const Lanes crank2_head_span_x = p->crank2_head_span_x;
    const Lanes coupler1_head_span_x = p->coupler1_head_span_x;

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0 = cosines_0;
    const Lanes sin_theta_crank0 = sines_0;
    const Lanes cos_theta_crank1 = cosines_1;
    const Lanes sin_theta_crank1 = sines_1;
    const Lanes cos_theta_crank2 = cosines_2;
    const Lanes sin_theta_crank2 = sines_2;
    const Lanes cos_theta_coupler1 = cosines_3;
    const Lanes sin_theta_coupler1 = sines_3;
    const Lanes cos_theta_coupler2 = cosines_4;
    const Lanes sin_theta_coupler2 = sines_4;
    const Lanes span_crank0_head_x = cos_theta_crank0*crank0_head_span_x;
    const Lanes span_crank0_head_y = crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*crank1_head_span_x;
    const Lanes span_crank1_head_y = crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*coupler2_head_span_x;
    const Lanes span_coupler2_head_y = coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*crank2_head_span_x;
    const Lanes span_crank2_head_y = crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*coupler1_head_span_x;
    const Lanes span_coupler1_head_y = coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    out[0] = O1_x - O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;  /* B2.x */
    out[1] = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;  /* B2.y */
    out[2] = -O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;  /* B1.x */
    out[3] = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;  /* B1.y */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank0_theta = q[0];
    const Lanes crank0_omega = v[0];
    const Lanes crank1_theta = q[1];
    const Lanes crank1_omega = v[1];
    const Lanes crank2_theta = q[2];
    const Lanes crank2_omega = v[2];
    const Lanes coupler1_theta = q[3];
    const Lanes coupler1_omega = v[3];
    const Lanes coupler2_theta = q[4];
    const Lanes coupler2_omega = v[4];

    /* parameters */
    const Lanes crank0_head_span_x = p->crank0_head_span_x;
    const Lanes crank1_head_span_x = p->crank1_head_span_x;
    const Lanes coupler2_head_span_x = p->coupler2_head_span_x;
    const Lanes crank2_head_span_x = p->crank2_head_span_x;
    const Lanes coupler1_head_span_x = p->coupler1_head_span_x;

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0 = cosines_0;
    const Lanes sin_theta_crank0 = sines_0;
    const Lanes cos_theta_crank1 = cosines_1;
    const Lanes sin_theta_crank1 = sines_1;
    const Lanes cos_theta_crank2 = cosines_2;
    const Lanes sin_theta_crank2 = sines_2;
    const Lanes cos_theta_coupler1 = cosines_3;
    const Lanes sin_theta_coupler1 = sines_3;
    const Lanes cos_theta_coupler2 = cosines_4;
    const Lanes sin_theta_coupler2 = sines_4;
    const Lanes span_crank0_head_x = cos_theta_crank0*crank0_head_span_x;
    const Lanes span_crank0_head_y = crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*crank1_head_span_x;
    const Lanes span_crank1_head_y = crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*coupler2_head_span_x;
    const Lanes span_coupler2_head_y = coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*crank2_head_span_x;
    const Lanes span_crank2_head_y = crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*coupler1_head_span_x;
    const Lanes span_coupler1_head_y = coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    out[0] = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y +
        crank2_omega*span_crank2_head_y;  /* B2.x */
    out[1] = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x -
        crank2_omega*span_crank2_head_x;  /* B2.y */
    out[2] = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y +
        crank1_omega*span_crank1_head_y;  /* B1.x */
    out[3] = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x -
        crank1_omega*span_crank1_head_x;  /* B1.y */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneRun *memory, const
    LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const Lanes crank0_theta = q[0];
    const Lanes crank0_omega = v[0];
    const Lanes crank1_theta = q[1];
    const Lanes crank1_omega = v[1];
    const Lanes crank2_theta = q[2];
    const Lanes crank2_omega = v[2];
    const Lanes coupler1_theta = q[3];
    const Lanes coupler1_omega = v[3];
    const Lanes coupler2_theta = q[4];
    const Lanes coupler2_omega = v[4];

    /* parameters */
    const Lanes crank0_head_span_x = p->crank0_head_span_x;
    const Lanes crank1_head_span_x = p->crank1_head_span_x;
    const Lanes coupler2_head_span_x = p->coupler2_head_span_x;
    const Lanes crank2_head_span_x = p->crank2_head_span_x;
    const Lanes coupler1_head_span_x = p->coupler1_head_span_x;
    const Lanes inertia_crank0_coupler1 = p->inertia_crank0_coupler1;
    const Lanes inertia_crank1_coupler2 = p->inertia_crank1_coupler2;
    const Lanes mass_crank1_crank1 = p->mass_crank1_crank1;
    const Lanes mass_coupler1_coupler1 = p->mass_coupler1_coupler1;
    const Lanes weight_crank0__across = p->weight_crank0__across;
    const Lanes weight_crank1__across = p->weight_crank1__across;
    const Lanes weight_crank2__across = p->weight_crank2__across;
    const Lanes weight_coupler1__across = p->weight_coupler1__across;
    const Lanes weight_coupler2__across = p->weight_coupler2__across;
    const Lanes inverse_mass_crank2_crank2 = p->inverse_mass_crank2_crank2;
    const Lanes inverse_mass_coupler2_coupler2 = p->inverse_mass_coupler2_coupler2;
    const Lanes inverse_mass_crank0_crank0 = p->inverse_mass_crank0_crank0;

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0 = cosines_0;
    const Lanes sin_theta_crank0 = sines_0;
    const Lanes cos_theta_crank1 = cosines_1;
    const Lanes sin_theta_crank1 = sines_1;
    const Lanes cos_theta_crank2 = cosines_2;
    const Lanes sin_theta_crank2 = sines_2;
    const Lanes cos_theta_coupler1 = cosines_3;
    const Lanes sin_theta_coupler1 = sines_3;
    const Lanes cos_theta_coupler2 = cosines_4;
    const Lanes sin_theta_coupler2 = sines_4;
    const Lanes span_crank0_head_x = cos_theta_crank0*crank0_head_span_x;
    const Lanes span_crank0_head_y = crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*crank1_head_span_x;
    const Lanes span_crank1_head_y = crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*coupler2_head_span_x;
    const Lanes span_coupler2_head_y = coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*crank2_head_span_x;
    const Lanes span_crank2_head_y = crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*coupler1_head_span_x;
    const Lanes span_coupler1_head_y = coupler1_head_span_x*sin_theta_coupler1;
    const Lanes cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 +
        sin_theta_coupler1*sin_theta_crank0;
    const Lanes sin_coupler1_less_crank0 = -cos_theta_coupler1*sin_theta_crank0 +
        cos_theta_crank0*sin_theta_coupler1;
    const Lanes dot_crank0_coupler1 = cos_coupler1_less_crank0*inertia_crank0_coupler1;
    const Lanes cross_crank0_coupler1 = inertia_crank0_coupler1*sin_coupler1_less_crank0;
    const Lanes cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 +
        sin_theta_coupler2*sin_theta_crank1;
    const Lanes sin_coupler2_less_crank1 = -cos_theta_coupler2*sin_theta_crank1 +
        cos_theta_crank1*sin_theta_coupler2;
    const Lanes dot_crank1_coupler2 = cos_coupler2_less_crank1*inertia_crank1_coupler2;
    const Lanes cross_crank1_coupler2 = inertia_crank1_coupler2*sin_coupler2_less_crank1;

    /* constraints: gamma */
    const Lanes rhs_B2_x = (coupler2_omega * coupler2_omega)*span_coupler2_head_x + (crank1_omega *
        crank1_omega)*span_crank1_head_x - (crank2_omega * crank2_omega)*span_crank2_head_x;
    const Lanes rhs_B2_y = (coupler2_omega * coupler2_omega)*span_coupler2_head_y + (crank1_omega *
        crank1_omega)*span_crank1_head_y - (crank2_omega * crank2_omega)*span_crank2_head_y;
    const Lanes rhs_B1_x = (coupler1_omega * coupler1_omega)*span_coupler1_head_x + (crank0_omega *
        crank0_omega)*span_crank0_head_x - (crank1_omega * crank1_omega)*span_crank1_head_x;
    const Lanes rhs_B1_y = (coupler1_omega * coupler1_omega)*span_coupler1_head_y + (crank0_omega *
        crank0_omega)*span_crank0_head_y - (crank1_omega * crank1_omega)*span_crank1_head_y;

    /* L D L^T of the KKT matrix */
    const Lanes l_B2_x__crank2_theta = inverse_mass_crank2_crank2*span_crank2_head_y;
    const Lanes l_B2_y__crank2_theta = -inverse_mass_crank2_crank2*span_crank2_head_x;
    const Lanes l_B2_x__coupler2_theta = -inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const Lanes l_B2_y__coupler2_theta = inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const Lanes l_crank1_theta__coupler2_theta = dot_crank1_coupler2*inverse_mass_coupler2_coupler2;
    const Lanes scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y +
        l_B2_x__crank2_theta*span_crank2_head_y;
    const Lanes scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x -
        l_B2_y__crank2_theta*span_crank2_head_x;
    const Lanes pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y +
        l_B2_y__crank2_theta*span_crank2_head_y;
    const Lanes determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    *rare |= ~(scale_B2_x > 1e-05 * scale_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > 1e-05 * scale_B2_y * scale_B2_x);
    const Lanes size_B2_x = scale_B2_x + scale_B2_y;
    *rare |= ~(scale_B2_x > 1e-10 * size_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > 1e-10 * size_B2_x * scale_B2_x);
    const Lanes inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const Lanes inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const Lanes inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const Lanes inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const Lanes w_crank1_theta__B2_x = l_crank1_theta__coupler2_theta*span_coupler2_head_y -
        span_crank1_head_y;
    const Lanes w_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*span_coupler2_head_x +
        span_crank1_head_x;
    const Lanes l_crank1_theta__B2_x = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_y +
        inverse_pivot_B2_x*w_crank1_theta__B2_x;
    const Lanes l_crank1_theta__B2_y = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_x +
        inverse_pivot_B2_y*w_crank1_theta__B2_y;
    const Lanes inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta -
        l_crank1_theta__B2_x*w_crank1_theta__B2_x - l_crank1_theta__B2_y*w_crank1_theta__B2_y +
        mass_crank1_crank1);
    const Lanes l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const Lanes l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const Lanes l_coupler1_theta__crank0_theta = dot_crank0_coupler1*inverse_mass_crank0_crank0;
    const Lanes l_B1_x__crank0_theta = -inverse_mass_crank0_crank0*span_crank0_head_y;
    const Lanes l_B1_y__crank0_theta = inverse_mass_crank0_crank0*span_crank0_head_x;
    const Lanes inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta +
        mass_coupler1_coupler1);
    const Lanes w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const Lanes l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const Lanes w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const Lanes l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const Lanes scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta -
        l_B1_x__crank0_theta*span_crank0_head_y + l_B1_x__crank1_theta*span_crank1_head_y;
    const Lanes scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta +
        l_B1_y__crank0_theta*span_crank0_head_x - l_B1_y__crank1_theta*span_crank1_head_x;
    const Lanes pivot_B1_x__B1_y = l_B1_y__coupler1_theta*w_B1_x__coupler1_theta -
        l_B1_y__crank0_theta*span_crank0_head_y + l_B1_y__crank1_theta*span_crank1_head_y;
    const Lanes determinant_B1_x__B1_y = -(pivot_B1_x__B1_y * pivot_B1_x__B1_y) + scale_B1_x*scale_B1_y;
    *rare |= ~(scale_B1_x > 1e-08 * scale_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > 1e-08 * scale_B1_y * scale_B1_x);
    const Lanes size_B1_x = scale_B1_x + scale_B1_y;
    *rare |= ~(scale_B1_x > 1e-10 * size_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > 1e-10 * size_B1_x * scale_B1_x);
    const Lanes inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const Lanes inverse_pivot_B1_x = inverse_B1_x__B1_y*scale_B1_y;
    const Lanes inverse_pivot_B1_y = inverse_B1_x__B1_y*scale_B1_x;
    const Lanes inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const Lanes z_crank2_theta = cos_theta_crank2*weight_crank2__across;
    const Lanes z_coupler2_theta = cos_theta_coupler2*weight_coupler2__across - (crank1_omega *
        crank1_omega)*cross_crank1_coupler2;
    const Lanes z_B2_x = -l_B2_x__coupler2_theta*z_coupler2_theta - l_B2_x__crank2_theta*z_crank2_theta +
        rhs_B2_x;
    const Lanes z_B2_y = -l_B2_y__coupler2_theta*z_coupler2_theta - l_B2_y__crank2_theta*z_crank2_theta +
        rhs_B2_y;
    const Lanes z_crank1_theta = cos_theta_crank1*weight_crank1__across + (coupler2_omega *
        coupler2_omega)*cross_crank1_coupler2 - l_crank1_theta__B2_x*z_B2_x - l_crank1_theta__B2_y*z_B2_y -
        l_crank1_theta__coupler2_theta*z_coupler2_theta;
    const Lanes z_crank0_theta = cos_theta_crank0*weight_crank0__across + (coupler1_omega *
        coupler1_omega)*cross_crank0_coupler1;
    const Lanes z_coupler1_theta = cos_theta_coupler1*weight_coupler1__across - (crank0_omega *
        crank0_omega)*cross_crank0_coupler1 - l_coupler1_theta__crank0_theta*z_crank0_theta;
    const Lanes z_B1_x = -l_B1_x__coupler1_theta*z_coupler1_theta - l_B1_x__crank0_theta*z_crank0_theta -
        l_B1_x__crank1_theta*z_crank1_theta + rhs_B1_x;
    const Lanes z_B1_y = -l_B1_y__coupler1_theta*z_coupler1_theta - l_B1_y__crank0_theta*z_crank0_theta -
        l_B1_y__crank1_theta*z_crank1_theta + rhs_B1_y;

    /* backward substitution */
    const Lanes lambda_B1_y = inverse_cross_B1_x__B1_y*z_B1_x + inverse_pivot_B1_y*z_B1_y;
    const Lanes lambda_B1_x = inverse_cross_B1_x__B1_y*z_B1_y + inverse_pivot_B1_x*z_B1_x;
    const Lanes acceleration_coupler1_theta = inverse_pivot_coupler1_theta*z_coupler1_theta -
        l_B1_x__coupler1_theta*lambda_B1_x - l_B1_y__coupler1_theta*lambda_B1_y;
    const Lanes acceleration_crank0_theta = -acceleration_coupler1_theta*l_coupler1_theta__crank0_theta +
        inverse_mass_crank0_crank0*z_crank0_theta - l_B1_x__crank0_theta*lambda_B1_x -
        l_B1_y__crank0_theta*lambda_B1_y;
    const Lanes acceleration_crank1_theta = inverse_pivot_crank1_theta*z_crank1_theta -
        l_B1_x__crank1_theta*lambda_B1_x - l_B1_y__crank1_theta*lambda_B1_y;
    const Lanes lambda_B2_y = -acceleration_crank1_theta*l_crank1_theta__B2_y +
        inverse_cross_B2_x__B2_y*z_B2_x + inverse_pivot_B2_y*z_B2_y;
    const Lanes lambda_B2_x = -acceleration_crank1_theta*l_crank1_theta__B2_x +
        inverse_cross_B2_x__B2_y*z_B2_y + inverse_pivot_B2_x*z_B2_x;
    const Lanes acceleration_coupler2_theta = -acceleration_crank1_theta*l_crank1_theta__coupler2_theta +
        inverse_mass_coupler2_coupler2*z_coupler2_theta - l_B2_x__coupler2_theta*lambda_B2_x -
        l_B2_y__coupler2_theta*lambda_B2_y;
    const Lanes acceleration_crank2_theta = inverse_mass_crank2_crank2*z_crank2_theta -
        l_B2_x__crank2_theta*lambda_B2_x - l_B2_y__crank2_theta*lambda_B2_y;

    /* results */
    a[0] = acceleration_crank0_theta;
    a[1] = acceleration_crank1_theta;
    a[2] = acceleration_crank2_theta;
    a[3] = acceleration_coupler1_theta;
    a[4] = acceleration_coupler2_theta;
    aside->lambda[0] = lambda_B2_x;
    aside->lambda[1] = lambda_B2_y;
    aside->lambda[2] = lambda_B1_x;
    aside->lambda[3] = lambda_B1_y;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = all_of(0.0);
    aside->power[1] = all_of(0.0);
    aside->power[2] = all_of(0.0);
}

/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneRun *memory, const
    LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const Lanes crank0_theta = q[0];
    const Lanes crank0_omega = v[0];
    const Lanes crank1_theta = q[1];
    const Lanes crank1_omega = v[1];
    const Lanes crank2_theta = q[2];
    const Lanes crank2_omega = v[2];
    const Lanes coupler1_theta = q[3];
    const Lanes coupler1_omega = v[3];
    const Lanes coupler2_theta = q[4];
    const Lanes coupler2_omega = v[4];

    /* parameters */
    const Lanes O1_x = p->O1_x;
    const Lanes O2_x = p->O2_x;
    const Lanes crank0_head_span_x = p->crank0_head_span_x;
    const Lanes crank1_head_span_x = p->crank1_head_span_x;
    const Lanes coupler2_head_span_x = p->coupler2_head_span_x;
    const Lanes crank2_head_span_x = p->crank2_head_span_x;
    const Lanes coupler1_head_span_x = p->coupler1_head_span_x;
    const Lanes inertia_crank0_coupler1 = p->inertia_crank0_coupler1;
    const Lanes inertia_crank1_coupler2 = p->inertia_crank1_coupler2;
    const Lanes mass_crank1_crank1 = p->mass_crank1_crank1;
    const Lanes mass_coupler1_coupler1 = p->mass_coupler1_coupler1;
    const Lanes inverse_mass_crank2_crank2 = p->inverse_mass_crank2_crank2;
    const Lanes inverse_mass_coupler2_coupler2 = p->inverse_mass_coupler2_coupler2;
    const Lanes inverse_mass_crank0_crank0 = p->inverse_mass_crank0_crank0;

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0 = cosines_0;
    const Lanes sin_theta_crank0 = sines_0;
    const Lanes cos_theta_crank1 = cosines_1;
    const Lanes sin_theta_crank1 = sines_1;
    const Lanes cos_theta_crank2 = cosines_2;
    const Lanes sin_theta_crank2 = sines_2;
    const Lanes cos_theta_coupler1 = cosines_3;
    const Lanes sin_theta_coupler1 = sines_3;
    const Lanes cos_theta_coupler2 = cosines_4;
    const Lanes sin_theta_coupler2 = sines_4;
    const Lanes span_crank0_head_x = cos_theta_crank0*crank0_head_span_x;
    const Lanes span_crank0_head_y = crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*crank1_head_span_x;
    const Lanes span_crank1_head_y = crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*coupler2_head_span_x;
    const Lanes span_coupler2_head_y = coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*crank2_head_span_x;
    const Lanes span_crank2_head_y = crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*coupler1_head_span_x;
    const Lanes span_coupler1_head_y = coupler1_head_span_x*sin_theta_coupler1;
    const Lanes cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 +
        sin_theta_coupler1*sin_theta_crank0;
    const Lanes dot_crank0_coupler1 = cos_coupler1_less_crank0*inertia_crank0_coupler1;
    const Lanes cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 +
        sin_theta_coupler2*sin_theta_crank1;
    const Lanes dot_crank1_coupler2 = cos_coupler2_less_crank1*inertia_crank1_coupler2;

    /* Phi and Phi_dot */
    const Lanes phi_B2_x = O1_x - O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;
    const Lanes phi_dot_B2_x = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y +
        crank2_omega*span_crank2_head_y;
    const Lanes phi_B2_y = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;
    const Lanes phi_dot_B2_y = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x -
        crank2_omega*span_crank2_head_x;
    const Lanes phi_B1_x = -O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;
    const Lanes phi_dot_B1_x = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y +
        crank1_omega*span_crank1_head_y;
    const Lanes phi_B1_y = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;
    const Lanes phi_dot_B1_y = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x -
        crank1_omega*span_crank1_head_x;

    /* L D L^T of the KKT matrix */
    const Lanes l_B2_x__crank2_theta_4 = inverse_mass_crank2_crank2*span_crank2_head_y;
    const Lanes l_B2_y__crank2_theta_4 = -inverse_mass_crank2_crank2*span_crank2_head_x;
    const Lanes l_coupler1_theta__crank0_theta_4 = dot_crank0_coupler1*inverse_mass_crank0_crank0;
    const Lanes l_B1_x__crank0_theta_4 = -inverse_mass_crank0_crank0*span_crank0_head_y;
    const Lanes l_B1_y__crank0_theta_4 = inverse_mass_crank0_crank0*span_crank0_head_x;
    const Lanes inverse_pivot_coupler1_theta_4 = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta_4 +
        mass_coupler1_coupler1);
    const Lanes w_B1_x__coupler1_theta_3 = -dot_crank0_coupler1*l_B1_x__crank0_theta_4 - span_coupler1_head_y;
    const Lanes l_B1_x__coupler1_theta_4 = inverse_pivot_coupler1_theta_4*w_B1_x__coupler1_theta_3;
    const Lanes w_B1_y__coupler1_theta_3 = -dot_crank0_coupler1*l_B1_y__crank0_theta_4 + span_coupler1_head_x;
    const Lanes l_B1_y__coupler1_theta_4 = inverse_pivot_coupler1_theta_4*w_B1_y__coupler1_theta_3;
    const Lanes l_crank1_theta__coupler2_theta_4 = dot_crank1_coupler2*inverse_mass_coupler2_coupler2;
    const Lanes l_B2_x__coupler2_theta_4 = -inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const Lanes l_B2_y__coupler2_theta_4 = inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const Lanes inverse_pivot_crank1_theta_4 = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta_4 +
        mass_crank1_crank1);
    const Lanes w_B2_x__crank1_theta_2 = -dot_crank1_coupler2*l_B2_x__coupler2_theta_4 - span_crank1_head_y;
    const Lanes l_B2_x__crank1_theta_3 = inverse_pivot_crank1_theta_4*w_B2_x__crank1_theta_2;
    const Lanes w_B2_y__crank1_theta_2 = -dot_crank1_coupler2*l_B2_y__coupler2_theta_4 + span_crank1_head_x;
    const Lanes l_B2_y__crank1_theta_3 = inverse_pivot_crank1_theta_4*w_B2_y__crank1_theta_2;
    const Lanes l_B1_x__crank1_theta_4 = inverse_pivot_crank1_theta_4*span_crank1_head_y;
    const Lanes l_B1_y__crank1_theta_4 = -inverse_pivot_crank1_theta_4*span_crank1_head_x;
    const Lanes scale_B2_x_4 = -l_B2_x__coupler2_theta_4*span_coupler2_head_y +
        l_B2_x__crank1_theta_3*w_B2_x__crank1_theta_2 + l_B2_x__crank2_theta_4*span_crank2_head_y;
    const Lanes scale_B2_y_4 = l_B2_y__coupler2_theta_4*span_coupler2_head_x +
        l_B2_y__crank1_theta_3*w_B2_y__crank1_theta_2 - l_B2_y__crank2_theta_4*span_crank2_head_x;
    const Lanes pivot_B2_x__B2_y_3 = -l_B2_y__coupler2_theta_4*span_coupler2_head_y +
        l_B2_y__crank1_theta_3*w_B2_x__crank1_theta_2 + l_B2_y__crank2_theta_4*span_crank2_head_y;
    const Lanes determinant_B2_x__B2_y_3 = -(pivot_B2_x__B2_y_3 * pivot_B2_x__B2_y_3) +
        scale_B2_x_4*scale_B2_y_4;
    *rare |= ~(scale_B2_x_4 > 1e-10 * scale_B2_x_4);
    *rare |= ~(determinant_B2_x__B2_y_3 > 1e-10 * scale_B2_y_4 * scale_B2_x_4);
    const Lanes size_B2_x_3 = scale_B2_x_4 + scale_B2_y_4;
    *rare |= ~(scale_B2_x_4 > 1e-10 * size_B2_x_3);
    *rare |= ~(determinant_B2_x__B2_y_3 > 1e-10 * size_B2_x_3 * scale_B2_x_4);
    const Lanes inverse_B2_x__B2_y_3 = -1.0/determinant_B2_x__B2_y_3;
    const Lanes inverse_pivot_B2_x_4 = inverse_B2_x__B2_y_3*scale_B2_y_4;
    const Lanes inverse_pivot_B2_y_4 = inverse_B2_x__B2_y_3*scale_B2_x_4;
    const Lanes inverse_cross_B2_x__B2_y_3 = -inverse_B2_x__B2_y_3*pivot_B2_x__B2_y_3;
    const Lanes w_B1_x__B2_x_2 = -l_B1_x__crank1_theta_4*w_B2_x__crank1_theta_2;
    const Lanes w_B1_x__B2_y_2 = -l_B1_x__crank1_theta_4*w_B2_y__crank1_theta_2;
    const Lanes l_B1_x__B2_x_3 = inverse_cross_B2_x__B2_y_3*w_B1_x__B2_y_2 +
        inverse_pivot_B2_x_4*w_B1_x__B2_x_2;
    const Lanes l_B1_x__B2_y_3 = inverse_cross_B2_x__B2_y_3*w_B1_x__B2_x_2 +
        inverse_pivot_B2_y_4*w_B1_x__B2_y_2;
    const Lanes w_B1_y__B2_x_2 = -l_B1_y__crank1_theta_4*w_B2_x__crank1_theta_2;
    const Lanes w_B1_y__B2_y_2 = -l_B1_y__crank1_theta_4*w_B2_y__crank1_theta_2;
    const Lanes l_B1_y__B2_x_3 = inverse_cross_B2_x__B2_y_3*w_B1_y__B2_y_2 +
        inverse_pivot_B2_x_4*w_B1_y__B2_x_2;
    const Lanes l_B1_y__B2_y_3 = inverse_cross_B2_x__B2_y_3*w_B1_y__B2_x_2 +
        inverse_pivot_B2_y_4*w_B1_y__B2_y_2;
    const Lanes scale_B1_x_4 = l_B1_x__coupler1_theta_4*w_B1_x__coupler1_theta_3 -
        l_B1_x__crank0_theta_4*span_crank0_head_y + l_B1_x__crank1_theta_4*span_crank1_head_y;
    const Lanes scale_B1_y_4 = l_B1_y__coupler1_theta_4*w_B1_y__coupler1_theta_3 +
        l_B1_y__crank0_theta_4*span_crank0_head_x - l_B1_y__crank1_theta_4*span_crank1_head_x;
    const Lanes pivot_B1_x_3 = l_B1_x__B2_x_3*w_B1_x__B2_x_2 + l_B1_x__B2_y_3*w_B1_x__B2_y_2 + scale_B1_x_4;
    const Lanes pivot_B1_y_3 = l_B1_y__B2_x_3*w_B1_y__B2_x_2 + l_B1_y__B2_y_3*w_B1_y__B2_y_2 + scale_B1_y_4;
    const Lanes pivot_B1_x__B1_y_3 = l_B1_y__B2_x_3*w_B1_x__B2_x_2 + l_B1_y__B2_y_3*w_B1_x__B2_y_2 +
        l_B1_y__coupler1_theta_4*w_B1_x__coupler1_theta_3 - l_B1_y__crank0_theta_4*span_crank0_head_y +
        l_B1_y__crank1_theta_4*span_crank1_head_y;
    const Lanes determinant_B1_x__B1_y_3 = pivot_B1_x_3*pivot_B1_y_3 - (pivot_B1_x__B1_y_3 *
        pivot_B1_x__B1_y_3);
    *rare |= ~(pivot_B1_x_3 > 1e-10 * scale_B1_x_4);
    *rare |= ~(determinant_B1_x__B1_y_3 > 1e-10 * scale_B1_y_4 * pivot_B1_x_3);
    const Lanes size_B1_x_3 = scale_B1_x_4 + scale_B1_y_4;
    *rare |= ~(pivot_B1_x_3 > 1e-10 * size_B1_x_3);
    *rare |= ~(determinant_B1_x__B1_y_3 > 1e-10 * size_B1_x_3 * pivot_B1_x_3);
    const Lanes inverse_B1_x__B1_y_3 = -1.0/determinant_B1_x__B1_y_3;
    const Lanes inverse_pivot_B1_x_4 = inverse_B1_x__B1_y_3*pivot_B1_y_3;
    const Lanes inverse_pivot_B1_y_4 = inverse_B1_x__B1_y_3*pivot_B1_x_3;
    const Lanes inverse_cross_B1_x__B1_y_3 = -inverse_B1_x__B1_y_3*pivot_B1_x__B1_y_3;

    /* forward substitution */
    const Lanes dq_z_B1_x = -l_B1_x__B2_x_3*phi_B2_x - l_B1_x__B2_y_3*phi_B2_y + phi_B1_x;
    const Lanes dq_z_B1_y = -l_B1_y__B2_x_3*phi_B2_x - l_B1_y__B2_y_3*phi_B2_y + phi_B1_y;

    /* backward substitution */
    const Lanes dq_lambda_B1_y = dq_z_B1_x*inverse_cross_B1_x__B1_y_3 + dq_z_B1_y*inverse_pivot_B1_y_4;
    const Lanes dq_lambda_B1_x = dq_z_B1_x*inverse_pivot_B1_x_4 + dq_z_B1_y*inverse_cross_B1_x__B1_y_3;
    const Lanes dq_lambda_B2_y = -dq_lambda_B1_x*l_B1_x__B2_y_3 - dq_lambda_B1_y*l_B1_y__B2_y_3 +
        inverse_cross_B2_x__B2_y_3*phi_B2_x + inverse_pivot_B2_y_4*phi_B2_y;
    const Lanes dq_lambda_B2_x = -dq_lambda_B1_x*l_B1_x__B2_x_3 - dq_lambda_B1_y*l_B1_y__B2_x_3 +
        inverse_cross_B2_x__B2_y_3*phi_B2_y + inverse_pivot_B2_x_4*phi_B2_x;
    const Lanes dq_acceleration_crank1_theta = -dq_lambda_B1_x*l_B1_x__crank1_theta_4 -
        dq_lambda_B1_y*l_B1_y__crank1_theta_4 - dq_lambda_B2_x*l_B2_x__crank1_theta_3 -
        dq_lambda_B2_y*l_B2_y__crank1_theta_3;
    const Lanes dq_acceleration_coupler2_theta =
        -dq_acceleration_crank1_theta*l_crank1_theta__coupler2_theta_4 -
        dq_lambda_B2_x*l_B2_x__coupler2_theta_4 - dq_lambda_B2_y*l_B2_y__coupler2_theta_4;
    const Lanes dq_acceleration_coupler1_theta = -dq_lambda_B1_x*l_B1_x__coupler1_theta_4 -
        dq_lambda_B1_y*l_B1_y__coupler1_theta_4;
    const Lanes dq_acceleration_crank0_theta =
        -dq_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta_4 -
        dq_lambda_B1_x*l_B1_x__crank0_theta_4 - dq_lambda_B1_y*l_B1_y__crank0_theta_4;
    const Lanes dq_acceleration_crank2_theta = -dq_lambda_B2_x*l_B2_x__crank2_theta_4 -
        dq_lambda_B2_y*l_B2_y__crank2_theta_4;

    /* forward substitution */
    const Lanes dv_z_B1_x = -l_B1_x__B2_x_3*phi_dot_B2_x - l_B1_x__B2_y_3*phi_dot_B2_y + phi_dot_B1_x;
    const Lanes dv_z_B1_y = -l_B1_y__B2_x_3*phi_dot_B2_x - l_B1_y__B2_y_3*phi_dot_B2_y + phi_dot_B1_y;

    /* backward substitution */
    const Lanes dv_lambda_B1_y = dv_z_B1_x*inverse_cross_B1_x__B1_y_3 + dv_z_B1_y*inverse_pivot_B1_y_4;
    const Lanes dv_lambda_B1_x = dv_z_B1_x*inverse_pivot_B1_x_4 + dv_z_B1_y*inverse_cross_B1_x__B1_y_3;
    const Lanes dv_lambda_B2_y = -dv_lambda_B1_x*l_B1_x__B2_y_3 - dv_lambda_B1_y*l_B1_y__B2_y_3 +
        inverse_cross_B2_x__B2_y_3*phi_dot_B2_x + inverse_pivot_B2_y_4*phi_dot_B2_y;
    const Lanes dv_lambda_B2_x = -dv_lambda_B1_x*l_B1_x__B2_x_3 - dv_lambda_B1_y*l_B1_y__B2_x_3 +
        inverse_cross_B2_x__B2_y_3*phi_dot_B2_y + inverse_pivot_B2_x_4*phi_dot_B2_x;
    const Lanes dv_acceleration_crank1_theta = -dv_lambda_B1_x*l_B1_x__crank1_theta_4 -
        dv_lambda_B1_y*l_B1_y__crank1_theta_4 - dv_lambda_B2_x*l_B2_x__crank1_theta_3 -
        dv_lambda_B2_y*l_B2_y__crank1_theta_3;
    const Lanes dv_acceleration_coupler2_theta =
        -dv_acceleration_crank1_theta*l_crank1_theta__coupler2_theta_4 -
        dv_lambda_B2_x*l_B2_x__coupler2_theta_4 - dv_lambda_B2_y*l_B2_y__coupler2_theta_4;
    const Lanes dv_acceleration_coupler1_theta = -dv_lambda_B1_x*l_B1_x__coupler1_theta_4 -
        dv_lambda_B1_y*l_B1_y__coupler1_theta_4;
    const Lanes dv_acceleration_crank0_theta =
        -dv_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta_4 -
        dv_lambda_B1_x*l_B1_x__crank0_theta_4 - dv_lambda_B1_y*l_B1_y__crank0_theta_4;
    const Lanes dv_acceleration_crank2_theta = -dv_lambda_B2_x*l_B2_x__crank2_theta_4 -
        dv_lambda_B2_y*l_B2_y__crank2_theta_4;

    /* results */
    dq[0] = dq_acceleration_crank0_theta;
    dv[0] = dv_acceleration_crank0_theta;
    dq[1] = dq_acceleration_crank1_theta;
    dv[1] = dv_acceleration_crank1_theta;
    dq[2] = dq_acceleration_crank2_theta;
    dv[2] = dv_acceleration_crank2_theta;
    dq[3] = dq_acceleration_coupler1_theta;
    dv[3] = dv_acceleration_coupler1_theta;
    dq[4] = dq_acceleration_coupler2_theta;
    dv[4] = dv_acceleration_coupler2_theta;
    *worst = all_of(0.0);
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B2_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B2_y));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_y));
}

static void motion(Lanes t, const Lanes *y, const LaneRun *x, const LaneParameters *p, Lanes *dy, LaneAside *aside,
    LaneBits *rare)
{
    reduced_dynamics(t, y, y + N_X, x, p, dy + N_X, aside, rare);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = aside->power[k];
}

static LaneBits not_finite(const Lanes *a, const Lanes *b, int n)
{
    Lanes sum = all_of(0.0);
    for (int k = 0; k < n; k++)
        sum += b ? a[k] + b[k] : a[k];
    return ~(lanes_fabs(sum) <= DBL_MAX);
}

/* As project_state of step.c: each lane is left as it is once it is closed. */
static void project_state(Lanes t, Lanes *y, const LaneRun *x, const LaneParameters *p, LaneBits *rare)
{
    LaneBits open = ~(LaneBits){0};
    for (int pass = 0; pass < 3 && N_LOOPS > 0 && any_of(open); pass++) {
        Lanes dq[N_X], dv[N_X], worst;
        closing_step(t, y, y + N_X, x, p, dq, dv, &worst, rare);
        *rare |= open & (not_finite(dq, NULL, N_X) | not_finite(dv, NULL, N_X));
        for (int k = 0; k < N_X; k++) {
            y[k] = pick(open, y[k] - dq[k], y[k]);
            y[N_X + k] = pick(open, y[N_X + k] - dv[k], y[N_X + k]);
        }
        open &= ~(worst < 1e-15);
    }
}

/*
 * Lanes in which a contact begins, ends or is touched within the step or goes too deep, or an event's expression
 * changes its side, is zero or no number.
 */
static LaneBits happens(const LaneRun *x, const LaneAside *aside, const LaneBits *touched, const LaneParameters *p)
{
    const Lanes deepest[] = {all_of(0.0)};
    LaneBits some = {0};
    (void)p;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes delta = aside->clearance[i].delta;
        const LaneBits closed = x->latch[i].closed > 0.0;
        some |= (closed & (delta < 0.0)) | (~closed & (touched[i] | (delta >= 0.0))) | (delta > deepest[i]);
    }
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Lanes value = aside->event[i], side = x->event_side[i];
        some |= ~(((value > 0.0) & (side > 0.0)) | ((value < 0.0) & (side < 0.0)));
    }
    return some;
}

/* Height of the top of the cubic, as cubic_top of run.c, where the journal turned back within the step; else 0. */
static Lanes top_of(Lanes d0, Lanes r0, Lanes d1, Lanes r1, LaneBits turned)
{
    const Lanes b = 3.0 * (d1 - d0) - 2.0 * r0 - r1, c = r0 + r1 - 2.0 * (d1 - d0);
    const Lanes s = r0 / (lanes_sqrt(b * b - 3.0 * c * r0) - b);
    return pick(turned, d0 + s * (r0 + s * (b + s * c)), all_of(0.0));
}

/* Peaks of one joint. */
static void watch_force(LaneRun *x, int i, const LaneClearance *joint)
{
    const LaneBits closed = x->latch[i].closed > 0.0;
    const Lanes F_peak = x->latch[i].F_peak, F_open = x->latch[i].F_open;
    const Lanes F = lanes_sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
    const LaneBits higher = F > F_peak, higher_open = closed & (F > F_open);
    x->latch[i].F_peak = pick(higher, F, F_peak);
    x->latch[i].t_peak = pick(higher, x->t, x->latch[i].t_peak);
    x->latch[i].F_open = pick(higher_open, F, F_open);
    x->latch[i].t_open = pick(higher_open, x->t, x->latch[i].t_open);
}

/* As accept of rk4.c, update_latches and watch of run.c where nothing happens. */
static void watch(LaneRun *x, const LaneAside *aside, double h, const Lanes *phi, const Lanes *phi_dot)
{
    for (int r = 0; r < N_LOOPS; r++) {
        x->phi_max = lanes_max_of(lanes_fabs(phi[r]), x->phi_max);
        x->phi_dot_max = lanes_max_of(lanes_fabs(phi_dot[r]), x->phi_dot_max);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *joint = &aside->clearance[i];
        const Lanes e = x->latch[i].e, rate = x->latch[i].deltadot;
        const LaneBits closed = x->latch[i].closed > 0.0, turned = (rate > 0.0) & (joint->deltadot < 0.0);
        if (any_of(turned))
            x->latch[i].e_max =
                lanes_max_of(top_of(e, h * rate, joint->e, h * joint->deltadot, turned), x->latch[i].e_max);
        x->latch[i].e = joint->e;
        x->latch[i].delta = joint->delta;
        x->latch[i].deltadot = joint->deltadot;
        x->latch[i].e_max = lanes_max_of(joint->e, x->latch[i].e_max);
        watch_force(x, i, joint);
        if (!any_of(closed))
            continue;
        const Lanes ratio = joint->deltadot / x->latch[i].deltadot_minus;
        x->latch[i].compressing = pick(closed & (joint->deltadot <= 0.0), all_of(0.0), x->latch[i].compressing);
        x->ratio_min = pick(closed & (ratio < x->ratio_min), ratio, x->ratio_min);
        x->ratio_max = pick(closed & (ratio > x->ratio_max), ratio, x->ratio_max);
        x->ratio_outside = pick(closed & ((ratio < -1.0) | (ratio > 1.0)), x->ratio_outside + 1.0, x->ratio_outside);
    }
}

/*
 * One step of all lanes, as rk4_trial and accept of rk4.c. Returns the lanes in which something rare is met; where
 * there are any, or it is to be kept, `before` is x as it was.
 */
static LaneBits lane_step(LaneRun *x, double h, double t_new, const LaneParameters *p, int keep, LaneRun *before)
{
    static const double reach[3] = {0.5, 0.5, 1.0}, weight[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    const double t = x->t[0];
    Lanes y[N_Y], k[N_Y], next[N_Y], phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    LaneBits rare = {0}, touched[LANE_JOINTS] = { {0} };
    LaneAside aside;
    for (int j = 0; j < N_Y; j++)
        next[j] = x->y[j] + h / 6.0 * x->dy[j];
    const Lanes *slope = x->dy;
    for (int stage = 0; stage < 3; stage++) {
        for (int j = 0; j < N_Y; j++)
            y[j] = x->y[j] + reach[stage] * h * slope[j];
        motion(all_of(t + reach[stage] * h), y, x, p, k, &aside, &rare);
        for (int j = 0; j < N_Y; j++)
            next[j] += weight[stage] * h * k[j];
        for (int i = 0; i < N_CLEARANCES; i++)
            touched[i] |= aside.clearance[i].delta > 0.0;
        slope = k;
    }
    project_state(all_of(t + h), next, x, p, &rare);
    motion(all_of(t + h), next, x, p, k, &aside, &rare);
    closures(all_of(t_new), next, p, phi, &rare);
    closure_rates(all_of(t_new), next, next + N_X, p, phi_dot, &rare);
    rare |= not_finite(k, next, N_Y) | happens(x, &aside, touched, p);
    if (keep || any_of(rare))
        *before = *x;
    for (int j = 0; j < N_Y; j++) {
        x->y[j] = next[j];
        x->dy[j] = k[j];
    }
    x->t = all_of(t_new);
    x->steps += 1.0;
    x->evaluations += 4.0;
    watch(x, &aside, h, phi, phi_dot);
    return rare;
}
/*
 * Runs side by side: run[k] is the memory of number[k], which is -1 once that run has left. The lane of one that has
 * left mirrors another: what fills it must not be rare.
 */
typedef struct {
    const Batch *b;
    const Single *one;
    void *const *run;
    long number[LANES];
    LaneRun x;
    LaneParameters p;
    long made, rare; /* steps of all lanes, those of single runs among them */
} Side;

static void copy_lane(Lanes *x, size_t n, int to, int from)
{
    for (size_t j = 0; j < n; j++)
        x[j][to] = x[j][from];
}

static int first_of(const Side *side)
{
    int k = 0;
    while (k < LANES && side->number[k] < 0)
        k++;
    return k;
}

static int count_of(const Side *side)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += side->number[k] >= 0;
    return count;
}

static void mirror(Side *side)
{
    const int from = first_of(side);
    for (int k = 0; k < LANES && from < LANES; k++) {
        if (side->number[k] >= 0)
            continue;
        copy_lane((Lanes *)&side->x, sizeof(LaneRun) / sizeof(Lanes), k, from);
        copy_lane((Lanes *)&side->p, sizeof(LaneParameters) / sizeof(Lanes), k, from);
    }
}

static void gather(Side *side, int k)
{
    Moving state;
    side->one->give(side->run[k], &state);
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((Lanes *)&side->x)[j][k] = ((const double *)&state)[j];
}

static Moving state_of(const LaneRun *x, int k)
{
    Moving state;
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((double *)&state)[j] = ((const Lanes *)x)[j][k];
    return state;
}

static void scatter(const Side *side, const LaneRun *x, int k)
{
    const Moving state = state_of(x, k);
    side->one->take(side->run[k], &state);
}

static const double *parameters_of(const Side *side, int k)
{
    return side->b->p_motion + side->number[k] * side->b->numbers;
}

/* Begins run k, unless it goes on, and makes its first sample; what cannot begin leaves. */
static void enter(Side *side, int k)
{
    const Batch *b = side->b;
    const long i = side->number[k];
    if (b->phase[i] == NEW) {
        b->status[i] = side->one->begin(b, i, side->run[k]);
        b->phase[i] = b->status[i] ? OVER : BEGUN;
        const int status = b->status[i] ? 0 : side->one->steps(b, i, 0, side->run[k]);
        if (status)
            side->one->end(b, i, status, side->run[k]);
        if (b->phase[i] == OVER) {
            side->number[k] = -1;
            return;
        }
    }
    for (long j = 0; j < b->numbers; j++)
        ((Lanes *)&side->p)[j][k] = parameters_of(side, k)[j];
    gather(side, k);
}

/*
 * The step of the rare lanes, which began at x, by their runs themselves. One whose lists are full leaves before it,
 * one that it ends leaves after it.
 */
static void single_steps(Side *side, LaneBits rare, const LaneRun *x)
{
    const Batch *b = side->b;
    for (int k = 0; k < LANES; k++) {
        const long i = side->number[k];
        if (i < 0 || !rare[k])
            continue;
        scatter(side, x, k);
        side->rare++;
        const int status = side->one->steps(b, i, 1, side->run[k]);
        if (!status) {
            gather(side, k);
            continue;
        }
        if (status != EVENTS_FULL)
            side->one->end(b, i, status, side->run[k]);
        side->number[k] = -1;
    }
    mirror(side);
}

/* One step of all lanes, with its samples. */
static void advance(Side *side)
{
    const Batch *b = side->b;
    const int first = first_of(side);
    const long i = side->number[first];
    double h;
    const double t_new = step_end(b->t, b->samples, b->done[i], b->step[i], side->x.steps[first] + 1.0, &h);
    const int sampled = b->t[b->done[i]] < t_new + h;
    LaneRun before;
    const LaneBits rare = lane_step(&side->x, h, t_new, &side->p, sampled, &before);
    side->made += LANES;
    for (int k = 0; sampled && k < LANES; k++) {
        if (side->number[k] < 0 || rare[k])
            continue;
        const Moving from = state_of(&before, k);
        scatter(side, &side->x, k);
        side->one->samples(b, side->number[k], &from, side->run[k]);
    }
    if (any_of(rare))
        single_steps(side, rare, &before);
}

static double seconds_now(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int gudgeon_lane_count(void) { return LANES; }

/*
 * Runs number[k] (LANES of them, -1: none), which have the same step and have come equally far, each in a memory of
 * its own. Returns GOES_ON after `limit` steps, to be called again, or ALL_OVER: what is not over then goes on alone
 * from where it is (gudgeon_many), because it has come to its end, is the last, most steps are rare, or the batch is
 * ending.
 */
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number)
{
    Side side = {.b = batch, .one = single, .run = run};
    const double before = seconds_now();
    long left = side.b->limit;
    int entered = 0, together = 1;
    for (int k = 0; k < LANES; k++) {
        side.number[k] = number[k];
        entered += number[k] >= 0;
        if (number[k] >= 0)
            enter(&side, k);
    }
    mirror(&side);
    while ((together = count_of(&side) > 1 && 2 * side.rare <= side.made + 64 * LANES) && left > 0) {
        if (side.b->done[side.number[first_of(&side)]] == side.b->samples || *side.b->ending) {
            together = 0;
            break;
        }
        advance(&side);
        left--;
    }
    for (int k = 0; k < LANES; k++) {
        if (side.number[k] < 0)
            continue;
        scatter(&side, &side.x, k);
        side.b->t_last[side.number[k]] = side.x.t[k];
    }
    const double share = (seconds_now() - before) / entered;
    for (int k = 0; k < LANES; k++) {
        if (number[k] >= 0)
            side.b->seconds[number[k]] += share;
        number[k] = side.number[k];
    }
    return together ? GOES_ON : ALL_OVER;
}
