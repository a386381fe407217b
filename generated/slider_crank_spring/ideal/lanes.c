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
    Lanes crank_mass_;
    Lanes crank_inertia_;
    Lanes rod_mass_;
    Lanes rod_inertia_;
    Lanes crank_length_;
    Lanes crank_points_middle_x_;
    Lanes rod_points_crankpin_x_;
    Lanes rod_points_middle_x_;
    Lanes rod_points_tip_x_;
    Lanes alpha_;
    Lanes beta_;
    Lanes slider_direction_x_;
    Lanes coil_stiffness_;
    Lanes coil_free_length_;
    Lanes coil_damping_;
    Lanes push_value_x_;
    Lanes guess_rod_theta_;
    Lanes guess_rod_x_;
    Lanes set_crank_theta_;
    Lanes rates_crank_omega_;
    Lanes crank_turning_;
    Lanes rod_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes mobility_slider_offset_;
    Lanes rod_com_span_x_;
    Lanes rod_middle_span_x_;
    Lanes rod_tip_span_x_;
    Lanes inertia_crank_crank_;
    Lanes inertia_crank_rod_;
    Lanes inertia_rod_rod_;
    Lanes mass_crank_crank_;
    Lanes mass_rod_rod_;
    Lanes inverse_mass_crank_crank_;
    Lanes tree_metric_crank_theta_;
    Lanes tree_metric_rod_theta_;
    Lanes inverse_tree_metric_crank_theta_;
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
    const Lanes crank_theta_ = q[0];
    const Lanes rod_theta_ = q[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta_, &sines_1, &cosines_1, rare);
    const Lanes sin_theta_crank_ = sines_0;
    const Lanes sin_theta_rod_ = sines_1;
    const Lanes span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const Lanes span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;

    /* rows */
    out[0] = span_crank_head_y_ + span_rod_com_y_;  /* slider.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank_theta_ = q[0];
    const Lanes crank_omega_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank_ = cosines_0;
    const Lanes cos_theta_rod_ = cosines_1;
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const Lanes span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;

    /* rows */
    out[0] = crank_omega_*span_crank_head_x_ + rod_omega_*span_rod_com_x_;  /* slider.offset */
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
    const Lanes crank_theta_ = q[0];
    const Lanes crank_omega_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank_ = cosines_0;
    const Lanes sin_theta_crank_ = sines_0;
    const Lanes cos_theta_rod_ = cosines_1;
    const Lanes sin_theta_rod_ = sines_1;
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const Lanes span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const Lanes crank_head_vx_ = -crank_omega_*span_crank_head_y_;
    const Lanes crank_head_vy_ = crank_omega_*span_crank_head_x_;
    const Lanes span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const Lanes span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const Lanes span_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const Lanes span_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const Lanes crank_middle_vx_ = -crank_omega_*span_crank_middle_y_;
    const Lanes crank_middle_vy_ = crank_omega_*span_crank_middle_x_;
    const Lanes span_rod_middle_x_ = cos_theta_rod_*p->rod_middle_span_x_;
    const Lanes span_rod_middle_y_ = p->rod_middle_span_x_*sin_theta_rod_;
    const Lanes rod_middle_x_ = span_crank_head_x_ + span_rod_middle_x_;
    const Lanes rod_middle_vx_ = crank_head_vx_ - rod_omega_*span_rod_middle_y_;
    const Lanes rod_middle_y_ = span_crank_head_y_ + span_rod_middle_y_;
    const Lanes rod_middle_vy_ = crank_head_vy_ + rod_omega_*span_rod_middle_x_;
    const Lanes coil_span_x_ = rod_middle_x_ - span_crank_middle_x_;
    const Lanes coil_span_y_ = rod_middle_y_ - span_crank_middle_y_;
    const Lanes coil_span_rate_x_ = -crank_middle_vx_ + rod_middle_vx_;
    const Lanes coil_span_rate_y_ = -crank_middle_vy_ + rod_middle_vy_;
    const Lanes coil_length_ = lanes_sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const Lanes coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const Lanes coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);
    const Lanes coil_pull_ = coil_force_/coil_length_;
    const Lanes span_rod_tip_y_ = p->rod_tip_span_x_*sin_theta_rod_;
    const Lanes rod_tip_vx_ = crank_head_vx_ - rod_omega_*span_rod_tip_y_;
    const Lanes cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const Lanes sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const Lanes dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const Lanes cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* constraints: gamma */
    const Lanes rhs_slider_offset_ = (crank_omega_ * crank_omega_)*span_crank_head_y_
        + (rod_omega_ * rod_omega_)*span_rod_com_y_;

    /* L D L^T of the KKT matrix */
    *rare |= ~(p->mass_crank_crank_ > LIGHT_PIVOT * p->crank_turning_);
    const Lanes l_rod_theta_crank_theta_ = dot_crank_rod_*p->inverse_mass_crank_crank_;
    const Lanes l_slider_offset_crank_theta_ = p->inverse_mass_crank_crank_*span_crank_head_x_;
    const Lanes pivot_rod_theta_ = -dot_crank_rod_*l_rod_theta_crank_theta_ + p->mass_rod_rod_;
    *rare |= ~(pivot_rod_theta_ > LIGHT_PIVOT * p->rod_turning_);
    const Lanes inverse_pivot_rod_theta_ = 1.0/pivot_rod_theta_;
    const Lanes w_slider_offset_rod_theta_ = -dot_crank_rod_*l_slider_offset_crank_theta_ + span_rod_com_x_;
    const Lanes l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_*w_slider_offset_rod_theta_;
    const Lanes scale_slider_offset_ = l_slider_offset_crank_theta_*span_crank_head_x_
        + l_slider_offset_rod_theta_*w_slider_offset_rod_theta_;
    *rare |= ~((scale_slider_offset_ > 0.0) & (scale_slider_offset_ < INFINITY));
    const Lanes inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;

    /* forward substitution */
    const Lanes z_crank_theta_ = -coil_pull_*coil_span_x_*span_crank_middle_y_
        - coil_pull_*coil_span_y_*span_crank_head_x_ + coil_pull_*coil_span_y_*span_crank_middle_x_
        + cross_crank_rod_*(rod_omega_ * rod_omega_) - span_crank_head_y_*(-coil_pull_*coil_span_x_ + p->push_value_x_);
    const Lanes z_rod_theta_ = coil_pull_*coil_span_x_*span_rod_middle_y_ - coil_pull_*coil_span_y_*span_rod_middle_x_
        - (crank_omega_ * crank_omega_)*cross_crank_rod_ - l_rod_theta_crank_theta_*z_crank_theta_
        - p->push_value_x_*span_rod_tip_y_;
    const Lanes z_slider_offset_ = -l_slider_offset_crank_theta_*z_crank_theta_
        - l_slider_offset_rod_theta_*z_rod_theta_ + rhs_slider_offset_;

    /* backward substitution */
    const Lanes lambda_slider_offset_ = -inverse_pivot_slider_offset_*z_slider_offset_;
    const Lanes acceleration_rod_theta_ = inverse_pivot_rod_theta_*z_rod_theta_
        - l_slider_offset_rod_theta_*lambda_slider_offset_;
    const Lanes acceleration_crank_theta_ = -acceleration_rod_theta_*l_rod_theta_crank_theta_
        + p->inverse_mass_crank_crank_*z_crank_theta_ - l_slider_offset_crank_theta_*lambda_slider_offset_;

    /* results */
    a[0] = acceleration_crank_theta_;
    a[1] = acceleration_rod_theta_;
    aside->lambda[0] = lambda_slider_offset_;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = all_of(0.0);
    aside->power[1] = -p->coil_damping_*(coil_length_rate_ * coil_length_rate_) + p->push_value_x_*rod_tip_vx_;
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
    const Lanes crank_theta_ = q[0];
    const Lanes crank_omega_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank_ = cosines_0;
    const Lanes sin_theta_crank_ = sines_0;
    const Lanes cos_theta_rod_ = cosines_1;
    const Lanes sin_theta_rod_ = sines_1;
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const Lanes span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const Lanes span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const Lanes span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const Lanes cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const Lanes dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;

    /* Phi and Phi_dot */
    const Lanes phi_slider_offset_ = span_crank_head_y_ + span_rod_com_y_;
    const Lanes phi_dot_slider_offset_ = crank_omega_*span_crank_head_x_ + rod_omega_*span_rod_com_x_;

    /* L D L^T of the KKT matrix */
    const Lanes l_rod_theta_crank_theta_ = dot_crank_rod_*p->inverse_tree_metric_crank_theta_;
    const Lanes l_slider_offset_crank_theta_ = p->inverse_tree_metric_crank_theta_*span_crank_head_x_;
    const Lanes inverse_pivot_rod_theta_ = 1.0/(-dot_crank_rod_*l_rod_theta_crank_theta_ + p->tree_metric_rod_theta_);
    const Lanes w_slider_offset_rod_theta_ = -dot_crank_rod_*l_slider_offset_crank_theta_ + span_rod_com_x_;
    const Lanes l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_*w_slider_offset_rod_theta_;
    const Lanes scale_slider_offset_ = l_slider_offset_crank_theta_*span_crank_head_x_
        + l_slider_offset_rod_theta_*w_slider_offset_rod_theta_;
    *rare |= ~((scale_slider_offset_ > 0.0) & (scale_slider_offset_ < INFINITY));
    const Lanes inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;

    /* backward substitution */
    const Lanes dq_lambda_slider_offset_ = -inverse_pivot_slider_offset_*phi_slider_offset_;
    const Lanes dq_acceleration_rod_theta_ = -dq_lambda_slider_offset_*l_slider_offset_rod_theta_;
    const Lanes dq_acceleration_crank_theta_ = -dq_acceleration_rod_theta_*l_rod_theta_crank_theta_
        - dq_lambda_slider_offset_*l_slider_offset_crank_theta_;

    /* backward substitution */
    const Lanes dv_lambda_slider_offset_ = -inverse_pivot_slider_offset_*phi_dot_slider_offset_;
    const Lanes dv_acceleration_rod_theta_ = -dv_lambda_slider_offset_*l_slider_offset_rod_theta_;
    const Lanes dv_acceleration_crank_theta_ = -dv_acceleration_rod_theta_*l_rod_theta_crank_theta_
        - dv_lambda_slider_offset_*l_slider_offset_crank_theta_;

    /* results */
    dq[0] = dq_acceleration_crank_theta_;
    dv[0] = dv_acceleration_crank_theta_;
    dq[1] = dq_acceleration_rod_theta_;
    dv[1] = dv_acceleration_rod_theta_;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_slider_offset_));
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
    const Lanes crank_theta_ = q[0];
    const Lanes crank_omega_ = v[0];
    const Lanes rod_theta_ = q[1];
    const Lanes rod_omega_ = v[1];
    const Lanes a_crank_theta_ = a[0];
    const Lanes a_rod_theta_ = a[1];
    const Lanes held_lambda_slider_offset_ = aside->lambda[0];

    /* directions, arms, drives */
    const Lanes cos_theta_crank_ = lanes_cos(crank_theta_);
    const Lanes sin_theta_crank_ = lanes_sin(crank_theta_);
    const Lanes cos_theta_rod_ = lanes_cos(rod_theta_);
    const Lanes sin_theta_rod_ = lanes_sin(rod_theta_);
    const Lanes span_crank_head_x_ = cos_theta_crank_*p->crank_length_;
    const Lanes span_crank_head_y_ = p->crank_length_*sin_theta_crank_;
    const Lanes crank_head_vx_ = -crank_omega_*span_crank_head_y_;
    const Lanes crank_head_vy_ = crank_omega_*span_crank_head_x_;
    const Lanes span_rod_com_x_ = cos_theta_rod_*p->rod_com_span_x_;
    const Lanes span_rod_com_y_ = p->rod_com_span_x_*sin_theta_rod_;
    const Lanes span_crank_middle_x_ = cos_theta_crank_*p->crank_points_middle_x_;
    const Lanes span_crank_middle_y_ = p->crank_points_middle_x_*sin_theta_crank_;
    const Lanes crank_middle_vx_ = -crank_omega_*span_crank_middle_y_;
    const Lanes crank_middle_vy_ = crank_omega_*span_crank_middle_x_;
    const Lanes span_rod_middle_x_ = cos_theta_rod_*p->rod_middle_span_x_;
    const Lanes span_rod_middle_y_ = p->rod_middle_span_x_*sin_theta_rod_;
    const Lanes rod_middle_x_ = span_crank_head_x_ + span_rod_middle_x_;
    const Lanes rod_middle_vx_ = crank_head_vx_ - rod_omega_*span_rod_middle_y_;
    const Lanes rod_middle_y_ = span_crank_head_y_ + span_rod_middle_y_;
    const Lanes rod_middle_vy_ = crank_head_vy_ + rod_omega_*span_rod_middle_x_;
    const Lanes coil_span_x_ = rod_middle_x_ - span_crank_middle_x_;
    const Lanes coil_span_y_ = rod_middle_y_ - span_crank_middle_y_;
    const Lanes coil_span_rate_x_ = -crank_middle_vx_ + rod_middle_vx_;
    const Lanes coil_span_rate_y_ = -crank_middle_vy_ + rod_middle_vy_;
    const Lanes coil_length_ = lanes_sqrt((coil_span_x_ * coil_span_x_) + (coil_span_y_ * coil_span_y_));
    const Lanes coil_length_rate_ = (coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)/coil_length_;
    const Lanes coil_force_ = p->coil_damping_*coil_length_rate_
        + p->coil_stiffness_*(-p->coil_free_length_ + coil_length_);
    const Lanes coil_pull_ = coil_force_/coil_length_;
    const Lanes span_rod_tip_x_ = cos_theta_rod_*p->rod_tip_span_x_;
    const Lanes span_rod_tip_y_ = p->rod_tip_span_x_*sin_theta_rod_;
    const Lanes cos_rod_less_crank_ = cos_theta_crank_*cos_theta_rod_ + sin_theta_crank_*sin_theta_rod_;
    const Lanes sin_rod_less_crank_ = cos_theta_crank_*sin_theta_rod_ - cos_theta_rod_*sin_theta_crank_;
    const Lanes dot_crank_rod_ = cos_rod_less_crank_*p->inertia_crank_rod_;
    const Lanes cross_crank_rod_ = p->inertia_crank_rod_*sin_rod_less_crank_;

    /* coordinates */
    const Lanes coil_span_x_by_crank_theta_ = -span_crank_head_y_ + span_crank_middle_y_;
    const Lanes coil_span_y_by_crank_theta_ = span_crank_head_x_ - span_crank_middle_x_;
    const Lanes inverse_sum_ = 1.0/(coil_length_ + 1e-150);
    const Lanes coil_length_by_crank_theta_ = coil_span_x_*coil_span_x_by_crank_theta_*inverse_sum_
        + coil_span_y_*coil_span_y_by_crank_theta_*inverse_sum_;
    const Lanes coil_length_by_rod_theta_ = -coil_span_x_*inverse_sum_*span_rod_middle_y_
        + coil_span_y_*inverse_sum_*span_rod_middle_x_;
    const Lanes crank_middle_vx_by_crank_theta_ = -crank_omega_*span_crank_middle_x_;
    const Lanes rod_middle_vx_by_crank_theta_ = -crank_omega_*span_crank_head_x_;
    const Lanes rod_middle_vx_by_rod_theta_ = -rod_omega_*span_rod_middle_x_;
    const Lanes coil_span_rate_x_by_crank_theta_ = -crank_middle_vx_by_crank_theta_ + rod_middle_vx_by_crank_theta_;
    const Lanes coil_span_rate_x_by_crank_omega_ = -span_crank_head_y_ + span_crank_middle_y_;
    const Lanes crank_middle_vy_by_crank_theta_ = -crank_omega_*span_crank_middle_y_;
    const Lanes rod_middle_vy_by_crank_theta_ = -crank_omega_*span_crank_head_y_;
    const Lanes rod_middle_vy_by_rod_theta_ = -rod_omega_*span_rod_middle_y_;
    const Lanes coil_span_rate_y_by_crank_theta_ = -crank_middle_vy_by_crank_theta_ + rod_middle_vy_by_crank_theta_;
    const Lanes coil_span_rate_y_by_crank_omega_ = span_crank_head_x_ - span_crank_middle_x_;
    const Lanes inverse_coil_length_ = 1.0/coil_length_;
    const Lanes coil_length_rate_by_crank_theta_ = -coil_length_by_crank_theta_*(inverse_coil_length_
        * inverse_coil_length_)*(coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)
        + coil_span_rate_x_*coil_span_x_by_crank_theta_*inverse_coil_length_
        + coil_span_rate_x_by_crank_theta_*coil_span_x_*inverse_coil_length_
        + coil_span_rate_y_*coil_span_y_by_crank_theta_*inverse_coil_length_
        + coil_span_rate_y_by_crank_theta_*coil_span_y_*inverse_coil_length_;
    const Lanes coil_length_rate_by_rod_theta_ = -coil_length_by_rod_theta_*(inverse_coil_length_
        * inverse_coil_length_)*(coil_span_rate_x_*coil_span_x_ + coil_span_rate_y_*coil_span_y_)
        - coil_span_rate_x_*inverse_coil_length_*span_rod_middle_y_
        + coil_span_rate_y_*inverse_coil_length_*span_rod_middle_x_
        + coil_span_x_*inverse_coil_length_*rod_middle_vx_by_rod_theta_
        + coil_span_y_*inverse_coil_length_*rod_middle_vy_by_rod_theta_;
    const Lanes coil_length_rate_by_crank_omega_ = coil_span_rate_x_by_crank_omega_*coil_span_x_*inverse_coil_length_
        + coil_span_rate_y_by_crank_omega_*coil_span_y_*inverse_coil_length_;
    const Lanes coil_length_rate_by_rod_omega_ = -coil_span_x_*inverse_coil_length_*span_rod_middle_y_
        + coil_span_y_*inverse_coil_length_*span_rod_middle_x_;
    const Lanes coil_force_by_crank_theta_ = p->coil_damping_*coil_length_rate_by_crank_theta_
        + coil_length_by_crank_theta_*p->coil_stiffness_;
    const Lanes coil_force_by_rod_theta_ = p->coil_damping_*coil_length_rate_by_rod_theta_
        + coil_length_by_rod_theta_*p->coil_stiffness_;
    const Lanes coil_force_by_crank_omega_ = p->coil_damping_*coil_length_rate_by_crank_omega_;
    const Lanes coil_force_by_rod_omega_ = p->coil_damping_*coil_length_rate_by_rod_omega_;
    const Lanes coil_pull_by_crank_theta_ = -coil_force_*coil_length_by_crank_theta_*(inverse_coil_length_
        * inverse_coil_length_) + coil_force_by_crank_theta_*inverse_coil_length_;
    const Lanes coil_pull_by_rod_theta_ = -coil_force_*coil_length_by_rod_theta_*(inverse_coil_length_
        * inverse_coil_length_) + coil_force_by_rod_theta_*inverse_coil_length_;
    const Lanes coil_pull_by_crank_omega_ = coil_force_by_crank_omega_*inverse_coil_length_;
    const Lanes coil_pull_by_rod_omega_ = coil_force_by_rod_omega_*inverse_coil_length_;

    /* powers */
    const Lanes rod_tip_vx_by_crank_theta_ = -crank_omega_*span_crank_head_x_;
    const Lanes rod_tip_vx_by_rod_theta_ = -rod_omega_*span_rod_tip_x_;

    /* results */
    lin->value[0] = dot_crank_rod_;
    lin->value[1] = span_crank_head_x_;
    lin->value[2] = span_rod_com_x_;
    lin->value[3] = -a_crank_theta_*span_crank_head_y_ - (crank_omega_ * crank_omega_)*span_crank_head_x_
        - crank_omega_*span_crank_head_y_*p->two_alpha_;
    lin->value[4] = -a_rod_theta_*span_rod_com_y_ - (rod_omega_ * rod_omega_)*span_rod_com_x_
        - rod_omega_*span_rod_com_y_*p->two_alpha_;
    lin->value[5] = a_rod_theta_*cross_crank_rod_ + coil_pull_*coil_span_x_*span_crank_middle_x_
        + coil_pull_*coil_span_y_*span_crank_middle_y_ + coil_pull_by_crank_theta_*(-coil_span_x_*span_crank_head_y_
        + coil_span_x_*span_crank_middle_y_ + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_)
        + coil_span_x_by_crank_theta_*(-coil_pull_*span_crank_head_y_ + coil_pull_*span_crank_middle_y_)
        + coil_span_y_by_crank_theta_*(coil_pull_*span_crank_head_x_ - coil_pull_*span_crank_middle_x_)
        + dot_crank_rod_*(rod_omega_ * rod_omega_) + span_crank_head_x_*(-coil_pull_*coil_span_x_ + p->push_value_x_)
        - span_crank_head_y_*(coil_pull_*coil_span_y_ + held_lambda_slider_offset_);
    lin->value[6] = -a_rod_theta_*cross_crank_rod_ + coil_pull_by_rod_theta_*(-coil_span_x_*span_crank_head_y_
        + coil_span_x_*span_crank_middle_y_ + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_)
        - dot_crank_rod_*(rod_omega_ * rod_omega_) + span_rod_middle_x_*(coil_pull_*span_crank_head_x_
        - coil_pull_*span_crank_middle_x_) - span_rod_middle_y_*(-coil_pull_*span_crank_head_y_
        + coil_pull_*span_crank_middle_y_);
    lin->value[7] = a_crank_theta_*cross_crank_rod_ - coil_pull_*coil_span_x_by_crank_theta_*span_rod_middle_y_
        + coil_pull_*coil_span_y_by_crank_theta_*span_rod_middle_x_
        + coil_pull_by_crank_theta_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        - (crank_omega_ * crank_omega_)*dot_crank_rod_;
    lin->value[8] = -a_crank_theta_*cross_crank_rod_ - coil_pull_*coil_span_x_*span_rod_middle_x_
        - coil_pull_*coil_span_y_*span_rod_middle_y_ + coil_pull_*(span_rod_middle_x_ * span_rod_middle_x_)
        + coil_pull_*(span_rod_middle_y_ * span_rod_middle_y_)
        + coil_pull_by_rod_theta_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        + (crank_omega_ * crank_omega_)*dot_crank_rod_ - held_lambda_slider_offset_*span_rod_com_y_
        + p->push_value_x_*span_rod_tip_x_;
    lin->value[9] = -2.0*crank_omega_*span_crank_head_y_;
    lin->value[10] = -2.0*rod_omega_*span_rod_com_y_;
    lin->value[11] = coil_pull_by_crank_omega_*(-coil_span_x_*span_crank_head_y_ + coil_span_x_*span_crank_middle_y_
        + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_);
    lin->value[12] = coil_pull_by_rod_omega_*(-coil_span_x_*span_crank_head_y_ + coil_span_x_*span_crank_middle_y_
        + coil_span_y_*span_crank_head_x_ - coil_span_y_*span_crank_middle_x_) - 2.0*cross_crank_rod_*rod_omega_;
    lin->value[13] = coil_pull_by_crank_omega_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_)
        + 2.0*crank_omega_*cross_crank_rod_;
    lin->value[14] = coil_pull_by_rod_omega_*(-coil_span_x_*span_rod_middle_y_ + coil_span_y_*span_rod_middle_x_);
    lin->value[15] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_crank_theta_
        + p->push_value_x_*rod_tip_vx_by_crank_theta_;
    lin->value[16] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_rod_theta_
        + p->push_value_x_*rod_tip_vx_by_rod_theta_;
    lin->value[17] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_crank_omega_
        - p->push_value_x_*span_crank_head_y_;
    lin->value[18] = -2.0*p->coil_damping_*coil_length_rate_*coil_length_rate_by_rod_omega_
        - p->push_value_x_*span_rod_tip_y_;
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
    const Lanes mass_crank_theta_rod_theta_ = lin->value[0];
    const Lanes phi_slider_offset_crank_theta_ = lin->value[1];
    const Lanes phi_slider_offset_rod_theta_ = lin->value[2];
    const Lanes by_q_slider_offset_crank_theta_ = lin->value[3];
    const Lanes by_q_slider_offset_rod_theta_ = lin->value[4];
    const Lanes by_q_crank_theta_crank_theta_ = lin->value[5];
    const Lanes by_q_crank_theta_rod_theta_ = lin->value[6];
    const Lanes by_q_rod_theta_crank_theta_ = lin->value[7];
    const Lanes by_q_rod_theta_rod_theta_ = lin->value[8];
    const Lanes by_v_slider_offset_crank_theta_ = lin->value[9];
    const Lanes by_v_slider_offset_rod_theta_ = lin->value[10];
    const Lanes by_v_crank_theta_crank_theta_ = lin->value[11];
    const Lanes by_v_crank_theta_rod_theta_ = lin->value[12];
    const Lanes by_v_rod_theta_crank_theta_ = lin->value[13];
    const Lanes by_v_rod_theta_rod_theta_ = lin->value[14];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_crank_theta_crank_theta_ = eta*(by_q_crank_theta_crank_theta_*eta + by_v_crank_theta_crank_theta_)
        + p->mass_crank_crank_;
    const Lanes n_crank_theta_rod_theta_ = eta*(by_q_crank_theta_rod_theta_*eta + by_v_crank_theta_rod_theta_)
        + mass_crank_theta_rod_theta_;
    const Lanes n_rod_theta_crank_theta_ = eta*(by_q_rod_theta_crank_theta_*eta + by_v_rod_theta_crank_theta_)
        + mass_crank_theta_rod_theta_;
    const Lanes n_rod_theta_rod_theta_ = eta*(by_q_rod_theta_rod_theta_*eta + by_v_rod_theta_rod_theta_)
        + p->mass_rod_rod_;
    const Lanes n_slider_offset_crank_theta_ = eta_row*(by_q_slider_offset_crank_theta_*eta
        + by_v_slider_offset_crank_theta_) + phi_slider_offset_crank_theta_;
    const Lanes n_slider_offset_rod_theta_ = eta_row*(by_q_slider_offset_rod_theta_*eta
        + by_v_slider_offset_rod_theta_) + phi_slider_offset_rod_theta_;

    /* L U */
    const Lanes scale_crank_theta_ = n_crank_theta_crank_theta_;
    *rare |= ~(lanes_fabs(scale_crank_theta_) > SINGULAR * lanes_fabs(n_crank_theta_crank_theta_));
    const Lanes inverse_pivot_crank_theta_ = 1.0/scale_crank_theta_;
    lin->lu[0] = inverse_pivot_crank_theta_;
    const Lanes l_rod_theta_crank_theta_ = inverse_pivot_crank_theta_*n_rod_theta_crank_theta_;
    lin->lu[1] = l_rod_theta_crank_theta_;
    lin->lu[2] = n_crank_theta_rod_theta_;
    const Lanes l_slider_offset_crank_theta_ = inverse_pivot_crank_theta_*n_slider_offset_crank_theta_;
    lin->lu[3] = l_slider_offset_crank_theta_;
    const Lanes scale_rod_theta_ = -l_rod_theta_crank_theta_*n_crank_theta_rod_theta_ + n_rod_theta_rod_theta_;
    *rare |= ~(lanes_fabs(scale_rod_theta_) > SINGULAR * lanes_fabs(n_rod_theta_rod_theta_));
    const Lanes inverse_pivot_rod_theta_ = 1.0/scale_rod_theta_;
    lin->lu[4] = inverse_pivot_rod_theta_;
    const Lanes l_slider_offset_rod_theta_ = inverse_pivot_rod_theta_
        *(-l_slider_offset_crank_theta_*n_crank_theta_rod_theta_ + n_slider_offset_rod_theta_);
    lin->lu[5] = l_slider_offset_rod_theta_;
    const Lanes u_rod_theta_slider_offset_ = -l_rod_theta_crank_theta_*phi_slider_offset_crank_theta_
        + phi_slider_offset_rod_theta_;
    lin->lu[6] = u_rod_theta_slider_offset_;
    const Lanes scale_slider_offset_ = -l_slider_offset_crank_theta_*phi_slider_offset_crank_theta_
        - l_slider_offset_rod_theta_*u_rod_theta_slider_offset_;
    *rare |= ~((lanes_fabs(scale_slider_offset_) > 0.0) & (lanes_fabs(scale_slider_offset_) < INFINITY));
    const Lanes inverse_pivot_slider_offset_ = 1.0/scale_slider_offset_;
    lin->lu[7] = inverse_pivot_slider_offset_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_slider_offset_crank_theta_ = lin->value[1];
    const Lanes inverse_pivot_crank_theta_ = lin->lu[0];
    const Lanes l_rod_theta_crank_theta_ = lin->lu[1];
    const Lanes n_crank_theta_rod_theta_ = lin->lu[2];
    const Lanes l_slider_offset_crank_theta_ = lin->lu[3];
    const Lanes inverse_pivot_rod_theta_ = lin->lu[4];
    const Lanes l_slider_offset_rod_theta_ = lin->lu[5];
    const Lanes u_rod_theta_slider_offset_ = lin->lu[6];
    const Lanes inverse_pivot_slider_offset_ = lin->lu[7];

    /* forward */
    const Lanes b_crank_theta_ = x[0];
    const Lanes b_rod_theta_ = -b_crank_theta_*l_rod_theta_crank_theta_ + x[1];
    const Lanes b_slider_offset_ = -b_crank_theta_*l_slider_offset_crank_theta_
        - b_rod_theta_*l_slider_offset_rod_theta_ + x[2];

    /* backward */
    const Lanes x_slider_offset_ = b_slider_offset_*inverse_pivot_slider_offset_;
    x[2] = x_slider_offset_;
    const Lanes x_rod_theta_ = inverse_pivot_rod_theta_*(b_rod_theta_ - u_rod_theta_slider_offset_*x_slider_offset_);
    x[1] = x_rod_theta_;
    const Lanes x_crank_theta_ = inverse_pivot_crank_theta_*(b_crank_theta_ - n_crank_theta_rod_theta_*x_rod_theta_
        - phi_slider_offset_crank_theta_*x_slider_offset_);
    x[0] = x_crank_theta_;
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
    const Lanes mass_crank_theta_rod_theta_ = lin->value[0];
    const Lanes phi_slider_offset_crank_theta_ = lin->value[1];
    const Lanes phi_slider_offset_rod_theta_ = lin->value[2];
    const Lanes by_q_slider_offset_crank_theta_ = lin->value[3];
    const Lanes by_q_slider_offset_rod_theta_ = lin->value[4];
    const Lanes by_q_crank_theta_crank_theta_ = lin->value[5];
    const Lanes by_q_crank_theta_rod_theta_ = lin->value[6];
    const Lanes by_q_rod_theta_crank_theta_ = lin->value[7];
    const Lanes by_q_rod_theta_rod_theta_ = lin->value[8];
    const Lanes power_q_1_crank_theta_ = lin->value[15];
    const Lanes power_q_1_rod_theta_ = lin->value[16];
    const Lanes power_v_1_crank_theta_ = lin->value[17];
    const Lanes power_v_1_rod_theta_ = lin->value[18];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[3];
    const Lanes shifted_crank_theta_ = -p->beta_squared_*eta*r[0] + r[2];
    const Lanes shifted_rod_theta_ = -p->beta_squared_*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta_*eta*r[0] - by_q_crank_theta_rod_theta_*eta*r[1]
        + p->mass_crank_crank_*r[2] + mass_crank_theta_rod_theta_*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta_*eta*r[0] - by_q_rod_theta_rod_theta_*eta*r[1]
        + mass_crank_theta_rod_theta_*r[2] + p->mass_rod_rod_*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta_*eta*r[0] - by_q_slider_offset_rod_theta_*eta*r[1]
        + phi_slider_offset_crank_theta_*shifted_crank_theta_ + phi_slider_offset_rod_theta_*shifted_rod_theta_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta_*u[0] + power_q_1_rod_theta_*u[1] + power_v_1_crank_theta_*u[2]
        + power_v_1_rod_theta_*u[3] + r[5]);
    u[6] = eta*r[6];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
