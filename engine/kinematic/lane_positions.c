/*
 * Positions of kinematic runs in SIMD lanes: Newton's method, checks of a step, and works. Lane by lane the operations
 * are those of a single run (tree.c, kinematic.c, works.c) in the same order. A step that is not regular is made again
 * by its run alone: where Newton's method fails, a change point is near, or a velocity jumps.
 */
#include "kinematic.h"
#include "../scalar_simd/extrapolation.h"

/* Position of several runs; no lane is interpolated. */
typedef struct {
    Lanes t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot, last_correction, s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1];
    Lanes interval, s_higher[N_X + 1][N_HIGHER];
} LanePosition;

/*
 * Return the maximum of `largest`, which is not negative, and |value| in each lane; NaN if one of them is NaN. Numbers
 * without a sign are ordered as their bits, and the bits of NaN are above those of infinity.
 */
static inline Lanes get_larger_or_nan(Lanes largest, Lanes value)
{
    const LaneBits size = (LaneBits)lanes_fabs(value);
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
    return (Lanes)__builtin_ia32_pmaxsq512_mask(size, (LaneBits)largest, size, (char)-1);
#else
    return select_value(size > (LaneBits)largest, (Lanes)size, largest);
#endif
}

/*
 * Return the maximum norm of a change or rate of q (N_Q) as an angle, rad or rad/s, in each lane; NaN is propagated.
 * Lengths are divided by the mechanism's size `extent` (m). The same as compute_scaled_max_norm() of a single run.
 */
static Lanes compute_scaled_max_norm(const Lanes *change, Lanes extent)
{
    Lanes largest = broadcast(0.0);
    for (int k = 0; k < N_Q; k++)
        largest = get_larger_or_nan(largest, k % 3 == 2 ? change[k] : change[k] / extent);
    return largest;
}

/* Return the change of tree coordinate k, in rad or as a fraction of the mechanism's size `extent`. */
static inline Lanes scale_coordinate_change(Lanes change, int k, Lanes extent)
{
    return is_angle[k] ? change : change / extent;
}

/* Return the time at which the drives are evaluated in each lane: just after t if their rates may jump, else t. */
static inline Lanes get_lane_time_after_jump(Lanes t)
{
    return RATE_JUMPS ? t + lanes_max_of(32.0 * DBL_EPSILON * lanes_fabs(t), broadcast(1e-100)) : t;
}

/*
 * Compute Newton's step of the closures at times t (s), with the rates and the largest |Phi|, and the motion of all
 * bodies. Inlined, both functions share sines and factors: `restrict` tells the compiler that outputs overwrite no
 * inputs. Lanes in which a pivot vanishes are added to the mask `needs_scalar`: they need their scalar run.
 */
__attribute__((flatten)) static void evaluate_position(const LaneParameters *restrict p, Lanes t,
    LanePosition *restrict position, Lanes *restrict step, LaneBits *restrict needs_scalar)
{
    close_step(t, position->s, p, step, position->s_rate, &position->phi, needs_scalar);
    compute_body_motion(t, position->s, position->s_rate, p, position->s_second, position->q, position->v, position->a,
        &position->phi_dot, needs_scalar);
}

/*
 * Solve the closures at times t by Newton's method from the guess in `position`, and compute the motion of all bodies
 * there. Return the lanes in which it failed. Solved lanes keep their coordinates while others iterate. As soon as the
 * corrections of all unsolved lanes are below NEWTON_NEARLY_CLOSED, the motion is evaluated together with Newton's
 * step. correction: incremented by the corrections, in rad or fractions of the size.
 */
__attribute__((flatten)) static LaneBits solve_lane_equations(const LaneParameters *restrict p, Lanes extent,
    Lanes t, LanePosition *restrict position, Lanes *restrict correction)
{
    LaneBits is_active = ~(LaneBits){0}, is_failed = {0}, needs_scalar = {0};
    Lanes before = broadcast(INFINITY), step[N_X + 1], rates[N_X + 1], phi;
    for (int i = 0;; i++) {
        Lanes size = broadcast(0.0);
        const int has_motion = i == MAX_NEWTON || !any_of(is_active & ~(before < NEWTON_NEARLY_CLOSED));
        if (has_motion)
            evaluate_position(p, t, position, step, &needs_scalar);
        else
            close_step(t, position->s, p, step, rates, &phi, &needs_scalar);
        if (i == MAX_NEWTON)
            break;
        for (int k = 0; k < N_X; k++)
            size = get_larger_or_nan(size, scale_coordinate_change(step[k], k, extent));
        position->last_correction = size;
        is_failed |= is_active & (needs_scalar | (size != size));
        is_active &= ~(is_failed | (size < NEWTON_ROUNDING) | ((size < NEWTON_CLOSED) & (size >= 0.5 * before)));
        for (int k = 0; k < N_X; k++)
            position->s[k] = select_value(is_active, position->s[k] - step[k], position->s[k]);
        *correction = select_value(is_active, *correction + size, *correction);
        before = select_value(is_active, size, before);
        if (has_motion && !any_of(is_active))
            break;
    }
    return is_failed | needs_scalar | is_active;
}

/*
 * Compute the first guess of the coordinates at times t from the positions `start`, as in a single run: s + h s' + h^2
 * s''/2 and terms of higher order, or s + h s' if s'' is too large.
 */
static void guess_lane_positions(Lanes extent, Lanes t, const LanePosition *start, LanePosition *position)
{
    const Lanes h = t - start->t, r = h / start->interval;
    Lanes largest = broadcast(0.0), largest_displacement = broadcast(0.0), displacement[N_X + 1];
    for (int k = 0; k < N_X; k++) {
        displacement[k] = sum_higher_terms(r, start->s_higher[k]);
        largest = get_larger_or_nan(largest, scale_coordinate_change(0.5 * h * h * start->s_second[k], k, extent));
        largest_displacement =
            get_larger_or_nan(largest_displacement, scale_coordinate_change(displacement[k], k, extent));
    }
    const Lanes half_h = select_value(largest <= MAX_SECOND_RATE_DISPLACEMENT, 0.5 * h, broadcast(0.0));
    const LaneBits has_second = half_h != 0.0,
                   has_higher = has_second & (largest_displacement <= MAX_HIGHER_ORDER_DISPLACEMENT);
    for (int k = 0; k < N_X; k++) {
        const Lanes by_second_rate = select_value(has_second, half_h * start->s_second[k], broadcast(0.0));
        position->s[k] = start->s[k] + h * (start->s_rate[k] + by_second_rate)
            + select_value(has_higher, displacement[k], broadcast(0.0));
    }
}

/*
 * Solve the closures at times t for whole positions, from the near positions `start`, as solve_position_at() of a
 * single run. Return the lanes in which that failed. correction: set to the sums of Newton's corrections, rad or
 * fraction of the size.
 */
static LaneBits solve_lane_positions(const LaneParameters *p, Lanes extent, Lanes t, const LanePosition *start,
    LanePosition *position, Lanes *correction)
{
    *correction = broadcast(0.0);
    position->t = t;
    guess_lane_positions(extent, t, start, position);
    const LaneBits is_failed = solve_lane_equations(p, extent, get_lane_time_after_jump(t), position, correction);
    position->interval = t - start->t;
    for (int k = 0; k < N_X; k++)
        compute_higher_terms(position->interval,
            (CoordinateOf){start->s[k], start->s_rate[k], start->s_second[k]},
            (CoordinateOf){position->s[k], position->s_rate[k], position->s_second[k]}, position->s_higher[k]);
    return is_failed;
}

/*
 * Return the largest difference of positions b from a plus the trapezoidal rule of their velocities in each lane, as in
 * a single run, rad; lengths are divided by `extent` (m).
 */
static Lanes compute_trapezoidal_error(const LanePosition *a, const LanePosition *b, Lanes extent)
{
    const Lanes half = 0.5 * (b->t - a->t), fraction = 1.0 / extent;
    Lanes lengths = broadcast(0.0), angles = broadcast(0.0), error[3];
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = 0; c < 3; c++)
            error[c] = b->q[k + c] - a->q[k + c] - half * (a->v[k + c] + b->v[k + c]);
        lengths = get_larger_or_nan(get_larger_or_nan(lengths, error[0]), error[1]);
        angles = get_larger_or_nan(angles, error[2]);
    }
    return get_larger_or_nan(angles, lengths * fraction);
}

/*
 * Return the lanes with an ill-conditioned position, as is_ill_conditioned() of a single run: the last Newton
 * correction exceeds MIN_PASS_CORRECTION DBL_EPSILON max(1, |angles|), or is NaN.
 */
static LaneBits find_ill_conditioned_lanes(const LanePosition *position)
{
    Lanes size = broadcast(1.0);
    for (int k = 2; k < N_Q; k += 3)
        size = get_larger_or_nan(size, position->q[k]);
    return ~(position->last_correction <= MIN_PASS_CORRECTION * DBL_EPSILON * size);
}

/*
 * Add the works between positions a and b, one step apart, to `work`, J, by Gauss-Legendre quadrature, in the regular
 * lanes of `is_accepted`. Return the irregular lanes, where that failed, a power is not finite, or velocities jump.
 */
static LaneBits integrate_lane_works(const LaneParameters *p, Lanes extent, const LanePosition *a,
    const LanePosition *b, LaneBits is_accepted, Lanes *work)
{
    const Lanes half = 0.5 * (b->t - a->t);
    const Lanes speed = get_larger_or_nan(compute_scaled_max_norm(a->v, extent), compute_scaled_max_norm(b->v, extent));
    Lanes velocity_defect[N_Q], interval_work[N_WORK], scale = broadcast(0.0);
    LaneBits is_irregular = {0};
    for (int k = 0; k < N_Q; k++)
        velocity_defect[k] = b->v[k] - a->v[k];
    for (int k = 0; k < N_WORK; k++)
        interval_work[k] = broadcast(0.0);
    for (int i = 0; i < N_WORK_NODES; i++) {
        LanePosition node;
        LaneDiscreteState discrete = {.min_pivot = broadcast(0.0)};
        LaneRhsOutputs rhs;
        Lanes correction, acceleration[N_X + 1];
        is_irregular |=
            solve_lane_positions(p, extent, a->t + half * (1.0 + work_node[i]), a, &node, &correction);
        reduced_dynamics(get_lane_time_after_jump(node.t), node.s, node.s_rate, &discrete, p, acceleration, &rhs,
            &discrete.needs_scalar);
        is_irregular |= discrete.needs_scalar;
        for (int k = 0; k < N_WORK; k++) {
            is_irregular |= ~(lanes_fabs(rhs.power[k]) <= DBL_MAX);
            interval_work[k] += half * work_weight[i] * rhs.power[k];
        }
        for (int k = 0; k < N_Q; k++)
            velocity_defect[k] -= half * work_weight[i] * node.a[k];
        scale = get_larger_or_nan(scale, half * compute_scaled_max_norm(node.a, extent));
    }
    const Lanes jump = compute_scaled_max_norm(velocity_defect, extent);
    const Lanes min_jump = MIN_VELOCITY_JUMP + VELOCITY_ROUNDING * speed;
    is_irregular |= ~(scale <= DBL_MAX) | ((jump > min_jump) & (jump > MIN_JUMP_RATIO * scale));
    is_irregular |= ~(lanes_fabs(interval_work[0]) <= DBL_MAX);
    for (int k = 0; k < N_WORK; k++)
        work[k] = select_value(is_accepted & ~is_irregular, work[k] + interval_work[k], work[k]);
    return is_irregular;
}
