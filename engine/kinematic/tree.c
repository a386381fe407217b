/* Positions of a driven linkage in tree coordinates: solution of the closures, velocities and accelerations. */
#define MAX_BEND 0.05 /* rad, or fraction of the size: largest contribution of second rates to a first guess */

/*
 * Compute powers and tree accelerations by the equations of motion. A positive status is a constraint equation,
 * numbered after the N_LOOPS closures.
 */
static int solve_motion(KinematicRun *run, const Position *here, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &run->cancellation};
    const int status = reduced_dynamics(after_jump(here->t), here->s, here->s_rate, &discrete, run->p, a, rhs);
    return status > 0 ? N_LOOPS + status : status;
}

/*
 * Solve the closures by Newton's method until the correction is rounding or no longer decreases; compute the rates
 * there. Corrections are measured in rad, slides as fractions of the mechanism's size. moved: incremented by the
 * corrections.
 */
static int close_linkage(const KinematicRun *run, double t, Position *at, double *moved)
{
    double step[N_X + 1], before = INFINITY;
    at->last_correction = 0.0;
    for (int i = 0; i < MAX_NEWTON; i++) {
        double size = 0.0;
        const int status = close_step(t, at->s, run->p, step, at->s_rate, &at->phi);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++)
            size = larger_or_nan(size, fabs(step[k]) / (is_angle[k] ? 1.0 : run->extent));
        if (isnan(size))
            return NEWTON_FAILED;
        at->last_correction = size;
        if (size < 4e-15 || (size < 1e-9 && size >= 0.5 * before))
            return 0;
        for (int k = 0; k < N_X; k++)
            at->s[k] -= step[k];
        *moved += size;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/*
 * Return whether second rates change a first guess by more than MAX_BEND. Near a time at which the second rate of a
 * drive is unbounded they do not describe the whole step.
 */
static int is_unbounded(const Position *from, double h, double extent)
{
    double most = 0.0;
    for (int k = 0; k < N_X; k++)
        most = larger_or_nan(most, fabs(0.5 * h * h * from->s_second[k]) / (is_angle[k] ? 1.0 : extent));
    return !(most <= MAX_BEND);
}

/*
 * Solve the position at time t from a near one. First guess: s + h s' + h^2 s''/2, or s + h s' if s'' is unbounded.
 * moved: the correction of the guess. Returns a status.
 */
static int solve_position_at(const KinematicRun *run, double t, const Position *from, Position *to, double *moved)
{
    const double h = t - from->t, bend = is_unbounded(from, h, run->extent) ? 0.0 : 0.5 * h;
    *moved = 0.0;
    to->t = t;
    to->interpolated = 0;
    for (int k = 0; k < N_X; k++)
        to->s[k] = from->s[k] + h * (from->s_rate[k] + (bend != 0.0 ? bend * from->s_second[k] : 0.0));
    const double then = after_jump(t);
    const int status = close_linkage(run, then, to, moved);
    return status ? status
        : arrive(then, to->s, to->s_rate, run->p, to->s_second, to->q, to->v, to->a, &to->phi_dot);
}

/* Do nothing: a position in tree coordinates is complete. */
static int complete_position(const KinematicRun *run, const Position *here) { return (void)run, (void)here, 0; }

/*
 * Set the position at time t to given q and v (N_Q). Where closures depend on each other, the equations of motion give
 * the accelerations. Returns a status.
 */
static int set_position(KinematicRun *run, double t, const double *q, const double *v, Position *here)
{
    const Parameters *p = run->p;
    double step[N_X + 1], rates[N_X + 1];
    here->t = t;
    here->last_correction = 0.0;
    here->interpolated = 0;
    reduce_state(t, q, v, p, here->s, here->s_rate);
    if (!close_step(after_jump(t), here->s, p, step, rates, &here->phi)
        && !arrive(after_jump(t), here->s, here->s_rate, p, here->s_second, here->q, here->v, here->a, &here->phi_dot))
        return 0;
    RhsOutputs rhs;
    here->last_correction = INFINITY;
    memcpy(here->q, q, sizeof here->q);
    memcpy(here->v, v, sizeof here->v);
    for (int k = 0; k < N_X; k++)
        here->s_second[k] = 0.0;
    here->phi = here->phi_dot = 0.0;
    const int status =
        dynamics(t, q, v, &(DiscreteState){.token = &run->cancellation, USUAL_SHARES}, p, here->a, &rhs);
    return status > 0 ? N_LOOPS + status : status;
}
