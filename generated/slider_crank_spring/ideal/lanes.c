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
    Lanes crank_mass;
    Lanes crank_inertia;
    Lanes rod_mass;
    Lanes rod_inertia;
    Lanes crank_length;
    Lanes crank_points_middle_x;
    Lanes rod_points_crankpin_x;
    Lanes rod_points_middle_x;
    Lanes rod_points_tip_x;
    Lanes alpha;
    Lanes beta;
    Lanes slider_direction_x;
    Lanes coil_stiffness;
    Lanes coil_free_length;
    Lanes coil_damping;
    Lanes push_value_x;
    Lanes guess_rod_theta;
    Lanes guess_rod_x;
    Lanes set_crank_theta;
    Lanes rates_crank_omega;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_rod_mass;
    Lanes inverse_crank_mass;
    Lanes inverse_crank_inertia;
    Lanes inverse_rod_inertia;
    Lanes rod_com_span_x;
    Lanes rod_middle_span_x;
    Lanes rod_tip_span_x;
    Lanes inertia_crank_crank;
    Lanes inertia_crank_rod;
    Lanes inertia_rod_rod;
    Lanes mass_crank_crank;
    Lanes mass_rod_rod;
    Lanes inverse_mass_crank_crank;
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
    const Lanes crank_theta = q[0];
    const Lanes rod_theta = q[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta, &sines_1, &cosines_1, rare);
    const Lanes sin_theta_crank = sines_0;
    const Lanes sin_theta_rod = sines_1;
    const Lanes span_crank_head_y = p->crank_length*sin_theta_crank;
    const Lanes span_rod_com_y = p->rod_com_span_x*sin_theta_rod;

    /* rows */
    out[0] = span_crank_head_y + span_rod_com_y;  /* slider.offset */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes crank_theta = q[0];
    const Lanes crank_omega = v[0];
    const Lanes rod_theta = q[1];
    const Lanes rod_omega = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank = cosines_0;
    const Lanes cos_theta_rod = cosines_1;
    const Lanes span_crank_head_x = cos_theta_crank*p->crank_length;
    const Lanes span_rod_com_x = cos_theta_rod*p->rod_com_span_x;

    /* rows */
    out[0] = crank_omega*span_crank_head_x + rod_omega*span_rod_com_x;  /* slider.offset */
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
    const Lanes crank_theta = q[0];
    const Lanes crank_omega = v[0];
    const Lanes rod_theta = q[1];
    const Lanes rod_omega = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank = cosines_0;
    const Lanes sin_theta_crank = sines_0;
    const Lanes cos_theta_rod = cosines_1;
    const Lanes sin_theta_rod = sines_1;
    const Lanes span_crank_head_x = cos_theta_crank*p->crank_length;
    const Lanes span_crank_head_y = p->crank_length*sin_theta_crank;
    const Lanes crank_head_vx = -crank_omega*span_crank_head_y;
    const Lanes crank_head_vy = crank_omega*span_crank_head_x;
    const Lanes span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const Lanes span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const Lanes span_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const Lanes span_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const Lanes crank_middle_vx = -crank_omega*span_crank_middle_y;
    const Lanes crank_middle_vy = crank_omega*span_crank_middle_x;
    const Lanes span_rod_middle_x = cos_theta_rod*p->rod_middle_span_x;
    const Lanes span_rod_middle_y = p->rod_middle_span_x*sin_theta_rod;
    const Lanes rod_middle_x = span_crank_head_x + span_rod_middle_x;
    const Lanes rod_middle_vx = crank_head_vx - rod_omega*span_rod_middle_y;
    const Lanes rod_middle_y = span_crank_head_y + span_rod_middle_y;
    const Lanes rod_middle_vy = crank_head_vy + rod_omega*span_rod_middle_x;
    const Lanes coil_span_x = rod_middle_x - span_crank_middle_x;
    const Lanes coil_span_y = rod_middle_y - span_crank_middle_y;
    const Lanes coil_span_rate_x = -crank_middle_vx + rod_middle_vx;
    const Lanes coil_span_rate_y = -crank_middle_vy + rod_middle_vy;
    const Lanes coil_length = lanes_sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const Lanes coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const Lanes coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);
    const Lanes coil_pull = coil_force/coil_length;
    const Lanes span_rod_tip_y = p->rod_tip_span_x*sin_theta_rod;
    const Lanes rod_tip_vx = crank_head_vx - rod_omega*span_rod_tip_y;
    const Lanes cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const Lanes sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const Lanes dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const Lanes cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* constraints: gamma */
    const Lanes rhs_slider_offset = (crank_omega * crank_omega)*span_crank_head_y
        + (rod_omega * rod_omega)*span_rod_com_y;

    /* L D L^T of the KKT matrix */
    const Lanes l_rod_theta__crank_theta = dot_crank_rod*p->inverse_mass_crank_crank;
    const Lanes l_slider_offset__crank_theta = p->inverse_mass_crank_crank*span_crank_head_x;
    const Lanes inverse_pivot_rod_theta = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta + p->mass_rod_rod);
    const Lanes w_slider_offset__rod_theta = -dot_crank_rod*l_slider_offset__crank_theta + span_rod_com_x;
    const Lanes l_slider_offset__rod_theta = inverse_pivot_rod_theta*w_slider_offset__rod_theta;
    const Lanes scale_slider_offset = l_slider_offset__crank_theta*span_crank_head_x
        + l_slider_offset__rod_theta*w_slider_offset__rod_theta;
    *rare |= ~((scale_slider_offset > 0.0) & (scale_slider_offset < INFINITY));
    const Lanes inverse_pivot_slider_offset = 1.0/scale_slider_offset;

    /* forward substitution */
    const Lanes z_crank_theta = -coil_pull*coil_span_x*span_crank_middle_y - coil_pull*coil_span_y*span_crank_head_x
        + coil_pull*coil_span_y*span_crank_middle_x + cross_crank_rod*(rod_omega * rod_omega)
        - span_crank_head_y*(-coil_pull*coil_span_x + p->push_value_x);
    const Lanes z_rod_theta = coil_pull*coil_span_x*span_rod_middle_y - coil_pull*coil_span_y*span_rod_middle_x
        - (crank_omega * crank_omega)*cross_crank_rod - l_rod_theta__crank_theta*z_crank_theta
        - p->push_value_x*span_rod_tip_y;
    const Lanes z_slider_offset = -l_slider_offset__crank_theta*z_crank_theta - l_slider_offset__rod_theta*z_rod_theta
        + rhs_slider_offset;

    /* backward substitution */
    const Lanes lambda_slider_offset = -inverse_pivot_slider_offset*z_slider_offset;
    const Lanes acceleration_rod_theta = inverse_pivot_rod_theta*z_rod_theta
        - l_slider_offset__rod_theta*lambda_slider_offset;
    const Lanes acceleration_crank_theta = -acceleration_rod_theta*l_rod_theta__crank_theta
        + p->inverse_mass_crank_crank*z_crank_theta - l_slider_offset__crank_theta*lambda_slider_offset;

    /* results */
    a[0] = acceleration_crank_theta;
    a[1] = acceleration_rod_theta;
    aside->lambda[0] = lambda_slider_offset;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = all_of(0.0);
    aside->power[1] = -p->coil_damping*(coil_length_rate * coil_length_rate) + p->push_value_x*rod_tip_vx;
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
    const Lanes crank_theta = q[0];
    const Lanes crank_omega = v[0];
    const Lanes rod_theta = q[1];
    const Lanes rod_omega = v[1];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(crank_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(rod_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_crank = cosines_0;
    const Lanes sin_theta_crank = sines_0;
    const Lanes cos_theta_rod = cosines_1;
    const Lanes sin_theta_rod = sines_1;
    const Lanes span_crank_head_x = cos_theta_crank*p->crank_length;
    const Lanes span_crank_head_y = p->crank_length*sin_theta_crank;
    const Lanes span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const Lanes span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const Lanes cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const Lanes dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;

    /* Phi and Phi_dot */
    const Lanes phi_slider_offset = span_crank_head_y + span_rod_com_y;
    const Lanes phi_dot_slider_offset = crank_omega*span_crank_head_x + rod_omega*span_rod_com_x;

    /* L D L^T of the KKT matrix */
    const Lanes l_rod_theta__crank_theta = dot_crank_rod*p->inverse_mass_crank_crank;
    const Lanes l_slider_offset__crank_theta = p->inverse_mass_crank_crank*span_crank_head_x;
    const Lanes inverse_pivot_rod_theta = 1.0/(-dot_crank_rod*l_rod_theta__crank_theta + p->mass_rod_rod);
    const Lanes w_slider_offset__rod_theta = -dot_crank_rod*l_slider_offset__crank_theta + span_rod_com_x;
    const Lanes l_slider_offset__rod_theta = inverse_pivot_rod_theta*w_slider_offset__rod_theta;
    const Lanes scale_slider_offset = l_slider_offset__crank_theta*span_crank_head_x
        + l_slider_offset__rod_theta*w_slider_offset__rod_theta;
    *rare |= ~((scale_slider_offset > 0.0) & (scale_slider_offset < INFINITY));
    const Lanes inverse_pivot_slider_offset = 1.0/scale_slider_offset;

    /* backward substitution */
    const Lanes dq_lambda_slider_offset = -inverse_pivot_slider_offset*phi_slider_offset;
    const Lanes dq_acceleration_rod_theta = -dq_lambda_slider_offset*l_slider_offset__rod_theta;
    const Lanes dq_acceleration_crank_theta = -dq_acceleration_rod_theta*l_rod_theta__crank_theta
        - dq_lambda_slider_offset*l_slider_offset__crank_theta;

    /* backward substitution */
    const Lanes dv_lambda_slider_offset = -inverse_pivot_slider_offset*phi_dot_slider_offset;
    const Lanes dv_acceleration_rod_theta = -dv_lambda_slider_offset*l_slider_offset__rod_theta;
    const Lanes dv_acceleration_crank_theta = -dv_acceleration_rod_theta*l_rod_theta__crank_theta
        - dv_lambda_slider_offset*l_slider_offset__crank_theta;

    /* results */
    dq[0] = dq_acceleration_crank_theta;
    dv[0] = dv_acceleration_crank_theta;
    dq[1] = dq_acceleration_rod_theta;
    dv[1] = dv_acceleration_rod_theta;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_slider_offset));
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
    const Lanes crank_theta = q[0];
    const Lanes crank_omega = v[0];
    const Lanes rod_theta = q[1];
    const Lanes rod_omega = v[1];
    const Lanes a_crank_theta = a[0];
    const Lanes a_rod_theta = a[1];
    const Lanes held_lambda_slider_offset = aside->lambda[0];

    /* directions, arms, drives */
    const Lanes cos_theta_crank = lanes_cos(crank_theta);
    const Lanes sin_theta_crank = lanes_sin(crank_theta);
    const Lanes cos_theta_rod = lanes_cos(rod_theta);
    const Lanes sin_theta_rod = lanes_sin(rod_theta);
    const Lanes span_crank_head_x = cos_theta_crank*p->crank_length;
    const Lanes span_crank_head_y = p->crank_length*sin_theta_crank;
    const Lanes crank_head_vx = -crank_omega*span_crank_head_y;
    const Lanes crank_head_vy = crank_omega*span_crank_head_x;
    const Lanes span_rod_com_x = cos_theta_rod*p->rod_com_span_x;
    const Lanes span_rod_com_y = p->rod_com_span_x*sin_theta_rod;
    const Lanes span_crank_middle_x = cos_theta_crank*p->crank_points_middle_x;
    const Lanes span_crank_middle_y = p->crank_points_middle_x*sin_theta_crank;
    const Lanes crank_middle_vx = -crank_omega*span_crank_middle_y;
    const Lanes crank_middle_vy = crank_omega*span_crank_middle_x;
    const Lanes span_rod_middle_x = cos_theta_rod*p->rod_middle_span_x;
    const Lanes span_rod_middle_y = p->rod_middle_span_x*sin_theta_rod;
    const Lanes rod_middle_x = span_crank_head_x + span_rod_middle_x;
    const Lanes rod_middle_vx = crank_head_vx - rod_omega*span_rod_middle_y;
    const Lanes rod_middle_y = span_crank_head_y + span_rod_middle_y;
    const Lanes rod_middle_vy = crank_head_vy + rod_omega*span_rod_middle_x;
    const Lanes coil_span_x = rod_middle_x - span_crank_middle_x;
    const Lanes coil_span_y = rod_middle_y - span_crank_middle_y;
    const Lanes coil_span_rate_x = -crank_middle_vx + rod_middle_vx;
    const Lanes coil_span_rate_y = -crank_middle_vy + rod_middle_vy;
    const Lanes coil_length = lanes_sqrt((coil_span_x * coil_span_x) + (coil_span_y * coil_span_y));
    const Lanes coil_length_rate = (coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)/coil_length;
    const Lanes coil_force = p->coil_damping*coil_length_rate + p->coil_stiffness*(-p->coil_free_length + coil_length);
    const Lanes coil_pull = coil_force/coil_length;
    const Lanes span_rod_tip_x = cos_theta_rod*p->rod_tip_span_x;
    const Lanes span_rod_tip_y = p->rod_tip_span_x*sin_theta_rod;
    const Lanes cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const Lanes sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const Lanes dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const Lanes cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* coordinates */
    const Lanes coil_span_x_by_crank_theta = -span_crank_head_y + span_crank_middle_y;
    const Lanes coil_span_y_by_crank_theta = span_crank_head_x - span_crank_middle_x;
    const Lanes inverse_sum = 1.0/(coil_length + 1e-150);
    const Lanes coil_length_by_crank_theta = coil_span_x*coil_span_x_by_crank_theta*inverse_sum
        + coil_span_y*coil_span_y_by_crank_theta*inverse_sum;
    const Lanes coil_length_by_rod_theta = -coil_span_x*inverse_sum*span_rod_middle_y
        + coil_span_y*inverse_sum*span_rod_middle_x;
    const Lanes crank_middle_vx_by_crank_theta = -crank_omega*span_crank_middle_x;
    const Lanes rod_middle_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const Lanes rod_middle_vx_by_rod_theta = -rod_omega*span_rod_middle_x;
    const Lanes coil_span_rate_x_by_crank_theta = -crank_middle_vx_by_crank_theta + rod_middle_vx_by_crank_theta;
    const Lanes coil_span_rate_x_by_crank_omega = -span_crank_head_y + span_crank_middle_y;
    const Lanes crank_middle_vy_by_crank_theta = -crank_omega*span_crank_middle_y;
    const Lanes rod_middle_vy_by_crank_theta = -crank_omega*span_crank_head_y;
    const Lanes rod_middle_vy_by_rod_theta = -rod_omega*span_rod_middle_y;
    const Lanes coil_span_rate_y_by_crank_theta = -crank_middle_vy_by_crank_theta + rod_middle_vy_by_crank_theta;
    const Lanes coil_span_rate_y_by_crank_omega = span_crank_head_x - span_crank_middle_x;
    const Lanes inverse_coil_length = 1.0/coil_length;
    const Lanes coil_length_rate_by_crank_theta = -coil_length_by_crank_theta*(inverse_coil_length
        * inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)
        + coil_span_rate_x*coil_span_x_by_crank_theta*inverse_coil_length
        + coil_span_rate_x_by_crank_theta*coil_span_x*inverse_coil_length
        + coil_span_rate_y*coil_span_y_by_crank_theta*inverse_coil_length
        + coil_span_rate_y_by_crank_theta*coil_span_y*inverse_coil_length;
    const Lanes coil_length_rate_by_rod_theta = -coil_length_by_rod_theta*(inverse_coil_length
        * inverse_coil_length)*(coil_span_rate_x*coil_span_x + coil_span_rate_y*coil_span_y)
        - coil_span_rate_x*inverse_coil_length*span_rod_middle_y
        + coil_span_rate_y*inverse_coil_length*span_rod_middle_x
        + coil_span_x*inverse_coil_length*rod_middle_vx_by_rod_theta
        + coil_span_y*inverse_coil_length*rod_middle_vy_by_rod_theta;
    const Lanes coil_length_rate_by_crank_omega = coil_span_rate_x_by_crank_omega*coil_span_x*inverse_coil_length
        + coil_span_rate_y_by_crank_omega*coil_span_y*inverse_coil_length;
    const Lanes coil_length_rate_by_rod_omega = -coil_span_x*inverse_coil_length*span_rod_middle_y
        + coil_span_y*inverse_coil_length*span_rod_middle_x;
    const Lanes coil_force_by_crank_theta = p->coil_damping*coil_length_rate_by_crank_theta
        + coil_length_by_crank_theta*p->coil_stiffness;
    const Lanes coil_force_by_rod_theta = p->coil_damping*coil_length_rate_by_rod_theta
        + coil_length_by_rod_theta*p->coil_stiffness;
    const Lanes coil_force_by_crank_omega = p->coil_damping*coil_length_rate_by_crank_omega;
    const Lanes coil_force_by_rod_omega = p->coil_damping*coil_length_rate_by_rod_omega;
    const Lanes coil_pull_by_crank_theta = -coil_force*coil_length_by_crank_theta*(inverse_coil_length
        * inverse_coil_length) + coil_force_by_crank_theta*inverse_coil_length;
    const Lanes coil_pull_by_rod_theta = -coil_force*coil_length_by_rod_theta*(inverse_coil_length
        * inverse_coil_length) + coil_force_by_rod_theta*inverse_coil_length;
    const Lanes coil_pull_by_crank_omega = coil_force_by_crank_omega*inverse_coil_length;
    const Lanes coil_pull_by_rod_omega = coil_force_by_rod_omega*inverse_coil_length;

    /* powers */
    const Lanes rod_tip_vx_by_crank_theta = -crank_omega*span_crank_head_x;
    const Lanes rod_tip_vx_by_rod_theta = -rod_omega*span_rod_tip_x;

    /* results */
    lin->value[0] = dot_crank_rod;
    lin->value[1] = span_crank_head_x;
    lin->value[2] = span_rod_com_x;
    lin->value[3] = -a_crank_theta*span_crank_head_y - (crank_omega * crank_omega)*span_crank_head_x
        - crank_omega*span_crank_head_y*p->two_alpha;
    lin->value[4] = -a_rod_theta*span_rod_com_y - (rod_omega * rod_omega)*span_rod_com_x
        - rod_omega*span_rod_com_y*p->two_alpha;
    lin->value[5] = a_rod_theta*cross_crank_rod + coil_pull*coil_span_x*span_crank_middle_x
        + coil_pull*coil_span_y*span_crank_middle_y + coil_pull_by_crank_theta*(-coil_span_x*span_crank_head_y
        + coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x)
        + coil_span_x_by_crank_theta*(-coil_pull*span_crank_head_y + coil_pull*span_crank_middle_y)
        + coil_span_y_by_crank_theta*(coil_pull*span_crank_head_x - coil_pull*span_crank_middle_x)
        + dot_crank_rod*(rod_omega * rod_omega) + span_crank_head_x*(-coil_pull*coil_span_x + p->push_value_x)
        - span_crank_head_y*(coil_pull*coil_span_y + held_lambda_slider_offset);
    lin->value[6] = -a_rod_theta*cross_crank_rod + coil_pull_by_rod_theta*(-coil_span_x*span_crank_head_y
        + coil_span_x*span_crank_middle_y + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x)
        - dot_crank_rod*(rod_omega * rod_omega) + span_rod_middle_x*(coil_pull*span_crank_head_x
        - coil_pull*span_crank_middle_x) - span_rod_middle_y*(-coil_pull*span_crank_head_y
        + coil_pull*span_crank_middle_y);
    lin->value[7] = a_crank_theta*cross_crank_rod - coil_pull*coil_span_x_by_crank_theta*span_rod_middle_y
        + coil_pull*coil_span_y_by_crank_theta*span_rod_middle_x
        + coil_pull_by_crank_theta*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x)
        - (crank_omega * crank_omega)*dot_crank_rod;
    lin->value[8] = -a_crank_theta*cross_crank_rod - coil_pull*coil_span_x*span_rod_middle_x
        - coil_pull*coil_span_y*span_rod_middle_y + coil_pull*(span_rod_middle_x * span_rod_middle_x)
        + coil_pull*(span_rod_middle_y * span_rod_middle_y) + coil_pull_by_rod_theta*(-coil_span_x*span_rod_middle_y
        + coil_span_y*span_rod_middle_x) + (crank_omega * crank_omega)*dot_crank_rod
        - held_lambda_slider_offset*span_rod_com_y + p->push_value_x*span_rod_tip_x;
    lin->value[9] = -2.0*crank_omega*span_crank_head_y;
    lin->value[10] = -2.0*rod_omega*span_rod_com_y;
    lin->value[11] = coil_pull_by_crank_omega*(-coil_span_x*span_crank_head_y + coil_span_x*span_crank_middle_y
        + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x);
    lin->value[12] = coil_pull_by_rod_omega*(-coil_span_x*span_crank_head_y + coil_span_x*span_crank_middle_y
        + coil_span_y*span_crank_head_x - coil_span_y*span_crank_middle_x) - 2.0*cross_crank_rod*rod_omega;
    lin->value[13] = coil_pull_by_crank_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x)
        + 2.0*crank_omega*cross_crank_rod;
    lin->value[14] = coil_pull_by_rod_omega*(-coil_span_x*span_rod_middle_y + coil_span_y*span_rod_middle_x);
    lin->value[15] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_crank_theta
        + p->push_value_x*rod_tip_vx_by_crank_theta;
    lin->value[16] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_rod_theta
        + p->push_value_x*rod_tip_vx_by_rod_theta;
    lin->value[17] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_crank_omega
        - p->push_value_x*span_crank_head_y;
    lin->value[18] = -2.0*p->coil_damping*coil_length_rate*coil_length_rate_by_rod_omega
        - p->push_value_x*span_rod_tip_y;
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
    const Lanes mass_crank_theta_rod_theta = lin->value[0];
    const Lanes phi_slider_offset_crank_theta = lin->value[1];
    const Lanes phi_slider_offset_rod_theta = lin->value[2];
    const Lanes by_q_slider_offset_crank_theta = lin->value[3];
    const Lanes by_q_slider_offset_rod_theta = lin->value[4];
    const Lanes by_q_crank_theta_crank_theta = lin->value[5];
    const Lanes by_q_crank_theta_rod_theta = lin->value[6];
    const Lanes by_q_rod_theta_crank_theta = lin->value[7];
    const Lanes by_q_rod_theta_rod_theta = lin->value[8];
    const Lanes by_v_slider_offset_crank_theta = lin->value[9];
    const Lanes by_v_slider_offset_rod_theta = lin->value[10];
    const Lanes by_v_crank_theta_crank_theta = lin->value[11];
    const Lanes by_v_crank_theta_rod_theta = lin->value[12];
    const Lanes by_v_rod_theta_crank_theta = lin->value[13];
    const Lanes by_v_rod_theta_rod_theta = lin->value[14];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_crank_theta__crank_theta = eta*(by_q_crank_theta_crank_theta*eta + by_v_crank_theta_crank_theta)
        + p->mass_crank_crank;
    const Lanes n_crank_theta__rod_theta = eta*(by_q_crank_theta_rod_theta*eta + by_v_crank_theta_rod_theta)
        + mass_crank_theta_rod_theta;
    const Lanes n_rod_theta__crank_theta = eta*(by_q_rod_theta_crank_theta*eta + by_v_rod_theta_crank_theta)
        + mass_crank_theta_rod_theta;
    const Lanes n_rod_theta__rod_theta = eta*(by_q_rod_theta_rod_theta*eta + by_v_rod_theta_rod_theta)
        + p->mass_rod_rod;
    const Lanes n_slider_offset__crank_theta = eta_row*(by_q_slider_offset_crank_theta*eta
        + by_v_slider_offset_crank_theta) + phi_slider_offset_crank_theta;
    const Lanes n_slider_offset__rod_theta = eta_row*(by_q_slider_offset_rod_theta*eta + by_v_slider_offset_rod_theta)
        + phi_slider_offset_rod_theta;

    /* L U */
    const Lanes scale_crank_theta = n_crank_theta__crank_theta;
    *rare |= ~(lanes_fabs(scale_crank_theta) > SINGULAR * lanes_fabs(n_crank_theta__crank_theta));
    const Lanes inverse_pivot_crank_theta = 1.0/scale_crank_theta;
    lin->lu[0] = inverse_pivot_crank_theta;
    const Lanes l_rod_theta__crank_theta = inverse_pivot_crank_theta*n_rod_theta__crank_theta;
    lin->lu[1] = l_rod_theta__crank_theta;
    lin->lu[2] = n_crank_theta__rod_theta;
    const Lanes l_slider_offset__crank_theta = inverse_pivot_crank_theta*n_slider_offset__crank_theta;
    lin->lu[3] = l_slider_offset__crank_theta;
    const Lanes scale_rod_theta = -l_rod_theta__crank_theta*n_crank_theta__rod_theta + n_rod_theta__rod_theta;
    *rare |= ~(lanes_fabs(scale_rod_theta) > SINGULAR * lanes_fabs(n_rod_theta__rod_theta));
    const Lanes inverse_pivot_rod_theta = 1.0/scale_rod_theta;
    lin->lu[4] = inverse_pivot_rod_theta;
    const Lanes l_slider_offset__rod_theta = inverse_pivot_rod_theta
        *(-l_slider_offset__crank_theta*n_crank_theta__rod_theta + n_slider_offset__rod_theta);
    lin->lu[5] = l_slider_offset__rod_theta;
    const Lanes u_rod_theta__slider_offset = -l_rod_theta__crank_theta*phi_slider_offset_crank_theta
        + phi_slider_offset_rod_theta;
    lin->lu[6] = u_rod_theta__slider_offset;
    const Lanes scale_slider_offset = -l_slider_offset__crank_theta*phi_slider_offset_crank_theta
        - l_slider_offset__rod_theta*u_rod_theta__slider_offset;
    *rare |= ~((lanes_fabs(scale_slider_offset) > 0.0) & (lanes_fabs(scale_slider_offset) < INFINITY));
    const Lanes inverse_pivot_slider_offset = 1.0/scale_slider_offset;
    lin->lu[7] = inverse_pivot_slider_offset;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_slider_offset_crank_theta = lin->value[1];
    const Lanes inverse_pivot_crank_theta = lin->lu[0];
    const Lanes l_rod_theta__crank_theta = lin->lu[1];
    const Lanes n_crank_theta__rod_theta = lin->lu[2];
    const Lanes l_slider_offset__crank_theta = lin->lu[3];
    const Lanes inverse_pivot_rod_theta = lin->lu[4];
    const Lanes l_slider_offset__rod_theta = lin->lu[5];
    const Lanes u_rod_theta__slider_offset = lin->lu[6];
    const Lanes inverse_pivot_slider_offset = lin->lu[7];

    /* forward */
    const Lanes b_crank_theta = x[0];
    const Lanes b_rod_theta = -b_crank_theta*l_rod_theta__crank_theta + x[1];
    const Lanes b_slider_offset = -b_crank_theta*l_slider_offset__crank_theta - b_rod_theta*l_slider_offset__rod_theta
        + x[2];

    /* backward */
    const Lanes x_slider_offset = b_slider_offset*inverse_pivot_slider_offset;
    x[2] = x_slider_offset;
    const Lanes x_rod_theta = inverse_pivot_rod_theta*(b_rod_theta - u_rod_theta__slider_offset*x_slider_offset);
    x[1] = x_rod_theta;
    const Lanes x_crank_theta = inverse_pivot_crank_theta*(b_crank_theta - n_crank_theta__rod_theta*x_rod_theta
        - phi_slider_offset_crank_theta*x_slider_offset);
    x[0] = x_crank_theta;
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
    const Lanes mass_crank_theta_rod_theta = lin->value[0];
    const Lanes phi_slider_offset_crank_theta = lin->value[1];
    const Lanes phi_slider_offset_rod_theta = lin->value[2];
    const Lanes by_q_slider_offset_crank_theta = lin->value[3];
    const Lanes by_q_slider_offset_rod_theta = lin->value[4];
    const Lanes by_q_crank_theta_crank_theta = lin->value[5];
    const Lanes by_q_crank_theta_rod_theta = lin->value[6];
    const Lanes by_q_rod_theta_crank_theta = lin->value[7];
    const Lanes by_q_rod_theta_rod_theta = lin->value[8];
    const Lanes power_q_1_crank_theta = lin->value[15];
    const Lanes power_q_1_rod_theta = lin->value[16];
    const Lanes power_v_1_crank_theta = lin->value[17];
    const Lanes power_v_1_rod_theta = lin->value[18];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[3];
    const Lanes shifted_crank_theta = -p->beta_squared*eta*r[0] + r[2];
    const Lanes shifted_rod_theta = -p->beta_squared*eta*r[1] + r[3];
    x[0] = eta*(-by_q_crank_theta_crank_theta*eta*r[0] - by_q_crank_theta_rod_theta*eta*r[1] + p->mass_crank_crank*r[2]
        + mass_crank_theta_rod_theta*r[3]);
    x[1] = eta*(-by_q_rod_theta_crank_theta*eta*r[0] - by_q_rod_theta_rod_theta*eta*r[1]
        + mass_crank_theta_rod_theta*r[2] + p->mass_rod_rod*r[3]);
    x[2] = eta_row*(-by_q_slider_offset_crank_theta*eta*r[0] - by_q_slider_offset_rod_theta*eta*r[1]
        + phi_slider_offset_crank_theta*shifted_crank_theta + phi_slider_offset_rod_theta*shifted_rod_theta);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[2] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[3] = x[1];
    u[4] = eta*r[4];
    u[5] = eta*(power_q_1_crank_theta*u[0] + power_q_1_rod_theta*u[1] + power_v_1_crank_theta*u[2]
        + power_v_1_rod_theta*u[3] + r[5]);
    u[6] = eta*r[6];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
