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
    Lanes half_mass;
    Lanes par_r;
    Lanes omega;
    Lanes axle_mass;
    Lanes axle_inertia;
    Lanes road_mass;
    Lanes road_inertia;
    Lanes axle_length;
    Lanes road_length;
    Lanes alpha;
    Lanes beta;
    Lanes slot_direction_y;
    Lanes gravity_y;
    Lanes left_stiffness;
    Lanes left_free_length;
    Lanes right_stiffness;
    Lanes right_free_length;
    Lanes set_axle_y;
    Lanes set_axle_theta;
    Lanes rates_axle_vy;
    Lanes rates_axle_omega;
    Lanes axle_head_s_x;
    Lanes road_head_s_x;
    Lanes weight_axle_y;
    Lanes weight_road_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_axle_mass;
    Lanes inverse_axle_inertia;
    Lanes inverse_road_mass;
    Lanes inverse_road_inertia;
    Lanes axle_tail_span_x;
    Lanes road_head_span_x;
    Lanes inertia_road_road;
    Lanes mass_bump_bump;
    Lanes weight_road__across;
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
    const Lanes axle_x = q[0];
    const Lanes axle_y = q[1];
    const Lanes axle_theta = q[2];

    /* directions, arms, drives */
    const Lanes bump_value = lanes_asin(p->par_r*lanes_sin(p->omega*t)/p->length);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road = cosines_0;
    const Lanes sin_theta_road = sines_0;
    const Lanes cos_theta_axle = cosines_1;
    const Lanes sin_theta_axle = sines_1;
    const Lanes span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const Lanes span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* rows */
    /* slot.offset */
    out[0] = -axle_x*cos_theta_road - axle_y*sin_theta_road - cos_theta_road*span_axle_tail_x
        - sin_theta_road*span_axle_tail_y;
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    /* coordinates, velocities, time */
    const Lanes axle_x = q[0];
    const Lanes axle_x_rate = v[0];
    const Lanes axle_y = q[1];
    const Lanes axle_y_rate = v[1];
    const Lanes axle_theta = q[2];
    const Lanes axle_omega = v[2];

    /* directions, arms, drives */
    const Lanes bump_value = lanes_asin(p->par_r*lanes_sin(p->omega*t)/p->length);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road = cosines_0;
    const Lanes sin_theta_road = sines_0;
    const Lanes cos_theta_axle = cosines_1;
    const Lanes sin_theta_axle = sines_1;
    const Lanes bump_rate = p->omega*p->par_r*lanes_cos(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)));
    const Lanes span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const Lanes span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* rows */
    /* slot.offset */
    out[0] = axle_omega*(cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x)
        - axle_x_rate*cos_theta_road - axle_y_rate*sin_theta_road
        + bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y) - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);
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
    const Lanes axle_x = q[0];
    const Lanes axle_x_rate = v[0];
    const Lanes axle_y = q[1];
    const Lanes axle_y_rate = v[1];
    const Lanes axle_theta = q[2];
    const Lanes axle_omega = v[2];

    /* directions, arms, drives */
    const Lanes bump_value = lanes_asin(p->par_r*lanes_sin(p->omega*t)/p->length);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road = cosines_0;
    const Lanes sin_theta_road = sines_0;
    const Lanes cos_theta_axle = cosines_1;
    const Lanes sin_theta_axle = sines_1;
    const Lanes bump_rate = p->omega*p->par_r*lanes_cos(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)));
    const Lanes bump_acceleration = -(p->omega * p->omega)*p->par_r*lanes_sin(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*lanes_sin(p->omega*t)*(lanes_cos(p->omega*t)
        * lanes_cos(p->omega*t))/((p->length * p->length * p->length)*lanes_pow(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length), all_of(1.5)));
    const Lanes span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const Lanes span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;
    const Lanes axle_tail_x = axle_x + span_axle_tail_x;
    const Lanes axle_tail_y = axle_y + span_axle_tail_y;
    const Lanes left_length = lanes_sqrt((axle_tail_x * axle_tail_x) + (axle_tail_y * axle_tail_y));
    const Lanes left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const Lanes left_pull = left_force/left_length;
    const Lanes span_road_head_x = cos_theta_road*p->road_head_span_x;
    const Lanes span_road_head_y = p->road_head_span_x*sin_theta_road;
    const Lanes axle_head_x = axle_x - span_axle_tail_x;
    const Lanes axle_head_y = axle_y - span_axle_tail_y;
    const Lanes right_span_x = axle_head_x - span_road_head_x;
    const Lanes right_span_y = axle_head_y - span_road_head_y;
    const Lanes right_length = lanes_sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const Lanes right_force = p->right_stiffness*(-p->right_free_length + right_length);
    const Lanes right_pull = right_force/right_length;

    /* constraints: gamma */
    const Lanes rhs_slot_offset = -axle_omega*(axle_omega*cos_theta_road*span_axle_tail_x
        + axle_omega*sin_theta_road*span_axle_tail_y) - bump_acceleration*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + (bump_rate * bump_rate)*cos_theta_road*(-axle_x
        - span_axle_tail_x) + (bump_rate * bump_rate)*sin_theta_road*(-axle_y - span_axle_tail_y)
        - 2.0*bump_rate*cos_theta_road*(-axle_omega*span_axle_tail_x - axle_y_rate)
        + 2.0*bump_rate*sin_theta_road*(axle_omega*span_axle_tail_y - axle_x_rate);

    /* L D L^T of the KKT matrix */
    const Lanes l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const Lanes l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const Lanes w_slot_offset__axle_theta = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    const Lanes l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const Lanes scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road;
    *rare |= ~((scale_slot_offset > 0.0) & (scale_slot_offset < INFINITY));
    const Lanes inverse_pivot_slot_offset = 1.0/scale_slot_offset;

    /* forward substitution */
    const Lanes z_axle_x = -axle_tail_x*left_pull - right_pull*right_span_x;
    const Lanes z_axle_y = -axle_tail_y*left_pull - right_pull*right_span_y + p->weight_axle_y;
    const Lanes z_axle_theta = span_axle_tail_x*(-axle_tail_y*left_pull + right_pull*right_span_y)
        - span_axle_tail_y*(-axle_tail_x*left_pull + right_pull*right_span_x);
    const Lanes z_slot_offset = -l_slot_offset__axle_theta*z_axle_theta - l_slot_offset__axle_x*z_axle_x
        - l_slot_offset__axle_y*z_axle_y + rhs_slot_offset;

    /* backward substitution */
    const Lanes lambda_slot_offset = -inverse_pivot_slot_offset*z_slot_offset;
    const Lanes acceleration_axle_theta = p->inverse_axle_inertia*z_axle_theta
        - l_slot_offset__axle_theta*lambda_slot_offset;
    const Lanes acceleration_axle_y = p->inverse_axle_mass*z_axle_y - l_slot_offset__axle_y*lambda_slot_offset;
    const Lanes acceleration_axle_x = p->inverse_axle_mass*z_axle_x - l_slot_offset__axle_x*lambda_slot_offset;

    /* results */
    a[0] = acceleration_axle_x;
    a[1] = acceleration_axle_y;
    a[2] = acceleration_axle_theta;
    aside->lambda[0] = lambda_slot_offset;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = -aside->lambda[0]*(-bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y)
        + bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x))
        + bump_rate*(bump_acceleration*p->mass_bump_bump - cos_theta_road*p->weight_road__across
        + right_pull*right_span_x*span_road_head_y - right_pull*right_span_y*span_road_head_x);
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
    const Lanes axle_x = q[0];
    const Lanes axle_x_rate = v[0];
    const Lanes axle_y = q[1];
    const Lanes axle_y_rate = v[1];
    const Lanes axle_theta = q[2];
    const Lanes axle_omega = v[2];

    /* directions, arms, drives */
    const Lanes bump_value = lanes_asin(p->par_r*lanes_sin(p->omega*t)/p->length);
    Lanes sines_0, cosines_0;
    sines_and_cosines(bump_value, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(axle_theta, &sines_1, &cosines_1, rare);
    const Lanes cos_theta_road = cosines_0;
    const Lanes sin_theta_road = sines_0;
    const Lanes cos_theta_axle = cosines_1;
    const Lanes sin_theta_axle = sines_1;
    const Lanes bump_rate = p->omega*p->par_r*lanes_cos(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)));
    const Lanes span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const Lanes span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;

    /* Phi and Phi_dot */
    const Lanes phi_slot_offset = -axle_x*cos_theta_road - axle_y*sin_theta_road - cos_theta_road*span_axle_tail_x
        - sin_theta_road*span_axle_tail_y;
    const Lanes phi_dot_slot_offset = axle_omega*(cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x)
        - axle_x_rate*cos_theta_road - axle_y_rate*sin_theta_road
        + bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y) - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);

    /* L D L^T of the KKT matrix */
    const Lanes l_slot_offset__axle_x = -cos_theta_road*p->inverse_axle_mass;
    const Lanes l_slot_offset__axle_y = -p->inverse_axle_mass*sin_theta_road;
    const Lanes w_slot_offset__axle_theta = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    const Lanes l_slot_offset__axle_theta = p->inverse_axle_inertia*w_slot_offset__axle_theta;
    const Lanes scale_slot_offset = -cos_theta_road*l_slot_offset__axle_x
        + l_slot_offset__axle_theta*w_slot_offset__axle_theta - l_slot_offset__axle_y*sin_theta_road;
    *rare |= ~((scale_slot_offset > 0.0) & (scale_slot_offset < INFINITY));
    const Lanes inverse_pivot_slot_offset = 1.0/scale_slot_offset;

    /* backward substitution */
    const Lanes dq_lambda_slot_offset = -inverse_pivot_slot_offset*phi_slot_offset;
    const Lanes dq_acceleration_axle_theta = -dq_lambda_slot_offset*l_slot_offset__axle_theta;
    const Lanes dq_acceleration_axle_y = -dq_lambda_slot_offset*l_slot_offset__axle_y;
    const Lanes dq_acceleration_axle_x = -dq_lambda_slot_offset*l_slot_offset__axle_x;

    /* backward substitution */
    const Lanes dv_lambda_slot_offset = -inverse_pivot_slot_offset*phi_dot_slot_offset;
    const Lanes dv_acceleration_axle_theta = -dv_lambda_slot_offset*l_slot_offset__axle_theta;
    const Lanes dv_acceleration_axle_y = -dv_lambda_slot_offset*l_slot_offset__axle_y;
    const Lanes dv_acceleration_axle_x = -dv_lambda_slot_offset*l_slot_offset__axle_x;

    /* results */
    dq[0] = dq_acceleration_axle_x;
    dv[0] = dv_acceleration_axle_x;
    dq[1] = dq_acceleration_axle_y;
    dv[1] = dv_acceleration_axle_y;
    dq[2] = dq_acceleration_axle_theta;
    dv[2] = dv_acceleration_axle_theta;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_slot_offset));
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
    const Lanes axle_x = q[0];
    const Lanes axle_x_rate = v[0];
    const Lanes axle_y = q[1];
    const Lanes axle_y_rate = v[1];
    const Lanes axle_theta = q[2];
    const Lanes axle_omega = v[2];
    const Lanes a_axle_x = a[0];
    const Lanes a_axle_y = a[1];
    const Lanes a_axle_theta = a[2];
    const Lanes held_lambda_slot_offset = aside->lambda[0];

    /* directions, arms, drives */
    const Lanes bump_value = lanes_asin(p->par_r*lanes_sin(p->omega*t)/p->length);
    const Lanes bump_rate = p->omega*p->par_r*lanes_cos(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)));
    const Lanes bump_acceleration = -(p->omega * p->omega)*p->par_r*lanes_sin(p->omega*t)/(p->length*lanes_sqrt(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length)))
        + (p->omega * p->omega)*(p->par_r * p->par_r * p->par_r)*lanes_sin(p->omega*t)*(lanes_cos(p->omega*t)
        * lanes_cos(p->omega*t))/((p->length * p->length * p->length)*lanes_pow(1.0
        - (p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))/(p->length * p->length), all_of(1.5)));
    const Lanes cos_theta_road = lanes_cos(bump_value);
    const Lanes sin_theta_road = lanes_sin(bump_value);
    const Lanes cos_theta_axle = lanes_cos(axle_theta);
    const Lanes sin_theta_axle = lanes_sin(axle_theta);
    const Lanes span_axle_tail_x = p->axle_tail_span_x*cos_theta_axle;
    const Lanes span_axle_tail_y = p->axle_tail_span_x*sin_theta_axle;
    const Lanes axle_tail_x = axle_x + span_axle_tail_x;
    const Lanes axle_tail_y = axle_y + span_axle_tail_y;
    const Lanes left_length = lanes_sqrt((axle_tail_x * axle_tail_x) + (axle_tail_y * axle_tail_y));
    const Lanes left_force = p->left_stiffness*(-p->left_free_length + left_length);
    const Lanes left_pull = left_force/left_length;
    const Lanes span_road_head_x = cos_theta_road*p->road_head_span_x;
    const Lanes span_road_head_y = p->road_head_span_x*sin_theta_road;
    const Lanes axle_head_x = axle_x - span_axle_tail_x;
    const Lanes axle_head_y = axle_y - span_axle_tail_y;
    const Lanes right_span_x = axle_head_x - span_road_head_x;
    const Lanes right_span_y = axle_head_y - span_road_head_y;
    const Lanes right_length = lanes_sqrt((right_span_x * right_span_x) + (right_span_y * right_span_y));
    const Lanes right_force = p->right_stiffness*(-p->right_free_length + right_length);
    const Lanes right_pull = right_force/right_length;

    /* constraints */
    const Lanes inverse_length = 1.0/p->length;
    const Lanes bump_acceleration_by_time = 3.0*lanes_pow(inverse_length,
        all_of(5.0))*(p->omega * p->omega * p->omega)*lanes_pow(p->par_r,
        all_of(5.0))*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))*(lanes_cos(p->omega*t) * lanes_cos(p->omega*t)
        * lanes_cos(p->omega*t))/lanes_pow(-(inverse_length * inverse_length)*(p->par_r
        * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t)) + 1.0, all_of(2.5))
        - 3.0*(inverse_length * inverse_length * inverse_length)*(p->omega * p->omega * p->omega)*(p->par_r * p->par_r
        * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t))*lanes_cos(p->omega*t)/lanes_pow(-(inverse_length
        * inverse_length)*(p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t)) + 1.0, all_of(1.5))
        + (inverse_length * inverse_length * inverse_length)*(p->omega * p->omega * p->omega)*(p->par_r * p->par_r
        * p->par_r)*(lanes_cos(p->omega*t) * lanes_cos(p->omega*t)
        * lanes_cos(p->omega*t))/lanes_pow(-(inverse_length * inverse_length)*(p->par_r
        * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t)) + 1.0, all_of(1.5))
        - inverse_length*(p->omega * p->omega * p->omega)*p->par_r*lanes_cos(p->omega*t)/lanes_sqrt(-(inverse_length
        * inverse_length)*(p->par_r * p->par_r)*(lanes_sin(p->omega*t) * lanes_sin(p->omega*t)) + 1.0);
    const Lanes cos_theta_road_by_time = -bump_rate*sin_theta_road;
    const Lanes sin_theta_road_by_time = bump_rate*cos_theta_road;

    /* coordinates */
    const Lanes inverse_sum = 1.0/(left_length + 1e-150);
    const Lanes left_length_by_axle_x = axle_tail_x*inverse_sum;
    const Lanes left_length_by_axle_theta = -axle_tail_x*inverse_sum*span_axle_tail_y
        + axle_tail_y*inverse_sum*span_axle_tail_x;
    const Lanes left_length_by_axle_y = axle_tail_y*inverse_sum;
    const Lanes left_force_by_axle_x = left_length_by_axle_x*p->left_stiffness;
    const Lanes left_force_by_axle_theta = left_length_by_axle_theta*p->left_stiffness;
    const Lanes left_force_by_axle_y = left_length_by_axle_y*p->left_stiffness;
    const Lanes inverse_left_length = 1.0/left_length;
    const Lanes left_pull_by_axle_x = -(inverse_left_length * inverse_left_length)*left_force*left_length_by_axle_x
        + inverse_left_length*left_force_by_axle_x;
    const Lanes left_pull_by_axle_theta = -(inverse_left_length
        * inverse_left_length)*left_force*left_length_by_axle_theta + inverse_left_length*left_force_by_axle_theta;
    const Lanes left_pull_by_axle_y = -(inverse_left_length * inverse_left_length)*left_force*left_length_by_axle_y
        + inverse_left_length*left_force_by_axle_y;
    const Lanes span_road_head_x_by_time = -bump_rate*span_road_head_y;
    const Lanes span_road_head_y_by_time = bump_rate*span_road_head_x;
    const Lanes inverse_sum_2 = 1.0/(right_length + 1e-150);
    const Lanes right_length_by_axle_x = inverse_sum_2*right_span_x;
    const Lanes right_length_by_axle_theta = inverse_sum_2*right_span_x*span_axle_tail_y
        - inverse_sum_2*right_span_y*span_axle_tail_x;
    const Lanes right_length_by_time = -inverse_sum_2*right_span_x*span_road_head_x_by_time
        - inverse_sum_2*right_span_y*span_road_head_y_by_time;
    const Lanes right_length_by_axle_y = inverse_sum_2*right_span_y;
    const Lanes right_force_by_axle_x = right_length_by_axle_x*p->right_stiffness;
    const Lanes right_force_by_axle_theta = right_length_by_axle_theta*p->right_stiffness;
    const Lanes right_force_by_time = right_length_by_time*p->right_stiffness;
    const Lanes right_force_by_axle_y = right_length_by_axle_y*p->right_stiffness;
    const Lanes inverse_right_length = 1.0/right_length;
    const Lanes right_pull_by_axle_x = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_x + inverse_right_length*right_force_by_axle_x;
    const Lanes right_pull_by_axle_theta = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_theta + inverse_right_length*right_force_by_axle_theta;
    const Lanes right_pull_by_time = -(inverse_right_length * inverse_right_length)*right_force*right_length_by_time
        + inverse_right_length*right_force_by_time;
    const Lanes right_pull_by_axle_y = -(inverse_right_length
        * inverse_right_length)*right_force*right_length_by_axle_y + inverse_right_length*right_force_by_axle_y;

    /* results */
    lin->value[0] = -cos_theta_road;
    lin->value[1] = -sin_theta_road;
    lin->value[2] = cos_theta_road*span_axle_tail_y - sin_theta_road*span_axle_tail_x;
    lin->value[3] = bump_acceleration*sin_theta_road + (bump_rate * bump_rate)*cos_theta_road
        + bump_rate*sin_theta_road*p->two_alpha;
    lin->value[4] = -bump_acceleration*cos_theta_road + (bump_rate * bump_rate)*sin_theta_road
        - bump_rate*cos_theta_road*p->two_alpha;
    lin->value[5] = span_axle_tail_x*(a_axle_theta*cos_theta_road + (axle_omega * axle_omega)*sin_theta_road
        - 2.0*axle_omega*bump_rate*sin_theta_road - bump_acceleration*cos_theta_road
        + (bump_rate * bump_rate)*sin_theta_road) - span_axle_tail_y*(-a_axle_theta*sin_theta_road
        + (axle_omega * axle_omega)*cos_theta_road - 2.0*axle_omega*bump_rate*cos_theta_road
        + bump_acceleration*sin_theta_road + (bump_rate * bump_rate)*cos_theta_road)
        + p->two_alpha*(span_axle_tail_x*(axle_omega*cos_theta_road - bump_rate*cos_theta_road)
        - span_axle_tail_y*(-axle_omega*sin_theta_road + bump_rate*sin_theta_road));
    lin->value[6] = axle_tail_x*left_pull_by_axle_x + left_pull + right_pull + right_pull_by_axle_x*right_span_x;
    lin->value[7] = axle_tail_x*left_pull_by_axle_theta - left_pull*span_axle_tail_y + right_pull*span_axle_tail_y
        + right_pull_by_axle_theta*right_span_x;
    lin->value[8] = axle_tail_x*left_pull_by_axle_y + right_pull_by_axle_y*right_span_x;
    lin->value[9] = axle_tail_y*left_pull_by_axle_y + left_pull + right_pull + right_pull_by_axle_y*right_span_y;
    lin->value[10] = axle_tail_y*left_pull_by_axle_theta + left_pull*span_axle_tail_x - right_pull*span_axle_tail_x
        + right_pull_by_axle_theta*right_span_y;
    lin->value[11] = axle_tail_y*left_pull_by_axle_x + right_pull_by_axle_x*right_span_y;
    lin->value[12] = -left_pull*span_axle_tail_y + left_pull_by_axle_x*(-axle_tail_x*span_axle_tail_y
        + axle_tail_y*span_axle_tail_x) + right_pull*span_axle_tail_y
        + right_pull_by_axle_x*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[13] = left_pull*(span_axle_tail_x * span_axle_tail_x) + left_pull*(span_axle_tail_y * span_axle_tail_y)
        + left_pull_by_axle_theta*(-axle_tail_x*span_axle_tail_y + axle_tail_y*span_axle_tail_x)
        + right_pull*(span_axle_tail_x * span_axle_tail_x) + right_pull*(span_axle_tail_y * span_axle_tail_y)
        + right_pull_by_axle_theta*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x)
        + span_axle_tail_x*(-axle_tail_x*left_pull + cos_theta_road*held_lambda_slot_offset + right_pull*right_span_x)
        - span_axle_tail_y*(axle_tail_y*left_pull - held_lambda_slot_offset*sin_theta_road - right_pull*right_span_y);
    lin->value[14] = left_pull*span_axle_tail_x + left_pull_by_axle_y*(-axle_tail_x*span_axle_tail_y
        + axle_tail_y*span_axle_tail_x) - right_pull*span_axle_tail_x
        + right_pull_by_axle_y*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[15] = axle_omega*cos_theta_road*span_axle_tail_x + axle_omega*sin_theta_road*span_axle_tail_y
        + axle_omega*(cos_theta_road*span_axle_tail_x + sin_theta_road*span_axle_tail_y)
        - 2.0*bump_rate*cos_theta_road*span_axle_tail_x - 2.0*bump_rate*sin_theta_road*span_axle_tail_y;
    lin->value[16] = 2.0*bump_rate*sin_theta_road;
    lin->value[17] = -2.0*bump_rate*cos_theta_road;
    lin->value[18] = p->beta_squared*(cos_theta_road_by_time*(-axle_x - span_axle_tail_x)
        + sin_theta_road_by_time*(-axle_y - span_axle_tail_y))
        + bump_acceleration*(-2.0*bump_rate*cos_theta_road*(-axle_x - span_axle_tail_x)
        - 2.0*bump_rate*sin_theta_road*(-axle_y - span_axle_tail_y)
        + 2.0*cos_theta_road*(-axle_omega*span_axle_tail_x - axle_y_rate)
        - 2.0*sin_theta_road*(axle_omega*span_axle_tail_y - axle_x_rate))
        + bump_acceleration_by_time*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + cos_theta_road_by_time*(a_axle_theta*span_axle_tail_y
        - a_axle_x + (axle_omega * axle_omega)*span_axle_tail_x + bump_acceleration*(-axle_y - span_axle_tail_y)
        - (bump_rate * bump_rate)*(-axle_x - span_axle_tail_x)
        + 2.0*bump_rate*(-axle_omega*span_axle_tail_x - axle_y_rate))
        + sin_theta_road_by_time*(-a_axle_theta*span_axle_tail_x - a_axle_y
        + (axle_omega * axle_omega)*span_axle_tail_y + bump_acceleration*(axle_x + span_axle_tail_x)
        - (bump_rate * bump_rate)*(-axle_y - span_axle_tail_y)
        - 2.0*bump_rate*(axle_omega*span_axle_tail_y - axle_x_rate))
        + p->two_alpha*(bump_acceleration*(cos_theta_road*(-axle_y - span_axle_tail_y)
        - sin_theta_road*(-axle_x - span_axle_tail_x)) + cos_theta_road_by_time*(axle_omega*span_axle_tail_y
        - axle_x_rate + bump_rate*(-axle_y - span_axle_tail_y))
        + sin_theta_road_by_time*(-axle_omega*span_axle_tail_x - axle_y_rate - bump_rate*(-axle_x - span_axle_tail_x)));
    lin->value[19] = -cos_theta_road_by_time*held_lambda_slot_offset - right_pull*span_road_head_x_by_time
        + right_pull_by_time*right_span_x;
    lin->value[20] = -held_lambda_slot_offset*sin_theta_road_by_time - right_pull*span_road_head_y_by_time
        + right_pull_by_time*right_span_y;
    lin->value[21] = cos_theta_road_by_time*held_lambda_slot_offset*span_axle_tail_y
        - held_lambda_slot_offset*sin_theta_road_by_time*span_axle_tail_x
        + right_pull*span_axle_tail_x*span_road_head_y_by_time - right_pull*span_axle_tail_y*span_road_head_x_by_time
        + right_pull_by_time*(right_span_x*span_axle_tail_y - right_span_y*span_axle_tail_x);
    lin->value[22] = bump_rate*held_lambda_slot_offset*sin_theta_road + bump_rate*right_pull*span_road_head_y
        + bump_rate*right_pull_by_axle_x*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[23] = -bump_rate*cos_theta_road*held_lambda_slot_offset - bump_rate*right_pull*span_road_head_x
        + bump_rate*right_pull_by_axle_y*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[24] = -bump_rate*cos_theta_road*held_lambda_slot_offset*span_axle_tail_x
        - bump_rate*held_lambda_slot_offset*sin_theta_road*span_axle_tail_y
        + bump_rate*right_pull*span_axle_tail_x*span_road_head_x
        + bump_rate*right_pull*span_axle_tail_y*span_road_head_y
        + bump_rate*right_pull_by_axle_theta*(right_span_x*span_road_head_y - right_span_y*span_road_head_x);
    lin->value[25] = bump_rate*cos_theta_road*(-axle_y - span_axle_tail_y)
        - bump_rate*sin_theta_road*(-axle_x - span_axle_tail_x);
    lin->value[26] = bump_acceleration*(bump_acceleration*p->mass_bump_bump - cos_theta_road*p->weight_road__across
        - held_lambda_slot_offset*(-cos_theta_road*(-axle_y - span_axle_tail_y)
        + sin_theta_road*(-axle_x - span_axle_tail_x)) + right_pull*right_span_x*span_road_head_y
        - right_pull*right_span_y*span_road_head_x) + bump_acceleration_by_time*bump_rate*p->mass_bump_bump
        - bump_rate*held_lambda_slot_offset*sin_theta_road_by_time*(-axle_x - span_axle_tail_x)
        + bump_rate*right_pull*right_span_x*span_road_head_y_by_time
        - bump_rate*right_pull*right_span_y*span_road_head_x_by_time
        + bump_rate*right_pull*span_road_head_x*span_road_head_y_by_time
        - bump_rate*right_pull*span_road_head_x_by_time*span_road_head_y
        + bump_rate*right_pull_by_time*(right_span_x*span_road_head_y - right_span_y*span_road_head_x)
        + cos_theta_road_by_time*(bump_rate*held_lambda_slot_offset*(-axle_y - span_axle_tail_y)
        - bump_rate*p->weight_road__across);
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
    const Lanes phi_slot_offset_axle_x = lin->value[0];
    const Lanes phi_slot_offset_axle_y = lin->value[1];
    const Lanes phi_slot_offset_axle_theta = lin->value[2];
    const Lanes by_q_slot_offset_axle_x = lin->value[3];
    const Lanes by_q_slot_offset_axle_y = lin->value[4];
    const Lanes by_q_slot_offset_axle_theta = lin->value[5];
    const Lanes by_q_axle_x_axle_x = lin->value[6];
    const Lanes by_q_axle_x_axle_theta = lin->value[7];
    const Lanes by_q_axle_x_axle_y = lin->value[8];
    const Lanes by_q_axle_y_axle_y = lin->value[9];
    const Lanes by_q_axle_y_axle_theta = lin->value[10];
    const Lanes by_q_axle_y_axle_x = lin->value[11];
    const Lanes by_q_axle_theta_axle_x = lin->value[12];
    const Lanes by_q_axle_theta_axle_theta = lin->value[13];
    const Lanes by_q_axle_theta_axle_y = lin->value[14];
    const Lanes by_v_slot_offset_axle_theta = lin->value[15];
    const Lanes by_v_slot_offset_axle_x = lin->value[16];
    const Lanes by_v_slot_offset_axle_y = lin->value[17];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_axle_x__axle_x = p->axle_mass + by_q_axle_x_axle_x*(eta * eta);
    const Lanes n_axle_x__axle_y = by_q_axle_x_axle_y*(eta * eta);
    const Lanes n_axle_x__axle_theta = by_q_axle_x_axle_theta*(eta * eta);
    const Lanes n_axle_y__axle_x = by_q_axle_y_axle_x*(eta * eta);
    const Lanes n_axle_y__axle_y = p->axle_mass + by_q_axle_y_axle_y*(eta * eta);
    const Lanes n_axle_y__axle_theta = by_q_axle_y_axle_theta*(eta * eta);
    const Lanes n_axle_theta__axle_x = by_q_axle_theta_axle_x*(eta * eta);
    const Lanes n_axle_theta__axle_y = by_q_axle_theta_axle_y*(eta * eta);
    const Lanes n_axle_theta__axle_theta = p->axle_inertia + by_q_axle_theta_axle_theta*(eta * eta);
    const Lanes n_slot_offset__axle_x = eta_row*(by_q_slot_offset_axle_x*eta + by_v_slot_offset_axle_x)
        + phi_slot_offset_axle_x;
    const Lanes n_slot_offset__axle_y = eta_row*(by_q_slot_offset_axle_y*eta + by_v_slot_offset_axle_y)
        + phi_slot_offset_axle_y;
    const Lanes n_slot_offset__axle_theta = eta_row*(by_q_slot_offset_axle_theta*eta + by_v_slot_offset_axle_theta)
        + phi_slot_offset_axle_theta;

    /* L U */
    const Lanes scale_axle_x = n_axle_x__axle_x;
    *rare |= ~(lanes_fabs(scale_axle_x) > SINGULAR * lanes_fabs(n_axle_x__axle_x));
    const Lanes inverse_pivot_axle_x = 1.0/scale_axle_x;
    lin->lu[0] = inverse_pivot_axle_x;
    const Lanes l_axle_y__axle_x = inverse_pivot_axle_x*n_axle_y__axle_x;
    lin->lu[1] = l_axle_y__axle_x;
    lin->lu[2] = n_axle_x__axle_y;
    const Lanes l_axle_theta__axle_x = inverse_pivot_axle_x*n_axle_theta__axle_x;
    lin->lu[3] = l_axle_theta__axle_x;
    lin->lu[4] = n_axle_x__axle_theta;
    const Lanes l_slot_offset__axle_x = inverse_pivot_axle_x*n_slot_offset__axle_x;
    lin->lu[5] = l_slot_offset__axle_x;
    const Lanes scale_axle_y = -l_axle_y__axle_x*n_axle_x__axle_y + n_axle_y__axle_y;
    *rare |= ~(lanes_fabs(scale_axle_y) > SINGULAR * lanes_fabs(n_axle_y__axle_y));
    const Lanes inverse_pivot_axle_y = 1.0/scale_axle_y;
    lin->lu[6] = inverse_pivot_axle_y;
    const Lanes l_axle_theta__axle_y = inverse_pivot_axle_y*(-l_axle_theta__axle_x*n_axle_x__axle_y
        + n_axle_theta__axle_y);
    lin->lu[7] = l_axle_theta__axle_y;
    const Lanes u_axle_y__axle_theta = -l_axle_y__axle_x*n_axle_x__axle_theta + n_axle_y__axle_theta;
    lin->lu[8] = u_axle_y__axle_theta;
    const Lanes l_slot_offset__axle_y = inverse_pivot_axle_y*(-l_slot_offset__axle_x*n_axle_x__axle_y
        + n_slot_offset__axle_y);
    lin->lu[9] = l_slot_offset__axle_y;
    const Lanes u_axle_y__slot_offset = -l_axle_y__axle_x*phi_slot_offset_axle_x + phi_slot_offset_axle_y;
    lin->lu[10] = u_axle_y__slot_offset;
    const Lanes scale_axle_theta = -l_axle_theta__axle_x*n_axle_x__axle_theta
        - l_axle_theta__axle_y*u_axle_y__axle_theta + n_axle_theta__axle_theta;
    *rare |= ~(lanes_fabs(scale_axle_theta) > SINGULAR * lanes_fabs(n_axle_theta__axle_theta));
    const Lanes inverse_pivot_axle_theta = 1.0/scale_axle_theta;
    lin->lu[11] = inverse_pivot_axle_theta;
    const Lanes l_slot_offset__axle_theta = inverse_pivot_axle_theta*(-l_slot_offset__axle_x*n_axle_x__axle_theta
        - l_slot_offset__axle_y*u_axle_y__axle_theta + n_slot_offset__axle_theta);
    lin->lu[12] = l_slot_offset__axle_theta;
    const Lanes u_axle_theta__slot_offset = -l_axle_theta__axle_x*phi_slot_offset_axle_x
        - l_axle_theta__axle_y*u_axle_y__slot_offset + phi_slot_offset_axle_theta;
    lin->lu[13] = u_axle_theta__slot_offset;
    const Lanes scale_slot_offset = -l_slot_offset__axle_theta*u_axle_theta__slot_offset
        - l_slot_offset__axle_x*phi_slot_offset_axle_x - l_slot_offset__axle_y*u_axle_y__slot_offset;
    *rare |= ~((lanes_fabs(scale_slot_offset) > 0.0) & (lanes_fabs(scale_slot_offset) < INFINITY));
    const Lanes inverse_pivot_slot_offset = 1.0/scale_slot_offset;
    lin->lu[14] = inverse_pivot_slot_offset;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_slot_offset_axle_x = lin->value[0];
    const Lanes inverse_pivot_axle_x = lin->lu[0];
    const Lanes l_axle_y__axle_x = lin->lu[1];
    const Lanes n_axle_x__axle_y = lin->lu[2];
    const Lanes l_axle_theta__axle_x = lin->lu[3];
    const Lanes n_axle_x__axle_theta = lin->lu[4];
    const Lanes l_slot_offset__axle_x = lin->lu[5];
    const Lanes inverse_pivot_axle_y = lin->lu[6];
    const Lanes l_axle_theta__axle_y = lin->lu[7];
    const Lanes u_axle_y__axle_theta = lin->lu[8];
    const Lanes l_slot_offset__axle_y = lin->lu[9];
    const Lanes u_axle_y__slot_offset = lin->lu[10];
    const Lanes inverse_pivot_axle_theta = lin->lu[11];
    const Lanes l_slot_offset__axle_theta = lin->lu[12];
    const Lanes u_axle_theta__slot_offset = lin->lu[13];
    const Lanes inverse_pivot_slot_offset = lin->lu[14];

    /* forward */
    const Lanes b_axle_x = x[0];
    const Lanes b_axle_y = -b_axle_x*l_axle_y__axle_x + x[1];
    const Lanes b_axle_theta = -b_axle_x*l_axle_theta__axle_x - b_axle_y*l_axle_theta__axle_y + x[2];
    const Lanes b_slot_offset = -b_axle_theta*l_slot_offset__axle_theta - b_axle_x*l_slot_offset__axle_x
        - b_axle_y*l_slot_offset__axle_y + x[3];

    /* backward */
    const Lanes x_slot_offset = b_slot_offset*inverse_pivot_slot_offset;
    x[3] = x_slot_offset;
    const Lanes x_axle_theta = inverse_pivot_axle_theta*(b_axle_theta - u_axle_theta__slot_offset*x_slot_offset);
    x[2] = x_axle_theta;
    const Lanes x_axle_y = inverse_pivot_axle_y*(b_axle_y - u_axle_y__axle_theta*x_axle_theta
        - u_axle_y__slot_offset*x_slot_offset);
    x[1] = x_axle_y;
    const Lanes x_axle_x = inverse_pivot_axle_x*(b_axle_x - n_axle_x__axle_theta*x_axle_theta
        - n_axle_x__axle_y*x_axle_y - phi_slot_offset_axle_x*x_slot_offset);
    x[0] = x_axle_x;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes phi_slot_offset_axle_x = lin->value[0];
    const Lanes phi_slot_offset_axle_y = lin->value[1];
    const Lanes phi_slot_offset_axle_theta = lin->value[2];
    const Lanes by_q_slot_offset_axle_x = lin->value[3];
    const Lanes by_q_slot_offset_axle_y = lin->value[4];
    const Lanes by_q_slot_offset_axle_theta = lin->value[5];
    const Lanes by_q_axle_x_axle_x = lin->value[6];
    const Lanes by_q_axle_x_axle_theta = lin->value[7];
    const Lanes by_q_axle_x_axle_y = lin->value[8];
    const Lanes by_q_axle_y_axle_y = lin->value[9];
    const Lanes by_q_axle_y_axle_theta = lin->value[10];
    const Lanes by_q_axle_y_axle_x = lin->value[11];
    const Lanes by_q_axle_theta_axle_x = lin->value[12];
    const Lanes by_q_axle_theta_axle_theta = lin->value[13];
    const Lanes by_q_axle_theta_axle_y = lin->value[14];
    const Lanes by_t_slot_offset = lin->value[18];
    const Lanes by_t_axle_x = lin->value[19];
    const Lanes by_t_axle_y = lin->value[20];
    const Lanes by_t_axle_theta = lin->value[21];
    const Lanes power_q_0_axle_x = lin->value[22];
    const Lanes power_q_0_axle_y = lin->value[23];
    const Lanes power_q_0_axle_theta = lin->value[24];
    const Lanes power_0_slot_offset = lin->value[25];
    const Lanes power_t_0 = lin->value[26];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[4];
    const Lanes shifted_axle_x = -p->beta_squared*eta*r[0] + r[3];
    const Lanes shifted_axle_y = -p->beta_squared*eta*r[1] + r[4];
    const Lanes shifted_axle_theta = -p->beta_squared*eta*r[2] + r[5];
    x[0] = eta*(p->axle_mass*r[3] - by_q_axle_x_axle_theta*eta*r[2] - by_q_axle_x_axle_x*eta*r[0]
        - by_q_axle_x_axle_y*eta*r[1] - by_t_axle_x*s);
    x[1] = eta*(p->axle_mass*r[4] - by_q_axle_y_axle_theta*eta*r[2] - by_q_axle_y_axle_x*eta*r[0]
        - by_q_axle_y_axle_y*eta*r[1] - by_t_axle_y*s);
    x[2] = eta*(p->axle_inertia*r[5] - by_q_axle_theta_axle_theta*eta*r[2] - by_q_axle_theta_axle_x*eta*r[0]
        - by_q_axle_theta_axle_y*eta*r[1] - by_t_axle_theta*s);
    x[3] = eta_row*(-by_q_slot_offset_axle_theta*eta*r[2] - by_q_slot_offset_axle_x*eta*r[0]
        - by_q_slot_offset_axle_y*eta*r[1] - by_t_slot_offset*s + phi_slot_offset_axle_theta*shifted_axle_theta
        + phi_slot_offset_axle_x*shifted_axle_x + phi_slot_offset_axle_y*shifted_axle_y);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*(power_q_0_axle_theta*u[2] + power_q_0_axle_x*u[0] + power_q_0_axle_y*u[1] + power_t_0*s + r[6])
        + power_0_slot_offset*x[3];
    u[7] = eta*r[7];
    u[8] = eta*r[8];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
