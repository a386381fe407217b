/* Positions, velocities and accelerations in tree coordinates of a linkage that drives determine. */
#include "../scalar_simd/scalar.h"
#include "../scalar_simd/extrapolation.h"

/*
 * Compute tree accelerations a and powers at a position by the reduced equations of motion. Return 0 or a status. A
 * positive status is a constraint equation, numbered after the N_LOOPS closures.
 */
static int solve_accelerations(KinematicRun *run, const Position *position, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation};
    const int status =
        reduced_dynamics(get_time_after_jump(position->t), position->s, position->s_rate, &discrete, run->p, a, rhs);
    return status > 0 ? N_LOOPS + status : status;
}

/*
 * Solve the closures at time t by Newton's method from the guess in `position`, and compute the rates there. Return 0
 * or a status. It ends if the correction is rounding or no longer decreases. correction: incremented by the
 * corrections, in rad or fractions of the mechanism's size.
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
 * Return whether second rates change a first guess over a time h (s) by more than MAX_SECOND_RATE_MOVE. Near a time at
 * which the second rate of a drive is unbounded they do not describe the whole step.
 */
static int has_large_second_rates(const Position *start, double h, double extent)
{
    double largest = 0.0;
    for (int k = 0; k < N_X; k++)
        largest = get_larger_or_nan(largest, fabs(0.5 * h * h * start->s_second[k]) / (is_angle[k] ? 1.0 : extent));
    return !(largest <= MAX_SECOND_RATE_MOVE);
}

/*
 * Compute the terms of higher order of a first guess over a time h (s). They are zero without an earlier position, or
 * where one is larger than MAX_HIGHER_MOVE.
 */
static void compute_higher_moves(const Position *start, double h, double extent, double *move)
{
    double largest = 0.0;
    for (int k = 0; k < N_X; k++) {
        move[k] = sum_higher_terms(h / start->interval, start->s_higher[k]);
        largest = get_larger_or_nan(largest, fabs(move[k]) / (is_angle[k] ? 1.0 : extent));
    }
    for (int k = 0; k < N_X && !(largest <= MAX_HIGHER_MOVE); k++)
        move[k] = 0.0;
}

/* Compute the terms of higher order of a position from the one before, `start`. */
static void store_higher_terms(const Position *start, Position *position)
{
    position->interval = position->t - start->t;
    for (int k = 0; k < N_X; k++)
        compute_higher_terms(position->interval,
            (CoordinateOf){start->s[k], start->s_rate[k], start->s_second[k]},
            (CoordinateOf){position->s[k], position->s_rate[k], position->s_second[k]}, position->s_higher[k]);
}

/*
 * Solve the whole position at time t from the near position `start`. Return 0 or a status. The first guess is s + h s'
 * + h^2 s''/2 and terms of higher order, or s + h s' if s'' is too large. correction: set to the correction of the
 * guess.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *start, Position *position,
    double *correction)
{
    const double h = t - start->t, half_h = has_large_second_rates(start, h, run->extent) ? 0.0 : 0.5 * h;
    double move[N_X + 1];
    *correction = 0.0;
    position->t = t;
    position->interpolated = 0;
    compute_higher_moves(start, h, run->extent, move);
    for (int k = 0; k < N_X; k++) {
        const double by_second_rate = half_h != 0.0 ? half_h * start->s_second[k] : 0.0;
        position->s[k] = start->s[k] + h * (start->s_rate[k] + by_second_rate) + (half_h != 0.0 ? move[k] : 0.0);
    }
    const double t_after_jump = get_time_after_jump(t);
    int status = solve_position_equations(run, t_after_jump, position, correction);
    if (!status)
        status = compute_body_motion(t_after_jump, position->s, position->s_rate, run->p, position->s_second,
            position->q, position->v, position->a, &position->phi_dot);
    store_higher_terms(start, position);
    return status;
}

/* Do nothing: a position in tree coordinates is complete. */
static int complete_position(const KinematicRun *run, const Position *position) { return (void)run, (void)position, 0; }

/*
 * Set the position at time t to given q and v (N_Q), and complete it. Return 0 or a status. Where closures depend on
 * each other, the equations of motion of all bodies give the accelerations, and the last correction is set to infinity.
 */
static int set_position(KinematicRun *run, double t, const double *q, const double *v, Position *position)
{
    const Parameters *p = run->p;
    double step[N_X + 1], rates[N_X + 1];
    position->t = t;
    position->last_correction = position->interval = 0.0;
    position->interpolated = 0;
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
