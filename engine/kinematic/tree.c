/* Kinematic analysis in tree coordinates s: Newton's method for the loop closures, velocities and accelerations. */
#include "../scalar_simd/scalar.h"
#include "../scalar_simd/extrapolation.h"

/*
 * Compute the tree accelerations a (N_X) and the outputs rhs (powers, event functions) of a position by the reduced
 * equations of motion. They are right limits in time: just after a jump of a drive. Discrete states are zero. Return 0,
 * a negative status, or N_LOOPS plus the number of a dependent constraint equation.
 */
static int solve_accelerations(KinematicRun *run, const Position *position, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation};
    const int status =
        reduced_dynamics(get_time_after_jump(position->t), position->s, position->s_rate, &discrete, run->p, a, rhs);
    return status > 0 ? N_LOOPS + status : status;
}

/*
 * Solve the closures at time t by Newton's method from the guess position->s, and compute the rates s_rate there. It
 * ends when the correction is below NEWTON_ROUNDING, or below NEWTON_CLOSED and no longer halved. Also sets
 * last_correction and phi. correction: incremented by the corrections, rad or fraction of the size. Return 0, a status,
 * or NEWTON_FAILED if a correction is NaN or the last of MAX_NEWTON iterations corrects by NEWTON_CLOSED or more.
 */
static int solve_position_equations(const KinematicRun *run, double t, Position *position, double *correction)
{
    double step[N_X + 1], before = INFINITY;
    position->last_correction = 0.0;
    for (int i = 0; i < MAX_NEWTON; i++) {
        double size = 0.0;
        const int status = close_step(t, position->s, run->p, step, position->s_rate, &position->phi);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++)
            size = get_larger_or_nan(size, fabs(step[k]) / (is_angle[k] ? 1.0 : run->extent));
        if (isnan(size))
            return NEWTON_FAILED;
        position->last_correction = size;
        if (size < NEWTON_ROUNDING || (size < NEWTON_CLOSED && size >= 0.5 * before))
            return 0;
        for (int k = 0; k < N_X; k++)
            position->s[k] -= step[k];
        *correction += size;
        before = size;
    }
    return before < NEWTON_CLOSED ? 0 : NEWTON_FAILED;
}

/*
 * Return whether second rates change a first guess over a time h (s) by more than MAX_SECOND_RATE_DISPLACEMENT, or are
 * NaN. Near a time at which the second rate of a drive is unbounded they do not describe the whole step.
 */
static int exceeds_second_rate_limit(const Position *start, double h, double extent)
{
    double largest = 0.0;
    for (int k = 0; k < N_X; k++)
        largest = get_larger_or_nan(largest, fabs(0.5 * h * h * start->s_second[k]) / (is_angle[k] ? 1.0 : extent));
    return !(largest <= MAX_SECOND_RATE_DISPLACEMENT);
}

/*
 * Compute the terms of third to fifth order of the predictor, a Taylor polynomial that gives Newton's method the first
 * guess over a time h (s): displacement (N_X). All are zero without an earlier position (interval 0), or where one is
 * larger than MAX_HIGHER_ORDER_DISPLACEMENT.
 */
static void compute_higher_order_displacement(const Position *start, double h, double extent, double *displacement)
{
    double largest = 0.0;
    for (int k = 0; k < N_X; k++) {
        displacement[k] = sum_higher_terms(h / start->interval, start->s_higher[k]);
        largest = get_larger_or_nan(largest, fabs(displacement[k]) / (is_angle[k] ? 1.0 : extent));
    }
    for (int k = 0; k < N_X && !(largest <= MAX_HIGHER_ORDER_DISPLACEMENT); k++)
        displacement[k] = 0.0;
}

/*
 * Store the terms of third to fifth order of a position, for the next first guess, and the interval (s) since `start`,
 * the position before.
 */
static void store_higher_terms(const Position *start, Position *position)
{
    position->interval = position->t - start->t;
    for (int k = 0; k < N_X; k++)
        compute_higher_terms(position->interval,
            (CoordinateOf){start->s[k], start->s_rate[k], start->s_second[k]},
            (CoordinateOf){position->s[k], position->s_rate[k], position->s_second[k]}, position->s_higher[k]);
}

/*
 * Solve the closures at time t for all of `position`: tree coordinates, motion of all bodies, residuals, terms for the
 * next guess. The first guess is s + h s' + h^2 s''/2 and terms of higher order from `start`, or s + h s' if s'' is too
 * large. At a jump of a drive the values just after it count. Also sets position->last_correction. correction: set to
 * the sum of Newton's corrections, rad or fraction of the size. Return 0 or a status.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *start, Position *position,
    double *correction)
{
    const double h = t - start->t, half_h = exceeds_second_rate_limit(start, h, run->extent) ? 0.0 : 0.5 * h;
    double displacement[N_X + 1];
    *correction = 0.0;
    position->t = t;
    position->is_interpolated = 0;
    compute_higher_order_displacement(start, h, run->extent, displacement);
    for (int k = 0; k < N_X; k++) {
        const double by_second_rate = half_h != 0.0 ? half_h * start->s_second[k] : 0.0;
        position->s[k] =
            start->s[k] + h * (start->s_rate[k] + by_second_rate) + (half_h != 0.0 ? displacement[k] : 0.0);
    }
    const double t_after_jump = get_time_after_jump(t);
    int status = solve_position_equations(run, t_after_jump, position, correction);
    if (!status)
        status = compute_body_motion(t_after_jump, position->s, position->s_rate, run->p, position->s_second,
            position->q, position->v, position->a, &position->phi_dot);
    store_higher_terms(start, position);
    return status;
}

/* Do nothing: solve_position_at() in tree coordinates computes all that a sample needs. */
static int complete_position(const KinematicRun *run, const Position *position) { return (void)run, (void)position, 0; }

/*
 * Set the position at time t from a state q, v (N_Q each), complete with accelerations. Values just after a jump of a
 * drive count.
 *
 * In the regular case the tree coordinates s are reduced from q and v, and q, v, a are recomputed from them. No Newton
 * iteration corrects s: close_step() only tests the Jacobian of the closures and computes the residual phi; its step
 * and rates are not used, and last_correction is 0. If the Jacobian is singular, q and v are kept, the equations of
 * motion of all bodies give a, and last_correction is infinity. Return 0, or the status of
 * dynamics(), to which N_LOOPS is added if it is positive.
 */
static int initialize_position(KinematicRun *run, double t, const double *q, const double *v, Position *position)
{
    const Parameters *p = run->p;
    double step[N_X + 1], rates[N_X + 1];
    position->t = t;
    position->last_correction = position->interval = 0.0;
    position->is_interpolated = 0;
    memset(position->s_higher, 0, sizeof position->s_higher);
    reduce_state(t, q, v, p, position->s, position->s_rate);
    if (!close_step(get_time_after_jump(t), position->s, p, step, rates, &position->phi)
        && !compute_body_motion(get_time_after_jump(t), position->s, position->s_rate, p, position->s_second,
            position->q, position->v, position->a, &position->phi_dot))
        return 0;
    RhsOutputs rhs;
    position->last_correction = INFINITY;
    memcpy(position->q, q, sizeof position->q);
    memcpy(position->v, v, sizeof position->v);
    for (int k = 0; k < N_X; k++)
        position->s_second[k] = 0.0;
    position->phi = position->phi_dot = 0.0;
    const int status =
        dynamics(t, q, v, &(DiscreteState){.token = &run->cancellation, DEFAULT_PIVOT_LIMITS}, p, position->a, &rhs);
    return status > 0 ? N_LOOPS + status : status;
}
