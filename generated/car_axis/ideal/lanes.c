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

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
