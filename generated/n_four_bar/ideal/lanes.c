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
    Lanes gravity_y;
    Lanes guess_crank1_theta;
    Lanes guess_crank2_theta;
    Lanes guess_coupler1_theta;
    Lanes guess_coupler2_theta;
    Lanes set_crank0_theta;
    Lanes rates_crank0_omega;
    Lanes crank0_head_s_x;
    Lanes crank1_head_s_x;
    Lanes crank2_head_s_x;
    Lanes coupler1_head_s_x;
    Lanes coupler2_head_s_x;
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
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank0_theta = q[0];
    const Lanes crank1_theta = q[1];
    const Lanes crank2_theta = q[2];
    const Lanes coupler1_theta = q[3];
    const Lanes coupler2_theta = q[4];

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
    const Lanes span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const Lanes span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const Lanes span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const Lanes span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const Lanes span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const Lanes span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    out[0] = p->O1_x - p->O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;  /* B2.x */
    out[1] = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;  /* B2.y */
    out[2] = -p->O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;  /* B1.x */
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
    const Lanes span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const Lanes span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const Lanes span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const Lanes span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const Lanes span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const Lanes span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    /* B2.x */
    out[0] = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y + crank2_omega*span_crank2_head_y;
    /* B2.y */
    out[1] = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x - crank2_omega*span_crank2_head_x;
    /* B1.x */
    out[2] = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y + crank1_omega*span_crank1_head_y;
    /* B1.y */
    out[3] = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x - crank1_omega*span_crank1_head_x;
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
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
    const Lanes span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const Lanes span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const Lanes span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const Lanes span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const Lanes span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const Lanes span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const Lanes cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const Lanes sin_coupler1_less_crank0 = -cos_theta_coupler1*sin_theta_crank0 + cos_theta_crank0*sin_theta_coupler1;
    const Lanes dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const Lanes cross_crank0_coupler1 = p->inertia_crank0_coupler1*sin_coupler1_less_crank0;
    const Lanes cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const Lanes sin_coupler2_less_crank1 = -cos_theta_coupler2*sin_theta_crank1 + cos_theta_crank1*sin_theta_coupler2;
    const Lanes dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;
    const Lanes cross_crank1_coupler2 = p->inertia_crank1_coupler2*sin_coupler2_less_crank1;

    /* constraints: gamma */
    const Lanes rhs_B2_x = (coupler2_omega * coupler2_omega)*span_coupler2_head_x
        + (crank1_omega * crank1_omega)*span_crank1_head_x - (crank2_omega * crank2_omega)*span_crank2_head_x;
    const Lanes rhs_B2_y = (coupler2_omega * coupler2_omega)*span_coupler2_head_y
        + (crank1_omega * crank1_omega)*span_crank1_head_y - (crank2_omega * crank2_omega)*span_crank2_head_y;
    const Lanes rhs_B1_x = (coupler1_omega * coupler1_omega)*span_coupler1_head_x
        + (crank0_omega * crank0_omega)*span_crank0_head_x - (crank1_omega * crank1_omega)*span_crank1_head_x;
    const Lanes rhs_B1_y = (coupler1_omega * coupler1_omega)*span_coupler1_head_y
        + (crank0_omega * crank0_omega)*span_crank0_head_y - (crank1_omega * crank1_omega)*span_crank1_head_y;

    /* L D L^T of the KKT matrix */
    const Lanes l_B2_x__crank2_theta = p->inverse_mass_crank2_crank2*span_crank2_head_y;
    const Lanes l_B2_y__crank2_theta = -p->inverse_mass_crank2_crank2*span_crank2_head_x;
    const Lanes l_B2_x__coupler2_theta = -p->inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const Lanes l_B2_y__coupler2_theta = p->inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const Lanes l_crank1_theta__coupler2_theta = dot_crank1_coupler2*p->inverse_mass_coupler2_coupler2;
    const Lanes scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y + l_B2_x__crank2_theta*span_crank2_head_y;
    const Lanes scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x - l_B2_y__crank2_theta*span_crank2_head_x;
    const Lanes pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y
        + l_B2_y__crank2_theta*span_crank2_head_y;
    const Lanes determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    *rare |= ~((scale_B2_x > 0.0) & (scale_B2_x < INFINITY));
    *rare |= ~(determinant_B2_x__B2_y > EARLY * scale_B2_y * scale_B2_x);
    const Lanes size_B2_x = scale_B2_x + scale_B2_y;
    *rare |= ~(scale_B2_x > memory->least_size * size_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > memory->least_size * size_B2_x * scale_B2_x);
    const Lanes inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const Lanes inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const Lanes inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const Lanes inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const Lanes w_crank1_theta__B2_x = l_crank1_theta__coupler2_theta*span_coupler2_head_y - span_crank1_head_y;
    const Lanes w_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*span_coupler2_head_x + span_crank1_head_x;
    const Lanes l_crank1_theta__B2_x = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_y
        + inverse_pivot_B2_x*w_crank1_theta__B2_x;
    const Lanes l_crank1_theta__B2_y = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_x
        + inverse_pivot_B2_y*w_crank1_theta__B2_y;
    const Lanes inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta
        - l_crank1_theta__B2_x*w_crank1_theta__B2_x - l_crank1_theta__B2_y*w_crank1_theta__B2_y
        + p->mass_crank1_crank1);
    const Lanes l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const Lanes l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const Lanes l_coupler1_theta__crank0_theta = dot_crank0_coupler1*p->inverse_mass_crank0_crank0;
    const Lanes l_B1_x__crank0_theta = -p->inverse_mass_crank0_crank0*span_crank0_head_y;
    const Lanes l_B1_y__crank0_theta = p->inverse_mass_crank0_crank0*span_crank0_head_x;
    const Lanes inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta
        + p->mass_coupler1_coupler1);
    const Lanes w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const Lanes l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const Lanes w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const Lanes l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const Lanes scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta - l_B1_x__crank0_theta*span_crank0_head_y
        + l_B1_x__crank1_theta*span_crank1_head_y;
    const Lanes scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta + l_B1_y__crank0_theta*span_crank0_head_x
        - l_B1_y__crank1_theta*span_crank1_head_x;
    const Lanes pivot_B1_x__B1_y = l_B1_y__coupler1_theta*w_B1_x__coupler1_theta
        - l_B1_y__crank0_theta*span_crank0_head_y + l_B1_y__crank1_theta*span_crank1_head_y;
    const Lanes determinant_B1_x__B1_y = -(pivot_B1_x__B1_y * pivot_B1_x__B1_y) + scale_B1_x*scale_B1_y;
    *rare |= ~((scale_B1_x > 0.0) & (scale_B1_x < INFINITY));
    *rare |= ~(determinant_B1_x__B1_y > memory->least * scale_B1_y * scale_B1_x);
    const Lanes size_B1_x = scale_B1_x + scale_B1_y;
    *rare |= ~(scale_B1_x > memory->least_size * size_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > memory->least_size * size_B1_x * scale_B1_x);
    const Lanes inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const Lanes inverse_pivot_B1_x = inverse_B1_x__B1_y*scale_B1_y;
    const Lanes inverse_pivot_B1_y = inverse_B1_x__B1_y*scale_B1_x;
    const Lanes inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const Lanes z_crank2_theta = cos_theta_crank2*p->weight_crank2__across;
    const Lanes z_coupler2_theta = cos_theta_coupler2*p->weight_coupler2__across
        - (crank1_omega * crank1_omega)*cross_crank1_coupler2;
    const Lanes z_B2_x = -l_B2_x__coupler2_theta*z_coupler2_theta - l_B2_x__crank2_theta*z_crank2_theta + rhs_B2_x;
    const Lanes z_B2_y = -l_B2_y__coupler2_theta*z_coupler2_theta - l_B2_y__crank2_theta*z_crank2_theta + rhs_B2_y;
    const Lanes z_crank1_theta = cos_theta_crank1*p->weight_crank1__across
        + (coupler2_omega * coupler2_omega)*cross_crank1_coupler2 - l_crank1_theta__B2_x*z_B2_x
        - l_crank1_theta__B2_y*z_B2_y - l_crank1_theta__coupler2_theta*z_coupler2_theta;
    const Lanes z_crank0_theta = cos_theta_crank0*p->weight_crank0__across
        + (coupler1_omega * coupler1_omega)*cross_crank0_coupler1;
    const Lanes z_coupler1_theta = cos_theta_coupler1*p->weight_coupler1__across
        - (crank0_omega * crank0_omega)*cross_crank0_coupler1 - l_coupler1_theta__crank0_theta*z_crank0_theta;
    const Lanes z_B1_x = -l_B1_x__coupler1_theta*z_coupler1_theta - l_B1_x__crank0_theta*z_crank0_theta
        - l_B1_x__crank1_theta*z_crank1_theta + rhs_B1_x;
    const Lanes z_B1_y = -l_B1_y__coupler1_theta*z_coupler1_theta - l_B1_y__crank0_theta*z_crank0_theta
        - l_B1_y__crank1_theta*z_crank1_theta + rhs_B1_y;

    /* backward substitution */
    const Lanes lambda_B1_y = inverse_cross_B1_x__B1_y*z_B1_x + inverse_pivot_B1_y*z_B1_y;
    const Lanes lambda_B1_x = inverse_cross_B1_x__B1_y*z_B1_y + inverse_pivot_B1_x*z_B1_x;
    const Lanes acceleration_coupler1_theta = inverse_pivot_coupler1_theta*z_coupler1_theta
        - l_B1_x__coupler1_theta*lambda_B1_x - l_B1_y__coupler1_theta*lambda_B1_y;
    const Lanes acceleration_crank0_theta = -acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        + p->inverse_mass_crank0_crank0*z_crank0_theta - l_B1_x__crank0_theta*lambda_B1_x
        - l_B1_y__crank0_theta*lambda_B1_y;
    const Lanes acceleration_crank1_theta = inverse_pivot_crank1_theta*z_crank1_theta
        - l_B1_x__crank1_theta*lambda_B1_x - l_B1_y__crank1_theta*lambda_B1_y;
    const Lanes lambda_B2_y = -acceleration_crank1_theta*l_crank1_theta__B2_y + inverse_cross_B2_x__B2_y*z_B2_x
        + inverse_pivot_B2_y*z_B2_y;
    const Lanes lambda_B2_x = -acceleration_crank1_theta*l_crank1_theta__B2_x + inverse_cross_B2_x__B2_y*z_B2_y
        + inverse_pivot_B2_x*z_B2_x;
    const Lanes acceleration_coupler2_theta = -acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        + p->inverse_mass_coupler2_coupler2*z_coupler2_theta - l_B2_x__coupler2_theta*lambda_B2_x
        - l_B2_y__coupler2_theta*lambda_B2_y;
    const Lanes acceleration_crank2_theta = p->inverse_mass_crank2_crank2*z_crank2_theta
        - l_B2_x__crank2_theta*lambda_B2_x - l_B2_y__crank2_theta*lambda_B2_y;

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
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
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
    const Lanes span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const Lanes span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const Lanes span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const Lanes span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const Lanes span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const Lanes span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const Lanes cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const Lanes dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const Lanes cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const Lanes dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;

    /* Phi and Phi_dot */
    const Lanes phi_B2_x = p->O1_x - p->O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;
    const Lanes phi_dot_B2_x = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y
        + crank2_omega*span_crank2_head_y;
    const Lanes phi_B2_y = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;
    const Lanes phi_dot_B2_y = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x
        - crank2_omega*span_crank2_head_x;
    const Lanes phi_B1_x = -p->O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;
    const Lanes phi_dot_B1_x = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y
        + crank1_omega*span_crank1_head_y;
    const Lanes phi_B1_y = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;
    const Lanes phi_dot_B1_y = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x
        - crank1_omega*span_crank1_head_x;

    /* L D L^T of the KKT matrix */
    const Lanes l_B2_x__crank2_theta = p->inverse_mass_crank2_crank2*span_crank2_head_y;
    const Lanes l_B2_y__crank2_theta = -p->inverse_mass_crank2_crank2*span_crank2_head_x;
    const Lanes l_coupler1_theta__crank0_theta = dot_crank0_coupler1*p->inverse_mass_crank0_crank0;
    const Lanes l_B1_x__crank0_theta = -p->inverse_mass_crank0_crank0*span_crank0_head_y;
    const Lanes l_B1_y__crank0_theta = p->inverse_mass_crank0_crank0*span_crank0_head_x;
    const Lanes inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta
        + p->mass_coupler1_coupler1);
    const Lanes w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const Lanes l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const Lanes w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const Lanes l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const Lanes l_crank1_theta__coupler2_theta = dot_crank1_coupler2*p->inverse_mass_coupler2_coupler2;
    const Lanes l_B2_x__coupler2_theta = -p->inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const Lanes l_B2_y__coupler2_theta = p->inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const Lanes inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta
        + p->mass_crank1_crank1);
    const Lanes w_B2_x__crank1_theta = -dot_crank1_coupler2*l_B2_x__coupler2_theta - span_crank1_head_y;
    const Lanes l_B2_x__crank1_theta = inverse_pivot_crank1_theta*w_B2_x__crank1_theta;
    const Lanes w_B2_y__crank1_theta = -dot_crank1_coupler2*l_B2_y__coupler2_theta + span_crank1_head_x;
    const Lanes l_B2_y__crank1_theta = inverse_pivot_crank1_theta*w_B2_y__crank1_theta;
    const Lanes l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const Lanes l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const Lanes scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y + l_B2_x__crank1_theta*w_B2_x__crank1_theta
        + l_B2_x__crank2_theta*span_crank2_head_y;
    const Lanes scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x + l_B2_y__crank1_theta*w_B2_y__crank1_theta
        - l_B2_y__crank2_theta*span_crank2_head_x;
    const Lanes pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y
        + l_B2_y__crank1_theta*w_B2_x__crank1_theta + l_B2_y__crank2_theta*span_crank2_head_y;
    const Lanes determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    *rare |= ~((scale_B2_x > 0.0) & (scale_B2_x < INFINITY));
    *rare |= ~(determinant_B2_x__B2_y > memory->least_size * scale_B2_y * scale_B2_x);
    const Lanes size_B2_x = scale_B2_x + scale_B2_y;
    *rare |= ~(scale_B2_x > memory->least_size * size_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > memory->least_size * size_B2_x * scale_B2_x);
    const Lanes inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const Lanes inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const Lanes inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const Lanes inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const Lanes w_B1_x__B2_x = -l_B1_x__crank1_theta*w_B2_x__crank1_theta;
    const Lanes w_B1_x__B2_y = -l_B1_x__crank1_theta*w_B2_y__crank1_theta;
    const Lanes l_B1_x__B2_x = inverse_cross_B2_x__B2_y*w_B1_x__B2_y + inverse_pivot_B2_x*w_B1_x__B2_x;
    const Lanes l_B1_x__B2_y = inverse_cross_B2_x__B2_y*w_B1_x__B2_x + inverse_pivot_B2_y*w_B1_x__B2_y;
    const Lanes w_B1_y__B2_x = -l_B1_y__crank1_theta*w_B2_x__crank1_theta;
    const Lanes w_B1_y__B2_y = -l_B1_y__crank1_theta*w_B2_y__crank1_theta;
    const Lanes l_B1_y__B2_x = inverse_cross_B2_x__B2_y*w_B1_y__B2_y + inverse_pivot_B2_x*w_B1_y__B2_x;
    const Lanes l_B1_y__B2_y = inverse_cross_B2_x__B2_y*w_B1_y__B2_x + inverse_pivot_B2_y*w_B1_y__B2_y;
    const Lanes scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta - l_B1_x__crank0_theta*span_crank0_head_y
        + l_B1_x__crank1_theta*span_crank1_head_y;
    const Lanes scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta + l_B1_y__crank0_theta*span_crank0_head_x
        - l_B1_y__crank1_theta*span_crank1_head_x;
    const Lanes pivot_B1_x = l_B1_x__B2_x*w_B1_x__B2_x + l_B1_x__B2_y*w_B1_x__B2_y + scale_B1_x;
    const Lanes pivot_B1_y = l_B1_y__B2_x*w_B1_y__B2_x + l_B1_y__B2_y*w_B1_y__B2_y + scale_B1_y;
    const Lanes pivot_B1_x__B1_y = l_B1_y__B2_x*w_B1_x__B2_x + l_B1_y__B2_y*w_B1_x__B2_y
        + l_B1_y__coupler1_theta*w_B1_x__coupler1_theta - l_B1_y__crank0_theta*span_crank0_head_y
        + l_B1_y__crank1_theta*span_crank1_head_y;
    const Lanes determinant_B1_x__B1_y = pivot_B1_x*pivot_B1_y - (pivot_B1_x__B1_y * pivot_B1_x__B1_y);
    *rare |= ~(pivot_B1_x > memory->least_size * scale_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > memory->least_size * scale_B1_y * pivot_B1_x);
    const Lanes size_B1_x = scale_B1_x + scale_B1_y;
    *rare |= ~(pivot_B1_x > memory->least_size * size_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > memory->least_size * size_B1_x * pivot_B1_x);
    const Lanes inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const Lanes inverse_pivot_B1_x = inverse_B1_x__B1_y*pivot_B1_y;
    const Lanes inverse_pivot_B1_y = inverse_B1_x__B1_y*pivot_B1_x;
    const Lanes inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const Lanes dq_z_B1_x = -l_B1_x__B2_x*phi_B2_x - l_B1_x__B2_y*phi_B2_y + phi_B1_x;
    const Lanes dq_z_B1_y = -l_B1_y__B2_x*phi_B2_x - l_B1_y__B2_y*phi_B2_y + phi_B1_y;

    /* backward substitution */
    const Lanes dq_lambda_B1_y = dq_z_B1_x*inverse_cross_B1_x__B1_y + dq_z_B1_y*inverse_pivot_B1_y;
    const Lanes dq_lambda_B1_x = dq_z_B1_x*inverse_pivot_B1_x + dq_z_B1_y*inverse_cross_B1_x__B1_y;
    const Lanes dq_lambda_B2_y = -dq_lambda_B1_x*l_B1_x__B2_y - dq_lambda_B1_y*l_B1_y__B2_y
        + inverse_cross_B2_x__B2_y*phi_B2_x + inverse_pivot_B2_y*phi_B2_y;
    const Lanes dq_lambda_B2_x = -dq_lambda_B1_x*l_B1_x__B2_x - dq_lambda_B1_y*l_B1_y__B2_x
        + inverse_cross_B2_x__B2_y*phi_B2_y + inverse_pivot_B2_x*phi_B2_x;
    const Lanes dq_acceleration_crank1_theta = -dq_lambda_B1_x*l_B1_x__crank1_theta
        - dq_lambda_B1_y*l_B1_y__crank1_theta - dq_lambda_B2_x*l_B2_x__crank1_theta
        - dq_lambda_B2_y*l_B2_y__crank1_theta;
    const Lanes dq_acceleration_coupler2_theta = -dq_acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        - dq_lambda_B2_x*l_B2_x__coupler2_theta - dq_lambda_B2_y*l_B2_y__coupler2_theta;
    const Lanes dq_acceleration_coupler1_theta = -dq_lambda_B1_x*l_B1_x__coupler1_theta
        - dq_lambda_B1_y*l_B1_y__coupler1_theta;
    const Lanes dq_acceleration_crank0_theta = -dq_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        - dq_lambda_B1_x*l_B1_x__crank0_theta - dq_lambda_B1_y*l_B1_y__crank0_theta;
    const Lanes dq_acceleration_crank2_theta = -dq_lambda_B2_x*l_B2_x__crank2_theta
        - dq_lambda_B2_y*l_B2_y__crank2_theta;

    /* forward substitution */
    const Lanes dv_z_B1_x = -l_B1_x__B2_x*phi_dot_B2_x - l_B1_x__B2_y*phi_dot_B2_y + phi_dot_B1_x;
    const Lanes dv_z_B1_y = -l_B1_y__B2_x*phi_dot_B2_x - l_B1_y__B2_y*phi_dot_B2_y + phi_dot_B1_y;

    /* backward substitution */
    const Lanes dv_lambda_B1_y = dv_z_B1_x*inverse_cross_B1_x__B1_y + dv_z_B1_y*inverse_pivot_B1_y;
    const Lanes dv_lambda_B1_x = dv_z_B1_x*inverse_pivot_B1_x + dv_z_B1_y*inverse_cross_B1_x__B1_y;
    const Lanes dv_lambda_B2_y = -dv_lambda_B1_x*l_B1_x__B2_y - dv_lambda_B1_y*l_B1_y__B2_y
        + inverse_cross_B2_x__B2_y*phi_dot_B2_x + inverse_pivot_B2_y*phi_dot_B2_y;
    const Lanes dv_lambda_B2_x = -dv_lambda_B1_x*l_B1_x__B2_x - dv_lambda_B1_y*l_B1_y__B2_x
        + inverse_cross_B2_x__B2_y*phi_dot_B2_y + inverse_pivot_B2_x*phi_dot_B2_x;
    const Lanes dv_acceleration_crank1_theta = -dv_lambda_B1_x*l_B1_x__crank1_theta
        - dv_lambda_B1_y*l_B1_y__crank1_theta - dv_lambda_B2_x*l_B2_x__crank1_theta
        - dv_lambda_B2_y*l_B2_y__crank1_theta;
    const Lanes dv_acceleration_coupler2_theta = -dv_acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        - dv_lambda_B2_x*l_B2_x__coupler2_theta - dv_lambda_B2_y*l_B2_y__coupler2_theta;
    const Lanes dv_acceleration_coupler1_theta = -dv_lambda_B1_x*l_B1_x__coupler1_theta
        - dv_lambda_B1_y*l_B1_y__coupler1_theta;
    const Lanes dv_acceleration_crank0_theta = -dv_acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        - dv_lambda_B1_x*l_B1_x__crank0_theta - dv_lambda_B1_y*l_B1_y__crank0_theta;
    const Lanes dv_acceleration_crank2_theta = -dv_lambda_B2_x*l_B2_x__crank2_theta
        - dv_lambda_B2_y*l_B2_y__crank2_theta;

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
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_B2_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B2_y));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_y));
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
    const Lanes a_crank0_theta = a[0];
    const Lanes a_crank1_theta = a[1];
    const Lanes a_crank2_theta = a[2];
    const Lanes a_coupler1_theta = a[3];
    const Lanes a_coupler2_theta = a[4];
    const Lanes held_lambda_B2_x = aside->lambda[0];
    const Lanes held_lambda_B2_y = aside->lambda[1];
    const Lanes held_lambda_B1_x = aside->lambda[2];
    const Lanes held_lambda_B1_y = aside->lambda[3];

    /* directions, arms, drives */
    const Lanes cos_theta_crank0 = lanes_cos(crank0_theta);
    const Lanes sin_theta_crank0 = lanes_sin(crank0_theta);
    const Lanes cos_theta_crank1 = lanes_cos(crank1_theta);
    const Lanes sin_theta_crank1 = lanes_sin(crank1_theta);
    const Lanes cos_theta_crank2 = lanes_cos(crank2_theta);
    const Lanes sin_theta_crank2 = lanes_sin(crank2_theta);
    const Lanes cos_theta_coupler1 = lanes_cos(coupler1_theta);
    const Lanes sin_theta_coupler1 = lanes_sin(coupler1_theta);
    const Lanes cos_theta_coupler2 = lanes_cos(coupler2_theta);
    const Lanes sin_theta_coupler2 = lanes_sin(coupler2_theta);
    const Lanes span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const Lanes span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const Lanes span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const Lanes span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const Lanes span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const Lanes span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const Lanes span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const Lanes span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const Lanes span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const Lanes span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const Lanes cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const Lanes sin_coupler1_less_crank0 = -cos_theta_coupler1*sin_theta_crank0 + cos_theta_crank0*sin_theta_coupler1;
    const Lanes dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const Lanes cross_crank0_coupler1 = p->inertia_crank0_coupler1*sin_coupler1_less_crank0;
    const Lanes cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const Lanes sin_coupler2_less_crank1 = -cos_theta_coupler2*sin_theta_crank1 + cos_theta_crank1*sin_theta_coupler2;
    const Lanes dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;
    const Lanes cross_crank1_coupler2 = p->inertia_crank1_coupler2*sin_coupler2_less_crank1;

    /* results */
    lin->value[0] = dot_crank0_coupler1;
    lin->value[1] = dot_crank1_coupler2;
    lin->value[2] = -span_crank1_head_y;
    lin->value[3] = span_crank2_head_y;
    lin->value[4] = -span_coupler2_head_y;
    lin->value[5] = span_crank1_head_x;
    lin->value[6] = -span_crank2_head_x;
    lin->value[7] = span_coupler2_head_x;
    lin->value[8] = -span_crank0_head_y;
    lin->value[9] = -span_coupler1_head_y;
    lin->value[10] = span_crank0_head_x;
    lin->value[11] = span_coupler1_head_x;
    lin->value[12] = -a_coupler2_theta*span_coupler2_head_x + (coupler2_omega * coupler2_omega)*span_coupler2_head_y
        - coupler2_omega*span_coupler2_head_x*p->two_alpha;
    lin->value[13] = -a_crank1_theta*span_crank1_head_x + (crank1_omega * crank1_omega)*span_crank1_head_y
        - crank1_omega*span_crank1_head_x*p->two_alpha;
    lin->value[14] = a_crank2_theta*span_crank2_head_x - (crank2_omega * crank2_omega)*span_crank2_head_y
        + crank2_omega*span_crank2_head_x*p->two_alpha;
    lin->value[15] = -a_coupler2_theta*span_coupler2_head_y - (coupler2_omega * coupler2_omega)*span_coupler2_head_x
        - coupler2_omega*span_coupler2_head_y*p->two_alpha;
    lin->value[16] = -a_crank1_theta*span_crank1_head_y - (crank1_omega * crank1_omega)*span_crank1_head_x
        - crank1_omega*span_crank1_head_y*p->two_alpha;
    lin->value[17] = a_crank2_theta*span_crank2_head_y + (crank2_omega * crank2_omega)*span_crank2_head_x
        + crank2_omega*span_crank2_head_y*p->two_alpha;
    lin->value[18] = -a_coupler1_theta*span_coupler1_head_x + (coupler1_omega * coupler1_omega)*span_coupler1_head_y
        - coupler1_omega*span_coupler1_head_x*p->two_alpha;
    lin->value[19] = -a_crank0_theta*span_crank0_head_x + (crank0_omega * crank0_omega)*span_crank0_head_y
        - crank0_omega*span_crank0_head_x*p->two_alpha;
    lin->value[20] = -a_coupler1_theta*span_coupler1_head_y - (coupler1_omega * coupler1_omega)*span_coupler1_head_x
        - coupler1_omega*span_coupler1_head_y*p->two_alpha;
    lin->value[21] = -a_crank0_theta*span_crank0_head_y - (crank0_omega * crank0_omega)*span_crank0_head_x
        - crank0_omega*span_crank0_head_y*p->two_alpha;
    lin->value[22] = a_coupler1_theta*cross_crank0_coupler1 + (coupler1_omega * coupler1_omega)*dot_crank0_coupler1
        - held_lambda_B1_x*span_crank0_head_x - held_lambda_B1_y*span_crank0_head_y
        + sin_theta_crank0*p->weight_crank0__across;
    lin->value[23] = -a_coupler1_theta*cross_crank0_coupler1 - (coupler1_omega * coupler1_omega)*dot_crank0_coupler1;
    lin->value[24] = a_coupler2_theta*cross_crank1_coupler2 + (coupler2_omega * coupler2_omega)*dot_crank1_coupler2
        + sin_theta_crank1*p->weight_crank1__across + span_crank1_head_x*(held_lambda_B1_x - held_lambda_B2_x)
        - span_crank1_head_y*(-held_lambda_B1_y + held_lambda_B2_y);
    lin->value[25] = -a_coupler2_theta*cross_crank1_coupler2 - (coupler2_omega * coupler2_omega)*dot_crank1_coupler2;
    lin->value[26] = held_lambda_B2_x*span_crank2_head_x + held_lambda_B2_y*span_crank2_head_y
        + sin_theta_crank2*p->weight_crank2__across;
    lin->value[27] = -a_crank0_theta*cross_crank0_coupler1 + (crank0_omega * crank0_omega)*dot_crank0_coupler1
        - held_lambda_B1_x*span_coupler1_head_x - held_lambda_B1_y*span_coupler1_head_y
        + sin_theta_coupler1*p->weight_coupler1__across;
    lin->value[28] = a_crank0_theta*cross_crank0_coupler1 - (crank0_omega * crank0_omega)*dot_crank0_coupler1;
    lin->value[29] = -a_crank1_theta*cross_crank1_coupler2 + (crank1_omega * crank1_omega)*dot_crank1_coupler2
        - held_lambda_B2_x*span_coupler2_head_x - held_lambda_B2_y*span_coupler2_head_y
        + sin_theta_coupler2*p->weight_coupler2__across;
    lin->value[30] = a_crank1_theta*cross_crank1_coupler2 - (crank1_omega * crank1_omega)*dot_crank1_coupler2;
    lin->value[31] = -2.0*coupler2_omega*span_coupler2_head_x;
    lin->value[32] = -2.0*crank1_omega*span_crank1_head_x;
    lin->value[33] = 2.0*crank2_omega*span_crank2_head_x;
    lin->value[34] = -2.0*coupler2_omega*span_coupler2_head_y;
    lin->value[35] = -2.0*crank1_omega*span_crank1_head_y;
    lin->value[36] = 2.0*crank2_omega*span_crank2_head_y;
    lin->value[37] = -2.0*coupler1_omega*span_coupler1_head_x;
    lin->value[38] = -2.0*crank0_omega*span_crank0_head_x;
    lin->value[39] = -2.0*coupler1_omega*span_coupler1_head_y;
    lin->value[40] = -2.0*crank0_omega*span_crank0_head_y;
    lin->value[41] = -2.0*coupler1_omega*cross_crank0_coupler1;
    lin->value[42] = -2.0*coupler2_omega*cross_crank1_coupler2;
    lin->value[43] = 2.0*crank0_omega*cross_crank0_coupler1;
    lin->value[44] = 2.0*crank1_omega*cross_crank1_coupler2;
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
    const Lanes mass_crank0_theta_coupler1_theta = lin->value[0];
    const Lanes mass_crank1_theta_coupler2_theta = lin->value[1];
    const Lanes phi_B2_x_crank1_theta = lin->value[2];
    const Lanes phi_B2_x_crank2_theta = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta = lin->value[4];
    const Lanes phi_B2_y_crank1_theta = lin->value[5];
    const Lanes phi_B2_y_crank2_theta = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta = lin->value[7];
    const Lanes phi_B1_x_crank0_theta = lin->value[8];
    const Lanes phi_B1_x_coupler1_theta = lin->value[9];
    const Lanes phi_B1_y_crank0_theta = lin->value[10];
    const Lanes phi_B1_y_coupler1_theta = lin->value[11];
    const Lanes by_q_B2_x_coupler2_theta = lin->value[12];
    const Lanes by_q_B2_x_crank1_theta = lin->value[13];
    const Lanes by_q_B2_x_crank2_theta = lin->value[14];
    const Lanes by_q_B2_y_coupler2_theta = lin->value[15];
    const Lanes by_q_B2_y_crank1_theta = lin->value[16];
    const Lanes by_q_B2_y_crank2_theta = lin->value[17];
    const Lanes by_q_B1_x_coupler1_theta = lin->value[18];
    const Lanes by_q_B1_x_crank0_theta = lin->value[19];
    const Lanes by_q_B1_y_coupler1_theta = lin->value[20];
    const Lanes by_q_B1_y_crank0_theta = lin->value[21];
    const Lanes by_q_crank0_theta_crank0_theta = lin->value[22];
    const Lanes by_q_crank0_theta_coupler1_theta = lin->value[23];
    const Lanes by_q_crank1_theta_crank1_theta = lin->value[24];
    const Lanes by_q_crank1_theta_coupler2_theta = lin->value[25];
    const Lanes by_q_crank2_theta_crank2_theta = lin->value[26];
    const Lanes by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const Lanes by_q_coupler1_theta_crank0_theta = lin->value[28];
    const Lanes by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const Lanes by_q_coupler2_theta_crank1_theta = lin->value[30];
    const Lanes by_v_B2_x_coupler2_theta = lin->value[31];
    const Lanes by_v_B2_x_crank1_theta = lin->value[32];
    const Lanes by_v_B2_x_crank2_theta = lin->value[33];
    const Lanes by_v_B2_y_coupler2_theta = lin->value[34];
    const Lanes by_v_B2_y_crank1_theta = lin->value[35];
    const Lanes by_v_B2_y_crank2_theta = lin->value[36];
    const Lanes by_v_B1_x_coupler1_theta = lin->value[37];
    const Lanes by_v_B1_x_crank0_theta = lin->value[38];
    const Lanes by_v_B1_y_coupler1_theta = lin->value[39];
    const Lanes by_v_B1_y_crank0_theta = lin->value[40];
    const Lanes by_v_crank0_theta_coupler1_theta = lin->value[41];
    const Lanes by_v_crank1_theta_coupler2_theta = lin->value[42];
    const Lanes by_v_coupler1_theta_crank0_theta = lin->value[43];
    const Lanes by_v_coupler2_theta_crank1_theta = lin->value[44];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_crank0_theta__crank0_theta = by_q_crank0_theta_crank0_theta*(eta * eta) + p->mass_crank0_crank0;
    const Lanes n_crank0_theta__coupler1_theta = eta*(by_q_crank0_theta_coupler1_theta*eta
        + by_v_crank0_theta_coupler1_theta) + mass_crank0_theta_coupler1_theta;
    const Lanes n_crank1_theta__crank1_theta = by_q_crank1_theta_crank1_theta*(eta * eta) + p->mass_crank1_crank1;
    const Lanes n_crank1_theta__coupler2_theta = eta*(by_q_crank1_theta_coupler2_theta*eta
        + by_v_crank1_theta_coupler2_theta) + mass_crank1_theta_coupler2_theta;
    const Lanes n_crank2_theta__crank2_theta = by_q_crank2_theta_crank2_theta*(eta * eta) + p->mass_crank2_crank2;
    const Lanes n_coupler1_theta__crank0_theta = eta*(by_q_coupler1_theta_crank0_theta*eta
        + by_v_coupler1_theta_crank0_theta) + mass_crank0_theta_coupler1_theta;
    const Lanes n_coupler1_theta__coupler1_theta = by_q_coupler1_theta_coupler1_theta*(eta * eta)
        + p->mass_coupler1_coupler1;
    const Lanes n_coupler2_theta__crank1_theta = eta*(by_q_coupler2_theta_crank1_theta*eta
        + by_v_coupler2_theta_crank1_theta) + mass_crank1_theta_coupler2_theta;
    const Lanes n_coupler2_theta__coupler2_theta = by_q_coupler2_theta_coupler2_theta*(eta * eta)
        + p->mass_coupler2_coupler2;
    const Lanes n_B2_x__crank1_theta = eta_row*(by_q_B2_x_crank1_theta*eta + by_v_B2_x_crank1_theta)
        + phi_B2_x_crank1_theta;
    const Lanes n_B2_x__crank2_theta = eta_row*(by_q_B2_x_crank2_theta*eta + by_v_B2_x_crank2_theta)
        + phi_B2_x_crank2_theta;
    const Lanes n_B2_x__coupler2_theta = eta_row*(by_q_B2_x_coupler2_theta*eta + by_v_B2_x_coupler2_theta)
        + phi_B2_x_coupler2_theta;
    const Lanes n_B2_y__crank1_theta = eta_row*(by_q_B2_y_crank1_theta*eta + by_v_B2_y_crank1_theta)
        + phi_B2_y_crank1_theta;
    const Lanes n_B2_y__crank2_theta = eta_row*(by_q_B2_y_crank2_theta*eta + by_v_B2_y_crank2_theta)
        + phi_B2_y_crank2_theta;
    const Lanes n_B2_y__coupler2_theta = eta_row*(by_q_B2_y_coupler2_theta*eta + by_v_B2_y_coupler2_theta)
        + phi_B2_y_coupler2_theta;
    const Lanes n_B1_x__crank0_theta = eta_row*(by_q_B1_x_crank0_theta*eta + by_v_B1_x_crank0_theta)
        + phi_B1_x_crank0_theta;
    const Lanes n_B1_x__crank1_theta = eta_row*(-by_q_B2_x_crank1_theta*eta - by_v_B2_x_crank1_theta)
        - phi_B2_x_crank1_theta;
    const Lanes n_B1_x__coupler1_theta = eta_row*(by_q_B1_x_coupler1_theta*eta + by_v_B1_x_coupler1_theta)
        + phi_B1_x_coupler1_theta;
    const Lanes n_B1_y__crank0_theta = eta_row*(by_q_B1_y_crank0_theta*eta + by_v_B1_y_crank0_theta)
        + phi_B1_y_crank0_theta;
    const Lanes n_B1_y__crank1_theta = eta_row*(-by_q_B2_y_crank1_theta*eta - by_v_B2_y_crank1_theta)
        - phi_B2_y_crank1_theta;
    const Lanes n_B1_y__coupler1_theta = eta_row*(by_q_B1_y_coupler1_theta*eta + by_v_B1_y_coupler1_theta)
        + phi_B1_y_coupler1_theta;

    /* L U */
    const Lanes scale_crank2_theta = n_crank2_theta__crank2_theta;
    *rare |= ~(lanes_fabs(scale_crank2_theta) > SINGULAR * lanes_fabs(n_crank2_theta__crank2_theta));
    const Lanes inverse_pivot_crank2_theta = 1.0/scale_crank2_theta;
    lin->lu[0] = inverse_pivot_crank2_theta;
    const Lanes l_B2_x__crank2_theta = inverse_pivot_crank2_theta*n_B2_x__crank2_theta;
    lin->lu[1] = l_B2_x__crank2_theta;
    const Lanes l_B2_y__crank2_theta = inverse_pivot_crank2_theta*n_B2_y__crank2_theta;
    lin->lu[2] = l_B2_y__crank2_theta;
    const Lanes scale_crank0_theta = n_crank0_theta__crank0_theta;
    *rare |= ~(lanes_fabs(scale_crank0_theta) > SINGULAR * lanes_fabs(n_crank0_theta__crank0_theta));
    const Lanes inverse_pivot_crank0_theta = 1.0/scale_crank0_theta;
    lin->lu[3] = inverse_pivot_crank0_theta;
    const Lanes l_coupler1_theta__crank0_theta = inverse_pivot_crank0_theta*n_coupler1_theta__crank0_theta;
    lin->lu[4] = l_coupler1_theta__crank0_theta;
    lin->lu[5] = n_crank0_theta__coupler1_theta;
    const Lanes l_B1_x__crank0_theta = inverse_pivot_crank0_theta*n_B1_x__crank0_theta;
    lin->lu[6] = l_B1_x__crank0_theta;
    const Lanes l_B1_y__crank0_theta = inverse_pivot_crank0_theta*n_B1_y__crank0_theta;
    lin->lu[7] = l_B1_y__crank0_theta;
    const Lanes scale_coupler1_theta = -l_coupler1_theta__crank0_theta*n_crank0_theta__coupler1_theta
        + n_coupler1_theta__coupler1_theta;
    *rare |= ~(lanes_fabs(scale_coupler1_theta) > SINGULAR * lanes_fabs(n_coupler1_theta__coupler1_theta));
    const Lanes inverse_pivot_coupler1_theta = 1.0/scale_coupler1_theta;
    lin->lu[8] = inverse_pivot_coupler1_theta;
    const Lanes l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_x__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_x__coupler1_theta);
    lin->lu[9] = l_B1_x__coupler1_theta;
    const Lanes u_coupler1_theta__B1_x = -l_coupler1_theta__crank0_theta*phi_B1_x_crank0_theta
        + phi_B1_x_coupler1_theta;
    lin->lu[10] = u_coupler1_theta__B1_x;
    const Lanes l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta
        *(-l_B1_y__crank0_theta*n_crank0_theta__coupler1_theta + n_B1_y__coupler1_theta);
    lin->lu[11] = l_B1_y__coupler1_theta;
    const Lanes u_coupler1_theta__B1_y = -l_coupler1_theta__crank0_theta*phi_B1_y_crank0_theta
        + phi_B1_y_coupler1_theta;
    lin->lu[12] = u_coupler1_theta__B1_y;
    const Lanes scale_coupler2_theta = n_coupler2_theta__coupler2_theta;
    *rare |= ~(lanes_fabs(scale_coupler2_theta) > SINGULAR * lanes_fabs(n_coupler2_theta__coupler2_theta));
    const Lanes inverse_pivot_coupler2_theta = 1.0/scale_coupler2_theta;
    lin->lu[13] = inverse_pivot_coupler2_theta;
    const Lanes l_crank1_theta__coupler2_theta = inverse_pivot_coupler2_theta*n_crank1_theta__coupler2_theta;
    lin->lu[14] = l_crank1_theta__coupler2_theta;
    lin->lu[15] = n_coupler2_theta__crank1_theta;
    const Lanes l_B2_x__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_x__coupler2_theta;
    lin->lu[16] = l_B2_x__coupler2_theta;
    const Lanes l_B2_y__coupler2_theta = inverse_pivot_coupler2_theta*n_B2_y__coupler2_theta;
    lin->lu[17] = l_B2_y__coupler2_theta;
    const Lanes scale_crank1_theta = -l_crank1_theta__coupler2_theta*n_coupler2_theta__crank1_theta
        + n_crank1_theta__crank1_theta;
    *rare |= ~(lanes_fabs(scale_crank1_theta) > SINGULAR * lanes_fabs(n_crank1_theta__crank1_theta));
    const Lanes inverse_pivot_crank1_theta = 1.0/scale_crank1_theta;
    lin->lu[18] = inverse_pivot_crank1_theta;
    const Lanes l_B2_x__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_x__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_x__crank1_theta);
    lin->lu[19] = l_B2_x__crank1_theta;
    const Lanes u_crank1_theta__B2_x = -l_crank1_theta__coupler2_theta*phi_B2_x_coupler2_theta + phi_B2_x_crank1_theta;
    lin->lu[20] = u_crank1_theta__B2_x;
    const Lanes l_B2_y__crank1_theta = inverse_pivot_crank1_theta
        *(-l_B2_y__coupler2_theta*n_coupler2_theta__crank1_theta + n_B2_y__crank1_theta);
    lin->lu[21] = l_B2_y__crank1_theta;
    const Lanes u_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*phi_B2_y_coupler2_theta + phi_B2_y_crank1_theta;
    lin->lu[22] = u_crank1_theta__B2_y;
    const Lanes l_B1_x__crank1_theta = inverse_pivot_crank1_theta*n_B1_x__crank1_theta;
    lin->lu[23] = l_B1_x__crank1_theta;
    const Lanes l_B1_y__crank1_theta = inverse_pivot_crank1_theta*n_B1_y__crank1_theta;
    lin->lu[24] = l_B1_y__crank1_theta;
    const Lanes scale_B2_x = -l_B2_x__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_x - l_B2_x__crank2_theta*phi_B2_x_crank2_theta;
    *rare |= ~((lanes_fabs(scale_B2_x) > 0.0) & (lanes_fabs(scale_B2_x) < INFINITY));
    const Lanes inverse_pivot_B2_x = 1.0/scale_B2_x;
    lin->lu[25] = inverse_pivot_B2_x;
    const Lanes l_B2_y__B2_x = inverse_pivot_B2_x*(-l_B2_y__coupler2_theta*phi_B2_x_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_x - l_B2_y__crank2_theta*phi_B2_x_crank2_theta);
    lin->lu[26] = l_B2_y__B2_x;
    const Lanes u_B2_x__B2_y = -l_B2_x__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_x__crank1_theta*u_crank1_theta__B2_y - l_B2_x__crank2_theta*phi_B2_y_crank2_theta;
    lin->lu[27] = u_B2_x__B2_y;
    const Lanes l_B1_x__B2_x = -inverse_pivot_B2_x*l_B1_x__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[28] = l_B1_x__B2_x;
    const Lanes u_B2_x__B1_x = l_B2_x__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[29] = u_B2_x__B1_x;
    const Lanes l_B1_y__B2_x = -inverse_pivot_B2_x*l_B1_y__crank1_theta*u_crank1_theta__B2_x;
    lin->lu[30] = l_B1_y__B2_x;
    const Lanes u_B2_x__B1_y = l_B2_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[31] = u_B2_x__B1_y;
    const Lanes scale_B2_y = -l_B2_y__coupler2_theta*phi_B2_y_coupler2_theta
        - l_B2_y__crank1_theta*u_crank1_theta__B2_y - l_B2_y__crank2_theta*phi_B2_y_crank2_theta;
    const Lanes pivot_B2_y = -l_B2_y__B2_x*u_B2_x__B2_y + scale_B2_y;
    *rare |= ~(lanes_fabs(pivot_B2_y) > SINGULAR * lanes_fabs(scale_B2_y));
    const Lanes inverse_pivot_B2_y = 1.0/pivot_B2_y;
    lin->lu[32] = inverse_pivot_B2_y;
    const Lanes l_B1_x__B2_y = inverse_pivot_B2_y*(-l_B1_x__B2_x*u_B2_x__B2_y
        - l_B1_x__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[33] = l_B1_x__B2_y;
    const Lanes u_B2_y__B1_x = -l_B2_y__B2_x*u_B2_x__B1_x + l_B2_y__crank1_theta*phi_B2_x_crank1_theta;
    lin->lu[34] = u_B2_y__B1_x;
    const Lanes l_B1_y__B2_y = inverse_pivot_B2_y*(-l_B1_y__B2_x*u_B2_x__B2_y
        - l_B1_y__crank1_theta*u_crank1_theta__B2_y);
    lin->lu[35] = l_B1_y__B2_y;
    const Lanes u_B2_y__B1_y = -l_B2_y__B2_x*u_B2_x__B1_y + l_B2_y__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[36] = u_B2_y__B1_y;
    const Lanes scale_B1_x = -l_B1_x__coupler1_theta*u_coupler1_theta__B1_x
        - l_B1_x__crank0_theta*phi_B1_x_crank0_theta + l_B1_x__crank1_theta*phi_B2_x_crank1_theta;
    const Lanes pivot_B1_x = -l_B1_x__B2_x*u_B2_x__B1_x - l_B1_x__B2_y*u_B2_y__B1_x + scale_B1_x;
    *rare |= ~(lanes_fabs(pivot_B1_x) > SINGULAR * lanes_fabs(scale_B1_x));
    const Lanes inverse_pivot_B1_x = 1.0/pivot_B1_x;
    lin->lu[37] = inverse_pivot_B1_x;
    const Lanes l_B1_y__B1_x = inverse_pivot_B1_x*(-l_B1_y__B2_x*u_B2_x__B1_x - l_B1_y__B2_y*u_B2_y__B1_x
        - l_B1_y__coupler1_theta*u_coupler1_theta__B1_x - l_B1_y__crank0_theta*phi_B1_x_crank0_theta
        + l_B1_y__crank1_theta*phi_B2_x_crank1_theta);
    lin->lu[38] = l_B1_y__B1_x;
    const Lanes u_B1_x__B1_y = -l_B1_x__B2_x*u_B2_x__B1_y - l_B1_x__B2_y*u_B2_y__B1_y
        - l_B1_x__coupler1_theta*u_coupler1_theta__B1_y - l_B1_x__crank0_theta*phi_B1_y_crank0_theta
        + l_B1_x__crank1_theta*phi_B2_y_crank1_theta;
    lin->lu[39] = u_B1_x__B1_y;
    const Lanes scale_B1_y = -l_B1_y__coupler1_theta*u_coupler1_theta__B1_y
        - l_B1_y__crank0_theta*phi_B1_y_crank0_theta + l_B1_y__crank1_theta*phi_B2_y_crank1_theta;
    const Lanes pivot_B1_y = -l_B1_y__B1_x*u_B1_x__B1_y - l_B1_y__B2_x*u_B2_x__B1_y - l_B1_y__B2_y*u_B2_y__B1_y
        + scale_B1_y;
    *rare |= ~(lanes_fabs(pivot_B1_y) > SINGULAR * lanes_fabs(scale_B1_y));
    const Lanes inverse_pivot_B1_y = 1.0/pivot_B1_y;
    lin->lu[40] = inverse_pivot_B1_y;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_B2_x_crank1_theta = lin->value[2];
    const Lanes phi_B2_x_crank2_theta = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta = lin->value[4];
    const Lanes phi_B2_y_crank1_theta = lin->value[5];
    const Lanes phi_B2_y_crank2_theta = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta = lin->value[7];
    const Lanes phi_B1_x_crank0_theta = lin->value[8];
    const Lanes phi_B1_y_crank0_theta = lin->value[10];
    const Lanes inverse_pivot_crank2_theta = lin->lu[0];
    const Lanes l_B2_x__crank2_theta = lin->lu[1];
    const Lanes l_B2_y__crank2_theta = lin->lu[2];
    const Lanes inverse_pivot_crank0_theta = lin->lu[3];
    const Lanes l_coupler1_theta__crank0_theta = lin->lu[4];
    const Lanes n_crank0_theta__coupler1_theta = lin->lu[5];
    const Lanes l_B1_x__crank0_theta = lin->lu[6];
    const Lanes l_B1_y__crank0_theta = lin->lu[7];
    const Lanes inverse_pivot_coupler1_theta = lin->lu[8];
    const Lanes l_B1_x__coupler1_theta = lin->lu[9];
    const Lanes u_coupler1_theta__B1_x = lin->lu[10];
    const Lanes l_B1_y__coupler1_theta = lin->lu[11];
    const Lanes u_coupler1_theta__B1_y = lin->lu[12];
    const Lanes inverse_pivot_coupler2_theta = lin->lu[13];
    const Lanes l_crank1_theta__coupler2_theta = lin->lu[14];
    const Lanes n_coupler2_theta__crank1_theta = lin->lu[15];
    const Lanes l_B2_x__coupler2_theta = lin->lu[16];
    const Lanes l_B2_y__coupler2_theta = lin->lu[17];
    const Lanes inverse_pivot_crank1_theta = lin->lu[18];
    const Lanes l_B2_x__crank1_theta = lin->lu[19];
    const Lanes u_crank1_theta__B2_x = lin->lu[20];
    const Lanes l_B2_y__crank1_theta = lin->lu[21];
    const Lanes u_crank1_theta__B2_y = lin->lu[22];
    const Lanes l_B1_x__crank1_theta = lin->lu[23];
    const Lanes l_B1_y__crank1_theta = lin->lu[24];
    const Lanes inverse_pivot_B2_x = lin->lu[25];
    const Lanes l_B2_y__B2_x = lin->lu[26];
    const Lanes u_B2_x__B2_y = lin->lu[27];
    const Lanes l_B1_x__B2_x = lin->lu[28];
    const Lanes u_B2_x__B1_x = lin->lu[29];
    const Lanes l_B1_y__B2_x = lin->lu[30];
    const Lanes u_B2_x__B1_y = lin->lu[31];
    const Lanes inverse_pivot_B2_y = lin->lu[32];
    const Lanes l_B1_x__B2_y = lin->lu[33];
    const Lanes u_B2_y__B1_x = lin->lu[34];
    const Lanes l_B1_y__B2_y = lin->lu[35];
    const Lanes u_B2_y__B1_y = lin->lu[36];
    const Lanes inverse_pivot_B1_x = lin->lu[37];
    const Lanes l_B1_y__B1_x = lin->lu[38];
    const Lanes u_B1_x__B1_y = lin->lu[39];
    const Lanes inverse_pivot_B1_y = lin->lu[40];

    /* forward */
    const Lanes b_crank2_theta = x[2];
    const Lanes b_crank0_theta = x[0];
    const Lanes b_coupler1_theta = -b_crank0_theta*l_coupler1_theta__crank0_theta + x[3];
    const Lanes b_coupler2_theta = x[4];
    const Lanes b_crank1_theta = -b_coupler2_theta*l_crank1_theta__coupler2_theta + x[1];
    const Lanes b_B2_x = -b_coupler2_theta*l_B2_x__coupler2_theta - b_crank1_theta*l_B2_x__crank1_theta
        - b_crank2_theta*l_B2_x__crank2_theta + x[5];
    const Lanes b_B2_y = -b_B2_x*l_B2_y__B2_x - b_coupler2_theta*l_B2_y__coupler2_theta
        - b_crank1_theta*l_B2_y__crank1_theta - b_crank2_theta*l_B2_y__crank2_theta + x[6];
    const Lanes b_B1_x = -b_B2_x*l_B1_x__B2_x - b_B2_y*l_B1_x__B2_y - b_coupler1_theta*l_B1_x__coupler1_theta
        - b_crank0_theta*l_B1_x__crank0_theta - b_crank1_theta*l_B1_x__crank1_theta + x[7];
    const Lanes b_B1_y = -b_B1_x*l_B1_y__B1_x - b_B2_x*l_B1_y__B2_x - b_B2_y*l_B1_y__B2_y
        - b_coupler1_theta*l_B1_y__coupler1_theta - b_crank0_theta*l_B1_y__crank0_theta
        - b_crank1_theta*l_B1_y__crank1_theta + x[8];

    /* backward */
    const Lanes x_B1_y = b_B1_y*inverse_pivot_B1_y;
    x[8] = x_B1_y;
    const Lanes x_B1_x = inverse_pivot_B1_x*(b_B1_x - u_B1_x__B1_y*x_B1_y);
    x[7] = x_B1_x;
    const Lanes x_B2_y = inverse_pivot_B2_y*(b_B2_y - u_B2_y__B1_x*x_B1_x - u_B2_y__B1_y*x_B1_y);
    x[6] = x_B2_y;
    const Lanes x_B2_x = inverse_pivot_B2_x*(b_B2_x - u_B2_x__B1_x*x_B1_x - u_B2_x__B1_y*x_B1_y - u_B2_x__B2_y*x_B2_y);
    x[5] = x_B2_x;
    const Lanes x_crank1_theta = inverse_pivot_crank1_theta*(b_crank1_theta + phi_B2_x_crank1_theta*x_B1_x
        + phi_B2_y_crank1_theta*x_B1_y - u_crank1_theta__B2_x*x_B2_x - u_crank1_theta__B2_y*x_B2_y);
    x[1] = x_crank1_theta;
    const Lanes x_coupler2_theta = inverse_pivot_coupler2_theta*(b_coupler2_theta
        - n_coupler2_theta__crank1_theta*x_crank1_theta - phi_B2_x_coupler2_theta*x_B2_x
        - phi_B2_y_coupler2_theta*x_B2_y);
    x[4] = x_coupler2_theta;
    const Lanes x_coupler1_theta = inverse_pivot_coupler1_theta*(b_coupler1_theta - u_coupler1_theta__B1_x*x_B1_x
        - u_coupler1_theta__B1_y*x_B1_y);
    x[3] = x_coupler1_theta;
    const Lanes x_crank0_theta = inverse_pivot_crank0_theta*(b_crank0_theta
        - n_crank0_theta__coupler1_theta*x_coupler1_theta - phi_B1_x_crank0_theta*x_B1_x
        - phi_B1_y_crank0_theta*x_B1_y);
    x[0] = x_crank0_theta;
    const Lanes x_crank2_theta = inverse_pivot_crank2_theta*(b_crank2_theta - phi_B2_x_crank2_theta*x_B2_x
        - phi_B2_y_crank2_theta*x_B2_y);
    x[2] = x_crank2_theta;
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
    const Lanes mass_crank0_theta_coupler1_theta = lin->value[0];
    const Lanes mass_crank1_theta_coupler2_theta = lin->value[1];
    const Lanes phi_B2_x_crank1_theta = lin->value[2];
    const Lanes phi_B2_x_crank2_theta = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta = lin->value[4];
    const Lanes phi_B2_y_crank1_theta = lin->value[5];
    const Lanes phi_B2_y_crank2_theta = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta = lin->value[7];
    const Lanes phi_B1_x_crank0_theta = lin->value[8];
    const Lanes phi_B1_x_coupler1_theta = lin->value[9];
    const Lanes phi_B1_y_crank0_theta = lin->value[10];
    const Lanes phi_B1_y_coupler1_theta = lin->value[11];
    const Lanes by_q_B2_x_coupler2_theta = lin->value[12];
    const Lanes by_q_B2_x_crank1_theta = lin->value[13];
    const Lanes by_q_B2_x_crank2_theta = lin->value[14];
    const Lanes by_q_B2_y_coupler2_theta = lin->value[15];
    const Lanes by_q_B2_y_crank1_theta = lin->value[16];
    const Lanes by_q_B2_y_crank2_theta = lin->value[17];
    const Lanes by_q_B1_x_coupler1_theta = lin->value[18];
    const Lanes by_q_B1_x_crank0_theta = lin->value[19];
    const Lanes by_q_B1_y_coupler1_theta = lin->value[20];
    const Lanes by_q_B1_y_crank0_theta = lin->value[21];
    const Lanes by_q_crank0_theta_crank0_theta = lin->value[22];
    const Lanes by_q_crank0_theta_coupler1_theta = lin->value[23];
    const Lanes by_q_crank1_theta_crank1_theta = lin->value[24];
    const Lanes by_q_crank1_theta_coupler2_theta = lin->value[25];
    const Lanes by_q_crank2_theta_crank2_theta = lin->value[26];
    const Lanes by_q_coupler1_theta_coupler1_theta = lin->value[27];
    const Lanes by_q_coupler1_theta_crank0_theta = lin->value[28];
    const Lanes by_q_coupler2_theta_coupler2_theta = lin->value[29];
    const Lanes by_q_coupler2_theta_crank1_theta = lin->value[30];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[9];
    const Lanes shifted_crank0_theta = -p->beta_squared*eta*r[0] + r[5];
    const Lanes shifted_crank1_theta = -p->beta_squared*eta*r[1] + r[6];
    const Lanes shifted_crank2_theta = -p->beta_squared*eta*r[2] + r[7];
    const Lanes shifted_coupler1_theta = -p->beta_squared*eta*r[3] + r[8];
    const Lanes shifted_coupler2_theta = -p->beta_squared*eta*r[4] + r[9];
    x[0] = eta*(-by_q_crank0_theta_coupler1_theta*eta*r[3] - by_q_crank0_theta_crank0_theta*eta*r[0]
        + p->mass_crank0_crank0*r[5] + mass_crank0_theta_coupler1_theta*r[8]);
    x[1] = eta*(-by_q_crank1_theta_coupler2_theta*eta*r[4] - by_q_crank1_theta_crank1_theta*eta*r[1]
        + p->mass_crank1_crank1*r[6] + mass_crank1_theta_coupler2_theta*r[9]);
    x[2] = eta*(-by_q_crank2_theta_crank2_theta*eta*r[2] + p->mass_crank2_crank2*r[7]);
    x[3] = eta*(-by_q_coupler1_theta_coupler1_theta*eta*r[3] - by_q_coupler1_theta_crank0_theta*eta*r[0]
        + p->mass_coupler1_coupler1*r[8] + mass_crank0_theta_coupler1_theta*r[5]);
    x[4] = eta*(-by_q_coupler2_theta_coupler2_theta*eta*r[4] - by_q_coupler2_theta_crank1_theta*eta*r[1]
        + p->mass_coupler2_coupler2*r[9] + mass_crank1_theta_coupler2_theta*r[6]);
    x[5] = eta_row*(-by_q_B2_x_coupler2_theta*eta*r[4] - by_q_B2_x_crank1_theta*eta*r[1]
        - by_q_B2_x_crank2_theta*eta*r[2] + phi_B2_x_coupler2_theta*shifted_coupler2_theta
        + phi_B2_x_crank1_theta*shifted_crank1_theta + phi_B2_x_crank2_theta*shifted_crank2_theta);
    x[6] = eta_row*(-by_q_B2_y_coupler2_theta*eta*r[4] - by_q_B2_y_crank1_theta*eta*r[1]
        - by_q_B2_y_crank2_theta*eta*r[2] + phi_B2_y_coupler2_theta*shifted_coupler2_theta
        + phi_B2_y_crank1_theta*shifted_crank1_theta + phi_B2_y_crank2_theta*shifted_crank2_theta);
    x[7] = eta_row*(-by_q_B1_x_coupler1_theta*eta*r[3] - by_q_B1_x_crank0_theta*eta*r[0]
        + by_q_B2_x_crank1_theta*eta*r[1] + phi_B1_x_coupler1_theta*shifted_coupler1_theta
        + phi_B1_x_crank0_theta*shifted_crank0_theta - phi_B2_x_crank1_theta*shifted_crank1_theta);
    x[8] = eta_row*(-by_q_B1_y_coupler1_theta*eta*r[3] - by_q_B1_y_crank0_theta*eta*r[0]
        + by_q_B2_y_crank1_theta*eta*r[1] + phi_B1_y_coupler1_theta*shifted_coupler1_theta
        + phi_B1_y_crank0_theta*shifted_crank0_theta - phi_B2_y_crank1_theta*shifted_crank1_theta);
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
    u[10] = eta*r[10];
    u[11] = eta*r[11];
    u[12] = eta*r[12];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
