/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct {
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

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
