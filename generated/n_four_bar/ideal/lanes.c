/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
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
    (void)t, (void)memory;
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
    *rare |= ~(scale_B2_x > VANISHING * size_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > VANISHING * size_B2_x * scale_B2_x);
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
    *rare |= ~(determinant_B1_x__B1_y > NEARLY_SINGULAR * scale_B1_y * scale_B1_x);
    const Lanes size_B1_x = scale_B1_x + scale_B1_y;
    *rare |= ~(scale_B1_x > VANISHING * size_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > VANISHING * size_B1_x * scale_B1_x);
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
    (void)t, (void)memory;
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
    *rare |= ~(determinant_B2_x__B2_y > VANISHING * scale_B2_y * scale_B2_x);
    const Lanes size_B2_x = scale_B2_x + scale_B2_y;
    *rare |= ~(scale_B2_x > VANISHING * size_B2_x);
    *rare |= ~(determinant_B2_x__B2_y > VANISHING * size_B2_x * scale_B2_x);
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
    *rare |= ~(pivot_B1_x > VANISHING * scale_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > VANISHING * scale_B1_y * pivot_B1_x);
    const Lanes size_B1_x = scale_B1_x + scale_B1_y;
    *rare |= ~(pivot_B1_x > VANISHING * size_B1_x);
    *rare |= ~(determinant_B1_x__B1_y > VANISHING * size_B1_x * pivot_B1_x);
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

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
