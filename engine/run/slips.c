/*
 * Removal of residual slip in friction elements that stick, to the accuracy with which their velocities are evaluated.
 */
#define MIN_SLIP 1e-15    /* m/s: smaller slips count as zero */
#define MAX_RESIDUAL_TOLERANCES 10.0 /* tolerances of a velocity up to which a slip is an error of the step */
#define MAX_RESIDUAL_SLIP 2e-9 /* m/s: slip up to which the beginning of stick is located */

/*
 * Return the change of the rate of a slip, in m/s^2, when the friction force of its element reverses (mode 1 to -1). dy
 * (N_Y): set to the change of all rates. Return 0 if an evaluation fails. The mode is restored. Used to compute the
 * impulse that stops a slip.
 */
static double compute_slip_response(Integrator *run, double t, const double *y, int element, const Parameters *p,
    double *dy)
{
    double *mode = &run->discrete.mode[element], dy_forward[N_Y];
    const double mode_before = *mode;
    RhsOutputs rhs_reverse, rhs_forward;
    *mode = -1.0;
    int status = evaluate_run_rhs(run, t, y, p, dy, &rhs_reverse);
    *mode = 1.0;
    status = status ? status : evaluate_run_rhs(run, t, y, p, dy_forward, &rhs_forward);
    *mode = mode_before;
    for (int k = 0; k < N_Y; k++)
        dy[k] -= dy_forward[k];
    return status ? 0.0 : rhs_reverse.friction[element].rate - rhs_forward.friction[element].rate;
}

/*
 * Return whether the velocity change `factor` * `direction` (N_Y) is a residual error of a step. No velocity may change
 * by more than MAX_RESIDUAL_TOLERANCES of its tolerances or the location error of stick (MAX_RESIDUAL_SLIP). The
 * velocities are tested, not the slip, because a slip may be small only because its lever arm is.
 */
static int is_slip_residual(const Integrator *run, const double *direction, double factor)
{
    int is_small = 1;
    for (int k = N_X; k < 2 * N_X; k++) {
        const double *scale = run->norm.min_size;
        const double angle_per_length = scale[0] > 0.0 ? scale[1] / scale[0] : 1.0; /* rad/m; rk4 does not know */
        const double located = is_angle[k - N_X] ? MAX_RESIDUAL_SLIP * angle_per_length : MAX_RESIDUAL_SLIP;
        const double tolerance = run->norm.weight[k] > 0.0 ? MAX_RESIDUAL_TOLERANCES / run->norm.weight[k] : 0.0;
        is_small &= fabs(direction[k] * factor) <= max_of(tolerance, located);
    }
    return is_small;
}

/*
 * Remove the residual slips of sticking friction from the velocities in y, element by element, by an impulse of its
 * friction that leaves the other elements at rest. Return whether there were any; the caller then evaluates the
 * right-hand side again, as rhs (outputs at the first y) is not changed. Slips up to MIN_SLIP, those that are too large
 * for an error of the step (is_slip_residual()), and elements without a positive response are kept.
 */
static int remove_slip_residuals(Integrator *run, double t, double *y, const RhsOutputs *rhs, const Parameters *p)
{
    int has_residual = 0;
    for (int element = 0; element < N_FRICTIONS; element++) {
        double direction[N_Y];
        const double v = rhs->friction[element].v;
        if (run->discrete.mode[element] != 0.0 || fabs(v) <= MIN_SLIP)
            continue;
        const double response = compute_slip_response(run, t, y, element, p, direction);
        if (!(response > 0.0) || !is_slip_residual(run, direction, v / response))
            continue;
        for (int k = N_X; k < 2 * N_X; k++)
            y[k] -= direction[k] * (v / response);
        has_residual = 1;
    }
    return has_residual;
}

/*
 * Evaluate the right-hand side at a state after removing residual slips of sticking friction from y. dy, rhs: the
 * result, at the changed y. Return 0 or a status. Called at the end of each step and at states of the dense output in
 * the search for events (evaluate_state_at()).
 */
static int evaluate_rates_without_residual_slips(
    Integrator *run, double t, double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    const int status = evaluate_run_rhs(run, t, y, p, dy, rhs);
    return status || !remove_slip_residuals(run, t, y, rhs, p) ? status : evaluate_run_rhs(run, t, y, p, dy, rhs);
}

/*
 * Remove residual slips of sticking friction from a state y at time t, in place; without a sticking element y stays. A
 * failure is ignored. Called for samples between the ends of steps.
 */
static void project_slips(Integrator *run, double t, double *y, const Parameters *p)
{
    double dy[N_Y];
    RhsOutputs rhs;
    int has_stick = 0;
    for (int i = 0; i < N_FRICTIONS; i++)
        has_stick |= run->discrete.mode[i] == 0.0;
    if (has_stick)
        (void)evaluate_rates_without_residual_slips(run, t, y, p, dy, &rhs);
}
