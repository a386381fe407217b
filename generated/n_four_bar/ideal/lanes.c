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
    Lanes length_;
    Lanes mass_;
    Lanes inertia_;
    Lanes crank0_mass_;
    Lanes crank0_inertia_;
    Lanes crank1_mass_;
    Lanes crank1_inertia_;
    Lanes crank2_mass_;
    Lanes crank2_inertia_;
    Lanes coupler1_mass_;
    Lanes coupler1_inertia_;
    Lanes coupler2_mass_;
    Lanes coupler2_inertia_;
    Lanes crank0_length_;
    Lanes crank1_length_;
    Lanes crank2_length_;
    Lanes coupler1_length_;
    Lanes coupler2_length_;
    Lanes alpha_;
    Lanes beta_;
    Lanes O1_x_;
    Lanes O2_x_;
    Lanes gravity_y_;
    Lanes guess_crank1_theta_;
    Lanes guess_crank2_theta_;
    Lanes guess_coupler1_theta_;
    Lanes guess_coupler2_theta_;
    Lanes set_crank0_theta_;
    Lanes rates_crank0_omega_;
    Lanes crank0_head_s_x_;
    Lanes crank1_head_s_x_;
    Lanes crank2_head_s_x_;
    Lanes coupler1_head_s_x_;
    Lanes coupler2_head_s_x_;
    Lanes weight_crank0_y_;
    Lanes weight_crank1_y_;
    Lanes weight_crank2_y_;
    Lanes weight_coupler1_y_;
    Lanes weight_coupler2_y_;
    Lanes crank2_turning_;
    Lanes crank0_turning_;
    Lanes coupler1_turning_;
    Lanes coupler2_turning_;
    Lanes crank1_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes mobility_B1_x_;
    Lanes mobility_B2_x_;
    Lanes crank0_head_span_x_;
    Lanes crank1_head_span_x_;
    Lanes coupler2_head_span_x_;
    Lanes crank2_head_span_x_;
    Lanes coupler1_head_span_x_;
    Lanes inertia_crank0_crank0_;
    Lanes inertia_crank1_crank1_;
    Lanes inertia_crank2_crank2_;
    Lanes inertia_crank0_coupler1_;
    Lanes inertia_coupler1_coupler1_;
    Lanes inertia_crank1_coupler2_;
    Lanes inertia_coupler2_coupler2_;
    Lanes mass_crank0_crank0_;
    Lanes mass_crank1_crank1_;
    Lanes mass_crank2_crank2_;
    Lanes mass_coupler1_coupler1_;
    Lanes mass_coupler2_coupler2_;
    Lanes weight_crank0_across_;
    Lanes weight_crank1_across_;
    Lanes weight_crank2_across_;
    Lanes weight_coupler1_across_;
    Lanes weight_coupler2_across_;
    Lanes inverse_mass_crank2_crank2_;
    Lanes inverse_mass_coupler2_coupler2_;
    Lanes inverse_mass_crank0_crank0_;
    Lanes tree_metric_crank0_theta_;
    Lanes tree_metric_crank1_theta_;
    Lanes tree_metric_crank2_theta_;
    Lanes tree_metric_coupler1_theta_;
    Lanes tree_metric_coupler2_theta_;
    Lanes inverse_tree_metric_crank2_theta_;
    Lanes inverse_tree_metric_crank0_theta_;
    Lanes inverse_tree_metric_coupler2_theta_;
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
    const Lanes crank0_theta_ = q[0];
    const Lanes crank1_theta_ = q[1];
    const Lanes crank2_theta_ = q[2];
    const Lanes coupler1_theta_ = q[3];
    const Lanes coupler2_theta_ = q[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta_, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0_ = cosines_0;
    const Lanes sin_theta_crank0_ = sines_0;
    const Lanes cos_theta_crank1_ = cosines_1;
    const Lanes sin_theta_crank1_ = sines_1;
    const Lanes cos_theta_crank2_ = cosines_2;
    const Lanes sin_theta_crank2_ = sines_2;
    const Lanes cos_theta_coupler1_ = cosines_3;
    const Lanes sin_theta_coupler1_ = sines_3;
    const Lanes cos_theta_coupler2_ = cosines_4;
    const Lanes sin_theta_coupler2_ = sines_4;
    const Lanes span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const Lanes span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const Lanes span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const Lanes span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const Lanes span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const Lanes span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const Lanes span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const Lanes span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const Lanes span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const Lanes span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;

    /* rows */
    out[0] = p->O1_x_ - p->O2_x_ + span_coupler2_head_x_ + span_crank1_head_x_ - span_crank2_head_x_;  /* B2.x */
    out[1] = span_coupler2_head_y_ + span_crank1_head_y_ - span_crank2_head_y_;  /* B2.y */
    out[2] = -p->O1_x_ + span_coupler1_head_x_ + span_crank0_head_x_ - span_crank1_head_x_;  /* B1.x */
    out[3] = span_coupler1_head_y_ + span_crank0_head_y_ - span_crank1_head_y_;  /* B1.y */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank0_theta_ = q[0];
    const Lanes crank0_omega_ = v[0];
    const Lanes crank1_theta_ = q[1];
    const Lanes crank1_omega_ = v[1];
    const Lanes crank2_theta_ = q[2];
    const Lanes crank2_omega_ = v[2];
    const Lanes coupler1_theta_ = q[3];
    const Lanes coupler1_omega_ = v[3];
    const Lanes coupler2_theta_ = q[4];
    const Lanes coupler2_omega_ = v[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta_, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0_ = cosines_0;
    const Lanes sin_theta_crank0_ = sines_0;
    const Lanes cos_theta_crank1_ = cosines_1;
    const Lanes sin_theta_crank1_ = sines_1;
    const Lanes cos_theta_crank2_ = cosines_2;
    const Lanes sin_theta_crank2_ = sines_2;
    const Lanes cos_theta_coupler1_ = cosines_3;
    const Lanes sin_theta_coupler1_ = sines_3;
    const Lanes cos_theta_coupler2_ = cosines_4;
    const Lanes sin_theta_coupler2_ = sines_4;
    const Lanes span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const Lanes span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const Lanes span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const Lanes span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const Lanes span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const Lanes span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const Lanes span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const Lanes span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const Lanes span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const Lanes span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;

    /* rows */
    /* B2.x */
    out[0] = -coupler2_omega_*span_coupler2_head_y_ - crank1_omega_*span_crank1_head_y_
        + crank2_omega_*span_crank2_head_y_;
    /* B2.y */
    out[1] = coupler2_omega_*span_coupler2_head_x_ + crank1_omega_*span_crank1_head_x_
        - crank2_omega_*span_crank2_head_x_;
    /* B1.x */
    out[2] = -coupler1_omega_*span_coupler1_head_y_ - crank0_omega_*span_crank0_head_y_
        + crank1_omega_*span_crank1_head_y_;
    /* B1.y */
    out[3] = coupler1_omega_*span_coupler1_head_x_ + crank0_omega_*span_crank0_head_x_
        - crank1_omega_*span_crank1_head_x_;
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
    const Lanes crank0_theta_ = q[0];
    const Lanes crank0_omega_ = v[0];
    const Lanes crank1_theta_ = q[1];
    const Lanes crank1_omega_ = v[1];
    const Lanes crank2_theta_ = q[2];
    const Lanes crank2_omega_ = v[2];
    const Lanes coupler1_theta_ = q[3];
    const Lanes coupler1_omega_ = v[3];
    const Lanes coupler2_theta_ = q[4];
    const Lanes coupler2_omega_ = v[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta_, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0_ = cosines_0;
    const Lanes sin_theta_crank0_ = sines_0;
    const Lanes cos_theta_crank1_ = cosines_1;
    const Lanes sin_theta_crank1_ = sines_1;
    const Lanes cos_theta_crank2_ = cosines_2;
    const Lanes sin_theta_crank2_ = sines_2;
    const Lanes cos_theta_coupler1_ = cosines_3;
    const Lanes sin_theta_coupler1_ = sines_3;
    const Lanes cos_theta_coupler2_ = cosines_4;
    const Lanes sin_theta_coupler2_ = sines_4;
    const Lanes span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const Lanes span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const Lanes span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const Lanes span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const Lanes span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const Lanes span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const Lanes span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const Lanes span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const Lanes span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const Lanes span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const Lanes cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const Lanes sin_coupler1_less_crank0_ = -cos_theta_coupler1_*sin_theta_crank0_
        + cos_theta_crank0_*sin_theta_coupler1_;
    const Lanes dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const Lanes cross_crank0_coupler1_ = p->inertia_crank0_coupler1_*sin_coupler1_less_crank0_;
    const Lanes cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const Lanes sin_coupler2_less_crank1_ = -cos_theta_coupler2_*sin_theta_crank1_
        + cos_theta_crank1_*sin_theta_coupler2_;
    const Lanes dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;
    const Lanes cross_crank1_coupler2_ = p->inertia_crank1_coupler2_*sin_coupler2_less_crank1_;

    /* constraints: gamma */
    const Lanes rhs_B2_x_ = (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_x_
        + (crank1_omega_ * crank1_omega_)*span_crank1_head_x_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_x_;
    const Lanes rhs_B2_y_ = (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_y_
        + (crank1_omega_ * crank1_omega_)*span_crank1_head_y_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_y_;
    const Lanes rhs_B1_x_ = (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_x_
        + (crank0_omega_ * crank0_omega_)*span_crank0_head_x_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_x_;
    const Lanes rhs_B1_y_ = (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_y_
        + (crank0_omega_ * crank0_omega_)*span_crank0_head_y_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_y_;

    /* L D L^T of the KKT matrix */
    *rare |= ~(p->mass_crank2_crank2_ > LIGHT_PIVOT * p->crank2_turning_);
    const Lanes l_B2_x_crank2_theta_ = p->inverse_mass_crank2_crank2_*span_crank2_head_y_;
    const Lanes l_B2_y_crank2_theta_ = -p->inverse_mass_crank2_crank2_*span_crank2_head_x_;
    *rare |= ~(p->mass_coupler2_coupler2_ > LIGHT_PIVOT * p->coupler2_turning_);
    const Lanes l_B2_x_coupler2_theta_ = -p->inverse_mass_coupler2_coupler2_*span_coupler2_head_y_;
    const Lanes l_B2_y_coupler2_theta_ = p->inverse_mass_coupler2_coupler2_*span_coupler2_head_x_;
    const Lanes l_crank1_theta_coupler2_theta_ = dot_crank1_coupler2_*p->inverse_mass_coupler2_coupler2_;
    const Lanes scale_B2_x_ = -l_B2_x_coupler2_theta_*span_coupler2_head_y_ + l_B2_x_crank2_theta_*span_crank2_head_y_;
    const Lanes scale_B2_y_ = l_B2_y_coupler2_theta_*span_coupler2_head_x_ - l_B2_y_crank2_theta_*span_crank2_head_x_;
    const Lanes pivot_B2_x_B2_y_ = -l_B2_y_coupler2_theta_*span_coupler2_head_y_
        + l_B2_y_crank2_theta_*span_crank2_head_y_;
    const Lanes determinant_B2_x_B2_y_ = -(pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_) + scale_B2_x_*scale_B2_y_;
    *rare |= ~((scale_B2_x_ > 0.0) & (scale_B2_x_ < INFINITY));
    *rare |= ~(determinant_B2_x_B2_y_ > EARLY * scale_B2_y_ * scale_B2_x_);
    const Lanes size_B2_x_ = scale_B2_x_ + scale_B2_y_;
    *rare |= ~(scale_B2_x_ > memory->least_size * size_B2_x_);
    *rare |= ~(determinant_B2_x_B2_y_ > memory->least_size * size_B2_x_ * scale_B2_x_);
    const Lanes inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const Lanes inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*scale_B2_y_;
    const Lanes inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*scale_B2_x_;
    const Lanes inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;
    const Lanes w_crank1_theta_B2_x_ = l_crank1_theta_coupler2_theta_*span_coupler2_head_y_ - span_crank1_head_y_;
    const Lanes w_crank1_theta_B2_y_ = -l_crank1_theta_coupler2_theta_*span_coupler2_head_x_ + span_crank1_head_x_;
    const Lanes l_crank1_theta_B2_x_ = inverse_cross_B2_x_B2_y_*w_crank1_theta_B2_y_
        + inverse_pivot_B2_x_*w_crank1_theta_B2_x_;
    const Lanes l_crank1_theta_B2_y_ = inverse_cross_B2_x_B2_y_*w_crank1_theta_B2_x_
        + inverse_pivot_B2_y_*w_crank1_theta_B2_y_;
    const Lanes pivot_crank1_theta_ = -dot_crank1_coupler2_*l_crank1_theta_coupler2_theta_
        - l_crank1_theta_B2_x_*w_crank1_theta_B2_x_ - l_crank1_theta_B2_y_*w_crank1_theta_B2_y_
        + p->mass_crank1_crank1_;
    *rare |= ~(pivot_crank1_theta_ > LIGHT_PIVOT * p->crank1_turning_);
    const Lanes inverse_pivot_crank1_theta_ = 1.0/pivot_crank1_theta_;
    const Lanes l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*span_crank1_head_y_;
    const Lanes l_B1_y_crank1_theta_ = -inverse_pivot_crank1_theta_*span_crank1_head_x_;
    *rare |= ~(p->mass_crank0_crank0_ > LIGHT_PIVOT * p->crank0_turning_);
    const Lanes l_coupler1_theta_crank0_theta_ = dot_crank0_coupler1_*p->inverse_mass_crank0_crank0_;
    const Lanes l_B1_x_crank0_theta_ = -p->inverse_mass_crank0_crank0_*span_crank0_head_y_;
    const Lanes l_B1_y_crank0_theta_ = p->inverse_mass_crank0_crank0_*span_crank0_head_x_;
    const Lanes pivot_coupler1_theta_ = -dot_crank0_coupler1_*l_coupler1_theta_crank0_theta_
        + p->mass_coupler1_coupler1_;
    *rare |= ~(pivot_coupler1_theta_ > LIGHT_PIVOT * p->coupler1_turning_);
    const Lanes inverse_pivot_coupler1_theta_ = 1.0/pivot_coupler1_theta_;
    const Lanes w_B1_x_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_x_crank0_theta_ - span_coupler1_head_y_;
    const Lanes l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const Lanes w_B1_y_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_y_crank0_theta_ + span_coupler1_head_x_;
    const Lanes l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const Lanes scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_x_crank0_theta_*span_crank0_head_y_
        + l_B1_x_crank1_theta_*span_crank1_head_y_;
    const Lanes scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_ + l_B1_y_crank0_theta_*span_crank0_head_x_
        - l_B1_y_crank1_theta_*span_crank1_head_x_;
    const Lanes pivot_B1_x_B1_y_ = l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_
        - l_B1_y_crank0_theta_*span_crank0_head_y_ + l_B1_y_crank1_theta_*span_crank1_head_y_;
    const Lanes determinant_B1_x_B1_y_ = -(pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_) + scale_B1_x_*scale_B1_y_;
    *rare |= ~((scale_B1_x_ > 0.0) & (scale_B1_x_ < INFINITY));
    *rare |= ~(determinant_B1_x_B1_y_ > memory->least * scale_B1_y_ * scale_B1_x_);
    const Lanes size_B1_x_ = scale_B1_x_ + scale_B1_y_;
    *rare |= ~(scale_B1_x_ > memory->least_size * size_B1_x_);
    *rare |= ~(determinant_B1_x_B1_y_ > memory->least_size * size_B1_x_ * scale_B1_x_);
    const Lanes inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const Lanes inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*scale_B1_y_;
    const Lanes inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*scale_B1_x_;
    const Lanes inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;

    /* forward substitution */
    const Lanes z_crank2_theta_ = cos_theta_crank2_*p->weight_crank2_across_;
    const Lanes z_coupler2_theta_ = cos_theta_coupler2_*p->weight_coupler2_across_
        - (crank1_omega_ * crank1_omega_)*cross_crank1_coupler2_;
    const Lanes z_B2_x_ = -l_B2_x_coupler2_theta_*z_coupler2_theta_ - l_B2_x_crank2_theta_*z_crank2_theta_ + rhs_B2_x_;
    const Lanes z_B2_y_ = -l_B2_y_coupler2_theta_*z_coupler2_theta_ - l_B2_y_crank2_theta_*z_crank2_theta_ + rhs_B2_y_;
    const Lanes z_crank1_theta_ = cos_theta_crank1_*p->weight_crank1_across_
        + (coupler2_omega_ * coupler2_omega_)*cross_crank1_coupler2_ - l_crank1_theta_B2_x_*z_B2_x_
        - l_crank1_theta_B2_y_*z_B2_y_ - l_crank1_theta_coupler2_theta_*z_coupler2_theta_;
    const Lanes z_crank0_theta_ = cos_theta_crank0_*p->weight_crank0_across_
        + (coupler1_omega_ * coupler1_omega_)*cross_crank0_coupler1_;
    const Lanes z_coupler1_theta_ = cos_theta_coupler1_*p->weight_coupler1_across_
        - (crank0_omega_ * crank0_omega_)*cross_crank0_coupler1_ - l_coupler1_theta_crank0_theta_*z_crank0_theta_;
    const Lanes z_B1_x_ = -l_B1_x_coupler1_theta_*z_coupler1_theta_ - l_B1_x_crank0_theta_*z_crank0_theta_
        - l_B1_x_crank1_theta_*z_crank1_theta_ + rhs_B1_x_;
    const Lanes z_B1_y_ = -l_B1_y_coupler1_theta_*z_coupler1_theta_ - l_B1_y_crank0_theta_*z_crank0_theta_
        - l_B1_y_crank1_theta_*z_crank1_theta_ + rhs_B1_y_;

    /* backward substitution */
    const Lanes lambda_B1_y_ = inverse_cross_B1_x_B1_y_*z_B1_x_ + inverse_pivot_B1_y_*z_B1_y_;
    const Lanes lambda_B1_x_ = inverse_cross_B1_x_B1_y_*z_B1_y_ + inverse_pivot_B1_x_*z_B1_x_;
    const Lanes acceleration_coupler1_theta_ = inverse_pivot_coupler1_theta_*z_coupler1_theta_
        - l_B1_x_coupler1_theta_*lambda_B1_x_ - l_B1_y_coupler1_theta_*lambda_B1_y_;
    const Lanes acceleration_crank0_theta_ = -acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        + p->inverse_mass_crank0_crank0_*z_crank0_theta_ - l_B1_x_crank0_theta_*lambda_B1_x_
        - l_B1_y_crank0_theta_*lambda_B1_y_;
    const Lanes acceleration_crank1_theta_ = inverse_pivot_crank1_theta_*z_crank1_theta_
        - l_B1_x_crank1_theta_*lambda_B1_x_ - l_B1_y_crank1_theta_*lambda_B1_y_;
    const Lanes lambda_B2_y_ = -acceleration_crank1_theta_*l_crank1_theta_B2_y_ + inverse_cross_B2_x_B2_y_*z_B2_x_
        + inverse_pivot_B2_y_*z_B2_y_;
    const Lanes lambda_B2_x_ = -acceleration_crank1_theta_*l_crank1_theta_B2_x_ + inverse_cross_B2_x_B2_y_*z_B2_y_
        + inverse_pivot_B2_x_*z_B2_x_;
    const Lanes acceleration_coupler2_theta_ = -acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        + p->inverse_mass_coupler2_coupler2_*z_coupler2_theta_ - l_B2_x_coupler2_theta_*lambda_B2_x_
        - l_B2_y_coupler2_theta_*lambda_B2_y_;
    const Lanes acceleration_crank2_theta_ = p->inverse_mass_crank2_crank2_*z_crank2_theta_
        - l_B2_x_crank2_theta_*lambda_B2_x_ - l_B2_y_crank2_theta_*lambda_B2_y_;

    /* results */
    a[0] = acceleration_crank0_theta_;
    a[1] = acceleration_crank1_theta_;
    a[2] = acceleration_crank2_theta_;
    a[3] = acceleration_coupler1_theta_;
    a[4] = acceleration_coupler2_theta_;
    aside->lambda[0] = lambda_B2_x_;
    aside->lambda[1] = lambda_B2_y_;
    aside->lambda[2] = lambda_B1_x_;
    aside->lambda[3] = lambda_B1_y_;

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
    const Lanes crank0_theta_ = q[0];
    const Lanes crank0_omega_ = v[0];
    const Lanes crank1_theta_ = q[1];
    const Lanes crank1_omega_ = v[1];
    const Lanes crank2_theta_ = q[2];
    const Lanes crank2_omega_ = v[2];
    const Lanes coupler1_theta_ = q[3];
    const Lanes coupler1_omega_ = v[3];
    const Lanes coupler2_theta_ = q[4];
    const Lanes coupler2_omega_ = v[4];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank0_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(crank1_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(crank2_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(coupler1_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(coupler2_theta_, &sines_4, &cosines_4, rare);
    const Lanes cos_theta_crank0_ = cosines_0;
    const Lanes sin_theta_crank0_ = sines_0;
    const Lanes cos_theta_crank1_ = cosines_1;
    const Lanes sin_theta_crank1_ = sines_1;
    const Lanes cos_theta_crank2_ = cosines_2;
    const Lanes sin_theta_crank2_ = sines_2;
    const Lanes cos_theta_coupler1_ = cosines_3;
    const Lanes sin_theta_coupler1_ = sines_3;
    const Lanes cos_theta_coupler2_ = cosines_4;
    const Lanes sin_theta_coupler2_ = sines_4;
    const Lanes span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const Lanes span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const Lanes span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const Lanes span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const Lanes span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const Lanes span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const Lanes span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const Lanes span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const Lanes span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const Lanes span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const Lanes cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const Lanes dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const Lanes cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const Lanes dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;

    /* Phi and Phi_dot */
    const Lanes phi_B2_x_ = p->O1_x_ - p->O2_x_ + span_coupler2_head_x_ + span_crank1_head_x_ - span_crank2_head_x_;
    const Lanes phi_dot_B2_x_ = -coupler2_omega_*span_coupler2_head_y_ - crank1_omega_*span_crank1_head_y_
        + crank2_omega_*span_crank2_head_y_;
    const Lanes phi_B2_y_ = span_coupler2_head_y_ + span_crank1_head_y_ - span_crank2_head_y_;
    const Lanes phi_dot_B2_y_ = coupler2_omega_*span_coupler2_head_x_ + crank1_omega_*span_crank1_head_x_
        - crank2_omega_*span_crank2_head_x_;
    const Lanes phi_B1_x_ = -p->O1_x_ + span_coupler1_head_x_ + span_crank0_head_x_ - span_crank1_head_x_;
    const Lanes phi_dot_B1_x_ = -coupler1_omega_*span_coupler1_head_y_ - crank0_omega_*span_crank0_head_y_
        + crank1_omega_*span_crank1_head_y_;
    const Lanes phi_B1_y_ = span_coupler1_head_y_ + span_crank0_head_y_ - span_crank1_head_y_;
    const Lanes phi_dot_B1_y_ = coupler1_omega_*span_coupler1_head_x_ + crank0_omega_*span_crank0_head_x_
        - crank1_omega_*span_crank1_head_x_;

    /* L D L^T of the KKT matrix */
    const Lanes l_B2_x_crank2_theta_ = p->inverse_tree_metric_crank2_theta_*span_crank2_head_y_;
    const Lanes l_B2_y_crank2_theta_ = -p->inverse_tree_metric_crank2_theta_*span_crank2_head_x_;
    const Lanes l_coupler1_theta_crank0_theta_ = dot_crank0_coupler1_*p->inverse_tree_metric_crank0_theta_;
    const Lanes l_B1_x_crank0_theta_ = -p->inverse_tree_metric_crank0_theta_*span_crank0_head_y_;
    const Lanes l_B1_y_crank0_theta_ = p->inverse_tree_metric_crank0_theta_*span_crank0_head_x_;
    const Lanes inverse_pivot_coupler1_theta_ = 1.0/(-dot_crank0_coupler1_*l_coupler1_theta_crank0_theta_
        + p->tree_metric_coupler1_theta_);
    const Lanes w_B1_x_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_x_crank0_theta_ - span_coupler1_head_y_;
    const Lanes l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_x_coupler1_theta_;
    const Lanes w_B1_y_coupler1_theta_ = -dot_crank0_coupler1_*l_B1_y_crank0_theta_ + span_coupler1_head_x_;
    const Lanes l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_*w_B1_y_coupler1_theta_;
    const Lanes l_crank1_theta_coupler2_theta_ = dot_crank1_coupler2_*p->inverse_tree_metric_coupler2_theta_;
    const Lanes l_B2_x_coupler2_theta_ = -p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_y_;
    const Lanes l_B2_y_coupler2_theta_ = p->inverse_tree_metric_coupler2_theta_*span_coupler2_head_x_;
    const Lanes inverse_pivot_crank1_theta_ = 1.0/(-dot_crank1_coupler2_*l_crank1_theta_coupler2_theta_
        + p->tree_metric_crank1_theta_);
    const Lanes w_B2_x_crank1_theta_ = -dot_crank1_coupler2_*l_B2_x_coupler2_theta_ - span_crank1_head_y_;
    const Lanes l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_x_crank1_theta_;
    const Lanes w_B2_y_crank1_theta_ = -dot_crank1_coupler2_*l_B2_y_coupler2_theta_ + span_crank1_head_x_;
    const Lanes l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_*w_B2_y_crank1_theta_;
    const Lanes l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*span_crank1_head_y_;
    const Lanes l_B1_y_crank1_theta_ = -inverse_pivot_crank1_theta_*span_crank1_head_x_;
    const Lanes scale_B2_x_ = -l_B2_x_coupler2_theta_*span_coupler2_head_y_ + l_B2_x_crank1_theta_*w_B2_x_crank1_theta_
        + l_B2_x_crank2_theta_*span_crank2_head_y_;
    const Lanes scale_B2_y_ = l_B2_y_coupler2_theta_*span_coupler2_head_x_ + l_B2_y_crank1_theta_*w_B2_y_crank1_theta_
        - l_B2_y_crank2_theta_*span_crank2_head_x_;
    const Lanes pivot_B2_x_B2_y_ = -l_B2_y_coupler2_theta_*span_coupler2_head_y_
        + l_B2_y_crank1_theta_*w_B2_x_crank1_theta_ + l_B2_y_crank2_theta_*span_crank2_head_y_;
    const Lanes determinant_B2_x_B2_y_ = -(pivot_B2_x_B2_y_ * pivot_B2_x_B2_y_) + scale_B2_x_*scale_B2_y_;
    *rare |= ~((scale_B2_x_ > 0.0) & (scale_B2_x_ < INFINITY));
    *rare |= ~(determinant_B2_x_B2_y_ > memory->least_size * scale_B2_y_ * scale_B2_x_);
    const Lanes size_B2_x_ = scale_B2_x_ + scale_B2_y_;
    *rare |= ~(scale_B2_x_ > memory->least_size * size_B2_x_);
    *rare |= ~(determinant_B2_x_B2_y_ > memory->least_size * size_B2_x_ * scale_B2_x_);
    const Lanes inverse_B2_x_B2_y_ = -1.0/determinant_B2_x_B2_y_;
    const Lanes inverse_pivot_B2_x_ = inverse_B2_x_B2_y_*scale_B2_y_;
    const Lanes inverse_pivot_B2_y_ = inverse_B2_x_B2_y_*scale_B2_x_;
    const Lanes inverse_cross_B2_x_B2_y_ = -inverse_B2_x_B2_y_*pivot_B2_x_B2_y_;
    const Lanes w_B1_x_B2_x_ = -l_B1_x_crank1_theta_*w_B2_x_crank1_theta_;
    const Lanes w_B1_x_B2_y_ = -l_B1_x_crank1_theta_*w_B2_y_crank1_theta_;
    const Lanes l_B1_x_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_y_ + inverse_pivot_B2_x_*w_B1_x_B2_x_;
    const Lanes l_B1_x_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_x_B2_x_ + inverse_pivot_B2_y_*w_B1_x_B2_y_;
    const Lanes w_B1_y_B2_x_ = -l_B1_y_crank1_theta_*w_B2_x_crank1_theta_;
    const Lanes w_B1_y_B2_y_ = -l_B1_y_crank1_theta_*w_B2_y_crank1_theta_;
    const Lanes l_B1_y_B2_x_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_y_ + inverse_pivot_B2_x_*w_B1_y_B2_x_;
    const Lanes l_B1_y_B2_y_ = inverse_cross_B2_x_B2_y_*w_B1_y_B2_x_ + inverse_pivot_B2_y_*w_B1_y_B2_y_;
    const Lanes scale_B1_x_ = l_B1_x_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_x_crank0_theta_*span_crank0_head_y_
        + l_B1_x_crank1_theta_*span_crank1_head_y_;
    const Lanes scale_B1_y_ = l_B1_y_coupler1_theta_*w_B1_y_coupler1_theta_ + l_B1_y_crank0_theta_*span_crank0_head_x_
        - l_B1_y_crank1_theta_*span_crank1_head_x_;
    const Lanes pivot_B1_x_ = l_B1_x_B2_x_*w_B1_x_B2_x_ + l_B1_x_B2_y_*w_B1_x_B2_y_ + scale_B1_x_;
    const Lanes pivot_B1_y_ = l_B1_y_B2_x_*w_B1_y_B2_x_ + l_B1_y_B2_y_*w_B1_y_B2_y_ + scale_B1_y_;
    const Lanes pivot_B1_x_B1_y_ = l_B1_y_B2_x_*w_B1_x_B2_x_ + l_B1_y_B2_y_*w_B1_x_B2_y_
        + l_B1_y_coupler1_theta_*w_B1_x_coupler1_theta_ - l_B1_y_crank0_theta_*span_crank0_head_y_
        + l_B1_y_crank1_theta_*span_crank1_head_y_;
    const Lanes determinant_B1_x_B1_y_ = pivot_B1_x_*pivot_B1_y_ - (pivot_B1_x_B1_y_ * pivot_B1_x_B1_y_);
    *rare |= ~(pivot_B1_x_ > memory->least_size * scale_B1_x_);
    *rare |= ~(determinant_B1_x_B1_y_ > memory->least_size * scale_B1_y_ * pivot_B1_x_);
    const Lanes size_B1_x_ = scale_B1_x_ + scale_B1_y_;
    *rare |= ~(pivot_B1_x_ > memory->least_size * size_B1_x_);
    *rare |= ~(determinant_B1_x_B1_y_ > memory->least_size * size_B1_x_ * pivot_B1_x_);
    const Lanes inverse_B1_x_B1_y_ = -1.0/determinant_B1_x_B1_y_;
    const Lanes inverse_pivot_B1_x_ = inverse_B1_x_B1_y_*pivot_B1_y_;
    const Lanes inverse_pivot_B1_y_ = inverse_B1_x_B1_y_*pivot_B1_x_;
    const Lanes inverse_cross_B1_x_B1_y_ = -inverse_B1_x_B1_y_*pivot_B1_x_B1_y_;

    /* forward substitution */
    const Lanes dq_z_B1_x_ = -l_B1_x_B2_x_*phi_B2_x_ - l_B1_x_B2_y_*phi_B2_y_ + phi_B1_x_;
    const Lanes dq_z_B1_y_ = -l_B1_y_B2_x_*phi_B2_x_ - l_B1_y_B2_y_*phi_B2_y_ + phi_B1_y_;

    /* backward substitution */
    const Lanes dq_lambda_B1_y_ = dq_z_B1_x_*inverse_cross_B1_x_B1_y_ + dq_z_B1_y_*inverse_pivot_B1_y_;
    const Lanes dq_lambda_B1_x_ = dq_z_B1_x_*inverse_pivot_B1_x_ + dq_z_B1_y_*inverse_cross_B1_x_B1_y_;
    const Lanes dq_lambda_B2_y_ = -dq_lambda_B1_x_*l_B1_x_B2_y_ - dq_lambda_B1_y_*l_B1_y_B2_y_
        + inverse_cross_B2_x_B2_y_*phi_B2_x_ + inverse_pivot_B2_y_*phi_B2_y_;
    const Lanes dq_lambda_B2_x_ = -dq_lambda_B1_x_*l_B1_x_B2_x_ - dq_lambda_B1_y_*l_B1_y_B2_x_
        + inverse_cross_B2_x_B2_y_*phi_B2_y_ + inverse_pivot_B2_x_*phi_B2_x_;
    const Lanes dq_acceleration_crank1_theta_ = -dq_lambda_B1_x_*l_B1_x_crank1_theta_
        - dq_lambda_B1_y_*l_B1_y_crank1_theta_ - dq_lambda_B2_x_*l_B2_x_crank1_theta_
        - dq_lambda_B2_y_*l_B2_y_crank1_theta_;
    const Lanes dq_acceleration_coupler2_theta_ = -dq_acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        - dq_lambda_B2_x_*l_B2_x_coupler2_theta_ - dq_lambda_B2_y_*l_B2_y_coupler2_theta_;
    const Lanes dq_acceleration_coupler1_theta_ = -dq_lambda_B1_x_*l_B1_x_coupler1_theta_
        - dq_lambda_B1_y_*l_B1_y_coupler1_theta_;
    const Lanes dq_acceleration_crank0_theta_ = -dq_acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        - dq_lambda_B1_x_*l_B1_x_crank0_theta_ - dq_lambda_B1_y_*l_B1_y_crank0_theta_;
    const Lanes dq_acceleration_crank2_theta_ = -dq_lambda_B2_x_*l_B2_x_crank2_theta_
        - dq_lambda_B2_y_*l_B2_y_crank2_theta_;

    /* forward substitution */
    const Lanes dv_z_B1_x_ = -l_B1_x_B2_x_*phi_dot_B2_x_ - l_B1_x_B2_y_*phi_dot_B2_y_ + phi_dot_B1_x_;
    const Lanes dv_z_B1_y_ = -l_B1_y_B2_x_*phi_dot_B2_x_ - l_B1_y_B2_y_*phi_dot_B2_y_ + phi_dot_B1_y_;

    /* backward substitution */
    const Lanes dv_lambda_B1_y_ = dv_z_B1_x_*inverse_cross_B1_x_B1_y_ + dv_z_B1_y_*inverse_pivot_B1_y_;
    const Lanes dv_lambda_B1_x_ = dv_z_B1_x_*inverse_pivot_B1_x_ + dv_z_B1_y_*inverse_cross_B1_x_B1_y_;
    const Lanes dv_lambda_B2_y_ = -dv_lambda_B1_x_*l_B1_x_B2_y_ - dv_lambda_B1_y_*l_B1_y_B2_y_
        + inverse_cross_B2_x_B2_y_*phi_dot_B2_x_ + inverse_pivot_B2_y_*phi_dot_B2_y_;
    const Lanes dv_lambda_B2_x_ = -dv_lambda_B1_x_*l_B1_x_B2_x_ - dv_lambda_B1_y_*l_B1_y_B2_x_
        + inverse_cross_B2_x_B2_y_*phi_dot_B2_y_ + inverse_pivot_B2_x_*phi_dot_B2_x_;
    const Lanes dv_acceleration_crank1_theta_ = -dv_lambda_B1_x_*l_B1_x_crank1_theta_
        - dv_lambda_B1_y_*l_B1_y_crank1_theta_ - dv_lambda_B2_x_*l_B2_x_crank1_theta_
        - dv_lambda_B2_y_*l_B2_y_crank1_theta_;
    const Lanes dv_acceleration_coupler2_theta_ = -dv_acceleration_crank1_theta_*l_crank1_theta_coupler2_theta_
        - dv_lambda_B2_x_*l_B2_x_coupler2_theta_ - dv_lambda_B2_y_*l_B2_y_coupler2_theta_;
    const Lanes dv_acceleration_coupler1_theta_ = -dv_lambda_B1_x_*l_B1_x_coupler1_theta_
        - dv_lambda_B1_y_*l_B1_y_coupler1_theta_;
    const Lanes dv_acceleration_crank0_theta_ = -dv_acceleration_coupler1_theta_*l_coupler1_theta_crank0_theta_
        - dv_lambda_B1_x_*l_B1_x_crank0_theta_ - dv_lambda_B1_y_*l_B1_y_crank0_theta_;
    const Lanes dv_acceleration_crank2_theta_ = -dv_lambda_B2_x_*l_B2_x_crank2_theta_
        - dv_lambda_B2_y_*l_B2_y_crank2_theta_;

    /* results */
    dq[0] = dq_acceleration_crank0_theta_;
    dv[0] = dv_acceleration_crank0_theta_;
    dq[1] = dq_acceleration_crank1_theta_;
    dv[1] = dv_acceleration_crank1_theta_;
    dq[2] = dq_acceleration_crank2_theta_;
    dv[2] = dv_acceleration_crank2_theta_;
    dq[3] = dq_acceleration_coupler1_theta_;
    dv[3] = dv_acceleration_coupler1_theta_;
    dq[4] = dq_acceleration_coupler2_theta_;
    dv[4] = dv_acceleration_coupler2_theta_;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_B2_x_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B2_y_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_x_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_B1_y_));
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
    const Lanes crank0_theta_ = q[0];
    const Lanes crank0_omega_ = v[0];
    const Lanes crank1_theta_ = q[1];
    const Lanes crank1_omega_ = v[1];
    const Lanes crank2_theta_ = q[2];
    const Lanes crank2_omega_ = v[2];
    const Lanes coupler1_theta_ = q[3];
    const Lanes coupler1_omega_ = v[3];
    const Lanes coupler2_theta_ = q[4];
    const Lanes coupler2_omega_ = v[4];
    const Lanes a_crank0_theta_ = a[0];
    const Lanes a_crank1_theta_ = a[1];
    const Lanes a_crank2_theta_ = a[2];
    const Lanes a_coupler1_theta_ = a[3];
    const Lanes a_coupler2_theta_ = a[4];
    const Lanes held_lambda_B2_x_ = aside->lambda[0];
    const Lanes held_lambda_B2_y_ = aside->lambda[1];
    const Lanes held_lambda_B1_x_ = aside->lambda[2];
    const Lanes held_lambda_B1_y_ = aside->lambda[3];

    /* directions, arms, drives */
    const Lanes cos_theta_crank0_ = lanes_cos(crank0_theta_);
    const Lanes sin_theta_crank0_ = lanes_sin(crank0_theta_);
    const Lanes cos_theta_crank1_ = lanes_cos(crank1_theta_);
    const Lanes sin_theta_crank1_ = lanes_sin(crank1_theta_);
    const Lanes cos_theta_crank2_ = lanes_cos(crank2_theta_);
    const Lanes sin_theta_crank2_ = lanes_sin(crank2_theta_);
    const Lanes cos_theta_coupler1_ = lanes_cos(coupler1_theta_);
    const Lanes sin_theta_coupler1_ = lanes_sin(coupler1_theta_);
    const Lanes cos_theta_coupler2_ = lanes_cos(coupler2_theta_);
    const Lanes sin_theta_coupler2_ = lanes_sin(coupler2_theta_);
    const Lanes span_crank0_head_x_ = cos_theta_crank0_*p->crank0_head_span_x_;
    const Lanes span_crank0_head_y_ = p->crank0_head_span_x_*sin_theta_crank0_;
    const Lanes span_crank1_head_x_ = cos_theta_crank1_*p->crank1_head_span_x_;
    const Lanes span_crank1_head_y_ = p->crank1_head_span_x_*sin_theta_crank1_;
    const Lanes span_coupler2_head_x_ = cos_theta_coupler2_*p->coupler2_head_span_x_;
    const Lanes span_coupler2_head_y_ = p->coupler2_head_span_x_*sin_theta_coupler2_;
    const Lanes span_crank2_head_x_ = cos_theta_crank2_*p->crank2_head_span_x_;
    const Lanes span_crank2_head_y_ = p->crank2_head_span_x_*sin_theta_crank2_;
    const Lanes span_coupler1_head_x_ = cos_theta_coupler1_*p->coupler1_head_span_x_;
    const Lanes span_coupler1_head_y_ = p->coupler1_head_span_x_*sin_theta_coupler1_;
    const Lanes cos_coupler1_less_crank0_ = cos_theta_coupler1_*cos_theta_crank0_
        + sin_theta_coupler1_*sin_theta_crank0_;
    const Lanes sin_coupler1_less_crank0_ = -cos_theta_coupler1_*sin_theta_crank0_
        + cos_theta_crank0_*sin_theta_coupler1_;
    const Lanes dot_crank0_coupler1_ = cos_coupler1_less_crank0_*p->inertia_crank0_coupler1_;
    const Lanes cross_crank0_coupler1_ = p->inertia_crank0_coupler1_*sin_coupler1_less_crank0_;
    const Lanes cos_coupler2_less_crank1_ = cos_theta_coupler2_*cos_theta_crank1_
        + sin_theta_coupler2_*sin_theta_crank1_;
    const Lanes sin_coupler2_less_crank1_ = -cos_theta_coupler2_*sin_theta_crank1_
        + cos_theta_crank1_*sin_theta_coupler2_;
    const Lanes dot_crank1_coupler2_ = cos_coupler2_less_crank1_*p->inertia_crank1_coupler2_;
    const Lanes cross_crank1_coupler2_ = p->inertia_crank1_coupler2_*sin_coupler2_less_crank1_;

    /* results */
    lin->value[0] = dot_crank0_coupler1_;
    lin->value[1] = dot_crank1_coupler2_;
    lin->value[2] = -span_crank1_head_y_;
    lin->value[3] = span_crank2_head_y_;
    lin->value[4] = -span_coupler2_head_y_;
    lin->value[5] = span_crank1_head_x_;
    lin->value[6] = -span_crank2_head_x_;
    lin->value[7] = span_coupler2_head_x_;
    lin->value[8] = -span_crank0_head_y_;
    lin->value[9] = -span_coupler1_head_y_;
    lin->value[10] = span_crank0_head_x_;
    lin->value[11] = span_coupler1_head_x_;
    lin->value[12] = -a_coupler2_theta_*span_coupler2_head_x_
        + (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_y_
        - coupler2_omega_*span_coupler2_head_x_*p->two_alpha_;
    lin->value[13] = -a_crank1_theta_*span_crank1_head_x_ + (crank1_omega_ * crank1_omega_)*span_crank1_head_y_
        - crank1_omega_*span_crank1_head_x_*p->two_alpha_;
    lin->value[14] = a_crank2_theta_*span_crank2_head_x_ - (crank2_omega_ * crank2_omega_)*span_crank2_head_y_
        + crank2_omega_*span_crank2_head_x_*p->two_alpha_;
    lin->value[15] = -a_coupler2_theta_*span_coupler2_head_y_
        - (coupler2_omega_ * coupler2_omega_)*span_coupler2_head_x_
        - coupler2_omega_*span_coupler2_head_y_*p->two_alpha_;
    lin->value[16] = -a_crank1_theta_*span_crank1_head_y_ - (crank1_omega_ * crank1_omega_)*span_crank1_head_x_
        - crank1_omega_*span_crank1_head_y_*p->two_alpha_;
    lin->value[17] = a_crank2_theta_*span_crank2_head_y_ + (crank2_omega_ * crank2_omega_)*span_crank2_head_x_
        + crank2_omega_*span_crank2_head_y_*p->two_alpha_;
    lin->value[18] = -a_coupler1_theta_*span_coupler1_head_x_
        + (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_y_
        - coupler1_omega_*span_coupler1_head_x_*p->two_alpha_;
    lin->value[19] = -a_crank0_theta_*span_crank0_head_x_ + (crank0_omega_ * crank0_omega_)*span_crank0_head_y_
        - crank0_omega_*span_crank0_head_x_*p->two_alpha_;
    lin->value[20] = -a_coupler1_theta_*span_coupler1_head_y_
        - (coupler1_omega_ * coupler1_omega_)*span_coupler1_head_x_
        - coupler1_omega_*span_coupler1_head_y_*p->two_alpha_;
    lin->value[21] = -a_crank0_theta_*span_crank0_head_y_ - (crank0_omega_ * crank0_omega_)*span_crank0_head_x_
        - crank0_omega_*span_crank0_head_y_*p->two_alpha_;
    lin->value[22] = a_coupler1_theta_*cross_crank0_coupler1_
        + (coupler1_omega_ * coupler1_omega_)*dot_crank0_coupler1_ - held_lambda_B1_x_*span_crank0_head_x_
        - held_lambda_B1_y_*span_crank0_head_y_ + sin_theta_crank0_*p->weight_crank0_across_;
    lin->value[23] = -a_coupler1_theta_*cross_crank0_coupler1_
        - (coupler1_omega_ * coupler1_omega_)*dot_crank0_coupler1_;
    lin->value[24] = a_coupler2_theta_*cross_crank1_coupler2_
        + (coupler2_omega_ * coupler2_omega_)*dot_crank1_coupler2_ + sin_theta_crank1_*p->weight_crank1_across_
        + span_crank1_head_x_*(held_lambda_B1_x_ - held_lambda_B2_x_)
        - span_crank1_head_y_*(-held_lambda_B1_y_ + held_lambda_B2_y_);
    lin->value[25] = -a_coupler2_theta_*cross_crank1_coupler2_
        - (coupler2_omega_ * coupler2_omega_)*dot_crank1_coupler2_;
    lin->value[26] = held_lambda_B2_x_*span_crank2_head_x_ + held_lambda_B2_y_*span_crank2_head_y_
        + sin_theta_crank2_*p->weight_crank2_across_;
    lin->value[27] = -a_crank0_theta_*cross_crank0_coupler1_ + (crank0_omega_ * crank0_omega_)*dot_crank0_coupler1_
        - held_lambda_B1_x_*span_coupler1_head_x_ - held_lambda_B1_y_*span_coupler1_head_y_
        + sin_theta_coupler1_*p->weight_coupler1_across_;
    lin->value[28] = a_crank0_theta_*cross_crank0_coupler1_ - (crank0_omega_ * crank0_omega_)*dot_crank0_coupler1_;
    lin->value[29] = -a_crank1_theta_*cross_crank1_coupler2_ + (crank1_omega_ * crank1_omega_)*dot_crank1_coupler2_
        - held_lambda_B2_x_*span_coupler2_head_x_ - held_lambda_B2_y_*span_coupler2_head_y_
        + sin_theta_coupler2_*p->weight_coupler2_across_;
    lin->value[30] = a_crank1_theta_*cross_crank1_coupler2_ - (crank1_omega_ * crank1_omega_)*dot_crank1_coupler2_;
    lin->value[31] = -2.0*coupler2_omega_*span_coupler2_head_x_;
    lin->value[32] = -2.0*crank1_omega_*span_crank1_head_x_;
    lin->value[33] = 2.0*crank2_omega_*span_crank2_head_x_;
    lin->value[34] = -2.0*coupler2_omega_*span_coupler2_head_y_;
    lin->value[35] = -2.0*crank1_omega_*span_crank1_head_y_;
    lin->value[36] = 2.0*crank2_omega_*span_crank2_head_y_;
    lin->value[37] = -2.0*coupler1_omega_*span_coupler1_head_x_;
    lin->value[38] = -2.0*crank0_omega_*span_crank0_head_x_;
    lin->value[39] = -2.0*coupler1_omega_*span_coupler1_head_y_;
    lin->value[40] = -2.0*crank0_omega_*span_crank0_head_y_;
    lin->value[41] = -2.0*coupler1_omega_*cross_crank0_coupler1_;
    lin->value[42] = -2.0*coupler2_omega_*cross_crank1_coupler2_;
    lin->value[43] = 2.0*crank0_omega_*cross_crank0_coupler1_;
    lin->value[44] = 2.0*crank1_omega_*cross_crank1_coupler2_;
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
    const Lanes mass_crank0_theta_coupler1_theta_ = lin->value[0];
    const Lanes mass_crank1_theta_coupler2_theta_ = lin->value[1];
    const Lanes phi_B2_x_crank1_theta_ = lin->value[2];
    const Lanes phi_B2_x_crank2_theta_ = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta_ = lin->value[4];
    const Lanes phi_B2_y_crank1_theta_ = lin->value[5];
    const Lanes phi_B2_y_crank2_theta_ = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta_ = lin->value[7];
    const Lanes phi_B1_x_crank0_theta_ = lin->value[8];
    const Lanes phi_B1_x_coupler1_theta_ = lin->value[9];
    const Lanes phi_B1_y_crank0_theta_ = lin->value[10];
    const Lanes phi_B1_y_coupler1_theta_ = lin->value[11];
    const Lanes by_q_B2_x_coupler2_theta_ = lin->value[12];
    const Lanes by_q_B2_x_crank1_theta_ = lin->value[13];
    const Lanes by_q_B2_x_crank2_theta_ = lin->value[14];
    const Lanes by_q_B2_y_coupler2_theta_ = lin->value[15];
    const Lanes by_q_B2_y_crank1_theta_ = lin->value[16];
    const Lanes by_q_B2_y_crank2_theta_ = lin->value[17];
    const Lanes by_q_B1_x_coupler1_theta_ = lin->value[18];
    const Lanes by_q_B1_x_crank0_theta_ = lin->value[19];
    const Lanes by_q_B1_y_coupler1_theta_ = lin->value[20];
    const Lanes by_q_B1_y_crank0_theta_ = lin->value[21];
    const Lanes by_q_crank0_theta_crank0_theta_ = lin->value[22];
    const Lanes by_q_crank0_theta_coupler1_theta_ = lin->value[23];
    const Lanes by_q_crank1_theta_crank1_theta_ = lin->value[24];
    const Lanes by_q_crank1_theta_coupler2_theta_ = lin->value[25];
    const Lanes by_q_crank2_theta_crank2_theta_ = lin->value[26];
    const Lanes by_q_coupler1_theta_coupler1_theta_ = lin->value[27];
    const Lanes by_q_coupler1_theta_crank0_theta_ = lin->value[28];
    const Lanes by_q_coupler2_theta_coupler2_theta_ = lin->value[29];
    const Lanes by_q_coupler2_theta_crank1_theta_ = lin->value[30];
    const Lanes by_v_B2_x_coupler2_theta_ = lin->value[31];
    const Lanes by_v_B2_x_crank1_theta_ = lin->value[32];
    const Lanes by_v_B2_x_crank2_theta_ = lin->value[33];
    const Lanes by_v_B2_y_coupler2_theta_ = lin->value[34];
    const Lanes by_v_B2_y_crank1_theta_ = lin->value[35];
    const Lanes by_v_B2_y_crank2_theta_ = lin->value[36];
    const Lanes by_v_B1_x_coupler1_theta_ = lin->value[37];
    const Lanes by_v_B1_x_crank0_theta_ = lin->value[38];
    const Lanes by_v_B1_y_coupler1_theta_ = lin->value[39];
    const Lanes by_v_B1_y_crank0_theta_ = lin->value[40];
    const Lanes by_v_crank0_theta_coupler1_theta_ = lin->value[41];
    const Lanes by_v_crank1_theta_coupler2_theta_ = lin->value[42];
    const Lanes by_v_coupler1_theta_crank0_theta_ = lin->value[43];
    const Lanes by_v_coupler2_theta_crank1_theta_ = lin->value[44];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_crank0_theta_crank0_theta_ = by_q_crank0_theta_crank0_theta_*(eta * eta) + p->mass_crank0_crank0_;
    const Lanes n_crank0_theta_coupler1_theta_ = eta*(by_q_crank0_theta_coupler1_theta_*eta
        + by_v_crank0_theta_coupler1_theta_) + mass_crank0_theta_coupler1_theta_;
    const Lanes n_crank1_theta_crank1_theta_ = by_q_crank1_theta_crank1_theta_*(eta * eta) + p->mass_crank1_crank1_;
    const Lanes n_crank1_theta_coupler2_theta_ = eta*(by_q_crank1_theta_coupler2_theta_*eta
        + by_v_crank1_theta_coupler2_theta_) + mass_crank1_theta_coupler2_theta_;
    const Lanes n_crank2_theta_crank2_theta_ = by_q_crank2_theta_crank2_theta_*(eta * eta) + p->mass_crank2_crank2_;
    const Lanes n_coupler1_theta_crank0_theta_ = eta*(by_q_coupler1_theta_crank0_theta_*eta
        + by_v_coupler1_theta_crank0_theta_) + mass_crank0_theta_coupler1_theta_;
    const Lanes n_coupler1_theta_coupler1_theta_ = by_q_coupler1_theta_coupler1_theta_*(eta * eta)
        + p->mass_coupler1_coupler1_;
    const Lanes n_coupler2_theta_crank1_theta_ = eta*(by_q_coupler2_theta_crank1_theta_*eta
        + by_v_coupler2_theta_crank1_theta_) + mass_crank1_theta_coupler2_theta_;
    const Lanes n_coupler2_theta_coupler2_theta_ = by_q_coupler2_theta_coupler2_theta_*(eta * eta)
        + p->mass_coupler2_coupler2_;
    const Lanes n_B2_x_crank1_theta_ = eta_row*(by_q_B2_x_crank1_theta_*eta + by_v_B2_x_crank1_theta_)
        + phi_B2_x_crank1_theta_;
    const Lanes n_B2_x_crank2_theta_ = eta_row*(by_q_B2_x_crank2_theta_*eta + by_v_B2_x_crank2_theta_)
        + phi_B2_x_crank2_theta_;
    const Lanes n_B2_x_coupler2_theta_ = eta_row*(by_q_B2_x_coupler2_theta_*eta + by_v_B2_x_coupler2_theta_)
        + phi_B2_x_coupler2_theta_;
    const Lanes n_B2_y_crank1_theta_ = eta_row*(by_q_B2_y_crank1_theta_*eta + by_v_B2_y_crank1_theta_)
        + phi_B2_y_crank1_theta_;
    const Lanes n_B2_y_crank2_theta_ = eta_row*(by_q_B2_y_crank2_theta_*eta + by_v_B2_y_crank2_theta_)
        + phi_B2_y_crank2_theta_;
    const Lanes n_B2_y_coupler2_theta_ = eta_row*(by_q_B2_y_coupler2_theta_*eta + by_v_B2_y_coupler2_theta_)
        + phi_B2_y_coupler2_theta_;
    const Lanes n_B1_x_crank0_theta_ = eta_row*(by_q_B1_x_crank0_theta_*eta + by_v_B1_x_crank0_theta_)
        + phi_B1_x_crank0_theta_;
    const Lanes n_B1_x_crank1_theta_ = eta_row*(-by_q_B2_x_crank1_theta_*eta - by_v_B2_x_crank1_theta_)
        - phi_B2_x_crank1_theta_;
    const Lanes n_B1_x_coupler1_theta_ = eta_row*(by_q_B1_x_coupler1_theta_*eta + by_v_B1_x_coupler1_theta_)
        + phi_B1_x_coupler1_theta_;
    const Lanes n_B1_y_crank0_theta_ = eta_row*(by_q_B1_y_crank0_theta_*eta + by_v_B1_y_crank0_theta_)
        + phi_B1_y_crank0_theta_;
    const Lanes n_B1_y_crank1_theta_ = eta_row*(-by_q_B2_y_crank1_theta_*eta - by_v_B2_y_crank1_theta_)
        - phi_B2_y_crank1_theta_;
    const Lanes n_B1_y_coupler1_theta_ = eta_row*(by_q_B1_y_coupler1_theta_*eta + by_v_B1_y_coupler1_theta_)
        + phi_B1_y_coupler1_theta_;

    /* L U */
    const Lanes scale_crank2_theta_ = n_crank2_theta_crank2_theta_;
    *rare |= ~(lanes_fabs(scale_crank2_theta_) > SINGULAR * lanes_fabs(n_crank2_theta_crank2_theta_));
    const Lanes inverse_pivot_crank2_theta_ = 1.0/scale_crank2_theta_;
    lin->lu[0] = inverse_pivot_crank2_theta_;
    const Lanes l_B2_x_crank2_theta_ = inverse_pivot_crank2_theta_*n_B2_x_crank2_theta_;
    lin->lu[1] = l_B2_x_crank2_theta_;
    const Lanes l_B2_y_crank2_theta_ = inverse_pivot_crank2_theta_*n_B2_y_crank2_theta_;
    lin->lu[2] = l_B2_y_crank2_theta_;
    const Lanes scale_crank0_theta_ = n_crank0_theta_crank0_theta_;
    *rare |= ~(lanes_fabs(scale_crank0_theta_) > SINGULAR * lanes_fabs(n_crank0_theta_crank0_theta_));
    const Lanes inverse_pivot_crank0_theta_ = 1.0/scale_crank0_theta_;
    lin->lu[3] = inverse_pivot_crank0_theta_;
    const Lanes l_coupler1_theta_crank0_theta_ = inverse_pivot_crank0_theta_*n_coupler1_theta_crank0_theta_;
    lin->lu[4] = l_coupler1_theta_crank0_theta_;
    lin->lu[5] = n_crank0_theta_coupler1_theta_;
    const Lanes l_B1_x_crank0_theta_ = inverse_pivot_crank0_theta_*n_B1_x_crank0_theta_;
    lin->lu[6] = l_B1_x_crank0_theta_;
    const Lanes l_B1_y_crank0_theta_ = inverse_pivot_crank0_theta_*n_B1_y_crank0_theta_;
    lin->lu[7] = l_B1_y_crank0_theta_;
    const Lanes scale_coupler1_theta_ = -l_coupler1_theta_crank0_theta_*n_crank0_theta_coupler1_theta_
        + n_coupler1_theta_coupler1_theta_;
    *rare |= ~(lanes_fabs(scale_coupler1_theta_) > SINGULAR * lanes_fabs(n_coupler1_theta_coupler1_theta_));
    const Lanes inverse_pivot_coupler1_theta_ = 1.0/scale_coupler1_theta_;
    lin->lu[8] = inverse_pivot_coupler1_theta_;
    const Lanes l_B1_x_coupler1_theta_ = inverse_pivot_coupler1_theta_
        *(-l_B1_x_crank0_theta_*n_crank0_theta_coupler1_theta_ + n_B1_x_coupler1_theta_);
    lin->lu[9] = l_B1_x_coupler1_theta_;
    const Lanes u_coupler1_theta_B1_x_ = -l_coupler1_theta_crank0_theta_*phi_B1_x_crank0_theta_
        + phi_B1_x_coupler1_theta_;
    lin->lu[10] = u_coupler1_theta_B1_x_;
    const Lanes l_B1_y_coupler1_theta_ = inverse_pivot_coupler1_theta_
        *(-l_B1_y_crank0_theta_*n_crank0_theta_coupler1_theta_ + n_B1_y_coupler1_theta_);
    lin->lu[11] = l_B1_y_coupler1_theta_;
    const Lanes u_coupler1_theta_B1_y_ = -l_coupler1_theta_crank0_theta_*phi_B1_y_crank0_theta_
        + phi_B1_y_coupler1_theta_;
    lin->lu[12] = u_coupler1_theta_B1_y_;
    const Lanes scale_coupler2_theta_ = n_coupler2_theta_coupler2_theta_;
    *rare |= ~(lanes_fabs(scale_coupler2_theta_) > SINGULAR * lanes_fabs(n_coupler2_theta_coupler2_theta_));
    const Lanes inverse_pivot_coupler2_theta_ = 1.0/scale_coupler2_theta_;
    lin->lu[13] = inverse_pivot_coupler2_theta_;
    const Lanes l_crank1_theta_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_crank1_theta_coupler2_theta_;
    lin->lu[14] = l_crank1_theta_coupler2_theta_;
    lin->lu[15] = n_coupler2_theta_crank1_theta_;
    const Lanes l_B2_x_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_B2_x_coupler2_theta_;
    lin->lu[16] = l_B2_x_coupler2_theta_;
    const Lanes l_B2_y_coupler2_theta_ = inverse_pivot_coupler2_theta_*n_B2_y_coupler2_theta_;
    lin->lu[17] = l_B2_y_coupler2_theta_;
    const Lanes scale_crank1_theta_ = -l_crank1_theta_coupler2_theta_*n_coupler2_theta_crank1_theta_
        + n_crank1_theta_crank1_theta_;
    *rare |= ~(lanes_fabs(scale_crank1_theta_) > SINGULAR * lanes_fabs(n_crank1_theta_crank1_theta_));
    const Lanes inverse_pivot_crank1_theta_ = 1.0/scale_crank1_theta_;
    lin->lu[18] = inverse_pivot_crank1_theta_;
    const Lanes l_B2_x_crank1_theta_ = inverse_pivot_crank1_theta_
        *(-l_B2_x_coupler2_theta_*n_coupler2_theta_crank1_theta_ + n_B2_x_crank1_theta_);
    lin->lu[19] = l_B2_x_crank1_theta_;
    const Lanes u_crank1_theta_B2_x_ = -l_crank1_theta_coupler2_theta_*phi_B2_x_coupler2_theta_
        + phi_B2_x_crank1_theta_;
    lin->lu[20] = u_crank1_theta_B2_x_;
    const Lanes l_B2_y_crank1_theta_ = inverse_pivot_crank1_theta_
        *(-l_B2_y_coupler2_theta_*n_coupler2_theta_crank1_theta_ + n_B2_y_crank1_theta_);
    lin->lu[21] = l_B2_y_crank1_theta_;
    const Lanes u_crank1_theta_B2_y_ = -l_crank1_theta_coupler2_theta_*phi_B2_y_coupler2_theta_
        + phi_B2_y_crank1_theta_;
    lin->lu[22] = u_crank1_theta_B2_y_;
    const Lanes l_B1_x_crank1_theta_ = inverse_pivot_crank1_theta_*n_B1_x_crank1_theta_;
    lin->lu[23] = l_B1_x_crank1_theta_;
    const Lanes l_B1_y_crank1_theta_ = inverse_pivot_crank1_theta_*n_B1_y_crank1_theta_;
    lin->lu[24] = l_B1_y_crank1_theta_;
    const Lanes scale_B2_x_ = -l_B2_x_coupler2_theta_*phi_B2_x_coupler2_theta_
        - l_B2_x_crank1_theta_*u_crank1_theta_B2_x_ - l_B2_x_crank2_theta_*phi_B2_x_crank2_theta_;
    *rare |= ~((lanes_fabs(scale_B2_x_) > 0.0) & (lanes_fabs(scale_B2_x_) < INFINITY));
    const Lanes inverse_pivot_B2_x_ = 1.0/scale_B2_x_;
    lin->lu[25] = inverse_pivot_B2_x_;
    const Lanes l_B2_y_B2_x_ = inverse_pivot_B2_x_*(-l_B2_y_coupler2_theta_*phi_B2_x_coupler2_theta_
        - l_B2_y_crank1_theta_*u_crank1_theta_B2_x_ - l_B2_y_crank2_theta_*phi_B2_x_crank2_theta_);
    lin->lu[26] = l_B2_y_B2_x_;
    const Lanes u_B2_x_B2_y_ = -l_B2_x_coupler2_theta_*phi_B2_y_coupler2_theta_
        - l_B2_x_crank1_theta_*u_crank1_theta_B2_y_ - l_B2_x_crank2_theta_*phi_B2_y_crank2_theta_;
    lin->lu[27] = u_B2_x_B2_y_;
    const Lanes l_B1_x_B2_x_ = -inverse_pivot_B2_x_*l_B1_x_crank1_theta_*u_crank1_theta_B2_x_;
    lin->lu[28] = l_B1_x_B2_x_;
    const Lanes u_B2_x_B1_x_ = l_B2_x_crank1_theta_*phi_B2_x_crank1_theta_;
    lin->lu[29] = u_B2_x_B1_x_;
    const Lanes l_B1_y_B2_x_ = -inverse_pivot_B2_x_*l_B1_y_crank1_theta_*u_crank1_theta_B2_x_;
    lin->lu[30] = l_B1_y_B2_x_;
    const Lanes u_B2_x_B1_y_ = l_B2_x_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[31] = u_B2_x_B1_y_;
    const Lanes scale_B2_y_ = -l_B2_y_coupler2_theta_*phi_B2_y_coupler2_theta_
        - l_B2_y_crank1_theta_*u_crank1_theta_B2_y_ - l_B2_y_crank2_theta_*phi_B2_y_crank2_theta_;
    const Lanes pivot_B2_y_ = -l_B2_y_B2_x_*u_B2_x_B2_y_ + scale_B2_y_;
    *rare |= ~(lanes_fabs(pivot_B2_y_) > SINGULAR * lanes_fabs(scale_B2_y_));
    const Lanes inverse_pivot_B2_y_ = 1.0/pivot_B2_y_;
    lin->lu[32] = inverse_pivot_B2_y_;
    const Lanes l_B1_x_B2_y_ = inverse_pivot_B2_y_*(-l_B1_x_B2_x_*u_B2_x_B2_y_
        - l_B1_x_crank1_theta_*u_crank1_theta_B2_y_);
    lin->lu[33] = l_B1_x_B2_y_;
    const Lanes u_B2_y_B1_x_ = -l_B2_y_B2_x_*u_B2_x_B1_x_ + l_B2_y_crank1_theta_*phi_B2_x_crank1_theta_;
    lin->lu[34] = u_B2_y_B1_x_;
    const Lanes l_B1_y_B2_y_ = inverse_pivot_B2_y_*(-l_B1_y_B2_x_*u_B2_x_B2_y_
        - l_B1_y_crank1_theta_*u_crank1_theta_B2_y_);
    lin->lu[35] = l_B1_y_B2_y_;
    const Lanes u_B2_y_B1_y_ = -l_B2_y_B2_x_*u_B2_x_B1_y_ + l_B2_y_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[36] = u_B2_y_B1_y_;
    const Lanes scale_B1_x_ = -l_B1_x_coupler1_theta_*u_coupler1_theta_B1_x_
        - l_B1_x_crank0_theta_*phi_B1_x_crank0_theta_ + l_B1_x_crank1_theta_*phi_B2_x_crank1_theta_;
    const Lanes pivot_B1_x_ = -l_B1_x_B2_x_*u_B2_x_B1_x_ - l_B1_x_B2_y_*u_B2_y_B1_x_ + scale_B1_x_;
    *rare |= ~(lanes_fabs(pivot_B1_x_) > SINGULAR * lanes_fabs(scale_B1_x_));
    const Lanes inverse_pivot_B1_x_ = 1.0/pivot_B1_x_;
    lin->lu[37] = inverse_pivot_B1_x_;
    const Lanes l_B1_y_B1_x_ = inverse_pivot_B1_x_*(-l_B1_y_B2_x_*u_B2_x_B1_x_ - l_B1_y_B2_y_*u_B2_y_B1_x_
        - l_B1_y_coupler1_theta_*u_coupler1_theta_B1_x_ - l_B1_y_crank0_theta_*phi_B1_x_crank0_theta_
        + l_B1_y_crank1_theta_*phi_B2_x_crank1_theta_);
    lin->lu[38] = l_B1_y_B1_x_;
    const Lanes u_B1_x_B1_y_ = -l_B1_x_B2_x_*u_B2_x_B1_y_ - l_B1_x_B2_y_*u_B2_y_B1_y_
        - l_B1_x_coupler1_theta_*u_coupler1_theta_B1_y_ - l_B1_x_crank0_theta_*phi_B1_y_crank0_theta_
        + l_B1_x_crank1_theta_*phi_B2_y_crank1_theta_;
    lin->lu[39] = u_B1_x_B1_y_;
    const Lanes scale_B1_y_ = -l_B1_y_coupler1_theta_*u_coupler1_theta_B1_y_
        - l_B1_y_crank0_theta_*phi_B1_y_crank0_theta_ + l_B1_y_crank1_theta_*phi_B2_y_crank1_theta_;
    const Lanes pivot_B1_y_ = -l_B1_y_B1_x_*u_B1_x_B1_y_ - l_B1_y_B2_x_*u_B2_x_B1_y_ - l_B1_y_B2_y_*u_B2_y_B1_y_
        + scale_B1_y_;
    *rare |= ~(lanes_fabs(pivot_B1_y_) > SINGULAR * lanes_fabs(scale_B1_y_));
    const Lanes inverse_pivot_B1_y_ = 1.0/pivot_B1_y_;
    lin->lu[40] = inverse_pivot_B1_y_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_B2_x_crank1_theta_ = lin->value[2];
    const Lanes phi_B2_x_crank2_theta_ = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta_ = lin->value[4];
    const Lanes phi_B2_y_crank1_theta_ = lin->value[5];
    const Lanes phi_B2_y_crank2_theta_ = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta_ = lin->value[7];
    const Lanes phi_B1_x_crank0_theta_ = lin->value[8];
    const Lanes phi_B1_y_crank0_theta_ = lin->value[10];
    const Lanes inverse_pivot_crank2_theta_ = lin->lu[0];
    const Lanes l_B2_x_crank2_theta_ = lin->lu[1];
    const Lanes l_B2_y_crank2_theta_ = lin->lu[2];
    const Lanes inverse_pivot_crank0_theta_ = lin->lu[3];
    const Lanes l_coupler1_theta_crank0_theta_ = lin->lu[4];
    const Lanes n_crank0_theta_coupler1_theta_ = lin->lu[5];
    const Lanes l_B1_x_crank0_theta_ = lin->lu[6];
    const Lanes l_B1_y_crank0_theta_ = lin->lu[7];
    const Lanes inverse_pivot_coupler1_theta_ = lin->lu[8];
    const Lanes l_B1_x_coupler1_theta_ = lin->lu[9];
    const Lanes u_coupler1_theta_B1_x_ = lin->lu[10];
    const Lanes l_B1_y_coupler1_theta_ = lin->lu[11];
    const Lanes u_coupler1_theta_B1_y_ = lin->lu[12];
    const Lanes inverse_pivot_coupler2_theta_ = lin->lu[13];
    const Lanes l_crank1_theta_coupler2_theta_ = lin->lu[14];
    const Lanes n_coupler2_theta_crank1_theta_ = lin->lu[15];
    const Lanes l_B2_x_coupler2_theta_ = lin->lu[16];
    const Lanes l_B2_y_coupler2_theta_ = lin->lu[17];
    const Lanes inverse_pivot_crank1_theta_ = lin->lu[18];
    const Lanes l_B2_x_crank1_theta_ = lin->lu[19];
    const Lanes u_crank1_theta_B2_x_ = lin->lu[20];
    const Lanes l_B2_y_crank1_theta_ = lin->lu[21];
    const Lanes u_crank1_theta_B2_y_ = lin->lu[22];
    const Lanes l_B1_x_crank1_theta_ = lin->lu[23];
    const Lanes l_B1_y_crank1_theta_ = lin->lu[24];
    const Lanes inverse_pivot_B2_x_ = lin->lu[25];
    const Lanes l_B2_y_B2_x_ = lin->lu[26];
    const Lanes u_B2_x_B2_y_ = lin->lu[27];
    const Lanes l_B1_x_B2_x_ = lin->lu[28];
    const Lanes u_B2_x_B1_x_ = lin->lu[29];
    const Lanes l_B1_y_B2_x_ = lin->lu[30];
    const Lanes u_B2_x_B1_y_ = lin->lu[31];
    const Lanes inverse_pivot_B2_y_ = lin->lu[32];
    const Lanes l_B1_x_B2_y_ = lin->lu[33];
    const Lanes u_B2_y_B1_x_ = lin->lu[34];
    const Lanes l_B1_y_B2_y_ = lin->lu[35];
    const Lanes u_B2_y_B1_y_ = lin->lu[36];
    const Lanes inverse_pivot_B1_x_ = lin->lu[37];
    const Lanes l_B1_y_B1_x_ = lin->lu[38];
    const Lanes u_B1_x_B1_y_ = lin->lu[39];
    const Lanes inverse_pivot_B1_y_ = lin->lu[40];

    /* forward */
    const Lanes b_crank2_theta_ = x[2];
    const Lanes b_crank0_theta_ = x[0];
    const Lanes b_coupler1_theta_ = -b_crank0_theta_*l_coupler1_theta_crank0_theta_ + x[3];
    const Lanes b_coupler2_theta_ = x[4];
    const Lanes b_crank1_theta_ = -b_coupler2_theta_*l_crank1_theta_coupler2_theta_ + x[1];
    const Lanes b_B2_x_ = -b_coupler2_theta_*l_B2_x_coupler2_theta_ - b_crank1_theta_*l_B2_x_crank1_theta_
        - b_crank2_theta_*l_B2_x_crank2_theta_ + x[5];
    const Lanes b_B2_y_ = -b_B2_x_*l_B2_y_B2_x_ - b_coupler2_theta_*l_B2_y_coupler2_theta_
        - b_crank1_theta_*l_B2_y_crank1_theta_ - b_crank2_theta_*l_B2_y_crank2_theta_ + x[6];
    const Lanes b_B1_x_ = -b_B2_x_*l_B1_x_B2_x_ - b_B2_y_*l_B1_x_B2_y_ - b_coupler1_theta_*l_B1_x_coupler1_theta_
        - b_crank0_theta_*l_B1_x_crank0_theta_ - b_crank1_theta_*l_B1_x_crank1_theta_ + x[7];
    const Lanes b_B1_y_ = -b_B1_x_*l_B1_y_B1_x_ - b_B2_x_*l_B1_y_B2_x_ - b_B2_y_*l_B1_y_B2_y_
        - b_coupler1_theta_*l_B1_y_coupler1_theta_ - b_crank0_theta_*l_B1_y_crank0_theta_
        - b_crank1_theta_*l_B1_y_crank1_theta_ + x[8];

    /* backward */
    const Lanes x_B1_y_ = b_B1_y_*inverse_pivot_B1_y_;
    x[8] = x_B1_y_;
    const Lanes x_B1_x_ = inverse_pivot_B1_x_*(b_B1_x_ - u_B1_x_B1_y_*x_B1_y_);
    x[7] = x_B1_x_;
    const Lanes x_B2_y_ = inverse_pivot_B2_y_*(b_B2_y_ - u_B2_y_B1_x_*x_B1_x_ - u_B2_y_B1_y_*x_B1_y_);
    x[6] = x_B2_y_;
    const Lanes x_B2_x_ = inverse_pivot_B2_x_*(b_B2_x_ - u_B2_x_B1_x_*x_B1_x_ - u_B2_x_B1_y_*x_B1_y_
        - u_B2_x_B2_y_*x_B2_y_);
    x[5] = x_B2_x_;
    const Lanes x_crank1_theta_ = inverse_pivot_crank1_theta_*(b_crank1_theta_ + phi_B2_x_crank1_theta_*x_B1_x_
        + phi_B2_y_crank1_theta_*x_B1_y_ - u_crank1_theta_B2_x_*x_B2_x_ - u_crank1_theta_B2_y_*x_B2_y_);
    x[1] = x_crank1_theta_;
    const Lanes x_coupler2_theta_ = inverse_pivot_coupler2_theta_*(b_coupler2_theta_
        - n_coupler2_theta_crank1_theta_*x_crank1_theta_ - phi_B2_x_coupler2_theta_*x_B2_x_
        - phi_B2_y_coupler2_theta_*x_B2_y_);
    x[4] = x_coupler2_theta_;
    const Lanes x_coupler1_theta_ = inverse_pivot_coupler1_theta_*(b_coupler1_theta_ - u_coupler1_theta_B1_x_*x_B1_x_
        - u_coupler1_theta_B1_y_*x_B1_y_);
    x[3] = x_coupler1_theta_;
    const Lanes x_crank0_theta_ = inverse_pivot_crank0_theta_*(b_crank0_theta_
        - n_crank0_theta_coupler1_theta_*x_coupler1_theta_ - phi_B1_x_crank0_theta_*x_B1_x_
        - phi_B1_y_crank0_theta_*x_B1_y_);
    x[0] = x_crank0_theta_;
    const Lanes x_crank2_theta_ = inverse_pivot_crank2_theta_*(b_crank2_theta_ - phi_B2_x_crank2_theta_*x_B2_x_
        - phi_B2_y_crank2_theta_*x_B2_y_);
    x[2] = x_crank2_theta_;
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
    const Lanes mass_crank0_theta_coupler1_theta_ = lin->value[0];
    const Lanes mass_crank1_theta_coupler2_theta_ = lin->value[1];
    const Lanes phi_B2_x_crank1_theta_ = lin->value[2];
    const Lanes phi_B2_x_crank2_theta_ = lin->value[3];
    const Lanes phi_B2_x_coupler2_theta_ = lin->value[4];
    const Lanes phi_B2_y_crank1_theta_ = lin->value[5];
    const Lanes phi_B2_y_crank2_theta_ = lin->value[6];
    const Lanes phi_B2_y_coupler2_theta_ = lin->value[7];
    const Lanes phi_B1_x_crank0_theta_ = lin->value[8];
    const Lanes phi_B1_x_coupler1_theta_ = lin->value[9];
    const Lanes phi_B1_y_crank0_theta_ = lin->value[10];
    const Lanes phi_B1_y_coupler1_theta_ = lin->value[11];
    const Lanes by_q_B2_x_coupler2_theta_ = lin->value[12];
    const Lanes by_q_B2_x_crank1_theta_ = lin->value[13];
    const Lanes by_q_B2_x_crank2_theta_ = lin->value[14];
    const Lanes by_q_B2_y_coupler2_theta_ = lin->value[15];
    const Lanes by_q_B2_y_crank1_theta_ = lin->value[16];
    const Lanes by_q_B2_y_crank2_theta_ = lin->value[17];
    const Lanes by_q_B1_x_coupler1_theta_ = lin->value[18];
    const Lanes by_q_B1_x_crank0_theta_ = lin->value[19];
    const Lanes by_q_B1_y_coupler1_theta_ = lin->value[20];
    const Lanes by_q_B1_y_crank0_theta_ = lin->value[21];
    const Lanes by_q_crank0_theta_crank0_theta_ = lin->value[22];
    const Lanes by_q_crank0_theta_coupler1_theta_ = lin->value[23];
    const Lanes by_q_crank1_theta_crank1_theta_ = lin->value[24];
    const Lanes by_q_crank1_theta_coupler2_theta_ = lin->value[25];
    const Lanes by_q_crank2_theta_crank2_theta_ = lin->value[26];
    const Lanes by_q_coupler1_theta_coupler1_theta_ = lin->value[27];
    const Lanes by_q_coupler1_theta_crank0_theta_ = lin->value[28];
    const Lanes by_q_coupler2_theta_coupler2_theta_ = lin->value[29];
    const Lanes by_q_coupler2_theta_crank1_theta_ = lin->value[30];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[9];
    const Lanes shifted_crank0_theta_ = -p->beta_squared_*eta*r[0] + r[5];
    const Lanes shifted_crank1_theta_ = -p->beta_squared_*eta*r[1] + r[6];
    const Lanes shifted_crank2_theta_ = -p->beta_squared_*eta*r[2] + r[7];
    const Lanes shifted_coupler1_theta_ = -p->beta_squared_*eta*r[3] + r[8];
    const Lanes shifted_coupler2_theta_ = -p->beta_squared_*eta*r[4] + r[9];
    x[0] = eta*(-by_q_crank0_theta_coupler1_theta_*eta*r[3] - by_q_crank0_theta_crank0_theta_*eta*r[0]
        + p->mass_crank0_crank0_*r[5] + mass_crank0_theta_coupler1_theta_*r[8]);
    x[1] = eta*(-by_q_crank1_theta_coupler2_theta_*eta*r[4] - by_q_crank1_theta_crank1_theta_*eta*r[1]
        + p->mass_crank1_crank1_*r[6] + mass_crank1_theta_coupler2_theta_*r[9]);
    x[2] = eta*(-by_q_crank2_theta_crank2_theta_*eta*r[2] + p->mass_crank2_crank2_*r[7]);
    x[3] = eta*(-by_q_coupler1_theta_coupler1_theta_*eta*r[3] - by_q_coupler1_theta_crank0_theta_*eta*r[0]
        + p->mass_coupler1_coupler1_*r[8] + mass_crank0_theta_coupler1_theta_*r[5]);
    x[4] = eta*(-by_q_coupler2_theta_coupler2_theta_*eta*r[4] - by_q_coupler2_theta_crank1_theta_*eta*r[1]
        + p->mass_coupler2_coupler2_*r[9] + mass_crank1_theta_coupler2_theta_*r[6]);
    x[5] = eta_row*(-by_q_B2_x_coupler2_theta_*eta*r[4] - by_q_B2_x_crank1_theta_*eta*r[1]
        - by_q_B2_x_crank2_theta_*eta*r[2] + phi_B2_x_coupler2_theta_*shifted_coupler2_theta_
        + phi_B2_x_crank1_theta_*shifted_crank1_theta_ + phi_B2_x_crank2_theta_*shifted_crank2_theta_);
    x[6] = eta_row*(-by_q_B2_y_coupler2_theta_*eta*r[4] - by_q_B2_y_crank1_theta_*eta*r[1]
        - by_q_B2_y_crank2_theta_*eta*r[2] + phi_B2_y_coupler2_theta_*shifted_coupler2_theta_
        + phi_B2_y_crank1_theta_*shifted_crank1_theta_ + phi_B2_y_crank2_theta_*shifted_crank2_theta_);
    x[7] = eta_row*(-by_q_B1_x_coupler1_theta_*eta*r[3] - by_q_B1_x_crank0_theta_*eta*r[0]
        + by_q_B2_x_crank1_theta_*eta*r[1] + phi_B1_x_coupler1_theta_*shifted_coupler1_theta_
        + phi_B1_x_crank0_theta_*shifted_crank0_theta_ - phi_B2_x_crank1_theta_*shifted_crank1_theta_);
    x[8] = eta_row*(-by_q_B1_y_coupler1_theta_*eta*r[3] - by_q_B1_y_crank0_theta_*eta*r[0]
        + by_q_B2_y_crank1_theta_*eta*r[1] + phi_B1_y_coupler1_theta_*shifted_coupler1_theta_
        + phi_B1_y_crank0_theta_*shifted_crank0_theta_ - phi_B2_y_crank1_theta_*shifted_crank1_theta_);
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
