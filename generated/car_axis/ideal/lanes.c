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
    Lanes half_mass_;
    Lanes r_;
    Lanes omega_;
    Lanes axle_mass_;
    Lanes axle_inertia_;
    Lanes road_mass_;
    Lanes road_inertia_;
    Lanes axle_length_;
    Lanes road_length_;
    Lanes alpha_;
    Lanes beta_;
    Lanes slot_direction_y_;
    Lanes gravity_y_;
    Lanes left_stiffness_;
    Lanes left_free_length_;
    Lanes right_stiffness_;
    Lanes right_free_length_;
    Lanes set_axle_y_;
    Lanes set_axle_theta_;
    Lanes rates_axle_vy_;
    Lanes rates_axle_omega_;
    Lanes axle_head_s_x_;
    Lanes road_head_s_x_;
    Lanes weight_axle_y_;
    Lanes weight_road_y_;
    Lanes axle_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes inverse_axle_mass_;
    Lanes axle_tail_span_x_;
    Lanes road_head_span_x_;
    Lanes inertia_road_road_;
    Lanes mass_bump_bump_;
    Lanes weight_road_across_;
    Lanes inverse_axle_inertia_;
    Lanes tree_metric_axle_x_;
    Lanes tree_metric_axle_theta_;
    Lanes inverse_tree_metric_axle_x_;
    Lanes inverse_tree_metric_axle_theta_;
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
    /* coordinates, velocities, time */
    const Lanes axle_x_ = q[0];
    const Lanes axle_y_ = q[1];
    const Lanes axle_theta_ = q[2];

    /* directions, arms, drives */
    const Lanes bump_value_ = lanes_asin(p->r_*lanes_sin(p->omega_*t)/p->length_);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road_ = cosines_0;
    const Lanes sin_theta_road_ = sines_0;
    const Lanes cos_theta_axle_ = cosines_1;
    const Lanes sin_theta_axle_ = sines_1;
    const Lanes span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const Lanes span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* rows */
    /* slot.offset */
    out[0] = -axle_x_*cos_theta_road_ - axle_y_*sin_theta_road_ - cos_theta_road_*span_axle_tail_x_
        - sin_theta_road_*span_axle_tail_y_;
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    /* coordinates, velocities, time */
    const Lanes axle_x_ = q[0];
    const Lanes axle_x_rate_ = v[0];
    const Lanes axle_y_ = q[1];
    const Lanes axle_y_rate_ = v[1];
    const Lanes axle_theta_ = q[2];
    const Lanes axle_omega_ = v[2];

    /* directions, arms, drives */
    const Lanes bump_value_ = lanes_asin(p->r_*lanes_sin(p->omega_*t)/p->length_);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road_ = cosines_0;
    const Lanes sin_theta_road_ = sines_0;
    const Lanes cos_theta_axle_ = cosines_1;
    const Lanes sin_theta_axle_ = sines_1;
    const Lanes bump_rate_ = p->omega_*p->r_*lanes_cos(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)));
    const Lanes span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const Lanes span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* rows */
    /* slot.offset */
    out[0] = axle_omega_*(cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_)
        - axle_x_rate_*cos_theta_road_ - axle_y_rate_*sin_theta_road_
        + bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)memory;
    /* coordinates, velocities, time */
    const Lanes axle_x_ = q[0];
    const Lanes axle_x_rate_ = v[0];
    const Lanes axle_y_ = q[1];
    const Lanes axle_y_rate_ = v[1];
    const Lanes axle_theta_ = q[2];
    const Lanes axle_omega_ = v[2];

    /* directions, arms, drives */
    const Lanes bump_value_ = lanes_asin(p->r_*lanes_sin(p->omega_*t)/p->length_);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road_ = cosines_0;
    const Lanes sin_theta_road_ = sines_0;
    const Lanes cos_theta_axle_ = cosines_1;
    const Lanes sin_theta_axle_ = sines_1;
    const Lanes bump_rate_ = p->omega_*p->r_*lanes_cos(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)));
    const Lanes bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*lanes_sin(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*lanes_sin(p->omega_*t)*(lanes_cos(p->omega_*t)
        * lanes_cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*lanes_pow(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_), all_of(1.5)));
    const Lanes span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const Lanes span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;
    const Lanes axle_tail_x_ = axle_x_ + span_axle_tail_x_;
    const Lanes axle_tail_y_ = axle_y_ + span_axle_tail_y_;
    const Lanes left_length_ = lanes_sqrt((axle_tail_x_ * axle_tail_x_) + (axle_tail_y_ * axle_tail_y_));
    const Lanes left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const Lanes left_pull_ = left_force_/left_length_;
    const Lanes span_road_head_x_ = cos_theta_road_*p->road_head_span_x_;
    const Lanes span_road_head_y_ = p->road_head_span_x_*sin_theta_road_;
    const Lanes axle_head_x_ = axle_x_ - span_axle_tail_x_;
    const Lanes axle_head_y_ = axle_y_ - span_axle_tail_y_;
    const Lanes right_span_x_ = axle_head_x_ - span_road_head_x_;
    const Lanes right_span_y_ = axle_head_y_ - span_road_head_y_;
    const Lanes right_length_ = lanes_sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const Lanes right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);
    const Lanes right_pull_ = right_force_/right_length_;

    /* constraints: gamma */
    const Lanes rhs_slot_offset_ = -axle_omega_*(axle_omega_*cos_theta_road_*span_axle_tail_x_
        + axle_omega_*sin_theta_road_*span_axle_tail_y_) - bump_acceleration_*(cos_theta_road_*(-axle_y_
        - span_axle_tail_y_) - sin_theta_road_*(-axle_x_ - span_axle_tail_x_))
        + (bump_rate_ * bump_rate_)*cos_theta_road_*(-axle_x_ - span_axle_tail_x_)
        + (bump_rate_ * bump_rate_)*sin_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - 2.0*bump_rate_*cos_theta_road_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_)
        + 2.0*bump_rate_*sin_theta_road_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_);

    /* L D L^T of the KKT matrix */
    const Lanes l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_axle_mass_;
    const Lanes l_slot_offset_axle_y_ = -p->inverse_axle_mass_*sin_theta_road_;
    *rare |= ~(p->axle_inertia_ > LIGHT_PIVOT * p->axle_turning_);
    const Lanes w_slot_offset_axle_theta_ = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    const Lanes l_slot_offset_axle_theta_ = p->inverse_axle_inertia_*w_slot_offset_axle_theta_;
    const Lanes scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_
        + l_slot_offset_axle_theta_*w_slot_offset_axle_theta_ - l_slot_offset_axle_y_*sin_theta_road_;
    *rare |= ~((scale_slot_offset_ > 0.0) & (scale_slot_offset_ < INFINITY));
    const Lanes inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;

    /* forward substitution */
    const Lanes z_axle_x_ = -axle_tail_x_*left_pull_ - right_pull_*right_span_x_;
    const Lanes z_axle_y_ = -axle_tail_y_*left_pull_ - right_pull_*right_span_y_ + p->weight_axle_y_;
    const Lanes z_axle_theta_ = span_axle_tail_x_*(-axle_tail_y_*left_pull_ + right_pull_*right_span_y_)
        - span_axle_tail_y_*(-axle_tail_x_*left_pull_ + right_pull_*right_span_x_);
    const Lanes z_slot_offset_ = -l_slot_offset_axle_theta_*z_axle_theta_ - l_slot_offset_axle_x_*z_axle_x_
        - l_slot_offset_axle_y_*z_axle_y_ + rhs_slot_offset_;

    /* backward substitution */
    const Lanes lambda_slot_offset_ = -inverse_pivot_slot_offset_*z_slot_offset_;
    const Lanes acceleration_axle_theta_ = p->inverse_axle_inertia_*z_axle_theta_
        - l_slot_offset_axle_theta_*lambda_slot_offset_;
    const Lanes acceleration_axle_y_ = p->inverse_axle_mass_*z_axle_y_ - l_slot_offset_axle_y_*lambda_slot_offset_;
    const Lanes acceleration_axle_x_ = p->inverse_axle_mass_*z_axle_x_ - l_slot_offset_axle_x_*lambda_slot_offset_;

    /* results */
    a[0] = acceleration_axle_x_;
    a[1] = acceleration_axle_y_;
    a[2] = acceleration_axle_theta_;
    aside->lambda[0] = lambda_slot_offset_;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = -aside->lambda[0]*(-bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_))
        + bump_rate_*(bump_acceleration_*p->mass_bump_bump_ - cos_theta_road_*p->weight_road_across_
        + right_pull_*right_span_x_*span_road_head_y_ - right_pull_*right_span_y_*span_road_head_x_);
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
    (void)memory;
    /* coordinates, velocities, time */
    const Lanes axle_x_ = q[0];
    const Lanes axle_x_rate_ = v[0];
    const Lanes axle_y_ = q[1];
    const Lanes axle_y_rate_ = v[1];
    const Lanes axle_theta_ = q[2];
    const Lanes axle_omega_ = v[2];

    /* directions, arms, drives */
    const Lanes bump_value_ = lanes_asin(p->r_*lanes_sin(p->omega_*t)/p->length_);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta_, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road_ = cosines_0;
    const Lanes sin_theta_road_ = sines_0;
    const Lanes cos_theta_axle_ = cosines_1;
    const Lanes sin_theta_axle_ = sines_1;
    const Lanes bump_rate_ = p->omega_*p->r_*lanes_cos(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)));
    const Lanes span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const Lanes span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;

    /* Phi and Phi_dot */
    const Lanes phi_slot_offset_ = -axle_x_*cos_theta_road_ - axle_y_*sin_theta_road_
        - cos_theta_road_*span_axle_tail_x_ - sin_theta_road_*span_axle_tail_y_;
    const Lanes phi_dot_slot_offset_ = axle_omega_*(cos_theta_road_*span_axle_tail_y_
        - sin_theta_road_*span_axle_tail_x_) - axle_x_rate_*cos_theta_road_ - axle_y_rate_*sin_theta_road_
        + bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);

    /* L D L^T of the KKT matrix */
    const Lanes l_slot_offset_axle_x_ = -cos_theta_road_*p->inverse_tree_metric_axle_x_;
    const Lanes l_slot_offset_axle_y_ = -p->inverse_tree_metric_axle_x_*sin_theta_road_;
    const Lanes w_slot_offset_axle_theta_ = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    const Lanes l_slot_offset_axle_theta_ = p->inverse_tree_metric_axle_theta_*w_slot_offset_axle_theta_;
    const Lanes scale_slot_offset_ = -cos_theta_road_*l_slot_offset_axle_x_
        + l_slot_offset_axle_theta_*w_slot_offset_axle_theta_ - l_slot_offset_axle_y_*sin_theta_road_;
    *rare |= ~((scale_slot_offset_ > 0.0) & (scale_slot_offset_ < INFINITY));
    const Lanes inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;

    /* backward substitution */
    const Lanes dq_lambda_slot_offset_ = -inverse_pivot_slot_offset_*phi_slot_offset_;
    const Lanes dq_acceleration_axle_theta_ = -dq_lambda_slot_offset_*l_slot_offset_axle_theta_;
    const Lanes dq_acceleration_axle_y_ = -dq_lambda_slot_offset_*l_slot_offset_axle_y_;
    const Lanes dq_acceleration_axle_x_ = -dq_lambda_slot_offset_*l_slot_offset_axle_x_;

    /* backward substitution */
    const Lanes dv_lambda_slot_offset_ = -inverse_pivot_slot_offset_*phi_dot_slot_offset_;
    const Lanes dv_acceleration_axle_theta_ = -dv_lambda_slot_offset_*l_slot_offset_axle_theta_;
    const Lanes dv_acceleration_axle_y_ = -dv_lambda_slot_offset_*l_slot_offset_axle_y_;
    const Lanes dv_acceleration_axle_x_ = -dv_lambda_slot_offset_*l_slot_offset_axle_x_;

    /* results */
    dq[0] = dq_acceleration_axle_x_;
    dv[0] = dv_acceleration_axle_x_;
    dq[1] = dq_acceleration_axle_y_;
    dv[1] = dv_acceleration_axle_y_;
    dq[2] = dq_acceleration_axle_theta_;
    dv[2] = dv_acceleration_axle_theta_;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_slot_offset_));
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
    (void)memory, (void)rare;
    /* coordinates, velocities, time */
    const Lanes axle_x_ = q[0];
    const Lanes axle_x_rate_ = v[0];
    const Lanes axle_y_ = q[1];
    const Lanes axle_y_rate_ = v[1];
    const Lanes axle_theta_ = q[2];
    const Lanes axle_omega_ = v[2];
    const Lanes a_axle_x_ = a[0];
    const Lanes a_axle_y_ = a[1];
    const Lanes a_axle_theta_ = a[2];
    const Lanes held_lambda_slot_offset_ = aside->lambda[0];

    /* directions, arms, drives */
    const Lanes bump_value_ = lanes_asin(p->r_*lanes_sin(p->omega_*t)/p->length_);
    const Lanes bump_rate_ = p->omega_*p->r_*lanes_cos(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)));
    const Lanes bump_acceleration_ = -(p->omega_ * p->omega_)*p->r_*lanes_sin(p->omega_*t)/(p->length_*lanes_sqrt(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_)))
        + (p->omega_ * p->omega_)*(p->r_ * p->r_ * p->r_)*lanes_sin(p->omega_*t)*(lanes_cos(p->omega_*t)
        * lanes_cos(p->omega_*t))/((p->length_ * p->length_ * p->length_)*lanes_pow(1.0
        - (p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))/(p->length_ * p->length_), all_of(1.5)));
    const Lanes cos_theta_road_ = lanes_cos(bump_value_);
    const Lanes sin_theta_road_ = lanes_sin(bump_value_);
    const Lanes cos_theta_axle_ = lanes_cos(axle_theta_);
    const Lanes sin_theta_axle_ = lanes_sin(axle_theta_);
    const Lanes span_axle_tail_x_ = p->axle_tail_span_x_*cos_theta_axle_;
    const Lanes span_axle_tail_y_ = p->axle_tail_span_x_*sin_theta_axle_;
    const Lanes axle_tail_x_ = axle_x_ + span_axle_tail_x_;
    const Lanes axle_tail_y_ = axle_y_ + span_axle_tail_y_;
    const Lanes left_length_ = lanes_sqrt((axle_tail_x_ * axle_tail_x_) + (axle_tail_y_ * axle_tail_y_));
    const Lanes left_force_ = p->left_stiffness_*(-p->left_free_length_ + left_length_);
    const Lanes left_pull_ = left_force_/left_length_;
    const Lanes span_road_head_x_ = cos_theta_road_*p->road_head_span_x_;
    const Lanes span_road_head_y_ = p->road_head_span_x_*sin_theta_road_;
    const Lanes axle_head_x_ = axle_x_ - span_axle_tail_x_;
    const Lanes axle_head_y_ = axle_y_ - span_axle_tail_y_;
    const Lanes right_span_x_ = axle_head_x_ - span_road_head_x_;
    const Lanes right_span_y_ = axle_head_y_ - span_road_head_y_;
    const Lanes right_length_ = lanes_sqrt((right_span_x_ * right_span_x_) + (right_span_y_ * right_span_y_));
    const Lanes right_force_ = p->right_stiffness_*(-p->right_free_length_ + right_length_);
    const Lanes right_pull_ = right_force_/right_length_;

    /* constraints */
    const Lanes inverse_length_ = 1.0/p->length_;
    const Lanes bump_acceleration_by_time_ = 3.0*lanes_pow(inverse_length_,
        all_of(5.0))*(p->omega_ * p->omega_ * p->omega_)*lanes_pow(p->r_,
        all_of(5.0))*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))*(lanes_cos(p->omega_*t) * lanes_cos(p->omega_*t)
        * lanes_cos(p->omega_*t))/lanes_pow(-(inverse_length_ * inverse_length_)*(p->r_
        * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t)) + 1.0, all_of(2.5))
        - 3.0*(inverse_length_ * inverse_length_ * inverse_length_)*(p->omega_ * p->omega_ * p->omega_)*(p->r_ * p->r_
        * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t))*lanes_cos(p->omega_*t)/lanes_pow(-(inverse_length_
        * inverse_length_)*(p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t)) + 1.0, all_of(1.5))
        + (inverse_length_ * inverse_length_ * inverse_length_)*(p->omega_ * p->omega_ * p->omega_)*(p->r_ * p->r_
        * p->r_)*(lanes_cos(p->omega_*t) * lanes_cos(p->omega_*t)
        * lanes_cos(p->omega_*t))/lanes_pow(-(inverse_length_ * inverse_length_)*(p->r_
        * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t)) + 1.0, all_of(1.5))
        - inverse_length_*(p->omega_ * p->omega_ * p->omega_)*p->r_*lanes_cos(p->omega_*t)/lanes_sqrt(-(inverse_length_
        * inverse_length_)*(p->r_ * p->r_)*(lanes_sin(p->omega_*t) * lanes_sin(p->omega_*t)) + 1.0);
    const Lanes cos_theta_road_by_time_ = -bump_rate_*sin_theta_road_;
    const Lanes sin_theta_road_by_time_ = bump_rate_*cos_theta_road_;

    /* coordinates */
    const Lanes inverse_sum_ = 1.0/(left_length_ + 1e-150);
    const Lanes left_length_by_axle_x_ = axle_tail_x_*inverse_sum_;
    const Lanes left_length_by_axle_theta_ = -axle_tail_x_*inverse_sum_*span_axle_tail_y_
        + axle_tail_y_*inverse_sum_*span_axle_tail_x_;
    const Lanes left_length_by_axle_y_ = axle_tail_y_*inverse_sum_;
    const Lanes left_force_by_axle_x_ = left_length_by_axle_x_*p->left_stiffness_;
    const Lanes left_force_by_axle_theta_ = left_length_by_axle_theta_*p->left_stiffness_;
    const Lanes left_force_by_axle_y_ = left_length_by_axle_y_*p->left_stiffness_;
    const Lanes inverse_left_length_ = 1.0/left_length_;
    const Lanes left_pull_by_axle_x_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_x_ + inverse_left_length_*left_force_by_axle_x_;
    const Lanes left_pull_by_axle_theta_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_theta_ + inverse_left_length_*left_force_by_axle_theta_;
    const Lanes left_pull_by_axle_y_ = -(inverse_left_length_
        * inverse_left_length_)*left_force_*left_length_by_axle_y_ + inverse_left_length_*left_force_by_axle_y_;
    const Lanes span_road_head_x_by_time_ = -bump_rate_*span_road_head_y_;
    const Lanes span_road_head_y_by_time_ = bump_rate_*span_road_head_x_;
    const Lanes inverse_sum_2_ = 1.0/(right_length_ + 1e-150);
    const Lanes right_length_by_axle_x_ = inverse_sum_2_*right_span_x_;
    const Lanes right_length_by_axle_theta_ = inverse_sum_2_*right_span_x_*span_axle_tail_y_
        - inverse_sum_2_*right_span_y_*span_axle_tail_x_;
    const Lanes right_length_by_time_ = -inverse_sum_2_*right_span_x_*span_road_head_x_by_time_
        - inverse_sum_2_*right_span_y_*span_road_head_y_by_time_;
    const Lanes right_length_by_axle_y_ = inverse_sum_2_*right_span_y_;
    const Lanes right_force_by_axle_x_ = right_length_by_axle_x_*p->right_stiffness_;
    const Lanes right_force_by_axle_theta_ = right_length_by_axle_theta_*p->right_stiffness_;
    const Lanes right_force_by_time_ = right_length_by_time_*p->right_stiffness_;
    const Lanes right_force_by_axle_y_ = right_length_by_axle_y_*p->right_stiffness_;
    const Lanes inverse_right_length_ = 1.0/right_length_;
    const Lanes right_pull_by_axle_x_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_x_ + inverse_right_length_*right_force_by_axle_x_;
    const Lanes right_pull_by_axle_theta_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_theta_
        + inverse_right_length_*right_force_by_axle_theta_;
    const Lanes right_pull_by_time_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_time_ + inverse_right_length_*right_force_by_time_;
    const Lanes right_pull_by_axle_y_ = -(inverse_right_length_
        * inverse_right_length_)*right_force_*right_length_by_axle_y_ + inverse_right_length_*right_force_by_axle_y_;

    /* results */
    lin->value[0] = -cos_theta_road_;
    lin->value[1] = -sin_theta_road_;
    lin->value[2] = cos_theta_road_*span_axle_tail_y_ - sin_theta_road_*span_axle_tail_x_;
    lin->value[3] = bump_acceleration_*sin_theta_road_ + (bump_rate_ * bump_rate_)*cos_theta_road_
        + bump_rate_*sin_theta_road_*p->two_alpha_;
    lin->value[4] = -bump_acceleration_*cos_theta_road_ + (bump_rate_ * bump_rate_)*sin_theta_road_
        - bump_rate_*cos_theta_road_*p->two_alpha_;
    lin->value[5] = span_axle_tail_x_*(a_axle_theta_*cos_theta_road_ + (axle_omega_ * axle_omega_)*sin_theta_road_
        - 2.0*axle_omega_*bump_rate_*sin_theta_road_ - bump_acceleration_*cos_theta_road_
        + (bump_rate_ * bump_rate_)*sin_theta_road_) - span_axle_tail_y_*(-a_axle_theta_*sin_theta_road_
        + (axle_omega_ * axle_omega_)*cos_theta_road_ - 2.0*axle_omega_*bump_rate_*cos_theta_road_
        + bump_acceleration_*sin_theta_road_ + (bump_rate_ * bump_rate_)*cos_theta_road_)
        + p->two_alpha_*(span_axle_tail_x_*(axle_omega_*cos_theta_road_ - bump_rate_*cos_theta_road_)
        - span_axle_tail_y_*(-axle_omega_*sin_theta_road_ + bump_rate_*sin_theta_road_));
    lin->value[6] = axle_tail_x_*left_pull_by_axle_x_ + left_pull_ + right_pull_ + right_pull_by_axle_x_*right_span_x_;
    lin->value[7] = axle_tail_x_*left_pull_by_axle_theta_ - left_pull_*span_axle_tail_y_
        + right_pull_*span_axle_tail_y_ + right_pull_by_axle_theta_*right_span_x_;
    lin->value[8] = axle_tail_x_*left_pull_by_axle_y_ + right_pull_by_axle_y_*right_span_x_;
    lin->value[9] = axle_tail_y_*left_pull_by_axle_y_ + left_pull_ + right_pull_ + right_pull_by_axle_y_*right_span_y_;
    lin->value[10] = axle_tail_y_*left_pull_by_axle_theta_ + left_pull_*span_axle_tail_x_
        - right_pull_*span_axle_tail_x_ + right_pull_by_axle_theta_*right_span_y_;
    lin->value[11] = axle_tail_y_*left_pull_by_axle_x_ + right_pull_by_axle_x_*right_span_y_;
    lin->value[12] = -left_pull_*span_axle_tail_y_ + left_pull_by_axle_x_*(-axle_tail_x_*span_axle_tail_y_
        + axle_tail_y_*span_axle_tail_x_) + right_pull_*span_axle_tail_y_
        + right_pull_by_axle_x_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[13] = left_pull_*(span_axle_tail_x_ * span_axle_tail_x_)
        + left_pull_*(span_axle_tail_y_ * span_axle_tail_y_)
        + left_pull_by_axle_theta_*(-axle_tail_x_*span_axle_tail_y_ + axle_tail_y_*span_axle_tail_x_)
        + right_pull_*(span_axle_tail_x_ * span_axle_tail_x_) + right_pull_*(span_axle_tail_y_ * span_axle_tail_y_)
        + right_pull_by_axle_theta_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_)
        + span_axle_tail_x_*(-axle_tail_x_*left_pull_ + cos_theta_road_*held_lambda_slot_offset_
        + right_pull_*right_span_x_) - span_axle_tail_y_*(axle_tail_y_*left_pull_
        - held_lambda_slot_offset_*sin_theta_road_ - right_pull_*right_span_y_);
    lin->value[14] = left_pull_*span_axle_tail_x_ + left_pull_by_axle_y_*(-axle_tail_x_*span_axle_tail_y_
        + axle_tail_y_*span_axle_tail_x_) - right_pull_*span_axle_tail_x_
        + right_pull_by_axle_y_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[15] = axle_omega_*cos_theta_road_*span_axle_tail_x_ + axle_omega_*sin_theta_road_*span_axle_tail_y_
        + axle_omega_*(cos_theta_road_*span_axle_tail_x_ + sin_theta_road_*span_axle_tail_y_)
        - 2.0*bump_rate_*cos_theta_road_*span_axle_tail_x_ - 2.0*bump_rate_*sin_theta_road_*span_axle_tail_y_;
    lin->value[16] = 2.0*bump_rate_*sin_theta_road_;
    lin->value[17] = -2.0*bump_rate_*cos_theta_road_;
    lin->value[18] = p->beta_squared_*(cos_theta_road_by_time_*(-axle_x_ - span_axle_tail_x_)
        + sin_theta_road_by_time_*(-axle_y_ - span_axle_tail_y_))
        + bump_acceleration_*(-2.0*bump_rate_*cos_theta_road_*(-axle_x_ - span_axle_tail_x_)
        - 2.0*bump_rate_*sin_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + 2.0*cos_theta_road_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_)
        - 2.0*sin_theta_road_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_))
        + bump_acceleration_by_time_*(cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + cos_theta_road_by_time_*(a_axle_theta_*span_axle_tail_y_
        - a_axle_x_ + (axle_omega_ * axle_omega_)*span_axle_tail_x_ + bump_acceleration_*(-axle_y_ - span_axle_tail_y_)
        - (bump_rate_ * bump_rate_)*(-axle_x_ - span_axle_tail_x_)
        + 2.0*bump_rate_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_))
        + sin_theta_road_by_time_*(-a_axle_theta_*span_axle_tail_x_ - a_axle_y_
        + (axle_omega_ * axle_omega_)*span_axle_tail_y_ + bump_acceleration_*(axle_x_ + span_axle_tail_x_)
        - (bump_rate_ * bump_rate_)*(-axle_y_ - span_axle_tail_y_)
        - 2.0*bump_rate_*(axle_omega_*span_axle_tail_y_ - axle_x_rate_))
        + p->two_alpha_*(bump_acceleration_*(cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + cos_theta_road_by_time_*(axle_omega_*span_axle_tail_y_
        - axle_x_rate_ + bump_rate_*(-axle_y_ - span_axle_tail_y_))
        + sin_theta_road_by_time_*(-axle_omega_*span_axle_tail_x_ - axle_y_rate_
        - bump_rate_*(-axle_x_ - span_axle_tail_x_)));
    lin->value[19] = -cos_theta_road_by_time_*held_lambda_slot_offset_ - right_pull_*span_road_head_x_by_time_
        + right_pull_by_time_*right_span_x_;
    lin->value[20] = -held_lambda_slot_offset_*sin_theta_road_by_time_ - right_pull_*span_road_head_y_by_time_
        + right_pull_by_time_*right_span_y_;
    lin->value[21] = cos_theta_road_by_time_*held_lambda_slot_offset_*span_axle_tail_y_
        - held_lambda_slot_offset_*sin_theta_road_by_time_*span_axle_tail_x_
        + right_pull_*span_axle_tail_x_*span_road_head_y_by_time_
        - right_pull_*span_axle_tail_y_*span_road_head_x_by_time_
        + right_pull_by_time_*(right_span_x_*span_axle_tail_y_ - right_span_y_*span_axle_tail_x_);
    lin->value[22] = bump_rate_*held_lambda_slot_offset_*sin_theta_road_ + bump_rate_*right_pull_*span_road_head_y_
        + bump_rate_*right_pull_by_axle_x_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[23] = -bump_rate_*cos_theta_road_*held_lambda_slot_offset_ - bump_rate_*right_pull_*span_road_head_x_
        + bump_rate_*right_pull_by_axle_y_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[24] = -bump_rate_*cos_theta_road_*held_lambda_slot_offset_*span_axle_tail_x_
        - bump_rate_*held_lambda_slot_offset_*sin_theta_road_*span_axle_tail_y_
        + bump_rate_*right_pull_*span_axle_tail_x_*span_road_head_x_
        + bump_rate_*right_pull_*span_axle_tail_y_*span_road_head_y_
        + bump_rate_*right_pull_by_axle_theta_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_);
    lin->value[25] = bump_rate_*cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*sin_theta_road_*(-axle_x_ - span_axle_tail_x_);
    lin->value[26] = bump_acceleration_*(bump_acceleration_*p->mass_bump_bump_ - cos_theta_road_*p->weight_road_across_
        - held_lambda_slot_offset_*(-cos_theta_road_*(-axle_y_ - span_axle_tail_y_)
        + sin_theta_road_*(-axle_x_ - span_axle_tail_x_)) + right_pull_*right_span_x_*span_road_head_y_
        - right_pull_*right_span_y_*span_road_head_x_) + bump_acceleration_by_time_*bump_rate_*p->mass_bump_bump_
        - bump_rate_*held_lambda_slot_offset_*sin_theta_road_by_time_*(-axle_x_ - span_axle_tail_x_)
        + bump_rate_*right_pull_*right_span_x_*span_road_head_y_by_time_
        - bump_rate_*right_pull_*right_span_y_*span_road_head_x_by_time_
        + bump_rate_*right_pull_*span_road_head_x_*span_road_head_y_by_time_
        - bump_rate_*right_pull_*span_road_head_x_by_time_*span_road_head_y_
        + bump_rate_*right_pull_by_time_*(right_span_x_*span_road_head_y_ - right_span_y_*span_road_head_x_)
        + cos_theta_road_by_time_*(bump_rate_*held_lambda_slot_offset_*(-axle_y_ - span_axle_tail_y_)
        - bump_rate_*p->weight_road_across_);
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
    const Lanes phi_slot_offset_axle_x_ = lin->value[0];
    const Lanes phi_slot_offset_axle_y_ = lin->value[1];
    const Lanes phi_slot_offset_axle_theta_ = lin->value[2];
    const Lanes by_q_slot_offset_axle_x_ = lin->value[3];
    const Lanes by_q_slot_offset_axle_y_ = lin->value[4];
    const Lanes by_q_slot_offset_axle_theta_ = lin->value[5];
    const Lanes by_q_axle_x_axle_x_ = lin->value[6];
    const Lanes by_q_axle_x_axle_theta_ = lin->value[7];
    const Lanes by_q_axle_x_axle_y_ = lin->value[8];
    const Lanes by_q_axle_y_axle_y_ = lin->value[9];
    const Lanes by_q_axle_y_axle_theta_ = lin->value[10];
    const Lanes by_q_axle_y_axle_x_ = lin->value[11];
    const Lanes by_q_axle_theta_axle_x_ = lin->value[12];
    const Lanes by_q_axle_theta_axle_theta_ = lin->value[13];
    const Lanes by_q_axle_theta_axle_y_ = lin->value[14];
    const Lanes by_v_slot_offset_axle_theta_ = lin->value[15];
    const Lanes by_v_slot_offset_axle_x_ = lin->value[16];
    const Lanes by_v_slot_offset_axle_y_ = lin->value[17];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_axle_x_axle_x_ = p->axle_mass_ + by_q_axle_x_axle_x_*(eta * eta);
    const Lanes n_axle_x_axle_y_ = by_q_axle_x_axle_y_*(eta * eta);
    const Lanes n_axle_x_axle_theta_ = by_q_axle_x_axle_theta_*(eta * eta);
    const Lanes n_axle_y_axle_x_ = by_q_axle_y_axle_x_*(eta * eta);
    const Lanes n_axle_y_axle_y_ = p->axle_mass_ + by_q_axle_y_axle_y_*(eta * eta);
    const Lanes n_axle_y_axle_theta_ = by_q_axle_y_axle_theta_*(eta * eta);
    const Lanes n_axle_theta_axle_x_ = by_q_axle_theta_axle_x_*(eta * eta);
    const Lanes n_axle_theta_axle_y_ = by_q_axle_theta_axle_y_*(eta * eta);
    const Lanes n_axle_theta_axle_theta_ = p->axle_inertia_ + by_q_axle_theta_axle_theta_*(eta * eta);
    const Lanes n_slot_offset_axle_x_ = eta_row*(by_q_slot_offset_axle_x_*eta + by_v_slot_offset_axle_x_)
        + phi_slot_offset_axle_x_;
    const Lanes n_slot_offset_axle_y_ = eta_row*(by_q_slot_offset_axle_y_*eta + by_v_slot_offset_axle_y_)
        + phi_slot_offset_axle_y_;
    const Lanes n_slot_offset_axle_theta_ = eta_row*(by_q_slot_offset_axle_theta_*eta + by_v_slot_offset_axle_theta_)
        + phi_slot_offset_axle_theta_;

    /* L U */
    const Lanes scale_axle_x_ = n_axle_x_axle_x_;
    *rare |= ~(lanes_fabs(scale_axle_x_) > SINGULAR * lanes_fabs(n_axle_x_axle_x_));
    const Lanes inverse_pivot_axle_x_ = 1.0/scale_axle_x_;
    lin->lu[0] = inverse_pivot_axle_x_;
    const Lanes l_axle_y_axle_x_ = inverse_pivot_axle_x_*n_axle_y_axle_x_;
    lin->lu[1] = l_axle_y_axle_x_;
    lin->lu[2] = n_axle_x_axle_y_;
    const Lanes l_axle_theta_axle_x_ = inverse_pivot_axle_x_*n_axle_theta_axle_x_;
    lin->lu[3] = l_axle_theta_axle_x_;
    lin->lu[4] = n_axle_x_axle_theta_;
    const Lanes l_slot_offset_axle_x_ = inverse_pivot_axle_x_*n_slot_offset_axle_x_;
    lin->lu[5] = l_slot_offset_axle_x_;
    const Lanes scale_axle_y_ = -l_axle_y_axle_x_*n_axle_x_axle_y_ + n_axle_y_axle_y_;
    *rare |= ~(lanes_fabs(scale_axle_y_) > SINGULAR * lanes_fabs(n_axle_y_axle_y_));
    const Lanes inverse_pivot_axle_y_ = 1.0/scale_axle_y_;
    lin->lu[6] = inverse_pivot_axle_y_;
    const Lanes l_axle_theta_axle_y_ = inverse_pivot_axle_y_*(-l_axle_theta_axle_x_*n_axle_x_axle_y_
        + n_axle_theta_axle_y_);
    lin->lu[7] = l_axle_theta_axle_y_;
    const Lanes u_axle_y_axle_theta_ = -l_axle_y_axle_x_*n_axle_x_axle_theta_ + n_axle_y_axle_theta_;
    lin->lu[8] = u_axle_y_axle_theta_;
    const Lanes l_slot_offset_axle_y_ = inverse_pivot_axle_y_*(-l_slot_offset_axle_x_*n_axle_x_axle_y_
        + n_slot_offset_axle_y_);
    lin->lu[9] = l_slot_offset_axle_y_;
    const Lanes u_axle_y_slot_offset_ = -l_axle_y_axle_x_*phi_slot_offset_axle_x_ + phi_slot_offset_axle_y_;
    lin->lu[10] = u_axle_y_slot_offset_;
    const Lanes scale_axle_theta_ = -l_axle_theta_axle_x_*n_axle_x_axle_theta_
        - l_axle_theta_axle_y_*u_axle_y_axle_theta_ + n_axle_theta_axle_theta_;
    *rare |= ~(lanes_fabs(scale_axle_theta_) > SINGULAR * lanes_fabs(n_axle_theta_axle_theta_));
    const Lanes inverse_pivot_axle_theta_ = 1.0/scale_axle_theta_;
    lin->lu[11] = inverse_pivot_axle_theta_;
    const Lanes l_slot_offset_axle_theta_ = inverse_pivot_axle_theta_*(-l_slot_offset_axle_x_*n_axle_x_axle_theta_
        - l_slot_offset_axle_y_*u_axle_y_axle_theta_ + n_slot_offset_axle_theta_);
    lin->lu[12] = l_slot_offset_axle_theta_;
    const Lanes u_axle_theta_slot_offset_ = -l_axle_theta_axle_x_*phi_slot_offset_axle_x_
        - l_axle_theta_axle_y_*u_axle_y_slot_offset_ + phi_slot_offset_axle_theta_;
    lin->lu[13] = u_axle_theta_slot_offset_;
    const Lanes scale_slot_offset_ = -l_slot_offset_axle_theta_*u_axle_theta_slot_offset_
        - l_slot_offset_axle_x_*phi_slot_offset_axle_x_ - l_slot_offset_axle_y_*u_axle_y_slot_offset_;
    *rare |= ~((lanes_fabs(scale_slot_offset_) > 0.0) & (lanes_fabs(scale_slot_offset_) < INFINITY));
    const Lanes inverse_pivot_slot_offset_ = 1.0/scale_slot_offset_;
    lin->lu[14] = inverse_pivot_slot_offset_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_slot_offset_axle_x_ = lin->value[0];
    const Lanes inverse_pivot_axle_x_ = lin->lu[0];
    const Lanes l_axle_y_axle_x_ = lin->lu[1];
    const Lanes n_axle_x_axle_y_ = lin->lu[2];
    const Lanes l_axle_theta_axle_x_ = lin->lu[3];
    const Lanes n_axle_x_axle_theta_ = lin->lu[4];
    const Lanes l_slot_offset_axle_x_ = lin->lu[5];
    const Lanes inverse_pivot_axle_y_ = lin->lu[6];
    const Lanes l_axle_theta_axle_y_ = lin->lu[7];
    const Lanes u_axle_y_axle_theta_ = lin->lu[8];
    const Lanes l_slot_offset_axle_y_ = lin->lu[9];
    const Lanes u_axle_y_slot_offset_ = lin->lu[10];
    const Lanes inverse_pivot_axle_theta_ = lin->lu[11];
    const Lanes l_slot_offset_axle_theta_ = lin->lu[12];
    const Lanes u_axle_theta_slot_offset_ = lin->lu[13];
    const Lanes inverse_pivot_slot_offset_ = lin->lu[14];

    /* forward */
    const Lanes b_axle_x_ = x[0];
    const Lanes b_axle_y_ = -b_axle_x_*l_axle_y_axle_x_ + x[1];
    const Lanes b_axle_theta_ = -b_axle_x_*l_axle_theta_axle_x_ - b_axle_y_*l_axle_theta_axle_y_ + x[2];
    const Lanes b_slot_offset_ = -b_axle_theta_*l_slot_offset_axle_theta_ - b_axle_x_*l_slot_offset_axle_x_
        - b_axle_y_*l_slot_offset_axle_y_ + x[3];

    /* backward */
    const Lanes x_slot_offset_ = b_slot_offset_*inverse_pivot_slot_offset_;
    x[3] = x_slot_offset_;
    const Lanes x_axle_theta_ = inverse_pivot_axle_theta_*(b_axle_theta_ - u_axle_theta_slot_offset_*x_slot_offset_);
    x[2] = x_axle_theta_;
    const Lanes x_axle_y_ = inverse_pivot_axle_y_*(b_axle_y_ - u_axle_y_axle_theta_*x_axle_theta_
        - u_axle_y_slot_offset_*x_slot_offset_);
    x[1] = x_axle_y_;
    const Lanes x_axle_x_ = inverse_pivot_axle_x_*(b_axle_x_ - n_axle_x_axle_theta_*x_axle_theta_
        - n_axle_x_axle_y_*x_axle_y_ - phi_slot_offset_axle_x_*x_slot_offset_);
    x[0] = x_axle_x_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_slot_offset_axle_x_ = lin->value[0];
    const Lanes phi_slot_offset_axle_y_ = lin->value[1];
    const Lanes phi_slot_offset_axle_theta_ = lin->value[2];
    const Lanes by_q_slot_offset_axle_x_ = lin->value[3];
    const Lanes by_q_slot_offset_axle_y_ = lin->value[4];
    const Lanes by_q_slot_offset_axle_theta_ = lin->value[5];
    const Lanes by_q_axle_x_axle_x_ = lin->value[6];
    const Lanes by_q_axle_x_axle_theta_ = lin->value[7];
    const Lanes by_q_axle_x_axle_y_ = lin->value[8];
    const Lanes by_q_axle_y_axle_y_ = lin->value[9];
    const Lanes by_q_axle_y_axle_theta_ = lin->value[10];
    const Lanes by_q_axle_y_axle_x_ = lin->value[11];
    const Lanes by_q_axle_theta_axle_x_ = lin->value[12];
    const Lanes by_q_axle_theta_axle_theta_ = lin->value[13];
    const Lanes by_q_axle_theta_axle_y_ = lin->value[14];
    const Lanes by_t_slot_offset_ = lin->value[18];
    const Lanes by_t_axle_x_ = lin->value[19];
    const Lanes by_t_axle_y_ = lin->value[20];
    const Lanes by_t_axle_theta_ = lin->value[21];
    const Lanes power_q_0_axle_x_ = lin->value[22];
    const Lanes power_q_0_axle_y_ = lin->value[23];
    const Lanes power_q_0_axle_theta_ = lin->value[24];
    const Lanes power_0_slot_offset_ = lin->value[25];
    const Lanes power_t_0_ = lin->value[26];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[4];
    const Lanes shifted_axle_x_ = -p->beta_squared_*eta*r[0] + r[3];
    const Lanes shifted_axle_y_ = -p->beta_squared_*eta*r[1] + r[4];
    const Lanes shifted_axle_theta_ = -p->beta_squared_*eta*r[2] + r[5];
    x[0] = eta*(p->axle_mass_*r[3] - by_q_axle_x_axle_theta_*eta*r[2] - by_q_axle_x_axle_x_*eta*r[0]
        - by_q_axle_x_axle_y_*eta*r[1] - by_t_axle_x_*s);
    x[1] = eta*(p->axle_mass_*r[4] - by_q_axle_y_axle_theta_*eta*r[2] - by_q_axle_y_axle_x_*eta*r[0]
        - by_q_axle_y_axle_y_*eta*r[1] - by_t_axle_y_*s);
    x[2] = eta*(p->axle_inertia_*r[5] - by_q_axle_theta_axle_theta_*eta*r[2] - by_q_axle_theta_axle_x_*eta*r[0]
        - by_q_axle_theta_axle_y_*eta*r[1] - by_t_axle_theta_*s);
    x[3] = eta_row*(-by_q_slot_offset_axle_theta_*eta*r[2] - by_q_slot_offset_axle_x_*eta*r[0]
        - by_q_slot_offset_axle_y_*eta*r[1] - by_t_slot_offset_*s + phi_slot_offset_axle_theta_*shifted_axle_theta_
        + phi_slot_offset_axle_x_*shifted_axle_x_ + phi_slot_offset_axle_y_*shifted_axle_y_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*(power_q_0_axle_theta_*u[2] + power_q_0_axle_x_*u[0] + power_q_0_axle_y_*u[1] + power_t_0_*s + r[6])
        + power_0_slot_offset_*x[3];
    u[7] = eta*r[7];
    u[8] = eta*r[8];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
